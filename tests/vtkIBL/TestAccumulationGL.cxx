// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The sampled mode over frames: what the mean converges to, what starts it anew, and what it leaves alone.
#include "TestScene.h"

#include <vtkActor2D.h>
#include <vtkHardwareSelector.h>
#include <vtkLight.h>
#include <vtkPlane.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderStepsPass.h>
#include <vtkSelection.h>
#include <vtkSphereSource.h>
#include <vtkTexture.h>
#include <vtkTransform.h>
#include <vtkUnsignedCharArray.h>

namespace reference = vtkIBLReference;

namespace
{
constexpr int Size = 32;

// Radiance, smooth, that tells directions apart.
RGB Coloured(Vec3 d)
{
  return { 0.6 + 0.4 * d.x, 0.6 + 0.4 * d.y, 0.6 + 0.4 * d.z };
}
}

// Every pixel sees the same: so many independent estimates of one integral.
class TestAccumulationGL : public PlaneScene
{
protected:
  void SetUp() override
  {
    PlaneScene::SetUp();
    this->Window->SetSize(Size, Size);
    this->Environment->SetInputData(MakePanorama(32, Coloured));
    this->SetSamples(16);
    this->SetMaterial(1.0, 0.5, { 0.9, 0.6, 0.3 });
  }
  void SetSamples(int samples) { this->Pass->GetLighting()->SetSamplesPerPixel(samples); }
  // How many samples the picture has after so many frames more.
  int Render(int frames = 1)
  {
    for (int i = 0; i < frames; ++i)
    {
      this->Window->Render();
    }
    return this->Pass->GetAccumulatedSamples();
  }
  std::vector<unsigned char> GetPictureAfter(int frames)
  {
    this->Render(frames);
    return GetPicture(this->Window);
  }
  // Of green, relative, over all pixels of a picture of linear radiance: how far the mean is off, and the rms.
  struct Error
  {
    double Mean = 0.0;
    double Rms = 0.0;
  };
  Error CaptureError(int frames, double truth)
  {
    vtkSmartPointer<vtkImageData> image;
    for (int i = 0; i < frames; ++i)
    {
      image = this->Pass->CaptureRadiance(this->Renderer);
    }
    const auto* rgba = static_cast<const float*>(image->GetScalarPointer());
    Error error;
    for (int i = 0; i < Size * Size; ++i)
    {
      const double off = rgba[4 * i + 1] / truth - 1;
      error.Mean += off / (Size * Size);
      error.Rms += off * off / (Size * Size);
    }
    error.Rms = std::sqrt(error.Rms);
    return error;
  }
};

// 16 frames of 64 samples are one of 1024, and both the reflection integral: Lambert's base and the GGX lobe, by
// double-precision quadrature over a real HDRI. Measured: mean off by 0.5 %, 1.2 % rms a pixel at most, 1.7 and 4 % on
// metal of 0.2, whose lobe is thin; single frames of 1024 have 0.2 and 1.4, 1.5 and 3.7. Mutants: the same samples in
// every frame (rms 6 %), the mip level of one frame's samples (mean 1.3 %, metal of 0.2 21 %), a frame's weight of 1/2.
TEST_F(TestAccumulationGL, ConvergesToTheIntegral)
{
  const std::string path = GetHDRI("courtyard");
  if (path.empty())
  {
    GTEST_SKIP() << "no HDRIs: install blender-data";
  }
  this->Environment->SetFileName(path.c_str());
  ASSERT_TRUE(this->Environment->Update());
  const reference::Environment environment = ToReference(this->Environment->GetRadianceImage());
  this->Pass->GetLighting()->EnergyCompensationOff();
  const double NoV = 0.6;
  this->SetNoV(NoV);
  for (double metallic : { 0.0, 1.0 })
  {
    for (double roughness : { 0.2, 0.5, 1.0 })
    {
      const RGB color = { 0.9, 0.6, 0.3 };
      const RGB f0 = metallic > 0 ? color : RGB{ 0.04, 0.04, 0.04 };
      const double truth = reference::FullBRDFRadiance(
        environment, { std::sqrt(1 - NoV * NoV), 0, NoV }, { 0, 0, 1 }, roughness, f0, metallic > 0 ? RGB{} : color)[1];
      this->SetMaterial(metallic, roughness, color);
      this->SetSamples(1024);
      const Error whole = this->CaptureError(1, truth);
      this->SetSamples(64);
      const Error first = this->CaptureError(1, truth);
      const Error summed = this->CaptureError(15, truth);
      ASSERT_EQ(this->Pass->GetAccumulatedSamples(), 1024);
      const double scale = metallic > 0 && roughness < 0.3 ? 4.0 : 1.0;
      EXPECT_NEAR(summed.Mean, 0.0, 8e-3 * scale) << metallic << " " << roughness;
      EXPECT_LT(summed.Rms, 0.015 * scale) << metallic << " " << roughness;
      EXPECT_LT(summed.Rms, 1.5 * whole.Rms) << metallic << " " << roughness;
      EXPECT_GT(first.Rms, 3.0 * summed.Rms) << metallic << " " << roughness;
    }
  }
}

