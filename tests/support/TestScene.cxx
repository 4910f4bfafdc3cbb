// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TestScene.h"

#include <vtkMath.h>
#include <vtkUnsignedCharArray.h>

void PlaneScene::SetUp()
{
  GLTest::SetUp();
  // Wide enough to fill the picture at grazing angles.
  this->Plane->SetOrigin(-1000, -10, 0);
  this->Plane->SetPoint1(1000, -10, 0);
  this->Plane->SetPoint2(-1000, 10, 0);
  this->Mapper->SetInputConnection(this->Plane->GetOutputPort());
  this->Actor->SetMapper(this->Mapper);
  this->Actor->GetProperty()->SetInterpolationToPBR();
  this->Renderer->AddActor(this->Actor);
  this->Renderer->AutomaticLightCreationOff();
  this->Renderer->SetPass(this->Pass);
  this->Pass->SetEnvironment(this->Environment);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetPosition(0, 0, 2000);
  camera->SetFocalPoint(0, 0, 0);
  camera->SetParallelScale(1);
  camera->SetClippingRange(1, 4000);
  this->Window->AddRenderer(this->Renderer);
}

void PlaneScene::SetNoV(double NoV)
{
  this->Actor->SetOrientation(0, vtkMath::DegreesFromRadians(std::acos(NoV)), 0);
}

void PlaneScene::SetMaterial(double metallic, double perceptualRoughness, RGB color)
{
  this->Actor->GetProperty()->SetMetallic(metallic);
  this->Actor->GetProperty()->SetRoughness(perceptualRoughness);
  this->Actor->GetProperty()->SetColor(color.data());
}

RGB PlaneScene::Capture()
{
  vtkSmartPointer<vtkImageData> image = this->Pass->CaptureRadiance(this->Renderer);
  const auto* rgba =
    static_cast<const float*>(image->GetScalarPointer(image->GetDimensions()[0] / 2, image->GetDimensions()[1] / 2, 0));
  return { rgba[0], rgba[1], rgba[2] };
}

std::array<int, 4> PlaneScene::GetCentre()
{
  this->Window->Render();
  const std::vector<unsigned char> picture = GetPicture(this->Window);
  const int* size = this->Window->GetSize();
  const unsigned char* rgba = &picture[4 * (std::size_t(size[1] / 2) * size[0] + size[0] / 2)];
  return { rgba[0], rgba[1], rgba[2], rgba[3] };
}

std::vector<unsigned char> GetPicture(vtkRenderWindow* window)
{
  vtkNew<vtkUnsignedCharArray> rgba;
  const int* size = window->GetSize();
  window->GetRGBACharPixelData(0, 0, size[0] - 1, size[1] - 1, 0, rgba);
  return { rgba->GetPointer(0), rgba->GetPointer(0) + rgba->GetNumberOfValues() };
}
