// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadiometricSurfaceRepresentation
 * @brief   ParaView representation "Radiometric Surface": vtkPhongGouraudMapper in a render view
 *
 *   Reads   polydata, unstructured, uniform, structured and composite data
 *   Lights  all data shown as "Radiometric Lights" in the same view, else the view's own lights
 *   Fails   as the mapper does
 *
 * Each property is the mapper's of the same name; meanings and ranges are written there.
 */
#ifndef vtkRadiometricSurfaceRepresentation_h
#define vtkRadiometricSurfaceRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkRadiometryRenderingParaViewModule.h" // for export macro

class VTKRADIOMETRYRENDERINGPARAVIEW_EXPORT vtkRadiometricSurfaceRepresentation
  : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkRadiometricSurfaceRepresentation* New();
  vtkTypeMacro(vtkRadiometricSurfaceRepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Forwarded to the mappers.
   */
  void SetShading(int shading);
  void SetReflectionModel(int model);
  void SetLocalViewer(bool local);
  void SetTwoSided(bool twoSided);
  void SetGlobalAmbient(double r, double g, double b);
  void SetEmission(double r, double g, double b);
  void SetLightScale(double scale);
  void SetMetersPerUnit(double meters);
  void SetFieldMode(int mode);
  void SetFieldScale(double scale);
  ///@}

  /**
   * The array that is drawn, as ParaView names arrays: only association (0 points, 1 cells) and
   * name count. An empty name: none.
   */
  void SetFieldArray(int index, int port, int connection, int association, const char* name);

protected:
  vtkRadiometricSurfaceRepresentation();
  ~vtkRadiometricSurfaceRepresentation() override;

private:
  vtkRadiometricSurfaceRepresentation(const vtkRadiometricSurfaceRepresentation&) = delete;
  void operator=(const vtkRadiometricSurfaceRepresentation&) = delete;
};

#endif
