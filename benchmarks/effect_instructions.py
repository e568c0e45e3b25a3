# SPDX-License-Identifier: BSD-3-Clause
"""Question: does a scene pay for effects that it does not have?

Instructions, counted by valgrind's callgrind on one thread, of a plain scene of direct light and of a
plain room of radiosity (tests/core/EffectPlainScene.cxx), with the core as it is and compiled without
each effect by itself, and without all of them. Prints JSON.

    cmake --build build --target effect_variants
    effect_instructions.py [BUILD]
"""
import json
import os
import platform
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "core"))

import effect_instructions as instructions  # noqa: E402


def first_line(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.split("\n")[0]


def main():
    build = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "build")
    os.environ["RADIOMETRY_BUILD_DIR"] = os.path.abspath(build)
    prefix = "plain_scene_without_"
    names = sorted(n[len(prefix):] for n in os.listdir(instructions.programs()) if n.startswith(prefix))
    rows = []
    for name in names:
        row = {"left_out": "all of them" if name == "effects" else name}
        for scene in instructions.SCENES:
            full, without, more = instructions.compare(scene, prefix + name)
            row[scene] = {"instructions": full, "without": without, "more": more}
        rows.append(row)
    print(json.dumps({
        "commit": first_line("git", "-C", ROOT, "rev-parse", "--short", "HEAD"),
        "processor": platform.processor() or platform.machine(),
        "valgrind": first_line("valgrind", "--version"),
        "limit": instructions.LIMIT,
        "greatest": max(abs(r[s]["more"]) for r in rows for s in instructions.SCENES),
        "rows": rows}, indent=1))


if __name__ == "__main__":
    main()
