// SPDX-License-Identifier: BSD-3-Clause
#include "ParityScene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace radiometry;

namespace
{

constexpr double Pi = 3.14159265358979323846;

class Random
{
public:
  explicit Random(std::uint32_t seed)
    : Engine(seed)
  {
  }
  double In(double a, double b)
  {
    return a + (b - a) * (static_cast<double>(this->Engine()) / 4294967296.0);
  }
  bool Chance(double p) { return this->In(0.0, 1.0) < p; }
  Rgb Color(double least, double most)
  {
    return { this->In(least, most), this->In(least, most), this->In(least, most) };
  }
  Vec3 Direction()
  {
    const double z = this->In(-1.0, 1.0);
    const double phi = this->In(0.0, 2.0 * Pi);
    const double s = std::sqrt(1.0 - z * z);
    return { s * std::cos(phi), s * std::sin(phi), z };
  }
  std::mt19937 Engine;
};

Vec3 ToFloat(const Vec3& v)
{
  return { static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z) };
}

DisplayLight MakeLight(Random& random, int kind, const ParityFeatures& f)
{
  DisplayLight light;
  const Vec3 from = random.In(1.2, 2.5) * random.Direction();
  light.Position = { { from.x, from.y, from.z, kind == 0 ? 0.0 : 1.0 } };
  light.Diffuse = random.Color(0.0, kind == 0 ? 4.0 : 12.0);
  light.Specular = f.AnythingElse && random.Chance(0.3) ? random.Color(0.0, 3.0) : light.Diffuse;
  if (f.AnythingElse && random.Chance(0.3))
  {
    light.Ambient = random.Color(0.0, 0.5);
  }
  light.SpotDirection =
    Normalized(0.6 * random.Direction() - from); // roughly to the origin, off centre
  if (kind == 2)
  {
    light.CosCutoff = random.Chance(0.2) ? 0.0 : std::cos(random.In(0.25, 1.3));
    if (random.Chance(0.6))
    {
      light.SpotExponent = random.In(0.0, 30.0);
    }
    if (random.Chance(0.4))
    {
      light.SmoothEdge = true;
      light.CosInnerCutoff = light.CosCutoff + (1.0 - light.CosCutoff) * random.In(0.2, 0.9);
    }
  }
  const double kindOfFallOff = random.In(0.0, 1.0);
  if (f.Attenuation || kindOfFallOff < 0.3)
  {
    light.Attenuation = { { random.In(0.1, 1.0), random.In(0.0, 0.5), random.In(0.0, 0.5) } };
  }
  else if (kindOfFallOff < 0.8)
  {
    light.Attenuation = { { 0.0, 0.0, 1.0 } };
  }
  return light;
}

DisplayMaterial MakeMaterial(Random& random, const ParityFeatures& f)
{
  DisplayMaterial material;
  material.Diffuse = random.Color(0.1, 1.0);
  if (f.AnythingElse && random.Chance(0.5))
  {
    material.Ambient = random.Color(0.1, 1.0);
  }
  if (f.Specular || (f.AnythingElse && random.Chance(0.6)))
  {
    material.Specular = random.Color(0.1, 1.0);
  }
  material.Shininess = random.Chance(0.1) ? 0.0 : random.In(1.0, 60.0);
  if (f.Emission || (f.AnythingElse && random.Chance(0.3)))
  {
    material.Emission = random.Color(0.0, 3.0);
  }
  return material;
}

} // namespace

Vec3 ParityScene::ToWorld(const Vec3& p) const
{
  const Matrix3& m = this->Transform;
  return Vec3{ m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z,
           m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z,
           m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z } +
    this->Shift;
}

