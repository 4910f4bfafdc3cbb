// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What goes wrong: a status, one line on stderr, and no file more or less than before.
#include "ToolTest.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace fs = std::filesystem;

class TestToolErrorsGL : public ToolGLTest
{
protected:
  void SetUp() override
  {
    ToolGLTest::SetUp();
    this->WriteConstant("in.exr", { 1, 1, 1 });
    this->WriteText("text.exr", "no picture");
    this->WriteText("file", "a regular file");
    this->WriteText("mesh.xyz", "0 0 0");
    this->WriteText("empty.stl", "solid nothing\nendsolid nothing\n");
    this->WriteText("broken.vtp", "<VTKFile type=\"PolyData\"><oops");
    this->WriteText("broken.ply", "not a ply");
    this->WriteText("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    fs::create_directories(this->Folder / "folder.exr");
    fs::create_directories(this->Folder / "folder.json");
    fs::create_directories(this->Folder / "taken" / "bake.json");
  }
  // `lines` lines on stderr, each of this tool's.
  void ExpectFailure(
    int status, const std::string& words, const std::string& arguments, int lines = 1, const std::string& before = "")
  {
    const std::vector<std::string> files = this->List();
    const Outcome outcome = this->Run(arguments, before);
    EXPECT_EQ(outcome.Status, status) << arguments;
    EXPECT_EQ(outcome.Out, "") << arguments;
    EXPECT_EQ(std::count(outcome.Err.begin(), outcome.Err.end(), '\n'), lines) << arguments << "\n" << outcome.Err;
    EXPECT_NE(outcome.Err.find(words), std::string::npos) << arguments << "\n" << outcome.Err;
    EXPECT_EQ(outcome.Err.find("ERROR"), std::string::npos) << arguments << "\n" << outcome.Err;
    EXPECT_EQ(this->List(), files) << arguments;
    std::istringstream text(outcome.Err);
    for (std::string line; std::getline(text, line);)
    {
      EXPECT_EQ(line.rfind("vtkibl: ", 0), 0u) << line;
    }
  }
};

// Mutants: CLI11's own status 106, its second line, a number parsed in part, NaN let through Range.
TEST_F(TestToolErrorsGL, WrongUsageIsStatusTwo)
{
  const std::string render = "render t.obj --environment in.exr --output ";
  this->ExpectFailure(2, "subcommand", "");
  this->ExpectFailure(2, "--output", "bake in.exr");
  this->ExpectFailure(2, "--engine: gpu not in {spectral,sampled}", "bake in.exr --output out --engine gpu");
  this->ExpectFailure(2, "(0, 0.5]", "bake in.exr --output out --tolerance 0");
  this->ExpectFailure(2, "(0, 0.5]", "bake in.exr --output out --tolerance nan");
  this->ExpectFailure(2, "A:B", "bake in.exr --output out --roughness 0.5");
  this->ExpectFailure(2, "A:B", "bake in.exr --output out --roughness 0.5:1.5");
  this->ExpectFailure(2, "A:B", "bake in.exr --output out --roughness 0.6:0.4");
  this->ExpectFailure(2, ".png or .exr", render + "out.jpg");
  this->ExpectFailure(2, "does not end in .exr", "sphere --environment in.exr --output out.png");
  for (const std::string size : { "100", "0x10", "10x", "10x10x10", "-5x5", "10X10", "9999x10" })
  {
    this->ExpectFailure(2, "WIDTHxHEIGHT", render + "out.png --size " + size);
  }
  this->ExpectFailure(2, "R,G,B", render + "out.png --color 1,0");
  this->ExpectFailure(2, "R,G,B", render + "out.png --color 1,0,x");
  this->ExpectFailure(2, "[0, 1]", render + "out.png --metallic nan");
  this->ExpectFailure(2, "[1, 8192]", render + "out.png --sampled 0");
  this->ExpectFailure(2, "{show,hide,blur}", render + "out.png --background red");
  const std::string probe = "probe t.obj --environment in.exr --output out.exr ";
  this->ExpectFailure(2, "--position", probe);
  this->ExpectFailure(2, "--position: At least 3", probe + "--position 1 2");
  this->ExpectFailure(2, "x is not a number", probe + "--position 1 2 x");
  this->ExpectFailure(2, "below its second", probe + "--position 1 2 3 --box 0 1 0 1 1 1");
  this->ExpectFailure(2, "excludes", probe + "--position 1 2 3 --box 0 1 0 1 0 1 --ellipsoid 0 1 0 1 0 1");
  this->ExpectFailure(2, "[0, 8]", probe + "--position 1 2 3 --bounces 9");
  this->ExpectFailure(2, "--size: 100 not in", probe + "--position 1 2 3 --size 100");
  this->ExpectFailure(2, "does not end in .exr", "probe t.obj --environment in.exr --position 1 2 3 --output out.png");
}

// The library would go on with its studio where an environment can't be read: the tool must not. Mutants: VTK's errors
// dropped, its banner left in, the executive's request printed.
TEST_F(TestToolErrorsGL, WhatCannotBeReadIsStatusOne)
{
  const std::string light = " --environment in.exr --output out.png";
  for (const std::string command :
    { "bake nowhere.exr --output out", "info nowhere.exr", "sphere --environment nowhere.exr --output out.exr",
      "render t.obj --environment nowhere.exr --output out.png" })
  {
    this->ExpectFailure(1, "'nowhere.exr': there is no such file", command);
  }
  this->ExpectFailure(1, "'text.exr'", "bake text.exr --output out");
  this->ExpectFailure(1, "'text.exr'", "info text.exr");
  this->ExpectFailure(1, "'mesh.xyz'", "render mesh.xyz" + light);
  this->ExpectFailure(1, "'nowhere.stl'", "render nowhere.stl" + light);
  this->ExpectFailure(1, "'empty.stl' has no faces", "render empty.stl" + light);
  this->ExpectFailure(1, "'broken.vtp'", "render broken.vtp" + light);
  this->ExpectFailure(1, "'broken.ply': it is damaged", "render broken.ply" + light);
  this->ExpectFailure(1, "'empty.stl' has no faces", "render broken.vtp t.obj empty.stl" + light, 2);
  this->ExpectFailure(
    1, "cannot read probe 'nowhere.exr': there is no such file", "render t.obj --probe nowhere.exr" + light);
  this->ExpectFailure(1, "'in.exr': it has 1 parts, a probe's file has six", "render t.obj --probe in.exr" + light);
  this->RunWell("probe t.obj --environment in.exr --position 1 2 3 --size 32 --output whole.exr");
  fs::copy(this->Folder / "whole.exr", this->Folder / "cut.exr");
  fs::resize_file(this->Folder / "cut.exr", fs::file_size(this->Folder / "cut.exr") * 9 / 10);
  this->ExpectFailure(1, "cannot read probe 'cut.exr'", "render t.obj --probe whole.exr --probe cut.exr" + light);
  this->ExpectFailure(1, "cannot read probe 'cut.exr'", "info cut.exr");
  this->ExpectFailure(1, "65536 are the most", "bake in.exr --output out --engine sampled --tolerance 0.001");
  this->ExpectFailure(1, "take 0.002 or more", "bake in.exr --output out --tolerance 0.001");
}

// Places that nothing can be written to, by root neither. Mutants: a folder not told from a file, the sphere's
// picture put in place although its JSON cannot be.
TEST_F(TestToolErrorsGL, WhereNothingCanBeWrittenIsStatusOne)
{
  this->ExpectFailure(1, "cannot make the folder 'file/out'", "bake in.exr --output file/out");
  this->ExpectFailure(1, "cannot make the folder 'file'", "bake in.exr --output file");
  this->ExpectFailure(1, "it is a folder", "bake in.exr --output taken");
  this->ExpectFailure(1, "there is no folder 'file'", "render t.obj --environment in.exr --output file/out.png");
  const std::string probe = "probe t.obj --environment in.exr --position 1 2 3 --output ";
  this->ExpectFailure(1, "there is no folder 'gone'", probe + "gone/out.exr");
  this->ExpectFailure(1, "'folder.exr': it is a folder", probe + "folder.exr");
  this->ExpectFailure(1, "there is no folder 'gone'", "sphere --environment in.exr --output gone/out.exr");
  this->ExpectFailure(1, "it is a folder", "render t.obj --environment in.exr --output folder.exr");
  this->ExpectFailure(1, "'folder.exr': it is a folder", "sphere --environment in.exr --output folder.exr");
  fs::remove(this->Folder / "folder.exr");
  this->ExpectFailure(1, "'folder.json': it is a folder", "sphere --environment in.exr --output folder.exr");
}

// A disk that is full in the middle of a file: here, a limit of a few kB on the size of files. Neither half a file nor
// a folder is left, and an older bake stays whole. Mutants: written in place, temporary files left, the old JSON
// removed first, the write's result not looked at.
TEST_F(TestToolErrorsGL, AFullDiskLeavesNothing)
{
  const std::string full = "ulimit -f 4 && trap '' XFSZ &&";
  this->ExpectFailure(1, "File too large", "render t.obj --environment in.exr --output out.exr", 1, full);
  this->ExpectFailure(1, "File too large", "sphere --environment in.exr --roughness 0.3 --output out.exr", 1, full);
  this->ExpectFailure(1, "File too large", "bake in.exr --output out", 1, full);
  const std::string probe = "probe t.obj --environment in.exr --position 1 2 3 --size 128 --output out.exr";
  this->ExpectFailure(1, "File too large", probe, 1, "ulimit -f 1 && trap '' XFSZ &&");

  this->RunWell("bake in.exr --output out");
  const auto read = [this]
  {
    std::ostringstream text;
    text << std::ifstream(this->Folder / "out" / "bake.json").rdbuf();
    return text.str();
  };
  const std::string before = read();
  this->ExpectFailure(1, "File too large", "bake in.exr --output out --tolerance 0.1", 1, full);
  EXPECT_EQ(read(), before);
}
