// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/scene/SkyRadiance.h"
#include "tests/core/solver/RadiosityScenes.h"
#include "tests/core/solver/RadiositySceneMaker.h"

/// Scenes in which light is followed over mirrors and glossy surfaces and through panes.
namespace test
{
namespace
{

/// Cells [from, to) reflect in a lobe, too.
void Shine(Scene& scene, std::size_t from, std::size_t to, double specular, double shininess)
{
  scene.Optics.SpecularReflectance[0].resize(scene.Cells, 0.0);
  scene.Optics.Shininess[0].resize(scene.Cells, DefaultShininess);
  for (std::size_t c = from; c < to; ++c)
  {
    scene.Optics.SpecularReflectance[0][c] = specular;
    scene.Optics.Shininess[0][c] = shininess;
  }
}

/// A panel under the ceiling lights a room with a box.
Maker LitRoom(std::size_t& panel)
{
  Maker m;
  m.Box({ 0, 0, 0 }, { 3, 2, 2 }, 3, true); // faces of 18 cells: z = 0, z = 2, y = 0, y = 2, x = 0 ...
  m.Box({ 1.7, 0.5, 0.2 }, { 2.3, 1.2, 0.9 }, 1, false);
  panel = m.Cells();
  m.Grid({ 0.9, 0.6, 1.9 }, { 0, 0.8, 0 }, { 0.8, 0, 0 }, 1, 1);
  return m;
}

Scene MirrorWall()
{
  std::size_t panel = 0;
  Maker m = LitRoom(panel);
  Scene scene = m.Make(0.5);
  Emit(scene, panel, scene.Cells, 100.0);
  Texture(scene, 72, 90, 0.0, 0.0);
  Shine(scene, 72, 90, 0.9, MirrorShininess);
  return scene;
}

Scene GlossyFloor()
{
  std::size_t panel = 0;
  Maker m = LitRoom(panel);
  Scene scene = m.Make(0.5);
  Emit(scene, panel, scene.Cells, 100.0);
  Texture(scene, 0, 18, 0.2, 0.2);
  Shine(scene, 0, 18, 0.5, 30.0);
  return scene;
}

Scene GlossyCourtUnderTheSky()
{
  Maker m;
  m.Grid({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 3, 3);
  m.Grid({ 0, 2, 0 }, { 2, 0, 0 }, { 0, 0, 1.5 }, 3, 2);
  m.Grid({ 0, 0, 0 }, { 0, 2, 0 }, { 0, 0, 1.5 }, 3, 2);
  Scene scene = m.Make(0.4);
  Shine(scene, 18, scene.Cells, 0.4, 100.0);
  scene.Lights.push_back(SkyLight(SkyRadiance::Overcast(), { 50.0 }));
  return scene;
}

Scene PaneBetweenRooms()
{
  Maker m;
  m.Box({ 0, 0, 0 }, { 3, 1.5, 1.5 }, 3, true);
  const std::size_t pane = m.Cells();
  m.Grid({ 1.3, 0, 0 }, { 0, 1.5, 0 }, { 0, 0, 1.5 }, 3, 3);
  Scene scene = m.Make(0.6);
  scene.Optics.Transmittance.assign(scene.Cells, 0.0);
  scene.TriangleTransmittance.assign(scene.Triangles.size(), 0.0);
  for (std::size_t c = pane; c < scene.Cells; ++c)
  {
    scene.Optics.DiffuseReflectance[0][c] = scene.Optics.DiffuseReflectance[1][c] = 0.2;
    scene.Optics.Transmittance[c] = scene.TriangleTransmittance[c] = 0.6;
  }
  BothSides(scene, pane, scene.Cells);
  Lamp(scene, { 0.6, 0.8, 0.9 }, 100.0);
  return scene;
}

} // namespace

void AddPathScenes(std::vector<RadiosityScene>& scenes)
{
  scenes.push_back({ "mirror-wall", "mirrors", MirrorWall(), true });
  scenes.push_back({ "glossy-floor", "specular reflection", GlossyFloor(), true });
  scenes.push_back({ "glossy-court", "specular reflection of the sky", GlossyCourtUnderTheSky(), true });
  scenes.push_back({ "pane", "partial transmission", PaneBetweenRooms(), true });
}

} // namespace test
