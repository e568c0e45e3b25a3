// SPDX-License-Identifier: BSD-3-Clause
#include "ParityStage.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/CandelaWeb.h"

#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

using namespace radiometry;

namespace
{

constexpr double Pi = 3.14159265358979323846;

double Degrees(double cosine)
{
  return std::acos(cosine) * 180.0 / Pi;
}

template <typename Array>
vtkSmartPointer<Array> AddArray(vtkDataSetAttributes* data, const char* name, int components)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  data->AddArray(array);
  return array;
}

/// A candela web as field data.
void AddWeb(const CandelaWeb& web, const std::string& name, vtkFieldData* data)
{
  const auto add = [data](const std::string& text, const std::vector<double>& values) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(text.c_str());
    for (const double value : values)
    {
      array->InsertNextValue(value);
    }
    data->AddArray(array);
  };
  add(name, web.GetValues());
  add(name + "Horizontal", web.GetHorizontal());
  add(name + "Vertical", web.GetVertical());
  add(name + "Type", { static_cast<double>(web.GetType()) });
}

vtkSmartPointer<vtkPolyData> MakeLightData(const ParityScene& scene)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  data->SetPoints(points);
  const auto add = [&data](const char* name, int components) {
    return AddArray<vtkDoubleArray>(data->GetPointData(), name, components);
  };
  const auto type = add(names::LightType, 1);
  const auto intensity = add(names::Intensity, 3);
  const auto specular = add(names::SpecularColor, 3);
  const auto ambient = add(names::AmbientColor, 3);
  const auto direction = add(names::Direction, 3);
  const auto cutoff = add(names::SpotCutoff, 1);
  const auto inner = add(names::SpotInnerCutoff, 1);
  const auto exponent = add(names::SpotExponent, 1);
  const auto attenuation = add(names::Attenuation, 3);
  const auto enabled = add(names::LightEnabled, 1);
  const auto attached = add(names::AttachedTo, 1);
  const auto reference = add(names::ReferenceDirection, 3);
  const auto web = add(names::PhotometricWeb, 1);
  const auto twoSided = add(names::LightTwoSided, 1);
  const auto skyModel = add(names::SkyModel, 1);
  const auto coefficients = add(names::SkyCoefficients, 5);
  const auto sun = add(names::SunDirection, 3);
  const auto ground = add(names::GroundRadiance, 1);
  vtkNew<vtkCellArray> polygons;
  data->SetPolys(polygons);
  int webs = 0;
  const auto insert = [&](const ParityLight& given, const double* p) {
    const DisplayLight& light = given.Light;
    const bool directional = light.Position[3] == 0.0;
    const bool spot = !directional && light.CosCutoff > -1.0;
    points->InsertNextPoint(p);
    type->InsertNextTuple1(light.Sky ? 4.0
        : !light.Polygon.empty()     ? 3.0
        : directional                ? 2.0
        : spot                       ? 1.0
                                     : 0.0);
    reference->InsertNextTuple3(light.Reference.x, light.Reference.y, light.Reference.z);
    web->InsertNextTuple1(light.Web ? webs : -1.0);
    if (light.Web)
    {
      AddWeb(*light.Web, names::PhotometricWeb + std::to_string(webs++), data->GetFieldData());
    }
    twoSided->InsertNextTuple1(light.PolygonTwoSided ? 1.0 : 0.0);
    const SkyRadiance* sky = given.Radiance.get();
    const SkyFrame frame(light.SpotDirection, light.Reference);
    const Vec3 toSun = frame.ToWorld(sky ? sky->ToSun() : Vec3{ 0.0, 0.0, 1.0 });
    const std::array<double, 5> none{};
    skyModel->InsertNextTuple1(sky ? static_cast<double>(sky->Model()) : 0.0);
    coefficients->InsertNextTuple(sky ? sky->Coefficients().data() : none.data());
    sun->InsertNextTuple3(toSun.x, toSun.y, toSun.z);
    ground->InsertNextTuple1(sky ? sky->GroundRadiance() : 0.0);
    intensity->InsertNextTuple3(light.Diffuse.r, light.Diffuse.g, light.Diffuse.b);
    specular->InsertNextTuple3(light.Specular.r, light.Specular.g, light.Specular.b);
    ambient->InsertNextTuple3(light.Ambient.r, light.Ambient.g, light.Ambient.b);
    const Vec3 d = directional ? Vec3{ -p[0], -p[1], -p[2] } : light.SpotDirection;
    direction->InsertNextTuple3(d.x, d.y, d.z);
    cutoff->InsertNextTuple1(
      !spot ? 180.0 : (light.CosCutoff == 0.0 ? 90.0 : Degrees(light.CosCutoff)));
    inner->InsertNextTuple1(light.SmoothEdge ? Degrees(light.CosInnerCutoff) : -1.0);
    exponent->InsertNextTuple1(light.SpotExponent);
    attenuation->InsertNextTuple(light.Attenuation.data());
    enabled->InsertNextTuple1(light.Enabled ? 1.0 : 0.0);
    attached->InsertNextTuple1(static_cast<double>(given.Frame));
  };
  for (const ParityLight& given : scene.Lights)
  {
    if (given.Light.Polygon.empty())
    {
      insert(given, given.Light.Position.data());
    }
  }
  for (const ParityLight& given : scene.Lights)
  {
    if (!given.Light.Polygon.empty())
    {
      polygons->InsertNextCell(static_cast<int>(given.Light.Polygon.size()));
    }
    for (const Vec3& corner : given.Light.Polygon)
    {
      polygons->InsertCellPoint(points->GetNumberOfPoints());
      const double p[3] = { corner.x, corner.y, corner.z };
      insert(given, p);
    }
  }
  return data;
}

