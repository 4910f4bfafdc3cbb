// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLSpectrum.h"

#include "vtkIBLShaderFunctions.h"

#include <kissfft/kissfft.hh>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

// The two inner loops, compiled for the widest vectors that the machine has.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__linux__)
#define VTKIBL_WIDE __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define VTKIBL_WIDE
#endif

namespace
{
constexpr int Lanes = 16;
constexpr double Pi = 3.14159265358979323846;
using Lane = std::array<float, Lanes>;

// Where (m, l) begins in a triangle of six floats each.
std::size_t Offset(int order, int m, int l)
{
  return 6 * (static_cast<std::size_t>(m) * (2 * order + 3 - m) / 2 + (l - m));
}

// P_lm = A (cos P_{l-1,m} - B P_{l-2,m}), for functions orthonormal on the sphere.
struct Recurrence
{
  float A, B;
};

std::vector<Recurrence> MakeRecurrences(int order)
{
  std::vector<Recurrence> table;
  for (int m = 0; m <= order; ++m)
  {
    for (int l = m; l <= order; ++l)
    {
      const double ll = double(l) * l;
      const double mm = double(m) * m;
      const double a = l > m ? std::sqrt((4 * ll - 1) / (ll - mm)) : 0.0;
      const double b = l > m + 1 ? std::sqrt((double(l - 1) * (l - 1) - mm) / (4.0 * (l - 1) * (l - 1) - 1)) : 0.0;
      table.push_back({ float(a), float(b) });
    }
  }
  return table;
}

// sqrt((2m+1)!! / (4 pi (2m)!!)) sin^m, kept in double, times sqrt 2 where m > 0 for the cosine and sine pair.
struct Sectoral
{
  explicit Sectoral(double sine)
    : Sine(sine)
    , Value(std::sqrt(1.0 / (4.0 * Pi)))
  {
  }
  void Next()
  {
    ++this->M;
    this->Value *=
      std::sqrt((2.0 * this->M + 1.0) / (2.0 * this->M)) * this->Sine * (this->M == 1 ? std::sqrt(2.0) : 1.0);
  }
  float Get() const { return this->Value < 1e-35 ? 0.0f : float(this->Value); }
  double Sine, Value;
  int M = 0;
};

// From P_{l-1,m} and P_{l-2,m} to P_lm and P_{l-1,m}. Inlined, so that it is compiled for the caller's vectors.
#if defined(__GNUC__)
__attribute__((always_inline))
#endif
inline void
NextBand(const Recurrence& next, const Lane& cosine, Lane& p1, Lane& p2)
{
  for (int i = 0; i < Lanes; ++i)
  {
    const float p = next.A * (cosine[i] * p1[i] - next.B * p2[i]);
    p2[i] = p1[i];
    p1[i] = p;
  }
}

// sums[l - m][c] += P_lm * value, c = 0..5 for l - m even, out of the pair's sum, and odd, out of its difference.
VTKIBL_WIDE void AddToBands(int bands, const Recurrence* recurrence, const Lane& cosine, const Lane& sectoral,
  const Lane (&sum)[6], const Lane (&difference)[6], Lane* sums)
{
  Lane p2 = {};
  Lane p1 = sectoral;
  for (int k = 0; k < bands; ++k)
  {
    const Lane* values = k % 2 == 0 ? sum : difference;
    for (int c = 0; c < 6; ++c)
    {
      for (int i = 0; i < Lanes; ++i)
      {
        sums[6 * k + c][i] += p1[i] * values[c][i];
      }
    }
    if (k + 1 < bands)
    {
      NextBand(recurrence[k + 1], cosine, p1, p2);
    }
  }
}

// even[c] and odd[c]: sums over l of P_lm times coefficient, by the parity of l - m.
VTKIBL_WIDE void SumBands(int bands, const Recurrence* recurrence, const Lane& cosine, const Lane& sectoral,
  const float* coefficients, Lane (&even)[6], Lane (&odd)[6])
{
  Lane p2 = {};
  Lane p1 = sectoral;
  for (int k = 0; k < bands; ++k)
  {
    Lane* sums = k % 2 == 0 ? even : odd;
    for (int c = 0; c < 6; ++c)
    {
      const float factor = coefficients[6 * k + c];
      for (int i = 0; i < Lanes; ++i)
      {
        sums[c][i] += factor * p1[i];
      }
    }
    if (k + 1 < bands)
    {
      NextBand(recurrence[k + 1], cosine, p1, p2);
    }
  }
}

// rgb[c][i] += re cos(m phi_i) - im sin(m phi_i), turning (cos, sin) on to m + 1.
VTKIBL_WIDE void AddFourier(
  const float (&value)[6], const Lane& stepCosine, const Lane& stepSine, Lane& cosine, Lane& sine, Lane (&rgb)[3])
{
  for (int i = 0; i < Lanes; ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      rgb[c][i] += value[c] * cosine[i] - value[3 + c] * sine[i];
    }
    const float turned = cosine[i] * stepCosine[i] - sine[i] * stepSine[i];
    sine[i] = cosine[i] * stepSine[i] + sine[i] * stepCosine[i];
    cosine[i] = turned;
  }
}

