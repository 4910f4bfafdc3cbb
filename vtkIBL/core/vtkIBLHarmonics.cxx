// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLHarmonics.h"

#include "vtkIBLShaderFunctions.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <functional>

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr int Bands = vtkIBLHarmonics::MaximumOrder + 1;

// Index of (l, m), m in [-l, l].
constexpr int Index(int l, int m)
{
  return l * (l + 1) + m;
}

// P_lm = A (z P_{l-1,m} - B P_{l-2,m}), without its factor sin^m, for functions orthonormal on the sphere.
struct Recurrences
{
  Recurrences()
  {
    double sectoral = std::sqrt(0.25 / Pi);
    for (int m = 0; m < Bands; ++m)
    {
      this->Sectoral[m] = sectoral;
      sectoral *= std::sqrt((2.0 * m + 3.0) / (2.0 * m + 2.0)) * (m == 0 ? std::sqrt(2.0) : 1.0);
      for (int l = m + 1; l < Bands; ++l)
      {
        const double k = l - 1;
        this->A[l][m] = std::sqrt((4.0 * l * l - 1.0) / (l * l - m * m));
        this->B[l][m] = std::sqrt((k * k - m * m) / (4.0 * k * k - 1.0));
      }
    }
  }
  double Sectoral[Bands];
  double A[Bands][Bands];
  double B[Bands][Bands];
};
}

std::array<double, vtkIBLHarmonics::MaximumCount> vtkIBLHarmonicBasis(int order, const glm::dvec3& direction)
{
  static const Recurrences recurrences;
  std::array<double, vtkIBLHarmonics::MaximumCount> basis;
  std::complex<double> turn = 1.0; // sin^m (cos(m phi) + i sin(m phi))
  for (int m = 0; m <= order; ++m)
  {
    double p2 = 0.0;
    double p1 = recurrences.Sectoral[m];
    for (int l = m; l <= order; ++l)
    {
      if (l > m)
      {
        const double p = recurrences.A[l][m] * (direction.z * p1 - recurrences.B[l][m] * p2);
        p2 = p1;
        p1 = p;
      }
      basis[Index(l, -m)] = p1 * turn.imag();
      basis[Index(l, m)] = p1 * turn.real(); // last, for m = 0
    }
    turn *= std::complex<double>(direction.x, direction.y);
  }
  return basis;
}

//------------------------------------------------------------------------------
vtkIBLHarmonics vtkIBLMakeHarmonics(const vtkIBLSpectrum& spectrum, int order)
{
  vtkIBLHarmonics harmonics(order);
  for (int l = 0; l <= order; ++l)
  {
    for (int m = 0; m <= l; ++m)
    {
      // Of exp(-i m phi): the sine's share comes with a minus.
      const auto [re, im] = spectrum.GetCoefficient(l, m);
      harmonics.RGB[Index(l, -m)] = -im;
      harmonics.RGB[Index(l, m)] = re; // last, for m = 0
    }
  }
  // The spectrum's polar axis is y and its longitude that of (x, z): these are harmonics of (x, z, y).
  return vtkIBLTurnHarmonics(harmonics, { { 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 } });
}

void vtkIBLAddBrightTexels(const std::vector<vtkIBLBrightTexel>& texels, vtkIBLHarmonics& harmonics)
{
  for (const vtkIBLBrightTexel& texel : texels)
  {
    const auto basis = vtkIBLHarmonicBasis(harmonics.Order, texel.Direction);
    for (std::size_t i = 0; i < harmonics.RGB.size(); ++i)
    {
      harmonics.RGB[i] += basis[i] * texel.SolidAngle * texel.Radiance;
    }
  }
}

