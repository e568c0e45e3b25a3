//VTK::System::Dec
// SPDX-License-Identifier: BSD-3-Clause
// Lays a scene-linear picture over the frame buffer, converted for a display.
// Blending is (ONE, ONE_MINUS_SRC_ALPHA): the colour goes out premultiplied, as it came in.
//VTK::Output::Dec
in vec2 texCoord;
uniform sampler2D linearColor;
uniform sampler2D linearDepth;

// vec4 radiometryToDisplay(vec4), written by OpenColorIO.
//VTK::Display::Dec

void main()
{
  vec4 pixel = texture(linearColor, texCoord);
  if (!(pixel.a > 0.0))
  {
    discard; // nothing was drawn here: the background stays
  }
  vec3 shown = radiometryToDisplay(vec4(pixel.rgb / pixel.a, 1.0)).rgb;
  gl_FragData[0] = vec4(shown * pixel.a, pixel.a);
  gl_FragDepth = texture(linearDepth, texCoord).r;
}
