// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What local light costs a frame: a hall of eight balls, lit by the sky, by one probe or by many, at rest or with
// something moving in it.
#include "Benchmark.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLProbe.h"
#include "vtkIBLProbeCollection.h"
#include "vtkIBLRenderPass.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCubeSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

namespace vtkIBLBenchmark
{
namespace
{
constexpr int Balls = 8;
constexpr double Spacing = 2.5;

class Hall
{
public:
  explicit Hall(const Map& map)
  {
    vtkNew<vtkIBLEnvironment> environment;
    environment->SetInputData(map.Image);
    this->Pass->SetEnvironment(environment);
    this->Renderer->SetPass(this->Pass);
    this->Renderer->AutomaticLightCreationOff();
    for (int i = 0; i < Balls; ++i)
    {
      vtkNew<vtkSphereSource> sphere;
      sphere->SetRadius(1);
      sphere->SetThetaResolution(80);
      sphere->SetPhiResolution(80); // 8 x 12,480 triangles
      vtkNew<vtkPolyDataMapper> mapper;
      mapper->SetInputConnection(sphere->GetOutputPort());
      const vtkSmartPointer<vtkActor> ball = this->Add(mapper, i);
      ball->GetProperty()->SetMetallic(1);
      ball->GetProperty()->SetRoughness(0.2);
      vtkIBLProbe::SetCaptured(ball, false);
    }
    vtkNew<vtkCubeSource> pillar;
    pillar->SetBounds(-0.1, 0.1, -1, 1, -2, -1.8);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(pillar->GetOutputPort());
    for (int i = 0; i < 24; ++i)
    {
      this->Add(mapper, 0.5 * i - 2)->GetProperty()->SetColor(0.8, 0.1 + 0.03 * i, 0.2);
    }
    vtkNew<vtkSphereSource> mote;
    mote->SetRadius(0.1);
    vtkNew<vtkPolyDataMapper> moteMapper;
    moteMapper->SetInputConnection(mote->GetOutputPort());
    this->Mote = this->Add(moteMapper, 0);
    this->Mote->SetPosition(0, 0, 1.5); // in the face +Z of the first ball's probe
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    const double middle = 0.5 * Spacing * (Balls - 1);
    camera->SetFocalPoint(middle, 0, 0);
    camera->SetPosition(middle, 2, 20);
    camera->SetViewAngle(60);
    this->Window->SetSize(512, 512);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->ResetCameraClippingRange();
  }
  ~Hall() { this->Window->Finalize(); }
  Hall(const Hall&) = delete;
  Hall& operator=(const Hall&) = delete;

  /// Around the ball, or all of them.
  vtkSmartPointer<vtkIBLProbe> AddProbe(int ball)
  {
    auto probe = vtkSmartPointer<vtkIBLProbe>::New();
    const double x = ball < 0 ? 0 : Spacing * ball;
    const double last = ball < 0 ? Spacing * (Balls - 1) : x;
    probe->SetPosition(x, 0, 0);
    probe->SetBounds(x - 1.25, last + 1.25, -1.25, 1.25, -2, 2);
    this->Pass->GetProbes()->AddItem(probe);
    return probe;
  }
  void MoveMote() { this->Mote->AddPosition(0, 1e-4, 0); }
  Sample Render()
  {
    return Clock(
      [&]
      {
        this->Window->Render();
        this->Window->WaitForCompletion();
      });
  }

private:
  vtkSmartPointer<vtkActor> Add(vtkPolyDataMapper* mapper, double place)
  {
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->GetProperty()->SetInterpolationToPBR();
    actor->SetPosition(Spacing * place, 0, 0);
    this->Renderer->AddActor(actor);
    return actor;
  }
  vtkNew<vtkIBLOffscreenWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkIBLRenderPass> Pass;
  vtkSmartPointer<vtkActor> Mote;
};
}

void RunProbes(Session& session)
{
  if (!session.Wants("probes"))
  {
    return;
  }
  const Map& map = session.Maps.front();
  const auto run = [&](const char* setting, const std::function<void(Hall&)>& setUp, bool moves, const char* note)
  {
    Hall hall(map);
    setUp(hall);
    hall.Render(); // the first light
    hall.Render();
    Row row("probes", "vtkIBL", setting, map.Name);
    row.Note = note;
    row.Samples = Repeat(
      [&]
      {
        if (moves)
        {
          hall.MoveMote();
        }
        return hall.Render();
      },
      session.Options.Repeat, 2, 4);
    session.Add(row);
  };
  run(
    "no probe", [](Hall&) {}, true, "the hall under the sky: what the rest is to be compared with");
  run(
    "1 probe at rest", [](Hall& hall) { hall.AddProbe(-1); }, false, "all balls in its reach; nothing is captured");
  run(
    "8 probes at rest",
    [](Hall& hall)
    {
      for (int i = 0; i < Balls; ++i)
      {
        hall.AddProbe(i);
      }
    },
    false, "a ball each");
  run(
    "4 probes at rest, all for all",
    [](Hall& hall)
    {
      for (int i = 0; i < 4; ++i)
      {
        hall.AddProbe(-1);
      }
    },
    false, "every pixel reads four");
  run(
    "1 probe, every frame", [](Hall& hall) { hall.AddProbe(-1)->SetUpdateMode(vtkIBLProbe::EveryFrame); }, false,
    "six faces and all layers");
  run(
    "1 probe, one face changes", [](Hall& hall) { hall.AddProbe(-1); }, true, "that face and all layers");
  run(
    "1 probe, one face changes, cut up", [](Hall& hall) { hall.AddProbe(-1)->SetTimeBudget(1e-6); }, true,
    "a face, the mip levels or a layer a frame");
}
}
