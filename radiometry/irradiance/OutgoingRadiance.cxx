// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/OutgoingRadiance.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/irradiance/Highlights.h"
#include "radiometry/visibility/PointStarts.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr std::size_t Sets = 8;
constexpr std::uint32_t FewestSamples = 8; // of a set
constexpr std::uint32_t MostSamples = 2048;
constexpr std::size_t PilotStride = 32; // of the receivers that are computed first, to know the cost
/// Student's t of seven degrees of freedom, 95 % on both sides, is 2.365; a fifth more as samples end when
/// they happen to agree.
constexpr double Deviations = 2.85;

/// A piece of a receiver with the side that is seen of it.
struct Piece
{
  Triangle3 Corners; // all three the same: a point
  std::int32_t Triangle;
  std::int32_t Cell;
  Vec3 Normal; // toward the viewer
  bool Front;
  double Share; // of the receiver's area
};

/// What one receiver sends: the parts of it that are seen.
struct Receiver
{
  std::vector<Piece> Pieces;
  std::uint64_t Key;
  const float* Known = nullptr; // by light
};

/// Means of sets of samples that grow.
class SampleSets
{
public:
  explicit SampleSets(std::size_t bands)
    : Bands(bands)
    , Sums(Sets * bands, 0.0)
    , Doubts(Sets * bands, 0.0)
  {
  }
  double* Sum(std::size_t set) { return this->Sums.data() + set * this->Bands; }
  double* Doubt(std::size_t set) { return this->Doubts.data() + set * this->Bands; }
  /// `noise`: what more samples would lessen; `doubt`: what they would not.
  void Find(std::uint32_t each, std::size_t band, double& mean, double& noise, double& doubt) const
  {
    double sum = 0.0, squares = 0.0;
    doubt = 0.0;
    for (std::size_t s = 0; s < Sets; ++s)
    {
      const double v = this->Sums[s * this->Bands + band] / each;
      sum += v;
      doubt += this->Doubts[s * this->Bands + band] / each / Sets;
    }
    mean = sum / Sets;
    for (std::size_t s = 0; s < Sets; ++s)
    {
      const double d = this->Sums[s * this->Bands + band] / each - mean;
      squares += d * d;
    }
    noise = Deviations * std::sqrt(squares / (Sets * (Sets - 1.0)));
  }

private:
  std::size_t Bands;
  std::vector<double> Sums;
  std::vector<double> Doubts;
};

/// Adds what receivers send by lobes and panes.
class Sampler
{
public:
  Sampler(const RadianceTracer& tracer, const Viewer& viewer, const RadianceOptions& options,
    std::size_t bands, std::size_t lights)
    : Tracer(tracer)
    , Eye(viewer)
    , Options(options)
    , Bands(bands)
    , Lights(lights)
  {
  }

  /// Adds to values and errors (bands); `most` samples a set. Returns the rays.
  std::int64_t Add(
    const Receiver& receiver, std::uint32_t most, double* values, double* errors) const
  {
    SampleSets sets(this->Bands);
    std::vector<double> known(receiver.Known ? this->Lights : 0);
    std::copy_n(receiver.Known, known.size(), known.begin());
    std::int64_t rays = this->AddLights(receiver, known, values, errors);
    if (!(this->Tracer.GreatestRadiance() > 0.0) && this->Tracer.AllBeams().empty())
    {
      return rays; // nothing else to be seen
    }
    std::uint32_t done = 0;
    std::vector<double> mean(this->Bands), noise(this->Bands), doubt(this->Bands);
    for (std::uint32_t each = FewestSamples; each <= most; each *= 2)
    {
      for (std::size_t s = 0; s < Sets; ++s)
      {
        const SobolSequence places(Hash64(receiver.Key, 3 * s));
        const SobolSequence lobes(Hash64(receiver.Key, 3 * s + 1));
        const SobolSequence panels(Hash64(receiver.Key, 3 * s + 2));
        for (std::uint32_t k = done; k < each; ++k)
        {
          const auto at = places(k);
          RadianceNumbers numbers{ lobes(k), panels(k), Hash64(Hash64(receiver.Key, s), k) };
          rays += this->AddOne(receiver, at, numbers, sets.Sum(s), sets.Doubt(s));
        }
      }
      done = each;
      bool fine = true;
      for (std::size_t b = 0; b < this->Bands; ++b)
      {
        sets.Find(done, b, mean[b], noise[b], doubt[b]);
        // Nor is it worth while to sample finer than the light that is seen is known.
        fine = fine &&
          noise[b] <= std::max({ this->Options.AbsoluteTolerance,
                        this->Options.RelativeTolerance * (values[b] + mean[b]),
                        0.5 * (errors[b] + doubt[b]) });
      }
      if (fine)
      {
        break;
      }
    }
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      values[b] += mean[b];
      // Where nothing was met, what so few samples may have missed (rule of three).
      const double missed = mean[b] > 0.0
        ? 0.0
        : 3.0 / static_cast<double>(Sets * done) * this->Tracer.GreatestRadiance() *
          this->GreatestShare(receiver, b);
      errors[b] += noise[b] + doubt[b] + missed;
    }
    return rays;
  }

