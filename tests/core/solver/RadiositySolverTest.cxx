// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/RadiositySolver.h"

#include "radiometry/scene/InputError.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace radiometry;

namespace
{

/// The inside of a sphere, F_ij = A_j/sum A, of which a share `opening` is missing; or several such
/// spheres that do not see each other.
class SphereOperator : public FormFactorOperator
{
public:
  SphereOperator(std::size_t n, double opening, std::size_t spheres = 1)
    : Share(1.0 - opening)
    , Spheres(spheres)
  {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> u(0.1, 1.0);
    this->Total.assign(spheres, 0.0);
    for (std::size_t i = 0; i < n; ++i)
    {
      this->AreaValues.push_back(u(random));
      this->Total[i % spheres] += this->AreaValues.back();
    }
  }
  std::size_t Size() const override { return this->AreaValues.size(); }
  const std::vector<double>& Areas() const override { return this->AreaValues; }
  void Apply(const double* B, double* out, int bands) const override
  {
    for (int b = 0; b < bands; ++b)
    {
      std::vector<double> sums(this->Spheres, 0.0);
      for (std::size_t i = 0; i < this->Size(); ++i)
      {
        sums[i % this->Spheres] += this->AreaValues[i] * B[i * bands + b];
      }
      for (std::size_t i = 0; i < this->Size(); ++i)
      {
        out[i * bands + b] = this->Share * sums[i % this->Spheres] / this->Total[i % this->Spheres];
      }
    }
    ++this->Calls;
  }
  double RowSum(std::size_t, int = 0) const override { return this->Share; }
  void ApplyError(const double*, double*, double*, int) const override {}
  std::vector<std::int32_t> Components() const override
  {
    std::vector<std::int32_t> label(this->Size());
    for (std::size_t i = 0; i < label.size(); ++i)
    {
      label[i] = static_cast<std::int32_t>(i % this->Spheres);
    }
    return label;
  }
  std::size_t MemoryBytes() const override { return 0; }
  std::int64_t Samples() const override { return 0; }
  ClosureReport Closure() const override { return {}; }
  std::string Description() const override { return "sphere"; }

  double Share;
  std::size_t Spheres;
  std::vector<double> AreaValues, Total;
  mutable int Calls = 0;
};

/// Two long rooms joined by a small door: slow to mix, no closed form, but a dense matrix.
class ChainOperator : public FormFactorOperator
{
public:
  ChainOperator(std::size_t n, double link)
    : AreaValues(n, 1.0)
    , Link(link)
  {
  }
  std::size_t Size() const override { return this->AreaValues.size(); }
  const std::vector<double>& Areas() const override { return this->AreaValues; }
  double At(std::size_t i, std::size_t j) const
  {
    // Rooms of two that keep 1 - link (inner) and pass link to the next.
    const std::size_t n = this->Size(), a = i / 2, b = j / 2;
    const double passed = (a > 0) + (a + 1 < n / 2);
    if (a == b)
    {
      return i == j ? 0.0 : 1.0 - this->Link * passed;
    }
    return (a + 1 == b || b + 1 == a) && i % 2 == j % 2 ? this->Link : 0.0;
  }
  void Apply(const double* B, double* out, int bands) const override
  {
    for (std::size_t i = 0; i < this->Size(); ++i)
    {
      for (int b = 0; b < bands; ++b)
      {
        double sum = 0.0;
        for (std::size_t j = i < 3 ? 0 : i - 3; j < std::min(this->Size(), i + 4); ++j)
        {
          sum += this->At(i, j) * B[j * bands + b];
        }
        out[i * bands + b] = sum;
      }
    }
  }
  double RowSum(std::size_t, int = 0) const override { return 1.0; }
  void ApplyError(const double*, double*, double*, int) const override {}
  std::vector<std::int32_t> Components() const override
  {
    return std::vector<std::int32_t>(this->Size(), 0);
  }
  std::size_t MemoryBytes() const override { return 0; }
  std::int64_t Samples() const override { return 0; }
  ClosureReport Closure() const override { return {}; }
  std::string Description() const override { return "chain"; }
  std::vector<double> AreaValues;
  double Link;
};

} // namespace

