// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkIBLBRDFFunctions.glsl: GGX, its visibility, Fresnel, and the split sum. In double, and in float where precision is
// the claim.
#include "vtkIBLShaderFunctions.h"

#include "Reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace reference = vtkIBLReference;

template <typename real>
class ReflectionFunctions : public ::testing::Test
{
protected:
  using Functions = vtkIBLCore::ShaderFunctions<real>;
  static constexpr double Eps = std::numeric_limits<real>::epsilon();
  Functions Shader;
};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ReflectionFunctions, Precisions);

namespace
{
vtkIBLCore::ShaderFunctions<double> Double;
}

TEST(ReflectionFunctions, Alpha)
{
  // Mutant: a fourth power.
  EXPECT_EQ(Double.iblAlpha(0.5), 0.25);
}

// Projected facets cover their ground once: D NoH integrates to 1 over the hemisphere. 1e-7: what the cut-off leaves;
// in float, 8 roundings a value. Mutant: pi left out; alpha for alpha^2.
TYPED_TEST(ReflectionFunctions, DistributionIsNormalised)
{
  using real = TypeParam;
  for (double a : { 1.0, 0.5, 0.1, 0.01, 1e-3 })
  {
    const real alpha = real(a);
    double sum = 0.0;
    for (int i = 0; i < 8000; ++i)
    {
      const double x = -18.0 + 36.0 * (i + 0.5) / 8000, tan2 = double(alpha) * alpha * std::exp(x),
                   cos2 = 1.0 / (1.0 + tan2);
      sum +=
        reference::Pi * this->Shader.iblD_GGX(real(cos2), real(tan2 * cos2), alpha) * tan2 * cos2 * cos2 * 36.0 / 8000;
    }
    EXPECT_NEAR(sum, 1.0, 1e-7 + 4 * this->Eps) << alpha;
  }
}

// D and V are the reference's. 1e-14: a handful of roundings; they are sums of positive terms.
// Mutants: NoV and NoL squared under one root; a2 left out of the root.
TEST(ReflectionFunctions, SameAsReference)
{
  const double cosines[] = { 1e-4, 0.01, 0.3, 0.7, 1.0 };
  for (double alpha : { 1.0, 0.3, 0.01, 1e-3, 1e-6 })
  {
    for (double x : cosines)
    {
      const double D = reference::D_GGX(1 - x * x, alpha);
      EXPECT_NEAR(Double.iblD_GGX(x * x, 1 - x * x, alpha), D, 1e-14 * D);
      for (double y : cosines)
      {
        const double V = reference::V_SmithGGXCorrelated(y, x, alpha);
        EXPECT_NEAR(Double.iblV_SmithGGXCorrelated(x, y, alpha), V, 1e-14 * V) << alpha << " " << x << " " << y;
        // Karis 2013: G1(x) = x / (x (1 - k) + k), k = alpha / 2, here over 4 NoL NoV. Mutant: k = alpha.
        const auto G1 = [&](double z) { return z / (z * (1 - alpha / 2) + alpha / 2); };
        const double schlick = G1(x) * G1(y) / (4 * x * y);
        EXPECT_NEAR(Double.iblV_SchlickSmith(x, y, alpha), schlick, 1e-14 * schlick);
      }
    }
  }
}

// D V by cosines is the reference's, which takes the half vector. 20 roundings, but of 1 + VoL little may be
// left, and of that less the cosines' square only alpha^2. Mutants: the sum of cosines not squared, 1 - VoL, alpha for
// alpha^2, masking of one side.
TYPED_TEST(ReflectionFunctions, LobeByCosines)
{
  using real = TypeParam;
  for (double alpha : { 1.0, 0.3, 0.1 })
  {
    for (double v : { 0.05, 0.5, 0.95, 1.0 })
    {
      for (double l : { 0.05, 0.4, 0.95, 1.0 })
      {
        for (double azimuth : { 0.0, 1.0, 3.0, reference::Pi })
        {
          const reference::Vec3 V = { std::sqrt(1 - v * v), 0, v };
          const reference::Vec3 L = { std::sqrt(1 - l * l) * std::cos(azimuth),
            std::sqrt(1 - l * l) * std::sin(azimuth), l };
          const reference::Vec3 H = reference::Normalize(V + L);
          const double wanted =
            reference::D_GGX(H.x * H.x + H.y * H.y, alpha) * reference::V_SmithGGXCorrelated(v, l, alpha);
          const double VoL1 = 1 + V.x * L.x + V.y * L.y + V.z * L.z;
          const real a2 = real(alpha * alpha);
          const real masking =
            real(l) * this->Shader.iblSmithRoot(real(v), a2) + real(v) * this->Shader.iblSmithRoot(real(l), a2);
          EXPECT_NEAR(this->Shader.iblLobeGGX(real(v + l), real(VoL1), masking, a2) / wanted, 1.0,
            20 * this->Eps / (alpha * alpha * std::min(VoL1, 1.0)))
            << alpha << " " << v << " " << l << " " << azimuth;
        }
      }
    }
  }
}

