// SPDX-License-Identifier: BSD-3-Clause
#include "StatisticsGathering.h"

#include "ControllerCommunicator.h"
#include "SensorGrid.h"
#include "radiometry/scene/ArrayNames.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCharArray.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>

namespace names = radiometry::names;

namespace
{

bool IsCopy(vtkDataArray* ghosts, vtkIdType i)
{
  return ghosts &&
    (static_cast<int>(ghosts->GetComponent(i, 0)) & vtkDataSetAttributes::DUPLICATECELL) != 0;
}

vtkDataArray* Ghosts(vtkDataSetAttributes* data)
{
  return data->GetArray(vtkDataSetAttributes::GhostArrayName());
}

/// Sensors that are no copies, a vertex each.
vtkSmartPointer<vtkPolyData> OwnSensors(vtkPolyData* data)
{
  vtkDataArray* marks = Ghosts(data->GetPointData());
  vtkDataArray* cells = Ghosts(data->GetCellData());
  std::vector<char> copied(static_cast<std::size_t>(data->GetNumberOfPoints()), 0);
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; cells && c < data->GetNumberOfVerts(); ++c)
  {
    data->GetVerts()->GetCellAtId(c, ids);
    for (vtkIdType k = 0; k < ids->GetNumberOfIds() && IsCopy(cells, c); ++k)
    {
      copied[static_cast<std::size_t>(ids->GetId(k))] = 1;
    }
  }
  auto out = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(data->GetPoints()->GetDataType());
  vtkNew<vtkCellArray> verts;
  out->GetPointData()->CopyAllOn();
  out->GetPointData()->CopyAllocate(data->GetPointData());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    if (!IsCopy(marks, i) && copied[static_cast<std::size_t>(i)] == 0)
    {
      const vtkIdType place = points->InsertNextPoint(data->GetPoint(i));
      out->GetPointData()->CopyData(data->GetPointData(), i, place);
      verts->InsertNextCell(1, &place);
    }
  }
  out->SetPoints(points);
  out->SetVerts(verts);
  out->GetFieldData()->ShallowCopy(data->GetFieldData());
  return out;
}

void Keep(vtkFieldData* data, const std::vector<std::string>& arrays)
{
  for (int k = data->GetNumberOfArrays() - 1; k >= 0; --k)
  {
    const char* name = data->GetAbstractArray(k)->GetName();
    if (!name || std::find(arrays.begin(), arrays.end(), name) == arrays.end() ||
      data->GetAbstractArray(k)->GetNumberOfTuples() == 0)
    {
      data->RemoveArray(k);
    }
  }
}

/// A part without copies, with these arrays only.
vtkSmartPointer<vtkPolyData> Essence(vtkPolyData* data, const std::vector<std::string>& arrays)
{
  auto out = vtkSmartPointer<vtkPolyData>::New();
  out->ShallowCopy(data);
  vtkDataArray* ghosts = Ghosts(data->GetCellData());
  if (IsSensorGrid(data) && (ghosts || Ghosts(data->GetPointData())))
  {
    out = OwnSensors(data);
  }
  else if (ghosts)
  {
    out->RemoveGhostCells();
  }
  Keep(out->GetPointData(), arrays);
  Keep(out->GetCellData(), arrays);
  return out;
}

struct Leaf
{
  std::string Name;
  std::vector<vtkSmartPointer<vtkPolyData>> Parts;
  std::vector<std::string> Bytes; // of the parts
};

void Put(std::vector<char>& bytes, const void* data, std::size_t size)
{
  const char* from = static_cast<const char*>(data);
  bytes.insert(bytes.end(), from, from + size);
}
void PutSized(std::vector<char>& bytes, const char* text, std::size_t size)
{
  const auto count = static_cast<std::uint64_t>(size);
  Put(bytes, &count, sizeof(count));
  Put(bytes, text, size);
}

