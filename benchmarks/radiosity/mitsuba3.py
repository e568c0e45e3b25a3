# SPDX-License-Identifier: BSD-3-Clause
"""Mitsuba 3 on the Cornell box (PyPI: mitsuba; 3.5.2 was used, variant llvm_ad_rgb), in two ways.

Its irradiancemeter measures a whole shape with a film of its own: one sensor a cell, a start of the
kernel each, thousands of them; far slower than asking for all cells in one kernel. So no sensor is used:

- "Mitsuba 3, paths": from points of each cell, stratified by its own multijittered sampler, one sample
  of the emitters (scene.sample_emitter_direction) and one cosine-weighted ray that its `path`
  integrator continues. What that ray meets first does not count where it is an emitter: it was
  sampled.
- "Mitsuba 3, particles": light paths from the emitters (scene.sample_emitter_ray), which leave their
  power on each cell they meet and go on as the cell's bsdf samples. One loop in one kernel. In a box
  of diffuse walls every bounce is an answer for some cell: this is the fastest way we found to get all
  cells' irradiance out of Mitsuba. Its own ptracer integrator does this for cameras only.

Loading and compiling are counted apart. Russian roulette is Mitsuba's own: from the fifth bounce on, with
what is left of the throughput as the chance to go on (at most 0.95).
"""
import numpy as np

DEPTH = 128  # bounces that nothing reaches
ROULETTE = 5  # Mitsuba's default
LARGEST = 1 << 22  # paths a pass


