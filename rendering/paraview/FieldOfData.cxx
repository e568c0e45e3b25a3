// SPDX-License-Identifier: BSD-3-Clause
#include "FieldOfData.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/Units.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <functional>

namespace vtkradiometry
{
namespace
{

namespace names = radiometry::names;

/// Calls `found` on the blocks, or on the data set itself, until it returns true.
bool AnyBlock(vtkDataObject* data, const std::function<bool(vtkDataSet*)>& found)
{
  if (auto* block = vtkDataSet::SafeDownCast(data))
  {
    return found(block);
  }
  auto* tree = vtkCompositeDataSet::SafeDownCast(data);
  if (!tree)
  {
    return false;
  }
  auto it = vtk::TakeSmartPointer(tree->NewIterator());
  for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
  {
    auto* block = vtkDataSet::SafeDownCast(it->GetCurrentDataObject());
    if (block && found(block))
    {
      return true;
    }
  }
  return false;
}

double EfficacyOf(vtkDataSet* block)
{
  vtkDataArray* stated = block->GetFieldData()->GetArray("LuminousEfficacy");
  const double value = stated && stated->GetNumberOfTuples() > 0 ? stated->GetComponent(0, 0) : 0.0;
  return value > 0.0 ? value : radiometry::units::MaximumLuminousEfficacy;
}

} // namespace

ShownField FindLightOfData(vtkDataObject* data)
{
  ShownField shown;
  for (const char* name :
    { names::Radiance, names::Radiosity, names::Luminance, names::LuminousExitance })
  {
    const std::string which = name;
    const auto has = [&](vtkDataSet* block) {
      const bool ofPoints = block->GetPointData()->GetArray(name);
      if (!ofPoints && !block->GetCellData()->GetArray(name))
      {
        return false;
      }
      shown.Name = which;
      shown.Association = ofPoints ? 0 : 1;
      if (which == names::Radiosity || which == names::LuminousExitance)
      {
        shown.Scale /= vtkMath::Pi(); // what a matte surface sends out in each direction
      }
      if (which == names::Luminance || which == names::LuminousExitance)
      {
        shown.Scale /= EfficacyOf(block);
      }
      return true;
    };
    if (AnyBlock(data, has))
    {
      return shown;
    }
  }
  return shown;
}

bool HasMaterials(vtkDataObject* data)
{
  return AnyBlock(data, [](vtkDataSet* block) {
    for (const char* name : { names::DiffuseReflectance, names::SpecularReflectance,
           names::EmittedExitance, names::Shininess })
    {
      for (const std::string& prefix : { std::string(), std::string(names::BackPrefix) })
      {
        const std::string array = prefix + name;
        if (block->GetCellData()->GetArray(array.c_str()) ||
          block->GetFieldData()->GetArray(array.c_str()))
        {
          return true;
        }
      }
    }
    return false;
  });
}

} // namespace vtkradiometry
