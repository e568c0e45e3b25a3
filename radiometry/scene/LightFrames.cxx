// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/scene/LightFrames.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

Vec3 Column(const Affine& m, int k)
{
  return { m[k], m[4 + k], m[8 + k] };
}

Vec3 MoveDirection(const Affine& m, const Vec3& d)
{
  return Normalized(d.x * Column(m, 0) + d.y * Column(m, 1) + d.z * Column(m, 2));
}

Vec3 MovePoint(const Affine& m, const Vec3& p)
{
  return p.x * Column(m, 0) + p.y * Column(m, 1) + p.z * Column(m, 2) + Column(m, 3);
}

double Determinant(const Affine& m)
{
  return Dot(Column(m, 0), Cross(Column(m, 1), Column(m, 2)));
}

LightRecord Move(const LightRecord& light, const Affine& m)
{
  LightRecord moved = light;
  moved.Position = MovePoint(m, light.Position);
  moved.Direction = MoveDirection(m, light.Direction);
  moved.Reference = MoveDirection(m, light.Reference);
  for (Vec3& corner : moved.Polygon)
  {
    corner = MovePoint(m, corner);
  }
  if (Determinant(m) < 0.0)
  {
    std::reverse(moved.Polygon.begin(), moved.Polygon.end());
  }
  return moved;
}

} // namespace

void ValidateAffine(const char* name, const Affine& matrix)
{
  for (std::size_t k = 0; k < matrix.size(); ++k)
  {
    if (!std::isfinite(matrix[k]))
    {
      throw InputError(name, static_cast<long long>(k), matrix[k], "finite numbers");
    }
    if (k >= 12 && matrix[k] != (k == 15 ? 1.0 : 0.0))
    {
      throw InputError(name, static_cast<long long>(k), matrix[k],
        "a last row of 0 0 0 1 (row by row, no perspective)");
    }
  }
  double product = 1.0;
  for (int k = 0; k < 3; ++k)
  {
    product *= Length(Column(matrix, k));
  }
  if (!(std::fabs(Determinant(matrix)) > 1e-14 * product))
  {
    throw InputError(name, -1, Determinant(matrix), "a matrix that has an inverse (determinant)");
  }
}

Affine EyeToScene(const ViewFrame& view)
{
  if (!IsFinite(view.Position) || !IsFinite(view.FocalPoint) || !IsFinite(view.ViewUp))
  {
    throw InputError("CameraPosition", -1, "not finite",
      "finite CameraPosition, CameraFocalPoint and CameraViewUp");
  }
  const Vec3 back = Normalized(view.Position - view.FocalPoint);
  if (back == Vec3{})
  {
    throw InputError("CameraPosition", -1, "the same as CameraFocalPoint: no camera",
      "a camera, since a light is attached to it (AttachedTo 2)");
  }
  const Vec3 right = Cross(Normalized(view.ViewUp), back);
  if (!(Length(right) > 1e-12))
  {
    throw InputError("CameraViewUp", -1, "zero, or along the line of sight", "a direction across it");
  }
  const Vec3 x = Normalized(right);
  const Vec3 y = Cross(back, x);
  const Vec3& p = view.Position;
  return { x.x, y.x, back.x, p.x, x.y, y.y, back.y, p.y, x.z, y.z, back.z, p.z, 0.0, 0.0, 0.0, 1.0 };
}

LightRecord PlaceLight(const LightRecord& light, const Affine& objectToScene, const ViewFrame& view)
{
  switch (light.AttachedTo)
  {
    case 1:
      return Move(light, objectToScene);
    case 2:
      return Move(light, EyeToScene(view));
    default:
      return light;
  }
}

} // namespace radiometry
