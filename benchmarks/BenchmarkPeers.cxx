// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkPeers.h"

#include "vtkIBLGLHeader.h"

#include <vtkEquirectangularToCubeMapTexture.h>
#include <vtkFloatArray.h>
#include <vtkOpenGLRenderer.h>
#include <vtkOpenGLTexture.h>
#include <vtkPBRIrradianceTexture.h>
#include <vtkPBRLUTTexture.h>
#include <vtkPBRPrefilterTexture.h>
#include <vtkSphericalHarmonics.h>
#include <vtkTable.h>
#include <vtkTextureObject.h>

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace reference = vtkIBLReference;

namespace vtkIBLBenchmark
{
// ---- VTK -----------------------------------------------------------------------------------------------

VTKLight::VTKLight(vtkImageData* panorama)
{
  this->Window->SetSize(64, 64);
  this->Window->AddRenderer(this->Renderer);
  this->Texture->SetInputData(panorama);
  this->Texture->MipmapOn();
  this->Texture->InterpolateOn();
  this->Texture->SetColorModeToDirectScalars();
  this->Window->Initialize();
  this->Renderer->SetEnvironmentTexture(this->Texture, false);
}

VTKLight::~VTKLight()
{
  this->Window->Finalize();
}

vtkOpenGLRenderer* VTKLight::GetRenderer()
{
  return vtkOpenGLRenderer::SafeDownCast(this->Renderer);
}

Sample VTKLight::LoadTexture()
{
  this->Window->MakeCurrent();
  this->Texture->Modified();
  return Clock(
    [&]
    {
      this->Texture->Load(this->Renderer);
      glFinish();
    });
}

Sample VTKLight::LoadPrefiltered(int samples)
{
  this->Window->MakeCurrent();
  vtkPBRPrefilterTexture* prefiltered = this->GetRenderer()->GetEnvMapPrefiltered();
  prefiltered->SetPrefilterMaxSamples(static_cast<unsigned int>(samples));
  prefiltered->Modified();
  return Clock(
    [&]
    {
      prefiltered->Load(this->Renderer);
      glFinish();
    });
}

Sample VTKLight::LoadTable()
{
  this->Window->MakeCurrent();
  vtkPBRLUTTexture* table = this->GetRenderer()->GetEnvMapLookupTable();
  table->Modified();
  return Clock(
    [&]
    {
      table->Load(this->Renderer);
      glFinish();
    });
}

Sample VTKLight::LoadIrradiance(int faceSize)
{
  this->Window->MakeCurrent();
  vtkPBRIrradianceTexture* irradiance = this->GetRenderer()->GetEnvMapIrradiance();
  irradiance->SetIrradianceSize(static_cast<unsigned int>(faceSize));
  irradiance->Modified();
  return Clock(
    [&]
    {
      irradiance->Load(this->Renderer);
      glFinish();
    });
}

Sample VTKLight::LoadHarmonics()
{
  this->Harmonics->SetInputDataObject(0, this->Texture->GetInputDataObject(0, 0));
  this->Harmonics->Modified();
  return Clock([&] { this->Harmonics->Update(); });
}

RGB VTKLight::GetIrradiance(Vec3 n)
{
  auto* table = vtkTable::SafeDownCast(this->Harmonics->GetOutputDataObject(0));
  auto* coefficients = vtkFloatArray::SafeDownCast(table->GetColumn(0));
  std::vector<RGB> radiance(9);
  for (int i = 0; i < 9; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      radiance[i][k] = coefficients->GetTypedComponent(k, i);
    }
  }
  return EvaluateIrradiance(radiance, n);
}

unsigned int VTKLight::GetHandle(vtkOpenGLTexture* texture)
{
  return texture->GetTextureObject()->GetHandle();
}

RGB EvaluateIrradiance(const std::vector<RGB>& coefficients, Vec3 n)
{
  // Ramamoorthi & Hanrahan 2001: the clamped cosine has pi, 2 pi/3, pi/4 in bands 0, 1, 2.
  const double c0 = std::sqrt(reference::Pi) / 2;
  const double c1 = std::sqrt(reference::Pi / 3);
  const double c2 = std::sqrt(15 * reference::Pi) / 8;
  const double c20 = std::sqrt(5 * reference::Pi) / 16;
  const double factors[9] = { c0, -c1 * n.y, c1 * n.z, -c1 * n.x, c2 * n.x * n.y, -c2 * n.y * n.z,
    c20 * (3 * n.z * n.z - 1), -c2 * n.x * n.z, c2 / 2 * (n.x * n.x - n.y * n.y) };
  RGB rgb{ 0, 0, 0 };
  for (int k = 0; k < 3; ++k)
  {
    for (int i = 0; i < 9; ++i)
    {
      rgb[k] += factors[i] * coefficients.at(i)[k];
    }
    rgb[k] = std::max(rgb[k], 0.0);
  }
  return rgb;
}

