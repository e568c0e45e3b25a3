#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How even is the light on the desks? The office's luminaires, a work plane, and the classes that
answer it, in the order of the data:

    ./run --python examples/office/office.py
"""
import os
import sys

from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
from vtkradiometry import (vtkIrradianceFilter, vtkPhotometricFileReader,
                           vtkRadiometricSceneReader, vtkRadiometricStatistics, vtkWorkPlaneSource)

HERE = os.path.dirname(os.path.abspath(__file__))
PLACES = ((1.5, 2.345, 2.1), (3.9, 2.345, 2.1))  # 5 mm under the luminaires' housings
UP = (0.0, 1.0, 0.0)                             # glTF: Y is up


def main(folder=None):
    """Prints the figures; with a folder, writes the plane and its lines there for ParaView."""
    room = vtkRadiometricSceneReader()
    room.SetFileName(os.path.join(HERE, "office.glb"))

    plane = vtkWorkPlaneSource()  # EN 12464-1 decides how many points
    plane.SetInputConnection(room.GetOutputPort(0))
    plane.SetUpDirection(UP)

    direct = vtkIrradianceFilter()
    direct.SetInputConnection(plane.GetOutputPort())
    direct.AddOccludersConnection(room.GetOutputPort(0))
    direct.PhotometricOn()
    for place in PLACES:
        luminaire = vtkPhotometricFileReader()
        luminaire.SetFileName(os.path.join(HERE, "office.ies"))
        luminaire.SetPosition(place)
        luminaire.SetDirection([-u for u in UP])
        direct.AddLightsConnection(luminaire.GetOutputPort())

    statistics = vtkRadiometricStatistics()
    statistics.SetInputConnection(direct.GetOutputPort())
    statistics.SetArrayName("Illuminance")
    statistics.SetThreshold(500.0)
    statistics.Update()

    table = statistics.GetOutputDataObject(0)
    figures = {table.GetColumnName(k): table.GetValue(0, k).ToString()
               for k in range(table.GetNumberOfColumns())}
    for name in ("Mean", "Minimum", "Maximum", "U0", "Ud", "ShareAbove", "Cells"):
        print(f"{name:11}{float(figures[name]):.4g}")
    levels = statistics.GetOutputDataObject(2)
    for k in range(levels.GetNumberOfRows()):
        print(f"{levels.GetValueByName(k, 'Label').ToString():>8}: on "
              f"{100 * levels.GetValueByName(k, 'ShareAbove').ToDouble():.0f} % of the plane")
    if folder:
        for port, name in ((1, "office-lines.vtp"), (3, "office-plane.vtp")):
            writer = vtkXMLPolyDataWriter()
            writer.SetFileName(os.path.join(folder, name))
            writer.SetInputDataObject(statistics.GetOutputDataObject(port))
            writer.SetDataModeToBinary()
            writer.Write()


if __name__ == "__main__":
    main(*sys.argv[1:2])
