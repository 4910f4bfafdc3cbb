// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// RESULTS.md, of summaries alone.
#include "Benchmark.h"

#include <vtkVersion.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <fstream>
#include <set>

namespace vtkIBLBenchmark
{
namespace
{
std::string Format(const char* format, ...)
{
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof(text), format, arguments);
  va_end(arguments);
  return text;
}

std::string FormatPercent(double error)
{
  return error < 0 ? "-" : Format(error < 0.001 ? "%.4f" : error < 0.1 ? "%.2f" : "%.1f", 100 * error);
}

std::string FormatTime(const Timing& time)
{
  const auto digits = [](double ms) { return ms < 1 ? "%.3f" : ms < 100 ? "%.1f" : "%.0f"; };
  const auto one = [&](double seconds) { return Format(digits(1e3 * seconds), 1e3 * seconds); };
  return time.Count == 0 ? "-" : one(time.Median) + " (" + one(time.Low) + " … " + one(time.High) + ")";
}

std::string FormatCPU(const Timing& time)
{
  return time.Count == 0 ? "-" : Format(time.CPU < 0.1 ? "%.1f" : "%.0f", 1e3 * time.CPU);
}

/// Processor time as a share of that of VTK's lighting with its own settings: what other work on the machine moves
/// least.
std::string FormatShare(const Summary& summary, const std::vector<Summary>& summaries)
{
  for (const Summary& vtk : summaries)
  {
    if (vtk.Engine == "VTK" && vtk.Default && vtk.MeanError >= 0 && vtk.Time.Count > 0 && summary.Time.Count > 0)
    {
      return Format("%.2g", summary.Time.CPU / vtk.Time.CPU);
    }
  }
  return "-";
}

const Summary* FindDefault(const std::vector<Summary>& summaries, const std::string& engine)
{
  for (const Summary& s : summaries)
  {
    if (s.Engine == engine && s.Default)
    {
      return &s;
    }
  }
  return nullptr;
}

std::string FormatCount(long long count)
{
  return count < 0    ? "-"
    : count < 1000000 ? Format("%.3g k", double(count) / 1e3)
                      : Format("%.3g M", double(count) / 1e6);
}

// ---- RESULTS.md ----------------------------------------------------------------------------------------

const char* const Program = "build/release/bin/vtkIBLBenchmark";

void WriteCommand(std::ostream& out, const std::string& only)
{
  out << "Repeat: `" << Program << " --only '" << only << "' --output /tmp/benchmark`\n\n";
}

void WriteStageTable(std::ostream& out, const Session& session, const std::string& panel)
{
  out << "| engine | setting | error, mean % | median % | rel. RMSE % | wall ms (quartiles) | CPU ms | of VTK's | runs "
         "| fetches | "
         "bytes |\n|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  std::set<std::string> notes;
  const std::vector<Summary> summaries = Summarize(session, panel);
  for (const Summary& s : summaries)
  {
    out << "| " << s.Engine << " | " << s.Setting << " | " << FormatPercent(s.MeanError) << " | "
        << FormatPercent(s.MedianError) << " | " << FormatPercent(s.MeanRMSE) << " | " << FormatTime(s.Time) << " | "
        << FormatCPU(s.Time) << " | " << FormatShare(s, summaries) << " | " << s.Time.Count << " | "
        << FormatCount(s.Fetches) << " | " << FormatCount(s.Bytes) << " |\n";
    if (!s.Note.empty())
    {
      std::string note = s.Engine + ": " + s.Note;
      if (s.MeanErrorAsMade >= 0 && panel == "table")
      {
        note += ", and is then " + FormatPercent(s.MeanErrorAsMade) + " %";
      }
      notes.insert(note);
    }
  }
  out << "\n";
  for (const std::string& note : notes)
  {
    out << "- " << note << "\n";
  }
  out << "\n";
}

void WriteLayerTables(std::ostream& out, const Session& session)
{
  out << "As a shader reads them, at eight roughnesses; error in %, mean (median) over the maps. One time for all "
         "layers, "
         "out of checked pixels in memory. vtkIBL is told the error (at the worst roughness) that it may make, the "
         "others "
         "a number of samples.\n\n| engine | setting |";
  for (double roughness : JudgedRoughness)
  {
    out << Format(" %.2f |", roughness);
  }
  out << " wall ms (quartiles) | CPU ms | of VTK's | runs | fetches | bytes |\n|---|---|";
  for (std::size_t i = 0; i < JudgedRoughness.size() + 6; ++i)
  {
    out << "--:|";
  }
  out << "\n";
  const std::vector<Summary> summaries = Summarize(session, LayerPanel(JudgedRoughness.front()));
  for (const Summary& first : summaries)
  {
    out << "| " << first.Engine << " | " << first.Setting << " |";
    for (double roughness : JudgedRoughness)
    {
      for (const Summary& s : Summarize(session, LayerPanel(roughness)))
      {
        if (s.Engine == first.Engine && s.Setting == first.Setting)
        {
          out << " " << FormatPercent(s.MeanError) << " (" << FormatPercent(s.MedianError) << ") |";
        }
      }
    }
    out << " " << FormatTime(first.Time) << " | " << FormatCPU(first.Time) << " | " << FormatShare(first, summaries)
        << " | " << first.Time.Count << " | " << FormatCount(first.Fetches) << " | " << FormatCount(first.Bytes)
        << " |\n";
  }
  out << "\nThe filter alone: each layer at its own texels, against the roughness that it was made for; default "
         "settings. vtkIBL's at 64^2 texels of any roughness, before they are stored as what is read best. "
         "VTK makes its layers for mip/5, and its shader reads them as mip/4: what lies between this table and the one "
         "above is that and interpolation.\n\n| engine | roughness: error, mean % (median) |\n|---|---|\n";
  for (const Engine& engine : session.Engines)
  {
    std::string cells;
    std::vector<std::string> panels = GetPanels(session);
    std::sort(panels.begin(), panels.end()); // by roughness
    for (const std::string& panel : panels)
    {
      if (panel.rfind("filter ", 0) != 0)
      {
        continue;
      }
      for (const Summary& s : Summarize(session, panel))
      {
        if (s.Engine == engine.Name && s.Default)
        {
          cells += (cells.empty() ? "" : ", ") + panel.substr(7) + ": " + FormatPercent(s.MeanErrorAsMade) + " (" +
            FormatPercent(s.MedianErrorAsMade) + ")";
        }
      }
    }
    if (!cells.empty())
    {
      out << "| " << engine.Name << " | " << cells << " |\n";
    }
  }
  out << "\ncmgen's panorama lands half a texel right and down of where it is, and its cube is read without the half "
         "texel's shift; both are in its errors here. Without them, at 16384 samples, it agrees with the reference to "
         "0.4 % "
         "(tests/benchmarks).\n\n";
}

/// NaN where there is no such row, or it has no such number.
using Get = double (*)(const Summary&);
double GetSeconds(const Summary& s)
{
  return s.Time.Count > 0 ? s.Time.Median : std::nan("");
}
double GetRead(const Summary& s)
{
  return s.MeanError < 0 ? std::nan("") : s.MeanError;
}
double GetMade(const Summary& s)
{
  return s.MeanErrorAsMade < 0 ? std::nan("") : s.MeanErrorAsMade;
}
double Find(
  const Session& session, const std::string& panel, const std::string& engine, const std::string& setting, Get get)
{
  for (const Summary& s : Summarize(session, panel))
  {
    if (s.Engine == engine && s.Setting == setting)
    {
      return get(s);
    }
  }
  return std::nan("");
}

/// Of all panels "<kind> <roughness>" with roughness in [from, to]: the worst, or the mean.
double FindOverRoughness(const Session& session, const std::string& kind, const std::string& engine,
  const std::string& setting, Get get, double from, double to, bool worst)
{
  double result = 0;
  int count = 0;
  for (const std::string& panel : GetPanels(session))
  {
    const double roughness = panel.rfind(kind + " ", 0) == 0 ? std::stod(panel.substr(kind.size() + 1)) : -1;
    const double value =
      roughness >= from && roughness <= to ? Find(session, panel, engine, setting, get) : std::nan("");
    if (std::isfinite(value))
    {
      result = worst ? std::max(result, value) : result + value;
      ++count;
    }
  }
  return count == 0 ? std::nan("") : worst ? result : result / count;
}

void WriteTarget(std::ostream& out, const char* what, double bound, double measured, double scale, const char* unit,
  bool atLeast = false)
{
  out << "| " << what << " | " << (atLeast ? ">= " : "<= ") << Format("%g", scale * bound) << unit << " | ";
  if (std::isfinite(measured))
  {
    const double ratio = measured / bound;
    out << Format("%.3g", scale * measured) << unit << " | " << Format("%.2g", ratio) << " | "
        << ((atLeast ? ratio >= 1 : ratio <= 1) ? "yes" : "**no**");
  }
  else
  {
    out << "not run | - | -";
  }
  out << " |\n";
}

/// Mean over maps, roughness and materials.
double FindShading(const Session& session, const std::string& engine, const std::string& setting)
{
  double mean = 0;
  for (const ShadedMaterial& material : ShadedMaterials)
  {
    const std::string kind = std::string("shading ") + material.Name;
    mean += FindOverRoughness(session, kind, engine, setting, GetRead, 0, 1, false) / double(ShadedMaterials.size());
  }
  return mean;
}

void WriteShadingTable(std::ostream& out, const Session& session)
{
  out << "| engine | setting | f0 |";
  std::string line = "|---|---|--:|";
  for (double roughness : ShadedRoughness)
  {
    out << Format(" %.2f |", roughness);
    line += "--:|";
  }
  out << " mean | both | steady frame, wall ms |\n" << line << "--:|--:|--:|\n";
  const auto first = [](const ShadedMaterial& material) { return ShadingPanel(material, ShadedRoughness.front()); };
  for (const Summary& s : Summarize(session, first(ShadedMaterials.front())))
  {
    for (const ShadedMaterial& material : ShadedMaterials)
    {
      out << "| " << s.Engine << " | " << s.Setting << " | " << Format("%g", material.F0) << " |";
      double mean = 0;
      for (double roughness : ShadedRoughness)
      {
        for (const Summary& cell : Summarize(session, ShadingPanel(material, roughness)))
        {
          if (cell.Engine == s.Engine && cell.Setting == s.Setting)
          {
            out << " " << FormatPercent(cell.MeanError) << " (" << FormatPercent(cell.MedianError) << ") |";
            mean += cell.MeanError / double(ShadedRoughness.size());
          }
        }
      }
      out << " " << FormatPercent(mean) << " |";
      if (&material == &ShadedMaterials.front())
      {
        const double both = FindShading(session, s.Engine, s.Setting);
        const double seconds = Find(session, "steady frame", s.Engine, s.Setting, GetSeconds);
        out << " " << (std::isfinite(both) ? FormatPercent(both) : "-") << " | "
            << (std::isfinite(seconds) ? Format("%.1f", 1e3 * seconds) : "-") << " |\n";
      }
      else
      {
        out << " | |\n";
      }
    }
  }
  out << "\n";
}

/// What the project has set itself.
void WriteTargets(std::ostream& out, const Session& session)
{
  const std::string spectral = FormatSetting(0.02);
  const std::string sampled = FormatSetting(64);
  const auto filter = [&](double from)
  { return FindOverRoughness(session, "filter", "vtkIBL", spectral, GetMade, from - 1e-9, 1, true); };
  const auto taps = [&](double from, double to)
  { return FindOverRoughness(session, "filter", "vtkIBL sampled", sampled, GetMade, from, to, false); };
  const auto bake = [&](const char* engine, const std::string& setting, Get get)
  { return Find(session, "bake", engine, setting, get); };
  const auto first = [&](const char* engine, const char* setting)
  { return Find(session, "first frame", engine, setting, GetSeconds); };
  const double ours = bake("vtkIBL", spectral, GetSeconds);
  const double unlit = first("VTK", "PBR, no IBL");

  out << "| target | bound | measured | measured / bound | kept |\n|---|--:|--:|--:|--:|\n";
  WriteTarget(out, "filter alone, mean over the maps, worst roughness from 0.3 up", 0.0005, filter(0.3), 100, " %");
  WriteTarget(out, "the same from 0.2 up", 0.001, filter(0.2), 100, " %");
  WriteTarget(out, "the same from 0.1 up", 0.005, filter(0.1), 100, " %");
  WriteTarget(out, "as read, mean over the maps, worst judged roughness", 0.02,
    FindOverRoughness(session, "layer", "vtkIBL", spectral, GetRead, 0.0999, 1, true), 100, " %");
  WriteTarget(
    out, "VTK's own bake over ours, time", 100, bake("VTK", FormatSetting(512), GetSeconds) / ours, 1, "", true);
  WriteTarget(out, "cmgen's bake at 1024 samples over ours, time", 30,
    bake("cmgen", FormatSetting(1024), GetSeconds) / ours, 1, "", true);
  WriteTarget(out, "our error over cmgen's at 1024 samples", 0.1,
    bake("vtkIBL", spectral, GetRead) / bake("cmgen", FormatSetting(1024), GetRead), 1, "");
  WriteTarget(out, "layers of roughness 0.25 up, one thread", 0.010,
    Find(session, "threads", "vtkIBL", "layers, roughness 0.25 up, 1 thread", GetSeconds), 1e3, " ms");
  WriteTarget(out, "first frame, lit less PBR without IBL, pixels in memory", 0.15,
    first("vtkIBL", "spectral layers") - unlit, 1e3, " ms");
  WriteTarget(out, "the same, from the file, nothing cached", 0.15,
    first("vtkIBL", "spectral layers, from the file") - unlit, 1e3, " ms");
  WriteTarget(out, "the same, pixels in memory, Mesa's shaders not cached either", 0.15,
    first("vtkIBL", "spectral layers, cold") - first("VTK", "PBR, no IBL, cold"), 1e3, " ms");
  WriteTarget(out, "the same, from the file, its light cached", 0.05,
    first("vtkIBL", "spectral layers, cached") - unlit, 1e3, " ms");
  WriteTarget(out, "sampled engine, 64 samples, filter alone, layers above 0.4", 0.005, taps(0.4, 1), 100, " %");
  WriteTarget(out, "the same, layers below 0.4", 0.04, taps(0, 0.4), 100, " %");
  const auto frame = [&](const char* engine, const char* setting)
  { return Find(session, "steady frame", engine, setting, GetSeconds); };
  WriteTarget(out, "shading against the reflection integral, mean of all maps, roughnesses and both f0", 0.11,
    FindShading(session, "vtkIBL", "spectral layers, lamps in them"), 100, " %");
  WriteTarget(out, "the same with lamps as lights, as it is by default", 0.05,
    FindShading(session, "vtkIBL", "spectral layers"), 100, " %");
  WriteTarget(out, "the same, 1024 samples a pixel", 0.02,
    FindShading(session, "vtkIBL per pixel", "1024 samples a pixel"), 100, " %");
  WriteTarget(out, "the same, 16384 samples a pixel", 0.005,
    FindShading(session, "vtkIBL per pixel", "16384 samples a pixel"), 100, " %");
  WriteTarget(
    out, "steady frame over VTK's PBR + IBL", 1, frame("vtkIBL", "spectral layers") / frame("VTK", "PBR + IBL"), 1, "");
  WriteTarget(out, "steady frame over VTK's PBR without IBL", 1.3,
    frame("vtkIBL", "spectral layers") / frame("VTK", "PBR, no IBL"), 1, "");
  const auto probes = [&](const char* setting) { return Find(session, "probes", "vtkIBL", setting, GetSeconds); };
  WriteTarget(out, "frame with 8 probes at rest over one with 1", 1.25,
    probes("8 probes at rest") / probes("1 probe at rest"), 1, "");
  WriteTarget(out, "what a face that changes adds to a frame, cut up, over what six faces and all layers add at once",
    1.0 / 6,
    (probes("1 probe, one face changes, cut up") - probes("1 probe at rest")) /
      (probes("1 probe, every frame") - probes("1 probe at rest")),
    1, "");
  WriteTarget(out, "growth: slope of log(time) over log(source texels)", 1,
    FitSlope(Summarize(session, "growth source"), "vtkIBL") / 2, 1, "");
  out << "\n";
}

/// First frames less the one without image-based lighting.
void WriteLightCost(std::ostream& out, const Session& session)
{
  out << "What lighting adds: the first frame less that of \"PBR, no IBL\", of \"cold\" ones less the cold one.\n\n| "
         "engine | setting | ms |\n|---|---|--:|\n";
  for (const Summary& s : Summarize(session, "first frame"))
  {
    const bool cold = s.Setting.find(", cold") != std::string::npos;
    const double unlit = Find(session, "first frame", "VTK", cold ? "PBR, no IBL, cold" : "PBR, no IBL", GetSeconds);
    if (s.MeanError >= 0 && std::isfinite(unlit))
    {
      out << "| " << s.Engine << " | " << s.Setting << " | " << Format("%.0f", 1e3 * (s.Time.Median - unlit)) << " |\n";
    }
  }
  out << "\n";
}

void WriteGrowthTable(std::ostream& out, const Session& session, const std::string& panel, const char* size)
{
  const std::vector<Summary> summaries = Summarize(session, panel);
  out << "| engine | " << size << " | wall ms (quartiles) | CPU ms | runs |\n|---|---|--:|--:|--:|\n";
  for (const Summary& s : summaries)
  {
    out << "| " << s.Engine << " | " << s.Setting << " | " << FormatTime(s.Time) << " | " << FormatCPU(s.Time) << " | "
        << s.Time.Count << " |\n";
  }
  out << "\nSlopes of log(time) over log(" << size << "), least squares:";
  const char* separator = " ";
  for (const Engine& engine : session.Engines)
  {
    const double slope = FitSlope(summaries, engine.Name);
    if (std::isfinite(slope))
    {
      out << separator << engine.Name << " " << Format("%.2f", slope);
      separator = ", ";
    }
  }
  out << ". (1: time as the width, 2: as the area.)\n\n";
}

// By hand: valgrind takes half a minute, and no clock can be trusted in it. Count again when core/vtkIBLSpectrum
// changes.
const char* const InstructionsText =
  R"(569 million for courtyard, with AVX2, noted by hand from

