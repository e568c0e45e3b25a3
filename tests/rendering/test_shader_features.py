# SPDX-License-Identifier: BSD-3-Clause
"""Every feature of the shaders: which scene needs it, and that its text is there then and only then.

A line of rendering/glsl that stands, wherever it occurs, under //@if FEATURE belongs to that feature.
For each scene the features are stated here by hand. In what was compiled for it there must be no line of
any other feature; each feature that has lines of its own must show some of them; and whatever uniform,
input or output is declared must be used.
"""
import glob
import os
import re

from drawing import Window, add, lights, polydata, run, square
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkRenderingCore import vtkProperty

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

SUN = {"LightType": 2}
POINT = {"LightType": 0, "Position": (0, 0, 3)}
SPOT = {"LightType": 1, "Position": (0, 0, 3), "SpotCutoff": 30}
ALWAYS = "Lit"  # by lights, whether there are any or not
LIGHT = "Lit Lights Diffuse NeedsNormal"
PHONG = LIGHT + " FragmentNormal"
NEAR = PHONG + " Finite InverseSquare Position FragmentPosition Point"
SHINE = "Specular NeedsPower"


def lines_of_features():
    """{line: set of the features that each of its occurrences stands under}"""
    owners = {}
    folder = os.path.join(ROOT, "rendering", "glsl")
    for path in glob.glob(os.path.join(folder, "vtk*Gouraud*.glsl")) + glob.glob(
            os.path.join(folder, "vtkRadiometry*.glsl")):
        stack = []
        with open(path, encoding="utf-8") as file:
            for raw in file:
                line = raw.strip()
                if line.startswith("//@if "):
                    stack.append(line.split()[1])
                elif line == "//@else":
                    stack[-1] = None
                elif line == "//@end":
                    stack.pop()
                elif line and not line.startswith("//"):
                    under = {name for name in stack if name}
                    owners[line] = owners[line] & under if line in owners else under
        assert not stack, path
    return owners


# Declared by VTK or by vtkPhongGouraudShaders.cxx, too, where another shader or effect needs them.
SHARED = {"uniform mat3 normalMatrix;", "uniform float specularPowerUniform;",
          "uniform float specularPowerUniformBF;", "uniform mat4 MCVCMatrix;"}
LINES = {line: names for line, names in lines_of_features().items() if line not in SHARED}
FEATURES = set().union(*LINES.values())
# Made from others where the text is put together (vtkPhongGouraudShaders.cxx).
DERIVED = {"BothSides": {"PerVertex", "TwoSided"}, "BlockColors": {"FalseColor"}}
seen = set()


def window(*records, shading="Phong", surface=None, **settings):
    w = Window()
    w.mapper.SetInputDataObject(surface or square())
    w.mapper.SetLightData(lights(*records))
    w.mapper.SetTwoSided(False)
    getattr(w.mapper, "SetShadingTo" + shading)()
    for name, value in settings.items():
        where = w.mapper if hasattr(w.mapper, "Set" + name) else w.actor.GetProperty()
        getattr(where, "Set" + name)(*(value if isinstance(value, tuple) else (value,)))
    return w


def code_of(text):
    return {line.strip() for line in text.splitlines()}


def expect(w, features, *more):
    w.draw()
    expected = set(features.split()).union(*(part.split() for part in more))
    found = set(w.mapper.GetShaderFeatures().split())
    assert found == expected, (sorted(found - expected), sorted(expected - found))
    vertex, fragment = w.mapper.GetVertexShaderText(), w.mapper.GetFragmentShaderText()
    code = code_of(vertex) | code_of(fragment)
    present = found | {name for name, needs in DERIVED.items() if needs <= found}
    for line in code:
        missing = LINES.get(line, set()) - present
        assert not missing, f"{line!r} belongs to {missing}, which the scene does not need"
    for feature in found & FEATURES:
        # Of the lines that need nothing else that is absent, at least one.
        own = [line for line, names in LINES.items() if feature in names and names <= present]
        assert not own or any(line in code for line in own), f"{feature}: none of {own}"
    for text in (vertex, fragment):
        for name in re.findall(r"^\s*(?:uniform|in|out)\s+\w+\s+(\w+)\s*(?:\[\w*\])?;", text, re.M):
            if name in OURS:
                assert len(re.findall(rf"\b{name}\b", text)) > 1, f"{name} is declared for nothing"
    outputs = set(re.findall(r"^\s*out\s+\w+\s+(\w+);", vertex, re.M)) & OURS
    inputs = set(re.findall(r"^\s*in\s+\w+\s+(\w+);", fragment, re.M))
    assert outputs <= inputs, outputs - inputs
    seen.update(present)


