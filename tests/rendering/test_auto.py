# SPDX-License-Identifier: BSD-3-Clause
"""Shading Auto: no pixel farther from Phong than the tolerance, some triangles of each kind, a decision
that is kept, spread over frames and told."""
import math

import numpy as np

from drawing import Window, lights, polydata, run
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
from vtkmodules.vtkFiltersCore import vtkStripper, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkCompositeDataDisplayAttributes, vtkProperty

AT_ONCE = 1e30
TOLERANCE = 0.5 / 255
ROUNDING = 3e-6  # of float32, on top of the bound's exact arithmetic


def sphere(n=40, radius=0.9, center=(0, 0, 0)):
    source = vtkSphereSource()
    source.SetThetaResolution(n)
    source.SetPhiResolution(n)
    source.SetRadius(radius)
    source.SetCenter(*center)
    source.Update()
    return source.GetOutput()


def lamps(kind, count=10, distance=2.5):
    """Around the surface; kind: LightType."""
    records = []
    for i in range(count):
        z = 2 * (i + 0.5) / count - 1
        phi = 2.4 * i
        s = math.sqrt(1 - z * z)
        at = np.array((s * math.cos(phi), z, s * math.sin(phi)))
        records.append({
            "LightType": kind, "Position": tuple(distance * at), "Direction": tuple(-at),
            "Intensity": (6.0 / count,) * 3 if kind == 2 else (30.0 / count,) * 3,
            "SpotCutoff": 25 if kind == 1 else 180, "SpotExponent": 3 if kind == 1 else 0,
            "SpotInnerCutoff": 10 if kind == 1 else -1,
        })
    return lights(*records)


def stage(surface=None, kind=0, specular=0.0, at_once=True, size=200):
    w = Window(size)
    w.mapper.SetInputDataObject(surface or sphere())
    w.mapper.SetLightData(lamps(kind))
    w.mapper.SetShadingToAuto()
    if at_once:
        w.mapper.SetShadingTimeShare(AT_ONCE)
    w.actor.GetProperty().SetSpecular(specular)
    w.actor.GetProperty().SetSpecularPower(20)
    return w


def phong_of(w):
    w.mapper.SetShadingToPhong()
    picture = w.draw()
    w.mapper.SetShadingToAuto()
    return picture


def check(w):
    """At tolerances from all Phong to all Gouraud, some of which give triangles of both kinds."""
    phong = phong_of(w)
    assert phong[:, :, :3].max() > 0.1
    shares = []
    for tolerance in TOLERANCE * 2.0 ** np.arange(-6, 8):
        w.mapper.SetShadingTolerance(tolerance)
        auto = w.draw()
        used, share, reason = (w.mapper.GetShadingUsed(), w.mapper.GetGouraudShare(),
                               w.mapper.GetShadingReason())
        difference = np.abs(auto - phong).max()
        assert difference <= tolerance + ROUNDING, (difference, tolerance, reason)
        if used == 2:
            assert share == 0 and reason.startswith("Phong:"), reason
            assert difference == 0 or difference < ROUNDING
        elif used == 3:
            assert 0 < share < 1 and f"{100 * share:.2f} %" in reason, (share, reason)
            assert "PerTriangle" in w.mapper.GetShaderFeatures()
            assert difference > 0
            shares.append(share)
        else:
            assert share == 1
    assert shares and shares == sorted(shares), shares
    return shares[0]


def test_within_the_tolerance_of_phong():
    for kind in (0, 1, 2):
        for specular in (0.0, 0.5):
            check(stage(kind=kind, specular=specular))


def test_a_smaller_tolerance_gives_a_smaller_share():
    w = stage(kind=0)
    shares = []
    for tolerance in (1.0, 1e-2, 1e-3, 1e-4, 0.0):
        w.mapper.SetShadingTolerance(tolerance)
        w.draw()
        shares.append(w.mapper.GetGouraudShare())
    assert shares[0] == 1 and shares[-1] == 0 and shares == sorted(shares, reverse=True), shares
    assert w.mapper.GetShadingUsed() == 2 and w.mapper.GetShadingReason().startswith("Phong:")


def test_gouraud_everywhere_has_no_code_of_phong():
    w = stage(kind=0)
    w.mapper.SetShadingTolerance(0.5)
    w.draw()
    assert w.mapper.GetShadingUsed() == 1 and w.mapper.GetGouraudShare() == 1
    text = w.mapper.GetVertexShaderText() + w.mapper.GetFragmentShaderText()
    assert "radiometryShading" not in text and "normalVCVSOutput" not in text
    w.mapper.SetShadingTolerance(0)
    w.draw()
    text = w.mapper.GetVertexShaderText() + w.mapper.GetFragmentShaderText()
    assert "radiometryShading" not in text and "diffuseFront" not in text


