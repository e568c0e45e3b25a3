// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOpenColorIOPass
 * @brief Shows a scene-linear picture on a display, through OpenColorIO on the GPU.
 *
 * The delegate renders into a 32-bit float target of this pass, unclamped; then one full-screen
 * pass converts it and lays it over what the frame buffer holds.
 *
 *   Model   shown = f(P / a) a + (1 - a) background, P the premultiplied linear colour, a its alpha
 *           and f the transform of color/ColorTransform.h; the depth is handed on
 *   Cost    one float RGBA and one depth texture of the window's size, one full-screen pass; the
 *           shader is built anew when a name changes, not when the exposure does
 *   Agrees  with vtkOpenColorIOImageFilter to 5e-6, to 1e-4 where the curve is a power law
 *   Fails   a missing or broken config, an unknown name: one error event for each change, and the
 *           linear picture is shown as it is
 *
 * Pixels that nothing was drawn on (alpha 0) keep the renderer's background exactly: flat, gradient
 * or textured, it is in the display's values already. So are texts, legends and charts
 * (vtkActor2D, vtkContextActor): they are drawn over the converted picture. Any pass can be the delegate: one with a
 * camera pass of its own (vtkRenderStepsPass, vtkLinearFloatPass) where this is the renderer's
 * pass, or one without (vtkPVDefaultPass) under a camera pass. During hardware selection the
 * delegate renders directly. Not to be stacked on vtkToneMappingPass.
 */
#ifndef vtkOpenColorIOPass_h
#define vtkOpenColorIOPass_h

#include "vtkImageProcessingPass.h"
#include "vtkRadiometryRenderingModule.h" // for export macro

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class VTKRADIOMETRYRENDERING_EXPORT vtkOpenColorIOPass : public vtkImageProcessingPass
{
public:
  static vtkOpenColorIOPass* New();
  vtkTypeMacro(vtkOpenColorIOPass, vtkImageProcessingPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void Render(const vtkRenderState* s) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

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
   * The colour space that the scene is rendered in, by name, alias or role of the config. Empty
   * (default): scene-linear Rec.709.
   */
  vtkSetStdStringFromCharMacro(SourceColorSpace);
  vtkGetCharFromStdStringMacro(SourceColorSpace);
  ///@}

  ///@{
  /**
   * The display. Empty (default): the config's default. The project's own config has "sRGB",
   * "Rec.1886" and "Display P3".
   */
  vtkSetStdStringFromCharMacro(Display);
  vtkGetCharFromStdStringMacro(Display);
  ///@}

  ///@{
  /**
   * The view of that display. Empty (default): its default. The project's own config has "Plain"
   * (not tone-mapped), "ACES" and "Raw".
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
   * Exposure in stops: linear values are multiplied by 2^Exposure before look and view. Default 0;
   * any finite number. A view of raw data ignores it.
   */
  vtkSetMacro(Exposure, double);
  vtkGetMacro(Exposure, double);
  ///@}

  /**
   * What is wrong with the config or the names; empty when all is well. Known after a render.
   */
  std::string GetErrorMessage() const;

  /**
   * The fragment shader of the last render, for tests; empty before the first.
   */
  std::string GetFragmentShaderSource() const;

protected:
  vtkOpenColorIOPass();
  ~vtkOpenColorIOPass() override;

private:
  vtkOpenColorIOPass(const vtkOpenColorIOPass&) = delete;
  void operator=(const vtkOpenColorIOPass&) = delete;

  std::string ConfigFileName;
  std::string SourceColorSpace;
  std::string Display;
  std::string View;
  std::string Look;
  double Exposure = 0.0;

  struct Internals;
  std::unique_ptr<Internals> Data;
};

#endif
