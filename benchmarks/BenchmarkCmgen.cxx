// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Filament's cmgen, a process of its own for each run; what it made is read from the files that it wrote.
#include "BenchmarkPeers.h"

#include "vtkIBLGLHeader.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

namespace reference = vtkIBLReference;

namespace vtkIBLBenchmark
{
namespace
{
constexpr int FaceSize = 256;
constexpr int Levels = 5;
constexpr const char* Folder = "out";

/// A folder for files that goes when the last one lets go of it.
class Scratch
{
public:
  Scratch()
    : Path(MakeScratchFolder())
  {
  }
  ~Scratch()
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Path, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const std::string Path;
};
using Place = std::shared_ptr<Scratch>;

Place MakePlace(vtkImageData* panorama)
{
  auto place = std::make_shared<Scratch>();
  WriteEXR(panorama, place->Path + "/in.exr");
  return place;
}

Sample Run(const Place& place, const std::string& arguments)
{
  return RunProcess("cd " + place->Path + " && cmgen -q -f psd -c 32 " + arguments + " 2>&1");
}

std::string LayerArguments(int faceSize, int samples)
{
  return "--size=" + std::to_string(faceSize) + " --ibl-ld=" + Folder + " --ibl-samples=" + std::to_string(samples) +
    " in.exr";
}

const char* const HarmonicsArguments = "--sh=3 --sh-window=no --sh-output=sh.txt in.exr";
const char* const TableArguments = "--size=256 --ibl-dfg=dfg.psd";

/// cmgen filters for roughness 1 - sqrt(1 - lod) at level lod * 4.
double GetRoughness(int level)
{
  return 1 - std::sqrt(1 - double(level) / (Levels - 1));
}

CubeWork MakeCube(const Map& map, int faceSize)
{
  const Place place = MakePlace(map.Image);
  CubeWork work;
  work.Run = [=] { return Run(place, "--size=" + std::to_string(faceSize) + " --extract=" + Folder + " in.exr"); };
  work.Run();
  work.Result = ReadCmgenCube(place->Path + "/" + Folder + "/in/");
  return work;
}

IrradianceWork MakeHarmonics(const Map& map)
{
  const Place place = MakePlace(map.Image);
  IrradianceWork work;
  work.Run = [=] { return Run(place, HarmonicsArguments); };
  work.Run();
  std::ifstream file(place->Path + "/sh.txt");
  std::vector<RGB> coefficients;
  for (std::string line; std::getline(file, line);)
  {
    RGB rgb;
    if (std::sscanf(line.c_str(), " ( %lf , %lf , %lf )", &rgb[0], &rgb[1], &rgb[2]) == 3)
    {
      coefficients.push_back(rgb);
    }
  }
  if (coefficients.size() != 9)
  {
    throw std::runtime_error("cmgen wrote " + std::to_string(coefficients.size()) + " harmonics, not 9");
  }
  work.Bytes = 9 * 3 * sizeof(float);
  work.Read = [=](const std::vector<Vec3>& normals)
  {
    std::vector<RGB> irradiance;
    for (const Vec3& n : normals)
    {
      irradiance.push_back(EvaluateIrradiance(coefficients, { -n.z, n.y, n.x }));
    }
    return irradiance;
  };
  return work;
}

LayersWork MakeLayers(vtkOpenGLRenderWindow* window, const Map& map, int samples)
{
  const Place place = MakePlace(map.Image);
  // Reading the file and making the cube, in the same process, is not prefiltering.
  std::vector<Sample> baselines;
  for (int i = 0; i < 2; ++i)
  {
    baselines.push_back(Run(place, LayerArguments(FaceSize, 1)));
  }
  const Timing baseline = Summarize(baselines);
  LayersWork work;
  work.Run = [=]
  {
    const Sample whole = Run(place, LayerArguments(FaceSize, samples));
    return Sample{ whole.Wall - baseline.Median, whole.CPU - baseline.CPU };
  };
  work.Run();

  window->MakeCurrent();
  GLuint name;
  glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &name);
  glTextureStorage2D(name, Levels, GL_RGB32F, FaceSize, FaceSize);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  work.Fetches = 0;
  work.Bytes = 0;
  for (int level = 0; level < Levels; ++level)
  {
    Cube cube = ReadCmgenCube(place->Path + "/" + Folder + "/in/m" + std::to_string(level) + "_");
    glTextureSubImage3D(name, level, 0, 0, 0, cube.Size, cube.Size, 6, GL_RGB, GL_FLOAT, cube.Texels.data());
    const long long texels = 6LL * cube.Size * cube.Size;
    work.Fetches += level > 0 ? texels * samples : texels;
    work.Bytes += texels * 4; // R11G11B10F, as Filament stores it
    if (level > 0)
    {
      work.Layers.push_back({ GetRoughness(level), std::move(cube) });
    }
  }
  const std::shared_ptr<GLuint> texture(new GLuint(name),
    [window](GLuint* old)
    {
      window->MakeCurrent();
      glDeleteTextures(1, old);
      delete old;
    });
  work.Read = [=](const std::vector<Vec3>& directions, double roughness)
  { return ReadCubeMap(window, *texture, directions, (Levels - 1) * roughness * (2 - roughness)); };
  return work;
}

TableWork MakeTable()
{
  const auto place = std::make_shared<Scratch>();
  TableWork work;
  work.Run = [=] { return Run(place, TableArguments); };
  work.Run();
  const PSD psd = ReadPSD(place->Path + "/dfg.psd");
  std::vector<float> texels; // roughness grows upwards
  for (int j = psd.Height - 1; j >= 0; --j)
  {
    for (int i = 0; i < psd.Width; ++i)
    {
      const float* rgb = psd.RGB.data() + 3 * (std::size_t(j) * psd.Width + i);
      texels.insert(texels.end(), { rgb[0], rgb[1] });
    }
  }
  const int size = psd.Width;
  work.Bytes = 4LL * size * size; // RG16F
  work.Read = [=](double NoV, double roughness) { return ReadCentredTable(texels, size, NoV, roughness); };
  return work;
}

Sample Add(const Sample& a, const Sample& b)
{
  return { a.Wall + b.Wall, a.CPU + b.CPU };
}
}

