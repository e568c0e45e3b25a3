// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLinearFloatPass.h"

#include "ShaderTemplate.h"
#include "vtkLinearFloatCopyFS.h"
#include "vtkLinearFloatMeanFS.h"

#include "vtk_glew.h"

#include "vtkCamera.h"
#include "vtkCameraPass.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLightsPass.h"
#include "vtkObjectFactory.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderUtilities.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkOverlayPass.h"
#include "vtkPixelBufferObject.h"
#include "vtkPointData.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkSequencePass.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtkTranslucentPass.h"
#include "vtkVolumetricPass.h"

#include <vector>

vtkStandardNewMacro(vtkLinearFloatPass);

namespace
{

/// The renderer's background while a picture is drawn without one.
class BackgroundSwitch
{
public:
  explicit BackgroundSwitch(vtkRenderer* renderer)
    : Renderer(renderer)
    , Alpha(renderer->GetBackgroundAlpha())
    , Gradient(renderer->GetGradientBackground())
    , Textured(renderer->GetTexturedBackground())
  {
    renderer->GetBackground(this->Color);
    renderer->SetBackground(0.0, 0.0, 0.0);
    renderer->SetBackgroundAlpha(0.0);
    renderer->SetGradientBackground(false);
    renderer->SetTexturedBackground(false);
  }
  ~BackgroundSwitch()
  {
    this->Renderer->SetBackground(this->Color);
    this->Renderer->SetBackgroundAlpha(this->Alpha);
    this->Renderer->SetGradientBackground(this->Gradient);
    this->Renderer->SetTexturedBackground(this->Textured);
  }
  BackgroundSwitch(const BackgroundSwitch&) = delete;
  void operator=(const BackgroundSwitch&) = delete;

private:
  vtkRenderer* Renderer;
  double Color[3];
  double Alpha;
  bool Gradient;
  bool Textured;
};

vtkOpenGLQuadHelper* MakeQuad(
  vtkOpenGLRenderWindow* window, const char* declarations, const char* implementation)
{
  std::string source = vtkOpenGLRenderUtilities::GetFullScreenQuadFragmentShaderTemplate();
  vtkShaderProgram::Substitute(source, "//VTK::FSQ::Decl", declarations);
  vtkShaderProgram::Substitute(
    source, "//VTK::FSQ::Impl", vtkradiometry::ExpandShader(implementation, {}));
  return new vtkOpenGLQuadHelper(window,
    vtkOpenGLRenderUtilities::GetFullScreenQuadVertexShader().c_str(), source.c_str(), "");
}

} // namespace

vtkLinearFloatPass::vtkLinearFloatPass()
{
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(vtkNew<vtkLightsPass>());
  passes->AddItem(vtkNew<vtkOpaquePass>());
  passes->AddItem(vtkNew<vtkTranslucentPass>());
  passes->AddItem(vtkNew<vtkVolumetricPass>());
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  this->DefaultPass = camera;
  this->OverlayPass = vtkSmartPointer<vtkOverlayPass>::New();
}

vtkLinearFloatPass::~vtkLinearFloatPass()
{
  if (this->FrameBufferObject || this->PixelBuffer || this->ColorTexture || this->QuadHelper)
  {
    this->ReleaseGraphicsResources(this->Window);
  }
}

vtkRenderPass* vtkLinearFloatPass::ScenePass()
{
  return this->DelegatePass ? this->DelegatePass : this->DefaultPass.Get();
}

