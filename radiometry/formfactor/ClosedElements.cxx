// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ClosedElements.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/Collective.h"

namespace radiometry
{
namespace
{

bool SeesElementsOnly(std::size_t i, const OcclusionScene& occluders, const ElementSet& elements,
  std::uint64_t seed)
{
  constexpr std::uint32_t probes = 64;
  const Patch& patch = elements.GetPatches()[i];
  const Vec3 normal = Normalized(AreaNormal2(patch.Corners));
  const SobolSequence sequence(Hash64(Hash64(seed, 0x70726f6265ull), i));
  for (std::uint32_t k = 0; k < probes; ++k)
  {
    const auto u = sequence(k);
    const SurfaceHit hit =
      occluders.Closest({ TrianglePoint(patch.Corners, u[0], u[1]), patch.Triangle },
        CosineDirection(normal, u[2], u[3]));
    if (elements.Find(hit.Triangle, hit.Front, hit.U, hit.V) < 0)
    {
      return false;
    }
  }
  return true;
}

} // namespace

std::vector<std::uint8_t> FindClosedElements(const OcclusionScene& occluders,
  const ElementSet& elements, const ExchangeOptions& options, const StageProgress& stage)
{
  const std::size_t n = elements.Size();
  const RankShare share(options.Ranks, n);
  std::vector<std::int32_t> closed(n, 0);
  Collectively(options.Ranks, [&] {
    ParallelFor(share.End - share.Begin, options.Threads, stage, [&](std::size_t k) {
      const std::size_t i = share.Begin + k;
      closed[i] = SeesElementsOnly(i, occluders, elements, options.Seed) ? 1 : 0;
    });
  });
  if (options.Ranks)
  {
    options.Ranks->Gather(closed.data(), RankShare::Begins(*options.Ranks, n));
  }
  return { closed.begin(), closed.end() };
}

} // namespace radiometry
