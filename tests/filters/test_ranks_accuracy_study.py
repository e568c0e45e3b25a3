# SPDX-License-Identifier: BSD-3-Clause
"""Accuracy Study under mpiexec: the first rank has the figures that one process gets."""
from rank_parts import run_ranks

run_ranks("ranks_accuracy_study.py", (2,))
