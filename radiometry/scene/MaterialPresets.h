// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace radiometry
{

/// Typical values of a material; three bands of linear Rec.709.
struct MaterialPreset
{
  const char* Name;
  std::array<double, 3> Diffuse;
  const char* Source;
};

/// The values of vtkSurfaceMaterialFilter's Preset, from 1. All are matt: no specular lobe.
///   IES LM-83-12: reflectances to assume for the surfaces of a room in daylight studies.
///   Oke 1987: Boundary Layer Climates, 2nd ed.: ranges of albedo of natural and
///   urban surfaces; the middle of the range is taken, the same in each band.
///   Cornell: measured spectra of the Cornell box, reduced to three bands under its own lamp by
///   examples/cornell-box/make_cornell_box.py.
inline constexpr std::array<MaterialPreset, 15> materialPresets{ {
  { "Ceiling", { 0.70, 0.70, 0.70 }, "IES LM-83-12" },
  { "Wall", { 0.50, 0.50, 0.50 }, "IES LM-83-12" },
  { "Floor", { 0.20, 0.20, 0.20 }, "IES LM-83-12" },
  { "Furniture", { 0.50, 0.50, 0.50 }, "IES LM-83-12" },
  { "Exterior ground", { 0.10, 0.10, 0.10 }, "IES LM-83-12" },
  { "White paint", { 0.70, 0.70, 0.70 }, "Oke 1987: 0.50 to 0.90" },
  { "Black paint", { 0.085, 0.085, 0.085 }, "Oke 1987: 0.02 to 0.15" },
  { "Asphalt", { 0.125, 0.125, 0.125 }, "Oke 1987: 0.05 to 0.20" },
  { "Concrete", { 0.225, 0.225, 0.225 }, "Oke 1987: 0.10 to 0.35" },
  { "Brick", { 0.30, 0.30, 0.30 }, "Oke 1987: 0.20 to 0.40" },
  { "Grass", { 0.21, 0.21, 0.21 }, "Oke 1987: 0.16 to 0.26" },
  { "Cornell white", { 0.7386, 0.7354, 0.7507 }, "Cornell box data" },
  { "Cornell green", { 0.1186, 0.3819, 0.0235 }, "Cornell box data" },
  { "Cornell red", { 0.4489, 0.0391, 0.0102 }, "Cornell box data" },
  { "Perfect absorber", { 0.0, 0.0, 0.0 }, "definition" },
} };

} // namespace radiometry
