// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Light as a few spherical harmonics, for whoever has no cube map to read: projected, turned, evaluated as irradiance,
// packed for a shader. Real and orthonormal, index l (l + 1) + m, no Condon-Shortley sign, z the polar axis of the
// formulas: Y_1 = sqrt(3 / 4 pi) (y, z, x). Derivations: docs/derivations/harmonics.md.
#pragma once

#include "vtkIBLParallelFor.h"
#include "vtkIBLRadianceImage.h"
#include "vtkIBLSpectrum.h"

#include <glm/glm.hpp>

#include <array>
#include <cassert>
#include <vector>

/// Coefficients of radiance [radiance x sr]: no cosine, no 1/pi inside.
struct vtkIBLHarmonics
{
  static constexpr int MaximumOrder = 8;
  static constexpr int MaximumCount = (MaximumOrder + 1) * (MaximumOrder + 1);

  /// Zeros to band `order`, in [0, MaximumOrder].
  explicit vtkIBLHarmonics(int order = 0)
    : Order(order)
    , RGB((order + 1) * (order + 1), glm::dvec3(0.0))
  {
    assert(order >= 0 && order <= MaximumOrder);
  }
  int Order;
  std::vector<glm::dvec3> RGB;
};

/// Y_lm of a unit direction, in the first (order + 1)^2 entries.
std::array<double, vtkIBLHarmonics::MaximumCount> vtkIBLHarmonicBasis(int order, const glm::dvec3& direction);

/// The harmonics of a lat-long image, without its bright texels. `order` is at most the spectrum's.
vtkIBLHarmonics vtkIBLMakeHarmonics(const vtkIBLSpectrum& spectrum, int order);

/// Adds light from points: the bright texels of a spectrum.
void vtkIBLAddBrightTexels(const std::vector<vtkIBLBrightTexel>& texels, vtkIBLHarmonics& harmonics);

/// The harmonics of six cube faces. Texels count by their exact solid angle, with their light at their centre; those of
/// faces below 128^2 are cut as fine as that first.
vtkIBLHarmonics vtkIBLMakeHarmonics(const vtkIBLRadianceImage& faces, int order, const vtkIBLParallelFor& parallelFor);

/// The harmonics of d -> light(matrix d), for an orthogonal matrix: with EnvironmentFromWorld, the light as the world
/// sees it. Reflections are fine.
vtkIBLHarmonics vtkIBLTurnHarmonics(const vtkIBLHarmonics& light, const glm::dmat3& matrix);

/// A_l, what the clamped cosine makes of band l: pi, 2 pi/3, pi/4, 0, -pi/24, 0, pi/64 ... (Ramamoorthi & Hanrahan
/// 2001).
double vtkIBLCosineBand(int l);

/// Irradiance [radiance x sr] on a surface of that unit normal, from the harmonics, clamped to 0 where they ring below
/// it, and from the texels as points, exactly.
glm::dvec3 vtkIBLEvaluateIrradiance(
  const vtkIBLHarmonics& harmonics, const std::vector<vtkIBLBrightTexel>& texels, const glm::dvec3& normal);

/// Irradiance over pi of bands 0 to 2, as iblPackedIrradiance (shaders/vtkIBLHarmonicsFunctions.glsl) takes it.
std::array<glm::dvec4, 7> vtkIBLPackIrradiance(const vtkIBLHarmonics& harmonics);
