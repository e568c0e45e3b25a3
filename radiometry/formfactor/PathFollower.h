// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/irradiance/SpecularSurfaces.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <algorithm>
#include <cstdint>

namespace radiometry
{

/// How a path ended.
struct PathOutcome
{
  bool Leaks = false;   // some of it was lost: into the open, onto what does not receive, in a lobe
  bool Cut = false;     // it was followed no further
  bool Escapes = false; // into the open, with what is left of its weight ...
  Vec3 Direction;       // ... in this direction
  int Reflections = 0;
};

/// After so many mirrors a path is taken to count all it carries where it is.
inline constexpr int MostBounces = 4096;

/// Follows a path on from its first hit and calls count(element, weights) wherever what the element
/// sends counts (times 1/alpha, see SpecularSurfaces).
///   `direction`  unit, in which the path came
///   `weight`     of the path at the first hit, surfaces.Width() values; `counted` room for as many
///   Numbers      of the index-th point of a sequence of its own at each bounce, keyed on `key`
template <class Count>
PathOutcome FollowPath(const OcclusionScene& occluders, const ElementSet& elements,
  const SpecularSurfaces& surfaces, SurfaceHit hit, Vec3 direction, std::uint64_t key,
  std::uint32_t index, double* weight, double* counted, Count&& count)
{
  PathOutcome outcome;
  const std::size_t width = surfaces.Width();
  const auto some = [width](const double* values) {
    return std::any_of(values, values + width, [](double v) { return v > 1e-9; });
  };
  for (int bounces = 0;; ++bounces)
  {
    const std::int32_t element = elements.Find(hit.Triangle, hit.Front, hit.U, hit.V);
    if (!surfaces.GoesOn(hit))
    {
      outcome.Leaks = outcome.Leaks || element < 0;
      if (element >= 0)
      {
        count(element, weight);
      }
      return outcome;
    }
    const RayEnd place = surfaces.Place(hit);
    const SobolSequence numbers(Hash64(key, static_cast<std::uint64_t>(bounces)));
    const SpecularSurfaces::Fate fate =
      surfaces.Continue(hit, numbers(index), direction, weight, counted);
    if (some(counted))
    {
      outcome.Leaks = outcome.Leaks || element < 0;
      if (element >= 0)
      {
        count(element, counted);
      }
    }
    outcome.Leaks = outcome.Leaks || fate == SpecularSurfaces::Fate::Absorbed ||
      fate == SpecularSurfaces::Fate::Scattered;
    if (fate == SpecularSurfaces::Fate::Ended || fate == SpecularSurfaces::Fate::Absorbed)
    {
      return outcome;
    }
    if (bounces == MostBounces)
    {
      outcome.Cut = true;
      if (element >= 0 && surfaces.Left(hit.Triangle, hit.Front, 0) > 0.0)
      {
        count(element, weight);
      }
      return outcome;
    }
    outcome.Reflections += fate == SpecularSurfaces::Fate::Transmitted ? 0 : 1;
    hit = occluders.Closest(place, direction);
    if (hit.Triangle < 0)
    {
      outcome.Leaks = true;
      outcome.Escapes = true;
      outcome.Direction = direction;
      return outcome;
    }
  }
}

} // namespace radiometry