namespace
{
constexpr int VTKSamples = 512;

/// Samples a texel of VTK's layer of that roughness.
long long CountVTKSamples(double roughness, int samples)
{
  return static_cast<long long>(samples * roughness / (0.65 * roughness + 0.35)) + 1;
}

CubeWork MakeVTKCube(const Map& map, int faceSize)
{
  auto light = std::make_shared<VTKLight>(map.Image);
  light->LoadTexture();
  auto cube = vtkSmartPointer<vtkEquirectangularToCubeMapTexture>::New();
  cube->SetInputTexture(light->Texture);
  cube->SetCubeMapSize(static_cast<unsigned int>(faceSize));
  cube->InterpolateOn();
  CubeWork work;
  work.Run = [=]
  {
    light->Window->MakeCurrent();
    cube->Modified();
    return Clock(
      [&]
      {
        cube->Load(light->Renderer);
        glFinish();
      });
  };
  work.Run();
  work.Result = ReadCubeLevel(VTKLight::GetHandle(cube), 0);
  work.Fetches = 6LL * faceSize * faceSize;
  work.Bytes = 6LL * faceSize * faceSize * 3 * sizeof(float);
  return work;
}

IrradianceWork MakeVTKHarmonics(const Map& map)
{
  auto light = std::make_shared<VTKLight>(map.Image);
  light->LoadHarmonics();
  IrradianceWork work;
  work.Read = [=](const std::vector<Vec3>& normals)
  {
    std::vector<RGB> irradiance;
    for (const Vec3& normal : normals)
    {
      irradiance.push_back(light->GetIrradiance(normal));
    }
    return irradiance;
  };
  work.Bytes = 9 * 3 * sizeof(float);
  work.Run = [=] { return light->LoadHarmonics(); };
  return work;
}

LayersWork MakeVTKLayers(const Map& map, int samples)
{
  auto light = std::make_shared<VTKLight>(map.Image);
  light->LoadTexture();
  light->LoadPrefiltered(samples);
  vtkPBRPrefilterTexture* prefiltered = light->GetRenderer()->GetEnvMapPrefiltered();
  const int levels = static_cast<int>(prefiltered->GetPrefilterLevels());
  LayersWork work;
  work.Fetches = 0;
  work.Bytes = 0;
  for (int level = 0; level < levels; ++level)
  {
    const double roughness = double(level) / levels; // that VTK's kernel is given
    Cube cube = ReadCubeLevel(VTKLight::GetHandle(prefiltered), level);
    work.Fetches += 6LL * cube.Size * cube.Size * CountVTKSamples(roughness, samples);
    work.Bytes += 6LL * cube.Size * cube.Size * 6; // RGB16F
    if (level > 0)
    {
      work.Layers.push_back({ roughness, std::move(cube) });
    }
  }
  work.Read = [=](const std::vector<Vec3>& directions, double roughness)
  {
    // That VTK's shader reads: textureLod(roughness * (levels - 1)).
    return ReadCubeMap(light->Window, VTKLight::GetHandle(light->GetRenderer()->GetEnvMapPrefiltered()), directions,
      roughness * (levels - 1));
  };
  work.Run = [=] { return light->LoadPrefiltered(samples); };
  return work;
}

TableWork MakeVTKTable(vtkImageData* anyPanorama)
{
  auto light = std::make_shared<VTKLight>(anyPanorama);
  light->LoadTable();
  vtkPBRLUTTexture* table = light->GetRenderer()->GetEnvMapLookupTable();
  const int size = static_cast<int>(table->GetLUTSize());
  auto texels = std::make_shared<std::vector<float>>(2 * size * size);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glGetTextureImage(
    VTKLight::GetHandle(table), 0, GL_RG, GL_FLOAT, GLsizei(texels->size() * sizeof(float)), texels->data());
  TableWork work;
  work.Read = [=](double NoV, double roughness) { return ReadCentredTable(*texels, size, NoV, roughness); };
  work.Bytes = 4LL * size * size; // RG16F
  work.Run = [=] { return light->LoadTable(); };
  return work;
}

Sample BakeVTK(VTKLight& light, int samples)
{
  Sample sum;
  for (const Sample& part :
    { light.LoadTexture(), light.LoadTable(), light.LoadHarmonics(), light.LoadPrefiltered(samples) })
  {
    sum.Wall += part.Wall;
    sum.CPU += part.CPU;
  }
  return sum;
}
}

