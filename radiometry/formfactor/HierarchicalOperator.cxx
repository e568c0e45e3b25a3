// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/HierarchicalOperator.h"

#include "radiometry/formfactor/ClusterExchange.h"
#include "radiometry/formfactor/ClusterLinks.h"
#include "radiometry/formfactor/ClusterProbes.h"
#include "radiometry/formfactor/LinkedSets.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/visibility/Convexity.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

constexpr double MiB = 1024.0 * 1024.0;
// Links that leave in much the same direction miss alike: their errors grow together. Found from
// elements against all pairs on seven scenes (HierarchicalCalibrationTest).
constexpr double Alike = 2.0;
constexpr double FarShare = 0.5; // of a source's unevenness that lines up with the kernel's

/// A non-negative number in 8 bits, to 5 %: its logarithm, from 2^-28 to 16.
std::uint8_t Coded(double value)
{
  return value > 0.0
    ? static_cast<std::uint8_t>(std::clamp(std::lround(std::log2(value) * 8.0) + 224l, 1l, 255l))
    : std::uint8_t(0);
}

struct Decoder
{
  double Value[256];
  Decoder()
  {
    this->Value[0] = 0.0;
    for (int k = 1; k < 256; ++k)
    {
      this->Value[k] = std::exp2((k - 224) / 8.0);
    }
  }
};
double Decoded(std::uint8_t code)
{
  static const Decoder decoder;
  return decoder.Value[code];
}

/// A link as one of its nodes sees it.
struct Entry
{
  std::int32_t Other;
  float Kernel;
  float Slope[3];          // per metre of this node's place (and the negative of the other's)
  std::uint8_t Turn;       // t of ExchangeSlope in 255ths; 0: the same for all pairs
  std::uint8_t Factor;     // the row's form factor, unoccluded; coded, as all that follows
  std::uint8_t Form, Far;  // what it misses, relative to that: over this node, over the other
  std::uint8_t Sight, Dim; // by visibility, the same
};

} // namespace

struct HierarchicalOperator::Internals
{
  std::size_t N = 0;
  std::vector<double> Areas;
  ElementTree Tree;
  std::vector<std::size_t> Begin; // of each node's entries
  std::vector<Entry> Entries;
  std::vector<std::int32_t> Curved; // number of each node whose normals differ; -1: they do not
  std::size_t CurvedCount = 0;
  std::vector<double> Scale;   // d of each element
  std::vector<double> RowSums; // of F, corrected
  std::vector<std::uint8_t> Closed; // rows brought to one
  std::size_t LinkCount = 0;
  std::int64_t Pairs = 0, Rays = 0;
  double Loosened = 1.0;
  int Threads = 0;
  ClosureReport Report;

  /// Parallel where it is worth it.
  template <class Body>
  void Each(std::size_t count, const Body& body, double cost) const
  {
    if (this->Entries.size() < 20000)
    {
      for (std::size_t k = 0; k < count; ++k)
      {
        body(k);
      }
      return;
    }
    ParallelFor(count, this->Threads, {}, body, cost);
  }
  /// Runs body(node) over all nodes of each subtree, subtrees in parallel, and of the part above.
  template <class Body>
  void Up(const Body& body) const
  {
    const auto& roots = this->Tree.Subtrees();
    this->Each(
      roots.size(),
      [&](std::size_t k) {
        const std::int32_t root = roots[k];
        for (std::int32_t at = root + 2 * this->Tree[root].Count - 2; at >= root; --at)
        {
          body(at);
        }
      },
      1e-5);
    const auto& upper = this->Tree.Upper();
    for (auto at = upper.rbegin(); at != upper.rend(); ++at)
    {
      body(*at);
    }
  }
  /// gather(node) for every node, then pass(node, parent) from the top down.
  template <class Gather, class Pass>
  void Down(const Gather& gather, const Pass& pass) const
  {
    const auto& upper = this->Tree.Upper();
    this->Each(upper.size(), [&](std::size_t k) { gather(upper[k]); }, 1e-6);
    for (const std::int32_t at : upper)
    {
      if (at > 0)
      {
        pass(at, this->Tree[at].Parent);
      }
    }
    const auto& roots = this->Tree.Subtrees();
    this->Each(
      roots.size(),
      [&](std::size_t k) {
        const std::int32_t root = roots[k];
        for (std::int32_t at = root; at < root + 2 * this->Tree[root].Count - 1; ++at)
        {
          gather(at);
          if (at > 0)
          {
            pass(at, this->Tree[at].Parent);
          }
        }
      },
      1e-4);
  }

