// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause

#include "Reference.h"

#include <algorithm>

namespace vtkIBLReference
{
namespace
{
// ---- Quadrature over texels --------------------------------------------------------------------------

// Gauss-Legendre points and weights on [0,1], 1 to 3 points.
struct GaussRule
{
  double point[3], weight[3];
};
const GaussRule Gauss[4] = { {}, { { 0.5 }, { 1 } },
  { { 0.5 - std::sqrt(1 / 12.), 0.5 + std::sqrt(1 / 12.) }, { 0.5, 0.5 } },
  { { 0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15) }, { 5 / 18., 8 / 18., 5 / 18. } } };

// A piece of the longitude-latitude plane [rad].
struct Cell
{
  double longitude, latitude, width, height;
  Vec3 Direction(double du, double dv) const
  {
    const double a = this->longitude + du * this->width, b = this->latitude + dv * this->height;
    return { std::cos(b) * std::cos(a), std::sin(b), std::cos(b) * std::sin(a) };
  }
  // Extent on the sphere along longitude, where the cell is widest.
  double Breadth() const
  {
    const double top = this->latitude + this->height;
    const double nearest = this->latitude * top <= 0 ? 0 : std::min(std::abs(this->latitude), std::abs(top));
    return this->width * std::cos(nearest);
  }
};

Cell TexelCell(const Environment& environment, int row, int column)
{
  const double width = 2 * Pi / environment.width, height = Pi / environment.height;
  return { column * width - Pi, row * height - Pi / 2, width, height };
}

// Directions and weights of the product rule with k x k points in each of panels x panels parts of every
// texel, kept as one table per axis. The weights of a texel add up to its exact solid angle.
class Nodes
{
public:
  int PerTexel; // along each axis

  Nodes(const Environment& environment, int k, int panels = 1)
    : PerTexel(k * panels)
  {
    const auto point = [&](int node) { return (node / k + Gauss[k].point[node % k]) / panels; };
    for (int i = 0; i < environment.width * this->PerTexel; ++i)
    {
      const Cell cell = TexelCell(environment, 0, i / this->PerTexel);
      const double longitude = cell.longitude + point(i % this->PerTexel) * cell.width;
      this->Columns.push_back({ std::cos(longitude), std::sin(longitude), Gauss[k].weight[i % k] / panels });
    }
    for (int row = 0; row < environment.height; ++row)
    {
      const Cell cell = TexelCell(environment, row, 0);
      double sum = 0;
      for (int i = 0; i < this->PerTexel; ++i)
      {
        const double latitude = cell.latitude + point(i) * cell.height;
        this->Rows.push_back({ std::cos(latitude), std::sin(latitude), Gauss[k].weight[i % k] });
        sum += this->Rows.back().Weight * this->Rows.back().Cos;
      }
      for (int i = 0; i < this->PerTexel; ++i)
      {
        Entry& entry = this->Rows[row * this->PerTexel + i];
        entry.Weight *= entry.Cos / sum * TexelSolidAngle(environment, row);
      }
    }
  }

