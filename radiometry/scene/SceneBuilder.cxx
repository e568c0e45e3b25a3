// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/scene/SceneBuilder.h"

#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace radiometry
{
namespace
{

/// Beyond this, squares of areas overflow.
constexpr double LargestCoordinate = 1e60;

bool Less(const Vec3& a, const Vec3& b)
{
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// True when the triangle's area cannot be told from zero at the precision of its coordinates.
bool WithoutArea(const Triangle3& t)
{
  const Vec3 a = t[1] - t[0];
  const Vec3 b = t[2] - t[0];
  const double longest = std::max({ Length(a), Length(b), Length(t[2] - t[1]) });
  return !(Length(Cross(a, b)) > 1e-15 * longest * longest);
}

} // namespace

void SceneBuilder::AddMesh(Role role, const std::vector<Vec3>& points,
  const std::vector<std::array<std::int32_t, 3>>& triangles, const std::vector<std::int32_t>& cell,
  double metersPerUnit, const std::string& name)
{
  if (!(metersPerUnit > 0.0) || !std::isfinite(metersPerUnit))
  {
    throw InputError("MetersPerUnit", -1, metersPerUnit, "a positive finite number");
  }
  const auto first = static_cast<std::int32_t>(this->Points.size());
  this->Points.reserve(this->Points.size() + points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      const double value = points[i][a];
      if (!std::isfinite(value) || std::fabs(value * metersPerUnit) > LargestCoordinate)
      {
        throw InputError(
          name, static_cast<long long>(i), value, "finite coordinates of at most 1e60 m");
      }
    }
    this->Points.push_back(metersPerUnit * points[i]);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    std::array<std::int32_t, 3> corners = triangles[t];
    for (std::int32_t& c : corners)
    {
      c += first;
    }
    if (WithoutArea({ this->Points[corners[0]], this->Points[corners[1]], this->Points[corners[2]] }))
    {
      ++this->DroppedTriangles;
      continue;
    }
    this->Triangles.push_back(corners);
    this->TriangleCell.push_back(role == Role::Receiver ? cell[t] : -1);
    if (role == Role::Receiver)
    {
      ++this->ReceiverTriangles;
    }
    else
    {
      this->OccluderCell.push_back(cell[t]);
    }
  }
}

Scene SceneBuilder::Finish(std::size_t cells, std::vector<std::int32_t>* occluderCells)
{
  if (occluderCells)
  {
    *occluderCells = std::move(this->OccluderCell);
  }
  Scene scene;
  scene.Cells = cells;
  scene.ReceiverTriangles = this->ReceiverTriangles;
  scene.TriangleCell = std::move(this->TriangleCell);

  // Points of equal coordinates are one point.
  std::vector<std::int32_t> order(this->Points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return Less(this->Points[a], this->Points[b]) ||
      (this->Points[a] == this->Points[b] && a < b);
  });
  std::vector<std::int32_t> joined(this->Points.size());
  Vec3 low;
  Vec3 high;
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    const Vec3& p = this->Points[order[k]];
    if (k == 0 || !(p == this->Points[order[k - 1]]))
    {
      for (int a = 0; a < 3; ++a)
      {
        low[a] = k == 0 ? p[a] : std::min(low[a], p[a]);
        high[a] = k == 0 ? p[a] : std::max(high[a], p[a]);
      }
      scene.Points.push_back(p);
    }
    joined[order[k]] = static_cast<std::int32_t>(scene.Points.size()) - 1;
  }
  scene.Origin = 0.5 * (low + high);
  for (Vec3& p : scene.Points)
  {
    p = p - scene.Origin;
  }
  scene.Triangles = std::move(this->Triangles);
  for (auto& t : scene.Triangles)
  {
    for (std::int32_t& c : t)
    {
      c = joined[c];
    }
  }
  *this = SceneBuilder();
  return scene;
}

} // namespace radiometry
