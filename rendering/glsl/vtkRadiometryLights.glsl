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

// One light: nl = N.L, factor its fall-off and cone; L toward it. Of finite lights nl is scaled after
// the product: at grazing light the rounding of a unit vector would show.
void addLight(int light, float nl, float factor,
//@if Specular
  vec3 L, vec3 N, vec3 S, float shininess,
//@if BothSides
  float shininessBack,
//@end
//@end
  inout LightSums sums)
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
  color *= specularFactor(side * N, L, S, side * nl, nl > 0.0 ? shininess : shininessBack);
  sums.specular += nl > 0.0 ? color : vec3(0.0);
  sums.specularBack += nl < 0.0 ? color : vec3(0.0);
//@else
  color *= specularFactor(N, L, S, nl, shininess);
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
//@end

//@if Luminaire
// The angle of (x, y) from the x axis, in (-pi, pi], to the digits of a float; atan need not have them.
float angleOf(float y, float x)
{
  float a = abs(y);
  float b = abs(x);
  float t = min(a, b) / max(max(a, b), 1e-37);
  t = t / (1.0 + sqrt(1.0 + t * t));
  t = t / (1.0 + sqrt(1.0 + t * t));
  float t2 = t * t;
  float angle = 4.0 * t *
    (1.0 - t2 * (1.0 / 3.0 - t2 * (1.0 / 5.0 - t2 * (1.0 / 7.0 - t2 * (1.0 / 9.0)))));
  angle = a > b ? 1.5707963267949 - angle : angle;
  angle = x < 0.0 ? 3.1415926535898 - angle : angle;
  return y < 0.0 ? -angle : angle;
}

float lightNumber(int place)
{
  return texelFetch(radiometryLights, place / 4)[place % 4];
}

// Which of `count` ascending numbers begins the interval of a value, and where in it that lies.
int intervalOf(int first, int count, float value, out float share)
{
  int low = 0;
  int high = count - 1;
  while (high - low > 1)
  {
    int middle = (low + high) / 2;
    if (lightNumber(first + middle) <= value)
    {
      low = middle;
    }
    else
    {
      high = middle;
    }
  }
  float begin = lightNumber(first + low);
  share = clamp((value - begin) / (lightNumber(first + low + 1) - begin), 0.0, 1.0);
  return low;
}

// Relative intensity of a luminaire toward -L: bilinear in the two angles, 0 outside of its grid.
float webFactor(int light, vec3 L)
{
  int header = int(texelFetch(radiometryLights, light + 1).x);
  vec4 axisX = texelFetch(radiometryLights, header);
  vec4 axisY = texelFetch(radiometryLights, header + 1);
  vec4 pole = texelFetch(radiometryLights, header + 2);
  int thetas = int(axisX.w);
  int psis = int(axisY.w);
  int theta0 = 4 * int(texelFetch(radiometryLights, header + 3).x);
  int psi0 = theta0 + thetas;
  int values = psi0 + psis;
  float x = -dot(L, axisX.xyz);
  float y = -dot(L, axisY.xyz);
  float theta = angleOf(sqrt(x * x + y * y), -dot(L, pole.xyz));
  const float rim = 1e-6;
  if (theta < lightNumber(theta0) - rim || theta > lightNumber(psi0 - 1) + rim)
  {
    return 0.0;
  }
  float s;
  int i = intervalOf(theta0, thetas, theta, s);
  if (psis == 1)
  {
    return mix(lightNumber(values + i), lightNumber(values + i + 1), s);
  }
  float psi = angleOf(y, x);
  float first = lightNumber(psi0);
  if (pole.w > 0.0)
  {
    psi -= 6.2831853071796 * floor((psi - first) / 6.2831853071796);
  }
  else if (psi < first - rim || psi > lightNumber(values - 1) + rim)
  {
    return 0.0;
  }
  float t;
  int j = values + thetas * intervalOf(psi0, psis, psi, t) + i;
  return mix(mix(lightNumber(j), lightNumber(j + 1), s),
    mix(lightNumber(j + thetas), lightNumber(j + thetas + 1), s), t);
}
//@end

//@if Area
// angle/sin(angle) - 1 between unit vectors, by Gauss's continued fraction of the arc sine.
float angleExcess(vec3 a, vec3 b)
{
  float u = 0.25 * dot(b - a, b - a);
  float w = 0.25 * dot(a + b, a + b);
  float k = min(u, w);
  float t = 15.0 - 56.0 * k / 17.0;
  t = 13.0 - 56.0 * k / t;
  t = 11.0 - 30.0 * k / t;
  t = 9.0 - 30.0 * k / t;
  t = 7.0 - 12.0 * k / t;
  t = 5.0 - 12.0 * k / t;
  t = 3.0 - 2.0 * k / t;
  float excess = 2.0 * k / (t - 2.0 * k);
  return u <= w ? excess : 1.5707963267949 * inversesqrt(max(u * w, 1e-30)) - excess - 2.0;
}

// theta Gamma.N of the edge from p0 + ea to p0 + eb, but for what is nothing all around a polygon: so
// small ones keep their digits. p0 is a corner of what is seen.
float edgeTerm(vec3 ea, vec3 eb, vec3 p0, vec3 N)
{
  float r0 = length(p0);
  vec3 v0 = r0 > 0.0 ? p0 / r0 : vec3(0.0, 0.0, 1.0);
  vec3 pa = p0 + ea;
  vec3 pb = p0 + eb;
  float ra = max(length(pa), 1e-37);
  float rb = max(length(pb), 1e-37);
  vec3 da = (ea - v0 * (dot(ea, pa + p0) / (ra + r0))) / ra;
  vec3 db = (eb - v0 * (dot(eb, pb + p0) / (rb + r0))) / rb;
  return dot(N, cross(da, db)) + angleExcess(pa / ra, pb / rb) * dot(N, cross(pa / ra, pb / rb));
}

