# SPDX-License-Identifier: BSD-3-Clause
"""The generated shaders hold what the lights and the material need, and nothing else."""
import os
import re

from drawing import Window, add, lights, run, square

GLSL = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))),
                    "rendering", "glsl")

# Words of the text that belong to an effect. Whatever a scene lacks must not be in its shaders.
EFFECTS = {
    "directional": ["directionalRange"],
    "point": ["pointRange"],
    "spot": ["spotRange", "coneFactor"],
    "finite": ["fallOff"],
    "exponent": ["exponent"],
    "smooth edge": ["t * t;"],
    "polynomial attenuation": ["abc"],
    "inverse square": ["inverse * inverse"],
    "highlights": ["specular", "powerOfCosine"],
    "half vector": ["vec3 H ="],
    "mirrored vector": ["2.0 * dot(N, V) * N - V"],
    "energy conservation": ["shininess + 2.0"],
    "local viewer": ["eyeLC"],
    "light ambient": ["sums.ambient", "ambientLight"],
    "ambient": ["globalAmbient"],
    "emission": ["emission"],
    "back": ["gl_FrontFacing", "frontFacing", "Back"],
    "field": ["fieldScale", "radiometryField"],
    "cell frames": ["radiometryCellFrames"],
    "lights": ["radiometryLights", "LightSums"],
    "normals as colours": ["viewToWorld"],
    "interpolated light": ["diffuseFront"],
}

POINT = {"LightType": 0, "Position": (0, 0, 3)}
SPOT = {"LightType": 1, "Position": (0, 0, 3), "SpotCutoff": 30}
SUN = {"LightType": 2}


def plain(light_list, shading="Phong"):
    w = Window()
    w.mapper.SetInputDataObject(square())
    w.mapper.SetLightData(lights(*light_list))
    w.mapper.TwoSidedOff()
    getattr(w.mapper, "SetShadingTo" + shading)()
    return w


def text(w):
    w.draw()
    vertex, fragment = w.mapper.GetVertexShaderText(), w.mapper.GetFragmentShaderText()
    assert vertex and fragment
    return vertex + fragment


def expect(w, *present):
    code = text(w)
    for effect, words in EFFECTS.items():
        found = [word for word in words if word in code]
        if effect in present:
            assert found, f"{effect} is missing from\n{code}"
        else:
            assert not found, f"{effect}: {found} should not be in\n{code}"


def test_directional_light_on_a_matte_surface():
    expect(plain([SUN]), "directional", "lights")


def test_point_light():
    expect(plain([POINT]), "point", "finite", "inverse square", "lights")


def test_legacy_attenuation():
    expect(plain([dict(POINT, Attenuation=(1, 0.5, 0.25))]),
           "point", "finite", "polynomial attenuation", "lights")
    # Without fall-off there is no formula for it.
    expect(plain([dict(POINT, Attenuation=(1, 0, 0))]), "point", "finite", "lights")


def test_spot_light():
    expect(plain([SPOT]), "spot", "finite", "inverse square", "lights")
    expect(plain([dict(SPOT, SpotExponent=4)]),
           "spot", "finite", "inverse square", "exponent", "lights")
    expect(plain([dict(SPOT, SpotInnerCutoff=10)]),
           "spot", "finite", "inverse square", "smooth edge", "lights")
    # A spot without a cone is a point light.
    expect(plain([dict(SPOT, SpotCutoff=180)]), "point", "finite", "inverse square", "lights")


def test_disabled_and_black_lights_leave_no_code():
    expect(plain([SUN, dict(POINT, LightEnabled=0), dict(SPOT, Intensity=(0, 0, 0))]),
           "directional", "lights")
    expect(plain([dict(POINT, LightEnabled=0)]))  # no light at all: black, and no light code


