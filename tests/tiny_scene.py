# SPDX-License-Identifier: BSD-3-Clause
"""A small glTF scene of our own for tests: a floor and a wall, a block, lights, a camera."""
import base64
import json
import struct

FLOOR = [(0, 0, 0), (0, 0, 2), (2, 0, 2), (2, 0, 0)]  # front up (+Y)
WALL = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)]  # front toward +Z


def _box(low, high):
    (a, b, c), (d, e, f) = low, high
    return [
        [(a, b, f), (d, b, f), (d, e, f), (a, e, f)],
        [(d, b, c), (a, b, c), (a, e, c), (d, e, c)],
        [(a, b, c), (a, b, f), (a, e, f), (a, e, c)],
        [(d, b, f), (d, b, c), (d, e, c), (d, e, f)],
        [(a, e, f), (d, e, f), (d, e, c), (a, e, c)],
        [(a, b, c), (d, b, c), (d, b, f), (a, b, f)],
    ]


def document(lights=True, emission=None):
    """The glTF as a dictionary, its buffer embedded."""
    surfaces = [([FLOOR], 0), ([WALL], 1), (_box((0.8, 0.0, 0.8), (1.2, 0.5, 1.2)), 1)]
    data = b""
    views, accessors, meshes = [], [], []
    for quads, material in surfaces:
        corners = [point for quad in quads for point in quad]
        index = [4 * k + i for k in range(len(quads)) for i in (0, 1, 2, 0, 2, 3)]
        for payload, kind, component, shape, count in (
            (struct.pack(f"<{3 * len(corners)}f", *[x for p in corners for x in p]), 34962, 5126,
             "VEC3", len(corners)),
            (struct.pack(f"<{len(index)}H", *index), 34963, 5123, "SCALAR", len(index)),
        ):
            data += b"\0" * (-len(data) % 4)
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(payload),
                          "target": kind})
            accessor = {"bufferView": len(views) - 1, "componentType": component, "count": count,
                        "type": shape}
            if shape == "VEC3":
                accessor["min"] = [min(p[i] for p in corners) for i in range(3)]
                accessor["max"] = [max(p[i] for p in corners) for i in range(3)]
            accessors.append(accessor)
            data += payload
        meshes.append({"primitives": [{
            "attributes": {"POSITION": len(accessors) - 2}, "indices": len(accessors) - 1,
            "material": material}]})
    nodes = [{"mesh": k, "name": name} for k, name in enumerate(("floor", "wall", "block"))]
    gltf = {
        "asset": {"version": "2.0", "generator": "vtkRadiometry tests"},
        "scene": 0,
        "meshes": meshes,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64,"
                     + base64.b64encode(data).decode()}],
        "materials": [
            {"name": "grey", "pbrMetallicRoughness": {
                "baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0, "roughnessFactor": 1}},
            {"name": "red", "pbrMetallicRoughness": {
                "baseColorFactor": [0.6, 0.1, 0.1, 1], "metallicFactor": 0, "roughnessFactor": 1}},
        ],
        "cameras": [{"type": "perspective", "name": "camera", "perspective": {
            "yfov": 0.7, "aspectRatio": 1.6, "znear": 0.1}}],
    }
    if emission:
        gltf["materials"][1]["emissiveFactor"] = emission
    # The camera looks from (2.6, 2.2, 4.4) to the middle of the scene.
    nodes.append({"camera": 0, "translation": [2.6, 2.2, 4.4],
                  "rotation": [-0.1925, 0.2297, 0.0464, 0.9529]})
    if lights:
        gltf["extensionsUsed"] = ["KHR_lights_punctual"]
        gltf["extensions"] = {"KHR_lights_punctual": {"lights": [
            {"type": "point", "name": "bulb", "intensity": 100.0},
            {"type": "spot", "name": "spot", "intensity": 400.0,
             "spot": {"innerConeAngle": 0.0, "outerConeAngle": 0.4}},
            {"type": "directional", "name": "sun", "intensity": 50.0},
        ]}}
        down = [-0.70710678, 0.0, 0.0, 0.70710678]  # -Z turned to -Y
        for k, place in enumerate(([0.5, 1.5, 1.5], [1.6, 1.9, 1.6], [0.0, 3.0, 0.0])):
            nodes.append({"translation": place, "rotation": down,
                          "extensions": {"KHR_lights_punctual": {"light": k}}})
    gltf["nodes"] = nodes
    gltf["scenes"] = [{"nodes": list(range(len(nodes)))}]
    return gltf


def write(path, gltf=None):
    """Writes the scene and returns the path."""
    with open(path, "w", encoding="utf-8") as stream:
        json.dump(gltf or document(), stream)
    return path


def write_luminaire(path):
    """An IES file of a round downlight of 100 cd; returns its name."""
    with open(path, "w") as stream:
        stream.write("IESNA:LM-63-2002\n[LUMINAIRE] Downlight\nTILT=NONE\n"
                     "1 -1 1 4 1 1 2 -0.1 -0.1 0\n1 1 10\n0 30 60 90\n0\n100 90 40 0\n")
    return path
