// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkSurfaceMaterialFilter_h
#define vtkSurfaceMaterialFilter_h

#include "vtkPassInputTypeAlgorithm.h"
#include "vtkRadiometryFiltersModule.h"

#include <vector> // for Choose

class vtkDataSet;

/// Sets the material arrays of a surface, everywhere or on some of its cells.
///   Reads   any dataset, or composite data of datasets; existing material arrays, whose values
///           stay on cells that are not chosen
///   Writes  cell data DiffuseReflectance, SpecularReflectance, Shininess, EmittedExitance [W/m^2],
///           TwoSided, and Transmittance and DiffuseTransmittance where they are not 0 or exist;
///           N bands
///   Model   diffuse + specular + transmitted + diffusely transmitted <= 1 in each band. Emission given as luminance or
///           radiance is that of a Lambertian emitter: M = pi L; photometric values are divided by
///           LuminousEfficacy
///   Cost    O(cells)
///   Fails   a reflectance out of range, an unknown preset or selection: an error that names it, an
///           empty output
class VTKRADIOMETRYFILTERS_EXPORT vtkSurfaceMaterialFilter : public vtkPassInputTypeAlgorithm
{
public:
  static vtkSurfaceMaterialFilter* New();
  vtkTypeMacro(vtkSurfaceMaterialFilter, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// A material of the list in radiometry/scene/MaterialPresets.h, from 1; 0 (default) takes the
  /// reflectances below. A preset sets the diffuse reflectance; the specular one and the
  /// transmittances are then 0.
  vtkSetMacro(Preset, int);
  vtkGetMacro(Preset, int);
  static int GetNumberOfPresets();
  /// Name and source of a preset, from 1; null outside the list.
  static const char* GetPresetName(int preset);
  static const char* GetPresetSource(int preset);
  ///@}

  ///@{
  /// Diffuse reflectance in linear Rec.709. Default (0.5, 0.5, 0.5). Each in [0, 1].
  vtkSetVector3Macro(DiffuseReflectance, double);
  vtkGetVector3Macro(DiffuseReflectance, double);
  ///@}

  ///@{
  /// Reflectance of the Phong lobe in linear Rec.709. Default 0. Each in [0, 1].
  vtkSetVector3Macro(SpecularReflectance, double);
  vtkGetVector3Macro(SpecularReflectance, double);
  ///@}

  ///@{
  /// Exponent of the Phong lobe. Default 10. Finite, >= 0.
  vtkSetMacro(Shininess, double);
  vtkGetMacro(Shininess, double);
  ///@}

  ///@{
  /// Transmittance in linear Rec.709. Default 0. Each in [0, 1].
  vtkSetVector3Macro(Transmittance, double);
  vtkGetVector3Macro(Transmittance, double);
  ///@}

  ///@{
  /// Share of the light on either side that leaves the other side in all directions (paper,
  /// frosted glass, lampshades), in linear Rec.709. Default 0. Each in [0, 1]. The back of a cell
  /// reflects as well only when TwoSided.
  vtkSetVector3Macro(DiffuseTransmittance, double);
  vtkGetVector3Macro(DiffuseTransmittance, double);
  ///@}

  /// Values of EmissionUnit.
  enum EmissionUnits
  {
    WattPerSquareMeter = 0,          // exitance
    LumenPerSquareMeter = 1,         // luminous exitance
    WattPerSquareMeterSteradian = 2, // radiance
    CandelaPerSquareMeter = 3        // luminance
  };
  ///@{
  /// How strongly the surface emits, in EmissionUnit, and its colour, a plain multiplier in linear
  /// Rec.709. Default 0, W/m^2 and (1, 1, 1). Finite, >= 0.
  vtkSetMacro(Emission, double);
  vtkGetMacro(Emission, double);
  vtkSetMacro(EmissionUnit, int);
  vtkGetMacro(EmissionUnit, int);
  vtkSetVector3Macro(EmissionColor, double);
  vtkGetVector3Macro(EmissionColor, double);
  ///@}

  ///@{
  /// Luminous efficacy [lm/W] of a photometric emission. Default 683.002. Finite, > 0.
  vtkSetMacro(LuminousEfficacy, double);
  vtkGetMacro(LuminousEfficacy, double);
  ///@}

  ///@{
  /// Whether the cells count on both sides. Default off.
  vtkSetMacro(TwoSided, bool);
  vtkGetMacro(TwoSided, bool);
  vtkBooleanMacro(TwoSided, bool);
  ///@}

  ///@{
  /// Number of bands of the arrays. 0 (default): as many as the arrays that are there, else three.
  /// 1: the luminance of the colours above; any number but 1 and 3 needs grey colours.
  vtkSetMacro(Bands, int);
  vtkGetMacro(Bands, int);
  ///@}

  ///@{
  /// Sets the material only on cells where this integer cell array (such as ObjectIndex or
  /// MaterialIndex) is SelectionValue, or where the value's name is SelectionName (looked up in the
  /// field array ObjectNames, MaterialNames). Default none ("" or "None"): all cells.
  vtkSetStringMacro(SelectionArray);
  vtkGetStringMacro(SelectionArray);
  vtkSetMacro(SelectionValue, int);
  vtkGetMacro(SelectionValue, int);
  vtkSetStringMacro(SelectionName);
  vtkGetStringMacro(SelectionName);
  ///@}

  ///@{
  /// Sets the material only on the blocks of composite data of this name. Default none: all.
  vtkSetStringMacro(BlockName);
  vtkGetStringMacro(BlockName);
  ///@}

protected:
  vtkSurfaceMaterialFilter();
  ~vtkSurfaceMaterialFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out) override;

  int Preset = 0;
  double DiffuseReflectance[3] = { 0.5, 0.5, 0.5 };
  double SpecularReflectance[3] = { 0.0, 0.0, 0.0 };
  double Shininess = 10.0;
  double Transmittance[3] = { 0.0, 0.0, 0.0 };
  double DiffuseTransmittance[3] = { 0.0, 0.0, 0.0 };
  double Emission = 0.0;
  int EmissionUnit = WattPerSquareMeter;
  double EmissionColor[3] = { 1.0, 1.0, 1.0 };
  double LuminousEfficacy;
  bool TwoSided = false;
  int Bands = 0;
  char* SelectionArray = nullptr;
  int SelectionValue = 0;
  char* SelectionName = nullptr;
  char* BlockName = nullptr;

private:
  vtkSurfaceMaterialFilter(const vtkSurfaceMaterialFilter&) = delete;
  void operator=(const vtkSurfaceMaterialFilter&) = delete;

  struct Material;
  Material MakeMaterial() const;
  bool Choose(vtkDataSet* surface, std::vector<bool>& chosen) const;
  bool Apply(const Material& material, vtkDataSet* input, vtkDataSet* output) const;
  void CheckFound(bool found) const;
};

#endif
