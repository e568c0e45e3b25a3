// SPDX-License-Identifier: BSD-3-Clause

/// Writes the furnished scene (benchmarks/FurnishedScene.h) for benchmarks in Python: a line of JSON
/// that says how many points (float64 x 3), triangles (int32 x 3), kinds (uint8, one a triangle) and
/// lamps (float64 x 3) follow, and what reflectance and exitance each kind has.
///
///   furnished_scene TRIANGLES PATH

#include "benchmarks/FurnishedScene.h"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <fstream>
#include <iostream>

namespace
{

template <class T>
void Put(std::ostream& file, const std::vector<T>& values)
{
  file.write(reinterpret_cast<const char*>(values.data()),
    static_cast<std::streamsize>(values.size() * sizeof(T)));
}

} // namespace

int main(int argc, char** argv)
{
  if (argc != 3 || std::atof(argv[1]) < 1)
  {
    std::cerr << "furnished_scene TRIANGLES PATH\n";
    return 2;
  }
  using benchmark::FurnishedScene;
  const FurnishedScene scene(static_cast<std::size_t>(std::atof(argv[1])));
  nlohmann::json head;
  head["points"] = scene.Points.size();
  head["triangles"] = scene.Triangles.size();
  head["lamps"] = scene.Lamps.size();
  head["lampIntensity"] = FurnishedScene::LampIntensity;
  for (int kind = 0; kind < FurnishedScene::Kinds; ++kind)
  {
    head["reflectance"].push_back(FurnishedScene::Reflectance(FurnishedScene::Kind(kind)));
    head["exitance"].push_back(FurnishedScene::Exitance(FurnishedScene::Kind(kind)));
  }
  static_assert(sizeof(radiometry::Vec3) == 3 * sizeof(double));
  std::ofstream file(argv[2], std::ios::binary);
  file << head.dump() << '\n';
  Put(file, scene.Points);
  Put(file, scene.Triangles);
  Put(file, scene.KindOf);
  Put(file, scene.Lamps);
  return file.flush() ? 0 : 1;
}
