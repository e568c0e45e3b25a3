// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/CellCutter.h"

#include "radiometry/effects/CompiledEffects.h"
#include "radiometry/geometry/DividePolygon.h"
#include "radiometry/irradiance/PieceMerging.h"
#include "radiometry/irradiance/PolygonShaft.h"
#include "radiometry/irradiance/Silhouettes.h"
#include "radiometry/irradiance/SourceFlux.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace radiometry
{
namespace
{

using Polygon = std::vector<Vec3>;

/// A light that cuts, with what it casts shadows from.
struct CuttingLight
{
  std::unique_ptr<SourceFlux> Source;
  std::unique_ptr<Silhouettes> Outline;
  bool Close = false;
};

/// A light as one side of a triangle sees it.
struct Beam
{
  const CuttingLight* Light = nullptr;
  bool Back = false;
};

/// A plane along which a triangle may have to be cut.
struct CutLine
{
  std::size_t Beam = 0;
  Segment3 Segment;
  double Weight = 0.0; // length of the part of the segment whose shadow may fall on the piece
};

struct OpenPiece
{
  Polygon Corners;
  std::vector<CutLine> Lines;
  double Area = 0.0;

  bool operator<(const OpenPiece& other) const { return this->Area < other.Area; }
};

/// How far apart two shares of light may be and still count as one.
constexpr double SameShare = 1e-12;
/// Lines listed for a cell, for each piece that it may have.
constexpr std::size_t LinesPerPiece = 16;

} // namespace

class CellCutter::Internals
{
public:
  Internals(const Scene& scene, const OcclusionScene& occluders, const DirectOptions& options,
    bool backFaces, std::size_t most, const StageProgress& stage)
    : Geometry(scene)
    , Occluders(occluders)
    , Lines(occluders.Lines(scene, options.Threads, stage))
    , Bands(Compiled(Effect::Transmission) && options.Transmission && occluders.HasPanes()
          ? static_cast<std::size_t>(scene.Optics.Bands)
          : 0)
    , BackFaces(backFaces)
    , Most(most)
  {
    for (const Light& light : scene.Lights)
    {
      const auto positive = [](double i) { return i > 0.0; };
      if (light.Enabled && light.Type != LightType::Area && light.Type != LightType::Environment &&
        std::any_of(light.Intensity.begin(), light.Intensity.end(), positive))
      {
        CuttingLight cutting;
        cutting.Source =
          std::make_unique<SourceFlux>(light, options.SpotShape, options.Attenuation);
        cutting.Outline = std::make_unique<Silhouettes>(scene, this->Lines, cutting.Source->GetLight());
        cutting.Close = light.Type != LightType::Directional && occluders.TooClose(light.Position);
        this->Lights.push_back(std::move(cutting));
      }
    }
  }

  CellPieces Cut(const std::vector<std::int32_t>& triangles) const
  {
    CellPieces result;
    std::vector<std::vector<PlanePiece>> pieces;
    std::vector<std::vector<double>> states;
    std::size_t count = 0;
    bool lines = false;
    for (const std::int32_t t : triangles)
    {
      const std::size_t most = std::max<std::size_t>(1, this->Most / triangles.size());
      TriangleCut cut = this->CutTriangle(t, triangles.size() > 1, most, result.Full);
      lines = lines || cut.Pieces.size() > 1;
      pieces.emplace_back();
      for (std::size_t k = 0; k < cut.Pieces.size(); ++k)
      {
        pieces.back().push_back({ std::move(cut.Pieces[k]), StateOf(cut.States[k], states) });
        ++count;
      }
    }
    if (count == 0 || (states.size() == 1 && !result.Full) || (!lines && states.size() <= 1))
    {
      return result; // nothing begins or ends here
    }
    this->Join(triangles, pieces, result);
    return result;
  }

private:
  struct TriangleCut
  {
    std::vector<Polygon> Pieces;
    std::vector<std::vector<double>> States; // by light, side and band; empty: mixed
  };

  /// Cuts one triangle; `ask`: the state is wanted even where no line crosses it.
  TriangleCut CutTriangle(std::int32_t t, bool ask, std::size_t most, bool& full) const
  {
    const Triangle3 corners = this->Geometry.TriangleAt(static_cast<std::size_t>(t));
    const Vec3 normal = Normalized(AreaNormal2(corners));
    OpenPiece whole{ Polygon(corners.begin(), corners.end()), {}, Area(corners) };
    bool overfull = false;
    const std::vector<Beam> beams = this->FindLines(t, corners, normal, whole.Lines, overfull);
    TriangleCut cut;
    if (overfull)
    {
      full = true;
      cut.States.emplace_back();
      cut.Pieces.push_back(std::move(whole.Corners));
      return cut;
    }
    if (whole.Lines.empty() && !ask)
    {
      return cut;
    }
    double size = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      size = std::max(size, Length(corners[(k + 1) % 3] - corners[k]));
    }
    std::priority_queue<OpenPiece> open;
    open.push(std::move(whole));
    while (!open.empty())
    {
      OpenPiece piece = open.top();
      open.pop();
      if (piece.Lines.empty())
      {
        cut.States.push_back(this->Ask(piece.Corners, normal, t, beams));
        cut.Pieces.push_back(std::move(piece.Corners));
        continue;
      }
      if (cut.Pieces.size() + open.size() + 2 > most)
      {
        full = true;
        cut.States.emplace_back();
        cut.Pieces.push_back(std::move(piece.Corners));
        continue;
      }
      this->Divide(piece, normal, beams, 1e-13 * size, open);
    }
    return cut;
  }

  std::vector<Beam> FindLines(std::int32_t t, const Triangle3& corners, const Vec3& normal,
    std::vector<CutLine>& lines, bool& overfull) const
  {
    std::vector<Beam> beams;
    const std::int32_t cell = this->Geometry.TriangleCell[t];
    const int sides = this->BackFaces && this->Geometry.Optics.TwoSided[cell] ? 2 : 1;
    for (int side = 0; side < sides; ++side)
    {
      Triangle3 facing = corners;
      if (side == 1)
      {
        std::swap(facing[1], facing[2]);
      }
      for (const CuttingLight& light : this->Lights)
      {
        double error = 0.0;
        if (!(light.Source->OnPolygon(facing.data(), 3, side == 1 ? -normal : normal, error) > 0.0))
        {
          continue;
        }
        beams.push_back({ &light, side == 1 });
        std::vector<Segment3> found;
        overfull =
          overfull || !light.Outline->InShaft(facing, LinesPerPiece * this->Most, found);
        light.Outline->Narrow(facing, this->Lines.Crossings(t), found);
        for (const Segment3& segment : found)
        {
          lines.push_back({ beams.size() - 1, segment, Length(segment.B - segment.A) });
        }
      }
    }
    return beams;
  }

  /// Cuts a piece along its weightiest line.
  void Divide(OpenPiece& piece, const Vec3& normal, const std::vector<Beam>& beams,
    double tolerance, std::priority_queue<OpenPiece>& open) const
  {
    const auto heaviest = std::max_element(piece.Lines.begin(), piece.Lines.end(),
      [](const CutLine& a, const CutLine& b) { return a.Weight < b.Weight; });
    const CutLine line = *heaviest;
    piece.Lines.erase(heaviest);
    const Light& light = beams[line.Beam].Light->Source->GetLight();
    const Vec3 toLight = light.Type == LightType::Directional
      ? light.Direction
      : light.Position - line.Segment.A;
    const Vec3 across = Normalized(Cross(toLight, line.Segment.B - line.Segment.A));
    OpenPiece halves[2];
    if (!(across == Vec3{})) // not seen end on
    {
      DivideConvex(piece.Corners, across, line.Segment.A, tolerance, halves[0].Corners,
        halves[1].Corners);
    }
    if (halves[0].Corners.empty() || halves[1].Corners.empty())
    {
      open.push(std::move(piece));
      return;
    }
    for (OpenPiece& half : halves)
    {
      half.Area = 0.5 * Length(AreaNormal2(half.Corners));
      this->Narrow(piece.Lines, normal, beams, half);
      open.push(std::move(half));
    }
  }

  /// Keeps the lines whose shadows may fall on a piece.
  void Narrow(const std::vector<CutLine>& lines, const Vec3& normal,
    const std::vector<Beam>& beams, OpenPiece& piece) const
  {
    std::vector<std::unique_ptr<PolygonShaft>> shafts(beams.size());
    for (CutLine line : lines)
    {
      const Beam& beam = beams[line.Beam];
      if (!shafts[line.Beam])
      {
        Polygon facing = piece.Corners;
        if (beam.Back)
        {
          std::reverse(facing.begin(), facing.end());
        }
        shafts[line.Beam] = std::make_unique<PolygonShaft>(facing, beam.Back ? -normal : normal,
          beam.Light->Source->GetLight(), this->Lines.Tolerance());
      }
      line.Weight = shafts[line.Beam]->Inside(line.Segment);
      if (line.Weight > 0.0)
      {
        piece.Lines.push_back(line);
      }
    }
  }

  /// What of each light reaches a piece in which no shadow begins or ends.
  std::vector<double> Ask(const Polygon& polygon, const Vec3& normal, std::int32_t t,
    const std::vector<Beam>& beams) const
  {
    const std::size_t perBeam = std::max<std::size_t>(1, this->Bands);
    std::vector<double> state(2 * this->Lights.size() * perBeam, 0.0);
    const RayEnd from{ MiddleOfConvex(polygon), t };
    for (const Beam& beam : beams)
    {
      const SourceFlux& source = *beam.Light->Source;
      Polygon facing = polygon;
      if (beam.Back)
      {
        std::reverse(facing.begin(), facing.end());
      }
      double error = 0.0;
      if (!(source.OnPolygon(facing.data(), facing.size(), beam.Back ? -normal : normal, error) > 0.0))
      {
        continue; // outside the cone
      }
      const std::size_t light = 2 * static_cast<std::size_t>(beam.Light - this->Lights.data());
      double* share = &state[(light + (beam.Back ? 1 : 0)) * perBeam];
      const RayEnd to{ source.GetLight().Position, -1, beam.Light->Close };
      const Vec3 toward = -source.GetLight().Direction;
      if (this->Bands == 0)
      {
        *share = (source.Directional() ? this->Occluders.OccludedDirection(from, toward)
                                       : this->Occluders.Occluded(from, to))
          ? 0.0
          : 1.0;
      }
      else if (!(source.Directional() ? this->Occluders.VisibleDirection(from, toward, share)
                                      : this->Occluders.Visible(from, to, share)))
      {
        std::fill(share, share + perBeam, 0.0);
      }
    }
    return state;
  }

  /// The number of a state among those met; a mixed one gets a number of its own.
  static std::int64_t StateOf(
    const std::vector<double>& state, std::vector<std::vector<double>>& states)
  {
    for (std::size_t k = 0; k < states.size() && !state.empty(); ++k)
    {
      if (states[k].size() == state.size() &&
        std::equal(state.begin(), state.end(), states[k].begin(),
          [](double a, double b) { return std::fabs(a - b) <= SameShare * std::max(a, b); }))
      {
        return static_cast<std::int64_t>(k);
      }
    }
    states.push_back(state);
    return static_cast<std::int64_t>(states.size()) - 1;
  }

  void Join(const std::vector<std::int32_t>& triangles,
    const std::vector<std::vector<PlanePiece>>& pieces, CellPieces& result) const
  {
    const Vec3 normal =
      Normalized(AreaNormal2(this->Geometry.TriangleAt(static_cast<std::size_t>(triangles[0]))));
    const Vec3 on = this->Geometry.TriangleAt(static_cast<std::size_t>(triangles[0]))[0];
    double size = 0.0;
    double off = 0.0;
    bool sameWay = true;
    std::vector<Vec3> kept;
    for (const std::int32_t t : triangles)
    {
      const Triangle3 corners = this->Geometry.TriangleAt(static_cast<std::size_t>(t));
      sameWay = sameWay && Dot(AreaNormal2(corners), normal) > 0.0;
      for (const Vec3& p : corners)
      {
        size = std::max(size, Length(p - on));
        off = std::max(off, std::fabs(Dot(normal, p - on)));
        kept.push_back(p);
      }
    }
    const double rounding = this->Lines.Tolerance() +
      8.0 * std::numeric_limits<double>::epsilon() * Length(this->Geometry.Origin);
    const double tolerance = 1e-12 * size;
    const auto add = [&](const PieceSet& set) {
      const auto first = static_cast<std::int32_t>(result.Points.size());
      result.Points.insert(result.Points.end(), set.Points.begin(), set.Points.end());
      for (std::vector<std::int32_t> loop : set.Loops)
      {
        for (std::int32_t& p : loop)
        {
          p += first;
        }
        result.Loops.push_back(std::move(loop));
      }
    };
    if (sameWay && off <= 4.0 * rounding)
    {
      std::vector<PlanePiece> all;
      for (const auto& some : pieces)
      {
        all.insert(all.end(), some.begin(), some.end());
      }
      add(JoinPieces(all, normal, tolerance, kept));
      return;
    }
    for (std::size_t k = 0; k < triangles.size(); ++k)
    {
      const Triangle3 corners = this->Geometry.TriangleAt(static_cast<std::size_t>(triangles[k]));
      add(JoinPieces(pieces[k], Normalized(AreaNormal2(corners)), tolerance,
        std::vector<Vec3>(corners.begin(), corners.end())));
    }
  }

  const Scene& Geometry;
  const OcclusionScene& Occluders;
  const ShadowLines& Lines;
  const std::size_t Bands; // 0: nothing lets light through
  const bool BackFaces;
  const std::size_t Most;
  std::vector<CuttingLight> Lights;
};

CellCutter::CellCutter(const Scene& scene, const OcclusionScene& occluders,
  const DirectOptions& options, bool backFaces, std::size_t most, const StageProgress& stage)
  : Impl(std::make_unique<Internals>(scene, occluders, options, backFaces, most, stage))
{
}

CellCutter::~CellCutter() = default;

CellPieces CellCutter::Cut(const std::vector<std::int32_t>& triangles) const
{
  return this->Impl->Cut(triangles);
}

} // namespace radiometry
