# SPDX-License-Identifier: BSD-3-Clause
"""What people do with ParaView: undo, states, several views, selection, large pictures, interaction,
time, blocks, and every kind of data, all with "Radiometric Surface"."""
import math
import os

import numpy as np

from paraview_scene import (
    FOLDER,
    SIZE,
    check,
    expect,
    new_plane,
    new_view,
    picture,
    pixel,
    pv,
    radiance,
    run,
    show_lights,
    show_surface,
)
from paraview import smstate
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkRectilinearGrid
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLRectilinearGridWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter
from vtkradiometry.look import look_through

WHITE = math.pi  # of a sun that makes a white matte surface show 1


def sun(power, view):
    source = pv.DirectionalLight(Direction=[0, 0, -1], Intensity=power * WHITE)
    return source, show_lights(source, view)


def written_plane(file_name, columns, arrays, height=None):
    """A file with the square of new_plane() in `columns` x `columns` cells, with arrays on them; bent
    where there is a height(x, y)."""
    plane = vtkPlaneSource()
    plane.SetOrigin(-0.9, -0.9, 0)
    plane.SetPoint1(0.9, -0.9, 0)
    plane.SetPoint2(-0.9, 0.9, 0)
    plane.SetResolution(columns, columns)
    plane.Update()
    data = plane.GetOutput()
    for k in range(data.GetNumberOfPoints() if height else 0):
        x, y, _ = data.GetPoint(k)
        data.GetPoints().SetPoint(k, x, y, height(x, y))
    for name, values in arrays.items():
        array = numpy_to_vtk(np.asarray(values), deep=True)
        array.SetName(name)
        data.GetCellData().AddArray(array)
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()  # see tests/appended_xml.py
    writer.SetFileName(os.path.join(FOLDER, file_name))
    writer.SetInputData(data)
    writer.Write()
    return writer.GetFileName()


def cells_with(name, values):
    """Two by two cells with these values, from the lower left."""
    return pv.XMLPolyDataReader(FileName=[written_plane(name + ".vtp", 2, {name: values})])


def test_the_data_decides_what_is_shown():
    view = new_view()
    _, lights = sun(0.5, view)
    k = 683.002
    corner = (-0.45, -0.45)
    cases = (
        ("Temperature", 0.3, 0.5, "material of the property, lit"),
        ("DiffuseReflectance", 0.3, 0.15, "materials of the data, lit"),
        ("EmittedExitance", 0.4 * math.pi, 0.4 + 0.5, "materials of the data, lit"),
        ("Radiosity", 0.3 * math.pi, 0.3, "Radiosity as light"),
        ("Radiance", 0.3, 0.3, "Radiance as light"),
        ("LuminousExitance", 0.3 * math.pi * k, 0.3, "LuminousExitance as light"),
        ("Luminance", 0.3 * k, 0.3, "Luminance as light"),
    )
    for name, value, shows, words in cases:
        source = cells_with(name, [value, value / 2] * 2)
        surface = show_surface(source, view)
        surface.SmoothCells = 0
        expect(picture(view), *corner, shows)
        surface.SMProxy.UpdatePropertyInformation()
        check(surface.FieldUsed == words, name, surface.FieldUsed)
        check(surface.ShadingUsed in ("Gouraud", "Phong", "Auto"), surface.ShadingUsed)
        # Lit by choice, with the property's material by choice.
        surface.FieldDisplay = "Lit by the lights"
        surface.MaterialSource = "Color and specular below"
        expect(picture(view), *corner, 0.5)
        surface.MaterialSource = "Arrays of the data"
        surface.FieldDisplay = "Auto"
        surface.FieldScale = 0.5
        expect(picture(view), *corner, shows / 2 if "as light" in words else shows)
        pv.Delete(surface)
        pv.Delete(source)
    check(lights.Illuminate == 1)
    # A block that has light, and one that has none: black, as the mapper says.
    both = pv.GroupDatasets(Input=[cells_with("Radiosity", [0.4 * math.pi] * 4),
                                   pv.Plane(Origin=[0, 0, 0.1], Point1=[0.9, 0, 0.1],
                                            Point2=[0, 0.9, 0.1])])
    surface = show_surface(both, view)
    image = picture(view)
    expect(image, -0.45, -0.45, 0.4)
    expect(image, 0.45, 0.45, 0.0)
    pv.Delete(surface)
    pv.Delete(view)


