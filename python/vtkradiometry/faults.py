# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong in a filter, as one line for people."""
import re

from vtkmodules.vtkCommonCore import VTK_STRING, vtkOutputWindow, vtkStringOutputWindow


class InputFault(Exception):
    """Something is wrong with what the user gave. The text says what and where, in one line."""


def one_line(text):
    """VTK's message without its file, line, class and address."""
    match = re.search(r"\(0x[0-9a-fA-F]+\):\s*(.*)", text, re.DOTALL)
    words = match.group(1) if match else re.sub(r"^(ERROR|Warning):\s*", "", text)
    return " ".join(words.split())


class Listener:
    """Collects the errors and warnings of VTK objects while it is active.

    Nothing reaches the terminal by itself: VTK's output window is replaced meanwhile.
    """

    def __init__(self):
        self.errors = []
        self.warnings = []
        self._window = vtkStringOutputWindow()
        self._before = None
        self._observed = []

    def __enter__(self):
        self._before = vtkOutputWindow.GetInstance()
        vtkOutputWindow.SetInstance(self._window)
        return self

    def __exit__(self, *_):
        vtkOutputWindow.SetInstance(self._before)
        for thing, tag in self._observed:
            thing.RemoveObserver(tag)
        self._observed = []

    def observe(self, thing):
        """Listens to this object (and its executive) too."""

        def error(_caller, _event, text):
            self.errors.append(one_line(text))

        def warning(_caller, _event, text):
            self.warnings.append(one_line(text))

        error.CallDataType = warning.CallDataType = VTK_STRING
        self._observed.append((thing, thing.AddObserver("ErrorEvent", error)))
        self._observed.append((thing, thing.AddObserver("WarningEvent", warning)))

    def other_output(self):
        """What other objects said on the output window, one line a message."""
        text = self._window.GetOutput() or ""
        parts = re.split(r"(?=^(?:ERROR|Warning):)", text, flags=re.MULTILINE)
        return [one_line(part) for part in parts if part.strip()]

    def check(self, where):
        """Raises InputFault with the first error, if there was one."""
        if self.errors:
            raise InputFault(f"{where}: {self.errors[0]}")
