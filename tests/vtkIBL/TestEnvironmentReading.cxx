// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// How a file becomes light: through the cache, step by step, on a thread; and what happens when it changes meanwhile.
#include "TestSupport.h"

#include "vtkIBLCache.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLImageReader.h"
#include "vtkIBLSpectrum.h"
#include "vtkIBLStatistics.h"

#include <vtkCallbackCommand.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace fs = std::filesystem;
using Statistics = vtkIBLStatistics;

class TestEnvironmentReading : public ::testing::Test
{
protected:
  CaughtMessages Messages;
  OwnCache Cache;
  vtkSmartPointer<vtkIBLEnvironment> Environment = vtkSmartPointer<vtkIBLEnvironment>::New();

  void TearDown() override { EXPECT_EQ(this->Messages.Take(), ""); }

  fs::path Write(const std::string& name, double level, int height = 64)
  {
    const fs::path file = this->Cache.GetFolder() / name;
    // For large ones a function of direction would take longer than all else.
    vtkNew<vtkImageData> image;
    image->SetDimensions(2 * height, height, 1);
    image->AllocateScalars(VTK_FLOAT, 3);
    auto* rgb = static_cast<float*>(image->GetScalarPointer());
    std::generate_n(
      rgb, 3 * image->GetNumberOfPoints(), [level, i = 0]() mutable { return float(level * (1 + i++ % 8)); });
    WriteEXR(file, image);
    return file;
  }
  fs::path WriteLarge(const std::string& name, double level) { return this->Write(name, level, 2048); } // four bands
  static double MeanOf(double level) { return 4.5 * level; }

