// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause

// The witness proves itself: N against 2N, closed forms, and the definitions by brute force.
// "Mutant:" names a change that was made by hand and made that test fail.

#include "Reference.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>

using namespace vtkIBLReference;

namespace
{
// +y is a pole, -x the seam, (1,1,1) a cube corner.
const std::vector<Vec3> Directions = { { 0, 1, 0 }, { 0, -1, 0 }, { -1, 0, 0 }, Normalize({ 1, 1, 1 }),
  Normalize({ -1, 0.3, 1e-4 }), Normalize({ 0.02, -1, 0.01 }), Normalize({ 0.4, -0.5, 0.8 }) };
const Vec3 Axis = Normalize({ 0.48, 0.6, -0.64 });

// Few bright texels among dark ones, as in a photographed sky: mean 1/5, largest 1.
Environment Noise(int width, int height)
{
  std::mt19937 generator(7); // the standard fixes its sequence
  Environment environment{ width, height, {} };
  for (int i = 0; i < 3 * width * height; ++i)
  {
    environment.rgb.push_back(std::pow(static_cast<double>(generator()) / 4294967296.0, 4));
  }
  return environment;
}

// body(L, H, weight) for half vectors of density D NoH, by the inverse of its distribution function,
// tan^2 = alpha^2 xi / (1 - xi) (Walter et al. 2007, eq. 35), stretched. On an even grid of y = sqrt(1 - xi), for
// slopes go as 1/y.
template <class Body>
void ForEachHalfVector(Vec3 N, Vec3 T, Vec3 V, double alphaT, double alphaB, int grid, const Body& body)
{
  const Vec3 B = Cross(N, T);
  for (int i = 0; i < grid * grid; ++i)
  {
    const double y = (i % grid + 0.5) / grid, phi = 2 * Pi * (i / grid + 0.5) / grid;
    const double slope = std::sqrt((1 - y) * (1 + y)) / y;
    const Vec3 H = Normalize(alphaT * slope * std::cos(phi) * T + alphaB * slope * std::sin(phi) * B + N);
    body(2 * Dot(V, H) * H - V, H, 2 * y / grid / grid);
  }
}
template <class Body>
void ForEachReflection(Vec3 N, Vec3 V, double alpha, int grid, const Body& body)
{
  const Vec3 T = Normalize(Cross(std::abs(N.y) < 0.9 ? Vec3{ 0, 1, 0 } : Vec3{ 1, 0, 0 }, N));
  ForEachHalfVector(N, T, V, alpha, alpha, grid, [&](Vec3 L, Vec3 H, double weight) {
    if (Dot(N, L) > 0)
    {
      body(L, H, weight);
    }
  });
}

// Mean of t^power under K(t) = t/(c-t)^2, relative to power 0; even steps of log(c - t).
double KernelMoment(double alpha, int power)
{
  const double c = (1 + alpha * alpha) / (1 - alpha * alpha);
  double moment = 0, total = 0;
  for (int i = 0; i < 100000; ++i)
  {
    const double q = (c - 1) * std::pow(c / (c - 1), (i + 0.5) / 100000), t = c - q;
    moment += std::pow(t, power) * t / q; // dt = q dlog(q)
    total += t / q;
  }
  return moment / total;
}
}

// Row 0 is the bottom, u grows from -x by -z, +x to +z. Mutants: rows from the top; z negated.
TEST(Environment, Orientation)
{
  const Environment env = Noise(8, 4);
  EXPECT_EQ(TexelIndex(env, { 0.1, -1, 0.1 }) / 8, 0);
  EXPECT_EQ(TexelIndex(env, { 0, 1, 0 }) / 8, 3);
  EXPECT_EQ(TexelIndex(env, { -1, 0.1, -1e-9 }) % 8, 0);
  EXPECT_EQ(TexelIndex(env, { 0.1, 0.1, -1 }) % 8, 2);
  EXPECT_EQ(TexelIndex(env, { 1, 0.1, 0.1 }) % 8, 4);
  EXPECT_EQ(TexelIndex(env, { -1, 0.1, 1e-9 }) % 8, 7);
  for (int texel = 0; texel < 32; ++texel)
  {
    EXPECT_EQ(TexelIndex(env, TexelDirection(env, texel / 8, texel % 8)), texel);
  }
  EXPECT_EQ(Radiance(env, TexelDirection(env, 3, 5))[1], env.rgb[3 * (3 * 8 + 5) + 1]);
}

// GL's table: each face's centre, and t of +X runs down, s of +Z runs to +x. Mutant: t negated.
TEST(Cube, Orientation)
{
  const double centres[6][3] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 },
    { 0, 0, -1 } };
  for (int face = 0; face < 6; ++face)
  {
    const Vec3 d = CubeDirection(face, 0, 0);
    EXPECT_EQ(Dot(d, { centres[face][0], centres[face][1], centres[face][2] }), 1);
  }
  EXPECT_GT(CubeDirection(0, 0, -1).y, 0);
  EXPECT_GT(CubeDirection(0, -1, 0).z, 0);
  EXPECT_GT(CubeDirection(4, 1, 0).x, 0);
  EXPECT_GT(CubeDirection(2, 0, 1).z, 0);
  EXPECT_GT(CubeDirection(3, 0, -1).z, 0);
}

