// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// An environment as harmonics and a few bright texels, out of which any rough layer can be made, exactly and without
// sampling.
//
// The kernel of N = V = R under GGX depends on the angle alone, so in harmonics it is a factor a band, b_l(alpha),
// which falls like exp(-2 alpha l). Texels far brighter than the rest are taken out first and come back as lobes of
// that very kernel, so that they do not ring.
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

/// One of the lobes that a layer is a weighted sum of.
struct vtkIBLLobe
{
  double PerceptualRoughness; // in (0, 1]
  double Weight;
};

class vtkIBLSpectrum
{
public:
  /// Bands 0 to `order` (at most MaximumOrder) of a lat-long image, box reading; one wider than 2048 is box-reduced
  /// first. The same input gives the same bits whatever `parallelFor` does.
  vtkIBLSpectrum(const vtkIBLRadianceImage& image, int order, const vtkIBLParallelFor& parallelFor);

  /// One that was made before: GetCoefficients() and GetBrightTexels() of it.
  vtkIBLSpectrum(int order, std::vector<float> coefficients, std::vector<vtkIBLBrightTexel> brightTexels);

  static constexpr int MaximumOrder = 320;

  /// Bright texels that belong to one lamp lie within so much of it [rad].
  static constexpr double LampRadius = 0.05;

  /// Radiance under the sum of `lobes` at the texel centres of a cube map's faces, in GL's order, row 0 at t = -1, with
  /// a border of `border` (0 or 1) texels around each face, where its plane goes on: 6 x (faceSize + 2 border)^2 x 3
  /// floats. Never negative unless a weight is. faceSize is even.
  void Filter(const std::vector<vtkIBLLobe>& lobes, int faceSize, int border, float* rgb,
    const vtkIBLParallelFor& parallelFor) const;

  /// Mean of the absolute value over the sphere, and root mean square, of the light less its bright texels, when band l
  /// counts factors[l]; both a channel.
  void Measure(
    const std::vector<double>& factors, double& mean, double& rms, const vtkIBLParallelFor& parallelFor) const;

  int GetOrder() const { return this->Order; }
  const std::vector<float>& GetCoefficients() const { return this->Coefficients; }
  const std::vector<vtkIBLBrightTexel>& GetBrightTexels() const { return this->BrightTexels; }

  /// Real and imaginary part of band l, 0 <= m <= l: integral of radiance times P_lm(y) exp(-i m phi) over the sphere,
  /// phi = atan2(z, x), P orthonormal, with sqrt 2 for m > 0, and without the Condon-Shortley sign. Bright texels are
  /// not in it.
  std::pair<glm::dvec3, glm::dvec3> GetCoefficient(int l, int m) const;

  /// Bands that a roughness needs, so that `tolerance` of the kernel is left above; enough also for its edge at the
  /// horizon when it is broad. At most MaximumOrder.
  static int RequiredOrder(double perceptualRoughness, double tolerance = 4.5e-5);

  /// b_l(alpha), l = 0 .. order: the kernel's Legendre coefficients, b_0 = 1.
  static std::vector<double> KernelBands(double perceptualRoughness, int order);

private:
  int Order;
  std::vector<float> Coefficients; // m-major: for m, for l = m..Order: re r g b, im r g b
  std::vector<vtkIBLBrightTexel> BrightTexels;
};
