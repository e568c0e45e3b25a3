// SPDX-License-Identifier: BSD-3-Clause
#include "FieldAttributes.h"

#include "vtkDataArray.h"
#include "vtkStringArray.h"

#include <cstdio>
#include <string>
#include <vector>

namespace io = radiometry::io;

namespace
{

constexpr vtkIdType longestAttribute = 4096;

std::string Numbers(vtkDataArray* array)
{
  std::string text;
  char number[40];
  for (vtkIdType i = 0; i < array->GetNumberOfTuples() * array->GetNumberOfComponents(); ++i)
  {
    const int n = array->GetNumberOfComponents();
    std::snprintf(
      number, sizeof number, "%.17g", array->GetComponent(i / n, static_cast<int>(i % n)));
    text += (i ? " " : "") + std::string(number);
  }
  return text;
}

} // namespace

bool Describe(vtkAbstractArray* array, io::ExrAttribute& out)
{
  const vtkIdType n = array->GetNumberOfValues();
  if (n < 1 || n > longestAttribute)
  {
    return false;
  }
  if (auto* strings = vtkStringArray::SafeDownCast(array))
  {
    std::vector<std::string> values;
    for (vtkIdType i = 0; i < n; ++i)
    {
      values.push_back(strings->GetValue(i));
    }
    out = n == 1 ? io::ExrAttribute(values[0]) : io::ExrAttribute(values);
    return true;
  }
  auto* data = vtkDataArray::SafeDownCast(array);
  if (!data)
  {
    return false;
  }
  const auto value = [&](vtkIdType i) {
    const int c = data->GetNumberOfComponents();
    return data->GetComponent(i / c, static_cast<int>(i % c));
  };
  const int type = data->GetDataType();
  if (std::string(array->GetName()) == "chromaticities" && n == 8)
  {
    io::ExrChromaticities xy;
    for (int i = 0; i < 8; ++i)
    {
      xy[i] = static_cast<float>(value(i));
    }
    out = xy;
  }
  else if (n == 1 && type == VTK_FLOAT)
  {
    out = static_cast<float>(value(0));
  }
  else if (n == 1 && type == VTK_INT)
  {
    out = static_cast<int>(value(0));
  }
  else if (n == 1)
  {
    out = value(0);
  }
  else if (n == 2 && type == VTK_FLOAT)
  {
    out = std::array<float, 2>{ static_cast<float>(value(0)), static_cast<float>(value(1)) };
  }
  else if (n == 3 && type == VTK_FLOAT)
  {
    out = std::array<float, 3>{ static_cast<float>(value(0)), static_cast<float>(value(1)),
      static_cast<float>(value(2)) };
  }
  else if (n == 3 && type == VTK_DOUBLE)
  {
    out = std::array<double, 3>{ value(0), value(1), value(2) };
  }
  else if (type == VTK_FLOAT)
  {
    std::vector<float> values;
    for (vtkIdType i = 0; i < n; ++i)
    {
      values.push_back(static_cast<float>(value(i)));
    }
    out = values;
  }
  else
  {
    out = Numbers(data);
  }
  return true;
}
