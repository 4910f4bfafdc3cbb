// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Rows summed up over the maps, and results.json.
#include "Benchmark.h"

#include <vtkVersion.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <set>
#include <stdexcept>
#include <thread>

namespace vtkIBLBenchmark
{
namespace
{
using Json = nlohmann::json;

double GetMean(const std::vector<double>& values)
{
  double sum = 0;
  for (double value : values)
  {
    sum += value / double(values.size());
  }
  return values.empty() ? -1 : sum;
}

double GetMedian(std::vector<double> values)
{
  if (values.empty())
  {
    return -1;
  }
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

std::string RunLine(const std::string& command)
{
  try
  {
    std::string output;
    RunProcess(command, &output);
    return output.substr(0, output.find('\n'));
  }
  catch (const std::exception&)
  {
    return "unknown";
  }
}

std::string GetCommit()
{
  return RunLine("git -C '" VTKIBL_SOURCE "' describe --always --dirty --exclude='*' 2>/dev/null");
}

std::string GetCPU()
{
  return RunLine("sed -n 's/^model name[^:]*: //p' /proc/cpuinfo");
}

std::string GetDate()
{
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%d", std::gmtime(&now));
  return text;
}

Json ToJson(const Timing& time)
{
  if (time.Count == 0)
  {
    return nullptr;
  }
  return { { "count", time.Count }, { "median", time.Median }, { "quartile1", time.Low }, { "quartile3", time.High },
    { "cpu", time.CPU } };
}

Json ToJson(const Session& session, const std::string& panel, const Summary& summary)
{
  Json errors = Json::object();
  Json asMade = Json::object();
  for (const Row& row : session.Rows)
  {
    if (row.Panel == panel && row.Engine == summary.Engine && row.Setting == summary.Setting)
    {
      const std::string map = row.Map.empty() ? "none" : row.Map;
      if (row.Error)
      {
        errors[map] = { { "relative_l1", row.Error->RelativeL1 }, { "relative_rmse", row.Error->RelativeRMSE } };
      }
      if (row.ErrorAsMade)
      {
        asMade[map] = { { "relative_l1", row.ErrorAsMade->RelativeL1 } };
      }
    }
  }
  return { { "panel", panel }, { "engine", summary.Engine }, { "setting", summary.Setting },
    { "default", summary.Default }, { "seconds", ToJson(summary.Time) }, { "error", errors },
    { "error_as_made", asMade }, { "size", summary.Size > 0 ? Json(summary.Size) : Json() },
    { "fetches", summary.Fetches >= 0 ? Json(summary.Fetches) : Json() },
    { "bytes", summary.Bytes >= 0 ? Json(summary.Bytes) : Json() }, { "note", summary.Note } };
}

}

void WriteJson(const Session& session)
{
  const Provenance provenance = GetProvenance();
  // One result a line: a later run's differences can be read.
  std::ofstream file(session.Options.Output + "/results.json");
  Json head = { { "schema", 1 }, { "date", provenance.Date }, { "commit", provenance.Commit },
    { "renderer", session.Renderer }, { "cpu", provenance.CPU }, { "threads", provenance.Threads },
    { "load", { session.LoadAverage, GetLoadAverage() } }, { "vtk", vtkVersion::GetVTKVersion() },
    { "quick", session.Options.Quick }, { "only", session.Options.Only }, { "maps", session.Options.Maps },
    { "directions", session.Options.Directions } };
  std::string text = head.dump();
  text.pop_back();
  file << text << ",\"results\":[";
  const char* separator = "\n";
  for (const std::string& panel : GetPanels(session))
  {
    for (const Summary& summary : Summarize(session, panel))
    {
      file << separator << ToJson(session, panel, summary).dump();
      separator = ",\n";
    }
  }
  file << "\n]}\n";
}

std::string CheckSchema(const std::string& fileName)
{
  std::ifstream file(fileName);
  const Json json = Json::parse(file, nullptr, false);
  if (!json.is_object() || json.value("schema", 0) != 1)
  {
    return "is no JSON object with schema 1";
  }
  for (const char* name : { "date", "commit", "renderer", "cpu", "vtk" })
  {
    if (!json.contains(name) || !json[name].is_string() || json[name].get<std::string>().empty())
    {
      return std::string("lacks the text ") + name;
    }
  }
  if (!json.contains("maps") || !json["maps"].is_array() || !json.contains("results") || !json["results"].is_array() ||
    json["results"].empty())
  {
    return "lacks maps or results";
  }
  std::set<std::string> panels;
  for (const Json& result : json["results"])
  {
    for (const char* name : { "panel", "engine", "setting", "default", "seconds", "error", "error_as_made", "size",
           "fetches", "bytes", "note" })
    {
      if (!result.contains(name))
      {
        return std::string("a result lacks ") + name + ": " + result.dump();
      }
    }
    panels.insert(result["panel"].get<std::string>());
    const Json& seconds = result["seconds"];
    if (!seconds.is_null() && (seconds.value("count", 0) < 1 || !(seconds.value("median", 0.0) > 0.0)))
    {
      return "a result took no time: " + result.dump();
    }
    for (const Json& error : result["error"])
    {
      const Json& l1 = error["relative_l1"]; // NaN is null in JSON
      if (!l1.is_number() || l1.get<double>() < 0.0)
      {
        return "an error is no number: " + result.dump();
      }
    }
  }
  if (json.value("only", std::string()).empty())
  {
    for (const char* panel :
      { "cube", "irradiance", "layer 0.10", "layer 1.00", "table", "bake", "threads", "shading metal 0.20",
        "shading dielectric 1.00", "first frame", "steady frame", "probes", "growth source", "growth face", "function" })
    {
      if (panels.count(panel) == 0)
      {
        return std::string("lacks the panel ") + panel;
      }
    }
  }
  return {};
}

/// All panels, in the order in which they came.
std::vector<std::string> GetPanels(const Session& session)
{
  std::vector<std::string> panels;
  for (const Row& row : session.Rows)
  {
    if (std::find(panels.begin(), panels.end(), row.Panel) == panels.end())
    {
      panels.push_back(row.Panel);
    }
  }
  return panels;
}

double GetLoadAverage()
{
  double load[1] = { 0 };
  getloadavg(load, 1);
  return load[0];
}

Provenance GetProvenance()
{
  return { GetDate(), GetCommit(), GetCPU(), static_cast<int>(std::thread::hardware_concurrency()) };
}

std::vector<Summary> Summarize(const Session& session, const std::string& panel)
{
  std::vector<Summary> summaries;
  std::vector<std::vector<const Row*>> groups;
  for (const Row& row : session.Rows)
  {
    if (row.Panel != panel)
    {
      continue;
    }
    std::size_t i = 0;
    while (i < summaries.size() && (summaries[i].Engine != row.Engine || summaries[i].Setting != row.Setting))
    {
      ++i;
    }
    if (i == summaries.size())
    {
      Summary summary;
      summary.Engine = row.Engine;
      summary.Setting = row.Setting;
      summary.Default = row.Default;
      summary.Size = row.Size;
      summary.Fetches = row.Fetches;
      summary.Bytes = row.Bytes;
      summary.Note = row.Note;
      summaries.push_back(summary);
      groups.emplace_back();
    }
    groups[i].push_back(&row);
  }
  for (std::size_t i = 0; i < summaries.size(); ++i)
  {
    std::vector<Sample> samples;
    std::vector<double> errors;
    std::vector<double> squares;
    std::vector<double> asMade;
    for (const Row* row : groups[i])
    {
      samples.insert(samples.end(), row->Samples.begin(), row->Samples.end());
      if (row->Error)
      {
        errors.push_back(row->Error->RelativeL1);
        squares.push_back(row->Error->RelativeRMSE);
      }
      if (row->ErrorAsMade)
      {
        asMade.push_back(row->ErrorAsMade->RelativeL1);
      }
    }
    summaries[i].Time = Summarize(samples);
    summaries[i].MeanError = GetMean(errors);
    summaries[i].MedianError = GetMedian(errors);
    summaries[i].MeanRMSE = GetMean(squares);
    summaries[i].MeanErrorAsMade = GetMean(asMade);
    summaries[i].MedianErrorAsMade = GetMedian(asMade);
  }
  return summaries;
}

double FitSlope(const std::vector<Summary>& summaries, const std::string& engine)
{
  double n = 0;
  double sx = 0;
  double sy = 0;
  double sxx = 0;
  double sxy = 0;
  for (const Summary& summary : summaries)
  {
    if (summary.Engine == engine && summary.Size > 0 && summary.Time.Median > 0)
    {
      const double x = std::log(summary.Size);
      const double y = std::log(summary.Time.Median);
      n += 1;
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
  }
  return n < 2 ? std::nan("") : (n * sxy - sx * sy) / (n * sxx - sx * sx);
}
}
