// SPDX-License-Identifier: BSD-3-Clause
// Private to color/: what the public headers keep of OpenColorIO.
#pragma once

#include "color/ColorConfig.h"
#include "color/ColorTransform.h"

#include <OpenColorIO/OpenColorIO.h>

namespace radiometry::color
{

namespace OCIO = OCIO_NAMESPACE;

struct ColorConfig::Impl
{
  OCIO::ConstConfigRcPtr Config;
};

struct ColorTransform::Impl
{
  OCIO::ConstProcessorRcPtr Processor;
  OCIO::ConstCPUProcessorRcPtr Cpu;
  TransformOptions Used;
  bool PassesDataThrough = false;
};

/// The same on both machines. Only what loses nothing: OpenColorIO's default would trade pow()
/// for an approximation good to four digits. Inverse LUTs have no exact form on a GPU.
constexpr auto Optimization = static_cast<OCIO::OptimizationFlags>(
  OCIO::OPTIMIZATION_LOSSLESS | OCIO::OPTIMIZATION_LUT_INV_FAST);

} // namespace radiometry::color
