// SPDX-License-Identifier: BSD-3-Clause
#include "LinearCapture.h"

#include "color/ColorConfig.h"
#include "color/Primaries.h"
#include "io/ExrWriter.h"
#include "radiometry/imaging/Exposure.h"

#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkLinearFloatPass.h"
#include "vtkMultiProcessController.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <array>

namespace vtkradiometry
{
namespace
{

constexpr int CaptureTag = 46601;

void CopyValues(vtkImageData* image, int components, std::vector<float>& values)
{
  const float* first = static_cast<float*>(image->GetScalarPointer());
  values.assign(first, first + image->GetNumberOfPoints() * components);
}

float NearestAt(const LinearLayer& layer, std::size_t i)
{
  return layer.Nearest.empty() ? layer.Depth[i] : layer.Nearest[i];
}

/// One plane of the picture bottom-up as the file wants it top-down.
radiometry::io::ExrChannel Plane(
  const char* name, const std::vector<float>& values, int components, int component, int width, int height)
{
  radiometry::io::ExrChannel channel;
  channel.Name = name;
  const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(width) * components;
  channel.Data = values.data() + (height - 1) * row + component;
  channel.XStride = components;
  channel.YStride = -row;
  return channel;
}

/// The chromaticities of a colour space that this project's config has with linear values, by any
/// of its names; none for others.
void AddChromaticities(const std::string& space, radiometry::io::ExrPart& part)
{
  namespace color = radiometry::color;
  const auto is = [&](std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), space) != names.end();
  };
  color::Primaries p;
  if (is({ "", "Linear Rec.709", "Linear Rec.709 (sRGB)", "lin_rec709", "lin_srgb" }))
  {
    p = color::Primaries::Rec709();
  }
  else if (is({ "ACEScg", "lin_ap1", "ACES - ACEScg" }))
  {
    p = color::Primaries::ACES_AP1();
  }
  else if (is({ "ACES2065-1", "lin_ap0", "aces2065_1", "ACES - ACES2065-1" }))
  {
    p = color::Primaries::ACES_AP0();
  }
  else
  {
    return;
  }
  radiometry::io::ExrChromaticities xy{};
  int i = 0;
  for (const auto& point : { p.Red, p.Green, p.Blue, p.White })
  {
    xy[i++] = static_cast<float>(point[0]);
    xy[i++] = static_cast<float>(point[1]);
  }
  part.Attributes["chromaticities"] = xy;
}

std::array<double, 3> Triple(const double* v) { return { v[0], v[1], v[2] }; }

void AddCamera(vtkRenderer* renderer, radiometry::io::ExrPart& part)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  auto& attributes = part.Attributes;
  attributes["cameraPosition"] = Triple(camera->GetPosition());
  attributes["cameraFocalPoint"] = Triple(camera->GetFocalPoint());
  attributes["cameraViewUp"] = Triple(camera->GetViewUp());
  attributes["cameraClippingRange"] =
    std::array<float, 2>{ static_cast<float>(camera->GetClippingRange()[0]),
      static_cast<float>(camera->GetClippingRange()[1]) };
  if (camera->GetParallelProjection())
  {
    attributes["cameraParallelScale"] = camera->GetParallelScale();
  }
  else
  {
    attributes["cameraViewAngle"] = camera->GetViewAngle();
  }
}

} // namespace

//------------------------------------------------------------------------------
LinearLayer DrawLayer(vtkLinearFloatPass* pass, vtkRenderer* renderer, int reduction)
{
  LinearLayer layer;
  pass->RenderOffScreen(renderer, reduction);
  vtkImageData* color = pass->GetSampleColor();
  vtkImageData* depth = pass->GetSampleDepth();
  if (!color || !depth)
  {
    return layer;
  }
  layer.Samples = pass->GetSamples();
  layer.Width = color->GetDimensions()[0] / layer.Samples;
  layer.Height = color->GetDimensions()[1] / layer.Samples;
  CopyValues(color, 4, layer.Color);
  CopyValues(depth, 1, layer.Depth);
  if (vtkImageData* nearest = pass->GetSampleNearest())
  {
    CopyValues(nearest, 1, layer.Nearest);
  }
  return layer;
}

