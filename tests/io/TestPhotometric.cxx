// SPDX-License-Identifier: BSD-3-Clause
// Luminaire files: what real ones say, each version's openings, every symmetry, damaged ones.
#include "io/PhotometricFile.h"
#include "io/PhotometricParts.h"
#include "io/PhotometricShapes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sstream>
#include <unistd.h>

using namespace radiometry;
using namespace radiometry::io;
namespace fs = std::filesystem;

namespace
{

const double Pi = std::acos(-1.0);

/// A folder for the files of this run, gone when it ends.
struct Folder
{
  const fs::path Path = fs::path(testing::TempDir()) / ("photometric-" + std::to_string(::getpid()));
  Folder() { fs::create_directories(this->Path); }
  ~Folder()
  {
    std::error_code error;
    fs::remove_all(this->Path, error);
  }
};

std::string Write(const std::string& name, const std::string& text)
{
  static const Folder folder;
  const std::string file = (folder.Path / name).string();
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

/// An IES file with these lines after TILT=NONE's header of 13 numbers.
std::string Ies(const std::string& first = "IESNA:LM-63-2002", const std::string& numbers = "1 1000 1",
  const std::string& size = "0.5 1.5 0", const std::string& factors = "1 1 40",
  const std::string& web = "3 1 1 2", const std::string& angles = "0 45 90\n0\n",
  const std::string& values = "100 80 0\n", const std::string& tilt = "NONE")
{
  return first + "\n[TEST] 1\n[MANUFAC] Ours\nTILT=" + tilt + "\n" + numbers + " " + web + " " + size +
    "\n" + factors + "\n" + angles + values;
}

/// An EULUMDAT file of one function of C and gamma (degrees), in cd/klm.
template <typename Function>
std::string Ldt(int symmetry, int planes, const Function& f, const std::string& lamps = "1")
{
  std::ostringstream text;
  const double dc = 360.0 / planes;
  text << "Ours\n2\n" << symmetry << "\n" << planes << "\n" << dc << "\n37\n5\nR1\nLamp of ours\n77\nours.ldt\nnow\n"
       << "1200\n100\n60\n1100\n80\n0\n0\n0\n0\n100\n90\n1\n0\n1\n" << lamps << "\nLED\n2000\n840\n80\n20\n";
  for (int k = 0; k < 10; ++k)
  {
    text << "0.5\n";
  }
  for (int c = 0; c < planes; ++c)
  {
    text << c * dc << "\n";
  }
  for (int g = 0; g < 37; ++g)
  {
    text << 5 * g << "\n";
  }
  const int from = symmetry == 3 ? 3 * planes / 4 : 0;
  const int count = symmetry == 0 ? planes : (symmetry == 1 ? 1 : (symmetry == 4 ? planes / 4 + 1 : planes / 2 + 1));
  for (int c = 0; c < count; ++c)
  {
    for (int g = 0; g < 37; ++g)
    {
      text.precision(12);
      text << f((from + c) % planes * dc, 5.0 * g) << "\n";
    }
  }
  return text.str();
}

std::string Message(const std::string& file, const PhotometricOptions& options = {})
{
  try
  {
    ReadPhotometricFile(file, options);
  }
  catch (const FileError& error)
  {
    return error.what();
  }
  return "read";
}

void ExpectFails(const std::string& text, const std::string& words, const std::string& name = "bad.ies")
{
  const std::string message = Message(Write(name, text));
  EXPECT_NE(message.find(words), std::string::npos) << message << "\n  has no \"" << words << "\"";
}

TEST(PhotometricFile, RealIesFiles)
{
  const std::string folder = RADIOMETRY_SHARED_DATA "/photometry/ies/";
  if (!fs::exists(folder))
  {
    GTEST_SKIP() << "no " << folder;
  }
  struct Case
  {
    const char* Name;
    double Flux;
    double Within;
    const char* Unit;
    std::size_t Warnings;
  };
  // Fluxes as their publishers or other programs sum them up, where those are known.
  const Case cases[] = { { "examp1", 5297.39, 1e-3, "lm", 0 }, { "B1 module", 121.66, 5e-3, "mW", 1 },
    { "B1.5 module", 47.46, 2e-3, "mW", 1 }, { "aerolamp", 98.26, 1e-3, "mW", 0 },
    { "LLIA001477-002", 53.57, 1e-3, "mW", 0 }, { "ushio_b1", 118.83, 1e-3, "mW", 0 },
    { "uvpro222_b1", 107.54, 1e-3, "mW", 0 }, { "visium", 32.29, 1e-3, "mW", 0 },
    { "lumenizer_zone", 162.21, 1e-3, "mW", 0 }, { "absolute_photometry", 904.52, 1e-3, "lm", 0 },
    { "relative_photometry", 904.52, 1e-3, "lm", 1 },
    { "relative_photometry_with_multiplier", 1356.79, 1e-3, "lm", 1 } };
  for (const Case& c : cases)
  {
    const PhotometricFile file = ReadPhotometricFile(folder + c.Name + ".ies");
    EXPECT_NEAR(file.FluxFromWeb / c.Flux, 1.0, c.Within) << c.Name;
    EXPECT_STREQ(file.FluxUnit(), c.Unit) << c.Name;
    EXPECT_EQ(file.Warnings.size(), c.Warnings) << c.Name;
  }
  const PhotometricFile b1 = ReadPhotometricFile(folder + "B1 module.ies");
  EXPECT_EQ(b1.FluxStated, 91.6);
  EXPECT_NE(b1.Warnings.at(0).find("121.1"), std::string::npos) << b1.Warnings.at(0);
  EXPECT_NE(b1.Warnings.at(0).find("91.6 mW"), std::string::npos);
  EXPECT_NEAR(b1.Factor, 1.32, 1e-15);
  PhotometricOptions candela;
  candela.Units = IntensityUnits::Candela;
  EXPECT_STREQ(ReadPhotometricFile(folder + "B1 module.ies", candela).FluxUnit(), "lm");

  const PhotometricFile examp1 = ReadPhotometricFile(folder + "examp1.ies");
  EXPECT_EQ(examp1.LampFlux, 5800.0);
  EXPECT_NEAR(examp1.Opening.Size.x, 4.04 * 0.3048, 1e-12);
  EXPECT_NEAR(examp1.Opening.Size.y, 0.85 * 0.3048, 1e-12);
  EXPECT_NEAR(examp1.Opening.Sides[2], 0.292 * 0.3048, 1e-12);
  EXPECT_EQ(examp1.Format, "LM-63-1995");
  EXPECT_EQ(examp1.Keywords.at(0).first, "Label");

  using Opening = LuminousOpening;
  EXPECT_EQ(ReadPhotometricFile(folder + "round_opening.ies").Opening.Shape, Opening::Ellipse);
  EXPECT_EQ(ReadPhotometricFile(folder + "round_opening.ies").Opening.Size.x, 0.12);
  EXPECT_EQ(ReadPhotometricFile(folder + "rectangular_opening.ies").Opening.Shape, Opening::Rectangle);
  const Opening ellipse = ReadPhotometricFile(folder + "ellipse_opening_along_length.ies").Opening;
  EXPECT_EQ(ellipse.Shape, Opening::Ellipse);
  EXPECT_EQ(ellipse.Size, (Vec3{ 0.34, 0.12, 0.56 }));
  EXPECT_NEAR(ReadPhotometricFile(folder + "imperial_units.ies").Opening.Size.x, 0.34 * 0.3048, 1e-15);
  EXPECT_EQ(ReadPhotometricFile(folder + "label_lines.ies").Keyword("MULTILINE"),
    "Test multiline metadata\nShould contain three lines\nDivided by LF characters");
}

TEST(PhotometricFile, RealLdtFiles)
{
  const std::string folder = RADIOMETRY_SHARED_DATA "/photometry/ldt/";
  if (!fs::exists(folder))
  {
    GTEST_SKIP() << "no " << folder;
  }
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder))
  {
    if (entry.path().extension() == ".ldt")
    {
      // Every symmetry, a byte order mark, absolute photometry, empty fields: the web's flux is what
      // the header says. Those of 5 degrees in gamma are the least exact.
      const PhotometricFile file = ReadPhotometricFile(entry.path().string());
      EXPECT_NEAR(file.FluxFromWeb / file.FluxStated, 1.0, 8e-3) << entry.path();
      EXPECT_TRUE(file.Warnings.empty()) << entry.path();
      ++files;
    }
  }
  EXPECT_GE(files, 9);
  const PhotometricFile eight = ReadPhotometricFile(folder + "sample8.ldt");
  EXPECT_NEAR(eight.FluxFromWeb / eight.LampFlux, 0.886291, 2e-5);
  const PhotometricFile six = ReadPhotometricFile(folder + "sample6.ldt");
  EXPECT_NEAR(six.FluxFromWeb / six.LampFlux, 0.999492, 2e-5);
  const PhotometricFile four = ReadPhotometricFile(folder + "sample_04.ldt");
  EXPECT_EQ(four.Opening.Size, (Vec3{ 0.063, 1.48, 0.0 }));
  // Its publisher gives the greatest luminance between 65 and 85 degrees.
  double luminance = 0.0;
  for (const double c : { 0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0 })
  {
    for (const double g : { 65.0, 70.0, 75.0, 80.0, 85.0 })
    {
      luminance = std::max(luminance, four.Greatest * four.Web->IntensityAt(c, g) /
          (1.48 * 0.063 * std::cos(g * Pi / 180)));
    }
  }
  EXPECT_NEAR(luminance / 5603.0, 1.0, 0.02);
  PhotometricOptions second;
  second.LampSet = 1;
  EXPECT_EQ(ReadPhotometricFile(folder + "sample1.ldt", second).LampFlux, 2643.0);
  second.LampSet = 2;
  EXPECT_NE(Message(folder + "sample1.ldt", second).find("LampSet is 2"), std::string::npos);
  EXPECT_LT(ReadPhotometricFile(folder + "sample5.ldt").Lamps, 0.0);
  EXPECT_EQ(ReadPhotometricFile(folder + "sample5.ldt").Manufacturer, "ERCO GmbH");
}

