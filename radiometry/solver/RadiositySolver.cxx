// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/RadiositySolver.h"

#include "radiometry/formfactor/LinkedSets.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/solver/ReflectionSystem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

namespace radiometry
{
namespace
{

using Values = std::vector<double>;

constexpr double Epsilon = std::numeric_limits<double>::epsilon();
constexpr double Infinity = std::numeric_limits<double>::infinity();
/// Of a sum of many terms, relative.
constexpr double Rounding = 16.0 * Epsilon;
/// A component that loses less than this of its light loses nothing.
constexpr double Lossless = 1e-11;
/// Where every row loses as much, its inverse is bound of the inverse enough.
constexpr double PlainLoss = 0.1;

/// The operator's components, joined where light passes from one side of a piece to the other.
std::vector<std::int32_t> JoinedComponents(
  const FormFactorOperator& F, const DiffuseScattering& scattering)
{
  std::vector<std::int32_t> component = F.Components();
  if (scattering.Couplings.empty())
  {
    return component;
  }
  LinkedSets sets(component.size());
  for (const DiffuseScattering::Coupling& c : scattering.Couplings)
  {
    sets.Join(component[static_cast<std::size_t>(c.To)], component[static_cast<std::size_t>(c.From)]);
  }
  std::vector<std::int32_t> number(component.size(), -1);
  std::int32_t next = 0;
  for (std::int32_t& c : component)
  {
    std::int32_t& label = number[static_cast<std::size_t>(sets.Root(c))];
    label = label < 0 ? next++ : label;
    c = label;
  }
  return component;
}

/// x's columns beside y's.
Values Beside(const Values& x, std::size_t xs, const Values& y, std::size_t ys)
{
  Values out(x.size() / xs * (xs + ys));
  for (std::size_t i = 0; i < x.size() / xs; ++i)
  {
    std::copy_n(&x[i * xs], xs, &out[i * (xs + ys)]);
    std::copy_n(&y[i * ys], ys, &out[i * (xs + ys) + xs]);
  }
  return out;
}
/// Columns [first, first + count) of width.
Values Part(const Values& x, std::size_t width, std::size_t first, std::size_t count)
{
  Values out(x.size() / width * count);
  for (std::size_t i = 0; i < x.size() / width; ++i)
  {
    std::copy_n(&x[i * width + first], count, &out[i * count]);
  }
  return out;
}

/// One solve: the bands' columns and, where it is wanted, one for the bound of the inverse.
class Solve
{
public:
  Solve(const FormFactorOperator& op, const DiffuseScattering& scattering, const Values& source,
    std::size_t bands, const SolveOptions& options, const std::vector<std::int32_t>& cell,
    const StageProgress& stage)
    : F(op)
    , Source(source)
    , N(op.Size())
    , Bands(bands)
    , Options(options)
    , Cell(cell)
    , BandsDiffer(op.Bands() > 0)
    , BoundWanted(!options.InverseBound || !options.InverseBound->empty())
  {
    this->Begin(scattering, stage);
    if (!this->CheckLosses())
    {
      // No cell reflects all in every band, and yet the greatest of all bands would lose nothing.
      this->BandsDiffer = true;
      this->Begin(scattering, stage);
      this->CheckLosses();
    }
    this->BeginBound();
  }

  SolveResult Run();

private:
  void Begin(const DiffuseScattering& scattering, const StageProgress& stage);
  bool CheckLosses();
  [[noreturn]] void FailLossless(std::size_t component, std::size_t band) const;
  void BeginBound();
  bool AcceptBound(const Values& w, const Values& returned, std::size_t columns);
  void BoundByItself();
  double GreatestBound(std::size_t band) const;
  double BoundAt(std::size_t i, std::size_t band) const;
  void TrueResidual();

