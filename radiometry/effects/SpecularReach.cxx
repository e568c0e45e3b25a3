// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/effects/SpecularReach.h"

#include "radiometry/effects/SimulatedScene.h"
#include "radiometry/visibility/Convexity.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double Infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t MostPairs = 4000000;   // facets x lights that are looked at one by one
constexpr double MostComparisons = 2e6;      // of a component's convexity
constexpr std::size_t MostPlanes = 256;
constexpr std::size_t MostGlossyPlanes = 64;

/// 0 where nothing is sent on, however much of it there were.
double Times(double factor, double value)
{
  return factor > 0.0 ? factor * value : 0.0;
}

double Rest(double share)
{
  return share < 1.0 ? 1.0 / (1.0 - share) : Infinite;
}

struct Facet
{
  std::size_t Triangle = 0;
  int Side = 0;
  double Reflectance = 0.0; // brightest band
  double Shininess = 0.0;
  double Area = 0.0;
};

struct Facets
{
  std::vector<Facet> Mirrors;
  std::vector<Facet> Glossy;
};

Facets FindFacets(const Scene& scene)
{
  Facets out;
  const Materials& optics = scene.Optics;
  const auto bands = static_cast<std::size_t>(optics.Bands);
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    const auto cell = static_cast<std::size_t>(scene.TriangleCell[t]);
    for (std::size_t side = 0; side < 2; ++side)
    {
      const std::vector<double>& specular = OfSide(optics.SpecularReflectance, side);
      const bool there = side == 0 || (cell < optics.TwoSided.size() && optics.TwoSided[cell] != 0);
      if (!there || specular.empty())
      {
        continue;
      }
      Facet f;
      f.Triangle = t;
      f.Side = static_cast<int>(side);
      f.Reflectance = *std::max_element(specular.data() + cell * bands,
        specular.data() + (cell + 1) * bands);
      f.Area = Area(scene.TriangleAt(t));
      if (!(f.Reflectance > 0.0) || !(f.Area > 0.0))
      {
        continue;
      }
      const std::vector<double>& shininess = OfSide(optics.Shininess, side);
      f.Shininess = shininess.empty() ? DefaultShininess : shininess[cell];
      (f.Shininess >= MirrorShininess ? out.Mirrors : out.Glossy).push_back(f);
    }
  }
  return out;
}

double ExtentOf(const Scene& scene)
{
  double extent = 0.0;
  for (const Vec3& p : scene.Points)
  {
    extent = std::max({ extent, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z) });
  }
  return extent;
}

using Group = std::vector<Facet>;

/// Facets by the planes that they lie in; with more than `most` planes each of the others is its own.
std::vector<Group> ByPlane(const Scene& scene, const Group& facets, double extent, std::size_t most)
{
  std::vector<Group> groups;
  std::vector<std::pair<Vec3, Vec3>> planes; // normal, a point
  for (const Facet& f : facets)
  {
    const Triangle3 t = scene.TriangleAt(f.Triangle);
    const auto in = [&](const std::pair<Vec3, Vec3>& plane) {
      return std::all_of(t.begin(), t.end(), [&](const Vec3& p) {
        return std::fabs(Dot(plane.first, p - plane.second)) <= 1e-12 * extent;
      });
    };
    const auto found = std::find_if(planes.begin(), planes.end(), in);
    if (found != planes.end())
    {
      groups[static_cast<std::size_t>(found - planes.begin())].push_back(f);
    }
    else if (planes.size() < most)
    {
      // Planes come first, so that their numbers are those of their groups.
      groups.insert(groups.begin() + static_cast<std::ptrdiff_t>(planes.size()), Group{ f });
      planes.emplace_back(Normalized(AreaNormal2(t)), t[0]);
    }
    else
    {
      groups.push_back({ f });
    }
  }
  return groups;
}

