// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/SkyTable.h"

#include "radiometry/geometry/Quadrature.h"
#include "radiometry/scene/Units.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

constexpr double Pi = units::Pi;
/// Pixels of an analytic sky, and the least of a map: 1.4 degrees.
constexpr int TableRows = 128;
constexpr int TableColumns = 256;
/// Rows of a map above which its pixels are gathered into blocks, and columns.
constexpr int MostRows = 256;
constexpr int MostColumns = 512;

/// Mean of max(0, t) over t = middle + x + y, x and y even in [-a, a] and [-b, b].
double ClippedMean(double middle, double a, double b)
{
  if (a < b)
  {
    std::swap(a, b);
  }
  if (middle >= a + b)
  {
    return middle;
  }
  if (middle <= -a - b)
  {
    return 0.0;
  }
  const auto positive = [](double t) { return t > 0.0 ? t : 0.0; };
  if (b < 1e-4 * a)
  {
    const double p = positive(middle + a);
    const double m = positive(middle - a);
    return (p * p - m * m) / (4.0 * a);
  }
  const auto cube = [&](double t) {
    const double p = positive(t);
    return p * p * p;
  };
  return (cube(middle + a + b) - cube(middle + a - b) - cube(middle - a + b) +
           cube(middle - a - b)) /
    (24.0 * a * b);
}

/// The least divisor of n that leaves at most `most`; 1 where what is left would be too coarse.
int BlockSize(int n, int most)
{
  for (int k = 1; k <= n && n / k >= most / 4; ++k)
  {
    if (n % k == 0 && n / k <= most)
    {
      return k;
    }
  }
  return 1;
}

} // namespace

SkyTable::Row SkyTable::MakeRow(int row, int rows, int columns)
{
  const double top = Pi * (0.5 - static_cast<double>(row) / rows);
  const double bottom = Pi * (0.5 - static_cast<double>(row + 1) / rows);
  const double width = 2.0 * Pi / columns;
  Row r;
  // Differences as products keep their digits near the zenith.
  const double middle = 0.5 * (top + bottom);
  const double height = Pi / rows;
  r.Height = height;
  r.SinTop = row == 0 ? 1.0 : (2 * row == rows ? 0.0 : std::sin(top));
  r.SinBottom = row + 1 == rows ? -1.0 : (2 * (row + 1) == rows ? 0.0 : std::sin(bottom));
  r.Sin = std::sin(middle);
  r.Cos = std::cos(middle);
  const double band = 2.0 * r.Cos * std::sin(0.5 * height); // sin top - sin bottom
  r.SolidAngle = width * band;
  r.Up = width * r.Sin * std::cos(0.5 * height) * band;
  r.Out = 2.0 * std::sin(0.5 * width) * 0.5 *
    (height + std::cos(2.0 * middle) * std::sin(height));
  return r;
}

SkyTable::SkyTable(const Light& light)
  : Source(light)
  , Axes(light.Direction, light.Reference)
{
  if (!this->Source.Environment)
  {
    this->Source.Environment = SkyRadiance::Uniform();
  }
  const SkyRadiance& sky = this->Sky();
  this->Rows = TableRows;
  this->Columns = TableColumns;
  int blockRows = 1;
  int blockColumns = 1;
  if (sky.Model() == SkyModel::Map)
  {
    this->CopyRows = (TableRows + sky.Height() - 1) / sky.Height();
    this->CopyColumns = (TableColumns + sky.Width() - 1) / sky.Width();
    blockRows = BlockSize(sky.Height() * this->CopyRows, MostRows);
    blockColumns = BlockSize(sky.Width() * this->CopyColumns, MostColumns);
    this->Rows = sky.Height() * this->CopyRows / blockRows;
    this->Columns = sky.Width() * this->CopyColumns / blockColumns;
  }
  this->FineRows = blockRows;
  this->FineColumns = blockColumns;
  for (int r = 0; r < this->Rows; ++r)
  {
    this->Latitudes.push_back(MakeRow(r, this->Rows, this->Columns));
  }
  for (int c = 0; c < this->Columns; ++c)
  {
    const double azimuth = (2.0 * (c + 0.5) / this->Columns - 1.0) * Pi;
    this->Sines.push_back(std::sin(azimuth));
    this->Cosines.push_back(std::cos(azimuth));
  }
  this->Dark = sky.Model() != SkyModel::Uniform && sky.Model() != SkyModel::Map &&
    sky.GroundRadiance() == 0.0;
  this->Layers.resize(
    sky.Model() == SkyModel::Map && sky.Bands() > 1 ? 1 + this->Source.Intensity.size() : 1);
  for (Layer& layer : this->Layers)
  {
    layer.Flux.assign(static_cast<std::size_t>(this->Rows) * this->Columns, 0.0);
    layer.Prefix.assign(static_cast<std::size_t>(this->Rows) * (this->Columns + 1), Vec3{});
  }
  sky.Model() == SkyModel::Map ? this->FillMap() : this->FillAnalytic();
  this->MakePrefix();
}

