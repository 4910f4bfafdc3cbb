// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The pass among VTK's features: what it adds, and what it leaves alone.
#include "TestScene.h"

#include "vtkIBLCubeMap.h"
#include "vtkIBLProbe.h"
#include "vtkIBLProbeCollection.h"
#include "vtkIBLSpecularChain.h"

#include <vtkCallbackCommand.h>
#include <vtkFloatArray.h>
#include <vtkHardwareSelector.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkOpenGLRenderer.h>
#include <vtkOpenGLState.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataTangents.h>
#include <vtkRenderStepsPass.h>
#include <vtkSelection.h>
#include <vtkShader.h>
#include <vtkShaderProgram.h>
#include <vtkSphereSource.h>
#include <vtkTexture.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace
{
constexpr unsigned int CubeMapSeamless = 0x884F; // GL_TEXTURE_CUBE_MAP_SEAMLESS

// Radiance that tells every direction apart, smooth enough for a small map.
RGB Coloured(Vec3 d)
{
  return { 0.6 + 0.4 * d.x, 0.6 + 0.4 * d.y, 0.6 + 0.4 * d.z };
}

vtkSmartPointer<vtkTexture> MakeTexture(bool sRGB, const std::function<RGB(int, int)>& f)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(16, 16, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int j = 0; j < 16; ++j)
  {
    for (int i = 0; i < 16; ++i)
    {
      const RGB rgb = f(i, j);
      for (int k = 0; k < 3; ++k)
      {
        image->SetScalarComponentFromDouble(i, j, 0, k, 255 * rgb[k]);
      }
    }
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  texture->SetUseSRGBColorSpace(sRGB);
  texture->InterpolateOn();
  return texture;
}

RGB Checker(int i, int j)
{
  return (i + j) % 2 ? RGB{ 0.9, 0.5, 0.2 } : RGB{ 0.2, 0.6, 0.9 };
}
}

// A sphere with two of VTK's lights; each test dresses it up.
class TestRenderPassGL : public GLTest
{
protected:
  vtkNew<vtkSphereSource> Sphere;
  vtkNew<vtkPolyDataTangents> Tangents;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkIBLEnvironment> Environment;
  vtkNew<vtkIBLRenderPass> Pass;

  void SetUp() override
  {
    GLTest::SetUp();
    this->Window->SetSize(96, 96);
    this->Sphere->SetRadius(1.0);
    this->Sphere->SetThetaResolution(48);
    this->Sphere->SetPhiResolution(48);
    this->Sphere->Update();
    vtkNew<vtkPolyData> surface;
    surface->ShallowCopy(this->Sphere->GetOutput());
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetNumberOfComponents(2);
    coordinates->SetNumberOfTuples(surface->GetNumberOfPoints());
    vtkNew<vtkFloatArray> heights;
    heights->SetNumberOfTuples(surface->GetNumberOfPoints());
    for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
    {
      double p[3];
      surface->GetPoint(i, p);
      coordinates->SetTuple2(i, 0.5 + 0.4 * p[0], 0.5 + 0.4 * p[1]);
      heights->SetValue(i, static_cast<float>(p[1]));
    }
    surface->GetPointData()->SetTCoords(coordinates);
    surface->GetPointData()->SetScalars(heights);
    this->Tangents->SetInputData(surface);
    this->Mapper->SetInputConnection(this->Tangents->GetOutputPort());
    this->Mapper->ScalarVisibilityOff();
    this->Actor->SetMapper(this->Mapper);
    this->Actor->GetProperty()->SetInterpolationToPBR();
    this->Actor->GetProperty()->SetColor(0.9, 0.7, 0.3);
    this->Actor->GetProperty()->SetRoughness(0.4);
    this->Actor->GetProperty()->SetMetallic(0.5);
    this->Renderer->AddActor(this->Actor);
    this->Renderer->SetBackground(0.1, 0.2, 0.3);
    for (double x : { -1.0, 1.0 })
    {
      vtkNew<vtkLight> light;
      light->SetPosition(3 * x, 2, 3);
      light->SetColor(1, 0.9, 0.8 + 0.1 * x);
      this->Renderer->AddLight(light);
    }
    this->Environment->SetInputData(MakePanorama(64, Coloured));
    this->Pass->SetEnvironment(this->Environment);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->GetActiveCamera()->SetPosition(0.5, 0.3, 4);
    this->Renderer->ResetCameraClippingRange();
  }

