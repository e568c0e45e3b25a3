// SPDX-License-Identifier: BSD-3-Clause
// Private to rendering/: translucent surfaces blended in the right order, in floats.
#ifndef LinearPeeling_h
#define LinearPeeling_h

#include "FloatTarget.h"

#include "vtkNew.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkTranslucentPass.h"

#include <vector>

class vtkProp;

namespace vtkradiometry
{

/// Depth peeling into float targets: the nearest translucent fragment of each texel first, then the
/// nearest behind it, until nothing is left or MaximumLayers are drawn. VTK's own peeling blends in
/// bytes.
///   Cost    one drawing of the translucent props a layer; 56 bytes a texel
///   Source  C. Everitt, Interactive Order-Independent Transparency, NVIDIA 2001
class LinearPeeling : public vtkOpenGLRenderPass
{
public:
  static LinearPeeling* New();
  vtkTypeMacro(LinearPeeling, vtkOpenGLRenderPass);

  static constexpr int MaximumLayers = 64;

  /// Blends the translucent ones of `props` over the colour of `target`, in front of its depth,
  /// which stays. The target is the current frame buffer, also afterwards.
  void Blend(vtkRenderer* renderer, const std::vector<vtkProp*>& props, Target& target);
  void Render(const vtkRenderState*) override {}
  void ReleaseGraphicsResources(vtkWindow* window) override;

  bool PostReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override;
  bool SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop,
    vtkOpenGLVertexArrayObject* VAO) override;

private:
  bool DrawLayer(vtkRenderer* renderer, const vtkRenderState* s);
  void Lay(vtkTextureObject* color, const char* implementation, FullScreenPass& pass);

  Target Layers[2];
  Target Sum; ///< of the layers so far, nearest first; multiplied by alpha
  FullScreenPass Under;
  FullScreenPass Over;
  vtkNew<vtkTranslucentPass> Translucent;
  vtkOpenGLRenderWindow* Window = nullptr; // while Blend runs
  vtkTextureObject* OpaqueDepth = nullptr;
  int Layer = 0;
};

} // namespace vtkradiometry

#endif
