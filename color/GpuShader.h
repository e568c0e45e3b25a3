// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace radiometry::color
{

/// A look-up table that the shader text samples. All are 32-bit float, not sRGB, clamped to edge.
struct GpuTexture
{
  std::string Sampler; ///< the name of the sampler uniform in the text
  int Dimensions = 2;  ///< 1, 2 or 3
  int Width = 0;
  int Height = 1;
  int Depth = 1;
  int Components = 3;        ///< 1 or 3
  bool Linear = true;        ///< linear interpolation, else nearest
  std::vector<float> Values; ///< Width * Height * Depth * Components, x fastest
};

/// A uniform of one double that follows the transform (its exposure).
struct GpuUniform
{
  std::string Name;
  double Value = 0;
};

/// What a GPU needs to do what a ColorTransform does: GLSL 1.30 text (fit for later versions)
/// that declares its samplers and uniforms and defines `vec4 FunctionName(vec4)`.
struct GpuShader
{
  std::string FunctionName;
  std::string Text;
  std::vector<GpuTexture> Textures;
  std::vector<GpuUniform> Uniforms;
};

} // namespace radiometry::color
