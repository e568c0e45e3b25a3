// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/CandelaWeb.h"

#include <memory>
#include <string>

class vtkFieldData;

/// Candela webs as field data of lights (docs/arrays.md). Web k is four arrays:
///   PhotometricWeb<k>             values relative to the greatest, plane by plane
///   PhotometricWeb<k>Horizontal   degrees
///   PhotometricWeb<k>Vertical     degrees
///   PhotometricWeb<k>Type         1 C (default), 2 B, 3 A
void WriteWeb(const radiometry::CandelaWeb& web, int k, vtkFieldData* output);

/// Reads web k; null when there is none of that number.
/// Fails: radiometry::InputError naming `prefix` + array.
std::shared_ptr<const radiometry::CandelaWeb> ReadWeb(
  vtkFieldData* input, int k, const std::string& prefix);
