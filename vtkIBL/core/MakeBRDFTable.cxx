// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Runs while the library is built: MakeBRDFTable FILE.cxx writes the constant that vtkIBLBRDFTableTexels.h declares.
#include "vtkIBLBRDFTableTexels.h"
#include "vtkIBLLobeFit.h"
#include "vtkIBLReflectionQuadrature.h"

#include <array>
#include <atomic>
#include <fstream>
#include <functional>
#include <iostream>
#include <thread>

namespace
{
using Functions = vtkIBLCore::ShaderFunctions<double>;
using Texel = std::array<double, vtkIBLBRDFTableBlocks * vtkIBLBRDFTableChannels>; // of one block, then the other
constexpr int FirstFitted = 2;                                                     // A and B are integrated
constexpr int Size = vtkIBLBRDFTableSize;
Functions shader;

double SchlickWeight(double VoH)
{
  return shader.iblF_Schlick(Functions::vec3(0.0), Functions::vec3(1.0), VoH).x;
}

Texel Integrate(double NoV, double perceptualRoughness)
{
  if (perceptualRoughness == 0.0)
  {
    return { 1.0 - SchlickWeight(NoV), SchlickWeight(NoV) };
  }
  Texel sum = {};
  vtkIBLCore::ForEachReflection(NoV, shader.iblAlpha(perceptualRoughness), 4,
    [&](const Functions::vec3&, double VoH, double weight)
    {
      sum[0] += weight * (1.0 - SchlickWeight(VoH));
      sum[1] += weight * SchlickWeight(VoH);
    });
  return sum;
}

// Of texels 0, 2, 4 ... and the last of each row and column; the others lie between them.
void FitLobes(const vtkIBLLobeFitter& fitter, int i, int j, Texel& texel)
{
  const Functions::vec2 at = shader.iblBRDFTableArguments(i, j, Size);
  for (int set = 0; set < 2; ++set)
  {
    const vtkIBLFittedLobe lobe = fitter.Fit(at.x, at.y, set == 0 ? 1.0 : IBL_DIELECTRIC_F0);
    texel[4 + 2 * set] = lobe.Bend;
    texel[5 + 2 * set] = shader.iblLadderPosition(lobe.PerceptualRoughness);
    texel[2 + set] = lobe.DiffuseShare;
  }
}

bool IsFitted(int i)
{
  return i % 2 == 0 || i == Size - 1;
}

void ForEachRow(const std::function<void(int)>& body)
{
  std::atomic<int> next{ 0 };
  auto work = [&]
  {
    for (int j; (j = next++) < Size;)
    {
      body(j);
    }
  };
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i)
  {
    threads.emplace_back(work);
  }
  work();
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}
}

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::cerr << "usage: MakeBRDFTable FILE.cxx\n";
    return 2;
  }
  std::vector<Texel> table(Size * Size);
  const vtkIBLLobeFitter fitter;
  ForEachRow(
    [&](int j)
    {
      for (int i = 0; i < Size; ++i)
      {
        const Functions::vec2 at = shader.iblBRDFTableArguments(i, j, Size);
        table[j * Size + i] = Integrate(at.x, at.y);
        if (IsFitted(i) && IsFitted(j))
        {
          FitLobes(fitter, i, j, table[j * Size + i]);
        }
      }
    });
  auto setBetween = [&](int texel, int before, int after)
  {
    for (std::size_t c = FirstFitted; c < table[texel].size(); ++c)
    {
      table[texel][c] = 0.5 * (table[before][c] + table[after][c]);
    }
  };
  for (int texel = 0; texel < Size * Size; ++texel)
  {
    if (!IsFitted(texel % Size) && IsFitted(texel / Size))
    {
      setBetween(texel, texel - 1, texel + 1);
    }
  }
  for (int texel = 0; texel < Size * Size; ++texel)
  {
    if (!IsFitted(texel / Size))
    {
      setBetween(texel, texel - Size, texel + Size);
    }
  }

  std::ofstream file(argv[1]);
  file << "// Made by MakeBRDFTable.cxx; do not edit.\n#include \"vtkIBLBRDFTableTexels.h\"\n\n"
       << "const std::uint16_t vtkIBLBRDFTableTexels[] = {\n";
  for (int block = 0; block < vtkIBLBRDFTableBlocks; ++block)
  {
    for (const Texel& texel : table)
    {
      for (int c = 0; c < vtkIBLBRDFTableChannels; ++c)
      {
        file << std::lround(65535.0 * texel[block * vtkIBLBRDFTableChannels + c]) << ',';
      }
      file << '\n';
    }
  }
  file << "};\n";
  file.close();
  if (!file)
  {
    std::cerr << "MakeBRDFTable: cannot write '" << argv[1] << "'; give a path in a directory that can be written.\n";
    return 1;
  }
  return 0;
}
