// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/DenseOperator.h"
#include "radiometry/formfactor/HierarchicalOperator.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/solver/RadiosityRun.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace radiometry
{
namespace
{

constexpr double MiB = 1024.0 * 1024.0;
constexpr double PairSeconds = 4e-6;
/// Elements whose pairs are few enough in any case, and those worth their cost by the tolerance.
constexpr double FewestPaired = 600.0;
constexpr double RaysOfPairs = 2.5;
constexpr double LinkedSeconds = 3e-4; // of an element's links and what they need, on one thread
/// Elements from which links between clusters are preferred to rays.
constexpr std::size_t FewestLinked = 10000;
/// Bytes a Monte Carlo operator takes for each element beside its rays, and the fewest rays.
constexpr std::size_t CarloElement = 48;
constexpr std::size_t FewestRays = 8;

std::size_t CarloBytes(std::size_t n, std::size_t rays)
{
  return n * (CarloElement + rays * sizeof(std::int32_t));
}

} // namespace

const char* MethodName(RadiosityMethod method)
{
  switch (method)
  {
    case RadiosityMethod::Dense:
      return "Dense";
    case RadiosityMethod::Hierarchical:
      return "Hierarchical";
    case RadiosityMethod::MonteCarlo:
      return "MonteCarlo";
    default:
      return "Auto";
  }
}

std::size_t RadiosityRun::DenseLimit() const
{
  std::size_t n = this->Context.Options.RelativeTolerance < 0.003 ? 8192 : 4096;
  while (n > 64 && DenseOperator::LeastBytes(n) > this->Context.Memory)
  {
    n = n * 3 / 4;
  }
  return n;
}

std::size_t RadiosityRun::AutomaticLimit() const
{
  // Pairs grow with the elements' square, rays with that of the accuracy: where something may hide
  // something, n^2/2 pairs cost as much as rays to the tolerance from n elements at some 2.5/tolerance^2.
  const std::size_t limit = this->DenseLimit();
  const double tolerance = this->Context.Options.RelativeTolerance;
  const bool rays = this->Context.Options.Method == RadiosityMethod::Auto &&
    this->Context.Options.Occlusion && !this->Context.Convex;
  const double few = std::max(FewestPaired, RaysOfPairs / (tolerance * tolerance));
  return rays && few < static_cast<double>(limit) ? static_cast<std::size_t>(few) : limit;
}

std::size_t RadiosityRun::MostElements(RadiosityMethod method, std::size_t coarsest) const
{
  if (method == RadiosityMethod::Dense)
  {
    return std::max(this->AutomaticLimit(), coarsest);
  }
  // Room for more rays, or for links to spare.
  const std::size_t each = method == RadiosityMethod::Hierarchical
    ? 4 * HierarchicalOperator::LeastBytes(10000) / 10000
    : 2 * CarloBytes(1, 64);
  const std::size_t most = this->Context.Memory / each;
  return std::max(coarsest, std::min(most, MostRefined));
}

void RadiosityRun::CheckMemory(std::size_t elements) const
{
  const RadiosityOptions& options = this->Context.Options;
  const auto bytes = [elements](RadiosityMethod method) {
    switch (method)
    {
      case RadiosityMethod::Dense:
        return DenseOperator::LeastBytes(elements);
      case RadiosityMethod::Hierarchical:
        return HierarchicalOperator::LeastBytes(elements);
      default:
        return CarloBytes(elements, FewestRays);
    }
  };
  RadiosityMethod least = options.Method;
  if (least == RadiosityMethod::Auto)
  {
    least = RadiosityMethod::MonteCarlo;
    for (const auto method : { RadiosityMethod::Dense, RadiosityMethod::Hierarchical })
    {
      const bool possible = !options.FollowsPaths();
      least = possible && (bytes(method) < bytes(least) || !options.Occlusion) ? method : least;
    }
  }
  if (bytes(least) > this->Context.Memory)
  {
    throw InputError("MemoryLimit", -1, static_cast<double>(this->Context.Memory) / MiB,
      "at least " +
        std::to_string(static_cast<long long>(std::ceil(static_cast<double>(bytes(least)) / MiB))) +
        " MiB, " + (options.Method == RadiosityMethod::Auto ? "the least of all methods (" : "(") +
        MethodName(least) + ", " + std::to_string(elements) + " elements)");
  }
}

RadiosityMethod RadiosityRun::Choose(const ElementSet& elements)
{
  const std::size_t n = elements.Size();
  const RadiosityOptions& options = this->Context.Options;
  std::string& why = this->Result.MethodWhy;
  if (options.Method == RadiosityMethod::MonteCarlo && !options.Occlusion)
  {
    throw InputError("Method", -1, "MonteCarlo",
      "Auto, Dense or Hierarchical where Occlusion is off: rays cannot pass through what they meet");
  }
  this->CheckMemory(n);
  if (options.Method != RadiosityMethod::Auto)
  {
    why = std::string(MethodName(options.Method)) + " as asked";
    return options.Method;
  }
  if (options.FollowsPaths())
  {
    why = "MonteCarlo: its rays follow light over mirrors and through panes";
    return RadiosityMethod::MonteCarlo;
  }
  const std::string count = std::to_string(n) + " elements";
  const std::size_t limit = this->AutomaticLimit();
  const double wanted = std::clamp(10.0 / options.RelativeTolerance, 200.0, 2000.0);
  const std::size_t fine = options.Refinement == RefinementMode::Off
    ? n
    : elements.CountAtArea(this->Area / wanted);
  std::string reason;
  if (n > limit || fine > limit + limit / 2)
  {
    reason = count + " (" + std::to_string(fine) + " when refined for the tolerance), more than the " +
      std::to_string(limit) + " whose pairs would be worth their cost";
  }
  else
  {
    const double threads = options.Threads > 0 ? options.Threads : 2.0;
    const double pairs = 0.5 * static_cast<double>(n) * static_cast<double>(n);
    if (PairSeconds * pairs / threads > 0.5 * this->Left())
    {
      reason = "all pairs of " + count + " do not fit in the time budget";
    }
  }
  if (reason.empty())
  {
    why = "Dense: all pairs of " + count + " are few";
    return RadiosityMethod::Dense;
  }
  std::string more;
  const RadiosityMethod method = this->ChooseForMany(n, more);
  why = std::string(MethodName(method)) + ": " + reason + more;
  return method;
}

RadiosityMethod RadiosityRun::ChooseForMany(std::size_t n, std::string& why) const
{
  const bool fits = HierarchicalOperator::LeastBytes(n) <= this->Context.Memory;
  const int threads =
    this->Context.Options.Threads > 0 ? this->Context.Options.Threads : AvailableThreads();
  const bool soon = LinkedSeconds * static_cast<double>(n) / threads < 0.6 * this->Left();
  const bool possible = fits && soon;
  if (!this->Context.Options.Occlusion || (possible && n >= FewestLinked))
  {
    why = "; clusters of them exchange light over links";
    return RadiosityMethod::Hierarchical;
  }
  why = possible || n < FewestLinked ? ""
    : fits ? "; rays from each of them can end when time does, links between clusters cannot"
           : "; rays from each of them fit in the memory limit, links between clusters do not";
  return RadiosityMethod::MonteCarlo;
}

} // namespace radiometry
