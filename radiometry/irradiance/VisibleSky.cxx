// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/VisibleSky.h"

#include "radiometry/geometry/Sampling.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr int Batches = 16;
/// Standard deviations of the mean of Batches batches that hold 95 of 100 (Student, 15 degrees of
/// freedom: 2.13), and some more: a run that stops when its estimate is small stops early.
constexpr double Coverage = 2.5;
/// What n well spread rays may have missed: some 2/n of what they were chosen from where they are
/// few (a pole before the sky), and less than that of many, for things of every size below are
/// seldom all there is.
double Unseen(double rays)
{
  return 2.0 / rays * std::min(1.0, std::pow(512.0 / rays, 0.25));
}

/// Least share of the rays that go everywhere alike once the pilot knows better.
constexpr double LeastEverywhere = 0.5;
constexpr int MostPilot = 4096;

/// A map of the unit square onto itself that sends more points where a density on a grid of 2^levels
/// squares is higher. What is well spread stays so (Clarberg et al. 2005).
class SquareWarp
{
public:
  /// `density` row by row; any scale.
  void Build(int levels, const std::vector<double>& density)
  {
    this->Depth = levels;
    this->Density = density;
    this->Total = 0.0;
    for (const double d : density)
    {
      this->Total += d;
    }
    this->Nodes.resize(static_cast<std::size_t>(levels));
    std::vector<double> finer = density;
    for (int l = levels - 1; l >= 0; --l)
    {
      const int n = 1 << l;
      std::vector<double> sums(static_cast<std::size_t>(n) * n);
      std::vector<Node>& nodes = this->Nodes[l];
      nodes.resize(sums.size());
      for (int i = 0; i < n; ++i)
      {
        for (int j = 0; j < n; ++j)
        {
          const double* top = &finer[static_cast<std::size_t>(2 * i) * 2 * n + 2 * j];
          const double* bottom = top + 2 * n;
          const std::size_t k = static_cast<std::size_t>(i) * n + j;
          nodes[k].Rows = Split(top[0] + top[1], bottom[0] + bottom[1]);
          nodes[k].Columns[0] = Split(top[0], top[1]);
          nodes[k].Columns[1] = Split(bottom[0], bottom[1]);
          sums[k] = top[0] + top[1] + bottom[0] + bottom[1];
        }
      }
      finer.swap(sums);
    }
  }

  /// Moves (u, v); returns the square that it falls into.
  int Move(double& u, double& v) const
  {
    int i = 0;
    int j = 0;
    for (int l = 0; l < this->Depth; ++l)
    {
      const Node& node = this->Nodes[l][(static_cast<std::size_t>(i) << l) + j];
      const int lower = node.Rows.Halve(u);
      const int right = node.Columns[lower].Halve(v);
      i = 2 * i + lower;
      j = 2 * j + right;
    }
    const int n = 1 << this->Depth;
    u = (i + u) / n;
    v = (j + v) / n;
    return i * n + j;
  }

  /// The mean weight of a sample of that square: 1 where the density is even.
  double Weight(int square) const
  {
    return this->Total / (this->Density[square] * static_cast<double>(this->Density.size()));
  }

private:
  /// Shares of two neighbours; none is 0.
  struct Split
  {
    double First = 0.5;
    double Stretch[2] = { 2.0, 2.0 };

    Split() = default;
    Split(double a, double b)
      : First(a / (a + b))
      , Stretch{ (a + b) / a, (a + b) / b }
    {
    }
    int Halve(double& x) const
    {
      const int which = x < this->First ? 0 : 1;
      x = std::min((which == 0 ? x : x - this->First) * this->Stretch[which], 1.0 - 0x1p-53);
      return which;
    }
  };
  struct Node
  {
    Split Rows;
    Split Columns[2]; // of the upper and the lower half
  };

  int Depth = 0;
  double Total = 1.0;
  std::vector<double> Density;
  std::vector<std::vector<Node>> Nodes; // level by level, row by row
};