  Vec3 Direction(int rowNode, int columnNode) const
  {
    const Entry &r = this->Rows[rowNode], &c = this->Columns[columnNode];
    return { r.Cos * c.Cos, r.Sin, r.Cos * c.Sin };
  }
  double Weight(int rowNode, int columnNode) const // [sr]
  {
    return this->Rows[rowNode].Weight * this->Columns[columnNode].Weight;
  }
  // body(direction, weight) for every node of a texel.
  template <class Body>
  void ForEach(int row, int column, const Body& body) const
  {
    for (int j = row * this->PerTexel; j < (row + 1) * this->PerTexel; ++j)
    {
      for (int i = column * this->PerTexel; i < (column + 1) * this->PerTexel; ++i)
      {
        body(this->Direction(j, i), this->Weight(j, i));
      }
    }
  }

private:
  struct Entry
  {
    double Cos, Sin, Weight;
  };
  std::vector<Entry> Columns, Rows;
};

// A kernel has: Weight operator()(l), the integrand, 0 below the horizon; Height(l) = N.l; Scale(l), the
// angle [rad] over which the integrand changes by a factor near l. A cell of size h is integrated with
//   1 point  if h/Scale < 1/160: error of the midpoint rule (h/Scale)^2 16/24 for a ~ (angle^2 + Scale^2)^-2
//   2 x 2    if        < 1/12:   (h/Scale)^4 0.19            peak, so all three are below 3e-5 of the
//   3 x 3    if        < 1/5:    (h/Scale)^6 0.03            cell's own integral
// and is split otherwise. Where the horizon may cut it the integrand has a kink: 3 x 3, and below 1/100 rad.
constexpr double LargestAtHorizon = 1 / 100.;

// Points along each axis, 0 to split.
template <class Kernel>
int PointsFor(const Kernel& kernel, Vec3 centre, double size, double refinement)
{
  const double ratio = refinement * size / kernel.Scale(centre);
  if (kernel.Height(centre) < size)
  {
    return ratio <= 1 / 5. && refinement * size <= LargestAtHorizon ? 3 : 0;
  }
  return ratio <= 1 / 160. ? 1 : ratio <= 1 / 12. ? 2 : ratio <= 1 / 5. ? 3 : 0;
}

template <class Kernel>
typename Kernel::Weight IntegrateCell(const Kernel& kernel, const Cell& cell, double refinement)
{
  typename Kernel::Weight sum{};
  const Vec3 centre = cell.Direction(0.5, 0.5);
  const double breadth = cell.Breadth(), size = std::max(breadth, cell.height);
  if (kernel.Height(centre) < -size)
  {
    return sum; // wholly below the horizon
  }
  if (PointsFor(kernel, centre, size, refinement) > 0)
  {
    for (int j = 0; j < 3; ++j)
    {
      const double cosLatitude = std::cos(cell.latitude + Gauss[3].point[j] * cell.height);
      for (int i = 0; i < 3; ++i)
      {
        const double weight =
          Gauss[3].weight[i] * Gauss[3].weight[j] * cosLatitude * cell.width * cell.height;
        sum = sum + weight * kernel(cell.Direction(Gauss[3].point[i], Gauss[3].point[j]));
      }
    }
    return sum;
  }
  const int columns = breadth > 0.7 * cell.height ? 2 : 1, rows = cell.height > 0.7 * breadth ? 2 : 1;
  const double width = cell.width / columns, height = cell.height / rows;
  for (int k = 0; k < columns * rows; ++k)
  {
    const Cell part{ cell.longitude + (k % columns) * width, cell.latitude + (k / columns) * height, width,
      height };
    sum = sum + IntegrateCell(kernel, part, refinement);
  }
  return sum;
}

struct Quadrature
{
  const Environment& Image;
  Nodes Rules[3]; // 1, 2 x 2 and 3 x 3 points

  explicit Quadrature(const Environment& image)
    : Image(image)
    , Rules{ { image, 1 }, { image, 2 }, { image, 3 } }
  {
  }

  // use(radiance, integral of the kernel over the texel) for every texel that reaches above the horizon.
  template <class Kernel, class Use>
  void ForEachTexel(const Kernel& kernel, double refinement, const Use& use) const
  {
    for (int row = 0; row < this->Image.height; ++row)
    {
      const Cell first = TexelCell(this->Image, row, 0);
      const double size = std::max(first.Breadth(), first.height);
      for (int column = 0; column < this->Image.width; ++column)
      {
        const Vec3 centre = this->Rules[0].Direction(row, column);
        if (kernel.Height(centre) < -size)
        {
          continue;
        }
        typename Kernel::Weight sum{};
        const int points = PointsFor(kernel, centre, size, refinement);
        if (points > 0)
        {
          this->Rules[points - 1].ForEach(
            row, column, [&](Vec3 l, double weight) { sum = sum + weight * kernel(l); });
        }
        else
        {
          sum = IntegrateCell(kernel, TexelCell(this->Image, row, column), refinement);
        }
        use(this->Image.Texel(row, column), sum);
      }
    }
  }
};

// ---- Kernels -------------------------------------------------------------------------------------------

// Prefiltering with N = V = R = n. Half vectors have density D(h) NoH, L is V mirrored at h, so VoH = NoH
// and dw_l = 4 NoH dw_h: L has density D/4; with the weight NoL = t the kernel is t D/4. The half angle gives
// NoH^2 = (1+t)/2, and D ~ (1 + NoH^2 (a^2-1))^-2 = ((1-a^2)/2 (c-t))^-2 with c = (1+a^2)/(1-a^2):
//
//   K(l) ~ max(t,0) / (c-t)^2.
//
// c - t = (1-t) + 2a^2/(1-a^2); times (1-a^2) it stays finite at a = 1, where K is the clamped cosine; and
// 1 - t = |n-l|^2/2 keeps its digits near the peak. The peak, (|n-l|^2/2 + 2a^2)^-2, is 2a wide.
struct PrefilterKernel
{
  using Weight = double;
  Vec3 N;
  double AlphaSquared;

