// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLIrradiance.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLHarmonics.h"
#include "vtkIBLThreads.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <vector>

vtkStandardNewMacro(vtkIBLIrradiance);

struct vtkIBLIrradiance::Internals
{
  vtkIBLHarmonics Harmonics{ 2 };
  std::vector<vtkIBLBrightTexel> BrightTexels; // what is not in them
};

vtkIBLIrradiance::vtkIBLIrradiance()
  : Internal(new Internals)
{
}

vtkIBLIrradiance::~vtkIBLIrradiance() = default;

void vtkIBLIrradiance::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Environment: " << this->Environment.Get() << "\n"
     << indent << "Order: " << this->Order << "\n"
     << indent << "KeepBrightTexels: " << this->KeepBrightTexels << "\n"
     << indent << "NumberOfBrightTexels: " << this->GetNumberOfBrightTexels() << "\n"
     << indent << "RadianceCoefficients:\n";
  for (const glm::dvec3& c : this->Internal->Harmonics.RGB)
  {
    os << indent << "  " << c.r << " " << c.g << " " << c.b << "\n";
  }
}

void vtkIBLIrradiance::SetEnvironment(vtkIBLEnvironment* environment)
{
  if (this->Environment != environment)
  {
    this->Environment = environment;
    this->Modified();
  }
}

vtkIBLEnvironment* vtkIBLIrradiance::GetEnvironment() const
{
  return this->Environment;
}

void vtkIBLIrradiance::SetOrder(int order)
{
  if (order != 2 && order != 4 && order != 8)
  {
    vtkErrorMacro("Order is " << order << "; it must be 2, 4 or 8. The old one, " << this->Order << ", stays.");
  }
  else if (order != this->Order)
  {
    this->Order = order;
    this->Modified();
  }
}

void vtkIBLIrradiance::SetKeepBrightTexels(bool keep)
{
  if (keep != this->KeepBrightTexels)
  {
    this->KeepBrightTexels = keep;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkIBLIrradiance::GetNumberOfCoefficients() const
{
  return static_cast<int>(this->Internal->Harmonics.RGB.size());
}

void vtkIBLIrradiance::GetRadianceCoefficient(int index, double rgb[3]) const
{
  const glm::dvec3& c = this->Internal->Harmonics.RGB[std::clamp(index, 0, this->GetNumberOfCoefficients() - 1)];
  std::copy_n(&c.x, 3, rgb);
}

void vtkIBLIrradiance::GetWorldCoefficients(double* rgb) const
{
  glm::dmat3 worldFromEnvironment(1.0); // GLM has columns where VTK has rows
  if (this->Environment)
  {
    this->Environment->GetEnvironmentFromWorld(&worldFromEnvironment[0].x);
  }
  for (const glm::dvec3& c : vtkIBLTurnHarmonics(this->Internal->Harmonics, glm::transpose(worldFromEnvironment)).RGB)
  {
    rgb = std::copy_n(&c.x, 3, rgb);
  }
}

int vtkIBLIrradiance::GetNumberOfBrightTexels() const
{
  return static_cast<int>(this->Internal->BrightTexels.size());
}

double vtkIBLIrradiance::GetBrightTexel(int index, double direction[3], double radiance[3]) const
{
  const vtkIBLBrightTexel& texel = this->Internal->BrightTexels.at(index);
  std::copy_n(&texel.Direction.x, 3, direction);
  std::copy_n(&texel.Radiance.x, 3, radiance);
  return texel.SolidAngle;
}

void vtkIBLIrradiance::GetIrradiance(const double normal[3], double rgb[3]) const
{
  const glm::dvec3 irradiance = vtkIBLEvaluateIrradiance(
    this->Internal->Harmonics, this->Internal->BrightTexels, { normal[0], normal[1], normal[2] });
  std::copy_n(&irradiance.x, 3, rgb);
}

void vtkIBLIrradiance::GetPacked(float vectors[7][4]) const
{
  vtkIBLHarmonics all = this->Internal->Harmonics;
  vtkIBLAddBrightTexels(this->Internal->BrightTexels, all);
  for (const glm::dvec4& packed : vtkIBLPackIrradiance(all))
  {
    std::copy_n(&packed.x, 4, *vectors++);
  }
}

//------------------------------------------------------------------------------
bool vtkIBLIrradiance::UpdateInput(vtkOpenGLRenderWindow*, vtkMTimeType& inputTime)
{
  if (!this->Environment || !this->Environment->Update())
  {
    return false;
  }
  inputTime = this->Environment->GetRadianceTime();
  return true;
}

vtkIBLStatistics* vtkIBLIrradiance::GetInputStatistics() const
{
  return this->Environment->GetStatistics();
}

std::vector<vtkIBLStatistics::Work> vtkIBLIrradiance::Build(vtkOpenGLRenderWindow*)
{
  Internals made;
  if (this->Environment->GetNumberOfFaces() == 6)
  {
    made.Harmonics = vtkIBLMakeHarmonics(this->Environment->GetRadiance(), this->Order, vtkIBLRunOnThreads);
  }
  else
  {
    const std::shared_ptr<const vtkIBLSpectrum> spectrum = this->Environment->GetSpectrum(this->Order);
    made.Harmonics = vtkIBLMakeHarmonics(*spectrum, this->Order);
    made.BrightTexels = spectrum->GetBrightTexels();
    if (!this->KeepBrightTexels)
    {
      vtkIBLAddBrightTexels(made.BrightTexels, made.Harmonics);
      made.BrightTexels.clear();
    }
  }
  *this->Internal = std::move(made);
  const auto texels = vtkTypeInt64(this->Environment->GetNumberOfTexels());
  return { { vtkIBLStatistics::IrradianceCoefficients, 1, texels, 24 * this->GetNumberOfCoefficients() } };
}

void vtkIBLIrradiance::Release() {}
