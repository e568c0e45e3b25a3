// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/shading/ShadingBound.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double Infinite = std::numeric_limits<double>::infinity();

/// Values at the corners, and how far the quantity is from their linear interpolant anywhere.
struct Quantity
{
  std::array<double, 3> At{ { 0.0, 0.0, 0.0 } };
  double Error = 0.0;

  double Least() const { return std::min({ At[0], At[1], At[2] }); }
  double Most() const { return std::max({ At[0], At[1], At[2] }); }
  double Low() const { return this->Least() - this->Error; }
  double High() const { return this->Most() + this->Error; }
  double Magnitude() const { return std::max(std::abs(this->Least()), std::abs(this->Most())); }
};

constexpr int First[3] = { 0, 1, 2 };
constexpr int Second[3] = { 1, 2, 0 };

/// max |sum_{i<j} w_i w_j c_ij| over the triangle, c given for the edges 01, 12, 20.
double MixedTerm(const std::array<double, 3>& c)
{
  double most[2] = { 0.0, 0.0 };
  double sum[2] = { 0.0, 0.0 };
  for (const double value : c)
  {
    const int sign = value > 0.0 ? 1 : 0;
    most[sign] = std::max(most[sign], std::abs(value));
    sum[sign] += std::abs(value);
  }
  return std::max(
    std::min(most[0] / 3.0, 0.25 * sum[0]), std::min(most[1] / 3.0, 0.25 * sum[1]));
}

/// max sum_{i<j} w_i w_j d_ij^2 for the squared lengths of a triangle's edges: the square of the
/// circumradius, or of half the longest side where an angle is obtuse.
double Spread(double a, double b, double c)
{
  const double longest = std::max({ a, b, c });
  const double area16 = 2.0 * (a * b + b * c + c * a) - (a * a + b * b + c * c);
  if (2.0 * longest >= a + b + c || !(area16 > 0.0))
  {
    return 0.25 * longest;
  }
  return std::min(a * b * c / area16, longest / 3.0);
}

Quantity operator*(double s, const Quantity& q)
{
  return { { { s * q.At[0], s * q.At[1], s * q.At[2] } }, std::abs(s) * q.Error };
}

Quantity operator-(const Quantity& q, const Quantity& r)
{
  return { { { q.At[0] - r.At[0], q.At[1] - r.At[1], q.At[2] - r.At[2] } }, q.Error + r.Error };
}

Quantity operator+(const Quantity& q, const Quantity& r)
{
  return { { { q.At[0] + r.At[0], q.At[1] + r.At[1], q.At[2] + r.At[2] } }, q.Error + r.Error };
}

Quantity operator*(const Quantity& q, const Quantity& r)
{
  Quantity product;
  std::array<double, 3> mixed;
  for (int k = 0; k < 3; ++k)
  {
    product.At[k] = q.At[k] * r.At[k];
    mixed[k] = (q.At[First[k]] - q.At[Second[k]]) * (r.At[First[k]] - r.At[Second[k]]);
  }
  product.Error =
    q.Error * (r.Magnitude() + r.Error) + q.Magnitude() * r.Error + MixedTerm(mixed);
  return product;
}

using Corners = std::array<Vec3, 3>;

/// a.b of two vectors that are linear over the triangle.
Quantity DotProduct(const Corners& a, const Corners& b)
{
  Quantity product;
  std::array<double, 3> mixed;
  for (int k = 0; k < 3; ++k)
  {
    product.At[k] = Dot(a[k], b[k]);
    mixed[k] = Dot(a[First[k]] - a[Second[k]], b[First[k]] - b[Second[k]]);
  }
  product.Error = MixedTerm(mixed);
  return product;
}

Quantity SquaredLength(const Corners& a)
{
  return { { { LengthSquared(a[0]), LengthSquared(a[1]), LengthSquared(a[2]) } },
    Spread(LengthSquared(a[0] - a[1]), LengthSquared(a[1] - a[2]), LengthSquared(a[2] - a[0])) };
}

/// f(q) from its values at the corners and bounds on |f'| and |f''| over [q.Low(), q.High()]; `range`
/// is how far apart two values of f can be there.
Quantity Composed(const Quantity& q, const std::array<double, 3>& values, double slope,
  double curvature, double range)
{
  const double width = q.Most() - q.Least();
  const double error = slope * q.Error + curvature * width * width / 8.0;
  return { values, error < range ? error : range };
}

