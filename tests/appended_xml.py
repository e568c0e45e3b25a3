# SPDX-License-Identifier: BSD-3-Clause
"""Whether this VTK reads its own appended XML (9.2 does not with some versions of expat: VTK 19258).

ParaView sends translucent pieces between ranks in it.
"""
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter


def reads_appended_xml():
    plane = vtkPlaneSource()
    plane.SetResolution(40, 40)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(plane.GetOutputPort())
    writer.WriteToOutputStringOn()
    writer.Write()
    reader = vtkXMLPolyDataReader()
    reader.ReadFromInputStringOn()
    reader.SetInputString(writer.GetOutputString())
    warnings = vtkObject.GetGlobalWarningDisplay()
    vtkObject.GlobalWarningDisplayOff()
    try:
        reader.Update()
    finally:
        vtkObject.SetGlobalWarningDisplay(warnings)
    return reader.GetOutput().GetNumberOfCells() == 1600
