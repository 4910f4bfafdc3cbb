// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLSpectrum.h"

#include "Reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <thread>
#include <vector>

namespace reference = vtkIBLReference;
using reference::Vec3;

namespace
{
const vtkIBLParallelFor Serial = [](int count, const std::function<void(int)>& body)
{
  for (int i = 0; i < count; ++i)
  {
    body(i);
  }
};

std::vector<float> Filter(
  const reference::Environment& environment, double roughness, int n, const vtkIBLParallelFor& parallelFor = Serial)
{
  std::vector<float> pixels(environment.rgb.begin(), environment.rgb.end());
  vtkIBLRadianceImage image;
  image.RGB = pixels.data();
  image.Width = environment.width;
  image.Height = environment.height;
  const vtkIBLSpectrum spectrum(image, vtkIBLSpectrum::RequiredOrder(roughness), parallelFor);
  std::vector<float> rgb(std::size_t(18) * n * n);
  spectrum.Filter({ { roughness, 1.0 } }, n, 0, rgb.data(), parallelFor);
  return rgb;
}

std::vector<Vec3> Directions(int n)
{
  std::vector<Vec3> directions;
  for (int texel = 0; texel < 6 * n * n; ++texel)
  {
    directions.push_back(
      reference::CubeDirection(texel / (n * n), 2 * (texel % n + 0.5) / n - 1, 2 * (texel / n % n + 0.5) / n - 1));
  }
  return directions;
}

// Relative L1 over all texels, against the converged integral.
double GetError(const reference::Environment& environment, double roughness, int n)
{
  const std::vector<float> rgb = Filter(environment, roughness, n);
  const auto truth = reference::PrefilterAll(environment, Directions(n), roughness);
  double difference = 0;
  double sum = 0;
  for (std::size_t i = 0; i < rgb.size(); ++i)
  {
    difference += std::abs(rgb[i] - truth[i / 3][i % 3]);
    sum += truth[i / 3][i % 3];
  }
  return difference / sum;
}

// Asymmetric in every way, bands up to a few dozen, all positive.
reference::Environment MakeSmooth(int width, int height)
{
  reference::Environment environment{ width, height, {} };
  for (int row = 0; row < height; ++row)
  {
    for (int column = 0; column < width; ++column)
    {
      const Vec3 d = reference::TexelDirection(environment, row, column);
      environment.rgb.push_back(
        1 + 0.5 * d.x + 3 * std::exp(20 * (reference::Dot(d, reference::Normalize({ 1, 2, -1 })) - 1)));
      environment.rgb.push_back(0.5 + d.y * d.y + 0.3 * d.z);
      environment.rgb.push_back(0.2 + 5 * std::exp(60 * (reference::Dot(d, reference::Normalize({ -2, -1, 1 })) - 1)));
    }
  }
  return environment;
}
}

// b_l of the clamped cosine at roughness 1: 1, 2/3, 1/4, 0, -1/24 (Ramamoorthi & Hanrahan 2001); of a narrow lobe
// nearly exp(-2 alpha l); and b_1 at any roughness is what the reference gives for L = 1 + cos. Mutants: alpha for
// alpha^2, no NoL, panels that miss the peak.
TEST(TestSpectrum, KernelBandsAreThoseOfGGX)
{
  const std::vector<double> cosine = vtkIBLSpectrum::KernelBands(1.0, 4);
  const double closed[] = { 1, 2.0 / 3, 1.0 / 4, 0, -1.0 / 24 };
  for (int l = 0; l <= 4; ++l)
  {
    EXPECT_NEAR(cosine[l], closed[l], 1e-12) << l;
  }
  const reference::Environment environment = reference::CosineEnvironment({ 0, 1, 0 }, 256, 128);
  for (double roughness : { 0.05, 0.2, 0.5, 0.8, 0.99999 })
  {
    const double b1 = reference::PrefilteredRadiance(environment, { 0, 1, 0 }, roughness)[0] - 1;
    EXPECT_NEAR(vtkIBLSpectrum::KernelBands(roughness, 1)[1], b1, 2e-4)
      << roughness; // texels blur the cosine by 1.2e-4
  }
  const std::vector<double> narrow = vtkIBLSpectrum::KernelBands(0.2, 100);
  EXPECT_NEAR(std::log(narrow[100] / narrow[50]) / 50, -2 * 0.04, 0.01);
}

// Against the converged integral, all texels: 3e-4 for a made-up sky; and panoramas of 1x1 up, odd sizes among them,
// which have more bands than texels: 5e-3, for their jumps at texel edges. Mutants: half a column's phase, a row upside
// down, the sinc left out, m's parity, one face's azimuth.
TEST(TestSpectrum, FiltersAsTheIntegralDoes)
{
  const reference::Environment sky = MakeSmooth(256, 128);
  for (double roughness : { 0.2, 0.3, 0.45, 0.7, 1.0 })
  {
    EXPECT_LT(GetError(sky, roughness, 8), 3e-4) << roughness;
  }
  for (auto [width, height] : { std::pair{ 1, 1 }, { 2, 1 }, { 6, 3 }, { 10, 5 }, { 16, 8 }, { 34, 17 } })
  {
    EXPECT_LT(GetError(MakeSmooth(width, height), 0.5, 6), 5e-3) << width << " x " << height;
  }
}

