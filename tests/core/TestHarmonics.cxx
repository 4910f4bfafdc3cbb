// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLHarmonics.h"
#include "vtkIBLShaderFunctions.h"

#include "Reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace reference = vtkIBLReference;
using reference::Pi;
using reference::RGB;
using reference::Vec3;

namespace
{
const vtkIBLParallelFor Serial = [](int count, const std::function<void(int)>& body)
{
  for (int i = 0; i < count; ++i)
  {
    body(i);
  }
};

// Axes, poles, and some between.
const std::vector<Vec3> Directions = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 },
  reference::Normalize({ 1, 2, -3 }), reference::Normalize({ -1, 1, 1 }), reference::Normalize({ 0.3, -0.1, 0.05 }) };

glm::dvec3 ToGLM(Vec3 v)
{
  return { v.x, v.y, v.z };
}

// Asymmetric in every way, a colour a channel, and one texel of 1e4 in a lower corner.
reference::Environment MakeSky(int width, bool sun)
{
  reference::Environment sky{ width, width / 2, {} };
  for (int row = 0; row < sky.height; ++row)
  {
    for (int column = 0; column < sky.width; ++column)
    {
      const Vec3 d = reference::TexelDirection(sky, row, column);
      const bool isSun = sun && row == sky.height / 5 && column == sky.width / 7;
      sky.rgb.push_back(isSun ? 1e4 : 2 + d.x - 0.7 * d.y * d.z);
      sky.rgb.push_back(isSun ? 2e4 : std::exp(2 * (0.6 * d.x - 0.8 * d.z)));
      sky.rgb.push_back(isSun ? 5e3 : 1 + std::sin(3 * d.y + d.x) * d.z);
    }
  }
  return sky;
}

struct Projected
{
  vtkIBLHarmonics Harmonics; // without the bright texels
  std::vector<vtkIBLBrightTexel> BrightTexels;
};

Projected Project(const reference::Environment& environment, int order)
{
  std::vector<float> pixels(environment.rgb.begin(), environment.rgb.end());
  vtkIBLRadianceImage image;
  image.RGB = pixels.data();
  image.Width = environment.width;
  image.Height = environment.height;
  const vtkIBLSpectrum spectrum(image, order, Serial);
  return { vtkIBLMakeHarmonics(spectrum, order), spectrum.GetBrightTexels() };
}

// 1 in the first coefficient, and different everywhere.
vtkIBLHarmonics MakeAnyHarmonics(int order)
{
  vtkIBLHarmonics harmonics(order);
  for (int i = 0; i < (order + 1) * (order + 1); ++i)
  {
    harmonics.RGB[i] = { std::cos(7.0 * i), std::sin(5.0 * i + 1), std::cos(3.0 * i * i) };
  }
  return harmonics;
}

glm::dvec3 Evaluate(const vtkIBLHarmonics& harmonics, const glm::dvec3& direction)
{
  const std::vector<double> basis =
    reference::HarmonicBasis(harmonics.Order, { direction.x, direction.y, direction.z });
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < basis.size(); ++i)
  {
    sum += basis[i] * harmonics.RGB[i];
  }
  return sum;
}

// Around an axis, columns first; `reflect` turns it inside out besides.
glm::dmat3 MakeMatrix(const glm::dvec3& axis, double angle, bool reflect)
{
  const glm::dvec3 a = glm::normalize(axis);
  glm::dmat3 matrix;
  for (int k = 0; k < 3; ++k)
  {
    glm::dvec3 unit(0.0);
    unit[k] = 1.0;
    matrix[k] = std::cos(angle) * unit + std::sin(angle) * glm::cross(a, unit) + (1 - std::cos(angle)) * a[k] * a;
  }
  return reflect ? -1.0 * matrix : matrix;
}
}

// All 81 against the witness's own, at poles too; doubles' rounding. Mutants: the Condon-Shortley sign, m and -m
// swapped, sqrt 2 left out, y polar.
TEST(TestHarmonics, BasisIsTheWitness)
{
  for (Vec3 d : Directions)
  {
    const std::vector<double> truth = reference::HarmonicBasis(8, d);
    const auto basis = vtkIBLHarmonicBasis(8, ToGLM(d));
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
      EXPECT_NEAR(basis[i], truth[i], 1e-13) << i;
    }
  }
}

