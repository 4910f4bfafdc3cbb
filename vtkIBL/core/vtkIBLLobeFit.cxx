// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLLobeFit.h"

#include "vtkIBLReflectionQuadrature.h"

namespace
{
using vtkIBLCore::ForEachGaussPoint;
using Spectrum = vtkIBLLobeFitter::Spectrum;
constexpr int Order = vtkIBLLobeFitter::Order;
constexpr double Pi = 3.14159265358979323846;
constexpr double FirstRoughness =
  0.1;                           // below, layers are mixed with the mirror, and the lobe is a mirror to the order kept
constexpr int KernelCount = 201; // steps of 1.5 % of roughness
constexpr double SharpestKernel = 0.05; // perceptualRoughness

double GetRoughness(double kernel)
{
  return std::pow(SharpestKernel, 1.0 - kernel / (KernelCount - 1));
}

Spectrum GetLegendre(double t)
{
  Spectrum p;
  p[0] = 1.0;
  p[1] = t;
  for (int l = 2; l <= Order; ++l)
  {
    p[l] = ((2 * l - 1) * t * p[l - 1] - (l - 1) * p[l - 2]) / l;
  }
  return p;
}

// The kernel of N = V = R is t / (c - t)^2 over t > 0 (docs/derivations/spectral-filter.md), c = (1 + alpha^2)/(1 -
// alpha^2). With 1 - t = (c - 1)(e^x - 1) its peak is as wide as any other part.
Spectrum MakeKernel(double perceptualRoughness)
{
  const double alpha2 = std::pow(perceptualRoughness, 4.0);
  const double width = 2.0 * alpha2 / (1.0 - alpha2);
  Spectrum spectrum = {};
  auto add = [&](double t, double weight)
  {
    const Spectrum p = GetLegendre(t);
    for (int l = 0; l <= Order; ++l)
    {
      spectrum[l] += weight * p[l];
    }
  };
  if (width > 1e3) // the cosine
  {
    ForEachGaussPoint(0.0, 1.0, 20, [&](double t, double dt) { add(t, t * dt); });
  }
  else
  {
    ForEachGaussPoint(0.0, std::log1p(1.0 / width), 20,
      [&](double x, double dx)
      {
        const double t = 1.0 - width * std::expm1(x);
        add(t, t * std::exp(-x) * dx); // dt / (c - t)^2, but for a factor
      });
  }
  for (int l = Order; l >= 0; --l)
  {
    spectrum[l] /= spectrum[0];
  }
  return spectrum;
}

// Where f, smooth and with one minimum there, has it in [low, high]: golden section.
template <typename Function>
double FindMinimum(double low, double high, int steps, Function f)
{
  constexpr double Golden = 0.61803398874989485;
  double a = high - Golden * (high - low);
  double b = low + Golden * (high - low);
  double fa = f(a);
  double fb = f(b);
  for (int i = 0; i < steps; ++i)
  {
    if (fa < fb)
    {
      high = b;
      b = a;
      fb = fa;
      a = high - Golden * (high - low);
      fa = f(a);
    }
    else
    {
      low = a;
      a = b;
      fa = fb;
      b = low + Golden * (high - low);
      fb = f(b);
    }
  }
  return fa < fb ? a : b;
}

// The best of `count` even steps of [0, end], and then the minimum between its neighbours.
template <typename Function>
double FindMinimumOfMany(double end, int count, int steps, Function f)
{
  int best = 0;
  double least = f(0.0);
  for (int i = 1; i <= count; ++i)
  {
    const double value = f(end * i / count);
    if (value < least)
    {
      least = value;
      best = i;
    }
  }
  const double found =
    FindMinimum(end * std::max(best - 1, 0) / count, end * std::min(best + 1, count) / count, steps, f);
  return f(found) < least ? found : end * best / count;
}
}

struct vtkIBLLobeFitter::Reflections
{
  std::vector<double> X, Z, Weight; // of L; R has positive X
  double Sum = 0.0;
};

struct vtkIBLLobeFitter::Candidate
{
  double Angle; // from N towards R [rad]
  double Kernel;
  double DiffuseShare;
  double Error;
};

vtkIBLLobeFitter::vtkIBLLobeFitter()
{
  for (int i = 0; i < KernelCount; ++i)
  {
    this->Kernels.push_back(MakeKernel(GetRoughness(i)));
  }
  // Power of natural light falls with 1/l^2 (Dror, Willsky & Adelson 2004); 2 l + 1 is Parseval's.
  this->Weights[0] = 0.0;
  for (int l = 1; l <= Order; ++l)
  {
    this->Weights[l] = (2.0 * l + 1.0) / (l * (l + 1.0));
  }
}

