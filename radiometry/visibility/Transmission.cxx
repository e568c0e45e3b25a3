// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/Transmission.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

/// Crossings whose planes are that close are one; in units of the scene's box.
constexpr double SamePlane = 1e-13;
/// Rounding of an edge function, relative to the product of the lengths it was made of.
constexpr double RimRounding = 1e-15;

/// A place where a ray crosses a pane.
struct Crossing
{
  double Distance;
  double Doubt; // of the distance: rounding over the cosine
  std::int32_t Pane;
  std::int32_t Triangle;
  bool Rim; // on an edge or a corner, as far as can be told
};

bool SameSheet(const RayQuery& ray, const Crossing& a, const Crossing& b)
{
  if (std::fabs(a.Distance - b.Distance) > a.Doubt + b.Doubt)
  {
    return false;
  }
  const double along = Dot((*ray.Normals)[a.Triangle], (*ray.Normals)[b.Triangle]);
  return (a.Rim && b.Rim) || std::fabs(along) > 1.0 - 1e-12;
}

/// True when the part of the ray up to its length reaches the box.
bool Reaches(const RayQuery& ray, const Box3& box)
{
  double begin = 0.0;
  double end = ray.Length;
  return box.Cut(ray.Start, ray.Direction, 1e-12, begin, end);
}

/// Whether a ray that crosses the triangle's plane does so inside it, rim included.
bool Inside(const RayQuery& ray, std::int32_t t, bool& rim)
{
  const Triangle3& v = (*ray.Triangles)[t];
  const EdgeFunctions f = FindEdgeFunctions(ray, v);
  double reach = 0.0;
  for (const Vec3& corner : v)
  {
    reach = std::max(reach, LengthSquared(corner - ray.Start));
  }
  const double rounding = RimRounding * reach;
  // Wider than what lets a ray in: then the neighbour that it may also be let into sees the rim, too.
  const double near = 8.0 * rounding;
  rim = std::fabs(f.Least) <= near || std::fabs(f.Most) <= near || std::fabs(f.Middle) <= near;
  return f.Least >= -rounding || f.Most <= rounding;
}

} // namespace

bool Transmission::Present(const Scene& scene)
{
  return std::any_of(scene.TriangleTransmittance.begin(), scene.TriangleTransmittance.end(),
    [](double share) { return share > 0.0; });
}

Transmission::Transmission(const Scene& scene, const std::vector<Box3>& boxes)
  : Bands(scene.Optics.Bands)
  , IsPane(scene.Triangles.size(), 0)
{
  const auto bands = static_cast<std::size_t>(this->Bands);
  std::vector<Box3> paneBoxes;
  for (std::size_t t = 0; t < scene.Triangles.size(); ++t)
  {
    const double* share = &scene.TriangleTransmittance[t * bands];
    if (std::any_of(share, share + bands, [](double s) { return s > 0.0; }))
    {
      this->IsPane[t] = 1;
      this->Triangles.push_back(static_cast<std::int32_t>(t));
      this->Share.insert(this->Share.end(), share, share + bands);
      paneBoxes.push_back(boxes[t]);
    }
  }
  this->Tree = BoxTree(paneBoxes);
}

bool Transmission::Pass(const RayQuery& ray, double* bands) const
{
  static thread_local std::vector<Crossing> crossings;
  crossings.clear();
  this->Tree.Visit([&](const Box3& box) { return Reaches(ray, box); },
    [&](std::int32_t pane) {
      const std::int32_t t = this->Triangles[pane];
      double distance = 0.0;
      bool rim = false;
      if (Judge(ray, t, false, distance) == Verdict::Hit && Inside(ray, t, rim))
      {
        const double cosine = std::fabs(Dot((*ray.Normals)[t], ray.Direction));
        crossings.push_back({ distance, SamePlane / cosine, pane, t, rim });
      }
      return true;
    });
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.Distance < b.Distance || (a.Distance == b.Distance && a.Pane < b.Pane);
  });
  // Sheets: runs of crossings of which each belongs to one that came before it in the run.
  const auto perPane = static_cast<std::size_t>(this->Bands);
  bool any = true;
  for (std::size_t first = 0; first < crossings.size() && any;)
  {
    std::size_t end = first + 1;
    while (end < crossings.size() &&
      std::any_of(crossings.begin() + static_cast<std::ptrdiff_t>(first),
        crossings.begin() + static_cast<std::ptrdiff_t>(end),
        [&](const Crossing& c) { return SameSheet(ray, c, crossings[end]); }))
    {
      ++end;
    }
    any = false;
    for (std::size_t b = 0; b < perPane; ++b)
    {
      double share = 1.0;
      for (std::size_t k = first; k < end; ++k)
      {
        share = std::min(share, this->Share[crossings[k].Pane * perPane + b]);
      }
      bands[b] *= share;
      any = any || bands[b] > 0.0;
    }
    first = end;
  }
  return any;
}

} // namespace radiometry
