// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The pass in company: around and inside VTK's other passes, in several renderers and windows, beside a volume.
#include "TestScene.h"

#include "vtkIBLStatistics.h"

#include <vtkCameraPass.h>
#include <vtkDepthOfFieldPass.h>
#include <vtkDualDepthPeelingPass.h>
#include <vtkFramebufferPass.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkGaussianBlurPass.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkOpenGLFXAAPass.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPixelBufferObject.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderStepsPass.h>
#include <vtkSSAAPass.h>
#include <vtkSSAOPass.h>
#include <vtkSequencePass.h>
#include <vtkShadowMapBakerPass.h>
#include <vtkShadowMapPass.h>
#include <vtkSphereSource.h>
#include <vtkTextureObject.h>
#include <vtkToneMappingPass.h>
#include <vtkTranslucentPass.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <functional>
#include <numeric>

namespace
{
using Bytes = std::vector<unsigned char>; // RGBA
using Floats = std::vector<float>;        // RGBA
using Wrap = std::function<vtkSmartPointer<vtkRenderPass>(vtkRenderPass* scene)>;

// 1 on average, so that lit surfaces and sky go above what a display shows.
RGB Sky(Vec3 d)
{
  return { 1 + 0.3 * d.x, 1 + 0.8 * d.y, 1 + 0.3 * d.z };
}

template <typename Pass>
vtkSmartPointer<Pass> Around(vtkRenderPass* scene)
{
  auto pass = vtkSmartPointer<Pass>::New();
  pass->SetDelegatePass(scene);
  return pass;
}

vtkSmartPointer<vtkRenderPass> Ambient(vtkRenderPass* scene)
{
  auto pass = Around<vtkSSAOPass>(scene);
  pass->SetRadius(0.5);
  pass->SetBias(0.02);
  pass->SetKernelSize(64);
  pass->BlurOn();
  return pass;
}

vtkSmartPointer<vtkRenderPass> Toned(vtkRenderPass* scene, int type)
{
  auto pass = Around<vtkToneMappingPass>(scene);
  pass->SetToneMappingType(type);
  pass->SetExposure(0.7f);
  return pass;
}

vtkSmartPointer<vtkRenderPass> Shadowed()
{
  vtkNew<vtkShadowMapPass> shadows;
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(shadows->GetShadowMapBakerPass());
  passes->AddItem(shadows);
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  return Around<vtkCameraPass>(sequence);
}

vtkSmartPointer<vtkRenderPass> Peeled()
{
  vtkNew<vtkTranslucentPass> translucent;
  vtkNew<vtkDualDepthPeelingPass> peeling;
  peeling->SetTranslucentPass(translucent);
  auto steps = vtkSmartPointer<vtkRenderStepsPass>::New();
  steps->SetTranslucentPass(peeling);
  return steps;
}

int CountDifferences(const Bytes& a, const Bytes& b)
{
  return int(a.size() != b.size()) +
    std::inner_product(a.begin(), a.end(), b.begin(), 0, std::plus<>(), std::not_equal_to<>());
}

double Luma(const unsigned char* rgb)
{
  return (0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2]) / 255;
}
}

// A sphere of radius 0.5 that touches the floor y = 0, under one of VTK's lights: directional, since VTK's PBR knows no
// shadows of others.
class TestCompanyGL : public GLTest
{
protected:
  static constexpr int Size = 96;
  vtkNew<vtkSphereSource> Sphere;
  vtkNew<vtkPlaneSource> Plane;
  vtkNew<vtkActor> Ball;
  vtkNew<vtkActor> Floor;
  vtkNew<vtkLight> Light;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkIBLEnvironment> Environment;
  vtkNew<vtkIBLRenderPass> Pass;
  std::vector<vtkSmartPointer<vtkRenderPass>> Used; // VTK's want to be released while their window is there

