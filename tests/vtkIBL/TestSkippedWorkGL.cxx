// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What a scene does not need is not made. Judged by counts of work, frame by frame; that nothing was missing, by the
// picture: byte for byte the one that is seen once everything has been made.
#include "TestSupport.h"

#include "TestScene.h"
#include "vtkIBLBRDFTable.h"
#include "vtkIBLCache.h"
#include "vtkIBLGLHeader.h"
#include "vtkIBLSpecularChain.h"
#include "vtkIBLSpectrum.h"
#include "vtkIBLStatistics.h"

#include <vtkAssembly.h>
#include <vtkHardwareSelector.h>
#include <vtkImageData.h>
#include <vtkSelection.h>
#include <vtkSphereSource.h>
#include <vtkTexture.h>

#include <chrono>
#include <map>
#include <random>

namespace
{
using Counts = std::map<std::string, int>; // by vtkIBLStatistics' names; what was not done is not in it
using Picture = std::vector<unsigned char>;

RGB Sky(Vec3 d)
{
  return { 1 + d.x, 1 + d.y * d.z, 1.2 + std::sin(9 * d.x) * std::sin(7 * d.z) };
}

// Spheres in a window; gone, nothing of it is left but what vtkIBLCache keeps. A ladder of 8 layers: 0.1 0.14 0.19 0.27
// 0.37 0.52 0.72 1, the mirror apart.
struct Scene
{
  vtkSmartPointer<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkIBLRenderPass> Pass;

  Scene(vtkRenderWindow* window, vtkIBLEnvironment* environment)
    : Window(window)
  {
    this->Pass->SetEnvironment(environment);
    this->GetChain()->SetFaceSize(128);
    this->Renderer->SetPass(this->Pass);
    this->Renderer->AutomaticLightCreationOff();
    this->Renderer->GetActiveCamera()->SetPosition(0, 0, 4);
    window->AddRenderer(this->Renderer);
  }
  ~Scene() { this->Window->RemoveRenderer(this->Renderer); }

  static vtkSmartPointer<vtkActor> MakeSphere(double roughness, double metallic = 0.5)
  {
    vtkNew<vtkSphereSource> sphere;
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->GetProperty()->SetInterpolationToPBR();
    actor->GetProperty()->SetRoughness(roughness);
    actor->GetProperty()->SetMetallic(metallic);
    return actor;
  }
  vtkProperty* AddSphere(double roughness, double metallic = 0.5)
  {
    const vtkSmartPointer<vtkActor> actor = MakeSphere(roughness, metallic);
    actor->SetPosition(0.9 * this->Renderer->GetActors()->GetNumberOfItems() - 0.9, 0, 0);
    this->Renderer->AddActor(actor);
    this->Renderer->ResetCameraClippingRange();
    return actor->GetProperty();
  }
  vtkProperty* AddMatt()
  {
    vtkProperty* matt = this->AddSphere(0.5, 0.0);
    matt->SetBaseIOR(1.0); // reflects nothing
    return matt;
  }

  vtkIBLLighting* GetLighting() { return this->Pass->GetLighting(); }
  vtkIBLSpecularChain* GetChain() { return this->GetLighting()->GetSpecularChain(); }

  // What `work` makes the pipeline do.
  template <typename Work>
  Counts Count(const Work& work)
  {
    vtkIBLStatistics* statistics = this->GetLighting()->GetStatistics();
    statistics->Reset();
    work();
    Counts counts;
    for (int kind = 0; kind < vtkIBLStatistics::Total; ++kind)
    {
      if (const auto count = static_cast<int>(statistics->GetCount(kind)))
      {
        counts[vtkIBLStatistics::GetKindName(kind)] = count;
      }
    }
    return counts;
  }
  Counts Render()
  {
    return this->Count([this] { this->Window->Render(); });
  }
  // GetPicture() renders what is there once more.
  Picture See() { return GetPicture(this->Window); }
  void ExpectNothingIsMissing()
  {
    this->Window->Render();
    const Picture seen = this->See();
    EXPECT_TRUE(std::any_of(seen.begin(), seen.end(), [](unsigned char x) { return x > 20 && x < 255; })); // lit
    this->GetLighting()->Update(vtkOpenGLRenderWindow::SafeDownCast(this->Window));
    this->Window->Render();
    EXPECT_EQ(this->See(), seen);
  }
  std::string GetLayers()
  {
    std::string layers;
    for (int layer = 1; layer <= this->GetChain()->GetNumberOfLayers(); ++layer)
    {
      layers += this->GetChain()->HasLayer(layer) ? std::to_string(layer) : "";
    }
    return layers;
  }
};
}

