// SPDX-License-Identifier: BSD-3-Clause
// Private to rendering/: the steps of a frame of vtkLinearFloatPass.
#ifndef LinearFloatParts_h
#define LinearFloatParts_h

#include "DisplayPassParts.h"
#include "FloatTarget.h"
#include "LinearPeeling.h"
#include "PropGroups.h"
#include "vtkLinearFloatPass.h"

#include "vtkImageData.h"
#include "vtkLightsPass.h"
#include "vtkNew.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkTranslucentPass.h"
#include "vtkVolumetricPass.h"
#include "vtkWeakPointer.h"

#include <vector>

struct vtkLinearFloatPass::Internals
{
  using Area = displaypass::Area;
  using FullScreenPass = vtkradiometry::FullScreenPass;
  using PropGroups = vtkradiometry::PropGroups;
  using Target = vtkradiometry::Target;

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  Target Light; ///< all light, Samples x Samples texels a pixel
  Target Seen;  ///< the light that others leave, where depth cannot tell
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

#endif
// VTK-HeaderTest-Exclude: LinearFloatParts.h
