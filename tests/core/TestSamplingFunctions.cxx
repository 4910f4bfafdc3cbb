// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkIBLSamplingFunctions.glsl: points, and what they are warped to, against the densities that they state. (The
// tangent frame is in TestDirectionFunctions.)
#include "vtkIBLShaderFunctions.h"

#include "Reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

namespace reference = vtkIBLReference;

template <typename real>
class SamplingFunctions : public ::testing::Test
{
protected:
  using Functions = vtkIBLCore::ShaderFunctions<real>;
  static constexpr double Eps = std::numeric_limits<real>::epsilon();
  Functions Shader;
};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SamplingFunctions, Precisions);

namespace
{
vtkIBLCore::ShaderFunctions<double> Double;
const double Alphas[] = { 1.0, 0.5, 0.1, 0.01, 1e-3 };

// Share of D NoH between the normal and the angle of sin^2, by quadrature of the reference's D. With tan^2 = alpha^2
// exp(x), even steps of x resolve the peak at every alpha; below x = -18 lies 1.5e-8 of it. d(omega) NoH = pi d(sin^2).
double ShareWithin(double sin2, double alpha)
{
  const double begin = -18.0, end = std::min(18.0, std::log(sin2 / (1.0 - sin2)) - 2.0 * std::log(alpha));
  const int steps = 4000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i)
  {
    const double tan2 = alpha * alpha * std::exp(begin + (end - begin) * (i + 0.5) / steps);
    const double s = tan2 / (1.0 + tan2), ds = tan2 / ((1.0 + tan2) * (1.0 + tan2)) * (end - begin) / steps;
    sum += reference::Pi * reference::D_GGX(s, alpha) * ds;
  }
  return sum;
}
}

// Hammersley: stratified in the first coordinate, van der Corput's sequence in the second, as good as new in float, and
// below 1 to the last. Mutants: i / n; the second coordinate not centred.
TYPED_TEST(SamplingFunctions, Hammersley)
{
  std::set<double> second;
  for (unsigned int i = 0; i < 256; ++i)
  {
    const auto point = this->Shader.iblHammersley(i, 256);
    EXPECT_EQ(point.x, (i + 0.5) / 256);
    second.insert(std::floor(point.y * 256));
    EXPECT_EQ(point.y * 256 - std::floor(point.y * 256), 0.5); // centred: the mean is not biased
  }
  EXPECT_EQ(second.size(), 256u); // one in each stratum
  EXPECT_EQ(*second.rbegin(), 255);
  const double quarters[4] = { 0.0, 0.5, 0.25, 0.75 };
  for (unsigned int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(std::floor(4 * this->Shader.iblHammersley(i, 4).y), 4 * quarters[i]);
  }
  EXPECT_LT(this->Shader.iblHammersley((1 << 23) - 1, 1 << 23).y, 1);
}

// PCG's own output, computed apart. Mutant: a shift of 3 for 4.
TEST(SamplingFunctions, Hash)
{
  EXPECT_EQ(Double.iblHash(0u), 129708002u);
  EXPECT_EQ(Double.iblHash(1u), 2831084092u);
  EXPECT_EQ(Double.iblHash(0xFFFFFFFFu), 3861530882u);
}

