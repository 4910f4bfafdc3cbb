// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Balls that turn around a mirror ball, seen in it and in a glossy floor. The probe captures only faces in which
// something moved.
#include "ExampleSupport.h"
#include "vtkIBLOffscreenWindow.h"
#include "vtkIBLProbe.h"
#include "vtkIBLProbeCollection.h"

#include <vtkCamera.h>
#include <vtkCylinderSource.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>

#include <CLI/CLI.hpp>

#include <vector>

namespace
{
vtkSmartPointer<vtkActor> AddBall(
  vtkRenderer* renderer, double radius, const double color[3], double metallic, double roughness)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(radius);
  ball->SetThetaResolution(128);
  ball->SetPhiResolution(128);
  return AddActor(renderer, ball, color, metallic, roughness);
}

vtkSmartPointer<vtkActor> AddCylinder(
  vtkRenderer* renderer, double radius, double height, const double color[3], double metallic, double roughness)
{
  vtkNew<vtkCylinderSource> cylinder;
  cylinder->SetRadius(radius);
  cylinder->SetHeight(height);
  cylinder->SetResolution(128);
  return AddActor(renderer, cylinder, color, metallic, roughness);
}
}

int main(int argc, char* argv[])
{
  std::string hdri;
  std::string output = "DynamicProbe.png";
  int frames = 12;
  CLI::App app("Balls that turn, in a mirror ball and a glossy floor");
  app.add_option("--environment", hdri, "HDR image to light with; default: the built-in studio")
    ->check(CLI::ExistingFile);
  app.add_option("--frames", frames, "Frames to render")->check(CLI::Range(1, 100000))->capture_default_str();
  app.add_option("--output", output, "PNG to write, of the last frame")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  const double white[3] = { 0.95, 0.95, 0.95 };
  const double slate[3] = { 0.3, 0.32, 0.35 };
  const double colors[3][3] = { { 0.75, 0.04, 0.02 }, { 0.9, 0.5, 0.02 }, { 0.02, 0.2, 0.7 } };
  vtkNew<vtkRenderer> renderer;
  AddCylinder(renderer, 2.0, 0.1, slate, 1.0, 0.12)->SetPosition(0.0, -0.05, 0.0);
  AddCylinder(renderer, 0.12, 0.35, white, 0.0, 0.5)->SetPosition(0.0, 0.175, 0.0);
  const vtkSmartPointer<vtkActor> mirror = AddBall(renderer, 0.6, white, 1.0, 0.0);
  mirror->SetPosition(0.0, 0.9, 0.0);
  vtkIBLProbe::SetCaptured(mirror, false); // the probe is in it
  std::vector<vtkSmartPointer<vtkActor>> moving;
  for (const auto& color : colors)
  {
    moving.push_back(AddBall(renderer, 0.3, color, 0.0, 0.3));
  }

  vtkNew<vtkIBLEnvironment> environment;
  environment->SetFileName(hdri.c_str());
  environment->NormalizeExposureOn();
  environment->SetIntensity(0.7);
  vtkNew<vtkIBLProbe> probe;
  probe->SetPosition(0.0, 0.9, 0.0);
  probe->SetProxy(vtkIBLProbe::Ellipsoid); // as wide as the balls' orbit, and steep where they are
  probe->SetBounds(-1.7, 1.7, -2.7, 4.5, -1.7, 1.7);
  probe->SetInfluenceBounds(-4.0, 4.0, -5.0, 6.8, -4.0, 4.0);
  vtkNew<vtkIBLRenderPass> ibl;
  ibl->SetEnvironment(environment);
  ibl->BackgroundVisibleOn();
  ibl->SetBackgroundBlur(0.5);
  ibl->GetProbes()->AddItem(probe);
  ibl->GetProbes()->SetFaceSize(256);
  renderer->SetPass(ibl);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(0.0, 2.4, 5.8);
  camera->SetFocalPoint(0.0, 0.5, 0.0);

  vtkNew<vtkIBLOffscreenWindow> window;
  window->SetSize(960, 600);
  window->SetMultiSamples(8);
  window->AddRenderer(renderer);
  for (int frame = 0; frame < frames; ++frame)
  {
    // Every third frame nothing moves.
    const double turn = 6.0 * (frame - frame / 3);
    for (std::size_t i = 0; i < moving.size(); ++i)
    {
      vtkNew<vtkTransform> orbit;
      orbit->RotateY(turn + 100.0 * i - 60.0);
      double place[3] = { 0.0, 0.35 + 0.2 * i, 1.5 };
      orbit->TransformPoint(place, place);
      moving[i]->SetPosition(place);
    }
    const vtkTypeInt64 faces = probe->GetNumberOfCapturedFaces();
    renderer->ResetCameraClippingRange();
    window->Render();
    std::printf(
      "frame %d: %lld of 6 faces captured\n", frame, static_cast<long long>(probe->GetNumberOfCapturedFaces() - faces));
  }
  PrintStages(ibl);
  return WritePicture(window, output) ? 0 : 1;
}
