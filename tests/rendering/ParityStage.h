// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ParityScene.h"

#include "rendering/vtkLinearFloatPass.h"
#include "rendering/vtkPhongGouraudMapper.h"

#include "vtkActor.h"
#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

/// Draws parity scenes: one window for all of them, a mapper each.
class ParityStage
{
public:
  explicit ParityStage(int size);
  void Set(const ParityScene& scene);
  /// RGBA in float, the first row at the bottom; valid until the next call.
  const float* Draw();
  /// Depths of what Draw() drew.
  const float* GetDepth();
  /// The graphics processor or what stands for it.
  std::string GetRenderer();
  vtkPhongGouraudMapper* GetMapper() { return this->Mapper; }

private:
  void SetSurface(const ParityScene& scene);
  void SetProperties(const ParityScene& scene);
  void SetLights(const ParityScene& scene);
  void SetCamera(const ParityScene& scene);

  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkLinearFloatPass> Pass;
  vtkNew<vtkActor> Actor;
  vtkSmartPointer<vtkPhongGouraudMapper> Mapper;
};
