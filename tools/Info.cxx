// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkibl info: what an image holds as a light.
#include "Tool.h"

#include "vtkIBLImageReader.h"
#include "vtkIBLProbe.h"

#include <vtkMath.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

namespace
{
constexpr std::size_t NumberOfBrightest = 5;

struct Bright
{
  double Luminance;
  vtkIdType Texel;
};

struct Findings
{
  double Least = std::numeric_limits<double>::infinity(); // of finite channels
  double Most = -std::numeric_limits<double>::infinity();
  vtkIdType NaN = 0; // texels with such a channel
  vtkIdType Infinite = 0;
  vtkIdType Negative = 0;
  std::vector<Bright> Brightest; // falling luminance
};

void AddBright(std::vector<Bright>& brightest, Bright bright)
{
  if (brightest.size() < NumberOfBrightest || bright.Luminance > brightest.back().Luminance)
  {
    const auto place = std::find_if(
      brightest.begin(), brightest.end(), [&](const Bright& other) { return bright.Luminance > other.Luminance; });
    brightest.insert(place, bright);
    brightest.resize(std::min(brightest.size(), NumberOfBrightest));
  }
}

Findings Search(vtkImageData* image)
{
  Findings found;
  const auto* rgb = static_cast<const float*>(image->GetScalarPointer());
  for (vtkIdType texel = 0; texel < image->GetNumberOfPoints(); ++texel, rgb += 3)
  {
    const auto any = [rgb](auto test) { return std::any_of(rgb, rgb + 3, test); };
    found.NaN += any([](float x) { return std::isnan(x); });
    found.Infinite += any([](float x) { return std::isinf(x); });
    found.Negative += any([](float x) { return x < 0.0f; });
    if (any([](float x) { return !std::isfinite(x); }))
    {
      continue;
    }
    found.Least = std::min(found.Least, double(*std::min_element(rgb, rgb + 3)));
    found.Most = std::max(found.Most, double(*std::max_element(rgb, rgb + 3)));
    AddBright(found.Brightest, { 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2], texel }); // Rec. 709
  }
  return found;
}

void PrintBrightest(vtkImageData* image, const Findings& found)
{
  int dimensions[3];
  image->GetDimensions(dimensions);
  for (const Bright& bright : found.Brightest)
  {
    const auto* rgb = static_cast<const float*>(image->GetScalarPointer()) + 3 * bright.Texel;
    const int i = int(bright.Texel % dimensions[0]);
    const int j = int(bright.Texel / dimensions[0] % dimensions[1]);
    const int k = int(bright.Texel / dimensions[0] / dimensions[1]);
    const std::array<double, 3> d = tool::GetTexelDirection(dimensions, i, j, k);
    std::printf("  %.6g %.6g %.6g from direction %.4f %.4f %.4f\n", rgb[0], rgb[1], rgb[2], d[0], d[1], d[2]);
  }
}

void PrintProbe(vtkIBLProbe* probe)
{
  const auto print = [](const char* name, const double* numbers, int count)
  {
    std::printf("%s:", name);
    for (int i = 0; i < count; ++i)
    {
      std::printf(" %g", numbers[i]);
    }
    std::printf("\n");
  };
  const char* const proxies[] = { "infinite", "box", "ellipsoid" };
  double influence[6];
  probe->GetInfluenceBounds(influence);
  std::printf("proxy: %s\n", proxies[probe->GetProxy()]);
  print("position", probe->GetPosition(), 3);
  print("bounds", probe->GetBounds(), 6);
  print("orientation", probe->GetOrientation(), 3);
  print("influence", influence, 6);
  std::printf("blend distance: %g\nintensity: %g\n", probe->GetBlendDistance(), probe->GetIntensity());
}

void Info(const std::string& fileName)
{
  tool::Progress progress;
  progress.Set(0.5, "reading");
  vtkSmartPointer<vtkIBLProbe> probe;
  vtkSmartPointer<vtkImageData> image;
  if (vtkIBLProbe::CanReadFile(fileName.c_str()))
  {
    probe = tool::ReadProbe(fileName);
    probe->GetEnvironment()->Update();
    image = probe->GetEnvironment()->GetRadianceImage();
  }
  else
  {
    vtkNew<vtkIBLImageReader> reader;
    reader->SetFileName(fileName.c_str());
    reader->Update();
    image = reader->GetOutput();
  }
  tool::ThrowIfError();
  const Findings found = Search(image);
  vtkNew<vtkIBLEnvironment> environment; // what is left of it once it is cleaned
  environment->SetInputData(image);
  environment->Update();
  tool::ThrowIfError(fileName + ": ");
  progress.Finish();
  const double mean = environment->GetMeanLuminance();

  int dimensions[3];
  image->GetDimensions(dimensions);
  const bool cube = dimensions[2] == 6;
  std::printf("file: %s\n", fileName.c_str());
  std::printf("size: %d x %d%s\n", dimensions[0], dimensions[1], cube ? " x 6" : "");
  std::printf("layout: %s\n", probe ? "probe" : cube ? "cube" : "lat-long");
  if (probe)
  {
    PrintProbe(probe);
  }
  std::printf("range: %g to %g\n", found.Least, found.Most);
  std::printf("mean luminance: %g\n", mean);
  std::printf("NaN texels: %lld\n", static_cast<long long>(found.NaN));
  std::printf("infinite texels: %lld\n", static_cast<long long>(found.Infinite));
  std::printf("negative texels: %lld\n", static_cast<long long>(found.Negative));
  if (mean > 0.0)
  {
    std::printf("suggested exposure: %g (1 / mean luminance; 'vtkibl render --intensity' takes it)\n", 1.0 / mean);
  }
  else
  {
    std::printf("suggested exposure: none, for it is black\n");
  }
  std::printf("brightest texels (R G B):\n");
  PrintBrightest(image, found);
}
}

void tool::AddInfo(CLI::App& app)
{
  auto input = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
    "info", "Tells what an image holds as a light: size, layout, range, mean, faults, brightest texels, exposure.");
  command->footer("Example:\n  vtkibl info studio.exr\n\n"
                  "Numbers are linear radiance. A direction is x y z with y up; the middle of a lat-long image is +x.");
  command
    ->add_option("IN", *input, "Environment: any image that OpenImageIO reads, lat-long or a cube layout; or a probe")
    ->required()
    ->type_name("");
  command->callback([input] { Info(*input); });
}
