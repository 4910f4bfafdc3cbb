// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// An environment as harmonics and a few bright texels, out of which any rough layer can be made, exactly and without
// sampling.
//
// The kernel of N = V = R under GGX depends on the angle alone, so in harmonics it is a factor a band, b_l(alpha),
// which falls like exp(-2 alpha l): 5/alpha bands leave 5e-5 of it. Texels far brighter than the rest are taken out
// first and come back as lobes of that very kernel, so that they do not ring.
#pragma once

#include "vtkIBLParallelFor.h"
#include "vtkIBLRadianceImage.h"

#include <glm/glm.hpp>

#include <utility>
#include <vector>

/// A texel that stands for more light than its share: unit direction, solid angle [sr], and the radiance that was taken
/// out.
struct vtkIBLBrightTexel
{
  glm::dvec3 Direction;
  double SolidAngle;
  glm::dvec3 Radiance;
};

class vtkIBLSpectrum
{
public:
  /// Bands 0 to `order` (at most 128: single precision holds sin^m to there) of a lat-long image, box reading. The same
  /// input gives the same bits whatever `parallelFor` does.
  vtkIBLSpectrum(const vtkIBLRadianceImage& image, int order, const vtkIBLParallelFor& parallelFor);

  /// Fills 6 x faceSize x faceSize x 3 floats, faces in GL's order, row 0 at t = -1, with radiance under the lobe of
  /// perceptualRoughness in (0, 1]. Never negative. faceSize is even.
  void Filter(double perceptualRoughness, int faceSize, float* rgb, const vtkIBLParallelFor& parallelFor) const;

  const std::vector<vtkIBLBrightTexel>& GetBrightTexels() const { return this->BrightTexels; }
  int GetOrder() const { return this->Order; }

  /// Real and imaginary part of band l, 0 <= m <= l: integral of radiance times P_lm(y) exp(-i m phi) over the sphere,
  /// phi = atan2(z, x), P orthonormal, with sqrt 2 for m > 0, and without the Condon-Shortley sign. Bright texels are
  /// not in it.
  std::pair<glm::dvec3, glm::dvec3> GetCoefficient(int l, int m) const;

  /// Bands that a roughness needs: 4/alpha, and never less than 48, for the kernel's edge at the horizon when it is
  /// broad.
  static int RequiredOrder(double perceptualRoughness);

  /// b_l(alpha), l = 0 .. order: the kernel's Legendre coefficients, b_0 = 1.
  static std::vector<double> KernelBands(double perceptualRoughness, int order);

private:
  int Order;
  std::vector<float> Coefficients; // m-major: for m, for l = m..Order: re r g b, im r g b
  std::vector<vtkIBLBrightTexel> BrightTexels;
};
