# SPDX-License-Identifier: BSD-3-Clause
"""LightVisibility: the share of each light that arrives, as an array, with the names of the lights."""
import numpy as np
import vtkmodules.all as vtk
from checks import array, cell_values, close, fails, run_all, simulation, square, sun
from vtkradiometry import (vtkAreaLightSource, vtkIrradianceFilter, vtkPointLightSource,
                           vtkRadiosityFilter)


def lid(x):
    """Blocks light over the world left of x, one above the floor."""
    source = vtk.vtkPlaneSource()
    source.SetOrigin(-9, -9, 1)
    source.SetPoint1(x, -9, 1)
    source.SetPoint2(-9, 9, 1)
    source.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
    return source


def lamp(x, y, z):
    source = vtkPointLightSource()
    source.SetPosition(x, y, z)
    source.SetIntensity(5.0)
    return source


def panel():
    source = vtkAreaLightSource()
    source.SetPosition(0.5, 0.5, 0.8)
    source.SetDirection(0, 0, -1)
    source.SetIntensity(2.0)
    return source


def run(kind=vtkIrradianceFilter, data=None, lights=None, **properties):
    f = simulation(kind, data or square(4, 4.0), *(lights or [sun((0, 0, -1), 2.0)]),
                   LightVisibility=True, **properties)
    above = lid(0.5)
    f.AddOccludersConnection(above.GetOutputPort())
    f.Update()
    return f


def test_cells_half_in_shadow_have_half_of_the_sun():
    # Cells of side 1 from -2 to 2; the lid ends at 0.5, the sun stands above.
    for kind in (vtkIrradianceFilter, vtkRadiosityFilter):
        f = run(kind)
        got = cell_values(f, "LightVisibility")
        assert got.dtype == np.float32
        expected = np.tile([0.0, 0.0, 0.5, 1.0], 4)
        close(got, expected, 1e-7)
        assert (got[expected == 1.0] == 1.0).all() and (got[expected == 0.0] == 0.0).all()
        units = array(f.GetOutputDataObject(0).GetFieldData(), "RadiometryUnits")
        assert "LightVisibility [1]" in units


def test_the_lights_are_named_in_the_order_of_their_inputs():
    lit = lamp(0, 0, 3)
    lit.Update()
    array(lit.GetOutput().GetPointData(), "LightEnabled")[:] = 0
    off = vtk.vtkTrivialProducer()
    off.SetOutput(lit.GetOutput())
    lights = [panel(), sun((1, 0, -1), 2.0), off, lamp(0.7, 0.2, 0.5)]
    f = run(lights=lights)
    out = f.GetOutputDataObject(0)
    shares = array(out.GetCellData(), "LightVisibility")
    assert shares.shape == (16, 4)
    keys = array(out.GetFieldData(), "LightVisibilityLights")
    s = 0.5 ** 0.5
    close(keys[0], [3, *np.array(panel_corner()), 0, 0, 0])
    close(keys[1], [2, 0, 0, 0, s, 0, -s], 1e-12)
    close(keys[2][:4], [0, 0, 0, 3])
    close(keys[3][:4], [0, 0.7, 0.2, 0.5])
    close(shares[:, 2], np.zeros(16))  # disabled
    close(shares[:, 3], np.ones(16))  # below the lid
    assert (shares[:, 0] == 1.0).all()
    close(shares[:4, 1], [0.0, 0.0, 0.0, 0.5], 1e-6)  # the shadow ends at 1.5


def panel_corner():
    source = panel()
    source.Update()
    return source.GetOutput().GetPoint(0)


def test_points_backs_and_pieces():
    f = run(SampleLocation=1, lights=[sun((0, 0, -1), 2.0), sun((0, 0, 1), 2.0)], TwoSided=True)
    data = f.GetOutputDataObject(0)
    x = np.array([data.GetPoint(i)[0] for i in range(data.GetNumberOfPoints())])
    front = array(data.GetPointData(), "LightVisibility")
    back = array(data.GetPointData(), "LightVisibilityBack")
    close(front[:, 0], np.where(x < 0.5, 0.0, 1.0))
    close(front[:, 1], np.zeros(x.size))
    close(back[:, 0], np.zeros(x.size))
    close(back[:, 1], np.ones(x.size))
    f = run(RefineShadowBoundaries=True)
    shares = cell_values(f, "LightVisibility")
    assert set(shares) == {np.float32(0.0), np.float32(1.0)}
    ids = cell_values(f, "OriginalCellIds")
    assert shares.size == ids.size > 16


def test_blocks_have_their_own():
    tree = vtk.vtkMultiBlockDataSet()
    tree.SetBlock(0, square(2, 1.0, (-1, 0, 0)))
    tree.SetBlock(1, square(1, 1.0, (1.5, 0, 0)))
    f = run(data=tree)
    out = f.GetOutputDataObject(0)
    close(array(out.GetBlock(0).GetCellData(), "LightVisibility"), np.zeros(4))
    close(array(out.GetBlock(1).GetCellData(), "LightVisibility"), [1.0])


def test_off_writes_nothing_and_changes_nothing():
    on = run(lights=[sun((1, 0, -1), 2.0), panel()])
    off = run(lights=[sun((1, 0, -1), 2.0), panel()])
    off.SetLightVisibility(False)
    assert cell_values(on, "Irradiance").tobytes() == cell_values(off, "Irradiance").tobytes()
    cells = off.GetOutputDataObject(0).GetCellData()
    assert not cells.HasArray("LightVisibility")
    assert not off.GetOutputDataObject(0).GetFieldData().HasArray("LightVisibilityLights")


def test_too_many_lights():
    f = simulation(vtkIrradianceFilter, square(), *[lamp(0, 0, 1 + i) for i in range(65)],
                   LightVisibility=True)
    fails(f, "LightVisibility", "65 lights", "at most 64")
    f.SetLightVisibility(False)
    assert cell_values(f, "Irradiance")[0] > 0.0


run_all(globals())
