# SPDX-License-Identifier: BSD-3-Clause
"""The Luminaire Reader: light, distribution and luminous faces of files, and the light they give."""
import math
import os
import shutil
import tempfile

import numpy as np
from checks import Errors, array, cell_values, close, fails, points, run_all, shared, simulation
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter
from vtkradiometry import vtkIrradianceFilter, vtkPhotometricFileReader

K = 683.002
FOLDER = tempfile.mkdtemp(prefix="photometric-")


def ies(name, values, vertical, horizontal=(0,), kind=1, lumens="1 -1", keywords=(), size="0 0 0",
        units=2, multiplier=1):
    """Writes an IES file; values[h][v]. Returns its name."""
    lines = ["IESNA:LM-63-2002", "[TEST] ours", "[MANUFAC] Ours", "[LUMINAIRE] Test lamp", *keywords,
             "TILT=NONE", f"{lumens} {multiplier} {len(vertical)} {len(horizontal)} {kind} {units} {size}",
             "1 1 40", " ".join(map(str, vertical)), " ".join(map(str, horizontal))]
    lines += [" ".join(repr(float(v)) for v in row) for row in np.atleast_2d(values)]
    path = os.path.join(FOLDER, name)
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n")
    return path


def reader(path, **properties):
    source = vtkPhotometricFileReader()
    source.SetFileName(path)
    for name, value in properties.items():
        getattr(source, "Set" + name)(value)
    return source


def output(source, port=0):
    source.Update()
    return source.GetOutputDataObject(port)


def isotropic(flux=100, **more):
    vertical = range(0, 181, 10)
    return ies("isotropic.ies", [flux / (4 * math.pi)] * 19, vertical, **more)


def lambertian(flux=100, name="lambertian.ies", **more):
    vertical = np.linspace(0, 90, 1801)
    values = flux / math.pi * np.cos(np.radians(vertical))
    values[-1] = 0
    return ies(name, values, vertical, **more)


def square(half, height=0.0, n=1, centre=(0, 0)):
    plane = vtkPlaneSource()
    x, y = centre
    plane.SetOrigin(x - half, y - half, height)
    plane.SetPoint1(x + half, y - half, height)
    plane.SetPoint2(x - half, y + half, height)
    plane.SetResolution(n, n)
    plane.Update()
    return plane.GetOutput()


def lux(light, data, **properties):
    return cell_values(simulation(vtkIrradianceFilter, data, light, **properties), "Irradiance") * K


def test_a_hundred_lumens_at_one_metre():
    for path, expected in ((isotropic(), 7.957747154594767), (lambertian(), 31.830988618379067)):
        light = reader(path, Position=(0, 0, 1))
        close(lux(light, square(1e-3)), [expected], relative=3e-6)
        close(light.GetFluxFromWeb(), 100, relative=1e-6)
        # It reads the same whatever the efficacy in between.
        light.SetLuminousEfficacy(100)
        close(lux(light, square(1e-3)) * 100 / K, [expected], relative=3e-6)


def test_all_the_light_falls_on_a_closed_floor():
    light = reader(lambertian(), Position=(0.2, -0.1, 1))
    flux = lux(light, square(2000.0)) * 4000**2
    close(flux, [100], relative=1e-5)


def test_the_light_as_data():
    path = lambertian(size="0.2 -0.1 0", keywords=["[LAMP] LED", "[MORE] white"])
    light = reader(path, Position=(1, 2, 3), Direction=(0, -2, 0), ReferenceDirection=(1, 1, 0),
                   Dimming=0.5, LightLossFactor=0.8, Color=(1, 0.5, 0), LightEnabled=False,
                   AttachedTo=2)
    data = output(light)
    assert data.GetNumberOfPoints() == data.GetNumberOfVerts() == 1
    close(points(data), [[1, 2, 3]])
    lights = data.GetPointData()
    close(array(lights, "Direction"), [[0, -1, 0]])
    close(array(lights, "ReferenceDirection"), [[1, 0, 0]], absolute=1e-15)
    close(array(lights, "Intensity"), np.array([[1, 0.5, 0]]) * 0.4 * 100 / math.pi / K)
    for name, value in (("LightType", 0), ("PhotometricWeb", 0), ("LightEnabled", 0),
                        ("AttachedTo", 2)):
        assert array(lights, name).tolist() == [value], name
    field = data.GetFieldData()
    assert array(field, "LightNames") == ["Test lamp"]
    assert array(field, "LuminaireName") == ["Test lamp"]
    assert array(field, "Manufacturer") == ["Ours"]
    assert array(field, "LampName") == ["LED\nwhite"]
    assert array(field, "PhotometricFormat") == ["LM-63-2002"]
    assert array(field, "FluxUnit") == ["lm"] and array(field, "FileIntensityUnit") == ["cd"]
    assert "[MANUFAC] Ours" in array(field, "PhotometricKeywords")
    assert array(field, "Photometric")[0] == 1
    assert array(field, "LuminousOpeningShape") == ["ellipse"]
    close(array(field, "LuminousOpeningSize"), [0.1, 0.2, 0])
    close(array(field, "FluxFromWeb"), [100], relative=1e-6)
    close(array(field, "FluxStated"), [-1])
    close(array(field, "InputPower"), [40])
    web = array(field, "PhotometricWeb0")
    assert web.max() == 1 and len(web) == 1801
    close(array(field, "PhotometricWeb0Horizontal"), [0])
    assert array(field, "PhotometricWeb0Type").tolist() == [1]


