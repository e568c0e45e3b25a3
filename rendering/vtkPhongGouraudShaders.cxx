// SPDX-License-Identifier: BSD-3-Clause
// The shader text of vtkPhongGouraudHelper: what of rendering/glsl goes where in VTK's templates.
#include "vtkPhongGouraudHelper.h"

#include "vtkPhongGouraudMapper.h"

#include "vtkPhongGouraudFS.h"
#include "vtkPhongGouraudFSDec.h"
#include "vtkPhongGouraudGS.h"
#include "vtkPhongGouraudGSDec.h"
#include "vtkPhongGouraudVS.h"
#include "vtkPhongGouraudVSDec.h"
#include "vtkRadiometryExtendedLights.h"
#include "vtkRadiometryLightSums.h"
#include "vtkRadiometryLights.h"

#include "vtkActor.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"

using vtkradiometry::ExpandShader;
using vtkradiometry::ShaderFeatures;

namespace
{

bool Has(const ShaderFeatures& features, const char* name)
{
  return features.count(name) != 0;
}

void Replace(vtkShader* shader, const char* tag, const std::string& text)
{
  std::string source = shader->GetSource();
  vtkShaderProgram::Substitute(source, tag, text, false);
  shader->SetSource(source);
}

/// The lighting model.
std::string LightText(const ShaderFeatures& features)
{
  return ExpandShader(vtkRadiometryLights, features) +
    ExpandShader(vtkRadiometryExtendedLights, features) +
    ExpandShader(vtkRadiometryLightSums, features);
}

} // namespace

void vtkPhongGouraudHelper::BuildShaders(ShaderMap shaders, vtkRenderer* ren, vtkActor* act)
{
  this->Superclass::BuildShaders(shaders, ren, act);
  if (this->Ours)
  {
    vtkPhongGouraudMapper* mapper = this->Mapper();
    mapper->VertexShaderText = shaders[vtkShader::Vertex]->GetSource();
    mapper->FragmentShaderText = shaders[vtkShader::Fragment]->GetSource();
    ++mapper->NumberOfShaderBuilds;
  }
}

void vtkPhongGouraudHelper::ReplaceShaderValues(
  ShaderMap shaders, vtkRenderer* ren, vtkActor* act)
{
  if (!this->Ours)
  {
    this->Superclass::ReplaceShaderValues(shaders, ren, act);
    return;
  }
  // VTK hands positions (view coordinates) to the fragment shader only where it counts lights of its
  // own. These shaders have theirs; render passes such as SSAO may read VTK's.
  vtkInformation* keys = act->GetPropertyKeys();
  const bool passes = keys && keys->Has(vtkOpenGLRenderPass::RenderPasses());
  int& complexity = this->PrimitiveInfo[this->LastBoundBO].LastLightComplexity;
  const int saved = complexity;
  complexity = passes ? 3 : 0;
  this->Superclass::ReplaceShaderValues(shaders, ren, act);
  complexity = saved;
}

void vtkPhongGouraudHelper::ReplaceShaderColor(ShaderMap shaders, vtkRenderer* ren, vtkActor* act)
{
  if (!this->Ours)
  {
    this->Superclass::ReplaceShaderColor(shaders, ren, act);
    return;
  }
  int& complexity = this->PrimitiveInfo[this->LastBoundBO].LastLightComplexity;
  const int saved = complexity;
  complexity = Has(this->Features, "Specular") ? 3 : 0;
  this->Superclass::ReplaceShaderColor(shaders, ren, act);
  complexity = saved;
  if (Has(this->Features, "Mirrored"))
  {
    // A mirrored actor shows its fronts with the other winding.
    std::string source = shaders[vtkShader::Fragment]->GetSource();
    vtkShaderProgram::Substitute(source, "gl_FrontFacing == false", "gl_FrontFacing == true");
    shaders[vtkShader::Fragment]->SetSource(source);
  }
}

