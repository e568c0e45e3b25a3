// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReflectanceLobeSource.h"

#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"
#include "radiometry/shading/LobeMesh.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

using radiometry::Vec3;

vtkStandardNewMacro(vtkReflectanceLobeSource);

namespace
{

constexpr double RayLength = 1.2; // of the lobe's greatest extent

Vec3 Vector(const double* v) { return { v[0], v[1], v[2] }; }

void CheckFinite(const char* name, const double* v)
{
  for (int k = 0; k < 3; ++k)
  {
    if (!std::isfinite(v[k]))
    {
      throw radiometry::InputError(name, -1, v[k], "finite numbers");
    }
  }
}

void AddField(vtkPolyData* output, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  output->GetFieldData()->AddArray(array);
}

vtkDoubleArray* AddPointArray(vtkPolyData* output, const char* name, int components, std::size_t count)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  array->FillValue(0.0);
  output->GetPointData()->AddArray(array);
  return array; // kept alive by the output
}

/// Lobe and lines as polydata.
void Draw(const radiometry::LobeMesh& mesh, const Vec3& center, const std::vector<Vec3>& rays,
  vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const std::size_t count = mesh.Points.size() + 2 * rays.size();
  points->SetNumberOfPoints(static_cast<vtkIdType>(count));
  vtkDoubleArray* value = AddPointArray(output, "BRDF", 1, count);
  vtkDoubleArray* cosine = AddPointArray(output, "BRDFCosine", 1, count);
  vtkDoubleArray* direction = AddPointArray(output, "OutgoingDirection", 3, count);
  for (std::size_t k = 0; k < mesh.Points.size(); ++k)
  {
    const auto id = static_cast<vtkIdType>(k);
    const Vec3 p = center + mesh.Points[k];
    const Vec3& w = mesh.Directions[k];
    points->SetPoint(id, p.x, p.y, p.z);
    value->SetValue(id, mesh.Values[k]);
    cosine->SetValue(id, mesh.Values[k] * mesh.Cosines[k]);
    direction->SetTuple3(id, w.x, w.y, w.z);
  }
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkIntArray> part;
  part->SetName("Part");
  for (std::size_t r = 0; r < rays.size(); ++r)
  {
    const auto id = static_cast<vtkIdType>(mesh.Points.size() + 2 * r);
    const Vec3 p = center + rays[r];
    points->SetPoint(id, p.x, p.y, p.z);
    points->SetPoint(id + 1, center.x, center.y, center.z);
    const vtkIdType ids[2] = { id, id + 1 };
    lines->InsertNextCell(2, ids);
    part->InsertNextValue(static_cast<int>(r) + 1);
  }
  vtkNew<vtkCellArray> polygons;
  for (std::size_t c = 0; c + 1 < mesh.Offsets.size(); ++c)
  {
    polygons->InsertNextCell(static_cast<int>(mesh.Offsets[c + 1] - mesh.Offsets[c]));
    for (std::int64_t k = mesh.Offsets[c]; k < mesh.Offsets[c + 1]; ++k)
    {
      polygons->InsertCellPoint(static_cast<vtkIdType>(mesh.Corners[static_cast<std::size_t>(k)]));
    }
    part->InsertNextValue(0);
  }
  output->SetPoints(points);
  output->SetLines(lines);
  output->SetPolys(polygons);
  output->GetCellData()->AddArray(part);
  output->GetPointData()->SetActiveScalars("BRDF");
}

} // namespace

vtkReflectanceLobeSource::vtkReflectanceLobeSource()
{
  this->SetNumberOfInputPorts(0);
}

int vtkReflectanceLobeSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
  try
  {
    radiometry::Brdf brdf;
    static constexpr radiometry::ReflectionModel models[] = { radiometry::ReflectionModel::Physical,
      radiometry::ReflectionModel::Physical, radiometry::ReflectionModel::Phong,
      radiometry::ReflectionModel::BlinnPhong };
    brdf.Reflection = models[this->ReflectionModel];
    brdf.Diffuse = this->DiffuseReflectance;
    brdf.Specular = this->ReflectionModel == LAMBERT ? 0.0 : this->SpecularReflectance;
    brdf.Shininess = this->Shininess;

    radiometry::LobeShape shape;
    CheckFinite("Normal", this->Normal);
    CheckFinite("IncidentDirection", this->IncidentDirection);
    CheckFinite("Center", this->Center);
    if (!(this->IncidentAngle >= 0.0 && this->IncidentAngle < 90.0))
    {
      throw radiometry::InputError(
        "IncidentAngle", -1, this->IncidentAngle, "degrees in [0, 90)");
    }
    if (this->LogScale && !(this->Decades > 0.0))
    {
      throw radiometry::InputError("Decades", -1, this->Decades, "above 0");
    }
    shape.Normal = Vector(this->Normal);
    const Vec3 travels = Vector(this->IncidentDirection);
    shape.Toward = Length(travels) > 0.0
      ? -travels
      : radiometry::TowardAtAngle(shape.Normal, radiometry::units::Radians(this->IncidentAngle));
    shape.Cosine = this->CosineWeighted;
    shape.Decades = this->LogScale ? this->Decades : 0.0;
    shape.Radius = this->Radius;
    shape.Resolution = this->Resolution;
    const radiometry::LobeMesh mesh = radiometry::MakeLobeMesh(brdf, shape);
    std::vector<Vec3> rays;
    if (this->ShowRays)
    {
      const double length = RayLength * radiometry::GreatestDistance(mesh);
      rays = { length * Normalized(shape.Toward), length * Normalized(shape.Normal) };
    }
    Draw(mesh, Vector(this->Center), rays, output);

    const double cosine = mesh.CosIncident;
    const radiometry::IntegratedValue integrated = radiometry::IntegrateReflectance(brdf, cosine);
    const auto closed = radiometry::ClosedReflectance(brdf, cosine);
    const auto albedo = radiometry::ClosedAlbedo(brdf);
    const radiometry::IntegratedValue all = albedo
      ? radiometry::IntegratedValue{ *albedo, 0.0 }
      : radiometry::IntegrateAlbedo(brdf);
    AddField(output, "DirectionalHemisphericalReflectance", closed.value_or(integrated.Value));
    AddField(
      output, "DirectionalHemisphericalReflectanceError", closed ? 0.0 : integrated.Error);
    AddField(output, "DirectionalHemisphericalReflectanceIntegrated", integrated.Value);
    AddField(output, "DirectionalHemisphericalReflectanceIntegratedError", integrated.Error);
    AddField(output, "Albedo", all.Value);
    AddField(output, "AlbedoError", all.Error);
    AddField(output, "MaximumBRDF", *std::max_element(mesh.Values.begin(), mesh.Values.end()));
    AddField(output, "IncidentAngle",
      radiometry::units::Degrees(std::acos(std::min(1.0, cosine))));
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkReflectanceLobeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  static const char* const models[] = { "Lambert", "PhysicalPhong", "LegacyPhong", "LegacyBlinn" };
  os << indent << "ReflectionModel: " << models[this->ReflectionModel] << '\n'
     << indent << "DiffuseReflectance: " << this->DiffuseReflectance << '\n'
     << indent << "SpecularReflectance: " << this->SpecularReflectance << '\n'
     << indent << "Shininess: " << this->Shininess << '\n'
     << indent << "IncidentAngle: " << this->IncidentAngle << " degrees\n"
     << indent << "CosineWeighted: " << this->CosineWeighted << '\n'
     << indent << "LogScale: " << this->LogScale << '\n'
     << indent << "Decades: " << this->Decades << '\n'
     << indent << "Radius: " << this->Radius << '\n'
     << indent << "Resolution: " << this->Resolution << '\n'
     << indent << "ShowRays: " << this->ShowRays << '\n';
}
