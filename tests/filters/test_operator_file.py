# SPDX-License-Identifier: BSD-3-Clause
"""The radiosity filter's operator in a file: saved, loaded, refused."""
import os
import tempfile

import numpy as np
from checks import array, fails, run_all
from rooms import lamp, room, with_array
from vtkradiometry import vtkRadiosityFilter

DENSE, HIERARCHICAL, MONTE_CARLO = 1, 2, 3
SAVE, LOAD = 1, 2


def filter_of(data, name, mode, **properties):
    f = vtkRadiosityFilter()
    f.SetInputDataObject(0, data)
    light = lamp((1.0, 1.2, 2.0), 3000.0)
    f.AddLightsConnection(light.GetOutputPort())
    f.SetRelativeTolerance(0.1)
    f.SetOperatorFile(name)
    f.SetOperatorFileMode(mode)
    for key, value in properties.items():
        getattr(f, f"Set{key}")(value)
    return f


def values(f):
    f.Update()
    out = f.GetOutputDataObject(0)
    return (array(out.GetCellData(), "Irradiance").copy(),
            array(out.GetCellData(), "IrradianceError").copy(),
            array(out.GetFieldData(), "RadiometryMethod")[0])


def test_loaded_operator_gives_the_same():
    with tempfile.TemporaryDirectory() as folder:
        for method in (DENSE, HIERARCHICAL, MONTE_CARLO):
            name = os.path.join(folder, f"room{method}.operator")
            saved = values(filter_of(room(3.0, 3), name, SAVE, Method=method))
            assert os.path.getsize(name) > 1000
            assert os.listdir(folder) == [os.path.basename(name)] or method != DENSE
            loaded = values(filter_of(room(3.0, 3), name, LOAD, Method=method))
            assert "read from" in loaded[2], loaded[2]
            assert np.allclose(saved[0], loaded[0], rtol=1e-4)
            # Other lights and paint over the same exchange.
            painted = with_array(room(3.0, 3), "DiffuseReflectance", 0.3)
            f = filter_of(painted, name, LOAD)
            assert "read from" in values(f)[2]


def test_refused_where_it_does_not_belong():
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "room.operator")
        values(filter_of(room(3.0, 3), name, SAVE, Method=DENSE))
        fails(filter_of(room(3.0, 4), name, LOAD), "OperatorFile", "points")
        fails(filter_of(with_array(room(3.0, 3), "TwoSided", 1.0), name, LOAD), "OperatorFile", "sides")
        fails(filter_of(room(3.0, 3), name, LOAD, Method=MONTE_CARLO), "OperatorFile", "Dense")
        fails(filter_of(room(3.0, 3), name, LOAD, Refinement=2), "OperatorFile", "Refinement")
        with open(name, "r+b") as f:
            f.seek(2000)
            f.write(b"damage")
        fails(filter_of(room(3.0, 3), name, LOAD), "OperatorFile", "checksum")
        fails(filter_of(room(3.0, 3), os.path.join(folder, "none"), LOAD), "OperatorFile", "read")
        fails(filter_of(room(3.0, 3), "", LOAD), "OperatorFile", "name")
        fails(filter_of(room(3.0, 3), "/nowhere/x", SAVE, Method=DENSE), "OperatorFile", "written")


run_all(globals())
