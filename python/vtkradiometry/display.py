# SPDX-License-Identifier: BSD-3-Clause
"""A display to draw on: the user's if it answers, else a private Xvfb."""
import atexit
import ctypes
import ctypes.util
import os
import signal
import subprocess


class DisplayError(RuntimeError):
    """There is no display and none could be started."""


def _answers(name):
    """Whether an X server answers at `name` and speaks GLX, which VTK needs."""
    library = ctypes.util.find_library("X11")
    if not library:
        return True  # cannot tell
    x11 = ctypes.CDLL(library)
    x11.XOpenDisplay.restype = ctypes.c_void_p
    x11.XOpenDisplay.argtypes = [ctypes.c_char_p]
    x11.XQueryExtension.argtypes = [ctypes.c_void_p, ctypes.c_char_p] + [
        ctypes.POINTER(ctypes.c_int)
    ] * 3
    x11.XCloseDisplay.argtypes = [ctypes.c_void_p]
    display = x11.XOpenDisplay(name.encode())
    if not display:
        return False
    numbers = [ctypes.c_int() for _ in range(3)]
    has_glx = bool(x11.XQueryExtension(display, b"GLX", *[ctypes.byref(n) for n in numbers]))
    x11.XCloseDisplay(display)
    return has_glx


def _own_session():
    """In the child: out of reach of the terminal's Ctrl-C, and gone when the parent goes."""
    os.setsid()
    ctypes.CDLL(None).prctl(1, signal.SIGTERM)  # PR_SET_PDEATHSIG


def ensure():
    """Makes sure that DISPLAY names a server that can be drawn on."""
    name = os.environ.get("DISPLAY")
    if name and _answers(name):
        return
    reader, writer = os.pipe()
    try:
        server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-noreset", "-nolisten", "tcp",
             "-screen", "0", "1600x1200x24"],
            pass_fds=[writer],
            preexec_fn=_own_session,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
    except FileNotFoundError:
        os.close(reader)
        os.close(writer)
        raise DisplayError(
            "no display answers and Xvfb is not installed (Debian: apt-get install xvfb)"
        ) from None
    os.close(writer)
    with os.fdopen(reader) as stream:
        number = stream.readline().strip()
    if not number:
        raise DisplayError("Xvfb did not start")
    atexit.register(server.terminate)
    os.environ["DISPLAY"] = f":{number}"
    os.environ.pop("XAUTHORITY", None)
