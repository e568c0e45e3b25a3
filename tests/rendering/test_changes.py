# SPDX-License-Identifier: BSD-3-Clause
"""What changes between frames: inputs, properties, windows. Each picture is that of a fresh scene."""
import ctypes
import math

import numpy as np

from drawing import Errors, Window, add, lights, polydata, run, square
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkProperty
from vtkradiometry.vtkRadiometryRendering import vtkLinearFloatPass, vtkPhongGouraudMapper

SUN = {"LightType": 2, "Intensity": (math.pi,) * 3}
SHADINGS = ("Flat", "Gouraud", "Phong")
GL = ctypes.CDLL("libGL.so.1")


def no_gl_errors(w):
    w.window.MakeCurrent()
    code = GL.glGetError()
    assert code == 0, hex(code)


def lit(shading="Phong", surface=None, *records):
    w = Window()
    w.mapper.SetInputDataObject(surface or square())
    w.mapper.SetLightData(lights(*(records or (SUN,))))
    getattr(w.mapper, "SetShadingTo" + shading)()
    return w


def surface_of(n, bend=0.3):
    """A grid of n x n squares with normals, arrays of cells and points."""
    ticks = np.linspace(-0.8, 0.8, n + 1)
    points = [(x, y, bend * x * x) for y in ticks for x in ticks]
    normals = [np.array((-2 * bend * x, 0, 1)) / math.hypot(2 * bend * x, 1) for y in ticks
               for x in ticks]
    cells = [(j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i)
             for j in range(n) for i in range(n)]
    surface = polydata(points, cells, normals)
    rng = np.random.default_rng(n)
    add(surface.GetCellData(), "DiffuseReflectance", rng.uniform(0, 1, (n * n, 3)))
    add(surface.GetCellData(), "F", rng.uniform(0, 100, (n * n, 3)))
    add(surface.GetPointData(), "P", rng.uniform(0, 100, (n + 1) ** 2))
    return surface


SETTINGS = {
    "FieldMode": (0, 1, 2, 3, 4, 5),
    "FieldArrayName": ("F", "P", "DiffuseReflectance", ""),
    "FieldScale": (1.0, 0.25),
    "Shading": (0, 1, 2),
    "ReflectionModel": (0, 1, 2),
    "TwoSided": (True, False),
    "LocalViewer": (True, False),
    "Emission": ((0, 0, 0), (1, 2, 3)),
    "LightScale": (1.0, 3.0),
    "GlobalAmbient": ((1, 1, 1), (0, 2, 0)),
}
PROPERTY = {"Specular": (0.0, 0.5), "SpecularPower": (1.0, 30.0), "Ambient": (0.0, 0.25),
            "Opacity": (1.0, 0.5), "EdgeVisibility": (0, 1), "Interpolation": (0, 1),
            "Representation": (0, 1, 2), "Color": ((1, 1, 1), (0.2, 0.4, 0.6))}
LIGHTS = ([SUN], [], [{"Position": (0.5, 0.5, 2), "Intensity": (9, 6, 3)}],
          [SUN, {"LightType": 1, "Position": (0, 0, 2), "SpotCutoff": 30, "SpotExponent": 8}])


def apply(w, state):
    for name in SETTINGS:
        value = state[name]
        getattr(w.mapper, "Set" + name)(*(value if isinstance(value, tuple) else (value,)))
    for name in PROPERTY:
        value = state[name]
        getattr(w.actor.GetProperty(), "Set" + name)(*(value if isinstance(value, tuple) else (value,)))
    back = None
    if state["back"]:
        back = vtkProperty()
        back.SetColor(0.9, 0.1, 0.1)
    w.actor.SetBackfaceProperty(back)
    w.actor.SetOrientation(0, 180 if state["turned"] else 0, 0)
    w.mapper.SetLightData(lights(*LIGHTS[state["lights"]]))
    w.mapper.SetInputDataObject(state["surface"])


def test_any_change_after_any_other():
    """A random walk: after each step the old window shows what a new one shows."""
    rng = np.random.default_rng(7)
    surfaces = [surface_of(3), surface_of(5, bend=-0.2), square()]
    state = {name: values[0] for name, values in {**SETTINGS, **PROPERTY}.items()}
    state.update(surface=surfaces[0], lights=0, back=False, turned=False)
    old = Window()
    for step in range(80):
        for _ in range(rng.integers(1, 3)):
            choices = {**SETTINGS, **PROPERTY, "surface": surfaces, "lights": range(len(LIGHTS)),
                       "back": (False, True), "turned": (False, True)}
            name = list(choices)[rng.integers(len(choices))]
            state[name] = choices[name][rng.integers(len(choices[name]))]
        apply(old, state)
        fresh = Window()
        apply(fresh, state)
        assert np.array_equal(old.draw(), fresh.draw()), (step, name, state)
        no_gl_errors(old)
        fresh.window.Finalize()


def test_points_and_normals_move():
    surface = square()
    for shading in SHADINGS:
        w = lit(shading, surface)
        assert np.allclose(w.at(0.5, 0.5), 1, rtol=1e-6)
        for i, p in enumerate(((-0.4, -0.4, 0), (0.4, -0.4, 0), (0.4, 0.4, 0), (-0.4, 0.4, 0))):
            surface.GetPoints().SetPoint(i, p)
        surface.GetPoints().Modified()
        picture = w.draw()
        assert w.at(0.5, 0.5, picture)[0] == 0 and np.allclose(w.at(0, 0, picture), 1, rtol=1e-6)
        if shading != "Flat":
            for i in range(4):
                surface.GetPointData().GetNormals().SetTuple3(i, math.sqrt(0.75), 0, 0.5)
            surface.GetPointData().GetNormals().Modified()
            surface.Modified()
            assert np.allclose(w.at(0, 0), 0.5, rtol=1e-6), shading
        surface = square()


