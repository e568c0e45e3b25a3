// SPDX-License-Identifier: BSD-3-Clause
// The parts of a scene that several processes hold, brought together.
#include "SceneGathering.h"

#include "ControllerCommunicator.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/CandelaWeb.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/SkyRadiance.h"

#include "vtkCellData.h"
#include "vtkCharArray.h"
#include "vtkCommunicator.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <tuple>

namespace names = radiometry::names;
using Block = SceneAdapter::Block;
using Blocks = std::vector<SceneAdapter::Block>;

namespace
{

/// The global ids among attributes, by the attribute or by the name that VTK gives them.
vtkDataArray* FindIds(vtkDataSetAttributes* data, const char* name)
{
  vtkDataArray* ids = vtkDataArray::SafeDownCast(data->GetGlobalIds());
  ids = ids ? ids : data->GetArray(name);
  return ids && ids->GetNumberOfComponents() == 1 ? ids : nullptr;
}

void CopyArray(vtkFieldData* from, const std::string& name, vtkIdType tuples, vtkFieldData* to)
{
  vtkAbstractArray* array = from->GetAbstractArray(name.c_str());
  if (array && array->GetNumberOfTuples() > 0 &&
    (tuples < 0 || array->GetNumberOfTuples() == tuples))
  {
    to->AddArray(array);
  }
}

void CopyIds(vtkDataSetAttributes* from, const char* found, const char* kept, vtkIdType tuples,
  vtkDataSetAttributes* to)
{
  vtkDataArray* ids = FindIds(from, found);
  if (ids && ids->GetNumberOfTuples() == tuples && tuples > 0)
  {
    auto copy = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(ids->GetDataType()));
    copy->DeepCopy(ids);
    copy->SetName(kept);
    to->AddArray(copy);
  }
}

/// What the scene needs of a part of the surface or of occluders.
vtkSmartPointer<vtkPolyData> Essence(const Block& block, const std::vector<std::string>& more)
{
  vtkPolyData* data = block.Data;
  auto out = vtkSmartPointer<vtkPolyData>::New();
  out->CopyStructure(data);
  const vtkIdType cells = data->GetNumberOfCells();
  const vtkIdType points = data->GetNumberOfPoints();
  std::vector<std::string> arrays = more;
  for (const char* name : { names::DiffuseReflectance, names::SpecularReflectance, names::Shininess,
         names::EmittedExitance, names::Transmittance, "DiffuseTransmittance" })
  {
    arrays.emplace_back(name);
    arrays.push_back(std::string(names::BackPrefix) + name);
  }
  arrays.emplace_back(names::TwoSided);
  for (const std::string& name : arrays)
  {
    vtkAbstractArray* onCells = data->GetCellData()->GetAbstractArray(name.c_str());
    if (onCells && cells > 0)
    {
      out->GetCellData()->AddArray(onCells); // of any length: it is checked later
    }
    CopyArray(data->GetFieldData(), name, -1, out->GetFieldData());
  }
  CopyArray(data->GetCellData(), vtkDataSetAttributes::GhostArrayName(), cells, out->GetCellData());
  CopyArray(data->GetPointData(), vtkDataSetAttributes::GhostArrayName(), points, out->GetPointData());
  CopyIds(data->GetCellData(), "GlobalCellIds", GatheredCellIds, cells, out->GetCellData());
  CopyIds(data->GetPointData(), "GlobalPointIds", GatheredPointIds, points, out->GetPointData());
  CopyArray(data->GetPointData(), names::Normals, points, out->GetPointData());
  return out;
}

bool IsCopy(vtkDataArray* ghosts, vtkIdType i)
{
  return ghosts &&
    (static_cast<int>(ghosts->GetComponent(i, 0)) & vtkDataSetAttributes::DUPLICATECELL) != 0;
}

