// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLSpectrum.h"

#include "vtkIBLColorTransform.h"
#include "vtkIBLLampClusters.h"
#include "vtkIBLLegendre.h"
#include "vtkIBLShared.glsl"
#include "vtkIBLSimd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <iterator>
#include <memory>

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr int Group = vtkIBLLegendre::Group;
using Color = vtkIBLColor;
using Complex = vtkIBLComplexColor;

template <typename RGB>
double Luminance(const RGB& rgb)
{
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

// What is taken out, above a threshold of its own. Where a texel at the equator carries more than this share of all
// light: such texels make nearly all of the ringing.
constexpr double BrightShare = 1e-3;
constexpr double BrightFactor = 100.0; // means, at least
constexpr std::size_t MostBrightTexels = 64;
// And what shading takes as lights, the strongest clusters of dimmer ones.
constexpr double LampFactor = 20.0; // means
constexpr double LeastLamp = 5e-3;  // of all light
constexpr std::size_t MostLampTexels = 2048;
constexpr std::size_t MostCandidates = 4096; // looking for them costs the square

// Twice as wide as the bands need: what is finer moves no layer by 1e-4.
constexpr int EnoughWidth = 2048;

// `image`, or its means over blocks of texels by their solid angle, in `memory`.
vtkIBLRadianceImage Reduce(
  const vtkIBLRadianceImage& image, std::vector<float>& memory, const vtkIBLParallelFor& parallelFor)
{
  int factor = 1;
  while (image.Width / factor > EnoughWidth && image.Width % (2 * factor) == 0 && image.Height % (2 * factor) == 0)
  {
    factor *= 2;
  }
  if (factor == 1)
  {
    return image;
  }
  vtkIBLRadianceImage small;
  small.Width = image.Width / factor;
  small.Height = image.Height / factor;
  memory.resize(3 * small.GetNumberOfTexels());
  small.RGB = memory.data();
  parallelFor(small.Height,
    [&](int row)
    {
      float* out = small.RGB + std::size_t(3) * row * small.Width;
      std::fill_n(out, 3 * small.Width, 0.0f);
      const double whole = std::sin(Pi * (row + 0.5) / small.Height) * std::sin(0.5 * Pi / small.Height);
      for (int j = row * factor; j < (row + 1) * factor; ++j)
      {
        const double part = std::sin(Pi * (j + 0.5) / image.Height) * std::sin(0.5 * Pi / image.Height);
        const auto weight = float(part / whole / factor);
        const float* in = image.RGB + std::size_t(3) * j * image.Width;
        for (int i = 0; i < image.Width; ++i, in += 3)
        {
          float* texel = out + 3 * (i / factor);
          texel[0] += weight * in[0];
          texel[1] += weight * in[1];
          texel[2] += weight * in[2];
        }
      }
    });
  return small;
}

struct Bright
{
  double Luminance;
  int Row, Column;
  double Kept; // share of its light that stays where it is
};

vtkIBLBrightTexel TakeOut(const vtkIBLRadianceImage& image, const Bright& bright)
{
  // Colatitudes a to b from the lower pole: the mean direction (not the middle: by the pole a texel is a triangle) and
  // solid angle.
  const double a = Pi * bright.Row / image.Height;
  const double b = Pi * (bright.Row + 1) / image.Height;
  const double outwards = 0.5 * (b - a) - 0.25 * (std::sin(2 * b) - std::sin(2 * a)); // of sin^2
  const double down = 0.5 * (std::sin(b) * std::sin(b) - std::sin(a) * std::sin(a));  // of sin cos
  const double phi = 2.0 * Pi * (bright.Column + 0.5) / image.Width - Pi;
  const auto direction = glm::normalize(glm::dvec3(outwards * std::cos(phi), -down, outwards * std::sin(phi)));
  const double solidAngle = 2.0 * Pi / image.Width * 2.0 * std::sin(0.5 * (a + b)) * std::sin(0.5 * (b - a));
  const float* rgb = image.RGB + 3 * (std::size_t(bright.Row) * image.Width + bright.Column);
  return { direction, solidAngle, (1.0 - bright.Kept) * glm::dvec3(rgb[0], rgb[1], rgb[2]) };
}

// By row, then column.
std::vector<Bright> FindAbove(const vtkIBLRadianceImage& image, double threshold, const vtkIBLParallelFor& parallelFor)
{
  std::vector<std::vector<Bright>> rows(image.Height);
  parallelFor(image.Height,
    [&](int row)
    {
      const float* rgb = image.RGB + std::size_t(3) * row * image.Width;
      for (int column = 0; column < image.Width; ++column, rgb += 3)
      {
        if (const double luminance = Luminance(rgb); luminance > threshold)
        {
          rows[row].push_back({ luminance, row, column, threshold / luminance });
        }
      }
    });
  std::vector<Bright> bright;
  for (const std::vector<Bright>& row : rows)
  {
    bright.insert(bright.end(), row.begin(), row.end());
  }
  return bright;
}

// Texels of the strongest lamps, and the brightest of the rest; by row, then column.
std::vector<Bright> FindBrightTexels(
  const vtkIBLRadianceImage& image, double mean, const vtkIBLParallelFor& parallelFor)
{
  std::vector<Bright> all = FindAbove(image, LampFactor * mean, parallelFor);
  // A texel at the equator has the solid angle 2 pi^2 / (width height).
  const double threshold = std::max(BrightShare * 2.0 / Pi * image.Width * image.Height, BrightFactor) * mean;
  if (all.size() > MostCandidates)
  {
    std::nth_element(all.begin(), all.begin() + MostCandidates, all.end(),
      [](const Bright& a, const Bright& b) { return a.Luminance > b.Luminance; });
    all.resize(MostCandidates);
  }
  std::vector<vtkIBLBrightTexel> texels;
  std::transform(
    all.begin(), all.end(), std::back_inserter(texels), [&](const Bright& bright) { return TakeOut(image, bright); });
  std::vector<char> chosen(all.size(), 0);
  std::size_t count = 0;
  int lamps = 0;
  for (const vtkIBLLampCluster& cluster : vtkIBLFindLampClusters(texels, vtkIBLSpectrum::LampRadius))
  {
    const bool strong = Luminance(cluster.Power) > LeastLamp * 4.0 * Pi * mean;
    if (lamps < IBL_MAXIMUM_LAMPS && strong && count + cluster.Texels.size() <= MostLampTexels)
    {
      ++lamps;
      count += cluster.Texels.size();
      std::for_each(cluster.Texels.begin(), cluster.Texels.end(), [&](int i) { chosen[i] = 1; });
    }
  }
  std::vector<Bright> bright;
  std::vector<Bright> rest;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (chosen[i])
    {
      bright.push_back(all[i]);
    }
    else if (all[i].Luminance > threshold)
    {
      rest.push_back({ all[i].Luminance, all[i].Row, all[i].Column, threshold / all[i].Luminance });
    }
  }
  std::stable_sort(
    rest.begin(), rest.end(), [](const Bright& a, const Bright& b) { return a.Luminance > b.Luminance; });
  bright.insert(bright.end(), rest.begin(), rest.begin() + std::min(rest.size(), MostBrightTexels));
  std::sort(bright.begin(), bright.end(),
    [](const Bright& a, const Bright& b) { return a.Row != b.Row ? a.Row < b.Row : a.Column < b.Column; });
  return bright;
}

