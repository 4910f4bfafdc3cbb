// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Probes as files: what comes back, and what is said of files that are not such.
#include "TestSupport.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLProbe.h"

#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <fstream>
#include <sstream>

namespace fs = std::filesystem;

class TestProbeFile : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Folder = fs::temp_directory_path() / ("vtkIBL probe file " + std::to_string(getpid()));
    fs::create_directories(this->Folder);
    this->Probe->SetPosition(1.0 / 3.0, 1e7 + 0.1, -2e-9);
    this->Probe->SetProxy(vtkIBLProbe::Ellipsoid);
    this->Probe->SetBounds(-1.1, 2.2, 1e7, 1e7 + 1.0 / 7.0, -3, 4);
    this->Probe->SetInfluenceBounds(-5.5, 6.6, 1e7 - 7, 1e7 + 8, -9, 10);
    this->Probe->SetOrientation(10.1, 20.2, 30.3);
    this->Probe->SetBlendDistance(0.123456789012345678);
    this->Probe->SetIntensity(0.7);
  }
  void TearDown() override { fs::remove_all(this->Folder); }
  std::string Path(const std::string& name) const { return (this->Folder / name).string(); }
  std::string GetBytes(const std::string& name) const
  {
    std::ostringstream bytes;
    bytes << std::ifstream(this->Path(name), std::ios::binary).rdbuf();
    return bytes.str();
  }
  // All that a file can hold of a probe.
  static std::vector<double> GetSettings(vtkIBLProbe* probe)
  {
    std::vector<double> all = { double(probe->GetProxy()), probe->GetBlendDistance(), probe->GetIntensity(),
      double(probe->HasInfluenceBounds()) };
    double influence[6];
    probe->GetInfluenceBounds(influence);
    all.insert(all.end(), influence, influence + 6);
    all.insert(all.end(), probe->GetBounds(), probe->GetBounds() + 6);
    all.insert(all.end(), probe->GetPosition(), probe->GetPosition() + 3);
    all.insert(all.end(), probe->GetOrientation(), probe->GetOrientation() + 3);
    return all;
  }
  // Reading fails, says so in these words, and leaves a probe as it was.
  void ExpectNotRead(const char* fileName, const std::string& words)
  {
    vtkNew<vtkIBLProbe> probe;
    const std::vector<double> before = GetSettings(probe);
    EXPECT_FALSE(probe->ReadFile(fileName));
    const std::string said = this->Messages.Take();
    EXPECT_NE(said.find(words), std::string::npos) << words << "\n" << said;
    EXPECT_NE(said.find("Give a file of"), std::string::npos) << said;
    EXPECT_EQ(GetSettings(probe), before);
    EXPECT_FALSE(probe->GetEnvironment());
  }

  fs::path Folder; // its name has a blank
  CaughtMessages Messages;
  vtkNew<vtkIBLProbe> Probe;
  // Radiance with all digits of a float, small and large.
  vtkSmartPointer<vtkImageData> Radiance = MakeFaces(16,
    [](Vec3 d) {
      return RGB{ 1e-6 * (2 + d.x), 1.0 / 3.0 + 0.1 * d.y, 1e5 * (2 + d.z) };
    });
};

// What comes back is what was written, to the last bit, in spite of a locale with decimal commas. Mutants: half floats,
// a lossy compression, 6 digits, rows flipped, two faces swapped, a setting forgotten.
TEST_F(TestProbeFile, ComesBackToTheBit)
{
  setlocale(LC_ALL, "de_DE.UTF-8"); // where there is one
  for (const bool ownInfluence : { true, false })
  {
    if (!ownInfluence)
    {
      this->Probe->SetInfluenceToBounds();
    }
    ASSERT_TRUE(this->Probe->WriteFile(this->Path("p.exr").c_str(), this->Radiance)) << this->Messages.Take();
    EXPECT_TRUE(vtkIBLProbe::CanReadFile(this->Path("p.exr").c_str()));
    vtkNew<vtkIBLProbe> probe;
    probe->SetInfluenceBounds(0, 1, 0, 1, 0, 1); // which has to go in the second round
    ASSERT_TRUE(probe->ReadFile(this->Path("p.exr").c_str())) << this->Messages.Take();
    EXPECT_EQ(GetSettings(probe), GetSettings(this->Probe));
    ASSERT_TRUE(probe->GetEnvironment() && probe->GetEnvironment()->Update());
    vtkImageData* back = probe->GetEnvironment()->GetRadianceImage();
    ASSERT_EQ(back->GetNumberOfPoints(), 6 * 16 * 16);
    const auto* a = static_cast<const float*>(this->Radiance->GetScalarPointer());
    EXPECT_TRUE(std::equal(a, a + 3 * 6 * 16 * 16, static_cast<const float*>(back->GetScalarPointer())));
  }
  setlocale(LC_ALL, "C");
  EXPECT_EQ(this->Messages.Take(), "");
}

