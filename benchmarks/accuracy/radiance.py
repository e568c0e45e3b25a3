# SPDX-License-Identifier: BSD-3-Clause
"""Radiance's rtrace -I on the scenes (PyPI: pyradiance, which brings the programs).

A point light is a `light` sphere of 1 mm radius, sampled at its centre (-dj 0), so that it is a point
light to 1e-7; a sun is a `light` source of 0.02 degrees; a panel is a `light` polygon; a sky a `glow`.
Surfaces are `plastic` without gloss. Three ways are swept, as a careful user would:

- direct: no ambient; points a cell, parts of a panel (-ds), or with thousands of lights the threshold
  below which they are not tested (-dt, -dc).
- ambient cache (-aa > 0, one cache for all points of a run), and no cache (-aa 0: each point has its own
  hemisphere). Bounces (-ab) grow with the samples, so that what is cut off stays below the noise.
"""
import os
import subprocess
import tempfile

import numpy as np

from accuracy.clock import clock
from accuracy.lamp import PANEL, POINT, SKY, three
from accuracy.shapes import joined

RADIUS = 1e-3      # m, of a point light
WIDTH = 0.02       # degrees, of a sun
DIRECT = ["-ab", "0", "-aa", "0"]


class Radiance:
    """`way`: direct, ambient cache or no cache."""

    def __init__(self, folder, way, threads=1):
        self.folder, self.way, self.threads = folder, way, threads
        self.name = "Radiance" if way == "direct" else f"Radiance, {way}"
        self.environment = dict(os.environ, RAYPATH=os.path.join(folder, "lib"))
        self.version = self.call("rtrace", "-version").stdout.decode().strip()

    def call(self, program, *options, **more):
        return subprocess.run([os.path.join(self.folder, "bin", program), *options], check=True,
                              env=self.environment, capture_output=True, **more)

    @staticmethod
    def description(scene):
        """The scene in Radiance's own words."""
        text = []

        def polygon(material, name, corners):
            numbers = " ".join(f"{x:.12g}" for x in np.asarray(corners).ravel())
            text.append(f"{material} polygon {name} 0 0 {np.size(corners)} {numbers}\n")

        def shining(number, kind, radiance):
            text.append("void {} lamp{} 0 0 {} {:.9g} {:.9g} {:.9g}{}\n".format(
                kind, number, 3 if kind == "light" else 4, *three(radiance),
                "" if kind == "light" else " 0"))

        for number, lamp in enumerate(scene.lamps):
            if lamp.kind == POINT:
                shining(number, "light", lamp.intensity / (np.pi * RADIUS**2))
                text.append("lamp{0} sphere at{0} 0 0 4 {1:.12g} {2:.12g} {3:.12g} {4}\n".format(
                    number, *lamp.position, RADIUS))
            elif lamp.kind == PANEL:
                shining(number, "light", lamp.intensity / np.pi)
                polygon(f"lamp{number}", f"at{number}", lamp.corners)
            elif lamp.kind == SKY:
                shining(number, "glow", lamp.intensity)
                text.append(f"lamp{number} source at{number} 0 0 4 0 0 1 360\n")
            else:
                shining(number, "light", lamp.intensity
                        / (np.pi * np.sin(0.5 * np.radians(WIDTH))**2))
                text.append("lamp{0} source at{0} 0 0 4 {1:.12g} {2:.12g} {3:.12g} {4}\n".format(
                    number, *-lamp.direction, WIDTH))
        for number, (corners, exitance) in enumerate(scene.uncut):
            shining(f"s{number}", "light", exitance / np.pi)
            polygon(f"lamps{number}", f"surface{number}", corners)
        kind = None
        for cell, corners in enumerate(scene.corners if scene.indirect else ()):
            if scene.exitance[cell].any():
                continue
            if kind is None or (scene.reflectance[cell] != scene.reflectance[kind]).any():
                kind = cell
                text.append("void plastic kind{} 0 0 5 {:.9g} {:.9g} {:.9g} 0 0\n".format(
                    kind, *three(scene.reflectance[kind])))
            polygon(f"kind{kind}", f"c{cell}", corners)
        text.append("void plastic grey 0 0 5 0 0 0 0 0\n")
        points, triangles = joined(scene.blockers)
        for number, triangle in enumerate(triangles):
            polygon("grey", f"face{number}", points[triangle])
        return text

    def build(self, scene, folder):
        """The octree; returns its path and the seconds it took."""
        path = os.path.join(folder, "scene.rad")
        with open(path, "w", encoding="ascii") as file:
            file.writelines(self.description(scene))
        begin = clock()
        octree = self.call("oconv", path).stdout
        seconds = clock() - begin
        with open(os.path.join(folder, "scene.oct"), "wb") as file:
            file.write(octree)
        return file.name, seconds

    def trace(self, octree, points, normals, options, folder):
        """Irradiance at points, points x 3; the seconds of the whole process."""
        path = os.path.join(folder, "rays")
        np.concatenate([points, normals], 1).astype(np.float64).tofile(path)
        command = ["-h", "-w", "-I+", "-fdf", "-dr", "0", "-dp", "0", "-lw", "1e-6", "-lr", "-12",
                   *map(str, options)]
        if self.threads > 1:
            command += ["-n", str(self.threads)]
        begin = clock()
        with open(path, "rb") as file:
            out = self.call("rtrace", *command, octree, stdin=file).stdout
        seconds = clock() - begin
        return np.frombuffer(out, np.float32).reshape(-1, 3).astype(float), seconds

    def settings(self, scene):
        """Setting, points a cell, options, from coarse to fine."""
        full = ["-dt", 0, "-dc", 1]
        fixed = ["-dj", 0, "-ds", 0, *full]
        kinds = {lamp.kind for lamp in scene.lamps}
        if self.way == "ambient cache":
            for each, aa, ad, ar, ds, ab in (
                    (1, 0.6, 16, 8, 0.6, 3), (4, 0.5, 32, 16, 0.4, 3), (9, 0.4, 64, 16, 0.3, 4),
                    (16, 0.3, 128, 32, 0.2, 4), (25, 0.25, 256, 64, 0.15, 5), (36, 0.2, 512, 64, 0.1, 5),
                    (64, 0.15, 512, 128, 0.1, 6), (100, 0.15, 1024, 128, 0.08, 6),
                    (144, 0.1, 2048, 256, 0.05, 8)):
                yield (f"{each} points a cell, -ab {ab} -aa {aa} -ad {ad}", each,
                       ["-dj", 0.9 if PANEL in kinds or scene.exitance.any() else 0, "-ab", ab, "-aa", aa,
                        "-ad", ad, "-as", ad // 2, "-ar", ar, "-ds", ds, *full])
        elif self.way == "no cache":
            for each, ad, ab in ((1, 4, 4), (4, 4, 4), (16, 4, 5), (36, 4, 5), (64, 4, 6), (144, 4, 6),
                                 (256, 4, 7), (576, 4, 7), (1024, 4, 8), (2304, 4, 8)):
                yield (f"{each} points a cell, -ab {ab} -aa 0 -ad {ad}", each,
                       ["-dj", 0.9 if PANEL in kinds or scene.exitance.any() else 0, "-ab", ab, "-aa", 0,
                        "-ad", ad, "-as", 0, "-ds", 0.2, *full])
        elif scene.sensors is not None:
            for dt, dc in ((0.5, 0.0), (0.3, 0.25), (0.1, 0.5), (0.03, 0.75), (0.01, 0.9), (0.003, 1.0),
                           (0.001, 1.0), (0.0, 1.0)):
                yield f"-dt {dt} -dc {dc}", 1, ["-dj", 0, "-ds", 0, "-dt", dt, "-dc", dc, *DIRECT]
        elif PANEL not in kinds:
            for k in (1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48):
                yield f"{k * k} points a cell", k * k, [*fixed, *DIRECT]
        else:
            for k, ds in ((1, 0.6), (1, 0.3), (1, 0.15), (1, 0.08), (2, 0.08), (2, 0.04), (3, 0.04),
                          (4, 0.04), (6, 0.04), (8, 0.04), (12, 0.04), (16, 0.04), (24, 0.04)):
                yield (f"{k * k} points a cell, -ds {ds}", k * k,
                       ["-dj", 0.9, "-ds", ds, *full, *DIRECT])

    @staticmethod
    def places(scene, each, rng):
        """`each` points of every cell, cells x each x 3: stratified where cells are parallelograms."""
        if scene.sensors is not None:
            return scene.sensors[:, None]
        k = int(round(np.sqrt(each)))
        u = rng.random((len(scene), each, 2))
        if scene.corners.shape[1] == 4 and k * k == each:
            u = (np.stack(np.meshgrid(np.arange(k), np.arange(k)), -1).reshape(-1, 2) + u) / k
        if scene.corners.shape[1] == 3:
            u = np.where(u.sum(-1, keepdims=True) > 1.0, 1.0 - u, u)
        a, b, d = (scene.corners[:, None, i] for i in (0, 1, -1))
        return a + (b - a) * u[..., :1] + (d - a) * u[..., 1:]

    def sweep(self, scene, seconds):
        """Yields setting, values, seconds without and with what is done before light."""
        rng = np.random.default_rng(1)
        with tempfile.TemporaryDirectory() as folder:
            octree, building = self.build(scene, folder)
            start = min(self.trace(octree, np.full((1, 3), 0.1), np.array([[0.0, 0.0, 1.0]]),
                                   [*DIRECT, "-dt", 1, "-dc", 0], folder)[1] for _ in range(5))
            for setting, each, options in self.settings(scene):
                points = self.places(scene, each, rng).reshape(-1, 3)
                order = np.arange(len(points))
                if self.way == "ambient cache":  # serves best where points come in no order
                    order = rng.permutation(len(points))
                values, spent = self.trace(octree, points[order],
                                           np.repeat(scene.normals, each, 0)[order], options, folder)
                back = np.empty_like(values)
                back[order] = values
                yield (setting, back.reshape(len(scene), each, 3).mean(1)[:, :scene.bands],
                       max(spent - start, 1e-6), spent + building)
                if spent > seconds:
                    break
