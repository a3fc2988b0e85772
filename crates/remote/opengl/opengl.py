"""Runs jobs by OpenGL 4.5 core, without a display, until standard input ends. Argument: the adapter's name, which is the renderer's;
or `--check`, with which it only says what it lacks, if anything.

A message is two lengths (32 bits, little-endian), then so many bytes of JSON, then so many of data, which the JSON points into. The
first answer says what the renderer is; each later one answers a job. The JSON has WebGPU's words.
"""

import json
import os
import signal
import struct
import sys
import threading
import time

sys.dont_write_bytecode = True

from context import GL, Refusal, make_current  # noqa: E402
from picture import render  # noqa: E402
from programs import compute  # noqa: E402


def send(head, parts=()):
    text = json.dumps(head).encode()
    out = sys.stdout.buffer
    out.write(struct.pack("<II", len(text), sum(len(part) for part in parts)))
    out.write(text)
    for part in parts:
        out.write(part)
    out.flush()


def messages():
    source = sys.stdin.buffer
    while len(lengths := source.read(8)) == 8:
        head, data = struct.unpack("<II", lengths)
        text = source.read(head)
        yield json.loads(text), source.read(data)


def hello(gl):
    send(
        {
            "features": ["float32-filterable", "float32-blendable", "texture-formats-tier1"],
            "side": gl.number(0x0D33),
            "targets": gl.number(0x8824),
            "workgroups": min(gl.number_at(0x91BE, axis) for axis in range(3)),
            "bufferBytes": gl.number(0x90DE),
        }
    )


def answer(gl, head, data):
    try:
        run = compute if head["kind"] == "compute" else render
        parts = run(gl, head, data)
        gl.check()
    except Refusal as refusal:
        gl.forget()
        return send({"failure": refusal.kind, "message": str(refusal)})
    finally:
        gl.give_back()
    return send({"lengths": [len(part) for part in parts]}, parts)


def stop_when_alone():
    """Whoever started this process may be killed while a job hangs, and cannot end it then."""
    parent = os.getppid()

    def watch():
        while os.getppid() == parent:
            time.sleep(1)
        os.kill(os.getpid(), signal.SIGKILL)

    threading.Thread(target=watch, daemon=True).start()


def main(name):
    stop_when_alone()
    try:
        make_current()
        gl = GL()
        if gl.renderer != name:
            raise Refusal("adapter", f"OpenGL's renderer is `{gl.renderer}`")
    except Refusal as error:
        return send({"failure": "adapter", "message": str(error)})
    hello(gl)
    for head, data in messages():
        answer(gl, head, data)
    return None


def check():
    try:
        make_current()
    except Refusal as error:
        sys.exit(str(error))


if sys.argv[1] == "--check":
    check()
else:
    main(sys.argv[1])
