// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What share of light a surface reflects, as a constant: MakeBRDFTable.cxx integrates it while the library is built.
#pragma once

#include <cstdint>

constexpr int vtkIBLBRDFTableSize = 64;
constexpr int vtkIBLBRDFTableChannels = 2; // A, B: reflectance = f0 A + f90 B

/// Row after row of perceptualRoughness, sqrt(NoV) along a row (iblBRDFTableArguments); 65535 stands for 1.
extern const std::uint16_t vtkIBLBRDFTableTexels[vtkIBLBRDFTableSize * vtkIBLBRDFTableSize * vtkIBLBRDFTableChannels];
