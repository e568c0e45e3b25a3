// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/irradiance/EmitterIrradiance.h"
#include "radiometry/scene/Scene.h"

#include <vector>

namespace radiometry
{

/// Reflectance and exitance of each element, elements x bands.
struct ElementOptics
{
  ElementOptics(const Scene& scene, const ElementSet& elements, bool emission);

  int Bands = 1;
  std::vector<double> Reflectance;
  std::vector<double> Exitance; // W/m^2
};

/// Fails: InputError{array, cell, value} for reflectance outside [0, 1], emission negative, either
/// not finite, or arrays of the wrong length.
void CheckOptics(const Scene& scene);

/// Undivided emitting triangles as lights, when they are few and small enough to be treated as
/// such: at most a quarter of the elements' area and `mostPairs` pairs; else empty.
EmitterSet SmallEmitters(
  const Scene& scene, const ElementSet& elements, bool backFaces, std::size_t mostPairs);

} // namespace radiometry
