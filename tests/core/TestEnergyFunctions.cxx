// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The specular ladder, the BRDF table's addresses, and energy out of the table's values: each claim in float and in
// double.
#include "vtkIBLShaderFunctions.h"

#include <gtest/gtest.h>

#include <limits>

template <typename real>
class EnergyFunctions : public ::testing::Test
{
protected:
  using Functions = vtkIBLCore::ShaderFunctions<real>;
  static constexpr double Eps = std::numeric_limits<real>::epsilon();
  Functions Shader;
};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(EnergyFunctions, Precisions);

// Roughness 0 is layer 0, 0.1 is 1, 1 is the last, and beyond 1 is no further. Mutants: IBL_LOG2_FIRST_ROUGHNESS with
// six digits (in double); no min(r, 1); as many steps as layers.
TYPED_TEST(EnergyFunctions, LadderEnds)
{
  using real = TypeParam;
  auto& shader = this->Shader;
  const double eps = this->Eps, last = 10;
  EXPECT_EQ(shader.iblLayerFromPerceptualRoughness(0, last), 0);
  EXPECT_NEAR(
    shader.iblLayerFromPerceptualRoughness(real(0.1), last), 1, 18 * eps); // 9 steps times the rounding of a log of 3.3
  EXPECT_EQ(shader.iblLayerFromPerceptualRoughness(1, last), last);
  EXPECT_EQ(shader.iblLayerFromPerceptualRoughness(real(1.001), last), last);
  EXPECT_EQ(shader.iblPerceptualRoughnessFromLayer(0, last), 0);
  EXPECT_NEAR(shader.iblPerceptualRoughnessFromLayer(1, last), 0.1, eps);
  EXPECT_EQ(shader.iblPerceptualRoughnessFromLayer(last, last), 1);
  // Continuous at 0.1: the two branches meet, on either side. A last digit of r moves the layer by 35 eps at most.
  EXPECT_NEAR(shader.iblLayerFromPerceptualRoughness(std::nextafter(real(0.1), real(0)), last), 1, 40 * eps);
  EXPECT_NEAR(shader.iblLayerFromPerceptualRoughness(std::nextafter(real(0.1), real(1)), last), 1, 40 * eps);
  // Even steps of log r: all neighbours have one ratio.
  const double ratio = std::pow(10.0, 1.0 / (last - 1));
  for (int layer = 1; layer < last; ++layer)
  {
    const double next = shader.iblPerceptualRoughnessFromLayer(layer + 1, last);
    EXPECT_NEAR(next / shader.iblPerceptualRoughnessFromLayer(layer, last), ratio, 8 * eps) << layer;
  }
}

// Both ways are inverse and rise. 18 eps of a layer up to 10; the way back, 8 eps relative. Mutant: steps - 1 in one of
// the two.
TYPED_TEST(EnergyFunctions, LadderBothWays)
{
  using real = TypeParam;
  auto& shader = this->Shader;
  const real last = 10;
  real lower = -1;
  for (int i = 0; i <= 10000; ++i)
  {
    const real r = real(i) / 10000, layer = shader.iblLayerFromPerceptualRoughness(r, last);
    ASSERT_GT(layer, lower) << r;
    lower = layer;
    ASSERT_NEAR(shader.iblPerceptualRoughnessFromLayer(layer, last), r, 8 * this->Eps) << r;
    const real wanted = r * last;
    ASSERT_NEAR(shader.iblLayerFromPerceptualRoughness(shader.iblPerceptualRoughnessFromLayer(wanted, last), last),
      wanted, 18 * this->Eps)
      << wanted;
  }
}

// The table's texel (i, j) is read where it was made: at its centre. Edges of the domain are centres of outer texels.
// Mutants: no half texel; NoV without its root in one of the two.
TYPED_TEST(EnergyFunctions, TableCoordinates)
{
  using real = TypeParam;
  auto& shader = this->Shader;
  for (int n : { 2, 32, 64, 128 })
  {
    for (int i = 0; i < n; ++i)
    {
      const int j = (7 * i + 3) % n;
      const auto arguments = shader.iblBRDFTableArguments(i, j, n);
      for (int block : { 0, 1 })
      {
        const auto at = shader.iblBRDFTableCoordinates(arguments.x, arguments.y, block, n);
        EXPECT_NEAR(at.x, (i + 0.5) / n, 2 * this->Eps);
        EXPECT_NEAR(at.y, (block * n + j + 0.5) / (2 * n), 2 * this->Eps);
      }
      // The other way, between texels: multiply out what a texture unit would see.
      const real NoV = real(i) / n, r = real(j) / n;
      const auto coordinates = shader.iblBRDFTableCoordinates(NoV, r, 0, n);
      const auto back =
        shader.iblBRDFTableArguments(coordinates.x * n - real(0.5), coordinates.y * (2 * n) - real(0.5), n);
      EXPECT_NEAR(back.x, NoV, 4 * n * this->Eps);
      EXPECT_NEAR(back.y, r, 4 * n * this->Eps);
    }
    EXPECT_EQ(shader.iblBRDFTableArguments(n - 1, n - 1, n).x, 1);
    EXPECT_EQ(shader.iblBRDFTableArguments(n - 1, n - 1, n).y, 1);
    EXPECT_EQ(shader.iblBRDFTableArguments(0, 0, n).x, 0);
  }
}

