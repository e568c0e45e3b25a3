// SPDX-License-Identifier: BSD-3-Clause
// Private to rendering/: the parts of vtkOpenColorIOPass that know no colour.
#ifndef DisplayPassParts_h
#define DisplayPassParts_h

#include "color/GpuShader.h"

#include "vtkSmartPointer.h"

class vtkOpenGLRenderWindow;
class vtkRenderer;
class vtkRenderState;
class vtkTextureObject;

namespace displaypass
{

/// The renderer clears to nothing while the delegate draws, so that the background is neither
/// converted nor mixed into what lies translucent over it.
class WithoutBackground
{
public:
  explicit WithoutBackground(vtkRenderer* renderer);
  ~WithoutBackground();
  WithoutBackground(const WithoutBackground&) = delete;
  void operator=(const WithoutBackground&) = delete;

private:
  void Set(bool gradient, bool textured, double alpha, double r, double g, double b);

  vtkRenderer* Renderer;
  bool Gradient;
  bool Textured;
  double Alpha;
  double Color[3];
};

/// The rectangle of the current frame buffer that belongs to the renderer.
struct Area
{
  int X = 0;
  int Y = 0;
  int Width = 0;
  int Height = 0;
};
Area AreaOf(const vtkRenderState* s);

/// A look-up table as a texture of the window.
vtkSmartPointer<vtkTextureObject> Upload(
  vtkOpenGLRenderWindow* window, const radiometry::color::GpuTexture& description);

} // namespace displaypass

#endif
