// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The same light gives the same layers, whatever the threads and however often. (Files, read on threads, are in
// TestImageReader.)
#include "StressSupport.h"
#include "TestSupport.h"

#include "vtkIBLCubeConversion.h"
#include "vtkIBLCubeMap.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLHarmonics.h"
#include "vtkIBLLadder.h"
#include "vtkIBLSpecularChain.h"
#include "vtkIBLSpectrum.h"
#include "vtkIBLThreads.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <set>
#include <thread>

namespace reference = vtkIBLReference;

namespace
{
// Every texel by itself, and a few suns.
vtkSmartPointer<vtkImageData> MakeNoise()
{
  unsigned int state = 5;
  return MakePanorama(256,
    [&state](Vec3)
    {
      RGB rgb;
      for (double& value : rgb)
      {
        state = state * 1664525u + 1013904223u;
        value = (state >> 8) / double(1 << 24);
      }
      return state >> 20 == 7 ? RGB{ 1e4, 2e4, 1e5 } : rgb;
    });
}

// How many threads work at once.
std::size_t CountThreads()
{
  std::mutex mutex;
  std::set<std::thread::id> seen;
  vtkIBLRunOnThreads(64,
    [&](int)
    {
      {
        const std::lock_guard<std::mutex> lock(mutex);
        seen.insert(std::this_thread::get_id());
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
  return seen.size();
}
}

class TestDeterminismGL : public GLTest
{
protected:
  // All that a fresh start makes of the light, in a window of its own that was never rendered.
  std::vector<std::vector<float>> Bake(vtkImageData* light, int engine)
  {
    vtkNew<vtkIBLOffscreenWindow> window;
    vtkNew<vtkIBLEnvironment> environment;
    vtkNew<vtkIBLCubeMap> cubeMap;
    vtkNew<vtkIBLSpecularChain> chain;
    environment->SetInputData(light);
    cubeMap->SetEnvironment(environment);
    chain->SetCubeMap(cubeMap);
    chain->SetEngine(engine);
    EXPECT_TRUE(cubeMap->Update(window) && chain->Update(window));
    std::vector<std::vector<float>> made;
    const auto keep = [&made](vtkImageData* image)
    {
      const auto* values = static_cast<const float*>(image->GetScalarPointer());
      made.emplace_back(values, values + 3 * image->GetNumberOfPoints());
    };
    keep(cubeMap->ReadLevel(0));
    for (int layer = 1; layer <= chain->GetNumberOfLayers(); ++layer)
    {
      keep(chain->ReadLayer(layer));
    }
    keep(chain->ReadIrradianceMap());
    return made;
  }
  void TearDown() override
  {
    vtkSMPTools::Initialize(0);
    GLTest::TearDown();
  }
};

// The whole chain to the bit, with 1, 2 and, where there are cores, 8 threads of VTK. Mutant: a sum shared by threads.
TEST_F(TestDeterminismGL, ThreadsDoNotMatter)
{
  ASSERT_TRUE(vtkSMPTools::SetBackend("STDThread"));
  const auto light = MakeNoise();
  vtkSMPTools::Initialize(1);
  EXPECT_EQ(CountThreads(), 1u);
  const auto one = this->Bake(light, vtkIBLSpecularChain::Spectral);
  EXPECT_GE(one.size(), 8u);
  for (int threads : { 2, 8 })
  {
    vtkSMPTools::Initialize(threads);
    EXPECT_EQ(CountThreads(), std::min<std::size_t>(threads, std::thread::hardware_concurrency())); // VTK has no more
    for (int run = 0; run < StressCount(1); ++run)
    {
      const auto many = this->Bake(light, vtkIBLSpecularChain::Spectral);
      ASSERT_EQ(many.size(), one.size());
      for (std::size_t i = 0; i < one.size(); ++i)
      {
        ASSERT_EQ(many[i].size(), one[i].size());
        EXPECT_EQ(std::memcmp(many[i].data(), one[i].data(), one[i].size() * sizeof(float)), 0)
          << threads << " threads, image " << i;
      }
    }
  }
}

// VTK has no more threads than cores. With 1, 2 and 8, work going to them at random, each stage gives the same bits.
// Mutant seen to fail: a sum shared by threads in Measure().
TEST(TestDeterminism, StagesDoNotMindThreads)
{
  const auto light = MakeNoise();
  vtkIBLRadianceImage image;
  image.RGB = static_cast<float*>(light->GetScalarPointer());
  image.Width = 512;
  image.Height = 256;
  const auto hash = [&image](int threads)
  {
    const vtkIBLParallelFor parallelFor = [threads](int count, const std::function<void(int)>& body)
    {
      std::atomic<int> next{ 0 };
      std::vector<std::thread> pool;
      for (int t = 0; t < threads; ++t)
      {
        pool.emplace_back(
          [&]
          {
            for (int i = next++; i < count; i = next++)
            {
              body(count - 1 - i);
            }
          });
      }
      for (std::thread& thread : pool)
      {
        thread.join();
      }
    };
    std::vector<std::uint64_t> hashes;
    const auto keep = [&hashes](const auto& values)
    { hashes.push_back(reference::Hash(values.data(), values.size() * sizeof(values[0]))); };
    const int n = 64;
    std::vector<float> cube(18 * n * n), layer(18 * (n + 2) * (n + 2));
    vtkIBLConvertToCube(image, n, cube.data(), parallelFor);
    keep(cube);
    const vtkIBLSpectrum spectrum(image, vtkIBLSpectrum::MaximumOrder, parallelFor);
    keep(spectrum.GetCoefficients());
    keep(spectrum.GetBrightTexels());
    spectrum.Filter({ { 0.2, 1.0 } }, n, 1, layer.data(), parallelFor);
    keep(layer);
    std::vector<std::uint16_t> stored(24 * n * n);
    vtkIBLStoreLayer(layer.data(), n, 1.0, true, stored.data(), parallelFor);
    keep(stored);
    std::vector<double> numbers(3);
    const std::vector<double> bands = vtkIBLSpectrum::KernelBands(0.2, vtkIBLSpectrum::MaximumOrder);
    spectrum.Measure(bands, numbers[0], numbers[1], parallelFor);
    vtkIBLChooseLadder(spectrum, 0.02, 0.1, 1.0, numbers[2], parallelFor);
    keep(numbers);
    vtkIBLRadianceImage faces;
    faces.RGB = cube.data();
    faces.Width = faces.Height = n;
    faces.Faces = 6;
    keep(vtkIBLMakeHarmonics(faces, 8, parallelFor).RGB);
    return hashes;
  };
  const std::vector<std::uint64_t> one = hash(1);
  for (int run = 0; run < StressCount(2); ++run)
  {
    EXPECT_EQ(hash(2), one);
    EXPECT_EQ(hash(8), one);
  }
}

// From run to run, to one last digit of a half float: 2^-10 of the value, and 2^-24 of the mean (0.5 here) where halves
// have fewer digits. Measured: to the bit. Each in a fresh
// window. Mutant seen to fail: a stage that does not begin its window (it crashes).
TEST_F(TestDeterminismGL, RunsDoNotMatter)
{
  const auto light = MakeNoise();
  const auto first = this->Bake(light, vtkIBLSpecularChain::Sampled);
  double worst = 0;
  for (int run = 0; run < StressCount(3); ++run)
  {
    const auto again = this->Bake(light, vtkIBLSpecularChain::Sampled);
    ASSERT_EQ(again.size(), first.size());
    for (std::size_t i = 0; i < first.size(); ++i)
    {
      ASSERT_EQ(again[i].size(), first[i].size());
      for (std::size_t k = 0; k < first[i].size(); ++k)
      {
        const double ulp = std::max(std::ldexp(std::abs(double(first[i][k])), -10), std::ldexp(1.0, -24));
        worst = std::max(worst, std::abs(again[i][k] - first[i][k]) / ulp);
      }
    }
  }
  std::printf("  worst difference: %.2f half ulps\n", worst);
  EXPECT_LE(worst, 1);
}