// Four times the frames, from 16 samples on to 4096: 0.5 of the error, then a third and less, by a lattice. Mutants: a
// weight that does not fall, the last frames only.
TEST_F(TestAccumulationGL, ErrorFallsWithFrames)
{
  const double roughness = 0.5;
  this->Pass->GetLighting()->EnergyCompensationOff();
  this->Environment->SetInputData(MakePanorama(64,
    [](Vec3 d) {
      return d.z > 0.5 && d.x > 0 ? RGB{ 4, 4, 4 } : RGB{ 0.1, 0.1, 0.1 };
    }));
  ASSERT_TRUE(this->Environment->Update());
  const double truth = reference::FullBRDFRadiance(
    ToReference(this->Environment->GetRadianceImage()), { 0, 0, 1 }, { 0, 0, 1 }, roughness, { 0.9, 0.6, 0.3 }, {})[1];
  double last = this->CaptureError(1, truth).Rms;
  for (int more : { 3, 12, 48, 192 })
  {
    const double error = this->CaptureError(more, truth).Rms;
    EXPECT_LT(error, 0.6 * last) << this->Pass->GetAccumulatedSamples();
    last = error;
  }
}

// One sample of light that is there or not: the mean is of radiance, so about half the bright one's; the mean of
// display values, decoded, would be 0.5^2.2, a fifth. 3 %: 256 samples, and steps of 8 bits. Mutants: no decoding,
// decoding alone.
TEST_F(TestAccumulationGL, MeanIsOfRadiance)
{
  this->Environment->SetInputData(MakePanorama(64, [](Vec3 d) { return d.x > 0 ? RGB{ 0.9, 0.9, 0.9 } : RGB{}; }));
  this->SetMaterial(1.0, 1.0, { 1, 1, 1 });
  this->Pass->GetLighting()->EnergyCompensationOff();
  this->SetNoV(1.0);
  this->SetSamples(1);
  const std::vector<unsigned char> picture = this->GetPictureAfter(256);
  double mean = 0.0;
  for (int i = 0; i < Size * Size; ++i)
  {
    mean += std::pow(picture[4 * i + 1] / 255.0, 2.2) / (Size * Size);
  }
  EXPECT_NEAR(mean / (0.45 * reference::DirectionalAlbedo(1.0, 1.0)), 1.0, 0.03);
}

