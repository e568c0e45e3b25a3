// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/effects/LightBounds.h"

#include "radiometry/geometry/SolidAngle.h"
#include "radiometry/scene/Parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr std::size_t ChunkSize = 64;
constexpr double ManyPairs = 3e5;

/// Distance from a point to the segment from a to b.
double ToSegment(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const Vec3 ab = b - a;
  const double length = LengthSquared(ab);
  const double at = length > 0.0 ? std::clamp(Dot(p - a, ab) / length, 0.0, 1.0) : 0.0;
  return Length(p - (a + at * ab));
}

/// Distance from a point to a triangle of unit normal n: to its plane where its foot lies inside, else
/// to its rim.
double ToTriangle(const Vec3& p, const Triangle3& t, const Vec3& n)
{
  bool inside = true;
  double rim = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
  {
    const Vec3& a = t[k];
    const Vec3& b = t[(k + 1) % 3];
    inside = inside && Dot(Cross(b - a, p - a), n) >= 0.0;
    rim = std::min(rim, ToSegment(p, a, b));
  }
  return inside ? std::min(rim, std::fabs(Dot(n, p - t[0]))) : rim;
}

/// A light as a receiver is asked about.
struct Source
{
  const Light* From = nullptr;
  double Intensity = 0.0;
  Vec3 Center;         // area: of a sphere about the panel
  double Radius = 0.0;
  double Area = 0.0;
  Vec3 Normal;
};

double Falloff(const Light& light, double r)
{
  const double* k = light.Attenuation;
  return 1.0 / (k[0] + r * (k[1] + r * k[2]));
}

/// Bounds of a spot's shape between two angles from its axis: [least, most] of cos^e within the cone.
struct ShapeRange
{
  double Least = 1.0;
  double Most = 1.0;
};
ShapeRange ShapeBetween(const Light& light, double nearest, double farthest)
{
  if (light.Type != LightType::Spot || (light.CosCutoff <= -1.0 && light.Exponent <= 0.0))
  {
    return {};
  }
  // Rounding of an angle, and of the cone's own.
  constexpr double slack = 1e-7;
  const auto at = [&](double angle, bool most) {
    const double cutoff = light.VersineCutoff >= 0.0
      ? 2.0 * std::asin(std::sqrt(std::min(1.0, 0.5 * light.VersineCutoff)))
      : std::acos(std::clamp(light.CosCutoff, -1.0, 1.0));
    if (most ? angle > cutoff + slack : angle >= cutoff - slack || light.SmoothEdge)
    {
      return 0.0;
    }
    const double cosine = std::max(0.0, std::cos(angle));
    return light.Exponent > 0.0 ? std::pow(cosine, light.Exponent) : 1.0;
  };
  return { at(std::min(Pi, farthest + slack), false), at(std::max(0.0, nearest - slack), true) };
}

/// Of a receiver, side by side of one light: what it gives, and what leaving an effect out changes.
struct PairReach
{
  PairBound Light;
  double SpotShape[2] = {}; // of Average and Peak
  double Attenuation[2] = {};
  double CandelaWebs[2] = {};
  double Least = 0.0; // of the average, for unit intensity
};

/// A receiver: a triangle, or a point with its normal.
struct Receiver
{
  Triangle3 Corners;
  Vec3 Normal;
  double Area = 0.0; // 0: a point
  Vec3 Center;
  double Radius = 0.0;
  bool Front = true; // gets light on that side
  bool Back = false;
  bool Wanted = true; // its value is
};

Receiver MakeReceiver(const Triangle3& t)
{
  Receiver r;
  r.Corners = t;
  const Vec3 n = AreaNormal2(t);
  r.Normal = Normalized(n);
  r.Area = 0.5 * Length(n);
  r.Center = Centroid(t);
  for (const Vec3& p : t)
  {
    r.Radius = std::max(r.Radius, Length(p - r.Center));
  }
  return r;
}

PairReach Directional(const Light& light, double intensity, const Receiver& r)
{
  PairReach out;
  out.Light.Height = -Dot(r.Normal, light.Direction);
  out.Light.Average = out.Light.Peak = intensity * std::fabs(out.Light.Height);
  out.Light.Strength = intensity;
  out.Least = std::fabs(out.Light.Height);
  return out;
}

