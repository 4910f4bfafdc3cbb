// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLShaderSource.h"

#include "vtkIBLShaderTexts.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace
{
const char* Find(const std::string& name)
{
  for (const vtkIBLShaderText* entry = vtkIBLShaderTexts; entry->Name; ++entry)
  {
    if (name == entry->Name)
    {
      return entry->Text;
    }
  }
  throw std::logic_error("no shader named " + name);
}

void Append(vtkIBLShaderSource& source, const std::string& name, bool markLines)
{
  if (std::find(source.Files.begin(), source.Files.end(), name) != source.Files.end())
  {
    return;
  }
  const size_t file = source.Files.size();
  source.Files.push_back(name);
  auto mark = [&](int line)
  {
    if (markLines)
    {
      source.Text += "#line " + std::to_string(line) + " " + std::to_string(file) + "\n";
    }
  };
  mark(1);
  std::istringstream lines(Find(name));
  const std::string include = "#include \"";
  int number = 0;
  for (std::string line; std::getline(lines, line);)
  {
    ++number;
    if (line.compare(0, include.size(), include) == 0)
    {
      Append(source, line.substr(include.size(), line.rfind('"') - include.size()), markLines);
      mark(number + 1);
    }
    else
    {
      source.Text += line + "\n";
    }
  }
}
}

vtkIBLShaderSource vtkIBLAssembleShader(const std::string& name)
{
  vtkIBLShaderSource source;
  source.Text = "#version 450\n";
  Append(source, "vtkIBLShared.glsl", true);
  Append(source, name, true);
  return source;
}

std::string vtkIBLAssembleChunk(const std::string& name)
{
  vtkIBLShaderSource source;
  Append(source, "vtkIBLShared.glsl", false);
  Append(source, name, false);
  return source.Text;
}
