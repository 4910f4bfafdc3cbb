// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLLadder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
const vtkIBLParallelFor Serial = [](int count, const std::function<void(int)>& body)
{
  for (int i = 0; i < count; ++i)
  {
    body(i);
  }
};

// IEEE 754 binary16, written apart from the product.
double FromHalf(std::uint16_t half)
{
  const int exponent = (half >> 10) & 31, mantissa = half & 1023;
  return exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
}
}

// Two layers a halving, down to 8^2: sizes, levels, and roughness both ways. Mutants: the even chain as large as the
// odd one, a level too many.
TEST(TestLadder, Shape)
{
  for (auto [size, layers] : { std::pair{ 16, 2 }, { 128, 8 }, { 256, 10 }, { 1024, 14 } })
  {
    const vtkIBLLadder ladder(size);
    EXPECT_EQ(ladder.GetNumberOfLayers(), layers);
    EXPECT_EQ(ladder.GetLayerFaceSize(1), size);
    EXPECT_EQ(ladder.GetLayerFaceSize(2), size / 2);
    EXPECT_EQ(ladder.GetLayerFaceSize(layers), 8);
    EXPECT_EQ(vtkIBLLadder::GetLevel(layers), ladder.GetNumberOfLevels() - 1);
    for (int layer = 1; layer <= layers; ++layer)
    {
      const int base = layer % 2 ? size : size / 2;
      EXPECT_EQ(base >> vtkIBLLadder::GetLevel(layer), ladder.GetLayerFaceSize(layer));
      EXPECT_NEAR(ladder.GetLayer(ladder.GetPerceptualRoughness(layer)), layer, 1e-12);
    }
    // Halfway to twice the size, even layers are as large as odd ones.
    const vtkIBLLadder finer = ladder.Refined();
    EXPECT_EQ(finer.GetNumberOfLayers(), layers + 2);
    EXPECT_EQ(finer.GetLayerFaceSize(1), size);
    EXPECT_EQ(finer.GetLayerFaceSize(2), size);
    EXPECT_EQ(finer.GetLayerFaceSize(layers + 2), 8);
    EXPECT_EQ(finer.Refined().FaceSize, 2 * size);
    EXPECT_EQ(finer.Refined().EvenFaceSize, size);
    EXPECT_NEAR(ladder.GetPerceptualRoughness(1), vtkIBLLadder::FirstRoughness, 1e-15);
    EXPECT_EQ(ladder.GetPerceptualRoughness(layers), 1);
  }
}

// The layers that bracket a range. 8 layers: 0.1 0.139 0.193 0.268 0.373 0.518 0.720 1. Mutants: floor for ceil.
TEST(TestLadder, LayersOfARange)
{
  const vtkIBLLadder ladder; // 128
  const auto layers = [&](double minimum, double maximum)
  {
    int first, last;
    ladder.GetLayers(minimum, maximum, first, last);
    return std::pair{ first, last };
  };
  EXPECT_EQ(layers(0, 1), (std::pair{ 0, 8 }));
  EXPECT_EQ(layers(0.4, 0.6), (std::pair{ 5, 7 }));
  EXPECT_EQ(layers(0.3, 0.3), (std::pair{ 4, 5 }));
  EXPECT_EQ(layers(0.05, 0.05), (std::pair{ 0, 1 }));
  EXPECT_EQ(layers(0, 0), (std::pair{ 0, 1 })); // a digit may be lost on the way to the shader
  EXPECT_EQ(layers(1, 1), (std::pair{ 7, 8 }));
}

