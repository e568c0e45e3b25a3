// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadianceFilter.h"

#include "RadianceArrays.h"
#include "RadiometricJob.h"
#include "radiometry/effects/EffectBounds.h"
#include "radiometry/effects/SimulatedScene.h"
#include "radiometry/imaging/Camera.h"
#include "radiometry/irradiance/OutgoingRadiance.h"
#include "radiometry/irradiance/SeenSurface.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <iterator>

namespace names = radiometry::names;
using radiometry::InputError;
using radiometry::Vec3;

vtkStandardNewMacro(vtkRadianceFilter);

/// Who looks, as the core wants it and as the user said it.
struct vtkRadianceFilter::Looking
{
  radiometry::Viewer Viewer;
  std::string How;
};

namespace
{

constexpr int CameraPort = 3;

Vec3 Vector(const double* v) { return { v[0], v[1], v[2] }; }

bool IsZero(const double* v) { return v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0; }

void CheckFinite(const char* name, const double* v)
{
  for (int k = 0; k < 3; ++k)
  {
    if (!std::isfinite(v[k]))
    {
      throw InputError(name, -1, v[k], "finite numbers");
    }
  }
}

Vec3 Direction(const char* name, const double* v)
{
  CheckFinite(name, v);
  const Vec3 unit = Normalized(Vector(v));
  if (!(Length(unit) > 0.0))
  {
    throw InputError(name, -1, 0.0, "a direction, not (0, 0, 0)");
  }
  return unit;
}

using Result = vtkRadiometricFilter::Result;

using radiometry::Effect;
using radiometry::LightType;

constexpr std::pair<Effect, LightType> LightKinds[] = { { Effect::PointLights, LightType::Point },
  { Effect::SpotLights, LightType::Spot }, { Effect::DirectionalLights, LightType::Directional },
  { Effect::AreaLights, LightType::Area } };

bool IsOff(const vtkRadiometricFilter::Job& job, Effect effect)
{
  return job.Switches[static_cast<std::size_t>(effect)] == radiometry::EffectSwitch::Off;
}

/// The scene without the kinds of lights and the webs that are switched off; `made` holds it.
const radiometry::Scene& WithLightsOfPlan(
  const vtkRadiometricFilter::Job& job, std::unique_ptr<radiometry::Scene>& made)
{
  radiometry::SceneParts parts;
  bool less = parts.WithoutWebs = IsOff(job, Effect::CandelaWebs);
  for (const auto& [effect, type] : LightKinds)
  {
    parts.WithoutLights[static_cast<std::size_t>(type)] = IsOff(job, effect);
    less = less || IsOff(job, effect);
  }
  if (less)
  {
    made = std::make_unique<radiometry::Scene>(radiometry::ReduceScene(
      job.Scene, parts, radiometry::SingleBands(job.Scene.Optics.Bands)));
  }
  return less ? *made : job.Scene;
}

void AddRow(Result& result, radiometry::Effect effect, bool present, bool simulated,
  const std::string& why, double bound)
{
  radiometry::EffectDecision& row = result.Effects[static_cast<std::size_t>(effect)];
  row.Known = true;
  row.Present = present;
  row.Simulated = present && simulated;
  row.Why = present ? (simulated ? why : "switched off; " + why) : why;
  row.Bound = row.Present && !row.Simulated ? bound : 0.0;
}

/// Rows of the kinds of lights: what their light makes of the radiance that surfaces send, by lobes
/// and, where it is computed here, by diffuse reflection.
void AddLightRows(
  const vtkRadiometricFilter::Job& job, bool diffuseHere, bool specular, Result& result)
{
  const auto row = [&](Effect effect, auto test, const std::string& what, const char* absent) {
    const auto& lights = job.Scene.Lights;
    const auto count = std::count_if(lights.begin(), lights.end(),
      [&](const radiometry::Light& l) { return l.Enabled && test(l); });
    const bool present = count > 0 && (diffuseHere || specular);
    AddRow(result, effect, present, !IsOff(job, effect),
      present ? std::to_string(count) + ' ' + what
              : (count > 0 ? "its light is in the input, and nothing reflects it specularly" : absent),
      present && IsOff(job, effect)
        ? radiometry::BoundRadianceOf(job.Scene, job.Points, test, diffuseHere)
        : 0.0);
  };
  static const char* const words[] = { "point", "spot", "directional", "area" };
  for (std::size_t k = 0; k < std::size(LightKinds); ++k)
  {
    const LightType type = LightKinds[k].second;
    row(LightKinds[k].first, [type](const radiometry::Light& l) { return l.Type == type; },
      std::string(words[k]) + " lights are on", "there are none that are on");
  }
  row(Effect::CandelaWebs, [](const radiometry::Light& l) { return l.Web != nullptr; },
    "lights have candela webs", "no light has a candela web");
}

/// Of a part of the run, whose prediction is not that of the run.
class WithoutPrediction : public radiometry::Monitor
{
public:
  explicit WithoutPrediction(radiometry::Monitor* whole)
    : Whole(whole)
  {
  }
  bool Progress(double fraction, const char* stage) override
  {
    return !this->Whole || this->Whole->Progress(0.6 * fraction, stage);
  }

private:
  radiometry::Monitor* Whole;
};

bool AnyPositive(const std::vector<double>& values)
{
  return std::any_of(values.begin(), values.end(), [](double v) { return v > 0.0; });
}
bool AnyPositive(const std::array<std::vector<double>, 2>& sides)
{
  return AnyPositive(sides[0]) || AnyPositive(sides[1]);
}

} // namespace

