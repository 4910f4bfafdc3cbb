// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What a bake knows of its source in the end. Who has it need not read the source.
#pragma once

#include "vtkIBLRadianceImage.h"
#include "vtkIBLSpectrum.h"

#include <cstddef>
#include <vector>

/// A part that was not made is empty: face size 0, order -1.
struct vtkIBLStoredLight
{
  int SourceWidth = 0;
  int SourceHeight = 0;
  int SourceFaces = 0;
  double MeanLuminance = 0.0;
  vtkIBLRadianceFaults Faults;

  int CubeFaceSize = 0;    // n of the radiance cube's level 0
  std::vector<float> Cube; // 6 x n x n x 3, faces in GL's order, row 0 at t = -1

  int SpectrumOrder = -1;
  std::vector<float> Coefficients; // as vtkIBLSpectrum has them
  std::vector<vtkIBLBrightTexel> BrightTexels;

  /// Numbers of floats that go with a face size of at least 0, and with an order of at least -1.
  static std::size_t GetCubeLength(int faceSize) { return std::size_t(18) * faceSize * faceSize; }
  static std::size_t GetCoefficientsLength(int order) { return std::size_t(3) * (order + 1) * (order + 2); }

  /// Whether the parts are as long as they should be.
  bool IsWhole() const
  {
    return this->CubeFaceSize >= 0 && this->Cube.size() == GetCubeLength(this->CubeFaceSize) &&
      this->SpectrumOrder >= -1 && this->Coefficients.size() == GetCoefficientsLength(this->SpectrumOrder);
  }

  std::size_t GetNumberOfBytes() const
  {
    return (this->Cube.size() + this->Coefficients.size()) * sizeof(float) +
      this->BrightTexels.size() * sizeof(vtkIBLBrightTexel);
  }
};
