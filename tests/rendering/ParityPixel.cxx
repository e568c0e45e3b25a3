// SPDX-License-Identifier: BSD-3-Clause
// What radiometry/shading says of a pixel, and how far float32 can be trusted there.
#include "ParityScene.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace radiometry;

namespace
{

constexpr double Pi = 3.14159265358979323846;
const double FourRoundings = std::ldexp(1.0, -22);

/// Small displacements of what a sample is computed from.
struct Nudge
{
  Vec3 Point;  // relative to the distance from the eye
  Vec3 Normal; // relative to the longest normal of the triangle
  Vec3 Light;  // of a place relative to its distance from the eye, of a direction as it is
};

struct Ray
{
  Vec3 Origin;
  Vec3 Direction; // unit along the view's axis: parameters along it are depths
};

struct Hit
{
  std::size_t Triangle = 0;
  double Depth = std::numeric_limits<double>::infinity();
  std::array<double, 3> Weights{ { 0, 0, 0 } };
  bool Grazing = false;   // seen within 1 degree of edge-on
  bool Contested = false; // another triangle lies right behind it: which is nearer?
};

Ray RayThrough(const ParityScene& scene, double x, double y, int size)
{
  const std::array<Vec3, 3>& axes = scene.ViewAxes;
  const double sx = 2.0 * (x + 0.5) / size - 1.0;
  const double sy = 2.0 * (y + 0.5) / size - 1.0;
  const double half =
    scene.Parallel ? scene.ParallelScale : std::tan(0.5 * scene.ViewAngle * Pi / 180.0);
  const Vec3 offset = half * (sx * axes[0] + sy * axes[1]);
  return scene.Parallel ? Ray{ scene.Eye + offset, -axes[2] } : Ray{ scene.Eye, offset - axes[2] };
}

/// The triangles along a ray, in the order in which they are drawn.
std::vector<Hit> Intersect(const ParityScene& scene, const Ray& ray)
{
  std::vector<Hit> hits;
  for (std::size_t t = 0; t < scene.Triangles(); ++t)
  {
    const Vec3 a = scene.WorldPoints[3 * t] - ray.Origin;
    const Vec3 b = scene.WorldPoints[3 * t + 1] - ray.Origin;
    const Vec3 c = scene.WorldPoints[3 * t + 2] - ray.Origin;
    const Vec3 n = Cross(b - a, c - a);
    const double facing = Dot(ray.Direction, n);
    const double depth = Dot(a, n) / facing;
    const Vec3 p = depth * ray.Direction;
    const double u = Dot(Cross(c - b, p - b), n) / LengthSquared(n);
    const double v = Dot(Cross(a - c, p - c), n) / LengthSquared(n);
    if (u > 0.0 && v > 0.0 && u + v < 1.0 && depth > 0.0)
    {
      Hit hit;
      hit.Triangle = t;
      hit.Depth = depth;
      hit.Weights = { { u, v, 1.0 - u - v } };
      hit.Grazing = std::abs(facing) < 0.02 * Length(n) * Length(ray.Direction);
      hits.push_back(hit);
    }
  }
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.Depth < b.Depth; });
  for (std::size_t i = 1; i < hits.size(); ++i)
  {
    hits[i - 1].Contested = hits[i].Depth - hits[i - 1].Depth < 1e-3 * hits[i - 1].Depth;
  }
  if (scene.Alpha == 1.0 && hits.size() > 1)
  {
    hits.resize(1);
  }
  return hits;
}

