// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLProbeDisplay.h"

#include "vtkIBLProbe.h"
#include "vtkIBLProbeCollection.h"

#include "vtkActor.h"
#include "vtkCubeSource.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <cmath>

namespace
{
vtkSmartPointer<vtkPolyData> MakeUnitBall(int resolution)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(1.0);
  ball->SetThetaResolution(2 * resolution);
  ball->SetPhiResolution(resolution);
  ball->Update();
  return ball->GetOutput();
}

vtkSmartPointer<vtkPolyData> MakeUnitCube() // [-1, 1]^3
{
  vtkNew<vtkCubeSource> cube;
  cube->SetBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  cube->Update();
  return cube->GetOutput();
}

vtkSmartPointer<vtkActor> MakeActor()
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  vtkNew<vtkPolyDataMapper> mapper;
  actor->SetMapper(mapper);
  vtkNew<vtkMatrix4x4> matrix;
  actor->SetUserMatrix(matrix);
  actor->PickableOff();
  return actor;
}

vtkSmartPointer<vtkActor> MakeWires(double grey)
{
  vtkSmartPointer<vtkActor> actor = MakeActor();
  actor->GetProperty()->SetRepresentationToWireframe();
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(grey, grey, grey);
  return actor;
}

// A unit shape as large as `half` about `middle`, in the coordinates that `rows` lead from to the world.
void Place(vtkActor* actor, vtkPolyData* shape, const double rows[3][4], const double middle[3], const double half[3])
{
  vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->SetInputData(shape); // nothing when it is that already
  vtkNew<vtkMatrix4x4> matrix;
  for (int i = 0; i < 3; ++i)
  {
    double origin = rows[i][3];
    for (int j = 0; j < 3; ++j)
    {
      matrix->SetElement(i, j, rows[i][j] * half[j]);
      origin += rows[i][j] * middle[j];
    }
    matrix->SetElement(i, 3, origin);
  }
  actor->GetUserMatrix()->DeepCopy(matrix);
}
}

vtkIBLProbeDisplay::vtkIBLProbeDisplay()
  : Ball(MakeUnitBall(32))
  , WireBall(MakeUnitBall(12))
  , WireCube(MakeUnitCube())
{
}

vtkIBLProbeDisplay::~vtkIBLProbeDisplay() = default;

const std::vector<vtkProp*>& vtkIBLProbeDisplay::Update(vtkIBLProbeCollection* probes, const Look& look)
{
  this->Props.clear();
  this->Actors.resize(probes->GetNumberOfItems());
  auto marks = this->Actors.begin();
  vtkCollectionSimpleIterator it;
  probes->InitTraversal(it);
  for (vtkIBLProbe* probe = probes->GetNextProbe(it); probe; probe = probes->GetNextProbe(it), ++marks)
  {
    if (!marks->Ball)
    {
      marks->Ball = MakeActor();
      marks->Ball->GetProperty()->SetInterpolationToPBR();
      marks->Ball->GetProperty()->SetColor(1.0, 1.0, 1.0);
      marks->Proxy = MakeWires(0.9);
      marks->Influence = MakeWires(0.5);
    }
    marks->Ball->GetProperty()->SetMetallic(look.IsMetal ? 1.0 : 0.0);
    marks->Ball->GetProperty()->SetBaseIOR(look.IsMetal ? 1.5 : 1.0); // matt, without a gloss
    marks->Ball->GetProperty()->SetRoughness(look.Roughness);
    double rows[3][4];
    double middle[3];
    double half[3];
    probe->GetWorldFromUnit(rows);
    probe->GetUnitInfluence(middle, half);
    double unit[3];
    probe->GetUnitLengths(unit);
    const double radius = 0.1 * *std::min_element(unit, unit + 3);
    const double* position = probe->GetPosition();
    const double ball[3][4] = { { radius, 0, 0, position[0] }, { 0, radius, 0, position[1] },
      { 0, 0, radius, position[2] } };
    const double one[3] = { 1.0, 1.0, 1.0 };
    const double zero[3] = { 0.0, 0.0, 0.0 };
    Place(marks->Ball, this->Ball, ball, zero, one);
    this->Props.push_back(marks->Ball);
    vtkPolyData* wires = probe->GetProxy() == vtkIBLProbe::Ellipsoid ? this->WireBall : this->WireCube;
    if (probe->GetProxy() != vtkIBLProbe::Infinite)
    {
      Place(marks->Proxy, wires, rows, zero, one);
      this->Props.push_back(marks->Proxy);
    }
    if (std::isfinite(half[0]))
    {
      Place(marks->Influence, wires, rows, middle, half);
      this->Props.push_back(marks->Influence);
    }
  }
  return this->Props;
}

void vtkIBLProbeDisplay::Clear()
{
  this->Props.clear();
}

void vtkIBLProbeDisplay::ReleaseGraphicsResources(vtkWindow* window)
{
  for (Marks& marks : this->Actors)
  {
    for (vtkActor* actor : { marks.Ball.Get(), marks.Proxy.Get(), marks.Influence.Get() })
    {
      if (actor)
      {
        actor->ReleaseGraphicsResources(window);
      }
    }
  }
}
