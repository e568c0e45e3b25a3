// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/IrradianceSimulation.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include <array>
#include <vector>

namespace radiometry
{

/// What surfaces send diffusely, all bounces that are known in it: front and back, cells x bands,
/// W/m^2. Empty: that side sends nothing.
struct DiffuseLight
{
  std::array<std::vector<double>, 2> Exitance;
  std::array<std::vector<double>, 2> Error;
};

/// What surfaces send diffusely when this falls on them (front and back; empty: nothing does):
/// B = M + rho E + tau E_other of each side that receives, with their errors. Without `emission`: no M.
DiffuseLight ReflectDiffusely(
  const Scene& scene, const std::array<FieldValues, 2>& irradiance, bool emission);

/// What is sent diffusely at points: from values there (B, or with `radiosity` false E, of the mean
/// material of the cells around), else the mean of the cells around.
DiffuseLight DiffuseAtPoints(const Scene& scene, const std::vector<SurfacePoint>& points,
  const DiffuseLight& cells, const std::array<FieldValues, 2>& values, bool radiosity,
  bool emission);

/// What reflection from surface to surface can add to any radiance when `direct` knows of none
/// [W/(m^2 sr)]: a B/(pi (1 - a)), a the greatest share that a surface sends on. 0 where no front
/// faces another; infinite where mirrors may gather light, or nothing is absorbed.
double BoundInterreflection(const Scene& scene, const DiffuseLight& direct);

/// The greatest radiance of surfaces' own emission, W/(m^2 sr).
double GreatestEmission(const Scene& scene);

} // namespace radiometry
