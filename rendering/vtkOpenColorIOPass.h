// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOpenColorIOPass
 * @brief Shows scene-linear light on a display, through OpenColorIO on the GPU.
 *
 * A vtkLinearFloatPass (which see: what counts as light, samples, reading the light back) whose
 * light is converted in the one full-screen pass that lays it over what the frame buffer holds.
 * Everything else is drawn in its own colours: colour-mapped and stock surfaces, backgrounds of
 * every kind, texts, legends, charts.
 *
 *   Model   shown = f(P / a) a + (1 - a) other, P the premultiplied linear colour, a its alpha
 *           and f the transform of color/ColorTransform.h; the depth is handed on
 *   Cost    one float RGBA and one depth texture of the window's size, one full-screen pass; the
 *           shader is built anew when a name changes, not when the exposure does
 *   Agrees  with vtkOpenColorIOImageFilter to 5e-6, to 1e-4 where the curve is a power law
 *   Fails   a missing or broken config, an unknown name: one error event for each change, and the
 *           linear picture is shown as it is
 *
 * Any pass can be the delegate that draws the light: one with a camera pass of its own
 * (vtkRenderStepsPass, vtkLinearFloatPass) where this is the renderer's pass, or one without under a
 * camera pass. Without a delegate this pass draws it itself. Not to be stacked on vtkToneMappingPass.
 */
#ifndef vtkOpenColorIOPass_h
#define vtkOpenColorIOPass_h

#include "vtkLinearFloatPass.h"
#include "vtkRadiometryRenderingModule.h" // for export macro

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class VTKRADIOMETRYRENDERING_EXPORT vtkOpenColorIOPass : public vtkLinearFloatPass
{
public:
  static vtkOpenColorIOPass* New();
  vtkTypeMacro(vtkOpenColorIOPass, vtkLinearFloatPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

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

protected:
  vtkOpenColorIOPass();
  ~vtkOpenColorIOPass() override;

  std::string DisplayFunction(vtkOpenGLRenderWindow* window) override;
  void StartDisplay(vtkShaderProgram* program) override;
  void FinishDisplay() override;

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
