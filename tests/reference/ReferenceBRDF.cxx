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

double SchlickWeight(double VoH)
{
  const double x = 1 - std::min(VoH, 1.0);
  return x * x * x * x * x; // with std::pow an integral takes a third longer
}

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

Facets::Facets(Vec3 normal, Vec3 tangent, double alphaT, double alphaB)
  : N(normal)
  , T(Normalize(tangent - Dot(normal, tangent) * normal))
  , B(Cross(N, T))
  , AlphaT(alphaT)
  , AlphaB(alphaB)
{
}

// Heitz 2014, as above, on anisotropy: the slopes along T and B are those of a surface of alpha = 1 times AlphaT and
// AlphaB. Facet normals of that one are (T.h / AlphaT, B.h / AlphaB, N.h), and what sees V here sees
// (AlphaT T.V, AlphaB B.V, N.V) there.
double Facets::Q(Vec3 H) const
{
  const double t = Dot(this->T, H) / this->AlphaT, b = Dot(this->B, H) / this->AlphaB, n = Dot(this->N, H);
  return t * t + b * b + n * n;
}

double Facets::D(Vec3 H) const
{
  const double q = this->Q(H);
  return 1 / (Pi * this->AlphaT * this->AlphaB * q * q);
}

double Facets::Visibility(Vec3 L, Vec3 V) const
{
  const auto root = [this](Vec3 d) {
    const double t = this->AlphaT * Dot(this->T, d), b = this->AlphaB * Dot(this->B, d), n = Dot(this->N, d);
    return std::sqrt(t * t + b * b + n * n); // (1 + 2 Lambda) N.d
  };
  return 0.5 / (Dot(this->N, L) * root(V) + Dot(this->N, V) * root(L));
}

SplitSum AnisotropicSplitSumAB(Vec3 V, double alphaT, double alphaB, double refinement)
{
  // As SplitSumAB, with the slopes u = sqrt(tau) e, e = (alphaT cos(phi), alphaB sin(phi)), of the density
  // D NoH dw_h = dtau/(1+tau)^2 dphi/(2 pi). L = 2 VoH H - V lies above the horizon where |u - c| < 1/NoV with
  // c = Vt/NoV, the slope that V has: a disc around which tau ends at the root of |e|^2 tau - 2 e.c sqrt(tau) = 1.
  // Both rules have no kink then, and that of phi is periodic.
  const Facets facets({ 0, 0, 1 }, { 1, 0, 0 }, alphaT, alphaB);
  const int steps = static_cast<int>(1200 * refinement), turns = static_cast<int>(600 * refinement);
  SplitSum sum{ 0, 0 };
  for (int j = 0; j < turns; ++j)
  {
    const double phi = 2 * Pi * (j + 0.5) / turns, et = alphaT * std::cos(phi), eb = alphaB * std::sin(phi);
    const double square = et * et + eb * eb, along = (et * V.x + eb * V.y) / V.z;
    // the root without a difference of nearly equal numbers
    const double reach = std::sqrt(along * along + square);
    const double last = along > 0 ? (along + reach) / square : 1 / (reach - along);
    const double begin = -18, end = std::min(18.0, 2 * std::log(last)); // as SplitSumAB
    for (int i = 0; i < steps && begin < end; ++i)
    {
      const double tau = std::exp(begin + (end - begin) * (i + 0.5) / steps), t = std::sqrt(tau);
      const double density = tau / ((1 + tau) * (1 + tau)) * (end - begin) / steps / turns;
      const Vec3 H = Normalize({ t * et, t * eb, 1 });
      const double VoH = Dot(V, H);
      const Vec3 L = 2 * VoH * H - V;
      const double weight = density * 4 * facets.Visibility(L, V) * VoH * std::max(0.0, L.z) / H.z;
      const double fresnel = SchlickWeight(VoH);
      sum.A += weight * (1 - fresnel);
      sum.B += weight * fresnel;
    }
  }
  return sum;
}
}
