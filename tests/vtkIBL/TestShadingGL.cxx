// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What a lit pixel is worth, judged by closed forms and by quadrature.
#include "TestScene.h"

namespace reference = vtkIBLReference;

class TestShadingGL : public PlaneScene
{
protected:
  void UseConstantEnvironment(double radiance)
  {
    this->Environment->SetInputData(MakePanorama(16, [=](Vec3) { return RGB{ radiance, radiance, radiance }; }));
  }
};

// White furnace without compensation: a white metal under constant light reflects A + B of it, and no more. 2e-3: 64^2
// table, half floats. Mutants: roughness for alpha anywhere, NoV of the wrong vector, table axes swapped.
TEST_F(TestShadingGL, PlainFurnaceIsAPlusB)
{
  this->UseConstantEnvironment(1.0);
  this->Pass->GetLighting()->EnergyCompensationOff();
  for (double roughness : { 0.0, 0.1, 0.25, 0.5, 0.75, 1.0 })
  {
    for (double NoV : { 1.0, 0.8, 0.5, 0.2, 0.05 })
    {
      this->SetMaterial(1.0, roughness, { 1, 1, 1 });
      this->SetNoV(NoV);
      const double truth = roughness > 0 ? reference::DirectionalAlbedo(NoV, roughness) : 1.0;
      EXPECT_NEAR(this->Capture()[1], truth, 2e-3) << "roughness " << roughness << " NoV " << NoV;
    }
  }
}

// White furnace with compensation: a white surface vanishes in a constant environment, metal or not, rough or not.
// 1e-3: half floats. Mutants: diffuse light not reduced by what the specular lobe took, the mean Fresnel's 1/21.
TEST_F(TestShadingGL, CompensatedFurnaceIsWhite)
{
  this->UseConstantEnvironment(2.5);
  for (double metallic : { 0.0, 0.5, 1.0 })
  {
    for (double roughness : { 0.0, 0.3, 0.7, 1.0 })
    {
      for (double NoV : { 1.0, 0.4, 0.05 })
      {
        this->SetMaterial(metallic, roughness, { 1, 1, 1 });
        this->SetNoV(NoV);
        for (double channel : this->Capture())
        {
          EXPECT_NEAR(channel, 2.5, 2.5e-3) << "metallic " << metallic << " roughness " << roughness << " NoV " << NoV;
        }
      }
    }
  }
}

// A dielectric's two parts under constant light: f0 A + B, and with energy compensation albedo times what is left of 1;
// without, Lambert under Schlick's term at each light's own half vector, whose integral is the reference's. 2e-3.
// Mutants: (1 - f0) for the diffuse share, (1 - F) at the normal's angle (0.05 off at NoV 0.3), the two swapped.
TEST_F(TestShadingGL, DielectricIsSpecularPlusTheRest)
{
  this->UseConstantEnvironment(1.0);
  const reference::Environment constant = reference::ConstantEnvironment({ 1, 1, 1 }, 64, 32);
  for (double roughness : { 0.3, 0.8 })
  {
    for (double NoV : { 1.0, 0.3 })
    {
      const RGB albedo = { 0.5, 0.2, 0.0 };
      this->SetMaterial(0.0, roughness, albedo);
      this->SetNoV(NoV);
      const double f0 = 0.04; // VTK's default index of refraction, 1.5; its f90 is then clamp(50 * 0.33 * 3 f0) = 1
      const reference::SplitSum ab = reference::SplitSumAB(NoV, roughness);
      const double missing = 1 - ab.A - ab.B;
      const double mean = f0 + (1 - f0) / 21;
      const double once = f0 * ab.A + ab.B;
      const double again = missing * once * mean / (1 - missing * mean);
      const RGB single = reference::FullBRDFRadiance(
        constant, { 0, 0, 1 }, { std::sqrt(1 - NoV * NoV), 0, NoV }, roughness, { f0, f0, f0 }, albedo);
      for (bool compensation : { true, false })
      {
        this->Pass->GetLighting()->SetEnergyCompensation(compensation);
        const RGB seen = this->Capture();
        for (int k = 0; k < 3; ++k)
        {
          const double whole = once + again + albedo[k] * (1 - once - again);
          EXPECT_NEAR(seen[k], compensation ? whole : single[k], 2e-3)
            << roughness << " " << NoV << " " << compensation;
        }
      }
    }
  }
}