  void SetUp() override
  {
    GLTest::SetUp();
    this->Window->SetSize(Size, Size);
    this->Sphere->SetCenter(0, 0.5, 0);
    this->Sphere->SetThetaResolution(64);
    this->Sphere->SetPhiResolution(64);
    this->Plane->SetOrigin(-3, 0, 3);
    this->Plane->SetPoint1(3, 0, 3);
    this->Plane->SetPoint2(-3, 0, -3);
    this->SetUpActor(this->Ball, this->Sphere);
    this->SetUpActor(this->Floor, this->Plane);
    this->Light->SetPosition(2, 3, 1);
    this->Light->SetColor(0.8, 0.7, 0.6);
    this->Environment->SetInputData(MakePanorama(32, Sky));
    this->Pass->SetEnvironment(this->Environment);
    this->SetUpRenderer(this->Renderer);
    this->Window->AddRenderer(this->Renderer);
  }

  static void SetUpActor(vtkActor* actor, vtkPolyDataAlgorithm* source)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    actor->SetMapper(mapper);
    actor->GetProperty()->SetInterpolationToPBR();
    actor->GetProperty()->SetColor(0.9, 0.7, 0.5);
    actor->GetProperty()->SetRoughness(0.4);
    actor->GetProperty()->SetMetallic(0.3);
  }

  void SetUpRenderer(vtkRenderer* renderer)
  {
    renderer->AddActor(this->Ball);
    renderer->AddActor(this->Floor);
    renderer->AddLight(this->Light);
    renderer->SetBackground(0.1, 0.2, 0.3);
    renderer->GetActiveCamera()->SetPosition(0.5, 2, 4);
    renderer->GetActiveCamera()->SetFocalPoint(0, 0.4, 0);
    renderer->GetActiveCamera()->SetClippingRange(0.5, 12);
  }

  // The same scene in another window, by actors of its own.
  void SetUpWindow(vtkIBLOffscreenWindow* window, vtkRenderer* renderer, vtkRenderPass* pass)
  {
    window->DebugContextOn();
    window->SetSize(Size, Size);
    vtkNew<vtkActor> ball;
    vtkNew<vtkActor> floor;
    this->SetUpActor(ball, this->Sphere);
    this->SetUpActor(floor, this->Plane);
    this->SetUpRenderer(renderer);
    renderer->RemoveAllViewProps();
    renderer->AddActor(ball);
    renderer->AddActor(floor);
    renderer->SetPass(pass);
    window->AddRenderer(renderer);
  }

  void TearDown() override
  {
    this->Renderer->SetPass(nullptr);
    for (vtkRenderPass* pass : this->Used)
    {
      pass->ReleaseGraphicsResources(this->Window);
    }
    GLTest::TearDown();
  }

  Bytes Render(vtkRenderPass* pass)
  {
    if (pass)
    {
      this->Used.emplace_back(pass);
    }
    this->Renderer->SetPass(pass);
    this->Window->Render();
    return GetPicture(this->Window);
  }

  // What `pass` writes, in floats.
  Floats Capture(vtkRenderPass* pass)
  {
    this->Used.emplace_back(pass);
    auto framebuffer = Around<vtkFramebufferPass>(pass);
    framebuffer->SetColorFormat(vtkTextureObject::Float32);
    framebuffer->SetDepthFormat( // as the window's, or VTK cannot copy it for its translucent pass
      this->Window->GetDepthBufferSize() == 32 ? vtkTextureObject::Fixed32 : vtkTextureObject::Fixed24);
    this->Renderer->SetPass(framebuffer);
    this->Window->Render();
    Floats rgba(4 * Size * Size);
    unsigned int size[2] = { Size, Size };
    vtkIdType gaps[2] = { 0, 0 };
    vtkPixelBufferObject* pixels = framebuffer->GetColorTexture()->Download();
    pixels->Download2D(VTK_FLOAT, rgba.data(), size, 4, gaps);
    pixels->Delete();
    this->Renderer->SetPass(nullptr);
    framebuffer->SetDelegatePass(nullptr);
    framebuffer->ReleaseGraphicsResources(this->Window);
    return rgba;
  }

  // At intensity 0 the picture through our pass is the one without it, byte for byte; at 1 it is brighter.
  void ExpectOnlyLightIsAdded(const char* what, vtkRenderPass* without, vtkRenderPass* with)
  {
    const Bytes own = this->Render(without);
    this->Environment->SetIntensity(0.0);
    EXPECT_EQ(CountDifferences(this->Render(with), own), 0) << what;
    this->Environment->SetIntensity(1.0);
    const Bytes lit = this->Render(with);
    long brighter = 0;
    for (std::size_t i = 0; i < lit.size(); ++i)
    {
      brighter += lit[i] > own[i] + 20;
    }
    EXPECT_GT(brighter, 2000) << what;
    EXPECT_EQ(this->Messages.Take(), "") << what;
  }
};

