// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPhongGouraudHelper.h"

#include "vtkPhongGouraudMapper.h"

#include "vtk_glew.h"

#include "vtkCamera.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLActor.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexBufferObject.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>

vtkStandardNewMacro(vtkPhongGouraudHelper);

vtkPhongGouraudHelper::~vtkPhongGouraudHelper()
{
  for (FloatBuffer* buffer : this->Buffers())
  {
    buffer->Free();
  }
}

vtkPhongGouraudMapper* vtkPhongGouraudHelper::Mapper() const
{
  return static_cast<vtkPhongGouraudMapper*>(this->Parent);
}

std::vector<vtkradiometry::DrawnBlock*> vtkPhongGouraudHelper::Blocks() const
{
  std::vector<vtkradiometry::DrawnBlock*> blocks;
  for (const auto& entry : this->vtkPhongGouraudBlocks)
  {
    blocks.push_back(&*entry.second); // a plain pointer in VTK 9.2, std::unique_ptr in 9.3
  }
  return blocks;
}

//------------------------------------------------------------------------------
// Uniforms
//------------------------------------------------------------------------------
void vtkPhongGouraudHelper::SetPropertyShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act)
{
  int& complexity = this->PrimitiveInfo[&cellBO].LastLightComplexity;
  const int saved = complexity;
  if (this->Ours)
  {
    complexity = 3;
  }
  this->Superclass::SetPropertyShaderParameters(cellBO, ren, act);
  complexity = saved;
  vtkShaderProgram* program = cellBO.Program;
  vtkProperty* back = act->GetBackfaceProperty();
  if (this->Ours && back && !program->IsUniformUsed("ambientIntensityBF"))
  {
    // VTK 9.2 and 9.3 set what is left of the back's uniforms only where that one is in use.
    const auto number = [program](const char* name, double value) {
      if (program->IsUniformUsed(name))
      {
        program->SetUniformf(name, static_cast<float>(value));
      }
    };
    const auto color = [program](const char* name, const double* value) {
      if (program->IsUniformUsed(name))
      {
        program->SetUniform3f(name, value);
      }
    };
    number("opacityUniformBF", back->GetOpacity());
    number("diffuseIntensityBF", back->GetDiffuse());
    color("diffuseColorUniformBF", back->GetDiffuseColor());
    number("specularIntensityBF", back->GetSpecular());
    color("specularColorUniformBF", back->GetSpecularColor());
    number("specularPowerUniformBF", back->GetSpecularPower());
  }
}

void vtkPhongGouraudHelper::SetLightingShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act)
{
  if (!this->Ours)
  {
    this->Superclass::SetLightingShaderParameters(cellBO, ren, act);
    return;
  }
  vtkShaderProgram* program = cellBO.Program;
  vtkPhongGouraudMapper* mapper = this->Mapper();
  const auto bind = [program](const char* name, FloatBuffer& buffer) {
    if (buffer.Texture && program->IsUniformUsed(name))
    {
      program->SetUniformi(name, buffer.Texture->GetTextureUnit());
    }
  };
  bind("radiometryLights", this->LightBuffer);
  bind("radiometryCellFrames", this->FrameBuffer);
  bind("radiometryField", this->FieldBuffer);
  bind("radiometryShading", this->ShadingBuffer);
  bind("radiometryMaterials", this->MaterialBuffer);
  bind("radiometryMaterialOfCell", this->MaterialOfCellBuffer);
  bind("radiometryColorSteps", this->StepBuffer);
  bind("radiometryCellColors", this->CellColorBuffer);
  bind("radiometryVisibility", this->VisibilityBuffer);
  if (program->IsUniformUsed("visibilityTexels"))
  {
    const int groups = static_cast<int>((this->VisibilityKeys.size() + 3) / 4);
    const int texels[2] = { groups, this->VisibilityOfBack ? 2 * groups : groups };
    program->SetUniform2i("visibilityTexels", texels);
  }
  if (program->IsUniformUsed("numberOfColorSteps"))
  {
    program->SetUniformi("numberOfColorSteps", static_cast<int>(this->Steps.GetNumberOfSteps()));
  }
  const char* ranges[] = { "directionalRange", "pointRange", "spotRange", "luminaireRange",
    "areaRange", "skyRange" };
  for (int kind = 0; kind < 6; ++kind)
  {
    if (program->IsUniformUsed(ranges[kind]))
    {
      program->SetUniform2i(ranges[kind], this->Lights.Ranges[kind].data());
    }
  }
  const auto color = [program](const char* name, const double* value) {
    if (program->IsUniformUsed(name))
    {
      program->SetUniform3f(name, value);
    }
  };
  color("globalAmbient", mapper->GlobalAmbient);
  color("emission", mapper->Emission);
  color("backEmission", mapper->BackEmission);
  if (program->IsUniformUsed("fieldScale"))
  {
    program->SetUniformf("fieldScale", static_cast<float>(mapper->FieldScale));
  }
  if (program->IsUniformUsed("viewToWorld"))
  {
    // SetUniformMatrix hands rows over as columns: the rotation to view becomes its inverse.
    vtkMatrix4x4* worldToView = ren->GetActiveCamera()->GetModelViewTransformMatrix();
    vtkNew<vtkMatrix3x3> rotation;
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        rotation->SetElement(i, j, worldToView->GetElement(i, j));
      }
    }
    program->SetUniformMatrix("viewToWorld", rotation);
  }
}

