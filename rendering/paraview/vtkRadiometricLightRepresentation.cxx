// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiometricLightRepresentation.h"

#include "LightGlyphs.h"

#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkMapper.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODActor.h"
#include "vtkPVRenderView.h"
#include "vtkPhongGouraudMapper.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

vtkStandardNewMacro(vtkRadiometricLightRepresentation);

namespace
{

/// What each visible representation offers, by renderer, in an order that is the same on every rank:
/// that of the view's numbers for representations. Representations live and render in one thread.
using LightOwner = std::pair<unsigned int, vtkRadiometricLightRepresentation*>;
using Offers = std::map<LightOwner, vtkSmartPointer<vtkMultiBlockDataSet>>;
std::map<vtkRenderer*, Offers>& AllOffers()
{
  static std::map<vtkRenderer*, Offers> offers;
  return offers;
}

/// The polydata of a tree that the view's block settings show, or the data itself. Not every tree may
/// stand in a multi-block data set, hence one level.
vtkSmartPointer<vtkMultiBlockDataSet> ShownBlocks(
  vtkDataObject* data, vtkCompositeDataDisplayAttributes* attributes)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  auto* tree = vtkCompositeDataSet::SafeDownCast(data);
  if (!tree)
  {
    blocks->SetBlock(0, data);
    return blocks;
  }
  const bool byDefault = !attributes->HasBlockVisibility(tree) || attributes->GetBlockVisibility(tree);
  auto it = vtk::TakeSmartPointer(tree->NewIterator());
  for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
  {
    vtkDataObject* block = it->GetCurrentDataObject();
    if (attributes->HasBlockVisibility(block) ? attributes->GetBlockVisibility(block) : byDefault)
    {
      blocks->SetBlock(blocks->GetNumberOfBlocks(), block);
    }
  }
  return blocks;
}

/// Whether two lists of lights are the same objects, unchanged since the first was made.
bool Same(vtkMultiBlockDataSet* a, vtkMultiBlockDataSet* b)
{
  if (!a || !b || a->GetNumberOfBlocks() != b->GetNumberOfBlocks())
  {
    return a == b;
  }
  const vtkMTimeType made = a->vtkObject::GetMTime();
  for (unsigned int k = 0; k < a->GetNumberOfBlocks(); ++k)
  {
    if (a->GetBlock(k) != b->GetBlock(k) || a->GetBlock(k)->GetMTime() > made)
    {
      return false;
    }
  }
  return true;
}

void AddBounds(vtkDataObject* glyphs, vtkBoundingBox& bounds)
{
  auto* tree = vtkCompositeDataSet::SafeDownCast(glyphs);
  double box[6];
  if (auto* data = vtkDataSet::SafeDownCast(glyphs))
  {
    data->GetBounds(box);
    bounds.AddBounds(box);
  }
  else if (tree)
  {
    tree->GetBounds(box);
    bounds.AddBounds(box);
  }
}

/// An eighth of the height of the picture, at the distance of the camera's focal point.
double LegibleSize(vtkCamera* camera)
{
  const double half = camera->GetParallelProjection()
    ? camera->GetParallelScale()
    : camera->GetDistance() * std::tan(vtkMath::RadiansFromDegrees(camera->GetViewAngle() / 2.0));
  return 0.25 * half;
}

} // namespace

vtkRadiometricLightRepresentation::vtkRadiometricLightRepresentation() = default;

vtkRadiometricLightRepresentation::~vtkRadiometricLightRepresentation()
{
  this->Offer(this->OfferedTo, nullptr);
  for (auto& offers : AllOffers())
  {
    offers.second.erase({ this->GetUniqueIdentifier(), this }); // of renderers that are gone
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

void vtkRadiometricLightRepresentation::UpdateGlyphs(vtkDataObject* lights, double size)
{
  const vtkMTimeType time = lights ? lights->GetMTime() : 0;
  if (this->GlyphsOf != lights || this->GlyphsTime != time || this->GlyphsSize != size)
  {
    this->GlyphsOf = lights;
    this->GlyphsTime = time;
    this->GlyphsSize = size;
    this->Glyphs = vtkradiometry::MakeLightGlyphs(lights, size);
  }
  for (vtkMapper* mapper : { this->Mapper, this->LODMapper })
  {
    mapper->SetInputDataObject(this->Glyphs);
    mapper->SetScalarVisibility(true);
    mapper->SetScalarMode(VTK_SCALAR_MODE_USE_CELL_FIELD_DATA);
    mapper->SelectColorArray(vtkradiometry::LightGlyphColors);
    mapper->SetColorMode(VTK_COLOR_MODE_DIRECT_SCALARS);
    if (auto* composite = vtkPhongGouraudMapperBase::SafeDownCast(mapper))
    {
      this->PopulateBlockAttributes(composite->GetCompositeDataDisplayAttributes(), this->Glyphs);
    }
  }
}

void vtkRadiometricLightRepresentation::Offer(vtkRenderer* renderer, vtkMultiBlockDataSet* lights)
{
  if (!renderer || (this->OfferedTo == renderer && Same(this->Offered, lights)))
  {
    return;
  }
  Offers& offers = AllOffers()[renderer];
  const LightOwner owner{ this->GetUniqueIdentifier(), this };
  if (lights)
  {
    offers[owner] = lights;
  }
  else
  {
    offers.erase(owner);
  }
  this->OfferedTo = lights ? renderer : nullptr;
  this->Offered = lights;

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
    for (unsigned int k = 0; k < offer.second->GetNumberOfBlocks(); ++k)
    {
      together->SetBlock(together->GetNumberOfBlocks(), offer.second->GetBlock(k));
    }
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
    // Glyphs whose size follows the picture's may not decide what it shows (the view adds up its
    // bounds after this request), but compositing needs their bounds.
    this->Actor->SetUseBounds(false);
    vtkBoundingBox bounds;
    AddBounds(vtkradiometry::MakeLightGlyphs(vtkPVView::GetPiece(inInfo, this), this->GlyphSize),
      bounds); // none of glyphs whose size follows the picture's
    if (bounds.IsValid())
    {
      double box[6];
      bounds.GetBounds(box);
      vtkPVRenderView::SetGeometryBounds(inInfo, this, box);
    }
  }
  else if (request == vtkPVView::REQUEST_RENDER() && view)
  {
    vtkDataObject* lights = vtkPVView::GetDeliveredPiece(inInfo, this);
    vtkSmartPointer<vtkMultiBlockDataSet> shown;
    if (this->Illuminate && lights)
    {
      vtkNew<vtkCompositeDataDisplayAttributes> attributes;
      this->PopulateBlockAttributes(attributes, lights);
      shown = ShownBlocks(lights, attributes);
    }
    this->Offer(view->GetRenderer(), shown);
    const bool automatic = this->GlyphSize == 0.0;
    const double size = automatic ? LegibleSize(view->GetActiveCamera()) : this->GlyphSize;
    this->UpdateGlyphs(lights, this->ShowGlyphs ? size : 0.0);
    this->Actor->SetUseBounds(true);
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
  os << indent << "ShowGlyphs: " << this->ShowGlyphs << "\n";
  os << indent << "Illuminate: " << this->Illuminate << "\n";
}
