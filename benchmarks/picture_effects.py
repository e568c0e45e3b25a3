#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Question: what does the effect plan of a picture save, and what does it change?

A sphere of 2e4 triangles fills a square window and turns by a degree a frame. Each scene is drawn by
vtkPhongGouraudMapper with every effect switched on, with what the scene calls for (Auto, the default),
and with an EffectTolerance of 0.5/255, which Shading Auto (on in all three) shares. Rows take turns, frame by frame; the
figure is the lower quartile over the frames of the processor's time of all threads (frame_time.py says
why). What leaving effects out changes is measured pixel by pixel in a float target, beside the sum of the
bounds of the plan.

    ./run --python benchmarks/picture_effects.py [--frames 30] [--size 500] [--out picture-effects]

Writes benchmarks/results/picture-effects.json and the table of docs/rendering/effects.md.
"""
import argparse
import os
import re
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkradiometry.vtkRadiometryRendering import vtkLinearFloatPass, vtkPhongGouraudMapper

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import frame_time  # noqa: E402
from provenance import provenance, write  # noqa: E402

TOLERANCE = 0.5 / 255
SECONDS = 4.0  # a scene
DECISION = 60.0  # s: the longest that Shading Auto is waited for
ROWS = ("all on", "Auto", "tolerance")


def far_lamps(renderer, count, kind="point"):
    for i in range(count):
        renderer.AddLight(frame_time.light(kind, i, count))


def matte_sun(renderer, mapper, surface):
    far_lamps(renderer, 1, "directional")


def matte_points(renderer, mapper, surface):
    far_lamps(renderer, 8)


def satin(renderer, mapper, surface):
    far_lamps(renderer, 8)
    surface.SetSpecular(1e-4)
    surface.SetSpecularPower(20)


def wide_spots(renderer, mapper, surface):
    for i in range(8):
        lamp = frame_time.light("spot", i, 8)
        lamp.SetConeAngle(60)
        lamp.SetExponent(0)
        renderer.AddLight(lamp)


def dim_legacy(renderer, mapper, surface):
    far_lamps(renderer, 1, "directional")
    for i in range(20):
        lamp = frame_time.light("point", i, 20)
        lamp.SetIntensity(1e-4)
        lamp.SetAttenuationValues(0.5, 0.5, 0.5)
        renderer.AddLight(lamp)


def gloss(renderer, mapper, surface):
    far_lamps(renderer, 8)
    surface.SetSpecular(0.5)
    surface.SetSpecularPower(30)


SCENES = {
    "matte, 1 directional": matte_sun, "matte, 8 points": matte_points,
    "gloss, 8 points": gloss, "hardly any gloss (1e-4), 8 points": satin,
    "8 spots whose cones hold all of it": wide_spots,
    "1 directional, 20 dim points with a fall-off of their own": dim_legacy,
}


class Stage:
    """One scene drawn one way, in the window and in a float target."""

    def __init__(self, scene, row, surface, size):
        self.mapper = vtkPhongGouraudMapper()
        self.mapper.SetInputDataObject(surface)
        self.mapper.SetReflectionModel(1)
        self.mapper.SetEveryEffect(row == "all on")
        self.mapper.SetEffectTolerance(TOLERANCE if row == "tolerance" else 0.0)
        actor = vtkActor()
        actor.SetMapper(self.mapper)
        actor.GetProperty().SetDiffuseColor(0.8, 0.7, 0.6)
        self.renderer = vtkRenderer()
        self.renderer.AddActor(actor)
        self.renderer.AutomaticLightCreationOff()
        SCENES[scene](self.renderer, self.mapper, actor.GetProperty())
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(size, size)
        self.window.AddRenderer(self.renderer)
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(0, 0.4, 1.75)
        camera.SetFocalPoint(0, 0, 0)
        camera.SetViewAngle(35)
        self.renderer.ResetCameraClippingRange()
        begin = time.perf_counter()
        self.draw()
        self.draw()
        while time.perf_counter() - begin < DECISION and (
                "deciding" in self.mapper.GetShadingReason()
                or "frame before" in self.mapper.GetShadingReason()):
            self.draw()
        self.times = []

    def draw(self):
        self.window.Render()
        self.window.WaitForCompletion()

    def frame(self):
        self.renderer.GetActiveCamera().Azimuth(1)
        begin = time.process_time()
        self.draw()
        self.times.append(time.process_time() - begin)

    def light(self):
        """The colours of the window's picture, scene-linear, each pixel lit: the effects alone."""
        target = vtkLinearFloatPass()
        self.renderer.SetPass(target)
        self.mapper.SetShadingToPhong()
        self.draw()
        return vtk_to_numpy(target.GetColor().GetPointData().GetScalars())[:, :3].copy()

    def dropped(self):
        table = self.mapper.GetEffectPlan()
        rows = [{name: table.GetValueByName(r, name) for name in ("Effect", "Decision", "Bound")}
                for r in range(table.GetNumberOfRows())]
        return {row["Effect"].ToString(): row["Bound"].ToDouble() for row in rows
                if row["Decision"].ToString() == "dropped"}


