// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ElementBlocks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// Where n items are halved: at a multiple of the block, or within one at a power of two, so that
/// halves are whole nodes.
std::size_t Half(std::size_t n)
{
  if (n > ElementBlocks::Edge)
  {
    const std::size_t blocks = (n + ElementBlocks::Edge - 1) / ElementBlocks::Edge;
    return blocks / 2 * ElementBlocks::Edge;
  }
  std::size_t half = 1;
  while (2 * half < n)
  {
    half *= 2;
  }
  return half;
}

} // namespace

ElementBlocks::ElementBlocks(const std::vector<Patch>& patches, const PatchBlockers* blockers)
{
  const std::size_t n = patches.size();
  std::vector<PlacedPatch> placed(n);
  std::vector<Vec3> centers(n), normals(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const Patch& p = patches[i];
    placed[i] = blockers ? blockers->Place(p)
                         : PlacedPatch{ p.Corners, Normalized(AreaNormal2(p.Corners)), p.Triangle };
    centers[i] = Centroid(placed[i].Corners);
    normals[i] = placed[i].Normal;
  }
  this->Elements.resize(n);
  std::iota(this->Elements.begin(), this->Elements.end(), 0);
  this->Sort(centers, normals, 0, n);
  this->Shapes.reserve(n);
  this->Patches.reserve(n);
  for (const std::int32_t e : this->Elements)
  {
    this->Shapes.emplace_back(patches[static_cast<std::size_t>(e)].Corners);
    this->Patches.push_back(placed[static_cast<std::size_t>(e)]);
  }
  this->Nodes.resize(this->Blocks() * 2 * Edge);
  for (std::size_t block = 0; block < this->Blocks(); ++block)
  {
    for (std::size_t node = 2 * Edge - 1; node > 0; --node)
    {
      this->Bound(block, node);
    }
  }
}

void ElementBlocks::Sort(const std::vector<Vec3>& centers, const std::vector<Vec3>& normals,
  std::size_t begin, std::size_t end)
{
  if (end - begin < 2)
  {
    return;
  }
  Box3 place, direction;
  for (std::size_t k = begin; k < end; ++k)
  {
    place.Add(centers[static_cast<std::size_t>(this->Elements[k])]);
    direction.Add(normals[static_cast<std::size_t>(this->Elements[k])]);
  }
  const Vec3 size = place.Size();
  const Vec3 turn = 0.25 * Length(size) * direction.Size();
  const double extents[6] = { size.x, size.y, size.z, turn.x, turn.y, turn.z };
  const auto axis = static_cast<int>(std::max_element(extents, extents + 6) - extents);
  // Where all is in one place, by direction alone.
  const Vec3 spread = direction.Size();
  const int split = extents[axis] > 0.0
    ? axis
    : 3 + (spread.x >= spread.y && spread.x >= spread.z ? 0 : (spread.y >= spread.z ? 1 : 2));
  const std::vector<Vec3>& key = split < 3 ? centers : normals;
  const int a = split % 3;
  const auto at = [&](std::size_t k) {
    return this->Elements.begin() + static_cast<std::ptrdiff_t>(k);
  };
  const std::size_t middle = begin + Half(end - begin);
  std::nth_element(at(begin), at(middle), at(end), [&](std::int32_t l, std::int32_t r) {
    const double kl = key[static_cast<std::size_t>(l)][a];
    const double kr = key[static_cast<std::size_t>(r)][a];
    return kl < kr || (kl == kr && l < r);
  });
  this->Sort(centers, normals, begin, middle);
  this->Sort(centers, normals, middle, end);
}

void ElementBlocks::Bound(std::size_t block, std::size_t node)
{
  int level = 0;
  while ((std::size_t(2) << level) <= node)
  {
    ++level;
  }
  const std::size_t width = Edge >> level;
  const std::size_t first = (node - (std::size_t(1) << level)) * width;
  const std::size_t begin = block * Edge + first;
  const std::size_t end = std::min(begin + width, this->Size());
  Node& n = this->Nodes[block * 2 * Edge + node];
  n.First = static_cast<std::int32_t>(first);
  if (begin >= end)
  {
    return;
  }
  n.Group =
    PatchGroup(this->Patches.data() + begin, static_cast<std::int32_t>(end - begin));
  Vec3 axis;
  for (std::size_t k = begin; k < end; ++k)
  {
    axis += this->Patches[k].Normal;
  }
  n.Center = n.Group.Center;
  n.Axis = Normalized(axis);
  double least = n.Axis == Vec3{} ? -1.0 : 1.0;
  double away = 0.0;
  for (std::size_t k = begin; k < end; ++k)
  {
    for (const Vec3& p : this->Patches[k].Corners)
    {
      away = std::max(away, LengthSquared(p - n.Center));
    }
    least = std::min(least, Dot(n.Axis, this->Patches[k].Normal));
  }
  n.Radius = std::sqrt(away) * (1.0 + 1e-12);
  n.HalfAngle = least > 1.0 - 1e-14 ? 2e-7 : std::acos(std::max(-1.0, least)) + 1e-9;
}

bool ElementBlocks::BackFacing(const Node& a, const Node& b)
{
  const Vec3 way = b.Center - a.Center;
  const double distance = std::sqrt(LengthSquared(way));
  const double reach = a.Radius + b.Radius;
  if (!(distance > reach))
  {
    return false;
  }
  const double spread = std::asin(reach / distance);
  const auto behind = [&](const Node& n, double sign) {
    // Every direction to the other, within `spread` of the way, is over a right angle from the cone.
    const double least = 0.5 * Pi + spread + n.HalfAngle;
    return least < Pi && sign * Dot(n.Axis, way) < std::cos(least) * distance;
  };
  return behind(a, 1.0) || behind(b, -1.0);
}

} // namespace radiometry
