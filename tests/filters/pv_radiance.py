# SPDX-License-Identifier: BSD-3-Clause
"""Radiance and Reflectance Lobe as a user of ParaView's Python meets them; occluders of View Factors."""
import os

from paraview import servermanager
from paraview.simple import *

LoadDistributedPlugin("Radiometry", remote=False, ns=globals())


def field(proxy, name):
    return servermanager.Fetch(proxy).GetFieldData().GetArray(name).GetTuple(0)


def output(proxy, port=0):
    proxy.UpdatePipeline()
    return proxy.GetClientSideObject().GetOutputDataObject(port)


plane = Plane(XResolution=4, YResolution=4)
light = PointLight(Position=[0.2, 0.1, 1.0], Intensity=10.0)
surface = Irradiance(Input=plane, Lights=light)
radiance = Radiance(Input=surface, Lights=light)
radiance.UpdatePipeline()
assert field(radiance, "ViewPoint")[2] > 1.0, "an eye that sees it all"
assert radiance.CellData["Radiance"].GetRange()[0] > 0.0
plan = output(radiance, 1)
effects = [plan.GetValueByName(k, "Effect").ToString() for k in range(plan.GetNumberOfRows())]
assert {"Occlusion", "Interreflection", "SpecularTransport", "Transmission", "BackFaces", "Emission",
        "Environment", "SpotShape", "Attenuation"} <= set(effects), effects
radiance.ViewPoint = [0.5, 0.5, 3.0]
radiance.UpdatePipeline()
assert field(radiance, "ViewPoint") == (0.5, 0.5, 3.0)
radiance.ViewDirection = [0.0, 0.0, -1.0]
radiance.UpdatePipeline()
assert field(radiance, "ViewDirection") == (0.0, 0.0, -1.0)
assert "SolidAngle" not in radiance.CellData.keys()
radiance.ViewPoint = [0.0, 0.0, 0.0]
radiance.ViewFrom = "Point"
radiance.UpdatePipeline()
assert field(radiance, "ViewPoint") == (0.0, 0.0, 0.0)

# The camera of a scene file.
scene = RadiometricSceneReader(FileName=os.path.join(
    os.environ["RADIOMETRY_SOURCE_DIR"], "examples", "cornell-box", "cornell-box.glb"))
seen = Radiance(Input=Irradiance(Input=OutputPort(scene, 0), Lights=OutputPort(scene, 1)),
                Lights=OutputPort(scene, 1), Camera=OutputPort(scene, 2), Photometric=1)
seen.UpdatePipeline()
assert abs(field(seen, "ViewPoint")[2] + 0.8) < 1e-6, field(seen, "ViewPoint")
assert seen.CellData["Luminance"].GetRange()[1] > 0.0
seen.Camera = None
seen.UpdatePipeline()
assert abs(field(seen, "ViewPoint")[2] + 0.8) > 1e-3

lobe = ReflectanceLobe(Shininess=1000.0, LogScale=1)
lobe.UpdatePipeline()
assert lobe.PointData["BRDF"].GetRange()[1] > 40.0
assert field(lobe, "DirectionalHemisphericalReflectance")[0] < 0.6

factors = ViewFactors(Input=Sphere(), Occluders=[Plane()])
factors.UpdatePipeline()
assert factors.GetClientSideObject().GetNumberOfInputConnections(1) == 1
print("passed")
