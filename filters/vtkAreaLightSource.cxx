// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAreaLightSource.h"

#include "radiometry/geometry/AreaLightShapes.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/LightRecord.h"
#include "radiometry/scene/Units.h"

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <cmath>
#include <utility>

vtkStandardNewMacro(vtkAreaLightSource);

namespace
{

void CheckLength(const char* name, double value)
{
  if (!(value > 0.0) || !std::isfinite(value))
  {
    throw radiometry::InputError(name, -1, value, "a finite length above 0");
  }
}

} // namespace

vtkAreaLightSource::vtkAreaLightSource()
{
  this->SetNumberOfInputPorts(1);
}

int vtkAreaLightSource::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkAreaLightSource::RequestData(
  vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out)
{
  this->Input = in[0]->GetNumberOfInformationObjects() > 0 ? vtkPolyData::GetData(in[0]) : nullptr;
  const int done = this->Superclass::RequestData(request, in, out);
  this->Input = nullptr;
  return done;
}

/// Finds the lights' polygons and returns the area of all.
double vtkAreaLightSource::FindPolygons(std::vector<radiometry::LightRecord>& found) const
{
  using radiometry::InputError;
  const auto add = [&](std::vector<radiometry::Vec3> corners) {
    found.emplace_back();
    found.back().Polygon = std::move(corners);
  };
  const auto vec = [](const double* v) { return radiometry::Vec3{ v[0], v[1], v[2] }; };
  if (this->Shape < Rectangle || this->Shape > Polygons)
  {
    throw InputError("Shape", -1, this->Shape, "0 rectangle, 1 disc or 2 polygons of the input");
  }
  if (this->Shape != Polygons)
  {
    const radiometry::Vec3 axis = radiometry::UnitDirection("Direction", vec(this->Direction));
    const radiometry::Vec3 reference =
      radiometry::UnitDirection("ReferenceDirection", vec(this->ReferenceDirection));
    if (this->Shape == Rectangle)
    {
      CheckLength("Width", this->Width);
      CheckLength("Height", this->Height);
      add(radiometry::RectangleCorners(
        vec(this->Position), axis, reference, this->Width, this->Height));
    }
    else
    {
      CheckLength("Radius", this->Radius);
      if (this->Sides < 3 || this->Sides > 4096)
      {
        throw InputError("Sides", -1, this->Sides, "3 to 4096");
      }
      add(radiometry::DiscCorners(
        vec(this->Position), axis, reference, this->Radius, this->Sides));
    }
  }
  else
  {
    if (!this->Input || this->Input->GetNumberOfPolys() == 0)
    {
      throw InputError("Input", -1, this->Input ? "no polygon" : "missing",
        "polydata with polygons, for Shape 2");
    }
    vtkNew<vtkIdList> ids;
    for (vtkIdType c = 0; c < this->Input->GetNumberOfPolys(); ++c)
    {
      this->Input->GetPolys()->GetCellAtId(c, ids);
      std::vector<radiometry::Vec3> corners;
      for (const vtkIdType p : *ids)
      {
        double x[3];
        this->Input->GetPoint(p, x);
        corners.push_back(vec(x));
        if (!radiometry::IsFinite(corners.back()))
        {
          throw InputError("Points", p, "not finite", "finite coordinates");
        }
      }
      add(std::move(corners));
    }
  }
  double area = 0.0;
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    const double one =
      radiometry::PolygonArea(found[k].Polygon, "Polygons", static_cast<long long>(k));
    if (!(one > 0.0))
    {
      throw InputError("Polygons", static_cast<long long>(k), one, "a polygon with an area");
    }
    area += one;
  }
  return area;
}

double vtkAreaLightSource::Describe(radiometry::LightRecord& light, bool& photometric)
{
  if (this->IntensityUnit < WattPerSquareMeter || this->IntensityUnit > CandelaPerSquareMeter)
  {
    throw radiometry::InputError("IntensityUnit", -1, this->IntensityUnit,
      "0 W/m^2, 1 W, 2 W/(m^2 sr), 3 lm/m^2, 4 lm or 5 cd/m^2");
  }
  std::vector<radiometry::LightRecord> found;
  const double area = this->FindPolygons(found);
  light.Type = radiometry::LightType::Area;
  light.Polygon = found.front().Polygon;
  light.TwoSided = this->TwoSided;
  if (this->Shape != Polygons)
  {
    light.Direction = radiometry::UnitDirection(
      "Direction", { this->Direction[0], this->Direction[1], this->Direction[2] });
  }
  photometric = this->IntensityUnit >= LumenPerSquareMeter;
  if (this->IntensityUnit == Watt || this->IntensityUnit == Lumen)
  {
    return 1.0 / (area * (this->TwoSided ? 2.0 : 1.0));
  }
  const bool radiance = this->IntensityUnit == WattPerSquareMeterSteradian ||
    this->IntensityUnit == CandelaPerSquareMeter;
  return radiance ? radiometry::units::Pi : 1.0;
}

void vtkAreaLightSource::AddFurther(
  std::vector<radiometry::LightRecord>& lights, const std::vector<double>&)
{
  std::vector<radiometry::LightRecord> found;
  this->FindPolygons(found);
  lights.resize(1);
  for (std::size_t k = 1; k < found.size(); ++k)
  {
    lights.push_back(lights.front());
    lights.back().Polygon = std::move(found[k].Polygon);
  }
}

void vtkAreaLightSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Shape: " << this->Shape << "\n";
  os << indent << "Width: " << this->Width << "\n";
  os << indent << "Height: " << this->Height << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Sides: " << this->Sides << "\n";
  os << indent << "Direction: " << this->Direction[0] << " " << this->Direction[1] << " "
     << this->Direction[2] << "\n";
  os << indent << "ReferenceDirection: " << this->ReferenceDirection[0] << " "
     << this->ReferenceDirection[1] << " " << this->ReferenceDirection[2] << "\n";
  os << indent << "TwoSided: " << this->TwoSided << "\n";
}