TEST(PhotometricFile, FactorsOfTheVersions)
{
  const auto read = [](const std::string& text) { return ReadPhotometricFile(Write("factors.ies", text)); };
  EXPECT_DOUBLE_EQ(read(Ies()).Greatest, 100.0);
  EXPECT_DOUBLE_EQ(read(Ies("IESNA:LM-63-1995", "1 1000 2", "0 0 0", "0.9 0.8 40")).Greatest, 144.0);
  EXPECT_DOUBLE_EQ(read(Ies("IESNA91", "1 1000 2", "0 0 0", "0.9 0.8 40")).Greatest, 144.0);
  EXPECT_DOUBLE_EQ(read(Ies("A label, as in 1986", "1 1000 2", "0 0 0", "0.9 0.8 40")).Greatest, 144.0);
  // From 2002 on the field is for future use; in 2019 it says how the file came to be.
  EXPECT_DOUBLE_EQ(read(Ies("IESNA:LM-63-2002", "1 1000 2", "0 0 0", "0.9 0.8 40")).Greatest, 180.0);
  const PhotometricFile now = read(Ies("IES:LM-63-2019", "1 1000 2", "0 0 0", "0.9 1.10000 40"));
  EXPECT_DOUBLE_EQ(now.Greatest, 180.0);
  EXPECT_EQ(now.Keyword("FILEGENERATIONTYPE"), "1.1");
  EXPECT_EQ(now.Format, "LM-63-2019");
  EXPECT_EQ(read(Ies("A label")).Format, "LM-63-1986");
  EXPECT_EQ(read(Ies("A label")).Keywords.at(0).second, "A label");
  EXPECT_EQ(now.InputWatts, 40.0);
  EXPECT_EQ(now.LampFlux, 1000.0);
  EXPECT_LT(read(Ies("IESNA:LM-63-2002", "1 -1 1")).LampFlux, 0.0);
}

