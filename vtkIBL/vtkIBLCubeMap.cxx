// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLCubeMap.h"

#include "vtkIBLCubeConversion.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLGL.h"
#include "vtkIBLRadianceImage.h"
#include "vtkIBLThreads.h"

#include "vtkImageData.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <vector>

vtkStandardNewMacro(vtkIBLCubeMap);

struct vtkIBLCubeMap::Internals
{
  vtkIBLGL::Texture Cube;
  vtkIBLGL::Program Resample;
};

namespace
{
int FloorPowerOfTwo(int n)
{
  int power = 1;
  while (2 * power <= n)
  {
    power *= 2;
  }
  return power;
}

// `own`: what keeps the source's detail.
int ChooseFaceSize(int wanted, int own)
{
  constexpr int least = 16;
  constexpr int largestByDefault = 512;
  return std::max(FloorPowerOfTwo(wanted > 0 ? wanted : std::min(own, largestByDefault)), least);
}

// Six faces to the finest level.
void Upload(const vtkIBLGL::Texture& cube, int faceSize, const float* rgb)
{
  glPixelStorei(
    GL_UNPACK_ALIGNMENT, 4); // rows of three floats are always so aligned; VTK's cache has 1 or 4 here, either will do
  glTextureSubImage3D(cube.Id(), 0, 0, 0, 0, faceSize, faceSize, 6, GL_RGB, GL_FLOAT, rgb);
  vtkIBLGL::CheckErrors("uploading the environment");
}

void RequireTextureSize(int faceSize)
{
  GLint largest = 0;
  glGetIntegerv(GL_MAX_CUBE_MAP_TEXTURE_SIZE, &largest);
  if (faceSize > largest)
  {
    std::ostringstream words;
    words << "the environment's faces are " << faceSize << "x" << faceSize << ", and this GPU takes cube maps up to "
          << largest << "; lower vtkIBLEnvironment's MaximumWidth";
    throw std::runtime_error(words.str());
  }
}
}

vtkIBLCubeMap::vtkIBLCubeMap()
  : Internal(new Internals)
{
}

vtkIBLCubeMap::~vtkIBLCubeMap() = default;

void vtkIBLCubeMap::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Environment: " << this->Environment.Get() << "\n"
     << indent << "FaceSize: " << this->FaceSize << "\n"
     << indent << "OutputFaceSize: " << this->OutputFaceSize << "\n"
     << indent << "MipLevelsNeeded: " << this->MipLevelsNeeded << "\n";
}

void vtkIBLCubeMap::SetEnvironment(vtkIBLEnvironment* environment)
{
  if (this->Environment != environment)
  {
    this->Environment = environment;
    this->Modified();
  }
}

vtkIBLEnvironment* vtkIBLCubeMap::GetEnvironment() const
{
  return this->Environment;
}

int vtkIBLCubeMap::GetNumberOfLevels() const
{
  return this->OutputLevels;
}

const vtkIBLGL::Texture& vtkIBLCubeMap::GetTexture() const
{
  return this->Internal->Cube;
}

bool vtkIBLCubeMap::UpdateInput(vtkOpenGLRenderWindow*, vtkMTimeType& inputTime)
{
  if (!this->Environment || !this->Environment->Update())
  {
    return false;
  }
  inputTime = this->Environment->GetRadianceTime();
  return true;
}

vtkIBLStatistics* vtkIBLCubeMap::GetInputStatistics() const
{
  return this->Environment->GetStatistics();
}

std::vector<vtkIBLStatistics::Work> vtkIBLCubeMap::Build(vtkOpenGLRenderWindow* window)
{
  using namespace vtkIBLGL;
  const bool isCube = this->Environment->GetNumberOfFaces() == 6;
  const int width = this->Environment->GetWidth();
  // At a face's centre a texel spans 2/n radians; one of a lat-long image 2 pi/W.
  const int faceSize = ChooseFaceSize(this->FaceSize, isCube ? width : width / 4);
  const int levels = this->MipLevelsNeeded ? CountMipLevels(faceSize) : 1;

  Internals& gl = *this->Internal;
  if (!gl.Resample && (isCube || levels > 1))
  {
    gl.Resample = Program::Compute(window, "vtkIBLCubeResampleCS.glsl");
  }
  Texture cube = Texture::Cube(window, faceSize, levels, GL_RGBA32F);
  if (isCube)
  {
    RequireTextureSize(width);
    const vtkIBLRadianceImage radiance = this->Environment->GetRadiance();
    const Texture faces = Texture::Cube(window, width, 1, GL_RGBA32F);
    Upload(faces, width, radiance.RGB);
    ResampleCube(window, gl.Resample, faces, 0, cube, 0);
  }
  else
  {
    Upload(cube, faceSize, this->Environment->GetCube(faceSize));
  }
  MakeMipLevels(window, gl.Resample, cube, levels);

  gl.Cube = std::move(cube);
  this->OutputFaceSize = faceSize;
  this->OutputLevels = levels;
  const auto texels = vtkTypeInt64(levels > 1 ? 8 : 6) * faceSize * faceSize; // six faces, and a third more for levels
  return { { vtkIBLStatistics::CubeMap, 1, texels, 16 * texels } };
}

void vtkIBLCubeMap::Release()
{
  *this->Internal = Internals();
  this->OutputFaceSize = 0;
  this->OutputLevels = 0;
}

vtkSmartPointer<vtkImageData> vtkIBLCubeMap::ReadLevel(int level)
{
  if (level < 0 || level >= this->GetNumberOfLevels())
  {
    vtkErrorMacro("There is no mip level " << level << "; the cube map has " << this->GetNumberOfLevels()
                                           << ". Call Update() first.");
    return nullptr;
  }
  return this->Internal->Cube.Read(level);
}
