// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLinearFloatPass
 * @brief   draws light into a float frame buffer, keeps it for reading, shows it among the rest
 *
 *   Does    draws the scene-linear props (those whose mapper is a vtkPhongGouraudMapper with
 *           GetSceneLinear()) into 32-bit float RGBA with a float depth, nothing clamped; then shows
 *           them, together with all other props: colour-mapped surfaces, stock mappers, skyboxes,
 *           axes and texts are drawn by VTK as always, in the display's colours
 *   Place   renderer->SetPass(linear) shows the linear values as they are (clamped by the window);
 *           vtkOpenColorIOPass is this pass with a display transform
 *   Model   of opaque surfaces the nearest is seen, whichever group it belongs to, sample by sample.
 *           Translucent light is blended with the light behind it, linearly and in the right order
 *           (depth peeling in floats); the share a of a pixel
 *           that it covers lies over what else is there as shown a + (1 - a) other, where glare
 *           brighter than a covers as much as it is bright. Other
 *           translucent surfaces and volumes are blended over that, as VTK does: one that lies
 *           behind translucent light is drawn as if it lay before it
 *   Units   whatever was drawn: radiance in W/(m^2 sr) from vtkPhongGouraudMapper
 *   Cost    20 bytes a sample, 8 bytes a pixel more where other opaque props are; with translucent
 *           light 56 bytes a sample more, and it is drawn once a layer; twice all of that where other
 *           opaque props are there
 *   Limits  background: alpha 0 and no light unless KeepBackground; at most 64 translucent layers
 *   Fails   no OpenGL float targets: an error event, GetColor() returns null
 *
 * With a delegate, the delegate draws the light (it is given these props only). During hardware
 * selection nothing of this happens and all props draw their ids.
 */
#ifndef vtkLinearFloatPass_h
#define vtkLinearFloatPass_h

#include "vtkImageProcessingPass.h"
#include "vtkRadiometryRenderingModule.h" // for export macro
#include "vtkSmartPointer.h"              // for ivars

#include <memory> // for ivars
#include <string> // for protected methods

class vtkImageData;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;

class VTKRADIOMETRYRENDERING_EXPORT vtkLinearFloatPass : public vtkImageProcessingPass
{
public:
  static vtkLinearFloatPass* New();
  vtkTypeMacro(vtkLinearFloatPass, vtkImageProcessingPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void Render(const vtkRenderState* s) override;
  void ReleaseGraphicsResources(vtkWindow* w) override;

  /**
   * Draws the light of a renderer's visible props for GetColor() and its like, and shows nothing:
   * the window keeps its picture. The camera must have been rendered with before. The whole view
   * even where the window draws it in tiles, its width and height divided by `reduction`.
   */
  void RenderOffScreen(vtkRenderer* renderer, int reduction = 1);

  ///@{
  /**
   * Off (default): the background gives no light, colour (0, 0, 0) and alpha 0. On: the renderer's
   * own background is drawn, its colours taken as scene-linear, its alpha as the renderer says.
   */
  vtkSetMacro(KeepBackground, bool);
  vtkGetMacro(KeepBackground, bool);
  vtkBooleanMacro(KeepBackground, bool);
  ///@}

  ///@{
  /**
   * Off (default): light is what a vtkPhongGouraudMapper draws with GetSceneLinear(). On: every prop
   * in three dimensions counts as light, whatever its mapper. Overlays (texts, legends, charts)
   * never do.
   */
  vtkSetMacro(AllSceneLinear, bool);
  vtkGetMacro(AllSceneLinear, bool);
  vtkBooleanMacro(AllSceneLinear, bool);
  ///@}

  ///@{
  /**
   * Samples of the light along each side of a pixel; their mean, in linear light, is the pixel.
   * 1 (default) to 8. Costs memory and time with its square. Depth is that of the sample in the
   * middle. What is not light is drawn with one sample a pixel, as without this pass.
   */
  vtkSetClampMacro(Samples, int, 1, 8);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /**
   * What GetDepth() says where nothing was drawn. Default 1e10.
   */
  vtkSetMacro(BackgroundDepth, double);
  vtkGetMacro(BackgroundDepth, double);
  ///@}

  /**
   * The last frame's light: float, four components "RGBA" (colour already multiplied by alpha), the
   * first row at the bottom as everywhere in VTK. Other props are not in it and hide nothing. Null
   * before the first frame and after the window is gone. The image belongs to the pass; the next
   * call overwrites it.
   */
  vtkImageData* GetColor();

  /**
   * The last frame's distance of the light from the camera's plane, along its axis, in the scene's
   * units: float, one component "Z". Good to about 6e-8 Z/near of itself. As GetColor() otherwise.
   */
  vtkImageData* GetDepth();

  ///@{
  /**
   * The same before samples are averaged: Samples x Samples texels a pixel, and the depth as the
   * window has it, 0 at the near and 1 at the far clipping plane. For compositing.
   */
  vtkImageData* GetSampleColor();
  vtkImageData* GetSampleDepth();
  ///@}

  /**
   * After RenderOffScreen() only: as GetSampleDepth(), of translucent surfaces, too. Null where no
   * light is translucent.
   */
  vtkImageData* GetSampleNearest();

  /**
   * GetDepth()'s distance for a depth of GetSampleDepth().
   */
  double DistanceOf(double depth);

  /**
   * The fragment shader that showed the last frame, for tests; empty before the first.
   */
  std::string GetFragmentShaderSource() const;

protected:
  vtkLinearFloatPass();
  ~vtkLinearFloatPass() override;

  ///@{
  /**
   * What light becomes on the display: the text of a GLSL function vec4 radiometryToDisplay(vec4)
   * (here nothing changes), asked for in every frame, and what that function needs while it runs.
   */
  virtual std::string DisplayFunction(vtkOpenGLRenderWindow* window);
  virtual void StartDisplay(vtkShaderProgram* program);
  virtual void FinishDisplay();
  ///@}

  bool KeepBackground = false;
  bool AllSceneLinear = false;
  int Samples = 1;
  double BackgroundDepth = 1e10;

private:
  vtkLinearFloatPass(const vtkLinearFloatPass&) = delete;
  void operator=(const vtkLinearFloatPass&) = delete;

  void RenderSelection(const vtkRenderState* s);
  struct Internals;
  std::unique_ptr<Internals> Parts;
};

#endif
