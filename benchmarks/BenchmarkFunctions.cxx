// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What runs on the CPU before the GPU's work, by Google Benchmark. No panel: there is nothing to trade against error.
#include "Benchmark.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLImageReader.h"
#include "vtkIBLLadder.h"
#include "vtkIBLRadianceImage.h"

#include <benchmark/benchmark.h>

#include <map>

namespace vtkIBLBenchmark
{
namespace
{
/// Hands Google Benchmark's runs over as rows.
class Collector : public benchmark::BenchmarkReporter
{
public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override
  {
    for (const Run& run : runs)
    {
      if (run.run_type == Run::RT_Iteration)
      {
        const double iterations = double(run.iterations);
        this->Samples[run.run_name.function_name].push_back(
          { run.real_accumulated_time / iterations, run.cpu_accumulated_time / iterations });
      }
    }
  }
  std::map<std::string, std::vector<Sample>> Samples;
};

void ReadFile(benchmark::State& state, const std::string& file)
{
  for (auto _ : state)
  {
    vtkNew<vtkIBLImageReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    benchmark::DoNotOptimize(reader->GetOutput()->GetScalarPointer());
  }
}

vtkIBLRadianceImage View(vtkImageData* panorama)
{
  return { static_cast<float*>(panorama->GetScalarPointer()), panorama->GetDimensions()[0],
    panorama->GetDimensions()[1], 1 };
}

void OnThisThread(int count, const std::function<void(int)>& body)
{
  for (int i = 0; i < count; ++i)
  {
    body(i);
  }
}

void Clean(benchmark::State& state, vtkImageData* panorama)
{
  vtkNew<vtkImageData> copy;
  copy->DeepCopy(panorama);
  vtkIBLRadianceImage image = View(copy);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(vtkIBLCleanRadiance(image));
  }
}

void MeanLuminance(benchmark::State& state, vtkImageData* panorama)
{
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(vtkIBLMeanLuminance(View(panorama)));
  }
}

void Harmonics(benchmark::State& state, vtkImageData* panorama, double roughness)
{
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(
      vtkIBLSpectrum(View(panorama), vtkIBLSpectrum::RequiredOrder(roughness), OnThisThread).GetCoefficients().data());
  }
}

void Filter(benchmark::State& state, vtkImageData* panorama, double roughness, int faceSize)
{
  const vtkIBLSpectrum spectrum(View(panorama), vtkIBLSpectrum::MaximumOrder, OnThisThread);
  std::vector<float> rgb(std::size_t(18) * faceSize * faceSize);
  for (auto _ : state)
  {
    spectrum.Filter({ { roughness, 1.0 } }, faceSize, 0, rgb.data(), OnThisThread);
    benchmark::DoNotOptimize(rgb.data());
  }
}

/// What is counted: from pixels to the texels of all layers of the default ladder. Not inlined: a counter is turned on
/// and off by its name.
__attribute__((noinline)) double CountSpectrum(const vtkIBLRadianceImage& image)
{
  const vtkIBLSpectrum spectrum(image, vtkIBLSpectrum::RequiredOrder(vtkIBLLadder::FirstRoughness), OnThisThread);
  double predictedError = 0;
  const vtkIBLLadder ladder = vtkIBLChooseLadder(spectrum, 0.02, 0.1, 1.0, predictedError, OnThisThread);
  double sum = 0;
  for (int layer = 1; layer <= ladder.GetNumberOfLayers(); ++layer)
  {
    const int n = ladder.GetLayerFaceSize(layer);
    std::vector<float> rgb(std::size_t(18) * (n + 2) * (n + 2));
    std::vector<std::uint16_t> texels(std::size_t(24) * n * n);
    spectrum.Filter(ladder.GetLobes(layer), n, 1, rgb.data(), OnThisThread);
    vtkIBLStoreLayer(rgb.data(), n, 1.0, true, texels.data(), OnThisThread);
    sum += texels.front();
  }
  return sum;
}
}

int RunSpectrum(const std::string& map)
{
  const Map loaded = LoadMap(map);
  double sum = 0;
  const Sample sample = Clock([&] { sum = CountSpectrum(View(loaded.Image)); });
  std::printf("%s: %.2f ms on one thread (%g)\n", map.c_str(), 1e3 * sample.Wall, sum);
  return 0;
}

void RunFunctions(Session& session)
{
  if (!session.Wants("function"))
  {
    return;
  }
  const Map& map = session.Maps.front();
  const std::pair<const char*, std::function<void(benchmark::State&)>> functions[] = {
    { "read the EXR file", [&](benchmark::State& state) { ReadFile(state, map.File); } },
    { "clean 1024 x 512", [&](benchmark::State& state) { Clean(state, map.Image); } },
    { "mean luminance", [&](benchmark::State& state) { MeanLuminance(state, map.Image); } },
    { "harmonics for roughness 0.1, 1 thread", [&](benchmark::State& state) { Harmonics(state, map.Image, 0.1); } },
    { "harmonics for roughness 0.25, 1 thread", [&](benchmark::State& state) { Harmonics(state, map.Image, 0.25); } },
    { "layer of roughness 0.1, 128^2, 1 thread", [&](benchmark::State& state) { Filter(state, map.Image, 0.1, 128); } },
    { "layer of roughness 0.25, 64^2, 1 thread", [&](benchmark::State& state) { Filter(state, map.Image, 0.25, 64); } },
  };
  for (const auto& [name, function] : functions)
  {
    benchmark::RegisterBenchmark(name, function)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MinTime(session.Options.Quick ? 0.02 : 0.1)
      ->Repetitions(session.Options.Repeat);
  }
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  for (const auto& [name, samples] : collector.Samples)
  {
    Row row("function", "vtkIBL", name, map.Name);
    row.Samples = samples;
    row.Default = true;
    session.Add(row);
  }
}
}
