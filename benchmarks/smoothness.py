#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Question: what does smoothness cost? Flat, Gouraud and Phong shading: picture, error and time of each.

A jug (a curved, glossy surface) and a floor under a near light and a spot (flat, with light that varies)
are drawn at several resolutions of their meshes, in each shading, into a float target. The error is
against Phong shading of the finest mesh with exact normals: RMS and greatest over the pixels that both
pictures cover, relative to the mean of the reference. The time of a frame is the lower quartile over the
frames of the processor's time of the process (llvmpipe's threads included), as in frame_time.py.
The last figure compares vertex normals: weights of the faces around a point, and creases.

    ./run --python benchmarks/smoothness.py [--size 480] [--frames 12]

Writes benchmarks/results/smoothness.json, docs/images/smoothness-*.png and the tables of
docs/rendering/smoothness.md between <!-- smoothness: NAME --> and <!-- end -->.
"""
import argparse
import json
import math
import os
import re
import sys
import time

import matplotlib
import matplotlib.ticker
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests"))
sys.path.insert(0, os.path.join(ROOT, "tests", "rendering"))
sys.path.insert(0, os.path.join(ROOT, "benchmarks"))
from drawing import Window, lights, polydata  # noqa: E402
from provenance import provenance  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkPolyData  # noqa: E402
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkDelaunay3D  # noqa: E402
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter  # noqa: E402
from vtkradiometry.vtkRadiometryFilters import vtkVertexNormalsFilter  # noqa: E402

SHADINGS = ("Flat", "Gouraud", "Phong")
COLOURS = {"Flat": "#7d8597", "Gouraud": "#d68910", "Phong": "#2471a3"}


def patch(n, m, place, normal):
    """A grid of n x m squares over the unit square of (u, v), as a surface with its own normals."""
    u, v = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, m + 1), indexing="ij")
    points = np.stack(place(u, v), axis=-1).reshape(-1, 3)
    normals = np.stack(normal(u, v), axis=-1).reshape(-1, 3)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    cells = []
    for i in range(n):
        for j in range(m):
            a = i * (m + 1) + j
            b = a + m + 1
            cells += [(a, b, b + 1), (a, b + 1, a + 1)]
    p, q, r = points[list(cells[n * m // 2])]
    if np.dot(np.cross(q - p, r - p), normals[cells[n * m // 2][0]]) < 0:
        cells = [cell[::-1] for cell in cells]  # fronts on the side of the normals
    return polydata(points, cells, normals)


def jug(n):
    """A body of revolution and a handle: n squares around the body."""
    def radius(v):
        return 0.40 + 0.20 * np.sin(3.6 * v) * (1 - 0.35 * v) - 0.10 * v

    def slope(v, h=1e-6):
        return (radius(v + h) - radius(v - h)) / (2 * h)

    height = 1.5
    body = patch(
        n, max(n // 2, 3),
        lambda u, v: (radius(v) * np.cos(2 * np.pi * u), radius(v) * np.sin(2 * np.pi * u),
                      height * (v - 0.5)),
        lambda u, v: (height * np.cos(2 * np.pi * u), height * np.sin(2 * np.pi * u), -slope(v)))
    large, small = 0.36, 0.06

    def ring(u, v):
        a, b = np.pi * (1.0 * u - 0.5), 2 * np.pi * v
        return a, b

    def on_handle(u, v):
        a, b = ring(u, v)
        r = large + small * np.cos(b)
        return 0.42 + 0.85 * r * np.cos(a), small * np.sin(b), 0.08 + r * np.sin(a)

    def handle_normal(u, v):
        a, b = ring(u, v)
        return np.cos(b) * np.cos(a) / 0.85, np.sin(b), np.cos(b) * np.sin(a)

    handle = patch(max(n // 2, 4), max(n // 4, 3), on_handle, handle_normal)
    append = vtkAppendPolyData()
    append.AddInputData(body)
    append.AddInputData(handle)
    append.Update()
    return append.GetOutput()


def floor(n):
    return patch(n, n, lambda u, v: (2 * u - 1, 2 * v - 1, 0 * u), lambda u, v: (0 * u, 0 * u, 0 * u + 1))


SCENES = {
    "jug": {
        "make": jug, "meshes": (8, 16, 32, 64, 128), "shown": (8, 32), "finest": 512,
        "lights": [{"Position": (1.5, -2.0, 2.0), "Intensity": (16, 15, 13)},
                   {"LightType": 2, "Direction": (1.0, 0.6, -0.5), "Intensity": (0.7, 0.9, 1.3)}],
        "eye": (1.1, -4.0, 1.6), "scale": 0.92, "specular": 0.25, "shininess": 40,
        "color": (0.55, 0.32, 0.22)},
    "floor": {
        "make": floor, "meshes": (1, 4, 16, 64, 256), "shown": (1, 16), "finest": 512,
        "lights": [{"Position": (-0.45, 0.1, 0.25), "Intensity": (0.5, 0.45, 0.35)},
                   {"LightType": 1, "Position": (0.9, -0.9, 1.2), "Direction": (-0.5, 0.6, -1.2),
                    "SpotCutoff": 22, "SpotInnerCutoff": 16, "Intensity": (5, 7, 9)}],
        "eye": (0.0, -3.0, 3.2), "scale": 0.86, "specular": 0.0, "shininess": 10,
        "color": (0.7, 0.7, 0.7)},
}


class Stage:
    """One window for all pictures of a scene."""

    def __init__(self, scene, size):
        self.scene = scene
        self.w = Window(size=size)
        w = self.w
        w.mapper.SetLightData(lights(*scene["lights"]))
        w.actor.GetProperty().SetColor(*scene["color"])
        w.actor.GetProperty().SetSpecular(scene["specular"])
        w.actor.GetProperty().SetSpecularPower(scene["shininess"])
        camera = w.renderer.GetActiveCamera()
        camera.SetPosition(*scene["eye"])
        camera.SetViewUp(0, 0, 1)
        camera.SetParallelScale(scene["scale"])

    def draw(self, surface, shading):
        self.w.mapper.SetInputDataObject(surface)
        getattr(self.w.mapper, "SetShadingTo" + shading)()
        return self.w.draw()

    def milliseconds(self, frames):
        """Of a frame of what was drawn last; the camera nods so that nothing is kept."""
        spent = []
        camera = self.w.renderer.GetActiveCamera()
        for i in range(frames + 2):
            camera.Azimuth(0.5 if i % 2 else -0.5)
            begin = time.process_time()
            self.w.window.Render()
            self.w.target.GetColor()  # waits for the frame
            spent.append(time.process_time() - begin)
        return 1e3 * float(np.percentile(spent[2:], 25))


def errors(picture, reference):
    both = (picture[:, :, 3] == 1) & (reference[:, :, 3] == 1)
    mean = reference[both][:, :3].mean()
    off = (picture - reference)[:, :, :3]
    off[~both] = 0
    return off, {"rms": float(np.sqrt((off[both] ** 2).mean()) / mean),
                 "greatest": float(np.abs(off).max() / mean), "mean": float(mean)}


def encoded(picture, white):
    """For print: scene-linear over white through sRGB's curve, on a grey page."""
    x = np.clip(picture[:, :, :3] / white, 0, 1)
    x = np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)
    return np.where(picture[:, :, 3:] > 0, x, 0.16)[::-1]


