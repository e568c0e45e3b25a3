// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/CalibrationBeams.h"
#include "tests/core/CalibrationExtended.h"
#include "tests/core/TestScenes.h"

#include <stdexcept>
#include <utility>

/// The lights of the other files through panes, on backs, in bands and as emitting surfaces. The
/// references are theirs: the light through panes is a sum over which of them block,
///   prod_i (t_i + (1 - t_i) v_i) = sum over sets U of prod_{U} (1 - t_i) prod_{not U} t_i v_U,
/// v_U what the panes of U would leave if they were opaque.
namespace test
{
namespace
{

using namespace radiometry;

/// A scene with a light, and what the light gives where some triangles block it.
struct Lit
{
  CalibrationScene Scene;
  std::function<Integral(const Triangle3& cell, const std::vector<Triangle3>& blockers)> Cell;
  std::function<Integral(const Vec3& point, const std::vector<Triangle3>& blockers)> Point;
};
using Maker = std::function<Lit(Random& random, int blockers)>;

Lit Place(const BeamKind& kind, Random& random, int blockers)
{
  Lit lit{ MakeCalibrationScene(random, 2, blockers, 0.6), {}, {} };
  const Light light = kind.Make(random);
  Light placed = light;
  placed.Position = light.Position - lit.Scene.Scene.Origin;
  lit.Scene.Scene.Lights = { placed };
  lit.Cell = [light](const Triangle3& cell, const std::vector<Triangle3>& b) {
    const Integral whole = BeamOverCell(light, cell, b, 1e-10);
    return Integral{ whole.Value / Area(cell), whole.Error / Area(cell) };
  };
  lit.Point = [light](const Vec3& p, const std::vector<Triangle3>& b) {
    const double value = BeamAt(light, p, b);
    return Integral{ value, 1e-13 * value };
  };
  return lit;
}

Lit Place(const ExtendedKind& kind, Random& random, int blockers)
{
  Lit lit{ MakeCalibrationScene(random, 2, blockers, 0.6), {}, {} };
  const PointReference reference = kind.Place(lit.Scene, random);
  lit.Cell = [reference](const Triangle3& cell, const std::vector<Triangle3>& b) {
    return OverCell(reference, cell, b);
  };
  lit.Point = [reference](const Vec3& p, const std::vector<Triangle3>& b) {
    return reference(p, b, 1e-9);
  };
  return lit;
}

std::vector<Vec3> Points(Random& random, int count)
{
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k)
  {
    points.push_back({ Uniform(random, -2, 2), Uniform(random, -2, 2), 0.0 });
  }
  return points;
}

using Exact = std::function<Integral(const std::vector<Triangle3>& blockers)>;
/// Compares with what `judge` makes of a receiver's reference, band by band.
using Judge = std::function<Integral(const Lit& lit, const Exact& exact, std::size_t band)>;

std::vector<Judged> Compare(const Lit& lit, bool cells, const std::vector<Vec3>& points, std::size_t bands,
  const Judge& judge)
{
  std::vector<Judged> values = cells ? ComputeCells(lit.Scene) : ComputePoints(lit.Scene, points);
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    const std::size_t i = k / bands;
    const Exact exact = [&](const std::vector<Triangle3>& b) {
      return cells ? lit.Cell(lit.Scene.Floor[i], b) : lit.Point(points[i], b);
    };
    const Integral reference = judge(lit, exact, k % bands);
    values[k].Exact = reference.Value;
    values[k].ExactError = reference.Error;
  }
  return values;
}

std::vector<Judged> ThroughPanes(const Maker& make, bool cells, std::uint64_t seed)
{
  Random random(seed);
  Lit lit = make(random, 4);
  Scene& scene = lit.Scene.Scene;
  std::vector<double> share;
  scene.TriangleTransmittance.assign(scene.Triangles.size(), 0.0);
  scene.Optics.Transmittance.assign(scene.Cells, 0.0);
  for (std::size_t k = 0; k < lit.Scene.Blockers.size(); ++k)
  {
    share.push_back(k == 0 ? 0.0 : Uniform(random, 0.1, 0.95));
    const std::size_t t = lit.Scene.FloorTriangles + k;
    scene.TriangleTransmittance[t] = scene.Optics.Transmittance[t] = share.back();
  }
  return Compare(lit, cells, Points(random, 32), 1, [&](const Lit& l, const Exact& exact, std::size_t) {
    const std::size_t n = share.size();
    Integral sum;
    for (std::size_t set = 0; set < (std::size_t{ 1 } << n); ++set)
    {
      std::vector<Triangle3> blocking;
      double weight = 1.0;
      for (std::size_t k = 0; k < n; ++k)
      {
        const bool in = (set >> k) & 1;
        weight *= in ? 1.0 - share[k] : share[k];
        if (in)
        {
          blocking.push_back(l.Scene.Blockers[k]);
        }
      }
      const Integral one = weight > 0.0 ? exact(blocking) : Integral();
      sum.Value += weight * one.Value;
      sum.Error += weight * one.Error;
    }
    return sum;
  });
}

/// The floor lies face down: its backs are lit.
std::vector<Judged> OnBacks(const Maker& make, std::uint64_t seed)
{
  Random random(seed);
  Lit lit = make(random, 6);
  for (std::size_t t = 0; t < lit.Scene.FloorTriangles; ++t)
  {
    std::swap(lit.Scene.Scene.Triangles[t][1], lit.Scene.Scene.Triangles[t][2]);
    lit.Scene.Scene.Optics.TwoSided[t] = 1;
  }
  lit.Scene.Side = 1;
  return Compare(lit, true, {}, 1, [](const Lit& l, const Exact& exact, std::size_t) {
    return exact(l.Scene.Blockers);
  });
}

