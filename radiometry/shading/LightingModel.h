// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"
#include "radiometry/shading/ExtendedLights.h"
#include "radiometry/shading/Rgb.h"

#include <array>
#include <memory>
#include <vector>

namespace radiometry
{

/// How a surface turns light into what is seen.
enum class ReflectionModel
{
  /// Legacy: diffuse k_d E_L (N.L), specular k_s E_L max(N.H, 0)^n, H halfway between L and V.
  /// This is the fixed-function pipeline of OpenGL 1.x.
  BlinnPhong = 0,
  /// Legacy: the same with max(R.V, 0)^n, R the mirror image of L in N (Phong 1975).
  /// For the same n its highlight is narrower: near the mirror direction the angle between R and V
  /// is twice that between N and H, so n(Phong) of about n(Blinn)/4 looks alike.
  Phong = 1,
  /// Radiance of a Lambertian surface with an energy-conserving Phong lobe:
  /// rho_d/pi E + rho_s (n + 2)/(2 pi) max(R.V, 0)^n E, with E = E_L max(N.L, 0).
  Physical = 2
};

/// A light as a display model knows it: three bands, a homogeneous position.
///   Positions and lengths in metres in the coordinates of the sample that is shaded.
struct DisplayLight
{
  /// x, y, z, w. w = 0: a directional light that comes from (x, y, z); else a finite one at
  /// (x, y, z)/w.
  std::array<double, 4> Position{ { 0.0, 0.0, 1.0, 0.0 } };
  Vec3 SpotDirection{ 0.0, 0.0, -1.0 }; // where the axis of the cone points to; any length
  Rgb Ambient;                          // added to the ambient light, with fall-off and cone
  Rgb Diffuse{ 1.0, 1.0, 1.0 };         // W/sr on the axis (w = 1), W/m^2 (w = 0) when physical
  Rgb Specular{ 1.0, 1.0, 1.0 };        // what highlights are made of; normally Diffuse
  double CosCutoff = -1.0;              // cosine of the half-angle of the cone; -1: no cone
  double SpotExponent = 0.0;            // cos^e(phi) inside the cone
  double CosInnerCutoff = -1.0;         // with SmoothEdge: full intensity inside this cosine
  bool SmoothEdge = false;              // clamp((cos - outer)/(inner - outer), 0, 1)^2
  std::array<double, 3> Attenuation{ { 1.0, 0.0, 0.0 } }; // 1/(a + b r + c r^2); w = 0: none
  bool Enabled = true;

  /// A luminaire: Diffuse and Specular times its relative intensity; about SpotDirection, w = 1.
  std::shared_ptr<const CandelaWeb> Web;
  Vec3 Reference{ 1.0, 0.0, 0.0 }; // where C = 0 of the web lies
  /// An area light: a flat polygon that shines where its corners turn counter-clockwise; Diffuse is
  /// its exitance, Position is not read. Diffuse light alone, without a highlight.
  std::vector<Vec3> Polygon;
  bool PolygonTwoSided = false;
  /// An environment: diffuse light alone, with Diffuse as a factor. Nothing else is read.
  std::shared_ptr<const SkyQuadric> Sky;
};

/// What one side of a surface is made of.
struct DisplayMaterial
{
  Rgb Ambient;
  Rgb Diffuse{ 0.5, 0.5, 0.5 };
  Rgb Specular;
  Rgb Emission;           // radiance, added as it is
  double Shininess = 10.; // exponent n of the specular lobe
  double Alpha = 1.0;
};

struct LightingModel
{
  ReflectionModel Reflection = ReflectionModel::Physical;
  Rgb GlobalAmbient;       // multiplies the material's Ambient
  bool LocalViewer = true; // false: the viewer is infinitely far along Viewer for every sample
  bool TwoSided = false;   // back faces: back material and the reversed normal
};

/// A point on a surface and who looks at it.
struct ShadingSample
{
  Vec3 Point;
  Vec3 Normal;             // any length; zero or not finite: the sample reflects no light
  Vec3 Eye;                // position of the viewer (LocalViewer)
  Vec3 Viewer{ 0., 0., 1. }; // direction toward a viewer infinitely far away (not LocalViewer)
  bool FrontFacing = true; // the viewer is on the front side
  /// What of each light arrives here, a share in [0, 1] a light, in their order (the array
  /// LightVisibility); null: all of it. Light that counts as ambient is not hidden.
  const double* Visibility = nullptr;
};

/// The sums over the lights that a material multiplies; they are what Gouraud shading interpolates.
struct LightSums
{
  Rgb Ambient;
  Rgb Diffuse;
  Rgb Specular;
};

struct ShadedColor
{
  Rgb Color; // scene-linear, not clamped
  double Alpha = 1.0;
};

/// The highlight of a legacy model for unit vectors N, L toward the light with N.L > 0, V toward the
/// viewer: max(R.V, 0)^n (Phong) or max(N.H, 0)^n (BlinnPhong). 1 for n = 0; 0 for n that is negative,
/// infinite or no number, and where H has no direction.
double SpecularLobe(
  ReflectionModel reflection, const Vec3& N, const Vec3& L, const Vec3& V, double shininess);

/// Fall-off and cone of a light at distance r (m) in the direction `toPoint` (unit, from the light
/// to the point): spot/(a + b r + c r^2). 1 for directional lights, whatever their cone; 0 where the
/// fall-off is not finite (a + b r + c r^2 = 0).
///   Model   OpenGL 2.1 but for the cone of directional lights, which it applies
double LightFactor(const DisplayLight& light, double r, const Vec3& toPoint);

/// The sums over the enabled lights at a sample, about its Normal as it stands (no side is chosen).
/// A light exactly at the sample's point adds nothing: it has no direction.
///   Cost    O(lights)
LightSums SumLights(const LightingModel& model, const std::vector<DisplayLight>& lights,
  double shininess, const ShadingSample& sample);

/// Emission + Ambient (GlobalAmbient + sums.Ambient) + Diffuse sums.Diffuse + Specular sums.Specular.
ShadedColor ApplyMaterial(
  const LightingModel& model, const DisplayMaterial& material, const LightSums& sums);

/// The full model: picks the side, sums the lights, applies the material.
///   Model   Segal and Akeley, The OpenGL Graphics System 2.1, section 2.14.1 (legacy models;
///           without its clamping to [0, 1]); Lafortune and Willems 1994, eq. 4 (Physical)
///   Limits  legacy models conserve no energy, and since their highlight is not multiplied by N.L
///           as a BRDF's is, they obey no reciprocity; Physical does both
///   Fails   never: degenerate normals, directions and lights shade as unlit
ShadedColor Shade(const LightingModel& model, const std::vector<DisplayLight>& lights,
  const DisplayMaterial& front, const DisplayMaterial& back, const ShadingSample& sample);

} // namespace radiometry