// Each change by itself, found by one frame, which starts anew; and rest, which does not. Mutant: any line of
// vtkIBLStamp or GetStamp() left out.
TEST_F(TestAccumulationGL, ChangesStartAnew)
{
  vtkNew<vtkLight> light;
  light->SetIntensity(0.1);
  this->Renderer->AddLight(light);
  vtkNew<vtkSphereSource> outline;
  vtkNew<vtkPolyDataMapper2D> flatMapper;
  flatMapper->SetInputConnection(outline->GetOutputPort());
  vtkNew<vtkActor2D> overlay;
  overlay->SetMapper(flatMapper);
  this->Renderer->AddViewProp(overlay);
  vtkNew<vtkSphereSource> source;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkPlane> plane;
  mapper->AddClippingPlane(plane);
  vtkNew<vtkActor> sphere;
  sphere->SetMapper(mapper);
  vtkNew<vtkTransform> transform;
  sphere->SetUserTransform(transform);
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->UseSRGBColorSpaceOn();
  sphere->GetProperty()->SetBaseColorTexture(texture);
  this->Renderer->AddActor(sphere);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  vtkIBLLighting* lighting = this->Pass->GetLighting();
  vtkNew<vtkRenderStepsPass> steps;

  const std::vector<std::pair<const char*, std::function<void()>>> changes = {
    { "camera", [&] { camera->Azimuth(1); } },
    { "zoom", [&] { camera->SetParallelScale(0.9); } },
    { "clipping range", [&] { camera->SetClippingRange(2, 4000); } },
    { "view transform", [&] { camera->SetUserViewTransform(transform); } },
    { "material", [&] { this->Actor->GetProperty()->SetRoughness(0.6); } },
    { "placement", [&] { this->Actor->RotateY(1); } },
    { "user transform", [&] { transform->Translate(0.1, 0, 0); } },
    { "geometry", [&] { source->SetRadius(0.3); } },
    { "clipping plane", [&] { plane->SetOrigin(0.1, 0, 0); } },
    { "texels", [&] { image->Modified(); } },
    { "visibility off", [&] { sphere->VisibilityOff(); } },
    { "visibility on", [&] { sphere->VisibilityOn(); } },
    { "a prop less", [&] { this->Renderer->RemoveActor(sphere); } },
    { "a prop more", [&] { this->Renderer->AddActor(sphere); } },
    { "overlay", [&] { outline->SetRadius(2); } },
    { "overlay's colour", [&] { overlay->GetProperty()->SetColor(1, 0, 0); } },
    { "light", [&] { light->SetIntensity(0.2); } },
    { "light off", [&] { light->SwitchOff(); } },
    { "no light", [&] { this->Renderer->RemoveLight(light); } },
    { "source of light", [&] { this->Environment->SetInputData(MakePanorama(16, Coloured)); } },
    { "intensity", [&] { this->Environment->SetIntensity(2); } },
    { "rotation", [&] { this->Environment->SetRotation(10); } },
    { "another environment", [&] { this->Pass->SetEnvironment(nullptr); } },
    { "compensation", [&] { lighting->EnergyCompensationOff(); } },
    { "background", [&] { this->Renderer->SetBackground(0.2, 0, 0); } },
    { "gradient", [&] { this->Renderer->GradientBackgroundOn(); } },
    { "depth peeling", [&] { this->Renderer->UseDepthPeelingOn(); } },
    { "environment shown", [&] { this->Pass->BackgroundVisibleOn(); } },
    { "its blur", [&] { this->Pass->SetBackgroundBlur(0.3); } },
    { "encoding", [&] { this->Pass->SetOutputEncoding(vtkIBLRenderPass::Linear); } },
    { "delegate", [&] { this->Pass->SetDelegatePass(steps); } },
    { "its settings", [&] { steps->Modified(); } },
    { "viewport", [&] { this->Renderer->SetViewport(0, 0, 0.5, 1); } },
    { "window", [&] { this->Window->SetSize(2 * Size, Size); } },
    { "multisampling", [&] { this->Window->SetMultiSamples(4); } },
    { "Modified()", [&] { this->Pass->Modified(); } },
    { "released", [&] { this->Renderer->ReleaseGraphicsResources(this->Window); } },
  };
  this->Render();
  for (const auto& [what, change] : changes)
  {
    const int before = this->Pass->GetAccumulatedSamples();
    EXPECT_EQ(this->Render(2), before + 32) << "at rest before " << what;
    change();
    EXPECT_EQ(this->Render(), 16) << what;
  }
  this->SetSamples(8);
  EXPECT_EQ(this->Render(), 8);
  EXPECT_EQ(this->Render(), 16);
  this->SetSamples(0);
  EXPECT_EQ(this->Render(2), 0);
}

