# SPDX-License-Identifier: BSD-3-Clause
"""One scene in a Radiometric View, for pvbatch and pvserver: view_scene.py FOLDER [URL].

Writes picture.png and linear.exr into FOLDER; glass.png and glass.exr with translucent light in front.
With a URL the work is done by the server there, rendering included.
"""
import os
import sys

from paraview import simple as pv

PLUGIN = os.path.join(os.environ["RADIOMETRY_BUILD_DIR"],
                      "lib/paraview/plugins/Radiometry/Radiometry.so")
SIZE = [160, 120]


def shown(source, view, **properties):
    display = pv.Show(source, view)
    display.Representation = "Radiometric Surface"
    display.ColorArrayName = ["POINTS", ""]
    for name, value in properties.items():
        setattr(display, name, value)
    return display


pv._DisableFirstRenderCameraReset()


def used_exposure(view):
    used = view.SMProxy.GetProperty("UsedExposure")
    view.SMProxy.UpdatePropertyInformation(used)
    return used.GetElement(0)


def make_scene(view, others=True):
    """Two lit surfaces under a lamp; with others a false-coloured column, its legend, the lamp drawn."""
    shown(pv.Sphere(ThetaResolution=40, PhiResolution=40), view,
                   DiffuseColor=[0.9, 0.5, 0.2], Specular=0.3)
    shown(pv.Plane(Origin=[-1, -1, -0.6], Point1=[1, -1, -0.6], Point2=[-1, 1, -0.6],
                   XResolution=8, YResolution=8), view, DiffuseColor=[0.8, 0.8, 0.8])
    if others:
        # A false-coloured body that stands in the sphere.
        column = pv.Elevation(Input=pv.Cylinder(Resolution=24, Height=1.6, Radius=0.15,
                                                Center=[0.3, 0, 0]),
                              LowPoint=[0, -0.8, 0], HighPoint=[0, 0.8, 0])
        coloured = pv.Show(column, view)
        coloured.Representation = "Surface"
        pv.ColorBy(coloured, ("POINTS", "Elevation"))
        coloured.SetScalarBarVisibility(view, True)
    lamp = pv.PointLight(Position=[1, -1, 1], Intensity=9.0)
    drawn = pv.Show(lamp, view)
    drawn.LightGlyphSize = 0.2
    drawn.ShowGlyphs = int(others)
    view.CameraPosition = [2, -3, 2]
    view.CameraFocalPoint = [0, 0, -0.1]
    view.CameraViewUp = [0, 0, 1]



def main(folder, url=None):
    if url:
        host, port = url.split(":")
        pv.Connect(host, int(port))
        pv.LoadPlugin(PLUGIN, remote=True, ns=vars(pv))
    pv.LoadPlugin(PLUGIN, remote=False, ns=vars(pv))
    view = pv.CreateView("RadiometricView")
    view.ViewSize = SIZE
    view.OrientationAxesVisibility = 0
    if url:
        view.RemoteRenderThreshold = 0
    make_scene(view)
    pv.Render(view)
    if url:
        assert view.GetClientSideObject().GetUseDistributedRenderingForRender()
    pv.SaveScreenshot(os.path.join(folder, "picture.png"), view, ImageResolution=SIZE)
    view.Samples = 2
    view.CaptureLinear = os.path.join(folder, "linear.exr")
    print("exposure", used_exposure(view))
    if not os.environ.get("RADIOMETRY_NO_GLASS"):
        draw_glass(folder, view)
    if url:
        pv.Disconnect()


def draw_glass(folder, view):
    shown(pv.Plane(Origin=[-1, -1, 0.7], Point1=[1, -1, 0.7], Point2=[-1, 1, 0.7], XResolution=4,
                   YResolution=4), view, DiffuseColor=[0.2, 0.5, 0.9], Opacity=0.5)
    view.Samples = 1
    pv.Render(view)
    pv.SaveScreenshot(os.path.join(folder, "glass.png"), view, ImageResolution=SIZE)
    view.CaptureLinear = os.path.join(folder, "glass.exr")


if __name__ == "__main__":
    main(*sys.argv[1:])