vtkRadianceFilter::vtkRadianceFilter()
{
  this->SetNumberOfInputPorts(CameraPort + 1);
}

void vtkRadianceFilter::SetCameraConnection(vtkAlgorithmOutput* camera)
{
  this->SetInputConnection(CameraPort, camera);
}

void vtkRadianceFilter::RemoveCameraConnection()
{
  this->SetInputConnection(CameraPort, nullptr);
}

void vtkRadianceFilter::SetCameraData(vtkDataObject* camera)
{
  this->SetInputDataInternal(CameraPort, camera);
}

int vtkRadianceFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port != CameraPort)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

void vtkRadianceFilter::SetViewPoint(double x, double y, double z)
{
  const double point[3] = { x, y, z };
  std::copy_n(point, 3, this->ViewPoint);
  this->Given = VIEW_POINT;
  this->Modified();
}

void vtkRadianceFilter::SetViewDirection(double x, double y, double z)
{
  const double direction[3] = { x, y, z };
  std::copy_n(direction, 3, this->ViewDirection);
  this->Given = VIEW_DIRECTION;
  this->Modified();
}

void vtkRadianceFilter::SetViewPointUnlessZero(double x, double y, double z)
{
  const int before = this->Given;
  this->SetViewPoint(x, y, z);
  this->Given =
    !IsZero(this->ViewPoint) ? VIEW_POINT : (before == VIEW_POINT ? VIEW_AUTOMATIC : before);
}

void vtkRadianceFilter::SetViewDirectionUnlessZero(double x, double y, double z)
{
  const int before = this->Given;
  this->SetViewDirection(x, y, z);
  this->Given = !IsZero(this->ViewDirection)
    ? VIEW_DIRECTION
    : (before == VIEW_DIRECTION ? VIEW_AUTOMATIC : before);
}

std::vector<std::string> vtkRadianceFilter::CellArraysRead() const
{
  std::vector<std::string> read;
  for (const char* quantity : { names::Irradiance, names::Radiosity })
  {
    for (const char* side : { "", names::BackSuffix })
    {
      const std::string name = std::string(quantity) + side;
      read.push_back(name);
      read.push_back(name + names::ErrorSuffix);
    }
  }
  return read;
}

bool vtkRadianceFilter::WantsPoints(const SceneAdapter& adapter) const
{
  return this->SampleLocation == POINTS ||
    (!CarryLight(adapter.Blocks(), false) && CarryLight(adapter.Blocks(), true));
}