TEST(PhotometricFile, Tilt)
{
  const std::string table = "1\n3\n0 45 90\n1.0 0.9 0.5\n";
  const std::string included = Write("tilt.ies",
    "IESNA:LM-63-2002\nTILT=INCLUDE\n" + table + "1 1000 1 3 1 1 2 0 0 0 1 1 40\n0 45 90\n0\n100 80 0\n");
  const auto at = [](const std::string& file, double angle) {
    PhotometricOptions options;
    options.TiltAngle = angle;
    return ReadPhotometricFile(file, options).Greatest;
  };
  EXPECT_DOUBLE_EQ(at(included, 0), 100.0);
  EXPECT_DOUBLE_EQ(at(included, 22.5), 95.0);
  EXPECT_DOUBLE_EQ(at(included, 45), 90.0);
  EXPECT_DOUBLE_EQ(at(included, 67.5), 70.0);
  EXPECT_DOUBLE_EQ(at(included, 90), 50.0);
  EXPECT_DOUBLE_EQ(at(included, 120), 50.0);
  EXPECT_DOUBLE_EQ(at(included, -10), 100.0);
  const std::string tilt = Write("some.tlt", table);
  const std::string named = Write("named.ies", Ies("IESNA:LM-63-2002", "1 1000 1", "0 0 0", "1 1 40",
    "3 1 1 2", "0 45 90\n0\n", "100 80 0\n", fs::path(tilt).filename().string()));
  EXPECT_DOUBLE_EQ(at(named, 45), 90.0);
  ExpectFails(Ies("IESNA:LM-63-2002", "1 1000 1", "0 0 0", "1 1 40", "3 1 1 2", "0 45 90\n0\n",
                "100 80 0\n", "nowhere.tlt"),
    "line 4: TILT=nowhere.tlt");
}