def test_light_scale_counts():
    w = stage(kind=0)
    w.mapper.SetShadingTolerance(1e-2)
    w.draw()
    before = w.mapper.GetGouraudShare()
    w.mapper.SetLightScale(20)
    w.draw()
    assert w.mapper.GetGouraudShare() < before
    w.mapper.SetShadingTolerance(0.2)
    w.draw()
    assert w.mapper.GetGouraudShare() == before


def test_transforms_backs_strips_and_polygons():
    w = stage(specular=0.3)
    w.actor.SetScale(-1, 0.6, 1.3)  # a mirror, lengths of normals that differ
    w.actor.RotateZ(30)
    check(w)
    half = sphere()
    half = polydata([half.GetPoint(i) for i in range(half.GetNumberOfPoints())],
                    [tuple(half.GetCell(c).GetPointId(k) for k in range(3))
                     for c in range(half.GetNumberOfCells())
                     if half.GetPoint(half.GetCell(c).GetPointId(0))[2] < 0],
                    [half.GetPointData().GetNormals().GetTuple3(i)
                     for i in range(half.GetNumberOfPoints())])
    w = stage(half, specular=0.3)  # its inside is seen
    back = vtkProperty()
    back.SetDiffuseColor(0.2, 0.9, 0.4)
    back.SetSpecular(0.4)
    back.SetSpecularPower(5)
    w.actor.SetBackfaceProperty(back)
    check(w)
    triangles = vtkTriangleFilter()
    triangles.SetInputData(sphere())
    strips = vtkStripper()
    strips.SetInputConnection(triangles.GetOutputPort())
    strips.Update()
    assert strips.GetOutput().GetNumberOfStrips() > 0
    w = stage(strips.GetOutput(), specular=0.3)
    check(w)
    n = 14  # quads, and a polygon of five corners
    ticks = np.linspace(-0.8, 0.8, n + 1)
    points = [(x, y, 0.6 * math.cos(2 * x) * math.cos(2 * y)) for y in ticks for x in ticks]
    normals = [(1.2 * math.sin(2 * x) * math.cos(2 * y), 1.2 * math.cos(2 * x) * math.sin(2 * y), 1)
               for y in ticks for x in ticks]
    cells = [(j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i)
             for j in range(n) for i in range(n)]
    cells[3] = (*cells[3][:2], cells[3][2] + 1, *cells[3][2:])
    w = stage(polydata(points, cells, normals), kind=2, specular=0.3)
    check(w)
    w.actor.GetProperty().EdgeVisibilityOn()
    check(w)


def test_blocks_with_colours_and_one_hidden():
    blocks = vtkMultiBlockDataSet()
    for i, x in enumerate((-0.5, 0.0, 0.5)):
        blocks.SetBlock(i, sphere(24, 0.24, (x, 0, 0)))
    w = stage(blocks)
    attributes = vtkCompositeDataDisplayAttributes()
    w.mapper.SetCompositeDataDisplayAttributes(attributes)
    attributes.SetBlockColor(blocks.GetBlock(0), (1, 0.2, 0.2))
    attributes.SetBlockVisibility(blocks.GetBlock(1), False)
    attributes.SetBlockOpacity(blocks.GetBlock(2), 0.5)
    w.actor.GetProperty().SetDiffuseColor(0.1, 0.1, 0.1)
    check(w)


def test_far_from_the_origin():
    far = (5e5, 4e6, 300.0)
    w = stage(specular=0.3)
    w.mapper.SetShadingTolerance(1e-1)
    near = w.draw()
    share = w.mapper.GetGouraudShare()
    surface = sphere()
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for i in range(surface.GetNumberOfPoints()):
        points.InsertNextPoint(*(a + b for a, b in zip(surface.GetPoint(i), far)))
    surface.SetPoints(points)
    there = stage(surface, specular=0.3)
    there.mapper.SetShadingTolerance(1e-1)
    data = there.mapper.GetLightData()
    for i in range(data.GetNumberOfPoints()):
        data.GetPoints().SetPoint(i, *(a + b for a, b in zip(data.GetPoint(i), far)))
    camera = there.renderer.GetActiveCamera()
    camera.SetPosition(far[0], far[1], far[2] + 5)
    camera.SetFocalPoint(*far)
    camera.SetClippingRange(1, 10)
    picture = there.draw()
    assert abs(there.mapper.GetGouraudShare() - share) < 2e-3
    inside = (near[:, :, 3] == 1) & (picture[:, :, 3] == 1)
    assert inside.sum() > 10000
    difference = np.abs(picture - near)[inside].max()
    assert difference < 1e-1 + 2e-5, difference  # a triangle's kind may differ
    assert share > 0
    assert np.abs(phong_of(there) - phong_of(w))[inside].max() < 2e-5 * near.max()
    check(there)


