# SPDX-License-Identifier: BSD-3-Clause
"""What lights may and may not say: intensities from 0 to 1e30, what is no number, directions of no
length, cones at and beyond their range, switched off lights, 0 to many lights, 1 to 64 bands. A right
answer, or an error that names the array, the light and the value."""
from math import inf, nan

import numpy as np
from hardcases import (KINDS, POINTS, SAMPLED, Light, Run, close, fails, light_data, point, polydata, room,
                       run_all, sensors, spot, sun)
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkradiometry import vtkIrradianceFilter

PLACES = np.array([(x, y, 0.85) for x in (-1.2, 0.1, 1.4) for y in (-1.1, 0.3, 1.6)])


def surface():
    return polydata(*room())


def ways():
    """Cells, points of the surface, sensors."""
    rough = dict(RelativeTolerance=0.1)
    yield lambda *lights: Run(surface(), list(lights), **rough)
    yield lambda *lights: Run(surface(), list(lights), SampleLocation=POINTS, **rough)
    yield lambda *lights: Run(sensors(PLACES, (0, 0, 1)), list(lights), surface(), **rough)


def refused(lights, *words):
    f = vtkIrradianceFilter()
    f.SetInputData(surface())
    f.AddLightsData(lights if isinstance(lights, vtkPolyData) else light_data(lights))
    return fails(f, *words)


def test_intensity_scales_the_answer_and_nothing_else():
    for name, make in KINDS.items():
        for way in ways():
            one = way(make())
            for factor in (1e30, 1e-30, 1e100, 3.0):
                run = way(make().times(factor))
                # Scaled numbers round otherwise: 1e-9 where shadows are fitted.
                close(run.e, factor * one.e, 1e-9 if name in SAMPLED else 1e-12)
                close(run.error, factor * one.error, 1e-6, 1e-12 * factor * one.e.max())


def test_intensity_zero_gives_exactly_zero():
    for make in KINDS.values():
        for way in ways():
            run = way(make().times(0.0))
            assert (run.e == 0).all() and (run.error == 0).all()
            other = way(sun((0, 0, -1), 2.0))
            both = way(make().times(0.0), sun((0, 0, -1), 2.0))
            assert both.e.tobytes() == other.e.tobytes()


def test_denormal_intensity():
    for make in KINDS.values():
        for way in ways():
            one = way(make())
            light = make()
            light.intensity = light.intensity * 0 + 5e-324
            scale = one.e / make().intensity[0]
            run = way(light)
            # To the step of the least numbers, a few for each triangle that is averaged.
            assert (np.abs(run.e - 5e-324 * scale) <= 5e-323).all(), run.e.max()


def test_intensity_that_overflows_is_no_silent_infinity():
    """1e308 W/sr, 1e-9 m over a sensor: more than a double holds. An error, not an inf."""
    f = vtkIrradianceFilter()
    f.SetInputData(sensors([(0, 0, 0)], (0, 0, 1)))
    f.AddLightsData(light_data(point((0, 0, 1e-9), 1e308)))
    fails(f, "Irradiance")


def test_intensity_that_is_negative_or_no_number_is_refused():
    for make in KINDS.values():
        for value in (-1.0, -1e-300, nan, inf, -inf):
            light = make()
            light.intensity = np.array([value])
            refused(light, f"Intensity[0] = {value:g}")
            light.intensity = np.array([1.0, value, 1.0])  # in one band of three
            refused(light, f"Intensity[0] = {value:g}")


def test_the_light_at_fault_is_named():
    good = [make() for make in KINDS.values()]
    bad = point((0, 0, 2), nan)
    refused(light_data(*good, bad), f"Intensity[{sum(len(x.position) for x in good)}] = nan")


def test_positions_and_directions_that_are_no_numbers_are_refused():
    for value in (nan, inf, -inf):
        for light in (point((0, value, 2)), spot((0, 0, value), (0, 0, -1))):
            refused(light, "Position[0]", f"{value:g}")
        for light in (sun((0, value, -1)), spot((0, 0, 2), (value, 0, -1))):
            refused(light, "Direction[0]", f"{value:g}")


def test_directions_of_no_length_are_refused_where_they_mean_something():
    refused(sun((0, 0, 0)), "Direction[0]", "(0, 0, 0)")
    refused(spot((0, 0, 2), (0, 0, 0)), "Direction[0]", "(0, 0, 0)")
    # A point light has no direction: whatever the array says.
    close(Run(surface(), point((0, 0, 2), 1.0, Direction=(0, 0, 0))).e,
          Run(surface(), point((0, 0, 2), 1.0)).e)


def test_directions_of_any_length_mean_the_same():
    for make in (KINDS["sun"], KINDS["spot"], KINDS["smooth spot"]):
        reference = Run(surface(), make()).e
        for length in (1e-200, 1e-30, 1e30, 1e200):
            light = make()
            light.arrays["Direction"] = length * light.arrays["Direction"]
            # Unit vectors differ in their last bit: by 1e-16 where a cone's edge runs over a cell.
            close(Run(surface(), light).e, reference, 1e-12, 1e-12)