/// 1/sqrt(q); q has to stay above 0.
Quantity InverseRoot(const Quantity& q)
{
  const double low = q.Low();
  if (!(low > 0.0))
  {
    return { {}, Infinite };
  }
  const double f = 1.0 / std::sqrt(low);
  return Composed(q,
    { { 1.0 / std::sqrt(q.At[0]), 1.0 / std::sqrt(q.At[1]), 1.0 / std::sqrt(q.At[2]) } },
    0.5 * f / low, 0.75 * f / (low * low), f - 1.0 / std::sqrt(q.High()));
}

/// 1/(u1 r + u2 r^2 + ...) of q = r^2 for coefficients of at least 0. As a function of q it is
/// completely monotone (the inverse of a Bernstein function, times 1/r where u0 = 0), so its
/// derivatives are greatest at the low end.
Quantity InversePolynomial(const Quantity& q, double u0, double u1, double u2, double u3)
{
  const double low = q.Low();
  if (!(low > 0.0))
  {
    return { {}, Infinite };
  }
  const auto value = [&](double squared) {
    const double r = std::sqrt(squared);
    return 1.0 / (u0 + r * (u1 + r * (u2 + r * u3)));
  };
  const double r = std::sqrt(low);
  const double g = value(low);
  const double d1 = u1 + r * (2.0 * u2 + r * 3.0 * u3);
  const double d2 = 2.0 * u2 + 6.0 * u3 * r;
  const double first = -d1 * g * g;
  const double second = (2.0 * d1 * d1 * g - d2) * g * g;
  return Composed(q, { { value(q.At[0]), value(q.At[1]), value(q.At[2]) } },
    std::abs(first) / (2.0 * r), std::abs(second - first / r) / (4.0 * low),
    g - value(q.High()));
}

/// A kink of a slope that changes by `jump` at `place`: what it adds to the error.
double Kink(const Quantity& q, double place, double jump)
{
  const double above = q.Most() - place;
  const double below = place - q.Least();
  return above > 0.0 && below > 0.0 ? jump * above * below / (above + below) : 0.0;
}

/// max(q, 0)
Quantity Positive(const Quantity& q)
{
  const double high = q.High();
  if (!(high > 0.0))
  {
    return high <= 0.0 ? Quantity{} : Quantity{ {}, Infinite };
  }
  return { { { std::max(q.At[0], 0.0), std::max(q.At[1], 0.0), std::max(q.At[2], 0.0) } },
    std::min(q.Error + Kink(q, 0.0, 1.0), high - std::max(q.Low(), 0.0)) };
}

/// max(q, 0)^n of a cosine q.
Quantity Power(const Quantity& q, double n)
{
  if (n == 0.0)
  {
    return { { { 1.0, 1.0, 1.0 } }, 0.0 };
  }
  const double high = std::min(q.High(), 1.0);
  const double low = std::clamp(q.Low(), 0.0, 1.0);
  if (!(high > 0.0))
  {
    return high <= 0.0 ? Quantity{} : Quantity{ {}, Infinite };
  }
  const auto value = [n](double x) { return x > 0.0 ? std::pow(x, n) : 0.0; };
  const std::array<double, 3> values{ { value(q.At[0]), value(q.At[1]), value(q.At[2]) } };
  const double range = value(high) - value(low);
  if (n == 1.0)
  {
    return { values, std::min(q.Error + Kink(q, 0.0, 1.0), range) };
  }
  // Powers of powers: monotone, so each is greatest at one end.
  const double slope = n * std::pow(n > 1.0 ? high : low, n - 1.0);
  const double curvature = n * std::abs(n - 1.0) * std::pow(n > 2.0 ? high : low, n - 2.0);
  return Composed(q, values, slope, curvature, range);
}

/// The cone of a spot: cosine^exponent inside, with its edge.
Quantity Cone(const DisplayLight& light, const Quantity& cosine)
{
  const double cutoff = light.CosCutoff;
  if (cosine.High() < cutoff)
  {
    return {};
  }
  Quantity result = Power(cosine, light.SpotExponent);
  if (light.SmoothEdge && light.CosInnerCutoff > cutoff)
  {
    const double width = light.CosInnerCutoff - cutoff;
    const auto value = [&](double c) {
      const double t = std::clamp((c - cutoff) / width, 0.0, 1.0);
      return t * t;
    };
    const double high = value(cosine.High());
    const double low = value(cosine.Low());
    const bool flat = cosine.Low() >= light.CosInnerCutoff;
    Quantity edge = Composed(cosine,
      { { value(cosine.At[0]), value(cosine.At[1]), value(cosine.At[2]) } },
      flat ? 0.0 : 2.0 / width * std::sqrt(high), flat ? 0.0 : 2.0 / (width * width), Infinite);
    edge.Error += Kink(cosine, light.CosInnerCutoff, 2.0 / width);
    edge.Error = std::min(edge.Error, high - low);
    return edge * result;
  }
  if (cosine.Low() < cutoff)
  {
    const double height = result.High(); // both pictures lie between 0 and this
    for (int k = 0; k < 3; ++k)
    {
      result.At[k] = cosine.At[k] < cutoff ? 0.0 : result.At[k];
    }
    result.Error = height;
  }
  return result;
}

