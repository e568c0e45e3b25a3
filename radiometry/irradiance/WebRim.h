// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/CandelaWeb.h"

#include <cstddef>
#include <vector>

namespace radiometry
{

/// A direction by its angles in the grid, with the cell that it lies in.
struct WebCorner
{
  double Theta, Psi, Sine;
  std::size_t I, J; // as Cell() counts; J is 1 where psi does not matter
};

/// A great-circle arc a cos s + t sin s, s in [0, Length], in the grid's axes.
struct WebEdge
{
  Vec3 A, T, Normal;
  double Length;
  double Lift;            // of the pole over the arc's plane: cosine to its normal
  double Rise;            // greatest cos(theta) on the circle
  double Closest;         // s there
  double Least, Greatest; // theta on the arc

  WebEdge(const Vec3& start, const Vec3& normal, double length);
  Vec3 At(double s) const;
  /// The theta that the arc reaches, from those of its ends and its nearest points to the poles.
  void Reach(double atStart, double atEnd);
  /// Appends s where it lies on the arc.
  void Cut(double s, std::vector<double>& cuts) const;
};

/// The integral along the rim, and where G counts from: a theta near the polygon, or a pole.
struct WebSum
{
  double Theta;
  std::size_t I; // its cell
  bool AtPole;   // Theta is 0 or pi
  double Flux = 0.0;
  double Gross = 0.0; // the sum of the pieces' sizes
  double Rounding = 0.0;
  double Peak = 0.0; // greatest value of the cells that the rim passes
};

/// The integral of G d psi along the rim of a polygon (WebFlux.h), arc by arc.
class WebRim
{
public:
  explicit WebRim(const CandelaWeb::PolarGrid& grid)
    : Grid(grid)
  {
  }
  /// A direction of the grid's axes, of any length but zero.
  WebCorner Locate(const Vec3& direction) const;
  /// Where the arc from a to b crosses lines of the grid (and, near a pole, changes its way of
  /// integration), ascending. `clear`: the polygon is small against its distance from the poles.
  void FindCuts(const WebEdge& edge, const WebCorner& a, const WebCorner& b, bool clear,
    std::vector<double>& cuts) const;
  /// Where G had best count from: it must not be 0 at a pole that the polygon holds or nearly
  /// touches. `facing`: 1 where the arcs turn as those of a front, -1 as those of a back.
  WebSum StartOf(const WebEdge* edges, std::size_t count, const WebCorner& corner, bool clear,
    double facing) const;
  /// Adds the piece of an arc between two cuts.
  void AddPiece(const WebEdge& edge, double from, double to, WebSum& sum) const;

private:
  double Column(std::size_t j, std::size_t i, double theta, const WebSum& about) const;

  const CandelaWeb::PolarGrid& Grid;
};

} // namespace radiometry