/// Three bands of which each has a share of the light.
std::vector<Judged> InBands(const Maker& make, bool cells, std::uint64_t seed)
{
  Random random(seed);
  Lit lit = make(random, 6);
  const double shares[] = { 1.0, Uniform(random, 0.01, 1.0), 0.0 };
  Scene& scene = lit.Scene.Scene;
  scene.Optics.Bands = 3;
  for (auto& side : scene.Optics.DiffuseReflectance)
  {
    side.assign(3 * scene.Cells, 0.5);
  }
  for (Light& light : scene.Lights)
  {
    const double whole = light.Intensity[0];
    light.Intensity = { shares[0] * whole, shares[1] * whole, shares[2] * whole };
  }
  return Compare(
    lit, cells, Points(random, 16), 3, [&](const Lit& l, const Exact& exact, std::size_t band) {
      const Integral one = exact(l.Scene.Blockers);
      return Integral{ shares[band] * one.Value, shares[band] * one.Error };
    });
}

/// The light's outline as triangles that emit.
std::vector<Judged> Emitting(const Maker& make, bool cells, std::uint64_t seed)
{
  Random random(seed);
  Lit lit = make(random, 6);
  const Light light = lit.Scene.Scene.Lights[0];
  lit.Scene.Scene = WithTriangles(lit.Scene, FanOf(lit.Scene, light));
  Scene& scene = lit.Scene.Scene;
  scene.Optics.EmittedExitance[0].assign(scene.Cells, 0.0);
  for (std::size_t t = lit.Scene.FloorTriangles + lit.Scene.Blockers.size(); t < scene.Cells; ++t)
  {
    scene.Optics.EmittedExitance[0][t] = light.Intensity[0];
  }
  lit.Scene.Emission = true;
  return Compare(lit, cells, Points(random, 32), 1, [](const Lit& l, const Exact& exact, std::size_t) {
    return exact(l.Scene.Blockers);
  });
}

Maker Find(const std::string& name)
{
  for (const BeamKind& kind : BeamKinds())
  {
    if (kind.Name == name)
    {
      return [kind](Random& random, int blockers) { return Place(kind, random, blockers); };
    }
  }
  std::vector<ExtendedKind> extended = AreaKinds();
  for (const ExtendedKind& kind : SkyKinds())
  {
    extended.push_back(kind);
  }
  for (const ExtendedKind& kind : extended)
  {
    if (kind.Name == name)
    {
      return [kind](Random& random, int blockers) { return Place(kind, random, blockers); };
    }
  }
  throw std::logic_error(name);
}

} // namespace

std::vector<Triangle3> FanOf(const CalibrationScene& scene, const Light& light)
{
  std::vector<Triangle3> fan;
  for (std::size_t k = 1; k + 1 < light.Polygon.size(); ++k)
  {
    Triangle3 t{ light.Polygon[0], light.Polygon[k], light.Polygon[k + 1] };
    for (Vec3& p : t)
    {
      p = p + scene.Scene.Origin;
    }
    fan.push_back(t);
  }
  return fan;
}

Scene WithTriangles(const CalibrationScene& scene, const std::vector<Triangle3>& more)
{
  Mesh mesh;
  for (const auto* list : { &scene.Floor, &scene.Blockers, &more })
  {
    for (const Triangle3& t : *list)
    {
      const auto first = static_cast<std::int32_t>(mesh.Points.size());
      mesh.Points.insert(mesh.Points.end(), t.begin(), t.end());
      mesh.Triangles.push_back({ first, first + 1, first + 2 });
    }
  }
  return mesh.ToScene();
}

void AddVariantCases(std::vector<CalibrationCase>& cases)
{
  for (const char* light :
    { "point", "directional", "spot, whole exponent", "luminaire, round", "area, rectangle", "sky, uniform" })
  {
    const Maker make = Find(light);
    const std::string name = light;
    const bool area = name == "area, rectangle", sky = name == "sky, uniform";
    if (!sky && !area)
    {
      cases.push_back({ name + ", through panes", "4 panes", "cells",
        [make](std::uint64_t seed) { return ThroughPanes(make, true, seed); } });
    }
    cases.push_back({ name + ", through panes", "4 panes", "points",
      [make](std::uint64_t seed) { return ThroughPanes(make, false, seed); }, sky });
    cases.push_back({ name + ", on backs", "6 triangles", "cells",
      [make](std::uint64_t seed) { return OnBacks(make, seed); }, sky || area });
    cases.push_back({ name + ", in bands", "6 triangles", "cells",
      [make](std::uint64_t seed) { return InBands(make, true, seed); }, sky || area });
    cases.push_back({ name + ", in bands", "6 triangles", "points",
      [make](std::uint64_t seed) { return InBands(make, false, seed); }, sky });
  }
  const Maker rectangle = Find("area, rectangle");
  cases.push_back({ "emitting surface", "6 triangles", "cells",
    [rectangle](std::uint64_t seed) { return Emitting(rectangle, true, seed); }, true });
  cases.push_back({ "emitting surface", "6 triangles", "points",
    [rectangle](std::uint64_t seed) { return Emitting(rectangle, false, seed); } });
}

} // namespace test
