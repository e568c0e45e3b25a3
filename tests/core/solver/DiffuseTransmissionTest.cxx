// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/scene/InputError.h"
#include "radiometry/solver/PlannedRadiosity.h"
#include "tests/core/TestScenes.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace radiometry;

namespace
{

const double Pi = std::acos(-1.0);

struct Optics
{
  double Reflectance = 0.5, Back = 0.0, Through = 0.0;
  bool TwoSided = false;
};

void Set(Scene& scene, std::size_t from, std::size_t to, const Optics& optics)
{
  scene.Optics.DiffuseTransmittance.resize(scene.Cells, 0.0);
  for (std::size_t c = from; c < to; ++c)
  {
    scene.Optics.DiffuseReflectance[0][c] = optics.Reflectance;
    scene.Optics.DiffuseReflectance[1][c] = optics.Back;
    scene.Optics.DiffuseTransmittance[c] = optics.Through;
    scene.Optics.TwoSided[c] = optics.TwoSided;
  }
}

void AddLamp(Scene& scene, const Vec3& at, double flux)
{
  Light light;
  light.Position = at - scene.Origin;
  light.Intensity = { flux / (4.0 * Pi) };
  scene.Lights.push_back(light);
}

void AddSun(Scene& scene, const Vec3& direction, double intensity)
{
  Light sun;
  sun.Type = LightType::Directional;
  sun.Direction = direction;
  sun.Intensity = { intensity };
  scene.Lights.push_back(sun);
}

RadiosityResult Simulate(const Scene& scene, RadiosityOptions options)
{
  return SimulatePlannedRadiosity(scene, {}, true, std::vector<EffectSwitch>(EffectCount), options)
    .Cells;
}

/// Sum over cells [from, to) of a side's values times area.
double Flux(const Scene& scene, const std::vector<double>& values, std::size_t from, std::size_t to)
{
  double sum = 0.0;
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    const auto c = static_cast<std::size_t>(scene.TriangleCell[t]);
    sum += c >= from && c < to ? Area(scene.TriangleAt(t)) * values[c] : 0.0;
  }
  return sum;
}

const RadiosityMethod Methods[] = { RadiosityMethod::Dense, RadiosityMethod::MonteCarlo };

} // namespace

TEST(DiffuseTransmission, SheetUnderTheSun)
{
  // E above, tau E leaves below, rho E above; and the other way round from below.
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2);
  Scene scene = mesh.ToScene();
  Set(scene, 0, scene.Cells, { 0.3, 0.5, 0.45, false });
  for (const double up : { 1.0, -1.0 })
  {
    Scene lit = scene;
    AddSun(lit, { 0, 0, -up }, 1000.0);
    const RadiosityResult r = Simulate(lit, {});
    const std::size_t here = up > 0.0 ? 0 : 1;
    ASSERT_EQ(r.Irradiance[1].Values.size(), scene.Cells);
    for (std::size_t c = 0; c < scene.Cells; ++c)
    {
      EXPECT_NEAR(r.Irradiance[here].Values[c], 1000.0, 1e-9);
      EXPECT_NEAR(r.Irradiance[1 - here].Values[c], 0.0, 1e-9);
      EXPECT_NEAR(r.Radiosity[1 - here].Values[c], 450.0, 1e-9);
      // The back of a cell that is not two-sided does not reflect.
      EXPECT_NEAR(r.Radiosity[here].Values[c], up > 0.0 ? 300.0 : 0.0, 1e-9);
    }
  }
}

TEST(DiffuseTransmission, Lampshade)
{
  // A lamp in a closed shade in a closed room. Means, for any shape of shade: inside
  // A E_in = Phi + A (rho E_in + tau E_out), and all that is emitted is absorbed.
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 3, 3, 3 }, 2, true);
  const std::size_t shade = mesh.Triangles.size();
  mesh.AddSphere({ 1.5, 1.4, 1.6 }, 0.5, 5, true);
  for (const double wall : { 0.0, 0.6 })
  {
    Scene scene = mesh.ToScene(wall);
    Set(scene, shade, scene.Cells, { 0.35, 0.2, 0.5, true });
    AddLamp(scene, { 1.5, 1.4, 1.6 }, 100.0);
    for (const RadiosityMethod method : Methods)
    {
      RadiosityOptions options;
      options.Method = method;
      options.RelativeTolerance = 0.1;
      const RadiosityResult r = Simulate(scene, options);
      const double in = Flux(scene, r.Irradiance[0].Values, shade, scene.Cells);
      const double out = Flux(scene, r.Irradiance[1].Values, shade, scene.Cells);
      const double room = Flux(scene, r.Irradiance[0].Values, 0, shade);
      const double errors = Flux(scene, r.Irradiance[0].Errors, 0, scene.Cells) +
        Flux(scene, r.Irradiance[1].Errors, shade, scene.Cells);
      EXPECT_NEAR(in, 100.0 + 0.35 * in + 0.5 * out, 1e-5 * in) << static_cast<int>(method);
      const double absorbed = 0.15 * in + 0.3 * out + (1.0 - wall) * room;
      EXPECT_NEAR(absorbed, 100.0, std::min(2.0, errors)) << static_cast<int>(method);
      // What leaves the shade outside, where the room gives nothing back.
      if (wall == 0.0)
      {
        EXPECT_NEAR(out, 0.0, 2e-4 * in); // MonteCarlo spreads what balances its energy
        EXPECT_NEAR(room, 0.5 * 100.0 / 0.65, 1.5);
      }
      EXPECT_NEAR(Flux(scene, r.Radiosity[1].Values, shade, scene.Cells), 0.2 * out + 0.5 * in,
        1e-9);
    }
  }
}

