// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The GGX lobe of N = V = R as numbers for shaders: its norm, and the samples of one sharp layer of the specular ladder
// (docs/derivations/sampled-filter.md).
#pragma once

#include <glm/glm.hpp>

#include <vector>

/// The kernel is K(t) = max(t, 0) / (1 - k t)^2, t the cosine to N: k = (1 - alpha^2) / (1 + alpha^2).
double vtkIBLLobeSharpness(double perceptualRoughness);

/// Integral of K from t = 1 - s to 1; s in [0, 1], perceptualRoughness in (0, 1]. To 1e-11 of itself.
double vtkIBLLobeIntegral(double perceptualRoughness, double s = 1.0);

struct vtkIBLSampleTable
{
  /// Of equal weight. xyz: unit direction in the tangent frame (normal = +z); w: mip level of the source at the centre
  /// of a face.
  std::vector<glm::vec4> Samples;
  /// Weight in [0, 1) of the layer of tailRoughness; the samples' mean has the rest.
  double TailWeight = 0.0;
};

/// `count` points on a golden spiral, spread as what the lobe has over that of `tailRoughness` (above
/// perceptualRoughness, at most 1; 0: there is none, and the samples stand for the whole lobe), for a source cube of
/// `sourceSize`^2 texels a face read through B-splines. No sample reads finer than the layer's texels (`layerSize`) or
/// than alpha/4, whichever is finer. perceptualRoughness 0 gives the mirror: one sample.
vtkIBLSampleTable vtkIBLMakeSampleTable(
  double perceptualRoughness, double tailRoughness, int sourceSize, int layerSize, int count);
