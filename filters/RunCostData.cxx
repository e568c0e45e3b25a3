// SPDX-License-Identifier: BSD-3-Clause
#include "RunCostData.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"

#include <iterator>
#include <utility>

void AddRunCost(const radiometry::RunCost& cost, vtkFieldData* data)
{
  const std::pair<const char*, double> numbers[] = { { "Seconds", cost.Seconds },
    { "PredictedSeconds", cost.PredictedSeconds }, { "PredictedAt", cost.PredictedAt },
    { "Samples", static_cast<double>(cost.Samples) },
    { "MemoryMiB", static_cast<double>(cost.Bytes) / 1048576.0 } };
  vtkNew<vtkDoubleArray> array;
  array->SetName("RadiometryCost");
  array->SetNumberOfComponents(static_cast<int>(std::size(numbers)));
  array->SetNumberOfTuples(1);
  for (int k = 0; k < array->GetNumberOfComponents(); ++k)
  {
    array->SetComponentName(k, numbers[k].first);
    array->SetTypedComponent(0, k, numbers[k].second);
  }
  data->AddArray(array);
}
