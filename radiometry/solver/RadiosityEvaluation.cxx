// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/RadiosityEvaluation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

using Values = std::vector<double>;

/// Rays are asked for with some room, since what they bring is itself uncertain.
constexpr double RayRoom = 0.92;
/// A cell that leaves less than that share of what is allowed to rays is not worth them.
constexpr double LeastForRays = 0.25;

} // namespace

double CellState::WithoutRays() const
{
  return std::hypot(this->Direct, this->Discretisation) + this->Bounds;
}

double CellState::RayNeed() const
{
  const double all = std::max(0.0, RayRoom - this->Bounds);
  const double others = std::hypot(this->Direct, this->Discretisation);
  const double left = all > others ? std::sqrt(all * all - others * others) : 0.0;
  if (left < LeastForRays)
  {
    return this->Excess <= 1.0f ? 1.0 : std::numeric_limits<double>::infinity();
  }
  const double lack = this->Visibility / left;
  return lack * lack;
}

bool EvaluateRadiosity(const RadiosityContext& context, const RadiosityLevel& level,
  const char* stage, RadiosityResult& result, std::vector<std::uint8_t>* unfinished,
  CellStates* states)
{
  const std::size_t n = level.Elements.Size();
  const std::size_t nb = context.Bands;
  const std::vector<Patch>& patches = level.Elements.GetPatches();
  const std::vector<double>& areas = level.Elements.GetAreas();
  const std::size_t cells = context.Geometry.Cells;

  // Sums over the cells' sides: linear for what may have one sign, squares for sampling.
  struct Sums
  {
    Values Area, Value, Gathered, Leaving, Direct, FormFactor, Visibility, Signed, Squares, Solver;
  };
  std::array<Sums, 2> sums;
  for (Sums& s : sums)
  {
    s.Area.assign(cells, 0.0);
    for (Values* v : { &s.Value, &s.Gathered, &s.Leaving, &s.Direct, &s.FormFactor, &s.Visibility,
           &s.Signed, &s.Squares, &s.Solver })
    {
      v->assign(cells * nb, 0.0);
    }
  }
  // The spread of the estimate over each element and its neighbours, and its mean share of the
  // gathered light: a difference that happens to pass through zero at one place is not an error of
  // zero there.
  std::size_t groups = 0;
  const std::vector<std::int32_t> group = level.Elements.Groups(context.Geometry, 1, groups);
  Values groupSquare(groups * nb, 0.0), groupArea(groups, 0.0);
  for (std::size_t e = 0; e < n; ++e)
  {
    const auto g = static_cast<std::size_t>(group[e]);
    groupArea[g] += areas[e];
    for (std::size_t b = 0; b < nb; ++b)
    {
      const double d = level.Discretisation[e * nb + b];
      groupSquare[g * nb + b] += areas[e] * d * d;
    }
  }
  Values meanShare(nb, 0.0);
  for (std::size_t b = 0; b < nb; ++b)
  {
    double difference = 0.0, all = 0.0;
    for (std::size_t e = 0; e < n; ++e)
    {
      difference += areas[e] * std::abs(level.Discretisation[e * nb + b]);
      all += areas[e] * (level.Irradiance[e * nb + b] - level.First[e * nb + b]);
    }
    meanShare[b] = all > 0.0 ? difference / all : 0.0;
  }
  bool back = false;
  Values leaving;
  level.Optics.Leave(level.Irradiance, true, leaving);
  for (std::size_t e = 0; e < n; ++e)
  {
    Sums& s = sums[patches[e].Side];
    back = back || patches[e].Side == 1;
    const auto c = static_cast<std::size_t>(patches[e].Cell);
    const auto g = static_cast<std::size_t>(group[e]);
    const double a = areas[e];
    s.Area[c] += a;
    for (std::size_t b = 0; b < nb; ++b)
    {
      const std::size_t k = e * nb + b, to = c * nb + b;
      s.Value[to] += a * level.Irradiance[k];
      s.Gathered[to] += a * (level.Irradiance[k] - level.First[k]);
      s.Leaving[to] += a * leaving[k];
      s.Direct[to] += a * level.DirectError[k];
      s.FormFactor[to] += a * level.FormFactorError[k];
      s.Visibility[to] += a * a * level.VisibilityError[k] * level.VisibilityError[k];
      s.Signed[to] += a * level.Discretisation[k];
      s.Squares[to] += a * groupSquare[g * nb + b] / groupArea[g];
      s.Solver[to] += a * level.SolverError[k];
    }
  }

  result.Budget = {};
  result.Parts = {};
  double totalArea = 0.0, totalValue = 0.0, totalError = 0.0, meanValue = 0.0;
  for (const Sums& s : sums)
  {
    for (std::size_t c = 0; c < cells; ++c)
    {
      totalArea += s.Area[c];
      for (std::size_t b = 0; b < nb; ++b)
      {
        totalValue += s.Value[c * nb + b];
      }
    }
  }
  meanValue = totalArea > 0.0 ? totalValue / (totalArea * static_cast<double>(nb)) : 0.0;
  double met = 0.0, count = 0.0, countMet = 0.0, excess = 0.0;
  std::array<std::vector<std::uint8_t>, 2> open;
  Values excesses;
  for (std::size_t side = 0; side < (back ? 2 : 1); ++side)
  {
    const Sums& s = sums[side];
    FieldValues& irradiance = result.Irradiance[side];
    FieldValues& radiosity = result.Radiosity[side];
    for (FieldValues* f : { &irradiance, &radiosity })
    {
      f->Values.assign(cells * nb, 0.0);
      f->Errors.assign(cells * nb, 0.0);
    }
    open[side].assign(cells, 0);
    if (states)
    {
      (*states)[side].assign(cells, CellState());
    }
    for (std::size_t c = 0; c < cells; ++c)
    {
      const double a = s.Area[c];
      if (!(a > 0.0))
      {
        continue;
      }
      double worstExcess = 0.0;
      RadiosityErrorBudget worst;
      for (std::size_t b = 0; b < nb; ++b)
      {
        const std::size_t k = c * nb + b;
        const double value = s.Value[k] / a;
        const double direct = s.Direct[k] / a;
        const double formFactor = s.FormFactor[k] / a;
        const double visibility = std::sqrt(s.Visibility[k]) / a;
        const double discretisation = std::max({ std::abs(s.Signed[k]) / a,
          0.5 * std::sqrt(s.Squares[k] / a), 0.7 * meanShare[b] * s.Gathered[k] / a });
        const double solver = s.Solver[k] / a;
        const double error =
          std::hypot(std::hypot(direct, visibility), discretisation) + formFactor + solver;
        irradiance.Values[k] = value;
        irradiance.Errors[k] = error;
        // B = M + rho E holds for the averages, and so for their errors.
        radiosity.Values[k] = s.Leaving[k] / a;
        totalError += a * error;
        const double allowed = std::max(context.Options.AbsoluteTolerance,
          context.Options.RelativeTolerance * std::max(value, DarkestShare * meanValue));
        const double bandExcess = allowed > 0.0 ? error / allowed : (error > 0.0 ? 10.0 : 0.0);
        if (states && bandExcess >= worstExcess)
        {
          const double share = allowed > 0.0 ? 1.0 / allowed : (error > 0.0 ? 10.0 / error : 0.0);
          (*states)[side][c] = { static_cast<float>(a), static_cast<float>(bandExcess),
            static_cast<float>(direct * share), static_cast<float>(visibility * share),
            static_cast<float>(discretisation * share),
            static_cast<float>((formFactor + solver) * share) };
        }
        worstExcess = std::max(worstExcess, bandExcess);
        const double part = a / (totalArea * static_cast<double>(nb));
        result.Parts.Direct += part * direct;
        result.Parts.FormFactors += part * formFactor;
        result.Parts.Visibility += part * visibility;
        result.Parts.Discretisation += part * discretisation;
        result.Parts.Solver += part * solver;
        worst.Direct = std::max(worst.Direct, direct);
        worst.FormFactors = std::max(worst.FormFactors, formFactor);
        worst.Visibility = std::max(worst.Visibility, visibility);
        worst.Discretisation = std::max(worst.Discretisation, discretisation);
        worst.Solver = std::max(worst.Solver, solver);
      }
      const bool fine = worstExcess <= 1.0;
      excesses.push_back(worstExcess);
      excess += fine ? 0.0 : std::min(worstExcess, 10.0);
      met += fine ? a : 0.0;
      count += 1.0;
      countMet += fine ? 1.0 : 0.0;
      open[side][c] = !fine;
      const double share = a / totalArea;
      result.Budget.Direct += share * worst.Direct;
      result.Budget.FormFactors += share * worst.FormFactors;
      result.Budget.Visibility += share * worst.Visibility;
      result.Budget.Discretisation += share * worst.Discretisation;
      result.Budget.Solver += share * worst.Solver;
    }
  }
  // Radiosity's error: that of irradiance, reflected, and of the other side's, let through. Both
  // shares are a cell's own.
  for (std::size_t e = 0; e < n; ++e)
  {
    const std::size_t side = patches[e].Side;
    const bool through = !level.Optics.Opposite.empty() && level.Optics.Opposite[e] >= 0;
    for (std::size_t b = 0; b < nb; ++b)
    {
      const std::size_t to = static_cast<std::size_t>(patches[e].Cell) * nb + b;
      const double reflected =
        level.Optics.Reflectance[e * nb + b] * result.Irradiance[side].Errors[to];
      result.Radiosity[side].Errors[to] = reflected +
        (through ? level.Optics.Transmittance[e * nb + b] * result.Irradiance[1 - side].Errors[to]
                 : 0.0);
    }
  }
  if (unfinished)
  {
    unfinished->assign(n, 0);
    for (std::size_t e = 0; e < n; ++e)
    {
      (*unfinished)[e] = open[patches[e].Side][static_cast<std::size_t>(patches[e].Cell)];
    }
  }
  result.Elements = n;
  result.Iterations = level.Iterations;
  result.Samples = level.F ? level.F->Samples() : 0;
  result.OperatorBytes = level.F ? level.F->MemoryBytes() : 0;
  result.Closure = level.F ? level.F->Closure() : ClosureReport{};
  const double perValue = totalArea * static_cast<double>(nb);
  result.Convergence.Add(stage, totalValue > 0.0 ? totalError / totalValue : 0.0,
    perValue > 0.0 ? totalError / perValue : 0.0, result.Samples,
    { result.Parts.Direct, result.Parts.FormFactors, result.Parts.Visibility,
      result.Parts.Discretisation, result.Parts.Solver });
  if (!excesses.empty())
  {
    const auto at = excesses.begin() + static_cast<std::ptrdiff_t>(0.95 * (excesses.size() - 1));
    std::nth_element(excesses.begin(), at, excesses.end());
    result.Excess95 = *at;
  }
  result.Excess = count > 0.0 ? excess / count : 0.0;
  result.MetShare = totalArea > 0.0 ? std::min(met / totalArea, countMet / count) : 1.0;
  return result.MetShare >= 0.95;
}

} // namespace radiometry