/// Each pixel's vector goes to Prefix[column + 1]; MakePrefix sums them.
void SkyTable::FillAnalytic()
{
  const SkyRadiance& sky = this->Sky();
  const double total = this->TotalIntensity();
  Layer& layer = this->Layers[0];
  const double width = 2.0 * Pi / this->Columns;
  const double nearSun = std::cos(3.0 * width);
  const double atSun = std::cos(1.2 * width); // a pixel that may hold the cusp of the indicatrix
  for (int r = 0; r < this->Rows; ++r)
  {
    const Row& row = this->Latitudes[r];
    const bool below = row.SinTop <= 0.0;
    for (int c = 0; c < this->Columns; ++c)
    {
      const std::size_t at = static_cast<std::size_t>(r) * this->Columns + c;
      Vec3& vector = layer.Prefix[static_cast<std::size_t>(r) * (this->Columns + 1) + c + 1];
      if (sky.Model() == SkyModel::Uniform || below)
      {
        const double radiance =
          sky.Model() == SkyModel::Uniform ? total : total * sky.GroundRadiance();
        layer.Flux[at] = radiance * row.SolidAngle;
        vector = radiance * Vec3{ row.Out * this->Sines[c], row.Out * this->Cosines[c], row.Up };
        continue;
      }
      const double azimuth = (2.0 * (c + 0.5) / this->Columns - 1.0) * Pi;
      const Vec3 middle{ row.Cos * this->Sines[c], row.Cos * this->Cosines[c], row.Sin };
      const double toSun = sky.Model() == SkyModel::General ? Dot(middle, sky.ToSun()) : -1.0;
      const LineRule& rule = GaussLegendre(toSun > atSun ? 64 : (toSun > nearSun ? 16 : 4));
      for (std::size_t i = 0; i < rule.Nodes.size(); ++i)
      {
        const double s = row.SinBottom + rule.Nodes[i] * (row.SinTop - row.SinBottom);
        const double cosine = std::sqrt((1.0 - s) * (1.0 + s));
        for (std::size_t j = 0; j < rule.Nodes.size(); ++j)
        {
          const double a = azimuth + (rule.Nodes[j] - 0.5) * width;
          const Vec3 w{ cosine * std::sin(a), cosine * std::cos(a), s };
          const double flux =
            total * rule.Weights[i] * rule.Weights[j] * row.SolidAngle * sky.At(w);
          layer.Flux[at] += flux;
          vector += flux * w;
        }
      }
    }
  }
}

double SkyTable::Fine(std::size_t layer, int row, int column) const
{
  const SkyRadiance& sky = this->Sky();
  const std::size_t pixel =
    static_cast<std::size_t>(row / this->CopyRows) * sky.Width() + column / this->CopyColumns;
  const auto bands = static_cast<std::size_t>(sky.Bands());
  if (layer > 0)
  {
    return this->Source.Intensity[layer - 1] * sky.Values()[pixel * bands + layer - 1];
  }
  double sum = 0.0;
  for (std::size_t b = 0; b < this->Source.Intensity.size(); ++b)
  {
    sum += this->Source.Intensity[b] * sky.Values()[pixel * bands + (bands > 1 ? b : 0)];
  }
  return sum;
}

