// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLLadder.h"

#include "vtkIBLLamps.h"
#include "vtkIBLLegendre.h"
#include "vtkIBLShaderFunctions.h"
#include "vtkIBLSimd.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <numeric>

namespace
{
constexpr double Pi = 3.14159265358979323846;
using Functions = vtkIBLCore::ShaderFunctions<double>;

// The mean of a parabola's distance from its chord, over its second difference.
constexpr double Twelfth = 1.0 / 12.0;
}

int vtkIBLLadder::GetNumberOfLevels() const
{
  int levels = 0;
  for (int size = this->EvenFaceSize; size >= 8; size /= 2)
  {
    ++levels;
  }
  return levels;
}

vtkIBLLadder vtkIBLLadder::Refined() const
{
  vtkIBLLadder next = *this;
  (next.EvenFaceSize < next.FaceSize ? next.EvenFaceSize : next.FaceSize) *= 2;
  return next;
}

double vtkIBLLadder::GetPerceptualRoughness(double layer) const
{
  return Functions().iblPerceptualRoughnessFromLayer(layer, this->GetNumberOfLayers());
}

double vtkIBLLadder::GetLayer(double perceptualRoughness) const
{
  const double last = this->GetNumberOfLayers();
  return std::clamp(Functions().iblLayerFromPerceptualRoughness(perceptualRoughness, last), 0.0, last);
}

void vtkIBLLadder::GetLayers(double minimum, double maximum, int& first, int& last) const
{
  // A shader's single precision may land on the other side of a layer.
  constexpr double slack = 1e-4;
  first = std::max(static_cast<int>(std::floor(this->GetLayer(minimum) - slack)), 0);
  last = std::min(static_cast<int>(std::ceil(this->GetLayer(maximum) + slack)), this->GetNumberOfLayers());
}

std::vector<vtkIBLLobe> vtkIBLLadder::GetLobes(int layer) const
{
  if (layer <= 1 || layer >= this->GetNumberOfLayers())
  {
    return { { this->GetPerceptualRoughness(layer), 1.0 } };
  }
  return { { this->GetPerceptualRoughness(layer), 1.0 + 2.0 * Twelfth },
    { this->GetPerceptualRoughness(layer - 1), -Twelfth }, { this->GetPerceptualRoughness(layer + 1), -Twelfth } };
}

//------------------------------------------------------------------------------
namespace
{
// What is known of the light when its reading is judged.
struct Statistics
{
  Statistics(const vtkIBLSpectrum& spectrum, const vtkIBLParallelFor& parallelFor)
    : Power(spectrum.GetOrder() + 1, 0.0)
  {
    const int order = spectrum.GetOrder();
    const std::vector<float>& coefficients = spectrum.GetCoefficients();
    for (int m = 0; m <= order; ++m)
    {
      for (int l = m; l <= order; ++l)
      {
        const float* x = &coefficients[vtkIBLLegendre::Offset(order, m, l)];
        this->Power[l] += std::inner_product(x, x + 6, x, 0.0) / 3.0;
      }
    }
    const double smooth = (coefficients[0] + coefficients[1] + coefficients[2]) / 3.0 / std::sqrt(4.0 * Pi);
    double lights = 0.0;
    for (const vtkIBLBrightTexel& texel : spectrum.GetBrightTexels())
    {
      lights += (texel.Radiance.r + texel.Radiance.g + texel.Radiance.b) / 3.0 * texel.SolidAngle / (4.0 * Pi);
    }
    this->Mean = smooth + lights;
    this->LightShare = this->Mean > 0.0 ? lights / this->Mean : 0.0;

    this->SharpMeanOverRMS = GetMeanOverRMS(spectrum, SharpRoughness, parallelFor);
    this->RoughMeanOverRMS = GetMeanOverRMS(spectrum, RoughRoughness, parallelFor);
  }

  // How much the error's mean is of its root mean square depends on how the light is spread; what broadens when
  // roughness grows, a second difference of layers, is spread as the error is. Told at two roughnesses for all.
  static constexpr double SharpRoughness = 0.17;
  static constexpr double RoughRoughness = 0.4;
  static double GetMeanOverRMS(const vtkIBLSpectrum& spectrum, double roughness, const vtkIBLParallelFor& parallelFor)
  {
    const int order = std::min(spectrum.GetOrder(), vtkIBLSpectrum::RequiredOrder(roughness, 3e-3));
    std::vector<double> change = vtkIBLSpectrum::KernelBands(roughness, order);
    for (double ratio : { 0.75, 1.0 / 0.75 })
    {
      const std::vector<double> bands = vtkIBLSpectrum::KernelBands(roughness * ratio, order);
      std::transform(
        change.begin(), change.end(), bands.begin(), change.begin(), [](double a, double b) { return a - 0.5 * b; });
    }
    double mean;
    double rms;
    spectrum.Measure(change, mean, rms, parallelFor);
    return rms > 0.0 ? mean / rms : 1.0;
  }
  double GetMeanOverRMS(double roughness) const
  {
    const double x =
      std::clamp(std::log(roughness / SharpRoughness) / std::log(RoughRoughness / SharpRoughness), -0.2, 1.0);
    return std::max(this->SharpMeanOverRMS + x * (this->RoughMeanOverRMS - this->SharpMeanOverRMS), 0.02);
  }

