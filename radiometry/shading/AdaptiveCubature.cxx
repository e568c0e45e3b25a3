// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/shading/AdaptiveCubature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace radiometry
{
namespace
{

using Integrand = std::function<double(double, double)>;

/// 4-point Gauss-Legendre rule on [0, 1].
constexpr std::array<double, 4> Node{ { 0.06943184420297371, 0.33000947820757187,
  0.66999052179242813, 0.93056815579702629 } };
constexpr std::array<double, 4> Weight{ { 0.17392742256872693, 0.32607257743127307,
  0.32607257743127307, 0.17392742256872693 } };

constexpr int FirstCells = 4; // a side
constexpr int CellEvaluations = 64;

double GaussSquare(const Integrand& f, double u, double v, double side)
{
  double sum = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < 4; ++j)
    {
      sum += Weight[i] * Weight[j] * f(u + side * Node[i], v + side * Node[j]);
    }
  }
  return sum * side * side;
}

/// A square, its four quarters' integrals and what they differ by from its own. Never less than an
/// eighth of what its parent's quarters had by area: a kink between the edge and the first points
/// changes nothing, but was seen before.
struct Cell
{
  Cell(const Integrand& f, double u, double v, double side, double whole, double inherited)
    : U(u)
    , V(v)
    , Side(side)
  {
    for (int q = 0; q < 4; ++q)
    {
      this->Quarters[q] =
        GaussSquare(f, u + 0.5 * side * (q & 1), v + 0.5 * side * (q >> 1), 0.5 * side);
      this->Value += this->Quarters[q];
    }
    this->Change = std::max(std::abs(this->Value - whole), inherited);
  }
  bool operator<(const Cell& other) const { return this->Change < other.Change; }

  double U, V, Side;
  std::array<double, 4> Quarters{};
  double Value = 0.0;
  double Change = 0.0;
};

} // namespace

CubatureResult IntegrateUnitSquare(
  const Integrand& f, double relativeTolerance, long long evaluations)
{
  std::vector<Cell> cells;
  CubatureResult result;
  double size = 0.0; // of the absolute values, so that cancellation does not ask for the impossible
  const auto add = [&](double u, double v, double side, double whole, double inherited) {
    cells.emplace_back(f, u, v, side, whole, inherited);
    std::push_heap(cells.begin(), cells.end());
    result.Evaluations += CellEvaluations;
  };
  for (int i = 0; i < FirstCells * FirstCells; ++i)
  {
    const double side = 1.0 / FirstCells;
    const double u = side * (i % FirstCells);
    const double v = side * (i / FirstCells);
    result.Evaluations += CellEvaluations / 4;
    add(u, v, side, GaussSquare(f, u, v, side), 0.0);
  }
  for (;;)
  {
    result.Value = result.Error = size = 0.0;
    for (const Cell& cell : cells)
    {
      result.Value += cell.Value;
      result.Error += cell.Change;
      size += std::abs(cell.Value);
    }
    if (!(result.Error > relativeTolerance * size) || result.Evaluations >= evaluations)
    {
      return result;
    }
    // Sums are taken anew after each eighth of the cells has been divided: cheap and exact.
    for (std::size_t n = std::max<std::size_t>(1, cells.size() / 8); n > 0; --n)
    {
      std::pop_heap(cells.begin(), cells.end());
      const Cell parent = cells.back();
      cells.pop_back();
      const double half = 0.5 * parent.Side;
      for (int q = 0; q < 4; ++q)
      {
        add(parent.U + half * (q & 1), parent.V + half * (q >> 1), half,
          parent.Quarters[q], parent.Change / 32.0);
      }
    }
  }
}

} // namespace radiometry
