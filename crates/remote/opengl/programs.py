"""Programs of GLSL, what they bind, and dispatches."""

import ctypes
from ctypes import byref, c_char_p, c_int, c_uint

from context import Long, Refusal

STAGES = {"compute": 0x91B9, "vertex": 0x8B31, "fragment": 0x8B30}
# Programs are kept by the whole of their text, and all dropped when they are many.
MOST_KEPT = 256
NOT_THERE = 0xFFFFFFFF
UNIFORM_BLOCK, STORAGE_BLOCK = 0x92E2, 0x92E6

# WebGPU's name: how it is kept, its components, the type of one.
FORMATS = {
    "r8unorm": (0x8229, 0x1903, 0x1401),
    "r16unorm": (0x822A, 0x1903, 0x1403),
    "rg8unorm": (0x822B, 0x8227, 0x1401),
    "rg8snorm": (0x8F95, 0x8227, 0x1400),
    "rg16unorm": (0x822C, 0x8227, 0x1403),
    "rg16snorm": (0x8F99, 0x8227, 0x1402),
    "rgba8unorm": (0x8058, 0x1908, 0x1401),
    "rgba8snorm": (0x8F97, 0x1908, 0x1400),
    "rgba16unorm": (0x805B, 0x1908, 0x1403),
    "rgba16snorm": (0x8F9B, 0x1908, 0x1402),
    "rgba32float": (0x8814, 0x1908, 0x1406),
    "r32float": (0x822E, 0x1903, 0x1406),
    "rg32float": (0x8230, 0x8227, 0x1406),
    "rgba32uint": (0x8D70, 0x8D99, 0x1405),
    "rgba32sint": (0x8D82, 0x8D99, 0x1404),
    "depth32float": (0x8CAC, 0x1902, 0x1406),
}
ADDRESS = {"repeat": 0x2901, "mirror-repeat": 0x8370, "clamp-to-edge": 0x812F}
FILTER = {"nearest": 0x2600, "linear": 0x2601}


def part(data, place):
    offset, length = place
    return bytes(data[offset : offset + length])


def program(gl, stages):
    """A linked program of (stage, text)."""
    key = tuple(stages)
    if key not in gl.programs:
        if len(gl.programs) >= MOST_KEPT:
            for old in gl.programs.values():
                gl.DeleteProgram(old)
            gl.programs = {}
        gl.programs[key] = linked(gl, stages)
    return gl.programs[key]


def linked(gl, stages):
    made = gl.CreateProgram()
    shaders = [compiled(gl, stage, text) for stage, text in stages]
    for shader in shaders:
        gl.AttachShader(made, shader)
    gl.LinkProgram(made)
    for shader in shaders:
        gl.DeleteShader(shader)
    status = c_int()
    gl.GetProgramiv(made, 0x8B82, byref(status))
    if not status.value:
        raise Refusal("validation", f"OpenGL does not link the GLSL: {log(gl, 'Program', made)}")
    return made


def compiled(gl, stage, text):
    shader = gl.CreateShader(STAGES[stage])
    source = c_char_p(text.encode())
    gl.ShaderSource(shader, 1, byref(source), None)
    gl.CompileShader(shader)
    status = c_int()
    gl.GetShaderiv(shader, 0x8B81, byref(status))
    if not status.value:
        raise Refusal("validation", f"OpenGL refuses the GLSL: {log(gl, 'Shader', shader)}")
    return shader


def log(gl, what, name):
    text = ctypes.create_string_buffer(2000)
    getattr(gl, f"Get{what}InfoLog")(name, len(text), None, text)
    return text.value.decode(errors="replace").strip()


def buffer(gl, data):
    made = gl.create("Buffers")
    gl.NamedBufferStorage(made, Long(max(4, len(data))), data or bytes(4), 0)
    return made


def read_buffer(gl, name, length):
    data = ctypes.create_string_buffer(length)
    gl.MemoryBarrier(0xFFFFFFFF)
    gl.GetNamedBufferSubData(name, Long(0), Long(length), data)
    return data.raw


