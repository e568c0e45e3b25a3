// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenColorIOPass.h"

#include "DisplayPassParts.h"
#include "color/ColorTransform.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenColorIODisplayFS.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderUtilities.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkProp.h"
#include "vtkRenderState.h"
#include "vtkShaderProgram.h"
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"
#include "vtk_glew.h"

#include <cmath>
#include <vector>

namespace color = radiometry::color;
using displaypass::Area;
using displaypass::AreaOf;
using displaypass::WithoutBackground;

namespace
{

/// The name that glsl/vtkOpenColorIODisplayFS.glsl calls the transform by.
const char* const functionName = "radiometryToDisplay";

} // namespace

struct vtkOpenColorIOPass::Internals
{
  vtkSmartPointer<vtkTextureObject> Color;
  vtkSmartPointer<vtkTextureObject> Depth;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Target;
  std::unique_ptr<vtkOpenGLQuadHelper> Quad;
  std::string FragmentShader;

  std::unique_ptr<color::ColorTransform> Transform; // null: the picture is shown as it is
  color::GpuShader Shader;
  std::vector<vtkSmartPointer<vtkTextureObject>> Tables;
  std::string Names; // what the above was built from
  std::string Error;
  std::vector<vtkProp*> Scene;       // of this render, converted
  std::vector<vtkProp*> Annotations; // of this render, drawn in the display's values

  void AllocateTarget(vtkOpenGLRenderWindow* window, int width, int height);
  void RenderDelegate(vtkOpenColorIOPass* self, const vtkRenderState* s, const Area& area);
  void Rebuild(vtkOpenColorIOPass* self, vtkOpenGLRenderWindow* window);
  bool ReadyQuad(vtkOpenGLRenderWindow* window);
  void Draw(vtkOpenColorIOPass* self, vtkOpenGLRenderWindow* window, const Area& area);
  void SortProps(const vtkRenderState* s);
  void DrawAnnotations(vtkOpenColorIOPass* self, vtkRenderer* renderer, const Area& area);
};

vtkStandardNewMacro(vtkOpenColorIOPass);

//------------------------------------------------------------------------------
vtkOpenColorIOPass::vtkOpenColorIOPass()
  : Data(new Internals)
{
}

vtkOpenColorIOPass::~vtkOpenColorIOPass() = default;

//------------------------------------------------------------------------------
void vtkOpenColorIOPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ConfigFileName: " << this->ConfigFileName << "\n"
     << indent << "SourceColorSpace: " << this->SourceColorSpace << "\n"
     << indent << "Display: " << this->Display << "\n"
     << indent << "View: " << this->View << "\n"
     << indent << "Look: " << this->Look << "\n"
     << indent << "Exposure: " << this->Exposure << "\n";
}

//------------------------------------------------------------------------------
std::string vtkOpenColorIOPass::GetErrorMessage() const { return this->Data->Error; }

std::string vtkOpenColorIOPass::GetFragmentShaderSource() const
{
  return this->Data->FragmentShader;
}

//------------------------------------------------------------------------------
void vtkOpenColorIOPass::Internals::AllocateTarget(
  vtkOpenGLRenderWindow* window, int width, int height)
{
  if (!this->Color)
  {
    this->Color = vtkSmartPointer<vtkTextureObject>::New();
    this->Color->SetContext(window);
    this->Color->SetMinificationFilter(vtkTextureObject::Nearest);
    this->Color->SetMagnificationFilter(vtkTextureObject::Nearest);
    this->Color->Allocate2D(
      static_cast<unsigned int>(width), static_cast<unsigned int>(height), 4, VTK_FLOAT);
    this->Depth = vtkSmartPointer<vtkTextureObject>::New();
    this->Depth->SetContext(window);
    // Order-independent translucency copies depth between this target and the window's: the
    // formats must match.
    if (window->GetStencilCapable())
    {
      this->Depth->AllocateDepthStencil(
        static_cast<unsigned int>(width), static_cast<unsigned int>(height));
    }
    else
    {
      this->Depth->AllocateDepth(static_cast<unsigned int>(width),
        static_cast<unsigned int>(height), vtkTextureObject::Fixed24);
    }
    this->Target = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    this->Target->SetContext(window);
  }
  this->Color->Resize(static_cast<unsigned int>(width), static_cast<unsigned int>(height));
  this->Depth->Resize(static_cast<unsigned int>(width), static_cast<unsigned int>(height));
}

