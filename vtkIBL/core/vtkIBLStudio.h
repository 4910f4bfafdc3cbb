// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The light that is there when nobody gave one.
#pragma once

#include "vtkIBLRadianceImage.h"

/// Fills a lat-long image with a procedural photographer's studio: soft grey walls, a lighter ceiling, a darker
/// floor, and three softboxes (key, fill, rim), so that metal has something to reflect and shape reads. Radiance 0 to
/// 12, neutral in hue.
void vtkIBLMakeStudio(const vtkIBLRadianceImage& image);
