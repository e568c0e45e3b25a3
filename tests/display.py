# SPDX-License-Identifier: BSD-3-Clause
"""A display to draw on, for tests on a machine that has none.

    import display; display.ensure()          in a test, before the first render window
    python3 display.py COMMAND ARGUMENT...    runs a command with DISPLAY set; exits as it does

Where DISPLAY is set, that display is used. Otherwise one Xvfb is started (with -noreset: a server
that resets when its last client leaves loses the next one) on a number that it finds itself. It ends
with the process that asked for it, however that ends, and not before: windows close on exit. Without Xvfb the test is skipped (exit status 77).
"""
import ctypes
import os
import shutil
import signal
import subprocess
import sys

SIZE = "1600x1200x24"
SKIPPED = 77
_server = None


def _die_with_parent():
    """The server ends when the test is killed, too (Linux: PR_SET_PDEATHSIG)."""
    ctypes.CDLL(None).prctl(1, signal.SIGTERM)


def stop():
    global _server
    if _server is not None:
        _server.terminate()
        _server.wait()
        _server = None


def ensure():
    """Makes sure that DISPLAY names a running display; returns it."""
    global _server
    if os.environ.get("DISPLAY"):
        return os.environ["DISPLAY"]
    program = shutil.which("Xvfb")
    if program is None:
        print("skipped: no DISPLAY and no Xvfb", file=sys.stderr)
        sys.exit(SKIPPED)
    reader, writer = os.pipe()
    _server = subprocess.Popen(
        [program, "-displayfd", str(writer), "-noreset", "-nolisten", "tcp", "-screen", "0", SIZE],
        pass_fds=[writer],
        preexec_fn=_die_with_parent,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    os.close(writer)
    with os.fdopen(reader) as numbers:
        number = numbers.readline().strip()  # Xvfb writes it when it is ready
    if not number:
        raise RuntimeError("Xvfb did not start")
    os.environ["DISPLAY"] = ":" + number
    return os.environ["DISPLAY"]


def main(command):
    if not command:
        print(__doc__, file=sys.stderr)
        return 2
    ensure()
    try:
        return subprocess.call(command)
    finally:
        stop()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