  std::vector<double> Power; // a band, mean over the channels
  double Mean = 0.0;
  double LightShare = 0.0; // of all light, in bright texels
  double SharpMeanOverRMS;
  double RoughMeanOverRMS;
};

// Squared distance, in texels^4 and averaged over where in a cell one reads, of a bilinear reading from what it reads,
// over the sum of squared second derivatives: 1/120 - 1/144 a direction.
constexpr double ReadingVariance = 1.0 / 720.0;

// Mean solid angle of a texel.
double GetTexelArea(int faceSize)
{
  return 4.0 * Pi / (6.0 * faceSize * faceSize);
}

// At `share` of the way from layer `below` to the next. bands[i]: of layer i as it is stored.
double PredictErrorAt(const Statistics& light, const vtkIBLLadder& ladder, int below, double share,
  const std::vector<std::vector<double>>& bands)
{
  const int order = int(light.Power.size()) - 1;
  const double roughness = ladder.GetPerceptualRoughness(below + share);
  std::vector<vtkIBLLobe> lobes;
  for (int i : { below, below + 1 })
  {
    for (vtkIBLLobe lobe : ladder.GetLobes(i))
    {
      lobe.Weight *= i == below ? 1.0 - share : share;
      lobes.push_back(lobe);
    }
  }
  // The rest of the light: an error in each band, as if all were independent.
  const std::vector<double> truth = vtkIBLSpectrum::KernelBands(roughness, order);
  const double area = (1.0 - share) * GetTexelArea(ladder.GetLayerFaceSize(below)) +
    share * GetTexelArea(ladder.GetLayerFaceSize(below + 1));
  double square = 0.0;
  for (int l = 1; l <= order; ++l)
  {
    const double laplacian = double(l) * (l + 1) * area;
    const double read = (1.0 - share) * bands[below][l] + share * bands[below + 1][l];
    const double error = read - truth[l];
    // A band too fine for the texels is lost, no more.
    const double lost = 0.5 * ReadingVariance * laplacian * laplacian;
    square += light.Power[l] * (error * error + lost / (1.0 + lost) * read * read);
  }
  // Mean of the absolute value, of an error that is small nearly everywhere.
  const double smooth = light.GetMeanOverRMS(roughness) * std::sqrt(square / (4.0 * Pi)) / light.Mean;
  // Bright texels: the error of the lobe itself, over the sphere.
  double lights = 0.0;
  if (light.LightShare > 0.0)
  {
    double integral = 0.0;
    double error = 0.0;
    const double alpha = roughness * roughness;
    std::vector<vtkIBLLamps::Kernel> kernels;
    std::transform(lobes.begin(), lobes.end(), std::back_inserter(kernels), vtkIBLLamps::MakeKernel);
    const vtkIBLLamps::Kernel exact = vtkIBLLamps::MakeKernel({ roughness, 1.0 });
    const auto evaluate = [](const vtkIBLLamps::Kernel& kernel, double oneMinusT)
    {
      const double w = kernel.OneMinusK + kernel.K * oneMinusT;
      return kernel.Scale * (1.0 - oneMinusT) / (w * w);
    };
    constexpr int steps = 64;
    for (int i = 0; i < steps; ++i)
    {
      const double x = std::pow(1.0 + 1.0 / (alpha * alpha), (i + 0.5) / steps) - 1.0; // 0 .. 1/alpha^2
      const double oneMinusT = x * alpha * alpha;
      const double weight = x + 1.0;
      const double wanted = evaluate(exact, oneMinusT);
      double read = 0.0;
      for (const vtkIBLLamps::Kernel& kernel : kernels)
      {
        read += evaluate(kernel, oneMinusT);
      }
      error += weight * std::abs(read - wanted);
      integral += weight * wanted;
    }
    // Reading it bilinearly: texels against the lobe's width.
    const double width = area / (2.0 * alpha * alpha);
    lights = light.LightShare * (error / integral + 0.8 / 26.8 * width * (1.0 + 0.3 * width));
  }
  return smooth + lights;
}
}

