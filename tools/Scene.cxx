// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Tool.h"

#include "vtkIBLRenderPass.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace
{
// All of them are tried, and each that fails is named in a line of its own.
std::vector<vtkSmartPointer<vtkPolyData>> ReadSurfaces(const std::vector<std::string>& fileNames)
{
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces;
  std::string failures;
  for (const std::string& fileName : fileNames)
  {
    try
    {
      surfaces.push_back(tool::ReadSurface(fileName));
    }
    catch (const std::exception& error)
    {
      failures += (failures.empty() ? "" : "\nvtkibl: ") + std::string(error.what());
    }
  }
  if (!failures.empty())
  {
    throw tool::Failure(failures);
  }
  return surfaces;
}
}

void tool::AddScene(CLI::App* command, Scene& scene)
{
  command->add_option("MESH", scene.Meshes, "Meshes: .vtp .vtu .vti .stl .ply .obj")->required()->type_name("");
  command->add_option("--environment", scene.Environment, "Image to light with")->required()->type_name("IN");
  command->add_option("--roughness", scene.Roughness, "Perceptual roughness, in [0, 1]; default 0.3")
    ->check(tool::InRange(0.0, 1.0))
    ->type_name("R");
  command->add_option("--metallic", scene.Metallic, "0 dielectric to 1 metal; default 0")
    ->check(tool::InRange(0.0, 1.0))
    ->type_name("M");
  tool::AddNumbers(
    command, "--color", scene.Color, ',', 0.0, 1.0, "R,G,B", "Linear albedo, each in [0, 1]; default 0.8,0.8,0.8");
  command->add_option("--rotation", scene.Rotation, "Turns the environment about +y, in degrees; default 0")
    ->check(tool::InRange(-1e6, 1e6))
    ->type_name("DEG");
  command->add_option("--intensity", scene.Intensity, "Factor on all light, in [0, 1e6]; default 1")
    ->check(tool::InRange(0.0, 1e6))
    ->type_name("X");
}

void tool::MakeScene(const Scene& scene, vtkRenderer* renderer, vtkIBLRenderPass* ibl, Progress& progress)
{
  for (const vtkSmartPointer<vtkPolyData>& surface : ReadSurfaces(scene.Meshes))
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(surface);
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetInterpolationToPBR();
    actor->GetProperty()->SetRoughness(scene.Roughness);
    actor->GetProperty()->SetMetallic(scene.Metallic);
    actor->GetProperty()->SetColor(scene.Color[0], scene.Color[1], scene.Color[2]);
    renderer->AddActor(actor);
  }
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Azimuth(30.0);
  renderer->GetActiveCamera()->Elevation(15.0);
  renderer->ResetCamera();
  const vtkSmartPointer<vtkIBLEnvironment> environment = ReadEnvironment(scene.Environment, progress);
  environment->SetRotation(scene.Rotation);
  environment->SetIntensity(scene.Intensity);
  ibl->SetEnvironment(environment);
  renderer->SetPass(ibl);
}
