// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The other half of vtkIBLSpectrum: from harmonics and bright texels to the texels of a cube map.
#include "vtkIBLSpectrum.h"

#include "vtkIBLColorTransform.h"
#include "vtkIBLLamps.h"
#include "vtkIBLLegendre.h"
#include "vtkIBLShaderFunctions.h"
#include "vtkIBLSimd.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr int Group = vtkIBLLegendre::Group;
using Color = vtkIBLColor;
using Complex = vtkIBLComplexColor;

// Smallest size with few prime factors.
int RoundUpSize(int n)
{
  int best = 1;
  while (best < n)
  {
    best *= 2;
  }
  return best >= 8 && best / 4 * 3 >= n ? best / 4 * 3 : best;
}

// Radiance on a lat-long grid, row j at colatitude (j + 1/2) pi/Rows from the north, column i at longitude i 2
// pi/Columns, with a margin of two on all sides.
struct Grid
{
  explicit Grid(int rows)
    : Rows(rows)
    , Columns(2 * rows)
    , Stride(this->Columns + 4)
    , Colors(new Color::Vector[std::size_t(rows + 4) * this->Stride])
  {
  }
  Color::Vector* Row(int j) { return &this->Colors[std::size_t(j + 2) * this->Stride + 2]; }
  void FillMargins()
  {
    // Across a pole it goes on at the opposite longitude.
    for (int j : { -2, -1, this->Rows, this->Rows + 1 })
    {
      const Color::Vector* from = this->Row(j < 0 ? -1 - j : 2 * this->Rows - 1 - j);
      std::copy_n(from + this->Columns / 2, this->Columns / 2, this->Row(j));
      std::copy_n(from, this->Columns / 2, this->Row(j) + this->Columns / 2);
      this->Wrap(this->Row(j));
    }
  }
  void Wrap(Color::Vector* row)
  {
    for (int i = 0; i < 2; ++i)
    {
      row[-1 - i] = row[this->Columns - 1 - i];
      row[this->Columns + i] = row[i];
    }
  }
  int Rows, Columns, Stride;
  std::unique_ptr<Color::Vector[]> Colors; // not cleared
};

Grid Synthesise(int order, const float* coefficients, int coefficientOrder, const std::vector<double>& factors,
  const vtkIBLParallelFor& parallelFor)
{
  Grid grid(RoundUpSize(order * 9 / 8 + 24));
  std::vector<vtkIBLLegendre::Latitude> latitudes(grid.Rows / 2);
  for (std::size_t i = 0; i < latitudes.size(); ++i)
  {
    latitudes[i].Cosine[0] = std::cos((i + 0.5) * Pi / grid.Rows);
    latitudes[i].Weight[0] = 1.0;
  }
  const vtkIBLLegendre legendre(order, latitudes);
  std::vector<float> filtered(vtkIBLLegendre::Offset(order, order + 1, order + 1));
  parallelFor(order + 1,
    [&](int m)
    {
      const float* in = coefficients + vtkIBLLegendre::Offset(coefficientOrder, m, m);
      float* out = &filtered[vtkIBLLegendre::Offset(order, m, m)];
      for (int i = 0; i < 6 * (order + 1 - m); ++i)
      {
        out[i] = float((m == 0 ? 1.0 : 0.5) * factors[m + i / 6]) * in[i];
      }
    });
  const kissfft<Color> plan(grid.Columns, true);
  parallelFor(legendre.GetNumberOfGroups(),
    [&](int group)
    {
      const int begin = group * Group;
      const int count = std::min(Group, int(latitudes.size()) - begin);
      std::vector<Complex> in(std::size_t(count) * grid.Columns);
      for (int m = 0; m <= order; ++m)
      {
        float v[12][Group];
        if (!legendre.Synthesise(m, group, &filtered[vtkIBLLegendre::Offset(order, m, m)], v[0]))
        {
          continue;
        }
        for (int i = 0; i < count; ++i)
        {
          // North plus i times south; a row is real, so at -m it is the conjugate.
          Complex* row = &in[std::size_t(i) * grid.Columns];
          row[m == 0 ? 0 : grid.Columns - m] = { Color(v[0][i] + v[9][i], v[1][i] + v[10][i], v[2][i] + v[11][i]),
            Color(v[6][i] - v[3][i], v[7][i] - v[4][i], v[8][i] - v[5][i]) };
          row[m] = { Color(v[0][i] - v[9][i], v[1][i] - v[10][i], v[2][i] - v[11][i]),
            Color(v[6][i] + v[3][i], v[7][i] + v[4][i], v[8][i] + v[5][i]) };
        }
      }
      const kissfft<Color> fft = plan;
      std::vector<Complex> out(grid.Columns);
      for (int i = 0; i < count; ++i)
      {
        fft.transform(&in[std::size_t(i) * grid.Columns], out.data());
        Color::Vector* north = grid.Row(begin + i);
        Color::Vector* south = grid.Row(grid.Rows - 1 - begin - i);
        for (int column = 0; column < grid.Columns; ++column)
        {
          north[column] = out[column].real().V;
          south[column] = out[column].imag().V;
        }
        grid.Wrap(north);
        grid.Wrap(south);
      }
    });
  grid.FillMargins();
  return grid;
}