def test_distribution_and_luminous_faces():
    light = reader(lambertian(size="0.2 0.6 0.1"), Position=(1, 2, 3), SolidScale=2, Dimming=0.5)
    solid = output(light, 1)
    low, high = np.min(points(solid), axis=0), np.max(points(solid), axis=0)
    close(high - low, [2, 2, 2], relative=2e-3)  # a sphere that hangs from the luminaire
    close(high[2], 3, absolute=1e-12)
    close(array(solid.GetPointData(), "RelativeIntensity").max(), 1)
    close(array(solid.GetPointData(), "LuminousIntensity").max(), 50 / math.pi)
    close(array(solid.GetPointData(), "Intensity").max(), 50 / math.pi / K)
    faces = output(light, 2)
    assert faces.GetNumberOfPolys() == 5
    close(faces.GetBounds(), [0.7, 1.3, 1.9, 2.1, 2.95, 3.05], relative=1e-12)
    assert output(reader(lambertian()), 2).GetNumberOfPolys() == 0  # a point has none


def lopsided(kind):
    """A light brighter toward C = 0 and C = 90, in angles of one type."""
    def value(x, y, z):  # luminaire's frame, z up
        return max(0.0, -z) * (1 + 0.5 * x + 0.3 * y)
    if kind == 1:
        h, v = np.linspace(0, 360, 121), np.linspace(0, 90, 121)
        c, g = np.meshgrid(np.radians(h), np.radians(v), indexing="ij")
        xyz = np.sin(g) * np.cos(c), np.sin(g) * np.sin(c), -np.cos(g)
    else:
        h, v = np.linspace(-90, 90, 181), np.linspace(-90, 90, 181)
        a, b = np.meshgrid(np.radians(h), np.radians(v), indexing="ij")
        if kind == 2:
            xyz = np.cos(a) * np.sin(b), -np.sin(a), -np.cos(a) * np.cos(b)
        else:
            xyz = np.sin(b), -np.cos(b) * np.sin(a), -np.cos(b) * np.cos(a)
    values = 100 * np.vectorize(value)(*xyz)
    return ies(f"lopsided{kind}.ies", values, v, h, kind=kind)


def test_types_agree_and_type_b_is_not_type_c():
    floor = square(2, n=6)
    c, b, a = (lux(reader(lopsided(kind), Position=(0, 0, 1)), floor) for kind in (1, 2, 3))
    close(b, c, relative=2e-3)
    close(a, c, relative=2e-3)
    # The defect that this is about: the values of type B read as type C give another light.
    flux = [reader(lopsided(kind)) for kind in (1, 2)]
    for source in flux:
        source.Update()
    close(flux[0].GetFluxFromWeb(), 100 * math.pi, relative=2e-3)
    close(flux[1].GetFluxFromWeb(), 100 * math.pi, relative=2e-3)


