# SPDX-License-Identifier: BSD-3-Clause
"""Accuracy Study: exact scenes, references, lists, and what may go wrong."""
import numpy as np
from checks import Errors, array, close, fails, run_all, simulation, square, strings
from rooms import room
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkMath
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkElevationFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkradiometry import (vtkAccuracyStudy, vtkAreaLightSource, vtkIrradianceFilter,
                           vtkPointLightSource, vtkRadianceFilter, vtkRadiosityFilter,
                           vtkViewFactorFilter, vtkWorkPlaneSource)

UNKNOWN = -1.0


def lamp(z=1.0):
    light = vtkPointLightSource()
    light.SetPosition(0.1, 0.2, z)
    light.SetIntensity(3.0)
    return light


def panel():
    """An area light over a screen: penumbras, so values have errors."""
    light = vtkAreaLightSource()
    light.SetPosition(0.1, 0.2, 1.5)
    light.SetDirection(0.0, 0.0, -1.0)
    light.SetIntensity(5.0)
    return light


PANEL, LAMP = panel(), lamp()


def open_plane(**properties):
    return simulation(vtkIrradianceFilter, square(4), LAMP, **properties)


def shaded(resolution=6, data=None, **properties):
    f = simulation(vtkIrradianceFilter, data or square(resolution), PANEL, **properties)
    f.AddOccludersData(square(1, 0.7, (0.0, 0.1, 0.6)))
    return f


def study(f=None, tolerances=(0.2, 0.05, 0.01), **properties):
    s = vtkAccuracyStudy()
    if f is not None:
        s.SetInputConnection(f.GetOutputPort())
    if tolerances is not None:
        s.ClearTolerances()
        for tolerance in tolerances:
            s.AddTolerance(tolerance)
    for name, value in properties.items():
        getattr(s, "Set" + name)(value)
    return s


def column(s, name, port=0):
    table = s.GetOutputDataObject(port)
    found = table.GetColumnByName(name)
    assert found is not None, f"no column {name}"
    if found.IsA("vtkStringArray"):
        return strings(table, name)
    return array(table.GetRowData(), name)


def rows(s, port=0):
    return s.GetOutputDataObject(port).GetNumberOfRows()


def summary(s):
    """{figure: (value, relation, note)}"""
    return dict(zip(column(s, "Figure", 1),
                    zip(column(s, "Value", 1), column(s, "Relation", 1), column(s, "Note", 1))))


def check_finite(s):
    for port in (0, 1, 3):
        table = s.GetOutputDataObject(port)
        for k in range(table.GetNumberOfColumns()):
            if not table.GetColumn(k).IsA("vtkStringArray"):
                assert np.isfinite(array(table.GetRowData(), table.GetColumnName(k))).all()


def exact_plane():
    """The flux I Omega of each cell over its area, from corner solid angles (Van Oosterom)."""
    data = square(4)
    values = []
    for c in range(data.GetNumberOfCells()):
        corners = [np.array(data.GetCell(c).GetPoints().GetPoint(k)) - (0.1, 0.2, 1.0)
                   for k in range(4)]
        omega = 0.0
        for a, b, d in ((0, 1, 2), (0, 2, 3)):
            u, v, w = corners[a], corners[b], corners[d]
            lu, lv, lw = map(np.linalg.norm, (u, v, w))
            omega += 2 * np.arctan2(abs(np.dot(u, np.cross(v, w))),
                                    lu * lv * lw + u @ v * lw + u @ w * lv + v @ w * lu)
        values.append(3.0 * omega / 0.25)
    reference = vtkPolyData()
    reference.ShallowCopy(data)
    found = numpy_to_vtk(np.array(values), deep=True)
    found.SetName("Irradiance")
    reference.GetCellData().AddArray(found)
    return reference


def test_open_plane_is_exact():
    s = study(open_plane(), FloatComparison=True)
    s.SetReferenceData(exact_plane())
    s.Update()
    close(column(s, "RelativeTolerance"), [0.2, 0.05, 0.01])
    for name in ("TrueError", "TrueAbsoluteError", "TrueGreatestError", "EstimatedError"):
        assert (column(s, name) >= 0.0).all() and (column(s, name) < 1e-13).all(), column(s, name)
    assert (column(s, "Coverage") == 1.0).all()
    assert set(column(s, "Reference")) == {"the reference that was given"}
    assert rows(s, 3) == 3
    figures = summary(s)
    value, relation, note = figures["Seconds to 0.01 % true error"]
    assert value > 0.0 and relation == "<=" and "shortest run" in note, (value, relation, note)
    assert figures["Slope of the true error"][:2] == (0.0, "unknown")
    for figure in ("Float input: median", "Float result: median"):
        value, relation, _ = figures[figure + " relative difference"]
        assert relation == "=" and 1e-10 < value < 1e-6, value
    check_finite(s)


