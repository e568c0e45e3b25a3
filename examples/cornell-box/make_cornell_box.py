#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes cornell-box.glb: the Cornell box as published, lit by its own area light.

Dimensions (millimetres), spectra of the walls and of the light: Cornell University Program of
Computer Graphics, "Cornell Box Data", https://www.graphics.cornell.edu/online/box/data.html
(measured values, entered again here as the facts they are).
"""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from gltf_builder import Object, Scene, triangulate  # noqa: E402

# Reflectance at 400, 404, ... 700 nm.
WHITE = """
    .343 .445 .551 .624 .665 .687 .708 .723 .715 .71 .745 .758 .739 .767 .777 .765 .751 .745
    .748 .729 .745 .757 .753 .75 .746 .747 .735 .732 .739 .734 .725 .721 .733 .725 .732 .743
    .744 .748 .728 .716 .733 .726 .713 .74 .754 .764 .752 .736 .734 .741 .74 .732 .745 .755
    .751 .744 .731 .733 .744 .731 .712 .708 .729 .73 .727 .707 .703 .729 .75 .76 .751 .739
    .724 .73 .74 .737"""
GREEN = """
    .092 .096 .098 .097 .098 .095 .095 .097 .095 .094 .097 .098 .096 .101 .103 .104 .107
    .109 .112 .115 .125 .14 .16 .187 .229 .285 .343 .39 .435 .464 .472 .476 .481 .462 .447
    .441 .426 .406 .373 .347 .337 .314 .285 .277 .266 .25 .23 .207 .186 .171 .16 .148 .141
    .136 .13 .126 .123 .121 .122 .119 .114 .115 .117 .117 .118 .12 .122 .128 .132 .139 .144
    .146 .15 .152 .157 .159"""
RED = """
    .04 .046 .048 .053 .049 .05 .053 .055 .057 .056 .059 .057 .061 .061 .06 .062 .062 .062
    .061 .062 .06 .059 .057 .058 .058 .058 .056 .055 .056 .059 .057 .055 .059 .059 .058 .059
    .061 .061 .063 .063 .067 .068 .072 .08 .09 .099 .124 .154 .192 .255 .287 .349 .402 .443
    .487 .513 .558 .584 .62 .606 .609 .651 .612 .61 .65 .638 .627 .62 .63 .628 .642 .639
    .657 .639 .635 .642"""
LIGHT = ((400, 0.0), (500, 8.0), (600, 15.6), (700, 18.4))  # relative, linear in between
LIGHT_REFLECTANCE = 0.78

# The data page gives the light's spectrum in relative units only; with this luminance the floor
# receives some 500 lx, as on an office desk.
LUMINANCE = 12000.0  # cd/m^2

WAVELENGTHS = range(400, 701, 4)
# IEC 61966-2-1: CIE XYZ to linear Rec.709.
TO_REC709 = ((3.2404542, -1.5371385, -0.4985314), (-0.9692660, 1.8760108, 0.0415560),
             (0.0556434, -0.2040259, 1.0572252))


def spectrum(text):
    values = [float(v) for v in text.split()]
    assert len(values) == len(WAVELENGTHS) == 76
    return values


def lobe(wavelength, centre, below, above):
    t = (wavelength - centre) * (below if wavelength < centre else above)
    return math.exp(-0.5 * t * t)


def observer(w):
    """CIE 1931 colour matching functions: Wyman, Sloan and Shirley, "Simple Analytic Approximations
    to the CIE XYZ Color Matching Functions", JCGT 2(2), 2013, the multi-lobe fit."""
    return (0.362 * lobe(w, 442.0, 0.0624, 0.0374) + 1.056 * lobe(w, 599.8, 0.0264, 0.0323)
            - 0.065 * lobe(w, 501.1, 0.0490, 0.0382),
            0.821 * lobe(w, 568.8, 0.0213, 0.0247) + 0.286 * lobe(w, 530.9, 0.0613, 0.0322),
            1.217 * lobe(w, 437.0, 0.0845, 0.0278) + 0.681 * lobe(w, 459.0, 0.0385, 0.0725))


def light_at(wavelength):
    for (w0, s0), (w1, s1) in zip(LIGHT, LIGHT[1:]):
        if wavelength <= w1:
            return s0 + (s1 - s0) * (wavelength - w0) / (w1 - w0)
    raise ValueError(wavelength)


