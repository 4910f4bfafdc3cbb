// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TestSupport.h"

#include "vtkIBLCubeMap.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLSpecularChain.h"
#include "vtkIBLSpectrum.h"
#include "vtkIBLThreads.h"

#include <algorithm>
#include <map>
#include <numeric>

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
    return GetError(environment, this->Chain->ReadLayer(layer), this->Chain->GetPerceptualRoughness(layer));
  }
  // At the worst of four roughnesses a layer, over all directions.
  double GetWorstReadingError();
  static double GetError(const reference::Environment& environment, vtkImageData* image, double roughness)
  {
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

namespace
{
// A layer as a seamless cube map is read: bilinearly, over the edges onto the neighbouring face.
RGB ReadBilinearly(vtkImageData* layer, Vec3 direction)
{
  const int n = layer->GetDimensions()[0];
  const auto locate = [](Vec3 d, double& s, double& t)
  {
    const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    const double most = std::max({ x, y, z });
    const int face = most == x ? (d.x > 0 ? 0 : 1) : most == y ? (d.y > 0 ? 2 : 3) : (d.z > 0 ? 4 : 5);
    const Vec3 sOf[] = { { 0, 0, -1 }, { 0, 0, 1 }, { 1, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 }, { -1, 0, 0 } };
    const Vec3 tOf[] = { { 0, -1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 }, { 0, -1, 0 }, { 0, -1, 0 } };
    s = reference::Dot(d, sOf[face]) / most;
    t = reference::Dot(d, tOf[face]) / most;
    return face;
  };
  double s, t;
  const int face = locate(direction, s, t);
  const double x = (s + 1) / 2 * n - 0.5, y = (t + 1) / 2 * n - 0.5;
  const int i = int(std::floor(x)), j = int(std::floor(y));
  RGB sum = { 0, 0, 0 };
  for (int corner = 0; corner < 4; ++corner)
  {
    int column = i + corner % 2, row = j + corner / 2, on = face;
    const double weight = std::abs((corner % 2 ? i : i + 1) - x) * std::abs((corner / 2 ? j : j + 1) - y);
    if (column < 0 || column >= n || row < 0 || row >= n)
    {
      double s1, t1;
      on = locate(reference::CubeDirection(face, 2 * (column + 0.5) / n - 1, 2 * (row + 0.5) / n - 1), s1, t1);
      column = std::clamp(int((s1 + 1) / 2 * n), 0, n - 1);
      row = std::clamp(int((t1 + 1) / 2 * n), 0, n - 1);
    }
    const auto* rgb = static_cast<const float*>(layer->GetScalarPointer(column, row, on));
    for (int k = 0; k < 3; ++k)
    {
      sum[k] += weight * rgb[k];
    }
  }
  return sum;
}
}

double TestSpecularChainGL::GetWorstReadingError()
{
  const int last = this->Chain->GetNumberOfLayers();
  std::vector<vtkSmartPointer<vtkImageData>> layers(last + 1);
  for (int layer = 1; layer <= last; ++layer)
  {
    layers[layer] = this->Chain->ReadLayer(layer);
  }
  constexpr int n = 90;
  const std::vector<Vec3> directions = GetCubeDirections(n);
  const vtkIBLSpectrum spectrum(this->Environment->GetRadiance(), vtkIBLSpectrum::MaximumOrder, vtkIBLRunOnThreads);
  double worst = 0;
  for (double layer = 1; layer <= last; layer += 0.25)
  {
    const double roughness = std::pow(10, -(last - layer) / (last - 1)); // from 0.1 to 1 by one ratio
    std::vector<float> truth(std::size_t(18) * n * n);
    spectrum.Filter({ { roughness, 1.0 } }, n, 0, truth.data(), vtkIBLRunOnThreads);
    const int below = std::min(int(layer), last - 1);
    const double share = layer - below;
    std::vector<double> differences(6 * n, 0.0), sums(6 * n, 0.0);
    vtkIBLRunOnThreads(6 * n,
      [&](int row)
      {
        for (int i = row * n; i < row * n + n; ++i)
        {
          const RGB a = ReadBilinearly(layers[below], directions[i]);
          const RGB b = ReadBilinearly(layers[below + 1], directions[i]);
          const double s = 2 * (i % n + 0.5) / n - 1, t = 2 * (i / n % n + 0.5) / n - 1;
          const double solidAngle = std::pow(1 + s * s + t * t, -1.5);
          for (int k = 0; k < 3; ++k)
          {
            differences[row] += solidAngle * std::abs((1 - share) * a[k] + share * b[k] - truth[3 * i + k]);
            sums[row] += solidAngle * truth[3 * i + k];
          }
        }
      });
    worst = std::max(worst,
      std::accumulate(differences.begin(), differences.end(), 0.0) / std::accumulate(sums.begin(), sums.end(), 0.0));
  }
  return worst;
}

// Every layer of a constant environment is that constant. Half floats carry 2^-11 = 4.9e-4, and a layer has a third of
// the next one's rounding: 7.3e-4. Mutants: weights that don't sum to 1; a norm off by 1e-3.
TEST_F(TestSpecularChainGL, KeepsAConstant)
{
  this->Environment->SetInputData(MakePanorama(64, [](Vec3) { return RGB{ 0.25, 1, 300 }; }));
  for (int engine : { vtkIBLSpecularChain::Sampled, vtkIBLSpecularChain::Spectral })
  {
    this->Chain->SetEngine(engine);
    this->Bake();
    for (int layer = 1; layer <= this->Chain->GetNumberOfLayers(); ++layer)
    {
      vtkSmartPointer<vtkImageData> image = this->Chain->ReadLayer(layer);
      EXPECT_EQ(image->GetDimensions()[0], this->Chain->GetLayerFaceSize(layer));
      for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
      {
        const auto* rgb = static_cast<const float*>(image->GetScalarPointer()) + 3 * i;
        ASSERT_NEAR(rgb[0] / 0.25, 1, 7.3e-4) << "layer " << layer;
        ASSERT_NEAR(rgb[2] / 300, 1, 7.3e-4) << "layer " << layer;
      }
    }
  }
}

// L = 1 + cos(theta) filtered by GGX is 1 + b_1 cos(theta), and b_1 = 2/3 at roughness 1, where the kernel is the
// clamped cosine. That layer is a sum over 1536 lights that keep their mean direction and, to second order, their
// spread; half floats are 1e-3 apart here, and Mesa rounds them down: 1.2e-3. Mutants: alpha for perceptualRoughness,
// no NoL weight, a lobe around the wrong axis; cells that the horizon cuts taken by their middle.
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
  vtkSmartPointer<vtkImageData> matt = this->Chain->ReadLayer(this->Chain->GetNumberOfLayers());
  const std::vector<Vec3> directions = GetCubeDirections(matt->GetDimensions()[0]);
  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    const auto* rgb = static_cast<const float*>(matt->GetScalarPointer()) + 3 * i;
    ASSERT_NEAR(rgb[0], 1 + 2.0 / 3.0 * reference::Dot(axis, directions[i]), 1.2e-3);
  }
}

