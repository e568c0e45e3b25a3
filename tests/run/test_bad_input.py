# SPDX-License-Identifier: BSD-3-Clause
"""Bad input: exit status 2, one line that says what and where, nothing written."""
import base64
import copy
import json
import os
import struct
import tempfile

import tiny_scene
from front_end import listing, require, run


def scenes(folder):
    """(what, path or arguments, words that the line must contain)."""
    good = tiny_scene.document()

    def changed(name, change):
        gltf = copy.deepcopy(good)
        change(gltf)
        return tiny_scene.write(os.path.join(folder, name + ".gltf"), gltf)

    def colour(values):
        def change(gltf):
            gltf["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = values
        return change

    def not_a_number(gltf):
        data = bytearray(base64.b64decode(gltf["buffers"][0]["uri"].split(",")[1]))
        data[4:8] = struct.pack("<f", float("nan"))  # y of the floor's first point
        gltf["buffers"][0]["uri"] = (
            "data:application/octet-stream;base64," + base64.b64encode(bytes(data)).decode())

    def light_type(gltf):
        gltf["extensions"]["KHR_lights_punctual"]["lights"][1]["type"] = "laser"

    def light_intensity(gltf):
        gltf["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = -5.0

    truncated = os.path.join(folder, "truncated.gltf")
    with open(changed("whole", lambda gltf: None), encoding="utf-8") as stream:
        text = stream.read()
    with open(truncated, "w", encoding="utf-8") as stream:
        stream.write(text[: len(text) // 2])
    binary = os.path.join(folder, "truncated.glb")
    with open(binary, "wb") as stream:
        stream.write(b"glTF" + struct.pack("<III", 2, 5000, 4000) + b"JSON{")
    empty = os.path.join(folder, "empty.glb")
    open(empty, "wb").close()

    yield "missing file", os.path.join(folder, "nowhere.gltf"), ["nowhere.gltf"]
    yield "a folder", folder, ["a folder with"]
    yield "truncated text", truncated, ["truncated.gltf"]
    yield "truncated binary", binary, ["truncated.glb"]
    yield "empty file", empty, ["empty.glb"]
    yield "NaN vertex", changed("nan", not_a_number), ["nan"]
    yield "negative reflectance", changed("negative", colour([-0.2, 0.5, 0.5, 1])), ["-0.2"]
    yield "reflectance above 1", changed("bright", colour([0.5, 1.5, 0.5, 1])), ["1.5"]
    yield "unknown light", changed("laser", light_type), ["laser"]
    yield "negative light", changed("dark", light_intensity), ["-5"]


with tempfile.TemporaryDirectory() as where:
    out = os.path.join(where, "out")
    for what, path, words in scenes(where):
        done = run(path, "--output", out, "--quiet", "--max-edge", 0)
        lines = [line for line in done.stderr.split("\n") if line]
        require(done.returncode == 2, what, "exit status", done.returncode, done.stderr)
        require(len(lines) == 1 and not done.stdout, what, "wrote", done.stderr, done.stdout)
        for word in words:
            require(word.lower() in lines[0].lower(), what, f"does not say {word}:", lines[0])
        require("Traceback" not in lines[0] and "0x" not in lines[0], what, lines[0])
        require(listing(out) is None, what, "left", listing(out))
        print(f"{what}: {lines[0]}")

    # A file where the output folder should be; and results that exist stay as they are.
    blocked = os.path.join(where, "blocked")
    with open(blocked, "w", encoding="utf-8") as stream:
        stream.write("mine")
    scene = tiny_scene.write(os.path.join(where, "good.gltf"))
    done = run(scene, "--output", blocked, "--quiet", "--max-edge", 0, "--no-radiosity")
    require(done.returncode == 2 and "not a folder" in done.stderr, done.returncode, done.stderr)
    with open(blocked, encoding="utf-8") as stream:
        require(stream.read() == "mine", "the user's file was changed")
    for wrong in (["--tolerance", "-1"], ["--size", "0x0"], ["--method", "magic"], ["--nonsense"]):
        done = run(scene, "--output", out, *wrong)
        require(done.returncode == 2 and listing(out) is None, wrong, done.returncode)

    # A scene without light is no fault: every value is 0, and that is said.
    dark = tiny_scene.write(os.path.join(where, "unlit.gltf"), tiny_scene.document(lights=False))
    done = run(dark, "--output", out, "--quiet", "--max-edge", 0)
    require(done.returncode == 0, done.returncode, done.stderr)
    require("warning" in done.stderr and "nothing gives light" in done.stderr, done.stderr)
    with open(os.path.join(out, "report.json"), encoding="utf-8") as stream:
        report = json.load(stream)
    require(any("nothing gives light" in words for words in report["assumptions"]), report)
    require("NaN" not in json.dumps(report), "the report has a NaN")
