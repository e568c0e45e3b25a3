#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Question: what does a 4k picture cost as an OpenEXR file?

R, G, B and Z of 3840 x 2160 pixels (smooth, with 1 % of noise) through vtkOpenEXRWriter and
vtkOpenEXRReader, and for a sense of scale through exrmaketiled, a tool of the OpenEXR library's own that
reads the same file and writes it again, in one thread. Seconds are the clock's, the least of --repeat;
files are in a temporary folder (the page cache).

    ./run --python benchmarks/exr_4k.py [--repeat 3]

Writes benchmarks/results/exr-4k.json.
"""
import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

import vtkradiometry as vr

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from provenance import provenance, write  # noqa: E402

WIDTH, HEIGHT = 3840, 2160
PACKINGS = {"none": 0, "zip": 3, "piz": 4, "dwaa": 8}


def picture():
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
    noise = np.random.default_rng(1).random((HEIGHT, WIDTH))
    rgb = np.stack([np.sin(x / 300) + 1.2 + 0.02 * noise, np.cos(y / 200) + 1.2, 0.5 + 0 * x], -1)
    image = vtkImageData()
    image.SetDimensions(WIDTH, HEIGHT, 1)
    for name, values in (("RGB", rgb.reshape(-1, 3)), ("Z", (x + 0.5 * y).ravel())):
        array = numpy_to_vtk(np.ascontiguousarray(values, dtype=np.float32), deep=True)
        array.SetName(name)
        image.GetPointData().AddArray(array)
    return image


def least(repeat, action):
    seconds = []
    for _ in range(repeat):
        begin = time.monotonic()
        action()
        seconds.append(time.monotonic() - begin)
    return min(seconds)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--repeat", type=int, default=3)
    options = parser.parse_args()
    image = picture()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "picture.exr")
        for pixel_type, word in ((1, "float"), (0, "half")):
            for packing, number in PACKINGS.items():
                writer = vr.vtkOpenEXRWriter()
                writer.SetInputData(image)
                writer.SetFileName(name)
                writer.SetPixelType(pixel_type)
                writer.SetCompression(number)

                def read():
                    reader = vr.vtkOpenEXRReader()
                    reader.SetFileName(name)
                    reader.Update()

                row = {"pixels": word, "compression": packing,
                       "writeSeconds": least(options.repeat, writer.Write),
                       "readSeconds": least(options.repeat, read),
                       "mebibytes": os.path.getsize(name) / 2**20}
                if shutil.which("exrmaketiled"):
                    command = ["exrmaketiled", "-z", packing, "-t", "64", "64", name,
                               os.path.join(folder, "tiled.exr")]
                    row["toolReadWriteSeconds"] = least(
                        options.repeat, lambda: subprocess.run(command, check=True))
                rows.append(row)
                print(row, file=sys.stderr)
    write("exr-4k", {"question": "a 4k picture as an OpenEXR file", **provenance(),
                     "width": WIDTH, "height": HEIGHT, "channels": 4,
                     "cores": len(os.sched_getaffinity(0)), "rows": rows})


if __name__ == "__main__":
    main()
