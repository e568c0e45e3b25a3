// SPDX-License-Identifier: BSD-3-Clause
// The paths of RadianceTracer.
#include "radiometry/irradiance/RadianceTracer.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/Reflectance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr int MostReflections = 1000;

double Uniform(std::uint64_t& state)
{
  state = Hash64(state);
  return (static_cast<double>(state >> 12) + 0.5) * 0x1p-52;
}

/// Where a ray crosses a triangle from its front: the distance in units of `way`; below 0: nowhere.
double Crossing(const Triangle3& t, const Vec3& from, const Vec3& way)
{
  const Vec3 e1 = t[1] - t[0];
  const Vec3 e2 = t[2] - t[0];
  const Vec3 n = Cross(e1, e2);
  const double fall = -Dot(n, way);
  if (!(fall > 0.0))
  {
    return -1.0;
  }
  const Vec3 r = from - t[0];
  const Vec3 c = Cross(r, way);
  const double u = Dot(e2, c) / fall;
  const double v = -Dot(e1, c) / fall;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 ? Dot(n, r) / fall : -1.0;
}

} // namespace

/// A path from the eye, at its last place.
struct RadianceTracer::Walk
{
  Place At;
  Vec3 Way; // of the next ray
  std::vector<double> Weight;
  double* Radiance = nullptr;
  double* Doubt = nullptr;
  std::uint64_t State = 0;
  std::int64_t Rays = 0;
  Vec3 Source;          // where the way was last chosen ...
  double Density = 0.0; // ... and with which density; infinite: by a mirror, or from the eye
  std::vector<double> Passed; // by panes on the way to a light

  void Add(std::size_t band, double radiance) { this->Radiance[band] += this->Weight[band] * radiance; }
};

/// f/rho_s, 1/sr.
double RadianceTracer::Lobe(const Place& place, double exponent, const Vec3& in) const
{
  return PhongLobeBrdf(1.0, exponent, place.Normal, in, place.Toward);
}

/// Density, per sr, with which Bounce chooses a direction: (n + 1)/(2 pi) cos^n(alpha).
double RadianceTracer::LobeDensity(const Place& place, const Vec3& in) const
{
  const double n = this->Exponent(place.Cell, place.Front);
  const double f = this->Lobe(place, n, in);
  return n == 0.0 ? f * std::max(0.0, Dot(place.Normal, in)) : f * (n + 1.0) / (n + 2.0);
}

/// Chooses a direction by the lobe; the factor of the weight is f cos/(rho_s density). 0: below the
/// surface.
double RadianceTracer::Bounce(
  const Place& at, const std::array<double, 4>& u, Vec3& direction, double& density) const
{
  const double n = this->Exponent(at.Cell, at.Front);
  const double cosine = Dot(at.Normal, at.Toward);
  const Vec3 image = Normalized(2.0 * cosine * at.Normal - at.Toward);
  density = std::numeric_limits<double>::infinity();
  if (!(cosine > 0.0))
  {
    return 0.0;
  }
  if (n >= MirrorShininess)
  {
    direction = image;
    return 1.0;
  }
  if (n == 0.0)
  {
    direction = CosineDirection(at.Normal, u[2], u[3]);
    density = std::max(0.0, Dot(at.Normal, direction)) / Pi;
    return density > 0.0 ? 1.0 : 0.0;
  }
  // 1 - cos without cancellation: sharp lobes keep their digits.
  const double versine = -std::expm1(std::log(u[2]) / (n + 1.0));
  const double sine = std::sqrt(versine * (2.0 - versine));
  Vec3 s, t;
  Frame(image, s, t);
  const double psi = 2.0 * Pi * u[3];
  direction = Normalized(
    (1.0 - versine) * image + (sine * std::cos(psi)) * s + (sine * std::sin(psi)) * t);
  density = this->LobeDensity(at, direction);
  const double height = Dot(at.Normal, direction);
  return height > 0.0 && density > 0.0 ? (n + 2.0) / (n + 1.0) * height : 0.0;
}

/// Density, per sr, with which points of a panel are chosen that lie along `way` (not unit) from a
/// place.
double RadianceTracer::PanelDensity(const Panel& panel, const Vec3& way) const
{
  const double r2 = LengthSquared(way);
  const double leaves = -Dot(panel.Normal, way) / std::sqrt(r2);
  return leaves > 0.0 ? panel.Chance / panel.Area * r2 / leaves
                      : std::numeric_limits<double>::infinity();
}