// Both tilings cover the sphere. 1e-12: sums of 2000 terms of relative error 1e-13.
TEST(SolidAngle, SumsToSphere)
{
  double sphere = 0;
  Vec3 vector{ 0, 0, 0 };
  const Environment env = Noise(64, 32);
  for (int texel = 0; texel < 64 * 32; ++texel)
  {
    sphere += TexelSolidAngle(env, texel / 64);
    vector = vector + TexelVectorIntegral(env, texel / 64, texel % 64);
  }
  EXPECT_NEAR(sphere, 4 * Pi, 1e-12);
  EXPECT_NEAR(Dot(vector, vector), 0, 1e-24);
  for (int n : { 1, 2, 7, 64 })
  {
    double face = 0;
    for (int texel = 0; texel < n * n; ++texel)
    {
      face += CubeTexelSolidAngle(n, texel % n, texel / n);
    }
    EXPECT_NEAR(6 * face, 4 * Pi, 1e-10) << n;
  }
  // A small texel has area times (s^2 + t^2 + 1)^-3/2, to its size squared.
  const double s = 2 * 3.5 / 512 - 1, t = 2 * 100.5 / 512 - 1;
  EXPECT_NEAR(
    CubeTexelSolidAngle(512, 3, 100) / (std::pow(1 + s * s + t * t, -1.5) * 4 / 512 / 512), 1, 1e-5);
}

// Constant radiance: irradiance pi c, prefilter c, only Y_00. Mutants: solid angle dropped from a texel's
// weight (irradiance, harmonics), 1/pi inside.
TEST(Integrals, ConstantEnvironment)
{
  const RGB c = { 0.5, 2, 7 };
  const Environment env = ConstantEnvironment(c, 64, 32);
  for (const Vec3& n : Directions)
  {
    // 5e-6: 16 x 16 sub-cells where the horizon cuts a texel
    EXPECT_NEAR(Irradiance(env, n)[2], Pi * c[2], 5e-6 * Pi * c[2]);
    EXPECT_NEAR(PrefilteredRadiance(env, n, 0.3)[0], c[0], 1e-13);
  }
  const std::vector<RGB> coefficients = HarmonicCoefficients(env, 6);
  EXPECT_NEAR(coefficients[0][1], c[1] * std::sqrt(4 * Pi), 1e-10);
  for (std::size_t k = 1; k < coefficients.size(); ++k)
  {
    EXPECT_NEAR(coefficients[k][1], 0, 1e-7) << k; // 3 x 3 points, (5 sizes)^-6
  }
}

// L = 1 + d.axis: irradiance pi + 2 pi/3 n.axis, prefilter 1 + b_1 n.axis with b_1 the kernel's mean of t,
// coefficients sqrt(4 pi/3) (y, z, x). 1e-4 of the cosine's amplitude: texels of h = pi/128 hold means, which
// shortens the vector by h^2/12 (poles) to h^2/6 (equator) = 1e-4.
// Mutants: wrong c (a^2 for 2a^2 in c - 1); alpha = r; y and z harmonics exchanged.
TEST(Integrals, CosineEnvironment)
{
  const Environment env = CosineEnvironment(Axis, 256, 128);
  for (const Vec3& n : Directions)
  {
    EXPECT_NEAR(Irradiance(env, n)[0], Pi + 2 * Pi / 3 * Dot(n, Axis), 1e-4 * 2 * Pi / 3);
    for (double r : { 0.35, 0.5, 0.75, 0.95 }) // narrower ones see single texels
    {
      const double b1 = KernelMoment(r * r, 1);
      EXPECT_NEAR(PrefilteredRadiance(env, n, r)[0], 1 + b1 * Dot(n, Axis), 1e-4) << r;
    }
    EXPECT_NEAR(PrefilteredRadiance(env, n, 1)[0], 1 + 2 / 3. * Dot(n, Axis), 1e-4);
  }
  const std::vector<RGB> k = HarmonicCoefficients(env, 2);
  EXPECT_NEAR(k[1][0], std::sqrt(4 * Pi / 3) * Axis.y, 1e-4 * std::sqrt(4 * Pi / 3));
  EXPECT_NEAR(k[2][0], std::sqrt(4 * Pi / 3) * Axis.z, 1e-4 * std::sqrt(4 * Pi / 3));
  EXPECT_NEAR(k[3][0], std::sqrt(4 * Pi / 3) * Axis.x, 1e-4 * std::sqrt(4 * Pi / 3));
}

