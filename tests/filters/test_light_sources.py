# SPDX-License-Identifier: BSD-3-Clause
"""The light sources: every unit against its closed form, every bad property refused."""
import math

import numpy as np
from checks import array, close, fails, points, run_all
from vtkradiometry import vtkDirectionalLightSource, vtkPointLightSource, vtkSpotLightSource

K = 683.002
WATT_PER_STERADIAN, WATT, CANDELA, LUMEN = range(4)


def made(cls, **properties):
    source = cls()
    for name, value in properties.items():
        getattr(source, "Set" + name)(value)
    return source


def output(source):
    source.Update()
    assert source.GetOutput().GetNumberOfPoints() == 1
    assert source.GetOutput().GetNumberOfVerts() == 1
    return source.GetOutput()


def intensity(cls, **properties):
    return bands(output(made(cls, **properties)))


def bands(data):
    return array(data.GetPointData(), "Intensity").reshape(-1)


def flux_by_quadrature(cutoff, inner, exponent):
    """The definition, integrated numerically in the angle: independent of the closed forms."""
    x, w = np.polynomial.legendre.leggauss(80)
    inner_edge = inner if inner >= 0 else cutoff
    total = 0.0
    for low, high in ((0.0, inner_edge), (inner_edge, cutoff)):
        phi = np.radians(low + (high - low) * 0.5 * (x + 1))
        edge = np.ones_like(phi)
        if inner >= 0:
            outer_cos, inner_cos = np.cos(np.radians([cutoff, inner]))
            edge = np.clip((np.cos(phi) - outer_cos) / (inner_cos - outer_cos), 0, 1) ** 2
        value = np.cos(phi) ** exponent * edge * 2 * np.pi * np.sin(phi)
        total += np.sum(w * value) * 0.5 * math.radians(high - low)
    return total


def test_point_units():
    lm = intensity(vtkPointLightSource, Intensity=100, IntensityUnit=LUMEN)[0]
    close(K * lm / 1.0**2, 7.957747154594767)  # lx at 1 m: 100/(4 pi)
    close(intensity(vtkPointLightSource, Intensity=50, IntensityUnit=CANDELA), [50 / K])
    close(intensity(vtkPointLightSource, Intensity=8, IntensityUnit=WATT), [8 / (4 * math.pi)])
    close(intensity(vtkPointLightSource, Intensity=8), [8])
    close(intensity(vtkPointLightSource, Intensity=8, IntensityUnit=LUMEN, LuminousEfficacy=100),
          [8 / (4 * math.pi * 100)])


def test_lambertian_spot():
    lm = intensity(vtkSpotLightSource, Intensity=100, IntensityUnit=LUMEN, Cutoff=90, Exponent=1)[0]
    close(K * lm, 31.830988618379067)  # 100/pi


def test_spot_without_a_cone_is_a_point():
    close(intensity(vtkSpotLightSource, Intensity=100, IntensityUnit=LUMEN, Cutoff=180),
          intensity(vtkPointLightSource, Intensity=100, IntensityUnit=LUMEN))


def test_spot_flux():
    for cutoff in (0.5, 10, 21.9, 45, 89, 90):
        for inner in (-1, 0, 0.3 * cutoff, 0.9 * cutoff, cutoff - 1e-3):
            for exponent in (0, 1, 2.5, 40):
                axial = intensity(vtkSpotLightSource, Intensity=1, IntensityUnit=WATT,
                                  Cutoff=cutoff, InnerCutoff=inner, Exponent=exponent)[0]
                expected = flux_by_quadrature(cutoff, inner, exponent)
                # 80 points on the cosine's power: good to 1e-9 for these exponents.
                close(axial * expected, 1.0, relative=2e-9)


def test_narrow_edges_meet_the_hard_edge():
    """The closed form of the smooth edge must not cancel: its limits are the hard cones."""
    for cutoff, exponent in ((30, 0), (30, 7.5), (90, 1), (1e-3, 0)):
        hard = intensity(vtkSpotLightSource, IntensityUnit=WATT, Cutoff=cutoff, Exponent=exponent)
        for gap in (1e-3, 1e-5, 1e-8):
            inner = cutoff * (1 - gap)
            smooth = intensity(vtkSpotLightSource, IntensityUnit=WATT, Cutoff=cutoff,
                               InnerCutoff=inner, Exponent=exponent)
            assert smooth[0] > hard[0], "part of the cone is dimmed, so the axis is brighter"
            close(smooth, hard, relative=10 * gap + 1e-12)


def test_directional():
    data = output(made(vtkDirectionalLightSource, Intensity=50000, IntensityUnit=1,
                       Direction=(0, -3, -4)))
    close(bands(data), [50000 / K])
    close(array(data.GetPointData(), "Direction")[0], [0, -0.6, -0.8], absolute=1e-16)
    assert array(data.GetPointData(), "LightType")[0] == 2
    assert array(data.GetFieldData(), "Photometric")[0] == 1
    close(intensity(vtkDirectionalLightSource, Intensity=7), [7])


