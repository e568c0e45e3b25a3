# SPDX-License-Identifier: BSD-3-Clause
"""View factors of a surface in parts, beside the same of one process. Run by
test_ranks_view_factors.py in pvbatch --sym: every rank goes through all checks."""
import numpy as np
from checks import Errors, array
from rank_parts import Alone, in_ranks, rank, room, set_array, size
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkradiometry import vtkViewFactorFilter

ROOM = room(2)
CELLS = len(ROOM.polygons)
ROOM.arrays["Patch"] = [c // 3 for c in range(CELLS)]
MIXED = np.array([(7 * c + c // 5) % size() for c in range(CELLS)])  # parts that interlock
DENSE, HIERARCHICAL, MONTE_CARLO = 1, 2, 3


def view_factors(data, alone=False, **properties):
    f = vtkViewFactorFilter()
    f.SetInputData(data)
    for name, value in {"RelativeTolerance": 0.05, "AbsoluteTolerance": 2e-3, **properties}.items():
        getattr(f, "Set" + name)(value)
    return Alone(f) if alone else f


def rows(f):
    f.Update()
    t = f.GetOutputDataObject(1)
    if t.GetNumberOfColumns() == 0:
        return None
    return np.array([vtk_to_numpy(t.GetColumnByName(n))
                     for n in ("From", "To", "ViewFactor", "ViewFactorError")])


def check_parts_give_the_bytes_of_one_process():
    for patches in ("Patch", ""):
        for method in (DENSE, HIERARCHICAL, MONTE_CARLO):
            whole = view_factors(ROOM.whole(), alone=True, PatchArray=patches, Method=method)
            expected = rows(whole)
            assert expected.shape[1] > 100
            part, cells = ROOM.part(MIXED, rank())
            f = view_factors(part, PatchArray=patches, Method=method)
            table = rows(f)
            assert (table is not None) == (rank() == 0)
            if rank() == 0:
                assert table.tobytes() == expected.tobytes(), (patches, method)
            for name in ("ViewFactorSum", "SkyViewFactor", "SkyViewFactorError", "ClosureDefect"):
                mine = array(f.GetOutputDataObject(0).GetCellData(), name)
                all_ = array(whole.GetOutputDataObject(0).GetCellData(), name)
                assert mine.tobytes() == all_[cells].tobytes(), (patches, method, name)


def check_errors_end_all_ranks():
    part, _ = ROOM.part(MIXED, rank())
    if rank() == size() - 1:
        set_array(part.GetCellData(), "Patch", np.full(part.GetNumberOfCells(), 0.5))
    f = view_factors(part, PatchArray="Patch")
    errors = Errors(f)
    f.Update()
    assert len(errors.messages) == 1 and "Patch" in errors.messages[0], errors.messages
    assert f.GetOutputDataObject(0).GetNumberOfCells() == 0


in_ranks(globals())