private:
  /// Highlights.
  std::int64_t AddLights(const Receiver& receiver, const std::vector<double>& known, double* values,
    double* errors) const
  {
    HighlightEffort effort;
    effort.Relative = 0.5 * this->Options.RelativeTolerance;
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      effort.Allowed.push_back(0.5 *
        std::max(this->Options.AbsoluteTolerance, this->Options.RelativeTolerance * values[b]) /
        static_cast<double>(std::max<std::size_t>(1, this->Tracer.AllBeams().size())));
    }
    std::int64_t rays = 0;
    for (const Piece& piece : receiver.Pieces)
    {
      RadianceTracer::Place place;
      place.End = { piece.Corners[0], piece.Triangle };
      place.Normal = piece.Normal;
      place.Cell = piece.Cell;
      place.Front = piece.Front;
      place.Known = piece.Front && !known.empty() ? known.data() : nullptr; // known of fronts
      rays += AddHighlights(this->Tracer, this->Eye, piece.Corners, place, piece.Share, effort,
        values, errors);
    }
    return rays;
  }
  double GreatestShare(const Receiver& receiver, std::size_t band) const
  {
    double most = 0.0;
    for (const Piece& p : receiver.Pieces)
    {
      most = std::max(most, this->Tracer.Reflectance(p.Cell, p.Front, band) +
          this->Tracer.Transmittance(p.Cell, band));
    }
    return most;
  }
  std::int64_t AddOne(const Receiver& receiver, const std::array<double, 4>& at,
    const RadianceNumbers& numbers, double* sum, double* doubt) const
  {
    // The piece by its share; what is left of the number is used again.
    double u = at[0];
    for (const Piece& piece : receiver.Pieces)
    {
      if (u >= piece.Share)
      {
        u -= piece.Share;
        continue;
      }
      RadianceTracer::Place place;
      place.End = { TrianglePoint(piece.Corners, u / piece.Share, at[1]), piece.Triangle };
      place.Normal = piece.Normal;
      place.Cell = piece.Cell;
      place.Front = piece.Front;
      place.Toward = this->Eye.Toward(place.End.Point);
      return Dot(place.Toward, place.Normal) > 0.0
        ? this->Tracer.AddSample(place, numbers, sum, doubt)
        : 0;
    }
    return 0;
  }

  const RadianceTracer& Tracer;
  const Viewer& Eye;
  const RadianceOptions& Options;
  std::size_t Bands;
  std::size_t Lights;
};

