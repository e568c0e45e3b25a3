//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// Lays what a float target holds over the frame buffer, converted for a display, together with the
// opaque surfaces that are in the display's colours already. Each sample of a pixel decides for
// itself which of the two is in front; the light that is seen is averaged before it is converted.
// Blending is (ONE, ONE_MINUS_SRC_ALPHA): the colour goes out premultiplied, as it came in.
//VTK::Output::Dec
in vec2 texCoord;
uniform sampler2D linearColor; // samples x samples texels a pixel
uniform sampler2D linearDepth;
uniform int samples;
uniform int others;            // 0: no other surfaces; 1: compare depths; 2: hidden light is gone
uniform int bounded;           // 1: the frame buffer holds a display's values
uniform sampler2D otherColor;  // one texel a pixel
uniform sampler2D otherDepth;

// vec4 radiometryToDisplay(vec4)
//VTK::Display::Dec

void main()
{
  ivec2 pixel = ivec2(texCoord * vec2(textureSize(linearColor, 0) / samples));
  vec4 other = vec4(0.0);
  float behind = 1.0;
  if (others > 0)
  {
    other = texelFetch(otherColor, pixel, 0);
    behind = texelFetch(otherDepth, pixel, 0).r;
  }
  vec4 light = vec4(0.0);
  float share = 0.0; // of the other surface that is seen
  for (int j = 0; j < samples; ++j)
  {
    for (int i = 0; i < samples; ++i)
    {
      ivec2 texel = pixel * samples + ivec2(i, j);
      vec4 color = texelFetch(linearColor, texel, 0);
      if (others == 1 && texelFetch(linearDepth, texel, 0).r > behind)
      {
        color *= 1.0 - other.a;
        share += 1.0;
      }
      else
      {
        share += 1.0 - color.a;
      }
      light += color;
    }
  }
  float n = float(samples * samples);
  light /= n;
  other *= share / n;
  if (!(light.a + other.a > 0.0))
  {
    discard; // nothing was drawn here: the background stays
  }
  vec3 shown = vec3(0.0);
  if (light.a > 0.0)
  {
    shown = radiometryToDisplay(vec4(light.rgb / light.a, 1.0)).rgb * light.a;
  }
  vec4 result = vec4(shown, light.a) + other;
  if (bounded != 0)
  {
    // Glare hides what is behind it; and bytes premultiplied by less than themselves overflow where
    // ParaView's processes blend them.
    result.a = max(result.a, clamp(max(result.r, max(result.g, result.b)), 0.0, 1.0));
  }
  gl_FragData[0] = result;
  gl_FragDepth =
    min(behind, texelFetch(linearDepth, pixel * samples + ivec2(samples / 2), 0).r);
}