  std::size_t Item(const ElementTree::Node& leaf) const
  {
    return static_cast<std::size_t>(this->Tree.Order()[static_cast<std::size_t>(leaf.First)]);
  }

  template <int Fixed>
  void Multiply(const double* x, double* out, int bands) const;
  void Product(const double* x, double* out, int bands) const
  {
    bands == 1 ? this->Multiply<1>(x, out, 1)
               : (bands == 3 ? this->Multiply<3>(x, out, 3) : this->Multiply<0>(x, out, bands));
  }
  void NumberCurved()
  {
    this->Curved.resize(this->Tree.Size());
    this->CurvedCount = 0;
    for (std::size_t k = 0; k < this->Curved.size(); ++k)
    {
      const bool flat = this->Tree[static_cast<std::int32_t>(k)].Flat();
      this->Curved[k] = flat ? -1 : static_cast<std::int32_t>(this->CurvedCount++);
    }
  }
  void SumRows()
  {
    const std::vector<double> one(this->N, 1.0);
    this->Product(one.data(), this->RowSums.data(), 1);
  }

  void Build(const OcclusionScene& occluders, const ElementSet& elements,
    const std::vector<std::uint8_t>& covered, const ExchangeOptions& options, bool occlusion,
    const StageProgress& stage);
  bool MakeLinks(const ClusterRefiner& refiner, std::size_t most, const StageProgress& stage);
  /// `fixed`: 1 for rows to be brought to one; becomes 2 for rows that were let go.
  void Close(std::vector<std::uint8_t>& fixed);
  std::vector<double> ScaleStep(const std::vector<std::uint8_t>& fixed, double goal) const;
  void CloseRows(std::vector<std::uint8_t> closed);
  double WorstDefect(const std::vector<std::uint8_t>& closed) const;
};

