// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Linear RGB radiance over all directions, in memory that somebody else owns.
#pragma once

#include "vtkIBLShared.glsl"

#include <cstddef>

struct vtkIBLRadianceImage
{
  float* RGB = nullptr; // Faces x Height x Width x 3
  int Width = 0;
  int Height = 0;
  int Faces = 1; // 1: lat-long, row 0 straight down; 6: cube faces in GL order, row 0 at t = -1

  std::size_t GetNumberOfTexels() const { return static_cast<std::size_t>(Width) * Height * Faces; }
};

/// What vtkIBLCleanRadiance found, in texels. A texel with several faults counts once in each.
struct vtkIBLRadianceFaults
{
  std::size_t NotFinite = 0; // NaN or infinity in a channel
  std::size_t TooLarge = 0;  // above vtkIBLLargestRadiance
  std::size_t Negative = 0;
  float MostNegative = 0.0f;
};

/// The brightest radiance taken at its word. The sun's disc is 2e9 cd/m2; a larger value is a broken texel.
constexpr float vtkIBLLargestRadiance = IBL_LARGEST_RADIANCE;

/// Negative channels become 0. A texel that is not finite or too large becomes the mean of its sound neighbours among
/// the eight around it (black if there are none), so that one broken texel neither darkens nor dominates.
vtkIBLRadianceFaults vtkIBLCleanRadiance(vtkIBLRadianceImage& image);

/// Light is divided by its mean, in floats: below this, it is black.
constexpr double vtkIBLLeastMeanLuminance = 1e-32;

/// Mean luminance (Rec. 709 weights) over the sphere, weighted by solid angle; double sums. 0 when it is below the least.
double vtkIBLMeanLuminance(const vtkIBLRadianceImage& image);
