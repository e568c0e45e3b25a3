// SPDX-License-Identifier: BSD-3-Clause
// Private to filters/: what a run cost, as data.
#ifndef RunCostData_h
#define RunCostData_h

#include "radiometry/accuracy/RunCost.h"

class vtkFieldData;

/// Writes the field array RadiometryCost (docs/arrays.md).
void AddRunCost(const radiometry::RunCost& cost, vtkFieldData* data);

#endif
