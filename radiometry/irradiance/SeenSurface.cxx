// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/SeenSurface.h"

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/irradiance/BeamLights.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// Cosine and angle between the axis and the way to a place; an eye that is there looks along its axis.
void LookAlong(const Viewer& viewer, const Vec3& place, double& cosine, double& degrees)
{
  Vec3 way = viewer.Parallel ? viewer.Direction : Normalized(place - viewer.Eye);
  way = Length(way) > 0.0 ? way : viewer.Axis;
  cosine = Dot(way, viewer.Axis);
  degrees = std::atan2(Length(Cross(way, viewer.Axis)), cosine) * 180.0 / Pi;
}

} // namespace

Vec3 MiddleOf(const Scene& scene, double* radius)
{
  Box3 box;
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    for (const Vec3& corner : scene.TriangleAt(t))
    {
      box.Add(corner);
    }
  }
  const bool any = scene.ReceiverTriangles > 0;
  if (radius)
  {
    *radius = any ? 0.5 * Length(box.Size()) : 0.0;
  }
  return any ? 0.5 * (box.Min + box.Max) : Vec3{};
}

Viewer HomeViewer(const Scene& scene)
{
  double radius = 0.0;
  Viewer viewer;
  const Vec3 middle = MiddleOf(scene, &radius);
  constexpr double HalfAngle = 15.0 * Pi / 180.0;
  viewer.Eye = middle + Vec3{ 0.0, 0.0, (radius > 0.0 ? radius : 1.0) / std::sin(HalfAngle) };
  return viewer;
}

SeenSurface LookAtCells(const Scene& scene, const Viewer& viewer)
{
  const double extent = Extent(scene);
  std::vector<SeenPolygon> polygons(scene.Cells);
  std::vector<Vec3> moments(scene.Cells);
  std::vector<double> areas(scene.Cells, 0.0);
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    const auto cell = static_cast<std::size_t>(scene.TriangleCell[t]);
    const Triangle3 corners = scene.TriangleAt(t);
    const Vec3 normal2 = AreaNormal2(corners);
    const double area = 0.5 * Length(normal2);
    polygons[cell].Add(corners, Normalized(normal2), viewer, extent);
    areas[cell] += area;
    moments[cell] += area * Centroid(corners);
  }
  SeenSurface seen;
  for (std::vector<double>* numbers : { &seen.Facing, &seen.CosAxis, &seen.OffAxisDegrees,
         &seen.SolidAngle, &seen.SolidAngleError, &seen.Projected, &seen.ProjectedError })
  {
    numbers->assign(scene.Cells, 0.0);
  }
  seen.CosFourthMean.assign(scene.Cells, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t c = 0; c < scene.Cells; ++c)
  {
    if (!(areas[c] > 0.0))
    {
      continue;
    }
    const SeenPolygon& p = polygons[c];
    seen.Facing[c] = (p.Front ? 1.0 : 0.0) - (p.Back ? 1.0 : 0.0);
    LookAlong(viewer, moments[c] / areas[c], seen.CosAxis[c], seen.OffAxisDegrees[c]);
    seen.SolidAngle[c] = p.SolidAngle;
    seen.SolidAngleError[c] = p.SolidAngleError;
    seen.Projected[c] = p.Projected;
    seen.ProjectedError[c] = p.ProjectedError;
    seen.CosFourthMean[c] = viewer.Parallel ? std::numeric_limits<double>::quiet_NaN()
                                            : p.CosFourthMean();
  }
  return seen;
}

SeenSurface LookAtPoints(const std::vector<SurfacePoint>& points, const Viewer& viewer)
{
  SeenSurface seen;
  seen.Facing.assign(points.size(), 0.0);
  seen.CosAxis.assign(points.size(), 0.0);
  seen.OffAxisDegrees.assign(points.size(), 0.0);
  seen.CosFourthMean.assign(points.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double cosine = Dot(points[i].Normal, viewer.Toward(points[i].Point));
    seen.Facing[i] = points[i].Triangle < 0 || cosine == 0.0 ? 0.0 : (cosine > 0.0 ? 1.0 : -1.0);
    LookAlong(viewer, points[i].Point, seen.CosAxis[i], seen.OffAxisDegrees[i]);
  }
  return seen;
}

} // namespace radiometry
