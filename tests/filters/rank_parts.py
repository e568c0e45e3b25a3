# SPDX-License-Identifier: BSD-3-Clause
"""Scenes in parts for tests under mpiexec: every rank knows the whole and takes its part."""
import os
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np


def run_ranks(script, sizes, symmetric=True, *arguments, timeout=240):
    """Runs a script of this folder in pvbatch on so many ranks each; any failure ends this one."""
    if not shutil.which("mpiexec") or not shutil.which("pvbatch"):
        print("skipped: no mpiexec or no pvbatch")
        sys.exit(77)
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1",
                       OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1",
                       OMPI_MCA_hwloc_base_binding_policy="none",
                       OMPI_MCA_mpi_yield_when_idle="1", PYTHONUNBUFFERED="1")
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), script)
    for size in sizes:
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(["mpiexec", "-np", str(size), "pvbatch",
                                   *(["--sym"] if symmetric else []), path, *arguments],
                                  env=dict(environment, RADIOMETRY_RANKS_FOLDER=folder),
                                  timeout=timeout, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True)
        print(done.stdout)
        assert done.returncode == 0, (script, size, done.returncode)
        # pvbatch ends with 0 whatever a script did: it says itself that it came to its end.
        assert done.stdout.count("all checks passed") == (size if symmetric else 1), (script, size)


def in_ranks(namespace):
    """Runs every check_* on all ranks in the same order."""
    import traceback
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
    for name, function in list(namespace.items()):
        if name.startswith("check_") and callable(function):
            try:
                function()
            except BaseException:
                print(f"rank {rank}: {name} failed\n{traceback.format_exc()}", flush=True)
                os._exit(1)  # mpiexec ends the other ranks
            if rank == 0:
                print("passed", name, flush=True)
    print("all checks passed", flush=True)


def controller():
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    return vtkMultiProcessController.GetGlobalController()


def rank():
    return controller().GetLocalProcessId() if controller() else 0


def size():
    return controller().GetNumberOfProcesses() if controller() else 1


class Alone:
    """A filter as one process runs it: rank 0 does, in one thread, and the others take its outputs from
    a file, for which they wait asleep. All ranks ask in the same order."""
    asked = 0

    def __init__(self, filtered):
        filtered.SetController(None)
        filtered.SetNumberOfThreads(1)
        self._filter = filtered
        self._outputs = None

    def __getattr__(self, name):
        if name.startswith(("Set", "Add", "Remove")):
            self._outputs = None
        return getattr(self._filter, name)

    def Update(self):
        if self._outputs is None:
            ports = range(self._filter.GetNumberOfOutputPorts())
            paths = [os.path.join(os.environ["RADIOMETRY_RANKS_FOLDER"], f"{Alone.asked}.{port}")
                     for port in ports]
            Alone.asked += 1
            if rank() == 0:
                self._filter.Update()
                self._outputs = [self._filter.GetOutputDataObject(port) for port in ports]
                for path, output in zip(paths, self._outputs):
                    write(path, output)
            else:
                self._outputs = [read(path) for path in paths]

    def GetOutputDataObject(self, port):
        return self._outputs[port]


def write(path, data):
    import vtkmodules.all as vtk
    writer = vtk.vtkGenericDataObjectWriter()
    writer.SetFileTypeToBinary()
    writer.SetFileName(path + ".part")
    writer.SetInputData(data)
    assert writer.Write() == 1, path
    os.rename(path + ".part", path)


def read(path):
    import vtkmodules.all as vtk
    while not os.path.exists(path):
        time.sleep(0.005)
    reader = vtk.vtkGenericDataObjectReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def set_array(attributes, name, values):
    from vtkmodules.util.numpy_support import numpy_to_vtk
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    attributes.AddArray(array)
    return array


def surface(points, polygons, single=False, **cell_arrays):
    """Polydata of polygons (lists of numbers of points) with cell arrays."""
    import vtkmodules.all as vtk
    from vtkmodules.util.numpy_support import numpy_to_vtk
    data = vtk.vtkPolyData()
    p = vtk.vtkPoints()
    p.SetData(numpy_to_vtk(np.asarray(points, np.float32 if single else float), deep=True))
    cells = vtk.vtkCellArray()
    for polygon in polygons:
        cells.InsertNextCell(len(polygon), list(polygon))
    data.SetPoints(p)
    data.SetPolys(cells)
    for name, values in cell_arrays.items():
        set_array(data.GetCellData(), name, values)
    return data


