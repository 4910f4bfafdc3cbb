// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The table that the library carries, against converged quadrature and closed forms.
#include "vtkIBLBRDFTableTexels.h"

#include "Reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace reference = vtkIBLReference;

namespace
{
constexpr int n = vtkIBLBRDFTableSize;
constexpr double Quantum = 1.0 / 65535;

double GetTexel(int i, int j, int channel)
{
  return vtkIBLBRDFTableTexels[(j * n + i) * vtkIBLBRDFTableChannels + channel] * Quantum;
}

double GetNoV(double i)
{
  return i / (n - 1) * i / (n - 1);
}

reference::SplitSum GetTruth(double NoV, double roughness)
{
  char key[80];
  std::snprintf(key, sizeof(key), "split sum %.17g %.17g", NoV, roughness);
  return reference::Cached<reference::SplitSum>(
    key, [&] { return std::vector{ reference::SplitSumAB(NoV, roughness) }; })[0];
}
}

// Half a quantum at worst is 7.6e-6, 4.4e-6 rms; the witness is good to 3e-6 where it is asked (NoV from 0.01). At
// smaller NoV it leaves out 1.5e-4 of the lobe's tail, and the limits below take over. Mutants: NoH left out, a quarter
// of the panels. (A table that gains energy does not fit its 16 bits, and does not compile.)
TEST(TestBRDFTableTexels, AgreeWithQuadrature)
{
  double squares = 0;
  double worst = 0;
  int count = 0;
  for (int j = 2; j < n; j += 5)
  {
    for (int i = 8; i < n; i += 5)
    {
      const reference::SplitSum truth = GetTruth(GetNoV(i), double(j) / (n - 1));
      for (double error : { GetTexel(i, j, 0) - truth.A, GetTexel(i, j, 1) - truth.B })
      {
        squares += error * error;
        worst = std::max(worst, std::abs(error));
        ++count;
      }
    }
  }
  std::printf("rms %.1e, worst %.1e\n", std::sqrt(squares / count), worst);
  EXPECT_LT(std::sqrt(squares / count), 6e-6);
  EXPECT_LT(worst, 2e-5);
}

// A mirror: V = L's reflection about H = N, so B = (1 - NoV)^5 and A = 1 - B. Mutant: alpha 0 in the general formula.
TEST(TestBRDFTableTexels, OfAMirrorAreFresnel)
{
  for (int i = 0; i < n; ++i)
  {
    const double grazing = std::pow(1 - GetNoV(i), 5);
    EXPECT_NEAR(GetTexel(i, 0, 0), 1 - grazing, 0.51 * Quantum) << i;
    EXPECT_NEAR(GetTexel(i, 0, 1), grazing, 0.51 * Quantum) << i;
  }
}

// At NoV = 0 a white surface of any roughness reflects all: the weight is 2 sqrt(tau) cos(phi) tau/(1 + tau)^2 dx
// dphi/(2 pi), whose integral is Beta(3/2, 1/2) 2/pi = 1. At roughness 1 it is x dw 2/pi over a quarter of the sphere,
// x = VoH, so B = 2 Integral x (1 - x)^5 dx = 1/21. Two roundings: one quantum. Mutant: x up to 18 (1.5e-4).
TEST(TestBRDFTableTexels, AtGrazingHaveTheirLimit)
{
  for (int j = 1; j < n; ++j)
  {
    EXPECT_NEAR(GetTexel(0, j, 0) + GetTexel(0, j, 1), 1, 1.01 * Quantum) << j;
  }
  EXPECT_NEAR(GetTexel(0, n - 1, 1), 1.0 / 21, 0.51 * Quantum);
}

// Between texels, as shaders read it, over NoV and perceptualRoughness: 1e-4 rms was measured (2.5e-4 with 48 x 48
// texels, 5e-4 with 32 x 32). Mutants: NoV for sqrt(NoV), axes swapped, 32 x 32.
TEST(TestBRDFTableTexels, ReadBetweenTexels)
{
  double squares = 0;
  double worst = 0;
  int count = 0;
  for (int k = 0; k < 200; ++k)
  {
    const double NoV = 0.01 + 0.99 * std::fmod(0.5 + k * 0.7548776662466927, 1.0); // Roberts 2018, R2
    const double roughness = 0.02 + 0.98 * std::fmod(0.5 + k * 0.5698402909980532, 1.0);
    const reference::SplitSum truth = GetTruth(NoV, roughness);
    const double x = std::sqrt(NoV) * (n - 1);
    const double y = roughness * (n - 1);
    const int i = std::min(int(x), n - 2);
    const int j = std::min(int(y), n - 2);
    for (int channel = 0; channel < 2; ++channel)
    {
      const double below = GetTexel(i, j, channel) + (x - i) * (GetTexel(i + 1, j, channel) - GetTexel(i, j, channel));
      const double above =
        GetTexel(i, j + 1, channel) + (x - i) * (GetTexel(i + 1, j + 1, channel) - GetTexel(i, j + 1, channel));
      const double error = below + (y - j) * (above - below) - (channel == 0 ? truth.A : truth.B);
      squares += error * error;
      worst = std::max(worst, std::abs(error));
      ++count;
    }
  }
  std::printf("rms %.1e, worst %.1e\n", std::sqrt(squares / count), worst);
  EXPECT_LT(std::sqrt(squares / count), 1.5e-4);
}
