// SPDX-License-Identifier: BSD-3-Clause
#ifndef LightCollector_h
#define LightCollector_h

#include "ShaderTemplate.h"
#include "radiometry/shading/LightingModel.h"

#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"

#include <array>
#include <string>
#include <vector>

class vtkDataObject;
class vtkRenderer;

namespace vtkradiometry
{

/// What a light's coordinates are relative to (the array AttachedTo).
enum class LightFrame
{
  Scene = 0,  // world coordinates
  Object = 1, // the actor's own coordinates
  Camera = 2  // the eye at the origin, x right, y up, -z into the picture
};

/// Which light it is: type, position (area: first corner) and direction as its data has them.
using LightKey = std::array<double, 7>;

struct CollectedLights
{
  std::vector<radiometry::DisplayLight> Lights;
  std::vector<LightFrame> Frames;
  std::vector<LightKey> Keys; // type -1: a light that no data knows
  std::vector<int> Columns; // of each light its place among the shares of LightVisibility; -1: none
  bool Spectral = false; // bands became colours by the observer
  int NotDrawn = 0;    // enabled lights that the mapper has no formula for
  std::string Problem; // what was wrong with the arrays; empty: nothing
};

/// Kinds of lights that are drawn alike, in the order in which they are packed.
enum class LightKind
{
  Directional,
  Point,
  Spot,
  Luminaire,
  Area,
  Sky
};
constexpr int LightKinds = 6;
LightKind KindOf(const radiometry::DisplayLight& light);

/// Whether a light, times `scale`, is on and not black.
bool GivesLight(const radiometry::DisplayLight& light, double scale);

/// Reads the enabled lights of a polydata, or of all polydata in a tree, in the project's light
/// arrays (docs/arrays.md).
///   Luminaires have their candela webs, area lights their polygons, environments the low degrees of
///   their irradiance (ExtendedLights.h).
///   Bands: BandColors.h.
///   Lights whose values cannot be drawn (not finite, wrong cone, attenuation without a positive
///   term) are left out and the first is named in Problem.
CollectedLights CollectFromData(vtkDataObject* lights);

/// Reads the lights that are switched on in a renderer, with VTK's meaning: a white diffuse surface
/// that faces a vtkLight of intensity 1 shows 1. `physical` multiplies by pi what the reflection
/// model will divide by it.
CollectedLights CollectFromRenderer(vtkRenderer* renderer, bool physical);

/// The coordinates in which surfaces are lit: the axes of the view about an origin in the middle of
/// the surface. Light needs differences of positions; near that origin float32 has digits for them,
/// wherever in the world surface and eye are.
struct LocalCoordinates
{
  vtkNew<vtkMatrix4x4> FromWorld;
  vtkNew<vtkMatrix4x4> FromView;
  vtkNew<vtkMatrix3x3> FromBuffer; // of coordinates as the vertex buffers have them; transposed
  std::array<float, 3> Eye{ { 0.0f, 0.0f, 0.0f } };
};

/// A place, moved.
radiometry::Vec3 TransformPoint(vtkMatrix4x4* m, const radiometry::Vec3& p);
/// A direction, moved with the surface (no inverse transpose); its length is made one.
radiometry::Vec3 TransformDirection(vtkMatrix4x4* m, const radiometry::Vec3& d);

/// Lights as the shaders read them: six RGBA texels a light, in local coordinates, directional
/// lights first, then points, then spots.
///   0  x y z of the position, or of the direction that the light comes from; its place among the
///      shares of LightVisibility (-1: it has none)
///   1  axis of the cone, 1 - cosine of its half-angle
///   2  diffuse colour, exponent
///   3  ambient colour, cosine of the inner half-angle
///   4  specular colour, 1/(inner - outer)
///   5  attenuation a, b, c; unused
/// Luminaires, area lights and skies come after them and have more after all lights:
///   luminaire    1.x its first texel there: three axes of the web's grid with the numbers of its
///                polar angles and azimuths and whether these go round; then the first texel of the
///                angles and values, four a texel
///   area light   0.xyz its first corner there, their number, two-sided or not
///   sky          0.x its first texel there: constant, x, y, z, xx, yy, zz, xy, xz, yz of SkyQuadric
struct PackedLights
{
  static constexpr int TexelsPerLight = 6;
  std::vector<float> Texels;
  // [begin, end) of directional, point and spot lights, luminaires, area lights, skies.
  std::array<std::array<int, 2>, LightKinds> Ranges{};
  int Count() const { return this->Ranges.back()[1]; }
  ShaderFeatures Features; // what these lights need of the shader
};

/// Whether there are luminaires with a web, area lights or skies among the lights, for which there is no
/// bound on what Gouraud shading changes.
bool NeedsExtendedLights(const ShaderFeatures& features);

/// Moves lights into local coordinates and packs them. Only lights that give light are kept.
///   objectToWorld   as vtkProp3D gives it
///   scale    multiplies every colour;  metersPerUnit turns view distances into metres
PackedLights PackLights(const CollectedLights& lights, const LocalCoordinates& local,
  vtkMatrix4x4* objectToWorld, radiometry::ReflectionModel reflection, double scale,
  double metersPerUnit);

} // namespace vtkradiometry

#endif
// VTK-HeaderTest-Exclude: LightCollector.h