/// out = F x: moments of x go up the tree, links carry them across, values and slopes go down.
/// Moments: sums of A x times 1, place - centre, and, where normals differ, normal - mean normal.
template <int Fixed>
void HierarchicalOperator::Internals::Multiply(const double* x, double* out, int bands) const
{
  const auto nb = static_cast<std::size_t>(Fixed > 0 ? Fixed : bands);
  const std::size_t width = 4 * nb, bent = 3 * nb;
  std::vector<double> moments(this->Tree.Size() * width), field(this->Tree.Size() * width);
  std::vector<double> turns(this->CurvedCount * bent), turned(this->CurvedCount * bent);
  const auto curved = [&](std::int32_t at) { return this->Curved[static_cast<std::size_t>(at)]; };
  const auto addFrom = [&](std::int32_t at, std::int32_t child) {
    const ElementTree::Node& node = this->Tree[at];
    double* m = moments.data() + static_cast<std::size_t>(at) * width;
    const double* c = moments.data() + static_cast<std::size_t>(child) * width;
    const Vec3 d = this->Tree[child].Center - node.Center;
    for (std::size_t b = 0; b < nb; ++b)
    {
      m[4 * b] += c[4 * b];
      m[4 * b + 1] += c[4 * b + 1] + c[4 * b] * d.x;
      m[4 * b + 2] += c[4 * b + 2] + c[4 * b] * d.y;
      m[4 * b + 3] += c[4 * b + 3] + c[4 * b] * d.z;
    }
    if (curved(at) < 0)
    {
      return;
    }
    double* t = turns.data() + static_cast<std::size_t>(curved(at)) * bent;
    const double* u = curved(child) < 0
      ? nullptr
      : turns.data() + static_cast<std::size_t>(curved(child)) * bent;
    const Vec3 n = this->Tree[child].Normal - node.Normal;
    for (std::size_t b = 0; b < nb; ++b)
    {
      for (int k = 0; k < 3; ++k)
      {
        t[3 * b + static_cast<std::size_t>(k)] +=
          (u ? u[3 * b + static_cast<std::size_t>(k)] : 0.0) + c[4 * b] * n[k];
      }
    }
  };
  this->Up([&](std::int32_t at) {
    const ElementTree::Node& node = this->Tree[at];
    if (!node.Leaf())
    {
      addFrom(at, at + 1);
      addFrom(at, node.Second);
      return;
    }
    double* m = moments.data() + static_cast<std::size_t>(at) * width;
    const std::size_t item = this->Item(node);
    const double weight = node.Area * this->Scale[item];
    for (std::size_t b = 0; b < nb; ++b)
    {
      m[4 * b] = weight * x[item * nb + b];
    }
  });
  const double unit = 1.0 / this->Tree[0].Area;
  const auto gather = [&](std::int32_t at) {
    const ElementTree::Node& node = this->Tree[at];
    double* f = field.data() + static_cast<std::size_t>(at) * width;
    double* g =
      curved(at) < 0 ? nullptr : turned.data() + static_cast<std::size_t>(curved(at)) * bent;
    const auto n = static_cast<std::size_t>(at);
    for (std::size_t e = this->Begin[n]; e < this->Begin[n + 1]; ++e)
    {
      const Entry& entry = this->Entries[e];
      const double* m = moments.data() + static_cast<std::size_t>(entry.Other) * width;
      const double kernel = unit * static_cast<double>(entry.Kernel);
      if (entry.Turn == 0)
      {
        for (std::size_t b = 0; b < nb; ++b)
        {
          f[4 * b] += kernel * m[4 * b];
        }
        continue;
      }
      const double slope[3] = { kernel * static_cast<double>(entry.Slope[0]),
        kernel * static_cast<double>(entry.Slope[1]), kernel * static_cast<double>(entry.Slope[2]) };
      for (std::size_t b = 0; b < nb; ++b)
      {
        const double* mb = m + 4 * b;
        f[4 * b] +=
          kernel * mb[0] - (slope[0] * mb[1] + slope[1] * mb[2] + slope[2] * mb[3]);
        f[4 * b + 1] += slope[0] * mb[0];
        f[4 * b + 2] += slope[1] * mb[0];
        f[4 * b + 3] += slope[2] * mb[0];
      }
      const std::int32_t bend = curved(entry.Other);
      if (!g && bend < 0)
      {
        continue;
      }
      const ExchangeSlope model(node, this->Tree[entry.Other]);
      const double scale = kernel * (entry.Turn / 255.0);
      const double* t = bend < 0 ? nullptr : turns.data() + static_cast<std::size_t>(bend) * bent;
      const Vec3 there = (scale * model.TurnB) * model.R;
      const Vec3 here = (scale * model.TurnA) * model.R;
      for (std::size_t b = 0; b < nb; ++b)
      {
        if (t)
        {
          f[4 * b] -= there.x * t[3 * b] + there.y * t[3 * b + 1] + there.z * t[3 * b + 2];
        }
        for (std::size_t k = 0; g && k < 3; ++k)
        {
          g[3 * b + k] += m[4 * b] * here[static_cast<int>(k)];
        }
      }
    }
    if (at == 0 && node.Leaf())
    {
      std::fill(out, out + nb, 0.0); // one element sees nothing of itself
    }
  };
  this->Down(gather, [&](std::int32_t at, std::int32_t parent) {
    const ElementTree::Node& node = this->Tree[at];
    const ElementTree::Node& above = this->Tree[parent];
    const Vec3 d = node.Center - above.Center;
    double* f = field.data() + static_cast<std::size_t>(at) * width;
    const double* p = field.data() + static_cast<std::size_t>(parent) * width;
    for (std::size_t b = 0; b < nb; ++b)
    {
      f[4 * b] += p[4 * b] + (p[4 * b + 1] * d.x + p[4 * b + 2] * d.y + p[4 * b + 3] * d.z);
      f[4 * b + 1] += p[4 * b + 1];
      f[4 * b + 2] += p[4 * b + 2];
      f[4 * b + 3] += p[4 * b + 3];
    }
    if (curved(parent) >= 0)
    {
      const Vec3 n = node.Normal - above.Normal;
      const double* q = turned.data() + static_cast<std::size_t>(curved(parent)) * bent;
      double* g =
        curved(at) < 0 ? nullptr : turned.data() + static_cast<std::size_t>(curved(at)) * bent;
      for (std::size_t b = 0; b < nb; ++b)
      {
        f[4 * b] += q[3 * b] * n.x + q[3 * b + 1] * n.y + q[3 * b + 2] * n.z;
        for (std::size_t k = 3 * b; g && k < 3 * b + 3; ++k)
        {
          g[k] += q[k];
        }
      }
    }
    if (node.Leaf())
    {
      const std::size_t item = this->Item(node);
      for (std::size_t b = 0; b < nb; ++b)
      {
        out[item * nb + b] = this->Scale[item] * f[4 * b];
      }
    }
  });
}

