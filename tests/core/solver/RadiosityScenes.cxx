// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/solver/RadiosityScenes.h"

#include "radiometry/scene/SkyRadiance.h"
#include "tests/core/solver/RadiositySceneMaker.h"

#include <cmath>
#include <fstream>
#include <sstream>

namespace test
{

using namespace radiometry;

namespace
{

Scene ClosedBox()
{
  Maker m;
  m.Box({ 0, 0, 0 }, { 2, 1.5, 1 }, 3, true);
  Scene scene = m.Make(0.5);
  Texture(scene, 0, scene.Cells, 0.1, 0.95);
  Lamp(scene, { 0.7, 0.9, 0.6 }, 100.0);
  return scene;
}

Scene OpenBoxUnderTheSky()
{
  Maker m;
  m.Grid({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 3, 3);
  m.Grid({ 0, 0, 0 }, { 0, 0, 1 }, { 2, 0, 0 }, 2, 3);
  m.Grid({ 0, 2, 0 }, { 2, 0, 0 }, { 0, 0, 1 }, 3, 2);
  m.Grid({ 0, 0, 0 }, { 0, 2, 0 }, { 0, 0, 1 }, 3, 2);
  m.Grid({ 2, 0, 0 }, { 0, 0, 1 }, { 0, 2, 0 }, 2, 3);
  m.Box({ 0.6, 0.7, 0 }, { 1.1, 1.3, 0.6 }, 1, false);
  Scene scene = m.Make(0.6);
  scene.Lights.push_back(SkyLight(SkyRadiance::Uniform(), { 50.0 }));
  return scene;
}

Scene FurnishedRoom()
{
  Maker m;
  m.Box({ 0, 0, 0 }, { 4, 3, 2.5 }, 3, true);
  m.Box({ 0.6, 0.5, 0.3 }, { 1.8, 1.4, 0.9 }, 2, false);
  m.Box({ 2.4, 1.2, 0.2 }, { 3.1, 2.2, 1.6 }, 2, false);
  const std::size_t screen = m.Cells();
  m.Grid({ 2.0, 0.4, 0.1 }, { 0, 1.6, 0 }, { 0, 0, 1.4 }, 2, 2);
  Scene scene = m.Make(0.6);
  Texture(scene, 0, screen, 0.3, 0.8);
  BothSides(scene, screen, scene.Cells);
  Lamp(scene, { 1.2, 1.9, 2.0 }, 1000.0);
  return scene;
}

Scene TwoRoomsWithADoor()
{
  Maker m;
  m.Box({ 0, 0, 0 }, { 4, 2, 2 }, 3, true);
  const std::size_t wall = m.Cells();
  m.Grid({ 2, 0, 0 }, { 0, 1.2, 0 }, { 0, 0, 2 }, 2, 3);
  m.Grid({ 2, 1.2, 1.5 }, { 0, 0.8, 0 }, { 0, 0, 0.5 }, 2, 1);
  Scene scene = m.Make(0.7);
  BothSides(scene, wall, scene.Cells);
  Lamp(scene, { 0.8, 1.1, 1.3 }, 500.0);
  return scene;
}

Scene Sphere()
{
  Maker m;
  m.Surface.AddSphere({ 0, 0, 0 }, 1.0, 8, true);
  Scene scene = m.Make(0.8);
  Lamp(scene, { 0.3, 0.2, -0.1 }, 10.0);
  return scene;
}

Scene Gallery()
{
  Maker m;
  m.Box({ 0, 0, 0 }, { 8, 2, 2.5 }, 3, true);
  const std::size_t lamps = m.Cells();
  for (const double x : { 1.0, 4.5 })
  {
    m.Grid({ x, 0.7, 2.4 }, { 0, 0.6, 0 }, { 1.5, 0, 0 }, 1, 2); // fronts down
  }
  const std::size_t end = m.Cells();
  m.Grid({ 3, 0, 0 }, { 0, 1.1, 0 }, { 0, 0, 2.0 }, 2, 2);
  Scene scene = m.Make(0.5);
  Emit(scene, lamps, end, 200.0);
  BothSides(scene, end, scene.Cells);
  return scene;
}

Scene NearPlates()
{
  Maker m;
  m.Grid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 4, 4);
  const std::size_t upper = m.Cells();
  m.Grid({ 0.2, 0, 0.05 }, { 0, 1, 0 }, { 1, 0, 0 }, 4, 4); // front down
  Scene scene = m.Make(0.6);
  Emit(scene, upper, upper + 8, 100.0);
  Sun(scene, { -0.9, 0.1, -0.6 }, 300.0);
  return scene;
}

Scene CornellBox()
{
  Maker m;
  std::vector<Vec3> colours;
  const Vec3 white{ 0.73, 0.74, 0.7 }, red{ 0.6, 0.06, 0.05 }, green{ 0.12, 0.45, 0.1 };
  const auto paint = [&](const Vec3& colour) { colours.resize(m.Cells(), colour); };
  m.Grid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 3); // floor
  m.Grid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 3, 3); // ceiling
  m.Grid({ 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, 3, 3); // back
  paint(white);
  m.Grid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 3, 3);
  paint(red);
  m.Grid({ 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, 3, 3);
  paint(green);
  m.Box({ 0.15, 0.5, 0.01 }, { 0.45, 0.8, 0.6 }, 1, false);
  m.Box({ 0.55, 0.15, 0.01 }, { 0.85, 0.45, 0.3 }, 1, false);
  const std::size_t lamp = m.Cells();
  m.Grid({ 0.38, 0.38, 0.98 }, { 0, 0.24, 0 }, { 0.24, 0, 0 }, 1, 1);
  paint(white);
  Scene scene = m.Make(1.0);
  Emit(scene, lamp, scene.Cells, 1000.0);
  Colour(scene, colours);
  return scene;
}

Scene DiffusingSheet()
{
  Maker m;
  m.Box({ 0, 0, 0 }, { 3, 1.5, 1.5 }, 3, true);
  const std::size_t sheet = m.Cells();
  m.Grid({ 1.3, 0, 0 }, { 0, 1.5, 0 }, { 0, 0, 1.5 }, 3, 3);
  Scene scene = m.Make(0.6);
  scene.Optics.DiffuseTransmittance.assign(scene.Cells, 0.0);
  for (std::size_t c = sheet; c < scene.Cells; ++c)
  {
    scene.Optics.DiffuseReflectance[0][c] = scene.Optics.DiffuseReflectance[1][c] = 0.35;
    scene.Optics.DiffuseTransmittance[c] = 0.5;
  }
  BothSides(scene, sheet, scene.Cells);
  Lamp(scene, { 0.6, 0.8, 0.9 }, 100.0);
  return scene;
}

Scene YardUnderTheSun()
{
  Maker m;
  m.Grid({ 0, 0, 0 }, { 3, 0, 0 }, { 0, 3, 0 }, 4, 4);
  m.Grid({ 0, 3, 0 }, { 3, 0, 0 }, { 0, 0, 1.5 }, 4, 2);
  m.Grid({ 0, 0, 0 }, { 0, 3, 0 }, { 0, 0, 1.5 }, 4, 2);
  m.Box({ 0.8, 1.0, 0.2 }, { 1.5, 1.8, 0.9 }, 2, false);
  m.Box({ 1.9, 0.5, 0 }, { 2.4, 1.0, 1.2 }, 1, false);
  Scene scene = m.Make(0.5);
  Texture(scene, 0, scene.Cells, 0.1, 0.85);
  Sun(scene, { -0.5, 0.7, -0.8 }, 800.0);
  return scene;
}

} // namespace