def test_cutoffs_at_and_beyond_their_range():
    def lit(cutoff, **arrays):
        return spot((0.31, 0.22, 1.71), (0, 0, -1), cutoff, **arrays)

    for bad in (0.0, -5.0, 90.0001, 179.9999, 180.0001, 360.0, nan, inf, -inf):
        refused(lit(bad), "SpotCutoff[0]", f"{bad:g}"[:6])
    # 180 is no cone; 90 is the half space: the same to all that lies below the light.
    everywhere = Run(surface(), point((0.31, 0.22, 1.71)))
    for good in (90.0, 180.0):
        close(Run(surface(), lit(good)).e, everywhere.e, 1e-12)
    nearly = Run(surface(), lit(89.9999))
    close(nearly.e, everywhere.e, 1e-12)  # nothing of the room is within 1e-4 degrees of level
    # A cone of next to nothing lights next to nothing, and more than nothing.
    least = Run(surface(), lit(1e-7)).e
    assert 0 < least.sum() < 1e-12
    refused(lit(30.0, SpotInnerCutoff=30.0), "SpotInnerCutoff[0]", "30")
    refused(lit(30.0, SpotInnerCutoff=nan), "SpotInnerCutoff[0]", "nan")
    refused(lit(180.0, SpotInnerCutoff=20.0), "SpotInnerCutoff[0]", "20")


def test_exponents():
    for bad in (-1.0, nan, inf):
        refused(spot((0, 0, 2), (0, 0, -1), 45.0, bad), "SpotExponent[0]", f"{bad:g}")
    for exponent in (0.5, 1e3, 1e6):  # the whole beam lands on the floor
        floor = polydata([(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)], [(0, 1, 2, 3)])
        e = Run(floor, spot((0.3, 0.2, 2.0), (0, 0, -1), 70.0, exponent)).e[0, 0]
        c = np.cos(np.radians(70.0))
        close(e * 18 * 18, 2 * np.pi * -np.expm1((exponent + 1) * np.log(c)) / (exponent + 1), 1e-9)


def test_attenuations():
    for bad in ((0, 0, 0), (-1, 0, 1), (0, nan, 1), (inf, 0, 0)):
        refused(point((0, 0, 2), 1.0, Attenuation=bad), "Attenuation[0]")
    # a r^2-like fall-off by other coefficients is the same light.
    twice = Run(surface(), point((0.31, 0.22, 1.71), 1.0, Attenuation=(0, 0, 2.0)))
    once = Run(surface(), point((0.31, 0.22, 1.71), 0.5))
    assert (np.abs(twice.e - once.e) <= twice.error + 1e-9 * once.e).all()


def test_types_that_are_none_are_refused():
    for bad in (5, -1, 17):
        refused(Light(bad, (0, 0, 2)), f"LightType[0] = {bad}")
    light = light_data(point((0, 0, 2)))
    light.GetPointData().RemoveArray("Intensity")
    refused(light, "Intensity")


def test_no_lights_and_disabled_lights():
    for way in ways():
        for lights in ([light_data()], [vtkPolyData()], []):
            run = Run(surface(), lights)
            assert (run.e == 0).all() and (run.error == 0).all()
        for make in KINDS.values():
            off = make()
            off.arrays["LightEnabled"] = 0
            run = way(off)
            assert (run.e == 0).all() and (run.error == 0).all()
            both = way(off, make())
            assert both.bytes() == way(make()).bytes()


def test_bands_from_1_to_64_do_not_touch_each_other():
    for name, make in KINDS.items():
        for way in ways():
            one = way(make())
            for bands in (1, 2, 3, 7, 64):
                factors = np.linspace(0.0, 2.0, bands) if bands > 1 else np.ones(1)
                light = make()
                light.intensity = light.intensity[0] * factors
                run = way(light)
                assert run.e.shape[1] == bands
                close(run.e, one.e * factors, 1e-9 if name in SAMPLED else 1e-12)


def test_lights_of_one_band_beside_lights_of_many():
    many = light_data(sun((0, 0, -1), np.arange(1.0, 65.0)))
    one = light_data(KINDS["point"]())
    both = Run(surface(), [many, one])
    close(both.e, Run(surface(), [many]).e + Run(surface(), [one]).e, 1e-12)
    f = vtkIrradianceFilter()
    f.SetInputData(surface())
    f.AddLightsData(many)
    f.AddLightsData(light_data(sun((0, 0, -1), np.ones(3))))
    fails(f, "Intensity", "3")


def test_superposition_of_all_kinds():
    lights = [make() for make in KINDS.values()]
    for way in ways():
        runs = [way(x) for x in lights]
        together = way(*lights)
        difference = np.abs(together.e - sum(r.e for r in runs))
        assert (difference <= together.error + sum(r.error for r in runs) + 1e-12 * together.e).all()


run_all(globals())
