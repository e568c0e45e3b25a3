# SPDX-License-Identifier: BSD-3-Clause
"""The effect plan of a picture: what it says is there, what its switches do, hard cases, the budget that
effects and shading share."""
import math

import numpy as np

from drawing import Errors, Window, add, lights, polydata, run, square
from effects import AUTO, OFF, ON, POINT, ROWS, SPOT, SUN, differs, plan_of
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkProperty


def stage(*records, surface=None, size=20, **settings):
    w = Window(size)
    w.mapper.SetInputDataObject(surface or square())
    w.mapper.SetLightData(lights(*records))
    for name, value in settings.items():
        where = w.mapper if hasattr(w.mapper, "Set" + name) else w.actor.GetProperty()
        getattr(where, "Set" + name)(*(value if isinstance(value, tuple) else (value,)))
    return w


def decisions(w):
    w.draw()
    return {name: row["Decision"] for name, row in plan_of(w.mapper).items()}


def present(w):
    return {name for name, decision in decisions(w).items() if decision != "not needed"}


def test_what_is_there():
    assert stage(SUN).mapper.Explain() == "Nothing has been drawn yet."
    assert stage(SUN).mapper.GetEffectPlan().GetNumberOfRows() == 0
    assert present(stage()) == set()
    assert present(stage(SUN)) == {"DirectionalLights", "TwoSided"}
    assert present(stage(SUN, LightScale=0.0)) == set()
    assert present(stage(dict(SUN, Intensity=(0, 0, 0)))) == set()
    assert present(stage(SUN, BackfaceCulling=1)) == {"DirectionalLights"}
    assert present(stage(POINT, SPOT)) == {"PointLights", "SpotLights", "SpotShape", "TwoSided"}
    assert present(stage(dict(POINT, Attenuation=(1, 0, 0)))) == {
        "PointLights", "Attenuation", "TwoSided"}
    assert present(stage(SUN, Specular=0.5)) == {"DirectionalLights", "TwoSided", "Specular"}
    w = stage(SUN, Specular=0.5)
    w.renderer.GetActiveCamera().SetParallelProjection(False)
    assert present(w) == {"DirectionalLights", "TwoSided", "Specular", "LocalViewer"}
    assert present(stage(dict(SUN, SpecularColor=(0, 0, 0)), Specular=0.5)) == {
        "DirectionalLights", "TwoSided"}
    assert present(stage(SUN, Specular=0.5, SpecularColor=(0, 0, 0))) == {
        "DirectionalLights", "TwoSided"}
    assert present(stage(SUN, Ambient=0.1)) == {"DirectionalLights", "TwoSided", "GlobalAmbient"}
    assert present(stage(SUN, Ambient=0.1, GlobalAmbient=(0, 0, 0))) == {
        "DirectionalLights", "TwoSided"}
    assert present(stage(Emission=(0, 1, 0))) == {"Emission", "TwoSided"}
    assert present(stage(Emission=(0, 1, 0), BackEmission=(0, 1, 0))) == {"Emission"}
    assert present(stage(SUN, Opacity=0.5)) == {"DirectionalLights", "TwoSided", "Translucency"}
    assert present(stage({"LightType": 4})) == {"Environment", "TwoSided"}
    normals = stage(SUN, FieldMode=2)
    assert present(normals) == {"TwoSided"} and "of its own" in normals.mapper.Explain()
    bands = stage(SUN)
    spectrum = add(bands.mapper.GetLightData().GetPointData(), "Intensity", [[1.0] * 5])
    assert spectrum.GetNumberOfComponents() == 5
    add(bands.mapper.GetLightData().GetFieldData(), "Wavelengths", [450., 500., 550., 600., 650.])
    assert present(bands) == {"DirectionalLights", "TwoSided", "SpectralBands"}


def test_features_follow_the_plan():
    """Whatever the switches: code of an effect is in the shader where its row says so."""
    rng = np.random.default_rng(3)
    code = {"Specular": {"Specular"}, "TwoSided": {"TwoSided"}, "LocalViewer": {"LocalViewer"},
            "GlobalAmbient": {"Ambient"}, "Emission": {"Emission"},
            "DirectionalLights": {"Directional"}, "Attenuation": {"Attenuation"}}
    w = stage(SUN, dict(POINT, Attenuation=(0, 1, 0)), SPOT, Specular=0.5, Ambient=0.2,
              Emission=(0.1, 0, 0))
    w.mapper.SetShadingToPhong()
    w.renderer.GetActiveCamera().SetParallelProjection(False)
    for _ in range(6):
        for effect in ROWS:
            if effect != "SpectralBands":
                w.mapper.SetEffectSwitch(effect, int(rng.integers(0, 3)))
        rows = decisions(w)
        features = set(w.mapper.GetShaderFeatures().split())
        for effect, names in code.items():
            assert (rows[effect] == "simulated") == (names <= features), (effect, rows, features)
        spots = rows["SpotLights"] == "simulated" and rows["SpotShape"] == "simulated"
        assert spots == ("Spot" in features)
        points = rows["PointLights"] == "simulated" or (
            rows["SpotLights"] == "simulated" and rows["SpotShape"] != "simulated")
        assert points == ("Point" in features), (rows, features)


