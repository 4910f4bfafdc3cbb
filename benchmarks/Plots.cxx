// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Error against time by VTK's own charts: one curve an engine, one panel a stage; PNG and SVG.
#include "Benchmark.h"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartMatrix.h>
#include <vtkChartXY.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkPNGWriter.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkRenderer.h>
#include <vtkSVGExporter.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>

namespace vtkIBLBenchmark
{
namespace
{
struct Curve
{
  std::string Engine;
  std::vector<std::pair<double, double>> Points;
};

struct Style
{
  const char* Engine;
  unsigned char Color[3];
  int Marker;
};
// Told apart by shape as well as by colour (Okabe & Ito's, made for colour-blind eyes).
const Style Styles[] = { { "vtkIBL", { 0, 114, 178 }, vtkPlotPoints::CIRCLE },
  { "vtkIBL sampled", { 0, 158, 115 }, vtkPlotPoints::DIAMOND }, { "VTK", { 213, 94, 0 }, vtkPlotPoints::SQUARE },
  { "vtkIBL per pixel", { 86, 180, 233 }, vtkPlotPoints::PLUS }, { "cmgen", { 204, 121, 167 }, vtkPlotPoints::CROSS } };

const Style& FindStyle(const std::string& engine)
{
  for (const Style& style : Styles)
  {
    if (engine == style.Engine)
    {
      return style;
    }
  }
  return Styles[0];
}

/// (ms, %) of each setting, from fast to slow.
std::vector<Curve> GetErrorCurves(const Session& session, const std::string& panel)
{
  std::vector<Curve> curves;
  for (const Style& style : Styles)
  {
    Curve curve{ style.Engine, {} };
    for (const Summary& s : Summarize(session, panel))
    {
      if (s.Engine == style.Engine && s.Time.Count > 0 && s.MeanError > 0)
      {
        curve.Points.emplace_back(1e3 * s.Time.Median, 100 * s.MeanError);
      }
    }
    std::sort(curve.Points.begin(), curve.Points.end());
    if (!curve.Points.empty())
    {
      curves.push_back(curve);
    }
  }
  return curves;
}

/// (size, ms) of each size, the slope in the name.
std::vector<Curve> GetGrowthCurves(const Session& session, const std::string& panel)
{
  std::vector<Curve> curves;
  const std::vector<Summary> summaries = Summarize(session, panel);
  for (const Style& style : Styles)
  {
    Curve curve{ style.Engine, {} };
    for (const Summary& s : summaries)
    {
      if (s.Engine == style.Engine)
      {
        curve.Points.emplace_back(s.Size, 1e3 * s.Time.Median);
      }
    }
    if (!curve.Points.empty())
    {
      curves.push_back(curve);
    }
  }
  return curves;
}

std::string FormatTick(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%g", value);
  return text;
}

/// Ticks at 1, and where there is room at 2 and 5, of every decade; or at the powers of two.
void SetLogAxis(vtkAxis* axis, const std::string& title, double low, double high, bool powersOfTwo)
{
  low /= 1.3;
  high *= 1.3;
  vtkNew<vtkDoubleArray> places;
  vtkNew<vtkStringArray> labels;
  const bool fine = high / low < 300;
  if (powersOfTwo)
  {
    for (double value = 64; value <= high; value *= 2)
    {
      if (value >= low)
      {
        places->InsertNextValue(std::log10(value));
        labels->InsertNextValue(FormatTick(value));
      }
    }
  }
  else
  {
    low = std::min(low, high / 12);
    for (int decade = -6; decade < 9; ++decade)
    {
      for (double step : { 1.0, 2.0, 5.0 })
      {
        const double value = step * std::pow(10, decade);
        if (value >= low && value <= high && (fine || step == 1.0))
        {
          places->InsertNextValue(std::log10(value));
          labels->InsertNextValue(FormatTick(value));
        }
      }
    }
  }
  axis->SetTitle(title);
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(std::log10(low), std::log10(high));
  axis->SetCustomTickPositions(places, labels);
  axis->GetTitleProperties()->SetFontSize(14);
  axis->GetTitleProperties()->SetBold(0);
  axis->GetLabelProperties()->SetFontSize(12);
  axis->GetGridPen()->SetColor(225, 225, 225);
}

/// Both axes logarithmic: the logarithms are plotted, and the ticks say what they stand for.
void FillChart(vtkChartXY* chart, const std::string& title, const std::vector<Curve>& curves, const std::string& xTitle,
  const std::string& yTitle, bool powersOfTwo, bool legend)
{
  double low[2] = { 1e30, 1e30 };
  double high[2] = { 0, 0 };
  for (const Curve& curve : curves)
  {
    for (const auto& [x, y] : curve.Points)
    {
      low[0] = std::min(low[0], x);
      low[1] = std::min(low[1], y);
      high[0] = std::max(high[0], x);
      high[1] = std::max(high[1], y);
    }
  }
  chart->SetTitle(title);
  chart->GetTitleProperties()->SetFontSize(17);
  if (curves.empty())
  {
    return;
  }
  if (legend)
  {
    high[1] *= std::max(3.0, std::pow(high[1] / low[1], 0.4)); // room above the curves
  }
  SetLogAxis(chart->GetAxis(vtkAxis::BOTTOM), xTitle, low[0], high[0], powersOfTwo);
  SetLogAxis(chart->GetAxis(vtkAxis::LEFT), yTitle, low[1], high[1], false);
  for (const Curve& curve : curves)
  {
    vtkNew<vtkTable> table;
    vtkNew<vtkDoubleArray> xs;
    vtkNew<vtkDoubleArray> ys;
    xs->SetName("x");
    ys->SetName(curve.Engine.c_str());
    for (const auto& [x, y] : curve.Points)
    {
      xs->InsertNextValue(std::log10(x));
      ys->InsertNextValue(std::log10(y));
    }
    table->AddColumn(xs);
    table->AddColumn(ys);
    const Style& style = FindStyle(curve.Engine);
    const bool single = curve.Points.size() == 1;
    auto* plot = vtkPlotPoints::SafeDownCast(chart->AddPlot(single ? vtkChart::POINTS : vtkChart::LINE));
    plot->SetInputData(table, 0, 1);
    plot->SetColor(style.Color[0], style.Color[1], style.Color[2], 255);
    plot->SetWidth(2);
    plot->SetMarkerStyle(style.Marker);
    plot->SetMarkerSize(style.Marker < vtkPlotPoints::SQUARE ? 15 : 11); // a cross is but lines
  }
  chart->SetShowLegend(legend);
  if (legend)
  {
    chart->GetLegend()->SetLabelSize(14);
    chart->GetLegend()->SetHorizontalAlignment(vtkChartLegend::RIGHT);
    chart->GetLegend()->SetVerticalAlignment(vtkChartLegend::TOP);
  }
}

class Figure
{
public:
  Figure(int columns, int rows)
    : Rows(rows)
  {
    this->Window->SetSize(480 * columns, 380 * rows);
    this->View->SetRenderWindow(this->Window);
    this->View->GetRenderer()->SetBackground(1, 1, 1);
    this->Matrix->SetSize(vtkVector2i(columns, rows));
    this->Matrix->SetGutter(vtkVector2f(85, 95));
    this->Matrix->SetBorders(75, 65, 25, 40);
    this->View->GetScene()->AddItem(this->Matrix);
  }
  ~Figure() { this->Window->Finalize(); }
  Figure(const Figure&) = delete;
  Figure& operator=(const Figure&) = delete;