def test_light_of_cells_is_smooth_on_smooth_surfaces():
    view = new_view()
    source = cells_with("Radiance", [0.2, 0.4, 0.6, 0.8])
    surface = show_surface(source, view)
    image = picture(view)
    expect(image, 0.0, 0.0, 0.5)  # where four cells meet: their mean
    expect(image, 0.87, -0.87, 0.4, 4.0)  # a corner that one cell has
    expect(image, 0.0, -0.87, 0.3, 4.0)  # where two meet
    for k in range(10):  # and linear along an edge
        x = 0.005 + 0.09 * k
        expect(image, x, 0.0, 0.5 + 0.1 * x / 0.9, 2.0)
    pv.Render(view)
    pv.SelectSurfaceCells(Rectangle=[140, 140, 150, 150], View=view)
    picked = pv.ExtractSelection(Input=source)
    picked.UpdatePipeline()
    data = pv.servermanager.Fetch(picked)
    check(data.GetNumberOfCells() == 1)
    check(abs(data.GetCellData().GetArray("Radiance").GetValue(0) - 0.8) < 1e-9)
    pv.ClearSelection(source)
    surface.SmoothCells = 0
    expect(picture(view), 0.1, 0.1, 0.8)
    surface.SmoothCells = 1
    check((picture(view) == image).all())
    pv.Hide(source, view)
    # Nothing is averaged over the ridge of a roof, nor between materials.
    roof = pv.XMLPolyDataReader(FileName=[written_plane("roof.vtp", 2, {
        "Radiance": [0.2, 0.6, 0.2, 0.6]}, height=lambda x, y: -abs(x))])
    show_surface(roof, view)
    image = picture(view)
    expect(image, -0.01, 0.2, 0.2)
    expect(image, 0.01, 0.2, 0.6)
    pv.Delete(view)
    view = new_view()
    two = written_plane("materials.vtp", 2, {"Radiance": [0.2, 0.4, 0.6, 0.8],
                                             "MaterialIndex": np.array([0, 0, 1, 1])})
    show_surface(pv.XMLPolyDataReader(FileName=[two]), view)
    image = picture(view)
    expect(image, 0.0, -0.01, 0.3, 1.5)
    expect(image, 0.0, 0.01, 0.7, 1.5)
    pv.Delete(view)


def test_auto_shading_tells_what_it_did():
    """Fine cells under a distant light: a bound allows Gouraud for all of them, and a tolerance of 0 for
    none."""
    view = new_view()
    surface = show_surface(new_plane(100), view)
    show_lights(pv.PointLight(Position=[0, 0, 5], Intensity=10), view)
    surface.ShadingTimeShare = 1e6  # decide before the frame
    pictures = []
    for tolerance, share in ((0.00196, 1.0), (0.0, 0.0)):
        surface.ShadingTolerance = tolerance
        pictures.append(picture(view))
        surface.SMProxy.UpdatePropertyInformation()
        check(abs(surface.GouraudShare - share) < 1e-9, tolerance, surface.GouraudShare)
        check(surface.ShadingUsed == ("Gouraud" if share else "Phong"), surface.ShadingUsed)
        check(surface.ShadingReason != "")
    check(np.abs(pictures[0] - pictures[1]).max() <= 1)
    pv.Delete(view)