    valgrind --tool=callgrind --toggle-collect='vtkIBLBenchmark::*CountSpectrum*' \
      build/release/bin/vtkIBLBenchmark --only spectrum --maps courtyard)";

const char* const OthersText =
  R"(Not measured here, and not on this machine's load: noted from runs of these programs by hand on the same eight maps
(relative RMSE, a stricter number than the L1 above), or published by their authors. They set a scale, no ratio should be
taken from them.

| engine | figure | source |
|---|---|---|
| three.js r187 | prefilter 2 … 3.7 s on SwiftShader; r = .106 .225 .368 .553 1: forest 1.4 1.1 1.3 .4 .2 %, city 9 10 8 3 1.4 %, studio .9 3 3 1.6 1.1 %, night 1.4 6.5 12 5 3 % | noted |
| glTF-IBL-Sampler, 1024 samples | 1 … 13 %, growing with roughness | noted |
| OCCT 7.6 | bake 1.3 s on llvmpipe; filter 5 … 6 % (L1, emulated) | noted |
| cmft | 12 … 26 s, Phong lobes | noted |
| F3D 1.3.1 | VTK's own code: whole process .55 s without, 4.3 s with an HDRI | noted |
| VTK 9.6 | first frame 7.6 s at 256 x 128, 20 s at 1024 x 512 | noted |
| VTK 9.1, `UseSphericalHarmonicsOff` | first frame 102 s | noted |
| VTK 9.1, larger sources | prefilter 37 s at 4096 x 2048, 160 s at 8192 x 4096 | noted |
| Manson & Sloan 2016, quadratic, 32 taps | 2.3 % (L1, 425 HDRIs, re-fitted by others), .73 ms on a GTX 980 at 128^2 | published |

)";

