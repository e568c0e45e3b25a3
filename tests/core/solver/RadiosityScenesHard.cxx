// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/scene/SkyRadiance.h"
#include "tests/core/solver/RadiosityScenes.h"
#include "tests/core/solver/RadiositySceneMaker.h"

/// Scenes that are hard for links between large elements: many thin things in the way, faces that
/// pierce each other, a bowl that shades itself, a small source in a large room.
namespace test
{
namespace
{

/// A room whose open side, toward the sky, has twelve slats before it.
Scene Blinds()
{
  Maker m;
  m.Grid({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 3, 0 }, 3, 3);     // floor
  m.Grid({ 0, 0, 2.4 }, { 0, 3, 0 }, { 4, 0, 0 }, 3, 3);   // ceiling
  m.Grid({ 0, 0, 0 }, { 0, 0, 2.4 }, { 4, 0, 0 }, 3, 3);   // sides
  m.Grid({ 0, 3, 0 }, { 4, 0, 0 }, { 0, 0, 2.4 }, 3, 3);
  m.Grid({ 0, 0, 0 }, { 0, 3, 0 }, { 0, 0, 2.4 }, 3, 3);   // the far end
  const std::size_t slats = m.Cells();
  for (int k = 0; k < 12; ++k)
  {
    m.Grid({ 4.0, 0.0, 0.05 + 0.2 * k }, { 0, 3, 0 }, { 0.16, 0, 0.09 }, 2, 1);
  }
  Scene scene = m.Make(0.6);
  BothSides(scene, slats, scene.Cells);
  scene.Lights.push_back(SkyLight(SkyRadiance::Uniform(), { 100.0 }));
  return scene;
}

/// The same slats hang between a lamp and the rest of a closed room.
Scene BlindsInARoom()
{
  Maker m;
  m.Box({ 0, 0, 0 }, { 4, 2, 2 }, 3, true);
  const std::size_t slats = m.Cells();
  for (int k = 0; k < 10; ++k)
  {
    m.Grid({ 1.5, 0.0, 0.04 + 0.2 * k }, { 0, 2, 0 }, { 0.14, 0, 0.1 }, 1, 1);
  }
  Scene scene = m.Make(0.6);
  BothSides(scene, slats, scene.Cells);
  Lamp(scene, { 0.6, 0.9, 1.1 }, 500.0);
  return scene;
}

/// Boxes that stand in one another and through the floor of their room.
Scene PiercedBoxes()
{
  Maker m;
  m.Box({ 0, 0, 0 }, { 3, 2, 2 }, 3, true);
  m.Box({ 0.7, 0.5, -0.2 }, { 1.6, 1.2, 0.8 }, 1, false);
  m.Box({ 1.1, 0.8, 0.3 }, { 2.3, 1.6, 0.6 }, 1, false);
  Scene scene = m.Make(0.6);
  Lamp(scene, { 1.3, 1.0, 1.6 }, 500.0);
  return scene;
}

/// A plate in which a bowl (a part of a sphere) is sunk, under a low sun.
Scene Crater()
{
  Maker m;
  const double beta = 0.9, radius = 1.0 / std::sin(beta);
  auto& points = m.Surface.Points;
  constexpr int around = 12, rings = 4;
  points.push_back({ 0, 0, radius * (std::cos(beta) - 1.0) });
  for (int j = 1; j <= rings + 1; ++j)
  {
    const double a = beta * std::min(j, rings) / rings;
    const double r = j <= rings ? radius * std::sin(a) : 2.0;
    for (int i = 0; i < around; ++i)
    {
      const double phi = 2.0 * std::acos(-1.0) * i / around;
      points.push_back({ r * std::cos(phi), r * std::sin(phi),
        j <= rings ? radius * (std::cos(beta) - std::cos(a)) : 0.0 });
    }
  }
  for (int j = 0; j <= rings; ++j)
  {
    for (int i = 0; i < around; ++i)
    {
      const int next = (i + 1) % around;
      const int a = 1 + (j - 1) * around + i, b = 1 + (j - 1) * around + next;
      const int c = 1 + j * around + i, d = 1 + j * around + next;
      if (j == 0)
      {
        m.Surface.Triangles.push_back({ 0, c, d });
        continue;
      }
      m.Surface.Triangles.push_back({ a, c, d });
      m.Surface.Triangles.push_back({ a, d, b });
    }
  }
  Scene scene = m.Make(0.3);
  Sun(scene, { 0.94, 0.1, -0.35 }, 1000.0);
  return scene;
}

/// The room of Ward and Rushmeier's report on Globillum (1990): 10 x 6 x 3 m, a source of half a metre
/// in the ceiling.
Scene LargeRoomSmallSource()
{
  Maker m;
  m.Grid({ 0, 0, 3 }, { 0, 6, 0 }, { 10, 0, 0 }, 3, 3); // ceiling
  const std::size_t walls = m.Cells();
  m.Grid({ 0, 0, 0 }, { 0, 0, 3 }, { 10, 0, 0 }, 2, 3);
  m.Grid({ 0, 6, 0 }, { 10, 0, 0 }, { 0, 0, 3 }, 3, 2);
  m.Grid({ 0, 0, 0 }, { 0, 6, 0 }, { 0, 0, 3 }, 3, 2);
  m.Grid({ 10, 0, 0 }, { 0, 0, 3 }, { 0, 6, 0 }, 2, 3);
  const std::size_t floor = m.Cells();
  m.Grid({ 0, 0, 0 }, { 10, 0, 0 }, { 0, 6, 0 }, 3, 3);
  const std::size_t lamp = m.Cells();
  m.Grid({ 4.75, 2.75, 2.99 }, { 0, 0.5, 0 }, { 0.5, 0, 0 }, 1, 1);
  Scene scene = m.Make(0.0);
  Texture(scene, 0, walls, 0.7, 0.7);
  Texture(scene, walls, floor, 0.5, 0.5);
  Texture(scene, floor, lamp, 0.3, 0.3);
  Emit(scene, lamp, scene.Cells, 31.416);
  return scene;
}

} // namespace

void AddHardScenes(std::vector<RadiosityScene>& scenes)
{
  scenes.push_back({ "blinds", "sky through blinds", Blinds() });
  scenes.push_back({ "blinds-in-room", "blinds between surfaces", BlindsInARoom() });
  scenes.push_back({ "pierced-boxes", "faces that pierce each other", PiercedBoxes() });
  scenes.push_back({ "crater", "shadow in a crater", Crater() });
  scenes.push_back({ "small-source", "small source in a large room", LargeRoomSmallSource() });
}

} // namespace test
