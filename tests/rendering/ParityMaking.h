// SPDX-License-Identifier: BSD-3-Clause
// What features share that add to a parity scene.
#pragma once

#include "ParityScene.h"

namespace parity
{

using Scene = ParityScene;
using Random = ParityRandom;
using AddFeature =
  std::function<void(const char* name, double chance, std::function<void(Scene&, Random&)>)>;

enum LightKind
{
  Directional,
  Point,
  Spot
};
/// A light at 1.2 to 2.5 from the origin with the fall-off of physics, shining past the middle.
ParityLight& AddLight(Scene& scene, Random& random, LightKind kind);
/// Lights, or highlights in them, where the scene has none.
void NeedLight(Scene& scene, Random& random);
void NeedHighlight(Scene& scene, Random& random);
/// Rotation, scale and shift of the actor.
void Transform(Scene& scene, Random& random, bool uniform, bool mirror);
radiometry::Vec3 ToFloat(const radiometry::Vec3& v);

void AddLightFeatures(const AddFeature& add);
void AddMaterialFeatures(const AddFeature& add);
void AddGeometryFeatures(const AddFeature& add);
/// Last: they need all lights and triangles.
void AddFieldFeatures(const AddFeature& add);

} // namespace parity
