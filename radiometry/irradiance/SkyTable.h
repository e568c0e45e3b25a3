// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Light.h"
#include "radiometry/scene/SkyRadiance.h"

#include <cstddef>
#include <vector>

namespace radiometry
{

/// An environment light cut into pixels of latitude and longitude, each with its exact vector
/// irradiance int L w dw: what a plane gets from the pixels wholly above it is linear in its normal.
///   Layers  0: the strength, sum of the bands (what directions are chosen by); then, where the
///           bands of a map differ, each band by itself
///   Cost    some 1e5 radiances once; memory 32 bytes a pixel and layer. A map of more than 256
///           rows is gathered into blocks (its pixels are kept for what needs them)
class SkyTable
{
public:
  explicit SkyTable(const Light& light);

  int Bands() const { return static_cast<int>(this->Source.Intensity.size()); }
  /// True when each band has the same distribution.
  bool Grey() const { return this->Layers.size() == 1; }
  const SkyFrame& Frame() const { return this->Axes; }
  const SkyRadiance& Sky() const { return *this->Source.Environment; }
  const Light& GetLight() const { return this->Source; }
  /// No radiance comes from below the horizon.
  bool DarkBelow() const { return this->Dark; }
  bool Black() const { return !(this->Strength > 0.0); }

  /// Irradiance of a plane with nothing in the way, per band [W/m^2], `normal` a world direction.
  /// Returns the relative error: rounding for uniform and overcast skies, else what pixels that
  /// the plane's horizon crosses may add.
  double Irradiance(const Vec3& normal, double* bands) const;
  /// No plane gets more, in any band [W/m^2].
  double GreatestIrradiance() const;

private:
  friend class SkyView;

  /// A band of pixels of equal latitude.
  struct Row
  {
    double SinTop, SinBottom; // of the elevation
    double Up;                // int w dw of one pixel of radiance 1: vertical part
    double Out;               // ... and horizontal part
    double SolidAngle;
    double Sin, Cos;          // at half height
    double Height;            // radians
  };
  struct Layer
  {
    std::vector<Vec3> Prefix; // rows x (columns + 1): sums of int L w dw from the left
    std::vector<double> Flux; // rows x columns: int L dw
  };
  /// The pixels of a row that a plane sees: columns [Begin, Begin + Count), cyclic; the first Left
  /// and the last Right of them may be crossed by its horizon.
  struct Span
  {
    int Begin = 0;
    int Count = 0;
    int Left = 0;
    int Right = 0;
  };

  static Row MakeRow(int row, int rows, int columns);
  void FillAnalytic();
  void FillMap();
  void MakePrefix();
  Span Visible(const Vec3& normal, int row) const;
  Vec3 SumOf(const Layer& layer, int row, int begin, int count) const;
  /// Irradiance from one pixel, clipped at the horizon; adds it to `crossing` where that cuts it.
  double Clipped(
    const Vec3& normal, std::size_t layer, int row, int column, double& crossing) const;
  /// Mean cosine over a pixel at an azimuth of that sine and cosine.
  double Pixel(const Vec3& normal, const Row& row, double sine, double cosine, double width,
    bool& whole) const;
  /// Value of a fine pixel in a layer.
  double Fine(std::size_t layer, int row, int column) const;
  int Wrap(int column) const
  {
    const int c = column % this->Columns;
    return c < 0 ? c + this->Columns : c;
  }
  double RowIrradiance(
    const Vec3& normal, std::size_t layer, int row, const Span& span, double& crossing) const;
  bool ClosedForm(const Vec3& normal, double& value) const;
  double TotalIntensity() const; // of all bands

  Light Source;
  SkyFrame Axes;
  bool Dark = false;
  double Strength = 0.0; // sum of the layer's flux
  int Rows = 0;
  int Columns = 0;
  int FineRows = 0;    // pixels of a map in each row and column of a block
  int FineColumns = 0;
  int CopyRows = 1;    // pixels that stand for one pixel of a coarse map
  int CopyColumns = 1;
  std::vector<Row> Latitudes;
  std::vector<Row> FineLatitudes; // of a map's pixels
  std::vector<double> Sines;      // of the middle of each column's azimuth
  std::vector<double> Cosines;
  std::vector<Layer> Layers;
};

/// Irradiance of a horizontal plane per unit of the sky's Intensity, in one band [sr].
double HorizontalIrradiance(std::shared_ptr<const SkyRadiance> sky, int band = 0);

/// A sky as a plane sees it: chooses directions with a density of radiance times cosine.
class SkyView
{
public:
  /// Ready for a plane; buffers are kept from one to the next.
  void Look(const SkyTable& table, const Vec3& normal);

  /// Strength that the plane gets, nothing in the way.
  double Total() const { return this->Cumulative.empty() ? 0.0 : this->Cumulative.back(); }

  struct Sample
  {
    Vec3 Direction;     // world, unit
    double Weight = 0;  // 1 on average; 0: below the plane
    int Row = 0, Column = 0; // the fine pixel, for the bands
  };
  /// From two numbers in [0, 1): neighbours give neighbours.
  Sample Draw(double u, double v) const;
  /// Share of a band in a sample's strength, times the intensity of the band.
  double BandShare(const Sample& sample, int band) const;

private:
  const SkyTable* Table = nullptr;
  Vec3 Normal;       // in the sky's frame
  bool Even = false; // the same radiance from everywhere
  std::vector<double> Cumulative; // of the rows' strengths
  std::vector<SkyTable::Span> Spans;
  std::vector<double> Edges;      // irradiance from the first and last pixels of each row's span
  std::vector<std::size_t> First; // of each row among them
  std::vector<double> Inner;      // irradiance from the others of each row
};

} // namespace radiometry
