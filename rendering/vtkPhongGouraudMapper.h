// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPhongGouraudMapper
 * @brief   draws polygons with the project's lighting model, in scene-linear light
 *
 *   Reads   vtkPolyData, or a tree of composite data of them; point Normals for smooth shading;
 *           a float array of any name and number of bands in field mode (point or cell data)
 *   Lights  the arrays of docs/arrays.md, from, in this order: SetLightData(); the polydata under
 *           LIGHT_DATA() in the renderer's Information; the renderer's vtkLights
 *   Writes  scene-linear RGB without clamping (a float frame buffer keeps it: vtkLinearFloatPass)
 *   Model   radiometry/shading/LightingModel.h; the material is the actor's vtkProperty (and its
 *           back-face property), scalar colours and block colours as usual
 *   Cost    Flat and Phong O(pixels x lights), Gouraud O(vertices x lights); the generated shader
 *           holds only what the lights and the material need
 *           Luminaires have their candela webs, area lights their exact diffuse light (Lambert's
 *           contour formula), environments a quadratic function of the normal; neither of the two has
 *           highlights (ExtendedLights.h)
 *   Shadows as far as the surface knows them: LightVisibility (UseLightVisibility)
 *   Fails   a light that cannot be drawn is left out and named by an error event, once
 *
 * Points, lines, edges, vertices and selection are drawn by VTK as always.
 */
#ifndef vtkPhongGouraudMapper_h
#define vtkPhongGouraudMapper_h

#include "vtkPhongGouraudBase.h"
#include "vtkRadiometryRenderingModule.h" // for export macro
#include "vtkSmartPointer.h"              // for ivars
#include "vtkWeakPointer.h"               // for ivars

#include <memory> // for ivars
#include <string> // for ivars
#include <vector> // for ivars

namespace radiometry
{
class EffectPlan;
}
class vtkInformationObjectBaseKey;
class vtkPolyData;
class vtkRenderWindow;
class vtkRenderer;
class vtkTable;

class VTKRADIOMETRYRENDERING_EXPORT vtkPhongGouraudMapper : public vtkPhongGouraudMapperBase
{
public:
  static vtkPhongGouraudMapper* New();
  vtkTypeMacro(vtkPhongGouraudMapper, vtkPhongGouraudMapperBase);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Takes over another mapper's settings, the project's own too where it is one.
   */
  void ShallowCopy(vtkAbstractMapper* other) override;

  /**
   * Draws. What lies on the graphics processor belongs to one window: a mapper that is drawn in
   * several by turns is uploaded anew at each turn.
   */
  void Render(vtkRenderer* renderer, vtkActor* actor) override;

  enum ShadingType
  {
    FLAT = 0,
    GOURAUD = 1,
    PHONG = 2,
    AUTO = 3
  };
  enum ReflectionModelType
  {
    BLINN_PHONG = 0,
    REFLECTED_PHONG = 1,
    PHYSICAL = 2
  };
  enum FieldModeType
  {
    FIELD_OFF = 0,
    FIELD_ON = 1,
    FIELD_NORMALS = 2,
    FIELD_REFLECTANCE = 3,
    FIELD_MATERIALS = 4,
    FIELD_FALSE_COLOR = 5
  };

  ///@{
  /**
   * Where the lighting model is evaluated.
   * Flat: once a cell, at its centre with its own normal, one colour for the whole cell.
   * Gouraud: at each vertex with the point's normal; the light is interpolated, then multiplied by
   * the material. Phong: at each pixel with the interpolated normal.
   * Auto (default): Gouraud for the triangles where a proven bound says that it cannot differ from
   * Phong by more than ShadingTolerance, Phong for the others, and Phong for all where that is not
   * slower (docs/rendering/mapper.md). Without point normals Gouraud and Phong use the cell's normal
   * at each pixel.
   */
  void SetShading(int shading);
  vtkGetMacro(Shading, int);
  void SetShadingToFlat() { this->SetShading(FLAT); }
  void SetShadingToGouraud() { this->SetShading(GOURAUD); }
  void SetShadingToPhong() { this->SetShading(PHONG); }
  void SetShadingToAuto() { this->SetShading(AUTO); }
  ///@}

