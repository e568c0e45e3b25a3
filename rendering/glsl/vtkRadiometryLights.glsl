// SPDX-License-Identifier: BSD-3-Clause
// The lighting model of radiometry/shading/LightingModel.h on the GPU: the same formulas, line by
// line. Expanded by ShaderTemplate.h; used by the vertex shader (Gouraud) and by the fragment shader
// (Flat, Phong). Texels: LightCollector.h. Positions are local: the axes of the view about an origin in
// the middle of the surface, so that float32 keeps the digits of far and of large coordinates.
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
//@if Luminaire
uniform ivec2 luminaireRange;
//@end
//@if Area
uniform ivec2 areaRange;
//@end
//@if Sky
uniform ivec2 skyRange;
//@end

struct LightSums
{
//@if Diffuse
  vec3 diffuse;
//@end
//@if LightAmbient
  vec3 ambient;
//@end
//@if Specular
  vec3 specular;
//@end
//@if BothSides
  vec3 diffuseBack;
//@if Specular
  vec3 specularBack;
//@end
//@end
};

//@if NeedsPower
// max(1 - x, 0)^n; 0^0 is 1. Near x = 0, pow() would lose what n multiplies: the logarithm of a
// number just below 1 is known to a rounding of 1 there. Its series in s = x/(2 - x) is known to a
// rounding of itself: ln(1 - x) = -2 artanh(s), to 2e-8 of itself for x < 1/4.
float powerOfOneMinus(float x, float n)
{
  float s = x / (2.0 - x);
  float s2 = s * s;
  float series = s * (-2.88539008 + s2 * (-0.961796694 + s2 * (-0.577078016 - 0.412198583 * s2)));
  float power = exp2(n * (x < 0.25 ? series : log2(max(1.0 - x, 1e-37))));
  return x < 1.0 || n == 0.0 ? power : 0.0;
}
//@end

//@if Specular
// max(a.b, 0)^n for unit vectors, from the chord: see PowerOfCosine in LightingModel.cxx. 0^0 is 1.
float powerOfCosine(vec3 a, vec3 b, float n)
{
  vec3 chord = a - b;
  return powerOfOneMinus(0.5 * dot(chord, chord), n);
}

// S is V itself for N.H; else V mirrored in N, so that S.L is R.V: one reflection for all lights.
float specularFactor(vec3 N, vec3 L, vec3 S, float nl, float shininess)
{
//@if BlinnPhong
  vec3 H = L + S;
  float length2 = dot(H, H);
  return length2 > 0.0 ? powerOfCosine(N, H * inversesqrt(length2), shininess) : 0.0;
//@else
  float lobe = powerOfCosine(S, L, shininess);
//@if Physical
  // (n + 2)/(2 pi) nl; the light's colour is already divided by pi
  return 0.5 * (shininess + 2.0) * nl * lobe;
//@else
  return lobe;
//@end
//@end
}
//@end

//@if Visibility
//@if VisibilityOfCells
// For each triangle: front, then back: the shares of four lights a texel.
uniform samplerBuffer radiometryVisibility;
int visibilityFirst;
//@end
//@if VisibilityOfPoints
vec4 visibilityOfPoint[4];
//@end
//@if VisibilityOfFront
bool visibilityKnown; // on the side that is seen
//@end

// What of a light arrives, as far as the simulation knows.
float shareOfLight(int light)
{
  int column = int(texelFetch(radiometryLights, light).w);
  float share = 1.0;
//@if VisibilityOfFront
  column = visibilityKnown ? column : -1;
//@end
  if (column >= 0)
  {
//@if VisibilityOfCells
    share *= texelFetch(radiometryVisibility, visibilityFirst + column / 4)[column % 4];
//@end
//@if VisibilityOfPoints
    share *= visibilityOfPoint[column / 4][column % 4];
//@end
  }
  return share;
}
//@end

// What is lit, and how it shines.
struct LitPoint
{
  vec3 N;
//@if Specular
  vec3 S; // as in specularFactor
  float shininess;
//@if BothSides
  float shininessBack;
//@end
//@end
};

// One light: nl = N.L, factor its fall-off and cone; L toward it. Of finite lights nl is scaled after
// the product: at grazing light the rounding of a unit vector would show.
void addLight(int light, float nl, float factor,
//@if Specular
  vec3 L,
//@end
  LitPoint at, inout LightSums sums)
{
//@if LightAmbient
  sums.ambient += factor * texelFetch(radiometryLights, light + 3).rgb;
//@end
//@if Visibility
  factor *= shareOfLight(light);
//@end
  vec3 color = factor * texelFetch(radiometryLights, light + 2).rgb;
//@if Diffuse
  sums.diffuse += max(nl, 0.0) * color;
//@end
//@if BothSides
  sums.diffuseBack += max(-nl, 0.0) * color;
//@end
//@if Specular
//@if LightSpecular
  color = factor * texelFetch(radiometryLights, light + 4).rgb;
//@end
//@if BothSides
  // A light is on one side of the surface: one highlight. Both sides mirror V alike.
  float side = nl > 0.0 ? 1.0 : -1.0;
  color *= specularFactor(
    side * at.N, L, at.S, side * nl, nl > 0.0 ? at.shininess : at.shininessBack);
  sums.specular += nl > 0.0 ? color : vec3(0.0);
  sums.specularBack += nl < 0.0 ? color : vec3(0.0);
//@else
  color *= specularFactor(at.N, L, at.S, nl, at.shininess);
  sums.specular += nl > 0.0 ? color : vec3(0.0);
//@end
//@end
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
// At the distance r, of which r2 is the square and `inverse` the inverse.
float fallOff(int light, float r2, float inverse)
{
//@if Attenuation
  vec3 abc = texelFetch(radiometryLights, light + 5).xyz;
  float r = r2 < 1e38 ? r2 * inverse : 1e19; // beyond that floats end
  return 1.0 / (abc.x + r * (abc.y + r * abc.z));
//@else
//@if InverseSquare
  return inverse * inverse;
//@else
  return 1.0;
//@end
//@end
}

// A light at `toLight` from what it lights; `shape`: of its cone, of its web.
void addFiniteLight(int light, vec3 toLight, float r2, float inverse, float shape, LitPoint at,
  inout LightSums sums)
{
  addLight(light, inverse * dot(at.N, toLight), shape * fallOff(light, r2, inverse),
//@if Specular
    inverse * toLight,
//@end
    at, sums);
}
//@end
//@end
