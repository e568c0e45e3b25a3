# SPDX-License-Identifier: BSD-3-Clause
"""Radiometric Scene Reader: geometry, materials, lights and cameras against what the file says,
computed independently in numpy."""
import math
import os
import struct
import tempfile
import zlib
import base64

import numpy as np
from checks import array, close, points, run_all, shared, triangles
from gltf_tools import (SQUARE, SQUARE_TRIANGLES, Builder, areas, load, square, world_matrices,
                        world_triangles)
from vtkradiometry import vtkRadiometricSceneReader

K = 683.002
FOLDER = tempfile.mkdtemp()


def read(source, **properties):
    """A reader updated on a builder or on a file."""
    reader = vtkRadiometricSceneReader()
    if isinstance(source, Builder):
        source = source.write(os.path.join(FOLDER, "scene.glb"))
    reader.SetFileName(source)
    for name, value in properties.items():
        getattr(reader, "Set" + name)(value)
    reader.Update()
    return reader


def corners(reader):
    return points(reader.GetOutput(0))[triangles(reader.GetOutput(0))]


def cell(reader, name):
    return array(reader.GetOutput(0).GetCellData(), name)


def light(reader, name):
    return array(reader.GetOutput(1).GetPointData(), name)


def assumptions(reader):
    texts = [reader.GetAssumption(i) for i in range(reader.GetNumberOfAssumptions())]
    for port in range(3):
        assert array(reader.GetOutputDataObject(port).GetFieldData(), "Assumptions") == texts
    return "\n".join(texts)


def test_shared_files_geometry():
    """Every point, every area and every front of every file of the shared data."""
    for name in ("04_lights.gltf", "LightVisibility_reduced.gltf", "blender-room-small.glb",
                 "blender-room.glb"):
        path = shared("gltf/" + name)
        if path is None:
            continue
        document, buffers = load(path)
        expected, signs = world_triangles(document, buffers)
        assert np.all(signs == 1)
        found = corners(read(path))
        close(found, expected, relative=1e-13, absolute=1e-13)
        close(areas(found).sum(), areas(expected).sum())


def test_blender_room():
    path = shared("gltf/blender-room-small.glb")
    if path is None:
        return
    reader = read(path)
    document, _ = load(path)
    world = world_matrices(document)
    names = array(reader.GetOutput(1).GetFieldData(), "LightNames")
    assert names == ["Bulb", "Spot", "Sun"]
    for i, name in enumerate(names):
        index, node = next((k, n) for k, n in enumerate(document["nodes"]) if n.get("name") == name)
        close(points(reader.GetOutput(1))[i], world[index][:3, 3])
        close(light(reader, "Direction")[i], -world[index][:3, 2] /
              np.linalg.norm(world[index][:3, 2]), absolute=1e-15)
        source = document["extensions"]["KHR_lights_punctual"]["lights"][i]
        close(light(reader, "Intensity")[i], np.array(source["color"]) * source["intensity"] / K)
    assert light(reader, "LightType").tolist() == [0, 1, 2]
    close(light(reader, "SpotCutoff")[1], math.degrees(0.38182902336120605))
    close(light(reader, "SpotInnerCutoff")[1], math.degrees(0.37641707857188145))
    # The two lights below the ceiling's hole point straight down.
    close(light(reader, "Direction")[1], [0, -1, 0], absolute=1e-7)

    # Emission that Blender left in W/(m^2 sr): pi L of exitance, on the panel alone.
    emission = cell(reader, "EmittedExitance")
    panel = emission[:, 0] > 0
    assert set(cell(reader, "MaterialIndex")[panel]) == {5}
    close(emission[panel][0], math.pi * 37.97964096069336 *
          np.array([1, 0.949999988079071, 0.8999999761581421]))
    assert "Blender" in assumptions(reader)
    close(areas(corners(reader))[panel].sum(), 0.3 * 0.3, relative=1e-6)
    assert np.all(cell(reader, "TwoSided") == 1)
    assert array(reader.GetOutput(0).GetFieldData(), "ObjectNames")[0] == "Room"

    # The camera, as Blender set it.
    assert reader.GetNumberOfCameras() == 1 and reader.GetCameraName(0) == "Camera"
    index = next(k for k, n in enumerate(document["nodes"]) if "camera" in n)
    position, focus, up, direction = ([0, 0, 0] for _ in range(4))
    reader.GetCameraPosition(0, position)
    reader.GetCameraFocalPoint(0, focus)
    reader.GetCameraViewUp(0, up)
    reader.GetCameraDirection(0, direction)
    close(position, world[index][:3, 3])
    close(direction, -world[index][:3, 2], relative=1e-6)
    close(up, world[index][:3, 1], relative=1e-6)
    close(np.cross(np.subtract(focus, position), direction), [0, 0, 0], absolute=1e-12)
    close(reader.GetCameraViewAngle(0), math.degrees(0.937270173412135))
    close(reader.GetCameraAspectRatio(0), 16 / 9)


