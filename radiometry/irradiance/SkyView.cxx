// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/SkyTable.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/Units.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

/// Where `at` falls among weights: returns the index, and leaves in `at` the share of the way
/// through it.
template <typename Weight>
int Choose(int count, const Weight& weight, double total, double& at)
{
  double target = at * total;
  int last = 0;
  for (int k = 0; k < count; ++k)
  {
    const double w = weight(k);
    if (w > 0.0)
    {
      last = k;
      if (target < w)
      {
        at = target / w;
        return k;
      }
      target -= w;
    }
  }
  at = 1.0 - 0x1p-53;
  return last;
}

} // namespace

void SkyView::Look(const SkyTable& table, const Vec3& normal)
{
  this->Table = &table;
  this->Normal = table.Axes.ToSky(normal);
  this->Even = table.Sky().Model() == SkyModel::Uniform;
  this->Spans.clear();
  this->Cumulative.clear();
  if (this->Even)
  {
    this->Cumulative.assign(1, units::Pi * table.TotalIntensity());
    return;
  }
  this->Edges.clear();
  this->First.clear();
  this->Inner.clear();
  double sum = 0.0;
  double unused = 0.0;
  for (int r = 0; r < table.Rows; ++r)
  {
    const SkyTable::Span span = table.Visible(this->Normal, r);
    this->Spans.push_back(span);
    this->First.push_back(this->Edges.size());
    const int inner = span.Count - span.Left - span.Right;
    this->Inner.push_back(inner > 0
        ? std::max(0.0,
            Dot(this->Normal, table.SumOf(table.Layers[0], r, span.Begin + span.Left, inner)))
        : 0.0);
    sum += this->Inner.back();
    for (int k = 0; k < span.Left + span.Right; ++k)
    {
      const int column = k < span.Left ? k : k + std::max(inner, 0);
      this->Edges.push_back(table.Clipped(this->Normal, 0, r, span.Begin + column, unused));
      sum += this->Edges.back();
    }
    this->Cumulative.push_back(sum);
  }
}

SkyView::Sample SkyView::Draw(double u, double v) const
{
  Sample sample;
  const SkyTable& t = *this->Table;
  const Vec3& n = this->Normal;
  if (this->Even)
  {
    sample.Direction = t.Axes.ToWorld(CosineDirection(n, u, v));
    sample.Weight = 1.0;
    return sample;
  }
  const auto found = std::upper_bound(
    this->Cumulative.begin(), this->Cumulative.end(), u * this->Cumulative.back());
  if (found == this->Cumulative.end())
  {
    return sample;
  }
  const int row = static_cast<int>(found - this->Cumulative.begin());
  const double before = row > 0 ? this->Cumulative[row - 1] : 0.0;
  double down = std::clamp(
    (u * this->Cumulative.back() - before) / (*found - before), 0.0, 1.0 - 0x1p-53);

  // The column: crossed pixels one by one, the others by bisection of their prefix sums.
  const SkyTable::Span& span = this->Spans[row];
  const SkyTable::Layer& layer = t.Layers[0];
  const int inner = span.Count - span.Left - span.Right;
  const double middle = this->Inner[row];
  const double* edges = this->Edges.data() + this->First[row];
  double across = v;
  double gets = 0.0; // irradiance from the pixel
  int column = 0;
  const int part = Choose(
    span.Left + 1 + span.Right,
    [&](int k) {
      return k == span.Left ? middle : edges[k < span.Left ? k : k - 1];
    },
    *found - before, across);
  if (part == span.Left)
  {
    // The sums grow nearly evenly: guess, then close in from both sides.
    int low = 0;
    int high = inner;
    double reached = 0.0;
    double next = middle;
    const double wanted = across * middle;
    for (int step = 0; high - low > 1; ++step)
    {
      int at = (low + high) / 2;
      if (step < 3 && next > reached)
      {
        at = low + static_cast<int>((wanted - reached) / (next - reached) * (high - low));
        at = std::clamp(at + (step == 1 ? 1 : 0), low + 1, high - 1);
      }
      const double sum = Dot(n, t.SumOf(layer, row, span.Begin + span.Left, at));
      (sum <= wanted ? low : high) = at;
      (sum <= wanted ? reached : next) = sum;
    }
    gets = next - reached;
    column = span.Begin + span.Left + low;
    across = gets > 0.0 ? std::clamp((wanted - reached) / gets, 0.0, 1.0 - 0x1p-53) : 0.5;
  }
  else
  {
    column = span.Begin + (part < span.Left ? part : part - 1 + std::max(inner, 0));
    gets = edges[part < span.Left ? part : part - 1];
  }
  column = t.Wrap(column);
  const double flux = layer.Flux[static_cast<std::size_t>(row) * t.Columns + column];
  if (!(gets > 0.0) || !(flux > 0.0))
  {
    return sample;
  }

  // The pixel of the map inside a block, by its flux.
  const SkyTable::Row* latitude = &t.Latitudes[row];
  sample.Row = row;
  sample.Column = column;
  int columns = t.Columns;
  if (t.FineRows * t.FineColumns > 1)
  {
    const auto line = [&](int i) {
      double sum = 0.0;
      for (int j = 0; j < t.FineColumns; ++j)
      {
        sum += t.Fine(0, row * t.FineRows + i, column * t.FineColumns + j);
      }
      return sum * t.FineLatitudes[row * t.FineRows + i].SolidAngle;
    };
    sample.Row = row * t.FineRows + Choose(t.FineRows, line, flux, down);
    latitude = &t.FineLatitudes[sample.Row];
    sample.Column = column * t.FineColumns +
      Choose(
        t.FineColumns,
        [&](int j) { return t.Fine(0, sample.Row, column * t.FineColumns + j); },
        line(sample.Row - row * t.FineRows) / latitude->SolidAngle, across);
    columns *= t.FineColumns;
  }
  const double s = latitude->SinTop + down * (latitude->SinBottom - latitude->SinTop);
  const double out = std::sqrt((1.0 - s) * (1.0 + s));
  const double azimuth = (2.0 * (sample.Column + across) / columns - 1.0) * units::Pi;
  const Vec3 w{ out * std::sin(azimuth), out * std::cos(azimuth), s };
  sample.Direction = t.Axes.ToWorld(w);
  sample.Weight = std::max(0.0, Dot(n, w)) * flux / gets;
  const SkyModel model = t.Sky().Model();
  if (sample.Weight > 0.0 && s > 0.0 &&
    (model == SkyModel::General || model == SkyModel::TraditionalOvercast))
  {
    sample.Weight *= t.Sky().At(w) * t.TotalIntensity() * latitude->SolidAngle / flux;
  }
  return sample;
}

double SkyView::BandShare(const Sample& sample, int band) const
{
  const SkyTable& t = *this->Table;
  return t.Fine(static_cast<std::size_t>(band) + 1, sample.Row, sample.Column) /
    t.Fine(0, sample.Row, sample.Column);
}

} // namespace radiometry
