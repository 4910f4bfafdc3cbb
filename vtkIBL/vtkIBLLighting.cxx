// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLLighting.h"

#include "vtkIBLBRDFTable.h"
#include "vtkIBLCubeMap.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLGL.h"
#include "vtkIBLIrradiance.h"
#include "vtkIBLShaderSource.h"
#include "vtkIBLSpecularChain.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <algorithm>

vtkStandardNewMacro(vtkIBLLighting);

struct vtkIBLLighting::Bindings
{
  Bindings(vtkOpenGLRenderWindow* window, const vtkIBLCubeMap& cubeMap, const vtkIBLSpecularChain& chain,
    const vtkIBLBRDFTable& table)
    : Radiance(window, cubeMap.GetTexture())
    , EvenLayers(window, chain.GetEvenLayers())
    , OddLayers(window, chain.GetOddLayers())
    , Table(window, table.GetTexture())
  {
  }
  vtkIBLGL::BoundTexture Radiance;
  vtkIBLGL::BoundTexture EvenLayers;
  vtkIBLGL::BoundTexture OddLayers;
  vtkIBLGL::BoundTexture Table;
};

vtkIBLLighting::vtkIBLLighting()
{
  this->SpecularChain->SetCubeMap(this->CubeMap);
  this->SetEnvironment(nullptr);
}

vtkIBLLighting::~vtkIBLLighting() = default;

void vtkIBLLighting::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "EnergyCompensation: " << this->EnergyCompensation << "\n";
  for (vtkIBLStage* stage : { static_cast<vtkIBLStage*>(this->CubeMap), static_cast<vtkIBLStage*>(this->Irradiance),
         static_cast<vtkIBLStage*>(this->SpecularChain), static_cast<vtkIBLStage*>(this->BRDFTable) })
  {
    os << indent << stage->GetClassName() << ":\n";
    stage->PrintSelf(os, indent.GetNextIndent());
  }
}

void vtkIBLLighting::SetEnvironment(vtkIBLEnvironment* environment)
{
  vtkNew<vtkIBLEnvironment> studio;
  this->CubeMap->SetEnvironment(environment ? environment : studio);
  this->Irradiance->SetEnvironment(this->CubeMap->GetEnvironment());
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

vtkIBLIrradiance* vtkIBLLighting::GetIrradiance() const
{
  return this->Irradiance;
}

vtkIBLSpecularChain* vtkIBLLighting::GetSpecularChain() const
{
  return this->SpecularChain;
}

vtkIBLBRDFTable* vtkIBLLighting::GetBRDFTable() const
{
  return this->BRDFTable;
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
  return this->BRDFTable->Update(window) && this->Irradiance->Update(window) && this->SpecularChain->Update(window);
}

void vtkIBLLighting::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Deactivate();
  this->SpecularChain->ReleaseGraphicsResources(window);
  this->Irradiance->ReleaseGraphicsResources(window);
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
    program->SetUniformi("iblEvenLayers", this->Bound->EvenLayers.GetUnit());
    program->SetUniformi("iblOddLayers", this->Bound->OddLayers.GetUnit());
    float irradiance[7][4];
    this->Irradiance->GetPacked(irradiance);
    for (auto& vector : irradiance)
    {
      for (float& x : vector)
      {
        x = static_cast<float>(x / stored);
      }
    }
    program->SetUniform4fv("iblIrradiance", 7, irradiance);
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
