// SPDX-License-Identifier: BSD-3-Clause
// Lights into the texels that the shaders read: see PackedLights in LightCollector.h.
#include "LightCollector.h"

#include "radiometry/scene/CandelaWeb.h"

#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"

#include <algorithm>
#include <map>

namespace vtkradiometry
{

radiometry::Vec3 TransformPoint(vtkMatrix4x4* m, const radiometry::Vec3& p)
{
  double in[4] = { p.x, p.y, p.z, 1.0 };
  double out[4];
  m->MultiplyPoint(in, out);
  return { out[0] / out[3], out[1] / out[3], out[2] / out[3] };
}

radiometry::Vec3 TransformDirection(vtkMatrix4x4* m, const radiometry::Vec3& d)
{
  double in[4] = { d.x, d.y, d.z, 0.0 };
  double out[4];
  m->MultiplyPoint(in, out);
  return radiometry::Normalized({ out[0], out[1], out[2] });
}

bool NeedsExtendedLights(const ShaderFeatures& features)
{
  return features.count("Luminaire") + features.count("Area") + features.count("Sky") > 0;
}

LightKind KindOf(const radiometry::DisplayLight& light)
{
  if (light.Sky)
  {
    return LightKind::Sky;
  }
  if (!light.Polygon.empty())
  {
    return LightKind::Area;
  }
  if (light.Position[3] == 0.0)
  {
    return LightKind::Directional;
  }
  if (light.Web)
  {
    return LightKind::Luminaire;
  }
  return light.CosCutoff > -1.0 ? LightKind::Spot : LightKind::Point;
}

bool GivesLight(const radiometry::DisplayLight& light, double scale)
{
  const radiometry::Rgb black;
  return light.Enabled && scale != 0.0 &&
    !(light.Diffuse == black && light.Ambient == black && light.Specular == black);
}

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

const char* const KindFeatures[LightKinds] = { "Directional", "Point", "Spot", "Luminaire", "Area",
  "Sky" };

/// A rotation: where the axes go, made square again where the map is not conformal.
std::array<Vec3, 3> RowsOf(vtkMatrix4x4* toLocal)
{
  const Vec3 x = TransformDirection(toLocal, { 1.0, 0.0, 0.0 });
  const Vec3 up = TransformDirection(toLocal, { 0.0, 0.0, 1.0 });
  const Vec3 right = radiometry::Normalized(x - Dot(x, up) * up);
  const Vec3 forward = TransformDirection(toLocal, { 0.0, 1.0, 0.0 });
  const Vec3 third = Cross(up, right);
  const Vec3 y = Dot(third, forward) < 0.0 ? -third : third;
  // The new axes seen in the old ones.
  return { { { right.x, y.x, up.x }, { right.y, y.y, up.y }, { right.z, y.z, up.z } } };
}

/// What comes after all lights.
class Appendix
{
public:
  /// `first`: its first texel in the buffer.
  explicit Appendix(int first)
    : First(first)
  {
  }
  /// The number of the next texel in the buffer.
  int Next() const { return this->First + static_cast<int>(this->Texels.size() / 4); }
  void Add(double x, double y, double z, double w) { Put(this->Texels, x, y, z, w); }
  /// Numbers, four a texel.
  void Add(const std::vector<double>& numbers)
  {
    for (std::size_t k = 0; k < numbers.size(); k += 4)
    {
      const auto at = [&](std::size_t c) { return k + c < numbers.size() ? numbers[k + c] : 0.0; };
      this->Add(at(0), at(1), at(2), at(3));
    }
  }
  /// The place of a web's angles and values, which lights share.
  int AddWeb(const radiometry::CandelaWeb* web)
  {
    const auto found = this->Webs.find(web);
    if (found != this->Webs.end())
    {
      return found->second;
    }
    const int place = this->Next();
    this->Webs[web] = place;
    const radiometry::CandelaWeb::PolarGrid& grid = web->Grid();
    std::vector<double> numbers = grid.Theta;
    numbers.insert(numbers.end(), grid.Psi.begin(), grid.Psi.end());
    numbers.insert(numbers.end(), grid.Value.begin(), grid.Value.end());
    this->Add(numbers);
    return place;
  }
  std::vector<float> Texels;

private:
  int First;
  std::map<const radiometry::CandelaWeb*, int> Webs;
};

/// The axes of a luminaire's grid; returns where they begin.
int AddLuminaire(const DisplayLight& light, vtkMatrix4x4* toLocal, Appendix& after)
{
  const auto axes = radiometry::LuminaireAxes(TransformDirection(toLocal, light.SpotDirection),
    TransformDirection(toLocal, light.Reference));
  const radiometry::CandelaWeb::PolarGrid& grid = light.Web->Grid();
  const auto row = [&axes](const Vec3& a) { return a.x * axes[0] + a.y * axes[1] + a.z * axes[2]; };
  const int data = after.AddWeb(light.Web.get());
  const int place = after.Next();
  const Vec3 x = row(grid.AxisX);
  const Vec3 y = row(grid.AxisY);
  const Vec3 pole = row(grid.Pole);
  after.Add(x.x, x.y, x.z, static_cast<double>(grid.Thetas()));
  after.Add(y.x, y.y, y.z, static_cast<double>(grid.Psis()));
  after.Add(pole.x, pole.y, pole.z, grid.Closed ? 1.0 : 0.0);
  after.Add(data, 0.0, 0.0, 0.0);
  return place;
}

/// An area light or a sky: where its data is, and its colour.
void PutExtended(const DisplayLight& light, vtkMatrix4x4* toLocal, double unit, int column,
  Appendix& after, PackedLights& packed)
{
  const Rgb color = unit * light.Diffuse;
  const int place = after.Next();
  if (light.Sky)
  {
    const radiometry::SkyQuadric sky = light.Sky->Rotated(RowsOf(toLocal));
    const auto add = [&after](const Rgb& c) { after.Add(c.r, c.g, c.b, 0.0); };
    add(sky.Constant);
    std::for_each(sky.Linear.begin(), sky.Linear.end(), add);
    std::for_each(sky.Quadratic.begin(), sky.Quadratic.end(), add);
    Put(packed.Texels, place, 0.0, 0.0, column);
  }
  else
  {
    for (const Vec3& corner : light.Polygon)
    {
      const Vec3 p = TransformPoint(toLocal, corner);
      after.Add(p.x, p.y, p.z, 0.0);
    }
    // A mirror turns the corners round; the light keeps its front.
    const double sides = light.PolygonTwoSided ? 0.0 : (toLocal->Determinant() < 0.0 ? -1.0 : 1.0);
    Put(packed.Texels, place, static_cast<double>(light.Polygon.size()), sides, column);
  }
  Put(packed.Texels, 0.0, 0.0, 0.0, 0.0);
  Put(packed.Texels, color.r, color.g, color.b, 0.0);
  for (int k = 3; k < PackedLights::TexelsPerLight; ++k)
  {
    Put(packed.Texels, 0.0, 0.0, 0.0, 0.0);
  }
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
  std::vector<LightKind> kinds; // LightKinds: not taken
  std::array<bool, LightKinds> any{};
  int taken = 0;
  for (const DisplayLight& light : lights.Lights)
  {
    const bool gives = GivesLight(light, scale);
    kinds.push_back(gives ? KindOf(light) : static_cast<LightKind>(LightKinds));
    if (gives)
    {
      any[static_cast<std::size_t>(kinds.back())] = true;
      ++taken;
    }
  }
  Appendix after(PackedLights::TexelsPerLight * taken);
  for (int number = 0; number < LightKinds; ++number)
  {
    const auto kind = static_cast<LightKind>(number);
    const int texels = static_cast<int>(packed.Texels.size() / 4);
    packed.Ranges[number][0] = texels / PackedLights::TexelsPerLight;
    for (std::size_t i = 0; any[static_cast<std::size_t>(number)] && i < kinds.size(); ++i)
    {
      if (kinds[i] != kind)
      {
        continue;
      }
      const DisplayLight& light = lights.Lights[i];
      const int column = lights.Columns.empty() ? -1 : lights.Columns[i];
      const bool directional = kind == LightKind::Directional;
      const bool spot = kind == LightKind::Spot;
      vtkMatrix4x4* toLocal = lights.Frames[i] == LightFrame::Scene
        ? local.FromWorld.Get()
        : (lights.Frames[i] == LightFrame::Object ? objectToLocal.Get() : local.FromView.Get());
      if (kind == LightKind::Area || kind == LightKind::Sky)
      {
        PutExtended(light, toLocal, unit, column, after, packed);
        packed.Features.insert({ KindFeatures[number], "Lights" });
        continue;
      }
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
      Put(packed.Texels, place.x, place.y, place.z, column);
      if (kind == LightKind::Luminaire)
      {
        Put(packed.Texels, AddLuminaire(light, toLocal, after), 0.0, 0.0, 0.0);
      }
      else
      {
        Put(packed.Texels, axis.x, axis.y, axis.z, 1.0 - light.CosCutoff);
      }
      Put(packed.Texels, diffuse.r, diffuse.g, diffuse.b, light.SpotExponent);
      Put(packed.Texels, ambient.r, ambient.g, ambient.b, light.CosInnerCutoff);
      // Lights with a hard edge have a step of any great slope there.
      Put(packed.Texels, specular.r, specular.g, specular.b,
        light.SmoothEdge && width > 0.0 ? 1.0 / width : 1e30);
      Put(packed.Texels, a[0], a[1] * metersPerUnit,
        square ? 1.0 : a[2] * metersPerUnit * metersPerUnit, 0.0);

      packed.Features.insert({ KindFeatures[number], "Lights" });
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
    packed.Ranges[number][1] =
      static_cast<int>(packed.Texels.size() / 4) / PackedLights::TexelsPerLight;
  }
  packed.Texels.insert(packed.Texels.end(), after.Texels.begin(), after.Texels.end());
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