// What is set to what it was is no change.
TEST_F(TestAccumulationGL, SameAgainIsNoChange)
{
  this->Render();
  this->Renderer->GetActiveCamera()->Azimuth(0);
  this->Environment->SetIntensity(1.0);
  this->Window->SetSize(Size, Size);
  this->Actor->GetProperty()->SetRoughness(0.5);
  EXPECT_EQ(this->Render(), 32);
}

// Picking neither adds nor starts anew, finds the actor, and leaves the picture; what is changed meanwhile is seen.
// Mutants: the selection's frames added, its black background taken for a change.
TEST_F(TestAccumulationGL, SelectionIsNoFrame)
{
  this->Render(3);
  auto select = [this]
  {
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(this->Renderer);
    selector->SetArea(0, 0, Size - 1, Size - 1);
    vtkSmartPointer<vtkSelection> selection;
    selection.TakeReference(selector->Select());
    EXPECT_EQ(selection->GetNumberOfNodes(), 1u);
  };
  select();
  EXPECT_EQ(this->Pass->GetAccumulatedSamples(), 48);
  EXPECT_EQ(this->Render(), 64);
  select();
  this->Renderer->SetBackground(0.3, 0.3, 0.3);
  EXPECT_EQ(this->Render(), 16);
  select();
  this->Renderer->GetActiveCamera()->Azimuth(1);
  EXPECT_EQ(this->Render(), 16);
}

// At 65536 samples frames add nothing and draw nothing, and the picture stays. Mutant: no end.
TEST_F(TestAccumulationGL, EndsAtTheMost)
{
  this->Window->SetSize(8, 8);
  this->SetSamples(7000);
  EXPECT_EQ(this->Render(9), 63000);
  const std::vector<unsigned char> picture = GetPicture(this->Window);
  EXPECT_EQ(this->GetPictureAfter(2), picture);
  EXPECT_EQ(this->Pass->GetAccumulatedSamples(), 63000);
  this->Actor->GetProperty()->SetRoughness(0.6);
  EXPECT_EQ(this->Render(), 7000);
}

// Captures add to a mean of their own, and the window's goes on. Mutant: one mean for both.
TEST_F(TestAccumulationGL, CapturesHaveTheirOwnMean)
{
  this->Render(3);
  this->Pass->CaptureRadiance(this->Renderer);
  this->Pass->CaptureRadiance(this->Renderer);
  EXPECT_EQ(this->Pass->GetAccumulatedSamples(), 32);
  EXPECT_EQ(this->Render(), 64);
}

// Among objects that are not sampled: these, the background and depth are VTK's own, byte for byte, in the first frame
// and in the fourth, whatever is accumulated; through another pass, and after another size. Light comes from nowhere,
// so that the plain picture is known. Mutants: encoding what did not vary, depth not written, the wrong viewport.
class TestAccumulationSceneGL : public TestAccumulationGL
{
protected:
  vtkNew<vtkSphereSource> Source;
  vtkNew<vtkActor> Sphere, Unlit;
  vtkNew<vtkPolyDataMapper2D> FlatMapper;
  vtkNew<vtkActor2D> Overlay;