def rec709(values):
    # fsum, because Python 3.12 changed how sum() rounds: the file is the same from any version.
    xyz = [math.fsum(observer(w)[i] * v for w, v in zip(WAVELENGTHS, values)) for i in range(3)]
    return [math.fsum(m * x for m, x in zip(row, xyz)) for row in TO_REC709]


def band_reflectance(text):
    """Reflectance in each band for the light of the box: band of (light times reflectance) over
    band of the light. Right for light that comes straight from the lamp."""
    light = [light_at(w) for w in WAVELENGTHS]
    lit = rec709([s * r for s, r in zip(light, spectrum(text))])
    return [a / b for a, b in zip(lit, rec709(light))]


FLOOR = [(552.8, 0.0), (0.0, 0.0), (0.0, 559.2), (549.6, 559.2)]  # x, z
CEILING = [(556.0, 0.0), (556.0, 559.2), (0.0, 559.2), (0.0, 0.0)]
LAMP = [(343.0, 227.0), (343.0, 332.0), (213.0, 332.0), (213.0, 227.0)]
HEIGHT = 548.8
SHORT = [(130.0, 65.0), (82.0, 225.0), (240.0, 272.0), (290.0, 114.0)]
TALL = [(423.0, 247.0), (265.0, 296.0), (314.0, 456.0), (472.0, 406.0)]


def metres(*values):
    return tuple(v / 1000.0 for v in values)


def level(thing, height, triangles, up):
    for triangle in triangles:
        corners = [metres(x, height, z) for x, z in triangle]
        # Counter-clockwise in (x, z) is clockwise seen from above.
        thing.polygon(corners[::-1] if up else corners)


def wall(thing, corners):
    """A wall in two triangles (the measured left wall is not quite flat)."""
    a, b, c, d = [metres(*p) for p in corners]
    thing.polygon([a, b, c])
    thing.polygon([a, c, d])


def main(path):
    scene = Scene("vtkRadiometry examples/cornell-box/make_cornell_box.py")
    white = scene.material("white", band_reflectance(WHITE))
    green = scene.material("green", band_reflectance(GREEN))
    red = scene.material("red", band_reflectance(RED))
    lamp_colour = rec709([light_at(w) for w in WAVELENGTHS])
    lamp = scene.material("light", [LIGHT_REFLECTANCE] * 3, emission=lamp_colour,
                          luminance=LUMINANCE)

    # The floor has no triangles under the blocks, and the ceiling none above the lamp, which fills
    # its hole: no surface lies on another.
    floor = Object("floor", white)
    level(floor, 0.0, triangulate(FLOOR, [SHORT, TALL]), up=True)
    ceiling = Object("ceiling", white)
    level(ceiling, HEIGHT, triangulate(CEILING, [LAMP]), up=False)
    light = Object("light", lamp)
    level(light, HEIGHT, triangulate(LAMP), up=False)
    back = Object("back wall", white)
    wall(back, [(549.6, 0, 559.2), (0, 0, 559.2), (0, HEIGHT, 559.2), (556.0, HEIGHT, 559.2)])
    right = Object("right wall", green)
    wall(right, [(0, 0, 559.2), (0, 0, 0), (0, HEIGHT, 0), (0, HEIGHT, 559.2)])
    left = Object("left wall", red)
    wall(left, [(552.8, 0, 0), (549.6, 0, 559.2), (556.0, HEIGHT, 559.2), (556.0, HEIGHT, 0)])
    short = Object("short block", white)
    short.prism([metres(*p) for p in SHORT], 0.0, 0.165, skip=("bottom",))
    tall = Object("tall block", white)
    tall.prism([metres(*p) for p in TALL], 0.0, 0.330, skip=("bottom",))
    for thing in (floor, ceiling, light, back, right, left, short, tall):
        scene.add(thing)
    # Focal length 35 mm, film 25 x 25 mm.
    scene.camera(metres(278, 273, -800), metres(278, 273, 0),
                 2 * math.degrees(math.atan(0.5 * 25 / 35)), 1.0)
    scene.write(path)
    for name, text in (("white", WHITE), ("green", GREEN), ("red", RED)):
        print(name, " ".join(f"{v:.4f}" for v in band_reflectance(text)))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1
         else os.path.join(os.path.dirname(os.path.abspath(__file__)), "cornell-box.glb"))