/// The highlight of one light, chosen at random, at a place that is seen by reflection.
void RadianceTracer::AddBeams(Walk& walk) const
{
  if (this->Beams.empty())
  {
    return;
  }
  const Place& at = walk.At;
  const auto count = static_cast<double>(this->Beams.size());
  const Beam& beam = this->Beams[std::min(
    this->Beams.size() - 1, static_cast<std::size_t>(Uniform(walk.State) * count))];
  const Light& light = beam.Flux->GetLight();
  const Vec3 in =
    beam.Flux->Directional() ? -light.Direction : Normalized(light.Position - at.End.Point);
  const double f = this->Lobe(at, this->Exponent(at.Cell, at.Front), in);
  const double e = f > 0.0 ? beam.Flux->AtPoint(at.End.Point, at.Normal) : 0.0;
  if (!(e * f > 0.0))
  {
    return;
  }
  walk.Passed.assign(this->Bands, 1.0);
  if (this->Effects.Occlusion)
  {
    ++walk.Rays;
    if (beam.Shadow->Transmits())
    {
      beam.Shadow->Passing(at.End, walk.Passed.data());
    }
    else if (beam.Shadow->Hidden(at.End))
    {
      return;
    }
  }
  for (std::size_t b = 0; b < this->Bands; ++b)
  {
    walk.Add(b,
      count * this->Reflectance(at.Cell, at.Front, b) * f * e * light.Intensity[b] *
        walk.Passed[b]);
  }
}

void RadianceTracer::AddPanelSample(Walk& walk, const std::array<double, 4>& u) const
{
  if (this->Panels.empty())
  {
    return;
  }
  const Place& at = walk.At;
  const auto found =
    std::upper_bound(this->Cumulative.begin(), this->Cumulative.end(), u[0] * this->Cumulative.back());
  const Panel& panel = this->Panels[std::min(this->Panels.size() - 1,
    static_cast<std::size_t>(found - this->Cumulative.begin()))];
  const Vec3 on = TrianglePoint(panel.Corners, u[1], u[2]);
  const Vec3 way = on - at.End.Point;
  const double distance = Length(way);
  const double arrives = distance > 0.0 ? Dot(at.Normal, way) / distance : 0.0;
  if (!(arrives > 0.0) || !(Dot(panel.Normal, way) < 0.0) || panel.Triangle == at.End.Triangle)
  {
    return;
  }
  const double f = this->Lobe(at, this->Exponent(at.Cell, at.Front), way / distance);
  const double density = this->PanelDensity(panel, way);
  if (!(f > 0.0) || !std::isfinite(density))
  {
    return;
  }
  walk.Passed.assign(this->Bands, 1.0);
  if (this->Effects.Occlusion)
  {
    RayEnd to{ on, panel.Triangle, false };
    to.Close = panel.Triangle < 0 && this->Occluders.TooClose(on);
    ++walk.Rays;
    if (this->Effects.Transmission && this->Occluders.HasPanes()
        ? !this->Occluders.Visible(at.End, to, walk.Passed.data())
        : this->Occluders.Occluded(at.End, to))
    {
      return;
    }
  }
  // The balance heuristic: f cos L/density times density/(density + that of the lobe).
  const double share = f * arrives / (density + this->LobeDensity(at, way / distance));
  for (std::size_t b = 0; b < this->Bands; ++b)
  {
    walk.Add(b,
      this->Reflectance(at.Cell, at.Front, b) * share * panel.Radiance[b] * walk.Passed[b]);
  }
}

void RadianceTracer::AddSky(Walk& walk) const
{
  const Vec3 way = Normalized(walk.Way);
  for (const SkyLight& sky : this->Skies)
  {
    const auto& radiance = sky.Source->Environment;
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      const int band = radiance && radiance->Bands() > 1 ? static_cast<int>(b) : 0;
      walk.Add(b,
        sky.Source->Intensity[b] * (radiance ? radiance->At(sky.Axes.ToSky(way), band) : 1.0));
    }
  }
}

/// Goes along the walk's way to the next surface and counts what it sends; false: the path ends.
bool RadianceTracer::Follow(Walk& walk) const
{
  ++walk.Rays;
  const Vec3 from = walk.At.End.Point;
  const SurfaceHit hit = this->Occluders.Closest(walk.At.End, walk.Way);
  const auto balance = [&](const Panel& panel, const Vec3& way) {
    if (std::isinf(walk.Density))
    {
      return 1.0;
    }
    const double density = this->PanelDensity(panel, from + way - walk.Source);
    return std::isfinite(density) ? walk.Density / (walk.Density + density) : 0.0;
  };
  const double reach = hit.Triangle < 0
    ? std::numeric_limits<double>::infinity()
    : hit.Distance + 1e-9 * (this->Extent + hit.Distance);
  for (const std::size_t k : this->Lights)
  {
    const Panel& panel = this->Panels[k];
    const double t = Crossing(panel.Corners, from, walk.Way);
    if (t > 0.0 && t <= reach)
    {
      const double share = balance(panel, t * walk.Way);
      for (std::size_t b = 0; b < this->Bands; ++b)
      {
        walk.Add(b, share * panel.Radiance[b]);
      }
    }
  }
  if (hit.Triangle < 0)
  {
    this->AddSky(walk);
    return false;
  }
  const auto t = static_cast<std::size_t>(hit.Triangle);
  const bool receives = t < this->Geometry.ReceiverTriangles;
  const std::int32_t cell = receives ? this->Geometry.TriangleCell[t] : -1;
  if (receives && this->Sends(cell, hit.Front))
  {
    const std::size_t side = hit.Front ? 0 : 1;
    const std::size_t row = static_cast<std::size_t>(cell) * this->Bands;
    const std::int32_t emitter = this->PanelOf.empty() ? -1 : this->PanelOf[t][side];
    const double share = emitter < 0
      ? 1.0
      : balance(this->Panels[static_cast<std::size_t>(emitter)], hit.Distance * walk.Way);
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      const double all = this->Diffuse.Exitance[side][row + b] / Pi;
      const double own =
        emitter < 0 ? 0.0 : this->Panels[static_cast<std::size_t>(emitter)].Radiance[b];
      walk.Add(b, std::max(0.0, all - own) + share * own);
      if (!this->Diffuse.Error[side].empty())
      {
        walk.Doubt[b] += walk.Weight[b] * this->Diffuse.Error[side][row + b] / Pi;
      }
    }
  }
  if (!this->Surfaces.GoesOn(hit))
  {
    return false;
  }
  walk.At.End = this->Surfaces.Place(hit);
  walk.At.Normal = this->Surfaces.Normal(hit.Triangle, hit.Front);
  walk.At.Cell = cell;
  walk.At.Front = hit.Front;
  walk.At.Toward = -Normalized(walk.Way);
  walk.At.Known = nullptr;
  return true;
}

