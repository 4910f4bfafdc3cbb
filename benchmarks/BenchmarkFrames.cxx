// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What a user waits for: the first frame and every later one, of a metal sphere, judged by the full reflection
// integral.
#include "BenchmarkScene.h"

#include "BenchmarkPeers.h"
#include "vtkIBLCache.h"

#include <vtkCamera.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>

#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace reference = vtkIBLReference;

namespace vtkIBLBenchmark
{
namespace
{
constexpr int PictureSize = 512;
constexpr int Resolution = 222; // 2 * 222 * 221 = 98124 triangles
constexpr double Roughness = 0.4;

vtkSmartPointer<vtkPolyData> MakeSphere()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(Resolution);
  sphere->SetPhiResolution(Resolution);
  sphere->SetRadius(1);
  sphere->Update();
  return sphere->GetOutput();
}

/// A white metal sphere that fills most of the picture, seen from afar along -z.
class Sphere : public Scene
{
public:
  Sphere(const FrameEngine& engine, const Map& map, bool fromFile = false)
    : Scene(engine, map, MakeSphere(), PictureSize, PictureSize, fromFile)
  {
    this->GetProperty()->SetColor(1, 1, 1);
    this->GetProperty()->SetMetallic(1);
    this->GetProperty()->SetRoughness(Roughness);
    vtkCamera* camera = this->GetCamera();
    camera->SetPosition(0, 0, 100); // far, for VTK takes every eye for a perspective one
    camera->SetFocalPoint(0, 0, 0);
    camera->SetViewUp(0, 1, 0);
    camera->SetViewAngle(2 * std::atan(1.1 / 100) * 180 / reference::Pi);
    camera->SetClippingRange(90, 110);
  }
};

/// Error of the picture against the full integral.
Error JudgePicture(const Session& session, Scene& scene, const Map& map)
{
  vtkSmartPointer<vtkImageData> picture = scene.Capture();
  // A Fibonacci spiral over the disc, out to N.V = 0.3: further out a pixel covers too many directions.
  const int count = session.Options.Quick ? 24 : 96;
  std::vector<RGB> values;
  std::vector<Vec3> normals;
  const double scale = PictureSize / 2.2; // pixels a unit, at the distance of the sphere's centre
  for (int i = 0; i < count; ++i)
  {
    const double radius = std::sqrt((i + 0.5) / count) * 0.95;
    const double angle = reference::Pi * (3 - std::sqrt(5.0)) * i;
    const int column = int(std::floor(PictureSize / 2 + scale * radius * std::cos(angle)));
    const int row = int(std::floor(PictureSize / 2 + scale * radius * std::sin(angle)));
    const double x = (column + 0.5 - PictureSize / 2) / scale;
    const double y = (row + 0.5 - PictureSize / 2) / scale;
    normals.push_back({ x, y, std::sqrt(1 - x * x - y * y) });
    const auto* rgba = static_cast<const float*>(picture->GetScalarPointer(column, row, 0));
    values.push_back({ rgba[0], rgba[1], rgba[2] });
  }
  const auto truth = reference::Cached<RGB>(
    "benchmark picture " + std::to_string(Roughness) + reference::KeyOf(map.Reference) + reference::KeyOf(normals),
    [&]
    {
      std::vector<RGB> rgb(normals.size());
      reference::ParallelFor(int(normals.size()),
        [&](int i) {
          rgb[i] =
            reference::FullBRDFRadiance(map.Reference, normals[i], { 0, 0, 1 }, Roughness, { 1, 1, 1 }, { 0, 0, 0 });
        });
      return rgb;
    });
  return Judge(values, truth);
}

/// The steady frame's, if that is known, or a new one's: the picture is the same.
Error FindPictureError(const Session& session, const FrameEngine& engine, const Map& map)
{
  for (const Row& row : session.Rows)
  {
    if (row.Panel == "steady frame" && row.Setting == engine.Setting && row.Map == map.Name && row.Error)
    {
      return *row.Error;
    }
  }
  Sphere scene(engine, map);
  scene.Render();
  return JudgePicture(session, scene, map);
}

void RunSteadyFrame(Session& session, const FrameEngine& engine, const Map& map)
{
  Sphere scene(engine, map);
  scene.Render();
  Row row("steady frame", engine.Name, engine.Setting, map.Name);
  if (engine.IsLit())
  {
    row.Error = JudgePicture(session, scene, map);
    scene.Render();
  }
  row.Samples = Repeat([&] { return scene.Render(); }, session.Options.Repeat, 1.5, 2);
  row.Default = true;
  row.Note =
    engine.SamplesPerPixel > 0 ? "the reflection integral itself, estimated in every pixel: slow, and converges" : "";
  session.Add(row);
}

/// How warm a process starts.
struct Start
{
  const char* Name;
  const char* Variables; // of the environment
  bool FromFile;
  bool FromCache;
  double Budget; // seconds of repetition
};

void RunFirstFrames(Session& session, const FrameEngine& engine, const Start& start)
{
  const Map& map = session.Maps.front();
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command = std::string(start.Variables) + " '" + self + "' --first-frame '" + engine.Setting +
    "' --maps " + map.Name + (start.FromFile ? " --from-file" : "");
  auto run = [&]
  {
    std::string output;
    RunProcess(command, &output);
    Sample sample;
    int hits = 0;
    if (std::sscanf(output.c_str(), "%lf %lf %d", &sample.Wall, &sample.CPU, &hits) != 3)
    {
      throw std::runtime_error("\"" + command + "\" printed: " + output);
    }
    return std::make_pair(sample, hits);
  };
  // The first fills the cache, if there is one.
  const bool cached = start.FromFile && (run(), run().second == 1);
  if (cached != start.FromCache)
  {
    throw std::runtime_error("\"" + command + "\" " + (cached ? "found" : "did not find") + " its light in the cache");
  }
  const auto time = [&] { return run().first; };
  Row row("first frame", engine.Name, std::string(engine.Setting) + start.Name, map.Name);
  if (engine.IsLit())
  {
    row.Error = FindPictureError(session, engine, map);
  }
  row.Samples = session.Options.Quick ? Repeat(time, 1, 0, 1) : Repeat(time, session.Options.Repeat, start.Budget);
  row.Default = true;
  session.Add(row);
}
}

