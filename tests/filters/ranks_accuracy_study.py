# SPDX-License-Identifier: BSD-3-Clause
"""Accuracy Study on surfaces in parts, beside the same of one process. Run by
test_ranks_accuracy_study.py in pvbatch --sym: every rank goes through all checks."""
import numpy as np
from checks import Errors, array, simulation, strings
from rank_parts import in_ranks, rank, room, set_array, size
from vtkradiometry import vtkAccuracyStudy, vtkAreaLightSource, vtkIrradianceFilter

ROOM = room(4)
CELLS = len(ROOM.polygons)
MIXED = np.array([(7 * c + c // 5) % size() for c in range(CELLS)])  # parts that interlock
PANEL = vtkAreaLightSource()
PANEL.SetPosition(0.2, -0.3, 2.8)
PANEL.SetDirection(0.0, 0.0, -1.0)
PANEL.SetIntensity(5.0)


def part():
    return ROOM.part(MIXED, rank())[0]


def study(data, alone=False, **properties):
    f = simulation(vtkIrradianceFilter, data, PANEL, NumberOfThreads=1)
    s = vtkAccuracyStudy()
    s.SetFilter(f)
    s.ClearTolerances()
    for tolerance in (0.2, 0.02):
        s.AddTolerance(tolerance)
    for name, value in properties.items():
        getattr(s, "Set" + name)(value)
    if alone:
        f.SetController(None)
        s.SetController(None)
    return s


def column(s, name, port=0):
    return array(s.GetOutputDataObject(port).GetRowData(), name)


def check_same_figures():
    together, alone = study(part(), FloatComparison=True), study(
        ROOM.whole(), alone=True, FloatComparison=True)
    together.Update()
    alone.Update()
    assert together.GetOutputDataObject(2).GetNumberOfCells() == part().GetNumberOfCells()
    if rank() > 0:
        assert all(together.GetOutputDataObject(p).GetNumberOfRows() == 0 for p in (0, 1, 3))
        return
    for name in ("EstimatedError", "AbsoluteError", "GreatestError", "TrueError",
                 "TrueAbsoluteError", "Coverage", "Sharpness"):
        one, other = column(alone, name), column(together, name)
        assert len(one) == 2 and np.allclose(one, other, rtol=1e-9, atol=1e-15), (name, one, other)
    figures = strings(together.GetOutputDataObject(1), "Figure")
    values = column(together, "Value", 1)
    median = values[figures.index("Float input: median relative difference")]
    assert 0.0 < median < 1e-5, median


def check_reference():
    """Parts of a reference in the same places; one that only the first rank finds wrong."""
    s = study(part())
    given = part()
    set_array(given.GetCellData(), "Irradiance", np.full(given.GetNumberOfCells(), 1.0))
    s.SetReferenceData(given)
    s.Update()
    if rank() == 0:
        assert (column(s, "TrueError") > 0.0).all() and (column(s, "Coverage") < 0.5).all()
    s = study(part(), Array="Nonsense")
    errors = Errors(s)
    s.Update()
    assert len(errors.messages) == 1 and "Nonsense" in errors.messages[0], errors.messages


def check_abort_of_one_rank():
    s = study(part())

    def stop(caller, _event):
        if rank() == size() - 1:
            caller.SetAbortExecute(1)

    s.AddObserver("ProgressEvent", stop)
    errors = Errors(s)
    s.Update()
    assert not errors.messages, errors.messages
    assert all(s.GetOutputDataObject(p).GetNumberOfElements(0) == 0 for p in range(4))


in_ranks(globals())
