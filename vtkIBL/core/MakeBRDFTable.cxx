// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Runs while the library is built: MakeBRDFTable FILE.cxx writes the constant that vtkIBLBRDFTableTexels.h declares.
#include "vtkIBLBRDFTableTexels.h"
#include "vtkIBLShaderFunctions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>

namespace
{
using Functions = vtkIBLCore::ShaderFunctions<double>;
using Channels = std::array<double, vtkIBLBRDFTableChannels>;
Functions shader;

// Integral of f over [begin, end], in panels of Gauss-Legendre's eight points.
template <typename Function>
void AddGauss(double begin, double end, int panels, Function f)
{
  static const double nodes[4] = { 0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363 };
  static const double weights[4] = { 0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763 };
  const double half = 0.5 * (end - begin) / panels;
  for (int panel = 0; panel < panels; ++panel)
  {
    for (int i = 0; i < 4; ++i)
    {
      for (double node : { -nodes[i], nodes[i] })
      {
        f(begin + half * (2 * panel + 1 + node), half * weights[i]);
      }
    }
  }
}

// Reflection integral of f NoL over half vectors at angle theta to the normal and phi to the view direction:
//   4 V F VoH NoL / NoH  times  D NoH dw = tau/(1 + tau)^2 dx dphi/(2 pi),  tan(theta) = alpha sqrt(tau),  tau = e^x.
// L is above the horizon for every phi while theta < (pi/2 - thetaV)/2, for |phi| < phiEnd up to (pi/2 + thetaV)/2, and
// then for none. phiEnd starts and ends like a square root, so x is spaced by a cosine between these two; and V has a
// boundary layer as thin as NoV where L sets, so phi is spaced by a sine. At NoV = 0 all of it has a limit: V NoL =
// 1/(2 alpha), and A + B = 1.
Channels IntegrateRough(double NoV, double alpha)
{
  const double sinV = std::sqrt((1.0 - NoV) * (1.0 + NoV));
  Channels sum = {};
  auto addRing = [&](double x, double dx)
  {
    const double tau = std::exp(x);
    const double tangent = alpha * std::sqrt(tau);
    const double NoH = 1.0 / std::sqrt(1.0 + tangent * tangent);
    const double product = sinV * tangent * NoH;
    // NoL = 2 VoH NoH - NoV = 0 at the last phi.
    const double needed = NoV * (0.5 / NoH - NoH);
    const double phiEnd = product > 0.0 ? std::acos(std::clamp(needed / product, -1.0, 1.0)) : shader.iblPi;
    AddGauss(0.0, 0.5 * shader.iblPi, 2,
      [&](double turn, double dturn)
      {
        const double phi = phiEnd * std::sin(turn);
        const double VoH = NoV * NoH + product * std::cos(phi);
        const double NoL = 2.0 * VoH * NoH - NoV;
        if (NoL > 0.0)
        {
          const double density =
            tau / ((1.0 + tau) * (1.0 + tau)) * dx * phiEnd * std::cos(turn) * dturn / shader.iblPi;
          const double weight = density * 4.0 * shader.iblV_SmithGGXCorrelated(NoV, NoL, alpha) * VoH * NoL / NoH;
          const double fresnel = shader.iblF_Schlick(Functions::vec3(0.0), Functions::vec3(1.0), VoH).x;
          sum[0] += weight * (1.0 - fresnel);
          sum[1] += weight * fresnel;
        }
      });
  };
  // Beyond these, e^x and e^(-x/2) leave nothing of the density.
  constexpr double first = -30.0;
  constexpr double last = 60.0;
  // tan((pi/2 -+ thetaV)/2) = NoV / (1 + sinV) and its inverse.
  const double tangent = std::max(NoV, 1e-300) / (1.0 + sinV);
  const double sets = std::clamp(2.0 * std::log(tangent / alpha), first, last);
  const double gone = std::clamp(-2.0 * std::log(tangent * alpha), first, last);
  AddGauss(first, sets, 24, addRing);
  AddGauss(0.0, shader.iblPi, 32,
    [&](double angle, double dangle)
    {
      const double half = 0.5 * (gone - sets);
      addRing(sets + half * (1.0 - std::cos(angle)), half * std::sin(angle) * dangle);
    });
  return sum;
}

Channels Integrate(double NoV, double perceptualRoughness)
{
  if (perceptualRoughness == 0.0)
  {
    const double fresnel = shader.iblF_Schlick(Functions::vec3(0.0), Functions::vec3(1.0), NoV).x;
    return { 1.0 - fresnel, fresnel };
  }
  return IntegrateRough(NoV, shader.iblAlpha(perceptualRoughness));
}
}

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::cerr << "usage: MakeBRDFTable FILE.cxx\n";
    return 2;
  }
  std::ofstream file(argv[1]);
  file << "// Made by MakeBRDFTable.cxx; do not edit.\n#include \"vtkIBLBRDFTableTexels.h\"\n\n"
       << "const std::uint16_t vtkIBLBRDFTableTexels[] = {\n";
  for (int j = 0; j < vtkIBLBRDFTableSize; ++j)
  {
    for (int i = 0; i < vtkIBLBRDFTableSize; ++i)
    {
      const Functions::vec2 at = shader.iblBRDFTableArguments(i, j, vtkIBLBRDFTableSize);
      for (double x : Integrate(at.x, at.y))
      {
        file << std::lround(65535.0 * x) << ',';
      }
    }
    file << '\n';
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