/// Facets that hang together by common points.
std::vector<Group> Components(const Scene& scene, const Group& facets)
{
  std::map<std::int32_t, std::int32_t> root;
  const auto find = [&](std::int32_t p) {
    while (root[p] != p)
    {
      p = root[p] = root[root[p]];
    }
    return p;
  };
  for (const Facet& f : facets)
  {
    for (const std::int32_t p : scene.Triangles[f.Triangle])
    {
      root.emplace(p, p);
    }
    const auto& v = scene.Triangles[f.Triangle];
    root[find(v[1])] = find(v[0]);
    root[find(v[2])] = find(v[0]);
  }
  std::map<std::int32_t, Group> parts;
  for (const Facet& f : facets)
  {
    parts[find(scene.Triangles[f.Triangle][0])].push_back(f);
  }
  std::vector<Group> groups;
  for (auto& part : parts)
  {
    groups.push_back(std::move(part.second));
  }
  return groups;
}

/// True when all facets lie on a convex body and reflect outward.
bool IsConvexBody(const Scene& scene, const Group& facets)
{
  if (std::any_of(facets.begin(), facets.end(), [](const Facet& f) { return f.Side != 0; }))
  {
    return false;
  }
  Scene part;
  std::map<std::int32_t, std::int32_t> number;
  for (const Facet& f : facets)
  {
    std::array<std::int32_t, 3> corners = scene.Triangles[f.Triangle];
    for (std::int32_t& c : corners)
    {
      const auto [at, added] =
        number.emplace(c, static_cast<std::int32_t>(part.Points.size()));
      if (added)
      {
        part.Points.push_back(scene.Points[static_cast<std::size_t>(c)]);
      }
      c = at->second;
    }
    part.Triangles.push_back(corners);
  }
  return static_cast<double>(part.Points.size()) * static_cast<double>(part.Triangles.size()) <=
    MostComparisons &&
    FindConvexity(part) == Convexity::Body;
}

/// Groups of mirrors through each of which a place sees at most one image of a light.
std::vector<Group> MirrorGroups(const Scene& scene, const Group& mirrors, double extent)
{
  std::vector<Group> groups;
  for (Group& component : Components(scene, mirrors))
  {
    if (IsConvexBody(scene, component))
    {
      groups.push_back(std::move(component));
      continue;
    }
    for (Group& plane : ByPlane(scene, component, extent, MostPlanes))
    {
      groups.push_back(std::move(plane));
    }
  }
  return groups;
}

/// True where what one facet sends meets no other: all lie in one plane, or on one convex body.
bool NoneSeesAnother(const Scene& scene, const Facets& facets, double extent)
{
  Group all = facets.Mirrors;
  all.insert(all.end(), facets.Glossy.begin(), facets.Glossy.end());
  return IsConvexBody(scene, all) || ByPlane(scene, all, extent, 1).size() <= 1;
}

/// The factor of rho I/h^2 that a plane with lobes of these exponents gives at most.
double PlaneOfLobes(double least, double most)
{
  const double q = least > 0.0 ? std::pow(least / (least + 2.0), 0.5 * least) : 1.0;
  return q * (1.0 + std::log(2.0 * (most + 2.0) / q));
}

struct PointLike
{
  double Mirrored = 0.0;     // by one mirror
  double MirroredFlux = 0.0; // that mirrors reflect of the lights, W
  double GlossyFlux = 0.0;
  double Lobe = 0.0;         // pi times the greatest radiance after a first lobe
  double Planes = Infinite;  // after a lobe, by planes
};

