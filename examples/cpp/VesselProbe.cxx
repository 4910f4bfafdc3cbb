// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// An artery with a stenosis, cut open, its wall coloured by pressure. A stent and a catheter of metal show the wall, by
// the light of a probe in the lumen, which lights the wall itself, too.
#include "ExampleSupport.h"
#include "vtkIBLOffscreenWindow.h"
#include "vtkIBLProbe.h"
#include "vtkIBLProbeCollection.h"
#include "vtkIBLStatistics.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkClipPolyData.h>
#include <vtkColorTransferFunction.h>
#include <vtkDoubleArray.h>
#include <vtkMath.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTubeFilter.h>

#include <CLI/CLI.hpp>

#include <array>
#include <cmath>

namespace
{
constexpr double Length = 60.0; // mm
constexpr double Radius = 5.0;
constexpr int Steps = 240;

double GetRadius(double x)
{
  return Radius * (1.0 - 0.45 * std::exp(-x * x / 50.0));
}

// A line through f(0) ... f(1).
template <typename Curve>
vtkSmartPointer<vtkPolyData> MakeCurve(Curve f)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(Steps + 1);
  for (int i = 0; i <= Steps; ++i)
  {
    const std::array<double, 3> point = f(double(i) / Steps);
    lines->InsertCellPoint(points->InsertNextPoint(point.data()));
  }
  auto curve = vtkSmartPointer<vtkPolyData>::New();
  curve->SetPoints(points);
  curve->SetLines(lines);
  return curve;
}

template <typename Curve>
void AddWire(vtkRenderer* renderer, double thickness, const double color[3], double roughness, Curve f)
{
  vtkNew<vtkTubeFilter> wire;
  wire->SetInputData(MakeCurve(f));
  wire->SetRadius(thickness);
  wire->SetNumberOfSides(16);
  wire->CappingOn();
  // The probe shows the wall, which its ellipsoid stands for; what is near it would be shown on that, too large.
  vtkIBLProbe::SetCaptured(AddActor(renderer, wire, color, 1.0, roughness), false);
}

void AddVessel(vtkRenderer* renderer)
{
  const vtkSmartPointer<vtkPolyData> axis = MakeCurve(
    [](double t) {
      return std::array<double, 3>{ Length * (t - 0.5), 0.0, 0.0 };
    });
  // Friction of a slow flow (Poiseuille: dp/dx ~ -1/r^4), and what speed takes where it is narrow (Bernoulli: ~ 1/r^4);
  // in units of the drop over a millimetre of healthy artery.
  vtkNew<vtkDoubleArray> radius;
  radius->SetName("Radius");
  vtkNew<vtkDoubleArray> pressure;
  pressure->SetName("Pressure");
  double friction = 0.0;
  for (int i = 0; i <= Steps; ++i)
  {
    radius->InsertNextValue(GetRadius(axis->GetPoint(i)[0]));
    const double narrowing = std::pow(Radius / radius->GetValue(i), 4.0);
    friction += narrowing * Length / Steps;
    pressure->InsertNextValue(-friction - 4.0 * narrowing);
  }
  axis->GetPointData()->SetScalars(radius);
  axis->GetPointData()->AddArray(pressure);
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputData(axis);
  tube->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
  tube->SetNumberOfSides(128);
  vtkNew<vtkPlane> cut;
  cut->SetNormal(0.0, -0.55, -1.0);
  vtkNew<vtkClipPolyData> half;
  half->SetInputConnection(tube->GetOutputPort());
  half->SetClipFunction(cut);
  const double white[3] = { 1.0, 1.0, 1.0 };
  const vtkSmartPointer<vtkActor> wall = AddActor(renderer, half, white, 0.0, 0.45);
  vtkNew<vtkColorTransferFunction> colors; // blue to red over white, linear albedo
  colors->SetColorSpaceToDiverging();
  colors->AddRGBPoint(pressure->GetRange()[0], 0.03, 0.06, 0.55);
  colors->AddRGBPoint(pressure->GetRange()[1], 0.55, 0.015, 0.03);
  wall->GetMapper()->SetLookupTable(colors);
  wall->GetMapper()->UseLookupTableScalarRangeOn();
  wall->GetMapper()->SetScalarModeToUsePointFieldData();
  wall->GetMapper()->SelectColorArray("Pressure");
}
}

int main(int argc, char* argv[])
{
  std::string hdri;
  std::string output = "VesselProbe.png";
  CLI::App app("A stent in an artery, in the light of its wall");
  app.add_option("--environment", hdri, "HDR image to light with; default: the built-in studio")
    ->check(CLI::ExistingFile);
  app.add_option("--output", output, "PNG to write")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  vtkNew<vtkRenderer> renderer;
  AddVessel(renderer);
  const double steel[3] = { 0.85, 0.85, 0.87 };
  for (int ring = -4; ring <= 4; ++ring)
  {
    AddWire(renderer, 0.28, steel, 0.12,
      [ring](double t)
      {
        const double angle = 2.0 * vtkMath::Pi() * t;
        const double x = 2.2 * ring + 0.95 * std::sin(8.0 * angle);
        const double r = GetRadius(x) - 0.35;
        return std::array<double, 3>{ x, r * std::cos(angle), r * std::sin(angle) };
      });
  }
  const double gold[3] = { 1.0, 0.77, 0.34 };
  AddWire(renderer, 0.8, gold, 0.05,
    [](double t) {
      return std::array<double, 3>{ 62.0 * t - 45.0, 0.8 * std::sin(5.0 * t), 0.5 * t };
    });

  vtkNew<vtkIBLEnvironment> environment;
  environment->SetFileName(hdri.c_str());
  environment->NormalizeExposureOn();
  environment->SetIntensity(0.8);
  vtkNew<vtkIBLProbe> probe;
  probe->SetProxy(vtkIBLProbe::Ellipsoid);
  probe->SetPosition(0.0, 1.0, 1.5);
  probe->SetBounds(-0.6 * Length, 0.6 * Length, -Radius, Radius, -Radius, Radius);
  probe->SetInfluenceBounds(-Length, Length, -1.5 * Radius, 1.5 * Radius, -1.5 * Radius, 1.5 * Radius); // and the wall
  probe->SetBounces(1);
  vtkNew<vtkIBLRenderPass> ibl;
  ibl->SetEnvironment(environment);
  ibl->BackgroundVisibleOn();
  ibl->SetBackgroundBlur(0.5);
  ibl->GetProbes()->AddItem(probe);
  ibl->GetProbes()->SetFaceSize(256);
  renderer->SetPass(ibl);

  vtkNew<vtkIBLOffscreenWindow> window;
  window->SetSize(1100, 560);
  window->SetMultiSamples(8);
  window->AddRenderer(renderer);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(-1.0, 0.0, 0.0);
  camera->SetPosition(-10.0, 17.0, 35.0);
  renderer->ResetCameraClippingRange();
  window->Render();
  const vtkIBLStatistics* statistics = ibl->GetLighting()->GetStatistics();
  for (const int kind : { vtkIBLStatistics::ProbeFaces, vtkIBLStatistics::ProbeLayers })
  {
    std::printf("%s: %lld in %.1f ms\n", vtkIBLStatistics::GetKindName(kind),
      static_cast<long long>(statistics->GetCount(kind)), 1000.0 * statistics->GetSeconds(kind));
  }
  PrintStages(ibl);
  return WritePicture(window, output) ? 0 : 1;
}
