// SPDX-License-Identifier: BSD-3-Clause
#ifndef ColorSteps_h
#define ColorSteps_h

#include <array>
#include <vector>

class vtkScalarsToColors;

namespace vtkradiometry
{

/// A colour map as what it is on a display of 8 bits: a function of the scalar with steps.
///   Reads   any vtkScalarsToColors, through MapScalarsThroughTable2: discrete and continuous maps,
///           logarithmic scale, colours below, above and of NaN, opacity
///   Model   each step begins at the least coordinate (float) whose colour is the step's. The
///           coordinate of a value v is (v - lo)/(hi - lo) of the map's range, or v/lo where the map
///           is logarithmic, so that a range far from zero keeps the digits of a float
///   Cost    about 5,000 to 100,000 evaluations of the map
///   Limits  between neighbours of 4,096 samples (and the map's own nodes) that have one colour, the
///           map is taken as constant
class ColorSteps
{
public:
  using Color = std::array<unsigned char, 4>;

  void Build(vtkScalarsToColors* map);
  void Clear();
  bool IsEmpty() const { return this->Begins.empty(); }

  /// The number of the step that a value's colour belongs to.
  std::size_t StepOf(float coordinate) const;
  /// The coordinate of a value, moved by some units of the last place where rounding in a shader
  /// might otherwise put a cell of one value on the wrong side of a step. `color` is the map's.
  float Coordinate(double value, const Color& color) const;
  const Color& ColorOf(std::size_t step) const { return this->Colors[step]; }
  std::size_t GetNumberOfSteps() const { return this->Begins.size(); }

  /// RGBA texels: (0, colour, opacity, 0) of NaN, then for each step its begin, colour, opacity, 0;
  /// the colour is r + 256 g + 65536 b of 8 bits.
  std::vector<float> Texels() const;

private:
  double ValueOf(float coordinate) const;
  std::vector<float> Samples(vtkScalarsToColors* map) const;

  double Origin = 0.0;
  double Unit = 1.0;
  bool Logarithmic = false;
  std::vector<float> Begins; // ascending
  std::vector<Color> Colors;
  Color OfNaN{ { 0, 0, 0, 0 } };
};

/// The map's colours of values, as cells and legends get them.
std::vector<ColorSteps::Color> MapValues(vtkScalarsToColors* map, std::vector<double> values);

} // namespace vtkradiometry

#endif
// VTK-HeaderTest-Exclude: ColorSteps.h
