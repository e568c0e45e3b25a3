// SPDX-License-Identifier: BSD-3-Clause
// What light meets and what is there of it without a source: the optics of SceneAdapter's scene.
#include "SceneAdapter.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace names = radiometry::names;
using radiometry::InputError;

namespace
{

/// A material array of a block: cell data, or field data of one tuple.
vtkDataArray* FindArray(const SceneAdapter::Block& block, const std::string& name)
{
  if (vtkDataArray* array = block.Data->GetCellData()->GetArray(name.c_str()))
  {
    if (array->GetNumberOfTuples() != block.Cells)
    {
      throw InputError(block.Name + name, -1, std::to_string(array->GetNumberOfTuples()) + " tuples",
        std::to_string(block.Cells) + ", one a cell");
    }
    return array;
  }
  vtkDataArray* array =
    vtkDataArray::SafeDownCast(block.Data->GetFieldData()->GetAbstractArray(name.c_str()));
  if (array && array->GetNumberOfTuples() != 1)
  {
    throw InputError(block.Name + name + " (field data)", -1,
      std::to_string(array->GetNumberOfTuples()) + " tuples", "one tuple, for the whole block");
  }
  return array;
}

const char* const SpectralNames[] = { names::DiffuseReflectance, names::SpecularReflectance,
  names::DiffuseTransmittance, names::EmittedExitance, names::Transmittance };

/// Reads one array of every block, cells x bands in [0, most]; `values` stays as it is when no block
/// has it.
void ReadArray(const std::vector<SceneAdapter::Block>& blocks, const std::string& name, double most,
  double fallback, int bands, std::size_t size, std::vector<double>& values)
{
  for (const SceneAdapter::Block& block : blocks)
  {
    vtkDataArray* array = FindArray(block, name);
    if (!array)
    {
      continue;
    }
    if (values.empty())
    {
      values.assign(size, fallback);
    }
    const bool whole = array->GetNumberOfTuples() == 1 && block.Cells != 1;
    const int components = array->GetNumberOfComponents();
    for (vtkIdType c = 0; c < block.Cells; ++c)
    {
      for (int b = 0; b < bands; ++b)
      {
        const double value = array->GetComponent(whole ? 0 : c, components == 1 ? 0 : b);
        if (!(value >= 0.0 && value <= most))
        {
          throw InputError(block.Name + name, whole ? 0 : c, value,
            std::isinf(most) ? "a finite number of at least 0" : "a number in [0, 1]");
        }
        if (std::isinf(value))
        {
          throw InputError(block.Name + name, whole ? 0 : c, value, "a finite number");
        }
        if (block.Number(c) >= 0)
        {
          values[static_cast<std::size_t>(block.Number(c)) * bands + b] = value;
        }
      }
    }
  }
}

/// Reads the exponents of the specular lobes of one side, one a cell; `values` stays as it is when
/// no block has any. Infinity is a perfect mirror.
void ReadShininess(const std::vector<SceneAdapter::Block>& blocks, const std::string& name,
  std::size_t cells, std::vector<double>& values)
{
  for (const SceneAdapter::Block& block : blocks)
  {
    vtkDataArray* array = FindArray(block, name);
    if (!array)
    {
      continue;
    }
    if (array->GetNumberOfComponents() != 1)
    {
      throw InputError(block.Name + name, -1,
        std::to_string(array->GetNumberOfComponents()) + " components", "one: the Phong exponent");
    }
    if (values.empty())
    {
      values.assign(cells, radiometry::DefaultShininess);
    }
    const bool whole = array->GetNumberOfTuples() == 1 && block.Cells != 1;
    for (vtkIdType c = 0; c < block.Cells; ++c)
    {
      const double value = array->GetComponent(whole ? 0 : c, 0);
      if (!(value >= 0.0))
      {
        throw InputError(block.Name + name, whole ? 0 : c, value,
          "a Phong exponent of at least 0 (1e6 and more, or infinite: a perfect mirror)");
      }
      if (block.Number(c) >= 0)
      {
        values[static_cast<std::size_t>(block.Number(c))] = value;
      }
    }
  }
}

/// What is reflected and transmitted may not exceed what came.
void CheckSums(
  const std::vector<SceneAdapter::Block>& blocks, const radiometry::Materials& optics)
{
  for (const SceneAdapter::Block& block : blocks)
  {
    for (vtkIdType c = 0; c < block.Cells; ++c)
    {
      for (int b = 0; b < optics.Bands && block.Number(c) >= 0; ++b)
      {
        const std::size_t at = static_cast<std::size_t>(block.Number(c)) * optics.Bands + b;
        for (int side = 0; side < 2; ++side)
        {
          const double sum = optics.DiffuseReflectance[side][at] +
            (optics.SpecularReflectance[side].empty() ? 0.0
                                                      : optics.SpecularReflectance[side][at]) +
            (optics.Transmittance.empty() ? 0.0 : optics.Transmittance[at]) +
            (optics.DiffuseTransmittance.empty() ? 0.0 : optics.DiffuseTransmittance[at]);
          if (sum > 1.0 + 1e-12)
          {
            throw InputError(block.Name +
                "DiffuseReflectance + SpecularReflectance + Transmittance + DiffuseTransmittance",
              c, sum,
              std::string("at most 1 in each band (") + (side == 0 ? "front" : "back") + ")");
          }
        }
      }
    }
  }
}

} // namespace

