// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/Calibration.h"

#include "radiometry/irradiance/DirectIrradiance.h"
#include "radiometry/irradiance/IrradianceSimulation.h"
#include "tests/core/TestScenes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace test
{

using namespace radiometry;

void Calibration::Add(const Judged& v)
{
  const double difference = std::fabs(v.Value - v.Exact);
  // False for NaN. A sum of the scene's values is known to its rounding only.
  const bool covered = difference <= v.Error + v.ExactError + 1e-15 * v.Scale;
  if (v.Error <= std::max(1e-9 * std::fabs(v.Value), 1e-12 * v.Scale))
  {
    ++this->Exact;
    this->ExactCovered += covered ? 1 : 0;
    this->WorstExact = std::max(this->WorstExact, difference / std::max(v.Exact, 1e-9 * v.Scale));
  }
  else if (!(v.ExactError <= v.Error / 3.0))
  {
    ++this->Undecided;
  }
  else
  {
    ++this->Estimated;
    this->EstimatedCovered += covered ? 1 : 0;
    this->Ratios.push_back(v.Error / std::max(difference, std::numeric_limits<double>::min()));
  }
}

void Calibration::Add(const Calibration& o)
{
  this->Exact += o.Exact;
  this->ExactCovered += o.ExactCovered;
  this->Estimated += o.Estimated;
  this->EstimatedCovered += o.EstimatedCovered;
  this->Undecided += o.Undecided;
  this->WorstExact = std::max(this->WorstExact, o.WorstExact);
  this->Ratios.insert(this->Ratios.end(), o.Ratios.begin(), o.Ratios.end());
}

double Calibration::Median() const
{
  if (this->Ratios.empty())
  {
    return 0.0;
  }
  std::vector<double> sorted = this->Ratios;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  return sorted[sorted.size() / 2];
}

double Calibration::Coverage() const
{
  const std::size_t all = this->Exact + this->Estimated;
  return all == 0
    ? 0.0
    : static_cast<double>(this->ExactCovered + this->EstimatedCovered) / static_cast<double>(all);
}

std::vector<CalibrationCase> CalibrationCases()
{
  std::vector<CalibrationCase> cases;
  AddBeamCases(cases);
  AddAreaCases(cases);
  AddSkyCases(cases);
  AddVariantCases(cases);
  return cases;
}

double Uniform(Random& random, double lo, double hi)
{
  // Not std::uniform_real_distribution, whose numbers differ between libraries.
  return lo + (hi - lo) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

CalibrationScene MakeCalibrationScene(Random& random, int floorCells, int blockers, double size)
{
  CalibrationScene made;
  Mesh mesh;
  mesh.AddGrid({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, floorCells, floorCells);
  made.FloorTriangles = mesh.Triangles.size();
  for (const auto& t : mesh.Triangles)
  {
    made.Floor.push_back({ mesh.Points[t[0]], mesh.Points[t[1]], mesh.Points[t[2]] });
  }
  for (int k = 0; k < blockers; ++k)
  {
    const Vec3 c{ Uniform(random, -2, 2), Uniform(random, -2, 2), Uniform(random, 0.4, 1.6) };
    Triangle3 leaf;
    for (Vec3& p : leaf)
    {
      p = c + Vec3{ size * Uniform(random, -1, 1), size * Uniform(random, -1, 1),
            std::min(size, 0.2) * Uniform(random, -1, 1) };
    }
    made.Blockers.push_back(leaf);
    const auto first = static_cast<std::int32_t>(mesh.Points.size());
    mesh.Points.insert(mesh.Points.end(), leaf.begin(), leaf.end());
    mesh.Triangles.push_back({ first, first + 1, first + 2 });
  }
  made.Scene = mesh.ToScene();
  constexpr double tolerances[] = { 0.1, 0.03, 0.01, 0.003 };
  made.Tolerance = tolerances[random() % 4];
  return made;
}

Convex2 ShadowOn(double height, const Triangle3& blocker, const Vec3& from)
{
  Convex2 shadow;
  for (const Vec3& p : blocker)
  {
    const double s = (from.z - height) / (from.z - p.z);
    shadow.push_back({ from.x + s * (p.x - from.x), from.y + s * (p.y - from.y) });
  }
  return shadow;
}

bool Blocked(const std::vector<Triangle3>& blockers, const Vec3& from, const Vec3& to)
{
  const Vec3 d = to - from;
  for (const Triangle3& t : blockers)
  {
    // Signed volumes of the segment with each edge: all of one sign where it passes inside.
    const Vec3 a = t[0] - from;
    const Vec3 b = t[1] - from;
    const Vec3 c = t[2] - from;
    const double u = Dot(d, Cross(a, b));
    const double v = Dot(d, Cross(b, c));
    const double w = Dot(d, Cross(c, a));
    if ((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))
    {
      const Vec3 n = AreaNormal2(t);
      const double along = Dot(n, d);
      const double s = along == 0.0 ? -1.0 : Dot(n, a) / along;
      if (s > 0.0 && s < 1.0)
      {
        return true;
      }
    }
  }
  return false;
}

namespace
{

DirectOptions Options(const CalibrationScene& scene)
{
  DirectOptions options;
  options.RelativeTolerance = scene.Tolerance;
  options.Emission = scene.Emission;
  return options;
}

std::vector<Judged> Answers(const DirectResult& result)
{
  std::vector<Judged> answers(result.Irradiance.size());
  for (std::size_t i = 0; i < answers.size(); ++i)
  {
    answers[i].Value = result.Irradiance[i];
    answers[i].Error = result.Error[i];
    answers[i].Scale = result.PeakUnshadowed;
  }
  return answers;
}

} // namespace

std::vector<Judged> ComputeCells(const CalibrationScene& scene)
{
  std::vector<Patch> patches = MakePatches(scene.Scene, scene.Side);
  patches.resize(scene.FloorTriangles);
  return Answers(ComputeDirectIrradiance(
    scene.Scene, OcclusionScene(scene.Scene), patches, Options(scene)));
}

std::vector<Judged> ComputePoints(const CalibrationScene& scene, const std::vector<Vec3>& points)
{
  std::vector<SurfacePoint> places;
  for (const Vec3& p : points)
  {
    SurfacePoint place;
    place.Point = p - scene.Scene.Origin;
    place.Normal = { 0, 0, 1 };
    place.Rounding = 1e-12;
    places.push_back(place);
  }
  return Answers(ComputeDirectIrradiance(
    scene.Scene, OcclusionScene(scene.Scene), places, Options(scene)));
}

std::vector<Judged> ComputeVertices(const CalibrationScene& scene, const std::vector<Vec3>& vertices)
{
  std::vector<SurfacePoint> places;
  for (const Vec3& p : vertices)
  {
    SurfacePoint place;
    place.Point = p - scene.Scene.Origin;
    place.Normal = { 0, 0, 1 };
    for (std::size_t t = 0; t < scene.FloorTriangles; ++t)
    {
      for (const Vec3& corner : scene.Scene.TriangleAt(t))
      {
        if (corner == place.Point)
        {
          place.Triangle = static_cast<std::int32_t>(t);
          place.Around.push_back(place.Triangle);
        }
      }
    }
    places.push_back(place);
  }
  return Answers(ComputeDirectIrradiance(
    scene.Scene, OcclusionScene(scene.Scene), places, Options(scene)));
}

} // namespace test