def test_shadows_highlights_and_false_color():
    view = new_view()
    floor = new_plane(18)
    lamp = pv.PointLight(Position=[0, 0, 1], Intensity=1.0)
    blocker = pv.Plane(Origin=[-0.2, -0.2, 0.5], Point1=[0.2, -0.2, 0.5], Point2=[-0.2, 0.2, 0.5])
    direct = pv.Irradiance(Input=floor, Lights=lamp, Occluders=blocker)
    direct.LightVisibility = 1
    surface = show_surface(direct, view)
    show_lights(lamp, view)
    image = picture(view)  # the shadow is the square of half 0.4
    expect(image, 0.03, 0.03, 0.0)
    expect(image, 0.65, 0.2, radiance(1.0, 1.0, 0.65, 0.2))
    surface.UseLightVisibility = 0
    expect(picture(view), 0.03, 0.03, radiance(1.0, 1.0, 0.03, 0.03))
    pv.Hide(direct, view)

    matte = cells_with("Radiosity", [0.2 * math.pi] * 4)
    surface = show_surface(matte, view)
    lamp.Intensity = 0.2
    surface.Specular = 0.5
    surface.SpecularPower = 20
    bright = picture(view)
    check(bright[pixel(0, 0)].min() > 0.2 * 255 + 5, bright[pixel(0, 0)])
    surface.Highlights = 0
    expect(picture(view), 0, 0, 0.2)
    pv.Hide(matte, view)

    field = pv.Calculator(Input=floor, ResultArrayName="T", Function="coordsX")
    surface = show_surface(field, view)
    surface.FieldDisplay = "False color"
    pv.ColorBy(surface, ("POINTS", "T"))
    colors = pv.GetColorTransferFunction("T")
    colors.RescaleTransferFunction(-1.0, 1.0)
    image = picture(view)
    for x in (-0.705, -0.205, 0.305, 0.805):
        legend = [0.0, 0.0, 0.0]
        colors.SMProxy.GetClientSideObject().GetColor(x, legend)
        expect(image, x, 0.3, legend, 2.0)
    surface.SMProxy.UpdatePropertyInformation()
    check(surface.FieldUsed == "scalars through their colour map", surface.FieldUsed)
    pv.Delete(view)


def test_undo_and_redo():
    stack = pv.servermanager.vtkSMUndoStack()
    builder = pv.servermanager.vtkSMUndoStackBuilder()
    builder.SetUndoStack(stack)
    manager = pv.servermanager.vtkSMProxyManager.GetProxyManager()
    manager.SetUndoStackBuilder(builder)  # before the objects whose changes it tells
    view = new_view()
    surface = show_surface(new_plane(), view)
    source, _ = sun(0.5, view)

    def step(undo_or_redo):
        """As ParaView's window does it: the states, then the objects."""
        builder.SetIgnoreAllChanges(True)
        undo_or_redo()
        pv.servermanager.ProxyManager().SMProxyManager.UpdateRegisteredProxies(0)
        builder.SetIgnoreAllChanges(False)

    def change(label, function):
        before = picture(view)
        builder.Begin(label)
        function()
        builder.End()
        builder.PushToStack()
        after = picture(view)
        check(np.abs(after - before).max() > 5, label, "shows nothing")
        step(stack.Undo)
        check((picture(view) == before).all(), label, "undo")
        step(stack.Redo)
        check((picture(view) == after).all(), label, "redo")

    change("brightness", lambda: setattr(surface, "LightBrightness", 0.4))
    change("model", lambda: setattr(surface, "ReflectionModel", "Blinn-Phong (legacy)"))
    change("field", lambda: setattr(surface, "FieldDisplay", "Normals"))
    change("representation", lambda: setattr(surface, "Representation", "Wireframe"))
    step(stack.Undo)
    check(surface.Representation == "Radiometric Surface", surface.Representation)
    change("light", lambda: (setattr(surface, "FieldDisplay", "Auto"),
                             setattr(source, "Intensity", 0.1)))
    manager.SetUndoStackBuilder(None)
    pv.Delete(view)


