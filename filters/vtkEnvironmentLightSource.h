// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkEnvironmentLightSource_h
#define vtkEnvironmentLightSource_h

#include "vtkRadiometricLightSource.h"

#include <memory> // for Map

class vtkDataObject;

namespace radiometry
{
class SkyRadiance;
}

/// Light from all around: a sky, with its sun if wanted, or a picture of the surroundings.
///   Reads   port 0, optional: vtkImageData, a lat-long picture as point scalars (Preset Map without
///           a FileName); row 0 is the nadir's, as VTK's images begin below
///   Writes  as vtkRadiometricLightSource; LightType 4 with SkyModel, SkyCoefficients,
///           SunDirection, EnvironmentMap and GroundRadiance (docs/arrays.md); with Sun on a second
///           light of LightType 2
///   Model   Intensity scales the relative sky of the preset: the radiance of the zenith (a map: the
///           factor on its values), or what the sky alone sends on a horizontal plane. The ground
///           below a CIE sky has the radiance rho E/pi, E the horizontal irradiance by sky and sun
///   Source  ISO 15469:2004 / CIE S 011:2003; Meeus (1991) for the sun
///   Fails   as vtkRadiometricLightSource; a sky that needs a sun whose sun is below the horizon; a
///           map that cannot be read, or with a value that is negative or not finite
class VTKRADIOMETRYFILTERS_EXPORT vtkEnvironmentLightSource : public vtkRadiometricLightSource
{
public:
  static vtkEnvironmentLightSource* New();
  vtkTypeMacro(vtkEnvironmentLightSource, vtkRadiometricLightSource);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Values of Preset.
  enum Presets
  {
    Uniform = 0,      // the same radiance from the whole sphere, below the horizon too
    Overcast = 1,     // the traditional CIE overcast sky, (1 + 2 sin(elevation))/3
    Clear = 2,        // CIE standard clear sky, type 12
    Intermediate = 3, // partly cloudy, brighter around the sun: CIE type 7
    General = 4,      // the CIE general sky of SkyType
    Map = 5           // a lat-long picture
  };
  ///@{
  /// How the light is distributed. Default Overcast.
  vtkSetMacro(Preset, int);
  vtkGetMacro(Preset, int);
  ///@}

  ///@{
  /// Type of the CIE general sky, 1 to 15. Default 1. Used by the preset General.
  vtkSetMacro(SkyType, int);
  vtkGetMacro(SkyType, int);
  static const char* GetSkyTypeName(int type);
  ///@}

  /// Values of IntensityUnit. Default HorizontalLux, with an Intensity of 10 000 lx.
  enum Units
  {
    WattPerSquareMeterSteradian = 0,  // radiance of the zenith; of a map, the unit of its values
    CandelaPerSquareMeter = 1,        // luminance of the same
    HorizontalWattPerSquareMeter = 2, // irradiance by the sky on a horizontal plane, without sun
    HorizontalLux = 3                 // illuminance by the same
  };

  ///@{
  /// The picture of the preset Map: an OpenEXR file with channels R, G, B (three bands, taken to
  /// linear Rec.709 by the file's chromaticities) or one channel. A cube map where its attribute envmap
  /// says so (its +Y is up, +Z north, +X west), else lat-long: zenith above, north in the middle, east to the right. Each pixel is even.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}
  /// The picture as data instead of a file.
  void SetMapData(vtkDataObject* image);

  ///@{
  /// Toward the zenith, and toward north: azimuth 0, the middle of a map (only what is square to up
  /// counts). Default (0, 0, 1) and (0, 1, 0). Any length but zero.
  vtkSetVector3Macro(UpDirection, double);
  vtkGetVector3Macro(UpDirection, double);
  vtkSetVector3Macro(NorthDirection, double);
  vtkGetVector3Macro(NorthDirection, double);
  ///@}

