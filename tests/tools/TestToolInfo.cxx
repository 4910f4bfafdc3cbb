// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ToolTest.h"

#include <cmath>
#include <limits>
#include <sstream>

namespace
{
// The text after "KEY: ", to the end of its line.
std::string Find(const std::string& text, const std::string& key)
{
  const std::size_t begin = ("\n" + text).find("\n" + key + ": ");
  if (begin == std::string::npos)
  {
    ADD_FAILURE() << "no " << key << " in\n" << text;
    return "";
  }
  const std::size_t value = begin + key.size() + 2;
  return text.substr(value, text.find('\n', value) - value);
}
}

class TestToolInfo : public ToolTest
{
};

// Faults are counted, one texel each, and change neither range nor mean. The sun is found where it is: texel (40, 20)
// of 64 x 32. Mutants: a NaN texel counted thrice, counted after cleaning, u and v swapped in the direction, rows
// upside down.
TEST_F(TestToolInfo, CountsFaultsAndFindsTheSun)
{
  auto image = MakePanorama(32, [](Vec3) { return RGB{ 0.5, 0.5, 0.5 }; });
  const auto texel = [&](int i, int j) { return static_cast<float*>(image->GetScalarPointer(i, j, 0)); };
  texel(3, 3)[0] = texel(3, 3)[1] = texel(9, 3)[2] = std::numeric_limits<float>::quiet_NaN();
  texel(5, 7)[1] = std::numeric_limits<float>::infinity();
  texel(6, 7)[0] = texel(8, 9)[0] = texel(10, 9)[2] = -0.001f;
  for (int k = 0; k < 3; ++k)
  {
    texel(40, 20)[k] = 8.0f;
  }
  this->WritePanorama("in.exr", image);
  const Outcome outcome = this->Run("info in.exr");
  ASSERT_EQ(outcome.Status, 0) << outcome.Err;
  EXPECT_EQ(Find(outcome.Out, "file"), "in.exr");
  EXPECT_EQ(Find(outcome.Out, "size"), "64 x 32");
  EXPECT_EQ(Find(outcome.Out, "layout"), "lat-long");
  EXPECT_EQ(Find(outcome.Out, "range"), "-0.001 to 8");
  EXPECT_EQ(Find(outcome.Out, "NaN texels"), "2");
  EXPECT_EQ(Find(outcome.Out, "infinite texels"), "1");
  EXPECT_EQ(Find(outcome.Out, "negative texels"), "3");
  const double mean = std::stod(Find(outcome.Out, "mean luminance"));
  const double sun = 7.5 * vtkIBLReference::TexelSolidAngle(ToReference(image), 20) / (4 * vtkIBLReference::Pi);
  EXPECT_NEAR(mean, 0.5 + sun, 1e-3); // faulty texels are 1e-3 of all
  EXPECT_NEAR(std::stod(Find(outcome.Out, "suggested exposure")), 1 / mean, 1e-4);

  const Vec3 truth = vtkIBLReference::TexelDirection(ToReference(image), 20, 40);
  const std::string first = outcome.Out.substr(outcome.Out.find("brightest texels"));
  double rgb[3];
  Vec3 d;
  ASSERT_EQ(std::sscanf(first.c_str(), "%*[^\n]\n %lf %lf %lf from direction %lf %lf %lf", &rgb[0], &rgb[1], &rgb[2],
              &d.x, &d.y, &d.z),
    6)
    << first;
  EXPECT_EQ(rgb[0], 8.0);
  EXPECT_GT(vtkIBLReference::Dot(d, truth), 1 - 1e-7);
}

// Six faces in a strip: the brightest texel's direction is that of the cube's convention. Mutant: two faces swapped.
TEST_F(TestToolInfo, TellsACubeAndItsDirections)
{
  const Vec3 sun = vtkIBLReference::CubeDirection(4, 2 * 3.5 / 16 - 1, 2 * 5.5 / 16 - 1);
  auto faces = MakeFaces(16, [&](Vec3 d) { return RGB{ 1, vtkIBLReference::Dot(d, sun) > 1 - 1e-6 ? 9.0 : 1.0, 1 }; });
  auto strip = vtkSmartPointer<vtkImageData>::New(); // n x 6n, in WritePanorama's order: bottom row first
  strip->SetDimensions(16, 96, 1);
  strip->AllocateScalars(VTK_FLOAT, 3);
  for (int row = 0; row < 96; ++row)
  {
    const auto* line = static_cast<const float*>(faces->GetScalarPointer(0, row % 16, row / 16));
    std::copy(line, line + 48, static_cast<float*>(strip->GetScalarPointer(0, 95 - row, 0)));
  }
  this->WritePanorama("strip.exr", strip);
  const std::string out = this->RunWell("info strip.exr");
  EXPECT_EQ(Find(out, "size"), "16 x 16 x 6");
  EXPECT_EQ(Find(out, "layout"), "cube");
  std::ostringstream direction;
  direction.precision(4);
  direction << std::fixed << "1 9 1 from direction " << sun.x << " " << sun.y << " " << sun.z;
  EXPECT_NE(out.find(direction.str()), std::string::npos) << out << direction.str();
}

TEST_F(TestToolInfo, OfARealPanorama)
{
  const std::string path = GetHDRI("interior");
  if (path.empty())
  {
    GTEST_SKIP() << "no HDRIs: install blender-data";
  }
  const std::string out = this->RunWell("info " + path);
  EXPECT_EQ(Find(out, "size"), "1024 x 512");
  EXPECT_EQ(Find(out, "NaN texels"), "0");
  EXPECT_NEAR(std::stod(Find(out, "mean luminance")), 1.05, 0.01);
}

// What nobody should have to look up elsewhere: an example for each command, and the version. Mutant: a command without
// its footer.
TEST_F(TestToolInfo, HelpHasAnExampleForEachCommand)
{
  for (const std::string command : { "bake", "render", "sphere", "probe", "info" })
  {
    EXPECT_NE(this->RunWell("--help").find("\n  " + command), std::string::npos);
    EXPECT_NE(this->RunWell(command + " --help").find("Example:\n  vtkibl " + command + " "), std::string::npos);
  }
  EXPECT_EQ(this->RunWell("--version").rfind("vtkibl ", 0), 0u);
}
