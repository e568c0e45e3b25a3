// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiometricSurfaceRepresentation.h"

#include "FieldOfData.h"
#include "SmoothField.h"

#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVView.h"
#include "vtkPhongGouraudMapper.h"

#include <algorithm>

vtkStandardNewMacro(vtkRadiometricSurfaceRepresentation);

namespace
{

/// Calls f on each of the mappers that are the project's own (all of them).
template <typename F>
void ForEach(std::initializer_list<vtkMapper*> mappers, const F& f)
{
  for (vtkMapper* mapper : mappers)
  {
    if (auto* own = vtkPhongGouraudMapper::SafeDownCast(mapper))
    {
      f(own);
    }
  }
}

void ReplaceMapper(vtkMapper*& mapper)
{
  if (mapper)
  {
    mapper->Delete();
  }
  mapper = vtkPhongGouraudMapper::New();
}

} // namespace

vtkRadiometricSurfaceRepresentation::vtkRadiometricSurfaceRepresentation()
{
  ReplaceMapper(this->Mapper);
  ReplaceMapper(this->LODMapper);
  ReplaceMapper(this->BackfaceMapper);
  ReplaceMapper(this->LODBackfaceMapper);
  auto* mapper = vtkPhongGouraudMapper::SafeDownCast(this->Mapper);
  mapper->SetProcessIdArrayName("vtkProcessId");
  mapper->SetCompositeIdArrayName("vtkCompositeIndex");
  this->SetArrayIdNames(nullptr, nullptr);
  this->SetupDefaults();
}

vtkRadiometricSurfaceRepresentation::~vtkRadiometricSurfaceRepresentation() = default;

#define vtkForwardToMappers(call)                                                                  \
  ForEach(                                                                                         \
    { this->Mapper, this->LODMapper, this->BackfaceMapper, this->LODBackfaceMapper },              \
    [&](vtkPhongGouraudMapper* mapper) { mapper->call; })

void vtkRadiometricSurfaceRepresentation::SetShading(int shading)
{
  vtkForwardToMappers(SetShading(shading));
}

void vtkRadiometricSurfaceRepresentation::SetShadingTolerance(double tolerance)
{
  vtkForwardToMappers(SetShadingTolerance(tolerance));
}

void vtkRadiometricSurfaceRepresentation::SetShadingTimeShare(double share)
{
  vtkForwardToMappers(SetShadingTimeShare(share));
}

void vtkRadiometricSurfaceRepresentation::SetReflectionModel(int model)
{
  vtkForwardToMappers(SetReflectionModel(model));
}

void vtkRadiometricSurfaceRepresentation::SetLocalViewer(bool local)
{
  vtkForwardToMappers(SetLocalViewer(local));
}

void vtkRadiometricSurfaceRepresentation::SetTwoSided(bool twoSided)
{
  vtkForwardToMappers(SetTwoSided(twoSided));
}

void vtkRadiometricSurfaceRepresentation::SetGlobalAmbient(double r, double g, double b)
{
  vtkForwardToMappers(SetGlobalAmbient(r, g, b));
}

void vtkRadiometricSurfaceRepresentation::SetEmission(double r, double g, double b)
{
  vtkForwardToMappers(SetEmission(r, g, b));
}

void vtkRadiometricSurfaceRepresentation::SetLightScale(double scale)
{
  vtkForwardToMappers(SetLightScale(scale));
}

void vtkRadiometricSurfaceRepresentation::SetMetersPerUnit(double meters)
{
  vtkForwardToMappers(SetMetersPerUnit(meters));
}

void vtkRadiometricSurfaceRepresentation::SetHighlights(bool on)
{
  vtkForwardToMappers(SetHighlights(on));
}

void vtkRadiometricSurfaceRepresentation::SetUseLightVisibility(bool on)
{
  vtkForwardToMappers(SetUseLightVisibility(on));
}

void vtkRadiometricSurfaceRepresentation::SetEffectTolerance(double tolerance)
{
  vtkForwardToMappers(SetEffectTolerance(tolerance));
}

void vtkRadiometricSurfaceRepresentation::SwitchEffect(const char* effect, int value)
{
  vtkForwardToMappers(SetEffectSwitch(effect, value));
}

void vtkRadiometricSurfaceRepresentation::SetFieldArray(
  int vtkNotUsed(index), int vtkNotUsed(port), int vtkNotUsed(connection), int association,
  const char* name)
{
  this->FieldAssociation = association == 1 ? 1 : 0;
  this->FieldArrayName = name ? name : "";
}

