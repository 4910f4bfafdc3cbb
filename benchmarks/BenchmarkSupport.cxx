// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLGLHeader.h"

#include "ReadCubeCS.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <stdexcept>

#include <sys/resource.h>
#include <sys/wait.h>

namespace reference = vtkIBLReference;

namespace vtkIBLBenchmark
{
const std::vector<double> JudgedRoughness = { 0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0 };

std::string LayerPanel(double perceptualRoughness)
{
  char text[32];
  std::snprintf(text, sizeof(text), "layer %.2f", perceptualRoughness);
  return text;
}

namespace
{
double GetWall()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double GetCPU()
{
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

double GetChildCPU()
{
  rusage usage;
  getrusage(RUSAGE_CHILDREN, &usage);
  return double(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
    1e-6 * double(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

double GetQuantile(std::vector<double> values, double share)
{
  std::sort(values.begin(), values.end());
  const double place = share * double(values.size() - 1);
  const auto below = std::size_t(place);
  const auto above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - double(below)) * (values[above] - values[below]);
}
}

Sample Clock(const std::function<void()>& work)
{
  const double wall = GetWall();
  const double cpu = GetCPU();
  work();
  return { GetWall() - wall, GetCPU() - cpu };
}

Sample RunProcess(const std::string& command, std::string* output)
{
  const double wall = GetWall();
  const double cpu = GetChildCPU();
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe)
  {
    throw std::runtime_error("could not start: " + command);
  }
  char buffer[4096];
  std::string text;
  for (std::size_t n; (n = fread(buffer, 1, sizeof(buffer), pipe)) > 0;)
  {
    text.append(buffer, n);
  }
  const int status = pclose(pipe);
  if (status != 0)
  {
    throw std::runtime_error("\"" + command + "\" returned " + std::to_string(WEXITSTATUS(status)) + ": " + text);
  }
  if (output)
  {
    *output = text;
  }
  return { GetWall() - wall, GetChildCPU() - cpu };
}

Timing Summarize(const std::vector<Sample>& samples)
{
  if (samples.empty())
  {
    return {};
  }
  std::vector<double> wall;
  std::vector<double> cpu;
  for (const Sample& sample : samples)
  {
    wall.push_back(sample.Wall);
    cpu.push_back(sample.CPU);
  }
  return { int(samples.size()), GetQuantile(wall, 0.5), GetQuantile(wall, 0.25), GetQuantile(wall, 0.75),
    GetQuantile(cpu, 0.5) };
}

std::vector<Sample> Repeat(const std::function<Sample()>& run, int count, double budget, int least)
{
  std::vector<Sample> samples;
  const double start = GetWall();
  while (int(samples.size()) < count && (int(samples.size()) < least || GetWall() - start < budget))
  {
    samples.push_back(run());
  }
  return samples;
}

Error Judge(const std::vector<RGB>& values, const std::vector<RGB>& truth)
{
  double difference = 0;
  double sum = 0;
  double squares = 0;
  double truthSquares = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const double d = values.at(i)[k] - truth[i][k];
      difference += std::abs(d);
      sum += std::abs(truth[i][k]);
      squares += d * d;
      truthSquares += truth[i][k] * truth[i][k];
    }
  }
  return { difference / sum, std::sqrt(squares / truthSquares) };
}

std::string GetMapFile(const std::string& name)
{
  return "/usr/share/blender/datafiles/studiolights/world/" + name + ".exr";
}

Map LoadMap(const std::string& name)
{
  Map map;
  map.Name = name;
  map.File = GetMapFile(name);
  if (!std::filesystem::exists(map.File))
  {
    throw std::runtime_error(map.File + " is missing; install blender-data");
  }
  vtkNew<vtkIBLEnvironment> environment;
  environment->SetFileName(map.File.c_str());
  environment->Update();
  map.Image = environment->GetRadianceImage();
  int dimensions[3];
  map.Image->GetDimensions(dimensions);
  const auto* rgb = static_cast<const float*>(map.Image->GetScalarPointer());
  map.Reference = { dimensions[0], dimensions[1],
    std::vector<double>(rgb, rgb + std::size_t(3) * dimensions[0] * dimensions[1]) };
  return map;
}

vtkSmartPointer<vtkImageData> Resize(vtkImageData* panorama, int width)
{
  int from[3];
  panorama->GetDimensions(from);
  const int height = width / 2;
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_FLOAT, 3);
  const auto* source = static_cast<const float*>(panorama->GetScalarPointer());
  auto* target = static_cast<float*>(image->GetScalarPointer());
  const int block = std::max(from[0] / width, 1);
  const double scale = double(from[0]) / width;
  auto texel = [&](int i, int j)
  { return source + 3 * (std::size_t(std::clamp(j, 0, from[1] - 1)) * from[0] + (i + from[0]) % from[0]); };
  for (int j = 0; j < height; ++j)
  {
    for (int i = 0; i < width; ++i, target += 3)
    {
      double sum[3] = {};
      if (block > 1)
      {
        for (int n = 0; n < block * block; ++n)
        {
          const float* t = texel(i * block + n % block, j * block + n / block);
          for (int k = 0; k < 3; ++k)
          {
            sum[k] += t[k] / double(block * block);
          }
        }
      }
      else
      {
        const double x = (i + 0.5) * scale - 0.5;
        const double y = (j + 0.5) * scale - 0.5;
        const int i0 = int(std::floor(x));
        const int j0 = int(std::floor(y));
        for (int n = 0; n < 4; ++n)
        {
          const double weight = (n % 2 ? x - i0 : 1 - x + i0) * (n / 2 ? y - j0 : 1 - y + j0);
          const float* t = texel(i0 + n % 2, j0 + n / 2);
          for (int k = 0; k < 3; ++k)
          {
            sum[k] += weight * t[k];
          }
        }
      }
      std::transform(sum, sum + 3, target, [](double x) { return float(x); });
    }
  }
  return image;
}