bool HierarchicalOperator::Internals::MakeLinks(
  const ClusterRefiner& refiner, std::size_t most, const StageProgress& stage)
{
  std::vector<std::vector<ClusterLink>> parts(1);
  ClusterRefiner::Tally tally;
  const std::size_t wanted = std::clamp<std::size_t>(this->N / 8, 64, 32768);
  const std::vector<NodePair> tasks = refiner.Tasks(wanted, parts[0], tally);
  parts.resize(tasks.size() + 1);
  std::vector<ClusterRefiner::Tally> tallies(tasks.size() + 1);
  tallies[0] = tally;
  std::atomic<std::size_t> total{ parts[0].size() };
  std::atomic<bool> over{ false };
  ParallelFor(
    tasks.size(), this->Threads, stage,
    [&](std::size_t k) {
      if (over)
      {
        return;
      }
      auto& links = parts[k + 1];
      const bool fits = refiner.Refine(tasks[k], most, links, tallies[k + 1]);
      links.shrink_to_fit();
      if (!fits || (total += links.size()) > most)
      {
        over = true;
      }
    },
    1e-3);
  if (over)
  {
    return false;
  }
  this->Begin.assign(this->Tree.Size() + 1, 0);
  for (const auto& part : parts)
  {
    for (const ClusterLink& link : part)
    {
      ++this->Begin[static_cast<std::size_t>(link.A) + 1];
      ++this->Begin[static_cast<std::size_t>(link.B) + 1];
    }
  }
  for (std::size_t k = 1; k < this->Begin.size(); ++k)
  {
    this->Begin[k] += this->Begin[k - 1];
  }
  this->Entries.resize(this->Begin.back());
  std::vector<std::size_t> next(this->Begin.begin(), this->Begin.end() - 1);
  for (auto& part : parts)
  {
    for (const ClusterLink& link : part)
    {
      const auto turn = static_cast<std::uint8_t>(link.Slope * 255.0f);
      const Vec3 slope = turn == 0
        ? Vec3{}
        : (turn / 255.0) * ExchangeSlope(this->Tree[link.A], this->Tree[link.B]).Slope;
      const auto x = static_cast<float>(slope.x), y = static_cast<float>(slope.y),
                 z = static_cast<float>(slope.z);
      const double back =
        static_cast<double>(link.Factor) * this->Tree[link.A].Area / this->Tree[link.B].Area;
      this->Entries[next[static_cast<std::size_t>(link.A)]++] = { link.B, link.Kernel, { x, y, z },
        turn, Coded(link.Factor), Coded(link.FormA), Coded(link.FormB), Coded(link.SightA),
        Coded(link.SightB) };
      this->Entries[next[static_cast<std::size_t>(link.B)]++] = { link.A, link.Kernel,
        { -x, -y, -z }, turn, Coded(back), Coded(link.FormB), Coded(link.FormA),
        Coded(link.SightB), Coded(link.SightA) };
    }
    std::vector<ClusterLink>().swap(part);
  }
  this->LinkCount = total;
  this->Pairs = this->Rays = 0;
  for (const auto& t : tallies)
  {
    this->Pairs += t.Pairs;
    this->Rays += t.Rays;
  }
  return true;
}

