// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/Highlights.h"

#include "radiometry/geometry/Quadrature.h"
#include "radiometry/scene/Reflectance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace radiometry
{
namespace
{

constexpr std::size_t MostParts = 400;
constexpr int MostHalvings = 80; // some ten parts each two
/// A part is no larger than so many widths of the lobe, or distances from its middle.
constexpr double PartWidths = 2.0;
constexpr double PartDistances = 1.0;
/// Of parts that a shadow's edge cuts (V even between 0 and 1) four rays agree on two in five, and are
/// then wrong by 0.048 in the mean square: twice the root of that, for each part whose rays do not agree.
constexpr double Unnoticed = 4.0 * 0.048 * 2.0 / 3.0;

struct Part
{
  Triangle3 Corners;
  double Integral = 0.0; // of f E/rho_s, nothing in the way
  double RuleError = 0.0;
  std::vector<double> Seen; // share of the light that arrives, per band; empty: all
  double Doubt = 0.0;       // of the share
  int Depth = 0;

  double Error() const { return this->RuleError + this->Doubt * this->Integral; }
  bool operator<(const Part& other) const { return this->Error() < other.Error(); }
};

/// The highlight of one light on one triangle.
class OneHighlight
{
public:
  OneHighlight(const RadianceTracer& tracer, const RadianceTracer::Beam& beam, const Viewer& viewer,
    const RadianceTracer::Place& place, double exponent, std::size_t bands)
    : Source(*beam.Flux)
    , Shadow(*beam.Shadow)
    , Eye(viewer)
    , At(place)
    , Exponent(exponent)
    , Bands(bands)
  {
    const double known = place.Known ? place.Known[beam.Index] : 0.5;
    this->Shadows = tracer.Follows().Occlusion && known < 1.0;
    this->Dark = tracer.Follows().Occlusion && known <= 0.0;
  }

  bool Dark = false;
  std::int64_t Rays = 0;

  /// f E/rho_s at a place.
  double Value(const Vec3& p) const
  {
    const Light& light = this->Source.GetLight();
    const Vec3 in =
      this->Source.Directional() ? -light.Direction : Normalized(light.Position - p);
    const double f =
      PhongLobeBrdf(1.0, this->Exponent, this->At.Normal, in, this->Eye.Toward(p));
    return f > 0.0 ? f * this->Source.AtPoint(p, this->At.Normal) : 0.0;
  }

  void Look(Part& part)
  {
    const auto rule = [&](int degree) {
      double sum = 0.0;
      for (const auto& node : TriangleRuleOfDegree(degree).Nodes)
      {
        sum += node.Weight *
          this->Value((1.0 - node.B1 - node.B2) * part.Corners[0] + node.B1 * part.Corners[1] +
            node.B2 * part.Corners[2]);
      }
      return sum * Area(part.Corners);
    };
    part.Integral = rule(8);
    part.RuleError = std::fabs(part.Integral - rule(5));
  }

  /// Four rays from a part that counts.
  void Ask(Part& part)
  {
    if (!this->Shadows || !(part.Integral > 0.0))
    {
      return;
    }
    static constexpr double spots[4][2] = { { 1.0 / 3, 1.0 / 3 }, { 1.0 / 6, 1.0 / 6 },
      { 2.0 / 3, 1.0 / 6 }, { 1.0 / 6, 2.0 / 3 } };
    part.Seen.assign(this->Bands, 0.0);
    double least = 1.0, most = 0.0;
    std::vector<double> shares(this->Bands);
    for (const auto& spot : spots)
    {
      const Vec3 p = (1.0 - spot[0] - spot[1]) * part.Corners[0] + spot[0] * part.Corners[1] +
        spot[1] * part.Corners[2];
      const RayEnd end{ p, this->At.End.Triangle };
      ++this->Rays;
      if (this->Shadow.Transmits())
      {
        this->Shadow.Passing(end, shares.data());
      }
      else
      {
        std::fill(shares.begin(), shares.end(), this->Shadow.Hidden(end) ? 0.0 : 1.0);
      }
      for (std::size_t b = 0; b < this->Bands; ++b)
      {
        part.Seen[b] += 0.25 * shares[b];
        least = std::min(least, shares[b]);
        most = std::max(most, shares[b]);
      }
    }
    // Panes tint: bands differ, and still nothing is in doubt where all four rays agree.
    part.Doubt = this->Shadow.Transmits()
      ? (most > least && !this->Alike(part, shares) ? 0.5 * (most - least) : 0.0)
      : 0.5 * (most - least);
  }

  /// Where the light is mirrored into the eye, and how wide the lobe is there; false: everywhere alike.
  bool FindPeak(const Triangle3& corners, Vec3& peak, double& width) const
  {
    const Vec3& n = this->At.Normal;
    const Light& light = this->Source.GetLight();
    const auto height = [&](const Vec3& p) { return Dot(n, p - corners[0]); };
    const double spread = std::sqrt(2.0 / (this->Exponent + 2.0));
    const auto along = [&](const Vec3& from, const Vec3& way) {
      // From a place above the plane against a direction that leaves it.
      const double rise = std::max(1e-9, Dot(n, way));
      peak = from - (height(from) / rise) * way;
      width = spread * height(from) / rise;
    };
    if (this->Source.Directional() && this->Eye.Parallel)
    {
      return false;
    }
    if (this->Source.Directional())
    {
      along(this->Eye.Eye, light.Direction - 2.0 * Dot(n, light.Direction) * n);
      return true;
    }
    if (this->Eye.Parallel)
    {
      const Vec3 out = -this->Eye.Direction;
      along(light.Position, 2.0 * Dot(n, out) * n - out);
      return true;
    }
    const double h = height(this->Eye.Eye), l = height(light.Position);
    if (!(h + l > 0.0))
    {
      return false;
    }
    peak = this->Eye.Eye + (h / (h + l)) * (light.Position - 2.0 * l * n - this->Eye.Eye);
    const double a = Length(this->Eye.Eye - peak), b = Length(light.Position - peak);
    width = a + b > 0.0 ? spread * a * b / (a + b) : 0.0;
    return true;
  }

private:
  bool Alike(const Part& part, const std::vector<double>& last) const
  {
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      if (std::fabs(part.Seen[b] - last[b]) > 1e-12)
      {
        return false;
      }
    }
    return true;
  }

  const SourceFlux& Source;
  const ShadowCutter& Shadow;
  const Viewer& Eye;
  const RadianceTracer::Place& At;
  double Exponent;
  std::size_t Bands;
  bool Shadows = false;
};

double LongestEdge(const Triangle3& t, std::size_t& edge)
{
  double longest = -1.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double l = Length(t[(k + 1) % 3] - t[k]);
    if (l > longest)
    {
      longest = l;
      edge = k;
    }
  }
  return longest;
}

