"""Python reads this module first where its folder is in PYTHONPATH: to it, this computer has no EGL."""

import ctypes


class CDLL(ctypes.CDLL):
    def __init__(self, name, *args, **kwargs):
        if name.startswith("libEGL"):
            raise OSError(f"{name}: cannot open shared object file: No such file or directory")
        super().__init__(name, *args, **kwargs)


ctypes.CDLL = CDLL
