// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ViewFactors.h"

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/formfactor/PatchTree.h"
#include "radiometry/formfactor/ViewFactorClosure.h"
#include "radiometry/formfactor/ViewFactorPairs.h"
#include "radiometry/formfactor/ViewFactorRays.h"
#include "radiometry/visibility/Convexity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

namespace radiometry
{
namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();
constexpr std::uint32_t FirstRays = 256;     // of each patch
constexpr std::uint32_t MostRays = 1u << 13; // ... for its environment
constexpr std::uint32_t MostHits = 1u << 22; // ... for all that it sees (MonteCarlo)
// Pairs of triangles up to which Auto takes every one; fewer where something stands between.
constexpr double MostPairs = 1e7;
constexpr double MostBlockedPairs = 1e5;

/// One run, stage by stage.
class Run
{
public:
  Run(const Scene& scene, const std::vector<std::int32_t>& patchOfCell, std::size_t patches,
    const ViewFactorOptions& options, Monitor* monitor);
  ViewFactorResult Compute();

private:
  StageProgress Stage(double begin, double end, const char* name) const
  {
    return { this->Listener, begin, end, name };
  }
  /// How much of a round that is expected to take so many seconds there is time for; all without a
  /// budget. The same on all ranks.
  double Affordable(double seconds) const
  {
    double times[2] = { this->Result.Convergence.Elapsed(), seconds };
    if (Options.Ranks)
    {
      Options.Ranks->Largest(times, 2);
    }
    return Options.TimeBudget > 0.0
      ? std::clamp((Options.TimeBudget - times[0]) / std::max(times[1], 1e-9), 0.0, 1.0)
      : 1.0;
  }
  /// More rays of the groups, as many as there is time for; false: there is none.
  bool TraceMore(std::vector<std::uint32_t>& wanted, double raySeconds, const StageProgress& stage);
  void ChooseMethod();
  /// Says how long all will take; false: no more is wanted.
  bool Foretell(double seconds);
  double EnvironmentSeconds() const;
  bool ByPairs();
  bool ByRays();
  void RowsFromHits();
  void FindOpenness();
  void LookAround();
  void Correct();
  void Report();
  struct View
  {
    RayShare Sky, Ground, Environment, Blocked;
  };
  View Around(std::int32_t place) const;
  double Goal(double value) const
  {
    return std::max(Options.RelativeTolerance * value, Options.AbsoluteTolerance);
  }
  double Area(std::int32_t place) const { return Tree[Tree.Root(place)].Area; }