// Whatever stands around our pass or inside it gets VTK's own picture when there is no light to add: same size, same
// place, same order. Mutants: the outer framebuffer's size not minded (supersampling showed the scene in a corner), a
// pass's key dropped.
TEST_F(TestCompanyGL, AddsLightThroughEveryChain)
{
  const Wrap outer[] = { Around<vtkSSAAPass>, Around<vtkOpenGLFXAAPass>, Around<vtkFramebufferPass>,
    Around<vtkGaussianBlurPass>, Around<vtkDepthOfFieldPass>, Ambient,
    [](vtkRenderPass* scene) { return Toned(scene, vtkToneMappingPass::Reinhard); },
    [](vtkRenderPass* scene) { return Around<vtkSSAAPass>(Ambient(scene)); } };
  const char* names[] = { "SSAA", "FXAA", "framebuffer", "blur", "depth of field", "SSAO", "tone mapping",
    "SSAA around SSAO" };
  vtkNew<vtkRenderStepsPass> steps;
  for (int i = 0; i < 8; ++i)
  {
    const std::string what = names[i];
    this->Pass->SetDelegatePass(nullptr);
    this->ExpectOnlyLightIsAdded((what + " around").c_str(), outer[i](steps), outer[i](this->Pass));
    this->Pass->SetDelegatePass(steps);
    this->ExpectOnlyLightIsAdded((what + " around, steps inside").c_str(), outer[i](steps), outer[i](this->Pass));
    const vtkSmartPointer<vtkRenderPass> inner = outer[i](steps);
    this->Pass->SetDelegatePass(inner);
    this->ExpectOnlyLightIsAdded((what + " inside").c_str(), inner, this->Pass);
  }
  this->Pass->SetDelegatePass(Shadowed());
  this->ExpectOnlyLightIsAdded("shadows", Shadowed(), this->Pass);
}

// A picture of one colour is the mean of itself. 1: rounding to bytes twice. Mutant: a corner of the picture only.
TEST_F(TestCompanyGL, SupersamplingKeepsOneColour)
{
  this->Environment->SetInputData(MakePanorama(16, [](Vec3) { return RGB{ 0.3, 0.5, 0.8 }; }));
  this->Pass->BackgroundVisibleOn();
  this->Renderer->RemoveAllViewProps();
  for (const Wrap& wrap : { Wrap(Around<vtkSSAAPass>), Wrap(Around<vtkOpenGLFXAAPass>), Wrap(Ambient) })
  {
    const Bytes picture = this->Render(wrap(this->Pass));
    for (std::size_t i = 0; i < picture.size(); ++i)
    {
      const double radiance = i % 4 == 0 ? 0.3 : i % 4 == 1 ? 0.5 : i % 4 == 2 ? 0.8 : 1.0;
      ASSERT_NEAR(picture[i], 255 * std::pow(radiance, 1 / 2.2), 1.5) << i;
    }
  }
}

