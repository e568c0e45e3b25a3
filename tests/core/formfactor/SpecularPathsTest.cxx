// SPDX-License-Identifier: BSD-3-Clause
// Light over mirrors, glossy surfaces and panes between surfaces: closed forms and invariants.
#include "radiometry/formfactor/MonteCarloOperator.h"
#include "radiometry/formfactor/PathFollower.h"
#include "radiometry/geometry/Quadrature.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Reflectance.h"
#include "radiometry/solver/RadiositySolver.h"
#include "tests/core/TestScenes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace radiometry;

namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double Mirror = std::numeric_limits<double>::infinity();

/// A scene whose cells have the same optics until they are told otherwise.
struct World
{
  World(const test::Mesh& mesh, int bands, double diffuse, double specular, double shininess)
    : Geometry(mesh.ToScene())
  {
    Materials& o = this->Geometry.Optics;
    o.Bands = bands;
    const std::size_t values = this->Geometry.Cells * static_cast<std::size_t>(bands);
    o.DiffuseReflectance[0].assign(values, diffuse);
    o.SpecularReflectance[0].assign(values, specular);
    o.Shininess[0].assign(this->Geometry.Cells, shininess);
  }
  void Finish()
  {
    this->Occluders = std::make_shared<const OcclusionScene>(this->Geometry);
    this->Elements = std::make_shared<const ElementSet>(this->Geometry, true);
    this->Options.Paths = std::make_shared<const SpecularSurfaces>(this->Geometry, true, true, true);
  }
  MonteCarloOperator Trace(int rays)
  {
    this->Finish();
    return MonteCarloOperator(this->Occluders, this->Elements, this->Options, rays);
  }
  template <class Inside>
  void Set(const Inside& inside, double diffuse, double specular, double shininess)
  {
    Materials& o = this->Geometry.Optics;
    for (std::size_t c = 0; c < this->Geometry.Cells; ++c)
    {
      if (inside(Centroid(this->Geometry.TriangleAt(c)) + this->Geometry.Origin))
      {
        for (int b = 0; b < o.Bands; ++b)
        {
          o.DiffuseReflectance[0][c * o.Bands + b] = diffuse;
          o.SpecularReflectance[0][c * o.Bands + b] = specular;
        }
        o.Shininess[0][c] = shininess;
      }
    }
  }
  Vec3 At(std::size_t element) const
  {
    return Centroid(this->Elements->GetPatches()[element].Corners) + this->Geometry.Origin;
  }
  Scene Geometry;
  std::shared_ptr<const OcclusionScene> Occluders;
  std::shared_ptr<const ElementSet> Elements;
  ExchangeOptions Options;
};

double AreaMean(const MonteCarloOperator& f, const std::vector<double>& values)
{
  double sum = 0.0, area = 0.0;
  for (std::size_t i = 0; i < f.Size(); ++i)
  {
    sum += f.Areas()[i] * values[i];
    area += f.Areas()[i];
  }
  return sum / area;
}

} // namespace

