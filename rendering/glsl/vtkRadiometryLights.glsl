// SPDX-License-Identifier: BSD-3-Clause
// The lighting model of radiometry/shading/LightingModel.h on the GPU: the same formulas, line by
// line. Expanded by ShaderTemplate.h; used by the vertex shader (Gouraud) and by the fragment shader
// (Flat, Phong). Texels: LightCollector.h.
//@if Lights
uniform samplerBuffer radiometryLights;
//@if Directional
uniform ivec2 directionalRange;
//@end
//@if Point
uniform ivec2 pointRange;
//@end
//@if Spot
uniform ivec2 spotRange;
//@end

struct LightSums
{
  vec3 diffuse;
//@if LightAmbient
  vec3 ambient;
//@end
//@if Specular
  vec3 specular;
//@end
};

//@if NeedsPower
// max(1 - x, 0)^n; 0^0 is 1. Near x = 0, pow() would lose what n multiplies: the logarithm of a
// number just below 1 is known to a rounding of 1 there. Its series in s = x/(2 - x) is known to a
// rounding of itself: ln(1 - x) = -2 artanh(s), to 2e-8 of itself for x < 1/2.
float powerOfOneMinus(float x, float n)
{
  float s = x / (2.0 - x);
  float s2 = s * s;
  float series = 1.0 / 9.0 + s2 * (1.0 / 11.0 + s2 / 13.0);
  series = 1.0 + s2 * (1.0 / 3.0 + s2 * (1.0 / 5.0 + s2 * (1.0 / 7.0 + s2 * series)));
  float power = x < 0.5 ? exp(-2.0 * n * s * series) : pow(max(1.0 - x, 1e-37), n);
  return x < 1.0 || n == 0.0 ? power : 0.0;
}
//@end

//@if Specular
// max(a.b, 0)^n for unit vectors, from the chord: see PowerOfCosine in LightingModel.cxx.
float powerOfCosine(vec3 a, vec3 b, float n)
{
  vec3 chord = a - b;
  return powerOfOneMinus(0.5 * dot(chord, chord), n);
}

float specularFactor(vec3 N, vec3 L, vec3 V, float nl, float shininess)
{
//@if BlinnPhong
  vec3 H = L + V;
  float length2 = dot(H, H);
  return length2 > 0.0 ? powerOfCosine(N, H / sqrt(length2), shininess) : 0.0;
//@else
  float lobe = powerOfCosine(2.0 * nl * N - L, V, shininess);
//@if Physical
  // (n + 2)/(2 pi) nl; the light's colour is already divided by pi
  return 0.5 * (shininess + 2.0) * nl * lobe;
//@else
  return lobe;
//@end
//@end
}
//@end

// One light: L toward it, factor its fall-off and cone.
void addLight(int light, vec3 L, float factor, vec3 N,
//@if Specular
  vec3 V, float shininess,
//@end
  inout LightSums sums)
{
//@if LightAmbient
  sums.ambient += factor * texelFetch(radiometryLights, light + 3).rgb;
//@end
  float nl = dot(N, L);
  if (nl > 0.0)
  {
    vec3 color = texelFetch(radiometryLights, light + 2).rgb;
    sums.diffuse += factor * nl * color;
//@if Specular
//@if LightSpecular
    color = texelFetch(radiometryLights, light + 4).rgb;
//@end
    sums.specular += factor * specularFactor(N, L, V, nl, shininess) * color;
//@end
  }
}

//@if Spot
float coneFactor(int light, vec3 L)
{
  // 1 - cosine, from the chord: narrow cones live on its digits. cone.w is the cone's own.
  vec4 cone = texelFetch(radiometryLights, light + 1);
  vec3 chord = cone.xyz + L;
  float x = 0.5 * dot(chord, chord);
  if (x > cone.w)
  {
    return 0.0;
  }
  float factor = 1.0;
//@if SpotExponent
  float exponent = texelFetch(radiometryLights, light + 2).w;
  factor = powerOfOneMinus(x, exponent);
//@end
//@if SmoothEdge
  float t = min((cone.w - x) * texelFetch(radiometryLights, light + 4).w, 1.0);
  factor *= t * t;
//@end
  return factor;
}
//@end

//@if Finite
float fallOff(int light, float r)
{
//@if Attenuation
  vec3 abc = texelFetch(radiometryLights, light + 5).xyz;
  return 1.0 / (abc.x + r * (abc.y + r * abc.z));
//@else
//@if InverseSquare
  return 1.0 / (r * r * texelFetch(radiometryLights, light + 5).z);
//@else
  return 1.0;
//@end
//@end
}
//@end

// The sums over all lights at P (view coordinates) about N, seen along V (unit, to the viewer).
LightSums sumLights(vec3 P, vec3 N
//@if Specular
  , vec3 V, float shininess
//@end
  )
{
  LightSums sums;
  sums.diffuse = vec3(0.0);
//@if LightAmbient
  sums.ambient = vec3(0.0);
//@end
//@if Specular
  sums.specular = vec3(0.0);
//@end
//@if Directional
  for (int i = directionalRange.x; i < directionalRange.y; ++i)
  {
    int light = i * 6;
    addLight(light, texelFetch(radiometryLights, light).xyz, 1.0, N,
//@if Specular
      V, shininess,
//@end
      sums);
  }
//@end
//@if Point
  for (int i = pointRange.x; i < pointRange.y; ++i)
  {
    int light = i * 6;
    vec3 toLight = texelFetch(radiometryLights, light).xyz - P;
    float r = length(toLight);
    if (r > 0.0)
    {
      addLight(light, toLight / r, fallOff(light, r), N,
//@if Specular
        V, shininess,
//@end
        sums);
    }
  }
//@end
//@if Spot
  for (int i = spotRange.x; i < spotRange.y; ++i)
  {
    int light = i * 6;
    vec3 toLight = texelFetch(radiometryLights, light).xyz - P;
    float r = length(toLight);
    if (r > 0.0)
    {
      vec3 L = toLight / r;
      float factor = coneFactor(light, L);
      if (factor > 0.0)
      {
        addLight(light, L, factor * fallOff(light, r), N,
//@if Specular
          V, shininess,
//@end
          sums);
      }
    }
  }
//@end
  return sums;
}
//@end

//@if NeedsNormal
// Unit length; a normal that is zero or not a number reflects nothing.
vec3 safeNormal(vec3 n)
{
  float length2 = dot(n, n);
  return length2 > 0.0 && length2 < 1e38 ? n / sqrt(length2) : vec3(0.0);
}
//@end