TEST(PhotometricFile, Openings)
{
  using O = LuminousOpening;
  struct Case
  {
    double Width, Length, Height;
    int Version;
    O::Shapes Shape;
    Vec3 Size;
  };
  const Case cases[] = { { 0, 0, 0, 2002, O::Point, { 0, 0, 0 } },
    { 1, 2, 0, 1986, O::Rectangle, { 2, 1, 0 } }, { 1, 2, 3, 2019, O::Rectangle, { 2, 1, 3 } },
    { -1, 0, 0, 1995, O::Ellipse, { 1, 1, 0 } }, { -1, -1, 0, 2002, O::Ellipse, { 1, 1, 0 } },
    { -1, -2, 0, 2002, O::Ellipse, { 2, 1, 0 } }, { -1, 2, 0, 1995, O::Ellipse, { 2, 1, 0 } },
    { 1, -2, 0, 1995, O::Ellipse, { 2, 1, 0 } }, { -1, 0, 3, 1995, O::Ellipse, { 1, 1, 3 } },
    { -1, -2, 3, 2002, O::Ellipse, { 2, 1, 3 } }, { -1, 0, -1, 1995, O::Ellipsoid, { 1, 1, 1 } },
    { -1, -1, -1, 2002, O::Ellipsoid, { 1, 1, 1 } }, { -1, -2, -3, 2019, O::Ellipsoid, { 2, 1, 3 } },
    { 0, 2, -1, 1995, O::CylinderX, { 2, 1, 1 } }, { 2, 0, -1, 1995, O::CylinderY, { 1, 2, 1 } },
    { -1, 2, -3, 2002, O::CylinderX, { 2, 1, 3 } }, { 2, -1, -3, 2002, O::CylinderY, { 1, 2, 3 } },
    { -1, 0, -3, 2002, O::UprightEllipse, { 0, 1, 3 } } };
  for (const Case& c : cases)
  {
    const O opening = IesOpening(c.Width, c.Length, c.Height, c.Version);
    EXPECT_EQ(opening.Shape, c.Shape) << c.Width << " " << c.Length << " " << c.Height;
    EXPECT_EQ(opening.Size, c.Size) << c.Width << " " << c.Length << " " << c.Height;
  }
}

