# SPDX-License-Identifier: BSD-3-Clause
"""Radiosity under mpiexec: parts, ghost cells, an empty rank; all that one process gets."""
from rank_parts import run_ranks

run_ranks("ranks_radiosity.py", (2, 3))
