// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceRoom.h"

#include <algorithm>

namespace vtkIBLReference
{
bool IsInside(const Room& room, Vec3 point)
{
  const Vec3 p = point - room.Middle;
  const double x = Dot(p, room.Axes[0]) / room.Half.x;
  const double y = Dot(p, room.Axes[1]) / room.Half.y;
  const double z = Dot(p, room.Axes[2]) / room.Half.z;
  return room.IsBall ? x * x + y * y + z * z < 1 : std::max({ std::abs(x), std::abs(y), std::abs(z) }) < 1;
}

Vec3 Hit(const Room& room, Vec3 origin, Vec3 direction)
{
  const Vec3 d = Normalize(direction);
  double inside = 0;
  double outside = 4 * std::max({ room.Half.x, room.Half.y, room.Half.z });
  for (int i = 0; i < 60; ++i)
  {
    const double middle = 0.5 * (inside + outside);
    (IsInside(room, origin + middle * d) ? inside : outside) = middle;
  }
  return origin + inside * d;
}

RGB ReflectedRadiance(const Room& room, const std::function<RGB(Vec3)>& radiance, Vec3 point, Vec3 N, Vec3 V,
  double perceptualRoughness, int count)
{
  const double alpha = perceptualRoughness * perceptualRoughness;
  const Vec3 tangent = Normalize(Cross(std::abs(N.x) < 0.5 ? Vec3{ 1, 0, 0 } : Vec3{ 0, 1, 0 }, N));
  const Vec3 bitangent = Cross(N, tangent);
  const double NoV = Dot(N, V);
  RGB sum = { 0, 0, 0 };
  for (int i = 0; i < count; ++i)
  {
    for (int j = 0; j < count; ++j)
    {
      // D NoH integrates to tan^2 / (tan^2 + alpha^2).
      const double u = (i + 0.5) / count;
      const double tan = alpha * std::sqrt(u / (1 - u));
      const double NoH = 1 / std::sqrt(1 + tan * tan);
      const double phi = 2 * Pi * (j + 0.5) / count;
      const Vec3 H = NoH * N + NoH * tan * std::cos(phi) * tangent + NoH * tan * std::sin(phi) * bitangent;
      const double VoH = Dot(V, H);
      const Vec3 L = 2 * VoH * H - V;
      const double NoL = Dot(N, L);
      if (NoL > 0 && VoH > 0)
      {
        const double weight = 4 * V_SmithGGXCorrelated(NoL, NoV, alpha) * NoL * VoH / NoH;
        const RGB light = radiance(Hit(room, point, L));
        for (int c = 0; c < 3; ++c)
        {
          sum[c] += weight * light[c] / (double(count) * count);
        }
      }
    }
  }
  return sum;
}
}
