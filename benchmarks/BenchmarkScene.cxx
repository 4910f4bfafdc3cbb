// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkScene.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLGLHeader.h"
#include "vtkIBLLighting.h"
#include "vtkIBLSpecularChain.h"

#include <vtkFramebufferPass.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderStepsPass.h>
#include <vtkTextureObject.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vtkIBLBenchmark
{
const std::vector<FrameEngine> FrameEngines = {
  { "VTK", "Phong", false, false, -1, nullptr },
  { "VTK", "PBR, no IBL", true, false, -1, nullptr },
  { "VTK", "PBR + IBL", true, true, -1, nullptr },
  { "vtkIBL", "spectral layers", true, false, 0, nullptr },
  { "vtkIBL", "spectral layers, lamps in them", true, false, 0,
    [](vtkIBLLighting* lighting) { lighting->BrightTexelsOff(); } },
  { "vtkIBL sampled", "sampled layers", true, false, 0,
    [](vtkIBLLighting* lighting) { lighting->GetSpecularChain()->SetEngine(vtkIBLSpecularChain::Sampled); } },
  { "vtkIBL per pixel", "16 samples a pixel", true, false, 16, nullptr },
  { "vtkIBL per pixel", "64 samples a pixel", true, false, 64, nullptr },
  { "vtkIBL per pixel", "1024 samples a pixel", true, false, 1024, nullptr },
  { "vtkIBL per pixel", "16384 samples a pixel", true, false, 16384, nullptr },
};

const FrameEngine& FindEngine(const std::string& setting)
{
  for (const FrameEngine& engine : FrameEngines)
  {
    if (setting == engine.Setting)
    {
      return engine;
    }
  }
  throw std::runtime_error("there is no engine " + setting);
}

Scene::Scene(const FrameEngine& engine, const Map& map, vtkPolyData* surface, int width, int height, bool fromFile)
  : Engine(engine)
{
  this->Window->SetSize(width, height);
  this->Window->AddRenderer(this->Renderer);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  this->Actor->SetMapper(mapper);
  if (engine.PBR)
  {
    this->GetProperty()->SetInterpolationToPBR();
  }
  else
  {
    this->GetProperty()->SetInterpolationToPhong();
  }
  this->Renderer->AddActor(this->Actor);
  if (engine.VTKLight)
  {
    this->Texture->SetInputData(map.Image);
    this->Texture->MipmapOn();
    this->Texture->InterpolateOn();
    this->Texture->SetColorModeToDirectScalars();
    this->Renderer->SetEnvironmentTexture(this->Texture, false);
    this->Renderer->UseImageBasedLightingOn();
    this->Renderer->AutomaticLightCreationOff();
  }
  if (engine.SamplesPerPixel >= 0)
  {
    vtkNew<vtkIBLEnvironment> environment;
    if (fromFile)
    {
      environment->SetFileName(map.File.c_str());
    }
    else
    {
      environment->SetInputData(map.Image);
    }
    this->Pass->SetEnvironment(environment);
    this->GetLighting()->SetSamplesPerPixel(engine.SamplesPerPixel);
    if (engine.SetUp)
    {
      engine.SetUp(this->GetLighting());
    }
    this->Renderer->SetPass(this->Pass);
    this->Renderer->AutomaticLightCreationOff();
  }
  this->Window->Initialize();
}

Scene::~Scene()
{
  this->Window->Finalize();
}

Sample Scene::Render()
{
  this->Window->MakeCurrent();
  glFinish();
  this->Pass->Modified(); // a sampled frame is the first of its mean, not one more
  return Clock(
    [&]
    {
      this->Window->Render();
      this->Window->MakeCurrent();
      glFinish();
    });
}

vtkSmartPointer<vtkImageData> Scene::Capture()
{
  if (this->Engine.SamplesPerPixel >= 0)
  {
    this->GetLighting()->EnergyCompensationOff();
    vtkSmartPointer<vtkImageData> image = this->Pass->CaptureRadiance(this->Renderer);
    while (this->Pass->GetAccumulatedSamples() < this->Engine.SamplesPerPixel)
    {
      image = this->Pass->CaptureRadiance(this->Renderer); // at most 8192 a frame
    }
    this->GetLighting()->EnergyCompensationOn();
    return image;
  }
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkFramebufferPass> framebuffer;
  framebuffer->SetColorFormat(vtkTextureObject::Float32);
  framebuffer->SetDelegatePass(steps);
  this->Renderer->SetPass(framebuffer);
  this->Window->Render();
  this->Window->MakeCurrent();
  vtkTextureObject* texture = framebuffer->GetColorTexture();
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(int(texture->GetWidth()), int(texture->GetHeight()), 1);
  image->AllocateScalars(VTK_FLOAT, 4);
  glGetTextureImage(texture->GetHandle(), 0, GL_RGBA, GL_FLOAT, GLsizei(4 * sizeof(float) * image->GetNumberOfPoints()),
    image->GetScalarPointer());
  framebuffer->ReleaseGraphicsResources(this->Window);
  this->Renderer->SetPass(nullptr);
  auto* value = static_cast<float*>(image->GetScalarPointer());
  std::transform(
    value, value + 4 * image->GetNumberOfPoints(), value, [](float x) { return std::pow(std::max(x, 0.0f), 2.2f); });
  return image;
}
}