vtkSmartPointer<vtkLight> MakeVtkLight(const ParityLight& given, bool physical)
{
  auto result = vtkSmartPointer<vtkLight>::New();
  const DisplayLight& light = given.Light;
  const double unit = physical ? 1.0 / Pi : 1.0; // a vtkLight of 1 shows a white surface as 1
  const double* p = light.Position.data();
  const bool finite = p[3] != 0.0;
  const Vec3 focus =
    finite ? Vec3{ p[0], p[1], p[2] } + light.SpotDirection : Vec3{ 0.0, 0.0, 0.0 };
  if (given.Frame == ParityFrame::Camera)
  {
    result->SetLightTypeToCameraLight();
  }
  result->SetPosition(p[0], p[1], p[2]);
  result->SetFocalPoint(focus.x, focus.y, focus.z);
  result->SetPositional(finite);
  result->SetConeAngle(light.CosCutoff > -1.0 ? Degrees(light.CosCutoff) : 180.0);
  result->SetExponent(light.SpotExponent);
  result->SetAttenuationValues(
    light.Attenuation[0], light.Attenuation[1], light.Attenuation[2]);
  result->SetSwitch(light.Enabled);
  const Rgb diffuse = unit * light.Diffuse;
  const Rgb specular = unit * light.Specular;
  result->SetDiffuseColor(diffuse.r, diffuse.g, diffuse.b);
  result->SetSpecularColor(specular.r, specular.g, specular.b);
  result->SetAmbientColor(light.Ambient.r, light.Ambient.g, light.Ambient.b);
  return result;
}

void SetMaterial(vtkProperty* property, const ParityScene& scene, const DisplayMaterial& material)
{
  const bool own = scene.Colors == ParityColors::Property;
  property->SetAmbient(own ? (material.Ambient == Rgb() ? 0.0 : 1.0) : scene.AmbientShare);
  property->SetDiffuse(1.0);
  property->SetSpecular(1.0);
  property->SetAmbientColor(material.Ambient.r, material.Ambient.g, material.Ambient.b);
  property->SetDiffuseColor(material.Diffuse.r, material.Diffuse.g, material.Diffuse.b);
  property->SetSpecularColor(material.Specular.r, material.Specular.g, material.Specular.b);
  property->SetSpecularPower(material.Shininess);
  property->SetOpacity(scene.Alpha);
}

