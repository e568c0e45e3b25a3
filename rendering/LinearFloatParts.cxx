// SPDX-License-Identifier: BSD-3-Clause
#include "LinearFloatParts.h"

#include "vtkLinearFloatMeanFS.h"
#include "vtkLinearFloatShowFS.h"

#include "vtk_glew.h"

#include "vtkCamera.h"
#include "vtkInformation.h"
#include "vtkOpenGLActor.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLState.h"
#include "vtkProp.h"
#include "vtkRenderState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

using displaypass::Area;
using vtkradiometry::OnlyThese;
using vtkradiometry::PropGroups;
using vtkradiometry::Target;

namespace
{

/// Puts back what drawing into another target changes.
class TargetGuard
{
public:
  explicit TargetGuard(vtkOpenGLState* state)
    : State(state)
    , Viewport(state)
    , Scissor(state)
    , ScissorTest(state, GL_SCISSOR_TEST)
    , DepthTest(state, GL_DEPTH_TEST)
    , DepthFunction(state)
    , DepthMask(state)
  {
    state->PushFramebufferBindings();
  }
  ~TargetGuard() { this->State->PopFramebufferBindings(); }
  TargetGuard(const TargetGuard&) = delete;
  void operator=(const TargetGuard&) = delete;

private:
  vtkOpenGLState* State;
  vtkOpenGLState::ScopedglViewport Viewport;
  vtkOpenGLState::ScopedglScissor Scissor;
  vtkOpenGLState::ScopedglEnableDisable ScissorTest;
  vtkOpenGLState::ScopedglEnableDisable DepthTest;
  vtkOpenGLState::ScopedglDepthFunc DepthFunction;
  vtkOpenGLState::ScopedglDepthMask DepthMask;
};

} // namespace

//------------------------------------------------------------------------------
void vtkLinearFloatPass::Internals::Adopt(vtkLinearFloatPass* self, vtkRenderer* renderer)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (this->Window != window)
  {
    self->ReleaseGraphicsResources(this->Window);
    this->Window = window;
  }
  this->Samples = self->Samples;
  this->Parallel = renderer->GetActiveCamera()->GetParallelProjection() != 0;
}

//------------------------------------------------------------------------------
void vtkLinearFloatPass::Internals::DrawScene(vtkLinearFloatPass* self, vtkRenderer* renderer,
  std::vector<vtkProp*>& props, Target& target)
{
  const OnlyThese only(renderer, props);
  vtkRenderState inner(renderer);
  inner.SetPropArrayAndCount(props.data(), static_cast<int>(props.size()));
  inner.SetFrameBuffer(target.Buffer);
  if (self->DelegatePass)
  {
    // The target is clear, and its depth may already hold what hides light.
    const vtkTypeBool erase = renderer->GetErase();
    renderer->SetErase(0);
    self->DelegatePass->Render(&inner);
    renderer->SetErase(erase);
    self->NumberOfRenderedProps += self->DelegatePass->GetNumberOfRenderedProps();
    return;
  }
  this->Lights->Render(&inner);
  this->Opaque->Render(&inner);
  if (this->HasNearest && &target == &this->Seen)
  {
    this->Translucent->Render(&inner); // for its depth, in any order
  }
  else
  {
    this->Peeling->Blend(renderer, props, target);
  }
  this->Volumes->Render(&inner);
  self->NumberOfRenderedProps += static_cast<int>(props.size());
}

//------------------------------------------------------------------------------
void vtkLinearFloatPass::Internals::HideBehindOthers(Target& target)
{
  const std::string source = vtkradiometry::FullScreenShader(
    "uniform sampler2D otherDepth;\n",
    "  ivec2 pixel = ivec2(texCoord * vec2(textureSize(otherDepth, 0)));\n"
    "  gl_FragDepth = texelFetch(otherDepth, pixel, 0).r;\n"
    "  gl_FragData[0] = vec4(0.0);\n");
  vtkOpenGLState* state = this->Window->GetState();
  if (!this->CopyDepth.Ready(this->Window, source))
  {
    return;
  }
  target.Bind(this->Window);
  vtkShaderProgram* program = this->CopyDepth.Quad()->Program;
  this->Other.Depth->Activate();
  program->SetUniformi("otherDepth", this->Other.Depth->GetTextureUnit());
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_ALWAYS);
  state->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  this->CopyDepth.Quad()->Render();
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  state->vtkglDepthFunc(GL_LEQUAL);
  this->Other.Depth->Deactivate();
}

