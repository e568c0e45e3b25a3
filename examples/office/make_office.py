#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes office.glb, a small office of 5.4 x 4.2 x 2.8 m with a window and no lights of its own, and
office.ies, the distribution of its two luminaires.

The luminaire is made up: a bat-wing by a formula, no product.
"""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from gltf_builder import Object, Scene, breaks  # noqa: E402

X, Y, Z = 5.4, 2.8, 4.2            # the room: x 0..5.4, z 0..4.2, floor at 0
WINDOW = (0.9, 2.4, 0.6, 3.6)      # in the wall x = 0: y from, to, z from, to
REVEAL = 0.25
LUMINAIRES = ((1.5, 2.1), (3.9, 2.1))  # x, z of their middles
LUMINAIRE_SIZE = (1.2, 0.06, 0.2)
LUMINAIRE_BOTTOM = 2.35
DESK = (0.9, 2.5, 1.0, 1.8)        # x, x, z, z
DESK_HEIGHT, DESK_THICK, LEG = 0.74, 0.03, 0.04
CABINET = (4.85, 5.3, 1.2, 3.0)
CABINET_HEIGHT = 1.2

FLUX = 6400.0                      # lm of one luminaire


def shell(scene, materials):
    legs = desk_legs()
    x_marks = [v for leg in (*legs, CABINET) for v in leg[:2]]
    z_marks = [v for leg in (*legs, CABINET, (0, 0, *WINDOW[2:])) for v in leg[2:]]
    along_x, along_z = breaks(0.0, X, x_marks), breaks(0.0, Z, z_marks)
    along_y = breaks(0.0, Y, WINDOW[:2])
    floor = Object("floor", materials["floor"])
    floor.grid(1, 0.0, along_x, along_z, 1, holes=[*legs, CABINET])
    ceiling = Object("ceiling", materials["ceiling"])
    ceiling.grid(1, Y, along_x, along_z, -1)
    north = Object("north wall", materials["wall"])
    north.grid(2, 0.0, along_x, along_y, 1)
    south = Object("south wall", materials["wall"])
    south.grid(2, Z, along_x, along_y, -1)
    east = Object("east wall", materials["wall"])
    east.grid(0, X, along_y, along_z, -1)
    west = Object("west wall", materials["wall"])
    west.grid(0, 0.0, along_y, along_z, 1, holes=[WINDOW])
    reveal = Object("window reveal", materials["wall"])
    low, high, near, far = WINDOW
    depth = (-REVEAL, 0.0)
    reveal.grid(1, low, depth, breaks(near, far, along_z), 1)
    reveal.grid(1, high, depth, breaks(near, far, along_z), -1)
    reveal.grid(2, near, depth, (low, high), 1)
    reveal.grid(2, far, depth, (low, high), -1)
    for thing in (floor, ceiling, north, south, east, west, reveal):
        scene.add(thing)


def desk_legs():
    """The two panels that the desk stands on: x, x, z, z."""
    x0, x1, z0, z1 = DESK
    return ((x0 + 0.05, x0 + 0.05 + LEG, z0 + 0.05, z1 - 0.05),
            (x1 - 0.05 - LEG, x1 - 0.05, z0 + 0.05, z1 - 0.05))


def furniture(scene, materials):
    desk = Object("desk", materials["beech"])
    x0, x1, z0, z1 = DESK
    under = DESK_HEIGHT - DESK_THICK
    legs = desk_legs()
    desk.grid(1, DESK_HEIGHT, (x0, x1), (z0, z1), 1)
    desk.grid(1, under, breaks(x0, x1, [v for leg in legs for v in leg[:2]]),
              breaks(z0, z1, legs[0][2:]), -1, holes=legs)
    for axis, sign, at, u, v in ((0, -1, x0, (under, DESK_HEIGHT), (z0, z1)),
                                 (0, 1, x1, (under, DESK_HEIGHT), (z0, z1)),
                                 (2, -1, z0, (x0, x1), (under, DESK_HEIGHT)),
                                 (2, 1, z1, (x0, x1), (under, DESK_HEIGHT))):
        desk.grid(axis, at, u, v, sign)
    for leg in legs:
        desk.box((leg[0], 0.0, leg[2]), (leg[1], under, leg[3]), skip=("-y", "+y"))
    scene.add(desk)
    cabinet = Object("cabinet", materials["grey"])
    cabinet.box((CABINET[0], 0.0, CABINET[2]), (CABINET[1], CABINET_HEIGHT, CABINET[3]),
                skip=("-y",))
    scene.add(cabinet)
    for k, (x, z) in enumerate(LUMINAIRES, 1):
        body = Object(f"luminaire {k}", materials["white"])
        a, b, c = (0.5 * s for s in LUMINAIRE_SIZE)
        body.box((x - a, LUMINAIRE_BOTTOM, z - c), (x + a, LUMINAIRE_BOTTOM + 2 * b, z + c))
        scene.add(body)


def intensity(plane, gamma):
    """The bat-wing, relative: cos(gamma) (1 + w sin^2 gamma), wider across the luminaire (C = 90)
    than along it (C = 0), and nothing above the horizontal."""
    wing = 0.6 + 3.0 * math.sin(math.radians(plane))**2
    g = math.radians(gamma)
    return max(math.cos(g), 0.0) * (1.0 + wing * math.sin(g)**2)


def write_ies(path):
    """LM-63-2002, absolute, type C, one quadrant; scaled to FLUX by the formula's own integral."""
    # int cos g (1 + w sin^2 g) sin g dg = 1/2 + w/4 from 0 to 90 degrees; the mean of w is 2.1.
    scale = FLUX / (2.0 * math.pi * (0.5 + 2.1 / 4.0))
    verticals = [2.5 * k for k in range(37)]
    horizontals = [5.0 * k for k in range(19)]

    def numbers(values, form):
        texts = [format(v, form) for v in values]
        return [" ".join(texts[k:k + 10]) for k in range(0, len(texts), 10)]

    lines = ["IESNA:LM-63-2002",
             "[TEST] made up by a formula: examples/office/make_office.py",
             "[TESTLAB] none", "[ISSUEDATE] 2026", "[MANUFAC] vtkRadiometry examples",
             "[LUMCAT] office bat-wing", "[LUMINAIRE] suspended luminaire, direct", "TILT=NONE",
             f"1 -1 1 {len(verticals)} {len(horizontals)} 1 2 {LUMINAIRE_SIZE[2]:g} "
             f"{LUMINAIRE_SIZE[0]:g} 0",
             "1 1 32"]
    lines += numbers(verticals, "g") + numbers(horizontals, "g")
    for plane in horizontals:
        lines += numbers([scale * intensity(plane, gamma) for gamma in verticals], ".2f")
    with open(path, "w", encoding="ascii", newline="\r\n") as file:
        file.write("\n".join(lines) + "\n")


def main(path):
    scene = Scene("vtkRadiometry examples/office/make_office.py")
    m = scene.material
    materials = {
        "ceiling": m("ceiling", (0.80, 0.80, 0.80)),
        "wall": m("wall", (0.60, 0.60, 0.58)),
        "floor": m("carpet", (0.22, 0.23, 0.25)),
        "beech": m("beech", (0.55, 0.42, 0.28)),
        "grey": m("grey", (0.45, 0.46, 0.47)),
        "white": m("white", (0.80, 0.80, 0.80)),
    }
    shell(scene, materials)
    furniture(scene, materials)
    scene.camera((5.15, 1.65, 3.95), (1.3, 0.95, 1.2), 58.0, 16.0 / 9.0)
    scene.write(path)
    write_ies(os.path.splitext(path)[0] + ".ies")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1
         else os.path.join(os.path.dirname(os.path.abspath(__file__)), "office.glb"))