void AddMaterialArrays(vtkPolyData* block, const std::string& prefix,
  const std::vector<DisplayMaterial>& materials, std::size_t first)
{
  vtkCellData* data = block->GetCellData();
  const auto add = [&](const char* name, int components) {
    return AddArray<vtkDoubleArray>(data, (prefix + name).c_str(), components);
  };
  const auto diffuse = add(names::DiffuseReflectance, 3);
  const auto specular = add(names::SpecularReflectance, 3);
  const auto shininess = add(names::Shininess, 1);
  const auto exitance = add(names::EmittedExitance, 3);
  for (vtkIdType c = 0; c < block->GetNumberOfCells(); ++c)
  {
    const DisplayMaterial& m = materials[first + static_cast<std::size_t>(c)];
    diffuse->InsertNextTuple3(m.Diffuse.r, m.Diffuse.g, m.Diffuse.b);
    specular->InsertNextTuple3(m.Specular.r, m.Specular.g, m.Specular.b);
    shininess->InsertNextTuple1(m.Shininess);
    exitance->InsertNextTuple3(Pi * m.Emission.r, Pi * m.Emission.g, Pi * m.Emission.b);
  }
}

/// The arrays that colour the triangles [first, last).
void AddColors(vtkPolyData* block, const ParityScene& scene, std::size_t first, std::size_t last)
{
  const bool ofPoints =
    scene.Colors == ParityColors::PointReflectance || scene.Colors == ParityColors::PointField;
  if (scene.Colors == ParityColors::Scalars)
  {
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetNumberOfComponents(3);
    for (std::size_t t = first; t < last; ++t)
    {
      const Rgb& c = scene.Values[t];
      colors->InsertNextTuple3(c.r, c.g, c.b);
    }
    block->GetCellData()->SetScalars(colors);
  }
  else if (scene.Colors == ParityColors::Materials)
  {
    AddMaterialArrays(block, "", scene.CellFront, first);
    if (!scene.CellBack.empty())
    {
      AddMaterialArrays(block, names::BackPrefix, scene.CellBack, first);
    }
    if (!scene.CellTwoSided.empty())
    {
      const auto sides = AddArray<vtkDoubleArray>(block->GetCellData(), names::TwoSided, 1);
      for (std::size_t t = first; t < last; ++t)
      {
        sides->InsertNextTuple1(scene.CellTwoSided[t] ? 1.0 : 0.0);
      }
    }
  }
  else if (scene.Colors != ParityColors::Property && scene.Colors != ParityColors::Blocks)
  {
    vtkDataSetAttributes* data = block->GetCellData();
    if (ofPoints)
    {
      data = block->GetPointData();
    }
    const auto field = AddArray<vtkDoubleArray>(data, "Shown", 3);
    const std::size_t each = ofPoints ? 3 : 1;
    for (std::size_t i = each * first; i < each * last; ++i)
    {
      field->InsertNextTuple3(scene.Values[i].r, scene.Values[i].g, scene.Values[i].b);
    }
  }
}

