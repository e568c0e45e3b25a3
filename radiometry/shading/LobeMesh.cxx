// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/shading/LobeMesh.h"

#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Scene.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
/// The last ring lies so far above the horizon, where f is 0 by definition, as a share of the way.
constexpr double AboveHorizon = 1e-9;

constexpr double LobeEnd = 1e-3; // of its height

/// Angles from the mirror direction, between equal steps of the lobe's height and equal angles;
/// the last is where it has fallen to LobeEnd.
std::vector<double> LobeRings(const Brdf& brdf, int count)
{
  // About the mirror direction the angle between N and H is half of that between R and V.
  const bool blinn = brdf.Reflection == ReflectionModel::BlinnPhong;
  const double n = std::max(brdf.Shininess, 0.5);
  const auto at = [n](double height) {
    return std::acos(std::exp(std::log(std::max(height, LobeEnd)) / n));
  };
  std::vector<double> angles;
  for (int i = 1; i <= count; ++i)
  {
    const double share = static_cast<double>(i) / count;
    const double byHeight = at(i < count ? 1.0 - share : LobeEnd);
    angles.push_back((0.6 * byHeight + 0.4 * share * at(LobeEnd)) * (blinn ? 2.0 : 1.0));
  }
  return angles;
}

void Check(const Brdf& brdf, const LobeShape& shape)
{
  CheckBrdf(brdf);
  if (brdf.Reflection == ReflectionModel::Physical && brdf.Specular > 0.0 &&
    brdf.Shininess >= MirrorShininess)
  {
    throw InputError("Shininess", -1, brdf.Shininess,
      "below 1e6: a perfect mirror has no finite BRDF to draw");
  }
  const auto direction = [](const char* name, const Vec3& v) {
    if (!IsFinite(v) || !(Length(v) > 0.0))
    {
      throw InputError(name, -1, IsFinite(v) ? 0.0 : v.x, "a finite direction, not (0, 0, 0)");
    }
  };
  direction("Normal", shape.Normal);
  direction("IncidentDirection", shape.Toward);
  const double cosine = Dot(Normalized(shape.Normal), Normalized(shape.Toward));
  if (!(cosine > 1e-9))
  {
    throw InputError("IncidentDirection", -1, cosine,
      "light that falls onto the surface, against its normal, less than 90 degrees from it");
  }
  if (!(shape.Decades >= 0.0) || !std::isfinite(shape.Decades))
  {
    throw InputError("Decades", -1, shape.Decades, "a finite number of at least 0");
  }
  if (!(shape.Radius >= 0.0) || !std::isfinite(shape.Radius))
  {
    throw InputError("Radius", -1, shape.Radius, "a finite length of at least 0");
  }
  if (shape.Resolution < 4 || shape.Resolution > 2000)
  {
    throw InputError("Resolution", -1, shape.Resolution, "4 to 2000");
  }
}

} // namespace

Vec3 TowardAtAngle(const Vec3& normal, double angle)
{
  const Vec3 n = Normalized(normal);
  const Vec3 any = std::fabs(n.x) < 0.9 ? Vec3{ 1, 0, 0 } : Vec3{ 0, 1, 0 };
  return std::cos(angle) * n + std::sin(angle) * Normalized(any - Dot(any, n) * n);
}

double GreatestDistance(const LobeMesh& mesh)
{
  double most = 0.0;
  for (const Vec3& p : mesh.Points)
  {
    most = std::max(most, Length(p));
  }
  return most;
}

