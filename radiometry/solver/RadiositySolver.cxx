// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/RadiositySolver.h"

#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

constexpr int LongestCycle = 60;
constexpr double Epsilon = std::numeric_limits<double>::epsilon();

/// The linear system (I - rho F) x = b of several bands, and the iteration on it.
class System
{
public:
  System(const FormFactorOperator& op, const std::vector<double>& rho, int bands,
    const std::vector<std::int32_t>& component, const StageProgress& progress)
    : F(op)
    , Rho(rho)
    , N(op.Size())
    , Bands(static_cast<std::size_t>(bands))
    , Component(component)
    , Progress(progress)
  {
    std::int32_t components = 0;
    for (const std::int32_t c : component)
    {
      components = std::max(components, c + 1);
    }
    this->Loss.assign(static_cast<std::size_t>(components) * this->Bands, 0.0);
    this->ComponentArea.assign(static_cast<std::size_t>(components), 0.0);
    for (std::size_t i = 0; i < this->N; ++i)
    {
      const auto c = static_cast<std::size_t>(component[i]);
      this->ComponentArea[c] += op.Areas()[i];
      for (std::size_t b = 0; b < this->Bands; ++b)
      {
        this->Loss[c * this->Bands + b] +=
          op.Areas()[i] * (1.0 - rho[i * this->Bands + b] * op.RowSum(i));
      }
    }
  }

  /// What a component loses of a unit radiosity, as a share of its area.
  double LossShare(std::size_t component, std::size_t band) const
  {
    return this->Loss[component * this->Bands + band] / this->ComponentArea[component];
  }

  /// out = rho F x
  void Reflect(const std::vector<double>& x, std::vector<double>& out)
  {
    this->F.Apply(x.data(), out.data(), static_cast<int>(this->Bands));
    for (std::size_t k = 0; k < out.size(); ++k)
    {
      out[k] *= this->Rho[k];
    }
    ++this->Iterations;
    Report(this->Progress.Listener,
      this->Progress.Begin +
        (this->Progress.End - this->Progress.Begin) * (1.0 - 1.0 / (1.0 + 0.1 * this->Iterations)),
      this->Progress.Name);
  }

  /// r = b - (I - rho F) x
  void Residual(const std::vector<double>& b, const std::vector<double>& x, std::vector<double>& r)
  {
    this->Reflect(x, r);
    for (std::size_t k = 0; k < r.size(); ++k)
    {
      r[k] = b[k] - x[k] + r[k];
    }
  }

  /// Adds the constant of each component that balances its residual's energy.
  void Deflate(const std::vector<double>& r, std::vector<double>& x) const
  {
    std::vector<double> balance(this->Loss.size(), 0.0);
    for (std::size_t i = 0; i < this->N; ++i)
    {
      const auto c = static_cast<std::size_t>(this->Component[i]);
      for (std::size_t b = 0; b < this->Bands; ++b)
      {
        balance[c * this->Bands + b] += this->F.Areas()[i] * r[i * this->Bands + b];
      }
    }
    for (std::size_t i = 0; i < this->N; ++i)
    {
      const auto c = static_cast<std::size_t>(this->Component[i]);
      for (std::size_t b = 0; b < this->Bands; ++b)
      {
        // Black elements keep what they emit.
        const double loss = this->Loss[c * this->Bands + b];
        if (this->Rho[i * this->Bands + b] > 0.0 && loss > 0.0)
        {
          x[i * this->Bands + b] += balance[c * this->Bands + b] / loss;
        }
      }
    }
  }

  /// Area-weighted inner products of each band.
  void Inner(
    const std::vector<double>& a, const std::vector<double>& b, std::vector<double>& out) const
  {
    out.assign(this->Bands, 0.0);
    for (std::size_t i = 0; i < this->N; ++i)
    {
      for (std::size_t k = 0; k < this->Bands; ++k)
      {
        out[k] += this->F.Areas()[i] * a[i * this->Bands + k] * b[i * this->Bands + k];
      }
    }
  }

