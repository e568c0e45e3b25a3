# SPDX-License-Identifier: BSD-3-Clause
"""Radiance of a surface in parts, beside the same of one process. Run by test_ranks_radiance.py in
pvbatch --sym: every rank goes through all checks."""
import numpy as np
from checks import Errors, array
from rank_parts import Alone, in_ranks, rank, room, set_array, size
from vtkradiometry import vtkPointLightSource, vtkRadianceFilter

ROOM = room(2)
CELLS = len(ROOM.polygons)
ROOM.arrays["SpecularReflectance"] = [0.15 * (c % 3 == 0) for c in range(CELLS)]
ROOM.arrays["Shininess"] = [5.0 + c for c in range(CELLS)]
MIXED = np.array([(7 * c + c // 5) % size() for c in range(CELLS)])  # parts that interlock
NAMES = ("Radiance", "RadianceError", "SolidAngle", "ProjectedSolidAngle", "ImageIrradiance", "Facing")


def radiance(data, alone=False):
    lamp = vtkPointLightSource()
    lamp.SetPosition(0.4, 0.3, 0.6)
    lamp.SetIntensity(5.0)
    f = vtkRadianceFilter()
    f.SetInputData(data)
    f.AddLightsConnection(lamp.GetOutputPort())
    f.SetRelativeTolerance(0.05)
    return Alone(f) if alone else f


def check_parts_give_the_bytes_of_one_process():
    for given in (False, True):
        if given:
            ROOM.arrays["Radiosity"] = [1.0 + c % 4 for c in range(CELLS)]
        whole = radiance(ROOM.whole(), alone=True)
        whole.Update()
        part, cells = ROOM.part(MIXED, rank())
        f = radiance(part)
        f.Update()
        for name in NAMES:
            mine = array(f.GetOutputDataObject(0).GetCellData(), name)
            all_ = array(whole.GetOutputDataObject(0).GetCellData(), name)
            assert all_.any()
            assert mine.tobytes() == all_[cells].tobytes(), (given, name)
        assert (f.GetOutputDataObject(1).GetNumberOfRows() > 0) == (rank() == 0)


def check_errors_end_all_ranks():
    part, _ = ROOM.part(MIXED, rank())
    if rank() == size() - 1:
        set_array(part.GetCellData(), "Radiosity", np.full(part.GetNumberOfCells(), -1.0))
    f = radiance(part)
    errors = Errors(f)
    f.Update()
    assert len(errors.messages) == 1 and "Radiosity" in errors.messages[0], errors.messages
    assert f.GetOutputDataObject(0).GetNumberOfCells() == 0


in_ranks(globals())
