// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadiometricView
 * @brief   ParaView view "Radiometric View": a Render View that shows light as a display can
 *
 *   Does    surfaces that are shown as "Radiometric Surface" are scene-linear light, drawn in floats
 *           and converted by OpenColorIO; everything else keeps its colours: false-coloured and
 *           stock surfaces, legends, texts, axes, the background of any kind (vtkOpenColorIOPass)
 *   Writes  CaptureLinear: the light as it was before conversion, an OpenEXR file of R, G, B, A
 *           and Z (distance from the camera's plane), 32-bit floats
 *   Ranks   each process converts its own picture before ParaView composites them by depth;
 *           the capture composites floats, sample by sample
 *   Limits  with several processes, and while the view is moved, pictures have one sample a pixel.
 *           FXAA and tone mapping of the Render View have no effect; SSAO shades what is no light;
 *           while ray tracing is on there is no conversion
 *   Fails   a config that is missing or broken, a name that it does not have: one error event for
 *           each change, and light is shown without conversion (clamped)
 */
#ifndef vtkRadiometricView_h
#define vtkRadiometricView_h

#include "vtkNew.h" // for ivars
#include "vtkPVRenderView.h"
#include "vtkRadiometryRenderingParaViewModule.h" // for export macro

#include <string> // for ivars

class vtkLinearFloatPass;
class vtkOpenColorIOPass;
class vtkStringArray;
namespace vtkradiometry
{
struct LinearPicture;
}

class VTKRADIOMETRYRENDERINGPARAVIEW_EXPORT vtkRadiometricView : public vtkPVRenderView
{
public:
  static vtkRadiometricView* New();
  vtkTypeMacro(vtkRadiometricView, vtkPVRenderView);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The word that stands for a config's own choice of display and view, and for no look.
   */
  static const char* DefaultName() { return "Default"; }

  ///@{
  /**
   * The OpenColorIO config file. Empty (default): the one that $OCIO names, else the project's own;
   * "builtin": the project's own in any case. Read by each process that draws.
   */
  void SetConfigFileName(const char* name);
  const char* GetConfigFileName();
  ///@}

  ///@{
  /**
   * The colour space of the light, by name, alias or role of the config. "Default" or empty
   * (default): scene-linear Rec.709.
   */
  void SetSourceColorSpace(const char* name);
  const char* GetSourceColorSpace();
  ///@}

  ///@{
  /**
   * The display, the view of it, and a look (or several with commas). "Default" or empty (default):
   * the config's first display, its first view, no look.
   */
  void SetDisplay(const char* name);
  const char* GetDisplay();
  void SetView(const char* name);
  const char* GetView();
  void SetLook(const char* name);
  const char* GetLook();
  ///@}

  ///@{
  /**
   * Exposure in stops: light is multiplied by 2^Exposure, beside what AutoExposure finds. Default
   * 0; any finite number. Not the tone mapping's of vtkPVRenderView, which this view does not have.
   */
  void SetExposure(double stops);
  vtkGetMacro(Exposure, double);
  ///@}

  ///@{
  /**
   * Samples of the light along each side of a pixel, averaged in linear light: 1 (default) to 8.
   * Time and memory grow with the square.
   */
  vtkSetClampMacro(Samples, int, 1, 8);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /**
   * What the config offers, each list with "Default" first; without a usable config that alone.
   */
  vtkStringArray* GetDisplayNames();
  vtkStringArray* GetViewNames();
  vtkStringArray* GetLookNames();
  vtkStringArray* GetColorSpaceNames();
  ///@}

  /**
   * What is wrong with the config or the names; empty when all is well. Known after a render.
   */
  const char* GetErrorMessage();

  /**
   * Writes the light of the last picture as an OpenEXR file, on the client (root of pvbatch). To be
   * called on every process of the view, as its proxy's CaptureLinear does. 1 when it was written
   * or another process writes it, else 0 and an error event. The file appears when it is complete.
   */
  int CaptureLinear(const char* fileName);

  ///@{
  /**
   * On (default): a part of the exposure is found from the picture: its typical light becomes a
   * quarter of white, and all but the brightest 2 % stay below white. In quarter stops; it stays
   * while the picture calls for less than a quarter stop of change. Exposure is added to it. Found
   * by the view's proxy for still pictures, the same on all processes.
   */
  void SetAutoExposure(bool on);
  vtkGetMacro(AutoExposure, bool);
  ///@}

  ///@{
  /**
   * The automatic part, in stops: measured on every process of the view together, known to the
   * client (root of pvbatch), which sets it on all.
   */
  double MeasureExposure();
  void SetAutomaticStops(double stops);
  vtkGetMacro(AutomaticStops, double);
  vtkGetMacro(MeasuredStops, double);
  ///@}

  /**
   * The exposure that is in use, in stops: Exposure and the automatic part.
   */
  double GetUsedExposure();

  ///@{
  /**
   * Without effect here: the view's own transform takes their place.
   */
  void SetUseToneMapping(bool) {}
  void SetUseFXAA(bool) override {}
  ///@}

protected:
  vtkRadiometricView();
  ~vtkRadiometricView() override;

  void AboutToRenderOnLocalProcess(bool interactive) override;

private:
  vtkRadiometricView(const vtkRadiometricView&) = delete;
  void operator=(const vtkRadiometricView&) = delete;

  bool IsComposited();
  bool CollectPicture(vtkradiometry::LinearPicture& picture, int samples, int reduction);
  void UpdateExposure();

  vtkNew<vtkOpenColorIOPass> Pass;
  vtkNew<vtkLinearFloatPass> CapturePass;
  vtkNew<vtkStringArray> Names;
  std::string Message;
  int Samples = 1;
  double Exposure = 0.0;
  bool AutoExposure = true;
  double AutomaticStops = 0.0;
  double MeasuredStops = 0.0;
};

#endif