/// What one ray found.
class Look
{
public:
  Look(const OcclusionScene& occluders, const SkyTable& table, const SkyReceiver& receiver,
    const SkyView& view, bool panes, VisibleShare& share)
    : Occluders(occluders)
    , Receiver(receiver)
    , View(view)
    , Panes(panes)
    , Share(share)
    , Layers(table.Grey() && !panes ? 1 : static_cast<std::size_t>(table.Bands()))
    , Even(table.Grey())
    , Passed(this->Layers, 1.0)
  {
  }

  /// Draws a direction and follows it; false where the sample has no weight.
  bool Along(double u, double v, double s, double t)
  {
    this->Sample = this->View.Draw(u, v);
    if (!(this->Sample.Weight > 0.0))
    {
      return false;
    }
    RayEnd from;
    bool visible = this->Receiver.Start(s, t, this->Sample.Direction, from);
    std::fill(this->Passed.begin(), this->Passed.end(), 1.0);
    if (visible)
    {
      ++this->Share.Rays;
      visible = this->Panes
        ? this->Occluders.VisibleDirection(from, this->Sample.Direction, this->Passed.data())
        : !this->Occluders.OccludedDirection(from, this->Sample.Direction);
    }
    if (!visible)
    {
      std::fill(this->Passed.begin(), this->Passed.end(), 0.0);
    }
    this->Share.AllHidden = this->Share.AllHidden && !visible;
    return true;
  }

  double BandWeight(std::size_t b) const
  {
    return this->Even ? 1.0 : this->View.BandShare(this->Sample, static_cast<int>(b));
  }

  const OcclusionScene& Occluders;
  const SkyReceiver& Receiver;
  const SkyView& View;
  bool Panes;
  VisibleShare& Share;
  std::size_t Layers;
  bool Even; // each band has the same weight
  std::vector<double> Passed; // what gets through, a layer
  SkyView::Sample Sample;
};

/// The pilot's guess of what is visible in each square, and where to look closer.
struct Guess
{
  int Levels = 0;
  std::vector<double> Visible; // squares x layers
  std::vector<double> Density;
  double Everywhere = 1.0; // share of the rays that go everywhere alike

  void Find(int levels, const SobolSequence& sequence, Look& look)
  {
    const int n = 1 << levels;
    const std::size_t layers = look.Layers;
    this->Levels = levels;
    this->Visible.assign(n * n * layers, 0.0);
    for (int k = 0; k < n * n; ++k)
    {
      // A net: one point in each square.
      const auto u = sequence(static_cast<std::uint32_t>(k));
      const auto square = static_cast<std::size_t>(u[0] * n) * n + static_cast<std::size_t>(u[1] * n);
      if (look.Along(u[0], u[1], u[2], u[3]))
      {
        std::copy(look.Passed.begin(), look.Passed.end(), &this->Visible[square * layers]);
      }
    }
    std::vector<std::uint8_t> active(static_cast<std::size_t>(n) * n, 0);
    int count = 0;
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < n; ++j)
      {
        const double* own = &this->Visible[(static_cast<std::size_t>(i) * n + j) * layers];
        bool differs = false;
        for (int a = std::max(i - 1, 0); a <= std::min(i + 1, n - 1) && !differs; ++a)
        {
          for (int b = j - 1; b <= j + 1 && !differs; ++b)
          {
            const double* other =
              &this->Visible[(static_cast<std::size_t>(a) * n + (b + n) % n) * layers];
            differs = !std::equal(own, own + layers, other);
          }
        }
        active[static_cast<std::size_t>(i) * n + j] = differs ? 1 : 0;
        count += differs ? 1 : 0;
      }
    }
    // The more there is to look at, the less can be said of the rest.
    const double share = count / static_cast<double>(active.size());
    this->Everywhere = count == 0 ? 1.0 : std::max(LeastEverywhere, share);
    this->Density.assign(active.size(), this->Everywhere);
    for (std::size_t k = 0; k < active.size() && count > 0; ++k)
    {
      this->Density[k] += active[k] ? (1.0 - this->Everywhere) / share : 0.0;
    }
  }
};

