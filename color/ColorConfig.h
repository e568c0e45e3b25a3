// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/ColorError.h"

#include <memory>
#include <string>
#include <vector>

namespace radiometry::color
{

/// The text of the project's own config (the file color/radiometry.ocio).
const std::string& BuiltInConfigText();

/// An OpenColorIO config: which colour spaces, displays, views and looks there are.
///
///   Cost    loading is some milliseconds; a copy shares the loaded config
///   Fails   ColorError: no such file, not a config, names that the config does not have
///
/// Colour spaces are found by name, alias or role, without regard to case, as OpenColorIO does.
class ColorConfig
{
public:
  /// The word that asks Open for the project's own config even where $OCIO is set.
  static const char* const BuiltInName; // "builtin"

  /// The config to use: the named file; with an empty name the one that $OCIO names; where that is
  /// not set either (or for the name "builtin") the project's own.
  static ColorConfig Open(const std::string& fileName = {});
  static ColorConfig FromText(const std::string& text, const std::string& origin = "text");

  /// Where it came from: a file name or "builtin".
  const std::string& Origin() const { return this->From; }
  /// Throws ColorError where OpenColorIO finds the config inconsistent.
  void Validate() const;

  std::vector<std::string> ColorSpaces() const;
  std::vector<std::string> Displays() const;
  std::vector<std::string> Views(const std::string& display) const;
  std::vector<std::string> Looks() const;
  std::string DefaultDisplay() const;
  std::string DefaultView(const std::string& display) const;
  bool HasColorSpace(const std::string& name) const;

  /// The name by which this config knows scene-linear Rec.709, what the project computes and draws
  /// in; empty where it has none. Found among the names that published configs use.
  std::string LinearRec709() const;

  /// OpenColorIO's own object, for the sources of this folder.
  struct Impl;
  const Impl& Handle() const { return *this->Data; }

private:
  ColorConfig() = default;
  std::shared_ptr<const Impl> Data;
  std::string From;
};

} // namespace radiometry::color
