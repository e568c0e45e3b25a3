// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/ElementOverlap.h"

#include <algorithm>

namespace radiometry
{
namespace
{

/// An element's length on the curve through its triangle: each division quarters it.
std::uint64_t Length(const ElementSet& elements, std::size_t e)
{
  constexpr int most = 28;
  return std::uint64_t(1) << (2 * (most - std::min(most, elements.Depth(e))));
}

/// One after the elements of the leaf that begins at `e`: its front and, where that receives, its
/// back.
std::size_t LeafEnd(const std::vector<Patch>& patches, std::size_t e)
{
  const bool both = e + 1 < patches.size() && patches[e + 1].Triangle == patches[e].Triangle &&
    patches[e].Side == 0 && patches[e + 1].Side == 1;
  return e + (both ? 2 : 1);
}

} // namespace

std::vector<ElementOrigin> FindOrigins(const ElementSet& elements, const ElementSet& earlier)
{
  const std::vector<Patch>& patches = elements.GetPatches();
  const std::vector<Patch>& before = earlier.GetPatches();
  std::vector<ElementOrigin> origin(patches.size());
  // Elements of a triangle are consecutive, both sides of a leaf together, leaves in the order of
  // their tree: two walks along it meet where leaves are the same.
  std::size_t e = 0, old = 0;
  while (e < patches.size())
  {
    const std::int32_t triangle = patches[e].Triangle;
    while (old < before.size() && before[old].Triangle < triangle)
    {
      ++old;
    }
    std::uint64_t at = 0, oldAt = 0;
    while (e < patches.size() && patches[e].Triangle == triangle)
    {
      // The leaf of the earlier set that covers the beginning of this one.
      while (old < before.size() && before[old].Triangle == triangle &&
        oldAt + Length(earlier, old) <= at)
      {
        oldAt += Length(earlier, old);
        old = LeafEnd(before, old);
      }
      const std::size_t end = LeafEnd(patches, e);
      for (std::size_t k = e; k < end; ++k)
      {
        for (std::size_t o = old; o < before.size() && o < LeafEnd(before, old); ++o)
        {
          if (before[o].Triangle == triangle && before[o].Side == patches[k].Side)
          {
            origin[k].Element = static_cast<std::int32_t>(o);
            origin[k].Same = at == oldAt && earlier.Depth(o) == elements.Depth(k);
          }
        }
      }
      at += Length(elements, e);
      e = end;
    }
  }
  return origin;
}

} // namespace radiometry