void HalveTriangle(const Triangle3& t, Triangle3 halves[2])
{
  std::size_t k = 0;
  LongestEdge(t, k);
  const Vec3& a = t[k];
  const Vec3& b = t[(k + 1) % 3];
  const Vec3& c = t[(k + 2) % 3];
  const Vec3 middle = 0.5 * (a + b);
  halves[0] = { a, middle, c };
  halves[1] = { middle, b, c };
}

/// Of a point in its plane from a triangle.
double Distance(const Triangle3& t, const Vec3& p)
{
  const Vec3 n = AreaNormal2(t);
  bool inside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Vec3 edge = t[(k + 1) % 3] - t[k];
    const Vec3 way = p - t[k];
    inside = inside && Dot(n, Cross(edge, way)) >= 0.0;
    const double l2 = LengthSquared(edge);
    const double at = l2 > 0.0 ? std::clamp(Dot(way, edge) / l2, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, Length(way - at * edge));
  }
  return inside ? 0.0 : nearest;
}

/// Divides until parts are as small as the highlight is there.
void Divide(const Triangle3& corners, bool peaked, const Vec3& peak, double width, int depth,
  std::vector<Part>& parts)
{
  std::size_t edge;
  const double size = LongestEdge(corners, edge);
  if (!peaked || depth >= MostHalvings ||
    size <= std::max(PartWidths * width, PartDistances * Distance(corners, peak)))
  {
    Part part;
    part.Corners = corners;
    part.Depth = depth;
    parts.push_back(part);
    return;
  }
  Triangle3 halves[2];
  HalveTriangle(corners, halves);
  Divide(halves[0], peaked, peak, width, depth + 1, parts);
  Divide(halves[1], peaked, peak, width, depth + 1, parts);
}

struct HighlightSum
{
  std::vector<double> Values; // per band, over rho_s I
  double RuleError = 0.0;
  double ShadowSquares = 0.0;
};

