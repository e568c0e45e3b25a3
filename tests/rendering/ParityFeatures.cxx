// SPDX-License-Identifier: BSD-3-Clause
// The plain scene, and the features put on it alone or in combination.
#include "ParityMaking.h"

#include <algorithm>

using namespace radiometry;
using namespace parity;

namespace
{

std::vector<ParityFeature> MakeFeatures()
{
  std::vector<ParityFeature> features;
  const AddFeature add = [&features](const char* name, double chance,
                           std::function<void(Scene&, Random&)> apply) {
    features.push_back({ name, std::move(apply), chance });
  };
  AddLightFeatures(add);
  AddMaterialFeatures(add);
  AddGeometryFeatures(add);
  AddFieldFeatures(add);
  return features;
}

/// Six triangles across each other, matte, no light, one-sided, seen in perspective.
Scene MakePlainScene(Random& random)
{
  Scene scene;
  scene.Front.Diffuse = random.Color(0.1, 1.0);
  scene.Back = scene.Front;
  scene.Model.TwoSided = false;
  scene.Model.Reflection = static_cast<ReflectionModel>(random.Below(3));
  for (int t = 0; t < 6; ++t)
  {
    const Vec3 center = random.In(0.0, 0.6) * random.Direction();
    Triangle3 corners;
    for (Vec3& c : corners)
    {
      c = ToFloat(center + random.In(0.7, 1.3) * random.Direction());
    }
    const Vec3 normal = Normalized(AreaNormal2(corners));
    for (const Vec3& c : corners)
    {
      scene.Points.push_back(c);
      scene.Normals.push_back(ToFloat(Normalized(normal + 0.4 * random.Direction())));
    }
  }
  scene.Eye = random.In(2.5, 5.0) * random.Direction();
  scene.Focus = 0.2 * random.Direction();
  scene.Up = Normalized(Cross(random.Direction(), scene.Eye - scene.Focus));
  return scene;
}

/// What the parts of a combination leave contradictory.
void Settle(Scene& scene)
{
  // Colours of the data are those of both sides, as in VTK.
  scene.HasBack = scene.HasBack && scene.Colors != ParityColors::Scalars;
  scene.Model.TwoSided = scene.Model.TwoSided || scene.HasBack;
  if (!scene.HasBack)
  {
    const Rgb emission = scene.Back.Emission;
    scene.Back = scene.Front;
    scene.Back.Emission = emission;
  }
  for (ParityLight& given : scene.Lights)
  {
    DisplayLight& light = given.Light;
    if (scene.RendererLights) // VTK knows neither inner cones nor cones of 90 degrees
    {
      light.SmoothEdge = false;
      light.CosCutoff = light.CosCutoff == 0.0 ? 0.5 : light.CosCutoff;
    }
  }
  if (scene.Colors == ParityColors::CellField || scene.Colors == ParityColors::PointField)
  {
    scene.Front.Emission = scene.Back.Emission = Rgb();
  }
  scene.Prepare();
}

} // namespace

const std::vector<ParityFeature>& ParityFeatures()
{
  static const std::vector<ParityFeature> features = MakeFeatures();
  return features;
}

ParityScene MakeFeatureScene(const ParityFeature& feature, std::uint32_t seed, int shading)
{
  Random random(seed);
  Scene scene = MakePlainScene(random);
  scene.Name = feature.Name + ", seed " + std::to_string(seed);
  scene.Shading = shading;
  feature.Apply(scene, random);
  Settle(scene);
  return scene;
}

ParityScene MakeRandomScene(std::uint32_t seed, int shading)
{
  Random random(seed);
  Scene scene = MakePlainScene(random);
  scene.Name = "seed " + std::to_string(seed) + ":";
  scene.Shading = shading;
  for (const ParityFeature& feature : ParityFeatures())
  {
    if (random.Chance(feature.Chance))
    {
      feature.Apply(scene, random);
      scene.Name += " [" + feature.Name + "]";
    }
  }
  Settle(scene);
  return scene;
}
