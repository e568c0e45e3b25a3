// SPDX-License-Identifier: BSD-3-Clause
#include "ShadingChoice.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vtkradiometry
{
namespace
{

using radiometry::DisplayLight;
using radiometry::DisplayMaterial;
using radiometry::Rgb;
using radiometry::ShadedScene;
using radiometry::Vec3;

constexpr double AtOnce = 1e6;
constexpr double LongestFrame = 1.0; // s: what counts of a pause between frames

class KeyOf
{
public:
  KeyOf(const ShadedScene& scene, const double* objectToWorld, double tolerance)
  {
    this->Add({ static_cast<double>(scene.Model.Reflection), double(scene.Model.LocalViewer),
      double(scene.Model.TwoSided), tolerance });
    this->Key.insert(this->Key.end(), objectToWorld, objectToWorld + 16);
    this->Add(scene.Front);
    this->Add(scene.Back);
    const bool highlights = !(scene.Front.Specular == Rgb()) || !(scene.Back.Specular == Rgb());
    if (highlights && scene.Model.LocalViewer)
    {
      this->Add(scene.Eye);
    }
    else if (highlights)
    {
      this->Add(scene.Viewer);
    }
    for (const DisplayLight& light : scene.Lights)
    {
      this->Key.insert(this->Key.end(), light.Position.begin(), light.Position.end());
      this->Key.insert(this->Key.end(), light.Attenuation.begin(), light.Attenuation.end());
      this->Add(light.SpotDirection);
      this->Add(light.Ambient);
      this->Add(light.Diffuse);
      this->Add(light.Specular);
      this->Add({ light.CosCutoff, light.SpotExponent, light.CosInnerCutoff,
        double(light.SmoothEdge), double(light.Enabled) });
    }
  }
  std::vector<double> Key;

private:
  void Add(std::initializer_list<double> values)
  {
    this->Key.insert(this->Key.end(), values.begin(), values.end());
  }
  void Add(const Vec3& v) { this->Add({ v.x, v.y, v.z }); }
  void Add(const Rgb& c) { this->Add({ c.r, c.g, c.b }); }
  void Add(const DisplayMaterial& m)
  {
    this->Add(m.Ambient);
    this->Add(m.Diffuse);
    this->Add(m.Specular);
    this->Add({ m.Shininess });
  }
};

} // namespace

void ShadingChoice::SetMesh(radiometry::ShadedMesh&& mesh)
{
  this->Object = std::move(mesh);
  this->Reset();
}

void ShadingChoice::Reset()
{
  this->Key.clear();
  this->Last.clear();
  this->Next = 0;
  this->Marked = 0;
  this->World = {};
  this->Marks.clear();
}

void ShadingChoice::PlaceMesh(const double* m)
{
  const std::size_t count = this->Object.Points.size();
  this->World.Points.resize(count);
  this->World.Normals.resize(count);
  this->World.Corners = this->Object.Corners;
  // Normals move as the shaders' do: by the inverse transpose, their lengths with them.
  const Vec3 r0{ m[0], m[1], m[2] };
  const Vec3 r1{ m[4], m[5], m[6] };
  const Vec3 r2{ m[8], m[9], m[10] };
  const Vec3 c0 = Cross(r1, r2);
  const Vec3 c1 = Cross(r2, r0);
  const Vec3 c2 = Cross(r0, r1);
  const double determinant = Dot(r0, c0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vec3& p = this->Object.Points[i];
    const Vec3& n = this->Object.Normals[i];
    this->World.Points[i] = { Dot(r0, p) + m[3], Dot(r1, p) + m[7], Dot(r2, p) + m[11] };
    this->World.Normals[i] = Vec3{ Dot(c0, n), Dot(c1, n), Dot(c2, n) } / determinant;
  }
}

ShadingChoice::State ShadingChoice::Decide(const radiometry::ShadedScene& scene,
  const double* objectToWorld, double tolerance, double share)
{
  const auto now = std::chrono::steady_clock::now();
  const double sinceLast = std::chrono::duration<double>(now - this->Time).count();
  this->Time = now;
  std::vector<double> key = KeyOf(scene, objectToWorld, tolerance).Key;
  if (key != this->Key)
  {
    const bool again = key == this->Last;
    if (!again && share < AtOnce)
    {
      this->Last = std::move(key);
      return State::Changing;
    }
    this->Key = std::move(key);
    ++this->Decision;
    this->Next = 0;
    this->Marked = 0;
    this->Marks.assign(this->Object.Size(), 0.0f);
    this->PlaceMesh(objectToWorld);
  }
  const std::size_t size = this->Object.Size();
  const std::chrono::duration<double> budget(
    share < AtOnce ? share * std::min(sinceLast, LongestFrame) : 1e9);
  // Steps of some 0.5 ms, so that the clock is looked at often enough.
  const std::size_t step =
    std::clamp<std::size_t>(16384 / std::max<std::size_t>(1, scene.Lights.size()), 16, 4096);
  while (this->Next < size && share > 0.0)
  {
    const std::size_t end = std::min(size, this->Next + step);
    MarkGouraud(scene, this->World, this->Next, end, tolerance, this->Marks);
    for (; this->Next < end; ++this->Next)
    {
      this->Marked += this->Marks[this->Next] != 0.0f ? 1 : 0;
    }
    if (std::chrono::steady_clock::now() - now > budget)
    {
      break;
    }
  }
  if (this->Next < size)
  {
    return State::Deciding;
  }
  this->World = {};
  return State::Decided;
}

} // namespace vtkradiometry
