// SPDX-License-Identifier: BSD-3-Clause
//
// Closed bodies keep light out and in, exactly: the oracle is the number zero.
#include "radiometry/irradiance/DirectIrradiance.h"
#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

using namespace radiometry;

namespace
{

const double Pi = std::acos(-1.0);

/// An orthogonal matrix by its rows.
struct Turn
{
  Vec3 X{ 1, 0, 0 };
  Vec3 Y{ 0, 1, 0 };
  Vec3 Z{ 0, 0, 1 };

  Vec3 operator()(const Vec3& p) const { return p.x * this->X + p.y * this->Y + p.z * this->Z; }
};

Turn RandomTurn(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  Turn turn;
  turn.X = Normalized({ normal(random), normal(random), normal(random) });
  turn.Z = Normalized(Cross(turn.X, { normal(random), normal(random), normal(random) }));
  turn.Y = Cross(turn.Z, turn.X);
  return turn;
}

struct Place
{
  Turn Rotation;
  double Size = 1.0;
  Vec3 Shift;

  Place(const Turn& rotation = {}, double size = 1.0, const Vec3& shift = {})
    : Rotation(rotation)
    , Size(size)
    , Shift(shift)
  {
  }
  Vec3 operator()(const Vec3& p) const { return this->Size * this->Rotation(p) + this->Shift; }
};

std::vector<Patch> Patches(const Scene& scene, std::size_t count)
{
  std::vector<Patch> patches;
  for (std::size_t t = 0; t < count; ++t)
  {
    patches.push_back({ scene.TriangleAt(t), static_cast<std::int32_t>(t), scene.TriangleCell[t], 0 });
  }
  return patches;
}

/// On the faces, edges and corners of the unit cube, `gap` beyond (or before) them.
std::vector<Vec3> PlacesAtTheRim(std::mt19937& random, int count, double gap)
{
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::uniform_int_distribution<int> axis(0, 2);
  std::vector<Vec3> places;
  for (int k = 0; k < count; ++k)
  {
    Vec3 p{ unit(random), unit(random), unit(random) };
    const int kind = k % 5;
    // 0, 1: off a face; 2: off an edge, beyond both its faces; 3: off a corner;
    // 4: in the plane of a face, beyond its edge.
    const int a = axis(random);
    const bool high = unit(random) < 0.5;
    p[a] = high ? 1.0 + gap : -gap;
    if (kind == 1)
    {
      p[(a + 1) % 3] = unit(random) < 0.5 ? std::fabs(gap) : 0.5; // close to an edge, or over the mesh's lines
    }
    if (kind == 2 || kind == 3)
    {
      p[(a + 1) % 3] = unit(random) < 0.5 ? 1.0 + gap : -gap;
    }
    if (kind == 3)
    {
      p[(a + 2) % 3] = unit(random) < 0.5 ? 1.0 + gap : -gap;
    }
    if (kind == 4)
    {
      p[(a + 1) % 3] = unit(random) < 0.5 ? 1.0 : 0.0;
    }
    places.push_back(p);
  }
  return places;
}

/// The kinds of light that send from a place: everywhere, in a cone at the body, in a wide cone.
std::vector<Light> BeamsFrom(const Vec3& position, const Vec3& toward)
{
  Light light;
  light.Position = position;
  light.Direction = Normalized(toward - position);
  light.Intensity = { 1.0 };
  std::vector<Light> lights{ light };
  light.Type = LightType::Spot;
  light.CosCutoff = 0.9;
  light.Exponent = 2.5;
  lights.push_back(light);
  light.CosCutoff = 0.0;
  light.Exponent = 0.0;
  lights.push_back(light);
  return lights;
}

/// Every value is exactly 0, and its error no more than `doubt`.
void ExpectDark(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, double doubt, const std::string& what)
{
  const DirectResult r = ComputeDirectIrradiance(scene, occluders, patches, {});
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    ASSERT_EQ(r.Irradiance[i], 0.0) << what << ", triangle " << i << ", light at ("
                                    << scene.Lights[0].Position.x << ", "
                                    << scene.Lights[0].Position.y << ", "
                                    << scene.Lights[0].Position.z << ")";
    ASSERT_LE(r.Error[i], doubt) << what << ", triangle " << i;
  }
}

