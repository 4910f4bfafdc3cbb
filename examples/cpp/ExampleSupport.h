// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What the longer examples share: writing the picture and telling what the light cost.
#pragma once

#include "vtkIBLBRDFTable.h"
#include "vtkIBLCubeMap.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLLighting.h"
#include "vtkIBLRenderPass.h"
#include "vtkIBLSpecularChain.h"

#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkWindowToImageFilter.h>

#include <cstdio>
#include <string>

inline bool WritePicture(vtkRenderWindow* window, const std::string& fileName)
{
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  picture->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(fileName.c_str());
  writer->Write();
  if (writer->GetErrorCode() != vtkErrorCode::NoError)
  {
    std::fprintf(stderr, "could not write %s: %s\n", fileName.c_str(),
      vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
    return false;
  }
  std::printf("wrote %s\n", fileName.c_str());
  return true;
}

inline void PrintStages(vtkIBLRenderPass* ibl)
{
  vtkIBLLighting* lighting = ibl->GetLighting();
  const vtkIBLEnvironment* light = lighting->GetEnvironment();
  const char* file = light->GetFileName();
  std::printf("environment: %s, %d x %d, mean luminance %.3g\n", file ? file : "built-in studio", light->GetWidth(),
    light->GetHeight(), light->GetMeanLuminance());
  auto print = [](const char* name, vtkIBLStage* stage)
  {
    std::printf("  %-14s %8.1f ms  %9lld texels\n", name, 1000.0 * stage->GetLastBuildSeconds(),
      static_cast<long long>(stage->GetLastBuildTexels()));
  };
  print("cube map", lighting->GetCubeMap());
  print("layers", lighting->GetSpecularChain());
  print("BRDF table", lighting->GetBRDFTable());
}
