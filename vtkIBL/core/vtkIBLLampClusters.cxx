// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLLampClusters.h"

#include <algorithm>
#include <numeric>

namespace
{
double GetPower(const vtkIBLBrightTexel& texel)
{
  return (texel.Radiance.r + texel.Radiance.g + texel.Radiance.b) * texel.SolidAngle;
}

vtkIBLLampCluster MakeCluster(const std::vector<vtkIBLBrightTexel>& all, std::vector<int> members)
{
  glm::dvec3 sum(0.0);
  vtkIBLLampCluster cluster = { {}, glm::dvec3(0.0), 0.0, 0.0, std::move(members) };
  double power = 0.0;
  for (int i : cluster.Texels)
  {
    sum += GetPower(all[i]) * all[i].Direction;
    power += GetPower(all[i]);
    cluster.Power += all[i].Radiance * all[i].SolidAngle;
  }
  cluster.Direction = glm::normalize(sum);
  for (int i : cluster.Texels)
  {
    const double distance = glm::distance(all[i].Direction, cluster.Direction);
    cluster.Radius = std::max(cluster.Radius, distance);
    // Two tangents share the square of the distance; a square of area A has the variance A/12 along each.
    cluster.Variance += GetPower(all[i]) / power * (0.5 * distance * distance + all[i].SolidAngle / 12.0);
  }
  return cluster;
}
}

std::vector<vtkIBLLampCluster> vtkIBLFindLampClusters(const std::vector<vtkIBLBrightTexel>& texels, double radius)
{
  std::vector<int> left(texels.size());
  std::iota(left.begin(), left.end(), 0);
  std::stable_sort(left.begin(), left.end(), [&](int a, int b) { return GetPower(texels[a]) > GetPower(texels[b]); });
  std::vector<vtkIBLLampCluster> clusters;
  while (!left.empty())
  {
    // Once more around the middle of what was found.
    glm::dvec3 middle = texels[left.front()].Direction;
    std::vector<int>::iterator rest;
    for (int pass = 0; pass < 2; ++pass)
    {
      rest = std::stable_partition(left.begin(), left.end(),
        [&](int i) { return i == left.front() || glm::distance(texels[i].Direction, middle) <= radius; });
      glm::dvec3 sum(0.0);
      std::for_each(left.begin(), rest, [&](int i) { sum += GetPower(texels[i]) * texels[i].Direction; });
      middle = glm::normalize(sum);
    }
    clusters.push_back(MakeCluster(texels, { left.begin(), rest }));
    left.erase(left.begin(), rest);
  }
  std::stable_sort(clusters.begin(), clusters.end(),
    [](const vtkIBLLampCluster& a, const vtkIBLLampCluster& b)
    { return a.Power.r + a.Power.g + a.Power.b > b.Power.r + b.Power.g + b.Power.b; });
  return clusters;
}
