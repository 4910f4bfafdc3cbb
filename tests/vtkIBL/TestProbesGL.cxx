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

#include <functional>
#include <limits>
#include <map>

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
    this->FillWith(room, [&](Vec3 point) { return ColorOf(point, offset); });
  }

  void FillWith(const Room& room, const std::function<RGB(Vec3)>& radiance)
  {
    const Vec3 position = ToVec3(this->Probe->GetPosition());
    vtkNew<vtkIBLEnvironment> light;
    light->SetInputData(MakeFaces(FaceSize, [&](Vec3 d) { return radiance(vtkIBLReference::Hit(room, position, d)); }));
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

// The same far out, as data in a projected map are: 1e7 units from the origin, where single precision has steps of 1.
// Mutants: a matrix worked out in single precision; coordinates of the world in the shader.
TEST_F(TestProbesGL, MirrorsShowWallsFarFromTheOrigin)
{
  const Vec3 far = { 1e7, -1e7, 2e7 };
  Scene scene(this->Window);
  const Room room{ false, far + Vec3{ 0.2, 0.1, -0.3 }, { 1.5, 1.0, 1.25 } };
  scene.Probe->SetBounds(far.x - 1.3, far.x + 1.7, far.y - 0.9, far.y + 1.1, far.z - 1.55, far.z + 0.95);
  scene.Probe->SetPosition(far.x + 0.5, far.y + 0.3, far.z + 0.1);
  scene.SetFloor({ 0, 0, 0 }, 3);
  scene.Actor->SetPosition(far.x + 0.2, far.y - 0.75, far.z - 0.3);
  scene.Probe->SetBlendDistance(0);
  scene.LookAt(far + Vec3{ 0.3, 0.6, 0.5 }, far + Vec3{ 0.2, -0.75, -0.3 });
  scene.Fill(room, far);
  EXPECT_LE(GetLargestShift(scene, room, far, far.y - 0.75), 0.5);
}

namespace
{
// A matt square that fills the picture, at x, and the light that it shows.
struct Walker : Scene
{
  explicit Walker(vtkIBLOffscreenWindow* window)
    : Scene(window)
  {
    this->Actor->GetProperty()->SetMetallic(0);
    this->Actor->GetProperty()->SetRoughness(1);
    this->Actor->GetProperty()->SetBaseIOR(1);
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-0.1, -0.1, 0);
    plane->SetPoint1(0.1, -0.1, 0);
    plane->SetPoint2(-0.1, 0.1, 0);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(plane->GetOutputPort());
    this->Actor->SetMapper(mapper);
    this->Renderer->GetActiveCamera()->ParallelProjectionOn();
    this->Renderer->GetActiveCamera()->SetParallelScale(0.0005);
    window->SetSize(8, 8);
  }
  vtkSmartPointer<vtkIBLProbe> Add(double low, double high, RGB radiance)
  {
    auto probe = vtkSmartPointer<vtkIBLProbe>::New();
    probe->SetBounds(low, high, -2, 2, -2, 2);
    probe->SetInfluenceBounds(low, high, -2, 2, -2, 2);
    probe->SetPosition(0.5 * (low + high), 0, 0);
    vtkNew<vtkIBLEnvironment> light;
    light->SetInputData(MakeFaces(8, [&](Vec3) { return radiance; }));
    probe->SetEnvironment(light);
    this->Pass->GetProbes()->AddItem(probe);
    return probe;
  }
  RGB GetLight(double x)
  {
    this->Actor->SetPosition(x, 0, 0);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetFocalPoint(x, 0, 0);
    camera->SetPosition(x, 0, 1);
    camera->SetClippingRange(0.1, 10);
    const vtkSmartPointer<vtkImageData> picture = this->Pass->CaptureRadiance(this->Renderer);
    const auto* rgb = static_cast<const float*>(picture->GetScalarPointer(4, 4, 0));
    return { rgb[0], rgb[1], rgb[2] };
  }
};
}

