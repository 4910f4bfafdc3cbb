// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The specular ladder: which layers there are, how large each is, and where it is kept. The face sizes of the two
// sharpest layers set all of it.
#pragma once

#include "vtkIBLSpectrum.h"

#include <cstdint>
#include <vector>

/// Layers 1 .. GetNumberOfLayers() of rising perceptualRoughness, from 0.1 to 1; layer 0 is the mirror, and is the
/// radiance cube itself. Odd layers are the mip levels of one cube map, even ones those of another, as large or half as
/// large: so two bilinear reads give any roughness. The last layer has 8^2 texels.
struct vtkIBLLadder
{
  static constexpr double FirstRoughness = 0.1; // of layer 1
  static constexpr int LeastFaceSize = 16;
  static constexpr int LargestFaceSize = 1024;

  explicit vtkIBLLadder(int faceSize = 128)
    : FaceSize(faceSize)
    , EvenFaceSize(faceSize / 2)
  {
  }

  int FaceSize;     // of layer 1: a power of two between the two above
  int EvenFaceSize; // of layer 2: that, or half of it

  /// The next finer one.
  vtkIBLLadder Refined() const;

  int GetNumberOfLevels() const; // of either cube map
  int GetNumberOfLayers() const { return 2 * this->GetNumberOfLevels(); }
  int GetLayerFaceSize(int layer) const
  {
    return (layer % 2 ? this->FaceSize : this->EvenFaceSize) >> GetLevel(layer);
  }
  static int GetLevel(int layer) { return (layer - 1) / 2; }

  double GetPerceptualRoughness(double layer) const;
  double GetLayer(double perceptualRoughness) const;

  /// First and last layer that roughness in [minimum, maximum] is read from, 0 the mirror.
  void GetLayers(double minimum, double maximum, int& first, int& last) const;

  /// What is stored as a layer, as lobes: not the layer's own alone, but what comes closest, in the mean over
  /// roughness, when a shader mixes two neighbours. A linear function between nodes lies above a convex one; a
  /// twelfth of the second difference less in the nodes, and it lies as much below as above.
  std::vector<vtkIBLLobe> GetLobes(int layer) const;
};

/// The smallest ladder with which a shader reads any roughness in [minimum, maximum], from 0.1 up, with a relative L1
/// error of at most `tolerance`; or the largest. And that error as it was predicted, from the spectrum: of
/// interpolation between texels and between layers. It holds within a factor of two.
vtkIBLLadder vtkIBLChooseLadder(const vtkIBLSpectrum& spectrum, double tolerance, double minimum, double maximum,
  double& predictedError, const vtkIBLParallelFor& parallelFor);

/// Filtered texels with a border of one to half-float RGBA, times `scale`, alpha 1, at most 65504: six faces of
/// faceSize^2. With `fit` not the texels themselves, but what comes closest when it is read bilinearly: again less a
/// twelfth of the second differences.
void vtkIBLStoreLayer(
  const float* rgb, int faceSize, double scale, bool fit, std::uint16_t* rgba, const vtkIBLParallelFor& parallelFor);
