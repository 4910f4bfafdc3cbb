// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Bright texels side by side as one light.
#pragma once

#include "vtkIBLSpectrum.h"

#include <glm/glm.hpp>

#include <vector>

struct vtkIBLLampCluster
{
  glm::dvec3 Direction;    // unit
  glm::dvec3 Power;        // radiance x solid angle [sr]
  double Radius;           // all texels' middles are within [rad, or the chord's]
  double Variance;         // of direction along either tangent, the texels' own size in it [rad^2]
  std::vector<int> Texels; // indices
};

/// Takes the strongest texel that is left and all within `radius` of it [rad], until none is left; strongest first.
std::vector<vtkIBLLampCluster> vtkIBLFindLampClusters(const std::vector<vtkIBLBrightTexel>& texels, double radius);
