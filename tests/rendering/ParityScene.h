// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/shading/LightingModel.h"
#include "radiometry/shading/VertexNormals.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

/// Random numbers that are the same everywhere: std distributions differ between libraries.
class ParityRandom
{
public:
  explicit ParityRandom(std::uint32_t seed)
    : Engine(seed)
  {
  }
  double In(double a, double b)
  {
    return a + (b - a) * (static_cast<double>(this->Engine()) / 4294967296.0);
  }
  bool Chance(double p) { return this->In(0.0, 1.0) < p; }
  int Below(int n) { return static_cast<int>(this->Engine() % static_cast<std::uint32_t>(n)); }
  radiometry::Rgb Color(double least, double most);
  radiometry::Vec3 Direction();

private:
  std::mt19937 Engine;
};

/// Whose coordinates a light is given in.
enum class ParityFrame
{
  Scene = 0,
  Object = 1,
  Camera = 2
};

struct ParityLight
{
  radiometry::DisplayLight Light; // in the coordinates of its frame
  ParityFrame Frame = ParityFrame::Scene;
  std::shared_ptr<const radiometry::SkyRadiance> Radiance; // of Light.Sky
};

/// Where a surface's colour comes from.
enum class ParityColors
{
  Property,
  Blocks,             // the colour of each block of a multiblock
  Scalars,            // 8-bit colours of cells
  CellReflectance,    // FIELD_REFLECTANCE
  PointReflectance,
  Materials,          // the surface arrays
  CellField,          // FIELD_ON: highlights alone
  PointField
};

/// Where the surface knows what of each light arrives.
enum class ParityShares
{
  None,
  Cells,
  Points
};

/// A scene that can be drawn by vtkPhongGouraudMapper and evaluated by radiometry/shading.
struct ParityScene
{
  std::string Name; // feature and seed, for messages
  int Shading = 2;  // 0 Flat, 1 Gouraud, 2 Phong
  radiometry::LightingModel Model;
  radiometry::DisplayMaterial Front;
  radiometry::DisplayMaterial Back;
  bool HasBack = false; // the actor has a back-face property
  double Alpha = 1.0;

  std::vector<ParityLight> Lights;
  bool RendererLights = false; // handed over as vtkLights
  double LightScale = 1.0;
  double MetersPerUnit = 1.0;

  // Triangles with points and normals of their own, in object coordinates.
  std::vector<radiometry::Vec3> Points;
  std::vector<radiometry::Vec3> Normals; // none: the cell's
  int TrianglesPerBlock = 0;             // 0: one polydata, no blocks
  radiometry::Matrix3 Transform{ { { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 1 } } } };
  radiometry::Vec3 Shift;

  ParityColors Colors = ParityColors::Property;
  double AmbientShare = 0.0; // the property's ambient, where the colour is not the property's
  std::vector<radiometry::Rgb> Values; // one a block, cell or point
  double FieldScale = 1.0;
  ParityShares Shares = ParityShares::None;
  std::vector<double> SharesFront; // cells or points x lights; none where Shares is None
  std::vector<double> SharesBack;  // none: no LightVisibilityBack
  std::vector<radiometry::DisplayMaterial> CellFront; // Materials
  std::vector<radiometry::DisplayMaterial> CellBack;  // none: no Back... arrays
  std::vector<bool> CellTwoSided;                     // none: no array

  radiometry::Vec3 Eye;
  radiometry::Vec3 Focus;
  radiometry::Vec3 Up;
  bool Parallel = false;
  double ViewAngle = 40.0;    // degrees, vertical
  double ParallelScale = 1.5; // half the height
  double Unit = 1.0;          // what the scene is scaled by

  // What Prepare() makes of the rest.
  std::vector<radiometry::DisplayLight> WorldLights;
  std::vector<radiometry::Vec3> WorldPoints;
  std::vector<radiometry::Vec3> ScreenPoints; // x and y in [-1, 1] over the picture, depth
  std::array<radiometry::Vec3, 3> ViewAxes; // right, up, back (toward the viewer); unit

  std::size_t Triangles() const { return this->Points.size() / 3; }
  radiometry::Vec3 ToWorld(const radiometry::Vec3& p) const;
  radiometry::Vec3 DirectionToWorld(const radiometry::Vec3& d) const;
  /// Brings points and lights into world coordinates, with everything that scales them. To be
  /// called after the last change and before evaluation.
  void Prepare();
  /// Flat, Gouraud or Phong as the mapper's documentation says: Gouraud needs point normals and one
  /// exponent for the whole surface.
  int ShadingInEffect() const;
  bool ShowsField() const
  {
    return this->Colors == ParityColors::CellField || this->Colors == ParityColors::PointField;
  }
  bool KnowsShadows() const { return this->Shares != ParityShares::None && !this->RendererLights; }
};

/// One feature of the model: what it adds to a scene.
struct ParityFeature
{
  std::string Name;
  std::function<void(ParityScene&, ParityRandom&)> Apply;
  double Chance = 0.15; // in random combinations
};
/// All features, in the order in which they can be combined.
const std::vector<ParityFeature>& ParityFeatures();

/// The feature alone (no other but what it needs to be seen).
ParityScene MakeFeatureScene(const ParityFeature& feature, std::uint32_t seed, int shading);
/// Features in random combination.
ParityScene MakeRandomScene(std::uint32_t seed, int shading);

/// The CPU's answer for one pixel.
struct ParityPixel
{
  bool Hit = false;
  bool Comparable = false; // what covers it does not hang on rounding; no step of the model near
  radiometry::Rgb Color;   // alpha multiplied in, as the frame buffer has it
  double Alpha = 0.0;
  radiometry::Vec3 Normal; // world, of the shaded side
  double Depth = 0.0;      // along the camera's axis
};
/// The centre of the first pixel is (0, 0).
ParityPixel EvaluatePixel(const ParityScene& scene, double x, double y, int size);

/// What float32 costs at a pixel: how far each band of the model moves when what the GPU is given
/// and must compute in float32 moves by 2^-22 (four roundings) of itself: the place on the surface
/// along it (two coordinates in the picture; in slivers by more, as gradients across them are
/// quotients of differences), the point in space, the normal and the lights (three
/// coordinates each). The sum over these eleven. The model is evaluated in double: nothing of the
/// GPU is in this number.
radiometry::Rgb FloatConditioning(const ParityScene& scene, int x, int y, int size);
