# SPDX-License-Identifier: BSD-3-Clause
"""The proxies of the scene's filters inside ParaView: every property reaches the class."""
import os

from checks import SOURCE_DIR, array, close, run_all
from paraview import servermanager, simple

simple.LoadDistributedPlugin("Radiometry", remote=False, ns=globals())
K = 683.002


def fetched(proxy, port=0):
    proxy.UpdatePipeline()
    return servermanager.Fetch(proxy, idx=port)


def bands(data):
    return array(data.GetPointData(), "Intensity").reshape(-1)


def test_light_sources():
    point = simple.PointLight(Position=[1, 2, 3], Intensity=100, IntensityUnit="lm",
                              Color=[1, 0.5, 0.25], Attenuation=[0, 1, 0], LightEnabled=0,
                              AttachedTo="Camera", LightName="bulb")
    data = fetched(point)
    close(bands(data) * K, [7.957747154594767 * c for c in (1, 0.5, 0.25)])
    close(data.GetPoint(0), [1, 2, 3])
    close(array(data.GetPointData(), "Attenuation"), [[0, 1, 0]])
    assert array(data.GetPointData(), "LightEnabled")[0] == 0
    assert array(data.GetPointData(), "AttachedTo")[0] == 2
    assert array(data.GetFieldData(), "LightNames") == ["bulb"]
    point.LuminousEfficacy = 100
    point.Bands = 1
    close(bands(fetched(point)) * 100, [7.957747154594767 * (0.2126 + 0.3576 + 0.01805)])

    spot = simple.SpotLight(Intensity=100, IntensityUnit="lm", Cutoff=90, Exponent=1,
                            Target=[0, -2, 0], UseTarget=1)
    data = fetched(spot)
    close(bands(data) * K, [31.830988618379067])
    close(array(data.GetPointData(), "Direction"), [[0, -1, 0]])
    spot.InnerCutoff = 40
    spot.UseTarget = 0
    spot.Direction = [3, 0, 4]
    data = fetched(spot)
    close(array(data.GetPointData(), "SpotInnerCutoff"), [40])
    close(array(data.GetPointData(), "Direction"), [[0.6, 0, 0.8]])

    sun = simple.DirectionalLight(Intensity=50000, IntensityUnit="lx", Direction=[0, 0, -2])
    close(bands(fetched(sun)) * K, [50000])


def test_scene():
    """Reader, material and statistics in one pipeline, on the bundled Cornell box."""
    path = os.path.join(SOURCE_DIR, "examples", "cornell-box", "cornell-box.glb")
    reader = simple.RadiometricSceneReader(FileName=path)
    surface = fetched(reader)
    assert surface.GetNumberOfCells() == 50
    assert fetched(reader, 1).GetNumberOfPoints() == 0
    assert fetched(reader, 2).GetNumberOfPoints() == 1
    before = array(surface.GetCellData(), "EmittedExitance").max()
    reader.EmissiveUnits = "Exitance (W/m^2)"
    after = array(fetched(reader).GetCellData(), "EmittedExitance").max()
    close(before / after, 3.141592653589793 / K)
    reader.SpecularAsDiffuse = 1
    reader.LightUnits = "Radiometric (W/sr, W/m^2)"
    reader.UnreferencedLights = 1

    material = simple.SurfaceMaterial(Input=reader, Preset="Cornell red",
                                      SelectionArray="ObjectIndex", SelectionName="floor",
                                      Emission=2, EmissionUnit="W/(m^2 sr) (radiance)")
    statistics = simple.RadiometricStatistics(Input=material, GroupArray="ObjectIndex",
                                              ArrayNames=["EmittedExitance", "DiffuseReflectance"],
                                              Threshold=0.4)
    table = fetched(statistics)
    rows = {}
    for i in range(table.GetNumberOfRows()):
        key = tuple(table.GetValueByName(i, n).ToString()
                    for n in ("GroupName", "Array", "Component"))
        rows[key] = {n: table.GetValueByName(i, n).ToDouble() for n in ("Mean", "ShareAbove")}
    close(rows["floor", "EmittedExitance", "0"]["Mean"], 2 * 3.141592653589793)
    close(rows["floor", "DiffuseReflectance", "0"]["Mean"], 0.4489)
    close(rows["floor", "DiffuseReflectance", "0"]["ShareAbove"], 1)
    close(rows["floor", "DiffuseReflectance", "1"]["ShareAbove"], 0)
    assert rows["ceiling", "EmittedExitance", "0"]["Mean"] == 0
    statistics.MetersPerUnit = 2
    fetched(statistics)


if __name__ == "__main__":
    run_all(globals())
