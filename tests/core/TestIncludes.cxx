// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Who may know whom, read off #include lines: core knows neither VTK nor GL, the witness knows nothing of the accused,
// users know no private header, and the render pass knows no image files.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;
const fs::path Root = VTKIBL_SOURCE;

struct Include
{
  std::string Where; // file:line
  std::string Name;
  bool Angled;
};

std::string Read(const fs::path& path)
{
  std::ifstream file(path);
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

// Of all C++ and shader files below a folder, or of one file.
std::vector<Include> GetIncludes(const fs::path& place)
{
  std::vector<fs::path> files;
  if (fs::is_regular_file(Root / place))
  {
    files.push_back(Root / place);
  }
  else
  {
    for (const auto& entry : fs::recursive_directory_iterator(Root / place))
    {
      const std::set<std::string> extensions = { ".cxx", ".h", ".hpp", ".cpp", ".glsl" };
      if (extensions.count(entry.path().extension().string()))
      {
        files.push_back(entry.path());
      }
    }
  }
  const std::regex pattern("^[ \t]*#[ \t]*include[ \t]*([\"<])([^\">]+)");
  std::vector<Include> includes;
  for (const fs::path& path : files)
  {
    std::ifstream file(path);
    int number = 0;
    for (std::string line; std::getline(file, line);)
    {
      ++number;
      std::smatch match;
      if (std::regex_search(line, match, pattern))
      {
        includes.push_back({ path.string() + ":" + std::to_string(number), match[2], match[1] == "<" });
      }
    }
  }
  EXPECT_GT(includes.size(), 3u) << "nothing was read below " << place;
  return includes;
}

bool IsStandard(const Include& include)
{
  return include.Angled && include.Name.find_first_of("./") == std::string::npos;
}

bool IsIn(const Include& include, const char* folder)
{
  return !include.Angled && include.Name.find('/') == std::string::npos && fs::exists(Root / folder / include.Name);
}
}

// The standard library, GLM, the FFT, its own headers, the shaders' texts and what is made of them. Mutant: #include
// "vtkMath.h".
TEST(Includes, CoreKnowsNeitherVTKNorGL)
{
  for (const Include& include : GetIncludes("vtkIBL/core"))
  {
    const bool isText =
      IsIn({ "", fs::path(include.Name).replace_extension(".glsl").string(), include.Angled }, "shaders");
    const bool isLibrary = include.Name.compare(0, 4, "glm/") == 0 || include.Name == "kissfft/kissfft.hh";
    EXPECT_TRUE(IsStandard(include) || isLibrary || IsIn(include, "vtkIBL/core") || isText)
      << include.Where << " includes " << include.Name;
  }
}

// The standard library, itself, GoogleTest. Mutant: #include "vtkIBLShaderFunctions.h".
TEST(Includes, ReferenceKnowsNothingOfTheProduct)
{
  for (const Include& include : GetIncludes("tests/reference"))
  {
    EXPECT_TRUE(IsStandard(include) || include.Name == "gtest/gtest.h" || IsIn(include, "tests/reference"))
      << include.Where << " includes " << include.Name;
  }
}

// Examples are for users to copy: they have what is installed. So has the stranger of tests/consumer.
// Mutants: #include "vtkIBLGL.h"; #include "../vtkIBL/core/vtkIBLStudio.h".
TEST(Includes, ExamplesKnowNoPrivateHeader)
{
  // As the module's CMakeLists.txt tells them.
  const std::string text = Read(Root / "vtkIBL/CMakeLists.txt");
  std::smatch match;
  ASSERT_TRUE(std::regex_search(text, match, std::regex("PRIVATE_HEADERS([^)]*)\\)")));
  std::istringstream words(match[1]);
  std::set<std::string> forbidden{ std::istream_iterator<std::string>(words), std::istream_iterator<std::string>() };
  EXPECT_TRUE(forbidden.count("vtkIBLGL.h"));
  for (const auto& entry : fs::directory_iterator(Root / "vtkIBL/core"))
  {
    forbidden.insert(entry.path().filename().string());
  }
  for (const char* folder : { "examples", "tests/consumer" })
  {
    for (const Include& include : GetIncludes(folder))
    {
      EXPECT_FALSE(forbidden.count(fs::path(include.Name).filename().string()))
        << include.Where << " includes " << include.Name;
    }
  }
}

// Light comes from vtkIBLEnvironment, whatever it was read from. Mutant: #include "vtkIBLImageReader.h".
TEST(Includes, RenderPassKnowsNoImageFile)
{
  for (const Include& include : GetIncludes("vtkIBL/vtkIBLRenderPass.cxx"))
  {
    for (const char* word : { "Reader", "Writer", "OpenImageIO", "OpenEXR", "fstream", "filesystem" })
    {
      EXPECT_EQ(include.Name.find(word), std::string::npos) << include.Where << " includes " << include.Name;
    }
  }
}
