// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/RadiosityCache.h"

#include "radiometry/solver/RadiosityLevel.h"
#include "radiometry/visibility/Convexity.h"

#include <utility>

namespace radiometry
{
namespace
{

/// The options that an operator is made by, and what it sees in mirrors.
ContentKey ShapeOf(const Scene& scene, const RadiosityOptions& options)
{
  ContentKey key;
  key.Add(static_cast<std::uint64_t>(options.Method));
  key.Add(static_cast<std::uint64_t>(options.Refinement));
  key.Add(options.Occlusion);
  key.Add(options.BackFaces);
  key.Add(options.Seed);
  key.Add(options.FollowsPaths());
  if (options.FollowsPaths())
  {
    const ContentKey mirrors = KeyOfMirrors(scene);
    key.Add(mirrors.Low);
    key.Add(mirrors.High);
  }
  return key;
}

} // namespace

RadiosityCache::RadiosityCache() = default;
RadiosityCache::~RadiosityCache() = default;

const OcclusionScene& RadiosityCache::Occluders(const Scene& scene)
{
  const ContentKey key = KeyOfGeometry(scene);
  if (!this->Visibility || key != this->Geometry)
  {
    this->Release();
    this->Visibility = std::make_unique<OcclusionScene>(scene);
    this->IsConvex = FindConvexity(scene) != Convexity::General;
    this->Geometry = key;
  }
  return *this->Visibility;
}

std::unique_ptr<RadiosityLevel> RadiosityCache::Take(
  const Scene& scene, const RadiosityOptions& options)
{
  if (this->Kept && this->Shape != ShapeOf(scene, options))
  {
    this->Kept.reset();
  }
  return std::move(this->Kept);
}

void RadiosityCache::Keep(
  const Scene& scene, const RadiosityOptions& options, std::unique_ptr<RadiosityLevel> level)
{
  this->Kept = std::move(level);
  this->Shape = ShapeOf(scene, options);
}

void RadiosityCache::Release()
{
  this->Kept.reset();
  this->Visibility.reset();
}

std::size_t RadiosityCache::MemoryBytes() const
{
  return this->Kept ? this->Kept->MemoryBytes() : 0;
}

} // namespace radiometry
