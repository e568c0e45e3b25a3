// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLinearFloatPass.h"

#include "DisplayPassParts.h"
#include "FloatTarget.h"
#include "LinearPeeling.h"
#include "PropGroups.h"
#include "vtkLinearFloatMeanFS.h"
#include "vtkLinearFloatShowFS.h"

#include "vtk_glew.h"

#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkLightsPass.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLActor.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLState.h"
#include "vtkPointData.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtkTranslucentPass.h"
#include "vtkVolumetricPass.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <vector>

using displaypass::Area;
using vtkradiometry::FullScreenPass;
using vtkradiometry::OnlyThese;
using vtkradiometry::PropGroups;
using vtkradiometry::Target;

vtkStandardNewMacro(vtkLinearFloatPass);

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

/// The window without the tiles of a large screenshot.
class WholeWindow
{
public:
  explicit WholeWindow(vtkRenderWindow* window)
    : Window(window)
    , Scale{ window->GetTileScale()[0], window->GetTileScale()[1] }
  {
    window->GetTileViewport(this->Viewport);
    window->SetTileScale(1, 1);
    window->SetTileViewport(0.0, 0.0, 1.0, 1.0);
  }
  ~WholeWindow()
  {
    this->Window->SetTileScale(this->Scale);
    this->Window->SetTileViewport(this->Viewport);
  }
  WholeWindow(const WholeWindow&) = delete;
  void operator=(const WholeWindow&) = delete;

private:
  vtkRenderWindow* Window;
  int Scale[2];
  double Viewport[4];
};

} // namespace

struct vtkLinearFloatPass::Internals
{
  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  Target Light; ///< all light, Samples x Samples texels a pixel
  Target Seen;  ///< the light that other opaque surfaces leave, where it cannot be told by depth
  Target Other; ///< what is opaque and no light, one texel a pixel
  Target Pixel; ///< the mean of Light
  FullScreenPass Show;
  FullScreenPass Mean;
  FullScreenPass CopyDepth;
  vtkNew<vtkLightsPass> Lights;
  vtkNew<vtkOpaquePass> Opaque;
  vtkNew<vtkTranslucentPass> Translucent;
  vtkNew<vtkradiometry::LinearPeeling> Peeling;
  vtkNew<vtkVolumetricPass> Volumes;

  int Width = 0;
  int Height = 0;
  int Samples = 1; ///< of what Light holds
  double ClippingRange[2] = { 0.0, 1.0 };
  bool Parallel = false;
  bool HasNearest = false; ///< Seen holds the depth of all surfaces
  vtkNew<vtkImageData> Images[5];

  void Adopt(vtkLinearFloatPass* self, vtkRenderer* renderer);
  void DrawLinear(
    vtkLinearFloatPass* self, vtkRenderer* renderer, const PropGroups& groups, Target& target);
  void DrawScene(vtkLinearFloatPass* self, vtkRenderer* renderer, std::vector<vtkProp*>& props,
    Target& target);
  void HideBehindOthers(Target& target);
  void DrawNearest(vtkLinearFloatPass* self, vtkRenderer* renderer, const PropGroups& groups);
  void DrawOther(vtkRenderer* renderer, PropGroups& groups);
  void AverageSamples();
  void ClearBackground(vtkLinearFloatPass* self, const vtkRenderState* s, const Area& area);
  bool ShowAll(
    vtkLinearFloatPass* self, const vtkRenderState* s, const Area& area, bool others, bool hidden);
  int DrawRest(const vtkRenderState* s, PropGroups& groups, const Area& area);
};

vtkLinearFloatPass::vtkLinearFloatPass()
  : Parts(new Internals)
{
}

vtkLinearFloatPass::~vtkLinearFloatPass()
{
  if (this->Parts->Window)
  {
    this->vtkLinearFloatPass::ReleaseGraphicsResources(this->Parts->Window);
  }
}

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