// FXAA blends where a pixel differs from its neighbours by 1/16 of luma or more, and nowhere else.
TEST_F(TestCompanyGL, FXAAChangesOnlyEdges)
{
  this->Environment->SetIntensity(0.5);
  const Bytes plain = this->Render(this->Pass);
  const Bytes smooth = this->Render(Around<vtkOpenGLFXAAPass>(this->Pass));
  int changed = 0;
  for (int j = 1; j < Size - 1; ++j)
  {
    for (int i = 1; i < Size - 1; ++i)
    {
      const int at = 4 * (j * Size + i);
      double low = 1;
      double high = 0;
      for (int neighbour : { 0, 4, -4, 4 * Size, -4 * Size })
      {
        low = std::min(low, Luma(&plain[at + neighbour]));
        high = std::max(high, Luma(&plain[at + neighbour]));
      }
      const bool same = std::equal(&plain[at], &plain[at + 3], &smooth[at]);
      changed += !same;
      if (high - low < 0.05)
      {
        ASSERT_TRUE(same) << i << " " << j;
      }
    }
  }
  EXPECT_GT(changed, 50);
}

// Tone mapping takes display-encoded floats, decodes, maps, encodes: so Display below it, its framebuffer holds what a
// display does not, and the picture is its curve of the radiance. 1.5: one rounding to bytes, and the two powers.
// Mutants: Linear below it (15 of 255 too dark), a framebuffer of bytes (all above 1 the same).
TEST_F(TestCompanyGL, ToneMappingMapsRadiance)
{
  this->Environment->SetIntensity(2.0);
  this->Pass->BackgroundVisibleOn();
  this->Renderer->SetPass(this->Pass);
  vtkSmartPointer<vtkImageData> radiance = this->Pass->CaptureRadiance(this->Renderer);
  const auto* linear = static_cast<const float*>(radiance->GetScalarPointer());
  const std::pair<int, std::function<double(double)>> curves[] = {
    { vtkToneMappingPass::Clamp, [](double c) { return std::min(c, 1.0); } },
    { vtkToneMappingPass::Reinhard, [](double c) { return c / (c + 1); } },
    { vtkToneMappingPass::Exponential, [](double c) { return 1 - std::exp(-0.7 * c); } },
  };
  for (const auto& [type, curve] : curves)
  {
    const Bytes picture = this->Render(Toned(this->Pass, type));
    int bright = 0;
    for (std::size_t i = 0; i < picture.size(); ++i)
    {
      if (i % 4 < 3)
      {
        bright += linear[i] > 2;
        ASSERT_NEAR(picture[i], 255 * std::pow(curve(linear[i]), 1 / 2.2), 1.5) << "type " << type << " " << linear[i];
      }
    }
    EXPECT_GT(bright, 1000);
  }
}

// Occlusion only darkens, and darkens most where sphere and floor touch; the environment behind them occludes nothing,
// so that a lone sphere before it stays as it is. 1e-3: the sphere's facets, at its silhouette. Mutant: the background
// leaving VTK's buffer of positions undefined.
TEST_F(TestCompanyGL, AmbientOcclusionDarkens)
{
  this->Pass->BackgroundVisibleOn();
  const Floats plain = this->Capture(this->Pass);
  vtkNew<vtkRenderStepsPass> steps;
  for (bool inside : { false, true })
  {
    this->Pass->SetDelegatePass(inside ? Ambient(steps) : nullptr);
    const vtkSmartPointer<vtkRenderPass> chain = inside ? this->Pass : Ambient(this->Pass);
    const Floats occluded = this->Capture(chain);
    double least = 1;
    for (std::size_t i = 0; i < plain.size(); ++i)
    {
      ASSERT_LE(occluded[i], plain[i] + 1e-5);
      least = std::min(least, double(occluded[i] / plain[i]));
    }
    EXPECT_LT(least, 0.7);
    this->Floor->VisibilityOff();
    const Floats lone = this->Capture(chain);
    this->Pass->SetDelegatePass(nullptr);
    const Floats loneAlone = this->Capture(this->Pass);
    const double sum = std::accumulate(lone.begin(), lone.end(), 0.0);
    EXPECT_NEAR(sum / std::accumulate(loneAlone.begin(), loneAlone.end(), 0.0), 1.0, 1e-3) << "inside " << inside;
    this->Floor->VisibilityOn();
  }
}

