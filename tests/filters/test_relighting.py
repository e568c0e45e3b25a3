# SPDX-License-Identifier: BSD-3-Clause
"""A radiosity filter in a pipeline whose lights are animated: the exchange is computed once."""
import math

import numpy as np
from checks import array, run_all
from rooms import faces, lamp, room, with_array
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkradiometry import vtkRadiosityFilter


def furnished(n=4, lift=0.0):
    """A room of 3 m with a low table in it."""
    table = faces([((0.8, 0.8, 0.7 + lift), (1.2, 0, 0), (0, 1.0, 0)),
                   ((0.8, 0.8, 0.65 + lift), (0, 1.0, 0), (1.2, 0, 0))], 3)
    both = vtkAppendPolyData()
    both.AddInputData(room(3.0, n))
    both.AddInputData(table)
    both.Update()
    return both.GetOutput()


def filter_of(data, light, tolerance=0.3, **properties):
    f = vtkRadiosityFilter()
    f.SetInputDataObject(0, data)
    f.AddLightsConnection(light.GetOutputPort())
    f.SetRelativeTolerance(tolerance)
    for name, value in properties.items():
        getattr(f, f"Set{name}")(value)
    return f


def result(f):
    """Values, errors and how they were exchanged."""
    f.Update()
    out = f.GetOutputDataObject(0)
    return (array(out.GetCellData(), "Irradiance").copy(),
            array(out.GetCellData(), "IrradianceError").copy(),
            array(out.GetFieldData(), "RadiometryMethod")[0])


def test_animated_light_uses_what_was_kept():
    data = furnished()
    light = lamp((1.5, 1.5, 2.6), 3000.0)
    animated = filter_of(data, light, 0.1)
    result(animated)
    assert animated.GetCacheMemory() > 0.0
    for step in range(4):
        angle = 0.5 * math.pi * step
        position = (1.5 + math.cos(angle), 1.5 + math.sin(angle), 2.2)
        light.SetPosition(position)
        values, errors, method = result(animated)
        assert "kept from the run before" in method, method
        fresh, fresh_errors, method = result(filter_of(data, lamp(position, 3000.0), 0.1))
        assert "kept" not in method, method
        inside = np.abs(values - fresh) <= errors + fresh_errors
        assert inside.mean() >= 0.95, inside.mean()


def test_dimmed_light_and_painted_walls():
    data = furnished()
    light = lamp((1.0, 1.2, 2.5), 3000.0)
    f = filter_of(data, light)
    bright = result(f)[0]
    light.SetIntensity(1500.0)
    dim, _, method = result(f)
    assert "kept" in method
    assert np.allclose(2.0 * dim, bright, rtol=1e-3), np.abs(2.0 * dim / bright - 1.0).max()
    with_array(data, "DiffuseReflectance", 0.2)
    data.Modified()
    dark, _, method = result(f)
    assert "kept" in method
    assert dark.mean() < 0.8 * dim.mean()


def check_dropped(f, changed):
    """What f says now is what a new filter says, to the last bit."""
    values, errors, method = result(f)
    assert "kept" not in method, method
    fresh = result(changed)
    assert np.array_equal(values, fresh[0]) and np.array_equal(errors, fresh[1])


def test_changed_geometry_is_seen():
    light = lamp((1.0, 1.2, 2.5), 3000.0)
    f = filter_of(furnished(), light)
    result(f)
    f.SetInputDataObject(0, furnished(lift=1e-3))
    check_dropped(f, filter_of(furnished(lift=1e-3), light))


def test_changed_points_in_place_are_seen():
    light = lamp((1.0, 1.2, 2.5), 3000.0)
    data = furnished()
    f = filter_of(data, light)
    result(f)
    data.GetPoints().SetPoint(0, 0.01, 0.0, 0.0)
    data.GetPoints().Modified()
    check_dropped(f, filter_of(data, light))


def test_changed_transmittance_and_sides_are_seen():
    light = lamp((1.0, 1.2, 2.5), 3000.0)
    for name, value in (("Transmittance", 0.4), ("TwoSided", 1)):
        data = furnished()
        f = filter_of(data, light)
        result(f)
        changed = np.zeros(data.GetNumberOfCells())
        changed[-18:] = value
        with_array(data, name, changed)
        data.Modified()
        check_dropped(f, filter_of(data, light))
    f = filter_of(furnished(), light)
    result(f)
    f.SetTwoSided(True)
    check_dropped(f, filter_of(furnished(), light, TwoSided=True))


def test_changed_occluders_are_seen():
    light = lamp((1.0, 1.2, 2.5), 3000.0)

    def occluder(height):
        return faces([((0.5, 0.5, height), (0.5, 0, 0), (0, 0.5, 0))], 1)

    f = filter_of(room(3.0, 3), light)
    f.AddOccludersData(occluder(1.0))
    result(f)
    f.RemoveOccludersConnections()
    f.AddOccludersData(occluder(1.1))
    fresh = filter_of(room(3.0, 3), light)
    fresh.AddOccludersData(occluder(1.1))
    check_dropped(f, fresh)


def test_nothing_is_kept_unless_asked():
    light = lamp((1.0, 1.2, 2.5), 3000.0)
    f = filter_of(furnished(), light, CacheOperator=False)
    result(f)
    assert f.GetCacheMemory() == 0.0
    light.SetPosition(2.0, 1.2, 2.5)
    check_dropped(f, filter_of(furnished(), light))
    f.CacheOperatorOn()
    f.Modified()
    result(f)
    assert f.GetCacheMemory() > 0.0
    f.ReleaseCache()
    assert f.GetCacheMemory() == 0.0
    f.Modified()
    check_dropped(f, filter_of(furnished(), light))


run_all(globals())