// A row without what its bright texels took.
void ReadRow(const vtkIBLRadianceImage& image, int row, const std::vector<Bright>& bright, Color* out)
{
  const float* rgb = image.RGB + std::size_t(3) * row * image.Width;
  for (int column = 0; column < image.Width; ++column, rgb += 3)
  {
    out[column] = Color(rgb[0], rgb[1], rgb[2]);
  }
  auto it = std::lower_bound(bright.begin(), bright.end(), row, [](const Bright& b, int r) { return b.Row < r; });
  for (; it != bright.end() && it->Row == row; ++it)
  {
    out[it->Column] *= Color(float(it->Kept));
  }
}

// For the Fourier coefficient m of a row under box reading: column i spans [i, i+1] 2 pi/width - pi, its box is a sinc,
// its middle a phase; and the mean over columns.
std::vector<std::complex<float>> MakeBoxFactors(int width, int order)
{
  std::vector<std::complex<float>> factors;
  for (int m = 0; m <= order; ++m)
  {
    const double half = Pi * m / width;
    const double box = m == 0 ? 1.0 : std::sin(half) / half;
    factors.emplace_back(std::polar(box / width, -(half - Pi * m)));
  }
  return factors;
}

// Values of one m for all latitudes, as vtkIBLLegendre takes them.
struct Columns
{
  Columns(int order, int groups)
    : Stride(groups * Group)
    , Values(new float[std::size_t(order + 1) * 12 * this->Stride])
  {
  }
  float* Get(int m) { return &this->Values[std::size_t(m) * 12 * this->Stride]; }
  float& At(int m, int c, int latitude) { return this->Values[(std::size_t(m) * 12 + c) * this->Stride + latitude]; }
  int Stride;
  std::unique_ptr<float[]> Values; // not cleared
};
}

