// SPDX-License-Identifier: BSD-3-Clause
// vtkOpenColorIOPass: background and depth kept, places in a chain of passes, errors told.
#include "PassFixture.h"

using namespace passtest;

TEST_F(Pass, BackgroundStaysAndTheSceneIsConverted)
{
  this->MakeScene(1.0);
  this->Renderer->SetBackground(0.2, 0.4, 0.6);
  this->Window->Render();
  EXPECT_EQ(this->Pixel(3 * size / 4, size / 2), (std::array<int, 3>{ 51, 102, 153 }));
  // sRGB of 0.5, 0.25 and 0.125: 0.7354, 0.5371, 0.3885.
  EXPECT_EQ(this->Pixel(size / 4, size / 2), (std::array<int, 3>{ 188, 137, 99 }));
  // Nothing of the renderer has changed.
  EXPECT_EQ(this->Renderer->GetBackground()[2], 0.6);
  EXPECT_EQ(this->Renderer->GetGradientBackground(), false);
  // The depth is the plane's, so that it can be picked.
  const double plane = this->Renderer->GetZ(size / 4, size / 2);
  EXPECT_EQ(this->Renderer->GetZ(3 * size / 4, size / 2), 1.0);
  const double* bounds = this->Renderer->ComputeVisiblePropBounds();
  this->Renderer->SetWorldPoint(bounds[0], bounds[2], bounds[4], 1.0);
  this->Renderer->WorldToDisplay();
  EXPECT_NEAR(plane, this->Renderer->GetDisplayPoint()[2], 1e-5);
}

TEST_F(Pass, GradientBackgroundIsThatOfAnOrdinaryRender)
{
  this->MakeScene(1.0);
  this->Renderer->SetBackground(0.1, 0.1, 0.3);
  this->Renderer->SetBackground2(0.7, 0.8, 0.9);
  this->Renderer->GradientBackgroundOn();
  this->Renderer->SetPass(nullptr);
  this->Window->Render();
  const auto low = this->Pixel(3 * size / 4, 5);
  const auto high = this->Pixel(3 * size / 4, size - 5);
  EXPECT_NE(low, high);
  this->Renderer->SetPass(this->Display);
  this->Window->Render();
  EXPECT_EQ(this->Pixel(3 * size / 4, 5), low);
  EXPECT_EQ(this->Pixel(3 * size / 4, size - 5), high);
}

TEST_F(Pass, TranslucentSurfacesAreMixedWithTheBackgroundAsShown)
{
  this->MakeScene(0.5);
  this->Renderer->SetBackground(0.2, 0.4, 0.6);
  this->Window->Render();
  const double srgb[3] = { 0.735357, 0.537099, 0.388573 };
  const double background[3] = { 0.2, 0.4, 0.6 };
  const auto pixel = this->Pixel(size / 4, size / 2);
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(pixel[c], 255 * (0.5 * srgb[c] + 0.5 * background[c]), 1.01);
  }
}

TEST_F(Pass, UnderACameraPassAsInParaView)
{
  this->MakeScene(1.0);
  this->Renderer->SetBackground(0.2, 0.4, 0.6);
  vtkNew<vtkRenderPassCollection> passes;
  vtkNew<vtkLightsPass> lights;
  vtkNew<vtkOpaquePass> opaque;
  vtkNew<vtkTranslucentPass> translucent;
  passes->AddItem(lights);
  passes->AddItem(opaque);
  passes->AddItem(translucent);
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  this->Display->SetDelegatePass(sequence);
  vtkNew<DepthPass> depth;
  depth->Delegate = this->Display;
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(depth);
  this->Renderer->SetPass(camera);
  for (int frame = 0; frame < 2; ++frame)
  {
    this->Window->Render();
    EXPECT_EQ(this->Pixel(3 * size / 4, size / 2), (std::array<int, 3>{ 51, 102, 153 }));
    EXPECT_EQ(this->Pixel(size / 4, size / 2), (std::array<int, 3>{ 188, 137, 99 }));
    EXPECT_LT(depth->At(size / 4, size / 2), 1.0);
    EXPECT_EQ(depth->At(3 * size / 4, size / 2), 1.0);
  }
}

