// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What the GPU's precision costs: every function of shaders/*Functions.glsl in float against the same text in double,
// on the same (float) arguments. The double is proven elsewhere; the errors below are of rounding alone.
#include "vtkIBLShaderFunctions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace
{
vtkIBLCore::ShaderFunctions<float> Single;
vtkIBLCore::ShaderFunctions<double> Double;
constexpr double Eps = 1.0 / (1 << 24); // one rounding

using glm::length; // of a number, its magnitude

constexpr bool Relative = true;
constexpr bool Absolute = false;

// The worst error of one function, and where. Prints it, and fails above the bound, when it goes out of scope.
struct Worst
{
  const char* Name;
  bool IsRelative;
  double Bound;
  double Error = 0.0;
  std::size_t Count = 0;
  std::string Where = "";

  ~Worst()
  {
    std::printf("  %-26s %s %8.1e of %8.1e at %s(%zu values)\n", this->Name, this->IsRelative ? "relative" : "absolute",
      this->Error, this->Bound, this->Where.c_str(), this->Count);
    EXPECT_GT(this->Count, 100u) << this->Name;
    EXPECT_LE(this->Error, this->Bound) << this->Name << " at " << this->Where;
  }
  // f takes a ShaderFunctions; `where` names its arguments.
  template <typename F>
  void Compare(std::initializer_list<double> where, F f)
  {
    const auto exact = f(Double);
    const double difference = length(decltype(exact)(f(Single)) - exact);
    const double error = difference > 0.0 && this->IsRelative ? difference / length(exact) : difference;
    ++this->Count;
    if (!(error <= this->Error) && !std::isnan(this->Error)) // NaN is the worst and stays
    {
      this->Error = error;
      std::ostringstream text;
      text.precision(9);
      std::copy(where.begin(), where.end(), std::ostream_iterator<double>(text, " "));
      this->Where = text.str();
    }
  }
};

// 0, 1, and floats that crowd towards both.
std::vector<float> UnitInterval()
{
  std::vector<float> values;
  for (int i = 0; i <= 64; ++i)
  {
    values.push_back(i / 64.0f);
  }
  for (int i = 7; i <= 20; ++i)
  {
    values.insert(values.end(), { std::exp2(-float(i)) * 1.1f, 1.0f - std::exp2(-float(i)) });
  }
  return values;
}

// From matt to a mirror.
std::vector<float> Alphas()
{
  std::vector<float> values;
  for (int i = 0; i <= 48; ++i)
  {
    values.push_back(std::pow(10.0f, -float(i) / 8.0f));
  }
  return values;
}

// Unit vectors made in double, rounded: along the axes, a tiny angle beside them, and all around.
std::vector<glm::vec3> Directions()
{
  std::vector<glm::vec3> values;
  for (int k = 0; k < 36; ++k)
  {
    const double tilts[6] = { 0, 1e-8, 1e-6, 1e-4, 1e-3, 1e-2 };
    glm::dvec3 v = tilts[k % 6] * glm::dvec3(1, -0.7, 0.3);
    v[k / 6 % 3] = k < 18 ? 1 : -1;
    values.emplace_back(glm::normalize(v));
  }
  std::mt19937 generator(11);
  auto next = [&] { return generator() / 2147483648.0 - 1.0; };
  while (values.size() < 20000)
  {
    const glm::dvec3 v(next(), next(), next());
    if (const double length = glm::length(v); length > 0.1 && length < 1.0)
    {
      values.emplace_back(v / length);
    }
  }
  return values;
}
}

