// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/LightRecord.h"

#include <string>
#include <vector>

class vtkPolyData;

/// Writes lights as the vertices (area lights: polygons), point arrays and field data of docs/arrays.md.
/// All records must have the same number of bands.
void WriteLights(const std::vector<radiometry::LightRecord>& lights, int bands, bool photometric,
  double luminousEfficacy, vtkPolyData* output);

/// Reads them back: every point of `input` is a light, but those of LightType 3 are the corners of
/// area lights, one a polygon, which come last; arrays that are missing take their defaults
/// (docs/arrays.md). An Intensity of one component serves all bands.
/// Fails: radiometry::InputError naming `prefix` + array, index and value.
std::vector<radiometry::LightRecord> ReadLights(
  vtkPolyData* input, int bands, const std::string& prefix = "");