TEST(SpecularSurfaces, LobesSendWhatTheShadingModelSays)
{
  // The share that gets out, and its distribution: int f cos over a cap about any direction.
  for (const double n : { 0.0, 0.3, 1.0, 10.0, 300.0, 20000.0 })
  {
    test::Mesh mesh;
    mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
    World w(mesh, 1, 0.1, 0.8, n);
    w.Finish();
    for (const double theta : { 0.0, 0.7, 1.2, 1.5 })
    {
      const Vec3 in{ std::sin(theta), 0.0, -std::cos(theta) };
      SurfaceHit hit;
      hit.Triangle = 0;
      hit.Front = true;
      hit.U = hit.V = 0.3;
      const Vec3 axis = Normalized(Vec3{ 0.5, 0.3, 0.6 });
      const double cap = 0.8;
      double out = 0.0, inCap = 0.0, ended = 0.0;
      constexpr std::uint32_t Paths = 1u << 16;
      const SobolSequence sequence(11);
      for (std::uint32_t k = 0; k < Paths; ++k)
      {
        Vec3 d = in;
        double weight = 1.0, counted = 0.0;
        const auto fate = w.Options.Paths->Continue(hit, sequence(k), d, &weight, &counted);
        if (fate == SpecularSurfaces::Fate::Scattered)
        {
          ASSERT_GT(d.z, 0.0);
          EXPECT_NEAR(Length(d), 1.0, 1e-12);
          out += weight / Paths;
          inCap += Dot(d, axis) > cap ? weight / Paths : 0.0;
        }
        ended += counted / Paths;
      }
      EXPECT_NEAR(ended, 0.2, 2e-4);
      EXPECT_NEAR(out, PhongLobeReflectance(0.8, n, std::cos(theta)), 0.006) << n << " " << theta;
      double expected = 0.0;
      constexpr int Grid = 600;
      for (int i = 0; i < Grid; ++i)
      {
        for (int j = 0; j < Grid; ++j)
        {
          const double c = cap + (1.0 - cap) * (i + 0.5) / Grid;
          const double psi = 2.0 * Pi * (j + 0.5) / Grid;
          Vec3 s, t;
          Frame(axis, s, t);
          const double sine = std::sqrt(1.0 - c * c);
          const Vec3 d = c * axis + (sine * std::cos(psi)) * s + (sine * std::sin(psi)) * t;
          expected += PhongLobeBrdf(0.8, n, { 0, 0, 1 }, -in, d) * std::max(0.0, d.z) *
            (1.0 - cap) * 2.0 * Pi / (Grid * Grid);
        }
      }
      EXPECT_NEAR(inCap, expected, 0.006 + 0.01 * expected) << n << " " << theta;
    }
  }
}

TEST(SpecularSurfaces, EveryShininessIsThere)
{
  // More exponents than tables: interpolated; the share that gets out stays right.
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 10, 10);
  World w(mesh, 1, 0.0, 1.0, 1.0);
  for (std::size_t c = 0; c < w.Geometry.Cells; ++c)
  {
    w.Geometry.Optics.Shininess[0][c] = std::expm1(0.06 * static_cast<double>(c));
  }
  w.Finish();
  for (std::size_t c = 0; c < w.Geometry.Cells; c += 23)
  {
    const double n = w.Geometry.Optics.Shininess[0][c];
    SurfaceHit hit;
    hit.Triangle = static_cast<std::int32_t>(c);
    hit.Front = true;
    for (const double theta : { 0.4, 1.1, 1.5 })
    {
      double out = 0.0;
      constexpr std::uint32_t Paths = 1u << 15;
      const SobolSequence sequence(c);
      for (std::uint32_t k = 0; k < Paths; ++k)
      {
        Vec3 d{ std::sin(theta), 0.0, -std::cos(theta) };
        double weight = 1.0, counted = 0.0;
        const auto fate = w.Options.Paths->Continue(hit, sequence(k), d, &weight, &counted);
        out += fate == SpecularSurfaces::Fate::Absorbed ? 0.0 : weight / Paths;
      }
      EXPECT_NEAR(out, PhongLobeReflectance(1.0, n, std::cos(theta)), 1e-3) << n << " " << theta;
    }
  }
}

TEST(SpecularPaths, SphereOfMirrorAndPaint)
{
  // What comes in is Phi; what is absorbed is E S (1 - rho_d - rho_s): any shape, any share.
  for (const double specular : { 0.2, 0.5, 0.69, 0.7 })
  {
    test::Mesh mesh;
    mesh.AddSphere({ 3, 2, 1 }, 1.0, 10, true);
    World w(mesh, 1, 0.99 - specular, specular, 1e9);
    // Nearly everything is kept: what rays lose of energy would be seen a hundredfold.
    const MonteCarloOperator f = w.Trace(64);
    EXPECT_EQ(f.Bands(), 0);
    EXPECT_EQ(f.Closure().ClosedRows, f.Size());
    std::vector<double> source(f.Size(), 0.0);
    source[7] = 1.0 / f.Areas()[7];
    const SolveResult r = SolveRadiosity(
      f, std::vector<double>(f.Size(), 0.99 - specular), source, 1, {}, {}, {});
    // Irradiance from elements, all of it: the source is exitance.
    double area = 0.0;
    for (const double a : f.Areas())
    {
      area += a;
    }
    EXPECT_NEAR(AreaMean(f, r.Irradiance) * area * 0.01, 1.0, 1e-6) << specular;
    for (std::size_t i = 0; i < f.Size(); ++i)
    {
      double sum = 0.0;
      sum += f.RowSum(i) * (1.0 - specular);
      EXPECT_NEAR(sum, 1.0, 1e-12);
    }
  }
}