def test_switches_of_properties_are_told_with_their_bounds():
    w = stage(SUN, Specular=0.5, SpecularPower=10.0)
    camera = w.renderer.GetActiveCamera()
    camera.SetParallelProjection(False)
    w.mapper.LocalViewerOff()
    w.mapper.TwoSidedOff()
    w.draw()
    rows = plan_of(w.mapper)
    for effect in ("LocalViewer", "TwoSided"):
        row = rows[effect]
        assert row["Switch"] == "Off" and row["Decision"] == "left out" and "off" in row["Why"]
        assert 0 < row["Bound"] < np.inf and row["Unit"] == "linear colour"
    assert "TwoSided is left out" in w.mapper.Explain()
    # The sum of the two terms of a light of irradiance 1 under which all is white.
    assert math.isclose(rows["TwoSided"]["Bound"], (1 + 0.5 * 12 / 2) / math.pi, rel_tol=1e-12)
    w.mapper.SetEffectSwitch("TwoSided", ON)
    w.mapper.SetEffectSwitch("LocalViewer", ON)
    assert decisions(w)["TwoSided"] == decisions(w)["LocalViewer"] == "simulated"
    w.mapper.SetEffectSwitch("LocalViewer", AUTO)
    w.mapper.SetEveryEffect(True)  # does not switch on what is switched off
    assert decisions(w)["LocalViewer"] == "left out"
    assert w.mapper.GetEffectSwitch("TwoSided") == ON and w.mapper.GetEffectSwitch(20) == ON
    back = vtkProperty()
    w.mapper.SetEffectSwitch("TwoSided", AUTO)
    w.actor.SetBackfaceProperty(back)  # always two-sided
    assert decisions(w)["TwoSided"] == "simulated"


def test_unknown_effects_are_errors():
    w = stage(SUN)
    errors = Errors(w.mapper)
    w.mapper.SetEffectSwitch("Interreflection", OFF)
    w.mapper.SetEffectSwitch("", OFF)
    w.mapper.SetEffectSwitch(99, OFF)
    w.mapper.SetEffectSwitch(-1, OFF)
    assert len(errors.texts) == 4 and "Interreflection" in errors.texts[0], errors.texts
    assert w.mapper.GetEffectSwitch("Interreflection") == w.mapper.GetEffectSwitch(99) == AUTO
    w.mapper.SetEffectSwitch("Specular", 7)
    assert w.mapper.GetEffectSwitch("Specular") == OFF
    other = Window(20).mapper
    w.mapper.SetEffectTolerance(0.25)
    more = Errors(other)
    other.ShallowCopy(w.mapper)
    assert not more.texts
    assert other.GetEffectSwitch("Specular") == OFF and other.GetEffectTolerance() == 0.25


def test_hard_cases():
    """Exponents 0 and 1e6, lights on the surface or nowhere, nothing at all: finite pictures and bounds
    that hold, or none."""
    def check(w, *effects):
        every = w.draw()
        assert np.isfinite(every).all()
        for effect in effects:
            w.mapper.SetEffectSwitch(effect, OFF)
            off = w.draw()
            row = plan_of(w.mapper)[effect]
            assert not math.isnan(row["Bound"]) and row["Bound"] >= 0
            assert row["Decision"] != "simulated"
            assert differs(every, off)[1] <= row["Bound"], (effect, row)
            w.mapper.SetEffectSwitch(effect, AUTO)
        for tolerance in (1e-6, 1.0, 1e300):
            w.mapper.SetEffectTolerance(tolerance)
            auto = w.draw()
            rows = plan_of(w.mapper).values()
            most = sum(row["Bound"] for row in rows if row["Decision"] == "dropped")
            assert most <= tolerance and differs(every, auto)[1] <= most, (rows, tolerance)
        w.mapper.SetEffectTolerance(0)
        return every

    for exponent in (0.0, 1e6):  # the same shaders
        surface = square()
        for name, value in (("SpecularReflectance", 0.4), ("Shininess", exponent)):
            add(surface.GetCellData(), name, [value])
        w = stage(SUN, POINT, surface=surface, FieldMode=4)
        w.renderer.GetActiveCamera().SetParallelProjection(False)
        assert check(w, "Specular", "LocalViewer")[:, :, :3].max() > 0.1
    on = dict(POINT, Position=(0.1, 0.1, 0))
    w = stage(on, dict(SPOT, Position=(0.2, 0, 0), SpotExponent=1e6), Specular=1)
    check(w, "Specular", "PointLights", "SpotShape", "Attenuation")
    w.mapper.SetEffectSwitch("PointLights", OFF)
    w.draw()
    assert plan_of(w.mapper)["PointLights"]["Bound"] == np.inf and "bounded" in w.mapper.Explain()
    check(stage(), "Specular", "PointLights", "TwoSided")  # no light
    for fall_off in ((0, 0, 1), (0.1, 1, 1)):  # a square of the distance that float32 does not hold
        check(stage(dict(POINT, Position=(1e30, 0, 0), Attenuation=fall_off)), "PointLights")
    check(stage(SUN, surface=polydata([(0, 0, 0)] * 3, [(0, 1, 2)], [(0, 0, 1)] * 3)), "TwoSided")
    check(stage(SUN, surface=polydata([(0, 0, 0), (1, 0, 0), (np.nan, 1, 0)], [(0, 1, 2)],
                                      [(0, 0, 1)] * 3)), "DirectionalLights")
    clear = stage(SUN, Opacity=0.0)
    assert check(clear, "Specular")[:, :, 3].max() == 0
    empty = stage(SUN, surface=polydata([], []))
    empty.draw()
    assert empty.mapper.GetEffectPlan().GetNumberOfRows() in (0, len(ROWS))