// Whatever the number of probes at a place, and however much they overlap, they and the sky count 1 together: where all
// are the same, nothing is seen of them. Mutants: shares that are not of what is left; the sky in full; half of a
// blend.
TEST_F(TestProbesGL, SharesSumToOne)
{
  Walker scene(this->Window);
  for (int i = 0; i < 7; ++i)
  {
    scene.Add(-2 + 0.5 * i, 0.2 + 0.6 * i, { 0.5, 0.5, 0.5 });
  }
  for (double x = -2.5; x < 4.5; x += 0.17)
  {
    for (const double light : scene.GetLight(x))
    {
      EXPECT_NEAR(light, 0.5, 2e-3) << x;
    }
  }
}

// A walk through two probes that overlap, a small one on a large one, and out: light goes over from one to the other as
// the blend's smoothstep does, never faster than 1.5 per blend distance, so that small steps are small changes of the
// picture: none at all above 1/255 in display for steps of 1/1000. In the middle of each it is its own. Witness: the
// slope of 3 t^2 - 2 t^3. Mutants: a choice of one probe an actor; hard edges; the large one on top; probes of one
// actor in their order in the collection.
TEST_F(TestProbesGL, LightIsContinuousFromProbeToProbe)
{
  Walker scene(this->Window);
  const RGB red = { 0.9, 0.1, 0.1 };
  const RGB blue = { 0.1, 0.1, 0.9 };
  const RGB sky = { 0.5, 0.5, 0.5 };
  const vtkSmartPointer<vtkIBLProbe> large = scene.Add(-3, 2, red);
  const vtkSmartPointer<vtkIBLProbe> small = scene.Add(1, 4, blue);
  large->SetBlendDistance(0.5);
  small->SetBlendDistance(0.4);
  const double step = 0.02;
  RGB last = scene.GetLight(-4);
  EXPECT_NEAR(last[0], sky[0], 2e-3);
  double fastest = 0;
  for (double x = -4 + step; x < 5; x += step)
  {
    const RGB now = scene.GetLight(x);
    for (int c = 0; c < 3; ++c)
    {
      fastest = std::max(fastest, std::abs(now[c] - last[c]) / step);
    }
    last = now;
  }
  EXPECT_LE(fastest, 0.8 * 1.5 / 0.4 * 1.05);
  EXPECT_GE(fastest, 0.8 * 1.5 / 0.4 * 0.8); // it is seen
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(scene.GetLight(-0.5)[c], red[c], 2e-3);
    EXPECT_NEAR(scene.GetLight(1.7)[c], blue[c], 2e-3);                  // inside both
    EXPECT_NEAR(scene.GetLight(1.2)[c], 0.5 * (red[c] + blue[c]), 4e-3); // half way
    EXPECT_NEAR(scene.GetLight(4.5)[c], sky[c], 2e-3);
  }
}

// By default a probe lights all of its proxy in full, what lies on the walls, too, and fades around it, over a tenth of
// its shortest side. Mutants: a fade that ends at the walls; a hard edge.
TEST_F(TestProbesGL, WallsAreLitInFull)
{
  Walker scene(this->Window);
  const vtkSmartPointer<vtkIBLProbe> probe = scene.Add(-3, 2, { 0.9, 0.1, 0.1 });
  probe->SetInfluenceToBounds();
  EXPECT_NEAR(scene.GetLight(2.0)[0], 0.9, 4e-3);
  EXPECT_NEAR(scene.GetLight(2.2)[0], 0.7, 4e-3);
  EXPECT_NEAR(scene.GetLight(2.4)[0], 0.5, 4e-3);
  probe->SetProxy(vtkIBLProbe::Ellipsoid);
  EXPECT_NEAR(scene.GetLight(2.0)[0], 0.9, 4e-3);
  EXPECT_NEAR(scene.GetLight(2.7)[0], 0.5, 4e-3);
}

// Intensity, and an environment of its own turned and dimmed, count where light is looked up. Mutant: the sky's scale
// for the probe's.
TEST_F(TestProbesGL, ProbesHaveTheirOwnStrength)
{
  Walker scene(this->Window);
  const vtkSmartPointer<vtkIBLProbe> probe = scene.Add(-1, 1, { 0.2, 0.4, 0.6 });
  scene.Sky->SetIntensity(0);
  EXPECT_NEAR(scene.GetLight(0)[1], 0.4, 2e-3);
  EXPECT_NEAR(scene.GetLight(2)[1], 0.0, 1e-6);
  probe->SetIntensity(2);
  probe->GetEnvironment()->SetTint(1, 0.25, 1);
  EXPECT_NEAR(scene.GetLight(0)[1], 0.2, 2e-3);
  EXPECT_NEAR(scene.GetLight(0)[2], 1.2, 5e-3);
  scene.Pass->GetLighting()->SetSamplesPerPixel(64);
  EXPECT_NEAR(scene.GetLight(0)[2], 1.2, 5e-3);
  EXPECT_NEAR(scene.GetLight(2)[1], 0.0, 1e-6);
}

