// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The samples of one sharp layer of the specular ladder: with the rougher layer that takes over, a quadrature rule for
// the lobe; and the level at which each reads its light.
#include "vtkIBLSampleTable.h"

#include "Reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace reference = vtkIBLReference;

namespace
{
const double Roughnesses[] = { 0.02, 0.1, 0.178, 0.32, 0.56, 0.75 };
constexpr double Ratio = 4.0 / 3.0; // to the rougher layer
constexpr int Count = 1 << 14;

// A source so fine that only a sample's own solid angle sets its level.
constexpr int Fine = 1 << 20;

// Integral of t^power K(t) over the cap of height s, even steps of log(c - t): K = t / (c - t)^2 / k^2 (Reference's
// form).
double CapMoment(double roughness, int power, double s = 1.0)
{
  const double alpha = std::min(roughness * roughness, 1.0 - 1e-6);  // the clamped cosine, to 1e-6
  const double excess = 2.0 * alpha * alpha / (1.0 - alpha * alpha); // c - 1
  const double k = (1.0 - alpha * alpha) / (1.0 + alpha * alpha);
  constexpr int steps = 100000;
  double moment = 0.0;
  for (int i = 0; i < steps; ++i)
  {
    const double q = excess * std::pow((s + excess) / excess, (i + 0.5) / steps);
    const double t = 1.0 + excess - q;
    moment += std::pow(t, power) * t / (q * k * k) * std::log((s + excess) / excess) / steps;
  }
  return moment;
}

double Mean(const vtkIBLSampleTable& table, int power)
{
  double sum = 0.0;
  for (const glm::vec4& sample : table.Samples)
  {
    sum += std::pow(double(sample.z), power);
  }
  return sum / table.Samples.size();
}
}

// The closed form of the lobe's integral against quadrature, over the hemisphere and over caps; 1/2 for the clamped
// cosine. 1e-7: the midpoint rule, 100,000 steps. The series takes over at k = 0.05, between 0.97 and 0.98. Mutants: k
// for k^2; a series one term short; 1 - k as a difference of floats.
TEST(SampleTable, LobeIntegralIsTheIntegral)
{
  for (double roughness : { 0.02, 0.1, 0.32, 0.75, 0.97, 0.98 })
  {
    for (double s : { 1e-6, 1e-3, 0.3, 1.0 })
    {
      EXPECT_NEAR(vtkIBLLobeIntegral(roughness, s) / CapMoment(roughness, 0, s), 1.0, 1e-7) << roughness << ", " << s;
    }
  }
  EXPECT_NEAR(vtkIBLLobeIntegral(1.0), 0.5, 1e-15);
  EXPECT_GT(vtkIBLLobeSharpness(0.97), 0.05);
  EXPECT_LT(vtkIBLLobeSharpness(0.98), 0.05);
}

// One sample straight up at roughness 0, read from the level that is as fine as the layer.
// Mutants: no floor; a level below 0 where the source is the smaller.
TEST(SampleTable, Mirror)
{
  const vtkIBLSampleTable table = vtkIBLMakeSampleTable(0.0, 0.1, 512, 128, 64);
  ASSERT_EQ(table.Samples.size(), 1u);
  EXPECT_EQ(table.Samples[0], glm::vec4(0, 0, 1, 2));
  EXPECT_EQ(table.TailWeight, 0.0);
  EXPECT_EQ(vtkIBLMakeSampleTable(0.0, 0.1, 64, 128, 64).Samples[0].w, 0.0f); // a source smaller than the layer
}

// Unit directions above the horizon, as many as asked for. Azimuths even out: their mean is below 2/sqrt(count) of a
// sine. Mutants: all azimuths the same.
TEST(SampleTable, IsASpiralOfUnitVectors)
{
  for (double roughness : Roughnesses)
  {
    for (int count : { 16, 64, 1024 })
    {
      const vtkIBLSampleTable table = vtkIBLMakeSampleTable(roughness, roughness * Ratio, Fine, Fine, count);
      ASSERT_EQ(table.Samples.size(), std::size_t(count));
      double x = 0.0, y = 0.0, sine = 0.0;
      for (const glm::vec4& sample : table.Samples)
      {
        EXPECT_NEAR(glm::length(glm::vec3(sample)), 1.0, 3e-7);
        EXPECT_GT(sample.z, 0.0f);
        x += sample.x;
        y += sample.y;
        sine += std::hypot(sample.x, sample.y);
      }
      EXPECT_LT(std::hypot(x, y), sine * 2.0 / std::sqrt(count)) << roughness << ", " << count;
    }
  }
}

