// SPDX-License-Identifier: BSD-3-Clause
#include "color/ColorConfig.h"

#include "color/ColorConfigImpl.h"

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace radiometry::color
{
namespace
{

/// A processor must belong to one ColorTransform alone: its exposure can change at any time.
std::shared_ptr<const ColorConfig::Impl> Adopt(const OCIO::ConstConfigRcPtr& config)
{
  auto copy = config->createEditableCopy();
  copy->setProcessorCacheFlags(OCIO::PROCESSOR_CACHE_OFF);
  return std::make_shared<ColorConfig::Impl>(ColorConfig::Impl{ copy });
}

OCIO::ConstConfigRcPtr Load(const std::string& fileName, const std::string& named)
{
  // "ocio://default" and the like, from OpenColorIO 2.2 on, are no files.
  const bool builtInOcio = fileName.rfind("ocio://", 0) == 0;
  std::error_code error;
  const auto status = std::filesystem::status(fileName, error);
  if (!builtInOcio && !std::filesystem::exists(status))
  {
    throw ColorError("no OpenColorIO config '" + fileName + "'" + named);
  }
  if (std::filesystem::is_directory(status))
  {
    throw ColorError("'" + fileName + "'" + named + " is a folder, not an OpenColorIO config");
  }
  try
  {
    return OCIO::Config::CreateFromFile(fileName.c_str());
  }
  catch (const std::exception& e)
  {
    throw ColorError("'" + fileName + "'" + named + " is no config that OpenColorIO " +
      OCIO::GetVersion() + " can read: " + e.what());
  }
}

} // namespace

const char* const ColorConfig::BuiltInName = "builtin";

ColorConfig ColorConfig::Open(const std::string& fileName)
{
  const char* environment = std::getenv("OCIO");
  ColorConfig config;
  if (!fileName.empty() && fileName != BuiltInName)
  {
    config.Data = Adopt(Load(fileName, ""));
    config.From = fileName;
  }
  else if (fileName.empty() && environment && *environment)
  {
    config.Data = Adopt(Load(environment, " (named by the environment variable OCIO)"));
    config.From = environment;
  }
  else
  {
    config = FromText(BuiltInConfigText(), BuiltInName);
  }
  return config;
}

ColorConfig ColorConfig::FromText(const std::string& text, const std::string& origin)
{
  try
  {
    std::istringstream stream(text);
    ColorConfig config;
    config.Data = Adopt(OCIO::Config::CreateFromStream(stream));
    config.From = origin;
    return config;
  }
  catch (const std::exception& e)
  {
    throw ColorError("the config '" + origin + "' cannot be read: " + e.what());
  }
}

void ColorConfig::Validate() const
{
  try
  {
    this->Data->Config->validate();
  }
  catch (const std::exception& e)
  {
    throw ColorError("the config '" + this->From + "' is inconsistent: " + e.what());
  }
}

std::vector<std::string> ColorConfig::ColorSpaces() const
{
  std::vector<std::string> names;
  for (int i = 0; i < this->Data->Config->getNumColorSpaces(); ++i)
  {
    names.emplace_back(this->Data->Config->getColorSpaceNameByIndex(i));
  }
  return names;
}

std::vector<std::string> ColorConfig::Displays() const
{
  std::vector<std::string> names;
  for (int i = 0; i < this->Data->Config->getNumDisplays(); ++i)
  {
    names.emplace_back(this->Data->Config->getDisplay(i));
  }
  return names;
}

std::vector<std::string> ColorConfig::Views(const std::string& display) const
{
  std::vector<std::string> names;
  for (int i = 0; i < this->Data->Config->getNumViews(display.c_str()); ++i)
  {
    names.emplace_back(this->Data->Config->getView(display.c_str(), i));
  }
  return names;
}

std::vector<std::string> ColorConfig::Looks() const
{
  std::vector<std::string> names;
  for (int i = 0; i < this->Data->Config->getNumLooks(); ++i)
  {
    names.emplace_back(this->Data->Config->getLookNameByIndex(i));
  }
  return names;
}

std::string ColorConfig::DefaultDisplay() const { return this->Data->Config->getDefaultDisplay(); }

std::string ColorConfig::DefaultView(const std::string& display) const
{
  return this->Data->Config->getDefaultView(display.c_str());
}

bool ColorConfig::HasColorSpace(const std::string& name) const
{
  return !name.empty() && this->Data->Config->getColorSpace(name.c_str()) != nullptr;
}

std::string ColorConfig::LinearRec709() const
{
  // The project's name; the ACES configs of OpenColorIO 2; aliases; the ACES configs of 1; Blender.
  for (const char* name : { "Linear Rec.709", "Linear Rec.709 (sRGB)", "lin_rec709", "lin_srgb",
         "Utility - Linear - Rec.709", "Utility - Linear - sRGB", "Linear BT.709" })
  {
    if (this->HasColorSpace(name))
    {
      return this->Data->Config->getColorSpace(name)->getName();
    }
  }
  return {};
}

} // namespace radiometry::color
