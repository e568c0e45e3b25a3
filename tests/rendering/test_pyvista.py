# SPDX-License-Identifier: BSD-3-Clause
"""The filters and the mapper inside PyVista, where it is installed (Debian 13: python3-pyvista)."""
import math
import sys

import display

try:
    import pyvista
except ImportError:
    print("no PyVista here: skipped")
    sys.exit(display.SKIPPED)

display.ensure()

import numpy as np  # noqa: E402
from vtkradiometry import (  # noqa: E402
    vtkIrradianceFilter,
    vtkPhongGouraudMapper,
    vtkPointLightSource,
)

SIZE = 96
INTENSITY = 100.0  # W/sr


def irradiance():
    """A square of 2 m by 2 m, 4 by 4 cells, under a point light 1 m above its centre."""
    light = vtkPointLightSource()
    light.SetPosition(0, 0, 1)
    light.SetIntensity(INTENSITY)
    plane = pyvista.Plane(i_size=2, j_size=2, i_resolution=4, j_resolution=4)
    filter_ = vtkIrradianceFilter()
    filter_.SetInputDataObject(0, plane)
    filter_.AddInputConnection(1, light.GetOutputPort())
    filter_.Update()
    return pyvista.wrap(filter_.GetOutputDataObject(0))


def test_the_flux_is_that_of_a_sixth_of_the_sphere(mesh):
    flux = mesh.cell_data["Irradiance"] @ mesh.compute_cell_sizes().cell_data["Area"]
    assert math.isclose(flux, INTENSITY * 4 * math.pi / 6, rel_tol=1e-9), flux


def test_the_mapper_draws_the_field(mesh):
    values = np.asarray(mesh.cell_data["Irradiance"])
    scale = 0.8 / values.max()
    plotter = pyvista.Plotter(off_screen=True, window_size=(SIZE, SIZE))
    plotter.set_background("black")
    actor = plotter.add_mesh(mesh, show_scalar_bar=False)
    mapper = vtkPhongGouraudMapper()
    mapper.SetInputDataObject(mesh)
    mapper.ScalarVisibilityOff()
    mapper.SetFieldModeToOn()
    mapper.SetFieldArrayName("Irradiance")
    mapper.SetFieldScale(scale)
    actor.SetMapper(mapper)
    plotter.view_xy()
    plotter.enable_parallel_projection()
    plotter.camera.parallel_scale = 1.0
    plotter.show(auto_close=False)
    picture = plotter.screenshot(return_img=True)[::-1]
    plotter.close()
    for center, value in zip(mesh.cell_centers().points, values):
        column, row = ((center[:2] + 1) / 2 * SIZE).astype(int)
        assert np.all(np.abs(picture[row, column] - 255 * scale * value) <= 1), (
            center, picture[row, column], 255 * scale * value)
    assert values.max() > 1.5 * values.min()


result = irradiance()
test_the_flux_is_that_of_a_sixth_of_the_sphere(result)
test_the_mapper_draws_the_field(result)
