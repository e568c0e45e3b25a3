// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadiometricSurfaceRepresentation
 * @brief   ParaView representation "Radiometric Surface": vtkPhongGouraudMapper in a render view
 *
 *   Reads   every kind of data that ParaView shows as a surface, composite data too
 *   Lights  all data shown as "Radiometric Lights" in the same view, else the view's own lights
 *   Fails   as the mapper does
 *
 * With FieldDisplay and MaterialSource on Auto the data decides what is drawn, the first that some
 * block has (of its cells, its points or as field data of the block):
 *   Radiance, Radiosity/pi, Luminance/K, LuminousExitance/(pi K)   that field as light, W/(m^2 sr);
 *   a material array of docs/arrays.md                             those materials, lit;
 *   else                                                           the property's material, lit.
 * K is the field array LuminousEfficacy, else 683.002 lm/W.
 *
 * Each other property is the mapper's of the same name; meanings and ranges are written there.
 */
#ifndef vtkRadiometricSurfaceRepresentation_h
#define vtkRadiometricSurfaceRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkRadiometryRenderingParaViewModule.h" // for export macro

#include <string> // for ivars

class vtkDataObject;
class vtkMapper;

class VTKRADIOMETRYRENDERINGPARAVIEW_EXPORT vtkRadiometricSurfaceRepresentation
  : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkRadiometricSurfaceRepresentation* New();
  vtkTypeMacro(vtkRadiometricSurfaceRepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int ProcessViewRequest(vtkInformationRequestKey* request, vtkInformation* inInfo,
    vtkInformation* outInfo) override;

  enum
  {
    DISPLAY_AUTO = -1 // else a vtkPhongGouraudMapper::FieldModeType other than FIELD_MATERIALS
  };
  enum MaterialSourceType
  {
    MATERIAL_AUTO = 0,
    MATERIAL_OF_DATA = 1,
    MATERIAL_OF_PROPERTY = 2
  };

  ///@{
  /**
   * What the surface shows: DISPLAY_AUTO (default), or a field mode of the mapper. With FIELD_OFF it
   * is lit by the lights.
   */
  void SetFieldDisplay(int display);
  vtkGetMacro(FieldDisplay, int);
  ///@}

  ///@{
  /**
   * On (default): where DISPLAY_AUTO shows light that was computed for cells, interpolate it between
   * the corners of smooth surfaces (SmoothField.h). Off: constant over each cell.
   */
  void SetSmoothCells(bool smooth);
  vtkGetMacro(SmoothCells, bool);
  ///@}

  ///@{
  /**
   * The material of a lit surface: that of the data where it has one (default), always that of the
   * data, or always that of the property (its colour, specular, ...).
   */
  vtkSetClampMacro(MaterialSource, int, MATERIAL_AUTO, MATERIAL_OF_PROPERTY);
  vtkGetMacro(MaterialSource, int);
  ///@}

  ///@{
  /**
   * Forwarded to the mappers.
   */
  void SetShading(int shading);
  void SetShadingTolerance(double tolerance);
  void SetShadingTimeShare(double share);
  void SetReflectionModel(int model);
  void SetLocalViewer(bool local);
  void SetTwoSided(bool twoSided);
  void SetGlobalAmbient(double r, double g, double b);
  void SetEmission(double r, double g, double b);
  void SetLightScale(double scale);
  void SetMetersPerUnit(double meters);
  void SetHighlights(bool on);
  void SetUseLightVisibility(bool on);
  void SetEffectTolerance(double tolerance);
  ///@}

  ///@{
  /**
   * The mappers' SetEffectSwitch of one effect: as the scene calls for it (0, default), on (1), off (2).
   */
  void SetSpecularEffect(int value) { this->SwitchEffect("Specular", value); }
  void SetAmbientEffect(int value) { this->SwitchEffect("GlobalAmbient", value); }
  void SetTwoSidedEffect(int value) { this->SwitchEffect("TwoSided", value); }
  void SetLocalViewerEffect(int value) { this->SwitchEffect("LocalViewer", value); }
  void SetTranslucencyEffect(int value) { this->SwitchEffect("Translucency", value); }
  void SetEmissionEffect(int value) { this->SwitchEffect("Emission", value); }
  void SetSpotShapeEffect(int value) { this->SwitchEffect("SpotShape", value); }
  void SetAttenuationEffect(int value) { this->SwitchEffect("Attenuation", value); }
  void SetOcclusionEffect(int value) { this->SwitchEffect("Occlusion", value); }
  ///@}

  ///@{
  /**
   * The array that is drawn where FieldDisplay asks for one, as ParaView names arrays: only
   * association (0 points, 1 cells) and name count (empty: none); and the factor on it. Auto uses the
   * factor, not the array.
   */
  void SetFieldArray(int index, int port, int connection, int association, const char* name);
  vtkSetMacro(FieldScale, double);
  vtkGetMacro(FieldScale, double);
  ///@}

  ///@{
  /**
   * What the last frame was drawn with: "Flat", "Gouraud", "Phong", or "Auto" for some triangles each;
   * which share of them Gouraud, and why; and what the frame showed, in words.
   */
  const char* GetShadingUsed();
  double GetGouraudShare();
  const char* GetShadingReason();
  /// Effect by effect, why the last frame carried it or not, and what leaving it out changes.
  const char* GetEffectsExplained();
  const char* GetFieldUsed() { return this->FieldUsed.c_str(); }
  ///@}

protected:
  vtkRadiometricSurfaceRepresentation();
  ~vtkRadiometricSurfaceRepresentation() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  void SwitchEffect(const char* effect, int value);
  /// Sets a mapper's field mode, array and scale for the data that it draws.
  void ChooseField(vtkMapper* mapper, vtkDataObject* data);

  int FieldDisplay = DISPLAY_AUTO;
  bool SmoothCells = true;
  int MaterialSource = MATERIAL_AUTO;
  int FieldAssociation = 0;
  std::string FieldArrayName;
  double FieldScale = 1.0;
  std::string FieldUsed;

private:
  vtkRadiometricSurfaceRepresentation(const vtkRadiometricSurfaceRepresentation&) = delete;
  void operator=(const vtkRadiometricSurfaceRepresentation&) = delete;
};

#endif