vtkRadianceFilter::Looking vtkRadianceFilter::FindViewer(const Job& job)
{
  const radiometry::Scene& scene = job.Scene;
  const auto place = [&](const double* p) {
    return this->MetersPerUnit * Vector(p) - scene.Origin;
  };
  Looking looking;
  radiometry::Viewer& viewer = looking.Viewer;
  auto* camera = vtkPolyData::SafeDownCast(
    this->GetNumberOfInputConnections(CameraPort) > 0 ? this->GetInputDataObject(CameraPort, 0)
                                                      : nullptr);
  const bool data = camera && camera->GetNumberOfPoints() > 0;
  const bool position = !std::equal(
    this->CameraPosition, this->CameraPosition + 3, this->CameraFocalPoint);
  int from = this->ViewFrom;
  if (from == VIEW_AUTOMATIC)
  {
    from = this->Given != VIEW_AUTOMATIC ? this->Given
                                         : (data || position ? VIEW_CAMERA : VIEW_AUTOMATIC);
  }
  bool axis = false; // known
  if (from == VIEW_POINT)
  {
    CheckFinite("ViewPoint", this->ViewPoint);
    viewer.Eye = place(this->ViewPoint);
    looking.How = "ViewPoint";
  }
  else if (from == VIEW_DIRECTION)
  {
    viewer.Parallel = true;
    viewer.Direction = viewer.Axis = Direction("ViewDirection", this->ViewDirection);
    looking.How = "ViewDirection";
    axis = true;
  }
  else if (from == VIEW_CAMERA && data)
  {
    double p[3];
    camera->GetPoint(0, p);
    CheckFinite("Camera Points", p);
    viewer.Eye = place(p);
    vtkDataArray* direction = camera->GetPointData()->GetArray(names::Direction);
    if (direction && direction->GetNumberOfComponents() != 3)
    {
      throw InputError("Camera Direction", -1,
        std::to_string(direction->GetNumberOfComponents()) + " components", "3");
    }
    axis = direction != nullptr;
    if (axis)
    {
      double d[3];
      direction->GetTuple(0, d);
      viewer.Axis = Direction("Camera Direction", d);
    }
    looking.How = "the first camera of the input";
  }
  else if (from == VIEW_CAMERA)
  {
    if (!position)
    {
      throw InputError("Camera", -1, "missing",
        "a camera as input, or CameraPosition other than CameraFocalPoint (ViewFrom Camera)");
    }
    CheckFinite("CameraPosition", this->CameraPosition);
    CheckFinite("CameraFocalPoint", this->CameraFocalPoint);
    viewer.Eye = place(this->CameraPosition);
    viewer.Axis = Normalized(Vector(this->CameraFocalPoint) - Vector(this->CameraPosition));
    looking.How = "CameraPosition";
    axis = true;
  }
  else
  {
    viewer = radiometry::HomeViewer(scene);
    looking.How = "an eye that sees all of the surface along -z, as none was given";
    axis = true;
  }
  if (!IsZero(this->ViewAxis))
  {
    viewer.Axis = Direction("ViewAxis", this->ViewAxis);
  }
  else if (!axis)
  {
    const Vec3 way = Normalized(radiometry::MiddleOf(scene) - viewer.Eye);
    viewer.Axis = Length(way) > 0.0 ? way : viewer.Axis;
  }
  viewer.Normal = IsZero(this->ReceiverNormal) ? viewer.Axis
                                               : Direction("ReceiverNormal", this->ReceiverNormal);
  return looking;
}