//------------------------------------------------------------------------------
void vtkOpenColorIOPass::Internals::RenderDelegate(
  vtkOpenColorIOPass* self, const vtkRenderState* s, const Area& area)
{
  vtkRenderer* renderer = s->GetRenderer();
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  vtkOpenGLState* state = window->GetState();
  this->AllocateTarget(window, area.Width, area.Height);

  vtkRenderState inner(renderer);
  this->SortProps(s);
  inner.SetPropArrayAndCount(this->Scene.data(), static_cast<int>(this->Scene.size()));
  inner.SetRequiredKeys(s->GetRequiredKeys());
  inner.SetFrameBuffer(this->Target);

  const WithoutBackground guard(renderer);
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglScissor scissor(state);
  state->PushFramebufferBindings();
  this->Target->Bind();
  this->Target->AddColorAttachment(0, this->Color);
  this->Target->AddDepthAttachment(this->Depth);
  this->Target->ActivateBuffer(0);
  this->Target->StartNonOrtho(area.Width, area.Height);
  state->vtkglViewport(0, 0, area.Width, area.Height);
  state->vtkglScissor(0, 0, area.Width, area.Height);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglClearColor(0.0, 0.0, 0.0, 0.0);
  state->vtkglClearDepth(1.0);
  state->vtkglClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  state->vtkglEnable(GL_DEPTH_TEST);

  self->DelegatePass->Render(&inner);
  self->NumberOfRenderedProps += self->DelegatePass->GetNumberOfRenderedProps();
  state->PopFramebufferBindings();
}

//------------------------------------------------------------------------------
void vtkOpenColorIOPass::Internals::Rebuild(vtkOpenColorIOPass* self, vtkOpenGLRenderWindow* window)
{
  const std::string names = self->ConfigFileName + '\n' + self->SourceColorSpace + '\n' +
    self->Display + '\n' + self->View + '\n' + self->Look +
    (std::isfinite(self->Exposure) ? "" : "\nexposure");
  const bool same = this->Quad && names == this->Names;
  if (!same)
  {
    this->Quad.reset();
    this->Tables.clear();
    this->Transform.reset();
    this->Shader = {};
    std::string error;
    try
    {
      const color::TransformOptions options{ self->SourceColorSpace, "", self->Display, self->View,
        self->Look, self->Exposure };
      this->Transform = std::make_unique<color::ColorTransform>(
        color::ColorConfig::Open(self->ConfigFileName), options);
      this->Shader = this->Transform->Shader(functionName, "radiometry_ocio_");
      for (const color::GpuTexture& texture : this->Shader.Textures)
      {
        this->Tables.push_back(displaypass::Upload(window, texture));
      }
    }
    catch (const color::ColorError& e)
    {
      this->Transform.reset();
      this->Shader = {};
      this->Tables.clear();
      error = e.what();
    }
    const bool report = !error.empty() && (error != this->Error || names != this->Names);
    this->Error = error;
    this->Names = names;
    if (report)
    {
      vtkErrorWithObjectMacro(self, << error << "; the linear picture is shown as it is.");
    }
  }
  for (color::GpuUniform& uniform : this->Shader.Uniforms)
  {
    uniform.Value = self->Exposure;
  }
}

//------------------------------------------------------------------------------
bool vtkOpenColorIOPass::Internals::ReadyQuad(vtkOpenGLRenderWindow* window)
{
  if (this->Quad)
  {
    window->GetShaderCache()->ReadyShaderProgram(this->Quad->Program);
  }
  else
  {
    std::string source = vtkOpenColorIODisplayFS;
    vtkShaderProgram::Substitute(source, "//VTK::Display::Dec",
      this->Transform ? this->Shader.Text
                      : std::string("vec4 ") + functionName + "(vec4 c) { return c; }\n");
    this->FragmentShader = source;
    this->Quad = std::make_unique<vtkOpenGLQuadHelper>(window,
      vtkOpenGLRenderUtilities::GetFullScreenQuadVertexShader().c_str(), source.c_str(), "");
  }
  return this->Quad->Program && this->Quad->Program->GetCompiled();
}