  std::vector<unsigned char> Render(vtkRenderPass* pass)
  {
    this->Renderer->SetPass(pass);
    this->Window->Render();
    return GetPicture(this->Window);
  }

  // With the environment at intensity 0 the picture is VTK's own, byte for byte; with light it is brighter, and nowhere
  // darker.
  void ExpectOnlyLightIsAdded(const char* what)
  {
    const std::vector<unsigned char> own = this->Render(nullptr);
    this->Environment->SetIntensity(0.0);
    EXPECT_EQ(this->Render(this->Pass), own) << what;
    this->Environment->SetIntensity(1.0);
    const std::vector<unsigned char> lit = this->Render(this->Pass);
    long brighter = 0;
    long darker = 0;
    for (std::size_t i = 0; i < lit.size(); ++i)
    {
      brighter += lit[i] > own[i];
      darker += lit[i] < own[i];
    }
    EXPECT_GT(brighter, 3000) << what;
    EXPECT_EQ(darker, 0) << what;
  }
};

// Mutants: VTK's own terms touched, a light lost, the stand-in light left in the scene.
TEST_F(TestRenderPassGL, AddsLightAndLeavesTheRestToVTK)
{
  vtkProperty* property = this->Actor->GetProperty();
  this->ExpectOnlyLightIsAdded("plain");
  this->Mapper->ScalarVisibilityOn();
  this->Mapper->SetScalarRange(-1, 1);
  this->ExpectOnlyLightIsAdded("scalar colours");
  this->Mapper->ScalarVisibilityOff();
  property->SetBaseColorTexture(MakeTexture(true, Checker));
  this->ExpectOnlyLightIsAdded("albedo texture");
  property->SetORMTexture(MakeTexture(false, Checker));
  this->ExpectOnlyLightIsAdded("occlusion, roughness, metallic texture");
  property->SetEmissiveTexture(MakeTexture(true, [](int i, int) { return RGB{ i / 40.0, 0, 0.1 }; }));
  this->ExpectOnlyLightIsAdded("emissive texture");
  property->SetNormalTexture(MakeTexture(false,
    [](int i, int j) {
      return RGB{ 0.5 + 0.02 * (i % 4), 0.5 + 0.02 * (j % 4), 0.95 };
    }));
  this->ExpectOnlyLightIsAdded("normal map");
  property->SetCoatStrength(0.7);
  property->SetCoatRoughness(0.2);
  this->ExpectOnlyLightIsAdded("clear coat");
  property->SetAnisotropy(0.6);
  this->ExpectOnlyLightIsAdded("anisotropy");
  vtkNew<vtkPlane> plane;
  plane->SetNormal(1, 0.2, 0);
  plane->SetOrigin(-0.3, 0, 0);
  this->Mapper->AddClippingPlane(plane);
  this->ExpectOnlyLightIsAdded("clipping plane");
}

