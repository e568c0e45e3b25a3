// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/shading/ExtendedLights.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// theta Gamma . N of the edge from a to b, seen from the origin.
double EdgeTerm(const Vec3& a, const Vec3& b, const Vec3& normal)
{
  const Vec3 product = Cross(a, b);
  const double sine = Length(product);
  return sine > 0.0 ? std::atan2(sine, Dot(a, b)) * Dot(product, normal) / sine : 0.0;
}

} // namespace

double PolygonFormFactor(
  const std::vector<Vec3>& polygon, const Vec3& point, const Vec3& normal)
{
  // Sutherland and Hodgman's cut along the horizon; edges of concave remains cancel on it.
  std::vector<Vec3> seen;
  const std::size_t count = polygon.size();
  for (std::size_t k = 0; k < count; ++k)
  {
    const Vec3 a = polygon[k] - point;
    const Vec3 b = polygon[(k + 1) % count] - point;
    const double heightA = Dot(a, normal);
    const double heightB = Dot(b, normal);
    if (heightA > 0.0)
    {
      seen.push_back(a);
    }
    if ((heightA > 0.0) != (heightB > 0.0))
    {
      seen.push_back(a + (heightA / (heightA - heightB)) * (b - a));
    }
  }
  double sum = 0.0;
  for (std::size_t k = 0; k < seen.size(); ++k)
  {
    sum += EdgeTerm(seen[k], seen[(k + 1) % seen.size()], normal);
  }
  return -sum / (2.0 * Pi);
}

Rgb SkyQuadric::Irradiance(const Vec3& n) const
{
  const std::array<double, 6> squares{ { n.x * n.x, n.y * n.y, n.z * n.z, n.x * n.y, n.x * n.z,
    n.y * n.z } };
  Rgb sum = this->Constant + n.x * this->Linear[0] + n.y * this->Linear[1] + n.z * this->Linear[2];
  for (std::size_t k = 0; k < 6; ++k)
  {
    sum += squares[k] * this->Quadratic[k];
  }
  return { std::max(sum.r, 0.0), std::max(sum.g, 0.0), std::max(sum.b, 0.0) };
}

SkyQuadric SkyQuadric::Rotated(const std::array<Vec3, 3>& rows) const
{
  // n_old = sum over the new axes i of n_i rows[i].
  SkyQuadric turned;
  turned.Constant = this->Constant;
  const auto linear = [this](const Vec3& r) {
    return r.x * this->Linear[0] + r.y * this->Linear[1] + r.z * this->Linear[2];
  };
  const auto quadratic = [this](const Vec3& a, const Vec3& b) {
    const auto& q = this->Quadratic;
    return a.x * b.x * q[0] + a.y * b.y * q[1] + a.z * b.z * q[2] +
      0.5 * (a.x * b.y + a.y * b.x) * q[3] + 0.5 * (a.x * b.z + a.z * b.x) * q[4] +
      0.5 * (a.y * b.z + a.z * b.y) * q[5];
  };
  for (std::size_t i = 0; i < 3; ++i)
  {
    turned.Linear[i] = linear(rows[i]);
    turned.Quadratic[i] = quadratic(rows[i], rows[i]);
  }
  turned.Quadratic[3] = 2.0 * quadratic(rows[0], rows[1]);
  turned.Quadratic[4] = 2.0 * quadratic(rows[0], rows[2]);
  turned.Quadratic[5] = 2.0 * quadratic(rows[1], rows[2]);
  return turned;
}

SkyQuadric ProjectSky(const SkyRadiance& sky, const SkyFrame& frame, const Rgb& intensity)
{
  // Equal solid angles, the horizon between two rows.
  const int rows = std::clamp(2 * sky.Height(), 256, 1024);
  const int columns = std::clamp(2 * sky.Width(), 256, 2048);
  Rgb m0;
  std::array<Rgb, 3> m1;
  std::array<Rgb, 6> m2;
  const bool colored = sky.Bands() == 3;
  for (int j = 0; j < rows && sky.Model() != SkyModel::Uniform; ++j)
  {
    const double z = 1.0 - (2.0 * j + 1.0) / rows;
    const double s = std::sqrt(1.0 - z * z);
    for (int i = 0; i < columns; ++i)
    {
      const double phi = 2.0 * Pi * (i + 0.5) / columns;
      const Vec3 d{ s * std::cos(phi), s * std::sin(phi), z };
      const double first = sky.At(d, 0);
      const Rgb radiance =
        colored ? Rgb{ first, sky.At(d, 1), sky.At(d, 2) } : first * Rgb{ 1.0, 1.0, 1.0 };
      const double parts[6] = { d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.x * d.z, d.y * d.z };
      m0 += radiance;
      m1[0] += d.x * radiance;
      m1[1] += d.y * radiance;
      m1[2] += d.z * radiance;
      for (int k = 0; k < 6; ++k)
      {
        m2[k] += parts[k] * radiance;
      }
    }
  }
  const Rgb weight = (4.0 * Pi / (static_cast<double>(rows) * columns)) * intensity;
  SkyQuadric result;
  if (sky.Model() == SkyModel::Uniform)
  {
    result.Constant = Pi * intensity;
    return result;
  }
  result.Constant = (0.25 - 5.0 / 32.0) * m0 * weight;
  for (int k = 0; k < 3; ++k)
  {
    result.Linear[k] = 0.5 * m1[k] * weight;
    result.Quadratic[k] = (15.0 / 32.0) * m2[k] * weight;
    result.Quadratic[3 + k] = (15.0 / 16.0) * m2[3 + k] * weight;
  }
  // From the sky's own axes to space: the rows are space's axes, seen in the sky's.
  return result.Rotated({ frame.ToSky({ 1.0, 0.0, 0.0 }), frame.ToSky({ 0.0, 1.0, 0.0 }),
    frame.ToSky({ 0.0, 0.0, 1.0 }) });
}

std::array<Vec3, 3> LuminaireAxes(const Vec3& axis, const Vec3& reference)
{
  const Vec3 down = Normalized(axis);
  Vec3 x = Normalized(reference - Dot(reference, down) * down);
  if (x == Vec3{} || !IsFinite(x))
  {
    const Vec3 other = std::abs(down.x) < 0.5 ? Vec3{ 1.0, 0.0, 0.0 } : Vec3{ 0.0, 1.0, 0.0 };
    x = Normalized(other - Dot(other, down) * down);
  }
  return { { x, Cross(x, down), -down } };
}

} // namespace radiometry
