// SPDX-License-Identifier: BSD-3-Clause
#include "LegendStrip.h"

#include "vtkFreeTypeTools.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkStdString.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace imaging = radiometry::imaging;

namespace
{

constexpr unsigned char Paper = 255;
constexpr unsigned char Ink = 30;

int FontSize(int height) { return std::max(8, std::min(32, height / 26)); }

/// Where the parts of the strip are, in pixels from its left and from the bottom.
struct Layout
{
  explicit Layout(int height)
    : Font(FontSize(height))
    , Left(Font)
    , Right(Font + std::max(8, static_cast<int>(1.6 * Font)))
    , Bottom(Font)
    , Top(std::max(Font + 2, height - static_cast<int>(4.2 * Font)))
  {
  }
  int Font;
  int Left;
  int Right;
  int Bottom;
  int Top;
};

class Canvas
{
public:
  Canvas(std::vector<unsigned char>& rgb, int columns, int height, int x)
    : Bytes(rgb)
    , Columns(columns)
    , Height(height)
    , X(x)
  {
  }

  int Width() const { return this->Columns - this->X; }

  void Set(int x, int y, const imaging::ByteColor& color) { this->Mix(x, y, color, 1.0); }

  void Mix(int x, int y, const imaging::ByteColor& color, double share)
  {
    if (x < 0 || x >= this->Width() || y < 0 || y >= this->Height)
    {
      return;
    }
    unsigned char* p =
      &this->Bytes[3 * (static_cast<std::size_t>(y) * this->Columns + this->X + x)];
    for (int c = 0; c < 3; ++c)
    {
      p[c] = static_cast<unsigned char>(std::lround(p[c] + share * (color[c] - double(p[c]))));
    }
  }

  void Box(int x0, int y0, int x1, int y1, const imaging::ByteColor& color)
  {
    for (int y = y0; y < y1; ++y)
    {
      for (int x = x0; x < x1; ++x)
      {
        this->Set(x, y, color);
      }
    }
  }

  /// Text whose left edge is x and whose middle is at y; smaller where it would not fit.
  void Text(const std::string& text, int x, int y, int font)
  {
    vtkNew<vtkTextProperty> style;
    style->SetColor(1.0, 1.0, 1.0);
    style->SetFontSize(font);
    vtkNew<vtkImageData> image;
    int size[2] = { 0, 0 };
    for (; font >= 6; --font)
    {
      style->SetFontSize(font);
      if (!vtkFreeTypeTools::GetInstance()->RenderString(style, text, 72, image, size))
      {
        return;
      }
      if (x + size[0] < this->Width())
      {
        break;
      }
    }
    int extent[6];
    image->GetExtent(extent);
    for (int v = 0; v < size[1]; ++v)
    {
      for (int u = 0; u < size[0]; ++u)
      {
        const double alpha =
          image->GetScalarComponentAsDouble(extent[0] + u, extent[2] + v, 0, 3) / 255.0;
        this->Mix(x + u, y - size[1] / 2 - font / 12 + v, { { Ink, Ink, Ink } }, alpha);
      }
    }
  }

private:
  std::vector<unsigned char>& Bytes;
  int Columns;
  int Height;
  int X;
};

} // namespace

int LegendStripWidth(int height) { return static_cast<int>(std::lround(8.4 * FontSize(height))); }

std::string LegendNumber(double value)
{
  const double size = std::abs(value);
  char text[32];
  std::snprintf(text, sizeof(text), size >= 100.0 && size < 1e6 ? "%.0f" : "%.3g",
    size == 0.0 ? 0.0 : value);
  return text;
}

std::vector<LegendTick> LegendTicks(
  const imaging::FalseColorMap& map, imaging::ColorScale scale, int height)
{
  const Layout layout(height);
  const int room =
    std::max(2, static_cast<int>((layout.Top - layout.Bottom) / (1.5 * layout.Font)));
  std::vector<LegendTick> ticks;
  const auto& limits = map.GetLimits();
  if (map.IsContinuous())
  {
    for (double level :
      imaging::RoundLevels(limits.front(), limits.back(), scale, std::min(room - 1, 10)))
    {
      ticks.emplace_back(map.Position(level), LegendNumber(level));
    }
    return ticks;
  }
  const int bands = static_cast<int>(limits.size()) - 1;
  const int every = (bands + room - 1) / room;
  for (int i = 0; i <= bands; i += every)
  {
    ticks.emplace_back(double(i) / bands, LegendNumber(limits[i]));
  }
  return ticks;
}

void DrawLegendStrip(std::vector<unsigned char>& rgb, int columns, int height, int x,
  const imaging::FalseColorMap& map, const std::vector<LegendTick>& ticks, const std::string& title,
  const std::string& unit)
{
  const Layout at(height);
  Canvas canvas(rgb, columns, height, x);
  canvas.Box(0, 0, canvas.Width(), height, { { Paper, Paper, Paper } });
  canvas.Box(at.Left - 1, at.Bottom - 1, at.Right + 1, at.Top + 1, { { Ink, Ink, Ink } });
  const auto& colors = map.GetColors();
  const int rows = at.Top - at.Bottom;
  for (int y = 0; y < rows; ++y)
  {
    const auto k =
      std::min(static_cast<std::size_t>((y + 0.5) / rows * colors.size()), colors.size() - 1);
    canvas.Box(at.Left, at.Bottom + y, at.Right, at.Bottom + y + 1, colors[k]);
  }
  const int dash = std::max(2, at.Font / 3);
  for (const LegendTick& tick : ticks)
  {
    const int y = at.Bottom + static_cast<int>(std::lround(tick.first * (rows - 1)));
    canvas.Box(at.Right + 1, y, at.Right + 1 + dash, y + 1, { { Ink, Ink, Ink } });
    canvas.Text(tick.second, at.Right + dash + at.Font / 2, y, at.Font);
  }
  canvas.Text(title, at.Left / 2, height - static_cast<int>(1.2 * at.Font), at.Font);
  if (!unit.empty())
  {
    canvas.Text(unit, at.Left / 2, height - static_cast<int>(2.6 * at.Font), at.Font);
  }
}
