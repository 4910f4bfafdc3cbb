// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLAccumulation.h"

#include "vtkOpenGLState.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"

#include <stdexcept>

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