// The programs that VTK puts together with our text in them are valid GLSL to Khronos' own compiler, not only to the
// driver at hand; fast and sampled, under the sky and among probes, plain and with a coat. Mutants: bitfieldReverse,
// which GLSL 1.50 lacks and Mesa may let pass; cube map arrays without their extension.
TEST_F(TestRenderPassGL, MakesValidPrograms)
{
  if (std::system("glslangValidator --version > /dev/null 2>&1") != 0)
  {
    GTEST_SKIP() << "no glslangValidator: install glslang-tools";
  }
  std::string source;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&source);
  observer->SetCallback(
    [](vtkObject*, unsigned long, void* client, void* program) {
      *static_cast<std::string*>(client) = static_cast<vtkShaderProgram*>(program)->GetFragmentShader()->GetSource();
    });
  this->Mapper->AddObserver(vtkCommand::UpdateShaderEvent, observer);
  const std::filesystem::path file =
    std::filesystem::temp_directory_path() / ("vtkibl-mapper-" + std::to_string(getpid()) + ".frag");
  auto isValid = [&]
  {
    std::ofstream(file) << source;
    return std::system(("glslangValidator " + file.string()).c_str()) == 0;
  };
  for (int samples : { 0, 16 })
  {
    for (int probes : { 0, 1 })
    {
      vtkNew<vtkIBLProbe> probe;
      probes ? this->Pass->GetProbes()->AddItem(probe) : this->Pass->GetProbes()->RemoveAllItems();
      for (double coat : { 0.0, 0.5 })
      {
        this->Pass->GetLighting()->SetSamplesPerPixel(samples);
        this->Actor->GetProperty()->SetCoatStrength(coat);
        this->Render(this->Pass);
        ASSERT_NE(source.find("iblEnvironmentLight("), std::string::npos);
        EXPECT_EQ(source.find("#define IBL_PROBES") != std::string::npos, probes != 0);
        EXPECT_TRUE(isValid()) << "samples " << samples << " probes " << probes << " coat " << coat;
      }
    }
  }
  source += "vec3 broken() { return nothing; }\n"; // the validator does refuse
  EXPECT_FALSE(isValid());
  std::filesystem::remove(file);
}

TEST_F(TestRenderPassGL, KeepsOpacityAndDepthPeeling)
{
  vtkNew<vtkActor> behind;
  behind->SetMapper(this->Mapper);
  behind->SetPosition(0.4, 0.2, -1.5);
  behind->GetProperty()->SetInterpolationToPBR();
  this->Renderer->AddActor(behind);
  this->Actor->GetProperty()->SetOpacity(0.5);
  this->ExpectOnlyLightIsAdded("opacity");
  this->Window->AlphaBitPlanesOn();
  this->Renderer->UseDepthPeelingOn();
  this->Renderer->SetMaximumNumberOfPeels(8);
  this->ExpectOnlyLightIsAdded("depth peeling");
}

// A non-PBR surface without specular reflection has a shader of its own, which shows what the other does at the limit;
// reflection that comes later, on the same mapper, is seen. 1: rounding. Mutants: half of the light; a shader that is
// always matt.
TEST_F(TestRenderPassGL, MattSurfacesAreTheLimit)
{
  this->Renderer->RemoveAllLights(); // which have reflections of their own
  this->Pass->LightNonPBROn();
  vtkProperty* property = this->Actor->GetProperty();
  property->SetInterpolationToGouraud();
  for (const bool compensation : { true, false })
  {
    this->Pass->GetLighting()->SetEnergyCompensation(compensation);
    property->SetSpecular(0.0);
    const std::vector<unsigned char> matt = this->Render(this->Pass);
    property->SetSpecular(1e-5);
    const std::vector<unsigned char> limit = this->Render(this->Pass);
    for (std::size_t i = 0; i < matt.size(); ++i)
    {
      ASSERT_NEAR(matt[i], limit[i], 1) << i / 4 % 96 << " " << i / 4 / 96;
    }
    property->SetSpecular(1.0);
    EXPECT_NE(this->Render(this->Pass), matt);
  }
}

// Non-PBR actors and unlit ones are VTK's, untouched.
TEST_F(TestRenderPassGL, LeavesOtherInterpolationsAlone)
{
  this->Actor->GetProperty()->SetInterpolationToPhong();
  const std::vector<unsigned char> phong = this->Render(nullptr);
  EXPECT_EQ(this->Render(this->Pass), phong);
  this->Actor->GetProperty()->SetInterpolationToPBR();
  this->Actor->GetProperty()->LightingOff();
  const std::vector<unsigned char> unlit = this->Render(nullptr);
  EXPECT_EQ(this->Render(this->Pass), unlit);
}

