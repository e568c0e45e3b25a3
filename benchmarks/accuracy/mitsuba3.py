# SPDX-License-Identifier: BSD-3-Clause
"""Mitsuba 3 on the scenes (PyPI: mitsuba; 3.5.2 was used, variant llvm_ad_rgb).

Its irradiancemeter measures a whole shape with a film of its own, so a mesh needs a sensor and a start of
the kernel a cell, and it has no answer for point lights. It is asked in leaner ways, one compiled kernel
for all cells:

- direct: from points of each cell (its own multijittered sampler) one sample of the emitters,
  scene.sample_emitter_direction with the visibility test: what its `direct` integrator is made of.
- paths: that, and a cosine-weighted ray which its `path` integrator continues, joined by the power
  heuristic.
- particles: light paths from the emitters (scene.sample_emitter_ray), which leave their power on each
  cell they meet and go on as the cell's bsdf samples; among diffuse walls every bounce is an answer for
  some cell. Its own ptracer integrator does this for cameras only.

Thousands of point lights are not loaded as emitters (each would be compiled by itself): their places are
one array of the kernel, each sample takes one, and the longest run takes every light once.

Loading and compiling are counted apart. Russian roulette is Mitsuba's own: from the fifth bounce on, with
what is left of the throughput as the chance to go on (at most 0.95).
"""
import numpy as np

from accuracy.clock import clock
from accuracy.lamp import PANEL, POINT, SKY, three
from accuracy.shapes import joined

DEPTH = 128      # bounces that nothing reaches
ROULETTE = 5     # Mitsuba's default
LARGEST = 1 << 22  # samples a pass
MANY = 100       # point lights from which on they are an array


