# SPDX-License-Identifier: BSD-3-Clause
"""In ParaView: the shadows that Irradiance and Radiosity know are in the picture of the shown lights."""
import numpy as np

from paraview_scene import check, new_view, picture, pixel, pv, run, show_lights


def shadowed(kind, view, **properties):
    """A floor under a lid over x < 0.1 and the light of a lamp above."""
    plane = pv.Plane(Origin=[-0.9, -0.9, 0], Point1=[0.9, -0.9, 0], Point2=[-0.9, 0.9, 0],
                     XResolution=18, YResolution=18)
    lid = pv.Plane(Origin=[-9, -9, 0.5], Point1=[0.1, -9, 0.5], Point2=[-9, 9, 0.5])
    lamp = pv.PointLight(Position=[0.1, 0.0, 1.0], Intensity=2.0)
    simulated = kind(Input=plane, Lights=lamp, Occluders=lid, LightVisibility=1, **properties)
    shown = pv.Show(simulated, view)
    shown.Representation = "Radiometric Surface"
    shown.ColorArrayName = ["POINTS", ""]
    shown.DiffuseColor = [1, 1, 1]
    show_lights(lamp, view)
    return shown


def test_shadows_of_the_simulation():
    for kind, location in ((pv.Irradiance, "Cells"), (pv.Radiosity, "Points")):
        view = new_view()
        shown = shadowed(kind, view, SampleLocation=location)
        shown.FieldDisplay = "Lit by the lights"
        known = picture(view)
        shown.UseLightVisibility = 0
        without = picture(view)
        check(known[pixel(-0.5, 0.3)].max() == 0, kind, known[pixel(-0.5, 0.3)])
        check(without[pixel(-0.5, 0.3)].min() > 40, kind, without[pixel(-0.5, 0.3)])
        lit = pixel(0.5, 0.3)
        check(np.abs(known[lit] - without[lit]).max() <= 1, kind, known[lit], without[lit])
        check(known[lit].min() > 40, kind)


run(globals())