TEST(RadiositySolver, ClosedSphereUpToReflectanceNearOne)
{
  for (double rho : { 0.0, 0.5, 0.9, 0.99, 0.9999, 0.999999 })
  {
    // Uniform exitance: B = M/(1 - rho) everywhere.
    const SphereOperator sphere(500, 0.0);
    const SolveResult uniform = SolveRadiosity(
      sphere, std::vector<double>(500, rho), std::vector<double>(500, 2.0), 1, { 1e-7 });
    for (std::size_t i = 0; i < 500; ++i)
    {
      EXPECT_NEAR(uniform.Radiosity[i] * (1.0 - rho) / 2.0, 1.0, 1e-6) << rho;
      EXPECT_LE(std::abs(uniform.Radiosity[i] - 2.0 / (1.0 - rho)), uniform.Error[i] + 1e-12);
    }
    // A single source: E = sum A M / sum A (1 - rho), B = M + rho E.
    std::vector<double> source(500, 0.0);
    source[17] = 3.0;
    const double e = sphere.AreaValues[17] * 3.0 / (sphere.Total[0] * (1.0 - rho));
    const SolveResult single =
      SolveRadiosity(sphere, std::vector<double>(500, rho), source, 1, { 1e-7 });
    for (std::size_t i = 0; i < 500; ++i)
    {
      EXPECT_NEAR(single.Irradiance[i] / e, 1.0, 1e-6) << rho;
      EXPECT_LE(std::abs(single.Radiosity[i] - (source[i] + rho * e)), single.Error[i] + 1e-12);
    }
    EXPECT_LT(single.Iterations, 40) << rho;
  }
}

TEST(RadiositySolver, MixedReflectanceAndBandsTogether)
{
  const SphereOperator sphere(300, 0.1, 3);
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const int bands = 5;
  std::vector<double> rho(300 * bands), source(300 * bands, 0.0);
  for (std::size_t k = 0; k < rho.size(); ++k)
  {
    rho[k] = u(random);
    source[k] = u(random) < 0.1 ? u(random) : 0.0;
  }
  const SolveResult r = SolveRadiosity(sphere, rho, source, bands, { 1e-9 });
  for (int b = 0; b < bands; ++b)
  {
    for (std::size_t s = 0; s < 3; ++s)
    {
      double flux = 0.0, loss = 0.0;
      for (std::size_t i = s; i < 300; i += 3)
      {
        flux += sphere.AreaValues[i] * source[i * bands + b];
        loss += sphere.AreaValues[i] * (1.0 - 0.9 * rho[i * bands + b]);
      }
      const double e = 0.9 * flux / loss;
      for (std::size_t i = s; i < 300; i += 3)
      {
        const double exact = source[i * bands + b] + rho[i * bands + b] * e;
        EXPECT_NEAR(r.Irradiance[i * bands + b], e, 1e-8 * e);
        EXPECT_LE(std::abs(r.Radiosity[i * bands + b] - exact), r.Error[i * bands + b] + 1e-15);
      }
    }
  }
}

TEST(RadiositySolver, SlowMixing)
{
  // 60 rooms behind each other, links of 1e-2, reflectance near 1: the second eigenvalue is near
  // 1 too. What is emitted is absorbed, and the bound stays small.
  const ChainOperator chain(120, 0.01);
  for (double rho : { 0.9, 0.9999, 0.999999 })
  {
    std::vector<double> source(120, 0.0);
    source[0] = 1.0;
    const SolveResult r =
      SolveRadiosity(chain, std::vector<double>(120, rho), source, 1, { 1e-7, 3000 });
    EXPECT_TRUE(r.Converged) << rho;
    double absorbed = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < 120; ++i)
    {
      absorbed += (1.0 - rho) * r.Irradiance[i];
      sum += r.Error[i] / 120.0;
    }
    EXPECT_NEAR(absorbed, 1.0, 1e-6) << rho;
    EXPECT_LE(sum, 1e-5 * r.Radiosity[0]) << rho;
    // Light thins out from room to room.
    for (std::size_t i = 2; i < 120; ++i)
    {
      EXPECT_LT(r.Radiosity[i], r.Radiosity[i - 2] + r.Error[i]);
    }
  }
}

