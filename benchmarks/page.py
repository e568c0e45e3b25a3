#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes docs/accuracy.md from benchmarks/results/*.json and the words of benchmarks/pages/accuracy.md,
and draws its figures.

    /usr/bin/python3 benchmarks/page.py            # page and figures
    /usr/bin/python3 benchmarks/page.py --check    # fails where the page is not what this would write
"""
import argparse
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from pages import coverage, curves, plan, scale  # noqa: E402
from provenance import ROOT, result  # noqa: E402

WORDS = os.path.join(ROOT, "benchmarks", "pages", "accuracy.md")
PAGE = os.path.join(ROOT, "docs", "accuracy.md")
IMAGES = os.path.join(ROOT, "docs", "images")

# What stands for {{name}}: the result that it is made of, the function, the command that measures it.
CURVES = ("accuracy-curves", "benchmarks/accuracy_all SITE PEER_PYTHON curves")
RUNS = ("accuracy-runs", "benchmarks/accuracy_all SITE PEER_PYTHON runs")
CALIBRATION = ("calibration", "benchmarks/record calibration build/bin/calibration")
PIECES = {
    "curves: about": (*CURVES, curves.about),
    "curves: scenes": (*CURVES, curves.scenes),
    "curves: levels": (*CURVES, curves.levels),
    "curves: not the best": (*CURVES, curves.not_the_best),
    "curves: ours": (*CURVES, curves.ours_alone),
    "plan: saving": (*RUNS, plan.saving),
    "plan: saving said": (*RUNS, plan.saving_said),
    "plan: random scenes": ("effect-saving", "benchmarks/record effect-saving build/bin/effect_saving",
                            coverage.random_scenes),
    "plan: instructions": ("effect-instructions",
                           "benchmarks/record effect-instructions /usr/bin/python3 "
                           "benchmarks/effect_instructions.py", coverage.instructions),
    "time: predictions": (*RUNS, lambda _: plan.prediction_table()),
    "time: budgets": (*RUNS, plan.budgets),
    "time: refinement": (*RUNS, plan.refinement),
    "errors: parts": (*RUNS, plan.parts),
    "errors: calibration": (*CALIBRATION, coverage.calibration),
    "errors: calibration said": (*CALIBRATION, coverage.calibration_said),
    "errors: precision": ("float-against-double", "benchmarks/record float-against-double "
                          "build/bin/float_against_double", coverage.precision),
    "cost: direct": ("direct-scaling", "benchmarks/record direct-scaling build/bin/direct_scaling",
                     scale.direct_scaling),
    "cost: machine": ("direct-light", "benchmarks/record direct-light build/bin/direct_light",
                      scale.machine),
    "cost: radiosity": ("radiosity-scaling",
                        "benchmarks/record radiosity-scaling build/bin/radiosity_scaling",
                        scale.radiosity_scaling),
    "cost: million": ("radiosity-million", "./run --python benchmarks/million_cells.py --site SITE",
                      scale.million),
    "cost: relighting": ("radiosity-relighting", "./run --python benchmarks/relighting.py",
                         scale.relighting),
    "factors": ("view-factors", "./run --python benchmarks/view_factors.py --python-of-peer PEER_PYTHON",
                scale.factors),
}


def piece(name):
    source, command, write = PIECES[name]
    data = result(source)
    text = write(data) if data else None
    return text or f"*Not measured yet: `{command}`.*"


def page():
    with open(WORDS, encoding="utf-8") as file:
        words = file.read()
    words = re.sub(r"!\[.*?\]\(images/(.+?)\)\n\n",
                   lambda match: match.group(0) if os.path.exists(os.path.join(IMAGES, match.group(1)))
                   else "", words)  # not drawn yet: not measured
    return re.sub(r"\{\{(.+?)\}\}", lambda match: piece(match.group(1)), words)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--check", action="store_true", help="compare, write nothing")
    parser.add_argument("--no-figures", action="store_true")
    options = parser.parse_args()
    if options.check:
        with open(PAGE, encoding="utf-8") as file:
            if file.read() != page():
                sys.exit("docs/accuracy.md is not what benchmarks/page.py writes from "
                         "benchmarks/results and benchmarks/pages/accuracy.md: run it")
        return
    if not options.no_figures:
        from pages import figures
        figures.draw()
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(page())


if __name__ == "__main__":
    main()
