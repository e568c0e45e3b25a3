// SPDX-License-Identifier: BSD-3-Clause
#include "ParityScene.h"

#include <algorithm>
#include <cmath>

using namespace radiometry;

Rgb ParityRandom::Color(double least, double most)
{
  const double r = this->In(least, most);
  const double g = this->In(least, most);
  return { r, g, this->In(least, most) };
}

Vec3 ParityRandom::Direction()
{
  const double z = this->In(-1.0, 1.0);
  const double phi = this->In(0.0, 2.0 * 3.14159265358979323846);
  const double s = std::sqrt(1.0 - z * z);
  return { s * std::cos(phi), s * std::sin(phi), z };
}

Vec3 ParityScene::DirectionToWorld(const Vec3& d) const
{
  const Matrix3& m = this->Transform;
  return { m[0][0] * d.x + m[0][1] * d.y + m[0][2] * d.z,
    m[1][0] * d.x + m[1][1] * d.y + m[1][2] * d.z, m[2][0] * d.x + m[2][1] * d.y + m[2][2] * d.z };
}

Vec3 ParityScene::ToWorld(const Vec3& p) const
{
  return this->DirectionToWorld(p) + this->Shift;
}

int ParityScene::ShadingInEffect() const
{
  bool highlights = false;
  if (this->Colors == ParityColors::Materials)
  {
    const auto shines = [](const DisplayMaterial& m) { return !(m.Specular == Rgb()); };
    highlights = std::any_of(this->CellFront.begin(), this->CellFront.end(), shines) ||
      std::any_of(this->CellBack.begin(), this->CellBack.end(), shines) ||
      (this->HasBack && this->CellBack.empty() && shines(this->Back));
  }
  if (this->Shading == 1 && (this->ShowsField() || this->KnowsShadows()))
  {
    return 2;
  }
  return this->Shading == 1 && (this->Normals.empty() || highlights) ? 2 : this->Shading;
}

void ParityScene::Prepare()
{
  const Vec3 back = Normalized(this->Eye - this->Focus);
  const Vec3 right = Normalized(Cross(this->Up, back));
  this->ViewAxes = { { right, Cross(back, right), back } };
  const std::array<Vec3, 3>& axes = this->ViewAxes;
  this->WorldPoints.clear();
  this->ScreenPoints.clear();
  const double slope = std::tan(0.5 * this->ViewAngle * 3.14159265358979323846 / 180.0);
  for (const Vec3& p : this->Points)
  {
    const Vec3 world = this->ToWorld(p);
    const Vec3 d = world - this->Eye;
    const double depth = -Dot(d, back);
    const double half = this->Parallel ? this->ParallelScale : depth * slope;
    this->WorldPoints.push_back(world);
    this->ScreenPoints.push_back({ Dot(d, right) / half, Dot(d, axes[1]) / half, depth });
  }
  // vtkLights that move with the camera are given with the eye at (0, 0, 1), the focus at the origin.
  const double distance = Length(this->Eye - this->Focus);
  const Vec3 origin = this->RendererLights ? this->Focus : this->Eye;
  const double unit = this->RendererLights ? distance : 1.0;
  this->WorldLights.clear();
  for (const ParityLight& given : this->Lights)
  {
    DisplayLight light = given.Light;
    Vec3 place{ light.Position[0], light.Position[1], light.Position[2] };
    const bool finite = light.Position[3] != 0.0;
    const auto turned = [&axes](const Vec3& d) {
      return d.x * axes[0] + d.y * axes[1] + d.z * axes[2];
    };
    if (given.Frame == ParityFrame::Object)
    {
      place = finite ? this->ToWorld(place) : this->DirectionToWorld(place);
      light.SpotDirection = this->DirectionToWorld(light.SpotDirection);
    }
    else if (given.Frame == ParityFrame::Camera)
    {
      place = finite ? origin + unit * turned(place) : turned(place);
      light.SpotDirection = turned(light.SpotDirection);
    }
    light.Position = { { place.x, place.y, place.z, light.Position[3] } };
    for (Vec3& corner : light.Polygon)
    {
      corner = given.Frame == ParityFrame::Object ? this->ToWorld(corner)
        : given.Frame == ParityFrame::Camera      ? origin + unit * turned(corner)
                                                  : corner;
    }
    light.Reference = given.Frame == ParityFrame::Object ? this->DirectionToWorld(light.Reference)
      : given.Frame == ParityFrame::Camera               ? turned(light.Reference)
                                                         : light.Reference;
    light.Attenuation[1] *= this->MetersPerUnit;
    light.Attenuation[2] *= this->MetersPerUnit * this->MetersPerUnit;
    for (Rgb* color : { &light.Ambient, &light.Diffuse, &light.Specular })
    {
      *color = this->LightScale * *color;
    }
    this->WorldLights.push_back(light);
  }
}