  /// One cycle of GMRES on (I - rho F) d = r, until each band's residual norm is below its goal.
  void Cycle(const std::vector<double>& r, const std::vector<double>& goal, int steps,
    std::vector<double>& x);

  /// The band's greatest absolute value.
  std::vector<double> Greatest(const std::vector<double>& v) const
  {
    std::vector<double> out(this->Bands, 0.0);
    for (std::size_t k = 0; k < v.size(); ++k)
    {
      out[k % this->Bands] = std::max(out[k % this->Bands], std::abs(v[k]));
    }
    return out;
  }
  /// The band's area-weighted mean absolute value.
  std::vector<double> Mean(const std::vector<double>& v) const
  {
    std::vector<double> out(this->Bands, 0.0);
    double area = 0.0;
    for (std::size_t i = 0; i < this->N; ++i)
    {
      area += this->F.Areas()[i];
      for (std::size_t b = 0; b < this->Bands; ++b)
      {
        out[b] += this->F.Areas()[i] * std::abs(v[i * this->Bands + b]);
      }
    }
    for (double& m : out)
    {
      m /= area;
    }
    return out;
  }

  const FormFactorOperator& F;
  const std::vector<double>& Rho;
  std::size_t N, Bands;
  const std::vector<std::int32_t>& Component;
  StageProgress Progress;
  std::vector<double> Loss, ComponentArea;
  int Iterations = 0;
};

void System::Cycle(
  const std::vector<double>& r, const std::vector<double>& goal, int steps, std::vector<double>& x)
{
  const std::size_t nb = this->Bands;
  // As long a cycle as half a gigabyte of basis allows.
  const double bytes = 8.0 * static_cast<double>(std::max<std::size_t>(1, r.size()));
  const int Restart = std::clamp(static_cast<int>(5e8 / bytes), 10, LongestCycle);
  std::vector<std::vector<double>> basis;
  // Per band: the Hessenberg matrix rotated to upper triangular, and the rotated right-hand side.
  const auto width = static_cast<std::size_t>(Restart);
  std::vector<std::vector<double>> h(nb, std::vector<double>((width + 1) * width, 0.0));
  std::vector<std::vector<double>> cs(nb, std::vector<double>(width));
  std::vector<std::vector<double>> sn = cs;
  std::vector<std::vector<double>> g(nb, std::vector<double>(width + 1, 0.0));
  std::vector<double> inner;

  const auto pushNormalised = [&](const std::vector<double>& v, const std::vector<double>& norms) {
    basis.push_back(v);
    for (std::size_t k = 0; k < v.size(); ++k)
    {
      const double norm = norms[k % nb];
      basis.back()[k] = norm > 0.0 ? v[k] / norm : 0.0;
    }
  };
  this->Inner(r, r, inner);
  std::vector<double> norms(nb);
  for (std::size_t b = 0; b < nb; ++b)
  {
    norms[b] = std::sqrt(inner[b]);
    g[b][0] = norms[b];
  }
  pushNormalised(r, norms);

  std::vector<double> w(r.size());
  int used = 0;
  for (int k = 0; k < std::min(steps, Restart); ++k)
  {
    this->Reflect(basis[static_cast<std::size_t>(k)], w);
    for (std::size_t i = 0; i < w.size(); ++i)
    {
      w[i] = basis[static_cast<std::size_t>(k)][i] - w[i];
    }
    for (int j = 0; j <= k; ++j)
    {
      const auto& v = basis[static_cast<std::size_t>(j)];
      this->Inner(w, v, inner);
      for (std::size_t b = 0; b < nb; ++b)
      {
        h[b][static_cast<std::size_t>(j * Restart + k)] = inner[b];
      }
      for (std::size_t i = 0; i < w.size(); ++i)
      {
        w[i] -= inner[i % nb] * v[i];
      }
    }
    this->Inner(w, w, inner);
    bool done = true;
    for (std::size_t b = 0; b < nb; ++b)
    {
      norms[b] = std::sqrt(inner[b]);
      auto at = [&](
                  int row) -> double& { return h[b][static_cast<std::size_t>(row * Restart + k)]; };
      for (int j = 0; j < k; ++j)
      {
        const auto q = static_cast<std::size_t>(j);
        const double upper = cs[b][q] * at(j) + sn[b][q] * at(j + 1);
        at(j + 1) = -sn[b][q] * at(j) + cs[b][q] * at(j + 1);
        at(j) = upper;
      }
      const double length = std::hypot(at(k), norms[b]);
      const auto q = static_cast<std::size_t>(k);
      cs[b][q] = length > 0.0 ? at(k) / length : 1.0;
      sn[b][q] = length > 0.0 ? norms[b] / length : 0.0;
      at(k) = length;
      g[b][q + 1] = -sn[b][q] * g[b][q];
      g[b][q] *= cs[b][q];
      // A direction that rounding made of nothing is none.
      norms[b] = norms[b] > 1e-14 * length ? norms[b] : 0.0;
      done = done && std::abs(g[b][q + 1]) <= goal[b];
    }
    used = k + 1;
    if (done)
    {
      break;
    }
    pushNormalised(w, norms);
  }
  for (std::size_t b = 0; b < nb; ++b)
  {
    std::vector<double> y(static_cast<std::size_t>(used), 0.0);
    for (int row = used - 1; row >= 0; --row)
    {
      double sum = g[b][static_cast<std::size_t>(row)];
      for (int col = row + 1; col < used; ++col)
      {
        sum -=
          h[b][static_cast<std::size_t>(row * Restart + col)] * y[static_cast<std::size_t>(col)];
      }
      const double pivot = h[b][static_cast<std::size_t>(row * Restart + row)];
      y[static_cast<std::size_t>(row)] = std::abs(pivot) > 1e-300 ? sum / pivot : 0.0;
    }
    for (int k = 0; k < used; ++k)
    {
      const auto& v = basis[static_cast<std::size_t>(k)];
      for (std::size_t i = b; i < v.size(); i += nb)
      {
        x[i] += y[static_cast<std::size_t>(k)] * v[i];
      }
    }
  }
}

