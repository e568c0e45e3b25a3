# SPDX-License-Identifier: BSD-3-Clause
"""View factors under mpiexec: parts of a surface on each rank; all that one process gets."""
from rank_parts import run_ranks

run_ranks("ranks_view_factors.py", (2, 3))
