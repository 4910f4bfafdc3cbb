// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ToolTest.h"

#include "vtkIBLEnvironment.h"

#include <algorithm>
#include <cmath>

namespace reference = vtkIBLReference;
using nlohmann::json;

namespace
{
bool IsNumbers(const json& value, std::size_t count)
{
  return value.is_array() && value.size() == count &&
    std::all_of(value.begin(), value.end(), [](const json& x) { return x.is_number(); });
}

// Every key that a reader may rely on, and its type.
void ExpectSchema(const json& bake)
{
  EXPECT_EQ(bake.at("format"), "vtkibl-bake");
  EXPECT_EQ(bake.at("version"), 1);
  EXPECT_TRUE(bake.at("generator").is_string());
  EXPECT_TRUE(bake.at("source").is_string());
  for (const char* key : { "width", "height", "faces" })
  {
    EXPECT_TRUE(bake.at("size").at(key).is_number_integer()) << key;
  }
  EXPECT_TRUE(IsNumbers(bake.at("mean"), 3));
  for (const char* key : { "meanLuminance", "exposureScale", "predictedError" })
  {
    EXPECT_TRUE(bake.at(key).is_number_float()) << key;
  }
  for (const char* key : { "notFinite", "tooLarge", "negative" })
  {
    EXPECT_TRUE(bake.at("cleanedTexels").at(key).is_number_integer()) << key;
  }
  EXPECT_TRUE(bake.at("layerLayout").is_string());
  for (const json& layer : bake.at("layers"))
  {
    EXPECT_TRUE(layer.at("index").is_number_integer());
    EXPECT_TRUE(layer.at("perceptualRoughness").is_number());
    EXPECT_TRUE(layer.at("faceSize").is_number_integer());
    EXPECT_TRUE(layer.at("file").is_string());
  }
  for (const char* key : { "quantity", "basis", "index" })
  {
    EXPECT_TRUE(bake.at("harmonics").at(key).is_string()) << key;
  }
  EXPECT_EQ(bake.at("harmonics").at("order"), 2);
  EXPECT_EQ(bake.at("harmonics").at("coefficients").size(), 9u);
  EXPECT_TRUE(IsNumbers(bake.at("harmonics").at("factors"), 9));
  for (const json& texel : bake.at("brightTexels"))
  {
    EXPECT_TRUE(IsNumbers(texel.at("direction"), 3));
    EXPECT_TRUE(IsNumbers(texel.at("radiance"), 3));
    EXPECT_GT(texel.at("solidAngle"), 0.0);
  }
  EXPECT_TRUE(bake.at("engine") == "spectral" || bake.at("engine") == "sampled");
  EXPECT_TRUE(bake.at("settings").at("numberOfSamples").is_number_integer());
  EXPECT_TRUE(bake.at("tolerance").is_null() || bake.at("tolerance").is_number());
  std::vector<std::string> stages;
  for (const json& stage : bake.at("stages"))
  {
    stages.push_back(stage.at("name"));
    EXPECT_GT(stage.at("milliseconds"), 0.0) << stage;
    EXPECT_GT(stage.at("bytes"), 0) << stage;
  }
  EXPECT_EQ(stages, (std::vector<std::string>{ "read", "cubeMap", "irradiance", "specularChain", "brdfTable" }));
}

// An axis of the BRDF table, as its JSON says.
double GetAxisValue(const json& axis, int index, int count)
{
  const double first = axis.at("first");
  const double last = axis.at("last");
  return std::pow(first + (last - first) * index / (count - 1), axis.at("power").get<double>());
}

// Relative L1 distance of a layer's texels, some hundred of them, from the converged integral.
double MeasureError(
  const Picture& layer, double scale, const reference::Environment& environment, double perceptualRoughness)
{
  const std::vector<Vec3> all = GetCubeDirections(layer.Width);
  const std::size_t stride = std::max<std::size_t>(all.size() / 384, 1) | 1; // shares no factor with the face size
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < all.size(); i += stride)
  {
    directions.push_back(all[i]);
  }
  const auto truth = reference::Cached<RGB>(
    "prefilter " + std::to_string(perceptualRoughness) + reference::KeyOf(environment) + reference::KeyOf(directions),
    [&] { return reference::PrefilterAll(environment, directions, perceptualRoughness); });
  double difference = 0;
  double sum = 0;
  for (std::size_t i = 0; i < 3 * truth.size(); ++i)
  {
    const double value = truth[i / 3][i % 3];
    difference += std::abs(scale * layer.Values[3 * stride * (i / 3) + i % 3] - value);
    sum += value;
  }
  return difference / sum;
}
}

class TestToolBakeGL : public ToolGLTest
{
};

