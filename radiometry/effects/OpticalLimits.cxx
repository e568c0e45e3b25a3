// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/effects/OpticalLimits.h"

#include "radiometry/effects/SimulatedScene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace radiometry
{
namespace
{

void Widen(double& to, double value)
{
  to = std::max(to, value);
}

/// One side of a cell, over its bands.
struct Side
{
  const double* Diffuse = nullptr;
  const double* Through = nullptr;
  const double* Specular = nullptr;
  const double* Pane = nullptr;
  const double* Emitted = nullptr;
  bool Mirror = false;
  double Shininess = 0.0;

  static double At(const double* values, std::size_t b) { return values ? values[b] : 0.0; }
};

void Count(const Side& side, std::size_t bands, double area, OpticalLimits& out)
{
  double mean[5] = {};
  const double* const arrays[5] = { side.Diffuse, side.Through, side.Specular, side.Pane,
    side.Emitted };
  double brightest = 0.0;
  for (std::size_t b = 0; b < bands; ++b)
  {
    double v[5];
    for (int k = 0; k < 5; ++k)
    {
      v[k] = Side::At(arrays[k], b);
      mean[k] += v[k] / static_cast<double>(bands);
    }
    Widen(out.Reflected, v[0]);
    Widen(out.Diffused, v[1]);
    Widen(out.Scattered, v[0] + v[1]);
    Widen(out.Specular, v[2]);
    Widen(out.Pane, v[3]);
    Widen(out.Carried, v[2] + v[3]);
    Widen(out.Total, v[0] + v[1] + v[2] + v[3]);
    Widen(out.Mirror, side.Mirror ? v[2] : 0.0);
    if (v[2] > 0.0)
    {
      Widen(out.Lobe, side.Mirror ? std::numeric_limits<double>::infinity()
                                  : 0.5 * v[2] * (side.Shininess + 2.0));
    }
    Widen(brightest, v[4]);
  }
  Widen(out.Emitted, brightest);
  out.EmittedFlux += brightest * area;
  for (std::size_t b = 0; b < bands && bands > 1; ++b)
  {
    const auto off = [&](int k) { return std::fabs(Side::At(arrays[k], b) - mean[k]); };
    Widen(out.Spread.Scattered, off(0) + off(1));
    Widen(out.Spread.Carried, off(2) + off(3));
    Widen(out.Spread.Emitted, off(4));
  }
}

} // namespace

OpticalLimits FindOpticalLimits(const Scene& scene)
{
  OpticalLimits out;
  const Materials& optics = scene.Optics;
  const auto bands = static_cast<std::size_t>(optics.Bands);
  std::vector<double> areas(scene.Cells, 0.0);
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    areas[static_cast<std::size_t>(scene.TriangleCell[t])] += Area(scene.TriangleAt(t));
  }
  const auto of = [&](const std::vector<double>& values, std::size_t cell) {
    return (cell + 1) * bands <= values.size() ? values.data() + cell * bands : nullptr;
  };
  out.SmallestCell = std::numeric_limits<double>::infinity();
  for (std::size_t cell = 0; cell < scene.Cells; ++cell)
  {
    if (!(areas[cell] > 0.0))
    {
      continue;
    }
    out.SmallestCell = std::min(out.SmallestCell, areas[cell]);
    const bool twoSided = cell < optics.TwoSided.size() && optics.TwoSided[cell] != 0;
    out.TwoSided = out.TwoSided || twoSided;
    for (std::size_t side = 0; side < 2; ++side)
    {
      const bool there = side == 0 || twoSided;
      Side s;
      s.Through = of(optics.DiffuseTransmittance, cell); // from either side, whichever receive
      s.Pane = of(optics.Transmittance, cell);
      if (there)
      {
        s.Diffuse = of(OfSide(optics.DiffuseReflectance, side), cell);
        s.Specular = of(OfSide(optics.SpecularReflectance, side), cell);
        s.Emitted = of(optics.EmittedExitance[side], cell);
        s.Mirror = IsMirror(optics, side, cell);
        const std::vector<double>& shininess = OfSide(optics.Shininess, side);
        s.Shininess = shininess.empty() ? DefaultShininess : shininess[cell];
      }
      Count(s, bands, areas[cell], out);
    }
  }
  for (std::size_t t = 0; (t + 1) * bands <= scene.TriangleTransmittance.size(); ++t)
  {
    Side s;
    s.Pane = scene.TriangleTransmittance.data() + t * bands;
    if (t >= scene.ReceiverTriangles)
    {
      Count(s, bands, 0.0, out);
    }
    else
    {
      Widen(out.Pane, *std::max_element(s.Pane, s.Pane + bands));
    }
  }
  return out;
}

} // namespace radiometry
