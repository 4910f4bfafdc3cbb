// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The built vtkibl, run in a folder of its own, and what it wrote there.
#pragma once

#include "TestSupport.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

struct Outcome
{
  int Status;
  std::string Out;
  std::string Err;
};

/// Top row first, as in the file.
struct Picture
{
  int Width = 0;
  int Height = 0;
  std::vector<std::string> Channels;
  std::vector<float> Values;
  const float* At(int column, int row) const
  {
    return &this->Values[(std::size_t(row) * this->Width + column) * this->Channels.size()];
  }
};

class ToolTest : public ::testing::Test
{
protected:
  void SetUp() override;
  void TearDown() override;

  /// `vtkibl ARGUMENTS` by the shell, in Folder; `before` is what the shell does first.
  Outcome Run(const std::string& arguments, const std::string& before = "") const;
  /// The same, and it has to succeed without a word on stderr.
  std::string RunWell(const std::string& arguments) const;

  void WriteText(const std::string& name, const std::string& text) const;
  /// Float OpenEXR of a lat-long image.
  void WritePanorama(const std::string& name, vtkImageData* panorama) const;
  /// The same of one value.
  void WriteConstant(const std::string& name, RGB radiance) const;
  Picture ReadPicture(const std::string& name) const;
  nlohmann::json ReadJSON(const std::string& name) const;
  /// All files and folders below Folder, sorted.
  std::vector<std::string> List() const;

  std::filesystem::path Folder; // its name has a blank
};

/// The same, skipped where there is no OpenGL 4.5.
class ToolGLTest : public ToolTest
{
protected:
  void SetUp() override;
};
