// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkIBLDirectionFunctions.glsl, the harmonics and the tangent frame: each claim in float and in double.
#include "vtkIBLShaderFunctions.h"

#include "Reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace reference = vtkIBLReference;

template <typename real>
class DirectionFunctions : public ::testing::Test
{
protected:
  using Functions = vtkIBLCore::ShaderFunctions<real>;
  using Vec3 = typename Functions::vec3;
  static constexpr double Eps = std::numeric_limits<real>::epsilon();
  Functions Shader;

  static void ExpectNear(const Vec3& value, const reference::Vec3& expected, double tolerance, const std::string& where)
  {
    EXPECT_NEAR(value.x, expected.x, tolerance) << where;
    EXPECT_NEAR(value.y, expected.y, tolerance) << where;
    EXPECT_NEAR(value.z, expected.z, tolerance) << where;
  }
  // The axes, the poles of every convention, tiny angles beside them, and all around.
  static std::vector<Vec3> Directions()
  {
    std::vector<Vec3> directions;
    std::mt19937 generator(3);
    auto next = [&] { return generator() / 2147483648.0 - 1.0; };
    for (int k = 0; k < 2000; ++k)
    {
      const double tilts[6] = { 0.0, 1e-30, 1e-8, 1e-6, 1e-4, 1e-2 };
      glm::dvec3 v = (k < 36 ? tilts[k % 6] : 1.0) * glm::dvec3(next(), next(), next());
      if (k < 36)
      {
        v[k / 6 % 3] = k < 18 ? 1.0 : -1.0;
      }
      directions.emplace_back(glm::normalize(v));
    }
    return directions;
  }
};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(DirectionFunctions, Precisions);
#define USE_SHADER                                                                                                     \
  using real [[maybe_unused]] = TypeParam;                                                                             \
  using Vec3 [[maybe_unused]] = typename TestFixture::Vec3;                                                            \
  auto& shader = this->Shader;                                                                                         \
  [[maybe_unused]] constexpr double eps = TestFixture::Eps

// Centres, edges and corners of all faces are where GL's table has them, on the cube of half edge 1. Mutants: t of +Y
// negated; -X and -Z swapped.
TYPED_TEST(DirectionFunctions, CubeDirections)
{
  USE_SHADER;
  for (int k = 0; k < 6 * 25; ++k)
  {
    const real s = real(k % 5 - 2) / 2, t = real(k / 5 % 5 - 2) / 2;
    const Vec3 d = shader.iblCubeDirection(k / 25, s, t);
    EXPECT_EQ(std::max({ std::abs(d.x), std::abs(d.y), std::abs(d.z) }), 1);
    this->ExpectNear(
      glm::normalize(d), reference::CubeDirection(k / 25, s, t), 2 * eps, "face " + std::to_string(k / 25));
  }
}

// The angle is atan2's to 2 eps relative, at all magnitudes, and 0 for no direction at all. The seam belongs to +pi.
// Mutants: a coefficient cut to five digits; no swap above the diagonal.
TYPED_TEST(DirectionFunctions, Angle)
{
  USE_SHADER;
  for (int i = 0; i < 20000; ++i)
  {
    const double phi = (i + 0.5) / 20000 * 2 * reference::Pi - reference::Pi;
    const real size = std::pow(real(10), real(i % 21 - 10));
    const real x = size * real(std::cos(phi)), y = size * real(std::sin(phi));
    const double expected = std::atan2(double(y), double(x));
    ASSERT_NEAR(shader.iblAngle(y, x), expected, 2 * eps * std::abs(expected)) << y << ", " << x;
  }
  EXPECT_EQ(shader.iblAngle(0, 0), 0);
  EXPECT_EQ(shader.iblAngle(0, 2), 0);
  EXPECT_NEAR(shader.iblAngle(0, -2), reference::Pi, 2 * eps);
  EXPECT_NEAR(shader.iblAngle(-real(1e-30), -2), -reference::Pi, 2 * eps);
  EXPECT_NEAR(shader.iblAngle(3, 0), reference::Pi / 2, 2 * eps);
  EXPECT_NEAR(shader.iblAngle(-3, 0), -reference::Pi / 2, 2 * eps);
}

// Lat-long coordinates against atan2 in double, at the poles and the seam, too. 1.5 eps absolute: u and v are at
// most 1. Near a pole asin(y) has lost half its digits. Mutants: asin(y); v upside down; u = atan(x, z).
TYPED_TEST(DirectionFunctions, EquirectFromDirection)
{
  USE_SHADER;
  for (const Vec3& d : this->Directions())
  {
    const auto uv = shader.iblEquirectFromDirection(d);
    const double u = std::atan2(double(d.z), double(d.x)) / (2 * reference::Pi) + 0.5;
    const double v = std::atan2(double(d.y), std::hypot(double(d.x), double(d.z))) / reference::Pi + 0.5;
    if (d.x != 0 || d.z != 0) // a pole has every longitude
    {
      EXPECT_NEAR(std::remainder(uv.x - u, 1.0), 0.0, 1.5 * eps) << d.x << " " << d.y << " " << d.z;
    }
    EXPECT_NEAR(uv.y, v, 1.5 * eps) << d.x << " " << d.y << " " << d.z;
    EXPECT_GE(std::min(uv.x, uv.y), 0);
    EXPECT_LE(std::max(uv.x, uv.y), 1);
  }
  // Above 1 by rounding: finite, the pole.
  for (real sign : { -1, 1 })
  {
    const auto uv = shader.iblEquirectFromDirection(Vec3(0, sign * (1 + real(1e-7)), 0));
    EXPECT_EQ(uv.x, real(0.5));
    EXPECT_NEAR(uv.y, sign > 0 ? 1 : 0, eps);
  }
  // A step across the seam.
  EXPECT_NEAR(shader.iblEquirectFromDirection(Vec3(-1, 0, real(1e-7))).x, 1, 2e-7);
  EXPECT_NEAR(shader.iblEquirectFromDirection(Vec3(-1, 0, -real(1e-7))).x, 0, 2e-7);
}

