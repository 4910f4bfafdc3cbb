// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLLighting.h"

#include "vtkIBLBRDFTable.h"
#include "vtkIBLCubeMap.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLGL.h"
#include "vtkIBLLamps.h"
#include "vtkIBLShaderSource.h"
#include "vtkIBLShared.glsl"
#include "vtkIBLSpecularChain.h"
#include "vtkIBLStatistics.h"

#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkIBLLighting);

// All samplers get a texture: a cube map that nobody needs, and nobody made, is stood in for by one that is there.
struct vtkIBLLighting::Bindings
{
  Bindings(vtkOpenGLRenderWindow* window, const vtkIBLCubeMap& cubeMap, const vtkIBLSpecularChain& chain,
    const vtkIBLBRDFTable& table)
    : Radiance(window, Choose(cubeMap.GetTexture(), chain.GetOddLayers()))
    , OddLayers(window, Choose(chain.GetOddLayers(), cubeMap.GetTexture()))
    , EvenLayers(window, Choose(chain.GetEvenLayers(), cubeMap.GetTexture()))
    , Irradiance(window, Choose(chain.GetIrradianceMap(), cubeMap.GetTexture()))
    , Table(window, table.GetTexture())
  {
  }
  static const vtkIBLGL::Texture& Choose(const vtkIBLGL::Texture& first, const vtkIBLGL::Texture& second)
  {
    return first ? first : second;
  }
  vtkIBLGL::BoundTexture Radiance;
  vtkIBLGL::BoundTexture OddLayers;
  vtkIBLGL::BoundTexture EvenLayers;
  vtkIBLGL::BoundTexture Irradiance;
  vtkIBLGL::BoundTexture Table;
};

vtkIBLLighting::vtkIBLLighting()
{
  this->SpecularChain->SetCubeMap(this->CubeMap);
  this->CubeMap->SetStatistics(this->Statistics);
  this->SpecularChain->SetStatistics(this->Statistics);
  this->BRDFTable->SetStatistics(this->Statistics);
  this->SetEnvironment(nullptr);
}

vtkIBLLighting::~vtkIBLLighting() = default;

void vtkIBLLighting::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ReflectionModel: " << (this->ReflectionModel == Physical ? "Physical" : "Classic") << "\n"
     << indent << "EnergyCompensation: " << this->EnergyCompensation << "\n"
     << indent << "BrightTexels: " << this->BrightTexels << "\n"
     << indent << "SunInEnvironment: " << this->SunInEnvironment << "\n"
     << indent << "SpecularOcclusion: " << this->SpecularOcclusion << "\n"
     << indent << "HorizonOcclusion: " << this->HorizonOcclusion << "\n"
     << indent << "SamplesPerPixel: " << this->SamplesPerPixel << "\n";
  for (vtkIBLStage* stage : { static_cast<vtkIBLStage*>(this->CubeMap), static_cast<vtkIBLStage*>(this->SpecularChain),
         static_cast<vtkIBLStage*>(this->BRDFTable) })
  {
    os << indent << stage->GetClassName() << ":\n";
    stage->PrintSelf(os, indent.GetNextIndent());
  }
  os << indent << "Statistics:\n";
  this->Statistics->PrintSelf(os, indent.GetNextIndent());
}

void vtkIBLLighting::SetEnvironment(vtkIBLEnvironment* environment)
{
  vtkNew<vtkIBLEnvironment> studio;
  this->CubeMap->SetEnvironment(environment ? environment : studio);
  this->Modified();
}

vtkIBLEnvironment* vtkIBLLighting::GetEnvironment() const
{
  return this->CubeMap->GetEnvironment();
}

vtkIBLCubeMap* vtkIBLLighting::GetCubeMap() const
{
  return this->CubeMap;
}

vtkIBLSpecularChain* vtkIBLLighting::GetSpecularChain() const
{
  return this->SpecularChain;
}

vtkIBLBRDFTable* vtkIBLLighting::GetBRDFTable() const
{
  return this->BRDFTable;
}

vtkIBLStatistics* vtkIBLLighting::GetStatistics() const
{
  return this->Statistics;
}

void vtkIBLLighting::SetReflectionModel(int model)
{
  model = std::clamp<int>(model, Physical, Classic);
  if (model != this->ReflectionModel)
  {
    this->ReflectionModel = model;
    this->BRDFTable->SetGeometryTerm(
      model == Classic ? vtkIBLBRDFTable::SchlickSmith : vtkIBLBRDFTable::SmithCorrelated);
    this->Modified();
  }
}

bool vtkIBLLighting::Update(vtkOpenGLRenderWindow* window)
{
  return this->Update(window, vtkIBLSceneNeeds::Everything());
}