// What is stored has the weight of the lobe itself, or constants would not stay; and mixing two neighbours halfway
// gives the true lobe's bands with half the error of plain layers. Mutants: a twelfth for a sixth, the wrong sign.
TEST(TestLadder, LobesHalveTheErrorOfMixing)
{
  const vtkIBLLadder ladder(256);
  constexpr int order = 64;
  const auto plain = [&](double layer)
  { return vtkIBLSpectrum::KernelBands(ladder.GetPerceptualRoughness(layer), order); };
  const auto stored = [&](int layer)
  {
    std::vector<double> sum(order + 1, 0.0);
    double weights = 0;
    for (const vtkIBLLobe& lobe : ladder.GetLobes(layer))
    {
      const auto bands = vtkIBLSpectrum::KernelBands(lobe.PerceptualRoughness, order);
      for (int l = 0; l <= order; ++l)
      {
        sum[l] += lobe.Weight * bands[l];
      }
      weights += lobe.Weight;
    }
    EXPECT_NEAR(weights, 1, 1e-12);
    return sum;
  };
  double plainError = 0, storedError = 0;
  for (int below = 4; below < 9; ++below)
  {
    const auto truth = plain(below + 0.5), a = plain(below), b = plain(below + 1), sa = stored(below),
               sb = stored(below + 1);
    for (int l = 1; l <= order; ++l)
    {
      plainError += std::abs(0.5 * (a[l] + b[l]) - truth[l]);
      storedError += std::abs(0.5 * (sa[l] + sb[l]) - truth[l]);
    }
  }
  EXPECT_LT(storedError, 0.5 * plainError);
  EXPECT_EQ(ladder.GetLobes(1).size(), 1u);
  EXPECT_EQ(ladder.GetLobes(10).size(), 1u);
}

// Half floats: to the nearest, ties to even, denormals, cut at 65504, never negative; the border is skipped, alpha
// is 1. Mutants: truncation, 2^-14 as a denormal's border off by one, a border of none.
TEST(TestLadder, StoresHalfFloats)
{
  constexpr int n = 2;
  const float values[] = { 0.0f, 1.0f, 1.0f + 1.0f / 2048, 1.0f + 3.0f / 2048, 65504.0f, 1e9f, 5.96e-8f, 2.9e-8f,
    6.1e-5f, 6.2e-5f, 0.333f, -1.0f };
  for (float value : values)
  {
    std::vector<float> rgb(std::size_t(18) * (n + 2) * (n + 2), 777.0f);
    for (int face = 0; face < 6; ++face)
    {
      for (int i = 0; i < 4; ++i)
      {
        std::fill_n(&rgb[3 * ((face * (n + 2) + 1 + i / 2) * (n + 2) + 1 + i % 2)], 3, value);
      }
    }
    std::vector<std::uint16_t> rgba(24 * n * n);
    vtkIBLStoreLayer(rgb.data(), n, 1.0, false, rgba.data(), Serial);
    const double clamped = std::min(std::max(value, 0.0f), 65504.0f);
    for (std::size_t i = 0; i < rgba.size(); ++i)
    {
      if (i % 4 == 3)
      {
        EXPECT_EQ(FromHalf(rgba[i]), 1);
        continue;
      }
      const double stored = FromHalf(rgba[i]);
      const double below = FromHalf(std::uint16_t(rgba[i] - (rgba[i] > 0))),
                   above = FromHalf(std::uint16_t(rgba[i] + 1));
      EXPECT_LE(std::abs(stored - clamped), std::abs(below - clamped)) << value;
      EXPECT_LE(std::abs(stored - clamped), std::abs(above - clamped)) << value;
    }
  }
  EXPECT_EQ(FromHalf(0x3c00), 1);
}

// The fit: a parabola's texels are lowered by a twelfth of its second difference a direction, so that reading between
// them is right in the mean. Mutants: one direction alone, the wrong sign.
TEST(TestLadder, FitsBilinearReading)
{
  constexpr int n = 16;
  std::vector<float> rgb;
  for (int row = 0; row < 6 * (n + 2); ++row)
  {
    for (int i = 0; i < n + 2; ++i)
    {
      const double x = i - 8.5, y = row % (n + 2) - 8.5;
      rgb.insert(rgb.end(), 3, float(0.02 * x * x + 0.01 * y * y + 3));
    }
  }
  std::vector<std::uint16_t> rgba(24 * n * n);
  vtkIBLStoreLayer(rgb.data(), n, 0.5, true, rgba.data(), Serial);
  for (int i = 0; i < n; ++i)
  {
    const double x = i - 7.5, y = 4 - 7.5;
    const double expected = 0.5 * (0.02 * x * x + 0.01 * y * y + 3 - (0.04 + 0.02) / 12);
    EXPECT_NEAR(FromHalf(rgba[4 * (4 * n + i)]), expected, 1e-3) << i;
  }
}
