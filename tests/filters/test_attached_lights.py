# SPDX-License-Identifier: BSD-3-Clause
"""Lights attached to the object or the camera, several inputs of lights, global ambient."""
import math
import os
import tempfile

import numpy as np
import vtkmodules.all as vtk
from checks import array, cell_values, close, fails, run_all, simulation, square, strings
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkradiometry import (vtkAreaLightSource, vtkEnvironmentLightSource, vtkIrradianceFilter,
                           vtkPhotometricFileReader, vtkRadiosityFilter)

SCENE, OBJECT, CAMERA = 0, 1, 2


class Lights:
    """Lights as data: what sources give, with AttachedTo set by hand."""

    def __init__(self, *lights, **field):
        self.data = vtk.vtkPolyData()
        points = vtk.vtkPoints()
        points.SetDataTypeToDouble()
        verts = vtk.vtkCellArray()
        columns = {}
        for i, light in enumerate(lights):
            points.InsertNextPoint(light.get("position", (0, 0, 0)))
            verts.InsertNextCell(1, [i])
            for name, default in (("LightType", 0), ("Intensity", 1.0), ("Direction", (0, 0, -1)),
                                  ("SpotCutoff", 180.0), ("SpotExponent", 0.0), ("AttachedTo", 0)):
                columns.setdefault(name, []).append(light.get(name, default))
        self.data.SetPoints(points)
        self.data.SetVerts(verts)
        for name, values in columns.items():
            self.add(self.data.GetPointData(), name, values)
        for name, values in field.items():
            self.add(self.data.GetFieldData(), name, [values])

    @staticmethod
    def add(data, name, values):
        a = numpy_to_vtk(np.asarray(values, float), deep=True)
        a.SetName(name)
        data.AddArray(a)

    def GetOutputPort(self):
        producer = vtk.vtkTrivialProducer()
        producer.SetOutput(self.data)
        self.producer = producer
        return producer.GetOutputPort()


def floor(resolution=4, size=2.0, center=(0, 0, 0)):
    return square(resolution, size, center)


def values(data, *lights, kind=vtkIrradianceFilter, **properties):
    return cell_values(simulation(kind, data, *lights, **properties), "Irradiance").copy()


def transform(*steps):
    t = vtk.vtkTransform()
    for name, arguments in steps:
        getattr(t, name)(*arguments)
    return t


SPOT = {"LightType": 1, "position": (0.2, 0.1, 1.5), "Direction": (0.1, -0.2, -1.0), "Intensity": 7.0,
        "SpotCutoff": 40.0, "SpotExponent": 2.0}


