// SPDX-License-Identifier: BSD-3-Clause
#ifndef BandColors_h
#define BandColors_h

#include "radiometry/imaging/ColorMatching.h"

#include "vtkType.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

class vtkDataArray;
class vtkFieldData;

namespace vtkradiometry
{

/// The colour of arrays of N bands: three are linear Rec.709, one is grey, others go through the CIE
/// 1931 observer where the field data Wavelengths stands for as many, else they are the grey of
/// their mean.
class BandColors
{
public:
  /// `field`: of the data that the arrays belong to. Wavelengths that say nothing are named in
  /// GetProblem(), once an array has as many bands.
  BandColors(vtkFieldData* field, radiometry::imaging::BandValues values);

  std::array<double, 3> Of(vtkDataArray* array, vtkIdType tuple) const;
  /// Whether the observer makes the colours of an array.
  bool IsSpectral(vtkDataArray* array) const;
  const std::string& GetProblem() const { return this->Problem; }

private:
  std::shared_ptr<const radiometry::imaging::SpectralColor> Spectrum;
  std::string Problem;
};

} // namespace vtkradiometry

#endif
// VTK-HeaderTest-Exclude: BandColors.h
