// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Tool.h"

#include "vtkIBLProbe.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkMath.h>

#include <cmath>

namespace
{
// Shares of the bar.
constexpr double ReadShare = 0.3;

void ShowReading(vtkObject*, unsigned long, void* progress, void* share)
{
  static_cast<tool::Progress*>(progress)->Set(ReadShare * *static_cast<double*>(share), "reading the environment");
}
}

vtkSmartPointer<vtkIBLEnvironment> tool::ReadEnvironment(const std::string& fileName, Progress& progress)
{
  auto environment = vtkSmartPointer<vtkIBLEnvironment>::New();
  environment->SetFileName(fileName.c_str());
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback(ShowReading);
  observer->SetClientData(&progress);
  const unsigned long tag = environment->AddObserver(vtkCommand::ProgressEvent, observer);
  const bool lit = environment->Update();
  environment->RemoveObserver(tag); // the bar may go before the environment does
  ThrowIfError();                   // with an error the light is not that of the file
  if (!lit)
  {
    throw Failure("too little memory for '" + fileName + "'");
  }
  if (!TakeWarning().empty())
  {
    PrintWarning("'" + fileName + "' had " + std::to_string(environment->GetNumberOfNotFiniteTexels()) +
      " NaN or infinite, " + std::to_string(environment->GetNumberOfTooLargeTexels()) + " too large and " +
      std::to_string(environment->GetNumberOfNegativeTexels()) + " negative texels; they were replaced");
  }
  return environment;
}

vtkSmartPointer<vtkIBLProbe> tool::ReadProbe(const std::string& fileName)
{
  auto probe = vtkSmartPointer<vtkIBLProbe>::New();
  probe->ReadFile(fileName.c_str());
  ThrowIfError();
  return probe;
}

void tool::StartWindow(vtkIBLOffscreenWindow* window, Size size)
{
  window->SetSize(size.Width, size.Height);
  if (!window->SupportsOpenGL())
  {
    throw Failure(OneLine(window->GetOpenGLSupportMessage()));
  }
}

tool::JSON tool::DescribeEnvironment(const std::string& fileName, vtkIBLEnvironment* environment)
{
  JSON json;
  json["source"] = fileName;
  json["size"] = { { "width", environment->GetWidth() }, { "height", environment->GetHeight() },
    { "faces", environment->GetNumberOfFaces() } };
  json["meanLuminance"] = environment->GetMeanLuminance();
  return json;
}

std::array<double, 3> tool::GetTexelDirection(const int dimensions[3], int i, int j, int k)
{
  const double u = (i + 0.5) / dimensions[0];
  const double v = (j + 0.5) / dimensions[1];
  if (dimensions[2] == 1)
  {
    const double longitude = 2.0 * vtkMath::Pi() * (u - 0.5);
    const double latitude = vtkMath::Pi() * (v - 0.5);
    return { std::cos(longitude) * std::cos(latitude), std::sin(latitude), std::sin(longitude) * std::cos(latitude) };
  }
  const double s = 2.0 * u - 1.0;
  const double t = 2.0 * v - 1.0;
  const std::array<double, 3> faces[6] = { { 1, -t, -s }, { -1, -t, s }, { s, 1, t }, { s, -1, -t }, { s, -t, 1 },
    { -s, -t, -1 } };
  std::array<double, 3> direction = faces[k];
  vtkMath::Normalize(direction.data());
  return direction;
}