TEST(PhotometricFile, ShapesAreToScaleAndFaceWhereTheyLight)
{
  const LuminairePlacement down;
  const auto area = [&](const LuminousOpening& opening, Vec3& sum) {
    const LuminaireMesh mesh = OpeningSurface(opening, down);
    double total = 0.0;
    sum = {};
    for (const auto& polygon : mesh.Polygons)
    {
      Vec3 a;
      for (std::size_t k = 2; k < polygon.size(); ++k)
      {
        const Vec3& p = mesh.Points[polygon[0]];
        a += 0.5 * Cross(mesh.Points[polygon[k - 1]] - p, mesh.Points[polygon[k]] - p);
      }
      total += Length(a);
      sum += a;
    }
    return total;
  };
  Vec3 sum;
  EXPECT_NEAR(area(IesOpening(1, 2, 0, 2002), sum), 2.0, 1e-12);
  EXPECT_NEAR(sum.z, -2.0, 1e-12); // faces down
  EXPECT_NEAR(area(IesOpening(1, 2, 3, 2002), sum), 2.0 + 2 * 3 * (1 + 2), 1e-12);
  EXPECT_NEAR(Length(sum - Vec3{ 0, 0, -2 }), 0.0, 1e-12); // sides face outward: they cancel
  EXPECT_NEAR(area(IesOpening(-2, 0, 0, 1995), sum), Pi, 0.01);
  EXPECT_LT(sum.z, -3.1);
  EXPECT_NEAR(area(IesOpening(-2, 0, -2, 1995), sum), 4 * Pi, 0.06);
  EXPECT_NEAR(Length(sum), 0.0, 1e-12);
  EXPECT_NEAR(area(IesOpening(0, 5, -2, 1995), sum), 2 * Pi * 5, 0.06);
  EXPECT_NEAR(area(IesOpening(5, 0, -2, 1995), sum), 2 * Pi * 5, 0.06);
  EXPECT_NEAR(area(IesOpening(-2, 0, -2, 2002), sum), Pi, 0.01);
  EXPECT_GT(sum.x, 3.1);
  EXPECT_EQ(area(LuminousOpening(), sum), 0.0);

  // The distribution of a Lambertian light is a sphere that touches its centre; of every type the
  // surface turns outward.
  for (const WebType type : { WebType::C, WebType::B, WebType::A })
  {
    std::vector<double> h, v, values;
    for (int k = 0; k <= 36; ++k)
    {
      h.push_back(type == WebType::C ? 10.0 * k : 5.0 * k - 90);
      v.push_back(type == WebType::C ? 2.5 * k : 5.0 * k - 90);
    }
    for (const double x : h)
    {
      for (const double y : v)
      {
        const double c = type == WebType::C ? 1.0 : std::cos(x * Pi / 180);
        values.push_back(std::max(0.0, c * std::cos(y * Pi / 180)));
      }
    }
    const LuminaireMesh solid = DistributionSolid(CandelaWeb(type, h, v, values), down, 2.0);
    double volume = 0.0;
    for (const auto& polygon : solid.Polygons)
    {
      for (std::size_t k = 2; k < polygon.size(); ++k)
      {
        volume += Dot(solid.Points[polygon[0]],
          Cross(solid.Points[polygon[k - 1]], solid.Points[polygon[k]])) / 6.0;
      }
    }
    EXPECT_NEAR(volume, 4.0 / 3.0 * Pi, 0.05) << static_cast<int>(type);
    EXPECT_EQ(solid.Value.size(), solid.Points.size());
  }
  // Samples: equal shares whose centre is the luminaire's.
  for (const LuminousOpening& opening : { IesOpening(1, 2, 0, 2002), IesOpening(-2, 0, 0, 1995) })
  {
    Vec3 centre;
    const std::vector<Vec3> samples = OpeningSamples(opening, down, 4, 6);
    for (const Vec3& p : samples)
    {
      centre += p / 24.0;
      EXPECT_LE(std::fabs(p.x), 0.5 * opening.Size.x);
      EXPECT_LE(std::fabs(p.y), 0.5 * opening.Size.y);
    }
    EXPECT_EQ(samples.size(), 24u);
    EXPECT_LT(Length(centre), 1e-12);
  }
}

