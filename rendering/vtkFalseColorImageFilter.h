// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkFalseColorImageFilter
 * @brief Draws an image's luminance, or any of its arrays, in the colours of a legend.
 *
 *   Reads   the point array ArrayName, else the active scalars, "RGB" or "RGBA". Of 3 or 4 components
 *           (linear Rec.709) the luminance is drawn, 683.002 lm/W (0.2126 R + 0.7152 G + 0.0722 B)
 *           [cd/m^2], where the array's unit (vtkDataArray::UNITS_LABEL) is not photometric already;
 *           of one component the value itself, in its unit
 *   Writes  the point array "FalseColor", unsigned char RGB, for the display as it is; with the legend
 *           the image is LegendWidth columns wider on the right and has that array alone, without it
 *           the input's arrays pass. Field data: LegendLimits [LegendUnit], one more than LegendColors
 *           (unsigned char RGB); LegendTitle, LegendUnit; IsoLineLevels; NonFinitePixels;
 *           output 1: the legend as a vtkTable: Lower, Upper, Red, Green, Blue
 *   Model   radiometry/imaging/FalseColor.h. Pixels that are not finite are NonFiniteColor; values
 *           beyond the scale have the colour of its end; pixels of alpha 0, where nothing was drawn,
 *           are light grey
 *   Cost    O(pixels log levels)
 *   Fails   a setting out of range, a missing array, an image that is not flat: an error event and
 *           empty outputs
 */
#ifndef vtkFalseColorImageFilter_h
#define vtkFalseColorImageFilter_h

#include "vtkImageAlgorithm.h"
#include "vtkRadiometryRenderingModule.h" // for export macro

#include <string> // for std::string
#include <vector> // for Levels

class vtkTable;

class VTKRADIOMETRYRENDERING_EXPORT vtkFalseColorImageFilter : public vtkImageAlgorithm
{
public:
  static vtkFalseColorImageFilter* New();
  vtkTypeMacro(vtkFalseColorImageFilter, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The point array to draw. Empty (default): the active scalars, "RGB" or "RGBA".
   */
  vtkSetStdStringFromCharMacro(ArrayName);
  vtkGetCharFromStdStringMacro(ArrayName);
  ///@}

  ///@{
  /**
   * Whether the scale is logarithmic. Default on.
   */
  vtkSetMacro(LogScale, bool);
  vtkGetMacro(LogScale, bool);
  vtkBooleanMacro(LogScale, bool);
  ///@}

  ///@{
  /**
   * The ends of the scale, in the legend's unit. Default (0, 0): those of the picture, rounded outward,
   * of at most five decades on a logarithmic scale.
   */
  vtkSetVector2Macro(ScalarRange, double);
  vtkGetVector2Macro(ScalarRange, double);
  ///@}

  ///@{
  /**
   * Contour bands of equal width on the scale. Default 0: continuous. In [0, 1000].
   */
  vtkSetMacro(Steps, int);
  vtkGetMacro(Steps, int);
  ///@}

  ///@{
  /**
   * Limits of the contour bands, ascending, in the legend's unit; two or more go before Steps and
   * ScalarRange. Default none.
   */
  void AddLevel(double level);
  void ClearLevels();
  int GetNumberOfLevels() const { return static_cast<int>(this->Levels.size()); }
  ///@}

  ///@{
  /**
   * Whether lines of equal value are drawn: at the bands' limits, or at round values of a continuous
   * scale. Default off.
   */
  vtkSetMacro(IsoLines, bool);
  vtkGetMacro(IsoLines, bool);
  vtkBooleanMacro(IsoLines, bool);
  ///@}

  ///@{
  /**
   * 0 (default) Viridis, 1 Inferno, 2 Spectrum (blue to red), 3 Grey.
   */
  vtkSetClampMacro(Palette, int, 0, 3);
  vtkGetMacro(Palette, int);
  ///@}

  ///@{
  /**
   * Colour of pixels that are a NaN or an infinity, display values in [0, 1]. Default magenta.
   */
  vtkSetVector3Macro(NonFiniteColor, double);
  vtkGetVector3Macro(NonFiniteColor, double);
  ///@}

  ///@{
  /**
   * Whether a legend is drawn on the right. Default on.
   */
  vtkSetMacro(Legend, bool);
  vtkGetMacro(Legend, bool);
  vtkBooleanMacro(Legend, bool);
  ///@}

  ///@{
  /**
   * Title of the legend. Empty (default): the quantity and its unit.
   */
  vtkSetStdStringFromCharMacro(Title);
  vtkGetCharFromStdStringMacro(Title);
  ///@}

  ///@{
  /**
   * Luminance of a pixel value of 1 [cd/m^2], for images of 3 or 4 components. Default 0: by the
   * array's unit, 1 for cd/m^2, lx and lm/m^2, else 683.002.
   */
  vtkSetMacro(LuminancePerUnit, double);
  vtkGetMacro(LuminancePerUnit, double);
  ///@}

protected:
  vtkFalseColorImageFilter();
  ~vtkFalseColorImageFilter() override = default;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkFalseColorImageFilter(const vtkFalseColorImageFilter&) = delete;
  void operator=(const vtkFalseColorImageFilter&) = delete;

  std::string ArrayName;
  bool LogScale = true;
  double ScalarRange[2] = { 0.0, 0.0 };
  int Steps = 0;
  std::vector<double> Levels;
  bool IsoLines = false;
  int Palette = 0;
  double NonFiniteColor[3] = { 1.0, 0.0, 1.0 };
  bool Legend = true;
  std::string Title;
  double LuminancePerUnit = 0.0;

  struct Drawing;
  void Draw(vtkImageData* input, vtkImageData* output, vtkTable* table) const;
  void Describe(const Drawing& drawing, vtkImageData* output, vtkTable* table) const;
};

#endif