TEST(RadiositySolver, ReflectanceOne)
{
  // Open: fine. E = s M/(1 - s) for a sphere with a share s of its wall left.
  const SphereOperator open(100, 0.25);
  const std::vector<double> white(100, 1.0), source(100, 1.0);
  const SolveResult r = SolveRadiosity(open, white, source, 1, { 1e-9 });
  EXPECT_NEAR(r.Irradiance[3], 0.75 / 0.25, 1e-7);

  // Closed, with light: no solution, and the message says which cell and why.
  const SphereOperator closed(100, 0.0, 2);
  std::vector<double> one(100, 0.0);
  one[1] = 1.0;
  try
  {
    SolveRadiosity(closed, white, one, 1, {}, std::vector<std::int32_t>(100, 7));
    FAIL() << "no error";
  }
  catch (const InputError& error)
  {
    EXPECT_EQ(error.Array, "DiffuseReflectance");
    EXPECT_EQ(error.Index, 7);
    EXPECT_NE(std::string(error.what()).find("closed cavity"), std::string::npos);
  }
  // The lossless sphere without light, beside one with light and loss: 0 and a solution.
  std::vector<double> rho(100, 1.0);
  for (std::size_t i = 1; i < 100; i += 2)
  {
    rho[i] = 0.5;
  }
  const SolveResult both = SolveRadiosity(closed, rho, one, 1, { 1e-9 });
  EXPECT_EQ(both.Radiosity[0], 0.0);
  EXPECT_NEAR(both.Irradiance[1], closed.AreaValues[1] / (0.5 * closed.Total[1]), 1e-8);
}

TEST(RadiositySolver, Shortcuts)
{
  const SphereOperator sphere(10, 0.0);
  const std::vector<double> black(10, 0.0), grey(10, 0.5), one(10, 1.0), none(10, 0.0);
  EXPECT_EQ(SolveRadiosity(sphere, grey, none, 1).Iterations, 0);
  EXPECT_EQ(sphere.Calls, 0);
  const SolveResult b = SolveRadiosity(sphere, black, one, 1);
  EXPECT_EQ(b.Radiosity, one);
  EXPECT_NEAR(b.Irradiance[0], 1.0, 1e-15);
  const SphereOperator empty(0, 0.0);
  EXPECT_TRUE(SolveRadiosity(empty, {}, {}, 1).Radiosity.empty());
}

namespace
{

/// Rooms whose walls see each other evenly, F_ij = A_j/A of the room, but for shares that look
/// through openings into another room or out.
class RoomsOperator : public FormFactorOperator
{
public:
  /// `pass[r][s]`: the share of what room r sees that is room s; what is missing to one is open.
  RoomsOperator(std::size_t each, std::vector<std::vector<double>> pass)
    : Each(each)
    , Pass(std::move(pass))
    , AreaValues(each * this->Pass.size(), 0.5)
  {
  }
  std::size_t Size() const override { return this->AreaValues.size(); }
  const std::vector<double>& Areas() const override { return this->AreaValues; }
  void Apply(const double* B, double* out, int bands) const override
  {
    ++this->Calls;
    const std::size_t rooms = this->Pass.size();
    for (int b = 0; b < bands; ++b)
    {
      std::vector<double> mean(rooms, 0.0);
      for (std::size_t i = 0; i < this->Size(); ++i)
      {
        mean[i / this->Each] += B[i * bands + b] / static_cast<double>(this->Each);
      }
      for (std::size_t i = 0; i < this->Size(); ++i)
      {
        double sum = 0.0;
        for (std::size_t s = 0; s < rooms; ++s)
        {
          sum += this->Pass[i / this->Each][s] * mean[s];
        }
        out[i * bands + b] = sum;
      }
    }
  }
  double RowSum(std::size_t i, int = 0) const override
  {
    double sum = 0.0;
    for (const double p : this->Pass[i / this->Each])
    {
      sum += p;
    }
    return sum;
  }
  void ApplyError(const double*, double*, double*, int) const override {}
  std::vector<std::int32_t> Components() const override
  {
    return std::vector<std::int32_t>(this->Size(), 0);
  }
  std::size_t MemoryBytes() const override { return 0; }
  std::int64_t Samples() const override { return 0; }
  ClosureReport Closure() const override { return {}; }
  std::string Description() const override { return "rooms"; }