def test_the_window_goes_and_comes_back():
    for shading in SHADINGS:
        w = lit(shading, surface_of(4))
        add(w.mapper.GetInputDataObject(0, 0).GetCellData(), "F", np.arange(16.0))
        w.actor.GetProperty().SetSpecular(0.5)
        for mode in (0, 1, 4):
            w.mapper.SetFieldMode(mode)
            w.mapper.SetFieldArrayName("F")
            before = w.draw()
            w.window.Finalize()
            assert np.array_equal(w.draw(), before), (shading, mode)
            w.renderer.ReleaseGraphicsResources(w.window)
            assert np.array_equal(w.draw(), before), (shading, mode)
            no_gl_errors(w)


def test_two_windows_share_a_mapper():
    """As ParaView does in two views of one source, in turns."""
    for shading in SHADINGS:
        first = lit(shading, surface_of(4), {"Position": (0.5, 0.5, 2), "Intensity": (9, 6, 3)})
        second = Window(mapper=first.mapper)
        second.renderer.GetActiveCamera().Azimuth(30)
        for mode in (0, 1, 4):
            first.mapper.SetFieldMode(mode)
            first.mapper.SetFieldArrayName("F")
            one, two = first.draw(), second.draw()
            assert one.max() > 0 and not np.array_equal(one, two)
            for _ in range(2):
                assert np.array_equal(first.draw(), one), (shading, mode)
                assert np.array_equal(second.draw(), two), (shading, mode)
            no_gl_errors(first)
            no_gl_errors(second)
        first.window.Finalize()
        assert np.array_equal(second.draw(), two)


def test_two_actors_share_a_mapper():
    w = lit()
    twin = vtkActor()
    twin.SetMapper(w.mapper)
    twin.SetScale(0.4)
    twin.SetPosition(0, 0, 1)
    twin.GetProperty().SetColor(0.25, 0.5, 0.75)
    w.renderer.AddActor(twin)
    for _ in range(2):
        picture = w.draw()
        assert np.allclose(w.at(0, 0, picture), (0.25, 0.5, 0.75), rtol=1e-6)
        assert np.allclose(w.at(0.6, 0.6, picture), 1, rtol=1e-6)
    assert w.mapper.GetNumberOfShaderBuilds() <= 2  # one text for both, or one each, but no more


def test_two_renderers_share_an_actor():
    """Side by side with cameras and lights of their own: the camera's light follows each."""
    w = lit("Phong", square(), dict(SUN, AttachedTo=2))
    other = Window(mapper=w.mapper)
    other.window.RemoveRenderer(other.renderer)
    other.renderer.RemoveActor(other.actor)
    other.renderer.AddActor(w.actor)
    w.renderer.SetViewport(0, 0, 0.5, 1)
    other.renderer.SetViewport(0.5, 0, 1, 1)
    other.renderer.GetActiveCamera().Azimuth(60)
    w.window.AddRenderer(other.renderer)
    w.window.SetSize(120, 60)
    for _ in range(2):
        w.window.Render()
        assert np.allclose(w.read()[30, 30, :3], 1, rtol=1e-6)
        assert np.allclose(other.read()[30, 30, :3], 0.5, rtol=1e-6)


def test_no_light_and_the_renderers_own():
    for shading in SHADINGS:
        w = Window()
        w.mapper.SetInputDataObject(square())
        getattr(w.mapper, "SetShadingTo" + shading)()
        w.renderer.AutomaticLightCreationOff()
        assert w.at(0, 0).tolist() == [0, 0, 0]
        w.mapper.SetLightData(lights())  # data without a light is no reason for a headlight
        assert w.at(0, 0).tolist() == [0, 0, 0]
        w.mapper.SetLightData(None)
        light = vtkLight()
        light.SetPosition(0, 0, 5)
        light.SetFocalPoint(0, 0, 0)
        light.SetIntensity(0.5)
        w.renderer.AddLight(light)
        assert np.allclose(w.at(0, 0), 0.5, rtol=1e-6), shading
        light.SwitchOff()
        assert w.at(0, 0).tolist() == [0, 0, 0]


def test_a_mapper_without_input_draws_nothing():
    w = Window()
    errors = Errors(w.mapper)
    assert w.draw().max() == 0
    w.mapper.SetInputDataObject(square())
    w.mapper.SetLightData(lights(SUN))
    assert np.allclose(w.at(0, 0), 1, rtol=1e-6)
    assert not errors.texts


def test_a_pass_of_its_own_for_each_renderer_of_a_mapper():
    w = lit()
    w.draw()
    w.renderer.SetPass(None)
    w.window.Render()
    w.target = vtkLinearFloatPass()
    w.renderer.SetPass(w.target)
    assert np.allclose(w.at(0, 0), 1, rtol=1e-6)


def test_mapper_dies_before_its_window():
    w = lit()
    w.draw()
    w.actor.SetMapper(vtkPhongGouraudMapper())
    w.mapper = None
    w.actor.GetMapper().SetInputDataObject(square())
    w.actor.GetMapper().SetLightData(lights(SUN))
    assert np.allclose(w.at(0, 0), 1, rtol=1e-6)
    no_gl_errors(w)


run(globals())