// Where the texels of a quarter of a face lie on the grid, for |s| and |t| of half a face and its border.
struct Quarter
{
  Quarter(const Grid& grid, int faceSize, const vtkIBLParallelFor& parallelFor)
    : Size(faceSize / 2 + 1)
    , Longitude(this->Size)
    , Latitude(std::size_t(this->Size) * this->Size)
    , PolarLongitude(this->Latitude.size())
    , Colatitude(this->Latitude.size())
  {
    parallelFor(this->Size,
      [&](int j)
      {
        const double t = (2 * j + 1) / double(faceSize);
        const double rows = grid.Rows / Pi; // a radian
        this->Longitude[j] = float(std::atan(t) * rows);
        for (int i = 0; i < this->Size; ++i)
        {
          const double s = (2 * i + 1) / double(faceSize);
          this->Latitude[j * this->Size + i] = float(std::atan(t / std::sqrt(1.0 + s * s)) * rows);
          this->PolarLongitude[j * this->Size + i] = float(std::atan2(t, s) * rows);
          this->Colatitude[j * this->Size + i] = float(std::atan(std::sqrt(s * s + t * t)) * rows);
        }
      });
  }
  int Size;
  std::vector<float> Longitude, Latitude;        // of the four side faces: longitude depends on s alone
  std::vector<float> PolarLongitude, Colatitude; // of the polar faces
};

// Grid coordinates of a row of texels of a face, with a border.
void LocateRow(const Grid& grid, const Quarter& quarter, int face, int faceSize, int border, int j, float* x, float* y)
{
  const auto half = [&](int index, float& sign)
  {
    const int a = 2 * index + 1 - faceSize;
    sign = a < 0 ? -1.0f : 1.0f;
    return (std::abs(a) - 1) / 2;
  };
  float signT;
  const int row = half(j, signT) * quarter.Size;
  const float quadrant = 0.25f * grid.Columns;
  for (int i = -border; i < faceSize + border; ++i, ++x, ++y)
  {
    float signS;
    const int column = half(i, signS);
    if (face == 2 || face == 3)
    {
      float longitude = quarter.PolarLongitude[row + column];
      longitude = signS < 0.0f ? 2.0f * quadrant - longitude : longitude;
      longitude *= face == 2 ? signT : -signT;
      *x = longitude < 0.0f ? longitude + grid.Columns : longitude;
      const float colatitude = quarter.Colatitude[row + column] - 0.5f;
      *y = face == 2 ? colatitude : grid.Rows - 1 - colatitude;
    }
    else
    {
      const float middle = face == 0 ? 0.0f : face == 1 ? 2.0f * quadrant : face == 4 ? quadrant : 3.0f * quadrant;
      const float longitude = middle - signS * quarter.Longitude[column];
      *x = longitude < 0.0f ? longitude + grid.Columns : longitude;
      *y = 0.5f * grid.Rows - 0.5f + signT * quarter.Latitude[row + column];
    }
  }
}

VTKIBL_INLINE void GetLagrangeWeights(float u, float (&w)[4])
{
  w[0] = -u * (u - 1.0f) * (u - 2.0f) * (1.0f / 6.0f);
  w[1] = (u + 1.0f) * (u - 1.0f) * (u - 2.0f) * 0.5f;
  w[2] = -(u + 1.0f) * u * (u - 2.0f) * 0.5f;
  w[3] = (u + 1.0f) * u * (u - 1.0f) * (1.0f / 6.0f);
}

// Cubic interpolation at (x, y) of a grid whose (0, 0) is `colors`.
VTKIBL_WIDE void ResampleRow(
  const Color::Vector* colors, int stride, int count, const float* x, const float* y, float* const (&color)[3])
{
  for (int i = 0; i < count; ++i)
  {
    const float columnBelow = std::floor(x[i]);
    const float rowBelow = std::floor(y[i]);
    float wx[4];
    float wy[4];
    GetLagrangeWeights(x[i] - columnBelow, wx);
    GetLagrangeWeights(y[i] - rowBelow, wy);
    const Color::Vector* from = colors + std::ptrdiff_t(rowBelow - 1.0f) * stride + std::ptrdiff_t(columnBelow) - 1;
    Color::Vector sum = {};
    for (int j = 0; j < 4; ++j, from += stride)
    {
      sum += wy[j] * (wx[0] * from[0] + wx[1] * from[1] + wx[2] * from[2] + wx[3] * from[3]);
    }
    sum = sum > 0.0f ? sum : Color::Vector{}; // what is left of the ringing
    color[0][i] = sum[0];
    color[1][i] = sum[1];
    color[2][i] = sum[2];
  }
}