void vtkPhongGouraudHelper::ReplaceShaderEdges(ShaderMap shaders, vtkRenderer* ren, vtkActor* act)
{
  this->Superclass::ReplaceShaderEdges(shaders, ren, act);
  if (this->Ours)
  {
    // VTK mixes the edges into the material, before light; here they lie on the finished colour.
    // Their weight is emix, from VTK 9.3 on times the edges' opacity.
    std::string source = shaders[vtkShader::Fragment]->GetSource();
    const std::string before = "  diffuseColor = mix(diffuseColor, vec3(0.0), ";
    const std::size_t begin = source.find(before);
    const std::size_t end = source.find(");\n", begin);
    if (begin != std::string::npos && end != std::string::npos)
    {
      const std::string weight =
        source.substr(begin + before.size(), end - begin - before.size());
      source.replace(begin, end + 3 - begin, "  emix = " + weight + ";\n");
      vtkShaderProgram::Substitute(
        source, "  ambientColor = mix( ambientColor, edgeColor, " + weight + ");\n", "");
      shaders[vtkShader::Fragment]->SetSource(source);
    }
  }
}

void vtkPhongGouraudHelper::ReplaceShaderNormal(
  ShaderMap shaders, vtkRenderer* ren, vtkActor* act)
{
  if (!this->Ours)
  {
    this->Superclass::ReplaceShaderNormal(shaders, ren, act);
    return;
  }
  const bool fragment =
    Has(this->Features, "FragmentNormal") && !Has(this->Features, "CellFrame");
  if (fragment || Has(this->Features, "PerVertex"))
  {
    Replace(shaders[vtkShader::Vertex], "//VTK::Normal::Dec",
      "in vec3 normalMC;\nuniform mat3 normalMatrix;\n//VTK::Normal::Dec");
  }
  if (fragment)
  {
    Replace(shaders[vtkShader::Vertex], "//VTK::Normal::Dec", "out vec3 normalVCVSOutput;");
    Replace(shaders[vtkShader::Vertex], "//VTK::Normal::Impl",
      "normalVCVSOutput = normalMatrix * normalMC;");
    Replace(shaders[vtkShader::Geometry], "//VTK::Normal::Dec",
      "in vec3 normalVCVSOutput[];\nout vec3 normalVCGSOutput;");
    Replace(shaders[vtkShader::Geometry], "//VTK::Normal::Impl",
      "normalVCGSOutput = normalVCVSOutput[i];");
    Replace(shaders[vtkShader::Fragment], "//VTK::Normal::Dec", "in vec3 normalVCVSOutput;");
  }
}

void vtkPhongGouraudHelper::ReplaceShaderLight(ShaderMap shaders, vtkRenderer* ren, vtkActor* act)
{
  if (!this->Ours)
  {
    this->Superclass::ReplaceShaderLight(shaders, ren, act);
    return;
  }
  ShaderFeatures features = this->Features;
  if (shaders[vtkShader::Fragment]->GetSource().find("uniform bool OverridesColor") !=
    std::string::npos)
  {
    features.insert("BlockColors"); // a block's own colour goes before its scalars
  }
  // The functions go where the lights are summed, and only there.
  ShaderFeatures vertex = features;
  ShaderFeatures fragment = features;
  if (Has(features, "PerVertex"))
  {
    if (Has(features, "TwoSided"))
    {
      vertex.insert("BothSides");
    }
  }
  if (Has(features, "PerVertex") && !Has(features, "PerTriangle"))
  {
    fragment.erase("Lights");
    fragment.erase("Finite");
    fragment.erase("NeedsPower");
    fragment.erase("Spot");
    fragment.erase("NeedsNormal");
  }
  if (!Has(features, "PerVertex"))
  {
    vertex.erase("Lights");
    vertex.erase("NeedsNormal");
    vertex.erase("Finite");
    vertex.erase("NeedsPower");
    vertex.erase("Spot");
  }
  Replace(shaders[vtkShader::Vertex], "//VTK::Light::Dec",
    ExpandShader(vtkPhongGouraudVSDec, features) + LightText(vertex));
  Replace(shaders[vtkShader::Vertex], "//VTK::Light::Impl",
    ExpandShader(vtkPhongGouraudVS, vertex));
  Replace(shaders[vtkShader::Geometry], "//VTK::Light::Dec",
    ExpandShader(vtkPhongGouraudGSDec, features));
  Replace(shaders[vtkShader::Geometry], "//VTK::Light::Impl",
    ExpandShader(vtkPhongGouraudGS, features));
  Replace(shaders[vtkShader::Fragment], "//VTK::Light::Dec",
    ExpandShader(vtkPhongGouraudFSDec, features) + LightText(fragment));
  Replace(shaders[vtkShader::Fragment], "//VTK::Light::Impl",
    ExpandShader(vtkPhongGouraudFS, features));
}
