// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLStamp.h"

#include "vtkAbstractMapper.h"
#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkAlgorithm.h"
#include "vtkAssemblyPath.h"
#include "vtkCamera.h"
#include "vtkDataObject.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMapper.h"
#include "vtkMapper2D.h"
#include "vtkMatrix4x4.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkProperty.h"
#include "vtkRenderState.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkShaderProperty.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"
#include "vtkUniforms.h"

#include <cstring>
#include <iterator>

void vtkIBLStamp::Add(vtkObject* object)
{
  this->Add(reinterpret_cast<std::uintptr_t>(object));
  this->Add(object ? object->GetMTime() : 0);
}

void vtkIBLStamp::Add(const double* numbers, int count)
{
  const std::size_t end = this->Words.size();
  this->Words.resize(end + count);
  std::memcpy(&this->Words[end], numbers, count * sizeof(double));
}

void vtkIBLStamp::Add(const vtkIBLStamp& other)
{
  this->Words.insert(this->Words.end(), other.Words.begin(), other.Words.end());
}

void vtkIBLStamp::ForgiveSelection(const vtkIBLStamp& now)
{
  if (!this->Words.empty())
  {
    this->Words.front() = now.Words.front();
  }
}

// An algorithm's own time says nothing of what flows into it.
void vtkIBLStamp::AddWithInputs(vtkAlgorithm* algorithm)
{
  this->Add(algorithm);
  for (int port = 0; algorithm && port < algorithm->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < algorithm->GetNumberOfInputConnections(port); ++i)
    {
      algorithm->GetInputAlgorithm(port, i)->Update();
      this->Add(algorithm->GetInputDataObject(port, i));
    }
  }
}

void vtkIBLStamp::AddProperty(vtkProperty* property)
{
  this->Add(property);
  if (property)
  {
    for (const auto& texture : property->GetAllTextures())
    {
      this->AddWithInputs(texture.second);
    }
  }
}

void vtkIBLStamp::AddProp(vtkProp* prop)
{
  this->Add(prop->GetVisibility());
  if (!prop->GetVisibility())
  {
    return; // asking further would make what nobody sees
  }
  vtkShaderProperty* shader = prop->GetShaderProperty(); // made here, if need be: that changes the prop
  this->Add(shader->GetShaderMTime());
  this->Add(shader->GetVertexCustomUniforms());
  this->Add(shader->GetFragmentCustomUniforms());
  this->Add(shader->GetGeometryCustomUniforms());
  this->Add(prop);
  this->Add(prop->GetRedrawMTime());
  vtkAbstractMapper* mapper = nullptr;
  if (auto* actor = vtkActor::SafeDownCast(prop))
  {
    mapper = actor->GetMapper();
    this->AddProperty(actor->GetProperty());
    this->AddProperty(actor->GetBackfaceProperty());
    this->AddWithInputs(actor->GetTexture());
  }
  else if (auto* flat = vtkActor2D::SafeDownCast(prop))
  {
    mapper = flat->GetMapper();
    if (auto* text = vtkTextActor::SafeDownCast(prop))
    {
      this->Add(text->GetTextProperty()); // not in its time
    }
  }
  this->AddWithInputs(mapper);
  if (vtkPlaneCollection* planes = mapper ? mapper->GetClippingPlanes() : nullptr)
  {
    vtkCollectionSimpleIterator it;
    planes->InitTraversal(it);
    while (vtkPlane* plane = planes->GetNextPlane(it))
    {
      this->Add(plane);
    }
  }
}

void vtkIBLStamp::AddPropWithParts(vtkProp* prop)
{
  this->AddProp(prop);
  prop->InitPathTraversal();
  while (vtkAssemblyPath* path = prop->GetNextPath())
  {
    vtkAssemblyNode* leaf = path->GetLastNode();
    this->AddProp(leaf->GetViewProp());
    if (vtkMatrix4x4* matrix = leaf->GetMatrix())
    {
      this->Add(matrix->GetData(), 16);
    }
  }
}

void vtkIBLStamp::AddLight(vtkLight* light)
{
  this->Add(light);
  if (vtkMatrix4x4* matrix = light->GetTransformMatrix())
  {
    this->Add(matrix->GetData(), 16);
  }
}

vtkIBLStamp::vtkIBLStamp(const vtkRenderState* state)
{
  vtkRenderer* renderer = state->GetRenderer();
  this->Add(renderer->GetMTime());
  this->Add(reinterpret_cast<std::uintptr_t>(renderer));
  // Again, of what ForgiveSelection() would miss.
  this->Add(renderer->GetBackground(), 3);
  this->Add(renderer->GetBackground2(), 3);
  const double settings[] = { renderer->GetBackgroundAlpha(), double(renderer->GetGradientBackground()),
    double(renderer->GetTexturedBackground()), double(renderer->GetUseDepthPeeling()),
    double(renderer->GetMaximumNumberOfPeels()), double(renderer->GetUseFXAA()), double(renderer->GetUseShadows()),
    double(renderer->GetUseHiddenLineRemoval()), double(renderer->GetTwoSidedLighting()) };
  this->Add(settings, int(std::size(settings)));
  this->Add(renderer->GetAmbient(), 3);
  this->AddWithInputs(renderer->GetBackgroundTexture());
  this->Add(renderer->GetRenderWindow()->GetTileViewport(), 4);

  // Of the camera what it does, whatever brought that about.
  vtkCamera* camera = renderer->GetActiveCamera();
  this->Add(camera->GetModelViewTransformMatrix()->GetData(), 16);
  this->Add(camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1, 1)->GetData(), 16);
  const double view[] = { double(camera->GetParallelProjection()), camera->GetViewAngle() };
  this->Add(view, 2);

  vtkCollectionSimpleIterator it;
  renderer->GetLights()->InitTraversal(it);
  while (vtkLight* light = renderer->GetLights()->GetNextLight(it))
  {
    this->AddLight(light);
  }

  for (int i = 0; i < state->GetPropArrayCount(); ++i)
  {
    this->AddPropWithParts(state->GetPropArray()[i]);
  }
}