def test_finest_run_stands_in_for_a_reference():
    f = shaded()
    s = study(f)
    s.Update()
    assert rows(s) == 3
    assert column(s, "TrueError")[-1] == column(s, "Coverage")[-1] == UNKNOWN
    assert column(s, "Reference")[-1] == "none: this run is the reference"
    assert all("run 3, of the least estimated" in w for w in column(s, "Reference")[:-1])
    assert (column(s, "ReferenceError")[:-1] == column(s, "EstimatedError")[-1]).all()
    true = column(s, "TrueError")[:-1]
    assert (true >= 0.0).all() and (true < 0.2).all()
    estimated = column(s, "EstimatedError")
    assert (np.diff(estimated) <= 0.0).all() and estimated[0] > 0.0, estimated
    assert (column(s, "Coverage")[:-1] >= 0.9).all()
    assert set(column(s, "Effects")) == {"Occlusion"} or all(
        "Occlusion" in words for words in column(s, "Effects"))
    assert rows(s, 3) == 2
    figures, longest = summary(s), column(s, "TotalSeconds").max()
    assert figures["Seconds to 0.01 % estimated error"][:2] == (longest, ">")
    check_finite(s)

    # The same run given as a reference: no deviation at all, and the error of that run as before.
    again = study(f, tolerances=[0.01])
    again.SetReferenceData(s.GetOutputDataObject(2))
    again.Update()
    assert column(again, "TrueError")[0] == 0.0 and column(again, "Coverage")[0] == 1.0
    assert column(again, "Sharpness")[0] == UNKNOWN
    close(column(again, "EstimatedError")[0], estimated[-1], 1e-12)


def test_errors_are_those_of_the_arrays():
    f = shaded(RelativeTolerance=0.05)
    s = study(f, tolerances=[0.05])
    s.Update()
    f.Update()
    data = f.GetOutputDataObject(0).GetCellData()
    values, errors = array(data, "Irradiance"), array(data, "IrradianceError")
    close(column(s, "EstimatedError")[0], errors.mean() / values.mean(), 1e-12)  # cells of one size
    close(column(s, "AbsoluteError")[0], errors.mean(), 1e-12)
    close(column(s, "GreatestError")[0], errors.max(), 0.0)
    surface = s.GetOutputDataObject(2).GetCellData()
    assert (array(surface, "Irradiance") == values).all()
    assert column(s, "TrueError")[0] == UNKNOWN and rows(s, 3) == 1
    assert s.GetOutputDataObject(3).GetColumnByName("TrueError") is None


def test_the_filter_is_not_touched():
    f = shaded(RelativeTolerance=0.3, TimeBudget=77.0)
    f.Update()
    before = f.GetMTime()
    counted = []
    f.AddObserver("StartEvent", lambda *_: counted.append(1))
    s = study()
    s.SetFilter(f)
    s.Update()
    assert not counted and f.GetMTime() == before and f.GetRelativeTolerance() == 0.3
    assert (column(s, "TimeBudget") == 77.0).all()
    assert s.FindFilter() is f
    s.Update()
    assert rows(s) == 3


def test_lists():
    s = study(open_plane(), tolerances=[0.01, 0.2, 0.01, 0.2])  # each once, from coarse to fine
    s.Update()
    close(column(s, "RelativeTolerance"), [0.2, 0.01])
    s = study(shaded(), Mode=1)
    s.ClearTimeBudgets()
    s.AddTimeBudget(1.5)
    s.AddTimeBudget(0.05)
    s.Update()
    close(column(s, "TimeBudget"), [0.05, 1.5])
    assert (column(s, "RelativeTolerance") == 0.01).all()
    assert (column(s, "Seconds") < 3.0).all()
    s = study(open_plane(), tolerances=None)
    assert [s.GetTolerance(k) for k in range(s.GetNumberOfTolerances())] == [
        0.1, 0.05, 0.02, 0.01, 0.005]
    assert s.GetTolerance(5) == s.GetTolerance(-1) == s.GetTimeBudget(99) == -1.0


