// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TestSupport.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLImageReader.h"

#include <vtkDataArray.h>
#include <vtkImageChangeInformation.h>
#include <vtkPointData.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

class TestEnvironment : public ::testing::Test
{
protected:
  CaughtMessages Messages;
  vtkNew<vtkIBLEnvironment> Environment;

  void TearDown() override { EXPECT_EQ(this->Messages.Take(), ""); }

  // The environment has light, and it is `image`, whatever went wrong since; one message names what did.
  void ExpectErrorAndOldLight(vtkImageData* old, const std::string& words)
  {
    EXPECT_TRUE(this->Environment->Update());
    const std::string message = this->Messages.Take();
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_EQ(this->Environment->GetRadianceImage(), old);
    EXPECT_TRUE(this->Environment->Update()); // and it is not repeated
    EXPECT_EQ(this->Messages.Take(), "");
  }
};

namespace
{
vtkSmartPointer<vtkImageData> MakeImage(int width, int height, int depth, int type, int components, double value)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, depth);
  image->AllocateScalars(type, components);
  image->GetPointData()->GetScalars()->Fill(value);
  return image;
}
}

// With nothing given there is a studio; a first source that fails leaves it. Mutant: no light until a source loads.
TEST_F(TestEnvironment, StartsWithAStudio)
{
  ASSERT_TRUE(this->Environment->Update());
  EXPECT_EQ(this->Environment->GetRadianceImage()->GetDimensions()[0],
    2 * this->Environment->GetRadianceImage()->GetDimensions()[1]);
  EXPECT_GT(this->Environment->GetMeanLuminance(), 0.5);
  EXPECT_LT(this->Environment->GetMeanLuminance(), 2.0);

  vtkNew<vtkIBLEnvironment> other;
  other->SetFileName("/no/such.exr");
  EXPECT_TRUE(other->Update());
  EXPECT_EQ(other->GetMeanLuminance(), this->Environment->GetMeanLuminance());
  EXPECT_NE(this->Messages.Take().find("/no/such.exr"), std::string::npos);
}

// Every bad source says which it is and what is wrong, and leaves the last good light.
TEST_F(TestEnvironment, KeepsTheLastGoodLight)
{
  this->Environment->SetInputData(MakePanorama(8, [](Vec3) { return RGB{ 1, 2, 3 }; }));
  ASSERT_TRUE(this->Environment->Update());
  vtkSmartPointer<vtkImageData> good = this->Environment->GetRadianceImage();

  const std::filesystem::path folder =
    std::filesystem::temp_directory_path() / ("vtkibl-environment-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string text = folder / "notes.exr";
  std::ofstream(text) << "no image";
  const std::string missing = folder / "missing.hdr";
  for (const std::string& name : { text, missing, folder.string() })
  {
    this->Environment->SetFileName(name.c_str());
    this->ExpectErrorAndOldLight(good, name);
  }
  std::filesystem::remove_all(folder);

  this->Environment->SetInputData(MakeImage(5, 7, 1, VTK_FLOAT, 3, 1));
  this->ExpectErrorAndOldLight(good, "5x7x1");
  this->Environment->SetInputData(MakeImage(4, 8, 6, VTK_FLOAT, 3, 1));
  this->ExpectErrorAndOldLight(good, "4x8x6");
  vtkNew<vtkImageData> empty;
  this->Environment->SetInputData(empty);
  this->ExpectErrorAndOldLight(good, "no image with scalars");

  // And a good one is taken again; no source means the studio.
  this->Environment->SetInputData(MakeImage(4, 2, 1, VTK_FLOAT, 3, 5));
  EXPECT_TRUE(this->Environment->Update());
  EXPECT_NEAR(this->Environment->GetMeanLuminance(), 5, 1e-6);
  this->Environment->SetInputData(nullptr);
  EXPECT_TRUE(this->Environment->Update());
  EXPECT_EQ(this->Environment->GetRadianceImage()->GetDimensions()[0], 512);
}

// A broken texel is counted, reported once, and replaced; small negatives, as lossy EXR leaves them, are counted
// without a word.
TEST_F(TestEnvironment, CountsAndReportsBrokenTexels)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  vtkSmartPointer<vtkImageData> image = MakePanorama(16, [](Vec3) { return RGB{ 1, 1, 1 }; });
  auto* texels = static_cast<float*>(image->GetScalarPointer());
  texels[3 * 100] = nan;
  texels[3 * 200 + 1] = inf;
  texels[3 * 300 + 2] = -1;
  texels[3 * 400] = 1e30f;
  this->Environment->SetInputData(image);
  EXPECT_TRUE(this->Environment->Update());
  EXPECT_EQ(this->Environment->GetNumberOfNotFiniteTexels(), 2);
  EXPECT_EQ(this->Environment->GetNumberOfTooLargeTexels(), 1);
  EXPECT_EQ(this->Environment->GetNumberOfNegativeTexels(), 1);
  const std::string message = this->Messages.Take();
  EXPECT_NE(message.find("replaced 2 NaN or infinite and 1 too large"), std::string::npos) << message;
  EXPECT_NE(message.find("1 negative"), std::string::npos) << message;
  const auto* clean = static_cast<const float*>(this->Environment->GetRadianceImage()->GetScalarPointer());
  for (int i : { 3 * 100, 3 * 200 + 1, 3 * 400 })
  {
    EXPECT_EQ(clean[i], 1.0f);
  }
  EXPECT_EQ(clean[3 * 300 + 2], 0.0f);
  EXPECT_TRUE(std::isnan(texels[3 * 100])); // the caller's image is not touched

  this->Environment->SetInputData(MakePanorama(16, [](Vec3 d) { return RGB{ d.y > 0.9 ? -0.004 : 1, 1, 1 }; }));
  EXPECT_TRUE(this->Environment->Update());
  EXPECT_GT(this->Environment->GetNumberOfNegativeTexels(), 0);
}