std::vector<Vec3> SpreadDirections(int count)
{
  const double golden = reference::Pi * (3 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (int i = 0; i < count; ++i)
  {
    const double y = 1 - (2 * i + 1.0) / count;
    const double horizontal = std::sqrt(1 - y * y);
    directions.push_back({ horizontal * std::cos(golden * i), y, horizontal * std::sin(golden * i) });
  }
  return directions;
}

std::vector<RGB> GetPrefilteredTruth(const Map& map, const std::vector<Vec3>& directions, double perceptualRoughness)
{
  // As the text of a key, digits beyond these would only say that a logarithm was rounded.
  char roughness[32];
  std::snprintf(roughness, sizeof(roughness), "%.9f", perceptualRoughness);
  return reference::Cached<RGB>(
    "benchmark prefilter " + std::string(roughness) + reference::KeyOf(map.Reference) + reference::KeyOf(directions),
    [&] { return reference::PrefilterAll(map.Reference, directions, std::stod(roughness)); });
}

std::vector<RGB> GetIrradianceTruth(const Map& map, const std::vector<Vec3>& directions)
{
  return reference::Cached<RGB>(
    "benchmark irradiance " + reference::KeyOf(map.Reference) + reference::KeyOf(directions),
    [&] { return reference::IrradianceAll(map.Reference, directions); });
}

std::string FormatSetting(double setting)
{
  char text[32];
  std::snprintf(text, sizeof(text), setting < 1 ? "tolerance %g" : "%g samples", setting);
  return text;
}

RGB Cube::At(int face, int i, int j) const
{
  const float* rgb = this->Texels.data() + 3 * ((std::size_t(face) * this->Size + j) * this->Size + i);
  return { rgb[0], rgb[1], rgb[2] };
}

bool Session::Wants(const std::string& panel) const
{
  return panel.compare(0, this->Options.Only.size(), this->Options.Only) == 0;
}

void Session::Add(const Row& row)
{
  std::printf("%-13s %-15s %-18s %-9s", row.Panel.c_str(), row.Engine.c_str(), row.Setting.c_str(), row.Map.c_str());
  if (row.Error)
  {
    std::printf(" error %8.3f %%", 100 * row.Error->RelativeL1);
  }
  if (row.ErrorAsMade)
  {
    std::printf(" (as made %.3f %%)", 100 * row.ErrorAsMade->RelativeL1);
  }
  if (!row.Samples.empty())
  {
    const Timing time = Summarize(row.Samples);
    std::printf("  %9.2f ms (%.2f to %.2f, %d runs)", 1e3 * time.Median, 1e3 * time.Low, 1e3 * time.High, time.Count);
  }
  std::printf("\n");
  std::fflush(stdout);
  this->Rows.push_back(row);
}

std::vector<RGB> ReadCubeMap(
  vtkOpenGLRenderWindow* window, unsigned int texture, const std::vector<Vec3>& directions, double level)
{
  window->MakeCurrent();
  const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
  const char* text = ReadCubeCS;
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  const GLuint program = glCreateProgram();
  glAttachShader(program, shader);
  glLinkProgram(program);
  GLint linked = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (!linked)
  {
    throw std::runtime_error("ReadCubeCS.glsl does not link");
  }
  std::vector<float> values;
  for (const Vec3& d : directions)
  {
    values.insert(values.end(), { float(d.x), float(d.y), float(d.z), 0.0f });
  }
  GLuint buffers[2];
  glCreateBuffers(2, buffers);
  glNamedBufferStorage(buffers[0], GLsizeiptr(values.size() * sizeof(float)), values.data(), 0);
  glNamedBufferStorage(buffers[1], GLsizeiptr(values.size() * sizeof(float)), nullptr, 0);
  GLuint sampler;
  glCreateSamplers(1, &sampler);
  glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glSamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, GL_LINEAR);

  GLint oldProgram = 0;
  glGetIntegerv(GL_CURRENT_PROGRAM, &oldProgram);
  const GLboolean seamless = glIsEnabled(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  const GLuint unit = 15; // VTK's own textures take the first ones
  glBindTextureUnit(unit, texture);
  glBindSampler(unit, sampler);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers[0]);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffers[1]);
  glUseProgram(program);
  glUniform1i(glGetUniformLocation(program, "map"), int(unit));
  glUniform1f(glGetUniformLocation(program, "level"), float(level));
  glDispatchCompute(GLuint(directions.size() + 63) / 64, 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(buffers[1], 0, GLsizeiptr(values.size() * sizeof(float)), values.data());

  glUseProgram(GLuint(oldProgram));
  glBindSampler(unit, 0);
  glBindTextureUnit(unit, 0);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, 0);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, 0);
  if (!seamless)
  {
    glDisable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  }
  glDeleteSamplers(1, &sampler);
  glDeleteBuffers(2, buffers);
  glDeleteProgram(program);
  glDeleteShader(shader);
  std::vector<RGB> result;
  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    result.push_back({ values[4 * i], values[4 * i + 1], values[4 * i + 2] });
  }
  return result;
}

Cube ReadCubeLevel(unsigned int texture, int level)
{
  Cube cube;
  GLint size = 0;
  glGetTextureLevelParameteriv(texture, level, GL_TEXTURE_WIDTH, &size);
  cube.Size = size;
  cube.Texels.resize(std::size_t(18) * size * size);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glGetTextureImage(texture, level, GL_RGB, GL_FLOAT, GLsizei(cube.Texels.size() * sizeof(float)), cube.Texels.data());
  return cube;
}
}
