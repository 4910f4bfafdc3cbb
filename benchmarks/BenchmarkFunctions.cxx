// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What runs on the CPU before the GPU's work, by Google Benchmark. No panel: there is nothing to trade against error.
#include "Benchmark.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLImageReader.h"
#include "vtkIBLRadianceImage.h"
#include "vtkIBLSampleTable.h"

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

void Clean(benchmark::State& state, vtkImageData* panorama)
{
  vtkNew<vtkImageData> copy;
  copy->DeepCopy(panorama);
  vtkIBLRadianceImage image{ static_cast<float*>(copy->GetScalarPointer()), copy->GetDimensions()[0],
    copy->GetDimensions()[1], 1 };
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(vtkIBLCleanRadiance(image));
  }
}

void MeanLuminance(benchmark::State& state, vtkImageData* panorama)
{
  const vtkIBLRadianceImage image{ static_cast<float*>(panorama->GetScalarPointer()), panorama->GetDimensions()[0],
    panorama->GetDimensions()[1], 1 };
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(vtkIBLMeanLuminance(image));
  }
}

void SampleTable(benchmark::State& state)
{
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(vtkIBLMakeSampleTable(0.5, 256, 64, 512));
  }
}
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
    { "sample table 512", SampleTable },
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
