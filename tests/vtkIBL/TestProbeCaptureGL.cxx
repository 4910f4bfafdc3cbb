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
#include <vtkHardwareSelector.h>
#include <vtkLight.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkReverseSense.h>
#include <vtkSelection.h>
#include <vtkShaderProperty.h>
#include <vtkSphereSource.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

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

// A cut picture of the sky has no seams: texels on both sides of an edge between faces differ no more than neighbours
// inside do. Mutants: a field of view of 89 degrees; pixel centres taken for corners.
TEST_F(TestProbeCaptureGL, FacesMeetWithoutASeam)
{
  Scene scene(this->Window);
  const vtkSmartPointer<vtkImageData> seen = scene.Pass->CaptureProbe(scene.Renderer, scene.Probe);
  ASSERT_TRUE(seen);
  const std::vector<Vec3> directions = GetCubeDirections(FaceSize);
  const auto get = [&](std::size_t i) { return static_cast<const float*>(seen->GetScalarPointer())[3 * i]; };
  double across = 0;
  double inside = 0;
  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const Vec3 apart = directions[i] - directions[j];
      if (Dot(apart, apart) < std::pow(2.1 / FaceSize, 2))
      {
        const std::size_t face = std::size_t(FaceSize) * FaceSize;
        const double steepness = std::abs(get(i) - get(j)) / std::sqrt(Dot(apart, apart));
        double& largest = i / face == j / face ? inside : across;
        largest = std::max(largest, steepness);
      }
    }
  }
  EXPECT_GT(inside, 0.3);
  EXPECT_LE(across, 1.05 * inside);
}

