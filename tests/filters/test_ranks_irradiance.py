# SPDX-License-Identifier: BSD-3-Clause
"""Direct light under mpiexec: parts, ghost cells, lights here and there; all that one process gets."""
from rank_parts import run_ranks

run_ranks("ranks_irradiance.py")
