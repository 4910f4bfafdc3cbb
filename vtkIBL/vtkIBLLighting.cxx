// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLLighting.h"

#include "vtkIBLBRDFTable.h"
#include "vtkIBLCubeMap.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLGL.h"
#include "vtkIBLShaderSource.h"
#include "vtkIBLSpecularChain.h"
#include "vtkIBLStatistics.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <algorithm>

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
  os << indent << "EnergyCompensation: " << this->EnergyCompensation << "\n";
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

void vtkIBLLighting::SetSamplesPerPixel(int samples)
{
  samples = std::clamp(samples, 0, 65536);
  if (samples != this->SamplesPerPixel)
  {
    if ((samples > 0) != (this->SamplesPerPixel > 0))
    {
      this->ShaderTime.Modified();
    }
    this->SamplesPerPixel = samples;
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
  this->CubeMap->SetMipLevelsNeeded(sampled || this->SpecularChain->GetEngine() == vtkIBLSpecularChain::Sampled ||
    environment->GetNumberOfFaces() == 6);
  bool ready = this->BRDFTable->Update(window);
  if (sampled || this->Needs.MinimumRoughness < vtkIBLSpecularChain::GetFirstRoughness())
  {
    ready = this->CubeMap->Update(window) && ready;
  }
  if (!sampled && (this->Needs.Irradiance || this->Needs.MaximumRoughness > 0.0))
  {
    ready = this->SpecularChain->Update(window) && ready;
  }
  environment->KeepLight();
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

void vtkIBLLighting::GetEnvironmentFromView(vtkRenderer* renderer, float rows[9])
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
  for (int i = 0; i < 9; ++i)
  {
    rows[i] = static_cast<float>(linear[i / 3][i % 3]);
  }
}

void vtkIBLLighting::SetLayerParameters(const vtkIBLGL::Program& program) const
{
  program.Set("iblRadiance", this->Bound->Radiance.GetUnit());
  program.Set("iblOddLayers", this->Bound->OddLayers.GetUnit());
  program.Set("iblEvenLayers", this->Bound->EvenLayers.GetUnit());
  program.Set("iblLayers", float(this->SpecularChain->GetNumberOfLayers()));
  program.Set("iblStoredScale", float(this->SpecularChain->GetStoredScale()));
}

void vtkIBLLighting::SetShaderParameters(vtkShaderProgram* program, vtkRenderer* renderer)
{
  // Layers are stored divided by a scale, the cube map as it is.
  const double stored = this->SamplesPerPixel > 0 ? 1.0 : this->SpecularChain->GetStoredScale();
  program->SetUniformi("iblBRDFTable", this->Bound->Table.GetUnit());
  if (this->SamplesPerPixel > 0)
  {
    program->SetUniformi("iblRadiance", this->Bound->Radiance.GetUnit());
    program->SetUniformi("iblSamplesPerPixel", this->SamplesPerPixel);
  }
  else
  {
    program->SetUniformi("iblRadiance", this->Bound->Radiance.GetUnit());
    program->SetUniformi("iblOddLayers", this->Bound->OddLayers.GetUnit());
    program->SetUniformi("iblEvenLayers", this->Bound->EvenLayers.GetUnit());
    program->SetUniformi("iblIrradiance", this->Bound->Irradiance.GetUnit());
    program->SetUniformf("iblLayers", float(this->SpecularChain->GetNumberOfLayers()));
    program->SetUniformf("iblStoredScale", float(stored));
  }

  float rows[9];
  this->GetEnvironmentFromView(renderer, rows);
  float columns[9];
  for (int i = 0; i < 9; ++i)
  {
    columns[3 * (i % 3) + i / 3] = rows[i];
  }
  program->SetUniformMatrix3x3("iblEnvironmentFromView", columns);
  double rgb[3];
  this->GetEnvironment()->GetRadianceScale(rgb);
  const float scale[3] = { float(rgb[0] * stored), float(rgb[1] * stored), float(rgb[2] * stored) };
  program->SetUniform3f("iblRadianceScale", scale);
  program->SetUniformi("iblParallelProjection", renderer->GetActiveCamera()->GetParallelProjection());
  program->SetUniformi("iblEnergyCompensation", this->EnergyCompensation);
}

std::string vtkIBLLighting::GetShaderChunk() const
{
  return vtkIBLAssembleChunk(this->SamplesPerPixel > 0 ? "vtkIBLLightingSampled.glsl" : "vtkIBLLighting.glsl");
}
