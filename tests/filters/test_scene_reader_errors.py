# SPDX-License-Identifier: BSD-3-Clause
"""Radiometric Scene Reader on damaged and wrong files: one line that says what and where, empty
outputs, and never a crash."""
import os
import random
import tempfile

import numpy as np
from checks import close, fails, run_all, shared
from gltf_tools import SQUARE, SQUARE_TRIANGLES, Builder, load, square
from vtkradiometry import vtkRadiometricSceneReader

FOLDER = tempfile.mkdtemp()


def reader_of(path):
    reader = vtkRadiometricSceneReader()
    reader.SetFileName(path)
    return reader


def refused(builder, *words):
    for name in ("bad.glb", "bad.gltf"):
        fails(reader_of(builder.write(os.path.join(FOLDER, name))), name, *words)


def write(name, content):
    path = os.path.join(FOLDER, name)
    with open(path, "wb") as file:
        file.write(content)
    return path


def test_no_file():
    fails(vtkRadiometricSceneReader(), "FileName")
    fails(reader_of("no-such-file.gltf"), "no-such-file.gltf")
    fails(reader_of(FOLDER), "FileName")


def test_not_gltf():
    fails(reader_of(write("empty.gltf", b"")), "empty.gltf")
    fails(reader_of(write("text.gltf", b"hello")), "text.gltf", "neither JSON nor binary glTF")
    fails(reader_of(write("noise.glb", bytes(range(256)))), "noise.glb")
    fails(reader_of(write("other.gltf", b"{}")), "other.gltf", "asset.version")
    fails(reader_of(write("one.gltf", b'{"asset":{"version":"1.0"}}')), "asset.version", "1.0")