// Real HDRIs, each layer at some of its own texels, against the converged integral over the panorama, at 64 samples:
// the mean over eight maps, and each map. Sums over lights make the rough layers; measured 0.14 % at roughness 0.42,
// 0.09 % above, at most 0.28 %. Samples and tails make the others: 1.8 to 2.7 %, at most 6.7 % (sunrise). (VTK leaves 6
// to 7 % with 512 samples, cmgen 6 to 11 % with 1024.) Bounds leave a third more. Mutants, with the worst mean they
// give: alpha for perceptualRoughness; layers in the wrong chain; levels off by one (7.1 %); no tail (4.2 %); box for
// B-spline levels (4.6 %); texels taken as equal (above 9 % on one map); lights without their spread (1 % at 0.42) or
// in the middle of their cell (2.6 %).
TEST_F(TestSpecularChainGL, SampledLayersAreNearTheIntegral)
{
  constexpr double roughFrom = 0.4;
  this->Chain->SetEngine(vtkIBLSpecularChain::Sampled);
  const std::vector<const char*> names = { "city", "courtyard", "forest", "interior", "night", "studio", "sunrise",
    "sunset" };
  std::map<int, double> mean;
  for (const char* name : names)
  {
    const std::string path = GetHDRI(name);
    if (path.empty())
    {
      GTEST_SKIP() << "no HDRIs: install blender-data";
    }
    this->Environment->SetFileName(path.c_str());
    this->Bake();
    const reference::Environment environment = ToReference(this->Environment->GetRadianceImage());
    for (int layer = 1; layer <= this->Chain->GetNumberOfLayers(); ++layer)
    {
      const double error = this->GetLayerError(environment, layer);
      mean[layer] += error / names.size();
      const bool isRough = this->Chain->GetPerceptualRoughness(layer) >= roughFrom;
      EXPECT_LT(error, isRough ? 4e-3 : 9e-2) << name << " layer " << layer;
    }
  }
  for (int layer = 1; layer <= this->Chain->GetNumberOfLayers(); ++layer)
  {
    const double roughness = this->Chain->GetPerceptualRoughness(layer);
    std::printf("roughness %.3f: mean relative L1 %.5f\n", roughness, mean[layer]);
    EXPECT_LT(mean[layer], roughness < roughFrom ? 3.5e-2 : roughness < 0.5 ? 2e-3 : 1.3e-3) << "layer " << layer;
  }
}

