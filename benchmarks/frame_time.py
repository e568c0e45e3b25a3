#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Question: what does a frame of vtkPhongGouraudMapper cost beside VTK's stock mapper?

A sphere of 1e5 triangles fills a square window, off screen, in the 8-bit window and in a float target;
lights are vtkLights of one kind (directional, point with inverse-square fall-off, spot of 40 degrees with
an exponent) and both mappers light it from the same ones. Rows:

  stock       vtkPolyDataMapper, VTK's Phong. It computes a highlight (R.V) for every light, whether or not
              the material has one, two-sided, local viewer, no emission, one number of ambient.
  phong       ours, the legacy Phong model, two-sided, local viewer: the effects of the picture of "stock"
  physical    ours with its default model
  everything  ours, Phong, with the code of every effect in the shader (EveryEffect) though no more is seen
  gouraud, flat, auto   ours, the same model as "phong"

The camera turns by a degree a frame, so that whatever depends on it is done anew (so Auto draws glossy
surfaces by Phong: its decision would not last; matte ones are decided before the frames that count). Rows of one case take
turns, frame by frame, for as many frames as a few seconds hold; the figure is the lower quartile over the frames of the processor's time of the whole
process (llvmpipe's threads included), which other programs disturb less than the clock; the clock's is
given too. `setup` is the clock's time of the first frame: shaders are generated, compiled and buffers are
filled. `cpu` is a window of 2 x 2 pixels with 12 triangles, where nothing but the work of the processor
between frames is left.

Mesa hands its vertex buffers back to the system after each frame where malloc maps them, which costs up to
10 ms or nothing depending on sizes; so malloc is told to keep its memory (MALLOC_MMAP_MAX_=0).

    ./run --python benchmarks/frame_time.py [--frames 40] [--size 800] [--out frame-time]

Mesa's llvmpipe draws on the processor, so a fragment's arithmetic costs as much as its text says; on a
graphics card fewer of these differences show. Writes benchmarks/results/frame-time.json and the tables of
docs/rendering/speed.md (--tables: these alone, of the results that there are).
"""
import argparse
import json
import math
import os
import re
import sys
import time

from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkLight,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkradiometry.vtkRadiometryRendering import vtkLinearFloatPass, vtkPhongGouraudMapper

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from provenance import provenance, write  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SECONDS = 4.0  # a case
DECISION = 120.0  # s: the longest that is waited for
KEEP = {"MALLOC_MMAP_MAX_": "0", "MALLOC_TRIM_THRESHOLD_": "2000000000", "MALLOC_TOP_PAD_": "100000000"}
KINDS = ("directional", "point", "spot")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--frames", type=int, default=40)
    parser.add_argument("--size", type=int, default=800)
    parser.add_argument("--lights", default="1,8,100")
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--materials", default="matte,gloss")
    parser.add_argument("--targets", default="window,float")
    parser.add_argument("--rows", default="stock,phong,physical,everything,gouraud,flat,auto")
    parser.add_argument("--many", default="500,2000", help="numbers of point lights for ours alone")
    parser.add_argument("--out", default="frame-time")
    parser.add_argument("--tables", action="store_true", help="of the results that there are")
    return parser.parse_args()


def sphere(triangles=100000):
    source = vtkSphereSource()
    n = math.ceil(math.sqrt(triangles / 2.0)) + 1
    source.SetThetaResolution(n)
    source.SetPhiResolution(n + 1)
    source.Update()
    return source.GetOutput()


def cube():
    source = vtkCubeSource()
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(source.GetOutputPort())
    normals.Update()
    return normals.GetOutput()


def light(kind, i, count):
    """Spread over the upper half in a spiral, at a distance of 2 from the centre."""
    z = (i + 0.5) / count
    phi = 2.399963 * i
    s = math.sqrt(1.0 - z * z)
    result = vtkLight()
    result.SetLightTypeToSceneLight()
    result.SetPosition(2 * s * math.cos(phi), 2 * z, 2 * s * math.sin(phi))
    result.SetFocalPoint(0, 0, 0)
    result.SetIntensity((1.0 if kind == "directional" else 3.0) / count)
    if kind != "directional":
        result.SetPositional(True)
        result.SetAttenuationValues(0, 0, 1)
        result.SetConeAngle(40 if kind == "spot" else 90)
        result.SetExponent(5 if kind == "spot" else 0)
    return result


class Stage:
    """A window with one actor drawn one way."""

    def __init__(self, row, surface, kind, count, material, target, size):
        self.mapper = vtkPolyDataMapper() if row == "stock" else vtkPhongGouraudMapper()
        self.mapper.SetInputDataObject(surface)
        if row != "stock":
            self.mapper.SetShading({"gouraud": 1, "flat": 0, "auto": 3}.get(row, 2))
            self.mapper.SetReflectionModel(2 if row == "physical" else 1)
            self.mapper.SetEveryEffect(row == "everything")
        actor = vtkActor()
        actor.SetMapper(self.mapper)
        actor.GetProperty().SetInterpolationToPhong()
        actor.GetProperty().SetDiffuseColor(0.8, 0.7, 0.6)
        if material == "gloss":
            actor.GetProperty().SetSpecular(0.5)
            actor.GetProperty().SetSpecularPower(30)
        self.renderer = vtkRenderer()
        self.renderer.AddActor(actor)
        self.renderer.AutomaticLightCreationOff()
        for i in range(count):
            self.renderer.AddLight(light(kind, i, count))
        if target == "float":
            self.target = vtkLinearFloatPass()
            self.target.AllSceneLinearOn()  # VTK's mapper too
            self.renderer.SetPass(self.target)
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
        self.setup = time.perf_counter() - begin
        self.draw()
        # Shading Auto decides in its share of the frames' time: until it has, but not for ever.
        begin, self.deciding = time.perf_counter(), 1
        while row == "auto" and time.perf_counter() - begin < DECISION and (
                "deciding" in self.mapper.GetShadingReason()
                or "frame before" in self.mapper.GetShadingReason()):
            self.draw()
            self.deciding += 1
        self.clock, self.processor = [], []

    def draw(self):
        self.window.Render()
        self.window.WaitForCompletion()

    def frame(self):
        self.renderer.GetActiveCamera().Azimuth(1)
        clock, processor = time.perf_counter(), time.process_time()
        self.draw()
        self.processor.append(time.process_time() - processor)
        self.clock.append(time.perf_counter() - clock)

    def result(self):
        quartile = lambda values: sorted(values)[len(values) // 4]  # noqa: E731
        out = {"processor": quartile(self.processor), "clock": quartile(self.clock),
               "setup": self.setup,
               "frames": len(self.clock)}
        if isinstance(self.mapper, vtkPhongGouraudMapper):
            out["features"] = self.mapper.GetShaderFeatures()
            out["builds"] = self.mapper.GetNumberOfShaderBuilds()
            out["reason"] = self.mapper.GetShadingReason()
            out["gouraud share"] = self.mapper.GetGouraudShare()
            out["frames until decided"] = self.deciding
            out["shading"] = ("flat", "gouraud", "phong", "each")[self.mapper.GetShadingUsed()]
        return out


def measure(rows, surface, kind, count, material, target, size, frames):
    stages = {row: Stage(row, surface, kind, count, material, target, size) for row in rows}
    begin = time.monotonic()
    for i in range(frames):
        for stage in stages.values():
            stage.frame()
        if i >= 4 and time.monotonic() - begin > SECONDS:
            break
    results = {row: stage.result() for row, stage in stages.items()}
    for stage in stages.values():
        stage.window.Finalize()
    if "stock" in results:
        for row in results.values():
            row["times stock"] = row["processor"] / results["stock"]["processor"]
    return {"commit": provenance()["commit"], "kind": kind, "lights": count, "material": material, "target": target, "rows": results}


def show(case):
    print(f'{case["kind"]:12}{case["lights"]:5} {case["material"]:6}{case["target"]:7}' + "  ".join(
        f'{row} {1e3 * r["processor"]:.2f}' + (f' ({r["times stock"]:.2f})' if "times stock" in r else "")
        for row, r in case["rows"].items()), file=sys.stderr, flush=True)


def stock_table(data):
    later = {case["commit"] for case in data["cases"]} - {data["commit"]}
    commits = data["commit"] + "".join(f" (some cases: {commit})" for commit in sorted(later))
    lines = [f"Commit {commits}, {data['processor']}, {data['cores']} cores, load "
             f"{data['load']:.0f} when it began, {data['renderer']}; {data['triangles']} triangles, "
             f"{data['size']}² pixels. Milliseconds of the processor (all threads) a frame, and how many "
             "times VTK's.", "",
             "| lights | material | target | VTK | Phong | physical | Gouraud | Flat | Auto | every effect |",
             "|---|---|---|---|---|---|---|---|---|---|"]
    for case in data["cases"]:
        rows = case["rows"]
        if "stock" not in rows:
            continue
        stock = rows["stock"]["processor"]
        cells = [f"{1e3 * stock:.0f} ms"] + [
            "" if row not in rows else
            f"{1e3 * rows[row]['processor']:.0f} ms, **{rows[row]['processor'] / stock:.2f}**"
            if row == "phong" else f"{rows[row]['processor'] / stock:.2f}"
            for row in ("phong", "physical", "gouraud", "flat", "auto", "everything")]
        lines.append(f"| {case['lights']} {case['kind']} | {case['material']} | {case['target']} | "
                     + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def auto_table(data):
    lines = ["| lights | material | frames until decided | share of Gouraud | Phong | Auto |",
             "|---|---|---|---|---|---|"]
    for case in data["cases"]:
        rows = case["rows"]
        if case["target"] == "window" and "auto" in rows:
            auto = rows["auto"]
            phong = rows["phong"]["processor"]
            lines.append(
                f"| {case['lights']} {case['kind']} | {case['material']} | "
                f"{auto['frames until decided'] if 'deciding' not in auto['reason'] else 'not within 120 s'}"
                f" | {100 * auto['gouraud share']:.1f} % | {1e3 * phong:.0f} ms | "
                f"{1e3 * auto['processor']:.0f} ms, **{auto['processor'] / phong:.2f}** |")
    return "\n".join(lines) + "\n"


def many_table(data):
    lines = ["| point lights | Phong | Gouraud | Auto |", "|---|---|---|---|"]
    for case in data["cases"]:
        if "stock" not in case["rows"]:
            lines.append(f"| {case['lights']} | " + " | ".join(
                f"{case['rows'][row]['processor']:.2f} s" for row in ("phong", "gouraud", "auto")) + " |")
    return "\n".join(lines) + "\n"


def setup_table(data):
    lines = ["| lights | VTK, first frame | Phong, first frame | VTK, 2 x 2 pixels | Phong, 2 x 2 pixels |",
             "|---|---|---|---|---|"]
    for small in data["cpu"]:
        first = next((c["rows"] for c in data["cases"] if c["kind"] == "point" and "stock" in c["rows"]
                      and c["lights"] == small["lights"] and c["material"] == "gloss"), None)
        if first:
            lines.append(f"| {small['lights']} point | " + " | ".join(
                f"{1e3 * value:.{digits}f} ms" for value, digits in (
                    (first["stock"]["setup"], 0), (first["phong"]["setup"], 0),
                    (small["rows"]["stock"]["processor"], 2),
                    (small["rows"]["phong"]["processor"], 2))) + " |")
    return "\n".join(lines) + "\n"


def write_page(data):
    path = os.path.join(ROOT, "docs", "rendering", "speed.md")
    with open(path, encoding="utf-8") as file:
        page = file.read()
    for name, table in (("stock", stock_table), ("auto", auto_table), ("setup", setup_table),
                        ("many", many_table)):
        mark = re.compile(rf"(<!-- speed: {name} -->\n)(?:.*?\n)??(<!-- end -->)", re.DOTALL)
        if not mark.search(page):
            raise SystemExit(f"{path} has no place for {name}")
        page = mark.sub(lambda m, t=table(data): m.group(1) + t + m.group(2), page)
    with open(path, "w", encoding="utf-8") as file:
        file.write(page)


def main():
    options = arguments()
    if options.tables:
        with open(os.path.join(ROOT, "benchmarks", "results", "frame-time.json"),
                  encoding="utf-8") as file:
            write_page(json.load(file))
        return
    origin = provenance()  # the load before it, not its own
    surface = sphere()
    probe = Stage("stock", cube(), "directional", 1, "matte", "window", 2)
    about = next((line for line in probe.window.ReportCapabilities().splitlines()
                  if "renderer string" in line), "").split(":", 1)[-1].strip()
    rows = options.rows.split(",")
    cases = []
    for kind in options.kinds.split(","):
        for count in map(int, options.lights.split(",")):
            for material in options.materials.split(","):
                for target in options.targets.split(","):
                    cases.append(measure(
                        rows if target == "window" else rows[:3], surface, kind, count, material, target, options.size, options.frames))
                    show(cases[-1])
    for count in map(int, filter(None, options.many.split(","))):
        cases.append(measure(["phong", "gouraud", "auto"], surface, "point", count, "gloss", "window",
                             options.size, max(3, options.frames // 8)))
        show(cases[-1])
    cpu = []
    for count in map(int, options.lights.split(",")):
        cpu.append(measure([r for r in rows if r in ("stock", "phong", "auto")], cube(), "point", count,
                           "gloss", "window", 2, 10 * options.frames))
        show(cpu[-1])
    result = {"question": "a frame of vtkPhongGouraudMapper beside VTK's mapper",
              **origin, "renderer": about, "size": options.size,
              "triangles": surface.GetNumberOfPolys(),
              "cores": len(os.sched_getaffinity(0)), "cases": cases, "cpu": cpu}
    write(options.out, result)
    if options.out == "frame-time":
        write_page(result)


if __name__ == "__main__":
    if any(os.environ.get(name) != value for name, value in KEEP.items()):
        os.execve(sys.executable, [sys.executable, *sys.argv], {**os.environ, **KEEP})
    main()
