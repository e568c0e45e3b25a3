// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkOpenColorIOPass share: a window, a scene, and passes that give and take
// floats.
#pragma once

#include "color/ColorTransform.h"
#include "vtkLinearFloatPass.h"
#include "vtkOpenColorIOPass.h"

#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCameraPass.h"
#include "vtkImageData.h"
#include "vtkImageProcessingPass.h"
#include "vtkLightsPass.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderUtilities.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkOutputWindow.h"
#include "vtkPixelBufferObject.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkProperty.h"
#include "vtkProperty2D.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderState.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSequencePass.h"
#include "vtkShaderProgram.h"
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"
#include "vtkTranslucentPass.h"
#include "vtkUnsignedCharArray.h"
#include "vtk_glew.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>

namespace color = radiometry::color;

namespace passtest
{

constexpr int size = 96;

/// Stands for a scene: fills the frame buffer with given floats.
class FieldPass : public vtkRenderPass
{
public:
  static FieldPass* New() { VTK_STANDARD_NEW_BODY(FieldPass); }
  vtkTypeMacro(FieldPass, vtkRenderPass);
  std::vector<float> Pixels;

  void Render(const vtkRenderState* s) override
  {
    auto* window = vtkOpenGLRenderWindow::SafeDownCast(s->GetRenderer()->GetRenderWindow());
    vtkNew<vtkTextureObject> texture;
    texture->SetContext(window);
    texture->SetMinificationFilter(vtkTextureObject::Nearest);
    texture->SetMagnificationFilter(vtkTextureObject::Nearest);
    texture->Create2DFromRaw(size, size, 4, VTK_FLOAT, this->Pixels.data());
    std::string source = vtkOpenGLRenderUtilities::GetFullScreenQuadFragmentShaderTemplate();
    vtkShaderProgram::Substitute(source, "//VTK::FSQ::Decl", "uniform sampler2D field;");
    vtkShaderProgram::Substitute(
      source, "//VTK::FSQ::Impl", "gl_FragData[0] = texture(field, texCoord);");
    vtkOpenGLQuadHelper quad(window,
      vtkOpenGLRenderUtilities::GetFullScreenQuadVertexShader().c_str(), source.c_str(), "");
    const vtkOpenGLState::ScopedglEnableDisable blend(window->GetState(), GL_BLEND);
    const vtkOpenGLState::ScopedglEnableDisable depth(window->GetState(), GL_DEPTH_TEST);
    window->GetState()->vtkglDisable(GL_BLEND);
    window->GetState()->vtkglDisable(GL_DEPTH_TEST);
    texture->Activate();
    quad.Program->SetUniformi("field", texture->GetTextureUnit());
    quad.Render();
    texture->Deactivate();
    texture->ReleaseGraphicsResources(window);
  }
};

/// Keeps what its delegate draws, as floats.
class ReadPass : public vtkImageProcessingPass
{
public:
  static ReadPass* New() { VTK_STANDARD_NEW_BODY(ReadPass); }
  vtkTypeMacro(ReadPass, vtkImageProcessingPass);
  std::vector<float> Pixels;

  void Render(const vtkRenderState* s) override
  {
    auto* window = vtkOpenGLRenderWindow::SafeDownCast(s->GetRenderer()->GetRenderWindow());
    vtkNew<vtkTextureObject> texture;
    texture->SetContext(window);
    texture->Allocate2D(size, size, 4, VTK_FLOAT);
    vtkNew<vtkOpenGLFramebufferObject> target;
    target->SetContext(window);
    window->GetState()->PushFramebufferBindings();
    this->RenderDelegate(s, size, size, size, size, target, texture);
    window->GetState()->PopFramebufferBindings();
    auto pixels = vtkSmartPointer<vtkPixelBufferObject>::Take(texture->Download());
    this->Pixels.resize(4 * size * size);
    unsigned int dimensions[2] = { size, size };
    vtkIdType increments[2] = { 0, 0 };
    pixels->Download2D(VTK_FLOAT, this->Pixels.data(), dimensions, 4, increments);
    target->ReleaseGraphicsResources(window);
    texture->ReleaseGraphicsResources(window);
  }
};

/// Keeps the depth that its delegate leaves to whoever draws next.
class DepthPass : public vtkRenderPass
{
public:
  static DepthPass* New() { VTK_STANDARD_NEW_BODY(DepthPass); }
  vtkTypeMacro(DepthPass, vtkRenderPass);
  vtkSmartPointer<vtkRenderPass> Delegate;

  void Render(const vtkRenderState* s) override
  {
    this->Delegate->Render(s);
    this->Depth.resize(size * size);
    s->GetRenderer()->GetRenderWindow()->GetZbufferData(
      0, 0, size - 1, size - 1, this->Depth.data());
  }
  float At(int x, int y) const { return this->Depth[y * size + x]; }

private:
  std::vector<float> Depth;
};

struct Errors
{
  vtkNew<vtkCallbackCommand> Command;
  int Count = 0;
  explicit Errors(vtkObject* object)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long, void* self, void*) { ++static_cast<Errors*>(self)->Count; });
    object->AddObserver(vtkCommand::ErrorEvent, this->Command);
  }
};

class Pass : public testing::Test
{
protected:
  void SetUp() override
  {
    if (!std::getenv("DISPLAY"))
    {
      GTEST_SKIP() << "no display";
    }
    unsetenv("OCIO");
    this->Display->AllSceneLinearOn();
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(size, size);
    this->Window->AddRenderer(this->Renderer);
  }

  /// A scene of a given field, converted, read back as floats.
  std::vector<float> ShowField(const std::vector<float>& field)
  {
    this->Field->Pixels = field;
    this->Display->SetDelegatePass(this->Field);
    this->Read->SetDelegatePass(this->Display);
    this->Renderer->SetPass(this->Read);
    this->Window->Render();
    return this->Read->Pixels;
  }

  /// A lit plane in the left half, through VTK's own steps.
  void MakeScene(double opacity)
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-1, -1, 0);
    plane->SetPoint1(0, -1, 0);
    plane->SetPoint2(-1, 1, 0);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(plane->GetOutputPort());
    this->Actor->SetMapper(mapper);
    this->Actor->GetProperty()->LightingOff();
    this->Actor->GetProperty()->SetColor(0.5, 0.25, 0.125);
    this->Actor->GetProperty()->SetOpacity(opacity);
    this->Renderer->AddActor(this->Actor);
    this->Renderer->GetActiveCamera()->ParallelProjectionOn();
    this->Renderer->GetActiveCamera()->SetParallelScale(1);
    this->Renderer->ResetCameraClippingRange();
    this->Display->SetDelegatePass(this->Steps);
    this->Renderer->SetPass(this->Display);
  }

  std::array<int, 3> Pixel(int x, int y)
  {
    vtkNew<vtkUnsignedCharArray> bytes;
    this->Window->GetPixelData(x, y, x, y, 0, bytes);
    return { bytes->GetValue(0), bytes->GetValue(1), bytes->GetValue(2) };
  }

  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkActor> Actor;
  vtkNew<FieldPass> Field;
  vtkNew<ReadPass> Read;
  vtkNew<vtkRenderStepsPass> Steps;
  vtkNew<vtkOpenColorIOPass> Display;
};

} // namespace passtest