// One texel of solid angle w and radiance L: irradiance L w NoL; prefilter L w K(NoL) / integral of K, with
// that integral in closed form, 2 pi (1/(c-1) + log(1 - 1/c)). The texel is h = pi/256 wide: h^2/12 = 1.3e-5 of
// the kernel's curvature, which is below 6/(c-t) ~ 20 for t = 0.8 and below.
TEST(Integrals, OneTexelSun)
{
  const int row = 90, column = 37;
  const Environment env = OneTexelSun({ 1e6, 1e6, 1e6 }, row, column, 512, 256);
  const Vec3 sun = TexelDirection(env, row, column);
  const double power = 1e6 * TexelSolidAngle(env, row);
  for (double t : { -0.3, 0.1, 0.5, 0.8 })
  {
    const Vec3 n = t * sun + std::sqrt(1 - t * t) * Normalize(Cross(sun, Axis));
    EXPECT_NEAR(Irradiance(env, n)[0], power * std::max(0.0, t), 2e-5 * power) << t;
    for (double r : { 0.1, 0.5, 0.9 })
    {
      const double a2 = std::pow(r, 4), c = (1 + a2) / (1 - a2);
      const double integral = 2 * Pi * (1 / (c - 1) + std::log(1 - 1 / c));
      const double expected = power * std::max(0.0, t) / ((c - t) * (c - t)) / integral;
      EXPECT_NEAR(PrefilteredRadiance(env, n, r)[0], expected, 3e-4 * expected) << t << ' ' << r;
    }
  }
  const std::vector<RGB> coefficients = HarmonicCoefficients(env, 6);
  const std::vector<double> basis = HarmonicBasis(6, sun);
  for (std::size_t k = 0; k < basis.size(); ++k)
  {
    EXPECT_NEAR(coefficients[k][0], power * basis[k], 6e-4 * power) << k; // l(l+1) h^2/24 of Y ~ 1
  }
}

// Closed forms with their signs, and orthonormality by an independent product rule.
// Mutants: Condon-Shortley sign; sqrt(2) dropped.
TEST(Harmonics, Basis)
{
  const Vec3 d = Normalize({ 0.3, -0.5, 0.7 });
  const std::vector<double> y = HarmonicBasis(8, d);
  const double s3 = std::sqrt(3 / (4 * Pi)), s15 = std::sqrt(15 / (4 * Pi));
  const double expected[9] = { std::sqrt(1 / (4 * Pi)), s3 * d.y, s3 * d.z, s3 * d.x, s15 * d.x * d.y,
    s15 * d.y * d.z, std::sqrt(5 / (16 * Pi)) * (3 * d.z * d.z - 1), s15 * d.x * d.z,
    s15 / 2 * (d.x * d.x - d.y * d.y) };
  for (int k = 0; k < 9; ++k)
  {
    EXPECT_NEAR(y[k], expected[k], 1e-14) << k;
  }
  std::vector<double> gram(81 * 81, 0.0);
  const Environment env = ConstantEnvironment({ 1, 1, 1 }, 120, 60); // 3x3 per texel: exact to 1e-9 at l = 16
  for (int cell = 0; cell < 120 * 60 * 9; ++cell)
  {
    const int texel = cell / 9;
    const double gauss[3] = { 0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15) }, weight[3] = { 5, 8, 5 };
    const Vec3 l = TexelDirection(env, texel / 120, texel % 120, gauss[cell % 3], gauss[cell / 3 % 3]);
    const std::vector<double> b = HarmonicBasis(8, l);
    const double w =
      weight[cell % 3] * weight[cell / 3 % 3] / 324 * std::hypot(l.x, l.z) * 2 * Pi * Pi / 7200;
    for (int k = 0; k < 81 * 81; ++k)
    {
      gram[k] += w * b[k / 81] * b[k % 81];
    }
  }
  for (int k = 0; k < 81 * 81; ++k)
  {
    EXPECT_NEAR(gram[k], k / 81 == k % 81 ? 1 : 0, 1e-7) << k;
  }
}

// Three routes to irradiance: per texel, prefilter at r = 1, harmonics with A_l (Ramamoorthi and Hanrahan 2001,
// eq. 19). 1e-5: 16 x 16 sub-cells at the horizon; 2e-3: bands beyond 12 of A_l < 0.02. Mutant: row order.
TEST(Integrals, IrradianceThreeWays)
{
  const Environment env = Noise(64, 32);
  const int order = 12;
  const std::vector<RGB> coefficients = HarmonicCoefficients(env, order);
  for (const Vec3& n : Directions)
  {
    const double irradiance = Irradiance(env, n)[1];
    EXPECT_NEAR(PrefilteredRadiance(env, n, 1)[1] * Pi, irradiance, 1e-5 * irradiance);
    const std::vector<double> basis = HarmonicBasis(order, n);
    double sum = 0, even = Pi / 2; // A_l = 2 pi (-1)^(l/2-1) / ((l+2)(l-1)) l! / (2^l (l/2)!^2)
    for (int l = 0; l <= order; ++l)
    {
      even *= l > 1 && l % 2 == 0 ? -(l - 1.0) / l : 1;
      const double A = l == 0 ? Pi : l == 1 ? 2 * Pi / 3 : l % 2 ? 0 : -4 * even / ((l + 2.0) * (l - 1));
      for (int m = -l; m <= l; ++m)
      {
        sum += A * coefficients[l * (l + 1) + m][1] * basis[l * (l + 1) + m];
      }
    }
    EXPECT_NEAR(sum, irradiance, 2e-3 * irradiance);
  }
}

