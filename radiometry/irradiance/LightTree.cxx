// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/LightTree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

/// Bounds are widened by so much: they must hold in spite of rounding.
constexpr double Room = 1e-9;

/// An angle in [0, pi] by its cosine and sine.
struct Angle
{
  double Cos;
  double Sin;
};

Angle FromCosine(double cosine)
{
  const double c = std::clamp(cosine, -1.0, 1.0);
  return { c, std::sqrt(std::max(0.0, 1.0 - c * c)) };
}

/// a - b, or zero where b is the greater.
Angle Less(const Angle& a, const Angle& b)
{
  if (a.Cos >= b.Cos)
  {
    return { 1.0, 0.0 };
  }
  return { a.Cos * b.Cos + a.Sin * b.Sin, a.Sin * b.Cos - a.Cos * b.Sin };
}

/// cos(a + b), or -1 beyond pi.
double CosOfSum(const Angle& a, const Angle& b)
{
  return a.Cos <= -b.Cos ? -1.0 : a.Cos * b.Cos - a.Sin * b.Sin;
}

/// The greatest dot product of a vector with the points of a box.
double MostAlong(const Vec3& n, const Vec3& lo, const Vec3& hi)
{
  return n.x * (n.x > 0 ? hi.x : lo.x) + n.y * (n.y > 0 ? hi.y : lo.y) +
    n.z * (n.z > 0 ? hi.z : lo.z);
}

} // namespace

LightTree::Reach LightTree::ReachOf(const SourceFlux& source)
{
  const Light& light = source.GetLight();
  Reach reach;
  reach.Directional = source.Directional();
  reach.Box.Add(light.Position);
  reach.Axis = light.Direction;
  const AxialDistribution& shape = source.GetDistribution();
  const bool web = light.Web && light.Type == LightType::Point; // at most its greatest value
  reach.CosCutoff = web ? -1.0 : std::max(-1.0, 1.0 - shape.VersineLimit() - Room);
  reach.Exponent = web ? 0.0 : shape.GetExponent();
  if (source.LegacyAttenuation())
  {
    std::copy(light.Attenuation, light.Attenuation + 3, reach.Attenuation);
  }
  return reach;
}

LightTree::Reach LightTree::Join(const Reach& a, const Reach& b)
{
  Reach r;
  r.Box = a.Box;
  r.Box.Add(b.Box);
  r.CosCutoff = std::min(a.CosCutoff, b.CosCutoff);
  r.Exponent = std::min(a.Exponent, b.Exponent);
  for (int k = 0; k < 3; ++k)
  {
    r.Attenuation[k] = std::min(a.Attenuation[k], b.Attenuation[k]);
  }
  const Vec3 sum = a.Axis + b.Axis;
  const double length = Length(sum);
  if (a.CosSpread <= -1.0 || b.CosSpread <= -1.0 || !(length > 1e-3))
  {
    r.CosSpread = -1.0;
    return r;
  }
  r.Axis = sum / length;
  for (const Reach* part : { &a, &b })
  {
    r.CosSpread = std::min(r.CosSpread,
      CosOfSum(FromCosine(Dot(r.Axis, part->Axis)), FromCosine(part->CosSpread)) - Room);
  }
  return r;
}

LightTree::LightTree(const std::vector<std::unique_ptr<SourceFlux>>& sources, int bands)
  : Bands(static_cast<std::size_t>(bands))
{
  std::vector<std::int32_t> items;
  std::vector<std::int32_t> directional;
  for (std::size_t k = 0; k < sources.size(); ++k)
  {
    (sources[k]->Directional() ? directional : items).push_back(static_cast<std::int32_t>(k));
  }
  const std::size_t nodes = items.empty() ? 0 : items.size() - 1;
  this->Inner.reserve(nodes);
  this->Reaches.resize(nodes + sources.size());
  this->Sums.resize(this->Reaches.size() * this->Bands);
  this->Strengths.resize(this->Reaches.size());
  this->Counts.resize(this->Reaches.size(), 1);
  for (std::size_t k = 0; k < sources.size(); ++k)
  {
    const std::size_t at = nodes + k;
    this->Reaches[at] = ReachOf(*sources[k]);
    const std::vector<double>& intensity = sources[k]->GetLight().Intensity;
    for (std::size_t b = 0; b < this->Bands && b < intensity.size(); ++b)
    {
      this->Sums[at * this->Bands + b] = intensity[b];
      this->Strengths[at] = std::max(this->Strengths[at], intensity[b]);
    }
  }
  // Numbers of lights are shifted by those of the nodes, so these must be known first.
  for (std::int32_t& k : items)
  {
    k += static_cast<std::int32_t>(nodes);
  }
  if (!items.empty())
  {
    this->Starts.push_back(this->Build(items, 0, items.size()));
  }
  for (const std::int32_t k : directional)
  {
    this->Starts.push_back(static_cast<std::int32_t>(nodes) + k);
  }
}