// Two engines that share no line: they differ by no more than the sampled one's error. A map on which both are wrong in
// the same way would have to fool harmonics and sums alike. Mutants: as above, in either; samples that do not move
// inwards.
TEST_F(TestSpecularChainGL, EnginesAgree)
{
  const std::string path = GetHDRI("courtyard");
  if (path.empty())
  {
    GTEST_SKIP() << "no HDRIs: install blender-data";
  }
  this->Environment->SetFileName(path.c_str());
  std::vector<vtkSmartPointer<vtkImageData>> sampled;
  this->Chain->SetEngine(vtkIBLSpecularChain::Sampled);
  this->Bake();
  for (int layer = 1; layer <= this->Chain->GetNumberOfLayers(); ++layer)
  {
    sampled.push_back(this->Chain->ReadLayer(layer));
  }
  this->Chain->SetEngine(vtkIBLSpecularChain::Spectral);
  this->Chain->SetFaceSize(this->Chain->GetLayerFaceSize(1));
  this->Chain->FitReadingOff();
  this->Bake();
  for (int layer = 1; layer <= this->Chain->GetNumberOfLayers(); ++layer)
  {
    vtkSmartPointer<vtkImageData> spectral = this->Chain->ReadLayer(layer);
    std::vector<RGB> truth(spectral->GetNumberOfPoints());
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
      const auto* rgb = static_cast<const float*>(spectral->GetScalarPointer()) + 3 * i;
      truth[i] = { rgb[0], rgb[1], rgb[2] };
    }
    EXPECT_LT(GetRelativeL1(sampled[layer - 1], truth), this->Chain->GetPerceptualRoughness(layer) < 0.4 ? 2e-2 : 2e-3)
      << "layer " << layer;
  }
}

// The spectral engine on real maps, sun or no sun, texels at their centres: half floats' rounding, 1.2e-4 on average,
// and at roughness 0.1, where 320 bands end early, up to 4.8e-3 (sunrise's neighbours). And a cube environment takes
// the sampled engine. Mutants: layers uploaded to the wrong level or chain, the stored scale forgotten, the border not
// skipped.
TEST_F(TestSpecularChainGL, SpectralLayersAreTheIntegral)
{
  EXPECT_EQ(this->Chain->GetEngine(), vtkIBLSpecularChain::Spectral);
  this->Chain->FitReadingOff();
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
    for (int layer = 1; layer <= this->Chain->GetNumberOfLayers(); ++layer)
    {
      EXPECT_LT(this->GetLayerError(environment, layer), layer == 1 ? 5e-3 : 6e-4) << name << " layer " << layer;
    }
    EXPECT_LT(GetError(environment, this->Chain->ReadIrradianceMap(), 1.0), 3e-4) << name;
  }
  const auto f = [](Vec3 d) { return RGB{ 1 + d.x, 1 + d.y, 1 + d.z }; };
  this->Chain->SetFaceSize(128);
  this->Environment->SetInputData(MakeFaces(64, f));
  this->Bake();
  EXPECT_GT(this->Chain->GetNumberOfReads(), 0);
  vtkSmartPointer<vtkImageData> fromFaces = this->Chain->ReadLayer(5);
  this->Environment->SetInputData(MakePanorama(128, f));
  this->Bake();
  vtkSmartPointer<vtkImageData> fromPanorama = this->Chain->ReadLayer(5);
  EXPECT_NEAR(GetTexel(fromFaces, 3, 20, 2)[1], GetTexel(fromPanorama, 3, 20, 2)[1], 5e-3);
}

