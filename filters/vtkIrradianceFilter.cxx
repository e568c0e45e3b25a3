#include "vtkIrradianceFilter.h"
#include "vtkObjectFactory.h"
vtkStandardNewMacro(vtkIrradianceFilter);