void HierarchicalOperator::Internals::Build(const OcclusionScene& occluders,
  const ElementSet& elements, const std::vector<std::uint8_t>& covered,
  const ExchangeOptions& options, bool occlusion, const StageProgress& stage)
{
  const std::size_t base = this->N * 600; // tree, shapes, moments of a product
  std::size_t most = std::numeric_limits<std::size_t>::max();
  if (options.MemoryLimit)
  {
    most = (options.MemoryLimit - base) / (2 * sizeof(Entry) + sizeof(ClusterLink));
  }
  for (this->Loosened = 1.0;; this->Loosened *= 2.0)
  {
    const ClusterRefiner refiner(
      this->Tree, elements, occluders, options, occlusion, this->Loosened, covered);
    if (this->MakeLinks(refiner, most, stage))
    {
      return;
    }
    if (this->Loosened * options.RelativeTolerance > 4.0)
    {
      throw InputError("MemoryLimit", -1, static_cast<double>(options.MemoryLimit) / MiB,
        "more for the coarsest links of " + std::to_string(this->N) + " elements");
    }
  }
}

/// One step of Newton's method on d_i (S d)_i = A_i over the fixed rows: relative changes of d by
/// conjugate gradients, until the squared residual is below `goal` of its first value.
std::vector<double> HierarchicalOperator::Internals::ScaleStep(
  const std::vector<std::uint8_t>& fixed, double goal) const
{
  const std::size_t n = this->N;
  std::vector<double> x(n, 0.0), r(n), z(n), p(n), product(n);
  double rz = 0.0;
  const auto precondition = [&](std::size_t i) {
    const double row = this->RowSums[i] * this->Areas[i];
    z[i] = fixed[i] == 1 && row > 0.0 ? r[i] / row : 0.0;
    return r[i] * z[i];
  };
  for (std::size_t i = 0; i < n; ++i)
  {
    r[i] = fixed[i] == 1 ? this->Areas[i] * (1.0 - this->RowSums[i]) : 0.0;
    rz += precondition(i);
    p[i] = z[i];
  }
  goal *= rz;
  for (int iteration = 0; iteration < 12 && rz > goal; ++iteration)
  {
    this->Product(p.data(), product.data(), 1);
    double pq = 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
      product[i] = fixed[i] == 1 ? this->Areas[i] * (product[i] + this->RowSums[i] * p[i]) : 0.0;
      pq += p[i] * product[i];
    }
    if (!(pq > 0.0))
    {
      break;
    }
    const double alpha = rz / pq;
    double next = 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
      x[i] += alpha * p[i];
      r[i] -= alpha * product[i];
      next += precondition(i);
    }
    const double beta = next / rz;
    rz = next;
    for (std::size_t i = 0; i < n; ++i)
    {
      p[i] = z[i] + beta * p[i];
    }
  }
  return x;
}

/// Scales S by d on both sides so that the fixed rows sum to one. Rows that only a large change
/// would mend are let go: they are not what they seem.
void HierarchicalOperator::Internals::Close(std::vector<std::uint8_t>& fixed)
{
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 24; ++step)
  {
    this->SumRows();
    const double worst = this->WorstDefect(fixed);
    if (worst < 4e-15 || (worst < 1e-12 && worst > 0.5 * last))
    {
      return;
    }
    bool gone = false;
    for (std::size_t i = 0; i < this->N && step > 4 && worst > 0.3 * last; ++i)
    {
      // What does not come nearer: elements that see little but each other, say.
      if (fixed[i] == 1 && std::abs(1.0 - this->RowSums[i]) > 0.3 * worst)
      {
        fixed[i] = 2;
        this->Scale[i] = std::min(1.0, this->Scale[i] / this->RowSums[i]);
        gone = true;
      }
    }
    last = worst;
    if (gone)
    {
      continue;
    }
    const std::vector<double> x = this->ScaleStep(fixed, 1e-4);
    for (std::size_t i = 0; i < this->N; ++i)
    {
      const double next = this->Scale[i] * (1.0 + x[i]);
      if (fixed[i] == 1 && !(next > 0.8 && next < 1.25))
      {
        fixed[i] = 2;
        this->Scale[i] = std::min(1.0, this->Scale[i] / this->RowSums[i]);
        gone = true;
      }
    }
    for (std::size_t i = 0; i < this->N && !gone; ++i)
    {
      this->Scale[i] *= 1.0 + x[i];
    }
  }
  this->SumRows();
}

