// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/scene/Light.h"
#include "radiometry/visibility/ShadowLines.h"

#include <cstddef>

namespace radiometry
{

/// A convex region between receivers and a light: inside where every plane is positive.
///   Triangle  the convex hull of one triangle and the light
///   Cluster   a pyramid (directional: a prism) of eight sides around many points, seen from the
///             light, and above the lowest of them: holds all that may hide the light from any of
///             them. Only for points that the light sees within a half-angle of some 80 degrees.
class LightShaft
{
public:
  /// What lies on the triangle's own plane counts (a box standing on a floor), what lies along the
  /// shaft's sides within `tolerance` (m) does not (the receiver's own rim).
  static LightShaft OfTriangle(const Triangle3& triangle, const Light& light, double tolerance);
  /// What touches the sides from outside within `tolerance` counts, too. Returns false, and no
  /// shaft, when the points are too close to the light for one. `normal` is their mean normal.
  static bool OfCluster(const Vec3* points, std::size_t count, const Vec3& normal,
    const Light& light, double tolerance, LightShaft& shaft);

  /// The same region in coordinates (p - center) scale.
  LightShaft Scaled(const Vec3& center, double scale) const;

  bool Reaches(const Box3& box) const
  {
    for (int k = 0; k < this->Planes; ++k)
    {
      const Vec3& n = this->Normal[k];
      const double most = n.x * (n.x > 0 ? box.Max.x : box.Min.x) +
        n.y * (n.y > 0 ? box.Max.y : box.Min.y) + n.z * (n.z > 0 ? box.Max.z : box.Min.z);
      if (most + this->Offset[k] <= 0.0)
      {
        return false;
      }
    }
    return true;
  }
  bool Touches(const Segment3& s) const;

private:
  void Add(const Vec3& normal, const Vec3& through, double threshold)
  {
    this->Normal[this->Planes] = normal;
    this->Offset[this->Planes] = -Dot(normal, through) - threshold;
    ++this->Planes;
  }

  Vec3 Normal[9];
  double Offset[9]; // inside: Normal . x + Offset > 0
  int Planes = 0;
};

} // namespace radiometry
