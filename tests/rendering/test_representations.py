# SPDX-License-Identifier: BSD-3-Clause
"""ParaView with the plugin: a surface as "Radiometric Surface", lit by shown lights, to the pixel."""
import math
import os

import numpy as np

from paraview_scene import (
    FOLDER,
    SIZE,
    check,
    expect,
    new_plane,
    new_view,
    picture,
    pixel,
    pv,
    radiance,
    run,
    show_lights,
    show_surface,
)


def test_lights_light_the_picture():
    view = new_view()
    plane = new_plane()
    surface = show_surface(plane, view)
    lamp = pv.PointLight(Position=[0, 0, 2], Intensity=0.6 * math.pi * 4)
    lights = show_lights(lamp, view)
    image = picture(view)
    for x, y in ((0.005, 0.005), (0.505, 0.005), (-0.705, 0.805)):
        expect(image, x, y, radiance(0.6 * math.pi * 4, 2, x, y))

    # A second source adds; hiding takes its light away.
    red = pv.DirectionalLight(Direction=[0, 0, -1], Intensity=0.25 * math.pi, Color=[1, 0, 0])
    red_lights = show_lights(red, view)
    image = picture(view)
    base = radiance(0.6 * math.pi * 4, 2, 0.5, 0.5)
    expect(image, 0.5, 0.5, (base + 0.25, base, base), 2)
    pv.Hide(red, view)
    expect(picture(view), 0.5, 0.5, base)

    # Lights are data: moving the source moves the light.
    lamp.Position = [0, 0, 1]
    expect(picture(view), 0.5, 0.5, radiance(0.6 * math.pi * 4, 1, 0.5, 0.5), 2)
    lamp.Position = [0, 0, 2]

    # Illuminate off, or all lights hidden: the view's own lights.
    lights.Illuminate = 0
    own = picture(view)
    check(np.abs(own - image).max() > 20, "the view's own lights should look different")
    lights.Illuminate = 1
    pv.Hide(lamp, view)
    check(np.array_equal(picture(view), own))
    pv.Show(lamp, view)
    expect(picture(view), 0.5, 0.5, base)

    # Exposure, models, shading.
    surface.LightBrightness = 0.5
    expect(picture(view), 0.5, 0.5, base / 2)
    surface.LightBrightness = 1.0 / math.pi
    surface.ReflectionModel = "Blinn-Phong (legacy)"
    expect(picture(view), 0.5, 0.5, base)
    surface.ReflectionModel = "Physical"
    surface.LightBrightness = 1.0
    surface.Shading = "Flat"  # the middle of the cell [0.36, 0.54]^2
    expect(picture(view), 0.5, 0.5, radiance(0.6 * math.pi * 4, 2, 0.45, 0.45))
    for smooth in ("Gouraud", "Phong", "Auto"):
        surface.Shading = smooth
        expect(picture(view), 0.5, 0.5, base, 2 if smooth == "Gouraud" else 1)

    # A glyph is drawn where the light is.
    dark = picture(view)
    lamp.Position = [-0.4, 0, 2]
    without = picture(view)
    lights.ShowGlyphs = 1
    lights.LightGlyphSize = 0.5
    drawn = np.argwhere(np.abs(picture(view) - without).sum(axis=2) > 0)
    check(len(drawn) > 50, "no glyph")
    middle = drawn.mean(axis=0)
    check(abs(middle[1] - pixel(-0.4, 0)[1]) < 4 and abs(middle[0] - pixel(0, 0)[0]) < 4, middle)
    check(dark.shape == without.shape)
    red_lights.Visibility = 0


def test_switching_representations():
    view = new_view()
    plane = new_plane()
    surface = show_surface(plane, view)
    show_lights(pv.PointLight(Position=[0.3, 0, 1], Intensity=1.0), view)
    first = picture(view)
    for other in ("Surface", "Wireframe", "Points", "Outline", "Surface With Edges"):
        surface.Representation = other
        check(np.abs(picture(view) - first).max() > 10, other)
        surface.Representation = "Radiometric Surface"
        check(np.array_equal(picture(view), first), other)


