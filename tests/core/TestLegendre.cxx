// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLLegendre.h"

#include "Reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace reference = vtkIBLReference;

namespace
{
constexpr int Group = vtkIBLLegendre::Group;

std::vector<vtkIBLLegendre::Latitude> MakeLatitudes(const std::vector<double>& colatitudes)
{
  std::vector<vtkIBLLegendre::Latitude> latitudes(colatitudes.size());
  for (std::size_t i = 0; i < latitudes.size(); ++i)
  {
    latitudes[i].Cosine[0] = std::cos(colatitudes[i]);
    latitudes[i].Weight[0] = 1.0;
  }
  return latitudes;
}

// P_lm at all latitudes of one group, north and south, as Synthesise() gives it for one coefficient of 1.
struct Column
{
  float Values[12][Group] = {};
  Column(const vtkIBLLegendre& legendre, int order, int l, int m)
  {
    std::vector<float> coefficients(6 * (order + 1 - m), 0.0f);
    coefficients[6 * (l - m)] = 1.0f;
    legendre.Synthesise(m, 0, coefficients.data(), this->Values[0]);
  }
};
}

// Against the witness's own recurrence, to its order 64, at both hemispheres: 3e-6 of the largest, sqrt((2l+1)/4pi),
// and by the pole what a cosine in single precision moves a latitude, up to 3e-8 / sin(colatitude) rad, a thousandth of
// a texel. Mutants: a term of the recurrence, the sign of the south, no sqrt 2.
TEST(TestLegendre, AgreesWithTheWitness)
{
  const std::vector<double> colatitudes = { 1e-3, 0.02, 0.3, 0.7, 1.1, 1.5707 };
  constexpr int order = 64;
  const vtkIBLLegendre legendre(order, MakeLatitudes(colatitudes));
  for (int l : { 0, 1, 2, 7, 33, 64 })
  {
    for (int m = 0; m <= l; m += 1 + l / 9)
    {
      const Column column(legendre, order, l, m);
      for (std::size_t i = 0; i < colatitudes.size(); ++i)
      {
        for (double sign : { 1.0, -1.0 })
        {
          // At longitude 0 the cosine's function is P_lm; the witness's polar axis is z.
          const reference::Vec3 d = { std::sin(colatitudes[i]), 0, sign * std::cos(colatitudes[i]) };
          const double truth = reference::HarmonicBasis(l, d)[l * (l + 1) + m];
          const double moved = 3e-8 / std::sin(colatitudes[i]) * std::min(double(l), 0.5 * l * l * colatitudes[i]);
          EXPECT_NEAR(column.Values[sign > 0 ? 0 : 6][i], truth, (1e-6 + moved) * std::sqrt(2 * l + 1))
            << l << " " << m << " " << i;
        }
      }
    }
  }
}

// Unsoeld's theorem: at any latitude, the squares of a band's functions add up to (2l+1)/4pi. To order 512, where sin^m
// is down to 1e-300 before it grows to 1: single precision alone would be off by all of it. 2e-4: 512 steps' rounding.
// Mutants: latitudes that begin together though single precision can't
// hold them beside each other; latitudes left out too early.
TEST(TestLegendre, IsSafeToOrder512)
{
  std::vector<double> colatitudes;
  for (int i = 0; i < Group; ++i)
  {
    colatitudes.push_back((i + 0.5) / Group * 0.5 * reference::Pi);
  }
  constexpr int order = vtkIBLLegendre::MaximumOrder;
  static_assert(order == 512, "what was promised");
  const vtkIBLLegendre legendre(order, MakeLatitudes(colatitudes));
  for (int l : { 200, 320, 511, 512 })
  {
    std::vector<double> sums(Group, 0.0);
    for (int m = 0; m <= l; ++m)
    {
      const Column column(legendre, order, l, m);
      for (int i = 0; i < Group; ++i)
      {
        sums[i] += double(column.Values[0][i]) * column.Values[0][i];
      }
    }
    for (int i = 0; i < Group; ++i)
    {
      EXPECT_NEAR(sums[i] / ((2 * l + 1) / (4 * reference::Pi)), 1, 3e-4) << l << " at " << colatitudes[i];
    }
  }
}

// Analysis is the transpose of synthesis: <A v, c> = <v, S c> for any values and coefficients, with one node or two.
// 1e-5. Mutants: the second node's weight; a chunk's first band; south's sign.
TEST(TestLegendre, AnalysisIsSynthesisTransposed)
{
  constexpr int order = 90;
  std::vector<vtkIBLLegendre::Latitude> latitudes(40); // more than a group
  for (std::size_t i = 0; i < latitudes.size(); ++i)
  {
    latitudes[i].Cosine[0] = std::cos((i + 0.2) / 40 * 0.5 * reference::Pi);
    latitudes[i].Weight[0] = 1.0;
  }
  auto both = latitudes;
  for (std::size_t i = 0; i < both.size(); ++i)
  {
    both[i].Cosine[1] = std::cos((i + 0.8) / 40 * 0.5 * reference::Pi);
    both[i].Weight[1] = 0.5;
  }
  auto second = both;
  for (auto& latitude : second)
  {
    latitude = { { latitude.Cosine[1], 0.0 }, { latitude.Weight[1], 0.0 } };
  }
  const vtkIBLLegendre one(order, latitudes), two(order, both), other(order, second);
  const int stride = one.GetNumberOfGroups() * Group;
  for (int m : { 0, 1, 40, 89, 90 })
  {
    // What pads the last group is not read. Mutant: it is, and all coefficients are NaN.
    std::vector<float> values(12 * stride, std::numeric_limits<float>::quiet_NaN()), coefficients(6 * (order + 1 - m)),
      fromOne(coefficients.size()), fromTwo(coefficients.size());
    for (std::size_t i = 0; i < coefficients.size(); ++i)
    {
      coefficients[i] = std::sin(1.7 * i + m);
    }
    // values[c] and values[6 + c] are north + south and north - south.
    for (int c = 0; c < 12; ++c)
    {
      for (int i = 0; i < 40; ++i)
      {
        values[c * stride + i] = std::cos(0.37 * i * (c + 1));
      }
    }
    one.Analyse(m, values.data(), fromOne.data());
    two.Analyse(m, values.data(), fromTwo.data());
    double analysedOne = 0, analysedTwo = 0, synthesised = 0, synthesisedSecond = 0;
    for (std::size_t i = 0; i < coefficients.size(); ++i)
    {
      analysedOne += double(fromOne[i]) * coefficients[i];
      analysedTwo += double(fromTwo[i]) * coefficients[i];
    }
    for (int group = 0; group < one.GetNumberOfGroups(); ++group)
    {
      const auto add = [&](const vtkIBLLegendre& legendre, double& sum)
      {
        float out[12][Group] = {};
        legendre.Synthesise(m, group, coefficients.data(), out[0]);
        for (int i = group * Group; i < std::min(40, (group + 1) * Group); ++i)
        {
          for (int c = 0; c < 6; ++c)
          {
            const double north = 0.5 * (values[c * stride + i] + values[(6 + c) * stride + i]);
            const double south = 0.5 * (values[c * stride + i] - values[(6 + c) * stride + i]);
            sum += north * out[c][i % Group] + south * out[6 + c][i % Group];
          }
        }
      };
      add(one, synthesised);
      add(other, synthesisedSecond);
    }
    EXPECT_NEAR(analysedOne, synthesised, 1e-5 * 6 * order) << m;
    EXPECT_NEAR(analysedTwo, synthesised + synthesisedSecond, 1e-5 * 6 * order) << m;
  }
}