// A few roundings each. Mutant: a frame with 1 / (1 + N.z) and no sign (NaN at -z).
TEST(SinglePrecision, Directions)
{
  Worst angle{ "iblAngle", Relative, 4 * Eps };
  Worst equirect{ "iblEquirectFromDirection", Absolute, 3 * Eps };
  Worst back{ "iblDirectionFromEquirect", Absolute, 8 * Eps }; // two angles of up to pi
  Worst frame{ "iblTangentFrame", Absolute, 4 * Eps };
  Worst irradiance{ "iblPackedIrradiance", Relative, 4 * Eps }; // of terms that add up to 1.9 at most and 0.9 at least
  for (const glm::vec3& d : Directions())
  {
    angle.Compare({ d.z, d.x }, [&](auto& shader) { return shader.iblAngle(d.z, d.x); });
    equirect.Compare({ d.x, d.y, d.z }, [&](auto& shader) { return shader.iblEquirectFromDirection(d); });
    const glm::vec2 uv = Single.iblEquirectFromDirection(d);
    back.Compare({ uv.x, uv.y }, [&](auto& shader) { return shader.iblDirectionFromEquirect(uv.x, uv.y); });
    for (int k = 0; k < 9; ++k)
    {
      frame.Compare({ d.x, d.y, d.z }, [&](auto& shader) { return shader.iblTangentFrame(d)[k % 3]; });
    }
    irradiance.Compare({ d.x, d.y, d.z },
      [&](auto& shader)
      {
        using vec4 = typename std::decay_t<decltype(shader)>::vec4;
        vec4 pack[7];
        std::fill_n(pack, 3, vec4(0.0625, 0.125, -0.0625, 1.375));
        std::fill_n(pack + 3, 4, vec4(0.125, -0.0625, 0.0625, 0.125));
        return shader.iblPackedIrradiance(pack, d);
      });
  }
}

// From the whole face to a texel of 1.5e-8 sr. Mutant: the difference of four atan(s t / r), which loses all digits at
// 16384^2.
TEST(SinglePrecision, SolidAngle)
{
  Worst worst{ "iblCubeSolidAngle", Relative, 8 * Eps };
  for (int n : { 1, 2, 3, 64, 100, 512, 2048, 16384 })
  {
    const float step = 2.0f / n;
    const int stride = std::max(n / 37, 1);
    for (int j = 0; j < n; j += stride)
    {
      for (int i = 0; i < n; i += stride)
      {
        const float s0 = i * step - 1, t0 = j * step - 1, s1 = (i + 1) * step - 1, t1 = (j + 1) * step - 1;
        worst.Compare(
          { double(n), double(i), double(j) }, [&](auto& shader) { return shader.iblCubeSolidAngle(s0, t0, s1, t1); });
      }
    }
  }
}

// Down to alpha = 1e-6. Mutants: the denominator of D as 1 + cos^2 (alpha^2 - 1), the usual form; the sampler's sin^2
// as 1 - cos^2.
TEST(SinglePrecision, Reflection)
{
  Worst D{ "iblD_GGX", Relative, 8 * Eps };
  Worst V{ "iblV_SmithGGXCorrelated", Relative, 8 * Eps };
  Worst schlick{ "iblV_SchlickSmith", Relative, 8 * Eps };
  Worst cosine{ "iblHalfVectorGGX, cos^2", Relative, 5 * Eps };
  Worst sine{ "iblHalfVectorGGX, sin^2", Relative, 5 * Eps };
  Worst fresnel{ "iblF_Schlick", Relative, 8 * Eps };
  Worst lod{ "iblFilteredLod", Absolute, 32 * Eps }; // levels up to 27: one unit in the last place of those
  for (float alpha : Alphas())
  {
    for (float u : UnitInterval())
    {
      cosine.Compare({ u, alpha }, [&](auto& shader) { return shader.iblHalfVectorGGX(u, alpha).x; });
      sine.Compare({ u, alpha }, [&](auto& shader) { return shader.iblHalfVectorGGX(u, alpha).y; });
      fresnel.Compare({ u }, [&](auto& shader) { return shader.iblF_Schlick(glm::vec3(0.04f), glm::vec3(1.0f), u); });
      const glm::vec2 h = Single.iblHalfVectorGGX(u, alpha);
      const float pdf = Single.iblD_GGX(h.x, h.y, alpha);
      D.Compare({ h.x, h.y, alpha }, [&](auto& shader) { return shader.iblD_GGX(h.x, h.y, alpha); });
      lod.Compare({ pdf }, [&](auto& shader) { return shader.iblFilteredLod(pdf, 1024, 512); });
      for (float v : UnitInterval())
      {
        const float NoV = std::max(u, 1e-4f), NoL = std::max(v, 1e-6f);
        V.Compare({ NoV, NoL, alpha }, [&](auto& shader) { return shader.iblV_SmithGGXCorrelated(NoV, NoL, alpha); });
        schlick.Compare({ NoV, NoL, alpha }, [&](auto& shader) { return shader.iblV_SchlickSmith(NoV, NoL, alpha); });
      }
    }
  }
}

