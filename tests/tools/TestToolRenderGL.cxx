// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ToolTest.h"

#include <cmath>

namespace
{
// The unit tetrahedron, in two of the formats, without normals.
const char* const STL = R"(solid t
facet normal 0 0 -1
outer loop
vertex 0 0 0
vertex 0 1 0
vertex 1 0 0
endloop
endfacet
facet normal 0 -1 0
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 0 1
endloop
endfacet
facet normal -1 0 0
outer loop
vertex 0 0 0
vertex 0 0 1
vertex 0 1 0
endloop
endfacet
facet normal 1 1 1
outer loop
vertex 1 0 0
vertex 0 1 0
vertex 0 0 1
endloop
endfacet
endsolid t
)";
const char* const VTP = R"(<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="4" NumberOfPolys="4" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0">
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Polys><DataArray type="Int32" Name="connectivity" format="ascii">0 2 1 0 1 3 0 3 2 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3 6 9 12</DataArray></Polys>
</Piece></PolyData></VTKFile>
)";

double GetDifference(const Picture& a, const Picture& b)
{
  EXPECT_EQ(a.Values.size(), b.Values.size());
  double sum = 0;
  for (std::size_t i = 0; i < a.Values.size(); ++i)
  {
    sum += std::abs(a.Values[i] - b.Values[i]);
  }
  return sum / a.Values.size();
}
}

class TestToolRenderGL : public ToolGLTest
{
protected:
  void SetUp() override
  {
    ToolGLTest::SetUp();
    this->WriteText("t.stl", STL);
    this->WriteText("t.vtp", VTP);
  }
  Picture Render(const std::string& arguments, const std::string& output = "out.exr")
  {
    EXPECT_EQ(this->RunWell("render " + arguments + " --size 80x50 --output " + output), "wrote " + output + "\n");
    return this->ReadPicture(output);
  }
};

// Both formats give the same picture, both kinds of picture have the size asked for. The tetrahedron covers the middle
// and not the corner. Mutants: size swapped, the mesh's reader mistaken, the background shown in spite of hide.
TEST_F(TestToolRenderGL, WritesEXRAndPNGOfSTLAndVTP)
{
  this->WriteConstant("in.exr", { 0.5, 0.5, 0.5 });
  const std::string light = " --environment in.exr --background hide --color 1,0.5,0 --roughness 1";
  const Picture stl = this->Render("t.stl" + light);
  const Picture vtp = this->Render("t.vtp" + light);
  EXPECT_EQ(stl.Width, 80);
  EXPECT_EQ(stl.Height, 50);
  EXPECT_EQ(stl.Channels, (std::vector<std::string>{ "R", "G", "B", "A" }));
  EXPECT_LT(GetDifference(stl, vtp), 1e-3);
  EXPECT_EQ(stl.At(0, 0)[0], 0);
  const float* middle = stl.At(40, 25);
  EXPECT_NEAR(middle[0], 0.5, 0.01); // a dielectric of albedo 1 is white: the furnace
  EXPECT_GT(middle[0], 1.5 * middle[1]);
  EXPECT_GT(middle[1], 2 * middle[2]);

  const Picture png = this->Render("t.stl" + light, "out.PNG");
  EXPECT_EQ(png.Width, 80);
  EXPECT_EQ(png.Height, 50);
  EXPECT_EQ(png.Channels.size(), 3u);
  EXPECT_NEAR(png.At(40, 25)[0], std::pow(0.5, 1 / 2.2), 0.01);
  EXPECT_EQ(png.At(0, 0)[1], 0);
}

// Up is up in both kinds of picture, and linear is linear: the sky, 1.5 + d.y, is brighter in row 0 than in the last.
// Mutants: rows not turned in either.
TEST_F(TestToolRenderGL, PicturesAreUpright)
{
  this->WritePanorama("in.exr",
    MakePanorama(64,
      [](Vec3 d) {
        return RGB{ 0.5 + 0.4 * d.y, 0.5 + 0.4 * d.y, 0.5 + 0.4 * d.y };
      }));
  const Picture exr = this->Render("t.stl --environment in.exr");
  const Picture png = this->Render("t.stl --environment in.exr", "out.png");
  EXPECT_GT(exr.At(2, 0)[0], exr.At(2, 49)[0] + 0.1);
  EXPECT_GT(png.At(2, 0)[0], png.At(2, 49)[0] + 0.1);
  EXPECT_NEAR(png.At(2, 0)[0], std::pow(exr.At(2, 0)[0], 1 / 2.2), 0.01);
}

