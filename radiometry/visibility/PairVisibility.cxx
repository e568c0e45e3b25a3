// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/PairVisibility.h"

#include "radiometry/geometry/Sampling.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{

PairVisibilityResult PairVisibility(const OcclusionScene& scene, const ExchangePatch& a,
  std::int32_t triangleA, const ExchangePatch& b, std::int32_t triangleB, std::uint64_t key,
  int first, int most, double wanted)
{
  constexpr int sets = 4;
  PairVisibilityResult result;
  const SobolSequence sequences[sets] = { SobolSequence(Hash64(key, 0)),
    SobolSequence(Hash64(key, 1)), SobolSequence(Hash64(key, 2)), SobolSequence(Hash64(key, 3)) };
  double weight[sets] = {};
  double visible[sets] = {};
  double allWeight = 0.0;
  bool anyVisible = false, anyHidden = false;
  int done = 0;
  const auto sampleTo = [&](int end) {
    for (; done < end; ++done)
    {
      for (int set = 0; set < sets; ++set)
      {
        const auto u = sequences[set](static_cast<std::uint32_t>(done));
        const Vec3 x = TrianglePoint(a.Corners, u[0], u[1]);
        const Vec3 y = TrianglePoint(b.Corners, u[2], u[3]);
        const Vec3 r = y - x;
        const double r2 = LengthSquared(r);
        const double kernel =
          std::max(0.0, Dot(a.Normal, r)) * std::max(0.0, -Dot(b.Normal, r)) / (r2 * r2);
        if (!(kernel > 0.0))
        {
          continue;
        }
        ++result.Rays;
        weight[set] += kernel;
        allWeight += kernel;
        if (scene.Occluded({ x, triangleA }, { y, triangleB }))
        {
          anyHidden = true;
        }
        else
        {
          anyVisible = true;
          visible[set] += kernel;
        }
      }
    }
  };

  sampleTo(std::max(1, first / sets));
  // Mostly below each other's horizon: look on until something was seen.
  while (allWeight == 0.0 && done < 64)
  {
    sampleTo(2 * done);
  }
  if (allWeight == 0.0)
  {
    result.Fraction = 0.5;
    result.Error = 0.5;
    return result;
  }
  const int seen = result.Rays;
  double spread = 0.0;
  const auto estimate = [&] {
    double sum = 0.0;
    for (const double v : visible)
    {
      sum += v;
    }
    result.Fraction = sum / allWeight;
    spread = 0.0;
    for (int set = 0; set < sets; ++set)
    {
      const double off = (visible[set] - result.Fraction * weight[set]) / allWeight;
      spread += off * off * sets / (sets - 1.0);
    }
  };
  estimate();
  if (!anyVisible || !anyHidden)
  {
    return result;
  }
  while (sets * done < most && (done < 4 || spread > wanted * wanted))
  {
    sampleTo(2 * done);
    estimate();
  }
  // Of pairs with V uniform in (0, 1), k rays agree by chance in 2/(k+1) and are then wrong by
  // 4/((k+1)(k+2)(k+3)) in the mean square: charged to those that were noticed.
  const double k = std::max(2, seen);
  const double unnoticed = 4.0 / ((k + 1.0) * (k + 2.0) * (k + 3.0)) / (1.0 - 2.0 / (k + 1.0));
  result.Error = std::sqrt(spread + unnoticed);
  return result;
}

} // namespace radiometry
