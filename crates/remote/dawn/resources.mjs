// What a job binds, by explicit layouts: the manifest decides what stands where, not the shader's text.
import { part } from './messages.mjs';
import { forget, own, Refusal } from './scopes.mjs';

// Modules and pipelines are kept by the whole of what they are made of, and all dropped when they are many.
const MOST_KEPT = 256;

export async function kept(state, table, key, make) {
    const found = state[table].get(key);
    if (found) return found;
    if (state[table].size >= MOST_KEPT) forget(state);
    const made = await make();
    state[table].set(key, made);
    return made;
}

export const module = (state, text) => kept(state, 'modules', text, async () => {
    const made = state.device.createShaderModule({ code: text });
    const { messages } = await made.getCompilationInfo();
    const errors = messages.filter(({ type }) => type === 'error');
    if (errors.length > 0) {
        const lines = errors.map(({ lineNum, linePos, message }) => `${lineNum}:${linePos}: ${message.split('\n')[0]}`);
        throw new Refusal('validation', `Tint refuses the WGSL: ${lines.join('; ')}`);
    }
    return made;
});

export function buffer(state, bytes, usage) {
    const size = Math.max(4, bytes.length);
    const made = own(state, state.device.createBuffer({ size, usage: usage | GPUBufferUsage.COPY_DST }));
    if (bytes.length > 0) state.device.queue.writeBuffer(made, 0, bytes);
    return made;
}

// One group's entries as a layout has them.
function layoutEntry({ binding, visibility, resource }) {
    switch (resource.type) {
        case 'uniform': return { binding, visibility, buffer: { type: 'uniform' } };
        case 'storage':
            return { binding, visibility, buffer: { type: resource.writable ? 'storage' : 'read-only-storage' } };
        case 'texture': {
            const sampleType = resource.filterable ? 'float' : 'unfilterable-float';
            return { binding, visibility, texture: { sampleType, viewDimension: resource.dimension } };
        }
        case 'sampler':
            return { binding, visibility, sampler: { type: resource.filtering ? 'filtering' : 'non-filtering' } };
        default: throw new Error(`no resource is of type ${resource.type}`);
    }
}

// A pipeline with its layouts, made once.
export function pipeline(state, key, groups, make) {
    const entries = groups.map((group) => group.map(layoutEntry));
    return kept(state, 'pipelines', JSON.stringify([key, entries]), async () => {
        const layouts = entries.map((list) => state.device.createBindGroupLayout({ entries: list }));
        const layout = state.device.createPipelineLayout({ bindGroupLayouts: layouts });
        return { made: await make(layout), layouts };
    });
}

// Binds everything; calls `onBuffer` with each storage buffer that the shader may write, in the order of the bindings.
export function bind(state, data, layouts, groups, onBuffer = () => {}) {
    return groups.map((group, index) => state.device.createBindGroup({
        layout: layouts[index],
        entries: group.map(({ binding, resource }) => ({ binding, resource: bound(state, data, resource, onBuffer) })),
    }));
}

function bound(state, data, resource, onBuffer) {
    switch (resource.type) {
        case 'uniform': return { buffer: buffer(state, part(data, resource.data), GPUBufferUsage.UNIFORM) };
        case 'storage': {
            const bytes = part(data, resource.data);
            const made = buffer(state, bytes, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC);
            if (resource.writable) onBuffer(made, bytes.length);
            return { buffer: made };
        }
        case 'texture': return texture(state, data, resource);
        default: return state.device.createSampler(resource.settings);
    }
}

function texture(state, data, { width, height, layers, dimension, format, texelBytes, levels }) {
    const made = own(state, state.device.createTexture({
        size: [width, height, layers],
        mipLevelCount: levels.length,
        format,
        usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST,
    }));
    levels.forEach((level, mipLevel) => {
        const [w, h] = [width, height].map((side) => Math.max(1, side >> mipLevel));
        const rows = { bytesPerRow: w * texelBytes, rowsPerImage: h };
        state.device.queue.writeTexture({ texture: made, mipLevel }, part(data, level), rows, [w, h, layers]);
    });
    return made.createView({ dimension });
}

// Brings a mapped copy of the buffer's bytes back.
export async function readBack(state, staging) {
    await staging.mapAsync(GPUMapMode.READ);
    const bytes = Buffer.from(staging.getMappedRange().slice(0));
    staging.unmap();
    return bytes;
}

export const staging = (state, size) =>
    own(state, state.device.createBuffer({ size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST }));
