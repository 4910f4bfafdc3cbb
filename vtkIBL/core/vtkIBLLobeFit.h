// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Which prefiltered lobe stands best for what a surface reflects: docs/derivations/fitted-lobes.md.
#pragma once

#include <array>
#include <vector>

/// A surface's lobe as  (1 - DiffuseShare) x layer of PerceptualRoughness around the direction (1 - Bend) N + Bend R
///                      + DiffuseShare x irradiance over pi.   All in [0, 1].
struct vtkIBLFittedLobe
{
  double Bend, PerceptualRoughness, DiffuseShare;
};

class vtkIBLLobeFitter
{
public:
  vtkIBLLobeFitter();

  /// NoV in [0, 1], perceptualRoughness in [0, 1]; below 0.1 the lobe of 0.1 is scaled, down to the mirror.
  /// Thread-safe.
  vtkIBLFittedLobe Fit(double NoV, double perceptualRoughness, double f0) const;

  /// Legendre coefficients b_0 .. b_Order of lobes around an axis, b_0 = 1.
  static constexpr int Order = 64;
  using Spectrum = std::array<double, Order + 1>;

private:
  struct Reflections;
  struct Candidate;
  static Reflections GetReflections(double NoV, double perceptualRoughness, double f0);
  static Spectrum GetSpectrum(const Reflections& reflections, double angle);
  Candidate Judge(const Spectrum& atAngle, const Spectrum& atNormal, double angle, double kernel) const;
  Candidate FindKernel(const Spectrum& atAngle, const Spectrum& atNormal, double angle) const;
  Spectrum GetKernel(double kernel) const;

  std::vector<Spectrum> Kernels; // of layers, from the sharpest to roughness 1
  Spectrum Weights;
};
