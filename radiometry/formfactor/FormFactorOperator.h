// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace radiometry
{

/// How far rows known to see nothing but elements were from summing to one.
struct ClosureReport
{
  std::size_t ClosedRows = 0;     // rows all of whose probes met a receiving element
  double DefectBefore = 0.0;      // greatest |1 - sum_j F_ij| of those rows before correction
  double DefectAfter = 0.0;       // ... and after
  double LargestChange = 0.0;     // greatest relative change of an entry
  double ReciprocityDefect = 0.0; // greatest |A_i F_ij - A_j F_ji| / A; 0 for symmetric storage
};

/// The exchange of diffuse light between n elements: out_i = sum_j F_ij B_j, the irradiance of
/// element i, averaged over it, when element j leaves B_j everywhere. It depends on geometry only:
/// lights and optics may change without building it again.
///
/// Light may pass over mirrors and through panes on its way (Bands() > 0): F_ij is then what of
/// B_j arrives in a band, and rows may sum to more than one.
///
/// Thread-safe after construction; results do not depend on the number of threads. Over ranks
/// (ExchangeOptions::Ranks) each keeps its own rows, and Apply, ApplyError and construction are
/// collective; sizes, values and reports are those of the whole on each rank.
class FormFactorOperator
{
public:
  virtual ~FormFactorOperator() = default;

  virtual std::size_t Size() const = 0;
  /// Areas of the elements, m^2.
  virtual const std::vector<double>& Areas() const = 0;
  /// out = F B for `bands` interleaved right-hand sides (value of element i, band b at i bands + b).
  virtual void Apply(const double* B, double* out, int bands) const = 0;
  /// Bands whose exchange differs; 0: F is the same for all.
  virtual int Bands() const { return 0; }
  /// sum_j F_ij: the share of the hemisphere of i that elements fill.
  virtual double RowSum(std::size_t i, int band = 0) const = 0;
  /// Standard error of each value of F B for a given B, apart for the geometry of the unoccluded
  /// exchange and for visibility (sampled). Same layout as Apply.
  virtual void ApplyError(
    const double* B, double* formFactor, double* visibility, int bands) const = 0;
  /// Elements that exchange light directly or over others share a label, from 0.
  virtual std::vector<std::int32_t> Components() const = 0;
  virtual std::size_t MemoryBytes() const = 0;
  /// Pairs or rays that it took.
  virtual std::int64_t Samples() const = 0;
  virtual ClosureReport Closure() const = 0;
  /// One line for reports.
  virtual std::string Description() const = 0;
};

} // namespace radiometry