def bind(gl, made, groups, data):
    """Binds everything by the names that the manifest states; gives back the buffers that the shader may write."""
    written = []
    for entry in (entry for group in groups for entry in group):
        resource = entry["resource"]
        {"uniform": uniform, "storage": storage, "texture": texture, "sampler": lambda *_: None}[resource["type"]](
            gl, made, entry.get("glsl"), resource, data, written
        )
    return written


def uniform(gl, made, slot, resource, data, _):
    name = buffer(gl, part(data, resource["data"]))
    expect_block(gl, made, slot, UNIFORM_BLOCK)
    gl.BindBufferBase(0x8A11, slot["unit"], name)


def storage(gl, made, slot, resource, data, written):
    content = part(data, resource["data"])
    name = buffer(gl, content)
    expect_block(gl, made, slot, STORAGE_BLOCK)
    gl.BindBufferBase(0x90D2, slot["unit"], name)
    if resource["writable"]:
        written.append((name, len(content)))


def expect_block(gl, made, slot, interface):
    """The block must be where the manifest has it. One that the driver left out is nowhere."""
    for name in slot["names"]:
        index = gl.GetProgramResourceIndex(made, interface, name.encode() + b"\0")
        if index == NOT_THERE:
            continue
        found, what = c_int(), c_uint(0x9302)
        gl.GetProgramResourceiv(made, interface, index, 1, byref(what), 1, None, byref(found))
        expect(name, found.value, slot["unit"])


def expect(name, found, stated):
    if found != stated:
        raise Refusal("validation", f"`{name}` is bound to {found}, the manifest states {stated}")


def texture(gl, made, slot, resource, data, _):
    is_cube = resource["dimension"] == "cube"
    kept, components, scalar = FORMATS[resource["format"]]
    name = gl.create("Textures", 0x8513 if is_cube else 0x0DE1)
    width, height, levels = resource["width"], resource["height"], resource["levels"]
    gl.TextureStorage2D(name, len(levels), kept, width, height)
    for level, place in enumerate(levels):
        w, h = max(1, width >> level), max(1, height >> level)
        content = part(data, place)
        if is_cube:
            gl.TextureSubImage3D(name, level, 0, 0, 0, w, h, 6, components, scalar, content)
        else:
            gl.TextureSubImage2D(name, level, 0, 0, w, h, components, scalar, content)
    for text in slot["names"]:
        location = c_int(gl.GetUniformLocation(made, text.encode() + b"\0")).value
        if location < 0:
            continue
        found = c_int()
        gl.GetUniformiv(made, location, byref(found))
        expect(text, found.value, slot["unit"])
    gl.BindTextureUnit(slot["unit"], name)
    gl.BindSampler(slot["unit"], sampler(gl, slot.get("sampler")))


def sampler(gl, settings):
    name = gl.create("Samplers")
    if settings is None:  # Only read texel by texel.
        gl.SamplerParameteri(name, 0x2801, 0x2700)
        gl.SamplerParameteri(name, 0x2800, 0x2600)
        return name
    for axis, mode in ((0x2802, "U"), (0x2803, "V"), (0x8072, "W")):
        gl.SamplerParameteri(name, axis, ADDRESS[settings[f"addressMode{mode}"]])
    gl.SamplerParameteri(name, 0x2800, FILTER[settings["magFilter"]])
    between = 2 if settings["mipmapFilter"] == "linear" else 0
    within = 1 if settings["minFilter"] == "linear" else 0
    gl.SamplerParameteri(name, 0x2801, 0x2700 + between + within)
    if settings["maxAnisotropy"] > 1:
        gl.SamplerParameterf(name, 0x84FE, float(settings["maxAnisotropy"]))
    return name


def compute(gl, job, data):
    """A dispatch: the buffers that the shader may write come back, in the order of their bindings."""
    made = program(gl, [("compute", job["shader"]["text"])])
    gl.UseProgram(made)
    written = bind(gl, made, job["groups"], data)
    gl.DispatchCompute(*job["workgroups"])
    return [read_buffer(gl, name, length) for name, length in written]
