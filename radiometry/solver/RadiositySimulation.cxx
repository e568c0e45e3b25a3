// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/RadiositySimulation.h"

#include "radiometry/formfactor/PointGather.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/solver/BlindSides.h"
#include "radiometry/solver/RadiosityEvaluation.h"
#include "radiometry/solver/RadiosityRun.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{

struct RadiositySimulation::Internals
{
  std::unique_ptr<RadiosityRun> Run;
};

RadiositySimulation::RadiositySimulation(
  const Scene& scene, const OcclusionScene& occluders, const RadiosityOptions& options)
  : Impl(new Internals)
{
  this->Impl->Run = std::make_unique<RadiosityRun>(scene, occluders, options, nullptr);
}

RadiositySimulation::RadiositySimulation(
  const Scene& scene, const RadiosityOptions& options, RadiosityCache& cache)
  : Impl(new Internals)
{
  this->Impl->Run =
    std::make_unique<RadiosityRun>(scene, cache.Occluders(scene), options, &cache);
}

RadiositySimulation::~RadiositySimulation() = default;

const RadiosityResult& RadiositySimulation::Run(const StageProgress& stage)
{
  RadiosityRun& m = *this->Impl->Run;
  CheckOptics(m.Context.Geometry);
  if (!(m.Context.Options.RelativeTolerance > 0.0) && !(m.Context.Options.AbsoluteTolerance > 0.0))
  {
    throw InputError("RelativeTolerance", -1, m.Context.Options.RelativeTolerance,
      "a positive number, unless AbsoluteTolerance is positive");
  }
  m.Context.Options.RelativeTolerance = std::clamp(m.Context.Options.RelativeTolerance, 1e-6, 1.0);
  const ElementSet elements(m.Context.Geometry, m.Context.Options.BackFaces);
  for (const double a : elements.GetAreas())
  {
    m.Area += a;
  }
  if (elements.Size() == 0)
  {
    for (FieldValues* f : { &m.Result.Irradiance[0], &m.Result.Radiosity[0] })
    {
      f->Values.assign(m.Context.Geometry.Cells * m.Context.Bands, 0.0);
      f->Errors = f->Values;
    }
    m.Result.Outcome = "there is nothing to receive light";
    return m.Result;
  }

  // When nothing travels on, what the lights give is all.
  const ElementOptics optics(m.Context.Geometry, elements, m.Context.Options.Emission,
    m.Context.Options.Transmission);
  const auto positive = [](double v) { return v > 0.0; };
  const bool faces = m.Context.Paths || m.Context.Options.Forced ||
    !m.Context.Options.SurfaceOnly ||
    !AllBlind(m.Context.Geometry, m.Context.Blind(), m.Context.Options.BackFaces);
  const bool reflects =
    faces && m.Context.Options.Interreflection && !optics.Scattering().Black();
  const bool emits =
    faces && std::any_of(optics.Exitance.begin(), optics.Exitance.end(), positive);
  const bool lit = emits || !m.Context.Geometry.GlobalAmbient.empty() ||
    std::any_of(m.Context.Geometry.Lights.begin(), m.Context.Geometry.Lights.end(),
      [](const Light& light) { return light.Enabled; });
  std::unique_ptr<RadiosityLevel> level;
  bool lightsOnly = !lit || (!reflects && !emits);
  if (lightsOnly || !reflects)
  {
    level = std::make_unique<RadiosityLevel>(m.Context, elements);
    lightsOnly = lightsOnly || !level->Emitters.Empty();
  }
  if (lightsOnly)
  {
    m.Timed("direct light", [&] { level->Illuminate(m.Context, m.Left(), nullptr, stage); });
    m.Timed("light over mirrors", [&] { level->AddMirrored(m.Context, m.Left(), stage); });
    EvaluateRadiosity(m.Context, *level, "direct light", m.Result, nullptr);
    m.Finest = std::move(level);
    m.Result.MethodWhy =
      faces ? "none: nothing is reflected" : "none: no surface that reflects faces another";
    m.Result.Outcome = "direct light is all there is";
    m.Predict(0.0, stage);
    return m.Result;
  }
  m.Follow(elements, stage);
  m.Result.MethodWhy += "; " + m.Finest->F->Description();
  return m.Result;
}

