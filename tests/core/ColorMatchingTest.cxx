// SPDX-License-Identifier: BSD-3-Clause
// CIE 1931 colour matching: published chromaticities, closed forms, invariants of the bands.
#include "radiometry/imaging/ColorMatching.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <random>
#include <sstream>

using namespace radiometry;
using namespace radiometry::imaging;

namespace
{

std::vector<double> Every(double from, double to, double step)
{
  std::vector<double> list;
  for (double w = from; w <= to + 1e-9; w += step)
  {
    list.push_back(w);
  }
  return list;
}

SpectralColor Bands(const std::vector<double>& wavelengths, BandValues values = BandValues::Power,
  Illuminant illuminant = Illuminant::D65)
{
  return { wavelengths.data(), static_cast<int>(wavelengths.size()), values, illuminant };
}

template <typename Function>
std::vector<double> Sampled(const std::vector<double>& wavelengths, const Function& f)
{
  std::vector<double> values;
  for (double w : wavelengths)
  {
    values.push_back(f(w));
  }
  return values;
}

void ExpectChromaticity(const Triple& xyz, double x, double y, double tolerance)
{
  const double sum = xyz[0] + xyz[1] + xyz[2];
  EXPECT_NEAR(xyz[0] / sum, x, tolerance);
  EXPECT_NEAR(xyz[1] / sum, y, tolerance);
}

void ExpectTriple(const Triple& a, const Triple& b, double tolerance)
{
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
  }
}

/// Planck's law, relative, with the second radiation constant c2 in m K.
double Planck(double nanometres, double kelvin, double c2)
{
  const double metres = nanometres * 1e-9;
  return 1e-35 / (std::pow(metres, 5) * std::expm1(c2 / (metres * kelvin)));
}

/// Array and index that an error names.
template <typename Body>
std::string Fault(const Body& body)
{
  try
  {
    body();
  }
  catch (const InputError& e)
  {
    return e.Array + " " + std::to_string(e.Index);
  }
  return "";
}

} // namespace

TEST(ColorMatching, IntegralsAreThoseOfTheStandardObserver)
{
  // The three functions have equal areas by construction; CIE 015 gives 106.857 nm for y-bar.
  const Triple whole = ColorMatchingIntegral(380, 780);
  EXPECT_NEAR(whole[1], 106.857, 1e-3);
  EXPECT_NEAR(whole[0] / whole[1], 1.0, 2e-4);
  EXPECT_NEAR(whole[2] / whole[1], 1.0, 2e-4);
  ExpectTriple(ColorMatchingIntegral(-1e9, 1e9), whole, 1e-12);
}

TEST(ColorMatching, IntegralIsAdditiveAndThatOfTheFunctions)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(350, 820);
  for (int i = 0; i < 200; ++i)
  {
    double cut[3] = { anywhere(random), anywhere(random), anywhere(random) };
    std::sort(cut, cut + 3);
    const Triple a = ColorMatchingIntegral(cut[0], cut[1]);
    const Triple b = ColorMatchingIntegral(cut[1], cut[2]);
    const Triple both = ColorMatchingIntegral(cut[0], cut[2]);
    ExpectTriple({ a[0] + b[0], a[1] + b[1], a[2] + b[2] }, both, 1e-11);
  }
  // Inside one interval of the table: the trapezium.
  const Triple low = ColorMatchingFunctions(551);
  const Triple high = ColorMatchingFunctions(554);
  const Triple part = ColorMatchingIntegral(551, 554);
  ExpectTriple(
    part, { 1.5 * (low[0] + high[0]), 1.5 * (low[1] + high[1]), 1.5 * (low[2] + high[2]) }, 1e-12);
}