PairReach PointLike(
  const Light& light, double intensity, const Receiver& r, const LightVariants& variants)
{
  PairReach out;
  const Vec3& p = light.Position;
  const double height = Dot(r.Normal, p - r.Corners[0]);
  out.Light.Height = height;
  const double h = std::fabs(height);
  if (!(h > 0.0))
  {
    return out;
  }
  const double least = std::max(h, r.Area > 0.0 ? ToTriangle(p, r.Corners, r.Normal)
                                                : Length(p - r.Corners[0]));
  double most = least;
  for (const Vec3& c : r.Corners)
  {
    most = std::max(most, Length(p - c));
  }
  // Angles from the axis: those of a sphere about the receiver.
  const Vec3 way = r.Center - p;
  const double distance = Length(way);
  const double middle =
    std::atan2(Length(Cross(light.Direction, way)), Dot(light.Direction, way));
  const double half =
    distance > r.Radius ? std::asin(std::min(1.0, r.Radius / distance)) : Pi;
  const ShapeRange shape =
    ShapeBetween(light, std::max(0.0, middle - half), std::min(Pi, middle + half));
  const double s = variants.SpotShape ? 1.0 : shape.Most;

  const double omega = r.Area > 0.0
    ? std::fabs(SolidAngle(r.Corners.data(), 3, p)) / r.Area // of the average, times 1/r^2
    : h / (least * least * least);
  const double square = h / (least * least * least); // greatest cos/r^2
  const bool legacy = !light.InverseSquare();
  const double falloff = legacy ? Falloff(light, least) : 0.0;
  // k r^2 is 1, or grows with r.
  const double low = legacy ? falloff * least * least : 1.0;
  const double high = legacy ? Falloff(light, most) * most * most : 1.0;
  const double peak = legacy ? h / least * falloff : square;
  const double average = legacy ? std::min(peak, omega * high) : omega;
  // The light in all variants that may be run.
  const bool also = legacy && variants.Attenuation;
  const double anyPeak = also ? std::max(peak, square) : peak;
  const double anyAverage = also ? std::max(average, omega) : average;
  out.Light.Peak = intensity * s * anyPeak;
  out.Light.Average = std::min(intensity * s * anyAverage, out.Light.Peak);
  out.Light.Strength = h > 0.0 ? out.Light.Peak * (least / h) : 0.0;
  out.Least = light.Web ? 0.0 : shape.Least * omega * std::min(1.0, low);
  const auto change = [&](double factor, double* to) {
    to[1] = intensity * factor * anyPeak;
    to[0] = std::min(intensity * factor * anyAverage, to[1]);
  };
  if (light.Type == LightType::Spot)
  {
    change(1.0 - shape.Least, out.SpotShape);
  }
  if (light.Type == LightType::Point && light.Web)
  {
    change(1.0, out.CandelaWebs);
  }
  if (legacy)
  {
    const double off = std::max(std::fabs(low - 1.0), std::fabs(high - 1.0));
    const double full = variants.SpotShape ? 1.0 : shape.Most;
    out.Attenuation[0] = intensity * full * omega * off;
    out.Attenuation[1] = intensity * full * square * off;
  }
  return out;
}

/// What a panel gives on the side where it stands, and may give on the other where it reaches over.
void AddPanel(const Source& source, const Receiver& r, double average[2], double peak[2])
{
  const double distance = Length(source.Center - r.Center);
  const double gap = std::max(0.0, distance - source.Radius - r.Radius);
  const Light& light = *source.From;
  // Where all of the receiver lies behind a panel of one side, or in its plane, it gets nothing.
  const double before = Dot(source.Normal, r.Center - source.Center);
  if (!light.TwoSided && before + r.Radius <= 0.0)
  {
    return;
  }
  double factor = std::min(1.0, gap > 0.0 ? source.Area / (Pi * gap * gap) : 1.0);
  const double height = Dot(r.Normal, source.Center - r.Corners[0]);
  const double any = source.Intensity * factor;
  factor = r.Area > 0.0 ? std::min(factor, source.Area / r.Area) : factor;
  for (int side = 0; side < 2; ++side)
  {
    if ((side == 0 ? height : -height) + source.Radius > 0.0)
    {
      average[side] += source.Intensity * factor;
      peak[side] += any;
    }
  }
}