void SkyTable::FillMap()
{
  const int rows = this->Rows * this->FineRows;
  const int columns = this->Columns * this->FineColumns;
  for (int r = 0; r < rows; ++r)
  {
    this->FineLatitudes.push_back(MakeRow(r, rows, columns));
  }
  for (int c = 0; c < columns; ++c)
  {
    const double azimuth = (2.0 * (c + 0.5) / columns - 1.0) * Pi;
    const double sine = std::sin(azimuth);
    const double cosine = std::cos(azimuth);
    for (int r = 0; r < rows; ++r)
    {
      const Row& fine = this->FineLatitudes[r];
      const std::size_t row = static_cast<std::size_t>(r / this->FineRows);
      const std::size_t column = static_cast<std::size_t>(c / this->FineColumns);
      const Vec3 vector{ fine.Out * sine, fine.Out * cosine, fine.Up };
      for (std::size_t k = 0; k < this->Layers.size(); ++k)
      {
        const double value = this->Fine(k, r, c);
        this->Layers[k].Flux[row * this->Columns + column] += value * fine.SolidAngle;
        this->Layers[k].Prefix[row * (this->Columns + 1) + column + 1] += value * vector;
      }
    }
  }
}

void SkyTable::MakePrefix()
{
  for (const double flux : this->Layers[0].Flux)
  {
    this->Strength += flux;
  }
  for (Layer& layer : this->Layers)
  {
    for (int r = 0; r < this->Rows; ++r)
    {
      Vec3* sum = &layer.Prefix[static_cast<std::size_t>(r) * (this->Columns + 1)];
      for (int c = 0; c < this->Columns; ++c)
      {
        sum[c + 1] += sum[c];
      }
    }
  }
}

SkyTable::Span SkyTable::Visible(const Vec3& n, int r) const
{
  const Row& row = this->Latitudes[r];
  const double level = n.z * row.Up / row.SolidAngle;
  const double out = std::hypot(n.x, n.y);
  const double swing = out * row.Out / row.SolidAngle;
  // No point of a pixel's edge is farther from the plane than its middle by more than this.
  const double reach = 1.05 * Pi * (out * row.Cos / this->Columns + 0.5 / this->Rows);
  Span span;
  if (level + swing <= -reach)
  {
    return span;
  }
  // Every row begins behind the plane's back, so that neighbours in a row's share are neighbours.
  const double step = 2.0 * Pi / this->Columns;
  const double middle = (std::atan2(n.x, n.y) + Pi) / step - 0.5;
  if (level - swing >= reach)
  {
    span.Begin = static_cast<int>(std::ceil(middle - 0.5 * this->Columns));
    span.Count = this->Columns;
    return span;
  }
  // Half-widths, in columns, of what is surely above and of what may be.
  const auto halfWidth = [&](double height) {
    return swing > 0.0 ? std::acos(std::clamp((height - level) / swing, -1.0, 1.0)) / step
                       : (level > height ? 0.5 * this->Columns : 0.0);
  };
  const double sure = level + swing < reach ? -1.0 : halfWidth(reach);
  const double most = halfWidth(-reach);
  span.Begin = static_cast<int>(std::ceil(middle - most));
  span.Count = static_cast<int>(std::floor(middle + most)) - span.Begin + 1;
  if (span.Count >= this->Columns)
  {
    span.Begin = static_cast<int>(std::ceil(middle - 0.5 * this->Columns));
    span.Count = this->Columns;
  }
  const int begin = static_cast<int>(std::ceil(middle - sure));
  const int end = static_cast<int>(std::floor(middle + sure)) + 1;
  if (sure < 0.0 || end <= begin)
  {
    span.Left = span.Count;
    return span;
  }
  span.Left = std::max(0, begin - span.Begin);
  span.Right = std::max(0, span.Begin + span.Count - end);
  return span;
}

Vec3 SkyTable::SumOf(const Layer& layer, int row, int begin, int count) const
{
  const Vec3* sum = &layer.Prefix[static_cast<std::size_t>(row) * (this->Columns + 1)];
  const int first = this->Wrap(begin);
  const int last = first + count;
  if (last <= this->Columns)
  {
    return sum[last] - sum[first];
  }
  return sum[this->Columns] - sum[first] + sum[last - this->Columns];
}

