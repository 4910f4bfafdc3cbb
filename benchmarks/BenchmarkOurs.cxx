// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkIBL's own engines.
#include "Benchmark.h"

#include "vtkIBLBRDFTable.h"
#include "vtkIBLCubeMap.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLGL.h"
#include "vtkIBLIrradiance.h"
#include "vtkIBLLighting.h"
#include "vtkIBLSampleTable.h"
#include "vtkIBLShaderFunctions.h"
#include "vtkIBLSpecularChain.h"

#include <algorithm>
#include <stdexcept>

namespace vtkIBLBenchmark
{
namespace
{
Cube ToCube(vtkImageData* image)
{
  Cube cube;
  cube.Size = image->GetDimensions()[0];
  const auto* rgb = static_cast<const float*>(image->GetScalarPointer());
  cube.Texels.assign(rgb, rgb + 3 * image->GetNumberOfPoints());
  return cube;
}

/// Builds `stage` again; what is left of it stands.
Sample Rebuild(vtkIBLStage* stage, vtkOpenGLRenderWindow* window)
{
  stage->Modified();
  return Clock(
    [&]
    {
      if (!stage->Update(window))
      {
        throw std::runtime_error(std::string(stage->GetClassName()) + " made nothing");
      }
    });
}

vtkSmartPointer<vtkIBLLighting> MakeLighting(vtkImageData* image)
{
  auto lighting = vtkSmartPointer<vtkIBLLighting>::New();
  vtkNew<vtkIBLEnvironment> environment;
  environment->SetInputData(image);
  lighting->SetEnvironment(environment);
  return lighting;
}

/// All of it again, from pixels to textures. Programs stay compiled.
Sample RebuildAll(vtkIBLLighting* lighting, vtkOpenGLRenderWindow* window)
{
  lighting->GetCubeMap()->Modified();
  lighting->GetIrradiance()->Modified();
  lighting->GetSpecularChain()->Modified();
  lighting->GetBRDFTable()->Modified();
  return Clock(
    [&]
    {
      if (!lighting->Update(window))
      {
        throw std::runtime_error("vtkIBLLighting made nothing");
      }
    });
}

long long CountFetches(vtkIBLLighting* lighting)
{
  vtkIBLSpecularChain* chain = lighting->GetSpecularChain();
  long long fetches = 0;
  for (int layer = 0; layer < vtkIBLSpecularChain::GetNumberOfLayers(); ++layer)
  {
    // The spectral engine samples the layer of 0.133 and sharper ones; that of 0.178 is its first.
    if (chain->GetEngine() == vtkIBLSpecularChain::Spectral &&
      vtkIBLSpecularChain::GetPerceptualRoughness(layer) > 0.15)
    {
      break;
    }
    const int size = chain->GetLayerFaceSize(layer);
    const vtkIBLSampleTable table = vtkIBLMakeSampleTable(vtkIBLSpecularChain::GetPerceptualRoughness(layer),
      lighting->GetCubeMap()->GetOutputFaceSize(), size, chain->GetNumberOfSamples());
    fetches += 6LL * size * size * static_cast<long long>(table.Samples.size());
  }
  return fetches;
}

long long CountBytes(vtkIBLSpecularChain* chain)
{
  long long bytes = 0;
  for (int layer = 0; layer < vtkIBLSpecularChain::GetNumberOfLayers(); ++layer)
  {
    bytes += 6LL * chain->GetLayerFaceSize(layer) * chain->GetLayerFaceSize(layer) * 8; // RGBA16F
  }
  return bytes;
}

/// As vtkIBLLayers.glsl reads two layers, one in each chain.
std::vector<RGB> ReadLayers(
  vtkOpenGLRenderWindow* window, vtkIBLSpecularChain* chain, const std::vector<Vec3>& directions, double roughness)
{
  const double last = vtkIBLSpecularChain::GetNumberOfLayers() - 1;
  const double layer =
    std::clamp(double(vtkIBLCore::ShaderFunctions<double>().iblLayerFromPerceptualRoughness(roughness)), 0.0, last);
  const double below = std::min(std::floor(layer), last - 1);
  const double evenLevel = std::floor(0.5 * (below + 1));
  const double oddLevel = std::floor(0.5 * below);
  const double share = 2 * evenLevel == below ? layer - below : 1 - layer + below;
  std::vector<RGB> even = ReadCubeMap(window, chain->GetEvenLayers().Id(), directions, evenLevel);
  const std::vector<RGB> odd = ReadCubeMap(window, chain->GetOddLayers().Id(), directions, oddLevel);
  for (std::size_t i = 0; i < even.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      even[i][k] = chain->GetStoredScale() * (even[i][k] + share * (odd[i][k] - even[i][k]));
    }
  }
  return even;
}

/// As vtkIBLLighting.glsl reads the table: sqrt(NoV) across, outer texel centres on the domain's edges.
SplitSum ReadTable(vtkImageData* table, double NoV, double roughness)
{
  const int last = vtkIBLBRDFTable::Size - 1;
  const double x = std::sqrt(NoV) * last;
  const double y = roughness * last;
  const int i = std::min(int(x), last - 1);
  const int j = std::min(int(y), last - 1);
  SplitSum sum{ 0, 0 };
  for (int n = 0; n < 4; ++n)
  {
    const double weight = (n % 2 ? x - i : 1 - x + i) * (n / 2 ? y - j : 1 - y + j);
    const auto* texel = static_cast<const float*>(table->GetScalarPointer(i + n % 2, j + n / 2, 0));
    sum.A += weight * texel[0];
    sum.B += weight * texel[1];
  }
  return sum;
}

CubeWork MakeCube(vtkOpenGLRenderWindow* window, const Map& map, int faceSize)
{
  auto lighting = MakeLighting(map.Image);
  lighting->GetCubeMap()->SetFaceSize(faceSize);
  lighting->GetCubeMap()->Update(window);
  CubeWork work;
  work.Result = ToCube(lighting->GetCubeMap()->ReadLevel(0));
  work.Bytes = 128LL * work.Result.Size * work.Result.Size; // RGBA32F with mip levels
  work.Run = [=] { return Rebuild(lighting->GetCubeMap(), window); };
  return work;
}

HarmonicsWork MakeHarmonics(vtkOpenGLRenderWindow* window, const Map& map)
{
  auto lighting = MakeLighting(map.Image);
  lighting->GetIrradiance()->Update(window);
  HarmonicsWork work;
  work.Irradiance = [=](Vec3 normal)
  {
    RGB rgb;
    lighting->GetIrradiance()->GetIrradiance(&normal.x, rgb.data());
    return rgb;
  };
  work.Fetches = map.Image->GetNumberOfPoints();
  work.Bytes = 9 * 3 * sizeof(float);
  work.Run = [=] { return Rebuild(lighting->GetIrradiance(), window); };
  return work;
}

LayersWork MakeLayers(vtkOpenGLRenderWindow* window, int engine, const Map& map, int samples)
{
  auto lighting = MakeLighting(map.Image);
  vtkIBLSpecularChain* chain = lighting->GetSpecularChain();
  chain->SetEngine(engine);
  chain->SetNumberOfSamples(samples);
  chain->Update(window);
  LayersWork work;
  for (int layer = 1; layer < vtkIBLSpecularChain::GetNumberOfLayers(); ++layer)
  {
    work.Layers.push_back({ vtkIBLSpecularChain::GetPerceptualRoughness(layer), ToCube(chain->ReadLayer(layer)) });
  }
  work.Read = [=](const std::vector<Vec3>& directions, double roughness)
  { return ReadLayers(window, lighting->GetSpecularChain(), directions, roughness); };
  work.Fetches = CountFetches(lighting);
  work.Bytes = CountBytes(chain);
  work.Run = [=] { return Rebuild(lighting->GetSpecularChain(), window); };
  return work;
}

TableWork MakeTable(vtkOpenGLRenderWindow* window, int samples)
{
  auto table = vtkSmartPointer<vtkIBLBRDFTable>::New();
  table->SetNumberOfSamples(samples);
  table->Update(window);
  vtkSmartPointer<vtkImageData> image = table->Read();
  TableWork work;
  work.Read = [image](double NoV, double roughness) { return ReadTable(image, NoV, roughness); };
  work.Bytes = 4LL * vtkIBLBRDFTable::Size * vtkIBLBRDFTable::Size; // RG16
  work.Run = [=] { return Rebuild(table, window); };
  return work;
}

Work MakeBake(vtkOpenGLRenderWindow* window, int engine, const Map& map, int samples)
{
  auto lighting = MakeLighting(map.Image);
  lighting->GetSpecularChain()->SetEngine(engine);
  lighting->GetSpecularChain()->SetNumberOfSamples(samples);
  lighting->Update(window);
  Work work;
  work.Fetches = CountFetches(lighting);
  const int size = lighting->GetCubeMap()->GetOutputFaceSize();
  work.Bytes = 128LL * size * size + CountBytes(lighting->GetSpecularChain()) +
    4LL * vtkIBLBRDFTable::Size * vtkIBLBRDFTable::Size;
  work.Run = [=] { return RebuildAll(lighting, window); };
  return work;
}

std::function<Sample()> MakeGrowth(vtkOpenGLRenderWindow* window, int engine, vtkImageData* panorama, int faceSize)
{
  auto lighting = MakeLighting(panorama);
  lighting->GetCubeMap()->SetFaceSize(faceSize);
  lighting->GetSpecularChain()->SetEngine(engine);
  if (faceSize > 0)
  {
    lighting->GetSpecularChain()->SetFaceSize(faceSize);
  }
  return [=] { return RebuildAll(lighting, window); };
}
/// What both engines can.
void AddChain(vtkOpenGLRenderWindow* window, int chainEngine, Engine& engine)
{
  engine.MakeLayers = [=](const Map& map, int samples) { return MakeLayers(window, chainEngine, map, samples); };
  engine.MakeBake = [=](const Map& map, int samples) { return MakeBake(window, chainEngine, map, samples); };
  engine.MakeGrowth = [=](vtkImageData* panorama, int faceSize)
  { return MakeGrowth(window, chainEngine, panorama, faceSize); };
  engine.LargestGrowthSource = 8192;
  engine.LargestGrowthFace = 1024;
}
}

