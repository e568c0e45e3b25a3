// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/PairVisibility.h"

#include "radiometry/geometry/Sampling.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr int Sets = 4;
constexpr int BatchSize = 64; // segments asked at once
/// Up to so many candidates are asked one by one; the scene's tree is faster beyond.
constexpr std::size_t FewCandidates = 24;

/// The first points of the sequence that all pairs shift (modulo one) by numbers of their own.
constexpr std::uint32_t TableSize = 1024;
const std::array<std::array<double, 4>, TableSize>& PointTable()
{
  static const auto table = [] {
    std::array<std::array<double, 4>, TableSize> t;
    const SobolSequence sequence(0x706169727321ull);
    for (std::uint32_t k = 0; k < TableSize; ++k)
    {
      t[k] = sequence(k);
    }
    return t;
  }();
  return table;
}

/// A randomly shifted sequence: independent for each key.
class ShiftedSequence
{
public:
  explicit ShiftedSequence(std::uint64_t key)
  {
    for (int d = 0; d < 4; ++d)
    {
      key = Hash64(key);
      this->Shift[d] = static_cast<double>(key >> 11) * 0x1p-53;
    }
  }
  std::array<double, 4> operator()(std::uint32_t k) const
  {
    std::array<double, 4> u = PointTable()[k % TableSize];
    for (int d = 0; d < 4; ++d)
    {
      u[d] += this->Shift[d];
      u[d] -= u[d] >= 1.0 ? 1.0 : 0.0;
    }
    return u;
  }

private:
  double Shift[4];
};

/// Points of both patches, and what arrives of them.
struct PairSamples
{
  double Weight[Sets] = {};
  double Visible[Sets] = {};
  double AllWeight = 0.0;
  double Squares = 0.0; // of the weights
  bool AnyVisible = false, AnyHidden = false;
  int Done = 0; // points of each set
  int Rays = 0;

  double Fraction() const
  {
    if (!this->AnyHidden)
    {
      return 1.0;
    }
    double sum = 0.0;
    for (const double v : this->Visible)
    {
      sum += v;
    }
    return sum / this->AllWeight;
  }
  /// As many points of one weight would tell as much.
  double Effective() const { return this->AllWeight * this->AllWeight / this->Squares; }
  /// The variance of the fraction. Where all agree, that of the posterior of a uniform prior; else
  /// the spread of the few sets, held up by half of what independent points would have.
  double Variance(double fraction) const
  {
    const double k = this->Effective();
    if (!this->AnyVisible || !this->AnyHidden)
    {
      return 2.0 / ((k + 2.0) * (k + 3.0));
    }
    double spread = 0.0;
    for (int set = 0; set < Sets; ++set)
    {
      const double off = (this->Visible[set] - fraction * this->Weight[set]) / this->AllWeight;
      spread += off * off * Sets / (Sets - 1.0);
    }
    const double mean = (fraction * k + 1.0) / (k + 2.0);
    return 0.6 * spread + 0.6 * mean * (1.0 - mean) / k;
  }
};