  double Height(Vec3 l) const { return Dot(this->N, l); }
  double Scale(Vec3 l) const { return std::sqrt(Dot(this->N - l, this->N - l) + 4 * this->AlphaSquared); }
  double operator()(Vec3 l) const
  {
    const double q = (1 - this->AlphaSquared) * Dot(this->N - l, this->N - l) / 2 + 2 * this->AlphaSquared;
    return std::max(0.0, this->Height(l)) / (q * q);
  }
};

// The weights of ReflectedParts' members, in their order.
struct SurfaceWeights
{
  double White = 0, WhiteSchlick = 0, Lambert = 0, LambertSchlick = 0;
};
SurfaceWeights operator+(SurfaceWeights a, SurfaceWeights b)
{
  return { a.White + b.White, a.WhiteSchlick + b.WhiteSchlick, a.Lambert + b.Lambert,
    a.LambertSchlick + b.LambertSchlick };
}
SurfaceWeights operator*(double k, SurfaceWeights a)
{
  return { k * a.White, k * a.WhiteSchlick, k * a.Lambert, k * a.LambertSchlick };
}

struct SurfaceKernel
{
  using Weight = SurfaceWeights;
  const Facets& Surface;
  Vec3 V;

  double Height(Vec3 l) const { return Dot(this->Surface.N, l); }
  // D ~ q^-2 changes over sqrt(q) times the smaller alpha of the half vector's angle; turning L by x turns H by
  // at most x / (2 LoH).
  double Scale(Vec3 l) const
  {
    const Vec3 H = Normalize(l + this->V);
    return 2 * Dot(l, H) * std::min(this->Surface.AlphaT, this->Surface.AlphaB) * std::sqrt(this->Surface.Q(H));
  }
  Weight operator()(Vec3 l) const
  {
    const double NoL = this->Height(l);
    if (NoL <= 0)
    {
      return {};
    }
    const Vec3 H = Normalize(l + this->V);
    const double w = SchlickWeight(Dot(l, H));
    const double specular = NoL * this->Surface.D(H) * this->Surface.Visibility(l, this->V);
    return { specular, specular * w, NoL / Pi, w * NoL / Pi };
  }
};

ReflectedParts Reflect(const Quadrature& quadrature, const Facets& facets, Vec3 V, double refinement)
{
  ReflectedParts parts{};
  quadrature.ForEachTexel(
    SurfaceKernel{ facets, V }, refinement, [&](const double* radiance, const SurfaceWeights& weight) {
      for (int c = 0; c < 3; ++c)
      {
        parts.White[c] += radiance[c] * weight.White;
        parts.WhiteSchlick[c] += radiance[c] * weight.WhiteSchlick;
        parts.Lambert[c] += radiance[c] * weight.Lambert;
        parts.LambertSchlick[c] += radiance[c] * weight.LambertSchlick;
      }
    });
  return parts;
}

Facets Isotropic(Vec3 N, double perceptualRoughness)
{
  const double alpha = perceptualRoughness * perceptualRoughness;
  return { N, std::abs(N.y) < 0.9 ? Vec3{ 0, 1, 0 } : Vec3{ 1, 0, 0 }, alpha, alpha };
}

RGB Prefilter(const Quadrature& quadrature, Vec3 normal, double perceptualRoughness, double refinement)
{
  if (perceptualRoughness <= 0)
  {
    return Radiance(quadrature.Image, normal);
  }
  const PrefilterKernel kernel{ normal, std::pow(perceptualRoughness, 4) };
  RGB sum{};
  double total = 0;
  quadrature.ForEachTexel(kernel, refinement, [&](const double* radiance, double weight) {
    for (int c = 0; c < 3; ++c)
    {
      sum[c] += weight * radiance[c];
    }
    total += weight;
  });
  return { sum[0] / total, sum[1] / total, sum[2] / total };
}
}