void Collect(const std::vector<Part>& parts, std::size_t bands, HighlightSum& sum)
{
  sum.Values.assign(bands, 0.0);
  sum.RuleError = sum.ShadowSquares = 0.0;
  double cut = 0.0, all = 0.0, agreed = 0.0;
  for (const Part& part : parts)
  {
    for (std::size_t b = 0; b < bands; ++b)
    {
      sum.Values[b] += part.Integral * (part.Seen.empty() ? 1.0 : part.Seen[b]);
    }
    sum.RuleError += part.RuleError;
    sum.ShadowSquares += part.Doubt * part.Integral * part.Doubt * part.Integral;
    all += part.Integral;
    cut += part.Doubt > 0.0 ? part.Integral : 0.0;
    agreed += part.Doubt > 0.0 || part.Seen.empty() ? 0.0 : part.Integral * part.Integral;
  }
  // Where edges are seen in some parts, there are some in others that no ray noticed.
  sum.ShadowSquares += all > 0.0 ? Unnoticed * cut / all * agreed : 0.0;
}

} // namespace

std::int64_t AddHighlights(const RadianceTracer& tracer, const Viewer& viewer,
  const Triangle3& corners, const RadianceTracer::Place& place, double share,
  const HighlightEffort& effort, double* values, double* errors)
{
  const double exponent = tracer.Exponent(place.Cell, place.Front);
  const std::size_t bands = effort.Allowed.size();
  std::vector<double> rho(bands);
  bool any = false;
  for (std::size_t b = 0; b < bands; ++b)
  {
    rho[b] = tracer.Reflectance(place.Cell, place.Front, b);
    any = any || rho[b] > 0.0;
  }
  if (!any || exponent >= MirrorShininess)
  {
    return 0;
  }
  std::int64_t rays = 0;
  const double area = Area(corners);
  for (const RadianceTracer::Beam& beam : tracer.AllBeams())
  {
    OneHighlight light(tracer, beam, viewer, place, exponent, bands);
    if (light.Dark)
    {
      continue;
    }
    const std::vector<double>& intensity = beam.Flux->GetLight().Intensity;
    std::vector<Part> parts;
    const bool point = !(area > 0.0);
    if (point)
    {
      Part part;
      part.Corners = corners;
      part.Integral = light.Value(corners[0]);
      light.Ask(part);
      parts.push_back(part);
    }
    else
    {
      Vec3 peak;
      double width = 0.0;
      const bool peaked = light.FindPeak(corners, peak, width);
      Divide(corners, peaked, peak, width, 0, parts);
      for (Part& part : parts)
      {
        light.Look(part);
      }
      // What is small beside all that is allowed is not asked about: it counts as half lit.
      double most = std::numeric_limits<double>::infinity(); // of the integral
      for (std::size_t b = 0; b < bands; ++b)
      {
        const double scale = rho[b] * intensity[b] * share / area;
        most = scale > 0.0 ? std::min(most, effort.Allowed[b] / scale) : most;
      }
      double open = 0.0;
      for (const Part& part : parts)
      {
        open += part.Integral;
      }
      const auto enough = [&](double integral) {
        return std::max(most, effort.Relative * integral);
      };
      const double negligible = 0.2 * enough(open) / static_cast<double>(parts.size());
      for (Part& part : parts)
      {
        if (part.Integral > negligible)
        {
          light.Ask(part);
        }
        else if (part.Integral > 0.0)
        {
          part.Seen.assign(bands, 0.5);
          part.Doubt = 0.5;
        }
      }
      const std::size_t end = parts.size() + MostParts;
      std::make_heap(parts.begin(), parts.end());
      HighlightSum sum;
      for (;;)
      {
        Collect(parts, bands, sum);
        const double value = *std::max_element(sum.Values.begin(), sum.Values.end());
        if (sum.RuleError + std::sqrt(sum.ShadowSquares) <= enough(value) || parts.size() >= end)
        {
          break;
        }
        // The worst eighth at a time.
        const std::size_t count = std::max<std::size_t>(1, parts.size() / 8);
        std::vector<Part> fresh;
        for (std::size_t k = 0; k < count; ++k)
        {
          std::pop_heap(parts.begin(), parts.end());
          const Part worst = parts.back();
          parts.pop_back();
          Triangle3 halves[2];
          HalveTriangle(worst.Corners, halves);
          for (const Triangle3& half : halves)
          {
            Part part;
            part.Corners = half;
            part.Depth = worst.Depth + 1;
            light.Look(part);
            light.Ask(part);
            fresh.push_back(part);
          }
        }
        for (Part& part : fresh)
        {
          parts.push_back(std::move(part));
          std::push_heap(parts.begin(), parts.end());
        }
      }
    }
    HighlightSum sum;
    Collect(parts, bands, sum);
    rays += light.Rays;
    for (std::size_t b = 0; b < bands; ++b)
    {
      const double scale = rho[b] * intensity[b] * share / (point ? 1.0 : area);
      values[b] += scale * sum.Values[b];
      errors[b] += scale * (sum.RuleError + std::sqrt(sum.ShadowSquares));
    }
  }
  return rays;
}

} // namespace radiometry
