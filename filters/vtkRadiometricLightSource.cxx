// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiometricLightSource.h"

#include "LightPolyData.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/LightRecord.h"
#include "radiometry/scene/Units.h"

#include "vtkPolyData.h"

#include <cmath>

vtkRadiometricLightSource::vtkRadiometricLightSource()
  : LuminousEfficacy(radiometry::units::MaximumLuminousEfficacy)
{
  this->SetNumberOfInputPorts(0);
}

vtkRadiometricLightSource::~vtkRadiometricLightSource()
{
  this->SetLightName(nullptr);
}

void vtkRadiometricLightSource::SetBandFactor(int band, double factor)
{
  if (band < 0 || band >= 4096)
  {
    vtkErrorMacro("SetBandFactor: band = " << band << ": expected 0 to 4095");
    return;
  }
  if (static_cast<std::size_t>(band) >= this->BandFactors.size())
  {
    this->BandFactors.resize(band + 1, 1.0);
  }
  this->BandFactors[band] = factor;
  this->Modified();
}

void vtkRadiometricLightSource::ClearBandFactors()
{
  this->BandFactors.clear();
  this->Modified();
}

std::vector<double> vtkRadiometricLightSource::Factors() const
{
  if (this->Bands < 0 || this->Bands > 4096)
  {
    throw radiometry::InputError("Bands", -1, this->Bands, "0 (automatic) to 4096");
  }
  const double* c = this->Color;
  std::vector<double> factors = this->BandFactors;
  if (!factors.empty() || this->Bands == 2 || this->Bands > 3)
  {
    factors.resize(this->Bands > 0 ? this->Bands : factors.size(), 1.0);
  }
  else if (this->Bands == 1)
  {
    factors = { radiometry::units::Photometric(c, 3, 1.0) };
  }
  else if (this->Bands == 0 && c[0] == c[1] && c[1] == c[2] && this->LeastBands() == 1)
  {
    factors = { c[0] };
  }
  else
  {
    factors = { c[0], c[1], c[2] };
  }
  for (std::size_t b = 0; b < factors.size(); ++b)
  {
    if (!std::isfinite(factors[b]) || factors[b] < 0.0)
    {
      throw radiometry::InputError(this->BandFactors.empty() ? "Color" : "BandFactor",
        static_cast<long long>(b), factors[b], "a finite number, not negative");
    }
  }
  return factors;
}

void vtkRadiometricLightSource::AddFurther(
  std::vector<radiometry::LightRecord>&, const std::vector<double>&)
{
}

int vtkRadiometricLightSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* out)
{
  vtkPolyData* output = vtkPolyData::GetData(out);
  output->Initialize();
  try
  {
    radiometry::LightRecord light;
    light.Name = this->LightName ? this->LightName : "";
    light.Position = { this->Position[0], this->Position[1], this->Position[2] };
    light.Enabled = this->LightEnabled;
    light.AttachedTo = this->AttachedTo;
    if (!std::isfinite(this->Intensity) || this->Intensity < 0.0)
    {
      throw radiometry::InputError(
        "Intensity", -1, this->Intensity, "a finite number, not negative");
    }
    bool photometric = false;
    double value = this->Intensity * this->Describe(light, photometric);
    // Checked whatever the unit is: the efficacy is part of the output.
    const double converted = radiometry::units::Radiometric(value, this->LuminousEfficacy);
    value = photometric ? converted : value;
    light.Intensity = this->Factors();
    for (double& band : light.Intensity)
    {
      band *= value;
    }
    std::vector<radiometry::LightRecord> lights{ light };
    this->AddFurther(lights, this->Factors());
    for (const radiometry::LightRecord& each : lights)
    {
      radiometry::Validate(each);
    }
    WriteLights(lights, static_cast<int>(light.Intensity.size()), photometric,
      this->LuminousEfficacy, output);
  }
  catch (const radiometry::InputError& error)
  {
    vtkErrorMacro(<< error.what());
    output->Initialize();
    return 0;
  }
  return 1;
}

void vtkRadiometricLightSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Position: " << this->Position[0] << " " << this->Position[1] << " "
     << this->Position[2] << "\n";
  os << indent << "Intensity: " << this->Intensity << " (unit " << this->IntensityUnit << ")\n";
  os << indent << "LuminousEfficacy: " << this->LuminousEfficacy << " lm/W\n";
  os << indent << "Color: " << this->Color[0] << " " << this->Color[1] << " " << this->Color[2]
     << "\n";
  os << indent << "Bands: " << this->Bands << "\n";
  os << indent << "LightEnabled: " << this->LightEnabled << "\n";
  os << indent << "AttachedTo: " << this->AttachedTo << "\n";
  os << indent << "LightName: " << (this->LightName ? this->LightName : "(none)") << "\n";
}
