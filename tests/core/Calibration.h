// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Scene.h"
#include "tests/core/ReferenceIntegral.h"

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

/// Are the stated errors of direct light true? Scenes drawn from fixed seeds are computed by the
/// engine and by a reference that shares no code with it, value by value.
///   tests/core/CalibrationTest.cxx      a few seeds of each case, with limits that fail
///   benchmarks/direct_coverage.cxx      many seeds of each case, as a table
namespace test
{

/// One value beside its reference; error 0 is none.
struct Judged
{
  double Value = 0.0;
  double Error = 0.0;
  double Exact = 0.0;
  double ExactError = 0.0;
  double Scale = 0.0; // of the scene's values; what is below 1e-12 of it counts as rounding
};

/// One row of the table: a kind of light, what blocks it and where it is asked for.
struct CalibrationCase
{
  std::string Light;
  std::string Blockers;
  std::string Receivers;
  std::function<std::vector<Judged>(std::uint64_t seed)> Run;
  bool Slow = false; // its reference takes seconds
};

/// The values of a row in classes: exact to rounding (error <= 1e-9 of the value), estimated, and
/// undecided (estimated, but the reference's own error is above a third of the stated one).
struct Calibration
{
  std::size_t Exact = 0;
  std::size_t ExactCovered = 0;
  std::size_t Estimated = 0;
  std::size_t EstimatedCovered = 0;
  std::size_t Undecided = 0;
  double WorstExact = 0.0;    // greatest relative difference of the exact class
  std::vector<double> Ratios; // stated error over true error, of the estimated class

  void Add(const Judged& value);
  void Add(const Calibration& other);
  double Median() const; // of Ratios; 0 when there are none
  double Coverage() const;
};

/// All cases, one kind of light an entry of the lists in Calibration*.cxx.
std::vector<CalibrationCase> CalibrationCases();
void AddAreaCases(std::vector<CalibrationCase>& cases);
void AddBeamCases(std::vector<CalibrationCase>& cases);
void AddSkyCases(std::vector<CalibrationCase>& cases);
void AddVariantCases(std::vector<CalibrationCase>& cases);

// What the cases share.

/// A floor of triangles on z = 0, [-2, 2] squared, and free triangles between z = 0.2 and 1.8.
struct CalibrationScene
{
  radiometry::Scene Scene;
  std::size_t FloorTriangles = 0;
  std::vector<radiometry::Triangle3> Blockers; // absolute coordinates
  std::vector<radiometry::Triangle3> Floor;
  double Tolerance = 0.01;
  int Side = 0;          // of the floor that is asked for
  bool Emission = false; // of emitting triangles counts
};
using Random = std::mt19937_64;
double Uniform(Random& random, double lo, double hi);
CalibrationScene MakeCalibrationScene(Random& random, int floorCells, int blockers, double size);

/// The shadow of a triangle on the plane z = height as seen from a point.
Convex2 ShadowOn(double height, const radiometry::Triangle3& blocker, const radiometry::Vec3& from);
/// True when any of the triangles cuts the open segment.
bool Blocked(const std::vector<radiometry::Triangle3>& blockers, const radiometry::Vec3& from,
  const radiometry::Vec3& to);

/// The same floor and blockers with more triangles behind them, each a cell.
radiometry::Scene WithTriangles(
  const CalibrationScene& scene, const std::vector<radiometry::Triangle3>& more);
/// The triangles of a convex area light.
std::vector<radiometry::Triangle3> FanOf(
  const CalibrationScene& scene, const radiometry::Light& light);

/// The engine's answers for the floor's cells, for points and for the floor's vertices; band by band.
std::vector<Judged> ComputeCells(const CalibrationScene& scene);
std::vector<Judged> ComputePoints(
  const CalibrationScene& scene, const std::vector<radiometry::Vec3>& points);
std::vector<Judged> ComputeVertices(
  const CalibrationScene& scene, const std::vector<radiometry::Vec3>& vertices);

} // namespace test
