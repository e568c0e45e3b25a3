# SPDX-License-Identifier: BSD-3-Clause
"""Builds the example scenes as glTF files with Python's standard library alone.

Geometry is in metres, Y up. Every polygon's corners turn counter-clockwise as seen from its front.
Points are kept once for each object, so that faces which meet share them.
"""
import json
import math
import struct


def subtract(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def normalized(a):
    length = math.sqrt(dot(a, a))
    return tuple(x / length for x in a)


def look_rotation(direction, up=(0.0, 1.0, 0.0)):
    """Quaternion (x, y, z, w) of a node whose -Z looks along `direction`, for lights and cameras."""
    z = normalized(tuple(-d for d in direction))
    side = cross(up, z)
    if dot(side, side) < 1e-12:
        side = cross((0.0, 0.0, 1.0), z)
    x = normalized(side)
    y = cross(z, x)
    # Columns x, y, z of a rotation to a quaternion: the largest of the four squares first.
    squares = (1 + x[0] - y[1] - z[2], 1 - x[0] + y[1] - z[2], 1 - x[0] - y[1] + z[2],
               1 + x[0] + y[1] + z[2])
    k = max(range(4), key=lambda i: squares[i])
    s = 2 * math.sqrt(squares[k])
    if k == 0:
        q = (s / 4, (x[1] + y[0]) / s, (x[2] + z[0]) / s, (y[2] - z[1]) / s)
    elif k == 1:
        q = ((x[1] + y[0]) / s, s / 4, (y[2] + z[1]) / s, (z[0] - x[2]) / s)
    elif k == 2:
        q = ((x[2] + z[0]) / s, (y[2] + z[1]) / s, s / 4, (x[1] - y[0]) / s)
    else:
        q = ((y[2] - z[1]) / s, (z[0] - x[2]) / s, (x[1] - y[0]) / s, s / 4)
    return list(q)


class Object:
    """One mesh of one material. Flat faces, or smooth ones where normals are given."""

    def __init__(self, name, material):
        self.name = name
        self.material = material
        self.points = []
        self.normals = []
        self.triangles = []
        self._known = {}

    def point(self, position, normal):
        """The index of a point; the same one for the same position and normal."""
        position = tuple(float(f"{c:.9g}") + 0.0 for c in position)
        key = (position, tuple(round(c, 6) for c in normal))
        if key not in self._known:
            self._known[key] = len(self.points)
            self.points.append(position)
            self.normals.append(normal)
        return self._known[key]

    def polygon(self, corners):
        """A flat convex polygon."""
        normal = normalized(cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0])))
        index = [self.point(c, normal) for c in corners]
        for i in range(1, len(index) - 1):
            self.triangles.append((index[0], index[i], index[i + 1]))

    def triangle(self, corners, normals=None):
        if normals is None:
            self.polygon(corners)
            return
        self.triangles.append(tuple(self.point(c, n) for c, n in zip(corners, normals)))

    def grid(self, axis, at, u_breaks, v_breaks, facing, holes=(), only=None):
        """A wall normal to an axis (0, 1, 2) cut along the break lines into quadrilaterals, facing
        +1 or -1 along the axis. u and v are the other two axes in order. Quadrilaterals inside a
        hole (u0, u1, v0, v1) are left out; with `only`, those outside it are."""
        u_axis, v_axis = [a for a in range(3) if a != axis]

        def corner(u, v):
            p = [0.0, 0.0, 0.0]
            p[axis], p[u_axis], p[v_axis] = at, u, v
            return tuple(p)

        def inside(u, v, box):
            return box[0] < u < box[1] and box[2] < v < box[3]

        # u x v is +axis for axes 0 and 2 (y x z = x, x x y = z) and -axis for 1 (x x z = -y).
        turn = facing * (-1 if axis == 1 else 1)
        for u0, u1 in zip(u_breaks, u_breaks[1:]):
            for v0, v1 in zip(v_breaks, v_breaks[1:]):
                middle = ((u0 + u1) / 2, (v0 + v1) / 2)
                if any(inside(*middle, hole) for hole in holes):
                    continue
                if only is not None and not inside(*middle, only):
                    continue
                quad = [corner(u0, v0), corner(u1, v0), corner(u1, v1), corner(u0, v1)]
                self.polygon(quad if turn > 0 else quad[::-1])

    def box(self, low, high, skip=()):
        """A box seen from outside, without the faces named: "-x", "+x", "-y", ..."""
        for axis in range(3):
            u, v = [a for a in range(3) if a != axis]
            for sign, at in ((-1, low[axis]), (1, high[axis])):
                if ("-+"[sign > 0] + "xyz"[axis]) not in skip:
                    self.grid(axis, at, (low[u], high[u]), (low[v], high[v]), sign)

    def prism(self, outline, bottom, top, skip=()):
        """An upright prism over a convex outline of (x, z), seen from outside."""
        area = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(outline, outline[1:] + outline[:1]))
        if area > 0:  # clockwise as seen from above, where x points right and z down
            outline = outline[::-1]
        for a, b in zip(outline, outline[1:] + outline[:1]):
            self.polygon([(a[0], bottom, a[1]), (b[0], bottom, b[1]), (b[0], top, b[1]),
                          (a[0], top, a[1])])
        if "top" not in skip:
            self.polygon([(x, top, z) for x, z in outline])
        if "bottom" not in skip:
            self.polygon([(x, bottom, z) for x, z in outline[::-1]])

    def revolve(self, center, profile, segments):
        """A smooth surface of revolution about the vertical through `center`: `profile` is a list
        of (radius, height, outward radius part, outward height part of the normal), from below."""
        def at(k, j):
            radius, height, nr, ny = profile[j]
            angle = 2 * math.pi * (k % segments) / segments
            c, s = math.cos(angle), math.sin(angle)
            return ((center[0] + radius * c, center[1] + height, center[2] + radius * s),
                    normalized((nr * c, ny, nr * s)))

        for k in range(segments):
            for j in range(len(profile) - 1):
                a, b, c, d = at(k, j), at(k, j + 1), at(k + 1, j + 1), at(k + 1, j)
                for three in ((a, b, c), (a, c, d)):
                    positions = [p for p, _ in three]
                    if len(set(positions)) == 3:
                        self.triangle(positions, [n for _, n in three])


    def place(self, angle, offset):
        """Turns everything about the vertical by an angle [degrees], then moves it."""
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))

        def turned(p):
            return (c * p[0] + s * p[2], p[1], -s * p[0] + c * p[2])

        self.points = [tuple(a + b for a, b in zip(turned(p), offset)) for p in self.points]
        self.normals = [turned(n) for n in self.normals]
        self._known = {}


