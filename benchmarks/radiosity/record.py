# SPDX-License-Identifier: BSD-3-Clause
from provenance import provenance, write  # noqa: F401
