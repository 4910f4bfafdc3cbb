// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkibl bake: the precomputed light of an environment as files.
#include "Tool.h"

#include "vtkIBLBRDFTable.h"
#include "vtkIBLCache.h"
#include "vtkIBLCubeMap.h"
#include "vtkIBLIrradiance.h"
#include "vtkIBLLighting.h"
#include "vtkIBLSpecularChain.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

namespace fs = std::filesystem;
using tool::JSON;

namespace
{
constexpr int MostSamples = 65536; // vtkIBLSpecularChain's own bounds
constexpr int LeastSamples = 16;
constexpr double LeastTolerance = 0.002;

struct BakeOptions
{
  std::string Input;
  std::string Output;
  double Tolerance = 0.0; // 0: not given
  std::string Engine = "spectral";
  std::vector<double> Roughness = { 0.0, 1.0 };
  bool Verbose = false;
};

// What N samples leave in the sharp layers (perceptualRoughness 0.1 to 0.32) of the sampled engine; rough ones have
// 0.1 % whatever N is. k N^-1/2 and a floor, by measurement: over eight maps, against the converged integral at
// about 384 texels a layer, mean over maps and layers:
//   N = 32: 0.0340   64: 0.0225   128: 0.0155   256: 0.0102   512: 0.0080
// It is a rule for a typical map: soft light takes a fifth (sunset), small lamps and panels twice (sunrise, studio).
constexpr double SampledFloor = 0.003;
constexpr double SampledSlope = 0.18;
double PredictError(int samples)
{
  return std::hypot(SampledSlope / std::sqrt(samples), SampledFloor);
}

int SamplesForTolerance(double tolerance)
{
  if (tolerance < PredictError(MostSamples))
  {
    char text[160];
    std::snprintf(text, sizeof(text),
      "--tolerance %g is below what sampling reaches: %d are the most samples, for a tolerance of %.2g; leave it to "
      "--engine spectral",
      tolerance, MostSamples, PredictError(MostSamples));
    throw tool::Failure(text);
  }
  const double samples =
    std::max(std::ceil(SampledSlope * SampledSlope / (tolerance * tolerance - SampledFloor * SampledFloor)),
      double(LeastSamples));
  if (samples > MostSamples)
  {
    return MostSamples;
  }
  return static_cast<int>(samples);
}

// The layers whose roughnesses bracket [from, to]: first and last.
std::array<int, 2> FindLayers(const vtkIBLSpecularChain* chain, double from, double to)
{
  int first = 0;
  int last = chain->GetNumberOfLayers();
  while (first < last && chain->GetPerceptualRoughness(first + 1) <= from)
  {
    ++first;
  }
  while (last > first && chain->GetPerceptualRoughness(last - 1) >= to)
  {
    --last;
  }
  return { first, last };
}

// Radiance over `scale`; returns the face's size.
int WriteCube(vtkImageData* image, double roughness, double scale, const fs::path& path, tool::OutputFiles& files)
{
  tool::ThrowIfError();
  const int n = image->GetDimensions()[0];
  auto* value = static_cast<float*>(image->GetScalarPointer());
  std::transform(value, value + 18 * std::ptrdiff_t(n) * n, value, [=](float x) { return float(x / scale); });
  const JSON metadata = { { "vtkibl:perceptualRoughness", roughness }, { "vtkibl:exposureScale", scale },
    { "vtkibl:layout", "six faces +X -X +Y -Y +Z -Z top to bottom, OpenGL's s to the right and t down" } };
  // Memory has face after face with row 0 at t = 0: the file's own order, no row is turned.
  files.Add(path, tool::EncodeEXR(n, 6 * n, { "R", "G", "B" }, value, metadata));
  return n;
}

JSON WriteLayers(vtkIBLLighting* lighting, const BakeOptions& options, const fs::path& folder, tool::OutputFiles& files)
{
  JSON layers = JSON::array();
  vtkIBLSpecularChain* chain = lighting->GetSpecularChain();
  const auto [first, last] = FindLayers(chain, options.Roughness[0], options.Roughness[1]);
  for (int layer = first; layer <= last; ++layer)
  {
    const double roughness = chain->GetPerceptualRoughness(layer);
    const std::string file = "layer_" + std::to_string(layer) + ".exr";
    const int n = WriteCube(layer == 0 ? lighting->GetCubeMap()->ReadLevel(0) : chain->ReadLayer(layer), roughness,
      chain->GetStoredScale(), folder / file, files);
    layers.push_back({ { "index", layer }, { "perceptualRoughness", roughness }, { "faceSize", n }, { "file", file } });
  }
  return layers;
}

JSON WriteIrradiance(vtkIBLSpecularChain* chain, const fs::path& folder, tool::OutputFiles& files)
{
  const int n = WriteCube(chain->ReadIrradianceMap(), 1.0, chain->GetStoredScale(), folder / "irradiance.exr", files);
  return { { "file", "irradiance.exr" }, { "faceSize", n },
    { "quantity",
      "irradiance over pi, that is, the mean of radiance under the clamped cosine; laid out as layers are" } };
}

JSON WriteBRDF(vtkIBLBRDFTable* table, const fs::path& folder, tool::OutputFiles& files)
{
  const vtkSmartPointer<vtkImageData> image = table->Read();
  tool::ThrowIfError();
  constexpr int n = vtkIBLBRDFTable::Size;
  const auto* rgba = static_cast<const float*>(image->GetScalarPointer());
  std::vector<float> ab;
  for (int i = 0; i < n * n; ++i) // the lower block; lobes are for our ladder
  {
    ab.insert(ab.end(), { rgba[4 * i], rgba[4 * i + 1] });
  }
  const JSON metadata = { { "vtkibl:layout", "x: NoV = (i/(n-1))^2; y: perceptualRoughness = j/(n-1), row 0 on top" } };
  files.Add(folder / "brdf.exr", tool::EncodeEXR(n, n, { "A", "B" }, ab.data(), metadata));
  return { { "file", "brdf.exr" }, { "width", n }, { "height", n }, { "channels", { "A", "B" } },
    { "reflectance", "f0 * A + f90 * B, Schlick's Fresnel term; take channels by name, some readers sort A last" },
    { "geometry",
      table->GetGeometryTerm() == vtkIBLBRDFTable::SmithCorrelated ? "height-correlated Smith"
                                                                   : "Schlick-Smith, k = alpha/2" },
    { "mapping",
      "value = (first + (last - first) * index / (count - 1))^power; index 0 is the left column, the top row" },
    { "x", { { "quantity", "NoV" }, { "first", 0 }, { "last", 1 }, { "power", 2 } } },
    { "y", { { "quantity", "perceptualRoughness" }, { "first", 0 }, { "last", 1 }, { "power", 1 } } } };
}

JSON DescribeHarmonics(vtkIBLIrradiance* irradiance)
{
  JSON coefficients = JSON::array();
  for (int i = 0; i < irradiance->GetNumberOfCoefficients(); ++i)
  {
    double rgb[3];
    irradiance->GetRadianceCoefficient(i, rgb);
    coefficients.push_back({ rgb[0], rgb[1], rgb[2] });
  }
  return { { "quantity",
             "integral over the sphere of radiance times Y [radiance sr]: no cosine convolved in, no 1/pi, "
             "not divided by exposureScale" },
    { "basis",
      "real, orthonormal, no Condon-Shortley sign; z is the polar axis of the formulas, y is up in the world" },
    { "order", irradiance->GetOrder() }, { "index", "l (l + 1) + m" },
    { "functions", { "1", "y", "z", "x", "xy", "yz", "3z^2-1", "xz", "x^2-y^2" } },
    { "factors",
      { 0.5 / std::sqrt(M_PI), std::sqrt(0.75 / M_PI), std::sqrt(0.75 / M_PI), std::sqrt(0.75 / M_PI),
        0.5 * std::sqrt(15 / M_PI), 0.5 * std::sqrt(15 / M_PI), 0.25 * std::sqrt(5 / M_PI), 0.5 * std::sqrt(15 / M_PI),
        0.25 * std::sqrt(15 / M_PI) } },
    { "irradianceFactors", { M_PI, 2 * M_PI / 3, M_PI / 4 } }, { "coefficients", coefficients } };
}

JSON DescribeStages(vtkIBLLighting* lighting, vtkIBLIrradiance* irradiance, double readSeconds)
{
  vtkIBLEnvironment* environment = lighting->GetEnvironment();
  const auto stage = [](const char* name, vtkIBLStage* made, int bytesATexel)
  {
    return JSON{ { "name", name }, { "milliseconds", 1000.0 * made->GetLastBuildSeconds() },
      { "bytes", made->GetLastBuildTexels() * bytesATexel } };
  };
  return { { { "name", "read" }, { "milliseconds", 1000.0 * readSeconds },
             { "bytes", 12 * environment->GetRadianceImage()->GetNumberOfPoints() } },
    stage("cubeMap", lighting->GetCubeMap(), 16), // RGBA32F
    { { "name", "harmonics" }, { "milliseconds", 1000.0 * irradiance->GetLastBuildSeconds() },
      { "bytes", irradiance->GetNumberOfCoefficients() * 3 * sizeof(double) } },
    stage("specularChain", lighting->GetSpecularChain(), 8), // RGBA16F
    stage("brdfTable", lighting->GetBRDFTable(), 4) };       // RG16
}

JSON DescribeBrightTexels(const vtkIBLSpecularChain* chain)
{
  JSON texels = JSON::array();
  for (int i = 0; i < chain->GetNumberOfBrightTexels(); ++i)
  {
    std::array<double, 3> direction;
    std::array<double, 3> radiance;
    const double solidAngle = chain->GetBrightTexel(i, direction.data(), radiance.data());
    texels.push_back({ { "direction", direction }, { "solidAngle", solidAngle }, { "radiance", radiance } });
  }
  return texels;
}

// The spectral engine takes lat-long images; what is made of faces is sampled.
bool IsSpectral(const BakeOptions& options, vtkIBLLighting* lighting)
{
  return options.Engine == "spectral" && lighting->GetEnvironment()->GetNumberOfFaces() == 1;
}

void SetTolerance(const BakeOptions& options, vtkIBLLighting* lighting)
{
  if (!IsSpectral(options, lighting))
  {
    lighting->GetSpecularChain()->SetNumberOfSamples(SamplesForTolerance(options.Tolerance));
    return;
  }
  if (options.Tolerance < LeastTolerance)
  {
    char text[160];
    std::snprintf(text, sizeof(text), "--tolerance %g is below what half floats and layers can keep; take %g or more",
      options.Tolerance, LeastTolerance);
    throw tool::Failure(text);
  }
  lighting->GetSpecularChain()->SetErrorTolerance(options.Tolerance);
}

double GetPredictedError(const BakeOptions& options, vtkIBLLighting* lighting)
{
  vtkIBLSpecularChain* chain = lighting->GetSpecularChain();
  return IsSpectral(options, lighting) ? chain->GetPredictedError() : PredictError(chain->GetNumberOfSamples());
}

JSON DescribeBake(const BakeOptions& options, vtkIBLLighting* lighting, vtkIBLIrradiance* irradiance)
{
  vtkIBLEnvironment* environment = lighting->GetEnvironment();
  vtkIBLSpecularChain* chain = lighting->GetSpecularChain();
  JSON json = { { "format", "vtkibl-bake" }, { "version", tool::FormatVersion }, { "generator", tool::Generator } };
  json.update(tool::DescribeEnvironment(options.Input, environment));
  double rgb[3];
  irradiance->GetRadianceCoefficient(0, rgb);
  const double mean = 0.5 / std::sqrt(M_PI); // c00 = mean 4 pi Y00, Y00 = 1/(2 sqrt(pi))
  json["mean"] = { mean * rgb[0], mean * rgb[1], mean * rgb[2] };
  json["cleanedTexels"] = { { "notFinite", environment->GetNumberOfNotFiniteTexels() },
    { "tooLarge", environment->GetNumberOfTooLargeTexels() },
    { "negative", environment->GetNumberOfNegativeTexels() } };
  json["exposureScale"] = chain->GetStoredScale();
  const bool spectral = IsSpectral(options, lighting);
  json["engine"] = spectral ? "spectral" : "sampled";
  json["settings"] = { { "numberOfSamples", chain->GetNumberOfSamples() },
    { "errorTolerance", chain->GetErrorTolerance() }, { "specularFaceSize", chain->GetLayerFaceSize(1) },
    { "numberOfLayers", chain->GetNumberOfLayers() }, { "cubeFaceSize", lighting->GetCubeMap()->GetOutputFaceSize() },
    { "harmonicsOrder", irradiance->GetOrder() }, { "brdfSamples", lighting->GetBRDFTable()->GetNumberOfSamples() },
    { "roughness", options.Roughness } };
  json["tolerance"] = options.Tolerance > 0.0 ? JSON(options.Tolerance) : JSON(nullptr);
  json["predictedError"] = GetPredictedError(options, lighting);
  json["predictedErrorOf"] = spectral
    ? "what is read bilinearly and mixed between two layers, relative L1 at the worst roughness from 0.1 up"
    : "texels of layers of perceptualRoughness 0.1 to 0.32, mean relative L1";
  json["harmonics"] = DescribeHarmonics(irradiance);
  json["brightTexels"] = DescribeBrightTexels(chain);
  return json;
}

// A folder that goes again, if it was made here, when nothing came to lie in it.
class OutputFolder
{
public:
  explicit OutputFolder(const std::string& path)
    : Path(path)
  {
    std::error_code error;
    this->Made = fs::create_directories(this->Path, error);
    if (!fs::is_directory(this->Path))
    {
      throw tool::Failure(
        "cannot make the folder '" + path + "': " + (error ? error.message() : std::string("something else is there")));
    }
  }
  ~OutputFolder()
  {
    std::error_code error;
    if (this->Made)
    {
      fs::remove(this->Path, error); // only an empty one
    }
  }
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const fs::path Path;

private:
  bool Made = false;
};

void PrintSummary(const JSON& json)
{
  for (const JSON& stage : json["stages"])
  {
    std::printf("%-14s %10.1f ms %12lld bytes\n", stage["name"].get<std::string>().c_str(),
      stage["milliseconds"].get<double>(), stage["bytes"].get<long long>());
  }
  std::printf("%s, predicted error %.2g, exposure scale %g, %zu layers\n", json["engine"].get<std::string>().c_str(),
    json["predictedError"].get<double>(), json["exposureScale"].get<double>(), json["layers"].size());
}

// What of the light is written: irradiance, and the layers that bracket the roughness asked for.
void BuildLight(const BakeOptions& options, vtkIBLLighting* lighting, vtkIBLIrradiance* irradiance,
  vtkIBLOffscreenWindow* window, tool::Progress& progress)
{
  progress.Set(0.4, "light");
  vtkIBLSceneNeeds needs;
  needs.Irradiance = true;
  needs.AddRoughness(options.Roughness[0], options.Roughness[1]);
  const bool built = lighting->Update(window, needs) && irradiance->Update(window);
  tool::ThrowIfError();
  if (!built)
  {
    throw tool::Failure("the light of '" + options.Input + "' could not be made");
  }
}

void Bake(const BakeOptions& options)
{
  tool::Progress progress;
  vtkIBLCache::SetEnabled(false); // times are of a bake, and pixels are at hand
  const auto start = std::chrono::steady_clock::now();
  vtkNew<vtkIBLOffscreenWindow> window;
  vtkNew<vtkIBLLighting> lighting;
  lighting->BrightTexelsOff(); // what is exported holds all light
  vtkNew<vtkIBLIrradiance> irradiance;
  lighting->GetSpecularChain()->SetEngine(
    options.Engine == "spectral" ? vtkIBLSpecularChain::Spectral : vtkIBLSpecularChain::Sampled);
  lighting->GetSpecularChain()->FitReadingOff();
  lighting->SetEnvironment(tool::ReadEnvironment(options.Input, progress));
  irradiance->SetEnvironment(lighting->GetEnvironment());
  if (options.Tolerance > 0.0)
  {
    SetTolerance(options, lighting);
  }
  const std::chrono::duration<double> readTime = std::chrono::steady_clock::now() - start;
  const OutputFolder folder(options.Output);
  tool::CheckOutput(folder.Path / "bake.json");
  tool::StartWindow(window, { 16, 16 });
  BuildLight(options, lighting, irradiance, window, progress);

  progress.Set(0.9, "writing");
  JSON json = DescribeBake(options, lighting, irradiance);
  json["stages"] = DescribeStages(lighting, irradiance, readTime.count());
  tool::OutputFiles files;
  json["layerLayout"] =
    "six faces +X -X +Y -Y +Z -Z stacked top to bottom, each with OpenGL's own s to the right and t "
    "down (OpenGL 4.6, table 8.19): the file's top row is t = 0 of face +X. Radiance = value times "
    "exposureScale";
  json["layers"] = WriteLayers(lighting, options, folder.Path, files);
  json["irradiance"] = WriteIrradiance(lighting->GetSpecularChain(), folder.Path, files);
  json["brdf"] = WriteBRDF(lighting->GetBRDFTable(), folder.Path, files);
  files.Add(folder.Path / "bake.json", tool::EncodeJSON(json));
  files.Commit();
  progress.Finish();
  lighting->ReleaseGraphicsResources(window);
  if (IsSpectral(options, lighting) && json["predictedError"] > json["settings"]["errorTolerance"])
  {
    tool::PrintWarning("the largest layers are predicted to be " + json["predictedError"].dump() +
      " off, more than the tolerance of " + json["settings"]["errorTolerance"].dump());
  }
  if (options.Verbose)
  {
    PrintSummary(json);
  }
  std::printf("wrote %s\n", (folder.Path / "bake.json").c_str());
}
}