FieldValues RadiositySimulation::IrradianceAt(
  const std::vector<SurfacePoint>& points, const StageProgress& stage) const
{
  const RadiosityRun& m = *this->Impl->Run;
  FieldValues out;
  if (!m.Finest)
  {
    out.Values.assign(points.size() * m.Context.Bands, 0.0);
    out.Errors = out.Values;
    return out;
  }
  const RadiosityLevel& level = *m.Finest;
  ExchangeOptions exchange = m.Context.Sight();
  exchange.RelativeTolerance = m.Context.Options.RelativeTolerance;
  const double left = m.Left() + m.Context.Options.SecondsForPoints;
  const auto part = [&](double from, double to, const char* name) {
    StageProgress p = stage;
    p.Begin = stage.Begin + from * (stage.End - stage.Begin);
    p.End = stage.Begin + to * (stage.End - stage.Begin);
    p.Name = name;
    return p;
  };
  DirectResult direct = ComputeDirectIrradiance(m.Context.Geometry, m.Context.Occluders, points,
    m.Context.Direct(left), part(0.0, 0.2, "direct light at points"));
  out.Values = std::move(direct.Irradiance);
  out.Errors = std::move(direct.Error);
  if (!level.Emitters.Empty())
  {
    const EmitterResult e = ComputeEmitterIrradiance(m.Context.Geometry, m.Context.Occluders,
      points, level.Emitters, exchange, part(0.2, 0.3, "emitters at points"));
    for (std::size_t k = 0; k < out.Values.size(); ++k)
    {
      out.Values[k] += e.Irradiance[k];
      out.Errors[k] = std::hypot(out.Errors[k], e.Error[k]);
    }
  }
  if (!level.Mirrored.Irradiance.empty())
  {
    const SpecularLight mirrored = SpecularLightAt(m.Context.Geometry, m.Context.Occluders,
      level.Elements, level.Mirrored, level.Emitters, *m.Context.Paths, points,
      m.Context.Mirrored(left), part(0.3, 0.4, "light over mirrors at points"));
    for (std::size_t k = 0; k < out.Values.size(); ++k)
    {
      out.Values[k] += mirrored.Irradiance[k];
      out.Errors[k] = std::hypot(out.Errors[k], mirrored.Error[k]);
    }
  }
  if (level.F)
  {
    double mean = 0.0, area = 0.0;
    for (std::size_t k = 0; k < level.Irradiance.size(); ++k)
    {
      const double a = level.Elements.GetAreas()[k / m.Context.Bands];
      mean += a * level.Irradiance[k];
      area += a;
    }
    mean /= area;
    const double allowed = std::max(m.Context.Options.AbsoluteTolerance,
      m.Context.Options.RelativeTolerance * DarkestShare * mean);
    // Sampling of the elements' own irradiance reaches a point that sees few of them.
    std::vector<double> sampling;
    level.Optics.Leave(level.VisibilityError, false, sampling);
    const double coverage = level.Carlo ? CarloCoverage : DenseCoverage;
    for (std::size_t k = 0; k < sampling.size(); ++k)
    {
      sampling[k] /= coverage;
    }
    if (m.Context.Options.TimeBudget > 0.0)
    {
      exchange.SecondsLeft =
        std::max(1e-3, 0.9 * (m.Left() + m.Context.Options.SecondsForPoints));
    }
    const GatherResult g = GatherAtPoints(m.Context.Geometry, m.Context.Occluders, level.Elements,
      level.Leaving, sampling, static_cast<int>(m.Context.Bands), points, allowed, exchange,
      part(0.4, 1.0, "final gather"));
    // The elements' other errors reach points as they reach elements: by their mean share.
    const RadiosityErrorBudget& budget = m.Result.Budget;
    const double share = mean > 0.0 ? (budget.Discretisation + budget.FormFactors) / mean : 0.0;
    for (std::size_t k = 0; k < out.Values.size(); ++k)
    {
      out.Values[k] += g.Irradiance[k];
      out.Errors[k] = budget.Solver +
        std::hypot(std::hypot(out.Errors[k], CarloCoverage * g.Error[k]), share * g.Irradiance[k]);
    }
  }
  return out;
}

} // namespace radiometry
