// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Tool.h"

#include <vtkDataSet.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkSTLReader.h>
#include <vtkXMLGenericDataObjectReader.h>

#include <algorithm>
#include <cmath>

namespace
{
template <typename Reader>
vtkSmartPointer<vtkDataObject> ReadWith(const std::string& fileName)
{
  vtkNew<Reader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  return reader->GetOutputDataObject(0);
}

vtkSmartPointer<vtkDataObject> Read(const std::string& fileName)
{
  const std::string extension = tool::Extension(fileName);
  if (extension == ".stl")
  {
    return ReadWith<vtkSTLReader>(fileName);
  }
  if (extension == ".ply")
  {
    return ReadWith<vtkPLYReader>(fileName);
  }
  if (extension == ".obj")
  {
    return ReadWith<vtkOBJReader>(fileName);
  }
  if (extension == ".vtp" || extension == ".vtu" || extension == ".vti")
  {
    return ReadWith<vtkXMLGenericDataObjectReader>(fileName);
  }
  throw tool::Failure("'" + fileName + "' is no mesh that vtkibl reads: .vtp .vtu .vti .stl .ply .obj");
}
}

vtkSmartPointer<vtkPolyData> tool::ReadSurface(const std::string& fileName)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(fileName, error))
  {
    throw Failure("there is no mesh file '" + fileName + "'");
  }
  const vtkSmartPointer<vtkDataObject> data = Read(fileName);
  ThrowIfError("cannot read mesh '" + fileName + "': ");
  if (const std::string warning = TakeWarning(); !warning.empty())
  {
    PrintWarning("mesh '" + fileName + "': " + warning);
  }
  auto* dataSet = vtkDataSet::SafeDownCast(data);
  vtkNew<vtkDataSetSurfaceFilter> filter;
  if (dataSet)
  {
    filter->SetInputData(dataSet);
    filter->Update();
    ThrowIfError("cannot find the surface of '" + fileName + "': ");
  }
  vtkSmartPointer<vtkPolyData> surface = filter->GetInput() ? filter->GetOutput() : nullptr;
  if (!surface || surface->GetNumberOfPolys() + surface->GetNumberOfStrips() == 0)
  {
    throw Failure("mesh '" + fileName + "' has no faces");
  }
  double bounds[6];
  surface->GetBounds(bounds);
  if (!std::all_of(bounds, bounds + 6, [](double x) { return std::isfinite(x); }))
  {
    throw Failure("mesh '" + fileName + "' has points that are not finite");
  }
  if (!surface->GetPointData()->GetNormals())
  {
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(surface);
    normals->SetFeatureAngle(40.0); // above, an edge is taken as sharp
    normals->Update();
    surface = normals->GetOutput();
  }
  return surface;
}