int SceneAdapter::FindBands() const
{
  int bands = 1;
  std::string where = "one band";
  const auto see = [&](vtkDataArray* array, const std::string& name) {
    if (!array || array->GetNumberOfComponents() == 1)
    {
      return;
    }
    const int n = array->GetNumberOfComponents();
    if (bands != 1 && n != bands)
    {
      throw InputError(name, -1, std::to_string(n) + " bands",
        "1 or " + std::to_string(bands) + " bands, as " + where);
    }
    if (n > 1024)
    {
      throw InputError(name, -1, std::to_string(n) + " bands", "at most 1024 bands");
    }
    bands = n;
    where = name;
  };
  for (const Block& block : this->Surface)
  {
    for (const char* name : SpectralNames)
    {
      see(FindArray(block, name), block.Name + name);
      see(FindArray(block, std::string(names::BackPrefix) + name),
        block.Name + names::BackPrefix + name);
    }
    for (const std::string& name : this->FurtherSpectra)
    {
      see(block.Data->GetCellData()->GetArray(name.c_str()), block.Name + name);
      see(block.Data->GetPointData()->GetArray(name.c_str()), block.Name + name);
    }
  }
  for (const Block& block : this->Occluders)
  {
    see(FindArray(block, names::Transmittance), block.Name + names::Transmittance);
  }
  for (const auto& [name, array] : this->AmbientArrays)
  {
    see(array, name);
  }
  for (const Block& block : this->Lights)
  {
    see(block.Data->GetPointData()->GetArray(names::Intensity), block.Name + names::Intensity);
  }
  return bands;
}