// r -> 0 is the mirror: at r = 0.02 the lobe is 2 alpha = 8e-4 rad wide and (8e-4 / 0.035)^2 = 5e-4 of it lies
// beyond a texel 0.07 wide, 45 degrees from the equator. r = 0 is exact. N against 2N at every r.
TEST(Prefilter, MirrorAndConvergence)
{
  const Environment env = Noise(64, 32);
  for (int texel : { 0, 8 * 64 + 16, 20 * 64 + 5, 64 * 32 - 1 })
  {
    const Vec3 n = TexelDirection(env, texel / 64, texel % 64);
    EXPECT_EQ(PrefilteredRadiance(env, n, 0)[1], env.rgb[3 * texel + 1]);
    if (texel > 64 && texel < 64 * 31) // polar texels are narrower
    {
      EXPECT_NEAR(PrefilteredRadiance(env, n, 0.02)[1], env.rgb[3 * texel + 1], 5e-4);
    }
  }
  for (const Vec3& n : Directions)
  {
    for (double r : { 0.02, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0 })
    {
      const double once = PrefilteredRadiance(env, n, r)[1], twice = PrefilteredRadiance(env, n, r, 2)[1];
      EXPECT_NEAR(once, twice, 1e-6 * twice) << r; // 3e-5 per cell, of mixed sign
    }
  }
}

// The definition: half vectors of density D NoH, reflect, weight NoL. 1e-3: 700^2 samples cross texel edges,
// about 700^-1.5 of the mean each. Mutants: wrong c; alpha = r; weight NoL dropped.
TEST(Prefilter, Definition)
{
  const Environment env = Noise(32, 16);
  for (const Vec3& n : Directions)
  {
    for (double r : { 0.1, 0.3, 0.6, 1.0 })
    {
      double sum = 0, total = 0;
      ForEachReflection(n, n, r * r, 700, [&](Vec3 L, Vec3, double weight) {
        sum += weight * Dot(n, L) * Radiance(env, L)[1];
        total += weight * Dot(n, L);
      });
      EXPECT_NEAR(PrefilteredRadiance(env, n, r)[1], sum / total, 1e-3) << r;
    }
  }
}

// Area averages: a constant, the energy of the whole, N against 2N, and dense sampling of single texels.
// n even and odd put the poles at a corner and inside a texel. Mutants: s and t exchanged; pole not seen.
TEST(Cube, TexelAverage)
{
  for (int n : { 1, 4, 5 })
  {
    const Environment env = Noise(63, 31), one = ConstantEnvironment({ 1, 1, 1 }, 63, 31);
    const std::vector<RGB> average = CubeTexelAverages(env, n), finer = CubeTexelAverages(env, n, 64);
    const std::vector<RGB> constant = CubeTexelAverages(one, n);
    double energy = 0, expected = 0;
    for (int k = 0; k < 6 * n * n; ++k)
    {
      const int face = k / n / n, j = k / n % n, i = k % n;
      energy += CubeTexelSolidAngle(n, i, j) * average[k][1];
      EXPECT_NEAR(constant[k][1], 1, 2e-5) << k;          // midpoint rule on the upper and lower side
      EXPECT_NEAR(average[k][1], finer[k][1], 1e-4) << k; // kinks where a side crosses a row's edge
      double sum = 0, total = 0;
      for (int sample = 0; sample < 200 * 200; ++sample)
      {
        const double s = 2 * (i + (sample % 200 + 0.5) / 200) / n - 1,
                     t = 2 * (j + (sample / 200 + 0.5) / 200) / n - 1;
        sum += std::pow(1 + s * s + t * t, -1.5) * Radiance(env, CubeDirection(face, s, t))[1];
        total += std::pow(1 + s * s + t * t, -1.5);
      }
      EXPECT_NEAR(average[k][1], sum / total, 4e-3) << k; // 200^2 samples of texels 1/10 wide
    }
    for (int texel = 0; texel < 63 * 31; ++texel)
    {
      expected += TexelSolidAngle(env, texel / 63) * env.rgb[3 * texel + 1];
    }
    EXPECT_NEAR(energy / expected, 1, 1e-6);
  }
}

