// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRadianceFilter_h
#define vtkRadianceFilter_h

#include "vtkRadiometricFilter.h"

/// What leaves each cell (or point) of a surface toward an eye, how large each cell is seen from
/// there, and what a camera's image gets of it.
///   Ports   those of the simulating filters, and 3 a camera (optional; the third output of the
///           Radiometric Scene Reader: its first vertex and Direction)
///   Reads   of the surface: Radiosity, or else Irradiance, with their errors (of two-sided cells also
///           RadiosityBack or IrradianceBack), of cells or of points; material arrays; LightVisibility
///           where it is there. With neither, direct light is computed first, as Irradiance does.
///           Lights: for highlights
///   Writes  Radiance [W/(m^2 sr)] toward the eye, of the side that is seen, and RadianceError;
///           ImageIrradiance [W/m^2] and its error; Facing (1 the front is seen, -1 the back, 0
///           neither); OffAxisAngle [degrees]; of cells, from an eye at a point: SolidAngle [sr] and
///           ProjectedSolidAngle [sr], with errors. Photometric: Luminance, ImageIlluminance.
///           Field data ViewPoint or ViewDirection, ViewAxis, ReceiverNormal as used, in the unit of
///           the coordinates
///   Model   L = B/pi + int f_r L_i cos dw + tau L_behind, averaged over the cell; f_r the Phong lobe
///           of SpecularReflectance and Shininess. E_image = L pi/4 cos^4(alpha)/FNumber^2
///   Limits  nothing is asked about what stands between a cell and the eye, nor about fog. A perfect
///           mirror shows surfaces, area lights and skies, and no light without an area
///   Cost    O(cells); cells that reflect specularly or transmit: 64 to 16384 samples of some rays each
///   Source  Nicodemus 1965 (radiance); Lafortune and Willems 1994 (lobe); Reiss 1945 (cos^4 law)
///   Fails   as the simulating filters; values of Irradiance or Radiosity that are negative or not
///           finite, present in some blocks only, or without their error's shape
class VTKRADIOMETRYFILTERS_EXPORT vtkRadianceFilter : public vtkRadiometricFilter
{
public:
  static vtkRadianceFilter* New();
  vtkTypeMacro(vtkRadianceFilter, vtkRadiometricFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The values of ViewFrom.
  enum Views
  {
    VIEW_AUTOMATIC = 0,
    VIEW_POINT = 1,
    VIEW_DIRECTION = 2,
    VIEW_CAMERA = 3
  };

  /// A camera (input port 3).
  void SetCameraConnection(vtkAlgorithmOutput* camera);
  void SetCameraData(vtkDataObject* camera);
  void RemoveCameraConnection();

  ///@{
  /// Who looks. 0 Automatic (default): ViewPoint or ViewDirection, whichever was set last; else the
  /// camera of port 3; else CameraPosition, where that differs from CameraFocalPoint; else an eye
  /// that sees the whole surface looking along -z, where a view's Reset Camera stands at first.
  /// 1 Point, 2 Direction, 3 Camera (one of the two) insist.
  vtkSetClampMacro(ViewFrom, int, VIEW_AUTOMATIC, VIEW_CAMERA);
  vtkGetMacro(ViewFrom, int);
  ///@}
  ///@{
  /// Where the eye is, in the unit of the surface's coordinates. Finite.
  void SetViewPoint(double x, double y, double z);
  void SetViewPoint(const double point[3]) { this->SetViewPoint(point[0], point[1], point[2]); }
  vtkGetVector3Macro(ViewPoint, double);
  ///@}
  ///@{
  /// Which way an eye looks that is infinitely far away (parallel projection): from the eye to the
  /// surface. Any finite length but 0. Solid angles are not written then.
  void SetViewDirection(double x, double y, double z);
  void SetViewDirection(const double d[3]) { this->SetViewDirection(d[0], d[1], d[2]); }
  vtkGetVector3Macro(ViewDirection, double);
  ///@}
  ///@{
  /// The axis of the camera, into the scene. Default (0, 0, 0): the camera's own, or toward the
  /// middle of the surface's box, or along ViewDirection.
  vtkSetVector3Macro(ViewAxis, double);
  vtkGetVector3Macro(ViewAxis, double);
  ///@}
  ///@{
  /// Normal of the small receiver at the eye about which ProjectedSolidAngle is taken. Default
  /// (0, 0, 0): the axis. L times ProjectedSolidAngle is the irradiance a cell gives it.
  vtkSetVector3Macro(ReceiverNormal, double);
  vtkGetVector3Macro(ReceiverNormal, double);
  ///@}
  ///@{
  /// The camera's f-number, for ImageIrradiance. Default 8. 0: none is written.
  vtkSetMacro(FNumber, double);
  vtkGetMacro(FNumber, double);
  ///@}

  /// The same as SetViewPoint and SetViewDirection, but (0, 0, 0) takes them back while ViewFrom is
  /// Automatic: what ParaView's panel calls, where every property always has a value.
  void SetViewPointUnlessZero(double x, double y, double z);
  void SetViewDirectionUnlessZero(double x, double y, double z);

protected:
  vtkRadianceFilter();
  ~vtkRadianceFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void CopyMembers(vtkRadiometricAlgorithm* from) override;
  void Simulate(Job& job, Result& result) override;
  std::vector<std::string> CellArraysRead() const override;
  bool WantsPoints(const SceneAdapter& adapter) const override;

  int ViewFrom = VIEW_AUTOMATIC;
  int Given = VIEW_AUTOMATIC; // what was set last
  double ViewPoint[3] = { 0.0, 0.0, 0.0 };
  double ViewDirection[3] = { 0.0, 0.0, 0.0 };
  double ViewAxis[3] = { 0.0, 0.0, 0.0 };
  double ReceiverNormal[3] = { 0.0, 0.0, 0.0 };
  double FNumber = 8.0;

private:
  struct Looking;
  Looking FindViewer(const Job& job);

  vtkRadianceFilter(const vtkRadianceFilter&) = delete;
  void operator=(const vtkRadianceFilter&) = delete;
};

#endif
