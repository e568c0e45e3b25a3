// SPDX-License-Identifier: BSD-3-Clause
#ifndef ExtendedLightReader_h
#define ExtendedLightReader_h

#include "radiometry/scene/CandelaWeb.h"
#include "radiometry/shading/ExtendedLights.h"

#include "vtkType.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkDataArray;
class vtkPolyData;

namespace vtkradiometry
{

struct AreaLight
{
  std::vector<vtkIdType> Points; // the first is the one whose arrays count
  std::vector<radiometry::Vec3> Corners;
  bool TwoSided = false;
};

/// Reads what point-like lights do not have: candela webs, polygons, skies (docs/arrays.md). What is
/// costly to make is kept between frames while the arrays do not change.
///   Fails   radiometry::InputError naming array, index and value
class ExtendedLightReader
{
public:
  explicit ExtendedLightReader(vtkPolyData* lights);

  /// The web of a point light; null: it has none.
  std::shared_ptr<const radiometry::CandelaWeb> Web(vtkIdType light);
  std::shared_ptr<const radiometry::SkyQuadric> Sky(
    vtkIdType light, const radiometry::Vec3& direction, const radiometry::Vec3& reference);
  /// All polygons of three points and more.
  std::vector<AreaLight> Areas();

private:
  double Value(const char* name, vtkIdType light, int component, double absent) const;
  vtkDataArray* Field(const std::string& name) const;
  std::shared_ptr<const radiometry::SkyRadiance> Radiance(
    vtkIdType light, const radiometry::SkyFrame& frame) const;

  vtkPolyData* Data;
};

} // namespace vtkradiometry

#endif
// VTK-HeaderTest-Exclude: ExtendedLightReader.h
