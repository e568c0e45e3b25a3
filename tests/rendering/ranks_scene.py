# SPDX-License-Identifier: BSD-3-Clause
"""Draws one scene into the PNG named by the first argument; run by pvbatch from test_ranks.py."""
import os
import sys

from paraview import simple as pv

plugin = os.path.join(os.environ["RADIOMETRY_BUILD_DIR"],
                      "lib/paraview/plugins/Radiometry/Radiometry.so")
pv.LoadPlugin(plugin, remote=False, ns=vars(pv))
view = pv.CreateView("RenderView")
view.ViewSize = [200, 200]
view.OrientationAxesVisibility = 0
view.UseColorPaletteForBackground = 0
view.BackgroundColorMode = "Single Color"
view.Background = [0, 0, 0]
sphere = pv.Show(pv.Sphere(ThetaResolution=40, PhiResolution=40), view)
floor = pv.Show(pv.Plane(Origin=[-1, -1, -0.6], Point1=[1, -1, -0.6], Point2=[-1, 1, -0.6]), view)
for shown in (sphere, floor):
    shown.Representation = "Radiometric Surface"
    shown.ColorArrayName = ["POINTS", ""]
    shown.DiffuseColor = [1, 1, 1]
    shown.ShadingTimeShare = 1e6  # the same bytes each time
    shown.Specular = 0.3
for lamp in (pv.PointLight(Position=[1, 1, 1], Intensity=1.5),
             pv.SpotLight(Position=[-1, 0.5, 1], Direction=[1, -0.5, -1], Intensity=1.5,
                          Cutoff=15)):
    shown = pv.Show(lamp, view)
    shown.Representation = "Radiometric Lights"
pv.ResetCamera(view)
pv.SaveScreenshot(sys.argv[1], view, ImageResolution=[200, 200])