void SceneAdapter::ReadMaterials(radiometry::Scene& scene) const
{
  radiometry::Materials& optics = scene.Optics;
  const std::size_t size = scene.Cells * static_cast<std::size_t>(optics.Bands);
  if (!(this->DiffuseReflectance >= 0.0 && this->DiffuseReflectance <= 1.0))
  {
    throw InputError("DiffuseReflectance", -1, this->DiffuseReflectance, "a number in [0, 1]");
  }
  const auto read = [&](const std::string& name, double most, double fallback,
                      std::vector<double>& values) {
    ReadArray(this->Surface, name, most, fallback, optics.Bands, size, values);
  };
  const auto readSides = [&](const char* name, double most, double fallback,
                           std::array<std::vector<double>, 2>& sides) {
    read(name, most, fallback, sides[0]);
    sides[1] = sides[0];
    read(std::string(names::BackPrefix) + name, most, fallback, sides[1]);
    if (sides[0].empty() && !sides[1].empty())
    {
      sides[0].assign(size, fallback);
    }
  };
  const double infinite = std::numeric_limits<double>::infinity();
  readSides(names::DiffuseReflectance, 1.0, this->DiffuseReflectance, optics.DiffuseReflectance);
  readSides(names::SpecularReflectance, 1.0, 0.0, optics.SpecularReflectance);
  ReadShininess(this->Surface, names::Shininess, scene.Cells, optics.Shininess[0]);
  optics.Shininess[1] = optics.Shininess[0];
  ReadShininess(this->Surface, std::string(names::BackPrefix) + names::Shininess, scene.Cells,
    optics.Shininess[1]);
  if (optics.Shininess[0].empty() && !optics.Shininess[1].empty())
  {
    optics.Shininess[0].assign(scene.Cells, radiometry::DefaultShininess);
  }
  readSides(names::EmittedExitance, infinite, 0.0, optics.EmittedExitance);
  read(names::DiffuseTransmittance, 1.0, 0.0, optics.DiffuseTransmittance);
  read(names::Transmittance, 1.0, 0.0, optics.Transmittance);
  for (auto& side : optics.DiffuseReflectance)
  {
    if (side.empty())
    {
      side.assign(size, this->DiffuseReflectance);
    }
  }
  optics.TwoSided.assign(scene.Cells, this->TwoSided ? 1 : 0);
  for (const Block& block : this->Surface)
  {
    if (vtkDataArray* array = FindArray(block, names::TwoSided))
    {
      const bool whole = array->GetNumberOfTuples() == 1 && block.Cells != 1;
      for (vtkIdType c = 0; c < block.Cells; ++c)
      {
        if (block.Number(c) >= 0)
        {
          optics.TwoSided[block.Number(c)] = array->GetComponent(whole ? 0 : c, 0) != 0.0;
        }
      }
    }
  }
  CheckSums(this->Surface, optics);
}

void SceneAdapter::ReadTransmittance(
  const std::vector<std::int32_t>& occluderCells, radiometry::Scene& scene) const
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  std::size_t cells = 0;
  for (const Block& block : this->Occluders)
  {
    cells += static_cast<std::size_t>(block.Cells);
  }
  cells = this->Gathered ? this->GatheredOccluders : cells;
  std::vector<double> occluders;
  ReadArray(this->Occluders, names::Transmittance, 1.0, 0.0, scene.Optics.Bands, cells * bands,
    occluders);
  const auto passes = [](double share) { return share > 0.0; };
  const std::vector<double>& surface = scene.Optics.Transmittance;
  if (std::none_of(surface.begin(), surface.end(), passes) &&
    std::none_of(occluders.begin(), occluders.end(), passes))
  {
    return;
  }
  scene.TriangleTransmittance.assign(scene.Triangles.size() * bands, 0.0);
  for (std::size_t t = 0; t < scene.Triangles.size(); ++t)
  {
    const bool receiver = t < scene.ReceiverTriangles;
    const std::vector<double>& from = receiver ? surface : occluders;
    const auto cell = static_cast<std::size_t>(
      receiver ? scene.TriangleCell[t] : occluderCells[t - scene.ReceiverTriangles]);
    for (std::size_t b = 0; b < bands && !from.empty(); ++b)
    {
      scene.TriangleTransmittance[t * bands + b] = from[cell * bands + b];
    }
  }
}

void SceneAdapter::ReadAmbient(radiometry::Scene& scene) const
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  const auto check = [](const std::string& name, double value) {
    if (!(value >= 0.0) || !std::isfinite(value))
    {
      throw InputError(name, -1, value, "W/m^2, a finite number of at least 0");
    }
  };
  check(names::GlobalAmbient, this->GlobalAmbient);
  std::vector<double> ambient(bands, this->GlobalAmbient);
  for (const auto& [name, array] : this->AmbientArrays)
  {
    if (array->GetNumberOfTuples() != 1)
    {
      throw InputError(name, -1, std::to_string(array->GetNumberOfTuples()) + " tuples",
        "one tuple (field data)");
    }
    for (std::size_t b = 0; b < bands; ++b)
    {
      const double value =
        array->GetComponent(0, array->GetNumberOfComponents() == 1 ? 0 : static_cast<int>(b));
      check(name, value);
      ambient[b] += value;
    }
  }
  if (std::any_of(ambient.begin(), ambient.end(), [](double e) { return e > 0.0; }))
  {
    scene.GlobalAmbient = ambient;
  }
}