/// Mean cosine over a pixel, clipped at the horizon; `whole`: the horizon does not cross it.
double SkyTable::Pixel(const Vec3& n, const Row& row, double sine, double cosine, double width,
  bool& whole) const
{
  const double out = n.x * sine + n.y * cosine;
  const double across = n.x * cosine - n.y * sine;
  const double middle = (n.z * row.Up + out * row.Out) / row.SolidAngle;
  const double a = 0.5 * width * std::fabs(across) * row.Cos;
  const double b = 0.5 * row.Height * std::fabs(n.z * row.Cos - out * row.Sin);
  // A horizon along an edge: the middle of a curved pixel is nearer to it than that of a flat one.
  const double along = (1.0 - 0.25 * row.Height) * (a + b);
  whole = middle > 0.0 && middle >= along;
  if (middle < 0.0 && middle <= -along)
  {
    return 0.0;
  }
  return ClippedMean(middle, a, b);
}

double SkyTable::Clipped(
  const Vec3& n, std::size_t layer, int row, int column, double& crossing) const
{
  const int c = this->Wrap(column);
  if (this->FineRows * this->FineColumns == 1)
  {
    const double flux = this->Layers[layer].Flux[static_cast<std::size_t>(row) * this->Columns + c];
    if (!(flux > 0.0))
    {
      return 0.0;
    }
    bool whole = false;
    const double mean =
      this->Pixel(n, this->Latitudes[row], this->Sines[c], this->Cosines[c],
        2.0 * Pi / this->Columns, whole);
    if (whole)
    {
      return std::max(0.0, Dot(n, this->SumOf(this->Layers[layer], row, c, 1)));
    }
    crossing += flux * mean;
    return flux * mean;
  }
  const int columns = this->Columns * this->FineColumns;
  double sum = 0.0;
  for (int i = 0; i < this->FineRows; ++i)
  {
    const int r = row * this->FineRows + i;
    const Row& fine = this->FineLatitudes[r];
    for (int j = 0; j < this->FineColumns; ++j)
    {
      const int k = c * this->FineColumns + j;
      const double value = this->Fine(layer, r, k);
      if (value > 0.0)
      {
        const double azimuth = (2.0 * (k + 0.5) / columns - 1.0) * Pi;
        bool whole = false;
        const double part =
          value * fine.SolidAngle *
          this->Pixel(n, fine, std::sin(azimuth), std::cos(azimuth), 2.0 * Pi / columns, whole);
        crossing += whole ? 0.0 : part;
        sum += part;
      }
    }
  }
  return sum;
}

double SkyTable::RowIrradiance(
  const Vec3& n, std::size_t layer, int row, const Span& span, double& crossing) const
{
  if (span.Count == 0)
  {
    return 0.0;
  }
  const int inner = span.Count - span.Left - span.Right;
  double sum = inner > 0
    ? Dot(n, this->SumOf(this->Layers[layer], row, span.Begin + span.Left, inner))
    : 0.0;
  double edge = 0.0;
  for (int k = 0; k < span.Left; ++k)
  {
    edge += this->Clipped(n, layer, row, span.Begin + k, crossing);
  }
  for (int k = span.Count - span.Right; k < span.Count; ++k)
  {
    edge += this->Clipped(n, layer, row, span.Begin + k, crossing);
  }
  return std::max(0.0, sum) + edge;
}

bool SkyTable::ClosedForm(const Vec3& n, double& value) const
{
  const SkyRadiance& sky = this->Sky();
  if (sky.Model() == SkyModel::Uniform)
  {
    value = Pi;
    return true;
  }
  if (sky.Model() != SkyModel::TraditionalOvercast)
  {
    return false;
  }
  // Over the lune between horizon and plane, b the tilt and d = pi - b: int cos(theta) dw =
  // pi (1 + cos b)/2, int sin(elevation) cos(theta) dw = (2/3)(sin b + (pi - b) cos b).
  const double d = std::atan2(std::hypot(n.x, n.y), -n.z);
  const double half = std::sin(0.5 * d);
  const double lune = d > 0.1
    ? std::sin(d) - d * std::cos(d)
    : d * d * d * (1.0 / 3.0 - d * d * (1.0 / 30.0 - d * d * (1.0 / 840.0 - d * d / 45360.0)));
  value = (Pi * half * half + 4.0 / 3.0 * lune) / 3.0 +
    sky.GroundRadiance() * Pi * (1.0 - half * half);
  return true;
}

