// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRadiometricStatistics_h
#define vtkRadiometricStatistics_h

#include "vtkRadiometryFiltersModule.h"
#include "vtkTableAlgorithm.h"

#include <string> // for ArrayNames
#include <vector> // for ArrayNames

/// Area-weighted statistics of arrays over a surface, its blocks and its groups of cells.
///   Reads   polydata, or composite data of polydata; the named cell or point arrays (any unit);
///           GroupArray: one integer a cell
///   Writes  vtkTable, one row for each block, group, array and component: Block, Group (value of
///           GroupArray; -1: all cells of the block), GroupName, Array, Component (-1: the sum of
///           three bands weighted by luminance), Area [m^2], Minimum, Mean, Maximum, U0, Ud,
///           Flux [array's unit times m^2], ShareAbove, Cells. Of composite data a first block
///           "(all)" is the whole. Field data: Threshold
///   Model   Mean = flux / area; U0 = minimum / mean; Ud = minimum / maximum (0 where that divides
///           by 0); point values are linear over triangles. Cells without area count for nothing
///   Cost    O(cells x arrays)
///   Source  EN 12665:2018, 3.2
///   Fails   an array that is missing or holds a value that is not finite: an error that names it,
///           an empty table
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
  /// Length of one unit of the coordinates [m]. Default 1. Finite, > 0.
  vtkSetMacro(MetersPerUnit, double);
  vtkGetMacro(MetersPerUnit, double);
  ///@}

protected:
  vtkRadiometricStatistics();
  ~vtkRadiometricStatistics() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out) override;

  std::vector<std::string> ArrayNames;
  char* GroupArray = nullptr;
  double Threshold = 0.0;
  double MetersPerUnit = 1.0;

private:
  vtkRadiometricStatistics(const vtkRadiometricStatistics&) = delete;
  void operator=(const vtkRadiometricStatistics&) = delete;
};

#endif