namespace
{
// Walls that reflect the share rho of what they get and send `emission` themselves, all around the probe.
vtkSmartPointer<vtkActor> MakeRoom(double rho, double emission)
{
  vtkNew<vtkCubeSource> cube;
  cube->SetBounds(-2, 2, -2, 2, -2, 2);
  vtkNew<vtkReverseSense> inwards;
  inwards->SetInputConnection(cube->GetOutputPort());
  inwards->ReverseNormalsOn();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(inwards->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetInterpolationToPBR();
  property->SetColor(rho, rho, rho);
  property->SetBaseIOR(1);
  vtkNew<vtkImageData> white;
  white->SetDimensions(2, 2, 1);
  white->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  std::fill_n(static_cast<unsigned char*>(white->GetScalarPointer()), 12, 255);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(white);
  texture->UseSRGBColorSpaceOn();
  property->SetEmissiveTexture(texture);
  property->SetEmissiveFactor(emission, emission, emission);
  return actor;
}
}

// A closed room whose walls shine and are matt: light that went back and forth n times is e + rho (e + rho (… s)), s
// the sky that lights them before. Exact, because it is the same everywhere. Mutants: the sky in every round; one round
// too many or too few; the light of the first capture in all.
TEST_F(TestProbeCaptureGL, LightBouncesAsOftenAsAsked)
{
  const double rho = 0.6;
  const double emission = 0.5;
  for (const int bounces : { 0, 1, 3 })
  {
    Scene scene(this->Window);
    scene.Environment->SetInputData(MakePanorama(16, [](Vec3) { return RGB{ 2, 2, 2 }; }));
    scene.Renderer->AddActor(MakeRoom(rho, emission));
    scene.Probe->SetBlendDistance(0);
    scene.Probe->SetBounds(-2.001, 2.001, -2.001, 2.001, -2.001, 2.001);
    scene.Probe->SetBounces(bounces);
    const vtkSmartPointer<vtkImageData> seen = scene.Pass->CaptureProbe(scene.Renderer, scene.Probe);
    ASSERT_TRUE(seen);
    EXPECT_EQ(scene.Render(), 6 * (bounces + 1));
    EXPECT_EQ(scene.Render(), 0);
    double light = 2;
    for (int i = 0; i <= bounces; ++i)
    {
      light = emission + rho * light;
    }
    EXPECT_LE(GetRelativeL1(seen, std::vector<RGB>(6 * FaceSize * FaceSize, RGB{ light, light, light })), 3e-3)
      << bounces;
    this->Window->RemoveRenderer(scene.Renderer);
  }
}

// Once means once, and again when asked; every frame, every frame; an interval, after it. What follows a lamp that
// moves with the camera is none of a probe's business (it would have to be captured whenever the view turns). Mutants:
// modes mixed up; headlights in the capture.
TEST_F(TestProbeCaptureGL, ModesSayWhen)
{
  Scene scene(this->Window);
  const vtkSmartPointer<vtkActor> block = scene.AddBlock(Blocks[0]);
  block->GetProperty()->LightingOn();
  scene.Probe->SetUpdateMode(vtkIBLProbe::Once);
  EXPECT_EQ(scene.Render(), 6);
  block->SetPosition(0.5, 0, 0);
  EXPECT_EQ(scene.Render(), 0);
  scene.Probe->Capture();
  EXPECT_EQ(scene.Render(), 6);
  EXPECT_EQ(scene.Render(), 0);
  scene.Probe->SetUpdateMode(vtkIBLProbe::EveryFrame);
  EXPECT_EQ(scene.Render(), 6);
  EXPECT_EQ(scene.Render(), 6);
  scene.Probe->SetUpdateMode(vtkIBLProbe::Interval);
  scene.Probe->SetUpdateInterval(1e8);
  EXPECT_EQ(scene.Render(), 0);
  scene.Probe->SetUpdateInterval(0);
  EXPECT_EQ(scene.Render(), 6);

  // The one light is a headlight, and the block's Phong shading shows nothing else: black.
  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  scene.Renderer->AddLight(headlight);
  scene.Environment->SetIntensity(0);
  const vtkSmartPointer<vtkImageData> seen = scene.Pass->CaptureProbe(scene.Renderer, scene.Probe);
  double range[2];
  seen->GetScalarRange(range);
  EXPECT_EQ(range[1], 0);
  vtkNew<vtkLight> lamp;
  lamp->SetLightTypeToSceneLight();
  lamp->SetPosition(-5, 0, 0);
  scene.Renderer->AddLight(lamp);
  scene.Pass->CaptureProbe(scene.Renderer, scene.Probe)->GetScalarRange(range);
  EXPECT_GT(range[1], 0.1);
}

// Under a budget, each frame takes one step and the light changes when all are done: six faces, mip levels, layers. It
// is then the light that a probe without a budget has. Mutants: light shown half made; a frame that goes on; one that
// stops for good.
TEST_F(TestProbeCaptureGL, ABudgetCutsAnUpdateIntoFrames)
{
  Scene scene(this->Window);
  const vtkSmartPointer<vtkActor> block = scene.AddBlock(Blocks[0]);
  EXPECT_EQ(scene.Render(), 6); // the first light is all there
  scene.Probe->SetTimeBudget(1e-6);
  const auto getPicture = [&]
  {
    scene.Window->Render();
    vtkNew<vtkUnsignedCharArray> rgba;
    scene.Window->GetRGBACharPixelData(0, 0, 63, 63, 0, rgba);
    return std::vector<unsigned char>(rgba->GetPointer(0), rgba->GetPointer(0) + rgba->GetNumberOfValues());
  };
  const std::vector<unsigned char> before = getPicture();
  scene.Probe->Capture(); // all six
  block->GetProperty()->SetColor(0, 0, 1);
  int frames = 0;
  std::vector<unsigned char> now;
  const vtkTypeInt64 updates = scene.Probe->GetNumberOfUpdates();
  vtkTypeInt64 faces = 0;
  for (; scene.Probe->GetNumberOfUpdates() == updates && frames < 100; ++frames)
  {
    EXPECT_TRUE(now.empty() || now == before) << frames;
    now = getPicture();
    const vtkTypeInt64 inThisFrame = scene.Render();
    faces += inThisFrame;
    EXPECT_LE(inThisFrame, 2); // this loop renders twice
  }
  EXPECT_EQ(faces, 6);
  EXPECT_GE(frames, 6); // six faces, levels and at least four layers, two a turn
  EXPECT_LT(frames, 20);
  const std::vector<unsigned char> after = getPicture();
  EXPECT_NE(after, before);
  scene.Probe->SetTimeBudget(0);
  scene.Probe->Capture();
  EXPECT_EQ(getPicture(), after);
}

// New light comes in as slowly as asked: in as many frames, in even parts. Witness: the mean of old and new by hand.
// Mutants: both in full at once; the old one gone at the start; a fade that never ends.
TEST_F(TestProbeCaptureGL, LightFadesInOverFrames)
{
  Scene scene(this->Window);
  scene.Environment->SetInputData(MakePanorama(16, [](Vec3) { return RGB{ 1, 1, 1 }; }));
  scene.Probe->SetFadeFrames(3);
  const auto getLight = [&]
  {
    const vtkSmartPointer<vtkImageData> picture = scene.Pass->CaptureRadiance(scene.Renderer);
    return double(*static_cast<const float*>(picture->GetScalarPointer(32, 32, 0)));
  };
  EXPECT_NEAR(getLight(), 1.0, 5e-3);
  scene.Environment->SetIntensity(5);
  for (const double share : { 0.25, 0.5, 0.75, 1.0, 1.0 })
  {
    EXPECT_NEAR(getLight(), 1.0 + 4.0 * share, 2e-2) << share;
  }
}

// Nobody sees it: no surface in its reach, none in sight, a scene of unlit surfaces, a selection. Mutants: every probe
// of the collection updated; probes asked about what is hidden or out of the picture; captures in a selection.
TEST_F(TestProbeCaptureGL, WhatNobodySeesIsNotCaptured)
{
  Scene scene(this->Window);
  scene.AddBlock(Blocks[0]);
  scene.Probe->SetInfluenceBounds(10, 11, 10, 11, 10, 11);
  EXPECT_EQ(scene.Render(), 0);
  scene.Probe->SetInfluenceToBounds();
  scene.Ball->VisibilityOff();
  EXPECT_EQ(scene.Render(), 0);
  scene.Ball->VisibilityOn();
  scene.Renderer->GetActiveCamera()->SetFocalPoint(0, 0, 10); // it looks away
  EXPECT_EQ(scene.Render(), 0);
  scene.Renderer->GetActiveCamera()->SetFocalPoint(0, 0, 0);
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.Renderer);
  selector->SetArea(0, 0, 63, 63);
  vtkSmartPointer<vtkSelection>::Take(selector->Select());
  EXPECT_EQ(scene.Probe->GetNumberOfCapturedFaces(), 0);
  EXPECT_EQ(scene.Render(), 6);
}