// All that the JSON names is there, in the size it says, and nothing else. Mutants: a key renamed, a layer off by one,
// a temporary file left.
TEST_F(TestToolBakeGL, WritesWhatItsJSONSays)
{
  this->WriteConstant("in.exr", { 1, 2, 3 });
  this->RunWell("bake in.exr --output deep/out");
  const json bake = this->ReadJSON("deep/out/bake.json");
  ExpectSchema(bake);
  EXPECT_EQ(bake.at("source"), "in.exr");
  EXPECT_EQ(bake.at("size").at("width"), 64);
  std::vector<std::string> expected = { "deep", "deep/out", "deep/out/bake.json", "deep/out/brdf.exr", "in.exr" };
  for (const json& layer : bake.at("layers"))
  {
    const std::string file = "deep/out/" + layer.at("file").get<std::string>();
    const Picture picture = this->ReadPicture(file);
    EXPECT_EQ(picture.Width, layer.at("faceSize"));
    EXPECT_EQ(picture.Height, 6 * picture.Width);
    EXPECT_EQ(picture.Channels, (std::vector<std::string>{ "R", "G", "B" }));
    expected.push_back(file);
  }
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(this->List(), expected);
  EXPECT_EQ(bake.at("layers").size(), 10u);
}

// Every layer of a constant is the constant, once multiplied by the exposure scale. 6e-4: half floats in the chain.
// Mutants: files not divided, or divided twice; mean without 1/(4 pi Y00).
TEST_F(TestToolBakeGL, KeepsAConstant)
{
  const RGB constant = { 0.25, 1, 300 };
  this->WriteConstant("in.exr", constant);
  this->RunWell("bake in.exr --output out");
  const json bake = this->ReadJSON("out/bake.json");
  const double scale = bake.at("exposureScale");
  EXPECT_NEAR(scale, 0.2126 * 0.25 + 0.7152 + 0.0722 * 300, 1e-3);
  for (const json& layer : bake.at("layers"))
  {
    const Picture picture = this->ReadPicture("out/" + layer.at("file").get<std::string>());
    for (std::size_t i = 0; i < picture.Values.size(); ++i)
    {
      ASSERT_NEAR(picture.Values[i] * scale / constant[i % 3], 1, 6e-4) << layer;
    }
  }
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_NEAR(bake.at("mean")[k].get<double>() / constant[k], 1, 1e-4);
  }
}

// The mirror's layer shows each direction's own light, where the convention puts it. The panorama is linear and differs
// along each axis; 1e-2: one texel of blur. Mutants: rows flipped, faces swapped, s and t swapped, a mirrored face.
TEST_F(TestToolBakeGL, LayersLieAsTheConventionSays)
{
  this->WritePanorama("in.exr", MakePanorama(256, [](Vec3 d) { return RGB{ 1.5 + d.x, 1.5 + d.y, 1.5 + d.z }; }));
  this->RunWell("bake in.exr --output out");
  const double scale = this->ReadJSON("out/bake.json").at("exposureScale");
  const Picture mirror = this->ReadPicture("out/layer_0.exr");
  const int n = mirror.Width;
  for (int row = 0; row < 6 * n; ++row)
  {
    for (int column = 0; column < n; ++column)
    {
      const Vec3 d = reference::CubeDirection(row / n, 2 * (column + 0.5) / n - 1, 2 * (row % n + 0.5) / n - 1);
      const float* rgb = mirror.At(column, row);
      ASSERT_NEAR(rgb[0] * scale, 1.5 + d.x, 1e-2) << column << " " << row;
      ASSERT_NEAR(rgb[1] * scale, 1.5 + d.y, 1e-2) << column << " " << row;
      ASSERT_NEAR(rgb[2] * scale, 1.5 + d.z, 1e-2) << column << " " << row;
    }
  }
}

// Coefficients against quadrature in double precision; the cube map's blur of bands 0 to 2 is far below 1e-3 of the
// mean. Mutants: coefficients divided by the exposure scale, y and z swapped, the cosine convolved in.
TEST_F(TestToolBakeGL, HarmonicsAgreeWithTheReference)
{
  const auto panorama = MakePanorama(128,
    [](Vec3 d)
    {
      const double l = std::exp(2 * d.x - d.y + 0.5 * d.z);
      return RGB{ l, 1 + d.y, 2 + d.x * d.z };
    });
  this->WritePanorama("in.exr", panorama);
  this->RunWell("bake in.exr --output out");
  const json coefficients = this->ReadJSON("out/bake.json").at("harmonics").at("coefficients");
  const std::vector<RGB> truth = reference::HarmonicCoefficients(ToReference(panorama), 2);
  for (int i = 0; i < 9; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(coefficients[i][k].get<double>(), truth[i][k], 1e-3 * truth[0][k]) << i << " " << k;
    }
  }
}