double Luminance(const float* rgb)
{
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

// Where a texel is brighter than this many means, what is above goes to the list: such texels make nearly all of the
// ringing.
constexpr double BrightFactor = 100.0;
constexpr std::size_t MostBrightTexels = 256;

struct Bright
{
  double Luminance;
  std::size_t Texel;
};

std::vector<Bright> FindBrightTexels(const vtkIBLRadianceImage& image, double threshold)
{
  std::vector<Bright> bright;
  for (std::size_t texel = 0; texel < image.GetNumberOfTexels(); ++texel)
  {
    if (const double luminance = Luminance(image.RGB + 3 * texel); luminance > threshold)
    {
      bright.push_back({ luminance, texel });
    }
  }
  if (bright.size() > MostBrightTexels)
  {
    std::nth_element(bright.begin(), bright.begin() + MostBrightTexels, bright.end(),
      [](const Bright& a, const Bright& b)
      { return a.Luminance != b.Luminance ? a.Luminance > b.Luminance : a.Texel < b.Texel; });
    bright.resize(MostBrightTexels);
  }
  std::sort(bright.begin(), bright.end(), [](const Bright& a, const Bright& b) { return a.Texel < b.Texel; });
  return bright;
}

// Fourier coefficients of one row for m = 0 .. order, three channels: mean of value times exp(-i m phi) under box
// reading.
void TransformRow(const float* row, int width, int order, const kissfft<float>& fft, std::complex<float>* out)
{
  using Complex = std::complex<float>;
  std::vector<Complex> in(width), redGreen(width), blue(width);
  for (int i = 0; i < width; ++i)
  {
    in[i] = { row[3 * i], row[3 * i + 1] };
  }
  fft.transform(in.data(), redGreen.data());
  for (int i = 0; i < width; ++i)
  {
    in[i] = { row[3 * i + 2], 0.0f };
  }
  fft.transform(in.data(), blue.data());
  for (int m = 0; m <= order; ++m)
  {
    const int k = m % width;
    const Complex z = redGreen[k];
    const Complex mirrored = std::conj(redGreen[(width - k) % width]);
    // Column i spans [i, i+1] 2 pi/width - pi: its box is a sinc, its middle a phase.
    const double half = Pi * m / width;
    const double box = m == 0 ? 1.0 : std::sin(half) / half;
    const std::complex<double> phase = std::polar(box / width, -(half - Pi * m));
    const Complex factor(phase);
    out[3 * m] = 0.5f * (z + mirrored) * factor;
    out[3 * m + 1] = Complex(0.0f, -0.5f) * (z - mirrored) * factor;
    out[3 * m + 2] = blue[k] * factor;
  }
}
}

std::pair<glm::dvec3, glm::dvec3> vtkIBLSpectrum::GetCoefficient(int l, int m) const
{
  const float* c = &this->Coefficients[Offset(this->Order, m, l)];
  return { glm::dvec3(c[0], c[1], c[2]), glm::dvec3(c[3], c[4], c[5]) };
}

int vtkIBLSpectrum::RequiredOrder(double perceptualRoughness)
{
  const double alpha = perceptualRoughness * perceptualRoughness;
  return std::max(48, static_cast<int>(std::ceil(4.0 / alpha)));
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
  const int panels = 64;
  std::vector<double> bands(order + 1, 0.0);
  for (int panel = 0; panel < panels; ++panel)
  {
    for (int i = -4; i < 4; ++i)
    {
      const double node = i < 0 ? -nodes[-i - 1] : nodes[i];
      const double x = (panel + 0.5 + 0.5 * node) / panels;
      const double w = std::pow(1.0 - k, x); // 1 - k t, from 1 down to 1 - k
      const double t = flat ? x : (1.0 - w) / k;
      const double jacobian = flat ? 1.0 : -w * std::log1p(-k) / k;
      const double weight = weights[i < 0 ? -i - 1 : i] * jacobian * t / ((1.0 - k * t) * (1.0 - k * t));
      double p0 = 1.0;
      double p1 = t;
      for (int l = 0; l <= order; ++l)
      {
        bands[l] += weight * p0;
        const double p2 = ((2 * l + 3) * t * p1 - (l + 1) * p0) / (l + 2);
        p0 = p1;
        p1 = p2;
      }
    }
  }
  for (int l = order; l >= 0; --l)
  {
    bands[l] /= bands[0];
  }
  return bands;
}

