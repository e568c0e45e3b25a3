#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes gallery.glb: a furnished room of 6 x 5 x 3 m with one point light (the pendant), one spot
(on the sculpture) and one directional light (the sun through the window).

The room is closed: every surface meets its neighbours in shared edges, and what stands against a
wall or large on the floor has no surface behind it. Reflectances are plausible ones (ceiling 0.85,
walls 0.75, floor 0.3), within the ranges that EN 12464-1:2021, 6.2.2 recommends for rooms.
"""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from gltf_builder import Object, Scene, breaks, cross, dot, normalized  # noqa: E402

X, Y, Z = 6.0, 3.0, 5.0             # the room: x 0..6, z 0..5, floor at 0
SKIRTING, THICK = 0.1, 0.018        # its height and thickness
DOOR = (3.95, 4.85, 2.03)           # in the wall z = 0: x from, to, height
TRIM = 0.07                         # the door's trim, flush with the skirting
DOOR_DEPTH = 0.1
WINDOW = (0.9, 2.1, 2.1, 3.9)       # in the wall x = 0: y from, to, z from, to
REVEAL = 0.3
PICTURES = ((0.55, 1.45, 1.2, 2.1), (1.85, 2.65, 1.2, 2.1))  # in the wall z = 0: x, x, y, y
FRAME, FRAME_DEPTH = 0.035, 0.03
PLINTH = (3.0, 3.4, 0.75, 1.15)     # x, x, z, z
PLINTH_HEIGHT = 1.0
TABLE = (2.3, 2.95)                 # centre
TABLE_HEIGHT = 0.74
LAMP = (TABLE[0], 1.95, TABLE[1])
SPOT = (3.85, 2.86, 2.5)
SCULPTURE_HEIGHT = 1.33
SUN = (0.62, -0.42, -0.66)          # where its light travels to

X_MARKS = [DOOR[0] - TRIM, DOOR[1] + TRIM, *PLINTH[:2], *(v for p in PICTURES for v in p[:2])]
Y_MARKS = [SKIRTING, DOOR[2] + TRIM, *WINDOW[:2], *(v for p in PICTURES for v in p[2:])]
Z_MARKS = [*WINDOW[2:], *PLINTH[2:]]
WALL_X = breaks(0.0, X, X_MARKS)
WALL_Y = breaks(SKIRTING, Y, Y_MARKS)
WALL_Z = breaks(0.0, Z, Z_MARKS)


def inset(lines):
    """The break lines of the floor, which ends at the skirting."""
    return [lines[0] + THICK, *lines[1:-1], lines[-1] - THICK]


def shell(scene, materials):
    floor = Object("floor", materials["oak"])
    floor.grid(1, 0.0, inset(WALL_X), inset(WALL_Z), 1, holes=[PLINTH])
    threshold = breaks(DOOR[0], DOOR[1], WALL_X)
    floor.grid(1, 0.0, threshold, (-DOOR_DEPTH, THICK), 1)
    ceiling = Object("ceiling", materials["ceiling"])
    ceiling.grid(1, Y, WALL_X, WALL_Z, -1)
    scene.add(floor)
    scene.add(ceiling)

    north = Object("north wall", materials["wall"])
    trimmed = (DOOR[0] - TRIM, DOOR[1] + TRIM, SKIRTING, DOOR[2] + TRIM)
    north.grid(2, 0.0, WALL_X, WALL_Y, 1, holes=[trimmed, *PICTURES])
    south = Object("south wall", materials["wall"])
    south.grid(2, Z, WALL_X, WALL_Y, -1)
    east = Object("east wall", materials["wall"])
    east.grid(0, X, WALL_Y, WALL_Z, -1)
    west = Object("west wall", materials["sage"])
    west.grid(0, 0.0, WALL_Y, WALL_Z, 1, holes=[WINDOW])
    for wall in (north, south, east, west):
        scene.add(wall)


def skirting(scene, material):
    """A front and a ledge along each wall, mitred in the corners, broken by the door."""
    thing = Object("skirting", material)
    corners = [(0.0, 0.0, 1, 1), (X, 0.0, -1, 1), (X, Z, -1, -1), (0.0, Z, 1, -1)]

    def run(outer, inner):
        (ax, az), (bx, bz) = inner
        thing.polygon([(ax, 0, az), (bx, 0, bz), (bx, SKIRTING, bz), (ax, SKIRTING, az)])
        (cx, cz), (dx, dz) = outer
        thing.polygon([(ax, SKIRTING, az), (bx, SKIRTING, bz), (dx, SKIRTING, dz),
                       (cx, SKIRTING, cz)])

    for (ax, az, au, av), (bx, bz, bu, bv) in zip(corners, corners[1:] + corners[:1]):
        along, fixed = (0, az) if az == bz else (1, ax)
        lines = WALL_X if along == 0 else WALL_Z
        lines = lines if (ax, az) < (bx, bz) else lines[::-1]
        for p, q in zip(lines, lines[1:]):
            if along == 0 and fixed == 0.0 and DOOR[0] - TRIM <= (p + q) / 2 <= DOOR[1] + TRIM:
                continue
            ends = []
            for value in (p, q):
                outside = (value, fixed) if along == 0 else (fixed, value)
                at_start, at_end = outside == (ax, az), outside == (bx, bz)
                du = au if at_start or along == 1 else (bu if at_end else 0)
                dv = av if at_start or along == 0 else (bv if at_end else 0)
                ends.append((outside, (outside[0] + THICK * du, outside[1] + THICK * dv)))
            run([e[0] for e in ends], [e[1] for e in ends])
    scene.add(thing)


def door(scene, materials):
    x0, x1, top = DOOR
    lining = Object("door lining", materials["gloss white"])
    heights = breaks(0.0, top, Y_MARKS)
    lines = breaks(x0, x1, WALL_X)
    lining.grid(0, x0, heights, (-DOOR_DEPTH, THICK), 1)
    lining.grid(0, x1, heights, (-DOOR_DEPTH, THICK), -1)
    lining.grid(1, top, lines, (-DOOR_DEPTH, THICK), -1)
    # The trim: front, outer edges; the skirting runs into its sides.
    outer = (x0 - TRIM, x1 + TRIM, 0.0, top + TRIM)
    across = [outer[0], *lines, outer[1]]
    up = [*heights, outer[3]]
    lining.grid(2, THICK, across, up, 1, holes=[(x0, x1, -1.0, top)])
    # Its sides above the skirting, which runs into them.
    above = up[up.index(SKIRTING):]
    lining.grid(0, outer[0], above, (0.0, THICK), -1)
    lining.grid(0, outer[1], above, (0.0, THICK), 1)
    lining.grid(1, outer[3], across, (0.0, THICK), 1)
    scene.add(lining)

    leaf = Object("door", materials["door"])
    sides = (round(x0 + 0.12, 6), round(x1 - 0.12, 6))
    panels = [(*sides, 0.25, 0.95), (*sides, 1.1, 1.93)]
    marks_x = [v for p in panels for v in p[:2]] + lines
    marks_y = [v for p in panels for v in p[2:]] + Y_MARKS
    leaf.grid(2, -DOOR_DEPTH, breaks(x0, x1, marks_x), breaks(0.0, top, marks_y), 1, holes=panels)
    for a, b, c, d in panels:
        back = -DOOR_DEPTH - 0.012
        xs = [x for x in breaks(x0, x1, marks_x) if a <= x <= b]
        ys = [y for y in breaks(0.0, top, marks_y) if c <= y <= d]
        assert (xs[0], xs[-1], ys[0], ys[-1]) == (a, b, c, d)
        leaf.grid(2, back, xs, ys, 1)
        leaf.grid(0, a, ys, (back, -DOOR_DEPTH), 1)
        leaf.grid(0, b, ys, (back, -DOOR_DEPTH), -1)
        leaf.grid(1, c, xs, (back, -DOOR_DEPTH), 1)
        leaf.grid(1, d, xs, (back, -DOOR_DEPTH), -1)
    scene.add(leaf)
    knob = Object("door handle", materials["brass"])
    knob.box((x1 - 0.16, 1.02, -DOOR_DEPTH), (x1 - 0.05, 1.04, -DOOR_DEPTH + 0.05), skip=("-z",))
    scene.add(knob)


def window(scene, materials):
    y0, y1, z0, z1 = WINDOW
    ys = [y for y in WALL_Y if y0 <= y <= y1]
    zs = [z for z in WALL_Z if z0 <= z <= z1]
    reveal = Object("window reveal", materials["wall"])
    reveal.grid(1, y0, (-REVEAL, 0.0), zs, 1)
    reveal.grid(1, y1, (-REVEAL, 0.0), zs, -1)
    reveal.grid(2, z0, (-REVEAL, 0.0), ys, 1)
    reveal.grid(2, z1, (-REVEAL, 0.0), ys, -1)
    scene.add(reveal)
    sash = Object("window frame", materials["gloss white"])
    a, b, w, m = -0.22, -0.16, 0.06, 0.025
    zm, ym = (z0 + z1) / 2, y0 + 0.66 * (y1 - y0)
    sash.box((a, y0, z0), (b, y0 + w, z1), skip=("-y", "-z", "+z"))
    sash.box((a, y1 - w, z0), (b, y1, z1), skip=("+y", "-z", "+z"))
    sash.box((a, y0 + w, z0), (b, y1 - w, z0 + w), skip=("-y", "+y", "-z"))
    sash.box((a, y0 + w, z1 - w), (b, y1 - w, z1), skip=("-y", "+y", "+z"))
    sash.box((a, y0 + w, zm - m), (b, y1 - w, zm + m), skip=("-y", "+y"))
    sash.box((a, ym - m, z0 + w), (b, ym + m, zm - m), skip=("-z", "+z"))
    sash.box((a, ym - m, zm + m), (b, ym + m, z1 - w), skip=("-z", "+z"))
    scene.add(sash)


def pictures(scene, materials):
    """Framed canvases: fields of colour between lines, composed here."""
    fields = (
        (((0.0, 0.30, 0.0, 0.55), "canvas red"), ((0.70, 1.0, 0.62, 1.0), "canvas blue"),
         ((0.30, 0.70, 0.0, 0.30), "canvas ochre")),
        (((0.0, 1.0, 0.0, 0.28), "canvas blue"), ((0.0, 0.45, 0.28, 0.64), "canvas ochre"),
         ((0.45, 1.0, 0.64, 1.0), "canvas green")),
    )
    for number, ((x0, x1, y0, y1), plan) in enumerate(zip(PICTURES, fields), 1):
        frame = Object(f"picture frame {number}", materials["black"])
        inner = (x0 + FRAME, x1 - FRAME, y0 + FRAME, y1 - FRAME)
        xs = [x0, *[x for x in WALL_X if x0 < x < x1], x1]
        ys = [y0, *[y for y in WALL_Y if y0 < y < y1], y1]
        xs_all = sorted({*xs, inner[0], inner[1]})
        ys_all = sorted({*ys, inner[2], inner[3]})
        frame.grid(2, FRAME_DEPTH, xs_all, ys_all, 1, holes=[inner])
        frame.grid(0, x0, ys, (0.0, FRAME_DEPTH), -1)
        frame.grid(0, x1, ys, (0.0, FRAME_DEPTH), 1)
        frame.grid(1, y0, xs, (0.0, FRAME_DEPTH), -1)
        frame.grid(1, y1, xs, (0.0, FRAME_DEPTH), 1)
        canvas_z = FRAME_DEPTH - 0.012
        marks_x, marks_y = {inner[0], inner[1]}, {inner[2], inner[3]}
        boxes = []
        for (u0, u1, v0, v1), name in plan:
            box = (inner[0] + u0 * (inner[1] - inner[0]), inner[0] + u1 * (inner[1] - inner[0]),
                   inner[2] + v0 * (inner[3] - inner[2]), inner[2] + v1 * (inner[3] - inner[2]))
            boxes.append((box, name))
            marks_x |= set(box[:2])
            marks_y |= set(box[2:])
        xs, ys = breaks(*inner[:2], marks_x), breaks(*inner[2:], marks_y)
        frame.grid(0, inner[0], ys, (canvas_z, FRAME_DEPTH), 1)
        frame.grid(0, inner[1], ys, (canvas_z, FRAME_DEPTH), -1)
        frame.grid(1, inner[2], xs, (canvas_z, FRAME_DEPTH), 1)
        frame.grid(1, inner[3], xs, (canvas_z, FRAME_DEPTH), -1)
        scene.add(frame)
        ground = Object(f"picture {number} ground", materials["canvas"])
        ground.grid(2, canvas_z, xs, ys, 1, holes=[box for box, _ in boxes])
        scene.add(ground)
        for box, name in boxes:
            field = Object(f"picture {number} {name[7:]}", materials[name])
            field.grid(2, canvas_z, xs, ys, 1, only=box)
            scene.add(field)


def furniture(scene, materials):
    table = Object("table", materials["walnut"])
    table.box((-0.75, TABLE_HEIGHT - 0.04, -0.42), (0.75, TABLE_HEIGHT, 0.42))
    for x in (-0.68, 0.62):
        for z in (-0.35, 0.29):
            table.box((x, 0.0, z), (x + 0.06, TABLE_HEIGHT - 0.04, z + 0.06), skip=("-y", "+y"))
    table.place(12, (TABLE[0], 0.0, TABLE[1]))
    scene.add(table)
    for number, (angle, x, z) in enumerate(((8, 2.05, 2.25), (205, 2.65, 3.7)), 1):
        chair = Object(f"chair {number}", materials["chair"])
        chair.box((-0.21, 0.42, -0.21), (0.21, 0.46, 0.21))
        for a in (-0.19, 0.15):
            for b in (-0.19, 0.15):
                chair.box((a, 0.0, b), (a + 0.04, 0.42, b + 0.04), skip=("-y", "+y"))
        for a in (-0.19, 0.15):
            chair.box((a, 0.46, -0.21), (a + 0.04, 0.86, -0.18), skip=("-y",))
        chair.box((-0.15, 0.66, -0.205), (0.15, 0.84, -0.185), skip=("-x", "+x"))
        chair.place(angle, (x, 0.0, z))
        scene.add(chair)

    plinth = Object("plinth", materials["plinth"])
    plinth.box((PLINTH[0], 0.0, PLINTH[2]), (PLINTH[1], PLINTH_HEIGHT, PLINTH[3]), skip=("-y",))
    scene.add(plinth)

    vase = Object("vase", materials["glaze blue"])
    line = [(0.050, 0.0), (0.078, 0.03), (0.098, 0.08), (0.100, 0.13), (0.083, 0.18),
            (0.055, 0.22), (0.042, 0.255), (0.047, 0.278), (0.050, 0.285), (0.049, 0.289),
            (0.046, 0.289), (0.043, 0.284), (0.038, 0.255), (0.047, 0.215)]
    profile = []
    for j, (r, y) in enumerate(line):
        (r0, y0), (r1, y1) = line[max(j - 1, 0)], line[min(j + 1, len(line) - 1)]
        profile.append((r, y, y1 - y0, r0 - r1))
    centre = (TABLE[0] + 0.28, TABLE_HEIGHT, TABLE[1] + 0.02)
    vase.revolve(centre, profile, 16)
    vase.revolve(centre, [(0.047, 0.215, 0.0, 1.0), (0.0, 0.215, 0.0, 1.0)], 16)  # what it holds
    scene.add(vase)


def sculpture(scene, material):
    """A trefoil knot as a tube, lowest point on the plinth."""
    thing = Object("sculpture", material)
    around, across, size, tube = 60, 8, 0.082, 0.045
    angle = math.radians(40)

    def turned(p):
        return (math.cos(angle) * p[0] + math.sin(angle) * p[2], p[1],
                -math.sin(angle) * p[0] + math.cos(angle) * p[2])

    def knot(t):
        r = math.cos(3 * t) + 2
        return tuple(size * c for c in (r * math.cos(2 * t), r * math.sin(2 * t),
                                        -math.sin(3 * t)))

    rings = []
    for k in range(around):
        t, h = 2 * math.pi * k / around, 1e-4
        a, b, c = knot(t - h), knot(t), knot(t + h)
        tangent = normalized(tuple(u - v for u, v in zip(c, a)))
        # The knot lies on a torus, whose normal is a frame that closes after one turn.
        bend = (math.cos(3 * t) * math.cos(2 * t), math.cos(3 * t) * math.sin(2 * t),
                -math.sin(3 * t))
        bend = normalized(tuple(u - dot(bend, tangent) * v for u, v in zip(bend, tangent)))
        side = cross(tangent, bend)
        ring = []
        for j in range(across):
            phi = 2 * math.pi * j / across
            n = tuple(math.cos(phi) * u + math.sin(phi) * v for u, v in zip(bend, side))
            ring.append((turned(tuple(u + tube * v for u, v in zip(b, n))), turned(n)))
        rings.append(ring)
    lowest = min(p[1] for ring in rings for p, _ in ring)
    centre = ((PLINTH[0] + PLINTH[1]) / 2, PLINTH_HEIGHT - lowest, (PLINTH[2] + PLINTH[3]) / 2)
    rings = [[(tuple(u + v for u, v in zip(p, centre)), n) for p, n in ring] for ring in rings]
    for k in range(around):
        for j in range(across):
            a, b = rings[k][j], rings[k][(j + 1) % across]
            c, d = rings[(k + 1) % around][(j + 1) % across], rings[(k + 1) % around][j]
            for three in ((a, b, c), (a, c, d)):
                thing.triangle([p for p, _ in three], [n for _, n in three])
    scene.add(thing)


def lights(scene, materials):
    shade = Object("pendant shade", materials["shade"])
    shade.revolve((LAMP[0], LAMP[1], LAMP[2]),
                  [(0.30, 0.06, 0.3, 1.0), (0.22, 0.16, 0.75, 0.85), (0.10, 0.235, 0.6, 1.0),
                   (0.02, 0.268, 0.5, 1.0), (0.0, 0.27, 0.0, 1.0)], 28)
    scene.add(shade)
    cord = Object("pendant cord", materials["black"])
    cord.box((LAMP[0] - 0.006, LAMP[1] + 0.27, LAMP[2] - 0.006),
             (LAMP[0] + 0.006, Y, LAMP[2] + 0.006), skip=("-y", "+y"))
    scene.add(cord)
    fitting = Object("spot fitting", materials["black"])
    circle = [(SPOT[0] + 0.045 * math.cos(2 * math.pi * k / 12),
               SPOT[2] + 0.045 * math.sin(2 * math.pi * k / 12)) for k in range(12)]
    fitting.prism(circle, SPOT[1] + 0.02, Y, skip=("top",))
    scene.add(fitting)

    # A pendant of 7500 lm, warm; a 22 degree accent on the sculpture; a low winter sun behind thin
    # cloud (a clear one would be some 60 000 lx and hide everything else).
    scene.light("pendant", "point", 600.0, LAMP, color=(1.0, 0.92, 0.80))
    target = ((PLINTH[0] + PLINTH[1]) / 2, SCULPTURE_HEIGHT, (PLINTH[2] + PLINTH[3]) / 2)
    scene.light("picture light", "spot", 3200.0, SPOT,
                tuple(b - a for a, b in zip(SPOT, target)), color=(1.0, 0.96, 0.89),
                cone=(12.0, 22.0))
    scene.light("sun", "directional", 4500.0, (-2.0, 4.0, 5.5), SUN, color=(1.0, 0.96, 0.88))


def main(path):
    scene = Scene("vtkRadiometry examples/gallery/make_gallery.py")
    m = scene.material
    materials = {
        "ceiling": m("ceiling", (0.86, 0.86, 0.85)),
        "wall": m("wall", (0.76, 0.75, 0.72)),
        "sage": m("sage wall", (0.56, 0.63, 0.54)),
        "oak": m("oak floor", (0.42, 0.30, 0.19), roughness=0.5, specular=0.5),
        "gloss white": m("gloss white", (0.78, 0.78, 0.76), roughness=0.4, specular=0.5),
        "door": m("door", (0.66, 0.68, 0.66), roughness=0.5, specular=0.5),
        "brass": m("brass", (0.45, 0.34, 0.14), roughness=0.3, specular=1.0),
        "black": m("black", (0.05, 0.05, 0.05), roughness=0.5, specular=0.5),
        "walnut": m("walnut", (0.30, 0.19, 0.11), roughness=0.4, specular=0.5),
        "chair": m("chair", (0.12, 0.27, 0.36), roughness=0.5, specular=0.5),
        "plinth": m("plinth", (0.80, 0.80, 0.78)),
        "glaze red": m("glaze red", (0.58, 0.12, 0.07), roughness=0.35, specular=1.0),
        "glaze blue": m("glaze blue", (0.12, 0.28, 0.46), roughness=0.3, specular=1.0),
        "shade": m("shade", (0.80, 0.78, 0.72), double_sided=True),
        "canvas": m("canvas", (0.72, 0.70, 0.64)),
        "canvas red": m("canvas red", (0.55, 0.10, 0.07)),
        "canvas blue": m("canvas blue", (0.08, 0.16, 0.40)),
        "canvas ochre": m("canvas ochre", (0.62, 0.42, 0.10)),
        "canvas green": m("canvas green", (0.16, 0.36, 0.22)),
    }
    shell(scene, materials)
    skirting(scene, materials["gloss white"])
    door(scene, materials)
    window(scene, materials)
    pictures(scene, materials)
    furniture(scene, materials)
    sculpture(scene, materials["glaze red"])
    lights(scene, materials)
    scene.camera((5.55, 1.62, 4.62), (2.35, 1.12, 1.30), 50.0, 16.0 / 9.0)
    scene.write(path)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1
         else os.path.join(os.path.dirname(os.path.abspath(__file__)), "gallery.glb"))