Engine MakeSpectral(Session& session)
{
  vtkOpenGLRenderWindow* window = session.Window;
  Engine engine;
  engine.Name = "vtkIBL";
  engine.Samples = session.Options.Quick ? std::vector<int>{ 512 } : std::vector<int>{ 512, 64, 2048 };
  engine.TableSamples =
    session.Options.Quick ? std::vector<int>{ 0, 64 } : std::vector<int>{ 0, 16, 64, 256, 1024, 4096 };
  engine.LayerBound = 0.03;
  engine.TableBound = 0.005;
  engine.MakeCube = [=](const Map& map, int faceSize) { return MakeCube(window, map, faceSize); };
  engine.MakeHarmonics = [=](const Map& map) { return MakeHarmonics(window, map); };
  engine.MakeTable = [=](int samples) { return MakeTable(window, samples); };
  AddChain(window, vtkIBLSpecularChain::Spectral, engine);
  return engine;
}

Engine MakeSampled(Session& session)
{
  Engine engine;
  engine.Name = "vtkIBL sampled";
  engine.Samples =
    session.Options.Quick ? std::vector<int>{ 512, 64 } : std::vector<int>{ 512, 64, 128, 256, 1024, 4096 };
  engine.LayerBound = 0.07;
  AddChain(session.Window, vtkIBLSpecularChain::Sampled, engine);
  return engine;
}
}