OURS = {name for line in LINES
        for name in re.findall(r"^(?:uniform|in|out)\s+\w+\s+(\w+)", line)}


def test_kinds_of_lights():
    expect(window(), ALWAYS)
    expect(window(SUN), PHONG, "Directional")
    expect(window(POINT), NEAR)
    expect(window(dict(SPOT)), NEAR.replace("Point", "Spot"))
    expect(window(SUN, POINT, SPOT), NEAR, "Directional Spot")
    expect(window(SUN, dict(POINT, LightEnabled=0), dict(SPOT, Intensity=(0, 0, 0))), PHONG,
           "Directional")
    expect(window(SUN, LightScale=0.0), ALWAYS)


def test_falling_off_and_cones():
    expect(window(dict(POINT, Attenuation=(1, 0, 0))), NEAR.replace("InverseSquare", ""))
    expect(window(dict(POINT, Attenuation=(0, 1, 0))), NEAR.replace("InverseSquare", "Attenuation"))
    expect(window(POINT, dict(POINT, Attenuation=(1, 0, 0))),
           NEAR.replace("InverseSquare", "Attenuation"))
    spot = NEAR.replace("Point", "Spot")
    expect(window(dict(SPOT, SpotExponent=3)), spot, "SpotExponent NeedsPower")
    expect(window(dict(SPOT, SpotInnerCutoff=10)), spot, "SmoothEdge")
    expect(window(dict(SPOT, SpotCutoff=180, SpotExponent=3)), NEAR)  # no cone: a point light


def source(kind, **settings):
    made = kind()
    for name, value in settings.items():
        getattr(made, "Set" + name)(*(value if isinstance(value, tuple) else (value,)))
    made.Update()
    return made.GetOutput()


def test_luminaires_emitting_surfaces_and_skies():
    from vtkmodules.vtkCommonCore import vtkDoubleArray
    from vtkradiometry import vtkAreaLightSource, vtkEnvironmentLightSource

    far = PHONG + " Finite Position FragmentPosition"
    web = lights(dict(POINT, Attenuation=(0, 0, 1), PhotometricWeb=0))
    for name, values in (("", (1.0, 0.5, 0.0)), ("Horizontal", (0.0,)), ("Vertical", (0, 45, 90))):
        array = vtkDoubleArray()
        array.SetName("PhotometricWeb0" + name)
        for value in values:
            array.InsertNextValue(value)
        web.GetFieldData().AddArray(array)
    sky = source(vtkEnvironmentLightSource)
    panel = source(vtkAreaLightSource)
    for data, features in ((web, far + " Luminaire InverseSquare"), (panel, far + " Area"),
                           (sky, PHONG + " Sky")):
        w = window()
        w.mapper.SetLightData(data)
        expect(w, features)
    w.mapper.SetLightData(lights(SUN))
    expect(w, PHONG, "Directional")


