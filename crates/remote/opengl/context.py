"""A context of OpenGL without a display, and its functions."""

import ctypes
from ctypes import byref, c_char_p, c_float, c_int, c_size_t, c_uint, c_void_p


class Refusal(Exception):
    """A failure that the driver itself states."""

    def __init__(self, kind, message):
        super().__init__(message)
        self.kind = kind


SURFACELESS = 0x31DD
OPENGL_API = 0x30A2
CONFIG = [0x3040, 0x0008, 0x3038]  # renderable type: OpenGL
CONTEXT = [0x3098, 4, 0x30FB, 5, 0x30FD, 1, 0x3038]  # 4.5, core

EGL = None


def make_current():
    """Makes a context of OpenGL 4.5 core without a display current."""
    global EGL
    try:
        EGL = ctypes.CDLL("libEGL.so.1")
    except OSError as error:
        raise Refusal("adapter", f"EGL is not here ({error})") from None
    EGL.eglGetProcAddress.restype = c_void_p
    EGL.eglGetProcAddress.argtypes = [c_char_p]
    EGL.eglGetPlatformDisplay.restype = c_void_p
    EGL.eglGetPlatformDisplay.argtypes = [c_uint, c_void_p, c_void_p]
    EGL.eglCreateContext.restype = c_void_p
    EGL.eglCreateContext.argtypes = [c_void_p, c_void_p, c_void_p, c_void_p]
    EGL.eglInitialize.argtypes = [c_void_p, c_void_p, c_void_p]
    EGL.eglChooseConfig.argtypes = [c_void_p, c_void_p, c_void_p, c_int, c_void_p]
    EGL.eglMakeCurrent.argtypes = [c_void_p] * 4
    display = EGL.eglGetPlatformDisplay(SURFACELESS, None, None)
    if not display or not EGL.eglInitialize(display, None, None):
        raise Refusal("adapter", "EGL has no display without a surface")
    EGL.eglBindAPI(OPENGL_API)
    config, count = c_void_p(), c_int()
    attributes = (c_int * len(CONFIG))(*CONFIG)
    EGL.eglChooseConfig(display, attributes, byref(config), 1, byref(count))
    attributes = (c_int * len(CONTEXT))(*CONTEXT)
    context = EGL.eglCreateContext(display, config if count.value else None, None, attributes)
    if not context or not EGL.eglMakeCurrent(display, None, None, context):
        raise Refusal("adapter", "EGL has no context of OpenGL 4.5 core")


ERRORS = {0x0500: "invalid enum", 0x0501: "invalid value", 0x0502: "invalid operation", 0x0505: "out of memory"}


class GL:
    """The functions of the current context, by name without `gl`; and what a job made of it."""

    def __init__(self):
        self.functions = {}
        self.programs = {}
        self.owned = []
        text = self.GetString
        text.restype = c_char_p
        self.renderer = text(0x1F01).decode()
        self.PixelStorei(0x0CF5, 1)  # unpack alignment
        self.PixelStorei(0x0D05, 1)  # pack alignment
        self.Enable(0x884F)  # seamless cube maps
        # WebGPU's clip space: the first row is the top, and depth runs from 0 to 1.
        self.ClipControl(0x8CA2, 0x935F)

    def __getattr__(self, name):
        functions = self.__dict__["functions"]
        if name not in functions:
            address = EGL.eglGetProcAddress(f"gl{name}".encode())
            if not address:
                raise Refusal("internal", f"OpenGL has no gl{name}")
            functions[name] = Function(address)
        return functions[name]

    def number(self, what):
        value = c_int()
        self.GetIntegerv(what, byref(value))
        return value.value

    def number_at(self, what, index):
        value = c_int()
        self.GetIntegeri_v(what, index, byref(value))
        return value.value

    def create(self, kind, *before):
        """Makes a thing that goes when the job is done: `kind` as in `Buffers`."""
        name = c_uint()
        getattr(self, f"Create{kind}")(*before, 1, byref(name))
        self.owned.append((kind, name))
        return name.value

    def give_back(self):
        for kind, name in self.owned:
            getattr(self, f"Delete{kind}")(1, byref(name))
        self.owned = []

    def forget(self):
        """Clears what failed jobs left in the state of errors."""
        while self.GetError():
            pass

    def check(self):
        error = self.GetError()
        if error == 0x0505:
            raise Refusal("memory", "out of memory")
        if error:
            raise Refusal("internal", f"OpenGL says: {ERRORS.get(error, hex(error))}")


class Function:
    """A function of OpenGL: whole numbers, addresses and bytes are told apart by their types in Python."""

    def __init__(self, address):
        self.address = address
        self.restype = c_uint
        self.made = {}

    def __call__(self, *args):
        types = tuple(kind(arg) for arg in args)
        key = (types, self.restype)
        if key not in self.made:
            self.made[key] = ctypes.CFUNCTYPE(self.restype, *types)(self.address)
        return self.made[key](*[plain(arg) for arg in args])


def kind(arg):
    if isinstance(arg, float):
        return c_float
    if isinstance(arg, Long):
        return c_size_t
    if isinstance(arg, int):
        return c_uint if arg >= 0 else c_int
    return c_void_p


def plain(arg):
    if isinstance(arg, bytes):
        return ctypes.cast(ctypes.c_char_p(arg), c_void_p)
    if isinstance(arg, (ctypes.Array, ctypes._SimpleCData)):
        return ctypes.cast(ctypes.pointer(arg), c_void_p)
    if isinstance(arg, type(byref(c_int()))):
        return ctypes.cast(arg, c_void_p)
    return arg


class Long(int):
    """A size or an offset: as wide as an address."""
