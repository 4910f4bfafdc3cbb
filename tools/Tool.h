// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What the commands of vtkibl share. Whatever goes wrong is thrown as a std::exception whose text is one clear line.
#pragma once

#include "vtkIBLEnvironment.h"
#include "vtkIBLOffscreenWindow.h"

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <CLI/CLI.hpp>
#include <OpenImageIO/imageio.h>
#include <nlohmann/json.hpp>

#include <array>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

class vtkIBLProbe;
class vtkIBLRenderPass;
class vtkPolyData;
class vtkRenderer;

namespace tool
{
using Failure = std::runtime_error;
using JSON = nlohmann::ordered_json;
using Bytes = std::vector<unsigned char>;

/// Version of what is written in JSON: raised when a key changes its meaning or goes.
constexpr int FormatVersion = 1;
extern const char* const Generator; // "vtkibl 0.1.0"

void AddBake(CLI::App& app);
void AddInfo(CLI::App& app);
void AddProbe(CLI::App& app);
void AddRender(CLI::App& app);
void AddSphere(CLI::App& app);

// ---- Messages (Messages.cxx) -------------------------------------------------------------------------------------

/// From here on VTK's errors and warnings are kept instead of printed.
void CatchMessages();
/// Throws the first error that VTK reported since the last call, without its banner, as a Failure.
void ThrowIfError(const std::string& prefix = "");
/// VTK's first warning since the last call in the same way; empty when there was none.
std::string TakeWarning();
/// `text` in one line: line breaks and runs of blanks become one blank.
std::string OneLine(const std::string& text);
void PrintWarning(const std::string& text);

/// A bar on stderr, if that is a terminal and the work takes more than half a second; gone when the work is done.
class Progress
{
public:
  Progress();
  ~Progress() { this->Finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void Set(double share, const std::string& doing);
  /// Takes the bar away, so that something else can be printed.
  void Finish();

private:
  void Paint();

  std::mutex Mutex; // guards the next three
  double Share = 0.0;
  std::string Doing;
  bool Done = false;
  std::condition_variable Changed;
  std::thread Painter;
};

// ---- Options (Options.cxx) ---------------------------------------------------------------------------------------

struct Size
{
  int Width;
  int Height;
};

/// Number in [least, most], or in (least, most] when `open`; NaN is refused.
CLI::Validator InRange(double least, double most, bool open = false);
/// An option of `separator`-separated numbers, each in [least, most], as many as `numbers` has.
CLI::Option* AddNumbers(CLI::App* app, const std::string& name, std::vector<double>& numbers, char separator,
  double least, double most, const std::string& form, const std::string& help);
CLI::Option* AddSize(CLI::App* app, Size& size);
/// The last extension, lower case, with its dot.
std::string Extension(const std::string& fileName);
CLI::Validator HasExtension(const std::vector<std::string>& extensions);

// ---- Light and surfaces (Light.cxx, Surface.cxx) -----------------------------------------------------------------

/// Light of an image file, out of vtkIBLCache if that is on; one that can't be read throws.
vtkSmartPointer<vtkIBLEnvironment> ReadEnvironment(const std::string& fileName, Progress& progress);
/// Makes the window's context.
void StartWindow(vtkIBLOffscreenWindow* window, Size size);
/// A probe out of its file; one that can't be read throws.
vtkSmartPointer<vtkIBLProbe> ReadProbe(const std::string& fileName);
/// "source", "size" and "mean" of the light.
JSON DescribeEnvironment(const std::string& fileName, vtkIBLEnvironment* environment);
/// Unit direction of the middle of texel (i, j, k) of an environment's image.
std::array<double, 3> GetTexelDirection(const int dimensions[3], int i, int j, int k);

/// Triangles of a .vtp .vtu .vti .stl .ply .obj file, with point normals.
vtkSmartPointer<vtkPolyData> ReadSurface(const std::string& fileName);

// ---- Scenes (Scene.cxx) ------------------------------------------------------------------------------------------

/// Meshes of one material in an environment's light.
struct Scene
{
  std::vector<std::string> Meshes;
  std::string Environment;
  double Roughness = 0.3;
  double Metallic = 0.0;
  std::vector<double> Color = { 0.8, 0.8, 0.8 };
  double Rotation = 0.0;
  double Intensity = 1.0;
};

void AddScene(CLI::App* command, Scene& scene);
/// All of it is in sight.
void MakeScene(const Scene& scene, vtkRenderer* renderer, vtkIBLRenderPass* ibl, Progress& progress);

// ---- Files (Files.cxx) -------------------------------------------------------------------------------------------

/// Float OpenEXR in memory. `metadata` become attributes.
Bytes EncodeEXR(
  int width, int height, const std::vector<std::string>& channels, const float* pixels, const JSON& metadata);
Bytes EncodePNG(int width, int height, const unsigned char* rgb);
Bytes EncodeJSON(const JSON& json);
/// Rows from bottom-up, as VTK has them, to top-down, as files have them.
template <typename T>
std::vector<T> FlipRows(const T* pixels, int width, int height, int channels);

/// Throws, before any work is done, when no file can be written to `path`: no such folder, or something else is there.
void CheckOutput(const std::filesystem::path& path);

/// Files that appear together or not at all: each is first written beside its place under another name. The last one
/// describes the others, so an older one is removed before, and the new one is put in place after them.
class OutputFiles
{
public:
  OutputFiles() = default;
  ~OutputFiles();
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;
  void Add(const std::filesystem::path& path, const Bytes& bytes);
  void Commit();

private:
  struct File
  {
    std::filesystem::path Written, Place;
  };
  std::vector<File> Files;
};

template <typename T>
std::vector<T> FlipRows(const T* pixels, int width, int height, int channels)
{
  std::vector<T> flipped;
  const std::ptrdiff_t row = std::ptrdiff_t(width) * channels;
  flipped.reserve(row * height);
  for (int j = height - 1; j >= 0; --j)
  {
    flipped.insert(flipped.end(), pixels + j * row, pixels + (j + 1) * row);
  }
  return flipped;
}
}
