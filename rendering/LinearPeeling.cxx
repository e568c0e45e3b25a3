// SPDX-License-Identifier: BSD-3-Clause
#include "LinearPeeling.h"

#include "vtk_glew.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLActor.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkProp.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

namespace vtkradiometry
{

vtkStandardNewMacro(LinearPeeling);

//------------------------------------------------------------------------------
bool LinearPeeling::PostReplaceShaderValues(
  std::string&, std::string&, std::string& fragmentShader, vtkAbstractMapper*, vtkProp*)
{
  vtkShaderProgram::Substitute(fragmentShader, "//VTK::DepthPeeling::Dec",
    "uniform sampler2D peelingOpaque;\n"
    "uniform sampler2D peelingBefore;\n"
    "uniform int peelingLayer;\n");
  // Where the mapper writes no depth of its own.
  vtkShaderProgram::Substitute(
    fragmentShader, "//VTK::Depth::Impl", "gl_FragDepth = gl_FragCoord.z;\n");
  // The program and the geometry are those of the layer before: the depths agree in all bits.
  vtkShaderProgram::Substitute(fragmentShader, "//VTK::DepthPeeling::Impl",
    "ivec2 peelingTexel = ivec2(gl_FragCoord.xy);\n"
    "  if (gl_FragDepth >= texelFetch(peelingOpaque, peelingTexel, 0).r ||\n"
    "    (peelingLayer > 0 && gl_FragDepth <= texelFetch(peelingBefore, peelingTexel, 0).r))\n"
    "  {\n"
    "    discard;\n"
    "  }\n");
  return true;
}

bool LinearPeeling::SetShaderParameters(
  vtkShaderProgram* program, vtkAbstractMapper*, vtkProp*, vtkOpenGLVertexArrayObject*)
{
  program->SetUniformi("peelingOpaque", this->OpaqueDepth->GetTextureUnit());
  program->SetUniformi("peelingBefore", this->Layers[(this->Layer + 1) % 2].Depth->GetTextureUnit());
  program->SetUniformi("peelingLayer", this->Layer);
  return true;
}

//------------------------------------------------------------------------------
/// Draws the next layer; false where there was nothing left to draw.
bool LinearPeeling::DrawLayer(vtkRenderer* renderer, const vtkRenderState* s)
{
  vtkOpenGLState* state = this->Window->GetState();
  Target& layer = this->Layers[this->Layer % 2];
  Target& before = this->Layers[(this->Layer + 1) % 2];
  layer.Bind(this->Window);
  layer.Clear(this->Window);
  state->vtkglDisable(GL_BLEND);
  this->OpaqueDepth->Activate();
  before.Depth->Activate();
  vtkRenderState inner(renderer);
  inner.SetPropArrayAndCount(s->GetPropArray(), s->GetPropArrayCount());
  inner.SetFrameBuffer(layer.Buffer);
  GLuint query = 0;
  glGenQueries(1, &query);
  glBeginQuery(GL_SAMPLES_PASSED, query);
  this->Translucent->Render(&inner);
  glEndQuery(GL_SAMPLES_PASSED);
  GLuint samples = 0;
  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &samples);
  glDeleteQueries(1, &query);
  before.Depth->Deactivate();
  this->OpaqueDepth->Deactivate();
  return samples > 0;
}

/// One full-screen pass with the current blend function.
void LinearPeeling::Lay(vtkTextureObject* color, const char* implementation, FullScreenPass& pass)
{
  vtkOpenGLState* state = this->Window->GetState();
  if (!pass.Ready(this->Window, FullScreenShader("uniform sampler2D layer;\n", implementation)))
  {
    return;
  }
  state->vtkglEnable(GL_BLEND);
  state->vtkglDisable(GL_DEPTH_TEST);
  color->Activate();
  pass.Quad()->Program->SetUniformi("layer", color->GetTextureUnit());
  pass.Quad()->Render();
  color->Deactivate();
  state->vtkglEnable(GL_DEPTH_TEST);
}

//------------------------------------------------------------------------------
void LinearPeeling::Blend(
  vtkRenderer* renderer, const std::vector<vtkProp*>& props, Target& target)
{
  std::vector<vtkProp*> translucent;
  for (vtkProp* prop : props)
  {
    if (prop->HasTranslucentPolygonalGeometry())
    {
      translucent.push_back(prop);
    }
  }
  if (translucent.empty())
  {
    return;
  }
  this->Window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  this->OpaqueDepth = target.Depth;
  vtkOpenGLState* state = this->Window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  for (Target& layer : this->Layers)
  {
    layer.Allocate(this->Window, target.Width, target.Height, VTK_FLOAT, true);
  }
  this->Sum.Allocate(this->Window, target.Width, target.Height, VTK_FLOAT, false);
  this->Sum.Bind(this->Window);
  this->Sum.Clear(this->Window);

  vtkRenderState s(renderer);
  s.SetPropArrayAndCount(translucent.data(), static_cast<int>(translucent.size()));
  this->PreRender(&s);
  for (vtkProp* prop : translucent)
  {
    prop->GetPropertyKeys()->Set(vtkOpenGLActor::GLDepthMaskOverride(), 1);
  }
  for (this->Layer = 0; this->Layer < MaximumLayers; ++this->Layer)
  {
    if (!this->DrawLayer(renderer, &s))
    {
      break;
    }
    this->Sum.Bind(this->Window);
    state->vtkglBlendFuncSeparate(GL_ONE_MINUS_DST_ALPHA, GL_ONE, GL_ONE_MINUS_DST_ALPHA, GL_ONE);
    this->Lay(this->Layers[this->Layer % 2].Color,
      "  vec4 color = texture(layer, texCoord);\n"
      "  gl_FragData[0] = vec4(color.rgb * color.a, color.a);\n",
      this->Under);
  }
  for (vtkProp* prop : translucent)
  {
    prop->GetPropertyKeys()->Remove(vtkOpenGLActor::GLDepthMaskOverride());
  }
  this->PostRender(&s);
  target.Bind(this->Window);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  this->Lay(this->Sum.Color, "  gl_FragData[0] = texture(layer, texCoord);\n", this->Over);
  this->Window = nullptr;
  this->OpaqueDepth = nullptr;
}

//------------------------------------------------------------------------------
void LinearPeeling::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Translucent->ReleaseGraphicsResources(window);
  for (Target* target : { &this->Layers[0], &this->Layers[1], &this->Sum })
  {
    target->Release(window);
  }
  this->Under.Release();
  this->Over.Release();
}

} // namespace vtkradiometry