vtkIBLLobeFitter::Reflections vtkIBLLobeFitter::GetReflections(double NoV, double perceptualRoughness, double f0)
{
  Reflections all;
  vtkIBLCore::ForEachReflection(NoV, perceptualRoughness * perceptualRoughness, 1,
    [&](const glm::dvec3& L, double VoH, double weight)
    {
      weight *= f0 + (1.0 - f0) * std::pow(1.0 - VoH, 5.0);
      all.X.push_back(-L.x);
      all.Z.push_back(L.z);
      all.Weight.push_back(weight);
      all.Sum += weight;
    });
  return all;
}

// Mean of P_l(cos) over the lobe, around the axis at that angle.
Spectrum vtkIBLLobeFitter::GetSpectrum(const Reflections& all, double angle)
{
  const std::size_t count = all.Weight.size();
  std::vector<double> t(count);
  std::vector<double> previous(count, 1.0);
  std::vector<double> p(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    t[i] = p[i] = std::sin(angle) * all.X[i] + std::cos(angle) * all.Z[i];
  }
  Spectrum spectrum;
  spectrum[0] = 1.0;
  for (int l = 1; l <= Order; ++l)
  {
    double sum = 0.0;
    const double a = (2.0 * l + 1.0) / (l + 1.0);
    const double b = l / (l + 1.0);
    for (std::size_t i = 0; i < count; ++i)
    {
      sum += all.Weight[i] * p[i];
      const double next = a * t[i] * p[i] - b * previous[i];
      previous[i] = p[i];
      p[i] = next;
    }
    spectrum[l] = sum / all.Sum;
  }
  return spectrum;
}

Spectrum vtkIBLLobeFitter::GetKernel(double kernel) const
{
  const int below = std::min(int(kernel), KernelCount - 2);
  Spectrum spectrum;
  for (int l = 0; l <= Order; ++l)
  {
    spectrum[l] = this->Kernels[below][l] + (kernel - below) * (this->Kernels[below + 1][l] - this->Kernels[below][l]);
  }
  return spectrum;
}

// |f - (1 - s) K - s C|^2 - |f|^2, f the lobe, K the layer's kernel around the angle, C the cosine around N; and the
// share s that makes it least.
vtkIBLLobeFitter::Candidate vtkIBLLobeFitter::Judge(
  const Spectrum& atAngle, const Spectrum& atNormal, double angle, double kernel) const
{
  const Spectrum k = this->GetKernel(kernel);
  const Spectrum& c = this->Kernels.back();
  const Spectrum p = GetLegendre(std::cos(angle));
  double kk = 0.0, kf = 0.0, kc = 0.0, cf = 0.0, cc = 0.0;
  for (int l = 1; l <= Order; ++l)
  {
    kk += this->Weights[l] * k[l] * k[l];
    kf += this->Weights[l] * k[l] * atAngle[l];
    kc += this->Weights[l] * k[l] * c[l] * p[l];
    cf += this->Weights[l] * c[l] * atNormal[l];
    cc += this->Weights[l] * c[l] * c[l];
  }
  const double difference = kk - 2.0 * kc + cc;
  const double gain = cf - kf - kc + kk;
  const double share = difference > 1e-12 ? std::clamp(gain / difference, 0.0, 1.0) : 0.0;
  return { angle, kernel, share, kk - 2.0 * kf - 2.0 * share * gain + share * share * difference };
}

vtkIBLLobeFitter::Candidate vtkIBLLobeFitter::FindKernel(
  const Spectrum& atAngle, const Spectrum& atNormal, double angle) const
{
  return this->Judge(atAngle, atNormal, angle,
    FindMinimumOfMany(
      KernelCount - 1, 20, 12, [&](double kernel) { return this->Judge(atAngle, atNormal, angle, kernel).Error; }));
}

vtkIBLFittedLobe vtkIBLLobeFitter::Fit(double NoV, double perceptualRoughness, double f0) const
{
  const double roughness = std::max(perceptualRoughness, FirstRoughness);
  const double reflected = std::acos(std::min(NoV, 0.9999)); // at N = V all angles are one
  const Reflections all = GetReflections(std::cos(reflected), roughness, f0);
  const Spectrum atNormal = GetSpectrum(all, 0.0);
  auto find = [&](double angle) { return this->FindKernel(GetSpectrum(all, angle), atNormal, angle); };
  const Candidate best = find(FindMinimumOfMany(reflected, 12, 12, [&](double angle) { return find(angle).Error; }));
  const double bend = std::sin(best.Angle) / (std::sin(reflected - best.Angle) + std::sin(best.Angle));
  const double fitted = std::clamp(GetRoughness(best.Kernel), FirstRoughness, roughness);
  const double scale = perceptualRoughness / roughness;
  return { 1.0 - (1.0 - bend) * scale, fitted * scale, best.DiffuseShare * scale };
}
