// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// How far shading is from the full reflection integral: what a sphere shows in parallel projection, pixel by pixel.
#include "BenchmarkScene.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>

namespace reference = vtkIBLReference;

namespace vtkIBLBenchmark
{
const std::vector<double> ShadedRoughness = { 0.2, 0.3, 0.45, 0.6, 0.8, 1.0 };
const std::vector<ShadedMaterial> ShadedMaterials = {
  { "metal", 1.0 }, // white
  { "dielectric",
    0.04 }, // VTK's index of refraction by default, 1.5; black below, so that only the specular lobe shows
};

std::string ShadingPanel(const ShadedMaterial& material, double perceptualRoughness)
{
  char text[64];
  std::snprintf(text, sizeof(text), "shading %s %.2f", material.Name, perceptualRoughness);
  return text;
}

namespace
{
constexpr int TilePixels = 2; // a side: what a GPU shades together has one normal
constexpr Vec3 View = { 0, 0, 1 };

/// A unit sphere's normals at places spread evenly over its disc, a Fibonacci spiral out to N.V = 0.05: the weight of a
/// direction is what a picture of a sphere gives it, NoV dNoV.
std::vector<Vec3> SpreadNormals(int count)
{
  std::vector<Vec3> normals;
  for (int i = 0; i < count; ++i)
  {
    const double square = (i + 0.5) / count * (1 - 0.05 * 0.05);
    const double angle = reference::Pi * (3 - std::sqrt(5.0)) * i;
    normals.push_back(
      { std::sqrt(square) * std::cos(angle), std::sqrt(square) * std::sin(angle), std::sqrt(1 - square) });
  }
  return normals;
}

/// A flat square a normal, side by side in rows: all of a pixel has the normal that is asked for, and no facet is
/// between it and the sphere.
class Tiles : public Scene
{
public:
  Tiles(const FrameEngine& engine, const Map& map, const std::vector<Vec3>& normals)
    : Scene(engine, map, MakeTiles(normals), TilePixels * GetEdge(normals), TilePixels * GetEdge(normals))
    , Edge(GetEdge(normals))
  {
    vtkCamera* camera = this->GetCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(0.5 * this->Edge);
    camera->SetFocalPoint(0.5 * this->Edge, 0.5 * this->Edge, 0);
    camera->SetPosition(0.5 * this->Edge, 0.5 * this->Edge, 1e5); // far, for VTK takes every eye for a perspective one
    camera->SetViewUp(0, 1, 0);
    camera->SetClippingRange(0.9e5, 1.1e5);
  }

