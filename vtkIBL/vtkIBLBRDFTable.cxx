// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLBRDFTable.h"

#include "vtkIBLBRDFTableTexels.h"
#include "vtkIBLGL.h"
#include "vtkIBLShared.glsl"

#include "vtkImageData.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkIBLBRDFTable);

static_assert(
  vtkIBLBRDFTable::SmithCorrelated == IBL_SMITH_CORRELATED && vtkIBLBRDFTable::SchlickSmith == IBL_SCHLICK_SMITH,
  "the shader takes the enumeration's values");
static_assert(vtkIBLBRDFTable::Size == vtkIBLBRDFTableSize, "the header says how large the constant is");

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

bool vtkIBLBRDFTable::UpdateInput(vtkOpenGLRenderWindow*, vtkMTimeType&)
{
  return true;
}

std::vector<vtkIBLStatistics::Work> vtkIBLBRDFTable::Build(vtkOpenGLRenderWindow* window)
{
  using namespace vtkIBLGL;
  Texture table = Texture::Image2D(window, Size, Size, GL_RG16);
  if (this->GeometryTerm == SmithCorrelated && this->NumberOfSamples == 0)
  {
    glTextureSubImage2D(table.Id(), 0, 0, 0, Size, Size, GL_RG, GL_UNSIGNED_SHORT, vtkIBLBRDFTableTexels);
    CheckErrors("uploading the BRDF table");
  }
  else
  {
    this->Sample(window, table);
  }
  this->Internal->Table = std::move(table);
  return { { vtkIBLStatistics::BRDFTable, 1, Size * Size, 4 * Size * Size } };
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
  BoundImage target(0, table, 0, GL_WRITE_ONLY, GL_RG16);
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
  return this->Internal->Table.Read(0);
}
