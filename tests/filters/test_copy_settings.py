# SPDX-License-Identifier: BSD-3-Clause
"""CopySettings takes over every property, whatever properties the classes come to have: found by name
(SetX beside GetX), set to another value, and asked of the copy."""
from checks import Errors, array, run_all, square, sun
from vtkmodules.vtkCommonExecutionModel import vtkDataObjectAlgorithm
from vtkmodules.vtkParallelCore import vtkDummyController
from vtkradiometry import (vtkIrradianceFilter, vtkRadianceFilter, vtkRadiosityFilter,
                           vtkViewFactorFilter)

CLASSES = (vtkIrradianceFilter, vtkRadiosityFilter, vtkRadianceFilter, vtkViewFactorFilter)
OF_VTK = set(dir(vtkDataObjectAlgorithm))


def properties(kind):
    names = [name[3:] for name in dir(kind)
             if name.startswith("Set") and name not in OF_VTK and hasattr(kind, "Get" + name[3:])]
    assert len(names) >= 14, names
    return names


def another(value):
    """Values that the property does not have now; one of them lies in its range."""
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value + 1, value - 1]
    if isinstance(value, float):
        return [value + 0.0625]
    if isinstance(value, str):
        return ["another"]
    if isinstance(value, tuple):
        return [tuple(v + 0.25 for v in value)]
    return ["another", vtkDummyController()]


def change(algorithm, name):
    get, put = getattr(algorithm, "Get" + name), getattr(algorithm, "Set" + name)
    before = get()
    for value in another(before):
        try:
            put(value)
        except TypeError:  # a text where an object is wanted
            continue
        if get() != before:
            return
    raise AssertionError(f"{algorithm.GetClassName()}: {name} cannot be changed from {before}")


def test_every_property_is_copied():
    for kind in CLASSES:
        original, copy = kind(), kind()
        for name in properties(kind):
            change(original, name)
        changed = {name: getattr(original, "Get" + name)() for name in properties(kind)}
        assert changed != {name: getattr(copy, "Get" + name)() for name in properties(kind)}
        before = copy.GetMTime()
        copy.CopySettings(original)
        for name, value in changed.items():
            found = getattr(copy, "Get" + name)()
            assert found == value, f"{kind.__name__}: {name} is {found} in the copy, not {value}"
        assert copy.GetMTime() > before


def test_each_alone():
    """So that no property is copied into another's place."""
    for kind in CLASSES:
        names = properties(kind)
        for one in names:
            original, copy = kind(), kind()
            change(original, one)
            copy.CopySettings(original)
            for name in names:
                assert getattr(copy, "Get" + name)() == getattr(original, "Get" + name)(), (
                    kind.__name__, one, name)


def test_which_eye_was_set_last():
    original, copy = vtkRadianceFilter(), vtkRadianceFilter()
    original.SetViewDirection(0.0, 0.0, -1.0)
    original.SetViewPoint(1.0, 2.0, 3.0)
    copy.CopySettings(original)
    light = sun((0, 0, -1), 1.0)
    copy.SetInputData(square())
    copy.AddLightsConnection(light.GetOutputPort())
    copy.Update()
    assert array(copy.GetOutputDataObject(0).GetFieldData(), "ViewPoint").tolist() == [[1, 2, 3]]


def test_another_class():
    copy = vtkIrradianceFilter()
    for wrong, word in ((vtkRadiosityFilter(), "vtkRadiosityFilter"), (None, "no filter")):
        wrong and wrong.SetRelativeTolerance(0.5)
        errors = Errors(copy)
        copy.CopySettings(wrong)
        assert len(errors.messages) == 1 and word in errors.messages[0], errors.messages
        assert copy.GetRelativeTolerance() == 0.01
        copy.RemoveAllObservers()


run_all(globals())
