// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// A room in its mirror floor and in a glossy ball, by the light of one captured probe: as if it were far away (left),
// and on the walls of the probe's box (right). Both pictures read the same six faces.
#include "ExampleSupport.h"
#include "vtkIBLOffscreenWindow.h"
#include "vtkIBLProbe.h"
#include "vtkIBLProbeCollection.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCubeSource.h>
#include <vtkCylinderSource.h>
#include <vtkImageAppend.h>
#include <vtkLight.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <CLI/CLI.hpp>

namespace
{
constexpr double Room[6] = { -2.0, 2.0, 0.0, 2.6, -2.5, 2.5 }; // metres

struct Box
{
  double Bounds[6], Color[3]; // linear albedo
};

constexpr double Wall[3] = { 0.55, 0.5, 0.42 };
const Box Boxes[] = {
  // Ceiling, walls, and to the right a window, open to the sky
  { { -2.1, 2.1, 2.6, 2.7, -2.6, 2.6 }, { 0.7, 0.7, 0.7 } },
  { { -2.1, -2.0, -0.1, 2.6, -2.6, 2.6 }, { 0.45, 0.1, 0.06 } },
  { { -2.0, 2.0, -0.1, 2.6, -2.6, -2.5 }, { Wall[0], Wall[1], Wall[2] } },
  { { -2.0, 2.0, -0.1, 2.6, 2.5, 2.6 }, { 0.1, 0.16, 0.3 } },
  { { 2.0, 2.1, -0.1, 0.8, -2.6, 2.6 }, { Wall[0], Wall[1], Wall[2] } },
  { { 2.0, 2.1, 2.2, 2.6, -2.6, 2.6 }, { Wall[0], Wall[1], Wall[2] } },
  { { 2.0, 2.1, 0.8, 2.2, -2.6, -1.6 }, { Wall[0], Wall[1], Wall[2] } },
  { { 2.0, 2.1, 0.8, 2.2, 0.6, 2.6 }, { Wall[0], Wall[1], Wall[2] } },
  { { 1.96, 2.1, 0.8, 2.2, -0.54, -0.46 }, { 0.8, 0.8, 0.8 } },
  // Door, its lintel, a picture, and a shelf with books
  { { 0.7, 1.5, 0.0, 1.95, -2.5, -2.46 }, { 0.05, 0.18, 0.12 } },
  { { 0.6, 1.6, 1.95, 2.05, -2.5, -2.42 }, { 0.8, 0.8, 0.8 } },
  { { 0.6, 0.7, 0.0, 1.95, -2.5, -2.42 }, { 0.8, 0.8, 0.8 } },
  { { 1.5, 1.6, 0.0, 1.95, -2.5, -2.42 }, { 0.8, 0.8, 0.8 } },
  { { -0.5, 0.3, 1.1, 1.9, -2.5, -2.44 }, { 0.02, 0.02, 0.02 } },
  { { -0.43, -0.1, 1.17, 1.83, -2.5, -2.43 }, { 0.8, 0.45, 0.02 } },
  { { -0.1, 0.23, 1.17, 1.5, -2.5, -2.43 }, { 0.02, 0.15, 0.6 } },
  { { -0.1, 0.23, 1.5, 1.83, -2.5, -2.43 }, { 0.7, 0.05, 0.03 } },
  { { -1.9, -0.8, 0.0, 0.5, -2.5, -2.15 }, { 0.25, 0.11, 0.04 } },
  { { -2.0, -1.85, 1.2, 1.25, -1.8, 1.2 }, { 0.25, 0.11, 0.04 } },
  { { -2.0, -1.86, 1.25, 1.55, -1.6, -1.3 }, { 0.03, 0.25, 0.08 } },
  { { -2.0, -1.86, 1.25, 1.6, -1.3, -0.9 }, { 0.7, 0.6, 0.1 } },
  { { -2.0, -1.86, 1.25, 1.5, -0.4, 0.2 }, { 0.1, 0.3, 0.6 } },
};

vtkSmartPointer<vtkActor> AddBox(
  vtkRenderer* renderer, const double bounds[6], const double color[3], double metallic, double roughness)
{
  vtkNew<vtkCubeSource> cube;
  cube->SetBounds(bounds);
  return AddActor(renderer, cube, color, metallic, roughness);
}

void FurnishRoom(vtkRenderer* renderer)
{
  for (const Box& box : Boxes)
  {
    AddBox(renderer, box.Bounds, box.Color, 0.0, 0.7);
  }
  const double floor[6] = { -2.1, 2.1, -0.1, 0.0, -2.6, 2.6 };
  const double silver[3] = { 0.9, 0.9, 0.88 };
  AddBox(renderer, floor, silver, 1.0, 0.0);
  const double lamp[6] = { -0.6, 0.6, 2.57, 2.6, -0.9, 0.3 };
  const double light[3] = { 2.2, 2.1, 1.9 }; // unlit: a screen's numbers, above what a screen can show
  AddBox(renderer, lamp, light, 0.0, 1.0)->GetProperty()->LightingOff();
  vtkNew<vtkLight> bulb;
  bulb->PositionalOn();
  bulb->SetConeAngle(180.0); // to all sides
  bulb->SetPosition(0.0, 2.3, -0.3);
  bulb->SetAttenuationValues(0.0, 0.0, 1.0);
  bulb->SetColor(1.0, 0.9, 0.75);
  bulb->SetIntensity(3.0);
  renderer->AddLight(bulb);
  vtkNew<vtkCylinderSource> rug;
  rug->SetRadius(0.75);
  rug->SetHeight(0.02);
  rug->SetResolution(96);
  const double red[3] = { 0.3, 0.03, 0.03 };
  AddActor(renderer, rug, red, 0.0, 0.9)->SetPosition(0.1, 0.01, -0.6);
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.45);
  ball->SetThetaResolution(128);
  ball->SetPhiResolution(128);
  const double gold[3] = { 1.0, 0.77, 0.34 };
  const vtkSmartPointer<vtkActor> actor = AddActor(renderer, ball, gold, 1.0, 0.12);
  actor->SetPosition(0.1, 0.47, -0.6);
  vtkIBLProbe::SetCaptured(actor, false); // it stands off the walls, where a proxy cannot tell
}
}