ParityScene MakeParityScene(std::uint32_t seed, int shading, const ParityFeatures& f)
{
  Random random(seed);
  ParityScene scene;
  scene.Seed = seed;
  scene.Shading = shading;
  scene.Model.Reflection = static_cast<ReflectionModel>(random.Engine() % 3);
  scene.Model.LocalViewer = !f.ViewerAtInfinity && random.Chance(0.7);
  scene.HasBack = f.BackMaterial || (f.AnythingElse && random.Chance(0.3));
  scene.Model.TwoSided = f.TwoSided || scene.HasBack || random.Chance(0.5);
  scene.Model.GlobalAmbient = random.Color(0.0, 1.0);
  scene.Front = MakeMaterial(random, f);
  scene.Back = scene.HasBack ? MakeMaterial(random, f) : scene.Front;
  scene.Back.Emission = random.Color(0.0, 2.0);

  const bool kinds[3] = { f.Directional, f.Point, f.Spot };
  for (int kind = 0; kind < 3; ++kind)
  {
    const int count = (kinds[kind] ? 1 : 0) + (f.AnythingElse ? random.Engine() % 3 : 0);
    for (int i = 0; i < count; ++i)
    {
      scene.Lights.push_back(MakeLight(random, kind, f));
    }
  }

  for (int t = 0; t < 5; ++t)
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
  scene.Transform = { { { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 1 } } } };
  if (f.Transformed || (f.AnythingElse && random.Chance(0.4)))
  {
    // Rotation, non-uniform scale, sometimes a mirror.
    const Vec3 u = random.Direction();
    const Vec3 v = Normalized(Cross(u, random.Direction()));
    const Vec3 w = Cross(u, v);
    const double s[3] = { random.In(0.6, 1.4), random.In(0.6, 1.4),
      random.In(0.6, 1.4) * (random.Chance(0.4) ? -1.0 : 1.0) };
    for (int i = 0; i < 3; ++i)
    {
      scene.Transform[i] = { { u[i] * s[0], v[i] * s[1], w[i] * s[2] } };
    }
    scene.Shift = 0.2 * random.Direction();
  }

  scene.Parallel = f.AnythingElse && random.Chance(0.25);
  scene.Eye = random.In(2.5, 5.0) * random.Direction();
  scene.Focus = 0.2 * random.Direction();
  scene.Up = Normalized(Cross(random.Direction(), scene.Eye - scene.Focus));
  return scene;
}