  std::vector<RGB> Shade(const ShadedMaterial& material, double perceptualRoughness, std::size_t count)
  {
    const bool metal = material.F0 == 1.0;
    this->GetProperty()->SetMetallic(metal);
    this->GetProperty()->SetColor(metal, metal, metal);
    this->GetProperty()->SetRoughness(perceptualRoughness);
    vtkSmartPointer<vtkImageData> picture = this->Capture();
    std::vector<RGB> values;
    for (int i = 0; i < int(count); ++i)
    {
      const auto* rgba = static_cast<const float*>(
        picture->GetScalarPointer(TilePixels * (i % this->Edge), TilePixels * (i / this->Edge), 0));
      values.push_back({ rgba[0], rgba[1], rgba[2] });
    }
    return values;
  }

private:
  static int GetEdge(const std::vector<Vec3>& normals) { return int(std::ceil(std::sqrt(double(normals.size())))); }
  static vtkSmartPointer<vtkPolyData> MakeTiles(const std::vector<Vec3>& normals)
  {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> squares;
    vtkNew<vtkFloatArray> directions;
    directions->SetNumberOfComponents(3);
    for (int i = 0; i < int(normals.size()); ++i)
    {
      const Vec3& n = normals[i];
      const double x = i % GetEdge(normals);
      const double y = i / GetEdge(normals);
      squares->InsertNextCell({ 4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3 });
      for (const auto& corner : { std::pair(x, y), { x + 1, y }, { x + 1, y + 1 }, { x, y + 1 } })
      {
        points->InsertNextPoint(corner.first, corner.second, 0);
        directions->InsertNextTuple3(n.x, n.y, n.z);
      }
    }
    auto tiles = vtkSmartPointer<vtkPolyData>::New();
    tiles->SetPoints(points);
    tiles->SetPolys(squares);
    tiles->GetPointData()->SetNormals(directions);
    return tiles;
  }
  int Edge;
};

/// All materials' reflection integrals from one pass.
std::vector<reference::ReflectedParts> GetTruth(
  const Map& map, const std::vector<Vec3>& normals, double perceptualRoughness)
{
  return reference::Cached<reference::ReflectedParts>("benchmark shading " + std::to_string(perceptualRoughness) +
      reference::KeyOf(map.Reference) + reference::KeyOf(normals),
    [&] { return reference::FullBRDFPartsAll(map.Reference, normals, View, perceptualRoughness); });
}

/// The split sum with no error of its own: the prefiltered radiance along R, times f0 A + B.
std::vector<RGB> GetSplitSum(
  const Map& map, const std::vector<Vec3>& normals, double perceptualRoughness, const ShadedMaterial& material)
{
  const auto sums =
    reference::Cached<SplitSum>("benchmark A and B " + std::to_string(perceptualRoughness) + reference::KeyOf(normals),
      [&]
      {
        std::vector<SplitSum> ab(normals.size());
        reference::ParallelFor(
          int(normals.size()), [&](int i) { ab[i] = reference::SplitSumAB(normals[i].z, perceptualRoughness); });
        return ab;
      });
  std::vector<Vec3> mirrored;
  for (const Vec3& n : normals)
  {
    mirrored.push_back(2 * n.z * n - View);
  }
  std::vector<RGB> values = GetPrefilteredTruth(map, mirrored, perceptualRoughness);
  for (std::size_t i = 0; i < normals.size(); ++i)
  {
    for (double& channel : values[i])
    {
      channel *= material.F0 * sums[i].A + sums[i].B;
    }
  }
  return values;
}

/// A material of one roughness, and what it should show.
struct Panel
{
  const ShadedMaterial* Material;
  double Roughness;
  std::vector<RGB> Truth;
};

std::vector<Panel> GetPanels(const Session& session, const Map& map, const std::vector<Vec3>& normals)
{
  std::vector<Panel> panels;
  for (double roughness : ShadedRoughness)
  {
    for (const ShadedMaterial& material : ShadedMaterials)
    {
      if (session.Wants(ShadingPanel(material, roughness)))
      {
        panels.push_back({ &material, roughness, {} });
        const RGB f0 = { material.F0, material.F0, material.F0 };
        for (const reference::ReflectedParts& parts : GetTruth(map, normals, roughness))
        {
          panels.back().Truth.push_back(parts.Combine(f0, { 1, 1, 1 }, { 0, 0, 0 }));
        }
      }
    }
  }
  return panels;
}

void AddRow(Session& session, const Panel& panel, const char* engine, const char* setting, const Map& map,
  const std::vector<RGB>& values)
{
  Row row(ShadingPanel(*panel.Material, panel.Roughness), engine, setting, map.Name);
  row.Error = Judge(values, panel.Truth);
  row.Default = true;
  session.Add(row);
}
}

void RunShading(Session& session)
{
  const std::vector<Vec3> normals = SpreadNormals(session.Options.Quick ? 24 : 96);
  for (const Map& map : session.Maps)
  {
    const std::vector<Panel> panels = GetPanels(session, map, normals);
    for (const Panel& panel : panels)
    {
      AddRow(
        session, panel, "exact", "plain split sum", map, GetSplitSum(map, normals, panel.Roughness, *panel.Material));
    }
    for (const FrameEngine& engine : FrameEngines)
    {
      if (!panels.empty() && engine.IsLit() && (!session.Options.Quick || engine.SamplesPerPixel <= 1024))
      {
        Tiles tiles(engine, map, normals);
        for (const Panel& panel : panels)
        {
          AddRow(session, panel, engine.Name, engine.Setting, map,
            tiles.Shade(*panel.Material, panel.Roughness, normals.size()));
        }
      }
    }
  }
}
}
