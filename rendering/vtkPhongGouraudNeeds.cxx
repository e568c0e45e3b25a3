// SPDX-License-Identifier: BSD-3-Clause
// What vtkPhongGouraudHelper draws itself, and what the shader needs for the effects of its plan.
#include "vtkPhongGouraudHelper.h"

#include "vtkPhongGouraudMapper.h"

#include "vtk_glew.h"

#include "vtkActor.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <utility>

using radiometry::Effect;
using vtkradiometry::ShaderFeatures;

namespace
{

bool Has(const ShaderFeatures& features, const char* name)
{
  return features.count(name) != 0;
}

void Need(ShaderFeatures& features, bool needed, const char* name)
{
  if (needed)
  {
    features.insert(name);
  }
}

bool NeedsLight(vtkPhongGouraudMapper* mapper)
{
  const int mode = mapper->GetFieldMode();
  return mode != vtkPhongGouraudMapper::FIELD_ON &&
    mode != vtkPhongGouraudMapper::FIELD_NORMALS &&
    mode != vtkPhongGouraudMapper::FIELD_FALSE_COLOR;
}

} // namespace

bool vtkPhongGouraudHelper::DrawsItself(vtkOpenGLHelper& cellBO, vtkActor* act)
{
  if (this->CurrentSelector || this->DrawingSelection || this->DrawingVertices)
  {
    return false;
  }
  if (NeedsLight(this->Mapper()) && !act->GetProperty()->GetLighting())
  {
    return false;
  }
  return this->GetOpenGLMode(act->GetProperty()->GetRepresentation(), cellBO.PrimitiveType) ==
    GL_TRIANGLES;
}

bool vtkPhongGouraudHelper::HasPointNormals()
{
  return this->VBOs->GetNumberOfComponents("normalMC") == 3;
}

bool vtkPhongGouraudHelper::UsesScalarColors()
{
  return this->VBOs->GetNumberOfComponents("scalarColor") != 0 || this->HaveCellScalars ||
    (this->InterpolateScalarsBeforeMapping && this->ColorCoordinates);
}

ShaderFeatures vtkPhongGouraudHelper::Needs(vtkRenderer* ren, vtkActor* act)
{
  vtkPhongGouraudMapper* mapper = this->Mapper();
  ShaderFeatures needs;
  // Opacity is in VTK's own text, whatever the scene: what needs code is that it is left out.
  Need(needs, this->Effects.LeavesOut(Effect::Translucency), "Opaque");
  if (mapper->FieldMode == vtkPhongGouraudMapper::FIELD_FALSE_COLOR)
  {
    needs.insert("FalseColor");
    Need(needs, this->DrawingEdges(ren, act), "Edges");
    Need(needs, this->ScalarsOfPoints, this->PointColors ? "ColorsOfPoints" : "ScalarsOfPoints");
    Need(needs, this->CellColorBuffer.Texture != nullptr, "ColorsOfCells");
    return needs;
  }
  vtkProperty* back = act->GetBackfaceProperty();
  Need(needs, this->Effects.Simulates(Effect::TwoSided), "TwoSided");
  Need(needs, back != nullptr, "BackProperty");
  vtkNew<vtkMatrix4x4> objectToWorld;
  act->GetModelToWorldMatrix(objectToWorld);
  Need(needs, (Has(needs, "TwoSided") || back) && objectToWorld->Determinant() < 0.0, "Mirrored");
  Need(needs, this->DrawingEdges(ren, act), "Edges");

  const bool lit = NeedsLight(mapper);
  const bool highlights = mapper->FieldMode == vtkPhongGouraudMapper::FIELD_ON &&
    this->Effects.Simulates(Effect::Specular) && this->Lights.Count() > 0;
  const bool materials = mapper->FieldMode == vtkPhongGouraudMapper::FIELD_MATERIALS ||
    (highlights && this->HighlightsOfCells());
  Need(needs, lit, "Lit");
  Need(needs, materials && (lit || highlights), "Materials");
  Need(needs,
    materials && lit && this->EmittingMaterials && this->Effects.Simulates(Effect::Emission),
    "MaterialEmission");
  Need(needs, mapper->FieldMode == vtkPhongGouraudMapper::FIELD_ON, "ShowField");
  Need(needs, mapper->FieldMode == vtkPhongGouraudMapper::FIELD_REFLECTANCE, "FieldIsReflectance");
  Need(needs, mapper->FieldMode == vtkPhongGouraudMapper::FIELD_NORMALS, "ShowNormals");
  if (Has(needs, "ShowField") || Has(needs, "FieldIsReflectance"))
  {
    needs.insert("Field");
    Need(needs, this->FieldOfCells, "FieldOfCells");
    Need(needs, this->FieldOfPoints, "FieldOfPoints");
    Need(needs, this->FieldOfBack, "FieldOfBack");
  }

  int shading = mapper->Shading;
  if (lit || highlights)
  {
    this->NeedLights(needs, act);
    shading = this->ChooseShading(needs, highlights);
    this->NeedShading(needs, shading);
    mapper->ShadingUsed = shading;
  }
  Need(needs, Has(needs, "ShowNormals"), "FragmentNormal");
  Need(needs,
    Has(needs, "FragmentNormal") &&
      (shading == vtkPhongGouraudMapper::FLAT || !this->HasPointNormals()),
    "CellFrame");
  Need(needs, Has(needs, "FragmentNormal") || Has(needs, "PerVertex"), "NeedsNormal");
  return needs;
}