def test_decided_over_frames_and_kept():
    w = stage(sphere(160), at_once=False, size=400)
    first = w.draw()
    assert w.mapper.GetShadingUsed() == 2 and w.mapper.GetGouraudShare() == 0
    frames = 1
    while w.mapper.GetShadingUsed() == 2:
        assert w.mapper.GetShadingReason().startswith("Phong:"), w.mapper.GetShadingReason()
        assert frames < 2000
        frames += 1
        picture = w.draw()
    assert frames > 2  # at least two to see that nothing changes
    assert np.abs(picture - first).max() <= TOLERANCE + ROUNDING
    builds = w.mapper.GetNumberOfShaderBuilds()
    used = w.mapper.GetShadingUsed()
    w.renderer.GetActiveCamera().Azimuth(20)  # a matte surface does not care who looks
    w.draw()
    w.renderer.GetActiveCamera().Azimuth(20)
    w.draw()
    assert w.mapper.GetShadingUsed() == used and w.mapper.GetNumberOfShaderBuilds() == builds


def test_what_changes_from_frame_to_frame_is_phong():
    w = stage(specular=0.5, at_once=False)
    for _ in range(5):
        w.renderer.GetActiveCamera().SetParallelProjection(False)
        w.renderer.GetActiveCamera().Azimuth(3)
        w.draw()
        assert w.mapper.GetShadingUsed() == 2
        assert "frame before" in w.mapper.GetShadingReason()


def test_other_lights_points_and_material_are_decided_anew():
    w = stage(kind=0)
    w.mapper.SetShadingTolerance(1e-2)

    def share():
        auto = w.draw()
        found = w.mapper.GetGouraudShare()
        phong = phong_of(w)
        assert np.abs(auto - phong).max() <= 1e-2 + ROUNDING
        return found

    shares = [share()]
    intensity = w.mapper.GetLightData().GetPointData().GetArray("Intensity")
    intensity.Fill(30.0)
    shares.append(share())
    w.actor.GetProperty().SetDiffuseColor(0.1, 0.1, 0.1)
    shares.append(share())
    assert shares[1] < shares[0] and shares[2] > shares[1], shares
    surface = w.mapper.GetInputDataObject(0, 0)
    for i in range(surface.GetNumberOfPoints()):  # nearer to the lights, the same normals
        x, y, z = surface.GetPoint(i)
        surface.GetPoints().SetPoint(i, 2 * x, 2 * y, 2 * z)
    surface.GetPoints().Modified()
    surface.Modified()
    shares.append(share())
    assert shares[3] < shares[2], shares
    w.mapper.SetInputDataObject(sphere(20))
    share()


def test_when_it_does_not_pay():
    w = stage(sphere(100), size=40)  # more points than pixels
    w.draw()
    assert w.mapper.GetShadingUsed() == 2 and "more points than pixels" in w.mapper.GetShadingReason()
    w = stage()
    w.mapper.GetInputDataObject(0, 0).GetPointData().SetNormals(None)
    w.draw()
    assert "without point normals" in w.mapper.GetShadingReason()
    w = stage()
    w.mapper.SetShadingToPhong()
    w.draw()
    assert w.mapper.GetShadingReason() == "as chosen" and w.mapper.GetGouraudShare() == 0
    w.mapper.SetShadingToGouraud()
    w.draw()
    assert w.mapper.GetGouraudShare() == 1


def test_greatest_difference_is_measured():
    w = stage(specular=0.5)
    w.mapper.SetShadingTolerance(1e-1)
    assert w.mapper.GetGreatestDifference() < 0
    assert w.mapper.MeasureGreatestDifference(None) < 0
    w.mapper.SetShadingTimeShare(0.03)
    w.draw()
    measured = w.mapper.MeasureGreatestDifference(w.renderer)
    assert 0 < measured <= 1e-1 + ROUNDING, measured
    assert w.mapper.GetGreatestDifference() == measured
    assert w.mapper.GetShading() == 3 and w.mapper.GetShadingTimeShare() == 0.03
    assert w.renderer.GetPass() is w.target
    w.mapper.SetShadingToGouraud()
    gouraud = w.mapper.MeasureGreatestDifference(w.renderer)
    picture = w.draw()
    assert gouraud > measured
    assert abs(gouraud - np.abs(picture - phong_of(w))[:, :, :3].max()) < 1e-6


run(globals())