// More probes than light an actor, or than have light at all: a picture, finite, and a word. Mutants: no limit on
// either.
TEST_F(TestProbesGL, AThousandProbesAreTooMany)
{
  Walker scene(this->Window);
  scene.Pass->GetProbes()->SetFaceSize(32);
  scene.Pass->GetProbes()->SetNumberOfSamples(16);
  for (int i = 0; i < 1000; ++i)
  {
    scene.Add(-1 - 1e-3 * i, 1 + 1e-3 * i, { 0.3, 0.3, 0.3 });
  }
  const RGB light = scene.GetLight(0);
  EXPECT_NEAR(light[0], 0.3, 2e-3);
  EXPECT_NE(this->Messages.Take().find("More than 64 probes"), std::string::npos);
  scene.GetLight(0.1);
  EXPECT_EQ(this->Messages.Take(), ""); // once
  scene.Pass->GetProbes()->RemoveAllItems();
  EXPECT_NEAR(scene.GetLight(0)[0], 0.5, 2e-3);
}

// A probe is asked for by what lies in its influence, be it flat or a point, in part, turned, or all around it; not by
// what touches it, where it counts nothing. Mutants: <= for <; axes of the world for the probe's; flat bounds taken for
// empty.
TEST_F(TestProbesGL, TouchingIsNotReaching)
{
  vtkNew<vtkIBLProbe> probe;
  probe->SetInfluenceBounds(-1, 1, -1, 1, -1, 1);
  const auto getReach = [&](double x0, double x1, double y0, double y1)
  {
    const double bounds[6] = { x0, x1, y0, y1, 0, 0 };
    return probe->GetReach(bounds);
  };
  EXPECT_EQ(getReach(1, 2, 0, 1), 0);
  EXPECT_EQ(getReach(-3, -1, 0, 1), 0);
  EXPECT_EQ(getReach(0.5, 1.5, -1, 1), 0.5);
  EXPECT_EQ(getReach(0.9, 0.9, 0.9, 0.9), 1);
  EXPECT_EQ(getReach(-10, 10, -0.5, 0.5), 0.1);
  probe->SetOrientation(0, 0, 45);
  EXPECT_EQ(getReach(0.9, 0.9, 0.9, 0.9), 0); // 1.27 along its axis
  EXPECT_EQ(getReach(1.3, 1.3, 0, 0), 1);
  probe->SetProxy(vtkIBLProbe::Infinite);
  probe->SetInfluenceToBounds();
  EXPECT_EQ(getReach(1e9, 1e9, 0, 0), 1);
}

// What can't be meant is refused with the value, and nothing changes. Mutants: any of these checks left out.
TEST_F(TestProbesGL, RefusesWhatCannotBeMeant)
{
  vtkNew<vtkIBLProbe> probe;
  const double nan = std::nan("");
  const vtkMTimeType before = probe->GetMTime();
  const auto expectError = [&](const char* words)
  { EXPECT_NE(this->Messages.Take().find(words), std::string::npos) << words; };
  probe->SetBounds(1, 1, 0, 1, 0, 1);
  expectError("Bounds go from 1 to 1 along x");
  probe->SetBounds(0, 1, 1, 0, 0, 1);
  expectError("Bounds go from 1 to 0 along y");
  probe->SetBounds(0, 1, 0, 1, 0, nan);
  expectError("along z");
  probe->SetInfluenceBounds(0, 1, 0, std::numeric_limits<double>::infinity(), 0, 1);
  expectError("InfluenceBounds go from 0 to inf along y");
  probe->SetPosition(0, nan, 0);
  expectError("Position is 0 nan 0");
  probe->SetOrientation(nan, 0, 0);
  expectError("Orientation is nan");
  probe->SetBlendDistance(nan);
  expectError("BlendDistance is not a number");
  probe->SetIntensity(-1);
  expectError("Intensity is -1");
  vtkNew<vtkRenderer> empty;
  probe->FitToScene(empty);
  expectError("nothing visible");
  EXPECT_EQ(probe->GetMTime(), before);
  EXPECT_FALSE(probe->HasInfluenceBounds());
  vtkNew<vtkIBLRenderPass> pass;
  EXPECT_FALSE(pass->CaptureProbe(empty, probe));
  expectError("CaptureProbe() takes a renderer in a window");
}

