# SPDX-License-Identifier: BSD-3-Clause
"""A ParaView pipeline on several ranks beside the values of one; run by test_ranks_irradiance.py.
First argument: a file; it is written when missing, and compared with when there."""
import json
import os
import sys

import numpy as np  # ParaView's programmable sources put a max() of their own in the main module
from paraview import servermanager
from paraview import simple as pv
from vtkmodules.util.numpy_support import vtk_to_numpy

plugin = os.path.join(os.environ["RADIOMETRY_BUILD_DIR"],
                      "lib/paraview/plugins/Radiometry/Radiometry.so")
pv.LoadPlugin(plugin, remote=False, ns=vars(pv))
ranks = servermanager.vtkProcessModule.GetProcessModule().GetNumberOfLocalPartitions()

# Each rank makes its own part, with ghost cells and ids: nothing here is sent through VTK's XML, which
# VTK 9.2 cannot read back with some versions of expat (VTK issue 19258).
SCRIPT = """
import sys
sys.path.insert(0, {folder!r})
from rank_parts import Scene, rank, size
scene = (Scene().add_grid((-0.5, -0.4, 0.1), (0.9, -0.1, 0), (0, 0.7, 0.5), 8)
         .add_grid((-1, -1, -0.6), (2, 0, 0), (0, 2, 0), 12))
owner = [(7 * c + c // 5) % size() for c in range(len(scene.polygons))]
self.GetOutputDataObject(0).ShallowCopy(scene.part(owner, rank())[0])
"""
parted = pv.ProgrammableSource(
    OutputDataSetType="vtkPolyData",
    Script=SCRIPT.format(folder=os.path.dirname(os.path.abspath(__file__))))
lamp = pv.PointLight(Position=[1, 1, 1.5], Intensity=2.0)
spot = pv.SpotLight(Position=[-1, 0.5, 1], Direction=[1, -0.5, -1.2], Intensity=2.0, Cutoff=25)
seen = {}
for name, filtered in (("Irradiance", pv.Irradiance), ("Radiosity", pv.Radiosity)):
    f = filtered(Input=parted, Lights=[lamp, spot])
    if name == "Radiosity":
        f.Method = "Dense"
        f.Refinement = "Off"
    statistics = pv.RadiometricStatistics(Input=f, Percentiles=[10, 50, 90])
    for output in (f, statistics):
        output.UpdatePipeline()
    out = servermanager.Fetch(f)
    polydata = out if out.IsA("vtkDataSet") else out.NewIterator().GetCurrentDataObject()
    cells = polydata.GetCellData()
    ids = vtk_to_numpy(cells.GetArray("GlobalCellIds"))
    ghosts = cells.GetArray("vtkGhostType")
    values = vtk_to_numpy(cells.GetArray("Irradiance"))
    by_id = {int(i): float(v) for k, (i, v) in enumerate(zip(ids, values))
             if not ghosts or ghosts.GetValue(k) == 0}
    seen[name] = [by_id[i] for i in sorted(by_id)]
    for port, table in ((1, "EffectPlan"), (2, "Convergence")):
        fetched = servermanager.Fetch(f, idx=port)
        while fetched.IsA("vtkCompositeDataSet"):
            fetched = fetched.NewIterator().GetCurrentDataObject()
        seen[f"{name}.{table}"] = fetched.GetNumberOfRows()
    fetched = servermanager.Fetch(statistics)
    while fetched.IsA("vtkCompositeDataSet"):
        fetched = fetched.NewIterator().GetCurrentDataObject()
    seen[f"{name}.Statistics"] = [
        [fetched.GetValue(r, c).ToString() for c in range(fetched.GetNumberOfColumns())]
        for r in range(fetched.GetNumberOfRows())]

if not os.path.exists(sys.argv[1]):
    with open(sys.argv[1], "w") as file:
        json.dump(seen, file)
else:
    with open(sys.argv[1]) as file:
        expected = json.load(file)
    for name, value in expected.items():
        if isinstance(value, int) or name.endswith("Statistics"):
            continue
        scale = np.max(value)
        assert len(seen[name]) == len(value), (name, len(seen[name]))
        worst = np.max(np.abs(np.subtract(seen[name], value)))
        print(name, len(value), "values, greatest difference", worst / scale)
        assert worst <= 1e-12 * scale
    for name in expected:
        if name.endswith("EffectPlan") or name.endswith("Convergence"):
            print(name, seen[name], expected[name])
            assert seen[name] == expected[name], name
        if name.endswith("Statistics"):
            assert len(seen[name]) == len(expected[name]) > 0
            for mine, one in zip(seen[name], expected[name]):
                assert mine == one, (name, mine, one)  # six digits
print("all checks passed")
