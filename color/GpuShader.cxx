// SPDX-License-Identifier: BSD-3-Clause
#include "color/GpuShader.h"

#include "color/ColorConfigImpl.h"

namespace radiometry::color
{
namespace
{

bool IsLinear(OCIO::Interpolation interpolation) { return interpolation != OCIO::INTERP_NEAREST; }

GpuTexture Flat(const OCIO::GpuShaderDesc& description, unsigned index)
{
  const char* name = nullptr;
  const char* sampler = nullptr;
  unsigned width = 0;
  unsigned height = 0;
  auto channel = OCIO::GpuShaderDesc::TEXTURE_RGB_CHANNEL;
  auto interpolation = OCIO::INTERP_LINEAR;
  description.getTexture(index, name, sampler, width, height, channel, interpolation);
  const float* values = nullptr;
  description.getTextureValues(index, values);

  GpuTexture texture;
  texture.Sampler = sampler;
  texture.Dimensions = height > 1 ? 2 : 1;
  texture.Width = static_cast<int>(width);
  texture.Height = static_cast<int>(height);
  texture.Components = channel == OCIO::GpuShaderDesc::TEXTURE_RED_CHANNEL ? 1 : 3;
  texture.Linear = IsLinear(interpolation);
  texture.Values.assign(
    values, values + static_cast<std::size_t>(width) * height * texture.Components);
  return texture;
}

GpuTexture Cube(const OCIO::GpuShaderDesc& description, unsigned index)
{
  const char* name = nullptr;
  const char* sampler = nullptr;
  unsigned edge = 0;
  auto interpolation = OCIO::INTERP_LINEAR;
  description.get3DTexture(index, name, sampler, edge, interpolation);
  const float* values = nullptr;
  description.get3DTextureValues(index, values);

  GpuTexture texture;
  texture.Sampler = sampler;
  texture.Dimensions = 3;
  texture.Width = texture.Height = texture.Depth = static_cast<int>(edge);
  // OpenColorIO samples the corners itself for tetrahedral interpolation: nearest fits that.
  texture.Linear = interpolation != OCIO::INTERP_NEAREST &&
    interpolation != OCIO::INTERP_TETRAHEDRAL && interpolation != OCIO::INTERP_BEST;
  texture.Values.assign(values, values + static_cast<std::size_t>(edge) * edge * edge * 3);
  return texture;
}

} // namespace

GpuShader ColorTransform::Shader(
  const std::string& functionName, const std::string& resourcePrefix) const
{
  try
  {
    auto description = OCIO::GpuShaderDesc::CreateShaderDesc();
    description->setLanguage(OCIO::GPU_LANGUAGE_GLSL_1_3);
    description->setFunctionName(functionName.c_str());
    description->setResourcePrefix(resourcePrefix.c_str());
    this->Data->Processor->getOptimizedGPUProcessor(Optimization)
      ->extractGpuShaderInfo(description);

    GpuShader shader;
    shader.FunctionName = functionName;
    shader.Text = description->getShaderText();
    for (unsigned i = 0; i < description->getNumTextures(); ++i)
    {
      shader.Textures.push_back(Flat(*description, i));
    }
    for (unsigned i = 0; i < description->getNum3DTextures(); ++i)
    {
      shader.Textures.push_back(Cube(*description, i));
    }
    for (unsigned i = 0; i < description->getNumUniforms(); ++i)
    {
      OCIO::GpuShaderDesc::UniformData data;
      const char* name = description->getUniform(i, data);
      if (data.m_type != OCIO::UNIFORM_DOUBLE)
      {
        throw ColorError(std::string("the uniform '") + name + "' is not a number");
      }
      // The only one that this project makes dynamic is the exposure.
      shader.Uniforms.push_back({ name, this->Exposure });
    }
    return shader;
  }
  catch (const ColorError&)
  {
    throw;
  }
  catch (const std::exception& e)
  {
    throw ColorError(std::string("OpenColorIO cannot write a shader: ") + e.what());
  }
}

} // namespace radiometry::color
