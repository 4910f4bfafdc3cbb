// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause

// The witness of local light: rays in an empty room, a box or an ellipsoid, met by bisection. Slow, and of no closed
// form.
#ifndef ReferenceRoom_h
#define ReferenceRoom_h

#include "Reference.h"

#include <functional>

namespace vtkIBLReference
{
struct Room
{
  bool IsBall;
  Vec3 Middle, Half;
  std::array<Vec3, 3> Axes = { Vec3{ 1, 0, 0 }, Vec3{ 0, 1, 0 }, Vec3{ 0, 0, 1 } }; // orthonormal
};

bool IsInside(const Room& room, Vec3 point);

// Where a ray from inside meets the wall, to 1e-12 of the room's size.
Vec3 Hit(const Room& room, Vec3 origin, Vec3 direction);

// What a white metal (F = 1) at `point` with the normal N sends towards V in a room whose walls send `radiance`: the single-scattering
// integral of GGX, over half vectors of equal weight, count^2 of them.
RGB ReflectedRadiance(const Room& room, const std::function<RGB(Vec3)>& radiance, Vec3 point, Vec3 N, Vec3 V,
  double perceptualRoughness, int count);
}

#endif