ParityPixel EvaluatePixel(const ParityScene& scene, double x, double y, int size)
{
  const Vec3 back = Normalized(scene.Eye - scene.Focus); // +z of the view
  const Vec3 right = Normalized(Cross(scene.Up, back));
  const Vec3 up = Cross(back, right);
  const double sx = 2.0 * (x + 0.5) / size - 1.0;
  const double sy = 2.0 * (y + 0.5) / size - 1.0;
  const double half = scene.Parallel ? scene.ParallelScale
                                     : std::tan(0.5 * scene.ViewAngle * Pi / 180.0);
  const Vec3 offset = half * (sx * right + sy * up);
  const Vec3 origin = scene.Parallel ? scene.Eye + offset : scene.Eye;
  const Vec3 ray = scene.Parallel ? -back : offset - back; // unit along the axis

  ParityPixel pixel;
  double nearest = std::numeric_limits<double>::infinity();
  double second = nearest;
  bool atEdge = false;
  std::size_t hit = 0;
  double weights[3] = { 0, 0, 0 };
  for (std::size_t t = 0; t < scene.Points.size() / 3; ++t)
  {
    const Vec3 a = scene.ToWorld(scene.Points[3 * t]);
    const Vec3 b = scene.ToWorld(scene.Points[3 * t + 1]);
    const Vec3 c = scene.ToWorld(scene.Points[3 * t + 2]);
    const Vec3 n = Cross(b - a, c - a);
    const double facing = Dot(ray, n);
    const double along = Dot(a - origin, n) / facing;
    const Vec3 p = origin + along * ray;
    const double u = Dot(Cross(c - b, p - b), n) / LengthSquared(n);
    const double v = Dot(Cross(a - c, p - c), n) / LengthSquared(n);
    const double least = std::min({ u, v, 1.0 - u - v });
    // Triangles seen nearly edge-on: what they cover is a matter of rounding, and the rasteriser's
    // interpolation in float is conditioned by 1/cos.
    const bool grazing = std::abs(facing) < 0.1 * Length(n) * Length(ray);
    if (std::abs(least) < 0.02 || (grazing && least > -0.5))
    {
      atEdge = true;
    }
    if (least > 0.0 && along > 0.0)
    {
      if (along < nearest)
      {
        second = nearest;
        nearest = along;
        hit = t;
        weights[0] = u;
        weights[1] = v;
        weights[2] = 1.0 - u - v;
      }
      else
      {
        second = std::min(second, along);
      }
    }
  }
  pixel.Hit = std::isfinite(nearest);
  pixel.Comparable = !atEdge && !(second - nearest < 1e-3);
  if (!pixel.Hit)
  {
    return pixel;
  }
  pixel.Depth = nearest;

  LightingModel model = scene.Model;
  model.LocalViewer = model.LocalViewer && !scene.Parallel;
  ShadingSample sample;
  sample.Eye = scene.Eye;
  sample.Viewer = back;
  const auto corner = [&](int i) { return scene.ToWorld(scene.Points[3 * hit + i]); };
  const auto cornerNormal = [&](int i) { return scene.Normals[3 * hit + i]; };
  const Triangle3 object{ scene.Points[3 * hit], scene.Points[3 * hit + 1],
    scene.Points[3 * hit + 2] };
  const Vec3 faceNormal = TransformNormal(scene.Transform, AreaNormal2(object));
  sample.FrontFacing = Dot(faceNormal, ray) < 0.0;
  const bool behind = model.TwoSided && !sample.FrontFacing;
  const DisplayMaterial& material = behind ? scene.Back : scene.Front;

  std::vector<ShadingSample> samples; // where the model is evaluated
  if (scene.Shading == 1)
  {
    for (int i = 0; i < 3; ++i)
    {
      sample.Point = corner(i);
      sample.Normal = TransformNormal(scene.Transform, cornerNormal(i));
      samples.push_back(sample);
    }
  }
  else if (scene.Shading == 2)
  {
    sample.Point = origin + nearest * ray;
    sample.Normal = TransformNormal(scene.Transform,
      weights[0] * cornerNormal(0) + weights[1] * cornerNormal(1) + weights[2] * cornerNormal(2));
    samples.push_back(sample);
  }
  else
  {
    sample.Point = (corner(0) + corner(1) + corner(2)) / 3.0;
    sample.Normal = faceNormal;
    samples.push_back(sample);
  }
  pixel.Normal = behind ? -samples[0].Normal : samples[0].Normal;

  // The model jumps at the edge of a cone and where a light sets: no two machines agree there.
  for (const ShadingSample& s : samples)
  {
    for (const DisplayLight& light : scene.Lights)
    {
      const Vec3 position{ light.Position[0], light.Position[1], light.Position[2] };
      const Vec3 L = Normalized(light.Position[3] == 0.0 ? position : position - s.Point);
      const bool sets = std::abs(Dot(s.Normal, L)) < 1e-4;
      const bool rim = light.Position[3] != 0.0 && light.CosCutoff > -1.0 &&
        std::abs(Dot(light.SpotDirection, -L) - light.CosCutoff) < 1e-5;
      if (sets || rim)
      {
        pixel.Comparable = false;
      }
    }
  }

  LightSums sums;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    ShadingSample side = samples[i];
    side.Normal = behind ? -side.Normal : side.Normal;
    const LightSums at = SumLights(model, scene.Lights, material.Shininess, side);
    const double w = samples.size() == 1 ? 1.0 : weights[i];
    sums.Ambient += w * at.Ambient;
    sums.Diffuse += w * at.Diffuse;
    sums.Specular += w * at.Specular;
  }
  pixel.Color = ApplyMaterial(model, material, sums).Color;
  return pixel;
}

double FloatSensitivity(const ParityScene& scene, int x, int y, int size)
{
  const ParityPixel here = EvaluatePixel(scene, x, y, size);
  const double half = scene.Parallel
    ? scene.ParallelScale
    : here.Depth * std::tan(0.5 * scene.ViewAngle * Pi / 180.0);
  const double shift = std::ldexp(here.Depth, -22) / (2.0 * half / size); // in pixels
  double most = 0.0;
  for (const auto& d : { std::array<double, 2>{ { 1.0, 0.0 } }, { { -1.0, 0.0 } },
         { { 0.0, 1.0 } }, { { 0.0, -1.0 } } })
  {
    const Rgb c = EvaluatePixel(scene, x + shift * d[0], y + shift * d[1], size).Color;
    most = std::max({ most, std::abs(c.r - here.Color.r), std::abs(c.g - here.Color.g),
      std::abs(c.b - here.Color.b) });
  }
  return most;
}