class TestSkippedWorkGL : public GLTest
{
protected:
  vtkNew<vtkIBLEnvironment> Environment;

  void SetUp() override
  {
    GLTest::SetUp();
    this->Environment->SetInputData(MakePanorama(128, Sky));
  }
};

// Nothing that shows environment light: the file, which is not there, is never asked for. Mutants: each kind of prop
// taken for a lit one; invisible ones counted; IsNothing() never true.
TEST_F(TestSkippedWorkGL, NothingIsReadForASceneWithoutPBR)
{
  this->Environment->SetFileName("/no/such.exr");
  Scene scene(this->Window, this->Environment);
  scene.AddSphere(0.5)->SetInterpolationToPhong();
  scene.AddSphere(0.5)->LightingOff();
  scene.AddSphere(0.5);
  scene.Renderer->GetActors()->GetLastActor()->VisibilityOff();
  EXPECT_EQ(scene.Render(), Counts());
  EXPECT_EQ(this->Environment->GetStatistics()->GetCount(vtkIBLStatistics::Total), 0);
  EXPECT_EQ(scene.GetLighting()->GetBRDFTable()->GetNumberOfBuilds(), 0);
}

// Matt surfaces: the irradiance map, of bands that the cosine leaves over. Mutants: reflections of a BaseIOR of 1; all
// bands.
TEST_F(TestSkippedWorkGL, MattSurfacesTakeIrradianceOnly)
{
  Scene scene(this->Window, this->Environment);
  scene.AddMatt();
  EXPECT_EQ(
    scene.Render(), (Counts{ { "read", 1 }, { "harmonics", 1 }, { "irradiance map", 1 }, { "BRDF table", 1 } }));
  EXPECT_LE(this->Environment->GetSpectrum(0)->GetOrder(), 64);
  scene.ExpectNothingIsMissing();
}

// Roughness from 0.4 to 0.6, whose narrowest lobes have 0.24 (dielectric, grazing): layers 0.19 to 0.72, irradiance, no
// band above what these need, and no cube map. Mutants: the layer at either end left out (seen in the picture), all
// layers, all bands.
TEST_F(TestSkippedWorkGL, RoughSurfacesTakeTheLayersAroundThem)
{
  Scene scene(this->Window, this->Environment);
  scene.AddSphere(0.4);
  scene.AddSphere(0.6);
  EXPECT_EQ(scene.Render(),
    (Counts{ { "read", 1 }, { "harmonics", 1 }, { "layers", 5 }, { "irradiance map", 1 }, { "BRDF table", 1 } }));
  EXPECT_EQ(scene.GetLayers(), "34567");
  EXPECT_LE(this->Environment->GetSpectrum(0)->GetOrder(), 128);
  scene.ExpectNothingIsMissing();
}

// A mirror: the cube map, and no layer. Between it and layer 1: both. Mutants: no cube map below 0.1 (black in the
// picture), one for all reflections.
TEST_F(TestSkippedWorkGL, MirrorsTakeTheCubeMap)
{
  for (double roughness : { 0.0, 0.05 })
  {
    vtkNew<vtkIBLEnvironment> environment;
    environment->SetInputData(MakePanorama(128, Sky));
    Scene scene(this->Window, environment);
    scene.AddSphere(roughness, 1.0);
    Counts expected = { { "read", 1 }, { "cube faces", 1 }, { "cube map", 1 }, { "harmonics", 1 },
      { "irradiance map", 1 }, { "BRDF table", 1 } };
    if (roughness > 0.0)
    {
      expected["layers"] = 1;
    }
    EXPECT_EQ(scene.Render(), expected) << roughness;
    EXPECT_EQ(scene.GetLayers(), roughness > 0.0 ? "1" : "");
    scene.ExpectNothingIsMissing();
  }
}

