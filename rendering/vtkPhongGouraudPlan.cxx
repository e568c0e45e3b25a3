// SPDX-License-Identifier: BSD-3-Clause
// The effect plan of vtkPhongGouraudHelper: what a frame holds, and what leaving it out may change.
#include "vtkPhongGouraudHelper.h"

#include "vtkPhongGouraudMapper.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <limits>

using radiometry::DisplayMaterial;
using radiometry::Effect;
using radiometry::EffectSwitch;
using radiometry::MaterialPeaks;
using radiometry::Rgb;
using radiometry::SurfaceBox;
using radiometry::Vec3;
using vtkradiometry::BoundedPicture;
using vtkradiometry::CollectedLights;
using vtkradiometry::FrameFacts;

namespace
{

bool IsBlack(const double* color)
{
  return color[0] == 0.0 && color[1] == 0.0 && color[2] == 0.0;
}

Rgb Absolute(const double* c)
{
  return { std::abs(c[0]), std::abs(c[1]), std::abs(c[2]) };
}

Rgb Greater(const Rgb& a, const Rgb& b)
{
  return { std::max(a.r, std::abs(b.r)), std::max(a.g, std::abs(b.g)),
    std::max(a.b, std::abs(b.b)) };
}

/// Has either side's property this?
template <typename F>
bool OfEitherSide(vtkActor* act, const F& property)
{
  vtkProperty* back = act->GetBackfaceProperty();
  return property(act->GetProperty()) || (back && property(back));
}

bool HasHighlight(vtkProperty* p)
{
  return p->GetSpecular() > 0.0 && !IsBlack(p->GetSpecularColor());
}

const SurfaceBox NoBox{ { std::numeric_limits<double>::infinity(),
                          std::numeric_limits<double>::infinity(),
                          std::numeric_limits<double>::infinity() },
  { -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() } };

void Widen(SurfaceBox& box, const Vec3& p)
{
  for (int c = 0; c < 3; ++c)
  {
    box.Low[c] = std::min(box.Low[c], p[c]);
    box.High[c] = std::max(box.High[c], p[c]);
  }
}

/// Boxes about the polygons and strips of a block, at most some `most` of them.
void AddBoxes(vtkPolyData* block, vtkIdType most, std::vector<SurfaceBox>& boxes)
{
  for (vtkCellArray* cells : { block->GetPolys(), block->GetStrips() })
  {
    const vtkIdType each = 1 + cells->GetNumberOfCells() / most;
    vtkIdType number = 0;
    auto it = vtk::TakeSmartPointer(cells->NewIterator());
    for (it->GoToFirstCell(); !it->IsDoneWithTraversal(); it->GoToNextCell(), ++number)
    {
      if (number % each == 0)
      {
        boxes.push_back(NoBox);
      }
      vtkIdType count = 0;
      const vtkIdType* ids = nullptr;
      it->GetCurrentCell(count, ids);
      for (vtkIdType i = 0; i < count; ++i)
      {
        double p[3];
        block->GetPoint(ids[i], p);
        Widen(boxes.back(), { p[0], p[1], p[2] });
      }
    }
  }
}

SurfaceBox Moved(const SurfaceBox& box, vtkMatrix4x4* m)
{
  SurfaceBox moved = NoBox;
  for (int corner = 0; corner < 8; ++corner)
  {
    Widen(moved,
      vtkradiometry::TransformPoint(m,
        { corner & 1 ? box.High.x : box.Low.x, corner & 2 ? box.High.y : box.Low.y,
          corner & 4 ? box.High.z : box.Low.z }));
  }
  return moved;
}

} // namespace

bool vtkPhongGouraudHelper::MapperEmits()
{
  return !IsBlack(this->Mapper()->Emission) || !IsBlack(this->Mapper()->BackEmission);
}