def breaks(low, high, marks=(), longest=1.0):
    """Break lines between two ends through all the marks, none further apart than `longest`."""
    low, high = round(low, 6), round(high, 6)
    lines = sorted({low, high, *(round(m, 6) for m in marks if low < round(m, 6) < high)})
    result = [low]
    for a, b in zip(lines, lines[1:]):
        count = max(1, math.ceil((b - a) / longest - 1e-9))
        result += [a + (b - a) * i / count for i in range(1, count)] + [b]
    return result


class Scene:
    """A glTF document with lights and a camera."""

    def __init__(self, generator):
        self.json = {
            "asset": {"version": "2.0", "generator": generator,
                      "copyright": "BSD-3-Clause, vtkRadiometry"},
            "scene": 0,
            "scenes": [{"nodes": []}],
            "nodes": [], "meshes": [], "materials": [], "accessors": [], "bufferViews": [],
        }
        self.bytes = bytearray()
        self.used = set()

    def material(self, name, color, roughness=1.0, specular=0.0, emission=None, luminance=0.0,
                 double_sided=False):
        """A dielectric of diffuse reflectance color * (1 - 0.04 specular). `emission` is the colour
        and `luminance` the luminance [cd/m^2] of what it emits."""
        self.used.add("KHR_materials_specular")
        fields = {
            "name": name,
            "pbrMetallicRoughness": {"baseColorFactor": [round(c, 6) for c in color] + [1.0],
                                     "metallicFactor": 0.0, "roughnessFactor": roughness},
            "extensions": {"KHR_materials_specular": {"specularFactor": specular}},
        }
        if emission is not None:
            self.used.add("KHR_materials_emissive_strength")
            top = max(emission)
            factor = [c / top for c in emission]
            luma = 0.2126 * factor[0] + 0.7152 * factor[1] + 0.0722 * factor[2]
            fields["emissiveFactor"] = [round(c, 9) for c in factor]
            fields["extensions"]["KHR_materials_emissive_strength"] = {
                "emissiveStrength": luminance / luma}
        if double_sided:
            fields["doubleSided"] = True
        self.json["materials"].append(fields)
        return len(self.json["materials"]) - 1

    def _accessor(self, code, kind, rows, target, bounds):
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        start = len(self.bytes)
        for row in rows:
            self.bytes += struct.pack("<" + code * len(row), *row)
        self.json["bufferViews"].append(
            {"buffer": 0, "byteOffset": start, "byteLength": len(self.bytes) - start,
             "target": target})
        accessor = {"bufferView": len(self.json["bufferViews"]) - 1,
                    "componentType": {"f": 5126, "H": 5123}[code],
                    "count": len(rows), "type": kind}
        if bounds:
            # Of the values as the file holds them, in single precision.
            stored = [struct.unpack("<fff", struct.pack("<fff", *row)) for row in rows]
            accessor["min"] = [min(c) for c in zip(*stored)]
            accessor["max"] = [max(c) for c in zip(*stored)]
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def node(self, **fields):
        self.json["nodes"].append(fields)
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def add(self, thing):
        corners = [(i,) for t in thing.triangles for i in t]
        primitive = {
            "attributes": {
                "POSITION": self._accessor("f", "VEC3", thing.points, 34962, True),
                "NORMAL": self._accessor("f", "VEC3", thing.normals, 34962, False),
            },
            "indices": self._accessor("H", "SCALAR", corners, 34963, False),
            "material": thing.material,
        }
        self.json["meshes"].append({"name": thing.name, "primitives": [primitive]})
        self.node(name=thing.name, mesh=len(self.json["meshes"]) - 1)

    def light(self, name, kind, intensity, position, direction=(0, -1, 0), color=(1, 1, 1),
              cone=None):
        """`intensity` in cd, or lx for a directional light; `cone`: inner and outer half-angle
        in degrees."""
        self.used.add("KHR_lights_punctual")
        fields = {"name": name, "type": kind, "intensity": intensity, "color": list(color)}
        if cone is not None:
            fields["spot"] = {"innerConeAngle": math.radians(cone[0]),
                              "outerConeAngle": math.radians(cone[1])}
        lights = self.json.setdefault("extensions", {}).setdefault(
            "KHR_lights_punctual", {"lights": []})["lights"]
        lights.append(fields)
        self.node(name=name, translation=list(position), rotation=look_rotation(direction),
                  extensions={"KHR_lights_punctual": {"light": len(lights) - 1}})

    def camera(self, position, target, vertical_angle, aspect):
        self.json["cameras"] = [{
            "name": "Camera", "type": "perspective",
            "perspective": {"yfov": math.radians(vertical_angle), "aspectRatio": aspect,
                            "znear": 0.05, "zfar": 100.0}}]
        self.node(name="Camera", camera=0, translation=list(position),
                  rotation=look_rotation(subtract(target, position)))

    def triangle_count(self):
        return sum(self.json["accessors"][p["indices"]]["count"] // 3
                   for m in self.json["meshes"] for p in m["primitives"])

    def write(self, path):
        """As binary glTF (.glb)."""
        document = dict(self.json, buffers=[{"byteLength": len(self.bytes)}],
                        extensionsUsed=sorted(self.used))
        text = json.dumps(document, indent=1).encode()
        text += b" " * (-len(text) % 4)
        body = bytes(self.bytes) + b"\0" * (-len(self.bytes) % 4)
        length = 12 + 8 + len(text) + 8 + len(body)
        with open(path, "wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, length))
            file.write(struct.pack("<I4s", len(text), b"JSON") + text)
            file.write(struct.pack("<I4s", len(body), b"BIN\0") + body)
        print(f"{path}: {self.triangle_count()} triangles, {length} bytes")


def _side(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _crosses(a, b, c, d):
    """Whether the open segments ab and cd cross."""
    return (_side(a, b, c) * _side(a, b, d) < 0) and (_side(c, d, a) * _side(c, d, b) < 0)


def _area(ring):
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1])) / 2