PointLike ByLights(const Scene& scene, const Facets& facets, const std::vector<Group>& mirrors,
  const std::vector<const Light*>& lights, const LightVariants& variants, double extent)
{
  PointLike out;
  for (const Group& group : mirrors)
  {
    for (const Light* light : lights)
    {
      double strongest = 0.0;
      for (const Facet& f : group)
      {
        const PairBound pair = BoundPair(*light, scene.TriangleAt(f.Triangle), variants);
        if ((pair.Height > 0.0) == (f.Side == 0))
        {
          strongest = std::max(strongest, f.Reflectance * pair.Strength);
          out.MirroredFlux += f.Reflectance * pair.Average * f.Area;
        }
      }
      out.Mirrored += strongest;
    }
  }
  std::vector<Group> planes;
  const bool physical = std::all_of(lights.begin(), lights.end(), [](const Light* l) {
    return l->Type == LightType::Directional || l->InverseSquare();
  });
  if (physical && !facets.Glossy.empty())
  {
    planes = ByPlane(scene, facets.Glossy, extent, MostGlossyPlanes + 1);
    planes.resize(planes.size() > MostGlossyPlanes ? 0 : planes.size());
  }
  const bool byPlanes = !planes.empty();
  out.Planes = byPlanes || facets.Glossy.empty() ? 0.0 : Infinite;
  for (const Group& group : byPlanes ? planes : std::vector<Group>{ facets.Glossy })
  {
    double least = Infinite, most = 0.0;
    for (const Facet& f : group)
    {
      least = std::min(least, f.Shininess);
      most = std::max(most, f.Shininess);
    }
    std::vector<double> strongest(lights.size(), 0.0);
    for (const Facet& f : group)
    {
      double lit = 0.0;
      for (std::size_t k = 0; k < lights.size(); ++k)
      {
        const PairBound pair = BoundPair(*lights[k], scene.TriangleAt(f.Triangle), variants);
        if ((pair.Height > 0.0) == (f.Side == 0))
        {
          lit += pair.Peak;
          out.GlossyFlux += f.Reflectance * pair.Average * f.Area;
          strongest[k] = std::max(strongest[k], f.Reflectance * pair.Strength);
        }
      }
      out.Lobe = std::max(out.Lobe, 0.5 * f.Reflectance * (f.Shininess + 2.0) * lit);
    }
    for (std::size_t k = 0; k < lights.size() && byPlanes; ++k)
    {
      // Of a parallel beam: the lobe's integral over the hemisphere, about the beam's direction.
      out.Planes += strongest[k] *
        (lights[k]->Type == LightType::Directional ? (least + 2.0) / (least + 1.0)
                                                   : PlaneOfLobes(least, most));
    }
  }
  return out;
}

/// pi times the greatest radiance of panels along any line: of each plane of them the brightest.
double PanelRadiance(const Scene& scene, double extent)
{
  std::vector<std::pair<std::pair<Vec3, Vec3>, double>> planes;
  for (const Light& light : scene.Lights)
  {
    if (!light.Enabled || light.Type != LightType::Area || light.Polygon.size() < 3)
    {
      continue;
    }
    const auto same = std::find_if(planes.begin(), planes.end(), [&](const auto& plane) {
      return std::all_of(light.Polygon.begin(), light.Polygon.end(), [&](const Vec3& p) {
        return std::fabs(Dot(plane.first.first, p - plane.first.second)) <= 1e-12 * extent;
      });
    });
    if (same != planes.end())
    {
      same->second = std::max(same->second, Brightest(light));
      continue;
    }
    const auto& p = light.Polygon;
    planes.push_back({ { Normalized(Cross(p[1] - p[0], p[2] - p[0])), p[0] }, Brightest(light) });
  }
  return std::accumulate(planes.begin(), planes.end(), 0.0,
    [](double sum, const auto& plane) { return sum + plane.second; });
}

} // namespace

