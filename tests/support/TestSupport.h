// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the module share: a window that reports GL errors, VTK's messages caught, made-up and real
// environments.
#pragma once

#include "Reference.h"

#include "vtkIBLOffscreenWindow.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

using vtkIBLReference::RGB;
using vtkIBLReference::Vec3;

/// Everything that VTK would print as error or warning, while this lives.
class CaughtMessages
{
public:
  CaughtMessages();
  ~CaughtMessages();
  /// All since the last call, as one text; empty when there was none.
  std::string Take();

private:
  class Window;
  vtkSmartPointer<Window> Catcher;
  vtkSmartPointer<vtkOutputWindow> Previous;
};

/// A test with an offscreen window in a debug context. Skipped where there is no OpenGL 4.5. Fails on any message of
/// VTK's that the test did not take, and on any GL message of high severity.
class GLTest : public ::testing::Test
{
protected:
  void SetUp() override;
  void TearDown() override;
  CaughtMessages Messages;
  vtkNew<vtkIBLOffscreenWindow> Window;
};

/// A lat-long image of f(direction) at texel centres, 2 height x height.
vtkSmartPointer<vtkImageData> MakePanorama(int height, const std::function<RGB(Vec3)>& f);
/// The same as six faces, n x n x 6.
vtkSmartPointer<vtkImageData> MakeFaces(int n, const std::function<RGB(Vec3)>& f);

/// Path of one of Debian's CC0 studio lights ("city", "studio" …), or empty where blender-data is not installed.
std::string GetHDRI(const std::string& name);

/// The same as an OpenEXR file, half floats, ZIP.
void WriteEXR(const std::filesystem::path& path, vtkImageData* panorama);

/// While this lives, vtkIBLCache has a directory of its own on disk, and nothing in it or in memory at first. Make it
/// before the environments of a test: they may write to it as long as they live.
class OwnCache
{
public:
  OwnCache();
  ~OwnCache();
  /// For the test's own files.
  std::filesystem::path GetFolder() const { return this->Folder; }

private:
  std::filesystem::path Folder;
};

/// A lat-long image for the reference.
vtkIBLReference::Environment ToReference(vtkImageData* panorama);

/// Value (i, j) of slice `face`.
RGB GetTexel(vtkImageData* image, int i, int j, int face = 0);

/// Directions through the texel centres of an n x n x 6 cube, in memory order.
std::vector<Vec3> GetCubeDirections(int n);

/// Sum of |image - truth| over sum of truth, all channels, in memory order.
double GetRelativeL1(vtkImageData* image, const std::vector<RGB>& truth);