def _least_angle(a, b, c):
    angles = []
    for p, q, r in ((a, b, c), (b, c, a), (c, a, b)):
        u, v = (q[0] - p[0], q[1] - p[1]), (r[0] - p[0], r[1] - p[1])
        angles.append(math.atan2(abs(u[0] * v[1] - u[1] * v[0]), u[0] * v[0] + u[1] * v[1]))
    return min(angles)


def triangulate(outline, holes=()):
    """Triangles (counter-clockwise, as triples of points) of a plane polygon with holes: the holes
    are joined to the outline by bridges, then ears are cut, the best shaped first."""
    ring = list(outline) if _area(outline) > 0 else list(outline)[::-1]
    rest = [list(h) if _area(h) < 0 else list(h)[::-1] for h in holes]
    while rest:
        edges = list(zip(ring, ring[1:] + ring[:1]))
        edges += [e for h in rest for e in zip(h, h[1:] + h[:1])]
        length, i, hole, j = min(
            (math.dist(ring[i], hole[j]), i, rest.index(hole), j)
            for i in range(len(ring)) for hole in rest for j in range(len(hole))
            if not any(_crosses(ring[i], hole[j], *edge) for edge in edges))
        inner = rest.pop(hole)
        ring = ring[:i + 1] + inner[j:] + inner[:j + 1] + ring[i:]
    triangles = []
    while len(ring) > 3:
        ears = []
        for i in range(len(ring)):
            a, b, c = ring[i - 1], ring[i], ring[(i + 1) % len(ring)]
            if _side(a, b, c) <= 0:
                continue
            inside = any(p not in (a, b, c) and _side(a, b, p) >= 0 and _side(b, c, p) >= 0 and
                         _side(c, a, p) >= 0 for p in ring)
            if not inside:
                ears.append((_least_angle(a, b, c), i))
        i = max(ears)[1]
        triangles.append((ring[i - 1], ring[i], ring[(i + 1) % len(ring)]))
        del ring[i]
    triangles.append(tuple(ring))
    return triangles