def test_cut_off():
    """Every length of a small file, and a sample of lengths of a real one."""
    path = square().write(os.path.join(FOLDER, "whole.glb"))
    with open(path, "rb") as file:
        whole = file.read()
    for length in range(len(whole)):
        fails(reader_of(write("cut.glb", whole[:length])), "cut.glb")
    path = square().write(os.path.join(FOLDER, "whole.gltf"))
    with open(path, "rb") as file:
        whole = file.read()
    for length in range(0, len(whole), 7):
        fails(reader_of(write("cut.gltf", whole[:length])), "cut.gltf")
    room = shared("gltf/blender-room-small.glb")
    if room:
        with open(room, "rb") as file:
            whole = file.read()
        for length in (11, 19, 400, 9000, len(whole) // 2, len(whole) - 1):
            fails(reader_of(write("cut.glb", whole[:length])), "cut.glb", "bytes")


def test_missing_buffer():
    builder = square()
    path = builder.write(os.path.join(FOLDER, "outside.gltf"))
    with open(path) as file:
        text = file.read()
    start = text.index("data:")
    text = text[:start] + "nowhere.bin" + text[text.index('"', start):]
    fails(reader_of(write("outside.gltf", text.encode())), "outside.gltf", "nowhere.bin")


def test_bad_bytes_never_crash():
    """Flipped bytes: whatever comes, it is a whole scene or one error and empty outputs."""
    path = square(dict(pbrMetallicRoughness=dict(metallicFactor=0))).write(
        os.path.join(FOLDER, "whole.glb"))
    with open(path, "rb") as file:
        whole = bytearray(file.read())
    chance = random.Random(1)
    read, wrong = 0, 0
    for _ in range(1500):
        damaged = bytearray(whole)
        for _ in range(chance.choice((1, 1, 2, 5))):
            damaged[chance.randrange(len(damaged))] = chance.randrange(256)
        reader = reader_of(write("damaged.glb", damaged))
        errors = []
        reader.AddObserver("ErrorEvent", lambda caller, event: errors.append(event))
        reader.GetExecutive().AddObserver("ErrorEvent", lambda caller, event: None)
        reader.Update()
        if errors:
            wrong += 1
            assert reader.GetOutput(0).GetNumberOfPoints() == 0
        else:
            read += 1
            bounds = np.array(reader.GetOutput(0).GetBounds())
            assert np.all(np.isfinite(bounds))
    assert read > 100 and wrong > 100, (read, wrong)


def test_vertices():
    for bad, text in ((float("nan"), "nan"), (float("inf"), "inf")):
        builder = Builder()
        positions = np.array(SQUARE, float)
        positions[2, 1] = bad
        builder.node(mesh=builder.mesh(positions, SQUARE_TRIANGLES))
        refused(builder, "meshes[0].primitives[0].POSITION[2]", text)
    builder = Builder()
    builder.node(mesh=builder.mesh(SQUARE, [[0, 1, 2], [0, 2, 4]]))
    refused(builder, "meshes[0].primitives[0].indices[5]", "4")
    builder = square()
    builder.json["accessors"][0]["count"] = 5
    refused(builder, "POSITION", "5 elements")
    builder = square()
    builder.json["accessors"][0]["count"] = 2**62
    refused(builder, "POSITION")
    builder = square()
    builder.json["bufferViews"][0]["byteOffset"] = 10**9
    refused(builder, "POSITION")
    builder = square()
    builder.json["accessors"][0]["bufferView"] = 99
    refused(builder, "bufferView 99")
    builder = square()
    builder.json["accessors"][0]["type"] = "VEC2"
    refused(builder, "POSITION")
    builder = square()
    del builder.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"]
    refused(builder, "meshes[0].primitives[0]", "POSITION")


def test_nodes():
    builder = square()
    builder.json["nodes"][0]["children"] = [0]
    refused(builder, "nodes[0]", "twice")
    builder = square()
    builder.json["nodes"][0]["mesh"] = 7
    refused(builder, "mesh", "7")
    builder = square()
    builder.json["scene"] = 3
    refused(builder, "scene", "3")
    builder = square()
    builder.json["scenes"][0]["nodes"] = [5]
    refused(builder, "5")
    refused(square(rotation=[0, 0, 0, 0]), "nodes[0].rotation")
    refused(square(scale=[1, 1]), "nodes[0].scale", "2 numbers")
    refused(square(matrix=[1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]), "nodes[0].matrix")
    builder = square()
    builder.json["meshes"][0]["primitives"][0]["material"] = 0
    refused(builder, "meshes[0].primitives[0].material", "0")


def test_materials():
    def with_material(**fields):
        return square({"name": "paint", **fields})

    refused(with_material(pbrMetallicRoughness={"baseColorFactor": [0.5, 1.5, 0.5, 1]}),
            'materials[0] "paint".baseColorFactor[1]', "1.5")
    refused(with_material(pbrMetallicRoughness={"baseColorFactor": [-0.5, 0.5, 0.5, 1]}),
            'materials[0] "paint".baseColorFactor[0]', "-0.5")
    refused(with_material(pbrMetallicRoughness={"metallicFactor": 2}), ".metallicFactor", "2")
    refused(with_material(pbrMetallicRoughness={"roughnessFactor": -1}), ".roughnessFactor", "-1")
    refused(with_material(emissiveFactor=[1, 1, -1]), ".emissiveFactor[2]", "-1")
    refused(with_material(emissiveFactor=[1, 1, 1], extensions={
        "KHR_materials_emissive_strength": {"emissiveStrength": -4}}), ".emissiveStrength", "-4")
    refused(with_material(extensions={
        "KHR_materials_emissive_strength": {"emissiveStrength": "bright"}}), ".emissiveStrength")
    refused(with_material(extensions={"KHR_materials_ior": {"ior": 0.5}}), ".ior", "0.5")
    refused(with_material(extensions={"KHR_materials_specular": {"specularFactor": 2}}),
            ".specularFactor", "2")


def test_extensions():
    builder = square()
    builder.json["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    refused(builder, "extensionsRequired", "KHR_draco_mesh_compression")


def test_shared_invalid_lights():
    """Each light of the file by itself: an error that names it. (A directional light with a range
    is read: the range has no effect.)"""
    path = shared("gltf/light-invalid.gltf")
    if path is None:
        return
    fails(reader_of(path), "lights[0]", "unknown type")
    lights = load(path)[0]["extensions"]["KHR_lights_punctual"]["lights"]
    refusals = 0
    for entry in lights:
        builder = Builder()
        builder.light(**entry)
        if entry["name"] == "directional with range":
            reader = reader_of(builder.write(os.path.join(FOLDER, "light.gltf")))
            reader.Update()
            assert reader.GetOutput(1).GetNumberOfPoints() == 1
            continue
        refused(builder, "KHR_lights_punctual.lights[0]", entry["name"])
        refusals += 1
    assert refusals == 15


def test_lights():
    def with_light(**fields):
        builder = Builder()
        builder.light(**fields)
        return builder

    refused(with_light(type="point", intensity=-3), "lights[0].intensity", "-3")
    refused(with_light(type="point", color=[1, -1, 1]), "lights[0].color[1]", "-1")
    refused(with_light(type="spot", spot={"outerConeAngle": 0}), "outerConeAngle", "0")
    builder = with_light(type="point")
    builder.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 4
    refused(builder, "nodes[0].KHR_lights_punctual.light", "4")


def test_options():
    reader = reader_of(square().write(os.path.join(FOLDER, "good.glb")))
    reader.SetLuminousEfficacy(0)
    fails(reader, "LuminousEfficacy", "0")
    reader.SetLuminousEfficacy(683.002)
    reader.Update()
    assert reader.GetOutput(0).GetNumberOfCells() == 2, "reads again after an error"
    close(reader.GetNumberOfCameras(), 0)
    assert reader.GetCameraName(0) is None and reader.GetAssumption(-1) is None


if __name__ == "__main__":
    run_all(globals())
