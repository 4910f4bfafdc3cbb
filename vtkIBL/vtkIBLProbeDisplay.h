// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Probes made visible: a ball at each one's place, its proxy and its influence as wires.
#pragma once

#include "vtkSmartPointer.h"

#include <vector>

class vtkActor;
class vtkIBLProbe;
class vtkIBLProbeCollection;
class vtkPolyData;
class vtkProp;
class vtkWindow;

class vtkIBLProbeDisplay
{
public:
  vtkIBLProbeDisplay();
  ~vtkIBLProbeDisplay();

  /// What of one surface the balls show: a metal's reflections, at a roughness, or what a matt white one gets.
  struct Look
  {
    bool IsMetal;
    double Roughness;
  };
  /// Props for the probes as they are now, theirs until the next call.
  const std::vector<vtkProp*>& Update(vtkIBLProbeCollection* probes, const Look& look);
  const std::vector<vtkProp*>& GetProps() const { return this->Props; }
  void Clear();
  void ReleaseGraphicsResources(vtkWindow* window);

private:
  struct Marks
  {
    vtkSmartPointer<vtkActor> Ball, Proxy, Influence;
  };
  vtkSmartPointer<vtkPolyData> Ball, WireBall, WireCube; // of unit size
  std::vector<Marks> Actors;                             // kept, since they have buffers
  std::vector<vtkProp*> Props;
};
