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
