// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TestSupport.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLIrradiance.h"

namespace reference = vtkIBLReference;
using reference::Pi;

class TestIrradianceGL : public GLTest
{
protected:
  vtkNew<vtkIBLEnvironment> Environment;
  vtkNew<vtkIBLIrradiance> Irradiance;

  void Bake()
  {
    this->Irradiance->SetEnvironment(this->Environment);
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

const std::vector<std::string> HDRIs = { "city", "courtyard", "forest", "interior", "night", "studio", "sunrise",
  "sunset" };
}

// A constant environment of radiance c gives irradiance pi c in every direction, as a panorama and as faces. Sums in
// single precision: 1e-5. Mutant: dropped solid angle.
TEST_F(TestIrradianceGL, OfAConstantIsPiTimesIt)
{
  const auto constant = [](Vec3) { return RGB{ 0.5, 1, 7 }; };
  for (auto* make : { MakePanorama, MakeFaces })
  {
    this->Environment->SetInputData(make(64, constant));
    this->Bake();
    for (Vec3 n : Normals)
    {
      EXPECT_NEAR(this->Evaluate(n)[0], 0.5 * Pi, 0.5 * Pi * 1e-5);
      EXPECT_NEAR(this->Evaluate(n)[1], Pi, Pi * 1e-5);
      EXPECT_NEAR(this->Evaluate(n)[2], 7 * Pi, 7 * Pi * 1e-5);
    }
  }
}

// L = 1 + cos(theta) around any axis gives pi + (2 pi/3) cos(theta). Bands 0 and 1 hold all of it; what is left is the
// texels' means, 1e-4. Mutants: a swapped axis, 2 pi/3 written pi/2, the Condon-Shortley sign.
TEST_F(TestIrradianceGL, OfACosineIsACosine)
{
  for (Vec3 axis : Normals)
  {
    const auto cosine = [&](Vec3 d)
    {
      const double l = 1 + reference::Dot(axis, d);
      return RGB{ l, 2 * l, 0.1 * l };
    };
    for (const auto& image : { MakePanorama(256, cosine), MakeFaces(128, cosine) })
    {
      this->Environment->SetInputData(image);
      this->Bake();
      for (Vec3 n : Normals)
      {
        const double truth = Pi + 2 * Pi / 3 * reference::Dot(axis, n);
        EXPECT_NEAR(this->Evaluate(n)[0], truth, 1e-3);
        EXPECT_NEAR(this->Evaluate(n)[1], 2 * truth, 2e-3);
      }
    }
  }
}

// Eight real HDRIs. Each of 81 coefficients against the double-precision sum over the panorama: 7e-8 of the mean's by
// single precision for courtyard, up to 1.3e-4 where bright texels are points to us.
TEST_F(TestIrradianceGL, CoefficientsOfHDRIsAreTheReferences)
{
  this->Irradiance->SetOrder(8);
  for (const std::string& name : HDRIs)
  {
    if (GetHDRI(name).empty())
    {
      GTEST_SKIP() << "no HDRIs: install blender-data";
    }
    this->Environment->SetFileName(GetHDRI(name).c_str());
    this->Bake();
    const reference::Environment environment = ToReference(this->Environment->GetRadianceImage());
    const auto truth = reference::Cached<RGB>(
      "harmonics 8 " + reference::KeyOf(environment), [&] { return reference::HarmonicCoefficients(environment, 8); });
    double worst = 0;
    for (int i = 0; i < 81; ++i)
    {
      RGB rgb;
      this->Irradiance->GetRadianceCoefficient(i, rgb.data());
      for (int k = 0; k < 3; ++k)
      {
        worst = std::max(worst, std::abs(rgb[k] - truth[i][k]) / truth[0][k]);
      }
    }
    std::printf("%s: coefficients are off by %.1e of the mean's\n", name.c_str(), worst);
    EXPECT_LT(worst, name == "courtyard" ? 1e-6 : 2e-4) << name;
  }
}

// Irradiance against the integral itself, for all orders, bright texels in the coefficients and apart (courtyard and
// studio have none): mean over the eight of relative L1, bounded a tenth above what was measured. Mutants: the sun's
// solid angle, its light counted twice.
TEST_F(TestIrradianceGL, OfHDRIsConverges)
{
  const std::vector<Vec3> normals = GetCubeDirections(4);
  const std::tuple<int, bool, double> settings[] = { { 2, false, 0.045 }, { 4, false, 0.019 }, { 8, false, 0.0064 },
    { 2, true, 0.0254 }, { 4, true, 0.0087 }, { 8, true, 0.0022 } };
  double means[6] = {};
  for (const std::string& name : HDRIs)
  {
    if (GetHDRI(name).empty())
    {
      GTEST_SKIP() << "no HDRIs: install blender-data";
    }
    this->Environment->SetFileName(GetHDRI(name).c_str());
    this->Environment->Update();
    const reference::Environment environment = ToReference(this->Environment->GetRadianceImage());
    const auto truth = reference::Cached<RGB>("irradiance " + reference::KeyOf(environment) + reference::KeyOf(normals),
      [&] { return reference::IrradianceAll(environment, normals); });
    std::printf("%s:", name.c_str());
    for (int i = 0; i < 6; ++i)
    {
      this->Irradiance->SetOrder(std::get<0>(settings[i]));
      this->Irradiance->SetKeepBrightTexels(std::get<1>(settings[i]));
      this->Bake();
      double difference = 0;
      double sum = 0;
      for (std::size_t n = 0; n < normals.size(); ++n)
      {
        const RGB value = this->Evaluate(normals[n]);
        for (int k = 0; k < 3; ++k)
        {
          difference += std::abs(value[k] - truth[n][k]);
          sum += truth[n][k];
        }
      }
      means[i] += difference / sum / 8;
      std::printf(" %.4f", difference / sum);
    }
    std::printf(", %d bright texels\n", this->Irradiance->GetNumberOfBrightTexels());
  }
  for (int i = 0; i < 6; ++i)
  {
    const auto [order, apart, bound] = settings[i];
    std::printf("order %d, bright texels %s: %.4f\n", order, apart ? "apart" : "in", means[i]);
    EXPECT_LT(means[i], bound) << order << apart;
  }
}

// What the shader evaluates is what GetIrradiance() says, over pi, whether bright texels are kept or not. Single
// precision: 1e-5 of the largest. Mutants: a basis constant in one of the two, bright texels left out.
TEST_F(TestIrradianceGL, PackedIsIrradianceOverPi)
{
  this->Environment->SetInputData(MakePanorama(64,
    [](Vec3 d)
    {
      const double sun = reference::Dot(d, reference::Normalize({ 1, 2, 2 })) > 0.999 ? 1e3 : 0;
      return RGB{ 2 + d.x * d.y + d.z + sun, 3 + d.z * d.z - d.y + sun, 2 + d.y * d.z + d.x * d.x };
    }));
  this->Bake();
  float kept[7][4];
  float pack[7][4];
  this->Irradiance->GetPacked(pack);
  std::vector<RGB> truth;
  for (Vec3 n : Normals)
  {
    truth.push_back(this->Evaluate(n));
  }
  this->Irradiance->KeepBrightTexelsOn();
  this->Bake();
  EXPECT_GT(this->Irradiance->GetNumberOfBrightTexels(), 0);
  this->Irradiance->GetPacked(kept);
  for (std::size_t i = 0; i < Normals.size(); ++i)
  {
    const Vec3 n = Normals[i];
    for (int k = 0; k < 3; ++k)
    {
      const double linear = pack[k][0] * n.x + pack[k][1] * n.y + pack[k][2] * n.z + pack[k][3];
      const double square = pack[3 + k][0] * n.x * n.y + pack[3 + k][1] * n.y * n.z + pack[3 + k][2] * n.z * n.z +
        pack[3 + k][3] * n.z * n.x;
      const double sum = linear + square + pack[6][k] * (n.x * n.x - n.y * n.y);
      EXPECT_NEAR(std::max(sum, 0.0), truth[i][k] / Pi, 1e-5 * 10);
    }
  }
  for (int i = 0; i < 28; ++i)
  {
    EXPECT_NEAR(kept[i / 4][i % 4], pack[i / 4][i % 4], 1e-5) << i;
  }
}

// The world's coefficients, evaluated at a world normal, say what the environment's say at that normal in its frame.
// The cosine leaves bands apart, so it is left out. Mutants: the inverse turn, Rotation's sign, coefficients of an
// earlier orientation.
TEST_F(TestIrradianceGL, WorldCoefficientsTurnWithTheEnvironment)
{
  this->Environment->SetInputData(MakePanorama(64,
    [](Vec3 d) {
      return RGB{ std::exp(d.x - 2 * d.y), 2 + std::sin(3 * d.z + d.x), std::exp(2 * d.z * d.y) };
    }));
  this->Irradiance->SetOrder(8);
  this->Bake();
  this->Environment->SetUp(0.3, 0.2, 1);
  this->Environment->SetRotation(40);
  this->Bake();
  EXPECT_EQ(this->Irradiance->GetNumberOfBuilds(), 1);
  ASSERT_EQ(this->Irradiance->GetNumberOfCoefficients(), 81);
  std::vector<RGB> world(81);
  this->Irradiance->GetWorldCoefficients(world[0].data());
  double m[9];
  this->Environment->GetEnvironmentFromWorld(m);
  for (Vec3 w : Normals)
  {
    const Vec3 e = { m[0] * w.x + m[1] * w.y + m[2] * w.z, m[3] * w.x + m[4] * w.y + m[5] * w.z,
      m[6] * w.x + m[7] * w.y + m[8] * w.z };
    const std::vector<double> inWorld = reference::HarmonicBasis(8, w);
    const std::vector<double> inEnvironment = reference::HarmonicBasis(8, e);
    double difference = 0;
    for (int i = 0; i < 81; ++i)
    {
      RGB rgb;
      this->Irradiance->GetRadianceCoefficient(i, rgb.data());
      difference += inWorld[i] * world[i][1] - inEnvironment[i] * rgb[1];
    }
    EXPECT_NEAR(difference, 0, 1e-12);
  }
}

// Bands that give nothing, or are not there, are refused, and the last order stays. Nothing but zeros before the first
// build.
TEST_F(TestIrradianceGL, RefusesOtherOrders)
{
  RGB rgb{ 1, 1, 1 };
  this->Irradiance->GetRadianceCoefficient(0, rgb.data());
  EXPECT_EQ(rgb[0], 0);
  for (int order : { -1, 0, 3, 9 })
  {
    this->Irradiance->SetOrder(order);
    EXPECT_NE(this->Messages.Take().find("Order is " + std::to_string(order)), std::string::npos);
    EXPECT_EQ(this->Irradiance->GetOrder(), 2);
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
