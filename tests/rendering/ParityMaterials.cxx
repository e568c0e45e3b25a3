// SPDX-License-Identifier: BSD-3-Clause
// Features of materials, of the model and of colours that come from the data.
#include "ParityMaking.h"

#include "radiometry/scene/CandelaWeb.h"

#include <cmath>

using namespace radiometry;

namespace parity
{

void NeedHighlight(Scene& scene, Random& random)
{
  NeedLight(scene, random);
  for (DisplayMaterial* side : { &scene.Front, &scene.Back })
  {
    if (side->Specular == Rgb())
    {
      side->Specular = random.Color(0.1, 1.0);
      side->Shininess = random.In(1.0, 60.0);
    }
  }
}

namespace
{

DisplayMaterial RandomMaterial(Random& random)
{
  DisplayMaterial material;
  material.Diffuse = random.Color(0.1, 1.0);
  material.Ambient = random.Chance(0.5) ? random.Color(0.0, 1.0) : Rgb();
  material.Specular = random.Chance(0.5) ? random.Color(0.0, 1.0) : Rgb();
  material.Shininess = random.In(0.0, 100.0);
  return material;
}

void SetColors(Scene& scene, Random& random, ParityColors colors, std::size_t count, double least,
  double most)
{
  scene.Colors = colors;
  scene.AmbientShare = random.Chance(0.5) ? static_cast<float>(random.In(0.1, 1.0)) : 0.0;
  scene.Values.clear();
  for (std::size_t i = 0; i < count; ++i)
  {
    Rgb c = random.Color(least, most);
    if (colors == ParityColors::Scalars)
    {
      c = { std::floor(c.r), std::floor(c.g), std::floor(c.b) };
    }
    scene.Values.push_back(c);
  }
}

/// What of each light arrives, anything in [0, 1].
void SetShares(Scene& scene, Random& random, ParityShares shares)
{
  NeedLight(scene, random);
  if (shares == ParityShares::Points && scene.Lights.size() > 8)
  {
    return; // shares of points have room for no more
  }
  const auto values = [&] {
    const std::size_t items =
      shares == ParityShares::Cells ? scene.Triangles() : scene.Points.size();
    std::vector<double> all(items * scene.Lights.size());
    for (double& share : all)
    {
      share = random.Chance(0.3) ? (random.Chance(0.5) ? 0.0 : 1.0) : random.In(0.0, 1.0);
    }
    return all;
  };
  scene.Shares = shares;
  scene.SharesFront = values();
  scene.SharesBack = random.Chance(0.5) ? values() : std::vector<double>();
}

/// An area light about the focus: a convex or concave polygon of random shape, also through the
/// horizon of places that it lights.
ParityLight& AddAreaLight(Scene& scene, Random& random)
{
  ParityLight added;
  DisplayLight& light = added.Light;
  const Vec3 back = random.Direction();
  const auto axes = LuminaireAxes(-back, random.Direction());
  const Vec3 center = scene.Focus + scene.Unit * random.In(0.8, 2.5) * back;
  const double size = scene.Unit * std::pow(10.0, random.In(-2.0, 0.3));
  const int corners = 3 + random.Below(5);
  const double whole = 2.0 * 3.14159265358979323846;
  for (int k = 0; k < corners; ++k)
  {
    const double angle = -whole * (k + random.In(0.0, 0.8)) / corners;
    const double radius = size * random.In(0.3, 1.0);
    light.Polygon.push_back(
      center + radius * (std::cos(angle) * axes[0] + std::sin(angle) * axes[1]));
  }
  light.PolygonTwoSided = random.Chance(0.3);
  light.Diffuse = random.Color(0.0, random.Chance(0.5) ? 5.0 : 500.0);
  light.Specular = Rgb();
  scene.Lights.push_back(added);
  return scene.Lights.back();
}

/// Webs without a step: all vertical angles, or zero at their rim.
std::shared_ptr<const CandelaWeb> RandomWeb(Random& random)
{
  const bool closed = random.Chance(0.6);
  const std::vector<double> horizontal = closed
    ? (random.Chance(0.3) ? std::vector<double>{ 0.0 }
                          : std::vector<double>{ 0.0, 35.0, 90.0, 200.0, 300.0, 360.0 })
    : std::vector<double>{ -90.0, -40.0, 0.0, 10.0, 60.0, 90.0 };
  const std::vector<double> vertical = closed
    ? std::vector<double>{ 0.0, 20.0, 45.0, 60.0, 90.0, 140.0, 180.0 }
    : std::vector<double>{ -90.0, -50.0, -20.0, 0.0, 30.0, 90.0 };
  std::vector<double> values;
  for (std::size_t j = 0; j < horizontal.size(); ++j)
  {
    for (std::size_t i = 0; i < vertical.size(); ++i)
    {
      const bool pole = closed && (i == 0 || i + 1 == vertical.size());
      const bool rim = !closed &&
        (i == 0 || j == 0 || i + 1 == vertical.size() || j + 1 == horizontal.size());
      const bool seam = closed && horizontal.size() > 1 && j + 1 == horizontal.size();
      values.push_back(rim ? 0.0 : (pole ? 0.7 : (seam ? values[i] : random.In(0.1, 1.0))));
    }
  }
  return std::make_shared<const CandelaWeb>(
    closed ? WebType::C : (random.Chance(0.5) ? WebType::B : WebType::A), horizontal, vertical,
    values);
}

std::shared_ptr<const SkyRadiance> RandomSky(Random& random)
{
  switch (random.Below(3))
  {
    case 0:
      return SkyRadiance::Uniform();
    case 1:
      return SkyRadiance::Overcast(random.In(0.0, 0.5));
    default:
      return SkyRadiance::General(SkyRadiance::TypeCoefficients(12),
        Normalized(random.Direction() + Vec3{ 0.0, 0.0, 1.2 }), random.In(0.0, 0.5));
  }
}

void SetMaterials(Scene& scene, Random& random)
{
  SetColors(scene, random, ParityColors::Materials, 0, 0.0, 1.0);
  NeedLight(scene, random);
  const bool highlights = random.Chance(0.6);
  const bool emission = random.Chance(0.5);
  const bool back = random.Chance(0.5);
  const auto material = [&] {
    DisplayMaterial m;
    m.Diffuse = random.Color(0.1, 0.8);
    m.Specular = highlights ? random.Color(0.0, 0.5) : Rgb();
    m.Shininess = highlights ? random.In(0.0, 80.0) : 10.0;
    m.Emission = emission ? random.Color(0.0, 5.0) : Rgb();
    return m;
  };
  scene.CellFront.clear();
  scene.CellBack.clear();
  scene.CellTwoSided.clear();
  for (std::size_t t = 0; t < scene.Triangles(); ++t)
  {
    scene.CellFront.push_back(material());
    if (back)
    {
      scene.CellBack.push_back(material());
    }
  }
  if (random.Chance(0.5))
  {
    scene.Model.TwoSided = true;
    for (std::size_t t = 0; t < scene.Triangles(); ++t)
    {
      scene.CellTwoSided.push_back(random.Chance(0.6));
    }
  }
}

} // namespace

void AddMaterialFeatures(const AddFeature& add)
{
  const auto addModel = [&add](const char* name, ReflectionModel model) {
    add(name, 0.3, [model](Scene& s, Random& r) {
      NeedHighlight(s, r);
      s.Model.Reflection = model;
    });
  };
  addModel("highlights: Blinn-Phong", ReflectionModel::BlinnPhong);
  addModel("highlights: Phong", ReflectionModel::Phong);
  addModel("highlights: Physical", ReflectionModel::Physical);
  add("shininess 0 to 1", 0.1, [](Scene& s, Random& r) {
    NeedHighlight(s, r);
    s.Front.Shininess = r.Chance(0.4) ? 0.0 : r.In(0.0, 1.0);
    s.Back.Shininess = r.In(0.0, 1.0);
  });
  add("shininess 100 to 1000", 0.1, [](Scene& s, Random& r) {
    NeedHighlight(s, r);
    // vtkProperty ends at 128; exponents of surface arrays do not.
    s.Front.Shininess = r.Chance(0.3) ? 128.0 : r.In(100.0, 128.0);
    s.Back.Shininess = r.In(100.0, 128.0);
    SetMaterials(s, r);
    for (auto* materials : { &s.CellFront, &s.CellBack })
    {
      for (DisplayMaterial& m : *materials)
      {
        m.Specular = r.Color(0.0, 0.5);
        m.Shininess = r.Chance(0.3) ? 1000.0 : r.In(100.0, 1000.0);
      }
    }
  });
  add("viewer at infinity", 0.25, [](Scene& s, Random& r) {
    NeedHighlight(s, r);
    s.Model.LocalViewer = false;
  });
  add("global ambient", 0.3, [](Scene& s, Random& r) {
    s.Front.Ambient = r.Color(0.1, 1.0);
    s.Back.Ambient = r.Color(0.1, 1.0);
    s.Model.GlobalAmbient = r.Color(0.0, 3.0);
  });
  add("emission", 0.2, [](Scene& s, Random& r) {
    s.Front.Emission = r.Color(0.0, 5.0);
    s.Back.Emission = r.Color(0.0, 5.0);
  });
  add("two-sided", 0.4, [](Scene& s, Random& r) {
    NeedLight(s, r);
    s.Model.TwoSided = true;
  });
  add("back material", 0.2, [](Scene& s, Random& r) {
    NeedLight(s, r);
    s.Model.TwoSided = true;
    s.HasBack = true;
    s.Back = RandomMaterial(r);
    s.Back.Emission = s.Front.Emission;
  });
  // Colours that are not the property's.
  add("block colours", 0.1, [](Scene& s, Random& r) {
    NeedLight(s, r);
    SetColors(s, r, ParityColors::Blocks, 3, 0.0, 1.0);
    s.TrianglesPerBlock = 2;
  });
  add("scalar colours", 0.08, [](Scene& s, Random& r) {
    NeedLight(s, r);
    SetColors(s, r, ParityColors::Scalars, s.Triangles(), 0.0, 256.0);
  });
  add("reflectance of cells", 0.08, [](Scene& s, Random& r) {
    NeedLight(s, r);
    SetColors(s, r, ParityColors::CellReflectance, s.Triangles(), 0.0, 1.0);
    s.FieldScale = r.In(0.2, 1.0);
  });
  add("reflectance of points", 0.08, [](Scene& s, Random& r) {
    NeedLight(s, r);
    SetColors(s, r, ParityColors::PointReflectance, s.Points.size(), 0.0, 1.0);
  });
  add("material arrays", 0.15, SetMaterials);
  add("field of cells, HDR", 0.06, [](Scene& s, Random& r) {
    SetColors(s, r, ParityColors::CellField, s.Triangles(), -5.0, std::pow(10.0, r.In(0.0, 6.0)));
    s.FieldScale = std::pow(10.0, r.In(-2.0, 2.0));
  });
  add("field of points, HDR", 0.06, [](Scene& s, Random& r) {
    SetColors(s, r, ParityColors::PointField, s.Points.size(), -5.0, std::pow(10.0, r.In(0.0, 6.0)));
    s.FieldScale = std::pow(10.0, r.In(-2.0, 2.0));
  });
  add("alpha: layers in float", 0.15, [](Scene& s, Random& r) {
    NeedLight(s, r);
    s.Alpha = r.In(0.1, 0.9);
  });
}

void AddFieldFeatures(const AddFeature& add)
{
  add("highlights on a field", 0.06, [](Scene& s, Random& r) {
    NeedHighlight(s, r);
    const bool cells = r.Chance(0.5);
    SetColors(s, r, cells ? ParityColors::CellField : ParityColors::PointField,
      cells ? s.Triangles() : s.Points.size(), 0.0, 1.0);
  });
  add("area lights", 0.12, [](Scene& s, Random& r) {
    const int count = 1 + r.Below(3);
    for (int k = 0; k < count && !s.RendererLights; ++k)
    {
      AddAreaLight(s, r);
    }
  });
  add("candela webs", 0.12, [](Scene& s, Random& r) {
    for (int k = 0; k < 2 && !s.RendererLights && s.Unit == 1.0; ++k)
    {
      ParityLight& light = AddLight(s, r, Point);
      light.Light.Position = { { light.Light.Position[0] + s.Focus.x,
        light.Light.Position[1] + s.Focus.y, light.Light.Position[2] + s.Focus.z, 1.0 } };
      light.Light.Reference = r.Direction();
      light.Light.Web = RandomWeb(r);
    }
  });
  add("skies", 0.12, [](Scene& s, Random& r) {
    if (!s.RendererLights)
    {
      ParityLight added;
      added.Light.SpotDirection = r.Direction();
      added.Light.Reference = r.Direction();
      added.Light.Diffuse = r.Color(0.0, 3.0);
      added.Light.Specular = added.Light.Diffuse;
      added.Light.Position = { { 0.0, 0.0, 0.0, 1.0 } };
      added.Radiance = RandomSky(r);
      added.Light.Sky = std::make_shared<const SkyQuadric>(ProjectSky(*added.Radiance,
        SkyFrame(added.Light.SpotDirection, added.Light.Reference), { 1.0, 1.0, 1.0 }));
      s.Lights.push_back(added);
    }
  });
  add("shadows of cells", 0.1,
    [](Scene& s, Random& r) { SetShares(s, r, ParityShares::Cells); });
  add("shadows of points", 0.1,
    [](Scene& s, Random& r) { SetShares(s, r, ParityShares::Points); });
}

} // namespace parity
