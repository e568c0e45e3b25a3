# SPDX-License-Identifier: BSD-3-Clause
"""Writes small glTF files, and reads any by an independent route (JSON and numpy only)."""
import base64
import json
import os
import struct

import numpy as np

COMPONENT = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32,
             5126: np.float32}
WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class Builder:
    """A glTF document with one buffer, built piece by piece."""

    def __init__(self):
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]}
        self.bytes = bytearray()

    def add(self, group, value):
        self.json.setdefault(group, []).append(value)
        return len(self.json[group]) - 1

    def accessor(self, values, dtype=np.float32, stride=0, **more):
        values = np.asarray(values, dtype)
        width = 1 if values.ndim == 1 else values.shape[1]
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        start = len(self.bytes)
        rows = values.reshape(len(values), -1)
        for row in rows:
            packed = row.tobytes()
            self.bytes += packed + b"\xAA" * max(0, stride - len(packed))
        view = {"buffer": 0, "byteOffset": start, "byteLength": len(self.bytes) - start}
        if stride:
            view["byteStride"] = stride
        code = next(c for c, t in COMPONENT.items() if t == dtype)
        kind = next(k for k, w in WIDTH.items() if w == width)
        return self.add("accessors", {"bufferView": self.add("bufferViews", view),
                                      "componentType": code, "count": len(values), "type": kind,
                                      **more})

    def mesh(self, positions, indices=None, normals=None, material=None, mode=None,
             index_type=np.uint16, stride=0):
        attributes = {"POSITION": self.accessor(positions, stride=stride)}
        if normals is not None:
            attributes["NORMAL"] = self.accessor(normals)
        primitive = {"attributes": attributes}
        if indices is not None:
            primitive["indices"] = self.accessor(np.ravel(indices), index_type)
        if material is not None:
            primitive["material"] = self.add("materials", material)
        if mode is not None:
            primitive["mode"] = mode
        return self.add("meshes", {"primitives": [primitive]})

    def node(self, root=True, **fields):
        index = self.add("nodes", fields)
        if root:
            self.json["scenes"][0]["nodes"].append(index)
        return index

    def light(self, root=True, transform=None, **fields):
        self.json["extensionsUsed"] = ["KHR_lights_punctual"]
        lights = self.json.setdefault("extensions", {}).setdefault(
            "KHR_lights_punctual", {"lights": []})["lights"]
        lights.append(fields)
        return self.node(root, extensions={"KHR_lights_punctual": {"light": len(lights) - 1}},
                         **(transform or {}))

    def write(self, path):
        """As .gltf with the buffer inside, or as .glb, by the name."""
        document = dict(self.json)
        if self.bytes:
            document["buffers"] = [{"byteLength": len(self.bytes)}]
        if path.endswith(".glb"):
            text = json.dumps(document).encode()
            text += b" " * (-len(text) % 4)
            body = bytes(self.bytes) + b"\0" * (-len(self.bytes) % 4)
            chunks = struct.pack("<I4s", len(text), b"JSON") + text
            if body:
                chunks += struct.pack("<I4s", len(body), b"BIN\0") + body
            content = struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
            with open(path, "wb") as file:
                file.write(content)
        else:
            if self.bytes:
                document["buffers"][0]["uri"] = (
                    "data:application/octet-stream;base64,"
                    + base64.b64encode(bytes(self.bytes)).decode())
            with open(path, "w") as file:
                json.dump(document, file)
        return path


SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
SQUARE_TRIANGLES = [[0, 1, 2], [0, 2, 3]]


def square(material=None, **node):
    builder = Builder()
    builder.node(mesh=builder.mesh(SQUARE, SQUARE_TRIANGLES, [[0, 0, 1]] * 4, material), **node)
    return builder


def load(path):
    """The document and its buffers, without any of the code under test."""
    with open(path, "rb") as file:
        content = file.read()
    if content[:4] == b"glTF":
        length = struct.unpack_from("<I", content, 12)[0]
        document = json.loads(content[20:20 + length])
        return document, [content[28 + length:]]
    document = json.loads(content)
    buffers = []
    for buffer in document.get("buffers", []):
        uri = buffer["uri"]
        if uri.startswith("data:"):
            buffers.append(base64.b64decode(uri.split(",", 1)[1]))
        else:
            with open(os.path.join(os.path.dirname(path), uri), "rb") as file:
                buffers.append(file.read())
    return document, buffers


def values(document, buffers, index):
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    dtype = np.dtype(COMPONENT[accessor["componentType"]])
    width = WIDTH[accessor["type"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    stride = view.get("byteStride", dtype.itemsize * width)
    return np.ndarray((accessor["count"], width), dtype, buffers[view["buffer"]], start,
                      (stride, dtype.itemsize)).astype(float)


def local_matrix(node):
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    matrix = np.eye(4)
    x, y, z, w = np.array(node.get("rotation", [0, 0, 0, 1]), float)
    # The quaternion sandwich, written as a product of matrices and not as the usual formula.
    left = np.array([[w, -z, y, x], [z, w, -x, y], [-y, x, w, z], [-x, -y, -z, w]])
    right = np.array([[w, -z, y, -x], [z, w, -x, -y], [-y, x, w, -z], [x, y, z, w]])
    rotation = (left @ right)[:3, :3] / (x * x + y * y + z * z + w * w)
    matrix[:3, :3] = rotation @ np.diag(node.get("scale", [1, 1, 1]))
    matrix[:3, 3] = node.get("translation", [0, 0, 0])
    return matrix


def world_matrices(document):
    """{node: matrix} of the nodes of the default scene, parents before children."""
    found = {}

    def visit(index, parent):
        found[index] = parent @ local_matrix(document["nodes"][index])
        for child in document["nodes"][index].get("children", []):
            visit(child, found[index])

    if document.get("scenes"):
        for root in document["scenes"][document.get("scene", 0)].get("nodes", []):
            visit(root, np.eye(4))
    return found


def world_triangles(document, buffers):
    """All triangles (n x 3 x 3) of indexed triangle meshes, corner order as in the file, and the
    sign of each one's transform."""
    corners, signs = [np.zeros((0, 3, 3))], [np.zeros(0)]
    for index, matrix in world_matrices(document).items():
        mesh = document["nodes"][index].get("mesh")
        if mesh is None:
            continue
        for primitive in document["meshes"][mesh]["primitives"]:
            points = values(document, buffers, primitive["attributes"]["POSITION"])
            points = points @ matrix[:3, :3].T + matrix[:3, 3]
            order = values(document, buffers, primitive["indices"]).astype(int).reshape(-1, 3)
            corners.append(points[order])
            signs.append(np.full(len(order), np.sign(np.linalg.det(matrix[:3, :3]))))
    return np.concatenate(corners), np.concatenate(signs)


def areas(corners):
    return 0.5 * np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
