// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLAccumulation.h"

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
#include "vtkOpenGLState.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkProperty.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProperty.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"
#include "vtkTextureObject.h"
#include "vtkUniforms.h"

#include <cstring>
#include <iterator>
#include <stdexcept>

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
    this->Add(light);
    if (vtkMatrix4x4* matrix = light->GetTransformMatrix())
    {
      this->Add(matrix->GetData(), 16);
    }
  }

  for (int i = 0; i < state->GetPropArrayCount(); ++i)
  {
    vtkProp* prop = state->GetPropArray()[i];
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
}

//------------------------------------------------------------------------------
namespace
{
// Draws to a framebuffer of ours while this lives.
class BoundFramebuffer
{
public:
  BoundFramebuffer(vtkOpenGLState* state, vtkOpenGLFramebufferObject* framebuffer)
    : State(state)
  {
    state->PushFramebufferBindings();
    framebuffer->Bind();
    framebuffer->ActivateBuffer(0);
  }
  ~BoundFramebuffer() { this->State->PopFramebufferBindings(); }
  BoundFramebuffer(const BoundFramebuffer&) = delete;
  BoundFramebuffer& operator=(const BoundFramebuffer&) = delete;

private:
  vtkOpenGLState* State;
};

vtkIBLGL::Texture View(vtkOpenGLRenderWindow* window, vtkTextureObject* texture)
{
  return { window, texture->GetHandle(), [](GLuint) {} };
}
}

void vtkIBLAccumulation::Render(vtkRenderer* renderer, int samples, bool encoded,
  const std::function<vtkIBLStamp()>& stamp, const std::function<void(int firstSample)>& draw)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  std::array<int, 4> region{};
  renderer->GetTiledSizeAndOrigin(&region[2], &region[3], &region[0], &region[1]);
  const vtkIBLStamp now = stamp();
  if (this->WasSelected)
  {
    this->Last.ForgiveSelection(now);
    this->WasSelected = false;
  }
  if (this->Allocate(window, region) || !(this->Last == now))
  {
    this->Samples = 0;
  }
  float weight = 0.0f;
  if (this->Samples == 0 || this->Samples + samples <= MaximumSamples)
  {
    const BoundFramebuffer bound(window->GetState(), this->Frame);
    window->GetState()->vtkglDisable(GL_SCISSOR_TEST);
    window->GetState()->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    window->GetState()->vtkglDepthMask(GL_TRUE);
    window->GetState()->vtkglClearColor(0, 0, 0, 0); // for a renderer that draws over another's picture
    window->GetState()->vtkglClearDepth(1);
    window->GetState()->vtkglClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw(this->Samples);
    this->Samples += samples;
    weight = float(samples) / float(this->Samples);
  }
  this->Show(window, weight, encoded);
  // VTK makes things while it draws, and lights follow the camera: that is in this frame, and no change. Of a frame
  // that was called off, part is missing, so it is no beginning.
  this->Last = window->GetAbortRender() ? vtkIBLStamp() : stamp();
}

bool vtkIBLAccumulation::Allocate(vtkOpenGLRenderWindow* window, const std::array<int, 4>& region)
{
  GLint multisamples = 0;
  glGetIntegerv(GL_SAMPLES, &multisamples);
  if (this->Mean.IsIn(window) && multisamples == this->Multisamples && region == this->Region)
  {
    return false;
  }
  this->ReleaseGraphicsResources();
  this->Window = window;
  this->Multisamples = multisamples;
  this->Region = region;
  const int width = region[0] + region[2];
  const int height = region[1] + region[3];
  this->Frame->SetContext(window);
  window->GetState()->PushFramebufferBindings();
  const bool complete = this->Frame->PopulateFramebuffer(
    width, height, true, 1, VTK_FLOAT, true, 32, multisamples, window->GetStencilCapable() != 0);
  window->GetState()->PopFramebufferBindings();
  vtkIBLGL::CheckErrors("allocating a float framebuffer");
  if (!complete)
  {
    throw std::runtime_error("this driver does not draw to 32-bit floats; render without samples a pixel");
  }
  this->Program = vtkIBLGL::Program::Draw(window, "vtkIBLBackgroundVS.glsl", "vtkIBLAccumulationFS.glsl");
  this->NoVertices = vtkIBLGL::VertexArray::Make(window);
  this->Mean = vtkIBLGL::Texture::Image2D(window, width, height, GL_RGBA32F); // last: it says that all is there
  return true;
}

void vtkIBLAccumulation::Show(vtkOpenGLRenderWindow* window, float weight, bool encoded)
{
  using namespace vtkIBLGL;
  const Texture color = View(window, this->Frame->GetColorAttachmentAsTextureObject(0));
  const Texture depth = View(window, this->Frame->GetDepthAttachmentAsTextureObject());
  const Texture none;
  const BoundTexture frame(window, this->Multisamples ? none : color);
  const BoundTexture frameDepth(window, this->Multisamples ? none : depth);
  const BoundTexture frameSamples(window, this->Multisamples ? color : none);
  const BoundTexture frameDepthSamples(window, this->Multisamples ? depth : none);
  const BoundImage mean(0, this->Mean, 0, GL_READ_WRITE, GL_RGBA32F);
  this->Program.Set("frame", frame.GetUnit());
  this->Program.Set("frameDepth", frameDepth.GetUnit());
  this->Program.Set("frameSamples", frameSamples.GetUnit());
  this->Program.Set("frameDepthSamples", frameDepthSamples.GetUnit());
  this->Program.Set("sampleCount", this->Multisamples);
  this->Program.Set("weight", weight);
  this->Program.Set("decodingExponent", encoded ? 2.2f : 1.0f);

  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglColorMask colorMask(state);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  // As the camera leaves them, for whoever draws next.
  const auto [x, y, width, height] = this->Region;
  state->vtkglViewport(x, y, width, height);
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(x, y, width, height);

  DrawScreen(window, this->Program, this->NoVertices, GL_TRUE, GL_ALWAYS);
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
  CheckErrors("drawing the mean of frames");
}

void vtkIBLAccumulation::Read(vtkImageData* image) const
{
  const auto [x, y, width, height] = this->Region;
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_FLOAT, 4);
  glGetTextureSubImage(this->Mean.Id(), 0, x, y, 0, width, height, 1, GL_RGBA, GL_FLOAT,
    GLsizei(4 * sizeof(float) * image->GetNumberOfPoints()), image->GetScalarPointer());
  vtkIBLGL::CheckErrors("reading the mean of frames");
}

void vtkIBLAccumulation::ReleaseGraphicsResources()
{
  this->Frame->ReleaseGraphicsResources(this->Window);
  this->Mean = {};
  this->Program = {};
  this->NoVertices = {};
}
