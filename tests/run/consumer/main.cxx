// SPDX-License-Identifier: BSD-3-Clause
// Uses a filter class and a core header of the installed project: 1 W/sr seen as 1 W/sr.
#include "radiometry/scene/Vec3.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointLightSource.h"
#include "vtkPolyData.h"

int main()
{
  vtkNew<vtkPointLightSource> light;
  light->SetPosition(1.0, 2.0, 3.0);
  light->Update();
  vtkDataArray* intensity = light->GetOutput()->GetPointData()->GetArray("Intensity");
  const radiometry::Vec3 direction{ 0.0, 0.0, 1.0 };
  double place[3];
  light->GetOutput()->GetPoint(0, place);
  return intensity && intensity->GetComponent(0, 0) == 1.0 && place[2] * direction.z == 3.0 ? 0 : 1;
}
