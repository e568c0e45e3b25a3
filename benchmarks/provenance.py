# SPDX-License-Identifier: BSD-3-Clause
"""Where a result comes from, and how it is put into benchmarks/results: whole or not at all."""
import json
import os
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def processor():
    with open("/proc/cpuinfo", encoding="ascii", errors="replace") as file:
        return next((line.split(":")[1].strip() for line in file if "model name" in line), "unknown")


def provenance():
    found = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"],
                           capture_output=True, check=False)
    return {"commit": found.stdout.decode().strip(), "processor": processor(),
            "load": os.getloadavg()[0]}


def path_of(name):
    """benchmarks/results/NAME.json, or NAME itself where it is a path."""
    return name if os.sep in name else os.path.join(ROOT, "benchmarks", "results", name + ".json")


def result(name):
    """What stands there; None where nothing does."""
    try:
        with open(path_of(name), encoding="utf-8") as file:
            return json.load(file)
    except FileNotFoundError:
        return None


def write(name, out):
    path = path_of(name)
    with open(path + ".part", "w", encoding="utf-8") as file:
        json.dump(out, file, indent=1)
        file.write("\n")
    os.replace(path + ".part", path)
    print(path)
