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

/// The direction of density cos/pi about a normal that two numbers stand for.
Vec3 CosineAbout(const Vec3& n, double a, double b)
{
  const Vec3 side = std::abs(n.x) < 0.6 ? Vec3{ 1, 0, 0 } : Vec3{ 0, 1, 0 };
  const Vec3 u = Normalized(Cross(side, n));
  const Vec3 v = Cross(n, u);
  const double r = std::sqrt(a);
  return r * std::cos(2.0 * Pi * b) * u + r * std::sin(2.0 * Pi * b) * v + std::sqrt(1.0 - a) * n;
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
    Vec3 at = from, direction = CosineAbout(this->Normal(triangle, side), a, b);
    for (int depth = 0; depth < 2000; ++depth)
    {
      const SurfaceHit hit = this->Occluders.Closest({ at, triangle }, direction);
      if (hit.Triangle < 0)
      {
        this->AddSky(direction, weight, sum);
        break;
      }
      triangle = hit.Triangle;
      side = hit.Front ? 0 : 1;
      const Triangle3 t = this->World.TriangleAt(static_cast<std::size_t>(triangle));
      at = (1.0 - hit.U - hit.V) * t[0] + hit.U * t[1] + hit.V * t[2];
      if (static_cast<std::size_t>(triangle) >= this->World.ReceiverTriangles ||
        !this->Scatter(at, triangle, side, weight, sum, random))
      {
        break;
      }
      direction = CosineAbout(this->Normal(triangle, side), Uniform(random), Uniform(random));
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
    if (cosines <= 0.0 || emitter == triangle ||
      this->Occluders.Occluded({ at, triangle }, { from, emitter }))
    {
      return;
    }
    const double share = this->EmittingArea * cosines / (Pi * r * r * r * r);
    const double* m = this->Emitted(
      0, static_cast<std::size_t>(this->World.TriangleCell[static_cast<std::size_t>(emitter)]));
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      sum[b] += weight[b] * share * m[b];
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
      double share = 0.0;
      if (light.Type == LightType::Point)
      {
        const Vec3 to = light.Position - at;
        const double r = Length(to);
        share = std::max(0.0, Dot(n, to) / (r * r * r));
        share = share > 0.0 && this->Occluders.Occluded({ at, triangle }, { light.Position, -1 })
          ? 0.0
          : share;
      }
      else if (light.Type == LightType::Directional)
      {
        share = std::max(0.0, -Dot(n, light.Direction));
        share = share > 0.0 &&
            this->Occluders.OccludedDirection({ at, triangle }, -light.Direction)
          ? 0.0
          : share;
      }
      for (std::size_t b = 0; b < this->Bands && share > 0.0; ++b)
      {
        sum[b] += weight[b] * share * light.Intensity[b];
      }
    }
    for (std::size_t b = 0; b < this->Bands && !this->World.GlobalAmbient.empty(); ++b)
    {
      sum[b] += weight[b] * this->World.GlobalAmbient[b];
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

  /// Adds what leaves a cell's side toward the path and continues it on one of its sides; false
  /// where it ends.
  bool Scatter(const Vec3& at, std::int32_t triangle, int& side, Values& weight, Values& sum,
    Random& random) const
  {
    const Materials& optics = this->World.Optics;
    const auto cell =
      static_cast<std::size_t>(this->World.TriangleCell[static_cast<std::size_t>(triangle)]);
    const std::size_t row = cell * this->Bands;
    const bool active = side == 0 || optics.TwoSided[cell];
    Values reflected(this->Bands, 0.0), through(this->Bands, 0.0);
    double r = 0.0, t = 0.0;
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      const double* emitted = this->Emitters.empty() ? this->Emitted(side, cell) : nullptr;
      sum[b] += active && emitted ? weight[b] * emitted[b] : 0.0;
      reflected[b] = active ? weight[b] * optics.DiffuseReflectance[side][row + b] : 0.0;
      through[b] =
        optics.DiffuseTransmittance.empty() ? 0.0 : weight[b] * optics.DiffuseTransmittance[row + b];
      r = std::max(r, reflected[b]);
      t = std::max(t, through[b]);
    }
    if (r + t <= 0.0)
    {
      return false;
    }
    if (r > 0.0)
    {
      this->AddSources(at, triangle, side, reflected, sum, random);
    }
    if (t > 0.0)
    {
      this->AddSources(at, triangle, 1 - side, through, sum, random);
    }
    // Roulette keeps the mean: weak paths go on with a chance in proportion to their weight.
    const double survival = std::min(1.0, (r + t) / 0.1);
    const double u = Uniform(random) / survival;
    if (u >= 1.0)
    {
      return false;
    }
    const bool passes = u * (r + t) >= r;
    const double chance = survival * (passes ? t : r) / (r + t);
    side = passes ? 1 - side : side;
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      weight[b] = (passes ? through[b] : reflected[b]) / chance;
    }
    return true;
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

} // namespace

PathEstimate IrradianceByPaths(const Scene& scene, const OcclusionScene& occluders,
  std::size_t cell, int side, int strata, std::uint64_t seed)
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  std::int32_t triangle = 0;
  while (static_cast<std::size_t>(scene.TriangleCell[static_cast<std::size_t>(triangle)]) != cell)
  {
    ++triangle;
  }
  const Triangle3 t = scene.TriangleAt(static_cast<std::size_t>(triangle));
  const Tracer tracer(scene, occluders);
  Random random(seed * 1000003 + cell * 2 + static_cast<std::size_t>(side));
  std::vector<Values> mean(Batches, Values(bands, 0.0));
  for (Values& batch : mean)
  {
    const std::vector<int> place = Shuffled(strata * strata, random);
    for (int k = 0; k < strata * strata; ++k)
    {
      const auto jitter = [&](int stratum) { return (stratum + Uniform(random)) / strata; };
      const double root = std::sqrt(jitter(place[static_cast<std::size_t>(k)] / strata));
      const double u = root * jitter(place[static_cast<std::size_t>(k)] % strata);
      const Vec3 at = (1.0 - root) * t[0] + (root - u) * t[1] + u * t[2];
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

} // namespace test
