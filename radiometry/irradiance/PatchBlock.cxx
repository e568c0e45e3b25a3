// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/PatchBlock.h"

#include "radiometry/geometry/Horizon.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

const double Pi = std::acos(-1.0);
constexpr double Epsilon = std::numeric_limits<double>::epsilon();

/// Clusters of so few patches are asked one by one.
constexpr std::size_t FewPatches = 3;
/// ... and those are not halved any more.
constexpr std::size_t UnsplitPatches = 8;
/// More silhouette segments than this in a cluster's shaft: halve it without listing them all.
constexpr std::size_t MostCandidates = 256;
/// Components of so many patches take two rays, which must agree.
constexpr std::size_t ManyPatches = 8;
/// The doubts of single lights may use up so much of the tolerance; they add in the square.
constexpr double DoubtShare = 0.25;

} // namespace

struct PatchBlock::Pending
{
  const SourceFlux& Source;
  const Silhouettes* Outline;
  const ShadowCutter* Cutter; // null: nothing hides anything, or there is no time to look
  const double* Basis;
  double Magnitude;
  std::size_t Count = 0; // of Facing
  std::int64_t Rays = 0;
};

PatchBlock::PatchBlock(const Scene& scene, const BeamLights& lights,
  const std::vector<Patch>& patches, const DirectOptions& options, double extent)
  : Geometry(scene)
  , Lights(lights)
  , Patches(patches)
  , Options(options)
  , Coordinates(extent)
  , Bands(lights.Size() > 0 && lights.Cutters[0] && lights.Cutters[0]->Transmits()
        ? static_cast<std::size_t>(scene.Optics.Bands)
        : 0)
{
  this->Factor.fill(1.0);
  this->Shares.resize(2 * this->Bands);
}

void PatchBlock::Load(const std::uint32_t* begin, const std::uint32_t* end)
{
  this->Count = static_cast<std::size_t>(end - begin);
  this->Ids = begin;
  this->Linked = false;
  for (const std::uint32_t* id = begin; id != end; ++id)
  {
    // Neighbours in space may lie far apart in memory: all are on their way while the first are read.
    const auto* first = reinterpret_cast<const char*>(&this->Patches[*id]);
    __builtin_prefetch(first);
    __builtin_prefetch(first + 64);
  }
  this->Around = {};
  double least = std::numeric_limits<double>::infinity();
  Vec3 sum;
  for (std::size_t i = 0; i < this->Count; ++i)
  {
    const Patch& patch = this->Patches[begin[i]];
    const Triangle3& c = patch.Corners;
    const Vec3 area2 = AreaNormal2(c);
    const double length = Length(area2);
    this->Areas[i] = 0.5 * length;
    this->Normals[i] = length > 0.0 ? area2 / length : Vec3{};
    double longest = 0.0;
    this->Rims[i] = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const double side = std::sqrt(LengthSquared(c[(k + 1) % 3] - c[k]));
      longest = std::max(longest, side);
      this->Rims[i] += side;
      this->Around.Box.Add(c[k]);
    }
    this->Heights[i] = longest > 0.0 ? length / longest : 0.0;
    // Of the closed forms, and of coordinates of that extent on a patch of that least height.
    this->Roundings[i] =
      length > 0.0 ? Epsilon * (16.0 + this->Coordinates / this->Heights[i]) : 0.0;
    this->Crossed[i] = this->Lights.Lines && this->Lights.Lines->Crossed(patch.Triangle) ? 1 : 0;
    if (length > 0.0)
    {
      least = std::min(least, this->Areas[i]);
      sum += this->Normals[i];
    }
  }
  this->Around.Greatest = 2.0 * Pi / least * (1.0 + 1e-9);
  const double length = Length(sum);
  this->Around.Normal = length > 0.0 ? sum / length : Vec3{ 0.0, 0.0, 1.0 };
  this->Around.CosSpread = length > 0.0 ? 1.0 : -1.0;
  for (std::size_t i = 0; i < this->Count && length > 0.0; ++i)
  {
    if (this->Areas[i] > 0.0)
    {
      this->Around.CosSpread =
        std::min(this->Around.CosSpread, Dot(this->Around.Normal, this->Normals[i]) - 1e-15);
    }
  }
  if (this->Lights.Lines)
  {
    this->FindPoints();
  }
}

/// True when it is known on which side of a patch's plane a light is.
bool PatchBlock::Knows(const SourceFlux& source, std::size_t i) const
{
  const Triangle3& corners = this->Patches[this->Ids[i]].Corners;
  const Light& light = source.GetLight();
  if (source.Directional())
  {
    return FindSide(corners, Dot(this->Normals[i], light.Direction), this->Coordinates) ==
      PlaneSide::Known;
  }
  // First what is true of nearly all lights, cheaply: FindSide's bound, taken larger.
  const Vec3 to = light.Position - corners[0];
  const double reach = std::sqrt(LengthSquared(to)) + this->Rims[i];
  return Dot(this->Normals[i], to) >
    8.0 * Epsilon * (reach + this->Coordinates * (1.0 + reach / this->Heights[i])) ||
    FindSide(corners, this->Normals[i], light.Position, this->Coordinates) == PlaneSide::Known;
}

