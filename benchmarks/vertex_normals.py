#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Question: what does each weighting of vertex normals cost, and what does it bring?

An ellipsoid with axes 3 : 2 : 1 in some 1e6 triangles whose sizes and shapes differ (points of a
jittered grid in longitude and latitude, each quad cut along a random diagonal) through
vtkVertexNormalsFilter, beside VTK's vtkPolyDataNormals (uniform weights). With a jitter of 0.2 of the
spacing all triangles face outward, with 0.35 a few are folded over. Seconds are processor time of
Update(), the least of --repeat runs; every filter here runs in one thread. The error is the angle to the
ellipsoid's own normal.

    ./run --python benchmarks/vertex_normals.py [--triangles 1e6] [--repeat 3]

Writes benchmarks/results/vertex-normals.json.
"""
import argparse
import os
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals

import vtkradiometry as vr

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from provenance import provenance, write  # noqa: E402

AXES = np.array([3.0, 2.0, 1.0])


def ellipsoid(triangles, spread, rng):
    """Closed around, open at small caps about the poles."""
    rows = int(np.sqrt(triangles / 4))
    columns = 2 * rows
    u, v = np.meshgrid(np.arange(columns), np.arange(rows + 1))
    jitter = rng.uniform(-spread, spread, (2, *u.shape))
    theta = np.pi * (0.02 + 0.96 * (v + np.where((v > 0) & (v < rows), jitter[0], 0)) / rows)
    phi = 2 * np.pi * (u + jitter[1]) / columns
    points = AXES * np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi),
                              np.cos(theta)], -1).reshape(-1, 3)
    j, i = np.meshgrid(np.arange(columns), np.arange(rows))
    a, b = i * columns + j, i * columns + (j + 1) % columns
    c, d = a + columns, b + columns
    other = rng.random(a.shape) < 0.5
    first = np.where(other[..., None], np.stack([a, c, d], -1), np.stack([a, c, b], -1))
    second = np.where(other[..., None], np.stack([a, d, b], -1), np.stack([b, c, d], -1))
    cells = np.concatenate([first.reshape(-1, 3), second.reshape(-1, 3)])
    data = vtkPolyData()
    where = vtkPoints()
    where.SetData(numpy_to_vtk(points, deep=True))
    data.SetPoints(where)
    polys = vtkCellArray()
    polys.SetData(3, numpy_to_vtkIdTypeArray(cells.astype(np.int64).ravel(), deep=True))
    data.SetPolys(polys)
    inner = ((v > 0) & (v < rows)).ravel()
    normals = points / AXES**2
    return data, inner, normals / np.linalg.norm(normals, axis=1)[:, None]


def measure(make, data, repeat):
    least = np.inf
    for _ in range(repeat):
        f = make()
        f.SetInputData(data)
        begin = time.process_time()
        f.Update()
        least = min(least, time.process_time() - begin)
    return least, vtk_to_numpy(f.GetOutput().GetPointData().GetNormals()).astype(float)


def ours(weighting, **properties):
    def make():
        f = vr.vtkVertexNormalsFilter()
        f.SetWeighting(weighting)
        for name, value in properties.items():
            getattr(f, "Set" + name)(value)
        return f
    return make


def stock(splitting):
    def make():
        f = vtkPolyDataNormals()
        f.SetSplitting(splitting)
        f.ConsistencyOff()
        return f
    return make


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--triangles", type=float, default=1e6)
    parser.add_argument("--repeat", type=int, default=3)
    options = parser.parse_args()
    rows = []
    for spread in (0.2, 0.35):
        data, inner, truth = ellipsoid(options.triangles, spread, np.random.default_rng(6))
        plain = dict(Splitting=False, MergePoints=False)
        for name, make in (
                ("angle", ours(0, **plain)), ("area", ours(1, **plain)),
                ("uniform", ours(2, **plain)),
                ("angle, merged points", ours(0, Splitting=False)),
                ("angle, merged points, creases", ours(0)),
                ("uniform, vtkPolyDataNormals", stock(False)),
                ("uniform, vtkPolyDataNormals, creases", stock(True))):
            seconds, normals = measure(make, data, options.repeat)
            normals = normals[:len(truth)]
            # atan2 keeps small angles exact.
            angle = np.degrees(np.arctan2(np.linalg.norm(np.cross(normals, truth), axis=1),
                                          (normals * truth).sum(1)))[inner]
            rows.append({"jitter": spread, "name": name, "seconds": seconds,
                         "microsecondsPerTriangle": 1e6 * seconds / data.GetNumberOfCells(),
                         "rmsDegrees": float(np.sqrt((angle**2).mean())),
                         "p99Degrees": float(np.quantile(angle, 0.99)),
                         "greatestDegrees": float(angle.max())})
            print(rows[-1], file=sys.stderr)
    write("vertex-normals", {"question": "cost and error of weights of vertex normals",
                             **provenance(), "triangles": data.GetNumberOfCells(), "rows": rows})


if __name__ == "__main__":
    main()
