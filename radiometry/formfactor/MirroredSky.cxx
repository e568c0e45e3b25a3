// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/MirroredSky.h"

#include "radiometry/formfactor/PathFollower.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/Collective.h"
#include "radiometry/scene/SkyRadiance.h"
#include "radiometry/visibility/PointStarts.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr std::size_t Batches = 8;
constexpr std::uint32_t FewestRays = 8; // a batch
constexpr std::uint32_t MostRays = 512;
constexpr double Coverage = 2.7; // of an error estimated from eight batches
constexpr double DarkShare = 0.01;

/// The skies of a scene, and what a path that leaves it brings.
class Skies
{
public:
  explicit Skies(const Scene& scene)
    : Bands(static_cast<std::size_t>(scene.Optics.Bands))
  {
    for (const Light& light : scene.Lights)
    {
      if (light.Enabled && light.Type == LightType::Environment && light.Environment)
      {
        this->Lights.push_back(&light);
        this->Frames.emplace_back(light.Direction, light.Reference);
        for (const double i : light.Intensity)
        {
          this->Strongest = std::max(this->Strongest, Pi * i);
        }
      }
    }
  }
  bool Empty() const { return this->Lights.empty(); }
  double Brightest() const { return this->Strongest; }

  /// Adds pi L times the path's weight.
  void Add(const Vec3& direction, const std::vector<double>& weight, double* sums) const
  {
    for (std::size_t s = 0; s < this->Lights.size(); ++s)
    {
      const Light& light = *this->Lights[s];
      const Vec3 there = this->Frames[s].ToSky(direction);
      const bool grey = light.Environment->Bands() == 1;
      const double all = grey ? light.Environment->At(there) : 0.0;
      for (std::size_t b = 0; b < this->Bands; ++b)
      {
        const double relative = grey ? all : light.Environment->At(there, static_cast<int>(b));
        sums[b] += Pi * relative * light.Intensity[b] * weight[weight.size() > 1 ? b : 0];
      }
    }
  }

  const std::size_t Bands;

private:
  std::vector<const Light*> Lights;
  std::vector<SkyFrame> Frames;
  double Strongest = 0.0;
};

/// One receiver: `start(u, direction, from)` gives the ray of four numbers, false where there is none.
template <class Start>
void Gather(const OcclusionScene& occluders, const ElementSet& none,
  const SpecularSurfaces& surfaces, const SpecularLightOptions& options, const Skies& skies,
  std::uint64_t key, Start&& start, double* values, double* errors)
{
  const std::size_t bands = skies.Bands;
  std::vector<double> sums(Batches * bands, 0.0), mean(bands), error(bands), before(bands, 0.0);
  std::vector<double> weight(surfaces.Width()), counted(surfaces.Width());
  std::array<double, Batches> rays{};
  std::uint32_t done = 0;
  for (std::uint32_t end = FewestRays; end <= MostRays; end *= 2)
  {
    for (std::size_t batch = 0; batch < Batches; ++batch)
    {
      const std::uint64_t own = Hash64(key, batch);
      const SobolSequence sequence(own);
      for (std::uint32_t k = done; k < end; ++k)
      {
        RayEnd from;
        Vec3 direction;
        if (!start(sequence(k), direction, from))
        {
          continue;
        }
        rays[batch] += 1.0;
        const SurfaceHit hit = occluders.Closest(from, direction);
        if (!surfaces.GoesOn(hit))
        {
          continue;
        }
        std::fill(weight.begin(), weight.end(), 1.0);
        const PathOutcome path =
          FollowPath(occluders, none, surfaces, hit, direction, Hash64(own, 0x736b79ull), k,
            weight.data(), counted.data(), [](std::int32_t, const double*) {});
        if (path.Escapes && path.Reflections > 0)
        {
          skies.Add(path.Direction, weight, sums.data() + batch * bands);
        }
      }
    }
    done = end;
    bool fine = true;
    for (std::size_t b = 0; b < bands; ++b)
    {
      before[b] = error[b] / std::sqrt(2.0);
      mean[b] = 0.0;
      double square = 0.0;
      for (std::size_t batch = 0; batch < Batches; ++batch)
      {
        mean[b] += sums[batch * bands + b] / std::max(1.0, rays[batch]) / Batches;
      }
      for (std::size_t batch = 0; batch < Batches; ++batch)
      {
        const double off = sums[batch * bands + b] / std::max(1.0, rays[batch]) - mean[b];
        square += off * off;
      }
      error[b] = Coverage * std::sqrt(square / (Batches * (Batches - 1.0)));
      fine = fine &&
        std::max(error[b], before[b]) <=
          std::max(options.AbsoluteTolerance,
            0.5 * options.RelativeTolerance * std::max(mean[b], DarkShare * skies.Brightest()));
    }
    if (fine && end > FewestRays)
    {
      break;
    }
  }
  for (std::size_t b = 0; b < bands; ++b)
  {
    values[b] += mean[b];
    errors[b] = std::hypot(errors[b], std::max(error[b], before[b]));
  }
}

