// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/LightShaft.h"

#include "radiometry/geometry/Sampling.h"

#include <algorithm>
#include <limits>

namespace radiometry
{
namespace
{

Vec3 Unit(const Vec3& a)
{
  const double l2 = LengthSquared(a);
  return l2 > 1e-280 && l2 < 1e280 ? a / std::sqrt(l2) : Normalized(a);
}

/// The least cosine to the pyramid's axis that a point of a cluster may have.
constexpr double LeastCosine = 0.17;

} // namespace

bool LightShaft::Touches(const Segment3& s) const
{
  SegmentPart part;
  for (int k = 0; k < this->Planes; ++k)
  {
    const double a = Dot(this->Normal[k], s.A) + this->Offset[k];
    const double b = Dot(this->Normal[k], s.B) + this->Offset[k];
    if (!part.Keep(a, b))
    {
      return false;
    }
  }
  return part.Any();
}

LightShaft LightShaft::OfTriangle(const Triangle3& t, const Light& light, double tolerance)
{
  LightShaft shaft;
  shaft.Add(Unit(AreaNormal2(t)), t[0], -tolerance);
  const bool directional = light.Type == LightType::Directional;
  for (int k = 0; k < 3; ++k)
  {
    const Vec3& a = t[k];
    const Vec3& b = t[(k + 1) % 3];
    const Vec3 toLight = directional ? -light.Direction : light.Position - a;
    // Where the light is nearly in line with the side, rounding turns the product: not along it.
    const Vec3 side = b - a;
    const Vec3 product = Cross(toLight, side);
    const Vec3 square = product - (Dot(product, side) / LengthSquared(side)) * side;
    shaft.Add(Unit(square), a, tolerance);
  }
  return shaft;
}

bool LightShaft::OfCluster(const Vec3* points, std::size_t count, const Vec3& normal,
  const Light& light, double tolerance, LightShaft& shaft)
{
  shaft.Planes = 0;
  Vec3 mean;
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < count; ++k)
  {
    mean += points[k];
    lowest = std::min(lowest, Dot(normal, points[k]));
  }
  mean = mean / static_cast<double>(count);
  shaft.Normal[0] = normal;
  shaft.Offset[0] = -lowest + tolerance;
  shaft.Planes = 1;

  // Eight sides: the extent of the points, as seen from the light, along four directions.
  static const double half = std::sqrt(0.5);
  static const double turns[4][2] = { { 1.0, 0.0 }, { half, half }, { 0.0, 1.0 }, { -half, half } };
  const bool directional = light.Type == LightType::Directional;
  const Vec3 origin = directional ? mean : light.Position;
  const Vec3 w = directional ? light.Direction : Unit(mean - light.Position);
  Vec3 s, t;
  Frame(w, s, t);
  double least[4];
  double most[4];
  std::fill(least, least + 4, std::numeric_limits<double>::infinity());
  std::fill(most, most + 4, -std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < count; ++k)
  {
    const Vec3 d = points[k] - origin;
    double x = Dot(s, d);
    double y = Dot(t, d);
    if (!directional)
    {
      const double along = Dot(w, d);
      if (!(along > 0.0) || !(along * along > LeastCosine * LeastCosine * LengthSquared(d)))
      {
        return false;
      }
      x /= along;
      y /= along;
    }
    const double z[4] = { x, half * (x + y), y, half * (y - x) };
    for (int j = 0; j < 4; ++j)
    {
      least[j] = std::min(least[j], z[j]);
      most[j] = std::max(most[j], z[j]);
    }
  }
  for (int j = 0; j < 4; ++j)
  {
    const Vec3 across = turns[j][0] * s + turns[j][1] * t;
    if (directional)
    {
      shaft.Add(-across, origin + most[j] * across, -tolerance);
      shaft.Add(across, origin + least[j] * across, -tolerance);
    }
    else
    {
      shaft.Add(Unit(most[j] * w - across), origin, -tolerance);
      shaft.Add(Unit(across - least[j] * w), origin, -tolerance);
    }
  }
  return true;
}

LightShaft LightShaft::Scaled(const Vec3& center, double scale) const
{
  LightShaft scaled = *this;
  for (int k = 0; k < this->Planes; ++k)
  {
    scaled.Offset[k] = scale * (this->Offset[k] + Dot(this->Normal[k], center));
  }
  return scaled;
}

} // namespace radiometry