//------------------------------------------------------------------------------
vtkIBLSpectrum::vtkIBLSpectrum(const vtkIBLRadianceImage& original, int order, const vtkIBLParallelFor& parallelFor)
  : Order(std::clamp(order, 0, MaximumOrder))
{
  std::vector<float> reduced;
  const vtkIBLRadianceImage image = Reduce(original, reduced, parallelFor);
  const int width = image.Width;
  const int height = image.Height;
  const std::vector<Bright> bright = FindBrightTexels(image, vtkIBLMeanLuminance(image), parallelFor);
  std::transform(bright.begin(), bright.end(), std::back_inserter(this->BrightTexels),
    [&](const Bright& texel) { return TakeOut(image, texel); });

  // Two Gauss points a row, in more slices when rows are few for so many bands.
  const int bands = this->Order + 1;
  // (They err by (l h)^4/4320: what is cheap is exact, and the highest of many bands, which no layer has much of, is
  // off by a percent.)
  const int needed = std::min(4 * bands, std::max(5 * bands / 4, 160));
  const int slices = std::max(1, (needed + height - 1) / height);
  const int rows = height * slices;
  std::vector<vtkIBLLegendre::Latitude> latitudes((rows + 1) / 2);
  for (std::size_t i = 0; i < latitudes.size(); ++i)
  {
    for (int node = 0; node < (2 * int(i) + 1 == rows ? 1 : 2); ++node) // a middle row is its own mirror
    {
      const double colatitude = (i + 0.5 + (node ? 0.5 : -0.5) / std::sqrt(3.0)) * Pi / rows;
      latitudes[i].Cosine[node] = std::cos(colatitude);
      latitudes[i].Weight[node] = std::sin(colatitude) * 0.5 * Pi / rows * 2.0 * Pi; // and dphi's 2 pi
    }
  }
  const vtkIBLLegendre legendre(this->Order, latitudes);

  // Rows to Fourier, a northern and a southern one as a complex one.
  Columns columns(this->Order, legendre.GetNumberOfGroups());
  const std::vector<std::complex<float>> factors = MakeBoxFactors(width, this->Order);
  const kissfft<Color> plan(width, false);
  parallelFor(legendre.GetNumberOfGroups(),
    [&](int group)
    {
      const kissfft<Color> fft = plan; // it has a buffer of its own
      std::vector<Color> north(width), south(width);
      std::vector<Complex> in(width);
      std::vector<std::vector<Complex>> transformed;
      const int begin = group * Group;
      const int end = std::min(begin + Group, int(latitudes.size()));
      for (int i = begin; i < end; ++i)
      {
        if (i == begin || i % slices == 0)
        {
          ReadRow(image, height - 1 - i / slices, bright, north.data());
          ReadRow(image, i / slices, bright, south.data());
          for (int column = 0; column < width; ++column)
          {
            in[column] = { north[column], south[column] };
          }
          transformed.push_back(in);
          if (width > 1) // KissFFT knows no transform of one number, which it is itself
          {
            fft.transform(in.data(), transformed.back().data());
          }
        }
      }
      for (int m = 0; m < bands; ++m)
      {
        const int k = m % width;
        const int mirrored = (width - k) % width;
        const Color real(0.5f * factors[m].real());
        const Color imaginary(0.5f * factors[m].imag());
        for (int i = begin; i < end; ++i)
        {
          const std::vector<Complex>& z = transformed[i / slices - begin / slices];
          const Color northReal = z[k].real() + z[mirrored].real();
          const Color northImaginary = z[k].imag() - z[mirrored].imag();
          const Color southReal = z[k].imag() + z[mirrored].imag();
          const Color southImaginary = z[mirrored].real() - z[k].real();
          const Color values[4] = { real * (northReal + southReal) - imaginary * (northImaginary + southImaginary),
            real * (northImaginary + southImaginary) + imaginary * (northReal + southReal),
            real * (northReal - southReal) - imaginary * (northImaginary - southImaginary),
            real * (northImaginary - southImaginary) + imaginary * (northReal - southReal) };
          for (int c = 0; c < 12; ++c)
          {
            columns.At(m, c, i) = values[c / 3].V[c % 3];
          }
        }
      }
    });

  // Latitudes to Legendre.
  this->Coefficients.resize(vtkIBLLegendre::Offset(this->Order, bands, bands));
  parallelFor(bands,
    [&](int m)
    { legendre.Analyse(m, columns.Get(m), &this->Coefficients[vtkIBLLegendre::Offset(this->Order, m, m)]); });
}