  // Reads, analyses and keeps what `file` has, as a first start does, and waits until that is written.
  void Keep(const fs::path& file)
  {
    vtkNew<vtkIBLEnvironment> first;
    first->SetFileName(file.c_str());
    first->Update();
    first->GetSpectrum(48);
    first->KeepLight();
    EXPECT_EQ(first->GetStatistics()->GetCount(Statistics::CacheWrite), 1);
  }
  void SetFile(const fs::path& file)
  {
    this->Environment->SetFileName(file.c_str());
    EXPECT_TRUE(this->Environment->Update());
  }
  void WaitForThread()
  {
    while (this->Environment->IsBusy())
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  void ExpectCounts(int reads, int hits, int harmonics)
  {
    const Statistics* done = this->Environment->GetStatistics();
    EXPECT_EQ(done->GetCount(Statistics::Read), reads);
    EXPECT_EQ(done->GetCount(Statistics::CacheHit), hits);
    EXPECT_EQ(done->GetCount(Statistics::Harmonics), harmonics);
  }
};

// Known by its content: a copy of another name and date is found, on disk as in memory, with all that was known of it.
// Mutants: name or date in the key; size, mean or faults not stored; harmonics made again.
TEST_F(TestEnvironmentReading, KnownContentIsNotRead)
{
  const fs::path file = this->Write("sky.exr", 1);
  this->Keep(file);
  vtkNew<vtkIBLEnvironment> read;
  vtkIBLCache::SetEnabled(false);
  read->SetFileName(file.c_str());
  EXPECT_TRUE(read->Update());
  vtkIBLCache::SetEnabled(true);
  const fs::path copy = this->Cache.GetFolder() / "copy.exr";
  fs::rename(file, copy);
  for (bool onDisk : { false, true })
  {
    if (onDisk)
    {
      vtkIBLCache::ClearMemory();
    }
    this->Environment = vtkSmartPointer<vtkIBLEnvironment>::New();
    this->SetFile(copy);
    EXPECT_EQ(this->Environment->GetSpectrum(48)->GetCoefficients(), read->GetSpectrum(48)->GetCoefficients());
    this->Environment->KeepLight();
    this->ExpectCounts(0, 1, 0);
    EXPECT_EQ(this->Environment->GetStatistics()->GetCount(Statistics::CacheWrite), 0);
    EXPECT_EQ(this->Environment->GetWidth(), 128);
    EXPECT_EQ(this->Environment->GetHeight(), 64);
    EXPECT_EQ(this->Environment->GetNumberOfFaces(), 1);
    EXPECT_EQ(this->Environment->GetMeanLuminance(), read->GetMeanLuminance());
    EXPECT_TRUE(this->Environment->GetRadianceImage()); // read now
    this->ExpectCounts(1, 1, 0);
  }
}

// What one adds to a light that others have, too, is its own until it is kept, and the next one's then. Mutants: the
// shared light changed under the others' feet; a light that was found never kept again.
TEST_F(TestEnvironmentReading, KnownLightGrows)
{
  const fs::path file = this->Write("sky.exr", 1);
  this->Keep(file);
  this->SetFile(file);
  vtkNew<vtkIBLEnvironment> other;
  other->SetFileName(file.c_str());
  EXPECT_TRUE(other->Update());
  EXPECT_EQ(this->Environment->GetSpectrum(60)->GetOrder(), 60);
  this->ExpectCounts(1, 1, 1);
  EXPECT_EQ(other->GetSpectrum(48)->GetOrder(), 48);
  this->Environment->KeepLight();
  this->Environment = vtkSmartPointer<vtkIBLEnvironment>::New(); // waits for it
  this->SetFile(file);
  EXPECT_EQ(this->Environment->GetSpectrum(60)->GetOrder(), 60);
  this->ExpectCounts(0, 1, 0);
}

// Mutants: either setting left out of the key.
TEST_F(TestEnvironmentReading, OtherSettingsAreAnotherLight)
{
  const fs::path file = this->Write("sky.exr", 0.1);
  this->Keep(file);
  this->Environment->SetMaximumWidth(64);
  this->SetFile(file);
  this->ExpectCounts(1, 0, 0);
  EXPECT_EQ(this->Environment->GetWidth(), 64);
  this->Environment->SetMaximumWidth(4096);
  this->Environment->SetColorSpace(vtkIBLImageReader::ColorSpaceSRGB);
  EXPECT_TRUE(this->Environment->Update());
  this->ExpectCounts(2, 0, 0);
  EXPECT_LT(this->Environment->GetMeanLuminance(), 0.8 * MeanOf(0.1));
  this->Environment->SetColorSpace(vtkIBLImageReader::ColorSpaceAuto);
  EXPECT_TRUE(this->Environment->Update());
  this->ExpectCounts(2, 1, 0);
  EXPECT_NEAR(this->Environment->GetMeanLuminance(), MeanOf(0.1), 1e-3);
}

// A file replaced by another is seen when its name is set again, or after Modified(), and is then a new light; one that
// is the same still is not. Mutants: the name compared and no more; a new light each time.
TEST_F(TestEnvironmentReading, ReplacedFileIsANewLight)
{
  const fs::path file = this->Write("sky.exr", 1);
  this->SetFile(file);
  const vtkMTimeType first = this->Environment->GetRadianceTime();
  this->SetFile(file);
  this->Environment->Modified();
  EXPECT_TRUE(this->Environment->Update());
  EXPECT_EQ(this->Environment->GetRadianceTime(), first);
  this->ExpectCounts(1, 0, 0);

  this->Write("sky.exr", 2);
  EXPECT_TRUE(this->Environment->Update());
  EXPECT_EQ(this->Environment->GetRadianceTime(), first); // nobody said so
  this->SetFile(file);
  EXPECT_GT(this->Environment->GetRadianceTime(), first);
  EXPECT_NEAR(this->Environment->GetMeanLuminance(), MeanOf(2), 1e-3);
  this->Write("sky.exr", 3);
  this->Environment->Modified();
  EXPECT_TRUE(this->Environment->Update());
  EXPECT_NEAR(this->Environment->GetMeanLuminance(), MeanOf(3), 1e-3);
  this->ExpectCounts(3, 0, 0);
}

// Out of the cache, and then the file is gone, or is another one: an error that says so when pixels are needed, and
// only then; the light stays, and goes on when the file is back. Mutants: the other file's pixels taken; the light
// dropped.
TEST_F(TestEnvironmentReading, VanishedFileSaysSoWhenItIsNeeded)
{
  const fs::path file = this->Write("sky.exr", 1);
  const fs::path away = this->Cache.GetFolder() / "away.exr";
  this->Keep(file);
  this->SetFile(file);
  fs::rename(file, away);
  for (bool isAnother : { false, true })
  {
    if (isAnother)
    {
      this->Write("sky.exr", 2);
    }
    EXPECT_TRUE(this->Environment->Update());
    EXPECT_EQ(this->Environment->GetSpectrum(48)->GetOrder(), 48);
    EXPECT_EQ(this->Environment->GetRadianceImage(), nullptr);
    const std::string message = this->Messages.Take();
    EXPECT_NE(message.find("The light of '" + file.string() + "' came out of the cache"), std::string::npos) << message;
    EXPECT_NE(message.find("SetFileName()"), std::string::npos) << message;
    EXPECT_THROW(this->Environment->GetSpectrum(49), std::runtime_error);
    EXPECT_THROW(this->Environment->GetCube(16), std::runtime_error);
    EXPECT_EQ(this->Environment->GetSpectrum(48)->GetOrder(), 48);
    EXPECT_NEAR(this->Environment->GetMeanLuminance(), MeanOf(1), 1e-3);
  }
  fs::rename(away, file);
  EXPECT_NE(this->Environment->GetRadianceImage(), nullptr);
  this->ExpectCounts(1, 1, 0);
}

// Progress of reading goes to observers, from 0 to 1; an observer that calls it off leaves the last light, without a
// word, until the source is set again. Mutants: no events; AbortExecute not cleared, or not asked; half a picture
// taken.
TEST_F(TestEnvironmentReading, ReportsProgressAndCanBeCalledOff)
{
  struct Watch
  {
    std::vector<double> Progress;
    double AbortAt;
  } watch{ {}, 2 };
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&watch);
  command->SetCallback(
    [](vtkObject* who, unsigned long, void* data, void* progress)
    {
      auto* to = static_cast<Watch*>(data);
      to->Progress.push_back(*static_cast<double*>(progress));
      if (to->Progress.back() >= to->AbortAt)
      {
        static_cast<vtkIBLEnvironment*>(who)->SetAbortExecute(true);
      }
    });
  this->Environment->AddObserver(vtkCommand::ProgressEvent, command);
  this->SetFile(this->WriteLarge("first.exr", 1));
  ASSERT_GE(watch.Progress.size(), 4u);
  EXPECT_TRUE(std::is_sorted(watch.Progress.begin(), watch.Progress.end()));
  EXPECT_EQ(watch.Progress.back(), 1);
  const vtkMTimeType first = this->Environment->GetRadianceTime();