/// Samples all receivers that call for it, in a first round a few of each, where time is short.
void SampleAll(const std::vector<Receiver>& receivers, const RadianceTracer& tracer,
  const Viewer& viewer, std::size_t bands, std::size_t lights, const RadianceOptions& options,
  const StageProgress& stage, ConvergenceRecord* record, RadianceResult& result)
{
  const ConvergenceRecord clock;
  std::vector<std::size_t> calling;
  for (std::size_t i = 0; i < receivers.size(); ++i)
  {
    if (std::any_of(receivers[i].Pieces.begin(), receivers[i].Pieces.end(),
          [&](const Piece& p) { return tracer.Calls(p.Cell, p.Front); }))
    {
      calling.push_back(i);
    }
  }
  result.Sampled = calling.size();
  const std::vector<double> values = result.Values;
  const std::vector<double> errors = result.Errors;
  const Sampler sampler(tracer, viewer, options, bands, lights);
  std::atomic<std::int64_t> rays{ 0 };
  std::atomic<bool> expired{ false };
  const auto run = [&](const std::vector<std::size_t>& some, std::uint32_t most, double begin,
                     double end, bool first) {
    StageProgress part = stage;
    part.Begin = stage.Begin + (stage.End - stage.Begin) * begin;
    part.End = stage.Begin + (stage.End - stage.Begin) * end;
    ParallelFor(
      some.size(), options.Threads, part,
      [&](std::size_t k) {
        if (!first && options.SecondsLeft > 0.0 && clock.Elapsed() > options.SecondsLeft)
        {
          expired = true;
          return;
        }
        const std::size_t row = some[k] * bands;
        std::vector<double> value(values.begin() + static_cast<std::ptrdiff_t>(row),
          values.begin() + static_cast<std::ptrdiff_t>(row + bands));
        std::vector<double> error(errors.begin() + static_cast<std::ptrdiff_t>(row),
          errors.begin() + static_cast<std::ptrdiff_t>(row + bands));
        rays += sampler.Add(receivers[some[k]], most, value.data(), error.data());
        std::copy(value.begin(), value.end(), result.Values.begin() + static_cast<std::ptrdiff_t>(row));
        std::copy(error.begin(), error.end(), result.Errors.begin() + static_cast<std::ptrdiff_t>(row));
      },
      2e-6 * 8 * most);
    result.Rays = rays;
  };
  const auto note = [&] {
    if (record)
    {
      double sum = 0.0, doubt = 0.0;
      for (std::size_t k = 0; k < result.Values.size(); ++k)
      {
        sum += result.Values[k];
        doubt += result.Errors[k];
      }
      const auto count = static_cast<double>(std::max<std::size_t>(1, result.Values.size()));
      record->Add("radiance", sum > 0.0 ? doubt / sum : 0.0, doubt / count, rays);
    }
  };
  double begin = 0.0;
  if (options.SecondsLeft > 0.0 && !calling.empty())
  {
    run(calling, FewestSamples, 0.0, begin = 0.2, true);
    note();
  }
  std::vector<std::size_t> pilot, rest;
  for (std::size_t k = 0; k < calling.size(); ++k)
  {
    (k % PilotStride == 0 ? pilot : rest).push_back(calling[k]);
  }
  const bool limited = options.SecondsLeft > 0.0;
  const double before = clock.Elapsed();
  const double middle = begin + (1.0 - begin) / PilotStride;
  run(pilot, MostSamples, begin, middle, !limited);
  const double now = clock.Elapsed();
  const double share =
    pilot.empty() ? 0.0 : static_cast<double>(rest.size()) / static_cast<double>(pilot.size());
  const double whole = now + (now - before) * share;
  result.Cost.PredictedAt = options.SecondsBefore + now;
  result.Cost.PredictedSeconds =
    options.SecondsBefore + (limited ? std::min(whole, std::max(now, options.SecondsLeft)) : whole);
  if (stage.Listener)
  {
    stage.Listener->Predicted(result.Cost.PredictedSeconds);
  }
  if (!options.PilotOnly)
  {
    run(rest, MostSamples, middle, 1.0, !limited);
    note();
  }
  result.Cost.Seconds = options.SecondsBefore + clock.Elapsed();
  result.Cost.Samples = rays;
  result.TimedOut = expired;
}

