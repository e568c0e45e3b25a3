// SPDX-License-Identifier: BSD-3-Clause
#ifndef PictureBounds_h
#define PictureBounds_h

#include "LightCollector.h"

#include "radiometry/effects/EffectPlan.h"
#include "radiometry/shading/EffectBounds.h"
#include "radiometry/shading/ShadingBound.h"

#include <bitset>
#include <cstddef>
#include <vector>

namespace vtkradiometry
{

using EffectSet = std::bitset<radiometry::EffectCount>;

/// The row of the plan that lights of a kind stand in.
radiometry::Effect RowOf(LightKind kind);
/// Whether lights of a kind fall off with distance.
bool HasFallOff(LightKind kind);
/// False: a light is not drawn `without` these effects. Else it is made what it is drawn as, but for its
/// fall-off.
bool KeepLight(radiometry::DisplayLight& light, const EffectSet& without);

/// What a picture is made of, as far as bounds go, in world coordinates; effect after effect can be
/// taken out of it. Bounds are those of EffectBounds.h, summed over the lights, in linear colour.
struct BoundedPicture
{
  radiometry::ShadedScene Scene;    // lights after scale; eye; viewer; model with all effects
  radiometry::BoundedSurface Surface;
  double Square = 1.0;              // of 1/(Square r^2), r in units of the coordinates
  std::vector<double> Loss;         // by light: greatest |1 - share|
  radiometry::Rgb Emission;         // greatest of both sides
  double EmissionOfSides = 0.0;     // greatest difference of the two sides'
  double FieldOfSides = 0.0;        // of a field that is shown, or of normals
  double AmbientOfSides = 0.0;      // 1: they may take ambient light differently

  /// What leaving an effect out of what is left changes of any colour at most. `highlights`: these are
  /// drawn. Infinite where nothing can be said.
  double BoundOf(radiometry::Effect effect, bool highlights) const;
  void TakeOut(radiometry::Effect effect);
  /// All numbers that bounds depend on.
  std::vector<double> Key() const;

private:
  bool FallsOtherwise(const radiometry::DisplayLight& light) const;
};

} // namespace vtkradiometry

#endif
// VTK-HeaderTest-Exclude: PictureBounds.h