def test_translucency_off_is_opaque():
    front, behind = square(0.5), square(0.0)
    w = stage(SUN, surface=behind)
    glass = Window(20)
    actor = glass.actor
    glass.mapper.SetInputDataObject(front)
    glass.mapper.SetLightData(lights(SUN))
    actor.GetProperty().SetOpacity(0.25)
    actor.GetProperty().SetDiffuseColor(1, 0, 0)
    w.renderer.AddActor(actor)
    mixed = w.draw()[10, 10]
    assert 0.5 < mixed[1] * math.pi < 0.8, mixed
    glass.mapper.SetEffectSwitch("Translucency", OFF)
    hidden = w.draw()[10, 10]
    assert abs(hidden[0] * math.pi - 1) < 1e-5 and hidden[1] == 0 and hidden[3] == 1, hidden
    row = plan_of(glass.mapper)["Translucency"]
    assert row["Decision"] == "left out" and row["Bound"] == np.inf
    actor.GetProperty().SetOpacity(1.0)
    opaque = w.draw()[10, 10]
    assert np.array_equal(opaque, hidden)
    assert plan_of(glass.mapper)["Translucency"]["Decision"] == "not needed"


def test_extended_lights_off():
    """Area lights, skies and luminaires: what leaving them out changes, and their webs."""
    from vtkradiometry import vtkAreaLightSource

    area = vtkAreaLightSource()
    area.SetPosition(0, 0, 1)
    area.SetDirection(0, 0, -1)
    area.Update()
    web = lights(dict(POINT, PhotometricWeb=0, Intensity=(9, 9, 9)))
    for name, values in (("", [1.0, 0.5, 0.0]), ("Horizontal", [0.0]), ("Vertical", [0.0, 5.0, 10.0])):
        add(web.GetFieldData(), "PhotometricWeb0" + name, values)
    for data, effect in ((area.GetOutput(), "AreaLights"), (lights({"LightType": 4}), "Environment"),
                         (web, "CandelaWebs"), (web, "PointLights")):
        w = stage(surface=square())
        w.mapper.SetLightData(data)
        lit = w.draw()
        assert decisions(w)[effect] == "simulated"
        w.mapper.SetEffectSwitch(effect, OFF)
        off = w.draw()
        row = plan_of(w.mapper)[effect]
        most, beyond = differs(lit, off)
        assert row["Decision"] == "left out" and 0 < row["Bound"] < np.inf
        assert beyond <= row["Bound"] < 6 * most, (effect, most, row)
        if effect == "CandelaWebs":
            assert "Luminaire" not in w.mapper.GetShaderFeatures().split()
            assert off[2, 2, 0] > lit[2, 2, 0]  # bright beyond the beam
        else:
            assert off[:, :, :3].max() == 0
        w.mapper.SetEffectSwitch(effect, AUTO)
        w.mapper.SetEffectTolerance(2 * row["Bound"])
        if effect != "CandelaWebs":  # of a luminaire, the light goes before its web
            assert decisions(w)[effect] == "dropped"
            assert w.draw()[:, :, :3].max() == 0


