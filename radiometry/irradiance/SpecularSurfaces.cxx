// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/SpecularSurfaces.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/Reflectance.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr std::size_t TableSize = 257;
constexpr std::size_t MostTables = 64;

bool AnyPositive(const std::vector<double>& values)
{
  return std::any_of(values.begin(), values.end(), [](double v) { return v > 0.0; });
}

/// The values of a side; the back has the front's where it has none of its own.
const std::vector<double>& Of(const std::array<std::vector<double>, 2>& sides, std::size_t side)
{
  return sides[side].empty() ? sides[0] : sides[side];
}

/// a is tabulated relative to hypot(c, 1/k), which it is like, by asinh(k c), k = sqrt(n + 2): a sharp
/// lobe reflects with the cosine, down to where the horizon cuts it.
double Stretch(double exponent) { return std::sqrt(exponent + 2.0); }
double Like(double k, double cosine) { return std::sqrt(cosine * cosine + 1.0 / (k * k)); }

/// A direction about `axis` with density cos^n.
Vec3 LobeDirection(const Vec3& axis, double exponent, double u, double v)
{
  // 1 - cos without cancellation: sharp lobes keep their digits.
  const double versine = -std::expm1(std::log(u) / (exponent + 1.0));
  const double sine = std::sqrt(versine * (2.0 - versine));
  Vec3 s, t;
  Frame(axis, s, t);
  const double psi = 2.0 * Pi * v;
  return (1.0 - versine) * axis + (sine * std::cos(psi)) * s + (sine * std::sin(psi)) * t;
}

double Uniform(std::uint64_t& state)
{
  state = Hash64(state);
  return (static_cast<double>(state >> 12) + 0.5) * 0x1p-52;
}

} // namespace

bool SpecularSurfaces::Present(const Scene& scene, bool specular, bool transmission)
{
  return (transmission && AnyPositive(scene.TriangleTransmittance)) ||
    (specular &&
      (AnyPositive(scene.Optics.SpecularReflectance[0]) ||
        AnyPositive(scene.Optics.SpecularReflectance[1])));
}

SpecularSurfaces::SpecularSurfaces(
  const Scene& scene, bool specular, bool transmission, bool backFaces)
  : BandCount(scene.Optics.Bands)
  , FaceOf(scene.Triangles.size(), -1)
{
  const Materials& optics = scene.Optics;
  const auto bands = static_cast<std::size_t>(this->BandCount);
  struct Rows
  {
    std::array<const double*, 2> Reflected{};
    const double* Transmitted = nullptr;
  };
  const auto some = [bands](const double* row) {
    return std::any_of(row, row + bands, [](double v) { return v > 0.0; });
  };
  const auto grey = [bands](const double* row) {
    return std::all_of(row, row + bands, [row](double v) { return v == row[0]; });
  };
  std::vector<Rows> rows;
  std::vector<double> exponents;
  for (std::size_t t = 0; t < scene.Triangles.size(); ++t)
  {
    Rows r;
    Face face;
    bool any = false;
    if (transmission && !scene.TriangleTransmittance.empty() &&
      some(scene.TriangleTransmittance.data() + t * bands))
    {
      r.Transmitted = scene.TriangleTransmittance.data() + t * bands;
      any = true;
    }
    for (std::size_t side = 0; side < 2 && specular && t < scene.ReceiverTriangles; ++side)
    {
      const auto cell = static_cast<std::size_t>(scene.TriangleCell[t]);
      const std::vector<double>& reflectance = Of(optics.SpecularReflectance, side);
      const bool there =
        side == 0 || (backFaces && cell < optics.TwoSided.size() && optics.TwoSided[cell] != 0);
      if (!there || reflectance.empty() || !some(reflectance.data() + cell * bands))
      {
        continue;
      }
      r.Reflected[side] = reflectance.data() + cell * bands;
      const std::vector<double>& shininess = Of(optics.Shininess, side);
      const double n = shininess.empty() ? DefaultShininess : shininess[cell];
      if (n < MirrorShininess)
      {
        face.Lobe[side] = static_cast<std::int32_t>(exponents.size());
        exponents.push_back(n);
      }
      this->AnyReflects = true;
      any = true;
    }
    if (!any)
    {
      continue;
    }
    for (const double* row : { r.Reflected[0], r.Reflected[1], r.Transmitted })
    {
      this->Grey = this->Grey && (!row || grey(row));
    }
    face.Corners = scene.TriangleAt(t);
    face.Normal = Normalized(AreaNormal2(face.Corners));
    this->FaceOf[t] = static_cast<std::int32_t>(this->Faces.size());
    this->Faces.push_back(face);
    rows.push_back(r);
  }
  for (std::size_t f = 0; f < rows.size(); ++f)
  {
    this->Faces[f].Reflected = { this->AddRow(rows[f].Reflected[0]),
      this->AddRow(rows[f].Reflected[1]) };
    this->Faces[f].Transmitted = this->AddRow(rows[f].Transmitted);
  }
  this->Exponents = exponents;
  this->MakeLobes(exponents);
}

