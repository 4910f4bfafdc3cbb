// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkIBLBenchmark: run time against error. One command runs everything and writes results.json, RESULTS.md and plots/.
#include "Benchmark.h"

#include "vtkIBLCache.h"

#include <CLI/CLI.hpp>

#include <vtkObject.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>

namespace
{
using namespace vtkIBLBenchmark;

void Prepare(Session& session)
{
  session.LoadAverage = GetLoadAverage();
  session.Window->SetSize(64, 64);
  if (!session.Window->SupportsOpenGL())
  {
    throw std::runtime_error(session.Window->GetOpenGLSupportMessage());
  }
  session.Renderer = session.Window->GetRendererName();
  std::printf("%s\n", session.Renderer.c_str());
  for (const std::string& name : session.Options.Maps)
  {
    session.Maps.push_back(LoadMap(name));
  }
  session.Engines = { MakeSpectral(session), MakeSampled(session), MakeVTK(session), MakeCmgen(session) };
}

int Run(Session& session)
{
  std::filesystem::create_directories(session.Options.Output);
  Prepare(session);
  RunStages(session);
  RunShading(session);
  RunFrames(session);
  RunProbes(session);
  RunThreads(session);
  RunGrowth(session);
  RunFunctions(session);
  WriteJson(session);
  WriteMarkdown(session);
  WritePlots(session);
  const std::string fault = CheckSchema(session.Options.Output + "/results.json");
  if (!fault.empty())
  {
    std::fprintf(stderr, "results.json: %s\n", fault.c_str());
  }
  const std::vector<std::string> misses = CheckBounds(session);
  for (const std::string& miss : misses)
  {
    std::fprintf(stderr, "%s\n", miss.c_str());
  }
  return fault.empty() && misses.empty() ? 0 : 1;
}
}

int main(int argc, char* argv[])
{
  unsetenv("DISPLAY"); // an offscreen context needs none, and is the same with and without
  Session session;
  Options& options = session.Options;
  std::string firstFrame;
  bool fromFile = false;
  vtkIBLCache::SetEnabled(false); // what is timed is made
  CLI::App app("Run time against error of image-based lighting, with VTK's own and Filament's cmgen beside it.");
  app.add_flag("--quick", options.Quick, "one map, few directions and repetitions: a test, not a measurement");
  app.add_option("--output", options.Output, "folder for results.json, RESULTS.md and plots/");
  app.add_option("--maps", options.Maps, "studio lights of blender-data")->delimiter(',');
  CLI::Option* repeat = app.add_option("--repeat", options.Repeat, "runs behind a median")->check(CLI::Range(3, 1000));
  app.add_option("--only", options.Only,
    "panels whose name starts so, e.g. layer or \"growth source\"; spectrum: harmonics and layers once, "
    "on one thread, and no report");
  app.add_option("--first-frame", firstFrame,
    "render one first frame of an engine and print its seconds and its hits in vtkIBL's cache");
  app.add_flag(
    "--from-file", fromFile, "with --first-frame: read the map in that frame, out of the cache if it is there");
  CLI11_PARSE(app, argc, argv);
  if (options.Maps.empty())
  {
    options.Maps = options.Quick
      ? std::vector<std::string>{ "courtyard" }
      : std::vector<std::string>{ "city", "courtyard", "forest", "interior", "night", "studio", "sunrise", "sunset" };
  }
  if (options.Quick)
  {
    options.Directions = 48;
    options.Repeat = repeat->count() > 0 ? options.Repeat : 2;
  }
  try
  {
    if (!firstFrame.empty())
    {
      return RunFirstFrame(firstFrame, options.Maps.front(), fromFile);
    }
    return options.Only == "spectrum" ? RunSpectrum(options.Maps.front()) : Run(session);
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "vtkIBLBenchmark: %s\n", error.what());
    return 1;
  }
}
