// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause

#include "Reference.h"

#include <algorithm>

namespace vtkIBLReference
{
double D_GGX(double sinSquaredNH, double alpha)
{
  // Walter et al. 2007, "Microfacet models for refraction through rough surfaces", eq. 33:
  // D = a^2 / (pi cos^4 (a^2 + tan^2)^2) = a^2 / (pi (a^2 cos^2 + sin^2)^2)
  const double q = alpha * alpha * (1 - sinSquaredNH) + sinSquaredNH;
  return alpha * alpha / (Pi * q * q);
}

double V_SmithGGXCorrelated(double NoL, double NoV, double alpha)
{
  // Heitz 2014, "Understanding the masking-shadowing function", eq. 99: G2 = 1 / (1 + Lambda_V + Lambda_L),
  // with 1 + 2 Lambda(x) = sqrt(1 + a^2 (1 - x^2)/x^2) = root(x)/x, hence
  // G2 / (4 NoL NoV) = 1 / (2 (NoL root(NoV) + NoV root(NoL)))
  const auto root = [alpha](double x) { return std::sqrt(x * x + alpha * alpha * (1 - x * x)); };
  return 0.5 / (NoL * root(NoV) + NoV * root(NoL));
}

double SchlickWeight(double VoH) { return std::pow(1 - std::min(VoH, 1.0), 5); }

SplitSum SplitSumAB(double NoV, double perceptualRoughness, Geometry geometry, double refinement)
{
  // Over half vectors, dw_l = 4 VoH dw_h:   integral of f NoL dw_l = integral of D V F 4 VoH NoL dw_h.
  // With tan^2(theta_h) = alpha^2 tau the density D NoH dw_h is dtau/(1+tau)^2 dphi/(2 pi), so that
  //   = integral of [4 V F VoH NoL / NoH] tau/(1+tau)^2 dx dphi/(2 pi),   tau = e^x.
  // Even steps of x resolve the peak at every alpha; |x| > 18 holds 3e-8 of the density. Midpoint rule in x up
  // to the last theta_h = (pi/2 + theta_v)/2 that sends any L above the horizon, and in phi up to the horizon.
  const double alpha = perceptualRoughness * perceptualRoughness;
  const double sinV = std::sqrt((1 - NoV) * (1 + NoV));
  const double begin = -18, end = std::min(18.0, 2 * std::log((1 + sinV) / (NoV * alpha)));
  const int steps = static_cast<int>(2400 * refinement), turns = static_cast<int>(200 * refinement);
  const auto visibility = [&](double NoL) {
    if (geometry == Geometry::SmithCorrelated)
    {
      return V_SmithGGXCorrelated(NoL, NoV, alpha);
    }
    const double k = alpha / 2; // G1(L) G1(V) / (4 NoL NoV)
    return 0.25 / ((NoL * (1 - k) + k) * (NoV * (1 - k) + k));
  };

  SplitSum sum{ 0, 0 };
  for (int i = 0; i < steps; ++i)
  {
    const double tau = std::exp(begin + (end - begin) * (i + 0.5) / steps);
    const double density = tau / ((1 + tau) * (1 + tau)) * (end - begin) / steps;
    const double tanH = alpha * std::sqrt(tau);
    const double NoH = 1 / std::sqrt(1 + tanH * tanH), sinH = tanH * NoH;
    // NoL = 2 VoH NoH - NoV > 0 with VoH = NoV NoH + sinV sinH cos(phi); symmetric in phi
    const double product = sinV * sinH;
    const double needed = NoV / (2 * NoH) - NoV * NoH; // <= product cos(phi)
    const double phiEnd = needed <= -product ? Pi : needed >= product ? 0 : std::acos(needed / product);
    for (int j = 0; j < turns; ++j)
    {
      const double VoH = NoV * NoH + product * std::cos(phiEnd * (j + 0.5) / turns);
      const double NoL = std::max(0.0, 2 * VoH * NoH - NoV);
      const double weight = density * (phiEnd / (Pi * turns)) * 4 * visibility(NoL) * VoH * NoL / NoH;
      const double fresnel = SchlickWeight(VoH);
      sum.A += weight * (1 - fresnel);
      sum.B += weight * fresnel;
    }
  }
  return sum;
}

double DirectionalAlbedo(double NoV, double perceptualRoughness, Geometry geometry)
{
  const SplitSum sum = SplitSumAB(NoV, perceptualRoughness, geometry);
  return sum.A + sum.B;
}
}