//------------------------------------------------------------------------------
vtkIBLSpectrum::vtkIBLSpectrum(const vtkIBLRadianceImage& image, int order, const vtkIBLParallelFor& parallelFor)
  : Order(std::clamp(order, 0, 128))
{
  const int width = image.Width;
  const int height = image.Height;
  const double threshold = BrightFactor * vtkIBLMeanLuminance(image);
  const std::vector<Bright> bright = FindBrightTexels(image, threshold);
  for (const Bright& texel : bright)
  {
    const int row = static_cast<int>(texel.Texel / width);
    const int column = static_cast<int>(texel.Texel % width);
    // Colatitudes a to b from the lower pole: the mean direction (not the middle: by the pole a texel is a triangle)
    // and solid angle.
    const double a = Pi * row / height;
    const double b = Pi * (row + 1) / height;
    const double outwards = 0.5 * (b - a) - 0.25 * (std::sin(2 * b) - std::sin(2 * a)); // of sin^2
    const double down = 0.5 * (std::sin(b) * std::sin(b) - std::sin(a) * std::sin(a));  // of sin cos
    const double phi = 2.0 * Pi * (column + 0.5) / width - Pi;
    const auto direction = glm::normalize(glm::dvec3(outwards * std::cos(phi), -down, outwards * std::sin(phi)));
    const double solidAngle = 2.0 * Pi / width * 2.0 * std::sin(0.5 * (a + b)) * std::sin(0.5 * (b - a));
    const float* rgb = image.RGB + 3 * texel.Texel;
    const double above = 1.0 - threshold / texel.Luminance;
    this->BrightTexels.push_back({ direction, solidAngle, above * glm::dvec3(rgb[0], rgb[1], rgb[2]) });
  }

  // Rows to Fourier, less what the bright texels took.
  const int bands = this->Order + 1;
  std::vector<std::complex<float>> rows(static_cast<std::size_t>(height) * bands * 3);
  const kissfft<float> fft(width, false);
  parallelFor(height,
    [&](int row)
    {
      std::vector<float> values(
        image.RGB + std::size_t(3) * row * width, image.RGB + std::size_t(3) * (row + 1) * width);
      const std::size_t begin = std::size_t(row) * width;
      auto it = std::lower_bound(
        bright.begin(), bright.end(), begin, [](const Bright& b, std::size_t t) { return b.Texel < t; });
      for (; it != bright.end() && it->Texel < begin + width; ++it)
      {
        for (int c = 0; c < 3; ++c)
        {
          values[3 * (it->Texel - begin) + c] *= float(threshold / it->Luminance);
        }
      }
      TransformRow(values.data(), width, this->Order, fft, &rows[std::size_t(row) * bands * 3]);
    });

  // Latitudes to Legendre, for pairs of rows north and south of the equator. Two Gauss points a row, in more slices
  // when rows are few.
  const int slices = std::max(1, (4 * bands + height - 1) / height);
  struct Node
  {
    int North, South;
    double Cosine, Weight; // of colatitude from the top row; weight includes dphi's 2 pi
  };
  std::vector<Node> pairs;
  for (int row = 0; row < (height + 1) / 2; ++row)
  {
    for (int slice = 0; slice < 2 * slices; ++slice)
    {
      const double width1 = Pi / height / slices;
      const double node = (slice / 2 + 0.5 + (slice % 2 ? 0.5 : -0.5) / std::sqrt(3.0)) * width1 + row * Pi / height;
      if (2 * row + 1 == height && node > 0.5 * Pi)
      {
        continue; // the middle row of an odd count is its own mirror
      }
      const int north = height - 1 - row;
      pairs.push_back({ north, row, std::cos(node), std::sin(node) * 0.5 * width1 * 2.0 * Pi });
    }
  }
  const std::vector<Recurrence> recurrences = MakeRecurrences(this->Order);
  this->Coefficients.resize(Offset(this->Order, bands, bands));
  const int blocks = static_cast<int>((pairs.size() + Lanes - 1) / Lanes);

  // sin^m for all nodes, m by m, in double; kept as float a band.
  std::vector<Sectoral> sectorals;
  for (const Node& node : pairs)
  {
    sectorals.emplace_back(std::sqrt(1.0 - node.Cosine * node.Cosine));
  }
  std::vector<float> sectoralOf(std::size_t(bands) * blocks * Lanes, 0.0f);
  for (int m = 0; m < bands; ++m)
  {
    for (std::size_t i = 0; i < pairs.size(); ++i)
    {
      sectoralOf[std::size_t(m) * blocks * Lanes + i] = sectorals[i].Get();
      sectorals[i].Next();
    }
  }
  parallelFor(bands,
    [&](int m)
    {
      std::vector<Lane> sums(6 * (bands - m), Lane{});
      const Recurrence* recurrence = &recurrences[Offset(this->Order, m, m) / 6];
      for (int block = 0; block < blocks; ++block)
      {
        Lane cosine = {};
        Lane sectoral = {};
        Lane sum[6] = {};
        Lane difference[6] = {};
        for (int i = 0; i < Lanes && block * Lanes + i < static_cast<int>(pairs.size()); ++i)
        {
          const Node& node = pairs[block * Lanes + i];
          cosine[i] = float(node.Cosine);
          sectoral[i] = sectoralOf[(std::size_t(m) * blocks + block) * Lanes + i];
          for (int c = 0; c < 3; ++c)
          {
            const std::complex<float> north = rows[(std::size_t(node.North) * bands + m) * 3 + c];
            const std::complex<float> south = rows[(std::size_t(node.South) * bands + m) * 3 + c];
            const auto weight = float(node.Weight);
            sum[c][i] = weight * (north.real() + south.real());
            sum[3 + c][i] = weight * (north.imag() + south.imag());
            difference[c][i] = weight * (north.real() - south.real());
            difference[3 + c][i] = weight * (north.imag() - south.imag());
          }
        }
        AddToBands(bands - m, recurrence, cosine, sectoral, sum, difference, sums.data());
      }
      float* out = &this->Coefficients[Offset(this->Order, m, m)];
      for (const Lane& lane : sums)
      {
        double total = 0.0;
        for (float x : lane)
        {
          total += x;
        }
        *out++ = float(total);
      }
    });
}