/// What of each light arrives at the triangles [first, last), and which lights those are.
void AddShares(vtkPolyData* block, const ParityScene& scene, std::size_t first, std::size_t last)
{
  const std::size_t lights = scene.Lights.size();
  const bool ofPoints = scene.Shares == ParityShares::Points;
  vtkDataSetAttributes* data = block->GetCellData();
  if (ofPoints)
  {
    data = block->GetPointData();
  }
  const auto add = [&](const std::string& name, const std::vector<double>& values) {
    const auto array = AddArray<vtkDoubleArray>(data, name.c_str(), static_cast<int>(lights));
    const std::size_t each = ofPoints ? 3 : 1;
    for (std::size_t i = each * first; i < each * last; ++i)
    {
      array->InsertNextTuple(&values[i * lights]);
    }
  };
  add(names::LightVisibility, scene.SharesFront);
  if (!scene.SharesBack.empty())
  {
    add(std::string(names::LightVisibility) + names::BackSuffix, scene.SharesBack);
  }
  vtkNew<vtkDoubleArray> keys;
  keys->SetName(names::LightVisibilityLights);
  keys->SetNumberOfComponents(7);
  for (const ParityLight& given : scene.Lights)
  {
    const double* p = given.Light.Position.data();
    const Vec3& d = given.Light.SpotDirection;
    const bool spot = given.Light.CosCutoff > -1.0;
    const double finite[7] = { spot ? 1.0 : 0.0, p[0], p[1], p[2], d.x, d.y, d.z };
    const double directional[7] = { 2.0, p[0], p[1], p[2], -p[0], -p[1], -p[2] };
    const double sky[7] = { 4.0, p[0], p[1], p[2], d.x, d.y, d.z };
    const Vec3 corner = given.Light.Polygon.empty() ? Vec3{} : given.Light.Polygon.front();
    const double area[7] = { 3.0, corner.x, corner.y, corner.z, 0.0, 0.0, 0.0 };
    keys->InsertNextTuple(given.Light.Sky ? sky
        : !given.Light.Polygon.empty()    ? area
        : p[3] == 0.0                     ? directional
                                          : finite);
  }
  block->GetFieldData()->AddArray(keys);
}

vtkSmartPointer<vtkPolyData> MakeBlock(const ParityScene& scene, std::size_t first, std::size_t last)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 3 * first; i < 3 * last; ++i)
  {
    const vtkIdType id =
      points->InsertNextPoint(scene.Points[i].x, scene.Points[i].y, scene.Points[i].z);
    if (i % 3 == 0)
    {
      cells->InsertNextCell(3);
    }
    cells->InsertCellPoint(id);
    if (!scene.Normals.empty())
    {
      normals->InsertNextTuple3(scene.Normals[i].x, scene.Normals[i].y, scene.Normals[i].z);
    }
  }
  auto block = vtkSmartPointer<vtkPolyData>::New();
  block->SetPoints(points);
  block->SetPolys(cells);
  if (!scene.Normals.empty())
  {
    block->GetPointData()->SetNormals(normals);
  }
  AddColors(block, scene, first, last);
  if (scene.Shares != ParityShares::None)
  {
    AddShares(block, scene, first, last);
  }
  return block;
}

} // namespace

ParityStage::ParityStage(int size)
{
  this->Window->SetMultiSamples(0);
  this->Window->SetOffScreenRendering(1);
  this->Window->SetSize(size, size);
  this->Window->AddRenderer(this->Renderer);
  this->Renderer->SetPass(this->Pass);
  this->Renderer->AddActor(this->Actor);
  this->Renderer->AutomaticLightCreationOff();
}

void ParityStage::Set(const ParityScene& scene)
{
  this->Mapper = vtkSmartPointer<vtkPhongGouraudMapper>::New();
  this->Actor->SetMapper(this->Mapper);
  this->SetSurface(scene);
  this->SetProperties(scene);
  this->SetCamera(scene);
  this->SetLights(scene);
}

void ParityStage::SetSurface(const ParityScene& scene)
{
  if (scene.TrianglesPerBlock == 0)
  {
    this->Mapper->SetInputDataObject(MakeBlock(scene, 0, scene.Triangles()));
    return;
  }
  const auto each = static_cast<std::size_t>(scene.TrianglesPerBlock);
  vtkNew<vtkMultiBlockDataSet> tree;
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  for (std::size_t first = 0, b = 0; first < scene.Triangles(); first += each, ++b)
  {
    const auto block = MakeBlock(scene, first, std::min(first + each, scene.Triangles()));
    tree->SetBlock(static_cast<unsigned int>(b), block);
    if (scene.Colors == ParityColors::Blocks)
    {
      const double color[3] = { scene.Values[b].r, scene.Values[b].g, scene.Values[b].b };
      attributes->SetBlockColor(block, color);
    }
  }
  this->Mapper->SetInputDataObject(tree);
  this->Mapper->SetCompositeDataDisplayAttributes(attributes);
}

