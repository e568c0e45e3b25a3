// SPDX-License-Identifier: BSD-3-Clause
// Shading Auto of vtkPhongGouraudHelper: where Gouraud serves as well as Phong, and whether it pays.
#include "vtkPhongGouraudHelper.h"

#include "vtkPhongGouraudMapper.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

using radiometry::DisplayLight;
using radiometry::DisplayMaterial;
using radiometry::Effect;
using radiometry::Rgb;
using radiometry::Vec3;
using vtkradiometry::ShadingChoice;
using vtkradiometry::TransformDirection;
using vtkradiometry::TransformPoint;

namespace
{

Rgb Scaled(double s, const double* c)
{
  return s * Rgb{ c[0], c[1], c[2] };
}

/// The points, normals and triangles of a block, in the order in which they are drawn.
void Append(vtkPolyData* block, radiometry::ShadedMesh& mesh)
{
  const auto first = static_cast<vtkIdType>(mesh.Points.size());
  vtkDataArray* normals = block->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < block->GetNumberOfPoints(); ++i)
  {
    double p[3];
    block->GetPoint(i, p);
    mesh.Points.push_back({ p[0], p[1], p[2] });
    double n[3] = { 0.0, 0.0, 0.0 };
    if (normals && normals->GetNumberOfComponents() == 3)
    {
      normals->GetTuple(i, n);
    }
    mesh.Normals.push_back({ n[0], n[1], n[2] });
  }
  vtkOpenGLIndexBufferObject::AppendTriangleIndexBuffer(
    mesh.Corners, block->GetPolys(), block->GetPoints(), first, nullptr, nullptr);
  vtkOpenGLIndexBufferObject::AppendStripIndexBuffer(
    mesh.Corners, block->GetStrips(), first, false);
}

/// Pixels that a surface of these bounds covers at most: the box around it on the screen.
double PixelsOf(vtkRenderer* ren, const double* bounds)
{
  const int* size = ren->GetSize();
  const double all = static_cast<double>(size[0]) * size[1];
  vtkMatrix4x4* toScreen = ren->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
    ren->GetTiledAspectRatio(), -1.0, 1.0);
  double low[2] = { 1.0, 1.0 };
  double high[2] = { -1.0, -1.0 };
  for (int corner = 0; corner < 8; ++corner)
  {
    double p[4] = { bounds[corner & 1], bounds[2 + (corner >> 1 & 1)],
      bounds[4 + (corner >> 2 & 1)], 1.0 };
    toScreen->MultiplyPoint(p, p);
    if (!(p[3] > 0.0))
    {
      return all;
    }
    for (int a = 0; a < 2; ++a)
    {
      low[a] = std::min(low[a], p[a] / p[3]);
      high[a] = std::max(high[a], p[a] / p[3]);
    }
  }
  double share = 1.0;
  for (int a = 0; a < 2; ++a)
  {
    share *= std::max(0.0, std::min(high[a], 1.0) - std::max(low[a], -1.0)) / 2.0;
  }
  return share * all;
}

} // namespace

void vtkPhongGouraudHelper::BuildChoice(vtkActor* act)
{
  this->ChoiceTexels.clear();
  this->ShadingBuffer.Free();
  this->ShadingVersion = 0;
  radiometry::ShadedMesh mesh;
  if (this->Mapper()->Shading == vtkPhongGouraudMapper::AUTO && this->HasPointNormals() &&
    act->GetProperty()->GetRepresentation() == VTK_SURFACE)
  {
    for (vtkradiometry::DrawnBlock* drawn : this->Blocks())
    {
      const vtkIdType* offsets = drawn->CellCellMap->GetPrimitiveOffsets();
      const std::size_t before = mesh.Size();
      Append(vtkradiometry::DataOf(*drawn), mesh);
      const std::size_t triangles = mesh.Size() - before;
      const std::size_t first = static_cast<std::size_t>(offsets[2]);
      if (first + triangles != static_cast<std::size_t>(drawn->CellCellMap->GetFinalOffset()))
      {
        mesh = {}; // VTK divided some polygon otherwise here than there: no flags can be right
        this->ChoiceTexels.clear();
        break;
      }
      for (std::size_t t = 0; t < triangles; ++t)
      {
        this->ChoiceTexels.push_back(first + t);
      }
    }
  }
  this->Choice.SetMesh(std::move(mesh));
}

