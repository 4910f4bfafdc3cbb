// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// One panel a stage: cube, harmonics, layers, table, whole bake.
#include "Benchmark.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace reference = vtkIBLReference;

namespace vtkIBLBenchmark
{
namespace
{
constexpr double Budget = 6; // seconds of repetition a point and map; a count below the wanted one stands in the row

/// A map's share of the wanted repetitions: all maps are alike in size, and go into one median. Making the work was the
/// warm-up.
std::vector<Sample> Time(const Session& session, const Map& map, const Work& work)
{
  const int maps = int(session.Maps.size());
  const int index = int(&map - session.Maps.data());
  const int count = session.Options.Repeat / maps + (index < session.Options.Repeat % maps ? 1 : 0);
  return Repeat(work.Run, std::max(count, 1), Budget, 1);
}

/// Texels of a cube, spread by a stride that shares no factor with its edge.
std::vector<std::size_t> SpreadTexels(int size, int count)
{
  const std::size_t all = std::size_t(6) * size * size;
  const std::size_t stride = std::max<std::size_t>(all / count, 1) | 1;
  std::vector<std::size_t> texels;
  for (std::size_t i = 0; i < all; i += stride)
  {
    texels.push_back(i);
  }
  return texels;
}

Error JudgeLayer(const Session& session, const Map& map, const Layer& layer)
{
  const int n = layer.Texels.Size;
  std::vector<Vec3> directions;
  std::vector<RGB> values;
  for (std::size_t texel : SpreadTexels(n, session.Options.Directions))
  {
    const int i = int(texel % n);
    const int j = int(texel / n % n);
    const int face = int(texel / n / n);
    directions.push_back(reference::CubeDirection(face, 2 * (i + 0.5) / n - 1, 2 * (j + 0.5) / n - 1));
    values.push_back(layer.Texels.At(face, i, j));
  }
  return Judge(values, GetPrefilteredTruth(map, directions, layer.PerceptualRoughness));
}

void RunCube(Session& session, const Engine& engine, const Map& map)
{
  const int faceSize = 256;
  const CubeWork work = engine.MakeCube(map, faceSize);
  std::vector<RGB> values;
  const std::vector<std::size_t> texels = SpreadTexels(faceSize, 4 * session.Options.Directions);
  for (std::size_t texel : texels)
  {
    values.push_back(
      work.Result.At(int(texel / faceSize / faceSize), int(texel % faceSize), int(texel / faceSize % faceSize)));
  }
  const auto truth =
    reference::Cached<RGB>("benchmark cube " + std::to_string(texels.size()) + reference::KeyOf(map.Reference),
      [&]
      {
        std::vector<RGB> means(texels.size());
        reference::ParallelFor(int(texels.size()),
          [&](int t)
          {
            const std::size_t texel = texels[t];
            means[t] = reference::CubeTexelAverage(map.Reference, faceSize, int(texel / faceSize / faceSize),
              int(texel % faceSize), int(texel / faceSize % faceSize));
          });
        return means;
      });
  Row row("cube", engine.Name, std::to_string(faceSize) + "^2 faces", map.Name);
  row.Error = Judge(values, truth);
  row.Samples = Time(session, map, work);
  row.Fetches = work.Fetches;
  row.Bytes = work.Bytes;
  row.Default = true;
  session.Add(row);
}

void RunIrradiance(Session& session, const Engine& engine, const Map& map)
{
  const std::vector<Vec3> normals = SpreadDirections(session.Options.Directions);
  for (const IrradianceKind& kind : engine.Irradiance)
  {
    const IrradianceWork work = kind.Make(map);
    Row row("irradiance", engine.Name, kind.Setting, map.Name);
    row.Error = Judge(work.Read(normals), GetIrradianceTruth(map, normals));
    row.Samples = Time(session, map, work);
    row.Fetches = work.Fetches;
    row.Bytes = work.Bytes;
    row.Default = &kind == &engine.Irradiance.front();
    session.Add(row);
  }
}

/// What nine exact coefficients leave: the floor of that panel.
void RunExactHarmonics(Session& session, const Map& map)
{
  const auto coefficients = reference::Cached<RGB>("benchmark harmonics " + reference::KeyOf(map.Reference),
    [&] { return reference::HarmonicCoefficients(map.Reference, 2); });
  const std::vector<Vec3> normals = SpreadDirections(session.Options.Directions);
  const double cosine[9] = { reference::Pi, 2 * reference::Pi / 3, 2 * reference::Pi / 3, 2 * reference::Pi / 3,
    reference::Pi / 4, reference::Pi / 4, reference::Pi / 4, reference::Pi / 4, reference::Pi / 4 };
  std::vector<RGB> values;
  for (const Vec3& normal : normals)
  {
    const std::vector<double> basis = reference::HarmonicBasis(2, normal);
    RGB rgb{ 0, 0, 0 };
    for (int i = 0; i < 9; ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        rgb[k] += cosine[i] * coefficients[i][k] * basis[i];
      }
    }
    values.push_back({ std::max(rgb[0], 0.0), std::max(rgb[1], 0.0), std::max(rgb[2], 0.0) });
  }
  Row row("irradiance", "exact", "9 coefficients", map.Name);
  row.Error = Judge(values, GetIrradianceTruth(map, normals));
  row.Note = "the floor of nine coefficients: the reference's own";
  session.Add(row);
}

void AddFilterRows(Session& session, const Engine& engine, const Map& map, double setting,
  const std::vector<Layer>& layers, double& mean)
{
  for (const Layer& layer : layers)
  {
    char panel[48];
    std::snprintf(panel, sizeof(panel), "filter %.3f", layer.PerceptualRoughness);
    Row row(panel, engine.Name, FormatSetting(setting), map.Name);
    row.ErrorAsMade = JudgeLayer(session, map, layer);
    row.Default = setting == engine.Settings.front();
    mean += row.ErrorAsMade->RelativeL1 / double(layers.size());
    session.Add(row);
  }
}

/// All layer panels and the bake: what is read at each judged roughness, and what the filter itself made.
void RunLayers(Session& session, const Engine& engine, const Map& map, double setting)
{
  const std::vector<Vec3> directions = SpreadDirections(session.Options.Directions);
  const LayersWork work = engine.MakeLayers(map, setting);
  const bool isDefault = setting == engine.Settings.front();
  double asMade = 0;
  const std::vector<Layer> filtered = engine.MakeFilter && isDefault ? engine.MakeFilter(map) : work.Layers;
  AddFilterRows(session, engine, map, setting, filtered, asMade);

  Error whole;
  // One time for all layers: no engine makes one without the others in a whole bake.
  const std::vector<Sample> time = Time(session, map, work);
  for (double roughness : JudgedRoughness)
  {
    Row row(LayerPanel(roughness), engine.Name, FormatSetting(setting), map.Name);
    row.Samples = time;
    row.Error = Judge(work.Read(directions, roughness), GetPrefilteredTruth(map, directions, roughness));
    row.Fetches = work.Fetches;
    row.Bytes = work.Bytes;
    row.Default = isDefault;
    session.Add(row);
    whole.RelativeL1 += row.Error->RelativeL1 / double(JudgedRoughness.size());
    whole.RelativeRMSE += row.Error->RelativeRMSE / double(JudgedRoughness.size());
  }
  const auto runBake = [&](const Work& bake, const std::string& what, bool isDefaultRow)
  {
    Row row("bake", engine.Name, FormatSetting(setting) + what, map.Name);
    row.Error = whole;
    if (!filtered.empty())
    {
      row.ErrorAsMade = Error{ asMade, 0 };
    }
    row.Samples = Time(session, map, bake);
    row.Fetches = bake.Fetches;
    row.Bytes = bake.Bytes;
    row.Default = isDefaultRow;
    session.Add(row);
  };
  if (engine.MakeBake && session.Wants("bake"))
  {
    runBake(engine.MakeBake(map, setting), "", isDefault);
    if (engine.MakeMirrorlessBake && isDefault)
    {
      runBake(engine.MakeMirrorlessBake(map, setting), ", no mirror", false);
    }
  }
}

/// Where tables are read: between the texels of all of them, from grazing to normal.
Error JudgeTable(const TableWork& work, reference::Geometry geometry)
{
  std::vector<std::pair<double, double>> points;
  for (int i = 0; i < 16; ++i)
  {
    for (int j = 0; j < 16; ++j)
    {
      points.emplace_back((i + 0.5) / 16, (j + 0.75) / 16);
    }
  }
  const auto truth = reference::Cached<SplitSum>("benchmark table 16 " + std::to_string(int(geometry)),
    [&]
    {
      std::vector<SplitSum> sums(points.size());
      reference::ParallelFor(int(points.size()),
        [&](int p) { sums[p] = reference::SplitSumAB(points[p].first, points[p].second, geometry); });
      return sums;
    });
  std::vector<RGB> values;
  std::vector<RGB> truths;
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    const SplitSum sum = work.Read(points[p].first, points[p].second);
    values.push_back({ sum.A, sum.B, 0 });
    truths.push_back({ truth[p].A, truth[p].B, 0 });
  }
  return Judge(values, truths);
}

