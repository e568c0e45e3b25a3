// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiometricView.h"

#include "LinearCapture.h"
#include "color/ColorConfig.h"
#include "io/FileError.h"

#include "vtkLinearFloatPass.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkOpenColorIOPass.h"
#include "vtkPVSession.h"
#include "vtkPVSynchronizedRenderer.h"
#include "vtkProcessModule.h"
#include "vtkRenderer.h"
#include "vtkStringArray.h"

#include <cmath>
#include <cstring>

namespace color = radiometry::color;

vtkStandardNewMacro(vtkRadiometricView);

namespace
{

/// A name of the panel as a name of the pass.
const char* Chosen(const char* name)
{
  return name && std::strcmp(name, vtkRadiometricView::DefaultName()) != 0 ? name : "";
}

} // namespace

vtkRadiometricView::vtkRadiometricView()
{
  this->SynchronizedRenderers->SetRenderPass(this->Pass);
}

vtkRadiometricView::~vtkRadiometricView() = default;

#define vtkForwardNameMacro(name)                                                                  \
  void vtkRadiometricView::Set##name(const char* value)                                            \
  {                                                                                                \
    if (std::strcmp(this->Pass->Get##name(), Chosen(value)) != 0)                                  \
    {                                                                                              \
      this->Pass->Set##name(Chosen(value));                                                        \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  const char* vtkRadiometricView::Get##name() { return this->Pass->Get##name(); }

vtkForwardNameMacro(ConfigFileName);
vtkForwardNameMacro(SourceColorSpace);
vtkForwardNameMacro(Display);
vtkForwardNameMacro(View);
vtkForwardNameMacro(Look);

void vtkRadiometricView::SetExposure(double stops)
{
  this->Exposure = stops;
  this->UpdateExposure();
}

void vtkRadiometricView::SetAutoExposure(bool on)
{
  this->AutoExposure = on;
  this->UpdateExposure();
}

void vtkRadiometricView::SetAutomaticStops(double stops)
{
  this->AutomaticStops = stops;
  this->UpdateExposure();
}

double vtkRadiometricView::GetUsedExposure()
{
  return this->Exposure + (this->AutoExposure ? this->AutomaticStops : 0.0);
}

void vtkRadiometricView::UpdateExposure()
{
  if (this->Pass->GetExposure() != this->GetUsedExposure())
  {
    this->Pass->SetExposure(this->GetUsedExposure());
    this->Modified();
  }
}

//------------------------------------------------------------------------------
namespace
{

/// "Default" and what `list` gets of the config; a config that cannot be read is the pass's to tell.
template <typename F>
vtkStringArray* Fill(vtkStringArray* names, const char* file, const F& list)
{
  names->SetNumberOfValues(0);
  names->InsertNextValue(vtkRadiometricView::DefaultName());
  try
  {
    for (const std::string& name : list(color::ColorConfig::Open(file)))
    {
      names->InsertNextValue(name);
    }
  }
  catch (const color::ColorError&)
  {
  }
  return names;
}

} // namespace

vtkStringArray* vtkRadiometricView::GetDisplayNames()
{
  return Fill(this->Names, this->GetConfigFileName(),
    [](const color::ColorConfig& config) { return config.Displays(); });
}

vtkStringArray* vtkRadiometricView::GetViewNames()
{
  const std::string display = this->GetDisplay();
  return Fill(this->Names, this->GetConfigFileName(), [&](const color::ColorConfig& config) {
    return config.Views(display.empty() ? config.DefaultDisplay() : display);
  });
}

vtkStringArray* vtkRadiometricView::GetLookNames()
{
  return Fill(this->Names, this->GetConfigFileName(),
    [](const color::ColorConfig& config) { return config.Looks(); });
}

vtkStringArray* vtkRadiometricView::GetColorSpaceNames()
{
  return Fill(this->Names, this->GetConfigFileName(),
    [](const color::ColorConfig& config) { return config.ColorSpaces(); });
}

const char* vtkRadiometricView::GetErrorMessage()
{
  this->Message = this->Pass->GetErrorMessage();
  return this->Message.c_str();
}

//------------------------------------------------------------------------------
bool vtkRadiometricView::IsComposited()
{
  return this->GetUseDistributedRenderingForRender() &&
    vtkProcessModule::GetProcessType() != vtkProcessModule::PROCESS_CLIENT &&
    vtkProcessModule::GetProcessModule()->GetNumberOfLocalPartitions() > 1;
}

void vtkRadiometricView::AboutToRenderOnLocalProcess(bool interactive)
{
  this->Superclass::AboutToRenderOnLocalProcess(interactive);
  // Pictures composited by depth know no pixel that two processes share.
  this->Pass->SetSamples(interactive || this->IsComposited() ? 1 : this->Samples);
}

//------------------------------------------------------------------------------
/// Draws the light on every process that draws, and brings it together; true on the process that then
/// has it (or, with a width of 0, knows that it could not be had).
bool vtkRadiometricView::CollectPicture(
  vtkradiometry::LinearPicture& picture, int samples, int reduction)
{
  const bool distributed = this->GetUseDistributedRenderingForRender();
  vtkMultiProcessController* client = this->GetSession()->GetController(vtkPVSession::CLIENT);
  vtkMultiProcessController* server =
    this->GetSession()->GetController(vtkPVSession::RENDER_SERVER_ROOT);
  if (vtkProcessModule::GetProcessType() == vtkProcessModule::PROCESS_CLIENT && server &&
    distributed)
  {
    picture = vtkradiometry::ReceivePicture(server);
    return true;
  }
  if (!this->IsProcessRenderingGeometriesForCompositing(distributed))
  {
    return false;
  }
  this->CapturePass->SetSamples(samples);
  vtkradiometry::LinearLayer layer =
    vtkradiometry::DrawLayer(this->CapturePass, this->GetRenderer(), reduction);
  bool whole = layer.Samples > 0;
  if (this->IsComposited())
  {
    auto* ranks = vtkMultiProcessController::GetGlobalController();
    whole = vtkradiometry::GatherLayers(ranks, layer);
    if (ranks->GetLocalProcessId() > 0)
    {
      return false;
    }
  }
  if (whole)
  {
    picture = vtkradiometry::Average(
      layer, [this](double depth) { return this->CapturePass->DistanceOf(depth); });
  }
  if (client && distributed)
  {
    vtkradiometry::SendPicture(client, picture);
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
double vtkRadiometricView::MeasureExposure()
{
  // A quarter of the width and of the height tells as much.
  constexpr int reduction = 4;
  vtkradiometry::LinearPicture picture;
  if (this->CollectPicture(picture, 1, reduction) && picture.Width > 0)
  {
    const double stops = vtkradiometry::FittingStops(picture);
    if (std::abs(stops - this->AutomaticStops) > 0.25 || this->MeasuredStops == 0.0)
    {
      this->MeasuredStops = std::round(4.0 * stops) / 4.0;
    }
  }
  return this->MeasuredStops;
}

//------------------------------------------------------------------------------
int vtkRadiometricView::CaptureLinear(const char* fileName)
{
  using namespace vtkradiometry;
  LinearPicture picture;
  if (!this->CollectPicture(picture, this->Samples, 1))
  {
    return 1;
  }
  if (!fileName || !*fileName)
  {
    vtkErrorMacro("no file to capture the picture to");
    return 0;
  }
  if (picture.Width <= 0)
  {
    vtkErrorMacro("no float picture to capture for '"
      << fileName << "': render the view first; the graphics driver must offer float frame "
      << "buffers, and all processes windows of one size");
    return 0;
  }
  try
  {
    CaptureNotes notes;
    notes.SourceColorSpace = this->GetSourceColorSpace();
    notes.Display = this->GetDisplay();
    notes.View = this->GetView();
    notes.Look = this->GetLook();
    notes.Exposure = this->GetUsedExposure();
    notes.Samples = this->Samples;
    WritePicture(fileName, picture, this->GetRenderer(), notes);
  }
  catch (const radiometry::io::FileError& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkRadiometricView::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Samples: " << this->Samples << "\n";
  os << indent << "Pass:\n";
  this->Pass->PrintSelf(os, indent.GetNextIndent());
}
