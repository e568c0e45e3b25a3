// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/RadiositySolver.h"

#include "radiometry/scene/InputError.h"
#include "radiometry/solver/ReflectionSystem.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

} // namespace

SolveResult SolveRadiosity(const FormFactorOperator& F, const std::vector<double>& reflectance,
  const std::vector<double>& source, int bands, const SolveOptions& options,
  const std::vector<std::int32_t>& cell, const StageProgress& stage)
{
  const std::size_t n = F.Size();
  const auto nb = static_cast<std::size_t>(bands);
  SolveResult result;
  result.Radiosity = source;
  result.Irradiance.assign(n * nb, 0.0);
  result.Error.assign(n * nb, 0.0);
  if (n == 0)
  {
    return result;
  }
  const bool black =
    std::all_of(reflectance.begin(), reflectance.end(), [](double r) { return r == 0.0; });
  const bool dark = std::all_of(source.begin(), source.end(), [](double m) { return m == 0.0; });
  if (dark)
  {
    return result;
  }
  if (black)
  {
    F.Apply(source.data(), result.Irradiance.data(), bands);
    result.Iterations = 1;
    return result;
  }

  // Components that lose nothing have no solution with a source, and none is needed without.
  const std::vector<std::int32_t> component = F.Components();
  std::vector<double> rho = reflectance;
  {
    const ReflectionSystem whole(F, rho, bands, component, {});
    std::vector<double> lit(whole.Loss.size(), 0.0);
    for (std::size_t i = 0; i < n; ++i)
    {
      for (std::size_t b = 0; b < nb; ++b)
      {
        lit[static_cast<std::size_t>(component[i]) * nb + b] += std::abs(source[i * nb + b]);
      }
    }
    for (std::size_t i = 0; i < n; ++i)
    {
      const auto c = static_cast<std::size_t>(component[i]);
      for (std::size_t b = 0; b < nb; ++b)
      {
        if (whole.LossShare(c, b) > 1e-11)
        {
          continue;
        }
        if (lit[c * nb + b] > 0.0)
        {
          throw InputError("DiffuseReflectance", cell.empty() ? static_cast<long long>(i) : cell[i],
            reflectance[i * nb + b],
            "less than 1 somewhere: this cell belongs to a closed cavity that has a source of "
            "light and absorbs none, so its radiosity has no finite value");
        }
        rho[i * nb + b] = 0.0;
      }
    }
  }

  // The bound of the inverse for the most reflecting band serves all.
  int boundIterations = 0;
  if (options.InverseBound)
  {
    result.InverseBound = *options.InverseBound;
  }
  else
  {
    std::vector<double> greatestRho(n, 0.0);
    for (std::size_t k = 0; k < rho.size(); ++k)
    {
      greatestRho[k / nb] = std::max(greatestRho[k / nb], rho[k]);
    }
    StageProgress still = stage;
    still.End = still.Begin;
    ReflectionSystem worst(F, greatestRho, 1, component, still);
    result.InverseBound = BoundOfInverse(worst);
    boundIterations = worst.Iterations;
  }
  const std::vector<double> w =
    result.InverseBound.empty() ? std::vector<double>(n, 1.0) : result.InverseBound;
  double greatestW = 0.0, area = 0.0;
  for (std::size_t i = 0; i < n; ++i)
  {
    greatestW = std::max(greatestW, w[i]);
    area += F.Areas()[i];
  }
  if (!std::isfinite(greatestW))
  {
    greatestW = 1e12;
  }

  ReflectionSystem system(F, rho, bands, component, stage);
  std::vector<double>& x = result.Radiosity;
  if (options.Guess)
  {
    x = *options.Guess;
  }
  std::vector<double> r(n * nb), best = x,
                                 bestResidual(nb, std::numeric_limits<double>::infinity());
  int stalls = 0;
  for (;;)
  {
    system.Residual(source, x, r);
    system.Deflate(r, x);
    system.Residual(source, x, r);
    const std::vector<double> greatest = system.Greatest(r);
    const std::vector<double> mean = system.Mean(x);
    std::vector<double> goal(nb);
    bool done = true, better = false;
    for (std::size_t b = 0; b < nb; ++b)
    {
      const double wanted = options.Tolerance * mean[b] / greatestW;
      goal[b] = 0.2 * wanted * std::sqrt(area);
      done = done && greatest[b] <= wanted;
      better = better || greatest[b] < 0.5 * bestResidual[b];
      if (greatest[b] < bestResidual[b])
      {
        bestResidual[b] = greatest[b];
        for (std::size_t k = b; k < x.size(); k += nb)
        {
          best[k] = x[k];
        }
      }
    }
    bool rounding = true; // no further than rounding allows
    const std::vector<double> size = system.Greatest(x);
    for (std::size_t b = 0; b < nb; ++b)
    {
      rounding = rounding && greatest[b] <= 64.0 * Epsilon * size[b];
    }
    stalls = better ? 0 : stalls + 1;
    if (done || (rounding && stalls >= 1) || stalls >= 20)
    {
      break;
    }
    if (system.Iterations >= options.MaximumIterations)
    {
      result.Converged = false;
      break;
    }
    system.Cycle(r, goal, options.MaximumIterations - system.Iterations, x);
  }
  x = best;

  // What arrives, and the residual of what is returned with its own rounding.
  F.Apply(x.data(), result.Irradiance.data(), bands);
  std::vector<double> residual(nb, 0.0);
  const std::vector<double> size = system.Greatest(x);
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    const double reflected = rho[k] * result.Irradiance[k];
    residual[k % nb] = std::max(residual[k % nb], std::abs(source[k] + reflected - x[k]));
  }
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    result.Error[k] = (residual[k % nb] + 4.0 * Epsilon * size[k % nb]) * w[k / nb];
    result.Residual = std::max(result.Residual, residual[k % nb]);
  }
  result.Iterations = system.Iterations + boundIterations + 1;
  return result;
}

} // namespace radiometry