TEST(SpecularPaths, ColoursDifferFromBandToBand)
{
  test::Mesh mesh;
  mesh.AddSphere({ 0, 0, 0 }, 1.0, 8, true);
  World w(mesh, 3, 0.3, 0.5, Mirror);
  std::vector<double>& specular = w.Geometry.Optics.SpecularReflectance[0];
  const double gold[3] = { 0.69, 0.4, 0.0 };
  for (std::size_t k = 0; k < specular.size(); ++k)
  {
    specular[k] = gold[k % 3];
  }
  const MonteCarloOperator f = w.Trace(64);
  ASSERT_EQ(f.Bands(), 3);
  std::vector<double> source(3 * f.Size(), 0.0), rho(3 * f.Size(), 0.3);
  for (int b = 0; b < 3; ++b)
  {
    source[3 * 11 + b] = 1.0 / f.Areas()[11];
  }
  const SolveResult r = SolveRadiosity(f, rho, source, 3, {}, {}, {});
  for (int b = 0; b < 3; ++b)
  {
    double flux = 0.0;
    for (std::size_t i = 0; i < f.Size(); ++i)
    {
      flux += f.Areas()[i] * r.Irradiance[3 * i + b];
      EXPECT_NEAR(f.RowSum(i, b) * (1.0 - gold[b]), 1.0, 1e-6);
    }
    EXPECT_NEAR(flux * (1.0 - 0.3 - gold[b]), 1.0, 1e-5) << b;
  }
}

TEST(SpecularPaths, ParallelPlatesAreAGeometricSeries)
{
  // Two large plates close together: the lower emits, both reflect as mirrors and diffusely.
  // B1 = M + d1 E1, arrivals with s: E1 = (B2 + s2 B1)/(1 - s1 s2), E2 = (B1 + s1 B2)/(1 - s1 s2).
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 1000, 0, 0 }, { 0, 1000, 0 }, 8, 8);
  mesh.AddGrid({ 0, 0, 1e-3 }, { 0, 1000, 0 }, { 1000, 0, 0 }, 8, 8);
  World w(mesh, 1, 0.2, 0.6, 1e6);
  const auto upper = [](const Vec3& p) { return p.z > 5e-4; };
  w.Set(upper, 0.3, 0.5, 1e7);
  const MonteCarloOperator f = w.Trace(512);
  std::vector<double> B(f.Size()), E(f.Size());
  for (std::size_t i = 0; i < f.Size(); ++i)
  {
    B[i] = upper(w.At(i)) ? 3.0 : 2.0;
  }
  f.Apply(B.data(), E.data(), 1);
  const double s1 = 0.6, s2 = 0.5;
  for (std::size_t i = 0; i < f.Size(); ++i)
  {
    const double exact = upper(w.At(i)) ? (2.0 + s1 * 3.0) / (1.0 - s1 * s2)
                                        : (3.0 + s2 * 2.0) / (1.0 - s1 * s2);
    EXPECT_NEAR(E[i], exact, 0.06 * exact);
  }
  double lower = 0.0, all = 0.0;
  for (std::size_t i = 0; i < f.Size(); ++i)
  {
    lower += upper(w.At(i)) ? 0.0 : f.Areas()[i] * E[i];
    all += upper(w.At(i)) ? 0.0 : f.Areas()[i];
  }
  EXPECT_NEAR(lower / all, (3.0 + s2 * 2.0) / (1.0 - s1 * s2), 0.004 * 5.7);
}

