// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMRadiometricViewProxy.h"

#include "vtkClientServerStream.h"
#include "vtkObjectFactory.h"
#include "vtkSMPropertyHelper.h"

vtkStandardNewMacro(vtkSMRadiometricViewProxy);

vtkSMRadiometricViewProxy::vtkSMRadiometricViewProxy() = default;

vtkSMRadiometricViewProxy::~vtkSMRadiometricViewProxy() = default;

std::string vtkSMRadiometricViewProxy::Text(const char* property)
{
  const char* text = vtkSMPropertyHelper(this, property, true).GetAsString();
  return text ? text : "";
}

void vtkSMRadiometricViewProxy::UpdateVTKObjects()
{
  const std::string file = this->Text("CaptureLinear");
  if (!file.empty())
  {
    vtkSMPropertyHelper(this, "CaptureLinear", true).Set("");
  }
  this->Superclass::UpdateVTKObjects();
  if (!this->ObjectsCreated)
  {
    return;
  }
  const std::string listed = this->Text("ConfigFileName") + '\n' + this->Text("Display");
  if (listed != this->Listed)
  {
    this->Listed = listed;
    for (const char* list : { "DisplayNames", "ViewNames", "LookNames", "ColorSpaceNames" })
    {
      if (vtkSMProperty* property = this->GetProperty(list))
      {
        this->UpdatePropertyInformation(property);
      }
    }
  }
  if (!file.empty())
  {
    this->CaptureLinear(file.c_str());
  }
}

void vtkSMRadiometricViewProxy::CaptureLinear(const char* fileName)
{
  this->StillRender();
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(this) << "CaptureLinear" << fileName
         << vtkClientServerStream::End;
  this->ExecuteStream(stream);
}

void vtkSMRadiometricViewProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Listed: " << this->Listed << "\n";
}