// A texture of roughness may say anything. Parts of an assembly are found. Mutants: the texture's factor taken for its
// values; only actors of the renderer itself looked at.
TEST_F(TestSkippedWorkGL, TexturesAndAssembliesAreSeen)
{
  Scene scene(this->Window, this->Environment);
  const vtkSmartPointer<vtkActor> part = Scene::MakeSphere(0.5);
  vtkNew<vtkAssembly> assembly;
  assembly->AddPart(part);
  scene.Renderer->AddActor(assembly);
  scene.Render();
  EXPECT_EQ(scene.GetLayers(), "3456");
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  part->GetProperty()->SetORMTexture(texture);
  const Counts more = scene.Count(
    [&]
    {
      const auto needs = vtkIBLSceneNeeds::Of(std::array<vtkProp*, 1>{ assembly }.data(), 1);
      scene.GetLighting()->Update(this->Window, needs);
    });
  EXPECT_EQ(more, (Counts{ { "cube faces", 1 }, { "cube map", 1 }, { "harmonics", 1 }, { "layers", 4 } }));
}

// The background alone, sharp: the cube map; blurred: the layers around its blur. Neither reads irradiance. Mutants:
// background left out of the needs (black), counted when it is off, irradiance for it.
TEST_F(TestSkippedWorkGL, BackgroundTakesWhatItShows)
{
  for (double blur : { 0.0, 0.5 })
  {
    vtkNew<vtkIBLEnvironment> environment;
    environment->SetInputData(MakePanorama(128, Sky));
    Scene scene(this->Window, environment);
    EXPECT_EQ(scene.Render(), Counts());
    scene.Pass->BackgroundVisibleOn();
    scene.Pass->SetBackgroundBlur(blur);
    EXPECT_EQ(scene.Render(),
      blur == 0.0 ? (Counts{ { "read", 1 }, { "cube faces", 1 }, { "cube map", 1 }, { "BRDF table", 1 } })
                  : (Counts{ { "read", 1 }, { "harmonics", 1 }, { "layers", 2 }, { "BRDF table", 1 } }));
    EXPECT_EQ(scene.GetLayers(), blur == 0.0 ? "" : "56");
    scene.ExpectNothingIsMissing();
  }
}

// Samples are read from the cube map, which then is made for rough surfaces, too, beside what a blurred background and
// lamps need. Mutant: no cube map where nothing is a mirror (black).
TEST_F(TestSkippedWorkGL, SampledShadingTakesTheCubeMapToo)
{
  Scene scene(this->Window, this->Environment);
  scene.AddSphere(0.5);
  const Counts fast = scene.Render();
  EXPECT_EQ(fast.count("cube map"), 0u);
  scene.GetLighting()->SetSamplesPerPixel(16);
  EXPECT_EQ(scene.Render(), (Counts{ { "cube faces", 1 }, { "cube map", 1 } }));
}

// Light that is the same from everywhere has the smallest ladder: 16^2 and 8^2 texels. Mutant: a ladder that does not
// look at the light.
TEST_F(TestSkippedWorkGL, ConstantLightHasTheSmallestLadder)
{
  this->Environment->SetInputData(MakePanorama(128, [](Vec3) { return RGB{ 1, 2, 3 }; }));
  Scene scene(this->Window, this->Environment);
  scene.GetChain()->SetFaceSize(0);
  scene.AddSphere(0.1);
  scene.AddSphere(1.0);
  EXPECT_EQ(scene.Render()["layers"], 2);
  EXPECT_EQ(scene.GetChain()->GetLayerFaceSize(1), 16);
  EXPECT_EQ(scene.GetChain()->GetLayerFaceSize(2), 8);
}

