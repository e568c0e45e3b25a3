// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/LightTree.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace radiometry
{

/// What one light gives one receiver, per unit of its intensity (1/m^2, or a cosine).
struct LightShare
{
  double Lit = 0.0;        // what arrives
  double Open = 0.0;       // what would arrive, were nothing in the way
  double Doubt = 0.0;      // error of what could not be decided: independent from light to light
  double Systematic = 0.0; // error of quadrature and rounding: adds up
};

/// Neighbouring receivers that are asked together.
class ReceiverBlock
{
public:
  virtual ~ReceiverBlock() = default;
  /// What light `light` gives each receiver with active[i] != 0. `basis[i]`: what it got from others
  /// so far, in units of this light's intensity: of that its Doubt may be a small share. Returns
  /// the rays traced.
  virtual std::int64_t Ask(
    std::size_t light, const std::uint8_t* active, const double* basis, LightShare* shares) = 0;
  /// What panes left in each band of the light last asked, relative to Lit (its greatest band), by
  /// receiver and band; null: the same in all.
  virtual const double* Tints() const { return nullptr; }
};

/// How far a block is worked out.
struct LightEffort
{
  /// Lights asked one by one; what is left then is estimated from about as many more.
  std::size_t Lights = std::numeric_limits<std::size_t>::max();
  /// After so many the rest is estimated for the first time, to see whether that will do.
  std::size_t FirstLook = 32;
  double RelativeTolerance = 0.01;
  double AbsoluteTolerance = 0.0;
  double Dropped = 0.0; // W/m^2: what was left out before, of each value
};

/// Sums up the light of many on a block of receivers, the strongest first.
///   Model   E = sum over lights asked + what the rest may add
///   Left    when the sum of the bounds of the rest is within a quarter of the tolerance of a
///   out     receiver, in every band, the rest is dropped for it and that bound joins its error
///   Sampled where many are left, the rest is estimated from eight independent systematic samples of
///           the tree, each light with a probability in proportion to its bound: unbiased; the
///           error is 3.3 standard deviations of the mean of the eight, and no less than what that
///           many samples may have missed. Receivers for which that is good enough are done; for
///           the others more are drawn, or asked one by one, whichever seems to cost less; when the
///           effort allows no more lights, the estimate is taken as it is.
///   Cost    O(lights asked + log(lights)) for a block
class LightSum
{
public:
  LightSum(const LightTree& tree, int bands);

  /// Of `count` receivers; those with active[i] == 0 are left alone and get 0. `key` seeds the
  /// samples. Returns the rays traced.
  std::int64_t Compute(ReceiverBlock& block, const ReceiverBounds& bounds, std::size_t count,
    const std::uint8_t* active, const LightEffort& effort, std::uint64_t key);

  // Results, receivers x bands, W/m^2.
  std::vector<double> Value;
  std::vector<double> Error;
  /// Of each receiver: what of its error it has in common with its neighbours, namely bounds on
  /// lights left out, and errors of those estimated from samples.
  std::vector<double> Dropped;
  std::vector<std::uint8_t> Uncertain; // receivers whose error more effort can make smaller
  double PeakUnshadowed = 0.0; // greatest of any receiver and band, nothing in the way
  bool Sampled = false;        // of some receiver the rest was estimated

private:
  struct Entry
  {
    double Bound; // of its strongest bands together, W/m^2; infinite: none
    double Gain;
    std::int32_t Id;

    /// The top of the heap: the strongest.
    bool operator<(const Entry& other) const
    {
      return this->Bound < other.Bound || (this->Bound == other.Bound && this->Id > other.Id);
    }
  };
  struct Drawn
  {
    std::size_t Light;
    int Set;
    double Weight;
  };
  void Push(std::int32_t entry, const ReceiverBounds& bounds);
  void AskOne(ReceiverBlock& block, std::size_t light);
  bool Settle(const LightEffort& effort);
  bool Sample(ReceiverBlock& block, const ReceiverBounds& bounds, const LightEffort& effort,
    std::size_t asked, bool last, std::uint64_t key);
  void DrawSamples(const ReceiverBounds& bounds, std::size_t each, std::uint64_t key);
  void AskSamples(ReceiverBlock& block);
  double TakeEstimates(const LightEffort& effort, std::size_t drawn, bool last);
  double Draw(const ReceiverBounds& bounds, double at, Entry& entry) const;
  void Finish();

  const LightTree& Tree;
  std::size_t Bands;
  std::size_t Count = 0;
  std::vector<Entry> Heap;
  std::vector<std::uint8_t> Active;
  std::vector<double> Basis;
  std::vector<LightShare> Shares;
  std::vector<double> Variance; // of doubts, receivers x bands, already at 2.5 deviations
  std::vector<double> Open;     // receivers x bands
  std::vector<double> Strong;   // the strongest bands of what each receiver gets, together
  std::vector<double> Rest;     // bands: bounds of the entries in the heap
  // Of one estimate: receivers x bands x sets, and receivers x bands.
  std::vector<double> Sums;
  std::vector<double> SampleVariance;
  std::vector<double> SampleError;
  std::vector<double> Mean;   // bands
  std::vector<double> Spread; // bands
  std::vector<Drawn> Samples;
  std::int64_t Rays = 0;
};

} // namespace radiometry
