// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// shaders/vtkIBLParallaxFunctions.glsl and the ladder's move with distance, in double against rays met by bisection,
// and in single precision at the corners of what they are given.
#include "ReferenceRoom.h"
#include "vtkIBLShaderFunctions.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using vtkIBLReference::Room;
using vtkIBLReference::Vec3;

namespace
{
template <typename Function>
void ForRandomRays(const Function& function)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> even(-1, 1);
  for (int i = 0; i < 2000; ++i)
  {
    const glm::dvec3 origin(even(random), even(random), even(random));
    const glm::dvec3 direction(even(random), even(random), even(random));
    if (glm::length(direction) > 0.01)
    {
      function(origin, direction);
    }
  }
}
}

// Rays leave cube and ball where bisection has them leave. Mutants: the near slab; the other root; a length in units of
// something else than `direction`.
TEST(ParallaxFunctions, RaysLeaveWhereTheyMeetTheWall)
{
  vtkIBLCore::ShaderFunctions<double> shader;
  vtkIBLCore::ShaderFunctions<float> single;
  for (const bool isBall : { false, true })
  {
    const Room room{ isBall, { 0, 0, 0 }, { 1, 1, 1 } };
    ForRandomRays(
      [&](glm::dvec3 origin, glm::dvec3 direction)
      {
        origin = isBall ? 0.57 * origin : 0.999 * origin;
        const Vec3 hit =
          vtkIBLReference::Hit(room, { origin.x, origin.y, origin.z }, { direction.x, direction.y, direction.z });
        const double exit = isBall ? shader.iblExitOfBall(origin, direction) : shader.iblExitOfCube(origin, direction);
        EXPECT_LE(glm::length(origin + exit * direction - glm::dvec3(hit.x, hit.y, hit.z)), 1e-9);
        const double inSingle = isBall ? single.iblExitOfBall(glm::vec3(origin), glm::vec3(direction))
                                       : single.iblExitOfCube(glm::vec3(origin), glm::vec3(direction));
        EXPECT_NEAR(inSingle, exit, 2e-5 * (1 + exit));
      });
  }
}

// Along axes, on walls, edges and corners, from the middle, for denormal directions: finite, and never before the
// start. Mutants: 0/0 in a slab; a root of less than nothing; a = 0.
TEST(ParallaxFunctions, CornersAreFinite)
{
  vtkIBLCore::ShaderFunctions<float> shader;
  const float tiny = std::numeric_limits<float>::denorm_min();
  const float past = std::nextafter(1.0f, 2.0f);
  const std::vector<float> places = { -past, -1, 0, tiny, 0.5f, 1, past };
  const std::vector<float> ways = { -1, -1e-30f, -0.0f, 0, tiny, 1e-12f, 1 };
  for (float x : places)
  {
    for (float y : places)
    {
      for (float a : ways)
      {
        for (float b : ways)
        {
          const glm::vec3 origin(x, y, 0.25f);
          const glm::vec3 direction(a, b, 1);
          for (const bool isBall : { false, true })
          {
            const glm::vec3 from = shader.iblClampToProxy(origin, isBall);
            const float exit = isBall ? shader.iblExitOfBall(from, direction) : shader.iblExitOfCube(from, direction);
            ASSERT_TRUE(std::isfinite(exit) && exit >= 0) << x << " " << y << " " << a << " " << b << isBall;
            const glm::vec3 hit = from + exit * direction;
            ASSERT_LE(
              isBall ? glm::length(hit) : std::max({ std::abs(hit.x), std::abs(hit.y), std::abs(hit.z) }), 1.0001f);
          }
        }
      }
    }
  }
  EXPECT_TRUE(std::isfinite(shader.iblExitOfBall(glm::vec3(0), glm::vec3(0))));
  EXPECT_TRUE(std::isfinite(shader.iblExitOfCube(glm::vec3(0), glm::vec3(0))));
}

// Influence is 1 inside, 0 from the edge on, half way in between, and rises evenly; infinite volumes (a point at 0) are
// full. Mutants: the sum of axes for the nearest side; a blend outside the volume.
TEST(ParallaxFunctions, InfluenceEndsAtTheEdge)
{
  vtkIBLCore::ShaderFunctions<double> shader;
  const glm::dvec3 steep(4, 2, 1e6);
  EXPECT_EQ(shader.iblInfluence(glm::dvec3(0, 0, 0), steep, false), 1);
  EXPECT_EQ(shader.iblInfluence(glm::dvec3(0.75, 0.5, 0.9), steep, false), 1);
  EXPECT_NEAR(shader.iblInfluence(glm::dvec3(0.875, 0.2, 0), steep, false), 0.5, 1e-12);
  EXPECT_NEAR(shader.iblInfluence(glm::dvec3(-0.875, 0.75, 0), steep, false), 0.5, 1e-12);
  EXPECT_EQ(shader.iblInfluence(glm::dvec3(1, 0, 0), steep, false), 0);
  EXPECT_EQ(shader.iblInfluence(glm::dvec3(0, -7, 0), steep, false), 0);
  EXPECT_NEAR(shader.iblInfluence(glm::dvec3(0, 0.7, 0.7) * (0.875 / (0.7 * std::sqrt(2.0))), steep, true), 0.5, 1e-12);
  EXPECT_EQ(shader.iblInfluence(glm::dvec3(0.6, 0.6, 0.6), steep, true), 0);
}

// From as far as the probe a layer is itself, from half as far one of 1/sqrt 2 of its roughness, as GGX's alpha has it;
// a mirror stays one. Witness: the ladder's own formulas. Mutants: roughness with the ratio itself; its inverse.
TEST(ParallaxFunctions, LobesKeepTheirFootprint)
{
  vtkIBLCore::ShaderFunctions<double> shader;
  const double layers = 6;
  for (double layer = 1; layer <= layers; layer += 0.25)
  {
    EXPECT_NEAR(shader.iblLayerFromProbe(layer, layers, 1.0), layer, 1e-12);
    for (const double ratio : { 0.25, 0.5, 2.0, 4.0 })
    {
      const double moved = shader.iblLayerFromProbe(layer, layers, ratio);
      const double roughness = shader.iblPerceptualRoughnessFromLayer(layer, layers) * std::sqrt(ratio);
      if (roughness <= 1 && roughness >= 0.1)
      {
        EXPECT_NEAR(shader.iblPerceptualRoughnessFromLayer(moved, layers), roughness, 1e-9) << layer << " " << ratio;
      }
      EXPECT_GE(moved, 0);
      EXPECT_LE(moved, layers);
    }
  }
  for (const double ratio : { 0.0, 1e-30, 1.0, 1e30 })
  {
    EXPECT_EQ(shader.iblLayerFromProbe(0.0, layers, ratio), 0);
  }
}
