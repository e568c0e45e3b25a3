// SPDX-License-Identifier: BSD-3-Clause
#include "FloatTarget.h"

#include "ShaderTemplate.h"

#include "vtk_glew.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderUtilities.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkPixelBufferObject.h"
#include "vtkPointData.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

namespace vtkradiometry
{
namespace
{

vtkSmartPointer<vtkTextureObject> MakeTexture(vtkOpenGLRenderWindow* window)
{
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->SetMinificationFilter(vtkTextureObject::Nearest);
  texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  return texture;
}

} // namespace

void Target::Allocate(
  vtkOpenGLRenderWindow* window, int width, int height, int vtkType, bool withDepth)
{
  const auto w = static_cast<unsigned int>(width);
  const auto h = static_cast<unsigned int>(height);
  if (!this->Color)
  {
    this->Color = MakeTexture(window);
    this->Buffer = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    this->Buffer->SetContext(window);
  }
  if (!this->Color->GetHandle() || this->Width != width || this->Height != height)
  {
    this->Color->Allocate2D(w, h, 4, vtkType);
  }
  if (withDepth && !this->Depth)
  {
    this->Depth = MakeTexture(window);
  }
  if (withDepth && (!this->Depth->GetHandle() || this->Width != width || this->Height != height))
  {
    this->Depth->AllocateDepth(w, h, vtkTextureObject::Float32);
  }
  this->Width = width;
  this->Height = height;
}

void Target::Bind(vtkOpenGLRenderWindow* window)
{
  vtkOpenGLState* state = window->GetState();
  this->Buffer->Bind();
  this->Buffer->AddColorAttachment(0, this->Color);
  this->Buffer->ActivateBuffer(0);
  if (this->Depth)
  {
    this->Buffer->AddDepthAttachment(this->Depth);
  }
  this->Buffer->StartNonOrtho(this->Width, this->Height);
  state->vtkglViewport(0, 0, this->Width, this->Height);
  state->vtkglScissor(0, 0, this->Width, this->Height);
}

void Target::Clear(vtkOpenGLRenderWindow* window)
{
  vtkOpenGLState* state = window->GetState();
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  state->vtkglClearDepth(1.0);
  state->vtkglClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_LEQUAL);
}

void Target::Release(vtkWindow* window)
{
  for (const auto& texture : { this->Color, this->Depth })
  {
    if (texture)
    {
      texture->ReleaseGraphicsResources(window);
    }
  }
  if (this->Buffer)
  {
    this->Buffer->ReleaseGraphicsResources(window);
  }
  *this = Target();
}

FullScreenPass::FullScreenPass() = default;

FullScreenPass::~FullScreenPass() = default;

void FullScreenPass::Release() { this->Helper.reset(); }

bool FullScreenPass::Ready(vtkOpenGLRenderWindow* window, const std::string& fragmentShader)
{
  if (this->Helper && this->Source == fragmentShader)
  {
    window->GetShaderCache()->ReadyShaderProgram(this->Helper->Program);
  }
  else
  {
    this->Source = fragmentShader;
    this->Helper = std::make_unique<vtkOpenGLQuadHelper>(window,
      vtkOpenGLRenderUtilities::GetFullScreenQuadVertexShader().c_str(), fragmentShader.c_str(),
      "");
  }
  return this->Helper->Program && this->Helper->Program->GetCompiled();
}

std::string FullScreenShader(const char* declarations, const char* implementation)
{
  std::string source = vtkOpenGLRenderUtilities::GetFullScreenQuadFragmentShaderTemplate();
  vtkShaderProgram::Substitute(source, "//VTK::FSQ::Decl", declarations);
  vtkShaderProgram::Substitute(source, "//VTK::FSQ::Impl", ExpandShader(implementation, {}));
  return source;
}

bool ReadTexture(vtkOpenGLRenderWindow* window, vtkTextureObject* texture, int components,
  const char* name, vtkImageData* image)
{
  if (!window || !texture || !texture->GetHandle())
  {
    return false;
  }
  window->MakeCurrent();
  auto buffer = vtkSmartPointer<vtkPixelBufferObject>::Take(texture->Download());
  if (!buffer)
  {
    return false;
  }
  unsigned int size[2] = { texture->GetWidth(), texture->GetHeight() };
  vtkIdType increments[2] = { 0, 0 };
  image->SetDimensions(static_cast<int>(size[0]), static_cast<int>(size[1]), 1);
  image->AllocateScalars(VTK_FLOAT, components);
  image->GetPointData()->GetScalars()->SetName(name);
  return buffer->Download2D(VTK_FLOAT, image->GetScalarPointer(), size, components, increments);
}

} // namespace vtkradiometry
