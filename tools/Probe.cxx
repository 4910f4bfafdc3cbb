// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkibl probe: the light at a place among meshes, as a file that lights them.
#include "Tool.h"

#include "vtkIBLProbe.h"
#include "vtkIBLProbeCollection.h"
#include "vtkIBLRenderPass.h"

#include <vtkRenderer.h>

#include <cstdio>
#include <memory>

namespace
{
struct ProbeOptions
{
  tool::Scene Scene;
  std::string Output;
  std::vector<double> Position, Box, Ellipsoid; // empty: not given
  int Bounces = 0;
  int FaceSize = 128;
};

void SetProxy(vtkIBLProbe* probe, const ProbeOptions& options, vtkRenderer* renderer)
{
  probe->FitToScene(renderer);
  if (!options.Box.empty() || !options.Ellipsoid.empty())
  {
    probe->SetProxy(options.Box.empty() ? vtkIBLProbe::Ellipsoid : vtkIBLProbe::Box);
    probe->SetBounds((options.Box.empty() ? options.Ellipsoid : options.Box).data());
  }
  probe->SetPosition(options.Position[0], options.Position[1], options.Position[2]);
  tool::ThrowIfError();
}

void Probe(const ProbeOptions& options)
{
  tool::Progress progress;
  tool::CheckOutput(options.Output);
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkIBLRenderPass> ibl;
  vtkNew<vtkIBLProbe> probe;
  vtkNew<vtkIBLOffscreenWindow> window;
  tool::MakeScene(options.Scene, renderer, ibl, progress);
  SetProxy(probe, options, renderer);
  probe->SetBounces(options.Bounces);
  ibl->GetProbes()->SetFaceSize(options.FaceSize);
  ibl->GetProbes()->AddItem(probe);
  tool::StartWindow(window, { 64, 64 });
  window->AddRenderer(renderer);
  progress.Set(0.4, "capturing");
  const vtkSmartPointer<vtkImageData> radiance = ibl->CaptureProbe(renderer, probe);
  tool::ThrowIfError();
  probe->WriteFile(options.Output.c_str(), radiance);
  tool::ThrowIfError();
  progress.Finish();
  std::printf("wrote %s\n", options.Output.c_str());
}

CLI::Option* AddBounds(CLI::App* command, const std::string& name, std::vector<double>& bounds, const std::string& help)
{
  const auto parse = [name, &bounds](const std::vector<double>& numbers)
  {
    for (int i = 0; i < 3; ++i)
    {
      if (!(numbers[2 * i] < numbers[2 * i + 1]))
      {
        throw CLI::ValidationError(name, "each first number has to be below its second");
      }
    }
    bounds = numbers;
  };
  return command->add_option_function<std::vector<double>>(name, parse, help)
    ->expected(6)
    ->check(tool::InRange(-1e30, 1e30))
    ->type_name("XMIN XMAX YMIN YMAX ZMIN ZMAX");
}
}

void tool::AddProbe(CLI::App& app)
{
  auto options = std::make_shared<ProbeOptions>();
  CLI::App* command = app.add_subcommand("probe", "Captures the light at a place among meshes.");
  command->footer("Example:\n  vtkibl probe room.stl --environment sky.exr --position 0 1.6 0 --output probe.exr\n"
                  "  vtkibl render room.stl --environment sky.exr --probe probe.exr --output room.png\n\n"
                  "OUT is an OpenEXR of six parts, +X -X +Y -Y +Z -Z, with the rest in its header. Reflections are\n"
                  "looked up on the proxy: what is on it is shown where it is. The probe lights all inside, and a\n"
                  "tenth of the proxy's shortest side around it.");
  AddScene(command, options->Scene);
  command->add_option("--position", options->Position, "Where the light is captured")
    ->required()
    ->expected(3)
    ->check(InRange(-1e30, 1e30))
    ->type_name("X Y Z");
  CLI::Option* box = AddBounds(command, "--box", options->Box, "A box as proxy; default: the meshes' bounds");
  AddBounds(command, "--ellipsoid", options->Ellipsoid, "An ellipsoid as proxy, that touches this box")->excludes(box);
  command->add_option("--bounces", options->Bounces, "Times that light goes between the meshes, in [0, 8]; default 0")
    ->check(InRange(0, 8))
    ->type_name("N");
  command->add_option("--size", options->FaceSize, "Texels along a face's edge; default 128")
    ->check(CLI::IsMember({ 32, 64, 128, 256, 512, 1024 }))
    ->type_name("N");
  command->add_option("--output", options->Output, "Probe to write: .exr")
    ->required()
    ->check(HasExtension({ ".exr" }))
    ->type_name("OUT");
  command->callback([options] { Probe(*options); });
}