//------------------------------------------------------------------------------
bool Composite(LinearLayer& layer, const LinearLayer& other)
{
  if (layer.Width != other.Width || layer.Height != other.Height ||
    layer.Samples != other.Samples)
  {
    return false;
  }
  const bool nearest = !layer.Nearest.empty() || !other.Nearest.empty();
  std::vector<float> merged(nearest ? layer.Depth.size() : 0);
  for (std::size_t i = 0; i < layer.Depth.size(); ++i)
  {
    const float mine = NearestAt(layer, i);
    const float theirs = NearestAt(other, i);
    float* a = layer.Color.data() + 4 * i;
    const float* b = other.Color.data() + 4 * i;
    const bool front = mine <= theirs;
    const float through = 1.0f - (front ? a[3] : b[3]);
    for (int c = 0; c < 4; ++c)
    {
      a[c] = front ? a[c] + through * b[c] : b[c] + through * a[c];
    }
    layer.Depth[i] = std::min(layer.Depth[i], other.Depth[i]);
    if (nearest)
    {
      merged[i] = std::min(mine, theirs);
    }
  }
  layer.Nearest = std::move(merged);
  return true;
}

//------------------------------------------------------------------------------
bool GatherLayers(vtkMultiProcessController* controller, LinearLayer& layer)
{
  if (controller->GetLocalProcessId() > 0)
  {
    const int header[4] = { layer.Width, layer.Height, layer.Samples, layer.Nearest.empty() ? 0 : 1 };
    controller->Send(header, 4, 0, CaptureTag);
    if (layer.Samples > 0)
    {
      controller->Send(
        layer.Color.data(), static_cast<vtkIdType>(layer.Color.size()), 0, CaptureTag);
      controller->Send(
        layer.Depth.data(), static_cast<vtkIdType>(layer.Depth.size()), 0, CaptureTag);
    }
    if (!layer.Nearest.empty())
    {
      controller->Send(
        layer.Nearest.data(), static_cast<vtkIdType>(layer.Nearest.size()), 0, CaptureTag);
    }
    return true;
  }
  bool whole = layer.Samples > 0;
  for (int rank = 1; rank < controller->GetNumberOfProcesses(); ++rank)
  {
    int header[4] = { 0, 0, 0, 0 };
    controller->Receive(header, 4, rank, CaptureTag);
    LinearLayer other;
    other.Width = header[0];
    other.Height = header[1];
    other.Samples = header[2];
    const std::size_t n = static_cast<std::size_t>(header[2]) * header[2] * header[0] * header[1];
    other.Color.resize(4 * n);
    other.Depth.resize(n);
    other.Nearest.resize(header[3] ? n : 0);
    if (other.Samples > 0)
    {
      controller->Receive(other.Color.data(), static_cast<vtkIdType>(4 * n), rank, CaptureTag);
      controller->Receive(other.Depth.data(), static_cast<vtkIdType>(n), rank, CaptureTag);
    }
    if (header[3])
    {
      controller->Receive(other.Nearest.data(), static_cast<vtkIdType>(n), rank, CaptureTag);
    }
    whole = whole && other.Samples > 0 && Composite(layer, other);
  }
  return whole;
}

//------------------------------------------------------------------------------
LinearPicture Average(const LinearLayer& layer, const std::function<double(double)>& distanceOf)
{
  LinearPicture picture;
  picture.Width = layer.Width;
  picture.Height = layer.Height;
  const int n = layer.Samples;
  const std::size_t row = static_cast<std::size_t>(n) * layer.Width;
  for (int y = 0; y < layer.Height; ++y)
  {
    for (int x = 0; x < layer.Width; ++x)
    {
      double sum[4] = { 0.0, 0.0, 0.0, 0.0 };
      for (int j = 0; j < n; ++j)
      {
        const float* texel = layer.Color.data() + 4 * ((n * y + j) * row + n * x);
        for (int i = 0; i < 4 * n; ++i)
        {
          sum[i % 4] += texel[i];
        }
      }
      for (double value : sum)
      {
        picture.Color.push_back(static_cast<float>(value / (n * n)));
      }
      const float depth = layer.Depth[(n * y + n / 2) * row + n * x + n / 2];
      picture.Distance.push_back(static_cast<float>(distanceOf(depth)));
    }
  }
  return picture;
}

