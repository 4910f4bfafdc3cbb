// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// A surface lit by a map alone, as each engine renders it: what steady and first frames time, and shading is judged by.
#pragma once

#include "Benchmark.h"

#include "vtkIBLRenderPass.h"

#include <vtkActor.h>
#include <vtkOpenGLTexture.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>

class vtkIBLLighting;

namespace vtkIBLBenchmark
{
struct FrameEngine
{
  const char* Name;
  const char* Setting;
  bool PBR;
  bool VTKLight;                  // VTK's own image-based lighting
  int SamplesPerPixel;            // of vtkIBLRenderPass; -1: none
  void (*SetUp)(vtkIBLLighting*); // what else is not as by default; may be null
  bool IsLit() const { return this->VTKLight || this->SamplesPerPixel >= 0; }
  /// At most a second a frame of 512^2.
  bool IsInteractive() const { return this->SamplesPerPixel <= 64; }
};
extern const std::vector<FrameEngine> FrameEngines;
const FrameEngine& FindEngine(const std::string& setting);

class Scene
{
public:
  Scene(const FrameEngine& engine, const Map& map, vtkPolyData* surface, int width, int height, bool fromFile = false);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  vtkCamera* GetCamera() { return this->Renderer->GetActiveCamera(); }
  vtkProperty* GetProperty() { return this->Actor->GetProperty(); }
  vtkIBLLighting* GetLighting() { return this->Pass->GetLighting(); }
  Sample Render();
  /// Linear radiance of single scattering, float RGBA: without our energy compensation, and VTK's own from its display
  /// encoding.
  vtkSmartPointer<vtkImageData> Capture();

private:
  const FrameEngine& Engine;
  vtkNew<vtkIBLOffscreenWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkOpenGLTexture> Texture;
  vtkNew<vtkIBLRenderPass> Pass;
};
}