TEST(ColorMatching, VIsOneAt555AndNothingOutside)
{
  EXPECT_EQ(LuminousEfficiency(555), 1.0);
  EXPECT_NEAR(LuminousEfficiency(557.5), 0.5 * (1.0 + 0.995), 1e-12);
  EXPECT_EQ(LuminousEfficiency(780), 0.000015);
  for (double w : { 379.999, 780.001, 0.0, -1.0, 1e9, double(NAN), double(INFINITY) })
  {
    ExpectTriple(ColorMatchingFunctions(w), { 0, 0, 0 }, 0);
    EXPECT_EQ(IlluminantD65(w), 0.0);
  }
  // Brightest at 555 nm.
  for (double w = 380; w <= 780; w += 0.25)
  {
    EXPECT_LE(LuminousEfficiency(w), 1.0);
    EXPECT_GE(LuminousEfficiency(w), 0.0);
  }
}

TEST(ColorMatching, PublishedWhites)
{
  const auto grid = Every(380, 780, 5);
  // Sums over the nodes of the table, as the CIE prints them.
  const SpectralColor color = Bands(grid, BandValues::Lines);
  // Equal energy: a third each.
  const std::vector<double> equal(grid.size(), 1.0);
  ExpectChromaticity(color.ToXyz(equal.data()), 1.0 / 3, 1.0 / 3, 2e-5);
  // D65: CIE 015, (0.31272, 0.32903).
  const auto sky = Sampled(grid, IlluminantD65);
  ExpectChromaticity(color.ToXyz(sky.data()), 0.31272, 0.32903, 1e-5);
  // A: Planck's law at 2848 K with the old c2 = 1.435e-2 m K, (0.44758, 0.40745); with today's c2 it
  // is a black body of 2855.5 K.
  const auto a = Sampled(grid, [](double w) { return Planck(w, 2848, 1.435e-2); });
  ExpectChromaticity(color.ToXyz(a.data()), 0.44758, 0.40745, 1e-5);
  const auto body = Sampled(grid, [](double w) { return Planck(w, 2855.5, 1.438776877e-2); });
  ExpectChromaticity(color.ToXyz(body.data()), 0.4476, 0.4074, 1e-4);
  // Bands of 5 nm smooth the functions a little.
  const SpectralColor bands = Bands(grid, BandValues::PerNanometre);
  ExpectChromaticity(bands.ToXyz(sky.data()), 0.31272, 0.32903, 5e-5);
  ExpectChromaticity(bands.ToXyz(a.data()), 0.44758, 0.40745, 5e-5);
}

TEST(ColorMatching, MonochromaticLoci)
{
  // Chromaticity coordinates of the spectrum locus, CIE 015 table T.3.
  const double locus[][3] = { { 400, 0.1733, 0.0048 }, { 450, 0.1566, 0.0177 },
    { 480, 0.0913, 0.1327 }, { 500, 0.0082, 0.5384 }, { 520, 0.0743, 0.8338 },
    { 550, 0.3016, 0.6923 }, { 580, 0.5125, 0.4866 }, { 600, 0.6270, 0.3725 },
    { 650, 0.7260, 0.2740 }, { 700, 0.7347, 0.2653 } };
  for (const auto& row : locus)
  {
    const SpectralColor line(&row[0], 1);
    const double one = 1.0;
    ExpectChromaticity(line.ToXyz(&one), row[1], row[2], 6e-5);
    // No spectral colour lies in Rec.709: kept, not clipped.
    const Triple rgb = line.ToRgb(&one);
    EXPECT_LT(*std::min_element(rgb.begin(), rgb.end()), 0.0) << row[0];
  }
}

TEST(ColorMatching, LuminanceIsKmTimesV)
{
  for (double w : { 507.0, 532.0, 555.0, 589.3, 633.0 })
  {
    const double one = 1.0;
    const SpectralColor line(&w, 1);
    EXPECT_NEAR(line.ToPhotometric(&one), 683.002 * LuminousEfficiency(w), 1e-10);
    // And by way of RGB with the exact weights of its primaries.
    EXPECT_NEAR(683.002 * LinearRec709ToXyz(line.ToRgb(&one))[1], line.ToPhotometric(&one), 1e-9);
  }
  // A black body of 2041.4 K (platinum's freezing point, the old candela): 60 cd/cm^2.
  const auto grid = Every(380, 780, 1);
  const SpectralColor color = Bands(grid, BandValues::PerNanometre);
  const double h = 6.62607015e-34, c = 299792458.0, k = 1.380649e-23;
  const auto radiance = Sampled(grid, [&](double nm) {
    const double m = nm * 1e-9;
    return 2 * h * c * c / (std::pow(m, 5) * std::expm1(h * c / (m * k * 2041.4))) * 1e-9;
  });
  EXPECT_NEAR(color.ToPhotometric(radiance.data()), 6.0e5, 0.01 * 6.0e5);
}