// What the user asked for: read as a shader does, bilinearly and between two layers, at any roughness, all eight maps
// stay within the default tolerance, 2 %; and there as at 5 % the error that was predicted is neither half nor double
// of what is measured. Measured densely, at the centres of a 90^2 cube that no layer shares, against the filter itself
// (which the test above and core/TestSpectrum hold against the integral). Mutants: no fit of the reading, texels' or
// layers' (misses the tolerance); the ladder's inverse; levels off by one; any of the prediction's terms left out.
TEST_F(TestSpecularChainGL, ReadsAsWellAsItPromises)
{
  for (double tolerance : { 0.02, 0.05 })
  {
    this->Chain->SetErrorTolerance(tolerance);
    for (const char* name : { "city", "courtyard", "forest", "interior", "night", "studio", "sunrise", "sunset" })
    {
      const std::string path = GetHDRI(name);
      if (path.empty())
      {
        GTEST_SKIP() << "no HDRIs: install blender-data";
      }
      this->Environment->SetFileName(path.c_str());
      this->Bake();
      const double measured = this->GetWorstReadingError();
      const double predicted = this->Chain->GetPredictedError();
      std::printf("%s, tolerance %.3f: face size %d, predicted %.4f, measured %.4f\n", name, tolerance,
        this->Chain->GetLayerFaceSize(1), predicted, measured);
      EXPECT_LE(predicted, tolerance) << name;
      EXPECT_LT(measured, tolerance > 0.02 ? 1.5 * tolerance : tolerance) << name;
      EXPECT_LT(measured, 2.0 * predicted) << name;
      EXPECT_GT(measured, 0.5 * predicted) << name;
    }
  }
}

// A constant sky needs next to nothing, a smooth one little; a city more the smaller the error. Mutant: a fixed size.
TEST_F(TestSpecularChainGL, LadderIsAsSmallAsTheLightAllows)
{
  this->Environment->SetInputData(MakePanorama(512, [](Vec3) { return RGB{ 1, 2, 3 }; }));
  this->Bake();
  EXPECT_EQ(this->Chain->GetLayerFaceSize(1), 16);
  EXPECT_EQ(this->Chain->GetNumberOfLayers(), 2);
  this->Environment->SetInputData(MakePanorama(512, [](Vec3 d) { return RGB{ 1 + 0.3 * d.y, 1, 1 - 0.3 * d.y }; }));
  this->Bake();
  EXPECT_LE(this->Chain->GetLayerFaceSize(1), 32);
  const std::string path = GetHDRI("city");
  if (path.empty())
  {
    GTEST_SKIP() << "no HDRIs: install blender-data";
  }
  this->Environment->SetFileName(path.c_str());
  int last = 0;
  for (double tolerance : { 0.2, 0.05, 0.01 })
  {
    this->Chain->SetErrorTolerance(tolerance);
    this->Bake();
    EXPECT_GT(this->Chain->GetNumberOfLayers(), last) << tolerance;
    last = this->Chain->GetNumberOfLayers();
  }
}

// A sun of one texel, all the light there is: sharpest layers show the lobe, whose peak is 4 pi K(1) = 1e4 times the
// mean at roughness 0.1, far below what half floats end at; nothing overflows, is negative or NaN. The fit lifts the
// peak by a few percent. Mutants: bright texels that are not taken out; a lobe without its norm.
TEST_F(TestSpecularChainGL, HoldsASunAboveHalfRange)
{
  vtkSmartPointer<vtkImageData> panorama = MakePanorama(512, [](Vec3) { return RGB{ 0.01, 0.01, 0.01 }; });
  std::fill_n(static_cast<float*>(panorama->GetScalarPointer(300, 200, 0)), 3, 1e9f);
  this->Environment->SetInputData(panorama);
  this->Bake();
  for (int layer = 1; layer <= this->Chain->GetNumberOfLayers(); ++layer)
  {
    vtkSmartPointer<vtkImageData> image = this->Chain->ReadLayer(layer);
    const auto* value = static_cast<const float*>(image->GetScalarPointer());
    for (vtkIdType i = 0; i < 3 * image->GetNumberOfPoints(); ++i)
    {
      ASSERT_TRUE(std::isfinite(value[i]) && value[i] >= 0) << "layer " << layer;
    }
    if (layer == 1)
    {
      const float brightest = *std::max_element(value, value + 3 * image->GetNumberOfPoints());
      EXPECT_NEAR(brightest / this->Chain->GetStoredScale(), 1e4, 1e3);
    }
  }
}

