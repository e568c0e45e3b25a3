# SPDX-License-Identifier: BSD-3-Clause
"""python -m vtkradiometry SCENE [options]"""
import sys

from .cli import main

sys.exit(main())
