// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPhongGouraudMapper.h"

#include "vtkLinearFloatPass.h"
#include "vtkPhongGouraudHelper.h"

#include "radiometry/effects/EffectPlan.h"

#include "vtkDataArray.h"
#include "vtkHardwareSelector.h"
#include "vtkImageData.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkPhongGouraudMapper);
vtkInformationKeyRestrictedMacro(vtkPhongGouraudMapper, LIGHT_DATA, ObjectBase, "vtkDataObject");

vtkPhongGouraudMapper::vtkPhongGouraudMapper()
  : EffectSwitches(radiometry::EffectCount, EFFECT_AUTO)
{
}

vtkPhongGouraudMapper::~vtkPhongGouraudMapper() = default;

vtkPhongGouraudProduct* vtkPhongGouraudMapper::vtkPhongGouraudFactory()
{
  return vtkradiometry::NewProduct<vtkPhongGouraudHelper>();
}

void vtkPhongGouraudMapper::Render(vtkRenderer* renderer, vtkActor* actor)
{
  vtkRenderWindow* window = renderer->GetRenderWindow();
  auto* last = vtkOpenGLRenderWindow::SafeDownCast(this->Window);
  if (last && last != window)
  {
    last->PushContext();
    this->ReleaseGraphicsResources(last);
    last->PopContext();
  }
  this->Window = window;
  this->GouraudTriangles = 0.0;
  this->CountedTriangles = 0.0;
  if (!renderer->GetSelector())
  {
    this->FramePlans.clear();
  }
  this->Superclass::Render(renderer, actor);
}

void vtkPhongGouraudMapper::ShallowCopy(vtkAbstractMapper* other)
{
  if (auto* own = vtkPhongGouraudMapper::SafeDownCast(other))
  {
    this->SetShading(own->Shading);
    this->SetReflectionModel(own->ReflectionModel);
    this->SetGlobalAmbient(own->GlobalAmbient);
    this->SetLocalViewer(own->LocalViewer);
    this->SetTwoSided(own->TwoSided);
    this->SetEmission(own->Emission);
    this->SetBackEmission(own->BackEmission);
    this->SetLightData(own->LightData);
    this->SetLightScale(own->LightScale);
    this->SetMetersPerUnit(own->MetersPerUnit);
    this->SetFieldMode(own->FieldMode);
    this->SetFieldArrayName(own->FieldArrayName.c_str());
    this->SetFieldAssociation(own->FieldAssociation);
    this->SetFieldScale(own->FieldScale);
    this->SetHighlights(own->Highlights);
    this->SetUseLightVisibility(own->UseLightVisibility);
    this->SetEveryEffect(own->EveryEffect);
    if (this->EffectSwitches != own->EffectSwitches)
    {
      this->EffectSwitches = own->EffectSwitches;
      this->BufferTime.Modified();
      this->Modified();
    }
    this->SetEffectTolerance(own->EffectTolerance);
    this->SetShadingTolerance(own->ShadingTolerance);
    this->SetShadingTimeShare(own->ShadingTimeShare);
  }
  this->Superclass::ShallowCopy(other);
}

double vtkPhongGouraudMapper::MeasureGreatestDifference(vtkRenderer* renderer)
{
  this->GreatestDifference = -1.0;
  vtkRenderWindow* window = renderer ? renderer->GetRenderWindow() : nullptr;
  if (!window)
  {
    return this->GreatestDifference;
  }
  const vtkSmartPointer<vtkRenderPass> pass = renderer->GetPass();
  const int shading = this->Shading;
  const double share = this->ShadingTimeShare;
  const double effects = this->EffectTolerance;
  vtkNew<vtkLinearFloatPass> target;
  renderer->SetPass(target);
  const auto draw = [&]() {
    window->Render();
    vtkImageData* color = target->GetColor();
    vtkDataArray* values = color ? color->GetPointData()->GetScalars() : nullptr;
    vtkSmartPointer<vtkDataArray> copy;
    if (values)
    {
      copy.TakeReference(values->NewInstance());
      copy->DeepCopy(values);
    }
    return copy;
  };
  this->SetShadingTimeShare(VTK_DOUBLE_MAX);
  const vtkSmartPointer<vtkDataArray> given = draw();
  this->SetShading(PHONG);
  this->SetEffectTolerance(0.0);
  const vtkSmartPointer<vtkDataArray> phong = draw();
  this->SetEffectTolerance(effects);
  this->SetShading(shading);
  this->SetShadingTimeShare(share);
  renderer->SetPass(pass);
  target->ReleaseGraphicsResources(window);
  if (given && phong && given->GetNumberOfValues() == phong->GetNumberOfValues())
  {
    double most = 0.0;
    for (vtkIdType i = 0; i < given->GetNumberOfTuples(); ++i)
    {
      for (int c = 0; c < 3; ++c)
      {
        most = std::max(most, std::abs(given->GetComponent(i, c) - phong->GetComponent(i, c)));
      }
    }
    this->GreatestDifference = most;
  }
  return this->GreatestDifference;
}