// White albedo of the correlated Smith model. 1 - log 2 at r = 1, NoV = 1 is exact. The table comes from
// another quadrature, rounded to 5e-4 and noisy where the lobe is narrow: its 1.000 at r = 0.2, NoV = 1 lies
// above the exact 0.9983, since alpha^2 = 0.0016 of the half vectors reflect below the horizon: 2e-3 there.
// Mutants: VoH dropped; V uncorrelated; Schlick's power 4.
TEST(SplitSum, Albedo)
{
  EXPECT_NEAR(DirectionalAlbedo(1, 1), 1 - std::log(2.0), 3e-6);
  const double NoV[5] = { 0.05, 0.2, 0.5, 0.8, 1 };
  const double table[5][5] = { { .892, .976, .996, .998, 1.000 }, { .928, .870, .926, .958, .968 },
    { .927, .826, .782, .804, .825 }, { .895, .749, .621, .570, .555 }, { .848, .642, .451, .351, .307 } };
  for (int k = 0; k < 25; ++k)
  {
    EXPECT_NEAR(DirectionalAlbedo(NoV[k % 5], 0.2 * (k / 5 + 1)), table[k / 5][k % 5], k < 5 ? 2e-3 : 1e-3)
      << k;
  }
  for (double r : { 0.02, 0.1, 0.4, 1.0 })
  {
    for (double x : { 0.01, 0.1, 0.5, 1.0 })
    {
      for (Geometry geometry : { Geometry::SmithCorrelated, Geometry::SchlickSmith })
      {
        const SplitSum once = SplitSumAB(x, r, geometry), twice = SplitSumAB(x, r, geometry, 2);
        EXPECT_NEAR(once.A, twice.A, 3e-6) << r << ' ' << x;
        EXPECT_NEAR(once.B, twice.B, 3e-6) << r << ' ' << x;
      }
    }
  }
  const SplitSum mirror = SplitSumAB(0.3, 0); // F alone; 3e-8 of the density is cut off
  EXPECT_NEAR(mirror.A + mirror.B, 1, 1e-7);
  EXPECT_NEAR(mirror.B, std::pow(0.7, 5), 1e-7);
}

// Both geometry terms against the textbook form D F G / (4 NoL NoV) NoL over directions L, even steps.
TEST(SplitSum, OverDirections)
{
  const double r = 0.6, alpha = r * r, NoV = 0.4, k = alpha / 2;
  const auto lambda = [&](
                        double x) { return (std::sqrt(1 + alpha * alpha * (1 - x * x) / (x * x)) - 1) / 2; };
  const auto g1 = [&](double x) { return x / (x * (1 - k) + k); };
  double sums[2][2] = {};
  for (int i = 0; i < 1000 * 1000; ++i)
  {
    const double NoL = (i % 1000 + 0.5) / 1000, phi = Pi * (i / 1000 + 0.5) / 1000;
    const Vec3 L = { std::sqrt(1 - NoL * NoL) * std::cos(phi), std::sqrt(1 - NoL * NoL) * std::sin(phi),
      NoL };
    const Vec3 V = { std::sqrt(1 - NoV * NoV), 0, NoV }, H = Normalize(L + V);
    const double b = H.z * H.z * (alpha * alpha - 1) + 1, D = alpha * alpha / (Pi * b * b);
    const double fresnel = std::pow(1 - Dot(V, H), 5);
    const double geometry[2] = { 1 / (1 + lambda(NoL) + lambda(NoV)), g1(NoL) * g1(NoV) };
    for (int g = 0; g < 2; ++g)
    {
      sums[g][0] += D * geometry[g] / (4 * NoV) * (1 - fresnel) * 2 * Pi / 1e6;
      sums[g][1] += D * geometry[g] / (4 * NoV) * fresnel * 2 * Pi / 1e6;
    }
  }
  const SplitSum smith = SplitSumAB(NoV, r), schlick = SplitSumAB(NoV, r, Geometry::SchlickSmith);
  EXPECT_NEAR(smith.A, sums[0][0], 1e-5);
  EXPECT_NEAR(smith.B, sums[0][1], 1e-5);
  EXPECT_NEAR(schlick.A, sums[1][0], 1e-5);
  EXPECT_NEAR(schlick.B, sums[1][1], 1e-5);
}

// Constant unit radiance: f0 A + B, and at N = V a diffuse part of one dimension, with VoH = sqrt((1+t)/2):
// albedo (1-f0) integral of (1 - (1-VoH)^5) 2 t dt. 1e-5: 3e-6 from A and B, the rest from the horizon.
// Mutant: 1-F dropped.
TEST(FullBRDF, ConstantEnvironment)
{
  const Environment env = ConstantEnvironment({ 1, 1, 1 }, 64, 32);
  const RGB f0 = { 0.04, 0.5, 1 }, black = { 0, 0, 0 }, albedo = { 0.8, 0.6, 0.4 };
  double diffuse = 0;
  for (int i = 0; i < 10000; ++i)
  {
    const double t = (i + 0.5) / 10000;
    diffuse += (1 - std::pow(1 - std::sqrt((1 + t) / 2), 5)) * 2 * t / 10000;
  }
  for (const Vec3& N : Directions)
  {
    const Vec3 T = Normalize(Cross(N, Axis));
    for (double r : { 0.02, 0.1, 0.3, 0.6, 1.0 })
    {
      for (double NoV : { 0.1, 0.5, 1.0 })
      {
        const SplitSum sum = SplitSumAB(NoV, r);
        const Vec3 V = NoV * N + std::sqrt(1 - NoV * NoV) * T;
        const RGB specular = FullBRDFRadiance(env, N, V, r, f0, black);
        const RGB both = FullBRDFRadiance(env, N, V, r, f0, albedo);
        for (int c = 0; c < 3; ++c)
        {
          EXPECT_NEAR(specular[c], f0[c] * sum.A + sum.B, 1e-5) << r << ' ' << NoV;
          if (NoV == 1)
          {
            EXPECT_NEAR(both[c] - specular[c], albedo[c] * (1 - f0[c]) * diffuse, 1e-5);
          }
        }
      }
    }
  }
}

