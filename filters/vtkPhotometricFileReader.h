// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkPhotometricFileReader_h
#define vtkPhotometricFileReader_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkRadiometryFiltersModule.h"

#include <memory> // for File

namespace radiometry
{
namespace io
{
struct LuminairePlacement;
struct PhotometricFile;
}
}

/// Reads a luminaire from an IES (.ies, LM-63-1986 to 2019) or EULUMDAT (.ldt) file.
///   Writes  port 0: one light with its candela web (or AreaSamples of equal share), with the light
///           arrays and field data of docs/arrays.md; further field data: LuminaireName,
///           Manufacturer, CatalogueNumber, LampName, PhotometricFormat, PhotometricKeywords,
///           Assumptions, Warnings; FluxFromWeb, FluxStated and LampFlux in FluxUnit (below 0: not
///           stated), GreatestIntensity in FileIntensityUnit, LightOutputRatio, InputPower [W],
///           LuminousOpeningShape, LuminousOpeningSize [m]
///           port 1: the distribution as a surface; point arrays RelativeIntensity, Intensity [W/sr]
///           and, of a file in candela, LuminousIntensity [cd]
///           port 2: the luminous faces of the luminaire to scale
///   Model   I = web x the file's factors x LightLossFactor x Dimming, cd divided by
///           LuminousEfficacy; the web is bilinear in its angles. C, B and A angles, all
///           symmetries: docs/filters/luminaires.md
///   Cost    O(size of the file)
///   Fails   a missing or damaged file: an error with the number of its line, empty outputs. A flux
///           that the header states otherwise (by more than 2 %) is a warning that gives both
class VTKRADIOMETRYFILTERS_EXPORT vtkPhotometricFileReader : public vtkPolyDataAlgorithm
{
public:
  static vtkPhotometricFileReader* New();
  vtkTypeMacro(vtkPhotometricFileReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The file, .ies or .ldt.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  enum IntensityUnitChoice
  {
    IntensityUnitsAuto = 0, // as the file says; candela where it says nothing
    IntensityUnitsCandela = 1,
    IntensityUnitsMilliwattPerSteradian = 2,
    IntensityUnitsWattPerSteradian = 3
  };
  ///@{
  /// What the file's intensities are. UV lamps come in mW/sr and say so in words of their own, which
  /// Auto (default) knows: [_INTENSITYUNITS], "candela-> mW/sr", "radiometric units".
  vtkSetClampMacro(IntensityUnits, int, IntensityUnitsAuto, IntensityUnitsWattPerSteradian);
  vtkGetMacro(IntensityUnits, int);
  ///@}

  ///@{
  /// Luminous efficacy K of the luminaire's light [lm/W], by which candela are divided. Default
  /// 683.002. Finite, > 0. Not used for files in mW/sr or W/sr.
  vtkSetMacro(LuminousEfficacy, double);
  vtkGetMacro(LuminousEfficacy, double);
  ///@}

  ///@{
  /// Where the luminaire's photometric centre is [m]. Default (0, 0, 0).
  vtkSetVector3Macro(Position, double);
  vtkGetVector3Macro(Position, double);
  ///@}

  ///@{
  /// The luminaire's axis: where gamma = 0 (type B: H = V = 0; type A: X = Y = 0) points. Default
  /// (0, 0, -1). Any length but zero.
  vtkSetVector3Macro(Direction, double);
  vtkGetVector3Macro(Direction, double);
  ///@}

  ///@{
  /// Where C = 0 (types B and A: a vertical angle of 90 degrees) points, once made square to
  /// Direction. Default (1, 0, 0). Along Direction: any direction square to it.
  vtkSetVector3Macro(ReferenceDirection, double);
  vtkGetVector3Macro(ReferenceDirection, double);
  ///@}

  ///@{
  /// Turns the luminaire about its axis [degrees], counter-clockwise seen from above. Default 0.
  vtkSetMacro(Rotation, double);
  vtkGetMacro(Rotation, double);
  ///@}

  ///@{
  /// Factors on the flux: what is left of it after maintenance, and how far it is dimmed. Default 1.
  /// Finite, >= 0.
  vtkSetMacro(LightLossFactor, double);
  vtkGetMacro(LightLossFactor, double);
  vtkSetMacro(Dimming, double);
  vtkGetMacro(Dimming, double);
  ///@}

  ///@{
  /// EULUMDAT: which of the file's lamp sets is fitted, from 0. Default 0.
  vtkSetMacro(LampSet, int);
  vtkGetMacro(LampSet, int);
  ///@}

  ///@{
  /// LM-63 with a TILT table: the angle [degrees] whose factor applies. Default 0.
  vtkSetMacro(TiltAngle, double);
  vtkGetMacro(TiltAngle, double);
  ///@}

  ///@{
  /// Linear Rec.709 factors on the intensity: a plain multiplier. Default (1, 1, 1). Finite, >= 0.
  vtkSetVector3Macro(Color, double);
  vtkGetVector3Macro(Color, double);
  ///@}

  ///@{
  /// Number of bands of the lights. 0 (default): one where Color is grey, else three; 1: one band,
  /// its factor the luminance of Color; 3: linear Rec.709; any other number: the same in each.
  vtkSetClampMacro(Bands, int, 0, 4096);
  vtkGetMacro(Bands, int);
  ///@}

  ///@{
  /// Spread the light over the luminous opening as n x m lights of equal share, for places nearer
  /// than some five times its size. Along the luminaire's x and y (C = 0 and 90); of round openings
  /// n rings of m. Default (1, 1): one light at the centre. Each 1 to 1000.
  vtkSetVector2Macro(AreaSamples, int);
  vtkGetVector2Macro(AreaSamples, int);
  ///@}

  ///@{
  /// Radius of the distribution's surface (port 1) at its greatest intensity [m]. Default 1.
  /// Finite, > 0.
  vtkSetMacro(SolidScale, double);
  vtkGetMacro(SolidScale, double);
  ///@}

  ///@{
  /// Whether the luminaire shines. Default on.
  vtkSetMacro(LightEnabled, bool);
  vtkGetMacro(LightEnabled, bool);
  vtkBooleanMacro(LightEnabled, bool);
  ///@}

  ///@{
  /// What the luminaire moves with: 0 the scene (default), 1 an object, 2 the camera.
  vtkSetMacro(AttachedTo, int);
  vtkGetMacro(AttachedTo, int);
  ///@}

  ///@{
  /// After an update: the web's total flux, and the luminaire's flux that the file states (below 0:
  /// it does not), both in lm, mW or W as GetFluxUnit says, without LightLossFactor and Dimming.
  double GetFluxFromWeb();
  double GetFluxStated();
  const char* GetFluxUnit();
  ///@}

  ///@{
  /// After an update: what is at odds with itself in the file, and how it was understood, in whole
  /// sentences. Null beyond the last.
  int GetNumberOfWarnings();
  const char* GetWarning(int i);
  int GetNumberOfAssumptions();
  const char* GetAssumption(int i);
  ///@}

  /// True when the file's name ends in .ies or .ldt and it can be opened.
  static int CanReadFile(VTK_FILEPATH const char* fileName);

protected:
  vtkPhotometricFileReader();
  ~vtkPhotometricFileReader() override;

  int RequestData(
    vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out) override;

  char* FileName = nullptr;
  int IntensityUnits = IntensityUnitsAuto;
  double LuminousEfficacy;
  double Position[3] = { 0.0, 0.0, 0.0 };
  double Direction[3] = { 0.0, 0.0, -1.0 };
  double ReferenceDirection[3] = { 1.0, 0.0, 0.0 };
  double Rotation = 0.0;
  double LightLossFactor = 1.0;
  double Dimming = 1.0;
  int LampSet = 0;
  double TiltAngle = 0.0;
  double Color[3] = { 1.0, 1.0, 1.0 };
  int Bands = 0;
  int AreaSamples[2] = { 1, 1 };
  double SolidScale = 1.0;
  bool LightEnabled = true;
  int AttachedTo = 0;

private:
  vtkPhotometricFileReader(const vtkPhotometricFileReader&) = delete;
  void operator=(const vtkPhotometricFileReader&) = delete;

  void CheckProperties() const;
  radiometry::io::LuminairePlacement Placement() const;
  double RadiantFactor() const;
  void MakeLights(const radiometry::io::LuminairePlacement& placement, vtkPolyData* output) const;
  void MakeSolid(const radiometry::io::LuminairePlacement& placement, vtkPolyData* output) const;
  void Describe(vtkPolyData* output) const;

  std::unique_ptr<radiometry::io::PhotometricFile> File;
};

#endif
