# SPDX-License-Identifier: BSD-3-Clause
"""Draws what test_paraview_servers.py compares: run by pvpython, against a server or alone.

    servers_scene.py FOLDER [PORT [STATE]]    writes local.png, remote.png, moved.png and a state;
                                              with a STATE, state.png from it and nothing else
"""
import os
import sys

from paraview import simple as pv

plugin = os.path.join(os.environ["RADIOMETRY_BUILD_DIR"],
                      "lib/paraview/plugins/Radiometry/Radiometry.so")
folder = sys.argv[1]
if len(sys.argv) > 2:
    pv.Connect("localhost", int(sys.argv[2]))
    pv.LoadPlugin(plugin, remote=True, ns=vars(pv))
pv.LoadPlugin(plugin, remote=False, ns=vars(pv))
pv._DisableFirstRenderCameraReset()


def draw(name, view):
    pv.SaveScreenshot(os.path.join(folder, name + ".png"), view, ImageResolution=[200, 200])


def selected(view, source):
    """The ids of the cells in the middle of the picture."""
    pv.SelectSurfaceCells(Rectangle=[90, 90, 110, 110], View=view)
    picked = pv.ExtractSelection(Input=source)
    picked.UpdatePipeline()
    number = picked.GetDataInformation().GetNumberOfCells()
    pv.Delete(picked)
    pv.ClearSelection(source)
    return number


def compose():
    view = pv.CreateView("RenderView")
    view.ViewSize = [200, 200]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = [0, 0, 0]
    view.CameraPosition = [0.4, 0.3, 3.5]
    view.CameraFocalPoint = [0, 0, 0]
    sphere = pv.Sphere(ThetaResolution=40, PhiResolution=40)
    floor = pv.Plane(Origin=[-1, -1, -0.6], Point1=[1, -1, -0.6], Point2=[-1, 1, -0.6],
                     XResolution=8, YResolution=8)
    material = pv.SurfaceMaterial(Input=floor)
    material.DiffuseReflectance = [0.8, 0.6, 0.4]
    for source in (sphere, material):
        shown = pv.Show(source, view)
        shown.Representation = "Radiometric Surface"
        shown.ColorArrayName = ["POINTS", ""]
        shown.DiffuseColor = [1, 1, 1]
        shown.ShadingTimeShare = 1e6  # the same bytes each time
        shown.Specular = 0.2
    lamp = pv.PointLight(Position=[1, 1, 1], Intensity=1.5)
    spot = pv.SpotLight(Position=[-1, 0.5, 1], Direction=[1, -0.5, -1], Intensity=1.5, Cutoff=15,
                        Color=[1, 0.7, 0.4])
    for source in (lamp, spot):
        pv.Show(source, view).Representation = "Radiometric Lights"

    view.RemoteRenderThreshold = 1e9  # MB: draw here
    draw("local", view)
    view.RemoteRenderThreshold = 0  # draw there
    draw("remote", view)
    if len(sys.argv) > 2:
        used = view.SMProxy.GetClientSideObject().GetUseDistributedRenderingForRender()
        assert used, "nothing was drawn remotely"
    number = selected(view, sphere)
    lamp.Position = [-0.2, 0.8, 1.2]
    pv.Hide(spot, view)
    draw("moved", view)
    pv.Show(spot, view)
    lamp.Position = [1, 1, 1]
    pv.SaveState(os.path.join(folder, "servers.pvsm"))
    with open(os.path.join(folder, "selected.txt"), "w") as file:
        file.write(str(number))


if len(sys.argv) > 3:
    pv.LoadState(sys.argv[3])
    draw("state", pv.GetRenderViews()[0])
else:
    compose()