// A mirror shows the environment where the reflected ray goes: R = 2 (N.V) N - V. The panorama is linear, so one texel
// of blur is 1e-2 at most. Mutants: a flipped axis anywhere on the way, the inverse of the view rotation.
TEST_F(TestShadingGL, MirrorShowsTheReflectedDirection)
{
  this->Environment->SetInputData(MakePanorama(256, [](Vec3 d) { return RGB{ 1.5 + d.x, 1.5 + d.y, 1.5 + d.z }; }));
  this->SetMaterial(1.0, 0.0, { 1, 1, 1 });
  for (double tilt : { -70.0, -20.0, 0.0, 45.0, 80.0 })
  {
    for (double turn : { 0.0, 30.0, 90.0, 200.0 })
    {
      // The whole scene, camera and all, turned about y and then x.
      this->Actor->SetOrientation(0, tilt, 0);
      vtkCamera* camera = this->Renderer->GetActiveCamera();
      const double rad = turn * reference::Pi / 180, t = tilt * reference::Pi / 180;
      const Vec3 view = { std::sin(rad) * 0.8, 0.6, std::cos(rad) * 0.8 };
      const Vec3 normal = { std::sin(t), 0, std::cos(t) };
      const double NoV = reference::Dot(normal, view);
      if (NoV < 0.05)
      {
        continue;
      }
      camera->SetPosition(2000 * view.x, 2000 * view.y, 2000 * view.z);
      const Vec3 mirrored = 2 * NoV * normal - view;
      const RGB seen = this->Capture();
      EXPECT_NEAR(seen[0], 1.5 + mirrored.x, 1e-2) << tilt << " " << turn;
      EXPECT_NEAR(seen[1], 1.5 + mirrored.y, 1e-2) << tilt << " " << turn;
      EXPECT_NEAR(seen[2], 1.5 + mirrored.z, 1e-2) << tilt << " " << turn;
    }
  }
}

// A matt white surface in L = 1 + d.y shows (pi + 2 pi/3 N.y)/pi. Roughness 1 leaves a broad lobe, so judge an ideal
// one: black-free, f0 = 0. 2e-3.
TEST_F(TestShadingGL, MattSurfaceShowsIrradiance)
{
  this->Environment->SetInputData(MakePanorama(128, [](Vec3 d) { return RGB{ 1 + d.x, 1 + d.x, 1 + d.x }; }));
  this->SetMaterial(0.0, 1.0, { 0.7, 0.7, 0.7 });
  this->Actor->GetProperty()->SetBaseIOR(1.0); // f0 = 0, and VTK's f90 = 0 with it
  for (double NoV : { 1.0, 0.7, 0.3 })
  {
    this->SetNoV(NoV);
    const double nx = std::sqrt(1 - NoV * NoV);
    EXPECT_NEAR(this->Capture()[0], 0.7 * (1 + 2.0 / 3.0 * nx), 2e-3) << NoV;
  }
}

// Intensity, tint and exposure are factors, exact but for rounding; nothing is built for them.
TEST_F(TestShadingGL, IntensityTintAndExposureAreFactors)
{
  this->Environment->SetInputData(MakePanorama(64, [](Vec3 d) { return RGB{ 3 + d.x, 3 + d.y, 3 + d.z }; }));
  this->SetMaterial(0.3, 0.4, { 0.8, 0.6, 0.4 });
  const RGB plain = this->Capture();
  this->Environment->SetIntensity(2.0);
  this->Environment->SetTint(1.0, 0.5, 0.25);
  const RGB scaled = this->Capture();
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_NEAR(scaled[k] / plain[k], 2.0 * std::pow(0.5, k), 1e-5);
  }
  this->Environment->SetIntensity(1.0);
  this->Environment->SetTint(1, 1, 1);
  this->Environment->NormalizeExposureOn();
  EXPECT_NEAR(this->Environment->GetMeanLuminance(), 3.0, 1e-5);
  EXPECT_NEAR(this->Capture()[0] / plain[0], 1.0 / 3.0, 1e-5);
  // Display encoding is the power 1/2.2, as VTK has it: half a step of 8 bits.
  const double linear = this->Capture()[1];
  EXPECT_NEAR(this->GetCentre()[1], 255 * std::pow(linear, 1 / 2.2), 0.51);
}