// Shadows are VTK's light's alone: what the environment adds is the same with and without that light, in the shadow and
// out of it. 2e-4 of 1: floats, and VTK's D near 0. Mutant: the environment's term multiplied by the shadow.
TEST_F(TestCompanyGL, ShadowsLeaveTheEnvironmentAlone)
{
  this->Pass->SetDelegatePass(Shadowed());
  this->Pass->SetOutputEncoding(vtkIBLRenderPass::Linear);
  const Floats both = this->Capture(this->Pass);
  this->Environment->SetIntensity(0.0);
  const Floats light = this->Capture(this->Pass);
  this->Environment->SetIntensity(1.0);
  this->Renderer->RemoveAllLights();
  const Floats environment = this->Capture(this->Pass);
  int shadow = 0;
  int sunny = 0;
  for (int j = 0; j < Size; ++j)
  {
    for (int i = 0; i < Size; ++i)
    {
      const int at = 4 * (j * Size + i);
      if (both[at + 3] < 1)
      {
        continue; // background
      }
      shadow += light[at] < 0.005;
      sunny += light[at] > 0.04;
      for (int k = 0; k < 3; ++k)
      {
        ASSERT_NEAR(both[at + k] - light[at + k], environment[at + k], 2e-4) << i << " " << j;
        ASSERT_GT(environment[at + k], 0.05);
      }
    }
  }
  EXPECT_GT(shadow, 100);
  EXPECT_GT(sunny, 1000);
}

// Two white walls of opacity 1/2 in white light, before a background of radiance b: 1/2 + 1/4 + b/4, however the peels
// are made. 2e-3: half floats of the light, bytes of the peels.
TEST_F(TestCompanyGL, PeelsShowTheSumOfLayers)
{
  this->Environment->SetInputData(MakePanorama(16, [](Vec3) { return RGB{ 1, 1, 1 }; }));
  this->Pass->SetOutputEncoding(vtkIBLRenderPass::Linear);
  this->Renderer->RemoveAllLights();
  this->Renderer->RemoveAllViewProps();
  this->Window->AlphaBitPlanesOn();
  vtkNew<vtkActor> walls[2];
  for (int i = 0; i < 2; ++i)
  {
    this->SetUpActor(walls[i], this->Plane);
    walls[i]->RotateX(90);
    walls[i]->SetPosition(0, 0, i - 0.5);
    walls[i]->GetProperty()->SetColor(1, 1, 1);
    walls[i]->GetProperty()->SetMetallic(1);
    walls[i]->GetProperty()->SetOpacity(0.5);
    this->Renderer->AddActor(walls[i]);
  }
  auto expectSum = [&](const char* what)
  {
    const Floats picture = this->Capture(this->Pass);
    const float* centre = &picture[4 * (Size / 2 * Size + Size / 2)];
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(centre[k], 0.75 + 0.25 * 0.1 * (k + 1), 4e-3) << what;
    }
    EXPECT_EQ(this->Messages.Take(), "") << what;
  };
  expectSum("blended without order");
  this->Renderer->UseDepthPeelingOn();
  this->Renderer->SetMaximumNumberOfPeels(8);
  expectSum("the renderer's peels");
  this->Pass->SetDelegatePass(Peeled());
  expectSum("a pass's peels");

  // An opaque wall hides the translucent one behind it from a capture, too. Mutant: a framebuffer of another depth.
  this->Renderer->UseDepthPeelingOff();
  this->Pass->SetDelegatePass(nullptr);
  walls[1]->GetProperty()->SetOpacity(1.0);
  walls[1]->GetProperty()->SetColor(0, 0, 0);
  this->Renderer->SetPass(this->Pass);
  EXPECT_NEAR(
    this->Pass->CaptureRadiance(this->Renderer)->GetScalarComponentAsDouble(Size / 2, Size / 2, 0, 0), 0.0, 0.01);
}

