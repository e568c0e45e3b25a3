// SPDX-License-Identifier: BSD-3-Clause
#include "BandColors.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"

namespace vtkradiometry
{

BandColors::BandColors(vtkFieldData* field, radiometry::imaging::BandValues values)
{
  vtkDataArray* array = field->GetArray(radiometry::names::Wavelengths);
  std::vector<double> wavelengths;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      wavelengths.push_back(array->GetComponent(i, c));
    }
  }
  try
  {
    if (!wavelengths.empty())
    {
      this->Spectrum = std::make_shared<const radiometry::imaging::SpectralColor>(
        wavelengths.data(), static_cast<int>(wavelengths.size()), values);
    }
  }
  catch (const radiometry::InputError& error)
  {
    this->Problem = error.what();
  }
}

bool BandColors::IsSpectral(vtkDataArray* array) const
{
  const int bands = array->GetNumberOfComponents();
  return bands != 1 && bands != 3 && this->Spectrum && this->Spectrum->GetBands() == bands;
}

std::array<double, 3> BandColors::Of(vtkDataArray* array, vtkIdType tuple) const
{
  const int bands = array->GetNumberOfComponents();
  std::array<double, 32> few;
  std::vector<double> many(bands > 32 ? static_cast<std::size_t>(bands) : 0);
  double* values = bands > 32 ? many.data() : few.data();
  array->GetTuple(tuple, values);
  return radiometry::imaging::ColorOfBands(values, bands, this->Spectrum.get());
}

} // namespace vtkradiometry