  /// Values of SunPosition.
  enum SunPositions
  {
    ByDirection = 0,
    ByAngles = 1,
    ByPlaceAndTime = 2
  };
  ///@{
  /// How the sun's place is given. Default ByAngles.
  vtkSetMacro(SunPosition, int);
  vtkGetMacro(SunPosition, int);
  ///@}
  ///@{
  /// Toward the sun. Default (0, -1, 1). Any length but zero.
  vtkSetVector3Macro(SunDirection, double);
  vtkGetVector3Macro(SunDirection, double);
  ///@}
  ///@{
  /// Altitude over the horizon and azimuth clockwise from north [degrees]. Default 45 and 180.
  /// [-90, 90], any.
  vtkSetMacro(SunAltitude, double);
  vtkGetMacro(SunAltitude, double);
  vtkSetMacro(SunAzimuth, double);
  vtkGetMacro(SunAzimuth, double);
  ///@}
  ///@{
  /// Place, date and time. Latitude (north) and Longitude (east) in degrees, default Greenwich;
  /// Year, Month, Day, default 2025-06-21; Hour of the clock with its fraction, default 12; TimeZone,
  /// hours that the clock is ahead of UTC, default 0.
  vtkSetMacro(Latitude, double);
  vtkGetMacro(Latitude, double);
  vtkSetMacro(Longitude, double);
  vtkGetMacro(Longitude, double);
  vtkSetMacro(Year, int);
  vtkGetMacro(Year, int);
  vtkSetMacro(Month, int);
  vtkGetMacro(Month, int);
  vtkSetMacro(Day, int);
  vtkGetMacro(Day, int);
  vtkSetMacro(Hour, double);
  vtkGetMacro(Hour, double);
  vtkSetMacro(TimeZone, double);
  vtkGetMacro(TimeZone, double);
  ///@}

  ///@{
  /// Whether the sun itself shines, as a second light of parallel rays. Default off. A sun below the
  /// horizon is switched off.
  vtkSetMacro(Sun, bool);
  vtkGetMacro(Sun, bool);
  vtkBooleanMacro(Sun, bool);
  ///@}
  /// Values of SunUnit.
  enum SunUnits
  {
    NormalWattPerSquareMeter = 0,
    NormalLux = 1,
    SunHorizontalWattPerSquareMeter = 2,
    SunHorizontalLux = 3
  };
  ///@{
  /// How strong the sun is, in SunUnit: normal to its beam, or on a horizontal plane. Default
  /// 100 000 lx normal to the beam. Finite, >= 0.
  vtkSetMacro(SunIntensity, double);
  vtkGetMacro(SunIntensity, double);
  vtkSetMacro(SunUnit, int);
  vtkGetMacro(SunUnit, int);
  ///@}

  ///@{
  /// Share of the light on the ground that the ground sends back, evenly, from below the horizon.
  /// Default 0. [0, 1]. Not used by the presets Uniform and Map, which have a lower half themselves.
  vtkSetMacro(GroundReflectance, double);
  vtkGetMacro(GroundReflectance, double);
  ///@}

protected:
  vtkEnvironmentLightSource();
  ~vtkEnvironmentLightSource() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out) override;
  double Describe(radiometry::LightRecord& light, bool& photometric) override;
  int LeastBands() const override;
  void AddFurther(
    std::vector<radiometry::LightRecord>& lights, const std::vector<double>& factors) override;

  int Preset = Overcast;
  int SkyType = 1;
  char* FileName = nullptr;
  double UpDirection[3] = { 0.0, 0.0, 1.0 };
  double NorthDirection[3] = { 0.0, 1.0, 0.0 };
  int SunPosition = ByAngles;
  double SunDirection[3] = { 0.0, -1.0, 1.0 };
  double SunAltitude = 45.0;
  double SunAzimuth = 180.0;
  double Latitude = 51.4779;
  double Longitude = 0.0;
  int Year = 2025;
  int Month = 6;
  int Day = 21;
  double Hour = 12.0;
  double TimeZone = 0.0;
  bool Sun = false;
  double SunIntensity = 100000.0;
  int SunUnit = NormalLux;
  double GroundReflectance = 0.0;

private:
  vtkEnvironmentLightSource(const vtkEnvironmentLightSource&) = delete;
  void operator=(const vtkEnvironmentLightSource&) = delete;

  // Of the present run.
  std::shared_ptr<const radiometry::SkyRadiance> Picture;
  double SunIrradiance = 0.0; // W/m^2, normal to the beam
  double TowardSun[3] = { 0.0, 0.0, 1.0 };
  bool SunIsUp = true;
};

#endif