def test_light_visibility():
    path = shared("gltf/LightVisibility_reduced.gltf")
    if path is None:
        return
    reader = read(path)
    colours = [[1, 0, 0], [0, 1, 0], [0, 0.125, 1]]
    close(light(reader, "Intensity") * K, np.array(colours) * [[5], [5], [6]], relative=1e-15)
    close(light(reader, "SpotCutoff"), [math.degrees(0.8)] * 3)
    close(light(reader, "SpotInnerCutoff"), [math.degrees(0.65)] * 3)
    document, _ = load(path)
    for i, matrix in enumerate(list(world_matrices(document).values())[1:4]):
        close(points(reader.GetOutput(1))[i], matrix[:3, 3])
    assert array(reader.GetOutput(1).GetFieldData(), "Photometric") == 1
    assert "range is ignored" in assumptions(reader)


def test_defaults_of_lights():
    path = shared("gltf/light.gltf")
    if path is None:
        return
    assert read(path).GetOutput(1).GetNumberOfPoints() == 0
    assert "left out" in assumptions(read(path))
    reader = read(path, UnreferencedLights=True)
    assert light(reader, "LightType").tolist() == [0, 1, 1, 1, 2]
    close(light(reader, "Intensity")[0] * K, [1, 1, 1])
    close(light(reader, "Intensity")[1] * K, [2.1 * 0.28, 2.1 * 0.19, 2.1])
    close(light(reader, "SpotCutoff")[1:4], [math.degrees(0.35), 45, 90])
    close(light(reader, "SpotInnerCutoff")[1:4], [math.degrees(0.25), 0, 0])


def nested():
    """A square below two nodes with rotation and non-uniform scale, one of them mirroring."""
    s = math.sqrt(0.5)
    builder = Builder()
    mesh = builder.mesh(SQUARE, SQUARE_TRIANGLES, [[0, 0, 1]] * 4)
    leaf = builder.node(False, mesh=mesh, scale=[2, -3, 0.5], rotation=[0.5, 0.5, 0.5, 0.5],
                        translation=[1, 2, 3])
    middle = builder.node(False, children=[leaf],
                          matrix=[1, 0, 0.5, 0, 0.25, 2, 0, 0, 0, 0.125, 1, 0, 4, 5, 6, 1])
    builder.node(children=[middle], rotation=[s, 0, 0, s], scale=[1, 4, 1])
    return builder


def test_nested_transforms():
    builder = nested()
    reader = read(builder)
    document, buffers = load(os.path.join(FOLDER, "scene.glb"))
    expected, signs = world_triangles(document, buffers)
    assert np.all(signs == -1), "the case is about a mirroring transform"
    close(corners(reader), expected[:, [0, 2, 1]], relative=1e-13, absolute=1e-13)
    # Fronts stay fronts: the image of the square's normal is on the side its corners turn about.
    matrix = list(world_matrices(document).values())[-1][:3, :3]
    normal = np.linalg.inv(matrix).T @ [0, 0, 1]
    normal /= np.linalg.norm(normal)
    close(array(reader.GetOutput(0).GetPointData(), "Normals"), [normal] * 4, absolute=1e-14)
    c = corners(reader)[0]
    front = np.cross(c[1] - c[0], c[2] - c[0])
    close(front / np.linalg.norm(front), normal, absolute=1e-13)


def test_far_from_the_origin():
    """Node translations are doubles: UTM metres keep a millimetre's thousandth."""
    reader = read(square(translation=[500000.123456789, 0.1, 4000000.987654321]))
    close(points(reader.GetOutput(0))[0], [500000.123456789, 0.1, 4000000.987654321], relative=0)
    close(areas(corners(reader)).sum(), 1.0, relative=1e-9)


def test_one_file_two_formats():
    builder = nested()
    binary = read(builder.write(os.path.join(FOLDER, "a.glb")))
    text = read(builder.write(os.path.join(FOLDER, "a.gltf")))
    assert np.array_equal(points(binary.GetOutput(0)), points(text.GetOutput(0)))


