// SPDX-License-Identifier: BSD-3-Clause
#include "io/PhotometricParts.h"

#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace radiometry::io
{
namespace
{

constexpr double MetresPerFoot = 0.3048;

std::string Upper(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// The year of the standard that a first line names; 1986 had no such line.
int Version(const std::string& line)
{
  const std::string upper = Upper(line);
  if (upper.compare(0, 3, "IES") != 0)
  {
    return 1986;
  }
  std::string digits;
  for (std::size_t k = upper.size(); k-- > 0;)
  {
    if (std::isdigit(static_cast<unsigned char>(upper[k])))
    {
      digits.insert(digits.begin(), upper[k]);
    }
    else if (!digits.empty())
    {
      break;
    }
  }
  if (digits.size() == 4)
  {
    return std::stoi(digits);
  }
  if (digits.size() == 2)
  {
    const int year = std::stoi(digits);
    return year > 80 ? 1900 + year : 2000 + year;
  }
  return 2002;
}

/// Keywords and labels above the line TILT=; gives that line's number.
std::size_t ReadKeywords(const PhotometricText& text, PhotometricFile& file)
{
  const std::size_t first = Version(text.Line(0)) == 1986 ? 0 : 1;
  for (std::size_t k = first; k < text.Lines(); ++k)
  {
    const std::string line = text.Line(k);
    const std::string upper = Upper(line);
    if (upper.compare(0, 4, "TILT") == 0 && upper.find('=') != std::string::npos)
    {
      return k;
    }
    const std::size_t close = line.find(']');
    if (line.empty() || line[0] != '[' || close == std::string::npos)
    {
      if (!line.empty())
      {
        file.Keywords.emplace_back("Label", line);
      }
      continue;
    }
    const std::string key = Upper(line.substr(1, close - 1));
    const std::size_t from = line.find_first_not_of(" \t", close + 1);
    const std::string value = from == std::string::npos ? std::string() : line.substr(from);
    if (key == "MORE" && !file.Keywords.empty())
    {
      file.Keywords.back().second += "\n" + value;
    }
    else if (key != "END" || !value.empty())
    {
      file.Keywords.emplace_back(key, value);
    }
  }
  text.Fail(text.Lines(), "no line that begins with TILT=: not an IES file, or cut short");
}

/// The factor of a tilt table (LM-63: lamp geometry, count, angles, factors) at an angle.
double ReadTilt(PhotometricNumbers& numbers, double angle, PhotometricFile& file)
{
  const double geometry = numbers.Next("the lamp-to-luminaire geometry of TILT");
  if (geometry != 1.0 && geometry != 2.0 && geometry != 3.0)
  {
    numbers.Fail("lamp-to-luminaire geometry " + Say(geometry) + ": expected 1, 2 or 3");
  }
  const std::size_t count = numbers.NextCount("the number of tilt angles", 1);
  const std::vector<double> angles = numbers.Next(count, "tilt angle");
  const std::vector<double> factors = numbers.Next(count, "tilt factor");
  for (std::size_t k = 0; k < count; ++k)
  {
    if (factors[k] < 0.0 || (k > 0 && !(angles[k] > angles[k - 1])))
    {
      numbers.Fail("tilt angles must rise and tilt factors must not be negative");
    }
  }
  const auto above = std::upper_bound(angles.begin(), angles.end(), angle);
  const std::size_t k = static_cast<std::size_t>(above - angles.begin());
  double factor = factors[k == 0 ? 0 : k - 1]; // beyond either end, the factor there
  if (k > 0 && k < count)
  {
    factor += (angle - angles[k - 1]) / (angles[k] - angles[k - 1]) * (factors[k] - factors[k - 1]);
  }
  file.Assumptions.push_back("TILT: lamp geometry " + Say(geometry) + ", factor " + Say(factor) +
    " at a tilt of " + Say(angle) + " degrees.");
  return factor;
}

double Positive(PhotometricNumbers& numbers, const std::string& what)
{
  const double value = numbers.Next(what);
  if (!(value > 0.0))
  {
    numbers.Fail(what + " is " + Say(value) + ": expected a number above 0");
  }
  return value;
}

/// The line on or above which angles and values went wrong, for an InputError of the web.
[[noreturn]] void FailAs(const InputError& error, const PhotometricText& text, std::size_t angles,
  std::size_t values)
{
  const bool ofAngles = error.Array.find("Horizontal") != std::string::npos ||
    error.Array.find("Vertical") != std::string::npos;
  const std::string where = error.Index < 0 ? std::string() : " " + std::to_string(error.Index + 1);
  const char* what = error.Array.find("Horizontal") != std::string::npos ? "horizontal angle"
    : ofAngles                                                           ? "vertical angle"
                                                                         : "intensity";
  text.Fail(ofAngles ? angles : values,
    what + where + " is " + error.Value + ": expected " + error.Expected);
}

} // namespace

LuminousOpening IesOpening(double width, double length, double height, int version)
{
  using Opening = LuminousOpening;
  Opening opening;
  const double w = std::fabs(width);
  const double l = std::fabs(length);
  const double h = std::fabs(height);
  opening.Size = { l, w, h };
  if (w == 0.0 && l == 0.0 && h == 0.0)
  {
    return opening;
  }
  if (height >= 0.0)
  {
    const bool round = width < 0.0 || length < 0.0;
    opening.Shape = round ? Opening::Ellipse : Opening::Rectangle;
    if (round && (w == 0.0 || l == 0.0))
    {
      opening.Size.x = opening.Size.y = std::max(w, l); // a circle by its diameter alone
    }
  }
  else if (width < 0.0 && length == 0.0 && version >= 2002)
  {
    opening.Shape = Opening::UprightEllipse;
  }
  else if (width <= 0.0 && length <= 0.0)
  {
    opening.Shape = Opening::Ellipsoid;
    const double most = std::max(w, l) > 0.0 ? std::max(w, l) : h;
    opening.Size = { l > 0.0 ? l : most, w > 0.0 ? w : most, h };
  }
  else if (length > 0.0 && width <= 0.0)
  {
    opening.Shape = Opening::CylinderX;
    opening.Size.y = w > 0.0 ? w : h;
  }
  else if (width > 0.0 && length <= 0.0)
  {
    opening.Shape = Opening::CylinderY;
    opening.Size.x = l > 0.0 ? l : h;
  }
  else
  {
    opening.Shape = Opening::Rectangle;
  }
  opening.Sides.fill(opening.Shape <= Opening::Ellipse ? opening.Size.z : 0.0);
  return opening;
}

PhotometricFile ParseIes(const PhotometricText& text, const PhotometricOptions& options)
{
  PhotometricFile file;
  const int version = Version(text.Line(0));
  file.Format = "LM-63-" + std::to_string(version);
  const std::size_t tiltLine = ReadKeywords(text, file);
  const std::string line = text.Line(tiltLine);
  std::string tilt = line.substr(line.find('=') + 1);
  tilt.erase(0, std::min(tilt.find_first_not_of(" \t"), tilt.size()));

  PhotometricNumbers numbers(text, tiltLine + 1);
  double tiltFactor = 1.0;
  if (Upper(tilt) == "INCLUDE")
  {
    tiltFactor = ReadTilt(numbers, options.TiltAngle, file);
  }
  else if (Upper(tilt) != "NONE")
  {
    namespace fs = std::filesystem;
    const fs::path beside = fs::path(text.Name()).parent_path() / fs::path(tilt).filename();
    std::error_code error;
    if (tilt.empty() || !fs::is_regular_file(beside, error))
    {
      text.Fail(tiltLine, "TILT=" + tilt + ": expected NONE, INCLUDE or the name of a file beside it");
    }
    const PhotometricText table(beside.string());
    PhotometricNumbers tableNumbers(table, 0);
    tiltFactor = ReadTilt(tableNumbers, options.TiltAngle, file);
  }

  file.Lamps = numbers.Next("the number of lamps");
  const double lumens = numbers.Next("the lumens per lamp");
  const double multiplier = Positive(numbers, "the candela multiplier");
  const std::size_t verticals = numbers.NextCount("the number of vertical angles", 2);
  const std::size_t horizontals = numbers.NextCount("the number of horizontal angles", 1);
  const double type = numbers.Next("the photometric type");
  if (type != 1.0 && type != 2.0 && type != 3.0)
  {
    numbers.Fail("photometric type " + Say(type) + ": expected 1 (C), 2 (B) or 3 (A)");
  }
  const double units = numbers.Next("the units type");
  if (units != 1.0 && units != 2.0)
  {
    numbers.Fail("units type " + Say(units) + ": expected 1 (feet) or 2 (metres)");
  }
  const double metres = units == 1.0 ? MetresPerFoot : 1.0;
  const double width = metres * numbers.Next("the width of the luminous opening");
  const double length = metres * numbers.Next("the length of the luminous opening");
  const double height = metres * numbers.Next("the height of the luminous opening");
  file.Opening = IesOpening(width, length, height, version);
  file.BallastFactor = Positive(numbers, "the ballast factor");
  const double other = numbers.Next(version >= 2019 ? "the file generation type"
      : version >= 2002                             ? "the field for future use"
                                                    : "the ballast-lamp photometric factor");
  file.InputWatts = numbers.Next("the input watts");
  file.Factor = multiplier * file.BallastFactor * tiltFactor;
  if (version >= 2019)
  {
    file.Keywords.emplace_back("FILEGENERATIONTYPE", Say(other));
  }
  else if (version < 2002 && !(other > 0.0))
  {
    numbers.Fail("the ballast-lamp photometric factor is " + Say(other) + ": expected above 0");
  }
  else if (version < 2002)
  {
    file.Factor *= other;
  }
  else if (other != 1.0)
  {
    file.Assumptions.push_back("The field for future use is " + Say(other) + " and has no effect.");
  }
  if (!(file.Factor > 0.0) || !std::isfinite(file.Factor))
  {
    numbers.Fail("multiplier times factors is " + Say(file.Factor) + ": expected above 0");
  }

  std::vector<double> vertical = numbers.Next(verticals, "vertical angle");
  std::vector<double> horizontal = numbers.Next(horizontals, "horizontal angle");
  const std::size_t angleLine = numbers.Line();
  std::vector<double> values = numbers.Next(verticals * horizontals, "intensity");
  if (const std::size_t left = numbers.Left())
  {
    file.Warnings.push_back(
      std::to_string(left) + " words after the last intensity were not read.");
  }
  const bool mirrored = type != 1.0 && vertical.front() == 0.0;
  try
  {
    file.Web = std::make_shared<CandelaWeb>(static_cast<WebType>(static_cast<int>(type)),
      std::move(horizontal), std::move(vertical), std::move(values), "Web");
  }
  catch (const InputError& error)
  {
    FailAs(error, text, angleLine, numbers.Line());
  }
  if (mirrored)
  {
    file.Assumptions.push_back("Vertical angles from 0 on: taken as mirrored below.");
  }
  file.Greatest = file.Web->GetGreatest() * file.Factor;
  file.LampFlux = lumens > 0.0 && file.Lamps > 0.0 ? lumens * file.Lamps : -1.0;
  if (lumens <= 0.0)
  {
    file.Lamps = -std::fabs(file.Lamps);
    file.Assumptions.push_back("Absolute photometry (lumens per lamp " + Say(lumens) + ").");
  }
  file.Manufacturer = file.Keyword("MANUFAC");
  file.Luminaire = file.Keyword("LUMINAIRE");
  file.Catalogue = file.Keyword("LUMCAT");
  file.Lamp = file.Keyword("LAMP");
  return file;
}

} // namespace radiometry::io
