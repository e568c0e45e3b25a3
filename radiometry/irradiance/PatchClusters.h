// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// Patches in clusters of neighbours that face about the same way: what a light does to one of them
/// it mostly does to all.
///   Method  the subtrees of the scene's tree of triangles with at most MostPatches triangles, each
///           parted by side and by the axis that its normals are nearest to
///   Cost    O(n), 4 bytes a patch and 4 a triangle
class PatchClusters
{
public:
  static constexpr std::size_t MostPatches = 64;

  PatchClusters(const Scene& scene, const OcclusionScene& occluders,
    const std::vector<Patch>& patches, int threads);

  std::size_t Size() const { return this->First.size() - 1; }
  /// The patches of a cluster: Begin(c) to End(c), each a number of a patch.
  const std::uint32_t* Begin(std::size_t cluster) const { return &this->Order[this->First[cluster]]; }
  const std::uint32_t* End(std::size_t cluster) const
  {
    return this->Order.data() + this->First[cluster + 1];
  }

private:
  std::vector<std::uint32_t> Order;
  std::vector<std::uint32_t> First;
};

} // namespace radiometry
