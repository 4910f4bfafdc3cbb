// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TestSupport.h"

#include "vtkIBLCubeMap.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLIrradiance.h"

namespace reference = vtkIBLReference;
using reference::Pi;

class TestIrradianceGL : public GLTest
{
protected:
  vtkNew<vtkIBLEnvironment> Environment;
  vtkNew<vtkIBLCubeMap> CubeMap;
  vtkNew<vtkIBLIrradiance> Irradiance;

  void Bake()
  {
    this->CubeMap->SetEnvironment(this->Environment);
    this->Irradiance->SetCubeMap(this->CubeMap);
    ASSERT_TRUE(this->Irradiance->Update(this->Window));
  }
  RGB Evaluate(Vec3 normal)
  {
    RGB rgb;
    this->Irradiance->GetIrradiance(&normal.x, rgb.data());
    return rgb;
  }
};

namespace
{
const std::vector<Vec3> Normals = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 },
  reference::Normalize({ 1, 2, -3 }), reference::Normalize({ -1, 1, 1 }) };
}

// A constant environment of radiance c gives irradiance pi c in every direction. Rows in float, sums in double: 1e-5.
// Mutant: dropped solid angle.
TEST_F(TestIrradianceGL, OfAConstantIsPiTimesIt)
{
  this->Environment->SetInputData(MakePanorama(64, [](Vec3) { return RGB{ 0.5, 1, 7 }; }));
  this->Bake();
  for (Vec3 n : Normals)
  {
    EXPECT_NEAR(this->Evaluate(n)[0], 0.5 * Pi, 0.5 * Pi * 1e-5);
    EXPECT_NEAR(this->Evaluate(n)[1], Pi, Pi * 1e-5);
    EXPECT_NEAR(this->Evaluate(n)[2], 7 * Pi, 7 * Pi * 1e-5);
  }
}

// L = 1 + cos(theta) around any axis gives pi + (2 pi/3) cos(theta). Bands 0 and 1 hold all of it; what is left is the
// panorama's texel means, 1e-4. Mutants: a swapped axis, 2 pi/3 written pi/2, the Condon-Shortley sign.
TEST_F(TestIrradianceGL, OfACosineIsACosine)
{
  for (Vec3 axis : Normals)
  {
    this->Environment->SetInputData(MakePanorama(256,
      [&](Vec3 d)
      {
        const double l = 1 + reference::Dot(axis, d);
        return RGB{ l, 2 * l, 0.1 * l };
      }));
    this->Bake();
    for (Vec3 n : Normals)
    {
      const double truth = Pi + 2 * Pi / 3 * reference::Dot(axis, n);
      EXPECT_NEAR(this->Evaluate(n)[0], truth, 1e-3);
      EXPECT_NEAR(this->Evaluate(n)[1], 2 * truth, 2e-3);
    }
  }
}

// Real HDRIs: each coefficient against the double-precision sum over the panorama. The cube holds a light somewhere in
// a texel as if at its centre, up to 0.003 rad away at 256^2; so interior, 40 % of whose light comes from a few texels,
// is off by up to 2e-4 of the largest coefficient, and courtyard, without such lights, by less than 1e-4. Then
// reconstructed irradiance against the integral itself, within what nine coefficients can hold: below 10 % in relative
// L1.
TEST_F(TestIrradianceGL, OfRealPanoramasAgreesWithTheReference)
{
  for (auto [name, tolerance] : { std::pair{ "courtyard", 1e-4 }, { "interior", 2e-4 } })
  {
    const std::string path = GetHDRI(name);
    if (path.empty())
    {
      GTEST_SKIP() << "no HDRIs: install blender-data";
    }
    this->Environment->SetFileName(path.c_str());
    this->Bake();
    const reference::Environment environment = ToReference(this->Environment->GetRadianceImage());
    const auto truth = reference::Cached<RGB>(
      "harmonics 2 " + reference::KeyOf(environment), [&] { return reference::HarmonicCoefficients(environment, 2); });
    for (int i = 0; i < 9; ++i)
    {
      RGB rgb;
      this->Irradiance->GetRadianceCoefficient(i, rgb.data());
      for (int k = 0; k < 3; ++k)
      {
        EXPECT_NEAR(rgb[k], truth[i][k], tolerance * truth[0][k]) << name << " coefficient " << i;
      }
    }
    const std::vector<Vec3> normals = GetCubeDirections(4);
    const auto irradiance =
      reference::Cached<RGB>("irradiance " + reference::KeyOf(environment) + reference::KeyOf(normals),
        [&] { return reference::IrradianceAll(environment, normals); });
    double difference = 0;
    double sum = 0;
    for (std::size_t i = 0; i < normals.size(); ++i)
    {
      difference += std::abs(this->Evaluate(normals[i])[1] - irradiance[i][1]);
      sum += irradiance[i][1];
    }
    std::printf("%s: irradiance, nine coefficients, relative L1 %.3f\n", name, difference / sum);
    EXPECT_LT(difference / sum, 0.10);
  }
}

// What the shader evaluates is what GetIrradiance() says, over pi. Float polynomial: 1e-6. Mutant: a basis constant in
// one of the two.
TEST_F(TestIrradianceGL, PolynomialIsIrradianceOverPi)
{
  this->Environment->SetInputData(MakePanorama(64,
    [](Vec3 d) {
      return RGB{ 2 + d.x * d.y + d.z, 3 + d.z * d.z - d.y, 2 + d.y * d.z + d.x * d.x };
    }));
  this->Bake();
  float f[9][3];
  this->Irradiance->GetPolynomial(f);
  for (Vec3 n : Normals)
  {
    const double basis[9] = { 1, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3 * n.z * n.z - 1, n.x * n.z,
      n.x * n.x - n.y * n.y };
    for (int k = 0; k < 3; ++k)
    {
      double sum = 0;
      for (int i = 0; i < 9; ++i)
      {
        sum += f[i][k] * basis[i];
      }
      EXPECT_NEAR(sum, this->Evaluate(n)[k] / Pi, 1e-5);
    }
  }
}

// A small strong sun makes nine coefficients ring below zero on the far side; irradiance is clamped there. Mutant: no
// max().
TEST_F(TestIrradianceGL, IsNeverNegative)
{
  this->Environment->SetInputData(MakePanorama(64,
    [](Vec3 d) {
      return d.y > 0.995 ? RGB{ 1e4, 1e4, 1e4 } : RGB{ 0, 0, 0 };
    }));
  this->Bake();
  bool clamped = false;
  for (Vec3 n : GetCubeDirections(8))
  {
    EXPECT_GE(this->Evaluate(n)[0], 0.0);
    clamped = clamped || this->Evaluate(n)[0] == 0.0;
  }
  EXPECT_TRUE(clamped); // else this tests nothing
}
