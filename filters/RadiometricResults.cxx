// SPDX-License-Identifier: BSD-3-Clause
#include "RadiometricResults.h"

#include "BandWavelengths.h"
#include "PhotometricNames.h"
#include "SurfacePoints.h"
#include "radiometry/imaging/ColorMatching.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/Units.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace names = radiometry::names;

namespace
{

/// The lumens of one tuple: by V(lambda) where the bands' wavelengths are known.
class Photometer
{
public:
  Photometer(int bands, double efficacy, const std::vector<double>& wavelengths)
    : Bands(bands)
    , Efficacy(efficacy)
  {
    if (!wavelengths.empty())
    {
      const radiometry::imaging::SpectralColor color(wavelengths.data(), bands);
      for (const auto& xyz : color.GetXyzWeights())
      {
        this->Shares.push_back(xyz[1]);
      }
    }
  }

  double operator()(const double* tuple) const
  {
    return this->Shares.empty()
      ? radiometry::units::Photometric(tuple, this->Bands, this->Efficacy)
      : this->Efficacy *
        std::inner_product(this->Shares.begin(), this->Shares.end(), tuple, 0.0);
  }

private:
  int Bands;
  double Efficacy;
  std::vector<double> Shares;
};

/// The leaves in the order in which SceneAdapter saw them.
std::vector<vtkPolyData*> MakeLeaves(vtkDataObject* output, vtkDataObject* input)
{
  std::vector<vtkPolyData*> leaves;
  auto* composite = vtkCompositeDataSet::SafeDownCast(output);
  if (!composite)
  {
    leaves.push_back(vtkPolyData::SafeDownCast(output));
    return leaves;
  }
  auto* source = vtkCompositeDataSet::SafeDownCast(input);
  composite->CopyStructure(source);
  auto iterator = vtk::TakeSmartPointer(source->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    vtkNew<vtkPolyData> leaf;
    composite->SetDataSet(iterator, leaf);
    leaves.push_back(leaf); // kept alive by the composite
  }
  return leaves;
}

void AddStrings(vtkFieldData* data, const char* name, const std::vector<std::string>& values)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& value : values)
  {
    array->InsertNextValue(value);
  }
  data->AddArray(array);
}

/// Appends what an earlier filter wrote about other things: what stands before the mark is not there yet.
void KeepStrings(
  vtkFieldData* data, const char* name, const char* mark, std::vector<std::string>& values)
{
  const auto head = [mark](const std::string& s) { return s.substr(0, s.find(mark)); };
  auto* before = vtkStringArray::SafeDownCast(data->GetAbstractArray(name));
  for (vtkIdType k = 0; before && k < before->GetNumberOfValues(); ++k)
  {
    const std::string value = before->GetValue(k);
    if (std::none_of(values.begin(), values.end(),
          [&](const std::string& v) { return head(v) == head(value); }))
    {
      values.push_back(value);
    }
  }
}

} // namespace

void RadiometricResults::AddArrays(const std::vector<Result::Quantity>& quantities,
  std::size_t first, const std::vector<std::int32_t>& numbers, vtkIdType count,
  vtkFieldData* data) const
{
  const auto at = [&](vtkIdType i) {
    return numbers.empty() ? static_cast<std::ptrdiff_t>(first) + i
                           : static_cast<std::ptrdiff_t>(numbers[static_cast<std::size_t>(i)]);
  };
  const Photometer lumens(this->Bands, this->Efficacy, this->Wavelengths);
  const auto add = [&](const std::string& name, const std::vector<double>& values, bool photometric) {
    const int components = photometric ? 1 : this->Bands;
    vtkNew<vtkDoubleArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      const double* tuple = at(i) < 0 ? nullptr : &values[at(i) * this->Bands];
      if (photometric)
      {
        array->SetValue(i, tuple ? lumens(tuple) : 0.0);
      }
      else
      {
        for (int b = 0; b < components; ++b)
        {
          array->SetTypedComponent(i, b, tuple ? tuple[b] : 0.0);
        }
      }
    }
    data->AddArray(array);
  };
  for (const Result::Quantity& q : quantities)
  {
    add(q.Name, q.Values, false);
    add(q.Name + names::ErrorSuffix, q.Errors, false);
    std::string photometric;
    if (this->Efficacy > 0.0 && Counterpart(q.Name, photometric))
    {
      add(photometric, q.Values, true);
      add(photometric + names::ErrorSuffix, q.Errors, true);
    }
  }
}

void AddShares(std::array<radiometry::LightShares, 2>& computed,
  std::vector<vtkRadiometricFilter::Result::Shares>& shares)
{
  for (int side = 0; side < 2; ++side)
  {
    if (!computed[side].empty())
    {
      shares.push_back({ names::LightVisibility + std::string(side == 1 ? names::BackSuffix : ""),
        std::move(computed[side]) });
    }
  }
}

void RadiometricResults::AddLightShares(const std::vector<Result::Shares>& shares,
  std::size_t lights, std::size_t first, const std::vector<std::int32_t>& numbers,
  vtkIdType count, vtkFieldData* data)
{
  for (const Result::Shares& side : shares)
  {
    vtkNew<vtkFloatArray> array;
    array->SetName(side.Name.c_str());
    array->SetNumberOfComponents(static_cast<int>(lights));
    array->SetNumberOfTuples(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      const std::ptrdiff_t at = numbers.empty()
        ? static_cast<std::ptrdiff_t>(first) + i
        : static_cast<std::ptrdiff_t>(numbers[static_cast<std::size_t>(i)]);
      for (std::size_t k = 0; k < lights; ++k)
      {
        array->SetTypedComponent(i, static_cast<int>(k),
          at < 0 ? 0.0f : side.Values[static_cast<std::size_t>(at) * lights + k]);
      }
    }
    data->AddArray(array);
  }
}