// White reflects everything, whatever (A, B). 4 eps / (A + B): the denominator 1 - missing is A + B. Mutant: the first
// reflection left out of the second.
TYPED_TEST(EnergyFunctions, WhiteFurnace)
{
  using real = TypeParam;
  using Vec2 = typename TestFixture::Functions::vec2;
  using Vec3 = typename TestFixture::Functions::vec3;
  auto& shader = this->Shader;
  for (int k = 0; k < 101 * 101; ++k)
  {
    const real albedo = std::max(real(k % 101) / 100, real(1e-3)), share = real(k / 101) / 100;
    const Vec2 ab(albedo * share, albedo * (1 - share));
    const Vec3 whiteOnce = shader.iblSingleScatter(Vec3(1), Vec3(1), ab);
    const Vec3 white = whiteOnce + shader.iblMultipleScatter(Vec3(1), Vec3(1), whiteOnce, ab);
    ASSERT_NEAR(white.x, 1, 4 * this->Eps / albedo) << albedo << " " << share;
    ASSERT_EQ(white.x, white.z);
    for (real f0 : { real(0), real(0.04), real(0.5), real(0.99) })
    {
      const Vec3 once = shader.iblSingleScatter(Vec3(f0), Vec3(1), ab);
      const Vec3 again = shader.iblMultipleScatter(Vec3(f0), Vec3(1), once, ab);
      EXPECT_GE(again.x, -this->Eps);
      EXPECT_LE(once.x + again.x, 1 + 4 * this->Eps / albedo) << f0 << " " << albedo << " " << share;
    }
  }
}

// Multiple scattering as what it is: light that missed, E = 1 - A - B, bounces with the mean of F, misses again, and so
// on. The sum over bounces against the closed form; the mean of Schlick's F by quadrature. Nothing missing, nothing
// added. Mutants: 1/20 for 1/21; f0 for the mean.
TYPED_TEST(EnergyFunctions, SumOverBounces)
{
  using real = TypeParam;
  using Vec2 = typename TestFixture::Functions::vec2;
  using Vec3 = typename TestFixture::Functions::vec3;
  auto& shader = this->Shader;
  double weight = 0; // mean of (1 - mu)^5 over the hemisphere, cosine inside
  for (int i = 0; i < 20000; ++i)
  {
    const double mu = (i + 0.5) / 20000;
    weight += 2 * mu * std::pow(1 - mu, 5) / 20000;
  }
  for (int k = 0; k < 10 * 10 * 10; ++k)
  {
    const double f0 = k % 10 / 10.0, f90 = k / 10 % 10 / 9.0, missing = k / 100 / 15.0;
    const Vec2 ab(0.8 * (1 - missing), 0.2 * (1 - missing));
    const double once = f0 * double(ab.x) + f90 * double(ab.y), mean = f0 + (f90 - f0) * weight;
    double again = 0, bounce = once;
    for (int n = 0; n < 200; ++n)
    {
      bounce *= mean * missing;
      again += bounce;
    }
    EXPECT_NEAR(shader.iblSingleScatter(Vec3(f0), Vec3(f90), ab).y, once, 4 * this->Eps);
    EXPECT_NEAR(shader.iblMultipleScatter(Vec3(f0), Vec3(f90), Vec3(once), ab).y, again,
      16 * this->Eps + 1e-8); // 1e-8: quadrature
  }
  EXPECT_EQ(shader.iblMultipleScatter(Vec3(real(0.7)), Vec3(1), Vec3(1), Vec2(real(0.75), real(0.25))), Vec3(0));
}

