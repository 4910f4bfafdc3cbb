// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLBRDFTable.h"

#include "vtkIBLGL.h"
#include "vtkIBLShared.glsl"

#include "vtkImageData.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkIBLBRDFTable);

static_assert(
  vtkIBLBRDFTable::SmithCorrelated == IBL_SMITH_CORRELATED && vtkIBLBRDFTable::SchlickSmith == IBL_SCHLICK_SMITH,
  "the shader takes the enumeration's values");

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

vtkTypeInt64 vtkIBLBRDFTable::Build(vtkOpenGLRenderWindow* window)
{
  using namespace vtkIBLGL;
  Internals& gl = *this->Internal;
  if (!gl.Program)
  {
    gl.Program = Program::Compute(window, "vtkIBLBRDFTableCS.glsl");
  }
  Texture table = Texture::Image2D(window, Size, Size, GL_RG32F);
  gl.Program.Set("geometry", this->GeometryTerm);
  gl.Program.Set("sampleCount", this->NumberOfSamples);
  {
    ActiveProgram active(window, gl.Program);
    BoundImage target(0, table, 0, GL_WRITE_ONLY, GL_RG32F);
    DispatchTiles(Size, 1);
  }
  gl.Table = std::move(table);
  return vtkTypeInt64(Size) * Size;
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
