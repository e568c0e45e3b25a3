// SPDX-License-Identifier: BSD-3-Clause
// The surface arrays of docs/arrays.md as materials of the picture, for vtkPhongGouraudHelper.
#include "vtkPhongGouraudHelper.h"

#include "vtkPhongGouraudMapper.h"

#include "radiometry/scene/ArrayNames.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>

namespace
{

namespace names = radiometry::names;
using vtkradiometry::BandColors;

/// Front, then back: diffuse reflectance and exponent, specular reflectance, emitted radiance.
using Material = std::array<float, 24>;

/// An order that holds for any float, NaN included.
struct ByBytes
{
  bool operator()(const Material& a, const Material& b) const
  {
    return std::memcmp(a.data(), b.data(), sizeof(Material)) < 0;
  }
};

/// An array of the cells, or of the whole block as field data of one tuple.
class SurfaceArray
{
public:
  SurfaceArray(vtkPolyData* block, const std::string& name)
    : Array(block->GetCellData()->GetArray(name.c_str()))
  {
    if (!this->Array || this->Array->GetNumberOfTuples() != block->GetNumberOfCells())
    {
      this->Array = block->GetFieldData()->GetArray(name.c_str());
      this->Whole = true;
      if (this->Array && this->Array->GetNumberOfTuples() != 1)
      {
        this->Array = nullptr;
      }
    }
  }
  explicit operator bool() const { return this->Array != nullptr; }
  bool IsSpectral(const BandColors& colors) const
  {
    return this->Array && colors.IsSpectral(this->Array);
  }
  void Rgb(vtkIdType cell, double scale, const BandColors& colors, float* rgb) const
  {
    const std::array<double, 3> color = colors.Of(this->Array, this->Whole ? 0 : cell);
    for (std::size_t c = 0; c < 3; ++c)
    {
      rgb[c] = static_cast<float>(scale * color[c]);
    }
  }
  double Value(vtkIdType cell) const
  {
    return this->Array->GetComponent(this->Whole ? 0 : cell, 0);
  }

private:
  vtkDataArray* Array;
  bool Whole = false;
};

/// The arrays of one block: the materials of its cells.
class BlockMaterials
{
public:
  BlockMaterials(vtkPolyData* block, vtkActor* actor)
    : Actor(actor)
    , TwoSided(block, names::TwoSided)
    , Sides{ { Side(block, ""), Side(block, names::BackPrefix) } }
  {
  }
  bool IsSpectral() const { return this->Sides[0].IsSpectral() || this->Sides[1].IsSpectral(); }
  Material At(vtkIdType cell) const
  {
    Material material{};
    this->FromProperty(this->Actor->GetProperty(), &material[0]);
    this->FromProperty(this->Actor->GetBackfaceProperty(), &material[12]);
    this->Sides[0].Read(cell, &material[0]);
    if (!this->Actor->GetBackfaceProperty())
    {
      std::copy_n(&material[0], 12, &material[12]);
    }
    this->Sides[1].Read(cell, &material[12]);
    if (this->TwoSided && this->TwoSided.Value(cell) == 0.0)
    {
      std::fill_n(&material[12], 12, 0.0f); // nothing is reflected or emitted there
    }
    for (const int side : { 0, 12 })
    {
      // A perfect mirror, or no exponent at all: no light source is seen in it, as in LightingModel.
      if (!std::isfinite(material[side + 3]) || material[side + 3] < 0.0f)
      {
        material[side + 3] = 0.0f;
        std::fill_n(&material[side + 4], 3, 0.0f);
      }
    }
    return material;
  }

private:
  struct Side
  {
    Side(vtkPolyData* block, const std::string& prefix)
      : Diffuse(block, prefix + names::DiffuseReflectance)
      , Specular(block, prefix + names::SpecularReflectance)
      , Exitance(block, prefix + names::EmittedExitance)
      , Shininess(block, prefix + names::Shininess)
      , Reflected(block->GetFieldData(), radiometry::imaging::BandValues::Reflectance)
      , Emitted(block->GetFieldData(), radiometry::imaging::BandValues::Power)
    {
    }
    void Read(vtkIdType cell, float* texels) const
    {
      if (this->Diffuse)
      {
        this->Diffuse.Rgb(cell, 1.0, this->Reflected, texels);
      }
      if (this->Shininess)
      {
        texels[3] = static_cast<float>(this->Shininess.Value(cell));
      }
      if (this->Specular)
      {
        this->Specular.Rgb(cell, 1.0, this->Reflected, texels + 4);
      }
      if (this->Exitance)
      {
        this->Exitance.Rgb(cell, 1.0 / vtkMath::Pi(), this->Emitted, texels + 8); // a Lambertian emitter
      }
    }
    bool IsSpectral() const
    {
      return this->Diffuse.IsSpectral(this->Reflected) || this->Specular.IsSpectral(this->Reflected) ||
        this->Exitance.IsSpectral(this->Emitted);
    }
    SurfaceArray Diffuse;
    SurfaceArray Specular;
    SurfaceArray Exitance;
    SurfaceArray Shininess;
    BandColors Reflected;
    BandColors Emitted;
  };
  static void FromProperty(vtkProperty* property, float* texels)
  {
    for (int c = 0; property && c < 3; ++c)
    {
      texels[c] = static_cast<float>(property->GetDiffuse() * property->GetDiffuseColor()[c]);
      texels[4 + c] = static_cast<float>(property->GetSpecular() * property->GetSpecularColor()[c]);
      texels[3] = static_cast<float>(property->GetSpecularPower());
    }
  }
  vtkActor* Actor;
  SurfaceArray TwoSided;
  std::array<Side, 2> Sides;
};

bool HasHighlights(vtkPolyData* block)
{
  return SurfaceArray(block, names::SpecularReflectance) ||
    SurfaceArray(block, std::string(names::BackPrefix) + names::SpecularReflectance);
}

} // namespace