// One face captured anew leaves the other five as they were: the cube is the one that a full capture makes. Mutant: the
// other faces black, or another probe's.
TEST_F(TestProbeCaptureGL, FacesThatDidNotChangeStay)
{
  Scene scene(this->Window);
  const vtkSmartPointer<vtkActor> block = scene.AddBlock(Blocks[0]);
  scene.AddBlock(Blocks[1]);
  scene.Render();
  block->GetProperty()->SetColor(0.3, 0.3, 0.9);
  const vtkTypeInt64 faces = scene.Render();
  EXPECT_GE(faces, 1);
  EXPECT_LT(faces, 6);
  const auto getPicture = [&]
  {
    const vtkSmartPointer<vtkImageData> picture = scene.Pass->CaptureRadiance(scene.Renderer);
    const auto* rgba = static_cast<const float*>(picture->GetScalarPointer());
    return std::vector<float>(rgba, rgba + 4 * picture->GetNumberOfPoints());
  };
  const std::vector<float> inPart = getPicture();
  scene.Probe->Capture();
  EXPECT_EQ(getPicture(), inPart);
}

// A sun of one texel in a fine sky is not missed between the texels of a coarse capture: its energy is that of the sky.
// The capture reads the mip level of its own size. Mutant: the finest level.
TEST_F(TestProbeCaptureGL, SmallLightsOfTheSkyKeepTheirEnergy)
{
  Scene scene(this->Window);
  const vtkSmartPointer<vtkImageData> sky = MakePanorama(512, [](Vec3) { return RGB{ 0, 0, 0 }; });
  const int row = 300;
  auto* sun = static_cast<float*>(sky->GetScalarPointer(401, row, 0));
  sun[0] = sun[1] = sun[2] = 1e5f;
  scene.Environment->SetInputData(sky);
  const double pi = vtkIBLReference::Pi;
  const double power =
    1e5 * (2 * pi / 1024) * (std::sin((row + 1) * pi / 512 - pi / 2) - std::sin(row * pi / 512 - pi / 2));
  const vtkSmartPointer<vtkImageData> seen = scene.Pass->CaptureProbe(scene.Renderer, scene.Probe);
  double sum = 0;
  for (int face = 0; face < 6; ++face)
  {
    for (int j = 0; j < FaceSize; ++j)
    {
      for (int i = 0; i < FaceSize; ++i)
      {
        sum += GetTexel(seen, i, j, face)[0] * vtkIBLReference::CubeTexelSolidAngle(FaceSize, i, j);
      }
    }
  }
  EXPECT_NEAR(sum / power, 1, 0.05);
}

// A surface that shows NaN or infinity, by a shader of its own here, neither blackens nor blinds what the probe lights.
// Mutant: faces that are not cleaned.
TEST_F(TestProbeCaptureGL, BrokenPixelsAreNoLight)
{
  Scene scene(this->Window);
  for (const char* value : { "sqrt(-1.0 - abs(gl_FragCoord.x))", "1.0 / (gl_FragCoord.x - gl_FragCoord.x)" })
  {
    const vtkSmartPointer<vtkActor> block = scene.AddBlock(Blocks[0]);
    block->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", true,
      std::string("//VTK::Light::Impl\n  gl_FragData[0].rgb = vec3(") + value + ");\n", false);
    const vtkSmartPointer<vtkImageData> seen = scene.Pass->CaptureProbe(scene.Renderer, scene.Probe);
    double range[2] = { 0, 0 };
    for (int i = 0; i < seen->GetNumberOfPoints(); ++i)
    {
      const double x = seen->GetPointData()->GetScalars()->GetComponent(i, 0);
      ASSERT_TRUE(std::isfinite(x) && x >= 0 && x <= 1e10) << value;
      range[1] = std::max(range[1], x);
    }
    EXPECT_GT(range[1], 1);
    const vtkSmartPointer<vtkImageData> picture = scene.Pass->CaptureRadiance(scene.Renderer);
    EXPECT_TRUE(std::isfinite(*static_cast<float*>(picture->GetScalarPointer(32, 32, 0)))) << value;
    scene.Renderer->RemoveActor(block);
  }
}
