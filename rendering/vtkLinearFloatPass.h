// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLinearFloatPass
 * @brief   draws a scene into a float frame buffer, keeps it for reading, hands it on
 *
 *   Does    renders its delegate (or, without one, the scene: lights, opaque, translucent, volumes)
 *           into 32-bit float RGBA with a float depth, nothing clamped; then copies colour and
 *           depth, unchanged, into the target around it
 *   Place   renderer->SetPass(linear) shows the linear values as they are (clamped by the window);
 *           a display transform goes around it: transform->SetDelegatePass(linear),
 *           renderer->SetPass(transform). What GetColor() reads is always before the transform.
 *   Units   whatever was drawn: radiance in W/(m^2 sr) from vtkPhongGouraudMapper
 *   Limits  background: alpha 0 and no light unless KeepBackground; translucent polygons are
 *           blended in drawing order; overlays (legends, text) are drawn after the copy and are
 *           not part of what is read
 *   Fails   no OpenGL float targets: an error event, GetColor() returns null
 */
#ifndef vtkLinearFloatPass_h
#define vtkLinearFloatPass_h

#include "vtkImageProcessingPass.h"
#include "vtkRadiometryRenderingModule.h" // for export macro
#include "vtkSmartPointer.h"              // for ivars
#include "vtkWeakPointer.h"               // for ivars

class vtkImageData;
class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkTextureObject;

class VTKRADIOMETRYRENDERING_EXPORT vtkLinearFloatPass : public vtkImageProcessingPass
{
public:
  static vtkLinearFloatPass* New();
  vtkTypeMacro(vtkLinearFloatPass, vtkImageProcessingPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void Render(const vtkRenderState* s) override;
  void ReleaseGraphicsResources(vtkWindow* w) override;

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
   * Samples along each side of a pixel; their mean, in linear light, is the pixel. 1 (default) to
   * 8. Costs memory and time with its square. Depth is that of the sample in the middle.
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
   * The last frame: float, four components "RGBA" (colour already multiplied by alpha), the first
   * row at the bottom as everywhere in VTK. Null before the first frame and after the window is
   * gone. The image belongs to the pass; the next call overwrites it.
   */
  vtkImageData* GetColor();

  /**
   * The last frame's distance from the camera's plane, along its axis, in the scene's units: float,
   * one component "Z". Good to about 6e-8 Z/near of itself. As GetColor() otherwise.
   */
  vtkImageData* GetDepth();

protected:
  vtkLinearFloatPass();
  ~vtkLinearFloatPass() override;

  void Allocate(vtkOpenGLRenderWindow* window, int width, int height);
  void RenderScene(const vtkRenderState* s, int width, int height);
  void Copy(vtkOpenGLRenderWindow* window, int samples);
  bool ReadTexture(vtkTextureObject* texture, int components, vtkImageData* image);
  vtkRenderPass* ScenePass();

  bool KeepBackground = false;
  int Samples = 1;
  double BackgroundDepth = 1e10;

  vtkSmartPointer<vtkRenderPass> DefaultPass;
  vtkSmartPointer<vtkRenderPass> OverlayPass;
  vtkOpenGLFramebufferObject* FrameBufferObject = nullptr;
  vtkOpenGLFramebufferObject* PixelBuffer = nullptr; // of the means, when Samples > 1
  vtkTextureObject* ColorTexture = nullptr;
  vtkTextureObject* DepthTexture = nullptr;
  vtkTextureObject* PixelTexture = nullptr;
  vtkOpenGLQuadHelper* QuadHelper = nullptr;
  vtkOpenGLQuadHelper* MeanHelper = nullptr;
  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  int Size[2] = { 0, 0 };
  int FrameSamples = 1;
  double ClippingRange[2] = { 0.0, 1.0 };
  bool Parallel = false;

  vtkSmartPointer<vtkImageData> Color;
  vtkSmartPointer<vtkImageData> Depth;

private:
  vtkLinearFloatPass(const vtkLinearFloatPass&) = delete;
  void operator=(const vtkLinearFloatPass&) = delete;
};

#endif
