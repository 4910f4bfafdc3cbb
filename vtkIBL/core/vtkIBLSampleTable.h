// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The samples of one layer of the specular ladder.
#pragma once

#include <glm/glm.hpp>

#include <vector>

struct vtkIBLSampleTable
{
  std::vector<glm::vec4> Samples; // xyz: unit direction in the tangent frame (normal = +z); w: mip level of the source
  std::vector<float> Weights;     // sum 1
};

/// Hammersley points drawn from GGX around N = V = R, weighted by NoL, for a source cube of `sourceSize`^2 texels a
/// face. The level of a sample is that whose texels have the solid angle it stands for, and never below that of the
/// layer's own texels
/// (`layerSize`). Samples below the horizon are left out. perceptualRoughness 0 gives the mirror: one sample.
/// The count falls with the lobe: `maximumSamples` at roughness 1, and not below 64, in proportion to the angle that
/// holds 99 % of the half vectors.
vtkIBLSampleTable vtkIBLMakeSampleTable(double perceptualRoughness, int sourceSize, int layerSize, int maximumSamples);
