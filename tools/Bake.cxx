// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkibl bake: the precomputed light of an environment as files.
#include "Tool.h"

#include "vtkIBLBRDFTable.h"
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

struct BakeOptions
{
  std::string Input;
  std::string Output;
  double Tolerance = 0.0; // 0: not given
  std::string Engine = "spectral";
  std::vector<double> Roughness = { 0.0, 1.0 };
  bool Verbose = false;
};

// Mean relative L1 error of the rough layers (perceptualRoughness 0.56, 0.75, 1) of the spectral engine: half floats'
// rounding, over the same eight maps.
constexpr double SpectralError = 1.8e-4;

// The same that N samples leave: k N^-1/2, by
// measurement. The eight HDRIs of Blender's studiolights/world, 1024 x 512, against the converged integral at about 384
// texels a layer; mean over the maps of the error:
//   N = 64: 0.0909 (k = 0.73)   256: 0.0513 (0.82)   1024: 0.0360 (1.15)   mean of the three: k = 0.90
// It is a rule for a typical map: light from small lamps takes more (sunrise 1.3 to 2.6, night 0.75 to 2.0), soft light
// less (courtyard 0.2 to 0.45, sunset 0.17 to 0.25); city, interior and studio lie within 0.68 to 1.5.
double PredictError(int samples)
{
  constexpr double k = 0.90;
  return k / std::sqrt(samples);
}

int SamplesForTolerance(double tolerance)
{
  const double one = PredictError(1);
  const double samples = std::max(std::ceil(one * one / (tolerance * tolerance)), double(LeastSamples));
  if (samples > MostSamples)
  {
    char text[160];
    std::snprintf(text, sizeof(text),
      "--tolerance %g would take %.0f samples; %d are the most, for a tolerance of %.2g", tolerance, samples,
      MostSamples, PredictError(MostSamples));
    throw tool::Failure(text);
  }
  return static_cast<int>(samples);
}

// The layers whose roughnesses bracket [from, to]: first and last.
std::array<int, 2> FindLayers(double from, double to)
{
  int first = 0;
  int last = vtkIBLSpecularChain::GetNumberOfLayers() - 1;
  while (first < last && vtkIBLSpecularChain::GetPerceptualRoughness(first + 1) <= from)
  {
    ++first;
  }
  while (last > first && vtkIBLSpecularChain::GetPerceptualRoughness(last - 1) >= to)
  {
    --last;
  }
  return { first, last };
}

JSON WriteLayers(
  vtkIBLSpecularChain* chain, const BakeOptions& options, const fs::path& folder, tool::OutputFiles& files)
{
  JSON layers = JSON::array();
  const auto [first, last] = FindLayers(options.Roughness[0], options.Roughness[1]);
  for (int layer = first; layer <= last; ++layer)
  {
    const vtkSmartPointer<vtkImageData> image = chain->ReadLayer(layer);
    tool::ThrowIfError();
    const int n = image->GetDimensions()[0];
    auto* value = static_cast<float*>(image->GetScalarPointer());
    const double scale = chain->GetStoredScale();
    std::transform(value, value + 18 * std::ptrdiff_t(n) * n, value, [=](float x) { return float(x / scale); });

    const double roughness = vtkIBLSpecularChain::GetPerceptualRoughness(layer);
    const std::string file = "layer_" + std::to_string(layer) + ".exr";
    const JSON metadata = { { "vtkibl:perceptualRoughness", roughness }, { "vtkibl:exposureScale", scale },
      { "vtkibl:layout", "six faces +X -X +Y -Y +Z -Z top to bottom, OpenGL's s to the right and t down" } };
    // Memory has face after face with row 0 at t = 0: the file's own order, no row is turned.
    files.Add(folder / file, tool::EncodeEXR(n, 6 * n, { "R", "G", "B" }, value, metadata));
    layers.push_back({ { "index", layer }, { "perceptualRoughness", roughness }, { "faceSize", n }, { "file", file } });
  }
  return layers;
}

JSON WriteBRDF(vtkIBLBRDFTable* table, const fs::path& folder, tool::OutputFiles& files)
{
  const vtkSmartPointer<vtkImageData> image = table->Read();
  tool::ThrowIfError();
  constexpr int n = vtkIBLBRDFTable::Size;
  const auto* rgb = static_cast<const float*>(image->GetScalarPointer());
  std::vector<float> ab;
  for (int i = 0; i < n * n; ++i)
  {
    ab.insert(ab.end(), { rgb[3 * i], rgb[3 * i + 1] });
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
  for (int i = 0; i < 9; ++i)
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
    { "order", 2 }, { "index", "l (l + 1) + m" },
    { "functions", { "1", "y", "z", "x", "xy", "yz", "3z^2-1", "xz", "x^2-y^2" } },
    { "factors",
      { 0.5 / std::sqrt(M_PI), std::sqrt(0.75 / M_PI), std::sqrt(0.75 / M_PI), std::sqrt(0.75 / M_PI),
        0.5 * std::sqrt(15 / M_PI), 0.5 * std::sqrt(15 / M_PI), 0.25 * std::sqrt(5 / M_PI), 0.5 * std::sqrt(15 / M_PI),
        0.25 * std::sqrt(15 / M_PI) } },
    { "irradianceFactors", { M_PI, 2 * M_PI / 3, M_PI / 4 } }, { "coefficients", coefficients } };
}

