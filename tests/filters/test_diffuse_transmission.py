# SPDX-License-Identifier: BSD-3-Clause
"""DiffuseTransmittance in the filters: paper under the sun, a lampshade, the plan, bad input."""
import numpy as np
import vtkmodules.all as vtk
from checks import cell_values, close, fails, run_all, simulation, square, strings, sun
from rooms import areas, lamp, room, with_array
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkradiometry import vtkIrradianceFilter, vtkRadiosityFilter, vtkSurfaceMaterialFilter

DENSE, MONTE_CARLO = 1, 3
K = 683.002


def row(f, effect):
    plan = f.GetOutputDataObject(1)
    k = strings(plan, "Effect").index(effect)
    return (strings(plan, "Decision")[k], strings(plan, "Why")[k],
            plan.GetColumnByName("Bound").GetValue(k))


def paper(tau=0.45, rho=0.3):
    return with_array(with_array(square(2), "DiffuseReflectance", rho), "DiffuseTransmittance", tau)


def test_paper_under_the_sun():
    f = simulation(vtkRadiosityFilter, paper(), sun((0, 0, -1), 1000.0))
    for name, value in (("Irradiance", 1000), ("Radiosity", 300), ("IrradianceBack", 0),
                        ("RadiosityBack", 450)):
        close(cell_values(f, name), [value] * 4, 1e-9)
    decision, why, bound = row(f, "Transmission")
    assert decision == "simulated" and "0.45" in why and bound == 0
    f.SetTransmission(2)
    f.Update()
    assert row(f, "Transmission")[0] == "left out" and row(f, "Transmission")[2] >= 450


def test_direct_light_alone_says_what_it_leaves_out():
    f = simulation(vtkIrradianceFilter, paper(), sun((0, 0, -1), 1000.0))
    close(cell_values(f, "Irradiance"), [1000] * 4, 1e-12)
    _, why, bound = row(f, "Transmission")
    assert "diffusely" in why and bound >= 450


def test_bands_differ():
    data = square(1)
    tau = numpy_to_vtk(np.array([[0.5, 0.2, 0.0]] * data.GetNumberOfCells()), deep=True)
    tau.SetName("DiffuseTransmittance")
    data.GetCellData().AddArray(tau)
    f = simulation(vtkRadiosityFilter, data, sun((0, 0, -1), 100.0))
    close(cell_values(f, "RadiosityBack"), [[50, 20, 0]] * data.GetNumberOfCells(), 1e-9)


def test_lampshade_gives_what_it_does_not_keep():
    # 100 W in a closed shade in a room: emitted = absorbed, by either operator.
    ball = vtk.vtkSphereSource()
    ball.SetRadius(0.4)
    ball.SetCenter(1.5, 1.5, 1.5)
    inward = vtk.vtkReverseSense()
    inward.SetInputConnection(ball.GetOutputPort())
    inward.Update()
    walls = room(3, 2)
    append = vtk.vtkAppendPolyData()
    for data, rho, tau, both in ((walls, 0.6, 0, 0), (inward.GetOutput(), 0.35, 0.5, 1)):
        for name, value in (("DiffuseReflectance", rho), ("DiffuseTransmittance", tau),
                            ("TwoSided", both)):
            with_array(data, name, value)
        append.AddInputData(data)
    append.Update()
    shade = np.arange(append.GetOutput().GetNumberOfCells()) >= walls.GetNumberOfCells()
    for method in (DENSE, MONTE_CARLO):
        f = simulation(vtkRadiosityFilter, append.GetOutput(), lamp((1.5, 1.5, 1.5), 100 * K),
                       Method=method, RelativeTolerance=0.05)
        f.Update()
        a = areas(f.GetOutput(0))
        front, back = (cell_values(f, "Irradiance" + side) * a for side in ("", "Back"))
        inside, outside, on_walls = front[shade].sum(), back[shade].sum(), front[~shade].sum()
        close(inside, 100 + 0.35 * inside + 0.5 * outside, 1e-5)
        close(0.15 * (inside + outside) + 0.4 * on_walls, 100, 0.02)
        assert on_walls > 50 and not back[~shade].any()


def test_material_filter():
    for tau, expected in (((0, 0, 0), None), ((0.1, 0.2, 0.3), [0.1, 0.2, 0.3])):
        material = vtkSurfaceMaterialFilter()
        material.SetInputData(square(1))
        material.SetDiffuseTransmittance(tau)
        material.Update()
        cells = material.GetOutput().GetCellData()
        if expected is None:
            assert not cells.HasArray("DiffuseTransmittance")
        else:
            close(cells.GetArray("DiffuseTransmittance").GetTuple(0), expected)
    material.SetDiffuseTransmittance(0.1, 0.6, 0.3)
    fails(material, "DiffuseTransmittance", "1.1", "at most 1")


def test_errors_name_the_cell():
    for tau, words in (((0.1, 0.1, 0.8, 0.1), ("DiffuseTransmittance", "[2]", "1.1")),
                       ((0.1, -0.1, 0.2, 0.1), ("DiffuseTransmittance", "[1]", "-0.1")),
                       ((0.1, 0.1, 0.2, np.nan), ("DiffuseTransmittance", "[3]", "nan"))):
        for kind in (vtkRadiosityFilter, vtkIrradianceFilter):
            data = with_array(paper(), "DiffuseTransmittance", tau)
            fails(simulation(kind, data, sun((0, 0, -1), 1.0)), *words)


if __name__ == "__main__":
    run_all(globals())