bool vtkPhongGouraudHelper::IsTranslucent(vtkActor* act)
{
  // VTK looks at every block: that is worth keeping.
  vtkCompositeDataDisplayAttributes* attributes =
    this->Mapper()->GetCompositeDataDisplayAttributes();
  const vtkMTimeType time = std::max({ act->GetMTime(), this->Mapper()->GetMTime(),
    this->VBOBuildTime.GetMTime(), attributes ? attributes->GetMTime() : vtkMTimeType() });
  if (time > this->TranslucentTime)
  {
    this->TranslucentTime = time;
    this->Translucent = act->HasTranslucentPolygonalGeometry() ||
      OfEitherSide(act, [](vtkProperty* p) { return p->GetOpacity() < 1.0; });
  }
  return this->Translucent;
}

FrameFacts vtkPhongGouraudHelper::FactsOf(
  vtkRenderer* ren, vtkActor* act, const CollectedLights& collected)
{
  vtkPhongGouraudMapper* mapper = this->Mapper();
  vtkProperty* property = act->GetProperty();
  const int mode = mapper->FieldMode;
  const bool field = mode == vtkPhongGouraudMapper::FIELD_ON;
  const bool normals = mode == vtkPhongGouraudMapper::FIELD_NORMALS;
  const bool ofCells = mode == vtkPhongGouraudMapper::FIELD_MATERIALS;
  const bool reflectance = mode == vtkPhongGouraudMapper::FIELD_REFLECTANCE;
  const bool nothing = normals || mode == vtkPhongGouraudMapper::FIELD_FALSE_COLOR ||
    property->GetRepresentation() != VTK_SURFACE || (!field && !property->GetLighting());

  FrameFacts facts;
  for (std::size_t k = 0; k < facts.Wishes.size(); ++k)
  {
    facts.Wishes[k] = static_cast<std::uint8_t>(
      mapper->WishOf(static_cast<int>(k), act->GetBackfaceProperty() != nullptr));
  }
  vtkradiometry::NoteLights(collected, mapper->LightScale, facts);
  facts.Shows = nothing ? FrameFacts::NothingLit
                        : (field ? FrameFacts::FieldAsLight : FrameFacts::LitSurface);
  const bool lit = facts.Shows == FrameFacts::LitSurface;
  facts.SpecularMaterial = field ? this->Shines(act)
                                 : (ofCells ? this->SpecularMaterials : OfEitherSide(act, HasHighlight));
  facts.AmbientMaterial =
    OfEitherSide(act, [](vtkProperty* p) { return p->GetAmbient() > 0.0; });
  facts.AmbientLight = facts.AmbientLight || !IsBlack(mapper->GlobalAmbient);
  facts.Emission = this->MapperEmits() || (ofCells && this->EmittingMaterials);
  facts.BacksSeen = !property->GetBackfaceCulling();
  const double* e = mapper->Emission;
  const double* b = mapper->BackEmission;
  const bool glowsAlike = e[0] == b[0] && e[1] == b[1] && e[2] == b[2];
  facts.SidesDiffer = (lit && (!glowsAlike || ofCells)) || normals ||
    ((field || reflectance) && this->FieldOfBack);
  facts.Parallel = ren->GetActiveCamera()->GetParallelProjection() != 0;
  facts.Translucent = this->IsTranslucent(act);
  for (const int column : collected.Columns)
  {
    facts.SharesKnown = facts.SharesKnown || column >= 0;
    facts.Shares =
      facts.Shares || (column >= 0 && this->VisibilityLoss[static_cast<std::size_t>(column)] > 0.0);
  }
  facts.Spectral = facts.Spectral || ((field || reflectance) && this->SpectralField) ||
    (ofCells && this->SpectralMaterials);
  return facts;
}

const std::vector<SurfaceBox>& vtkPhongGouraudHelper::BoxesOfSurface()
{
  constexpr vtkIdType MostBoxes = 256;
  if (!this->BoxesMade)
  {
    this->BoxesMade = true;
    this->Boxes.clear();
    const std::vector<vtkradiometry::DrawnBlock*> blocks = this->Blocks();
    const vtkIdType each =
      1 + MostBoxes / std::max<vtkIdType>(1, static_cast<vtkIdType>(blocks.size()));
    for (vtkradiometry::DrawnBlock* drawn : blocks)
    {
      AddBoxes(vtkradiometry::DataOf(*drawn), each, this->Boxes);
    }
  }
  return this->Boxes;
}