// Any start of the lattice is even: the first 4096 of any shift put 16 of 4096 points into each of 16 x 16 cells, give
// or take five (random points give or take fourteen). In [0, 1), in float to the last bit. Mutants: one factor for both
// coordinates; the upper 8 bits kept.
TYPED_TEST(SamplingFunctions, Lattice)
{
  for (unsigned int shift : { 0u, 1u, 12345u, 0xFFFFFFFFu })
  {
    int cells[256] = {};
    for (unsigned int i = 0; i < 4096; ++i)
    {
      const auto point = this->Shader.iblLatticePoint(i, shift);
      ASSERT_GE(std::min(point.x, point.y), 0);
      ASSERT_LT(std::max(point.x, point.y), 1);
      ++cells[int(point.x * 16) * 16 + int(point.y * 16)];
    }
    EXPECT_GE(*std::min_element(cells, cells + 256), 11) << shift;
    EXPECT_LE(*std::max_element(cells, cells + 256), 21) << shift;
  }
  // 2^32 over the plastic number and its square (Roberts 2018): an odd integer, so that no lattice point comes twice in
  // 2^32.
  const double plastic = 1.32471795724474602596;
  const auto step = this->Shader.iblLatticePoint(1, 0), origin = this->Shader.iblLatticePoint(0, 0);
  EXPECT_NEAR(std::remainder(step.x - origin.x - 1.0 / plastic, 1.0), 0.0, 2e-7);
  EXPECT_NEAR(std::remainder(step.y - origin.y - 1.0 / (plastic * plastic), 1.0), 0.0, 2e-7);
}

// The sampler against the distribution: the share u of D NoH lies within the angle that u gives. 1e-6: the quadrature's
// midpoint rule. Both legs are of one angle. Mutants: alpha for alpha^2; the two legs swapped.
TYPED_TEST(SamplingFunctions, HalfVectorFollowsItsDensity)
{
  using real = TypeParam;
  for (double alpha : Alphas)
  {
    for (double u : { 1e-4, 0.01, 0.1, 0.5, 0.9, 0.99 })
    {
      const auto h = this->Shader.iblHalfVectorGGX(real(u), real(alpha));
      EXPECT_NEAR(h.x + h.y, 1.0, 2 * this->Eps);
      EXPECT_NEAR(ShareWithin(h.y, alpha), u, 1e-6 + 4 * this->Eps) << alpha;
    }
    // The ends: the normal itself, and the horizon.
    EXPECT_EQ(this->Shader.iblHalfVectorGGX(0, real(alpha)).y, 0);
    EXPECT_NEAR(this->Shader.iblHalfVectorGGX(1, real(alpha)).x, 0, 0);
  }
}

// Visible half vectors against their density G1(V) D VoH / NoV in 12 x 12 cells; even in q = 1 - sqrt(1 - u), u the
// share of D NoH within an angle, because 1 / NoH has no peak there. A cell holds 1/144; 2^18 Hammersley points leave
// up to 20 on its rim in doubt. Mutants: a hemisphere for the cap; half vectors not stretched back.
TEST(SamplingFunctions, VisibleHalfVectorFollowsItsDensity)
{
  const int cells = 12, fine = 60;
  const unsigned int count = 1 << 18;
  for (double alpha : { 1.0, 0.3, 0.01 })
  {
    for (double NoV : { 0.02, 0.3, 0.8, 1.0 })
    {
      const glm::dvec3 V(std::sqrt(1.0 - NoV * NoV), 0.0, NoV);
      std::vector<double> expected(cells * cells), seen(cells * cells);
      const double G1 = 2.0 * NoV / (NoV + std::sqrt(NoV * NoV + alpha * alpha * (1.0 - NoV * NoV)));
      for (int k = 0; k < cells * fine * cells * fine; ++k)
      {
        const int i = k % (cells * fine), j = k / (cells * fine);
        const double q = (i + 0.5) / (cells * fine), phi = 2.0 * reference::Pi * ((j + 0.5) / (cells * fine) - 0.5);
        const double u = q * (2.0 - q), tan2 = alpha * alpha * u / (1.0 - u), NoH = 1.0 / std::sqrt(1.0 + tan2);
        const double VoH = V.z * NoH + V.x * std::sqrt(tan2) * NoH * std::cos(phi);
        expected[j / fine * cells + i / fine] +=
          G1 * std::max(VoH, 0.0) / (NoV * NoH) * 2.0 * (1.0 - q) / (cells * fine * cells * fine);
      }
      for (unsigned int i = 0; i < count; ++i)
      {
        const glm::dvec3 h = Double.iblVisibleHalfVectorGGX(Double.iblHammersley(i, count), V, glm::dvec2(alpha), 1.0);
        const double sin2 = h.x * h.x + h.y * h.y, q = 1.0 - alpha * h.z / std::sqrt(sin2 + alpha * alpha * h.z * h.z);
        const double turn = std::atan2(h.y, h.x) / (2.0 * reference::Pi) + 0.5;
        ASSERT_GT(h.z, 0.0);
        ASSERT_NEAR(glm::length(h), 1.0, 1e-14);
        seen[std::min(int(turn * cells), cells - 1) * cells + std::min(int(q * cells), cells - 1)] += 1.0 / count;
      }
      double total = 0.0, worst = 0.0;
      for (int k = 0; k < cells * cells; ++k)
      {
        total += expected[k];
        worst = std::max(worst, std::abs(seen[k] - expected[k]));
      }
      EXPECT_NEAR(total, 1.0, 1e-5) << "the density's own integral; alpha " << alpha << ", NoV " << NoV;
      EXPECT_LE(worst, 1e-4) << "alpha " << alpha << ", NoV " << NoV;
    }
  }
}

