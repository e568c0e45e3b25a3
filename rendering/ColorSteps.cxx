// SPDX-License-Identifier: BSD-3-Clause
#include "ColorSteps.h"

#include "vtkColorTransferFunction.h"
#include "vtkScalarsToColors.h"
#include "vtkType.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace vtkradiometry
{
namespace
{

constexpr float Greatest = 1e30f; // of a coordinate: differences of two stay finite
constexpr int LeastSamples = 4096;
constexpr int MostSamples = 1 << 18;
constexpr int UnitsOfLastPlace = 8;

/// Floats in their order as integers in the same order.
std::int64_t Rank(float value)
{
  std::int32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits >= 0 ? bits : -static_cast<std::int64_t>(bits & 0x7fffffff);
}

float OfRank(std::int64_t rank)
{
  const std::int32_t bits = static_cast<std::int32_t>(rank >= 0 ? rank : -rank);
  float value = 0.0f;
  std::memcpy(&value, &bits, sizeof(value));
  return rank >= 0 ? value : -value;
}

struct Interval
{
  std::int64_t Begin, End;
  ColorSteps::Color AtBegin, AtEnd;
};

} // namespace

std::vector<ColorSteps::Color> MapValues(vtkScalarsToColors* map, std::vector<double> values)
{
  std::vector<ColorSteps::Color> colors(values.size());
  if (!values.empty())
  {
    map->MapScalarsThroughTable2(values.data(), colors[0].data(), VTK_DOUBLE,
      static_cast<int>(values.size()), 1, VTK_RGBA);
  }
  return colors;
}

double ColorSteps::ValueOf(float coordinate) const
{
  return this->Origin + this->Unit * static_cast<double>(coordinate);
}

void ColorSteps::Clear()
{
  this->Begins.clear();
  this->Colors.clear();
}

std::vector<float> ColorSteps::Samples(vtkScalarsToColors* map) const
{
  const double* range = map->GetRange();
  const int count = static_cast<int>(
    std::clamp<vtkIdType>(2 * map->GetNumberOfAvailableColors(), LeastSamples, MostSamples));
  const double ratio = this->Logarithmic ? range[1] / range[0] : 1.0;
  std::vector<float> samples{ -Greatest, -1.0f, 0.0f, 1.0f, Greatest };
  for (int i = 0; i <= count; ++i)
  {
    const double t = static_cast<double>(i) / count;
    samples.push_back(static_cast<float>(this->Logarithmic ? std::pow(ratio, t) : t));
  }
  if (auto* function = vtkColorTransferFunction::SafeDownCast(map))
  {
    for (int i = 0; i < function->GetSize(); ++i)
    {
      double node[6];
      function->GetNodeValue(i, node);
      samples.push_back(static_cast<float>((node[0] - this->Origin) / this->Unit));
    }
  }
  // Each with its neighbours: a colour may belong to one place only.
  const std::size_t given = samples.size();
  for (std::size_t i = 0; i < given; ++i)
  {
    samples.push_back(std::nextafter(samples[i], -Greatest));
    samples.push_back(std::nextafter(samples[i], Greatest));
  }
  samples.erase(std::remove_if(samples.begin(), samples.end(),
                  [](float x) { return !(x >= -Greatest && x <= Greatest); }),
    samples.end());
  std::sort(samples.begin(), samples.end());
  samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
  return samples;
}

void ColorSteps::Build(vtkScalarsToColors* map)
{
  this->Clear();
  map->Build();
  const double* range = map->GetRange();
  const double width = range[1] - range[0];
  this->Logarithmic = map->UsingLogScale() && range[0] * range[1] > 0.0 && width != 0.0;
  this->Origin = this->Logarithmic ? 0.0 : range[0];
  this->Unit = this->Logarithmic ? range[0] : width;
  if (!std::isfinite(this->Origin) || !std::isfinite(this->Unit))
  {
    this->Origin = 0.0;
    this->Unit = 1.0;
  }
  if (this->Unit == 0.0)
  {
    this->Unit = std::max(std::abs(this->Origin), std::numeric_limits<double>::min());
  }
  this->OfNaN = MapValues(map, { std::numeric_limits<double>::quiet_NaN() })[0];

  const auto colorsAt = [&](const std::vector<std::int64_t>& ranks) {
    std::vector<double> values;
    for (const std::int64_t rank : ranks)
    {
      values.push_back(this->ValueOf(OfRank(rank)));
    }
    return MapValues(map, std::move(values));
  };
  std::vector<std::int64_t> ranks;
  for (const float sample : this->Samples(map))
  {
    ranks.push_back(Rank(sample));
  }
  std::vector<Color> colors = colorsAt(ranks);
  std::vector<std::pair<std::int64_t, Color>> begins{ { ranks[0], colors[0] } };
  std::vector<Interval> open;
  for (std::size_t i = 1; i < ranks.size(); ++i)
  {
    if (colors[i - 1] != colors[i])
    {
      open.push_back({ ranks[i - 1], ranks[i], colors[i - 1], colors[i] });
    }
  }
  // Halve all intervals whose ends differ until nothing lies between their ends.
  while (!open.empty())
  {
    std::vector<Interval> wide;
    ranks.clear();
    for (const Interval& interval : open)
    {
      if (interval.End - interval.Begin == 1)
      {
        begins.emplace_back(interval.End, interval.AtEnd);
      }
      else
      {
        wide.push_back(interval);
        ranks.push_back(interval.Begin + (interval.End - interval.Begin) / 2);
      }
    }
    colors = colorsAt(ranks);
    open.clear();
    for (std::size_t i = 0; i < wide.size(); ++i)
    {
      if (wide[i].AtBegin != colors[i])
      {
        open.push_back({ wide[i].Begin, ranks[i], wide[i].AtBegin, colors[i] });
      }
      if (colors[i] != wide[i].AtEnd)
      {
        open.push_back({ ranks[i], wide[i].End, colors[i], wide[i].AtEnd });
      }
    }
  }
  std::sort(begins.begin(), begins.end(),
    [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& begin : begins)
  {
    this->Begins.push_back(OfRank(begin.first));
    this->Colors.push_back(begin.second);
  }
}

std::size_t ColorSteps::StepOf(float coordinate) const
{
  const auto after = std::upper_bound(this->Begins.begin(), this->Begins.end(), coordinate);
  return after == this->Begins.begin() ? 0
                                       : static_cast<std::size_t>(after - this->Begins.begin()) - 1;
}

float ColorSteps::Coordinate(double value, const Color& color) const
{
  const double exact = (value - this->Origin) / this->Unit;
  float x = static_cast<float>(
    std::clamp(exact, -static_cast<double>(Greatest), static_cast<double>(Greatest)));
  std::size_t step = this->StepOf(x);
  if (this->Colors[step] != color)
  {
    if (step + 1 < this->Begins.size() && this->Colors[step + 1] == color)
    {
      x = this->Begins[++step];
    }
    else if (step > 0 && this->Colors[step - 1] == color)
    {
      x = std::nextafter(this->Begins[step], -Greatest);
      --step;
    }
  }
  const bool last = step + 1 == this->Begins.size();
  const std::int64_t begin = Rank(this->Begins[step]);
  const std::int64_t end = last ? Rank(Greatest) : Rank(this->Begins[step + 1]) - 1;
  const std::int64_t margin = std::min<std::int64_t>(UnitsOfLastPlace, (end - begin) / 2);
  // Zero stays: rounding keeps it.
  return x == 0.0f ? x : OfRank(std::clamp(Rank(x), begin + margin, end - margin));
}

std::vector<float> ColorSteps::Texels() const
{
  std::vector<float> texels;
  const auto put = [&texels](float begin, const Color& color) {
    texels.push_back(begin);
    texels.push_back(static_cast<float>(color[0] + 256 * color[1] + 65536 * color[2]));
    texels.push_back(static_cast<float>(color[3]) / 255.0f);
    texels.push_back(0.0f);
  };
  put(0.0f, this->OfNaN);
  for (std::size_t i = 0; i < this->Begins.size(); ++i)
  {
    put(this->Begins[i], this->Colors[i]);
  }
  return texels;
}

} // namespace vtkradiometry
