// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// A scientific surface under real light: a mesh of yours, or vortices in a made-up turbulent flow, coloured by speed.
#include "ExampleSupport.h"
#include "vtkIBLOffscreenWindow.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataSet.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMinimalStandardRandomSequence.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSMPTools.h>
#include <vtkSTLReader.h>
#include <vtkXMLGenericDataObjectReader.h>

#include <CLI/CLI.hpp>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace
{
// A divergence-free velocity field out of random Fourier modes with Kolmogorov's spectrum, on n^3 points of a cube, and
// its Q-criterion (Hunt, Wray & Moin 1988), Q = (|rotation|^2 - |strain|^2)/2 = -(du_i/dx_j du_j/dx_i)/2, which is high
// where the flow swirls.
vtkSmartPointer<vtkImageData> MakeTurbulence(int n)
{
  struct Mode
  {
    double K[3], U[3], Phase;
  };
  std::vector<Mode> modes(96);
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(7);
  auto next = [&] { return random->Next(), random->GetValue(); };
  for (Mode& mode : modes)
  {
    const double length = 4.0 * std::pow(5.0, next());
    double axis[3] = { next() - 0.5, next() - 0.5, next() - 0.5 };
    double direction[3] = { next() - 0.5, next() - 0.5, next() - 0.5 };
    vtkMath::Normalize(axis);
    vtkMath::Cross(axis, direction, mode.U); // perpendicular to K: no divergence
    vtkMath::Normalize(mode.U);
    const double amplitude = std::pow(length, -5.0 / 6.0);
    for (int i = 0; i < 3; ++i)
    {
      mode.K[i] = length * axis[i];
      mode.U[i] *= amplitude;
    }
    mode.Phase = 2.0 * vtkMath::Pi() * next();
  }

  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(n, n, n);
  image->SetSpacing(2.0 / (n - 1), 2.0 / (n - 1), 2.0 / (n - 1));
  image->SetOrigin(-1.0, -1.0, -1.0);
  vtkNew<vtkFloatArray> q;
  q->SetName("Q");
  q->SetNumberOfTuples(image->GetNumberOfPoints());
  vtkNew<vtkFloatArray> speed;
  speed->SetName("Speed");
  speed->SetNumberOfTuples(image->GetNumberOfPoints());
  vtkSMPTools::For(0, image->GetNumberOfPoints(),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType point = begin; point < end; ++point)
      {
        double x[3];
        image->GetPoint(point, x);
        double u[3] = {};
        double gradient[3][3] = {};
        for (const Mode& mode : modes)
        {
          const double angle = vtkMath::Dot(mode.K, x) + mode.Phase;
          const double c = std::cos(angle);
          const double s = std::sin(angle);
          for (int i = 0; i < 3; ++i)
          {
            u[i] += mode.U[i] * c;
            for (int j = 0; j < 3; ++j)
            {
              gradient[i][j] -= mode.U[i] * mode.K[j] * s;
            }
          }
        }
        double trace = 0.0;
        for (int i = 0; i < 3; ++i)
        {
          for (int j = 0; j < 3; ++j)
          {
            trace += gradient[i][j] * gradient[j][i];
          }
        }
        // Fade towards a ball, so that no vortex is cut by the box.
        const double radius = vtkMath::Norm(x);
        const double inside = std::min(std::max((1.0 - radius) / 0.3, 0.0), 1.0);
        q->SetValue(point, static_cast<float>(-0.5 * trace * inside));
        speed->SetValue(point, static_cast<float>(vtkMath::Norm(u)));
      }
    });
  image->GetPointData()->SetScalars(q);
  image->GetPointData()->AddArray(speed);
  return image;
}

vtkSmartPointer<vtkPolyData> MakeVortices(int n)
{
  vtkSmartPointer<vtkImageData> flow = MakeTurbulence(n);
  vtkNew<vtkFlyingEdges3D> vortices;
  vortices->SetInputData(flow);
  vortices->SetValue(0, 30.0);
  vortices->InterpolateAttributesOn();
  vortices->Update();
  vtkSmartPointer<vtkPolyData> surface = vortices->GetOutput();
  surface->GetPointData()->SetActiveScalars("Speed");
  return surface;
}

template <typename Reader>
vtkSmartPointer<vtkDataObject> ReadWith(const std::string& fileName)
{
  vtkNew<Reader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  return reader->GetOutputDataObject(0);
}