def test_places_of_evaluation():
    expect(window(SUN, shading="Flat"), PHONG, "Directional PerCell CellFrame")
    expect(window(POINT, shading="Flat"), NEAR.replace("FragmentPosition", "CellPosition"),
           "PerCell CellFrame")
    gouraud = LIGHT + " PerVertex"
    expect(window(SUN, shading="Gouraud"), gouraud, "Directional")
    expect(window(SUN, shading="Gouraud", TwoSided=True), gouraud, "Directional TwoSided")
    expect(window(POINT, shading="Gouraud"), gouraud, "Point Finite InverseSquare Position")
    bare = square()
    bare.GetPointData().SetNormals(None)
    for shading in ("Gouraud", "Phong"):
        expect(window(SUN, shading=shading, surface=bare), PHONG, "Directional CellFrame")
    expect(window(SUN, shading="Auto"), gouraud, "Directional")
    # Both: one corner of the mesh is in a cone, eight lights far away hardly vary.
    n = 16
    ticks = [-0.8 + 1.6 * i / n for i in range(n + 1)]
    mesh = polydata([(x, y, 0) for y in ticks for x in ticks],
                    [(j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i)
                     for j in range(n) for i in range(n)], [(0, 0, 1)] * (n + 1) ** 2)
    w = window(dict(SPOT, Position=(0.5, 0.5, 0.8), SpotCutoff=15), *[
        dict(POINT, Position=(0, 0, 30), Intensity=(50, 50, 50))] * 8, shading="Auto", surface=mesh,
        ShadingTimeShare=1e9)
    expect(w, NEAR, "Spot PerVertex PerTriangle")


def test_highlights():
    for model, name in enumerate(("BlinnPhong", "Phong", "Physical")):
        w = window(SUN, Specular=0.5, ReflectionModel=model)
        expect(w, PHONG, SHINE, "Directional", name)
        w.renderer.GetActiveCamera().SetParallelProjection(False)
        expect(w, PHONG, SHINE, "Directional LocalViewer Position FragmentPosition FragmentViewer",
               name)
        w.mapper.SetLocalViewer(False)
        expect(w, PHONG, SHINE, "Directional", name)
        w = window(SUN, shading="Gouraud", Specular=0.5, ReflectionModel=model, TwoSided=True)
        expect(w, LIGHT, SHINE, "Directional PerVertex TwoSided", name)
        w.renderer.GetActiveCamera().SetParallelProjection(False)
        expect(w, LIGHT, SHINE, "Directional PerVertex TwoSided LocalViewer Position", name)
    expect(window(SUN, Specular=0.5, SpecularColor=(0, 0, 0)), PHONG, "Directional")
    expect(window(dict(SUN, SpecularColor=(1, 0, 0)), Specular=0.5), PHONG, SHINE,
           "Directional Physical LightSpecular")
    expect(window(dict(SUN, SpecularColor=(1, 0, 0))), PHONG, "Directional")
    expect(window(Specular=0.5), ALWAYS)


def test_ambient_and_emission():
    own = dict(SUN, AmbientColor=(0.1, 0.2, 0.3))
    expect(window(SUN, Ambient=0.5), PHONG, "Directional Ambient")
    expect(window(own, Ambient=0.5), PHONG, "Directional Ambient LightAmbient")
    expect(window(own), PHONG, "Directional")
    expect(window(own, Ambient=0.5, shading="Gouraud"), LIGHT,
           "PerVertex Directional Ambient LightAmbient")
    expect(window(Ambient=0.5), ALWAYS, "Ambient")
    expect(window(Emission=(1, 0, 0)), ALWAYS, "Emission")
    expect(window(Emission=(1, 0, 0), TwoSided=True), ALWAYS, "Emission TwoSided")


def test_sides():
    expect(window(SUN, TwoSided=True), PHONG, "Directional TwoSided")
    w = window(SUN, TwoSided=True)
    w.actor.SetScale(-1, 1, 1)
    expect(w, PHONG, "Directional TwoSided Mirrored")
    w.mapper.SetTwoSided(False)
    expect(w, PHONG, "Directional")
    for shading, place in (("Phong", PHONG), ("Gouraud", LIGHT + " PerVertex")):
        w = window(SUN, shading=shading, Specular=0.5)
        w.actor.SetBackfaceProperty(vtkProperty())
        expect(w, place, SHINE, "Directional TwoSided BackProperty BackMaterial Physical")
    w = window(SUN)
    w.actor.SetBackfaceProperty(vtkProperty())
    expect(w, PHONG, "Directional TwoSided BackProperty")