//------------------------------------------------------------------------------
void vtkLinearFloatPass::RenderSelection(const vtkRenderState* s)
{
  // Selection reads ids out of the frame buffer as it is.
  vtkRenderer* renderer = s->GetRenderer();
  if (renderer->GetPass() == this)
  {
    renderer->SetPass(nullptr);
    renderer->DeviceRender();
    renderer->SetPass(this);
  }
  else
  {
    this->ClearLights(renderer);
    this->UpdateLightGeometry(renderer);
    this->UpdateLights(renderer);
    this->UpdateGeometry(renderer, s->GetFrameBuffer());
  }
}

//------------------------------------------------------------------------------
void vtkLinearFloatPass::Render(const vtkRenderState* s)
{
  vtkOpenGLClearErrorMacro();
  this->NumberOfRenderedProps = 0;
  vtkRenderer* renderer = s->GetRenderer();
  if (renderer->GetSelector())
  {
    this->RenderSelection(s);
    return;
  }
  const Area area = displaypass::AreaOf(s);
  if (area.Width <= 0 || area.Height <= 0)
  {
    return;
  }
  Internals& parts = *this->Parts;
  parts.Adopt(this, renderer);
  parts.Width = area.Width;
  parts.Height = area.Height;
  PropGroups groups(s, this->AllSceneLinear);
  parts.HasNearest = false;
  parts.DrawLinear(this, renderer, groups, parts.Light);
  parts.AverageSamples();
  const bool others = groups.OtherIsOpaque();
  // Translucent light covers what it does not hide: no depth tells it from what is behind others.
  const bool hidden = others && groups.LinearIsTranslucent() &&
    !vtkLinearFloatPass::SafeDownCast(this->DelegatePass);
  if (others)
  {
    parts.DrawOther(renderer, groups);
  }
  if (hidden)
  {
    parts.DrawLinear(this, renderer, groups, parts.Seen);
  }
  parts.ClearBackground(this, s, area);
  if (!parts.ShowAll(this, s, area, others, hidden))
  {
    vtkErrorMacro("the shader that shows the picture does not compile");
    return;
  }
  this->NumberOfRenderedProps += parts.DrawRest(s, groups, area);
  vtkOpenGLCheckErrorMacro("failed after Render");
}

//------------------------------------------------------------------------------
void vtkLinearFloatPass::RenderOffScreen(vtkRenderer* renderer, int reduction)
{
  std::vector<vtkProp*> visible;
  vtkCollectionSimpleIterator it;
  vtkPropCollection* props = renderer->GetViewProps();
  props->InitTraversal(it);
  while (vtkProp* prop = props->GetNextProp(it))
  {
    if (prop->GetVisibility())
    {
      visible.push_back(prop);
    }
  }
  vtkRenderState s(renderer);
  s.SetPropArrayAndCount(visible.data(), static_cast<int>(visible.size()));
  const WholeWindow whole(renderer->GetRenderWindow());
  const Area area = displaypass::AreaOf(&s);
  if (area.Width <= 0 || area.Height <= 0)
  {
    return;
  }
  this->NumberOfRenderedProps = 0;
  this->Parts->Adopt(this, renderer);
  this->Parts->Window->MakeCurrent();
  this->Parts->Width = std::max(area.Width / reduction, 1);
  this->Parts->Height = std::max(area.Height / reduction, 1);
  const PropGroups groups(&s, this->AllSceneLinear);
  this->Parts->DrawLinear(this, renderer, groups, this->Parts->Light);
  this->Parts->AverageSamples();
  this->Parts->DrawNearest(this, renderer, groups);
  // Windows that restore OpenGL's state around a frame (vtkGenericOpenGLRenderWindow) would bind a
  // buffer again that the next frame may delete.
  glBindBuffer(GL_ARRAY_BUFFER, 0);
}

//------------------------------------------------------------------------------
std::string vtkLinearFloatPass::DisplayFunction(vtkOpenGLRenderWindow*)
{
  return "vec4 radiometryToDisplay(vec4 c) { return c; }\n";
}

void vtkLinearFloatPass::StartDisplay(vtkShaderProgram*) {}

void vtkLinearFloatPass::FinishDisplay() {}

