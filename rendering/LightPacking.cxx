// SPDX-License-Identifier: BSD-3-Clause
// Lights into the texels that the shaders read: see PackedLights in LightCollector.h.
#include "LightCollector.h"

#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"

namespace vtkradiometry
{
namespace
{

using radiometry::DisplayLight;
using radiometry::Rgb;
using radiometry::Vec3;

void Put(std::vector<float>& texels, double x, double y, double z, double w)
{
  texels.push_back(static_cast<float>(x));
  texels.push_back(static_cast<float>(y));
  texels.push_back(static_cast<float>(z));
  texels.push_back(static_cast<float>(w));
}

bool IsBlack(const Rgb& c)
{
  return c == Rgb();
}

Vec3 TransformPoint(vtkMatrix4x4* m, const Vec3& p)
{
  double in[4] = { p.x, p.y, p.z, 1.0 };
  double out[4];
  m->MultiplyPoint(in, out);
  return { out[0] / out[3], out[1] / out[3], out[2] / out[3] };
}

/// A direction moves with the surface (no inverse transpose); its length is made one.
Vec3 TransformDirection(vtkMatrix4x4* m, const Vec3& d)
{
  double in[4] = { d.x, d.y, d.z, 0.0 };
  double out[4];
  m->MultiplyPoint(in, out);
  return radiometry::Normalized({ out[0], out[1], out[2] });
}

} // namespace

PackedLights PackLights(const CollectedLights& lights, const LocalCoordinates& local,
  vtkMatrix4x4* objectToWorld, radiometry::ReflectionModel reflection, double scale,
  double metersPerUnit)
{
  PackedLights packed;
  vtkNew<vtkMatrix4x4> objectToLocal;
  vtkMatrix4x4::Multiply4x4(local.FromWorld, objectToWorld, objectToLocal);
  // Radiance of a Lambertian surface is E/pi: the division is done once, here.
  const double unit = scale *
    (reflection == radiometry::ReflectionModel::Physical ? 1.0 / vtkMath::Pi() : 1.0);
  for (int kind = 0; kind < 3; ++kind)
  {
    const int texels = static_cast<int>(packed.Texels.size() / 4);
    packed.Ranges[kind][0] = texels / PackedLights::TexelsPerLight;
    for (std::size_t i = 0; i < lights.Lights.size(); ++i)
    {
      const DisplayLight& light = lights.Lights[i];
      const bool directional = light.Position[3] == 0.0;
      const bool spot = !directional && light.CosCutoff > -1.0;
      const bool black =
        IsBlack(light.Diffuse) && IsBlack(light.Ambient) && IsBlack(light.Specular);
      if ((directional ? 0 : (spot ? 2 : 1)) != kind || black || !light.Enabled || scale == 0.0)
      {
        continue;
      }
      vtkMatrix4x4* toLocal = lights.Frames[i] == LightFrame::Scene
        ? local.FromWorld.Get()
        : (lights.Frames[i] == LightFrame::Object ? objectToLocal.Get() : local.FromView.Get());
      const Vec3 given{ light.Position[0], light.Position[1], light.Position[2] };
      const Vec3 place =
        directional ? TransformDirection(toLocal, given) : TransformPoint(toLocal, given);
      const Vec3 axis = TransformDirection(toLocal, light.SpotDirection);
      const auto& a = light.Attenuation;
      const bool constant = a[0] == 1.0 && a[1] == 0.0 && a[2] == 0.0;
      const bool square = !directional && a[0] == 0.0 && a[1] == 0.0;
      // 1/(c r^2): c is part of the colours, so that shaders need 1/r^2 alone.
      const double c = square ? a[2] * metersPerUnit * metersPerUnit : 1.0;
      const Rgb diffuse = unit / c * light.Diffuse;
      const Rgb specular = unit / c * light.Specular;
      const Rgb ambient = scale / c * light.Ambient;
      const double width = light.CosInnerCutoff - light.CosCutoff;
      Put(packed.Texels, place.x, place.y, place.z, -1.0);
      packed.Keys.push_back(lights.Keys[i]);
      Put(packed.Texels, axis.x, axis.y, axis.z, 1.0 - light.CosCutoff);
      Put(packed.Texels, diffuse.r, diffuse.g, diffuse.b, light.SpotExponent);
      Put(packed.Texels, ambient.r, ambient.g, ambient.b, light.CosInnerCutoff);
      // Lights with a hard edge have a step of any great slope there.
      Put(packed.Texels, specular.r, specular.g, specular.b,
        light.SmoothEdge && width > 0.0 ? 1.0 / width : 1e30);
      Put(packed.Texels, a[0], a[1] * metersPerUnit,
        square ? 1.0 : a[2] * metersPerUnit * metersPerUnit, 0.0);

      packed.Features.insert(directional ? "Directional" : (spot ? "Spot" : "Point"));
      packed.Features.insert("Lights");
      const auto need = [&packed](bool needed, const char* feature) {
        if (needed)
        {
          packed.Features.insert(feature);
        }
      };
      need(!IsBlack(light.Ambient), "LightAmbient");
      need(!(light.Specular == light.Diffuse), "LightSpecular");
      need(spot && light.SpotExponent != 0.0, "SpotExponent");
      need(spot && light.SmoothEdge && width > 0.0, "SmoothEdge");
      if (!directional)
      {
        need(!constant && !square, "Attenuation");
        need(square, "InverseSquare");
        need(constant, "NoFallOff");
      }
    }
    packed.Ranges[kind][1] =
      static_cast<int>(packed.Texels.size() / 4) / PackedLights::TexelsPerLight;
  }
  // One formula for all lights: the polynomial where they differ.
  ShaderFeatures& f = packed.Features;
  if (f.count("InverseSquare") && f.count("NoFallOff"))
  {
    f.insert("Attenuation");
  }
  if (f.count("Attenuation"))
  {
    f.erase("InverseSquare");
  }
  f.erase("NoFallOff");
  return packed;
}

} // namespace vtkradiometry