def measure(name, size, frames):
    scene = SCENES[name]
    stage = Stage(scene, size)
    reference = stage.draw(scene["make"](scene["finest"]), "Phong")
    rows, shown = [], {}
    for n in scene["meshes"]:
        surface = scene["make"](n)
        for shading in SHADINGS:
            picture = stage.draw(surface, shading)
            off, values = errors(picture, reference)
            rows.append({"scene": name, "squares": n, "triangles": surface.GetNumberOfCells(),
                         "shading": shading, "milliseconds": stage.milliseconds(frames), **values})
            if n in scene["shown"]:
                shown[n, shading] = picture, off, rows[-1]
            print(rows[-1], flush=True)
    return rows, shown, reference


def save(figure, name):
    figure.savefig(os.path.join(ROOT, "docs", "images", f"smoothness-{name}.png"), dpi=100)
    plt.close(figure)


def draw_pictures(name, shown, reference):
    meshes = SCENES[name]["shown"]
    white = float(np.percentile(reference[reference[:, :, 3] == 1][:, :3], 99.7))
    mean = shown[meshes[0], "Phong"][2]["mean"]
    figure, axes = plt.subplots(3, 4, figsize=(12.6, 10.2), layout="constrained")
    image = None
    for i, shading in enumerate(SHADINGS):
        for j, n in enumerate(meshes):
            picture, off, row = shown[n, shading]
            left, right = axes[i][2 * j], axes[i][2 * j + 1]
            left.imshow(encoded(picture, white))
            left.set_title(f"{shading}, {row['triangles']} triangles", fontsize=11)
            signed = np.where(picture[:, :, 3] == 1, off.mean(axis=2) / mean, np.nan)
            image = right.imshow(signed[::-1], cmap="RdBu_r", vmin=-0.5, vmax=0.5)
            right.set_title(f"its error: RMS {row['rms']:.2g}, greatest {row['greatest']:.2g}",
                            fontsize=10)
            right.set_facecolor("0.85")
    for ax in axes.flat:
        ax.set_xticks([])
        ax.set_yticks([])
    bar = figure.colorbar(image, ax=axes, shrink=0.5, location="right")
    bar.set_label("(picture − reference)/mean of the reference")
    save(figure, name)