//------------------------------------------------------------------------------
double FittingStops(const LinearPicture& picture)
{
  namespace imaging = radiometry::imaging;
  const std::vector<double> pixels(picture.Color.begin(), picture.Color.end());
  auto lit = imaging::PixelLuminances(pixels.data(), pixels.size() / 4, 4, 1.0);
  lit.erase(
    std::remove_if(lit.begin(), lit.end(), [](double value) { return !(value > 0.0); }), lit.end());
  imaging::ExposureSettings settings;
  settings.Mode = imaging::ExposureMode::Automatic;
  settings.KeyValue = 0.25;
  settings.Percentile = 98.0;
  return imaging::ChooseExposure(lit, 1.0, settings).Stops;
}

//------------------------------------------------------------------------------
void SendPicture(vtkMultiProcessController* controller, const LinearPicture& picture)
{
  const int size[2] = { picture.Width, picture.Height };
  controller->Send(size, 2, 1, CaptureTag);
  if (picture.Width > 0)
  {
    controller->Send(
      picture.Color.data(), static_cast<vtkIdType>(picture.Color.size()), 1, CaptureTag);
    controller->Send(
      picture.Distance.data(), static_cast<vtkIdType>(picture.Distance.size()), 1, CaptureTag);
  }
}

LinearPicture ReceivePicture(vtkMultiProcessController* controller)
{
  int size[2] = { 0, 0 };
  controller->Receive(size, 2, 1, CaptureTag);
  LinearPicture picture;
  picture.Width = size[0];
  picture.Height = size[1];
  const std::size_t n = static_cast<std::size_t>(size[0]) * size[1];
  picture.Color.resize(4 * n);
  picture.Distance.resize(n);
  if (picture.Width > 0)
  {
    controller->Receive(picture.Color.data(), static_cast<vtkIdType>(4 * n), 1, CaptureTag);
    controller->Receive(picture.Distance.data(), static_cast<vtkIdType>(n), 1, CaptureTag);
  }
  return picture;
}

//------------------------------------------------------------------------------
void WritePicture(const std::string& fileName, const LinearPicture& picture,
  vtkRenderer* renderer, const CaptureNotes& notes)
{
  namespace io = radiometry::io;
  io::ExrPart part;
  part.DataWindow = io::ExrBox::OfSize(picture.Width, picture.Height);
  const char* const names[4] = { "R", "G", "B", "A" };
  for (int c = 0; c < 4; ++c)
  {
    part.Channels.push_back(
      Plane(names[c], picture.Color, 4, c, picture.Width, picture.Height));
  }
  part.Channels.push_back(
    Plane("Z", picture.Distance, 1, 0, picture.Width, picture.Height));
  AddChromaticities(notes.SourceColorSpace, part);
  AddCamera(renderer, part);
  auto& attributes = part.Attributes;
  attributes["software"] = std::string("vtkRadiometry " VTKRADIOMETRY_VERSION);
  attributes["units"] = std::string("W/(m^2 sr)");
  attributes["colorSpace"] =
    notes.SourceColorSpace.empty() ? std::string("Linear Rec.709") : notes.SourceColorSpace;
  attributes["samplesPerPixel"] = notes.Samples * notes.Samples;
  // Not applied to the pixels: how the view showed them.
  attributes["display"] = notes.Display;
  attributes["displayView"] = notes.View;
  attributes["displayLook"] = notes.Look;
  attributes["displayExposure"] = notes.Exposure; // in stops, the automatic part included
  io::WriteExr(fileName, { part });
}

} // namespace vtkradiometry
