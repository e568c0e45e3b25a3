// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/BeamIrradiance.h"

#include "radiometry/geometry/Horizon.h"
#include "radiometry/irradiance/ShadowCutter.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <numeric>

namespace radiometry
{
namespace
{

/// How far inside its triangles a vertex asks for the light, as a share of the way to the centroid.
constexpr double NudgeShare = 1.0 / 64.0;

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

/// The enabled lights of a scene, ready to be asked.
class LightSet
{
public:
  LightSet(const Scene& scene, const OcclusionScene& occluders, const DirectOptions& options,
    const StageProgress& stage)
  {
    for (const Light& light : scene.Lights)
    {
      if (light.Enabled && light.Type != LightType::Area && light.Type != LightType::Environment)
      {
        this->Sources.push_back(
          std::make_unique<SourceFlux>(light, options.SpotShape, options.Attenuation));
      }
    }
    this->Outlines.resize(this->Size());
    this->Cutters.resize(this->Size());
    if (options.Occlusion && !scene.Triangles.empty() && this->Size() > 0)
    {
      StageProgress lines = stage;
      lines.End = 0.5 * (stage.Begin + stage.End);
      this->Lines = &occluders.Lines(scene, options.Threads, lines);
    }
    StageProgress outlines = stage;
    outlines.Begin = 0.5 * (stage.Begin + stage.End);
    ParallelFor(
      this->Size(), options.Threads, outlines,
      [&](std::size_t k) {
        if (this->Lines)
        {
          this->Outlines[k] =
            std::make_unique<Silhouettes>(scene, *this->Lines, this->Sources[k]->GetLight());
        }
        this->Cutters[k] = std::make_unique<ShadowCutter>(
          *this->Sources[k], this->Outlines[k].get(), occluders);
      },
      2e-8 * static_cast<double>(scene.Triangles.size()) + 1e-6);
  }
  std::size_t Size() const { return this->Sources.size(); }

  const ShadowLines* Lines = nullptr; // null: nothing hides anything
  std::vector<std::unique_ptr<SourceFlux>> Sources;
  std::vector<std::unique_ptr<Silhouettes>> Outlines;
  std::vector<std::unique_ptr<ShadowCutter>> Cutters;
};

double Magnitude(const std::vector<double>& intensity)
{
  return intensity.empty() ? 0.0 : *std::max_element(intensity.begin(), intensity.end());
}

/// The largest coordinate that the scene's numbers were computed with.
double Extent(const Scene& scene)
{
  double extent = Length(scene.Origin);
  for (const Vec3& p : scene.Points)
  {
    extent = std::max({ extent, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z) });
  }
  return extent;
}

/// True when rounding hides on which side of a point's plane the light is.
bool InPlane(const SourceFlux& source, const SurfacePoint& p, double extent)
{
  const Light& light = source.GetLight();
  const double height = source.Directional() ? -Dot(p.Normal, light.Direction)
                                             : Dot(p.Normal, light.Position - p.Point);
  const double reach = source.Directional() ? 1.0 : Length(light.Position - p.Point) + extent;
  return height <= 4.0 * Epsilon * reach;
}

} // namespace

void AddBeamIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options, const StageProgress& stage,
  ConvergenceRecord* record, DirectResult& result)
{
  const ConvergenceRecord clock;
  const int bands = result.Bands;
  StageProgress preparing = stage;
  preparing.End = stage.Begin + 0.1 * (stage.End - stage.Begin);
  const LightSet lights(scene, occluders, options, preparing);
  if (lights.Size() == 0 || patches.empty())
  {
    return;
  }

  std::vector<double> areas(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    areas[i] = Area(patches[i].Corners);
  }
  const double extent = Extent(scene);
  const std::int64_t before = result.Rays;
  std::atomic<std::int64_t> rays{ 0 };
  std::atomic<bool> expired{ false };
  std::vector<std::uint8_t> open(patches.size(), 1);
  std::vector<double> unshadowed(patches.size(), 0.0);

  // `hasty`: no time is left to ask what is hidden; anything from none to all may be lit.
  const auto compute = [&](std::size_t i, int work, bool hasty) {
    const Patch& patch = patches[i];
    double* value = &result.Irradiance[i * bands];
    double* error = &result.Error[i * bands];
    std::fill(value, value + bands, 0.0);
    std::fill(error, error + bands, 0.0);
    open[i] = 0;
    const double area = areas[i];
    if (!(area > 0.0))
    {
      return;
    }
    const Vec3 normal = Normalized(AreaNormal2(patch.Corners));
    double size = std::numeric_limits<double>::infinity(); // the least height
    for (int k = 0; k < 3; ++k)
    {
      size = std::min(
        size, 2.0 * area / Length(patch.Corners[(k + 1) % 3] - patch.Corners[k]));
    }
    // Of the closed forms, and of coordinates of that extent on a patch of that size.
    const double rounding = Epsilon * (16.0 + extent / size);

    // Strongest light first: what it gives sets the scale of what the others may be wrong by.
    struct Share
    {
      std::size_t Light;
      double Flux;
      double Quadrature;
    };
    std::vector<Share> shares;
    for (std::size_t k = 0; k < lights.Size(); ++k)
    {
      double quadrature = 0.0;
      const SourceFlux& source = *lights.Sources[k];
      const double flux = source.OnPolygon(patch.Corners.data(), 3, normal, quadrature);
      const PlaneSide side = source.Directional()
        ? FindSide(patch.Corners, Dot(normal, source.GetLight().Direction), extent)
        : FindSide(patch.Corners, normal, source.GetLight().Position, extent);
      for (int b = 0; b < bands && side == PlaneSide::Unknown; ++b)
      {
        error[b] += source.GetLight().Intensity[b] * (flux / area); // nothing, or that much
      }
      if (side != PlaneSide::Known)
      {
        continue;
      }
      if (flux > 0.0)
      {
        shares.push_back({ k, flux, quadrature });
      }
    }
    const auto strength = [&](const Share& s) {
      return s.Flux * Magnitude(lights.Sources[s.Light]->GetLight().Intensity);
    };
    std::stable_sort(shares.begin(), shares.end(),
      [&](const Share& a, const Share& b) { return strength(a) > strength(b); });

    for (int b = 0; b < bands; ++b)
    {
      double sum = 0.0;
      for (const Share& share : shares)
      {
        sum += lights.Sources[share.Light]->GetLight().Intensity[b] * (share.Flux / area);
      }
      unshadowed[i] = std::max(unshadowed[i], sum);
    }

    double lit = 0.0; // W, strongest band
    for (const Share& share : shares)
    {
      const Light& light = lights.Sources[share.Light]->GetLight();
      const double magnitude = Magnitude(light.Intensity);
      if (magnitude <= 0.0)
      {
        continue;
      }
      const double basis = std::max(lit, 0.25 * share.Flux * magnitude);
      const double allowed =
        0.5 * std::max(options.RelativeTolerance * basis, options.AbsoluteTolerance * area) /
        magnitude;
      static const std::vector<Segment3> none;
      LitFlux flux;
      if (hasty && lights.Lines)
      {
        flux = { 0.5 * share.Flux, 0.5 * share.Flux, 0, false };
      }
      else
      {
        flux = lights.Cutters[share.Light]->Flux(patch, normal, share.Flux,
          lights.Lines ? lights.Lines->Crossings(patch.Triangle) : none, allowed, work);
      }
      flux.Error += share.Quadrature * (flux.Value / share.Flux);
      rays += flux.Rays;
      lit += flux.Value * magnitude;
      open[i] |= flux.Exact || flux.Error <= allowed ? 0 : 1;
      for (int b = 0; b < bands; ++b)
      {
        value[b] += light.Intensity[b] * (flux.Value / area);
        error[b] += light.Intensity[b] * ((flux.Error + rounding * flux.Value) / area);
      }
    }
  };

  // Rounds of growing effort on what is not yet good enough.
  constexpr int efforts[] = { 1, 64, 512, 4096 };
  constexpr int rounds = static_cast<int>(std::size(efforts));
  std::vector<std::size_t> todo(patches.size());
  std::iota(todo.begin(), todo.end(), std::size_t{ 0 });
  for (int round = 0; round < rounds && !todo.empty() && !expired; ++round)
  {
    StageProgress part = stage;
    const double begin = round == 0 ? 0.1 : 0.5 + 0.5 * (round - 1) / (rounds - 1);
    const double end = round == 0 ? 0.5 : 0.5 + 0.5 * round / (rounds - 1);
    part.Begin = stage.Begin + begin * (stage.End - stage.Begin);
    part.End = stage.Begin + end * (stage.End - stage.Begin);
    ParallelFor(
      todo.size(), options.Threads, part,
      [&](std::size_t k) {
        if (options.SecondsLeft > 0.0 && clock.Elapsed() > options.SecondsLeft)
        {
          expired = true;
        }
        if (round == 0 || !expired)
        {
          compute(todo[k], efforts[round], expired);
        }
      },
      5e-6 * static_cast<double>(lights.Size()));
    todo.erase(std::remove_if(
                 todo.begin(), todo.end(), [&](std::size_t i) { return open[i] == 0; }),
      todo.end());
    result.Rays = before + rays;
    RecordDirect(record, result, areas, "direct light");
  }
  result.TimedOut = result.TimedOut || expired;
  result.PeakUnshadowed += *std::max_element(unshadowed.begin(), unshadowed.end());
}

void AddBeamIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options,
  const StageProgress& stage, ConvergenceRecord* record, DirectResult& result)
{
  const int bands = result.Bands;
  DirectOptions plain = options;
  plain.Occlusion = false; // no outlines: a point needs one ray a light
  const LightSet lights(scene, occluders, plain, { stage.Listener, stage.Begin, stage.Begin, stage.Name });
  if (lights.Size() == 0 || points.empty())
  {
    return;
  }
  const double extent = Extent(scene);
  std::atomic<std::int64_t> rays{ 0 };
  std::vector<double> unshadowed(points.size(), 0.0);
  ParallelFor(
    points.size(), options.Threads, stage,
    [&](std::size_t i) {
      const SurfacePoint& p = points[i];
      RayEnd from{ p.Point, p.Triangle };
      if (p.Triangle < 0 && options.Occlusion)
      {
        from.Triangle = occluders.Touching(from.Point, p.Normal, p.Rounding);
        from.Close = from.Triangle < 0 && occluders.TooClose(from.Point);
      }
      for (std::size_t k = 0; k < lights.Size(); ++k)
      {
        const Light& light = lights.Sources[k]->GetLight();
        const double e = lights.Sources[k]->AtPoint(p.Point, p.Normal);
        if (!(e > 0.0) || InPlane(*lights.Sources[k], p, extent))
        {
          continue;
        }
        unshadowed[i] += e * Magnitude(light.Intensity);
        double visible = 1.0;
        double doubt = 0.0;
        if (options.Occlusion && p.Around.empty())
        {
          ++rays;
          visible = lights.Cutters[k]->Hidden(from) ? 0.0 : 1.0;
        }
        else if (options.Occlusion)
        {
          int asked = 0;
          int lit = 0;
          for (const std::int32_t t : p.Around)
          {
            const Triangle3 around = scene.TriangleAt(t);
            const Vec3 start = p.Point + NudgeShare * (Centroid(around) - p.Point);
            const Vec3 n = AreaNormal2(around);
            if (lights.Sources[k]->InFront(start, Dot(n, p.Normal) >= 0.0 ? n : -n))
            {
              ++asked;
              lit += lights.Cutters[k]->Hidden({ start, t }) ? 0 : 1;
            }
          }
          rays += asked;
          visible = asked > 0 ? static_cast<double>(lit) / asked : 0.0;
          doubt = lit > 0 && lit < asked ? 0.5 : 0.0; // a shadow's edge runs through the vertex
        }
        for (int b = 0; b < bands; ++b)
        {
          result.Irradiance[i * bands + b] += light.Intensity[b] * e * visible;
          result.Error[i * bands + b] += light.Intensity[b] * e * (doubt + 16.0 * Epsilon * visible);
        }
      }
    },
    1e-6 * static_cast<double>(lights.Size()));
  result.Rays += rays;
  result.PeakUnshadowed += *std::max_element(unshadowed.begin(), unshadowed.end());
  RecordDirect(record, result, std::vector<double>(points.size(), 1.0), "direct light");
}

} // namespace radiometry