std::int32_t SpecularSurfaces::AddRow(const double* values)
{
  if (!values)
  {
    return -1;
  }
  const auto row = static_cast<std::int32_t>(this->Shares.size() / this->Width());
  this->Shares.insert(this->Shares.end(), values, values + this->Width());
  return row;
}

void SpecularSurfaces::MakeLobes(const std::vector<double>& exponents)
{
  std::vector<double> distinct = exponents;
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  if (distinct.size() > MostTables)
  {
    const double from = std::log1p(distinct.front());
    const double to = std::log1p(distinct.back());
    distinct.clear();
    for (std::size_t k = 0; k < MostTables; ++k)
    {
      distinct.push_back(
        std::expm1(from + (to - from) * static_cast<double>(k) / (MostTables - 1.0)));
    }
  }
  this->TableAt = distinct;
  for (const double n : distinct)
  {
    const double k = Stretch(n);
    for (std::size_t i = 0; i < TableSize; ++i)
    {
      const double cosine =
        std::min(1.0, std::sinh(static_cast<double>(i) / (TableSize - 1.0) * std::asinh(k)) / k);
      this->Table.push_back(PhongLobeReflectance(1.0, n, cosine) / Like(k, cosine));
    }
  }
}

double SpecularSurfaces::Escaping(double exponent, double cosine) const
{
  if (exponent == 0.0)
  {
    return 1.0;
  }
  const double k = Stretch(exponent);
  const double at = (TableSize - 1.0) * std::asinh(k * cosine) / std::asinh(k);
  const double like = Like(k, cosine);
  const auto i = std::min(static_cast<std::size_t>(at), TableSize - 2);
  const double f = at - static_cast<double>(i);
  const auto value = [&](std::size_t table) {
    const double* v = this->Table.data() + table * TableSize + i;
    return like * (v[0] + f * (v[1] - v[0]));
  };
  const auto above = static_cast<std::size_t>(
    std::lower_bound(this->TableAt.begin(), this->TableAt.end(), exponent) - this->TableAt.begin());
  if (above == this->TableAt.size())
  {
    return value(above - 1);
  }
  if (this->TableAt[above] == exponent || above == 0)
  {
    return value(above);
  }
  const double lo = std::log1p(this->TableAt[above - 1]);
  const double hi = std::log1p(this->TableAt[above]);
  const double g = (std::log1p(exponent) - lo) / (hi - lo);
  return value(above - 1) + g * (value(above) - value(above - 1));
}

double SpecularSurfaces::Left(std::int32_t triangle, bool front, std::size_t band) const
{
  const Face* face = this->FaceAt(triangle);
  if (!face)
  {
    return 1.0;
  }
  const double left =
    1.0 - this->Share(face->Reflected[front ? 0 : 1], band) - this->Share(face->Transmitted, band);
  return left > 1e-9 ? left : 0.0; // shares that sum to one but for rounding
}

double SpecularSurfaces::Reflectance(std::int32_t triangle, bool front, std::size_t band) const
{
  const Face* face = this->FaceAt(triangle);
  return face ? this->Share(face->Reflected[front ? 0 : 1], band) : 0.0;
}

bool SpecularSurfaces::Mirror(std::int32_t triangle, bool front) const
{
  const Face* face = this->FaceAt(triangle);
  const std::size_t side = front ? 0 : 1;
  return face && face->Reflected[side] >= 0 && face->Lobe[side] < 0;
}

double SpecularSurfaces::Transmittance(std::int32_t triangle, std::size_t band) const
{
  const Face* face = this->FaceAt(triangle);
  return face ? this->Share(face->Transmitted, band) : 0.0;
}

