// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPhongGouraudHelper
 * @brief   private: draws the blocks of a vtkPhongGouraudMapper that share a layout
 *
 * Generates the shaders from rendering/glsl, gathers the lights, and keeps three texture buffers:
 * the lights, the frames (normal and centre) of cells, the field of cells.
 */
#ifndef vtkPhongGouraudHelper_h
#define vtkPhongGouraudHelper_h

#include "BandColors.h"
#include "ColorSteps.h"
#include "LightCollector.h"
#include "PictureEffects.h"
#include "ShadingChoice.h"
#include "ShaderTemplate.h"

#include "vtkPhongGouraudBase.h"

#include <array>
#include <map>
#include <string>
#include <vector>

class vtkOpenGLBufferObject;
class vtkPhongGouraudMapper;
class vtkTextureObject;

class vtkPhongGouraudHelper : public vtkradiometry::HelperBase
{
public:
  static vtkPhongGouraudHelper* New();
  vtkTypeMacro(vtkPhongGouraudHelper, vtkradiometry::HelperBase);

  void ReleaseGraphicsResources(vtkWindow* win) override;

protected:
  vtkPhongGouraudHelper() = default;
  ~vtkPhongGouraudHelper() override;

  using ShaderMap = std::map<vtkShader::Type, vtkShader*>;

  bool GetNeedToRebuildShaders(
    vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act) override;
  void BuildShaders(ShaderMap shaders, vtkRenderer* ren, vtkActor* act) override;
  void ReplaceShaderValues(ShaderMap shaders, vtkRenderer* ren, vtkActor* act) override;
  void ReplaceShaderColor(ShaderMap shaders, vtkRenderer* ren, vtkActor* act) override;
  void ReplaceShaderEdges(ShaderMap shaders, vtkRenderer* ren, vtkActor* act) override;
  void ReplaceShaderNormal(ShaderMap shaders, vtkRenderer* ren, vtkActor* act) override;
  void ReplaceShaderLight(ShaderMap shaders, vtkRenderer* ren, vtkActor* act) override;
  void SetPropertyShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act) override;
  void SetCameraShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act) override;
  void SetLightingShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act) override;

  bool GetNeedToRebuildBufferObjects(vtkRenderer* ren, vtkActor* act) override;
  void BuildBufferObjects(vtkRenderer* ren, vtkActor* act) override;
  void AppendOneBufferObject(vtkRenderer* ren, vtkActor* act, vtkradiometry::DrawnBlock* drawn,
    vtkIdType& flatIndex, std::vector<unsigned char>& colors, std::vector<float>& norms) override;
  void RenderPieceStart(vtkRenderer* ren, vtkActor* act) override;
  void RenderPieceFinish(vtkRenderer* ren, vtkActor* act) override;

