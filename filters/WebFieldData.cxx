// SPDX-License-Identifier: BSD-3-Clause
#include "WebFieldData.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"

#include <algorithm>

namespace
{

std::string WebName(int k)
{
  return radiometry::names::PhotometricWeb + std::to_string(k);
}

void Add(const std::string& name, const std::vector<double>& values, vtkFieldData* output)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  output->AddArray(array);
}

std::vector<double> Values(vtkDataArray* array)
{
  const int components = array->GetNumberOfComponents();
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(array->GetNumberOfValues()));
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      values.push_back(array->GetComponent(i, c));
    }
  }
  return values;
}

} // namespace

void WriteWeb(const radiometry::CandelaWeb& web, int k, vtkFieldData* output)
{
  const std::string name = WebName(k);
  Add(name, web.GetValues(), output);
  Add(name + "Horizontal", web.GetHorizontal(), output);
  Add(name + "Vertical", web.GetVertical(), output);
  vtkNew<vtkIntArray> type;
  type->SetName((name + "Type").c_str());
  type->InsertNextValue(static_cast<int>(web.GetType()));
  output->AddArray(type);
}

std::shared_ptr<const radiometry::CandelaWeb> ReadWeb(
  vtkFieldData* input, int k, const std::string& prefix)
{
  const std::string name = WebName(k);
  vtkDataArray* values = input->GetArray(name.c_str());
  if (!values)
  {
    return nullptr;
  }
  const auto angles = [&](const char* which) {
    vtkDataArray* array = input->GetArray((name + which).c_str());
    if (!array)
    {
      throw radiometry::InputError(
        prefix + name + which, -1, "missing", "a field array of angles in degrees");
    }
    return Values(array);
  };
  vtkDataArray* type = input->GetArray((name + "Type").c_str());
  const double kind = type && type->GetNumberOfTuples() > 0 ? type->GetComponent(0, 0) : 1.0;
  if (kind != 1.0 && kind != 2.0 && kind != 3.0)
  {
    throw radiometry::InputError(prefix + name + "Type", -1, kind, "1 C, 2 B or 3 A");
  }
  return std::make_shared<radiometry::CandelaWeb>(
    static_cast<radiometry::WebType>(static_cast<int>(kind)), angles("Horizontal"),
    angles("Vertical"), Values(values), prefix + name);
}
