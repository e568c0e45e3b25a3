// SPDX-License-Identifier: BSD-3-Clause
// Luminaires with a candela web, area lights and skies: radiometry/shading/ExtendedLights.h on the GPU.
//@if Lights
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
//@end
