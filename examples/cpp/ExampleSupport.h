// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What the longer examples share: an actor of a material, writing the picture, telling what the light cost.
#pragma once

#include "vtkIBLBRDFTable.h"
#include "vtkIBLCubeMap.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLLighting.h"
#include "vtkIBLRenderPass.h"
#include "vtkIBLSpecularChain.h"

#include <vtkActor.h>
#include <vtkAlgorithm.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkWindowToImageFilter.h>

#include <cstdio>
#include <string>

// Of physically based material; `color` is linear albedo.
inline vtkSmartPointer<vtkActor> AddActor(
  vtkRenderer* renderer, vtkAlgorithm* source, const double color[3], double metallic, double roughness)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToPBR();
  actor->GetProperty()->SetColor(color[0], color[1], color[2]);
  actor->GetProperty()->SetMetallic(metallic);
  actor->GetProperty()->SetRoughness(roughness);
  renderer->AddActor(actor);
  return actor;
}

inline vtkSmartPointer<vtkImageData> TakePicture(vtkRenderWindow* window)
{
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  picture->ShouldRerenderOff();
  picture->Update();
  return picture->GetOutput();
}

inline bool WritePicture(vtkImageData* picture, const std::string& fileName)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(picture);
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

inline bool WritePicture(vtkRenderWindow* window, const std::string& fileName)
{
  return WritePicture(TakePicture(window), fileName);
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
