// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Bright texels under GGX lobes, exactly.
#pragma once

#include "vtkIBLSpectrum.h"

#include <glm/glm.hpp>

#include <vector>

class vtkIBLLamps
{
public:
  vtkIBLLamps(const std::vector<vtkIBLBrightTexel>& texels, const std::vector<vtkIBLLobe>& lobes);

  bool IsEmpty() const { return this->Lamps.empty(); }

  /// Adds to colours, an array a channel, what the texels give under the sum of the lobes around unit directions, an
  /// array a coordinate. All arrays have Pad(count) numbers.
  void AddTo(int count, const float* const (&direction)[3], float* const (&color)[3]) const;
  static int Pad(int count);

  /// A lobe as a function of 1 - t: Scale t / (1 - k t)^2, with 1 - k t = (1 - k) + k (1 - t).
  struct Kernel
  {
    float K, OneMinusK, Scale;
  };
  static Kernel MakeKernel(const vtkIBLLobe& lobe); // its integral over the sphere is the lobe's weight
  struct Light
  {
    glm::vec3 Direction, Power;
  };
  /// Bright texels side by side, mostly of one lamp. From far away they are one light in their middle: their spread
  /// counts only as its square over the distance's.
  struct Lamp
  {
    Light Whole;
    float FarSquared;
    std::vector<Light> Texels;
  };

private:
  std::vector<Kernel> Kernels;
  std::vector<Lamp> Lamps;
};