/// Runs `body` for this rank's share of the receivers and brings all shares together.
template <class Body>
void Each(std::size_t receivers, std::size_t bands, const SpecularLightOptions& options,
  const StageProgress& stage, std::vector<double>& values, std::vector<double>& errors, Body&& body)
{
  const RankShare share(options.Ranks, receivers);
  Collectively(options.Ranks, [&] {
    ParallelFor(
      share.End - share.Begin, options.Threads, stage,
      [&](std::size_t k) { body(share.Begin + k); }, 1e-4);
  });
  if (options.Ranks)
  {
    const std::vector<std::size_t> begin = RankShare::Begins(*options.Ranks, receivers, bands);
    options.Ranks->Gather(values.data(), begin);
    options.Ranks->Gather(errors.data(), begin);
  }
}

} // namespace

void AddMirroredSky(const Scene& scene, const OcclusionScene& occluders, const ElementSet& elements,
  const SpecularSurfaces& surfaces, const SpecularLightOptions& options, const StageProgress& stage,
  std::vector<double>& values, std::vector<double>& errors)
{
  const Skies skies(scene);
  if (skies.Empty() || !options.Environment)
  {
    return;
  }
  Each(elements.Size(), skies.Bands, options, stage, values, errors, [&](std::size_t i) {
    const Patch& patch = elements.GetPatches()[i];
    const Vec3 normal = Normalized(AreaNormal2(patch.Corners));
    if (normal == Vec3{})
    {
      return;
    }
    const auto start = [&](const std::array<double, 4>& u, Vec3& direction, RayEnd& from) {
      from = { TrianglePoint(patch.Corners, u[0], u[1]), patch.Triangle };
      direction = CosineDirection(normal, u[2], u[3]);
      return true;
    };
    Gather(occluders, elements, surfaces, options, skies, Hash64(options.Seed ^ 0x736b696573ull, i),
      start, values.data() + i * skies.Bands, errors.data() + i * skies.Bands);
  });
}

void AddMirroredSky(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const SpecularSurfaces& surfaces,
  const SpecularLightOptions& options, const StageProgress& stage, std::vector<double>& values,
  std::vector<double>& errors)
{
  const Skies skies(scene);
  if (skies.Empty() || !options.Environment)
  {
    return;
  }
  const ElementSet none(Scene{}, false);
  Each(points.size(), skies.Bands, options, stage, values, errors, [&](std::size_t i) {
    const SurfacePoint& point = points[i];
    const std::vector<PointStart> starts = PointStarts(scene, occluders, point);
    const auto start = [&](const std::array<double, 4>& u, Vec3& direction, RayEnd& from) {
      direction = CosineDirection(point.Normal, u[0], u[1]);
      const auto first = static_cast<std::size_t>(u[2] * static_cast<double>(starts.size()));
      for (std::size_t s = 0; s < starts.size(); ++s)
      {
        const PointStart& candidate = starts[(first + s) % starts.size()];
        if (point.Around.empty() || Dot(candidate.Normal, direction) > 0.0)
        {
          from = candidate.End;
          return true;
        }
      }
      return false;
    };
    Gather(occluders, none, surfaces, options, skies, Hash64(options.Seed ^ 0x706f696e7473ull, i),
      start, values.data() + i * skies.Bands, errors.data() + i * skies.Bands);
  });
}

} // namespace radiometry