double HierarchicalOperator::Internals::WorstDefect(const std::vector<std::uint8_t>& closed) const
{
  double worst = 0.0;
  for (std::size_t i = 0; i < this->N; ++i)
  {
    worst = std::max(worst, closed[i] == 1 ? std::abs(1.0 - this->RowSums[i]) : 0.0);
  }
  return worst;
}

void HierarchicalOperator::Internals::CloseRows(std::vector<std::uint8_t> closed)
{
  for (const std::uint8_t c : closed)
  {
    this->Report.ClosedRows += c;
  }
  this->Report.DefectBefore = this->WorstDefect(closed);
  std::vector<std::uint8_t> fixed = closed;
  for (int round = 0; round < 4; ++round)
  {
    bool any = round == 0 && this->Report.ClosedRows;
    for (std::size_t i = 0; i < this->N; ++i)
    {
      if (!fixed[i] && this->RowSums[i] > 1.0 + 1e-14)
      {
        fixed[i] = 1;
        any = true;
      }
    }
    if (!any)
    {
      break;
    }
    this->Close(fixed);
  }
  this->Report.ClosedRows = 0;
  for (std::size_t i = 0; i < this->N; ++i)
  {
    closed[i] = closed[i] && fixed[i] == 1;
    this->Report.ClosedRows += closed[i];
  }
  this->Report.DefectAfter = this->WorstDefect(closed);
  for (std::size_t i = 0; i < this->N; ++i)
  {
    this->Report.LargestChange =
      std::max(this->Report.LargestChange, 2.0 * std::abs(this->Scale[i] - 1.0));
    this->Closed[i] = fixed[i] == 1 && std::abs(this->RowSums[i] - 1.0) < 1e-9;
  }
  // Faces in one another are seen more than once: the exchange must not make light all the same.
  const double worst = *std::max_element(this->RowSums.begin(), this->RowSums.end());
  if (worst > 1.0 + 1e-12)
  {
    for (std::size_t i = 0; i < this->N; ++i)
    {
      this->Scale[i] /= std::max(1.0, this->RowSums[i]);
    }
    this->SumRows();
  }
}

std::size_t HierarchicalOperator::LeastBytes(std::size_t n)
{
  return n * (600 + 4 * (2 * sizeof(Entry) + sizeof(ClusterLink)));
}