LobeMesh MakeLobeMesh(const Brdf& brdf, const LobeShape& shape)
{
  Check(brdf, shape);
  const Vec3 normal = Normalized(shape.Normal);
  const Vec3 in = Normalized(shape.Toward);
  const double c = Dot(normal, in);
  const Vec3 mirror = Normalized(2.0 * c * normal - in);
  // A frame about the mirror direction whose first axis rises toward the normal.
  Vec3 rise = normal - c * mirror;
  double sine = Length(rise);
  if (sine > 1e-9)
  {
    rise = rise / sine;
  }
  else
  {
    const Vec3 any = std::fabs(normal.x) < 0.5 ? Vec3{ 1, 0, 0 } : Vec3{ 0, 1, 0 };
    rise = Normalized(any - Dot(any, mirror) * mirror);
    sine = 0.0;
  }
  const Vec3 across = Cross(mirror, rise);

  LobeMesh mesh;
  mesh.CosIncident = c;
  const auto add = [&](double alpha, double psi) {
    const Vec3 w = Normalized(std::cos(alpha) * mirror +
      std::sin(alpha) * (std::cos(psi) * rise + std::sin(psi) * across));
    mesh.Directions.push_back(w);
    mesh.Cosines.push_back(std::max(0.0, Dot(normal, w)));
    mesh.Values.push_back(EvaluateBrdf(brdf, normal, in, w));
  };
  const int rings = shape.Resolution;
  const int around = 2 * shape.Resolution;
  const int inner = brdf.Specular > 0.0 ? rings / 2 : 0;
  const std::vector<double> lobe = LobeRings(brdf, std::max(inner, 1));
  add(0.0, 0.0);
  for (int i = 1; i <= rings; ++i)
  {
    for (int k = 0; k < around; ++k)
    {
      const double psi = 2.0 * Pi * k / around;
      // Height over the surface: c cos(alpha) + s cos(psi) sin(alpha).
      const double horizon = std::atan2(c, -sine * std::cos(psi)) * (1.0 - AboveHorizon);
      const double width = inner > 0 ? std::min(lobe.back(), 0.5 * horizon) : 0.0;
      const double alpha = i <= inner
        ? lobe[static_cast<std::size_t>(i - 1)] * (width / lobe.back())
        : (inner > 0 ? width * std::pow(horizon / width, (i - inner) / double(rings - inner))
                     : horizon * i / rings); // steps that grow: the lobe's tail is small, too
      add(alpha, psi);
    }
  }
  const auto id = [&](int ring, int k) {
    return static_cast<std::int64_t>(ring == 0 ? 0 : 1 + (ring - 1) * around + k % around);
  };
  for (int i = 0; i < rings; ++i)
  {
    for (int k = 0; k < around; ++k)
    {
      if (i == 0)
      {
        mesh.Corners.insert(mesh.Corners.end(), { 0, id(1, k), id(1, k + 1) });
      }
      else
      {
        mesh.Corners.insert(
          mesh.Corners.end(), { id(i, k), id(i + 1, k), id(i + 1, k + 1), id(i, k + 1) });
      }
      mesh.Offsets.push_back(static_cast<std::int64_t>(mesh.Corners.size()));
    }
  }

  std::vector<double> height = mesh.Values;
  for (std::size_t k = 0; k < height.size(); ++k)
  {
    height[k] *= shape.Cosine ? mesh.Cosines[k] : 1.0;
    mesh.Greatest = std::max(mesh.Greatest, height[k]);
  }
  for (std::size_t k = 0; k < height.size(); ++k)
  {
    double r = shape.Radius > 0.0 && mesh.Greatest > 0.0
      ? shape.Radius * height[k] / mesh.Greatest
      : height[k];
    if (shape.Decades > 0.0)
    {
      const double full = shape.Radius > 0.0 ? shape.Radius : 1.0;
      r = height[k] > 0.0
        ? full * std::max(0.0, 1.0 + std::log10(height[k] / mesh.Greatest) / shape.Decades)
        : 0.0;
    }
    mesh.Points.push_back(r * mesh.Directions[k]);
  }
  return mesh;
}

double MeshReflectance(const LobeMesh& mesh)
{
  double sum = 0.0;
  const auto add = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j),
               c = static_cast<std::size_t>(k);
    const Vec3& p = mesh.Directions[a];
    const Vec3& q = mesh.Directions[b];
    const Vec3& r = mesh.Directions[c];
    const double omega = 2.0 *
      std::atan2(Dot(p, Cross(q - p, r - p)), 1.0 + Dot(p, q) + Dot(q, r) + Dot(r, p));
    sum += omega / 3.0 *
      (mesh.Values[a] * mesh.Cosines[a] + mesh.Values[b] * mesh.Cosines[b] +
        mesh.Values[c] * mesh.Cosines[c]);
  };
  for (std::size_t cell = 0; cell + 1 < mesh.Offsets.size(); ++cell)
  {
    const std::int64_t* ids = &mesh.Corners[static_cast<std::size_t>(mesh.Offsets[cell])];
    const std::int64_t count = mesh.Offsets[cell + 1] - mesh.Offsets[cell];
    add(ids[0], ids[1], ids[2]);
    if (count == 4)
    {
      add(ids[0], ids[2], ids[3]);
    }
  }
  return sum;
}

} // namespace radiometry