/// Sums over lights for one receiver, both sides.
struct Sums
{
  double Average[2][5] = {};
  double Peak[2][5] = {};
  double SpotShape[2][2] = {}; // side; average, peak
  double Attenuation[2][2] = {};
  double CandelaWebs[2][2] = {};
};

void AddSource(const Source& source, const Receiver& r, const LightVariants& variants, Sums& sums)
{
  const Light& light = *source.From;
  const auto kind = static_cast<std::size_t>(light.Type);
  if (light.Type == LightType::Area)
  {
    double average[2] = {}, peak[2] = {};
    AddPanel(source, r, average, peak);
    for (int side = 0; side < 2; ++side)
    {
      sums.Average[side][kind] += average[side];
      sums.Peak[side][kind] += peak[side];
    }
    return;
  }
  const PairReach pair = light.Type == LightType::Directional
    ? Directional(light, source.Intensity, r)
    : PointLike(light, source.Intensity, r, variants);
  const int side = pair.Light.Height > 0.0 ? 0 : 1;
  sums.Average[side][kind] += pair.Light.Average;
  sums.Peak[side][kind] += pair.Light.Peak;
  for (int k = 0; k < 2; ++k)
  {
    sums.SpotShape[side][k] += pair.SpotShape[k];
    sums.Attenuation[side][k] += pair.Attenuation[k];
    sums.CandelaWebs[side][k] += pair.CandelaWebs[k];
  }
}

void Widen(LightReach& to, double value, double peak, double flux)
{
  to.Value = std::max(to.Value, value);
  to.Peak = std::max(to.Peak, peak);
  to.Flux += flux;
}

/// What one side of a receiver gets.
struct Place
{
  std::uint32_t Receiver = 0;
  int Side = 0;
  double Peak = 0.0;
  double Flux = 0.0;
};

/// Puts the sums of a receiver into the bounds, and its sides into `places`.
void Count(const Receiver& r, std::uint32_t number, const Sums& sums, LightBounds& out,
  std::vector<Place>& places)
{
  for (int side = 0; side < 2; ++side)
  {
    if (!(side == 0 ? r.Front : r.Back))
    {
      continue;
    }
    const double wanted = r.Wanted ? 1.0 : 0.0;
    double average = 0.0, peak = 0.0;
    for (std::size_t k = 0; k < out.Kinds.size(); ++k)
    {
      average += sums.Average[side][k];
      peak += sums.Peak[side][k];
      Widen(out.Kinds[k], wanted * sums.Average[side][k], sums.Peak[side][k],
        sums.Average[side][k] * r.Area);
    }
    Widen(out.All, wanted * average, peak, average * r.Area);
    if (r.Area > 0.0 && peak > 0.0)
    {
      places.push_back({ number, side, peak, average * r.Area });
    }
    if (side == 1)
    {
      Widen(out.Backs, wanted * average, peak, average * r.Area);
    }
    const auto change = [&](LightReach& to, const double* of) {
      Widen(to, wanted * of[0], of[1], of[0] * r.Area);
    };
    change(out.SpotShape, sums.SpotShape[side]);
    change(out.Attenuation, sums.Attenuation[side]);
    change(out.CandelaWebs, sums.CandelaWebs[side]);
  }
}

void Join(LightBounds& to, const LightBounds& from)
{
  const auto join = [](LightReach& a, const LightReach& b) { Widen(a, b.Value, b.Peak, b.Flux); };
  for (std::size_t k = 0; k < to.Kinds.size(); ++k)
  {
    join(to.Kinds[k], from.Kinds[k]);
  }
  join(to.All, from.All);
  join(to.Backs, from.Backs);
  join(to.SpotShape, from.SpotShape);
  join(to.Attenuation, from.Attenuation);
  join(to.CandelaWebs, from.CandelaWebs);
}

