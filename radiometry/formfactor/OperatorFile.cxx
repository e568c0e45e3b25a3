// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/OperatorFile.h"

#include "radiometry/formfactor/DenseOperator.h"
#include "radiometry/formfactor/HierarchicalOperator.h"
#include "radiometry/formfactor/MonteCarloOperator.h"
#include "radiometry/scene/InputError.h"

#include <array>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace radiometry
{
namespace
{

constexpr char Magic[8] = { 'V', 'T', 'K', 'R', 'A', 'D', 'O', 'P' };
constexpr std::uint32_t ByteOrder = 0x01020304;
constexpr std::size_t Preamble = sizeof(Magic) + 2 * sizeof(std::uint32_t);

std::string PartName(const std::string& name, const Communicator* ranks)
{
  return ranks && ranks->Size() > 1
    ? name + "." + std::to_string(ranks->Rank()) + "of" + std::to_string(ranks->Size())
    : name;
}

void PutHead(ArchiveWriter& out, const OperatorFileHead& head)
{
  out.Put(head.Geometry.Low);
  out.Put(head.Geometry.High);
  out.Put(static_cast<std::uint64_t>(head.Options.size()));
  for (const auto& [name, value] : head.Options)
  {
    out.Put(name);
    out.Put(value);
  }
  out.Put(head.Kind);
  out.Put(head.Tolerance);
  out.Put(head.Area);
  out.Put(head.Seconds);
}

OperatorFileHead GetHead(ArchiveReader& in)
{
  OperatorFileHead head;
  head.Geometry.Low = in.Get<std::uint64_t>();
  head.Geometry.High = in.Get<std::uint64_t>();
  const auto options = in.Get<std::uint64_t>();
  for (std::uint64_t k = 0; k < options; ++k)
  {
    std::string name = in.GetText();
    head.Options.emplace_back(std::move(name), in.GetText());
  }
  head.Kind = in.GetText();
  head.Tolerance = in.Get<double>();
  head.Area = in.Get<double>();
  head.Seconds = in.Get<double>();
  return head;
}

void PutOperator(ArchiveWriter& out, const FormFactorOperator& F, const std::string& name)
{
  if (const auto* dense = dynamic_cast<const DenseOperator*>(&F))
  {
    dense->Save(out);
  }
  else if (const auto* links = dynamic_cast<const HierarchicalOperator*>(&F))
  {
    links->Save(out);
  }
  else if (const auto* carlo = dynamic_cast<const MonteCarloOperator*>(&F))
  {
    carlo->Save(out);
  }
  else
  {
    throw InputError("OperatorFile", -1, name, "an operator of a kind that can be kept in a file");
  }
}

/// FNV-1a of all between the preamble and the sum at the end, as ArchiveWriter has it.
std::uint64_t Checksum(std::istream& stream, std::uint64_t bytes)
{
  std::uint64_t sum = 14695981039346656037ull;
  std::array<char, 1 << 16> block;
  while (bytes > 0)
  {
    const auto now = static_cast<std::streamsize>(std::min<std::uint64_t>(bytes, block.size()));
    stream.read(block.data(), now);
    for (std::streamsize k = 0; k < stream.gcount(); ++k)
    {
      sum = (sum ^ static_cast<unsigned char>(block[static_cast<std::size_t>(k)])) * 1099511628211ull;
    }
    if (stream.gcount() != now)
    {
      return ~sum;
    }
    bytes -= static_cast<std::uint64_t>(now);
  }
  return sum;
}

template <class T>
std::shared_ptr<const T> Borrowed(const T& object)
{
  return { std::shared_ptr<const T>(), &object };
}

} // namespace

void WriteOperatorFile(const std::string& name, const OperatorFileHead& head,
  const ElementSet& elements, const FormFactorOperator& F, const Communicator* ranks)
{
  const std::string part = PartName(name, ranks);
  const std::string aside = part + ".part";
  std::error_code failed;
  try
  {
    std::ofstream stream(aside, std::ios::binary | std::ios::trunc);
    stream.write(Magic, sizeof(Magic));
    for (const std::uint32_t word : { OperatorFile::Version, ByteOrder })
    {
      stream.write(reinterpret_cast<const char*>(&word), sizeof(word));
    }
    ArchiveWriter out(stream);
    PutHead(out, head);
    elements.Save(out);
    PutOperator(out, F, name);
    const std::uint64_t sum = out.Checksum();
    stream.write(reinterpret_cast<const char*>(&sum), sizeof(sum));
    stream.close();
    if (!stream)
    {
      throw std::runtime_error("could not be written");
    }
    std::filesystem::rename(aside, part, failed);
    if (failed)
    {
      throw std::runtime_error(failed.message());
    }
  }
  catch (const InputError&)
  {
    std::filesystem::remove(aside, failed);
    throw;
  }
  catch (const std::exception& error)
  {
    std::filesystem::remove(aside, failed);
    throw InputError(
      "OperatorFile", -1, part, std::string("a file that can be written: it ") + error.what());
  }
}

void OperatorFile::Fail(const std::string& expected) const
{
  throw InputError("OperatorFile", -1, this->Name, expected);
}

template <class Function>
auto OperatorFile::Reading(Function&& read)
{
  try
  {
    return read();
  }
  catch (const InputError&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    this->Fail(std::string("an undamaged operator of this scene: it ") + error.what());
  }
}

OperatorFile::OperatorFile(const std::string& name, const Communicator* ranks)
  : Name(PartName(name, ranks))
  , Stream(this->Name, std::ios::binary)
{
  std::error_code failed;
  const std::uint64_t bytes = std::filesystem::file_size(this->Name, failed);
  if (failed || !this->Stream)
  {
    this->Fail("a file that can be read");
  }
  char magic[sizeof(Magic)] = {};
  std::uint32_t version = 0, order = 0;
  this->Stream.read(magic, sizeof(magic));
  this->Stream.read(reinterpret_cast<char*>(&version), sizeof(version));
  this->Stream.read(reinterpret_cast<char*>(&order), sizeof(order));
  if (!this->Stream || std::memcmp(magic, Magic, sizeof(Magic)) != 0)
  {
    this->Fail("a file that this filter has written: this is none");
  }
  if (order != ByteOrder)
  {
    this->Fail("a file written on a machine with the same order of bytes");
  }
  if (version != Version)
  {
    this->Fail("a file of version " + std::to_string(Version) + ": it is of version " +
      std::to_string(version));
  }
  std::uint64_t sum = 0;
  const std::uint64_t least = Preamble + sizeof(sum);
  const bool whole = bytes >= least;
  const std::uint64_t found = whole ? Checksum(this->Stream, bytes - least) : 0;
  this->Stream.read(reinterpret_cast<char*>(&sum), sizeof(sum));
  if (!whole || !this->Stream || sum != found)
  {
    this->Fail("an undamaged file: it is cut short or its checksum differs");
  }
  this->Stream.seekg(static_cast<std::streamoff>(Preamble));
  this->Archive = std::make_unique<ArchiveReader>(this->Stream, bytes);
  this->Read = this->Reading([this] { return GetHead(*this->Archive); });
}

void OperatorFile::Check(const OperatorFileHead& wanted) const
{
  if (this->Read.Geometry != wanted.Geometry)
  {
    this->Fail("an operator of this scene: points, triangles, cells, receiving sides or "
               "transmittances of surface and occluders differ from those it was made of");
  }
  for (const auto& [name, value] : wanted.Options)
  {
    for (const auto& [theirs, was] : this->Read.Options)
    {
      if (theirs == name && was != value)
      {
        this->Fail("an operator made with the same options: " + name + " was " + was + " and is " +
          value);
      }
    }
  }
  if (this->Read.Options.size() != wanted.Options.size())
  {
    this->Fail("an operator made with the same options");
  }
}

ElementSet OperatorFile::ReadElements()
{
  return this->Reading([this] { return ElementSet::Load(*this->Archive); });
}

std::unique_ptr<FormFactorOperator> OperatorFile::ReadOperator(
  const OcclusionScene& occluders, const ElementSet& elements, const ExchangeOptions& options)
{
  auto F = this->Reading([&]() -> std::unique_ptr<FormFactorOperator> {
    if (this->Read.Kind == "Dense")
    {
      return DenseOperator::Load(*this->Archive, options.Threads, options.Ranks);
    }
    if (this->Read.Kind == "Hierarchical")
    {
      return HierarchicalOperator::Load(*this->Archive, options.Threads, options.Ranks);
    }
    if (this->Read.Kind == "MonteCarlo")
    {
      return MonteCarloOperator::Load(
        *this->Archive, Borrowed(occluders), Borrowed(elements), options);
    }
    throw std::runtime_error("holds an operator of an unknown kind, " + this->Read.Kind);
  });
  if (F->Size() != elements.Size())
  {
    this->Fail("an undamaged operator of this scene: it has another number of elements");
  }
  return F;
}

} // namespace radiometry
