// SPDX-License-Identifier: BSD-3-Clause
// What all lights add up to: each kind has a loop of its own, without a branch on the kind.
//@if Lights
// The sums over all lights at P about N, seen along V (unit, to the viewer).
LightSums sumLights(vec3 N
//@if Finite
  , vec3 P
//@end
//@if Specular
  , vec3 V, float shininess
//@if BothSides
  , float shininessBack
//@end
//@end
  )
{
  LightSums sums;
//@if Diffuse
  sums.diffuse = vec3(0.0);
//@end
//@if LightAmbient
  sums.ambient = vec3(0.0);
//@end
//@if Specular
  sums.specular = vec3(0.0);
//@end
//@if BothSides
  sums.diffuseBack = vec3(0.0);
//@if Specular
  sums.specularBack = vec3(0.0);
//@end
//@end
  LitPoint at;
  at.N = N;
//@if Specular
//@if BlinnPhong
  at.S = V;
//@else
  at.S = 2.0 * dot(N, V) * N - V;
//@end
  at.shininess = shininess;
//@if BothSides
  at.shininessBack = shininessBack;
//@end
//@end
//@if Directional
  for (int i = directionalRange.x; i < directionalRange.y; ++i)
  {
    vec3 L = texelFetch(radiometryLights, i * 6).xyz;
    addLight(i * 6, dot(N, L), 1.0,
//@if Specular
      L,
//@end
      at, sums);
  }
//@end
//@if Point
  for (int i = pointRange.x; i < pointRange.y; ++i)
  {
    vec3 toLight = texelFetch(radiometryLights, i * 6).xyz - P;
    float r2 = dot(toLight, toLight);
    if (r2 > 0.0)
    {
      addFiniteLight(i * 6, toLight, r2, inversesqrt(r2), 1.0, at, sums);
    }
  }
//@end
//@if Spot
  for (int i = spotRange.x; i < spotRange.y; ++i)
  {
    vec3 toLight = texelFetch(radiometryLights, i * 6).xyz - P;
    float r2 = dot(toLight, toLight);
    if (r2 > 0.0)
    {
      float inverse = inversesqrt(r2);
      float shape = coneFactor(i * 6, inverse * toLight);
      addFiniteLight(i * 6, toLight, r2, inverse, shape, at, sums);
    }
  }
//@end
//@if Luminaire
  for (int i = luminaireRange.x; i < luminaireRange.y; ++i)
  {
    vec3 toLight = texelFetch(radiometryLights, i * 6).xyz - P;
    float r2 = dot(toLight, toLight);
    if (r2 > 0.0)
    {
      float inverse = inversesqrt(r2);
      float shape = webFactor(i * 6, inverse * toLight);
      addFiniteLight(i * 6, toLight, r2, inverse, shape, at, sums);
    }
  }
//@end
//@if Area
  for (int i = areaRange.x; i < areaRange.y; ++i)
  {
    int light = i * 6;
    vec3 color = texelFetch(radiometryLights, light + 2).rgb;
//@if Visibility
    color *= shareOfLight(light);
//@end
    sums.diffuse += polygonFactor(light, P, N) * color;
//@if BothSides
    sums.diffuseBack += polygonFactor(light, P, -N) * color;
//@end
  }
//@end
//@if Sky
  for (int i = skyRange.x; i < skyRange.y; ++i)
  {
    int light = i * 6;
    vec3 color = texelFetch(radiometryLights, light + 2).rgb;
//@if Visibility
    color *= shareOfLight(light);
//@end
    sums.diffuse += skyIrradiance(light, N) * color;
//@if BothSides
    sums.diffuseBack += skyIrradiance(light, -N) * color;
//@end
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
  return length2 > 0.0 && length2 < 1e38 ? n * inversesqrt(length2) : vec3(0.0);
}
//@end