// Side by side, in layers, with a pass each or one for all: each renderer shows what it shows alone. A capture of one
// has its size and its picture.
TEST_F(TestCompanyGL, ServesSeveralRenderers)
{
  const Bytes alone = this->Render(this->Pass);
  this->Renderer->SetPass(this->Pass);
  vtkSmartPointer<vtkImageData> radiance = this->Pass->CaptureRadiance(this->Renderer);
  vtkNew<vtkRenderer> other;
  this->SetUpRenderer(other);
  this->Window->SetSize(2 * Size, Size);
  this->Window->AddRenderer(other);
  this->Renderer->SetViewport(0, 0, 0.5, 1);
  other->SetViewport(0.5, 0, 1, 1);
  vtkNew<vtkIBLRenderPass> otherPass;
  otherPass->SetEnvironment(this->Environment);
  for (vtkIBLRenderPass* pass : { otherPass.Get(), this->Pass.Get() })
  {
    other->SetPass(pass);
    this->Window->Render();
    const Bytes both = GetPicture(this->Window);
    for (int j = 0; j < Size; ++j)
    {
      ASSERT_TRUE(std::equal(&alone[4 * j * Size], &alone[4 * j * Size] + 4 * Size, &both[8 * j * Size])) << j;
      ASSERT_TRUE(std::equal(&alone[4 * j * Size], &alone[4 * j * Size] + 4 * Size, &both[8 * j * Size + 4 * Size]))
        << j;
    }
    vtkSmartPointer<vtkImageData> right = pass->CaptureRadiance(other);
    ASSERT_EQ(right->GetDimensions()[0], Size);
    const auto* seen = static_cast<const float*>(right->GetScalarPointer());
    const auto* truth = static_cast<const float*>(radiance->GetScalarPointer());
    for (int i = 0; i < 4 * Size * Size; ++i)
    {
      ASSERT_NEAR(seen[i], truth[i], 3e-5) << i;
    }
  }
  // The sphere in a layer above the floor's: where it covers, it shows as it does alone.
  this->Window->RemoveRenderer(other);
  this->Window->SetSize(Size, Size);
  this->Renderer->SetViewport(0, 0, 1, 1);
  this->Renderer->RemoveActor(this->Floor);
  const Bytes sphere = this->Render(this->Pass);
  this->Renderer->RemoveActor(this->Ball);
  this->Renderer->AddActor(this->Floor);
  const Bytes floor = this->Render(this->Pass);
  other->RemoveActor(this->Floor);
  other->SetViewport(0, 0, 1, 1);
  other->SetLayer(1);
  this->Window->SetNumberOfLayers(2);
  this->Window->AddRenderer(other);
  const Bytes layers = this->Render(this->Pass);
  int covered = 0;
  for (std::size_t i = 0; i < layers.size(); i += 4)
  {
    const bool above = sphere[i] != sphere[0] || sphere[i + 1] != sphere[1];
    covered += above;
    ASSERT_TRUE(std::equal(&layers[i], &layers[i] + 3, above ? &sphere[i] : &floor[i])) << i;
  }
  EXPECT_GT(covered, 400);
}

