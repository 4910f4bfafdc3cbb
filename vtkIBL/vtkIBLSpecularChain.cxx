// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLSpecularChain.h"

#include "vtkIBLCubeMap.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLGL.h"
#include "vtkIBLRadianceImage.h"
#include "vtkIBLSampleTable.h"
#include "vtkIBLShaderFunctions.h"
#include "vtkIBLSpectrum.h"
#include "vtkIBLThreads.h"

#include "vtkImageData.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <vector>

vtkStandardNewMacro(vtkIBLSpecularChain);

namespace
{
// The roughest layers have a sixteenth of this, and below 16^2 a smooth lobe shows its texels, however small the
// source.
constexpr int leastFaceSize = 256;
}

struct vtkIBLSpecularChain::Internals
{
  vtkIBLGL::Texture Chains[2];
  vtkIBLGL::Program Prefilter;
  std::vector<vtkIBLBrightTexel> BrightTexels;
};

vtkIBLSpecularChain::vtkIBLSpecularChain()
  : Internal(new Internals)
{
}

vtkIBLSpecularChain::~vtkIBLSpecularChain() = default;

void vtkIBLSpecularChain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CubeMap: " << this->CubeMap.Get() << "\n"
     << indent << "Engine: " << (this->Engine == Spectral ? "Spectral" : "Sampled") << "\n"
     << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n"
     << indent << "FaceSize: " << this->FaceSize << "\n"
     << indent << "StoredScale: " << this->StoredScale << "\n";
}

void vtkIBLSpecularChain::SetCubeMap(vtkIBLCubeMap* cubeMap)
{
  if (this->CubeMap != cubeMap)
  {
    this->CubeMap = cubeMap;
    this->Modified();
  }
}

vtkIBLCubeMap* vtkIBLSpecularChain::GetCubeMap() const
{
  return this->CubeMap;
}

int vtkIBLSpecularChain::GetNumberOfLayers()
{
  return IBL_LAYER_COUNT;
}

double vtkIBLSpecularChain::GetPerceptualRoughness(int layer)
{
  return vtkIBLCore::ShaderFunctions<double>().iblPerceptualRoughnessFromLayer(
    std::clamp(layer, 0, IBL_LAYER_COUNT - 1));
}

int vtkIBLSpecularChain::GetLayerFaceSize(int layer) const
{
  return this->OutputFaceSize >> (std::clamp(layer, 0, IBL_LAYER_COUNT - 1) / 2);
}

int vtkIBLSpecularChain::GetNumberOfBrightTexels() const
{
  return static_cast<int>(this->Internal->BrightTexels.size());
}

double vtkIBLSpecularChain::GetBrightTexel(int index, double direction[3], double radiance[3]) const
{
  const vtkIBLBrightTexel& texel = this->Internal->BrightTexels.at(index);
  for (int k = 0; k < 3; ++k)
  {
    direction[k] = texel.Direction[k];
    radiance[k] = texel.Radiance[k];
  }
  return texel.SolidAngle;
}

const vtkIBLGL::Texture& vtkIBLSpecularChain::GetEvenLayers() const
{
  return this->Internal->Chains[0];
}

const vtkIBLGL::Texture& vtkIBLSpecularChain::GetOddLayers() const
{
  return this->Internal->Chains[1];
}

bool vtkIBLSpecularChain::UpdateInput(vtkOpenGLRenderWindow* window, vtkMTimeType& inputTime)
{
  if (!this->CubeMap || !this->CubeMap->Update(window))
  {
    return false;
  }
  inputTime = this->CubeMap->GetBuildTime();
  return true;
}