def test_known_shadows_off():
    surface = square()
    data = lights(SUN, dict(POINT, Intensity=(20, 20, 20)))
    add(surface.GetCellData(), "LightVisibility", [[0.25, 0.5]])
    add(surface.GetFieldData(), "LightVisibilityLights",
        [[2, 0, 0, 0, 0, 0, -1], [0, 0, 0, 3, 0, 0, -1]])
    w = stage(surface=surface)
    w.mapper.SetLightData(data)
    shadows = w.draw()
    assert plan_of(w.mapper)["Occlusion"]["Decision"] == "simulated"
    bright = []
    for off in (lambda: w.mapper.SetEffectSwitch("Occlusion", OFF), w.mapper.UseLightVisibilityOff):
        off()
        bright.append(w.draw())
        row = plan_of(w.mapper)["Occlusion"]
        assert row["Decision"] == "left out", row
        assert math.isclose(row["Bound"], (0.75 + 0.5 * 20 / 9) / math.pi, rel_tol=1e-6)
        most, beyond = differs(shadows, bright[-1])
        assert beyond <= row["Bound"] and most > 0.95 * row["Bound"], (most, row)
        assert "Visibility" not in w.mapper.GetShaderFeatures()
        w.mapper.SetEffectSwitch("Occlusion", AUTO)
    assert np.array_equal(bright[0], bright[1])
    w.mapper.SetEffectSwitch("Occlusion", ON)
    assert np.array_equal(w.draw(), shadows)


def test_highlights_of_a_field_off():
    surface = square()
    add(surface.GetCellData(), "F", [0.5])
    w = stage(SUN, surface=surface, FieldMode=1, FieldArrayName="F", Specular=0.5)
    shining = w.draw()
    assert decisions(w)["Specular"] == "simulated"
    w.mapper.HighlightsOff()
    matte = w.draw()
    row = plan_of(w.mapper)["Specular"]
    assert row["Decision"] == "left out" and row["Switch"] == "Off"
    most, beyond = differs(shining, matte)
    assert beyond <= row["Bound"] and most > 0.1


def test_one_budget_for_effects_and_shading():
    """Effects that are dropped and Gouraud in the place of Phong: together within one tolerance."""
    source = vtkSphereSource()
    source.SetRadius(0.9)
    source.SetThetaResolution(40)
    source.SetPhiResolution(40)
    source.Update()
    weak = [dict(POINT, Position=(2 * math.cos(k), 2 * math.sin(k), 2), Intensity=(0.004,) * 3)
            for k in range(10)]
    w = stage(*weak, dict(SPOT, Position=(0, 0, 4), Intensity=(3, 3, 3), SpotCutoff=40),
              surface=source.GetOutput(), size=120, Specular=1e-5, Ambient=2e-5)
    w.mapper.SetShadingToPhong()
    every = w.draw()
    w.mapper.SetShadingToAuto()
    w.mapper.SetShadingTimeShare(1e30)
    shares, spent = [], []
    most = 3e-4
    for effects in (0.0, most / 100, most / 10, most):
        w.mapper.SetEffectTolerance(effects)
        w.mapper.SetShadingTolerance(most)
        auto = w.draw()
        assert differs(every, auto)[1] <= most
        spent.append(sum(r["Bound"] for r in plan_of(w.mapper).values() if r["Decision"] == "dropped"))
        shares.append(w.mapper.GetGouraudShare())
        measured = w.mapper.MeasureGreatestDifference(w.renderer)
        assert abs(measured - differs(every, auto)[0]) < 1e-5
    assert spent == sorted(spent) and spent[0] == 0 < spent[2] and spent[-1] <= most, spent
    assert 0 < shares[0] < 1, shares
    w.mapper.SetShadingTolerance(spent[-1])  # all of it is spent
    w.draw()
    assert w.mapper.GetGouraudShare() == 0, w.mapper.GetShadingReason()


def test_blocks_are_one_picture():
    bare = square(half=0.4)
    bare.GetPointData().SetNormals(None)
    blocks = vtkMultiBlockDataSet()
    blocks.SetBlock(0, square())
    blocks.SetBlock(1, bare)
    w = stage(SUN, surface=blocks, Specular=0.5)
    assert decisions(w)["Specular"] == "simulated"
    w.mapper.SetEffectSwitch("Specular", OFF)
    w.draw()
    row = plan_of(w.mapper)["Specular"]
    assert row["Decision"] == "left out" and 0 < row["Bound"] < np.inf


def test_nothing_is_decided_or_built_anew_without_need():
    w = stage(SUN, POINT, Specular=0.01)
    w.mapper.SetEffectTolerance(1e-3)
    w.draw()
    builds, text = w.mapper.GetNumberOfShaderBuilds(), w.mapper.Explain()
    for _ in range(3):
        w.draw()
    assert w.mapper.GetNumberOfShaderBuilds() == builds and w.mapper.Explain() == text


run(globals())
