// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Probes that see the scene: what they capture, when, and how much work it is.
#include "TestSupport.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLLighting.h"
#include "vtkIBLProbe.h"
#include "vtkIBLProbeCollection.h"
#include "vtkIBLRenderPass.h"
#include "vtkIBLStatistics.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCubeSource.h>
#include <vtkLight.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <limits>

namespace
{
constexpr int FaceSize = 64;

// A box of one colour, of the light that it sends.
struct Block
{
  Vec3 Low, High;
  RGB Radiance;
};

RGB Sky(Vec3 d)
{
  return { 1.0 + 0.5 * d.x, 1.0 + 0.5 * d.y, 1.0 - 0.5 * d.z };
}

// What a ray meets first, or the sky. Slabs, in double.
RGB Trace(const std::vector<Block>& blocks, Vec3 origin, Vec3 d)
{
  RGB seen = Sky(d);
  double nearest = std::numeric_limits<double>::infinity();
  const double o[3] = { origin.x, origin.y, origin.z };
  const double v[3] = { d.x, d.y, d.z };
  for (const Block& block : blocks)
  {
    const double low[3] = { block.Low.x, block.Low.y, block.Low.z };
    const double high[3] = { block.High.x, block.High.y, block.High.z };
    double enter = 0;
    double leave = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i)
    {
      const double a = (low[i] - o[i]) / v[i];
      const double b = (high[i] - o[i]) / v[i];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter < leave && enter < nearest)
    {
      nearest = enter;
      seen = block.Radiance;
    }
  }
  return seen;
}

struct Scene
{
  vtkNew<vtkIBLRenderPass> Pass;
  vtkNew<vtkIBLEnvironment> Environment;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkIBLProbe> Probe;
  vtkNew<vtkActor> Ball; // a mirror around the probe, which does not see it
  vtkIBLOffscreenWindow* Window;
  vtkTypeInt64 Faces = 0;

  Scene(vtkIBLOffscreenWindow* window, Vec3 offset = { 0, 0, 0 })
    : Window(window)
  {
    this->Environment->SetInputData(MakePanorama(256, Sky));
    this->Pass->SetEnvironment(this->Environment);
    this->Pass->GetProbes()->SetFaceSize(FaceSize);
    this->Pass->GetProbes()->AddItem(this->Probe);
    this->Renderer->SetPass(this->Pass);
    this->Probe->SetPosition(offset.x, offset.y, offset.z);
    this->Probe->SetBounds(offset.x - 3, offset.x + 3, offset.y - 3, offset.y + 3, offset.z - 3, offset.z + 3);
    vtkNew<vtkSphereSource> sphere;
    sphere->SetRadius(0.25);
    sphere->SetThetaResolution(60);
    sphere->SetPhiResolution(30);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    this->Ball->SetMapper(mapper);
    this->Ball->SetPosition(offset.x, offset.y, offset.z);
    this->Ball->GetProperty()->SetInterpolationToPBR();
    this->Ball->GetProperty()->SetMetallic(1);
    this->Ball->GetProperty()->SetRoughness(0.2);
    this->Ball->GetProperty()->SetColor(1, 1, 1);
    vtkIBLProbe::SetCaptured(this->Ball, false);
    this->Renderer->AddActor(this->Ball);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetFocalPoint(offset.x, offset.y, offset.z);
    camera->SetPosition(offset.x, offset.y, offset.z + 2);
    camera->SetClippingRange(0.1, 100);
    window->SetSize(64, 64);
    window->AddRenderer(this->Renderer);
  }

  vtkSmartPointer<vtkActor> AddBlock(const Block& block)
  {
    vtkNew<vtkCubeSource> cube;
    cube->SetBounds(block.Low.x, block.High.x, block.Low.y, block.High.y, block.Low.z, block.High.z);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(cube->GetOutputPort());
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetColor(
      std::pow(block.Radiance[0], 1 / 2.2), std::pow(block.Radiance[1], 1 / 2.2), std::pow(block.Radiance[2], 1 / 2.2));
    this->Renderer->AddActor(actor);
    return actor;
  }