// A scene without lights shows the environment's light, no headlight is made, and the scene has no lights afterwards. A
// scene with all lights off likewise.
TEST_F(TestRenderPassGL, NeedsNoLights)
{
  const std::vector<unsigned char> both = this->Render(this->Pass);
  this->Renderer->RemoveAllLights();
  for (bool automatic : { true, false })
  {
    this->Renderer->SetAutomaticLightCreation(automatic);
    const std::vector<unsigned char> none = this->Render(this->Pass);
    EXPECT_EQ(this->Renderer->GetLights()->GetNumberOfItems(), 0);
    const std::size_t centre = 4 * (48 * 96 + 48);
    EXPECT_GT(none[centre], 60);           // lit
    EXPECT_LT(none[centre], both[centre]); // by the environment alone
  }
}

// The same orientation as VTK's own image-based lighting has for the same image, with the camera and the environment's
// axes turned. A mirror sphere: VTK's cube has 64^2 faces, the map is smooth, and at roughness 0 both show radiance
// itself; 6 of 255. Mutants: any flipped or swapped axis (100 of 255).
TEST_F(TestRenderPassGL, TurnsTheEnvironmentAsVTKDoes)
{
  this->Renderer->RemoveAllLights();
  this->Actor->GetProperty()->SetColor(1, 1, 1);
  this->Actor->GetProperty()->SetMetallic(1);
  this->Actor->GetProperty()->SetRoughness(0);
  vtkSmartPointer<vtkImageData> panorama = MakePanorama(64, Coloured);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(panorama);
  texture->SetColorModeToDirectScalars();
  texture->MipmapOn();
  texture->InterpolateOn();
  this->Renderer->SetEnvironmentTexture(texture, false);
  this->Renderer->AutomaticLightCreationOff();
  vtkOpenGLRenderer::SafeDownCast(this->Renderer)->GetEnvMapLookupTable(); // made
  for (bool turned : { false, true })
  {
    if (turned)
    {
      this->Renderer->SetEnvironmentUp(0, 0, 1);
      this->Renderer->SetEnvironmentRight(0, 1, 0);
      this->Environment->SetUp(0, 0, 1);
      this->Environment->SetRight(0, 1, 0);
      this->Renderer->GetActiveCamera()->SetPosition(3, -2, 2);
      this->Renderer->ResetCameraClippingRange();
    }
    this->Renderer->UseImageBasedLightingOn();
    this->Actor->GetProperty()->Modified(); // VTK 9.1 does not rebuild the shader for the flag alone
    const std::vector<unsigned char> vtk = this->Render(nullptr);
    this->Renderer->UseImageBasedLightingOff();
    this->Actor->GetProperty()->Modified();
    const std::vector<unsigned char> ours = this->Render(this->Pass);
    int inside = 0;
    for (int j = 0; j < 96; ++j)
    {
      for (int i = 0; i < 96; ++i)
      {
        const std::size_t pixel = 4 * (std::size_t(j) * 96 + i);
        if (std::hypot(i - 47.5, j - 47.5) <
          20) // away from the silhouette, where a step of angle is a leap of direction
        {
          ++inside;
          for (int k = 0; k < 3; ++k)
          {
            ASSERT_NEAR(ours[pixel + k], vtk[pixel + k], 6) << i << " " << j << " turned " << turned;
          }
        }
      }
    }
    EXPECT_GT(inside, 1000);
  }
}