def draw_cost(rows):
    figure, axes = plt.subplots(1, 2, figsize=(10.5, 4.6), layout="constrained")
    for ax, name in zip(axes, SCENES):
        for shading in SHADINGS:
            own = [r for r in rows if r["scene"] == name and r["shading"] == shading]
            ax.loglog([r["milliseconds"] for r in own], [r["rms"] for r in own], "o-",
                      color=COLOURS[shading], label=shading)
            for r in own:
                ax.annotate(f"{r['triangles']}", (r["milliseconds"], r["rms"]), fontsize=7,
                            xytext=(4, 3), textcoords="offset points", color=COLOURS[shading])
        ax.set_title(f"{name} (numbers: triangles)")
        ax.set_xlabel("time of a frame [ms]")
        ax.set_ylabel("RMS error/mean of the reference")
        ax.grid(True, which="both", lw=0.3)
        ax.xaxis.set_major_formatter(matplotlib.ticker.ScalarFormatter())
        ax.xaxis.set_minor_formatter(matplotlib.ticker.ScalarFormatter())
        ax.tick_params(axis="x", which="minor", labelsize=7)
        ax.legend()
    save(figure, "cost")


def uneven_cube():
    """A cube whose faces are cut into triangles in uneven ways: fans of one corner and strips."""
    h = 0.6
    points, cells = [], []
    for axis in range(3):
        for sign in (-1, 1):
            first = len(points)
            u, v = (axis + 1) % 3, (axis + 2) % 3
            corners = []
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                p = [0.0, 0.0, 0.0]
                p[axis], p[u], p[v] = sign * h, a * h, b * h
                corners.append(p)
            if sign < 0:
                corners.reverse()
            points += corners
            # One face in four triangles around a point near a corner, the others in two.
            if axis == 0 and sign > 0:
                points.append(list(0.8 * np.array(corners[1]) + 0.2 * np.mean(corners, axis=0)))
                middle = first + 4
                cells += [(first + i, first + (i + 1) % 4, middle) for i in range(4)]
            else:
                cells += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    return polydata(points, cells)


def with_normals(surface, weighting=0, splitting=False, angle=30.0, merge=True):
    bare = vtkPolyData()
    bare.SetPoints(surface.GetPoints())
    bare.SetPolys(surface.GetPolys())
    make = vtkVertexNormalsFilter()
    make.SetInputDataObject(bare)
    make.SetWeighting(weighting)
    make.SetSplitting(splitting)
    make.SetFeatureAngle(angle)
    make.SetMergePoints(merge)
    make.Update()
    result = vtkPolyData()
    result.ShallowCopy(make.GetOutput())
    return result


def uneven_ball(seed=5, n=260):
    """A sphere with points crowded on one side: triangles of all sizes beside each other."""
    rng = np.random.default_rng(seed)
    z = 2 * rng.random(n) ** 2.2 - 1
    phi = 2 * np.pi * rng.random(n)
    s = np.sqrt(1 - z * z)
    cloud = polydata(0.85 * np.stack((s * np.cos(phi), z, s * np.sin(phi)), axis=1), [])
    hull = vtkDelaunay3D()
    hull.SetInputDataObject(cloud)
    skin = vtkGeometryFilter()
    skin.SetInputConnection(hull.GetOutputPort())
    skin.Update()
    out = skin.GetOutput()
    points = np.array([out.GetPoint(i) for i in range(out.GetNumberOfPoints())])
    cells = []
    for c in range(out.GetNumberOfCells()):
        ids = [out.GetCell(c).GetPointId(k) for k in range(3)]
        a, b, d = points[ids]
        cells.append(ids if np.dot(np.cross(b - a, d - a), a + b + d) > 0 else ids[::-1])
    return polydata(points, cells, points / np.linalg.norm(points, axis=1, keepdims=True))