TEST(SpecularPaths, AMirrorTubeLetsAllThrough)
{
  // A tube of perfect mirrors with a lid at either end: the ends see each other alone.
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 12 }, 4, true);
  World w(mesh, 1, 0.0, 1.0, Mirror);
  const auto end = [](const Vec3& p) { return p.z < 1e-9 || p.z > 12.0 - 1e-9; };
  w.Set(end, 0.5, 0.0, 10.0);
  const MonteCarloOperator f = w.Trace(64);
  EXPECT_LT(f.CutPaths(), f.Samples() / 100); // nearly square to the tube
  std::vector<double> B(f.Size(), 0.0), E(f.Size());
  for (std::size_t i = 0; i < f.Size(); ++i)
  {
    B[i] = w.At(i).z < 1e-9 ? 2.0 : (end(w.At(i)) ? 5.0 : 0.0);
  }
  std::vector<double> error(B), none(B);
  f.Apply(B.data(), E.data(), 1);
  f.ApplyError(B.data(), none.data(), error.data(), 1);
  for (std::size_t i = 0; i < f.Size(); ++i)
  {
    if (end(w.At(i)))
    {
      EXPECT_NEAR(E[i], w.At(i).z < 1e-9 ? 5.0 : 2.0, 1e-9);
      EXPECT_NEAR(f.RowSum(i), 1.0, 1e-12);
    }
    else
    {
      // The error knows of paths that were given up.
      EXPECT_GT(E[i] + error[i], 2.0 - 1e-9);
      EXPECT_LT(E[i], 5.0 + 1e-9);
    }
  }
}

