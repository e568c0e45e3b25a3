# SPDX-License-Identifier: BSD-3-Clause
"""A scene without an effect pays nothing for it: the instructions of a plain scene, counted by valgrind's
callgrind, with all effects compiled in and with those compiled out that it does not have, differ by less
than 1 %; and its values are the same.

effect_instructions.py    the programs of tests/core/CMakeLists.txt; status 77 without valgrind
"""
import functools
import os
import re
import shutil
import subprocess
import sys

SCENES = ("direct", "radiosity")
LIMIT = 0.01  # of the instructions


def programs():
    """Folder of the build's programs."""
    return os.path.join(os.environ["RADIOMETRY_BUILD_DIR"], "bin")


@functools.lru_cache(maxsize=None)
def count(program, scene):
    """Instructions of the simulation of a scene, and what the program printed of its values."""
    run = subprocess.run(
        ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
         "--toggle-collect=radiometry_simulate", os.path.join(programs(), program), scene],
        env=os.environ | {"LD_BIND_NOW": "1"}, capture_output=True, text=True, check=True)
    collected = re.search(r"Collected : (\d+)", run.stderr)
    assert collected and int(collected[1]) > 100000, run.stderr
    return int(collected[1]), run.stdout


def compare(scene, program="plain_scene_without_effects"):
    """Instructions as built, those of another build, and by what share the former are more."""
    full, values = count("plain_scene", scene)
    without, same = count(program, scene)
    assert values == same, ("values differ", scene, program, values, same)
    return full, without, full / without - 1.0


def main():
    if not shutil.which("valgrind"):
        print("valgrind is not installed: instructions are not counted")
        return 77
    failed = False
    for scene in SCENES:
        full, without, more = compare(scene)
        print(f"{scene}: {full} instructions, {without} without effects: {100 * more:+.4f} %")
        failed = failed or abs(more) >= LIMIT
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