/// Halves along the longest extent: spatial clusters of any orientation.
std::int32_t LightTree::Build(
  std::vector<std::int32_t>& items, std::size_t begin, std::size_t end)
{
  if (end - begin == 1)
  {
    return items[begin];
  }
  Box3 centers;
  for (std::size_t k = begin; k < end; ++k)
  {
    centers.Add(this->Reaches[items[k]].Box.Min);
  }
  const Vec3 size = centers.Size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::size_t middle = begin + (end - begin) / 2;
  std::nth_element(items.begin() + static_cast<std::ptrdiff_t>(begin),
    items.begin() + static_cast<std::ptrdiff_t>(middle),
    items.begin() + static_cast<std::ptrdiff_t>(end), [&](std::int32_t a, std::int32_t b) {
      const double pa = this->Reaches[a].Box.Min[axis];
      const double pb = this->Reaches[b].Box.Min[axis];
      return pa < pb || (pa == pb && a < b);
    });
  const auto at = static_cast<std::int32_t>(this->Inner.size());
  this->Inner.push_back({ { 0, 0 } });
  const std::int32_t first = this->Build(items, begin, middle);
  const std::int32_t second = this->Build(items, middle, end);
  this->Inner[at] = { { first, second } };
  this->Reaches[at] = Join(this->Reaches[first], this->Reaches[second]);
  for (std::size_t b = 0; b < this->Bands; ++b)
  {
    this->Sums[at * this->Bands + b] =
      this->Sums[first * this->Bands + b] + this->Sums[second * this->Bands + b];
  }
  this->Strengths[at] = this->Strengths[first] + this->Strengths[second];
  this->Counts[at] = this->Counts[first] + this->Counts[second];
  return at;
}

double LightTree::Nearest(const Vec3& point) const
{
  const auto distance = [&](std::int32_t entry) {
    const Box3& box = this->Reaches[entry].Box;
    Vec3 off;
    for (int a = 0; a < 3; ++a)
    {
      off[a] = std::max({ box.Min[a] - point[a], point[a] - box.Max[a], 0.0 });
    }
    return Length(off);
  };
  double nearest = std::numeric_limits<double>::infinity();
  std::int32_t stack[64];
  int top = 0;
  if (!this->Starts.empty() && !this->Reaches[this->Starts[0]].Directional)
  {
    stack[top++] = this->Starts[0];
  }
  while (top > 0)
  {
    const std::int32_t entry = stack[--top];
    if (!(distance(entry) < nearest))
    {
      continue;
    }
    if (this->IsLight(entry))
    {
      nearest = distance(entry);
      continue;
    }
    const std::int32_t* child = this->Children(entry);
    const bool first = distance(child[0]) < distance(child[1]);
    stack[top++] = child[first ? 1 : 0]; // the nearer one is looked at next
    stack[top++] = child[first ? 0 : 1];
  }
  return nearest;
}

double LightTree::Gain(std::int32_t entry, const ReceiverBounds& receivers) const
{
  const Reach& reach = this->Reaches[entry];
  const Angle facing = FromCosine(receivers.CosSpread);
  if (reach.Directional)
  {
    const Angle off = Less(FromCosine(-Dot(receivers.Normal, reach.Axis)), facing);
    return receivers.CosSpread <= -1.0 ? 1.0 : std::max(0.0, off.Cos + Room);
  }
  // All ways from a receiver to a light lie in this box.
  const Vec3 lo = reach.Box.Min - receivers.Box.Max;
  const Vec3 hi = reach.Box.Max - receivers.Box.Min;
  Vec3 closest;
  for (int a = 0; a < 3; ++a)
  {
    closest[a] = lo[a] > 0.0 ? lo[a] : (hi[a] < 0.0 ? hi[a] : 0.0);
  }
  const double r = Length(closest);
  const Vec3 middle = 0.5 * (lo + hi);
  const double distance = Length(middle);
  const double radius = 0.5 * Length(hi - lo);
  // The angle that the box takes up, seen from its origin; all of it where the origin is inside.
  const bool within = !(distance > radius * (1.0 + Room));
  const Angle width = within
    ? Angle{ -1.0, 0.0 }
    : Angle{ std::sqrt(std::max(0.0, 1.0 - (radius / distance) * (radius / distance))),
        radius / distance };

  double cosine = 1.0;
  if (receivers.CosSpread > 0.0)
  {
    const double most = MostAlong(receivers.Normal, lo, hi) +
      2.0 * std::sqrt(std::max(0.0, 0.5 * (1.0 - receivers.CosSpread))) * (distance + radius);
    const double rounding = 1e-14 * (distance + radius);
    if (most <= -rounding)
    {
      return 0.0; // below the horizon of all
    }
    cosine = r > 0.0 ? std::min(1.0, (most + rounding) / r) : 1.0;
  }
  if (!within && receivers.CosSpread > -1.0)
  {
    const Angle off =
      Less(Less(FromCosine(Dot(receivers.Normal, middle) / distance), width), facing);
    cosine = std::min(cosine, off.Cos + Room);
  }
  if (cosine <= 0.0)
  {
    return 0.0;
  }

  double shape = 1.0;
  if (!within && reach.CosSpread > -1.0 && (reach.CosCutoff > -1.0 || reach.Exponent > 0.0))
  {
    const Angle off = Less(Less(FromCosine(-Dot(reach.Axis, middle) / distance), width),
      FromCosine(reach.CosSpread));
    if (off.Cos + Room < reach.CosCutoff)
    {
      return 0.0; // outside all cones
    }
    shape = reach.Exponent > 0.0
      ? std::pow(std::clamp(off.Cos + Room, 0.0, 1.0), reach.Exponent)
      : 1.0;
  }
  const double* k = reach.Attenuation;
  const double falloff = k[0] + r * (k[1] + r * k[2]);
  const double gain =
    falloff > 0.0 ? shape * cosine / falloff : std::numeric_limits<double>::infinity();
  const bool inverseSquare = k[0] == 0.0 && k[1] == 0.0 && k[2] == 1.0;
  return inverseSquare ? std::min(gain, receivers.Greatest) : gain;
}

} // namespace radiometry