class Mitsuba:
    """`way`: direct, paths or particles."""

    def __init__(self, way):
        import drjit
        import mitsuba

        mitsuba.set_variant("llvm_ad_rgb")
        self.dr, self.mi, self.version = drjit, mitsuba, mitsuba.__version__
        self.way = way
        self.name = "Mitsuba 3" if way == "direct" else f"Mitsuba 3, {way}"

    def set_threads(self, threads):
        self.dr.set_thread_count(threads)
        return self

    # Loading

    def mesh(self, name, triangles, reflectance, exitance, two_sided):
        mi = self.mi
        properties = mi.Properties()
        bsdf = {"type": "diffuse", "reflectance": {"type": "rgb", "value": reflectance}}
        if two_sided:
            bsdf = {"type": "twosided", "inside": bsdf}
        properties["bsdf"] = mi.load_dict(bsdf)
        if max(exitance) > 0.0:
            properties["emitter"] = mi.load_dict({"type": "area", "radiance": {
                "type": "rgb", "value": [e / np.pi for e in exitance]}})
        points, index = np.unique(triangles.reshape(-1, 3).round(9), axis=0, return_inverse=True)
        mesh = mi.Mesh(name, vertex_count=len(points), face_count=len(triangles), props=properties)
        values = mi.traverse(mesh)
        values["vertex_positions"] = points.astype(np.float32).ravel()
        values["faces"] = np.ravel(index).astype(np.uint32)
        values.update()
        return mesh

    def emitter(self, lamp):
        mi = self.mi
        value = {"type": "rgb", "value": three(lamp.intensity).tolist()}
        if lamp.kind == POINT:
            return {"type": "point", "position": lamp.position.tolist(), "intensity": value}
        if lamp.kind == SKY:
            return {"type": "constant", "radiance": value}
        if lamp.kind == PANEL:
            a, b, _, d = lamp.corners
            place = np.eye(4)
            place[:3, 0], place[:3, 1] = (b - a) / 2, (d - a) / 2
            place[:3, 2] = np.cross(place[:3, 0], place[:3, 1])
            place[:3, 2] /= np.linalg.norm(place[:3, 2])
            place[:3, 3] = lamp.corners.mean(0)
            value["value"] = (three(lamp.intensity) / np.pi).tolist()
            return {"type": "rectangle", "to_world": mi.ScalarTransform4f(place),
                    "emitter": {"type": "area", "radiance": value}}
        return {"type": "directional", "direction": lamp.direction.tolist(), "irradiance": value}

    def build(self, scene):
        mi = self.mi
        self.lamps = None
        content = {"type": "scene", "integrator": {
            "type": "path", "max_depth": DEPTH, "rr_depth": ROULETTE}}
        if len(scene.lamps) > MANY:
            self.lamps = [mi.Float(v.astype(np.float32)) for v in (
                *np.array([lamp.position for lamp in scene.lamps]).T,
                np.array([lamp.intensity[0] for lamp in scene.lamps]))]
        else:
            for number, lamp in enumerate(scene.lamps):
                content[f"lamp{number}"] = self.emitter(lamp)
        if scene.blockers:
            points, triangles = joined(scene.blockers)
            content["blockers"] = self.mesh("blockers", points[triangles], [0.0] * 3, [0.0] * 3, True)
        self.first = {}
        self.cell_of = []
        if len(scene.corners):
            optics = np.column_stack([scene.reflectance, scene.exitance, scene.two_sided])
            _, kind = np.unique(optics, axis=0, return_inverse=True)
            for number in range(np.ravel(kind).max() + 1):
                cells = np.flatnonzero(np.ravel(kind) == number)
                triangles, owner = scene_triangles(scene, cells)
                self.first[f"kind{number}"] = sum(map(len, self.cell_of))
                self.cell_of.append(owner)
                content[f"kind{number}"] = self.mesh(
                    f"kind{number}", triangles, three(scene.reflectance[cells[0]]).tolist(),
                    three(scene.exitance[cells[0]]).tolist(), scene.two_sided[cells[0]])
        self.scene = mi.load_dict(content)
        self.find_cells()
        self.places(scene)

    def find_cells(self):
        """Where each shape's triangles begin, by the number that Dr.Jit gives the shape."""
        mi, dr = self.mi, self.dr
        numbers = {shape.id(): int(dr.reinterpret_array_v(mi.UInt32, mi.ShapePtr(shape))[0])
                   for shape in self.scene.shapes()}
        first = np.zeros(max(numbers.values(), default=0) + 1, np.uint32)
        for name, begin in self.first.items():
            first[numbers[name]] = begin
        self.offsets = mi.UInt32(first)
        self.owner = mi.UInt32(np.concatenate([*self.cell_of, [0]]).astype(np.uint32))

    def places(self, scene):
        """A corner, two sides and the normal of each cell as arrays of the kernel."""
        mi = self.mi
        self.square = scene.sensors is None and scene.corners.shape[1] == 4
        a = scene.sensors if scene.sensors is not None else scene.corners[:, 0]
        sides = [np.zeros_like(a), np.zeros_like(a)]
        if scene.sensors is None:
            sides = [scene.corners[:, k] - a for k in (1, -1)]
        self.cells = [[mi.Float(np.ascontiguousarray(v[:, c], np.float32)) for c in range(3)]
                      for v in (a, *sides, scene.normals)]

    # Kernels

    def start(self, chosen, each, sampler):
        """A surface interaction on a random place of each of the cells `chosen`, `each` times."""
        mi, dr = self.mi, self.dr
        count = len(chosen) * each
        number = dr.arange(mi.UInt32, count) // each
        cell = dr.gather(mi.UInt32, mi.UInt32(chosen.astype(np.uint32)), number)
        a, s, t, normal = ([dr.gather(mi.Float, values, cell) for values in group]
                           for group in self.cells)
        u = sampler.next_2d()
        if not self.square:
            u = mi.warp.square_to_uniform_triangle(u)
        si = dr.zeros(mi.SurfaceInteraction3f, count)
        si.p = mi.Point3f(*a) + mi.Vector3f(*s) * u.x + mi.Vector3f(*t) * u.y
        si.n = mi.Normal3f(*normal)
        si.sh_frame = mi.Frame3f(si.n)
        return si, number

    def from_lamps(self, si, number, each, sampler):
        """One of many point lights, all of them in turn: light that arrives."""
        mi, dr = self.mi, self.dr
        lamps = len(self.lamps[0])
        place = (mi.Float(dr.arange(mi.UInt32, len(number)) - number * each) + (
            0.5 if each == lamps else sampler.next_1d())) / each
        chosen = dr.minimum(mi.UInt32(place * lamps), lamps - 1)
        *position, power = (dr.gather(mi.Float, values, chosen) for values in self.lamps)
        way = mi.Point3f(*position) - si.p
        square = dr.squared_norm(way)
        cosine = dr.dot(way, si.n)
        ray = si.spawn_ray_to(mi.Point3f(*position))
        hidden = self.scene.ray_test(ray, cosine > 0.0)
        value = power * lamps * dr.maximum(cosine, 0.0) / (square * dr.sqrt(square))
        return mi.Color3f(dr.select(hidden, 0.0, value))

    def gather(self, scene, chosen, each, seed):
        """Irradiance of the cells `chosen` by `each` samples from each: directly, or by paths."""
        mi, dr = self.mi, self.dr
        sampler = mi.load_dict({"type": "multijitter" if self.lamps is None else "independent",
                                "sample_count": each})
        sampler.set_samples_per_wavefront(each)
        sampler.seed(seed, len(chosen) * each)
        si, number = self.start(chosen, each, sampler)
        if self.lamps is not None:
            total = self.from_lamps(si, number, each, sampler)
        else:
            record, weight = self.scene.sample_emitter_direction(si, sampler.next_2d(), True)
            cosine = dr.maximum(dr.dot(record.d, si.n), 0.0)
            total = weight * cosine
            if self.way == "paths":
                total *= dr.select(record.delta, 1.0, self.heuristic(record.pdf, cosine / dr.pi))
                total += self.continued(si, sampler)
        # Float sums of a few hundred samples, summed on in double: no rounding is blamed on it.
        parts = -(-each // 256)
        sums = dr.zeros(mi.Float, len(chosen) * parts * 3)
        place = number * parts + (dr.arange(mi.UInt32, len(number)) - number * each) // 256
        for band in range(3):
            dr.scatter_reduce(dr.ReduceOp.Add, sums, total[band], place * 3 + band)
        sums = np.array(sums, dtype=float).reshape(len(chosen), parts, 3).sum(1) / each
        return sums[:, :scene.bands]

    def continued(self, si, sampler):
        """What arrives along one cosine-weighted ray."""
        mi, dr = self.mi, self.dr
        way = mi.warp.square_to_cosine_hemisphere(sampler.next_2d())
        ray = si.spawn_ray(si.to_world(way))
        color = self.scene.integrator().sample(self.scene, sampler, mi.RayDifferential3f(ray))[0]
        met = self.scene.ray_intersect(ray)
        emitter = met.emitter(self.scene)
        record = mi.DirectionSample3f(self.scene, met, si)
        shines = dr.neq(emitter, None)
        pdf = self.scene.pdf_emitter_direction(si, record, shines)
        share = dr.select(shines, self.heuristic(way.z / dr.pi, pdf), 1.0)
        return dr.pi * (color - (1.0 - share) * emitter.eval(met, shines))

    def heuristic(self, a, b):
        """Veach's power heuristic."""
        return self.dr.select(a > 0.0, a * a / (a * a + b * b), 0.0)

    def trace_particles(self, scene, count, seed):
        """Irradiance of the cells by `count` light paths."""
        mi, dr = self.mi, self.dr
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(seed, count)
        sums = dr.zeros(mi.Float, 3 * len(scene))
        ray, weight, _ = self.scene.sample_emitter_ray(
            0.0, sampler.next_1d(), sampler.next_2d(), sampler.next_2d(), True)
        power = mi.Color3f(weight)
        full = dr.max(power)
        active = mi.Bool(True)
        depth = mi.UInt32(0)
        both = mi.Bool(scene.two_sided) if scene.two_sided.any() else None
        loop = mi.Loop("particles", lambda: (sampler, ray, power, active, depth))
        loop.set_max_iterations(DEPTH)
        while loop(active):
            si = self.scene.ray_intersect(ray, active)
            active &= si.is_valid()
            pointers = dr.reinterpret_array_v(mi.UInt32, si.shape)
            triangle = dr.gather(mi.UInt32, self.offsets, pointers, active) + si.prim_index
            cell = dr.gather(mi.UInt32, self.owner, triangle, active)
            front = si.wi.z > 0.0
            if both is None:
                active &= front
            else:
                active &= front | dr.gather(mi.Bool, both, cell, active)
            for band in range(scene.bands):
                dr.scatter_reduce(dr.ReduceOp.Add, sums, power[band], cell * 3 + band, active & front)
            sample, value = si.bsdf(ray).sample(
                mi.BSDFContext(mi.TransportMode.Importance), si, sampler.next_1d(active),
                sampler.next_2d(active), active)
            power *= value
            active &= dr.max(power) > 0.0
            ray = si.spawn_ray(si.to_world(sample.wo))
            depth += 1
            chance = dr.select(depth >= ROULETTE, dr.minimum(dr.max(power) / full, 0.95), 1.0)
            active &= (sampler.next_1d(active) < chance) & (depth < DEPTH)
            power *= dr.rcp(chance)
        sums = np.array(sums, dtype=float).reshape(-1, 3)[:, :scene.bands]
        return sums / (count * scene.area[:, None])

    def estimate(self, scene, amount, seed, chosen=None):
        """`amount`: particles, or samples a cell (`chosen`: of these cells alone); in passes that
        memory holds."""
        if self.way == "particles":
            passes = -(-amount // LARGEST)
            return sum(self.trace_particles(scene, amount // passes, seed + k)
                       for k in range(passes)) / passes
        chosen = np.arange(len(scene)) if chosen is None else chosen
        step = max(1, LARGEST // amount)
        if amount <= LARGEST:
            return np.concatenate([self.gather(scene, chosen[i:i + step], amount, seed + i)
                                   for i in range(0, len(chosen), step)])
        passes = -(-amount // LARGEST)
        return sum(self.estimate(scene, amount // passes, seed + 7919 * k, chosen)
                   for k in range(passes)) / passes

    def steps(self, scene):
        if self.way == "particles":
            return [1 << k for k in range(12, 34)]
        if self.lamps is not None:
            return [1, 4, 16, 64, 256, 1024, 2048, 4096, len(scene.lamps)]
        points = scene.sensors is not None and all(lamp.kind == POINT for lamp in scene.lamps)
        return [1] if points else [1, 4, 16, 36, 64, 144, 256, 576, 1024, 2304, 4096, 9216, 16384, 65536]

    def sweep(self, scene, seconds):
        """Yields setting, values, seconds, and seconds with loading and compiling."""
        begin = clock()
        self.build(scene)
        building = clock() - begin
        cold = 0.0
        for amount in self.steps(scene):
            if amount * (1 if self.way == "particles" else len(scene)) <= LARGEST:
                begin = clock()  # larger runs are made of passes that are compiled already
                self.estimate(scene, amount, 0)
                cold = clock() - begin
            begin = clock()
            values = self.estimate(scene, amount, 1000)
            spent = clock() - begin
            what = "particles" if self.way == "particles" else "samples a cell"
            yield f"{amount} {what}", values, spent, building + max(cold, spent)
            if spent > seconds:
                break


def scene_triangles(scene, cells):
    """The triangles of cells and the cell that each is of."""
    corners = scene.corners[cells]
    if corners.shape[1] == 3:
        return corners, cells
    return (corners[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3, 3), np.repeat(cells, 2))
