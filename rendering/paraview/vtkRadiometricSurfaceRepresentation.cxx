// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiometricSurfaceRepresentation.h"

#include "vtkObjectFactory.h"
#include "vtkPhongGouraudMapper.h"

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

void vtkRadiometricSurfaceRepresentation::SetFieldMode(int mode)
{
  vtkForwardToMappers(SetFieldMode(mode));
}

void vtkRadiometricSurfaceRepresentation::SetFieldScale(double scale)
{
  vtkForwardToMappers(SetFieldScale(scale));
}

void vtkRadiometricSurfaceRepresentation::SetFieldArray(
  int vtkNotUsed(index), int vtkNotUsed(port), int vtkNotUsed(connection), int association,
  const char* name)
{
  vtkForwardToMappers(SetFieldAssociation(association == 1 ? 1 : 0));
  vtkForwardToMappers(SetFieldArrayName(name));
}

void vtkRadiometricSurfaceRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
