// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// GGX layers of a radiance cube, on the GPU alone: nothing is read back (docs/derivations/sampled-filter.md).
//
// Rough layers are exact sums over a coarse grid of lights, all in one dispatch. A sharp layer is the samples of its
// lobe's core, plus the next rougher layer for the rest of the lobe; hence one dispatch each, from rough to sharp.
#pragma once

#include "vtkIBLGL.h"
#include "vtkIBLSampleTable.h"

#include <vector>

class vtkIBLSampledFilter
{
public:
  struct Layer
  {
    double PerceptualRoughness;    // in [0, 1]; 0 is the mirror
    const vtkIBLGL::Texture* Cube; // RGBA16F, filled at...
    int Level;                     // ... this mip level
    bool IsMade = false;           // by somebody else: only read, as the tail of a sharper layer
  };

  /// Makes `layers`, which go from sharp to rough, out of `source`, an RGBA32F cube whose size is a power of two and
  /// whose mip levels are solid-angle-weighted means. Stores radiance / storedScale, at most 65504. `count`: samples a
  /// texel of a sharp layer. Where the last layer is a sharp one, no tail helps it: up to twice the error.
  /// Returns the number of texels read, filtered fetches and lights alike.
  long long Run(vtkOpenGLRenderWindow* window, const vtkIBLGL::Texture& source, double storedScale,
    const std::vector<Layer>& layers, int count);

private:
  using Layers = std::vector<Layer>;
  long long MakeRough(vtkOpenGLRenderWindow* window, const vtkIBLGL::Texture& source, double storedScale,
    Layers::const_iterator first, Layers::const_iterator last);
  long long MakeSharp(vtkOpenGLRenderWindow* window, const vtkIBLGL::Texture& smooth, double storedScale,
    const Layer& layer, const Layer* tail, int count);
  vtkIBLGL::Texture MakeSmooth(vtkOpenGLRenderWindow* window, const vtkIBLGL::Texture& source);

  // The samples of a layer, kept while what they were made for stays.
  struct Core
  {
    double Roughness, TailRoughness;
    int SourceSize, LayerSize, Count;
    vtkIBLSampleTable Table;
    vtkIBLGL::Buffer Samples;
  };
  const Core& GetCore(
    vtkOpenGLRenderWindow* window, double roughness, double tailRoughness, int sourceSize, int layerSize, int count);

  std::vector<Core> Cores;
  vtkIBLGL::Program Smooth, Prefilter, Lights, Rough;
};
