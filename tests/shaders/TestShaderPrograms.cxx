// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Every kernel as it is assembled, and every chunk in a shader like VTK's, is valid GLSL to Khronos' own compiler,
// which knows no driver's leniency and needs no GPU. Skipped where there is no glslangValidator (Debian:
// glslang-tools).
#include "vtkIBLShaderSource.h"
#include "vtkIBLShaderTexts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

class ShaderPrograms : public ::testing::Test
{
protected:
  void SetUp() override
  {
    if (std::system("glslangValidator --version > /dev/null 2>&1") != 0)
    {
      GTEST_SKIP() << "no glslangValidator: install glslang-tools";
    }
    std::filesystem::create_directories(this->Folder);
  }
  void TearDown() override { std::filesystem::remove_all(this->Folder); }

  // Empty when `text` is a valid shader of that stage (comp, vert, frag), else what the compiler says.
  std::string Complaints(const std::string& name, const std::string& stage, const std::string& text) const
  {
    const std::filesystem::path file = this->Folder / (name + "." + stage);
    std::ofstream(file) << text;
    FILE* pipe = popen(("glslangValidator '" + file.string() + "' 2>&1").c_str(), "r");
    std::string output;
    char buffer[4096];
    while (std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe))
    {
      output.append(buffer, count);
    }
    const int status = pclose(pipe);
    return status == 0 ? std::string() : output.empty() ? "status " + std::to_string(status) : output;
  }
  const std::filesystem::path Folder =
    std::filesystem::temp_directory_path() / ("vtkibl-shaders-" + std::to_string(getpid()));
};

namespace
{
bool EndsWith(const std::string& name, const std::string& end)
{
  return name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
}

// The stage that a name tells, or empty for a text that is included.
std::string GetStage(const std::string& name)
{
  return EndsWith(name, "CS.glsl") ? "comp"
    : EndsWith(name, "VS.glsl")    ? "vert"
    : EndsWith(name, "FS.glsl")    ? "frag"
                                   : "";
}

std::vector<std::string> GetNames(bool isWanted(const std::string&))
{
  std::vector<std::string> names;
  for (const vtkIBLShaderText* entry = vtkIBLShaderTexts; entry->Name; ++entry)
  {
    if (isWanted(entry->Name))
    {
      names.emplace_back(entry->Name);
    }
  }
  return names;
}

// "0 = vtkIBLShared.glsl …": whose lines the numbers of a complaint are.
std::string Legend(const vtkIBLShaderSource& source)
{
  std::string text;
  for (std::size_t i = 0; i < source.Files.size(); ++i)
  {
    text += std::to_string(i) + " = " + source.Files[i] + "\n";
  }
  return text;
}
}

// Mutants: a kernel without one of its includes; an int for a vec3.
TEST_F(ShaderPrograms, KernelsAreValid)
{
  const std::vector<std::string> kernels = GetNames([](const std::string& name) { return !GetStage(name).empty(); });
  EXPECT_GE(kernels.size(), 8u); // six of the stages, two of the background
  for (const std::string& name : kernels)
  {
    const vtkIBLShaderSource source = vtkIBLAssembleShader(name);
    EXPECT_EQ(this->Complaints(name, GetStage(name), source.Text), "") << name << "\n" << Legend(source);
  }
}

// The formulas alone, in the order in which C++ includes them, so that no kernel lends them a definition of its own.
// Mutant: a constant that is not there.
TEST_F(ShaderPrograms, FormulasAreValidInTheirOrder)
{
  std::string text = "#version 450\n";
  for (const char* name : { "vtkIBLShared.glsl", "vtkIBLDirectionFunctions.glsl", "vtkIBLSamplingFunctions.glsl",
         "vtkIBLBRDFFunctions.glsl", "vtkIBLEnergyFunctions.glsl", "vtkIBLHarmonicsFunctions.glsl",
         "vtkIBLLadderFunctions.glsl", "vtkIBLParallaxFunctions.glsl" })
  {
    for (const vtkIBLShaderText* entry = vtkIBLShaderTexts; entry->Name; ++entry)
    {
      text += entry->Name == std::string(name) ? entry->Text : "";
    }
  }
  EXPECT_EQ(this->Complaints("functions", "frag", text + "void main() {}\n"), "");
  EXPECT_NE(text.find("iblPackedIrradiance"), std::string::npos);
}

