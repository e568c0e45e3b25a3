// SPDX-License-Identifier: BSD-3-Clause
#include "RoundedData.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <cmath>

namespace
{

double Rounded(double value)
{
  const auto rounded = static_cast<double>(static_cast<float>(value));
  return std::isfinite(rounded) ? rounded : value;
}

void Round(vtkDataArray* array)
{
  auto* doubles = vtkDoubleArray::SafeDownCast(array);
  for (vtkIdType i = 0; doubles && i < doubles->GetNumberOfValues(); ++i)
  {
    doubles->SetValue(i, Rounded(doubles->GetValue(i)));
  }
}

void Round(vtkFieldData* data)
{
  for (int k = 0; data && k < data->GetNumberOfArrays(); ++k)
  {
    Round(data->GetArray(k));
  }
}

/// A copy that shares nothing with what it is of.
vtkSmartPointer<vtkDataObject> Copy(vtkDataObject* data)
{
  auto copy = vtk::TakeSmartPointer(data->NewInstance());
  copy->DeepCopy(data);
  return copy;
}

void RoundLeaf(vtkDataObject* leaf)
{
  Round(leaf->GetFieldData());
  if (auto* set = vtkDataSet::SafeDownCast(leaf))
  {
    Round(set->GetPointData());
    Round(set->GetCellData());
  }
  auto* points = vtkPointSet::SafeDownCast(leaf);
  if (points && points->GetPoints())
  {
    Round(points->GetPoints()->GetData());
    points->GetPoints()->Modified();
  }
}

} // namespace

vtkSmartPointer<vtkDataObject> RoundedToFloat(vtkDataObject* data)
{
  if (!data)
  {
    return nullptr;
  }
  vtkSmartPointer<vtkDataObject> copy = Copy(data);
  auto* composite = vtkCompositeDataSet::SafeDownCast(copy);
  if (!composite)
  {
    RoundLeaf(copy);
    return copy;
  }
  Round(copy->GetFieldData());
  auto iterator = vtk::TakeSmartPointer(composite->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    RoundLeaf(iterator->GetCurrentDataObject());
  }
  return copy;
}