vtkIBLSpectrum::vtkIBLSpectrum(int order, std::vector<float> coefficients, std::vector<vtkIBLBrightTexel> brightTexels)
  : Order(order)
  , Coefficients(std::move(coefficients))
  , BrightTexels(std::move(brightTexels))
{
}

std::pair<glm::dvec3, glm::dvec3> vtkIBLSpectrum::GetCoefficient(int l, int m) const
{
  const float* c = &this->Coefficients[vtkIBLLegendre::Offset(this->Order, m, l)];
  return { glm::dvec3(c[0], c[1], c[2]), glm::dvec3(c[3], c[4], c[5]) };
}

//------------------------------------------------------------------------------
int vtkIBLSpectrum::RequiredOrder(double perceptualRoughness, double tolerance)
{
  // What is left of the kernel above band l is near exp(-2 alpha l).
  const double alpha = perceptualRoughness * perceptualRoughness;
  return std::clamp(static_cast<int>(std::ceil(-0.5 * std::log(tolerance) / alpha)), 48, MaximumOrder);
}

namespace
{
// sums[l] = sum over points of weight P_l(t).
VTKIBL_WIDE void SumLegendre(int order, int count, const double* t, const double* weight, double* sums)
{
  std::vector<double> p0(count, 1.0);
  std::vector<double> p1(t, t + count);
  for (int l = 0; l <= order; ++l)
  {
    const double a = (2.0 * l + 3.0) / (l + 2.0);
    const double b = (l + 1.0) / (l + 2.0);
    double sum[8] = {};
    for (int i = 0; i < count; i += 8)
    {
      for (int j = 0; j < 8; ++j)
      {
        const double p = p0[i + j];
        sum[j] += weight[i + j] * p;
        p0[i + j] = p1[i + j];
        p1[i + j] = a * t[i + j] * p1[i + j] - b * p;
      }
    }
    sums[l] = ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
  }
}
}

std::vector<double> vtkIBLSpectrum::KernelBands(double perceptualRoughness, int order)
{
  // K(t) = t / (1 - k t)^2 for t = N.L in [0, 1], k = (1 - alpha^2)/(1 + alpha^2): the GGX half-vector density times
  // NoL. Its peak at t = 1 has the width 1 - k, so panels are even in log(1 - k t); each has 8 Gauss-Legendre points.
  static const double nodes[4] = { 0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363 };
  static const double weights[4] = { 0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763 };
  const double alpha2 = std::pow(perceptualRoughness, 4.0);
  const double k = (1.0 - alpha2) / (1.0 + alpha2);
  const bool flat = k < 0.01;
  constexpr int panels = 32;
  std::array<double, 8 * panels> ts;
  std::array<double, 8 * panels> ws;
  for (int i = 0; i < 8 * panels; ++i)
  {
    const int point = i % 8;
    const double node = point < 4 ? -nodes[3 - point] : nodes[point - 4];
    const double x = (i / 8 + 0.5 + 0.5 * node) / panels;
    const double w = std::pow(1.0 - k, x); // 1 - k t, from 1 down to 1 - k
    const double t = flat ? x : (1.0 - w) / k;
    const double jacobian = flat ? 1.0 : -w * std::log1p(-k) / k;
    ts[i] = t;
    ws[i] = weights[point < 4 ? 3 - point : point - 4] * jacobian * t / ((1.0 - k * t) * (1.0 - k * t));
  }
  // What is left above is exp(-16), and for broad kernels l^-5/2.
  std::vector<double> bands(order + 1, 0.0);
  const int significant = std::max(64, int(std::ceil(8.0 / (perceptualRoughness * perceptualRoughness))));
  SumLegendre(std::min(order, significant), int(ts.size()), ts.data(), ws.data(), bands.data());
  for (int l = order; l >= 0; --l)
  {
    bands[l] /= bands[0];
  }
  return bands;
}