def test_wrong_lists_and_limits():
    nan, f = vtkMath.Nan(), open_plane()
    fails(study(f, tolerances=[0.1, nan]), "Tolerances[1]", "nan")
    fails(study(f, tolerances=[-0.1]), "Tolerances[0]", "-0.1", "[0, 1]")
    fails(study(f, tolerances=[1.5]), "Tolerances[0]", "1.5")
    fails(study(f, tolerances=[]), "Tolerances")
    for wrong in (0.0, -1.0, nan, vtkMath.Inf()):
        s = study(f, Mode=1)
        s.AddTimeBudget(wrong)
        fails(s, "TimeBudgets[5]")
    fails(study(f, TimeLimit=nan), "TimeLimit", "nan")
    fails(study(f, TimeLimit=-1.0), "TimeLimit", "-1")
    fails(study(f, Array="Nonsense"), "Nonsense", "missing")


def test_where_the_filter_is():
    fails(study(), "no filter")
    sphere = vtkSphereSource()
    s = study()
    s.SetInputConnection(sphere.GetOutputPort())
    fails(s, "no filter", "Irradiance")
    s = study()
    s.SetInputData(square())
    fails(s, "no filter")
    behind = vtkElevationFilter()  # another filter in between
    f = open_plane()
    behind.SetInputConnection(f.GetOutputPort())
    s = study()
    s.SetInputConnection(behind.GetOutputPort())
    s.Update()
    assert s.FindFilter() is f and rows(s) == 3
    s = study()
    s.SetInputConnection(f.GetOutputPort(2))  # whichever output
    s.Update()
    assert rows(s) == 3
    s = study()
    s.SetFilter(vtkIrradianceFilter())
    fails(s, "vtkIrradianceFilter", "no surface")


def test_errors_of_the_filter_become_the_study_s():
    bad = square(2)
    reflectance = numpy_to_vtk(np.array([0.5, 0.5, 1.5, 0.5]), deep=True)
    reflectance.SetName("DiffuseReflectance")
    bad.GetCellData().AddArray(reflectance)
    s = study()
    s.SetFilter(simulation(vtkIrradianceFilter, bad, LAMP))
    fails(s, "run 1 of 3", "RelativeTolerance 0.2", "DiffuseReflectance", "1.5")


def test_wrong_references():
    f = shaded(4)
    for reference, words in ((square(4), ("Reference", "Irradiance", "missing")),
                             (exact_plane(), None)):
        s = study(f, tolerances=[0.2])
        s.SetReferenceData(reference)
        if words:
            fails(s, *words)
        else:
            s.Update()
            assert column(s, "TrueError")[0] > 0.1  # another scene's values
    s = study(shaded(5), tolerances=[0.2])
    s.SetReferenceData(exact_plane())
    fails(s, "Reference", "16 values", "25")
    wrong = exact_plane()
    wrong.GetCellData().GetArray("Irradiance").SetValue(3, vtkMath.Nan())
    s = study(f, tolerances=[0.2])
    s.SetReferenceData(wrong)
    fails(s, "Reference Irradiance[3]", "nan")


def test_darkness_and_emptiness():
    dark = study(simulation(vtkIrradianceFilter, square(3)))
    dark.Update()
    for name in ("EstimatedError", "AbsoluteError"):
        assert (column(dark, name) == 0.0).all()
    assert (column(dark, "Coverage")[:-1] == 1.0).all()
    check_finite(dark)
    empty = study(simulation(vtkIrradianceFilter, vtkPolyData(), LAMP), FloatComparison=True)
    empty.Update()
    assert rows(empty) == 3 and (column(empty, "TrueError") == UNKNOWN).all()
    check_finite(empty)


def test_points_blocks_and_sensors():
    points = study(shaded(SampleLocation=1))
    points.Update()
    assert array(points.GetOutputDataObject(2).GetPointData(), "Irradiance").shape[0] >= 49
    assert (column(points, "Coverage")[:-1] > 0.8).all()
    plane = vtkWorkPlaneSource()
    plane.SetInputData(square())
    plane.Update()
    blocks = vtkMultiBlockDataSet()
    blocks.SetBlock(0, square(3))
    blocks.SetBlock(2, plane.GetOutput())
    both = study(simulation(vtkIrradianceFilter, blocks, PANEL))
    both.Update()
    surface = both.GetOutputDataObject(2)
    assert surface.IsA("vtkMultiBlockDataSet") and surface.GetNumberOfBlocks() == 3
    assert rows(both) == 3 and (column(both, "EstimatedError") >= 0.0).all()
    check_finite(points)
    check_finite(both)


