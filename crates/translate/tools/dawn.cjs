#!/usr/bin/env node
// Dawn, an implementation of WebGPU whose compiler of WGSL is Tint, as a program. `./x setup --full` puts it beside the library of a
// pinned package.
//
//   dawn --version
//   dawn check               validates the WGSL on standard input by itself: no adapter is needed
//   dawn run MODULE ARG …    calls the default export of a JavaScript module with the library and the arguments
'use strict';

const fs = require('node:fs');
const path = require('node:path');
const { pathToFileURL } = require('node:url');

const OLDEST_NODE = 20;
const folder = path.join(path.dirname(fs.realpathSync(__filename)), '..', 'lib');

function fail(message) {
    process.stderr.write(`dawn: ${message}\n`);
    process.exit(2);
}

function library() {
    if (Number.parseInt(process.versions.node, 10) < OLDEST_NODE) {
        fail(`node ${process.versions.node} is too old: ${OLDEST_NODE} or later is needed`);
    }
    return require(path.join(folder, 'dawn.node'));
}

function version() {
    return JSON.parse(fs.readFileSync(path.join(folder, 'package.json'), 'utf8')).version;
}

// Tint's word on the text, as `line:column: error: message`.
async function check(dawn) {
    Object.assign(globalThis, dawn.globals);
    const gpu = dawn.create(['backend=null']);
    const adapter = await gpu.requestAdapter();
    const device = await adapter.requestDevice({ requiredFeatures: [...adapter.features] });
    device.pushErrorScope('validation');
    const module = device.createShaderModule({ code: fs.readFileSync(0, 'utf8') });
    const { messages } = await module.getCompilationInfo();
    const error = await device.popErrorScope();
    for (const { lineNum, linePos, type, message } of messages) {
        process.stdout.write(`${lineNum}:${linePos}: ${type}: ${message}\n`);
    }
    const refused = messages.some(({ type }) => type === 'error');
    if (error && !refused) process.stdout.write(`${error.message}\n`);
    // Without waiting for the library's threads, which go on for a while; what was written to pipes is out by then.
    process.exitCode = error || refused ? 1 : 0;
    process.stdout.write('', () => process.exit());
}

async function main() {
    const [what, ...rest] = process.argv.slice(2);
    if (what === '--version') {
        library();
        process.stdout.write(`Dawn: webgpu ${version()}\n`);
        process.exit(0);
    }
    if (what === 'check') return check(library());
    if (what === 'run' && rest.length > 0) {
        const [script, ...args] = rest;
        const { default: run } = await import(pathToFileURL(path.resolve(script)).href);
        return run(library(), args);
    }
    return fail('call it as `dawn --version`, `dawn check` or `dawn run MODULE ARG …`');
}

main().catch((error) => fail(error?.stack ?? String(error)));
