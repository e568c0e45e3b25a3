// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/PatchClusters.h"

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/scene/Parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace radiometry
{
namespace
{

/// Which of the six half-axes a normal is nearest to.
std::uint32_t Facing(const Patch& patch)
{
  const Vec3 n = AreaNormal2(patch.Corners);
  const Vec3 a{ std::fabs(n.x), std::fabs(n.y), std::fabs(n.z) };
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
  return static_cast<std::uint32_t>(2 * axis + (n[axis] < 0.0 ? 1 : 0));
}

} // namespace

PatchClusters::PatchClusters(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, int threads)
{
  constexpr std::size_t chunk = 1024;
  const auto forChunks = [&](std::size_t n, const auto& body) {
    ParallelFor((n + chunk - 1) / chunk, threads, {}, [&](std::size_t c) {
      for (std::size_t i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i)
      {
        body(i);
      }
    }, 1e-5);
  };

  // The bucket of a patch: side and group of its triangle.
  const BoxTree& tree = occluders.Tree();
  const std::vector<std::int32_t> groups =
    tree.Empty() ? std::vector<std::int32_t>{ 0 } : tree.Groups(MostPatches);
  const std::size_t groupCount = std::max<std::size_t>(1, groups.size() - 1);
  std::vector<std::uint32_t> rank(scene.Triangles.size());
  std::vector<std::uint32_t> groupOf(scene.Triangles.size());
  forChunks(groups.size() - 1, [&](std::size_t g) {
    for (std::int32_t k = groups[g]; k < groups[g + 1]; ++k)
    {
      const std::int32_t t = tree.Order()[k];
      rank[t] = static_cast<std::uint32_t>(k);
      groupOf[t] = static_cast<std::uint32_t>(g);
    }
  });
  const auto bucketOf = [&](const Patch& p) {
    const std::size_t group = p.Triangle >= 0 ? groupOf[p.Triangle] : 0;
    return group + (p.Side != 0 ? groupCount : 0);
  };
  std::vector<std::atomic<std::uint32_t>> counts(2 * groupCount);
  std::vector<std::uint64_t> places(patches.size()); // within a bucket: facing, then the tree's order
  forChunks(patches.size(), [&](std::size_t i) {
    const Patch& p = patches[i];
    const std::uint64_t facing = Facing(p);
    places[i] = (facing << 32) + (p.Triangle >= 0 ? rank[p.Triangle] : 0);
    counts[bucketOf(p)].fetch_add(1, std::memory_order_relaxed);
  });
  std::vector<std::uint32_t> first(2 * groupCount + 1, 0);
  for (std::size_t b = 0; b < counts.size(); ++b)
  {
    first[b + 1] = first[b] + counts[b].load(std::memory_order_relaxed);
  }
  this->Order.resize(patches.size());
  forChunks(patches.size(), [&](std::size_t i) {
    const std::size_t b = bucketOf(patches[i]);
    this->Order[first[b] + counts[b].fetch_sub(1, std::memory_order_relaxed) - 1] =
      static_cast<std::uint32_t>(i);
  });

  // Within a bucket by facing, then in the order of the tree: whatever the threads did before.
  std::vector<std::uint8_t> starts(patches.size() + 1, 0);
  forChunks(counts.size(), [&](std::size_t b) {
    struct Key
    {
      std::uint64_t Place;
      std::uint32_t Patch;
      bool operator<(const Key& other) const
      {
        return this->Place < other.Place ||
          (this->Place == other.Place && this->Patch < other.Patch);
      }
    };
    static thread_local std::vector<Key> keys;
    keys.clear();
    for (std::uint32_t k = first[b]; k < first[b + 1]; ++k)
    {
      keys.push_back({ places[this->Order[k]], this->Order[k] });
    }
    std::sort(keys.begin(), keys.end());
    std::size_t length = 0;
    for (std::size_t k = 0; k < keys.size(); ++k)
    {
      this->Order[first[b] + k] = keys[k].Patch;
      if (k == 0 || keys[k].Place >> 32 != keys[k - 1].Place >> 32 || length == MostPatches)
      {
        starts[first[b] + k] = 1;
        length = 0;
      }
      ++length;
    }
  });
  starts[patches.size()] = 1;
  for (std::size_t k = 0; k < starts.size(); ++k)
  {
    if (starts[k] != 0)
    {
      this->First.push_back(static_cast<std::uint32_t>(k));
    }
  }
}

} // namespace radiometry
