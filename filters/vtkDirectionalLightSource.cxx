// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDirectionalLightSource.h"

#include "radiometry/scene/InputError.h"
#include "radiometry/scene/LightRecord.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkDirectionalLightSource);

double vtkDirectionalLightSource::Describe(radiometry::LightRecord& light, bool& photometric)
{
  if (this->IntensityUnit < WattPerSquareMeter || this->IntensityUnit > Lux)
  {
    throw radiometry::InputError("IntensityUnit", -1, this->IntensityUnit, "0 W/m^2 or 1 lx");
  }
  light.Type = radiometry::LightType::Directional;
  light.Direction = radiometry::UnitDirection("Direction",
    { this->Direction[0], this->Direction[1], this->Direction[2] });
  photometric = this->IntensityUnit == Lux;
  return 1.0;
}

void vtkDirectionalLightSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Direction: " << this->Direction[0] << " " << this->Direction[1] << " "
     << this->Direction[2] << "\n";
}