/// Every panel in which a peer's default setting is faster or closer than ours.
void WriteBehind(std::ostream& out, const Session& session)
{
  bool any = false;
  for (const std::string& panel : GetPanels(session))
  {
    if (panel.rfind("filter", 0) == 0 || panel == "function" || panel.rfind("growth", 0) == 0)
    {
      continue;
    }
    const std::vector<Summary> summaries = Summarize(session, panel);
    for (const char* name : { "vtkIBL", "vtkIBL sampled" })
    {
      const Summary* own = FindDefault(summaries, name);
      for (const Summary& peer : summaries)
      {
        const bool isPeer = peer.Default && peer.Engine.rfind("vtkIBL", 0) != 0 && peer.MeanError >= 0 &&
          peer.Setting.find("cold") == std::string::npos;
        if (!own || !isPeer || own->MeanError < 0 || peer.Time.Count == 0)
        {
          continue;
        }
        const bool slower = peer.Time.Median < 0.95 * own->Time.Median;
        const bool worse = peer.MeanError < 0.95 * own->MeanError;
        if (slower || worse)
        {
          out << "- **" << panel << "**: " << name << " is " << (slower ? "slower" : "")
              << (slower && worse ? " and " : "") << (worse ? "less exact" : "") << " than " << peer.Engine << " ("
              << peer.Setting << "): " << FormatTime(own->Time) << " ms at " << FormatPercent(own->MeanError)
              << " % against " << FormatTime(peer.Time) << " ms at " << FormatPercent(peer.MeanError) << " %.\n";
          any = true;
        }
      }
    }
  }
  out << (any ? "" : "- In no panel of this run is a peer's default faster or closer.\n");
  out
    << R"(- **Lights in the sharpest reflections** cost large layers: where a map has small lamps, the tolerated error takes
  256^2 faces, and four times the time of 128^2.
- **Cube environments** can't be filtered by the spectral engine: there the sampled one's figures hold.
- **Coefficients** of order 2 are no closer than VTK's or cmgen's: 9 of them are the row "exact". The map is.
- **Steady frames** cost two cube reads where VTK has one, and the energy term.
- A GPU was not measured: all times are llvmpipe's, where a texture read costs what arithmetic costs elsewhere.
)";
}

}