// One texel as bright as you like comes back as the exact lobe, wherever it is: on a pole, at the seam, in a corner. It
// is taken as a point, and is 2e-3 of the lobe's width: 1e-3. No ringing: nothing is darker than the background.
// Mutants: solid angle of the wrong row, the norm of the lobe.
TEST(TestSpectrum, GivesBackASunExactly)
{
  for (auto [row, column] : { std::pair{ 0, 3 }, { 127, 200 }, { 64, 0 }, { 64, 255 }, { 90, 32 } })
  {
    const reference::Environment sun =
      reference::OneTexelSun({ 1e6, 1e5, 2e6 }, row, column, 256, 128, { 0.1, 0.1, 0.1 });
    EXPECT_LT(GetError(sun, 0.4, 8), 1e-3) << row << " " << column;
    for (float x : Filter(sun, 0.4, 8))
    {
      EXPECT_GE(x, 0.1f * (1 - 1e-3f));
    }
  }
}

// Two suns side by side are one light from far away, and two near by: 1e-3 as above. Mutants: one light everywhere (8
// %); two of which one is forgotten.
TEST(TestSpectrum, TellsLampsApart)
{
  reference::Environment suns = reference::OneTexelSun({ 1e6, 1e5, 2e6 }, 140, 200, 512, 256, { 0.1, 0.1, 0.1 });
  const reference::Environment other = reference::OneTexelSun({ 2e5, 1e6, 1e6 }, 142, 200, 512, 256, { 0, 0, 0 });
  std::transform(suns.rgb.begin(), suns.rgb.end(), other.rgb.begin(), suns.rgb.begin(), std::plus<double>());
  EXPECT_LT(GetError(suns, 0.25, 32), 3e-3);
}

// The worst case for bands: every texel a random number. Mutants: an order of 2/alpha, a grid too coarse for it.
TEST(TestSpectrum, FiltersNoise)
{
  reference::Environment noise{ 256, 128, {} };
  unsigned int state = 1;
  for (int i = 0; i < 3 * 256 * 128; ++i)
  {
    state = state * 1664525u + 1013904223u;
    noise.rgb.push_back((state >> 8) / double(1 << 24));
  }
  for (double roughness : { 0.2, 0.3, 0.45 })
  {
    EXPECT_LT(GetError(noise, roughness, 12), 1e-4) << roughness;
  }
}

// A wide image is box-reduced: one whose texels come four by four gives what the small one gives. 1e-5: rounding.
// Mutants: a weight of the blocks' rows, a column off.
TEST(TestSpectrum, ReducesWideImages)
{
  const reference::Environment small = MakeSmooth(2048, 1024);
  reference::Environment wide{ 4096, 2048, {} };
  for (int row = 0; row < wide.height; ++row)
  {
    for (int column = 0; column < wide.width; ++column)
    {
      const double* texel = small.Texel(row / 2, column / 2);
      wide.rgb.insert(wide.rgb.end(), texel, texel + 3);
    }
  }
  const std::vector<float> a = Filter(small, 0.3, 8);
  const std::vector<float> b = Filter(wide, 0.3, 8);
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    ASSERT_NEAR(a[i], b[i], 1e-5 * a[i]) << i;
  }
}

// A constant stays that constant, black stays black.
TEST(TestSpectrum, KeepsAConstant)
{
  for (float x : Filter(reference::ConstantEnvironment({ 3, 3, 3 }, 64, 32), 0.3, 8))
  {
    EXPECT_NEAR(x, 3, 3e-5);
  }
  for (float x : Filter(reference::ConstantEnvironment({ 0, 0, 0 }, 64, 32), 0.3, 8))
  {
    EXPECT_EQ(x, 0.0f);
  }
}

// The same bits whatever the threads and their order. Mutant: a sum shared by threads.
TEST(TestSpectrum, IsDeterministic)
{
  const vtkIBLParallelFor threads = [](int count, const std::function<void(int)>& body)
  {
    std::vector<std::thread> pool;
    for (int t = 0; t < 3; ++t)
    {
      pool.emplace_back(
        [&, t]
        {
          for (int i = count - 1 - t; i >= 0; i -= 3)
          {
            body(i);
          }
        });
    }
    for (std::thread& thread : pool)
    {
      thread.join();
    }
  };
  const reference::Environment sky = MakeSmooth(128, 64);
  const std::vector<float> a = Filter(sky, 0.3, 16);
  const std::vector<float> b = Filter(sky, 0.3, 16, threads);
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(float)), 0);
}
