// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkWorkPlaneSource_h
#define vtkWorkPlaneSource_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkRadiometryFiltersModule.h"

/// A measuring grid: sensors on a rectangle, on a work plane over a room, or on any surface.
///   Reads   input (optional): the room or the surface; polydata, composite data, or any dataset,
///           whose outer surface is taken
///   Writes  output 0, Sensors: polydata of vertices (float64) without polygons, point data Normals
///           and SensorCell (four corners of the sensor's piece of the plane); field data
///           SensorGridDimensions (rectangles) and SensorGridRule. The simulating filters give each
///           sensor its irradiance, and it blocks no light. Radiometric Statistics turns it back
///           into cells, with iso-lines.
///           output 1, Mesh: those pieces as polygons in the sensors' order
///   Model   spacing p = 0.2 * 5^log10(d), at most 10 m; d [m] is the longer side, the shorter one
///           where the longer is at least twice as long. Points lie in the middle of equal parts, so
///           half a spacing from the edge
///   Cost    O(sensors), 200 bytes each; at most 10 million
///   Source  EN 12464-1:2011, 4.4
///   Fails   a plane without area, a number that is not finite, too many sensors, a mode without its
///           input: an error that names it, empty outputs
class VTKRADIOMETRYFILTERS_EXPORT vtkWorkPlaneSource : public vtkPolyDataAlgorithm
{
public:
  static vtkWorkPlaneSource* New();
  vtkTypeMacro(vtkWorkPlaneSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The values of Mode.
  enum Modes
  {
    AUTO = 0,
    RECTANGLE = 1,
    ROOM = 2,
    ON_SURFACE = 3
  };
  /// The values of SpacingRule.
  enum SpacingRules
  {
    EN_12464 = 0,
    FIXED_SPACING = 1,
    FIXED_RESOLUTION = 2
  };
  /// The values of Rounding.
  enum Roundings
  {
    UP = 0,
    NEAREST = 1,
    ODD = 2
  };

  ///@{
  /// Where the sensors lie. 0 Auto (default): Room where there is an input, else Rectangle.
  /// 1 Rectangle: Origin, Point1, Point2. 2 Room: a plane at Height over the lowest point of the
  /// input, within the floor's extent less WallZone; the floor is what lies as low, where it spans at
  /// least half of the input both ways, else the whole input. 3 OnSurface: on every polygon of the input, with its
  /// normal; a sensor that lies on a surface is not shadowed by it.
  vtkSetMacro(Mode, int);
  vtkGetMacro(Mode, int);
  void SetModeToAuto() { this->SetMode(AUTO); }
  void SetModeToRectangle() { this->SetMode(RECTANGLE); }
  void SetModeToRoom() { this->SetMode(ROOM); }
  void SetModeToOnSurface() { this->SetMode(ON_SURFACE); }
  ///@}

  ///@{
  /// Rectangle: a corner and the ends of the two sides that meet there [unit of the coordinates].
  /// The normal is (Point1 - Origin) x (Point2 - Origin). Default (-0.5, -0.5, 0), (0.5, -0.5, 0),
  /// (-0.5, 0.5, 0).
  vtkSetVector3Macro(Origin, double);
  vtkGetVector3Macro(Origin, double);
  vtkSetVector3Macro(Point1, double);
  vtkGetVector3Macro(Point1, double);
  vtkSetVector3Macro(Point2, double);
  vtkGetVector3Macro(Point2, double);
  ///@}

  ///@{
  /// Room: height of the plane above the lowest point of the input [m]. Default 0.8. Finite.
  vtkSetMacro(Height, double);
  vtkGetMacro(Height, double);
  ///@}
  ///@{
  /// Room: width of the zone along the walls that is left out [m], but at most a quarter of the
  /// room's side. Default 0.5 (EN 12464-1). At least 0.
  vtkSetMacro(WallZone, double);
  vtkGetMacro(WallZone, double);
  ///@}
  ///@{
  /// Room: where up is; the sensors look there. Default (0, 0, 1). Scenes read from glTF have
  /// (0, 1, 0). Any length but zero.
  vtkSetVector3Macro(UpDirection, double);
  vtkGetVector3Macro(UpDirection, double);
  ///@}
  ///@{
  /// Turns the sensors to the other side. Default off.
  vtkSetMacro(FlipNormals, bool);
  vtkGetMacro(FlipNormals, bool);
  vtkBooleanMacro(FlipNormals, bool);
  ///@}

  ///@{
  /// What decides how far apart the sensors are. 0 (default): EN 12464-1; on a surface, d comes
  /// from the two longer sides of its bounds. 1: Spacing. 2: Resolution (not on a surface). A
  /// surface has at least one sensor a polygon, however small that is.
  vtkSetMacro(SpacingRule, int);
  vtkGetMacro(SpacingRule, int);
  void SetSpacingRuleToEN12464() { this->SetSpacingRule(EN_12464); }
  void SetSpacingRuleToFixedSpacing() { this->SetSpacingRule(FIXED_SPACING); }
  void SetSpacingRuleToFixedResolution() { this->SetSpacingRule(FIXED_RESOLUTION); }
  ///@}
  ///@{
  /// Greatest distance between sensors [m]. Default 0.5. Finite, > 0.
  vtkSetMacro(Spacing, double);
  vtkGetMacro(Spacing, double);
  ///@}
  ///@{
  /// Numbers of sensors along Point1 and Point2, or along the room's sides. Default (10, 10). At
  /// least 1.
  vtkSetVector2Macro(Resolution, int);
  vtkGetVector2Macro(Resolution, int);
  ///@}
  ///@{
  /// How the number of sensors along a side becomes whole. 0 Up (default): the spacing is a
  /// maximum. 1 Nearest: the words of EN 12464-1:2011, "the nearest whole number of d/p". 2 Odd: up
  /// to an odd number, so that a sensor is in the middle. On a surface always up.
  vtkSetMacro(Rounding, int);
  vtkGetMacro(Rounding, int);
  ///@}

  ///@{
  /// Metres per unit of the coordinates, of the input and of Origin, Point1 and Point2. Lengths
  /// given in metres are converted with it. Default 1. Finite, > 0.
  vtkSetMacro(MetersPerUnit, double);
  vtkGetMacro(MetersPerUnit, double);
  ///@}

protected:
  vtkWorkPlaneSource();
  ~vtkWorkPlaneSource() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out) override;

  int Mode = AUTO;
  double Origin[3] = { -0.5, -0.5, 0.0 };
  double Point1[3] = { 0.5, -0.5, 0.0 };
  double Point2[3] = { -0.5, 0.5, 0.0 };
  double Height = 0.8;
  double WallZone = 0.5;
  double UpDirection[3] = { 0.0, 0.0, 1.0 };
  bool FlipNormals = false;
  int SpacingRule = EN_12464;
  double Spacing = 0.5;
  int Resolution[2] = { 10, 10 };
  int Rounding = UP;
  double MetersPerUnit = 1.0;

private:
  vtkWorkPlaneSource(const vtkWorkPlaneSource&) = delete;
  void operator=(const vtkWorkPlaneSource&) = delete;

  struct Grid;
  void CheckProperties(bool hasInput) const;
  void MakePlane(vtkDataObject* input, Grid& grid) const;
  void MakeOnSurface(vtkDataObject* input, Grid& grid) const;
};

#endif
