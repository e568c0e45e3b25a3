# SPDX-License-Identifier: BSD-3-Clause
"""Radiance under mpiexec: parts of a surface on each rank; all that one process gets."""
from rank_parts import run_ranks

run_ranks("ranks_radiance.py", (2,))
