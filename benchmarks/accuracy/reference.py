#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the cells of the scenes with reflections and without a closed form really get: Mitsuba 3 in batches
of their own seeds, kept in benchmarks/results/reference-SCENE.npz, to which each run adds.

    ./run --python benchmarks/accuracy/reference.py --site DIR --seconds 600 [--only SCENE] [--threads 1]

Particles in closed rooms, paths where most light misses the scene. A file is of one scene's numbers, whose
hash stands in it; one of another scene is begun anew.
"""
import argparse
import hashlib
import os
import sys
import time

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from accuracy.scenes import ROOT, scene  # noqa: E402

WAYS = {"gallery": ("paths", 256), "cornell-box": ("particles", 1 << 22),
        "street-canyon": ("paths", 1024)}
FIRST_SEED = 1 << 20  # beyond those of the runs that are judged


def path_of(key):
    return os.path.join(ROOT, "benchmarks", "results", f"reference-{key}.npz")


def fingerprint(one):
    text = hashlib.sha256()
    blockers = [body.points for body in one.blockers]
    places = [] if one.sensors is None else [one.sensors, one.normals]
    for values in (one.corners, one.reflectance, one.exitance, one.two_sided, *places, *blockers):
        text.update(np.round(np.asarray(values, float), 9).tobytes())
    for lamp in one.lamps:
        text.update(repr((lamp.kind, lamp.intensity, lamp.position, lamp.direction)).encode())
        text.update(b"" if lamp.corners is None else lamp.corners.tobytes())
    return text.hexdigest()[:16]


def load(one):
    """Sums over the batches, or none."""
    try:
        with np.load(path_of(one.key)) as data:
            if str(data["scene"]) == fingerprint(one):
                return {name: data[name] for name in data.files}
    except FileNotFoundError:
        pass
    return None


def reference(one):
    """Mean, its standard error, samples, and the program; None where there is no file."""
    data = load(one)
    if data is None:
        return None
    count = int(data["batches"])
    mean = data["total"] / count
    spread = np.sqrt(np.maximum(data["squares"] / count - mean**2, 0.0) / (count - 1))
    return mean, spread, int(data["samples"]) * count, str(data["program"])


def extend(key, seconds, threads):
    from accuracy.mitsuba3 import Mitsuba
    one = scene(key)
    way, samples = WAYS[key]
    mitsuba = Mitsuba(way).set_threads(threads)
    mitsuba.build(one)
    data = load(one) or {"total": 0.0, "squares": 0.0, "batches": 0}
    begin = time.monotonic()
    while True:
        count = int(data["batches"])
        values = mitsuba.estimate(one, samples, FIRST_SEED + 104729 * count)
        data = {"total": data["total"] + values, "squares": data["squares"] + values**2,
                "batches": count + 1, "samples": samples, "scene": fingerprint(one),
                "program": f"Mitsuba {mitsuba.version}, {way}"}
        if time.monotonic() - begin > seconds and count > 8:
            break
    part = path_of(key) + ".part.npz"
    np.savez_compressed(part, **data)
    os.replace(part, path_of(key))
    mean, spread, number, program = reference(one)
    lit = mean > 0.01 * mean.max(0)
    print(f"{key}: {program}, {number:.2e} samples, standard error "
          f"{100 * np.sqrt(((spread / np.maximum(mean, 1e-300))[lit]**2).mean()):.3f} % RMS", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--site", help="folder that holds mitsuba")
    parser.add_argument("--seconds", type=float, default=60.0, help="a scene")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--only", default="", help="part of the scenes' names")
    options = parser.parse_args()
    if options.site:
        sys.path.append(options.site)
    for key in WAYS:
        if options.only in key:
            extend(key, options.seconds, options.threads)


if __name__ == "__main__":
    main()