std::vector<RadiosityScene> RadiosityScenes()
{
  std::vector<RadiosityScene> scenes{ { "closed-box", "interreflection", ClosedBox() },
    { "open-box-sky", "environment", OpenBoxUnderTheSky() },
    { "furnished-room", "occlusion", FurnishedRoom() },
    { "two-rooms-door", "back faces", TwoRoomsWithADoor() },
    { "sphere", "curved surfaces", Sphere() }, { "gallery", "emission", Gallery() },
    { "near-plates", "near surfaces", NearPlates() },
    { "cornell", "spectral bands", CornellBox() },
    { "diffusing-sheet", "diffuse transmission", DiffusingSheet() },
    { "yard-sun", "directional light", YardUnderTheSun() } };
  AddHardScenes(scenes);
  AddPathScenes(scenes);
  return scenes;
}

std::string RadiosityReferencePath()
{
  return RADIOMETRY_SOURCE_DIR "/tests/core/solver/RadiosityReferences.txt";
}

std::vector<RadiosityReference> RadiosityReferences()
{
  std::vector<RadiosityReference> out;
  std::ifstream file(RadiosityReferencePath());
  for (std::string line; std::getline(file, line);)
  {
    std::istringstream words(line);
    RadiosityReference r;
    if (line[0] != '#' && words >> r.Scene >> r.Cell >> r.Side >> r.Band >> r.Irradiance >> r.Error)
    {
      r.Error += 1e-8 * r.Irradiance; // the digits of the file
      out.push_back(r);
    }
  }
  return out;
}

} // namespace test
