// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/SceneBuilder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace benchmark
{

/// Rooms in a row with tables, chairs, shelves full of books, bowls and lamps, in as many triangles as
/// asked; the same for the same number, on any machine.
///
///   Up to some 4000 triangles the furniture grows with the number, one piece after the other; from
///   there on the four rooms are complete and each quad is cut into a finer grid. Rooms are joined by
///   doorways through walls 0.12 m thick and closed to the outside. Things stand on each other: the
///   faces by which they touch are left out, the surface below is whole.
///   Light    in each room an emitting panel under the ceiling and a point light beside the shelf
///   Optics   of one Kind a triangle: Reflectance() in three bands, Exitance()
class FurnishedScene
{
public:
  enum Kind : std::uint8_t
  {
    Floor,
    Wall,
    ColouredWall,
    Ceiling,
    Wood,
    RedBook,
    BlueBook,
    PaleBook,
    Porcelain,
    Panel,
    Kinds
  };

  /// About `triangles` of them (within some 10 % from 1000 on).
  explicit FurnishedScene(std::size_t triangles)
  {
    const double wanted = static_cast<double>(triangles);
    this->Things = 1u << 20;
    this->Edge = 1e9;
    this->Build();
    if (this->Triangles.size() > triangles) // fewer things: a coarse scene has coarse furniture
    {
      std::size_t low = 0;
      std::size_t high = 4 * ThingsOfARoom;
      while (low < high)
      {
        this->Things = (low + high + 1) / 2;
        this->Build();
        (this->Triangles.size() <= triangles ? low : high) =
          this->Triangles.size() <= triangles ? this->Things : this->Things - 1;
      }
      this->Things = low;
      this->Build();
      return;
    }
    double fine = 1e-3;
    double coarse = 8.0;
    for (int k = 0; k < 24; ++k)
    {
      this->Edge = std::sqrt(fine * coarse);
      (static_cast<double>(this->Count()) > wanted ? fine : coarse) = this->Edge;
    }
    this->Build();
  }

  std::vector<radiometry::Vec3> Points;
  std::vector<std::array<std::int32_t, 3>> Triangles;
  std::vector<std::uint8_t> KindOf; // of each triangle
  std::vector<radiometry::Vec3> Lamps; // of one W/sr a band each

  /// Of a kind, three bands.
  static std::array<double, 3> Reflectance(Kind kind)
  {
    static constexpr double table[Kinds][3] = { { 0.35, 0.28, 0.20 }, { 0.75, 0.73, 0.68 },
      { 0.55, 0.30, 0.22 }, { 0.82, 0.82, 0.80 }, { 0.48, 0.33, 0.19 }, { 0.45, 0.08, 0.07 },
      { 0.08, 0.14, 0.40 }, { 0.70, 0.66, 0.50 }, { 0.85, 0.84, 0.80 }, { 0.70, 0.70, 0.70 } };
    return { table[kind][0], table[kind][1], table[kind][2] };
  }
  /// W/m^2 in each band.
  static double Exitance(Kind kind) { return kind == Panel ? 40.0 : 0.0; }
  static constexpr double LampIntensity = 3.0; // W/sr in each band

  /// The scene for the core: every triangle a cell. `bands` 1 (the green one) or 3.
  radiometry::Scene ToScene(int bands = 1, bool panels = true) const
  {
    using namespace radiometry;
    SceneBuilder builder;
    std::vector<std::int32_t> cell(this->Triangles.size());
    for (std::size_t t = 0; t < cell.size(); ++t)
    {
      cell[t] = static_cast<std::int32_t>(t);
    }
    builder.AddMesh(SceneBuilder::Role::Receiver, this->Points, this->Triangles, cell, 1.0);
    Scene scene = builder.Finish(this->Triangles.size());
    scene.Optics.Bands = bands;
    scene.Optics.TwoSided.assign(scene.Cells, 0);
    for (std::size_t side = 0; side < 2; ++side)
    {
      auto& reflectance = scene.Optics.DiffuseReflectance[side];
      auto& exitance = scene.Optics.EmittedExitance[side];
      for (const std::uint8_t kind : this->KindOf)
      {
        for (int b = 0; b < bands; ++b)
        {
          reflectance.push_back(Reflectance(static_cast<Kind>(kind))[bands == 1 ? 1 : b]);
          exitance.push_back(panels ? Exitance(static_cast<Kind>(kind)) : 0.0);
        }
      }
    }
    for (const Vec3& lamp : this->Lamps)
    {
      Light light;
      light.Position = lamp - scene.Origin;
      light.Intensity.assign(static_cast<std::size_t>(bands), LampIntensity);
      scene.Lights.push_back(light);
    }
    return scene;
  }

private:
  using Vec3 = radiometry::Vec3;
  static constexpr std::size_t ThingsOfARoom = 110; // at least as many as Furnish asks for
  static constexpr double Length = 5.0, Width = 4.0, Height = 2.7, Thick = 0.12;

  /// The triangles that Build would make with the present Edge.
  std::size_t Count()
  {
    this->Counting = true;
    this->Build();
    this->Counting = false;
    return this->Counted;
  }

  void Build()
  {
    this->Points.clear();
    this->Triangles.clear();
    this->KindOf.clear();
    this->Lamps.clear();
    this->Counted = 0;
    // A small scene is one room; the rooms after it come with their furniture.
    std::size_t left = this->Things;
    const int rooms =
      1 + static_cast<int>(std::min<std::size_t>(3, this->Things / ThingsOfARoom));
    for (int r = 0; r < rooms; ++r)
    {
      const double x = r * (Length + Thick);
      this->Shell(x, r > 0, r + 1 < rooms);
      this->Random = 88172645463325252ull + static_cast<std::uint64_t>(r);
      this->Furnish(x, left);
    }
  }

  int Cuts(const Vec3& side) const
  {
    return std::max(1, static_cast<int>(std::ceil(radiometry::Length(side) / this->Edge - 1e-9)));
  }

  /// A parallelogram whose front is along a x b.
  void Quad(const Vec3& o, const Vec3& a, const Vec3& b, Kind kind)
  {
    const int n = this->Cuts(a);
    const int m = this->Cuts(b);
    this->Grid(n, m, kind, [&](double s, double t) { return o + s * a + t * b; });
  }

  /// 2 n m triangles on the places of (s, t) in the unit square.
  template <class Place>
  void Grid(int n, int m, Kind kind, const Place& place)
  {
    this->Counted += 2 * static_cast<std::size_t>(n) * static_cast<std::size_t>(m);
    if (this->Counting)
    {
      return;
    }
    const auto first = static_cast<std::int32_t>(this->Points.size());
    for (int j = 0; j <= m; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        this->Points.push_back(place(static_cast<double>(i) / n, static_cast<double>(j) / m));
      }
    }
    for (int j = 0; j < m; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        const std::int32_t p = first + j * (n + 1) + i;
        this->Triangles.push_back({ p, p + 1, p + n + 2 });
        this->Triangles.push_back({ p, p + n + 2, p + n + 1 });
      }
    }
    this->KindOf.resize(this->Triangles.size(), kind);
  }

  /// An upright box without the faces that touch other things.
  void Block(const Vec3& lo, const Vec3& size, Kind kind, bool bottom, bool top = true, bool ends = true)
  {
    const Vec3 x{ size.x, 0, 0 };
    const Vec3 y{ 0, size.y, 0 };
    const Vec3 z{ 0, 0, size.z };
    if (bottom)
    {
      this->Quad(lo, y, x, kind);
    }
    if (top)
    {
      this->Quad(lo + z, x, y, kind);
    }
    this->Quad(lo, x, z, kind);
    this->Quad(lo + y, z, x, kind);
    if (ends)
    {
      this->Quad(lo, z, y, kind);
      this->Quad(lo + x, y, z, kind);
    }
  }

  /// A body of revolution about z whose profile goes from angle 0 (top) to `end` of a sphere.
  void Ball(const Vec3& centre, double radius, double end, Kind kind)
  {
    const double pi = std::acos(-1.0);
    const int bands = std::max(4, static_cast<int>(std::ceil(end * radius / this->Edge)));
    const int around = std::max(8, static_cast<int>(std::ceil(2.0 * pi * radius / this->Edge)));
    const double top = 0.08; // a small hole at the pole instead of triangles without area
    this->Grid(around, bands, kind, [&](double s, double t) {
      const double theta = end - t * (end - top);
      const double phi = 2.0 * pi * (s == 1.0 ? 0.0 : s);
      return centre +
        radius * Vec3{ std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta) };
    });
    const double rim = radius * std::sin(top);
    const double high = radius * std::cos(top);
    this->Counted += static_cast<std::size_t>(around);
    if (!this->Counting)
    {
      const auto first = static_cast<std::int32_t>(this->Points.size());
      for (int i = 0; i < around; ++i)
      {
        const double phi = 2.0 * pi * i / around;
        this->Points.push_back(centre + Vec3{ rim * std::cos(phi), rim * std::sin(phi), high });
      }
      this->Points.push_back(centre + Vec3{ 0, 0, high });
      for (int i = 0; i < around; ++i)
      {
        this->Triangles.push_back({ first + i, first + (i + 1) % around, first + around });
      }
      this->KindOf.resize(this->Triangles.size(), kind);
    }
  }

  /// Floor, ceiling and walls seen from inside; doorways toward the rooms before and after.
  void Shell(double x, bool before, bool after)
  {
    const Vec3 o{ x, 0, 0 };
    const Vec3 l{ Length, 0, 0 };
    const Vec3 w{ 0, Width, 0 };
    const Vec3 h{ 0, 0, Height };
    this->Quad(o, l, w, Floor);
    this->Quad(o + h, w, l, Ceiling);
    this->Quad(o, h, l, Wall);
    this->Quad(o + w, l, h, ColouredWall);
    const double side = 1.0, wide = 0.9, tall = 2.05; // of the doorway
    const auto end = [&](const Vec3& foot, bool door, bool facesPlus) {
      const auto part = [&](double y0, double y1, double z0, double z1) {
        const Vec3 a{ 0, y1 - y0, 0 };
        const Vec3 b{ 0, 0, z1 - z0 };
        const Vec3 c = foot + Vec3{ 0, y0, z0 };
        facesPlus ? this->Quad(c, a, b, Wall) : this->Quad(c, b, a, Wall);
      };
      if (!door)
      {
        part(0, Width, 0, Height);
        return;
      }
      part(0, side, 0, Height);
      part(side + wide, Width, 0, Height);
      part(side, side + wide, tall, Height);
    };
    end(o, before, true);
    end(o + l, after, false);
    if (after) // the inside of the doorway
    {
      const Vec3 t{ Thick, 0, 0 };
      const Vec3 a{ 0, wide, 0 };
      const Vec3 up{ 0, 0, tall };
      const Vec3 foot = o + l + Vec3{ 0, side, 0 };
      this->Quad(foot, t, a, Wood);
      this->Quad(foot + up, a, t, Wood);
      this->Quad(foot, up, t, Wood);
      this->Quad(foot + a, t, up, Wood);
    }
  }

  double Next() // in [0, 1), xorshift
  {
    this->Random ^= this->Random << 13;
    this->Random ^= this->Random >> 7;
    this->Random ^= this->Random << 17;
    return static_cast<double>(this->Random >> 11) / 9007199254740992.0;
  }

  /// Up to `left` things, which it counts down. Every room draws the same numbers whatever is left out.
  void Furnish(double x, std::size_t& left)
  {
    const auto one = [&] { return left > 0 ? (--left, true) : false; };
    const Vec3 o{ x, 0, 0 };
    this->Block(o + Vec3{ 2.0, 1.7, Height - 0.06 }, { 1.2, 0.6, 0.06 }, Panel, true, false);
    this->Lamps.push_back(o + Vec3{ 3.9, 3.2, 2.2 });
    const double shift = 0.3 * this->Next();
    const Vec3 table = o + Vec3{ 1.6 + shift, 1.4, 0 };
    if (one())
    {
      this->Block(table + Vec3{ 0, 0, 0.71 }, { 1.6, 0.9, 0.03 }, Wood, true);
    }
    for (int k = 0; k < 4; ++k)
    {
      if (one())
      {
        this->Block(table + Vec3{ k % 2 ? 1.5 : 0.04, k / 2 ? 0.8 : 0.04, 0 }, { 0.06, 0.06, 0.71 },
          Wood, false, false);
      }
    }
    for (int k = 0; k < 4; ++k)
    {
      this->Chair(table + Vec3{ 0.25 + 0.7 * (k % 2), k / 2 ? 1.0 : -0.5, 0 }, k / 2 == 1, one);
    }
    this->Shelf(o + Vec3{ 3.2, 3.7, 0 }, one);
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 foot = table + Vec3{ 0.3 + 0.45 * k, 0.35 + 0.2 * this->Next(), 0.74 };
      if (one())
      {
        this->Ball(foot + Vec3{ 0, 0, 0.08 }, 0.1, 2.498091544796509, Porcelain); // stands on a ring
      }
    }
  }

  template <class One>
  void Chair(const Vec3& foot, bool turned, const One& one)
  {
    if (one())
    {
      this->Block(foot + Vec3{ 0, 0, 0.43 }, { 0.42, 0.42, 0.03 }, Wood, true);
    }
    for (int k = 0; k < 4; ++k)
    {
      if (one())
      {
        this->Block(foot + Vec3{ k % 2 ? 0.36 : 0.02, k / 2 ? 0.36 : 0.02, 0 }, { 0.04, 0.04, 0.43 },
          Wood, false, false);
      }
    }
    if (one())
    {
      this->Block(foot + Vec3{ 0.03, turned ? 0.38 : 0.01, 0.46 }, { 0.36, 0.03, 0.45 }, Wood, false);
    }
  }

  /// Boards between two sides before the wall, with books of drawn thickness, height and colour.
  template <class One>
  void Shelf(const Vec3& foot, const One& one)
  {
    const double wide = 1.5, deep = 0.28, thick = 0.025;
    for (int k = 0; k < 2; ++k)
    {
      if (one())
      {
        this->Block(foot + Vec3{ k * (wide - thick), 0, 0 }, { thick, deep, 1.9 }, Wood, false);
      }
    }
    for (int board = 0; board < 5; ++board)
    {
      const double z = 0.1 + 0.38 * board;
      if (one())
      {
        this->Block(foot + Vec3{ thick, 0, z }, { wide - 2 * thick, deep, thick }, Wood, true, true, false);
      }
      double at = thick + 0.01;
      for (int book = 0; book < 14; ++book)
      {
        const double size = 0.02 + 0.05 * this->Next();
        const double tall = 0.2 + 0.12 * this->Next();
        const double into = 0.16 + 0.08 * this->Next();
        const auto kind = static_cast<Kind>(RedBook + static_cast<int>(3 * this->Next()));
        if (at + size < wide - thick - 0.01 && one())
        {
          this->Block(foot + Vec3{ at, deep - into - 0.01, z + thick }, { size, into, tall }, kind, false);
        }
        at += size + 0.004 + (this->Next() < 0.1 ? 0.12 : 0.0);
      }
    }
  }

  std::size_t Things = 0;
  double Edge = 1e9; // greatest side of a quad's pieces, m
  bool Counting = false;
  std::size_t Counted = 0;
  std::uint64_t Random = 1;
};

} // namespace benchmark
