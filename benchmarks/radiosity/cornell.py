# SPDX-License-Identifier: BSD-3-Clause
"""The Cornell box of examples/cornell-box as plain numpy: triangles of even size, reflectance, exitance.

The example has holes in the floor under the blocks and in the ceiling for the lamp, so that no surface
lies on another: programs that move the origins of their rays are not asked what they cannot answer.
"""
import os

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PATH = os.path.join(ROOT, "examples", "cornell-box", "cornell-box.glb")


class Box:
    """corners: cells x 3 x 3, m, counter-clockwise seen from inside; reflectance, exitance: cells x 3.

    Cells of one material are consecutive (`kinds`: first and last cell + 1), as meshes are elsewhere.
    """

    def __init__(self, edge):
        import vtkradiometry as vr
        from vtkmodules.util.numpy_support import vtk_to_numpy

        reader = vr.vtkRadiometricSceneReader()
        reader.SetFileName(PATH)
        reader.Update()
        surface = reader.GetOutput(0)
        cells = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        coarse = vtk_to_numpy(surface.GetPoints().GetData())[cells].astype(float)
        optics = np.concatenate([vtk_to_numpy(surface.GetCellData().GetArray(name))
                                 for name in ("DiffuseReflectance", "EmittedExitance")], 1)
        order = np.lexsort(optics.T[::-1])
        parts = [divided(coarse[i], edge) for i in order]
        self.corners = np.concatenate(parts)
        optics = np.repeat(optics[order], [len(part) for part in parts], 0).astype(float)
        self.reflectance, self.exitance = optics[:, :3], optics[:, 3:]
        change = np.flatnonzero((np.diff(optics, axis=0) != 0).any(1)) + 1
        ends = [0, *change.tolist(), len(optics)]
        self.kinds = list(zip(ends[:-1], ends[1:]))
        cross = np.cross(self.corners[:, 1] - self.corners[:, 0],
                         self.corners[:, 2] - self.corners[:, 0])
        self.area = 0.5 * np.linalg.norm(cross, axis=1)
        self.normal = cross / (2.0 * self.area[:, None])

    def __len__(self):
        return len(self.corners)


def divided(triangle, edge):
    """Similar triangles with edges of at most `edge`."""
    a, b, c = triangle
    longest = max(np.linalg.norm(b - a), np.linalg.norm(c - b), np.linalg.norm(a - c))
    n = max(1, int(np.ceil(longest / edge)))

    def at(i, j):
        return a + (b - a) * (i / n) + (c - a) * (j / n)

    out = []
    for i in range(n):
        for j in range(n - i):
            out.append([at(i, j), at(i + 1, j), at(i, j + 1)])
            if i + j < n - 1:
                out.append([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
    return np.array(out)
