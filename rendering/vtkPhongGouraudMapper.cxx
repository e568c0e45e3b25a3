#include "vtkPhongGouraudMapper.h"
#include "vtkObjectFactory.h"
vtkStandardNewMacro(vtkPhongGouraudMapper);
