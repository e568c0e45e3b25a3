// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/formfactor/FormFactorOperator.h"
#include "radiometry/formfactor/GeometryKey.h"
#include "radiometry/irradiance/ExchangeOptions.h"
#include "radiometry/scene/Archive.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace radiometry
{

/// What an operator in a file was made of.
struct OperatorFileHead
{
  ContentKey Geometry;
  std::vector<std::pair<std::string, std::string>> Options; // that shaped it: names and values
  std::string Kind;      // Dense, Hierarchical or MonteCarlo
  double Tolerance = 0.0;
  double Area = 0.0;     // that no element exceeds, m^2; infinite: they were not divided
  double Seconds = 0.0;  // that it took to make
};

/// Writes elements and their operator to a file: aside first, then moved into place, so that there is
/// never half a file under that name. Of several ranks each writes its own part, `name`.<rank>of<size>.
///   Layout  "VTKRADOP", version, byte order; head, elements, operator (Archive.h); their checksum
///   Fails   InputError{"OperatorFile"} where it cannot be written, or the operator is of no kind
///           that can be kept
void WriteOperatorFile(const std::string& name, const OperatorFileHead& head,
  const ElementSet& elements, const FormFactorOperator& F, const Communicator* ranks = nullptr);

/// Reads what WriteOperatorFile wrote, step by step.
///   Fails   InputError{"OperatorFile"} that says why: no such file, not such a file, another version
///           or byte order, damaged, of other geometry or options
class OperatorFile
{
public:
  static constexpr std::uint32_t Version = 1;

  /// Checks version and checksum of the whole file, and reads the head.
  explicit OperatorFile(const std::string& name, const Communicator* ranks = nullptr);

  const OperatorFileHead& Head() const { return this->Read; }
  /// Throws where the operator was made of other geometry or by other options than these.
  void Check(const OperatorFileHead& wanted) const;
  /// Once, after Head; then the operator, which keeps references to all three.
  ElementSet ReadElements();
  std::unique_ptr<FormFactorOperator> ReadOperator(
    const OcclusionScene& occluders, const ElementSet& elements, const ExchangeOptions& options);

private:
  [[noreturn]] void Fail(const std::string& expected) const;
  template <class Function>
  auto Reading(Function&& read);

  std::string Name;
  std::ifstream Stream;
  std::unique_ptr<ArchiveReader> Archive;
  OperatorFileHead Read;
};

} // namespace radiometry