void WriteMarkdown(const Session& session)
{
  const Provenance provenance = GetProvenance();
  std::ofstream out(session.Options.Output + "/RESULTS.md");
  const Options& options = session.Options;
  out
    << "# Run time against error\n\n"
    << "Written by `vtkIBLBenchmark`; do not edit. The numbers behind it are in results.json.\n\n"
    << "- " << provenance.Date << ", commit " << provenance.Commit << ", VTK " << vtkVersion::GetVTKVersion() << "\n- "
    << session.Renderer << "; " << provenance.CPU << ", " << provenance.Threads << " threads; load average "
    << Format("%.1f", session.LoadAverage) << " when it began, " << Format("%.1f", GetLoadAverage())
    << " when it ended. Other work ran on the machine: compare times within a table, not with other machines.\n- Maps:";
  for (const std::string& map : options.Maps)
  {
    out << " " << map;
  }
  out
    << " (blender-data, CC0, 1024 x 512), cleaned of negative texels; every engine is given the same floats.\n- Judge: "
       "tests/reference, double precision, box reading of the panorama; it is proven on its own and agrees with cmgen "
       "and "
       "VTK where conventions meet (tests/benchmarks). Error = sum |x - reference| / sum reference over all channels "
       "of "
    << options.Directions
    << " directions (relative L1); relative RMSE beside it. Mean and median are over the maps: sun maps carry the "
       "mean.\n"
       "- Time: wall clock with glFinish, median and quartiles of all runs on all maps, warm-up apart; CPU is all "
       "threads' "
       "together. Shaders are compiled before the clock starts, but in \"first frame\". Timer queries say nothing on "
       "llvmpipe.\n- cmgen is a process of its own, with two threads; its layers' time is less what reading and the "
       "cube "
       "take (its run with one sample), its other times are whole processes.\n\n"
    << "All of it: `" << Program << " --output benchmarks`\n\n"
    << "![stages](plots/stages.png)\n![layers](plots/layers.png)\n![growth](plots/growth.png)\n\n";

  out << "## Targets\n\nWhat the project has set itself, and where it stands.\n\n";
  WriteTargets(out, session);
  out << "## 1. Stages\n\n### Cube map, 256^2 faces\n\n";
  WriteCommand(out, "cube");
  WriteStageTable(out, session, "cube");
  out << "### Irradiance\n\n";
  out
    << "vtkIBL's shading reads the map; coefficients are made on request. \"Bright texels\" are kept apart, as points: "
       "maps that have none are as without.\n\n";
  WriteCommand(out, "irradiance");
  WriteStageTable(out, session, "irradiance");
  out << "### Specular layers\n\n";
  WriteCommand(out, "layer");
  WriteLayerTables(out, session);
  out << "### BRDF table, against height-correlated Smith\n\n";
  WriteCommand(out, "table");
  WriteStageTable(out, session, "table");

  out << "## 2. Whole bake and first frame\n\nThe bake: from pixels in memory to all textures that a shader reads, "
         "upload "
         "and table included; vtkIBL checks the pixels, too, and keeps nothing from run to run. Error: the mean of the "
         "eight above. \"No mirror\": what surfaces of roughness 0.1 to 1 need; there is no cube map then.\n\n";
  WriteCommand(out, "bake");
  WriteStageTable(out, session, "bake");
  out << "By threads, the first map; no peer is held to fewer threads than it takes.\n\n";
  WriteCommand(out, "threads");
  WriteStageTable(out, session, "threads");
  out << "Instructions, from pixels to the stored texels of all layers, on one thread: " << InstructionsText << "\n\n";
  out << "First frame: the first Render() of a new process, its window made and its map (the first of the list) in "
         "memory; 98,124 triangles, "
         "512^2, white metal of roughness 0.4. Error: of the picture, against the full reflection integral of single "
         "scattering (so without our energy compensation), "
      << (options.Quick ? 24 : 96)
      << " pixels; the split sum's own error is in it. Mesa keeps compiled shaders on disk; \"cold\" is with that "
         "off. \"From the file\": the frame reads the EXR file as well, and VTKIBL_CACHE=off; \"cached\": it finds the "
         "light of an earlier process in vtkIBL's cache.\n\n";
  WriteCommand(out, "first frame");
  WriteStageTable(out, session, "first frame");
  WriteLightCost(out, session);

  out << "## 3. Shading\n\nWhat a sphere shows in parallel projection against the full reflection integral of single "
         "scattering (so without our energy compensation): a white metal, f0 = 1, and VTK's default dielectric, f0 = "
         "0.04, black below its specular lobe. "
      << (options.Quick ? 24 : 96)
      << " normals evenly over the disc out to N.V = 0.05, on flat tiles, so that no facet errs; error in %, mean "
         "(median) "
         "over the maps, by perceptual roughness. \"exact, plain split sum\": the reference's own prefilter along R "
         "times "
         "its own f0 A + B, so that what is off is the split sum itself.\n\n";
  WriteCommand(out, "shading");
  WriteShadingTable(out, session);
  out << "## 4. Steady frame\n\nThe same scene, every further frame.\n\n";
  WriteCommand(out, "steady frame");
  WriteStageTable(out, session, "steady frame");

  out
    << "## 5. Probes\n\nA frame of a hall of eight mirror-like balls, 99,840 triangles, and 24 pillars, 512^2; probes "
       "of 128^2 faces. What moves is a small sphere that one face of the first ball's probe sees.\n\n";
  WriteCommand(out, "probes");
  WriteStageTable(out, session, "probes");

  out << "## 6. Cost growth\n\nThe whole bake (cmgen: layers at 256 samples only) of "
      << (options.Maps.empty() ? std::string() : options.Maps.front())
      << ", resized. VTK is measured up to 2048 x 1024: larger takes minutes, and slow ones are repeated less (see "
         "runs).\n\n";
  WriteCommand(out, "growth source");
  WriteGrowthTable(out, session, "growth source", "source width");
  out << "vtkIBL's cube map and sharpest layer with that face. VTK's faces follow its source.\n\n";
  WriteCommand(out, "growth face");
  WriteGrowthTable(out, session, "growth face", "face edge");

  out << "## 7. On the CPU, before the GPU\n\nBy Google Benchmark; nothing to trade against error.\n\n";
  WriteCommand(out, "function");
  WriteStageTable(out, session, "function");

  out << "## 8. Others\n\n" << OthersText << "## Where we are behind\n\n";
  WriteBehind(out, session);
}

std::vector<std::string> CheckBounds(const Session& session)
{
  std::vector<std::string> misses;
  const std::vector<Summary> bakes = Summarize(session, "bake");
  const std::vector<Summary> tables = Summarize(session, "table");
  for (const Engine& engine : session.Engines)
  {
    const Summary* bake = FindDefault(bakes, engine.Name);
    if (bake && !(bake->MeanErrorAsMade < engine.LayerBound))
    {
      misses.push_back(engine.Name + ": layers are " + FormatPercent(bake->MeanErrorAsMade) +
        " % off, and should be within " + FormatPercent(engine.LayerBound) + " %");
    }
    if (bake && !(bake->MeanError < engine.ReadBound))
    {
      misses.push_back(engine.Name + ": what is read is " + FormatPercent(bake->MeanError) +
        " % off, and should be within " + FormatPercent(engine.ReadBound) + " %");
    }
    const Summary* table = FindDefault(tables, engine.Name);
    if (table && !(table->MeanError < engine.TableBound))
    {
      misses.push_back(engine.Name + ": the table is " + FormatPercent(table->MeanError) +
        " % off, and should be within " + FormatPercent(engine.TableBound) + " %");
    }
  }
  return misses;
}
}
