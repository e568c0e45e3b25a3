// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/FormFactorOperator.h"
#include "radiometry/scene/Parallel.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace radiometry
{

/// The linear system (I - rho F) x = b of several bands, and the iteration on it.
class ReflectionSystem
{
public:
  ReflectionSystem(const FormFactorOperator& op, const std::vector<double>& rho, int bands,
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

/// The longest cycle of GMRES.
inline constexpr int LongestCycle = 60;

/// Positive w with (I - rho F) w >= 1, elementwise: its values bound the inverse. Infinite where
/// none was found.
std::vector<double> BoundOfInverse(ReflectionSystem& system);

} // namespace radiometry
