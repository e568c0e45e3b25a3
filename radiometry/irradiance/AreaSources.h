// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/geometry/ConvexPolygon.h"
#include "radiometry/geometry/PairExchange.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// Emitting patches as lights.
struct EmitterSet
{
  int Bands = 1;
  std::vector<Patch> Patches;
  std::vector<double> Exitance; // patches x bands, W/m^2

  bool Empty() const { return this->Patches.empty(); }
};

/// A flat Lambertian source that shines to its front.
struct AreaSource
{
  std::vector<ExchangePatch> Triangles; // all of it, for averages over cells
  std::vector<ConvexPolygon> Parts;     // all of it again, for points
  ConvexPolygon Outline;                // convex, about all of it
  Vec3 Normal;
  std::vector<double> Exitance; // per band, W/m^2
  double Strength = 0.0;        // of the brightest band
  std::int32_t Triangle = -1;   // the scene's triangle that emits; -1: a light of its own
};

/// All area lights, and where wanted all emitting triangles, of a scene, in a tree that bounds what a
/// group of them can give.
class AreaSources
{
public:
  /// `emission`: the scene's emitting surfaces too, each side of two-sided ones.
  /// `onlyLight`: the place of the one light that counts; -1: all.
  /// Fails: InputError for a polygon that is not flat or crosses itself.
  AreaSources(const Scene& scene, bool emission, std::ptrdiff_t onlyLight = -1);
  explicit AreaSources(const EmitterSet& emitters);

  std::size_t Size() const { return this->Sources.size(); }
  const AreaSource& operator[](std::size_t k) const { return this->Sources[k]; }
  int Bands() const { return this->BandCount; }

  /// A group of sources.
  struct Group
  {
    Box3 Box;
    std::vector<double> Power;     // per band: sum of exitance times area, W
    std::vector<double> Exitances; // per band: sum of the exitances, W/m^2
    Vec3 Normal;                   // of all; zero: they differ
    double Lowest = 0.0;           // with Normal: the least Normal . p of their corners
    std::int32_t Second = -1;      // the other child (the first is the next group); -1: one source
    std::int32_t Source = -1;
  };
  const std::vector<Group>& Groups() const { return this->Tree; }

  /// Bound of the irradiance from a group, per W of its power and at most its exitances: for
  /// receivers within `radius` of `center` that lie on the plane about `normal` there.
  static double Factor(const Group& group, const Vec3& center, const Vec3& normal, double radius);

private:
  void Add(const std::vector<Triangle3>& triangles, const std::vector<Vec3>& corners,
    const double* exitance, std::int32_t triangle, bool back);
  void Build(std::vector<std::int32_t>& order, std::size_t begin, std::size_t end);

  int BandCount = 1;
  std::vector<AreaSource> Sources;
  std::vector<Group> Tree;
};

} // namespace radiometry