/// Rounding of what a light of 1 W/sr gives at the distance `gap`.
double Rounding(double gap)
{
  return 1e-13 / (gap * gap);
}

/// Every triangle of an inward box under lights `gap` outside of it: exactly nothing.
void DarkInside(const Place& place, int n, int count, double gap, unsigned seed)
{
  std::mt19937 random(seed);
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, n, true);
  for (Vec3& p : mesh.Points)
  {
    p = place(p);
  }
  Scene scene = mesh.ToScene();
  const OcclusionScene occluders(scene);
  const std::vector<Patch> patches = Patches(scene, scene.Triangles.size());
  const Vec3 middle = place({ 0.5, 0.5, 0.5 }) - scene.Origin;
  const std::vector<Vec3> places = PlacesAtTheRim(random, count, gap);
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    const std::vector<Light> beams = BeamsFrom(place(places[k]) - scene.Origin, middle);
    scene.Lights = { beams[k % 3] };
    ExpectDark(scene, occluders, patches, Rounding(gap * place.Size),
      "n " + std::to_string(n) + ", gap " + std::to_string(gap));
    if (testing::Test::HasFatalFailure())
    {
      return;
    }
  }
}

TEST(ClosedBody, DarkInsideCoarse)
{
  for (const double gap : { 1e-4, 1e-9 })
  {
    DarkInside({}, 1, 200, gap, 1);
  }
}

TEST(ClosedBody, DarkInsideCoarseTurned)
{
  std::mt19937 random(2);
  for (const double gap : { 1e-4, 1e-9 })
  {
    for (int k = 0; k < 8; ++k)
    {
      DarkInside({ RandomTurn(random) }, 1 + k % 3, 60, gap, 20 + k);
    }
  }
}

TEST(ClosedBody, DarkInsideFine)
{
  std::mt19937 random(3);
  for (const double gap : { 1e-4, 1e-9 })
  {
    DarkInside({}, 13, 30, gap, 30);
    DarkInside({ RandomTurn(random) }, 16, 30, gap, 31);
    DarkInside({ RandomTurn(random) }, 11, 30, gap, 32);
  }
}

TEST(ClosedBody, DarkInsideInUtmAndAtOtherScales)
{
  std::mt19937 random(4);
  const Vec3 utm{ 5e5, 4e6, 120 };
  DarkInside({ {}, 8.0, utm }, 4, 60, 1e-4, 40);
  DarkInside({ RandomTurn(random), 8.0, utm }, 3, 60, 1e-4, 41);
  // 1e-9 of 80 m is 8e-8 m; coordinates of 4e6 m are rounded to 5e-10 m.
  DarkInside({ RandomTurn(random), 80.0, utm }, 3, 60, 1e-9, 42);
  for (const double size : { 1e-6, 1e9 })
  {
    DarkInside({ RandomTurn(random), size }, 3, 60, 1e-4, 43);
    DarkInside({ RandomTurn(random), size }, 3, 60, 1e-9, 44);
  }
}

TEST(ClosedBody, DarkInsideFromFarAndAround)
{
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const int n : { 1, 7 })
  {
    test::Mesh mesh;
    const Turn turn = RandomTurn(random);
    mesh.AddBox({ 0, 0, 0 }, { 1, 2, 3 }, n, true);
    for (Vec3& p : mesh.Points)
    {
      p = turn(p);
    }
    Scene scene = mesh.ToScene();
    const OcclusionScene occluders(scene);
    const std::vector<Patch> patches = Patches(scene, scene.Triangles.size());
    for (int k = 0; k < 60; ++k)
    {
      const Vec3 d = Normalized({ normal(random), normal(random), normal(random) });
      const double r = std::pow(10.0, k % 10);
      scene.Lights = { BeamsFrom((4.0 + r) * d, {})[k % 3] };
      ExpectDark(scene, occluders, patches, Rounding(1.0), "far");
    }
  }
}