/// Mean and standard deviation of the mean of the batches.
void Summarise(const double* batches, std::size_t stride, double& mean, double& deviation)
{
  mean = 0.0;
  for (int k = 0; k < Batches; ++k)
  {
    mean += batches[k * stride] / Batches;
  }
  double spread = 0.0;
  for (int k = 0; k < Batches; ++k)
  {
    const double off = batches[k * stride] - mean;
    spread += off * off / (Batches * (Batches - 1.0));
  }
  deviation = std::sqrt(spread);
}

} // namespace

bool SkyReceiver::Start(double u, double v, const Vec3& direction, RayEnd& end) const
{
  if (this->Starts.empty())
  {
    end = { TrianglePoint(this->Corners, u, v), this->Triangle };
    return true;
  }
  const auto first = static_cast<std::size_t>(u * static_cast<double>(this->Starts.size()));
  for (std::size_t s = 0; s < this->Starts.size(); ++s)
  {
    const PointStart& start = this->Starts[(first + s) % this->Starts.size()];
    if (this->Starts.size() == 1 || Dot(start.Normal, direction) > 0.0)
    {
      end = start.End;
      return true;
    }
  }
  return false;
}

void FindVisibleShare(const OcclusionScene& occluders, const SkyTable& table,
  const SkyReceiver& receiver, bool panes, std::uint64_t key, int samples, VisibleShare& share)
{
  static thread_local SkyView view;
  static thread_local Guess guess;
  static thread_local SquareWarp warp;
  static thread_local std::vector<double> sum, weight;
  share = {};
  view.Look(table, receiver.Normal);
  Look look(occluders, table, receiver, view, panes, share);
  const std::size_t layers = look.Layers;

  int levels = 3;
  while ((4 << (2 * levels)) < samples && (1 << (2 * levels)) < MostPilot)
  {
    ++levels;
  }
  guess.Find(levels, SobolSequence(Hash64(key, 0x70696c6f74ull)), look);
  warp.Build(levels, guess.Density);
  const auto squares = static_cast<int>(guess.Density.size());

  sum.assign(Batches * layers, 0.0);
  weight.assign(Batches * layers, 0.0);
  const int each = samples / Batches;
  for (int batch = 0; batch < Batches; ++batch)
  {
    const SobolSequence sequence(Hash64(key, static_cast<std::uint64_t>(batch)));
    for (int k = 0; k < each; ++k)
    {
      auto u = sequence(static_cast<std::uint32_t>(k));
      const int square = warp.Move(u[0], u[1]);
      if (!look.Along(u[0], u[1], u[2], u[3]))
      {
        continue;
      }
      const double w = look.Sample.Weight * warp.Weight(square);
      for (std::size_t b = 0; b < layers; ++b)
      {
        // Where bands weigh differently, their parts of a square are not known: a ratio instead.
        const double guessed =
          look.Even ? guess.Visible[static_cast<std::size_t>(square) * layers + b] : 0.0;
        const double band = w * look.BandWeight(b);
        sum[batch * layers + b] += band * (look.Passed[b] - guessed) / each;
        weight[batch * layers + b] += band / each;
      }
    }
  }
  const double rays = squares + guess.Everywhere * samples;
  for (std::size_t b = 0; b < layers; ++b)
  {
    double value = 0.0;
    double deviation = 0.0;
    if (look.Even)
    {
      Summarise(&sum[b], layers, value, deviation);
      for (int k = 0; k < squares; ++k)
      {
        value += guess.Visible[static_cast<std::size_t>(k) * layers + b] / squares;
      }
    }
    else
    {
      double all = 0.0;
      double lit = 0.0;
      for (int k = 0; k < Batches; ++k)
      {
        all += weight[k * layers + b];
        lit += sum[k * layers + b];
      }
      value = all > 0.0 ? lit / all : 0.5;
      for (int k = 0; k < Batches && all > 0.0; ++k)
      {
        sum[k * layers + b] = value +
          (sum[k * layers + b] - value * weight[k * layers + b]) * Batches / all;
      }
      double mean = 0.0;
      Summarise(&sum[b], layers, mean, deviation);
      deviation = all > 0.0 ? deviation : 0.5;
    }
    share.Value.push_back(std::clamp(value, 0.0, 1.0));
    share.Error.push_back(std::min(1.0, std::hypot(Coverage * deviation, Unseen(rays))));
  }
}

} // namespace radiometry