// Background off: the renderer's colour. On: the environment along the pixel's ray. Blurred: as a rough mirror shows
// it. In perspective and parallel projection.
TEST_F(TestRenderPassGL, BackgroundShowsTheEnvironment)
{
  this->Actor->VisibilityOff();
  this->Environment->SetInputData(MakePanorama(256, Coloured));
  this->Renderer->SetPass(this->Pass);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(0, 0, 4);
  camera->SetFocalPoint(1, 0.5, 0);
  EXPECT_EQ(this->Render(this->Pass)[0], 26); // 0.1
  this->Pass->BackgroundVisibleOn();
  vtkSmartPointer<vtkImageData> picture = this->Pass->CaptureRadiance(this->Renderer);
  const double half = std::tan(0.5 * camera->GetViewAngle() * vtkIBLReference::Pi / 180);
  const Vec3 forward = vtkIBLReference::Normalize({ 1, 0.5, -4 });
  const Vec3 right = vtkIBLReference::Normalize(vtkIBLReference::Cross(forward, { 0, 1, 0 }));
  const Vec3 up = vtkIBLReference::Cross(right, forward);
  for (int j = 5; j < 96; j += 17)
  {
    for (int i = 5; i < 96; i += 17)
    {
      const double x = half * (2 * (i + 0.5) / 96 - 1), y = half * (2 * (j + 0.5) / 96 - 1);
      const RGB truth = Coloured(vtkIBLReference::Normalize(forward + x * right + y * up));
      const auto* seen = static_cast<const float*>(picture->GetScalarPointer(i, j, 0));
      for (int k = 0; k < 3; ++k)
      {
        EXPECT_NEAR(seen[k], truth[k], 5e-3) << i << " " << j;
      }
    }
  }
  this->Pass->SetBackgroundBlur(1.0); // 0.6 + 0.4 (2/3) d
  picture = this->Pass->CaptureRadiance(this->Renderer);
  EXPECT_NEAR(static_cast<const float*>(picture->GetScalarPointer(48, 48, 0))[2], 0.6 + 0.4 * 2 / 3 * forward.z, 1e-2);
  camera->ParallelProjectionOn();
  this->Pass->SetBackgroundBlur(0.0);
  picture = this->Pass->CaptureRadiance(this->Renderer);
  EXPECT_NEAR(static_cast<const float*>(picture->GetScalarPointer(48, 48, 0))[2], 0.6 + 0.4 * forward.z, 1e-2);
}

// Behind a picture that is there, by its alpha, the environment looks as it does when it is drawn first. Peeled: else
// VTK's alpha of translucent surfaces is not their share. 1: their light is rounded to bytes first. Mutant: the
// environment added in full.
TEST_F(TestRenderPassGL, BackgroundComesBehindAPicture)
{
  this->Window->AlphaBitPlanesOn();
  this->Renderer->UseDepthPeelingOn();
  this->Renderer->SetMaximumNumberOfPeels(8);
  this->Renderer->SetBackground(0, 0, 0);
  this->Actor->GetProperty()->SetOpacity(0.5);
  this->Pass->SetBackgroundBlur(0.3);
  this->Pass->BackgroundVisibleOn();
  const std::vector<unsigned char> first = this->Render(this->Pass);
  this->Pass->BackgroundVisibleOff();
  const auto add = [](vtkObject* renderer, unsigned long, void* pass, void*)
  { EXPECT_TRUE(static_cast<vtkIBLRenderPass*>(pass)->RenderBackgroundBehind(static_cast<vtkRenderer*>(renderer))); };
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(add);
  command->SetClientData(this->Pass);
  this->Renderer->AddObserver(vtkCommand::EndEvent, command);
  const std::vector<unsigned char> behind = this->Render(this->Pass);
  ASSERT_EQ(behind.size(), first.size());
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    EXPECT_NEAR(behind[i], first[i], 1) << i / 4 % 96 << " " << i / 4 / 96;
  }
}