// The form factor of an area light's polygon, cut at the horizon: PolygonFormFactor.
float polygonFactor(int light, vec3 P, vec3 N)
{
  vec4 polygon = texelFetch(radiometryLights, light);
  int first = int(polygon.x);
  int count = int(polygon.y);
  vec3 corner = texelFetch(radiometryLights, first).xyz;
  vec3 p0 = corner - P;
  vec3 ea = texelFetch(radiometryLights, first + count - 1).xyz - corner;
  float ha = dot(N, p0 + ea);
  vec3 entry = ea;
  vec3 leave = ea;
  vec3 base = ea;
  bool begun = false;
  bool entered = false;
  bool left = false;
  float sum = 0.0;
  for (int k = 0; k < count; ++k)
  {
    vec3 eb = texelFetch(radiometryLights, first + k).xyz - corner;
    float hb = dot(N, p0 + eb);
    if (ha > 0.0 || hb > 0.0)
    {
      vec3 from = ha > 0.0 ? ea : ea + (ha / (ha - hb)) * (eb - ea);
      vec3 to = hb > 0.0 ? eb : ea + (ha / (ha - hb)) * (eb - ea);
      base = begun ? base : from;
      begun = true;
      if (ha <= 0.0)
      {
        if (left)
        {
          sum += edgeTerm(leave - base, from - base, p0 + base, N);
          left = false;
        }
        else
        {
          entry = from;
          entered = true;
        }
      }
      sum += edgeTerm(from - base, to - base, p0 + base, N);
      if (hb <= 0.0)
      {
        leave = to;
        left = true;
      }
    }
    ea = eb;
    ha = hb;
  }
  if (left && entered)
  {
    sum += edgeTerm(leave - base, entry - base, p0 + base, N);
  }
  float factor = -sum / 6.2831853071796;
  return polygon.z == 0.0 ? abs(factor) : max(polygon.z * factor, 0.0);
}
//@end

//@if Sky
// Irradiance of a sky as a quadratic function of the normal: SkyQuadric.
vec3 skyIrradiance(int light, vec3 N)
{
  int at = int(texelFetch(radiometryLights, light).x);
  vec3 sum = texelFetch(radiometryLights, at).rgb + N.x * texelFetch(radiometryLights, at + 1).rgb +
    N.y * texelFetch(radiometryLights, at + 2).rgb + N.z * texelFetch(radiometryLights, at + 3).rgb;
  sum += N.x * N.x * texelFetch(radiometryLights, at + 4).rgb;
  sum += N.y * N.y * texelFetch(radiometryLights, at + 5).rgb;
  sum += N.z * N.z * texelFetch(radiometryLights, at + 6).rgb;
  sum += N.x * N.y * texelFetch(radiometryLights, at + 7).rgb;
  sum += N.x * N.z * texelFetch(radiometryLights, at + 8).rgb;
  sum += N.y * N.z * texelFetch(radiometryLights, at + 9).rgb;
  return dot(N, N) > 0.5 ? max(sum, vec3(0.0)) : vec3(0.0);
}
//@end

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
//@if BlinnPhong
  vec3 S = V;
//@else
  vec3 S = 2.0 * dot(N, V) * N - V;
//@end
//@end
//@if BothSides
  sums.diffuseBack = vec3(0.0);
//@if Specular
  sums.specularBack = vec3(0.0);
//@end
//@end
//@if Directional
  for (int i = directionalRange.x; i < directionalRange.y; ++i)
  {
    int light = i * 6;
    vec3 L = texelFetch(radiometryLights, light).xyz;
    addLight(light, dot(N, L), 1.0,
//@if Specular
      L, N, S, shininess,
//@if BothSides
      shininessBack,
//@end
//@end
      sums);
  }
//@end
//@if Point
  for (int i = pointRange.x; i < pointRange.y; ++i)
  {
    int light = i * 6;
    vec3 toLight = texelFetch(radiometryLights, light).xyz - P;
    float r2 = dot(toLight, toLight);
    if (r2 > 0.0)
    {
      float inverse = inversesqrt(r2);
      addLight(light, inverse * dot(N, toLight), fallOff(light, r2, inverse),
//@if Specular
        inverse * toLight, N, S, shininess,
//@if BothSides
        shininessBack,
//@end
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
    float r2 = dot(toLight, toLight);
    if (r2 > 0.0)
    {
      float inverse = inversesqrt(r2);
      vec3 L = inverse * toLight;
      addLight(light, inverse * dot(N, toLight),
        coneFactor(light, L) * fallOff(light, r2, inverse),
//@if Specular
        L, N, S, shininess,
//@if BothSides
        shininessBack,
//@end
//@end
        sums);
    }
  }
//@end
//@if Luminaire
  for (int i = luminaireRange.x; i < luminaireRange.y; ++i)
  {
    int light = i * 6;
    vec3 toLight = texelFetch(radiometryLights, light).xyz - P;
    float r2 = dot(toLight, toLight);
    if (r2 > 0.0)
    {
      float inverse = inversesqrt(r2);
      vec3 L = inverse * toLight;
      addLight(light, inverse * dot(N, toLight),
        webFactor(light, L) * fallOff(light, r2, inverse),
//@if Specular
        L, N, S, shininess,
//@if BothSides
        shininessBack,
//@end
//@end
        sums);
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