def test_arrays():
    data = output(made(vtkSpotLightSource, Position=(1, 2, 3), Target=(1, 2, -5), UseTarget=True,
                       Cutoff=40, InnerCutoff=30, Exponent=2, Attenuation=(1, 0.5, 0.25),
                       LightEnabled=False, AttachedTo=2, LightName="lamp", Color=(1, 0.5, 0)))
    close(points(data), [[1, 2, 3]])
    arrays = data.GetPointData()
    close(array(arrays, "Direction"), [[0, 0, -1]])
    for name, value in (("LightType", 1), ("SpotCutoff", 40), ("SpotInnerCutoff", 30),
                        ("SpotExponent", 2), ("LightEnabled", 0), ("PhotometricWeb", -1),
                        ("AttachedTo", 2)):
        assert array(arrays, name).tolist() == [value], name
    close(array(arrays, "Attenuation"), [[1, 0.5, 0.25]])
    close(array(arrays, "Intensity"), [[1, 0.5, 0]])
    close(array(arrays, "SpecularColor"), [[1, 0.5, 0]])
    close(array(arrays, "AmbientColor"), [[0, 0, 0]])
    assert array(data.GetFieldData(), "LightNames") == ["lamp"]
    assert array(data.GetFieldData(), "Photometric")[0] == 0


def test_bands():
    close(intensity(vtkPointLightSource, Color=(0.5, 0.5, 0.5)), [0.5])
    close(intensity(vtkPointLightSource, Bands=3), [1, 1, 1])
    close(intensity(vtkPointLightSource, Bands=1, Color=(1, 0, 0)), [0.2126])
    close(intensity(vtkPointLightSource, Bands=5, Intensity=2), [2] * 5)
    spectral = vtkPointLightSource()
    spectral.SetBandFactor(2, 0.25)
    close(bands(output(spectral)), [1, 1, 0.25])


def test_bad_properties():
    nan, infinite = float("nan"), float("inf")
    cases = [
        (vtkPointLightSource, dict(Intensity=-1), ("Intensity", "-1")),
        (vtkPointLightSource, dict(Intensity=nan), ("Intensity", "nan")),
        (vtkPointLightSource, dict(Intensity=infinite), ("Intensity", "inf")),
        (vtkPointLightSource, dict(IntensityUnit=4), ("IntensityUnit", "4")),
        (vtkPointLightSource, dict(Position=(0, nan, 0)), ("Position", "nan")),
        (vtkPointLightSource, dict(Color=(1, -0.5, 1)), ("Color[1]", "-0.5")),
        (vtkPointLightSource, dict(Attenuation=(0, 0, 0)), ("Attenuation",)),
        (vtkPointLightSource, dict(Attenuation=(0, -1, 1)), ("Attenuation", "-1")),
        (vtkPointLightSource, dict(LuminousEfficacy=0), ("LuminousEfficacy", "0")),
        (vtkPointLightSource, dict(AttachedTo=3), ("AttachedTo", "3")),
        (vtkPointLightSource, dict(Bands=-2), ("Bands", "-2")),
        (vtkSpotLightSource, dict(Direction=(0, 0, 0)), ("Direction", "(0, 0, 0)")),
        (vtkSpotLightSource, dict(Direction=(nan, 0, 0)), ("Direction", "nan")),
        (vtkSpotLightSource, dict(Target=(0, 0, 0), UseTarget=True), ("Target",)),
        (vtkSpotLightSource, dict(Cutoff=0), ("SpotCutoff", "0")),
        (vtkSpotLightSource, dict(Cutoff=90.5), ("SpotCutoff", "90.5")),
        (vtkSpotLightSource, dict(Cutoff=nan), ("SpotCutoff", "nan")),
        (vtkSpotLightSource, dict(Cutoff=30, InnerCutoff=30), ("SpotInnerCutoff", "30")),
        (vtkSpotLightSource, dict(Exponent=-1), ("SpotExponent", "-1")),
        (vtkSpotLightSource, dict(Cutoff=180, Exponent=1), ("SpotExponent", "1")),
        (vtkDirectionalLightSource, dict(Direction=(0, 0, 0)), ("Direction",)),
        (vtkDirectionalLightSource, dict(IntensityUnit=2), ("IntensityUnit", "2")),
    ]
    for cls, properties, words in cases:
        fails(made(cls, **properties), *words)


def test_recovers_after_an_error():
    source = made(vtkPointLightSource, Intensity=-1)
    fails(source, "Intensity")
    source.SetIntensity(2)
    close(bands(output(source)), [2])


if __name__ == "__main__":
    run_all(globals())