vtkIBLHarmonics vtkIBLMakeHarmonics(const vtkIBLRadianceImage& faces, int order, const vtkIBLParallelFor& parallelFor)
{
  const int n = faces.Width;
  const int cut = (127 + n) / n;
  const double cell = 2.0 / (n * cut);
  // Row by row, and these in order: the same bits whatever the threads.
  std::vector<vtkIBLHarmonics> rows(std::size_t(6) * n, vtkIBLHarmonics(order));
  parallelFor(6 * n,
    [&](int row)
    {
      vtkIBLCore::ShaderFunctions<double> shader;
      const float* texel = faces.RGB + std::size_t(3) * n * row;
      for (int j = 0; j < cut; ++j)
      {
        for (int i = 0; i < n * cut; ++i)
        {
          const double s = i * cell - 1.0;
          const double t = (row % n * cut + j) * cell - 1.0;
          const auto direction = glm::normalize(shader.iblCubeDirection(row / n, s + 0.5 * cell, t + 0.5 * cell));
          const auto basis = vtkIBLHarmonicBasis(order, direction);
          const float* rgb = texel + 3 * (i / cut);
          const glm::dvec3 light =
            shader.iblCubeSolidAngle(s, t, s + cell, t + cell) * glm::dvec3(rgb[0], rgb[1], rgb[2]);
          for (std::size_t k = 0; k < rows[row].RGB.size(); ++k)
          {
            rows[row].RGB[k] += basis[k] * light;
          }
        }
      }
    });
  vtkIBLHarmonics sum(order);
  for (const vtkIBLHarmonics& row : rows)
  {
    std::transform(sum.RGB.begin(), sum.RGB.end(), row.RGB.begin(), sum.RGB.begin(), std::plus<>());
  }
  return sum;
}

//------------------------------------------------------------------------------
namespace
{
// One band's matrix: Y_m(matrix d) = sum over n of D_mn Y_n(d).
struct Band
{
  explicit Band(int l)
    : L(l)
    , Elements((2 * l + 1) * (2 * l + 1))
  {
  }
  double& operator()(int m, int n) { return this->Elements[(m + this->L) * (2 * this->L + 1) + n + this->L]; }
  int L;
  std::vector<double> Elements;
};

// Ivanic & Ruedenberg 1996, "Rotation matrices for real spherical harmonics", J. Phys. Chem. 100, eqs. 6.3 to 8.1, as
// corrected in 102 (1998): band l out of bands 1 and l - 1. Band l is the highest that the product of the two holds, so
// this is true of reflections too.
Band MakeBand(Band& one, Band& last)
{
  const int l = last.L + 1;
  const auto p = [&](int i, int m, int n)
  {
    return n == l ? one(i, 1) * last(m, l - 1) - one(i, -1) * last(m, 1 - l)
      : n == -l   ? one(i, 1) * last(m, 1 - l) + one(i, -1) * last(m, l - 1)
                  : one(i, 0) * last(m, n);
  };
  Band band(l);
  for (int m = -l; m <= l; ++m)
  {
    const int a = std::abs(m);
    const int sign = m < 0 ? -1 : 1;
    for (int n = -l; n <= l; ++n)
    {
      const double scale = 1.0 / (std::abs(n) < l ? (l + n) * (l - n) : 2 * l * (2 * l - 1));
      double sum = 0.0;
      if (a < l)
      {
        sum += std::sqrt((l + m) * (l - m) * scale) * p(0, m, n);
      }
      if (m == 0)
      {
        sum -= std::sqrt(0.5 * (l - 1) * l * scale) * (p(1, 1, n) + p(-1, -1, n));
      }
      else
      {
        // |m| = 1: one of the two terms is not there, and the other counts sqrt 2.
        const double near = m == -1 ? 0.0 : p(1, m - sign, n);
        const double far = m == 1 ? 0.0 : p(-1, sign - m, n);
        const double v = near - sign * far;
        sum += 0.5 * std::sqrt((l + a - 1) * (l + a) * (a == 1 ? 2.0 : 1.0) * scale) * v;
      }
      if (a > 0 && a < l - 1)
      {
        sum -= 0.5 * std::sqrt((l - a - 1) * (l - a) * scale) * (p(1, m + sign, n) + sign * p(-1, -m - sign, n));
      }
      band(m, n) = sum;
    }
  }
  return band;
}
}

