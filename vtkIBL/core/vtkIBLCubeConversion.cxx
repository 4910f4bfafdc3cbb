// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// With y = sin(latitude), solid angle is dphi dy. Texels' edges are great circles, tan(latitude) = A cos(phi - phi0),
// or meridians: under one column of the image a texel is a strip between two nearly straight lines, and a row's share
// of it is closed. docs/derivations/lat-long-to-cube.md
//
// The image's grid has the symmetries of the cube's 16 octants, all of them when its width is a multiple of 4, else a
// half or a quarter. So up to 16 texels share their weights, which cost about what 16 sums do.
#include "vtkIBLCubeConversion.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double LeastAngle = 1e-12; // angles nearer than this are one: borders and corners are rounded

struct Meridian
{
  double Phi, Cosine, Sine;
};

// A direction (x, z) off the axis. Cosines stay above 0, where a circle through the pole is at the pole.
Meridian MakeMeridian(double x, double z)
{
  const double r = std::hypot(x, z);
  return { std::atan2(z, x), std::max(x / r, LeastAngle), z / r };
}

// Columns as they lie to one side of a face's middle, rows as they lie from the equator to a pole. A quarter of the
// image need not be a number of columns: column c begins at c - quarters/4.
struct Grid
{
  Grid(int width, int height, int quarters)
    : Scale(width / (2.0 * Pi))
    , Fraction(0.25 * quarters)
    , Pieces(static_cast<int>(std::ceil(2.0 * Pi / width / 0.05))) // of wide columns, where circles are no lines
  {
    for (int k = 0; k <= (width / 4 + 2) * this->Pieces; ++k)
    {
      const double phi = (double(k) / this->Pieces - this->Fraction) / this->Scale;
      this->Borders.push_back({ phi, std::cos(phi), std::sin(phi) });
    }
    const double middle = height % 2 ? 0.5 : 0.0; // the middle one of an odd number is half north, half south
    for (int k = 0; k <= (height + 1) / 2; ++k)
    {
      this->Heights.push_back(std::sin(std::max(k - middle, 0.0) * Pi / height));
    }
    this->Heights.back() = 2.0; // the pole's row takes all that is above
  }
  double Scale; // columns a radian
  double Fraction;
  int Pieces;
  std::vector<Meridian> Borders; // of the columns' pieces
  std::vector<double> Heights;   // y where row k begins
};

// tan(latitude) = Slope cos(phi), or sin(phi): the line y = Slope of a side face, x or z = 1/Slope of the upper one.
struct Circle
{
  double Slope;
  bool IsSine;
};

// y on a circle, and dy/dphi.
struct Height
{
  Height(const Circle& circle, const Meridian& at)
  {
    const double g = circle.IsSine ? at.Sine : at.Cosine;
    const double slope = circle.IsSine ? at.Cosine : -at.Sine;
    const double tangent = circle.Slope * g;
    const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
    this->Y = tangent * cosine;
    this->Derivative = circle.Slope * slope * cosine * cosine * cosine;
  }
  double Y, Derivative;
};

// A circle between two meridians as a straight line, moved to where it has the circle's mean to the fourth order
// (Euler-Maclaurin): (a + b)/2 - (b' - a') dphi/12.
struct Line
{
  Line(const Height& a, const Height& b, double dphi)
  {
    const double up = (a.Derivative - b.Derivative) * dphi / 12.0;
    this->Least = std::min(a.Y, b.Y) + up;
    this->Most = std::max(a.Y, b.Y) + up;
  }
  // Mean of max(y - from, 0).
  double MeanAbove(double from) const
  {
    if (from <= this->Least)
    {
      return 0.5 * (this->Least + this->Most) - from;
    }
    const double above = this->Most - from;
    return above <= 0.0 ? 0.0 : 0.5 * above * above / (this->Most - this->Least);
  }
  double Least, Most;
};

// Texel (p, q) of an octant is texel First + p StepP + q StepQ of the cube.
struct Placement
{
  std::ptrdiff_t First, StepP, StepQ;
};

template <typename Index>
Placement MakePlacement(const Index& index)
{
  return { index(0, 0), index(1, 0) - index(0, 0), index(0, 1) - index(0, 0) };
}

