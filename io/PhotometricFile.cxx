// SPDX-License-Identifier: BSD-3-Clause
#include "io/PhotometricFile.h"

#include "io/PhotometricParts.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

namespace radiometry::io
{
namespace
{

/// How far two statements of one flux may be apart: what interpolating between angles makes.
constexpr double FluxTolerance = 0.02;

std::string Squeezed(const std::string& text)
{
  std::string out;
  for (const char c : text)
  {
    if (!std::isspace(static_cast<unsigned char>(c)) && c != '_' && c != '-')
    {
      out += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
  }
  return out;
}

/// Watts per steradian in a text, with the letter before them: "mW/sr", "candela-> mW/sr".
/// Fails: FileError for a unit with another prefix, which nobody should take for candela.
IntensityUnits UnitsIn(const std::string& text, const std::string& fileName)
{
  const std::string words = Squeezed(text);
  const std::size_t at = words.find("W/SR");
  if (at == std::string::npos)
  {
    return IntensityUnits::Auto;
  }
  const char before = at > 0 ? words[at - 1] : ' ';
  if (before == 'M')
  {
    return IntensityUnits::MilliwattPerSteradian;
  }
  if (before == 'U' || before == 'N' || before == 'K' || static_cast<unsigned char>(before) >= 0x80)
  {
    throw FileError(
      fileName, "intensities in \"" + text + "\": expected mW/sr or W/sr (choose the unit by hand)");
  }
  return IntensityUnits::WattPerSteradian;
}

void DecideUnits(IntensityUnits wanted, const std::string& fileName, PhotometricFile& file)
{
  file.Units = wanted;
  if (wanted != IntensityUnits::Auto)
  {
    return;
  }
  // A keyword for the unit decides; else any line that names one.
  for (const bool keyword : { true, false })
  {
    for (const auto& [key, value] : file.Keywords)
    {
      if (keyword && Squeezed(key).find("INTENSITYUNIT") == std::string::npos)
      {
        continue;
      }
      file.Units = UnitsIn(value, fileName);
      if (file.Units != IntensityUnits::Auto)
      {
        file.Assumptions.push_back("Intensities in " + std::string(file.IntensityUnit()) +
          ", as the file says at [" + key + "].");
        return;
      }
    }
  }
  file.Units = IntensityUnits::Candela;
  for (const auto& entry : file.Keywords)
  {
    if (Squeezed(entry.second).find("RADIOMETRICUNIT") != std::string::npos)
    {
      file.Units = IntensityUnits::MilliwattPerSteradian;
      file.Assumptions.push_back("The file says that its units are radiometric: taken as mW/sr.");
      return;
    }
  }
}

/// A luminaire's flux by a keyword of a maker's own, such as [_TOTALLUMINAIRELUMENS].
void FindStatedFlux(PhotometricFile& file)
{
  for (const auto& [key, value] : file.Keywords)
  {
    const std::string name = Squeezed(key);
    const bool flux = name.find("LUMEN") != std::string::npos || name.find("FLUX") != std::string::npos;
    const bool luminaire = name.find("TOTAL") != std::string::npos ||
      name.find("LUMINAIRE") != std::string::npos || name.find("ABSOLUTE") != std::string::npos;
    double number = 0.0;
    if (file.FluxStated < 0.0 && flux && luminaire && name.find("FRACTION") == std::string::npos &&
      PhotometricText::IsNumber(value.substr(0, value.find_first_of(" \t\n")), number) && number > 0.0)
    {
      file.FluxStated = number;
    }
  }
}

void CompareFlux(PhotometricFile& file)
{
  file.FluxFromWeb = file.Web->TotalFlux() * file.Greatest;
  FindStatedFlux(file);
  const std::string unit = std::string(" ") + file.FluxUnit();
  if (file.FluxStated > 0.0 &&
    std::fabs(file.FluxFromWeb - file.FluxStated) > FluxTolerance * file.FluxStated)
  {
    file.Warnings.push_back("The web's total flux is " + Say(file.FluxFromWeb) + unit +
      ", the file states " + Say(file.FluxStated) + unit + ": the web is used as it is.");
  }
  else if (file.FluxStated < 0.0 && file.LampFlux > 0.0 && file.Units == IntensityUnits::Candela &&
    file.FluxFromWeb > (1.0 + FluxTolerance) * file.LampFlux)
  {
    file.Warnings.push_back("The web's total flux is " + Say(file.FluxFromWeb) +
      " lm, more than the " + Say(file.LampFlux) + " lm of the lamps: the web is used as it is.");
  }
}

bool HasTilt(const PhotometricText& text)
{
  for (std::size_t k = 0; k < text.Lines(); ++k)
  {
    if (Squeezed(text.Line(k)).compare(0, 5, "TILT=") == 0)
    {
      return true;
    }
  }
  return false;
}

} // namespace

std::string Say(double value)
{
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

const char* PhotometricFile::FluxUnit() const
{
  return this->Units == IntensityUnits::MilliwattPerSteradian ? "mW"
    : this->Units == IntensityUnits::WattPerSteradian         ? "W"
                                                              : "lm";
}

const char* PhotometricFile::IntensityUnit() const
{
  return this->Units == IntensityUnits::MilliwattPerSteradian ? "mW/sr"
    : this->Units == IntensityUnits::WattPerSteradian         ? "W/sr"
                                                              : "cd";
}

std::string PhotometricFile::Keyword(const std::string& name) const
{
  for (const auto& [key, value] : this->Keywords)
  {
    if (Squeezed(key) == Squeezed(name))
    {
      return value;
    }
  }
  return {};
}

PhotometricFile ReadPhotometricFile(const std::string& fileName, const PhotometricOptions& options)
{
  if (!std::isfinite(options.TiltAngle))
  {
    throw FileError(fileName, "TiltAngle is not a finite number");
  }
  const PhotometricText text(fileName);
  // By its name, or by the line that every IES file has.
  const std::string upper = Squeezed(fileName);
  const auto ends = [&](const std::string& end) {
    return upper.size() >= end.size() && upper.compare(upper.size() - end.size(), end.size(), end) == 0;
  };
  const bool ies = ends(".IES") || HasTilt(text);
  PhotometricFile file = ies ? ParseIes(text, options) : ParseLdt(text, options);
  if (!std::isfinite(file.Greatest))
  {
    throw FileError(fileName, "intensities beyond any number");
  }
  const std::vector<double>& rows = file.Web->GetVertical();
  if (file.Web->GetType() == WebType::C && rows.front() > 0.0 && rows.front() < 90.0)
  {
    file.Assumptions.push_back(
      "Vertical angles begin at " + Say(rows.front()) + " degrees: no light below.");
  }
  DecideUnits(options.Units, fileName, file);
  CompareFlux(file);
  return file;
}

} // namespace radiometry::io
