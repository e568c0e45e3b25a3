// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceBlocks.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

std::vector<std::pair<std::string, vtkPolyData*>> SurfaceBlocks(vtkDataObject* object)
{
  std::vector<std::pair<std::string, vtkPolyData*>> blocks;
  if (auto* surface = vtkPolyData::SafeDownCast(object))
  {
    blocks.emplace_back("", surface);
  }
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(object))
  {
    auto iterator = vtk::TakeSmartPointer(composite->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      if (auto* leaf = vtkPolyData::SafeDownCast(iterator->GetCurrentDataObject()))
      {
        const char* name = iterator->HasCurrentMetaData()
          ? iterator->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME())
          : nullptr;
        blocks.emplace_back(name ? name : "block " + std::to_string(blocks.size()), leaf);
      }
    }
  }
  return blocks;
}

std::string ValueName(vtkDataObject* object, const std::string& array, long long value)
{
  const std::string ending = "Index";
  if (array.size() <= ending.size() ||
    array.compare(array.size() - ending.size(), ending.size(), ending) != 0)
  {
    return {};
  }
  const std::string names = array.substr(0, array.size() - ending.size()) + "Names";
  auto* strings =
    vtkStringArray::SafeDownCast(object->GetFieldData()->GetAbstractArray(names.c_str()));
  return strings && value >= 0 && value < strings->GetNumberOfValues()
    ? std::string(strings->GetValue(value))
    : std::string();
}