std::int64_t PatchBlock::Ask(std::size_t light, const std::uint8_t* active, const double* basis,
  LightShare* shares)
{
  const SourceFlux& source = *this->Lights.Sources[light];
  Pending now{ source, this->Lights.Outlines[light].get(), this->Lights.Cutters[light].get(), basis,
    this->Lights.Tree.Strength(
      static_cast<std::int32_t>(this->Lights.Tree.Nodes() + static_cast<std::int32_t>(light))) };
  this->Tint.assign(this->Count * this->Bands, 1.0);
  for (std::size_t i = 0; i < this->Count; ++i)
  {
    if (active[i] == 0)
    {
      continue;
    }
    this->Quadrature[i] = 0.0;
    this->Open[i] = source.OnPolygon(this->Patches[this->Ids[i]].Corners.data(), 3,
      this->Normals[i], this->Quadrature[i]);
    if (this->Open[i] > 0.0 && !this->Knows(source, i))
    {
      // In the patch's plane within rounding: nothing, or that much.
      shares[i].Open = shares[i].Systematic = this->Open[i] / this->Areas[i];
      continue;
    }
    if (this->Open[i] > 0.0)
    {
      this->Lit[i] = 0.0;
      this->Doubt[i] = 0.0;
      this->Facing[now.Count++] = static_cast<std::uint8_t>(i);
    }
  }
  const bool shadows = this->Lights.Lines && !this->Blind;
  if (shadows)
  {
    this->Starts.clear();
    this->StartOf.clear();
    this->Decide(now, 0, now.Count, nullptr, 0);
    this->Trace(now);
  }
  for (std::size_t k = 0; k < now.Count; ++k)
  {
    const std::size_t i = this->Facing[k];
    const double guess = this->Lights.Hides ? 0.5 * this->Open[i] : 0.0;
    const double lit = shadows ? this->Lit[i] : this->Open[i] - guess;
    const double perArea = 1.0 / this->Areas[i];
    shares[i].Open = this->Open[i] * perArea;
    shares[i].Lit = lit / this->Areas[i];
    shares[i].Doubt = this->Doubt[i] * perArea;
    shares[i].Systematic = ((shadows ? 0.0 : guess) +
                             this->Quadrature[i] * (lit / this->Open[i]) +
                             this->Roundings[i] * lit) * perArea;
  }
  return now.Rays;
}

bool PatchBlock::MakeShaft(
  const Pending& now, std::size_t begin, std::size_t end, LightShaft& shaft)
{
  std::bitset<3 * Most> taken;
  Vec3 normal;
  this->Cluster.clear();
  for (std::size_t k = begin; k < end; ++k)
  {
    const std::size_t i = this->Facing[k];
    normal += this->Normals[i];
    for (const std::uint8_t c : this->Corner[i])
    {
      if (!taken[c])
      {
        taken[c] = true;
        this->Cluster.push_back(this->Points[c]);
      }
    }
  }
  return LightShaft::OfCluster(this->Cluster.data(), this->Cluster.size(), Normalized(normal),
    now.Source.GetLight(), this->Lights.Lines->Tolerance(), shaft);
}

/// Finds what of the light reaches Facing[begin, end). `candidates`: silhouette segments, all that
/// matter here among them; null: not known.
void PatchBlock::Decide(Pending& now, std::size_t begin, std::size_t end,
  const std::vector<Segment3>* candidates, std::size_t depth)
{
  const std::size_t count = end - begin;
  LightShaft shaft;
  if (count > FewPatches && this->MakeShaft(now, begin, end, shaft))
  {
    std::vector<Segment3>& found = this->Candidates[depth];
    found.clear();
    bool complete = true;
    if (candidates)
    {
      std::copy_if(candidates->begin(), candidates->end(), std::back_inserter(found),
        [&](const Segment3& s) { return shaft.Touches(s); });
    }
    else
    {
      complete = now.Outline->InShaft(shaft, MostCandidates, found);
    }
    if (complete && found.empty() && this->DecideTogether(now, begin, end))
    {
      return;
    }
    candidates = complete ? &found : nullptr;
  }
  if (count > UnsplitPatches)
  {
    this->Decide(now, begin, begin + count / 2, candidates, depth + 1);
    this->Decide(now, begin + count / 2, end, candidates, depth + 1);
    return;
  }
  for (std::size_t k = begin; k < end; ++k)
  {
    this->DecideOne(now, k, candidates);
  }
}