// Samples and tail together have the lobe's mean and mean square of NoL; with no tail the samples have. 6e-5: samples
// moved inwards to make up for texels, less the more there are, 1.2e-4 with a quarter of these. Mutants: a tail's
// weight off by a tenth; Deblur four times too large; a tail that stays in the samples.
TEST(SampleTable, SamplesAndTailAreTheLobe)
{
  for (double roughness : Roughnesses)
  {
    const double tailRoughness = roughness * Ratio;
    const vtkIBLSampleTable table = vtkIBLMakeSampleTable(roughness, tailRoughness, Fine, Fine, Count);
    const vtkIBLSampleTable whole = vtkIBLMakeSampleTable(roughness, 0.0, Fine, Fine, Count);
    EXPECT_GT(table.TailWeight, 0.2);
    EXPECT_LT(table.TailWeight, 0.5);
    EXPECT_EQ(whole.TailWeight, 0.0);
    for (int power : { 1, 2 })
    {
      const auto exact = [power](double r) { return CapMoment(r, power) / CapMoment(r, 0); };
      const double w = table.TailWeight;
      EXPECT_NEAR((1.0 - w) * Mean(table, power) + w * exact(tailRoughness), exact(roughness), 6e-5)
        << roughness << ", " << power;
      EXPECT_NEAR(Mean(whole, power), exact(roughness), 6e-5) << roughness << ", " << power;
    }
  }
}

// The outermost of 64 samples lies far closer to N where a tail takes over: this is what makes 64 enough. Mutant: a
// tail that is weighed but not taken out of the samples.
TEST(SampleTable, TheTailMakesTheCoreNarrow)
{
  for (double roughness : { 0.02, 0.1, 0.178, 0.32 })
  {
    const auto widest = [](const vtkIBLSampleTable& table)
    {
      return std::acos(double(std::min_element(table.Samples.begin(), table.Samples.end(),
        [](const glm::vec4& a, const glm::vec4& b)
        { return a.z < b.z; })->z));
    };
    const double alone = widest(vtkIBLMakeSampleTable(roughness, 0.0, Fine, Fine, 64));
    const double core = widest(vtkIBLMakeSampleTable(roughness, roughness * Ratio, Fine, Fine, 64));
    EXPECT_LT(core, 0.7 * alone) << roughness;
  }
}

// Levels: a quarter finer than that whose texels have the solid angle of which a sample holds 1/count of the core, and
// none finer than the layer's texels or alpha/4. Solid angles come from where a sample's neighbours lie, not from the
// density. 3e-2: their difference's own error. Mutants: a kernel without t; 4 pi/6 for 4 (a texel at the centre is
// 4/n^2); no floor; a floor that a sharp lobe does not lower.
TEST(SampleTable, LevelsHoldTheSamplesSolidAngle)
{
  constexpr int count = 256;
  for (double roughness : { 0.1, 0.178, 0.32 })
  {
    const vtkIBLSampleTable fine = vtkIBLMakeSampleTable(roughness, roughness * Ratio, Fine, Fine, count);
    const vtkIBLSampleTable table = vtkIBLMakeSampleTable(roughness, roughness * Ratio, Fine, 64, count);
    const double floor = std::log2(Fine * std::min(1.0 / 64, roughness * roughness / 8));
    for (int i = 32; i < count - 32; ++i)
    {
      // Where they lay before they moved by a sixth of texel^2.
      const double texel2[] = { std::exp2(2.0 * fine.Samples[i - 1].w) * 4 / (double(Fine) * Fine),
        std::exp2(2.0 * fine.Samples[i + 1].w) * 4 / (double(Fine) * Fine) };
      const double inner = 1.0 - fine.Samples[i - 1].z + texel2[0] / 6;
      const double outer = 1.0 - fine.Samples[i + 1].z + texel2[1] / 6;
      const double solidAngle = reference::Pi * (outer - inner);
      const double level = 0.5 * std::log2(solidAngle / (4.0 / (double(Fine) * Fine))) - 0.25;
      EXPECT_NEAR(fine.Samples[i].w, level, 3e-2) << roughness << ", " << i;
      EXPECT_NEAR(table.Samples[i].w, std::max(level, floor), 3e-2) << roughness << ", " << i;
    }
  }
}