// Components and types: grey, grey + alpha, RGBA; 8 and 16 bits are sRGB unless told otherwise.
TEST_F(TestEnvironment, TakesAnyImage)
{
  struct Case
  {
    int Type, Components, ColorSpace;
    double Value, Truth;
  };
  const double decoded = std::pow((0.5 + 0.055) / 1.055, 2.4);
  for (const Case& c : { Case{ VTK_FLOAT, 1, vtkIBLImageReader::ColorSpaceAuto, 0.5, 0.5 },
         Case{ VTK_DOUBLE, 2, vtkIBLImageReader::ColorSpaceAuto, 0.5, 0.5 },
         Case{ VTK_FLOAT, 4, vtkIBLImageReader::ColorSpaceSRGB, 0.5, decoded },
         Case{ VTK_UNSIGNED_CHAR, 3, vtkIBLImageReader::ColorSpaceAuto, 127.5, decoded },
         Case{ VTK_UNSIGNED_CHAR, 3, vtkIBLImageReader::ColorSpaceLinear, 127.5, 0.5 },
         Case{ VTK_UNSIGNED_SHORT, 1, vtkIBLImageReader::ColorSpaceAuto, 32767.5, decoded } })
  {
    this->Environment->SetColorSpace(c.ColorSpace);
    this->Environment->SetInputData(MakeImage(4, 2, 1, c.Type, c.Components, c.Value));
    ASSERT_TRUE(this->Environment->Update());
    EXPECT_EQ(this->Environment->GetRadianceImage()->GetNumberOfScalarComponents(), 3);
    EXPECT_NEAR(this->Environment->GetMeanLuminance(), c.Truth, 0.005)
      << c.Type << " " << c.Components; // 8 bits hold 127, not 127.5
  }
}

// A pipeline is followed: a change upstream is seen by the next Update(), and no change reads nothing.
TEST_F(TestEnvironment, FollowsAPipeline)
{
  vtkSmartPointer<vtkImageData> image = MakeImage(4, 2, 1, VTK_FLOAT, 3, 1);
  vtkNew<vtkImageChangeInformation> filter;
  filter->SetInputData(image);
  this->Environment->SetInputConnection(filter->GetOutputPort());
  EXPECT_TRUE(this->Environment->Update());
  const vtkMTimeType first = this->Environment->GetRadianceTime();
  EXPECT_TRUE(this->Environment->Update());
  this->Environment->SetIntensity(2);
  EXPECT_TRUE(this->Environment->Update());
  EXPECT_EQ(this->Environment->GetRadianceTime(), first);
  image->GetPointData()->GetScalars()->Fill(3);
  image->Modified();
  EXPECT_TRUE(this->Environment->Update());
  EXPECT_GT(this->Environment->GetRadianceTime(), first);
  EXPECT_NEAR(this->Environment->GetMeanLuminance(), 3, 1e-6);
}