void RadiometricResults::AddScalars(const std::vector<Result::Scalars>& scalars, std::size_t first,
  const std::vector<std::int32_t>& numbers, vtkIdType count, vtkFieldData* data)
{
  for (const Result::Scalars& s : scalars)
  {
    const auto array = vtk::TakeSmartPointer(
      s.Integer ? static_cast<vtkDataArray*>(vtkIntArray::New()) : vtkDoubleArray::New());
    array->SetName(s.Name.c_str());
    array->SetNumberOfTuples(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      const std::ptrdiff_t at = numbers.empty() ? static_cast<std::ptrdiff_t>(first) + i
                                                : numbers[static_cast<std::size_t>(i)];
      array->SetTuple1(i, at < 0 ? 0.0 : s.Values[static_cast<std::size_t>(at)]);
    }
    data->AddArray(array);
  }
}

void RadiometricResults::WriteSurface(const Result& result,
  const std::vector<SceneAdapter::Block>& blocks, const SurfacePoints& points,
  vtkDataObject* output, vtkDataObject* input) const
{
  const std::vector<vtkPolyData*> leaves = MakeLeaves(output, input);
  for (std::size_t k = 0; k < leaves.size() && k < blocks.size(); ++k)
  {
    const SceneAdapter::Block& block = blocks[k];
    const SurfacePoints::Block& carrier = points.Blocks()[k];
    vtkPolyData* leaf = leaves[k];
    leaf->ShallowCopy(carrier.Data ? carrier.Data : block.Data);
    if (carrier.Data)
    {
      this->AddArrays(result.Points, carrier.First, carrier.Numbers, leaf->GetNumberOfPoints(),
        leaf->GetPointData());
      AddLightShares(result.PointShares, result.LightKeys.size(), carrier.First, carrier.Numbers,
        leaf->GetNumberOfPoints(), leaf->GetPointData());
      AddScalars(result.PointScalars, carrier.First, carrier.Numbers, leaf->GetNumberOfPoints(),
        leaf->GetPointData());
      leaf->GetPointData()->SetActiveScalars(result.Active.c_str());
    }
    else
    {
      this->AddArrays(
        result.Cells, block.FirstCell, block.Numbers, block.Cells, leaf->GetCellData());
      AddLightShares(result.CellShares, result.LightKeys.size(), block.FirstCell, block.Numbers,
        block.Cells, leaf->GetCellData());
      AddScalars(
        result.CellScalars, block.FirstCell, block.Numbers, block.Cells, leaf->GetCellData());
      leaf->GetCellData()->SetActiveScalars(result.Active.c_str());
    }
    this->AddFieldData(result, leaf);
  }
}

void RadiometricResults::AddFieldData(const Result& result, vtkDataObject* output) const
{
  std::vector<std::string> units;
  for (const Result::Quantity& q : result.Cells.empty() ? result.Points : result.Cells)
  {
    units.push_back(q.Name + " [" + q.Unit + "]");
    std::string photometric;
    if (this->Efficacy > 0.0)
    {
      if (const Photometry* p = Counterpart(q.Name, photometric))
      {
        units.push_back(photometric + " [" + p->Unit + "]");
      }
    }
  }
  AddWavelengths(this->Wavelengths, output);
  vtkFieldData* data = output->GetFieldData();
  const auto& shares = result.Cells.empty() ? result.PointShares : result.CellShares;
  for (const Result::Shares& side : shares)
  {
    units.push_back(side.Name + " [1]");
  }
  if (!shares.empty())
  {
    vtkNew<vtkDoubleArray> lights;
    lights->SetName(names::LightVisibilityLights);
    lights->SetNumberOfComponents(7);
    for (const std::array<double, 7>& key : result.LightKeys)
    {
      lights->InsertNextTuple(key.data());
    }
    data->AddArray(lights);
  }
  for (const Result::Scalars& s : result.Cells.empty() ? result.PointScalars : result.CellScalars)
  {
    units.push_back(s.Name + " [" + s.Unit + "]");
  }
  for (const auto& [name, numbers] : result.Fields)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfComponents(static_cast<int>(numbers.size()));
    array->InsertNextTuple(numbers.data());
    data->AddArray(array);
  }
  KeepStrings(data, "RadiometryUnits", " [", units);
  AddStrings(data, "RadiometryUnits", units);
  AddStrings(data, "RadiometryVersion", { VTKRADIOMETRY_VERSION });
  std::vector<std::string> options{ this->Filter + ": " + this->Options };
  KeepStrings(data, "RadiometryOptions", ": ", options);
  AddStrings(data, "RadiometryOptions", options);
  AddStrings(data, "RadiometryOutcome", { result.Outcome });
  AddStrings(data, names::EffectPlan, ReportPlan(result).Sentences());
  AddRunCost(result.Cost, data);
  if (!result.Method.empty())
  {
    AddStrings(data, "RadiometryMethod", { result.Method });
  }
}

PlanReport ReportPlan(const vtkRadiometricFilter::Result& result)
{
  PlanReport report(result.BoundUnit);
  report.Add(result.Effects);
  for (const auto& o : result.Omissions)
  {
    report.AddDropped(o.Name, o.Why, o.Bound);
  }
  for (const auto& [name, value] : result.ErrorParts)
  {
    report.AddEstimate(name, "its part of IrradianceError, averaged over the surface", value);
  }
  return report;
}