/// Does what covers the pixel hang on rounding? Not so where its centre keeps 0.05 pixels from the
/// outline of each triangle (the rasteriser knows places to 1/256 pixel), no triangle is edge-on and
/// none is cut there by the picture's rim.
bool CoverageIsSafe(const ParityScene& scene, const std::vector<Hit>& hits, double x, double y,
  int size)
{
  const Vec3 p{ 2.0 * (x + 0.5) / size - 1.0, 2.0 * (y + 0.5) / size - 1.0, 0.0 };
  const double margin = 0.05 * 2.0 / size;
  for (std::size_t t = 0; t < scene.Triangles(); ++t)
  {
    const Vec3* corner = &scene.ScreenPoints[3 * t];
    const auto turn = [](const Vec3& u, const Vec3& v) { return u.x * v.y - u.y * v.x; };
    const double sign = turn(corner[1] - corner[0], corner[2] - corner[0]) < 0.0 ? -1.0 : 1.0;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i)
    {
      const Vec3 edge = corner[(i + 1) % 3] - corner[i];
      least = std::min(least, sign * turn(edge, p - corner[i]) / std::hypot(edge.x, edge.y));
    }
    // At the picture's rim a triangle that goes on beyond it is cut, to bits of any thinness.
    const bool atRim = std::max(std::abs(p.x), std::abs(p.y)) > 1.0 - 2.0 / size;
    const auto outside = [](const Vec3& c) { return std::max(std::abs(c.x), std::abs(c.y)) > 1.0; };
    if (std::abs(least) < margin ||
      (atRim && least > 0.0 && std::any_of(corner, corner + 3, outside)))
    {
      return false;
    }
  }
  return std::none_of(hits.begin(), hits.end(), [](const Hit& hit) { return hit.Grazing || hit.Contested; });
}

/// What the rounding of a rasteriser's gradients grows by in slivers: they are divided by the area,
/// a difference of two products.
double SliverFactor(const ParityScene& scene, const Hit& hit)
{
  const Vec3* corner = &scene.ScreenPoints[3 * hit.Triangle];
  const Vec3 a = corner[1] - corner[0];
  const Vec3 b = corner[2] - corner[0];
  return (std::abs(a.x * b.y) + std::abs(a.y * b.x)) / std::abs(a.x * b.y - a.y * b.x);
}

Rgb Interpolated(const std::vector<Rgb>& values, const Hit& hit)
{
  Rgb sum;
  for (int i = 0; i < 3; ++i)
  {
    sum += hit.Weights[i] * values[3 * hit.Triangle + i];
  }
  return sum;
}

/// The material of one side of a triangle.
DisplayMaterial MaterialOf(const ParityScene& scene, const Hit& hit, bool behind)
{
  DisplayMaterial material = behind ? scene.Back : scene.Front;
  const auto colored = [&](const Rgb& color) {
    material.Diffuse = color;
    material.Ambient = scene.AmbientShare * color;
    return material;
  };
  switch (scene.Colors)
  {
    case ParityColors::Blocks:
      return colored(scene.Values[hit.Triangle / scene.TrianglesPerBlock]);
    case ParityColors::Scalars:
      return colored((1.0 / 255.0) * scene.Values[hit.Triangle]);
    case ParityColors::CellReflectance:
      return colored(scene.FieldScale * scene.Values[hit.Triangle]);
    case ParityColors::PointReflectance:
      return colored(scene.FieldScale * Interpolated(scene.Values, hit));
    case ParityColors::Materials:
    {
      const bool ownBack = behind && !scene.CellBack.empty();
      DisplayMaterial ofCell = (ownBack ? scene.CellBack : scene.CellFront)[hit.Triangle];
      if (behind && !ownBack && scene.HasBack)
      {
        ofCell = scene.Back;
        ofCell.Emission = Rgb();
      }
      if (behind && !scene.CellTwoSided.empty() && !scene.CellTwoSided[hit.Triangle])
      {
        ofCell = DisplayMaterial();
        ofCell.Diffuse = Rgb();
      }
      ofCell.Emission += material.Emission;
      ofCell.Ambient = scene.AmbientShare * ofCell.Diffuse;
      return ofCell;
    }
    default:
      return material;
  }
}

/// What of each light arrives at a hit; none: all.
std::vector<double> SharesAt(const ParityScene& scene, const Hit& hit, bool behind)
{
  const std::size_t lights = scene.Lights.size();
  const std::vector<double>& values = behind ? scene.SharesBack : scene.SharesFront;
  std::vector<double> shares;
  for (std::size_t k = 0; k < lights && scene.KnowsShadows() && !values.empty(); ++k)
  {
    double share = scene.Shares == ParityShares::Cells ? values[hit.Triangle * lights + k] : 0.0;
    for (std::size_t i = 0; i < 3 && scene.Shares == ParityShares::Points; ++i)
    {
      share += hit.Weights[i] * values[(3 * hit.Triangle + i) * lights + k];
    }
    shares.push_back(share);
  }
  return shares;
}

