#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The parity table: how far the picture is from the lighting model on the CPU, feature by feature.

    /usr/bin/python3 benchmarks/parity.py [--build build]

Runs the test TestRenderingParity on a display of its own, keeps its figures in
benchmarks/results/parity.json and writes them into docs/rendering/parity.md between
<!-- parity: table --> and <!-- end -->.
"""
import argparse
import json
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
RESULT = os.path.join(ROOT, "benchmarks", "results", "parity.json")
PAGE = os.path.join(ROOT, "docs", "rendering", "parity.md")


def measure(build):
    raw = RESULT + ".part"
    test = os.path.join(build, "bin", "TestRenderingParity")
    display = os.path.join(ROOT, "tests", "display.py")
    outcome = subprocess.run([sys.executable, display, test, "--gtest_brief=1"], cwd=ROOT,
                             env=dict(os.environ, RADIOMETRY_PARITY_JSON=raw), check=False)
    with open(raw, encoding="utf-8") as file:
        data = json.load(file)
    os.remove(raw)
    data["passed"] = outcome.returncode == 0
    data["commit"] = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, text=True,
                                    capture_output=True, check=False).stdout.strip()
    with open(RESULT, "w", encoding="utf-8") as file:
        json.dump(data, file, indent=1)
        file.write("\n")
    return data


def table(data):
    rows = data["rows"]
    features = list(dict.fromkeys(row["feature"] for row in rows))
    features.sort(key=lambda name: name == "random combinations")  # last
    lines = [f"Commit {data['commit']}, {data['renderer']}, pictures of {data['size']}² pixels"
             + ("." if data["passed"] else "; **the test failed**."), "",
             "| feature | scenes | pixels | above 1 | flat | Gouraud | Phong "
             "| values held to their conditioning (most of it used) |",
             "|---|---|---|---|---|---|---|---|"]
    total = {"scenes": 0, "pixels": 0, "above_one": 0, "ill_conditioned": 0}
    for feature in features:
        own = {row["shading"]: row for row in rows if row["feature"] == feature}
        sums = {key: sum(row[key] for row in own.values()) for key in total}
        for key, value in sums.items():
            total[key] += value
        used = max(row["worst_conditioned"] for row in own.values())
        conditioned = (f"{sums['ill_conditioned']} ({used:.0%})" if sums["ill_conditioned"] else "0")
        worst = " | ".join(f"{own[s]['worst']:.1e}" for s in ("Flat", "Gouraud", "Phong"))
        lines.append(f"| {feature} | {sums['scenes']} | {sums['pixels']} | {sums['above_one']} "
                     f"| {worst} | {conditioned} |")
    lines.append(f"| **all** | {total['scenes']} | {total['pixels']} | {total['above_one']} "
                 f"| | | | {total['ill_conditioned']} |")
    return "\n".join(lines) + "\n"


def write(text):
    with open(PAGE, encoding="utf-8") as file:
        page = file.read()
    mark = re.compile(r"(<!-- parity: table -->\n)(?:.*?\n)??(<!-- end -->)", re.DOTALL)
    if not mark.search(page):
        raise SystemExit(f"{PAGE} has no place for the table")
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(mark.sub(lambda m: m.group(1) + text + m.group(2), page))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--build", default=os.path.join(ROOT, "build"), help="the build folder")
    options = parser.parse_args()
    data = measure(os.path.abspath(options.build))
    write(table(data))
    return 0 if data["passed"] else 1


if __name__ == "__main__":
    sys.exit(main())
