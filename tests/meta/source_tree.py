# SPDX-License-Identifier: BSD-3-Clause
"""The files of the source tree, for the checks beside this file."""
import os
import subprocess
import sys

ROOT = os.environ.get("RADIOMETRY_SOURCE_DIR") or os.path.normpath(
    os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
)


def files(root=ROOT):
    """Paths relative to `root`: what git tracks, or every file where there is no git."""
    try:
        listing = subprocess.run(
            ["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
            capture_output=True,
            check=True,
        ).stdout.decode()
        found = [name for name in listing.split("\0") if name]
        if found:
            return sorted(name for name in found if os.path.isfile(os.path.join(root, name)))
    except (OSError, subprocess.CalledProcessError):
        pass
    found = []
    for folder, folders, names in os.walk(root):
        folders[:] = [
            f for f in folders if not f.startswith(("build", "out", ".git", "__pycache__"))
        ]
        found += [os.path.relpath(os.path.join(folder, name), root) for name in names
                  if name != ".git"]  # a worktree's is a file
    return sorted(found)


def text(path, root=ROOT):
    """The file's text, or None for a binary file."""
    with open(os.path.join(root, path), "rb") as stream:
        data = stream.read()
    if b"\0" in data:
        return None
    return data.decode("utf-8", errors="replace")


def finish(problems):
    """Prints the problems, one a line, and exits with the test's status."""
    for problem in problems:
        print(problem)
    sys.exit(1 if problems else 0)