def test_turning():
    path = lopsided(1)
    floor = square(0.5, n=4)
    still = lux(reader(path, Position=(0, 0, 1)), floor).reshape(4, 4)
    # Brighter toward C = 0 (x) and C = 90 (y).
    assert still[1, 3] > still[1, 0] and still[3, 1] > still[0, 1]
    quarter = lux(reader(path, Position=(0, 0, 1), Rotation=90), floor).reshape(4, 4)
    close(quarter, np.rot90(still, -1), relative=1e-9)  # x becomes y
    close(lux(reader(path, Position=(0, 0, 1), ReferenceDirection=(0, 3, 0.2)), floor).reshape(4, 4),
          quarter, relative=1e-9)
    close(lux(reader(path, Position=(0, 0, 1), Rotation=360), floor).reshape(4, 4), still,
          relative=1e-9)
    # Aimed at a wall: the whole setting turned.
    wall = vtkPlaneSource()
    wall.SetOrigin(1, -0.5, -0.5)
    wall.SetPoint1(1, -0.5, 0.5)
    wall.SetPoint2(1, 0.5, -0.5)
    wall.SetResolution(4, 4)
    wall.Update()
    # x of the floor becomes z, y stays, down becomes +x: the front faces the light at the origin.
    aimed = lux(reader(path, Direction=(1, 0, 0), ReferenceDirection=(0, 0, 1)), wall.GetOutput())
    assert aimed.max() > 0
    close(aimed.reshape(4, 4), still, relative=1e-9)


def test_area_samples():
    near, far = square(0.01, -0.1, centre=(0.25, 0)), square(0.01, -20)
    path = lambertian(size="0.2 0.6 0")
    one = reader(path, Position=(0, 0, 0))
    many = reader(path, Position=(0, 0, 0), AreaSamples=(24, 8))
    data = output(many)
    assert data.GetNumberOfPoints() == 192
    assert data.GetFieldData().GetArray("PhotometricWeb1") is None  # all share one web
    close(array(data.GetPointData(), "Intensity").sum(), 100 / math.pi / K)
    close(lux(many, far), lux(one, far), relative=1e-3)
    # A Lambertian rectangle by its own integral, at a place a sixth of its length away.
    x, y = np.meshgrid(np.linspace(-0.3, 0.3, 601)[1::2], np.linspace(-0.1, 0.1, 401)[1::2])
    r2 = (x - 0.25) ** 2 + y**2 + 0.01
    exact = 100 / math.pi * np.mean(0.01 / r2**2)
    close(lux(many, near), [exact], relative=0.02)
    assert abs(lux(one, near)[0] / exact - 1) > 0.3, "samples would not be needed"


def test_stated_flux():
    path = isotropic(keywords=["[_TOTALLUMINAIRELUMENS] 150"])
    light = reader(path)
    warnings = []

    def collect(caller, event, text=""):
        warnings.append(text)

    collect.CallDataType = "string0"
    light.AddObserver("WarningEvent", collect)
    light.Update()
    assert len(warnings) == 1 and "100 lm" in warnings[0] and "150 lm" in warnings[0], warnings
    assert light.GetFluxStated() == 150 and light.GetFluxUnit() == "lm"
    assert light.GetNumberOfWarnings() == 1 and "150" in light.GetWarning(0)
    assert light.GetWarning(1) is None
    assert array(light.GetOutput().GetFieldData(), "Warnings") == [light.GetWarning(0)]
    close(lux(reader(path, Position=(0, 0, 1)), square(1e-3)), [7.957747], relative=1e-5)
    within = reader(isotropic(keywords=["[_TOTALLUMINAIRELUMENS] 101"]))
    within.Update()
    assert within.GetNumberOfWarnings() == 0
    dim = reader(isotropic(lumens="1 50"))
    dim.Update()
    assert "50 lm of the lamps" in dim.GetWarning(0)


def test_radiometric_files():
    path = isotropic(keywords=["[_INTENSITYUNITS] mW/sr"])
    auto = output(reader(path))
    close(array(auto.GetPointData(), "Intensity"), [100 / (4 * math.pi) / 1000])
    assert array(auto.GetFieldData(), "Photometric")[0] == 0
    assert array(auto.GetFieldData(), "FluxUnit") == ["mW"]
    for units, factor in ((1, 1 / K), (2, 1e-3), (3, 1)):
        close(array(output(reader(path, IntensityUnits=units)).GetPointData(), "Intensity"),
              [100 / (4 * math.pi) * factor])
    assert output(reader(path), 1).GetPointData().GetArray("LuminousIntensity") is None


def written_and_read(data):
    path = os.path.join(FOLDER, "lights.vtp")
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(path)
    writer.SetInputData(data)
    writer.SetDataModeToBinary()  # VTK 9.2 cannot read appended data with an expat that defers parsing
    assert writer.Write() == 1
    back = vtkXMLPolyDataReader()
    back.SetFileName(path)
    return back


