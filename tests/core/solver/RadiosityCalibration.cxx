// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/solver/RadiosityCalibration.h"

#include <algorithm>

namespace test
{

using namespace radiometry;

const std::map<std::string, RadiosityMethod>& RadiosityMethods()
{
  static const std::map<std::string, RadiosityMethod> methods{ { "Dense", RadiosityMethod::Dense },
    { "Hierarchical", RadiosityMethod::Hierarchical },
    { "MonteCarlo", RadiosityMethod::MonteCarlo } };
  return methods;
}

std::vector<Judged> JudgeRadiosity(const RadiosityScene& scene,
  const std::vector<RadiosityReference>& references, const RadiosityOptions& options,
  RadiosityResult* result)
{
  const OcclusionScene occluders(scene.World);
  RadiositySimulation simulation(scene.World, occluders, options);
  const RadiosityResult& r = simulation.Run();
  if (result)
  {
    *result = r;
  }
  const auto bands = static_cast<std::size_t>(scene.World.Optics.Bands);
  std::vector<Judged> out;
  for (const RadiosityReference& reference : references)
  {
    if (reference.Scene == scene.Name)
    {
      const FieldValues& side = r.Irradiance[static_cast<std::size_t>(reference.Side)];
      const std::size_t k = reference.Cell * bands + static_cast<std::size_t>(reference.Band);
      Judged judged;
      judged.Value = side.Values[k];
      judged.Error = side.Errors[k];
      judged.Exact = reference.Irradiance;
      judged.ExactError = reference.Error;
      judged.Scale = *std::max_element(side.Values.begin(), side.Values.end());
      out.push_back(judged);
    }
  }
  return out;
}

} // namespace test