std::vector<Receiver> MakeReceivers(
  const Scene& scene, const std::vector<SurfacePoint>& points, bool cells, bool backs)
{
  std::vector<Receiver> receivers;
  receivers.reserve(scene.ReceiverTriangles + points.size());
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    Receiver r = MakeReceiver(scene.TriangleAt(t));
    const auto cell = static_cast<std::size_t>(scene.TriangleCell[t]);
    r.Back = cell < scene.Optics.TwoSided.size() && scene.Optics.TwoSided[cell] != 0;
    for (std::size_t b = 0; b < bands && !scene.Optics.DiffuseTransmittance.empty(); ++b)
    {
      r.Back = r.Back || scene.Optics.DiffuseTransmittance[cell * bands + b] > 0.0;
    }
    r.Wanted = cells;
    if (r.Area > 0.0)
    {
      receivers.push_back(r);
    }
  }
  for (const SurfacePoint& p : points)
  {
    Receiver r;
    r.Corners = { p.Point, p.Point, p.Point };
    r.Center = p.Point;
    r.Normal = p.Normal;
    r.Back = backs;
    receivers.push_back(r);
  }
  return receivers;
}

std::vector<Source> MakeSources(const Scene& scene)
{
  std::vector<Source> sources;
  for (const Light& light : scene.Lights)
  {
    const double intensity = Brightest(light);
    if (!light.Enabled || light.Type == LightType::Environment || !(intensity > 0.0))
    {
      continue;
    }
    Source s;
    s.From = &light;
    s.Intensity = intensity;
    if (light.Type == LightType::Area && light.Polygon.size() >= 3)
    {
      Vec3 normal;
      for (const Vec3& p : light.Polygon)
      {
        s.Center += p / static_cast<double>(light.Polygon.size());
      }
      for (std::size_t k = 2; k < light.Polygon.size(); ++k)
      {
        normal += Cross(
          light.Polygon[k - 1] - light.Polygon[0], light.Polygon[k] - light.Polygon[0]);
      }
      s.Normal = Normalized(normal);
      s.Area = 0.5 * Length(normal);
      for (const Vec3& p : light.Polygon)
      {
        s.Radius = std::max(s.Radius, Length(p - s.Center));
      }
    }
    sources.push_back(s);
  }
  return sources;
}

/// The brightest sides of triangles, as many as cost little to ask every receiver about.
void FindSpots(const std::vector<Receiver>& receivers,
  const std::vector<std::vector<Place>>& places, LightBounds& out)
{
  std::vector<Place> all;
  for (const std::vector<Place>& part : places)
  {
    all.insert(all.end(), part.begin(), part.end());
  }
  const std::size_t most = std::clamp<std::size_t>(
    static_cast<std::size_t>(1e6 / static_cast<double>(receivers.size() + 1)), 4, 64);
  const std::size_t count = std::min(most, all.size());
  const auto brighter = [](const Place& a, const Place& b) {
    return a.Peak != b.Peak
      ? a.Peak > b.Peak
      : (a.Receiver != b.Receiver ? a.Receiver < b.Receiver : a.Side < b.Side);
  };
  std::partial_sort(
    all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end(), brighter);
  constexpr double rounding = 1.0 + 1e-9;
  for (std::size_t k = 0; k < count; ++k)
  {
    BrightSpot spot{ receivers[all[k].Receiver].Corners, rounding * all[k].Peak,
      rounding * all[k].Flux };
    if (all[k].Side == 1)
    {
      std::swap(spot.Corners[1], spot.Corners[2]);
    }
    out.Spots.push_back(spot);
  }
  for (std::size_t k = count; k < all.size(); ++k)
  {
    out.PeakBeyond = std::max(out.PeakBeyond, rounding * all[k].Peak);
  }
}

/// The greatest height of corners above a plane.
double Highest(const Triangle3& corners, const Vec3& normal, const Vec3& on)
{
  return std::max({ Dot(normal, corners[0] - on), Dot(normal, corners[1] - on),
    Dot(normal, corners[2] - on) });
}

/// A sphere about the receivers [begin, end).
Receiver Together(const std::vector<Receiver>& all, std::size_t begin, std::size_t end)
{
  Receiver r;
  for (std::size_t k = begin; k < end; ++k)
  {
    r.Center += all[k].Center / static_cast<double>(end - begin);
  }
  for (std::size_t k = begin; k < end; ++k)
  {
    r.Radius = std::max(r.Radius, Length(all[k].Center - r.Center) + all[k].Radius);
  }
  return r;
}

