// What the device says of a job becomes that job's failure, and what the job made is given back.

// A failure that the device itself states.
export class Refusal extends Error {
    constructor(kind, message) {
        super(message);
        this.kind = kind;
    }
}

// From the outermost to the innermost.
const FILTERS = ['internal', 'out-of-memory', 'validation'];
const KINDS = { internal: 'internal', 'out-of-memory': 'memory', validation: 'validation' };

export async function scoped(state, work) {
    const { device } = state;
    for (const filter of FILTERS) device.pushErrorScope(filter);
    state.owned = [];
    let result;
    let thrown;
    try {
        result = await work();
    } catch (error) {
        thrown = error;
    }
    const said = [];
    for (const filter of FILTERS.toReversed()) {
        const error = await device.popErrorScope();
        if (error) said.push(new Refusal(KINDS[filter], error.message));
    }
    for (const one of state.owned) one.destroy();
    if (said.length > 0 || thrown) forget(state);
    // The compiler's word goes before the device's, which goes before what follows from it.
    if (thrown instanceof Refusal) throw thrown;
    if (said.length > 0) throw said[0];
    if (thrown) throw thrown;
    return result;
}

// What may have been made of something that is not valid is made anew.
export function forget(state) {
    state.modules.clear();
    state.pipelines.clear();
}

// A thing that goes when the job is done.
export function own(state, thing) {
    state.owned.push(thing);
    return thing;
}