TEST(SpecularPaths, AMirroredWallShowsTheRoomAgain)
{
  // Floor, lamp and a perfect mirror: as without the mirror and with a second lamp behind it.
  const auto build = [](bool mirror) {
    test::Mesh mesh;
    mesh.AddGrid({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 6, 6);         // floor
    mesh.AddGrid({ 0.5, 0.5, 1.5 }, { 0, 0.6, 0 }, { 0.6, 0, 0 }, 1, 1); // lamp, facing down
    if (mirror)
    {
      mesh.AddGrid({ 0, -50, -50 }, { 0, 100, 0 }, { 0, 0, 100 }, 1, 1); // x = 0, facing +x
    }
    else
    {
      mesh.AddGrid({ -1.1, 0.5, 1.5 }, { 0, 0.6, 0 }, { 0.6, 0, 0 }, 1, 1);
    }
    return mesh;
  };
  World mirrored(build(true), 1, 0.0, 0.0, 10.0);
  mirrored.Set([](const Vec3& p) { return p.x < 1e-9; }, 0.0, 0.9, Mirror);
  World doubled(build(false), 1, 0.0, 0.0, 10.0);
  std::size_t inside = 0, count = 0;
  double ratio = 0.0;
  for (std::uint64_t seed = 0; seed < 4; ++seed)
  {
    mirrored.Options.Seed = doubled.Options.Seed = seed;
    const MonteCarloOperator a = mirrored.Trace(1024);
    const MonteCarloOperator b = doubled.Trace(16384);
    std::vector<double> Ba(a.Size(), 0.0), Bb(b.Size(), 0.0), Ea(Ba), Eb(Bb), ea(Ba), none(Ba);
    Ba[72] = Ba[73] = Bb[72] = Bb[73] = 1.0;
    Bb[74] = Bb[75] = 0.9;
    a.Apply(Ba.data(), Ea.data(), 1);
    a.ApplyError(Ba.data(), none.data(), ea.data(), 1);
    b.Apply(Bb.data(), Eb.data(), 1);
    for (std::size_t i = 0; i < 72; ++i)
    {
      EXPECT_NEAR(Ea[i], Eb[i], 6.0 * ea[i] + 1e-3);
      inside += std::abs(Ea[i] - Eb[i]) <= 2.7 * ea[i];
      ++count;
      ratio += Ea[i] / Eb[i];
    }
  }
  EXPECT_GE(inside, static_cast<std::size_t>(0.93 * static_cast<double>(count)));
  EXPECT_NEAR(ratio / static_cast<double>(count), 1.0, 0.01);
}

TEST(SpecularPaths, PanesLetTheirShareThrough)
{
  // Two rooms with a pane across: what the far wall gets of the near one is tau of what it would.
  const auto build = [](bool pane, double share) {
    test::Mesh mesh;
    mesh.AddBox({ 0, 0, 0 }, { 1, 1, 2 }, 4, true);
    if (pane)
    {
      mesh.AddGrid({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 4, 4);
    }
    World w(mesh, 2, 0.5, 0.0, 10.0);
    if (pane)
    {
      w.Geometry.TriangleTransmittance.assign(2 * w.Geometry.Triangles.size(), 0.0);
      for (std::size_t t = 192; t < w.Geometry.Triangles.size(); ++t)
      {
        w.Geometry.TriangleTransmittance[2 * t] = share;
        w.Geometry.TriangleTransmittance[2 * t + 1] = 1.0;
        w.Geometry.Optics.DiffuseReflectance[0][2 * t] = 0.0;
        w.Geometry.Optics.DiffuseReflectance[0][2 * t + 1] = 0.0;
      }
    }
    return w;
  };
  World open = build(false, 0.0);
  World paned = build(true, 0.4);
  const MonteCarloOperator a = open.Trace(256);
  const MonteCarloOperator b = paned.Trace(256);
  ASSERT_EQ(b.Bands(), 2);
  std::vector<double> Ba(2 * a.Size(), 0.0), Bb(2 * b.Size(), 0.0), Ea(Ba), Eb(Bb), error(Bb),
    none(Bb);
  for (std::size_t i = 0; i < a.Size(); ++i)
  {
    const double below = open.At(i).z < 0.99 ? 1.0 : 0.0;
    Ba[2 * i] = Ba[2 * i + 1] = Bb[2 * i] = Bb[2 * i + 1] = below;
  }
  a.Apply(Ba.data(), Ea.data(), 2);
  b.Apply(Bb.data(), Eb.data(), 2);
  b.ApplyError(Bb.data(), none.data(), error.data(), 2);
  double sum = 0.0, through = 0.0;
  for (std::size_t i = 0; i < a.Size(); ++i)
  {
    // Glass that is not there: the same rays; the room without it is balanced, too.
    EXPECT_NEAR(Eb[2 * i + 1], Ea[2 * i + 1], 0.01);
    if (open.At(i).z > 1.01)
    {
      EXPECT_NEAR(Eb[2 * i], 0.4 * Ea[2 * i], 5.0 * error[2 * i] + 1e-3);
      sum += Ea[2 * i];
      through += Eb[2 * i];
    }
  }
  EXPECT_NEAR(through / sum, 0.4, 0.006);
}

TEST(SpecularPaths, ErrorsCoverOverSeeds)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 2, 3, 1 }, 3, true);
  mesh.AddBox({ 0.5, 0.8, 0.0 }, { 1.1, 1.7, 0.6 }, 2, false);
  World w(mesh, 3, 0.4, 0.0, 10.0);
  w.Set([](const Vec3& p) { return p.x < 1e-9; }, 0.1, 0.8, Mirror);
  w.Set([](const Vec3& p) { return p.z < 1e-9; }, 0.3, 0.3, 40.0);
  for (std::size_t c = 0; c < w.Geometry.Cells; c += 5)
  {
    w.Geometry.Optics.SpecularReflectance[0][3 * c + 1] *= 0.5;
  }
  w.Options.Seed = 1000;
  const MonteCarloOperator reference = w.Trace(32768);
  std::vector<double> B(3 * reference.Size());
  for (std::size_t k = 0; k < B.size(); ++k)
  {
    B[k] = 1.0 + static_cast<double>(k % 5) + (k < 40 ? 20.0 : 0.0);
  }
  std::vector<double> exact(B), none(B), E(B), e(B);
  reference.Apply(B.data(), exact.data(), 3);
  std::size_t inside = 0, count = 0;
  std::vector<double> ratios;
  for (std::uint64_t seed = 0; seed < 6; ++seed)
  {
    w.Options.Seed = seed;
    const MonteCarloOperator f = w.Trace(128);
    f.Apply(B.data(), E.data(), 3);
    f.ApplyError(B.data(), none.data(), e.data(), 3);
    for (std::size_t k = 0; k < B.size(); ++k)
    {
      ++count;
      inside += std::abs(E[k] - exact[k]) <= 2.7 * e[k];
      ratios.push_back(2.7 * e[k] / std::max(1e-12, std::abs(E[k] - exact[k])));
    }
  }
  EXPECT_GE(inside, static_cast<std::size_t>(0.95 * static_cast<double>(count)));
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<long>(count / 2), ratios.end());
  EXPECT_LT(ratios[count / 2], 10.0);
}