void vtkPhongGouraudHelper::NeedLights(ShaderFeatures& needs, vtkActor* act)
{
  vtkPhongGouraudMapper* mapper = this->Mapper();
  const vtkradiometry::PictureEffects& plan = this->Effects;
  const bool lit = Has(needs, "Lit");
  Need(needs,
    plan.Simulates(Effect::Emission) && (this->MapperEmits() || plan.IsOn(Effect::Emission)),
    "Emission");
  Need(needs, plan.Simulates(Effect::GlobalAmbient), "Ambient");
  // What the lights are that the plan draws; then what was switched on though no light is or has it.
  needs.insert(this->Lights.Features.begin(), this->Lights.Features.end());
  const bool lights = Has(needs, "Lights");
  Need(needs, lit && lights, "Diffuse");
  const std::pair<Effect, const char*> wished[] = { { Effect::DirectionalLights, "Directional" },
    { Effect::PointLights, "Point" }, { Effect::SpotLights, "Spot" },
    { Effect::CandelaWebs, "Luminaire" }, { Effect::AreaLights, "Area" },
    { Effect::Environment, "Sky" }, { Effect::SpotShape, "SpotExponent" },
    { Effect::SpotShape, "SmoothEdge" }, { Effect::Attenuation, "Attenuation" },
    { Effect::GlobalAmbient, "LightAmbient" }, { Effect::Specular, "LightSpecular" } };
  for (const auto& [effect, feature] : wished)
  {
    Need(needs, lights && plan.IsOn(effect), feature);
  }
  if (plan.LeavesOut(Effect::SpotShape))
  {
    needs.erase("Spot"); // they are points
  }
  if (Has(needs, "Attenuation"))
  {
    needs.erase("InverseSquare");
  }
  Need(needs, lights && plan.Simulates(Effect::Specular), "Specular");
  if (!lit)
  {
    needs.erase("Area"); // they have no highlights
    needs.erase("Sky");
  }
  for (const char* kind : { "Point", "Spot", "Luminaire", "Area" })
  {
    Need(needs, Has(needs, kind), "Finite");
  }
  Need(needs, Has(needs, "Specular") || Has(needs, "SpotExponent"), "NeedsPower");
  if (!Has(needs, "Ambient"))
  {
    needs.erase("LightAmbient");
  }
  if (Has(needs, "Specular"))
  {
    Need(needs, plan.Simulates(Effect::LocalViewer), "LocalViewer");
    const char* models[] = { "BlinnPhong", "Phong", "Physical" };
    needs.insert(models[mapper->ReflectionModel]);
    Need(needs,
      Has(needs, "TwoSided") && act->GetBackfaceProperty() && !this->UsesScalarColors(),
      "BackMaterial");
  }
  else
  {
    needs.erase("LightSpecular");
  }
  if (lights && plan.Simulates(Effect::Occlusion))
  {
    this->NeedVisibility(needs);
  }
}

