// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/AreaSources.h"

#include "radiometry/geometry/PolygonTriangulation.h"
#include "radiometry/scene/ArrayNames.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
/// Corners of the outline of a light.
constexpr std::size_t MostOutline = 8;

/// True where a polygon turns one way at every corner.
bool IsConvex(const std::vector<Vec3>& corners, const Vec3& n)
{
  const std::size_t count = corners.size();
  double turned = 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    const Vec3 in = corners[(k + 1) % count] - corners[k];
    const Vec3 out = corners[(k + 2) % count] - corners[(k + 1) % count];
    const double turn = Dot(n, Cross(in, out));
    if (turn < 0.0)
    {
      return false;
    }
    turned += std::atan2(turn, Dot(in, out));
  }
  return turned < 3.0 * Pi; // once around
}

} // namespace

AreaSources::AreaSources(const Scene& scene, bool emission, std::ptrdiff_t onlyLight)
  : BandCount(scene.Optics.Bands)
{
  for (std::size_t k = 0; k < scene.Lights.size(); ++k)
  {
    const Light& light = scene.Lights[k];
    const bool counts = onlyLight < 0 || static_cast<std::size_t>(onlyLight) == k;
    if (!counts || !light.Enabled || light.Type != LightType::Area)
    {
      continue;
    }
    const std::vector<Triangle3> triangles =
      TriangulatePolygon(light.Polygon, "Polygons", light.Index);
    this->Add(triangles, light.Polygon, light.Intensity.data(), -1, false);
    if (light.TwoSided)
    {
      this->Add(triangles, light.Polygon, light.Intensity.data(), -1, true);
    }
  }
  const auto bands = static_cast<std::size_t>(this->BandCount);
  for (std::size_t t = 0; emission && t < scene.ReceiverTriangles; ++t)
  {
    const auto cell = static_cast<std::size_t>(scene.TriangleCell[t]);
    const Triangle3 corners = scene.TriangleAt(t);
    for (std::size_t side = 0; side < 2; ++side)
    {
      const bool shines =
        side == 0 || (!scene.Optics.TwoSided.empty() && scene.Optics.TwoSided[cell]);
      const auto& exitance = scene.Optics.EmittedExitance;
      const std::vector<double>& values = exitance[side].empty() ? exitance[0] : exitance[side];
      if (shines && !values.empty())
      {
        this->Add({ corners }, { corners[0], corners[1], corners[2] }, values.data() + cell * bands,
          static_cast<std::int32_t>(t), side == 1);
      }
    }
  }
  std::vector<std::int32_t> order(this->Sources.size());
  std::iota(order.begin(), order.end(), 0);
  this->Build(order, 0, order.size());
}

AreaSources::AreaSources(const EmitterSet& emitters)
  : BandCount(emitters.Bands)
{
  for (std::size_t k = 0; k < emitters.Patches.size(); ++k)
  {
    const Patch& p = emitters.Patches[k];
    this->Add({ p.Corners }, { p.Corners[0], p.Corners[1], p.Corners[2] },
      emitters.Exitance.data() + k * static_cast<std::size_t>(emitters.Bands), p.Triangle, false);
  }
  std::vector<std::int32_t> order(this->Sources.size());
  std::iota(order.begin(), order.end(), 0);
  this->Build(order, 0, order.size());
}

void AreaSources::Add(const std::vector<Triangle3>& triangles, const std::vector<Vec3>& corners,
  const double* exitance, std::int32_t triangle, bool back)
{
  AreaSource source;
  source.Exitance.assign(exitance, exitance + this->BandCount);
  source.Strength = *std::max_element(source.Exitance.begin(), source.Exitance.end());
  source.Triangle = triangle;
  if (triangles.empty() || !(source.Strength > 0.0))
  {
    return;
  }
  for (Triangle3 t : triangles)
  {
    if (back)
    {
      std::swap(t[1], t[2]);
    }
    source.Triangles.emplace_back(t);
  }
  std::vector<Vec3> rim = corners;
  if (back)
  {
    std::reverse(rim.begin(), rim.end());
  }
  source.Normal = Normalized(AreaNormal2(rim.data(), rim.size()));
  if (source.Normal == Vec3{})
  {
    return;
  }
  for (const Vec3& p : Outline(rim, source.Normal, MostOutline))
  {
    source.Outline.Add(p);
  }
  if (source.Outline.N < 3)
  {
    return; // a line, to the precision of its numbers
  }
  if (IsConvex(rim, source.Normal))
  {
    // Fans of no more corners than clipping has room for.
    constexpr std::size_t step = SmallPolygon::Capacity - 2;
    for (std::size_t first = 1; first + 1 < rim.size(); first += step)
    {
      ConvexPolygon part;
      part.Add(rim[0]);
      for (std::size_t k = first; k < std::min(rim.size(), first + step + 1); ++k)
      {
        part.Add(rim[k]);
      }
      source.Parts.push_back(part);
    }
  }
  else
  {
    for (const ExchangePatch& t : source.Triangles)
    {
      source.Parts.emplace_back(t.Corners);
    }
  }
  this->Sources.push_back(std::move(source));
}

