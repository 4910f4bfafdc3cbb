// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Spheres from dielectric to metal (bottom to top) and from mirror to matt (left to right).
#include "ExampleSupport.h"
#include "vtkIBLOffscreenWindow.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <CLI/CLI.hpp>

int main(int argc, char* argv[])
{
  std::string hdri;
  std::string output = "MaterialGrid.png";
  CLI::App app("Spheres from dielectric to metal (bottom to top) and from mirror to matt (left to right)");
  app.add_option("--environment", hdri, "HDR image to light with; default: the built-in studio")
    ->check(CLI::ExistingFile);
  app.add_option("--output", output, "PNG to write")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(96);
  sphere->SetPhiResolution(96);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkRenderer> renderer;
  constexpr int columns = 6;
  constexpr int rows = 3;
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      vtkNew<vtkActor> actor;
      actor->SetMapper(mapper);
      actor->SetPosition(1.15 * column, 1.15 * row, 0.0);
      actor->GetProperty()->SetInterpolationToPBR();
      actor->GetProperty()->SetColor(0.95, 0.64, 0.54); // copper
      actor->GetProperty()->SetMetallic(double(row) / (rows - 1));
      actor->GetProperty()->SetRoughness(double(column) / (columns - 1));
      renderer->AddActor(actor);
    }
  }

  vtkNew<vtkIBLEnvironment> environment;
  environment->SetFileName(hdri.c_str());
  environment->NormalizeExposureOn();
  environment->SetIntensity(0.7); // copper is bright: leave room for its highlights
  vtkNew<vtkIBLRenderPass> ibl;
  ibl->SetEnvironment(environment);
  ibl->BackgroundVisibleOn();
  ibl->SetBackgroundBlur(0.5);
  renderer->SetPass(ibl);

  vtkNew<vtkIBLOffscreenWindow> window;
  window->SetSize(1200, 620);
  window->SetMultiSamples(4);
  window->AddRenderer(renderer);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Zoom(1.75);
  window->Render();
  PrintStages(ibl);
  return WritePicture(window, output) ? 0 : 1;
}