int RunFirstFrame(const std::string& setting, const std::string& map, bool fromFile)
{
  const Map loaded = LoadMap(map);
  vtkIBLCache::SetEnabled(fromFile); // VTKIBL_CACHE says whether of the disk, too
  Sphere scene(FindEngine(setting), loaded, fromFile);
  const Sample sample = scene.Render();
  std::printf("%.6f %.6f %d\n", sample.Wall, sample.CPU, int(vtkIBLCache::GetNumberOfDiskHits()));
  return 0;
}

void RunFrames(Session& session)
{
  if (session.Wants("steady frame"))
  {
    for (const Map& map : session.Maps)
    {
      for (const FrameEngine& engine : FrameEngines)
      {
        if (engine.IsInteractive() && (!session.Options.Quick || engine.SamplesPerPixel <= 16))
        {
          RunSteadyFrame(session, engine, map);
        }
      }
    }
  }
  if (session.Wants("first frame"))
  {
    const std::string folder = MakeScratchFolder();
    const std::string cached = "VTKIBL_CACHE=on XDG_CACHE_HOME='" + folder + "'";
    const Start warm{ "", "", false, false, 25 };
    const Start cold{ ", cold", "MESA_SHADER_CACHE_DISABLE=true", false, false, 15 };
    const Start fromFile{ ", from the file", "VTKIBL_CACHE=off", true, false, 15 };
    const Start fromCache{ ", cached", cached.c_str(), true, true, 15 };
    for (const FrameEngine& engine : FrameEngines)
    {
      if (engine.SamplesPerPixel > 0)
      {
        continue;
      }
      RunFirstFrames(session, engine, warm);
      if (engine.PBR && !session.Options.Quick)
      {
        RunFirstFrames(session, engine, cold);
      }
      if (engine.SamplesPerPixel == 0)
      {
        RunFirstFrames(session, engine, fromFile);
        RunFirstFrames(session, engine, fromCache);
      }
    }
    std::filesystem::remove_all(folder);
  }
}
}
