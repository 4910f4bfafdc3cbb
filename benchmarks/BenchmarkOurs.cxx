// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkIBL's own engines.
#include "Benchmark.h"

#include "vtkIBLBRDFTable.h"
#include "vtkIBLCubeMap.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLGL.h"
#include "vtkIBLIrradiance.h"
#include "vtkIBLLadder.h"
#include "vtkIBLLighting.h"
#include "vtkIBLSpecularChain.h"
#include "vtkIBLThreads.h"

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

constexpr int SpectralEngine = vtkIBLSpecularChain::Spectral;
constexpr int SampledEngine = vtkIBLSpecularChain::Sampled;

vtkSmartPointer<vtkIBLLighting> MakeLighting(vtkImageData* image, int engine, double setting)
{
  auto lighting = vtkSmartPointer<vtkIBLLighting>::New();
  vtkNew<vtkIBLEnvironment> environment;
  environment->SetInputData(image);
  lighting->SetEnvironment(environment);
  vtkIBLSpecularChain* chain = lighting->GetSpecularChain();
  chain->SetEngine(engine);
  if (engine == SpectralEngine)
  {
    chain->SetErrorTolerance(setting);
  }
  else
  {
    chain->SetNumberOfSamples(int(setting));
  }
  lighting->BrightTexelsOff(); // layers are judged with all light in them
  return lighting;
}

/// Brings `stage` up to date, its environment's pixels given anew: an environment keeps what was made of them. What is
/// left of the stage is not clocked.
Sample Rebuild(vtkIBLStage* stage, vtkIBLEnvironment* environment, vtkImageData* image, vtkOpenGLRenderWindow* window,
  vtkIBLStage* left = nullptr)
{
  if (environment)
  {
    environment->SetInputData(image);
    environment->Update();
  }
  if (left)
  {
    left->Update(window);
  }
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

/// All of it again, from pixels to textures. Programs stay compiled.
Sample RebuildAll(vtkIBLLighting* lighting, vtkImageData* image, vtkOpenGLRenderWindow* window,
  const vtkIBLSceneNeeds& needs = vtkIBLSceneNeeds::Everything())
{
  lighting->GetEnvironment()->SetInputData(image);
  lighting->GetBRDFTable()->Modified();
  return Clock(
    [&]
    {
      if (!lighting->Update(window, needs))
      {
        throw std::runtime_error("vtkIBLLighting made nothing");
      }
    });
}

vtkIBLSceneNeeds Mirrorless()
{
  vtkIBLSceneNeeds needs;
  needs.Irradiance = true;
  needs.AddRoughness(0.1, 1.0);
  return needs;
}

long long CountBytes(vtkIBLSpecularChain* chain)
{
  long long bytes = 0;
  for (int layer = 1; layer <= chain->GetNumberOfLayers(); ++layer)
  {
    bytes += chain->HasLayer(layer) * 6LL * chain->GetLayerFaceSize(layer) * chain->GetLayerFaceSize(layer) * 8;
  }
  return bytes; // RGBA16F
}

/// As vtkIBLLayers.glsl reads two layers, one in each chain. From roughness 0.1 up: the mirror is not among them.
std::vector<RGB> ReadLayers(
  vtkOpenGLRenderWindow* window, vtkIBLSpecularChain* chain, const std::vector<Vec3>& directions, double roughness)
{
  vtkIBLLadder ladder(chain->GetLayerFaceSize(1));
  ladder.EvenFaceSize = chain->GetLayerFaceSize(2);
  const double layer = ladder.GetLayer(roughness);
  const int below = std::clamp(int(std::floor(layer)), 1, ladder.GetNumberOfLayers() - 1);
  const auto read = [&](int i)
  {
    return ReadCubeMap(
      window, (i % 2 ? chain->GetOddLayers() : chain->GetEvenLayers()).Id(), directions, vtkIBLLadder::GetLevel(i));
  };
  std::vector<RGB> values = read(below);
  const std::vector<RGB> above = read(below + 1);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      values[i][k] = chain->GetStoredScale() * (values[i][k] + (layer - below) * (above[i][k] - values[i][k]));
    }
  }
  return values;
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
  auto lighting = MakeLighting(map.Image, SpectralEngine, 0.02);
  lighting->GetCubeMap()->SetFaceSize(faceSize);
  lighting->GetCubeMap()->SetMipLevelsNeeded(false); // as the spectral engine has it
  lighting->GetCubeMap()->Update(window);
  CubeWork work;
  work.Result = ToCube(lighting->GetCubeMap()->ReadLevel(0));
  work.Bytes = 96LL * work.Result.Size * work.Result.Size; // RGBA32F
  work.Run = [=, image = map.Image]
  { return Rebuild(lighting->GetCubeMap(), lighting->GetEnvironment(), image, window); };
  return work;
}