void tool::AddBake(CLI::App& app)
{
  auto options = std::make_shared<BakeOptions>();
  CLI::App* command = app.add_subcommand(
    "bake", "Writes an environment's precomputed light as float OpenEXR files and a JSON file that describes them.");
  command->footer("Example:\n  vtkibl bake studio.exr --output studio-light --tolerance 0.02\n\n"
                  "DIR gets layer_<i>.exr (reflections, mirror to matt), irradiance.exr, brdf.exr (the split sum's\n"
                  "table) and, last, bake.json (conventions, spherical harmonics, settings, cost): where it is, the\n"
                  "bake is complete.");
  command->add_option("IN", options->Input, "Environment: any image that OpenImageIO reads, lat-long or a cube layout")
    ->required()
    ->type_name("");
  command->add_option("--output", options->Output, "Folder to write to; made if need be")->required()->type_name("DIR");
  command
    ->add_option("--tolerance", options->Tolerance,
      "Relative error that reflections may have, in (0, 0.5]: sets how many layers there are\n"
      "and how large, of the spectral engine (default 0.02, least 0.002), and the samples of\n"
      "sharp layers of the sampled one (default: 64 a texel)")
    ->check(InRange(0.0, 0.5, true))
    ->type_name("T");
  command
    ->add_option("--engine", options->Engine,
      "How layers are computed: spectral (default; those of a cube are sampled all the same)\n"
      "or sampled")
    ->check(CLI::IsMember({ "spectral", "sampled" }))
    ->type_name("ENGINE");
  AddNumbers(command, "--roughness", options->Roughness, ':', 0.0, 1.0, "A:B",
    "Write only the layers that bracket perceptual roughness A to B, in [0, 1]; default 0:1");
  command->add_flag("--verbose", options->Verbose, "Print milliseconds and bytes of each stage");
  command->callback(
    [options]
    {
      if (options->Roughness[0] > options->Roughness[1])
      {
        throw CLI::ValidationError("--roughness", "A:B goes from the smaller to the larger");
      }
      Bake(*options);
    });
}