def test_layouts_of_meshes():
    """Strips, fans, missing indices, byte indices, strides: the same two triangles."""
    expected = areas(np.array(SQUARE, float)[np.array(SQUARE_TRIANGLES)]).sum()
    strip = [SQUARE[i] for i in (0, 1, 3, 2)]
    for arguments in (
        dict(positions=SQUARE, indices=SQUARE_TRIANGLES, index_type=np.uint8),
        dict(positions=SQUARE, indices=SQUARE_TRIANGLES, index_type=np.uint32, stride=20),
        dict(positions=SQUARE, indices=[0, 1, 2, 3], mode=6),
        dict(positions=strip, mode=5),
        dict(positions=strip, indices=[0, 1, 2, 3], mode=5),
        dict(positions=[SQUARE[i] for t in SQUARE_TRIANGLES for i in t]),
    ):
        builder = Builder()
        builder.node(mesh=builder.mesh(**arguments))
        found = corners(read(builder))
        close(areas(found).sum(), expected)
        front = np.cross(found[:, 1] - found[:, 0], found[:, 2] - found[:, 0])
        close(front, [[0, 0, 1]] * 2)


def test_sparse_positions():
    builder = Builder()
    mesh = builder.mesh(SQUARE, SQUARE_TRIANGLES)
    indices, moved = builder.accessor([2], np.uint16), builder.accessor([[5, 5, 0]])
    views = [builder.json["accessors"][i]["bufferView"] for i in (indices, moved)]
    builder.json["accessors"][0]["sparse"] = {
        "count": 1, "indices": {"bufferView": views[0], "componentType": 5123},
        "values": {"bufferView": views[1]}}
    builder.node(mesh=mesh)
    close(points(read(builder).GetOutput(0))[2], [5, 5, 0])


def test_missing_normals_are_flat():
    builder = square()
    builder.node(mesh=builder.mesh(SQUARE, SQUARE_TRIANGLES), rotation=[1, 0, 0, 0])
    reader = read(builder)
    normals = array(reader.GetOutput(0).GetPointData(), "Normals")
    assert len(normals) == 4 + 6
    close(normals[4:], [[0, 0, -1]] * 6, absolute=1e-15)


def test_materials():
    def material(**fields):
        emissive = fields.pop("emissive", None)
        result = {"pbrMetallicRoughness": fields, "name": "m"}
        if emissive:
            result["emissiveFactor"] = emissive
            result["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": 100}}
        return result

    paint = read(square(material(baseColorFactor=[0.8, 0.5, 0.2, 1], metallicFactor=0)))
    # Roughness 1: the lobe of exponent 0 is as good as diffuse.
    close(cell(paint, "DiffuseReflectance")[0], 0.96 * np.array([0.8, 0.5, 0.2]) + 0.04)
    close(cell(paint, "SpecularReflectance")[0], [0, 0, 0])
    satin = read(square(material(baseColorFactor=[0.8, 0.5, 0.2, 1], metallicFactor=0.25,
                                 roughnessFactor=0.5)))
    close(cell(satin, "DiffuseReflectance")[0], 0.75 * 0.96 * np.array([0.8, 0.5, 0.2]))
    close(cell(satin, "SpecularReflectance")[0], 0.03 + 0.25 * np.array([0.8, 0.5, 0.2]))
    close(cell(satin, "Shininess")[0], 2 / 0.25**2 - 2)
    assert "metallic" in assumptions(satin)
    folded = read(square(material(baseColorFactor=[0.8, 0.5, 0.2, 1], metallicFactor=0.25,
                                  roughnessFactor=0.5)), SpecularAsDiffuse=True)
    close(cell(folded, "DiffuseReflectance")[0],
          0.75 * 0.96 * np.array([0.8, 0.5, 0.2]) + 0.03 + 0.25 * np.array([0.8, 0.5, 0.2]))
    # Extensions that change the 4 % of a dielectric: no gloss, another index, a tint.
    for extension, f0 in (({"KHR_materials_specular": {"specularFactor": 0}}, [0, 0, 0]),
                          ({"KHR_materials_ior": {"ior": 2}}, [1 / 9] * 3),
                          ({"KHR_materials_specular": {"specularColorFactor": [2, 1, 30],
                                                       "specularFactor": 0.5}}, [0.04, 0.02, 0.5])):
        f0 = np.array(f0)
        fields = material(baseColorFactor=[0.8, 0.5, 0.2, 1], metallicFactor=0, roughnessFactor=0.5)
        glossy = read(square({**fields, "extensions": extension}))
        close(cell(glossy, "DiffuseReflectance")[0], (1 - f0) * np.array([0.8, 0.5, 0.2]))
        close(cell(glossy, "SpecularReflectance")[0], f0, absolute=1e-16)
    # Never more than all of the light, whatever the material.
    for metal in (0, 0.3, 1):
        for rough in (0, 0.5, 1):
            white = read(square(material(metallicFactor=metal, roughnessFactor=rough)))
            total = cell(white, "DiffuseReflectance") + cell(white, "SpecularReflectance")
            assert np.all(total <= 1.0) and np.all(total > 0.999999)
    # Emission in each unit.
    for choice, expected in ((0, math.pi * 100 / K), (1, math.pi * 100 / K), (2, math.pi * 100),
                             (3, 100)):
        lamp = read(square(material(emissive=[1, 0.5, 0])), EmissiveUnits=choice)
        close(cell(lamp, "EmittedExitance")[0], expected * np.array([1, 0.5, 0]))
    builder = square(material(emissive=[1, 0.5, 0]))
    builder.json["asset"]["generator"] = "Khronos glTF Blender I/O v5.0.21"
    close(cell(read(builder), "EmittedExitance")[0], 100 * math.pi * np.array([1, 0.5, 0]))