  const fs::path second = this->WriteLarge("second.exr", 2);
  watch = { {}, 0.2 };
  this->SetFile(second);
  ASSERT_FALSE(watch.Progress.empty());
  EXPECT_LT(watch.Progress.back(), 1);
  EXPECT_EQ(this->Environment->GetRadianceTime(), first);
  const std::size_t events = watch.Progress.size();
  EXPECT_TRUE(this->Environment->Update()); // and does not begin again
  EXPECT_EQ(watch.Progress.size(), events);
  this->ExpectCounts(1, 0, 0);

  watch = { {}, 2 };
  this->SetFile(second);
  EXPECT_NEAR(this->Environment->GetMeanLuminance(), MeanOf(2), 1e-3);
}

// The first file called off: there is the studio.
TEST_F(TestEnvironmentReading, CalledOffFirstLeavesTheStudio)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(
    [](vtkObject* who, unsigned long, void*, void*) { static_cast<vtkIBLEnvironment*>(who)->SetAbortExecute(true); });
  this->Environment->AddObserver(vtkCommand::ProgressEvent, command);
  this->SetFile(this->WriteLarge("large.exr", 100));
  EXPECT_EQ(this->Environment->GetWidth(), 512);
  EXPECT_LT(this->Environment->GetMeanLuminance(), 2);
}

// On a thread: no light at first; then the last one, while a file is read; then that of the file, with its harmonics
// made there. Mutants: Update() waits; the result taken before it is whole; harmonics left to the frame that shows it.
TEST_F(TestEnvironmentReading, FramesGoOnWhileAFileIsRead)
{
  this->Environment->AsynchronousOn();
  this->Environment->SetFileName(this->WriteLarge("first.exr", 1).c_str());
  EXPECT_FALSE(this->Environment->Update());
  EXPECT_TRUE(this->Environment->IsBusy());
  EXPECT_EQ(this->Environment->GetRadianceImage(), nullptr);
  this->ExpectCounts(0, 0, 0);
  this->WaitForThread();
  EXPECT_TRUE(this->Environment->Update());
  EXPECT_NEAR(this->Environment->GetMeanLuminance(), MeanOf(1), 1e-3);
  this->Environment->GetSpectrum(vtkIBLSpectrum::MaximumOrder);
  this->ExpectCounts(1, 0, 1);

  const vtkMTimeType first = this->Environment->GetRadianceTime();
  this->SetFile(this->WriteLarge("second.exr", 2));
  EXPECT_TRUE(this->Environment->IsBusy());
  EXPECT_EQ(this->Environment->GetRadianceTime(), first);
  EXPECT_NEAR(this->Environment->GetMeanLuminance(), MeanOf(1), 1e-3);
  EXPECT_TRUE(this->Environment->GetRadianceImage());
  this->WaitForThread();
  EXPECT_EQ(this->Environment->GetRadianceTime(), first); // until it is asked for
  EXPECT_TRUE(this->Environment->Update());
  EXPECT_NEAR(this->Environment->GetMeanLuminance(), MeanOf(2), 1e-3);
  this->ExpectCounts(2, 0, 2);
}

