// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLSampleTable.h"

#include "vtkIBLShaderFunctions.h"

#include <algorithm>
#include <cmath>

namespace
{
// Both by measurement over eight HDRIs, at 64 samples: the levels that a B-spline pyramid is read finer than a sample's
// solid angle, for it is three texels wide; and the square of a texel's edge that a sample moves inwards in theta^2/2,
// for reading blurs.
constexpr double LevelOffset = -0.25;
constexpr double Deblur = 1.0 / 6.0;

// What a lobe has over a rougher one, or the whole lobe: integral over the cap of height s, and density there.
class Core
{
public:
  Core(double perceptualRoughness, double tailRoughness)
    : Inner(perceptualRoughness)
    , Outer(tailRoughness)
  {
  }
  double Integral(double s) const
  {
    return vtkIBLLobeIntegral(this->Inner, s) - (this->Outer > 0.0 ? vtkIBLLobeIntegral(this->Outer, s) : 0.0);
  }
  double operator()(double s) const
  {
    return Kernel(this->Inner, s) - (this->Outer > 0.0 ? Kernel(this->Outer, s) : 0.0);
  }
  // The height of the cap that holds `integral`, to 2^-60.
  double FindCap(double integral) const
  {
    double low = 0.0;
    double high = 1.0;
    for (int step = 0; step < 60; ++step)
    {
      const double middle = 0.5 * (low + high);
      (this->Integral(middle) < integral ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

private:
  // 1 - k t as (1 - k) + k s: keeps its digits where t is near 1.
  static double Kernel(double perceptualRoughness, double s)
  {
    const double k = vtkIBLLobeSharpness(perceptualRoughness);
    const double q = std::pow(perceptualRoughness, 4) * (1.0 + k) + k * s;
    return (1.0 - s) / (q * q);
  }
  double Inner, Outer;
};
}

double vtkIBLLobeSharpness(double perceptualRoughness)
{
  const double alpha2 = std::pow(perceptualRoughness, 4);
  return (1.0 - alpha2) / (1.0 + alpha2);
}

double vtkIBLLobeIntegral(double perceptualRoughness, double s)
{
  const double k = vtkIBLLobeSharpness(perceptualRoughness);
  if (k < 0.05) // the closed form divides by k^2; K = sum of (n + 1) k^n t^(n + 1)
  {
    double sum = 0.0;
    for (int n = 11; n >= 0; --n)
    {
      sum = k * sum + (n + 1.0) / (n + 2.0) * (1.0 - std::pow(1.0 - s, n + 2));
    }
    return sum;
  }
  const double q = std::pow(perceptualRoughness, 4) * (1.0 + k); // 1 - k, with all its digits
  const double x = k * s / q;
  return (x / (q + k * s) - std::log1p(x)) / (k * k);
}

vtkIBLSampleTable vtkIBLMakeSampleTable(
  double perceptualRoughness, double tailRoughness, int sourceSize, int layerSize, int count)
{
  vtkIBLCore::ShaderFunctions<double> shader;
  const double alpha = shader.iblAlpha(perceptualRoughness);
  // At the centre of a face a texel of the layer is 2/layerSize wide, of the source 2/sourceSize; half the lobe's light
  // lies within 2 alpha.
  const double finestTexel = alpha > 0.0 ? std::min(2.0 / layerSize, 0.25 * alpha) : 2.0 / layerSize;
  const double finestLevel = std::max(std::log2(finestTexel * sourceSize / 2.0), 0.0);
  vtkIBLSampleTable table;
  if (alpha <= 0.0)
  {
    table.Samples = { glm::vec4(0.0, 0.0, 1.0, finestLevel) };
    return table;
  }
  const Core core(perceptualRoughness, tailRoughness);
  const double whole = core.Integral(1.0);
  table.TailWeight = 1.0 - whole / vtkIBLLobeIntegral(perceptualRoughness);
  const double goldenAngle = shader.iblPi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i)
  {
    const double s = core.FindCap(whole * (i + 0.5) / count);
    const double solidAngle = 2.0 * shader.iblPi * whole / (count * core(s));
    const double level =
      std::max(0.5 * std::log2(solidAngle * sourceSize * sourceSize / 4.0) + LevelOffset, finestLevel);
    const double texel = std::exp2(level) * 2.0 / sourceSize;
    const double moved = std::max(s - Deblur * texel * texel, 0.0);
    const double sine = std::sqrt(moved * (2.0 - moved));
    table.Samples.emplace_back(sine * std::cos(goldenAngle * i), sine * std::sin(goldenAngle * i), 1.0 - moved, level);
  }
  return table;
}