def test_states():
    """A state of both kinds draws the same bytes: two views, lights, materials, a field."""
    pv.ResetSession()
    view = new_view()
    materials = cells_with("DiffuseReflectance", [0.2, 0.4, 0.6, 0.8])
    surface = show_surface(materials, view)
    surface.Shading = "Phong"
    surface.Specular = 0.3
    spot = pv.SpotLight(Position=[0.2, 0.1, 1], Direction=[0, 0.1, -1], Cutoff=35, Intensity=3.0,
                        Color=[1, 0.8, 0.6])
    show_lights(spot, view).ShowGlyphs = 1
    other = new_view()
    field = show_surface(pv.Calculator(Input=pv.Sphere(Radius=0.8), ResultArrayName="Radiance",
                                       Function="0.5 + coordsX/2"), other)
    field.FieldScale = 0.75
    before = [picture(view), picture(other)]
    check(all(p.max() > 50 for p in before) and (before[0] != before[1]).any())
    path = os.path.join(FOLDER, "state")
    pv.SaveState(path + ".pvsm")
    script = smstate.get_state()

    def pictures():
        views = pv.GetRenderViews()
        lit = [v for v in views if any(getattr(r, "Representation", "") == "Radiometric Lights"
                                       for r in v.Representations)]
        rest = [v for v in views if v not in lit]
        check(len(lit) == 1 and len(rest) == 1, len(views))
        return [picture(lit[0]), picture(rest[0])]

    pv.ResetSession()
    pv.LoadState(path + ".pvsm")
    after = pictures()
    check(all((a == b).all() for a, b in zip(before, after)), "pvsm")
    pv.ResetSession()
    pv.SetActiveView(None)
    exec(compile(script, "state.py", "exec"), {})
    after = pictures()
    check(all((a == b).all() for a, b in zip(before, after)), "py")
    pv.ResetSession()


def test_views_have_settings_and_lights_of_their_own():
    plane = new_plane()
    views = [new_view() for _ in range(3)]
    suns = []
    for k, view in enumerate(views):
        surface = show_surface(plane, view)
        surface.LightBrightness = 1.0 + 0.5 * k
        if k < 2:
            suns.append(sun(0.2 * (k + 1), view)[0])
    # The third has no lights of its own: those of ParaView.
    images = [picture(view) for view in views]
    expect(images[0], 0.3, 0.3, 0.2)
    expect(images[1], 0.3, 0.3, 0.4 * 1.5)
    check(images[2].max() > 100)
    suns[0].Intensity = 0.1 * WHITE
    expect(picture(views[0]), 0.3, 0.3, 0.1)
    for k in (1, 2):
        check((picture(views[k]) == images[k]).all(), k)
    pv.Show(suns[0], views[1]).ShowGlyphs = 0  # one light in two views
    expect(picture(views[1]), 0.3, 0.3, 0.5 * 1.5)
    pv.Delete(views[0])
    expect(picture(views[1]), 0.3, 0.3, 0.5 * 1.5)
    for view in views[1:]:
        pv.Delete(view)


def test_selection_gives_the_ids_of_surface():
    sources = {
        "plane": new_plane(6),
        "box": pv.Wavelet(WholeExtent=[-1, 1, -1, 1, -1, 1]),
        "blocks": pv.GroupDatasets(Input=[new_plane(4), pv.Sphere(Radius=0.4)]),
    }
    for name, source in sources.items():
        view = new_view()
        shown = show_surface(source, view)
        found = {}
        for representation in ("Surface", "Radiometric Surface"):
            shown.Representation = representation
            pv.Render(view)
            for what in ("Cells", "Points"):
                select = getattr(pv, "SelectSurface" + what)
                select(Rectangle=[60, 70, 130, 120], View=view)
                picked = pv.ExtractSelection(Input=source)
                picked.UpdatePipeline()
                data = pv.servermanager.Fetch(picked)
                ids = []
                blocks = ([data.GetBlock(k) for k in range(data.GetNumberOfBlocks())]
                          if data.IsA("vtkMultiBlockDataSet") else [data])
                for block in blocks:
                    attributes = block and (block.GetCellData() if what == "Cells"
                                            else block.GetPointData())
                    array = attributes and attributes.GetArray("vtkOriginal%sIds" % what[:-1])
                    ids.append(sorted(vtk_to_numpy(array)) if array else [])
                found[representation, what] = ids
                pv.Delete(picked)
                pv.ClearSelection(source)
        for what in ("Cells", "Points"):
            ours, stock = found["Radiometric Surface", what], found["Surface", what]
            check(sum(map(len, stock)) > 0, name, what, "nothing to compare")
            check(ours == stock, name, what, ours, stock)
        pv.Delete(view)