// A lat-long image by its spectrum, bright texels added, against the integral in double. Single-precision sums: 1e-6 of
// the mean's coefficient; two Gauss points a slice of latitude: 1e-5 where rows are three. The sun is a point to us and
// a texel of 0.05 rad to the witness, (8 x 0.05)^2/24 of its band: 6e-3. Mutants: the sine's minus, y and z not
// swapped, bright texels not added, their solid angle.
TEST(TestHarmonics, OfALatLongImageAreTheIntegral)
{
  for (auto [width, sun, tolerance] : { std::tuple{ 128, false, 1e-6 }, { 6, false, 1e-5 }, { 128, true, 6e-3 } })
  {
    const reference::Environment sky = MakeSky(width, sun);
    Projected projected = Project(sky, 8);
    ASSERT_EQ(projected.BrightTexels.size(), sun ? 1u : 0u);
    vtkIBLAddBrightTexels(projected.BrightTexels, projected.Harmonics);
    const std::vector<RGB> truth = reference::HarmonicCoefficients(sky, 8);
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        EXPECT_NEAR(projected.Harmonics.RGB[i][k], truth[i][k], tolerance * truth[0][k]) << width << " " << i;
      }
    }
  }
}

// Of faces, by the same light: f = 1 + all of bands 1 to 8 at texel centres. A texel's light at its centre costs (8 x
// pi/2/n)^2/24 of band 8 at n = 128: 4e-4; less is cut first, so 2^2 and 3^2 keep a constant constant. Mutants: a
// face's axis, solid angle of the wrong cell, not cut.
TEST(TestHarmonics, OfFacesAreTheIntegral)
{
  const vtkIBLHarmonics light = MakeAnyHarmonics(8);
  for (int n : { 1, 2, 3, 128 })
  {
    std::vector<float> pixels;
    for (int texel = 0; texel < 6 * n * n; ++texel)
    {
      const Vec3 d =
        reference::CubeDirection(texel / (n * n), 2 * (texel % n + 0.5) / n - 1, 2 * (texel / n % n + 0.5) / n - 1);
      const glm::dvec3 rgb = n < 128 ? glm::dvec3(1.0) : Evaluate(light, ToGLM(d));
      pixels.insert(pixels.end(), { float(rgb.x), float(rgb.y), float(rgb.z) });
    }
    vtkIBLRadianceImage faces;
    faces.RGB = pixels.data();
    faces.Width = faces.Height = n;
    faces.Faces = 6;
    const vtkIBLHarmonics harmonics = vtkIBLMakeHarmonics(faces, 8, Serial);
    for (int i = 0; i < 81; ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        const double truth = n == 128 ? light.RGB[i][k] : i == 0 ? std::sqrt(4 * Pi) : 0.0;
        EXPECT_NEAR(harmonics.RGB[i][k], truth, 1e-3) << n << " " << i;
      }
    }
  }
}

// Turned coefficients give at d what the old ones give at M d, for rotations, reflections and the swap of two axes.
// Doubles' rounding, eight bands deep. Mutants: the transposed matrix, any sign of u, v, w, sqrt 2 for |m| = 1.
TEST(TestHarmonics, TurnAsTheirLightDoes)
{
  const vtkIBLHarmonics light = MakeAnyHarmonics(8);
  const glm::dmat3 swap = { { 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 } };
  for (const glm::dmat3& matrix :
    { glm::dmat3(1.0), swap, MakeMatrix({ 0, 0, 1 }, 0.5 * Pi, false), MakeMatrix({ 1, 0, 0 }, Pi, false),
      MakeMatrix({ 1, -2, 3 }, 0.7, false), MakeMatrix({ -3, 1, 0.2 }, 2.9, true) })
  {
    const vtkIBLHarmonics turned = vtkIBLTurnHarmonics(light, matrix);
    for (Vec3 d : Directions)
    {
      const glm::dvec3 error = Evaluate(turned, ToGLM(d)) - Evaluate(light, matrix * ToGLM(d));
      EXPECT_LT(glm::length(error), 1e-12);
    }
  }
}