void vtkRadianceFilter::Simulate(Job& job, Result& result)
{
  std::unique_ptr<radiometry::Scene> fewer;
  const radiometry::Scene& scene = WithLightsOfPlan(job, fewer);
  if (!(this->FNumber >= 0.0) || !std::isfinite(this->FNumber))
  {
    throw InputError("FNumber", -1, this->FNumber, "a finite number above 0, or 0: no image");
  }
  const Looking looking = this->FindViewer(job);
  const radiometry::Viewer& viewer = looking.Viewer;

  const radiometry::ConvergenceRecord clock;
  WithoutPrediction quiet(job.Progress);
  // Diffuse light: as the surface brings it, or direct light computed here.
  SurfaceLight light = ReadSurfaceLight(job);
  const auto on = [&](radiometry::Effect effect) {
    return job.Switches[static_cast<std::size_t>(effect)] != radiometry::EffectSwitch::Off;
  };
  const bool emission = on(radiometry::Effect::Emission);
  std::string method = std::string("seen from ") + looking.How + "; diffuse light from ";
  if (light.Any)
  {
    method += light.Radiosity ? names::Radiosity : names::Irradiance;
    method += " of the input";
  }
  else
  {
    radiometry::IrradianceOptions options;
    options.RelativeTolerance = this->RelativeTolerance;
    options.AbsoluteTolerance = this->AbsoluteTolerance * radiometry::units::Pi;
    options.TimeBudget = job.TimeBudget;
    options.Threads = job.Threads;
    options.Ranks = job.Ranks;
    options.Switches = job.Switches;
    const auto points =
      job.WantCells ? std::vector<radiometry::SurfacePoint>() : job.Points;
    radiometry::IrradianceResult direct =
      radiometry::SimulateIrradiance(scene, points, options, &quiet);
    light.Cells = std::move(direct.Cells);
    light.Points = std::move(direct.Points);
    result.Convergence = std::move(direct.Convergence);
    method += "direct light computed here: the input has neither Radiosity nor Irradiance";
  }
  radiometry::DiffuseLight diffuse;
  if (light.Radiosity)
  {
    for (std::size_t side = 0; side < 2; ++side)
    {
      diffuse.Exitance[side] = std::move(light.Cells[side].Values);
      diffuse.Error[side] = std::move(light.Cells[side].Errors);
    }
  }
  else
  {
    diffuse = radiometry::ReflectDiffusely(scene, light.Cells, emission);
  }

  radiometry::RadianceOptions options;
  options.RelativeTolerance = this->RelativeTolerance;
  options.AbsoluteTolerance = this->AbsoluteTolerance;
  options.Threads = job.Threads;
  options.SecondsBefore = clock.Elapsed();
  options.SecondsLeft = job.TimeBudget > 0.0
    ? std::max(1e-9, job.TimeBudget - options.SecondsBefore)
    : 0.0;
  options.PilotOnly = job.PilotOnly;
  options.Effects.Occlusion = on(radiometry::Effect::Occlusion);
  options.Effects.Specular = on(radiometry::Effect::SpecularTransport);
  options.Effects.Transmission = on(radiometry::Effect::Transmission);
  options.Effects.Environment = on(radiometry::Effect::Environment);
  options.Effects.SpotShape = on(radiometry::Effect::SpotShape);
  options.Effects.Attenuation = on(radiometry::Effect::Attenuation);
  options.Effects.BackFaces = on(radiometry::Effect::BackFaces);
  options.Known = ReadLightVisibility(job);
  const radiometry::OcclusionScene occluders(scene);
  const double begin = light.Any ? 0.02 : 0.6;
  radiometry::SeenSurface seen;
  radiometry::RadianceResult radiance;
  if (job.WantCells)
  {
    std::vector<std::int32_t> cells;
    for (const SceneAdapter::Block& block : job.Adapter->OwnBlocks())
    {
      for (vtkIdType c = 0; c < block.Cells; ++c)
      {
        if (block.Number(c) >= 0)
        {
          cells.push_back(block.Number(c));
        }
      }
    }
    radiance = radiometry::ComputeOutgoingRadiance(scene, occluders, diffuse, viewer, cells, options,
      { job.Progress, begin, 0.98, "radiance" }, &result.Convergence);
    radiometry::SpreadToCells(scene, cells, radiance);
    seen = radiometry::LookAtCells(scene, viewer);
  }
  else
  {
    const radiometry::DiffuseLight here =
      radiometry::DiffuseAtPoints(scene, job.Points, diffuse, light.Points, light.Radiosity, emission);
    radiance = radiometry::ComputeOutgoingRadiance(scene, occluders, diffuse, viewer, job.Points,
      here, options, { job.Progress, begin, 0.98, "radiance" }, &result.Convergence);
    seen = radiometry::LookAtPoints(job.Points, viewer);
  }
  if (this->FNumber > 0.0)
  {
    const int bands = scene.Optics.Bands;
    Result::Quantity image{ names::ImageIrradiance, "W/m^2",
      radiometry::ImageIrradiance(radiance.Values, bands, this->FNumber, seen.CosAxis),
      radiometry::ImageIrradiance(radiance.Errors, bands, this->FNumber, seen.CosAxis) };
    radiometry::AddCosFourthSpread(
      radiance.Values, bands, this->FNumber, seen.CosAxis, seen.CosFourthMean, image.Errors);
    (job.WantCells ? result.Cells : result.Points).push_back(std::move(image));
  }
  auto& quantities = job.WantCells ? result.Cells : result.Points;
  auto& scalars = job.WantCells ? result.CellScalars : result.PointScalars;
  quantities.insert(quantities.begin(),
    { names::Radiance, "W/(m^2 sr)", radiance.Values, radiance.Errors });
  scalars.push_back({ names::Facing, "1", std::move(seen.Facing), true });
  scalars.push_back({ names::OffAxisAngle, "degrees", std::move(seen.OffAxisDegrees) });
  if (job.WantCells && !viewer.Parallel)
  {
    scalars.push_back({ names::SolidAngle, "sr", std::move(seen.SolidAngle) });
    scalars.push_back({ std::string(names::SolidAngle) + names::ErrorSuffix, "sr",
      std::move(seen.SolidAngleError) });
    scalars.push_back({ names::ProjectedSolidAngle, "sr", std::move(seen.Projected) });
    scalars.push_back({ std::string(names::ProjectedSolidAngle) + names::ErrorSuffix, "sr",
      std::move(seen.ProjectedError) });
  }
  const Vec3 eye = (viewer.Eye + scene.Origin) / this->MetersPerUnit;
  result.Fields = { viewer.Parallel
      ? std::pair<std::string, std::vector<double>>{ "ViewDirection",
          { viewer.Direction.x, viewer.Direction.y, viewer.Direction.z } }
      : std::pair<std::string, std::vector<double>>{ "ViewPoint", { eye.x, eye.y, eye.z } },
    { "ViewAxis", { viewer.Axis.x, viewer.Axis.y, viewer.Axis.z } },
    { "ReceiverNormal", { viewer.Normal.x, viewer.Normal.y, viewer.Normal.z } },
    { "FNumber", { this->FNumber } } };
  result.Active = names::Radiance;
  result.BoundUnit = "W/(m^2 sr)";
  result.Method = method;
  result.Cost = radiance.Cost;
  result.Outcome = radiance.TimedOut
    ? "the time budget ended the run before every value met its tolerance"
    : "every value met its tolerance or is as fine as can be";

  // What was left out.
  const radiometry::RadianceEffects& e = options.Effects;
  const double bound = radiance.LeftOut;
  const bool specular = AnyPositive(scene.Optics.SpecularReflectance);
  const bool panes = AnyPositive(scene.Optics.Transmittance);
  const auto has = [&](auto test) {
    return std::any_of(scene.Lights.begin(), scene.Lights.end(),
      [&](const radiometry::Light& l) { return l.Enabled && test(l); });
  };
  const std::string seenBy = "lobes, mirrors and panes";
  result.Effects.assign(radiometry::EffectCount, {});
  AddRow(result, radiometry::Effect::Occlusion, specular, e.Occlusion,
    specular ? "surfaces may stand between lights and what reflects them; " +
        std::to_string(radiance.Rays) + " rays for " + std::to_string(radiance.Sampled) +
        (job.WantCells ? " cells" : " points")
             : "no surface reflects specularly: shadows are in the diffuse light",
    bound);
  AddRow(result, radiometry::Effect::Interreflection, true, true,
    light.Radiosity ? "in Radiosity, and seen in " + seenBy : "", 0.0);
  if (!light.Radiosity)
  {
    radiometry::EffectDecision& row =
      result.Effects[static_cast<std::size_t>(radiometry::Effect::Interreflection)];
    row.Simulated = false;
    row.Why = "what surfaces reflect onto each other is not in Irradiance: run Radiosity first";
    row.Bound = radiometry::BoundInterreflection(scene, diffuse);
    row.Present = row.Bound > 0.0;
    row.Why = row.Present ? row.Why : "no surface reflects, or no light is on";
  }
  AddRow(result, radiometry::Effect::SpecularTransport, specular, e.Specular,
    specular ? "surfaces reflect lights, surroundings and skies in their lobes"
             : "no surface reflects specularly",
    bound);
  AddRow(result, radiometry::Effect::Transmission, panes, e.Transmission,
    panes ? "panes show what is behind them" : "every surface is opaque", bound);
  const bool twoSided = std::any_of(scene.Optics.TwoSided.begin(), scene.Optics.TwoSided.end(),
    [](auto t) { return t != 0; });
  AddRow(result, radiometry::Effect::BackFaces, twoSided, e.BackFaces,
    twoSided ? "two-sided surfaces send from their backs" : "no surface is two-sided", bound);
  const bool emits = AnyPositive(scene.Optics.EmittedExitance);
  AddRow(result, radiometry::Effect::Emission, emits, emission || light.Radiosity,
    emits ? (light.Radiosity ? "in Radiosity" : "surfaces emit light of their own")
          : "no surface emits",
    radiometry::GreatestEmission(scene));
  const bool sky = has([](const auto& l) { return l.Type == radiometry::LightType::Environment; });
  AddRow(result, radiometry::Effect::Environment, sky && (specular || panes), e.Environment,
    sky && (specular || panes) ? "skies are seen in " + seenBy
                               : "no sky is seen in " + seenBy,
    bound);
  const bool spots =
    specular && has([](const auto& l) { return l.Type == radiometry::LightType::Spot; });
  AddRow(result, radiometry::Effect::SpotShape, spots, e.SpotShape,
    spots ? "spot lights have a cone or an exponent" : "no spot light makes a highlight", bound);
  const bool legacy = specular && has([](const auto& l) {
    return l.Type != radiometry::LightType::Directional &&
      l.Type != radiometry::LightType::Environment && !l.InverseSquare();
  });
  AddRow(result, radiometry::Effect::Attenuation, legacy, e.Attenuation,
    legacy ? "lights carry a legacy attenuation a + b r + c r^2 other than r^2"
           : "all lights that make highlights obey the inverse square law",
    bound);
  AddLightRows(job, !light.Any, specular, result);
  for (std::size_t k = 0; k < result.Effects.size(); ++k)
  {
    result.Effects[k].Wish = job.Switches[k];
  }
}

