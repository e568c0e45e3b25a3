# SPDX-License-Identifier: BSD-3-Clause
"""Radiance's rtrace -I on the scenes (PyPI: pyradiance, which brings the programs).

A point light is a `light` sphere of 1 mm radius, sampled at its centre (-dj 0), so that it is a point
light to 1e-7. A panel is a `light` polygon. No ambient, no threshold: what is left is direct light.
"""
import os
import subprocess
import tempfile

import numpy as np

from direct.clock import clock

RADIUS = 1e-3


class Radiance:
    name = "Radiance"

    def __init__(self, folder, threads):
        self.folder, self.threads = folder, threads
        self.environment = dict(os.environ, RAYPATH=os.path.join(folder, "lib"))
        self.version = self.call("rtrace", "-version").stdout.decode().strip()

    def call(self, program, *options, **more):
        return subprocess.run([os.path.join(self.folder, "bin", program), *options], check=True,
                              env=self.environment, capture_output=True, **more)

    def build(self, scene, folder):
        """The octree; returns its path and the seconds it took."""
        text = []

        def polygon(material, name, corners):
            numbers = " ".join(f"{x:.17g}" for x in np.asarray(corners).ravel())
            text.append(f"{material} polygon {name} 0 0 {3 * len(corners)} {numbers}\n")

        if scene.point is not None:
            radiance = scene.intensity / (np.pi * RADIUS**2)
            text.append(f"void light lamp 0 0 3 {radiance} {radiance} {radiance}\n")
            text.append("lamp sphere source 0 0 4 {} {} {} {}\n".format(*scene.point, RADIUS))
        else:
            radiance = scene.exitance / np.pi
            text.append(f"void light lamp 0 0 3 {radiance} {radiance} {radiance}\n")
            polygon("lamp", "source", scene.panel)
        text.append("void plastic grey 0 0 5 .5 .5 .5 0 0\n")
        for number, triangle in enumerate(scene.blocker.triangles):
            polygon("grey", f"face{number}", scene.blocker.points[triangle])
        path = os.path.join(folder, "scene.rad")
        with open(path, "w", encoding="ascii") as file:
            file.writelines(text)
        begin = clock()
        octree = self.call("oconv", path).stdout
        seconds = clock() - begin
        with open(os.path.join(folder, "scene.oct"), "wb") as file:
            file.write(octree)
        return file.name, seconds

    def trace(self, octree, points, options, folder):
        """Irradiance at upward points; the seconds of the whole process."""
        rays = np.concatenate([points, np.broadcast_to([0.0, 0.0, 1.0], points.shape)], 1)
        path = os.path.join(folder, "rays")
        rays.astype(np.float64).tofile(path)
        command = ["-h", "-w", "-I+", "-ab", "0", "-aa", "0", "-dt", "0", "-dc", "1", "-dr", "0",
                   "-dp", "0", "-fdf", *options]
        if self.threads > 1:
            command += ["-n", str(self.threads)]
        begin = clock()
        with open(path, "rb") as file:
            out = self.call("rtrace", *command, octree, stdin=file).stdout
        seconds = clock() - begin
        return np.frombuffer(out, np.float32).reshape(-1, 3)[:, 0].astype(float), seconds

    def start(self, octree, folder):
        """Seconds of a process that traces one ray: what is not counted as light."""
        return min(self.trace(octree, np.zeros((1, 3)), [], folder)[1] for _ in range(5))

    def sweep(self, scene, receivers, seconds):
        """Yields setting, values, seconds without and with building, while runs stay within
        `seconds`."""
        with tempfile.TemporaryDirectory() as folder:
            octree, building = self.build(scene, folder)
            start = self.start(octree, folder)
            rng = np.random.default_rng(1)
            for setting, points, options, share in self.settings(scene, receivers, rng):
                values, spent = self.trace(octree, points, options, folder)
                values = values.reshape(-1, share).mean(1)
                yield setting, values, max(spent - start, 1e-6), spent + building
                if spent > seconds:
                    break

    @staticmethod
    def settings(scene, receivers, rng):
        """Setting, points, options and points a receiver, from coarse to fine.

        Panels are cut into parts (-ds) with a random place in each (-dj); rtrace makes 64 of them at
        most, so finer runs ask more points a cell, or the same point again with other random places.
        """
        fixed = ["-dj", "0", "-ds", "0"]
        if scene.point is not None and receivers == "points":
            yield "-dj 0", scene.centres(), fixed, 1
            return
        if scene.point is not None:
            steps = [(k, 0) for k in (1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48)]
        else:
            steps = [(1, 0.6), (1, 0.3), (1, 0.15), (1, 0.08), (2, 0.08), (2, 0.04), (3, 0.04),
                     (4, 0.04), (6, 0.04), (8, 0.04), (12, 0.04), (16, 0.04), (24, 0.04)]
        for k, size in steps:
            u = np.stack(np.meshgrid(np.arange(k), np.arange(k), indexing="xy"), -1).reshape(-1, 2)
            u = np.broadcast_to(u, (scene.cells**2, k * k, 2))
            u = (u + rng.random(u.shape)) / k if receivers == "cells" else np.full(u.shape, 0.5)
            options = ["-dj", "0.9", "-ds", f"{size}"] if size else fixed
            name = f"{k * k} points a receiver" + (f", -ds {size}" if size else "")
            yield name, scene.on_cells(u).reshape(-1, 3), options, k * k