/// Nothing begins or ends in the shaft of Facing[begin, end): a ray or two tell for each connected
/// piece. False where that cannot be said after all.
bool PatchBlock::DecideTogether(Pending& now, std::size_t begin, std::size_t end)
{
  for (std::size_t k = begin; k < end; ++k)
  {
    if (this->Crossed[this->Facing[k]] != 0)
    {
      return false;
    }
  }
  const std::size_t pieces = this->FindPieces(begin, end);
  if (2 * pieces > end - begin)
  {
    return false;
  }
  for (std::size_t piece = 0; piece < pieces; ++piece)
  {
    // Asked at its largest patch and, of many, at the largest of the others, too.
    std::size_t probe[2] = { Most, Most };
    std::size_t size = 0;
    for (std::size_t k = begin; k < end; ++k)
    {
      const std::size_t i = this->Facing[k];
      if (this->Piece[i] != piece)
      {
        continue;
      }
      ++size;
      if (probe[0] == Most || this->Areas[i] > this->Areas[probe[0]])
      {
        probe[1] = probe[0];
        probe[0] = i;
      }
      else if (probe[1] == Most || this->Areas[i] > this->Areas[probe[1]])
      {
        probe[1] = i;
      }
    }
    bool hidden[2] = { false, false };
    const int rays = size >= ManyPatches ? 2 : 1;
    bool agree = true;
    for (int r = 0; r < rays; ++r)
    {
      const Patch& patch = this->Patches[this->Ids[probe[r]]];
      const RayEnd from{ Centroid(patch.Corners), patch.Triangle };
      if (this->Bands == 0)
      {
        hidden[r] = now.Cutter->Hidden(from);
        continue;
      }
      double* shares = &this->Shares[r == 0 ? 0 : this->Bands];
      now.Cutter->Passing(from, shares);
      for (std::size_t b = 0; b < this->Bands && r == 1; ++b)
      {
        agree = agree &&
          std::fabs(shares[b] - this->Shares[b]) <= 1e-12 * std::max(shares[b], this->Shares[b]);
      }
    }
    now.Rays += rays;
    if (rays == 2 && (hidden[0] != hidden[1] || !agree))
    {
      return false;
    }
    for (std::size_t k = begin; k < end; ++k)
    {
      const std::size_t i = this->Facing[k];
      if (this->Piece[i] == piece && this->Bands == 0)
      {
        this->Lit[i] = hidden[0] ? 0.0 : this->Open[i];
      }
      else if (this->Piece[i] == piece)
      {
        this->SetShares(i, this->Shares.data(), this->Open[i]);
      }
    }
  }
  return true;
}

void PatchBlock::DecideOne(
  Pending& now, std::size_t k, const std::vector<Segment3>* candidates)
{
  const std::size_t i = this->Facing[k];
  const Patch& patch = this->Patches[this->Ids[i]];
  const std::vector<Segment3>& crossings = this->Lights.Lines->Crossings(patch.Triangle);
  this->Lines.clear();
  bool complete = true;
  if (candidates)
  {
    now.Outline->Narrow(patch.Corners, *candidates, this->Lines);
  }
  else
  {
    complete = now.Outline->InShaft(patch.Corners, MostCandidates, this->Lines);
  }
  const std::size_t listed = this->Lines.size();
  now.Outline->Narrow(patch.Corners, crossings, this->Lines);
  if (complete && this->Lines.empty())
  {
    // Nothing begins or ends in the shaft: one ray tells for all of the patch.
    this->Starts.push_back({ Centroid(patch.Corners), patch.Triangle });
    this->StartOf.push_back(static_cast<std::uint8_t>(i));
    return;
  }
  this->Lines.resize(listed);
  const double basis =
    std::max(now.Basis[i] * this->Areas[i], 0.25 * this->Open[i]); // both as flux
  const double allowed = DoubtShare * this->Factor[i] *
    std::max(this->Options.RelativeTolerance * std::sqrt(basis * this->Open[i]),
      this->Options.AbsoluteTolerance * this->Areas[i] / now.Magnitude);
  const LitFlux flux = now.Cutter->Flux(patch, this->Normals[i], this->Open[i], crossings, allowed,
    this->Work, complete ? &this->Lines : nullptr);
  now.Rays += flux.Rays;
  this->Lit[i] = flux.Value;
  if (this->Bands > 0)
  {
    this->SetShares(i, flux.Bands.data(), 1.0);
  }
  this->Doubt[i] = flux.Error;
}

/// A patch gets `of` times a share in each band.
void PatchBlock::SetShares(std::size_t i, const double* shares, double of)
{
  const double greatest = *std::max_element(shares, shares + this->Bands);
  this->Lit[i] = of * greatest;
  for (std::size_t b = 0; b < this->Bands; ++b)
  {
    this->Tint[i * this->Bands + b] = greatest > 0.0 ? shares[b] / greatest : 1.0;
  }
}

/// One ray for each patch that is lit or dark as a whole.
void PatchBlock::Trace(Pending& now)
{
  if (this->Starts.empty())
  {
    return;
  }
  if (this->Bands == 0)
  {
    now.Cutter->Hidden(this->Starts, this->Hidden);
  }
  now.Rays += static_cast<std::int64_t>(this->Starts.size());
  for (std::size_t s = 0; s < this->Starts.size(); ++s)
  {
    const std::size_t i = this->StartOf[s];
    if (this->Bands > 0)
    {
      now.Cutter->Passing(this->Starts[s], this->Shares.data());
      this->SetShares(i, this->Shares.data(), this->Open[i]);
      continue;
    }
    this->Lit[i] = this->Hidden[s] != 0 ? 0.0 : this->Open[i];
  }
}

} // namespace radiometry
