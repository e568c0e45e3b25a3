// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiometricLightRepresentation.h"

#include "LightGlyphs.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkMapper.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkPhongGouraudMapper.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <map>

vtkStandardNewMacro(vtkRadiometricLightRepresentation);

namespace
{

/// What each visible representation offers, by renderer. Representations live and render in one
/// thread.
using Offers = std::map<vtkRadiometricLightRepresentation*, vtkSmartPointer<vtkDataObject>>;
std::map<vtkRenderer*, Offers>& AllOffers()
{
  static std::map<vtkRenderer*, Offers> offers;
  return offers;
}

/// The polydata of a tree, or the data itself: not every tree may stand in a multi-block data set.
void AppendBlocks(vtkDataObject* data, vtkMultiBlockDataSet* blocks)
{
  auto* tree = vtkCompositeDataSet::SafeDownCast(data);
  if (!tree)
  {
    blocks->SetBlock(blocks->GetNumberOfBlocks(), data);
    return;
  }
  auto it = vtk::TakeSmartPointer(tree->NewIterator());
  for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
  {
    blocks->SetBlock(blocks->GetNumberOfBlocks(), it->GetCurrentDataObject());
  }
}

} // namespace

vtkRadiometricLightRepresentation::vtkRadiometricLightRepresentation() = default;

vtkRadiometricLightRepresentation::~vtkRadiometricLightRepresentation()
{
  this->Offer(this->OfferedTo, nullptr);
  for (auto& offers : AllOffers())
  {
    offers.second.erase(this); // of renderers that are gone
  }
}

void vtkRadiometricLightRepresentation::SetGlyphSize(double size)
{
  size = std::max(size, 0.0);
  if (this->GlyphSize != size)
  {
    this->GlyphSize = size;
    this->MarkModified(); // the bounds
  }
}

void vtkRadiometricLightRepresentation::UpdateGlyphs(vtkDataObject* lights)
{
  const vtkMTimeType time = lights ? lights->GetMTime() : 0;
  if (this->GlyphsOf == lights && this->GlyphsTime == time && this->GlyphsSize == this->GlyphSize)
  {
    return;
  }
  this->GlyphsOf = lights;
  this->GlyphsTime = time;
  this->GlyphsSize = this->GlyphSize;
  vtkradiometry::MakeLightGlyphs(lights, this->GlyphSize, this->Glyphs);
}

void vtkRadiometricLightRepresentation::Offer(vtkRenderer* renderer, vtkDataObject* lights)
{
  const vtkMTimeType time = lights ? lights->GetMTime() : 0;
  if (!renderer ||
    (this->OfferedTo == renderer && this->Offered == lights && this->OfferedTime == time))
  {
    return;
  }
  Offers& offers = AllOffers()[renderer];
  if (lights)
  {
    offers[this] = lights;
  }
  else
  {
    offers.erase(this);
  }
  this->OfferedTo = lights ? renderer : nullptr;
  this->Offered = lights;
  this->OfferedTime = time;

  vtkInformation* info = renderer->GetInformation();
  if (offers.empty())
  {
    AllOffers().erase(renderer);
    if (info)
    {
      info->Remove(vtkPhongGouraudMapper::LIGHT_DATA());
    }
    return;
  }
  vtkNew<vtkMultiBlockDataSet> together;
  for (const auto& offer : offers)
  {
    AppendBlocks(offer.second, together);
  }
  if (!info)
  {
    vtkNew<vtkInformation> made;
    renderer->SetInformation(made);
    info = made;
  }
  info->Set(vtkPhongGouraudMapper::LIGHT_DATA(), together);
}

int vtkRadiometricLightRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (!this->Superclass::ProcessViewRequest(request, inInfo, outInfo))
  {
    return 0;
  }
  auto* view = vtkPVRenderView::SafeDownCast(this->GetView());
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    // Every rank draws every surface under every light.
    vtkPVRenderView::SetDeliverToAllProcesses(inInfo, this, true);
    vtkNew<vtkPolyData> glyphs;
    vtkradiometry::MakeLightGlyphs(
      vtkPVView::GetPiece(inInfo, this), this->GlyphSize, glyphs);
    if (glyphs->GetNumberOfPoints() > 0)
    {
      vtkPVRenderView::SetGeometryBounds(inInfo, this, glyphs->GetBounds());
    }
  }
  else if (request == vtkPVView::REQUEST_RENDER() && view)
  {
    vtkDataObject* lights = vtkPVView::GetDeliveredPiece(inInfo, this);
    this->Offer(view->GetRenderer(), this->Illuminate ? lights : nullptr);
    this->UpdateGlyphs(lights);
    this->Mapper->SetInputDataObject(this->Glyphs);
    this->LODMapper->SetInputDataObject(this->Glyphs);
  }
  return 1;
}

void vtkRadiometricLightRepresentation::SetVisibility(bool visible)
{
  this->Superclass::SetVisibility(visible);
  if (!visible)
  {
    this->Offer(this->OfferedTo, nullptr);
  }
}

bool vtkRadiometricLightRepresentation::RemoveFromView(vtkView* view)
{
  this->Offer(this->OfferedTo, nullptr);
  return this->Superclass::RemoveFromView(view);
}

void vtkRadiometricLightRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "GlyphSize: " << this->GlyphSize << "\n";
  os << indent << "Illuminate: " << this->Illuminate << "\n";
}