/// A bound of what effects that are off may change of one receiver.
double LeftOutOf(const Receiver& receiver, const RadianceTracer& full, const RadianceTracer& run,
  const Scene& scene, const RadianceEffects& effects)
{
  const bool lobes = !effects.Specular || !effects.Occlusion || !effects.Environment ||
    !effects.SpotShape || !effects.Attenuation;
  double bound = 0.0;
  for (const Piece& p : receiver.Pieces)
  {
    if (!effects.BackFaces && !p.Front && full.Sends(p.Cell, false))
    {
      bound = std::max(bound, full.GreatestRadiance());
    }
    if (!full.Calls(p.Cell, p.Front))
    {
      continue;
    }
    const Vec3 center = Centroid(p.Corners);
    double radius = 0.0;
    for (const Vec3& corner : p.Corners)
    {
      radius = std::max(radius, Length(corner - center));
    }
    const auto row = static_cast<std::size_t>(p.Cell) * static_cast<std::size_t>(scene.Optics.Bands);
    double specular = 0.0, transmitted = 0.0;
    for (int b = 0; b < scene.Optics.Bands; ++b)
    {
      const std::size_t at = row + static_cast<std::size_t>(b);
      for (const std::vector<double>& side : scene.Optics.SpecularReflectance)
      {
        specular = std::max(specular, side.empty() ? 0.0 : side[at]);
      }
      transmitted = std::max(
        transmitted, scene.Optics.Transmittance.empty() ? 0.0 : scene.Optics.Transmittance[at]);
    }
    double exponent = 0.0;
    for (const std::vector<double>& side : scene.Optics.Shininess)
    {
      exponent =
        std::max(exponent, side.empty() ? DefaultShininess : side[static_cast<std::size_t>(p.Cell)]);
    }
    // Highlights by f E; the rest by the greatest radiance there is, which lobes and panes cannot raise.
    const double lights = std::max(full.GreatestBeams(center, radius), run.GreatestBeams(center, radius));
    double most = lobes ? specular * full.GreatestRadiance() : 0.0;
    if (lobes && specular > 0.0 && exponent < MirrorShininess && lights > 0.0)
    {
      most += specular * (exponent + 2.0) / (2.0 * Pi) * lights;
    }
    if (!effects.Transmission || !effects.Environment)
    {
      most += transmitted * full.GreatestRadiance();
    }
    bound = std::max(bound, most);
  }
  return bound;
}

RadianceResult Compute(const std::vector<Receiver>& receivers, const Scene& scene,
  const OcclusionScene& occluders, const DiffuseLight& diffuse, const Viewer& viewer,
  const RadianceOptions& options, const StageProgress& stage, ConvergenceRecord* record,
  RadianceResult result)
{
  const RadianceTracer tracer(scene, occluders, diffuse, options.Effects);
  SampleAll(receivers, tracer, viewer, static_cast<std::size_t>(scene.Optics.Bands),
    scene.Lights.size(), options, stage, record, result);
  const RadianceEffects& e = options.Effects;
  if (!(e.Occlusion && e.Specular && e.Transmission && e.Environment && e.SpotShape &&
        e.Attenuation && e.BackFaces))
  {
    const RadianceTracer full(scene, occluders, diffuse, RadianceEffects{});
    for (const Receiver& receiver : receivers)
    {
      result.LeftOut = std::max(result.LeftOut, LeftOutOf(receiver, full, tracer, scene, e));
    }
  }
  return result;
}

} // namespace