// Mutant: a sum that starts at 10^4 and gives it back.
TEST(SinglePrecision, SamplesAndSplitSum)
{
  Worst hammersley{ "iblHammersley", Absolute, 0.0 }; // powers of two, both
  Worst lattice{ "iblLatticePoint", Absolute, 0.0 };
  // Its sine is sqrt(1 - z^2): worst at the apex of the cap.
  Worst half{ "iblVisibleHalfVectorGGX", Absolute, std::sqrt(2 * Eps) };
  Worst splitSum{ "iblSplitSum", Absolute, 512 * Eps }; // one rounding a sample
  for (unsigned int i = 0; i < 512; ++i)
  {
    hammersley.Compare({ double(i) }, [&](auto& shader) { return shader.iblHammersley(i, 512); });
    lattice.Compare({ double(i) }, [&](auto& shader) { return shader.iblLatticePoint(i, 77); });
    const glm::vec2 point = Single.iblHammersley(i, 512);
    for (float alpha : Alphas())
    {
      for (float NoV : { 1e-4f, 0.01f, 0.1f, 0.5f, 0.9f, 0.999f, 1.0f })
      {
        const glm::vec3 V(std::sqrt(1 - NoV * NoV), 0, NoV);
        half.Compare({ point.x, point.y, NoV, alpha },
          [&](auto& shader)
          {
            using Vec2 = typename std::decay_t<decltype(shader)>::vec2;
            return shader.iblVisibleHalfVectorGGX(point, V, Vec2(alpha), shader.iblVisibleBound(V, Vec2(alpha)).x);
          });
      }
    }
  }
  for (int k = 0; k < 2 * 32 * 32; ++k)
  {
    const int geometry = k / 1024;
    const glm::vec2 at = Single.iblBRDFTableArguments(k % 32, k / 32 % 32, 32);
    const float NoV = std::max(at.x, 1e-4f);
    splitSum.Compare(
      { double(geometry), NoV, at.y }, [&](auto& shader) { return shader.iblSplitSum(NoV, at.y, geometry, 512); });
  }
}

// Mutant: the log of the ladder as log2(1024 r) - 10, which loses three bits.
TEST(SinglePrecision, TablesAndEnergy)
{
  Worst layer{ "iblLayerFrom...Roughness", Absolute, 18 * Eps }; // layers up to 10
  Worst roughness{ "iblPerceptual...FromLayer", Relative, 8 * Eps };
  Worst table{ "iblBRDFTableCoordinates", Absolute, 3 * Eps };
  Worst once{ "iblSingleScatter", Relative, 3 * Eps };
  // Over 1 - missing mean, 0.01 at least here; a real table has 0.3.
  Worst again{ "iblMultipleScatter", Absolute, 100 * Eps };
  for (int i = 0; i <= 2000; ++i)
  {
    const float r = i / 2000.0f, l = r * 10;
    layer.Compare({ r }, [&](auto& shader) { return shader.iblLayerFromPerceptualRoughness(r, 10); });
    roughness.Compare({ l }, [&](auto& shader) { return shader.iblPerceptualRoughnessFromLayer(l, 10); });
    table.Compare({ r }, [&](auto& shader) { return shader.iblBRDFTableCoordinates(r, 1 - r, 1, 64); });
  }
  for (float f : UnitInterval())
  {
    for (float albedo : UnitInterval())
    {
      const glm::vec3 f0(f, 0.5f * f, 0.04f), f90(1.0f, f, 1.0f);
      const glm::vec2 ab = std::max(albedo, 0.01f) * glm::vec2(0.75f, 0.25f);
      once.Compare({ f, albedo }, [&](auto& shader) { return shader.iblSingleScatter(f0, f90, ab); });
      again.Compare({ f, albedo },
        [&](auto& shader) { return shader.iblMultipleScatter(f0, f90, shader.iblSingleScatter(f0, f90, ab), ab); });
    }
  }
}