TEST(ClosedBody, DarkInsideUnderTheSun)
{
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  for (const bool turned : { false, true })
  {
    for (const int n : { 1, 2, 9 })
    {
      const Turn turn = turned ? RandomTurn(random) : Turn{};
      test::Mesh mesh;
      mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, n, true);
      for (Vec3& p : mesh.Points)
      {
        p = turn(p);
      }
      Scene scene = mesh.ToScene();
      const OcclusionScene occluders(scene);
      const std::vector<Patch> patches = Patches(scene, scene.Triangles.size());
      // Along the axes, along the diagonals of faces and body (through edges and corners, and along
      // the mesh's own lines), grazing to a face, and anyhow.
      for (int k = 0; k < 60; ++k)
      {
        Vec3 d{ static_cast<double>(k % 3 - 1), static_cast<double>(k / 3 % 3 - 1),
          static_cast<double>(k / 9 % 3 - 1) };
        if (k >= 27 && k < 40)
        {
          d = { 1, 1e-6 * normal(random), k % 2 == 0 ? 0.0 : 1e-9 };
        }
        if (d == Vec3{} || k >= 40)
        {
          d = { normal(random), normal(random), normal(random) };
        }
        Light sun;
        sun.Type = LightType::Directional;
        sun.Direction = Normalized(turn(d));
        sun.Intensity = { 1000.0 };
        scene.Lights = { sun };
        ExpectDark(scene, occluders, patches, 1000.0 * 1e-9, "sun " + std::to_string(k));
      }
    }
  }
}

/// A box that stands on a floor whose cells share its lower edges, the light inside: the floor
/// around and a second box around everything get exactly nothing.
void DarkOutside(const Place& place, int n, double gap, unsigned seed)
{
  std::mt19937 random(seed);
  test::Mesh mesh;
  // The floor around the foot: eight fields of n x n quads, so that vertices meet the box's.
  for (int j = -1; j <= 1; ++j)
  {
    for (int i = -1; i <= 1; ++i)
    {
      if (i != 0 || j != 0)
      {
        mesh.AddGrid({ static_cast<double>(i), static_cast<double>(j), 0 }, { 1, 0, 0 },
          { 0, 1, 0 }, n, n);
      }
    }
  }
  mesh.AddBox({ -2, -2, -2 }, { 3, 3, 3 }, 2, true);
  const std::size_t receivers = mesh.Triangles.size();
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, n, true);
  for (Vec3& p : mesh.Points)
  {
    p = place(p);
  }
  Scene scene = mesh.ToScene();
  const OcclusionScene occluders(scene);
  const std::vector<Patch> all = Patches(scene, scene.Triangles.size());
  const std::vector<Patch> outside(all.begin(), all.begin() + receivers);
  const std::vector<Vec3> places = PlacesAtTheRim(random, 40, -gap);
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    if (k % 5 == 4)
    {
      continue; // in the plane of a wall is not inside
    }
    scene.Lights = { BeamsFrom(place(places[k]) - scene.Origin, place({ 0.5, -3, -1 }))[k % 3] };
    ExpectDark(scene, occluders, outside, Rounding(gap * place.Size),
      "outside, gap " + std::to_string(gap));
    if (testing::Test::HasFatalFailure())
    {
      return;
    }
    if (k % 3 == 0) // and inside nothing is lost: the whole sphere lands
    {
      const DirectResult r = ComputeDirectIrradiance(scene, occluders, all, {});
      double flux = 0.0;
      for (std::size_t t = receivers; t < all.size(); ++t)
      {
        flux += r.Irradiance[t] * Area(all[t].Corners);
      }
      EXPECT_NEAR(flux / (4.0 * Pi), 1.0, 1e-6) << "light " << k << ", gap " << gap;
    }
  }
}

TEST(ClosedBody, DarkOutside)
{
  DarkOutside({}, 1, 1e-4, 50);
  DarkOutside({}, 3, 1e-9, 51);
}

