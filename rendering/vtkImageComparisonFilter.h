// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkImageComparisonFilter
 * @brief Two images side by side with their difference, and the numbers.
 *
 *   Reads   port 0 the reference A, port 1 the image B, of one size: the point array ArrayName, else the
 *           active scalars, "RGB" or "RGBA", of one number of components (alpha is left out)
 *   Writes  output 0: image A | B | difference, float RGB (Gap columns of 0 between), A and B as they
 *           are, the difference times DifferenceGain; output 1: vtkTable, a row a channel and one,
 *           "All", over the values of all channels: Channel, Pixels, MeanA, MeanB, MeanDifference,
 *           MeanAbsolute, MeanRelative, RMSE, RelativeRMSE, Maximum, MaximumX, MaximumY, PSNR [dB],
 *           NonFiniteA, NonFiniteB, Unlike; output 2: the difference alone, <Name>Difference (B - A) and
 *           <Name>RelativeDifference, all channels, at the images' size
 *   Model   radiometry/imaging/PictureDifference.h. Pixels that are not finite in either image are
 *           counted and left out; in the pictures of the difference they are NaN (output 2) or black
 *   Cost    O(pixels)
 *   Fails   images of other sizes or components, an array that is missing: an error event and empty
 *           outputs
 */
#ifndef vtkImageComparisonFilter_h
#define vtkImageComparisonFilter_h

#include "vtkImageAlgorithm.h"
#include "vtkRadiometryRenderingModule.h" // for export macro

#include <string> // for std::string

class vtkTable;
struct PicturePixels;

class VTKRADIOMETRYRENDERING_EXPORT vtkImageComparisonFilter : public vtkImageAlgorithm
{
public:
  static vtkImageComparisonFilter* New();
  vtkTypeMacro(vtkImageComparisonFilter, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The point array to compare. Empty (default): the active scalars, "RGB" or "RGBA".
   */
  vtkSetStdStringFromCharMacro(ArrayName);
  vtkGetCharFromStdStringMacro(ArrayName);
  ///@}

  enum
  {
    ABSOLUTE_DIFFERENCE = 0,
    SIGNED_DIFFERENCE = 1,
    RELATIVE_DIFFERENCE = 2
  };
  ///@{
  /**
   * What the third panel shows: 0 (default) |B - A|; 1 B - A, more than A in red and less in blue; 2
   * |B - A| / max(|A|, RelativeFloor).
   */
  vtkSetClampMacro(DifferenceKind, int, ABSOLUTE_DIFFERENCE, RELATIVE_DIFFERENCE);
  vtkGetMacro(DifferenceKind, int);
  ///@}

  ///@{
  /**
   * Factor on the third panel. Default 1. Finite.
   */
  vtkSetMacro(DifferenceGain, double);
  vtkGetMacro(DifferenceGain, double);
  ///@}

  ///@{
  /**
   * Values of A below this count as this in relative differences. Default 0: 1e-3 of A's mean. At
   * least 0.
   */
  vtkSetMacro(RelativeFloor, double);
  vtkGetMacro(RelativeFloor, double);
  ///@}

  ///@{
  /**
   * The signal of the PSNR. Default 0: A's greatest value, in each channel. At least 0.
   */
  vtkSetMacro(Peak, double);
  vtkGetMacro(Peak, double);
  ///@}

  ///@{
  /**
   * Columns between the panels. Default 4. In [0, 1000].
   */
  vtkSetClampMacro(Gap, int, 0, 1000);
  vtkGetMacro(Gap, int);
  ///@}

protected:
  vtkImageComparisonFilter();
  ~vtkImageComparisonFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkImageComparisonFilter(const vtkImageComparisonFilter&) = delete;
  void operator=(const vtkImageComparisonFilter&) = delete;

  void CheckSettings() const;
  void WriteTable(
    const PicturePixels& a, const PicturePixels& b, double floor, vtkTable* table) const;
  void WritePanels(
    const PicturePixels& a, const PicturePixels& b, double floor, vtkImageData* image) const;
  void WriteDifference(const PicturePixels& a, const PicturePixels& b, double floor,
    vtkImageData* like, vtkImageData* image) const;

  std::string ArrayName;
  int DifferenceKind = ABSOLUTE_DIFFERENCE;
  double DifferenceGain = 1.0;
  double RelativeFloor = 0.0;
  double Peak = 0.0;
  int Gap = 4;
};

#endif
