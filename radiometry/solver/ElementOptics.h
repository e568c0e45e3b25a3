// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/irradiance/EmitterIrradiance.h"
#include "radiometry/scene/Scene.h"
#include "radiometry/solver/DiffuseScattering.h"

#include <vector>

namespace radiometry
{

/// Reflectance, diffuse transmittance and exitance of each element, elements x bands. The back of a
/// cell that is not two-sided reflects and emits nothing: it is there where the cell lets light
/// through diffusely.
struct ElementOptics
{
  ElementOptics(
    const Scene& scene, const ElementSet& elements, bool emission, bool transmission = true);

  /// R: what leaves elements of what falls on them.
  DiffuseScattering Scattering() const;
  /// leaving = M + R E (emission) or R E, of all bands.
  void Leave(const std::vector<double>& irradiance, bool emission, std::vector<double>& leaving) const;

  int Bands = 1;
  std::vector<double> Reflectance;
  std::vector<double> Transmittance;  // diffuse; empty: none anywhere
  std::vector<std::int32_t> Opposite; // the element on the other side, -1; empty with the former
  std::vector<double> Exitance;       // W/m^2
};

/// Fails: InputError{array, cell, value} for reflectance outside [0, 1], emission negative, either
/// not finite, or arrays of the wrong length.
void CheckOptics(const Scene& scene);

/// Undivided emitting triangles as lights, when they are few and small enough to be treated as
/// such: at most a quarter of the elements' area and `mostPairs` pairs; else empty.
EmitterSet SmallEmitters(
  const Scene& scene, const ElementSet& elements, bool backFaces, std::size_t mostPairs);

} // namespace radiometry
