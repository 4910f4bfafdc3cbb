// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkibl render: meshes of one material in an environment's light.
#include "Tool.h"

#include "vtkIBLLighting.h"
#include "vtkIBLProbe.h"
#include "vtkIBLProbeCollection.h"
#include "vtkIBLRenderPass.h"

#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <cstdio>
#include <memory>

namespace
{
constexpr double BlurredBackground = 0.4; // perceptualRoughness of the mirror that shows it

struct RenderOptions
{
  tool::Scene Scene;
  std::vector<std::string> Probes;
  std::string Output;
  tool::Size Size = { 1280, 800 };
  std::string Background = "show";
  int Samples = 0;
};

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
  tool::MakeScene(options.Scene, renderer, ibl, progress);
  for (const std::string& fileName : options.Probes)
  {
    ibl->GetProbes()->AddItem(tool::ReadProbe(fileName));
  }
  ibl->SetBackgroundVisible(options.Background != "hide");
  ibl->SetBackgroundBlur(options.Background == "blur" ? BlurredBackground : 0.0);
  ibl->GetLighting()->SetSamplesPerPixel(options.Samples);

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
}

void tool::AddRender(CLI::App& app)
{
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Takes a picture of meshes in an environment's light.");
  command->footer("Example:\n  vtkibl render part.stl --environment studio.exr --output part.png --roughness 0.2\n\n"
                  "A .png is what a screen shows (power 1/2.2, clamped); an .exr is linear float radiance with alpha,\n"
                  "upright. Meshes have one material; their data arrays and colors are not shown.");
  AddScene(command, options->Scene);
  command
    ->add_option(
      "--probe", options->Probes, "Light at a place, from a file of 'vtkibl probe'; may be given more than once")
    ->expected(1)
    ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
    ->type_name("IN");
  command->add_option("--output", options->Output, "Picture to write: .png or .exr")
    ->required()
    ->check(HasExtension({ ".png", ".exr" }))
    ->type_name("OUT");
  AddSize(command, options->Size);
  command->add_option("--background", options->Background, "Environment behind the meshes; default show")
    ->check(CLI::IsMember({ "show", "hide", "blur" }))
    ->type_name("HOW");
  command
    ->add_option("--sampled", options->Samples,
      "Shade with N samples a pixel of the reflection integral, in [1, 8192], instead of\n"
      "prefiltered light: slow and right")
    ->check(tool::InRange(1, 8192))
    ->type_name("N");
  command->callback([options] { Render(*options); });
}
