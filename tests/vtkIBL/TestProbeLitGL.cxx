// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What a probe captures of surfaces that are lit themselves.
#include "TestSupport.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLProbe.h"
#include "vtkIBLProbeCollection.h"
#include "vtkIBLRenderPass.h"

#include <vtkActor.h>
#include <vtkCubeSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

class TestProbeLitGL : public GLTest
{
};

// A white matt surface in a white furnace can't be seen, in the very first frame as in all others: the closed form. The
// first capture comes before anything was drawn, when VTK hasn't counted the lights. 1e-2: the furnace's 1e-3, and half
// floats. Mutant: no UpdateLights() before it, and all of +X is black.
TEST_F(TestProbeLitGL, FirstCaptureIsAsLitAsTheNext)
{
  vtkNew<vtkIBLEnvironment> furnace;
  furnace->SetInputData(MakePanorama(32, [](Vec3) { return RGB{ 0.5, 0.5, 0.5 }; }));
  vtkNew<vtkCubeSource> cube;
  cube->SetBounds(1, 1.5, -1.5, 1.5, -1.5, 1.5);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(cube->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToPBR();
  actor->GetProperty()->SetRoughness(0.8);
  actor->GetProperty()->SetColor(1, 1, 1);
  vtkNew<vtkIBLProbe> probe;
  vtkNew<vtkIBLRenderPass> pass;
  pass->SetEnvironment(furnace);
  pass->GetProbes()->SetFaceSize(32);
  pass->GetProbes()->AddItem(probe);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->SetPass(pass);
  this->Window->SetSize(32, 32);
  this->Window->AddRenderer(renderer);
  for (int frame = 0; frame < 2; ++frame)
  {
    const vtkSmartPointer<vtkImageData> seen = pass->CaptureProbe(renderer, probe);
    ASSERT_TRUE(seen);
    EXPECT_LE(GetRelativeL1(seen, std::vector<RGB>(6 * 32 * 32, { 0.5, 0.5, 0.5 })), 1e-2) << frame;
  }
}