struct Shaded
{
  Rgb Color;
  Vec3 Normal;
  bool NearStep = false; // the model jumps here: where a cone ends, where a legacy highlight does
};

bool IsNearStep(const LightingModel& model, const std::vector<DisplayLight>& lights,
  const DisplayMaterial& material, const ShadingSample& s)
{
  for (const DisplayLight& light : lights)
  {
    const Vec3 position{ light.Position[0], light.Position[1], light.Position[2] };
    const bool finite = light.Position[3] != 0.0;
    const Vec3 toLight = finite ? position - s.Point : position;
    const Vec3 L = Normalized(toLight);
    const double near =
      1e-5 * (finite ? std::max(1.0, Length(s.Point - s.Eye) / Length(toLight)) : 1.0);
    const bool highlightEnds = model.Reflection != ReflectionModel::Physical &&
      !(material.Specular == Rgb()) && std::abs(Dot(Normalized(s.Normal), L)) < near;
    const bool coneEnds = finite && light.CosCutoff > -1.0 && !light.SmoothEdge &&
      std::abs(Dot(Normalized(light.SpotDirection), -L) - light.CosCutoff) < near;
    if (highlightEnds || coneEnds)
    {
      return true;
    }
  }
  return false;
}

Shaded ShadeHit(const ParityScene& scene, const Ray& ray, const Hit& hit,
  const std::vector<DisplayLight>& lights, const Nudge& nudge)
{
  const std::size_t first = 3 * hit.Triangle;
  Shaded result;
  LightingModel model = scene.Model;
  model.LocalViewer = model.LocalViewer && !scene.Parallel;
  ShadingSample sample;
  sample.Eye = scene.Eye;
  sample.Viewer = scene.ViewAxes[2];
  const Triangle3 object{ scene.Points[first], scene.Points[first + 1], scene.Points[first + 2] };
  const Vec3 faceNormal = Normalized(AreaNormal2(object));
  sample.FrontFacing = Dot(TransformNormal(scene.Transform, faceNormal), ray.Direction) < 0.0;
  const bool behind = model.TwoSided && !sample.FrontFacing;
  DisplayMaterial material = MaterialOf(scene, hit, behind);
  if (scene.ShowsField())
  {
    // Highlights on the field, and no other light.
    material.Ambient = material.Diffuse = Rgb();
    material.Emission = scene.FieldScale *
      (scene.Colors == ParityColors::CellField ? scene.Values[hit.Triangle]
                                               : Interpolated(scene.Values, hit));
  }
  const std::vector<double> shares = SharesAt(scene, hit, behind);
  sample.Visibility = shares.empty() ? nullptr : shares.data();
  const auto addSample = [&](std::vector<ShadingSample>& to, const Vec3& point, Vec3 normal,
                           double longest) {
    normal += longest * nudge.Normal;
    sample.Point = point + Length(point - scene.Eye) * nudge.Point;
    sample.Normal = TransformNormal(scene.Transform, normal);
    sample.Normal = behind ? -sample.Normal : sample.Normal;
    to.push_back(sample);
  };

  const int shading = scene.ShadingInEffect();
  const auto corner = [&](int i) { return scene.WorldPoints[first + i]; };
  const auto normalAt = [&](int i) {
    return scene.Normals.empty() ? faceNormal : scene.Normals[first + i];
  };
  std::vector<ShadingSample> samples; // where the model is evaluated
  if (shading == 1)
  {
    for (int i = 0; i < 3; ++i)
    {
      addSample(samples, corner(i), normalAt(i), Length(normalAt(i)));
    }
  }
  else if (shading == 2)
  {
    Vec3 normal;
    double longest = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      normal += hit.Weights[i] * normalAt(i);
      longest = std::max(longest, Length(normalAt(i)));
    }
    addSample(samples, ray.Origin + hit.Depth * ray.Direction, normal, longest);
  }
  else
  {
    addSample(samples, (corner(0) + corner(1) + corner(2)) / 3.0, faceNormal, 1.0);
  }
  result.Normal = samples[0].Normal;

  LightSums sums;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    result.NearStep = result.NearStep || IsNearStep(model, lights, material, samples[i]);
    const LightSums at = SumLights(model, lights, material.Shininess, samples[i]);
    const double w = samples.size() == 1 ? 1.0 : hit.Weights[i];
    sums.Ambient += w * at.Ambient;
    sums.Diffuse += w * at.Diffuse;
    sums.Specular += w * at.Specular;
  }
  result.Color = ApplyMaterial(model, material, sums).Color;
  return result;
}

