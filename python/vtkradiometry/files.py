# SPDX-License-Identifier: BSD-3-Clause
"""Output files that appear whole or not at all.

Every file is first written into a hidden folder beside its destination; when all are complete they
are renamed into place, which the file system does in one step each.
"""
import os
import shutil


class OutputFolder:
    """Collects a run's files aside and moves them into `folder` at the end.

    >>> with OutputFolder("out") as output:          # doctest: +SKIP
    ...     write(output.path("scene.png", "the picture"))
    ...     output.publish()

    Leaving the block without `publish()` (an error, Ctrl-C) removes everything that was begun, and
    the folder too if this run made it.
    """

    def __init__(self, folder):
        self.folder = os.path.abspath(folder)
        self.aside = os.path.join(self.folder, f".vtkradiometry-{os.getpid()}")
        self.files = []  # (name, description)
        self._made = []

    def __enter__(self):
        path = self.folder
        missing = []
        while not os.path.isdir(path):
            if os.path.lexists(path):
                raise NotADirectoryError(f"{path} is not a folder")
            missing.append(path)
            path = os.path.dirname(path)
        try:
            for path in reversed(missing):
                os.mkdir(path)
                self._made.append(path)
            self._remove_abandoned()
            os.mkdir(self.aside)
        except OSError:
            self._clean()
            raise
        return self

    def __exit__(self, kind, value, trace):
        self._clean()
        return False

    def path(self, name, description):
        """Where to write the file `name` for now; `description` is what the user is told it is."""
        self.files.append((name, description))
        return os.path.join(self.aside, name)

    def publish(self):
        """Moves every file into place and returns [(path, description)]."""
        published = []
        for name, description in self.files:
            source = os.path.join(self.aside, name)
            if not os.path.isfile(source):
                raise FileNotFoundError(f"{name} was not written")
        for name, description in self.files:
            target = os.path.join(self.folder, name)
            os.replace(os.path.join(self.aside, name), target)
            published.append((target, description))
        self._made = []
        return published

    def _clean(self):
        shutil.rmtree(self.aside, ignore_errors=True)
        for path in reversed(self._made):
            try:
                os.rmdir(path)
            except OSError:
                break
        self._made = []

    def _remove_abandoned(self):
        """Folders of runs that were killed outright."""
        for name in os.listdir(self.folder):
            prefix, _, process = name.partition("-")
            if prefix != ".vtkradiometry" or not process.isdigit():
                continue
            try:
                os.kill(int(process), 0)
            except ProcessLookupError:
                shutil.rmtree(os.path.join(self.folder, name), ignore_errors=True)
            except PermissionError:
                pass
