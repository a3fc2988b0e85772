// A dispatch: the buffers that the shader may write come back, in the order of their bindings.
import { bind, module, pipeline, readBack, staging } from './resources.mjs';

export async function compute(state, { shader, groups, workgroups }, data) {
    const { device } = state;
    const code = await module(state, shader.text);
    const { made, layouts } = await pipeline(state, ['compute', shader], groups, (layout) =>
        device.createComputePipeline({ layout, compute: { module: code, entryPoint: shader.entry } }));
    const written = [];
    const bound = bind(state, data, layouts, groups, (buffer, size) => written.push({ buffer, size }));
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(made);
    bound.forEach((group, index) => pass.setBindGroup(index, group));
    pass.dispatchWorkgroups(...workgroups);
    pass.end();
    const copies = written.map(({ buffer, size }) => {
        const copy = staging(state, size);
        encoder.copyBufferToBuffer(buffer, 0, copy, 0, size);
        return copy;
    });
    device.queue.submit([encoder.finish()]);
    const parts = [];
    for (const copy of copies) parts.push(await readBack(state, copy));
    if (copies.length === 0) await device.queue.onSubmittedWorkDone();
    return parts;
}
