// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What the GPU's precision costs: every function of shaders/*Functions.glsl in float against the same text in double,
// on the same (float) arguments, over its whole domain: on a dense grid, awkward places first, and with random bits.
// The double is proven elsewhere; the errors are of rounding alone. The bounds are those of the table in
// docs/numerics.md, which is read here, so that what is written there is what holds.
#include "StressSupport.h"

#include "vtkIBLShaderFunctions.h"

#include <glm/gtc/type_ptr.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <random>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace
{
vtkIBLCore::ShaderFunctions<float> Single;
vtkIBLCore::ShaderFunctions<double> Double;
constexpr double Eps = 1.0 / (1 << 24); // one rounding

// A row of the table.
struct Row
{
  std::string Function;
  bool IsRelative = false; // to each component; else of 1
  double Bound = 0.0;      // in roundings
  bool IsPositive = false; // 0 or more
  double Largest = std::numeric_limits<double>::max();
};

void PrintTo(const Row& row, std::ostream* out)
{
  *out << row.Function;
}

// | `function` | of what | relative or absolute | bound | values |
std::vector<Row> ReadTable()
{
  std::vector<Row> rows;
  std::ifstream file(std::filesystem::path(VTKIBL_SOURCE) / "docs/numerics.md");
  const std::regex pattern(
    R"(\| `(ibl\w+)` \|[^|]*\| (relative|absolute) \| ([0-9]+) \| (any|≥ 0|\[0, ([0-9]+)\]) \|)");
  for (std::string line; std::getline(file, line);)
  {
    std::smatch match;
    if (std::regex_match(line, match, pattern))
    {
      rows.push_back({ match[1], match[2] == "relative", std::stod(match[3]), match[4] != "any",
        match[5].matched ? std::stod(match[5]) : std::numeric_limits<double>::max() });
    }
  }
  return rows;
}

template <typename T>
std::vector<double> Components(const T& value)
{
  if constexpr (std::is_arithmetic_v<T>)
  {
    return { double(value) };
  }
  else
  {
    const auto* first = glm::value_ptr(value);
    return { first, first + sizeof(T) / sizeof(*first) };
  }
}

// The worst error of one function, and where.
struct Sweep
{
  explicit Sweep(const Row& row)
    : Bounds(row)
  {
  }
  const Row Bounds;
  double Error = 0.0; // in roundings
  std::size_t Count = 0;
  std::string Where = "";
  std::string Outside = ""; // where a value is none that there can be

  // f takes a ShaderFunctions and the numbers x.
  template <std::size_t N, typename F>
  void Compare(const float (&x)[N], const F& f)
  {
    const std::vector<double> exact = Components(f(Double, x));
    const std::vector<double> value = Components(f(Single, x));
    const auto name = [&x]
    {
      std::ostringstream text;
      text.precision(9);
      std::copy(x, x + N, std::ostream_iterator<float>(text, " "));
      return text.str();
    };
    ++this->Count;
    for (std::size_t k = 0; k < exact.size(); ++k)
    {
      // Below the smallest normal number digits go, one by one.
      const double difference = std::max(std::abs(value[k] - exact[k]) - std::numeric_limits<float>::min(), 0.0);
      const double error = difference > 0 && this->Bounds.IsRelative ? difference / std::abs(exact[k]) : difference;
      if (error > this->Error * Eps)
      {
        this->Error = error / Eps;
        this->Where = name();
      }
      if (!std::isfinite(value[k]) || (this->Bounds.IsPositive && value[k] < 0) || value[k] > this->Bounds.Largest)
      {
        this->Outside = name() + "gives " + std::to_string(value[k]);
      }
    }
  }
};

struct Range
{
  float Low, High;
};
constexpr Range Share = { 0, 1 };
constexpr Range Cosine = { -1, 1 };
constexpr Range NoV = { 1e-4f, 1 };   // where it is made, it is clamped
constexpr Range Alpha = { 1e-6f, 1 }; // so is this

// Numbers of a range, the most awkward first: its ends, their neighbours, zero, denormals, powers of ten, steps.
std::vector<float> AwkwardNumbers(const Range& range, std::size_t count)
{
  std::vector<float> numbers;
  const auto add = [&](float number)
  {
    if (number >= range.Low && number <= range.High && numbers.size() < count &&
      std::find(numbers.begin(), numbers.end(), number) == numbers.end())
    {
      numbers.push_back(number);
    }
  };
  for (float number :
    { range.Low, range.High, 0.0f, 1e-7f, std::nextafter(range.High, range.Low), 0.5f, 1e-4f, 1e-45f,
      std::nextafter(range.Low, range.High), 0.1f, 0.01f, 0.9f, -1e-7f, 1e-38f, -0.5f, 0.999f, 1e-3f, 1e-5f, 1e-20f })
  {
    add(number);
  }
  for (int step = 1; step < 64; ++step)
  {
    add(range.Low + (range.High - range.Low) * float(step) / 64.0f);
    add(1.0f - std::exp2(-float(step)));
    add(std::pow(10.0f, -float(step) / 4.0f));
  }
  return numbers;
}

std::mt19937 Random(11);

// Half of them even in value, half of them even in bits, so that all exponents come.
float RandomNumber(const Range& range)
{
  const double u = double(Random()) / 4294967296.0;
  if (Random() % 2)
  {
    return float(range.Low + (double(range.High) - range.Low) * u);
  }
  const float largest = std::max(std::abs(range.Low), range.High), smallest = std::max(range.Low, 0.0f);
  std::uint32_t low, high;
  std::memcpy(&low, &smallest, sizeof low);
  std::memcpy(&high, &largest, sizeof high);
  const auto bits = std::uint32_t(low + u * (high - low));
  float number;
  std::memcpy(&number, &bits, sizeof number);
  return range.Low < 0 && Random() % 2 ? -number : number;
}

// f(shader, x) for the awkward numbers in every combination, and for random ones.
template <std::size_t N, typename F>
void Over(Sweep& sweep, const Range (&ranges)[N], const F& f)
{
  const auto each = std::size_t(std::pow(2e5, 1.0 / N));
  std::vector<std::vector<float>> numbers;
  std::size_t combinations = 1;
  for (const Range& range : ranges)
  {
    numbers.push_back(AwkwardNumbers(range, each));
    combinations *= numbers.back().size();
  }
  float x[N];
  for (std::size_t combination = 0; combination < combinations; ++combination)
  {
    std::size_t rest = combination;
    for (std::size_t k = 0; k < N; ++k)
    {
      x[k] = numbers[k][rest % numbers[k].size()];
      rest /= numbers[k].size();
    }
    sweep.Compare(x, f);
  }
  for (int i = 0, count = StressCount(50000); i < count; ++i)
  {
    std::transform(ranges, ranges + N, x, RandomNumber);
    sweep.Compare(x, f);
  }
}

// A direction through a point of a cube, its axes and corners among them; +z for its middle. Made in double, rounded.
glm::vec3 Direction(const float* x)
{
  const glm::dvec3 d(x[0], x[1], x[2]);
  const double length = glm::length(d);
  return length > 1e-30 ? glm::vec3(d / length) : glm::vec3(0, 0, 1);
}

template <typename Shader>
auto Vec3Of(Shader&, const float* x)
{
  return typename Shader::vec3(x[0], x[1], x[2]);
}

// In the tangent frame, by its cosine and its azimuth as a share of a turn.
glm::vec3 TangentDirection(float cosine, float turn)
{
  const double phi = 2.0 * Double.iblPi * turn;
  const double sine = std::sqrt(std::max(1.0 - double(cosine) * cosine, 0.0));
  return glm::vec3(sine * std::cos(phi), sine * std::sin(phi), cosine);
}

const std::map<std::string, std::function<void(Sweep&)>> Sweeps = {
  { "iblAngle",
    [](Sweep& sweep)
    {
      Over(sweep, { { -1e38f, 1e38f }, { -1e38f, 1e38f } },
        [](auto& shader, const auto& x) { return shader.iblAngle(x[0], x[1]); });
      Over(sweep, { Cosine, Cosine }, [](auto& shader, const auto& x) { return shader.iblAngle(x[0], x[1]); });
    } },
  { "iblCubeDirection",
    [](Sweep& sweep)
    {
      Over(sweep, { { 0, 5 }, Cosine, Cosine },
        [](auto& shader, const auto& x) { return shader.iblCubeDirection(int(x[0]), x[1], x[2]); });
    } },
  { "iblEquirectFromDirection",
    [](Sweep& sweep)
    {
      Over(sweep, { Cosine, Cosine, Cosine },
        [](auto& shader, const auto& x) { return shader.iblEquirectFromDirection(Direction(x)); });
    } },
  { "iblDirectionFromEquirect",
    [](Sweep& sweep)
    {
      Over(sweep, { Share, Share },
        [](auto& shader, const auto& x) { return shader.iblDirectionFromEquirect(x[0], x[1]); });
    } },
  { "iblTriangleSolidAngle", // of a corner and the legs along s and t; of no area, too
    [](Sweep& sweep)
    {
      Over(sweep, { Cosine, Cosine, Share, Share },
        [](auto& shader, const auto& x)
        {
          const float s1 = std::min(x[0] + x[2], 1.0f), t1 = std::min(x[1] + x[3], 1.0f);
          const auto twiceArea = decltype(shader.iblPi)(s1 - x[0]) * (t1 - x[1]);
          return shader.iblTriangleSolidAngle(
            glm::vec3(x[0], x[1], 1), glm::vec3(s1, x[1], 1), glm::vec3(x[0], t1, 1), twiceArea);
        });
    } },
  { "iblCubeSolidAngle", // texels of any cube map up to 32768^2
    [](Sweep& sweep)
    {
      Over(sweep, { { 0, 15 }, Share, Share },
        [](auto& shader, const auto& x)
        {
          const int n = 1 << int(x[0]);
          const float step = 2.0f / n, s = int(x[1] * (n - 1)) * step - 1, t = int(x[2] * (n - 1)) * step - 1;
          return shader.iblCubeSolidAngle(s, t, s + step, t + step);
        });
    } },
  { "iblCubeLodOffset",
    [](Sweep& sweep)
    {
      Over(sweep, { Cosine, Cosine, Cosine },
        [](auto& shader, const auto& x) { return shader.iblCubeLodOffset(Direction(x)); });
    } },
  { "iblHammersley",
    [](Sweep& sweep)
    {
      Over(sweep, { { 0, 16 }, Share },
        [](auto& shader, const auto& x)
        {
          const unsigned int count = 1u << int(x[0]);
          return shader.iblHammersley(unsigned(x[1] * (count - 1)), count);
        });
    } },
  { "iblHash",
    [](Sweep& sweep)
    { Over(sweep, { Share }, [](auto& shader, const auto& x) { return shader.iblHash(unsigned(x[0] * 4e9)); }); } },
  { "iblLatticePoint",
    [](Sweep& sweep)
    {
      Over(sweep, { Share, Share },
        [](auto& shader, const auto& x) { return shader.iblLatticePoint(unsigned(x[0] * 4e9), unsigned(x[1] * 4e9)); });
    } },
  { "iblHalfVectorGGX",
    [](Sweep& sweep) {
      Over(sweep, { Share, Alpha }, [](auto& shader, const auto& x) { return shader.iblHalfVectorGGX(x[0], x[1]); });
    } },
  { "iblVisibleBound",
    [](Sweep& sweep)
    {
      Over(sweep, { NoV, Share, Alpha, Alpha },
        [](auto& shader, const auto& x)
        { return shader.iblVisibleBound(TangentDirection(x[0], x[1]), glm::vec2(x[2], x[3])); });
    } },
  { "iblVisibleHalfVectorGGX", // the bound from the same precision, as in the shader
    [](Sweep& sweep)
    {
      Over(sweep, { NoV, Share, { 0, 0.99f }, Alpha, Alpha },
        [](auto& shader, const auto& x)
        {
          const glm::vec3 V = TangentDirection(x[0], 0.1f);
          const glm::vec2 alpha(x[3], x[4]);
          return shader.iblVisibleHalfVectorGGX(glm::vec2(x[1], x[2]), V, alpha, shader.iblVisibleBound(V, alpha).x);
        });
    } },
  { "iblTangentFrame",
    [](Sweep& sweep)
    {
      Over(sweep, { Cosine, Cosine, Cosine },
        [](auto& shader, const auto& x) { return shader.iblTangentFrame(Direction(x)); });
      Over(sweep, { Share }, [](auto& shader, const auto&) { return shader.iblTangentFrame(glm::vec3(0)); });
    } },
  { "iblFilteredLod",
    [](Sweep& sweep)
    {
      Over(sweep, { { 1e-20f, 1e12f }, { 1, 65536 }, { 1, 4096 } },
        [](auto& shader, const auto& x) { return shader.iblFilteredLod(x[0], x[1], x[2]); });
    } },
  { "iblAlpha",
    [](Sweep& sweep) {
      Over(sweep, { { 1e-18f, 1 } }, [](auto& shader, const auto& x) { return shader.iblAlpha(x[0]); });
    } },
  { "iblD_GGX",
    [](Sweep& sweep)
    {
      Over(sweep, { Share, Alpha },
        [](auto& shader, const auto& x)
        {
          const glm::vec2 h = Single.iblHalfVectorGGX(x[0], x[1]);
          return shader.iblD_GGX(h.x, h.y, x[1]);
        });
      // Lamps have sin^2 as 1 - cos^2, which rounding makes negative; alpha is 0.01 there at least.
      Over(sweep, { { 0, 1 + 2e-7f }, { 0.01f, 1 } },
        [](auto& shader, const auto& x) { return shader.iblD_GGX(x[0], 1.0f - x[0], x[1]); });
    } },
  { "iblSmithRoot",
    [](Sweep& sweep)
    {
      Over(sweep, { { 0, 1 + 2e-7f }, { 1e-12f, 1 } },
        [](auto& shader, const auto& x) { return shader.iblSmithRoot(x[0], x[1]); });
    } },
  { "iblLobeGGX", // cosines of half vectors all over the hemisphere
    [](Sweep& sweep)
    {
      Over(sweep, { Share, { 1e-3f, 2 }, { 1e-4f, 2 }, { 1e-4f, 1 } },
        [](auto& shader, const auto& x) { return shader.iblLobeGGX(std::sqrt(2.0f * x[1] * x[0]), x[1], x[2], x[3]); });
    } },
  { "iblV_SmithGGXCorrelated",
    [](Sweep& sweep)
    {
      Over(sweep, { { 1e-4f, 1 + 2e-7f }, { 0, 1 + 2e-7f }, Alpha },
        [](auto& shader, const auto& x) { return shader.iblV_SmithGGXCorrelated(x[0], x[1], x[2]); });
    } },
  { "iblD_GGXAnisotropic",
    [](Sweep& sweep)
    {
      Over(sweep, { Share, Share, Alpha, Alpha },
        [](auto& shader, const auto& x)
        { return shader.iblD_GGXAnisotropic(TangentDirection(x[0], x[1]), glm::vec2(x[2], x[3])); });
    } },
  { "iblV_SmithGGXAnisotropic",
    [](Sweep& sweep)
    {
      Over(sweep, { NoV, Share, Share, Alpha, Alpha },
        [](auto& shader, const auto& x)
        {
          return shader.iblV_SmithGGXAnisotropic(
            TangentDirection(x[0], 0.1f), TangentDirection(x[1], x[2]), glm::vec2(x[3], x[4]));
        });
    } },
  { "iblV_SchlickSmith",
    [](Sweep& sweep)
    {
      Over(sweep, { NoV, Share, Alpha },
        [](auto& shader, const auto& x) { return shader.iblV_SchlickSmith(x[0], x[1], x[2]); });
    } },
  { "iblF_Schlick",
    [](Sweep& sweep)
    {
      Over(sweep, { Share, Share, Share },
        [](auto& shader, const auto& x) { return shader.iblF_Schlick(glm::vec3(x[0]), glm::vec3(x[1]), x[2]); });
    } },
  { "iblSplitSum", // 64 samples: one rounding each
    [](Sweep& sweep)
    {
      Over(sweep, { NoV, Share },
        [](auto& shader, const auto& x) { return shader.iblSplitSum(x[0], x[1], IBL_SMITH_CORRELATED, 64); });
      Over(sweep, { NoV, Share },
        [](auto& shader, const auto& x) { return shader.iblSplitSum(x[0], x[1], IBL_SCHLICK_SMITH, 64); });
    } },
  { "iblBRDFTableCoordinates",
    [](Sweep& sweep)
    {
      Over(sweep, { Share, Share, Share, { 2, 512 } },
        [](auto& shader, const auto& x)
        { return shader.iblBRDFTableCoordinates(x[0], x[1], std::round(x[2]), std::floor(x[3])); });
    } },
  { "iblBRDFTableArguments",
    [](Sweep& sweep)
    {
      Over(sweep, { Share, Share, { 2, 512 } },
        [](auto& shader, const auto& x)
        {
          const float n = std::floor(x[2]);
          return shader.iblBRDFTableArguments(x[0] * (n - 1), x[1] * (n - 1), n);
        });
    } },
  { "iblSingleScatter",
    [](Sweep& sweep)
    {
      Over(sweep, { Share, Share, Share, Share },
        [](auto& shader, const auto& x)
        { return shader.iblSingleScatter(glm::vec3(x[0]), glm::vec3(x[1]), x[2] * glm::vec2(x[3], 1 - x[3])); });
    } },
  { "iblMultipleScatter",
    [](Sweep& sweep)
    {
      Over(sweep, { Share, Share, { 0.2f, 1 + 2e-7f }, Share },
        [](auto& shader, const auto& x)
        {
          const glm::vec3 f0(x[0]), f90(x[1]);
          const glm::vec2 ab = x[2] * glm::vec2(x[3], 1 - x[3]);
          return shader.iblMultipleScatter(f0, f90, shader.iblSingleScatter(f0, f90, ab), ab);
        });
    } },
  { "iblClassicSingleScatter",
    [](Sweep& sweep)
    {
      Over(sweep, { Share, Share, Share, NoV, Share },
        [](auto& shader, const auto& x) {
          return shader.iblClassicSingleScatter(
            glm::vec3(x[0]), glm::vec3(x[1]), glm::vec2(x[2], 1 - x[2]), x[3], x[4]);
        });
    } },
  { "iblDielectricShare",
    [](Sweep& sweep)
    {
      Over(sweep, { Share, Share, Share, Share },
        [](auto& shader, const auto& x)
        { return shader.iblDielectricShare(x[0], x[1], x[2] * glm::vec2(x[3], 1 - x[3])); });
    } },
  { "iblNarrowAlpha",
    [](Sweep& sweep)
    {
      Over(sweep, { Alpha, Alpha },
        [](auto& shader, const auto& x) { return shader.iblNarrowAlpha(glm::vec2(x[0], x[1])); });
    } },
  { "iblDiffuseFresnel",
    [](Sweep& sweep)
    { Over(sweep, { Share }, [](auto& shader, const auto& x) { return shader.iblDiffuseFresnel(x[0]); }); } },
  { "iblSpecularOcclusion",
    [](Sweep& sweep)
    {
      Over(sweep, { NoV, Share, Share },
        [](auto& shader, const auto& x) { return shader.iblSpecularOcclusion(x[0], x[1], x[2]); });
    } },
  { "iblHorizonFade",
    [](Sweep& sweep)
    { Over(sweep, { Cosine }, [](auto& shader, const auto& x) { return shader.iblHorizonFade(x[0]); }); } },
  { "iblPackedIrradiance", // of terms that add up to 1.9 at most and 0.9 at least
    [](Sweep& sweep)
    {
      Over(sweep, { Cosine, Cosine, Cosine },
        [](auto& shader, const auto& x)
        {
          using vec4 = typename std::decay_t<decltype(shader)>::vec4;
          vec4 pack[7];
          std::fill_n(pack, 3, vec4(0.0625, 0.125, -0.0625, 1.375));
          std::fill_n(pack + 3, 4, vec4(0.125, -0.0625, 0.0625, 0.125));
          return shader.iblPackedIrradiance(pack, Direction(x));
        });
    } },
  { "iblLayerFromPerceptualRoughness",
    [](Sweep& sweep)
    {
      Over(sweep, { Share, { 2, 14 } },
        [](auto& shader, const auto& x) { return shader.iblLayerFromPerceptualRoughness(x[0], std::floor(x[1])); });
    } },
  { "iblPerceptualRoughnessFromLayer",
    [](Sweep& sweep)
    {
      Over(sweep, { Share, { 2, 14 } },
        [](auto& shader, const auto& x)
        {
          const float layers = std::floor(x[1]);
          return shader.iblPerceptualRoughnessFromLayer(x[0] * layers, layers);
        });
    } },
  { "iblLadderPosition",
    [](Sweep& sweep)
    { Over(sweep, { Share }, [](auto& shader, const auto& x) { return shader.iblLadderPosition(x[0]); }); } },
  { "iblPerceptualRoughnessFromPosition",
    [](Sweep& sweep)
    {
      Over(
        sweep, { Share }, [](auto& shader, const auto& x) { return shader.iblPerceptualRoughnessFromPosition(x[0]); });
    } },
  { "iblLayerFromPosition",
    [](Sweep& sweep)
    {
      Over(sweep, { Share, { 2, 14 } },
        [](auto& shader, const auto& x) { return shader.iblLayerFromPosition(x[0], std::floor(x[1])); });
    } },
  { "iblLayerFromProbe",
    [](Sweep& sweep)
    {
      Over(sweep, { Share, { 2, 14 }, { 1e-30f, 1e30f } },
        [](auto& shader, const auto& x)
        { return shader.iblLayerFromProbe(x[0] * std::floor(x[1]), std::floor(x[1]), x[2]); });
    } },
  { "iblClampToProxy",
    [](Sweep& sweep)
    {
      for (const bool isBall : { false, true })
      {
        Over(sweep, { { -1e18f, 1e18f }, { -2, 2 }, { -2, 2 } },
          [=](auto& shader, const auto& x) { return shader.iblClampToProxy(Vec3Of(shader, x), isBall); });
      }
    } },
  { "iblExitOfCube", // along directions of any length
    [](Sweep& sweep)
    {
      Over(sweep, { Cosine, Cosine, Cosine, Cosine, Cosine, Cosine },
        [](auto& shader, const auto& x) { return shader.iblExitOfCube(Vec3Of(shader, x), Vec3Of(shader, x + 3)); });
    } },
  { "iblExitOfBall",
    [](Sweep& sweep)
    {
      Over(sweep, { { -0.57f, 0.57f }, { -0.57f, 0.57f }, { -0.57f, 0.57f }, Cosine, Cosine, Cosine },
        [](auto& shader, const auto& x) { return shader.iblExitOfBall(Vec3Of(shader, x), Direction(x + 3)); });
    } },
  { "iblInfluence",
    [](Sweep& sweep)
    {
      for (const bool isBall : { false, true })
      {
        Over(sweep, { { -2, 2 }, { -2, 2 }, { -2, 2 }, { 1, 10 } },
          [=](auto& shader, const auto& x) {
            return shader.iblInfluence(Vec3Of(shader, x), typename std::decay_t<decltype(shader)>::vec3(x[3]), isBall);
          });
      }
    } },
};
}