// One of 16 symmetries. They take the octant 0 <= phi <= pi/4 of the northern hemisphere to all others: mirrored at phi
// = 0 or not, turned by quarters, and to the south.
struct Symmetry
{
  Symmetry(const vtkIBLRadianceImage& image, int n, int index)
    : IsMirrored(index % 2)
    , IsSouth(index / 2 % 2)
  {
    // phi = 0 is the image's middle. Its seam is its left edge when one goes to the right, else its right edge.
    const int turns = index / 4;
    const int side = (turns + 2) % 4;
    const int begin = (side == 0 && this->IsMirrored ? 4 : side) * image.Width; // in quarters of a column
    const int column = this->IsMirrored ? (begin + 3) / 4 - 1 : begin / 4;
    const int row = this->IsSouth ? (image.Height - 1) / 2 : image.Height / 2;
    this->Quarters = this->IsMirrored ? (4 - begin % 4) % 4 : begin % 4;
    this->Origin = image.RGB + std::ptrdiff_t(3) * (std::ptrdiff_t(row) * image.Width + column);

    // From the middle of a face texels are at 1, 3, 5 ... halves.
    const auto texel = [n](int face, int s, int t)
    { return (std::ptrdiff_t(face) * n + (n - 1 + t) / 2) * n + (n - 1 + s) / 2; };
    const int right = this->IsMirrored ? -1 : 1;
    const int up = this->IsSouth ? -1 : 1;
    this->Side = MakePlacement(
      [&](int p, int q)
      {
        const int faces[4] = { 0, 4, 1, 5 };
        return texel(faces[turns], -right * (2 * p + 1), -up * (2 * q + 1));
      });
    this->Polar = MakePlacement(
      [&](int p, int q)
      {
        int x = 2 * p + 1;
        int z = right * (2 * q + 1);
        for (int turn = 0; turn < turns; ++turn)
        {
          x = -std::exchange(z, x);
        }
        return texel(this->IsSouth ? 3 : 2, x, up * z);
      });
  }

  bool IsMirrored, IsSouth;
  int Quarters;        // of its grid
  const float* Origin; // column 0 and row 0
  Placement Side, Polar;
};

// The sums of up to 16 texels that share their weights.
class Footprint
{
public:
  Footprint(const Grid& grid, const std::vector<Symmetry>& symmetries, int width)
    : TheGrid(grid)
    , RowStep(std::ptrdiff_t(3) * width)
    , Symmetries(symmetries)
    , Weights(grid.Heights.size(), 0.0)
  {
  }

  // What lies between two meridians, above one circle and below the other.
  void Add(const Meridian& from, const Meridian& to, const Circle& low, const Circle& high)
  {
    if (to.Phi - from.Phi < LeastAngle)
    {
      return;
    }
    const Grid& grid = this->TheGrid;
    auto piece = static_cast<std::size_t>(((from.Phi + LeastAngle) * grid.Scale + grid.Fraction) * grid.Pieces);
    double phi = from.Phi;
    Height lowLeft(low, from);
    Height highLeft(high, from);
    for (; to.Phi - phi >= LeastAngle; ++piece)
    {
      const Meridian& border = grid.Borders[piece + 1];
      const Meridian& right = border.Phi < to.Phi ? border : to;
      const Height lowRight(low, right);
      const Height highRight(high, right);
      const double width = right.Phi - phi;
      this->AddStrip(
        static_cast<int>(piece / grid.Pieces), width, Line(lowLeft, lowRight, width), Line(highLeft, highRight, width));
      phi = right.Phi;
      lowLeft = lowRight;
      highLeft = highRight;
    }
  }

  void Store(float* rgb, Placement Symmetry::*placement, int p, int q)
  {
    this->EndColumn();
    this->Apply();
    for (std::size_t s = 0; s < this->Symmetries.size(); ++s)
    {
      const Placement& to = this->Symmetries[s].*placement;
      float* texel = rgb + 3 * (to.First + p * to.StepP + q * to.StepQ);
      for (int c = 0; c < 3; ++c)
      {
        texel[c] = static_cast<float>(this->Sums[s][c] / this->Total);
      }
    }
    this->Sums = {};
    this->Total = 0.0;
  }

private:
  void AddStrip(int column, double width, const Line& low, const Line& high)
  {
    if (column != this->Column)
    {
      this->EndColumn();
      this->Column = column;
    }
    const double* heights = this->TheGrid.Heights.data();
    while (heights[this->Row + 1] <= low.Least)
    {
      ++this->Row;
    }
    while (this->Row > 0 && heights[this->Row] > low.Least)
    {
      --this->Row;
    }
    double above = 0.5 * (high.Least + high.Most - low.Least - low.Most);
    this->Total += width * above;
    int row = this->Row;
    this->FirstRow = std::min(this->FirstRow, row);
    do
    {
      const double next = high.MeanAbove(heights[row + 1]) - low.MeanAbove(heights[row + 1]);
      this->Weights[row] += width * (above - next);
      above = next;
      ++row;
    } while (heights[row] < high.Most);
    this->EndRow = std::max(this->EndRow, row);
  }