//------------------------------------------------------------------------------
namespace
{
// A column of the synthesis: the texels of a cube that share |y| / length, and how they lie around the axis.
struct Column
{
  double Cosine; // |y|
  struct Texel
  {
    int Index; // (face n + j) n + i
    double Phi;
    bool South;
  };
  std::array<Texel, 16> Texels;
  int Count = 0;
};

std::vector<Column> MakeColumns(int n)
{
  vtkIBLCore::ShaderFunctions<double> shader;
  std::vector<Column> columns;
  auto add = [&](Column& column, int face, int i, int j)
  {
    const auto d = shader.iblCubeDirection(face, 2.0 * (i + 0.5) / n - 1.0, 2.0 * (j + 0.5) / n - 1.0);
    column.Cosine = std::abs(d.y) / glm::length(d);
    column.Texels[column.Count++] = { (face * n + j) * n + i, std::atan2(d.z, d.x), d.y < 0.0 };
  };
  for (int j = 0; j < n / 2; ++j)
  {
    for (int i = 0; i < n / 2; ++i)
    {
      Column side;
      for (int face : { 0, 1, 4, 5 })
      {
        for (int corner = 0; corner < 4; ++corner)
        {
          add(side, face, corner % 2 ? n - 1 - i : i, corner / 2 ? n - 1 - j : j);
        }
      }
      columns.push_back(side);
      if (i <= j)
      {
        Column polar;
        for (int face : { 2, 3 })
        {
          for (int corner = 0; corner < 4; ++corner)
          {
            const int x = corner % 2 ? n - 1 - i : i;
            const int y = corner / 2 ? n - 1 - j : j;
            add(polar, face, x, y);
            if (i != j)
            {
              add(polar, face, y, x);
            }
          }
        }
        columns.push_back(polar);
      }
    }
  }
  return columns;
}
}