/// Lights without the polygons, and their corners, that another process has.
vtkSmartPointer<vtkPolyData> OwnLights(vtkPolyData* data)
{
  vtkDataArray* ghosts = data->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName());
  auto out = vtkSmartPointer<vtkPolyData>::New();
  if (!ghosts || ghosts->GetNumberOfTuples() != data->GetNumberOfCells())
  {
    out->ShallowCopy(data);
    return out;
  }
  enum : char { Unused, OfCopies, Kept };
  std::vector<char> use(static_cast<std::size_t>(data->GetNumberOfPoints()), Unused);
  vtkNew<vtkIdList> ids;
  data->BuildCells();
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
  {
    data->GetCellPoints(c, ids);
    for (const vtkIdType p : *ids)
    {
      char& u = use[static_cast<std::size_t>(p)];
      u = std::max(u, IsCopy(ghosts, c) ? char(OfCopies) : char(Kept));
    }
  }
  std::vector<vtkIdType> place(use.size(), -1);
  vtkNew<vtkPoints> points;
  points->SetDataType(data->GetPoints() ? data->GetPoints()->GetDataType() : VTK_DOUBLE);
  out->GetPointData()->CopyAllOn();
  out->GetPointData()->CopyAllocate(data->GetPointData());
  for (std::size_t p = 0; p < use.size(); ++p)
  {
    if (use[p] != OfCopies)
    {
      place[p] = points->InsertNextPoint(data->GetPoint(static_cast<vtkIdType>(p)));
      out->GetPointData()->CopyData(data->GetPointData(), static_cast<vtkIdType>(p), place[p]);
    }
  }
  out->SetPoints(points);
  out->AllocateEstimate(data->GetNumberOfCells(), 4);
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
  {
    if (!IsCopy(ghosts, c))
    {
      data->GetCellPoints(c, ids);
      for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
      {
        ids->SetId(k, place[static_cast<std::size_t>(ids->GetId(k))]);
      }
      out->InsertNextCell(data->GetCellType(c), ids);
    }
  }
  out->GetFieldData()->ShallowCopy(data->GetFieldData());
  return out;
}

void Append(std::vector<char>& bytes, const void* data, std::size_t count)
{
  const char* from = static_cast<const char*>(data);
  bytes.insert(bytes.end(), from, from + count);
}
void AppendSized(std::vector<char>& bytes, const void* data, std::size_t count)
{
  const auto size = static_cast<std::uint64_t>(count);
  Append(bytes, &size, sizeof(size));
  Append(bytes, data, count);
}

/// Reads what was appended.
class Parcel
{
public:
  explicit Parcel(std::vector<char>& bytes)
    : At(bytes.data())
  {
  }
  template <class T>
  T Value()
  {
    T value;
    std::memcpy(&value, this->At, sizeof(T));
    this->At += sizeof(T);
    return value;
  }
  std::pair<char*, std::size_t> Sized()
  {
    const auto size = static_cast<std::size_t>(this->Value<std::uint64_t>());
    char* begin = this->At;
    this->At += size;
    return { begin, size };
  }

private:
  char* At;
};

/// A block as it travels.
struct Travelling
{
  Block Part;
  int Rank = 0;
  std::size_t Place = 0; // among its rank's
  char* Data = nullptr;
  std::size_t Size = 0;

  bool SameAs(const Travelling& other) const
  {
    return this->Part.Leaf == other.Part.Leaf && this->Rank != other.Rank &&
      this->Size == other.Size && std::memcmp(this->Data, other.Data, this->Size) == 0;
  }
};

std::vector<char> Pack(const Blocks& blocks, const Blocks& originals)
{
  std::vector<char> bytes;
  const auto count = static_cast<std::uint64_t>(blocks.size());
  Append(bytes, &count, sizeof(count));
  for (std::size_t k = 0; k < blocks.size(); ++k)
  {
    const Block& block = blocks[k];
    Append(bytes, &block.Leaf, sizeof(block.Leaf));
    const char kind[2] = { static_cast<char>(originals[k].Sensors), static_cast<char>(block.Skin) };
    Append(bytes, kind, 2);
    AppendSized(bytes, block.Name.data(), block.Name.size());
    vtkNew<vtkCharArray> buffer;
    if (!vtkCommunicator::MarshalDataObject(block.Data, buffer))
    {
      throw std::runtime_error("a part of the scene could not be sent to the other ranks");
    }
    AppendSized(bytes, buffer->GetPointer(0), static_cast<std::size_t>(buffer->GetNumberOfTuples()));
  }
  return bytes;
}

