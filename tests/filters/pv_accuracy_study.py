# SPDX-License-Identifier: BSD-3-Clause
"""Accuracy Study in ParaView: Irradiance, the study behind it, a line chart of its curves."""
import os
import sys
import tempfile

import display

display.ensure()

import numpy as np  # noqa: E402
from paraview import servermanager  # noqa: E402
from paraview import simple as pv  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader  # noqa: E402

# Arguments: [PORT of a server] [--keep FILE.png]
arguments = sys.argv[1:]
keep = arguments.pop(arguments.index("--keep") + 1) if "--keep" in arguments else None
plugin = os.path.join(os.environ["RADIOMETRY_BUILD_DIR"],
                      "lib/paraview/plugins/Radiometry/Radiometry.so")
if arguments and arguments[0].isdigit():
    pv.Connect("localhost", int(arguments[0]))
    pv.LoadPlugin(plugin, remote=True, ns=vars(pv))
pv.LoadPlugin(plugin, remote=False, ns=vars(pv))

plane = pv.Plane(XResolution=12, YResolution=12)
screen = pv.Plane(Origin=[-0.2, -0.2, 0.4], Point1=[0.2, -0.2, 0.4], Point2=[-0.2, 0.2, 0.4])
light = pv.AreaLight(Position=[0.1, 0.2, 1.0], Direction=[0, 0, -1], Intensity=10.0)
irradiance = pv.Irradiance(Input=plane, Lights=light, Occluders=screen)
study = pv.AccuracyStudy(Input=irradiance)
assert list(study.Tolerances) == [0.1, 0.05, 0.02, 0.01, 0.005], list(study.Tolerances)
study.Tolerances = [0.2, 0.1, 0.05, 0.01, 0.005, 0.002]
study.FloatComparison = 1
study.UpdatePipeline()


def fetch(port):
    data = servermanager.Fetch(study, idx=port)
    while data.IsA("vtkCompositeDataSet"):  # what several ranks deliver
        data = data.NewIterator().GetCurrentDataObject()
    return data


runs, curves = fetch(0), fetch(3)
assert runs.GetNumberOfRows() == 6, runs.GetNumberOfRows()
assert [curves.GetColumnName(k) for k in range(3)] == ["Time", "EstimatedError", "TrueError"]
assert curves.GetNumberOfRows() == 5
assert fetch(1).GetNumberOfRows() >= 15
assert irradiance.RelativeTolerance == 0.01

# Where ParaView's window shows each output on Apply.
controller = servermanager.vtkSMParaViewPipelineControllerWithRendering()
preferred = [controller.GetPreferredViewType(study.SMProxy, port) for port in range(4)]
assert preferred == ["SpreadSheetView", "None", "None", "XYChartView"], preferred

# What a line chart shows without being told: both errors against the time.
chart = pv.CreateView("XYChartView")
chart.ViewSize = [900, 600]
shown = pv.Show(pv.OutputPort(study, 3), chart)
assert shown.UseIndexForXAxis == 0 and shown.XArrayName == "Time", shown.XArrayName
visible = list(shown.SeriesVisibility)
assert sorted(v for v in visible if v not in "01") == ["EstimatedError", "TrueError"], visible
chart.LeftAxisLogScale = chart.BottomAxisLogScale = 1
chart.LeftAxisTitle = "relative error"
chart.BottomAxisTitle = "seconds"
chart.ChartTitle = "What accuracy costs"
shown.SeriesLabel = ["EstimatedError", "estimated", "TrueError", "true"]
shown.SeriesColor = ["EstimatedError", "0.12", "0.47", "0.71", "TrueError", "0.85", "0.37", "0.01"]
shown.SeriesMarkerStyle = ["EstimatedError", "4", "TrueError", "4"]
shown.SeriesMarkerSize = ["EstimatedError", "8", "TrueError", "8"]
pv.Render(chart)
with tempfile.TemporaryDirectory() as folder:
    path = keep or os.path.join(folder, "chart.png")
    pv.SaveScreenshot(path, chart)
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(float)
for color in ((0.12, 0.47, 0.71), (0.85, 0.37, 0.01)):
    count = (np.abs(pixels / 255.0 - color).max(axis=1) < 0.1).sum()
    assert count > 300, (color, count)  # a line across the chart and its markers
# The warning that logarithmic axes are out of place is a red box over the middle.
red = (np.abs(pixels / 255.0 - (0.65, 0.16, 0.16)).max(axis=1) < 0.05).mean()
assert red < 0.01, red
print("all checks passed")
