# SPDX-License-Identifier: BSD-3-Clause
"""Mitsuba 3 on the scenes (PyPI: mitsuba; 3.5.2 was used, variant llvm_ad_rgb).

Its irradiancemeter integrates what reaches a shape over directions and has no answer for point lights,
so the receivers are asked through the call that its own `direct` integrator is made of,
scene.sample_emitter_direction with the visibility test, at places drawn by its own multijittered
sampler: one compiled kernel of all samples of all receivers, no camera, no film. That is the leanest
way to ask Mitsuba. Times are of runs whose kernel was compiled before.
"""

import numpy as np

from direct.clock import clock

LARGEST = 1 << 24  # samples a pass


class Mitsuba:
    name = "Mitsuba 3"

    def __init__(self, threads):
        import drjit
        import mitsuba

        mitsuba.set_variant("llvm_ad_rgb")
        drjit.set_thread_count(threads)
        self.dr, self.mi, self.version = drjit, mitsuba, mitsuba.__version__

    def mesh(self, body):
        mi = self.mi
        properties = mi.Properties()
        properties["bsdf"] = mi.load_dict({"type": "twosided", "inside": {"type": "diffuse"}})
        mesh = mi.Mesh("blocker", vertex_count=len(body.points), face_count=len(body.triangles),
                       props=properties)
        values = mi.traverse(mesh)
        values["vertex_positions"] = body.points.astype(np.float32).ravel()
        values["faces"] = body.triangles.astype(np.uint32).ravel()
        values.update()
        return mesh

    def build(self, scene):
        mi = self.mi
        content = {"type": "scene"}
        if scene.point is not None:
            content["lamp"] = {"type": "point", "position": scene.point.tolist(),
                               "intensity": {"type": "rgb", "value": scene.intensity}}
        else:
            a, b, _, d = scene.panel
            half = np.eye(4)
            half[:3, 0], half[:3, 1] = (b - a) / 2, (d - a) / 2
            half[:3, 2] = np.cross(half[:3, 0], half[:3, 1])
            half[:3, 2] /= np.linalg.norm(half[:3, 2])
            half[:3, 3] = scene.panel.mean(0)
            content["panel"] = {"type": "rectangle", "to_world": mi.ScalarTransform4f(half),
                                "emitter": {"type": "area", "radiance": {
                                    "type": "rgb", "value": scene.exitance / np.pi}}}
        if len(scene.blocker.points):
            content["blocker"] = self.mesh(scene.blocker)
        return mi.load_dict(content)

    def estimate(self, built, scene, receivers, samples, seed):
        """Averages over the samples of each receiver."""
        mi, dr = self.mi, self.dr
        count = scene.cells**2
        passes = 1
        while count * samples > passes * LARGEST:
            passes *= 4
        side = int(round(np.sqrt(samples // passes)))
        each = side * side  # the sampler's grid; `samples` are squares and passes powers of 4
        total = np.zeros(count)
        for number in range(passes):
            sampler = mi.load_dict({"type": "multijitter", "sample_count": each})
            sampler.set_samples_per_wavefront(each)
            sampler.seed(seed + number, count * each)
            cell = dr.arange(mi.UInt32, count * each) // each
            u = sampler.next_2d() if receivers == "cells" else mi.Point2f(0.5, 0.5)
            low, width = -3.0, scene.width()
            row = cell // scene.cells
            si = dr.zeros(mi.SurfaceInteraction3f, count * each)
            si.p = mi.Point3f(low + width * (mi.Float(cell - row * scene.cells) + u.x),
                              low + width * (mi.Float(row) + u.y), 0.0)
            si.n = mi.Normal3f(0, 0, 1)
            si.sh_frame = mi.Frame3f(si.n)
            record, weight = built.sample_emitter_direction(si, sampler.next_2d(), True)
            value = weight.x * dr.maximum(record.d.z, 0.0)
            # Float sums of a few hundred samples, summed on in double: no rounding is blamed on it.
            parts = -(-each // 256)
            sums = dr.zeros(mi.Float, count * parts)
            number_in_cell = dr.arange(mi.UInt32, count * each) - cell * each
            dr.scatter_reduce(dr.ReduceOp.Add, sums, value, cell * parts + number_in_cell // 256)
            total += np.array(sums, dtype=float).reshape(count, parts).sum(1)
        return total / (each * passes)

    def sweep(self, scene, receivers, seconds):
        begin = clock()
        built = self.build(scene)
        building = clock() - begin
        if receivers == "points" and scene.point is not None:
            steps = (1,)
        else:
            steps = (1, 4, 16, 36, 64, 144, 256, 576, 1024, 2304, 4096, 9216, 16384, 65536)
        for samples in steps:
            begin = clock()
            self.estimate(built, scene, receivers, samples, 0)
            cold = clock() - begin
            spent = np.inf
            for seed in (1000, 2000) if cold < seconds / 4 else (1000,):
                begin = clock()
                values = self.estimate(built, scene, receivers, samples, seed)
                spent = min(spent, clock() - begin)
            yield f"{samples} samples a receiver", values, spent, building + cold
            if spent > seconds:
                break