// A surface outside the proxy but under its influence, the camera anywhere, a normal that points out of the room: light
// is finite, and where the surface lies on the wall, that wall's. Mutant: a ray that starts outside and misses.
TEST_F(TestProbesGL, OutsideTheProxyLightIsFinite)
{
  for (const int proxy : { vtkIBLProbe::Box, vtkIBLProbe::Ellipsoid, vtkIBLProbe::Infinite })
  {
    Scene scene(this->Window);
    const Room room{ proxy == vtkIBLProbe::Ellipsoid, { 0, 0, 0 }, { 1, 1, 1 } };
    scene.Probe->SetProxy(proxy);
    scene.Probe->SetInfluenceBounds(-9, 9, -9, 9, -9, 9);
    scene.Fill(room, { 0, 0, 0 });
    vtkNew<vtkSphereSource> sphere;
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    scene.Actor->SetMapper(mapper);
    for (const double x : { 0.0, 0.5, 1.0, 1.5, 5.0 })
    {
      scene.Actor->SetPosition(x, 0, 0);
      scene.LookAt({ x, 0, 2 }, { x, 0, 0 });
      const vtkSmartPointer<vtkImageData> picture = scene.Pass->CaptureRadiance(scene.Renderer);
      for (int j = 0; j < Size; ++j)
      {
        for (int i = 0; i < Size; ++i)
        {
          const auto* rgba = static_cast<const float*>(picture->GetScalarPointer(i, j, 0));
          for (int c = 0; c < 3 && rgba[3] > 0; ++c)
          {
            ASSERT_TRUE(rgba[c] >= 2.5 && rgba[c] <= 5.5) << proxy << " " << x << " " << rgba[c];
          }
        }
      }
    }
    this->Window->RemoveRenderer(scene.Renderer);
  }
}

// Rough reflections in a room, over places and views, against the integral of the lobe over the walls. What is left is
// the one lookup's error (a sky has it, too: 3 % at roughness 0.2, 10 % at 1) and that of one lobe seen from elsewhere;
// without parallax it is several times as much. Witness: half vectors of equal weight, rays by bisection.
// Measured: 1.3 3.6 5.0 5.7 8.8 12.9 %. Mutants: directions or irradiance that parallax does not turn (to 16 %);
// roughness as the surface has it (5.2 % at 0.3, 7.5 at 0.45).
TEST_F(TestProbesGL, RoughReflectionsFollowTheIntegral)
{
  const Room room{ false, { 0, 0, 0 }, { 1.5, 1.0, 1.25 } };
  const auto walls = [](Vec3 p)
  {
    const double x = std::sin(2.5 * p.x + 1) * std::sin(3 * p.y + 0.5) * std::cos(2 * p.z);
    return RGB{ 1 + 0.9 * x, 1 + 0.9 * std::sin(4 * p.x), 1 + 0.9 * std::cos(3 * p.z + p.y) };
  };
  const std::map<double, double> bounds = { { 0.15, 1.5 }, { 0.3, 4 }, { 0.45, 5.5 }, { 0.6, 6.3 }, { 0.8, 9.5 },
    { 1.0, 14 } };
  for (const auto& [roughness, bound] : bounds)
  {
    Scene scene(this->Window);
    scene.Probe->SetBounds(-1.5, 1.5, -1.0, 1.0, -1.25, 1.25);
    scene.Probe->SetPosition(0.2, 0.3, -0.1);
    scene.Probe->SetBlendDistance(0);
    scene.Pass->GetLighting()->EnergyCompensationOff();
    scene.Pass->GetProbes()->SetNumberOfSamples(256);
    scene.Actor->GetProperty()->SetRoughness(roughness);
    scene.FillWith(room, walls);
    double error[2] = {}; // without and with a proxy
    double total = 0;
    for (const double height : { -0.9, -0.5, 0.0 })
    {
      scene.SetFloor({ 0, height, 0 }, 1.0);
      scene.LookAt({ 0.3, height + 0.9, 0.8 }, { 0.1, height, -0.2 });
      scene.Probe->SetProxy(vtkIBLProbe::Infinite);
      const vtkSmartPointer<vtkImageData> far = scene.Pass->CaptureRadiance(scene.Renderer);
      scene.Probe->SetProxy(vtkIBLProbe::Box);
      const vtkSmartPointer<vtkImageData> near = scene.Pass->CaptureRadiance(scene.Renderer);
      const Vec3 eye = ToVec3(scene.Renderer->GetActiveCamera()->GetPosition());
      for (int j = 8; j < Size; j += 20)
      {
        for (int i = 8; i < Size; i += 20)
        {
          const Vec3 point = scene.GetFloorPoint(i, j, height);
          if (std::abs(point.x) < 0.95 && std::abs(point.z) < 0.95)
          {
            const RGB truth = vtkIBLReference::ReflectedRadiance(
              room, walls, point, { 0, 1, 0 }, Normalize(eye - point), roughness, 48);
            for (int c = 0; c < 3; ++c)
            {
              error[0] += std::abs(static_cast<const float*>(far->GetScalarPointer(i, j, 0))[c] - truth[c]);
              error[1] += std::abs(static_cast<const float*>(near->GetScalarPointer(i, j, 0))[c] - truth[c]);
              total += truth[c];
            }
          }
        }
      }
    }
    EXPECT_LE(100 * error[1] / total, bound) << roughness;
    EXPECT_LE(error[1], (roughness < 0.7 ? 0.6 : 0.85) * error[0])
      << roughness << " without: " << 100 * error[0] / total << " %";
    this->Window->RemoveRenderer(scene.Renderer);
  }
}

