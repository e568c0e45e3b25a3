// SPDX-License-Identifier: BSD-3-Clause
#ifndef PictureEffects_h
#define PictureEffects_h

#include "PictureBounds.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace vtkradiometry
{

/// What a frame holds, as far as its effects go. Equal facts, equal decisions: nothing is decided anew
/// from frame to frame.
struct FrameFacts
{
  /// What the surface shows.
  enum Content : std::uint8_t
  {
    LitSurface,   // light on its material
    FieldAsLight, // a field, to which highlights may be added
    NothingLit    // normals, false colours, unlit
  };
  std::uint8_t Shows = LitSurface;
  std::uint8_t AnyLight = 0;        // some light gives light
  std::uint8_t Lights = 0;          // ... of a kind that is not switched off
  std::uint8_t Directional = 0;     // ... of this kind
  std::uint8_t Point = 0;
  std::uint8_t Spot = 0;
  std::uint8_t Luminaire = 0;
  std::uint8_t Area = 0;
  std::uint8_t Sky = 0;
  std::uint8_t Highlights = 0;      // some light has highlights
  std::uint8_t Legacy = 0;          // some light falls off otherwise than by the inverse square
  std::uint8_t SpecularMaterial = 0;
  std::uint8_t AmbientMaterial = 0;
  std::uint8_t AmbientLight = 0;    // the scene's or a light's
  std::uint8_t Emission = 0;
  std::uint8_t BacksSeen = 0;       // back faces are drawn
  std::uint8_t SidesDiffer = 0;     // and look other than fronts without any light
  std::uint8_t Parallel = 0;        // projection
  std::uint8_t Translucent = 0;
  std::uint8_t Shares = 0;          // LightVisibility says that some of a light does not arrive
  std::uint8_t SharesKnown = 0;     // there is LightVisibility of some light
  std::uint8_t Spectral = 0;        // bands become colours by the observer
  std::array<std::uint8_t, radiometry::EffectCount> Wishes{}; // EffectSwitch, by Effect

  bool operator==(const FrameFacts& o) const;
};

/// Notes what lights there are. Wishes are read: whatever only a light of a kind that is switched off
/// has, the frame has not.
void NoteLights(const CollectedLights& lights, double scale, FrameFacts& facts);

/// The effect plan of a picture: which effects it carries, which it leaves out, and what that changes.
///   Effects are decided one after the other. The bound of each is that of leaving it out of what is
///   left by those before it: first what the user switched off, then what Auto drops. So the sum of the
///   bounds is one on the difference of the pictures with and without all of them.
///   Unit     the colours that the mapper writes (linear)
///   Source   radiometry/shading/EffectBounds.h
class PictureEffects
{
public:
  PictureEffects();

  /// Decides what is there and wanted. Cheap where the facts are those of the frame before.
  void Decide(const FrameFacts& facts);
  /// Something is left out that is there, or Auto may leave something out: bounds are needed.
  bool NeedsBounds(double tolerance) const;
  /// Bounds of what is switched off; leaves out what Auto may within `tolerance`. Cheap where the
  /// picture is that of the frame before.
  void Bound(BoundedPicture&& picture, double tolerance);

  const radiometry::EffectPlan& Plan() const { return *this->Decided; }
  std::shared_ptr<const radiometry::EffectPlan> Share() const { return this->Decided; }
  bool Simulates(radiometry::Effect effect) const { return this->Decided->Simulates(effect); }
  /// Present, and not drawn.
  bool LeavesOut(radiometry::Effect effect) const { return this->Decided->LeavesOut(effect); }
  bool IsOn(radiometry::Effect effect) const; // by wish, whether it is there or not, and drawn

  /// Takes out of the lights what is left out. True where that changed something.
  bool LeaveOut(CollectedLights& lights) const;

private:
  FrameFacts Facts;
  bool Known = false;
  std::vector<double> BoundKey;
  // Shared with whoever reads it (the mapper); another one when something is decided.
  std::shared_ptr<radiometry::EffectPlan> Decided;
  std::shared_ptr<radiometry::EffectPlan> Undropped; // before Auto left anything out
};

} // namespace vtkradiometry

#endif
// VTK-HeaderTest-Exclude: PictureEffects.h