RadianceResult ComputeOutgoingRadiance(const Scene& scene, const OcclusionScene& occluders,
  const DiffuseLight& diffuse, const Viewer& viewer, const std::vector<std::int32_t>& cells,
  const RadianceOptions& options, const StageProgress& stage, ConvergenceRecord* record)
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  std::vector<std::int32_t> wanted(scene.Cells, -1);
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    wanted[static_cast<std::size_t>(cells[i])] = static_cast<std::int32_t>(i);
  }
  std::vector<Receiver> receivers(cells.size());
  std::vector<double> areas(cells.size(), 0.0);
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    const std::int32_t cell = scene.TriangleCell[t];
    const std::int32_t i = wanted[static_cast<std::size_t>(cell)];
    if (i < 0)
    {
      continue;
    }
    const Triangle3 corners = scene.TriangleAt(t);
    const Vec3 normal2 = AreaNormal2(corners);
    const Vec3 normal = Normalized(normal2);
    const double area = 0.5 * Length(normal2);
    areas[static_cast<std::size_t>(i)] += area;
    const int side = SeenSide(corners, normal, viewer);
    if (side != 0)
    {
      receivers[static_cast<std::size_t>(i)].Pieces.push_back({ corners,
        static_cast<std::int32_t>(t), cell, side > 0 ? normal : -normal, side > 0, area });
    }
  }
  RadianceResult result;
  result.Values.assign(cells.size() * bands, 0.0);
  result.Errors.assign(cells.size() * bands, 0.0);
  const RadianceTracer sides(scene, occluders, diffuse, options.Effects);
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    Receiver& receiver = receivers[i];
    receiver.Key = static_cast<std::uint64_t>(cells[i]);
    receiver.Known = options.Known.empty() ? nullptr : &options.Known[receiver.Key * scene.Lights.size()];
    for (Piece& piece : receiver.Pieces)
    {
      piece.Share = areas[i] > 0.0 ? piece.Share / areas[i] : 0.0;
      const std::size_t side = piece.Front ? 0 : 1;
      if (!sides.Sends(piece.Cell, piece.Front))
      {
        continue;
      }
      const std::size_t row = static_cast<std::size_t>(piece.Cell) * bands;
      for (std::size_t b = 0; b < bands; ++b)
      {
        result.Values[i * bands + b] += piece.Share * diffuse.Exitance[side][row + b] / Pi;
        result.Errors[i * bands + b] += diffuse.Error[side].empty()
          ? 0.0
          : piece.Share * diffuse.Error[side][row + b] / Pi;
      }
    }
  }
  return Compute(
    receivers, scene, occluders, diffuse, viewer, options, stage, record, std::move(result));
}

RadianceResult ComputeOutgoingRadiance(const Scene& scene, const OcclusionScene& occluders,
  const DiffuseLight& diffuse, const Viewer& viewer, const std::vector<SurfacePoint>& points,
  const DiffuseLight& here, const RadianceOptions& options, const StageProgress& stage,
  ConvergenceRecord* record)
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  std::vector<Receiver> receivers(points.size());
  RadianceResult result;
  result.Values.assign(points.size() * bands, 0.0);
  result.Errors.assign(points.size() * bands, 0.0);
  const RadianceTracer sides(scene, occluders, diffuse, options.Effects);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const SurfacePoint& p = points[i];
    Receiver& receiver = receivers[i];
    receiver.Key = i;
    receiver.Known = options.Known.empty() ? nullptr : &options.Known[i * scene.Lights.size()];
    if (p.Triangle < 0)
    {
      continue;
    }
    const double cosine = Dot(p.Normal, viewer.Toward(p.Point));
    if (cosine == 0.0)
    {
      continue;
    }
    const bool front = cosine > 0.0;
    const std::vector<PointStart> starts = PointStarts(scene, occluders, p);
    for (const PointStart& start : starts)
    {
      const std::int32_t cell = scene.TriangleCell[static_cast<std::size_t>(start.End.Triangle)];
      const Vec3& at = start.End.Point;
      receiver.Pieces.push_back({ { at, at, at }, start.End.Triangle, cell,
        front ? p.Normal : -p.Normal, front, 1.0 / static_cast<double>(starts.size()) });
    }
    const std::size_t side = front ? 0 : 1;
    const std::int32_t cell = scene.TriangleCell[static_cast<std::size_t>(p.Triangle)];
    for (std::size_t b = 0; b < bands && sides.Sends(cell, front) && !here.Exitance[side].empty();
         ++b)
    {
      result.Values[i * bands + b] = here.Exitance[side][i * bands + b] / Pi;
      result.Errors[i * bands + b] =
        here.Error[side].empty() ? 0.0 : here.Error[side][i * bands + b] / Pi;
    }
  }
  return Compute(
    receivers, scene, occluders, diffuse, viewer, options, stage, record, std::move(result));
}

void SpreadToCells(
  const Scene& scene, const std::vector<std::int32_t>& cells, RadianceResult& result)
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  for (std::vector<double>* numbers : { &result.Values, &result.Errors })
  {
    std::vector<double> all(scene.Cells * bands, 0.0);
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      std::copy_n(numbers->begin() + static_cast<std::ptrdiff_t>(i * bands), bands,
        all.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(cells[i]) * bands));
    }
    *numbers = std::move(all);
  }
}

} // namespace radiometry
