// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Run time against error: what the benchmark's files share. An engine is one struct of functions (MakeEngines lists
// them); a panel times each engine's work and has the double-precision reference judge what came out. Every time is a
// row, and Report.cxx and Plots.cxx know rows only.
#pragma once

#include "Reference.h"

#include "vtkIBLOffscreenWindow.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vtkIBLBenchmark
{
using vtkIBLReference::RGB;
using vtkIBLReference::SplitSum;
using vtkIBLReference::Vec3;

struct Options
{
  bool Quick = false;
  std::string Output = ".";
  std::vector<std::string> Maps; // names of blender-data's studio lights
  int Repeat = 10;               // runs behind a median, over all maps together
  std::string Only;              // panels whose name starts so; empty: all
  int Directions = 192;          // where layers and irradiance are judged
};

// ---- Time (BenchmarkSupport.cxx) -----------------------------------------------------------------------

/// What one run took [s]: wall clock, and processor time of all threads.
struct Sample
{
  double Wall = 0;
  double CPU = 0;
};

/// Runs `work`, which must leave nothing unfinished on the GPU.
Sample Clock(const std::function<void()>& work);

/// Runs `command` in a shell, as a process of its own; throws when it fails. `output`, if given: what it printed.
Sample RunProcess(const std::string& command, std::string* output = nullptr);

struct Timing
{
  int Count = 0;
  double Median = 0; // wall [s]
  double Low = 0;    // quartiles of wall
  double High = 0;
  double CPU = 0; // median
};
Timing Summarize(const std::vector<Sample>& samples);

/// `count` runs, fewer once `budget` seconds are spent, but at least `least`. Warm-up is the caller's.
std::vector<Sample> Repeat(const std::function<Sample()>& run, int count, double budget, int least = 3);

// ---- Error ---------------------------------------------------------------------------------------------

struct Error
{
  double RelativeL1 = 0;   // sum |x - reference| / sum |reference|, all directions and channels
  double RelativeRMSE = 0; // sqrt(sum (x - reference)^2 / sum reference^2)
};
Error Judge(const std::vector<RGB>& values, const std::vector<RGB>& truth);

/// What there is to report: one engine with one setting did one panel's work on one map.
struct Row
{
  Row(std::string panel, std::string engine, std::string setting, std::string map)
    : Panel(std::move(panel))
    , Engine(std::move(engine))
    , Setting(std::move(setting))
    , Map(std::move(map))
  {
  }
  std::string Panel; // "cube", "layer 0.40", "filter 0.300", "table", "bake", "shading metal 0.30", "first frame" …
  std::string Engine;
  std::string Setting; // "512 samples"
  std::string Map;     // empty where the work has no map
  std::vector<Sample> Samples;
  std::optional<vtkIBLBenchmark::Error> Error;
  /// The same layers judged at their own texels and the roughness they were made for: the filter alone, without what
  /// interpolation and a wrong label add.
  std::optional<vtkIBLBenchmark::Error> ErrorAsMade;
  double Size = 0;        // in growth panels: width of the source or edge of a face [texels]
  long long Fetches = -1; // texture reads, -1 where they can't be counted
  long long Bytes = -1;   // of what was made
  /// On the curve's default setting: the row that stands in RESULTS.md's tables.
  bool Default = false;
  std::string Note;
};

// ---- Input ---------------------------------------------------------------------------------------------

struct Map
{
  std::string Name;
  std::string File;
  vtkSmartPointer<vtkImageData> Image; // cleaned, linear float RGB, row 0 at the bottom: what every engine is given
  vtkIBLReference::Environment Reference;
};
/// Path of one of Debian's studio lights.
std::string GetMapFile(const std::string& name);
Map LoadMap(const std::string& name);
/// The map magnified by bilinear interpolation, or box-reduced.
vtkSmartPointer<vtkImageData> Resize(vtkImageData* panorama, int width);

/// `count` unit vectors spread evenly over the sphere (a Fibonacci lattice).
std::vector<Vec3> SpreadDirections(int count);
/// Reference values, kept on disk between runs.
std::vector<RGB> GetPrefilteredTruth(const Map& map, const std::vector<Vec3>& directions, double perceptualRoughness);
std::vector<RGB> GetIrradianceTruth(const Map& map, const std::vector<Vec3>& directions);

/// Roughness at which layers are judged as a shader reads them.
extern const std::vector<double> JudgedRoughness;
std::string LayerPanel(double perceptualRoughness);

/// What shading is judged by (BenchmarkShading.cxx).
struct ShadedMaterial
{
  const char* Name;
  double F0;
};
extern const std::vector<ShadedMaterial> ShadedMaterials;
extern const std::vector<double> ShadedRoughness;
std::string ShadingPanel(const ShadedMaterial& material, double perceptualRoughness);

// ---- Engines -------------------------------------------------------------------------------------------

struct Cube
{
  int Size = 0;
  std::vector<float> Texels; // RGB, faces in GL's order, row 0 at t = -1
  RGB At(int face, int i, int j) const;
};
struct Layer
{
  double PerceptualRoughness;
  Cube Texels;
};

/// Something an engine made, and how to make it again for the clock.
struct Work
{
  std::function<Sample()> Run;
  long long Fetches = -1;
  long long Bytes = -1;
};
struct CubeWork : Work
{
  Cube Result;
};
struct IrradianceWork : Work
{
  std::function<std::vector<RGB>(const std::vector<Vec3>&)> Read; // irradiance by normal
};
/// One way to keep irradiance.
struct IrradianceKind
{
  std::string Setting;
  std::function<IrradianceWork(const Map&)> Make;
};
struct LayersWork : Work
{
  std::vector<Layer> Layers; // as made; none where MakeFilter tells
  /// As the engine's shader reads them.
  std::function<std::vector<RGB>(const std::vector<Vec3>&, double perceptualRoughness)> Read;
};
struct TableWork : Work
{
  std::function<SplitSum(double NoV, double perceptualRoughness)> Read;
};

/// One engine. A function that is null: the engine has no such stage, and is not in that panel.
struct Engine
{
  std::string Name;
  /// The settings of its curve: samples a texel or, below 1, the tolerated error. The first is its default.
  std::vector<double> Settings;
  std::vector<int> TableSamples;
  /// It must not be worse than these, mean relative L1 of its layers with the default setting, as made and as read;
  /// what
  /// --quick tests.
  double LayerBound = 1;
  double ReadBound = 1;
  double TableBound = 1; // the same for the table
  std::function<CubeWork(const Map&, int faceSize)> MakeCube;
  std::vector<IrradianceKind> Irradiance; // the first is its default
  std::function<LayersWork(const Map&, double setting)> MakeLayers;
  /// The filter alone, where layers are stored as something else.
  std::function<std::vector<Layer>(const Map&)> MakeFilter;
  std::function<TableWork(int samples)> MakeTable;
  /// Everything from pixels in memory to what a shader reads; judged by its layers.
  std::function<Work(const Map&, double setting)> MakeBake;
  /// The same of what surfaces of roughness 0.1 to 1 read: no mirror.
  std::function<Work(const Map&, double setting)> MakeMirrorlessBake;
  /// The same for cost growth, nothing judged; `faceSize` 0: the engine's own choice. Null result: can't or won't.
  std::function<std::function<Sample()>(vtkImageData* panorama, int faceSize)> MakeGrowth;
  int LargestGrowthSource = 0; // widths and faces above take minutes; not run
  int LargestGrowthFace = 0;
};

struct Session
{
  vtkIBLBenchmark::Options Options;
  std::vector<Map> Maps;
  std::vector<Engine> Engines;
  std::vector<Row> Rows;
  std::string Renderer;
  double LoadAverage = 0;
  vtkNew<vtkIBLOffscreenWindow> Window;
  bool Wants(const std::string& panel) const;
  void Add(const Row& row); // prints it, too
};

/// "64 samples" or "tolerance 0.02".
std::string FormatSetting(double setting);

Engine MakeSpectral(Session& session); // BenchmarkOurs.cxx: vtkIBL's default
Engine MakeSampled(Session& session);  // its other one
Engine MakeVTK(Session& session);      // BenchmarkPeers.cxx
Engine MakeCmgen(Session& session);    // no functions where cmgen is not installed
bool HasCmgen();

// ---- Panels --------------------------------------------------------------------------------------------

void RunStages(Session& session);  // BenchmarkStages.cxx
void RunShading(Session& session); // BenchmarkShading.cxx
void RunFrames(Session& session);  // BenchmarkFrames.cxx
void RunProbes(Session& session);  // BenchmarkProbes.cxx
/// Renders one first frame and prints its seconds, and how often the disk had its light: the process that "first frame"
/// starts. `fromFile`: its light comes from the file, or the cache, within these seconds; else from pixels in memory.
int RunFirstFrame(const std::string& engine, const std::string& map, bool fromFile);
void RunGrowth(Session& session);    // BenchmarkGrowth.cxx
void RunThreads(Session& session);   // BenchmarkOurs.cxx
void RunFunctions(Session& session); // BenchmarkFunctions.cxx
/// Harmonics of a map and the layers of a ladder, once, on this thread: what an instruction counter is run on.
int RunSpectrum(const std::string& map);

// ---- Report --------------------------------------------------------------------------------------------

/// What the rows of one engine, panel and setting come to over all maps.
struct Summary
{
  std::string Engine;
  std::string Setting;
  bool Default = false;
  Timing Time;
  double MeanError = -1; // relative L1; -1: not judged
  double MedianError = -1;
  double MeanRMSE = -1;
  double MeanErrorAsMade = -1;
  double MedianErrorAsMade = -1;
  double Size = 0;
  long long Fetches = -1;
  long long Bytes = -1;
  std::string Note;
};
std::vector<Summary> Summarize(const Session& session, const std::string& panel);
/// Slope of log(time) over log(size) by least squares; NaN of fewer than two.
double FitSlope(const std::vector<Summary>& summaries, const std::string& engine);

/// All panels, in the order in which they came.
std::vector<std::string> GetPanels(const Session& session);

/// What a number is worth nothing without; "unknown" where it can't be told.
struct Provenance
{
  std::string Date;
  std::string Commit;
  std::string CPU;
  int Threads = 0;
};
Provenance GetProvenance();
/// Processes that ran or waited to, over the last minute.
double GetLoadAverage();

/// results.json in the output folder; Results.cxx, as all of the above.
void WriteJson(const Session& session);
/// RESULTS.md there; Report.cxx.
void WriteMarkdown(const Session& session);
/// What results.json lacks or has wrong, in a sentence; empty when it is sound.
std::string CheckSchema(const std::string& file);
/// Engines that miss their bounds, in sentences.
std::vector<std::string> CheckBounds(const Session& session);
/// plots/*.png and *.svg in the output folder; Plots.cxx.
void WritePlots(Session& session);

// ---- GL ------------------------------------------------------------------------------------------------

/// What `textureLod` gives for a cube map at each direction, seamless and trilinear.
std::vector<RGB> ReadCubeMap(
  vtkOpenGLRenderWindow* window, unsigned int texture, const std::vector<Vec3>& directions, double level);
/// One level of a cube map.
Cube ReadCubeLevel(unsigned int texture, int level);
}