def test_webs_survive_a_file():
    light = reader(lopsided(2), Position=(0, 0, 1))
    floor = square(1, n=4)
    back = written_and_read(output(light))
    assert (lux(back, floor) == lux(light, floor)).all()
    assert array(output(back).GetFieldData(), "PhotometricWeb0Type").tolist() == [2]


def test_blocks_have_webs_of_their_own():
    floor = square(1, n=4)
    lamps = [reader(path, Position=place) for path, place in
             ((lopsided(1), (0.3, 0, 1)), (lambertian(), (-0.3, 0.2, 1)))]
    blocks = vtkMultiBlockDataSet()
    for k, lamp in enumerate(lamps):
        blocks.SetBlock(k, output(lamp))
    f = vtkIrradianceFilter()
    f.SetInputData(floor)
    f.SetInputDataObject(1, blocks)
    close(cell_values(f, "Irradiance") * K, lux(lamps[0], floor) + lux(lamps[1], floor))
    both = simulation(vtkIrradianceFilter, floor, *lamps)
    close(cell_values(both, "Irradiance") * K, lux(lamps[0], floor) + lux(lamps[1], floor))


def changed(data, name, values, field=False):
    """A deep copy in which one array has other values; None removes it."""
    copy = vtkPolyData()
    copy.DeepCopy(data)
    arrays = copy.GetFieldData() if field else copy.GetPointData()
    if values is None:
        arrays.RemoveArray(name)
    else:
        array(arrays, name)[...] = values
    return copy


def test_lights_that_refer_to_nothing():
    data = output(reader(lopsided(1), Position=(0, 0, 1)))
    floor = square(1)

    def refuses(bad, *words):
        f = vtkIrradianceFilter()
        f.SetInputData(floor)
        f.SetInputData(1, bad)
        fails(f, *words)

    refuses(changed(data, "PhotometricWeb", 3), "PhotometricWeb", "3")
    refuses(changed(data, "PhotometricWeb0", None, True), "PhotometricWeb", "0")
    refuses(changed(data, "PhotometricWeb0Vertical", None, True), "PhotometricWeb0Vertical", "missing")
    refuses(changed(data, "PhotometricWeb0", float("nan"), True), "PhotometricWeb0", "nan")
    refuses(changed(data, "PhotometricWeb0Type", 7, True), "PhotometricWeb0Type", "7")
    refuses(changed(data, "ReferenceDirection", 0), "ReferenceDirection")
    refuses(changed(data, "Direction", 0), "Direction")
    refuses(changed(data, "LightType", 1), "PhotometricWeb")
    # Without a web it is a plain point light.
    f = vtkIrradianceFilter()
    f.SetInputData(square(1e-3))
    f.SetInputData(1, changed(data, "PhotometricWeb", -1))
    intensity = array(data.GetPointData(), "Intensity")[0]
    close(cell_values(f, "Irradiance"), [intensity], relative=1e-5)


def test_bad_files_and_properties():
    fails(vtkPhotometricFileReader(), "FileName")
    fails(reader(os.path.join(FOLDER, "none.ies")), "none.ies", "no such file")
    bad = ies("bad.ies", [1, -1], (0, 90))
    fails(reader(bad), "bad.ies", "line 10", "intensity 2", "-1")
    good = isotropic()
    for name, value in (("Direction", (0, 0, 0)), ("ReferenceDirection", (0, 0, 0)),
                        ("Position", (math.nan, 0, 0)), ("Dimming", -1.0),
                        ("LightLossFactor", math.inf), ("SolidScale", 0.0), ("AreaSamples", (0, 1)),
                        ("LuminousEfficacy", 0.0), ("Rotation", math.nan), ("Color", (1, -1, 1)),
                        ("AttachedTo", 7)):
        fails(reader(good, **{name: value}), name)
    # After an error it works again.
    light = reader(bad)
    Errors(light)
    light.Update()
    light.SetFileName(good)
    assert output(light).GetNumberOfPoints() == 1


def bilinear(values, h, v, x, y, z):
    """The web's interpolation by its definition, for directions in the luminaire's frame."""
    gamma = np.degrees(np.arctan2(np.hypot(x, y), -z))
    c = np.degrees(np.arctan2(y, x)) % 360
    i = np.clip(np.searchsorted(v, gamma, "right") - 1, 0, len(v) - 2)
    j = np.clip(np.searchsorted(h, c, "right") - 1, 0, len(h) - 2)
    s, t = (gamma - v[i]) / (v[i + 1] - v[i]), (c - h[j]) / (h[j + 1] - h[j])
    low = values[j, i] + s * (values[j, i + 1] - values[j, i])
    high = values[j + 1, i] + s * (values[j + 1, i + 1] - values[j + 1, i])
    return np.where(gamma <= v[-1], low + t * (high - low), 0)


