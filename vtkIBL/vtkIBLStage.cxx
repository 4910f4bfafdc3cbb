// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLStage.h"

#include "vtkIBLGL.h"
#include "vtkIBLStopwatch.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

vtkIBLStage::vtkIBLStage()
  : Statistics(vtkSmartPointer<vtkIBLStatistics>::New())
{
}

vtkIBLStage::~vtkIBLStage() = default;

void vtkIBLStage::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfBuilds: " << this->NumberOfBuilds << "\n"
     << indent << "LastBuildSeconds: " << this->LastBuildSeconds << "\n"
     << indent << "LastBuildTexels: " << this->LastBuildTexels << "\n";
}

void vtkIBLStage::SetStatistics(vtkIBLStatistics* statistics)
{
  this->Statistics =
    statistics ? vtkSmartPointer<vtkIBLStatistics>(statistics) : vtkSmartPointer<vtkIBLStatistics>::New();
}

vtkIBLStatistics* vtkIBLStage::GetStatistics() const
{
  return this->Statistics;
}

vtkMTimeType vtkIBLStage::GetBuildTime() const
{
  return this->BuildTime.GetMTime();
}

bool vtkIBLStage::Update(vtkOpenGLRenderWindow* window)
{
  if (window->GetContextCreationTime() == 0)
  {
    window->Initialize(); // never rendered: it has no context, and another window's is current
  }
  if (window != this->Window || window->GetContextCreationTime() != this->ContextTime)
  {
    this->ReleaseGraphicsResources(this->Window);
    this->Window = window;
    this->ContextTime = window->GetContextCreationTime();
  }
  vtkMTimeType inputTime = 0;
  if (!this->UpdateInput(window, inputTime))
  {
    return this->GetBuildTime() > 0;
  }
  // An attempt that failed is not repeated until something changed: one error, not one a frame.
  if (std::max(inputTime, this->GetMTime()) > this->AttemptTime.GetMTime())
  {
    this->AttemptTime.Modified();
    try
    {
      const vtkIBLStopwatch stopwatch;
      window->MakeCurrent();
      while (glGetError() != GL_NO_ERROR) // somebody else's, and not to be reported as ours
      {
      }
      if (const std::string missing = vtkIBLGL::FindMissingFeature(); !missing.empty())
      {
        throw std::runtime_error(missing);
      }
      const auto getInputSeconds = [input = this->GetInputStatistics()]
      { return input ? input->GetSeconds(vtkIBLStatistics::Total) : 0.0; };
      const double before = getInputSeconds();
      const std::vector<vtkIBLStatistics::Work> made = this->Build(window);
      glFinish();
      this->LastBuildSeconds = stopwatch.GetSeconds();
      this->LastBuildTexels = 0;
      double own = this->LastBuildSeconds - (getInputSeconds() - before);
      for (vtkIBLStatistics::Work work : made)
      {
        work.Seconds = std::exchange(own, 0.0); // the first has it
        this->LastBuildTexels += work.Texels;
        this->Statistics->Add(work);
      }
      ++this->NumberOfBuilds;
      this->BuildTime.Modified();
    }
    catch (const std::exception& error)
    {
      vtkErrorMacro(<< error.what());
    }
  }
  return this->GetBuildTime() > 0;
}

void vtkIBLStage::ReleaseGraphicsResources(vtkWindow*)
{
  this->Release();
  this->Window = nullptr;
  this->BuildTime = vtkTimeStamp();
  this->AttemptTime = vtkTimeStamp();
}
