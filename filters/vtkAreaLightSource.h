// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkAreaLightSource_h
#define vtkAreaLightSource_h

#include "vtkRadiometricLightSource.h"

class vtkPolyData;

/// Area lights: a rectangle, a disc, or the polygons of an input; flat Lambertian surfaces that shine
/// to their front, and with TwoSided to both sides.
///   Reads   with Shape Polygons: the polygons of the input, convex or concave, flat to 1e-4 of their
///           extent; each becomes a light that shines where its points turn counter-clockwise
///   Writes  as vtkRadiometricLightSource, but a polygon a light instead of a vertex, its arrays
///           repeated at each corner; LightType 3, LightTwoSided, Intensity: exitance [W/m^2]
///   Model   exitance M = pi L = Phi/(s A): L the radiance, Phi the flux of all polygons together, A
///           their area, s 1 or with TwoSided 2. 100 lm give 100/pi = 31.831 lx at 1 m on the axis
///           of a small light. A disc is a regular polygon of the disc's area
///   Fails   as vtkRadiometricLightSource; also for polygons without area, not flat, or whose edges
///           cross
class VTKRADIOMETRYFILTERS_EXPORT vtkAreaLightSource : public vtkRadiometricLightSource
{
public:
  static vtkAreaLightSource* New();
  vtkTypeMacro(vtkAreaLightSource, vtkRadiometricLightSource);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Values of IntensityUnit.
  enum Units
  {
    WattPerSquareMeter = 0,
    Watt = 1,
    WattPerSquareMeterSteradian = 2,
    LumenPerSquareMeter = 3,
    Lumen = 4,
    CandelaPerSquareMeter = 5
  };
  void SetIntensityUnitToWattPerSquareMeter() { this->SetIntensityUnit(WattPerSquareMeter); }
  void SetIntensityUnitToWatt() { this->SetIntensityUnit(Watt); }
  void SetIntensityUnitToWattPerSquareMeterSteradian()
  {
    this->SetIntensityUnit(WattPerSquareMeterSteradian);
  }
  void SetIntensityUnitToLumenPerSquareMeter() { this->SetIntensityUnit(LumenPerSquareMeter); }
  void SetIntensityUnitToLumen() { this->SetIntensityUnit(Lumen); }
  void SetIntensityUnitToCandelaPerSquareMeter() { this->SetIntensityUnit(CandelaPerSquareMeter); }

  /// Values of Shape.
  enum Shapes
  {
    Rectangle = 0,
    Disc = 1,
    Polygons = 2
  };
  ///@{
  /// What shines: a rectangle (default) or a disc about Position, or the polygons of the input.
  vtkSetMacro(Shape, int);
  vtkGetMacro(Shape, int);
  void SetShapeToRectangle() { this->SetShape(Rectangle); }
  void SetShapeToDisc() { this->SetShape(Disc); }
  void SetShapeToPolygons() { this->SetShape(Polygons); }
  ///@}

  ///@{
  /// Sides of the rectangle [m]: Width along ReferenceDirection, Height across. Default 1. Above 0.
  vtkSetMacro(Width, double);
  vtkGetMacro(Width, double);
  vtkSetMacro(Height, double);
  vtkGetMacro(Height, double);
  ///@}

  ///@{
  /// Radius of the disc [m]. Default 0.5. Above 0.
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /// Sides of the polygon that stands for the disc. Default 32; 3 to 4096.
  vtkSetMacro(Sides, int);
  vtkGetMacro(Sides, int);
  ///@}

  ///@{
  /// Where rectangle and disc shine: the normal of their front. Default (0, 0, -1). Any length but
  /// zero.
  vtkSetVector3Macro(Direction, double);
  vtkGetVector3Macro(Direction, double);
  ///@}

  ///@{
  /// The direction of the rectangle's width, and of the disc's first corner (its part square to
  /// Direction). Default (1, 0, 0). Any length but zero.
  vtkSetVector3Macro(ReferenceDirection, double);
  vtkGetVector3Macro(ReferenceDirection, double);
  ///@}

  ///@{
  /// Whether the light shines from its back too, with the same exitance. Default off.
  vtkSetMacro(TwoSided, bool);
  vtkGetMacro(TwoSided, bool);
  vtkBooleanMacro(TwoSided, bool);
  ///@}

protected:
  vtkAreaLightSource();
  ~vtkAreaLightSource() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out) override;
  double Describe(radiometry::LightRecord& light, bool& photometric) override;
  void AddFurther(std::vector<radiometry::LightRecord>& lights,
    const std::vector<double>& factors) override;

  int Shape = Rectangle;
  double Width = 1.0;
  double Height = 1.0;
  double Radius = 0.5;
  int Sides = 32;
  double Direction[3] = { 0.0, 0.0, -1.0 };
  double ReferenceDirection[3] = { 1.0, 0.0, 0.0 };
  bool TwoSided = false;

private:
  vtkAreaLightSource(const vtkAreaLightSource&) = delete;
  void operator=(const vtkAreaLightSource&) = delete;

  double FindPolygons(std::vector<radiometry::LightRecord>& found) const;

  vtkPolyData* Input = nullptr; // while it runs
};

#endif