// Half vectors again: weight 4 V F VoH NoL / NoH. 1e-3 as for the prefilter, 2e-3 at NoV = 0.05, where most half
// vectors reflect below the horizon (with 3500^2 samples all agree to 2.5e-4). Then N against 2N.
// Mutant: lobe about V, not its mirror image.
TEST(FullBRDF, DefinitionAndConvergence)
{
  const Environment env = Noise(32, 16);
  const RGB f0 = { 0.04, 0.5, 1 }, black = { 0, 0, 0 }, albedo = { 0.8, 0.6, 0.4 };
  for (const Vec3& N : Directions)
  {
    for (double r : { 0.1, 0.3, 0.6, 1.0 })
    {
      for (double NoV : { 0.05, 0.5, 0.95 })
      {
        const Vec3 V = NoV * N + std::sqrt(1 - NoV * NoV) * Normalize(Cross(N, Axis));
        double sum = 0;
        ForEachReflection(N, V, r * r, 700, [&](Vec3 L, Vec3 H, double weight) {
          const double VoH = Dot(V, H), NoL = Dot(N, L), fresnel = f0[1] + (1 - f0[1]) * std::pow(1 - VoH, 5);
          sum += weight * 4 * V_SmithGGXCorrelated(NoL, NoV, r * r) * fresnel * VoH * NoL / Dot(N, H) *
            Radiance(env, L)[1];
        });
        EXPECT_NEAR(FullBRDFRadiance(env, N, V, r, f0, black)[1], sum, NoV < 0.1 ? 2e-3 : 1e-3)
          << r << ' ' << NoV;
        const double once = FullBRDFRadiance(env, N, V, r, f0, albedo)[1];
        const double twice = FullBRDFRadiance(env, N, V, r, f0, albedo, 2)[1];
        EXPECT_NEAR(once, twice, 1e-5 * twice) << r << ' ' << NoV;
      }
    }
  }
}

// Each part alone. Constant unit radiance: A + B, B, 1 and, at N = V, the diffuse weight's integral of one dimension;
// any other: irradiance / pi, whose closed form knows nothing of the surface. f0 = f90 is a Fresnel term of one value.
// 1e-5 as above. Mutants: f90 on the wrong part; w dropped from or given to one part; 1/pi dropped.
TEST(FullBRDF, Parts)
{
  const Environment one = ConstantEnvironment({ 1, 1, 1 }, 64, 32), env = Noise(32, 16);
  double entering = 0;
  for (int i = 0; i < 10000; ++i)
  {
    const double t = (i + 0.5) / 10000;
    entering += std::pow(1 - std::sqrt((1 + t) / 2), 5) * 2 * t / 10000;
  }
  for (const Vec3& N : Directions)
  {
    const Vec3 V = Normalize(0.4 * N + 0.9 * Normalize(Cross(N, Axis)));
    const SplitSum sum = SplitSumAB(Dot(N, V), 0.5);
    const ReflectedParts parts = FullBRDFParts(one, N, V, 0.5);
    EXPECT_NEAR(parts.White[0], sum.A + sum.B, 1e-5);
    EXPECT_NEAR(parts.WhiteSchlick[0], sum.B, 1e-5);
    EXPECT_NEAR(parts.Lambert[0], 1, 1e-5);
    EXPECT_NEAR(FullBRDFParts(one, N, N, 0.5).LambertSchlick[0], entering, 1e-5);
    const ReflectedParts noise = FullBRDFPartsAll(env, { N }, V, 0.5)[0];
    EXPECT_NEAR(noise.Lambert[1] * Pi, Irradiance(env, N)[1], 3e-5); // its own 1.3e-5 at 32 x 16
    const RGB flat = { 0.3, 0.3, 0.3 }, albedo = { 0.5, 0.5, 0.5 };
    EXPECT_NEAR(noise.Combine(flat, flat, albedo)[1], 0.3 * noise.White[1] + 0.35 * noise.Lambert[1], 1e-15);
    const RGB black = { 0, 0, 0 }, white = { 1, 1, 1 };
    EXPECT_NEAR(noise.Combine(black, white, black)[1], noise.WhiteSchlick[1], 1e-15);
    EXPECT_NEAR(noise.Combine(black, white, white)[1],
      noise.WhiteSchlick[1] + noise.Lambert[1] - noise.LambertSchlick[1], 1e-15);
  }
}