// Mutants: no look at the number of parts, or at the header; a null pointer used; settings made before the texels are
// read.
TEST_F(TestProbeFile, WhatIsNoProbeIsNotRead)
{
  ASSERT_TRUE(this->Probe->WriteFile(this->Path("p.exr").c_str(), this->Radiance));
  const std::string whole = this->GetBytes("p.exr");
  std::ofstream(this->Path("text.exr")) << "no picture";
  std::ofstream(this->Path("empty.exr"));
  WriteEXR(this->Folder / "sky.exr", MakePanorama(8, [](Vec3) { return RGB{ 1, 1, 1 }; }));
  this->ExpectNotRead(nullptr, "there is no such file");
  this->ExpectNotRead(this->Path("gone.exr").c_str(), "gone.exr': there is no such file");
  this->ExpectNotRead(this->Folder.c_str(), "there is no such file");
  this->ExpectNotRead(this->Path("text.exr").c_str(), "not an image file");
  this->ExpectNotRead(this->Path("empty.exr").c_str(), "empty.exr");
  this->ExpectNotRead(this->Path("sky.exr").c_str(), "it has 1 parts, a probe's file has six");
  EXPECT_FALSE(vtkIBLProbe::CanReadFile(this->Path("sky.exr").c_str()));
  EXPECT_FALSE(vtkIBLProbe::CanReadFile(this->Path("text.exr").c_str()));
  EXPECT_FALSE(vtkIBLProbe::CanReadFile(nullptr));
  for (const double share : { 0.01, 0.1, 0.5, 0.9, 0.999 })
  {
    std::ofstream(this->Path("cut.exr"), std::ios::binary) << whole.substr(0, std::size_t(share * whole.size()));
    this->ExpectNotRead(this->Path("cut.exr").c_str(), "cut.exr");
  }
  // Another's six parts; and numbers that are none.
  const auto edit = [&](const std::string& from, const std::string& to)
  {
    std::string bytes = whole;
    const std::size_t at = bytes.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    bytes.replace(at, to.size(), to);
    std::ofstream(this->Path("edited.exr"), std::ios::binary) << bytes;
  };
  edit("vtkIBL.probe.position", "vtkIBL.probe.nowhere_");
  this->ExpectNotRead(this->Path("edited.exr").c_str(), "it has no vtkIBL.probe.position of 3 numbers");
  edit("0.69999999999999996", "-.69999999999999996");
  this->ExpectNotRead(this->Path("edited.exr").c_str(), "it has an intensity below 0");
  edit("0.69999999999999996", "nan                ");
  this->ExpectNotRead(this->Path("edited.exr").c_str(), "vtkIBL.probe.intensity");
}

// Where nothing can be written nothing is, and an older file stays whole. Mutants: written in place; what is beside it
// left there.
TEST_F(TestProbeFile, AFailedWriteLeavesTheOldFile)
{
  ASSERT_TRUE(this->Probe->WriteFile(this->Path("p.exr").c_str(), this->Radiance));
  const std::string whole = this->GetBytes("p.exr");
  fs::create_directories(this->Folder / "folder.exr");
  const auto expectNotWritten = [&](const char* fileName, vtkImageData* radiance, const std::string& words)
  {
    EXPECT_FALSE(this->Probe->WriteFile(fileName, radiance));
    const std::string said = this->Messages.Take();
    EXPECT_NE(said.find("cannot write probe '"), std::string::npos) << said;
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  expectNotWritten(nullptr, this->Radiance, "no name");
  expectNotWritten(this->Path("gone/p.exr").c_str(), this->Radiance, "No such file or directory");
  expectNotWritten(this->Path("folder.exr").c_str(), this->Radiance, "s a directory");
  expectNotWritten(this->Path("p.exr").c_str(), nullptr, "give what CaptureProbe() returned");
  expectNotWritten(this->Path("p.exr").c_str(), MakePanorama(8, [](Vec3) { return RGB{ 1, 1, 1 }; }), "n x n x 6");
  EXPECT_EQ(this->GetBytes("p.exr"), whole);
  EXPECT_EQ(std::distance(fs::directory_iterator(this->Folder), fs::directory_iterator()), 2);
}