  // Faces that one more frame captures.
  vtkTypeInt64 Render()
  {
    this->Window->Render();
    const vtkTypeInt64 before = std::exchange(this->Faces, this->Probe->GetNumberOfCapturedFaces());
    return this->Faces - before;
  }
};

const std::vector<Block> Blocks = { { { 1, -1, -1 }, { 1.5, 1, 0.5 }, { 0.8, 0.1, 0.1 } },
  { { -2, -1.5, -2 }, { 2, -1, 2 }, { 0.3, 0.4, 0.5 } }, { { -1, -0.5, 1.25 }, { 0, 0.5, 2 }, { 0.1, 0.9, 0.2 } } };
}

class TestProbeCaptureGL : public GLTest
{
};

// A captured cube is what rays from its middle meet: every face the right way round, straight at its edges. All texels
// but those that an edge of a block cuts agree; 1 % in the sum. Witness: rays against boxes, in double. Also 1e7 away
// from the origin, where single precision has steps of 1. Mutants: a face mirrored or swapped; up for down; the
// window's aspect; the clipping range of the window's camera; no decoding of screen colours; no sky.
TEST_F(TestProbeCaptureGL, CaptureIsWhatRaysMeet)
{
  for (const double far : { 0.0, 1e7 })
  {
    Scene scene(this->Window, { far, -far, far });
    std::vector<Block> blocks = Blocks;
    for (Block& block : blocks)
    {
      block.Low = block.Low + Vec3{ far, -far, far };
      block.High = block.High + Vec3{ far, -far, far };
      auto actor = scene.AddBlock(
        Block{ block.Low - Vec3{ far, -far, far }, block.High - Vec3{ far, -far, far }, block.Radiance });
      actor->SetPosition(far, -far, far);
    }
    const vtkSmartPointer<vtkImageData> seen = scene.Pass->CaptureProbe(scene.Renderer, scene.Probe);
    ASSERT_TRUE(seen);
    ASSERT_EQ(seen->GetDimensions()[0], FaceSize);
    std::vector<RGB> truth;
    for (const Vec3& d : GetCubeDirections(FaceSize))
    {
      truth.push_back(Trace(blocks, { far, -far, far }, d));
    }
    EXPECT_LE(GetRelativeL1(seen, truth), 0.01) << far;
    this->Window->RemoveRenderer(scene.Renderer);
  }
}

// Nothing that moves, nothing to do; what moves is captured where it was and where it is; what nobody sees is not.
// Blocks lie in the faces +X, -Y (and all beside it), +Z. Mutants: stamps with the camera or with its lights in them;
// all faces on any change; the new place only; the old place only.
TEST_F(TestProbeCaptureGL, OnlyFacesThatChangedAreCaptured)
{
  Scene scene(this->Window);
  const vtkSmartPointer<vtkActor> right = scene.AddBlock({ { 1, -0.5, -0.5 }, { 2, 0.5, 0.5 }, { 1, 0, 0 } });
  EXPECT_EQ(scene.Render(), 6);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(scene.Render(), 0) << i;
    scene.Renderer->GetActiveCamera()->Azimuth(20); // with the headlight
  }
  right->GetProperty()->SetColor(0, 1, 0);
  EXPECT_EQ(scene.Render(), 1);
  right->SetPosition(-3, 0, 0); // over to -X
  EXPECT_EQ(scene.Render(), 2);
  right->VisibilityOff();
  EXPECT_EQ(scene.Render(), 1);
  EXPECT_EQ(scene.Render(), 0);
  scene.Ball->GetProperty()->SetColor(1, 0, 0); // not captured
  EXPECT_EQ(scene.Render(), 0);
  scene.Environment->SetIntensity(2); // seen everywhere
  EXPECT_EQ(scene.Render(), 6);
  scene.Probe->SetPosition(0.1, 0, 0);
  EXPECT_EQ(scene.Render(), 6);
  EXPECT_EQ(scene.Render(), 0);
  EXPECT_EQ(scene.Pass->GetLighting()->GetStatistics()->GetCount(vtkIBLStatistics::ProbeFaces), scene.Faces);
}
