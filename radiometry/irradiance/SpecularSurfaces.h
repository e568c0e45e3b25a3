// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Scene.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// Where a light path goes on from a surface: over mirrors, over glossy surfaces and through panes.
///   Reads    Optics.SpecularReflectance, Shininess, TwoSided, TriangleTransmittance (copied)
///   Model    of what arrives at an angle theta a surface sends rho_s into the lobe of
///            scene/Reflectance.h about the mirror direction (a(theta) rho_s of it gets out, the
///            rest is absorbed; a perfect mirror from Shininess 1e6: all of it into the mirror
///            direction), tau straight on, and the rest, alpha = 1 - rho_s - tau, is left to
///            diffuse reflection and absorption
///   Paths    a path goes on with a probability in the place of a weight, so that a grey one keeps
///            the weight 1 until it ends, however often it is reflected. Where it ends, what the
///            surface sends by itself counts 1/alpha times
///   Energy   what a path counts and what it carries on sum to what it brought, at each surface and
///            in each band: nothing is lost to the choice
///   Cost     a table of a(theta) for each Shininess (at most 64; more are interpolated: right to
///            1e-4), some 80 bytes a triangle that is not opaque and matt
class SpecularSurfaces
{
public:
  /// `backFaces`: two-sided cells reflect on their backs, too.
  SpecularSurfaces(const Scene& scene, bool specular, bool transmission, bool backFaces);

  /// True when paths would go on somewhere.
  static bool Present(const Scene& scene, bool specular, bool transmission);

  bool Empty() const { return this->Faces.empty(); }
  /// Some surface reflects specularly (panes alone do not).
  bool Reflects() const { return this->AnyReflects; }
  /// Bands whose paths differ; 0: all alike.
  int Bands() const { return this->Grey ? 0 : this->BandCount; }
  /// Weights of a path: Bands(), or 1.
  std::size_t Width() const { return this->Grey ? 1 : static_cast<std::size_t>(this->BandCount); }

  /// alpha of a side of a triangle, in a band.
  double Left(std::int32_t triangle, bool front, std::size_t band) const;
  /// rho_s of a side of a triangle, in a band, and whether it is a perfect mirror.
  double Reflectance(std::int32_t triangle, bool front, std::size_t band) const;
  bool Mirror(std::int32_t triangle, bool front) const;
  /// tau of a triangle, in a band.
  double Transmittance(std::int32_t triangle, std::size_t band) const;

  bool GoesOn(const SurfaceHit& hit) const
  {
    return hit.Triangle >= 0 && this->FaceOf[static_cast<std::size_t>(hit.Triangle)] >= 0;
  }

  enum class Fate : std::uint8_t
  {
    Ended,    // what the surface sends counts
    Absorbed, // by a lobe below the horizon
    Mirrored,
    Scattered, // by a lobe
    Transmitted
  };
  /// Decides on a path that comes along the unit vector `direction` and met `hit`, from four numbers in (0, 1).
  /// `weight` (Width() values) becomes that of the way on, `counted` gets what counts here (for
  /// `weight` before: it is split between the two). `direction` becomes the way on.
  Fate Continue(const SurfaceHit& hit, const std::array<double, 4>& u, Vec3& direction,
    double* weight, double* counted) const;

  /// The same for a path that must be reflected: `weight` is multiplied by rho_s. Absorbed where the
  /// lobe sends it below the horizon.
  Fate Reflect(
    const SurfaceHit& hit, const std::array<double, 4>& u, Vec3& direction, double* weight) const;

  /// The place of a hit on a surface where paths go on: where the next ray starts.
  RayEnd Place(const SurfaceHit& hit) const;
  /// The unit normal of a side.
  Vec3 Normal(std::int32_t triangle, bool front) const;

private:
  struct Face
  {
    Triangle3 Corners;
    Vec3 Normal;
    std::array<std::int32_t, 2> Reflected{ -1, -1 }; // row of Shares; -1: none
    std::array<std::int32_t, 2> Lobe{ -1, -1 };      // index into Exponents; -1: mirror
    std::int32_t Transmitted = -1;
  };
  Fate Bounce(
    const Face& face, std::size_t side, const std::array<double, 4>& u, Vec3& direction) const;
  std::int32_t AddRow(const double* values);
  void MakeLobes(const std::vector<double>& exponents);
  /// a(theta)/rho_s.
  double Escaping(double exponent, double cosine) const;
  double Share(std::int32_t row, std::size_t band) const
  {
    return row < 0 ? 0.0 : this->Shares[static_cast<std::size_t>(row) * this->Width() + band];
  }
  const Face* FaceAt(std::int32_t triangle) const
  {
    const std::int32_t f = this->FaceOf[static_cast<std::size_t>(triangle)];
    return f < 0 ? nullptr : &this->Faces[static_cast<std::size_t>(f)];
  }

  int BandCount = 1;
  bool Grey = true;
  bool AnyReflects = false;
  std::vector<std::int32_t> FaceOf; // by triangle; -1: opaque and matt
  std::vector<Face> Faces;
  std::vector<double> Shares;
  std::vector<double> Exponents; // of the faces' lobes
  std::vector<double> TableAt;   // exponents tabulated, ascending
  std::vector<double> Table;     // of each, TableSize values
};

} // namespace radiometry