HierarchicalOperator::HierarchicalOperator(const Scene& scene, const OcclusionScene& occluders,
  const ElementSet& elements, const ExchangeOptions& options, const StageProgress& stage)
  : Impl(new Internals)
{
  Internals& m = *this->Impl;
  m.N = elements.Size();
  m.Areas = elements.GetAreas();
  m.Threads = options.Threads;
  const std::size_t least = LeastBytes(m.N);
  if (options.MemoryLimit && least > options.MemoryLimit)
  {
    throw InputError("MemoryLimit", -1, static_cast<double>(options.MemoryLimit) / MiB,
      "at least " +
        std::to_string(static_cast<long long>(std::ceil(static_cast<double>(least) / MiB))) +
        " MiB for links between clusters of " + std::to_string(m.N) + " elements");
  }
  m.Scale.assign(m.N, 1.0);
  m.RowSums.assign(m.N, 0.0);
  m.Closed.assign(m.N, 0);
  if (m.N == 0)
  {
    m.Begin.assign(1, 0);
    return;
  }
  const bool occlusion = options.Occlusion && FindConvexity(scene) == Convexity::General;
  const auto part = [&](double from, double to) {
    StageProgress p = stage;
    p.Begin = stage.Begin + from * (stage.End - stage.Begin);
    p.End = stage.Begin + to * (stage.End - stage.Begin);
    return p;
  };
  std::unique_ptr<ClusterProbes> probes;
  if (options.Occlusion)
  {
    probes = std::make_unique<ClusterProbes>(occluders, elements, options, part(0.0, 0.05));
  }
  const std::vector<std::uint8_t> covered =
    occlusion ? probes->Covered : std::vector<std::uint8_t>();
  m.Tree = ElementTree(elements, covered);
  m.NumberCurved();
  m.Build(occluders, elements, covered, options, occlusion, part(0.05, 0.95));
  m.SumRows();
  if (options.Occlusion)
  {
    std::vector<std::uint8_t> closed = probes->Closed(m.Tree);
    const std::vector<double> one(m.N, 1.0);
    std::vector<double> form(m.N), sight(m.N);
    this->ApplyError(one.data(), form.data(), sight.data(), 1);
    for (std::size_t i = 0; i < m.N; ++i)
    {
      // A row that misses more than its own error explains sees an opening the probes did not.
      closed[i] =
        closed[i] && std::abs(1.0 - m.RowSums[i]) <= 5.0 * (form[i] + sight[i]) + 1e-7;
    }
    m.CloseRows(std::move(closed));
  }
}

HierarchicalOperator::~HierarchicalOperator() = default;

std::size_t HierarchicalOperator::Size() const { return this->Impl->N; }
const std::vector<double>& HierarchicalOperator::Areas() const { return this->Impl->Areas; }
double HierarchicalOperator::RowSum(std::size_t i, int) const { return this->Impl->RowSums[i]; }
std::size_t HierarchicalOperator::Links() const { return this->Impl->LinkCount; }

void HierarchicalOperator::Apply(const double* B, double* out, int bands) const
{
  if (this->Impl->N > 0)
  {
    this->Impl->Product(B, out, bands);
  }
}

void HierarchicalOperator::ApplyError(
  const double* B, double* formFactor, double* visibility, int bands) const
{
  const Internals& m = *this->Impl;
  if (m.N == 0)
  {
    return;
  }
  const auto nb = static_cast<std::size_t>(bands);
  // Of each node: areas times 1, B and B^2; closed area and what it receives.
  std::vector<double> received(m.N * nb);
  m.Product(B, received.data(), bands);
  std::vector<double> first(m.Tree.Size() * nb), second(first), level(first), form(first),
    sight(first);
  m.Up([&](std::int32_t at) {
    const ElementTree::Node& node = m.Tree[at];
    const std::size_t n = static_cast<std::size_t>(at) * nb;
    const auto below = static_cast<std::size_t>(at + 1) * nb;
    const auto beside = static_cast<std::size_t>(std::max(0, node.Second)) * nb;
    for (std::size_t b = 0; b < nb; ++b)
    {
      if (node.Leaf())
      {
        const std::size_t item = m.Item(node);
        const double value = B[item * nb + b];
        first[n + b] = node.Area * value;
        second[n + b] = node.Area * value * value;
        level[n + b] = m.Closed[item] ? node.Area * received[item * nb + b] : 0.0;
        continue;
      }
      first[n + b] = first[below + b] + first[beside + b];
      second[n + b] = second[below + b] + second[beside + b];
      level[n + b] = level[below + b] + level[beside + b];
    }
  });
  const auto gather = [&](std::int32_t at) {
    const auto n = static_cast<std::size_t>(at);
    for (std::size_t e = m.Begin[n]; e < m.Begin[n + 1]; ++e)
    {
      const Entry& entry = m.Entries[e];
      const double factor = Decoded(entry.Factor);
      const double own = factor * Decoded(entry.Form), far = factor * Decoded(entry.Far);
      const double hidden = factor * Decoded(entry.Sight), dim = factor * Decoded(entry.Dim);
      const auto other = static_cast<std::size_t>(entry.Other) * nb;
      const double area = m.Tree[entry.Other].Area;
      for (std::size_t b = 0; b < nb; ++b)
      {
        const double mean = first[other + b] / area;
        const double base = level[n * nb + b] / m.Tree[at].Area;
        const double off = (mean - base) * (mean - base);
        const double spread = std::max(0.0, second[other + b] / area - mean * mean);
        form[n * nb + b] += own * own * off + FarShare * FarShare * far * far * spread;
        sight[n * nb + b] += hidden * hidden * off + dim * dim * spread;
      }
    }
  };
  m.Down(gather, [&](std::int32_t at, std::int32_t parent) {
    const std::size_t n = static_cast<std::size_t>(at) * nb;
    const std::size_t p = static_cast<std::size_t>(parent) * nb;
    const bool leaf = m.Tree[at].Leaf();
    for (std::size_t b = 0; b < nb; ++b)
    {
      form[n + b] += form[p + b];
      sight[n + b] += sight[p + b];
      if (leaf)
      {
        const std::size_t item = m.Item(m.Tree[at]) * nb + b;
        formFactor[item] = Alike * std::sqrt(form[n + b]) + 6e-8 * std::abs(received[item]);
        visibility[item] = std::sqrt(sight[n + b]);
      }
    }
  });
  if (m.N == 1)
  {
    std::fill(formFactor, formFactor + nb, 0.0);
    std::fill(visibility, visibility + nb, 0.0);
  }
}

