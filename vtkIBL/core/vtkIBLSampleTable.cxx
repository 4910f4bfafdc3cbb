// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLSampleTable.h"

#include "vtkIBLShaderFunctions.h"

#include <algorithm>
#include <cmath>

namespace
{
// Half vectors' polar angle that holds 99 % of D NoH, as a share of that at alpha = 1 (Heitz 2014's sampling inverted).
double LobeShare(double alpha)
{
  const double share = 0.99;
  const double angle = std::acos(std::sqrt((1.0 - share) / (share * (alpha * alpha - 1.0) + 1.0)));
  return angle / std::acos(std::sqrt(1.0 - share));
}
}

vtkIBLSampleTable vtkIBLMakeSampleTable(double perceptualRoughness, int sourceSize, int layerSize, int maximumSamples)
{
  vtkIBLCore::ShaderFunctions<double> shader;
  const double alpha = shader.iblAlpha(perceptualRoughness);
  const double finestLevel = std::max(std::log2(double(sourceSize) / layerSize), 0.0);
  vtkIBLSampleTable table;
  if (alpha <= 0.0)
  {
    table.Samples = { glm::vec4(0.0, 0.0, 1.0, finestLevel) };
    table.Weights = { 1.0f };
    return table;
  }
  // Below 64 even a narrow lobe shows its samples: 3.6 % with 32, 2.2 % with 64, at roughness 0.1 of a courtyard.
  const auto count = static_cast<unsigned int>(
    std::max(std::lround(maximumSamples * LobeShare(alpha)), std::min(64L, long(maximumSamples))));
  double sum = 0.0;
  std::vector<double> weights;
  for (unsigned int i = 0; i < count; ++i)
  {
    const auto point = shader.iblHammersley(i, count);
    const auto half = shader.iblHalfVectorGGX(point.x, alpha); // cos^2, sin^2
    const double NoL = half.x - half.y;                        // L is V mirrored at H: twice the angle
    if (NoL <= 0.0)
    {
      continue;
    }
    const double phi = 2.0 * shader.iblPi * point.y;
    const double sine = 2.0 * std::sqrt(half.x * half.y);
    const double pdf = shader.iblD_GGX(half.x, half.y, alpha) / 4.0; // of L: D NoH / (4 VoH), with V = N
    const double level = std::max(shader.iblFilteredLod(pdf, count, sourceSize), finestLevel);
    table.Samples.emplace_back(sine * std::cos(phi), sine * std::sin(phi), NoL, level);
    weights.push_back(NoL);
    sum += NoL;
  }
  for (double weight : weights)
  {
    table.Weights.push_back(static_cast<float>(weight / sum));
  }
  return table;
}