// Whatever enters where light is looked up makes nothing, and is seen. Mutant: any of these setters ending in this
// class's own Modified(), which is the source's.
TEST_F(TestSkippedWorkGL, TurningAndScalingMakeNothing)
{
  Scene scene(this->Window, this->Environment);
  scene.AddSphere(0.3);
  scene.Pass->BackgroundVisibleOn();
  scene.Render();
  Picture before = scene.See();
  const auto expectNothing = [&](const char* what)
  {
    EXPECT_EQ(scene.Render(), Counts()) << what;
    const Picture after = scene.See();
    EXPECT_NE(after, before) << what;
    before = after;
  };
  this->Environment->SetRotation(40);
  expectNothing("rotation");
  this->Environment->SetUp(0.1, 0.2, 1);
  expectNothing("up");
  this->Environment->SetRight(1, 1, 0);
  expectNothing("right");
  this->Environment->SetIntensity(0.5);
  expectNothing("intensity");
  this->Environment->SetTint(0.5, 1, 0.2);
  expectNothing("tint");
  this->Environment->NormalizeExposureOn();
  expectNothing("exposure");
  scene.Renderer->GetActiveCamera()->Azimuth(30);
  expectNothing("camera");
  scene.GetLighting()->EnergyCompensationOff();
  expectNothing("energy compensation");
  scene.Pass->SetOutputEncoding(vtkIBLRenderPass::Linear);
  expectNothing("encoding");
}

// A wider range of roughness adds the layers that are missing, and bands only where they are sharper; a narrower one
// nothing. Mutants: all made again, layers of the old range dropped.
TEST_F(TestSkippedWorkGL, MoreRoughnessAddsWhatIsMissing)
{
  Scene scene(this->Window, this->Environment);
  scene.AddSphere(0.4);
  vtkProperty* other = scene.AddSphere(0.6);
  scene.Render();
  EXPECT_EQ(scene.GetLayers(), "34567");
  other->SetRoughness(0.9);
  EXPECT_EQ(scene.Render(), (Counts{ { "layers", 1 } }));
  EXPECT_EQ(scene.GetLayers(), "345678");
  other->SetRoughness(0.16);
  EXPECT_EQ(scene.Render(), (Counts{ { "harmonics", 1 }, { "layers", 2 } }));
  EXPECT_EQ(scene.GetLayers(), "12345678");
  for (double roughness : { 0.2, 0.5, 1.0 })
  {
    other->SetRoughness(roughness);
    EXPECT_EQ(scene.Render(), Counts()) << roughness;
  }
  scene.ExpectNothingIsMissing();
}

// A new light is made for the scene as it is, not as it ever was. Mutant: needs kept from light to light.
TEST_F(TestSkippedWorkGL, NewLightBeginsAnew)
{
  Scene scene(this->Window, this->Environment);
  vtkProperty* property = scene.AddSphere(0.0);
  scene.AddSphere(0.2);
  scene.Render();
  scene.Renderer->GetActors()->GetLastActor()->VisibilityOff();
  property->SetRoughness(0.9);
  this->Environment->SetInputData(MakePanorama(64, Sky));
  EXPECT_EQ(scene.Render(), (Counts{ { "read", 1 }, { "harmonics", 1 }, { "layers", 4 }, { "irradiance map", 1 } }));
  EXPECT_EQ(scene.GetLayers(), "5678");
}

// What was made stays, and stages are not even asked again. Mutants: what is not seen is dropped; needs are those of
// the last frame alone.
TEST_F(TestSkippedWorkGL, HiddenAndShownAgainMakesNothing)
{
  Scene scene(this->Window, this->Environment);
  scene.AddSphere(0.0);
  scene.AddSphere(0.5);
  scene.Render();
  const Picture before = scene.See();
  vtkProp* actor = scene.Renderer->GetActors()->GetLastActor();
  actor->VisibilityOff();
  EXPECT_EQ(scene.Render(), Counts());
  EXPECT_NE(scene.See(), before);
  actor->VisibilityOn();
  EXPECT_EQ(scene.Render(), Counts());
  EXPECT_EQ(scene.See(), before);
  EXPECT_EQ(scene.GetChain()->GetNumberOfBuilds(), 1);
}

