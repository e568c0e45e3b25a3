// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/RadiosityCache.h"

#include "radiometry/formfactor/OperatorFile.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/solver/RadiosityLevel.h"
#include "radiometry/visibility/Convexity.h"

#include <utility>

namespace radiometry
{
namespace
{

using Options = std::vector<std::pair<std::string, std::string>>;

std::string OnOff(bool on) { return on ? "on" : "off"; }

/// The options that an operator is made by beside the method, and what it sees in mirrors.
Options ShapeOf(const Scene& scene, const RadiosityOptions& options)
{
  static const char* const refinements[] = { "Auto", "On", "Off" };
  Options shape{ { "Refinement", refinements[static_cast<int>(options.Refinement)] },
    { "Occlusion", OnOff(options.Occlusion) }, { "BackFaces", OnOff(options.BackFaces) },
    { "Seed", std::to_string(options.Seed) },
    { "SpecularTransport", OnOff(options.SpecularTransport) },
    { "Transmission", OnOff(options.PathTransmission) } };
  if (options.FollowsPaths())
  {
    const ContentKey mirrors = KeyOfMirrors(scene);
    shape.emplace_back(
      "Mirrors", std::to_string(mirrors.Low) + ":" + std::to_string(mirrors.High));
  }
  return shape;
}

bool Suits(RadiosityMethod asked, RadiosityMethod kept)
{
  return asked == RadiosityMethod::Auto || asked == kept;
}

} // namespace

RadiosityCache::RadiosityCache() = default;
RadiosityCache::~RadiosityCache() = default;

const OcclusionScene& RadiosityCache::Occluders(const Scene& scene)
{
  const ContentKey key = KeyOfGeometry(scene);
  if (!this->Visibility || key != this->Geometry)
  {
    this->Release();
    this->Visibility = std::make_unique<OcclusionScene>(scene);
    this->IsConvex = FindConvexity(scene) != Convexity::General;
    this->Geometry = key;
  }
  return *this->Visibility;
}

std::unique_ptr<RadiosityLevel> RadiosityCache::Take(
  const Scene& scene, const RadiosityOptions& options)
{
  if (this->Kept &&
    (!Suits(options.Method, this->Kept->Method) || this->Shape != ShapeOf(scene, options)))
  {
    this->Kept.reset();
  }
  return std::move(this->Kept);
}

void RadiosityCache::Keep(
  const Scene& scene, const RadiosityOptions& options, std::unique_ptr<RadiosityLevel> level)
{
  this->Kept = std::move(level);
  this->Shape = ShapeOf(scene, options);
}

void RadiosityCache::Save(const std::string& name, const Communicator* ranks) const
{
  if (!this->Kept)
  {
    throw InputError("OperatorFile", -1, name,
      "light that travels between surfaces: there is no operator to be written");
  }
  OperatorFileHead head;
  head.Geometry = this->Geometry;
  head.Options = this->Shape;
  head.Kind = MethodName(this->Kept->Method);
  head.Tolerance = this->Kept->Tolerance;
  head.Area = this->Kept->TargetArea;
  head.Seconds = this->Kept->ExchangeSeconds;
  WriteOperatorFile(name, head, this->Kept->Elements, *this->Kept->F, ranks);
}

void RadiosityCache::Load(
  const std::string& name, const Scene& scene, const RadiosityOptions& options)
{
  if (this->Kept && this->LoadedFrom == name && this->Shape == ShapeOf(scene, options))
  {
    return;
  }
  this->Kept.reset();
  OperatorFile file(name, options.Ranks);
  OperatorFileHead wanted;
  wanted.Geometry = this->Geometry;
  wanted.Options = ShapeOf(scene, options);
  file.Check(wanted);
  if (options.Method != RadiosityMethod::Auto && file.Head().Kind != MethodName(options.Method))
  {
    throw InputError("OperatorFile", -1, name,
      std::string("an operator of the method asked for: it is ") + file.Head().Kind + " and not " +
        MethodName(options.Method));
  }
  const RadiosityContext context(scene, *this->Visibility, options);
  auto level = std::make_unique<RadiosityLevel>(context, file.ReadElements());
  level->F = file.ReadOperator(*this->Visibility, level->Elements, context.Exchange());
  level->Carlo = dynamic_cast<MonteCarloOperator*>(level->F.get());
  for (const auto method :
    { RadiosityMethod::Dense, RadiosityMethod::Hierarchical, RadiosityMethod::MonteCarlo })
  {
    level->Method = file.Head().Kind == MethodName(method) ? method : level->Method;
  }
  level->Tolerance = file.Head().Tolerance;
  level->TargetArea = file.Head().Area;
  level->ExchangeSeconds = file.Head().Seconds;
  if (options.MemoryLimit > 0 && level->F->MemoryBytes() > options.MemoryLimit)
  {
    constexpr double mebibyte = 1024.0 * 1024.0;
    throw InputError("MemoryLimit", -1, static_cast<double>(options.MemoryLimit) / mebibyte,
      "at least " + std::to_string(level->F->MemoryBytes() / 1048576 + 1) +
        " MiB for the operator in the file");
  }
  level->Source = "read from " + name;
  this->Keep(scene, options, std::move(level));
  this->LoadedFrom = name;
}

void RadiosityCache::Release()
{
  this->LoadedFrom.clear();
  this->Kept.reset();
  this->Visibility.reset();
}

std::size_t RadiosityCache::MemoryBytes() const
{
  return this->Kept ? this->Kept->MemoryBytes() : 0;
}

} // namespace radiometry
