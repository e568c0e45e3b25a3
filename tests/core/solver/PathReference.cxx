// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/solver/PathReference.h"

#include "radiometry/scene/SkyRadiance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

namespace test
{

using namespace radiometry;

namespace
{

constexpr int Batches = 16;
const double Pi = std::acos(-1.0);

using Random = std::mt19937_64;
using Values = std::vector<double>;

double Uniform(Random& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// The direction of density (m + 1)/(2 pi) cos^m about an axis that two numbers stand for.
Vec3 PowerAbout(const Vec3& axis, double m, double a, double b)
{
  const Vec3 side = std::abs(axis.x) < 0.6 ? Vec3{ 1, 0, 0 } : Vec3{ 0, 1, 0 };
  const Vec3 u = Normalized(Cross(side, axis));
  const Vec3 v = Cross(axis, u);
  const double c = std::pow(1.0 - a, 1.0 / (m + 1.0));
  const double r = std::sqrt(std::max(0.0, 1.0 - c * c));
  return r * std::cos(2.0 * Pi * b) * u + r * std::sin(2.0 * Pi * b) * v + c * axis;
}

Vec3 Mirrored(const Vec3& way, const Vec3& n)
{
  return way - (2.0 * Dot(way, n)) * n;
}

/// What a surface does with a path that meets it: weights of its ways on, by band.
struct Meeting
{
  Vec3 At, Way; // Way: of the path, unit
  std::int32_t Triangle = -1;
  int Side = 0;
  Values Reflected, Through, Lobe, Straight;
  double Exponent = 0.0; // of the lobe
  bool Mirror = false;
};

double Greatest(const Values& values)
{
  return *std::max_element(values.begin(), values.end());
}

class Tracer
{
public:
  Tracer(const Scene& scene, const OcclusionScene& occluders)
    : World(scene)
    , Occluders(occluders)
    , Bands(static_cast<std::size_t>(scene.Optics.Bands))
  {
    // Small emitters are seldom met by chance: they are asked like lights.
    double all = 0.0;
    for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
    {
      const double* row = this->Emitted(0, static_cast<std::size_t>(scene.TriangleCell[t]));
      all += Area(scene.TriangleAt(t));
      if (row && *std::max_element(row, row + this->Bands) > 0.0)
      {
        this->EmittingArea += Area(scene.TriangleAt(t));
        this->Emitters.push_back(static_cast<std::int32_t>(t));
        this->EmitterEnd.push_back(this->EmittingArea);
      }
    }
    if (this->EmittingArea > 0.05 * all || !scene.Optics.EmittedExitance[1].empty())
    {
      this->Emitters.clear();
    }
  }

  /// One path: what arrives at a point of a triangle's side by a sampled direction and straight.
  Values Arriving(const Vec3& from, std::int32_t triangle, int side, double a, double b,
    Random& random) const
  {
    Values sum(this->Bands, 0.0), weight(this->Bands, 1.0);
    this->AddSources(from, triangle, side, weight, sum, random);
    Vec3 at = from, direction = PowerAbout(this->Normal(triangle, side), 1.0, a, b);
    bool afterLobe = false; // then small emitters were not asked
    for (int depth = 0; depth < 2000; ++depth)
    {
      const SurfaceHit hit = this->Occluders.Closest({ at, triangle }, direction);
      if (hit.Triangle < 0)
      {
        this->AddSky(direction, weight, sum);
        break;
      }
      triangle = hit.Triangle;
      const Triangle3 t = this->World.TriangleAt(static_cast<std::size_t>(triangle));
      at = (1.0 - hit.U - hit.V) * t[0] + hit.U * t[1] + hit.V * t[2];
      if (static_cast<std::size_t>(triangle) >= this->World.ReceiverTriangles)
      {
        break;
      }
      const Meeting met = this->Meet(at, triangle, hit.Front ? 0 : 1, direction, weight, afterLobe, sum);
      this->AddSources(met, sum, random);
      if (!this->GoOn(met, direction, weight, afterLobe, random))
      {
        break;
      }
    }
    return sum;
  }

private:
  Vec3 Normal(std::int32_t triangle, int side) const
  {
    const Vec3 n = Normalized(AreaNormal2(this->World.TriangleAt(static_cast<std::size_t>(triangle))));
    return side == 0 ? n : -n;
  }

  /// The exitance of a cell's side; null: none.
  const double* Emitted(int side, std::size_t cell) const
  {
    const Values& all = this->World.Optics.EmittedExitance[static_cast<std::size_t>(side)];
    return all.empty() ? nullptr : all.data() + cell * this->Bands;
  }

  /// What gets from one place to another, by band; empty: nothing.
  Values Seen(const RayEnd& from, const RayEnd& to) const
  {
    Values share(this->Bands, 1.0);
    return this->Occluders.Visible(from, to, share.data()) ? share : Values();
  }

  /// sum += weight times what small emitters give there, from one point on one of them.
  void AddEmitter(const Vec3& at, std::int32_t triangle, const Vec3& n, const Values& weight,
    Values& sum, Random& random) const
  {
    const double pick = Uniform(random) * this->EmittingArea;
    const auto k = static_cast<std::size_t>(
      std::upper_bound(this->EmitterEnd.begin(), this->EmitterEnd.end() - 1, pick) -
      this->EmitterEnd.begin());
    const std::int32_t emitter = this->Emitters[k];
    const Triangle3 t = this->World.TriangleAt(static_cast<std::size_t>(emitter));
    const double root = std::sqrt(Uniform(random)), u = root * Uniform(random);
    const Vec3 from = (1.0 - root) * t[0] + (root - u) * t[1] + u * t[2];
    const Vec3 to = from - at;
    const double r = Length(to);
    const double cosines = std::max(0.0, Dot(n, to)) * std::max(0.0, -Dot(this->Normal(emitter, 0), to));
    const Values seen =
      cosines <= 0.0 || emitter == triangle ? Values() : this->Seen({ at, triangle }, { from, emitter });
    if (seen.empty())
    {
      return;
    }
    const double share = this->EmittingArea * cosines / (Pi * r * r * r * r);
    const double* m = this->Emitted(
      0, static_cast<std::size_t>(this->World.TriangleCell[static_cast<std::size_t>(emitter)]));
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      sum[b] += weight[b] * share * seen[b] * m[b];
    }
  }

  /// sum += weight times what lights and small emitters give there.
  void AddSources(const Vec3& at, std::int32_t triangle, int side, const Values& weight,
    Values& sum, Random& random) const
  {
    const Vec3 n = this->Normal(triangle, side);
    if (!this->Emitters.empty())
    {
      this->AddEmitter(at, triangle, n, weight, sum, random);
    }
    for (const Light& light : this->World.Lights)
    {
      Vec3 to;
      const Values share = this->FromLight(light, at, triangle, n, to);
      for (std::size_t b = 0; b < share.size(); ++b)
      {
        sum[b] += weight[b] * share[b];
      }
    }
    for (std::size_t b = 0; b < this->Bands && !this->World.GlobalAmbient.empty(); ++b)
    {
      sum[b] += weight[b] * this->World.GlobalAmbient[b];
    }
  }

  /// The irradiance by a point or directional light, and the unit way to it; empty: none.
  Values FromLight(
    const Light& light, const Vec3& at, std::int32_t triangle, const Vec3& n, Vec3& to) const
  {
    double share = 0.0;
    Values seen(this->Bands, 1.0);
    if (light.Type == LightType::Point)
    {
      to = light.Position - at;
      const double r = Length(to);
      to = to / r;
      share = std::max(0.0, Dot(n, to)) / (r * r);
      seen = share > 0.0 ? this->Seen({ at, triangle }, { light.Position, -1 }) : Values();
    }
    else if (light.Type == LightType::Directional)
    {
      to = -light.Direction;
      share = std::max(0.0, Dot(n, to));
      seen = share > 0.0 && this->Occluders.VisibleDirection({ at, triangle }, to, seen.data())
        ? seen
        : Values();
    }
    for (std::size_t b = 0; b < seen.size(); ++b)
    {
      seen[b] *= share * light.Intensity[b];
    }
    return seen;
  }

  /// ... what the ways on of a path get of lights and small emitters. Those are not asked for a lobe,
  /// nor is any light for a mirror.
  void AddSources(const Meeting& met, Values& sum, Random& random) const
  {
    if (Greatest(met.Reflected) > 0.0)
    {
      this->AddSources(met.At, met.Triangle, met.Side, met.Reflected, sum, random);
    }
    if (Greatest(met.Through) > 0.0)
    {
      this->AddSources(met.At, met.Triangle, 1 - met.Side, met.Through, sum, random);
    }
    if (Greatest(met.Lobe) > 0.0 && !met.Mirror)
    {
      const Vec3 n = this->Normal(met.Triangle, met.Side);
      const Vec3 axis = Mirrored(met.Way, n);
      for (const Light& light : this->World.Lights)
      {
        Vec3 to;
        const Values share = this->FromLight(light, met.At, met.Triangle, n, to);
        const double c = std::max(0.0, Dot(axis, to));
        const double lobe = 0.5 * (met.Exponent + 2.0) * std::pow(c, met.Exponent); // times pi
        for (std::size_t b = 0; b < share.size(); ++b)
        {
          sum[b] += met.Lobe[b] * lobe * share[b];
        }
      }
    }
  }

  void AddSky(const Vec3& direction, const Values& weight, Values& sum) const
  {
    for (const Light& light : this->World.Lights)
    {
      if (light.Type == LightType::Environment)
      {
        const SkyFrame frame(light.Direction, light.Reference);
        for (std::size_t b = 0; b < this->Bands; ++b)
        {
          sum[b] += weight[b] * Pi * light.Intensity[b] *
            light.Environment->At(frame.ToSky(direction), light.Environment->Bands() == 1 ? 0 : int(b));
        }
      }
    }
  }

  /// Adds what a cell's side emits toward the path and finds its ways on.
  Meeting Meet(const Vec3& at, std::int32_t triangle, int side, const Vec3& way, const Values& weight,
    bool afterLobe, Values& sum) const
  {
    const Materials& optics = this->World.Optics;
    const auto cell =
      static_cast<std::size_t>(this->World.TriangleCell[static_cast<std::size_t>(triangle)]);
    const std::size_t row = cell * this->Bands;
    const bool active = side == 0 || optics.TwoSided[cell];
    const double* emitted =
      active && (this->Emitters.empty() || afterLobe) ? this->Emitted(side, cell) : nullptr;
    const auto share = [&](const Values& of) {
      Values part(this->Bands, 0.0);
      for (std::size_t b = 0; b < this->Bands && !of.empty(); ++b)
      {
        part[b] = weight[b] * of[row + b];
      }
      return part;
    };
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      sum[b] += emitted ? weight[b] * emitted[b] : 0.0;
    }
    const auto s = static_cast<std::size_t>(side);
    Meeting met{ at, way, triangle, side, share(active ? optics.DiffuseReflectance[s] : Values()),
      share(optics.DiffuseTransmittance),
      share(active ? optics.SpecularReflectance[s] : Values()), share(optics.Transmittance) };
    met.Exponent = optics.Shininess[s].empty() ? DefaultShininess : optics.Shininess[s][cell];
    met.Mirror = met.Exponent >= MirrorShininess;
    return met;
  }

