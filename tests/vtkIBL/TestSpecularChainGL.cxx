// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TestSupport.h"

#include "vtkIBLCubeMap.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLSpecularChain.h"

#include <algorithm>

namespace reference = vtkIBLReference;

class TestSpecularChainGL : public GLTest
{
protected:
  vtkNew<vtkIBLEnvironment> Environment;
  vtkNew<vtkIBLCubeMap> CubeMap;
  vtkNew<vtkIBLSpecularChain> Chain;

  void Bake()
  {
    this->CubeMap->SetEnvironment(this->Environment);
    this->Chain->SetCubeMap(this->CubeMap);
    ASSERT_TRUE(this->Chain->Update(this->Window));
  }

  // Relative L1 of some of a layer's texels against the converged integral over the panorama.
  double GetLayerError(const reference::Environment& environment, int layer)
  {
    const double roughness = vtkIBLSpecularChain::GetPerceptualRoughness(layer);
    vtkSmartPointer<vtkImageData> image = this->Chain->ReadLayer(layer);
    // A few hundred texels, spread by a stride that shares no factor with the face size.
    const std::vector<Vec3> all = GetCubeDirections(image->GetDimensions()[0]);
    const std::size_t stride = std::max<std::size_t>(all.size() / 384, 1) | 1;
    std::vector<Vec3> directions;
    for (std::size_t i = 0; i < all.size(); i += stride)
    {
      directions.push_back(all[i]);
    }
    const auto truth = reference::Cached<RGB>(
      "prefilter " + std::to_string(roughness) + reference::KeyOf(environment) + reference::KeyOf(directions),
      [&] { return reference::PrefilterAll(environment, directions, roughness); });
    double difference = 0;
    double sum = 0;
    for (std::size_t i = 0; i < directions.size(); ++i)
    {
      const auto* rgb = static_cast<const float*>(image->GetScalarPointer()) + 3 * stride * i;
      for (int k = 0; k < 3; ++k)
      {
        difference += std::abs(rgb[k] - truth[i][k]);
        sum += truth[i][k];
      }
    }
    return difference / sum;
  }
};

// Every layer of a constant environment is that constant. Half floats carry 2^-11 = 4.9e-4. Mutant: weights that don't
// sum to 1.
TEST_F(TestSpecularChainGL, KeepsAConstant)
{
  this->Environment->SetInputData(MakePanorama(64, [](Vec3) { return RGB{ 0.25, 1, 300 }; }));
  for (int engine : { vtkIBLSpecularChain::Sampled, vtkIBLSpecularChain::Spectral })
  {
    this->Chain->SetEngine(engine);
    this->Bake();
    for (int layer = 0; layer < vtkIBLSpecularChain::GetNumberOfLayers(); ++layer)
    {
      vtkSmartPointer<vtkImageData> image = this->Chain->ReadLayer(layer);
      EXPECT_EQ(image->GetDimensions()[0], this->Chain->GetLayerFaceSize(layer));
      for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
      {
        const auto* rgb = static_cast<const float*>(image->GetScalarPointer()) + 3 * i;
        ASSERT_NEAR(rgb[0] / 0.25, 1, 6e-4) << "layer " << layer;
        ASSERT_NEAR(rgb[2] / 300, 1, 6e-4) << "layer " << layer;
      }
    }
  }
}

// L = 1 + cos(theta) filtered by GGX is 1 + b_1 cos(theta), and b_1 = 2/3 at roughness 1, where the kernel is the
// clamped cosine. The mip levels that samples are read from blur b_1 by up to 1 %: 1e-2. Mutants: alpha for
// perceptualRoughness, no NoL weight, a lobe around the wrong axis.
TEST_F(TestSpecularChainGL, OfACosineAtRoughnessOneIsTheCosineLobe)
{
  const Vec3 axis = reference::Normalize({ 1, 2, -3 });
  this->Environment->SetInputData(MakePanorama(256,
    [&](Vec3 d)
    {
      const double l = 1 + reference::Dot(axis, d);
      return RGB{ l, l, l };
    }));
  this->Chain->SetEngine(vtkIBLSpecularChain::Sampled);
  this->Bake();
  vtkSmartPointer<vtkImageData> matt = this->Chain->ReadLayer(vtkIBLSpecularChain::GetNumberOfLayers() - 1);
  const std::vector<Vec3> directions = GetCubeDirections(matt->GetDimensions()[0]);
  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    const auto* rgb = static_cast<const float*>(matt->GetScalarPointer()) + 3 * i;
    ASSERT_NEAR(rgb[0], 1 + 2.0 / 3.0 * reference::Dot(axis, directions[i]), 1e-2);
  }
}