TEST(ColorMatching, MatrixIsThatOfTheWhiteAndThePrimaries)
{
  ExpectTriple(XyzToLinearRec709({ 0.3127 / 0.3290, 1.0, 0.3583 / 0.3290 }), { 1, 1, 1 }, 2e-15);
  const double primaries[3][2] = { { 0.64, 0.33 }, { 0.30, 0.60 }, { 0.15, 0.06 } };
  for (int p = 0; p < 3; ++p)
  {
    Triple rgb{};
    rgb[p] = 1.0;
    ExpectChromaticity(LinearRec709ToXyz(rgb), primaries[p][0], primaries[p][1], 1e-15);
    ExpectTriple(XyzToLinearRec709(LinearRec709ToXyz(rgb)), rgb, 1e-14);
  }
}

TEST(SpectralColor, EdgesAreHalfWayWhateverTheSpacing)
{
  const std::vector<double> wavelengths{ 600, 400, 450 };
  const auto color = Bands(wavelengths);
  const auto& edges = color.GetEdges();
  EXPECT_EQ(edges[0], (std::array<double, 2>{ 525, 675 }));
  EXPECT_EQ(edges[1], (std::array<double, 2>{ 375, 425 }));
  EXPECT_EQ(edges[2], (std::array<double, 2>{ 425, 525 }));
  // Power in a band: the mean of the functions over it; a density: their integral.
  const Triple integral = ColorMatchingIntegral(425, 525);
  ExpectTriple(
    color.GetXyzWeights()[2], { integral[0] / 100, integral[1] / 100, integral[2] / 100 }, 1e-14);
  ExpectTriple(Bands(wavelengths, BandValues::PerNanometre).GetXyzWeights()[2], integral, 1e-12);
  ExpectTriple(
    Bands(wavelengths, BandValues::Lines).GetXyzWeights()[2], ColorMatchingFunctions(450), 0);
}

TEST(SpectralColor, UnequalBandsOfASmoothSpectrumConverge)
{
  // A ramp of density 1 at 380 nm to 3 at 780 nm in random bands: within what the mean over a band
  // forgets, and four times better with half the width.
  const auto ramp = [](double w) { return 1.0 + (w - 380.0) / 200.0; };
  const auto fine = Every(380, 780, 0.5);
  const auto values = Sampled(fine, ramp);
  const Triple exact = Bands(fine, BandValues::PerNanometre).ToXyz(values.data());
  double last = 0;
  for (double width : { 16.0, 4.0 })
  {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> step(0.5 * width, 1.5 * width);
    std::vector<double> centres;
    std::vector<double> power;
    for (double w = 370; w < 800; w += step(random))
    {
      centres.push_back(w);
    }
    const SpectralColor bands = Bands(centres);
    for (std::size_t b = 0; b < centres.size(); ++b)
    {
      const auto& e = bands.GetEdges()[b];
      power.push_back((e[1] - e[0]) * ramp(0.5 * (e[0] + e[1])));
    }
    const Triple xyz = bands.ToXyz(power.data());
    double worst = 0;
    for (int c = 0; c < 3; ++c)
    {
      worst = std::max(worst, std::abs(xyz[c] / exact[c] - 1.0));
    }
    EXPECT_LT(worst, 2e-3);
    if (last > 0)
    {
      EXPECT_LT(worst, last / 4);
    }
    last = worst;
  }
}