std::vector<Travelling> Unpack(std::vector<std::vector<char>>& bytes)
{
  std::vector<Travelling> parts;
  for (std::size_t r = 0; r < bytes.size(); ++r)
  {
    Parcel parcel(bytes[r]);
    const auto count = static_cast<std::size_t>(parcel.Value<std::uint64_t>());
    for (std::size_t k = 0; k < count; ++k)
    {
      Travelling part;
      part.Rank = static_cast<int>(r);
      part.Place = k;
      part.Part.Leaf = parcel.Value<std::int64_t>();
      part.Part.Sensors = parcel.Value<char>() != 0;
      part.Part.Skin = parcel.Value<char>() != 0;
      const auto name = parcel.Sized();
      part.Part.Name = std::string(name.first, name.second);
      std::tie(part.Data, part.Size) = parcel.Sized();
      parts.push_back(std::move(part));
    }
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Travelling& a, const Travelling& b) {
    return a.Part.Leaf < b.Part.Leaf;
  });
  return parts;
}

/// `blocks` become those of all ranks. Returns the place among them of each that this one had.
std::vector<std::size_t> Exchange(
  const ControllerCommunicator* ranks, Blocks& blocks, const Blocks& originals)
{
  std::vector<std::size_t> own(blocks.size());
  if (!ranks)
  {
    for (std::size_t k = 0; k < own.size(); ++k)
    {
      own[k] = k;
    }
    return own;
  }
  std::vector<std::vector<char>> bytes = ranks->GatherBytes(Pack(blocks, originals));
  const std::vector<Travelling> parts = Unpack(bytes);
  std::vector<std::size_t> kept; // places in `parts`
  Blocks all;
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    const Travelling& part = parts[k];
    std::size_t at = all.size();
    for (std::size_t j = kept.size(); j-- > 0 && parts[kept[j]].Part.Leaf == part.Part.Leaf;)
    {
      at = part.SameAs(parts[kept[j]]) ? j : at;
    }
    if (part.Rank == ranks->Rank())
    {
      own[part.Place] = at;
    }
    if (at < all.size())
    {
      continue;
    }
    Block block = part.Part;
    vtkNew<vtkCharArray> buffer;
    buffer->SetArray(part.Data, static_cast<vtkIdType>(part.Size), 1);
    block.Data = vtkPolyData::SafeDownCast(vtkCommunicator::UnMarshalDataObject(buffer));
    if (!block.Data)
    {
      throw std::runtime_error("a part of the scene did not arrive whole");
    }
    block.Name = "rank " + std::to_string(part.Rank) + ", " + block.Name;
    block.Cells = block.Data->GetNumberOfCells();
    all.push_back(std::move(block));
    kept.push_back(k);
  }
  blocks = std::move(all);
  return own;
}

/// A part is a grid of sensors when all of its leaf are; what is empty has no say.
void AgreeOnSensors(Blocks& parts)
{
  for (std::size_t first = 0, end = 0; first < parts.size(); first = end)
  {
    bool sensors = true;
    for (end = first; end < parts.size() && parts[end].Leaf == parts[first].Leaf; ++end)
    {
      sensors = sensors && (parts[end].Sensors || parts[end].Data->GetNumberOfPoints() == 0);
    }
    for (std::size_t k = first; k < end; ++k)
    {
      parts[k].Sensors = parts[k].Sensors && sensors;
    }
  }
}

bool AnyCopies(const Blocks& blocks)
{
  return std::any_of(blocks.begin(), blocks.end(), [](const Block& block) {
    vtkDataArray* ghosts =
      block.Data->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName());
    for (vtkIdType c = 0; ghosts && c < ghosts->GetNumberOfTuples(); ++c)
    {
      if (IsCopy(ghosts, c))
      {
        return true;
      }
    }
    return false;
  });
}

Blocks Essences(const Blocks& blocks, const std::vector<std::string>& more)
{
  Blocks out = blocks;
  for (Block& block : out)
  {
    block.Data = Essence(block, more);
  }
  return out;
}

} // namespace

