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
  for (const char* key : { "numberOfSamples", "specularFaceSize", "numberOfLayers", "cubeFaceSize", "harmonicsOrder" })
  {
    EXPECT_TRUE(bake.at("settings").at(key).is_number_integer()) << key;
  }
  EXPECT_TRUE(bake.at("predictedErrorOf").is_string());
  EXPECT_TRUE(bake.at("irradiance").at("quantity").is_string());
  EXPECT_TRUE(bake.at("tolerance").is_null() || bake.at("tolerance").is_number());
  std::vector<std::string> stages;
  for (const json& stage : bake.at("stages"))
  {
    stages.push_back(stage.at("name"));
    EXPECT_GT(stage.at("milliseconds"), 0.0) << stage;
    EXPECT_GT(stage.at("bytes"), 0) << stage;
  }
  EXPECT_EQ(stages, (std::vector<std::string>{ "read", "cubeMap", "harmonics", "specularChain", "brdfTable" }));
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

struct Layer
{
  double Roughness;
  Picture Texels;
};

// Bilinear, inside a face: s and t are within its outermost texel centres.
RGB ReadFace(const Picture& cube, int face, double s, double t)
{
  const int n = cube.Width;
  const double x = 0.5 * n * (s + 1) - 0.5;
  const double y = 0.5 * n * (t + 1) - 0.5;
  const int i = std::min(int(x), n - 2);
  const int j = std::min(int(y), n - 2);
  RGB rgb{ 0, 0, 0 };
  for (int corner = 0; corner < 4; ++corner)
  {
    const double weight = (corner % 2 ? x - i : 1 - x + i) * (corner / 2 ? y - j : 1 - y + j);
    const float* texel = cube.At(i + corner % 2, face * n + j + corner / 2);
    for (int k = 0; k < 3; ++k)
    {
      rgb[k] += weight * texel[k];
    }
  }
  return rgb;
}

// Relative L1 of what is read halfway between two layers, from 0.1 up, at the worst of them; 96 places on each face.
double MeasureWorstReading(const std::vector<Layer>& layers, double scale, const reference::Environment& environment)
{
  double worst = 0;
  for (std::size_t i = 1; i + 1 < layers.size(); ++i)
  {
    const double roughness = std::sqrt(layers[i].Roughness * layers[i + 1].Roughness);
    const double reach = 1 - 1.0 / layers[i + 1].Texels.Width;
    std::vector<Vec3> directions;
    std::vector<RGB> read;
    for (int place = 0; place < 6 * 96; ++place)
    {
      const double s = reach * (2 * std::fmod(0.5 + 0.7548776662466927 * place, 1.0) - 1); // R2, Roberts 2018
      const double t = reach * (2 * std::fmod(0.5 + 0.5698402909980532 * place, 1.0) - 1);
      directions.push_back(reference::CubeDirection(place % 6, s, t));
      const RGB below = ReadFace(layers[i].Texels, place % 6, s, t);
      const RGB above = ReadFace(layers[i + 1].Texels, place % 6, s, t);
      read.push_back({ 0.5 * (below[0] + above[0]), 0.5 * (below[1] + above[1]), 0.5 * (below[2] + above[2]) });
    }
    const auto truth = reference::Cached<RGB>(
      "prefilter " + std::to_string(roughness) + reference::KeyOf(environment) + reference::KeyOf(directions),
      [&] { return reference::PrefilterAll(environment, directions, roughness); });
    double difference = 0;
    double sum = 0;
    for (std::size_t k = 0; k < 3 * truth.size(); ++k)
    {
      difference += std::abs(scale * read[k / 3][k % 3] - truth[k / 3][k % 3]);
      sum += truth[k / 3][k % 3];
    }
    worst = std::max(worst, difference / sum);
  }
  return worst;
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
  json cubes = bake.at("layers");
  EXPECT_EQ(cubes.size(), bake.at("settings").at("numberOfLayers").get<std::size_t>() + 1);
  EXPECT_EQ(cubes.at(0).at("faceSize"), bake.at("settings").at("cubeFaceSize"));
  EXPECT_EQ(cubes.at(1).at("faceSize"), bake.at("settings").at("specularFaceSize"));
  cubes.push_back(bake.at("irradiance"));
  for (const json& layer : cubes)
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
}

