// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/SeenPolygon.h"

#include "radiometry/geometry/PolygonFormFactor.h"
#include "radiometry/geometry/SolidAngle.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double Epsilon = std::numeric_limits<double>::epsilon();

double Largest(const Vec3& v)
{
  return std::max({ std::fabs(v.x), std::fabs(v.y), std::fabs(v.z) });
}

/// The angle that a triangle fills about a point of its plane: 2 pi inside it, pi on its rim, a
/// corner's angle there, 0 outside.
double AngleAbout(const Triangle3& triangle, const Vec3& normal, const Vec3& point)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (triangle[k] == point)
    {
      const Vec3 u = triangle[(k + 1) % 3] - point, v = triangle[(k + 2) % 3] - point;
      return std::atan2(Length(Cross(u, v)), Dot(u, v));
    }
  }
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Vec3& p = triangle[k];
    const Vec3& q = triangle[(k + 1) % 3];
    const Vec3 a = p - point;
    const Vec3 b = q - point;
    const double side = Dot(normal, Cross(a, q - p));
    const double rounding = 4.0 * Epsilon * (Largest(point) + Largest(p) + Largest(q)) *
      (Largest(q - p) + Largest(a));
    if (std::fabs(side) <= rounding && Dot(a, b) <= 0.0)
    {
      return Pi; // on this edge
    }
    sum += std::atan2(side, Dot(a, b));
  }
  return sum > Pi ? 2.0 * Pi : 0.0;
}

/// Area of the picture of a triangle on the plane at distance 1 along the axis.
double PictureArea(const Triangle3& triangle, const Viewer& viewer)
{
  Vec3 picture[3];
  double depth[3];
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Vec3 way = triangle[k] - viewer.Eye;
    depth[k] = Dot(viewer.Axis, way);
    if (!(depth[k] > 0.0))
    {
      return std::numeric_limits<double>::infinity();
    }
    picture[k] = way;
  }
  // Axis . ((q - p) x (r - p)) of the corners over their depths, as the volume of the ways
  // over the product of the depths: edges keep the digits of small triangles.
  const double volume =
    Dot(picture[0], Cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
  return 0.5 * std::fabs(volume) / (depth[0] * depth[1] * depth[2]);
}

/// What of the half-space below the plane about `normal` lies above that about `about`, of directions
/// weighted with the cosine to the latter.
double HalfProjected(const Vec3& normal, const Vec3& about)
{
  return 0.5 * Pi * (1.0 - Dot(normal, about));
}

} // namespace

int SeenSide(const Triangle3& triangle, const Vec3& normal, const Viewer& viewer)
{
  if (viewer.Parallel)
  {
    const double cosine = Dot(normal, -viewer.Direction);
    return std::fabs(cosine) <= 4.0 * Epsilon ? 0 : (cosine > 0.0 ? 1 : -1);
  }
  const double height = HeightOverPlane(viewer.Eye, triangle, normal);
  if (height != 0.0)
  {
    return height > 0.0 ? 1 : -1;
  }
  return AngleAbout(triangle, normal, viewer.Eye) > 0.0 ? 1 : 0;
}

void SeenPolygon::Add(
  const Triangle3& triangle, const Vec3& normal, const Viewer& viewer, double extent)
{
  const int side = SeenSide(triangle, normal, viewer);
  this->Front = this->Front || side > 0;
  this->Back = this->Back || side < 0;
  if (viewer.Parallel)
  {
    return;
  }
  const double height = HeightOverPlane(viewer.Eye, triangle, normal);
  double nearest = std::numeric_limits<double>::infinity();
  double around = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    nearest = std::min(nearest, Length(triangle[k] - viewer.Eye));
    around += Length(triangle[(k + 1) % 3] - triangle[k]);
  }
  // Corners off by rounding: the rim of the solid angle moves by that over the distance.
  const double shift = 2.0 * Epsilon * (extent + nearest);
  const double rounding = nearest > 0.0
    ? std::min(2.0 * Pi, shift / nearest * std::min(2.0 * Pi, around / nearest))
    : 0.0;
  if (height == 0.0)
  {
    const double angle = AngleAbout(triangle, normal, viewer.Eye);
    this->SolidAngle += angle;
    this->Projected += angle / (2.0 * Pi) * HalfProjected(normal, viewer.Normal);
    this->AxisProjected += angle / (2.0 * Pi) * HalfProjected(normal, viewer.Axis);
    this->SolidAngleError += rounding;
    this->ProjectedError += rounding;
    this->ImageArea +=
      angle > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
    return;
  }
  const double angle = std::fabs(radiometry::SolidAngle(triangle.data(), 3, viewer.Eye));
  Triangle3 facing = triangle;
  if (height < 0.0)
  {
    std::swap(facing[1], facing[2]);
  }
  const SmallPolygon polygon(facing);
  const double projected = Pi * PointToPolygon(viewer.Eye, viewer.Normal, polygon);
  this->SolidAngle += angle;
  this->Projected += projected;
  this->AxisProjected += Pi * PointToPolygon(viewer.Eye, viewer.Axis, polygon);
  this->SolidAngleError += rounding + 32.0 * Epsilon * angle;
  this->ProjectedError += rounding + 512.0 * Epsilon * projected +
    Pi * PointToPolygonRounding(viewer.Eye, facing.data(), 3);
  this->ImageArea += PictureArea(triangle, viewer);
}

} // namespace radiometry
