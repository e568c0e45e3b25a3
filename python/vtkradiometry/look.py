# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's view through a camera of a scene file (pvpython, pvbatch, ParaView's Python shell)."""


def look_through(scene, view=None, camera=0):
    """Sets the camera of `view` (the active one by default) to number `camera` of the file that `scene`, a
    Radiometric Scene Reader, has read; without such a camera an IndexError names how many there are."""
    from paraview import servermanager, simple

    view = view or simple.GetActiveViewOrCreate("RenderView")
    scene.UpdatePipeline()
    cameras = servermanager.Fetch(scene, idx=2)  # its output "Cameras"
    number = cameras.GetNumberOfPoints()
    if not 0 <= camera < number:
        raise IndexError(f"camera {camera}: the scene has {number}")

    def value(name):
        return cameras.GetPointData().GetArray(name).GetTuple(camera)

    view.CameraPosition = cameras.GetPoint(camera)
    view.CameraFocalPoint = value("FocalPoint")
    view.CameraViewUp = value("ViewUp")
    view.CameraViewAngle = value("ViewAngle")[0]
    view.CameraParallelProjection = int(value("ParallelProjection")[0])
    if view.CameraParallelProjection:
        view.CameraParallelScale = value("ParallelScale")[0]
    simple._DisableFirstRenderCameraReset()
