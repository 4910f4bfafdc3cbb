// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What share of light a surface reflects, as a constant: MakeBRDFTable.cxx integrates it while the library is built.
#pragma once

#include <cstdint>

constexpr int vtkIBLBRDFTableSize = 64;
constexpr int vtkIBLBRDFTableBlocks = 2; // one above the other, each Size x Size
constexpr int vtkIBLBRDFTableChannels = 4;

/// Row after row of perceptualRoughness, sqrt(NoV) along a row (iblBRDFTableArguments); 65535 stands for 1.
///   block 0:  A, B, diffuse share of the white lobe (f0 = 1), of the dielectric lobe (f0 = 0.04)
///   block 1:  bend and perceptualRoughness of the white lobe, of the dielectric lobe; roughness as iblLadderPosition()
/// Reflectance is f0 A + f90 B; vtkIBLFittedLobe says what the rest is.
extern const std::uint16_t
  vtkIBLBRDFTableTexels[vtkIBLBRDFTableBlocks * vtkIBLBRDFTableSize * vtkIBLBRDFTableSize * vtkIBLBRDFTableChannels];
