# SPDX-License-Identifier: BSD-3-Clause
"""Lights in ParaView: the view's own, shown ones, their glyphs, animation, and what takes them away."""
import math

import numpy as np

from paraview_scene import (
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


def test_lights_of_the_view_give_what_surface_shows():
    """Each kind of light of a view, to one step of 8 bits: a matte surface as ParaView draws it."""
    kinds = [("light kit", None)]
    for of in ("Headlight", "Camera", "Scene"):
        kinds.append((of, dict(Coords=of, Type="Directional")))
        for cone in (12, 90):
            kinds.append((f"{of} {cone}", dict(Coords=of, Type="Positional", ConeAngle=cone)))
    view = new_view()
    view.CameraParallelProjection = 0
    view.CameraPosition = [0.5, 0.4, 4]
    ball = pv.Sphere(ThetaResolution=60, PhiResolution=40, Radius=0.8)
    shown = pv.Show(ball, view)
    shown.ColorArrayName = ["POINTS", ""]
    shown.DiffuseColor = [0.9, 0.7, 0.5]
    pictures = []
    for kind, settings in kinds:
        light = None
        if settings:
            view.UseLight = 0
            light = pv.AddLight(view=view)
            for name, value in settings.items():  # first: a change of Coords resets the position
                setattr(light, name, value)
            light.Position = [1, 1.5, 1.5]
            light.FocalPoint = [0.1, 0, 0]
            light.Intensity = 0.8
            light.DiffuseColor = [1, 0.5, 0.25]
        shown.Representation = "Surface"
        stock = picture(view)
        shown.Representation = "Radiometric Surface"
        ours = picture(view)
        check(stock.max() > 60, kind, stock.max())
        check(np.abs(ours - stock).max() <= 1, kind, np.abs(ours - stock).max())
        pictures.append(ours)
        if light:
            light.Intensity = 0.4
            check(abs(picture(view).max() - ours.max() / 2) <= 1, kind)
            light.Enable = 0
            check(picture(view).max() == 0, kind, "a light that is switched off shines")
            pv.RemoveLight(light)
    # Lights of the scene, of the camera and of the eye are three different pictures.
    directional = pictures[1::3]
    for k in range(3):
        check(np.abs(directional[k] - directional[(k + 1) % 3]).max() > 10, k)
    # The light of the camera goes with it: the turned ball looks the same.
    view.UseLight = 0
    light = pv.AddLight(view=view)
    light.Coords = "Camera"
    light.Position = [1, 0, 1]
    view.CameraPosition = [0, 0, 4]
    front = picture(view)
    view.CameraPosition = [4, 0, 0]
    check(np.abs(picture(view) - front).mean() < 0.2)
    light.Coords = "Scene"
    check(np.abs(picture(view) - front).mean() > 2)
    pv.Delete(view)


def test_many_sources_and_what_takes_them_away():
    view = new_view()
    show_surface(new_plane(), view)
    powers = (0.2, 0.25, 0.15)
    suns = [pv.DirectionalLight(Direction=[0, 0, -1], Intensity=p * math.pi,
                                Color=[float(k == c) for c in range(3)])
            for k, p in enumerate(powers)]
    for sun in suns:
        show_lights(sun, view)
    expect(picture(view), 0.3, 0.3, powers)
    suns[1].LightEnabled = 0
    expect(picture(view), 0.3, 0.3, (0.2, 0, 0.15))
    suns[1].LightEnabled = 1
    pv.Hide(suns[0], view)
    expect(picture(view), 0.3, 0.3, (0, 0.25, 0.15))
    pv.Show(suns[0], view)
    expect(picture(view), 0.3, 0.3, powers)
    pv.Delete(suns[2])
    expect(picture(view), 0.3, 0.3, (0.2, 0.25, 0))
    # One representation of several lights, of which a block can be hidden.
    both = pv.GroupDatasets(Input=suns[:2])
    for sun in suns[:2]:
        pv.Hide(sun, view)
    shown = show_lights(both, view)
    expect(picture(view), 0.3, 0.3, (0.2, 0.25, 0))
    names = pv.servermanager.Fetch(both)
    check(names.GetNumberOfBlocks() == 2)
    shown.BlockSelectors = ["/Root/" + names.GetMetaData(1).Get(names.NAME())]
    expect(picture(view), 0.3, 0.3, (0, 0.25, 0))
    pv.Delete(both)
    view.UseLight = 0
    check(picture(view).max() == 0, "no light at all is dark")
    pv.Delete(view)


def translate(surface, by):
    """Moves what is shown; ParaView 5.13 gave the property another name."""
    newer = "Translation" in surface.ListProperties()
    surface.SetPropertyWithName("Translation" if newer else "Position", by)


def test_attached_lights_and_attenuation():
    view = new_view()
    surface = show_surface(new_plane(), view)
    lamp = pv.PointLight(Position=[0, 0, 1], Intensity=1.0)
    show_lights(lamp, view)
    expect(picture(view), 0.4, 0.0, radiance(1.0, 1.0, 0.4, 0.0))
    translate(surface, [0, 0, -1])
    expect(picture(view), 0.4, 0.0, radiance(1.0, 2.0, 0.4, 0.0))
    lamp.AttachedTo = "Object"
    expect(picture(view), 0.4, 0.0, radiance(1.0, 1.0, 0.4, 0.0))
    translate(surface, [0, 0, 0])
    lamp.AttachedTo = "Camera"  # the eye is at z = 5 and looks along -z
    lamp.Position = [0, 0, -3]
    expect(picture(view), 0.4, 0.0, radiance(1.0, 2.0, 0.4, 0.0))
    view.CameraPosition = [0, 0, 4]
    expect(picture(view), 0.4, 0.0, radiance(1.0, 1.0, 0.4, 0.0))
    view.CameraPosition = [0, 0, 5]
    lamp.AttachedTo = "Scene"
    lamp.Position = [0, 0, 2]
    lamp.Attenuation = [0.5, 0.25, 0.125]  # 1/1.5 at 2 m
    at = 1.0 / math.pi / (0.5 + 0.25 * 2 + 0.125 * 4)
    expect(picture(view), 0.0, 0.0, at)
    pv.Delete(view)


def test_animation_moves_the_light():
    view = new_view()
    show_surface(new_plane(), view)
    lamp = pv.PointLight(Position=[-0.5, 0, 1], Intensity=2.0)
    show_lights(lamp, view)
    scene = pv.GetAnimationScene()
    scene.PlayMode = "Sequence"
    scene.NumberOfFrames = 5
    scene.StartTime = 0.0
    scene.EndTime = 1.0
    tracks = []
    for index, name, keys in ((0, "Position", ((0, -0.5), (1, 0.5))),
                              (0, "Intensity", ((0, 2.0), (1, 1.0)))):
        track = pv.GetAnimationTrack(name, index=index, proxy=lamp)
        track.KeyFrames = [pv.CompositeKeyFrame(KeyTime=t, KeyValues=[v]) for t, v in keys]
        tracks.append(track)
    scene.GoToFirst()
    for frame in range(5):
        x, power = -0.5 + 0.25 * frame, 2.0 - 0.25 * frame
        image = picture(view)
        for px, py in ((0.3, 0.2), (-0.4, -0.3)):
            expect(image, px, py, radiance(power, 1.0, px - x, py), 1.5)
        scene.GoToNext()
    for track in tracks:
        pv.Delete(track)
    pv.Delete(view)


def lines_of(view, lights, size):
    """Where pixels change when the glyphs are drawn."""
    lights.ShowGlyphs = 0
    without = picture(view)
    lights.ShowGlyphs = 1
    lights.LightGlyphSize = size
    image = picture(view)
    changed = np.abs(image - without).sum(axis=2) > 0
    check(changed.sum() > 15, "no glyph", changed.sum())
    return np.argwhere(changed), image[changed]


def test_glyphs():
    view = new_view()
    sources = {
        "point": pv.PointLight(Position=[-0.3, 0.2, 0], Color=[1, 0.5, 0]),
        "spot": pv.SpotLight(Position=[-0.3, 0.2, 0], Direction=[1, 0, 0], Cutoff=20,
                             Color=[1, 0.5, 0]),
        "directional": pv.DirectionalLight(Position=[-0.3, 0.2, 0], Direction=[1, 0, 0],
                                           Color=[1, 0.5, 0]),
    }
    for kind, source in sources.items():
        lights = show_lights(source, view)
        middle = np.array(pixel(-0.3, 0.2))
        where, colors = lines_of(view, lights, 0.4)
        brightest = colors[colors[:, 0].argmax()]
        check(brightest[0] > 200 and abs(brightest[1] / brightest[0] - 0.5) < 0.05
              and brightest[2] == 0, kind, brightest)
        if kind == "point":
            check(np.abs(where.mean(axis=0) - middle).max() < 3, where.mean(axis=0), middle)
        else:  # the light goes to the right, and the arrows with it
            check(where[:, 1].max() > middle[1] + 0.4 * SIZE / 2 - 4, kind, where.max(axis=0))
            check(abs(where[:, 0].mean() - middle[0]) < 3, kind)
        # Automatic: an eighth of the height of the picture, however near it is.
        heights = []
        for scale in (1.0, 30.0):
            view.CameraParallelScale = scale
            view.CameraFocalPoint = [-0.3, 0.2, 0]
            view.CameraPosition = [-0.3, 0.2, 5 * scale]
            where, _ = lines_of(view, lights, 0.0)
            heights.append(np.ptp(where, axis=0).max() / SIZE)
        check(0.09 < min(heights) and max(heights) < 0.2, kind, heights)
        check(abs(heights[0] - heights[1]) < 0.02, kind, heights)
        view.CameraParallelScale = 1.0
        view.CameraFocalPoint = [0, 0, 0]
        view.CameraPosition = [0, 0, 5]
        # Off: grey, still there.
        source.LightEnabled = 0
        _, colors = lines_of(view, lights, 0.4)
        check((colors.max(axis=1) - colors.min(axis=1) == 0).all() and colors.max() <= 97, kind)
        # The representation's own transform moves neither the glyph nor the light.
        source.LightEnabled = 1
        here = picture(view)
        translate(lights, [0.3, 0.3, 0])
        check((picture(view) == here).all(), kind)
        pv.Hide(source, view)
    square = pv.AreaLight()
    lights = show_lights(square, view)
    view.CameraPosition = [0, 3, 4]
    lines_of(view, lights, 0.4)
    pv.Delete(view)


def test_glyphs_frame_the_picture_only_by_where_the_lights_are():
    cameras = []
    for lit in (False, True):
        view = new_view()
        show_surface(new_plane(), view)
        if lit:  # inside the bounds of what is shown
            show_lights(pv.PointLight(Position=[0.1, 0.1, 0]), view).ShowGlyphs = 1
        pv.Render(view)
        pv.ResetCamera(view)
        pv.Render(view)
        pv.ResetCamera(view)
        cameras.append(view.CameraParallelScale)
        pv.Delete(view)
    check(abs(cameras[0] - cameras[1]) < 1e-9, cameras)


def test_picking_a_glyph_selects_its_light():
    view = new_view()
    left = pv.PointLight(Position=[-0.5, 0, 1])
    right = pv.PointLight(Position=[0.5, 0, 1])
    both = pv.AppendDatasets(Input=[left, right])
    both = pv.ExtractSurface(Input=both)
    lights = show_lights(both, view, 0.5)
    pv.Render(view)
    for which, x in ((0, -0.5), (1, 0.5)):
        row, column = pixel(x, 0)
        pv.SelectSurfaceCells(Rectangle=[column - 12, row - 12, column + 12, row + 12], View=view)
        picked = pv.ExtractSelection(Input=both)
        picked.UpdatePipeline()
        data = pv.servermanager.Fetch(picked)
        check(data.GetNumberOfCells() == 1, which, data.GetNumberOfCells())
        check(abs(data.GetPoint(0)[0] - x) < 1e-6, which, data.GetPoint(0))
        pv.Delete(picked)
        pv.ClearSelection(both)
    check(lights.Representation == "Radiometric Lights")
    pv.Delete(view)


run(globals())