// Rough surfaces alone have shaders without the mirror. One that comes later, on the same mapper, shows it: a spot of
// 10 in a sky of 0.1, of which layer 1, 1 degree wide, has 8.8; 2 %: white metal's own 0.5 %, texels. Seamless
// filtering is as it was afterwards. Mutants: shaders that stay as they are; a mirror a mapper that another actor's
// shader lacks; state left as the last actor had it.
TEST_F(TestRenderPassGL, ReadsTheMirrorOnceSomethingIsOne)
{
  const auto hasMirror = [this]
  { return this->Pass->GetLighting()->GetShaderChunk().find("#define IBL_MIRROR") != std::string::npos; };
  this->Environment->SetInputData(MakePanorama(256,
    [](Vec3 d)
    {
      const double l = d.z > std::cos(4 * vtkIBLReference::Pi / 180) ? 10 : 0.1;
      return RGB{ l, l, l };
    }));
  this->Renderer->RemoveAllLights();
  this->Renderer->SetPass(this->Pass);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(0, 0, 5);
  camera->SetFocalPoint(0, 0, 0);
  this->Actor->SetPosition(-1.2, 0, 0);
  this->Pass->CaptureRadiance(this->Renderer);
  EXPECT_FALSE(hasMirror());

  vtkNew<vtkActor> mirror;
  mirror->SetMapper(this->Mapper);
  mirror->GetProperty()->SetInterpolationToPBR();
  mirror->GetProperty()->SetColor(1, 1, 1);
  mirror->GetProperty()->SetMetallic(1);
  mirror->GetProperty()->SetRoughness(0);
  this->Renderer->AddActor(mirror);
  for (bool seamless : { false, true })
  {
    this->Window->MakeCurrent();
    this->Window->GetState()->SetEnumState(CubeMapSeamless, seamless);
    vtkSmartPointer<vtkImageData> picture = this->Pass->CaptureRadiance(this->Renderer);
    EXPECT_TRUE(hasMirror());
    EXPECT_NEAR(static_cast<const float*>(picture->GetScalarPointer(48, 48, 0))[1], 10, 0.2);
    EXPECT_EQ(this->Window->GetState()->GetEnumState(CubeMapSeamless), seamless);
    this->Renderer->RemoveActor(this->Actor); // and then the mirror is the last that is drawn
  }
}

// Through VTK's own chain of passes the picture is the same.
TEST_F(TestRenderPassGL, DelegatesToOtherPasses)
{
  this->Pass->BackgroundVisibleOn();
  const std::vector<unsigned char> alone = this->Render(this->Pass);
  vtkNew<vtkRenderStepsPass> steps;
  this->Pass->SetDelegatePass(steps);
  EXPECT_EQ(this->Render(this->Pass), alone);
}

// Picking finds the actor, and bakes nothing.
TEST_F(TestRenderPassGL, SelectionBakesNothing)
{
  this->Render(this->Pass);
  this->Environment->SetInputData(MakePanorama(32, Coloured)); // would be baked by the next frame
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(this->Renderer);
  selector->SetArea(0, 0, 95, 95);
  vtkSmartPointer<vtkSelection> selection;
  selection.TakeReference(selector->Select());
  EXPECT_EQ(selection->GetNumberOfNodes(), 1u);
  EXPECT_EQ(this->Pass->GetLighting()->GetSpecularChain()->GetNumberOfBuilds(), 1);
  this->Window->Render();
  EXPECT_EQ(this->Pass->GetLighting()->GetSpecularChain()->GetNumberOfBuilds(), 2);
}

// With no environment given, a built-in studio lights the scene.
TEST_F(TestRenderPassGL, HasAStudioOfItsOwn)
{
  this->Renderer->RemoveAllLights();
  vtkNew<vtkIBLRenderPass> pass;
  const std::vector<unsigned char> lit = this->Render(pass);
  EXPECT_GT(lit[4 * (48 * 96 + 48)], 60);
  pass->SetEnvironment(nullptr);
  EXPECT_EQ(this->Render(pass), lit);
}