/// Positive w with (I - rho F) w >= 1, elementwise: its values bound the inverse.
std::vector<double> BoundOfInverse(System& system)
{
  const std::vector<double> one(system.N, 1.0);
  std::vector<double> w = one, r(system.N);
  double best = std::numeric_limits<double>::infinity();
  std::vector<double> bound(system.N, std::numeric_limits<double>::infinity());
  double area = 0.0;
  for (const double a : system.F.Areas())
  {
    area += a;
  }
  for (int cycle = 0; cycle < 40; ++cycle)
  {
    system.Residual(one, w, r);
    system.Deflate(r, w);
    system.Residual(one, w, r);
    double least = std::numeric_limits<double>::infinity(); // of (I - rho F) w
    double lowest = least, worst = 0.0;
    for (std::size_t i = 0; i < system.N; ++i)
    {
      least = std::min(least, 1.0 - r[i]);
      lowest = std::min(lowest, w[i]);
      worst = std::max(worst, std::abs(r[i]));
    }
    if (least > 0.0 && lowest > 0.0 && worst < best)
    {
      best = worst;
      for (std::size_t i = 0; i < system.N; ++i)
      {
        bound[i] = w[i] / least;
      }
    }
    if (best <= 0.25)
    {
      break;
    }
    system.Cycle(r, { 0.02 * std::sqrt(area) }, LongestCycle, w);
  }
  return bound;
}

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
    const System whole(F, rho, bands, component, {});
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
    System worst(F, greatestRho, 1, component, still);
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

  System system(F, rho, bands, component, stage);
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
