// SPDX-License-Identifier: BSD-3-Clause
// Private to rendering/: where to draw, and tables of colours.
#ifndef DisplayPassParts_h
#define DisplayPassParts_h

#include "color/GpuShader.h"

#include "vtkSmartPointer.h"

class vtkOpenGLRenderWindow;
class vtkRenderState;
class vtkTextureObject;

namespace displaypass
{

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
