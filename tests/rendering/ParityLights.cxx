// SPDX-License-Identifier: BSD-3-Clause
// Features of the lights.
#include "ParityMaking.h"

#include <cmath>

using namespace radiometry;

namespace parity
{

ParityLight& AddLight(Scene& scene, Random& random, LightKind kind)
{
  ParityLight added;
  DisplayLight& light = added.Light;
  const Vec3 from = random.In(1.2, 2.5) * random.Direction();
  light.Position = { { from.x, from.y, from.z, kind == Directional ? 0.0 : 1.0 } };
  light.Diffuse = random.Color(0.0, kind == Directional ? 4.0 : 12.0);
  light.Specular = light.Diffuse;
  light.SpotDirection = Normalized(0.6 * random.Direction() - from); // past the middle
  light.Attenuation = { { 0.0, 0.0, 1.0 } };
  if (kind == Spot)
  {
    light.CosCutoff = random.Chance(0.2) ? 0.0 : std::cos(random.In(0.25, 1.3));
  }
  scene.Lights.push_back(added);
  return scene.Lights.back();
}

void NeedLight(Scene& scene, Random& random)
{
  if (scene.Lights.empty())
  {
    AddLight(scene, random, Point);
    AddLight(scene, random, random.Chance(0.5) ? Directional : Spot);
  }
}

namespace
{

void AttachLights(Scene& scene, Random& random, ParityFrame frame)
{
  NeedLight(scene, random);
  AddLight(scene, random, Spot);
  AddLight(scene, random, Directional);
  for (ParityLight& given : scene.Lights)
  {
    if (!random.Chance(0.7))
    {
      continue;
    }
    given.Frame = frame;
    DisplayLight& light = given.Light;
    if (frame == ParityFrame::Camera)
    {
      // Beside the eye, shining into the picture.
      const Vec3 aside = scene.RendererLights ? 0.3 * random.Direction() + Vec3{ 0, 0, 1 }
                                              : random.In(0.0, 1.0) * random.Direction();
      light.Position = { { aside.x, aside.y, aside.z, light.Position[3] } };
      if (light.Position[3] == 0.0)
      {
        light.Position = { { 0.5 * aside.x, 0.5 * aside.y, 1.0, 0.0 } };
      }
      light.SpotDirection = { 0.1 * aside.x, 0.1 * aside.y, -1.0 };
    }
  }
}

void ManyLights(Scene& scene, Random& random)
{
  const int count = 1 + random.Below(300);
  for (int i = 0; i < count; ++i)
  {
    DisplayLight& light = AddLight(scene, random, static_cast<LightKind>(random.Below(3))).Light;
    light.Diffuse = (20.0 / count) * light.Diffuse;
    light.Specular = light.Diffuse;
  }
}

} // namespace

void AddLightFeatures(const AddFeature& add)
{
  add("point light", 0.6, [](Scene& s, Random& r) { AddLight(s, r, Point); });
  add("directional light (w = 0)", 0.4, [](Scene& s, Random& r) { AddLight(s, r, Directional); });
  add("spot light, cutoff", 0.4, [](Scene& s, Random& r) { AddLight(s, r, Spot); });
  add("spot light, exponent 0 to 128", 0.2, [](Scene& s, Random& r) {
    AddLight(s, r, Spot).Light.SpotExponent = std::exp(r.In(-2.0, std::log(128.0)));
    AddLight(s, r, Spot).Light.SpotExponent = r.In(0.0, 5.0);
  });
  add("spot light, inner cone", 0.2, [](Scene& s, Random& r) {
    DisplayLight& light = AddLight(s, r, Spot).Light;
    light.SmoothEdge = true;
    light.CosInnerCutoff = light.CosCutoff + (1.0 - light.CosCutoff) * r.In(0.2, 0.9);
  });
  add("no fall-off", 0.1, [](Scene& s, Random& r) {
    AddLight(s, r, r.Chance(0.5) ? Point : Spot).Light.Attenuation = { { 1.0, 0.0, 0.0 } };
  });
  add("attenuation a + b r + c r^2", 0.2, [](Scene& s, Random& r) {
    NeedLight(s, r);
    for (ParityLight& given : s.Lights)
    {
      given.Light.Attenuation = { { r.In(0.1, 1.0), r.In(0.0, 0.5), r.In(0.0, 0.5) } };
    }
  });
  add("1 to 300 lights", 0.03, ManyLights);
  add("lights switched off", 0.15, [](Scene& s, Random& r) {
    NeedLight(s, r);
    AddLight(s, r, Point).Light.Enabled = false;
    AddLight(s, r, Spot).Light.Enabled = false;
    s.Lights.front().Light.Enabled = r.Chance(0.5);
  });
  add("lights' own ambient", 0.2, [](Scene& s, Random& r) {
    NeedLight(s, r);
    s.Front.Ambient = r.Color(0.1, 1.0);
    s.Back.Ambient = r.Color(0.1, 1.0);
    for (ParityLight& given : s.Lights)
    {
      given.Light.Ambient = r.Color(0.0, 1.0);
    }
  });
  add("lights' own specular", 0.2, [](Scene& s, Random& r) {
    NeedHighlight(s, r);
    for (ParityLight& given : s.Lights)
    {
      given.Light.Specular = r.Color(0.0, 6.0);
    }
  });
  add("vtkLights of the renderer", 0.1, [](Scene& s, Random& r) {
    NeedLight(s, r);
    s.RendererLights = true;
  });
  add("attached to the object", 0.1, [](Scene& s, Random& r) {
    if (!s.RendererLights)
    {
      AttachLights(s, r, ParityFrame::Object);
      Transform(s, r, r.Chance(0.5), r.Chance(0.3));
    }
  });
  add("attached to the camera", 0.1,
    [](Scene& s, Random& r) { AttachLights(s, r, ParityFrame::Camera); });
  add("exposure and metres", 0.15, [](Scene& s, Random& r) {
    NeedLight(s, r);
    s.LightScale = std::pow(10.0, r.In(-1.0, 1.5));
    s.MetersPerUnit = s.RendererLights ? 1.0 : std::pow(10.0, r.In(-0.5, 0.5));
  });
}

} // namespace parity
