// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLIrradiance.h"

#include "vtkIBLCubeMap.h"
#include "vtkIBLGL.h"
#include "vtkIBLShaderFunctions.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <vector>

vtkStandardNewMacro(vtkIBLIrradiance);

namespace
{
using Functions = vtkIBLCore::ShaderFunctions<double>;

int GetBand(int index)
{
  return index == 0 ? 0 : index < 4 ? 1 : 2;
}
}

struct vtkIBLIrradiance::Internals
{
  vtkIBLGL::Program Harmonics;
};

vtkIBLIrradiance::vtkIBLIrradiance()
  : Internal(new Internals)
{
}

vtkIBLIrradiance::~vtkIBLIrradiance() = default;

void vtkIBLIrradiance::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CubeMap: " << this->CubeMap.Get() << "\n" << indent << "RadianceCoefficients:\n";
  for (const auto& c : this->Coefficients)
  {
    os << indent << "  " << c[0] << " " << c[1] << " " << c[2] << "\n";
  }
}

void vtkIBLIrradiance::SetCubeMap(vtkIBLCubeMap* cubeMap)
{
  if (this->CubeMap != cubeMap)
  {
    this->CubeMap = cubeMap;
    this->Modified();
  }
}

vtkIBLCubeMap* vtkIBLIrradiance::GetCubeMap() const
{
  return this->CubeMap;
}

void vtkIBLIrradiance::GetRadianceCoefficient(int index, double rgb[3]) const
{
  std::copy_n(this->Coefficients[std::clamp(index, 0, 8)], 3, rgb);
}

void vtkIBLIrradiance::GetIrradiance(const double normal[3], double rgb[3]) const
{
  Functions shader;
  std::fill_n(rgb, 3, 0.0);
  for (int index = 0; index < 9; ++index)
  {
    const double basis = shader.iblHarmonic(index, Functions::vec3(normal[0], normal[1], normal[2])) *
      shader.iblCosineLobe(GetBand(index));
    for (int k = 0; k < 3; ++k)
    {
      rgb[k] += this->Coefficients[index][k] * basis;
    }
  }
  std::transform(rgb, rgb + 3, rgb, [](double x) { return std::max(x, 0.0); });
}

void vtkIBLIrradiance::GetPolynomial(float factors[9][3]) const
{
  // A direction for each basis function at which its polynomial is known: the constant in front is harmonic /
  // polynomial there.
  const double half = std::sqrt(0.5);
  const Functions::vec3 probes[9] = { { 0, 0, 1 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { half, half, 0 },
    { 0, half, half }, { 0, 0, 1 }, { half, 0, half }, { 1, 0, 0 } };
  const double polynomials[9] = { 1, 1, 1, 1, 0.5, 0.5, 2, 0.5, 1 };
  Functions shader;
  for (int index = 0; index < 9; ++index)
  {
    const double factor = shader.iblHarmonic(index, probes[index]) / polynomials[index] *
      shader.iblCosineLobe(GetBand(index)) / shader.iblPi;
    for (int k = 0; k < 3; ++k)
    {
      factors[index][k] = static_cast<float>(this->Coefficients[index][k] * factor);
    }
  }
}

bool vtkIBLIrradiance::UpdateInput(vtkOpenGLRenderWindow* window, vtkMTimeType& inputTime)
{
  if (!this->CubeMap || !this->CubeMap->Update(window))
  {
    return false;
  }
  inputTime = this->CubeMap->GetBuildTime();
  return true;
}

vtkTypeInt64 vtkIBLIrradiance::Build(vtkOpenGLRenderWindow* window)
{
  using namespace vtkIBLGL;
  if (!this->Internal->Harmonics)
  {
    this->Internal->Harmonics = Program::Compute(window, "vtkIBLHarmonicsCS.glsl");
  }
  const int size = this->CubeMap->GetOutputFaceSize();
  std::vector<glm::vec4> rows(std::size_t(size) * 6 * 9);
  const auto bytes = GLsizeiptr(rows.size() * sizeof(glm::vec4));
  const Buffer buffer = Buffer::Make(window, bytes, nullptr);
  {
    ActiveProgram active(window, this->Internal->Harmonics);
    BoundImage source(1, this->CubeMap->GetTexture(), 0, GL_READ_ONLY, GL_RGBA32F);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer.Id());
    glDispatchCompute(GLuint(size), 6, 1);
    FinishDispatch();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, 0);
  }
  glGetNamedBufferSubData(buffer.Id(), 0, bytes, rows.data());
  CheckErrors("reading harmonics back");

  double sums[9][3] = {};
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      sums[i % 9][k] += rows[i][k];
    }
  }
  std::copy_n(&sums[0][0], 27, &this->Coefficients[0][0]);
  return vtkTypeInt64(6) * size * size;
}

void vtkIBLIrradiance::Release()
{
  *this->Internal = Internals();
}
