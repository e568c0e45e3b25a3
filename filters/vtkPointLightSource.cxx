// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointLightSource.h"

#include "radiometry/scene/InputError.h"
#include "radiometry/scene/LightRecord.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPointLightSource);

double vtkPointLightSource::Describe(radiometry::LightRecord& light, bool& photometric)
{
  if (this->IntensityUnit < WattPerSteradian || this->IntensityUnit > Lumen)
  {
    throw radiometry::InputError(
      "IntensityUnit", -1, this->IntensityUnit, "0 W/sr, 1 W, 2 cd or 3 lm");
  }
  light.Type = radiometry::LightType::Point;
  light.Attenuation = { this->Attenuation[0], this->Attenuation[1], this->Attenuation[2] };
  photometric = this->IntensityUnit == Candela || this->IntensityUnit == Lumen;
  const bool flux = this->IntensityUnit == Watt || this->IntensityUnit == Lumen;
  return flux ? 1.0 / radiometry::SpotFluxFactor(180.0, -1.0, 0.0) : 1.0;
}

void vtkPointLightSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Attenuation: " << this->Attenuation[0] << " " << this->Attenuation[1] << " "
     << this->Attenuation[2] << "\n";
}
