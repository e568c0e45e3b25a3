// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMRadiometricViewProxy
 * @brief   the client's side of vtkRadiometricView
 *
 * Keeps the panel's lists (displays, views, looks, colour spaces) with the config and the display
 * that are set, and makes CaptureLinear a command: setting the property to a file name renders the
 * view, writes the file, and empties the property, so that no state holds it and the same name can
 * be set again. Still renders find the automatic part of the exposure and, where it changes, draw
 * the picture again.
 */
#ifndef vtkSMRadiometricViewProxy_h
#define vtkSMRadiometricViewProxy_h

#include "vtkRadiometryRenderingParaViewModule.h" // for export macro
#include "vtkSMRenderViewProxy.h"

#include <string> // for ivars

class VTKRADIOMETRYRENDERINGPARAVIEW_EXPORT vtkSMRadiometricViewProxy : public vtkSMRenderViewProxy
{
public:
  static vtkSMRadiometricViewProxy* New();
  vtkTypeMacro(vtkSMRadiometricViewProxy, vtkSMRenderViewProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void UpdateVTKObjects() override;

  /**
   * Renders the view and writes its light (vtkRadiometricView::CaptureLinear).
   */
  void CaptureLinear(const char* fileName);

  void StillRender() override;

protected:
  vtkSMRadiometricViewProxy();
  ~vtkSMRadiometricViewProxy() override;

private:
  vtkSMRadiometricViewProxy(const vtkSMRadiometricViewProxy&) = delete;
  void operator=(const vtkSMRadiometricViewProxy&) = delete;

  std::string Text(const char* property);
  void UpdateLists();

  std::string Listed; // the config and display that the lists are of
};

#endif