void vtkPhongGouraudHelper::SetCameraShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act)
{
  this->Superclass::SetCameraShaderParameters(cellBO, ren, act);
  vtkShaderProgram* program = cellBO.Program;
  if (this->Ours && program->IsUniformUsed("MCLCMatrix"))
  {
    program->SetUniformMatrix("MCLCMatrix", this->Local.FromBuffer);
  }
  if (this->Ours && program->IsUniformUsed("eyeLC"))
  {
    program->SetUniform3f("eyeLC", this->Local.Eye.data());
  }
}

//------------------------------------------------------------------------------
// Lights
//------------------------------------------------------------------------------
void vtkPhongGouraudHelper::PlaceOrigin(vtkRenderer* ren, vtkMatrix4x4* objectToWorld)
{
  // VTK stores coordinates as (p - shift) scale, with the middle of the bounds as shift. That middle
  // is the origin; so buffers need a linear map alone.
  double origin[4] = { 0.0, 0.0, 0.0, 1.0 };
  double scale[3] = { 1.0, 1.0, 1.0 };
  vtkOpenGLVertexBufferObject* positions = this->VBOs->GetVBO("vertexMC");
  if (positions && positions->GetCoordShiftAndScaleEnabled())
  {
    std::copy_n(positions->GetShift().begin(), 3, origin);
    std::copy_n(positions->GetScale().begin(), 3, scale);
  }
  objectToWorld->MultiplyPoint(origin, origin);
  vtkMatrix4x4* worldToView = ren->GetActiveCamera()->GetModelViewTransformMatrix();
  vtkMatrix4x4* worldToLocal = this->Local.FromWorld;
  vtkMatrix4x4* viewToLocal = this->Local.FromView;
  worldToLocal->DeepCopy(worldToView);
  viewToLocal->Identity();
  for (int i = 0; i < 3; ++i)
  {
    double shift = 0.0;
    for (int j = 0; j < 3; ++j)
    {
      double ofObject = 0.0;
      for (int k = 0; k < 3; ++k)
      {
        ofObject += worldToView->GetElement(i, k) * objectToWorld->GetElement(k, j);
      }
      this->Local.FromBuffer->SetElement(j, i, ofObject / scale[j]); // transposed, as GLSL reads it
      shift += worldToView->GetElement(i, j) * origin[j];
    }
    worldToLocal->SetElement(i, 3, -shift);
    const double eye = -shift - worldToView->GetElement(i, 3);
    viewToLocal->SetElement(i, 3, eye);
    this->Local.Eye[i] = static_cast<float>(eye);
  }
}

vtkradiometry::CollectedLights vtkPhongGouraudHelper::CollectLights(vtkRenderer* ren)
{
  vtkPhongGouraudMapper* mapper = this->Mapper();
  const auto model = static_cast<radiometry::ReflectionModel>(mapper->ReflectionModel);
  vtkDataObject* data = mapper->LightData;
  vtkInformation* shown = ren->GetInformation();
  if (!data && shown && shown->Has(vtkPhongGouraudMapper::LIGHT_DATA()))
  {
    data = vtkDataObject::SafeDownCast(shown->Get(vtkPhongGouraudMapper::LIGHT_DATA()));
  }
  vtkradiometry::CollectedLights collected = data
    ? vtkradiometry::CollectFromData(data)
    : vtkradiometry::CollectFromRenderer(ren, model == radiometry::ReflectionModel::Physical);
  if (!collected.Problem.empty() && collected.Problem != mapper->ReportedProblem)
  {
    vtkErrorWithObjectMacro(mapper, << collected.Problem);
  }
  mapper->ReportedProblem = collected.Problem;
  this->AssignVisibility(collected);
  return collected;
}