// Unit directions of a row of texels: face and t fixed.
VTKIBL_WIDE void GetDirections(int face, float t, int faceSize, int border, int count, float* const (&normal)[3])
{
  vtkIBLCore::ShaderFunctions<float> shader;
  const glm::vec3 middle = shader.iblCubeDirection(face, 0.0f, t);
  const glm::vec3 step = shader.iblCubeDirection(face, 1.0f, t) - middle;
  const float square = glm::dot(middle, middle);
  for (int i = 0; i < count; ++i)
  {
    const float s = (2 * (i - border) + 1) / float(faceSize) - 1.0f;
    const float scale = 1.0f / std::sqrt(square + s * s);
    normal[0][i] = (middle.x + s * step.x) * scale;
    normal[1][i] = (middle.y + s * step.y) * scale;
    normal[2][i] = (middle.z + s * step.z) * scale;
  }
}
}

void vtkIBLSpectrum::Filter(const std::vector<vtkIBLLobe>& lobes, int faceSize, int border, float* rgb,
  const vtkIBLParallelFor& parallelFor) const
{
  // The heaviest lobe sets the order.
  const auto heaviest = std::max_element(lobes.begin(), lobes.end(),
    [](const vtkIBLLobe& a, const vtkIBLLobe& b) { return std::abs(a.Weight) < std::abs(b.Weight); });
  const int order = std::min(this->Order, RequiredOrder(heaviest->PerceptualRoughness));
  std::vector<double> factors(order + 1, 0.0);
  for (const vtkIBLLobe& lobe : lobes)
  {
    const std::vector<double> bands = KernelBands(lobe.PerceptualRoughness, order);
    std::transform(factors.begin(), factors.end(), bands.begin(), factors.begin(),
      [&](double sum, double band) { return sum + lobe.Weight * band; });
  }
  Grid grid = Synthesise(order, this->Coefficients.data(), this->Order, factors, parallelFor);
  const Quarter quarter(grid, faceSize, parallelFor);
  const vtkIBLLamps lamps(this->BrightTexels, lobes);

  const int size = faceSize + 2 * border;
  const int padded = vtkIBLLamps::Pad(size);
  parallelFor(6 * size,
    [&](int index)
    {
      const int face = index / size;
      const int j = index % size - border;
      std::vector<float> buffer(std::size_t(8) * padded);
      float* x = buffer.data();
      float* y = x + padded;
      float* const normal[3] = { y + padded, y + 2 * padded, y + 3 * padded };
      float* const color[3] = { y + 4 * padded, y + 5 * padded, y + 6 * padded };
      LocateRow(grid, quarter, face, faceSize, border, j, x, y);
      ResampleRow(grid.Row(0), grid.Stride, size, x, y, color);
      if (!lamps.IsEmpty())
      {
        GetDirections(face, (2 * j + 1) / float(faceSize) - 1.0f, faceSize, border, size, normal);
        lamps.AddTo(size, normal, color);
      }
      float* out = rgb + std::size_t(3) * size * index;
      for (int i = 0; i < size; ++i, out += 3)
      {
        out[0] = color[0][i];
        out[1] = color[1][i];
        out[2] = color[2][i];
      }
    });
}

void vtkIBLSpectrum::Measure(
  const std::vector<double>& factors, double& mean, double& rms, const vtkIBLParallelFor& parallelFor) const
{
  const int order = std::min(int(factors.size()) - 1, this->Order);
  Grid grid = Synthesise(order, this->Coefficients.data(), this->Order, factors, parallelFor);
  std::vector<double> sums(grid.Rows), squares(grid.Rows);
  parallelFor(grid.Rows,
    [&](int j)
    {
      Color::Vector sum = {};
      Color::Vector square = {};
      for (int i = 0; i < grid.Columns; ++i)
      {
        const Color::Vector value = grid.Row(j)[i];
        sum += value > 0.0f ? value : -value;
        square += value * value;
      }
      sums[j] = double(sum[0]) + sum[1] + sum[2];
      squares[j] = double(square[0]) + square[1] + square[2];
    });
  mean = 0.0;
  rms = 0.0;
  double area = 0.0;
  for (int j = 0; j < grid.Rows; ++j)
  {
    const double weight = std::sin((j + 0.5) * Pi / grid.Rows);
    mean += weight * sums[j];
    rms += weight * squares[j];
    area += 3.0 * weight * grid.Columns;
  }
  mean /= area;
  rms = std::sqrt(rms / area);
}
