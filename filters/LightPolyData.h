// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/LightRecord.h"

#include <vector>

class vtkPolyData;

/// Writes lights as the vertices, point arrays and field data of docs/arrays.md.
/// All records must have the same number of bands.
void WriteLights(const std::vector<radiometry::LightRecord>& lights, int bands, bool photometric,
  double luminousEfficacy, vtkPolyData* output);