JSON DescribeStages(vtkIBLLighting* lighting, double readSeconds)
{
  const vtkIBLEnvironment* environment = lighting->GetEnvironment();
  const auto stage = [](const char* name, vtkIBLStage* made, int bytesATexel)
  {
    return JSON{ { "name", name }, { "milliseconds", 1000.0 * made->GetLastBuildSeconds() },
      { "bytes", made->GetLastBuildTexels() * bytesATexel } };
  };
  return { { { "name", "read" }, { "milliseconds", 1000.0 * readSeconds },
             { "bytes", 12 * environment->GetRadianceImage()->GetNumberOfPoints() } },
    stage("cubeMap", lighting->GetCubeMap(), 16), // RGBA32F
    { { "name", "irradiance" }, { "milliseconds", 1000.0 * lighting->GetIrradiance()->GetLastBuildSeconds() },
      { "bytes", 9 * 3 * sizeof(double) } },
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
  return options.Engine == "spectral" && lighting->GetEnvironment()->GetRadianceImage()->GetDimensions()[2] == 1;
}

JSON DescribeBake(const BakeOptions& options, vtkIBLLighting* lighting)
{
  vtkIBLEnvironment* environment = lighting->GetEnvironment();
  const int samples = lighting->GetSpecularChain()->GetNumberOfSamples();
  JSON json = { { "format", "vtkibl-bake" }, { "version", tool::FormatVersion }, { "generator", tool::Generator } };
  json.update(tool::DescribeEnvironment(options.Input, environment));
  double rgb[3];
  lighting->GetIrradiance()->GetRadianceCoefficient(0, rgb);
  const double mean = 0.5 / std::sqrt(M_PI); // c00 = mean 4 pi Y00, Y00 = 1/(2 sqrt(pi))
  json["mean"] = { mean * rgb[0], mean * rgb[1], mean * rgb[2] };
  json["cleanedTexels"] = { { "notFinite", environment->GetNumberOfNotFiniteTexels() },
    { "tooLarge", environment->GetNumberOfTooLargeTexels() },
    { "negative", environment->GetNumberOfNegativeTexels() } };
  json["exposureScale"] = lighting->GetSpecularChain()->GetStoredScale();
  const bool spectral = IsSpectral(options, lighting);
  json["engine"] = spectral ? "spectral" : "sampled";
  json["settings"] = { { "numberOfSamples", samples },
    { "specularFaceSize", lighting->GetSpecularChain()->GetLayerFaceSize(0) },
    { "cubeFaceSize", lighting->GetCubeMap()->GetOutputFaceSize() },
    { "brdfSamples", lighting->GetBRDFTable()->GetNumberOfSamples() }, { "roughness", options.Roughness } };
  json["tolerance"] = options.Tolerance > 0.0 ? JSON(options.Tolerance) : JSON(nullptr);
  json["predictedError"] = spectral ? SpectralError : PredictError(samples);
  json["harmonics"] = DescribeHarmonics(lighting->GetIrradiance());
  json["brightTexels"] = DescribeBrightTexels(lighting->GetSpecularChain());
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
  std::printf("%d samples at roughness 1, predicted error %.2g, exposure scale %g, %zu layers\n",
    json["settings"]["numberOfSamples"].get<int>(), json["predictedError"].get<double>(),
    json["exposureScale"].get<double>(), json["layers"].size());
}

void Bake(const BakeOptions& options)
{
  tool::Progress progress;
  const auto start = std::chrono::steady_clock::now();
  vtkNew<vtkIBLOffscreenWindow> window;
  vtkNew<vtkIBLLighting> lighting;
  lighting->GetSpecularChain()->SetEngine(
    options.Engine == "spectral" ? vtkIBLSpecularChain::Spectral : vtkIBLSpecularChain::Sampled);
  if (options.Tolerance > 0.0)
  {
    lighting->GetSpecularChain()->SetNumberOfSamples(SamplesForTolerance(options.Tolerance));
  }
  lighting->SetEnvironment(tool::ReadEnvironment(options.Input, progress));
  const std::chrono::duration<double> readTime = std::chrono::steady_clock::now() - start;
  const OutputFolder folder(options.Output);
  tool::CheckOutput(folder.Path / "bake.json");
  tool::StartWindow(window, { 16, 16 });
  tool::BuildLighting(lighting, window, progress);

  progress.Set(0.9, "writing");
  JSON json = DescribeBake(options, lighting);
  json["stages"] = DescribeStages(lighting, readTime.count());
  tool::OutputFiles files;
  json["layerLayout"] =
    "six faces +X -X +Y -Y +Z -Z stacked top to bottom, each with OpenGL's own s to the right and t "
    "down (OpenGL 4.6, table 8.19): the file's top row is t = 0 of face +X. Radiance = value times "
    "exposureScale";
  json["layers"] = WriteLayers(lighting->GetSpecularChain(), options, folder.Path, files);
  json["brdf"] = WriteBRDF(lighting->GetBRDFTable(), folder.Path, files);
  files.Add(folder.Path / "bake.json", tool::EncodeJSON(json));
  files.Commit();
  progress.Finish();
  lighting->ReleaseGraphicsResources(window);

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
                  "DIR gets layer_<i>.exr (reflections, mirror to matt), brdf.exr (the split sum's table) and, last,\n"
                  "bake.json (conventions, spherical harmonics, settings, cost): where it is, the bake is complete.");
  command->add_option("IN", options->Input, "Environment: any image that OpenImageIO reads, lat-long or a cube layout")
    ->required()
    ->type_name("");
  command->add_option("--output", options->Output, "Folder to write to; made if need be")->required()->type_name("DIR");
  command
    ->add_option("--tolerance", options->Tolerance,
      "Mean relative error that sampled rough layers may have, in (0, 0.5]: sets the number\n"
      "of samples; default: 512 samples at roughness 1")
    ->check(InRange(0.0, 0.5, true))
    ->type_name("T");
  command
    ->add_option("--engine", options->Engine,
      "How layers are computed: spectral (default; layers below roughness 0.17, and all of a\n"
      "cube's, are sampled) or sampled")
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
