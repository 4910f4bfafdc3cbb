// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether something is what it was: numbers of all that it depends on.
#pragma once

#include "vtkType.h"

#include <cstdint>
#include <vector>

class vtkAlgorithm;
class vtkLight;
class vtkObject;
class vtkProp;
class vtkProperty;
class vtkRenderState;

/// What a picture depends on. Equal stamps: equal pictures, but for noise.
class vtkIBLStamp
{
public:
  vtkIBLStamp() = default; // equal to no other
  /// Of camera, lights, visible props with what they draw, and the renderer.
  explicit vtkIBLStamp(const vtkRenderState* state);
  void Add(std::uint64_t time) { this->Words.push_back(time); }
  void Add(vtkObject* object); ///< which, and when it last changed; may be null
  void Add(const double* numbers, int count);
  void Add(const vtkIBLStamp& other);
  void AddLight(vtkLight* light);
  void AddPropWithParts(vtkProp* prop);
  /// Takes over the renderer's time: a selection changes its background and changes it back.
  void ForgiveSelection(const vtkIBLStamp& now);
  bool operator==(const vtkIBLStamp& other) const { return this->Words == other.Words; }

private:
  void AddWithInputs(vtkAlgorithm* algorithm);
  void AddProperty(vtkProperty* property);
  void AddProp(vtkProp* prop);
  std::vector<std::uint64_t> Words; // the first is the renderer's time
};
