// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLStudio.h"

#include "vtkIBLShaderFunctions.h"

#include <algorithm>
#include <cmath>

namespace
{
using Functions = vtkIBLCore::ShaderFunctions<double>;
using Vec3 = Functions::vec3;

struct Softbox
{
  Vec3 Direction;               // towards its centre
  double HalfWidth, HalfHeight; // tangents of half its angles
  double Radiance;
  Vec3 Tint;
};

// 1 inside [-half, half], falling smoothly to 0 over `edge` outside: no aliasing, no ringing.
double Window(double x, double half, double edge)
{
  const double t = std::clamp((half + edge - std::abs(x)) / edge, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double Coverage(const Softbox& box, const Vec3& direction)
{
  const Vec3 forward = glm::normalize(box.Direction);
  const Vec3 right = glm::normalize(glm::cross(forward, Vec3(0.0, 1.0, 0.0)));
  const Vec3 up = glm::cross(right, forward);
  const double depth = glm::dot(direction, forward);
  if (depth <= 0.05)
  {
    return 0.0;
  }
  return Window(glm::dot(direction, right) / depth, box.HalfWidth, 0.06) *
    Window(glm::dot(direction, up) / depth, box.HalfHeight, 0.06);
}
}

void vtkIBLMakeStudio(const vtkIBLRadianceImage& image)
{
  // The camera of a default VTK scene looks along -z: key to its upper left, fill to its right, rim behind the object.
  const Softbox boxes[] = {
    { Vec3(-0.8, 0.8, 0.9), 0.45, 0.6, 5.0, Vec3(1.0, 0.98, 0.95) },
    { Vec3(1.0, 0.25, 0.5), 0.35, 0.8, 1.2, Vec3(0.95, 0.98, 1.0) },
    { Vec3(0.35, 0.7, -1.0), 0.7, 0.15, 3.5, Vec3(1.0, 1.0, 1.0) },
  };
  Functions shader;
  float* rgb = image.RGB;
  for (int row = 0; row < image.Height; ++row)
  {
    for (int column = 0; column < image.Width; ++column, rgb += 3)
    {
      const Vec3 direction = shader.iblDirectionFromEquirect((column + 0.5) / image.Width, (row + 0.5) / image.Height);
      // Floor 0.07, horizon 0.2, ceiling 0.5.
      const double up = direction.y;
      Vec3 radiance = Vec3(up > 0.0 ? 0.2 + 0.3 * up * up : 0.2 - 0.13 * std::sqrt(-up));
      for (const Softbox& box : boxes)
      {
        radiance = glm::mix(radiance, box.Radiance * box.Tint, Coverage(box, direction));
      }
      for (int k = 0; k < 3; ++k)
      {
        rgb[k] = static_cast<float>(radiance[k]);
      }
    }
  }
}