private:
  /// A texture that shaders read as a plain array of RGBA floats.
  struct FloatBuffer
  {
    vtkTextureObject* Texture = nullptr;
    vtkOpenGLBufferObject* Buffer = nullptr;
    std::vector<float> Values; // what was uploaded last

    void Upload(vtkRenderer* ren, std::vector<float>&& values);
    void Activate();
    void Deactivate();
    void Release(vtkWindow* win);
    void Free();
  };

  /// The blocks in the order in which they are drawn.
  std::vector<vtkradiometry::DrawnBlock*> Blocks() const;

  std::array<FloatBuffer*, 9> Buffers()
  {
    return { { &this->LightBuffer, &this->FrameBuffer, &this->FieldBuffer, &this->MaterialBuffer,
      &this->MaterialOfCellBuffer, &this->StepBuffer, &this->CellColorBuffer,
      &this->VisibilityBuffer, &this->ShadingBuffer } };
  }

  vtkPhongGouraudMapper* Mapper() const;
  /// Polygons in an ordinary pass: everything else is drawn by VTK.
  bool DrawsItself(vtkOpenGLHelper& cellBO, vtkActor* act);
  bool HasPointNormals();
  bool UsesScalarColors();
  /// Everything that decides the text of the shaders.
  vtkradiometry::ShaderFeatures Needs(vtkRenderer* ren, vtkActor* act);
  void NeedLights(vtkradiometry::ShaderFeatures& needs, vtkActor* act);
  int ChooseShading(const vtkradiometry::ShaderFeatures& needs, bool highlights);
  void NeedShading(vtkradiometry::ShaderFeatures& needs, int shading);
  /// The lights of this frame; what is left of them, packed.
  vtkradiometry::CollectedLights CollectLights(vtkRenderer* ren);
  void PackLights(vtkActor* act, const vtkradiometry::CollectedLights& collected);
  /// The effect plan of this frame; takes out of the lights what it leaves out.
  void PlanEffects(vtkRenderer* ren, vtkActor* act, vtkradiometry::CollectedLights& collected);
  vtkradiometry::FrameFacts FactsOf(
    vtkRenderer* ren, vtkActor* act, const vtkradiometry::CollectedLights& collected);
  vtkradiometry::BoundedPicture PictureOf(
    vtkRenderer* ren, vtkActor* act, const vtkradiometry::CollectedLights& collected);
  void NoteMaterials(vtkActor* act, vtkradiometry::BoundedPicture& picture);
  const std::vector<radiometry::SurfaceBox>& BoxesOfSurface();
  bool MapperEmits();
  bool IsTranslucent(vtkActor* act);
  void PlaceOrigin(vtkRenderer* ren, vtkMatrix4x4* objectToWorld);
  /// Shading Auto: the triangles to decide about, what they are lit by, and once a frame the choice.
  void BuildChoice(vtkActor* act);
  /// ... with all effects; without those that the plan leaves out.
  radiometry::ShadedScene SceneOf(
    vtkRenderer* ren, vtkActor* act, const vtkradiometry::CollectedLights& collected);
  radiometry::ShadedScene DrawnSceneOf(
    vtkRenderer* ren, vtkActor* act, const vtkradiometry::CollectedLights& collected);
  void DecideShading(
    vtkRenderer* ren, vtkActor* act, const vtkradiometry::CollectedLights& collected);
  void ReportShading();
  void AppendField(vtkPolyData* block, bool newPoints);
  void BuildCellBuffers(vtkRenderer* ren, vtkActor* act);
  void BuildMaterials(vtkRenderer* ren, vtkActor* act);
  /// The field of a block and its back's (the front's where it has none of its own).
  struct BlockField
  {
    vtkDataArray* Front = nullptr;
    vtkDataArray* Back = nullptr;
    bool OfCells = false;
  };
  BlockField FindField(vtkPolyData* block);
  void NoteField(const std::array<double, 3>& rgb)
  {
    for (const double c : rgb)
    {
      this->FieldMost = c > this->FieldMost ? c : (-c > this->FieldMost ? -c : this->FieldMost);
    }
  }
  void AppendPointField(const char* attribute, vtkDataArray* field, vtkIdType points,
    const vtkradiometry::BandColors& colors);
  /// What the bands of a block's field look like.
  vtkradiometry::BandColors ColorsOfField(vtkPolyData* block);
  /// False colour: what a block's colours are mapped from, and through what.
  struct BlockScalars
  {
    vtkAbstractArray* Array = nullptr;
    vtkScalarsToColors* Map = nullptr;
    bool OfCells = false;
    bool AreColors = false; // nothing between two points can be mapped: their colours are mixed
  };
  BlockScalars FindScalars(vtkPolyData* block);
  /// LightVisibility of a block: for each of VisibilityKeys its component there, or -1.
  struct BlockVisibility
  {
    vtkDataArray* Front = nullptr;
    vtkDataArray* Back = nullptr;
    bool OfCells = false;
    std::vector<int> Components;
  };
  BlockVisibility FindVisibility(vtkPolyData* block);
  void PrepareVisibility();
  void AppendVisibility(vtkPolyData* block, bool newPoints);
  void BuildVisibility(vtkRenderer* ren, vtkActor* act);
  void NoteVisibilityLoss();
  void AssignVisibility(vtkradiometry::CollectedLights& collected);
  void NeedVisibility(vtkradiometry::ShaderFeatures& needs) const;
  /// Field mode with highlights: is there a block whose cells have a material of their own?
  bool HighlightsOfCells();
  /// Field mode: is there a material that has highlights?
  bool Shines(vtkActor* act);
  void PrepareFalseColor();
  void AppendScalars(vtkPolyData* block, bool newPoints);
  void BuildFalseColor(vtkRenderer* ren, vtkActor* act);

  vtkradiometry::LocalCoordinates Local;
  vtkradiometry::PackedLights Lights;
  vtkradiometry::ShaderFeatures Features; // of the primitive that is being drawn
  std::map<const vtkOpenGLHelper*, std::string> Signatures;
  bool Ours = false; // of the primitive that is being drawn
  bool FieldOfCells = false;
  bool FieldOfPoints = false;
  bool FieldOfBack = false; // some block has a field for its back
  bool MaterialsOfHighlights = false; // field mode: some block has materials
  bool SpecularMaterials = false; // some cell's material has a highlight
  bool EmittingMaterials = false; // ... gives light
  bool SpectralMaterials = false; // ... is made of bands
  bool SpectralField = false;
  double FieldMost = 0.0; // greatest absolute colour of the field, before FieldScale
  bool ConstantInCells = false; // one normal at all points of each cell

  // Effects
  vtkradiometry::PictureEffects Effects;
  std::vector<radiometry::SurfaceBox> Boxes; // of the triangles, some each, in object coordinates
  bool BoxesMade = false;
  bool Translucent = false; // at this time
  vtkMTimeType TranslucentTime = 0;

  // Shading Auto
  vtkradiometry::ShadingChoice Choice;
  std::vector<std::size_t> ChoiceTexels; // where the flag of each of its triangles is
  int AutoUses = 2;                      // PHONG, GOURAUD or AUTO: some triangles each
  std::string AutoReason;
  std::size_t ShadingVersion = 0; // the decision that ShadingBuffer holds
  // Of blocks in whose points others may share: the field they were drawn with.
  std::map<vtkDataArray*, vtkDataArray*> FieldOfShared;

  // Known shadows
  std::vector<vtkradiometry::LightKey> VisibilityKeys; // the columns of shares
  bool VisibilityOfCells = false;
  bool VisibilityOfBack = false;
  int VisibilityGroupsOfPoints = 0; // four lights each
  std::vector<double> VisibilityLoss; // greatest |1 - share| of each column

  // False colour
  bool ScalarsOfCells = false;
  bool ScalarsOfPoints = false;
  bool ScalarsMissing = false; // of some block
  bool PointColors = false;    // points have colours, not scalars
  vtkradiometry::ColorSteps Steps;
  const vtkScalarsToColors* StepsMap = nullptr; // what Steps was built of, and when
  vtkTimeStamp StepsTime;
  std::map<vtkDataArray*, vtkAbstractArray*> ScalarsOfShared;

  FloatBuffer LightBuffer;
  FloatBuffer FrameBuffer;
  FloatBuffer FieldBuffer;
  FloatBuffer ShadingBuffer; // a flag for each triangle, four a texel
  FloatBuffer MaterialBuffer;       // the materials
  FloatBuffer MaterialOfCellBuffer; // which one a triangle has
  FloatBuffer StepBuffer;           // of the colour map
  FloatBuffer CellColorBuffer;      // false colours of triangles
  FloatBuffer VisibilityBuffer;     // shares of lights at triangles

  vtkPhongGouraudHelper(const vtkPhongGouraudHelper&) = delete;
  void operator=(const vtkPhongGouraudHelper&) = delete;
};

#endif
// VTK-HeaderTest-Exclude: vtkPhongGouraudHelper.h
