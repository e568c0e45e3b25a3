// SPDX-License-Identifier: BSD-3-Clause
#include "color/ColorTransform.h"

#include "color/ColorConfigImpl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace radiometry::color
{
namespace
{

std::string Join(const std::vector<std::string>& names)
{
  std::string text;
  for (const std::string& name : names)
  {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text.empty() ? "none" : text;
}

bool Contains(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

[[noreturn]] void Unknown(const std::string& kind, const std::string& name,
  const ColorConfig& config, const std::vector<std::string>& known)
{
  throw ColorError("no " + kind + " '" + name + "' in the config '" + config.Origin() +
    "'; it has: " + Join(known));
}

const char* Interchange(const OCIO::ConstConfigRcPtr& config)
{
  return config->hasRole("aces_interchange") ? "aces_interchange" : nullptr;
}

/// Source -> the space that exposure is applied in, appended to the group.
/// Returns the name of that space in the config, or nothing where the source is data.
std::string AppendSource(const ColorConfig& config, const TransformOptions& options,
  OCIO::GroupTransformRcPtr group, std::string& source)
{
  const auto& ocio = config.Handle().Config;
  const bool hasLinear = ocio->hasRole(OCIO::ROLE_SCENE_LINEAR);
  source = options.SourceColorSpace.empty() ? config.LinearRec709() : options.SourceColorSpace;
  if (!config.HasColorSpace(source))
  {
    const std::string wanted = source.empty() ? "Linear Rec.709" : source;
    const ColorConfig own = ColorConfig::FromText(BuiltInConfigText(), ColorConfig::BuiltInName);
    const char* bridge = Interchange(ocio);
    if (own.HasColorSpace(wanted) && bridge)
    {
      auto step =
        OCIO::Config::GetProcessorFromConfigs(own.Handle().Config, wanted.c_str(), ocio, bridge);
      group->appendTransform(step->createGroupTransform());
      source = wanted;
      return ocio->getColorSpace(bridge)->getName();
    }
    if (!source.empty() || !hasLinear)
    {
      Unknown("colour space", wanted, config, config.ColorSpaces());
    }
    source = ocio->getColorSpace(OCIO::ROLE_SCENE_LINEAR)->getName();
  }
  const auto space = ocio->getColorSpace(source.c_str());
  if (space->isData())
  {
    return {};
  }
  if (!hasLinear)
  {
    return space->getName();
  }
  auto step = OCIO::ColorSpaceTransform::Create();
  step->setSrc(source.c_str());
  step->setDst(OCIO::ROLE_SCENE_LINEAR);
  group->appendTransform(step);
  return ocio->getColorSpace(OCIO::ROLE_SCENE_LINEAR)->getName();
}

void AppendExposure(OCIO::GroupTransformRcPtr group, double stops)
{
  auto step = OCIO::ExposureContrastTransform::Create();
  step->setStyle(OCIO::EXPOSURE_CONTRAST_LINEAR);
  step->setExposure(stops);
  step->makeExposureDynamic();
  group->appendTransform(step);
}

void AppendLook(const ColorConfig& config, const std::string& look, const std::string& space,
  OCIO::GroupTransformRcPtr group)
{
  const auto& ocio = config.Handle().Config;
  if (look.empty())
  {
    return;
  }
  // A single name is checked here for the sake of a clear message; OpenColorIO parses "A, -B | C".
  if (look.find_first_of(",|:+-") == std::string::npos && !ocio->getLook(look.c_str()))
  {
    Unknown("look", look, config, config.Looks());
  }
  auto step = OCIO::LookTransform::Create();
  step->setSrc(space.c_str());
  step->setDst(space.c_str());
  step->setLooks(look.c_str());
  group->appendTransform(step);
}

/// Appends the way to the display; false where the view shows data as it is.
bool AppendView(const ColorConfig& config, const std::string& space, TransformOptions& used,
  OCIO::GroupTransformRcPtr group)
{
  const auto& ocio = config.Handle().Config;
  std::string& display = used.Display;
  display = display.empty() ? config.DefaultDisplay() : display;
  if (ocio->getNumViews(display.c_str()) == 0)
  {
    Unknown("display", display, config, config.Displays());
  }
  std::string& view = used.View;
  view = view.empty() ? config.DefaultView(display) : view;
  const char* viewSpace = ocio->getDisplayViewColorSpaceName(display.c_str(), view.c_str());
  if (!Contains(config.Views(display), view) && !(viewSpace && *viewSpace))
  {
    Unknown("view of '" + display + "' named", view, config, config.Views(display));
  }
  // A shared view names its colour space "<USE_DISPLAY_NAME>": never data, never found here.
  const auto target = ocio->getColorSpace(viewSpace ? viewSpace : "");
  if (target && target->isData())
  {
    return false;
  }
  auto step = OCIO::DisplayViewTransform::Create();
  step->setSrc(space.c_str());
  step->setDisplay(display.c_str());
  step->setView(view.c_str());
  group->appendTransform(step);
  return true;
}

bool AppendTarget(const ColorConfig& config, const std::string& target, const std::string& space,
  OCIO::GroupTransformRcPtr group)
{
  if (!config.HasColorSpace(target))
  {
    Unknown("colour space", target, config, config.ColorSpaces());
  }
  if (config.Handle().Config->getColorSpace(target.c_str())->isData())
  {
    return false;
  }
  auto step = OCIO::ColorSpaceTransform::Create();
  step->setSrc(space.c_str());
  step->setDst(target.c_str());
  group->appendTransform(step);
  return true;
}

/// The whole transform; an empty group where data is passed through.
OCIO::GroupTransformRcPtr Assemble(
  const ColorConfig& config, const TransformOptions& options, TransformOptions& used)
{
  auto group = OCIO::GroupTransform::Create();
  used = options;
  std::string& source = used.SourceColorSpace;
  const std::string space = AppendSource(config, options, group, source);
  bool colours = !space.empty();
  if (colours)
  {
    AppendExposure(group, options.Exposure);
    AppendLook(config, options.Look, space, group);
  }
  // Names are checked even where data is passed through.
  const std::string any = colours ? space : source;
  colours = (options.TargetColorSpace.empty()
                ? AppendView(config, any, used, group)
                : AppendTarget(config, options.TargetColorSpace, any, group)) &&
    colours;
  return colours ? group : OCIO::GroupTransform::Create();
}

double Finite(double stops)
{
  if (!std::isfinite(stops))
  {
    throw ColorError(
      "exposure is " + std::to_string(stops) + ": expected a finite number of stops");
  }
  return stops;
}

} // namespace

ColorTransform::ColorTransform(const ColorConfig& config, const TransformOptions& options)
  : Data(std::make_unique<Impl>())
  , Exposure(Finite(options.Exposure))
{
  try
  {
    auto group = Assemble(config, options, this->Data->Used);
    this->Data->PassesDataThrough = group->getNumTransforms() == 0;
    this->Data->Processor = config.Handle().Config->getProcessor(group);
    this->Data->Cpu = this->Data->Processor->getOptimizedCPUProcessor(Optimization);
  }
  catch (const ColorError&)
  {
    throw;
  }
  catch (const std::exception& e)
  {
    throw ColorError(
      "the config '" + config.Origin() + "' cannot make this transform: " + e.what());
  }
}

ColorTransform::~ColorTransform() = default;

const TransformOptions& ColorTransform::Used() const { return this->Data->Used; }

bool ColorTransform::PassesDataThrough() const { return this->Data->PassesDataThrough; }

void ColorTransform::SetExposure(double stops)
{
  this->Exposure = Finite(stops);
  if (!this->Data->PassesDataThrough)
  {
    auto property = this->Data->Cpu->getDynamicProperty(OCIO::DYNAMIC_PROPERTY_EXPOSURE);
    OCIO::DynamicPropertyValue::AsDouble(property)->setValue(stops);
  }
}

void ColorTransform::Apply(float* pixels, std::size_t n, int components, int threads) const
{
  if (components != 3 && components != 4)
  {
    throw ColorError("pixels have " + std::to_string(components) + " components: expected 3 or 4");
  }
  if (this->Data->PassesDataThrough || n == 0)
  {
    return;
  }
  // Blocks of a fixed size: the bytes that come out are the same for any number of threads.
  constexpr std::size_t block = 4096;
  const std::size_t blocks = (n + block - 1) / block;
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(std::size_t(0), blocks, [&](std::size_t b) {
      const std::size_t begin = b * block;
      const std::size_t count = std::min(block, n - begin);
      float* first = pixels + begin * components;
      std::array<float, block> alpha; // OpenColorIO carries it along and may round it
      for (std::size_t i = 0; components == 4 && i < count; ++i)
      {
        alpha[i] = first[4 * i + 3];
      }
      OCIO::PackedImageDesc image(first, static_cast<long>(count), 1, components);
      this->Data->Cpu->apply(image);
      for (std::size_t i = 0; components == 4 && i < count; ++i)
      {
        first[4 * i + 3] = alpha[i];
      }
    });
  });
}

} // namespace radiometry::color