class Scene:
    """A surface as numpy: points, polygons, cell arrays."""

    def __init__(self):
        self.points = []
        self.polygons = []
        self.arrays = {}

    def add_grid(self, origin, u, v, n, **values):
        """n x n quads in the plane of u and v; the last of a row as two triangles."""
        first = len(self.points)
        origin, u, v = (np.asarray(x, float) for x in (origin, u, v))
        for j in range(n + 1):
            for i in range(n + 1):
                self.points.append(origin + u * i / n + v * j / n)
        for j in range(n):
            for i in range(n):
                a = first + j * (n + 1) + i
                quad = [a, a + 1, a + n + 2, a + n + 1]
                cells = [quad[:3], [quad[0], quad[2], quad[3]]] if i == n - 1 else [quad]
                for cell in cells:
                    self.polygons.append(cell)
                    for name, value in values.items():
                        self.arrays.setdefault(name, []).append(value)
        return self

    def add_box(self, low, high, n, **values):
        """A box seen from outside."""
        low, high = np.asarray(low, float), np.asarray(high, float)
        for axis in range(3):
            a, b = np.zeros(3), np.zeros(3)
            a[(axis + 1) % 3] = (high - low)[(axis + 1) % 3]
            b[(axis + 2) % 3] = (high - low)[(axis + 2) % 3]
            self.add_grid(low, b, a, n, **values)
            top = low.copy()
            top[axis] = high[axis]
            self.add_grid(top, a, b, n, **values)
        return self

    def whole(self, order=None):
        order = range(len(self.polygons)) if order is None else order
        return self._make(list(order), np.zeros(len(list(order)), np.uint8), None)

    def part(self, owner, mine, ids=True, ghosts=True):
        """The cells that `mine` owns, and those that touch them as ghosts. Returns it and the
        number of each of its cells in the whole."""
        owner = np.asarray(owner)
        own = [c for c in range(len(self.polygons)) if owner[c] == mine]
        cells, flags = list(own), [0] * len(own)
        if ghosts:
            touched = {p for c in own for p in self.polygons[c]}
            for c, polygon in enumerate(self.polygons):
                if owner[c] != mine and touched.intersection(polygon):
                    cells.append(c)
                    flags.append(1)
        return self._make(cells, np.array(flags, np.uint8), ids), np.array(cells, int)

    def _make(self, cells, ghosts, ids):
        used = sorted({p for c in cells for p in self.polygons[c]})
        place = {p: k for k, p in enumerate(used)}
        data = surface(np.array([self.points[p] for p in used]).reshape(-1, 3),
                       [[place[p] for p in self.polygons[c]] for c in cells],
                       **{name: np.array([values[c] for c in cells])
                          for name, values in self.arrays.items()})
        if ghosts.any():
            set_array(data.GetCellData(), "vtkGhostType", ghosts)
        if ids:
            data.GetCellData().SetGlobalIds(
                set_array(data.GetCellData(), "GlobalCellIds", np.array(cells, np.int64)))
            data.GetPointData().SetGlobalIds(
                set_array(data.GetPointData(), "GlobalPointIds", np.array(used, np.int64)))
        return data


def room(n=6):
    """A floor, two walls and a box on the floor, which casts shadows over the parts of all ranks."""
    grey = dict(DiffuseReflectance=0.6, TwoSided=0.0)
    return (Scene()
            .add_grid((-2, -2, 0), (4, 0, 0), (0, 4, 0), 2 * n, **grey)
            .add_grid((-2, 2, 0), (4, 0, 0), (0, 0, 3), n, DiffuseReflectance=0.3, TwoSided=0.0)
            .add_grid((2, -2, 0), (0, 0, 3), (0, 4, 0), n, DiffuseReflectance=0.8, TwoSided=1.0)
            .add_box((-0.5, -0.4, 0.0), (0.4, 0.6, 1.1), max(1, n // 2), **grey))