TEST(PhotometricFile, EverySymmetryOfLdt)
{
  const auto four = [](double c, double g) {
    return 100 + 50 * std::cos(c * Pi / 90) * std::sin(g * Pi / 180);
  };
  const auto front = [](double c, double g) {
    return 100 + 50 * std::cos(c * Pi / 180) * std::sin(g * Pi / 180);
  };
  const auto right = [](double c, double g) {
    return 100 + 50 * std::sin(c * Pi / 180) * std::sin(g * Pi / 180);
  };
  const auto axial = [](double, double g) { return 100 + 50 * std::cos(g * Pi / 180); };
  const auto same = [](const std::string& a, const std::string& b) {
    const PhotometricFile x = ReadPhotometricFile(Write("x.ldt", a));
    const PhotometricFile y = ReadPhotometricFile(Write("y.ldt", b));
    for (double c = 0; c < 360; c += 7.5)
    {
      for (double g = 0; g <= 180; g += 7)
      {
        EXPECT_NEAR(x.Greatest * x.Web->IntensityAt(c, g), y.Greatest * y.Web->IntensityAt(c, g), 1e-7)
          << c << " " << g;
      }
    }
    EXPECT_NEAR(x.FluxFromWeb, y.FluxFromWeb, 1e-6);
    return x;
  };
  same(Ldt(4, 24, four), Ldt(0, 24, four));
  same(Ldt(2, 24, front), Ldt(0, 24, front));
  same(Ldt(3, 24, right), Ldt(0, 24, right));
  same(Ldt(1, 24, axial), Ldt(0, 24, axial));
  same(Ldt(1, 1, axial), Ldt(0, 24, axial));
  const PhotometricFile file = same(Ldt(0, 24, axial), Ldt(0, 24, axial, "-1"));
  // cd/klm times 2 klm; a mean of 100 cd/klm over the sphere.
  EXPECT_NEAR(file.Greatest, 300.0, 1e-9);
  EXPECT_NEAR(file.FluxFromWeb, 4 * Pi * 200, 2.0);
  EXPECT_EQ(file.FluxStated, 1800.0);
  EXPECT_EQ(file.Warnings.size(), 1u); // 2513 lm are not 1800
  EXPECT_EQ(file.Luminaire, "Lamp of ours");
  EXPECT_EQ(file.DirectRatios.size(), 10u);
}

TEST(PhotometricFile, LooseTexts)
{
  std::string text = Ldt(1, 1, [](double, double g) { return 100.5 - g / 2; });
  const PhotometricFile plain = ReadPhotometricFile(Write("plain.ldt", text));
  std::string comma = text, dos = "\xEF\xBB\xBF", mac;
  std::replace(comma.begin() + 200, comma.end(), '.', ',');
  for (const char c : text)
  {
    dos += c == '\n' ? "\r\n" : std::string(1, c);
    mac += c == '\n' ? '\r' : c;
  }
  for (const std::string& other : { comma, dos, mac, text + "\n\n", text + "\x1a" })
  {
    const PhotometricFile file = ReadPhotometricFile(Write("loose.ldt", other));
    EXPECT_EQ(file.FluxFromWeb, plain.FluxFromWeb);
    EXPECT_EQ(file.Manufacturer, "Ours");
  }
  EXPECT_EQ(ReadPhotometricFile(Write("latin.ldt", "F\xFChler" + text.substr(4))).Manufacturer, "F\xC3\xBChler");
  // IES: commas, blanks and line ends anywhere; TILT with blanks; more after the end.
  const PhotometricFile ies = ReadPhotometricFile(Write("loose.ies",
    "IESNA:LM-63-2002\n[TEST] a\n[MORE] b\ntilt = none\n1,1000,1,3,1\n1,2,0 0 0 1 1\n40 0,45,90\n0 100\n80\n0\n7 8\n"));
  EXPECT_DOUBLE_EQ(ies.Greatest, 100.0);
  EXPECT_EQ(ies.Keyword("test"), "a\nb");
  EXPECT_EQ(ies.Warnings.at(0).substr(0, 7), "2 words");
}