// Real HDRIs, each layer at some of its own texels, against the converged integral over the panorama. Measured when
// this was written: courtyard 0.6 to 2.2 %, interior, whose lamps carry 40 % of the light in a few texels, 2.2 to 5.2
// %; bounds leave a third more. (Peers: VTK 7 to 13 %, cmgen at 1024 samples 1.7 to 2.7 %.) Too few texels are tried to
// judge lobes as narrow as interior's lamps, so that map starts at layer 2. Mutants: alpha for perceptualRoughness, the
// ladder's inverse, mip levels off by one, layers in the wrong chain.
TEST_F(TestSpecularChainGL, OfRealPanoramasAgreesWithTheIntegral)
{
  this->Chain->SetEngine(vtkIBLSpecularChain::Sampled);
  struct Case
  {
    const char* Name;
    int FirstLayer;
    double Tolerance;
  };
  for (auto [name, firstLayer, tolerance] : { Case{ "courtyard", 1, 0.03 }, Case{ "interior", 2, 0.07 } })
  {
    const std::string path = GetHDRI(name);
    if (path.empty())
    {
      GTEST_SKIP() << "no HDRIs: install blender-data";
    }
    this->Environment->SetFileName(path.c_str());
    this->Bake();
    const reference::Environment environment = ToReference(this->Environment->GetRadianceImage());
    for (int layer = firstLayer; layer < vtkIBLSpecularChain::GetNumberOfLayers(); ++layer)
    {
      const double error = this->GetLayerError(environment, layer);
      std::printf("%s layer %d, roughness %.3f: relative L1 %.4f\n", name, layer,
        vtkIBLSpecularChain::GetPerceptualRoughness(layer), error);
      EXPECT_LT(error, tolerance) << name << " layer " << layer;
    }
  }
}

// The spectral engine on the same maps, sun or no sun: what is left is half floats' rounding, 1.2e-4 on average. Where
// it does not apply, below roughness 0.17 and for cube environments, layers are the sampled ones. Mutants: layers
// uploaded to the wrong level, the stored scale forgotten.
TEST_F(TestSpecularChainGL, SpectralLayersAreTheIntegral)
{
  EXPECT_EQ(this->Chain->GetEngine(), vtkIBLSpecularChain::Spectral);
  for (const char* name : { "courtyard", "interior", "city" })
  {
    const std::string path = GetHDRI(name);
    if (path.empty())
    {
      GTEST_SKIP() << "no HDRIs: install blender-data";
    }
    this->Environment->SetFileName(path.c_str());
    this->Bake();
    const reference::Environment environment = ToReference(this->Environment->GetRadianceImage());
    for (int layer = 4; layer < vtkIBLSpecularChain::GetNumberOfLayers(); ++layer)
    {
      EXPECT_LT(this->GetLayerError(environment, layer), 5e-4) << name << " layer " << layer;
    }
  }
  // A cube environment takes the sampled engine for all layers.
  const auto f = [](Vec3 d) { return RGB{ 1 + d.x, 1 + d.y, 1 + d.z }; };
  this->Environment->SetInputData(MakeFaces(64, f));
  this->Bake();
  vtkSmartPointer<vtkImageData> fromFaces = this->Chain->ReadLayer(7);
  this->Environment->SetInputData(MakePanorama(128, f));
  this->Bake();
  vtkSmartPointer<vtkImageData> fromPanorama = this->Chain->ReadLayer(7);
  EXPECT_NEAR(GetTexel(fromFaces, 3, 20, 2)[1], GetTexel(fromPanorama, 3, 20, 2)[1], 1e-2);
}

// A sun of one texel, 2e5 times the mean, is more than half floats hold: it is cut there, and neither overflows nor
// turns neighbours black. Mutant: no clamp (infinity, then NaN when interpolated).
TEST_F(TestSpecularChainGL, HoldsASunAboveHalfRange)
{
  vtkSmartPointer<vtkImageData> panorama = MakePanorama(512, [](Vec3) { return RGB{ 0.01, 0.01, 0.01 }; });
  std::fill_n(static_cast<float*>(panorama->GetScalarPointer(300, 200, 0)), 3, 1e9f);
  this->Environment->SetInputData(panorama);
  this->Bake();
  for (int layer = 0; layer < vtkIBLSpecularChain::GetNumberOfLayers(); ++layer)
  {
    vtkSmartPointer<vtkImageData> image = this->Chain->ReadLayer(layer);
    const auto* value = static_cast<const float*>(image->GetScalarPointer());
    for (vtkIdType i = 0; i < 3 * image->GetNumberOfPoints(); ++i)
    {
      ASSERT_TRUE(std::isfinite(value[i]) && value[i] >= 0) << "layer " << layer;
    }
    if (layer == 0)
    {
      const float brightest = *std::max_element(value, value + 3 * image->GetNumberOfPoints());
      EXPECT_NEAR(brightest / this->Chain->GetStoredScale(), 65504, 32); // so the clamp was at work
    }
  }
}

TEST_F(TestSpecularChainGL, BuildsOnlyWhatChanged)
{
  this->Environment->SetInputData(MakePanorama(32, [](Vec3 d) { return RGB{ 1 + d.x, 1, 1 }; }));
  this->Bake();
  this->Environment->SetRotation(10);
  this->Bake();
  EXPECT_EQ(this->Chain->GetNumberOfBuilds(), 1);
  this->Chain->SetNumberOfSamples(64);
  this->Bake();
  EXPECT_EQ(this->Chain->GetNumberOfBuilds(), 2);
  EXPECT_EQ(this->CubeMap->GetNumberOfBuilds(), 1);
  EXPECT_EQ(this->Chain->ReadLayer(-1), nullptr);
  EXPECT_NE(this->Messages.Take().find("no layer -1"), std::string::npos);
}