// The bounded cap: of all half vectors drawn, far fewer reflect below the horizon, and what is drawn still integrates
// to the directional albedo, that of anisotropic lobes too; the witness is tests/reference. 1e-3: 2^14 points. Mutants:
// the bound in the density and not in the cap, alpha.x for the smaller of both.
TEST(SamplingFunctions, BoundedHalfVectorsIntegrateToTheAlbedo)
{
  const unsigned int count = 1 << 14;
  for (double alpha : { 1.0, 0.4, 0.09 })
  {
    for (double NoV : { 0.1, 0.5, 0.9 })
    {
      const glm::dvec3 V(std::sqrt(1.0 - NoV * NoV), 0.0, NoV);
      const glm::dvec2 bound = Double.iblVisibleBound(V, glm::dvec2(alpha));
      double albedo = 0.0;
      unsigned int below = 0;
      unsigned int belowUnbounded = 0;
      for (unsigned int i = 0; i < count; ++i)
      {
        const glm::dvec2 u = Double.iblHammersley(i, count);
        const glm::dvec3 h = Double.iblVisibleHalfVectorGGX(u, V, glm::dvec2(alpha), bound.x);
        const glm::dvec3 l = 2.0 * glm::dot(V, h) * h - V;
        below += l.z <= 0.0;
        albedo +=
          l.z > 0.0 ? 2.0 * l.z * Double.iblV_SmithGGXAnisotropic(V, l, glm::dvec2(alpha)) * bound.y / count : 0.0;
        const glm::dvec3 any = Double.iblVisibleHalfVectorGGX(u, V, glm::dvec2(alpha), 1.0);
        belowUnbounded += 2.0 * glm::dot(V, any) * any.z - V.z <= 0.0;
      }
      EXPECT_NEAR(albedo, reference::DirectionalAlbedo(NoV, std::sqrt(alpha)), 1e-3) << alpha << " " << NoV;
      EXPECT_LE(below, belowUnbounded);
      if (alpha == 0.4 && NoV == 0.1)
      {
        EXPECT_LT(below, 0.8 * belowUnbounded);
      }
    }
  }
}

// A sample that stands for one texel reads level 0; for four, level 1. 1/(N pdf) sr a sample, 4 pi / 6 n^2 sr a texel.
// 16 eps: a log2 of up to 8. Mutant: the factor 6 left out.
TYPED_TEST(SamplingFunctions, FilteredLod)
{
  const double texel = 4 * reference::Pi / (6.0 * 512 * 512);
  for (int level = -2; level <= 9; ++level)
  {
    EXPECT_NEAR(
      this->Shader.iblFilteredLod(1 / (1000 * texel * std::exp2(2.0 * level)), 1000, 512), level, 16 * this->Eps);
  }
}