void AreaSources::Build(std::vector<std::int32_t>& order, std::size_t begin, std::size_t end)
{
  if (begin == end)
  {
    return;
  }
  const auto bands = static_cast<std::size_t>(this->BandCount);
  const std::size_t at = this->Tree.size();
  this->Tree.emplace_back();
  Group group;
  group.Power.assign(bands, 0.0);
  group.Exitances.assign(bands, 0.0);
  group.Normal = this->Sources[order[begin]].Normal;
  group.Lowest = std::numeric_limits<double>::infinity();
  for (std::size_t k = begin; k < end; ++k)
  {
    const AreaSource& s = this->Sources[order[k]];
    double area = 0.0;
    for (const ExchangePatch& t : s.Triangles)
    {
      area += t.Area;
      for (const Vec3& p : t.Corners)
      {
        group.Box.Add(p);
      }
    }
    for (std::size_t b = 0; b < bands; ++b)
    {
      group.Power[b] += area * s.Exitance[b];
      group.Exitances[b] += s.Exitance[b];
    }
    if (Dot(s.Normal, group.Normal) < 1.0 - 1e-12)
    {
      group.Normal = {};
    }
  }
  for (std::size_t k = begin; k < end && !(group.Normal == Vec3{}); ++k)
  {
    const AreaSource& s = this->Sources[order[k]];
    for (int c = 0; c < s.Outline.N; ++c)
    {
      group.Lowest = std::min(group.Lowest, Dot(group.Normal, s.Outline.P[c]));
    }
  }
  if (end - begin == 1)
  {
    group.Source = order[begin];
    this->Tree[at] = std::move(group);
    return;
  }
  const Vec3 size = group.Box.Size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::size_t middle = (begin + end) / 2;
  std::nth_element(order.begin() + static_cast<std::ptrdiff_t>(begin),
    order.begin() + static_cast<std::ptrdiff_t>(middle),
    order.begin() + static_cast<std::ptrdiff_t>(end), [&](std::int32_t a, std::int32_t b) {
      const double ca = this->Sources[a].Outline.P[0][axis];
      const double cb = this->Sources[b].Outline.P[0][axis];
      return ca < cb || (ca == cb && a < b);
    });
  this->Build(order, begin, middle);
  group.Second = static_cast<std::int32_t>(this->Tree.size());
  this->Tree[at] = std::move(group);
  this->Build(order, middle, end);
}

double AreaSources::Factor(
  const Group& group, const Vec3& center, const Vec3& normal, double radius)
{
  double outside2 = 0.0; // of the center, from the box
  double highest = 0.0;  // of the box over the receiver's plane
  for (int a = 0; a < 3; ++a)
  {
    const double lo = group.Box.Min[a] - center[a];
    const double hi = group.Box.Max[a] - center[a];
    const double out = std::max({ 0.0, lo, -hi });
    outside2 += out * out;
    highest += normal[a] * (normal[a] > 0.0 ? hi : lo);
  }
  if (highest <= 0.0)
  {
    return 0.0;
  }
  const double distance = std::sqrt(outside2) - radius;
  if (!(distance > 0.0))
  {
    return std::numeric_limits<double>::infinity();
  }
  double factor = std::min(1.0, highest / distance) / (Pi * distance * distance);
  if (!(group.Normal == Vec3{}))
  {
    const double before = Dot(group.Normal, center) + radius - group.Lowest;
    factor *= std::clamp(before / distance, 0.0, 1.0);
  }
  return factor;
}

} // namespace radiometry