/// A light far from all of a sphere: the same bound on both sides of all in it. False: it is too near.
bool AddFar(const Source& source, const Receiver& sphere, const LightVariants& variants, Sums& sums)
{
  const Light& light = *source.From;
  const auto kind = static_cast<std::size_t>(light.Type);
  double strength = source.Intensity;
  double attenuation = 0.0;
  if (light.Type == LightType::Area)
  {
    const double gap = Length(source.Center - sphere.Center) - source.Radius - sphere.Radius;
    if (!(gap > 3.0 * sphere.Radius))
    {
      return false;
    }
    strength *= std::min(1.0, source.Area / (Pi * gap * gap));
  }
  else if (light.Type != LightType::Directional)
  {
    const double gap = Length(light.Position - sphere.Center) - sphere.Radius;
    if (!(gap > 3.0 * sphere.Radius))
    {
      return false;
    }
    double k = 1.0 / (gap * gap);
    if (!light.InverseSquare())
    {
      const double most = gap + 2.0 * sphere.Radius;
      const double off = std::max(std::fabs(Falloff(light, gap) * gap * gap - 1.0),
        std::fabs(Falloff(light, most) * most * most - 1.0));
      attenuation = source.Intensity * k * off;
      k = variants.Attenuation ? std::max(k, Falloff(light, gap)) : Falloff(light, gap);
    }
    strength *= k;
  }
  for (int side = 0; side < 2; ++side)
  {
    sums.Average[side][kind] += strength;
    sums.Peak[side][kind] += strength;
    for (int k = 0; k < 2; ++k)
    {
      sums.SpotShape[side][k] += light.Type == LightType::Spot ? strength : 0.0;
      sums.CandelaWebs[side][k] +=
        light.Type == LightType::Point && light.Web ? strength : 0.0;
      sums.Attenuation[side][k] += attenuation;
    }
  }
  return true;
}

} // namespace

FirstReflection BoundFirstReflection(const Scene& scene, const std::vector<SurfacePoint>& points,
  bool cells, const LightBounds& bounds, bool diffused)
{
  FirstReflection out;
  double extent = 0.0;
  for (const Vec3& p : scene.Points)
  {
    extent = std::max({ extent, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z) });
  }
  const double rounding = 1e-12 * extent;
  const auto bound = [&](const Receiver& r) {
    double any = bounds.PeakBeyond, average = bounds.PeakBeyond;
    for (const BrightSpot& spot : bounds.Spots)
    {
      const Receiver s = MakeReceiver(spot.Corners);
      // Nothing goes backward, along a plane, or onto a side that does not receive.
      const bool behind = !diffused &&
        Highest(r.Corners, s.Normal, s.Corners[0]) <= rounding;
      const bool beneath = r.Area > 0.0 && !r.Back &&
        Highest(s.Corners, r.Normal, r.Corners[0]) <= rounding;
      if (behind || beneath)
      {
        continue;
      }
      const double gap = Length(s.Center - r.Center) - s.Radius - r.Radius;
      const double here =
        gap > 0.0 ? std::min(spot.Peak, spot.Flux / (Pi * gap * gap)) : spot.Peak;
      any += here;
      average += r.Area > 0.0 ? std::min(here, spot.Flux / r.Area) : here;
    }
    out.Value = std::max(out.Value, r.Wanted ? average : 0.0);
    out.Peak = std::max(out.Peak, any);
  };
  for (const Receiver& r : MakeReceivers(scene, points, cells, true))
  {
    bound(r);
  }
  return out;
}

double Brightest(const Light& light)
{
  return light.Intensity.empty()
    ? 0.0
    : *std::max_element(light.Intensity.begin(), light.Intensity.end());
}

PairBound BoundPair(const Light& light, const Triangle3& triangle, const LightVariants& variants)
{
  const Receiver r = MakeReceiver(triangle);
  return (light.Type == LightType::Directional ? Directional(light, Brightest(light), r)
                                               : PointLike(light, Brightest(light), r, variants))
    .Light;
}