namespace
{
// As many bands as the spectrum has, of each layer as it is stored.
std::vector<std::vector<double>> GetStoredBands(
  const vtkIBLLadder& ladder, int first, int last, int order, const vtkIBLParallelFor& parallelFor)
{
  std::vector<std::vector<double>> plain(last + 2);
  const int begin = std::max(first - 1, 1);
  parallelFor(std::min(last + 1, ladder.GetNumberOfLayers()) + 1 - begin,
    [&](int i) { plain[begin + i] = vtkIBLSpectrum::KernelBands(ladder.GetPerceptualRoughness(begin + i), order); });
  std::vector<std::vector<double>> stored = plain;
  for (int i = std::max(first, 2); i <= std::min(last, ladder.GetNumberOfLayers() - 1); ++i)
  {
    for (int l = 0; l <= order; ++l)
    {
      stored[i][l] -= Twelfth * (plain[i - 1][l] - 2.0 * plain[i][l] + plain[i + 1][l]);
    }
  }
  return stored;
}

double PredictError(const Statistics& light, const vtkIBLLadder& ladder, double minimum, double maximum,
  const vtkIBLParallelFor& parallelFor)
{
  int first;
  int last;
  ladder.GetLayers(minimum, maximum, first, last);
  first = std::max(first, 1);
  const auto bands = GetStoredBands(ladder, first, last, int(light.Power.size()) - 1, parallelFor);
  // On each layer and halfway to the next.
  std::vector<double> errors(2 * std::max(last - first, 0), 0.0);
  parallelFor(
    int(errors.size()), [&](int i) { errors[i] = PredictErrorAt(light, ladder, first + i / 2, i % 2 * 0.5, bands); });
  return errors.empty() ? 0.0 : *std::max_element(errors.begin(), errors.end());
}
}

vtkIBLLadder vtkIBLChooseLadder(const vtkIBLSpectrum& spectrum, double tolerance, double minimum, double maximum,
  double& predictedError, const vtkIBLParallelFor& parallelFor)
{
  const Statistics light(spectrum, parallelFor);
  std::vector<vtkIBLLadder> ladders = { vtkIBLLadder(vtkIBLLadder::LeastFaceSize) };
  while (ladders.back().EvenFaceSize < vtkIBLLadder::LargestFaceSize)
  {
    ladders.push_back(ladders.back().Refined());
  }
  std::vector<double> errors(ladders.size(), 0.0);
  const auto predict = [&](std::size_t i)
  { return errors[i] = light.Mean > 0.0 ? PredictError(light, ladders[i], minimum, maximum, parallelFor) : 0.0; };
  // The first that will do: a finer one is never worse.
  std::size_t low = 0;
  for (std::size_t high = ladders.size() - 1; low < high;)
  {
    const std::size_t middle = (low + high) / 2;
    (predict(middle) <= tolerance ? high : low) = errors[middle] <= tolerance ? middle : middle + 1;
  }
  predictedError = errors[low] > 0.0 ? errors[low] : predict(low);
  return ladders[low];
}

//------------------------------------------------------------------------------
namespace
{
// Largest finite half.
constexpr float LargestHalf = 65504.0f;

// Round to nearest even, of numbers in [0, LargestHalf].
VTKIBL_INLINE std::uint16_t ToHalf(float x)
{
  std::uint32_t bits;
  std::memcpy(&bits, &x, 4);
  const std::uint32_t normal = (bits - (112u << 23) + 0xfffu + ((bits >> 13) & 1u)) >> 13;
  const float shifted = x + 0.5f; // a half below 2^-14 counts steps of 2^-24, as a float in [0.5, 1) does
  std::uint32_t denormal;
  std::memcpy(&denormal, &shifted, 4);
  return std::uint16_t(x < 6.103515625e-5f ? denormal - (126u << 23) : normal);
}

VTKIBL_WIDE void StoreRow(
  const float* above, const float* row, const float* below, int count, float scale, float share, float* values)
{
  const float side = share * scale;
  const float middle = scale - 4.0f * side;
  for (int i = 0; i < 3 * count; ++i)
  {
    const float value = middle * row[i] + side * (row[i - 3] + row[i + 3] + above[i] + below[i]);
    values[i] = value > 0.0f ? (value < LargestHalf ? value : LargestHalf) : 0.0f;
  }
}
}

void vtkIBLStoreLayer(
  const float* rgb, int faceSize, double scale, bool fit, std::uint16_t* rgba, const vtkIBLParallelFor& parallelFor)
{
  const std::ptrdiff_t stride = std::ptrdiff_t(3) * (faceSize + 2);
  parallelFor(6 * faceSize,
    [&](int index)
    {
      const int face = index / faceSize;
      const int row = index % faceSize;
      const float* in = rgb + (std::ptrdiff_t(face) * (faceSize + 2) + row + 1) * stride + 3;
      std::vector<float> values(std::size_t(3) * faceSize);
      StoreRow(in - stride, in, in + stride, faceSize, float(scale), fit ? -float(Twelfth) : 0.0f, values.data());
      std::uint16_t* out = rgba + std::size_t(4) * index * faceSize;
      for (int i = 0; i < faceSize; ++i, out += 4)
      {
        out[0] = ToHalf(values[3 * i]);
        out[1] = ToHalf(values[3 * i + 1]);
        out[2] = ToHalf(values[3 * i + 2]);
        out[3] = 0x3c00; // 1
      }
    });
}
