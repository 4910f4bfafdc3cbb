// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLSceneNeeds.h"

#include "vtkActor.h"
#include "vtkAssemblyPath.h"
#include "vtkProp.h"
#include "vtkProperty.h"

#include <algorithm>

void vtkIBLSceneNeeds::AddRoughness(double minimum, double maximum)
{
  this->MinimumRoughness = std::min(this->MinimumRoughness, minimum);
  this->MaximumRoughness = std::max(this->MaximumRoughness, maximum);
}

void vtkIBLSceneNeeds::Add(const vtkIBLSceneNeeds& other)
{
  this->Irradiance = this->Irradiance || other.Irradiance;
  this->AddRoughness(other.MinimumRoughness, other.MaximumRoughness);
}

vtkIBLSceneNeeds vtkIBLSceneNeeds::Everything()
{
  vtkIBLSceneNeeds needs;
  needs.Irradiance = true;
  needs.AddRoughness(0.0, 1.0);
  return needs;
}

namespace
{
vtkIBLSceneNeeds OfActor(vtkActor* actor)
{
  vtkIBLSceneNeeds needs;
  vtkProperty* property = actor->GetProperty();
  if (property->GetInterpolation() != VTK_PBR || !property->GetLighting())
  {
    return needs;
  }
  needs.Irradiance = true;
  if (property->GetTexture("materialTex"))
  {
    needs.AddRoughness(0.0, 1.0);
  }
  else if (property->GetMetallic() > 0.0 || property->GetBaseIOR() != 1.0)
  {
    needs.AddRoughness(property->GetRoughness(), property->GetRoughness());
  }
  return needs;
}
}

vtkIBLSceneNeeds vtkIBLSceneNeeds::Of(vtkProp* const* props, int count)
{
  vtkIBLSceneNeeds needs;
  for (int i = 0; i < count; ++i)
  {
    if (!props[i]->GetVisibility() || props[i]->IsA("vtkActor2D") || props[i]->IsA("vtkVolume"))
    {
      continue;
    }
    props[i]->InitPathTraversal();
    while (vtkAssemblyPath* path = props[i]->GetNextPath())
    {
      vtkProp* leaf = path->GetLastNode()->GetViewProp();
      auto* actor = vtkActor::SafeDownCast(leaf);
      needs.Add(actor ? OfActor(actor) : leaf->IsA("vtkVolume") ? vtkIBLSceneNeeds() : Everything());
    }
  }
  return needs;
}