TEST(ClosedBody, DarkOutsideTurned)
{
  std::mt19937 random(7);
  for (int k = 0; k < 4; ++k)
  {
    DarkOutside({ RandomTurn(random) }, 1 + k, k % 2 == 0 ? 1e-4 : 1e-9, 60 + k);
  }
}

TEST(ClosedBody, DarkOutsideInUtm)
{
  std::mt19937 random(8);
  DarkOutside({ RandomTurn(random), 8.0, { 5e5, 4e6, 0 } }, 2, 1e-4, 70);
}

TEST(ClosedBody, WallsThatStandOnALargeCellLeakNothing)
{
  // Four walls and a lid over the middle of one floor cell whose mesh knows nothing of them: the
  // floor gets what falls on the foot and no more; its own two triangles cross the walls.
  std::mt19937 random(9);
  for (int k = 0; k < 6; ++k)
  {
    const Turn turn = k == 0 ? Turn{} : RandomTurn(random);
    test::Mesh mesh;
    mesh.AddGrid({ -3, -4, 0 }, { 7, 0, 0 }, { 0, 9, 0 }, 1, 1);
    const Vec3 x{ 1, 0, 0 };
    const Vec3 y{ 0, 1, 0 };
    const Vec3 z{ 0, 0, 1 };
    mesh.AddGrid({ 0, 0, 0 }, x, z, 2, 1);
    mesh.AddGrid({ 0, 1, 0 }, z, x, 1, 2);
    mesh.AddGrid({ 0, 0, 0 }, z, y, 3, 1);
    mesh.AddGrid({ 1, 0, 0 }, y, z, 1, 3);
    mesh.AddGrid({ 0, 0, 1 }, x, y, 2, 2);
    for (Vec3& p : mesh.Points)
    {
      p = turn(p);
    }
    Scene scene = mesh.ToScene();
    const OcclusionScene occluders(scene);
    for (const Vec3 at : { Vec3{ 0.3, 0.4, 0.5 }, Vec3{ 0.5, 0.5, 1 - 1e-9 }, Vec3{ 1e-9, 0.3, 0.2 },
           Vec3{ 1e-4, 1e-4, 0.7 } })
    {
      scene.Lights = BeamsFrom(turn(at) - scene.Origin, {});
      scene.Lights.resize(1);
      const DirectResult r = ComputeDirectIrradiance(scene, occluders, Patches(scene, 2), {});
      const double flux = 31.5 * (r.Irradiance[0] + r.Irradiance[1]);
      // The foot's solid angle: four corner rectangles.
      double exact = 0.0;
      for (const double a : { at.x, 1 - at.x })
      {
        for (const double b : { at.y, 1 - at.y })
        {
          exact += std::atan2(a * b, at.z * std::sqrt(a * a + b * b + at.z * at.z));
        }
      }
      EXPECT_NEAR(flux / exact, 1.0, 1e-9) << k << " " << at.x;
      EXPECT_LE(std::fabs(flux - exact), 31.5 * (r.Error[0] + r.Error[1]) + 1e-12) << k << " " << at.x;
    }
  }
}

/// A closed body that is not convex: an L of three unit cubes, its inner edge a ridge.
void AddEll(test::Mesh& mesh, int n, bool inward)
{
  const auto quad = [&](const Vec3& o, const Vec3& a, const Vec3& b) {
    inward ? mesh.AddGrid(o, b, a, n, n) : mesh.AddGrid(o, a, b, n, n);
  };
  const Vec3 x{ 1, 0, 0 };
  const Vec3 y{ 0, 1, 0 };
  const Vec3 z{ 0, 0, 1 };
  for (const Vec3 o : { Vec3{ 0, 0, 0 }, Vec3{ 1, 0, 0 }, Vec3{ 0, 1, 0 } })
  {
    quad(o, y, x);
    quad(o + z, x, y);
  }
  quad({ 0, 0, 0 }, x, z);
  quad({ 1, 0, 0 }, x, z);
  quad({ 2, 0, 0 }, y, z);
  quad({ 1, 1, 0 }, z, x);
  quad({ 1, 1, 0 }, y, z);
  quad({ 0, 2, 0 }, z, x);
  quad({ 0, 0, 0 }, z, y);
  quad({ 0, 1, 0 }, z, y);
}

