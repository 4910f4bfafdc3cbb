// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLSceneNeeds.h"

#include "vtkIBLBRDFTable.h"
#include "vtkIBLSpecularChain.h"

#include "vtkActor.h"
#include "vtkAssemblyPath.h"
#include "vtkProp.h"
#include "vtkProperty.h"

#include <algorithm>
#include <cmath>

void vtkIBLSceneNeeds::AddRoughness(double minimum, double maximum)
{
  this->MinimumRoughness = std::min(this->MinimumRoughness, minimum);
  this->MaximumRoughness = std::max(this->MaximumRoughness, maximum);
}

void vtkIBLSceneNeeds::Add(const vtkIBLSceneNeeds& other)
{
  this->Irradiance = this->Irradiance || other.Irradiance;
  this->RadianceCube = this->RadianceCube || other.RadianceCube;
  this->Metal = this->Metal || other.Metal;
  this->Dielectric = this->Dielectric || other.Dielectric;
  this->EdgeTint = this->EdgeTint || other.EdgeTint;
  this->AddRoughness(other.MinimumRoughness, other.MaximumRoughness);
}

bool vtkIBLSceneNeeds::NeedsMirror() const
{
  return this->MinimumRoughness < vtkIBLSpecularChain::GetFirstRoughness();
}

vtkIBLSceneNeeds vtkIBLSceneNeeds::Everything()
{
  vtkIBLSceneNeeds needs;
  needs.Irradiance = needs.Metal = needs.Dielectric = needs.EdgeTint = true;
  needs.AddRoughness(0.0, 1.0);
  return needs;
}

namespace
{
// Props that show no surface of PBR interpolation, ever.
bool IsNeverLit(vtkProp* prop)
{
  for (const char* kind : { "vtkActor2D", "vtkVolume", "vtkImageSlice", "vtkTextActor3D", "vtkBillboardTextActor3D" })
  {
    if (prop->IsA(kind))
    {
      return true;
    }
  }
  return false;
}

// A boundary of that roughness reads layers from the narrowest of its fitted lobes up.
void AddLobes(vtkIBLSceneNeeds& needs, double narrow, double wide)
{
  needs.AddRoughness(vtkIBLBRDFTable::GetNarrowestLobe(narrow), wide);
}

vtkIBLSceneNeeds OfActor(vtkActor* actor, bool nonPBR)
{
  vtkIBLSceneNeeds needs;
  vtkProperty* property = actor->GetProperty();
  const bool isPBR = property->GetInterpolation() == VTK_PBR;
  if (!property->GetLighting() || (!isPBR && !nonPBR))
  {
    return needs;
  }
  needs.Irradiance = true;
  const bool textured = property->GetTexture("materialTex") != nullptr;
  needs.Metal = isPBR && (textured || property->GetMetallic() > 0.0);
  needs.Dielectric = !isPBR || textured || property->GetMetallic() < 1.0;
  const double* edgeTint = property->GetEdgeTint();
  needs.EdgeTint = needs.Metal && std::any_of(edgeTint, edgeTint + 3, [](double tint) { return tint != 1.0; });
  if (!isPBR)
  {
    if (property->GetSpecular() > 0.0)
    {
      const double roughness = std::pow(2.0 / (property->GetSpecularPower() + 2.0), 0.25);
      AddLobes(needs, roughness, roughness);
    }
    return needs;
  }
  if (textured)
  {
    needs.AddRoughness(0.0, 1.0);
  }
  else if (property->GetMetallic() > 0.0 || property->GetBaseIOR() != 1.0)
  {
    // An anisotropic lobe is made of narrower ones: its alpha times the aspect (VTK's, after Burley 2012).
    const double aspect = std::sqrt(1.0 - 0.9 * std::clamp(property->GetAnisotropy(), 0.0, 1.0));
    AddLobes(needs, property->GetRoughness() * std::sqrt(aspect), property->GetRoughness());
  }
  if (property->GetCoatStrength() > 0.0)
  {
    AddLobes(needs, property->GetCoatRoughness(), property->GetCoatRoughness());
  }
  return needs;
}
}

vtkIBLSceneNeeds vtkIBLSceneNeeds::Of(vtkProp* const* props, int count, bool nonPBR)
{
  vtkIBLSceneNeeds needs;
  for (int i = 0; i < count; ++i)
  {
    if (!props[i]->GetVisibility() || IsNeverLit(props[i]))
    {
      continue;
    }
    props[i]->InitPathTraversal();
    while (vtkAssemblyPath* path = props[i]->GetNextPath())
    {
      vtkProp* leaf = path->GetLastNode()->GetViewProp();
      auto* actor = vtkActor::SafeDownCast(leaf);
      needs.Add(actor ? OfActor(actor, nonPBR) : IsNeverLit(leaf) ? vtkIBLSceneNeeds() : Everything());
    }
  }
  return needs;
}
