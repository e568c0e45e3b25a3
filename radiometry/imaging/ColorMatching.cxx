// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/imaging/ColorMatching.h"

#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace radiometry
{
namespace imaging
{
namespace
{

constexpr double Step = 5.0; // nm
constexpr int Nodes = 81;

/// CIE 1931, 2 degrees, 380 to 780 nm.
constexpr std::array<Triple, Nodes> Table{ { { 0.001368, 0.000039, 0.006450 },
  { 0.002236, 0.000064, 0.010550 }, { 0.004243, 0.000120, 0.020050 },
  { 0.007650, 0.000217, 0.036210 }, { 0.014310, 0.000396, 0.067850 },
  { 0.023190, 0.000640, 0.110200 }, { 0.043510, 0.001210, 0.207400 },
  { 0.077630, 0.002180, 0.371300 }, { 0.134380, 0.004000, 0.645600 },
  { 0.214770, 0.007300, 1.039050 }, { 0.283900, 0.011600, 1.385600 },
  { 0.328500, 0.016840, 1.622960 }, { 0.348280, 0.023000, 1.747060 },
  { 0.348060, 0.029800, 1.782600 }, { 0.336200, 0.038000, 1.772110 },
  { 0.318700, 0.048000, 1.744100 }, { 0.290800, 0.060000, 1.669200 },
  { 0.251100, 0.073900, 1.528100 }, { 0.195360, 0.090980, 1.287640 },
  { 0.142100, 0.112600, 1.041900 }, { 0.095640, 0.139020, 0.812950 },
  { 0.057950, 0.169300, 0.616200 }, { 0.032010, 0.208020, 0.465180 },
  { 0.014700, 0.258600, 0.353300 }, { 0.004900, 0.323000, 0.272000 },
  { 0.002400, 0.407300, 0.212300 }, { 0.009300, 0.503000, 0.158200 },
  { 0.029100, 0.608200, 0.111700 }, { 0.063270, 0.710000, 0.078250 },
  { 0.109600, 0.793200, 0.057250 }, { 0.165500, 0.862000, 0.042160 },
  { 0.225750, 0.914850, 0.029840 }, { 0.290400, 0.954000, 0.020300 },
  { 0.359700, 0.980300, 0.013400 }, { 0.433450, 0.994950, 0.008750 },
  { 0.512050, 1.000000, 0.005750 }, { 0.594500, 0.995000, 0.003900 },
  { 0.678400, 0.978600, 0.002750 }, { 0.762100, 0.952000, 0.002100 },
  { 0.842500, 0.915400, 0.001800 }, { 0.916300, 0.870000, 0.001650 },
  { 0.978600, 0.816300, 0.001400 }, { 1.026300, 0.757000, 0.001100 },
  { 1.056700, 0.694900, 0.001000 }, { 1.062200, 0.631000, 0.000800 },
  { 1.045600, 0.566800, 0.000600 }, { 1.002600, 0.503000, 0.000340 },
  { 0.938400, 0.441200, 0.000240 }, { 0.854450, 0.381000, 0.000190 },
  { 0.751400, 0.321000, 0.000100 }, { 0.642400, 0.265000, 0.000050 },
  { 0.541900, 0.217000, 0.000030 }, { 0.447900, 0.175000, 0.000020 },
  { 0.360800, 0.138200, 0.000010 }, { 0.283500, 0.107000, 0.000000 },
  { 0.218700, 0.081600, 0.000000 }, { 0.164900, 0.061000, 0.000000 },
  { 0.121200, 0.044580, 0.000000 }, { 0.087400, 0.032000, 0.000000 },
  { 0.063600, 0.023200, 0.000000 }, { 0.046770, 0.017000, 0.000000 },
  { 0.032900, 0.011920, 0.000000 }, { 0.022700, 0.008210, 0.000000 },
  { 0.015840, 0.005723, 0.000000 }, { 0.011359, 0.004102, 0.000000 },
  { 0.008111, 0.002929, 0.000000 }, { 0.005790, 0.002091, 0.000000 },
  { 0.004109, 0.001484, 0.000000 }, { 0.002899, 0.001047, 0.000000 },
  { 0.002049, 0.000740, 0.000000 }, { 0.001440, 0.000520, 0.000000 },
  { 0.001000, 0.000361, 0.000000 }, { 0.000690, 0.000249, 0.000000 },
  { 0.000476, 0.000172, 0.000000 }, { 0.000332, 0.000120, 0.000000 },
  { 0.000235, 0.000085, 0.000000 }, { 0.000166, 0.000060, 0.000000 },
  { 0.000117, 0.000042, 0.000000 }, { 0.000083, 0.000030, 0.000000 },
  { 0.000059, 0.000021, 0.000000 }, { 0.000042, 0.000015, 0.000000 } } };

/// D65, 380 to 780 nm.
constexpr std::array<double, Nodes> Daylight{ 49.9755, 52.3118, 54.6482, 68.7015, 82.7549, 87.1204,
  91.486, 92.4589, 93.4318, 90.057, 86.6823, 95.7736, 104.865, 110.936, 117.008, 117.41, 117.812,
  116.336, 114.861, 115.392, 115.923, 112.367, 108.811, 109.082, 109.354, 108.578, 107.802, 106.296,
  104.79, 106.239, 107.689, 106.047, 104.405, 104.225, 104.046, 102.023, 100, 98.1671, 96.3342,
  96.0611, 95.788, 92.2368, 88.6856, 89.3459, 90.0062, 89.8026, 89.5991, 88.6489, 87.6987, 85.4936,
  83.2886, 83.4939, 83.6992, 81.863, 80.0268, 80.1207, 80.2146, 81.2462, 82.2778, 80.281, 78.2842,
  74.0027, 69.7213, 70.6652, 71.6091, 72.979, 74.349, 67.9765, 61.604, 65.7448, 69.8856, 72.4863,
  75.087, 69.3398, 63.5927, 55.0054, 46.4182, 56.6118, 66.8054, 65.0941, 63.3828 };

/// The matrix of the primaries (0.64, 0.33), (0.30, 0.60), (0.15, 0.06) and the white
/// (0.3127, 0.3290) with Y = 1, and its inverse; 16 digits of the exact rational numbers.
constexpr std::array<double, 9> RgbToXyz{ 0.4123907992659595, 0.3575843393838780,
  0.1804807884018343, 0.2126390058715104, 0.7151686787677559, 0.07219231536073372,
  0.01933081871559185, 0.1191947797946260, 0.9505321522496607 };
constexpr std::array<double, 9> XyzToRgb{ 3.240969941904521, -1.537383177570093,
  -0.4986107602930033, -0.9692436362808798, 1.875967501507721, 0.04155505740717561,
  0.05563007969699361, -0.2039769588889766, 1.056971514242879 };

Triple Times(const std::array<double, 9>& m, const Triple& v)
{
  return { m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
    m[6] * v[0] + m[7] * v[1] + m[8] * v[2] };
}

bool InTable(double wavelength)
{
  return wavelength >= FirstVisibleWavelength && wavelength <= LastVisibleWavelength;
}

/// The node at or below a wavelength of the table, and how far it is to the next, in [0, 1].
int Node(double wavelength, double& fraction)
{
  const double position = (wavelength - FirstVisibleWavelength) / Step;
  const int node = std::min(static_cast<int>(position), Nodes - 2);
  fraction = position - node;
  return node;
}

double Between(double a, double b, double fraction) { return a + fraction * (b - a); }

/// The value between the nodes of a table.
Triple Interpolated(const std::array<Triple, Nodes>& table, double wavelength)
{
  if (!InTable(wavelength))
  {
    return {};
  }
  double f = 0.0;
  const int node = Node(wavelength, f);
  Triple value;
  for (int c = 0; c < 3; ++c)
  {
    value[c] = Between(table[node][c], table[node + 1][c], f);
  }
  return value;
}

/// The integral of a table, linear between its nodes: the trapezium of each interval.
Triple Integrate(const std::array<Triple, Nodes>& table, double from, double to)
{
  from = std::max(from, FirstVisibleWavelength);
  to = std::min(to, LastVisibleWavelength);
  Triple sum{};
  while (from < to)
  {
    const double next =
      FirstVisibleWavelength + Step * (std::floor((from - FirstVisibleWavelength) / Step) + 1.0);
    const double end = std::min(next, to);
    const Triple a = Interpolated(table, from);
    const Triple b = Interpolated(table, end);
    for (int c = 0; c < 3; ++c)
    {
      sum[c] += 0.5 * (end - from) * (a[c] + b[c]);
    }
    from = end;
  }
  return sum;
}

/// The functions times D65, node by node, so that all of it is the white that the CIE's sums give.
std::array<Triple, Nodes> UnderDaylight()
{
  std::array<Triple, Nodes> table = Table;
  for (int node = 0; node < Nodes; ++node)
  {
    for (double& value : table[node])
    {
      value *= Daylight[node];
    }
  }
  return table;
}

/// The order of the wavelengths from short to long. Fails as SpectralColor does.
std::vector<int> Sorted(const double* wavelengths, int bands)
{
  if (bands < 1)
  {
    throw InputError("Wavelengths", -1, std::to_string(bands) + " values", "one for each band");
  }
  for (int b = 0; b < bands; ++b)
  {
    if (!(wavelengths[b] >= 10.0 && wavelengths[b] <= 1e6))
    {
      throw InputError(
        "Wavelengths", b, wavelengths[b], "the centre of a band in nanometres, 10 to 1e6");
    }
  }
  std::vector<int> order(static_cast<std::size_t>(bands));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [wavelengths](int a, int b) { return wavelengths[a] < wavelengths[b]; });
  for (int i = 1; i < bands; ++i)
  {
    if (!(wavelengths[order[i - 1]] < wavelengths[order[i]]))
    {
      throw InputError("Wavelengths", std::max(order[i - 1], order[i]), wavelengths[order[i]],
        "a wavelength that no other band has");
    }
  }
  return order;
}

std::vector<std::array<double, 2>> BandEdges(
  const double* wavelengths, const std::vector<int>& order)
{
  const int bands = static_cast<int>(order.size());
  std::vector<std::array<double, 2>> edges(order.size());
  for (int i = 0; i < bands; ++i)
  {
    const double centre = wavelengths[order[i]];
    const double below = i > 0 ? centre - wavelengths[order[i - 1]] : -1.0;
    const double above = i + 1 < bands ? wavelengths[order[i + 1]] - centre : -1.0;
    const double down = bands == 1 ? 0.0 : below > 0.0 ? below : above;
    const double up = bands == 1 ? 0.0 : above > 0.0 ? above : below;
    edges[order[i]] = { centre - 0.5 * down, centre + 0.5 * up };
  }
  return edges;
}

/// X, Y, Z of a 1 in the band.
Triple Weight(double centre, const std::array<double, 2>& edges, BandValues values)
{
  const double width = edges[1] - edges[0];
  if (values == BandValues::Lines || (values == BandValues::Power && !(width > 0.0)))
  {
    return ColorMatchingFunctions(centre);
  }
  Triple weight = ColorMatchingIntegral(edges[0], edges[1]);
  for (double& w : weight)
  {
    w /= values == BandValues::Power ? width : 1.0;
  }
  return weight;
}

/// The same for reflectances.
Triple ReflectedWeight(double lower, double upper, Illuminant illuminant)
{
  static const std::array<Triple, Nodes> daylight = UnderDaylight();
  const auto& table = illuminant == Illuminant::D65 ? daylight : Table;
  Triple weight = Integrate(table, lower, upper);
  const Triple whole = Integrate(table, FirstVisibleWavelength, LastVisibleWavelength);
  for (double& w : weight)
  {
    w /= whole[1];
  }
  return weight;
}

} // namespace

Triple ColorMatchingFunctions(double wavelength) { return Interpolated(Table, wavelength); }

double LuminousEfficiency(double wavelength) { return ColorMatchingFunctions(wavelength)[1]; }

Triple ColorMatchingIntegral(double from, double to) { return Integrate(Table, from, to); }

double IlluminantD65(double wavelength)
{
  if (!InTable(wavelength))
  {
    return 0.0;
  }
  double f = 0.0;
  const int node = Node(wavelength, f);
  return Between(Daylight[node], Daylight[node + 1], f);
}

Triple XyzToLinearRec709(const Triple& xyz) { return Times(XyzToRgb, xyz); }

Triple LinearRec709ToXyz(const Triple& rgb) { return Times(RgbToXyz, rgb); }

Triple FitGamut(const Triple& rgb, Gamut gamut)
{
  const double least = std::min({ rgb[0], rgb[1], rgb[2] });
  if (gamut == Gamut::Keep || !(least < 0.0))
  {
    return rgb;
  }
  const double luminance = LinearRec709ToXyz(rgb)[1];
  Triple result{};
  for (int c = 0; c < 3; ++c)
  {
    if (gamut == Gamut::Clip)
    {
      result[c] = std::max(0.0, rgb[c]);
    }
    else if (luminance > 0.0)
    {
      // The least channel comes to 0; rounding must not leave it below.
      const double part = luminance / (luminance - least);
      result[c] = std::max(0.0, luminance + part * (rgb[c] - luminance));
    }
  }
  return result;
}

SpectralColor::SpectralColor(
  const double* wavelengths, int bands, BandValues values, Illuminant illuminant)
{
  const std::vector<int> order = Sorted(wavelengths, bands);
  if (bands == 1 && values == BandValues::PerNanometre)
  {
    throw InputError("Wavelengths", 0, wavelengths[0],
      "two bands or more where values are a nanometre: one alone has no width");
  }
  this->Edges = BandEdges(wavelengths, order);
  for (int b = 0; b < bands; ++b)
  {
    if (values == BandValues::Reflectance)
    {
      // What the bands leave out of the visible counts to the nearest band that reaches into it.
      const auto& edges = this->Edges[b];
      const bool seen = edges[1] > FirstVisibleWavelength && edges[0] < LastVisibleWavelength;
      this->Xyz.push_back(
        ReflectedWeight(seen && b == order.front() ? FirstVisibleWavelength : edges[0],
          seen && b == order.back() ? LastVisibleWavelength : edges[1], illuminant));
    }
    else
    {
      this->Xyz.push_back(Weight(wavelengths[b], this->Edges[b], values));
    }
    this->Rgb.push_back(XyzToLinearRec709(this->Xyz.back()));
  }
}

Triple SpectralColor::ToXyz(const double* values) const
{
  Triple sum{};
  for (std::size_t b = 0; b < this->Xyz.size(); ++b)
  {
    for (int c = 0; c < 3; ++c)
    {
      sum[c] += values[b] * this->Xyz[b][c];
    }
  }
  return sum;
}

Triple SpectralColor::ToRgb(const double* values) const
{
  return XyzToLinearRec709(this->ToXyz(values));
}

double SpectralColor::ToPhotometric(const double* values) const
{
  return units::MaximumLuminousEfficacy * this->ToXyz(values)[1];
}

Triple ColorOfBands(const double* values, int bands, const SpectralColor* spectrum)
{
  if (bands == 3)
  {
    return { values[0], values[1], values[2] };
  }
  if (bands != 1 && spectrum && spectrum->GetBands() == bands)
  {
    return spectrum->ToRgb(values);
  }
  double sum = 0.0;
  for (int b = 0; b < bands; ++b)
  {
    sum += values[b];
  }
  const double grey = bands > 0 ? sum / bands : 0.0;
  return { grey, grey, grey };
}

} // namespace imaging
} // namespace radiometry
