// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLinearFloatPass.h"

#include "LinearFloatParts.h"

#include "vtk_glew.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLRenderer.h"
#include "vtkPointData.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderState.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <vector>

using displaypass::Area;
using vtkradiometry::FullScreenPass;
using vtkradiometry::PropGroups;
using vtkradiometry::Target;

vtkStandardNewMacro(vtkLinearFloatPass);

namespace
{

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