// Picking, before the first frame and after, waits for no light. Mutant: Update() whoever renders.
TEST_F(TestSkippedWorkGL, SelectionMakesNothing)
{
  Scene scene(this->Window, this->Environment);
  scene.AddSphere(0.5);
  scene.AddSphere(0.5);
  const auto select = [&]
  {
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(scene.Renderer);
    selector->SetArea(0, 0, 63, 63);
    vtkSmartPointer<vtkSelection> selection;
    selection.TakeReference(selector->Select());
    EXPECT_EQ(selection->GetNumberOfNodes(), 2u);
  };
  EXPECT_EQ(scene.Count(select), Counts());
  EXPECT_NE(scene.Render(), Counts());
  this->Environment->SetInputData(MakePanorama(64, Sky));
  EXPECT_EQ(scene.Count(select), Counts());
}

// Two windows, one environment: what is on the CPU is made once. Two environments, one file: it is read once. Mutants:
// a spectrum or faces for each chain; no look into the cache's memory.
TEST_F(TestSkippedWorkGL, AnotherWindowReadsNothing)
{
  OwnCache cache;
  const auto file = cache.GetFolder() / "sky.exr";
  WriteEXR(file, MakePanorama(128, Sky));
  vtkNew<vtkIBLEnvironment> first;
  first->SetFileName(file.c_str());
  Scene scene(this->Window, first);
  scene.AddSphere(0.0);
  scene.AddSphere(0.5);
  const Counts onGPU = { { "cube map", 1 }, { "layers", 6 }, { "irradiance map", 1 }, { "BRDF table", 1 } };
  const Counts onCPU = { { "read", 1 }, { "harmonics", 1 }, { "cube faces", 1 }, { "cache write", 1 } };
  Counts all = onGPU;
  all.insert(onCPU.begin(), onCPU.end());
  EXPECT_EQ(scene.Render(), all);

  vtkNew<vtkIBLEnvironment> same;
  same->SetFileName(file.c_str());
  const vtkTypeInt64 hits = vtkIBLCache::GetNumberOfMemoryHits();
  for (vtkIBLEnvironment* environment : { first.Get(), same.Get() })
  {
    vtkNew<vtkIBLOffscreenWindow> window;
    window->SetSize(64, 64);
    Scene other(window, environment);
    other.AddSphere(0.0);
    other.AddSphere(0.5);
    Counts expected = onGPU;
    if (environment == same)
    {
      expected["cache hit"] = 1;
    }
    EXPECT_EQ(other.Render(), expected);
    EXPECT_EQ(other.See(), scene.See());
  }
  EXPECT_EQ(vtkIBLCache::GetNumberOfMemoryHits(), hits + 1);
}

// The next start takes all that is made on the CPU from the disk, and shows the same picture, byte for byte; so does
// the next but one. Mutants: light kept before its faces or bands were made; a hit that is written again; any rounding
// on the way.
TEST_F(TestSkippedWorkGL, NextStartReadsNothing)
{
  OwnCache cache;
  const auto file = cache.GetFolder() / "sky.exr";
  WriteEXR(file, MakePanorama(128, Sky));
  Picture first;
  for (int start = 0; start < 3; ++start)
  {
    {
      vtkNew<vtkIBLEnvironment> environment;
      environment->SetFileName(file.c_str());
      Scene scene(this->Window, environment);
      scene.AddSphere(0.0);
      scene.AddSphere(0.3);
      scene.AddMatt();
      const Counts made = scene.Render();
      const Counts onGPU = { { "cube map", 1 }, { "layers", 5 }, { "irradiance map", 1 }, { "BRDF table", 1 } };
      Counts expected = onGPU;
      expected.merge(start == 0 ? Counts{ { "read", 1 }, { "harmonics", 1 }, { "cube faces", 1 }, { "cache write", 1 } }
                                : Counts{ { "cache hit", 1 } });
      EXPECT_EQ(made, expected) << start;
      first = start == 0 ? scene.See() : first;
      EXPECT_EQ(scene.See(), first) << start;
      EXPECT_EQ(scene.Render(), Counts()) << start;
    } // waits for what is being written
    vtkIBLCache::ClearMemory();
  }
}