vtkSmartPointer<vtkPolyData> ReadSurface(const std::string& fileName)
{
  const std::string extension = fileName.substr(std::min(fileName.rfind('.'), fileName.size()));
  vtkSmartPointer<vtkDataObject> data = extension == ".stl" ? ReadWith<vtkSTLReader>(fileName)
    : extension == ".ply"                                   ? ReadWith<vtkPLYReader>(fileName)
    : extension == ".obj"                                   ? ReadWith<vtkOBJReader>(fileName)
                                                            : ReadWith<vtkXMLGenericDataObjectReader>(fileName);
  auto* dataSet = vtkDataSet::SafeDownCast(data);
  if (!dataSet || dataSet->GetNumberOfCells() == 0)
  {
    throw std::runtime_error(
      fileName + " holds no surface that this example reads; give a .vtp, .vtu, .vti, .stl, .ply or .obj");
  }
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(dataSet);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(surface->GetOutputPort());
  normals->SetFeatureAngle(40.0);
  normals->Update();
  return normals->GetOutput();
}

// Viridis at five points, decoded from what a screen shows to what a surface reflects, as VTK's PBR shading takes it.
vtkSmartPointer<vtkColorTransferFunction> MakeColors(const double range[2])
{
  const double colors[5][3] = { { 0.267, 0.005, 0.329 }, { 0.229, 0.322, 0.546 }, { 0.128, 0.567, 0.551 },
    { 0.369, 0.789, 0.383 }, { 0.993, 0.906, 0.144 } };
  auto map = vtkSmartPointer<vtkColorTransferFunction>::New();
  for (int i = 0; i < 5; ++i)
  {
    const double value = range[0] + (range[1] - range[0]) * i / 4.0;
    map->AddRGBPoint(value, std::pow(colors[i][0], 2.2), std::pow(colors[i][1], 2.2), std::pow(colors[i][2], 2.2));
  }
  return map;
}
}

int main(int argc, char* argv[])
{
  std::string mesh;
  std::string hdri;
  std::string output = "SciVis.png";
  std::string size = "1280x800";
  CLI::App app("Lights a scientific surface with an environment");
  app.add_option("mesh", mesh, ".vtp .vtu .vti .stl .ply .obj; default: vortices in a turbulent flow")
    ->check(CLI::ExistingFile);
  app.add_option("--environment", hdri, "HDR image to light with; default: the built-in studio")
    ->check(CLI::ExistingFile);
  app.add_option("--output", output, "PNG to write")->capture_default_str();
  app.add_option("--size", size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  int width = 0;
  int height = 0;
  if (std::sscanf(size.c_str(), "%dx%d", &width, &height) != 2 || width < 1 || height < 1)
  {
    std::fprintf(stderr, "--size is %s; it is WIDTHxHEIGHT, 1280x800 say\n", size.c_str());
    return 1;
  }

  try
  {
    vtkSmartPointer<vtkPolyData> surface = mesh.empty() ? MakeVortices(128) : ReadSurface(mesh);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(surface);
    if (vtkDataArray* scalars = surface->GetPointData()->GetScalars())
    {
      mapper->SetLookupTable(MakeColors(scalars->GetRange()));
    }
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetInterpolationToPBR();
    actor->GetProperty()->SetMetallic(0.0);
    actor->GetProperty()->SetRoughness(0.25);

    vtkNew<vtkIBLEnvironment> environment;
    environment->SetFileName(hdri.c_str());
    environment->NormalizeExposureOn();
    vtkNew<vtkIBLRenderPass> ibl;
    ibl->SetEnvironment(environment);
    ibl->BackgroundVisibleOn();
    ibl->SetBackgroundBlur(0.35);
    vtkNew<vtkRenderer> renderer;
    renderer->AddActor(actor);
    renderer->SetPass(ibl);

    vtkNew<vtkIBLOffscreenWindow> window;
    window->SetSize(width, height);
    window->SetMultiSamples(8);
    window->AddRenderer(renderer);
    renderer->ResetCamera();
    renderer->GetActiveCamera()->Azimuth(30.0);
    renderer->GetActiveCamera()->Elevation(15.0);
    renderer->GetActiveCamera()->Zoom(1.5);
    renderer->ResetCameraClippingRange();
    window->Render();

    std::printf("surface: %s, %lld points, %lld cells\n", mesh.empty() ? "vortices in a turbulent flow" : mesh.c_str(),
      static_cast<long long>(surface->GetNumberOfPoints()), static_cast<long long>(surface->GetNumberOfCells()));
    PrintStages(ibl);
    return WritePicture(window, output) ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
