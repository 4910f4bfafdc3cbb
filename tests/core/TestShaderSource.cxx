// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Shaders put together: every line of every file is there once, under the number that a compiler would report.
#include "vtkIBLShaderSource.h"

#include "vtkIBLShaderTexts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

namespace
{
const std::filesystem::path Folder = VTKIBL_SOURCE "/shaders";

std::string Read(const std::string& name)
{
  std::ifstream file(Folder / name);
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

std::vector<std::string> Split(const std::string& text)
{
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
  {
    lines.push_back(line);
  }
  return lines;
}

bool BeginsWith(const std::string& line, const std::string& word)
{
  return line.compare(0, word.size(), word) == 0;
}

std::size_t Count(const std::string& text, const std::string& word)
{
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
  {
    ++count;
  }
  return count;
}

std::vector<std::string> GetNames()
{
  std::vector<std::string> names;
  for (const vtkIBLShaderText* entry = vtkIBLShaderTexts; entry->Name; ++entry)
  {
    names.emplace_back(entry->Name);
  }
  return names;
}
}

// What is compiled in is what is in the folder, to the byte: none missing, none left over. Mutant: a file taken from
// the list.
TEST(ShaderSource, HoldsTheFolder)
{
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(Folder))
  {
    if (entry.path().extension() == ".glsl")
    {
      files.insert(entry.path().filename().string());
    }
  }
  EXPECT_GT(files.size(), 10u);
  const std::vector<std::string> names = GetNames();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()), files);
  EXPECT_EQ(names.size(), files.size());
  for (const vtkIBLShaderText* entry = vtkIBLShaderTexts; entry->Name; ++entry)
  {
    EXPECT_EQ(entry->Text, Read(entry->Name)) << entry->Name;
  }
}

// Follows #line as a compiler does (GLSL 4.50, 3.4: the next line has that number) and finds each line in its file,
// where it says. Every line of every file is there once; includes are what is not. Mutants: mark(number) after an
// include; file numbers counted from 1; no mark at the end of an include.
TEST(ShaderSource, LineNumbersAreTheFiles)
{
  for (const std::string& name : GetNames())
  {
    const vtkIBLShaderSource source = vtkIBLAssembleShader(name);
    std::vector<std::vector<std::string>> files;
    std::map<std::pair<int, int>, int> seen; // by file and line
    for (const std::string& file : source.Files)
    {
      const std::vector<std::string> lines = Split(Read(file));
      for (std::size_t i = 0; i < lines.size(); ++i)
      {
        seen[{ static_cast<int>(files.size()), static_cast<int>(i + 1) }] = BeginsWith(lines[i], "#include") ? 1 : 0;
      }
      files.push_back(lines);
    }

    int file = -1;
    int number = 0;
    const std::vector<std::string> lines = Split(source.Text);
    ASSERT_EQ(lines[0], "#version 450");
    for (std::size_t i = 1; i < lines.size(); ++i)
    {
      if (std::sscanf(lines[i].c_str(), "#line %d %d", &number, &file) == 2)
      {
        continue;
      }
      ASSERT_GE(file, 0) << name;
      ASSERT_LT(file, int(files.size())) << name;
      ASSERT_GE(number, 1) << name;
      ASSERT_LE(number, int(files[file].size())) << name << ": " << source.Files[file];
      ASSERT_EQ(lines[i], files[file][number - 1]) << name << ": " << source.Files[file] << ":" << number;
      ++seen[{ file, number }];
      ++number;
    }
    for (const auto& [place, times] : seen)
    {
      EXPECT_EQ(times, 1) << name << ": " << source.Files[place.first] << ":" << place.second;
    }
  }
}

// A file comes once, however often it is asked for: its definitions would be there twice. vtkIBLShared.glsl heads every
// shader, its own as well. Mutant: no look at Files.
TEST(ShaderSource, IncludesOnce)
{
  for (const std::string& name : GetNames())
  {
    const vtkIBLShaderSource source = vtkIBLAssembleShader(name);
    EXPECT_EQ(source.Files[0], "vtkIBLShared.glsl");
    EXPECT_EQ(std::set<std::string>(source.Files.begin(), source.Files.end()).size(), source.Files.size()) << name;
    EXPECT_EQ(Count(source.Text, "#define IBL_TILE"), 1u) << name;
    EXPECT_EQ(Count(source.Text, "#include"), 0u) << name;
  }
  EXPECT_EQ(vtkIBLAssembleShader("vtkIBLShared.glsl").Files.size(), 1u);
  const vtkIBLShaderSource table = vtkIBLAssembleShader("vtkIBLBRDFTableCS.glsl");
  EXPECT_EQ(Count(table.Text, "\nvec2 iblSplitSum("), 1u);
  EXPECT_NE(std::find(table.Files.begin(), table.Files.end(), "vtkIBLSamplingFunctions.glsl"), table.Files.end());
}

// A chunk is the same text without what only a whole shader may have. Mutant: markLines true.
TEST(ShaderSource, ChunkHasNoVersionAndNoLine)
{
  for (const std::string& name : GetNames())
  {
    const std::string chunk = vtkIBLAssembleChunk(name);
    std::string expected;
    for (const std::string& line : Split(vtkIBLAssembleShader(name).Text))
    {
      expected += BeginsWith(line, "#version") || BeginsWith(line, "#line") ? "" : line + "\n";
    }
    EXPECT_EQ(chunk, expected) << name;
    EXPECT_EQ(Count("\n" + chunk, "\n#line") + Count("\n" + chunk, "\n#version"), 0u) << name;
  }
}

// Our own mistake is told by name. Mutant: an empty text for it.
TEST(ShaderSource, UnknownName)
{
  for (const char* name : { "", "vtkIBLNoSuch.glsl", "vtkIBLShared", "vtkiblshared.glsl" })
  {
    try
    {
      vtkIBLAssembleShader(name);
      ADD_FAILURE() << name;
    }
    catch (const std::logic_error& error)
    {
      EXPECT_EQ(error.what(), std::string("no shader named ") + name);
    }
    EXPECT_THROW(vtkIBLAssembleChunk(name), std::logic_error);
  }
}
