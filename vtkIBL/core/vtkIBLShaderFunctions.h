// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// shaders/*Functions.glsl compiled as C++ through GLM: as float for what the CPU computes, as double for tests and
// tables. What the GPU runs and what the CPU runs is one text.
#pragma once

#include "vtkIBLShared.glsl"

#include <glm/glm.hpp>
#include <glm/integer.hpp>

#include <cmath>

namespace vtkIBLCore
{
using namespace glm;

template <typename real>
struct ShaderFunctions
{
  using vec2 = glm::vec<2, real>;
  using vec3 = glm::vec<3, real>;
  using vec4 = glm::vec<4, real>;
  using mat3 = glm::mat<3, 3, real>;
  using uint = glm::uint;

#include "vtkIBLDirectionFunctions.inl"
#include "vtkIBLSamplingFunctions.inl"
#include "vtkIBLBRDFFunctions.inl"
#include "vtkIBLEnergyFunctions.inl"
#include "vtkIBLHarmonicsFunctions.inl"
#include "vtkIBLLadderFunctions.inl"
#include "vtkIBLParallaxFunctions.inl"
};
}
