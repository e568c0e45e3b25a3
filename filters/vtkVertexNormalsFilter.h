// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkVertexNormalsFilter_h
#define vtkVertexNormalsFilter_h

#include "vtkPassInputTypeAlgorithm.h"
#include "vtkRadiometryFiltersModule.h"

/// Normals at the points of a surface for smooth shading: averaged over the cells around each point,
/// with points repeated along creases.
///   Reads   polydata, or composite data of polydata
///   Writes  point data Normals (3 components, float64, unit length; zero at points that belong to no
///           cell with an area), as the active normals; with ComputeCellNormals cell data Normals.
///           All other data is carried along; strips become triangles
///   Model   n = sum w_c n_c / |sum w_c n_c| over the cells c at the point; n_c by the right-hand
///           rule, of concave and not quite flat polygons by their vector area (Newell)
///   Limits  the order of a cell's points decides its front: faces are not turned. Cells of other
///           processes do not count
///   Cost    O(corners); docs/physics/shading.md has times
///   Source  Thuermer and Wuethrich 1998 (by angle)
///   Fails   coordinates that are not finite, blocks that are no polydata: an error that names them,
///           an empty output
class VTKRADIOMETRYFILTERS_EXPORT vtkVertexNormalsFilter : public vtkPassInputTypeAlgorithm
{
public:
  static vtkVertexNormalsFilter* New();
  vtkTypeMacro(vtkVertexNormalsFilter, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Values of Weighting.
  enum Weightings
  {
    Angle = 0,
    Area = 1,
    Uniform = 2
  };
  ///@{
  /// What a cell counts at its points: the angle of its corner there (the same however a face is cut
  /// into triangles), its area, or one. Default Angle.
  vtkSetClampMacro(Weighting, int, Angle, Uniform);
  vtkGetMacro(Weighting, int);
  ///@}

  ///@{
  /// Whether points are repeated along creases, and along edges where more than two cells meet, so
  /// that each copy has the normal of its own side. Default on.
  vtkSetMacro(Splitting, bool);
  vtkGetMacro(Splitting, bool);
  vtkBooleanMacro(Splitting, bool);
  ///@}

  ///@{
  /// An edge is a crease where the normals of its two cells make at least this angle, in degrees.
  /// Default 30. In [0, 180].
  vtkSetClampMacro(FeatureAngle, double, 0.0, 180.0);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  ///@{
  /// Whether points with the same coordinates count as one, of other blocks too, so that the seams of
  /// a surface in pieces do not show. The output keeps them apart. Default on.
  vtkSetMacro(MergePoints, bool);
  vtkGetMacro(MergePoints, bool);
  vtkBooleanMacro(MergePoints, bool);
  ///@}

  ///@{
  /// Whether cells get their normals too. Default off.
  vtkSetMacro(ComputeCellNormals, bool);
  vtkGetMacro(ComputeCellNormals, bool);
  vtkBooleanMacro(ComputeCellNormals, bool);
  ///@}

protected:
  vtkVertexNormalsFilter() = default;
  ~vtkVertexNormalsFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out) override;

  int Weighting = Angle;
  bool Splitting = true;
  double FeatureAngle = 30.0;
  bool MergePoints = true;
  bool ComputeCellNormals = false;

private:
  vtkVertexNormalsFilter(const vtkVertexNormalsFilter&) = delete;
  void operator=(const vtkVertexNormalsFilter&) = delete;
};

#endif
