// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/LightRecord.h"

#include "vtkType.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkDataArray;
class vtkPolyData;

/// Adds what says how environment lights are distributed (docs/arrays.md), where any is one: point
/// data SkyModel, SkyCoefficients, SunDirection, EnvironmentMap, GroundRadiance; field data, for
/// each map k, EnvironmentMap<k> (a tuple a pixel) and EnvironmentMap<k>Size (width, height).
/// `points` is the point of each light.
void WriteSkies(const std::vector<radiometry::LightRecord>& lights,
  const std::vector<vtkIdType>& points, vtkPolyData* output);

/// Reads them back, each map once.
/// Fails: radiometry::InputError naming `prefix` + array, index and value.
class SkyReader
{
public:
  SkyReader(vtkPolyData* input, int bands, const std::string& prefix);

  /// The sky of the environment light at point i, whose Direction and Reference are known.
  std::shared_ptr<const radiometry::SkyRadiance> At(
    vtkIdType i, const radiometry::LightRecord& light);

private:
  vtkDataArray* Find(const char* name, int components) const;
  std::shared_ptr<const radiometry::SkyRadiance> Map(vtkIdType i);

  vtkPolyData* Input;
  int Bands;
  std::string Prefix;
  std::map<int, std::shared_ptr<const radiometry::SkyRadiance>> Maps;
};