def measure(scene, surface, size, frames):
    stages = {row: Stage(scene, row, surface, size) for row in ROWS}
    begin = time.monotonic()
    for i in range(frames):
        for stage in stages.values():
            stage.frame()
        if i >= 4 and time.monotonic() - begin > SECONDS:
            break
    rows = {}
    for row, stage in stages.items():
        rows[row] = {"processor": sorted(stage.times)[len(stage.times) // 4],
                     "frames": len(stage.times), "features": stage.mapper.GetShaderFeatures(),
                     "shading": stage.mapper.GetShadingReason(),
                     "builds": stage.mapper.GetNumberOfShaderBuilds()}
    pictures = {row: stage.light() for row, stage in stages.items()}
    for row, stage in stages.items():
        rows[row]["dropped"] = stage.dropped()
        rows[row]["change"] = float(np.abs(pictures[row] - pictures["all on"]).max())
        stage.window.Finalize()
    return {"scene": scene, "brightest": float(pictures["all on"].max()), "rows": rows}


def table(data):
    lines = [f"Commit {data['commit']}, {data['processor']}, {data['cores']} cores, load "
             f"{data['load']:.0f} when it began; {data['triangles']} triangles, {data['size']}² pixels. "
             "Milliseconds of the processor (all threads) a frame.", "",
             "| scene | all on | Auto | tolerance 0.5/255 | dropped then | sum of the bounds | "
             "greatest change of a pixel |", "|---|---|---|---|---|---|---|"]
    for case in data["cases"]:
        on, auto, lax = (case["rows"][row] for row in ROWS)
        times = [f"{1e3 * on['processor']:.0f} ms"] + [
            f"{1e3 * row['processor']:.0f} ms, **{on['processor'] / row['processor']:.1f} times**"
            for row in (auto, lax)]
        names = ", ".join(sorted(lax["dropped"])) or "nothing"
        lines.append(f"| {case['scene']} | " + " | ".join(times) + f" | {names} | "
                     f"{sum(lax['dropped'].values()):.2g} | {lax['change']:.2g} |")
    return "\n".join(lines) + "\n"


def write_page(data):
    path = os.path.join(frame_time.ROOT, "docs", "rendering", "effects.md")
    with open(path, encoding="utf-8") as file:
        page = file.read()
    mark = re.compile(r"(<!-- effects: saving -->\n)(?:.*?\n)??(<!-- end -->)", re.DOTALL)
    if not mark.search(page):
        raise SystemExit(f"{path} has no place for the table")
    with open(path, "w", encoding="utf-8") as file:
        file.write(mark.sub(lambda m: m.group(1) + table(data) + m.group(2), page))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--frames", type=int, default=30)
    parser.add_argument("--size", type=int, default=500)
    parser.add_argument("--out", default="picture-effects")
    options = parser.parse_args()
    origin = provenance()
    surface = frame_time.sphere(20000)
    cases = []
    for scene in SCENES:
        cases.append(measure(scene, surface, options.size, options.frames))
        rows = cases[-1]["rows"]
        print(scene, "  ".join(f"{row} {1e3 * r['processor']:.1f}" for row, r in rows.items()),
              rows["tolerance"]["dropped"], rows["tolerance"]["change"], rows["tolerance"]["shading"],
              file=sys.stderr, flush=True)
    result = {"question": "what the effect plan of a picture saves and changes", **origin,
              "size": options.size, "triangles": surface.GetNumberOfPolys(),
              "cores": len(os.sched_getaffinity(0)), "tolerance": TOLERANCE, "cases": cases}
    write(options.out, result)
    if options.out == "picture-effects":
        write_page(result)


if __name__ == "__main__":
    if any(os.environ.get(name) != value for name, value in frame_time.KEEP.items()):
        os.execve(sys.executable, [sys.executable, *sys.argv], {**os.environ, **frame_time.KEEP})
    main()