def test_default_material_and_objects():
    builder = square(name="first")
    builder.node(mesh=builder.mesh(SQUARE, SQUARE_TRIANGLES, material={"doubleSided": True}))
    reader = read(builder)
    field = reader.GetOutput(0).GetFieldData()
    assert array(field, "MaterialNames") == ["material 0", "(default)"]
    assert array(field, "ObjectNames") == ["first", "node 1"]
    assert cell(reader, "MaterialIndex").tolist() == [1, 1, 0, 0]
    assert cell(reader, "ObjectIndex").tolist() == [0, 0, 1, 1]
    assert cell(reader, "TwoSided").tolist() == [0, 0, 1, 1]


def png(rows):
    def chunk(kind, body):
        return (struct.pack(">I", len(body)) + kind + body +
                struct.pack(">I", zlib.crc32(kind + body)))

    raw = b"".join(b"\0" + bytes(sum(row, [])) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" +
            chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))


def test_texture_average():
    image = png([[[255, 0, 188], [0, 0, 188]]])
    texture = {"baseColorTexture": {"index": 0}, "baseColorFactor": [0.5, 1, 1, 1],
               "metallicFactor": 0}
    linear = ((188 / 255 + 0.055) / 1.055) ** 2.4
    expected = 0.96 * np.array([0.25, 0, linear]) + 0.04
    for inside in (False, True):
        builder = square({"pbrMetallicRoughness": texture})
        builder.add("textures", {"source": 0})
        if inside:
            start = len(builder.bytes)
            builder.bytes += image
            view = builder.add("bufferViews", {"buffer": 0, "byteOffset": start,
                                               "byteLength": len(image)})
            builder.add("images", {"bufferView": view, "mimeType": "image/png"})
        else:
            builder.add("images", {"uri": "data:image/png;base64," +
                                          base64.b64encode(image).decode()})
        reader = read(builder)
        close(cell(reader, "DiffuseReflectance")[0], expected)
        assert "average" in assumptions(reader)


def test_light_units():
    builder = Builder()
    builder.light(type="point", intensity=50)
    builder.light(type="directional", intensity=700, transform={"rotation": [1, 0, 0, 0]})
    reader = read(builder)
    close(light(reader, "Intensity")[:, 0], [50 / K, 700 / K])
    close(light(reader, "Direction")[1], [0, 0, 1], absolute=1e-15)
    close(light(read(builder, LightUnits=2), "Intensity")[:, 0], [50, 700])
    close(light(read(builder, LuminousEfficacy=100), "Intensity")[:, 0], [0.5, 7])


def test_light_below_a_scaled_parent():
    """Scale moves a light and turns it with the axes, and changes neither its power nor its cone."""
    builder = Builder()
    lamp = builder.light(False, {"translation": [1, 1, 1]}, type="spot", intensity=2,
                         spot={"outerConeAngle": 0.5})
    builder.node(children=[lamp], scale=[2, 3, -4])
    reader = read(builder)
    close(points(reader.GetOutput(1)), [[2, 3, -4]])
    close(light(reader, "Direction"), [[0, 0, 1]])
    close(light(reader, "Intensity") * K, [[2, 2, 2]])


def test_hidden_nodes():
    builder = square()
    below = builder.node(False, mesh=0)
    builder.node(children=[below], extensions={"KHR_node_visibility": {"visible": False}})
    assert read(builder).GetOutput(0).GetNumberOfCells() == 2


def test_parallel_camera():
    builder = square()
    builder.add("cameras", {"type": "orthographic", "orthographic":
                            {"xmag": 3, "ymag": 2, "znear": 0.1, "zfar": 50}})
    builder.node(camera=0, translation=[0, 0, 10])
    reader = read(builder)
    assert reader.GetCameraParallelProjection(0)
    close(reader.GetCameraParallelScale(0), 2)
    focus = [0, 0, 0]
    reader.GetCameraFocalPoint(0, focus)
    close(focus, [0, 0, 0], absolute=1e-15)
    cameras = reader.GetOutput(2)
    close(points(cameras), [[0, 0, 10]])
    close(array(cameras.GetPointData(), "ClippingRange"), [[0.1, 50]])


if __name__ == "__main__":
    run_all(globals())
