# SPDX-License-Identifier: BSD-3-Clause
"""What ranks bring: the simulating filters on one scene in 1, 2 and 4 processes of one thread each.

    ./run --python benchmarks/ranks.py [--scale 1] [--threads 1] [--only Dense]

Every process holds a slab of a furnished hall's cells. Seconds are those of the slowest rank, from a
barrier to the end of Update(); processor seconds are the rank's own (waiting for others left out as
far as the MPI library yields). Memory is the peak of Update() above what the process had before it
(VmHWM). The difference is that from the values of one process, relative to the greatest.
With --worker: what mpiexec starts.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

RUNS = [  # filter, method, cells wanted, with an area light
    ("Irradiance", 0, 30000, True),
    ("Irradiance", 0, 300000, False),
    ("Radiosity", 1, 2000, True),
    ("Radiosity", 2, 3000, True),
    ("Radiosity", 3, 6000, True),
]
METHODS = ["", "Dense", "Hierarchical", "MonteCarlo"]
TOLERANCE = 0.05


def hall(cells):
    """Quads of a closed hall of 20 m x 10 m x 4 m with rows of blocks on its floor."""
    import numpy as np
    boxes = [((0, 0, 0), (20, 10, 4), -1)]
    for i in range(8):
        for j in range(4):
            x, y = 1.0 + 2.3 * i, 0.8 + 2.4 * j
            boxes.append(((x, y, 0.05), (x + 0.9, y + 1.2, 0.6 + 0.25 * ((i + j) % 4)), 1))
    area = sum(2 * ((b[0] - a[0]) * (b[1] - a[1]) + (b[1] - a[1]) * (b[2] - a[2])
                    + (b[2] - a[2]) * (b[0] - a[0])) for a, b, _ in boxes)
    edge = (area / cells) ** 0.5
    points, quads = [], []
    for low, high, outward in boxes:
        low, high = np.array(low, float), np.array(high, float)
        for axis in range(3):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            nu, nv = (max(1, round((high[k] - low[k]) / edge)) for k in (u, v))
            for at, turn in ((low[axis], -outward), (high[axis], outward)):
                p = np.empty((nv + 1, nu + 1, 3))
                p[..., axis] = at
                p[..., u] = np.linspace(low[u], high[u], nu + 1)[None, :]
                p[..., v] = np.linspace(low[v], high[v], nv + 1)[:, None]
                first = sum(len(x) for x in points)
                points.append(p.reshape(-1, 3))
                a = first + (np.arange(nv)[:, None] * (nu + 1) + np.arange(nu)[None, :]).ravel()
                q = np.stack([a, a + 1, a + nu + 2, a + nu + 1], axis=1)
                quads.append(q if turn > 0 else q[:, ::-1])
    return np.concatenate(points), np.concatenate(quads)


def status(name):
    with open("/proc/self/status") as file:
        return next(int(line.split()[1]) / 1024.0 for line in file if line.startswith(name))


def work(options):
    import numpy as np
    import vtkmodules.all as vtk
    import vtkradiometry as vr
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    controller = vtk.vtkMultiProcessController.GetGlobalController()
    rank = controller.GetLocalProcessId() if controller else 0
    size = controller.GetNumberOfProcesses() if controller else 1
    points, quads = hall(options.cells)
    middle = points[quads].mean(axis=1)[:, 0]
    slab = np.argsort(np.argsort(middle, kind="stable"), kind="stable") * size // len(quads)
    own = np.nonzero(slab == rank)[0]
    used, place = np.unique(quads[own], return_inverse=True)
    data = vtk.vtkPolyData()
    p = vtk.vtkPoints()
    p.SetData(numpy_to_vtk(points[used], deep=True))
    data.SetPoints(p)
    cells = vtk.vtkCellArray()
    cells.SetData(4, numpy_to_vtk(place.reshape(-1).astype(np.int64), deep=True,
                                  array_type=vtk.VTK_ID_TYPE))
    data.SetPolys(cells)
    ids = numpy_to_vtk(own.astype(np.int64), deep=True, array_type=vtk.VTK_ID_TYPE)
    ids.SetName("GlobalCellIds")
    data.GetCellData().SetGlobalIds(ids)
    total = len(quads)
    del points, quads, middle, slab

    panel = vr.vtkAreaLightSource()
    panel.SetPosition(7.0, 5.0, 3.9)
    panel.SetDirection(0.0, 0.0, -1.0)
    panel.SetIntensity(40.0)
    lamp = vr.vtkPointLightSource()
    lamp.SetPosition(15.0, 3.0, 3.0)
    lamp.SetIntensity(60.0)
    f = getattr(vr, f"vtk{options.filter}Filter")()
    f.SetInputData(data)
    if options.panel:
        f.AddLightsConnection(panel.GetOutputPort())
    f.AddLightsConnection(lamp.GetOutputPort())
    f.SetRelativeTolerance(TOLERANCE)
    f.SetDiffuseReflectance(0.6)
    f.SetNumberOfThreads(options.threads)
    if options.method:
        f.SetMethod(options.method)
        f.SetRefinement(2)
    if controller:
        controller.Barrier()
    with open("/proc/self/clear_refs", "w") as file:
        file.write("5")  # the peak counts from here on
    before, begin, busy = status("VmRSS"), time.perf_counter(), time.process_time()
    f.Update()
    seconds, busy = time.perf_counter() - begin, time.process_time() - busy
    peak = status("VmHWM") - before
    out = f.GetOutputDataObject(0)
    field = out.GetFieldData().GetAbstractArray("RadiometryMethod")
    np.savez(f"{options.out}.{rank}.npz", ids=own,
             irradiance=vtk_to_numpy(out.GetCellData().GetArray("Irradiance")))
    with open(f"{options.out}.{rank}.json", "w") as file:
        json.dump({"seconds": seconds, "processor_seconds": busy, "peak_MiB": peak,
                   "cells": total, "own_cells": len(own),
                   "method": field.GetValue(0) if field else ""}, file)


def measure(name, method, cells, panel, ranks, folder, threads):
    import numpy as np
    out = os.path.join(folder, f"{name}-{method}-{cells}-{ranks}")
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1",
                       OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_mpi_yield_when_idle="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1",
                       OMPI_MCA_hwloc_base_binding_policy="none")
    subprocess.run(["mpiexec", "-np", str(ranks), "pvbatch", "--sym", os.path.abspath(__file__),
                    "--worker", "--filter", name, "--method", str(method), "--cells", str(cells),
                    "--panel", str(int(panel)), "--threads", str(threads), "--out", out],
                   env=environment, check=True, stdout=subprocess.DEVNULL)
    parts = []
    for r in range(ranks):
        with open(f"{out}.{r}.json") as file:
            parts.append(json.load(file))
    values = np.concatenate([np.load(f"{out}.{r}.npz")["irradiance"] for r in range(ranks)])
    ids = np.concatenate([np.load(f"{out}.{r}.npz")["ids"] for r in range(ranks)])
    return {"ranks": ranks, "seconds": max(p["seconds"] for p in parts),
            "processor_seconds_per_rank": [p["processor_seconds"] for p in parts],
            "peak_MiB_per_rank": [p["peak_MiB"] for p in parts],
            "cells": parts[0]["cells"], "method": parts[0]["method"]}, values[np.argsort(ids)]


def main(options):
    import numpy as np
    results = []
    with tempfile.TemporaryDirectory() as folder:
        for name, method, cells, panel in RUNS:
            if options.only and options.only not in (name, METHODS[method]):
                continue
            one = None
            for ranks in (1, 2, 4):
                row, values = measure(name, method, int(cells * options.scale), panel, ranks,
                                      folder, options.threads)
                one = values if one is None else one
                row.update(filter=name, asked=METHODS[method], area_light=panel, bytes_equal=bool(
                    values.tobytes() == one.tobytes()),
                    greatest_difference=float(np.abs(values - one).max() / np.abs(one).max()))
                print(json.dumps(row), flush=True)
                results.append(row)
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    from provenance import provenance, write
    write(options.out or "ranks", {
        "question": "What do several ranks on one machine bring and cost?", **provenance(),
        "processors": os.cpu_count(), "threads_per_rank": options.threads,
        "tolerance": TOLERANCE, "runs": results})


parser = argparse.ArgumentParser()
parser.add_argument("--worker", action="store_true")
parser.add_argument("--filter", default="Irradiance")
parser.add_argument("--method", type=int, default=0)
parser.add_argument("--cells", type=int, default=1000)
parser.add_argument("--panel", type=int, default=1)
parser.add_argument("--threads", type=int, default=1)
parser.add_argument("--scale", type=float, default=1.0, help="times the numbers of cells")
parser.add_argument("--only", help="a filter or a method")
parser.add_argument("--out")
given = parser.parse_args()
(work if given.worker else main)(given)
