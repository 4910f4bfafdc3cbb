// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The samples of one layer of the specular ladder: a quadrature rule for the lobe, and the level at which each reads
// its light.
#include "vtkIBLSampleTable.h"

#include "Reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace reference = vtkIBLReference;

namespace
{
const double Roughnesses[] = { 0.02, 0.1, 0.178, 0.32, 0.56, 0.75, 1.0 };
constexpr int MaximumSamples = 1024;

vtkIBLSampleTable Make(double roughness, int sourceSize = 512, int layerSize = 128)
{
  return vtkIBLMakeSampleTable(roughness, sourceSize, layerSize, MaximumSamples);
}

// Mean of f(z, x, y) over the table.
template <typename F>
double Mean(const vtkIBLSampleTable& table, F f)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < table.Samples.size(); ++i)
  {
    sum += table.Weights[i] * f(table.Samples[i]);
  }
  return sum;
}

// Mean of t^power under the lobe K(t) = t / (c - t)^2 of N = V = R, c = (1 + alpha^2) / (1 - alpha^2): even steps of
// log(c - t).
double LobeMoment(double alpha, int power)
{
  alpha = std::min(alpha, 1.0 - 1e-6);                               // the clamped cosine, to 1e-6
  const double excess = 2.0 * alpha * alpha / (1.0 - alpha * alpha); // c - 1
  double moment = 0.0;
  double total = 0.0;
  for (int i = 0; i < 100000; ++i)
  {
    const double q = excess * std::pow((1.0 + excess) / excess, (i + 0.5) / 100000), t = 1.0 + excess - q;
    moment += std::pow(t, power) * t / q;
    total += t / q;
  }
  return moment / total;
}

// What the outermost sample alone can do to a mean over the lobe.
double OutermostLever(const vtkIBLSampleTable& table)
{
  double lever = 0.0;
  for (std::size_t i = 0; i < table.Samples.size(); ++i)
  {
    lever = std::max(lever, table.Weights[i] * std::hypot(double(table.Samples[i].x), double(table.Samples[i].y)));
  }
  return lever;
}
}

// One sample straight up at roughness 0, read from the level that is as fine as the layer.
// Mutants: no floor; a level below 0 where the source is the smaller.
TEST(SampleTable, Mirror)
{
  const vtkIBLSampleTable table = Make(0.0);
  ASSERT_EQ(table.Samples.size(), 1u);
  EXPECT_EQ(table.Samples[0], glm::vec4(0, 0, 1, 2));
  EXPECT_EQ(table.Weights, std::vector<float>{ 1.0f });
  EXPECT_EQ(Make(0.0, 64, 128).Samples[0].w, 0.0f); // a source smaller than the layer
}

// Unit directions above the horizon, positive weights whose sum is 1: a constant environment stays what it is. 1e-6:
// weights are floats. The azimuths even out but for one sample, the outermost: the lobe points up. Mutants: weights
// divided by the count; samples below the horizon kept; azimuths over half a turn.
TEST(SampleTable, IsAMean)
{
  for (double roughness : Roughnesses)
  {
    const vtkIBLSampleTable table = Make(roughness);
    ASSERT_EQ(table.Samples.size(), table.Weights.size());
    EXPECT_NEAR(Mean(table, [](auto) { return 1.0; }), 1.0, 1e-6) << roughness;
    for (std::size_t i = 0; i < table.Samples.size(); ++i)
    {
      EXPECT_NEAR(glm::length(glm::vec3(table.Samples[i])), 1.0, 3e-7);
      EXPECT_GT(table.Samples[i].z, 0.0f);
      EXPECT_GT(table.Weights[i], 0.0f);
    }
    const double x = Mean(table, [](auto sample) { return sample.x; });
    const double y = Mean(table, [](auto sample) { return sample.y; });
    EXPECT_LE(std::hypot(x, y), OutermostLever(table)) << roughness;
  }
}