std::int64_t RadianceTracer::AddSample(
  const Place& place, const RadianceNumbers& numbers, double* radiance, double* doubt) const
{
  Walk walk;
  walk.Radiance = radiance;
  walk.Doubt = doubt;
  walk.State = numbers.State;
  // What comes through: straight on from the eye.
  std::vector<double> through(this->Bands, 0.0);
  bool reflects = false, transmits = false;
  for (std::size_t b = 0; b < this->Bands; ++b)
  {
    through[b] = this->Transmittance(place.Cell, b);
    transmits = transmits || through[b] > 0.0;
    reflects = reflects || this->Reflectance(place.Cell, place.Front, b) > 0.0;
  }
  // Each of the two ways of the first place is followed; later ones by chance.
  for (int way = 0; way < 2; ++way)
  {
    if (!(way == 0 ? reflects : transmits))
    {
      continue;
    }
    walk.At = place;
    walk.Density = std::numeric_limits<double>::infinity();
    walk.Weight.assign(this->Bands, 1.0);
    bool reflect = way == 0;
    for (int bounce = 0; bounce < MostReflections; ++bounce)
    {
      const bool first = bounce == 0;
      const Place at = walk.At;
      if (reflect)
      {
        const double exponent = this->Exponent(at.Cell, at.Front);
        const bool lobe = exponent < MirrorShininess;
        std::array<double, 4> u = numbers.Lobe;
        if (!first)
        {
          u = { Uniform(walk.State), Uniform(walk.State), Uniform(walk.State),
            Uniform(walk.State) };
        }
        if (lobe && first)
        {
          this->AddPanelSample(walk, numbers.Panel);
        }
        const double factor = this->Bounce(at, u, walk.Way, walk.Density);
        walk.Source = at.End.Point;
        for (std::size_t b = 0; b < this->Bands; ++b)
        {
          walk.Weight[b] *=
            factor * (first ? this->Reflectance(place.Cell, place.Front, b) : 1.0);
        }
        if (!(factor > 0.0))
        {
          break;
        }
      }
      else
      {
        walk.Way = -at.Toward;
        for (std::size_t b = 0; b < this->Bands && first; ++b)
        {
          walk.Weight[b] = through[b];
        }
      }
      if (!this->Follow(walk))
      {
        break;
      }
      // Highlights of lights on what is seen there, then one way on.
      double reflected = 0.0, transmitted = 0.0;
      const std::int32_t t = walk.At.End.Triangle;
      for (std::size_t b = 0; b < this->Bands; ++b)
      {
        const std::size_t band = this->Surfaces.Width() > 1 ? b : 0;
        if (walk.Weight[b] > 0.0)
        {
          reflected =
            std::max(reflected, this->Surfaces.Reflectance(t, walk.At.Front, band));
          transmitted = std::max(transmitted, this->Surfaces.Transmittance(t, band));
        }
      }
      if (reflected > 0.0 && this->Exponent(walk.At.Cell, walk.At.Front) < MirrorShininess)
      {
        this->AddBeams(walk);
        this->AddPanelSample(walk,
          { Uniform(walk.State), Uniform(walk.State), Uniform(walk.State), Uniform(walk.State) });
      }
      const double sum = reflected + transmitted;
      const double scale = sum > 1.0 ? 1.0 / sum : 1.0;
      const double u = Uniform(walk.State);
      if (u >= sum * scale)
      {
        break;
      }
      reflect = u < reflected * scale;
      const double chance = (reflect ? reflected : transmitted) * scale;
      for (std::size_t b = 0; b < this->Bands; ++b)
      {
        const std::size_t band = this->Surfaces.Width() > 1 ? b : 0;
        walk.Weight[b] *= (reflect ? this->Surfaces.Reflectance(t, walk.At.Front, band)
                                   : this->Surfaces.Transmittance(t, band)) /
          chance;
      }
    }
  }
  return walk.Rays;
}

} // namespace radiometry