def test_edges():
    expect(window(SUN, EdgeVisibility=1), PHONG, "Directional Edges")
    for shading in ("Flat", "Gouraud"):
        expect(window(SUN, EdgeVisibility=1, shading=shading), LIGHT, "Directional Edges",
               "PerVertex" if shading == "Gouraud" else "PerCell CellFrame FragmentNormal")


def with_arrays(**arrays):
    surface = square()
    for name, values in arrays.items():
        of_points = len(values) == 4
        add((surface.GetPointData() if of_points else surface.GetCellData()), name, values)
    return surface


def test_fields():
    def field(surface, mode, **settings):
        return window(SUN, POINT, SPOT, surface=surface, FieldMode=mode, FieldArrayName="F",
                      **settings)

    cells, points = with_arrays(F=[1.0]), with_arrays(F=[1.0, 2.0, 3.0, 4.0])
    both = with_arrays(F=[1.0], FBack=[2.0])
    both_points = with_arrays(F=[1.0] * 4, FBack=[2.0] * 4)
    expect(field(cells, 1), "Field ShowField FieldOfCells")
    expect(field(points, 1), "Field ShowField FieldOfPoints")
    expect(field(both, 1), "Field ShowField FieldOfCells FieldOfBack")
    expect(field(both, 1, TwoSided=True), "Field ShowField FieldOfCells FieldOfBack TwoSided")
    expect(field(both_points, 1, TwoSided=True), "Field ShowField FieldOfPoints FieldOfBack TwoSided")
    expect(field(cells, 1, EdgeVisibility=1), "Field ShowField FieldOfCells Edges")
    expect(field(points, 1, EdgeVisibility=1), "Field ShowField FieldOfPoints Edges")
    expect(field(points, 2), "ShowNormals FragmentNormal NeedsNormal")
    expect(window(SUN, surface=cells, FieldMode=3, FieldArrayName="F"), PHONG,
           "Directional Field FieldIsReflectance FieldOfCells")
    expect(window(SUN, surface=points, FieldMode=3, FieldArrayName="F"), PHONG,
           "Directional Field FieldIsReflectance FieldOfPoints")
    # A highlight on a field: lights, and nothing of the diffuse part.
    shining = set(PHONG.split()) - {"Lit", "Diffuse"}
    expect(window(SUN, surface=cells, FieldMode=1, FieldArrayName="F", Specular=0.5),
           " ".join(shining), SHINE, "Directional Physical Field ShowField FieldOfCells")


def test_materials():
    matte = with_arrays(DiffuseReflectance=[0.5])
    expect(window(SUN, surface=matte, FieldMode=4), PHONG, "Directional Materials")
    glossy = with_arrays(DiffuseReflectance=[0.5], SpecularReflectance=[0.5], Shininess=[20.0])
    expect(window(SUN, surface=glossy, FieldMode=4), PHONG, SHINE, "Directional Materials Physical")
    glowing = with_arrays(EmittedExitance=[3.0])
    expect(window(SUN, surface=glowing, FieldMode=4), PHONG,
           "Directional Materials MaterialEmission")
    expect(window(surface=glowing, FieldMode=4), ALWAYS, "Materials MaterialEmission")


def test_false_colours():
    table = vtkLookupTable()
    table.Build()

    def false_color(of_points, **settings):
        surface = with_arrays(S=[0.1, 0.2, 0.3, 0.4] if of_points else [0.5])
        (surface.GetPointData() if of_points else surface.GetCellData()).SetActiveScalars("S")
        w = window(SUN, surface=surface, FieldMode=5, **settings)
        w.mapper.SetLookupTable(table)
        w.target.AllSceneLinearOn()
        return w

    expect(false_color(False), "FalseColor ColorsOfCells")
    expect(false_color(True), "FalseColor ScalarsOfPoints")
    expect(false_color(True, EdgeVisibility=1), "FalseColor ScalarsOfPoints Edges")
    expect(window(SUN, FieldMode=5), "FalseColor")
    direct = square()
    add(direct.GetPointData(), "RGB", [(255, 0, 0)] * 4, dtype="uint8")
    direct.GetPointData().SetActiveScalars("RGB")
    w = window(SUN, surface=direct, FieldMode=5)
    w.target.AllSceneLinearOn()
    expect(w, "FalseColor ColorsOfPoints")


