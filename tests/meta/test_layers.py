# SPDX-License-Identifier: BSD-3-Clause
"""A dependency may only point up the path of the data (docs/architecture.md).

Reads the #include lines of every C++ file and names each that goes against the arrows.
"""
import os
import re

import source_tree

# Each stage of the core may include itself and the stages before it.
CORE = ["scene", "accuracy", "geometry", "visibility", "effects", "irradiance", "formfactor",
        "solver"]
PROJECT = ("radiometry/", "color/", "io/", "filters/", "rendering/")
OPENGL = re.compile(
    r"^vtk.*(OpenGL|RenderWindow|Renderer|RenderPass|Mapper|Actor|Shader|Texture|Framebuffer)"
    r"|^(vtk_glew|GL/)"
)
VTK = re.compile(r"^(vtk|pv|vtkPV)")
STANDARD = re.compile(r"^[a-z_]+$")  # <vector>, <cmath>: no dot, no slash
CORE_EXTERNAL = re.compile(r"^(embree[34]/|oneapi/tbb|tbb/|Eigen/|unsupported/Eigen/)")
C_SYSTEM = {"immintrin.h", "xmmintrin.h", "pmmintrin.h", "unistd.h"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def core_stage(path):
    parts = path.split("/")
    return parts[1] if parts[0] == "radiometry" and len(parts) > 2 else None


def judge(path, name):
    """Why the file `path` may not include `name`; None if it may."""
    room = path.split("/")[0]
    if room == "radiometry":
        if name.startswith("radiometry/"):
            own, other = core_stage(path), core_stage(name)
            if own == other:
                return None
            if own == "shading":
                return None if other == "scene" else "shading may include scene only"
            if own == "imaging":
                return None if other in ("scene", "shading") else "imaging may include scene and shading"
            if other in ("shading", "imaging"):
                return f"{other} is a leaf: nothing that simulates may include it"
            if other not in CORE or own not in CORE:
                return f"unknown stage {other if other not in CORE else own}"
            if CORE.index(other) > CORE.index(own):
                return f"{own} comes before {other}"
            return None
        if STANDARD.match(name) or CORE_EXTERNAL.match(name) or name in C_SYSTEM:
            return None
        return "radiometry/ includes the standard library, Embree, oneTBB and Eigen only"
    if room in ("color", "io"):
        if VTK.match(name):
            return f"{room}/ knows no VTK"
        if name.startswith(PROJECT) and not name.startswith((room + "/", "radiometry/scene/")):
            return f"{room}/ stands alone"
        return None
    if room == "filters":
        if name.startswith(("rendering/", "color/")):
            return "filters/ never includes rendering/ or color/"
        if OPENGL.match(name):
            return "filters/ uses VTK without OpenGL"
        return None
    if room == "rendering":
        if name.startswith("filters/"):
            return "rendering/ never includes filters/"
        if name.startswith("radiometry/") and not name.startswith(
            ("radiometry/scene/", "radiometry/shading/", "radiometry/imaging/")
        ) and name != "radiometry/effects/EffectPlan.h":
            return "rendering/ uses the core's scene, shading and imaging headers and its EffectPlan only"
        if name.startswith("io/") and not name.startswith("io/Exr") and name != "io/FileError.h":
            return "rendering/ uses of io/ the image files only"
        return None
    return None


def filter_headers(files):
    return {os.path.basename(p) for p in files if p.startswith("filters/") and p.endswith(".h")}


def check(files, read):
    own_filters = filter_headers(files)
    problems = []
    for path in files:
        if not path.endswith((".h", ".hpp", ".cxx", ".cpp", ".txx")):
            continue
        if path.split("/")[0] + "/" not in PROJECT:
            continue
        content = read(path)
        for match in INCLUDE.finditer(content):
            name = match.group(2)
            reason = judge(path, name)
            if reason is None and path.startswith("rendering/") and name in own_filters:
                reason = "rendering/ never includes filters/"
            if reason:
                line = content.count("\n", 0, match.start()) + 2
                problems.append(f"{path}: includes {name}: {reason} (near line {line})")
    return problems


def self_check():
    """The check must find each kind of wrong arrow, and pass the right ones."""
    wrong = {
        "radiometry/scene/A.h": '#include "radiometry/solver/B.h"\n',
        "radiometry/solver/B.h": "#include <vtkPolyData.h>\n",
        "radiometry/geometry/C.cxx": '#include "radiometry/shading/S.h"\n',
        "radiometry/shading/S.h": '#include "radiometry/geometry/C.h"\n',
        "color/D.h": '  #  include "vtkObject.h"\n',
        "io/E.cxx": '#include "filters/vtkF.h"\n',
        "filters/vtkF.h": '#include "vtkOpenGLRenderWindow.h"\n',
        "filters/vtkG.cxx": '#include "rendering/vtkM.h"\n',
        "rendering/vtkM.h": '#include "vtkF.h"\n',
        "rendering/vtkN.cxx": '#include "radiometry/solver/B.h"\n',
    }
    for path, content in wrong.items():
        listing = dict.fromkeys(["filters/vtkF.h", path])
        found = check(list(listing), lambda p: content if p == path else "")
        assert len(found) == 1, (path, found)
    right = {
        "radiometry/solver/B.h": '#include "radiometry/scene/A.h"\n#include <vector>\n'
        "#include <embree3/rtcore.h>\n#include <tbb/parallel_for.h>\n#include <Eigen/Dense>\n",
        "filters/vtkF.cxx": '#include "vtkPolyData.h"\n#include "radiometry/solver/B.h"\n',
        "rendering/vtkM.cxx": '#include "color/D.h"\n#include "radiometry/shading/S.h"\n',
    }
    assert check(list(right), right.get) == []


if __name__ == "__main__":
    self_check()
    tree = source_tree.files()
    assert any(path.startswith("radiometry/") for path in tree), "no sources found"
    source_tree.finish(check(tree, source_tree.text))
