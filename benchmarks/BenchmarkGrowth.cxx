// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// How the whole bake's time grows with the source and with the cube's faces.
#include "Benchmark.h"

#include <algorithm>

namespace vtkIBLBenchmark
{
namespace
{
void RunSize(Session& session, const Engine& engine, const std::string& panel, vtkImageData* panorama, int faceSize)
{
  const int width = panorama->GetDimensions()[0];
  const std::function<Sample()> run = engine.MakeGrowth(panorama, faceSize);
  if (!run)
  {
    return;
  }
  Row row(panel, engine.Name, "", session.Maps.front().Name);
  row.Size = faceSize > 0 ? faceSize : width;
  row.Setting =
    faceSize > 0 ? std::to_string(faceSize) + "^2 faces" : std::to_string(width) + " x " + std::to_string(width / 2);
  run(); // warm-up
  row.Samples = Repeat(run, session.Options.Repeat, session.Options.Quick ? 0.5 : 3, 2);
  row.Default = true;
  session.Add(row);
}
}

void RunGrowth(Session& session)
{
  vtkImageData* original = session.Maps.front().Image;
  if (session.Wants("growth source"))
  {
    const int largest = session.Options.Quick ? 1024 : 8192;
    for (int width = 512; width <= largest; width *= 2)
    {
      const vtkSmartPointer<vtkImageData> panorama = Resize(original, width);
      for (const Engine& engine : session.Engines)
      {
        if (engine.MakeGrowth && width <= engine.LargestGrowthSource)
        {
          RunSize(session, engine, "growth source", panorama, 0);
        }
      }
    }
  }
  if (session.Wants("growth face"))
  {
    const int largest = session.Options.Quick ? 128 : 1024;
    for (const Engine& engine : session.Engines)
    {
      for (int size = 64; size <= std::min(largest, engine.LargestGrowthFace); size *= 2)
      {
        RunSize(session, engine, "growth face", original, size);
      }
    }
  }
}
}
