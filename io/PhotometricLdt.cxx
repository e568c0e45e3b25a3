// SPDX-License-Identifier: BSD-3-Clause
#include "io/PhotometricParts.h"

#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <cmath>

namespace radiometry::io
{
namespace
{

/// The fields of EULUMDAT, one a line.
class Fields
{
public:
  explicit Fields(const PhotometricText& text)
    : Text(text)
  {
  }
  std::string Words() { return this->Text.Line(this->At++); }
  /// A number; an empty field gives `absent`.
  double Optional(const std::string& what, double absent)
  {
    if (this->At < this->Text.Lines() && this->Text.Line(this->At).empty())
    {
      ++this->At;
      return absent;
    }
    return this->Number(what);
  }
  double Number(const std::string& what)
  {
    if (this->At >= this->Text.Lines())
    {
      this->Text.Fail(this->Text.Lines(), "the file ends where " + what + " should stand");
    }
    double value = 0.0;
    const std::string line = this->Text.Line(this->At);
    if (!PhotometricText::IsNumber(line, value))
    {
      this->Text.Fail(this->At, "\"" + line.substr(0, 40) + "\" where " + what + " should stand");
    }
    ++this->At;
    return value;
  }
  /// A whole number of a range; `room`: the file must have so many lines left for it.
  std::size_t Count(const std::string& what, std::size_t least, std::size_t most)
  {
    const double value = this->Number(what);
    if (value != std::floor(value) || value < static_cast<double>(least) ||
      value > static_cast<double>(most))
    {
      this->Text.Fail(this->At - 1, what + " is " + Say(value) + ": expected a whole number from " +
          std::to_string(least) + " to " + std::to_string(most));
    }
    return static_cast<std::size_t>(value);
  }
  std::vector<double> Numbers(std::size_t count, const std::string& what)
  {
    std::vector<double> values;
    for (std::size_t k = 0; k < count; ++k)
    {
      values.push_back(
        this->Number(what + " " + std::to_string(k + 1) + " of " + std::to_string(count)));
    }
    return values;
  }
  std::size_t Line() const { return this->At; }
  std::size_t Left() const
  {
    std::size_t left = 0;
    for (std::size_t k = this->At; k < this->Text.Lines(); ++k)
    {
      left += this->Text.Line(k).empty() ? 0 : 1;
    }
    return left;
  }

private:
  const PhotometricText& Text;
  std::size_t At = 0;
};

struct LampSet
{
  double Count = 1.0;
  std::string Type, Colour, Rendering;
  double Flux = 0.0;
  double Watts = 0.0;
};

/// The horizontal angles of the planes whose intensities a symmetry stores.
std::vector<double> StoredPlanes(const std::vector<double>& all, std::size_t symmetry)
{
  const std::size_t mc = all.size();
  if (symmetry == 1 || mc == 1)
  {
    return { 0.0 };
  }
  std::vector<double> planes;
  if (symmetry == 3)
  {
    // From C = 270 over 360 to 90: the angles before 0 count below it.
    const std::size_t from = 3 * mc / 4;
    for (std::size_t k = 0; k <= mc / 2; ++k)
    {
      const std::size_t at = (from + k) % mc;
      planes.push_back(from + k < mc ? all[at] - 360.0 : all[at]);
    }
    return planes;
  }
  const std::size_t count = symmetry == 0 ? mc : (symmetry == 2 ? mc / 2 + 1 : mc / 4 + 1);
  for (std::size_t k = 0; k < count; ++k)
  {
    // Some files list the stored half alone, its last plane missing from the list.
    planes.push_back(k < mc ? all[k] : 360.0);
  }
  return planes;
}

/// EULUMDAT's length lies along C = 90, its width along C = 0; a width of 0 is a circle.
LuminousOpening OpeningOf(double length, double width, const std::array<double, 4>& heights)
{
  LuminousOpening opening;
  opening.Sides = heights;
  const double height = *std::max_element(heights.begin(), heights.end());
  if (length > 0.0 || width > 0.0 || height > 0.0)
  {
    const bool round = width == 0.0;
    opening.Shape = round ? LuminousOpening::Ellipse : LuminousOpening::Rectangle;
    opening.Size = { round ? length : width, length, height };
  }
  return opening;
}

void ReadHead(Fields& fields, PhotometricFile& file)
{
  const auto keep = [&](const char* name) {
    file.Keywords.emplace_back(name, fields.Words());
    return file.Keywords.back().second;
  };
  keep("Report");
  file.Luminaire = keep("Luminaire");
  file.Catalogue = keep("LuminaireNumber");
  keep("FileName");
  keep("DateUser");
}

} // namespace

PhotometricFile ParseLdt(const PhotometricText& text, const PhotometricOptions& options)
{
  PhotometricFile file;
  file.Format = "EULUMDAT";
  Fields fields(text);
  file.Manufacturer = fields.Words();
  file.Keywords.emplace_back("Manufacturer", file.Manufacturer);
  file.Keywords.emplace_back("Type", Say(fields.Optional("the type indicator", 0.0)));
  const std::size_t symmetry = fields.Count("the symmetry indicator", 0, 4);
  const std::size_t planeCount = fields.Count("the number of C-planes", 1, 100000);
  fields.Optional("the distance between C-planes", 0.0);
  const std::size_t angleCount = fields.Count("the number of intensities in a plane", 2, 100000);
  fields.Optional("the distance between intensities", 0.0);
  ReadHead(fields, file);
  constexpr double metres = 1e-3;
  const double length = metres * fields.Optional("the length of the luminaire", 0.0);
  const double width = metres * fields.Optional("the width of the luminaire", 0.0);
  const double height = metres * fields.Optional("the height of the luminaire", 0.0);
  file.Housing = { { width > 0.0 ? width : length, length, height } };
  const double areaLength = metres * fields.Optional("the length of the luminous area", 0.0);
  const double areaWidth = metres * fields.Optional("the width of the luminous area", 0.0);
  std::array<double, 4> heights;
  for (double& side : heights)
  {
    side = metres * fields.Optional("a height of the luminous area", 0.0);
  }
  if (areaLength < 0.0 || areaWidth < 0.0 || *std::min_element(heights.begin(), heights.end()) < 0.0)
  {
    text.Fail(14, "the luminous area has a size below 0");
  }
  file.Opening = OpeningOf(areaLength, areaWidth, heights);
  file.Keywords.emplace_back(
    "DownwardFluxFraction", Say(fields.Optional("the downward flux fraction", 0.0)));
  const double outputRatio = fields.Optional("the light output ratio", 0.0);
  file.Keywords.emplace_back("LightOutputRatio", Say(outputRatio));
  double conversion = fields.Optional("the conversion factor", 1.0);
  if (conversion < 0.0)
  {
    text.Fail(fields.Line() - 1, "the conversion factor is " + Say(conversion) + ": expected above 0");
  }
  if (conversion == 0.0)
  {
    file.Assumptions.push_back("The conversion factor is 0: taken as 1.");
    conversion = 1.0;
  }
  file.Keywords.emplace_back("Tilt", Say(fields.Optional("the tilt at the measurement", 0.0)));

  const std::size_t setCount = fields.Count("the number of lamp sets", 1, 100);
  std::vector<LampSet> sets(setCount);
  for (LampSet& set : sets)
  {
    set.Count = fields.Optional("the number of lamps", 1.0);
    set.Type = fields.Words();
    set.Flux = fields.Optional("the flux of the lamps", 0.0);
    set.Colour = fields.Words();
    set.Rendering = fields.Words();
    set.Watts = fields.Optional("the watts of the lamps", 0.0);
  }
  if (options.LampSet < 0 || static_cast<std::size_t>(options.LampSet) >= setCount)
  {
    throw FileError(text.Name(), "LampSet is " + std::to_string(options.LampSet) + ": the file has " +
        std::to_string(setCount) + " (from 0)");
  }
  const LampSet& set = sets[static_cast<std::size_t>(options.LampSet)];
  for (int k = 0; k < 10; ++k)
  {
    file.DirectRatios.push_back(fields.Optional("a direct ratio", 0.0));
  }

  const std::vector<double> planes =
    StoredPlanes(fields.Numbers(planeCount, "C angle"), symmetry);
  const std::vector<double> angles = fields.Numbers(angleCount, "gamma angle");
  const std::size_t first = fields.Line();
  const std::vector<double> values = fields.Numbers(planes.size() * angles.size(), "intensity");
  if (const std::size_t left = fields.Left())
  {
    file.Warnings.push_back(
      std::to_string(left) + " lines after the last intensity were not read.");
  }
  try
  {
    file.Web = std::make_shared<CandelaWeb>(WebType::C, planes, angles, values, "Web");
  }
  catch (const InputError& error)
  {
    const bool c = error.Array == "WebHorizontal";
    const bool g = error.Array == "WebVertical";
    const std::size_t from = c ? first - angleCount - planeCount : (g ? first - angleCount : first);
    const std::size_t index = error.Index > 0 ? static_cast<std::size_t>(error.Index) : 0;
    text.Fail(c && symmetry == 3 ? from : from + index,
      std::string(c ? "C angle" : (g ? "gamma angle" : "intensity")) + " " + error.Value +
        ": expected " + error.Expected);
  }

  double flux = set.Flux;
  if (!(flux > 0.0))
  {
    flux = 1000.0;
    file.Warnings.push_back("The flux of the lamps is " + Say(set.Flux) +
      " lm: taken as 1000 lm, so that intensities are as written.");
  }
  file.Factor = conversion * flux / 1000.0;
  file.Greatest = file.Web->GetGreatest() * file.Factor;
  file.Lamps = set.Count;
  file.Lamp = set.Type;
  file.LampFlux = flux;
  file.InputWatts = set.Watts;
  file.Keywords.emplace_back("ColourTemperature", set.Colour);
  file.Keywords.emplace_back("ColourRendering", set.Rendering);
  if (set.Count < 0.0)
  {
    file.Assumptions.push_back("Absolute photometry (number of lamps " + Say(set.Count) +
      "): " + Say(flux) + " lm are the luminaire's.");
  }
  if (setCount > 1)
  {
    file.Assumptions.push_back("Lamp set " + std::to_string(options.LampSet) + " of " +
      std::to_string(setCount) + ": " + Say(set.Flux) + " lm.");
  }
  if (outputRatio > 0.0)
  {
    file.FluxStated = flux * outputRatio / 100.0;
  }
  return file;
}

} // namespace radiometry::io
