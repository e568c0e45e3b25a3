// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEnvironmentLightSource.h"

#include "EnvironmentPicture.h"
#include "radiometry/irradiance/Daylight.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/LightRecord.h"
#include "radiometry/scene/SolarPosition.h"
#include "radiometry/scene/Units.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <cmath>

using radiometry::InputError;
using radiometry::SkyRadiance;
using radiometry::Vec3;

vtkStandardNewMacro(vtkEnvironmentLightSource);

vtkEnvironmentLightSource::vtkEnvironmentLightSource()
{
  this->SetNumberOfInputPorts(1);
  this->Intensity = 10000.0;
  this->IntensityUnit = HorizontalLux;
}

vtkEnvironmentLightSource::~vtkEnvironmentLightSource()
{
  this->SetFileName(nullptr);
}

const char* vtkEnvironmentLightSource::GetSkyTypeName(int type)
{
  return type >= 1 && type <= SkyRadiance::Types ? SkyRadiance::TypeName(type) : nullptr;
}

void vtkEnvironmentLightSource::SetMapData(vtkDataObject* image)
{
  this->SetInputDataInternal(0, image);
}

int vtkEnvironmentLightSource::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkEnvironmentLightSource::RequestData(
  vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out)
{
  this->Picture.reset();
  if (this->Preset == Map)
  {
    try
    {
      const bool file = this->FileName && this->FileName[0] != '\0';
      vtkImageData* image = file ? nullptr : vtkImageData::GetData(in[0], 0);
      if (!file && !image)
      {
        throw InputError("FileName", -1, "empty", "a lat-long OpenEXR picture, or one as input");
      }
      this->Picture = file ? ReadPicture(this->FileName, this->Bands == 1)
                           : PictureOf(image, this->Bands == 1);
    }
    catch (const InputError& error)
    {
      vtkErrorMacro(<< error.what());
      vtkPolyData::GetData(out)->Initialize();
      return 0;
    }
  }
  const int done = this->Superclass::RequestData(request, in, out);
  this->Picture.reset();
  return done;
}

int vtkEnvironmentLightSource::LeastBands() const
{
  return this->Picture ? this->Picture->Bands() : 1;
}

