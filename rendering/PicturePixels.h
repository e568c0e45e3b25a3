// SPDX-License-Identifier: BSD-3-Clause
// Private to rendering/: the pixels of an image as the functions of radiometry/imaging take them.
#ifndef PicturePixels_h
#define PicturePixels_h

#include <string>
#include <vector>

class vtkDataArray;
class vtkImageData;

/// One array of an image. Integers of 8 and 16 bits count as 0 to 1, other types as they are.
struct PicturePixels
{
  std::string Name;
  std::string Unit; ///< vtkDataArray::UNITS_LABEL, or empty
  int Width = 0;
  int Height = 0;
  int Components = 0;
  std::vector<double> Values; ///< row by row from the bottom

  std::size_t Count() const { return static_cast<std::size_t>(this->Width) * this->Height; }
  bool IsColor() const { return this->Components >= 3; }
};

/// The point array named `name`; with an empty name `chosen`, else the active scalars, else "RGB" or
/// "RGBA", else the first.
/// Fails: InputError for an image that is not flat, an array that is missing, or more than
/// `mostComponents`.
vtkDataArray* FindPicture(vtkImageData* image, const std::string& name, vtkDataArray* chosen);
PicturePixels ReadPicture(
  vtkImageData* image, const std::string& name, vtkDataArray* chosen, int mostComponents);

/// cd/m^2 (or lx, lm/m^2) for a 1 in that unit: 1 for photometric units, else 683.002.
double LuminancePerUnit(const std::string& unit);

#endif