/// `hidden(x, y, n, flags)` asks for n segments at once.
template <class Hidden>
PairVisibilityResult Sample(const Triangle3& a, const Vec3& normalA, const Triangle3& b,
  const Vec3& normalB, const PairSampling& sampling, Hidden&& hidden)
{
  PairVisibilityResult result;
  PairSamples s;
  const ShiftedSequence sequences[Sets] = { ShiftedSequence(4 * sampling.Key),
    ShiftedSequence(4 * sampling.Key + 1), ShiftedSequence(4 * sampling.Key + 2),
    ShiftedSequence(4 * sampling.Key + 3) };
  Vec3 x[BatchSize], y[BatchSize];
  double kernel[BatchSize];
  int setOf[BatchSize];
  std::uint8_t flags[BatchSize];
  const auto sampleTo = [&](int end) {
    while (s.Done < end)
    {
      int n = 0;
      for (; s.Done < end && n + Sets <= BatchSize; ++s.Done)
      {
        for (int set = 0; set < Sets; ++set)
        {
          const auto u = sequences[set](static_cast<std::uint32_t>(s.Done));
          x[n] = TrianglePoint(a, u[0], u[1]);
          y[n] = TrianglePoint(b, u[2], u[3]);
          const Vec3 r = y[n] - x[n];
          const double r2 = LengthSquared(r);
          kernel[n] = std::max(0.0, Dot(normalA, r)) * std::max(0.0, -Dot(normalB, r)) / (r2 * r2);
          setOf[n] = set;
          n += kernel[n] > 0.0 ? 1 : 0;
        }
      }
      hidden(x, y, n, flags);
      s.Rays += n;
      for (int k = 0; k < n; ++k)
      {
        s.Weight[setOf[k]] += kernel[k];
        s.AllWeight += kernel[k];
        s.Squares += kernel[k] * kernel[k];
        s.Visible[setOf[k]] += flags[k] ? 0.0 : kernel[k];
        (flags[k] ? s.AnyHidden : s.AnyVisible) = true;
      }
    }
  };

  sampleTo(std::max(1, sampling.First / Sets));
  // Mostly below each other's horizon: look on until something was seen.
  while (s.AllWeight == 0.0 && s.Done < 64)
  {
    sampleTo(2 * s.Done);
  }
  if (s.AllWeight == 0.0)
  {
    result.Fraction = 0.5;
    result.Error = 0.5;
    result.Rays = s.Rays;
    return result;
  }
  result.Fraction = s.Fraction();
  double variance = s.Variance(result.Fraction);
  const int most = std::min(sampling.Most, Sets * static_cast<int>(TableSize));
  while (s.AnyVisible && s.AnyHidden && Sets * s.Done < most &&
    (s.Done < 4 || variance > sampling.Wanted * sampling.Wanted))
  {
    sampleTo(2 * s.Done);
    result.Fraction = s.Fraction();
    variance = s.Variance(result.Fraction);
  }
  result.Error = std::sqrt(variance);
  result.Rays = s.Rays;
  return result;
}

} // namespace

PairVisibilityResult PairVisibility(const OcclusionScene& scene, const ExchangePatch& a,
  std::int32_t triangleA, const ExchangePatch& b, std::int32_t triangleB, std::uint64_t key,
  int first, int most, double wanted)
{
  return Sample(a.Corners, a.Normal, b.Corners, b.Normal, { key, first, most, wanted },
    [&](const Vec3* x, const Vec3* y, int n, std::uint8_t* flags) {
      RayEnd from[BatchSize], to[BatchSize];
      for (int k = 0; k < n; ++k)
      {
        from[k] = { x[k], triangleA };
        to[k] = { y[k], triangleB };
      }
      scene.Occluded(from, to, static_cast<std::size_t>(n), flags);
    });
}

PairVisibilityResult PairVisibility(const OcclusionScene& scene, const PatchBlockers& blockers,
  const PlacedPatch& a, const PlacedPatch& b, const PatchBlockers::Candidates& between,
  const PairSampling& sampling)
{
  const bool few = between.Complete && between.Triangles.size() <= FewCandidates;
  return Sample(a.Corners, a.Normal, b.Corners, b.Normal, sampling,
    [&](const Vec3* x, const Vec3* y, int n, std::uint8_t* flags) {
      if (few)
      {
        for (int k = 0; k < n; ++k)
        {
          flags[k] = blockers.Blocked(x[k], a, y[k], b, between) ? 1 : 0;
        }
        return;
      }
      RayEnd from[BatchSize], to[BatchSize];
      for (int k = 0; k < n; ++k)
      {
        from[k] = { blockers.Unplace(x[k]), a.Triangle };
        to[k] = { blockers.Unplace(y[k]), b.Triangle };
      }
      scene.Occluded(from, to, static_cast<std::size_t>(n), flags);
    });
}

} // namespace radiometry
