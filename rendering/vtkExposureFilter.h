// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkExposureFilter
 * @brief Exposes a scene-linear image as a camera would.
 *
 *   Reads   a point array of 1 to 4 components: the one selected by SetInputArrayToProcess, else the
 *           active scalars, "RGB" or "RGBA"; radiance in W/(m^2 sr), or luminance in cd/m^2 where the
 *           array's unit (vtkDataArray::UNITS_LABEL) says so
 *   Writes  that array times one gain, as float, without a unit: 1 is the sensor's saturation. Field
 *           data: ExposureValue [EV100], ExposureGain, ExposureStops (log2 of the gain: for the Exposure
 *           of vtkOpenColorIOPass), NonFinitePixels, ExposureSummary. The other arrays pass through
 *   Model   EV100 = log2(N^2/t 100/S); 1.2 x 2^EV100 cd/m^2 become 1 (radiometry/imaging/Exposure.h)
 *   Cost    O(pixels)
 *   Source  ISO 12232:2019; Lagarde and de Rousiers 2014, section 5; Reinhard et al. 2002
 *   Fails   a setting out of range, no array, an image that is not flat: an error event, and the
 *           output is the input, unchanged
 *
 * Pixels that hold a NaN or an infinity are not measured, are counted, and unless RepairPixels is off
 * become black, or for +infinity the picture's greatest value. Pixels of alpha 0 are not measured.
 */
#ifndef vtkExposureFilter_h
#define vtkExposureFilter_h

#include "vtkImageAlgorithm.h"
#include "vtkRadiometryRenderingModule.h" // for export macro

class VTKRADIOMETRYRENDERING_EXPORT vtkExposureFilter : public vtkImageAlgorithm
{
public:
  static vtkExposureFilter* New();
  vtkTypeMacro(vtkExposureFilter, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum
  {
    EXPOSURE_VALUE = 0,
    CAMERA = 1,
    KEY_VALUE = 2,
    PERCENTILE = 3,
    STOPS = 4,
    AUTOMATIC = 5
  };
  ///@{
  /**
   * What decides: EXPOSURE_VALUE the property ExposureValue; CAMERA f-number, shutter time and ISO
   * speed; KEY_VALUE makes the geometric mean of the luminances KeyValue; PERCENTILE (default) makes
   * the luminance that Percentile % of the pixels do not exceed PercentileLevel; STOPS multiplies by
   * 2^Compensation alone; AUTOMATIC is the darker of KEY_VALUE and PERCENTILE.
   */
  vtkSetClampMacro(Mode, int, EXPOSURE_VALUE, AUTOMATIC);
  vtkGetMacro(Mode, int);
  ///@}

  ///@{
  /**
   * EV100, the exposure value at ISO 100. Default 10; a lit room has 5 to 9, sunlight 15. Finite.
   */
  vtkSetMacro(ExposureValue, double);
  vtkGetMacro(ExposureValue, double);
  ///@}

  ///@{
  /**
   * The aperture's f-number N. Default 8. Above 0.
   */
  vtkSetMacro(FNumber, double);
  vtkGetMacro(FNumber, double);
  ///@}

  ///@{
  /**
   * Shutter time t [s]. Default 1/60. Above 0.
   */
  vtkSetMacro(ShutterTime, double);
  vtkGetMacro(ShutterTime, double);
  ///@}

  ///@{
  /**
   * ISO speed S. Default 100. Above 0.
   */
  vtkSetMacro(IsoSpeed, double);
  vtkGetMacro(IsoSpeed, double);
  ///@}

  ///@{
  /**
   * What the geometric mean becomes. Default 0.18, middle grey. Above 0.
   */
  vtkSetMacro(KeyValue, double);
  vtkGetMacro(KeyValue, double);
  ///@}

  ///@{
  /**
   * The percentile [%]. Default 99. In [0, 100].
   */
  vtkSetMacro(Percentile, double);
  vtkGetMacro(Percentile, double);
  ///@}

  ///@{
  /**
   * What its luminance becomes. Default 1. Above 0.
   */
  vtkSetMacro(PercentileLevel, double);
  vtkGetMacro(PercentileLevel, double);
  ///@}

  ///@{
  /**
   * Stops brighter than the mode says. Default 0. Finite.
   */
  vtkSetMacro(Compensation, double);
  vtkGetMacro(Compensation, double);
  ///@}

  ///@{
  /**
   * Luminance of a pixel value of 1 [cd/m^2]. Default 0: by the array's unit, 1 for cd/m^2, else
   * 683.002 (radiance in W/(m^2 sr)).
   */
  vtkSetMacro(LuminancePerUnit, double);
  vtkGetMacro(LuminancePerUnit, double);
  ///@}

  ///@{
  /**
   * Whether a NaN becomes black and an infinity the picture's greatest value. Default on.
   */
  vtkSetMacro(RepairPixels, bool);
  vtkGetMacro(RepairPixels, bool);
  vtkBooleanMacro(RepairPixels, bool);
  ///@}

  ///@{
  /**
   * What the last update chose: EV100, the gain, its log2, and how many pixels were not finite.
   */
  vtkGetMacro(UsedExposureValue, double);
  vtkGetMacro(UsedGain, double);
  vtkGetMacro(UsedStops, double);
  vtkGetMacro(NonFinitePixels, vtkIdType);
  ///@}

protected:
  vtkExposureFilter();
  ~vtkExposureFilter() override = default;

  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkExposureFilter(const vtkExposureFilter&) = delete;
  void operator=(const vtkExposureFilter&) = delete;

  int Mode = PERCENTILE;
  double ExposureValue = 10.0;
  double FNumber = 8.0;
  double ShutterTime = 1.0 / 60.0;
  double IsoSpeed = 100.0;
  double KeyValue = 0.18;
  double Percentile = 99.0;
  double PercentileLevel = 1.0;
  double Compensation = 0.0;
  double LuminancePerUnit = 0.0;
  bool RepairPixels = true;

  double UsedExposureValue = 0.0;
  double UsedGain = 1.0;
  double UsedStops = 0.0;
  vtkIdType NonFinitePixels = 0;
};

#endif