// Windows, each with a context and a pass of its own, share one environment: it is read and analysed once.
TEST_F(TestCompanyGL, SharesAnEnvironmentAmongWindows)
{
  const OwnCache cache;
  this->Environment->SetInputData(MakePanorama(64, Sky));
  const Bytes first = this->Render(this->Pass);
  for (int i = 0; i < 2; ++i)
  {
    vtkNew<vtkIBLOffscreenWindow> window;
    vtkNew<vtkIBLRenderPass> pass;
    pass->SetEnvironment(this->Environment);
    vtkNew<vtkRenderer> renderer;
    this->SetUpWindow(window, renderer, pass);
    window->Render();
    EXPECT_EQ(window->GetNumberOfHighSeverityMessages(), 0) << window->GetLastHighSeverityMessage();
    EXPECT_EQ(CountDifferences(GetPicture(window), first), 0);
    EXPECT_EQ(CountDifferences(this->Render(this->Pass), first), 0); // turn by turn
  }
  EXPECT_EQ(this->Environment->GetStatistics()->GetCount(vtkIBLStatistics::Read), 1);
  EXPECT_EQ(this->Environment->GetStatistics()->GetCount(vtkIBLStatistics::Harmonics), 1);
}

// One pass moves from window to window, and back, its background with it; both windows live on. Mutant: the
// background's program of the first window used in the second.
TEST_F(TestCompanyGL, MovesAmongWindows)
{
  this->Pass->BackgroundVisibleOn();
  const Bytes first = this->Render(this->Pass);
  this->Renderer->SetPass(nullptr);
  vtkNew<vtkIBLOffscreenWindow> window;
  vtkNew<vtkRenderer> renderer;
  this->SetUpWindow(window, renderer, this->Pass);
  window->Render();
  EXPECT_EQ(window->GetNumberOfHighSeverityMessages(), 0) << window->GetLastHighSeverityMessage();
  EXPECT_EQ(CountDifferences(GetPicture(window), first), 0);
  renderer->SetPass(nullptr);
  EXPECT_EQ(CountDifferences(this->Render(this->Pass), first), 0);
  // A renderer moves with all it has.
  this->Window->RemoveRenderer(this->Renderer);
  window->RemoveRenderer(renderer);
  window->AddRenderer(this->Renderer);
  window->Render();
  EXPECT_EQ(window->GetNumberOfHighSeverityMessages(), 0) << window->GetLastHighSeverityMessage();
  EXPECT_EQ(CountDifferences(GetPicture(window), first), 0);
  window->RemoveRenderer(this->Renderer);
  this->Renderer->ReleaseGraphicsResources(window);
}

// A volume in the scene stays as it is, in front of surfaces that are lit, with and without depth peeling.
TEST_F(TestCompanyGL, LeavesVolumesAlone)
{
  vtkNew<vtkImageData> fog;
  fog->SetDimensions(16, 16, 16);
  fog->SetOrigin(-1, 0.1, 0.6);
  fog->SetSpacing(0.06, 0.06, 0.06);
  fog->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  std::fill_n(static_cast<unsigned char*>(fog->GetScalarPointer()), fog->GetNumberOfPoints(), 100);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0, 0.2);
  vtkNew<vtkGPUVolumeRayCastMapper> mapper;
  mapper->SetInputData(fog);
  mapper->UseJitteringOff();
  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  volume->GetProperty()->SetScalarOpacity(opacity);
  this->Renderer->AddVolume(volume);
  this->Window->AlphaBitPlanesOn();
  this->ExpectOnlyLightIsAdded("volume", nullptr, this->Pass);
  this->Ball->GetProperty()->SetOpacity(0.5);
  this->Renderer->UseDepthPeelingOn();
  this->ExpectOnlyLightIsAdded("volume and peels", nullptr, this->Pass);
  this->Renderer->UseDepthPeelingForVolumesOn();
  this->ExpectOnlyLightIsAdded("volume in the peels", nullptr, this->Pass);
  this->Renderer->RemoveAllViewProps();
  this->Renderer->AddVolume(volume);
  const Bytes own = this->Render(nullptr);
  EXPECT_EQ(CountDifferences(this->Render(this->Pass), own), 0);
  EXPECT_NE(std::count(own.begin(), own.end(), own[0]), long(own.size() / 4)); // it is to be seen
  EXPECT_EQ(this->Messages.Take(), "");
}