def test_light_of_the_object_moves_with_it():
    # The same floor and lamp, once as they are, once carried away together.
    data = floor()
    before = values(data, Lights(SPOT))
    t = transform(("Translate", (3, -2, 5)), ("RotateWXYZ", (50, 1, 2, 3)))
    mover = vtk.vtkTransformPolyDataFilter()
    mover.SetInputData(data)
    mover.SetTransform(t)
    mover.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
    mover.Update()
    carried = Lights(dict(SPOT, AttachedTo=OBJECT))
    f = simulation(vtkIrradianceFilter, mover.GetOutput(), carried)
    f.SetObjectTransform(t.GetMatrix())
    assert before.max() > 0.5
    close(cell_values(f, "Irradiance"), before, 1e-9)
    # As sixteen numbers, and as a field array, which goes before the property.
    numbers = [t.GetMatrix().GetElement(i, j) for i in range(4) for j in range(4)]
    f.SetObjectTransform([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
    assert abs(cell_values(f, "Irradiance") - before).max() > 0.1
    f.SetObjectTransform(numbers)
    close(cell_values(f, "Irradiance"), before, 1e-9)
    own = vtk.vtkPolyData()
    own.ShallowCopy(mover.GetOutput())
    Lights.add(own.GetFieldData(), "ObjectTransform", [numbers])
    close(values(own, carried), before, 1e-9)
    Lights.add(own.GetFieldData(), "ObjectTransform", numbers)  # sixteen tuples of one
    close(values(own, carried), before, 1e-9)


def attach(output, frame):
    """A copy of light data, every light attached to a frame."""
    data = output.NewInstance()
    data.DeepCopy(output)
    Lights.add(data.GetPointData(), "AttachedTo", np.full(data.GetNumberOfPoints(), float(frame)))
    lights = Lights()
    lights.data = data
    return lights


def test_areas_skies_and_luminaires_move_with_the_object():
    # Floor, blocker and light carried away together: nothing changes, whatever the light.
    panel = vtkAreaLightSource()
    panel.SetPosition(0.3, 0.2, 1.5)
    panel.SetDirection(0.2, -0.1, -1.0)
    panel.SetWidth(0.8)
    panel.SetHeight(0.3)
    panel.SetReferenceDirection(1.0, 0.4, 0.0)
    sky = vtkEnvironmentLightSource()
    sky.SetPreset(vtkEnvironmentLightSource.Clear)
    sky.SetSunPosition(0)
    sky.SetSunDirection(0.5, 0.3, 0.6)
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "lopsided.ies")
        with open(name, "w") as f:
            f.write("IESNA:LM-63-2002\n[TEST] 1\n[TESTLAB] x\n[ISSUEDATE] x\n[MANUFAC] x\nTILT=NONE\n"
                    "1 -1 1 3 5 1 2 0 0 0\n1 1 10\n0 45 90\n0 90 180 270 360\n"
                    "900 500 100\n900 800 0\n900 200 50\n900 100 10\n900 500 100\n")
        reader = vtkPhotometricFileReader()
        reader.SetFileName(name)
        reader.SetPosition(0.1, -0.2, 1.2)
        reader.SetDirection(0.1, 0.2, -1.0)
        reader.Update()
        luminaire = vtk.vtkPolyData()
        luminaire.DeepCopy(reader.GetOutputDataObject(0))
    panel.Update()
    sky.Update()
    data, blocker = floor(2), floor(1, 0.6, (0.4, 0.5, 0.6))
    t = transform(("Translate", (3, -2, 5)), ("RotateWXYZ", (50, 1, 2, 3)))

    def moved(surface):
        mover = vtk.vtkTransformPolyDataFilter()
        mover.SetInputData(surface)
        mover.SetTransform(t)
        mover.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
        mover.Update()
        return mover.GetOutput()

    for light in (panel.GetOutputDataObject(0), sky.GetOutputDataObject(0), luminaire):
        results = []
        for here in (True, False):
            f = simulation(vtkIrradianceFilter, data if here else moved(data),
                           attach(light, SCENE if here else OBJECT))
            f.AddOccludersData(blocker if here else moved(blocker))
            if not here:
                f.SetObjectTransform(t.GetMatrix())
            value = cell_values(f, "Irradiance").copy()
            error = array(f.GetOutputDataObject(0).GetCellData(), "IrradianceError").copy()
            results.append((value, error))
        (a, ea), (b, eb) = results
        assert a.max() > 0.0 and a.std() > 1e-3 * a.mean()
        assert (np.abs(a - b) <= 1e-9 * a.max() + ea + eb).all(), (a, b, ea, eb)
        assert np.abs(a - b).max() < 0.02 * a.max()
        # And without the transform it is another light.
        f.SetObjectTransform([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
        assert np.abs(cell_values(f, "Irradiance") - a).max() > 0.1 * a.max()
    # A mirror keeps an area light's front.
    lit = values(data, attach(panel.GetOutputDataObject(0), SCENE))
    f = simulation(vtkIrradianceFilter, data, attach(panel.GetOutputDataObject(0), OBJECT))
    f.SetObjectTransform(transform(("Scale", (-1, 1, 1))).GetMatrix())
    close(cell_values(f, "Irradiance"), lit.reshape(2, 2)[:, ::-1].ravel(), 1e-6)


def test_scale_moves_a_light_and_keeps_its_power():
    # The object's light at (0, 0, 1) under a scale by 2 stands at height 2; its intensity and
    # fall-off stay.
    data = floor(1, 0.01)
    t = transform(("Scale", (2, 2, 2)))
    f = simulation(vtkIrradianceFilter, data, Lights({"position": (0, 0, 1), "AttachedTo": OBJECT}))
    f.SetObjectTransform(t.GetMatrix())
    close(cell_values(f, "Irradiance"), values(data, Lights({"position": (0, 0, 2)})), 1e-14)
    # A direction under a scale that is not uniform: by the linear part, made unit again.
    sun = {"LightType": 2, "Direction": (1, 0, -1), "Intensity": 3.0}
    t = transform(("Scale", (1, 1, 3)))
    f = simulation(vtkIrradianceFilter, data, Lights(dict(sun, AttachedTo=OBJECT)))
    f.SetObjectTransform(t.GetMatrix())
    close(cell_values(f, "Irradiance"), [3.0 * 3.0 / math.sqrt(10.0)], 1e-14)
    # And a mirror.
    t = transform(("Scale", (1, 1, -1)))
    f = simulation(vtkIrradianceFilter, data, Lights({"position": (0, 0, -2), "AttachedTo": OBJECT}))
    f.SetObjectTransform(t.GetMatrix())
    close(cell_values(f, "Irradiance"), values(data, Lights({"position": (0, 0, 2)})), 1e-14)


def test_light_of_the_camera():
    # Against vtkCamera's own matrix.
    camera = vtk.vtkCamera()
    camera.SetPosition(1.0, -3.0, 2.0)
    camera.SetFocalPoint(0.2, 0.1, 0.0)
    camera.SetViewUp(0.3, 0.2, 0.9)
    eye = vtk.vtkMatrix4x4()
    vtk.vtkMatrix4x4.Invert(camera.GetViewTransformMatrix(), eye)
    given = dict(SPOT, position=(0.3, -0.2, 0.1), Direction=(0.05, 0.02, -1.0))
    place = eye.MultiplyPoint((*given["position"], 1.0))[:3]
    along = eye.MultiplyPoint((*given["Direction"], 0.0))[:3]
    data = floor(6)
    expected = values(data, Lights(dict(given, position=place, Direction=along)))
    assert expected.max() > 0.05
    f = simulation(vtkIrradianceFilter, data, Lights(dict(given, AttachedTo=CAMERA)),
                   CameraPosition=camera.GetPosition(), CameraFocalPoint=camera.GetFocalPoint(),
                   CameraViewUp=camera.GetViewUp())
    close(cell_values(f, "Irradiance"), expected, 1e-10)
    # In another unit: the camera is given in the data's unit, as the surface.
    small = simulation(vtkIrradianceFilter, data, Lights(dict(given, AttachedTo=CAMERA)),
                       CameraPosition=camera.GetPosition(), CameraFocalPoint=camera.GetFocalPoint(),
                       CameraViewUp=camera.GetViewUp(), MetersPerUnit=0.5)
    close(cell_values(small, "Irradiance"), 4.0 * expected, 1e-10)


def test_what_cannot_be_placed_is_an_error():
    data = floor(1)
    of_camera = Lights({"position": (0, 0, 1), "AttachedTo": CAMERA})
    fails(simulation(vtkIrradianceFilter, data, of_camera), "CameraPosition", "no camera")
    fails(simulation(vtkIrradianceFilter, data, of_camera, CameraPosition=(0, 0, 1),
                     CameraViewUp=(0, 0, 2)), "CameraViewUp")
    flat = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1]
    fails(simulation(vtkIrradianceFilter, data, ObjectTransform=flat), "ObjectTransform", "inverse")
    broken = [1, 0, 0, float("nan"), 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    fails(simulation(vtkIrradianceFilter, data, ObjectTransform=broken), "ObjectTransform[3]", "nan")
    perspective = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0.5, 1]
    fails(simulation(vtkIrradianceFilter, data, ObjectTransform=perspective), "ObjectTransform[14]")
    short = vtk.vtkPolyData()
    short.ShallowCopy(data)
    Lights.add(short.GetFieldData(), "ObjectTransform", [1.0, 2.0])
    fails(simulation(vtkIrradianceFilter, short), "ObjectTransform", "16")
    # Blocks that disagree.
    blocks = vtk.vtkMultiBlockDataSet()
    for k in range(2):
        block = floor(1, center=(3.0 * k, 0, 0))
        Lights.add(block.GetFieldData(), "ObjectTransform",
                   [[1, 0, 0, k, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]])
        blocks.SetBlock(k, block)
    fails(simulation(vtkIrradianceFilter, blocks), "block 1", "ObjectTransform")


def test_several_inputs_of_lights_add_up():
    data = floor(3)
    a = {"position": (0.3, 0.2, 1.0), "Intensity": 2.0}
    b = dict(SPOT)
    c = {"LightType": 2, "Direction": (0.1, 0.3, -1), "Intensity": 5.0}
    parts = [values(data, Lights(light)) for light in (a, b, c)]
    close(values(data, Lights(a, b, c)), sum(parts), 1e-13)
    close(values(data, Lights(a), Lights(b), Lights(c)), sum(parts), 1e-13)
    group = vtk.vtkMultiBlockDataSet()
    group.SetBlock(0, Lights(a).data)
    inner = vtk.vtkMultiBlockDataSet()
    inner.SetBlock(1, Lights(b).data)
    group.SetBlock(2, inner)
    tree = Lights()
    tree.data = group
    close(values(data, tree, Lights(c)), sum(parts), 1e-13)
    # One of one band beside one of three.
    red = Lights(dict(a, Intensity=(2.0, 0.0, 0.0)))
    got = values(data, red, Lights(c))
    close(got[:, 0], parts[0] + parts[2], 1e-13)
    close(got[:, 1], parts[2], 1e-13)
    f = simulation(vtkIrradianceFilter, data, red, Lights(c), Photometric=True)
    lux = cell_values(f, "Illuminance")
    close(lux, 683.002 * (0.2126 * parts[0] + parts[2]), 1e-12)


def test_plan_says_which_weak_lights_were_left_out():
    # One lamp near the floor and two thousand far away that together cannot matter.
    data = floor(8)
    rng = np.random.default_rng(1)
    strong = {"position": (0, 0, 1), "Intensity": 100.0}
    weak = [{"position": tuple(p), "Intensity": 1e-3}
            for p in 50.0 + 10.0 * rng.random((2000, 3))]
    f = simulation(vtkIrradianceFilter, data, Lights(strong, *weak))
    got = cell_values(f, "Irradiance")
    plan = f.GetOutputDataObject(1)
    names = [plan.GetColumnByName("Effect").GetValue(i) for i in range(plan.GetNumberOfRows())]
    k = names.index("WeakLights")
    assert plan.GetColumnByName("Decision").GetValue(k) == "dropped"
    assert any(line.startswith("WeakLights is dropped: ") for line in f.Explain().splitlines())
    why = plan.GetColumnByName("Why").GetValue(k)
    assert "IrradianceError" in why and "W/m^2" in why, why
    bound = plan.GetColumnByName("Bound").GetValue(k)
    exact = values(data, Lights(strong), RelativeTolerance=0.0) + \
        values(data, Lights(*weak), RelativeTolerance=0.0)
    errors = array(f.GetOutputDataObject(0).GetCellData(), "IrradianceError")
    # Float rounding of the bounds; rounding of values of 100 beside lights of 1e-4.
    assert (np.abs(got - exact) <= 1.000001 * errors + 1e-12).all()
    assert 0.0 < bound <= 0.01 * got.max()
    occlusion = plan.GetColumnByName("Why").GetValue(names.index("Occlusion"))
    # One lamp: nothing is left out, no row.
    f = simulation(vtkIrradianceFilter, data, Lights(strong))
    f.Update()
    plan = f.GetOutputDataObject(1)
    assert "WeakLights" not in strings(plan, "Effect")
    f = simulation(vtkIrradianceFilter, data, Lights(strong), Occlusion=1)
    f.Update()
    why = f.GetOutputDataObject(1).GetColumnByName("Why").GetValue(names.index("Occlusion"))
    assert "rays for 64 cells" in why, (occlusion, why)


def test_global_ambient_reaches_every_value():
    data = floor(2)
    lamp = Lights({"position": (0, 0, -1), "Intensity": 2.0})  # below: the front is dark
    f = simulation(vtkIrradianceFilter, data, lamp, GlobalAmbient=1.5, TwoSided=True)
    close(cell_values(f, "Irradiance"), np.full(4, 1.5), 0.0)
    back = array(f.GetOutputDataObject(0).GetCellData(), "IrradianceBack")
    bare = simulation(vtkIrradianceFilter, data, lamp, TwoSided=True)
    cell_values(bare, "Irradiance")
    without = bare.GetOutputDataObject(0).GetCellData()
    close(back, array(without, "IrradianceBack") + 1.5, 1e-15)
    for name in ("IrradianceError", "IrradianceBackError"):
        close(array(f.GetOutputDataObject(0).GetCellData(), name), array(without, name), 0.0)
    options = array(f.GetOutputDataObject(0).GetFieldData(), "RadiometryOptions")[0]
    assert "GlobalAmbient=1.5" in options, options
    # As field data of lights: per band, and every input adds.
    tinted = Lights({"position": (0, 0, -1)}, GlobalAmbient=(1.0, 2.0, 3.0))
    grey = Lights({"position": (0, 0, -1)}, GlobalAmbient=0.25)
    got = values(data, tinted, grey, GlobalAmbient=0.5)
    close(got, np.tile([1.75, 2.75, 3.75], (4, 1)), 1e-15)
    tree = Lights()
    tree.data = vtk.vtkMultiBlockDataSet()
    tree.data.SetBlock(0, grey.data)
    Lights.add(tree.data.GetFieldData(), "GlobalAmbient", [0.125])
    close(values(data, tree), np.full(4, 0.375), 1e-15)
    # No light at all; points and sensors, too.
    close(values(data, GlobalAmbient=2.0), np.full(4, 2.0), 0.0)
    at_points = simulation(vtkIrradianceFilter, data, GlobalAmbient=2.0, SampleLocation=1)
    at_points.Update()
    got = array(at_points.GetOutputDataObject(0).GetPointData(), "Irradiance")
    close(got, np.full(len(got), 2.0), 0.0)
    # What cannot be an irradiance.
    for bad in (-1.0, float("nan"), float("inf")):
        fails(simulation(vtkIrradianceFilter, data, GlobalAmbient=bad), "GlobalAmbient")
        fails(simulation(vtkIrradianceFilter, data, Lights(GlobalAmbient=bad)), "GlobalAmbient")


def test_radiosity_takes_ambient_as_light_that_arrives():
    # One convex sheet: E = E_ambient, B = rho E; nothing comes back.
    data = floor(2)
    f = simulation(vtkRadiosityFilter, data, GlobalAmbient=2.0, DiffuseReflectance=0.25)
    close(cell_values(f, "Irradiance"), np.full(4, 2.0), 1e-12)
    close(cell_values(f, "Radiosity"), np.full(4, 0.5), 1e-12)
    # A closed cube: E = E_ambient/(1 - rho).
    cube = vtk.vtkCubeSource()
    turn = vtk.vtkReverseSense()
    turn.SetInputConnection(cube.GetOutputPort())
    turn.Update()
    f = simulation(vtkRadiosityFilter, turn.GetOutput(), GlobalAmbient=2.0, DiffuseReflectance=0.5)
    close(cell_values(f, "Irradiance"), np.full(6, 4.0), 1e-6)


if __name__ == "__main__":
    run_all(globals())
