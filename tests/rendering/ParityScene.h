// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/shading/LightingModel.h"
#include "radiometry/shading/VertexNormals.h"

#include <cstdint>
#include <string>
#include <vector>

/// A random scene that can be drawn by vtkPhongGouraudMapper and evaluated by radiometry/shading.
struct ParityScene
{
  std::uint32_t Seed = 0;
  int Shading = 2; // 0 Flat, 1 Gouraud, 2 Phong
  radiometry::LightingModel Model;
  radiometry::DisplayMaterial Front;
  radiometry::DisplayMaterial Back;
  bool HasBack = false; // the actor has a back-face property
  std::vector<radiometry::DisplayLight> Lights;

  // Triangles with points and normals of their own, in object coordinates, as float32 values.
  std::vector<radiometry::Vec3> Points;
  std::vector<radiometry::Vec3> Normals;
  radiometry::Matrix3 Transform; // object to world, linear part
  radiometry::Vec3 Shift;

  radiometry::Vec3 Eye;
  radiometry::Vec3 Focus;
  radiometry::Vec3 Up;
  bool Parallel = false;
  double ViewAngle = 40.0;     // degrees, vertical
  double ParallelScale = 1.5;  // half the height

  radiometry::Vec3 ToWorld(const radiometry::Vec3& p) const;
};

/// What a scene is made for. Each flag is switched on for sure; the rest is random.
struct ParityFeatures
{
  bool Point = false;
  bool Spot = false;
  bool Directional = false;
  bool Attenuation = false;
  bool TwoSided = false;
  bool BackMaterial = false;
  bool Emission = false;
  bool Specular = false;
  bool ViewerAtInfinity = false;
  bool Transformed = false;
  bool AnythingElse = true; // random features beside those asked for
};

ParityScene MakeParityScene(std::uint32_t seed, int shading, const ParityFeatures& features);

/// The CPU's answer for one pixel.
struct ParityPixel
{
  bool Hit = false;
  bool Comparable = false; // not at an edge of a triangle, of a cone or of the lit side
  radiometry::Rgb Color;
  radiometry::Vec3 Normal; // world, of the shaded side
  double Depth = 0.0;      // along the camera's axis
};
/// At pixel coordinates; the centre of the first pixel is (0, 0).
ParityPixel EvaluatePixel(const ParityScene& scene, double x, double y, int size);

/// How much the model's colour changes (greatest band) when the place that is seen moves by 2^-22 of
/// its distance from the eye, which is what float32 coordinates are good for. Where that alone
/// exceeds a tolerance, no float32 picture can be held to it.
double FloatSensitivity(const ParityScene& scene, int x, int y, int size);
