# SPDX-License-Identifier: BSD-3-Clause
"""The effect plan as users read it: the table, the field data, Explain(); and its switches."""
import numpy as np
from checks import array, cell_values, run_all, simulation, square, strings
from rooms import with_array
from vtkradiometry import (vtkAreaLightSource, vtkDirectionalLightSource, vtkIrradianceFilter,
                           vtkPointLightSource, vtkRadianceFilter, vtkRadiosityFilter,
                           vtkSpotLightSource)

COLUMNS = ["Effect", "Switch", "Decision", "Bound", "Unit", "Seconds", "Why"]
EFFECTS = ["Occlusion", "Interreflection", "SpecularTransport", "Transmission", "BackFaces",
           "Emission", "Environment", "SpotShape", "Attenuation", "PointLights", "SpotLights",
           "DirectionalLights", "AreaLights", "CandelaWebs", "GlobalAmbient", "Mirrors",
           "SpectralBands", "PointSampling", "Discretisation"]
WITHOUT_SWITCH = {"GlobalAmbient", "PointSampling", "Discretisation"}
DECISIONS = {"simulated", "dropped", "left out", "not needed"}
OFF = 2


def lights():
    point, spot, sun, panel = (vtkPointLightSource(), vtkSpotLightSource(),
                               vtkDirectionalLightSource(), vtkAreaLightSource())
    point.SetPosition(0.2, 0.3, 1.0)
    point.SetIntensity(5.0)
    spot.SetPosition(0.5, 0.5, 1.5)
    spot.SetDirection(0, 0, -1)
    spot.SetIntensity(3.0)
    sun.SetDirection(0.3, 0.0, -1.0)
    sun.SetIntensity(2.0)
    panel.SetPosition(0.5, 0.5, 1.2)
    panel.SetDirection(0, 0, -1)
    panel.SetIntensity(1.0)
    return point, spot, sun, panel


def rows(f):
    f.Update()
    plan = f.GetOutputDataObject(1)
    names = strings(plan, "Effect")
    return {name: {c: plan.GetColumnByName(c).GetValue(k) for c in COLUMNS}
            for k, name in enumerate(names)}


def test_table_has_a_row_an_effect():
    for kind in (vtkIrradianceFilter, vtkRadiosityFilter):
        f = simulation(kind, square(3), *lights())
        f.Update()
        plan = f.GetOutputDataObject(1)
        found = [plan.GetColumnName(k) for k in range(plan.GetNumberOfColumns())]
        assert found == COLUMNS, found
        assert strings(plan, "Effect")[:len(EFFECTS)] == EFFECTS
        for name, row in rows(f).items():
            if name not in EFFECTS:
                continue
            assert row["Decision"] in DECISIONS, row
            assert row["Switch"] == ("" if name in WITHOUT_SWITCH else "Auto"), row
            assert row["Why"] and row["Unit"] == "W/m^2", row
            assert row["Bound"] >= 0.0 and row["Seconds"] >= 0.0, row


def test_field_data_and_explain_say_the_same():
    f = simulation(vtkIrradianceFilter, square(3), *lights())
    assert f.Explain() == ""
    f.Update()
    said = f.Explain().splitlines()
    kept = array(f.GetOutputDataObject(0).GetFieldData(), "EffectPlan")
    assert said == list(kept), (said, kept)
    assert [line.split(" is ")[0] for line in said[:len(EFFECTS)]] == EFFECTS
    for line, row in zip(said, rows(f).values()):
        assert line.startswith(f"{row['Effect']} is {row['Decision']}: {row['Why']}"), line
        assert line.endswith("."), line
        if row["Bound"] > 0.0:
            assert "no value by more than" in line and "W/m^2" in line, line


def test_each_kind_of_light_can_be_switched_off():
    kinds = ("PointLights", "SpotLights", "DirectionalLights", "AreaLights")
    on = cell_values(simulation(vtkIrradianceFilter, square(4), *lights()), "Irradiance")
    rest = np.zeros_like(on)
    for kind, light in zip(kinds, lights()):
        f = simulation(vtkIrradianceFilter, square(4), *lights(), **{kind: OFF})
        off = cell_values(f, "Irradiance")
        alone = cell_values(simulation(vtkIrradianceFilter, square(4), light), "Irradiance")
        assert np.abs(on - off - alone).max() <= 1e-9 * on.max()
        row = rows(f)[kind]
        assert row["Switch"] == "Off" and row["Decision"] == "left out", row
        assert (on - off).max() <= row["Bound"] <= 20.0 * max((on - off).max(), 1e-3), row
        rest += on - off
    assert np.abs(rest - on).max() <= 1e-9 * on.max()


def test_radiance_has_rows_and_switches_of_lights_too():
    def run(*given, **properties):
        data = with_array(square(3), "SpecularReflectance", 0.3)
        f = simulation(vtkRadianceFilter, with_array(data, "Shininess", 20.0), *given, **properties)
        f.SetViewPoint(0.5, -0.5, 1.0)
        return f
    point, spot, sun, _ = lights()
    on = cell_values(run(point, spot, sun), "Radiance")
    for kind, light in zip(("PointLights", "SpotLights", "DirectionalLights"), (point, spot, sun)):
        f = run(point, spot, sun, **{kind: OFF})
        change = on - cell_values(f, "Radiance")
        alone = cell_values(run(light), "Radiance")
        assert np.abs(change - alone).max() <= 0.05 * on.max(), kind
        row = rows(f)[kind]
        assert row["Switch"] == "Off" and row["Decision"] == "left out", row
        assert row["Unit"] == "W/(m^2 sr)" and change.max() <= row["Bound"] < 1000 * change.max(), row
    assert rows(run(point))["SpotLights"]["Decision"] == "not needed"


def test_faint_lights_are_dropped_and_their_bound_is_in_the_errors():
    point, spot, sun, panel = lights()
    sun.SetIntensity(1e-5)
    args = (square(4), point, sun)
    plan = simulation(vtkIrradianceFilter, *args, AbsoluteTolerance=1e-3)
    every = simulation(vtkIrradianceFilter, *args, AbsoluteTolerance=1e-3, DirectionalLights=1)
    row = rows(plan)["DirectionalLights"]
    assert row["Decision"] == "dropped" and 0.0 < row["Bound"] <= 0.25e-3, row
    assert "tolerance" in row["Why"]
    assert rows(every)["DirectionalLights"]["Decision"] == "simulated"
    change = np.abs(cell_values(plan, "Irradiance") - cell_values(every, "Irradiance"))
    assert change.max() <= row["Bound"]
    errors = array(plan.GetOutputDataObject(0).GetCellData(), "IrradianceError")
    assert (errors >= row["Bound"]).all()


def test_seconds_go_to_the_effects_that_took_them():
    f = simulation(vtkIrradianceFilter, square(40), *lights()[:2])
    table = rows(f)
    assert table["PointLights"]["Seconds"] > 0.0 and table["SpotLights"]["Seconds"] > 0.0
    assert table["AreaLights"]["Seconds"] == 0.0
    spent = sum(row["Seconds"] for row in table.values())
    cost = f.GetOutputDataObject(0).GetFieldData().GetArray("RadiometryCost").GetValue(0)
    assert spent <= cost * (1 + 1e-9) + 1e-6, (spent, cost)


if __name__ == "__main__":
    run_all(globals())
