# SPDX-License-Identifier: BSD-3-Clause
"""Translucent light in a float target: nothing is clamped; what order does and does not matter."""
import math

import numpy as np

from drawing import Window, add, lights, polydata, run, square
from vtkmodules.vtkRenderingCore import vtkActor
from vtkmodules.vtkRenderingOpenGL2 import (
    vtkCameraPass,
    vtkDualDepthPeelingPass,
    vtkLightsPass,
    vtkOpaquePass,
    vtkRenderPassCollection,
    vtkSequencePass,
    vtkTranslucentPass,
)
from vtkradiometry.vtkRadiometryRendering import vtkPhongGouraudMapper

SUN = {"LightType": 2, "Intensity": (math.pi,) * 3}


def layer(value, z, opacity):
    """A plane at z that shows the value, or is lit to it."""
    actor = vtkActor()
    mapper = vtkPhongGouraudMapper()
    surface = square(z=z)
    add(surface.GetCellData(), "F", [value])
    mapper.SetInputDataObject(surface)
    mapper.SetFieldModeToOn()
    mapper.SetFieldArrayName("F")
    actor.SetMapper(mapper)
    actor.GetProperty().SetOpacity(opacity)
    return actor


def show(*actors):
    w = Window()
    w.renderer.RemoveActor(w.actor)
    for actor in actors:
        w.renderer.AddActor(actor)
    return w


def over(background, *layers):
    """(value, opacity) from back to front."""
    color, alpha = background
    for value, opacity in layers:
        color = opacity * value + (1 - opacity) * color
        alpha = opacity + (1 - opacity) * alpha
    return color, alpha


def test_values_above_one_through_layers():
    w = show(layer(6.0, -1.0, 1.0), layer(3.0, 0.0, 0.5))
    assert w.at(0, 0).tolist() == [4.5] * 3
    w = show(layer(6e5, -1.0, 1.0), layer(4e-3, 0.0, 0.25), layer(2e4, 0.5, 0.5))
    color, alpha = over((6e5, 1.0), (4e-3, 0.25), (2e4, 0.5))
    pixel = w.draw()[30, 30]
    assert np.allclose(pixel[:3], color, rtol=1e-6) and pixel[3] == alpha


def test_over_nothing_the_colour_has_its_alpha_in_it():
    w = show(layer(8.0, 0.0, 0.25))
    assert np.allclose(w.draw()[30, 30], (2, 2, 2, 0.25), rtol=1e-6)


def test_opaque_before_translucent_in_any_order_of_actors():
    """The order of opaque actors never matters, nor whether they come before the translucent one."""
    for order in ((0, 1, 2), (2, 1, 0), (1, 2, 0)):
        actors = [layer(6.0, -1.0, 1.0), layer(2.0, -2.0, 1.0), layer(3.0, 0.0, 0.5)]
        assert show(*[actors[i] for i in order]).at(0, 0).tolist() == [4.5] * 3, order
    behind = show(layer(3.0, -1.5, 0.5), layer(6.0, -1.0, 1.0))  # hidden by the opaque one
    assert behind.at(0, 0).tolist() == [6.0] * 3


def test_translucent_actors_from_far_to_near_in_any_order():
    """What vtkLinearFloatPass promises: actors are sorted by the middle of their bounds."""
    far, middle, near = layer(5.0, -0.5, 0.25), layer(2.0, 0.0, 0.75), layer(3.0, 0.5, 0.5)
    expected = over((0, 0), (5, 0.25), (2, 0.75), (3, 0.5))
    for order in ((far, middle, near), (near, middle, far), (middle, near, far)):
        pixel = show(*order).draw()[30, 30]
        assert np.allclose(pixel[:3], expected[0], rtol=1e-6), pixel
        assert np.allclose(pixel[3], expected[1], rtol=1e-6)


def test_cells_of_one_surface_in_their_order():
    points, cells = [], []
    for i, z in enumerate((-0.5, 0.0, 0.5)):
        points += [(-0.8, -0.8, z), (0.8, -0.8, z), (0.8, 0.8, z), (-0.8, 0.8, z)]
        cells.append(range(4 * i, 4 * i + 4))
    surface = polydata(points, cells, [(0, 0, 1)] * 12)
    add(surface.GetCellData(), "DiffuseReflectance", [0.25, 0.5, 1.0])
    for shading in ("Flat", "Gouraud", "Phong"):
        w = Window()
        w.mapper.SetInputDataObject(surface)
        w.mapper.SetLightData(lights(dict(SUN, Intensity=(8 * math.pi,) * 3)))
        w.mapper.SetFieldModeToMaterials()
        getattr(w.mapper, "SetShadingTo" + shading)()
        w.actor.GetProperty().SetOpacity(0.5)
        color, alpha = over((0, 0), (2.0, 0.5), (4.0, 0.5), (8.0, 0.5))
        assert np.allclose(w.draw()[30, 30], (color, color, color, alpha), rtol=1e-6), shading


def test_depth_peeling_sorts_what_is_below_one():
    """VTK's own passes work with this mapper: any order of drawing, right order of depth. Their
    buffers are 8 bit, so values above 1 are not for them."""
    for order in ((0, 1, 2), (2, 0, 1), (1, 2, 0)):
        actors = [layer(0.8, -0.5, 0.5), layer(0.4, 0.0, 0.25), layer(1.0, 0.5, 0.5)]
        w = show(*[actors[i] for i in order])
        peeling = vtkDualDepthPeelingPass()
        peeling.SetTranslucentPass(vtkTranslucentPass())
        peeling.SetMaximumNumberOfPeels(8)
        passes = vtkRenderPassCollection()
        for part in (vtkLightsPass(), vtkOpaquePass(), peeling):
            passes.AddItem(part)
        sequence = vtkSequencePass()
        sequence.SetPasses(passes)
        camera = vtkCameraPass()
        camera.SetDelegatePass(sequence)
        w.target.SetDelegatePass(camera)
        expected = over((0, 0), (0.8, 0.5), (0.4, 0.25), (1.0, 0.5))[0]
        assert np.allclose(w.at(0, 0), expected, atol=3 / 255), (order, w.at(0, 0), expected)


run(globals())