Engine MakeVTK(Session& session)
{
  Engine engine;
  engine.Name = "VTK";
  engine.Settings = session.Options.Quick ? std::vector<double>{ 64 } : std::vector<double>{ VTKSamples, 32, 128 };
  engine.TableSamples = { 1024 };
  engine.LayerBound = 0.35;
  engine.TableBound = 0.2;
  engine.MakeCube = MakeVTKCube;
  engine.Irradiance = { { "9 coefficients", MakeVTKHarmonics } };
  engine.MakeLayers = [](const Map& map, double samples) { return MakeVTKLayers(map, int(samples)); };
  engine.MakeTable = [&session](int) { return MakeVTKTable(session.Maps.front().Image); };
  engine.MakeBake = [](const Map& map, double samples)
  {
    auto light = std::make_shared<VTKLight>(map.Image);
    BakeVTK(*light, 16); // warm-up: its shaders are compiled
    Work work;
    work.Run = [=] { return BakeVTK(*light, int(samples)); };
    return work;
  };
  engine.MakeGrowth = [](vtkImageData* panorama, int faceSize) -> std::function<Sample()>
  {
    if (faceSize > 0)
    {
      return nullptr; // its faces are as large as the source is high
    }
    auto light = std::make_shared<VTKLight>(panorama);
    return [=] { return BakeVTK(*light, VTKSamples); };
  };
  engine.LargestGrowthSource = session.Options.Quick ? 0 : 2048;
  return engine;
}

// ---- cmgen's files -----------------------------------------------------------------------------------------

std::string MakeScratchFolder()
{
  std::string pattern = (std::filesystem::temp_directory_path() / "vtkibl-benchmark-XXXXXX").string();
  if (!mkdtemp(pattern.data()))
  {
    throw std::runtime_error("no folder for cmgen's files: " + pattern);
  }
  return pattern;
}

void WriteEXR(vtkImageData* panorama, const std::string& file)
{
  int size[3];
  panorama->GetDimensions(size);
  auto output = OIIO::ImageOutput::create(file);
  OIIO::ImageSpec spec(size[0], size[1], 3, OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip"); // cmgen can't read DWA, which blender-data's files are in
  const auto* top = static_cast<const float*>(panorama->GetScalarPointer(0, size[1] - 1, 0));
  if (!output || !output->open(file, spec) ||
    !output->write_image(OIIO::TypeDesc::FLOAT, top, OIIO::AutoStride, -OIIO::stride_t(3 * sizeof(float)) * size[0]) ||
    !output->close())
  {
    throw std::runtime_error("could not write " + file + ": " + (output ? output->geterror() : OIIO::geterror()));
  }
}

PSD ReadPSD(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  const std::vector<char> bytes{ std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
  std::size_t at = 0;
  auto read = [&](int count)
  {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i)
    {
      value = value << 8 | static_cast<unsigned char>(bytes.at(at++));
    }
    return value;
  };
  if (bytes.size() < 26 || read(4) != 0x38425053u)
  {
    throw std::runtime_error(file + " is no PSD file");
  }
  at = 12;
  PSD psd;
  const int channels = int(read(2));
  psd.Height = int(read(4));
  psd.Width = int(read(4));
  if (read(2) != 32)
  {
    throw std::runtime_error(file + " does not hold 32-bit floats");
  }
  at += 2;
  for (int section = 0; section < 3; ++section) // colour mode, resources, layers
  {
    const std::uint32_t length = read(4);
    at += length;
  }
  at += 2; // compression: none
  psd.RGB.resize(std::size_t(3) * psd.Width * psd.Height);
  for (int channel = 0; channel < std::min(channels, 3); ++channel)
  {
    for (std::size_t i = 0; i < std::size_t(psd.Width) * psd.Height; ++i)
    {
      const std::uint32_t bits = read(4);
      std::memcpy(&psd.RGB[3 * i + channel], &bits, sizeof(bits));
    }
  }
  return psd;
}

SplitSum ReadCentredTable(const std::vector<float>& texels, int size, double NoV, double roughness)
{
  const double x = std::clamp(NoV * size - 0.5, 0.0, size - 1.0);
  const double y = std::clamp(roughness * size - 0.5, 0.0, size - 1.0);
  const int i = std::min(int(x), size - 2);
  const int j = std::min(int(y), size - 2);
  SplitSum sum{ 0, 0 };
  for (int n = 0; n < 4; ++n)
  {
    const double weight = (n % 2 ? x - i : 1 - x + i) * (n / 2 ? y - j : 1 - y + j);
    const float* texel = texels.data() + 2 * (std::size_t(j + n / 2) * size + i + n % 2);
    sum.A += weight * texel[0];
    sum.B += weight * texel[1];
  }
  return sum;
}
}