void Pack(std::uint32_t index, const std::string& name, vtkPolyData* part, std::vector<char>& bytes)
{
  vtkNew<vtkCharArray> buffer;
  if (!vtkCommunicator::MarshalDataObject(part, buffer))
  {
    throw std::runtime_error("a part of the surface could not be sent to the first rank");
  }
  Put(bytes, &index, sizeof(index));
  PutSized(bytes, name.data(), name.size());
  PutSized(bytes, buffer->GetPointer(0), static_cast<std::size_t>(buffer->GetNumberOfTuples()));
}

std::string Sized(const char*& at)
{
  std::uint64_t size = 0;
  std::memcpy(&size, at, sizeof(size));
  at += sizeof(size) + size;
  return { at - size, static_cast<std::size_t>(size) };
}

void Unpack(const std::vector<char>& bytes, std::map<std::uint32_t, Leaf>& leaves)
{
  const char* at = bytes.data();
  while (at < bytes.data() + bytes.size())
  {
    std::uint32_t index = 0;
    std::memcpy(&index, at, sizeof(index));
    at += sizeof(index);
    Leaf& leaf = leaves[index];
    leaf.Name = Sized(at);
    std::string data = Sized(at);
    if (std::find(leaf.Bytes.begin(), leaf.Bytes.end(), data) != leaf.Bytes.end())
    {
      continue;
    }
    vtkNew<vtkCharArray> buffer;
    buffer->SetArray(&data[0], static_cast<vtkIdType>(data.size()), 1);
    const vtkSmartPointer<vtkDataObject> object = vtkCommunicator::UnMarshalDataObject(buffer);
    vtkPolyData* part = vtkPolyData::SafeDownCast(object);
    if (!part)
    {
      throw std::runtime_error("a part of the surface did not arrive whole");
    }
    leaf.Parts.emplace_back(part);
    leaf.Bytes.push_back(std::move(data));
  }
}

vtkSmartPointer<vtkPolyData> Together(const Leaf& leaf)
{
  vtkNew<vtkAppendPolyData> append;
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkPolyData* first = nullptr;
  for (const auto& part : leaf.Parts)
  {
    if (part->GetNumberOfPoints() > 0)
    {
      append->AddInputData(part);
      first = first ? first : part.Get();
    }
  }
  auto out = vtkSmartPointer<vtkPolyData>::New();
  if (append->GetNumberOfInputConnections(0) < 2)
  {
    out->ShallowCopy(first ? first : leaf.Parts.front().Get());
    return out;
  }
  append->Update();
  out->ShallowCopy(append->GetOutput());
  out->GetFieldData()->ShallowCopy(first->GetFieldData());
  out->GetFieldData()->RemoveArray(names::SensorGridDimensions);
  return out;
}

} // namespace

vtkSmartPointer<vtkDataObject> GatherForStatistics(const ControllerCommunicator& ranks,
  vtkDataObject* input, const std::vector<std::string>& arrays)
{
  std::vector<char> bytes;
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  if (auto* surface = vtkPolyData::SafeDownCast(input))
  {
    Pack(0, "", Essence(surface, arrays), bytes);
  }
  if (composite)
  {
    auto iterator = vtk::TakeSmartPointer(composite->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      if (auto* part = vtkPolyData::SafeDownCast(iterator->GetCurrentDataObject()))
      {
        const char* name = iterator->HasCurrentMetaData()
          ? iterator->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME())
          : nullptr;
        Pack(iterator->GetCurrentFlatIndex(), name ? name : "", Essence(part, arrays), bytes);
      }
    }
  }
  std::map<std::uint32_t, Leaf> leaves;
  for (const std::vector<char>& of : ranks.GatherBytes(bytes, 0))
  {
    Unpack(of, leaves);
  }
  if (ranks.Rank() != 0)
  {
    return nullptr;
  }
  if (!composite)
  {
    return Together(leaves.begin()->second);
  }
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (const auto& [index, leaf] : leaves)
  {
    const unsigned int k = blocks->GetNumberOfBlocks();
    blocks->SetBlock(k, Together(leaf));
    if (!leaf.Name.empty())
    {
      blocks->GetMetaData(k)->Set(vtkCompositeDataSet::NAME(), leaf.Name.c_str());
    }
  }
  return vtkSmartPointer<vtkDataObject>(blocks.Get());
}