  void SetUp() override
  {
    TestAccumulationGL::SetUp();
    this->Renderer->RemoveActor(this->Actor);
    this->Environment->SetIntensity(0.0);
    for (vtkActor* actor : { this->Sphere.Get(), this->Unlit.Get() })
    {
      vtkNew<vtkPolyDataMapper> mapper;
      mapper->SetInputConnection(this->Source->GetOutputPort());
      actor->SetMapper(mapper);
      this->Renderer->AddActor(actor);
    }
    this->Sphere->GetProperty()->SetInterpolationToPBR();
    this->Sphere->GetProperty()->SetColor(0.9, 0.7, 0.3);
    this->Unlit->SetPosition(0.4, 0.2, 0.3);
    this->Source->SetRadius(0.5);
    this->FlatMapper->SetInputConnection(this->Source->GetOutputPort());
    this->Overlay->SetMapper(this->FlatMapper);
    this->Overlay->SetPosition(8, 8);
    this->Overlay->GetProperty()->SetPointSize(6);
    this->Renderer->AddViewProp(this->Overlay);
    vtkNew<vtkLight> light;
    light->SetIntensity(0.7);
    this->Renderer->AddLight(light);
    this->Renderer->SetBackground(0.1, 0.2, 0.3);
    this->Renderer->SetBackground2(0.7, 0.5, 0.1);
    this->Renderer->GradientBackgroundOn();
    this->Window->SetSize(64, 64);
  }
  // What the screen shows: VTK resolves multisampling another way for whoever reads pixels.
  std::vector<unsigned char> GetShown(int frames)
  {
    this->Render(frames);
    vtkNew<vtkUnsignedCharArray> rgb;
    const int* size = this->Window->GetSize();
    this->Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 1, rgb, 0);
    return { rgb->GetPointer(0), rgb->GetPointer(0) + rgb->GetNumberOfValues() };
  }
  std::vector<float> GetDepth()
  {
    const int* size = this->Window->GetSize();
    std::vector<float> depth(std::size_t(size[0]) * size[1]);
    this->Window->GetZbufferData(0, 0, size[0] - 1, size[1] - 1, depth.data());
    return depth;
  }
  // How far the sampled pictures are from the plain one, in bytes. In between, the window shows another.
  int GetDifference(int samples = 16, int more = 3)
  {
    this->SetSamples(0);
    this->Renderer->SetBackgroundAlpha(0.4);
    const std::vector<unsigned char> plain = this->GetShown(1);
    const std::vector<float> depth = this->GetDepth();
    this->Sphere->VisibilityOff();
    this->Unlit->VisibilityOff();
    this->Overlay->VisibilityOff();
    this->Renderer->SetBackgroundAlpha(0.9);
    this->Render();
    this->Sphere->VisibilityOn();
    this->Unlit->VisibilityOn();
    this->Overlay->VisibilityOn();
    this->Renderer->SetBackgroundAlpha(0.4);
    this->SetSamples(samples);
    int difference = 0;
    float farthest = 0.0f;
    for (int frames : { 1, more })
    {
      const std::vector<unsigned char> picture = this->GetShown(frames);
      const std::vector<float> drawn = this->GetDepth();
      EXPECT_EQ(drawn.size(), depth.size());
      for (std::size_t i = 0; i < depth.size(); ++i)
      {
        farthest = std::max(farthest, std::abs(drawn[i] - depth[i]));
      }
      EXPECT_EQ(picture.size(), plain.size());
      for (std::size_t i = 0; i < plain.size(); ++i)
      {
        difference = std::max(difference, std::abs(picture[i] - plain[i]));
      }
    }
    EXPECT_EQ(this->Pass->GetAccumulatedSamples(), std::min((1 + more) * samples, 65536 / samples * samples));
    EXPECT_LE(farthest, 6e-8f); // a step of floats: VTK's depth has 32 bits
    return difference;
  }
};

TEST_F(TestAccumulationSceneGL, LeavesTheRestToVTK)
{
  EXPECT_EQ(this->GetDifference(), 0);
  this->Renderer->GradientBackgroundOff();
  EXPECT_EQ(this->GetDifference(), 0) << "of no full opacity";
  this->Window->SetSize(96, 48);
  EXPECT_EQ(this->GetDifference(), 0) << "larger";
  this->Window->SetSize(40, 60);
  EXPECT_EQ(this->GetDifference(), 0) << "smaller";
  vtkNew<vtkRenderStepsPass> steps;
  this->Pass->SetDelegatePass(steps);
  EXPECT_EQ(this->GetDifference(), 0) << "delegate";
  this->Pass->SetDelegatePass(nullptr);
  this->Renderer->SetViewport(0.25, 0.1, 0.8, 0.9);
  EXPECT_EQ(this->GetDifference(), 0) << "viewport";
  this->Window->SetMultiSamples(4);
  EXPECT_LE(this->GetDifference(), 1) << "multisampling";
}

