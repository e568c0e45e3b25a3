// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkPolyData;

/// The polydata of an object with their names: one of its own (named ""), or the leaves of
/// composite data, named after their metadata or else "block 0", ... in the order of traversal.
std::vector<std::pair<std::string, vtkPolyData*>> SurfaceBlocks(vtkDataObject* object);

/// The name of an integer cell array's value, from the field array of strings that is named like
/// the array with "Names" for a final "Index"; empty when there is none.
std::string ValueName(vtkDataObject* object, const std::string& array, long long value);