class Numbers : public ::testing::TestWithParam<Row>
{
};

// In single precision each function stays within its bound, is finite, and nothing that there cannot be. Bounds are not
// slack: a quarter of each is reached. Mutants, each seen to fail: D as 1 + cos^2 (alpha^2 - 1), the usual form; the
// sampler's sin^2 as 1 - cos^2; a frame with 1 / (1 + N.z) and no sign; the log of the ladder as log2(1024 r) - 10; a
// coefficient of the angle cut to three digits; more light scattered again than there is when A + B is above 1.
TEST_P(Numbers, StayWithinTheirBound)
{
  Sweep sweep(GetParam());
  const auto found = Sweeps.find(sweep.Bounds.Function);
  ASSERT_NE(found, Sweeps.end());
  found->second(sweep);
  std::printf("  %-34s %6.1f of %5.0f roundings, %s, at %s(%zu values)\n", sweep.Bounds.Function.c_str(), sweep.Error,
    sweep.Bounds.Bound, sweep.Bounds.IsRelative ? "relative" : "absolute", sweep.Where.c_str(), sweep.Count);
  EXPECT_GE(sweep.Count, 50000u);
  EXPECT_LE(sweep.Error, sweep.Bounds.Bound) << sweep.Where;
  EXPECT_LE(sweep.Bounds.Bound, std::max(4 * sweep.Error, 1.0)) << "the table promises too little";
  EXPECT_EQ(sweep.Outside, "");
}
INSTANTIATE_TEST_SUITE_P(Table, Numbers, ::testing::ValuesIn(ReadTable()),
  [](const ::testing::TestParamInfo<Row>& row) { return row.param.Function; });

