// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// A black sphere with no lamp on: what is to be seen on it is the built-in studio's reflection. Returns 0 when it is,
// 125 where there is no OpenGL. Mutant: the pass not set (black).
#include <vtkIBLOffscreenWindow.h>
#include <vtkIBLRenderPass.h>

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <cstdio>

int main()
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToPBR();
  actor->GetProperty()->SetColor(0.0, 0.0, 0.0);

  vtkNew<vtkIBLRenderPass> ibl;
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.0, 0.0, 1.0);
  renderer->AutomaticLightCreationOff();
  renderer->AddActor(actor);
  renderer->SetPass(ibl);

  vtkNew<vtkIBLOffscreenWindow> window;
  if (!window->SupportsOpenGL())
  {
    std::printf("skipped: %s\n", window->GetOpenGLSupportMessage().c_str());
    return 125;
  }
  window->SetSize(64, 64);
  window->AddRenderer(renderer);
  window->Render();

  vtkNew<vtkUnsignedCharArray> picture; // RGBA
  window->GetRGBACharPixelData(0, 0, 63, 63, 0, picture);
  const unsigned char* corner = picture->GetPointer(0);
  const unsigned char* centre = picture->GetPointer(4 * (64 * 32 + 32));
  std::printf("centre %d %d %d, corner %d %d %d\n", centre[0], centre[1], centre[2], corner[0], corner[1], corner[2]);
  const bool isBackground = corner[0] == 0 && corner[1] == 0 && corner[2] == 255;
  const bool isLit = centre[0] > 20 && centre[1] > 20; // neither black nor the blue behind
  return isBackground && isLit ? 0 : 1;
}
