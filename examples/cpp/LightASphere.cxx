// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The shortest program: a golden sphere lit by an HDRI, or by the built-in studio when none is given.
//   LightASphere [--environment HDRI] [--output OUT.png]
#include "vtkIBLEnvironment.h"
#include "vtkIBLOffscreenWindow.h"
#include "vtkIBLRenderPass.h"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkWindowToImageFilter.h>

#include <iostream>
#include <string>

int main(int argc, char* argv[])
{
  std::string hdri, output = "LightASphere.png";
  for (int i = 1; i + 1 < argc; i += 2)
  {
    (std::string(argv[i]) == "--environment" ? hdri : output) = argv[i + 1];
  }

  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(128);
  sphere->SetPhiResolution(128);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToPBR();
  actor->GetProperty()->SetColor(1.0, 0.77, 0.34); // gold
  actor->GetProperty()->SetMetallic(1.0);
  actor->GetProperty()->SetRoughness(0.2);

  vtkNew<vtkIBLEnvironment> environment;
  environment->SetFileName(hdri.c_str());
  vtkNew<vtkIBLRenderPass> ibl;
  ibl->SetEnvironment(environment);
  ibl->BackgroundVisibleOn();
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->SetPass(ibl);

  vtkNew<vtkIBLOffscreenWindow> window;
  window->SetSize(512, 512);
  window->AddRenderer(renderer);
  window->Render();

  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(output.c_str());
  writer->Write();
  std::cout << "wrote " << output << "\n";
}