//------------------------------------------------------------------------------
void vtkLinearFloatPass::Internals::DrawLinear(
  vtkLinearFloatPass* self, vtkRenderer* renderer, const PropGroups& groups, Target& target)
{
  const TargetGuard guard(this->Window->GetState());
  target.Allocate(this->Window, this->Samples * this->Width, this->Samples * this->Height,
    VTK_FLOAT, true);
  target.Bind(this->Window);
  target.Clear(this->Window);
  if (self->KeepBackground && renderer->GetErase())
  {
    renderer->Clear();
  }
  if (&target == &this->Seen && !this->HasNearest)
  {
    this->HideBehindOthers(target);
  }
  std::vector<vtkProp*> props = groups.Linear;
  if (!props.empty() || self->DelegatePass)
  {
    this->DrawScene(self, renderer, props, target);
  }
  renderer->GetActiveCamera()->GetClippingRange(this->ClippingRange);
}

//------------------------------------------------------------------------------
void vtkLinearFloatPass::Internals::DrawOther(vtkRenderer* renderer, PropGroups& groups)
{
  const TargetGuard guard(this->Window->GetState());
  this->Other.Allocate(this->Window, this->Width, this->Height, VTK_UNSIGNED_CHAR, true);
  this->Other.Bind(this->Window);
  this->Other.Clear(this->Window);
  const OnlyThese only(renderer, groups.Other);
  vtkRenderState inner(renderer);
  inner.SetPropArrayAndCount(groups.Other.data(), static_cast<int>(groups.Other.size()));
  inner.SetFrameBuffer(this->Other.Buffer);
  this->Lights->Render(&inner);
  renderer->DeviceRenderOpaqueGeometry(this->Other.Buffer);
}

//------------------------------------------------------------------------------
// Translucent surfaces leave no depth; here they do, and the colours do not matter.
void vtkLinearFloatPass::Internals::DrawNearest(
  vtkLinearFloatPass* self, vtkRenderer* renderer, const PropGroups& groups)
{
  this->HasNearest = groups.LinearIsTranslucent();
  if (!this->HasNearest)
  {
    return;
  }
  for (vtkProp* prop : groups.Linear)
  {
    if (!prop->GetPropertyKeys())
    {
      prop->SetPropertyKeys(vtkNew<vtkInformation>());
    }
    prop->GetPropertyKeys()->Set(vtkOpenGLActor::GLDepthMaskOverride(), 1);
  }
  this->DrawLinear(self, renderer, groups, this->Seen);
  for (vtkProp* prop : groups.Linear)
  {
    prop->GetPropertyKeys()->Remove(vtkOpenGLActor::GLDepthMaskOverride());
  }
}

//------------------------------------------------------------------------------
void vtkLinearFloatPass::Internals::AverageSamples()
{
  if (this->Samples == 1)
  {
    return;
  }
  vtkOpenGLState* state = this->Window->GetState();
  const TargetGuard guard(state);
  const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  this->Pixel.Allocate(this->Window, this->Width, this->Height, VTK_FLOAT, false);
  this->Pixel.Bind(this->Window);
  const std::string source = vtkradiometry::FullScreenShader(
    "uniform sampler2D colorSource;\nuniform int samples;\n", vtkLinearFloatMeanFS);
  if (this->Mean.Ready(this->Window, source))
  {
    state->vtkglDisable(GL_DEPTH_TEST);
    state->vtkglDisable(GL_BLEND);
    vtkShaderProgram* program = this->Mean.Quad()->Program;
    this->Light.Color->Activate();
    program->SetUniformi("colorSource", this->Light.Color->GetTextureUnit());
    program->SetUniformi("samples", this->Samples);
    this->Mean.Quad()->Render();
    this->Light.Color->Deactivate();
  }
}

