// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause

#include "Reference.h"

#include <algorithm>

namespace vtkIBLReference
{
namespace
{
// Longitude and latitude [rad] of column edge and row edge; both may be fractional.
double Longitude(const Environment& environment, double column)
{
  return 2 * Pi * (column / environment.width - 0.5);
}
double Latitude(const Environment& environment, double row) { return Pi * (row / environment.height - 0.5); }

template <class Value>
Environment Fill(int width, int height, Value value)
{
  Environment environment{ width, height, {} };
  environment.rgb.reserve(3 * static_cast<std::size_t>(width) * height);
  for (int row = 0; row < height; ++row)
  {
    for (int column = 0; column < width; ++column)
    {
      const RGB texel = value(environment, row, column);
      environment.rgb.insert(environment.rgb.end(), texel.begin(), texel.end());
    }
  }
  return environment;
}
}

int TexelIndex(const Environment& environment, Vec3 d)
{
  const double u = std::atan2(d.z, d.x) / (2 * Pi) + 0.5;
  // asin(y) of the unit vector, but exact near the poles and for any length
  const double v = std::atan2(d.y, std::hypot(d.x, d.z)) / Pi + 0.5;
  const int column = static_cast<int>(std::floor(u * environment.width)) % environment.width;
  const int row = static_cast<int>(std::floor(v * environment.height));
  return std::clamp(row, 0, environment.height - 1) * environment.width + column;
}

RGB Radiance(const Environment& environment, Vec3 direction)
{
  const double* texel = environment.Texel(0, 0) + 3 * TexelIndex(environment, direction);
  return { texel[0], texel[1], texel[2] };
}

double TexelSolidAngle(const Environment& environment, int row)
{
  return 2 * Pi / environment.width *
    (std::sin(Latitude(environment, row + 1)) - std::sin(Latitude(environment, row)));
}

Vec3 TexelDirection(const Environment& environment, int row, int column, double du, double dv)
{
  const double longitude = Longitude(environment, column + du);
  const double latitude = Latitude(environment, row + dv);
  return { std::cos(latitude) * std::cos(longitude), std::sin(latitude),
    std::cos(latitude) * std::sin(longitude) };
}

Vec3 TexelVectorIntegral(const Environment& environment, int row, int column)
{
  // d = (cos b cos a, sin b, cos b sin a) and dw = cos b da db, a the longitude and b the latitude
  const double a0 = Longitude(environment, column), a1 = Longitude(environment, column + 1);
  const double b0 = Latitude(environment, row), b1 = Latitude(environment, row + 1);
  const double cosSquared = (b1 - b0) / 2 + (std::sin(2 * b1) - std::sin(2 * b0)) / 4;
  const double sinCos = (std::sin(b1) * std::sin(b1) - std::sin(b0) * std::sin(b0)) / 2;
  return { cosSquared * (std::sin(a1) - std::sin(a0)), sinCos * (a1 - a0),
    cosSquared * (std::cos(a0) - std::cos(a1)) };
}

Environment ConstantEnvironment(RGB radiance, int width, int height)
{
  return Fill(width, height, [&](const Environment&, int, int) { return radiance; });
}

Environment CosineEnvironment(Vec3 axis, int width, int height)
{
  return Fill(width, height, [&](const Environment& environment, int row, int column) {
    const double value =
      1 + Dot(axis, TexelVectorIntegral(environment, row, column)) / TexelSolidAngle(environment, row);
    return RGB{ value, value, value };
  });
}

Environment OneTexelSun(RGB radiance, int row, int column, int width, int height, RGB background)
{
  return Fill(width, height,
    [&](const Environment&, int r, int c) { return r == row && c == column ? radiance : background; });
}

Vec3 CubeDirection(int face, double s, double t)
{
  const Vec3 directions[6] = { { 1, -t, -s }, { -1, -t, s }, { s, 1, t }, { s, -1, -t }, { s, -t, 1 },
    { -s, -t, -1 } }; // OpenGL 4.5, table 8.19
  return Normalize(directions[face]);
}

double CubeTexelSolidAngle(int n, int i, int j)
{
  // Rectangle on the plane at distance 1: primitive atan(st / sqrt(1 + s^2 + t^2)) at its corners.
  const auto corner = [](double s, double t) { return std::atan2(s * t, std::sqrt(1 + s * s + t * t)); };
  const double s0 = 2.0 * i / n - 1, s1 = 2.0 * (i + 1) / n - 1;
  const double t0 = 2.0 * j / n - 1, t1 = 2.0 * (j + 1) / n - 1;
  return corner(s1, t1) - corner(s0, t1) - corner(s1, t0) + corner(s0, t0);
}

RGB CubeTexelAverage(const Environment& environment, int n, int face, int i, int j, int samples)
{
  // Its four sides lie in planes through the origin: inside is where Dot(plane, d) >= 0 for all.
  const auto direction = [&](double di, double dj) {
    return CubeDirection(face, 2 * (i + di) / n - 1, 2 * (j + dj) / n - 1);
  };
  const Vec3 centre = direction(0.5, 0.5);
  const Vec3 corners[4] = { direction(0, 0), direction(1, 0), direction(1, 1), direction(0, 1) };
  Vec3 planes[4];
  for (int k = 0; k < 4; ++k)
  {
    const Vec3 plane = Cross(corners[k], corners[(k + 1) % 4]);
    planes[k] = Dot(plane, centre) > 0 ? plane : -1.0 * plane;
  }

  // Longitude is monotone along a great circle: its extremes are at corners, or all round with a pole inside
  // (n odd; with n even a pole is a corner: its longitude means nothing, and meridians that miss the texel add
  // nothing). Between breaks, the corners and the columns' edges, one column holds the meridian.
  const double middle = std::atan2(centre.z, centre.x);
  std::vector<double> breaks;
  for (const Vec3& corner : corners)
  {
    breaks.push_back(middle + std::remainder(std::atan2(corner.z, corner.x) - middle, 2 * Pi));
  }
  if (face / 2 == 1 && 2 * i + 1 == n && 2 * j + 1 == n)
  {
    breaks.insert(breaks.end(), { middle - Pi, middle + Pi });
  }
  const auto range = std::minmax_element(breaks.begin(), breaks.end());
  const double begin = *range.first, end = *range.second;
  const double firstColumn = std::ceil((begin / (2 * Pi) + 0.5) * environment.width);
  for (double column = firstColumn; Longitude(environment, column) < end; ++column)
  {
    breaks.push_back(Longitude(environment, column));
  }
  std::sort(breaks.begin(), breaks.end());

  RGB sum{};
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
  {
    const double width = breaks[k + 1] - breaks[k];
    for (int sample = 0; sample < samples; ++sample)
    {
      // On the meridian d ~ (cos a, T, sin a), T = tan(latitude), every plane bounds T on one side.
      const double a = breaks[k] + width * (sample + 0.5) / samples, x = std::cos(a), z = std::sin(a);
      double low = -HUGE_VAL, high = HUGE_VAL;
      for (const Vec3& plane : planes)
      {
        const double across = plane.x * x + plane.z * z; // across + plane.y T >= 0
        if (plane.y > 0)
        {
          low = std::max(low, -across / plane.y);
        }
        else if (plane.y < 0)
        {
          high = std::min(high, -across / plane.y);
        }
        else if (across < 0)
        {
          high = -HUGE_VAL; // the plane holds the meridian's axis, and the meridian lies outside
        }
      }
      const double lowest = std::atan(low), highest = std::atan(high); // latitudes
      const int column = TexelIndex(environment, { x, 0, z }) % environment.width;
      const auto rowOf = [&](double latitude) {
        return std::clamp(
          static_cast<int>((latitude / Pi + 0.5) * environment.height), 0, environment.height - 1);
      };
      for (int row = rowOf(lowest); row <= rowOf(highest); ++row)
      {
        const double overlap = std::sin(std::min(highest, Latitude(environment, row + 1))) -
          std::sin(std::max(lowest, Latitude(environment, row)));
        for (int c = 0; c < 3; ++c)
        {
          sum[c] += std::max(0.0, overlap) * width / samples * environment.Texel(row, column)[c];
        }
      }
    }
  }
  for (double& channel : sum)
  {
    channel /= CubeTexelSolidAngle(n, i, j);
  }
  return sum;
}

std::vector<RGB> CubeTexelAverages(const Environment& environment, int n, int samples)
{
  std::vector<RGB> averages(6 * static_cast<std::size_t>(n) * n);
  ParallelFor(6 * n, [&](int line) {
    for (int i = 0; i < n; ++i)
    {
      averages[static_cast<std::size_t>(line) * n + i] =
        CubeTexelAverage(environment, n, line / n, i, line % n, samples);
    }
  });
  return averages;
}
}
