// SPDX-License-Identifier: BSD-3-Clause
// Private to rendering/: which props give light, and drawing some of a renderer's props only.
#ifndef PropGroups_h
#define PropGroups_h

#include <vector>

class vtkProp;
class vtkRenderer;
class vtkRenderState;

namespace vtkradiometry
{

/// The props of one frame, each group in the renderer's order.
struct PropGroups
{
  std::vector<vtkProp*> Linear; ///< their colours are scene-linear light
  std::vector<vtkProp*> Other;  ///< in the display's own colours, in three dimensions
  std::vector<vtkProp*> Flat;   ///< what only overlays: texts, legends, charts
  std::vector<vtkProp*> All;

  /// `all`: whatever is no overlay counts as light.
  PropGroups(const vtkRenderState* s, bool all);
  bool LinearIsTranslucent() const;
  bool OtherIsOpaque() const;
  bool OtherIsTranslucent() const;
};

/// Whether every surface of a prop is drawn by a vtkPhongGouraudMapper whose colours are light.
bool IsSceneLinear(vtkProp* prop);

/// While it lives, the renderer draws these props only, also in passes that ask the renderer itself
/// and not the render state (vtkPVDefaultPass).
class OnlyThese
{
public:
  OnlyThese(vtkRenderer* renderer, std::vector<vtkProp*>& props);
  ~OnlyThese();
  OnlyThese(const OnlyThese&) = delete;
  void operator=(const OnlyThese&) = delete;

private:
  vtkRenderer* Renderer;
  vtkProp** Props;
  int Count;
};

} // namespace vtkradiometry

#endif