// A file that fails on the thread reports once, from Update(), never from the thread. Mutants: an error on the thread,
// one a frame, none.
TEST_F(TestEnvironmentReading, ThreadsErrorsAreUpdatesErrors)
{
  const fs::path good = this->Write("good.exr", 1);
  const fs::path cut = this->WriteLarge("cut.exr", 2);
  fs::resize_file(cut, fs::file_size(cut) / 2);
  this->SetFile(good);
  this->Environment->AsynchronousOn();
  for (const fs::path& bad : { cut, this->Cache.GetFolder() / "missing.exr" })
  {
    this->Environment->SetFileName(bad.c_str());
    this->Environment->Update(); // a missing one may have failed by now
    this->WaitForThread();
    std::string message = this->Messages.Take();
    EXPECT_TRUE(message.empty() || bad != cut) << message;
    EXPECT_TRUE(this->Environment->Update());
    message += this->Messages.Take();
    EXPECT_NE(message.find(bad.string()), std::string::npos) << message;
    EXPECT_EQ(message.find("ERROR"), message.rfind("ERROR")) << message;
    EXPECT_TRUE(this->Environment->Update());
    EXPECT_EQ(this->Messages.Take(), "");
    EXPECT_NEAR(this->Environment->GetMeanLuminance(), MeanOf(1), 1e-3);
  }
}

// Another source, while one is read: that one is called off, and never seen. Called off by hand: the last light stays
// until the source is set again. Gone while reading: nothing is left behind, and nothing said. Mutants: what comes last
// from a thread wins; AbortExecute without effect on a thread; a thread that outlives the environment.
TEST_F(TestEnvironmentReading, ThreadIsCalledOff)
{
  const fs::path small = this->Write("small.exr", 1);
  const fs::path large = this->WriteLarge("large.exr", 2);
  this->Environment->AsynchronousOn();
  this->Environment->SetFileName(large.c_str());
  this->Environment->Update();
  EXPECT_TRUE(this->Environment->IsBusy());
  this->Environment->SetFileName(small.c_str());
  this->Environment->Update();
  this->WaitForThread();
  EXPECT_TRUE(this->Environment->Update());
  EXPECT_NEAR(this->Environment->GetMeanLuminance(), MeanOf(1), 1e-3);
  this->ExpectCounts(1, 0, 1);

  this->SetFile(large);
  EXPECT_TRUE(this->Environment->IsBusy());
  this->Environment->SetAbortExecute(true);
  this->WaitForThread();
  EXPECT_TRUE(this->Environment->Update());
  EXPECT_FALSE(this->Environment->IsBusy());
  EXPECT_NEAR(this->Environment->GetMeanLuminance(), MeanOf(1), 1e-3);
  this->ExpectCounts(1, 0, 1);
  this->SetFile(large);
  EXPECT_FALSE(this->Environment->GetAbortExecute());
  this->Environment->SetInputData(MakePanorama(8, [](Vec3) { return RGB{ 3, 3, 3 }; })); // no thread's matter
  EXPECT_TRUE(this->Environment->Update());
  EXPECT_FALSE(this->Environment->IsBusy());
  EXPECT_NEAR(this->Environment->GetMeanLuminance(), 3, 1e-3);

  this->SetFile(large);
  EXPECT_TRUE(this->Environment->IsBusy());
  this->Environment = nullptr;
}

// Mutant: a thread that does not look into the cache.
TEST_F(TestEnvironmentReading, ThreadFindsKnownLight)
{
  const fs::path file = this->Write("sky.exr", 1);
  this->Keep(file);
  vtkIBLCache::ClearMemory();
  this->Environment->AsynchronousOn();
  this->Environment->SetFileName(file.c_str());
  this->Environment->Update();
  this->WaitForThread();
  EXPECT_TRUE(this->Environment->Update());
  this->ExpectCounts(0, 1, 0);
}