TEST(SpecularPaths, ReciprocityHolds)
{
  // A_i F_ij = A_j F_ji over lobes and mirrors alike, as far as rays can tell.
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 1, true);
  for (const double n : { 0.0, 4.0, 60.0, 1e7 })
  {
    World w(mesh, 1, 0.3, 0.5, n);
    const MonteCarloOperator f = w.Trace(1 << 15);
    for (std::size_t j : { 0u, 5u })
    {
      std::vector<double> B(f.Size(), 0.0), E(B), e(B), none(B);
      B[j] = 1.0;
      f.Apply(B.data(), E.data(), 1);
      f.ApplyError(B.data(), none.data(), e.data(), 1);
      for (std::size_t i = 0; i < f.Size(); ++i)
      {
        std::vector<double> C(f.Size(), 0.0), back(C), eb(C);
        C[i] = 1.0;
        f.Apply(C.data(), back.data(), 1);
        f.ApplyError(C.data(), none.data(), eb.data(), 1);
        EXPECT_NEAR(f.Areas()[i] * E[i], f.Areas()[j] * back[j], 5.0 * (e[i] + eb[j]) + 1e-3) << n;
      }
    }
  }
}

TEST(SpecularPaths, HardMirrors)
{
  // Facing mirrors of 0.999, a grazing source, black mirrors, shininess 0 and 1e9: finite, in
  // balance, and what is caught for ever is named.
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 100, 1, 1 }, 2, true);
  World w(mesh, 1, 0.0005, 0.999, 1e9);
  w.Set([](const Vec3& p) { return p.x < 1e-9 || p.x > 100.0 - 1e-9; }, 0.9, 0.0, 0.0);
  const MonteCarloOperator f = w.Trace(32);
  EXPECT_LT(f.CutPaths(), f.Samples() / 100); // they count all they carry where they are
  EXPECT_EQ(f.Closure().ClosedRows, f.Size());
  std::vector<double> one(f.Size()), E(f.Size());
  for (std::size_t i = 0; i < f.Size(); ++i)
  {
    const Patch& p = w.Elements->GetPatches()[i];
    one[i] = w.Options.Paths->Left(p.Triangle, true, 0);
  }
  f.Apply(one.data(), E.data(), 1);
  for (const double e : E)
  {
    EXPECT_NEAR(e, 1.0, 1e-9); // uniform light stays uniform
  }

  World caught(mesh, 1, 0.0, 1.0, Mirror);
  try
  {
    caught.Trace(32);
    FAIL() << "light between perfect mirrors has nowhere to go";
  }
  catch (const InputError& error)
  {
    EXPECT_EQ(error.Array, "SpecularReflectance");
  }

  World black(mesh, 1, 0.5, 0.0, 1e9); // mirrors that reflect nothing are no mirrors
  black.Finish();
  EXPECT_TRUE(black.Options.Paths->Empty());
  World uniform(mesh, 1, 0.2, 0.5, 0.0); // a lobe of exponent 0 is diffuse
  const MonteCarloOperator g = uniform.Trace(64);
  std::vector<double> some(g.Size(), 0.5), got(g.Size());
  g.Apply(some.data(), got.data(), 1);
  for (const double e : got)
  {
    EXPECT_NEAR(e, 1.0, 1e-9);
  }
}
