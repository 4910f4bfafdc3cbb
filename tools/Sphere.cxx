// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkibl sphere: a measurement that anyone can check: pixels of a sphere, and all it takes to recompute them.
#include "Tool.h"

#include "vtkIBLLighting.h"
#include "vtkIBLRenderPass.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkMath.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

using tool::JSON;

namespace
{
constexpr int Resolution = 512; // facets around and from pole to pole
constexpr double Distance = 4.0;

struct SphereOptions
{
  std::string Environment;
  std::string Output;
  tool::Size Size = { 512, 512 };
  double Roughness = 0.5;
  double Metallic = 1.0;
  double Albedo = 1.0;
  std::string Shading = "fitted";
  int Samples = 1024;
  std::string Compensation; // "": as the shading has it

  int GetSamplesPerPixel() const { return this->Shading == "sampled" ? this->Samples : 0; }
  bool GetCompensation() const
  {
    return this->Compensation.empty() ? this->Shading != "sampled" : this->Compensation == "on";
  }
};

// On a facet with the corners' normals interpolated, the normal is that of the sphere's point straight outside: N is
// parallel to the point that is seen. But that point lies up to this far below the unit sphere, so a ray that meets the
// true one at the angle a to its normal is off by that times tan(a) [rad]. A facet of sides p and q has
// (p^2 + q^2)/8: 2.4e-5 at 512 x 512.
double GetLargestDepth()
{
  const double around = 2.0 * vtkMath::Pi() / Resolution;
  const double along = vtkMath::Pi() / (Resolution - 1);
  return (around * around + along * along) / 8.0;
}

void AddSphereActor(vtkRenderer* renderer, const SphereOptions& options)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1.0);
  source->SetThetaResolution(Resolution);
  source->SetPhiResolution(Resolution);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToPBR();
  actor->GetProperty()->SetRoughness(options.Roughness);
  actor->GetProperty()->SetMetallic(options.Metallic);
  actor->GetProperty()->SetColor(options.Albedo, options.Albedo, options.Albedo);
  renderer->AddActor(actor);
}

void AimCamera(vtkCamera* camera, tool::Size size)
{
  camera->SetPosition(0.0, 0.0, Distance);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetViewUp(0.0, 1.0, 0.0);
  // The outline, with 4 % of room, fits the smaller side; the angle is that of the height.
  const double outline = std::tan(std::asin(1.0 / Distance));
  const double half = 1.04 * outline * std::max(1.0, double(size.Height) / size.Width);
  camera->SetViewAngle(2.0 * vtkMath::DegreesFromRadians(std::atan(half)));
  camera->SetClippingRange(Distance - 1.5, Distance + 1.5);
}

JSON DescribeSphere(const SphereOptions& options, vtkIBLEnvironment* environment, vtkCamera* camera)
{
  const auto vector = [](const double* x) { return JSON{ x[0], x[1], x[2] }; };
  const double baseF0 = 0.04; // VTK's default index of refraction, 1.5
  JSON json = { { "format", "vtkibl-sphere" }, { "version", tool::FormatVersion }, { "generator", tool::Generator },
    { "image", std::filesystem::path(options.Output).filename().string() },
    { "size", { { "width", options.Size.Width }, { "height", options.Size.Height } } },
    { "rowOrder", "top-down: row 0 is the top of the picture, column 0 its left" },
    { "exposureScale", 1.0 }, // radiance = value * exposureScale
    { "camera",
      { { "projection", "perspective" }, { "position", vector(camera->GetPosition()) },
        { "focalPoint", vector(camera->GetFocalPoint()) }, { "viewUp", vector(camera->GetViewUp()) },
        { "viewAngle", camera->GetViewAngle() }, { "viewAngleIs", "of the height, in degrees" } } },
    { "pixelRay",
      "forward + right * tan(viewAngle/2) * width/height * (2 (column + 0.5)/width - 1) "
      "+ up * tan(viewAngle/2) * (1 - 2 (row + 0.5)/height); right = forward x viewUp; one ray a pixel" },
    { "sphere",
      { { "center", { 0, 0, 0 } }, { "radius", 1 }, { "facets", { Resolution, Resolution } },
        { "largestDepth", GetLargestDepth() },
        { "normalError", "at most largestDepth * tan(angle of N and V), in radians" } } } };
  json["material"] = { { "perceptualRoughness", options.Roughness }, { "metallic", options.Metallic },
    { "albedo", options.Albedo }, { "baseF0", baseF0 }, { "f0", baseF0 + options.Metallic * (options.Albedo - baseF0) },
    { "f90", 1.0 } };
  json["shading"] = options.Shading;
  json["shadingIs"] = options.Shading == "sampled" ? "the reflection integral: GGX, height-correlated Smith, Schlick"
    : options.Shading == "fitted"
    ? "lobes fitted to it in prefiltered light, times A f0 + B f90; the strongest lamps exactly"
    : "lobes fitted to it in prefiltered light, times A f0 + B f90";
  json["energyCompensation"] = options.GetCompensation();
  json["energyCompensationIs"] = "light scattered more than once given back (Fdez-Aguera 2019): white stays white";
  json["samplesPerPixel"] = options.GetSamplesPerPixel();
  json["environment"] = tool::DescribeEnvironment(options.Environment, environment);
  json["environment"]["convention"] =
    "lat-long: u = atan2(d.z, d.x)/2pi + 1/2 from the left, v = asin(d.y)/pi + 1/2 from the bottom";
  return json;
}

