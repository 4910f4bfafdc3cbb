// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLRadianceImage.h"

#include "vtkIBLShaderFunctions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace
{
bool IsSound(const float* rgb)
{
  // The negated comparison is true for NaN.
  return !std::any_of(rgb, rgb + 3, [](float x) { return !(std::abs(x) <= vtkIBLLargestRadiance); });
}

bool AreClean(const float* values, std::size_t count)
{
  int faults = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    faults += !(values[i] >= 0.0f && values[i] <= vtkIBLLargestRadiance); // NaN, too
  }
  return faults == 0;
}

std::array<float, 3> MeanOfSoundNeighbours(const vtkIBLRadianceImage& image, int face, int row, int column)
{
  std::array<double, 3> sum = {};
  int count = 0;
  for (int j = std::max(row - 1, 0); j <= std::min(row + 1, image.Height - 1); ++j)
  {
    for (int i = column - 1; i <= column + 1; ++i)
    {
      if (image.Faces == 6 && (i < 0 || i >= image.Width))
      {
        continue; // a cube face ends; longitude wraps
      }
      const int wrapped = (i + image.Width) % image.Width;
      const float* rgb = &image.RGB[3 * ((static_cast<std::size_t>(face) * image.Height + j) * image.Width + wrapped)];
      if (IsSound(rgb))
      {
        ++count;
        for (int k = 0; k < 3; ++k)
        {
          sum[k] += std::max(rgb[k], 0.0f);
        }
      }
    }
  }
  const double scale = count > 0 ? 1.0 / count : 0.0;
  return { float(sum[0] * scale), float(sum[1] * scale), float(sum[2] * scale) };
}
}

vtkIBLRadianceFaults vtkIBLCleanRadiance(vtkIBLRadianceImage& image)
{
  vtkIBLRadianceFaults faults;
  struct Repair
  {
    std::size_t Texel;
    std::array<float, 3> RGB;
  };
  std::vector<Repair> repairs; // applied last, so that a repaired texel is nobody's sound neighbour
  for (std::size_t texel = 0; texel < image.GetNumberOfTexels(); ++texel)
  {
    // Nearly all are sound: look at many at once.
    constexpr std::size_t block = 64;
    if (texel % block == 0 && texel + block <= image.GetNumberOfTexels() && AreClean(&image.RGB[3 * texel], 3 * block))
    {
      texel += block - 1;
      continue;
    }
    float* rgb = &image.RGB[3 * texel];
    bool notFinite = false;
    bool tooLarge = false;
    float least = 0.0f;
    for (int k = 0; k < 3; ++k)
    {
      const bool sound = std::abs(rgb[k]) <= vtkIBLLargestRadiance; // false for NaN
      notFinite = notFinite || !std::isfinite(rgb[k]);
      tooLarge = tooLarge || (std::isfinite(rgb[k]) && !sound);
      least = sound ? std::min(least, rgb[k]) : least;
    }
    faults.NotFinite += notFinite;
    faults.TooLarge += tooLarge;
    faults.Negative += least < 0.0f;
    faults.MostNegative = std::min(faults.MostNegative, least);
    if (notFinite || tooLarge)
    {
      const std::size_t row = texel / image.Width;
      repairs.push_back({ texel,
        MeanOfSoundNeighbours(image, int(row / image.Height), int(row % image.Height), int(texel % image.Width)) });
    }
    else if (least < 0.0f)
    {
      std::transform(rgb, rgb + 3, rgb, [](float x) { return std::max(x, 0.0f); });
    }
  }
  for (const Repair& repair : repairs)
  {
    std::copy(repair.RGB.begin(), repair.RGB.end(), &image.RGB[3 * repair.Texel]);
  }
  return faults;
}

double vtkIBLMeanLuminance(const vtkIBLRadianceImage& image)
{
  vtkIBLCore::ShaderFunctions<double> shader;
  double sum = 0.0;
  double solidAngle = 0.0;
  for (int face = 0; face < image.Faces; ++face)
  {
    for (int row = 0; row < image.Height; ++row)
    {
      // sin at the row's centre is proportional to the row's exact solid angle: cos a - cos b = 2 sin((a+b)/2)
      // sin((b-a)/2).
      const double rowWeight = std::sin((row + 0.5) / image.Height * shader.iblPi);
      const float* rgb = &image.RGB[3 * (static_cast<std::size_t>(face) * image.Height + row) * image.Width];
      for (int column = 0; column < image.Width; ++column, rgb += 3)
      {
        double weight = rowWeight;
        if (image.Faces == 6)
        {
          const double step = 2.0 / image.Width;
          weight = shader.iblCubeSolidAngle(
            column * step - 1.0, row * step - 1.0, (column + 1) * step - 1.0, (row + 1) * step - 1.0);
        }
        sum += weight * (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]);
        solidAngle += weight;
      }
    }
  }
  const double mean = solidAngle > 0.0 ? sum / solidAngle : 0.0;
  return mean < vtkIBLLeastMeanLuminance ? 0.0 : mean;
}