// A roughness to its place on a ladder of any number of layers is the roughness to its layer. Mutants: a fifth of the
// layers for a fifth of the positions, the log of e.
TYPED_TEST(EnergyFunctions, PositionOnTheLadder)
{
  using real = TypeParam;
  auto& shader = this->Shader;
  for (int i = 0; i <= 1000; ++i)
  {
    const real r = real(i) / 1000;
    const real position = shader.iblLadderPosition(r);
    ASSERT_GE(position, 0);
    ASSERT_LE(position, 1);
    ASSERT_NEAR(shader.iblPerceptualRoughnessFromPosition(position), r, 16 * this->Eps) << r;
    for (int layers : { 5, 10, 14 })
    {
      ASSERT_NEAR(shader.iblLayerFromPosition(position, layers), shader.iblLayerFromPerceptualRoughness(r, layers),
        64 * this->Eps)
        << r;
    }
  }
}

// Lobes: a white surface has the white lobe, VTK's default dielectric the other, what lies between lies between,
// whatever (A, B). Mutants: f90 for f90 - f0, the share not over the dielectric's own.
TYPED_TEST(EnergyFunctions, DielectricShare)
{
  using real = TypeParam;
  using Vec2 = typename TestFixture::Functions::vec2;
  auto& shader = this->Shader;
  for (real a : { real(0.1), real(0.5), real(0.95) })
  {
    const Vec2 ab(a, real(0.9) - real(0.9) * a);
    EXPECT_EQ(shader.iblDielectricShare(1, 1, ab), 0);
    EXPECT_NEAR(shader.iblDielectricShare(real(IBL_DIELECTRIC_F0), 1, ab), 1, 4 * this->Eps);
    EXPECT_EQ(shader.iblDielectricShare(real(0.01), 1, ab), 1);
    real before = 1;
    for (real f0 : { real(0.1), real(0.3), real(0.6), real(0.9) })
    {
      const real share = shader.iblDielectricShare(f0, 1, ab);
      EXPECT_LT(share, before);
      EXPECT_GT(share, 0);
      before = share;
    }
  }
  EXPECT_EQ(shader.iblDielectricShare(0, 0, Vec2(1, 0)), 0); // nothing is reflected
}

// 1/pi Integral (1 - VoH)^5 NoL dL by quadrature, with L over the hemisphere. 3e-5: the polynomial's 1e-5 and the
// midpoint rule. Mutant: 1/21, its value for even V.
TYPED_TEST(EnergyFunctions, DiffuseFresnel)
{
  constexpr int steps = 300;
  for (double NoV : { 0.0, 0.1, 0.4, 0.7, 1.0 })
  {
    const double sinV = std::sqrt(1 - NoV * NoV);
    double sum = 0;
    for (int i = 0; i < steps; ++i)
    {
      const double NoL = std::sqrt((i + 0.5) / steps); // even in NoL dL
      for (int j = 0; j < steps; ++j)
      {
        const double VoL = NoV * NoL + sinV * std::sqrt(1 - NoL * NoL) * std::cos(3.14159265358979 * (j + 0.5) / steps);
        sum += std::pow(1 - std::sqrt(std::max(0.5 * (1 + VoL), 0.0)), 5);
      }
    }
    EXPECT_NEAR(this->Shader.iblDiffuseFresnel(NoV), sum / (steps * steps), 3e-5) << NoV;
  }
}

// No occlusion hides nothing, all hides all; a mirror that leaves along the normal is hidden late, one at grazing
// angles early. A reflection above the surface does not fade; one that points 50 degrees below it is gone.
TYPED_TEST(EnergyFunctions, Occlusion)
{
  using real = TypeParam;
  auto& shader = this->Shader;
  for (real alpha : { real(0.01), real(0.3), real(1) })
  {
    for (real NoV : { real(0.1), real(0.5), real(1) })
    {
      EXPECT_EQ(shader.iblSpecularOcclusion(NoV, 1, alpha), 1);
      EXPECT_NEAR(shader.iblSpecularOcclusion(NoV, 0, alpha), 0, 8 * this->Eps);
    }
    EXPECT_GT(
      shader.iblSpecularOcclusion(1, real(0.5), alpha), shader.iblSpecularOcclusion(real(0.2), real(0.5), alpha));
  }
  EXPECT_GT(shader.iblSpecularOcclusion(1, real(0.5), real(0.01)), 0.6);
  EXPECT_EQ(shader.iblHorizonFade(0), 1);
  EXPECT_EQ(shader.iblHorizonFade(real(0.5)), 1);
  EXPECT_EQ(shader.iblHorizonFade(real(-0.8)), 0);
}