void SceneAdapter::Gather(const ControllerCommunicator* ranks)
{
  if (!ranks && !AnyCopies(this->Surface) && !AnyCopies(this->Occluders))
  {
    return;
  }
  this->Gathered = true;
  this->Own = this->Surface;
  std::vector<std::vector<std::int32_t>> numbers;

  this->Surface = Essences(this->Surface, this->FurtherArrays);
  const std::vector<std::size_t> own = Exchange(ranks, this->Surface, this->Own);
  AgreeOnSensors(this->Surface);
  this->GatheredCells = PartNumbers::OfCells(this->Surface, numbers);
  std::vector<std::vector<std::int32_t>> points;
  PartNumbers::OfSensors(this->Surface, points);
  for (std::size_t k = 0; k < own.size(); ++k)
  {
    this->Own[k].Gathered = true;
    this->Own[k].Part = own[k];
    this->Own[k].Sensors = this->Surface[own[k]].Sensors;
    this->Own[k].Numbers = numbers[own[k]];
    this->Own[k].PointNumbers = points[own[k]];
  }

  const std::vector<Block> occluders = this->Occluders;
  this->Occluders = Essences(this->Occluders, {});
  Exchange(ranks, this->Occluders, occluders);
  this->GatheredOccluders = PartNumbers::OfCells(this->Occluders, numbers);

  for (Block& block : this->Lights)
  {
    block.Data = OwnLights(block.Data);
  }
  const std::vector<Block> lights = this->Lights;
  Exchange(ranks, this->Lights, lights);
  for (Block& block : this->Lights)
  {
    block.Gathered = true;
  }
  this->GatherTransform(ranks);
}

void SceneAdapter::GatherTransform(const ControllerCommunicator* ranks)
{
  if (!ranks)
  {
    return;
  }
  std::vector<char> mine;
  Append(mine, this->ObjectTransform.data(),
    this->OwnTransform ? sizeof(double) * this->ObjectTransform.size() : 0);
  for (const std::vector<char>& bytes : ranks->GatherBytes(mine))
  {
    radiometry::Affine other;
    if (bytes.empty())
    {
      continue;
    }
    std::memcpy(other.data(), bytes.data(), bytes.size());
    if (this->OwnTransform && other != this->ObjectTransform)
    {
      throw radiometry::InputError(
        names::ObjectTransform, -1, "differs between ranks", "one transform for the whole surface");
    }
    this->OwnTransform = true;
    this->ObjectTransform = other;
  }
}

namespace
{

bool SameWeb(const radiometry::CandelaWeb* a, const radiometry::CandelaWeb* b)
{
  return a == b ||
    (a && b && a->GetType() == b->GetType() && a->GetHorizontal() == b->GetHorizontal() &&
      a->GetVertical() == b->GetVertical() && a->GetValues() == b->GetValues());
}
bool SameSky(const radiometry::SkyRadiance* a, const radiometry::SkyRadiance* b)
{
  return a == b ||
    (a && b && a->Model() == b->Model() && a->Bands() == b->Bands() && a->Width() == b->Width() &&
      a->Coefficients() == b->Coefficients() && a->ToSun() == b->ToSun() &&
      a->GroundRadiance() == b->GroundRadiance() && a->Values() == b->Values());
}
bool SameLight(const radiometry::LightRecord& a, const radiometry::LightRecord& b)
{
  return a.Type == b.Type && a.Position == b.Position && a.Direction == b.Direction &&
    a.Reference == b.Reference && a.Intensity == b.Intensity && a.SpotCutoff == b.SpotCutoff &&
    a.SpotInnerCutoff == b.SpotInnerCutoff && a.SpotExponent == b.SpotExponent &&
    a.Attenuation == b.Attenuation && a.Polygon == b.Polygon && a.TwoSided == b.TwoSided &&
    a.Enabled == b.Enabled && a.AttachedTo == b.AttachedTo && SameWeb(a.Web.get(), b.Web.get()) &&
    SameSky(a.Environment.get(), b.Environment.get());
}

} // namespace

std::vector<radiometry::LightRecord> LightsOnce::New(
  const SceneAdapter::Block& part, std::vector<radiometry::LightRecord> lights)
{
  if (!part.Gathered)
  {
    return lights;
  }
  if (part.Leaf != this->Leaf)
  {
    this->Leaf = part.Leaf;
    this->Known.clear();
  }
  std::vector<radiometry::LightRecord> added;
  std::vector<char> met(this->Known.size(), 0); // by a light of this part
  for (radiometry::LightRecord& light : lights)
  {
    std::size_t k = 0;
    while (k < met.size() && (met[k] != 0 || !SameLight(this->Known[k], light)))
    {
      ++k;
    }
    if (k < met.size())
    {
      met[k] = 1;
    }
    else
    {
      added.push_back(std::move(light));
    }
  }
  this->Known.insert(this->Known.end(), added.begin(), added.end());
  return added;
}