bool vtkIBLLighting::Update(vtkOpenGLRenderWindow* window, const vtkIBLSceneNeeds& needs)
{
  const vtkIBLStatistics& source = *this->GetEnvironment()->GetStatistics();
  const vtkIBLStatistics::Works before = source.GetWorks();
  const bool ready = this->UpdateStages(window, needs);
  this->Statistics->AddDifference(source.GetWorks(), before);
  return ready;
}

bool vtkIBLLighting::UpdateStages(vtkOpenGLRenderWindow* window, const vtkIBLSceneNeeds& needs)
{
  vtkIBLEnvironment* environment = this->GetEnvironment();
  if (!environment->Update())
  {
    return false;
  }
  // What was made stays, for whoever comes back into view; a new light begins anew.
  if (environment->GetRadianceTime() != this->NeedsTime)
  {
    this->NeedsTime = environment->GetRadianceTime();
    this->Needs = vtkIBLSceneNeeds();
  }
  this->Needs.Add(needs);
  const bool sampled = this->SamplesPerPixel > 0;
  this->SpecularChain->SetNeededRoughness(this->Needs.MinimumRoughness, this->Needs.MaximumRoughness);
  this->SpecularChain->SetIrradianceNeeded(this->Needs.Irradiance);
  // A scene without reflections has its lamps in the irradiance map, exact enough.
  this->SpecularChain->SetLampsApart(
    this->BrightTexels && (this->Needs.MaximumRoughness > 0.0 || !this->SunInEnvironment));
  const bool samplesCube = sampled || this->Needs.RadianceCube;
  this->CubeMap->SetMipLevelsNeeded(samplesCube || this->SpecularChain->GetEngine() == vtkIBLSpecularChain::Sampled ||
    environment->GetNumberOfFaces() == 6);
  bool ready = this->BRDFTable->Update(window);
  if (samplesCube || this->Needs.NeedsMirror())
  {
    ready = this->CubeMap->Update(window) && ready;
  }
  // Sampled or not: a blurred background reads layers, and samples go to lamps.
  if (this->Needs.Irradiance || this->Needs.MaximumRoughness > 0.0)
  {
    ready = this->SpecularChain->Update(window) && ready;
  }
  environment->KeepLight();
  this->UpdateShaderText();
  return ready;
}

void vtkIBLLighting::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Deactivate();
  this->SpecularChain->ReleaseGraphicsResources(window);
  this->BRDFTable->ReleaseGraphicsResources(window);
  this->CubeMap->ReleaseGraphicsResources(window);
}

void vtkIBLLighting::Activate(vtkOpenGLRenderWindow* window)
{
  this->Bound = std::make_unique<Bindings>(window, *this->CubeMap, *this->SpecularChain, *this->BRDFTable);
}

void vtkIBLLighting::Deactivate()
{
  this->Bound = nullptr;
}

void vtkIBLLighting::GetEnvironmentFromView(vtkRenderer* renderer, float columns[9])
{
  double environmentFromWorld[3][3];
  this->GetEnvironment()->GetEnvironmentFromWorld(&environmentFromWorld[0][0]);
  // Light has no place here, only a direction; so the camera's rotation is all that counts, whatever user transform
  // scales it.
  vtkMatrix4x4* viewFromWorld = renderer->GetActiveCamera()->GetModelViewTransformMatrix();
  double linear[3][3];
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      linear[i][j] = viewFromWorld->GetElement(i, j);
    }
  }
  double worldFromView[3][3];
  vtkMath::Invert3x3(linear, worldFromView);
  vtkMath::Multiply3x3(environmentFromWorld, worldFromView, linear);
  const double length = std::hypot(linear[0][0], linear[1][0], linear[2][0]);
  for (int i = 0; i < 9; ++i)
  {
    columns[i] = static_cast<float>(linear[i % 3][i / 3] / length);
  }
}

bool vtkIBLLighting::IsViewRigid(vtkRenderer* renderer)
{
  glm::mat3 m;
  this->GetEnvironmentFromView(renderer, &m[0].x);
  // Of columns of which one has the length 1: a cross product that is the third tells that all have, at right angles.
  return glm::distance(glm::cross(m[0], m[1]), m[2]) < 1e-5f && std::abs(glm::dot(m[1], m[1]) - 1.0f) < 1e-5f &&
    std::abs(glm::dot(m[0], m[1])) < 1e-5f;
}

void vtkIBLLighting::SetLayerParameters(const vtkIBLGL::Program& program) const
{
  program.Set("iblRadiance", this->Bound->Radiance.GetUnit());
  program.Set("iblOddLayers", this->Bound->OddLayers.GetUnit());
  program.Set("iblEvenLayers", this->Bound->EvenLayers.GetUnit());
  program.Set("iblLayers", float(this->SpecularChain->GetNumberOfLayers()));
  program.Set("iblStoredScale", float(this->SpecularChain->GetStoredScale()));
}

