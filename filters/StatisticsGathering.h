// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class ControllerCommunicator;
class vtkDataObject;

/// A surface with values whose parts the ranks hold, whole on rank 0 (null on the others), for what is
/// said of all of it: each leaf in one piece, without the cells and sensors that vtkGhostType marks
/// as copies. Collective.
///   Reads   of the arrays only those named; field data is that of the first part
///   Parts   with the same bytes (data that every rank has whole) count once. Sensors in several
///           parts are no rectangle any more: SensorGridDimensions is dropped
///   Cost    rank 0 gets all points, cells and these arrays
vtkSmartPointer<vtkDataObject> GatherForStatistics(
  const ControllerCommunicator& ranks, vtkDataObject* input, const std::vector<std::string>& arrays);