double SkyTable::Irradiance(const Vec3& normal, double* bands) const
{
  const std::vector<double>& intensity = this->Source.Intensity;
  const Vec3 n = this->Axes.ToSky(normal);
  double value = 0.0;
  if (this->ClosedForm(n, value))
  {
    for (std::size_t b = 0; b < intensity.size(); ++b)
    {
      bands[b] = intensity[b] * value;
    }
    return 8.0 * std::numeric_limits<double>::epsilon();
  }
  double crossing = 0.0;
  std::vector<double> layers(this->Layers.size(), 0.0);
  const double total = this->TotalIntensity();
  for (int r = 0; r < this->Rows; ++r)
  {
    const Span span = this->Visible(n, r);
    for (std::size_t k = 0; k < layers.size() && span.Count > 0; ++k)
    {
      double edge = 0.0;
      layers[k] += this->RowIrradiance(n, k, r, span, edge);
      crossing += k == 0 ? edge : 0.0;
    }
  }
  const double sum = layers[0];
  for (std::size_t b = 0; b < intensity.size(); ++b)
  {
    bands[b] = this->Grey() ? (total > 0.0 ? intensity[b] / total * sum : 0.0) : layers[b + 1];
  }
  // The share of the crossed pixels is known to the curvature of the horizon inside them, and to
  // the change of the radiance inside them; the Gauss points of the others lose little.
  const bool map = this->Sky().Model() == SkyModel::Map;
  return (map ? 1e-12 : 6e-10) + (sum > 0.0 ? (map ? 1e-3 : 1.5e-2) * crossing / sum : 0.0);
}

double HorizontalIrradiance(std::shared_ptr<const SkyRadiance> sky, int band)
{
  Light light;
  light.Type = LightType::Environment;
  light.Intensity.assign(static_cast<std::size_t>(sky->Bands()), 1.0);
  light.Environment = std::move(sky);
  std::vector<double> bands(light.Intensity.size());
  SkyTable(light).Irradiance({ 0.0, 0.0, 1.0 }, bands.data());
  return bands[band];
}

double SkyTable::TotalIntensity() const
{
  double total = 0.0;
  for (const double i : this->Source.Intensity)
  {
    total += i;
  }
  return total;
}

double SkyTable::GreatestIrradiance() const
{
  // A plane gets at most pi times the greatest radiance, and at most all flux from everywhere.
  const SkyRadiance& sky = this->Sky();
  double greatest = 0.0;
  for (std::size_t b = 0; b < this->Source.Intensity.size(); ++b)
  {
    double peak = std::max({ 1.0, sky.GroundRadiance(), sky.At(sky.ToSun()) });
    double flux = 0.0;
    const double total = this->TotalIntensity();
    const double share = this->Grey() ? this->Source.Intensity[b] / std::max(total, 1e-300) : 1.0;
    for (const double f : this->Layers[this->Grey() ? 0 : b + 1].Flux)
    {
      flux += share * f;
    }
    if (sky.Model() == SkyModel::Map)
    {
      peak = 0.0;
      const std::vector<double>& values = sky.Values();
      for (std::size_t k = sky.Bands() > 1 ? b : 0; k < values.size(); k += sky.Bands())
      {
        peak = std::max(peak, values[k]);
      }
    }
    else if (sky.Model() == SkyModel::General)
    {
      for (std::size_t k = 0; k < this->Layers[0].Flux.size() && total > 0.0; ++k)
      {
        const double mean =
          this->Layers[0].Flux[k] / this->Latitudes[k / this->Columns].SolidAngle / total;
        peak = std::max(peak, 1.1 * mean); // it may be higher inside a pixel
      }
    }
    greatest = std::max(greatest, std::min(Pi * peak * this->Source.Intensity[b], flux));
  }
  return greatest;
}

} // namespace radiometry