std::vector<DisplayLight> NudgedLights(const ParityScene& scene, const Vec3& nudge)
{
  std::vector<DisplayLight> lights = scene.WorldLights;
  for (DisplayLight& light : lights)
  {
    const Vec3 place{ light.Position[0], light.Position[1], light.Position[2] };
    const double reach = light.Position[3] == 0.0 ? Length(place) : Length(place - scene.Eye);
    for (int i = 0; i < 3; ++i)
    {
      light.Position[i] += reach * nudge[i];
    }
    light.SpotDirection += Length(light.SpotDirection) * nudge;
    for (Vec3& corner : light.Polygon)
    {
      corner += Length(corner - scene.Eye) * nudge;
    }
  }
  return lights;
}

ParityPixel Evaluate(
  const ParityScene& scene, double x, double y, int size, const Nudge& nudge, bool safety)
{
  const Ray ray = RayThrough(scene, x, y, size);
  const std::vector<Hit> hits = Intersect(scene, ray);
  ParityPixel pixel;
  pixel.Hit = !hits.empty();
  pixel.Comparable = !safety || CoverageIsSafe(scene, hits, x, y, size);
  if (!pixel.Hit || !pixel.Comparable)
  {
    return pixel;
  }
  std::vector<DisplayLight> nudged;
  if (!(nudge.Light == Vec3{}))
  {
    nudged = NudgedLights(scene, nudge.Light);
  }
  const std::vector<DisplayLight>& lights = nudged.empty() ? scene.WorldLights : nudged;
  pixel.Depth = hits[0].Depth;
  for (auto hit = hits.rbegin(); hit != hits.rend(); ++hit) // layer upon layer, the nearest last
  {
    const Shaded shaded = ShadeHit(scene, ray, *hit, lights, nudge);
    pixel.Color = scene.Alpha * shaded.Color + (1.0 - scene.Alpha) * pixel.Color;
    pixel.Alpha = scene.Alpha + (1.0 - scene.Alpha) * pixel.Alpha;
    pixel.Normal = shaded.Normal;
    pixel.Comparable = pixel.Comparable && !shaded.NearStep;
  }
  return pixel;
}

Rgb Distance(const Rgb& a, const Rgb& b)
{
  return { std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b) };
}

Rgb Greatest(const Rgb& a, const Rgb& b)
{
  return { std::max(a.r, b.r), std::max(a.g, b.g), std::max(a.b, b.b) };
}

} // namespace

ParityPixel EvaluatePixel(const ParityScene& scene, double x, double y, int size)
{
  return Evaluate(scene, x, y, size, Nudge(), true);
}

Rgb FloatConditioning(const ParityScene& scene, int x, int y, int size)
{
  const ParityPixel here = Evaluate(scene, x, y, size, Nudge(), false);
  const double half = scene.Parallel
    ? scene.ParallelScale
    : here.Depth * std::tan(0.5 * scene.ViewAngle * Pi / 180.0);
  double shift = FourRoundings * here.Depth / (2.0 * half / size); // in pixels
  double sliver = 1.0;
  for (const Hit& hit : Intersect(scene, RayThrough(scene, x, y, size)))
  {
    sliver = std::max(sliver, SliverFactor(scene, hit));
  }
  shift *= sliver;
  const auto moved = [&](double dx, double dy, const Nudge& nudge) {
    return Distance(Evaluate(scene, x + dx, y + dy, size, nudge, false).Color, here.Color);
  };
  Rgb sum = Greatest(moved(shift, 0.0, Nudge()), moved(-shift, 0.0, Nudge()));
  sum += Greatest(moved(0.0, shift, Nudge()), moved(0.0, -shift, Nudge()));
  for (Vec3 Nudge::*what : { &Nudge::Point, &Nudge::Normal, &Nudge::Light })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      Nudge forth;
      (forth.*what)[axis] = FourRoundings;
      Nudge back;
      (back.*what)[axis] = -FourRoundings;
      sum += Greatest(moved(0.0, 0.0, forth), moved(0.0, 0.0, back));
    }
  }
  return sum;
}