radiometry::ShadedScene vtkPhongGouraudHelper::SceneOf(
  vtkRenderer* ren, vtkActor* act, const vtkradiometry::CollectedLights& collected)
{
  vtkPhongGouraudMapper* mapper = this->Mapper();
  vtkCamera* camera = ren->GetActiveCamera();
  vtkNew<vtkMatrix4x4> objectToWorld;
  act->GetModelToWorldMatrix(objectToWorld);
  vtkNew<vtkMatrix4x4> viewToWorld;
  vtkMatrix4x4::Invert(camera->GetModelViewTransformMatrix(), viewToWorld);

  radiometry::ShadedScene scene;
  scene.Model.Reflection = static_cast<radiometry::ReflectionModel>(mapper->ReflectionModel);
  scene.Model.LocalViewer = !camera->GetParallelProjection();
  scene.Model.TwoSided = true;
  scene.Model.GlobalAmbient = Scaled(1.0, mapper->GlobalAmbient);
  scene.Eye = TransformPoint(viewToWorld, {});
  scene.Viewer = TransformDirection(viewToWorld, { 0.0, 0.0, 1.0 });
  for (std::size_t i = 0; i < collected.Lights.size(); ++i)
  {
    DisplayLight light = collected.Lights[i];
    if (collected.Frames[i] != vtkradiometry::LightFrame::Scene)
    {
      vtkMatrix4x4* toWorld = collected.Frames[i] == vtkradiometry::LightFrame::Object
        ? objectToWorld.Get()
        : viewToWorld.Get();
      const Vec3 given{ light.Position[0], light.Position[1], light.Position[2] };
      const Vec3 place =
        light.Position[3] == 0.0 ? TransformDirection(toWorld, given)
                                 : TransformPoint(toWorld, given);
      light.Position = { { place.x, place.y, place.z, light.Position[3] == 0.0 ? 0.0 : 1.0 } };
      light.SpotDirection = TransformDirection(toWorld, light.SpotDirection);
      for (Vec3& corner : light.Polygon)
      {
        corner = TransformPoint(toWorld, corner);
      }
    }
    light.Attenuation[1] *= mapper->MetersPerUnit;
    light.Attenuation[2] *= mapper->MetersPerUnit * mapper->MetersPerUnit;
    light.Ambient = mapper->LightScale * light.Ambient;
    light.Diffuse = mapper->LightScale * light.Diffuse;
    light.Specular = mapper->LightScale * light.Specular;
    scene.Lights.push_back(light);
  }

  const auto sideOf = [](vtkProperty* property) {
    DisplayMaterial side;
    side.Ambient = Scaled(property->GetAmbient(), property->GetAmbientColor());
    side.Diffuse = Scaled(property->GetDiffuse(), property->GetDiffuseColor());
    side.Specular = Scaled(property->GetSpecular(), property->GetSpecularColor());
    side.Shininess = property->GetSpecularPower();
    return side;
  };
  vtkProperty* back = act->GetBackfaceProperty();
  scene.Front = sideOf(act->GetProperty());
  scene.Back = back ? sideOf(back) : scene.Front;
  // Colours that vary over the surface multiply both pictures alike: the greatest counts.
  double most = 0.0;
  if (mapper->FieldMode == vtkPhongGouraudMapper::FIELD_MATERIALS)
  {
    const std::vector<float>& values = this->MaterialBuffer.Values;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      most = i % 12 < 3 ? std::max(most, std::abs(static_cast<double>(values[i]))) : most;
    }
  }
  else if (mapper->FieldMode == vtkPhongGouraudMapper::FIELD_REFLECTANCE)
  {
    most = std::abs(mapper->FieldScale) * this->FieldMost;
  }
  else if (this->UsesScalarColors() || this->Mapper()->GetCompositeDataDisplayAttributes())
  {
    for (DisplayMaterial* side : { &scene.Front, &scene.Back })
    {
      // A block without a colour of its own has the property's.
      const auto least = [](const Rgb& c, double one) {
        return Rgb{ std::max(c.r, one), std::max(c.g, one), std::max(c.b, one) };
      };
      side->Diffuse = least(side->Diffuse, act->GetProperty()->GetDiffuse());
      side->Ambient = least(side->Ambient, act->GetProperty()->GetAmbient());
    }
    return scene;
  }
  else
  {
    return scene;
  }
  for (DisplayMaterial* side : { &scene.Front, &scene.Back })
  {
    side->Diffuse = Rgb{ most, most, most };
    side->Ambient = act->GetProperty()->GetAmbient() * side->Diffuse;
  }
  return scene;
}

radiometry::ShadedScene vtkPhongGouraudHelper::DrawnSceneOf(
  vtkRenderer* ren, vtkActor* act, const vtkradiometry::CollectedLights& collected)
{
  radiometry::ShadedScene scene = this->SceneOf(ren, act, collected);
  scene.Model.LocalViewer = this->Effects.Simulates(Effect::LocalViewer);
  scene.Model.TwoSided = this->Effects.Simulates(Effect::TwoSided);
  for (DisplayMaterial* side : { &scene.Front, &scene.Back })
  {
    if (!this->Effects.Simulates(Effect::Specular))
    {
      side->Specular = Rgb();
    }
    if (!this->Effects.Simulates(Effect::GlobalAmbient))
    {
      side->Ambient = Rgb();
    }
  }
  return scene;
}

