// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Where probes' light is on the GPU: elements of three arrays of cube maps, and how it gets there.
#pragma once

#include "vtkIBLGL.h"
#include "vtkIBLLadder.h"
#include "vtkIBLSampledFilter.h"

#include <memory>
#include <optional>
#include <vector>

class vtkIBLProbeAtlas
{
public:
  static constexpr int MostElements = 66;

  /// Unless it is in `window` and of these sizes already, makes it so, and empty; returns whether it had to.
  bool Prepare(vtkOpenGLRenderWindow* window, int faceSize, int samples);
  int GetFaceSize() const { return this->FaceSize; }
  int GetNumberOfLayers() const { return this->Ladder.GetNumberOfLayers(); }
  vtkTypeInt64 CountTexels(int firstLayer, int lastLayer) const;

  /// An element that nobody has, or none when all MostElements are taken; and back again. What is in it is black at
  /// first, and then what the last owner left.
  std::optional<int> Take();
  void Give(int& element); // makes it -1, which is none

  ///@{
  /// Level 0 of radiance is to be drawn to, face by face, or copied from another element or a cube map with all its
  /// levels. MakeLevels() makes light of what was drawn, MakeLayers() the layers first … last of it, rougher ones being
  /// there already.
  const vtkIBLGL::Framebuffer& AttachFace(int element, int face) const;
  void CopyFaces(int from, int to) const;
  void CopyLevels(const vtkIBLGL::Texture& cube, int to) const;
  void MakeLevels(int element);
  void MakeLayers(int element, int first, int last, double storedScale);
  ///@}
  double GetStoredScale(int element) const { return this->Elements[element].StoredScale; }
  vtkSmartPointer<vtkImageData> Read(int element) const { return this->Elements[element].Radiance.Read(0); }

  void Activate();
  void Deactivate() { this->Bound.reset(); }
  int GetRadianceUnit() const { return this->Bound->Radiance.GetUnit(); }
  int GetOddUnit() const { return this->Bound->Odd.GetUnit(); }
  int GetEvenUnit() const { return this->Bound->Even.GetUnit(); }

private:
  void Allocate(int count);

  struct Element
  {
    vtkIBLGL::Texture Radiance, Odd, Even; // of the arrays
    double StoredScale = 1.0;
    bool IsTaken = false;
  };
  struct Bindings
  {
    vtkIBLGL::BoundTexture Radiance, Odd, Even;
  };

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  vtkIBLGL::Texture Radiance;  // RGBA32F, mip levels weighted by solid angle
  vtkIBLGL::Texture Odd, Even; // RGBA16F, the ladder's
  std::vector<Element> Elements;
  std::unique_ptr<Bindings> Bound;
  int FaceSize = 0;
  int Samples = 0;
  vtkIBLLadder Ladder;
  vtkIBLSampledFilter Filter;
  vtkIBLGL::Program Resample, Clean;
  vtkIBLGL::Framebuffer Frame;
};