std::vector<float> Capture(vtkIBLRenderPass* ibl, vtkRenderer* renderer)
{
  const vtkSmartPointer<vtkImageData> radiance = ibl->CaptureRadiance(renderer);
  tool::ThrowIfError();
  if (!radiance || radiance->GetNumberOfPoints() == 0)
  {
    throw tool::Failure("no float picture could be taken");
  }
  const auto* rgba = static_cast<const float*>(radiance->GetScalarPointer());
  std::vector<float> rgb;
  for (vtkIdType i = 0; i < radiance->GetNumberOfPoints(); ++i, rgba += 4)
  {
    rgb.insert(rgb.end(), rgba, rgba + 3);
  }
  return tool::FlipRows(rgb.data(), radiance->GetDimensions()[0], radiance->GetDimensions()[1], 3);
}

void Sphere(const SphereOptions& options)
{
  tool::Progress progress;
  std::filesystem::path description = options.Output;
  description.replace_extension(".json");
  tool::CheckOutput(options.Output);
  tool::CheckOutput(description);

  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkIBLRenderPass> ibl;
  vtkNew<vtkIBLOffscreenWindow> window;
  const vtkSmartPointer<vtkIBLEnvironment> environment = tool::ReadEnvironment(options.Environment, progress);
  ibl->SetEnvironment(environment);
  ibl->GetLighting()->SetSamplesPerPixel(options.GetSamplesPerPixel());
  ibl->GetLighting()->SetEnergyCompensation(options.GetCompensation());
  ibl->GetLighting()->SetBrightTexels(options.Shading == "fitted");
  AddSphereActor(renderer, options);
  AimCamera(renderer->GetActiveCamera(), options.Size);
  renderer->SetBackground(0.0, 0.0, 0.0);
  renderer->SetPass(ibl);
  tool::StartWindow(window, options.Size);
  window->AddRenderer(renderer);
  progress.Set(0.4, "light and picture");

  const std::vector<float> picture = Capture(ibl, renderer);
  tool::OutputFiles files;
  files.Add(options.Output,
    tool::EncodeEXR(options.Size.Width, options.Size.Height, { "R", "G", "B" }, picture.data(),
      { { "ImageDescription", "linear radiance of a unit sphere; see " + description.filename().string() } }));
  files.Add(description, tool::EncodeJSON(DescribeSphere(options, environment, renderer->GetActiveCamera())));
  files.Commit();
  progress.Finish();
  std::printf("wrote %s and %s\n", options.Output.c_str(), description.c_str());
}

void AddMaterial(CLI::App* command, SphereOptions& options)
{
  command->add_option("--roughness", options.Roughness, "Perceptual roughness, in [0, 1]; default 0.5")
    ->check(tool::InRange(0.0, 1.0))
    ->type_name("R");
  command->add_option("--metallic", options.Metallic, "0 dielectric to 1 metal; default 1")
    ->check(tool::InRange(0.0, 1.0))
    ->type_name("M");
  command->add_option("--albedo", options.Albedo, "Linear grey albedo (a metal's f0), in [0, 1]; default 1")
    ->check(tool::InRange(0.0, 1.0))
    ->type_name("A");
  command
    ->add_option("--shading", options.Shading,
      "fast: fitted lobes in prefiltered light; fitted: the same, and the strongest lamps\n"
      "exactly, what the library renders with; sampled: the reflection integral itself;\n"
      "default fitted")
    ->check(CLI::IsMember({ "fast", "fitted", "sampled" }))
    ->type_name("HOW");
  command->add_option("--samples", options.Samples, "Samples a pixel of 'sampled', in [1, 8192]; default 1024")
    ->check(tool::InRange(1, 8192))
    ->type_name("N");
  command
    ->add_option("--compensation", options.Compensation,
      "Give back the light that rough surfaces scatter more than once; default on for fast\n"
      "and fitted, and off for sampled, which is then the plain integral of GGX")
    ->check(CLI::IsMember({ "on", "off" }))
    ->type_name("HOW");
}
}

void tool::AddSphere(CLI::App& app)
{
  auto options = std::make_shared<SphereOptions>();
  CLI::App* command = app.add_subcommand("sphere",
    "Measures the radiance of a lit unit sphere: a float OpenEXR, and a JSON file to recompute each pixel's N and V "
    "by.");
  command->footer(
    "Example:\n  vtkibl sphere --environment studio.exr --output metal.exr --roughness 0.4 --metallic 1\n\n"
    "Also writes metal.json: camera, size, row order, material and conventions. The sphere is at the\n"
    "origin, there are no other lights, and pixels beside it are 0.");
  command->add_option("--environment", options->Environment, "Image to light with")->required()->type_name("IN");
  command->add_option("--output", options->Output, "Picture to write: .exr")
    ->required()
    ->check(HasExtension({ ".exr" }))
    ->type_name("OUT");
  AddSize(command, options->Size);
  AddMaterial(command, *options);
  command->callback([options] { Sphere(*options); });
}