// A source that fails reports once, and the picture stays as it was. Mutants: an error each frame, light dropped.
TEST_F(TestRenderPassGL, KeepsTheLastGoodLight)
{
  const std::vector<unsigned char> good = this->Render(this->Pass);
  this->Environment->SetFileName("/no/such/file.exr");
  EXPECT_EQ(this->Render(this->Pass), good);
  EXPECT_NE(this->Messages.Take().find("/no/such/file.exr"), std::string::npos);
  EXPECT_EQ(this->Render(this->Pass), good);
  EXPECT_EQ(this->Messages.Take(), "");
}

// One broken texel is cleaned, reported, and turns nothing black or white.
TEST_F(TestRenderPassGL, SurvivesBrokenTexels)
{
  const std::vector<unsigned char> good = this->Render(this->Pass);
  for (float broken : { std::nanf(""), HUGE_VALF, -HUGE_VALF, -1.0f, 1e30f })
  {
    vtkSmartPointer<vtkImageData> panorama = MakePanorama(64, Coloured);
    static_cast<float*>(panorama->GetScalarPointer(70, 40, 0))[1] = broken;
    this->Environment->SetInputData(panorama);
    const std::vector<unsigned char> picture = this->Render(this->Pass);
    EXPECT_NE(this->Messages.Take().find("replaced"), std::string::npos) << broken;
    for (std::size_t i = 0; i < picture.size(); ++i)
    {
      ASSERT_NEAR(picture[i], good[i], 2) << broken;
    }
  }
}

// 50 passes in one window, released or just deleted, and 50 windows made, rendered and destroyed: no GL object is left
// that a scene without this pass does not have. Mutants: a texture not owned, Release() forgetting a stage.
TEST_F(TestRenderPassGL, LeavesNoGLObjects)
{
  auto makeCheapPass = [this](vtkIBLRenderPass* pass)
  {
    pass->SetEnvironment(this->Environment);
    pass->BackgroundVisibleOn();
    pass->GetLighting()->GetSpecularChain()->SetEngine(vtkIBLSpecularChain::Sampled);
    pass->GetLighting()->GetSpecularChain()->SetNumberOfSamples(16);
    pass->GetLighting()->GetCubeMap()->SetFaceSize(16);
  };
  auto renderWithout = [this]
  {
    this->Renderer->SetPass(nullptr);
    this->Actor->ReleaseGraphicsResources(this->Window); // its mapper holds the last pass
    this->Window->Render();
    return this->Window->CountGLObjects();
  };
  const int without = renderWithout();
  int first = 0;
  for (int round = 0; round < 50; ++round)
  {
    {
      vtkNew<vtkIBLRenderPass> pass;
      makeCheapPass(pass);
      this->Render(pass);
      ASSERT_GT(this->Window->CountGLObjects(), without + 4);
      if (round % 2 == 0)
      {
        pass->ReleaseGraphicsResources(this->Window);
      }
      renderWithout();
    }
    // VTK's shader cache keeps the lit program, of at most two shaders, as long as the window lives; one for all
    // rounds.
    first = round == 0 ? this->Window->CountGLObjects() : first;
    ASSERT_EQ(this->Window->CountGLObjects(), first) << "round " << round;
  }
  EXPECT_LE(first, without + 3);

  auto countAfterRelease = [&](bool lit)
  {
    vtkNew<vtkIBLOffscreenWindow> window;
    window->SetSize(32, 32);
    vtkNew<vtkRenderer> renderer;
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(this->Sphere->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetInterpolationToPBR();
    renderer->AddActor(actor);
    vtkNew<vtkIBLRenderPass> pass;
    makeCheapPass(pass);
    renderer->SetPass(lit ? pass.Get() : nullptr);
    window->AddRenderer(renderer);
    window->Render();
    renderer->ReleaseGraphicsResources(window);
    return window->CountGLObjects();
  };
  const int released = countAfterRelease(false);
  for (int round = 0; round < 50; ++round)
  {
    ASSERT_EQ(countAfterRelease(true), released) << "round " << round;
  }
}