// Where the mathematics rises or falls, so do floats, but for twice the function's bound. Mutants seen to fail: those
// of D and of the sampler above.
TEST(NumbersOrder, IsKept)
{
  std::map<std::string, Row> rows;
  for (const Row& row : ReadTable())
  {
    rows[row.Function] = row;
  }
  // f(t) for t from 0 to 1, on a grid that is dense at both ends; `rises` or falls.
  const auto check = [&rows](const std::string& name, bool rises, const std::function<float(float)>& f)
  {
    std::vector<float> grid = AwkwardNumbers(Share, 1000);
    for (int i = 0; i < 20000; ++i)
    {
      grid.push_back(RandomNumber(Share));
    }
    std::sort(grid.begin(), grid.end());
    const Row& row = rows.at(name);
    double before = f(grid.front());
    for (float t : grid)
    {
      const double value = f(t);
      const double slack = 2 * row.Bound * Eps * (row.IsRelative ? std::abs(value) : 1.0);
      ASSERT_GE(rises ? value - before : before - value, -slack) << name << " at " << t;
      before = rises ? std::max(before, value) : std::min(before, value);
    }
  };
  using glm::vec2;
  using glm::vec3;
  check("iblAngle", true, [](float t) { return Single.iblAngle(t, 1 - t); });
  check("iblCubeLodOffset", true, [](float t) { return Single.iblCubeLodOffset(glm::normalize(vec3(1, t, t))); });
  check("iblAlpha", true, [](float t) { return Single.iblAlpha(t); });
  check("iblDiffuseFresnel", false, [](float t) { return Single.iblDiffuseFresnel(t); });
  check("iblHorizonFade", true, [](float t) { return Single.iblHorizonFade(2 * t - 1); });
  check("iblLadderPosition", true, [](float t) { return Single.iblLadderPosition(t); });
  check(
    "iblPerceptualRoughnessFromPosition", true, [](float t) { return Single.iblPerceptualRoughnessFromPosition(t); });
  check("iblFilteredLod", false, [](float t) { return Single.iblFilteredLod(t + 1e-20f, 64, 512); });
  for (float layers : { 2.0f, 7.0f, 14.0f })
  {
    check("iblLayerFromPerceptualRoughness", true,
      [=](float t) { return Single.iblLayerFromPerceptualRoughness(t, layers); });
    check("iblPerceptualRoughnessFromLayer", true,
      [=](float t) { return Single.iblPerceptualRoughnessFromLayer(t * layers, layers); });
    check("iblLayerFromPosition", true, [=](float t) { return Single.iblLayerFromPosition(t, layers); });
  }
  for (float a : { 1e-6f, 0.01f, 0.3f, 1.0f })
  {
    check("iblHalfVectorGGX", true, [=](float t) { return Single.iblHalfVectorGGX(t, a).y; });
    check("iblD_GGX", false,
      [=](float t)
      {
        const vec2 h = Single.iblHalfVectorGGX(t, a);
        return Single.iblD_GGX(h.x, h.y, a);
      });
    check("iblV_SchlickSmith", false, [=](float t) { return Single.iblV_SchlickSmith(0.3f, t, a); });
    check("iblV_SmithGGXCorrelated", false, [=](float t) { return Single.iblV_SmithGGXCorrelated(0.3f, t, a); });
    check("iblF_Schlick", false, [=](float t) { return Single.iblF_Schlick(vec3(a), vec3(1), t).x; });
    check("iblSpecularOcclusion", true, [=](float t) { return Single.iblSpecularOcclusion(0.3f, t, a); });
    check("iblNarrowAlpha", true, [=](float t) { return Single.iblNarrowAlpha(vec2(t, a)); });
    check("iblDielectricShare", false, [=](float t) { return Single.iblDielectricShare(t, 1, vec2(a, 1 - a)); });
    check(
      "iblSingleScatter", true, [=](float t) { return Single.iblSingleScatter(vec3(t), vec3(1), vec2(a, 1 - a)).x; });
    check("iblMultipleScatter", true,
      [=](float t) { return Single.iblMultipleScatter(vec3(t), vec3(1), vec3(t), vec2(0.5f, 0.3f)).x; });
  }
}