// Of equal alphas, the isotropic surface, however it is turned. Rounding, and 1e-5 between the two rules for A and B.
// Mutants: alphaT for alphaB anywhere; no 1/alphaT in D.
TEST(Anisotropic, EqualAlphasAreIsotropic)
{
  const Vec3 N = Directions[6], V = Normalize(N + 1.5 * Normalize(Cross(N, Axis)));
  for (double alpha : { 4e-4, 0.04, 0.5, 1.0 })
  {
    for (const Vec3& tangent : { Axis, Vec3{ 0, 1, 0 }, Vec3{ 1, 0, 0 } })
    {
      const Facets facets(N, tangent, alpha, alpha);
      for (double tilt : { 1e-4, 0.1, 0.8 })
      {
        const Vec3 H = Normalize(N + tilt * facets.T + tilt / 2 * facets.B), across = Cross(N, H);
        const double D = D_GGX(Dot(across, across), alpha);
        EXPECT_NEAR(facets.D(H), D, 1e-10 * D) << alpha << ' ' << tilt;
        const double visibility = V_SmithGGXCorrelated(Dot(N, H), Dot(N, V), alpha);
        EXPECT_NEAR(facets.Visibility(H, V), visibility, 1e-12 * visibility) << alpha << ' ' << tilt;
      }
    }
    for (double NoV : { 0.05, 0.5, 1.0 })
    {
      const double sine = std::sqrt(1 - NoV * NoV);
      const SplitSum turned = AnisotropicSplitSumAB({ 0.6 * sine, -0.8 * sine, NoV }, alpha, alpha);
      const SplitSum sum = SplitSumAB(NoV, std::sqrt(alpha));
      EXPECT_NEAR(turned.A, sum.A, 1e-5) << alpha << ' ' << NoV;
      EXPECT_NEAR(turned.B, sum.B, 1e-5) << alpha << ' ' << NoV;
    }
  }
}

// Masking follows from the distribution: the facets that V sees cover what V sees of the surface,
//   integral of D max(V.h, 0) dw_h = (1 + Lambda(V)) N.V   (Heitz 2014, on the masking function).
// 1e-4: midpoint rule with a kink. Mutants: alphas exchanged in Visibility or in D.
TEST(Anisotropic, MaskingFromDistribution)
{
  const Vec3 N = { 0, 0, 1 }, T = { 1, 0, 0 };
  const double alphas[3][2] = { { 0.1, 0.6 }, { 0.9, 0.2 }, { 0.02, 0.3 } };
  for (const auto& alpha : alphas)
  {
    for (const Vec3& V : { Normalize({ 1, 0, 0.3 }), Normalize({ 0, 1, 0.3 }), Normalize({ -0.5, 0.4, 0.6 }) })
    {
      double seen = 0;
      ForEachHalfVector(N, T, V, alpha[0], alpha[1], 700,
        [&](Vec3, Vec3 H, double weight) { seen += weight * std::max(0.0, Dot(V, H)) / Dot(N, H); });
      const double root = 1 / (4 * V.z * Facets(N, T, alpha[0], alpha[1]).Visibility(V, V));
      EXPECT_NEAR(seen, (V.z + root) / 2, 1e-4) << alpha[0] << ' ' << V.x;
    }
  }
}

// The definition by half vectors, as of the isotropic surface, and constant unit radiance against the split sum; N
// against 2N of both; T and B exchanged with their alphas is the same surface. 2e-3 as there.
// Mutants: T not made normal to N; Q without one alpha; the scale of the larger alpha.
TEST(Anisotropic, DefinitionAndConvergence)
{
  const Environment one = ConstantEnvironment({ 1, 1, 1 }, 64, 32), env = Noise(32, 16);
  const double alphas[4][2] = { { 0.05, 0.4 }, { 0.8, 0.1 }, { 1, 0.3 }, { 0.01, 0.02 } };
  for (int k = 0; k < 4 * 3; ++k)
  {
    const double alphaT = alphas[k / 3][0], alphaB = alphas[k / 3][1];
    const double NoV = k % 3 == 0 ? 0.1 : k % 3 == 1 ? 0.6 : 1, sine = std::sqrt(1 - NoV * NoV);
    const Vec3 local = { 0.6 * sine, 0.8 * sine, NoV };
    const SplitSum sum = AnisotropicSplitSumAB(local, alphaT, alphaB);
    const SplitSum finer = AnisotropicSplitSumAB(local, alphaT, alphaB, 2);
    EXPECT_NEAR(sum.A, finer.A, 3e-6) << alphaT << ' ' << NoV;
    EXPECT_NEAR(sum.B, finer.B, 3e-6) << alphaT << ' ' << NoV;
    for (const Vec3& N : { Directions[1], Directions[2], Directions[6] })
    {
      const Facets facets(N, Axis, alphaT, alphaB);
      const Vec3 V = local.x * facets.T + local.y * facets.B + NoV * N;
      const ReflectedParts furnace = AnisotropicBRDFParts(one, facets, V);
      EXPECT_NEAR(furnace.White[1], sum.A + sum.B, 1e-5) << alphaT << ' ' << NoV;
      EXPECT_NEAR(furnace.WhiteSchlick[1], sum.B, 1e-5) << alphaT << ' ' << NoV;

      const double white = AnisotropicBRDFParts(env, facets, V).White[1];
      const double twice = AnisotropicBRDFParts(env, facets, V, 2).White[1];
      EXPECT_NEAR(white, twice, 1e-5 * twice) << alphaT << ' ' << NoV;
      const Facets exchanged(N, facets.B, alphaB, alphaT);
      EXPECT_NEAR(white, AnisotropicBRDFParts(env, exchanged, V).White[1], 1e-12) << alphaT << ' ' << NoV;
      double defined = 0;
      ForEachHalfVector(N, facets.T, V, alphaT, alphaB, 700, [&](Vec3 L, Vec3 H, double weight) {
        const double NoL = Dot(N, L);
        if (NoL > 0)
        {
          defined += weight * 4 * facets.Visibility(L, V) * Dot(V, H) * NoL / Dot(N, H) * Radiance(env, L)[1];
        }
      });
      EXPECT_NEAR(white, defined, 2e-3) << alphaT << ' ' << NoV;
    }
  }
}

