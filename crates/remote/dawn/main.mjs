// Runs jobs on one adapter until standard input ends. Arguments: the adapter's name.
//
// A message is two lengths (32 bits, little-endian), then so many bytes of JSON, then so many of data, which the JSON points into. The
// first answer says what the adapter is; each later one answers a job.
import { messages, send } from './messages.mjs';
import { compute } from './compute.mjs';
import { render } from './render.mjs';
import { Refusal, scoped } from './scopes.mjs';

export default async function main(dawn, [name]) {
    Object.assign(globalThis, dawn.globals);
    // Kept alive here: what it made ends with it.
    const gpu = dawn.create(['backend=vulkan', `adapter=${name}`]);
    let adapter;
    try {
        adapter = await gpu.requestAdapter();
    } catch (error) {
        send({ failure: 'adapter', message: error.message });
        process.exit(0);
    }
    const device = await adapter.requestDevice({
        requiredFeatures: [...adapter.features].filter((feature) => WANTED.has(feature)),
        requiredLimits: limits(adapter),
    });
    stopWhenAlone();
    const state = { device, modules: new Map(), pipelines: new Map(), lost: undefined };
    device.lost.then(({ message }) => { state.lost = message; });
    send({
        features: [...device.features],
        side: device.limits.maxTextureDimension2D,
        targets: device.limits.maxColorAttachments,
        workgroups: device.limits.maxComputeWorkgroupsPerDimension,
        bufferBytes: Math.min(device.limits.maxStorageBufferBindingSize, device.limits.maxBufferSize),
    });
    for await (const { head, data } of messages(process.stdin)) {
        await answer(state, head, data);
        if (state.lost !== undefined) break;
    }
    process.exit(gpu ? 0 : 1);
}

const WANTED = new Set(['float32-filterable', 'float32-blendable', 'shader-f16', 'texture-formats-tier1', 'subgroups']);

function limits(adapter) {
    const all = {};
    for (const name in adapter.limits) {
        if (typeof adapter.limits[name] === 'number') all[name] = adapter.limits[name];
    }
    return all;
}

// Whoever started this process may be killed while a job hangs, and cannot end it then.
function stopWhenAlone() {
    const parent = process.ppid;
    const watch = () => process.ppid === parent || process.kill(process.pid, 'SIGKILL');
    setInterval(watch, 1000).unref();
}

async function answer(state, head, data) {
    try {
        const run = head.kind === 'compute' ? compute : render;
        const parts = await scoped(state, () => run(state, head, data));
        send({ lengths: parts.map((part) => part.byteLength) }, parts);
    } catch (error) {
        const failure = error instanceof Refusal ? error.kind : 'internal';
        send({ failure: state.lost === undefined ? failure : 'lost', message: state.lost ?? error.message });
    }
}