  std::size_t Each;
  std::vector<std::vector<double>> Pass;
  std::vector<double> AreaValues;
  mutable int Calls = 0;
};

} // namespace

TEST(RadiositySolver, CountOfApplications)
{
  // What costs is F: as few at reflectance 0.999999 as at 0.5, and a bound that is not far off.
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const SphereOperator sphere(400, 0.0);
  for (double rho : { 0.5, 0.9, 0.9999, 0.999999 })
  {
    std::vector<double> source(400, 0.0), reflectance(400);
    for (std::size_t i = 0; i < 400; ++i)
    {
      source[i] = u(random) < 0.1 ? u(random) : 0.0;
      reflectance[i] = 1.0 - 2.0 * (1.0 - rho) * u(random);
    }
    sphere.Calls = 0;
    const SolveResult r = SolveRadiosity(sphere, reflectance, source, 1, { 1e-6 });
    EXPECT_EQ(sphere.Calls, r.Iterations);
    EXPECT_LE(r.Iterations, 8) << rho;
  }
  const ChainOperator chain(120, 0.01);
  for (double rho : { 0.5, 0.9, 0.9999, 0.999999 })
  {
    std::vector<double> source(120, 0.0);
    source[0] = 1.0;
    const SolveResult r =
      SolveRadiosity(chain, std::vector<double>(120, rho), source, 1, { 1e-6, 3000 });
    EXPECT_LE(r.Iterations, 140) << rho; // as slow a mixing as a row of 60 rooms, one by one
  }
}

TEST(RadiositySolver, RoomsJoinedByAPinhole)
{
  // Two rooms of one size, the first with a source M, joined by a share p of what each sees:
  // E1 = (1-p) B1 + p B2, E2 = p B1 + (1-p) B2. With B = M + rho E, sum and difference decouple:
  // E1 + E2 = m/(1 - rho), E1 - E2 = (1 - 2p) m/(1 - (1 - 2p) rho), m the mean of M.
  for (double p : { 1e-3, 1e-6 })
  {
    for (double rho : { 0.9, 0.9999, 0.999999 })
    {
      const RoomsOperator rooms(50, { { 1.0 - p, p }, { p, 1.0 - p } });
      std::vector<double> source(100, 0.0);
      source[7] = 50.0;
      const SolveResult r =
        SolveRadiosity(rooms, std::vector<double>(100, rho), source, 1, { 1e-7 });
      const double sum = 1.0 / (1.0 - rho);
      const double difference = (1.0 - 2.0 * p) / (1.0 - (1.0 - 2.0 * p) * rho);
      const double e[2] = { 0.5 * (sum + difference), 0.5 * (sum - difference) };
      for (std::size_t i = 0; i < 100; ++i)
      {
        EXPECT_NEAR(r.Irradiance[i] / e[i / 50], 1.0, 1e-6) << p << " " << rho;
        EXPECT_LE(std::abs(r.Irradiance[i] - e[i / 50]), r.Error[i]) << p << " " << rho;
      }
      EXPECT_LE(r.Error[0], 2e-6 * e[0]);
      EXPECT_LE(r.Iterations, 10) << p << " " << rho;
    }
  }
}

TEST(RadiositySolver, PinholeInAWhiteRoom)
{
  // Reflectance 1 and an opening of a share o: E = (1 - o) m/o.
  for (double o : { 1e-2, 1e-5, 1e-8 })
  {
    const RoomsOperator room(60, { { 1.0 - o } });
    std::vector<double> source(60, 0.0);
    source[3] = 60.0;
    const SolveResult r = SolveRadiosity(room, std::vector<double>(60, 1.0), source, 1, { 1e-7 });
    EXPECT_NEAR(r.Irradiance[11] * o / (1.0 - o), 1.0, 1e-6) << o;
    EXPECT_LE(r.Iterations, 6);
  }
}