  const Scene& Surface;
  ViewFactorOptions Options;
  std::size_t Patches;
  Monitor* Listener;
  ElementSet Elements;
  std::vector<std::int32_t> GroupOfElement;
  PatchTree Tree;
  OcclusionScene Occluders;
  std::vector<std::int32_t> GroupOfSide; // places
  std::unique_ptr<Blockers> Between;     // null: nothing can stand between
  std::unique_ptr<ViewFactorRays> Rays;
  std::vector<GroupExchange> Rows;
  std::vector<double> Areas, Sums, SumErrors, High; // by place; High: of the open hemisphere
  std::vector<std::uint8_t> MayBlock, MaySee; // by place: a side of no group, or anything, is ahead
  bool Hierarchical = false, ByHits = false, Late = false;
  double PairTolerance = 1e-6;
  double WorstUnexplained = 0.0;
  double RaySeconds = 0.0; // of one ray of the environment
  ViewFactorResult Result;
};

std::vector<std::int32_t> GroupsOf(
  const ElementSet& elements, const std::vector<std::int32_t>& patchOfCell)
{
  std::vector<std::int32_t> groups;
  groups.reserve(elements.Size());
  for (const Patch& patch : elements.GetPatches())
  {
    groups.push_back(patchOfCell[static_cast<std::size_t>(patch.Cell)]);
  }
  return groups;
}

Run::Run(const Scene& scene, const std::vector<std::int32_t>& patchOfCell, std::size_t patches,
  const ViewFactorOptions& options, Monitor* monitor)
  : Surface(scene)
  , Options(options)
  , Patches(patches)
  , Listener(monitor)
  , Elements(scene, options.BackFaces)
  , GroupOfElement(GroupsOf(Elements, patchOfCell))
  , Tree(Elements, GroupOfElement, patches)
  , Occluders(scene)
  , GroupOfSide(2 * scene.Triangles.size(), -1)
{
  std::vector<std::int32_t> place(patches, -1);
  for (std::size_t g = 0; g < Tree.Groups(); ++g)
  {
    const auto at = static_cast<std::int32_t>(g);
    place[static_cast<std::size_t>(Tree.Name(at))] = at;
    Areas.push_back(this->Area(at));
  }
  for (std::size_t e = 0; e < Elements.Size(); ++e)
  {
    const Patch& patch = Elements.GetPatches()[e];
    if (GroupOfElement[e] >= 0)
    {
      GroupOfSide[2 * static_cast<std::size_t>(patch.Triangle) + patch.Side] =
        place[static_cast<std::size_t>(GroupOfElement[e])];
    }
  }
}

void Run::ChooseMethod()
{
  const double n = static_cast<double>(Elements.Size());
  const double pairs = 0.5 * n * n;
  Result.OcclusionNeeded = FindConvexity(Surface) == Convexity::General;
  if (Options.Occlusion && Result.OcclusionNeeded)
  {
    Between = std::make_unique<Blockers>(Surface);
  }
  std::ostringstream why;
  ViewFactorMethod method = Options.Method;
  if (method == ViewFactorMethod::Auto)
  {
    const double most = Between ? MostBlockedPairs : MostPairs;
    const bool few = pairs <= most || n < 4.0 * static_cast<double>(Tree.Groups());
    method = few ? ViewFactorMethod::Dense : ViewFactorMethod::Hierarchical;
    why << " (Auto: " << Elements.Size() << " sides of triangles in " << Tree.Groups() << " patches"
        << (Between ? "" : ", nothing stands between") << ")";
  }
  Hierarchical = method == ViewFactorMethod::Hierarchical;
  ByHits = method == ViewFactorMethod::MonteCarlo;
  const char* const names[] = { "", "Dense: every pair of triangles",
    "Hierarchical: pairs of clusters of triangles", "MonteCarlo: rays from every patch" };
  Result.Method = names[static_cast<int>(method)] + why.str();
  // Finer than asked for where that costs little; else 0.02 of it, which pairs keep at fifty times
  // that tolerance (see ViewFactorPairs).
  const double asked = std::clamp(Options.RelativeTolerance, 1e-12, 1e-2);
  PairTolerance =
    pairs <= 4e3 ? std::min(1e-9, asked) : (pairs <= 3e4 ? std::min(1e-6, asked) : asked);
}

bool Run::TraceMore(
  std::vector<std::uint32_t>& wanted, double raySeconds, const StageProgress& stage)
{
  constexpr double worthwhile = 0.1;
  double rays = 0.0;
  for (std::size_t g = 0; g < wanted.size(); ++g)
  {
    const auto place = static_cast<std::int32_t>(g);
    rays += std::max(0.0, static_cast<double>(wanted[g]) - Rays->Rays(place));
  }
  const double share = this->Affordable(rays * raySeconds);
  Late = Late || share < 1.0;
  if (share < worthwhile)
  {
    return false;
  }
  for (std::size_t g = 0; g < wanted.size() && share < 1.0; ++g)
  {
    const double done = Rays->Rays(static_cast<std::int32_t>(g));
    wanted[g] = static_cast<std::uint32_t>(done + share * std::max(0.0, wanted[g] - done));
  }
  Rays->Trace(wanted, stage);
  return true;
}

/// What the rays still have to count, from the errors of the first ones.
double Run::EnvironmentSeconds() const
{
  double rays = 0.0;
  for (std::size_t g = 0; g < Tree.Groups(); ++g)
  {
    const auto place = static_cast<std::int32_t>(g);
    double ratio = 0.0;
    const auto count = [&](const RayShare& share) {
      ratio = std::max(ratio, share.Error / std::max(this->Goal(share.Value), 1e-300));
    };
    // What the patches leave is known from the pairs: of one kind it needs no rays.
    const RayShare sky = Rays->Share(place, ViewFactorRays::Sky);
    const RayShare ground = Rays->Share(place, ViewFactorRays::Ground);
    const RayShare blocked = Rays->Share(place, ViewFactorRays::Blocked);
    const int kinds = (sky.Value > 0.0) + (ground.Value > 0.0) + (blocked.Value > 0.0);
    if (kinds > 1 && (MayBlock[g] || MaySee[g]))
    {
      count(sky);
      count(ground);
    }
    double wanted = FirstRays;
    while (wanted < FirstRays * ratio * ratio && wanted < MostRays)
    {
      wanted *= 2.0;
    }
    rays += wanted - std::min<double>(wanted, Rays->Rays(place));
  }
  return rays * this->RaySeconds;
}

bool Run::Foretell(double seconds)
{
  const double now = Result.Convergence.Elapsed();
  double whole = now + seconds + this->EnvironmentSeconds();
  if (Options.TimeBudget > 0.0)
  {
    whole = std::min(whole, std::max(now, Options.TimeBudget));
  }
  Result.Cost.PredictedAt = now;
  Result.Cost.PredictedSeconds = whole;
  if (this->Listener)
  {
    this->Listener->Predicted(whole);
  }
  return !Options.PilotOnly;
}

bool Run::ByPairs()
{
  ViewFactorPairs pairs(Tree, Occluders, Between.get(), Options, Hierarchical, PairTolerance);
  Rows = pairs.Compute(this->Stage(0.05, 0.7, "view factors"), Result.Convergence,
    [this](double seconds) { return this->Foretell(seconds); });
  Result.Pairs = pairs.Pairs();
  Result.Rays += pairs.Rays();
  Late = Late || pairs.OutOfTime();
  return !Options.PilotOnly;
}

/// The symmetric exchange from what both ends' rays met, by the number of rays a square metre.
void Run::RowsFromHits()
{
  struct End
  {
    std::int32_t I, J;
    double Value, Error, Weight;
  };
  std::vector<End> ends;
  for (std::size_t g = 0; g < Tree.Groups(); ++g)
  {
    const auto from = static_cast<std::int32_t>(g);
    for (const auto& [to, hits] : Rays->HitsOf(from))
    {
      std::array<double, ViewFactorRays::Sets> counts;
      std::copy(hits.begin(), hits.end(), counts.begin());
      const RayShare share = Rays->Share(from, counts);
      ends.push_back({ std::min(from, to), std::max(from, to), Areas[g] * share.Value,
        Areas[g] * share.Error, Rays->Rays(from) / Areas[g] });
    }
  }
  std::stable_sort(ends.begin(), ends.end(),
    [](const End& a, const End& b) { return a.I < b.I || (a.I == b.I && a.J < b.J); });
  Rows.clear();
  Result.ReciprocityBefore = 0.0;
  for (std::size_t k = 0; k < ends.size();)
  {
    const End& first = ends[k];
    const bool both = k + 1 < ends.size() && ends[k + 1].I == first.I && ends[k + 1].J == first.J;
    const double wi = Rays->Rays(first.I) / Areas[first.I];
    const double wj = Rays->Rays(first.J) / Areas[first.J];
    // An end that met nothing counts as 0.
    const End second = both ? ends[k + 1]
                            : End{ first.I, first.J, 0.0, 0.0,
                                first.I == first.J ? 0.0 : (first.Weight == wi ? wj : wi) };
    const double sum = first.Weight + second.Weight;
    const double a = first.Weight / sum, b = second.Weight / sum;
    Rows.push_back({ first.I, first.J, a * first.Value + b * second.Value, 0.0,
      std::hypot(a * first.Error, b * second.Error) });
    if (first.I != first.J)
    {
      Result.ReciprocityBefore = std::max(Result.ReciprocityBefore,
        std::abs(first.Value - second.Value) / std::min(Areas[first.I], Areas[first.J]));
    }
    k += both ? 2 : 1;
  }
}

bool Run::ByRays()
{
  std::vector<std::uint32_t> wanted(Tree.Groups(), 4096);
  double raySeconds = this->RaySeconds;
  const int rounds = 11;
  for (int round = 0; round < rounds; ++round)
  {
    const double begin = Result.Convergence.Elapsed();
    const auto before = static_cast<double>(Rays->Total());
    if (!this->TraceMore(wanted, raySeconds,
          this->Stage(0.05 + 0.6 * round / rounds, 0.05 + 0.6 * (round + 1) / rounds, "rays")))
    {
      return true;
    }
    const double traced = static_cast<double>(Rays->Total()) - before;
    raySeconds = traced > 0.0 ? (Result.Convergence.Elapsed() - begin) / traced : raySeconds;
    this->RowsFromHits();
    double value = 0.0, error = 0.0;
    std::vector<std::uint8_t> more(Tree.Groups(), 0);
    std::vector<double> ratio(Tree.Groups(), 0.0); // of error and goal, the greatest
    for (const GroupExchange& row : Rows)
    {
      const double least = std::min(Areas[row.I], Areas[row.J]);
      const double goal = least * this->Goal(row.Value / least);
      if (row.Error() > goal)
      {
        more[row.I] = more[row.J] = 1;
        const double much = row.Error() / std::max(goal, 1e-300);
        ratio[row.I] = std::max(ratio[row.I], much);
        ratio[row.J] = std::max(ratio[row.J], much);
      }
      value += row.Value;
      error += row.Error();
    }
    Result.Convergence.Add("rays", value > 0.0 ? error / value : 0.0,
      Rows.empty() ? 0.0 : error / static_cast<double>(Rows.size()), Rays->Total());
    if (round == 0)
    {
      double rays = 0.0;
      for (std::size_t g = 0; g < ratio.size(); ++g)
      {
        double then = wanted[g];
        while (then < wanted[g] * ratio[g] * ratio[g] && then < MostHits)
        {
          then *= 2.0;
        }
        rays += then - wanted[g];
      }
      if (!this->Foretell(rays * raySeconds))
      {
        return false;
      }
    }
    bool any = false;
    for (std::size_t g = 0; g < more.size(); ++g)
    {
      if (more[g] && wanted[g] < MostHits)
      {
        wanted[g] *= 2;
        any = true;
      }
    }
    if (!any || Late)
    {
      return true;
    }
  }
  return true;
}

/// Which groups have anything ahead of them, or a side that belongs to no group.
void Run::FindOpenness()
{
  const std::size_t n = Tree.Groups();
  MayBlock.assign(n, 1);
  MaySee.assign(n, 1);
  High.assign(n, 0.0);
  const Vec3 up = Normalized(Options.Up);
  std::vector<Box3> boxes(Surface.Triangles.size());
  std::vector<Vec3> normals(boxes.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
  {
    for (const Vec3& p : Surface.TriangleAt(t))
    {
      boxes[t].Add(p);
    }
    normals[t] = Normalized(AreaNormal2(Surface.TriangleAt(t)));
  }
  const BoxTree tree(boxes);
  ParallelFor(n, Options.Threads, this->Stage(0.0, 0.02, "environment"), [&](std::size_t g) {
    const auto& node = Tree[Tree.Root(static_cast<std::int32_t>(g))];
    double high = 0.0;
    for (std::int32_t e = node.Begin; e < node.End; ++e)
    {
      high += Tree.Shape(e).Area * 0.5 * (1.0 + Dot(Tree.Shape(e).Normal, up));
    }
    High[g] = high / node.Area;
    if (!node.Flat)
    {
      return;
    }
    // What lies on or under the group's plane it does not see.
    const double rounding = 1e-13 * (node.Radius + Length(node.Center));
    const auto above = [&](const Vec3& p) { return Dot(node.Axis, p - node.Center) > rounding; };
    MayBlock[g] = MaySee[g] = 0;
    const std::vector<Vec3> outline = Tree.Outline(node);
    tree.Visit(
      [&](const Box3& box) {
        const Vec3& a = node.Axis;
        return above({ a.x > 0 ? box.Max.x : box.Min.x, a.y > 0 ? box.Max.y : box.Min.y,
          a.z > 0 ? box.Max.z : box.Min.z });
      },
      [&](std::int32_t t) {
        const Triangle3 corners = Surface.TriangleAt(static_cast<std::size_t>(t));
        if (!above(corners[0]) && !above(corners[1]) && !above(corners[2]))
        {
          return true;
        }
        for (int side = 0; side < 2; ++side)
        {
          const Vec3 front = side == 0 ? normals[t] : -normals[t];
          const bool faces = std::any_of(outline.begin(), outline.end(), [&](const Vec3& p) {
            return Dot(front, p - corners[0]) > 1e-13 * (Length(p) + Length(corners[0]));
          });
          if (faces)
          {
            MaySee[g] = 1;
            if (GroupOfSide[2 * static_cast<std::size_t>(t) + static_cast<std::size_t>(side)] < 0)
            {
              MayBlock[g] = 1;
              return false;
            }
          }
        }
        return true;
      });
  });
}

/// What a group sees beside groups, from its rays and from its view factors.
Run::View Run::Around(std::int32_t g) const
{
  View view;
  const double sum = Sums[g] / Areas[g];
  const double sumError = SumErrors[g] / Areas[g] + 4.0 * Epsilon;
  const double rest = std::max(0.0, 1.0 - sum);
  const auto better = [](RayShare& best, double value, double error) {
    if (error < best.Error)
    {
      best = { std::clamp(value, 0.0, 1.0), error };
    }
  };
  view.Sky = Rays->Share(g, ViewFactorRays::Sky);
  view.Ground = Rays->Share(g, ViewFactorRays::Ground);
  view.Blocked = Rays->Share(g, ViewFactorRays::Blocked);
  // Sky and ground are what nothing hides of the open hemisphere's parts.
  const double unnoticed = MaySee[g] ? 1.0 : 0.0;
  const RayShare high = Rays->Share(g, ViewFactorRays::HitHigh);
  const RayShare low = Rays->Share(g, ViewFactorRays::HitLow);
  better(view.Sky, High[g] - high.Value, unnoticed * high.Error + 4.0 * Epsilon);
  better(view.Ground, 1.0 - High[g] - low.Value, unnoticed * low.Error + 4.0 * Epsilon);
  if (!MayBlock[g])
  {
    view.Blocked = { 0.0, 0.0 };
  }
  view.Environment = { std::min(1.0, view.Sky.Value + view.Ground.Value),
    std::hypot(view.Sky.Error, view.Ground.Error) };
  better(view.Environment, rest - view.Blocked.Value, sumError + view.Blocked.Error);
  better(view.Blocked, rest - view.Environment.Value, sumError + view.Environment.Error);
  // One part of the horizon is nothing: the other is all.
  const bool noGround = 1.0 - High[g] <= 4.0 * Epsilon;
  const bool noSky = High[g] <= 4.0 * Epsilon;
  better(view.Sky, noSky ? 0.0 : view.Environment.Value - view.Ground.Value,
    noSky ? 0.0 : view.Environment.Error + (noGround ? 0.0 : view.Ground.Error));
  better(view.Ground, noGround ? 0.0 : view.Environment.Value - view.Sky.Value,
    noGround ? 0.0 : view.Environment.Error + (noSky ? 0.0 : view.Sky.Error));
  // None is more than the groups leave.
  for (RayShare* share : { &view.Sky, &view.Ground, &view.Environment, &view.Blocked })
  {
    const double most = rest + sumError;
    share->Value = std::min(share->Value, most);
    share->Error = std::min(share->Error, std::max(share->Value, most - share->Value));
  }
  return view;
}

void Run::LookAround()
{
  Sums = ExchangeSums(Rows, Tree.Groups());
  std::vector<double> truncation(Tree.Groups(), 0.0), sampling(Tree.Groups(), 0.0);
  for (const GroupExchange& row : Rows)
  {
    for (const std::int32_t g : { row.I, row.J })
    {
      truncation[g] += row.Truncation;
      sampling[g] += row.Sampling * row.Sampling;
      if (row.I == row.J)
      {
        break;
      }
    }
  }
  SumErrors.resize(Tree.Groups());
  for (std::size_t g = 0; g < SumErrors.size(); ++g)
  {
    SumErrors[g] = truncation[g] + std::sqrt(sampling[g]);
  }
  std::vector<std::uint32_t> wanted(Tree.Groups(), FirstRays);
  const int rounds = 8;
  for (int round = 0; round < rounds; ++round)
  {
    if (!this->TraceMore(wanted, this->RaySeconds,
          this->Stage(
            0.7 + 0.27 * round / rounds, 0.7 + 0.27 * (round + 1) / rounds, "environment")))
    {
      break;
    }
    bool any = false;
    double value = 0.0, error = 0.0;
    for (std::size_t g = 0; g < wanted.size(); ++g)
    {
      const View view = this->Around(static_cast<std::int32_t>(g));
      const auto met = [&](const RayShare& s) { return s.Error <= this->Goal(s.Value); };
      value += view.Environment.Value;
      error += view.Environment.Error;
      if ((!met(view.Environment) || !met(view.Sky) || !met(view.Ground)) && wanted[g] < MostRays)
      {
        wanted[g] *= 2;
        any = true;
      }
    }
    Result.Convergence.Add("environment", value > 0.0 ? error / value : 0.0,
      wanted.empty() ? 0.0 : error / static_cast<double>(wanted.size()),
      Result.Pairs + Result.Rays + Rays->Total());
    if (!any || Late)
    {
      break;
    }
  }
}

/// Closed groups' sums are made 1 where their errors explain what is missing.
void Run::Correct()
{
  const std::size_t n = Tree.Groups();
  std::vector<std::uint8_t> closed(n, 0), fixed(n, 0);
  Result.Closed.assign(Patches, 0);
  Result.ClosureDefect.assign(Patches, 0.0);
  for (std::size_t g = 0; g < n; ++g)
  {
    const double defect = 1.0 - Sums[g] / Areas[g];
    const auto name = static_cast<std::size_t>(Tree.Name(static_cast<std::int32_t>(g)));
    closed[g] = Rays->SeesGroupsOnly(static_cast<std::int32_t>(g));
    const double explained = 2.0 * SumErrors[g] / Areas[g] + 1e-12;
    Result.LargestSum = std::max(Result.LargestSum, 1.0 - defect);
    if (closed[g] && defect > explained)
    {
      closed[g] = 0; // an opening that its rays missed
    }
    Result.Closed[name] = closed[g];
    Result.ClosureDefect[name] = closed[g] ? defect : std::min(0.0, defect);
    if (closed[g])
    {
      Result.ClosureBefore = std::max(Result.ClosureBefore, std::abs(defect));
    }
    if (-defect > explained)
    {
      WorstUnexplained = std::max(WorstUnexplained, -defect);
    }
    fixed[g] = std::abs(defect) <= explained && (closed[g] || defect < 0.0);
  }
  if (Options.Correction && Options.Occlusion)
  {
    Result.LargestCorrection = CloseExchange(Rows, Areas, fixed);
    Result.LargestCorrection = std::max(Result.LargestCorrection, CapExchange(Rows, Areas));
  }
  Sums = ExchangeSums(Rows, n);
  for (std::size_t g = 0; g < n; ++g)
  {
    if (closed[g])
    {
      Result.ClosureAfter = std::max(Result.ClosureAfter, std::abs(1.0 - Sums[g] / Areas[g]));
    }
  }
}

void Run::Report()
{
  const std::size_t n = Tree.Groups();
  Result.Areas.assign(Patches, 0.0);
  for (ViewFactorShare* share :
    { &Result.Sum, &Result.Environment, &Result.Sky, &Result.Ground, &Result.Blocked })
  {
    share->Value.assign(Patches, 0.0);
    share->Error.assign(Patches, 0.0);
  }
  for (std::size_t g = 0; g < n; ++g)
  {
    const auto place = static_cast<std::int32_t>(g);
    const auto name = static_cast<std::size_t>(Tree.Name(place));
    const View view = this->Around(place);
    Result.Areas[name] = Areas[g];
    const auto put = [&](ViewFactorShare& share, const RayShare& s) {
      share.Value[name] = s.Value;
      share.Error[name] = s.Error;
    };
    put(Result.Sum, { Sums[g] / Areas[g], SumErrors[g] / Areas[g] });
    put(Result.Environment, view.Environment);
    put(Result.Sky, view.Sky);
    put(Result.Ground, view.Ground);
    put(Result.Blocked, view.Blocked);
    if (ByHits)
    {
      // The rule of three.
      Result.Unmet.resize(Patches, 0.0);
      Result.Unmet[name] = std::min(1.0, 3.0 / Rays->Rays(place));
    }
  }
  double value = 0.0;
  Result.Rows.reserve(2 * Rows.size());
  for (const GroupExchange& row : Rows)
  {
    const std::int32_t i = Tree.Name(row.I), j = Tree.Name(row.J);
    const double error = row.Error() + 4.0 * Epsilon * row.Value;
    Result.Rows.push_back({ i, j, row.Value / Areas[row.I], error / Areas[row.I] });
    if (i != j)
    {
      Result.Rows.push_back({ j, i, row.Value / Areas[row.J], error / Areas[row.J] });
    }
    value += row.Value;
    Result.MeanTruncation += row.Truncation;
    Result.MeanSampling += row.Sampling;
    Result.OcclusionBound =
      std::max(Result.OcclusionBound, row.Value / std::min(Areas[row.I], Areas[row.J]));
  }
  if (Options.Occlusion || !Result.OcclusionNeeded)
  {
    Result.OcclusionBound = 0.0;
  }
  if (!Rows.empty() && value > 0.0)
  {
    Result.MeanTruncation /= value;
    Result.MeanSampling /= value;
  }
  std::sort(
    Result.Rows.begin(), Result.Rows.end(), [](const ViewFactorRow& a, const ViewFactorRow& b) {
      return a.From < b.From || (a.From == b.From && a.To < b.To);
    });
  Result.Rays += Rays->Total();
  std::size_t missed = 0;
  for (const ViewFactorRow& row : Result.Rows)
  {
    missed += row.Error > 1.001 * this->Goal(row.Value);
  }
  std::ostringstream outcome;
  outcome << (Late ? "Time budget reached"
                   : (missed == 0 ? "Tolerance met" : "Sample limit reached"));
  if (missed > 0)
  {
    outcome << "; " << missed << " of " << Result.Rows.size()
            << " view factors are above their tolerance";
  }
  if (!Result.Unmet.empty())
  {
    outcome << "; view factors to patches that no ray met are below "
            << *std::max_element(Result.Unmet.begin(), Result.Unmet.end()) << " (95 %)";
  }
  if (WorstUnexplained > 0.0)
  {
    outcome << "; view factors of a patch sum to " << 1.0 + WorstUnexplained
            << ": faces lie in one another (duplicates?)"
            << (Options.Correction ? "; such sums were scaled down to 1" : "");
  }
  Result.Outcome = outcome.str();
}

ViewFactorResult Run::Compute()
{
  if (!Tree.Empty())
  {
    this->ChooseMethod();
    Rays = std::make_unique<ViewFactorRays>(Tree, Occluders, GroupOfSide, Options, ByHits);
    this->FindOpenness();
    const double begin = Result.Convergence.Elapsed();
    Rays->Trace(std::vector<std::uint32_t>(Tree.Groups(), FirstRays),
      this->Stage(0.02, 0.05, "environment"));
    this->RaySeconds = (Result.Convergence.Elapsed() - begin) /
      static_cast<double>(std::max<std::int64_t>(1, Rays->Total()));
    if (ByHits ? this->ByRays() : this->ByPairs())
    {
      this->LookAround();
      this->Correct();
      this->Report();
    }
    Result.Cost.Seconds = Result.Convergence.Elapsed();
    Result.Cost.Samples = Result.Pairs + Result.Rays;
    return std::move(Result);
  }
  Result.Areas.assign(Patches, 0.0);
  for (ViewFactorShare* share :
    { &Result.Sum, &Result.Environment, &Result.Sky, &Result.Ground, &Result.Blocked })
  {
    share->Value.assign(Patches, 0.0);
    share->Error.assign(Patches, 0.0);
  }
  Result.ClosureDefect.assign(Patches, 0.0);
  Result.Closed.assign(Patches, 0);
  Result.Method = "none";
  Result.Outcome = "Tolerance met; no patch has an area";
  return std::move(Result);
}

} // namespace

ViewFactorResult ComputeViewFactors(const Scene& scene,
  const std::vector<std::int32_t>& patchOfCell, std::size_t patches,
  const ViewFactorOptions& options, Monitor* monitor)
{
  return Run(scene, patchOfCell, patches, options, monitor).Compute();
}

} // namespace radiometry