void vtkRadianceFilter::CopyMembers(vtkRadiometricAlgorithm* from)
{
  this->Superclass::CopyMembers(from);
  auto* other = vtkRadianceFilter::SafeDownCast(from);
  this->ViewFrom = other->ViewFrom;
  this->Given = other->Given;
  this->FNumber = other->FNumber;
  std::copy(std::begin(other->ViewPoint), std::end(other->ViewPoint), this->ViewPoint);
  std::copy(std::begin(other->ViewDirection), std::end(other->ViewDirection), this->ViewDirection);
  std::copy(std::begin(other->ViewAxis), std::end(other->ViewAxis), this->ViewAxis);
  std::copy(std::begin(other->ReceiverNormal), std::end(other->ReceiverNormal), this->ReceiverNormal);
}

void vtkRadianceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  static const char* const views[] = { "Automatic", "Point", "Direction", "Camera" };
  const auto vector = [&](const char* name, const double* v) {
    os << indent << name << ": " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
  };
  os << indent << "ViewFrom: " << views[this->ViewFrom] << '\n';
  vector("ViewPoint", this->ViewPoint);
  vector("ViewDirection", this->ViewDirection);
  vector("ViewAxis", this->ViewAxis);
  vector("ReceiverNormal", this->ReceiverNormal);
  os << indent << "FNumber: " << this->FNumber << '\n';
}