RGB PrefilteredRadiance(
  const Environment& environment, Vec3 normal, double perceptualRoughness, double refinement)
{
  return Prefilter(Quadrature(environment), normal, perceptualRoughness, refinement);
}

std::vector<RGB> PrefilterAll(const Environment& environment, const std::vector<Vec3>& normals,
  double perceptualRoughness, double refinement)
{
  const Quadrature quadrature(environment);
  std::vector<RGB> result(normals.size());
  ParallelFor(static_cast<int>(normals.size()),
    [&](int i) { result[i] = Prefilter(quadrature, normals[i], perceptualRoughness, refinement); });
  return result;
}

RGB ReflectedParts::Combine(RGB f0, RGB f90, RGB diffuseAlbedo) const
{
  RGB sum;
  for (int c = 0; c < 3; ++c)
  {
    sum[c] = f0[c] * (this->White[c] - this->WhiteSchlick[c]) + f90[c] * this->WhiteSchlick[c] +
      diffuseAlbedo[c] * ((1 - f0[c]) * this->Lambert[c] - (f90[c] - f0[c]) * this->LambertSchlick[c]);
  }
  return sum;
}

ReflectedParts AnisotropicBRDFParts(const Environment& environment, const Facets& facets, Vec3 V, double refinement)
{
  return Reflect(Quadrature(environment), facets, V, refinement);
}

std::vector<ReflectedParts> FullBRDFPartsAll(const Environment& environment, const std::vector<Vec3>& normals, Vec3 V,
  double perceptualRoughness, double refinement)
{
  const Quadrature quadrature(environment);
  std::vector<ReflectedParts> result(normals.size());
  ParallelFor(static_cast<int>(normals.size()), [&](int i) {
    result[i] = Reflect(quadrature, Isotropic(normals[i], perceptualRoughness), V, refinement);
  });
  return result;
}

ReflectedParts FullBRDFParts(
  const Environment& environment, Vec3 N, Vec3 V, double perceptualRoughness, double refinement)
{
  return AnisotropicBRDFParts(environment, Isotropic(N, perceptualRoughness), V, refinement);
}

RGB FullBRDFRadiance(const Environment& environment, Vec3 N, Vec3 V, double perceptualRoughness, RGB f0,
  RGB diffuseAlbedo, double refinement)
{
  return FullBRDFParts(environment, N, V, perceptualRoughness, refinement).Combine(f0, { 1, 1, 1 }, diffuseAlbedo);
}

RGB CoatedRadiance(
  const Environment& environment, Vec3 N, Vec3 V, const Coat& coat, RGB base, double refinement)
{
  const RGB f0 = { coat.F0, coat.F0, coat.F0 };
  const SplitSum sum = SplitSumAB(std::min(1.0, Dot(N, V)), coat.PerceptualRoughness); // 1 may be rounded up
  RGB radiance = FullBRDFRadiance(environment, N, V, coat.PerceptualRoughness, f0, { 0, 0, 0 }, refinement);
  for (int c = 0; c < 3; ++c)
  {
    radiance[c] = coat.Strength * radiance[c] +
      (1 - coat.Strength * (coat.F0 * sum.A + sum.B)) * coat.Tint[c] * base[c];
  }
  return radiance;
}

// ---- Irradiance ----------------------------------------------------------------------------------------

std::vector<RGB> IrradianceAll(const Environment& environment, const std::vector<Vec3>& normals)
{
  const int width = environment.width, height = environment.height;
  std::vector<Vec3> vectors(static_cast<std::size_t>(width) * height);
  ParallelFor(height, [&](int row) {
    for (int column = 0; column < width; ++column)
    {
      vectors[static_cast<std::size_t>(row) * width + column] = TexelVectorIntegral(environment, row, column);
    }
  });
  const Nodes fine(environment, 1, 16); // for texels cut by the horizon
  std::vector<RGB> result(normals.size());
  ParallelFor(static_cast<int>(normals.size()), [&](int k) {
    RGB sum{};
    for (int row = 0; row < height; ++row)
    {
      const Cell first = TexelCell(environment, row, 0);
      const double reach = std::max(first.Breadth(), first.height) * TexelSolidAngle(environment, row);
      for (int column = 0; column < width; ++column)
      {
        // the integral of max(n.l, 0); |n.l| < reach / solid angle may change sign within the texel
        double cosine = Dot(normals[k], vectors[static_cast<std::size_t>(row) * width + column]);
        if (std::abs(cosine) < reach)
        {
          cosine = 0;
          fine.ForEach(row, column,
            [&](Vec3 l, double weight) { cosine += weight * std::max(0.0, Dot(normals[k], l)); });
        }
        for (int c = 0; c < 3; ++c)
        {
          sum[c] += std::max(0.0, cosine) * environment.Texel(row, column)[c];
        }
      }
    }
    result[k] = sum;
  });
  return result;
}