std::vector<std::int32_t> HierarchicalOperator::Components() const
{
  const Internals& m = *this->Impl;
  // A linked node's elements all exchange with the same others.
  LinkedSets sets(m.Tree.Size());
  std::vector<std::uint8_t> linked(m.Tree.Size(), 0);
  for (std::size_t k = 0; k < m.Tree.Size(); ++k)
  {
    const auto at = static_cast<std::int32_t>(k);
    const std::int32_t parent = m.Tree[at].Parent;
    const bool above = parent >= 0 && linked[static_cast<std::size_t>(parent)];
    if (above)
    {
      sets.Join(at, parent);
    }
    linked[k] = above || m.Begin[k + 1] > m.Begin[k];
    for (std::size_t e = m.Begin[k]; e < m.Begin[k + 1]; ++e)
    {
      sets.Join(at, m.Entries[e].Other);
    }
  }
  std::vector<std::int32_t> leafOf(m.N), number(m.Tree.Size(), -1), label(m.N);
  for (std::size_t k = 0; k < m.Tree.Size(); ++k)
  {
    const ElementTree::Node& node = m.Tree[static_cast<std::int32_t>(k)];
    if (node.Leaf())
    {
      leafOf[m.Item(node)] = static_cast<std::int32_t>(k);
    }
  }
  std::int32_t next = 0;
  for (std::size_t i = 0; i < m.N; ++i)
  {
    auto& n = number[static_cast<std::size_t>(sets.Root(leafOf[i]))];
    n = n < 0 ? next++ : n;
    label[i] = n;
  }
  return label;
}

std::size_t HierarchicalOperator::MemoryBytes() const
{
  const Internals& m = *this->Impl;
  return m.Tree.MemoryBytes() + m.Entries.size() * sizeof(Entry) +
    m.Begin.size() * sizeof(std::size_t) + m.N * (3 * sizeof(double) + 1);
}
std::int64_t HierarchicalOperator::Samples() const { return this->Impl->Pairs + this->Impl->Rays; }
ClosureReport HierarchicalOperator::Closure() const { return this->Impl->Report; }
std::string HierarchicalOperator::Description() const
{
  const Internals& m = *this->Impl;
  std::string text = "hierarchical, " + std::to_string(m.N) + " elements, " +
    std::to_string(m.LinkCount) + " links, " + std::to_string(m.Rays) + " rays";
  if (m.Loosened > 1.0)
  {
    text += ", coarser than asked (memory limit)";
  }
  return text;
}

} // namespace radiometry