// --rotation 90 turns +x to -z, counterclockwise from above, background and reflections alike; --intensity is a factor.
// 5e-3: texels. Mutants: radians, the other way round, intensity ignored.
TEST_F(TestToolRenderGL, TurnsAndScalesTheLight)
{
  this->WritePanorama("x.exr", MakePanorama(128, [](Vec3 d) { return RGB{ 1.5 + d.x, 1.5 + d.x, 1.5 + d.x }; }));
  this->WritePanorama("z.exr", MakePanorama(128, [](Vec3 d) { return RGB{ 1.5 - d.z, 1.5 - d.z, 1.5 - d.z }; }));
  const std::string scene = "t.stl --metallic 1 --roughness 0.3 --environment ";
  const Picture expected = this->Render(scene + "z.exr");
  EXPECT_LT(GetDifference(this->Render(scene + "x.exr --rotation 90"), expected), 5e-3);
  EXPECT_GT(GetDifference(this->Render(scene + "x.exr"), expected), 0.2);
  Picture twice = this->Render(scene + "z.exr --intensity 2");
  for (std::size_t i = 0; i < twice.Values.size(); ++i)
  {
    ASSERT_NEAR(twice.Values[i], expected.Values[i] * (i % 4 == 3 ? 1 : 2), 1e-3);
  }
}

// Each of show, hide and blur shows something else behind the same mesh; blur is smoother than show; --sampled shades
// otherwise and about as brightly. Mutants: blur taken for show, samples not handed on.
TEST_F(TestToolRenderGL, BackgroundAndSampledAreHandedOn)
{
  this->WritePanorama("in.exr",
    MakePanorama(64,
      [](Vec3 d) {
        return std::sin(20 * d.y) > 0 ? RGB{ 2, 2, 2 } : RGB{ 0, 0, 0 };
      }));
  const std::string scene = "t.stl t.vtp --metallic 1 --roughness 0.5 --environment in.exr --background ";
  const Picture shown = this->Render(scene + "show");
  const Picture blurred = this->Render(scene + "blur");
  const auto contrast = [](const Picture& picture)
  {
    float least = 1e9f;
    float most = 0;
    for (int row = 0; row < 50; ++row)
    {
      least = std::min(least, picture.At(1, row)[0]);
      most = std::max(most, picture.At(1, row)[0]);
    }
    return most - least;
  };
  EXPECT_GT(contrast(shown), 1.5);
  EXPECT_LT(contrast(blurred), 1.0);
  EXPECT_EQ(contrast(this->Render(scene + "hide")), 0);
  const Picture sampled = this->Render(scene + "show --sampled 256");
  EXPECT_EQ(sampled.At(1, 1)[0], shown.At(1, 1)[0]);
  EXPECT_NE(sampled.At(40, 25)[0], shown.At(40, 25)[0]);
  EXPECT_NEAR(sampled.At(40, 25)[0], shown.At(40, 25)[0], 0.5);
}

// Render keeps its light for the next, which looks the same to the bit, and bake keeps nothing. That what is kept is
// taken is TestCache's. Mutants: the cache off in render, on in bake.
TEST_F(TestToolRenderGL, KeepsItsLightAndBakeDoesNot)
{
  this->WritePanorama("in.exr", MakePanorama(64, [](Vec3 d) { return RGB{ 1 + d.x, 2 + d.y, 1.5 }; }));
  const std::string use = "export VTKIBL_CACHE=on XDG_CACHE_HOME=\"$PWD/cache\" &&";
  const auto countCached = [this]
  {
    int files = 0;
    for (const std::string& name : this->List())
    {
      files += name.rfind("cache/vtkIBL/vtkIBL-", 0) == 0;
    }
    return files;
  };
  ASSERT_EQ(this->Run("bake in.exr --output out", use).Status, 0);
  EXPECT_EQ(countCached(), 0);
  const std::string render = "render t.stl --environment in.exr --output ";
  ASSERT_EQ(this->Run(render + "first.exr", use).Status, 0);
  EXPECT_EQ(countCached(), 1);
  ASSERT_EQ(this->Run(render + "second.exr", use).Status, 0);
  EXPECT_EQ(countCached(), 1);
  EXPECT_EQ(this->ReadPicture("first.exr").Values, this->ReadPicture("second.exr").Values);
}
