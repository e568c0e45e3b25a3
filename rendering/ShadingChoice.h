// SPDX-License-Identifier: BSD-3-Clause
#ifndef ShadingChoice_h
#define ShadingChoice_h

#include "radiometry/shading/ShadingBound.h"

#include <chrono>
#include <cstddef>
#include <vector>

namespace vtkradiometry
{

/// Which triangles Gouraud shading serves as well as Phong shading: the decision of Shading Auto,
/// spread over frames so that it never costs more than its share of their time.
///   A decision belongs to one scene: lights, material, transform, tolerance, and the eye where there
///   are highlights. It begins when a scene is met for the second time running, and is kept until
///   another one is met; until it is complete everything is Phong.
class ShadingChoice
{
public:
  enum class State
  {
    Changing, // the scene is another one than in the frame before
    Deciding,
    Decided
  };

  /// The triangles in the order in which they are drawn, in object coordinates.
  void SetMesh(radiometry::ShadedMesh&& mesh);
  const radiometry::ShadedMesh& Mesh() const { return this->Object; }

  /// Once a frame: goes on deciding for at most `share` of the time since the last call (of 1 s
  /// where that is longer). A share of 1e6 and more: all at once, for the first frame, too.
  ///   objectToWorld   row by row; the scene is in world coordinates
  State Decide(const radiometry::ShadedScene& scene, const double* objectToWorld,
    double tolerance, double share);

  std::size_t Done() const { return this->Next; }      // triangles that are decided
  std::size_t Gouraud() const { return this->Marked; } // of these, those for Gouraud
  const std::vector<float>& Flags() const { return this->Marks; } // 1 Gouraud, 0 Phong; if Decided
  std::size_t Version() const { return this->Decision; } // another one, other flags
  void Reset();

private:
  void PlaceMesh(const double* objectToWorld);

  radiometry::ShadedMesh Object;
  radiometry::ShadedMesh World;
  std::vector<double> Key; // all numbers of the scene that is decided for
  std::vector<double> Last;
  std::vector<float> Marks;
  std::size_t Next = 0;
  std::size_t Marked = 0;
  std::size_t Decision = 0;
  std::chrono::steady_clock::time_point Time;
};

} // namespace vtkradiometry

#endif
// VTK-HeaderTest-Exclude: ShadingChoice.h
