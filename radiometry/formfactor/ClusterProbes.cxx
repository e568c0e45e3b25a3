// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ClusterProbes.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/Collective.h"

#include <algorithm>

namespace radiometry
{

ClusterProbes::ClusterProbes(const OcclusionScene& occluders, const ElementSet& elements,
  const ExchangeOptions& options, const StageProgress& stage)
{
  const std::size_t n = elements.Size();
  const auto points =
    static_cast<int>(std::clamp<std::size_t>(262144 / std::max<std::size_t>(n, 1), 4, 128));
  this->Rays = 2 * points;
  this->Covered.assign(n, 0);
  this->Missed.assign(n, 0);
  std::vector<std::int32_t> found(n, 0); // kind, and 4 for each ray that met no receiving element
  const RankShare share(options.Ranks, n);
  const auto probe = [&](std::size_t k) {
    const std::size_t i = share.Begin + k;
    const Patch& patch = elements.GetPatches()[i];
    const Vec3 normal = Normalized(AreaNormal2(patch.Corners));
    if (!(LengthSquared(normal) > 0.0))
    {
      return;
    }
    const SobolSequence sequence(Hash64(Hash64(options.Seed, 0x636f766572ull), i));
    int dark = 0;
    int missed = 0;
    for (int point = 0; point < points; ++point)
    {
      const auto u = sequence(static_cast<std::uint32_t>(point));
      const RayEnd start{ TrianglePoint(patch.Corners, u[0], u[1]), patch.Triangle };
      const Vec3 direction = CosineDirection(normal, u[2], u[3]);
      int behind = 0;
      for (const Vec3& d : { direction, 2.0 * Dot(direction, normal) * normal - direction })
      {
        const SurfaceHit hit = occluders.Closest(start, d);
        const bool receives = elements.Find(hit.Triangle, hit.Front, hit.U, hit.V) >= 0;
        missed += !receives;
        behind += hit.Triangle >= 0 && !hit.Front && !receives;
      }
      dark += behind == 2;
    }
    found[i] = (dark == 0 ? 0 : (dark == points ? 2 : 1)) + 4 * missed;
  };
  Collectively(options.Ranks,
    [&] { ParallelFor(share.End - share.Begin, options.Threads, stage, probe, 5e-6); });
  if (options.Ranks)
  {
    options.Ranks->Gather(found.data(), RankShare::Begins(*options.Ranks, n));
  }
  double area = 0.0, met = 0.0;
  for (std::size_t i = 0; i < n; ++i)
  {
    this->Covered[i] = static_cast<std::uint8_t>(found[i] & 3);
    this->Missed[i] = found[i] >= 4;
    area += elements.GetAreas()[i];
    met += elements.GetAreas()[i] * (1.0 - (found[i] >> 2) / static_cast<double>(this->Rays));
  }
  this->Share = area > 0.0 ? met / area : 1.0;
  const auto partly =
    static_cast<std::size_t>(std::count(this->Covered.begin(), this->Covered.end(), 1));
  if (partly > n / 3)
  {
    std::fill(this->Covered.begin(), this->Covered.end(), 0);
  }
}

std::vector<std::uint8_t> ClusterProbes::Closed(const ElementTree& tree) const
{
  const std::int32_t group = std::max(1, 64 / this->Rays);
  std::vector<std::uint8_t> closed(this->Missed.size(), 0);
  for (std::int32_t at = 0; at < static_cast<std::int32_t>(tree.Size());)
  {
    const ElementTree::Node& node = tree[at];
    if (node.Count > group)
    {
      ++at;
      continue;
    }
    const auto first = tree.Order().begin() + node.First;
    const bool all = std::none_of(first, first + node.Count,
      [&](std::int32_t i) { return this->Missed[static_cast<std::size_t>(i)] != 0; });
    std::for_each(first, first + node.Count,
      [&](std::int32_t i) { closed[static_cast<std::size_t>(i)] = all; });
    at += 2 * node.Count - 1;
  }
  return closed;
}

} // namespace radiometry