// Blended in floats instead of bytes: a step or two. Mutant: depth of a format that VTK's passes can't copy.
TEST_F(TestAccumulationSceneGL, TranslucentSurfacesAreBlended)
{
  this->Sphere->GetProperty()->SetOpacity(0.5);
  this->Unlit->GetProperty()->SetOpacity(0.7);
  EXPECT_LE(this->GetDifference(), 2);
  this->Pass->CaptureRadiance(this->Renderer);
  this->Window->AlphaBitPlanesOn();
  this->Renderer->UseDepthPeelingOn();
  EXPECT_LE(this->GetDifference(), 2) << "depth peeling";
}

// Two renderers, two passes: each has its mean, a change of one leaves the other, and a capture is of its own half.
// A layer above draws over what is below, and does not accumulate; captured, it is over nothing.
TEST_F(TestAccumulationSceneGL, RenderersSideBySide)
{
  this->Renderer->SetViewport(0, 0, 0.5, 1);
  vtkNew<vtkRenderer> right;
  right->SetViewport(0.5, 0, 1, 1);
  right->SetBackground(0.5, 0.25, 0.125);
  right->AddActor(this->Actor);
  this->Actor->SetScale(1e-4);
  right->SetActiveCamera(this->Renderer->GetActiveCamera());
  vtkNew<vtkIBLRenderPass> pass;
  pass->SetEnvironment(this->Environment);
  pass->GetLighting()->SetSamplesPerPixel(16);
  right->SetPass(pass);
  this->Window->AddRenderer(right);
  EXPECT_EQ(this->GetDifference(), 0);
  EXPECT_EQ(this->GetDifference(8192, 9), 0) << "at rest";
  this->SetSamples(16);
  const int before = pass->GetAccumulatedSamples();
  this->Sphere->GetProperty()->SetRoughness(0.2);
  EXPECT_EQ(this->Render(), 16);
  EXPECT_EQ(pass->GetAccumulatedSamples(), before + 16);
  vtkSmartPointer<vtkImageData> image = pass->CaptureRadiance(right);
  EXPECT_EQ(image->GetDimensions()[0], 32);
  EXPECT_EQ(image->GetScalarComponentAsDouble(1, 1, 0, 1), 0.25);

  this->Window->SetNumberOfLayers(2);
  this->Renderer->SetViewport(0, 0, 1, 1);
  right->SetLayer(1);
  EXPECT_EQ(this->GetDifference(), 0) << "layers";
  EXPECT_EQ(pass->GetAccumulatedSamples(), 16);
  image = pass->CaptureRadiance(right);
  EXPECT_EQ(image->GetScalarComponentAsDouble(1, 1, 0, 3), 0.0) << "nothing below";
}

// Sampled passes released or just deleted, of many sizes: no GL object is left. Mutants: the framebuffer not released.
TEST_F(TestAccumulationSceneGL, LeavesNoGLObjects)
{
  auto renderWithout = [this]
  {
    this->Renderer->SetPass(nullptr);
    this->Sphere->ReleaseGraphicsResources(this->Window); // its mapper holds the last pass
    this->Window->Render();
    return this->Window->CountGLObjects();
  };
  int first = 0;
  for (int round = 0; round < 10; ++round)
  {
    vtkSmartPointer<vtkIBLRenderPass> pass = vtkSmartPointer<vtkIBLRenderPass>::New();
    pass->SetEnvironment(this->Environment);
    pass->GetLighting()->SetSamplesPerPixel(4);
    this->Renderer->SetPass(pass);
    this->Window->SetSize(32 + 8 * (round % 3), 32);
    this->Window->Render();
    pass->CaptureRadiance(this->Renderer);
    this->Renderer->SetPass(nullptr);
    if (round % 2 == 0)
    {
      pass->ReleaseGraphicsResources(this->Window);
    }
    else
    {
      pass = nullptr;
    }
    const int left = renderWithout();
    first = round == 0 ? left : first;
    ASSERT_EQ(left, first) << "round " << round;
  }
}