def degrees_off(surface):
    """Of the normals of a sphere about the origin: RMS and greatest angle to the exact ones."""
    normals = surface.GetPointData().GetNormals()
    angles = []
    for i in range(surface.GetNumberOfPoints()):
        p = np.array(surface.GetPoint(i))
        c = np.dot(p / np.linalg.norm(p), normals.GetTuple3(i))
        angles.append(math.degrees(math.acos(min(1.0, c))))
    return float(np.sqrt(np.mean(np.square(angles)))), float(np.max(angles))


def draw_normals(size):
    look = {"lights": [{"LightType": 2, "Direction": (-0.3, 0.7, -0.75), "Intensity": (2.2,) * 3},
                       {"LightType": 2, "Direction": (0.9, 0.3, 0.2), "Intensity": (0.5,) * 3}],
            "eye": (1.4, -3.6, 1.9), "scale": 1.05, "specular": 0.3, "shininess": 40,
            "color": (0.45, 0.5, 0.55)}
    stage = Stage(look, size)
    ball, cube = uneven_ball(), uneven_cube()
    weights = (("by angle", 0), ("by area", 1), ("uniform", 2))
    rows, table = [("exact normals", ball)], []
    for label, weighting in weights:
        made = with_normals(ball, weighting)
        rms, greatest = degrees_off(made)
        table.append({"weight": label, "rms": rms, "greatest": greatest})
        rows.append((f"{label}: {rms:.1f}° RMS, {greatest:.0f}° at most", made))
    cubes = [("angle, no crease", with_normals(cube, 0)), ("area, no crease", with_normals(cube, 1)),
             ("uniform, no crease", with_normals(cube, 2)),
             ("angle, crease 30°", with_normals(cube, 0, splitting=True))]
    figure, axes = plt.subplots(2, 4, figsize=(12.6, 6.6), layout="constrained")
    for line, shapes in zip(axes, (rows, cubes)):
        for ax, (label, surface) in zip(line, shapes):
            ax.imshow(encoded(stage.draw(surface, "Phong"), 0.9))
            ax.set_title(label, fontsize=11)
            ax.set_xticks([])
            ax.set_yticks([])
    figure.suptitle("Vertex normals under Phong shading: an unevenly cut sphere, an unevenly cut cube")
    save(figure, "normals")
    return table


def cost_table(data):
    lines = [f"Commit {data['commit']}, {data['processor']}, load {data['load']:.0f} when it began; "
             f"pictures of {data['size']}² pixels.", "",
             "| scene | triangles | shading | RMS error | greatest error | time of a frame |",
             "|---|---|---|---|---|---|"]
    for r in data["rows"]:
        lines.append(f"| {r['scene']} | {r['triangles']} | {r['shading']} | {r['rms']:.2g} "
                     f"| {r['greatest']:.2g} | {r['milliseconds']:.1f} ms |")
    return "\n".join(lines) + "\n"


def normals_table(data):
    lines = ["| weight of a face at its corner | RMS off the exact normal | greatest |", "|---|---|---|"]
    for r in data["normals"]:
        lines.append(f"| {r['weight']} | {r['rms']:.2f}° | {r['greatest']:.1f}° |")
    return "\n".join(lines) + "\n"


def write_page(tables):
    path = os.path.join(ROOT, "docs", "rendering", "smoothness.md")
    with open(path, encoding="utf-8") as file:
        page = file.read()
    for name, text in tables.items():
        mark = re.compile(rf"(<!-- smoothness: {name} -->\n)(?:.*?\n)??(<!-- end -->)", re.DOTALL)
        if not mark.search(page):
            raise SystemExit(f"{path} has no place for {name}")
        page = mark.sub(lambda m, t=text: m.group(1) + t + m.group(2), page)
    with open(path, "w", encoding="utf-8") as file:
        file.write(page)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--size", type=int, default=480)
    parser.add_argument("--frames", type=int, default=12)
    options = parser.parse_args()
    data = {"question": "what smoothness costs: flat, Gouraud, Phong", **provenance(),
            "size": options.size, "rows": []}
    for name in SCENES:
        rows, shown, reference = measure(name, options.size, options.frames)
        data["rows"] += rows
        draw_pictures(name, shown, reference)
    draw_cost(data["rows"])
    data["normals"] = draw_normals(options.size)
    path = os.path.join(ROOT, "benchmarks", "results", "smoothness.json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump(data, file, indent=1)
        file.write("\n")
    write_page({"cost": cost_table(data), "normals": normals_table(data)})


if __name__ == "__main__":
    main()