def test_fields():
    view = new_view()
    plane = new_plane(2)
    cells = pv.ProgrammableFilter(Input=plane, CopyArrays=1)
    cells.Script = """import numpy
output.CellData.append(numpy.array([0.1, 0.4, 0.8, 7.0]), "Radiosity")"""
    surface = show_surface(cells, view)
    surface.FieldDisplay = "Field as light"
    surface.FieldArray = ["CELLS", "Radiosity"]
    image = picture(view)
    for cell, value in enumerate((0.1, 0.4, 0.8, 7.0)):
        expect(image, -0.45 + 0.9 * (cell % 2), -0.45 + 0.9 * (cell // 2), (value,) * 3, 0.51)
    surface.FieldScale = 0.1
    expect(picture(view), 0.45, 0.45, (0.7,) * 3, 0.51)
    surface.FieldDisplay = "Normals"
    expect(picture(view), 0.45, 0.45, (0, 0, 1), 0.51)

    cells.Script = """import numpy
output.CellData.append(numpy.array([0.2, 0.4, 0.6, 0.8]), "DiffuseReflectance")"""
    surface.FieldDisplay = "Lit by the lights"  # with the materials of the data, by default
    surface.FieldScale = 1.0
    sun = pv.DirectionalLight(Direction=[0, 0, -1], Intensity=math.pi)
    show_lights(sun, view)
    image = picture(view)
    for cell, value in enumerate((0.2, 0.4, 0.6, 0.8)):
        expect(image, -0.45 + 0.9 * (cell % 2), -0.45 + 0.9 * (cell // 2), (value,) * 3, 0.51)
    pv.Hide(sun, view)

    points = pv.Calculator(Input=plane, AttributeType="Point Data", ResultArrayName="Radiance",
                           Function="0.5 + coordsX/2")
    pv.Hide(cells, view)
    surface = show_surface(points, view)
    surface.FieldArray = ["POINTS", "Radiance"]
    surface.FieldDisplay = "Field as light"
    image = picture(view)
    for x in (-0.805, -0.305, 0.605):
        expect(image, x, 0.1, (0.5 + x / 2,) * 3, 1.0)


def test_other_kinds_of_data():
    wavelet = pv.Wavelet(WholeExtent=[-1, 1, -1, 1, -1, 1])  # a box of 2 x 2 x 2
    kinds = {
        "uniform": wavelet,
        "structured": pv.Transform(Input=wavelet),
        "unstructured": pv.AppendDatasets(Input=[wavelet]),
        "composite": pv.GroupDatasets(Input=[new_plane(), pv.AppendDatasets(Input=[wavelet])]),
    }
    for kind, source in kinds.items():
        view = new_view()
        view.CameraParallelScale = 2.0
        show_surface(source, view)
        show_lights(pv.DirectionalLight(Direction=[0, 0, -1], Intensity=0.5 * math.pi), view)
        image = picture(view, kind)
        expect(image, 0.1, 0.1, (0.5,) * 3)
        expect(image, 0.9, 0.9, (0, 0, 0))
        pv.Delete(view)


def test_selection():
    view = new_view()
    plane = new_plane(4)
    show_surface(plane, view)
    pv.Render(view)
    pv.SelectSurfaceCells(Rectangle=[SIZE // 2 + 5, SIZE // 2 + 5, SIZE // 2 + 15, SIZE // 2 + 15],
                          View=view)
    extract = pv.ExtractSelection(Input=plane)
    extract.UpdatePipeline()
    check(extract.GetDataInformation().GetNumberOfCells() == 1)
    check(np.abs(picture(view)).max() > 0)
    pv.ClearSelection(plane)


def test_state():
    pv.ResetSession()
    view = new_view()
    plane = new_plane()
    surface = show_surface(plane, view)
    surface.Shading = "Flat"
    surface.ReflectionModel = "Phong (legacy)"
    surface.LightBrightness = 0.75
    surface.Specular = 0.5
    lights = show_lights(pv.SpotLight(Position=[0.2, 0.1, 1], Direction=[0, 0, -1], Cutoff=35,
                                      Intensity=1.0), view, 0.3)
    lights.Illuminate = 1
    before = picture(view)
    check(before.max() > 100 and before.min() == 0)
    state = os.path.join(FOLDER, "state.pvsm")
    pv.SaveState(state)
    pv.ResetSession()
    pv.LoadState(state)
    view = next(v for v in pv.GetViews()
                if any(getattr(r, "Representation", "") == "Radiometric Lights"
                       and r.LightGlyphSize == 0.3 for r in v.Representations))
    surface = next(r for r in view.Representations
                   if getattr(r, "Representation", "") == "Radiometric Surface")
    check(surface.Shading == "Flat" and surface.ReflectionModel == "Phong (legacy)",
          surface.Shading, surface.ReflectionModel)
    check(surface.LightBrightness == 0.75)
    check(np.array_equal(picture(view), before))


def test_effects_are_switched_and_explained():
    view = new_view()
    surface = show_surface(new_plane(), view)
    surface.Specular = 0.5
    surface.SpecularPower = 5.0
    lamp = pv.DirectionalLight(Direction=[0, 0, -1], Intensity=0.3 * math.pi)
    show_lights(lamp, view)
    shining = picture(view)
    surface.SMProxy.UpdatePropertyInformation()
    check("Specular is simulated" in surface.EffectsExplained, surface.EffectsExplained)
    surface.SpecularEffect = "Off"
    matte = picture(view)
    expect(matte, 0.0, 0.0, 0.3)
    check((shining - matte).max() > 50, "the highlight should be gone")
    surface.SMProxy.UpdatePropertyInformation()
    check("Specular is left out: switched off" in surface.EffectsExplained, surface.EffectsExplained)
    surface.SpecularEffect = "As the scene calls for"
    check(np.array_equal(picture(view), shining))
    surface.EffectTolerance = 10.0
    check(picture(view).max() == 0, "all of it is less than 10")
    surface.SMProxy.UpdatePropertyInformation()
    check("DirectionalLights is dropped" in surface.EffectsExplained, surface.EffectsExplained)
    surface.EffectTolerance = 0.0
    for name in ("Ambient", "TwoSided", "LocalViewer", "Translucency", "Emission", "SpotShape",
                 "Attenuation", "Occlusion"):
        setattr(surface, name + "Effect", "Off")
        check(np.array_equal(picture(view), shining), name)  # nothing of the kind is seen here


run(globals())