void vtkPhongGouraudHelper::NoteMaterials(vtkActor* act, BoundedPicture& picture)
{
  vtkPhongGouraudMapper* mapper = this->Mapper();
  MaterialPeaks& peaks = picture.Surface.Peaks;
  const bool field = mapper->FieldMode == vtkPhongGouraudMapper::FIELD_ON;
  const bool ofCells = mapper->FieldMode == vtkPhongGouraudMapper::FIELD_MATERIALS ||
    (field && this->HighlightsOfCells());
  bool first = true;
  const auto gloss = [&](const Rgb& specular, double shininess) {
    if (specular == Rgb())
    {
      return;
    }
    peaks.Specular = Greater(peaks.Specular, specular);
    peaks.LeastShininess = first ? shininess : std::min(peaks.LeastShininess, shininess);
    peaks.GreatestShininess = first ? shininess : std::max(peaks.GreatestShininess, shininess);
    first = false;
  };
  for (const DisplayMaterial* side : { &picture.Scene.Front, &picture.Scene.Back })
  {
    if (!field)
    {
      peaks.Ambient = Greater(peaks.Ambient, side->Ambient);
      peaks.Diffuse = Greater(peaks.Diffuse, side->Diffuse);
    }
    if (!ofCells)
    {
      gloss(side->Specular, side->Shininess);
    }
  }
  Rgb emitted;
  const std::vector<float>& texels = this->MaterialBuffer.Values;
  for (std::size_t i = 0; ofCells && i + 11 < texels.size(); i += 12)
  {
    gloss({ texels[i + 4], texels[i + 5], texels[i + 6] }, texels[i + 3]);
    emitted = field ? emitted : Greater(emitted, { texels[i + 8], texels[i + 9], texels[i + 10] });
  }
  picture.Emission = Greater(Absolute(mapper->Emission), Absolute(mapper->BackEmission)) + emitted;
  for (int c = 0; c < 3; ++c)
  {
    picture.EmissionOfSides = std::max(
      picture.EmissionOfSides, std::abs(mapper->Emission[c] - mapper->BackEmission[c]));
  }
  picture.EmissionOfSides += 2.0 * std::max({ emitted.r, emitted.g, emitted.b });
  picture.FieldOfSides = mapper->FieldMode == vtkPhongGouraudMapper::FIELD_NORMALS
    ? 2.0
    : (field && this->FieldOfBack ? 2.0 * std::abs(mapper->FieldScale) * this->FieldMost : 0.0);
  picture.AmbientOfSides = ofCells || this->FieldOfBack ? 1.0 : 0.0;
}

BoundedPicture vtkPhongGouraudHelper::PictureOf(
  vtkRenderer* ren, vtkActor* act, const CollectedLights& collected)
{
  vtkPhongGouraudMapper* mapper = this->Mapper();
  BoundedPicture picture;
  picture.Scene = this->SceneOf(ren, act, collected);
  picture.Square = mapper->MetersPerUnit * mapper->MetersPerUnit;
  this->NoteMaterials(act, picture);
  for (const int column : collected.Columns)
  {
    picture.Loss.push_back(
      column < 0 ? 0.0 : this->VisibilityLoss[static_cast<std::size_t>(column)]);
  }
  vtkNew<vtkMatrix4x4> objectToWorld;
  act->GetModelToWorldMatrix(objectToWorld);
  for (const SurfaceBox& box : this->BoxesOfSurface())
  {
    picture.Surface.Boxes.push_back(Moved(box, objectToWorld));
  }
  return picture;
}

void vtkPhongGouraudHelper::PlanEffects(vtkRenderer* ren, vtkActor* act, CollectedLights& collected)
{
  vtkPhongGouraudMapper* mapper = this->Mapper();
  this->Effects.Decide(this->FactsOf(ren, act, collected));
  const double tolerance = mapper->EveryEffect ? 0.0 : mapper->EffectTolerance;
  if (this->Effects.NeedsBounds(tolerance))
  {
    this->Effects.Bound(this->PictureOf(ren, act, collected), tolerance);
    this->Effects.LeaveOut(collected);
  }
  mapper->FramePlans.push_back(this->Effects.Share());
}