SpecularReach BoundSpecular(const Scene& scene, const OpticalLimits& optics, bool cellsOnly,
  const std::array<bool, 5>& kinds, const LightVariants& variants, const FirstReflection& straight)
{
  SpecularReach out;
  if (!(optics.Specular > 0.0))
  {
    return out;
  }
  const Facets facets = FindFacets(scene);
  const double extent = ExtentOf(scene);
  std::vector<const Light*> lights;
  double sky = 0.0, skyRadiance = 0.0;
  for (const Light& light : scene.Lights)
  {
    if (!light.Enabled || !kinds[static_cast<std::size_t>(light.Type)])
    {
      continue;
    }
    if (light.Type == LightType::Environment)
    {
      const SkyBound bound = BoundSky(light);
      sky += bound.Irradiance;
      skyRadiance += Pi * bound.Radiance;
    }
    else if (light.Type != LightType::Area && Brightest(light) > 0.0)
    {
      lights.push_back(&light);
    }
  }
  const double panels =
    kinds[static_cast<std::size_t>(LightType::Area)] ? PanelRadiance(scene, extent) : 0.0;
  const double stays = Rest(optics.Carried);
  const double perArea =
    cellsOnly && optics.SmallestCell > 0.0 ? stays / optics.SmallestCell : Infinite;

  double area = 0.0; // reflectance times area
  double sharpest = 0.0;
  for (const Group* group : { &facets.Mirrors, &facets.Glossy })
  {
    for (const Facet& f : *group)
    {
      area += f.Reflectance * f.Area;
      sharpest = group == &facets.Glossy
        ? std::max(sharpest, 0.5 * f.Reflectance * (f.Shininess + 2.0))
        : sharpest;
    }
  }
  const auto extended = [&](double reflectance, double& value, double& peak) {
    peak += Times(panels + skyRadiance, reflectance * stays);
    value += Times(panels, reflectance * stays) +
      std::min(Times(skyRadiance, reflectance * stays), Times(sky * area, perArea));
  };
  extended(optics.Specular, out.Value, out.Peak);
  extended(optics.Mirror, out.MirrorValue, out.MirrorPeak);

  const std::size_t count = facets.Mirrors.size() + facets.Glossy.size();
  if (count * lights.size() > MostPairs)
  {
    double flux = 0.0;
    for (const Light* light : lights)
    {
      const bool parallel = light->Type == LightType::Directional;
      flux += Brightest(*light) * (parallel ? area : 4.0 * Pi * optics.Specular);
      if (!parallel && !light->InverseSquare())
      {
        flux = Infinite; // a legacy falloff does not keep a light's flux
      }
    }
    out.Value += Times(flux, perArea);
    out.Peak = Infinite;
    out.MirrorValue += Times(optics.Mirror, 1.0) > 0.0 ? Times(flux, perArea) : 0.0;
    out.MirrorPeak = optics.Mirror > 0.0 ? Infinite : 0.0;
    return out;
  }
  const std::vector<Group> mirrors = MirrorGroups(scene, facets.Mirrors, extent);
  const PointLike points = ByLights(scene, facets, mirrors, lights, variants, extent);
  // Over mirrors alone.
  const double next = mirrors.empty()
    ? 0.0
    : optics.Mirror * static_cast<double>(mirrors.size() - 1);
  const double mirrorPeak = Times(points.Mirrored, next < 1.0 ? 1.0 / (1.0 - next) : Infinite);
  const double mirrorValue = std::min({ mirrorPeak, Times(points.MirroredFlux, perArea),
    points.Mirrored + Times(optics.Mirror * points.MirroredFlux, perArea) });
  // ... and over lobes: met first, or after mirrors; then radiance goes on.
  const bool alone = NoneSeesAnother(scene, facets, extent); // no second meeting, but with panes
  const double again = alone ? optics.Pane : optics.Carried;
  const double first =
    std::min({ points.Lobe, points.Planes, Times(sharpest, straight.Peak) });
  const double wanted = std::min(first, Times(sharpest, straight.Value));
  double further = Times(points.Lobe, Times(again, Rest(again)));
  if (facets.Mirrors.empty() && !(optics.Pane > 0.0))
  {
    further = std::min(further, Times(first, Times(sharpest, Rest(sharpest))));
  }
  const double after = alone ? 0.0 : Times(sharpest * mirrorPeak, stays);
  const double flux = Times(points.MirroredFlux + points.GlossyFlux, perArea);
  out.Peak += mirrorPeak + first + further + after;
  out.Value += std::min(mirrorValue + wanted + further + after, flux);
  const double mixed = alone ? 0.0 : after + Times(points.Lobe, optics.Mirror * stays * stays);
  out.MirrorPeak += optics.Mirror > 0.0 ? mirrorPeak + mixed : 0.0;
  out.MirrorValue += optics.Mirror > 0.0 ? std::min(mirrorValue + mixed, flux) : 0.0;
  return out;
}

} // namespace radiometry