  // A column's weights to taps.
  void EndColumn()
  {
    for (int row = this->FirstRow; row < this->EndRow; ++row)
    {
      if (this->Count == Most)
      {
        this->Apply();
      }
      const std::ptrdiff_t right = std::ptrdiff_t(3) * this->Column;
      const std::ptrdiff_t up = this->RowStep * row;
      this->Offsets[0][this->Count] = up + right;
      this->Offsets[1][this->Count] = up - right;
      this->Offsets[2][this->Count] = right - up;
      this->Offsets[3][this->Count] = -right - up;
      this->Taps[this->Count++] = static_cast<float>(this->Weights[row]);
      this->Weights[row] = 0.0;
    }
    this->FirstRow = static_cast<int>(this->Weights.size());
    this->EndRow = 0;
  }

  // Taps to sums: few at a time in single precision, then in double.
  void Apply()
  {
    for (std::size_t s = 0; s < this->Symmetries.size(); ++s)
    {
      const Symmetry& symmetry = this->Symmetries[s];
      const std::ptrdiff_t* offsets = this->Offsets[2 * symmetry.IsSouth + symmetry.IsMirrored];
      float sum[3] = {};
      for (int k = 0; k < this->Count; ++k)
      {
        for (int c = 0; c < 3; ++c)
        {
          sum[c] += this->Taps[k] * symmetry.Origin[offsets[k] + c];
        }
      }
      for (int c = 0; c < 3; ++c)
      {
        this->Sums[s][c] += sum[c];
      }
    }
    this->Count = 0;
  }

  static constexpr int Most = 64;
  const Grid& TheGrid;
  std::ptrdiff_t RowStep;
  const std::vector<Symmetry>& Symmetries;
  std::vector<double> Weights; // of the current column, by row
  int Column = -1;
  int Row = 0;      // where the last strip began
  int FirstRow = 0; // of the current column, and the one after its last
  int EndRow = 0;
  std::ptrdiff_t Offsets[4][Most];
  float Taps[Most];
  int Count = 0;
  std::array<std::array<double, 3>, 16> Sums = {};
  double Total = 0.0;
};

// Texels (line, q), q <= line, of the upper face's octant. Those on the diagonal reach beyond it, and are stored twice.
void ConvertPolarLine(Footprint& footprint, int line, int n, float* rgb)
{
  constexpr double pole = 1e-30; // as good as 0, and has a circle
  const double x0 = 2.0 * line / n;
  const double x1 = 2.0 * (line + 1) / n;
  const Circle nearX{ 1.0 / std::max(x0, pole), false };
  const Circle farX{ 1.0 / x1, false };
  Circle nearZ{ 1.0 / pole, true };
  Meridian nearLow = MakeMeridian(std::max(x0, pole), 0.0);
  Meridian farLow = MakeMeridian(x1, 0.0);
  for (int q = 0; q <= line; ++q)
  {
    const double z1 = 2.0 * (q + 1) / n;
    const Circle farZ{ 1.0 / z1, true };
    const Meridian nearHigh = MakeMeridian(x0, z1);
    const Meridian farHigh = MakeMeridian(x1, z1);
    // With longitude one comes by the corner far in x, the near one, the far one, and the one far in z: q <= line.
    footprint.Add(farLow, nearLow, farX, nearZ);
    footprint.Add(nearLow, farHigh, farX, nearX);
    footprint.Add(farHigh, nearHigh, farZ, nearX);
    footprint.Store(rgb, &Symmetry::Polar, line, q);
    nearZ = farZ;
    nearLow = nearHigh;
    farLow = farHigh;
  }
}
}

void vtkIBLConvertToCube(
  const vtkIBLRadianceImage& panorama, int faceSize, float* rgb, const vtkIBLParallelFor& parallelFor)
{
  assert(panorama.Faces == 1 && panorama.Width > 0 && panorama.Height > 0 && faceSize > 0 && faceSize % 2 == 0);
  const int n = faceSize;
  std::array<std::vector<Symmetry>, 4> symmetries; // by the fraction of their columns
  for (int index = 0; index < 16; ++index)
  {
    const Symmetry symmetry(panorama, n, index);
    symmetries[symmetry.Quarters].push_back(symmetry);
  }
  std::vector<Grid> grids;
  for (int quarters = 0; quarters < 4; ++quarters)
  {
    grids.emplace_back(panorama.Width, panorama.Height, quarters);
  }
  std::vector<Meridian> sides;
  for (int p = 0; p <= n / 2; ++p)
  {
    sides.push_back(MakeMeridian(1.0, 2.0 * p / n));
  }
  parallelFor(n / 2,
    [&](int line)
    {
      for (int quarters = 0; quarters < 4; ++quarters)
      {
        if (symmetries[quarters].empty())
        {
          continue;
        }
        Footprint footprint(grids[quarters], symmetries[quarters], panorama.Width);
        for (int p = 0; p < n / 2; ++p)
        {
          footprint.Add(sides[p], sides[p + 1], { 2.0 * line / n, false }, { 2.0 * (line + 1) / n, false });
          footprint.Store(rgb, &Symmetry::Side, p, line);
        }
        ConvertPolarLine(footprint, line, n, rgb);
      }
    });
}
