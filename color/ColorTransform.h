// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/ColorConfig.h"
#include "color/GpuShader.h"

#include <cstddef>
#include <memory>
#include <string>

namespace radiometry::color
{

/// What to convert from and to. Empty names take the defaults said beside them.
struct TransformOptions
{
  /// Colour space of the input. Empty: scene-linear Rec.709; where the config does not have it, the
  /// project's own definition of it brought in through the config's interchange role; where it
  /// has no such role either, the config's role scene_linear.
  std::string SourceColorSpace;
  /// When set, the result is in this colour space, and Display and View do not matter.
  std::string TargetColorSpace;
  std::string Display; ///< Empty: the config's default display.
  std::string View;    ///< Empty: the default view of that display.
  std::string Look;    ///< A look or several ("A, B"), applied before the view. Empty: none.
  double Exposure = 0; ///< In stops: scene-linear values are multiplied by 2^Exposure.
};

/// A transform of colours, ready for use on the CPU and as text and textures for a GPU.
///
///   Model   source -> scene_linear -> times 2^Exposure -> look -> view -> display (or target)
///   Cost    building: milliseconds. Apply: about 10 to 100 ns a pixel on one thread
///   Fails   ColorError in the constructor: an unknown name (with the list of what there is), a
///           transform that cannot be built, exposure not finite
///
/// Values that are data and not colours (source, target or view "raw") pass unchanged, without
/// exposure. Alpha is never changed. Negative values and values above 1 keep what the transforms
/// of the config say; nothing is clamped here.
class ColorTransform
{
public:
  ColorTransform(const ColorConfig& config, const TransformOptions& options);
  ~ColorTransform();
  ColorTransform(const ColorTransform&) = delete;
  ColorTransform& operator=(const ColorTransform&) = delete;

  /// The options with every empty name replaced by what it came to (Display and View stay empty
  /// where a target colour space was asked for).
  const TransformOptions& Used() const;
  const std::string& SourceColorSpace() const { return this->Used().SourceColorSpace; }
  /// True where source or view is data, so that Apply changes nothing.
  bool PassesDataThrough() const;

  /// Sets the exposure in stops; CPU and GPU uniforms follow without a rebuild.
  /// Not while Apply runs on another thread.
  void SetExposure(double stops);
  double GetExposure() const { return this->Exposure; }

  /// Converts n pixels of 3 or 4 floats in place, on `threads` threads of oneTBB (0: all).
  /// The result does not depend on the number of threads.
  void Apply(float* pixels, std::size_t n, int components, int threads = 0) const;

  /// The same transform as a GLSL function vec4 name(vec4).
  GpuShader Shader(const std::string& functionName, const std::string& resourcePrefix) const;

  struct Impl;

private:
  std::unique_ptr<Impl> Data;
  double Exposure = 0;
};

} // namespace radiometry::color