bool vtkPhongGouraudHelper::HighlightsOfCells()
{
  return this->MaterialsOfHighlights && this->MaterialBuffer.Texture != nullptr;
}

bool vtkPhongGouraudHelper::Shines(vtkActor* act)
{
  if (this->Mapper()->FieldMode != vtkPhongGouraudMapper::FIELD_ON)
  {
    return false;
  }
  const auto shines = [](vtkProperty* p) {
    const double* c = p ? p->GetSpecularColor() : nullptr;
    return c && p->GetSpecular() > 0.0 && (c[0] != 0.0 || c[1] != 0.0 || c[2] != 0.0);
  };
  return this->HighlightsOfCells()
    ? this->SpecularMaterials
    : shines(act->GetProperty()) || shines(act->GetBackfaceProperty());
}

void vtkPhongGouraudHelper::BuildMaterials(vtkRenderer* ren, vtkActor* act)
{
  this->SpecularMaterials = false;
  this->EmittingMaterials = false;
  const std::vector<vtkradiometry::DrawnBlock*> blocks = this->Blocks();
  this->SpectralMaterials = false;
  this->MaterialsOfHighlights = this->Mapper()->FieldMode == vtkPhongGouraudMapper::FIELD_ON &&
    std::any_of(blocks.begin(), blocks.end(), [](const vtkradiometry::DrawnBlock* drawn) {
      return HasHighlights(vtkradiometry::DataOf(*drawn));
    });
  const bool lit = this->Mapper()->FieldMode == vtkPhongGouraudMapper::FIELD_MATERIALS;
  if ((!lit && !this->MaterialsOfHighlights) || blocks.empty() ||
    act->GetProperty()->GetRepresentation() != VTK_SURFACE)
  {
    this->MaterialBuffer.Free();
    this->MaterialOfCellBuffer.Free();
    return;
  }
  std::map<Material, int, ByBytes> numbers; // few: most cells share theirs
  std::vector<float> texels;
  std::vector<float> ofTriangle;
  for (vtkradiometry::DrawnBlock* drawn : blocks)
  {
    const BlockMaterials materials(vtkradiometry::DataOf(*drawn), act);
    this->SpectralMaterials = this->SpectralMaterials || materials.IsSpectral();
    vtkOpenGLCellToVTKCellMap* map = drawn->CellCellMap;
    ofTriangle.resize(4 * static_cast<std::size_t>(map->GetFinalOffset()), 0.0f);
    const std::size_t begin = static_cast<std::size_t>(map->GetPrimitiveOffsets()[0]);
    for (std::size_t i = 0; i < map->GetSize(); ++i)
    {
      const Material material = materials.At(map->GetValue(i));
      const auto found = numbers.emplace(material, static_cast<int>(numbers.size()));
      if (found.second)
      {
        texels.insert(texels.end(), material.begin(), material.end());
        const auto reflects = [&material](int first) {
          return material[first] != 0.0f || material[first + 1] != 0.0f ||
            material[first + 2] != 0.0f;
        };
        this->SpecularMaterials = this->SpecularMaterials || reflects(4) || reflects(16);
        this->EmittingMaterials = this->EmittingMaterials || reflects(8) || reflects(20);
      }
      ofTriangle[4 * (begin + i)] = static_cast<float>(found.first->second);
    }
  }
  this->MaterialBuffer.Upload(ren, std::move(texels));
  this->MaterialOfCellBuffer.Upload(ren, std::move(ofTriangle));
}
