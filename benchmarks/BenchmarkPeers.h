// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// VTK's own image-based lighting, stage by stage, and Filament's cmgen, as tests drive them, too.
#pragma once

#include "Benchmark.h"

#include <vtkOpenGLTexture.h>
#include <vtkRenderer.h>
#include <vtkSphericalHarmonics.h>

class vtkOpenGLRenderer;

namespace vtkIBLBenchmark
{
/// The textures that VTK's renderer makes of a panorama, each made when told, in a window of its own.
class VTKLight
{
public:
  explicit VTKLight(vtkImageData* panorama);
  ~VTKLight();
  VTKLight(const VTKLight&) = delete;
  VTKLight& operator=(const VTKLight&) = delete;

  Sample LoadTexture(); // the panorama itself, with mip levels
  Sample LoadPrefiltered(int samples);
  Sample LoadTable();
  Sample LoadIrradiance(int faceSize); // only where UseSphericalHarmonics is off
  Sample LoadHarmonics();
  /// Irradiance of the nine coefficients.
  RGB GetIrradiance(Vec3 normal);

  vtkOpenGLRenderer* GetRenderer();
  static unsigned int GetHandle(vtkOpenGLTexture* texture);

  vtkNew<vtkIBLOffscreenWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkOpenGLTexture> Texture;
  vtkNew<vtkSphericalHarmonics> Harmonics;
};

std::string MakeScratchFolder();
void WriteEXR(vtkImageData* panorama, const std::string& file);

/// A picture of 32-bit floats, the only lossless one that cmgen writes; row 0 at the top.
struct PSD
{
  int Width = 0;
  int Height = 0;
  std::vector<float> RGB;
};
PSD ReadPSD(const std::string& file);

/// Irradiance on a surface with that normal, from nine coefficients of radiance (z polar, with the Condon-Shortley
/// sign, as VTK and cmgen have them). Never negative.
RGB EvaluateIrradiance(const std::vector<RGB>& coefficients, Vec3 normal);

/// cmgen's cube as its filter reads it, as a panorama: bilinear, texel i at i where it should be at i + 1/2.
vtkIBLReference::Environment ReadAsCmgen(const Cube& cube, int width);

/// cmgen's six faces `<prefix>px.psd` … as a cube in GL's order and our frame.
Cube ReadCmgenCube(const std::string& prefix);

/// A table of (A, B) with texel centres at (i + 1/2) / size, NoV across, roughness up.
SplitSum ReadCentredTable(const std::vector<float>& texels, int size, double NoV, double roughness);
}