void ParityStage::SetProperties(const ParityScene& scene)
{
  vtkPhongGouraudMapper* mapper = this->Mapper;
  const auto set = [mapper](void (vtkPhongGouraudMapper::*setter)(double, double, double),
                     const Rgb& c) { (mapper->*setter)(c.r, c.g, c.b); };
  mapper->SetShading(scene.Shading);
  mapper->SetReflectionModel(static_cast<int>(scene.Model.Reflection));
  mapper->SetLocalViewer(scene.Model.LocalViewer);
  mapper->SetTwoSided(scene.Model.TwoSided);
  mapper->SetLightScale(scene.LightScale);
  mapper->SetMetersPerUnit(scene.MetersPerUnit);
  mapper->SetFieldScale(scene.FieldScale);
  mapper->SetFieldArrayName("Shown");
  mapper->SetScalarVisibility(scene.Colors == ParityColors::Scalars);
  set(&vtkPhongGouraudMapper::SetGlobalAmbient, scene.Model.GlobalAmbient);
  set(&vtkPhongGouraudMapper::SetEmission, scene.Front.Emission);
  set(&vtkPhongGouraudMapper::SetBackEmission, scene.Back.Emission);
  switch (scene.Colors)
  {
    case ParityColors::CellReflectance:
    case ParityColors::PointReflectance:
      mapper->SetFieldModeToReflectance();
      break;
    case ParityColors::CellField:
    case ParityColors::PointField:
      mapper->SetFieldModeToOn();
      break;
    case ParityColors::Materials:
      mapper->SetFieldModeToMaterials();
      break;
    default:
      break;
  }
  SetMaterial(this->Actor->GetProperty(), scene, scene.Front);
  vtkSmartPointer<vtkProperty> back;
  if (scene.HasBack)
  {
    back = vtkSmartPointer<vtkProperty>::New();
    SetMaterial(back, scene, scene.Back);
  }
  this->Actor->SetBackfaceProperty(back);
  vtkNew<vtkMatrix4x4> matrix;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      matrix->SetElement(i, j, scene.Transform[i][j]);
    }
    matrix->SetElement(i, 3, scene.Shift[i]);
  }
  this->Actor->SetUserMatrix(matrix);
}

void ParityStage::SetLights(const ParityScene& scene)
{
  this->Renderer->RemoveAllLights();
  if (!scene.RendererLights)
  {
    this->Mapper->SetLightData(MakeLightData(scene));
    return;
  }
  const bool physical = scene.Model.Reflection == ReflectionModel::Physical;
  for (const ParityLight& light : scene.Lights)
  {
    this->Renderer->AddLight(MakeVtkLight(light, physical));
  }
}

void ParityStage::SetCamera(const ParityScene& scene)
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(scene.Eye.x, scene.Eye.y, scene.Eye.z);
  camera->SetFocalPoint(scene.Focus.x, scene.Focus.y, scene.Focus.z);
  camera->SetViewUp(scene.Up.x, scene.Up.y, scene.Up.z);
  camera->SetParallelProjection(scene.Parallel);
  camera->SetParallelScale(scene.ParallelScale);
  camera->SetViewAngle(scene.ViewAngle);
  camera->SetClippingRange(0.1 * scene.Unit, 20.0 * scene.Unit);
}

const float* ParityStage::Draw()
{
  this->Window->Render();
  return static_cast<float*>(this->Pass->GetColor()->GetScalarPointer());
}

const float* ParityStage::GetDepth()
{
  return static_cast<float*>(this->Pass->GetDepth()->GetScalarPointer());
}

std::string ParityStage::GetRenderer()
{
  const std::string text = this->Window->ReportCapabilities();
  const std::string key = "OpenGL renderer string:";
  const std::size_t begin = text.find(key);
  if (begin == std::string::npos)
  {
    return "unknown";
  }
  const std::size_t first = text.find_first_not_of(' ', begin + key.size());
  return text.substr(first, text.find('\n', first) - first);
}
