// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/FormFactorOperator.h"
#include "radiometry/scene/Parallel.h"

#include <vector>

namespace radiometry
{

struct SolveOptions
{
  double Tolerance = 1e-6; // of the solver's error, relative to the mean radiosity of a band
  int MaximumIterations = 400;
  /// Bounds of the inverse from an earlier solve of (nearly) the same system, to save their cost;
  /// null: found anew. Empty: none wanted, and the tolerance is one of the residual.
  const std::vector<double>* InverseBound = nullptr;
  /// Where to begin; null: at the source.
  const std::vector<double>* Guess = nullptr;
};

/// Layout of all: element by element, `bands` values each.
struct SolveResult
{
  std::vector<double> Radiosity;    // B, W/m^2
  std::vector<double> Irradiance;   // F B: what arrives from elements, W/m^2
  std::vector<double> InverseBound; // w of each element, see below
  std::vector<double> Error; // bound on |Radiosity - exact solution of the discrete equation|
  int Iterations = 0;        // applications of the operator
  double Residual = 0.0;     // greatest |M + rho F B - B|, W/m^2
  bool Converged = true;     // false: stopped by the limit of iterations
};

/// Solves B = M + rho F B for all bands over one operator.
///   Method  restarted GMRES in the area-weighted norm, all bands in step; between restarts the
///           constant mode of each component of mutual visibility is solved exactly, so that a
///           closed cavity of reflectance 0.999999 costs no more steps than one of 0.9
///   Error   |B - exact|_i <= max|r| w_i with (I - rho F) w >= 1 > 0, w from the same solver
///           (I - rho F is an M-matrix; any such w bounds its inverse)
///   Source  Saad and Schultz (1986); Varah (1975) for the bound
///   Fails   InputError{"DiffuseReflectance"} where a component loses no light at all (reflectance
///           1 everywhere and no opening) and yet has a source: there is no solution. Without a
///           source its radiosity is 0
/// `cell` names each element's cell in messages; empty: the element itself.
SolveResult SolveRadiosity(const FormFactorOperator& F, const std::vector<double>& reflectance,
  const std::vector<double>& source, int bands, const SolveOptions& options = {},
  const std::vector<std::int32_t>& cell = {}, const StageProgress& stage = {});

} // namespace radiometry