  /// Continues a path on one of its ways; false where it ends.
  bool GoOn(
    const Meeting& met, Vec3& direction, Values& weight, bool& afterLobe, Random& random) const
  {
    const Values* const ways[] = { &met.Reflected, &met.Through, &met.Lobe, &met.Straight };
    double parts[4], all = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      parts[k] = Greatest(*ways[k]);
      all += parts[k];
    }
    // Roulette keeps the mean: weak paths go on with a chance in proportion to their weight.
    const double survival = std::min(1.0, all / 0.1);
    double u = survival > 0.0 ? Uniform(random) / survival : 1.0;
    if (u >= 1.0)
    {
      return false;
    }
    u *= all;
    int taken = 0;
    while (taken < 3 && (u >= parts[taken] || parts[taken] <= 0.0))
    {
      u -= parts[taken++];
    }
    double scale = all / (survival * parts[taken]);
    const Vec3 n = this->Normal(met.Triangle, met.Side);
    const double a = Uniform(random), b = Uniform(random);
    if (taken < 2)
    {
      direction = PowerAbout(taken == 0 ? n : -n, 1.0, a, b);
      afterLobe = false;
    }
    else if (taken == 2)
    {
      const Vec3 axis = Mirrored(met.Way, n);
      direction = met.Mirror ? axis : PowerAbout(axis, met.Exponent, a, b);
      // The lobe's density is (n + 2)/(n + 1) cos of the sampled one.
      scale *= met.Mirror
        ? 1.0
        : std::max(0.0, Dot(direction, n)) * (met.Exponent + 2.0) / (met.Exponent + 1.0);
      afterLobe = true;
    }
    for (std::size_t k = 0; k < this->Bands; ++k)
    {
      weight[k] = scale * (*ways[taken])[k];
    }
    return parts[taken] > 0.0 && scale > 0.0;
  }