  /// From the top.
  vtkChartXY* At(int column, int row)
  {
    return vtkChartXY::SafeDownCast(this->Matrix->GetChart(vtkVector2i(column, this->Rows - 1 - row)));
  }

  void Write(const std::string& path)
  {
    this->Window->Render();
    vtkNew<vtkWindowToImageFilter> picture;
    picture->SetInput(this->Window);
    picture->ReadFrontBufferOff();
    picture->ShouldRerenderOff();
    vtkNew<vtkPNGWriter> png;
    png->SetInputConnection(picture->GetOutputPort());
    png->SetFileName((path + ".png").c_str());
    png->Write();
    if (png->GetErrorCode() != vtkErrorCode::NoError)
    {
      throw std::runtime_error("could not write " + path + ".png");
    }
    vtkNew<vtkSVGExporter> svg;
    svg->SetRenderWindow(this->Window);
    svg->SetFileName((path + ".svg").c_str());
    svg->SetTextAsPath(false); // small, and a reader can search it
    svg->Write();
  }

private:
  vtkNew<vtkIBLOffscreenWindow> Window;
  vtkNew<vtkContextView> View;
  vtkNew<vtkChartMatrix> Matrix;
  int Rows;
};

const char* const TimeTitle = "time [ms]";
const char* const ErrorTitle = "error, relative L1 [%]";
}

void WritePlots(Session& session)
{
  const std::string folder = session.Options.Output + "/plots";
  std::filesystem::create_directories(folder);
  const std::pair<const char*, const char*> stages[6] = { { "cube", "Cube map, 256^2 faces" },
    { "irradiance", "Irradiance" }, { "table", "BRDF table" }, { "bake", "Whole bake" },
    { "first frame", "First frame (picture's error)" }, { "steady frame", "Steady frame (picture's error)" } };
  {
    Figure figure(3, 2);
    for (int i = 0; i < 6; ++i)
    {
      FillChart(figure.At(i % 3, i / 3), stages[i].second, GetErrorCurves(session, stages[i].first), TimeTitle,
        ErrorTitle, false, i == 3 || i == 5);
    }
    figure.Write(folder + "/stages");
  }
  {
    Figure figure(4, 2);
    for (int i = 0; i < 8; ++i)
    {
      const std::string panel = LayerPanel(JudgedRoughness[i]);
      FillChart(figure.At(i % 4, i / 4), "Roughness " + panel.substr(6) + ", as read", GetErrorCurves(session, panel),
        TimeTitle, ErrorTitle, false, i == 0);
    }
    figure.Write(folder + "/layers");
  }
  {
    Figure figure(2, 1);
    FillChart(figure.At(0, 0), "Whole bake by source", GetGrowthCurves(session, "growth source"),
      "source width [texels]", TimeTitle, true, true);
    FillChart(figure.At(1, 0), "Whole bake by face", GetGrowthCurves(session, "growth face"), "face edge [texels]",
      TimeTitle, true, false);
    figure.Write(folder + "/growth");
  }
}
}