TEST(SpectralColor, PowerAndDensityAgreeAndOrderDoesNotMatter)
{
  std::vector<double> wavelengths{ 700, 380, 410, 555, 480, 640, 600, 520, 300, 1000 };
  std::vector<double> density{ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10 };
  const SpectralColor a = Bands(wavelengths, BandValues::PerNanometre);
  const SpectralColor b = Bands(wavelengths, BandValues::Power);
  std::vector<double> power(density);
  for (std::size_t i = 0; i < power.size(); ++i)
  {
    power[i] *= a.GetEdges()[i][1] - a.GetEdges()[i][0];
  }
  const Triple expected = a.ToXyz(density.data());
  ExpectTriple(b.ToXyz(power.data()), expected, 1e-10);
  ExpectTriple(b.ToRgb(power.data()), XyzToLinearRec709(expected), 1e-9);
  std::reverse(wavelengths.begin(), wavelengths.end());
  std::reverse(density.begin(), density.end());
  ExpectTriple(Bands(wavelengths, BandValues::PerNanometre).ToXyz(density.data()), expected, 1e-10);
}

TEST(SpectralColor, BeyondTheVisibleThereIsNoColour)
{
  const std::vector<double> wavelengths{ 250, 300, 2000, 4000, 10000 };
  const std::vector<double> ones(5, 1.0);
  for (BandValues kind : { BandValues::PerNanometre, BandValues::Lines })
  {
    const auto color = Bands({ 250, 300, 350 }, kind);
    ExpectTriple(color.ToXyz(ones.data()), { 0, 0, 0 }, 0);
    EXPECT_EQ(color.ToPhotometric(ones.data()), 0.0);
  }
  ExpectTriple(Bands({ 2000, 4000, 10000 }).ToXyz(ones.data()), { 0, 0, 0 }, 0);
  ExpectTriple(Bands({ 1000, 1100 }, BandValues::Reflectance).ToXyz(ones.data()), { 0, 0, 0 }, 0);
  // A part of a band: 700 to 900 nm counts by its visible 80 nm.
  const Triple part = ColorMatchingIntegral(700, 780);
  ExpectTriple(Bands({ 600, 800 }, BandValues::PerNanometre).GetXyzWeights()[1], part, 1e-14);
}

TEST(SpectralColor, ReflectanceOfWhite)
{
  for (const auto& list : { Every(380, 780, 5), Every(400, 700, 10),
         std::vector<double>{ 450, 470, 550, 640 }, std::vector<double>{ 550 } })
  {
    const std::vector<double> ones(list.size(), 1.0);
    // The table's D65 is (0.31272, 0.32903), the white of Rec.709 (0.3127, 0.3290): 3.4e-4 in Z.
    ExpectTriple(Bands(list, BandValues::Reflectance).ToRgb(ones.data()), { 1, 1, 1 }, 4e-4);
    EXPECT_NEAR(Bands(list, BandValues::Reflectance).ToXyz(ones.data())[1], 1.0, 1e-13);
    ExpectTriple(Bands(list, BandValues::Reflectance, Illuminant::EqualEnergy).ToXyz(ones.data()),
      { 1, 1, 1 }, 2e-4);
  }
}

TEST(SpectralColor, CornellBoxIsThatOfMitsuba)
{
  const std::string file = RADIOMETRY_SHARED_DATA "/mesh/cornell/cornell_measured_spectra.csv";
  if (!std::filesystem::exists(file))
  {
    GTEST_SKIP() << "no " << file;
  }
  std::ifstream stream(file);
  std::vector<double> wavelengths;
  std::array<std::vector<double>, 3> walls;
  for (std::string line; std::getline(stream, line);)
  {
    std::istringstream text(line);
    double nm, white, green, red;
    char comma;
    if (text >> nm >> comma >> white >> comma >> green >> comma >> red)
    {
      wavelengths.push_back(nm);
      walls[0].push_back(white);
      walls[1].push_back(green);
      walls[2].push_back(red);
    }
  }
  ASSERT_EQ(wavelengths.size(), 76u);
  // Mitsuba's scene "cbox" states the walls in linear sRGB for the illuminant E, not adapted.
  const Triple mitsuba[3] = { { 0.885809, 0.698859, 0.666422 }, { 0.105421, 0.37798, 0.076425 },
    { 0.570068, 0.0430135, 0.0443706 } };
  for (int w = 0; w < 3; ++w)
  {
    const auto e = Bands(wavelengths, BandValues::Reflectance, Illuminant::EqualEnergy);
    ExpectTriple(e.ToRgb(walls[w].data()), mitsuba[w], 0.005);
    // Under D65, which a renderer in Rec.709 wants, luminance moves little and grey stays grey.
    const auto d65 = Bands(wavelengths, BandValues::Reflectance);
    const Triple rgb = d65.ToRgb(walls[w].data());
    std::cout << "under D65: " << rgb[0] << " " << rgb[1] << " " << rgb[2] << "\n";
    if (w == 0)
    {
      EXPECT_LT(
        *std::max_element(rgb.begin(), rgb.end()) - *std::min_element(rgb.begin(), rgb.end()),
        0.005);
    }
  }
}

