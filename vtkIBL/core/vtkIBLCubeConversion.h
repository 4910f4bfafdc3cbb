// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Lat-long image -> radiance cube: every texel is the solid-angle-weighted mean of the image under it.
#pragma once

#include "vtkIBLParallelFor.h"
#include "vtkIBLRadianceImage.h"

/// Fills 6 x faceSize x faceSize x 3 floats, faces in GL's order, row 0 at t = -1. `panorama` has one face, any width
/// and height; faceSize is even. Work grows as the texels of both together. The same input gives the same bits whatever
/// `parallelFor` does.
void vtkIBLConvertToCube(
  const vtkIBLRadianceImage& panorama, int faceSize, float* rgb, const vtkIBLParallelFor& parallelFor);