void vtkPhongGouraudHelper::ReportShading()
{
  vtkPhongGouraudMapper* mapper = this->Mapper();
  const double triangles = std::max<double>(1.0, static_cast<double>(this->ChoiceTexels.size()));
  double share = mapper->ShadingUsed == vtkPhongGouraudMapper::GOURAUD ? 1.0 : 0.0;
  if (mapper->ShadingUsed == vtkPhongGouraudMapper::AUTO)
  {
    share = static_cast<double>(this->Choice.Gouraud()) / triangles;
  }
  mapper->GouraudTriangles += share * triangles;
  mapper->CountedTriangles += triangles;
  mapper->ShadingReason = this->AutoReason;
}

void vtkPhongGouraudHelper::DecideShading(
  vtkRenderer* ren, vtkActor* act, const vtkradiometry::CollectedLights& collected)
{
  vtkPhongGouraudMapper* mapper = this->Mapper();
  this->AutoUses = vtkPhongGouraudMapper::PHONG;
  std::string& reason = this->AutoReason;
  if (mapper->Shading != vtkPhongGouraudMapper::AUTO)
  {
    reason = "as chosen";
    return;
  }
  const int mode = mapper->FieldMode;
  if (mode == vtkPhongGouraudMapper::FIELD_ON || this->Effects.Simulates(Effect::Occlusion))
  {
    reason = "Phong: highlights on a field, and lights whose shadows are known, are drawn by pixel";
    return;
  }
  if (mode == vtkPhongGouraudMapper::FIELD_NORMALS ||
    mode == vtkPhongGouraudMapper::FIELD_FALSE_COLOR)
  {
    reason = "nothing is lit";
    return;
  }
  if (vtkradiometry::NeedsExtendedLights(this->Lights.Features))
  {
    reason = "Phong: there is no bound for luminaires with a web, area lights and skies";
    return;
  }
  if (!this->HasPointNormals())
  {
    reason = "Phong: without point normals each pixel is lit with its cell's normal";
    return;
  }
  const bool materials = mode == vtkPhongGouraudMapper::FIELD_MATERIALS;
  if (materials && this->Effects.Simulates(Effect::Specular))
  {
    reason = "Phong: highlights whose exponent belongs to the cell";
    return;
  }
  const std::size_t triangles = this->Choice.Mesh().Size();
  const double lights = this->Lights.Count();
  if (triangles == 0 || lights == 0.0)
  {
    reason = "Phong: nothing to decide";
    return;
  }
  // In units of one light at one place. Half of the box on the screen is surface; each pixel of a
  // picture of both kinds reads its flag and has the interpolated light, too.
  const double points = static_cast<double>(this->Choice.Mesh().Points.size());
  const double pixels = 0.5 * PixelsOf(ren, act->GetBounds());
  if (points > pixels)
  {
    reason = "Phong: the surface has more points than pixels, so Gouraud would not be faster";
    return;
  }
  vtkNew<vtkMatrix4x4> objectToWorld;
  act->GetModelToWorldMatrix(objectToWorld);
  // What effects that Auto left out may change is spent: one tolerance for both.
  const double left =
    std::max(0.0, mapper->ShadingTolerance - this->Effects.Plan().DroppedBound());
  const ShadingChoice::State state =
    this->Choice.Decide(this->DrawnSceneOf(ren, act, collected), objectToWorld->GetData(), left,
      mapper->ShadingTimeShare);
  char text[200];
  if (state == ShadingChoice::State::Changing)
  {
    reason = "Phong: lights, surface, material or (with highlights) the camera are others than in "
             "the frame before; a decision that serves one frame costs more than it saves";
    return;
  }
  if (state == ShadingChoice::State::Deciding)
  {
    std::snprintf(text, sizeof text, "Phong: still deciding, %.0f %% of the triangles are done",
      100.0 * static_cast<double>(this->Choice.Done()) / static_cast<double>(triangles));
    reason = text;
    return;
  }
  const double share =
    static_cast<double>(this->Choice.Gouraud()) / static_cast<double>(triangles);
  if (this->Choice.Gouraud() == triangles)
  {
    this->AutoUses = vtkPhongGouraudMapper::GOURAUD;
    reason = "Gouraud: everywhere within ShadingTolerance of Phong";
    return;
  }
  const bool pays = share * pixels * lights > points * lights + 2.0 * pixels;
  std::snprintf(text, sizeof text,
    pays ? "Gouraud on %.2f %% of the triangles, within ShadingTolerance of Phong; Phong on the rest"
         : "Phong: Gouraud on the %.2f %% of the triangles that allow it would not be faster",
    100.0 * share);
  reason = text;
  if (pays)
  {
    this->AutoUses = vtkPhongGouraudMapper::AUTO;
  }
  if (pays && this->ShadingVersion != this->Choice.Version())
  {
    this->ShadingVersion = this->Choice.Version();
    const std::vector<float>& flags = this->Choice.Flags();
    std::vector<float> texels(4 * ((this->ChoiceTexels.back() + 4) / 4), 0.0f);
    for (std::size_t t = 0; t < triangles; ++t)
    {
      texels[this->ChoiceTexels[t]] = flags[t];
    }
    this->ShadingBuffer.Upload(ren, std::move(texels));
  }
}
