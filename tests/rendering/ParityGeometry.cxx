// SPDX-License-Identifier: BSD-3-Clause
// Features of geometry, transforms and cameras.
#include "ParityMaking.h"

#include <cmath>
#include <limits>

using namespace radiometry;

namespace parity
{

Vec3 ToFloat(const Vec3& v)
{
  return { static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z) };
}

void Transform(Scene& scene, Random& random, bool uniform, bool mirror)
{
  const Vec3 u = random.Direction();
  const Vec3 v = Normalized(Cross(u, random.Direction()));
  const Vec3 w = Cross(u, v);
  const double s = random.In(0.7, 1.3);
  double scale[3] = { s, s, s };
  for (int i = 0; i < 3 && !uniform; ++i)
  {
    scale[i] = random.In(0.5, 1.5);
  }
  scale[2] *= mirror ? -1.0 : 1.0;
  for (int i = 0; i < 3; ++i)
  {
    scene.Transform[i] = { { u[i] * scale[0], v[i] * scale[1], w[i] * scale[2] } };
  }
  scene.Shift = 0.2 * random.Direction();
}

namespace
{

/// The same scene, larger or smaller in all lengths: it looks the same.
void Scale(Scene& scene, double s)
{
  scene.Unit = s;
  for (Vec3& p : scene.Points)
  {
    p = ToFloat(s * p);
  }
  scene.Shift = s * scene.Shift;
  scene.Eye = s * scene.Eye;
  scene.Focus = s * scene.Focus;
  scene.ParallelScale *= s;
  for (ParityLight& given : scene.Lights)
  {
    DisplayLight& light = given.Light;
    const bool relative = scene.RendererLights && given.Frame == ParityFrame::Camera;
    for (int i = 0; i < 3 && light.Position[3] != 0.0 && !relative; ++i)
    {
      light.Position[i] *= s;
    }
    light.Attenuation[1] /= s;
    light.Attenuation[2] /= s * s;
  }
}

/// Far from the origin: by the coordinates of the points (as in UTM) or by the actor's place.
void MoveAway(Scene& scene, Random& random)
{
  const double exponent = random.Chance(0.5) ? random.In(2.0, 4.0) : random.In(1.0, 7.0);
  const Vec3 offset = std::pow(10.0, exponent) * random.Direction();
  bool ofObject = false;
  for (const ParityLight& light : scene.Lights)
  {
    ofObject = ofObject || light.Frame == ParityFrame::Object;
  }
  const Matrix3& m = scene.Transform;
  const bool turned = !(m[0][0] == 1.0 && m[1][1] == 1.0 && m[2][2] == 1.0);
  if (turned || ofObject || random.Chance(0.3))
  {
    scene.Shift += offset;
  }
  else
  {
    for (Vec3& p : scene.Points)
    {
      p += offset;
    }
  }
  scene.Eye += offset;
  scene.Focus += offset;
  for (ParityLight& given : scene.Lights)
  {
    if (given.Frame == ParityFrame::Scene && given.Light.Position[3] != 0.0)
    {
      given.Light.Position[0] += offset.x;
      given.Light.Position[1] += offset.y;
      given.Light.Position[2] += offset.z;
    }
  }
}

void SpoilNormals(Scene& scene, Random& random)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < scene.Normals.size(); ++i)
  {
    if (i / 3 % 2 == 0 && random.Chance(0.5))
    {
      scene.Normals[i] = random.Chance(0.5) ? Vec3{} : Vec3{ nan, nan, nan };
    }
  }
}

} // namespace

void AddGeometryFeatures(const AddFeature& add)
{
  add("multiblock", 0.15, [](Scene& s, Random& r) {
    NeedLight(s, r);
    s.TrianglesPerBlock = s.TrianglesPerBlock ? s.TrianglesPerBlock : 1 + r.Below(3);
  });
  add("no point normals", 0.1, [](Scene& s, Random& r) {
    NeedLight(s, r);
    s.Normals.clear();
  });
  add("normals of any length", 0.1, [](Scene& s, Random& r) {
    NeedLight(s, r);
    for (std::size_t t = 0; t < s.Normals.size() / 3; ++t)
    {
      const double length = std::pow(10.0, r.In(-6.0, 6.0));
      for (int i = 0; i < 3; ++i)
      {
        s.Normals[3 * t + i] = ToFloat(length * s.Normals[3 * t + i]);
      }
    }
  });
  add("normals zero and NaN", 0.05, [](Scene& s, Random& r) {
    NeedLight(s, r);
    SpoilNormals(s, r);
  });
  add("rotated and scaled actor", 0.2, [](Scene& s, Random& r) {
    NeedLight(s, r);
    Transform(s, r, r.Chance(0.3), false);
  });
  add("mirrored actor", 0.1, [](Scene& s, Random& r) {
    NeedLight(s, r);
    Transform(s, r, r.Chance(0.3), true);
  });
  add("parallel projection", 0.25, [](Scene& s, Random& r) {
    NeedHighlight(s, r);
    s.Parallel = true;
    s.ParallelScale = r.In(1.0, 2.0);
  });
  add("tiny scene (1e-7 to 1e-3)", 0.05, [](Scene& s, Random& r) {
    NeedLight(s, r);
    Scale(s, std::pow(10.0, r.In(-7.0, -3.0)));
  });
  add("huge scene (1e3 to 1e7)", 0.05, [](Scene& s, Random& r) {
    NeedLight(s, r);
    Scale(s, (1.0 / s.Unit) * std::pow(10.0, r.In(3.0, 7.0)));
  });
  add("far from the origin (10 to 1e7)", 0.08, [](Scene& s, Random& r) {
    NeedLight(s, r);
    if (s.Unit == 1.0)
    {
      MoveAway(s, r);
    }
  });
}

} // namespace parity