IrradianceWork MakeIrradianceMap(vtkOpenGLRenderWindow* window, const Map& map)
{
  auto lighting = MakeLighting(map.Image, SpectralEngine, 0.02);
  vtkIBLSpecularChain* chain = lighting->GetSpecularChain();
  chain->SetNeededRoughness(1, 0);
  chain->Update(window);
  IrradianceWork work;
  work.Read = [=](const std::vector<Vec3>& normals)
  {
    std::vector<RGB> values =
      ReadCubeMap(window, lighting->GetSpecularChain()->GetIrradianceMap().Id(), normals, 0); // over pi
    for (RGB& rgb : values)
    {
      std::transform(rgb.begin(), rgb.end(), rgb.begin(),
        [&](double x) { return vtkIBLReference::Pi * lighting->GetSpecularChain()->GetStoredScale() * x; });
    }
    return values;
  };
  work.Bytes = chain->GetLastBuildTexels() * 8; // RGBA16F
  work.Run = [=, image = map.Image]
  { return Rebuild(lighting->GetSpecularChain(), lighting->GetEnvironment(), image, window); };
  return work;
}

IrradianceWork MakeHarmonics(vtkOpenGLRenderWindow* window, const Map& map, int order, bool keepBrightTexels)
{
  auto irradiance = vtkSmartPointer<vtkIBLIrradiance>::New();
  vtkNew<vtkIBLEnvironment> environment;
  environment->SetInputData(map.Image);
  irradiance->SetEnvironment(environment);
  irradiance->SetOrder(order);
  irradiance->SetKeepBrightTexels(keepBrightTexels);
  irradiance->Update(window);
  IrradianceWork work;
  work.Read = [=](const std::vector<Vec3>& normals)
  {
    std::vector<RGB> values(normals.size());
    for (std::size_t i = 0; i < normals.size(); ++i)
    {
      irradiance->GetIrradiance(&normals[i].x, values[i].data());
    }
    return values;
  };
  work.Bytes = (irradiance->GetNumberOfCoefficients() * 3LL + irradiance->GetNumberOfBrightTexels() * 7LL) * 4;
  work.Run = [=, image = map.Image] { return Rebuild(irradiance, irradiance->GetEnvironment(), image, window); };
  return work;
}

LayersWork MakeLayers(vtkOpenGLRenderWindow* window, int engine, const Map& map, double setting)
{
  auto lighting = MakeLighting(map.Image, engine, setting);
  vtkIBLSpecularChain* chain = lighting->GetSpecularChain();
  chain->IrradianceNeededOff();
  chain->Update(window);
  LayersWork work;
  for (int layer = 1; engine == SampledEngine && layer <= chain->GetNumberOfLayers(); ++layer)
  {
    work.Layers.push_back({ chain->GetPerceptualRoughness(layer), ToCube(chain->ReadLayer(layer)) });
  }
  work.Read = [=](const std::vector<Vec3>& directions, double roughness)
  { return ReadLayers(window, lighting->GetSpecularChain(), directions, roughness); };
  work.Fetches = engine == SampledEngine ? chain->GetNumberOfReads() : -1;
  work.Bytes = CountBytes(chain);
  work.Run = [=, image = map.Image]
  {
    return Rebuild(lighting->GetSpecularChain(), lighting->GetEnvironment(), image, window,
      engine == SampledEngine ? lighting->GetCubeMap() : nullptr);
  };
  return work;
}

/// Layers are stored as what is read best; this is what they are made of.
std::vector<Layer> MakeFilter(const Map& map)
{
  const vtkIBLRadianceImage image{ static_cast<float*>(map.Image->GetScalarPointer()), map.Image->GetDimensions()[0],
    map.Image->GetDimensions()[1], 1 };
  const vtkIBLSpectrum spectrum(image, vtkIBLSpectrum::MaximumOrder, vtkIBLRunOnThreads);
  std::vector<Layer> layers;
  for (double roughness : { 0.1, 0.2, 0.3, 0.4, 0.6, 1.0 })
  {
    constexpr int n = 64;
    Layer layer{ roughness, { n, std::vector<float>(std::size_t(18) * n * n) } };
    spectrum.Filter({ { roughness, 1.0 } }, n, 0, layer.Texels.Texels.data(), vtkIBLRunOnThreads);
    layers.push_back(std::move(layer));
  }
  return layers;
}

TableWork MakeTable(vtkOpenGLRenderWindow* window, int samples)
{
  auto table = vtkSmartPointer<vtkIBLBRDFTable>::New();
  table->SetNumberOfSamples(samples);
  table->Update(window);
  vtkSmartPointer<vtkImageData> image = table->Read();
  TableWork work;
  work.Read = [image](double NoV, double roughness) { return ReadTable(image, NoV, roughness); };
  work.Bytes = 32LL * vtkIBLBRDFTable::Size * vtkIBLBRDFTable::Size; // two blocks of RGBA32F
  work.Run = [=] { return Rebuild(table, nullptr, nullptr, window); };
  return work;
}

