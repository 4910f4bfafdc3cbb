// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// A scene of one PBR surface whose normal and view direction are known exactly.
#pragma once

#include "TestSupport.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLLighting.h"
#include "vtkIBLRenderPass.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

/// A square that fills the picture, seen in parallel projection along -z: V = +z, and N = (sin tilt, 0, cos tilt)
/// everywhere. No lights.
class PlaneScene : public GLTest
{
protected:
  vtkNew<vtkPlaneSource> Plane;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkIBLEnvironment> Environment;
  vtkNew<vtkIBLRenderPass> Pass;

  void SetUp() override;
  /// Turns the square so that N.V = NoV.
  void SetNoV(double NoV);
  void SetMaterial(double metallic, double perceptualRoughness, RGB color);
  /// Linear radiance of the picture's centre.
  RGB Capture();
  /// Display colour of the centre, 0 to 255.
  std::array<int, 4> GetCentre();
};

/// The window's picture, RGBA bytes, bottom row first.
std::vector<unsigned char> GetPicture(vtkRenderWindow* window);