// Every layer of a constant, and its irradiance over pi, is the constant, once multiplied by the exposure scale. 6e-4:
// half floats in the chain.
// Mutants: files not divided, or divided twice; mean without 1/(4 pi Y00).
TEST_F(TestToolBakeGL, KeepsAConstant)
{
  const RGB constant = { 0.25, 1, 300 };
  this->WriteConstant("in.exr", constant);
  this->RunWell("bake in.exr --output out");
  const json bake = this->ReadJSON("out/bake.json");
  const double scale = bake.at("exposureScale");
  EXPECT_NEAR(scale, 0.2126 * 0.25 + 0.7152 + 0.0722 * 300, 1e-3);
  json cubes = bake.at("layers");
  cubes.push_back(bake.at("irradiance"));
  for (const json& layer : cubes)
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

// The mirror's layer shows each direction's own light, where the convention puts it; the layer of roughness 1 and
// irradiance the clamped cosine's 2/3 of what changes, at texel centres. The panorama is linear and differs along each
// axis; 1e-2: one texel of blur; 2e-3: half floats. Mutants: rows flipped, faces swapped, s and t swapped, a mirrored
// face, texels sharpened for reading (1.6e-2 at 8^2), irradiance not divided by pi.
TEST_F(TestToolBakeGL, LayersLieAsTheConventionSays)
{
  this->WritePanorama("in.exr", MakePanorama(256, [](Vec3 d) { return RGB{ 1.5 + d.x, 1.5 + d.y, 1.5 + d.z }; }));
  this->RunWell("bake in.exr --output out");
  const json bake = this->ReadJSON("out/bake.json");
  const double scale = bake.at("exposureScale");
  const auto expectLinear = [&](const std::string& file, double slope, double tolerance)
  {
    const Picture cube = this->ReadPicture(file);
    const int n = cube.Width;
    for (int row = 0; row < 6 * n; ++row)
    {
      for (int column = 0; column < n; ++column)
      {
        const Vec3 d = reference::CubeDirection(row / n, 2 * (column + 0.5) / n - 1, 2 * (row % n + 0.5) / n - 1);
        const float* rgb = cube.At(column, row);
        ASSERT_NEAR(rgb[0] * scale, 1.5 + slope * d.x, tolerance) << file << " " << column << " " << row;
        ASSERT_NEAR(rgb[1] * scale, 1.5 + slope * d.y, tolerance) << file << " " << column << " " << row;
        ASSERT_NEAR(rgb[2] * scale, 1.5 + slope * d.z, tolerance) << file << " " << column << " " << row;
      }
    }
  };
  expectLinear("out/layer_0.exr", 1, 1e-2);
  expectLinear("out/" + bake.at("layers").back().at("file").get<std::string>(), 2.0 / 3.0, 2e-3);
  expectLinear("out/irradiance.exr", 2.0 / 3.0, 2e-3);
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

// Only the layers that bracket the range: the first is not above its beginning, the last not below its end, and all
// others within. Stripes, so that there are layers to leave out. Mutants: < for <= at either end, all layers written.
TEST_F(TestToolBakeGL, RoughnessLimitsLayers)
{
  this->WritePanorama("in.exr",
    MakePanorama(128,
      [](Vec3 d) {
        return std::sin(8 * d.y) > 0.5 ? RGB{ 9, 9, 9 } : RGB{ 0.1, 0.1, 0.1 };
      }));
  const auto bake = [this](const std::string& range)
  {
    this->RunWell("bake in.exr --output out --tolerance 0.004 --roughness " + range);
    std::vector<double> roughnesses;
    const json layers = this->ReadJSON("out/bake.json").at("layers");
    for (const json& layer : layers)
    {
      roughnesses.push_back(layer.at("perceptualRoughness").get<double>());
      EXPECT_TRUE(std::filesystem::exists(this->Folder / "out" / layer.at("file").get<std::string>()));
    }
    EXPECT_EQ(this->List().size(), 5 + roughnesses.size()); // in.exr, out, bake.json, brdf.exr, irradiance.exr
    std::filesystem::remove_all(this->Folder / "out");
    return roughnesses;
  };
  const std::vector<double> middle = bake("0.4:0.6");
  ASSERT_GE(middle.size(), 2u);
  EXPECT_GT(middle.front(), 0.1);
  EXPECT_LE(middle.front(), 0.4);
  EXPECT_GT(middle.at(1), 0.4);
  EXPECT_GE(middle.back(), 0.6);
  EXPECT_LT(middle.at(middle.size() - 2), 0.6);
  EXPECT_LT(middle.back(), 1.0);
  EXPECT_EQ(bake("1:1"), (std::vector<double>{ 1 }));
  EXPECT_EQ(bake("0:0"), (std::vector<double>{ 0 }));
  EXPECT_EQ(bake("0.05:0.1"), (std::vector<double>{ 0, 0.1 }));
}

// The predicted error of what is read from spectral layers, and of texels of sharp sampled ones, against the measured
// one, within a factor 2, on two typical maps (soft ones do better, small lamps worse: see PredictError); by default
// and by tolerance, which chooses the ladder or the samples. Bright texels are those of the spectral engine. Mutants:
// k/N, k doubled, the tolerance ignored, --engine ignored, the sampled engine's prediction for the spectral one.
TEST_F(TestToolBakeGL, PredictsTheErrorWithinAFactorTwo)
{
  for (const std::string name : { "interior", "city" })
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
    std::size_t defaultLayers = 0;
    for (const std::string settings :
      { "", " --tolerance 0.06", " --engine sampled", " --engine sampled --tolerance 0.03" })
    {
      const bool spectral = settings.find("sampled") == std::string::npos;
      this->RunWell("bake " + path + " --output out" + (spectral ? "" : " --roughness 0.1:0.31") + settings);
      const json bake = this->ReadJSON("out/bake.json");
      EXPECT_EQ(bake.at("engine"), spectral ? "spectral" : "sampled");
      EXPECT_NE(bake.at("brightTexels").empty(), spectral);
      const double predicted = bake.at("predictedError");
      if (spectral)
      {
        EXPECT_LE(predicted, settings.empty() ? 0.02 : 0.06);
        EXPECT_TRUE(settings.empty() || bake.at("layers").size() < defaultLayers);
        defaultLayers = bake.at("layers").size();
      }
      else if (settings.find("tolerance") != std::string::npos)
      {
        EXPECT_NEAR(predicted, 0.03, 1e-3); // no fewer samples than it takes, and no more
      }
      std::vector<Layer> layers;
      double mean = 0;
      for (const json& layer : bake.at("layers"))
      {
        layers.push_back(
          { layer.at("perceptualRoughness"), this->ReadPicture("out/" + layer.at("file").get<std::string>()) });
        if (!spectral)
        {
          mean += MeasureError(layers.back().Texels, bake.at("exposureScale"), environment, layers.back().Roughness) /
            double(bake.at("layers").size());
        }
      }
      const double measured = spectral ? MeasureWorstReading(layers, bake.at("exposureScale"), environment) : mean;
      std::printf("%s%s, %zu layers: predicted %.4f, measured %.4f\n", name.c_str(), settings.c_str(), layers.size(),
        predicted, measured);
      EXPECT_LT(predicted, 2 * measured) << name << settings;
      EXPECT_GT(predicted, measured / 2) << name << settings;
    }
  }
}