def test_highlights():
    for model, effect in (("BlinnPhong", "half vector"), ("Phong", "mirrored vector"),
                          ("Physical", "mirrored vector")):
        w = plain([SUN])
        w.actor.GetProperty().SetSpecular(0.5)
        getattr(w.mapper, "SetReflectionModelTo" + model)()
        extra = ["energy conservation"] if model == "Physical" else []
        # A parallel projection has one direction to the viewer.
        expect(w, "directional", "lights", "highlights", effect, *extra)
        w.renderer.GetActiveCamera().SetParallelProjection(False)
        expect(w, "directional", "lights", "highlights", "local viewer", effect, *extra)
        w.mapper.LocalViewerOff()
        expect(w, "directional", "lights", "highlights", effect, *extra)
        w.actor.GetProperty().SetSpecularColor(0, 0, 0)
        expect(w, "directional", "lights")


def test_ambient():
    w = plain([dict(SUN, AmbientColor=(0.1, 0.1, 0.1))])
    expect(w, "directional", "lights")  # the material takes no ambient light
    w.actor.GetProperty().SetAmbient(0.5)
    expect(w, "directional", "lights", "ambient", "light ambient")


def test_emission_and_sides():
    w = plain([SUN])
    w.mapper.SetEmission(1, 2, 3)
    expect(w, "directional", "lights", "emission")
    w.mapper.SetEmission(0, 0, 0)
    w.mapper.TwoSidedOn()
    expect(w, "directional", "lights", "back")


def test_gouraud_interpolates_light_and_sums_it_once():
    w = plain([POINT], "Gouraud")
    expect(w, "point", "finite", "inverse square", "lights", "interpolated light")
    assert "sumLights" in w.mapper.GetVertexShaderText()
    assert "sumLights" not in w.mapper.GetFragmentShaderText()
    assert "normalVCVSOutput" not in text(w)  # the normal itself is not handed on
    w = plain([POINT], "Phong")
    text(w)
    assert "sumLights" not in w.mapper.GetVertexShaderText()
    assert "sumLights" in w.mapper.GetFragmentShaderText()


def test_flat():
    expect(plain([SUN], "Flat"), "directional", "lights", "cell frames")


def test_fields():
    w = plain([SUN, POINT, SPOT])
    add(w.mapper.GetInputDataObject(0, 0).GetCellData(), "F", [1.0])
    w.mapper.SetFieldArrayName("F")
    w.mapper.SetFieldModeToOn()
    expect(w, "field")  # no light code
    w.mapper.SetFieldModeToNormals()
    expect(w, "normals as colours")


def without(text, features):
    """A file of rendering/glsl as it would be, had the features never been written."""
    kept, stack = [], []
    for line in text.splitlines():
        word = line.strip()
        if word.startswith("//@if "):
            name = word.split()[1]
            gone = name.lstrip("!") in features
            # Of what never was, the lines of "if" are not there; those of "if not" stand alone.
            stack.append("hidden" if gone and not name.startswith("!") else
                         ("bare" if gone else "written"))
            if gone:
                continue
        elif word == "//@else" and stack[-1] != "written":
            stack[-1] = "bare" if stack[-1] == "hidden" else "hidden"
            continue
        elif word == "//@end" and stack.pop() != "written":
            continue
        if "hidden" not in stack:
            kept.append(line)
    return "\n".join(kept)


def expanded(text, features):
    """What a shader gets of such a file."""
    kept, stack = [], []
    for line in text.splitlines():
        word = line.strip()
        if word.startswith("//@if "):
            name = word.split()[1]
            stack.append((name.lstrip("!") in features) != name.startswith("!"))
        elif word == "//@else":
            stack[-1] = not stack[-1]
        elif word == "//@end":
            stack.pop()
        elif all(stack) and word and not word.startswith("//"):
            kept.append(line)
    return "\n".join(kept)


