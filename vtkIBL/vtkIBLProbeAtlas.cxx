// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLProbeAtlas.h"

#include <algorithm>

using vtkIBLGL::Texture;

bool vtkIBLProbeAtlas::Prepare(vtkOpenGLRenderWindow* window, int faceSize, int samples)
{
  if (this->Radiance.IsIn(window) && this->FaceSize == faceSize && this->Samples == samples)
  {
    return false;
  }
  *this = vtkIBLProbeAtlas();
  this->Window = window;
  this->FaceSize = faceSize;
  this->Samples = samples;
  this->Ladder = vtkIBLLadder(std::max(faceSize / 2, int(vtkIBLLadder::LeastFaceSize)));
  this->Resample = vtkIBLGL::Program::Compute(window, "vtkIBLCubeResampleCS.glsl");
  this->Clean = vtkIBLGL::Program::Compute(window, "vtkIBLCubeCleanCS.glsl");
  this->Frame = vtkIBLGL::Framebuffer::Make(window, faceSize);
  this->Allocate(2);
  return true;
}

void vtkIBLProbeAtlas::Allocate(int count)
{
  const int old = int(this->Elements.size());
  const auto grow = [&](const Texture& from, int size, int levels, GLenum format)
  {
    Texture to = Texture::CubeArray(this->Window, size, count, levels, format);
    for (int level = 0; level < levels; ++level)
    {
      glClearTexImage(to.Id(), level, GL_RGBA, GL_FLOAT, nullptr);
      if (old > 0)
      {
        glCopyImageSubData(from.Id(), GL_TEXTURE_CUBE_MAP_ARRAY, level, 0, 0, 0, to.Id(), GL_TEXTURE_CUBE_MAP_ARRAY,
          level, 0, 0, 0, size >> level, size >> level, 6 * old);
      }
    }
    return to;
  };
  const int levels = this->Ladder.GetNumberOfLevels();
  Texture radiance = grow(this->Radiance, this->FaceSize, vtkIBLGL::CountMipLevels(this->FaceSize), GL_RGBA32F);
  Texture odd = grow(this->Odd, this->Ladder.FaceSize, levels, GL_RGBA16F);
  Texture even = grow(this->Even, this->Ladder.EvenFaceSize, levels, GL_RGBA16F);
  odd.ReadWholeLevels();
  even.ReadWholeLevels();
  std::vector<Element> elements(count);
  for (int i = 0; i < count; ++i)
  {
    elements[i].Radiance = Texture::CubeOf(this->Window, radiance, i);
    elements[i].Odd = Texture::CubeOf(this->Window, odd, i);
    elements[i].Even = Texture::CubeOf(this->Window, even, i);
    elements[i].StoredScale = i < old ? this->Elements[i].StoredScale : 1.0;
    elements[i].IsTaken = i < old;
  }
  vtkIBLGL::CheckErrors("making room for the light of probes");
  this->Elements = std::move(elements);
  this->Radiance = std::move(radiance);
  this->Odd = std::move(odd);
  this->Even = std::move(even);
  if (this->Bound)
  {
    this->Bound.reset();
    this->Activate();
  }
}

std::optional<int> vtkIBLProbeAtlas::Take()
{
  const auto find = [this]
  {
    return std::find_if(
      this->Elements.begin(), this->Elements.end(), [](const Element& element) { return !element.IsTaken; });
  };
  auto found = find();
  if (found == this->Elements.end())
  {
    const int count = std::min(2 * int(this->Elements.size()), MostElements);
    if (count == int(this->Elements.size()))
    {
      return std::nullopt;
    }
    this->Allocate(count);
    found = find();
  }
  found->IsTaken = true;
  return int(found - this->Elements.begin());
}

void vtkIBLProbeAtlas::Give(int& element)
{
  if (element >= 0)
  {
    this->Elements[element].IsTaken = false;
    element = -1;
  }
}

void vtkIBLProbeAtlas::Activate()
{
  using vtkIBLGL::BoundTexture;
  this->Bound.reset(new Bindings{ BoundTexture(this->Window, this->Radiance), BoundTexture(this->Window, this->Odd),
    BoundTexture(this->Window, this->Even) });
}

//------------------------------------------------------------------------------
const vtkIBLGL::Framebuffer& vtkIBLProbeAtlas::AttachFace(int element, int face) const
{
  this->Frame.AttachLayer(this->Radiance, 0, 6 * element + face);
  return this->Frame;
}

void vtkIBLProbeAtlas::CopyFaces(int from, int to) const
{
  glCopyImageSubData(this->Radiance.Id(), GL_TEXTURE_CUBE_MAP_ARRAY, 0, 0, 0, 6 * from, this->Radiance.Id(),
    GL_TEXTURE_CUBE_MAP_ARRAY, 0, 0, 0, 6 * to, this->FaceSize, this->FaceSize, 6);
}

void vtkIBLProbeAtlas::CopyLevels(const vtkIBLGL::Texture& cube, int to) const
{
  for (int level = 0; level < vtkIBLGL::CountMipLevels(this->FaceSize); ++level)
  {
    glCopyImageSubData(cube.Id(), GL_TEXTURE_CUBE_MAP, level, 0, 0, 0, this->Radiance.Id(), GL_TEXTURE_CUBE_MAP_ARRAY,
      level, 0, 0, 6 * to, this->FaceSize >> level, this->FaceSize >> level, 6);
  }
}

void vtkIBLProbeAtlas::MakeLevels(int element)
{
  using namespace vtkIBLGL;
  const Texture& cube = this->Elements[element].Radiance;
  {
    ActiveProgram active(this->Window, this->Clean);
    BoundImage target(0, cube, 0, GL_READ_WRITE, GL_RGBA32F);
    DispatchTiles(this->FaceSize, 6);
  }
  MakeMipLevels(this->Window, this->Resample, cube, CountMipLevels(this->FaceSize));
}

void vtkIBLProbeAtlas::MakeLayers(int element, int first, int last, double storedScale)
{
  Element& target = this->Elements[element];
  target.StoredScale = storedScale;
  std::vector<vtkIBLSampledFilter::Layer> layers;
  for (int layer = first; layer <= this->GetNumberOfLayers(); ++layer)
  {
    layers.push_back({ this->Ladder.GetPerceptualRoughness(layer), layer % 2 ? &target.Odd : &target.Even,
      vtkIBLLadder::GetLevel(layer), layer > last });
  }
  this->Filter.Run(this->Window, target.Radiance, storedScale, layers, this->Samples);
}

vtkTypeInt64 vtkIBLProbeAtlas::CountTexels(int firstLayer, int lastLayer) const
{
  vtkTypeInt64 count = 0;
  for (int layer = firstLayer; layer <= lastLayer; ++layer)
  {
    const vtkTypeInt64 size = this->Ladder.GetLayerFaceSize(layer);
    count += 6 * size * size;
  }
  return count;
}
