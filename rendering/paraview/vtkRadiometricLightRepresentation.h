// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadiometricLightRepresentation
 * @brief   ParaView representation "Radiometric Lights": lights that light the picture
 *
 *   Reads   polydata, one vertex a light, in the light arrays of docs/arrays.md
 *   Writes  hands the lights of all visible representations of this kind to the view's renderer
 *           (vtkPhongGouraudMapper::LIGHT_DATA), on every rank, and draws a glyph for each:
 *           point light three circles, spot its cone, directional light a disc with arrows
 *   Limits  glyphs have one size, GlyphSize, in the scene's units
 */
#ifndef vtkRadiometricLightRepresentation_h
#define vtkRadiometricLightRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkNew.h"                               // for ivars
#include "vtkRadiometryRenderingParaViewModule.h" // for export macro
#include "vtkSmartPointer.h"                      // for ivars
#include "vtkWeakPointer.h"                       // for ivars

class vtkPolyData;
class vtkRenderer;

class VTKRADIOMETRYRENDERINGPARAVIEW_EXPORT vtkRadiometricLightRepresentation
  : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkRadiometricLightRepresentation* New();
  vtkTypeMacro(vtkRadiometricLightRepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int ProcessViewRequest(vtkInformationRequestKey* request_type, vtkInformation* inInfo,
    vtkInformation* outInfo) override;
  void SetVisibility(bool visible) override;

  ///@{
  /**
   * Length of the glyphs in the scene's units. Default 0.25; 0 draws none.
   */
  void SetGlyphSize(double size);
  vtkGetMacro(GlyphSize, double);
  ///@}

  ///@{
  /**
   * Do the lights light the picture (default on), or are they only drawn?
   */
  vtkSetMacro(Illuminate, bool);
  vtkGetMacro(Illuminate, bool);
  ///@}

protected:
  vtkRadiometricLightRepresentation();
  ~vtkRadiometricLightRepresentation() override;

  bool RemoveFromView(vtkView* view) override;

  /// Puts the lights of this representation among those of the renderer; null takes them away.
  void Offer(vtkRenderer* renderer, vtkDataObject* lights);

  void UpdateGlyphs(vtkDataObject* lights);

  double GlyphSize = 0.25;
  bool Illuminate = true;
  vtkWeakPointer<vtkRenderer> OfferedTo;
  vtkSmartPointer<vtkDataObject> Offered;
  vtkMTimeType OfferedTime = 0;
  // The glyphs, and what they were made of.
  vtkNew<vtkPolyData> Glyphs;
  vtkSmartPointer<vtkDataObject> GlyphsOf;
  vtkMTimeType GlyphsTime = 0;
  double GlyphsSize = -1.0;

private:
  vtkRadiometricLightRepresentation(const vtkRadiometricLightRepresentation&) = delete;
  void operator=(const vtkRadiometricLightRepresentation&) = delete;
};

#endif