bool IsBlack(const Rgb& c)
{
  return c.r == 0.0 && c.g == 0.0 && c.b == 0.0;
}

/// What of a triangle is the same for all lights.
struct Place
{
  const ShadedTriangle& Triangle;
  Corners ToViewer;
  Quantity InverseNormal; // 1/|n|
  Quantity InverseViewer; // 1/|v|
  Quantity NormalViewer;  // cosine
};

/// The bounds of a light's parts on one side, for a light of colour 1.
struct Parts
{
  double Ambient = 0.0;
  double Diffuse = 0.0;
  double Specular = 0.0;
};

/// Of one light: everything that its sides share.
struct Incidence
{
  Quantity Factor;       // fall-off and cone
  Quantity Cosine;       // N.L
  Quantity Irradiance;   // Factor N.L, of either sign
  Quantity Highlight[2]; // cosine of the highlight on the front and on the back
};

Incidence IncidenceOf(const LightingModel& model, const DisplayLight& light, const Place& place,
  bool highlight)
{
  Incidence in;
  // The fall-off alone counts for ambient light and for a legacy highlight.
  const bool factor = !IsBlack(light.Ambient) ||
    (highlight && model.Reflection != ReflectionModel::Physical);
  Corners toLight;
  const Vec3 position{ light.Position[0], light.Position[1], light.Position[2] };
  const double w = light.Position[3];
  Quantity inverse;
  Quantity lambert;
  if (w == 0.0)
  {
    const Vec3 unit = Normalized(position);
    toLight = { { unit, unit, unit } };
    inverse.At = { { 1.0, 1.0, 1.0 } };
    in.Factor = inverse;
    in.Cosine = DotProduct(place.Triangle.Normals, toLight) * place.InverseNormal;
    in.Irradiance = in.Cosine;
  }
  else
  {
    for (int k = 0; k < 3; ++k)
    {
      toLight[k] = position / w - place.Triangle.Points[k];
    }
    const Quantity squared = SquaredLength(toLight);
    const Quantity normal =
      DotProduct(place.Triangle.Normals, toLight) * place.InverseNormal; // r N.L
    const auto& a = light.Attenuation;
    in.Irradiance = normal * InversePolynomial(squared, 0.0, a[0], a[1], a[2]);
    if (factor)
    {
      in.Factor = InversePolynomial(squared, a[0], a[1], a[2], 0.0);
    }
    if (highlight || light.CosCutoff > -1.0)
    {
      inverse = InverseRoot(squared);
      in.Cosine = normal * inverse;
    }
    if (light.CosCutoff > -1.0)
    {
      const Vec3 axis = -Normalized(light.SpotDirection);
      const Quantity cone =
        Cone(light, DotProduct(toLight, { { axis, axis, axis } }) * inverse);
      in.Factor = factor ? in.Factor * cone : Quantity{};
      in.Irradiance = in.Irradiance * cone;
    }
  }
  if (highlight)
  {
    const Quantity lightViewer =
      DotProduct(toLight, place.ToViewer) * (inverse * place.InverseViewer);
    if (model.Reflection == ReflectionModel::BlinnPhong)
    {
      // N.H = (N.L + N.V)/|L + V|, |L + V|^2 = 2 + 2 L.V
      const Quantity two{ { { 2.0, 2.0, 2.0 } }, 0.0 };
      in.Highlight[0] =
        (in.Cosine + place.NormalViewer) * InverseRoot(two + 2.0 * lightViewer);
      in.Highlight[1] = -1.0 * in.Highlight[0];
    }
    else
    {
      // R.V = 2 N.L N.V - L.V, the same for N and -N
      in.Highlight[0] = 2.0 * (in.Cosine * place.NormalViewer) - lightViewer;
      in.Highlight[1] = in.Highlight[0];
    }
  }
  return in;
}

