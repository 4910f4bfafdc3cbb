// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLSpecularChain.h"

#include "vtkIBLCubeMap.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLGL.h"
#include "vtkIBLLadder.h"
#include "vtkIBLLampClusters.h"
#include "vtkIBLRadianceImage.h"
#include "vtkIBLSampledFilter.h"
#include "vtkIBLShared.glsl"
#include "vtkIBLThreads.h"

#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

vtkStandardNewMacro(vtkIBLSpecularChain);

using vtkIBLGL::Texture;

namespace
{
// At 32^2 the cosine lobe is read to 3e-4.
constexpr int IrradianceFaceSize = 32;

// Of all light, what a lamp has at least. Shading errs by 4.22 % on eight HDRIs with no such bound, by 4.26 with this
// one and by 9.02 with no lamp; a frame pays 5 % for each lamp, and has 2.5 of them on average in place of 3.4.
constexpr double LeastLampShare = 0.02;

// The strongest lamps; takes those that are to be lights, `apart` of them, out of `spectrum`.
std::vector<vtkIBLLampCluster> TakeLamps(std::shared_ptr<const vtkIBLSpectrum>& spectrum, int& apart)
{
  const std::vector<vtkIBLBrightTexel>& all = spectrum->GetBrightTexels();
  std::vector<vtkIBLLampCluster> lamps = vtkIBLFindLampClusters(all, vtkIBLSpectrum::LampRadius);
  const auto sum = [](const glm::dvec3& rgb) { return rgb.r + rgb.g + rgb.b; };
  double light = std::sqrt(4.0 * vtkMath::Pi()) * sum(spectrum->GetCoefficient(0, 0).first);
  for (const vtkIBLLampCluster& cluster : lamps)
  {
    light += sum(cluster.Power);
  }
  lamps.resize(std::min(lamps.size(), std::size_t(IBL_MAXIMUM_LAMPS)));
  const auto weak = std::find_if(lamps.begin(), lamps.end(),
    [&](const vtkIBLLampCluster& lamp) { return sum(lamp.Power) < LeastLampShare * light; });
  apart = static_cast<int>(weak - lamps.begin());
  std::vector<bool> taken(all.size(), false);
  for (auto lamp = lamps.begin(); lamp != weak; ++lamp)
  {
    for (int i : lamp->Texels)
    {
      taken[i] = true;
    }
  }
  std::vector<vtkIBLBrightTexel> left;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (!taken[i])
    {
      left.push_back(all[i]);
    }
  }
  spectrum = std::make_shared<vtkIBLSpectrum>(spectrum->GetOrder(), spectrum->GetCoefficients(), std::move(left));
  return lamps;
}

// The ladder of the sampled engine: its own errors are those of samples, percents, and this adds no more.
constexpr int SampledFaceSize = 128;
}

// What there is, and of what it was made: when that changes, none of it stands.
struct vtkIBLSpecularChain::Layers
{
  vtkMTimeType LightTime = 0;
  int Engine = Spectral;
  int Samples = 0;
  bool FitReading = true;
  double ErrorTolerance = 0.0;
  double Sharpest = 1.0; // the ladder was chosen for roughness from here up
  vtkIBLLadder Ladder;
  double PredictedError = -1.0;
  double StoredScale = 1.0;
  bool LampsApart = false;
  std::vector<vtkIBLBrightTexel> BrightTexels;
  std::vector<vtkIBLLampCluster> Lamps;
  int NumberOfLampsApart = 0; // of these: what layers are without
  Texture Odd, Even, IrradianceMap;
  std::vector<bool> Made; // by layer; 0 is the irradiance map
  const Texture& GetTexture(int layer) const
  {
    return layer == 0 ? this->IrradianceMap : layer % 2 ? this->Odd : this->Even;
  }
};