// A_l = 2 pi integral of t P_l(t) over [0, 1] (Ramamoorthi & Hanrahan 2001). Rounding. Mutant: a sign.
TEST(TestHarmonics, CosineBands)
{
  const double truth[] = { Pi, 2 * Pi / 3, Pi / 4, 0, -Pi / 24, 0, Pi / 64, 0, -Pi / 128 };
  for (int l = 0; l <= 8; ++l)
  {
    EXPECT_NEAR(vtkIBLCosineBand(l), truth[l], 1e-14) << l;
  }
}

// Irradiance by three orders, bright texels in the coefficients or apart, against the integral, relative L1. A smooth
// sky with one texel that holds much of the light: what is kept apart is exact, what is not rings. Bounds are twice
// what was measured. Mutants: texels counted twice, a band's sign.
TEST(TestHarmonics, IrradianceConverges)
{
  const reference::Environment sky = MakeSky(128, true);
  std::vector<Vec3> normals = Directions;
  for (int i = 0; i < 60; ++i)
  {
    normals.push_back(reference::TexelDirection(sky, 1 + i, (37 * i) % 128));
  }
  const std::vector<RGB> truth = reference::IrradianceAll(sky, normals);
  for (auto [order, apart, bound] : { std::tuple{ 2, false, 0.08 }, { 4, false, 0.04 }, { 8, false, 0.015 },
         { 2, true, 3e-3 }, { 4, true, 1e-3 }, { 8, true, 5e-4 } })
  {
    Projected projected = Project(sky, order);
    if (!apart)
    {
      vtkIBLAddBrightTexels(projected.BrightTexels, projected.Harmonics);
      projected.BrightTexels.clear();
    }
    double difference = 0;
    double sum = 0;
    for (std::size_t i = 0; i < normals.size(); ++i)
    {
      const glm::dvec3 value = vtkIBLEvaluateIrradiance(projected.Harmonics, projected.BrightTexels, ToGLM(normals[i]));
      for (int k = 0; k < 3; ++k)
      {
        difference += std::abs(value[k] - truth[i][k]);
        sum += truth[i][k];
      }
    }
    std::printf("order %d, bright texels %s: %.1e\n", order, apart ? "apart" : "in", difference / sum);
    EXPECT_LT(difference / sum, bound) << order << apart;
  }
}

// One light alone: in the coefficients it rings below zero on the far side, which is clamped; apart, a surface turned
// away gets nothing, and one that faces it radiance times solid angle. Mutants: no max() in either.
TEST(TestHarmonics, IrradianceIsNeverNegative)
{
  const std::vector<vtkIBLBrightTexel> sun = { { ToGLM(Directions[6]), 1e-4, { 1e4, 2e4, 3e4 } } };
  for (int order : { 2, 4, 8 })
  {
    vtkIBLHarmonics harmonics(order);
    vtkIBLAddBrightTexels(sun, harmonics);
    double least = 1.0;
    for (Vec3 n : Directions)
    {
      least = std::min(least, vtkIBLEvaluateIrradiance(harmonics, {}, ToGLM(n)).x);
    }
    EXPECT_EQ(least, 0.0) << order;
  }
  EXPECT_EQ(vtkIBLEvaluateIrradiance(vtkIBLHarmonics(2), sun, -sun[0].Direction), glm::dvec3(0.0));
  EXPECT_LT(
    glm::length(vtkIBLEvaluateIrradiance(vtkIBLHarmonics(2), sun, sun[0].Direction) - glm::dvec3(1, 2, 3)), 1e-12);
}

// Seven vectors say what nine coefficients say, over pi: rounding. Mutants: a constant, xz for yz, 3 z^2 without its
// -1.
TEST(TestHarmonics, PackedIsTheSame)
{
  vtkIBLHarmonics light = MakeAnyHarmonics(4);
  light.RGB[0] *= 20.0; // else half of it is clamped
  vtkIBLHarmonics nine(2);
  std::copy_n(light.RGB.begin(), 9, nine.RGB.begin());
  auto packed = vtkIBLPackIrradiance(light);
  vtkIBLCore::ShaderFunctions<double> shader;
  for (Vec3 d : Directions)
  {
    const glm::dvec3 truth = vtkIBLEvaluateIrradiance(nine, {}, ToGLM(d)) / Pi;
    EXPECT_LT(glm::length(shader.iblPackedIrradiance(packed.data(), ToGLM(d)) - truth), 1e-13);
  }
}