// Turning the environment by an angle about its up axis turns what a mirror shows by the same angle. Mutants: the wrong
// sense, Up ignored.
TEST_F(TestShadingGL, RotationTurnsTheLight)
{
  this->Environment->SetInputData(MakePanorama(256, [](Vec3 d) { return RGB{ 1.5 + d.x, 1.5 + d.y, 1.5 + d.z }; }));
  this->SetMaterial(1.0, 0.0, { 1, 1, 1 });
  this->SetNoV(1.0); // mirrors the world's +z
  auto expect = [&](Vec3 own)
  {
    const RGB seen = this->Capture();
    EXPECT_NEAR(seen[0], 1.5 + own.x, 1e-2);
    EXPECT_NEAR(seen[1], 1.5 + own.y, 1e-2);
    EXPECT_NEAR(seen[2], 1.5 + own.z, 1e-2);
  };
  expect({ 0, 0, 1 });
  // Counterclockwise from above takes the environment's +z to the world's +x, and its -x to the world's +z.
  this->Environment->SetRotation(90);
  expect({ -1, 0, 0 });
  // z up: the environment's +y is the world's +z.
  this->Environment->SetRotation(0);
  this->Environment->SetUp(0, 0, 1);
  expect({ 0, 1, 0 });
  this->Environment->SetRotation(123);
  expect({ 0, 1, 0 });
}

// Sampling converges to the reflection integral over a real HDRI: GGX lobe and Lambert's base, both sides of the mirror
// direction. 4096 samples leave about 1 % on a map without suns. Mutants: a weight off by a tenth, VoH for NoV in the
// Fresnel term, the shift of one axis only.
TEST_F(TestShadingGL, SampledModeIsTheIntegral)
{
  const std::string path = GetHDRI("courtyard");
  if (path.empty())
  {
    GTEST_SKIP() << "no HDRIs: install blender-data";
  }
  this->Environment->SetFileName(path.c_str());
  this->Pass->GetLighting()->EnergyCompensationOff();
  this->Pass->GetLighting()->SetSamplesPerPixel(4096);
  ASSERT_TRUE(this->Environment->Update());
  const reference::Environment environment = ToReference(this->Environment->GetRadianceImage());
  for (double metallic : { 0.0, 1.0 })
  {
    for (double roughness : { 0.2, 0.5, 1.0 })
    {
      for (double NoV : { 0.9, 0.3 })
      {
        const RGB color = { 0.9, 0.6, 0.3 };
        this->SetMaterial(metallic, roughness, color);
        this->SetNoV(NoV);
        const RGB f0 = metallic > 0 ? color : RGB{ 0.04, 0.04, 0.04 };
        const RGB diffuse = metallic > 0 ? RGB{} : color;
        const RGB truth = reference::FullBRDFRadiance(
          environment, { std::sqrt(1 - NoV * NoV), 0, NoV }, { 0, 0, 1 }, roughness, f0, diffuse);
        const RGB seen = this->Capture();
        for (int k = 0; k < 3; ++k)
        {
          EXPECT_NEAR(seen[k] / truth[k], 1, 0.015)
            << "metallic " << metallic << " roughness " << roughness << " NoV " << NoV;
        }
      }
    }
  }
}

// The furnace is as white when sampled, and with it on and off in turn the shader follows. Mutant: the stage's time not
// bumped.
TEST_F(TestShadingGL, SampledFurnaceIsWhite)
{
  this->UseConstantEnvironment(2.0);
  for (int samples : { 1024, 0, 1024 })
  {
    this->Pass->GetLighting()->SetSamplesPerPixel(samples);
    for (double metallic : { 0.0, 0.5, 1.0 })
    {
      this->SetMaterial(metallic, 0.6, { 1, 1, 1 });
      this->SetNoV(0.4);
      EXPECT_NEAR(this->Capture()[1], 2.0, samples > 0 ? 1e-2 : 2e-3) << samples << " " << metallic;
    }
  }
}

