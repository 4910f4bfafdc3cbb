// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLBRDFTable.h"

#include "vtkIBLBRDFTableTexels.h"
#include "vtkIBLGL.h"
#include "vtkIBLShaderFunctions.h"
#include "vtkIBLShared.glsl"

#include "vtkImageData.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

vtkStandardNewMacro(vtkIBLBRDFTable);

static_assert(
  vtkIBLBRDFTable::SmithCorrelated == IBL_SMITH_CORRELATED && vtkIBLBRDFTable::SchlickSmith == IBL_SCHLICK_SMITH,
  "the shader takes the enumeration's values");
static_assert(vtkIBLBRDFTable::Size == vtkIBLBRDFTableSize && vtkIBLBRDFTable::Size == IBL_TABLE_SIZE,
  "the header, the constant and the shaders say how large it is");

namespace
{
// Along R, of the surface's own roughness, all of it; A and B are to come.
std::vector<std::uint16_t> MakePlainLobes()
{
  constexpr int n = vtkIBLBRDFTable::Size;
  vtkIBLCore::ShaderFunctions<double> shader;
  std::vector<std::uint16_t> texels(std::size_t(n) * n * vtkIBLBRDFTableChannels, 0);
  for (int j = 0; j < n; ++j)
  {
    const auto roughness = static_cast<std::uint16_t>(std::lround(65535.0 * shader.iblLadderPosition(j / (n - 1.0))));
    for (int i = 0; i < n; ++i)
    {
      texels.insert(texels.end(), { 65535, roughness, 65535, roughness });
    }
  }
  return texels;
}
}

struct vtkIBLBRDFTable::Internals
{
  vtkIBLGL::Texture Table;
  vtkIBLGL::Program Program;
};

vtkIBLBRDFTable::vtkIBLBRDFTable()
  : Internal(new Internals)
{
}

vtkIBLBRDFTable::~vtkIBLBRDFTable() = default;

void vtkIBLBRDFTable::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "GeometryTerm: " << (this->GeometryTerm == SmithCorrelated ? "SmithCorrelated" : "SchlickSmith")
     << "\n"
     << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
}

const vtkIBLGL::Texture& vtkIBLBRDFTable::GetTexture() const
{
  return this->Internal->Table;
}

double vtkIBLBRDFTable::GetNarrowestLobe(double perceptualRoughness)
{
  const double row = std::clamp(perceptualRoughness, 0.0, 1.0) * (Size - 1);
  const int below = std::min(static_cast<int>(row), Size - 2);
  double narrowest = 1.0;
  for (int i = 0; i < Size; ++i)
  {
    for (int channel : { 1, 3 })
    {
      const auto get = [&](int j)
      { return vtkIBLBRDFTableTexels[((Size + j) * Size + i) * vtkIBLBRDFTableChannels + channel] / 65535.0; };
      narrowest = std::min(narrowest, get(below) + (row - below) * (get(below + 1) - get(below)));
    }
  }
  return vtkIBLCore::ShaderFunctions<double>().iblPerceptualRoughnessFromPosition(narrowest);
}

bool vtkIBLBRDFTable::UpdateInput(vtkOpenGLRenderWindow*, vtkMTimeType&)
{
  return true;
}

std::vector<vtkIBLStatistics::Work> vtkIBLBRDFTable::Build(vtkOpenGLRenderWindow* window)
{
  using namespace vtkIBLGL;
  // Floats, though made of 16-bit numbers: llvmpipe reads them faster.
  Texture table = Texture::Image2D(window, Size, vtkIBLBRDFTableBlocks * Size, GL_RGBA32F);
  const bool fitted = this->GeometryTerm == SmithCorrelated;
  const std::vector<std::uint16_t> plain = fitted ? std::vector<std::uint16_t>() : MakePlainLobes();
  glTextureSubImage2D(table.Id(), 0, 0, 0, Size, vtkIBLBRDFTableBlocks * Size, GL_RGBA, GL_UNSIGNED_SHORT,
    fitted ? vtkIBLBRDFTableTexels : plain.data());
  CheckErrors("uploading the BRDF table");
  if (!fitted || this->NumberOfSamples > 0)
  {
    this->Sample(window, table);
  }
  this->Internal->Table = std::move(table);
  constexpr vtkTypeInt64 texels = vtkIBLBRDFTableBlocks * Size * Size;
  return { { vtkIBLStatistics::BRDFTable, 1, texels, 4 * vtkIBLBRDFTableChannels * texels } };
}

void vtkIBLBRDFTable::Sample(vtkOpenGLRenderWindow* window, const vtkIBLGL::Texture& table)
{
  using namespace vtkIBLGL;
  Program& program = this->Internal->Program;
  if (!program)
  {
    program = Program::Compute(window, "vtkIBLBRDFTableCS.glsl");
  }
  program.Set("geometry", this->GeometryTerm);
  program.Set("sampleCount", this->NumberOfSamples > 0 ? this->NumberOfSamples : 1024);
  ActiveProgram active(window, program);
  BoundImage target(0, table, 0, GL_READ_WRITE, GL_RGBA32F);
  DispatchTiles(Size, 1);
}

void vtkIBLBRDFTable::Release()
{
  *this->Internal = Internals();
}

vtkSmartPointer<vtkImageData> vtkIBLBRDFTable::Read()
{
  if (!this->Internal->Table)
  {
    vtkErrorMacro("The table is not built; call Update() first.");
    return nullptr;
  }
  return this->Internal->Table.Read(0, 4);
}