TEST(RadiositySolver, BandsOfVeryDifferentReflectance)
{
  const SphereOperator sphere(200, 0.0);
  const std::vector<double> band{ 0.0, 0.3, 0.99, 0.999999 };
  std::vector<double> rho(800), source(800, 0.0);
  for (std::size_t k = 0; k < 800; ++k)
  {
    rho[k] = band[k % 4];
    source[k] = k / 4 == 5 ? 1.0 : 0.0;
  }
  const SolveResult r = SolveRadiosity(sphere, rho, source, 4, { 1e-6 });
  for (std::size_t k = 0; k < 800; ++k)
  {
    const double e = sphere.AreaValues[5] / sphere.Total[0] / (1.0 - band[k % 4]);
    EXPECT_NEAR(r.Irradiance[k] / e, 1.0, 1e-6);
    // The bound of a dark band does not suffer from the bright one.
    EXPECT_LE(r.Error[k], 3e-6 * e + 3e-6 * sphere.AreaValues[5] / sphere.Total[0]) << k % 4;
  }
  EXPECT_LE(r.Iterations, 8);
}

TEST(RadiositySolver, WhiteInOneBandOrAnother)
{
  // Half of the sphere is white in one band, half in the other: each band loses light, and no
  // cell's greatest reflectance is below one.
  const SphereOperator sphere(100, 0.0);
  std::vector<double> rho(200), source(200, 0.1);
  double area[2] = { 0.0, 0.0 };
  for (std::size_t i = 0; i < 100; ++i)
  {
    rho[2 * i] = i % 2 ? 1.0 : 0.4;
    rho[2 * i + 1] = i % 2 ? 0.4 : 1.0;
    area[i % 2] += sphere.AreaValues[i];
  }
  const SolveResult r = SolveRadiosity(sphere, rho, source, 2, { 1e-8 });
  for (std::size_t b = 0; b < 2; ++b)
  {
    const double e = 0.1 * sphere.Total[0] / (0.6 * area[b]);
    EXPECT_NEAR(r.Irradiance[40 + b] / e, 1.0, 1e-7);
    EXPECT_LE(std::abs(r.Irradiance[40 + b] - e), r.Error[40 + b]);
    EXPECT_LE(r.Error[40 + b], 1e-6 * e);
  }
}

TEST(RadiositySolver, BeginsFromAnEarlierSolution)
{
  const ChainOperator chain(120, 0.01);
  std::vector<double> rho(120, 0.95), source(120, 0.0);
  source[0] = 1.0;
  const SolveResult first = SolveRadiosity(chain, rho, source, 1, { 1e-7, 3000 });
  SolveOptions again{ 1e-7, 3000 };
  again.Guess = &first.Irradiance;
  again.InverseBound = &first.InverseBound;
  const SolveResult same = SolveRadiosity(chain, rho, source, 1, again);
  EXPECT_LE(same.Iterations, 3);
  source[0] = 1.05;
  const SolveResult dimmed = SolveRadiosity(chain, rho, source, 1, again);
  EXPECT_LT(dimmed.Iterations, first.Iterations);
  for (std::size_t i = 0; i < 120; ++i)
  {
    EXPECT_NEAR(dimmed.Irradiance[i], 1.05 * first.Irradiance[i],
      dimmed.Error[i] + 1.05 * first.Error[i]);
  }
  // A bound of other reflectances is not believed.
  std::fill(rho.begin(), rho.end(), 0.9999);
  const SolveResult white = SolveRadiosity(chain, rho, source, 1, again);
  double absorbed = 0.0;
  for (std::size_t i = 0; i < 120; ++i)
  {
    absorbed += 1e-4 * white.Irradiance[i];
  }
  EXPECT_NEAR(absorbed, 1.05, 1e-6);
  EXPECT_GT(white.InverseBound[0], 1e3);
}

