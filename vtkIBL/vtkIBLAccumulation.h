// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The mean over frames of what a renderer shows, as long as nothing changes the picture but the samples that it is
// estimated with.
#pragma once

#include "vtkIBLGL.h"
#include "vtkIBLStamp.h"

#include "vtkNew.h"
#include "vtkOpenGLFramebufferObject.h"

#include <array>
#include <functional>

class vtkRenderer;

class vtkIBLAccumulation
{
public:
  static constexpr int MaximumSamples = 65536; // a pixel

  /// A pixel, in the mean.
  int GetSamples() const { return this->Samples; }

  /// Lets `draw` draw the renderer's part of the picture, from its clear on, with `samples` a pixel more, and shows the
  /// mean in the framebuffer that is bound, depth and all; the mean alone once it has all it may have. Starts anew when
  /// `stamp` is another one than after the last frame. `encoded`: colours are display-encoded, the mean is of radiance
  /// all the same. What is the same in every frame is shown as it was drawn, bit for bit.
  void Render(vtkRenderer* renderer, int samples, bool encoded, const std::function<vtkIBLStamp()>& stamp,
    const std::function<void(int firstSample)>& draw);

  /// A selection was drawn instead of a frame.
  void Selected() { this->WasSelected = true; }
  /// The next frame is the first.
  void Restart() { this->Last = {}; }

  /// The mean, not encoded: width x height x 1 float RGBA.
  void Read(vtkImageData* image) const;

  void ReleaseGraphicsResources();

private:
  bool Allocate(vtkOpenGLRenderWindow* window, const std::array<int, 4>& region);
  void Show(vtkOpenGLRenderWindow* window, float weight, bool encoded);

  vtkIBLStamp Last; // after the last frame
  int Samples = 0;
  bool WasSelected = false;
  std::array<int, 4> Region{}; // x, y, width, height in the framebuffer
  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  // As the window's own, so that all that draws finds its viewport in place and depth in the format that it copies.
  vtkNew<vtkOpenGLFramebufferObject> Frame;
  int Multisamples = 0;
  vtkIBLGL::Texture Mean;
  vtkIBLGL::Program Program;
  vtkIBLGL::VertexArray NoVertices;
};
