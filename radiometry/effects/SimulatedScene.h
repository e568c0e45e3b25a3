// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Scene.h"

#include <array>
#include <cstddef>
#include <vector>

namespace radiometry
{

/// The bands of a scene, put together where all that depends on the band is equal to the last bit:
/// reflectances, transmittances, emission, ambient light, lights and skies.
struct BandGroups
{
  std::vector<int> Group;     // of each band
  std::vector<int> Firsts;    // the first band of each group
  std::size_t Bands() const { return this->Group.size(); }
  std::size_t Size() const { return this->Firsts.size(); }
  bool AllApart() const { return this->Size() == this->Bands(); }
};
/// Each band a group of its own.
BandGroups SingleBands(int bands);
/// Cost: one pass over what depends on the band, for each group; ends early where bands differ.
BandGroups FindBandGroups(const Scene& scene);

/// What of a scene is not to be simulated.
struct SceneParts
{
  std::array<bool, 5> WithoutLights{}; // by LightType
  bool WithoutWebs = false;    // luminaires shine alike in all directions, as strongly as at most
  bool WithoutMirrors = false; // surfaces without a lobe reflect nothing specularly
  bool Grey = false;           // one band: the mean of all
};

/// The scene without these parts and with one band of each group. Lights that are left out are
/// switched off, so that the others keep their places.
Scene ReduceScene(const Scene& scene, const SceneParts& parts, const BandGroups& groups);

/// Values of the groups, items x groups, as those of the bands, items x bands.
std::vector<double> SpreadBands(std::vector<double> values, const BandGroups& groups);

/// The values of a side; the front's where the back has none of its own.
const std::vector<double>& OfSide(
  const std::array<std::vector<double>, 2>& sides, std::size_t side);
/// True where a side of a cell reflects specularly and has no lobe.
bool IsMirror(const Materials& optics, std::size_t side, std::size_t cell);

} // namespace radiometry
