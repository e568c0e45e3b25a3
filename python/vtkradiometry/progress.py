# SPDX-License-Identifier: BSD-3-Clause
"""Progress on the terminal, Ctrl-C, and the time that each stage took."""
import contextlib
import os
import signal
import sys
import time


class Stopped(Exception):
    """The user asked for a stop (Ctrl-C or a termination signal)."""


def foretell(algorithm):
    """What a simulating filter said that it will take, in words."""
    seconds, budget = algorithm.GetPredictedSeconds(), algorithm.GetTimeBudget()
    goal = f"{100.0 * algorithm.GetRelativeTolerance():g} %"
    if budget > 0.0 and seconds >= 0.95 * budget:
        return f"about {budget:.3g} s, the time budget, which ends it before {goal} everywhere"
    return f"about {seconds:.2g} s to {goal}"


class Progress:
    """One line that is rewritten on a terminal; a line a stage, and every ten seconds, elsewhere.

    Use as a context manager: while it is active Ctrl-C sets `stop`, which `filter()` hands to the
    running filter as AbortExecute and `check()` turns into `Stopped`. A second Ctrl-C does not wait.
    """

    def __init__(self, stream=None, quiet=False):
        self.stream = stream or sys.stderr
        self.quiet = quiet
        self.stop = None  # the signal's number
        self.seconds = {}  # stage -> wall-clock seconds, in order
        self._live = not quiet and self.stream.isatty()
        self._shown = 0
        self._last = 0.0
        self._stage = ""
        self._begin = 0.0
        self._handlers = {}
        self.on_second_signal = lambda: None

    def __enter__(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            self._handlers[number] = signal.signal(number, self._signal)
        return self

    def __exit__(self, *_):
        self._clear()
        for number, handler in self._handlers.items():
            signal.signal(number, handler)

    def _signal(self, number, _frame):
        if self.stop is not None:
            self.on_second_signal()
            os._exit(128 + number)
        self.stop = number
        self._write("stopping")

    def check(self):
        """Raises Stopped if a stop was asked for."""
        if self.stop is not None:
            raise Stopped

    @contextlib.contextmanager
    def stage(self, name):
        """Times what happens inside and announces it."""
        self.check()
        self._stage = name
        self._begin = self._last = time.monotonic()
        self._write(name, line=True)
        try:
            yield
        finally:
            spent = time.monotonic() - self._begin
            self.seconds[name] = self.seconds.get(name, 0.0) + spent
        self.check()

    @contextlib.contextmanager
    def filter(self, algorithm, foretold=False):
        """Shows the progress of `algorithm` while it runs, and stops it when asked to; with
        `foretold` also what it says that it will take, as soon as it does."""

        def report(caller, _event):
            if self.stop is not None:
                caller.SetAbortExecute(1)
                return
            now = time.monotonic()
            if now - self._last < (0.1 if self._live else 10.0):
                return
            self._last = now
            text = caller.GetProgressText()
            what = f"{self._stage}: {text}" if text else self._stage
            self._write(f"{what} {100.0 * caller.GetProgress():3.0f} %, "
                        f"{now - self._begin:.1f} s", line=True)

        def predicted(caller, _event):
            self.note(f"{self._stage}: {foretell(caller)}")

        tags = [algorithm.AddObserver("ProgressEvent", report)]
        if foretold:
            tags.append(algorithm.AddObserver(algorithm.PredictedEvent, predicted))
        try:
            yield
        finally:
            for tag in tags:
                algorithm.RemoveObserver(tag)

    def note(self, text):
        """A line that stays."""
        if self.quiet:
            return
        self._clear()
        self.stream.write(text + "\n")
        self.stream.flush()

    def _write(self, text, line=False):
        if self.quiet:
            return
        if self._live:
            width = os.get_terminal_size(self.stream.fileno()).columns - 1
            text = text[:width]
            self.stream.write("\r" + text + " " * (self._shown - len(text)))
            self._shown = len(text)
        elif line:
            self.stream.write(text + "\n")
        self.stream.flush()

    def _clear(self):
        if self._live and self._shown:
            self.stream.write("\r" + " " * self._shown + "\r")
            self.stream.flush()
            self._shown = 0
