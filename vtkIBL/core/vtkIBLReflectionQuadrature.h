// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Integrals over the light that a surface reflects towards one direction, for tables made while the library is built.
#pragma once

#include "vtkIBLShaderFunctions.h"

#include <algorithm>
#include <cmath>

namespace vtkIBLCore
{
// Calls f(x, dx) over [begin, end], in panels of Gauss-Legendre's eight points.
template <typename Function>
void ForEachGaussPoint(double begin, double end, int panels, Function f)
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

// Calls f(L, VoH, weight) so that sums of weight are integrals of D V NoL dL, height-correlated Smith, F left to f;
// N = +z, V = (sinV, 0, NoV), and L.y >= 0 only, whose mirror images are counted in. `fineness` 4 leaves 1e-6.
//
// Over half vectors at angle theta to the normal and phi to the view direction it is the integral of
//   4 V VoH NoL / NoH  times  D NoH dw = tau/(1 + tau)^2 dx dphi/(2 pi),  tan(theta) = alpha sqrt(tau),  tau = e^x.
// L is above the horizon for every phi while theta < (pi/2 - thetaV)/2, for |phi| < phiEnd up to (pi/2 + thetaV)/2, and
// then for none. phiEnd starts and ends like a square root, so x is spaced by a cosine between these two; and V has a
// boundary layer as thin as NoV where L sets, so phi is spaced by a sine. At NoV = 0 all of it has a limit: V NoL =
// 1/(2 alpha), and the weights add up to 1.
template <typename Function>
void ForEachReflection(double NoV, double alpha, int fineness, Function f)
{
  using Functions = ShaderFunctions<double>;
  Functions shader;
  const double sinV = std::sqrt((1.0 - NoV) * (1.0 + NoV));
  auto addRing = [&](double x, double dx)
  {
    const double tau = std::exp(x);
    const double tangent = alpha * std::sqrt(tau);
    const double NoH = 1.0 / std::sqrt(1.0 + tangent * tangent);
    const double sinH = tangent * NoH;
    const double product = sinV * sinH;
    // NoL = 2 VoH NoH - NoV = 0 at the last phi.
    const double needed = NoV * (0.5 / NoH - NoH);
    const double phiEnd = product > 0.0 ? std::acos(std::clamp(needed / product, -1.0, 1.0)) : shader.iblPi;
    ForEachGaussPoint(0.0, 0.5 * shader.iblPi, 2,
      [&](double turn, double dturn)
      {
        const double phi = phiEnd * std::sin(turn);
        const double VoH = NoV * NoH + product * std::cos(phi);
        const double NoL = 2.0 * VoH * NoH - NoV;
        if (NoL > 0.0)
        {
          const double density =
            tau / ((1.0 + tau) * (1.0 + tau)) * dx * phiEnd * std::cos(turn) * dturn / shader.iblPi;
          const Functions::vec3 L(2.0 * VoH * sinH * std::cos(phi) - sinV, 2.0 * VoH * sinH * std::sin(phi), NoL);
          f(L, VoH, density * 4.0 * shader.iblV_SmithGGXCorrelated(NoV, NoL, alpha) * VoH * NoL / NoH);
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
  ForEachGaussPoint(first, sets, 6 * fineness, addRing);
  ForEachGaussPoint(0.0, shader.iblPi, 8 * fineness,
    [&](double angle, double dangle)
    {
      const double half = 0.5 * (gone - sets);
      addRing(sets + half * (1.0 - std::cos(angle)), half * std::sin(angle) * dangle);
    });
}
}