void vtkRadiometricSurfaceRepresentation::ChooseField(vtkMapper* mapper, vtkDataObject* data)
{
  auto* own = vtkPhongGouraudMapper::SafeDownCast(mapper);
  if (!own)
  {
    return;
  }
  int mode = this->FieldDisplay;
  int association = this->FieldAssociation;
  std::string name = this->FieldArrayName;
  double scale = this->FieldScale;
  if (mode == DISPLAY_AUTO)
  {
    const vtkradiometry::ShownField field = vtkradiometry::FindLightOfData(data);
    mode = field.Name.empty() ? vtkPhongGouraudMapper::FIELD_OFF : vtkPhongGouraudMapper::FIELD_ON;
    association = field.Association;
    name = field.Name;
    scale *= field.Scale;
  }
  if (mode == vtkPhongGouraudMapper::FIELD_OFF &&
    (this->MaterialSource == MATERIAL_OF_DATA ||
      (this->MaterialSource == MATERIAL_AUTO && vtkradiometry::HasMaterials(data))))
  {
    mode = vtkPhongGouraudMapper::FIELD_MATERIALS;
  }
  own->SetFieldMode(mode);
  own->SetFieldAssociation(association);
  own->SetFieldArrayName(name.c_str());
  own->SetFieldScale(scale);
  if (mapper == this->Mapper)
  {
    const char* words[] = { "material of the property, lit", " as light", "normals",
      " as reflectance, lit", "materials of the data, lit", "scalars through their colour map" };
    const bool named = mode == vtkPhongGouraudMapper::FIELD_ON ||
      mode == vtkPhongGouraudMapper::FIELD_REFLECTANCE;
    this->FieldUsed = (named ? name : std::string()) + words[mode];
  }
}

void vtkRadiometricSurfaceRepresentation::SetSmoothCells(bool smooth)
{
  if (this->SmoothCells != smooth)
  {
    this->SmoothCells = smooth;
    this->MarkModified();
  }
}

void vtkRadiometricSurfaceRepresentation::SetFieldDisplay(int display)
{
  display = std::clamp<int>(display, DISPLAY_AUTO, vtkPhongGouraudMapper::FIELD_FALSE_COLOR);
  if (this->FieldDisplay != display)
  {
    this->FieldDisplay = display;
    this->MarkModified(); // smooth or not
  }
}

int vtkRadiometricSurfaceRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!this->Superclass::RequestData(request, inputVector, outputVector))
  {
    return 0;
  }
  // What the view delivers and draws is changed in place: a view takes the first data it is given.
  vtkDataObject* data = this->GetRenderedDataObject(0);
  if (data && this->SmoothCells && this->FieldDisplay == DISPLAY_AUTO)
  {
    const vtkradiometry::ShownField field = vtkradiometry::FindLightOfData(data);
    if (!field.Name.empty() && field.Association == 1)
    {
      if (const auto smooth = vtkradiometry::SmoothField(data, field.Name))
      {
        data->ShallowCopy(smooth);
      }
    }
  }
  return 1;
}

int vtkRadiometricSurfaceRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (!this->Superclass::ProcessViewRequest(request, inInfo, outInfo))
  {
    return 0;
  }
  if (request == vtkPVView::REQUEST_RENDER())
  {
    // The data as it is drawn: what interaction shows may have fewer arrays.
    vtkDataObject* data = vtkPVView::GetDeliveredPiece(inInfo, this);
    vtkDataObject* coarse = vtkPVView::GetDeliveredPieceLOD(inInfo, this);
    this->ChooseField(this->Mapper, data);
    this->ChooseField(this->BackfaceMapper, data);
    this->ChooseField(this->LODMapper, coarse ? coarse : data);
    this->ChooseField(this->LODBackfaceMapper, coarse ? coarse : data);
  }
  return 1;
}

const char* vtkRadiometricSurfaceRepresentation::GetShadingUsed()
{
  const char* names[] = { "Flat", "Gouraud", "Phong", "Auto" };
  auto* mapper = vtkPhongGouraudMapper::SafeDownCast(this->Mapper);
  return names[mapper ? mapper->GetShadingUsed() : 2];
}

double vtkRadiometricSurfaceRepresentation::GetGouraudShare()
{
  auto* mapper = vtkPhongGouraudMapper::SafeDownCast(this->Mapper);
  return mapper ? mapper->GetGouraudShare() : 0.0;
}

const char* vtkRadiometricSurfaceRepresentation::GetShadingReason()
{
  auto* mapper = vtkPhongGouraudMapper::SafeDownCast(this->Mapper);
  return mapper ? mapper->GetShadingReason() : "";
}

const char* vtkRadiometricSurfaceRepresentation::GetEffectsExplained()
{
  auto* mapper = vtkPhongGouraudMapper::SafeDownCast(this->Mapper);
  return mapper ? mapper->Explain() : "";
}

void vtkRadiometricSurfaceRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FieldDisplay: " << this->FieldDisplay << " (" << this->FieldUsed << ")\n";
  os << indent << "SmoothCells: " << this->SmoothCells << "\n";
  os << indent << "MaterialSource: " << this->MaterialSource << "\n";
  os << indent << "FieldArrayName: " << this->FieldArrayName << "\n";
  os << indent << "FieldScale: " << this->FieldScale << "\n";
}