def visible(of_points, back=False, count=1, occluded=True):
    """A square that knows how much of each light arrives, as the simulating filters write it."""
    from vtkradiometry import vtkIrradianceFilter

    surface = square()
    x = 0.0 if occluded else 50.0
    roof = polydata([(x, -1, 2), (x + 1, -1, 2), (x + 1, 1, 2), (x, 1, 2)], [(0, 1, 2, 3)])
    data = lights(*[dict(SUN, Direction=(0.1 * i, 0, -1)) for i in range(count)])
    f = vtkIrradianceFilter()
    f.SetInputDataObject(0, surface)
    f.SetInputDataObject(1, data)
    f.SetInputDataObject(2, roof)
    f.SetLightVisibility(True)
    f.SetSampleLocation(1 if of_points else 0)
    f.SetTwoSided(back)
    f.Update()
    w = window(SUN, surface=f.GetOutput())
    w.mapper.SetLightData(data)
    w.mapper.SetTwoSided(back)
    return w


def test_known_shadows():
    w = visible(False)
    w.draw()
    names = set(w.mapper.GetShaderFeatures().split())
    assert {"Visibility", "VisibilityOfCells"} <= names, names
    expect(w, " ".join(names))
    w.mapper.SetTwoSided(True)  # of a surface that knows of its front only
    expect(w, " ".join(names), "TwoSided VisibilityOfFront")
    for of_points, back, count in ((True, False, 1), (True, True, 1), (False, True, 1),
                                   (True, False, 6), (True, False, 10), (True, False, 14)):
        w = visible(of_points, back, count)
        w.draw()
        names = set(w.mapper.GetShaderFeatures().split())
        assert ("VisibilityOfPoints" in names) == of_points, names
        assert ("VisibilityOfBack" in names) == back, names
        expect(w, " ".join(names))
    w.mapper.SetUseLightVisibility(False)
    expect(w, PHONG, "Directional")
    expect(visible(False, occluded=False), PHONG, "Directional")  # all of the light arrives


def test_translucency():
    expect(window(SUN, Opacity=0.5), PHONG, "Directional")  # VTK's own text
    w = window(SUN, Opacity=0.5)
    w.mapper.SetEffectSwitch("Translucency", 2)
    expect(w, PHONG, "Directional Opaque")
    w.actor.GetProperty().SetOpacity(1.0)
    expect(w, PHONG, "Directional")


def test_extended_lights():
    from vtkradiometry import vtkAreaLightSource

    web = lights(dict(POINT, PhotometricWeb=0))
    for name, values in (("", [1.0, 0.5, 0.0]), ("Horizontal", [0.0]), ("Vertical", [0.0, 60.0, 90.0])):
        add(web.GetFieldData(), "PhotometricWeb0" + name, values)
    area = vtkAreaLightSource()
    area.SetPosition(0, 0, 1)
    area.SetDirection(0, 0, -1)
    area.Update()
    w = window()
    w.mapper.SetLightData(web)
    expect(w, NEAR.replace("Point", "Luminaire"))
    w.mapper.SetLightData(area.GetOutput())
    expect(w, PHONG, "Finite Position FragmentPosition Area")
    w.mapper.SetLightData(lights({"LightType": 4}))
    expect(w, PHONG, "Sky")
    w.mapper.SetShadingToGouraud()
    expect(w, LIGHT, "PerVertex Sky")


def test_every_effect_at_once():
    """EveryEffect puts in what is not needed, for comparison; without it that is gone."""
    w = window(SUN, EveryEffect=True)
    w.draw()
    names = set(w.mapper.GetShaderFeatures().split())
    assert {"Specular", "Spot", "Point", "Ambient", "Emission", "SmoothEdge"} <= names
    w.mapper.SetEveryEffect(False)
    expect(w, PHONG, "Directional")


def test_zz_every_feature_of_the_text_was_seen():
    """Runs last: a new //@if needs a scene here."""
    assert FEATURES <= seen, sorted(FEATURES - seen)


run(globals())