void vtkPhongGouraudHelper::PackLights(
  vtkActor* act, const vtkradiometry::CollectedLights& collected)
{
  vtkPhongGouraudMapper* mapper = this->Mapper();
  vtkNew<vtkMatrix4x4> objectToWorld;
  act->GetModelToWorldMatrix(objectToWorld);
  this->Lights = vtkradiometry::PackLights(collected, this->Local, objectToWorld,
    static_cast<radiometry::ReflectionModel>(mapper->ReflectionModel), mapper->LightScale,
    mapper->MetersPerUnit);
  mapper->NumberOfLightsDrawn = this->Lights.Count();
  mapper->NumberOfLightsNotDrawn = collected.NotDrawn;
}

//------------------------------------------------------------------------------
// Drawing
//------------------------------------------------------------------------------
void vtkPhongGouraudHelper::RenderPieceStart(vtkRenderer* ren, vtkActor* act)
{
  this->Superclass::RenderPieceStart(ren, act);
  if (!ren->GetSelector())
  {
    // After the buffers: the lights' coordinates are theirs.
    vtkradiometry::CollectedLights collected = this->CollectLights(ren);
    this->PlanEffects(ren, act, collected);
    vtkNew<vtkMatrix4x4> objectToWorld;
    act->GetModelToWorldMatrix(objectToWorld);
    this->PlaceOrigin(ren, objectToWorld);
    this->PackLights(act, collected);
    this->DecideShading(ren, act, collected);
    if (this->Effects.LeavesOut(radiometry::Effect::Translucency))
    {
      // Drawn among translucent surfaces, but hides what is behind.
      static_cast<vtkOpenGLRenderer*>(ren)->GetState()->vtkglDepthMask(GL_TRUE);
    }
    this->LightBuffer.Upload(ren, std::vector<float>(this->Lights.Texels));
    for (FloatBuffer* buffer : this->Buffers())
    {
      buffer->Activate();
    }
  }
}

void vtkPhongGouraudHelper::RenderPieceFinish(vtkRenderer* ren, vtkActor* act)
{
  this->Superclass::RenderPieceFinish(ren, act);
  if (!ren->GetSelector())
  {
    this->ReportShading();
    for (FloatBuffer* buffer : this->Buffers())
    {
      buffer->Deactivate();
    }
  }
}

void vtkPhongGouraudHelper::ReleaseGraphicsResources(vtkWindow* win)
{
  for (FloatBuffer* buffer : this->Buffers())
  {
    buffer->Release(win);
  }
  this->Signatures.clear();
  this->Superclass::ReleaseGraphicsResources(win);
}

void vtkPhongGouraudHelper::FloatBuffer::Upload(vtkRenderer* ren, std::vector<float>&& values)
{
  if (values.empty() || (this->Texture && values == this->Values))
  {
    return;
  }
  if (!this->Texture)
  {
    this->Texture = vtkTextureObject::New();
    this->Buffer = vtkOpenGLBufferObject::New();
    this->Buffer->SetType(vtkOpenGLBufferObject::TextureBuffer);
  }
  this->Values = std::move(values);
  this->Texture->SetContext(static_cast<vtkOpenGLRenderWindow*>(ren->GetVTKWindow()));
  this->Buffer->Upload(this->Values, vtkOpenGLBufferObject::TextureBuffer);
  this->Texture->CreateTextureBuffer(
    static_cast<unsigned int>(this->Values.size() / 4), 4, VTK_FLOAT, this->Buffer);
}

void vtkPhongGouraudHelper::FloatBuffer::Activate()
{
  if (this->Texture)
  {
    this->Texture->Activate();
  }
}

void vtkPhongGouraudHelper::FloatBuffer::Deactivate()
{
  if (this->Texture)
  {
    this->Texture->Deactivate();
  }
}

void vtkPhongGouraudHelper::FloatBuffer::Release(vtkWindow* win)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(win);
    this->Buffer->ReleaseGraphicsResources();
  }
  this->Free();
}

void vtkPhongGouraudHelper::FloatBuffer::Free()
{
  if (this->Texture)
  {
    this->Texture->Delete();
    this->Buffer->Delete();
  }
  this->Texture = nullptr;
  this->Buffer = nullptr;
  this->Values.clear();
}