double LeastLight(const Scene& scene, const std::vector<SurfacePoint>& points, bool cells)
{
  const std::vector<Receiver> receivers = MakeReceivers(scene, points, cells, false);
  const std::vector<Source> sources = MakeSources(scene);
  if (static_cast<double>(receivers.size()) * static_cast<double>(sources.size()) > ManyPairs)
  {
    return 0.0;
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Receiver& r : receivers)
  {
    double sum = 0.0;
    for (const Source& s : sources)
    {
      const Light& light = *s.From;
      if (r.Wanted && light.Type != LightType::Area)
      {
        const PairReach pair = light.Type == LightType::Directional
          ? Directional(light, s.Intensity, r)
          : PointLike(light, s.Intensity, r, {});
        const double weakest = *std::min_element(light.Intensity.begin(), light.Intensity.end());
        sum += pair.Light.Height > 0.0 ? weakest * pair.Least : 0.0;
      }
    }
    least = r.Wanted ? std::min(least, sum) : least;
  }
  return std::isfinite(least) ? (1.0 - 1e-9) * least : 0.0;
}

LightBounds BoundLights(const Scene& scene, const std::vector<SurfacePoint>& points, bool cells,
  bool backs, const LightVariants& variants)
{
  const std::vector<Receiver> receivers = MakeReceivers(scene, points, cells, backs);
  const std::vector<Source> sources = MakeSources(scene);
  const bool many =
    static_cast<double>(receivers.size()) * static_cast<double>(sources.size()) > ManyPairs;
  const std::size_t chunks = (receivers.size() + ChunkSize - 1) / ChunkSize;
  std::vector<LightBounds> parts(chunks);
  std::vector<std::vector<Place>> places(chunks);
  ParallelFor(
    sources.empty() ? 0 : chunks, 0, {},
    [&](std::size_t c) {
      const std::size_t begin = c * ChunkSize;
      const std::size_t end = std::min(begin + ChunkSize, receivers.size());
      Sums far;
      std::vector<std::uint32_t> near;
      const Receiver sphere = Together(receivers, begin, end);
      for (std::size_t s = 0; s < sources.size(); ++s)
      {
        if (!many || !AddFar(sources[s], sphere, variants, far))
        {
          near.push_back(static_cast<std::uint32_t>(s));
        }
      }
      for (std::size_t k = begin; k < end; ++k)
      {
        Sums sums = far;
        for (const std::uint32_t s : near)
        {
          AddSource(sources[s], receivers[k], variants, sums);
        }
        Count(receivers[k], static_cast<std::uint32_t>(k), sums, parts[c], places[c]);
      }
    },
    1e-7 * static_cast<double>(sources.size() * (many ? 4 : ChunkSize)));
  LightBounds out;
  for (const LightBounds& part : parts)
  {
    Join(out, part);
  }
  FindSpots(receivers, places, out);
  double area = 0.0;
  bool front = false, back = false, wanted = false;
  for (const Receiver& r : receivers)
  {
    area += r.Area * ((r.Front ? 1.0 : 0.0) + (r.Back ? 1.0 : 0.0));
    front = front || r.Front;
    back = back || r.Back;
    wanted = wanted || r.Wanted;
  }
  double sky = 0.0;
  for (const Light& light : scene.Lights)
  {
    if (light.Enabled && light.Type == LightType::Environment)
    {
      const SkyBound bound = BoundSky(light);
      sky += bound.Irradiance;
      out.SkyRadiance += Pi * bound.Radiance;
    }
  }
  // Of values that are computed another way, and rounded.
  constexpr double rounding = 1.0 + 1e-9;
  for (LightReach* reach : { &out.Kinds[0], &out.Kinds[1], &out.Kinds[2], &out.Kinds[3], &out.All,
         &out.Backs, &out.SpotShape, &out.Attenuation, &out.CandelaWebs })
  {
    *reach = { rounding * reach->Value, rounding * reach->Peak, rounding * reach->Flux };
  }
  if (front && sky > 0.0)
  {
    const LightReach reach{ wanted ? sky : 0.0, sky, sky * area };
    out.Kinds[static_cast<std::size_t>(LightType::Environment)] = reach;
    out.PeakBeyond += reach.Peak;
    out.All = { out.All.Value + reach.Value, out.All.Peak + reach.Peak, out.All.Flux + reach.Flux };
    if (back)
    {
      out.Backs = { out.Backs.Value + reach.Value, out.Backs.Peak + reach.Peak, out.Backs.Flux };
    }
  }
  return out;
}

} // namespace radiometry