  const FormFactorOperator& F;
  const Values& Source;
  std::size_t N, Bands;
  const SolveOptions& Options;
  const std::vector<std::int32_t>& Cell;
  bool BandsDiffer, BoundWanted;
  bool HasColumn = false; // the last column is that of the bound
  std::unique_ptr<ReflectionSystem> System;
  Values Emission; // M of each column: 0 for the bound, whose right-hand side is 1
  Values X, R;
  Values Bound;      // w, once it is known
  Values PlainBound; // of each band, a constant; infinite: none
};

/// Losses of a unit irradiance and the first residual, in one application where bands do not
/// differ.
void Solve::Begin(const DiffuseScattering& scattering, const StageProgress& stage)
{
  this->HasColumn = this->BoundWanted && !this->BandsDiffer;
  const std::size_t extra = this->HasColumn ? 1 : 0;
  const std::size_t columns = this->Bands + extra;
  this->System = std::make_unique<ReflectionSystem>(this->F,
    extra ? scattering.Beside(this->Bands, scattering.Greatest(this->Bands), 1) : scattering,
    columns, JoinedComponents(this->F, scattering), this->Options.Threads, stage);
  ReflectionSystem& s = *this->System;

  Values guess(this->N * this->Bands, 0.0), leaving, reflected;
  if (this->Options.Guess && this->Options.Guess->size() == guess.size())
  {
    guess = *this->Options.Guess;
  }
  scattering.Apply(guess.data(), (leaving.resize(guess.size()), leaving.data()), this->Bands);
  for (std::size_t k = 0; k < leaving.size(); ++k)
  {
    leaving[k] += this->Source[k];
  }
  s.Scatter(Values(this->N * columns, 1.0), reflected);
  const bool given = extra && this->Options.InverseBound &&
    this->Options.InverseBound->size() == this->N;
  Values returned, arrived, bound;
  if (this->BandsDiffer)
  {
    s.Exchange(reflected, returned, this->Bands);
    s.Exchange(leaving, arrived, this->Bands);
  }
  else
  {
    std::size_t width = columns + this->Bands;
    Values packed = Beside(reflected, columns, leaving, this->Bands);
    if (given)
    {
      const DiffuseScattering greatest = scattering.Greatest(this->Bands);
      Values scattered(this->N);
      greatest.Apply(this->Options.InverseBound->data(), scattered.data(), 1);
      packed = Beside(packed, width, scattered, 1);
      ++width;
    }
    Values all;
    s.Exchange(packed, all, width);
    returned = Part(all, width, 0, columns);
    arrived = Part(all, width, columns, this->Bands);
    bound = given ? Part(all, width, width - 1, 1) : Values();
  }
  s.SetLoss(returned);
  for (std::size_t k = 0; k < arrived.size(); ++k)
  {
    arrived[k] -= guess[k];
  }
  const Values none(this->N, 0.0), one(this->N, 1.0);
  this->X = extra ? Beside(guess, this->Bands, none, 1) : std::move(guess);
  this->R = extra ? Beside(arrived, this->Bands, one, 1) : std::move(arrived);
  this->Emission = extra ? Beside(this->Source, this->Bands, none, 1) : this->Source;
  if (given)
  {
    this->AcceptBound(*this->Options.InverseBound, bound, 1);
  }
}

/// Components that lose nothing have no solution with a source, and none is needed without. False
/// where one loses something in a band but nothing in the column of the bound.
bool Solve::CheckLosses()
{
  ReflectionSystem& s = *this->System;
  for (std::size_t c = 0; c < s.Components(); ++c)
  {
    bool all = true;
    for (std::size_t b = 0; b < s.Columns; ++b)
    {
      if (s.LossShare(c, b) > Lossless)
      {
        all = false;
        continue;
      }
      if (b == this->Bands && !all)
      {
        return false;
      }
      for (std::size_t i = 0; i < this->N && b < this->Bands; ++i)
      {
        if (static_cast<std::size_t>(s.Component[i]) == c)
        {
          if (this->Source[i * this->Bands + b] > 0.0)
          {
            this->FailLossless(c, b);
          }
          this->X[i * s.Columns + b] = this->R[i * s.Columns + b] = 0.0;
        }
      }
      s.Blacken(c, b);
    }
  }
  return true;
}

void Solve::FailLossless(std::size_t component, std::size_t band) const
{
  const ReflectionSystem& s = *this->System;
  std::vector<std::int32_t> cells;
  double greatest = 0.0;
  for (std::size_t i = 0; i < this->N; ++i)
  {
    if (static_cast<std::size_t>(s.Component[i]) == component)
    {
      cells.push_back(this->Cell.empty() ? static_cast<std::int32_t>(i) : this->Cell[i]);
      greatest = std::max(greatest, s.Scattering.Reflectance[i * s.Columns + band]);
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  std::string list;
  for (std::size_t k = 0; k < std::min<std::size_t>(5, cells.size()); ++k)
  {
    list += (k ? ", " : "") + std::to_string(cells[k]);
  }
  throw InputError("DiffuseReflectance", cells.front(), greatest,
    "less than 1 somewhere: this cell belongs to a closed cavity of " +
      std::to_string(cells.size()) + " cells (" + list + (cells.size() > 5 ? ", ..." : "") +
      ") that has a source of light and absorbs none" +
      (this->Bands > 1 ? " in band " + std::to_string(band) : std::string()) +
      ", so its radiosity has no finite value. Lower the reflectance of some of these cells, open "
      "the cavity or take the light out of it");
}

/// What is known of the inverse before any step: where each row loses a good part, no more is
/// needed.
void Solve::BeginBound()
{
  const Values least = this->System->LeastLoss();
  this->PlainBound.assign(this->Bands, Infinity);
  bool plain = true;
  for (std::size_t b = 0; b < this->Bands; ++b)
  {
    this->PlainBound[b] = least[b] > 0.0 ? 1.0 / least[b] : Infinity;
    plain = plain && least[b] >= PlainLoss;
  }
  if (!this->BoundWanted || !this->Bound.empty())
  {
    return;
  }
  if (plain)
  {
    this->Bound.assign(this->BandsDiffer ? this->N * this->Bands : this->N,
      *std::max_element(this->PlainBound.begin(), this->PlainBound.end()));
  }
  else if (this->BandsDiffer)
  {
    this->BoundByItself();
  }
}

/// Takes w where (I - F R) w > 0 < w; `returned` is F R w.
bool Solve::AcceptBound(const Values& w, const Values& returned, std::size_t columns)
{
  Values least(columns, Infinity);
  for (std::size_t k = 0; k < w.size(); ++k)
  {
    least[k % columns] = std::min({ least[k % columns], w[k] - returned[k], w[k] });
  }
  if (*std::min_element(least.begin(), least.end()) < 0.5)
  {
    return false;
  }
  this->Bound = w;
  for (std::size_t k = 0; k < w.size(); ++k)
  {
    this->Bound[k] /= least[k % columns];
  }
  return true;
}

/// The bound of each band where the exchange differs by band: a system of its own.
void Solve::BoundByItself()
{
  ReflectionSystem& s = *this->System;
  const Values* given = this->Options.InverseBound;
  Values w(this->N * this->Bands, 0.0), r(w.size(), 1.0), scattered, returned;
  if (given && given->size() == w.size())
  {
    s.Scatter(*given, scattered);
    s.Exchange(scattered, returned, this->Bands);
    if (this->AcceptBound(*given, returned, this->Bands))
    {
      return;
    }
  }
  double area = 0.0;
  for (const double a : this->F.Areas())
  {
    area += a;
  }
  double goal = 0.02 * std::sqrt(area);
  for (int cycle = 0; cycle < 20 && this->Bound.empty(); ++cycle)
  {
    s.Cycle(Values(this->Bands, goal), LongestCycle, r, w);
    s.Scatter(w, scattered);
    s.Exchange(scattered, returned, this->Bands);
    this->AcceptBound(w, returned, this->Bands);
    for (std::size_t k = 0; k < r.size(); ++k)
    {
      r[k] = 1.0 - w[k] + returned[k];
    }
    goal *= 0.25;
  }
}

double Solve::BoundAt(std::size_t i, std::size_t band) const
{
  const double w = this->Bound.empty()
    ? Infinity
    : this->Bound[this->Bound.size() == this->N ? i : i * this->Bands + band];
  return std::min(w, this->PlainBound[band]);
}

double Solve::GreatestBound(std::size_t band) const
{
  if (!this->BoundWanted)
  {
    return 1.0;
  }
  double greatest = 0.0;
  if (!this->Bound.empty())
  {
    for (std::size_t i = 0; i < this->N; ++i)
    {
      greatest = std::max(greatest, this->BoundAt(i, band));
    }
    return greatest;
  }
  // Not known yet: what an even loss would make of it.
  const ReflectionSystem& s = *this->System;
  for (std::size_t c = 0; c < s.Components(); ++c)
  {
    greatest = std::max(greatest, 2.0 / s.LossShare(c, s.Columns - 1));
  }
  return std::min({ greatest, this->PlainBound[band], 1e12 });
}

/// R = F (M + R X) - X (and 1 + F R X - X for the bound), with the energy of each component
/// balanced.
void Solve::TrueResidual()
{
  ReflectionSystem& s = *this->System;
  Values leaving;
  s.Scatter(this->X, leaving);
  for (std::size_t k = 0; k < leaving.size(); ++k)
  {
    leaving[k] += this->Emission[k];
  }
  s.Exchange(leaving, this->R, s.Columns);
  if (this->HasColumn && this->Bound.empty())
  {
    this->AcceptBound(
      Part(this->X, s.Columns, this->Bands, 1), Part(this->R, s.Columns, this->Bands, 1), 1);
  }
  for (std::size_t k = 0; k < this->R.size(); ++k)
  {
    const bool bound = this->HasColumn && k % s.Columns == this->Bands;
    this->R[k] += (bound ? 1.0 : 0.0) - this->X[k];
    if (bound && !this->Bound.empty())
    {
      this->R[k] = 0.0;
    }
  }
  s.Balance(this->R, this->X);
}

SolveResult Solve::Run()
{
  ReflectionSystem& s = *this->System;
  double area = 0.0;
  for (const double a : this->F.Areas())
  {
    area += a;
  }
  if (this->HasColumn && !this->Bound.empty())
  {
    for (std::size_t k = this->Bands; k < this->R.size(); k += s.Columns)
    {
      this->R[k] = 0.0;
    }
  }
  s.Balance(this->R, this->X);
  SolveResult result;
  Values best = this->X, bestResidual(this->Bands, Infinity), leaving;
  double strictness = 0.25, boundGoal = 0.02 * std::sqrt(area);
  int stalls = 0;
  for (int cycle = 1;; ++cycle)
  {
    s.Scatter(this->X, leaving);
    for (std::size_t k = 0; k < leaving.size(); ++k)
    {
      leaving[k] += this->Emission[k];
    }
    const Values mean = s.Mean(leaving), size = s.Greatest(this->X);
    Values goal(s.Columns, this->Bound.empty() && this->BoundWanted ? boundGoal : Infinity);
    Values wanted(this->Bands);
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      wanted[b] = std::max(
        this->Options.Tolerance * mean[b] / this->GreatestBound(b), 4.0 * Epsilon * size[b]);
      goal[b] = strictness * wanted[b] * std::sqrt(area);
    }
    s.Cycle(goal, this->Options.MaximumIterations - s.Iterations, this->R, this->X);
    this->TrueResidual();
    const Values greatest = s.Greatest(this->R);
    bool done = !this->BoundWanted || !this->Bound.empty(), better = !done && cycle < 12;
    bool rounding = true;
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      const double allowed = this->Options.Tolerance * mean[b] / this->GreatestBound(b);
      done = done && greatest[b] <= allowed;
      rounding = rounding && greatest[b] <= std::max(allowed, 64.0 * Epsilon * size[b]);
      better = better || greatest[b] < 0.5 * bestResidual[b];
      if (greatest[b] < bestResidual[b])
      {
        bestResidual[b] = greatest[b];
        for (std::size_t k = b; k < this->X.size(); k += s.Columns)
        {
          best[k] = this->X[k];
        }
      }
    }
    strictness = std::max(0.25 * strictness, 1e-3);
    boundGoal *= 0.25;
    stalls = better ? 0 : stalls + 1;
    if (done || (rounding && stalls >= 1) || stalls >= 8)
    {
      break;
    }
    if (s.Iterations >= this->Options.MaximumIterations)
    {
      result.Converged = false;
      break;
    }
  }

  result.Irradiance = Part(best, s.Columns, 0, this->Bands);
  s.Scatter(best, leaving);
  result.Radiosity = Part(leaving, s.Columns, 0, this->Bands);
  result.Error.resize(result.Irradiance.size());
  const Values size = s.Greatest(best);
  for (std::size_t k = 0; k < result.Error.size(); ++k)
  {
    const std::size_t b = k % this->Bands;
    result.Radiosity[k] += this->Source[k];
    result.Error[k] = (bestResidual[b] + Rounding * size[b]) *
      (this->BoundWanted ? this->BoundAt(k / this->Bands, b) : 1.0);
    result.Residual = std::max(result.Residual, bestResidual[b]);
  }
  result.InverseBound = this->Bound;
  if (this->BoundWanted && this->Bound.empty())
  {
    result.InverseBound.assign(this->N, Infinity);
  }
  result.Iterations = s.Iterations;
  result.Component = s.Component;
  for (std::size_t c = 0; c < s.Components(); ++c)
  {
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      result.LossShare.push_back(s.LossShare(c, b));
    }
  }
  return result;
}

} // namespace

SolveResult SolveRadiosity(const FormFactorOperator& F, const DiffuseScattering& scattering,
  const std::vector<double>& source, int bands, const SolveOptions& options,
  const std::vector<std::int32_t>& cell, const StageProgress& stage)
{
  const std::size_t n = F.Size();
  const auto nb = static_cast<std::size_t>(bands);
  SolveResult result;
  result.Radiosity = source;
  result.Irradiance.assign(n * nb, 0.0);
  result.Error.assign(n * nb, 0.0);
  const auto zero = [](double v) { return v == 0.0; };
  if (n == 0 || std::all_of(source.begin(), source.end(), zero))
  {
    return result;
  }
  if (scattering.Black())
  {
    F.Apply(source.data(), result.Irradiance.data(), bands);
    result.Iterations = 1;
    return result;
  }
  return Solve(F, scattering, source, nb, options, cell, stage).Run();
}

} // namespace radiometry