namespace
{
// GGX widened by a lamp's size: half vectors turn by half as much as the light, and a Beckmann lobe, GGX's near its
// peak, of alpha^2 has the variance alpha^2 / 2.
double GetAddedAlpha2(double variance)
{
  return 0.5 * variance;
}
}

void vtkIBLLighting::SetLampParameters(const vtkIBLGL::Program& program, double perceptualRoughness) const
{
  // The kernel of N = V = R; below the first layer's roughness as vtkIBLLighting.glsl fades lamps.
  const double roughness = std::max(perceptualRoughness, vtkIBLSpecularChain::GetFirstRoughness());
  const double share = std::min(perceptualRoughness / vtkIBLSpecularChain::GetFirstRoughness(), 1.0);
  std::vector<glm::vec3> directions, powers, kernels;
  for (int i = 0; i < this->SpecularChain->GetNumberOfLamps(); ++i)
  {
    double direction[3];
    double power[3];
    const double variance = this->SpecularChain->GetLamp(i, direction, power);
    const double alpha2 = std::min(std::pow(roughness, 4.0) + GetAddedAlpha2(variance), 1.0);
    const vtkIBLLamps::Kernel kernel = vtkIBLLamps::MakeKernel({ std::pow(alpha2, 0.25), share });
    directions.emplace_back(direction[0], direction[1], direction[2]);
    powers.emplace_back(power[0], power[1], power[2]);
    kernels.emplace_back(kernel.K, kernel.OneMinusK, kernel.Scale);
  }
  program.Set("lampCount", static_cast<int>(directions.size()));
  program.Set("lampDirections", directions);
  program.Set("lampPowers", powers);
  program.Set("lampKernels", kernels);
}

vtkSmartPointer<vtkLight> vtkIBLLighting::CreateSunLight()
{
  if (this->SpecularChain->GetNumberOfLamps() == 0)
  {
    vtkWarningMacro(
      "The environment has no lamp that a light could stand for: no texel is above 20 times the mean, or "
      "nothing was rendered yet, or BrightTexels is off. Render once first, with reflections in the scene.");
    return nullptr;
  }
  double direction[3];
  double power[3];
  this->SpecularChain->GetLamp(0, direction, power);
  double environmentFromWorld[3][3];
  double worldFromEnvironment[3][3];
  this->GetEnvironment()->GetEnvironmentFromWorld(&environmentFromWorld[0][0]);
  vtkMath::Transpose3x3(environmentFromWorld, worldFromEnvironment);
  vtkMath::Multiply3x3(worldFromEnvironment, direction, direction);
  double scale[3];
  this->GetEnvironment()->GetRadianceScale(scale);
  for (int k = 0; k < 3; ++k)
  {
    power[k] *= scale[k];
  }
  const double intensity = *std::max_element(power, power + 3);
  auto sun = vtkSmartPointer<vtkLight>::New();
  sun->SetLightTypeToSceneLight();
  sun->PositionalOff();
  sun->SetFocalPoint(0.0, 0.0, 0.0);
  sun->SetPosition(direction);
  sun->SetIntensity(intensity);
  sun->SetColor(power[0] / intensity, power[1] / intensity, power[2] / intensity);
  this->SetSunInEnvironment(false);
  return sun;
}

void vtkIBLLighting::SetShaderParameters(vtkShaderProgram* program, vtkRenderer* renderer, int firstSample)
{
  // Layers are stored divided by a scale, the cube map as it is.
  const double stored = this->SamplesPerPixel > 0 ? 1.0 : this->SpecularChain->GetStoredScale();
  program->SetUniformi("iblBRDFTable", this->Bound->Table.GetUnit());
  program->SetUniformi("iblRadiance", this->Bound->Radiance.GetUnit());
  if (this->SamplesPerPixel > 0)
  {
    program->SetUniformi("iblSamplesPerPixel", this->SamplesPerPixel);
    program->SetUniformi("iblFirstSample", firstSample);
  }
  else
  {
    program->SetUniformi("iblOddLayers", this->Bound->OddLayers.GetUnit());
    program->SetUniformi("iblEvenLayers", this->Bound->EvenLayers.GetUnit());
    program->SetUniformi("iblIrradiance", this->Bound->Irradiance.GetUnit());
    program->SetUniformf("iblLayers", float(this->SpecularChain->GetNumberOfLayers()));
    program->SetUniformf("iblStoredScale", float(stored));
  }

  float environmentFromView[9];
  this->GetEnvironmentFromView(renderer, environmentFromView);
  program->SetUniformMatrix3x3("iblEnvironmentFromView", environmentFromView);
  program->SetUniformi("iblParallelProjection", renderer->GetActiveCamera()->GetParallelProjection());
  program->SetUniform3fv("iblEnvironmentFromViewXY", 2, reinterpret_cast<const float(*)[3]>(environmentFromView));
  if (this->BrightTexels)
  {
    this->SetLamps(program, environmentFromView);
  }
  double rgb[3];
  this->GetEnvironment()->GetRadianceScale(rgb);
  const float scale[3] = { float(rgb[0] * stored), float(rgb[1] * stored), float(rgb[2] * stored) };
  if (this->IsTinted())
  {
    program->SetUniform3f("iblRadianceScale", scale);
  }
  else
  {
    program->SetUniformf("iblRadianceScale", scale[0]);
  }
}

