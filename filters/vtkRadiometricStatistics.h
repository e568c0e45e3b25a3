// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRadiometricStatistics_h
#define vtkRadiometricStatistics_h

#include "vtkRadiometryFiltersModule.h"
#include "vtkSmartPointer.h" // for Controller
#include "vtkTableAlgorithm.h"

#include <string> // for ArrayNames
#include <vector> // for ArrayNames

class vtkMultiProcessController;

/// Area-weighted statistics of arrays over a surface, its blocks and its groups of cells, and lines
/// of equal value (iso-lux lines).
///   Reads   polydata, or composite data of polydata; the named cell or point arrays (any unit);
///           GroupArray: one integer a cell. Grids of sensors count by the pieces of surface that
///           they stand for (SensorCell), or, where that is missing, one area unit each
///   Writes  output 0: vtkTable, one row for each block, group, array and component: Block, Group
///           (value of GroupArray; -1: all cells of the block), GroupName, Array, Component (-1: the
///           sum of three bands weighted by luminance), Area [m^2], Minimum, Mean, Maximum, U0, Ud,
///           Flux [array's unit times m^2], ShareAbove (and "ShareAbove x" for each further
///           threshold x, and P<p> for each percentile p), Cells. Of composite data a first block "(all)" is the whole. Field data:
///           Threshold
///           output 1: polydata, lines of equal value of one array: cell data Isovalue, Label (value
///           and unit), Length [m]; point data named like the array
///           output 2: vtkTable, one row a level: Isovalue, Label, Length [m], AreaAbove [m^2],
///           ShareAbove
///           output 3: polydata, grids of sensors as cells with the sensors' values as cell data, to
///           colour; empty where the input has none
///   Model   Mean = flux / area; U0 = minimum / mean; Ud = minimum / maximum (0 where that divides
///           by 0); point values are linear over triangles. Cells without area count for nothing.
///           Lines: between points, values are linear, and so they are between the sensors of a
///           rectangle; cell values are first averaged to corners (30 degrees part sheets)
///   Cost    O(cells x (arrays x thresholds + levels))
///   Source  EN 12665:2018, 3.2
///   Fails   an array that is missing or holds a value that is not finite: an error that names it,
///           empty outputs
class VTKRADIOMETRYFILTERS_EXPORT vtkRadiometricStatistics : public vtkTableAlgorithm
{
public:
  static vtkRadiometricStatistics* New();
  vtkTypeMacro(vtkRadiometricStatistics, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The arrays to describe; cell data is looked at first. Default none: then every result array
  /// of docs/arrays.md that the input has, without the Error arrays.
  void AddArrayName(const char* name);
  void ClearArrayNames();
  int GetNumberOfArrayNames() const { return static_cast<int>(this->ArrayNames.size()); }
  /// That one array only.
  void SetArrayName(const char* name);
  ///@}

  ///@{
  /// Integer cell array whose values part the cells into groups, such as ObjectIndex or
  /// MaterialIndex. Default none. GroupName comes from the field array of strings named like it
  /// with "Names" for "Index" (ObjectNames), where there is one.
  vtkSetStringMacro(GroupArray);
  vtkGetStringMacro(GroupArray);
  ///@}

  ///@{
  /// ShareAbove is the share of the area where the value is at least this, in the array's unit.
  /// Default 0.
  vtkSetMacro(Threshold, double);
  vtkGetMacro(Threshold, double);
  ///@}

  ///@{
  /// Further thresholds, each with a column of its own. Default none. Finite.
  void AddThreshold(double threshold);
  void ClearThresholds();
  int GetNumberOfThresholds() const { return 1 + static_cast<int>(this->MoreThresholds.size()); }
  ///@}

  ///@{
  /// Percentiles [%], each with a column P<percentile>: the value that this share of the area does
  /// not exceed. Default none. In (0, 100).
  void AddPercentile(double percentile);
  void ClearPercentiles();
  int GetNumberOfPercentiles() const { return static_cast<int>(this->Percentiles.size()); }
  ///@}

  ///@{
  /// Whether outputs 1 and 2 are filled. Default on.
  vtkSetMacro(GenerateIsolines, bool);
  vtkGetMacro(GenerateIsolines, bool);
  vtkBooleanMacro(GenerateIsolines, bool);
  ///@}

  ///@{
  /// The array of the iso-lines. Default none: Illuminance where it is among the arrays, else
  /// Irradiance, else the first of them. Of several bands, all together (three: their luminance).
  vtkSetStringMacro(IsolineArray);
  vtkGetStringMacro(IsolineArray);
  ///@}

  ///@{
  /// The values of the iso-lines, in the array's unit. Default none: steps of 1, 2 and 5 between
  /// the array's extremes. Finite.
  void AddIsovalue(double value);
  void ClearIsovalues();
  int GetNumberOfIsovalues() const { return static_cast<int>(this->Isovalues.size()); }
  ///@}

  ///@{
  /// Length of one unit of the coordinates [m]. Default 1. Finite, > 0.
  vtkSetMacro(MetersPerUnit, double);
  vtkGetMacro(MetersPerUnit, double);
  ///@}

  ///@{
  /// The processes that hold the pieces of the surface; all of them must update the filter. What is said
  /// is said of all pieces together, on the first process; the outputs of the others are empty.
  /// Default: the global controller, so the ranks of pvbatch and pvserver. Null: this process alone.
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

protected:
  vtkRadiometricStatistics();
  ~vtkRadiometricStatistics() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out) override;

  std::vector<std::string> ArrayNames;
  char* GroupArray = nullptr;
  double Threshold = 0.0;
  std::vector<double> MoreThresholds;
  std::vector<double> Percentiles;
  bool GenerateIsolines = true;
  char* IsolineArray = nullptr;
  std::vector<double> Isovalues;
  double MetersPerUnit = 1.0;
  vtkSmartPointer<vtkMultiProcessController> Controller;

private:
  vtkRadiometricStatistics(const vtkRadiometricStatistics&) = delete;
  void operator=(const vtkRadiometricStatistics&) = delete;

  void Describe(vtkDataObject* input, vtkInformationVector* out) const;
  std::vector<std::string> ArraysRead() const;
};

#endif