def test_a_plain_scene_pays_nothing():
    """Byte by byte, the shaders of a plain scene are those of files from which every effect that it does
    not have was cut out; a twin with every effect has other text."""
    for light_list, shading in (([SUN], "Phong"), ([POINT], "Phong"), ([POINT], "Gouraud")):
        w = plain(light_list, shading)
        text(w)
        vertex, fragment = w.mapper.GetVertexShaderText(), w.mapper.GetFragmentShaderText()
        needs = set(w.mapper.GetShaderFeatures().split())
        lit_at = "vertex" if shading == "Gouraud" else "fragment"
        known, cut = set(), 0
        for name in ("VSDec", "VS", "FSDec", "FS", "Lights", "ExtendedLights", "LightSums"):
            path = ("vtkRadiometry" if "Light" in name else "vtkPhongGouraud") + name
            with open(os.path.join(GLSL, path + ".glsl"), encoding="utf-8") as file:
                whole = file.read()
            effects = set(re.findall(r"//@if !?(\w+)", whole)) - needs
            known |= effects
            lean = without(whole, effects)
            cut += len(whole) - len(lean)
            assert not effects & set(re.findall(r"//@if !?(\w+)", lean))
            holder = {"V": vertex, "F": fragment}.get(name[0]) or (
                vertex if lit_at == "vertex" else fragment)
            for where in ([vertex, fragment] if "Light" in name else [holder]):
                features = set(needs)
                if ("Light" in name or name in ("VS", "FS")) and (where is vertex) != (lit_at == "vertex"):
                    if name != "FS":  # sums of lights stand at one place
                        features -= {"Lights", "Finite", "NeedsPower", "Spot", "NeedsNormal"}
                piece = expanded(lean, features)
                assert piece == expanded(whole, features)
                if name != "FS" or shading == "Phong":
                    assert piece.strip() in where, (name, piece, where)
        assert len(known) > 30 and cut > 15000, (len(known), cut)
        w.mapper.SetEveryEffect(True)
        w.draw()
        assert len(w.mapper.GetVertexShaderText() + w.mapper.GetFragmentShaderText()) > 1000 + len(
            vertex + fragment)
        w.mapper.SetEveryEffect(False)
        w.mapper.SetEffectTolerance(1e-9)  # bounds are looked at, and the text is the same
        w.draw()
        assert (w.mapper.GetVertexShaderText(), w.mapper.GetFragmentShaderText()) == (
            vertex, fragment)


def test_nothing_is_rebuilt_without_need():
    data = lights(dict(POINT, Attenuation=(1, 0.5, 0)), SUN)
    w = plain([SUN])
    w.mapper.SetLightData(data)
    w.draw()
    builds = w.mapper.GetNumberOfShaderBuilds()
    assert builds == 1
    before = w.at(0, 0)
    w.draw()
    data.GetPoints().SetPoint(0, 0, 0, 1.5)  # the light moves
    data.GetPoints().Modified()
    assert w.at(0, 0)[0] > before[0]
    data.GetPointData().GetArray("Intensity").SetTuple3(0, 9, 9, 9)
    assert w.at(0, 0)[0] > 2 * before[0]
    w.renderer.GetActiveCamera().Azimuth(10)
    w.draw()
    assert w.mapper.GetNumberOfShaderBuilds() == builds
    # A light less of its kind: other code, once.
    data.GetPointData().GetArray("LightEnabled").SetValue(0, 0)
    assert "pointRange" not in text(w)
    w.draw()
    assert w.mapper.GetNumberOfShaderBuilds() == builds + 1


def test_auto_says_what_it_chose():
    w = plain([SUN], "Auto")
    w.draw()
    assert w.mapper.GetShadingUsed() == 1  # one normal a cell, directional light: Gouraud is exact
    w.mapper.SetLightData(lights(POINT))
    w.draw()
    assert w.mapper.GetShadingUsed() == 2
    w.mapper.SetLightData(lights(SUN))
    w.actor.GetProperty().SetSpecular(1)
    w.draw()
    assert w.mapper.GetShadingUsed() == 2


run(globals())