// What a bake reads: 64 samples and a tail a texel of the sharp layers, 1536 lights a texel of the rough ones and of
// the irradiance map; nothing when harmonics make all of them. Mutant: tables of a former number of samples.
TEST_F(TestSpecularChainGL, ReadsWhatItIsTold)
{
  this->Environment->SetInputData(MakePanorama(512, [](Vec3 d) { return RGB{ 1 + d.x, 1, 1 }; }));
  this->Chain->SetEngine(vtkIBLSpecularChain::Sampled);
  for (int samples : { 64, 16 })
  {
    this->Chain->SetNumberOfSamples(samples);
    this->Bake();
    vtkTypeInt64 reads = 6 * 128 * 128 + vtkTypeInt64(6) * 32 * 32 * 1536; // the lights' own, and the irradiance map
    for (int layer = 1; layer <= this->Chain->GetNumberOfLayers(); ++layer)
    {
      const double roughness = this->Chain->GetPerceptualRoughness(layer);
      const vtkTypeInt64 size = this->Chain->GetLayerFaceSize(layer);
      reads += 6 * size * size * (roughness < 0.4 ? samples + 1 : 1536);
    }
    EXPECT_EQ(this->Chain->GetNumberOfReads(), reads);
  }
  this->Chain->SetEngine(vtkIBLSpecularChain::Spectral);
  this->Bake();
  EXPECT_EQ(this->Chain->GetNumberOfReads(), 0);
}

// Turning builds nothing; a setting of the other engine makes nothing; the spectral engine leaves the cube map alone.
TEST_F(TestSpecularChainGL, BuildsOnlyWhatChanged)
{
  this->Environment->SetInputData(MakePanorama(32, [](Vec3 d) { return RGB{ 1 + d.x, 1, 1 }; }));
  this->Bake();
  this->Environment->SetRotation(10);
  this->Bake();
  EXPECT_EQ(this->Chain->GetNumberOfBuilds(), 1);
  const vtkTypeInt64 made = this->Chain->GetNumberOfLayersMade();
  EXPECT_EQ(made, this->Chain->GetNumberOfLayers() + 1);
  this->Chain->SetNumberOfSamples(32);
  this->Bake();
  EXPECT_EQ(this->Chain->GetNumberOfLayersMade(), made);
  EXPECT_EQ(this->CubeMap->GetNumberOfBuilds(), 0);
  this->Chain->SetEngine(vtkIBLSpecularChain::Sampled);
  this->Bake();
  EXPECT_GT(this->Chain->GetNumberOfLayersMade(), made);
  EXPECT_EQ(this->CubeMap->GetNumberOfBuilds(), 1);
  EXPECT_EQ(this->Chain->ReadLayer(0), nullptr);
  EXPECT_NE(this->Messages.Take().find("no layer 0"), std::string::npos);
}

// Only the layers that a range of roughness is read from, and those that are missing when it grows; what was made stays
// as it was. Mutants: all layers; a new texture for each growth; no layer at the range's rougher end.
TEST_F(TestSpecularChainGL, MakesTheLayersThatAreNeeded)
{
  this->Environment->SetInputData(MakePanorama(256,
    [](Vec3 d) {
      return RGB{ 1 + d.x, 1 + d.y * d.z, 1.2 + std::sin(9 * d.x) * std::sin(7 * d.z) };
    }));
  this->Chain->SetFaceSize(128); // 8 layers: 0.1 0.14 0.19 0.27 0.37 0.52 0.72 1
  this->Chain->SetNeededRoughness(0.4, 0.6);
  this->Chain->IrradianceNeededOff();
  this->Bake();
  const auto made = [&]
  {
    std::string layers;
    for (int layer = 1; layer <= this->Chain->GetNumberOfLayers(); ++layer)
    {
      layers += this->Chain->HasLayer(layer) ? std::to_string(layer) : "";
    }
    return layers;
  };
  EXPECT_EQ(made(), "567");
  EXPECT_EQ(this->Chain->GetLastNumberOfLayersMade(), 3);
  EXPECT_EQ(this->Chain->ReadIrradianceMap(), nullptr);
  EXPECT_NE(this->Messages.Take().find("no irradiance map"), std::string::npos);
  const RGB before = GetTexel(this->Chain->ReadLayer(6), 3, 4, 2);
  this->Chain->SetNeededRoughness(0.4, 1.0);
  this->Chain->IrradianceNeededOn();
  this->Bake();
  EXPECT_EQ(made(), "5678");
  EXPECT_EQ(this->Chain->GetLastNumberOfLayersMade(), 2);
  EXPECT_EQ(GetTexel(this->Chain->ReadLayer(6), 3, 4, 2), before);
  this->Chain->SetNeededRoughness(0.0, 0.05); // between the mirror, which is not here, and layer 1
  this->Bake();
  EXPECT_EQ(made(), "15678");
  EXPECT_EQ(GetTexel(this->Chain->ReadLayer(6), 3, 4, 2), before);
  this->Chain->SetNeededRoughness(2, -1);
  this->Bake();
  EXPECT_EQ(this->Chain->GetLastNumberOfLayersMade(), 0);
}