RGB Irradiance(const Environment& environment, Vec3 normal)
{
  return IrradianceAll(environment, { normal })[0];
}

// ---- Harmonics -----------------------------------------------------------------------------------------

namespace
{
// Adds weight * Y / HarmonicNorm. With sin^m(theta) (cos(m phi), sin(m phi)) = (x + i y)^m and
// P_lm(z) = sin^m(theta) Q_lm(z):   Q_mm = (2m-1)!!,   (l-m) Q_lm = (2l-1) z Q_l-1,m - (l+m-1) Q_l-2,m.
void AddHarmonics(int order, Vec3 d, double weight, std::vector<double>& sum)
{
  double re = weight, im = 0, diagonal = 1;
  for (int m = 0; m <= order; ++m)
  {
    double previous = 0, q = diagonal;
    for (int l = m; l <= order; ++l)
    {
      sum[l * (l + 1) + m] += q * re;
      if (m > 0)
      {
        sum[l * (l + 1) - m] += q * im;
      }
      const double next = ((2 * l + 1) * d.z * q - (l + m) * previous) / (l + 1 - m);
      previous = q;
      q = next;
    }
    const double turned = re * d.x - im * d.y;
    im = re * d.y + im * d.x;
    re = turned;
    diagonal *= 2 * m + 1;
  }
}

// sqrt((2l+1)/(4 pi) (l-|m|)!/(l+|m|)!), times sqrt(2) for m != 0.
double HarmonicNorm(int l, int m)
{
  double square = (2 * l + 1) / (4 * Pi) * (m == 0 ? 1 : 2);
  for (int k = l - std::abs(m) + 1; k <= l + std::abs(m); ++k)
  {
    square /= k;
  }
  return std::sqrt(square);
}
}

std::vector<double> HarmonicBasis(int order, Vec3 direction)
{
  std::vector<double> basis((order + 1) * (order + 1), 0.0);
  AddHarmonics(order, direction, 1, basis);
  for (int l = 0; l <= order; ++l)
  {
    for (int m = -l; m <= l; ++m)
    {
      basis[l * (l + 1) + m] *= HarmonicNorm(l, m);
    }
  }
  return basis;
}

std::vector<RGB> HarmonicCoefficients(const Environment& environment, int order, double refinement)
{
  // Y_l changes over 1/(l+1) rad: 3 x 3 points in panels below a fifth of that, as for the kernels above.
  const double size = std::max(2 * Pi / environment.width, Pi / environment.height);
  const Nodes nodes(environment, 3, static_cast<int>(std::ceil(5 * refinement * size * (order + 1))));
  const std::size_t count = (order + 1) * (order + 1);
  std::vector<std::vector<RGB>> rows(environment.height, std::vector<RGB>(count, RGB{}));
  ParallelFor(environment.height, [&](int row) {
    std::vector<double> texel(count);
    for (int column = 0; column < environment.width; ++column)
    {
      std::fill(texel.begin(), texel.end(), 0.0);
      nodes.ForEach(row, column, [&](Vec3 l, double weight) { AddHarmonics(order, l, weight, texel); });
      for (std::size_t k = 0; k < count; ++k)
      {
        for (int c = 0; c < 3; ++c)
        {
          rows[row][k][c] += texel[k] * environment.Texel(row, column)[c];
        }
      }
    }
  });
  std::vector<RGB> coefficients(count, RGB{});
  for (int l = 0; l <= order; ++l)
  {
    for (int m = -l; m <= l; ++m)
    {
      const int k = l * (l + 1) + m;
      for (const std::vector<RGB>& row : rows) // in order of rows: the same bits for any thread count
      {
        for (int c = 0; c < 3; ++c)
        {
          coefficients[k][c] += HarmonicNorm(l, m) * row[k][c];
        }
      }
    }
  }
  return coefficients;
}
}
