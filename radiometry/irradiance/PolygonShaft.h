// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Light.h"
#include "radiometry/visibility/ShadowLines.h"

#include <algorithm>
#include <vector>

namespace radiometry
{

/// The convex hull of a flat convex polygon (counter-clockwise about `normal`, which points to the
/// light's side) and a light. What lies on the polygon's own plane counts, what lies along the hull's
/// sides within `tolerance` (m) does not.
class PolygonShaft
{
public:
  PolygonShaft(const std::vector<Vec3>& polygon, const Vec3& normal, const Light& light,
    double tolerance)
  {
    this->Add(normal, polygon[0], -tolerance);
    for (std::size_t k = 0; k < polygon.size(); ++k)
    {
      const Vec3& a = polygon[k];
      const Vec3& b = polygon[(k + 1) % polygon.size()];
      const Vec3 toLight =
        light.Type == LightType::Directional ? -light.Direction : light.Position - a;
      this->Add(Normalized(Cross(toLight, b - a)), a, tolerance);
    }
  }
  /// Length of the part of a segment that is inside.
  double Inside(const Segment3& s) const
  {
    double lo = 0.0;
    double hi = 1.0;
    for (std::size_t k = 0; k < this->Normals.size() && lo < hi; ++k)
    {
      const double a = Dot(this->Normals[k], s.A) + this->Offsets[k];
      const double b = Dot(this->Normals[k], s.B) + this->Offsets[k];
      if (a <= 0.0 && b <= 0.0)
      {
        return 0.0;
      }
      if (a <= 0.0)
      {
        lo = std::max(lo, a / (a - b));
      }
      else if (b <= 0.0)
      {
        hi = std::min(hi, a / (a - b));
      }
    }
    return lo < hi ? (hi - lo) * Length(s.B - s.A) : 0.0;
  }

private:
  void Add(const Vec3& normal, const Vec3& through, double threshold)
  {
    this->Normals.push_back(normal);
    this->Offsets.push_back(-Dot(normal, through) - threshold);
  }
  std::vector<Vec3> Normals;
  std::vector<double> Offsets;
};

} // namespace radiometry