def read(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[..., :3].astype(int)


def test_pictures_larger_than_the_view():
    """Tiles join without a seam: every pixel is what the light gives at its place."""
    view = new_view()
    show_surface(new_plane(), view)
    show_lights(pv.PointLight(Position=[0.2, 0.1, 0.6], Intensity=0.5), view)
    pv.Render(view)
    path = os.path.join(FOLDER, "large.png")
    for width, height in ((500, 500), (413, 307), (200, 200)):
        pv.SaveScreenshot(path, view, ImageResolution=[width, height])
        image = read(path)
        # ParaView takes the next smaller size that its tiles divide.
        check(0 <= height - image.shape[0] < 8 and 0 <= width - image.shape[1] < 8, image.shape)
        height, width = image.shape[:2]
        y, x = np.mgrid[0:height, 0:width]
        y = (y + 0.5) / height * 2 - 1
        x = ((x + 0.5) / width * 2 - 1) * width / height
        r2 = (x - 0.2) ** 2 + (y - 0.1) ** 2 + 0.36
        expected = np.clip(0.5 * 0.6 / r2 ** 1.5 / math.pi * 255, 0, 255)
        inside = (abs(x) < 0.88) & (abs(y) < 0.88)
        check(np.abs(image[..., 0] - expected)[inside].max() <= 1.01, (width, height),
              np.abs(image[..., 0] - expected)[inside].max())
    pv.Delete(view)


def last_frame(view):
    """What the window shows now, without rendering again."""
    grab = vtkWindowToImageFilter()
    grab.SetInput(view.GetRenderWindow())
    grab.ShouldRerenderOff()
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[..., :3].astype(int)


def test_interaction_draws_the_coarse_surface_with_the_same_light():
    view = new_view()
    view.LODThreshold = 0.0
    view.LODResolution = 0.5
    source = pv.Calculator(Input=new_plane(200), ResultArrayName="Radiance",
                           Function="0.5 + coordsX/2")
    surface = show_surface(source, view)
    sun(0.5, view)
    proxy = view.SMProxy
    for display, at_right in (("Auto", 0.5 + 0.5 / 2), ("Lit by the lights", 0.5)):
        surface.FieldDisplay = display
        proxy.StillRender()
        still = last_frame(view)
        proxy.InteractiveRender()
        check(proxy.GetClientSideObject().GetUsedLODForLastRender(), "no LOD was drawn")
        moving = last_frame(view)
        for image, tolerance in ((still, 1.0), (moving, 3.0)):
            expect(image, 0.5, 0.3, at_right, tolerance)
        proxy.StillRender()
        check((last_frame(view) == still).all(), display)
    pv.Delete(view)


def test_time_changes_light_and_surface():
    view = new_view()
    source = pv.XMLPolyDataReader(FileName=[
        written_plane(f"time{t}.vtp", 1,
                      {"Radiance" if t == 1 else "DiffuseReflectance": [0.3 + 0.2 * t]})
        for t in range(3)])
    show_surface(source, view)
    sun(0.5, view)
    for time, value in ((0, 0.3 * 0.5), (1, 0.5), (2, 0.7 * 0.5), (0, 0.3 * 0.5)):
        view.ViewTime = time
        expect(picture(view), 0.2, 0.2, value)
    pv.Delete(view)


def test_blocks_have_colours_visibility_and_opacity_of_their_own():
    view = new_view()
    left = pv.Plane(Origin=[-0.9, -0.9, 0], Point1=[-0.1, -0.9, 0], Point2=[-0.9, 0.9, 0])
    right = pv.Plane(Origin=[0.1, -0.9, 0], Point1=[0.9, -0.9, 0], Point2=[0.1, 0.9, 0])
    both = pv.GroupDatasets(Input=[left, right])
    both.BlockNames = ["left", "right"]
    surface = show_surface(both, view)
    sun(0.6, view)
    expect(picture(view), -0.5, 0, 0.6)
    surface.BlockColors = ["/Root/left", "1", "0.5", "0"]
    expect(picture(view), -0.5, 0, (0.6, 0.3, 0))
    expect(picture(view), 0.5, 0, 0.6)
    surface.BlockSelectors = ["/Root/left"]
    expect(picture(view), 0.5, 0, 0)
    expect(picture(view), -0.5, 0, (0.6, 0.3, 0))
    surface.BlockSelectors = ["/"]
    expect(picture(view), 0.5, 0, 0.6)
    surface.BlockOpacities = ["/Root/right", "0.5"]
    expect(picture(view), 0.5, 0, 0.3, 1.5)
    expect(picture(view), -0.5, 0, (0.6, 0.3, 0))
    pv.Delete(view)


def test_every_kind_of_data():
    box = pv.Wavelet(WholeExtent=[-1, 1, -1, 1, -1, 1])
    grid = vtkRectilinearGrid()
    grid.SetDimensions(3, 3, 3)
    for axis in "XYZ":
        getattr(grid, f"Set{axis}Coordinates")(numpy_to_vtk(np.array([-1.0, 0.0, 1.0]), deep=True))
    writer = vtkXMLRectilinearGridWriter()
    writer.SetDataModeToBinary()  # see tests/appended_xml.py
    writer.SetFileName(os.path.join(FOLDER, "grid.vtr"))
    writer.SetInputData(grid)
    writer.Write()
    rectilinear = pv.XMLRectilinearGridReader(FileName=[os.path.join(FOLDER, "grid.vtr")])
    tree = pv.HyperTreeGrid()
    kinds = {
        "rectilinear": rectilinear,
        "AMR": pv.HierarchicalFractal(),
        "hyper tree": tree,
        "partitioned": pv.GroupDatasets(
            Input=[new_plane(), pv.AppendDatasets(Input=[box])],
            OutputType="vtkPartitionedDataSetCollection"),
    }
    for kind, source in kinds.items():
        view = new_view()
        source.UpdatePipeline()
        low = np.array(source.GetDataInformation().GetBounds()).reshape(3, 2)
        middle = low.mean(axis=1)
        view.CameraParallelScale = 0.8 * np.ptp(low, axis=1).max()
        view.CameraFocalPoint = list(middle)
        view.CameraPosition = [middle[0], middle[1], low[2, 1] + 5]
        show_surface(source, view)
        sun(0.5, view)
        image = picture(view)
        check(abs(image[SIZE // 2 + 9, SIZE // 2 + 9, 0] - 127.5) <= 1, kind,
              image[SIZE // 2 + 9, SIZE // 2 + 9])
        check(image[3, 3].max() == 0, kind)
        pv.Delete(view)


def test_ghost_cells_are_those_that_paraview_leaves_out():
    view = new_view()
    view.UseLight = 0
    marks = np.zeros(64, dtype=np.uint8)
    marks[:8] = vtkDataSetAttributes.DUPLICATECELL
    ghosts = pv.XMLPolyDataReader(FileName=[
        written_plane("ghosts.vtp", 8, {vtkDataSetAttributes.GhostArrayName(): marks})])
    surface = show_surface(ghosts, view)
    sun(0.5, view)
    image = picture(view)
    expect(image, 0.3, 0.3, 0.5)
    surface.Representation = "Surface"
    stock = picture(view)
    check(((image > 0) == (stock > 0)).all(), "other cells than ParaView draws")
    expect(image, 0.3, -0.8, 0)
    pv.Delete(view)


def test_looking_through_the_camera_of_a_scene():
    view = new_view()
    scene = pv.RadiometricSceneReader(FileName=os.path.join(
        os.environ["RADIOMETRY_SOURCE_DIR"], "examples/gallery/gallery.glb"))
    look_through(scene, view)
    check(np.allclose(view.CameraPosition, (5.55, 1.62, 4.62), atol=1e-6), view.CameraPosition)
    check(np.allclose(view.CameraFocalPoint, (3.1812, 1.2499, 2.1624), atol=1e-3))
    check(abs(view.CameraViewAngle - 50) < 1e-6 and view.CameraParallelProjection == 0)
    check(pv.Show(scene, view).Representation == "Radiometric Surface")
    check(pv.Show(pv.OutputPort(scene, 1), view).Representation == "Radiometric Lights")
    image = picture(view)
    check((image.max(axis=2) > 60).mean() > 0.3, "dark")
    check((image.max(axis=2) >= 255).mean() < 0.5, "glaring")
    try:
        look_through(scene, view, 1)
    except IndexError as error:
        check("camera 1: the scene has 1" in str(error), error)
    else:
        check(False, "a camera that is not there")
    pv.Delete(view)


run(globals())
