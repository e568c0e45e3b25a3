// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/FormFactorOperator.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/solver/DiffuseScattering.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

struct SolveOptions
{
  double Tolerance = 1e-6; // of the solver's error, relative to the mean radiosity of a band
  int MaximumIterations = 400;
  /// Bounds of the inverse from an earlier solve of (nearly) the same system, to save their cost;
  /// they are checked. Null: found anew. Empty: none wanted, and the tolerance is one of the
  /// residual.
  const std::vector<double>* InverseBound = nullptr;
  /// SolveResult::Irradiance of a like system, to begin with; null: none.
  const std::vector<double>* Guess = nullptr;
  int Threads = 0; // 0: all
};

/// Layout of all: element by element, `bands` values each.
struct SolveResult
{
  std::vector<double> Radiosity;    // B = M + R E, W/m^2
  std::vector<double> Irradiance;   // E: what arrives from elements, W/m^2
  std::vector<double> InverseBound; // w, see below: a value an element, or one a band too where
                                    // the operator differs by band
  std::vector<std::int32_t> Component; // of each element: those that exchange light share a label
  std::vector<double> LossShare;       // components x bands: of a unit irradiance, what is lost
  std::vector<double> Error; // bound on |Irradiance - exact solution of the discrete equation|
  int Iterations = 0;        // applications of the operator
  double Residual = 0.0;     // greatest |F B - E|, W/m^2
  bool Converged = true;     // false: stopped by the limit of iterations
};

/// Solves E = F B, B = M + R E for all bands over one operator, R being what elements reflect and
/// let through diffusely.
///   Method  GMRES on (I - F R) E = F M in the area-weighted norm, all bands in step. The constant
///           mode of each component of mutual visibility, and the steps of earlier cycles, are
///           deflated; in the end each component's energy is balanced to rounding. So a closed
///           cavity of reflectance 0.999999 costs no more steps than one of 0.9
///   Error   |E - exact|_i <= max|r| w_i with (I - F R) w >= 1, w > 0 (I - F R is an M-matrix; any
///           such w bounds its inverse): a constant where every row loses a tenth, else from the
///           same iteration, as one more column
///   Cost    some 10 to 25 applications of F, one more where the bound fails at first
///   Source  Saad and Schultz (1986); de Sturler (1996) for the deflation; Varah (1975) for the
///           bound
///   Fails   InputError{"DiffuseReflectance"} where a component loses no light at all (all of it is
///           reflected and there is no opening) and yet has a source: there is no solution. Without
///           a source its irradiance is 0
/// `cell` names each element's cell in messages; empty: the element itself.
SolveResult SolveRadiosity(const FormFactorOperator& F, const DiffuseScattering& scattering,
  const std::vector<double>& source, int bands, const SolveOptions& options = {},
  const std::vector<std::int32_t>& cell = {}, const StageProgress& stage = {});

} // namespace radiometry
