// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Scene.h"

#include <string>
#include <vector>

namespace test
{

/// Scenes on which the stated errors of radiosity are judged. Every cell is one triangle.
struct RadiosityScene
{
  std::string Name;
  std::string Effect; // that decides over its light
  radiometry::Scene World;
  bool Paths = false; // light is followed over mirrors and through panes: by rays alone
};
std::vector<RadiosityScene> RadiosityScenes();
void AddHardScenes(std::vector<RadiosityScene>& scenes);
void AddPathScenes(std::vector<RadiosityScene>& scenes);

/// A value of a scene by paths (PathReference.h), kept in RadiosityReferences.txt.
struct RadiosityReference
{
  std::string Scene;  // its name, with "@" behind it for the values of cells' centroids
  std::size_t Cell = 0;
  int Side = 0;
  int Band = 0;
  double Irradiance = 0.0; // W/m^2
  double Error = 0.0;      // standard error
};
std::vector<RadiosityReference> RadiosityReferences();
/// The file that they are read from.
std::string RadiosityReferencePath();

} // namespace test