int vtkPhongGouraudHelper::ChooseShading(const ShaderFeatures& needs, bool highlights)
{
  const int shading = this->Mapper()->Shading;
  if (shading == vtkPhongGouraudMapper::FLAT)
  {
    return shading;
  }
  // Highlights on a field and shares of light are drawn pixel by pixel; so are normals of cells and
  // exponents that belong to a cell. Where Gouraud was chosen that stays so when they are left out: it
  // would change more than leaving them out does.
  const bool specular = Has(needs, "Specular");
  const bool chosen = shading == vtkPhongGouraudMapper::GOURAUD;
  const auto counts = [&](Effect effect, bool drawn) {
    return drawn || (chosen && this->Effects.Plan()[effect].Present);
  };
  if (highlights || counts(Effect::Occlusion, Has(needs, "Visibility")) ||
    !this->HasPointNormals() ||
    (Has(needs, "Materials") && counts(Effect::Specular, specular)))
  {
    return vtkPhongGouraudMapper::PHONG;
  }
  if (shading != vtkPhongGouraudMapper::AUTO)
  {
    return shading;
  }
  if (vtkradiometry::NeedsExtendedLights(this->Lights.Features))
  {
    return vtkPhongGouraudMapper::PHONG;
  }
  // Directional lights on a diffuse surface with one normal a cell: nothing varies in a cell.
  if (this->ConstantInCells && !specular && !Has(needs, "Finite"))
  {
    this->AutoReason = "Gouraud: nothing varies within a cell";
    return vtkPhongGouraudMapper::GOURAUD;
  }
  return this->AutoUses;
}

void vtkPhongGouraudHelper::NeedShading(ShaderFeatures& needs, int shading)
{
  if (!Has(needs, "Lights"))
  {
    return;
  }
  const bool mixed = shading == vtkPhongGouraudMapper::AUTO;
  const bool flat = shading == vtkPhongGouraudMapper::FLAT;
  const bool pixels = shading != vtkPhongGouraudMapper::GOURAUD;
  const bool position = Has(needs, "Finite") || Has(needs, "LocalViewer");
  Need(needs, mixed || !pixels, "PerVertex");
  Need(needs, mixed, "PerTriangle");
  Need(needs, flat, "PerCell");
  Need(needs, pixels, "FragmentNormal");
  Need(needs, position, "Position");
  Need(needs, pixels && position && flat, "CellPosition");
  Need(needs, pixels && position && !flat, "FragmentPosition");
  Need(needs, pixels && Has(needs, "LocalViewer"), "FragmentViewer");
}

bool vtkPhongGouraudHelper::GetNeedToRebuildShaders(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act)
{
  this->Ours = this->DrawsItself(cellBO, act);
  const bool rebuild = this->Superclass::GetNeedToRebuildShaders(cellBO, ren, act);
  // VTK 9.2 reads the back-face property wherever the last program had one: no program outlives it.
  std::string signature = act->GetBackfaceProperty() ? "BackProperty" : "";
  if (this->Ours)
  {
    signature.clear();
    this->Features = this->Needs(ren, act);
    for (const std::string& feature : this->Features)
    {
      signature += (signature.empty() ? "" : " ") + feature;
    }
    this->Mapper()->ShaderFeatureText = signature;
  }
  std::string& last = this->Signatures[&cellBO];
  if (last == signature)
  {
    return rebuild;
  }
  last = signature;
  return true;
}
