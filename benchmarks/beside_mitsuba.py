#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Question: does the irradiance of every cell agree with an independent path tracer?

Computes a glTF scene with vtkRadiosityFilter and estimates the same cell averages with Mitsuba 3
(PyPI: mitsuba; 3.5.2 was used): paths from random points of each cell, light straight from emitters
and lights sampled by itself. Diffuse reflection only, as the filter; spot lights are switched off in
both, because Mitsuba's fall off in another way. Prints JSON: the means, the share of cells whose
difference is covered by the filter's error and two standard errors of the reference together.

    ./run --python benchmarks/beside_mitsuba.py SCENE.glb [--edge 0.1] [--samples 2500] ...

Mitsuba is imported from the Python path; `--site DIR` adds a folder (of a virtual environment).
"""
import argparse
import json
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersModeling import vtkAdaptiveSubdivisionFilter

import vtkradiometry as vr

POINT, SPOT, DIRECTIONAL = 0, 1, 2


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("scene")
    parser.add_argument("--edge", type=float, default=0.1, help="greatest edge of a cell, m")
    parser.add_argument("--tolerance", type=float, default=0.01)
    parser.add_argument("--time-budget", type=float, default=60.0)
    parser.add_argument("--method", type=int, default=0)
    parser.add_argument("--samples", type=int, default=2500, help="paths a cell")
    parser.add_argument("--site", help="folder that holds mitsuba")
    return parser.parse_args()


def compute(options):
    """The filter's result as arrays."""
    reader = vr.vtkRadiometricSceneReader()
    reader.SetFileName(options.scene)
    divide = vtkAdaptiveSubdivisionFilter()
    divide.SetInputConnection(reader.GetOutputPort())
    divide.SetMaximumEdgeLength(options.edge)
    divide.SetMaximumTriangleArea(options.edge**2)
    reader.Update()
    lights = reader.GetOutputDataObject(1)
    data = lights.GetPointData()
    for i in range(lights.GetNumberOfPoints()):
        if data.GetArray("LightType").GetComponent(i, 0) == SPOT:
            data.GetArray("LightEnabled").SetComponent(i, 0, 0)
    radiosity = vr.vtkRadiosityFilter()
    radiosity.SetInputConnection(divide.GetOutputPort())
    radiosity.AddLightsData(lights)
    radiosity.SetRelativeTolerance(options.tolerance)
    radiosity.SetTimeBudget(options.time_budget)
    radiosity.SetMethod(options.method)
    divide.Update()
    begin = time.monotonic()
    radiosity.Update()
    seconds = time.monotonic() - begin
    surface = radiosity.GetOutput(0)
    cells = surface.GetCellData()

    def field(name):
        values = vtk_to_numpy(cells.GetArray(name))
        return np.repeat(values[:, None], 3, 1) if values.ndim == 1 else values

    corners = vtk_to_numpy(surface.GetPoints().GetData())[
        vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    places = np.array([lights.GetPoint(i) for i in range(lights.GetNumberOfPoints())]).reshape(-1, 3)
    lamps = [{"kind": int(data.GetArray("LightType").GetComponent(i, 0)), "place": places[i],
              "intensity": np.broadcast_to(vtk_to_numpy(data.GetArray("Intensity"))[i], 3),
              "direction": np.array(data.GetArray("Direction").GetTuple(i))}
             for i in range(len(places)) if data.GetArray("LightEnabled").GetComponent(i, 0)]
    return {"corners": corners.astype(float), "irradiance": field("Irradiance"),
            "error": field("IrradianceError"), "reflectance": field("DiffuseReflectance"),
            "exitance": field("EmittedExitance"),
            "two_sided": vtk_to_numpy(cells.GetArray("TwoSided")) != 0,
            "lamps": lamps, "seconds": seconds,
            "method": surface.GetFieldData().GetAbstractArray("RadiometryMethod").GetValue(0)}


class Reference:
    """The same scene in Mitsuba."""

    def __init__(self, mi, result):
        self.mi, self.result = mi, result
        v = result["corners"]
        normal = np.cross(v[:, 1] - v[:, 0], v[:, 2] - v[:, 0])
        self.area = 0.5 * np.linalg.norm(normal, axis=1)
        self.normal = normal / (2.0 * self.area[:, None])
        self.offset = 2e-6 * np.abs(v - v.mean((0, 1))).max()
        scene = {"type": "scene", "integrator": {"type": "path", "max_depth": 64, "rr_depth": 64}}
        kinds = np.column_stack([result["two_sided"], result["reflectance"], result["exitance"]])
        for number, kind in enumerate(np.unique(kinds, axis=0)):
            scene[f"mesh{number}"] = self.mesh(np.flatnonzero((kinds == kind).all(1)), kind)
        for number, lamp in enumerate(result["lamps"]):
            value = {"type": "rgb", "value": lamp["intensity"].tolist()}
            scene[f"lamp{number}"] = (
                {"type": "point", "position": lamp["place"].tolist(), "intensity": value}
                if lamp["kind"] == POINT else
                {"type": "directional", "direction": lamp["direction"].tolist(), "irradiance": value})
        self.scene = mi.load_dict(scene)

    def mesh(self, cells, kind):
        mi = self.mi
        reflector = {"type": "diffuse",
                     "reflectance": {"type": "rgb", "value": kind[1:4].tolist()}}
        if kind[0]:
            reflector = {"type": "twosided", "inside": reflector}
        properties = mi.Properties()
        properties["bsdf"] = mi.load_dict(reflector)
        if kind[4:7].max() > 0.0:
            properties["emitter"] = mi.load_dict({"type": "area", "radiance": {
                "type": "rgb", "value": (kind[4:7] / np.pi).tolist()}})
        mesh = mi.Mesh("cells", vertex_count=3 * len(cells), face_count=len(cells), props=properties)
        values = mi.traverse(mesh)
        values["vertex_positions"] = self.result["corners"][cells].astype(np.float32).ravel()
        values["faces"] = np.arange(3 * len(cells), dtype=np.uint32)
        values.update()
        return mesh

    def vector(self, kind, values):
        return kind(*values.T.astype(np.float32))

    def hidden(self, origin, toward, length=None):
        mi = self.mi
        ray = mi.Ray3f(self.vector(mi.Point3f, origin), self.vector(mi.Vector3f, toward))
        if length is not None:
            ray.maxt = length
        return np.array(self.scene.ray_test(ray))

    def on(self, cells, rng):
        """Random points of cells."""
        u = rng.random((len(cells), 2))
        root = np.sqrt(u[:, :1])
        v = self.result["corners"][cells]
        return (1 - root) * v[:, 0] + root * (1 - u[:, 1:]) * v[:, 1] + root * u[:, 1:] * v[:, 2]

    def estimate(self, number):
        """One estimate of every cell's irradiance."""
        mi, n = self.mi, self.normal
        count = len(n)
        rng = np.random.default_rng(number)
        point = self.on(np.arange(count), rng)
        origin = point + self.offset * n
        side = np.cross(n, np.where(np.abs(n[:, :1]) > 0.9, [[0, 1, 0]], [[1, 0, 0]]))
        side /= np.linalg.norm(side, axis=1)[:, None]
        u, angle = rng.random((count, 1)), 2 * np.pi * rng.random((count, 1))
        toward = np.sqrt(u) * (np.cos(angle) * side + np.sin(angle) * np.cross(n, side))
        toward += np.sqrt(1 - u) * n
        ray = mi.RayDifferential3f(mi.Ray3f(self.vector(mi.Point3f, origin),
                                            self.vector(mi.Vector3f, toward)))
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(number, count)
        color = self.scene.integrator().sample(self.scene, sampler, ray)[0]
        met = self.scene.ray_intersect(ray)
        emitted = met.emitter(self.scene).eval(met)
        total = np.pi * np.stack([np.array(color[b]) - np.array(emitted[b]) for b in range(3)], 1)

        exitance = self.result["exitance"]
        emitters = np.flatnonzero(exitance.max(1) > 0.0)
        if len(emitters):
            share = self.area[emitters] / self.area[emitters].sum()
            chosen = emitters[rng.choice(len(emitters), count, p=share)]
            way = self.on(chosen, rng) - point
            square = (way**2).sum(1)
            cosines = np.maximum(0, (n * way).sum(1)) * np.maximum(0, -(n[chosen] * way).sum(1))
            kernel = cosines / square**2 * self.area[emitters].sum() / np.pi
            kernel[chosen == np.arange(count)] = 0.0
            end = point + way + self.offset * n[chosen]
            total += (kernel * ~self.hidden(origin, end - origin, 0.9999))[:, None] * exitance[chosen]
        for lamp in self.result["lamps"]:
            if lamp["kind"] == POINT:
                way = lamp["place"] - point
                factor = np.maximum(0, (n * way).sum(1)) / (way**2).sum(1) ** 1.5
                dark = self.hidden(origin, lamp["place"] - origin, 0.9999)
            else:
                way = -lamp["direction"] / np.linalg.norm(lamp["direction"])
                factor = np.maximum(0, n @ way)
                dark = self.hidden(origin, np.broadcast_to(way, n.shape))
            total += (factor * ~dark)[:, None] * lamp["intensity"]
        return total


def main():
    options = arguments()
    if options.site:
        sys.path.append(options.site)
    import mitsuba as mi

    mi.set_variant("llvm_ad_rgb")
    result = compute(options)
    reference = Reference(mi, result)
    total, square = 0.0, 0.0
    begin = time.monotonic()
    for number in range(options.samples):
        estimate = reference.estimate(number)
        total, square = total + estimate, square + estimate**2
    seconds = time.monotonic() - begin
    mean = total / options.samples
    spread = np.sqrt(np.maximum(square / options.samples - mean**2, 0) / (options.samples - 1))
    e, error = result["irradiance"], result["error"]
    weight = reference.area / reference.area.sum()
    covered = np.abs(e - mean) <= np.hypot(error, 2 * spread)
    print(json.dumps({
        "question": "irradiance of each cell beside Mitsuba's paths", "scene": options.scene,
        "cells": len(e), "method": result["method"],
        "mean": (weight @ e).tolist(), "meanError": (weight @ error).tolist(),
        "reference": (weight @ mean).tolist(),
        "referenceStandardError": np.sqrt((weight**2) @ spread**2).tolist(),
        "covered": covered.mean(0).tolist(),
        "medianRelativeError": np.median(error / np.maximum(e, 1e-30), 0).tolist(),
        "medianRelativeReferenceError": np.median(spread / np.maximum(mean, 1e-30), 0).tolist(),
        "seconds": result["seconds"], "referenceSeconds": seconds}, indent=2))


if __name__ == "__main__":
    main()