int main(int argc, char* argv[])
{
  std::string hdri;
  std::string output = "ParallaxRoom.png";
  CLI::App app("A room in a mirror floor, without (left) and with (right) the probe's box");
  app.add_option("--environment", hdri, "HDR image outside; default: the built-in studio")->check(CLI::ExistingFile);
  app.add_option("--output", output, "PNG to write")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  vtkNew<vtkIBLEnvironment> environment;
  environment->SetFileName(hdri.c_str());
  environment->NormalizeExposureOn();
  vtkNew<vtkIBLProbe> probe;
  probe->SetPosition(0.0, 1.3, 0.0);
  probe->SetBounds(Room);
  probe->SetBounces(3);
  vtkNew<vtkIBLRenderPass> ibl;
  ibl->SetEnvironment(environment);
  ibl->BackgroundVisibleOn();
  ibl->GetProbes()->AddItem(probe);
  ibl->GetProbes()->SetFaceSize(512);
  vtkNew<vtkRenderer> renderer;
  FurnishRoom(renderer);
  renderer->SetPass(ibl);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(-0.9, 1.55, 2.4);
  camera->SetFocalPoint(0.15, 0.65, -1.0);
  camera->SetViewAngle(60.0);

  vtkNew<vtkIBLOffscreenWindow> window;
  window->SetSize(640, 560);
  window->SetMultiSamples(8);
  window->AddRenderer(renderer);
  renderer->ResetCameraClippingRange();
  vtkNew<vtkImageAppend> both;
  for (const int proxy : { vtkIBLProbe::Infinite, vtkIBLProbe::Box })
  {
    probe->SetProxy(proxy);
    window->Render();
    std::printf("%s: %lld faces captured so far\n", proxy == vtkIBLProbe::Box ? "on the walls" : "far away",
      static_cast<long long>(probe->GetNumberOfCapturedFaces()));
    both->AddInputData(TakePicture(window));
  }
  both->Update();
  PrintStages(ibl);
  return WritePicture(both->GetOutput(), output) ? 0 : 1;
}