def test_other_filters():
    data = room(1.0, 2)
    for kind, name, tolerances in ((vtkRadiosityFilter, "Radiosity", (0.3, 0.1)),
                                   (vtkRadianceFilter, "Radiance", (0.2, 0.1)),
                                   (vtkViewFactorFilter, "EnvironmentViewFactor", (0.2, 0.05))):
        f = kind()
        f.SetInputData(data)
        f.SetRelativeTolerance(0.3)  # its own run, before those of the study
        light = lamp(0.5)
        light.SetColor(1.0, 0.4, 0.1)  # bands that differ
        if kind is not vtkViewFactorFilter:
            f.AddLightsConnection(light.GetOutputPort())
        s = study(f, tolerances, Array=("" if kind is vtkRadiosityFilter else name))
        s.Update()
        assert rows(s) == 2, kind
        assert (column(s, "EstimatedError") >= 0.0).all()
        check_finite(s)
        names = [s.GetOutputDataObject(0).GetColumnName(k)
                 for k in range(s.GetOutputDataObject(0).GetNumberOfColumns())]
        if kind is vtkRadiosityFilter:
            parts = [column(s, name) for name in names if name.startswith("Error: ")]
            assert len(parts) == 5 and "Error: discretisation" in names
            # Each is part of the whole, and all of them together are no less.
            whole = column(s, "AbsoluteError")
            assert (np.max(parts, axis=0) <= whole * 1.000001).all(), (parts, whole)
            assert (np.sum(parts, axis=0) >= whole * 0.999999).all(), (parts, whole)
            assert "Interreflection" in column(s, "Effects")[0]
            assert column(s, "Method")[0] and column(s, "MemoryMiB")[0] > 0.0


def test_refining_from_what_is_there():
    f = simulation(vtkRadiosityFilter, room(1.0, 2), LAMP, RelativeTolerance=0.3)
    s = study(f, (0.3, 0.1), Fresh=False)
    s.Update()
    total, each = column(s, "TotalSeconds"), column(s, "Seconds")
    close(total, np.cumsum(each), 1e-12)
    fresh = study(f, (0.3, 0.1), Repeats=2)
    fresh.Update()
    assert (column(fresh, "TotalSeconds") == column(fresh, "Seconds")).all()


def test_time_limit():
    f = shaded(20)
    s = study(f, (0.2, 0.01, 1e-4, 1e-5, 1e-6), TimeLimit=0.6, FloatComparison=True)
    warnings = []
    s.AddObserver("WarningEvent", lambda *_: warnings.append(1))
    s.Update()
    made = rows(s)
    assert made < 5
    value, _, note = summary(s)["Runs"]
    assert value == made and "was not made" in note and warnings
    assert "time limit" in note
    check_finite(s)


def test_abort_and_progress():
    f = shaded(20)
    s = study(f, (0.1, 1e-5))
    seen, texts = [], []

    def stop(caller, _event):
        seen.append(caller.GetProgress())
        texts.append(caller.GetProgressText() or "")
        if len(seen) == 4:
            caller.SetAbortExecute(1)

    s.AddObserver("ProgressEvent", stop)
    errors = Errors(s)
    s.SetFilter(f)
    s.Update()
    assert len(seen) >= 4 and not errors.messages, errors.messages
    assert all(b >= a for a, b in zip(seen, seen[1:])), seen
    assert all(0.0 <= p <= 1.0 for p in seen)
    assert "run 1 of 2" in texts[3], texts
    for port in range(4):
        assert s.GetOutputDataObject(port).GetNumberOfElements(0) == 0
    s.SetAbortExecute(0)


def test_float_input_that_cannot_be_computed():
    """Rounding makes 0.7 + 0.3 more than 1: the study goes on and says so."""
    data = square(2)
    for name, value in (("DiffuseReflectance", 0.7), ("SpecularReflectance", 0.3)):
        values = numpy_to_vtk(np.full(4, value), deep=True)
        values.SetName(name)
        data.GetCellData().AddArray(values)
    s = study(simulation(vtkIrradianceFilter, data, LAMP), (0.1,), FloatComparison=True)
    s.Update()
    assert rows(s) == 1
    check_finite(s)
    value, relation, note = summary(s)["Float input: median relative difference"]
    assert relation == "=" or (value == UNKNOWN and note.startswith("not known: "))


def test_sources_of_a_filter_that_no_connection_leads_to():
    append = vtkAppendPolyData()
    append.AddInputData(square(2))
    f = vtkIrradianceFilter()
    f.SetInputConnection(append.GetOutputPort())
    light = lamp()
    f.AddLightsConnection(light.GetOutputPort())
    s = study(tolerances=(0.1,))
    s.SetFilter(f)
    s.Update()
    first = column(s, "Seconds")[0]
    assert s.GetOutputDataObject(2).GetNumberOfCells() == 4
    s.Update()
    assert column(s, "Seconds")[0] == first  # nothing changed, nothing is run
    append.AddInputData(square(3))
    light.SetIntensity(6.0)
    s.Update()
    assert s.GetOutputDataObject(2).GetNumberOfCells() == 13


run_all(globals())
