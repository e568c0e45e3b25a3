#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The options of `python -m vtkradiometry` (and so of ./run SCENE).

Imports nothing but the standard library, so that ./run --help works before anything is built.
"""
import argparse
import math
import re

FINEST = 1e-5  # relative tolerance that no time budget of a study waits for
FIRST_LOOK = 15.0  # seconds for each computation where nobody says how accurate


def _positive(text):
    value = float(text)
    if not (value > 0.0 and math.isfinite(value)):
        raise argparse.ArgumentTypeError(f"{text} is not a positive number")
    return value


def _not_negative(text):
    value = float(text)
    if not (value >= 0.0 and math.isfinite(value)):
        raise argparse.ArgumentTypeError(f"{text} is not a number from 0 up")
    return value


def _count(text):
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"{text} is not a count")
    return value


def _size(text):
    width, separator, height = text.lower().partition("x")
    if not (separator and width.isdigit() and height.isdigit()):
        raise argparse.ArgumentTypeError(f"{text} is not WIDTHxHEIGHT")
    size = int(width), int(height)
    if not all(64 <= side <= 4096 for side in size):
        raise argparse.ArgumentTypeError(f"{text}: each side must lie between 64 and 4096")
    return size


def _edge(text):
    return text if text == "auto" else _not_negative(text)


def _vector(text):
    parts = text.split(",")
    try:
        values = tuple(float(part) for part in parts)
    except ValueError:
        values = ()
    if len(values) != 3 or not all(math.isfinite(v) for v in values):
        raise argparse.ArgumentTypeError(f"{text} is not X,Y,Z")
    return values


def _sun(text):
    try:
        altitude, azimuth = (float(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is not ALTITUDE,AZIMUTH") from None
    if not (0.0 < altitude <= 90.0 and -360.0 <= azimuth <= 360.0):
        raise argparse.ArgumentTypeError(
            f"{text}: the altitude must lie in (0, 90] degrees, the azimuth in [-360, 360]")
    return altitude, azimuth


def _share(text):
    value = float(text)
    if not 0.0 <= value <= 1.0:
        raise argparse.ArgumentTypeError(f"{text} does not lie in [0, 1]")
    return value


def _height(text):
    try:
        value = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"{text} is not a height in metres (a scene that follows needs --work-plane=0.8 or "
            "must come first)") from None
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text} is not a height in metres")
    return value


def _levels(text):
    """A list of tolerances, or of seconds with an s behind each."""
    words = [word.strip() for word in text.split(",")]
    budgets = all(word.endswith("s") for word in words)
    try:
        values = [float(word[:-1] if budgets else word) for word in words]
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"{text} is neither tolerances (0.1,0.01) nor seconds (1s,5s) (a scene that follows "
            "needs --study=0.1,0.01 or must come first)") from None
    least, most = (0.0, math.inf) if budgets else (0.0, 1.0)
    if not all(least < value <= most and math.isfinite(value) for value in values):
        raise argparse.ArgumentTypeError(
            f"{text}: " + ("seconds above 0" if budgets else "tolerances in (0, 1]") + " are wanted")
    return ("budgets" if budgets else "tolerances"), values


class _Luminaire(argparse.Action):
    """--luminaire FILE begins a luminaire; --at and --toward say where the one before them hangs
    and what it looks at. More than one --at: as many copies."""

    def __call__(self, parser, namespace, value, option=None):
        found = list(getattr(namespace, "luminaires", None) or [])
        namespace.luminaires = found
        if option == "--luminaire":
            found.append({"file": value, "at": [], "toward": []})
            return
        if not found:
            parser.error(f"argument {option}: must follow --luminaire FILE")
        if option == "--at":
            found[-1]["at"].append(value)
            found[-1]["toward"].append(None)
            return
        if not found[-1]["at"]:
            parser.error("argument --toward: must follow --at X,Y,Z")
        found[-1]["toward"][-1] = value


def parse(arguments, program="./run"):
    """The options as given, with the accuracy that the two of it leave open filled in: who names no
    tolerance wants a first look soon; who names one gets it, however long it takes."""
    options = make_parser(program).parse_args(arguments)
    if options.time_budget is None:
        options.time_budget = FIRST_LOOK if options.tolerance is None else 0.0
    options.study_tolerance = FINEST if options.tolerance is None else options.tolerance
    if options.tolerance is None:
        options.tolerance = 0.05
    return options


def make_parser(program="./run"):
    """The command line as an argparse parser."""
    parser = argparse.ArgumentParser(
        prog=program,
        usage=f"{program} [SCENE] [options]",
        description="Computes how much light falls on each part of a scene and how sure that is, "
        "and writes the result, its picture and a report.",
        epilog="Exit status: 0 all is well; 2 something is wrong with the input, and nothing was "
        "written; 130 stopped by Ctrl-C, and nothing was written; 1 anything else.",
    )
    # So that --at -1,2,3 is a place and not an option.
    parser._negative_number_matcher = re.compile(r"^-[\d.][\d.,eE+-]*$")
    parser.add_argument("scene", nargs="?", metavar="SCENE",
                        help="a .gltf or .glb file (default: the bundled gallery)")
    parser.add_argument("--output", "-o", metavar="DIR", default="out",
                        help="folder for the results, made if need be (default: out)")
    parser.add_argument("--quiet", "-q", action="store_true", help="no progress on the terminal")
    parser.add_argument("--version", action="store_true", help="print the versions and stop")

    accuracy = parser.add_argument_group("how accurate, how long")
    accuracy.add_argument("--tolerance", type=_positive, default=None, metavar="X",
                          help="relative error to reach, 0.01 is one per cent (default: 0.05)")
    accuracy.add_argument("--time-budget", type=_not_negative, default=None, metavar="SECONDS",
                          help="stop each computation after this time and say how far it got; 0 is "
                          f"no limit (default: {FIRST_LOOK:g}, but no limit where --tolerance is "
                          "given)")
    accuracy.add_argument("--max-edge", type=_edge, default="auto", metavar="METRES",
                          help="split triangles until no edge is longer; 0 keeps the mesh as it is "
                          "(default: auto, about 2500 triangles)")
    accuracy.add_argument("--threads", type=_count, default=0, metavar="N",
                          help="processor threads (default: 0, all)")

    accuracy.add_argument("--study", type=_levels, nargs="?", const=("tolerances", []),
                          metavar="LIST",
                          help="what accuracy costs: run the last computation again at these "
                          "tolerances (0.1,0.02,0.01) or for these times (1s,5s,20s), as a table and a "
                          "plot (default: 0.1,0.05,0.02,0.01,0.005). The time budget ends each run at "
                          "tolerances, a --tolerance each run for a time")
    accuracy.add_argument("--study-reference", metavar="FILE",
                          help="a scene.vtp of an earlier run of the same scene and mesh, taken as true "
                          "within its errors (default: the run of the study with the least error)")
    accuracy.add_argument("--study-float", action="store_true",
                          help="also run the finest one with input in single precision")

    physics = parser.add_argument_group("what is computed")
    physics.add_argument("--radiosity", action=argparse.BooleanOptionalAction, default=True,
                         help="light reflected between surfaces too, not only light that comes "
                         "straight from lamps, emitting surfaces and sky")
    physics.add_argument("--method", default="auto",
                         choices=["auto", "dense", "hierarchical", "montecarlo"],
                         help="how interreflection is solved (default: auto)")
    physics.add_argument("--two-sided", action=argparse.BooleanOptionalAction, default=None,
                         help="whether surfaces receive and reflect light on their backs "
                         "(default: as the scene's materials say)")
    physics.add_argument("--samples", choices=["cells", "points"], default="cells",
                         help="one value for each cell (its average) or each point")
    physics.add_argument("--light-units", choices=["auto", "photometric", "radiometric"],
                         default="auto",
                         help="what the light intensities in the file are: photometric (cd and lx, "
                         "as glTF says) or radiometric (W/sr and W/m2) (default: auto, photometric)")
    physics.add_argument("--emissive-units", choices=["auto", "luminance", "radiance", "exitance"],
                         default="auto",
                         help="what the emissive colours in the file are: luminance (cd/m2, as "
                         "glTF says), radiance (W/(m2 sr), what Blender leaves) or exitance (W/m2) "
                         "(default: auto, radiance if Blender wrote the file, else luminance)")
    physics.add_argument("--specular-as-diffuse", action=argparse.BooleanOptionalAction,
                         default=True,
                         help="count what glossy materials reflect as diffuse: right energy, no "
                         "highlights (default: yes)")

    physics.add_argument("--dose", type=_not_negative, default=0.0, metavar="SECONDS",
                         help="exposure time: also write the dose, irradiance times this time, in "
                         "J/m2 (default: 0, none)")

    added = parser.add_argument_group(
        "lights beside the scene's own", "Coordinates are the scene's, in metres; in a glTF scene Y "
        "is up and -Z is north.")
    added.add_argument("--luminaire", action=_Luminaire, dest="luminaires", metavar="FILE",
                       help="a luminaire with the intensity distribution of an .ies or .ldt file; "
                       "again for further ones")
    added.add_argument("--at", action=_Luminaire, dest="luminaires", type=_vector,
                       metavar="X,Y,Z", help="where it hangs; again for further copies of it")
    added.add_argument("--toward", action=_Luminaire, dest="luminaires", type=_vector,
                       metavar="X,Y,Z", help="a point that the copy before looks at (default: down)")

    added.add_argument("--sky", choices=["uniform", "overcast", "clear", "intermediate"],
                       help="light from all around by the CIE's standard skies (uniform: from below "
                       "the horizon too); clear and intermediate ones need --sun")
    added.add_argument("--sky-map", metavar="FILE",
                       help="light from a lat-long OpenEXR picture in W/(m2 sr), north in its middle")
    added.add_argument("--sky-illuminance", type=_positive, default=10000.0, metavar="LUX",
                       help="what the sky alone gives on open level ground (default: 10000)")
    added.add_argument("--ground-reflectance", type=_share, default=0.2, metavar="X",
                       help="of the ground below a CIE sky's horizon (default: 0.2)")
    added.add_argument("--sun", type=_sun, metavar="ALTITUDE,AZIMUTH",
                       help="where the sun is, degrees above the horizon and from north over east; "
                       "it shines, except under a uniform or overcast sky")
    added.add_argument("--sun-illuminance", type=_not_negative, default=None, metavar="LUX",
                       help="of the sun on a surface that faces it (default: 80000, 20000 under an "
                       "intermediate sky, 0 under a uniform or overcast one)")

    plane = parser.add_argument_group("measuring grid")
    plane.add_argument("--work-plane", type=_height, nargs="?", const=0.8, metavar="HEIGHT",
                       help="measure on a level grid this high above the lowest point, spaced as EN "
                       "12464-1 says: mean, U0 and Ud, a picture with iso-lux lines, a table "
                       "(0.8 m if no number follows)")
    plane.add_argument("--wall-zone", type=_not_negative, default=0.5, metavar="METRES",
                       help="zone along the walls that is left out (default: 0.5)")
    plane.add_argument("--grid-spacing", type=_positive, metavar="METRES",
                       help="greatest distance of measuring points (default: as EN 12464-1 says)")

    picture = parser.add_argument_group("pictures")
    picture.add_argument("--size", type=_size, default=(1280, 720), metavar="WxH",
                         help="pixels of the pictures (default: 1280x720)")
    picture.add_argument("--exposure", type=float, default=None, metavar="STOPS",
                         help="scale the picture by 2 to this power (default: from the scene's "
                         "brightness)")
    picture.add_argument("--display", metavar="NAME", default=None,
                         help="OpenColorIO display: sRGB, Rec.1886, Display P3, or one of your $OCIO "
                         "config (default: the config's first)")
    picture.add_argument("--view", metavar="NAME", default=None,
                         help="view of that display: Plain, ACES, Raw, or one of your config "
                         "(default: the display's first)")
    picture.add_argument("--quantity", choices=["auto", "irradiance", "illuminance"],
                         default="auto", help="what falsecolor.png shows: irradiance in W/m2 or "
                         "illuminance in lx (default: auto, illuminance for a coloured scene)")
    picture.add_argument("--range", type=float, nargs=2, metavar=("LOW", "HIGH"), default=None,
                         help="ends of the false-colour legend (default: from the values)")
    picture.add_argument("--scale", choices=["auto", "linear", "log"], default="auto",
                         help="false-colour scale (default: auto, log when values span a lot)")
    return parser


if __name__ == "__main__":
    make_parser().print_help()
