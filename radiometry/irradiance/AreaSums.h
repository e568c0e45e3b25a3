// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/AreaReceiver.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// Standard deviations of sampling that make an error.
inline constexpr double AreaDeviations = 2.5;
/// Of the tolerance: what the sources left out may have.
inline constexpr double AreaDroppedShare = 0.1;
/// ... and all that is left out of a value.
inline constexpr double AllDroppedShare = 0.25;
/// A value below this share of the unshadowed one is not resolved any finer.
inline constexpr double AreaDarkestShare = 0.001;

/// Sums over sources, per band.
struct AreaSums
{
  std::vector<double> Value, Variance, Rule, Whole, Rest;

  explicit AreaSums(std::size_t bands)
    : Value(bands, 0.0)
    , Variance(bands, 0.0)
    , Rule(bands, 0.0)
    , Whole(bands, 0.0)
    , Rest(bands, 0.0)
  {
  }
  void Add(const std::vector<double>& exitance, double sign, double value, double variance,
    double rule, double whole)
  {
    for (std::size_t b = 0; b < exitance.size(); ++b)
    {
      const double m = exitance[b];
      this->Value[b] += sign * m * value;
      this->Variance[b] += sign * m * m * variance;
      this->Rule[b] += sign * m * rule;
      this->Whole[b] += m * whole;
    }
  }
  /// Forgets all but the unshadowed sums and the rest.
  void Clear()
  {
    for (std::vector<double>* v : { &this->Value, &this->Variance, &this->Rule })
    {
      std::fill(v->begin(), v->end(), 0.0);
    }
  }
  double Error(std::size_t b) const
  {
    return AreaDeviations * std::sqrt(std::max(0.0, this->Variance[b])) + std::max(0.0, this->Rule[b]);
  }
  double Allowed(std::size_t b, const double* before, const AreaEffort& effort) const
  {
    const double value = std::max(this->Value[b], AreaDarkestShare * this->Whole[b]);
    return std::max(
      effort.RelativeTolerance * (before[b] + value), effort.AbsoluteTolerance);
  }
  bool Met(const double* before, const AreaEffort& effort) const
  {
    for (std::size_t b = 0; b < this->Value.size(); ++b)
    {
      if (this->Error(b) + this->Rest[b] > 0.9 * this->Allowed(b, before, effort))
      {
        return false;
      }
    }
    return true;
  }
  /// True when what is left out cannot matter.
  bool Enough(const double* before, const AreaEffort& effort) const
  {
    for (std::size_t b = 0; b < this->Value.size(); ++b)
    {
      const double value = before[b] + std::max(0.0, this->Value[b]);
      const double allowed =
        std::max(effort.RelativeTolerance * value, effort.AbsoluteTolerance);
      if (this->Rest[b] > 0.0 &&
        (!effort.Drop ||
          this->Rest[b] >
            std::min(AreaDroppedShare * allowed, AllDroppedShare * allowed - effort.Dropped)))
      {
        return false;
      }
    }
    return true;
  }
  AreaLight Result(double rounding) const
  {
    AreaLight light;
    light.Value = this->Value;
    light.Unshadowed = this->Whole;
    light.Error.resize(this->Value.size());
    for (std::size_t b = 0; b < this->Value.size(); ++b)
    {
      light.Value[b] = std::max(0.0, this->Value[b]);
      light.Error[b] = this->Error(b) + this->Rest[b] + rounding * light.Value[b];
      light.Unshadowed[b] += this->Rest[b];
      light.Dropped = std::max(light.Dropped, this->Rest[b]);
    }
    return light;
  }

  /// Visits sources, greatest bound first, until the others cannot matter.
  template <class F>
  void Visit(const AreaSources& sources, const Vec3& center, const Vec3& normal, double radius,
    const double* before, const AreaEffort& effort, F&& visit)
  {
    const auto& groups = sources.Groups();
    if (groups.empty())
    {
      return;
    }
    const std::size_t bands = this->Value.size();
    struct Bound
    {
      double Greatest;
      double Factor;
      std::int32_t Group;
      bool operator<(const Bound& o) const
      {
        return this->Greatest < o.Greatest || (this->Greatest == o.Greatest && this->Group > o.Group);
      }
    };
    const auto bound = [&](const Bound& q, std::size_t b) {
      const AreaSources::Group& g = groups[q.Group];
      return std::min(g.Exitances[b], g.Power[b] > 0.0 ? g.Power[b] * q.Factor : 0.0);
    };
    std::vector<Bound> heap;
    const auto push = [&](std::int32_t g) {
      Bound q{ 0.0, AreaSources::Factor(groups[g], center, normal, radius), g };
      if (q.Factor > 0.0)
      {
        for (std::size_t b = 0; b < bands; ++b)
        {
          const double value = bound(q, b);
          this->Rest[b] += value;
          q.Greatest = std::max(q.Greatest, value);
        }
        heap.push_back(q);
        std::push_heap(heap.begin(), heap.end());
      }
    };
    push(0);
    while (!heap.empty() && !this->Enough(before, effort))
    {
      std::pop_heap(heap.begin(), heap.end());
      const Bound q = heap.back();
      heap.pop_back();
      for (std::size_t b = 0; b < bands; ++b)
      {
        this->Rest[b] = std::max(0.0, this->Rest[b] - bound(q, b));
      }
      const AreaSources::Group& g = groups[q.Group];
      if (g.Source >= 0)
      {
        visit(static_cast<std::size_t>(g.Source));
      }
      else
      {
        push(q.Group + 1);
        push(g.Second);
      }
    }
    // Summed anew: taking away leaves rounding.
    std::fill(this->Rest.begin(), this->Rest.end(), 0.0);
    for (const Bound& q : heap)
    {
      for (std::size_t b = 0; b < bands; ++b)
      {
        this->Rest[b] += bound(q, b);
      }
    }
  }
};

} // namespace radiometry
