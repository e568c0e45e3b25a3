// SPDX-License-Identifier: BSD-3-Clause
#include "DisplayPassParts.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"

namespace color = radiometry::color;

namespace displaypass
{

Area AreaOf(const vtkRenderState* s)
{
  Area area;
  if (s->GetFrameBuffer())
  {
    int size[2];
    s->GetWindowSize(size);
    area.Width = size[0];
    area.Height = size[1];
  }
  else
  {
    s->GetRenderer()->GetTiledSizeAndOrigin(&area.Width, &area.Height, &area.X, &area.Y);
  }
  return area;
}

vtkSmartPointer<vtkTextureObject> Upload(
  vtkOpenGLRenderWindow* window, const color::GpuTexture& description)
{
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  texture->SetWrapR(vtkTextureObject::ClampToEdge);
  const int filter = description.Linear ? vtkTextureObject::Linear : vtkTextureObject::Nearest;
  texture->SetMinificationFilter(filter);
  texture->SetMagnificationFilter(filter);
  void* values = const_cast<float*>(description.Values.data());
  const auto width = static_cast<unsigned int>(description.Width);
  const auto height = static_cast<unsigned int>(description.Height);
  const int components = description.Components;
  switch (description.Dimensions)
  {
    case 1:
      texture->Create1DFromRaw(width, components, VTK_FLOAT, values);
      break;
    case 2:
      texture->Create2DFromRaw(width, height, components, VTK_FLOAT, values);
      break;
    default:
      texture->Create3DFromRaw(
        width, height, static_cast<unsigned int>(description.Depth), components, VTK_FLOAT, values);
  }
  return texture;
}

} // namespace displaypass