int vtkIBLLighting::GetLampsEnd() const
{
  return this->SamplesPerPixel > 0 ? this->SpecularChain->GetNumberOfSampledLamps()
                                   : this->SpecularChain->GetNumberOfLamps();
}

void vtkIBLLighting::SetLamps(vtkShaderProgram* program, const float environmentFromView[9])
{
  const glm::mat3 viewFromEnvironment = glm::inverse(glm::make_mat3(environmentFromView));
  float directions[IBL_MAXIMUM_LAMPS][4];
  float powers[IBL_MAXIMUM_LAMPS][3];
  const bool sampled = this->SamplesPerPixel > 0;
  int count = 0;
  for (int i = this->GetFirstLamp(); i < this->GetLampsEnd(); ++i, ++count)
  {
    double direction[3];
    double power[3];
    const double variance = this->SpecularChain->GetLamp(i, direction, power);
    const glm::vec3 view = glm::normalize(viewFromEnvironment * glm::vec3(direction[0], direction[1], direction[2]));
    directions[count][3] =
      float(sampled ? 1.0 - std::cos(this->SpecularChain->GetLampRadius(i)) : GetAddedAlpha2(variance));
    for (int k = 0; k < 3; ++k)
    {
      directions[count][k] = view[k];
      powers[count][k] = float(power[k] / this->SpecularChain->GetStoredScale());
    }
  }
  if (count > 0)
  {
    program->SetUniform4fv(sampled ? "iblLampCaps" : "iblLampDirections", count, directions);
    if (!sampled)
    {
      program->SetUniform3fv("iblLampPowers", count, powers);
    }
  }
}

bool vtkIBLLighting::IsTinted() const
{
  double rgb[3];
  this->GetEnvironment()->GetRadianceScale(rgb);
  return rgb[0] != rgb[1] || rgb[1] != rgb[2];
}

void vtkIBLLighting::UpdateShaderText()
{
  const int lamps = this->BrightTexels ? this->GetLampsEnd() - this->GetFirstLamp() : 0;
  std::string defines = "#define IBL_LAMPS " + std::to_string(std::max(lamps, 0)) + "\n";
  const char* energy = this->ReflectionModel == Classic ? "IBL_CLASSIC"
    : this->EnergyCompensation                          ? "IBL_MULTIPLE_SCATTER"
                                                        : "IBL_SINGLE_SCATTER";
  defines += std::string("#define IBL_ENERGY ") + energy + "\n";
  const auto define = [&](bool condition, const char* name)
  { defines += condition ? std::string("#define ") + name + "\n" : std::string(); };
  define(this->Needs.NeedsMirror(), "IBL_MIRROR");
  define(this->ReadsProbes, "IBL_PROBES");
  define(!this->Needs.Metal, "IBL_DIELECTRIC");
  define(!this->Needs.Dielectric && this->Needs.Metal, "IBL_METAL");
  define(!this->Needs.EdgeTint, "IBL_WHITE_EDGES");
  define(this->IsTinted(), "IBL_TINT");
  define(this->SpecularOcclusion, "IBL_SPECULAR_OCCLUSION");
  define(this->HorizonOcclusion, "IBL_HORIZON_OCCLUSION");
  const char* file = this->SamplesPerPixel > 0 ? "vtkIBLLightingSampled.glsl" : "vtkIBLLighting.glsl";
  defines += std::string("// ") + file + "\n";
  if (defines != this->ShaderDefines)
  {
    this->ShaderDefines = defines;
    this->ShaderText = defines + vtkIBLAssembleChunk(file);
    this->ShaderTime.Modified();
  }
}

std::string vtkIBLLighting::GetShaderChunk(const std::vector<std::string>& features) const
{
  std::string defines;
  for (const std::string& feature : features)
  {
    defines += "#define " + feature + "\n";
  }
  return defines + this->ShaderText;
}