TEST(SpectralColor, BadWavelengthsAreNamed)
{
  const auto fault = [](std::vector<double> list, BandValues values = BandValues::Power) {
    return Fault([&] { Bands(list, values); });
  };
  EXPECT_EQ(fault({}), "Wavelengths -1");
  EXPECT_EQ(fault({ 500, NAN }), "Wavelengths 1");
  EXPECT_EQ(fault({ INFINITY, 500 }), "Wavelengths 0");
  EXPECT_EQ(fault({ 500, -1 }), "Wavelengths 1");
  EXPECT_EQ(fault({ 0.38, 0.55 }), "Wavelengths 0") << "micrometres";
  EXPECT_EQ(fault({ 500, 600, 500 }), "Wavelengths 2");
  EXPECT_EQ(fault({ 500 }, BandValues::PerNanometre), "Wavelengths 0");
  EXPECT_EQ(fault({ 500 }), "");
}

TEST(SpectralColor, OneRuleForAnyNumberOfBands)
{
  const double values[4] = { 1, 2, 3, 6 };
  const SpectralColor four = Bands({ 450, 500, 550, 600 });
  ExpectTriple(ColorOfBands(values, 1), { 1, 1, 1 }, 0);
  ExpectTriple(ColorOfBands(values, 3), { 1, 2, 3 }, 0);
  ExpectTriple(ColorOfBands(values, 3, &four), { 1, 2, 3 }, 0);
  ExpectTriple(ColorOfBands(values, 4), { 3, 3, 3 }, 0);
  ExpectTriple(ColorOfBands(values, 4, &four), four.ToRgb(values), 0);
  ExpectTriple(ColorOfBands(values, 2, &four), { 1.5, 1.5, 1.5 }, 0);
  const auto& weights = four.GetRgbWeights();
  Triple sum{};
  for (int b = 0; b < 4; ++b)
  {
    for (int c = 0; c < 3; ++c)
    {
      sum[c] += values[b] * weights[b][c];
    }
  }
  ExpectTriple(sum, four.ToRgb(values), 1e-12);
}

TEST(ColorMatching, GamutIsKeptClippedOrDesaturated)
{
  const Triple green = { -0.5, 1.0, -0.1 };
  ExpectTriple(FitGamut(green, Gamut::Keep), green, 0);
  ExpectTriple(FitGamut(green, Gamut::Clip), { 0, 1, 0 }, 0);
  const Triple pale = FitGamut(green, Gamut::Desaturate);
  EXPECT_NEAR(LinearRec709ToXyz(pale)[1], LinearRec709ToXyz(green)[1], 1e-15);
  EXPECT_EQ(*std::min_element(pale.begin(), pale.end()), pale[0]);
  EXPECT_NEAR(pale[0], 0.0, 1e-15);
  const Triple inside = { 0.0, 2.0, 0.3 };
  ExpectTriple(FitGamut(inside, Gamut::Desaturate), inside, 0);
  ExpectTriple(FitGamut({ -1, 0.1, 0.1 }, Gamut::Desaturate), { 0, 0, 0 }, 0);
}
