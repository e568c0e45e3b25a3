// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSpotLightSource.h"

#include "radiometry/scene/InputError.h"
#include "radiometry/scene/LightRecord.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkSpotLightSource);

double vtkSpotLightSource::Describe(radiometry::LightRecord& light, bool& photometric)
{
  if (this->IntensityUnit < WattPerSteradian || this->IntensityUnit > Lumen)
  {
    throw radiometry::InputError(
      "IntensityUnit", -1, this->IntensityUnit, "0 W/sr, 1 W, 2 cd or 3 lm");
  }
  light.Type = radiometry::LightType::Spot;
  const radiometry::Vec3 direction{ this->Direction[0], this->Direction[1], this->Direction[2] };
  const radiometry::Vec3 target{ this->Target[0], this->Target[1], this->Target[2] };
  light.Direction = this->UseTarget
    ? radiometry::UnitDirection("Target - Position", target - light.Position)
    : radiometry::UnitDirection("Direction", direction);
  light.SpotCutoff = this->Cutoff;
  light.SpotInnerCutoff = this->InnerCutoff;
  light.SpotExponent = this->Exponent;
  light.Attenuation = { this->Attenuation[0], this->Attenuation[1], this->Attenuation[2] };
  radiometry::Validate(light); // before the cone is integrated
  photometric = this->IntensityUnit == Candela || this->IntensityUnit == Lumen;
  const bool flux = this->IntensityUnit == Watt || this->IntensityUnit == Lumen;
  return flux
    ? 1.0 / radiometry::SpotFluxFactor(this->Cutoff, this->InnerCutoff, this->Exponent)
    : 1.0;
}

void vtkSpotLightSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Direction: " << this->Direction[0] << " " << this->Direction[1] << " "
     << this->Direction[2] << "\n";
  os << indent << "Target: " << this->Target[0] << " " << this->Target[1] << " " << this->Target[2]
     << (this->UseTarget ? "" : " (not used)") << "\n";
  os << indent << "Cutoff: " << this->Cutoff << "\n";
  os << indent << "InnerCutoff: " << this->InnerCutoff << "\n";
  os << indent << "Exponent: " << this->Exponent << "\n";
  os << indent << "Attenuation: " << this->Attenuation[0] << " " << this->Attenuation[1] << " "
     << this->Attenuation[2] << "\n";
}