def test_wild_web_behind_plates_against_brute_force():
    random = np.random.default_rng(4)
    h, v = np.linspace(0, 360, 25), np.linspace(0, 90, 19)
    values = 1000 * random.random((25, 19)) ** 2
    values[-1], values[:, 0] = values[0], 500
    lamp = np.array((0.1, 0.05, 1.0))
    light = reader(ies("wild.ies", values, v, h), Position=lamp)
    plates = vtkAppendPolyData()
    centres = random.uniform((-0.6, -0.6, 0.2), (0.6, 0.6, 0.8), (25, 3))
    for x, y, z in centres:
        plates.AddInputData(square(0.06, z, centre=(x, y)))
    n, fine = 20, 30
    floor = square(1.5, n=n)
    f = simulation(vtkIrradianceFilter, floor, light, RelativeTolerance=0.01)
    f.AddOccludersConnection(plates.GetOutputPort())
    computed, error = cell_values(f, "Irradiance") * K, cell_values(f, "IrradianceError") * K

    def brute(parts, plates=centres):
        """Means over parts x parts points a cell."""
        at = (np.arange(n * parts) + 0.5) / (n * parts) * 3 - 1.5
        x, y = np.meshgrid(at, at)
        dx, dy, dz = x - lamp[0], y - lamp[1], -lamp[2]
        r2 = dx**2 + dy**2 + dz**2
        e = bilinear(values, h, v, dx, dy, dz) * -dz / r2**1.5
        for px, py, pz in plates:
            t = (lamp[2] - pz) / lamp[2]
            hit = (np.abs(lamp[0] + t * dx - px) < 0.06) & (np.abs(lamp[1] + t * dy - py) < 0.06)
            e[hit] = 0
        return e.reshape(n, parts, n, parts).mean(axis=(1, 3)).reshape(-1)

    reference = brute(fine)
    # Edges parallel to the rows of points are off by up to one row, on either side of a shadow.
    doubt = 2 / fine * brute(fine, ()) + 1e-3 * reference.mean()
    difference = np.abs(computed - reference)
    assert (difference <= error + doubt).mean() >= 0.99
    assert np.median(difference) < 2e-3 * reference.mean()
    close(computed.mean(), reference.mean(), relative=1e-3)
    assert (error <= 0.0101 * computed + 1e-9 * computed.max()).all()


def test_reader_choice():
    assert vtkPhotometricFileReader.CanReadFile(isotropic())
    assert not vtkPhotometricFileReader.CanReadFile(os.path.join(FOLDER, "none.ies"))
    other = os.path.join(FOLDER, "lamp.txt")
    open(other, "w").close()
    assert not vtkPhotometricFileReader.CanReadFile(other)


def test_real_files_light_a_floor():
    folder = shared("photometry")
    if folder is None:
        print("no shared data: real files not tried")
        return
    count = 0
    for kind in ("ies", "ldt"):
        for name in sorted(os.listdir(os.path.join(folder, kind))):
            if not name.endswith(kind):
                continue
            light = reader(os.path.join(folder, kind, name), Position=(0, 0, 1))
            data = output(light)
            assert data.GetNumberOfPoints() == 1, name
            # Two huge planes, above and below, take all that is sent.
            scale = {"lm": K, "mW": 1000, "W": 1}[light.GetFluxUnit()]
            taken = 0.0
            for height, sign in ((0, 1), (2, -1)):
                plane = vtkPlaneSource()
                plane.SetOrigin(-5000, -5000 * sign, height)
                plane.SetPoint1(5000, -5000 * sign, height)
                plane.SetPoint2(-5000, 5000 * sign, height)
                plane.Update()
                f = simulation(vtkIrradianceFilter, plane.GetOutput(), light)
                taken += cell_values(f, "Irradiance")[0] * 1e8 * scale
            close(taken, light.GetFluxFromWeb(), relative=2e-3)
            count += 1
    assert count >= 20, count


if __name__ == "__main__":
    try:
        run_all(dict(globals()))
    finally:
        shutil.rmtree(FOLDER, ignore_errors=True)