// Between layers: seen face on, a white metal with plain lobes shows the prefiltered radiance at its roughness, times A
// + B, and the rest of 1 of irradiance. A light that fades over half the sky tells roughnesses apart (10 % a layer);
// what is left is interpolation, 512 samples and 16^2 texels: 2 %. Mutants: the share of the two layers swapped, either
// mip level off by one, perceptualRoughness squared once more.
TEST_F(TestShadingGL, InterpolatesBetweenLayers)
{
  vtkSmartPointer<vtkImageData> panorama = MakePanorama(128,
    [](Vec3 d)
    {
      const double l = 0.05 + 20 * std::exp(12 * (reference::Dot(d, reference::Normalize({ 0.3, 0.2, 1 })) - 1));
      return RGB{ l, l, l };
    });
  this->Environment->SetInputData(panorama);
  this->Pass->GetLighting()->SetReflectionModel(vtkIBLLighting::Classic);
  const reference::Environment environment = ToReference(panorama);
  const double irradiance = reference::Irradiance(environment, { 0, 0, 1 })[0] / reference::Pi;
  this->SetNoV(1.0);
  for (double roughness : { 0.115, 0.155, 0.21, 0.27, 0.36, 0.49, 0.65, 0.87 })
  {
    this->SetMaterial(1.0, roughness, { 1, 1, 1 });
    const double albedo = reference::DirectionalAlbedo(1.0, roughness, reference::Geometry::SchlickSmith);
    const double truth =
      albedo * reference::PrefilteredRadiance(environment, { 0, 0, 1 }, roughness)[0] + (1 - albedo) * irradiance;
    EXPECT_NEAR(this->Capture()[0] / truth, 1, 0.02) << roughness;
  }
}

// Light scattered twice or more by a coloured metal, from (A, B) and Schlick's mean over the hemisphere, both by
// quadrature (Fdez-Aguera 2019). 2e-3. Mutant: the mean's 1/21.
TEST_F(TestShadingGL, CompensatesColouredMetal)
{
  this->UseConstantEnvironment(1.0);
  for (double f0 : { 0.2, 0.5, 0.9 })
  {
    for (double NoV : { 1.0, 0.3 })
    {
      this->SetMaterial(1.0, 0.9, { f0, f0, f0 });
      this->SetNoV(NoV);
      const reference::SplitSum ab = reference::SplitSumAB(NoV, 0.9);
      double mean = 0.0;
      for (int i = 0; i < 1000; ++i)
      {
        const double mu = (i + 0.5) / 1000;
        mean += 2 * mu * (f0 + (1 - f0) * reference::SchlickWeight(mu)) / 1000;
      }
      const double once = f0 * ab.A + ab.B;
      const double missing = 1 - ab.A - ab.B;
      EXPECT_NEAR(this->Capture()[0], once + missing * once * mean / (1 - missing * mean), 2e-3) << f0 << " " << NoV;
    }
  }
}

// In parallel projection every ray is the same, also at the picture's edge with the camera near. Mutant: V from the
// fragment's position (0.3 off here).
TEST_F(TestShadingGL, ParallelRaysAreParallel)
{
  this->Environment->SetInputData(MakePanorama(256, [](Vec3 d) { return RGB{ 1.5 + d.x, 1.5 + d.y, 1.5 + d.z }; }));
  this->SetMaterial(1.0, 0.0, { 1, 1, 1 });
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(0, 0, 3);
  camera->SetClippingRange(1, 5);
  vtkSmartPointer<vtkImageData> image = this->Pass->CaptureRadiance(this->Renderer);
  for (int edge : { 1, 32, 62 })
  {
    const auto* seen = static_cast<const float*>(image->GetScalarPointer(edge, edge, 0));
    EXPECT_NEAR(seen[0], 1.5, 1e-2);
    EXPECT_NEAR(seen[2], 2.5, 1e-2);
  }
}
