# SPDX-License-Identifier: BSD-3-Clause
"""Radiance's rtrace -I on the Cornell box (PyPI: pyradiance, which brings the programs).

The lamp is a `light`, the walls are `plastic` without gloss: three bands in one run. Points are put into
each cell at random. Two ways are swept, both as a careful user would: with the ambient cache (-aa > 0,
one cache for all points of a run) and without it (-aa 0: each point has its own hemisphere). Bounces
(-ab) grow with the samples, so that what is cut off stays below the noise.
"""
import os
import subprocess
import tempfile

import numpy as np


class Radiance:
    def __init__(self, folder, threads, clock, cache):
        self.folder, self.threads, self.clock, self.cache = folder, threads, clock, cache
        self.name = "Radiance, ambient cache" if cache else "Radiance, no cache"
        self.environment = dict(os.environ, RAYPATH=os.path.join(folder, "lib"))
        self.version = self.call("rtrace", "-version").stdout.decode().strip()

    def call(self, program, *options, **more):
        return subprocess.run([os.path.join(self.folder, "bin", program), *options], check=True,
                              env=self.environment, capture_output=True, **more)

    def build(self, box, folder):
        """The octree; returns its path and the seconds it took."""
        text = []
        for number, (begin, end) in enumerate(box.kinds):
            radiance = box.exitance[begin] / np.pi
            if radiance.max() > 0.0:
                text.append("void light kind{} 0 0 3 {} {} {}\n".format(number, *radiance))
            else:
                text.append("void plastic kind{} 0 0 5 {} {} {} 0 0\n".format(
                    number, *box.reflectance[begin]))
            for cell in range(begin, end):
                corners = " ".join(f"{x:.12g}" for x in box.corners[cell].ravel())
                text.append(f"kind{number} polygon c{cell} 0 0 9 {corners}\n")
        path = os.path.join(folder, "scene.rad")
        with open(path, "w", encoding="ascii") as file:
            file.writelines(text)
        begin = self.clock()
        octree = self.call("oconv", path).stdout
        seconds = self.clock() - begin
        with open(os.path.join(folder, "scene.oct"), "wb") as file:
            file.write(octree)
        return file.name, seconds

    def trace(self, octree, points, normals, options, folder):
        """Irradiance at points, points x 3; the seconds of the whole process."""
        path = os.path.join(folder, "rays")
        np.concatenate([points, normals], 1).astype(np.float64).tofile(path)
        command = ["-h", "-w", "-I+", "-fdf", "-dt", "0", "-dc", "1", "-dr", "0", "-dp", "0",
                   "-dj", "0.9", "-lw", "1e-6", "-lr", "-12", *options]
        if self.threads > 1:
            command += ["-n", str(self.threads)]
        begin = self.clock()
        with open(path, "rb") as file:
            out = self.call("rtrace", *command, octree, stdin=file).stdout
        seconds = self.clock() - begin
        return np.frombuffer(out, np.float32).reshape(-1, 3).astype(float), seconds

    def settings(self):
        """Points a cell and options, from coarse to fine."""
        if self.cache:
            for each, aa, ad, ar, ds, ab in (
                    (1, 0.6, 16, 8, 0.6, 3), (1, 0.4, 64, 16, 0.4, 3), (1, 0.3, 128, 32, 0.3, 4), (1, 0.2, 256, 64, 0.2, 5), (2, 0.2, 512, 64, 0.2, 5),
                    (4, 0.15, 512, 128, 0.1, 6), (4, 0.15, 1024, 128, 0.1, 6),
                    (8, 0.1, 1024, 128, 0.1, 6), (16, 0.1, 2048, 256, 0.05, 8),
                    (32, 0.08, 4096, 256, 0.05, 8), (64, 0.06, 8192, 512, 0.05, 10)):
                yield (f"{each} points a cell, -ab {ab} -aa {aa} -ad {ad} -ds {ds}", each,
                       ["-ab", ab, "-aa", aa, "-ad", ad, "-as", ad // 2, "-ar", ar, "-ds", ds])
        else:
            for each, ad, ab in ((1, 4, 4), (1, 16, 5), (4, 16, 5), (16, 16, 6), (16, 64, 6),
                                 (64, 32, 7), (64, 128, 7), (256, 64, 8), (1024, 64, 8),
                                 (4096, 64, 9)):
                yield (f"{each} points a cell, -ab {ab} -aa 0 -ad {ad}", each,
                       ["-ab", ab, "-aa", 0, "-ad", ad, "-as", 0, "-ds", 0.2])

    def sweep(self, box, seconds):
        rng = np.random.default_rng(1)
        with tempfile.TemporaryDirectory() as folder:
            octree, building = self.build(box, folder)
            start = min(self.trace(octree, np.full((1, 3), 0.1), np.array([[0.0, 0.0, 1.0]]),
                                   ["-ab", "0"], folder)[1] for _ in range(5))
            for setting, each, options in self.settings():
                u = rng.random((len(box), each, 2))
                u = np.where(u.sum(-1, keepdims=True) > 1.0, 1.0 - u, u)
                a, b, c = (box.corners[:, None, k] for k in range(3))
                points = (a + (b - a) * u[..., :1] + (c - a) * u[..., 1:]).reshape(-1, 3)
                order = np.arange(len(points))
                if self.cache:  # a cache serves best where points come in no order
                    order = rng.permutation(len(points))
                values, spent = self.trace(octree, points[order],
                                           np.repeat(box.normal, each, 0)[order],
                                           [str(o) for o in options], folder)
                back = np.empty_like(values)
                back[order] = values
                yield (setting, back.reshape(len(box), each, 3).mean(1), max(spent - start, 1e-6),
                       spent + building)
                if spent > seconds:
                    break
