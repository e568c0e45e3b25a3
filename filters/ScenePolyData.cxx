// SPDX-License-Identifier: BSD-3-Clause
#include "ScenePolyData.h"

#include "radiometry/scene/ArrayNames.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <algorithm>

namespace names = radiometry::names;
using radiometry::Vec3;
using radiometry::io::GltfCamera;
using radiometry::io::GltfMaterial;
using radiometry::io::GltfScene;

namespace
{

/// A double array whose tuple i is what value(i, component) says.
template <class Value>
vtkSmartPointer<vtkDoubleArray> Doubles(
  const char* name, int components, vtkIdType tuples, Value value)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      array->SetComponent(i, c, value(i, c));
    }
  }
  return array;
}

template <class Value>
vtkSmartPointer<vtkIntArray> Ints(const char* name, vtkIdType tuples, Value value)
{
  auto array = vtkSmartPointer<vtkIntArray>::New();
  array->SetName(name);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    array->SetValue(i, value(i));
  }
  return array;
}

vtkSmartPointer<vtkPoints> Points(const std::vector<Vec3>& from)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(from.size()));
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), from[i].x, from[i].y, from[i].z);
  }
  return points;
}

} // namespace

void WriteSurface(const GltfScene& scene, vtkPolyData* output)
{
  output->Initialize();
  output->SetPoints(Points(scene.Points));
  vtkNew<vtkCellArray> polys;
  polys->AllocateExact(static_cast<vtkIdType>(scene.Triangles.size()),
    static_cast<vtkIdType>(3 * scene.Triangles.size()));
  for (const auto& t : scene.Triangles)
  {
    const vtkIdType corners[3] = { t[0], t[1], t[2] };
    polys->InsertNextCell(3, corners);
  }
  output->SetPolys(polys);

  const auto n = static_cast<vtkIdType>(scene.Triangles.size());
  const auto material = [&](vtkIdType i) -> const GltfMaterial& {
    return scene.Materials[scene.TriangleMaterial[i]];
  };
  vtkCellData* cells = output->GetCellData();
  cells->AddArray(Doubles(names::DiffuseReflectance, 3, n,
    [&](vtkIdType i, int c) { return material(i).Diffuse[c]; }));
  cells->AddArray(Doubles(names::SpecularReflectance, 3, n,
    [&](vtkIdType i, int c) { return material(i).Specular[c]; }));
  cells->AddArray(
    Doubles(names::Shininess, 1, n, [&](vtkIdType i, int) { return material(i).Shininess; }));
  cells->AddArray(Doubles(names::EmittedExitance, 3, n,
    [&](vtkIdType i, int c) { return material(i).Exitance[c]; }));
  cells->AddArray(
    Ints(names::TwoSided, n, [&](vtkIdType i) { return material(i).TwoSided ? 1 : 0; }));
  cells->AddArray(
    Ints("MaterialIndex", n, [&](vtkIdType i) { return scene.TriangleMaterial[i]; }));
  cells->AddArray(Ints("ObjectIndex", n, [&](vtkIdType i) { return scene.TriangleObject[i]; }));
  if (!scene.Normals.empty())
  {
    const auto normals = Doubles(names::Normals, 3,
      static_cast<vtkIdType>(scene.Normals.size()),
      [&](vtkIdType i, int c) { return scene.Normals[i][c]; });
    output->GetPointData()->SetNormals(normals);
  }
  std::vector<std::string> materials;
  for (const GltfMaterial& m : scene.Materials)
  {
    materials.push_back(m.Name);
  }
  AddStrings("MaterialNames", materials, output);
  AddStrings("ObjectNames", scene.Objects, output);
  AddStrings("Generator", { scene.Generator }, output);
  AddStrings("LengthUnit", { "m" }, output);
  AddStrings("BandNames", { "linear Rec.709 R", "linear Rec.709 G", "linear Rec.709 B" }, output);
}

void WriteCameras(const GltfScene& scene, vtkPolyData* output)
{
  output->Initialize();
  const auto n = static_cast<vtkIdType>(scene.Cameras.size());
  std::vector<Vec3> positions;
  std::vector<Vec3> focalPoints;
  std::vector<std::string> cameraNames;
  vtkNew<vtkCellArray> verts;
  for (const GltfCamera& camera : scene.Cameras)
  {
    const auto id = static_cast<vtkIdType>(positions.size());
    verts->InsertNextCell(1, &id);
    positions.push_back(camera.Position);
    focalPoints.push_back(FocalPoint(scene, camera));
    cameraNames.push_back(camera.Name);
  }
  output->SetPoints(Points(positions));
  output->SetVerts(verts);
  const auto& cameras = scene.Cameras;
  vtkPointData* data = output->GetPointData();
  data->AddArray(Doubles(
    names::Direction, 3, n, [&](vtkIdType i, int c) { return cameras[i].Direction[c]; }));
  data->AddArray(
    Doubles("ViewUp", 3, n, [&](vtkIdType i, int c) { return cameras[i].ViewUp[c]; }));
  data->AddArray(
    Doubles("FocalPoint", 3, n, [&](vtkIdType i, int c) { return focalPoints[i][c]; }));
  data->AddArray(
    Doubles("ViewAngle", 1, n, [&](vtkIdType i, int) { return cameras[i].ViewAngle; }));
  data->AddArray(
    Ints("ParallelProjection", n, [&](vtkIdType i) { return cameras[i].Parallel ? 1 : 0; }));
  data->AddArray(
    Doubles("ParallelScale", 1, n, [&](vtkIdType i, int) { return cameras[i].ParallelScale; }));
  data->AddArray(
    Doubles("AspectRatio", 1, n, [&](vtkIdType i, int) { return cameras[i].AspectRatio; }));
  data->AddArray(Doubles("ClippingRange", 2, n,
    [&](vtkIdType i, int c) { return c == 0 ? cameras[i].Near : cameras[i].Far; }));
  AddStrings("CameraNames", cameraNames, output);
}

Vec3 FocalPoint(const GltfScene& scene, const GltfCamera& camera)
{
  double depth = 1.0;
  if (!scene.Points.empty())
  {
    Vec3 low = scene.Points[0];
    Vec3 high = low;
    for (const Vec3& p : scene.Points)
    {
      for (int c = 0; c < 3; ++c)
      {
        low[c] = std::min(low[c], p[c]);
        high[c] = std::max(high[c], p[c]);
      }
    }
    const double ahead = Dot(0.5 * (low + high) - camera.Position, camera.Direction);
    depth = ahead > 0.0 ? ahead : depth;
  }
  return camera.Position + depth * camera.Direction;
}

void AddStrings(const char* name, const std::vector<std::string>& strings, vtkDataObject* output)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(strings.size()));
  for (std::size_t i = 0; i < strings.size(); ++i)
  {
    array->SetValue(static_cast<vtkIdType>(i), strings[i]);
  }
  output->GetFieldData()->AddArray(array);
}
