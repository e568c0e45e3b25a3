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

//@if Specular
// max(a.b, 0)^n for unit vectors, from the chord: see PowerOfCosine in LightingModel.cxx.
float powerOfCosine(vec3 a, vec3 b, float n)
{
  vec3 chord = a - b;
  float cosine = 1.0 - 0.5 * dot(chord, chord);
  return n == 0.0 ? 1.0 : (cosine > 0.0 ? pow(cosine, n) : 0.0);
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
  vec4 cone = texelFetch(radiometryLights, light + 1);
  float cosine = dot(cone.xyz, -L);
  if (cosine < cone.w)
  {
    return 0.0;
  }
  float factor = 1.0;
//@if SpotExponent
  float exponent = texelFetch(radiometryLights, light + 2).w;
  factor = exponent == 0.0 ? 1.0 : pow(max(cosine, 0.0), exponent);
//@end
//@if SmoothEdge
  float t = min((cosine - cone.w) * texelFetch(radiometryLights, light + 4).w, 1.0);
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
