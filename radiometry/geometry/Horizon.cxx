// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/Horizon.h"

#include <algorithm>
#include <limits>

namespace radiometry
{
namespace
{

constexpr double Units = 4.0 * std::numeric_limits<double>::epsilon();

/// Distance of `p` from a triangle, taken in its plane's neighbourhood: 0 over its inside.
double DistanceFrom(const Triangle3& t, const Vec3& normal, const Vec3& p)
{
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (int k = 0; k < 3; ++k)
  {
    const Vec3 edge = t[(k + 1) % 3] - t[k];
    const Vec3 to = p - t[k];
    const double along = std::clamp(Dot(to, edge) / LengthSquared(edge), 0.0, 1.0);
    nearest = std::min(nearest, Length(to - along * edge));
    inside = inside && Dot(normal, Cross(edge, to)) >= 0.0;
  }
  return inside ? 0.0 : nearest;
}

} // namespace

double LeastHeight(const Triangle3& t)
{
  const double longest =
    std::max({ Length(t[1] - t[0]), Length(t[2] - t[1]), Length(t[0] - t[2]) });
  return 2.0 * Area(t) / longest;
}

PlaneSide FindSide(const Triangle3& t, const Vec3& normal, const Vec3& point, double extent)
{
  const Vec3 to = point - t[0];
  const double r = Length(to);
  const double height = std::fabs(Dot(normal, to));
  const double size = LeastHeight(t);
  const double reach = r + Length(t[1] - t[0]) + Length(t[2] - t[0]); // above any distance
  if (height > Units * (r + extent * (1.0 + reach / size)))
  {
    return PlaneSide::Known; // the common case
  }
  const double apart = DistanceFrom(t, normal, point);
  if (height > Units * (r + extent * (1.0 + apart / size)))
  {
    return PlaneSide::Known;
  }
  return apart > 0.0 ? PlaneSide::Unknown : PlaneSide::Touching;
}

PlaneSide FindSide(const Triangle3& t, double cosine, double extent)
{
  return std::fabs(cosine) <= Units * (1.0 + extent / LeastHeight(t)) ? PlaneSide::Unknown
                                                                      : PlaneSide::Known;
}

} // namespace radiometry