TEST(PhotometricFile, Units)
{
  const auto unit = [](const std::string& keyword, IntensityUnits units = IntensityUnits::Auto) {
    std::string text = Ies();
    text.insert(text.find("[TEST]"), keyword + "\n");
    PhotometricOptions options;
    options.Units = units;
    return std::string(ReadPhotometricFile(Write("units.ies", text), options).IntensityUnit());
  };
  EXPECT_EQ(unit("[OTHER] nothing"), "cd");
  EXPECT_EQ(unit("[_INTENSITYUNITS] mW/sr"), "mW/sr");
  EXPECT_EQ(unit("[_INTENSITYUNITS] W/sr"), "W/sr");
  EXPECT_EQ(unit("[_IntensityUnits] mW / sr"), "mW/sr");
  EXPECT_EQ(unit("[OTHER] Lumens-> mW, lux-> mW/m^2, candela-> mW/sr"), "mW/sr");
  EXPECT_EQ(unit("[OTHER] measured in RADIOMETRIC UNITS."), "mW/sr");
  EXPECT_EQ(unit("[_INTENSITYUNITS] mW/sr", IntensityUnits::Candela), "cd");
  EXPECT_EQ(unit("[OTHER] nothing", IntensityUnits::WattPerSteradian), "W/sr");
  std::string micro = Ies();
  micro.insert(micro.find("[TEST]"), "[_INTENSITYUNITS] uW/sr\n");
  ExpectFails(micro, "uW/sr");
}

TEST(PhotometricFile, TypesAandBFromFiles)
{
  // The same flat Lambertian panel in types B and A: pi times its intensity on the axis.
  for (const char* type : { "2", "3" })
  {
    for (const bool whole : { false, true })
    {
      std::ostringstream angles, values;
      const int n = whole ? 181 : 91;
      for (int round = 0; round < 2; ++round)
      {
        for (int k = 0; k < n; ++k)
        {
          angles << (whole ? k - 90 : k) << (k % 20 == 19 ? "\n" : " ");
        }
        angles << "\n";
      }
      for (int h = 0; h < n; ++h)
      {
        for (int v = 0; v < n; ++v)
        {
          const double x = (whole ? h - 90 : h) * Pi / 180, y = (whole ? v - 90 : v) * Pi / 180;
          values << 100 * std::max(0.0, std::cos(x) * std::cos(y)) << " ";
        }
        values << "\n";
      }
      const std::string n2 = std::to_string(n) + " " + std::to_string(n);
      const PhotometricFile file = ReadPhotometricFile(Write("type.ies",
        Ies("IESNA:LM-63-2002", "1 -1 1", "0 0 0", "1 1 40", n2 + " " + type + " 2", angles.str(), values.str())));
      EXPECT_NEAR(file.FluxFromWeb, 100 * Pi, 0.02) << type << " " << whole;
      EXPECT_EQ(static_cast<int>(file.Web->GetType()), std::stoi(type));
    }
  }
}