// The other way against the reference, and both ways give the direction back. 8 eps: longitudes up to pi are rounded
// twice. Mutant: cos and sin of the longitude swapped.
TYPED_TEST(DirectionFunctions, DirectionFromEquirect)
{
  USE_SHADER;
  const reference::Environment whole{ 1, 1, {} }; // its only texel's fractions are u and v
  for (int k = 0; k < 17 * 17; ++k)
  {
    const real u = real(k % 17) / 16, v = real(k / 17) / 16;
    this->ExpectNear(
      shader.iblDirectionFromEquirect(u, v), reference::TexelDirection(whole, 0, 0, u, v), 8 * eps, std::to_string(k));
  }
  for (const Vec3& d : this->Directions())
  {
    const auto uv = shader.iblEquirectFromDirection(d);
    this->ExpectNear(shader.iblDirectionFromEquirect(uv.x, uv.y), { d.x, d.y, d.z }, 8 * eps, "there and back");
  }
}

// Texels of any size against the closed form in double, whose own four terms cancel to 4e-16 sr. 2e-6 in float: see
// docs/numerics.md. Mutant: that closed form itself, in float (1 % wrong at 256^2).
TYPED_TEST(DirectionFunctions, SolidAngle)
{
  USE_SHADER;
  for (int n : { 1, 2, 64, 512, 2048 })
  {
    for (int j : { 0, n / 5, n / 2, n - 1 })
    {
      for (int i : { 0, n / 3, n / 2, n - 1 })
      {
        const real step = real(2) / n; // a power of two: the texel's edges are exact
        const double exact = reference::CubeTexelSolidAngle(n, i, j);
        const double value =
          shader.iblCubeSolidAngle(i * step - 1, j * step - 1, (i + 1) * step - 1, (j + 1) * step - 1);
        EXPECT_NEAR(value, exact, 4e-16 + (eps > 1e-10 ? 2e-6 : 1e-14) * exact) << n << ": " << i << ", " << j;
      }
    }
  }
  // They tile the sphere, at sizes without exact edges as well: rounded edges are shared by neighbours. 1e-14: 10^4
  // terms.
  for (int n : { 1, 2, 7, 64, 100 })
  {
    double face = 0;
    for (int k = 0; k < n * n; ++k)
    {
      const auto edge = [&](int i) { return 2 * real(i) / n - 1; };
      face += shader.iblCubeSolidAngle(edge(k % n), edge(k / n), edge(k % n + 1), edge(k / n + 1));
    }
    EXPECT_NEAR(6 * face, 4 * reference::Pi, (4 * eps + 1e-14) * 4 * reference::Pi) << n;
  }
}

// Half the log2 of how much smaller a texel is than one at the face's centre, against texels' exact solid angles on a
// fine face. 2e-2 levels, 3 % of a solid angle: what the polynomial gives away for being one. Mutants: cos for
// cos^2; a sign; one octave for half.
TYPED_TEST(DirectionFunctions, CubeLodOffset)
{
  constexpr int n = 64;
  const double centre = reference::CubeTexelSolidAngle(n, n / 2, n / 2);
  for (int face = 0; face < 6; ++face)
  {
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < n; ++j)
      {
        const reference::Vec3 d = reference::CubeDirection(face, (2 * i + 1.0) / n - 1, (2 * j + 1.0) / n - 1);
        const double exact = 0.5 * std::log2(centre / reference::CubeTexelSolidAngle(n, i, j));
        ASSERT_NEAR(this->Shader.iblCubeLodOffset(typename TestFixture::Vec3(d.x, d.y, d.z)), exact, 2e-2)
          << face << ", " << i << ", " << j;
      }
    }
  }
}

// A right-handed orthonormal frame whose third column is the normal, to the bit. 4 eps. At -z the naive 1 / (1 + z) is
// infinite, beside it has no digits. Mutants: no `side`; the first two columns swapped.
TYPED_TEST(DirectionFunctions, TangentFrame)
{
  USE_SHADER;
  for (const Vec3& N : this->Directions())
  {
    const auto frame = shader.iblTangentFrame(N);
    const std::string where = std::to_string(N.x) + " " + std::to_string(N.y) + " " + std::to_string(N.z);
    EXPECT_EQ(frame[2], N);
    EXPECT_NEAR(glm::dot(frame[0], frame[0]), 1, 4 * eps) << where;
    EXPECT_NEAR(glm::dot(frame[1], frame[1]), 1, 4 * eps) << where;
    EXPECT_NEAR(glm::dot(frame[0], frame[1]), 0, 4 * eps) << where;
    EXPECT_NEAR(glm::dot(frame[0], N), 0, 4 * eps) << where;
    const Vec3 third = glm::cross(frame[0], frame[1]);
    this->ExpectNear(third, { N.x, N.y, N.z }, 4 * eps, where);
  }
}