TEST(RadiositySolver, RowsAboveOneOverMirrors)
{
  // A sphere of a share s of mirror (reflectance m, diffuse d) in a wall of reflectance rho: what
  // comes over the mirror adds m s of all that is seen, again and again: F_ij = A_j/A /(1 - m s)
  // in band 0; no mirror in band 1.
  class MirrorOperator : public SphereOperator
  {
  public:
    MirrorOperator()
      : SphereOperator(80, 0.0)
    {
    }
    void Apply(const double* B, double* out, int bands) const override
    {
      EXPECT_EQ(bands, 2);
      SphereOperator::Apply(B, out, bands);
      for (std::size_t i = 0; i < this->Size(); ++i)
      {
        out[2 * i] *= this->Gain;
      }
    }
    int Bands() const override { return 2; }
    double RowSum(std::size_t, int band = 0) const override { return band ? 1.0 : this->Gain; }
    double Gain = 1.0;
  } op;
  double mirror = 0.0;
  std::vector<double> rho(160), source(160, 0.0);
  for (std::size_t i = 0; i < 80; ++i)
  {
    mirror += i < 40 ? op.AreaValues[i] / op.Total[0] : 0.0;
    rho[2 * i] = i < 40 ? 0.05 : 0.999;
    rho[2 * i + 1] = i < 40 ? 0.3 : 0.9;
  }
  op.Gain = 1.0 / (1.0 - 0.9 * mirror);
  EXPECT_GT(op.RowSum(0, 0), 1.5);
  source[0] = source[1] = 1.0;
  const SolveResult r = SolveRadiosity(op, rho, source, 2, { 1e-8 });
  for (std::size_t b = 0; b < 2; ++b)
  {
    const double gain = b ? 1.0 : op.Gain;
    const double reflected = mirror * rho[b] + (1.0 - mirror) * rho[80 + b];
    const double e = gain * op.AreaValues[0] / op.Total[0] / (1.0 - gain * reflected);
    for (std::size_t i = 0; i < 80; ++i)
    {
      EXPECT_NEAR(r.Irradiance[2 * i + b] / e, 1.0, 1e-7);
      EXPECT_LE(std::abs(r.Irradiance[2 * i + b] - e), r.Error[2 * i + b]);
    }
  }
}

TEST(RadiositySolver, SheetThatDiffuses)
{
  // Two spherical rooms, black but for a sheet of area A1 between them (element 0 of one, element
  // 1 of the other): its sides reflect rho and let tau through.
  // Room k: E_k = (sum A M)_k/A_k with all walls reflecting r; nodes: walls and sheet side.
  const SphereOperator rooms(100, 0.0, 2); // even elements room 0, odd room 1
  DiffuseScattering scattering(std::vector<double>(100, 0.6));
  scattering.Reflectance[0] = scattering.Reflectance[1] = 0.25;
  scattering.Couplings = { { 0, 1 }, { 1, 0 } };
  scattering.Transmittance = { 0.7, 0.7 };
  std::vector<double> source(100, 0.0);
  source[8] = 2.0;
  const SolveResult r = SolveRadiosity(rooms, scattering, source, 1, { 1e-9 });
  // E0 (A0 - sum A rho)_0 - E1 A_0(sheet) tau = A M, and the like of room 1.
  double kept[2] = { 0.0, 0.0 };
  for (std::size_t i = 0; i < 100; ++i)
  {
    kept[i % 2] += rooms.AreaValues[i] * (1.0 - scattering.Reflectance[i]);
  }
  const double over[2] = { rooms.AreaValues[1] * 0.7, rooms.AreaValues[0] * 0.7 };
  // kept0 E0 - A_0 tau E1 = A8 M;  -A_1 tau E0 + kept1 E1 = 0
  const double det = kept[0] * kept[1] - over[0] * over[1];
  const double e0 = kept[1] * rooms.AreaValues[8] * 2.0 / det;
  const double e1 = over[0] * rooms.AreaValues[8] * 2.0 / det;
  for (std::size_t i = 0; i < 100; ++i)
  {
    EXPECT_NEAR(r.Irradiance[i] / (i % 2 ? e1 : e0), 1.0, 1e-8);
    EXPECT_LE(std::abs(r.Irradiance[i] - (i % 2 ? e1 : e0)), r.Error[i] + 1e-15);
  }
  EXPECT_NEAR(r.Radiosity[1], 0.25 * r.Irradiance[1] + 0.7 * r.Irradiance[0], 1e-12);

  // A sheet that loses nothing joins two white rooms: lossless together, if either has light.
  DiffuseScattering white(std::vector<double>(100, 1.0));
  white.Reflectance[0] = white.Reflectance[1] = 0.3;
  white.Couplings = scattering.Couplings;
  white.Transmittance = scattering.Transmittance;
  EXPECT_THROW(SolveRadiosity(rooms, white, source, 1), InputError);
}