Work MakeBake(vtkOpenGLRenderWindow* window, int engine, const Map& map, double setting, const vtkIBLSceneNeeds& needs)
{
  auto lighting = MakeLighting(map.Image, engine, setting);
  lighting->Update(window, needs);
  Work work;
  const long long size = lighting->GetCubeMap()->GetOutputFaceSize();
  work.Fetches = engine == SampledEngine ? lighting->GetSpecularChain()->GetNumberOfReads() : -1;
  work.Bytes = (lighting->GetCubeMap()->GetNumberOfLevels() > 1 ? 128 : 96) * size * size +
    8 * lighting->GetSpecularChain()->GetLastBuildTexels() + 16LL * vtkIBLBRDFTable::Size * vtkIBLBRDFTable::Size;
  work.Run = [=, image = map.Image] { return RebuildAll(lighting, image, window, needs); };
  return work;
}

std::function<Sample()> MakeGrowth(
  vtkOpenGLRenderWindow* window, int engine, double setting, vtkSmartPointer<vtkImageData> panorama, int faceSize)
{
  auto lighting = MakeLighting(panorama, engine, setting);
  lighting->GetCubeMap()->SetFaceSize(faceSize);
  lighting->GetSpecularChain()->SetFaceSize(faceSize);
  return [=] { return RebuildAll(lighting, panorama, window); };
}

/// What both engines can.
void AddChain(vtkOpenGLRenderWindow* window, int chainEngine, Engine& engine)
{
  engine.MakeLayers = [=](const Map& map, double setting) { return MakeLayers(window, chainEngine, map, setting); };
  engine.MakeBake = [=](const Map& map, double setting)
  { return MakeBake(window, chainEngine, map, setting, vtkIBLSceneNeeds::Everything()); };
  engine.MakeMirrorlessBake = [=](const Map& map, double setting)
  { return MakeBake(window, chainEngine, map, setting, Mirrorless()); };
  engine.MakeGrowth = [=, setting = engine.Settings.front()](vtkImageData* panorama, int faceSize)
  { return MakeGrowth(window, chainEngine, setting, panorama, faceSize); };
  engine.LargestGrowthSource = 8192;
  engine.LargestGrowthFace = 1024;
}
}

Engine MakeSpectral(Session& session)
{
  vtkOpenGLRenderWindow* window = session.Window;
  Engine engine;
  engine.Name = "vtkIBL";
  engine.Settings =
    session.Options.Quick ? std::vector<double>{ 0.02, 0.05 } : std::vector<double>{ 0.02, 0.05, 0.01, 0.005 };
  engine.TableSamples =
    session.Options.Quick ? std::vector<int>{ 0, 64 } : std::vector<int>{ 0, 16, 64, 256, 1024, 4096 };
  engine.LayerBound = 0.002;
  engine.ReadBound = 0.02;
  engine.TableBound = 0.005;
  engine.MakeCube = [=](const Map& map, int faceSize) { return MakeCube(window, map, faceSize); };
  engine.Irradiance = { { "map of 32^2 faces", [=](const Map& map) { return MakeIrradianceMap(window, map); } } };
  for (int order : { 2, 4, 8 })
  {
    for (bool keep : { false, true })
    {
      engine.Irradiance.push_back(
        { std::to_string((order + 1) * (order + 1)) + (keep ? " coefficients and bright texels" : " coefficients"),
          [=](const Map& map) { return MakeHarmonics(window, map, order, keep); } });
    }
  }
  engine.MakeFilter = MakeFilter;
  engine.MakeTable = [=](int samples) { return MakeTable(window, samples); };
  AddChain(window, SpectralEngine, engine);
  return engine;
}

Engine MakeSampled(Session& session)
{
  Engine engine;
  engine.Name = "vtkIBL sampled";
  engine.Settings = session.Options.Quick ? std::vector<double>{ 64 } : std::vector<double>{ 64, 32, 128, 512 };
  engine.LayerBound = 0.03;
  engine.ReadBound = 0.05;
  AddChain(session.Window, SampledEngine, engine);
  return engine;
}

/// The spectral engine by the number of threads; the first map.
void RunThreads(Session& session)
{
  if (!session.Wants("threads"))
  {
    return;
  }
  vtkOpenGLRenderWindow* window = session.Window;
  const Map& map = session.Maps.front();
  auto lighting = MakeLighting(map.Image, SpectralEngine, 0.02);
  auto rough = MakeLighting(map.Image, SpectralEngine, 0.02);
  rough->GetSpecularChain()->SetNeededRoughness(0.25, 1.0);
  rough->GetSpecularChain()->IrradianceNeededOff();
  const std::pair<const char*, std::function<Sample()>> works[] = {
    { "whole bake", [&] { return RebuildAll(lighting, map.Image, window); } },
    { "bake, no mirror", [&] { return RebuildAll(lighting, map.Image, window, Mirrorless()); } },
    { "layers, roughness 0.25 up",
      [&] { return Rebuild(rough->GetSpecularChain(), rough->GetEnvironment(), map.Image, window); } },
  };
  for (int threads : { 1, 2 })
  {
    vtkSMPTools::Initialize(threads);
    for (const auto& [name, run] : works)
    {
      Row row(
        "threads", "vtkIBL", name + (threads == 1 ? std::string(", 1 thread") : std::string(", 2 threads")), map.Name);
      run(); // warm-up
      row.Samples = Repeat(run, session.Options.Repeat, 6);
      row.Default = true;
      session.Add(row);
    }
  }
  vtkSMPTools::Initialize(0);
}
}