//------------------------------------------------------------------------------
void vtkOpenColorIOPass::Internals::Draw(
  vtkOpenColorIOPass* self, vtkOpenGLRenderWindow* window, const Area& area)
{
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  const vtkOpenGLState::ScopedglEnableDisable test(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  const vtkOpenGLState::ScopedglDepthFunc depthFunction(state);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglScissor scissor(state);
  if (!this->ReadyQuad(window))
  {
    vtkErrorWithObjectMacro(self, "the shader of the display transform does not compile");
    return;
  }
  vtkShaderProgram* program = this->Quad->Program;
  const auto bind = [&](vtkTextureObject* texture, const std::string& name) {
    texture->Activate();
    program->SetUniformi(name.c_str(), texture->GetTextureUnit());
  };
  bind(this->Color, "linearColor");
  bind(this->Depth, "linearDepth");
  for (std::size_t i = 0; i < this->Tables.size(); ++i)
  {
    bind(this->Tables[i], this->Shader.Textures[i].Sampler);
  }
  for (const color::GpuUniform& uniform : this->Shader.Uniforms)
  {
    program->SetUniformf(uniform.Name.c_str(), static_cast<float>(uniform.Value));
  }
  state->vtkglViewport(area.X, area.Y, area.Width, area.Height);
  state->vtkglScissor(area.X, area.Y, area.Width, area.Height);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_ALWAYS);
  state->vtkglDepthMask(GL_TRUE);
  this->Quad->Render();
  this->Color->Deactivate();
  this->Depth->Deactivate();
  for (const auto& texture : this->Tables)
  {
    texture->Deactivate();
  }
}

//------------------------------------------------------------------------------
void vtkOpenColorIOPass::Internals::SortProps(const vtkRenderState* s)
{
  this->Scene.clear();
  this->Annotations.clear();
  for (int i = 0; i < s->GetPropArrayCount(); ++i)
  {
    vtkProp* prop = s->GetPropArray()[i];
    const bool flat = prop->IsA("vtkActor2D") || prop->IsA("vtkContextActor");
    (flat ? this->Annotations : this->Scene).push_back(prop);
  }
}

//------------------------------------------------------------------------------
void vtkOpenColorIOPass::Internals::DrawAnnotations(
  vtkOpenColorIOPass* self, vtkRenderer* renderer, const Area& area)
{
  if (this->Annotations.empty())
  {
    return;
  }
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglScissor scissor(state);
  state->vtkglViewport(area.X, area.Y, area.Width, area.Height);
  state->vtkglScissor(area.X, area.Y, area.Width, area.Height);
  for (vtkProp* prop : this->Annotations)
  {
    self->NumberOfRenderedProps += prop->RenderOverlay(renderer);
  }
}

//------------------------------------------------------------------------------
void vtkOpenColorIOPass::Render(const vtkRenderState* s)
{
  vtkOpenGLClearErrorMacro();
  this->NumberOfRenderedProps = 0;
  auto* renderer = vtkOpenGLRenderer::SafeDownCast(s->GetRenderer());
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!this->DelegatePass)
  {
    vtkWarningMacro("no delegate to render the scene");
    return;
  }
  if (renderer->GetSelector())
  {
    this->DelegatePass->Render(s);
    this->NumberOfRenderedProps = this->DelegatePass->GetNumberOfRenderedProps();
    return;
  }
  const Area area = AreaOf(s);
  this->Data->RenderDelegate(this, s, area);

  // Under a camera pass the frame buffer is clear already; as the outermost pass nobody did it.
  vtkOpenGLState* state = window->GetState();
  if ((renderer->GetPass() == this || s->GetFrameBuffer()) && renderer->GetErase() &&
    window->GetErase())
  {
    const vtkOpenGLState::ScopedglViewport viewport(state);
    const vtkOpenGLState::ScopedglScissor scissor(state);
    const vtkOpenGLState::ScopedglEnableDisable scissorTest(state, GL_SCISSOR_TEST);
    state->vtkglViewport(area.X, area.Y, area.Width, area.Height);
    state->vtkglEnable(GL_SCISSOR_TEST);
    state->vtkglScissor(area.X, area.Y, area.Width, area.Height);
    renderer->Clear();
  }
  this->Data->Rebuild(this, window);
  this->Data->Draw(this, window, area);
  this->Data->DrawAnnotations(this, renderer, area);
  vtkOpenGLCheckErrorMacro("failed after the display transform");
}

//------------------------------------------------------------------------------
void vtkOpenColorIOPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->Data->Quad.reset();
  for (const auto& texture : { this->Data->Color, this->Data->Depth })
  {
    if (texture)
    {
      texture->ReleaseGraphicsResources(window);
    }
  }
  for (const auto& texture : this->Data->Tables)
  {
    texture->ReleaseGraphicsResources(window);
  }
  if (this->Data->Target)
  {
    this->Data->Target->ReleaseGraphicsResources(window);
  }
  this->Data->Color = nullptr;
  this->Data->Depth = nullptr;
  this->Data->Target = nullptr;
  this->Data->Tables.clear();
  this->Data->Names.clear();
}