class Mitsuba:
    def __init__(self, threads, clock, particles):
        import drjit
        import mitsuba

        mitsuba.set_variant("llvm_ad_rgb")
        drjit.set_thread_count(threads)
        self.dr, self.mi, self.version = drjit, mitsuba, mitsuba.__version__
        self.clock, self.particles = clock, particles
        self.name = "Mitsuba 3, particles" if particles else "Mitsuba 3, paths"

    def mesh(self, box, number):
        mi = self.mi
        begin, end = box.kinds[number]
        properties = mi.Properties()
        properties["bsdf"] = mi.load_dict({"type": "diffuse", "reflectance": {
            "type": "rgb", "value": box.reflectance[begin].tolist()}})
        if box.exitance[begin].max() > 0.0:
            properties["emitter"] = mi.load_dict({"type": "area", "radiance": {
                "type": "rgb", "value": (box.exitance[begin] / np.pi).tolist()}})
        corners = box.corners[begin:end].reshape(-1, 3)
        points, index = np.unique(corners.round(9), axis=0, return_inverse=True)
        mesh = mi.Mesh(f"kind{number}", vertex_count=len(points), face_count=end - begin,
                       props=properties)
        values = mi.traverse(mesh)
        values["vertex_positions"] = points.astype(np.float32).ravel()
        values["faces"] = np.ravel(index).astype(np.uint32)
        values.update()
        return mesh

    def build(self, box):
        mi = self.mi
        content = {"type": "scene", "integrator": {
            "type": "path", "max_depth": DEPTH, "rr_depth": ROULETTE}}
        for number in range(len(box.kinds)):
            content[f"kind{number}"] = self.mesh(box, number)
        for number, lamp in enumerate(getattr(box, "lamps", ())):
            content[f"lamp{number}"] = {
                "type": "point", "position": lamp.tolist(),
                "intensity": {"type": "rgb", "value": [box.intensity] * 3}}
        self.scene = mi.load_dict(content)
        self.prepare(box)
        self.corners = [mi.Float(np.ascontiguousarray(box.corners[:, k, c], np.float32))
                  for k in range(3) for c in range(3)]
        self.normals = [mi.Float(np.ascontiguousarray(box.normal[:, c], np.float32)) for c in range(3)]

    def cells_met(self, si, active):
        """The number of the cell that was met: its mesh's first plus the triangle's number."""
        mi, dr = self.mi, self.dr
        pointers = dr.reinterpret_array_v(mi.UInt32, si.shape)
        return dr.gather(mi.UInt32, self.offsets, pointers, active) + si.prim_index

    def prepare(self, box):
        """Where each shape's cells begin, by the number that Dr.Jit gives the shape."""
        mi, dr = self.mi, self.dr
        numbers = []
        for shape in self.scene.shapes():
            pointer = dr.reinterpret_array_v(mi.UInt32, mi.ShapePtr(shape))
            numbers.append(int(pointer[0]))
        offsets = np.zeros(max(numbers) + 1, np.uint32)
        for number, shape in zip(numbers, self.scene.shapes()):
            offsets[number] = box.kinds[int(shape.id()[4:])][0]
        self.offsets = mi.UInt32(offsets)

    def trace_particles(self, box, count, seed):
        """Irradiance of the cells by `count` light paths."""
        mi, dr = self.mi, self.dr
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(seed, count)
        sums = dr.zeros(mi.Float, 3 * len(box))
        ray, weight, _ = self.scene.sample_emitter_ray(
            0.0, sampler.next_1d(), sampler.next_2d(), sampler.next_2d(), True)
        power = mi.Color3f(weight)
        full = dr.max(power)
        active = mi.Bool(True)
        depth = mi.UInt32(0)
        loop = mi.Loop("particles", lambda: (sampler, ray, power, active, depth))
        loop.set_max_iterations(DEPTH)
        while loop(active):
            si = self.scene.ray_intersect(ray, active)
            active &= si.is_valid()
            active &= si.wi.z > 0.0
            cell = self.cells_met(si, active)
            for band in range(3):
                dr.scatter_reduce(dr.ReduceOp.Add, sums, power[band], cell * 3 + band, active)
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
        return np.array(sums, dtype=float).reshape(-1, 3) / (count * box.area[:, None])

    def trace_paths(self, chosen, each, seed):
        """Irradiance of the cells `chosen` by `each` paths from each (a square)."""
        mi, dr = self.mi, self.dr
        count = len(chosen) * each
        sampler = mi.load_dict({"type": "multijitter", "sample_count": each})
        sampler.set_samples_per_wavefront(each)
        sampler.seed(seed, count)
        number = dr.arange(mi.UInt32, count) // each
        cell = dr.gather(mi.UInt32, mi.UInt32(chosen), number)
        get = [dr.gather(mi.Float, values, cell) for values in self.corners]
        a, b, c = (mi.Point3f(*get[3 * k:3 * k + 3]) for k in range(3))
        normal = mi.Normal3f(*[dr.gather(mi.Float, values, cell) for values in self.normals])
        u = mi.warp.square_to_uniform_triangle(sampler.next_2d())
        si = dr.zeros(mi.SurfaceInteraction3f, count)
        si.p = a + (b - a) * u.x + (c - a) * u.y
        si.n = normal
        si.sh_frame = mi.Frame3f(normal)
        record, weight = self.scene.sample_emitter_direction(si, sampler.next_2d(), True)
        total = weight * dr.maximum(dr.dot(record.d, normal), 0.0)
        way = si.to_world(mi.warp.square_to_cosine_hemisphere(sampler.next_2d()))
        ray = si.spawn_ray(way)
        color = self.scene.integrator().sample(self.scene, sampler, mi.RayDifferential3f(ray))[0]
        met = self.scene.ray_intersect(ray)
        total += dr.pi * (color - met.emitter(self.scene).eval(met))
        # Float sums of a few hundred samples, summed on in double: no rounding is blamed on it.
        parts = -(-each // 256)
        sums = dr.zeros(mi.Float, len(chosen) * parts * 3)
        place = number * parts + (dr.arange(mi.UInt32, count) - number * each) // 256
        for band in range(3):
            dr.scatter_reduce(dr.ReduceOp.Add, sums, total[band], place * 3 + band)
        return np.array(sums, dtype=float).reshape(len(chosen), parts, 3).sum(1) / each

    def estimate(self, box, amount, seed, chosen=None):
        """`amount`: particles, or paths a cell (`chosen`: of these cells alone); in passes that
        memory holds."""
        if self.particles:
            passes = -(-amount // LARGEST)
            return sum(self.trace_particles(box, amount // passes, seed + k)
                       for k in range(passes)) / passes
        chosen = np.arange(len(box)) if chosen is None else chosen
        chosen = np.asarray(chosen, np.uint32)
        passes = 1
        while len(chosen) * amount > passes * LARGEST:
            passes *= 4
        return sum(self.trace_paths(chosen, amount // passes, seed + k)
                   for k in range(passes)) / passes

    def sweep(self, box, seconds):
        begin = self.clock()
        self.build(box)
        building = self.clock() - begin
        cold = 0.0
        steps = [1 << k for k in range(14, 34, 1)] if self.particles else [4**k for k in range(10)]
        for amount in steps:
            begin = self.clock()
            if amount * (1 if self.particles else len(box)) <= LARGEST:  # else in passes that are known
                self.estimate(box, amount, 0)
                cold = self.clock() - begin
            begin = self.clock()
            values = self.estimate(box, amount, 1000)
            spent = self.clock() - begin
            what = f"{amount} particles" if self.particles else f"{amount} paths a cell"
            yield what, values, spent, building + cold
            if spent > seconds:
                break
