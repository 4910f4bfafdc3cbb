// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The light of a scene's probes: what of it has to be made anew, and what a shader is told of it.
#pragma once

#include "vtkIBLProbeAtlas.h"
#include "vtkIBLStamp.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

class vtkCamera;
class vtkIBLCubeMap;
class vtkIBLProbe;
class vtkIBLProbeCollection;
class vtkIBLStatistics;
class vtkProp;
class vtkRenderer;
class vtkShaderProgram;

class vtkIBLProbeLight
{
public:
  vtkIBLProbeLight();
  ~vtkIBLProbeLight();

  /// A scene as probes take it.
  struct Scene
  {
    vtkOpenGLRenderWindow* Window;
    std::vector<vtkProp*> Captured;               // what they show
    std::vector<std::array<double, 6>> LitBounds; // of surfaces in sight that take environment light
    vtkIBLStamp Light;                            // all that captures depend on beside props
    double StoredScale;                           // the order of its radiance
    /// Draws such props, and behind them the sky, as `camera` sees them, in linear radiance; lit by probes, or else by
    /// the sky and lights alone. Throws std::runtime_error.
    std::function<void(vtkCamera* camera, const vtkIBLGL::Framebuffer& target, int size,
      const std::vector<vtkProp*>& props, bool probes)>
      Draw;
  };

  /// Makes room for probes' light in `window`, to bind it; and takes note of which probes there are.
  void Prepare(vtkOpenGLRenderWindow* window, vtkIBLProbeCollection* probes);
  void Activate() { this->Atlas.Activate(); }
  void Deactivate() { this->Atlas.Deactivate(); }

  /// Brings up to date what surfaces in sight are lit by, and counts it; while bound. Throws std::runtime_error, and
  /// the light stays as it was.
  void Update(const Scene& scene, vtkIBLStatistics* statistics);

  /// While bound: gives a program with IBL_PROBES what it needs for an actor of such bounds, under the camera; null:
  /// an actor that no probe lights.
  void SetShaderParameters(vtkShaderProgram* program, vtkRenderer* renderer, const double* bounds) const;

  /// When what surfaces see of it last changed: light that came, or faded further.
  std::uint64_t GetTime() const { return this->Time.GetMTime(); }

  ///@{
  /// Wants a probe's light with the next Update(), whoever sees it; and reads it. Null when there is none.
  void SetWanted(const vtkIBLProbe* probe) { this->Wanted = probe; }
  vtkSmartPointer<vtkImageData> Read(const vtkIBLProbe* probe) const;
  ///@}

  void ReleaseGraphicsResources();

private:
  struct Entry;
  struct Use; // of an element, for one actor

  void Forget(Entry& entry); // its light
  bool Take(int& element);
  bool Begin(const Scene& scene, Entry& entry);
  void Step(const Scene& scene, Entry& entry, bool cutUp);
  void Finish(Entry& entry);
  void CaptureFace(const Scene& scene, Entry& entry, int face);
  std::vector<Use> Choose(const double bounds[6]) const;
  std::array<vtkIBLStamp, 6> StampFaces(const Scene& scene, vtkIBLProbe* probe);

  vtkIBLProbeAtlas Atlas;
  std::vector<Entry> Entries;      // in the collection's order...
  vtkMTimeType CollectionTime = 0; // ... as of then
  const vtkIBLProbe* Wanted = nullptr;
  vtkIBLStatistics* Statistics = nullptr; // while Update() runs
  std::vector<vtkIBLStamp> PropStamps;    // of what is captured, while it is known not to have changed
  vtkTimeStamp Time;
  bool IsFull = false; // said so
};