// Schlick: f0 straight on, f90 at grazing, the reference's weight between. Mutant: a fourth power.
TEST(ReflectionFunctions, Fresnel)
{
  const glm::dvec3 f0(0.04, 0.5, 1.0), f90(1.0, 0.9, 0.0);
  EXPECT_EQ(Double.iblF_Schlick(f0, f90, 1.0), f0);
  EXPECT_EQ(Double.iblF_Schlick(f0, f90, 0.0), f90);
  for (double VoH : { 0.01, 0.3, 0.5, 0.99 })
  {
    const double weight = reference::SchlickWeight(VoH);
    EXPECT_NEAR(glm::length(Double.iblF_Schlick(f0, f90, VoH) - (f0 * (1 - weight) + f90 * weight)), 0.0, 1e-15) << VoH;
  }
}

// The split sum against the reference's quadrature, which integrates another variable. A set of n points whose second
// coordinates begin at 0 is off by 1/2n in the mean, and by as much again in its noise: 1/n, and in the double 1/n of
// more points. Mutants: masking = 2 NoV; the two geometry terms swapped; Schlick's fourth power.
TYPED_TEST(ReflectionFunctions, SplitSum)
{
  const unsigned int count = sizeof(TypeParam) == sizeof(double) ? 4096 : 512;
  for (int geometry : { IBL_SMITH_CORRELATED, IBL_SCHLICK_SMITH })
  {
    for (double NoV : { 0.01, 0.05, 0.2, 0.5, 0.9, 1.0 })
    {
      for (double r : { 0.0, 0.02, 0.1, 0.3, 0.6, 1.0 })
      {
        const auto ab = this->Shader.iblSplitSum(NoV, r, geometry, count);
        const reference::SplitSum exact = reference::SplitSumAB(NoV, r,
          geometry == IBL_SCHLICK_SMITH ? reference::Geometry::SchlickSmith : reference::Geometry::SmithCorrelated);
        EXPECT_NEAR(ab.x, exact.A, 1.0 / count) << geometry << " " << NoV << " " << r;
        EXPECT_NEAR(ab.y, exact.B, 1.0 / count) << geometry << " " << NoV << " " << r;
      }
    }
  }
}

// Nowhere NaN, negative, dark (0.3 is the least, of a matt surface seen from above), or above 1 by more than the noise:
// the whole table, and a rounding beyond its edge, with few samples. Mutant: V.x = sqrt(1 - NoV^2) unclamped, at NoV a
// rounding above 1.
TYPED_TEST(ReflectionFunctions, SplitSumIsSound)
{
  using real = TypeParam;
  for (int k = 0; k < 2 * 33 * 33; ++k)
  {
    const real root = real(k % 33) / 32, NoV = std::max(root * root, real(1e-4)), r = real(k / 33 % 33) / 32;
    for (real x : { NoV, NoV * (1 + real(this->Eps)) })
    {
      const auto ab = this->Shader.iblSplitSum(x, r, k / (33 * 33), 64);
      ASSERT_GE(ab.x, 0) << x << " " << r; // false for NaN
      ASSERT_GE(ab.y, 0) << x << " " << r;
      ASSERT_GE(ab.x + ab.y, 0.25) << x << " " << r;
      ASSERT_LE(ab.x + ab.y, 1 + 1.0 / 64) << x << " " << r;
    }
  }
}
