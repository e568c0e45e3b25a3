// SPDX-License-Identifier: BSD-3-Clause
#include "BandWavelengths.h"

#include "radiometry/imaging/ColorMatching.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <string>

namespace names = radiometry::names;
using radiometry::InputError;

namespace
{

void Meet(vtkDataObject* object, std::vector<double>& found)
{
  vtkDataArray* array = object ? object->GetFieldData()->GetArray(names::Wavelengths) : nullptr;
  std::vector<double> here;
  for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
  {
    const int components = array->GetNumberOfComponents();
    here.push_back(array->GetComponent(i / components, static_cast<int>(i % components)));
  }
  if (here.empty())
  {
    return;
  }
  if (found.empty())
  {
    found = here;
  }
  const auto differs = std::mismatch(here.begin(), here.end(), found.begin(), found.end());
  if (differs.first != here.end())
  {
    const bool longer = differs.second == found.end();
    throw InputError(names::Wavelengths, differs.first - here.begin(), *differs.first,
      longer ? std::to_string(found.size()) + " values as elsewhere in the inputs"
             : std::to_string(*differs.second) + " nm as elsewhere in the inputs");
  }
  if (here.size() < found.size())
  {
    throw InputError(names::Wavelengths, -1, std::to_string(here.size()) + " values",
      std::to_string(found.size()) + " as elsewhere in the inputs");
  }
}

} // namespace

std::vector<double> FindWavelengths(const std::vector<vtkDataObject*>& objects)
{
  std::vector<double> found;
  for (vtkDataObject* object : objects)
  {
    Meet(object, found);
    if (auto* composite = vtkCompositeDataSet::SafeDownCast(object))
    {
      auto iterator = vtk::TakeSmartPointer(composite->NewIterator());
      for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
      {
        Meet(iterator->GetCurrentDataObject(), found);
      }
    }
  }
  return found;
}

std::vector<double> CheckedWavelengths(const std::vector<vtkDataObject*>& objects, int bands)
{
  std::vector<double> found = FindWavelengths(objects);
  if (found.empty())
  {
    return found;
  }
  if (static_cast<int>(found.size()) != bands)
  {
    throw InputError(names::Wavelengths, -1, std::to_string(found.size()) + " values",
      "one for each of the " + std::to_string(bands) + " bands");
  }
  const radiometry::imaging::SpectralColor check(found.data(), bands);
  return found;
}

void AddWavelengths(const std::vector<double>& wavelengths, vtkDataObject* output)
{
  if (wavelengths.empty() || output->GetFieldData()->GetArray(names::Wavelengths))
  {
    return;
  }
  vtkNew<vtkDoubleArray> array;
  array->SetName(names::Wavelengths);
  for (double wavelength : wavelengths)
  {
    array->InsertNextValue(wavelength);
  }
  output->GetFieldData()->AddArray(array);
}
