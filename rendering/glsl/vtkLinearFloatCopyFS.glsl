// SPDX-License-Identifier: BSD-3-Clause
// Impl of a full-screen quad: colour and depth of a float target, texel by texel, unchanged.
  ivec2 pixel = ivec2(texCoord * vec2(textureSize(colorSource, 0)));
  gl_FragData[0] = texelFetch(colorSource, pixel, 0);
  gl_FragDepth = texelFetch(depthSource, pixel * samples + ivec2(samples / 2), 0).r;