void vtkIBLSpectrum::Filter(
  double perceptualRoughness, int faceSize, float* rgb, const vtkIBLParallelFor& parallelFor) const
{
  const int order = std::min(this->Order, RequiredOrder(perceptualRoughness));
  const int bands = order + 1;
  const std::vector<double> kernel = KernelBands(perceptualRoughness, order);
  std::vector<float> filtered(Offset(order, bands, bands));
  for (int m = 0; m < bands; ++m)
  {
    for (int l = m; l < bands; ++l)
    {
      for (int c = 0; c < 6; ++c)
      {
        filtered[Offset(order, m, l) + c] = float(kernel[l] * this->Coefficients[Offset(this->Order, m, l) + c]);
      }
    }
  }
  const std::vector<Recurrence> recurrences = MakeRecurrences(order);
  const std::vector<Column> columns = MakeColumns(faceSize);

  // The lobe of a bright texel, with the kernel's integral as its norm: K = t / (1 - k t)^2, 1 - k t = (1 - k) + k |n -
  // d|^2 / 2.
  const double alpha2 = std::pow(perceptualRoughness, 4.0);
  const double k = (1.0 - alpha2) / (1.0 + alpha2);
  const double oneMinusK = 2.0 * alpha2 / (1.0 + alpha2);
  const double norm =
    k < 0.01 ? 0.5 * (1.0 + 4.0 / 3.0 * k) : (std::log(oneMinusK) + k / oneMinusK) / (k * k); // of t, over [0, 1]

  const int blocks = static_cast<int>((columns.size() + Lanes - 1) / Lanes);
  parallelFor(blocks,
    [&](int block)
    {
      const int count = std::min(Lanes, static_cast<int>(columns.size()) - block * Lanes);
      const Column* column = &columns[std::size_t(block) * Lanes];
      Lane cosine = {};
      std::vector<Sectoral> sectorals;
      for (int i = 0; i < count; ++i)
      {
        cosine[i] = float(column[i].Cosine);
        sectorals.emplace_back(std::sqrt(std::max(1.0 - column[i].Cosine * column[i].Cosine, 0.0)));
      }
      std::vector<Lane> turnCosine(count), turnSine(count), stepCosine(count), stepSine(count);
      std::vector<std::array<Lane, 3>> north(count), south(count);
      for (int i = 0; i < count; ++i)
      {
        turnCosine[i].fill(1.0f);
        for (int t = 0; t < column[i].Count; ++t)
        {
          stepCosine[i][t] = float(std::cos(column[i].Texels[t].Phi));
          stepSine[i][t] = float(std::sin(column[i].Texels[t].Phi));
        }
      }
      for (int m = 0; m < bands; ++m)
      {
        Lane sectoral = {};
        for (int i = 0; i < count; ++i)
        {
          sectoral[i] = sectorals[i].Get();
          sectorals[i].Next();
        }
        Lane even[6] = {};
        Lane odd[6] = {};
        const std::size_t begin = Offset(order, m, m);
        SumBands(bands - m, &recurrences[begin / 6], cosine, sectoral, &filtered[begin], even, odd);
        for (int i = 0; i < count; ++i)
        {
          float above[6];
          float below[6];
          for (int c = 0; c < 6; ++c)
          {
            above[c] = even[c][i] + odd[c][i];
            below[c] = even[c][i] - odd[c][i];
          }
          Lane c = turnCosine[i];
          Lane s = turnSine[i];
          AddFourier(
            above, stepCosine[i], stepSine[i], turnCosine[i], turnSine[i], reinterpret_cast<Lane(&)[3]>(north[i]));
          AddFourier(below, stepCosine[i], stepSine[i], c, s, reinterpret_cast<Lane(&)[3]>(south[i]));
        }
      }
      for (int i = 0; i < count; ++i)
      {
        for (int t = 0; t < column[i].Count; ++t)
        {
          const Column::Texel& texel = column[i].Texels[t];
          const double y = texel.South ? -column[i].Cosine : column[i].Cosine;
          const double sine = std::sqrt(std::max(1.0 - y * y, 0.0));
          const glm::dvec3 n(sine * std::cos(texel.Phi), y, sine * std::sin(texel.Phi));
          glm::dvec3 sum(0.0);
          for (const vtkIBLBrightTexel& bright : this->BrightTexels)
          {
            const glm::dvec3 away = n - bright.Direction;
            const double t2 = 1.0 - 0.5 * glm::dot(away, away);
            if (t2 > 0.0)
            {
              const double w = oneMinusK + k * (1.0 - t2);
              sum += bright.Radiance * (bright.SolidAngle * t2 / (w * w));
            }
          }
          for (int c = 0; c < 3; ++c)
          {
            const float smooth = texel.South ? south[i][c][t] : north[i][c][t];
            rgb[std::size_t(3) * texel.Index + c] = std::max(smooth, 0.0f) + float(sum[c] / (2.0 * Pi * norm));
          }
        }
      }
    });
}
