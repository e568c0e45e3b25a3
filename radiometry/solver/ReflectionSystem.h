// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/FormFactorOperator.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/solver/DiffuseScattering.h"

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace radiometry
{

/// The linear system (I - F R) E = F M for the irradiance E that elements send each other, several
/// columns (bands, or right-hand sides of one) side by side, and the iteration on it.
///
/// In terms of irradiance every row of F R sums to at most one, even where rows of F exceed one
/// because light comes over mirrors: the matrix is an M-matrix.
class ReflectionSystem
{
public:
  using Values = std::vector<double>; // elements x columns

  /// `component` labels elements that exchange light, from 0.
  ReflectionSystem(const FormFactorOperator& op, DiffuseScattering scattering, std::size_t columns,
    std::vector<std::int32_t> component, int threads, const StageProgress& progress);

  /// out = F x for `columns` interleaved columns: the one costly step, counted.
  void Exchange(const Values& x, Values& out, std::size_t columns);
  /// out = R x
  void Scatter(const Values& x, Values& out) const
  {
    out.resize(x.size());
    this->Scattering.Apply(x.data(), out.data(), this->Columns);
  }

  /// What each row loses of a unit irradiance, (I - F R) 1, from `returned` = F R 1. Needed before
  /// all that follows.
  void SetLoss(const Values& returned);
  /// What a component loses of a unit irradiance, as a share of its area.
  double LossShare(std::size_t component, std::size_t column) const
  {
    return this->LossSum[component * this->Columns + column] / this->ComponentArea[component];
  }
  std::size_t Components() const { return this->ComponentArea.size(); }
  /// The least loss of any row.
  Values LeastLoss() const;
  /// Makes a component black in one column: it keeps nothing and sends nothing.
  void Blacken(std::size_t component, std::size_t column);

  /// Adds to x the constant of each component that balances its energy, and takes its image off
  /// the residual r.
  void Balance(Values& r, Values& x) const;

  /// One cycle of GMRES on (I - F R) d = r: adds d to x and takes its image off r. The constants of
  /// the components and the steps of earlier cycles are kept as directions whose images the
  /// residual is orthogonal to: slow modes that a restart would forget.
  ///   Stops  when the norm of each column of r is below its goal, or after `steps` applications
  void Cycle(const Values& goal, int steps, Values& r, Values& x);

  /// Area-weighted norm, greatest and mean absolute value of each column.
  Values Norm(const Values& v) const;
  Values Greatest(const Values& v) const;
  Values Mean(const Values& v) const;

  const FormFactorOperator& F;
  DiffuseScattering Scattering;
  std::size_t N, Columns;
  std::vector<std::int32_t> Component;
  int Threads;
  StageProgress Progress;
  int Iterations = 0; // applications of the operator
  int Steps = 0;      // of them, steps of cycles

private:
  struct Arnoldi;
  using Body = std::function<void(std::size_t begin, std::size_t end, double* sums)>;
  /// Runs body over blocks of elements on all threads; adds up their sums in the blocks' order.
  Values OverBlocks(std::size_t sums, const Body& body) const;
  /// r -= loss times its share in r of each component (negative: added to x as constants).
  Values ProjectConstants(Values& r) const;
  void AddConstants(const Values& shares, Values& x) const;
  void ProjectOuter(Values& r, std::vector<Values>& shares) const;
  void KeepOuter(Values step, Values image);
  Values Inner(const Values& a, const Values& b) const;

  Values Loss;                               // (I - F R) 1, elements x columns
  Values LossSum, LossSquare, ComponentArea; // components x columns; areas of components
  std::vector<std::pair<Values, Values>> Outer; // steps of earlier cycles, their unit images
};

/// The longest cycle of GMRES, where it fits in so many bytes.
inline constexpr int LongestCycle = 150;
inline constexpr double CycleBytes = 5e8;

} // namespace radiometry