vtkIBLHarmonics vtkIBLTurnHarmonics(const vtkIBLHarmonics& light, const glm::dmat3& matrix)
{
  vtkIBLHarmonics turned(light.Order);
  turned.RGB[0] = light.RGB[0];
  Band one(1);
  for (int m = -1; m <= 1; ++m)
  {
    for (int n = -1; n <= 1; ++n)
    {
      one(m, n) = matrix[(n + 2) % 3][(m + 2) % 3]; // column and row: y, z, x
    }
  }
  Band band = one;
  for (int l = 1; l <= light.Order; ++l)
  {
    for (int n = -l; n <= l; ++n)
    {
      for (int m = -l; m <= l; ++m)
      {
        turned.RGB[Index(l, n)] += band(m, n) * light.RGB[Index(l, m)];
      }
    }
    band = MakeBand(one, band);
  }
  return turned;
}

//------------------------------------------------------------------------------
double vtkIBLCosineBand(int l)
{
  if (l % 2 == 1)
  {
    return l == 1 ? 2.0 * Pi / 3.0 : 0.0;
  }
  // 2 pi (-1)^(l/2 - 1) / ((l + 2)(l - 1)) l! / (2^l (l/2)!^2)
  double binomial = 1.0;
  for (int k = 1; k <= l / 2; ++k)
  {
    binomial *= -(2.0 * k - 1.0) / (2.0 * k);
  }
  return -2.0 * Pi * binomial / ((l + 2.0) * (l - 1.0));
}

glm::dvec3 vtkIBLEvaluateIrradiance(
  const vtkIBLHarmonics& harmonics, const std::vector<vtkIBLBrightTexel>& texels, const glm::dvec3& normal)
{
  const auto basis = vtkIBLHarmonicBasis(harmonics.Order, normal);
  glm::dvec3 irradiance(0.0);
  for (int l = 0; l <= harmonics.Order; ++l)
  {
    for (int m = -l; m <= l; ++m)
    {
      irradiance += vtkIBLCosineBand(l) * basis[Index(l, m)] * harmonics.RGB[Index(l, m)];
    }
  }
  irradiance = glm::max(irradiance, 0.0);
  for (const vtkIBLBrightTexel& texel : texels)
  {
    irradiance += std::max(glm::dot(normal, texel.Direction), 0.0) * texel.SolidAngle * texel.Radiance;
  }
  return irradiance;
}

std::array<glm::dvec4, 7> vtkIBLPackIrradiance(const vtkIBLHarmonics& harmonics)
{
  // Sloan 2008, "Stupid Spherical Harmonics Tricks", appendix A10, without the sign: A_l / pi times Y's constant.
  const double k0 = std::sqrt(0.25 / Pi);
  const double k1 = std::sqrt(0.75 / Pi) * (2.0 / 3.0);
  const double k2 = std::sqrt(15.0 / Pi) * 0.5 * 0.25;  // xy, yz, xz
  const double k20 = std::sqrt(5.0 / Pi) * 0.25 * 0.25; // 3 z^2 - 1
  const double k22 = 0.5 * k2;                          // x^2 - y^2
  std::array<glm::dvec3, 9> c = {};
  std::copy_n(harmonics.RGB.begin(), std::min<std::size_t>(harmonics.RGB.size(), 9), c.begin());
  std::array<glm::dvec4, 7> packed;
  for (int i = 0; i < 3; ++i)
  {
    packed[i] = { k1 * c[3][i], k1 * c[1][i], k1 * c[2][i], k0 * c[0][i] - k20 * c[6][i] };
    packed[3 + i] = { k2 * c[4][i], k2 * c[5][i], 3.0 * k20 * c[6][i], k2 * c[7][i] };
  }
  packed[6] = glm::dvec4(k22 * c[8], 0.0);
  return packed;
}