TEST(PhotometricFile, DamagedFilesSayWhere)
{
  EXPECT_NE(Message("/nowhere/x.ies").find("no such file"), std::string::npos);
  EXPECT_NE(Message(testing::TempDir()).find("not a file"), std::string::npos);
  ExpectFails("", "is empty");
  ExpectFails(std::string("IES\0NA", 6), "not a text");
  ExpectFails("IESNA:LM-63-2002\n[TEST] 1\n", "TILT=");
  ExpectFails(Ies("IESNA:LM-63-2002", "1 1000 none"), "line 5: \"none\" where the candela multiplier");
  ExpectFails(Ies("IESNA:LM-63-2002", "1 1000 0"), "line 5: the candela multiplier is 0");
  ExpectFails(Ies("IESNA:LM-63-2002", "1 1000 nan"), "line 5: \"nan\"");
  ExpectFails(Ies("IESNA:LM-63-2002", "1 1000 1e999"), "line 5: \"1e999\"");
  const auto web = [](const std::string& counts, const std::string& angles = "0 45 90\n0\n",
                     const std::string& values = "100 80 0\n") {
    return Ies("IESNA:LM-63-2002", "1 1000 1", "0 0 0", "1 1 40", counts, angles, values);
  };
  ExpectFails(web("3 1 4 2"), "line 5: photometric type 4");
  ExpectFails(web("3 1 1 3"), "line 5: units type 3");
  ExpectFails(web("1 1 1 2"), "the number of vertical angles is 1");
  ExpectFails(web("3.5 1 1 2"), "the number of vertical angles is 3.5");
  ExpectFails(web("9999999 9999999 1 2"), "vertical angle");
  ExpectFails(web("99999999 1 1 2"), "the number of vertical angles");
  ExpectFails(web("3 1 1 2", "0 45 40\n0\n"), "line 8: vertical angle 3 is 40");
  ExpectFails(web("3 1 1 2", "0 45 190\n0\n"), "vertical angle 3 is 190");
  ExpectFails(web("3 1 1 2", "0 45 90\n0\n", "100 -80 0\n"), "line 9: intensity 2 is -80");
  ExpectFails(web("3 1 1 2", "0 45 90\n0\n", "0 0 0\n"), "no value above 0");
  ExpectFails(web("3 1 1 2", "0 45 90\n0\n", "100 80\n"), "line 10: the file ends where intensity 3 of 3");
  ExpectFails(web("3 2 1 2", "0 45 90\n0 45\n", "100 80 0 100 80 0\n"), "horizontal angle 2 is 45");
  const std::string ldt = Ldt(4, 24, [](double, double) { return 100.0; });
  const auto replaced = [&](std::size_t line, const std::string& by) {
    std::istringstream in(ldt);
    std::string out, text;
    for (std::size_t k = 1; std::getline(in, text); ++k)
    {
      out += (k == line ? by : text) + "\n";
    }
    return out;
  };
  ExpectFails(replaced(3, "5"), "line 3: the symmetry indicator is 5", "bad.ldt");
  ExpectFails(replaced(4, ""), "line 4: \"\" where the number of C-planes", "bad.ldt");
  ExpectFails(replaced(6, "1e5"), "the file ends where gamma angle", "bad.ldt");
  ExpectFails(replaced(45, "x"), "line 45: \"x\" where C angle", "bad.ldt");
  ExpectFails(replaced(200, "-3"), "line 200: intensity -3", "bad.ldt");
  ExpectFails(replaced(100, "1"), "line 100: gamma angle 1", "bad.ldt");
  ExpectFails(ldt.substr(0, ldt.size() / 2), "the file ends where intensity", "bad.ldt");
}

TEST(PhotometricFile, CutShortOrWithWrongBytes)
{
  std::mt19937 random(1);
  const std::string sources[] = { Ies(), Ldt(4, 24, [](double c, double g) { return c + g + 1; }),
    "IESNA:LM-63-1995\n[A] b\nTILT=INCLUDE\n1 2\n0 90\n1 0.5\n1 -1 1 3 2 2 1 -1 -1 0 1 1 9\n-90 0 90\n-90 90\n1 2 3 4 5 6\n" };
  int refused = 0, all = 0;
  for (const std::string& text : sources)
  {
    const std::string name = text[0] == 'I' ? "fuzz.ies" : "fuzz.ldt";
    EXPECT_EQ(Message(Write(name, text)), "read");
    for (int trial = 0; trial < 400; ++trial)
    {
      std::string bad = text;
      if (trial % 2 == 0)
      {
        bad.resize(random() % text.size());
      }
      else
      {
        for (int k = 0; k <= trial % 5; ++k)
        {
          const std::size_t range = k % 2 ? bad.size() : std::min<std::size_t>(bad.size(), 250);
          bad[random() % range] = k % 3 ? static_cast<char>(random()) : "0123456789.-e\n"[random() % 14];
        }
      }
      // Nothing but a FileError may come out (anything else ends the test), and what is read is whole.
      const std::string file = Write(name, bad);
      try
      {
        const PhotometricFile read = ReadPhotometricFile(file);
        EXPECT_TRUE(std::isfinite(read.FluxFromWeb) && read.FluxFromWeb > 0.0);
        EXPECT_TRUE(std::isfinite(read.Greatest) && read.Greatest > 0.0);
      }
      catch (const FileError& error)
      {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        ++refused;
      }
      ++all;
    }
  }
  EXPECT_GT(refused, all / 3);
}

} // namespace