// A white base under an untinted coat is white in a furnace, whatever the coat: 1e-5 as for A and B. Without
// strength, the tinted base; over black, the coat alone. Mutants: E = F0 (A + B); the tint dropped; s on one side.
TEST(Coat, FurnaceAndParts)
{
  const Environment one = ConstantEnvironment({ 1, 1, 1 }, 64, 32);
  const RGB tint = { 0.9, 0.5, 0.1 }, base = { 0.2, 0.4, 0.8 }, white = { 1, 1, 1 };
  const Vec3 N = Directions[3];
  for (double r : { 0.05, 0.3, 1.0 })
  {
    for (double NoV : { 0.1, 0.7, 1.0 })
    {
      const Vec3 V = NoV * N + std::sqrt(1 - NoV * NoV) * Normalize(Cross(N, Axis));
      const SplitSum sum = SplitSumAB(NoV, r);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(CoatedRadiance(one, N, V, { 0.04, r, 1.0, white }, white)[c], 1, 1e-5) << r << ' ' << NoV;
        EXPECT_NEAR(CoatedRadiance(one, N, V, { 0.2, r, 0.5, white }, white)[c], 1, 1e-5) << r << ' ' << NoV;
        EXPECT_NEAR(CoatedRadiance(one, N, V, { 0.2, r, 0.0, tint }, base)[c], tint[c] * base[c], 1e-15);
        EXPECT_NEAR(
          CoatedRadiance(one, N, V, { 0.2, r, 0.5, tint }, { 0, 0, 0 })[c], 0.5 * (0.2 * sum.A + sum.B), 1e-5);
      }
    }
  }
}

// The same bits from one thread and from five. Mutant: one sum shared by the threads.
TEST(Support, Threads)
{
  const Environment env = Noise(64, 32);
  SetThreadCount(1);
  const auto harmonics = HarmonicCoefficients(env, 4);
  const auto sharp = PrefilterAll(env, Directions, 0.2), flat = IrradianceAll(env, Directions);
  SetThreadCount(5);
  EXPECT_EQ(HarmonicCoefficients(env, 4), harmonics);
  EXPECT_EQ(PrefilterAll(env, Directions, 0.2), sharp);
  EXPECT_EQ(IrradianceAll(env, Directions), flat);
  SetThreadCount(0);
}

// Computed once per key, and again when the file is cut short, changed by one byte, or the directory missing.
// Mutants: hash not compared; key not compared.
TEST(Support, Cache)
{
  const std::filesystem::path directory = std::filesystem::temp_directory_path() /
    ("vtkibl-reference-test-" + std::to_string(std::random_device{}()));
  setenv("VTKIBL_REFERENCE_CACHE", directory.c_str(), 1);
  int computed = 0;
  const auto answer = [&](const std::string& key) {
    return Cached<RGB>(key, [&] {
      ++computed;
      return std::vector<RGB>{ { 1, 2, 3 }, { 4, 5, 0.1 } };
    });
  };
  const std::vector<RGB> first = answer("a");
  EXPECT_EQ(answer("a"), first);
  EXPECT_EQ(computed, 1);
  const std::filesystem::path file = std::filesystem::directory_iterator(directory)->path();
  answer("b");
  EXPECT_EQ(computed, 2);
  for (const auto& entry : std::filesystem::directory_iterator(directory)) // a's answer under b's name
  {
    if (entry.path() != file)
    {
      std::filesystem::copy_file(file, entry.path(), std::filesystem::copy_options::overwrite_existing);
    }
  }
  answer("b");
  EXPECT_EQ(computed, 3);
  std::fstream(file, std::ios::in | std::ios::out | std::ios::binary)
    .seekp(static_cast<std::streamoff>(std::filesystem::file_size(file)) - 20)
    .put('x');
  EXPECT_EQ(answer("a"), first);
  EXPECT_EQ(computed, 4);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 7);
  EXPECT_EQ(answer("a"), first);
  EXPECT_EQ(computed, 5);
  EXPECT_EQ(answer("a"), first);
  EXPECT_EQ(computed, 5);
  std::filesystem::remove_all(directory);
  EXPECT_EQ(answer("a"), first);
  EXPECT_EQ(computed, 6);
  std::filesystem::remove_all(directory);
  unsetenv("VTKIBL_REFERENCE_CACHE");
  EXPECT_NE(KeyOf(Noise(8, 4)), KeyOf(Noise(4, 8)));
}
