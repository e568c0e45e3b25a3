# SPDX-License-Identifier: BSD-3-Clause
"""Calls the front end and reads what it wrote, independently of the project's own readers."""
import os
import struct
import subprocess
import sys

PYTHON = "/usr/bin/python3"


def run(*arguments, timeout=250):
    """python -m vtkradiometry ARGUMENTS; returns the finished process."""
    return subprocess.run([PYTHON, "-m", "vtkradiometry", *map(str, arguments)],
                          capture_output=True, text=True, timeout=timeout, check=False)


def require(condition, *words):
    """A failed requirement ends the test."""
    if not condition:
        print("FAILED:", *words)
        sys.exit(1)


def exr_header(path):
    """{attribute: (type, bytes)} of a single-part OpenEXR file, read by hand."""
    with open(path, "rb") as stream:
        data = stream.read()
    magic, version = struct.unpack_from("<iI", data)
    require(magic == 20000630, "not OpenEXR", path)
    require(version & 0x1000 == 0, "a multi-part file", path)
    place, attributes = 8, {}
    while data[place] != 0:
        end = data.index(b"\0", place)
        name = data[place:end].decode()
        place = end + 1
        end = data.index(b"\0", place)
        kind = data[place:end].decode()
        size, = struct.unpack_from("<i", data, end + 1)
        place = end + 5
        attributes[name] = (kind, data[place:place + size])
        place += size
    return attributes


def exr_channels(attributes):
    """{channel: pixel type}: 0 integer, 1 half, 2 float."""
    data = attributes["channels"][1]
    place, channels = 0, {}
    while data[place] != 0:
        end = data.index(b"\0", place)
        channels[data[place:end].decode()] = struct.unpack_from("<i", data, end + 1)[0]
        place = end + 17
    return channels


def listing(folder):
    """Every file and folder below, hidden ones too; None if the folder does not exist."""
    if not os.path.exists(folder):
        return None
    return sorted(os.path.join(where, name) for where, folders, files in os.walk(folder)
                  for name in folders + files)
