// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/CalibrationExtended.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace test
{
namespace
{

using namespace radiometry;

struct Blocking
{
  const char* Name;
  int Count;
  double Size;
};

struct Drawn
{
  CalibrationScene Scene;
  PointReference Reference;
};

Drawn Draw(const ExtendedKind& kind, const Blocking& b, int floorCells, Random& random)
{
  Drawn drawn{ MakeCalibrationScene(random, floorCells, b.Count, b.Size), {} };
  drawn.Reference = kind.Place(drawn.Scene, random);
  return drawn;
}

/// Mean over the centroids of n x n triangles of the same shape as the cell.
double Mean(const Triangle3& cell, int n, const std::function<double(const Vec3&)>& f)
{
  const Vec3 a = (cell[1] - cell[0]) / n;
  const Vec3 b = (cell[2] - cell[0]) / n;
  double sum = 0.0;
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i + j < n; ++i)
    {
      sum += f(cell[0] + (i + 1.0 / 3) * a + (j + 1.0 / 3) * b);
      if (i + j + 1 < n)
      {
        sum += f(cell[0] + (i + 2.0 / 3) * a + (j + 2.0 / 3) * b);
      }
    }
  }
  return sum / (n * n);
}

/// Gauss-Legendre about the corner of each of 4^depth parts, of a function that is smooth.
double SmoothMean(
  const Triangle3& cell, int depth, bool fine, const std::function<double(const Vec3&)>& f)
{
  if (depth > 0)
  {
    const Vec3 a = 0.5 * (cell[0] + cell[1]);
    const Vec3 b = 0.5 * (cell[1] + cell[2]);
    const Vec3 c = 0.5 * (cell[2] + cell[0]);
    double sum = 0.0;
    for (const Triangle3& part : { Triangle3{ cell[0], a, c }, Triangle3{ a, cell[1], b },
           Triangle3{ c, b, cell[2] }, Triangle3{ a, b, c } })
    {
      sum += 0.25 * SmoothMean(part, depth - 1, fine, f);
    }
    return sum;
  }
  // Nodes and weights on [0, 1] of 10 points, or 6 for an estimate of their error.
  static const double x10[] = { 0.013046735741414140, 0.067468316655507744, 0.16029521585048780,
    0.28330230293537640, 0.42556283050918439, 0.57443716949081561, 0.71669769706462360,
    0.83970478414951220, 0.93253168334449226, 0.98695326425858586 };
  static const double w10[] = { 0.033335672154344069, 0.074725674575290296, 0.10954318125799102,
    0.13463335965499818, 0.14776211235737644, 0.14776211235737644, 0.13463335965499818,
    0.10954318125799102, 0.074725674575290296, 0.033335672154344069 };
  static const double x6[] = { 0.033765242898423987, 0.16939530676686774, 0.38069040695840155,
    0.61930959304159845, 0.83060469323313226, 0.96623475710157601 };
  static const double w6[] = { 0.085662246189585173, 0.18038078652406930, 0.23395696728634552,
    0.23395696728634552, 0.18038078652406930, 0.085662246189585173 };
  const int n = fine ? 10 : 6;
  const double* x = fine ? x10 : x6;
  const double* w = fine ? w10 : w6;
  double sum = 0.0;
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      const Vec3 edge = (1.0 - x[j]) * cell[1] + x[j] * cell[2];
      sum += 2.0 * x[i] * w[i] * w[j] * f((1.0 - x[i]) * cell[0] + x[i] * edge);
    }
  }
  return sum;
}

} // namespace

Integral OverCell(
  const PointReference& reference, const Triangle3& cell, const std::vector<Triangle3>& blockers)
{
  const bool smooth = blockers.empty();
  double inner = 0.0;
  const auto at = [&](const Vec3& p) {
    const Integral one = reference(p, blockers, smooth ? 1e-10 : 1e-5);
    inner = std::max(inner, one.Error);
    return one.Value;
  };
  const double fine = smooth ? SmoothMean(cell, 2, true, at) : Mean(cell, 12, at);
  const double coarse = smooth ? SmoothMean(cell, 2, false, at) : Mean(cell, 6, at);
  return { fine, inner + std::fabs(fine - coarse) };
}

namespace
{

std::vector<Judged> JudgeCells(const ExtendedKind& kind, const Blocking& b, std::uint64_t seed)
{
  Random random(seed);
  const Drawn drawn = Draw(kind, b, 2, random);
  std::vector<Judged> values = ComputeCells(drawn.Scene);
  for (std::size_t t = 0; t < values.size(); ++t)
  {
    const Integral exact = OverCell(drawn.Reference, drawn.Scene.Floor[t], drawn.Scene.Blockers);
    values[t].Exact = exact.Value;
    values[t].ExactError = exact.Error;
  }
  return values;
}

void JudgeAt(const Drawn& drawn, const std::vector<Vec3>& points, std::vector<Judged>& values)
{
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Integral exact = drawn.Reference(
      points[i], drawn.Scene.Blockers, drawn.Scene.Blockers.size() > 100 ? 1e-5 : 1e-7);
    values[i].Exact = exact.Value;
    values[i].ExactError = exact.Error;
  }
}

std::vector<Judged> JudgePoints(const ExtendedKind& kind, const Blocking& b, std::uint64_t seed)
{
  Random random(seed);
  const Drawn drawn = Draw(kind, b, 2, random);
  std::vector<Vec3> points;
  for (int k = 0; k < 32; ++k)
  {
    points.push_back({ Uniform(random, -2, 2), Uniform(random, -2, 2), 0.0 });
  }
  std::vector<Judged> values = ComputePoints(drawn.Scene, points);
  JudgeAt(drawn, points, values);
  return values;
}

std::vector<Judged> JudgeVertices(const ExtendedKind& kind, const Blocking& b, std::uint64_t seed)
{
  Random random(seed);
  constexpr int floorCells = 7;
  const Drawn drawn = Draw(kind, b, floorCells, random);
  std::vector<Vec3> vertices;
  for (int j = 1; j < floorCells; ++j)
  {
    for (int i = 1; i < floorCells; ++i)
    {
      vertices.push_back(drawn.Scene.Floor[2 * (j * floorCells + i)][0]);
    }
  }
  std::vector<Judged> values = ComputeVertices(drawn.Scene, vertices);
  JudgeAt(drawn, vertices, values);
  return values;
}

} // namespace

void AddExtendedCases(std::vector<CalibrationCase>& cases, const std::vector<ExtendedKind>& kinds)
{
  static const Blocking open{ "none", 0, 0.0 };
  static const Blocking few{ "12 triangles", 12, 0.5 };
  static const Blocking many{ "400 triangles", 400, 0.12 };
  for (const ExtendedKind& kind : kinds)
  {
    for (const Blocking& b : { open, few, many })
    {
      const auto run = [kind, b](auto judge) {
        return [kind, b, judge](std::uint64_t seed) { return judge(kind, b, seed); };
      };
      // A sky's reference integrates over a wide plane.
      const bool slow = std::string(kind.Name).rfind("sky", 0) == 0 && b.Count > 0;
      if (b.Count == 0 || kind.Blocked)
      {
        if (b.Count < 100) // a cell's reference needs hundreds of points
        {
          cases.push_back({ kind.Name, b.Name, "cells", run(JudgeCells), slow });
        }
        cases.push_back({ kind.Name, b.Name, "points", run(JudgePoints), slow && b.Count > 100 });
        if (b.Count > 0)
        {
          cases.push_back({ kind.Name, b.Name, "vertices", run(JudgeVertices), slow && b.Count > 100 });
        }
      }
    }
  }
}

} // namespace test