// Mean and mean square of NoL are the lobe's, so a cosine environment comes out right: both as the reference filters
// one and by the lobe's formula. A sample stands for 1/n of the half vectors; where that is less than the share alpha^2
// that the horizon cuts off, the midpoint rule is good to 3e-6, else the outermost sample stands for the tail. With
// 2^20 samples 1e-6 from roughness 0.1 on: nothing is left out for good. Mutants: weights without NoL; alpha = r; L at
// the half vector's own angle.
TEST(SampleTable, HasTheLobesMoments)
{
  for (double roughness : Roughnesses)
  {
    for (int power : { 1, 2 })
    {
      const auto moment = [power](auto sample) { return std::pow(double(sample.z), power); };
      const double exact = LobeMoment(roughness * roughness, power);
      const vtkIBLSampleTable table = Make(roughness);
      EXPECT_NEAR(Mean(table, moment), exact, roughness > 0.3 ? 3e-6 : OutermostLever(table))
        << roughness << ", " << power;
      if (roughness >= 0.1)
      {
        EXPECT_NEAR(Mean(vtkIBLMakeSampleTable(roughness, 512, 128, 1 << 20), moment), exact, 1e-6)
          << roughness << ", " << power;
      }
    }
    // 2e-4: the texels of that environment are 0.7 degrees wide.
    const reference::Vec3 up{ 0, 1, 0 };
    const double filtered =
      reference::PrefilteredRadiance(reference::CosineEnvironment(up, 512, 256), up, roughness)[0];
    EXPECT_NEAR(1.0 + LobeMoment(roughness * roughness, 1), filtered, 2e-4) << roughness;
  }
}

// As many samples as the angle of 99 % of the half vectors, tan = alpha sqrt(99), asks for, 64 at least, less those
// below the horizon, which are alpha^2 / (1 + alpha^2) of all. More with roughness. Mutants: no least count; the share
// squared.
TEST(SampleTable, CountGrowsWithTheLobe)
{
  double fewer = 0.0;
  for (double roughness : Roughnesses)
  {
    const double alpha = roughness * roughness;
    const double share = std::atan(alpha * std::sqrt(99.0)) / std::atan(std::sqrt(99.0));
    const double drawn = std::max(MaximumSamples * share, 64.0);
    EXPECT_NEAR(Make(roughness).Samples.size(), drawn / (1.0 + alpha * alpha), 1.5) << roughness;
    EXPECT_GE(drawn, fewer);
    fewer = drawn;
  }
  // Never more than asked for.
  for (int maximum : { 1, 8, 63 })
  {
    EXPECT_LE(vtkIBLMakeSampleTable(0.1, 512, 128, maximum).Samples.size(), std::size_t(maximum));
    EXPECT_GE(vtkIBLMakeSampleTable(0.1, 512, 128, maximum).Samples.size(), 1u);
  }
}

// Each sample reads the level whose texels have its own solid angle 1 / (n pdf), pdf = D / 4, and none finer than the
// layer's texels. 1e-5: directions and levels are floats. Mutants: pdf without the 4; n left out; no floor.
TEST(SampleTable, LevelsHoldTheSamplesSolidAngle)
{
  for (double roughness : Roughnesses)
  {
    const double alpha = roughness * roughness;
    for (int sourceSize : { 64, 512, 2048 })
    {
      const double texel = 4.0 * reference::Pi / (6.0 * sourceSize * sourceSize);
      const vtkIBLSampleTable table = Make(roughness, sourceSize, 128);
      const double share = std::atan(alpha * std::sqrt(99.0)) / std::atan(std::sqrt(99.0));
      const double drawn = std::max(std::round(MaximumSamples * share), 64.0);
      for (const glm::vec4& sample : table.Samples)
      {
        // Half the angle of L, from x and y: sin^2 of L is exact where it is small.
        const double sine2 = double(sample.x) * sample.x + double(sample.y) * sample.y;
        const double half2 = 0.5 * sine2 / (1.0 + sample.z);
        const double solidAngle = 4.0 / (drawn * reference::D_GGX(half2, alpha));
        const double level =
          std::max(0.5 * std::log2(solidAngle / texel), std::max(std::log2(sourceSize / 128.0), 0.0));
        ASSERT_NEAR(sample.w, level, 1e-5) << roughness << ", source " << sourceSize;
      }
    }
  }
}
