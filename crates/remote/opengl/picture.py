"""Pictures: every target's pixels come back, row by row from the top, then the depth where it is asked for."""

import ctypes
from ctypes import c_float, c_uint

from context import Long, Refusal
from programs import FORMATS, bind, buffer, part, program

COMPARE = {"less": 0x0201, "equal": 0x0202, "less-equal": 0x0203, "always": 0x0207}
FACTOR = {"one": (1, 1), "zero": (0, 0), "dst": (0x0306, 0x0304)}
CULL = {"back": 0x0405, "front": 0x0404}
COLOUR, DEPTH = 0x1800, 0x1801


def render(gl, job, data):
    size = job["width"], job["height"]
    frame = gl.create("Framebuffers")
    surfaces = [surface(gl, size, target["format"]) for target in job["targets"]]
    depth = surface(gl, size, "depth32float")
    for index, name in enumerate(surfaces):
        gl.NamedFramebufferTexture(frame, 0x8CE0 + index, name, 0)
    gl.NamedFramebufferTexture(frame, 0x8D00, depth, 0)
    places = (c_uint * max(1, len(surfaces)))(*[0x8CE0 + index for index in range(len(surfaces))])
    gl.NamedFramebufferDrawBuffers(frame, len(surfaces), places)
    if not surfaces:
        gl.NamedFramebufferParameteri(frame, 0x9310, size[0])
        gl.NamedFramebufferParameteri(frame, 0x9311, size[1])
    status = gl.CheckNamedFramebufferStatus(frame, 0x8CA9)
    if status != 0x8CD5:
        raise Refusal("validation", f"OpenGL does not draw to these targets: {hex(status)}")
    gl.BindFramebuffer(0x8CA9, frame)
    gl.Viewport(0, 0, *size)
    clear(gl, job, frame, surfaces, data)
    for draws in job["passes"]:
        for one in draws:
            draw(gl, one, data)
    gl.Finish()
    parts = [read(gl, name, size, target["format"], target["pixelBytes"]) for name, target in zip(surfaces, job["targets"])]
    if job["readDepth"]:
        parts.append(read(gl, depth, size, "depth32float", 4))
    return parts


def surface(gl, size, form):
    name = gl.create("Textures", 0x0DE1)
    gl.TextureStorage2D(name, 1, FORMATS[form][0], *size)
    return name


def clear(gl, job, frame, surfaces, data):
    for index in range(len(surfaces)):
        gl.ColorMaski(index, 1, 1, 1, 1)
    gl.DepthMask(1)
    for index, target in enumerate(job["targets"]):
        if "pixels" in target:
            _, components, scalar = FORMATS[target["format"]]
            content = part(data, target["pixels"])
            gl.TextureSubImage2D(surfaces[index], 0, 0, 0, job["width"], job["height"], components, scalar, content)
        else:
            gl.ClearNamedFramebufferfv(frame, COLOUR, index, (c_float * 4)(*target["colour"]))
    gl.ClearNamedFramebufferfv(frame, DEPTH, 0, (c_float * 1)(1.0))


def draw(gl, one, data):
    made = program(gl, [("vertex", one["vertex"]["text"]), ("fragment", one["fragment"]["text"])])
    gl.UseProgram(made)
    bind(gl, made, one["groups"], data)
    states(gl, one["states"])
    vertices = gl.create("VertexArrays")
    for place, attribute in enumerate(one["attributes"]):
        location, components = attribute["location"], attribute["components"]
        values = buffer(gl, part(data, attribute["values"]))
        gl.VertexArrayVertexBuffer(vertices, place, values, Long(0), 4 * components)
        gl.VertexArrayAttribFormat(vertices, location, components, 0x1406, 0, 0)
        gl.VertexArrayAttribBinding(vertices, location, place)
        gl.EnableVertexArrayAttrib(vertices, location)
    gl.VertexArrayElementBuffer(vertices, buffer(gl, part(data, one["indices"])))
    gl.BindVertexArray(vertices)
    gl.DrawElements(4, one["indices"][1] // 4, 0x1405, None)


def states(gl, states):
    if states["cull"] == "none":
        gl.Disable(0x0B44)
    else:
        gl.Enable(0x0B44)
        gl.CullFace(CULL[states["cull"]])
    gl.Enable(0x0B71)
    gl.DepthMask(int(states["depthWrites"]))
    gl.DepthFunc(COMPARE[states["depthCompare"]])
    for index, target in enumerate(states["targets"]):
        gl.ColorMaski(index, *[target["writeMask"] >> channel & 1 for channel in range(4)])
        if "blend" not in target:
            gl.Disablei(0x0BE2, index)
            continue
        gl.Enablei(0x0BE2, index)
        blend = target["blend"]["color"]
        source, destination = FACTOR[blend["srcFactor"]], FACTOR[blend["dstFactor"]]
        gl.BlendFuncSeparatei(index, source[0], destination[0], source[1], destination[1])


def read(gl, name, size, form, pixel_bytes):
    _, components, scalar = FORMATS[form]
    length = size[0] * size[1] * pixel_bytes
    content = ctypes.create_string_buffer(length)
    gl.GetTextureImage(name, 0, components, scalar, length, content)
    return content.raw[:length]