TEST_F(Pass, AroundTheLinearFloatPass)
{
  this->MakeScene(1.0);
  this->Renderer->SetBackground(0.2, 0.4, 0.6);
  vtkNew<vtkLinearFloatPass> linear;
  linear->SetSamples(3);
  linear->AllSceneLinearOn();
  this->Display->SetDelegatePass(linear);
  this->Display->SetExposure(1);
  this->Window->Render();
  // What is shown is 2^1 times what is kept.
  EXPECT_EQ(this->Pixel(3 * size / 4, size / 2), (std::array<int, 3>{ 51, 102, 153 }));
  EXPECT_EQ(this->Pixel(size / 4, size / 2), (std::array<int, 3>{ 255, 188, 137 }));
  vtkImageData* kept = linear->GetColor();
  ASSERT_NE(kept, nullptr);
  EXPECT_EQ(kept->GetScalarComponentAsDouble(size / 4, size / 2, 0, 0), 0.5);
  EXPECT_EQ(kept->GetScalarComponentAsDouble(size / 4, size / 2, 0, 2), 0.125);
  EXPECT_EQ(kept->GetScalarComponentAsDouble(3 * size / 4, size / 2, 0, 3), 0.0);
}

TEST_F(Pass, AnnotationsKeepTheirColours)
{
  this->MakeScene(1.0);
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(0, 0, 0);
  plane->SetPoint1(size / 2, 0, 0);
  plane->SetPoint2(0, size / 4, 0);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor2D> legend;
  legend->SetMapper(mapper);
  legend->GetProperty()->SetColor(0.2, 0.6, 0.4);
  this->Renderer->AddActor2D(legend);
  this->Display->SetView("ACES");
  this->Display->SetExposure(2);
  this->Window->Render();
  EXPECT_EQ(this->Pixel(size / 4, size / 8), (std::array<int, 3>{ 51, 153, 102 }));
}

TEST_F(Pass, ABrokenConfigIsToldOnceAndTheLinearPictureShown)
{
  vtkOutputWindow::GetInstance()->SetDisplayMode(vtkOutputWindow::NEVER);
  Errors errors(this->Display);
  this->MakeScene(1.0);
  this->Display->SetConfigFileName("/nowhere/config.ocio");
  this->Window->Render();
  this->Window->Render();
  EXPECT_EQ(errors.Count, 1);
  EXPECT_NE(this->Display->GetErrorMessage().find("/nowhere/config.ocio"), std::string::npos);
  EXPECT_EQ(this->Pixel(size / 4, size / 2), (std::array<int, 3>{ 128, 64, 32 }));
  this->Display->SetConfigFileName("builtin");
  this->Display->SetView("no such view");
  this->Window->Render();
  EXPECT_EQ(errors.Count, 2);
  this->Display->SetView("Plain");
  this->Display->SetExposure(std::nan(""));
  this->Window->Render();
  this->Window->Render();
  EXPECT_EQ(errors.Count, 3);
  this->Display->SetExposure(0);
  this->Window->Render();
  EXPECT_EQ(errors.Count, 3);
  EXPECT_EQ(this->Display->GetErrorMessage(), "");
  EXPECT_EQ(this->Pixel(size / 4, size / 2), (std::array<int, 3>{ 188, 137, 99 }));
}

TEST_F(Pass, ResizeReleaseAndASecondViewport)
{
  this->MakeScene(1.0);
  this->Renderer->SetBackground(0, 0, 0);
  this->Window->Render();
  this->Window->SetSize(2 * size, size);
  this->Renderer->SetViewport(0.5, 0, 1, 1);
  vtkNew<vtkRenderer> other;
  other->SetViewport(0, 0, 0.5, 1);
  other->SetBackground(1, 0, 0);
  this->Window->AddRenderer(other);
  this->Window->Render();
  EXPECT_EQ(this->Pixel(size / 2, size / 2), (std::array<int, 3>{ 255, 0, 0 }));
  EXPECT_EQ(this->Pixel(size + size / 4, size / 2), (std::array<int, 3>{ 188, 137, 99 }));
  EXPECT_EQ(this->Pixel(size + 3 * size / 4, size / 2), (std::array<int, 3>{ 0, 0, 0 }));
  this->Display->ReleaseGraphicsResources(this->Window);
  this->Window->Render();
  EXPECT_EQ(this->Pixel(size + size / 4, size / 2), (std::array<int, 3>{ 188, 137, 99 }));
}
