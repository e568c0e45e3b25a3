// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Scene.h"

namespace radiometry
{

/// Greatest of what the surfaces of a scene do with light, of any cell, side and band that counts:
/// fronts, and backs of two-sided cells.
struct OpticalLimits
{
  double Reflected = 0.0;   // diffuse reflectance
  double Diffused = 0.0;    // diffuse transmittance
  double Scattered = 0.0;   // both together, of one cell
  double Specular = 0.0;    // specular reflectance
  double Pane = 0.0;        // transmittance, of occluders too
  double Carried = 0.0;     // Specular and Pane together: what stays radiance
  double Total = 0.0;       // all together: what one meeting with a surface leaves
  double Mirror = 0.0;      // specular reflectance without a lobe
  double Lobe = 0.0;        // rho (n + 2)/2 of those with a lobe; infinite for mirrors
  double Emitted = 0.0;     // exitance, W/m^2
  double EmittedFlux = 0.0; // W
  double SmallestCell = 0.0; // area of the smallest cell that has one, m^2
  bool TwoSided = false;    // some cell is

  /// The same of what differs from the mean of all bands.
  struct Differences
  {
    double Scattered = 0.0;
    double Carried = 0.0;
    double Emitted = 0.0;
  };
  Differences Spread;
};
/// Cost: one pass over the optical arrays.
OpticalLimits FindOpticalLimits(const Scene& scene);

} // namespace radiometry