std::string vtkLinearFloatPass::GetFragmentShaderSource() const { return this->Parts->Show.Text(); }

//------------------------------------------------------------------------------
vtkImageData* vtkLinearFloatPass::GetColor()
{
  Target& source = this->Parts->Samples > 1 ? this->Parts->Pixel : this->Parts->Light;
  vtkImageData* image = this->Parts->Images[0];
  return vtkradiometry::ReadTexture(this->Parts->Window, source.Color, 4, "RGBA", image) ? image
                                                                                        : nullptr;
}

vtkImageData* vtkLinearFloatPass::GetSampleColor()
{
  vtkImageData* image = this->Parts->Images[1];
  return vtkradiometry::ReadTexture(
           this->Parts->Window, this->Parts->Light.Color, 4, "RGBA", image)
    ? image
    : nullptr;
}

vtkImageData* vtkLinearFloatPass::GetSampleDepth()
{
  vtkImageData* image = this->Parts->Images[2];
  return vtkradiometry::ReadTexture(
           this->Parts->Window, this->Parts->Light.Depth, 1, "Depth", image)
    ? image
    : nullptr;
}

vtkImageData* vtkLinearFloatPass::GetSampleNearest()
{
  vtkImageData* image = this->Parts->Images[4];
  return this->Parts->HasNearest &&
      vtkradiometry::ReadTexture(
        this->Parts->Window, this->Parts->Seen.Depth, 1, "Depth", image)
    ? image
    : nullptr;
}

double vtkLinearFloatPass::DistanceOf(double depth)
{
  const double nearPlane = this->Parts->ClippingRange[0];
  const double farPlane = this->Parts->ClippingRange[1];
  if (depth >= 1.0)
  {
    return this->BackgroundDepth;
  }
  return this->Parts->Parallel ? nearPlane + depth * (farPlane - nearPlane)
                               : nearPlane * farPlane / (farPlane - depth * (farPlane - nearPlane));
}

vtkImageData* vtkLinearFloatPass::GetDepth()
{
  vtkImageData* samples = this->GetSampleDepth();
  if (!samples)
  {
    return nullptr;
  }
  vtkImageData* image = this->Parts->Images[3];
  const int width = this->Parts->Width;
  const int height = this->Parts->Height;
  const int n = this->Parts->Samples;
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_FLOAT, 1);
  image->GetPointData()->GetScalars()->SetName("Z");
  const float* source = static_cast<float*>(samples->GetScalarPointer());
  float* depth = static_cast<float*>(image->GetScalarPointer());
  for (int y = 0; y < height; ++y)
  {
    const std::size_t row = static_cast<std::size_t>(y * n + n / 2) * width * n;
    for (int x = 0; x < width; ++x)
    {
      *depth++ = static_cast<float>(this->DistanceOf(source[row + x * n + n / 2]));
    }
  }
  return image;
}

//------------------------------------------------------------------------------
void vtkLinearFloatPass::ReleaseGraphicsResources(vtkWindow* w)
{
  Internals& parts = *this->Parts;
  if (w)
  {
    this->Superclass::ReleaseGraphicsResources(w);
    parts.Lights->ReleaseGraphicsResources(w);
    parts.Opaque->ReleaseGraphicsResources(w);
    parts.Translucent->ReleaseGraphicsResources(w);
    parts.Volumes->ReleaseGraphicsResources(w);
    parts.Peeling->ReleaseGraphicsResources(w);
    for (Target* target : { &parts.Light, &parts.Seen, &parts.Other, &parts.Pixel })
    {
      target->Release(w);
    }
  }
  for (FullScreenPass* pass : { &parts.Show, &parts.Mean, &parts.CopyDepth })
  {
    pass->Release();
  }
  parts.Window = nullptr;
}

void vtkLinearFloatPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "KeepBackground: " << this->KeepBackground << "\n";
  os << indent << "AllSceneLinear: " << this->AllSceneLinear << "\n";
  os << indent << "Samples: " << this->Samples << "\n";
  os << indent << "BackgroundDepth: " << this->BackgroundDepth << "\n";
}