// Axes: the same as vtkRenderer's EnvironmentUp and EnvironmentRight; always a rotation. 1e-12. Mutants: no
// Gram-Schmidt, the wrong sense of Rotation.
TEST_F(TestEnvironment, MakesARotation)
{
  auto rows = [this]
  {
    std::array<double, 9> m;
    this->Environment->GetEnvironmentFromWorld(m.data());
    return m;
  };
  EXPECT_EQ(rows(), (std::array<double, 9>{ 1, 0, 0, 0, 1, 0, 0, 0, 1 }));
  this->Environment->SetRotation(90); // the environment's +x is then the world's -z
  EXPECT_NEAR(rows()[2], -1, 1e-12);
  for (auto [up, right] : { std::pair{ Vec3{ 0, 0, 2 }, Vec3{ 1, 0, 0 } }, { { 1, 2, 3 }, { -1, 4, 0.5 } },
         { { 0, 1, 0 }, { 0, 5, 0 } }, { { 1e-3, 0, 0 }, { 1, 1e-7, 0 } } })
  {
    this->Environment->SetUp(up.x, up.y, up.z);
    this->Environment->SetRight(right.x, right.y, right.z);
    for (double angle : { 0.0, 33.0, -720.5 })
    {
      this->Environment->SetRotation(angle);
      const std::array<double, 9> m = rows();
      const Vec3 x{ m[0], m[1], m[2] }, y{ m[3], m[4], m[5] }, z{ m[6], m[7], m[8] };
      using vtkIBLReference::Dot;
      EXPECT_NEAR(Dot(x, x), 1, 1e-12);
      EXPECT_NEAR(Dot(y, y), 1, 1e-12);
      EXPECT_NEAR(Dot(x, y), 0, 1e-12);
      EXPECT_NEAR(Dot(vtkIBLReference::Cross(x, y), z), 1, 1e-12);
      EXPECT_NEAR(Dot(y, vtkIBLReference::Normalize(up)), 1, 1e-12);
    }
  }
}

// Bad settings are refused with a word, and the old value stays.
TEST_F(TestEnvironment, RefusesBadSettings)
{
  const double nan = std::nan("");
  auto expect = [this](const char* words) { EXPECT_NE(this->Messages.Take().find(words), std::string::npos) << words; };
  this->Environment->SetIntensity(-1);
  expect("Intensity is -1");
  this->Environment->SetIntensity(nan);
  expect("Intensity is");
  this->Environment->SetTint(1, -0.5, 1);
  expect("Tint is (1, -0.5, 1)");
  this->Environment->SetRotation(INFINITY);
  expect("Rotation is inf");
  this->Environment->SetUp(0, 0, 0);
  expect("Up is (0, 0, 0)");
  this->Environment->SetRight(nan, 0, 0);
  expect("Right is (");
  double scale[3];
  this->Environment->GetRadianceScale(scale);
  EXPECT_EQ(scale[1], 1.0);
  EXPECT_EQ(this->Environment->GetUp()[1], 1.0);
}

// A real HDRI: its size, its mean as listed for this file, and the negatives that its compression left.
TEST_F(TestEnvironment, ReadsAnHDRI)
{
  const std::string path = GetHDRI("city");
  if (path.empty())
  {
    GTEST_SKIP() << "no HDRIs: install blender-data";
  }
  this->Environment->SetFileName(path.c_str());
  ASSERT_TRUE(this->Environment->Update());
  EXPECT_EQ(this->Environment->GetRadianceImage()->GetDimensions()[0], 1024);
  EXPECT_NEAR(this->Environment->GetMeanLuminance(), 0.96, 0.01);
  EXPECT_GT(this->Environment->GetNumberOfNegativeTexels(), 0);
  EXPECT_EQ(this->Environment->GetNumberOfNotFiniteTexels(), 0);
}