void vtkPhongGouraudMapper::SetShading(int shading)
{
  shading = std::clamp<int>(shading, FLAT, AUTO);
  if (this->Shading != shading)
  {
    this->Shading = shading;
    this->BufferTime.Modified();
    this->Modified();
  }
}

void vtkPhongGouraudMapper::SetFieldMode(int mode)
{
  mode = std::clamp<int>(mode, FIELD_OFF, FIELD_FALSE_COLOR);
  if (this->FieldMode != mode)
  {
    this->FieldMode = mode;
    this->BufferTime.Modified();
    this->Modified();
  }
}

void vtkPhongGouraudMapper::SetFieldArrayName(const char* name)
{
  const std::string text = name ? name : "";
  if (this->FieldArrayName != text)
  {
    this->FieldArrayName = text;
    this->BufferTime.Modified();
    this->Modified();
  }
}

void vtkPhongGouraudMapper::SetFieldAssociation(int association)
{
  association = std::clamp(association, -1, 1);
  if (this->FieldAssociation != association)
  {
    this->FieldAssociation = association;
    this->BufferTime.Modified();
    this->Modified();
  }
}

void vtkPhongGouraudMapper::SetHighlights(bool on)
{
  if (this->Highlights != on)
  {
    this->Highlights = on;
    this->BufferTime.Modified();
    this->Modified();
  }
}

void vtkPhongGouraudMapper::SetUseLightVisibility(bool on)
{
  if (this->UseLightVisibility != on)
  {
    this->UseLightVisibility = on;
    this->BufferTime.Modified();
    this->Modified();
  }
}

void vtkPhongGouraudMapper::SetLightData(vtkPolyData* lights)
{
  if (this->LightData != lights)
  {
    this->LightData = lights;
    this->Modified();
  }
}

vtkPolyData* vtkPhongGouraudMapper::GetLightData()
{
  return this->LightData;
}

void vtkPhongGouraudMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* shadings[] = { "Flat", "Gouraud", "Phong", "Auto" };
  const char* models[] = { "BlinnPhong", "Phong", "Physical" };
  const char* modes[] = { "Off", "On", "Normals", "Reflectance", "Materials", "FalseColor" };
  os << indent << "Shading: " << shadings[this->Shading] << " (last frame "
     << shadings[this->ShadingUsed] << ")\n";
  os << indent << "ReflectionModel: " << models[this->ReflectionModel] << "\n";
  os << indent << "LocalViewer: " << this->LocalViewer << "\n";
  os << indent << "TwoSided: " << this->TwoSided << "\n";
  os << indent << "LightScale: " << this->LightScale << "\n";
  os << indent << "MetersPerUnit: " << this->MetersPerUnit << "\n";
  os << indent << "FieldMode: " << modes[this->FieldMode] << "\n";
  os << indent << "FieldArrayName: " << this->FieldArrayName << "\n";
  os << indent << "FieldAssociation: " << this->FieldAssociation << "\n";
  os << indent << "FieldScale: " << this->FieldScale << "\n";
  os << indent << "Highlights: " << this->Highlights << "\n";
  os << indent << "UseLightVisibility: " << this->UseLightVisibility << "\n";
  os << indent << "EveryEffect: " << this->EveryEffect << "\n";
  os << indent << "EffectTolerance: " << this->EffectTolerance << "\n";
  os << indent << "ShadingTolerance: " << this->ShadingTolerance << "\n";
  os << indent << "ShadingTimeShare: " << this->ShadingTimeShare << "\n";
  os << indent << "GouraudShare: " << this->GetGouraudShare() << "\n";
  os << indent << "ShadingReason: " << this->ShadingReason << "\n";
  os << indent << "GreatestDifference: " << this->GreatestDifference << "\n";
  os << indent << "LightData: " << this->LightData.Get() << "\n";
  os << indent << "ShaderFeatures: " << this->ShaderFeatureText << "\n";
}