vtkTypeInt64 vtkIBLSpecularChain::Build(vtkOpenGLRenderWindow* window)
{
  using namespace vtkIBLGL;
  Internals& gl = *this->Internal;
  if (!gl.Prefilter)
  {
    gl.Prefilter = Program::Compute(window, "vtkIBLSpecularPrefilterCS.glsl");
  }
  const int sourceSize = this->CubeMap->GetOutputFaceSize();
  int faceSize = leastFaceSize;
  while (2 * faceSize <= this->FaceSize)
  {
    faceSize *= 2;
  }
  const double mean = this->CubeMap->GetMeanLuminance();
  const double storedScale = mean > 0.0 ? mean : 1.0;

  Texture chains[2] = { Texture::Cube(window, faceSize, IBL_CHAIN_LEVELS, GL_RGBA16F),
    Texture::Cube(window, faceSize, IBL_CHAIN_LEVELS, GL_RGBA16F) };
  BoundTexture source(window, this->CubeMap->GetTexture());
  ActiveProgram active(window, gl.Prefilter);
  gl.Prefilter.Set("source", source.GetUnit());
  gl.Prefilter.Set("radianceScale", float(1.0 / storedScale));
  gl.BrightTexels.clear();
  int spectralFrom = IBL_LAYER_COUNT;
  vtkTypeInt64 texels = 0;
  if (this->Engine == Spectral)
  {
    texels += this->BuildSpectralLayers(chains, faceSize, storedScale, spectralFrom);
  }
  for (int layer = 0; layer < spectralFrom; ++layer)
  {
    const int size = faceSize >> (layer / 2);
    const vtkIBLSampleTable table =
      vtkIBLMakeSampleTable(GetPerceptualRoughness(layer), sourceSize, size, this->NumberOfSamples);
    const Buffer samples = Buffer::Make(window, table.Samples.size() * sizeof(glm::vec4), table.Samples.data());
    const Buffer weights = Buffer::Make(window, table.Weights.size() * sizeof(float), table.Weights.data());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, samples.Id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, weights.Id());
    gl.Prefilter.Set("sampleCount", int(table.Weights.size()));
    BoundImage target(0, chains[layer % 2], layer / 2, GL_WRITE_ONLY, GL_RGBA16F);
    DispatchTiles(size, 6);
    texels += vtkTypeInt64(6) * size * size;
  }
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, 0);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, 0);

  gl.Chains[0] = std::move(chains[0]);
  gl.Chains[1] = std::move(chains[1]);
  this->OutputFaceSize = faceSize;
  this->StoredScale = storedScale;
  return texels;
}

vtkTypeInt64 vtkIBLSpecularChain::BuildSpectralLayers(
  vtkIBLGL::Texture* chains, int faceSize, double storedScale, int& firstLayer)
{
  const vtkIBLRadianceImage radiance = this->CubeMap->GetEnvironment()->GetRadiance();
  if (radiance.Faces != 1)
  {
    return 0;
  }
  firstLayer = 1;
  while (vtkIBLSpectrum::RequiredOrder(GetPerceptualRoughness(firstLayer)) > 128)
  {
    ++firstLayer;
  }
  const int order = vtkIBLSpectrum::RequiredOrder(GetPerceptualRoughness(firstLayer));
  const vtkIBLSpectrum spectrum(radiance, order, vtkIBLRunOnThreads);
  this->Internal->BrightTexels = spectrum.GetBrightTexels();
  vtkTypeInt64 texels = 0;
  for (int layer = firstLayer; layer < IBL_LAYER_COUNT; ++layer)
  {
    const int size = faceSize >> (layer / 2);
    std::vector<float> rgb(std::size_t(18) * size * size);
    spectrum.Filter(GetPerceptualRoughness(layer), size, rgb.data(), vtkIBLRunOnThreads);
    std::transform(rgb.begin(), rgb.end(), rgb.begin(),
      [storedScale](float x) { return std::min(static_cast<float>(x / storedScale), 65504.0f); });
    glTextureSubImage3D(chains[layer % 2].Id(), layer / 2, 0, 0, 0, size, size, 6, GL_RGB, GL_FLOAT, rgb.data());
    texels += vtkTypeInt64(6) * size * size;
  }
  vtkIBLGL::CheckErrors("uploading layers");
  return texels;
}

void vtkIBLSpecularChain::Release()
{
  *this->Internal = Internals();
  this->OutputFaceSize = 0;
}

vtkSmartPointer<vtkImageData> vtkIBLSpecularChain::ReadLayer(int layer)
{
  if (layer < 0 || layer >= IBL_LAYER_COUNT || this->OutputFaceSize == 0)
  {
    vtkErrorMacro(
      "There is no layer " << layer << "; the chain has 0 to " << IBL_LAYER_COUNT - 1 << " after Update().");
    return nullptr;
  }
  auto image = this->Internal->Chains[layer % 2].Read(layer / 2);
  auto* value = static_cast<float*>(image->GetScalarPointer());
  std::transform(
    value, value + 3 * image->GetNumberOfPoints(), value, [this](float x) { return float(x * this->StoredScale); });
  return image;
}