void RunTable(Session& session, const Engine& engine)
{
  for (int samples : engine.TableSamples)
  {
    const TableWork work = engine.MakeTable(samples);
    Row row("table", engine.Name, samples > 0 ? FormatSetting(samples) : "constant", "");
    row.Error = JudgeTable(work, reference::Geometry::SmithCorrelated);
    const Error own = JudgeTable(work, reference::Geometry::SchlickSmith);
    if (own.RelativeL1 < row.Error->RelativeL1)
    {
      row.ErrorAsMade = own;
      row.Note = "made for Schlick's geometry term, k = alpha/2; \"as made\" is judged against that";
    }
    row.Samples = Repeat(work.Run, session.Options.Repeat, session.Options.Quick ? 1 : Budget);
    row.Bytes = work.Bytes;
    row.Default = samples == engine.TableSamples.front();
    session.Add(row);
  }
}
}

void RunStages(Session& session)
{
  for (const Engine& engine : session.Engines)
  {
    if (engine.MakeTable && session.Wants("table"))
    {
      RunTable(session, engine);
    }
  }
  for (const Map& map : session.Maps)
  {
    if (session.Wants("irradiance"))
    {
      RunExactHarmonics(session, map);
    }
    for (const Engine& engine : session.Engines)
    {
      if (engine.MakeCube && session.Wants("cube"))
      {
        RunCube(session, engine, map);
      }
      if (session.Wants("irradiance"))
      {
        RunIrradiance(session, engine, map);
      }
      const bool layers = session.Wants("bake") || session.Wants("filter") ||
        std::any_of(JudgedRoughness.begin(), JudgedRoughness.end(),
          [&](double roughness) { return session.Wants(LayerPanel(roughness)); });
      for (double setting : engine.Settings)
      {
        if (engine.MakeLayers && layers)
        {
          RunLayers(session, engine, map, setting);
        }
      }
    }
  }
}
}
