// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLSampledFilter.h"

#include "vtkIBLShaderFunctions.h"

#include "vtkOpenGLState.h"

#include <algorithm>
#include <cassert>
#include <deque>
#include <string>

namespace
{
// From alpha = 0.16 on, a cell of 16^2 a face is small beside the lobe, and 1536 lights leave 0.14 % at 0.18, 0.09 %
// above.
constexpr double RoughFrom = 0.4;
constexpr int LightGrid = 16;
// Light's mean direction is taken over as many texels a cell, along an edge: a ninth of the lobe that needs it most.
constexpr int TexelsOfCell = 8;
}

long long vtkIBLSampledFilter::Run(vtkOpenGLRenderWindow* window, const vtkIBLGL::Texture& source, double storedScale,
  const std::vector<Layer>& layers, int count)
{
  using namespace vtkIBLGL;
  assert(std::is_sorted(layers.begin(), layers.end(),
    [](const Layer& a, const Layer& b) { return a.PerceptualRoughness < b.PerceptualRoughness; }));
  if (!this->Prefilter)
  {
    this->Smooth = Program::Compute(window, "vtkIBLCubeSmoothCS.glsl");
    this->Lights = Program::Compute(window, "vtkIBLSpecularLightsCS.glsl");
    this->Rough = Program::Compute(window, "vtkIBLSpecularRoughCS.glsl");
    this->Prefilter = Program::Compute(window, "vtkIBLSpecularPrefilterCS.glsl");
  }
  vtkOpenGLState::ScopedglEnableDisable seamless(window->GetState(), GL_TEXTURE_CUBE_MAP_SEAMLESS);
  window->GetState()->vtkglEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);

  const auto made = std::find_if(layers.begin(), layers.end(), [](const Layer& layer) { return layer.IsMade; });
  const auto rough =
    std::find_if(layers.begin(), made, [](const Layer& layer) { return layer.PerceptualRoughness >= RoughFrom; });
  long long reads = this->MakeRough(window, source, storedScale, rough, made);
  if (rough != layers.begin())
  {
    const Texture smooth = this->MakeSmooth(window, source);
    for (auto layer = rough; layer != layers.begin();)
    {
      const Layer* tail = layer != layers.end() ? &*layer : nullptr;
      --layer;
      reads += this->MakeSharp(window, smooth, storedScale, *layer, tail, count);
    }
  }
  return reads;
}

long long vtkIBLSampledFilter::MakeRough(vtkOpenGLRenderWindow* window, const vtkIBLGL::Texture& source,
  double storedScale, Layers::const_iterator first, Layers::const_iterator last)
{
  using namespace vtkIBLGL;
  if (first == last)
  {
    return 0;
  }
  const int grid = std::min(LightGrid, source.GetWidth());
  const int lightCount = 6 * grid * grid;
  int level = 0;
  while (source.GetWidth(level) > TexelsOfCell * grid)
  {
    ++level;
  }
  const Buffer lights = Buffer::Make(window, lightCount * 2 * sizeof(glm::vec4), nullptr);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, lights.Id());
  {
    ActiveProgram active(window, this->Lights);
    BoundImage image(1, source, level, GL_READ_ONLY, GL_RGBA32F);
    this->Lights.Set("size", grid);
    DispatchTiles(grid, 6);
  }
  long long reads = 6LL * source.GetWidth(level) * source.GetWidth(level);

  const double pi = vtkIBLCore::ShaderFunctions<double>().iblPi;
  ActiveProgram active(window, this->Rough);
  this->Rough.Set("lightCount", lightCount);
  this->Rough.Set("radianceScale", float(1.0 / storedScale));
  while (first != last)
  {
    std::deque<BoundImage> targets; // they neither copy nor move
    int largest = 0;
    for (; first != last && targets.size() < IBL_ROUGH_LAYERS; ++first)
    {
      const auto index = targets.size();
      const double integral = vtkIBLLobeIntegral(first->PerceptualRoughness);
      this->Rough.Set(("lobes[" + std::to_string(index) + "]").c_str(),
        glm::vec2(vtkIBLLobeSharpness(first->PerceptualRoughness), 1.0 / (2.0 * pi * integral)));
      targets.emplace_back(GLuint(index), *first->Cube, first->Level, GL_WRITE_ONLY, GL_RGBA16F);
      const int size = first->Cube->GetWidth(first->Level);
      largest = std::max(largest, size);
      reads += 6LL * size * size * lightCount;
    }
    DispatchTiles(largest, 6 * int(targets.size()));
  }
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, 0);
  return reads;
}