// What that saves with a large file: 4096 x 2048, noise on a sky, everything made. Times are printed, not judged.
// Mutants: as above; a hit whose pixels are read nevertheless.
TEST_F(TestSkippedWorkGL, NextStartOfALargeFile)
{
  OwnCache cache;
  const auto file = cache.GetFolder() / "large.exr";
  vtkNew<vtkImageData> image;
  image->SetDimensions(4096, 2048, 1);
  image->AllocateScalars(VTK_FLOAT, 3);
  auto* rgb = static_cast<float*>(image->GetScalarPointer());
  std::minstd_rand random(1);
  for (vtkIdType i = 0; i < 3 * image->GetNumberOfPoints(); ++i)
  {
    const double noise = double(random()) / std::minstd_rand::max();
    rgb[i] = float(1 + 0.8 * std::sin(i * 1e-3) * std::sin(i / 3 / 4096 * 5e-3) + 0.1 * noise);
  }
  WriteEXR(file, image);
  double seconds[2];
  for (double& time : seconds)
  {
    {
      vtkNew<vtkIBLEnvironment> environment;
      environment->SetFileName(file.c_str());
      Scene scene(this->Window, environment);
      scene.GetChain()->SetFaceSize(0);
      const Counts made = scene.Count(
        [&]
        {
          const auto start = std::chrono::steady_clock::now();
          EXPECT_TRUE(scene.GetLighting()->Update(this->Window));
          time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        });
      EXPECT_EQ(made.count("read") + made.count("harmonics") + made.count("cube faces"), &time == seconds ? 3u : 0u);
      EXPECT_EQ(made.count("cache hit"), &time == seconds ? 0u : 1u);
    }
    vtkIBLCache::ClearMemory();
  }
  std::printf("all light of 4096 x 2048: first start %.0f ms, next start %.0f ms, %.1f times as fast\n",
    1e3 * seconds[0], 1e3 * seconds[1], seconds[0] / seconds[1]);
}

// Light of a lat-long image compiles no compute program at all: the table is a constant, and all else is made on the
// CPU. 1024 samples of a table do, which shows that this counts them. Mutants: the table sampled, mip levels of the
// cube map made for nobody.
TEST_F(TestSkippedWorkGL, NoComputeProgramIsCompiled)
{
  Scene scene(this->Window, this->Environment);
  scene.AddSphere(0.0);
  scene.AddSphere(0.5);
  scene.Pass->BackgroundVisibleOn();
  const auto countComputePrograms = [this]
  {
    this->Window->MakeCurrent();
    int count = 0;
    for (GLuint name = 1; name < 4096; ++name)
    {
      GLint uniforms = 0;
      if (glIsProgram(name))
      {
        glGetProgramInterfaceiv(name, GL_UNIFORM, GL_ACTIVE_RESOURCES, &uniforms);
      }
      bool isCompute = false; // each of ours has a uniform
      for (GLint i = 0; i < uniforms; ++i)
      {
        const GLenum property = GL_REFERENCED_BY_COMPUTE_SHADER;
        GLint isRead = 0;
        glGetProgramResourceiv(name, GL_UNIFORM, i, 1, &property, 1, nullptr, &isRead);
        isCompute = isCompute || isRead;
      }
      count += isCompute;
    }
    return count;
  };
  scene.Render();
  EXPECT_EQ(countComputePrograms(), 0);
  scene.GetLighting()->GetBRDFTable()->SetNumberOfSamples(1024);
  EXPECT_EQ(scene.Render(), (Counts{ { "BRDF table", 1 } }));
  EXPECT_EQ(countComputePrograms(), 1);
}