  ///@{
  /**
   * Shading Auto: greatest difference from Phong shading that a triangle's Gouraud shading may have,
   * in the unit of the colours that this mapper writes (after LightScale, before any display
   * transform). Default 0.5/255, half a step of 8 bits where 1 is shown as white; a display of
   * exposure x needs that over x. 0: only where both are the same.
   */
  vtkSetClampMacro(ShadingTolerance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(ShadingTolerance, double);
  ///@}

  ///@{
  /**
   * Shading Auto: share of the time between frames that deciding may take; until it is done, and
   * while what it depends on changes from frame to frame, all is Phong. Default 0.02. 0: never
   * decide. 1e6 and more: at once, before the frame, which makes pictures repeatable.
   */
  vtkSetClampMacro(ShadingTimeShare, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(ShadingTimeShare, double);
  ///@}

  ///@{
  /**
   * What the last frame was drawn with. ShadingUsed: FLAT, GOURAUD or PHONG for all, AUTO for some
   * triangles each; GouraudShare: share of the triangles for Gouraud; ShadingReason: why, in words.
   */
  vtkGetMacro(ShadingUsed, int);
  double GetGouraudShare() const
  {
    return this->CountedTriangles > 0.0 ? this->GouraudTriangles / this->CountedTriangles : 0.0;
  }
  const char* GetShadingReason() { return this->ShadingReason.c_str(); }
  ///@}

  ///@{
  /**
   * Draws the renderer's window twice into float targets, as it is set and with Phong shading (and
   * without EffectTolerance), and returns the greatest difference of any colour at any pixel; negative where it cannot. Shading
   * Auto decides at once for it. The result is kept: GreatestDifference, negative before the first.
   */
  double MeasureGreatestDifference(vtkRenderer* renderer);
  vtkGetMacro(GreatestDifference, double);
  ///@}

  ///@{
  /**
   * How light becomes colour. Physical (default): the radiance of a Lambertian surface with an
   * energy-conserving Phong lobe, rho/pi E + rho_s (n+2)/(2 pi) cos^n E.
   * BlinnPhong and Phong: the legacy fixed-function models, highlights by N.H and by R.V.
   */
  vtkSetClampMacro(ReflectionModel, int, BLINN_PHONG, PHYSICAL);
  vtkGetMacro(ReflectionModel, int);
  void SetReflectionModelToBlinnPhong() { this->SetReflectionModel(BLINN_PHONG); }
  void SetReflectionModelToPhong() { this->SetReflectionModel(REFLECTED_PHONG); }
  void SetReflectionModelToPhysical() { this->SetReflectionModel(PHYSICAL); }
  ///@}

  ///@{
  /**
   * Ambient light of the scene, radiance, scene-linear RGB; the material's Ambient (0 by default)
   * multiplies it. Default (1, 1, 1), as in VTK. Any finite value.
   */
  vtkSetVector3Macro(GlobalAmbient, double);
  vtkGetVector3Macro(GlobalAmbient, double);
  ///@}

  ///@{
  /**
   * On (default): highlights use the direction to the eye from each place (to the viewer's side in a
   * parallel projection, where all directions agree). Off: the viewer is infinitely far along the
   * view's axis, as the fixed-function pipeline does by default.
   */
  vtkSetMacro(LocalViewer, bool);
  vtkGetMacro(LocalViewer, bool);
  vtkBooleanMacro(LocalViewer, bool);
  ///@}

  ///@{
  /**
   * On (default): a side seen from behind is lit about its reversed normal, with the actor's
   * back-face property where it has one. Off: both sides show the light of the front. An actor
   * with a back-face property is always two-sided.
   */
  vtkSetMacro(TwoSided, bool);
  vtkGetMacro(TwoSided, bool);
  vtkBooleanMacro(TwoSided, bool);
  ///@}

  ///@{
  /**
   * Radiance that the front (the back) gives of its own, scene-linear RGB. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Emission, double);
  vtkGetVector3Macro(Emission, double);
  vtkSetVector3Macro(BackEmission, double);
  vtkGetVector3Macro(BackEmission, double);
  ///@}

  ///@{
  /**
   * The lights, one vertex a light. Null (default): those that the renderer's Information holds
   * under LIGHT_DATA() (a vtkPolyData or a tree of them), else the renderer's own vtkLights. Changing the polydata's contents moves
   * the lights at the next render and rebuilds nothing.
   */
  virtual void SetLightData(vtkPolyData* lights);
  vtkPolyData* GetLightData();
  static vtkInformationObjectBaseKey* LIGHT_DATA();
  ///@}

  ///@{
  /**
   * Multiplies all lights: the exposure of a picture that is shown without a display transform.
   * Default 1; at least 0.
   */
  vtkSetClampMacro(LightScale, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(LightScale, double);
  ///@}

  ///@{
  /**
   * Metres for each unit of the coordinates, for the fall-off of lights. Default 1; above 0.
   */
  vtkSetClampMacro(MetersPerUnit, double, 1e-300, VTK_DOUBLE_MAX);
  vtkGetMacro(MetersPerUnit, double);
  ///@}

  ///@{
  /**
   * Off (default): the surface is lit by the lights. On: the array FieldArrayName times FieldScale
   * is the colour, scene-linear and without clamping: one band grey, three RGB, other numbers
   * through the CIE 1931 observer where field data Wavelengths [nm] stands for as many, else the grey
   * of their mean. Point data is interpolated, cell data is constant over a cell; a block
   * without the array is black. Where the surface is two-sided, an array of that name with "Back"
   * after it (RadiosityBack) is what the back shows; without one, both sides show the same.
   * Reflectance: the array is the diffuse reflectance that the lights
   * light. Normals: the unit normal of the shaded side, in world coordinates, as RGB in [-1, 1].
   * Materials: the lights light the surface arrays of docs/arrays.md (DiffuseReflectance,
   * SpecularReflectance, Shininess, EmittedExitance/pi as radiance, Back... of each, TwoSided), of
   * cells or of a whole block as field data; where an array is missing, the actor's property.
   * With specular reflectance Gouraud becomes Phong: the exponent belongs to the cell.
   * FalseColor: the scalars through their colour map, without light: the colours are for the display
   * as they are (GetSceneLinear() is false), so that the picture shows what the legend shows.
   */
  void SetFieldMode(int mode);
  vtkGetMacro(FieldMode, int);
  void SetFieldModeToOff() { this->SetFieldMode(FIELD_OFF); }
  void SetFieldModeToOn() { this->SetFieldMode(FIELD_ON); }
  void SetFieldModeToNormals() { this->SetFieldMode(FIELD_NORMALS); }
  void SetFieldModeToReflectance() { this->SetFieldMode(FIELD_REFLECTANCE); }
  void SetFieldModeToMaterials() { this->SetFieldMode(FIELD_MATERIALS); }
  void SetFieldModeToFalseColor() { this->SetFieldMode(FIELD_FALSE_COLOR); }
  void SetFieldArrayName(const char* name);
  const char* GetFieldArrayName() { return this->FieldArrayName.c_str(); }
  ///@}

  ///@{
  /**
   * Where the field is: -1 (default) in the point data or else in the cell data, 0 point data,
   * 1 cell data.
   */
  void SetFieldAssociation(int association);
  vtkGetMacro(FieldAssociation, int);
  ///@}

  ///@{
  /**
   * On (default): where a surface that shows its field (FieldMode On) is specular, the lights'
   * highlights are added pixel by pixel, by the chosen ReflectionModel; the material is the surface's
   * SpecularReflectance and Shininess (with Back... of each) or else the actor's property. Off: the
   * field alone.
   */
  void SetHighlights(bool on);
  vtkGetMacro(Highlights, bool);
  vtkBooleanMacro(Highlights, bool);
  ///@}

  ///@{
  /**
   * On (default): where the surface knows which share of a light arrives (the arrays LightVisibility
   * and LightVisibilityBack of the simulating filters, at cells or points, with the field data
   * LightVisibilityLights), the light and its highlights are drawn with that share: with shadows.
   * A light that moved since then is drawn without. Shares of cells are constant over a cell, of
   * points interpolated (at most 16 lights, 8 with backs). Gouraud is then drawn as Phong. Off: no
   * shadows.
   */
  void SetUseLightVisibility(bool on);
  vtkGetMacro(UseLightVisibility, bool);
  vtkBooleanMacro(UseLightVisibility, bool);
  ///@}

  ///@{
  /**
   * Multiplies the field. Default 1; any finite value. 1/pi shows a diffuse radiosity as radiance.
   */
  vtkSetMacro(FieldScale, double);
  vtkGetMacro(FieldScale, double);
  ///@}

  ///@{
  /**
   * The text of the shaders that the last frame's polygons were drawn with (empty before the
   * first), and the features that it was generated for, in alphabetical order, separated by
   * spaces. For tests and for the curious.
   */
  const char* GetVertexShaderText() { return this->VertexShaderText.c_str(); }
  const char* GetFragmentShaderText() { return this->FragmentShaderText.c_str(); }
  const char* GetShaderFeatures() { return this->ShaderFeatureText.c_str(); }
  ///@}

  ///@{
  /**
   * Off (default): shaders hold what the scene needs. On: every effect that is on Auto is switched
   * on, for comparing their cost; the picture stays the same.
   */
  vtkSetMacro(EveryEffect, bool);
  vtkGetMacro(EveryEffect, bool);
  vtkBooleanMacro(EveryEffect, bool);
  ///@}

  ///@{
  /**
   * One effect: as the scene calls for it (EFFECT_AUTO, default), on though it is not called for, or
   * off: drawn without. Effects by their names in the effect plan: Specular (highlights),
   * GlobalAmbient (ambient light), TwoSided, LocalViewer, Translucency, Emission, SpotShape (off: spots
   * shine as points), Attenuation (off: the inverse square for all), CandelaWebs (off: luminaires
   * shine as points), PointLights, SpotLights, DirectionalLights, AreaLights, Environment, Occlusion
   * (known shadows); or by their numbers in radiometry::Effect. What LocalViewer, TwoSided, Highlights
   * and UseLightVisibility switch off is off unless the effect is switched on here; EveryEffect
   * switches on whatever is on Auto. Fails: an error event for a name that no effect of a picture has.
   */
  enum EffectSwitchType
  {
    EFFECT_AUTO = 0,
    EFFECT_ON = 1,
    EFFECT_OFF = 2
  };
  void SetEffectSwitch(int effect, int value);
  void SetEffectSwitch(const char* effect, int value);
  int GetEffectSwitch(int effect);
  int GetEffectSwitch(const char* effect);
  ///@}

  ///@{
  /**
   * Effects on Auto are left out, though they are there, where a bound proves that leaving all of them
   * out changes no colour by more than this, in the unit of the colours that this mapper writes. What
   * they may change is taken off ShadingTolerance, so that both stay within the greater of the two.
   * Default 0: only what is not there is left out, which changes no bit of any picture. (A mapper does
   * not know with what exposure its colours will be shown, so no other default is safe.)
   */
  vtkSetClampMacro(EffectTolerance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(EffectTolerance, double);
  ///@}

  ///@{
  /**
   * What the last frame carried and what it left out: a table with a row for each effect (columns
   * Effect, Switch, Decision, Bound, Unit, Seconds, Why), and sentences. Bound: the greatest change of
   * any colour that leaving it out makes; infinite where none can be given. Of several groups of
   * blocks, whatever one of them carries counts.
   */
  vtkTable* GetEffectPlan();
  const char* Explain();
  ///@}

  /**
   * Whether this mapper's colours are light (scene-linear), which a display transform has to encode.
   * False: they are a display's own (a colour map), which no transform may touch.
   */
  bool GetSceneLinear() const { return this->FieldMode != FIELD_FALSE_COLOR; }

  /**
   * How often shaders were generated since the mapper was made.
   */
  vtkGetMacro(NumberOfShaderBuilds, int);

  ///@{
  /**
   * Lights in the last frame: those drawn, and points of area lights (LightType 3) that are no corner
   * of a polygon.
   */
  vtkGetMacro(NumberOfLightsDrawn, int);
  vtkGetMacro(NumberOfLightsNotDrawn, int);
  ///@}

protected:
  vtkPhongGouraudMapper();
  ~vtkPhongGouraudMapper() override;

  vtkPhongGouraudProduct* vtkPhongGouraudFactory() override;

  friend class vtkPhongGouraudHelper;

  /// What is wanted of each effect, by its number, properties taken into account.
  int WishOf(int effect, bool backProperty) const;
  bool WantsHighlights() const;
  bool WantsLightVisibility() const;
  /// The plan of the last frame, all groups of blocks together.
  radiometry::EffectPlan MergedPlan() const;

  int Shading = AUTO;
  int ShadingUsed = PHONG;
  int ReflectionModel = PHYSICAL;
  double GlobalAmbient[3] = { 1.0, 1.0, 1.0 };
  bool LocalViewer = true;
  bool TwoSided = true;
  double Emission[3] = { 0.0, 0.0, 0.0 };
  double BackEmission[3] = { 0.0, 0.0, 0.0 };
  double LightScale = 1.0;
  double MetersPerUnit = 1.0;
  int FieldMode = FIELD_OFF;
  std::string FieldArrayName;
  int FieldAssociation = -1;
  double FieldScale = 1.0;
  bool Highlights = true;
  bool UseLightVisibility = true;
  bool EveryEffect = false;
  std::vector<int> EffectSwitches; // by radiometry::Effect
  double EffectTolerance = 0.0;
  double ShadingTolerance = 0.5 / 255.0;
  double ShadingTimeShare = 0.02;
  double GreatestDifference = -1.0;
  vtkSmartPointer<vtkPolyData> LightData;

  vtkTimeStamp BufferTime;     // of the last change that needs other buffers
  vtkWeakPointer<vtkRenderWindow> Window; // that was drawn in last
  std::vector<std::shared_ptr<const radiometry::EffectPlan>> FramePlans; // of the last frame
  vtkSmartPointer<vtkTable> EffectPlanTable;
  std::string Explanation;
  double GouraudTriangles = 0.0; // of the last frame
  double CountedTriangles = 0.0;
  std::string ShadingReason;
  std::string ReportedProblem; // the defect in the lights that was reported last
  std::string VertexShaderText;
  std::string FragmentShaderText;
  std::string ShaderFeatureText;
  int NumberOfShaderBuilds = 0;
  int NumberOfLightsDrawn = 0;
  int NumberOfLightsNotDrawn = 0;

private:
  vtkPhongGouraudMapper(const vtkPhongGouraudMapper&) = delete;
  void operator=(const vtkPhongGouraudMapper&) = delete;
};

#endif
