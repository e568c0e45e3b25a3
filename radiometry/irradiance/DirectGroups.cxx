// SPDX-License-Identifier: BSD-3-Clause
//
// DirectKind: receivers in groups, and what is kept of them.
#include "radiometry/irradiance/BeamIrradiance.h"
#include "radiometry/irradiance/DirectRun.h"
#include "radiometry/irradiance/PatchClusters.h"

#include <numeric>
#include <utility>

namespace radiometry
{
namespace
{

/// Clusters are made in space for so many lights and more, were nothing in the way.
constexpr std::size_t ManyLights = 32;

template <typename Vector>
std::size_t BytesOf(const Vector& v)
{
  return v.capacity() * sizeof(typename Vector::value_type);
}

/// Runs of 64 of an order.
ReceiverGroups Runs(std::vector<std::uint32_t> order)
{
  ReceiverGroups groups;
  PlainGroups(order.size(), groups.Order, groups.First);
  groups.Order = std::move(order);
  return groups;
}

std::vector<std::uint32_t> Identity(std::size_t n)
{
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  return order;
}


} // namespace

ReceiverGroups MakeReceiverGroups(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options)
{
  if (!AnyBeam(scene, options))
  {
    return Runs(Identity(patches.size()));
  }
  if (!options.Occlusion || scene.Triangles.empty())
  {
    // Nothing is asked of the tree over the triangles: it need not be made.
    if (scene.Lights.size() < ManyLights)
    {
      return Runs(Identity(patches.size()));
    }
    std::vector<Vec3> places;
    places.reserve(patches.size());
    for (const Patch& p : patches)
    {
      places.push_back(Centroid(p.Corners));
    }
    return Runs(SpatialOrder(places));
  }
  const PatchClusters clusters(scene, occluders, patches, options.Threads);
  ReceiverGroups groups;
  groups.Order.reserve(patches.size());
  for (std::size_t c = 0; c < clusters.Size(); ++c)
  {
    groups.First.push_back(static_cast<std::uint32_t>(groups.Order.size()));
    groups.Order.insert(groups.Order.end(), clusters.Begin(c), clusters.End(c));
  }
  groups.First.push_back(static_cast<std::uint32_t>(groups.Order.size()));
  return groups;
}
ReceiverGroups MakeReceiverGroups(const Scene& scene, const OcclusionScene&,
  const std::vector<SurfacePoint>& points, const DirectOptions& options)
{
  return AnyBeam(scene, options) ? PointGroups(points) : Runs(Identity(points.size()));
}

void DirectField::Begin(std::size_t receivers, std::size_t bands)
{
  if (this->State.size() == receivers && this->Value.size() == receivers * bands)
  {
    return;
  }
  *this = {};
  this->State.assign(receivers, 0);
  this->Value.assign(receivers * bands, 0.0);
  this->Error = this->Value;
}

std::size_t DirectField::MemoryBytes() const
{
  return BytesOf(this->Value) + BytesOf(this->Error) + BytesOf(this->Dropped) +
    BytesOf(this->State) + BytesOf(this->Spent) + BytesOf(this->Dark);
}

std::size_t DirectState::MemoryBytes() const
{
  std::size_t bytes = 0;
  for (const DirectField& field : this->Fields)
  {
    bytes += field.MemoryBytes();
  }
  return bytes;
}

} // namespace radiometry