// The table through the mapping that its JSON writes. 2e-3: 1024 samples a texel. Mutants: A and B swapped, x and y
// swapped, NoV without its square.
TEST_F(TestToolBakeGL, BRDFAgreesWithTheReference)
{
  this->WriteConstant("in.exr", { 1, 1, 1 });
  this->RunWell("bake in.exr --output out --roughness 1:1");
  const json brdf = this->ReadJSON("out/bake.json").at("brdf");
  const Picture table = this->ReadPicture("out/" + brdf.at("file").get<std::string>());
  const auto& names = table.Channels; // sorted as OpenImageIO likes
  const auto a = std::find(names.begin(), names.end(), brdf.at("channels").at(0)) - names.begin();
  const auto b = std::find(names.begin(), names.end(), brdf.at("channels").at(1)) - names.begin();
  ASSERT_EQ(names.size(), 2u);
  ASSERT_EQ(a + b, 1);
  ASSERT_EQ(table.Width, brdf.at("width"));
  ASSERT_EQ(table.Height, brdf.at("height"));
  ASSERT_EQ(brdf.at("x").at("quantity"), "NoV");
  ASSERT_EQ(brdf.at("y").at("quantity"), "perceptualRoughness");
  for (int row : { 6, 20, 40, 63 })
  {
    for (int column : { 8, 25, 50, 63 })
    {
      const double NoV = GetAxisValue(brdf.at("x"), column, table.Width);
      const double roughness = GetAxisValue(brdf.at("y"), row, table.Height);
      const reference::SplitSum truth = reference::SplitSumAB(NoV, roughness);
      EXPECT_NEAR(table.At(column, row)[a], truth.A, 2e-3) << NoV << " " << roughness;
      EXPECT_NEAR(table.At(column, row)[b], truth.B, 2e-3) << NoV << " " << roughness;
    }
  }
}

// Only the layers that bracket the range. The ladder has ... 0.316 0.422 0.562 0.750 1. Mutants: < for <= at either
// end, all layers written.
TEST_F(TestToolBakeGL, RoughnessLimitsLayers)
{
  this->WriteConstant("in.exr", { 1, 1, 1 });
  const auto bake = [this](const std::string& range)
  {
    this->RunWell("bake in.exr --output out --roughness " + range);
    std::vector<double> roughnesses;
    const json layers = this->ReadJSON("out/bake.json").at("layers");
    for (const json& layer : layers)
    {
      roughnesses.push_back(std::round(1000 * layer.at("perceptualRoughness").get<double>()) / 1000);
      EXPECT_TRUE(std::filesystem::exists(this->Folder / "out" / layer.at("file").get<std::string>()));
    }
    std::filesystem::remove(this->Folder / "out" / "bake.json");
    return roughnesses;
  };
  EXPECT_EQ(bake("0.4:0.6"), (std::vector<double>{ 0.316, 0.422, 0.562, 0.75 }));
  EXPECT_EQ(this->List().size(), 7u); // in.exr, out, brdf.exr, four layers
  EXPECT_EQ(bake("1:1"), (std::vector<double>{ 1 }));
  EXPECT_EQ(bake("0:0"), (std::vector<double>{ 0 }));
  EXPECT_EQ(bake("0.05:0.1"), (std::vector<double>{ 0, 0.1 }));
}

// The predicted error of the rough layers against the measured one, within a factor 2, on two typical maps (soft ones
// do better, small lamps worse: see PredictError); spectral, and samples by default and by tolerance. Bright texels are
// those of the spectral engine. Mutants: k/N, k doubled, the tolerance ignored, --engine ignored.
TEST_F(TestToolBakeGL, PredictsTheErrorWithinAFactorTwo)
{
  for (const std::string name : { "interior", "studio" })
  {
    const std::string path = GetHDRI(name);
    if (path.empty())
    {
      GTEST_SKIP() << "no HDRIs: install blender-data";
    }
    vtkNew<vtkIBLEnvironment> source; // what the tool bakes: cleaned of negative texels
    source->SetFileName(path.c_str());
    ASSERT_TRUE(source->Update());
    const reference::Environment environment = ToReference(source->GetRadianceImage());
    for (const std::string settings : { "", " --engine sampled", " --engine sampled --tolerance 0.1" })
    {
      this->RunWell("bake " + path + " --output out --roughness 0.55:1" + settings);
      const json bake = this->ReadJSON("out/bake.json");
      EXPECT_EQ(bake.at("engine"), settings.empty() ? "spectral" : "sampled");
      EXPECT_EQ(bake.at("brightTexels").size() > 50, settings.empty());
      if (settings.find("tolerance") != std::string::npos)
      {
        EXPECT_NEAR(bake.at("predictedError").get<double>(), 0.1, 2e-3); // no fewer samples than it takes, and no more
      }
      double measured = 0;
      for (int layer = 7; layer <= 9; ++layer)
      {
        measured += MeasureError(this->ReadPicture("out/layer_" + std::to_string(layer) + ".exr"),
                      bake.at("exposureScale"), environment, std::pow(10, (layer - 9) / 8.0)) /
          3;
      }
      const double predicted = bake.at("predictedError");
      std::printf("%s, %d samples: predicted %.4f, measured %.4f\n", name.c_str(),
        bake.at("settings").at("numberOfSamples").get<int>(), predicted, measured);
      EXPECT_LT(predicted, 2 * measured) << name << settings;
      EXPECT_GT(predicted, measured / 2) << name << settings;
    }
  }
}