vtkIBLGL::Texture vtkIBLSampledFilter::MakeSmooth(vtkOpenGLRenderWindow* window, const vtkIBLGL::Texture& source)
{
  using namespace vtkIBLGL;
  const int size = source.GetWidth();
  const int levels = CountMipLevels(size);
  Texture smooth = Texture::Cube(window, size, levels, GL_RGBA32F);
  glCopyImageSubData(
    source.Id(), GL_TEXTURE_CUBE_MAP, 0, 0, 0, 0, smooth.Id(), GL_TEXTURE_CUBE_MAP, 0, 0, 0, 0, size, size, 6);
  ActiveProgram active(window, this->Smooth);
  BoundTexture bound(window, smooth);
  this->Smooth.Set("source", bound.GetUnit());
  for (int level = 1; level < levels; ++level)
  {
    this->Smooth.Set("finerLevel", float(level - 1));
    BoundImage target(0, smooth, level, GL_WRITE_ONLY, GL_RGBA32F);
    DispatchTiles(size >> level, 6);
  }
  return smooth;
}

long long vtkIBLSampledFilter::MakeSharp(vtkOpenGLRenderWindow* window, const vtkIBLGL::Texture& smooth,
  double storedScale, const Layer& layer, const Layer* tail, int count)
{
  using namespace vtkIBLGL;
  const int size = layer.Cube->GetWidth(layer.Level);
  const Core& core = this->GetCore(
    window, layer.PerceptualRoughness, tail ? tail->PerceptualRoughness : 0.0, smooth.GetWidth(), size, count);
  BoundTexture source(window, smooth);
  BoundTexture rest(window, tail ? *tail->Cube : smooth);
  ActiveProgram active(window, this->Prefilter);
  this->Prefilter.Set("source", source.GetUnit());
  this->Prefilter.Set("tail", rest.GetUnit());
  this->Prefilter.Set("tailLevel", tail ? float(tail->Level) : 0.0f);
  this->Prefilter.Set("tailWeight", float(core.Table.TailWeight));
  this->Prefilter.Set("sampleCount", int(core.Table.Samples.size()));
  this->Prefilter.Set("radianceScale", float(1.0 / storedScale));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, core.Samples.Id());
  BoundImage target(0, *layer.Cube, layer.Level, GL_WRITE_ONLY, GL_RGBA16F);
  DispatchTiles(size, 6);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, 0);
  return 6LL * size * size * (static_cast<long long>(core.Table.Samples.size()) + 1);
}

const vtkIBLSampledFilter::Core& vtkIBLSampledFilter::GetCore(
  vtkOpenGLRenderWindow* window, double roughness, double tailRoughness, int sourceSize, int layerSize, int count)
{
  const auto found = std::find_if(this->Cores.begin(), this->Cores.end(),
    [=](const Core& core)
    {
      return core.Roughness == roughness && core.TailRoughness == tailRoughness && core.SourceSize == sourceSize &&
        core.LayerSize == layerSize && core.Count == count;
    });
  if (found != this->Cores.end())
  {
    return *found;
  }
  if (!this->Cores.empty() && (this->Cores.back().SourceSize != sourceSize || this->Cores.back().Count != count))
  {
    this->Cores.clear();
  }
  Core core{ roughness, tailRoughness, sourceSize, layerSize, count,
    vtkIBLMakeSampleTable(roughness, tailRoughness, sourceSize, layerSize, count), {} };
  core.Samples =
    vtkIBLGL::Buffer::Make(window, core.Table.Samples.size() * sizeof(glm::vec4), core.Table.Samples.data());
  this->Cores.push_back(std::move(core));
  return this->Cores.back();
}
