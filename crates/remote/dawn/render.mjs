// A picture: every target's pixels come back, row by row from the top, then the depth where it is asked for.
import { part } from './messages.mjs';
import { bind, buffer, module, pipeline, readBack, staging } from './resources.mjs';
import { own } from './scopes.mjs';

const ROW_ALIGNMENT = 256;
const DEPTH = { format: 'depth32float', pixelBytes: 4 };

export async function render(state, job, data) {
    const { device } = state;
    const surfaces = job.targets.map((target) => surface(state, job, target));
    const depth = surface(state, job, DEPTH);
    job.targets.forEach((target, index) => {
        if (target.pixels) {
            const rows = { bytesPerRow: job.width * target.pixelBytes };
            const bytes = part(data, target.pixels);
            device.queue.writeTexture({ texture: surfaces[index] }, bytes, rows, [job.width, job.height]);
        }
    });
    const passes = job.passes.length > 0 ? job.passes : [[]];
    const ready = [];
    for (const draws of passes) {
        const list = [];
        for (const draw of draws) list.push(await prepare(state, job, draw, data));
        ready.push(list);
    }
    const encoder = device.createCommandEncoder();
    ready.forEach((draws, index) => {
        const pass = encoder.beginRenderPass(attachments(job, surfaces, depth, index === 0));
        for (const draw of draws) draw(pass);
        pass.end();
    });
    const copies = job.targets.map((target, index) => copy(state, encoder, job, surfaces[index], target));
    if (job.readDepth) copies.push(copy(state, encoder, job, depth, DEPTH));
    device.queue.submit([encoder.finish()]);
    const parts = [];
    for (const one of copies) parts.push(await one());
    if (copies.length === 0) await device.queue.onSubmittedWorkDone();
    return parts;
}

function surface(state, { width, height }, { format }) {
    const usage = GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC
        | (format === DEPTH.format ? 0 : GPUTextureUsage.COPY_DST);
    return own(state, state.device.createTexture({ size: [width, height], format, usage }));
}

function attachments(job, surfaces, depth, clears) {
    return {
        colorAttachments: surfaces.map((texture, index) => {
            const { colour } = job.targets[index];
            const load = clears && colour ? { loadOp: 'clear', clearValue: colour } : { loadOp: 'load' };
            return { view: texture.createView(), storeOp: 'store', ...load };
        }),
        depthStencilAttachment: {
            view: depth.createView(),
            depthStoreOp: 'store',
            ...(clears ? { depthLoadOp: 'clear', depthClearValue: 1 } : { depthLoadOp: 'load' }),
        },
    };
}

async function prepare(state, job, draw, data) {
    const { device } = state;
    const vertex = await module(state, draw.vertex.text);
    const fragment = await module(state, draw.fragment.text);
    const { groups, attributes, states } = draw;
    const shapes = attributes.map(({ location, components }) => ({ location, components }));
    const key = ['render', draw.vertex, draw.fragment, shapes, states];
    const { made, layouts } = await pipeline(state, key, groups, (layout) => device.createRenderPipeline({
        layout,
        vertex: { module: vertex, entryPoint: draw.vertex.entry, buffers: shapes.map(attribute) },
        primitive: { topology: 'triangle-list', cullMode: states.cull },
        depthStencil: {
            format: DEPTH.format,
            depthWriteEnabled: states.depthWrites,
            depthCompare: states.depthCompare,
        },
        fragment: { module: fragment, entryPoint: draw.fragment.entry, targets: states.targets },
    }));
    const bound = bind(state, data, layouts, groups);
    const vertices = attributes.map(({ values }) => buffer(state, part(data, values), GPUBufferUsage.VERTEX));
    const indices = buffer(state, part(data, draw.indices), GPUBufferUsage.INDEX);
    return (pass) => {
        pass.setPipeline(made);
        bound.forEach((group, index) => pass.setBindGroup(index, group));
        vertices.forEach((values, slot) => pass.setVertexBuffer(slot, values));
        pass.setIndexBuffer(indices, 'uint32');
        pass.drawIndexed(draw.indices[1] / 4);
    };
}

function attribute({ location, components }) {
    const format = components === 1 ? 'float32' : `float32x${components}`;
    return { arrayStride: 4 * components, attributes: [{ format, offset: 0, shaderLocation: location }] };
}

// Rows are padded in the copy, and tight in what comes back.
function copy(state, encoder, { width, height }, texture, { pixelBytes }) {
    const row = width * pixelBytes;
    const padded = Math.ceil(row / ROW_ALIGNMENT) * ROW_ALIGNMENT;
    const made = staging(state, padded * height);
    encoder.copyTextureToBuffer({ texture }, { buffer: made, bytesPerRow: padded }, [width, height]);
    return async () => {
        const bytes = await readBack(state, made);
        const tight = Buffer.alloc(row * height);
        for (let y = 0; y < height; y += 1) bytes.copy(tight, y * row, y * padded, y * padded + row);
        return tight;
    };
}