void vtkLinearFloatPass::Allocate(vtkOpenGLRenderWindow* window, int width, int height)
{
  if (this->Window != window)
  {
    this->ReleaseGraphicsResources(this->Window);
    this->Window = window;
  }
  const auto make = [window](vtkTextureObject*& texture) {
    if (!texture)
    {
      texture = vtkTextureObject::New();
      texture->SetContext(window);
      texture->SetMinificationFilter(vtkTextureObject::Nearest);
      texture->SetMagnificationFilter(vtkTextureObject::Nearest);
    }
  };
  const auto sized = [](vtkTextureObject* texture, int w, int h) {
    return texture->GetHandle() && texture->GetWidth() == static_cast<unsigned int>(w) &&
      texture->GetHeight() == static_cast<unsigned int>(h);
  };
  const int n = this->Samples;
  make(this->ColorTexture);
  if (!sized(this->ColorTexture, n * width, n * height))
  {
    this->ColorTexture->Allocate2D(n * width, n * height, 4, VTK_FLOAT);
  }
  make(this->DepthTexture);
  if (!sized(this->DepthTexture, n * width, n * height))
  {
    this->DepthTexture->AllocateDepth(n * width, n * height, vtkTextureObject::Float32);
  }
  const auto makeBuffer = [window](vtkOpenGLFramebufferObject*& buffer) {
    if (!buffer)
    {
      buffer = vtkOpenGLFramebufferObject::New();
      buffer->SetContext(window);
    }
  };
  makeBuffer(this->FrameBufferObject);
  if (n > 1)
  {
    make(this->PixelTexture);
    if (!sized(this->PixelTexture, width, height))
    {
      this->PixelTexture->Allocate2D(width, height, 4, VTK_FLOAT);
    }
    makeBuffer(this->PixelBuffer);
  }
}

void vtkLinearFloatPass::RenderScene(const vtkRenderState* s, int width, int height)
{
  vtkRenderer* renderer = s->GetRenderer();
  vtkOpenGLState* state = this->Window->GetState();
  vtkOpenGLFramebufferObject* target = this->FrameBufferObject;
  target->Bind();
  target->AddColorAttachment(0, this->ColorTexture);
  target->ActivateBuffer(0);
  target->AddDepthAttachment(this->DepthTexture);
  target->StartNonOrtho(width, height);

  vtkOpenGLState::ScopedglViewport viewport(state);
  vtkOpenGLState::ScopedglScissor scissor(state);
  state->vtkglViewport(0, 0, width, height);
  state->vtkglScissor(0, 0, width, height);
  // Renderers in upper layers do not clear; this target is nobody else's.
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  state->vtkglClearDepth(1.0);
  state->vtkglClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_LEQUAL);

  vtkRenderState inner(renderer);
  inner.SetPropArrayAndCount(s->GetPropArray(), s->GetPropArrayCount());
  inner.SetFrameBuffer(target);
  vtkRenderPass* scene = this->ScenePass();
  if (this->KeepBackground)
  {
    scene->Render(&inner);
  }
  else
  {
    BackgroundSwitch dark(renderer);
    scene->Render(&inner);
  }
  this->NumberOfRenderedProps += scene->GetNumberOfRenderedProps();
}

void vtkLinearFloatPass::Copy(vtkOpenGLRenderWindow* window, int samples)
{
  vtkOpenGLState* state = window->GetState();
  if (samples > 1)
  {
    state->PushFramebufferBindings();
    this->PixelBuffer->Bind();
    this->PixelBuffer->AddColorAttachment(0, this->PixelTexture);
    this->PixelBuffer->ActivateBuffer(0);
    this->PixelBuffer->StartNonOrtho(this->Size[0], this->Size[1]);
    vtkOpenGLState::ScopedglViewport viewport(state);
    vtkOpenGLState::ScopedglScissor scissor(state);
    state->vtkglViewport(0, 0, this->Size[0], this->Size[1]);
    state->vtkglScissor(0, 0, this->Size[0], this->Size[1]);
    if (!this->MeanHelper)
    {
      this->MeanHelper = MakeQuad(
        window, "uniform sampler2D colorSource;\nuniform int samples;\n", vtkLinearFloatMeanFS);
    }
    else
    {
      window->GetShaderCache()->ReadyShaderProgram(this->MeanHelper->Program);
    }
    if (this->MeanHelper->Program && this->MeanHelper->Program->GetCompiled())
    {
      state->vtkglDisable(GL_DEPTH_TEST);
      this->ColorTexture->Activate();
      this->MeanHelper->Program->SetUniformi("colorSource", this->ColorTexture->GetTextureUnit());
      this->MeanHelper->Program->SetUniformi("samples", samples);
      this->MeanHelper->Render();
      this->ColorTexture->Deactivate();
      state->vtkglEnable(GL_DEPTH_TEST);
    }
    state->PopFramebufferBindings();
  }
}