//------------------------------------------------------------------------------
// Under a camera pass the frame buffer is clear already; as the outermost pass nobody did it.
void vtkLinearFloatPass::Internals::ClearBackground(
  vtkLinearFloatPass* self, const vtkRenderState* s, const Area& area)
{
  vtkRenderer* renderer = s->GetRenderer();
  if ((renderer->GetPass() != self && !s->GetFrameBuffer()) || !renderer->GetErase() ||
    !this->Window->GetErase())
  {
    return;
  }
  vtkOpenGLState* state = this->Window->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglScissor scissor(state);
  const vtkOpenGLState::ScopedglEnableDisable scissorTest(state, GL_SCISSOR_TEST);
  state->vtkglViewport(area.X, area.Y, area.Width, area.Height);
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(area.X, area.Y, area.Width, area.Height);
  renderer->Clear();
}

//------------------------------------------------------------------------------
bool vtkLinearFloatPass::Internals::ShowAll(vtkLinearFloatPass* self, const vtkRenderState* s,
  const Area& area, bool others, bool hidden)
{
  vtkOpenGLState* state = this->Window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  const vtkOpenGLState::ScopedglEnableDisable test(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  const vtkOpenGLState::ScopedglDepthFunc depthFunction(state);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglScissor scissor(state);
  std::string source = vtkLinearFloatShowFS;
  vtkShaderProgram::Substitute(
    source, "//VTK::Display::Dec", self->DisplayFunction(this->Window));
  if (!this->Show.Ready(this->Window, source))
  {
    return false;
  }
  vtkShaderProgram* program = this->Show.Quad()->Program;
  const Target& light = hidden ? this->Seen : this->Light;
  // Samplers need a texture even where the shader does not read it.
  const Target& other = others ? this->Other : light;
  std::vector<vtkTextureObject*> textures;
  const auto bind = [&](vtkTextureObject* texture, const char* name) {
    texture->Activate();
    textures.push_back(texture);
    program->SetUniformi(name, texture->GetTextureUnit());
  };
  bind(light.Color, "linearColor");
  bind(light.Depth, "linearDepth");
  bind(other.Color, "otherColor");
  bind(other.Depth, "otherDepth");
  program->SetUniformi("samples", this->Samples);
  program->SetUniformi("others", others ? (hidden ? 2 : 1) : 0);
  program->SetUniformi("bounded", s->GetFrameBuffer() ? 0 : 1);
  self->StartDisplay(program);
  state->vtkglViewport(area.X, area.Y, area.Width, area.Height);
  state->vtkglScissor(area.X, area.Y, area.Width, area.Height);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  state->vtkglEnable(GL_DEPTH_TEST); // or depth is not written
  state->vtkglDepthFunc(GL_ALWAYS);
  state->vtkglDepthMask(GL_TRUE);
  this->Show.Quad()->Render();
  self->FinishDisplay();
  for (vtkTextureObject* texture : textures)
  {
    texture->Deactivate();
  }
  return true;
}

//------------------------------------------------------------------------------
int vtkLinearFloatPass::Internals::DrawRest(
  const vtkRenderState* s, PropGroups& groups, const Area& area)
{
  vtkRenderer* renderer = s->GetRenderer();
  vtkOpenGLState* state = this->Window->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglScissor scissor(state);
  state->vtkglViewport(area.X, area.Y, area.Width, area.Height);
  state->vtkglScissor(area.X, area.Y, area.Width, area.Height);
  const bool translucent = groups.OtherIsTranslucent();
  if (translucent)
  {
    const OnlyThese only(renderer, groups.Other);
    renderer->DeviceRenderTranslucentPolygonalGeometry(s->GetFrameBuffer());
  }
  int rendered = 0;
  for (vtkProp* prop : groups.Flat)
  {
    rendered += prop->RenderOpaqueGeometry(renderer); // where texts make their textures
  }
  if (!translucent || !renderer->GetUseDepthPeeling() || !renderer->GetUseDepthPeelingForVolumes())
  {
    for (vtkProp* prop : groups.Other)
    {
      rendered += prop->RenderVolumetricGeometry(renderer);
    }
  }
  for (vtkProp* prop : groups.All)
  {
    rendered += prop->RenderOverlay(renderer);
  }
  return rendered;
}