// Light for VTK's mappers, which are #version 150, between what VTK declares and its main. Mutants: a layout(binding =
// 0); bitfieldReverse; an unsigned literal out of range; what only the mirror needs, used without it.
TEST_F(ShaderPrograms, ChunksAreValidInVTKsShaders)
{
  const std::vector<std::string> chunks =
    GetNames([](const std::string& name) { return name.compare(0, 14, "vtkIBLLighting") == 0; });
  EXPECT_NE(std::find(chunks.begin(), chunks.end(), "vtkIBLLighting.glsl"), chunks.end());
  for (const std::string& name : chunks)
  {
    for (const std::string defines : { "#define IBL_LAMPS 0\n#define IBL_ENERGY IBL_MULTIPLE_SCATTER\n",
           "#define IBL_LAMPS 8\n#define IBL_ENERGY IBL_SINGLE_SCATTER\n#define IBL_MIRROR\n#define IBL_COAT\n#define "
           "IBL_PROBES\n#define IBL_SHOW_SHARES\n",
           "#define IBL_LAMPS 1\n#define IBL_ENERGY IBL_CLASSIC\n#define IBL_METAL\n#define IBL_ANISOTROPY\n"
           "#define IBL_WHITE_EDGES\n#define IBL_TINT\n#define IBL_PARALLEL_PROJECTION\n#define IBL_RIGID_VIEW\n",
           "#define IBL_LAMPS 2\n#define IBL_ENERGY IBL_MULTIPLE_SCATTER\n#define IBL_DIELECTRIC\n#define "
           "IBL_BUMPED\n#define IBL_HORIZON_OCCLUSION\n"
           "#define IBL_ANISOTROPY\n#define IBL_COAT\n#define IBL_OCCLUSION\n#define IBL_SPECULAR_OCCLUSION\n" })
    {
      const std::string text = "#version 150\n#extension GL_ARB_texture_cube_map_array : enable\n" + defines +
        "in vec4 vertexVC;\nout vec4 fragOutput0;\n" + vtkIBLAssembleChunk(name) +
        "void main()\n{\n  fragOutput0 = vertexVC;\n}\n";
      EXPECT_EQ(this->Complaints(name, "frag", text), "") << name << " " << defines;
    }
  }
}

// The compiler does refuse, and names our file and our line: a type error put before main of a kernel is reported as
// that line of that file. Mutant: a validator that is not there, or always content (true for glslangValidator).
TEST_F(ShaderPrograms, ABrokenShaderIsRefusedWithItsLine)
{
  for (const std::string& name : GetNames([](const std::string& name) { return !GetStage(name).empty(); }))
  {
    vtkIBLShaderSource source = vtkIBLAssembleShader(name);
    const std::string ours = "\nvoid main()\n";
    const std::size_t at = source.Text.find(ours);
    ASSERT_NE(at, std::string::npos) << name;
    source.Text.insert(at, "\nint broken = vec3(1.0);");

    std::string file;
    for (const vtkIBLShaderText* entry = vtkIBLShaderTexts; entry->Name; ++entry)
    {
      file = entry->Name == name ? entry->Text : file;
    }
    const auto line = 1 + std::count(file.begin(), file.begin() + file.find(ours) + 1, '\n');
    const auto number = std::find(source.Files.begin(), source.Files.end(), name) - source.Files.begin();
    const std::string place = "ERROR: " + std::to_string(number) + ":" + std::to_string(line) + ":";
    const std::string complaints = this->Complaints(name, GetStage(name), source.Text);
    EXPECT_NE(complaints.find(place), std::string::npos) << "wanted " << place << "\n" << complaints << Legend(source);
  }
}