double vtkEnvironmentLightSource::Describe(radiometry::LightRecord& light, bool& photometric)
{
  const auto range = [](const char* name, double value, double least, double most,
                       const char* expected) {
    if (!(value >= least && value <= most))
    {
      throw InputError(name, -1, value, expected);
    }
  };
  range("Preset", this->Preset, Uniform, Map,
    "0 uniform, 1 overcast, 2 clear, 3 intermediate, 4 general or 5 map");
  range("IntensityUnit", this->IntensityUnit, WattPerSquareMeterSteradian, HorizontalLux,
    "0 W/(m^2 sr), 1 cd/m^2, 2 W/m^2 horizontal or 3 lx horizontal");
  range("SunPosition", this->SunPosition, ByDirection, ByPlaceAndTime,
    "0 direction, 1 altitude and azimuth or 2 place and time");
  range("SunUnit", this->SunUnit, NormalWattPerSquareMeter, SunHorizontalLux,
    "0 W/m^2 normal, 1 lx normal, 2 W/m^2 horizontal or 3 lx horizontal");

  const double* up = this->UpDirection;
  const double* north = this->NorthDirection;
  light.Type = radiometry::LightType::Environment;
  light.Direction = -radiometry::UnitDirection("UpDirection", { up[0], up[1], up[2] });
  light.Reference = radiometry::UnitDirection("NorthDirection", { north[0], north[1], north[2] });
  const radiometry::SkyFrame frame(light.Direction, light.Reference);

  Vec3 toSun;
  if (this->SunPosition == ByDirection)
  {
    const double* sun = this->SunDirection;
    toSun = frame.ToSky(radiometry::UnitDirection("SunDirection", { sun[0], sun[1], sun[2] }));
  }
  else
  {
    radiometry::SunAngles angles{ this->SunAltitude, this->SunAzimuth };
    if (this->SunPosition == ByPlaceAndTime)
    {
      angles = radiometry::SolarPosition({ this->Latitude, this->Longitude, this->Year,
        this->Month, this->Day, this->Hour, this->TimeZone });
    }
    range("SunAltitude", angles.Altitude, -90.0, 90.0, "degrees in [-90, 90]");
    range("SunAzimuth", angles.Azimuth, -1e6, 1e6, "degrees");
    toSun = radiometry::TowardSun(angles);
  }
  this->SunIsUp = toSun.z > 0.0;
  const Vec3 sunward = frame.ToWorld(toSun);
  for (int a = 0; a < 3; ++a)
  {
    this->TowardSun[a] = sunward[a];
  }
  const int types[] = { 0, 0, 12, 7, this->SkyType, 0 };
  const int type = types[this->Preset];
  std::shared_ptr<const SkyRadiance> sky = this->Picture;
  if (this->Preset == Uniform || this->Preset == Overcast)
  {
    sky = this->Preset == Uniform ? SkyRadiance::Uniform() : SkyRadiance::Overcast();
  }
  else if (this->Preset != Map)
  {
    sky = SkyRadiance::General(SkyRadiance::TypeCoefficients(type), toSun);
    if (!this->SunIsUp && SkyRadiance::NeedsSun(type))
    {
      throw InputError("SunDirection", -1, radiometry::units::Degrees(std::asin(toSun.z)),
        "an altitude above 0 degrees: this sky has the sun in it");
    }
  }

  photometric = this->IntensityUnit == CandelaPerSquareMeter || this->IntensityUnit == HorizontalLux;
  const bool sunPhotometric = this->SunUnit == NormalLux || this->SunUnit == SunHorizontalLux;
  const auto watts = [&](double value, bool lumens) {
    return lumens ? radiometry::units::Radiometric(value, this->LuminousEfficacy) : value;
  };
  radiometry::DaylightStrength strength;
  strength.Sky = watts(this->Intensity, photometric);
  strength.SkyHorizontal = this->IntensityUnit >= HorizontalWattPerSquareMeter;
  strength.Sun = this->Sun && this->SunIsUp ? watts(this->SunIntensity, sunPhotometric) : 0.0;
  strength.SunHorizontal = this->SunUnit >= SunHorizontalWattPerSquareMeter;
  strength.GroundReflectance = this->GroundReflectance;
  const radiometry::Daylight scaled = radiometry::MakeDaylight(sky, toSun, strength);
  light.Environment = scaled.Sky;
  this->SunIrradiance = scaled.Sun;
  return strength.Sky > 0.0 ? scaled.Radiance / strength.Sky : 1.0;
}

void vtkEnvironmentLightSource::AddFurther(
  std::vector<radiometry::LightRecord>& lights, const std::vector<double>& factors)
{
  const int bands = this->Picture ? this->Picture->Bands() : 1;
  if (bands != 1 && bands != static_cast<int>(factors.size()))
  {
    throw InputError("Bands", -1, static_cast<double>(factors.size()),
      "0, 1 or " + std::to_string(bands) + ", as the map");
  }
  if (!this->Sun)
  {
    return;
  }
  radiometry::LightRecord sun;
  sun.Name = lights[0].Name.empty() ? "sun" : lights[0].Name + " sun";
  sun.Type = radiometry::LightType::Directional;
  sun.Position = lights[0].Position;
  sun.Direction = -Vec3{ this->TowardSun[0], this->TowardSun[1], this->TowardSun[2] };
  sun.Enabled = lights[0].Enabled && this->SunIsUp;
  sun.AttachedTo = lights[0].AttachedTo;
  sun.Intensity = factors;
  for (double& band : sun.Intensity)
  {
    band *= this->SunIrradiance;
  }
  lights.push_back(sun);
}

void vtkEnvironmentLightSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Preset: " << this->Preset << "\n"
     << indent << "SkyType: " << this->SkyType << "\n"
     << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n"
     << indent << "SunPosition: " << this->SunPosition << "\n"
     << indent << "Sun: " << (this->Sun ? "on" : "off") << "\n"
     << indent << "SunIntensity: " << this->SunIntensity << " (unit " << this->SunUnit << ")\n"
     << indent << "GroundReflectance: " << this->GroundReflectance << "\n";
}
