// SPDX-License-Identifier: BSD-3-Clause
#include "PropGroups.h"

#include "vtkPhongGouraudMapper.h"

#include "vtkActor.h"
#include "vtkNew.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"

#include <algorithm>

namespace vtkradiometry
{
namespace
{

/// The array of props that a renderer has in hand while it draws, which is its own and its
/// subclasses' business.
struct RendererProps : vtkRenderer
{
  static vtkProp**& Array(vtkRenderer* renderer) { return renderer->*(&RendererProps::PropArray); }
  static int& Count(vtkRenderer* renderer) { return renderer->*(&RendererProps::PropArrayCount); }
};

} // namespace

bool IsSceneLinear(vtkProp* prop)
{
  vtkNew<vtkPropCollection> actors;
  prop->GetActors(actors);
  vtkCollectionSimpleIterator it;
  actors->InitTraversal(it);
  bool any = false;
  while (vtkProp* part = actors->GetNextProp(it))
  {
    auto* actor = vtkActor::SafeDownCast(part);
    auto* mapper = actor ? vtkPhongGouraudMapper::SafeDownCast(actor->GetMapper()) : nullptr;
    // Points and lines are drawn by VTK, in a display's colours.
    if (!mapper || !mapper->GetSceneLinear() ||
      actor->GetProperty()->GetRepresentation() != VTK_SURFACE)
    {
      return false;
    }
    any = true;
  }
  return any;
}

PropGroups::PropGroups(const vtkRenderState* s, bool all)
{
  for (int i = 0; i < s->GetPropArrayCount(); ++i)
  {
    vtkProp* prop = s->GetPropArray()[i];
    this->All.push_back(prop);
    if (prop->IsA("vtkActor2D") || prop->IsA("vtkContextActor"))
    {
      this->Flat.push_back(prop);
      continue;
    }
    (all || IsSceneLinear(prop) ? this->Linear : this->Other).push_back(prop);
  }
}

bool PropGroups::LinearIsTranslucent() const
{
  return std::any_of(this->Linear.begin(), this->Linear.end(),
    [](vtkProp* prop) { return prop->HasTranslucentPolygonalGeometry() != 0; });
}

bool PropGroups::OtherIsOpaque() const
{
  return std::any_of(this->Other.begin(), this->Other.end(),
    [](vtkProp* prop) { return prop->HasOpaqueGeometry() != 0; });
}

bool PropGroups::OtherIsTranslucent() const
{
  return std::any_of(this->Other.begin(), this->Other.end(),
    [](vtkProp* prop) { return prop->HasTranslucentPolygonalGeometry() != 0; });
}

OnlyThese::OnlyThese(vtkRenderer* renderer, std::vector<vtkProp*>& props)
  : Renderer(renderer)
  , Props(RendererProps::Array(renderer))
  , Count(RendererProps::Count(renderer))
{
  RendererProps::Array(renderer) = props.data();
  RendererProps::Count(renderer) = static_cast<int>(props.size());
}

OnlyThese::~OnlyThese()
{
  RendererProps::Array(this->Renderer) = this->Props;
  RendererProps::Count(this->Renderer) = this->Count;
}

} // namespace vtkradiometry
