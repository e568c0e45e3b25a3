// SPDX-License-Identifier: BSD-3-Clause
// Impl of a full-screen quad: the mean of the samples of a pixel, in linear light.
  ivec2 corner = ivec2(texCoord * vec2(textureSize(colorSource, 0) / samples)) * samples;
  vec4 sum = vec4(0.0);
  for (int j = 0; j < samples; ++j)
  {
    for (int i = 0; i < samples; ++i)
    {
      sum += texelFetch(colorSource, corner + ivec2(i, j), 0);
    }
  }
  gl_FragData[0] = sum / float(samples * samples);