void vtkLinearFloatPass::Render(const vtkRenderState* s)
{
  vtkOpenGLClearErrorMacro();
  this->NumberOfRenderedProps = 0;
  vtkRenderer* renderer = s->GetRenderer();
  vtkOpenGLRenderWindow* window =
    vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (renderer->GetSelector())
  {
    // Selection reads ids out of the window's own buffer, and draws them without passes.
    if (this->DelegatePass)
    {
      this->DelegatePass->Render(s);
      this->NumberOfRenderedProps = this->DelegatePass->GetNumberOfRenderedProps();
    }
    else
    {
      const vtkSmartPointer<vtkRenderPass> pass = renderer->GetPass();
      renderer->SetPass(nullptr);
      renderer->DeviceRender();
      renderer->SetPass(pass);
    }
    return;
  }

  int origin[2] = { 0, 0 };
  if (auto* outer = vtkOpenGLFramebufferObject::SafeDownCast(s->GetFrameBuffer()))
  {
    outer->GetLastSize(this->Size);
  }
  else
  {
    renderer->GetTiledSizeAndOrigin(&this->Size[0], &this->Size[1], &origin[0], &origin[1]);
  }
  if (this->Size[0] <= 0 || this->Size[1] <= 0)
  {
    return;
  }
  this->Allocate(window, this->Size[0], this->Size[1]);
  this->FrameSamples = this->Samples;
  this->Parallel = renderer->GetActiveCamera()->GetParallelProjection() != 0;

  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  this->RenderScene(s, this->Samples * this->Size[0], this->Samples * this->Size[1]);
  state->PopFramebufferBindings();
  renderer->GetActiveCamera()->GetClippingRange(this->ClippingRange);

  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  vtkOpenGLState::ScopedglEnableDisable depth(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglDepthFunc depthFunction(state);
  state->vtkglDisable(GL_BLEND);
  this->Copy(window, this->Samples);

  if (!this->QuadHelper)
  {
    this->QuadHelper = MakeQuad(window,
      "uniform sampler2D colorSource;\nuniform sampler2D depthSource;\nuniform int samples;\n",
      vtkLinearFloatCopyFS);
  }
  else
  {
    window->GetShaderCache()->ReadyShaderProgram(this->QuadHelper->Program);
  }
  vtkShaderProgram* program = this->QuadHelper->Program;
  if (!program || !program->GetCompiled())
  {
    vtkErrorMacro("the shader that copies the float picture was not compiled");
    return;
  }
  vtkTextureObject* pixels = this->Samples > 1 ? this->PixelTexture : this->ColorTexture;
  vtkOpenGLState::ScopedglViewport viewport(state);
  vtkOpenGLState::ScopedglScissor scissor(state);
  state->vtkglViewport(origin[0], origin[1], this->Size[0], this->Size[1]);
  state->vtkglScissor(origin[0], origin[1], this->Size[0], this->Size[1]);
  state->vtkglEnable(GL_DEPTH_TEST); // or depth is not written
  state->vtkglDepthFunc(GL_ALWAYS);
  state->vtkglDepthMask(GL_TRUE);
  pixels->Activate();
  this->DepthTexture->Activate();
  program->SetUniformi("colorSource", pixels->GetTextureUnit());
  program->SetUniformi("depthSource", this->DepthTexture->GetTextureUnit());
  program->SetUniformi("samples", this->Samples);
  this->QuadHelper->Render();
  pixels->Deactivate();
  this->DepthTexture->Deactivate();
  state->vtkglDepthFunc(GL_LEQUAL);
  state->vtkglEnable(GL_BLEND);
  if (!this->DelegatePass)
  {
    this->OverlayPass->Render(s);
    this->NumberOfRenderedProps += this->OverlayPass->GetNumberOfRenderedProps();
  }
  vtkOpenGLCheckErrorMacro("failed after Render");
}

bool vtkLinearFloatPass::ReadTexture(
  vtkTextureObject* texture, int components, vtkImageData* image)
{
  if (!this->Window || !texture || !texture->GetHandle())
  {
    return false;
  }
  this->Window->MakeCurrent();
  vtkPixelBufferObject* buffer = texture->Download();
  if (!buffer)
  {
    return false;
  }
  unsigned int size[2] = { texture->GetWidth(), texture->GetHeight() };
  vtkIdType increments[2] = { 0, 0 };
  image->SetDimensions(static_cast<int>(size[0]), static_cast<int>(size[1]), 1);
  image->AllocateScalars(VTK_FLOAT, components);
  const bool read =
    buffer->Download2D(VTK_FLOAT, image->GetScalarPointer(), size, components, increments);
  buffer->Delete();
  return read;
}

vtkImageData* vtkLinearFloatPass::GetColor()
{
  vtkTextureObject* pixels = this->FrameSamples > 1 ? this->PixelTexture : this->ColorTexture;
  if (!this->Color)
  {
    this->Color = vtkSmartPointer<vtkImageData>::New();
  }
  if (!this->ReadTexture(pixels, 4, this->Color))
  {
    return nullptr;
  }
  this->Color->GetPointData()->GetScalars()->SetName("RGBA");
  return this->Color;
}

vtkImageData* vtkLinearFloatPass::GetDepth()
{
  vtkNew<vtkImageData> raw;
  if (!this->ReadTexture(this->DepthTexture, 1, raw))
  {
    return nullptr;
  }
  if (!this->Depth)
  {
    this->Depth = vtkSmartPointer<vtkImageData>::New();
  }
  const int n = this->FrameSamples;
  this->Depth->SetDimensions(this->Size[0], this->Size[1], 1);
  this->Depth->AllocateScalars(VTK_FLOAT, 1);
  this->Depth->GetPointData()->GetScalars()->SetName("Z");
  const float* source = static_cast<float*>(raw->GetScalarPointer());
  float* depth = static_cast<float*>(this->Depth->GetScalarPointer());
  const double nearPlane = this->ClippingRange[0];
  const double farPlane = this->ClippingRange[1];
  for (int y = 0; y < this->Size[1]; ++y)
  {
    for (int x = 0; x < this->Size[0]; ++x)
    {
      const std::size_t row = static_cast<std::size_t>(y * n + n / 2);
      const double d = source[row * this->Size[0] * n + x * n + n / 2];
      const double z = this->Parallel
        ? nearPlane + d * (farPlane - nearPlane)
        : nearPlane * farPlane / (farPlane - d * (farPlane - nearPlane));
      *depth++ = static_cast<float>(d >= 1.0 ? this->BackgroundDepth : z);
    }
  }
  return this->Depth;
}

void vtkLinearFloatPass::ReleaseGraphicsResources(vtkWindow* w)
{
  if (w)
  {
    this->Superclass::ReleaseGraphicsResources(w);
    this->DefaultPass->ReleaseGraphicsResources(w);
    this->OverlayPass->ReleaseGraphicsResources(w);
  }
  for (vtkOpenGLQuadHelper** quad : { &this->QuadHelper, &this->MeanHelper })
  {
    delete *quad;
    *quad = nullptr;
  }
  for (vtkOpenGLFramebufferObject** buffer : { &this->FrameBufferObject, &this->PixelBuffer })
  {
    if (*buffer)
    {
      (*buffer)->ReleaseGraphicsResources(w);
      (*buffer)->Delete();
      *buffer = nullptr;
    }
  }
  for (vtkTextureObject** texture :
    { &this->ColorTexture, &this->DepthTexture, &this->PixelTexture })
  {
    if (*texture)
    {
      (*texture)->ReleaseGraphicsResources(w);
      (*texture)->Delete();
      *texture = nullptr;
    }
  }
  this->Window = nullptr;
}

void vtkLinearFloatPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "KeepBackground: " << this->KeepBackground << "\n";
  os << indent << "Samples: " << this->Samples << "\n";
  os << indent << "BackgroundDepth: " << this->BackgroundDepth << "\n";
}
