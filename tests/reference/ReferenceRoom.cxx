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
}
