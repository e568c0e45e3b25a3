// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRadiometricLightSource_h
#define vtkRadiometricLightSource_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkRadiometryFiltersModule.h"

#include <vector> // for BandFactors

namespace radiometry
{
struct LightRecord;
}

/// What the light sources share: one light as data.
///   Writes  vtkPolyData of one vertex at Position with the light arrays of docs/arrays.md (point
///           data); field data: IntensityUnit, Photometric (1 when the intensity was given in lm,
///           cd or lx), LuminousEfficacy [lm/W], LightNames
///   Model   Intensity[b] = factor[b] * (Intensity in SI); a photometric intensity is divided by
///           LuminousEfficacy, a flux by the integral of the light's distribution
///   Fails   a property out of range: an error that names it and its value, an empty output
class VTKRADIOMETRYFILTERS_EXPORT vtkRadiometricLightSource : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkRadiometricLightSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Position of the light [m]. Default (0, 0, 0). For a directional light it only says where
  /// the light is drawn.
  vtkSetVector3Macro(Position, double);
  vtkGetVector3Macro(Position, double);
  ///@}

  ///@{
  /// How strong the light is, in the unit chosen by IntensityUnit. Default 1. Finite, >= 0.
  vtkSetMacro(Intensity, double);
  vtkGetMacro(Intensity, double);
  ///@}

  ///@{
  /// Unit of Intensity; the values are those of the subclass. Default 0, its SI unit.
  vtkSetMacro(IntensityUnit, int);
  vtkGetMacro(IntensityUnit, int);
  ///@}

  ///@{
  /// Luminous efficacy K of the light's radiation [lm/W], by which a photometric intensity is
  /// divided. Default 683.002, that of 555 nm. Finite, > 0.
  vtkSetMacro(LuminousEfficacy, double);
  vtkGetMacro(LuminousEfficacy, double);
  ///@}

  ///@{
  /// Linear Rec.709 factors on the intensity. A plain multiplier, as in glTF: (1, 1, 1) leaves the
  /// intensity as it is, and any other colour changes the luminous flux. Default (1, 1, 1).
  /// Finite, >= 0. Not used where band factors are set.
  vtkSetVector3Macro(Color, double);
  vtkGetVector3Macro(Color, double);
  ///@}

  ///@{
  /// Number of bands of the output. 0 (default): one where Color is grey, else three; 1: one
  /// band, its factor the luminance of Color; 3: linear Rec.709; any other number: one band factor
  /// for each, 1 where none was set.
  vtkSetMacro(Bands, int);
  vtkGetMacro(Bands, int);
  ///@}

  ///@{
  /// Factor on the intensity in one band, for spectral work. When any is set, Color is not used
  /// and the output has as many bands as Bands says, or as factors were set.
  void SetBandFactor(int band, double factor);
  void ClearBandFactors();
  int GetNumberOfBandFactors() const { return static_cast<int>(this->BandFactors.size()); }
  ///@}

  ///@{
  /// Whether the light shines. Default on.
  vtkSetMacro(LightEnabled, bool);
  vtkGetMacro(LightEnabled, bool);
  vtkBooleanMacro(LightEnabled, bool);
  ///@}

  ///@{
  /// What the light moves with: 0 the scene (default), 1 an object, 2 the camera.
  vtkSetMacro(AttachedTo, int);
  vtkGetMacro(AttachedTo, int);
  ///@}

  ///@{
  /// A name, repeated in the output's field data. Default empty.
  vtkSetStringMacro(LightName);
  vtkGetStringMacro(LightName);
  ///@}

protected:
  vtkRadiometricLightSource();
  ~vtkRadiometricLightSource() override;

  int RequestData(
    vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out) override;

  /// Fills what the subclass knows into `light` (type, direction, cone, attenuation) and returns
  /// the factor that turns Intensity into SI per unit of efficacy-converted value; sets
  /// `photometric`. Throws radiometry::InputError.
  virtual double Describe(radiometry::LightRecord& light, bool& photometric) = 0;
  /// Fewest bands that the subclass needs, where Bands is 0 (automatic) and Color grey.
  virtual int LeastBands() const { return 1; }
  /// Appends further lights to the one described (a sun to its sky), of as many bands: their
  /// intensities are multiples of `factors`. Throws radiometry::InputError.
  virtual void AddFurther(
    std::vector<radiometry::LightRecord>& lights, const std::vector<double>& factors);

  double Position[3] = { 0.0, 0.0, 0.0 };
  double Intensity = 1.0;
  int IntensityUnit = 0;
  double LuminousEfficacy;
  double Color[3] = { 1.0, 1.0, 1.0 };
  int Bands = 0;
  std::vector<double> BandFactors;
  bool LightEnabled = true;
  int AttachedTo = 0;
  char* LightName = nullptr;

private:
  vtkRadiometricLightSource(const vtkRadiometricLightSource&) = delete;
  void operator=(const vtkRadiometricLightSource&) = delete;

  std::vector<double> Factors() const;
};

#endif
