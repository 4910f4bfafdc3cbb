// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkibl render: meshes of one material in an environment's light.
#include "Tool.h"

#include "vtkIBLLighting.h"
#include "vtkIBLRenderPass.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <cstdio>
#include <memory>

namespace
{
constexpr double BlurredBackground = 0.4; // perceptualRoughness of the mirror that shows it

struct RenderOptions
{
  std::vector<std::string> Meshes;
  std::string Environment;
  std::string Output;
  tool::Size Size = { 1280, 800 };
  double Roughness = 0.3;
  double Metallic = 0.0;
  std::vector<double> Color = { 0.8, 0.8, 0.8 };
  double Rotation = 0.0;
  double Intensity = 1.0;
  std::string Background = "show";
  int Samples = 0;
};

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

void AddActors(vtkRenderer* renderer, const RenderOptions& options)
{
  for (const vtkSmartPointer<vtkPolyData>& surface : ReadSurfaces(options.Meshes))
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(surface);
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetInterpolationToPBR();
    actor->GetProperty()->SetRoughness(options.Roughness);
    actor->GetProperty()->SetMetallic(options.Metallic);
    actor->GetProperty()->SetColor(options.Color[0], options.Color[1], options.Color[2]);
    renderer->AddActor(actor);
  }
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Azimuth(30.0);
  renderer->GetActiveCamera()->Elevation(15.0);
  renderer->ResetCamera();
}

tool::Bytes Photograph(vtkIBLRenderPass* ibl, vtkRenderer* renderer, vtkIBLOffscreenWindow* window, bool linear)
{
  if (linear)
  {
    const vtkSmartPointer<vtkImageData> radiance = ibl->CaptureRadiance(renderer);
    tool::ThrowIfError();
    if (!radiance || radiance->GetNumberOfPoints() == 0)
    {
      throw tool::Failure("no float picture could be taken");
    }
    const int* size = radiance->GetDimensions();
    const auto* rgba = static_cast<const float*>(radiance->GetScalarPointer());
    return tool::EncodeEXR(size[0], size[1], { "R", "G", "B", "A" }, tool::FlipRows(rgba, size[0], size[1], 4).data(),
      { { "ImageDescription", "linear radiance" } });
  }
  window->Render();
  tool::ThrowIfError();
  const int* size = window->GetSize();
  vtkNew<vtkUnsignedCharArray> rgb;
  window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, rgb, 0);
  return tool::EncodePNG(size[0], size[1], tool::FlipRows(rgb->GetPointer(0), size[0], size[1], 3).data());
}

void Render(const RenderOptions& options)
{
  tool::Progress progress;
  tool::CheckOutput(options.Output);
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkIBLRenderPass> ibl;
  vtkNew<vtkIBLOffscreenWindow> window;
  AddActors(renderer, options);
  const vtkSmartPointer<vtkIBLEnvironment> environment = tool::ReadEnvironment(options.Environment, progress);
  environment->SetRotation(options.Rotation);
  environment->SetIntensity(options.Intensity);
  ibl->SetEnvironment(environment);
  ibl->SetBackgroundVisible(options.Background != "hide");
  ibl->SetBackgroundBlur(options.Background == "blur" ? BlurredBackground : 0.0);
  ibl->GetLighting()->SetSamplesPerPixel(options.Samples);
  renderer->SetPass(ibl);

  tool::StartWindow(window, options.Size);
  window->SetMultiSamples(8); // the picture on a screen; an EXR's pixels are one ray each
  window->AddRenderer(renderer);
  renderer->ResetCameraClippingRange();
  progress.Set(0.4, "light and picture");
  const bool linear = tool::Extension(options.Output) == ".exr";
  tool::OutputFiles files;
  files.Add(options.Output, Photograph(ibl, renderer, window, linear));
  files.Commit();
  progress.Finish();
  std::printf("wrote %s\n", options.Output.c_str());
}

void AddMaterialAndLight(CLI::App* command, RenderOptions& options)
{
  command->add_option("--roughness", options.Roughness, "Perceptual roughness, in [0, 1]; default 0.3")
    ->check(tool::InRange(0.0, 1.0))
    ->type_name("R");
  command->add_option("--metallic", options.Metallic, "0 dielectric to 1 metal; default 0")
    ->check(tool::InRange(0.0, 1.0))
    ->type_name("M");
  tool::AddNumbers(
    command, "--color", options.Color, ',', 0.0, 1.0, "R,G,B", "Linear albedo, each in [0, 1]; default 0.8,0.8,0.8");
  command->add_option("--rotation", options.Rotation, "Turns the environment about +y, in degrees; default 0")
    ->check(tool::InRange(-1e6, 1e6))
    ->type_name("DEG");
  command->add_option("--intensity", options.Intensity, "Factor on all light, in [0, 1e6]; default 1")
    ->check(tool::InRange(0.0, 1e6))
    ->type_name("X");
  command->add_option("--background", options.Background, "Environment behind the meshes; default show")
    ->check(CLI::IsMember({ "show", "hide", "blur" }))
    ->type_name("HOW");
  command
    ->add_option("--sampled", options.Samples,
      "Shade with N samples a pixel of the reflection integral, in [1, 8192], instead of\n"
      "prefiltered light: slow and right")
    ->check(tool::InRange(1, 8192))
    ->type_name("N");
}
}

void tool::AddRender(CLI::App& app)
{
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Takes a picture of meshes in an environment's light.");
  command->footer("Example:\n  vtkibl render part.stl --environment studio.exr --output part.png --roughness 0.2\n\n"
                  "A .png is what a screen shows (power 1/2.2, clamped); an .exr is linear float radiance with alpha,\n"
                  "upright. Meshes have one material; their data arrays and colors are not shown.");
  command->add_option("MESH", options->Meshes, "Meshes: .vtp .vtu .vti .stl .ply .obj")->required()->type_name("");
  command->add_option("--environment", options->Environment, "Image to light with")->required()->type_name("IN");
  command->add_option("--output", options->Output, "Picture to write: .png or .exr")
    ->required()
    ->check(HasExtension({ ".png", ".exr" }))
    ->type_name("OUT");
  AddSize(command, options->Size);
  AddMaterialAndLight(command, *options);
  command->callback([options] { Render(*options); });
}