struct vtkIBLSpecularChain::Internals
{
  Layers Out;
  vtkIBLSampledFilter Sampler;
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
     << indent << "ErrorTolerance: " << this->ErrorTolerance << "\n"
     << indent << "FaceSize: " << this->FaceSize << "\n"
     << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n"
     << indent << "FitReading: " << this->FitReading << "\n"
     << indent << "LampsApart: " << this->LampsApart << "\n"
     << indent << "NeededRoughness: " << this->NeededRoughness[0] << " " << this->NeededRoughness[1] << "\n"
     << indent << "IrradianceNeeded: " << this->IrradianceNeeded << "\n"
     << indent << "NumberOfLayers: " << this->GetNumberOfLayers() << "\n"
     << indent << "NumberOfLayersMade: " << this->GetNumberOfLayersMade() << "\n"
     << indent << "PredictedError: " << this->GetPredictedError() << "\n"
     << indent << "StoredScale: " << this->GetStoredScale() << "\n";
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

void vtkIBLSpecularChain::SetNeededRoughness(double minimum, double maximum)
{
  if (minimum != this->NeededRoughness[0] || maximum != this->NeededRoughness[1])
  {
    this->NeededRoughness[0] = minimum;
    this->NeededRoughness[1] = maximum;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkIBLSpecularChain::GetNumberOfLayers() const
{
  return this->Internal->Out.Ladder.GetNumberOfLayers();
}

double vtkIBLSpecularChain::GetPerceptualRoughness(int layer) const
{
  return this->Internal->Out.Ladder.GetPerceptualRoughness(std::clamp(layer, 0, this->GetNumberOfLayers()));
}

int vtkIBLSpecularChain::GetLayerFaceSize(int layer) const
{
  return this->Internal->Out.Ladder.GetLayerFaceSize(std::clamp(layer, 1, this->GetNumberOfLayers()));
}

bool vtkIBLSpecularChain::HasLayer(int layer) const
{
  return layer > 0 && layer < static_cast<int>(this->Internal->Out.Made.size()) && this->Internal->Out.Made[layer];
}

double vtkIBLSpecularChain::GetFirstRoughness()
{
  return vtkIBLLadder::FirstRoughness;
}

vtkTypeInt64 vtkIBLSpecularChain::GetNumberOfLayersMade() const
{
  return this->GetStatistics()->GetCount(vtkIBLStatistics::Layers) +
    this->GetStatistics()->GetCount(vtkIBLStatistics::IrradianceMap);
}

double vtkIBLSpecularChain::GetPredictedError() const
{
  return this->Internal->Out.PredictedError;
}

double vtkIBLSpecularChain::GetStoredScale() const
{
  return this->Internal->Out.StoredScale;
}

int vtkIBLSpecularChain::GetNumberOfBrightTexels() const
{
  return static_cast<int>(this->Internal->Out.BrightTexels.size());
}

double vtkIBLSpecularChain::GetBrightTexel(int index, double direction[3], double radiance[3]) const
{
  const vtkIBLBrightTexel& texel = this->Internal->Out.BrightTexels.at(index);
  for (int k = 0; k < 3; ++k)
  {
    direction[k] = texel.Direction[k];
    radiance[k] = texel.Radiance[k];
  }
  return texel.SolidAngle;
}

int vtkIBLSpecularChain::GetNumberOfLamps() const
{
  return this->Internal->Out.NumberOfLampsApart;
}

int vtkIBLSpecularChain::GetNumberOfSampledLamps() const
{
  return static_cast<int>(this->Internal->Out.Lamps.size());
}

double vtkIBLSpecularChain::GetLamp(int index, double direction[3], double power[3]) const
{
  const vtkIBLLampCluster& lamp = this->Internal->Out.Lamps.at(index);
  for (int k = 0; k < 3; ++k)
  {
    direction[k] = lamp.Direction[k];
    power[k] = lamp.Power[k];
  }
  return lamp.Variance;
}

double vtkIBLSpecularChain::GetLampRadius(int index) const
{
  constexpr double texel = 0.0061; // of a cube map of 256^2
  return this->Internal->Out.Lamps.at(index).Radius + 1.5 * texel;
}

const vtkIBLGL::Texture& vtkIBLSpecularChain::GetOddLayers() const
{
  return this->Internal->Out.Odd;
}

const vtkIBLGL::Texture& vtkIBLSpecularChain::GetEvenLayers() const
{
  return this->Internal->Out.Even;
}

const vtkIBLGL::Texture& vtkIBLSpecularChain::GetIrradianceMap() const
{
  return this->Internal->Out.IrradianceMap;
}

//------------------------------------------------------------------------------
bool vtkIBLSpecularChain::IsSpectral() const
{
  return this->Engine == Spectral && this->CubeMap->GetEnvironment()->GetNumberOfFaces() == 1;
}

bool vtkIBLSpecularChain::UpdateInput(vtkOpenGLRenderWindow* window, vtkMTimeType& inputTime)
{
  vtkIBLEnvironment* environment = this->CubeMap ? this->CubeMap->GetEnvironment() : nullptr;
  if (!environment || !environment->Update())
  {
    return false;
  }
  inputTime = environment->GetRadianceTime();
  if (!this->IsSpectral())
  {
    if (!this->CubeMap->Update(window))
    {
      return false;
    }
    inputTime = this->CubeMap->GetBuildTime();
  }
  return true;
}

vtkIBLStatistics* vtkIBLSpecularChain::GetInputStatistics() const
{
  return this->CubeMap->GetEnvironment()->GetStatistics();
}

std::vector<vtkIBLStatistics::Work> vtkIBLSpecularChain::Build(vtkOpenGLRenderWindow* window)
{
  Internals& gl = *this->Internal;
  vtkIBLEnvironment* environment = this->CubeMap->GetEnvironment();
  const bool anyRoughness = // the mirror is not ours
    this->NeededRoughness[0] <= this->NeededRoughness[1] && this->NeededRoughness[1] > 0.0;

  Layers next;
  next.Engine = this->IsSpectral() ? Spectral : Sampled;
  next.LightTime = next.Engine == Spectral ? environment->GetRadianceTime() : this->CubeMap->GetBuildTime();
  next.Samples = next.Engine == Spectral ? 0 : this->NumberOfSamples;
  next.FitReading = this->FitReading;
  next.ErrorTolerance = this->ErrorTolerance;
  next.LampsApart = this->LampsApart && next.Engine == Spectral;
  next.Sharpest = anyRoughness ? std::max(this->NeededRoughness[0], vtkIBLLadder::FirstRoughness) : 1.0;
  next.StoredScale = environment->GetMeanLuminance() > 0.0 ? environment->GetMeanLuminance() : 1.0;
  const auto source = [](const Layers& x)
  { return std::tie(x.LightTime, x.Engine, x.Samples, x.FitReading, x.ErrorTolerance, x.LampsApart); };
  const bool sameSource = gl.Out.Odd && source(next) == source(gl.Out);

  std::shared_ptr<const vtkIBLSpectrum> spectrum;
  if (next.Engine == Spectral)
  {
    spectrum = environment->GetSpectrum(vtkIBLSpectrum::RequiredOrder(next.Sharpest));
    next.BrightTexels = spectrum->GetBrightTexels();
    if (next.LampsApart)
    {
      next.Lamps = TakeLamps(spectrum, next.NumberOfLampsApart);
    }
  }
  if (sameSource && next.Sharpest >= gl.Out.Sharpest)
  {
    next.Sharpest = gl.Out.Sharpest; // a ladder for more than is asked will do
    next.Ladder = gl.Out.Ladder;
  }
  else if (next.Engine == Spectral)
  {
    next.Ladder =
      vtkIBLChooseLadder(*spectrum, this->ErrorTolerance, next.Sharpest, 1.0, next.PredictedError, vtkIBLRunOnThreads);
  }
  else
  {
    next.Ladder = vtkIBLLadder(SampledFaceSize);
  }
  if (this->FaceSize > 0)
  {
    next.Ladder = vtkIBLLadder(vtkIBLLadder::LeastFaceSize);
    while (2 * next.Ladder.FaceSize <= this->FaceSize)
    {
      next.Ladder = next.Ladder.Refined().Refined();
    }
  }

  // Go on with the layers that are there, or begin with none; a build that fails leaves all that was made.
  const bool goOn = sameSource && next.Ladder.FaceSize == gl.Out.Ladder.FaceSize &&
    next.Ladder.EvenFaceSize == gl.Out.Ladder.EvenFaceSize;
  Layers& out = goOn ? gl.Out : next;
  out.Sharpest = next.Sharpest;
  if (!goOn)
  {
    const int levels = out.Ladder.GetNumberOfLevels();
    out.Odd = Texture::Cube(window, out.Ladder.FaceSize, levels, GL_RGBA16F);
    out.Even = Texture::Cube(window, out.Ladder.EvenFaceSize, levels, GL_RGBA16F);
    out.Odd.ReadWholeLevels();
    out.Even.ReadWholeLevels();
    // So small a map is in floats where it is uploaded: llvmpipe reads them faster than halves.
    out.IrradianceMap = Texture::Cube(window, IrradianceFaceSize, 1, out.Engine == Spectral ? GL_RGBA32F : GL_RGBA16F);
    // A matt surface reads a layer that nobody made, times 0; what a new texture holds may be NaN.
    for (int level = 0; level < levels; ++level)
    {
      glClearTexImage(out.Odd.Id(), level, GL_RGBA, GL_HALF_FLOAT, nullptr);
      glClearTexImage(out.Even.Id(), level, GL_RGBA, GL_HALF_FLOAT, nullptr);
    }
    out.Made.assign(out.Ladder.GetNumberOfLayers() + 1, false);
  }
  std::vector<int> missing;
  if (this->IrradianceNeeded && !out.Made[0])
  {
    missing.push_back(0);
  }
  int first = 0;
  int last = -1;
  if (anyRoughness)
  {
    out.Ladder.GetLayers(this->NeededRoughness[0], this->NeededRoughness[1], first, last);
  }
  for (int layer = std::max(first, 1); layer <= last; ++layer)
  {
    if (!out.Made[layer])
    {
      missing.push_back(layer);
    }
  }
  this->LastNumberOfLayersMade = static_cast<int>(missing.size());
  this->NumberOfReads = 0;
  vtkTypeInt64 texels = 0;
  if (!missing.empty())
  {
    texels = spectrum ? this->MakeSpectral(out, *spectrum, missing) : this->MakeSampled(window, out, missing);
  }
  if (!goOn)
  {
    gl.Out = std::move(next);
  }
  constexpr vtkTypeInt64 halves = 8; // bytes a texel
  std::vector<vtkIBLStatistics::Work> made;
  const bool withIrradiance = !missing.empty() && missing.front() == 0;
  const vtkTypeInt64 own = withIrradiance ? 6 * IrradianceFaceSize * IrradianceFaceSize : 0;
  if (texels > own)
  {
    made.push_back({ vtkIBLStatistics::Layers, this->LastNumberOfLayersMade - withIrradiance, texels - own,
      halves * (texels - own) });
  }
  if (withIrradiance)
  {
    made.push_back({ vtkIBLStatistics::IrradianceMap, 1, own, halves * own });
  }
  return made;
}

vtkTypeInt64 vtkIBLSpecularChain::MakeSpectral(
  Layers& out, const vtkIBLSpectrum& spectrum, const std::vector<int>& missing)
{
  // Side by side, the large ones first; and each on as many threads as are free.
  const vtkIBLLadder& ladder = out.Ladder;
  std::vector<std::vector<std::uint16_t>> texels(missing.size());
  const auto size = [&](int layer) { return layer == 0 ? IrradianceFaceSize : ladder.GetLayerFaceSize(layer); };
  const auto make = [&](int i)
  {
    const int n = size(missing[i]);
    const double roughness = missing[i] == 0 ? 1.0 : ladder.GetPerceptualRoughness(missing[i]);
    const bool mixed = out.FitReading && missing[i] != 0;
    std::vector<float> rgb(std::size_t(18) * (n + 2) * (n + 2));
    spectrum.Filter(mixed ? ladder.GetLobes(missing[i]) : std::vector<vtkIBLLobe>{ { roughness, 1.0 } }, n, 1,
      rgb.data(), vtkIBLRunOnThreads);
    texels[i].resize(std::size_t(24) * n * n);
    vtkIBLStoreLayer(rgb.data(), n, 1.0 / out.StoredScale, out.FitReading, texels[i].data(), vtkIBLRunOnThreads);
  };
  vtkIBLRunOnThreads(static_cast<int>(missing.size()), make);

  vtkTypeInt64 count = 0;
  for (std::size_t i = 0; i < missing.size(); ++i)
  {
    const int layer = missing[i];
    const int n = size(layer);
    glTextureSubImage3D(out.GetTexture(layer).Id(), layer == 0 ? 0 : vtkIBLLadder::GetLevel(layer), 0, 0, 0, n, n, 6,
      GL_RGBA, GL_HALF_FLOAT, texels[i].data());
    out.Made[layer] = true;
    count += vtkTypeInt64(6) * n * n;
  }
  vtkIBLGL::CheckErrors("uploading layers");
  return count;
}

vtkTypeInt64 vtkIBLSpecularChain::MakeSampled(
  vtkOpenGLRenderWindow* window, Layers& out, const std::vector<int>& missing)
{
  // A sharp layer takes the tail of its lobe from the next rougher one, so all that are rougher are made, too.
  const int last = out.Ladder.GetNumberOfLayers();
  const auto sharpest = std::find_if(missing.begin(), missing.end(), [](int layer) { return layer > 0; });
  std::vector<vtkIBLSampledFilter::Layer> layers;
  vtkTypeInt64 count = 0;
  this->LastNumberOfLayersMade = 0;
  const auto add = [&](int layer, double roughness, int level, int n)
  {
    layers.push_back({ roughness, &out.GetTexture(layer), level, out.Made[layer] });
    count += out.Made[layer] ? 0 : vtkTypeInt64(6) * n * n;
    this->LastNumberOfLayersMade += !out.Made[layer];
    out.Made[layer] = true;
  };
  for (int layer = sharpest == missing.end() ? last + 1 : *sharpest; layer <= last; ++layer)
  {
    add(layer, out.Ladder.GetPerceptualRoughness(layer), vtkIBLLadder::GetLevel(layer),
      out.Ladder.GetLayerFaceSize(layer));
  }
  if (missing.front() == 0)
  {
    add(0, 1.0, 0, IrradianceFaceSize);
  }
  this->NumberOfReads =
    this->Internal->Sampler.Run(window, this->CubeMap->GetTexture(), out.StoredScale, layers, out.Samples);
  return count;
}

void vtkIBLSpecularChain::Release()
{
  *this->Internal = Internals();
}

vtkSmartPointer<vtkImageData> vtkIBLSpecularChain::Read(int layer)
{
  const Layers& out = this->Internal->Out;
  auto image = out.GetTexture(layer).Read(layer == 0 ? 0 : vtkIBLLadder::GetLevel(layer));
  auto* value = static_cast<float*>(image->GetScalarPointer());
  std::transform(
    value, value + 3 * image->GetNumberOfPoints(), value, [&](float x) { return float(x * out.StoredScale); });
  return image;
}

vtkSmartPointer<vtkImageData> vtkIBLSpecularChain::ReadLayer(int layer)
{
  if (!this->HasLayer(layer))
  {
    vtkErrorMacro("There is no layer " << layer << "; after Update() the chain has those of 1 to "
                                       << this->GetNumberOfLayers() << " that NeededRoughness asks for.");
    return nullptr;
  }
  return this->Read(layer);
}

vtkSmartPointer<vtkImageData> vtkIBLSpecularChain::ReadIrradianceMap()
{
  if (this->Internal->Out.Made.empty() || !this->Internal->Out.Made[0])
  {
    vtkErrorMacro("There is no irradiance map; call Update() with IrradianceNeededOn().");
    return nullptr;
  }
  return this->Read(0);
}
