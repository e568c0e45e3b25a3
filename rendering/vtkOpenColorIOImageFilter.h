// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOpenColorIOImageFilter
 * @brief Converts the colours of an image through OpenColorIO on the CPU.
 *
 *   Reads   a point array of 3 or 4 components: the one selected by SetInputArrayToProcess, else
 *           the active scalars, else the arrays "RGB" or "RGBA". Integers of 8 and 16 bits
 *           count as 0 to 1, other types as they are.
 *   Writes  the image with that array converted, as the active scalars: float, or unsigned char
 *           rounded and clamped to 0 to 255 for a PNG. The other arrays pass through.
 *   Model   colour: f(C). With alpha: f(P / a) a, alpha kept, pixels of alpha 0 untouched: the
 *           same as vtkOpenColorIOPass
 *   Cost    10 to 100 ns a pixel, on all threads; the result does not depend on their number
 *   Fails   a missing or broken config, an unknown name, no array of colours: an error event, and
 *           the output is the input, unchanged
 */
#ifndef vtkOpenColorIOImageFilter_h
#define vtkOpenColorIOImageFilter_h

#include "vtkImageAlgorithm.h"
#include "vtkRadiometryRenderingModule.h" // for export macro

#include <string> // for std::string

class VTKRADIOMETRYRENDERING_EXPORT vtkOpenColorIOImageFilter : public vtkImageAlgorithm
{
public:
  static vtkOpenColorIOImageFilter* New();
  vtkTypeMacro(vtkOpenColorIOImageFilter, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The OpenColorIO config file. Empty (default): the one that $OCIO names, else the project's own;
   * "builtin": the project's own in any case.
   */
  vtkSetStdStringFromCharMacro(ConfigFileName);
  vtkGetCharFromStdStringMacro(ConfigFileName);
  ///@}

  ///@{
  /**
   * The colour space of the input, by name, alias or role of the config. Empty (default):
   * scene-linear Rec.709.
   */
  vtkSetStdStringFromCharMacro(SourceColorSpace);
  vtkGetCharFromStdStringMacro(SourceColorSpace);
  ///@}

  ///@{
  /**
   * When set, the output is in this colour space and Display and View do not matter. Empty
   * (default): the output is for a display.
   */
  vtkSetStdStringFromCharMacro(TargetColorSpace);
  vtkGetCharFromStdStringMacro(TargetColorSpace);
  ///@}

  ///@{
  /**
   * The display. Empty (default): the config's default.
   */
  vtkSetStdStringFromCharMacro(Display);
  vtkGetCharFromStdStringMacro(Display);
  ///@}

  ///@{
  /**
   * The view of that display. Empty (default): its default.
   */
  vtkSetStdStringFromCharMacro(View);
  vtkGetCharFromStdStringMacro(View);
  ///@}

  ///@{
  /**
   * A look, or several with commas, applied before the view. Empty (default): none.
   */
  vtkSetStdStringFromCharMacro(Look);
  vtkGetCharFromStdStringMacro(Look);
  ///@}

  ///@{
  /**
   * Exposure in stops: linear values are multiplied by 2^Exposure. Default 0; any finite number.
   */
  vtkSetMacro(Exposure, double);
  vtkGetMacro(Exposure, double);
  ///@}

  ///@{
  /**
   * The type of the converted array: VTK_FLOAT (default) or VTK_UNSIGNED_CHAR.
   */
  vtkSetMacro(OutputScalarType, int);
  vtkGetMacro(OutputScalarType, int);
  void SetOutputScalarTypeToFloat() { this->SetOutputScalarType(VTK_FLOAT); }
  void SetOutputScalarTypeToUnsignedChar() { this->SetOutputScalarType(VTK_UNSIGNED_CHAR); }
  ///@}

  ///@{
  /**
   * Threads to use. Default 0: all. Negative numbers count as 0.
   */
  vtkSetMacro(NumberOfThreads, int);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * What the last update used: where the config came from (a file name or "builtin") and the names
   * that empty properties came to. Empty before the first and after a failure.
   */
  std::string GetUsedConfig() const { return this->UsedConfig; }
  std::string GetUsedSourceColorSpace() const { return this->UsedSourceColorSpace; }
  std::string GetUsedDisplay() const { return this->UsedDisplay; }
  std::string GetUsedView() const { return this->UsedView; }
  ///@}

  ///@{
  /**
   * What the config of ConfigFileName has, with commas between; empty (and an error event) where it
   * cannot be read.
   */
  std::string GetConfigDisplays();
  std::string GetConfigViews(const char* display);
  std::string GetConfigColorSpaces();
  std::string GetConfigLooks();
  ///@}

protected:
  vtkOpenColorIOImageFilter();
  ~vtkOpenColorIOImageFilter() override;

  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkOpenColorIOImageFilter(const vtkOpenColorIOImageFilter&) = delete;
  void operator=(const vtkOpenColorIOImageFilter&) = delete;

  std::string ConfigFileName;
  std::string SourceColorSpace;
  std::string TargetColorSpace;
  std::string Display;
  std::string View;
  std::string Look;
  double Exposure = 0.0;
  int OutputScalarType = VTK_FLOAT;
  int NumberOfThreads = 0;

  std::string UsedConfig;
  std::string UsedSourceColorSpace;
  std::string UsedDisplay;
  std::string UsedView;
};

#endif
