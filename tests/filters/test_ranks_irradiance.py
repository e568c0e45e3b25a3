# SPDX-License-Identifier: BSD-3-Clause
"""Direct light under mpiexec: parts, ghost cells, lights here and there; all that one process gets."""
import os
import tempfile

from rank_parts import run_ranks

run_ranks("ranks_irradiance.py", (2, 3))
with tempfile.TemporaryDirectory() as folder:
    for ranks in (1, 2):
        run_ranks("ranks_paraview.py", (ranks,), False, os.path.join(folder, "one.json"))
