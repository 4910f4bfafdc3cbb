// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLLamps.h"

#include "vtkIBLLampClusters.h"
#include "vtkIBLSimd.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double LargestRadius = 0.03; // of a lamp [rad]
constexpr float Far = 30.0f;           // radii; a lamp as one light is off by 5e-3 of itself there, and by less beyond
constexpr int Lanes = 16;
typedef float Lane __attribute__((vector_size(4 * Lanes), aligned(4), may_alias));
using Kernel = vtkIBLLamps::Kernel;
using Light = vtkIBLLamps::Light;
using Lamp = vtkIBLLamps::Lamp;

std::vector<Lamp> FindLamps(const std::vector<vtkIBLBrightTexel>& texels)
{
  std::vector<Lamp> lamps;
  for (const vtkIBLLampCluster& cluster : vtkIBLFindLampClusters(texels, LargestRadius))
  {
    Lamp lamp = { { cluster.Direction, cluster.Power }, float(cluster.Radius * cluster.Radius) * Far * Far, {} };
    for (int i : cluster.Texels)
    {
      lamp.Texels.push_back({ texels[i].Direction, texels[i].Radiance * texels[i].SolidAngle });
    }
    lamps.push_back(lamp);
  }
  return lamps;
}

VTKIBL_INLINE void AddLight(
  const Light& light, const Kernel* kernels, int count, const Lane (&normal)[3], Lane (&color)[3])
{
  // |n - d|^2 / 2, which keeps its digits near the peak.
  const Lane ax = normal[0] - light.Direction.x;
  const Lane ay = normal[1] - light.Direction.y;
  const Lane az = normal[2] - light.Direction.z;
  const Lane oneMinusT = 0.5f * (ax * ax + ay * ay + az * az);
  Lane value = {};
  for (int i = 0; i < count; ++i)
  {
    const Lane w = kernels[i].OneMinusK + kernels[i].K * oneMinusT;
    value += kernels[i].Scale / (w * w);
  }
  value *= oneMinusT < 1.0f ? 1.0f - oneMinusT : Lane{};
  color[0] += light.Power.x * value;
  color[1] += light.Power.y * value;
  color[2] += light.Power.z * value;
}

VTKIBL_WIDE void AddLamps(const std::vector<Lamp>& lamps, const std::vector<Kernel>& kernels, int count,
  const float* const (&normal)[3], float* const (&color)[3])
{
  const int kernelCount = static_cast<int>(kernels.size());
  for (int i = 0; i < count; i += Lanes)
  {
    Lane n[3];
    Lane sum[3];
    for (int c = 0; c < 3; ++c)
    {
      n[c] = *reinterpret_cast<const Lane*>(normal[c] + i);
      sum[c] = *reinterpret_cast<const Lane*>(color[c] + i);
    }
    for (const Lamp& lamp : lamps)
    {
      const Lane ax = n[0] - lamp.Whole.Direction.x;
      const Lane ay = n[1] - lamp.Whole.Direction.y;
      const Lane az = n[2] - lamp.Whole.Direction.z;
      const Lane square = ax * ax + ay * ay + az * az;
      float nearest = square[0];
      for (int lane = 1; lane < Lanes; ++lane)
      {
        nearest = square[lane] < nearest ? square[lane] : nearest;
      }
      if (nearest >= lamp.FarSquared)
      {
        AddLight(lamp.Whole, kernels.data(), kernelCount, n, sum);
        continue;
      }
      for (const Light& light : lamp.Texels)
      {
        AddLight(light, kernels.data(), kernelCount, n, sum);
      }
    }
    for (int c = 0; c < 3; ++c)
    {
      *reinterpret_cast<Lane*>(color[c] + i) = sum[c];
    }
  }
}
}

vtkIBLLamps::Kernel vtkIBLLamps::MakeKernel(const vtkIBLLobe& lobe)
{
  const double alpha2 = std::pow(lobe.PerceptualRoughness, 4.0);
  const double k = (1.0 - alpha2) / (1.0 + alpha2);
  const double oneMinusK = 2.0 * alpha2 / (1.0 + alpha2);
  const double norm = // of t / (1 - k t)^2 over [0, 1]
    k < 0.01 ? 0.5 * (1.0 + 4.0 / 3.0 * k) : (std::log(oneMinusK) + k / oneMinusK) / (k * k);
  return { float(k), float(oneMinusK), float(lobe.Weight / (2.0 * Pi * norm)) };
}

vtkIBLLamps::vtkIBLLamps(const std::vector<vtkIBLBrightTexel>& texels, const std::vector<vtkIBLLobe>& lobes)
  : Lamps(FindLamps(texels))
{
  std::transform(lobes.begin(), lobes.end(), std::back_inserter(this->Kernels), MakeKernel);
}

int vtkIBLLamps::Pad(int count)
{
  return (count + Lanes - 1) / Lanes * Lanes;
}

void vtkIBLLamps::AddTo(int count, const float* const (&direction)[3], float* const (&color)[3]) const
{
  AddLamps(this->Lamps, this->Kernels, count, direction, color);
}