RayEnd SpecularSurfaces::Place(const SurfaceHit& hit) const
{
  const Triangle3& v = this->FaceAt(hit.Triangle)->Corners;
  return { (1.0 - hit.U - hit.V) * v[0] + hit.U * v[1] + hit.V * v[2], hit.Triangle };
}

Vec3 SpecularSurfaces::Normal(std::int32_t triangle, bool front) const
{
  const Face* face = this->FaceAt(triangle);
  return front ? face->Normal : -face->Normal;
}

SpecularSurfaces::Fate SpecularSurfaces::Continue(const SurfaceHit& hit,
  const std::array<double, 4>& u, Vec3& direction, double* weight, double* counted) const
{
  const Face& face = *this->FaceAt(hit.Triangle);
  const std::size_t side = hit.Front ? 0 : 1;
  const std::size_t width = this->Width();
  double reflected = 0.0, transmitted = 0.0;
  for (std::size_t b = 0; b < width; ++b)
  {
    if (weight[b] > 0.0)
    {
      reflected = std::max(reflected, this->Share(face.Reflected[side], b));
      transmitted = std::max(transmitted, this->Share(face.Transmitted, b));
    }
  }
  // Bands of which one is reflected and another let through may ask for more than all.
  const double sum = reflected + transmitted;
  const bool split = sum <= 1.0 + 1e-9;
  if (sum > 1.0 - 1e-9)
  {
    reflected /= sum;
    transmitted /= sum;
  }
  const bool ends = u[0] >= reflected + transmitted && sum <= 1.0 - 1e-9;
  const bool mirrors = !ends && (u[0] < reflected || transmitted == 0.0);
  const std::int32_t row = mirrors ? face.Reflected[side] : face.Transmitted;
  const double chance = mirrors ? reflected : transmitted;
  for (std::size_t b = 0; b < width; ++b)
  {
    const double on = ends ? 0.0 : weight[b] * this->Share(row, b) / chance;
    counted[b] =
      split ? std::max(0.0, weight[b] - on) : weight[b] * this->Left(hit.Triangle, hit.Front, b);
    weight[b] = on;
  }
  if (ends)
  {
    return Fate::Ended;
  }
  if (!mirrors)
  {
    return Fate::Transmitted;
  }
  return this->Bounce(face, side, u, direction);
}

SpecularSurfaces::Fate SpecularSurfaces::Reflect(
  const SurfaceHit& hit, const std::array<double, 4>& u, Vec3& direction, double* weight) const
{
  const Face& face = *this->FaceAt(hit.Triangle);
  const std::size_t side = hit.Front ? 0 : 1;
  for (std::size_t b = 0; b < this->Width(); ++b)
  {
    weight[b] *= this->Share(face.Reflected[side], b);
  }
  return this->Bounce(face, side, u, direction);
}

/// The way on of what is reflected.
SpecularSurfaces::Fate SpecularSurfaces::Bounce(
  const Face& face, std::size_t side, const std::array<double, 4>& u, Vec3& direction) const
{
  const Vec3 normal = side == 0 ? face.Normal : -face.Normal;
  const double cosine = std::min(1.0, std::max(0.0, -Dot(normal, direction)));
  const Vec3 image = Normalized(direction + 2.0 * cosine * normal);
  if (face.Lobe[side] < 0)
  {
    direction = image;
    return Fate::Mirrored;
  }
  const double exponent = this->Exponents[static_cast<std::size_t>(face.Lobe[side])];
  if (exponent == 0.0)
  {
    direction = CosineDirection(normal, u[2], u[3]);
    return Fate::Scattered;
  }
  if (u[1] >= this->Escaping(exponent, cosine))
  {
    return Fate::Absorbed;
  }
  // cos^n(alpha) cos(theta) by rejection.
  std::uint64_t state;
  std::memcpy(&state, &u[3], sizeof state);
  double p = u[2], q = u[3];
  for (int tries = 0; tries < 100000; ++tries)
  {
    const Vec3 out = LobeDirection(image, exponent, p, q);
    const double height = Dot(normal, out);
    if (height > 0.0 && Uniform(state) < height)
    {
      direction = Normalized(out);
      return Fate::Scattered;
    }
    p = Uniform(state);
    q = Uniform(state);
  }
  return Fate::Absorbed; // at a grazing angle whose lobe lies in the surface
}

} // namespace radiometry
