// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/FileError.h"
#include "radiometry/scene/CandelaWeb.h"

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace radiometry::io
{

/// What the intensities of a photometric file are.
enum class IntensityUnits
{
  Auto = 0, // as the file says; candela where it says nothing
  Candela = 1,
  MilliwattPerSteradian = 2,
  WattPerSteradian = 3
};

struct PhotometricOptions
{
  IntensityUnits Units = IntensityUnits::Auto;
  int LampSet = 0;        // EULUMDAT: which of the lamp sets is fitted
  double TiltAngle = 0.0; // LM-63 with TILT: how far the luminaire is tilted, degrees
};

/// Where the light comes from, in metres and the luminaire's frame (CandelaWeb.h): its extent along
/// x (C = 0), y (C = 90) and z, centred on the photometric centre.
struct LuminousOpening
{
  enum Shapes
  {
    Point = 0,
    Rectangle = 1, // facing down; a box where Size.z > 0
    Ellipse = 2,   // facing down; an upright cylinder where Size.z > 0
    Ellipsoid = 3,
    CylinderX = 4, // lying along x
    CylinderY = 5,
    UprightEllipse = 6 // a disc that faces x
  };
  Shapes Shape = Point;
  Vec3 Size;
  /// Luminous heights toward C = 0, 90, 180 and 270.
  std::array<double, 4> Sides{ { 0.0, 0.0, 0.0, 0.0 } };
};

/// A luminaire as a photometric file describes it.
struct PhotometricFile
{
  std::string Format; // "LM-63-2002", "EULUMDAT"
  /// LM-63: what stands in brackets, in the file's order, continued lines joined by line feeds, and
  /// "Label" for free lines; EULUMDAT: the names of its fields.
  std::vector<std::pair<std::string, std::string>> Keywords;
  std::string Manufacturer, Luminaire, Catalogue, Lamp;

  std::shared_ptr<const CandelaWeb> Web;
  IntensityUnits Units = IntensityUnits::Candela; // never Auto
  double Greatest = 0.0; // intensity of the web's greatest value in that unit, all factors applied
  double Factor = 1.0;   // of those factors: what the file's own numbers were multiplied by
  LuminousOpening Opening;
  std::array<double, 3> Housing{ { 0.0, 0.0, 0.0 } }; // EULUMDAT: x, y, z extent; 0: not stated

  double Lamps = 1.0;       // below 0: absolute photometry
  double LampFlux = -1.0;   // of all lamps, lm; below 0: absolute photometry or not stated
  double InputWatts = 0.0;
  double BallastFactor = 1.0;
  std::vector<double> DirectRatios; // EULUMDAT: for room indices k = 0.6 ... 5
  double FluxFromWeb = 0.0;         // lm, mW or W, as Units
  double FluxStated = -1.0;         // of the luminaire, as the header says; below 0: it does not
  std::vector<std::string> Assumptions; // how the file was understood, in whole sentences
  std::vector<std::string> Warnings;    // what is at odds with itself in it

  /// "lm", "mW" or "W"; "cd", "mW/sr" or "W/sr".
  const char* FluxUnit() const;
  const char* IntensityUnit() const;
  /// Value of a keyword (case does not matter); empty when absent.
  std::string Keyword(const std::string& name) const;
};

/// Reads LM-63 (.ies: 1986, 1991, 1995, 2002, 2019) and EULUMDAT (.ldt).
///   LM-63     types C, B and A; TILT=NONE, INCLUDE or a file beside it; feet and metres; candela
///             times multiplier, ballast factor and (before 2002) ballast-lamp photometric factor
///   EULUMDAT  cd/klm times the lamps' flux and the conversion factor; all symmetries
///   Warnings  the flux of the web and the stated one differ by more than 2 %; a luminaire that
///             sends more than 102 % of its lamps' flux; numbers after the end
///   Cost      O(size of the file); at most 64 MiB are read
///   Source    ANSI/IES LM-63-02 (R2008) and LM-63-19; EULUMDAT format, A. Stockmar 1990
///   Fails     FileError with the number of the line: missing, cut short, no number where one is
///             due, counts that the file has no room for, angles or values out of range
PhotometricFile ReadPhotometricFile(
  const std::string& fileName, const PhotometricOptions& options = {});

} // namespace radiometry::io