TEST(DiffuseTransmission, TwoRoomsPartedByASheet)
{
  // A box whose two halves see each other only through the sheet: in each half
  // flux in = flux that its walls and its side of the sheet leave.
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 2, 1, 1 }, 2, true);
  const std::size_t sheet = mesh.Triangles.size();
  mesh.AddGrid({ 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 2, 2); // front towards +x
  Scene scene = mesh.ToScene(0.5);
  Set(scene, sheet, scene.Cells, { 0.25, 0.4, 0.55, true });
  AddLamp(scene, { 1.5, 0.5, 0.5 }, 10.0);
  for (const RadiosityMethod method : Methods)
  {
    RadiosityOptions options;
    options.Method = method;
    options.RelativeTolerance = 0.1;
    options.Refinement = RefinementMode::Off;
    const RadiosityResult r = Simulate(scene, options);
    double walls[2] = { 0.0, 0.0 };
    for (std::size_t c = 0; c < sheet; ++c)
    {
      const Triangle3 t = scene.TriangleAt(c);
      walls[Centroid(t).x + scene.Origin.x > 1.0] += Area(t) * r.Irradiance[0].Values[c];
    }
    const double front = Flux(scene, r.Irradiance[0].Values, sheet, scene.Cells);
    const double back = Flux(scene, r.Irradiance[1].Values, sheet, scene.Cells);
    // Dense: visibility between the halves is sampled; no light gets round the sheet.
    EXPECT_NEAR(walls[1] + front, 10.0 + 0.5 * walls[1] + 0.25 * front + 0.55 * back, 0.05);
    EXPECT_NEAR(walls[0] + back, 0.5 * walls[0] + 0.4 * back + 0.55 * front, 0.05);
    EXPECT_NEAR(0.5 * (walls[0] + walls[1]) + 0.2 * front + 0.05 * back, 10.0, 1e-4);
    EXPECT_GT(walls[0], 1.0);
  }
}

TEST(DiffuseTransmission, PointsAndSwitch)
{
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  Scene scene = mesh.ToScene();
  Set(scene, 0, scene.Cells, { 0.3, 0.3, 0.45, false });
  AddSun(scene, { 0, 0, -1 }, 1000.0);
  const SurfacePoint point{ Centroid(scene.TriangleAt(0)), { 0, 0, 1 }, 0, {} };
  std::vector<EffectSwitch> switches(EffectCount);
  const PlannedRadiosity on = SimulatePlannedRadiosity(scene, { point }, true, switches, {});
  EXPECT_NEAR(on.PointRadiosity[0].Values[0], 300.0, 1e-6);
  EXPECT_NEAR(on.PointRadiosity[1].Values[0], 450.0, 1e-6);
  const EffectDecision& seen = on.Effects[static_cast<int>(Effect::Transmission)];
  EXPECT_TRUE(seen.Present);
  EXPECT_TRUE(seen.Simulated);
  EXPECT_EQ(seen.Bound, 0.0); // all of it is followed
  switches[static_cast<int>(Effect::Transmission)] = EffectSwitch::Off;
  const PlannedRadiosity off = SimulatePlannedRadiosity(scene, { point }, true, switches, {});
  EXPECT_EQ(off.Cells.Radiosity[1].Values[0], 0.0);
  EXPECT_NEAR(off.PointRadiosity[1].Values[0], 0.0, 1e-12);
  EXPECT_GE(off.Effects[static_cast<int>(Effect::Transmission)].Bound, 450.0);
}

TEST(DiffuseTransmission, TooMuchIsAnError)
{
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  Scene scene = mesh.ToScene();
  Set(scene, 0, scene.Cells, { 0.3, 0.3, 0.6, false });
  scene.Optics.DiffuseTransmittance[1] = 0.8;
  AddSun(scene, { 0, 0, -1 }, 1000.0);
  try
  {
    Simulate(scene, {});
    FAIL() << "no error";
  }
  catch (const InputError& error)
  {
    EXPECT_EQ(error.Index, 1);
    EXPECT_NE(error.Array.find("DiffuseTransmittance"), std::string::npos);
  }
}