// One switch shows probes: balls of what they see, wires of what they reach, or surfaces in the colours of their
// shares. Off, the picture is what it was, bit for bit. Witnesses: a probe of one radiance, on a mirror and on white;
// the hues of probes 0 and 1 by hand, half of each where they meet. Mutants: balls captured or counted when hidden; the
// sky on them; shares of the wrong probe.
TEST_F(TestProbesGL, ProbesCanBeShown)
{
  Walker scene(this->Window);
  const RGB red = { 0.9, 0.1, 0.2 };
  const vtkSmartPointer<vtkIBLProbe> probe = scene.Add(-2, 2, red);
  scene.Actor->VisibilityOff();
  const RGB hidden = scene.GetLight(0);
  scene.Pass->SetProbeDisplay(vtkIBLRenderPass::ProbeIrradiance);
  EXPECT_NEAR(scene.GetLight(0)[0], red[0], 5e-3);
  scene.Pass->SetProbeDisplay(vtkIBLRenderPass::ProbeReflections);
  EXPECT_NEAR(scene.GetLight(0)[2], red[2], 5e-3);
  scene.Pass->SetProbeDisplayRoughness(0.5);
  EXPECT_NEAR(scene.GetLight(0)[0], red[0], 5e-3);
  scene.Pass->SetProbeDisplay(vtkIBLRenderPass::ProbesHidden);
  EXPECT_EQ(scene.GetLight(0), hidden);

  scene.Actor->VisibilityOn();
  scene.Actor->SetOrientation(0, 0, 0);
  const vtkSmartPointer<vtkIBLProbe> other = scene.Add(1, 6, { 0.1, 0.1, 0.1 });
  probe->SetBlendDistance(0.5);
  other->SetPosition(100, 100, 100); // its ball and the first's are elsewhere
  probe->SetPosition(100, 100, 100);
  scene.Pass->SetProbeDisplay(vtkIBLRenderPass::ProbeShares);
  const auto getHue = [](int number, int channel)
  { return 0.5 + 0.5 * std::cos(2 * vtkIBLReference::Pi * (0.381966 * number + channel / 3.0)); };
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(scene.GetLight(0)[c], getHue(0, c), 2e-3);
    EXPECT_NEAR(scene.GetLight(4)[c], getHue(1, c), 2e-3);
    EXPECT_NEAR(scene.GetLight(-1.75)[c], 0.5 * (getHue(0, c) + 0.5), 2e-3);
    EXPECT_NEAR(scene.GetLight(9)[c], 0.5, 2e-3);
  }
}