std::string GetFaceName(int face)
{
  // Filament looks along +z where a panorama's centre is our +x, and mirrors.
  const char* const names[6] = { "pz", "nz", "py", "ny", "nx", "px" };
  return names[face];
}

Cube ReadCmgenCube(const std::string& prefix)
{
  Cube cube;
  for (int face = 0; face < 6; ++face)
  {
    const PSD psd = ReadPSD(prefix + GetFaceName(face) + ".psd");
    const int n = cube.Size = psd.Width;
    cube.Texels.resize(std::size_t(18) * n * n);
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        const int column = face == 2 ? n - 1 - j : face == 3 ? j : i;
        const int row = face == 2 ? i : face == 3 ? n - 1 - i : j;
        std::copy_n(psd.RGB.begin() + std::ptrdiff_t(3) * (std::ptrdiff_t(row) * n + column), 3,
          cube.Texels.begin() + std::ptrdiff_t(3) * ((std::ptrdiff_t(face) * n + j) * n + i));
      }
    }
  }
  return cube;
}

namespace
{
/// Where texel coordinates of our face lie in the same face of cmgen's, which has +y and -y turned.
void TurnToCmgen(int face, double n, double& s, double& t)
{
  if (face == 2 || face == 3)
  {
    const double old = s;
    s = face == 2 ? n - t : t;
    t = face == 2 ? old : n - old;
  }
}
}

reference::Environment ReadAsCmgen(const Cube& cube, int width)
{
  const int n = cube.Size;
  reference::Environment panorama{ width, width / 2, std::vector<double>(std::size_t(3) * width * (width / 2)) };
  for (int row = 0; row < width / 2; ++row)
  {
    for (int column = 0; column < width; ++column)
    {
      const Vec3 d = reference::TexelDirection(panorama, row, column);
      const double x = std::abs(d.x);
      const double y = std::abs(d.y);
      const double z = std::abs(d.z);
      const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
      const double along = axis == 0 ? d.x : axis == 1 ? d.y : d.z;
      const int face = 2 * axis + (along > 0 ? 0 : 1);
      const double sc = axis == 0 ? -d.z * (d.x > 0 ? 1 : -1) : axis == 1 ? d.x : d.x * (d.z > 0 ? 1 : -1);
      const double tc = axis == 1 ? d.z * (d.y > 0 ? 1 : -1) : -d.y;
      double s = (sc / std::abs(along) + 1) / 2 * n;
      double t = (tc / std::abs(along) + 1) / 2 * n;
      TurnToCmgen(face, n, s, t);
      const int i0 = int(s); // without the half texel
      const int j0 = int(t);
      double* rgb = panorama.rgb.data() + 3 * (std::size_t(row) * width + column);
      for (int k = 0; k < 4; ++k)
      {
        const double weight = (k % 2 ? s - i0 : 1 - s + i0) * (k / 2 ? t - j0 : 1 - t + j0);
        const int i = std::min(i0 + k % 2, n - 1);
        const int j = std::min(j0 + k / 2, n - 1);
        const RGB texel = face == 2 ? cube.At(face, j, n - 1 - i)
          : face == 3               ? cube.At(face, n - 1 - j, i)
                                    : cube.At(face, i, j);
        for (int c = 0; c < 3; ++c)
        {
          rgb[c] += weight * texel[c];
        }
      }
    }
  }
  return panorama;
}

bool HasCmgen()
{
  static const bool has = std::system("cmgen --help > /dev/null 2>&1") == 0;
  return has;
}

Engine MakeCmgen(Session& session)
{
  vtkOpenGLRenderWindow* window = session.Window;
  Engine engine;
  engine.Name = "cmgen";
  if (!HasCmgen())
  {
    return engine;
  }
  engine.Settings = session.Options.Quick ? std::vector<double>{ 64 } : std::vector<double>{ 1024, 64, 256 };
  engine.TableSamples = { 1024 };
  engine.LayerBound = 0.35;
  engine.TableBound = 0.03;
  engine.MakeCube = MakeCube;
  engine.Irradiance = { { "9 coefficients", MakeHarmonics } };
  engine.MakeLayers = [=](const Map& map, double samples) { return MakeLayers(window, map, int(samples)); };
  engine.MakeTable = [](int) { return MakeTable(); };
  engine.MakeBake = [](const Map& map, double samples)
  {
    const Place place = MakePlace(map.Image);
    Work work;
    work.Run = [=]
    {
      return Add(Run(place, LayerArguments(FaceSize, int(samples))),
        Add(Run(place, HarmonicsArguments), Run(place, TableArguments)));
    };
    return work;
  };
  engine.MakeGrowth = [](vtkImageData* panorama, int faceSize) -> std::function<Sample()>
  {
    const Place place = MakePlace(panorama);
    return [=] { return Run(place, LayerArguments(faceSize > 0 ? faceSize : FaceSize, 256)); };
  };
  engine.LargestGrowthSource = session.Options.Quick ? 0 : 4096;
  engine.LargestGrowthFace = session.Options.Quick ? 128 : 512;
  return engine;
}
}