  const Scene& World;
  const OcclusionScene& Occluders;
  std::size_t Bands;
  std::vector<std::int32_t> Emitters; // small ones; empty: emission counts where paths meet it
  Values EmitterEnd;                  // of their areas, summed up
  double EmittingArea = 0.0;
};

/// 0 ... n - 1 in a random order.
std::vector<int> Shuffled(int n, Random& random)
{
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t k = order.size(); k > 1; --k)
  {
    std::swap(order[k - 1], order[random() % k]);
  }
  return order;
}

/// From `strata` squared places (a point: all the same) and directions in each of the batches.
PathEstimate ByPaths(const Scene& scene, const OcclusionScene& occluders, std::int32_t triangle,
  int side, bool centroid, int strata, Random& random)
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  const Triangle3 t = scene.TriangleAt(static_cast<std::size_t>(triangle));
  const Tracer tracer(scene, occluders);
  std::vector<Values> mean(Batches, Values(bands, 0.0));
  for (Values& batch : mean)
  {
    const std::vector<int> place = Shuffled(strata * strata, random);
    for (int k = 0; k < strata * strata; ++k)
    {
      const auto jitter = [&](int stratum) { return (stratum + Uniform(random)) / strata; };
      const double root = std::sqrt(jitter(place[static_cast<std::size_t>(k)] / strata));
      const double u = root * jitter(place[static_cast<std::size_t>(k)] % strata);
      const Vec3 at = centroid ? Centroid(t) : (1.0 - root) * t[0] + (root - u) * t[1] + u * t[2];
      const double a = jitter(k / strata), b = jitter(k % strata);
      const Values arriving = tracer.Arriving(at, triangle, side, a, b, random);
      for (std::size_t band = 0; band < bands; ++band)
      {
        batch[band] += arriving[band] / (strata * strata);
      }
    }
  }
  PathEstimate out;
  for (std::size_t band = 0; band < bands; ++band)
  {
    double sum = 0.0, square = 0.0;
    for (const Values& batch : mean)
    {
      sum += batch[band] / Batches;
    }
    for (const Values& batch : mean)
    {
      square += (batch[band] - sum) * (batch[band] - sum);
    }
    out.Irradiance.push_back(sum);
    out.Error.push_back(std::sqrt(square / (Batches * (Batches - 1.0))));
  }
  return out;
}

std::int32_t TriangleOf(const Scene& scene, std::size_t cell)
{
  return static_cast<std::int32_t>(
    std::find(scene.TriangleCell.begin(), scene.TriangleCell.end(), static_cast<std::int32_t>(cell)) -
    scene.TriangleCell.begin());
}

} // namespace

PathEstimate IrradianceByPaths(const Scene& scene, const OcclusionScene& occluders,
  std::size_t cell, int side, int strata, std::uint64_t seed)
{
  Random random(seed * 1000003 + cell * 2 + static_cast<std::size_t>(side));
  return ByPaths(scene, occluders, TriangleOf(scene, cell), side, false, strata, random);
}

PathEstimate IrradianceOfCentroid(const Scene& scene, const OcclusionScene& occluders,
  std::size_t cell, int side, int strata, std::uint64_t seed)
{
  Random random(seed * 1000033 + cell * 2 + static_cast<std::size_t>(side));
  return ByPaths(scene, occluders, TriangleOf(scene, cell), side, true, strata, random);
}

} // namespace test
