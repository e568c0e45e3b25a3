// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadiometricLightRepresentation
 * @brief   ParaView representation "Radiometric Lights": lights that light the picture
 *
 *   Reads   polydata, one vertex a light, in the light arrays of docs/arrays.md
 *   Writes  hands the lights of all visible representations of this kind to the view's renderer
 *           (vtkPhongGouraudMapper::LIGHT_DATA), on every rank, and draws a glyph for each in its
 *           colour: point light three circles, spot its cones, directional light a sun with arrows,
 *           area light its outline, environment a dome; one that is switched off dark grey
 *   Limits  a light is where its data says: position, orientation and scale of the representation do
 *           not move it; a hidden block gives no light; lights attached to the camera have no glyph
 */
#ifndef vtkRadiometricLightRepresentation_h
#define vtkRadiometricLightRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkRadiometryRenderingParaViewModule.h" // for export macro
#include "vtkSmartPointer.h"                      // for ivars
#include "vtkWeakPointer.h"                       // for ivars

class vtkDataObject;
class vtkMultiBlockDataSet;
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
   * Length of the glyphs in the scene's units. 0 (default): an eighth of the height of the picture, at
   * the distance of the camera's focal point.
   */
  void SetGlyphSize(double size);
  vtkGetMacro(GlyphSize, double);
  ///@}

  ///@{
  /**
   * Are the glyphs drawn (default on)?
   */
  vtkSetMacro(ShowGlyphs, bool);
  vtkGetMacro(ShowGlyphs, bool);
  ///@}

  ///@{
  /**
   * Do the lights light the picture (default on), or are they only drawn?
   */
  vtkSetMacro(Illuminate, bool);
  vtkGetMacro(Illuminate, bool);
  ///@}

  ///@{
  /**
   * Without effect: light comes from where the data says.
   */
  void SetOrientation(double, double, double) override {}
  void SetOrigin(double, double, double) override {}
  void SetPosition(double, double, double) override {}
  void SetScale(double, double, double) override {}
  void SetUserTransform(const double[16]) override {}
  ///@}

protected:
  vtkRadiometricLightRepresentation();
  ~vtkRadiometricLightRepresentation() override;

  bool RemoveFromView(vtkView* view) override;

  /// Puts the lights of this representation among those of the renderer; null takes them away.
  void Offer(vtkRenderer* renderer, vtkMultiBlockDataSet* lights);

  void UpdateGlyphs(vtkDataObject* lights, double size);

  double GlyphSize = 0.0;
  bool ShowGlyphs = true;
  bool Illuminate = true;
  vtkWeakPointer<vtkRenderer> OfferedTo;
  vtkSmartPointer<vtkMultiBlockDataSet> Offered;
  // The glyphs, and what they were made of.
  vtkSmartPointer<vtkDataObject> Glyphs;
  vtkSmartPointer<vtkDataObject> GlyphsOf;
  vtkMTimeType GlyphsTime = 0;
  double GlyphsSize = -1.0;

private:
  vtkRadiometricLightRepresentation(const vtkRadiometricLightRepresentation&) = delete;
  void operator=(const vtkRadiometricLightRepresentation&) = delete;
};

#endif
