// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ViewFactors.h"
#include "tests/core/CalibrationExtended.h"
#include "tests/core/CalibrationSuite.h"
#include "tests/core/TestScenes.h"
#include "tests/core/formfactor/ReferenceExchange.h"

#include <algorithm>
#include <cmath>
#include <numeric>

/// View factors. What nothing hides is known from the double contour integral in extended precision
/// (ReferenceExchange.h), what triangles hide from the references of area lights, the sky's share from
/// those of a uniform sky.
namespace test
{
namespace
{

using namespace radiometry;

const double Pi = std::acos(-1.0);

Vec3 Somewhere(Random& random, double size)
{
  return { Uniform(random, -size, size), Uniform(random, -size, size), Uniform(random, -size, size) };
}

Vec3 Way(Random& random)
{
  Vec3 way;
  do
  {
    way = Somewhere(random, 1.0);
  } while (Length(way) > 1.0 || Length(way) < 0.1);
  return Normalized(way);
}

Triangle3 Moved(const Triangle3& t, double scale, const Vec3& by)
{
  return { by + scale * t[0], by + scale * t[1], by + scale * t[2] };
}

Triangle3 Any(Random& random)
{
  return { Somewhere(random, 1.0), Somewhere(random, 1.0), Somewhere(random, 1.0) };
}

double Around(const Triangle3& t)
{
  return Length(t[1] - t[0]) + Length(t[2] - t[1]) + Length(t[0] - t[2]);
}

struct Pair
{
  Triangle3 A, B;
};

/// Turned so that each faces the other where it can.
Pair Facing(Triangle3 a, Triangle3 b)
{
  if (Dot(AreaNormal2(a), Centroid(b) - Centroid(a)) < 0.0)
  {
    std::swap(a[1], a[2]);
  }
  if (Dot(AreaNormal2(b), Centroid(a) - Centroid(b)) < 0.0)
  {
    std::swap(b[1], b[2]);
  }
  return { a, b };
}

Pair Apart(Random& random)
{
  const double distance = Uniform(random, 1.5, 6.0);
  return Facing(Any(random), Moved(Any(random), Uniform(random, 0.2, 2.0), distance * Way(random)));
}

Pair WithAnEdge(Random& random)
{
  const Triangle3 a = Any(random);
  return Facing(a, { a[0], a[1], Somewhere(random, 1.0) });
}

Pair NearParallel(Random& random)
{
  const Triangle3 a = Any(random);
  const double gap = std::pow(10.0, Uniform(random, -3.0, -0.5));
  const Vec3 n = Normalized(AreaNormal2(a));
  const Vec3 shift = Uniform(random, 0.0, 0.5) * (a[1] - a[0]);
  return Facing(a, Moved(a, 1.0, gap * n + shift));
}

/// Small or far: factors from 1e-14 to 1e-4.
Pair Apertures(Random& random)
{
  const double size = std::pow(10.0, Uniform(random, -6.0, -2.0));
  return Facing(Any(random), Moved(Any(random), size, Uniform(random, 2.0, 9.0) * Way(random)));
}

Pair Slivers(Random& random)
{
  Triangle3 a = Any(random);
  a[2] = a[0] + Uniform(random, 0.1, 0.9) * (a[1] - a[0]) +
    std::pow(10.0, Uniform(random, -6.0, -2.0)) * Way(random);
  return Facing(a, Moved(Any(random), 1.0, Uniform(random, 0.5, 2.0) * Way(random)));
}

Pair Flat(Random& random) // a wedge of nearly 180 degrees
{
  const Triangle3 a = Any(random);
  const Vec3 n = Normalized(AreaNormal2(a));
  const Vec3 across = a[0] + a[1] - a[2];
  return Facing(a, { a[1], a[0], across + std::pow(10.0, Uniform(random, -3.0, -1.0)) * n });
}

struct PairKind
{
  const char* Name;
  Pair (*Make)(Random&);
};

ViewFactorOptions Options(Random& random, ViewFactorMethod method, std::uint64_t seed)
{
  constexpr double tolerances[] = { 0.1, 0.03, 0.01 };
  ViewFactorOptions options;
  options.Method = method;
  options.RelativeTolerance = tolerances[random() % 3];
  options.AbsoluteTolerance = 0.1 * options.RelativeTolerance;
  options.Seed = seed;
  return options;
}

/// The value from one patch to another; one without a row is 0, or below what rays may have missed.
Judged Factor(const ViewFactorResult& result, std::int32_t from, std::int32_t to)
{
  Judged judged;
  judged.Scale = 1e-3; // below 1e-18 it is rounding
  if (!result.Unmet.empty())
  {
    const auto i = static_cast<std::size_t>(from), j = static_cast<std::size_t>(to);
    judged.Error =
      std::min(result.Unmet[i], result.Unmet[j] * result.Areas[j] / result.Areas[i]);
  }
  for (const ViewFactorRow& row : result.Rows)
  {
    if (row.From == from && row.To == to)
    {
      judged.Value = row.Value;
      judged.Error = row.Error;
    }
  }
  return judged;
}

/// Each pair in a scene of its own, both ways.
std::vector<Judged> JudgePairs(const PairKind& kind, ViewFactorMethod method, std::uint64_t seed)
{
  Random random(seed);
  std::vector<Judged> values;
  for (int k = 0; k < 6; ++k)
  {
    const Pair pair = kind.Make(random);
    Mesh mesh;
    for (const Triangle3* t : { &pair.A, &pair.B })
    {
      const auto first = static_cast<std::int32_t>(mesh.Points.size());
      mesh.Points.insert(mesh.Points.end(), t->begin(), t->end());
      mesh.Triangles.push_back({ first, first + 1, first + 2 });
    }
    const ViewFactorResult result = ComputeViewFactors(
      mesh.ToScene(), { 0, 1 }, 2, Options(random, method, seed));
    const double exchange = reference::Exchange(pair.A, pair.B);
    // The reference's own rounding: of long doubles that add up to a small rest.
    const double doubt = 1e-18 * Around(pair.A) * Around(pair.B);
    for (const bool back : { false, true })
    {
      Judged one = Factor(result, back ? 1 : 0, back ? 0 : 1);
      one.Exact = exchange / Area(back ? pair.B : pair.A);
      one.ExactError = 1e-13 * one.Exact + doubt / Area(back ? pair.B : pair.A);
      values.push_back(one);
    }
  }
  return values;
}

/// Walls of several triangles in a closed room: every sum is made one.
std::vector<Judged> JudgeRoom(ViewFactorMethod method, std::uint64_t seed)
{
  Random random(seed);
  Mesh mesh;
  mesh.AddBox({ 0, 0, 0 },
    { Uniform(random, 0.5, 3), Uniform(random, 0.5, 3), Uniform(random, 0.5, 3) }, 2, true);
  std::vector<std::int32_t> patch(mesh.Triangles.size());
  for (std::size_t t = 0; t < patch.size(); ++t)
  {
    patch[t] = static_cast<std::int32_t>(t / 4); // two quads
  }
  const auto count = static_cast<std::size_t>(patch.back()) + 1;
  const ViewFactorResult result =
    ComputeViewFactors(mesh.ToScene(), patch, count, Options(random, method, seed));
  const auto at = [&](std::size_t t) {
    const auto& v = mesh.Triangles[t];
    return Triangle3{ mesh.Points[v[0]], mesh.Points[v[1]], mesh.Points[v[2]] };
  };
  std::vector<Judged> values;
  for (int k = 0; k < 12; ++k)
  {
    const std::size_t i = random() % count, j = random() % count;
    double exchange = 0.0, area = 0.0;
    for (std::size_t a = 4 * i; a < 4 * i + 4; ++a)
    {
      area += Area(at(a));
      for (std::size_t b = 4 * j; b < 4 * j + 4 && i != j; ++b)
      {
        exchange += reference::Exchange(at(a), at(b));
      }
    }
    Judged one = Factor(result, static_cast<std::int32_t>(i), static_cast<std::int32_t>(j));
    one.Exact = exchange / area;
    one.ExactError = 1e-12 * one.Exact;
    values.push_back(one);
  }
  return values;
}

/// From the triangles of a floor to a panel, past triangles in between.
std::vector<Judged> JudgeHidden(int blockers, ViewFactorMethod method, std::uint64_t seed)
{
  Random random(seed);
  CalibrationScene scene = MakeCalibrationScene(random, 2, blockers, 0.5);
  const PointReference reference = AreaKinds().front().Place(scene, random);
  const Light panel = scene.Scene.Lights[0];
  const std::size_t floor = scene.FloorTriangles;
  std::vector<std::int32_t> patch(floor + scene.Blockers.size() + 2, -1);
  std::iota(patch.begin(), patch.begin() + static_cast<std::ptrdiff_t>(floor), 0);
  patch[patch.size() - 2] = patch.back() = static_cast<std::int32_t>(floor);
  const ViewFactorResult result = ComputeViewFactors(WithTriangles(scene, FanOf(scene, panel)),
    patch, floor + 1, Options(random, method, seed));
  std::vector<Judged> values;
  for (std::size_t t = 0; t < floor; ++t)
  {
    const Integral exact = OverCell(reference, scene.Floor[t], scene.Blockers);
    Judged one =
      Factor(result, static_cast<std::int32_t>(t), static_cast<std::int32_t>(floor));
    one.Exact = exact.Value / panel.Intensity[0];
    one.ExactError = exact.Error / panel.Intensity[0];
    values.push_back(one);
  }
  return values;
}

/// What the triangles of a floor see of the sky.
std::vector<Judged> JudgeSky(int blockers, ViewFactorMethod method, std::uint64_t seed)
{
  Random random(seed);
  CalibrationScene scene = MakeCalibrationScene(random, 2, blockers, 0.5);
  const PointReference reference = SkyKinds().front().Place(scene, random);
  const double whole = Pi * scene.Scene.Lights[0].Intensity[0];
  const std::size_t floor = scene.FloorTriangles;
  std::vector<std::int32_t> patch(floor + scene.Blockers.size(), -1);
  std::iota(patch.begin(), patch.begin() + static_cast<std::ptrdiff_t>(floor), 0);
  const ViewFactorResult result =
    ComputeViewFactors(WithTriangles(scene, {}), patch, floor, Options(random, method, seed));
  std::vector<Judged> values;
  for (std::size_t t = 0; t < floor; ++t)
  {
    const Integral exact = OverCell(reference, scene.Floor[t], scene.Blockers);
    Judged one;
    one.Value = result.Sky.Value[t];
    one.Error = result.Sky.Error[t];
    one.Exact = exact.Value / whole;
    one.ExactError = exact.Error / whole;
    one.Scale = 1e-3;
    values.push_back(one);
  }
  return values;
}

} // namespace

void AddViewFactorParts(std::vector<SuitePart>& parts)
{
  static const PairKind kinds[] = { { "two triangles apart", Apart }, { "a shared edge", WithAnEdge },
    { "near and parallel", NearParallel }, { "small or far", Apertures }, { "a sliver", Slivers },
    { "a wedge of nearly 180 degrees", Flat } };
  static const std::pair<const char*, ViewFactorMethod> methods[] = {
    { "Dense", ViewFactorMethod::Dense }, { "Hierarchical", ViewFactorMethod::Hierarchical },
    { "MonteCarlo", ViewFactorMethod::MonteCarlo }
  };
  const std::string group = "view factors";
  for (const auto& [name, method] : methods)
  {
    const auto m = method;
    const bool rays = m == ViewFactorMethod::MonteCarlo;
    for (const PairKind& kind : kinds)
    {
      // Of two triangles there are no clusters: Hierarchical is Dense.
      if (m != ViewFactorMethod::Hierarchical)
      {
        parts.push_back({ group, kind.Name, name,
          [&kind, m](std::uint64_t seed) { return JudgePairs(kind, m, seed); }, rays ? 0.4 : 0.1 });
      }
    }
    parts.push_back({ group, "a closed room", name,
      [m](std::uint64_t seed) { return JudgeRoom(m, seed); }, 0.3 });
    parts.push_back({ group, "partly hidden", name,
      [m](std::uint64_t seed) { return JudgeHidden(12, m, seed); }, 0.2 });
    parts.push_back({ group, "sky, partly hidden", name,
      [m](std::uint64_t seed) { return JudgeSky(12, m, seed); }, 10.0 });
  }
}

} // namespace test
