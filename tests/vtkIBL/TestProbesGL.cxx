// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Local light: where a reflection shows what, which probe counts how much, and what is asked of a probe's settings. The
// light of these probes comes from cubes that the witness made by casting rays.
#include "ReferenceRoom.h"
#include "TestSupport.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLLighting.h"
#include "vtkIBLProbe.h"
#include "vtkIBLProbeCollection.h"
#include "vtkIBLRenderPass.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>

#include <limits>

using vtkIBLReference::Room;

namespace
{
constexpr int Size = 96;
constexpr int FaceSize = 128;

Vec3 ToVec3(const double* v)
{
  return { v[0], v[1], v[2] };
}

// Light that says where it comes from: a point of the wall as a colour, all above 0.
RGB ColorOf(Vec3 point, Vec3 origin)
{
  const Vec3 p = point - origin;
  return { p.x + 4, p.y + 4, p.z + 4 };
}

struct Scene
{
  vtkNew<vtkIBLRenderPass> Pass;
  vtkNew<vtkIBLEnvironment> Sky;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkIBLProbe> Probe;
  vtkNew<vtkActor> Actor;
  vtkIBLOffscreenWindow* Window;

  // A room and its probe at `position`; the camera looks at a mirror, its floor.
  Scene(vtkIBLOffscreenWindow* window)
    : Window(window)
  {
    this->Sky->SetInputData(MakePanorama(16, [](Vec3) { return RGB{ 0.5, 0.5, 0.5 }; }));
    this->Pass->SetEnvironment(this->Sky);
    this->Pass->GetProbes()->SetFaceSize(FaceSize);
    this->Renderer->SetPass(this->Pass);
    this->Renderer->AutomaticLightCreationOff();
    this->Renderer->AddActor(this->Actor);
    this->Actor->GetProperty()->SetInterpolationToPBR();
    this->Actor->GetProperty()->SetMetallic(1);
    this->Actor->GetProperty()->SetRoughness(0);
    this->Actor->GetProperty()->SetColor(1, 1, 1);
    window->SetSize(Size, Size);
    window->AddRenderer(this->Renderer);
  }

  // Light on the probe from the walls of a room.
  void Fill(const Room& room, Vec3 offset)
  {
    const Vec3 position = ToVec3(this->Probe->GetPosition());
    vtkNew<vtkIBLEnvironment> light;
    light->SetInputData(
      MakeFaces(FaceSize, [&](Vec3 d) { return ColorOf(vtkIBLReference::Hit(room, position, d), offset); }));
    this->Probe->SetEnvironment(light);
    this->Pass->GetProbes()->AddItem(this->Probe);
  }

  void SetFloor(Vec3 middle, double half)
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(middle.x - half, middle.y, middle.z + half);
    plane->SetPoint1(middle.x + half, middle.y, middle.z + half);
    plane->SetPoint2(middle.x - half, middle.y, middle.z - half);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(plane->GetOutputPort());
    this->Actor->SetMapper(mapper);
  }

  void LookAt(Vec3 from, Vec3 to)
  {
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(from.x, from.y, from.z);
    camera->SetFocalPoint(to.x, to.y, to.z);
    camera->SetViewUp(0, 1, 0);
    camera->SetViewAngle(40);
    camera->SetClippingRange(0.01, 20);
  }

  // Point of the plane y = height that a pixel shows.
  Vec3 GetFloorPoint(int i, int j, double height)
  {
    double aspect = 1;
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    vtkNew<vtkMatrix4x4> inverse;
    vtkMatrix4x4::Invert(camera->GetCompositeProjectionTransformMatrix(aspect, -1, 1), inverse);
    const double pixel[4] = { (2 * i + 1.0) / Size - 1, (2 * j + 1.0) / Size - 1, 1, 1 };
    double far[4];
    inverse->MultiplyPoint(pixel, far);
    const Vec3 eye = ToVec3(camera->GetPosition());
    const Vec3 ray = Vec3{ far[0] / far[3], far[1] / far[3], far[2] / far[3] } - eye;
    return eye + ((height - eye.y) / ray.y) * ray;
  }
};

// The largest distance between where the mirror shows a point of the wall and where it is, in texels of the probe's
// cube there: 2/n of its distance from the probe at a face's centre, and less elsewhere.
double GetLargestShift(Scene& scene, const Room& room, Vec3 offset, double height)
{
  const vtkSmartPointer<vtkImageData> picture = scene.Pass->CaptureRadiance(scene.Renderer);
  const Vec3 eye = ToVec3(scene.Renderer->GetActiveCamera()->GetPosition());
  const Vec3 probe = ToVec3(scene.Probe->GetPosition());
  double largest = 0;
  int count = 0;
  for (int j = 2; j < Size; j += 5)
  {
    for (int i = 2; i < Size; i += 5)
    {
      const Vec3 point = scene.GetFloorPoint(i, j, height);
      if (!vtkIBLReference::IsInside(room, point))
      {
        continue;
      }
      const Vec3 view = point - eye;
      const Vec3 hit = vtkIBLReference::Hit(room, point, { view.x, -view.y, view.z });
      const RGB truth = ColorOf(hit, offset);
      const auto* shown = static_cast<const float*>(picture->GetScalarPointer(i, j, 0));
      const Vec3 error = { shown[0] - truth[0], shown[1] - truth[1], shown[2] - truth[2] };
      const Vec3 apart = hit - probe;
      const double texel = std::sqrt(Dot(apart, apart)) * 2.0 / FaceSize;
      largest = std::max(largest, std::sqrt(Dot(error, error)) / texel);
      ++count;
    }
  }
  EXPECT_GT(count, 200);
  return largest;
}
}

class TestProbesGL : public GLTest
{
};

// A mirror in a room shows each point of the walls where it is, from anywhere: within half a texel of the probe's cube.
// Boxes straight and turned, ellipsoids too, the probe off the middle. Witness: bisection along the mirrored ray.
// Mutants: no offset of the probe; directions not turned; a box for the ellipsoid; the sky's cube read.
TEST_F(TestProbesGL, MirrorsShowWallsWhereTheyAre)
{
  for (const bool isBall : { false, true })
  {
    for (const double turn : { 0.0, 25.0 })
    {
      Scene scene(this->Window);
      vtkNew<vtkTransform> axes;
      axes->RotateY(turn);
      Room room{ isBall, { 0.2, 0.1, -0.3 }, { 1.5, 1.0, 1.25 } };
      for (int i = 0; i < 3; ++i)
      {
        const double unit[3] = { double(i == 0), double(i == 1), double(i == 2) };
        double axis[3];
        axes->TransformVector(unit, axis);
        room.Axes[i] = { axis[0], axis[1], axis[2] };
      }
      scene.Probe->SetProxy(isBall ? vtkIBLProbe::Ellipsoid : vtkIBLProbe::Box);
      scene.Probe->SetBounds(-1.3, 1.7, -0.9, 1.1, -1.55, 0.95);
      scene.Probe->SetOrientation(0, turn, 0);
      scene.Probe->SetPosition(0.5, 0.3, 0.1);
      scene.Probe->SetBlendDistance(0);
      const double height = isBall ? -0.6 : -0.88;
      scene.SetFloor({ 0.2, height, -0.3 }, 3);
      scene.LookAt({ 0.3, 0.6, 0.5 }, { 0.2, height, -0.3 });
      scene.Fill(room, { 0, 0, 0 });
      EXPECT_LE(GetLargestShift(scene, room, { 0, 0, 0 }, height), 0.5) << isBall << turn;
      this->Window->RemoveRenderer(scene.Renderer);
    }
  }
}