Parts PartsOf(const LightingModel& model, const Incidence& in, int side, bool highlight,
  double shininess)
{
  Parts parts;
  parts.Ambient = in.Factor.Error;
  const Quantity lit = Positive(side == 0 ? in.Irradiance : -1.0 * in.Irradiance);
  const bool physical = model.Reflection == ReflectionModel::Physical;
  parts.Diffuse = physical ? lit.Error / Pi : lit.Error;
  if (highlight)
  {
    const Quantity lobe = Power(in.Highlight[side], shininess);
    const Quantity cosine = side == 0 ? in.Cosine : -1.0 * in.Cosine;
    if (physical)
    {
      parts.Specular = (shininess + 2.0) / (2.0 * Pi) * (lobe * lit).Error;
    }
    else if (cosine.High() <= 0.0)
    {
      parts.Specular = 0.0;
    }
    else
    {
      const double height = lobe.High() * in.Factor.High();
      parts.Specular = cosine.Low() > 0.0 ? std::min((lobe * in.Factor).Error, height) : height;
    }
  }
  return parts;
}

Rgb Magnitude(const Rgb& c)
{
  return { std::abs(c.r), std::abs(c.g), std::abs(c.b) };
}

/// 0 times an infinite bound is 0.
Rgb Times(double bound, const Rgb& c)
{
  return { c.r == 0.0 ? 0.0 : bound * c.r, c.g == 0.0 ? 0.0 : bound * c.g,
    c.b == 0.0 ? 0.0 : bound * c.b };
}

} // namespace

double ShadingBound(const LightingModel& model, const std::vector<DisplayLight>& lights,
  const DisplayMaterial& front, const DisplayMaterial& back, const Vec3& eye, const Vec3& viewer,
  const ShadedTriangle& triangle, double enough)
{
  for (int k = 0; k < 3; ++k)
  {
    if (!IsFinite(triangle.Points[k]) || !IsFinite(triangle.Normals[k]))
    {
      return Infinite;
    }
  }
  Place place{ triangle, {}, InverseRoot(SquaredLength(triangle.Normals)), {}, {} };
  const DisplayMaterial* sides[2] = { &front, &back };
  const int count = model.TwoSided ? 2 : 1;
  const bool anyHighlight = !IsBlack(front.Specular) || (count == 2 && !IsBlack(back.Specular));
  if (anyHighlight)
  {
    const Vec3 far = Normalized(viewer);
    for (int k = 0; k < 3; ++k)
    {
      place.ToViewer[k] = model.LocalViewer ? eye - triangle.Points[k] : far;
    }
    place.InverseViewer = InverseRoot(SquaredLength(place.ToViewer));
    place.NormalViewer = DotProduct(triangle.Normals, place.ToViewer) *
      (place.InverseNormal * place.InverseViewer);
  }
  Rgb total[2];
  double greatest = 0.0;
  for (const DisplayLight& light : lights)
  {
    if (!light.Enabled || (IsBlack(light.Ambient) && IsBlack(light.Diffuse) && IsBlack(light.Specular)))
    {
      continue;
    }
    if (light.Web || light.Sky || !light.Polygon.empty())
    {
      return Infinite;
    }
    const bool highlight = anyHighlight && !IsBlack(light.Specular);
    const Incidence in = IncidenceOf(model, light, place, highlight);
    for (int side = 0; side < count; ++side)
    {
      const DisplayMaterial& material = *sides[side];
      const Parts parts = PartsOf(model, in, side, highlight, material.Shininess);
      total[side] += Times(parts.Ambient, Magnitude(material.Ambient * light.Ambient));
      total[side] += Times(parts.Diffuse, Magnitude(material.Diffuse * light.Diffuse));
      total[side] += Times(parts.Specular, Magnitude(material.Specular * light.Specular));
      if (std::isnan(total[side].r + total[side].g + total[side].b))
      {
        return Infinite;
      }
      greatest = std::max({ greatest, total[side].r, total[side].g, total[side].b });
    }
    if (greatest > enough)
    {
      break;
    }
  }
  return greatest;
}

void MarkGouraud(const ShadedScene& scene, const ShadedMesh& mesh, std::size_t begin,
  std::size_t end, double tolerance, std::vector<float>& flags)
{
  tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 16),
    [&](const tbb::blocked_range<std::size_t>& range) {
      for (std::size_t t = range.begin(); t < range.end(); ++t)
      {
        ShadedTriangle triangle;
        for (std::size_t k = 0; k < 3; ++k)
        {
          const unsigned int point = mesh.Corners[3 * t + k];
          triangle.Points[k] = mesh.Points[point];
          triangle.Normals[k] = mesh.Normals[point];
        }
        const double bound = ShadingBound(scene.Model, scene.Lights, scene.Front, scene.Back,
          scene.Eye, scene.Viewer, triangle, tolerance);
        flags[t] = bound <= tolerance ? 1.0f : 0.0f;
      }
    });
}

} // namespace radiometry