TEST(ClosedBody, EllKeepsLightInAndOut)
{
  std::mt19937 random(10);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const int n : { 1, 5 })
  {
    const Turn turn = RandomTurn(random);
    test::Mesh mesh;
    AddEll(mesh, n, true);
    for (Vec3& p : mesh.Points)
    {
      p = turn(p);
    }
    Scene scene = mesh.ToScene();
    const OcclusionScene occluders(scene);
    const std::vector<Patch> patches = Patches(scene, scene.Triangles.size());
    for (const double gap : { 1e-4, 1e-9 })
    {
      for (int k = 0; k < 20; ++k)
      {
        // In the notch: off the ridge's two faces, and just off the ridge itself.
        const Vec3 at = k % 2 == 0 ? Vec3{ 1 + gap, 1 + unit(random), unit(random) }
                                   : Vec3{ 1 + gap, 1 + gap, unit(random) };
        scene.Lights = { BeamsFrom(turn(at) - scene.Origin, turn({ 0.5, 0.5, 0.5 }) - scene.Origin)[k % 3] };
        ExpectDark(scene, occluders, patches, Rounding(gap), "ell");
      }
      // Inside, close to the ridge: every ray lands somewhere, none twice.
      for (const Vec3 at : { Vec3{ 1 - gap, 1 - gap, 0.4 }, Vec3{ 1 - gap, 1.3, 0.4 },
             Vec3{ 1.7, gap, 1 - gap }, Vec3{ 0.5, 0.6, 0.7 } })
      {
        scene.Lights = { BeamsFrom(turn(at) - scene.Origin, {})[0] };
        const DirectResult r = ComputeDirectIrradiance(scene, occluders, patches, {});
        double flux = 0.0;
        for (std::size_t t = 0; t < patches.size(); ++t)
        {
          flux += r.Irradiance[t] * Area(patches[t].Corners);
        }
        EXPECT_NEAR(flux / (4.0 * Pi), 1.0, 1e-6) << n << " " << gap << " " << at.x;
      }
    }
  }
}

TEST(ClosedBody, PointsOfAClosedBoxStayDark)
{
  // Corners, edges and the inside of faces, asked as points of the surface and as free sensors.
  std::mt19937 random(11);
  for (int k = 0; k < 4; ++k)
  {
    const Turn turn = k == 0 ? Turn{} : RandomTurn(random);
    test::Mesh mesh;
    mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 3, true);
    for (Vec3& p : mesh.Points)
    {
      p = turn(p);
    }
    Scene scene = mesh.ToScene();
    const OcclusionScene occluders(scene);
    std::vector<SurfacePoint> points;
    for (std::size_t t = 0; t < scene.Triangles.size(); ++t)
    {
      const Triangle3 c = scene.TriangleAt(t);
      const Vec3 n = Normalized(AreaNormal2(c));
      const auto id = static_cast<std::int32_t>(t);
      for (const Vec3& p : { c[0], 0.5 * (c[0] + c[1]), Centroid(c) })
      {
        points.push_back({ p, n, id, { id }, 0.0 });
        points.push_back({ p, n, -1, {}, 0.0 });
      }
    }
    for (const double gap : { 1e-4, 1e-9 })
    {
      const std::vector<Vec3> places = PlacesAtTheRim(random, 25, gap);
      for (const Vec3& at : places)
      {
        scene.Lights = { BeamsFrom(turn(at) - scene.Origin, {})[0] };
        const DirectResult r = ComputeDirectIrradiance(scene, occluders, points, {});
        for (std::size_t i = 0; i < points.size(); ++i)
        {
          ASSERT_EQ(r.Irradiance[i], 0.0)
            << "point " << i << " (" << (i % 2 == 0 ? "surface" : "sensor") << "), gap " << gap
            << ", light at (" << at.x << ", " << at.y << ", " << at.z << "), turn " << k;
        }
      }
    }
  }
}

} // namespace
