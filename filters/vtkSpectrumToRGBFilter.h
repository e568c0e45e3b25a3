// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkSpectrumToRGBFilter_h
#define vtkSpectrumToRGBFilter_h

#include "vtkPassInputTypeAlgorithm.h"
#include "vtkRadiometryFiltersModule.h"

#include <string> // for ArrayNames
#include <vector> // for ArrayNames

class vtkDataArray;
class vtkDataSet;
class vtkDataSetAttributes;

/// Colours of spectral arrays, through the CIE 1931 standard observer.
///   Reads   any dataset or image, or composite data of them: point and cell arrays of N bands, and the
///           field data Wavelengths [nm], N values, of the dataset, of the composite data around it, or
///           of this filter's own list
///   Writes  <Name>RGB, linear Rec.709, 3 components, beside each array, in its unit; with Photometric
///           also Illuminance, LuminousExitance, Luminance ... (others: <Name>Photometric)
///   Model   X, Y, Z = sum_b S_b w_b, w_b the mean of x-bar, y-bar, z-bar over the band (BandValues);
///           edges half-way between the wavelengths; photometric value 683.002 lm/W Y
///           (radiometry/imaging/ColorMatching.h)
///   Cost    O(tuples x N)
///   Source  CIE 015:2018; ITU-R BT.709-6
///   Fails   no wavelengths, wavelengths that are no nanometres, an array with another number of
///           components, a value that is not finite: an error that names it, an empty output
class VTKRADIOMETRYFILTERS_EXPORT vtkSpectrumToRGBFilter : public vtkPassInputTypeAlgorithm
{
public:
  static vtkSpectrumToRGBFilter* New();
  vtkTypeMacro(vtkSpectrumToRGBFilter, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The arrays to convert, of points or cells. Default none: then all that have one component for
  /// each wavelength, but for those whose names end with "Error".
  void AddArrayName(const char* name);
  void ClearArrayNames();
  int GetNumberOfArrayNames() const { return static_cast<int>(this->ArrayNames.size()); }
  /// That one array only.
  void SetArrayName(const char* name);
  ///@}

  ///@{
  /// Centres of the bands [nm], for data without the field array Wavelengths; where they are given
  /// they go before it. Default none. In [10, 1e6], all different.
  void AddWavelength(double nanometres);
  void ClearWavelengths();
  int GetNumberOfWavelengths() const { return static_cast<int>(this->Wavelengths.size()); }
  ///@}

  enum
  {
    AUTOMATIC = 0,
    POWER_IN_BAND = 1,
    PER_NANOMETRE = 2,
    LINES = 3,
    REFLECTANCE = 4
  };
  ///@{
  /// What the values are. AUTOMATIC (default): arrays whose names end with Reflectance, Transmittance or
  /// Ambient are REFLECTANCE, all others POWER_IN_BAND. PER_NANOMETRE: a density. LINES: all of a
  /// band's power lies at its wavelength. REFLECTANCE: a share of the light of Illuminant.
  vtkSetClampMacro(BandValues, int, AUTOMATIC, REFLECTANCE);
  vtkGetMacro(BandValues, int);
  ///@}

  ///@{
  /// The light that reflectances are seen in: 0 (default) D65, in which a perfect white is
  /// R = G = B = 1; 1 equal energy.
  vtkSetClampMacro(Illuminant, int, 0, 1);
  vtkGetMacro(Illuminant, int);
  ///@}

  ///@{
  /// Colours outside Rec.709, which have a negative channel: 0 (default) kept, 1 clipped (negative
  /// channels become 0), 2 desaturated (mixed with the grey of the same luminance).
  vtkSetClampMacro(Gamut, int, 0, 2);
  vtkGetMacro(Gamut, int);
  ///@}

  ///@{
  /// Whether photometric arrays are added, except of reflectances. Default off.
  vtkSetMacro(Photometric, bool);
  vtkGetMacro(Photometric, bool);
  vtkBooleanMacro(Photometric, bool);
  ///@}

protected:
  vtkSpectrumToRGBFilter() = default;
  ~vtkSpectrumToRGBFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out) override;

private:
  vtkSpectrumToRGBFilter(const vtkSpectrumToRGBFilter&) = delete;
  void operator=(const vtkSpectrumToRGBFilter&) = delete;

  void Convert(vtkDataObject* input, vtkDataObject* output, std::vector<std::string>& done) const;
  void ConvertSet(vtkDataSet* data, vtkDataObject* around, std::vector<std::string>& done) const;
  std::vector<double> WavelengthsOf(vtkDataObject* data, vtkDataObject* around) const;
  bool IsWanted(vtkDataArray* array, int bands) const;
  void AddColors(vtkDataArray* array, const std::vector<double>& wavelengths,
    vtkDataSetAttributes* attributes) const;

  std::vector<std::string> ArrayNames;
  std::vector<double> Wavelengths;
  int BandValues = AUTOMATIC;
  int Illuminant = 0;
  int Gamut = 0;
  bool Photometric = false;
};

#endif
