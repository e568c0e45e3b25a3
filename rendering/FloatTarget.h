// SPDX-License-Identifier: BSD-3-Clause
// Private to rendering/: a frame buffer of textures, and full-screen passes.
#ifndef FloatTarget_h
#define FloatTarget_h

#include "vtkSmartPointer.h"

#include <memory>
#include <string>

class vtkImageData;
class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace vtkradiometry
{

/// Colour (four floats or four bytes) and 32-bit depth, of any size.
class Target
{
public:
  /// Ready to draw into; contents are undefined after a change of size.
  void Allocate(vtkOpenGLRenderWindow* window, int width, int height, int vtkType, bool withDepth);
  /// Makes it the current frame buffer with its full viewport; the caller restores.
  void Bind(vtkOpenGLRenderWindow* window);
  /// Zeros and the far plane.
  void Clear(vtkOpenGLRenderWindow* window);
  void Release(vtkWindow* window);

  vtkSmartPointer<vtkTextureObject> Color;
  vtkSmartPointer<vtkTextureObject> Depth;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Buffer;
  int Width = 0;
  int Height = 0;
};

/// A fragment shader over the whole viewport, built again when its text changes.
class FullScreenPass
{
public:
  FullScreenPass();
  ~FullScreenPass();
  /// False where it does not compile.
  bool Ready(vtkOpenGLRenderWindow* window, const std::string& fragmentShader);
  vtkOpenGLQuadHelper* Quad() { return this->Helper.get(); }
  void Release();
  const std::string& Text() const { return this->Source; }

private:
  std::unique_ptr<vtkOpenGLQuadHelper> Helper;
  std::string Source;
};

/// The fragment shader of a full-screen pass out of VTK's template.
std::string FullScreenShader(const char* declarations, const char* implementation);

/// Reads a texture; false where there is nothing to read.
bool ReadTexture(vtkOpenGLRenderWindow* window, vtkTextureObject* texture, int components,
  const char* name, vtkImageData* image);

} // namespace vtkradiometry

#endif