// The last of a cap's points, where two directions cancel and no digits are left, are half vectors still. Mutant: the
// least z of 1e-9 left out (NaN).
TEST(NumbersEdge, VisibleHalfVectorsAreAboveTheSurface)
{
  for (float u : { 0.99f, 0.999999f, 1 - 1.0f / (1 << 24), 1.0f })
  {
    for (float turn : AwkwardNumbers(Share, 64))
    {
      for (float cosine : AwkwardNumbers(NoV, 64))
      {
        for (float a : AwkwardNumbers(Alpha, 64))
        {
          const glm::vec3 V = TangentDirection(cosine, 0.0f);
          const glm::vec3 H = Single.iblVisibleHalfVectorGGX(
            glm::vec2(turn, u), V, glm::vec2(a), Single.iblVisibleBound(V, glm::vec2(a)).x);
          ASSERT_NEAR(glm::length(glm::dvec3(H)), 1, 8 * Eps) << u << " " << turn << " " << cosine << " " << a;
          ASSERT_GE(H.z, 0) << u << " " << turn << " " << cosine << " " << a;
        }
      }
    }
  }
}

// Every function of shaders/*Functions.glsl has its row. Mutants: a row left out; a function added.
TEST(NumbersTable, IsWhole)
{
  std::set<std::string> functions, rows;
  const std::regex pattern(R"(^(?:float|vec2|vec3|vec4|mat3|uint) (ibl\w+)\()");
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(VTKIBL_SOURCE) / "shaders"))
  {
    if (entry.path().string().find("Functions.glsl") != std::string::npos)
    {
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);)
      {
        std::smatch match;
        if (std::regex_search(line, match, pattern))
        {
          functions.insert(match[1]);
        }
      }
    }
  }
  for (const Row& row : ReadTable())
  {
    rows.insert(row.Function);
  }
  EXPECT_GT(functions.size(), 30u);
  EXPECT_EQ(rows, functions);
}
