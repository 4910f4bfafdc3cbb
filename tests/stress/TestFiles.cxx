// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Files that are cut, bent, named wrong, not there or not files: light or a word about it, never a crash, a wait or
// memory without bound. What the fuzzers found lies in corpus/ and is read here. (TestImageReader and TestCache have
// each error's words, full and unwritable disks, killed writers and processes that share a cache.)
#include "StressFiles.h"
#include "StressSupport.h"
#include "TestSupport.h"

#include "vtkIBLCache.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLImageReader.h"

#include <vtkDataArray.h>
#include <vtkLogger.h>
#include <vtkPointData.h>

#include <malloc.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <thread>

namespace
{
namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool MayLimitMemory = false; // it reserves terabytes
// OpenImageIO 2.4 loses a message when a PNG ends early. The stack ends at libstdc++, which has no frame pointers.
extern "C" const char* __lsan_default_suppressions()
{
  return "leak:basic_string*_M_assign";
}
#else
constexpr bool MayLimitMemory = true;
#endif

// While this lives, the process gets so many megabytes more than it has, touched or not.
class MemoryLimit
{
public:
  explicit MemoryLimit(rlim_t megabytes)
  {
    getrlimit(RLIMIT_AS, &this->Usual);
    if (MayLimitMemory)
    {
      mallopt(M_ARENA_MAX, 1); // each other thread's would reserve 64 MiB
      std::size_t pages = 0;
      std::ifstream("/proc/self/statm") >> pages;
      megabytes += 16 * std::thread::hardware_concurrency(); // stacks
      const rlimit tight = { pages * std::size_t(sysconf(_SC_PAGESIZE)) + (megabytes << 20), this->Usual.rlim_max };
      setrlimit(RLIMIT_AS, &tight);
    }
  }
  ~MemoryLimit() { setrlimit(RLIMIT_AS, &this->Usual); }

private:
  rlimit Usual{};
};

std::string Load(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

void Save(const fs::path& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}
}

class TestFiles : public ::testing::Test
{
protected:
  CaughtMessages Messages;
  OwnCache Cache;
  std::string Said; // by the last Read
  int Errors = 0, Lights = 0;

  TestFiles() { vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF); } // thousands of errors
  fs::path Path(const std::string& name) const { return this->Cache.GetFolder() / name; }

  // The light, or empty with a word that names the file; in two seconds.
  std::vector<float> Read(const fs::path& path, const std::string& what, vtkIdType maximum = 1 << 16)
  {
    vtkNew<vtkIBLImageReader> reader;
    reader->SetFileName(path.c_str());
    reader->SetMaximumNumberOfPixels(maximum > 0 ? maximum : reader->GetMaximumNumberOfPixels());
    const auto start = std::chrono::steady_clock::now();
    reader->Update();
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 2) << what;
    this->Said = this->Messages.Take();
    vtkImageData* output = reader->GetOutput();
    vtkDataArray* radiance = output->GetPointData()->GetScalars();
    const bool failed = reader->GetErrorCode() != 0;
    ++(failed ? this->Errors : this->Lights);
    if (failed)
    {
      EXPECT_EQ(output->GetNumberOfPoints(), 0) << what;
      EXPECT_NE(this->Said.find("Cannot read image '" + path.string() + "': "), std::string::npos)
        << what << this->Said;
      EXPECT_EQ(this->Said.find("alloc"), std::string::npos) << what << this->Said;
      return {};
    }
    EXPECT_EQ(this->Said, "") << what;
    EXPECT_TRUE(radiance && radiance->GetNumberOfTuples() == output->GetNumberOfPoints()) << what;
    const auto* values = static_cast<const float*>(output->GetScalarPointer());
    return { values, values + 3 * output->GetNumberOfPoints() };
  }
};

// A file cut at 64 points gives the whole light, when nothing of it was lost, or an error. 256 MiB are enough for all
// of it: the limit of 65536 pixels holds before any decoder is asked. Mutants: a cut file taken as it is; the size
// looked at after OpenImageIO has opened the file.
TEST_F(TestFiles, CutAnywhere)
{
  const std::vector<fs::path> paths = WriteStressFiles(this->Cache.GetFolder());
  std::map<std::string, std::vector<float>> lights;
  for (const fs::path& path : paths)
  {
    lights[path.string()] = this->Read(path, path.string());
    EXPECT_FALSE(lights[path.string()].empty()) << path << this->Said;
  }
  this->Errors = this->Lights = 0;
  const MemoryLimit limit(256);
  for (const fs::path& path : paths)
  {
    const std::string whole = Load(path);
    for (int i = 0; i < 64; ++i)
    {
      Save(path, whole.substr(0, whole.size() * i / 64));
      const std::string what = path.filename().string() + " cut at " + std::to_string(i) + "/64";
      const std::vector<float> light = this->Read(path, what);
      EXPECT_TRUE(light.empty() || light == lights[path.string()]) << what;
    }
  }
  std::printf("  %d cut files: %d errors, %d whole\n", this->Errors + this->Lights, this->Errors, this->Lights);
}

// One to eight wrong bits, in the first kilobyte half of the time, where headers are. What the bits mean may change:
// only a cache's files have checksums. Mutants: attributes believed (memory); channels that are not there read.
TEST_F(TestFiles, WrongBits)
{
  std::mt19937 random(7);
  const auto below = [&random](std::size_t end) { return std::size_t(random()) % end; };
  const MemoryLimit limit(256);
  for (const fs::path& path : WriteStressFiles(this->Cache.GetFolder()))
  {
    const std::string whole = Load(path);
    for (int i = 0, count = StressCount(64); i < count; ++i)
    {
      std::string bent = whole;
      for (std::size_t k = below(8) + 1; k > 0; --k)
      {
        const std::size_t reach = i % 2 ? whole.size() : std::min<std::size_t>(whole.size(), 1024);
        bent[below(reach)] ^= char(1u << below(8));
      }
      Save(path, bent);
      this->Read(path, path.filename().string() + ", attempt " + std::to_string(i));
    }
  }
  std::printf("  %d bent files: %d errors, %d read\n", this->Errors + this->Lights, this->Errors, this->Lights);
}

// A few hundred bytes that declare a panorama of 65,500 to 1,000,000 columns, of each format: refused by their number
// of pixels, as it is allowed by default, in 256 MiB. Mutant: the size not looked at (memory).
TEST_F(TestFiles, DeclaredSizes)
{
  std::map<std::string, fs::path> seeds;
  for (const fs::path& path : WriteStressFiles(this->Cache.GetFolder()))
  {
    seeds[path.filename().string()] = path;
  }
  const auto with = [&seeds](const std::string& name, std::size_t at, const std::string& bytes)
  {
    std::string file = Load(seeds.at(name));
    Save(seeds.at(name), file.replace(at, bytes.size(), bytes));
  };
  Save(seeds.at("radiance.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 500000 +X 1000000\n\x02\x02\x02\x02");
  // IHDR's width and height, bytes of 8 and RGB, none of the rest, and its CRC.
  with("uint8.png", 16, { "\x00\x0f\x42\x40\x00\x07\xa1\x20\x08\x02\x00\x00\x00\x3a\x56\x07\x4f", 17 });
  const std::string jpeg = Load(seeds.at("uint8.jpg"));
  with("uint8.jpg", jpeg.find("\xff\xc0") + 5, "\x7f\xee\xff\xdc"); // 32750 rows of 65500
  // The tags of width (0x100) and length (0x101): one number of 16 bits each, written as one of 32.
  for (const char* name : { "float.tif", "tiled.tif" })
  {
    for (const std::string& tag : { std::string("\x00\x01", 2), std::string("\x01\x01", 2) })
    {
      const std::size_t at = Load(seeds.at(name)).find(tag + std::string("\x03\x00\x01\x00\x00\x00", 6));
      ASSERT_NE(at, std::string::npos) << name;
      const std::string size(tag[0] ? "\x20\xa1\x07\x00" : "\x40\x42\x0f\x00", 4);
      with(name, at, tag + std::string("\x04\x00\x01\x00\x00\x00", 6) + size);
    }
  }
  const MemoryLimit limit(256);
  for (const char* name : { "radiance.hdr", "uint8.png", "uint8.jpg", "float.tif", "tiled.tif" })
  {
    EXPECT_TRUE(this->Read(seeds.at(name), name, 0).empty()) << name;
  }
}

// Under another format's name a file is what it is, or an error. Mutant: a decoder chosen by the extension alone, which
// finds other numbers.
TEST_F(TestFiles, WrongExtensions)
{
  std::set<fs::path> extensions = { ".txt", "" };
  const std::vector<fs::path> paths = WriteStressFiles(this->Cache.GetFolder());
  for (const fs::path& path : paths)
  {
    extensions.insert(path.extension());
  }
  for (const fs::path& path : paths)
  {
    const std::vector<float> light = this->Read(path, path.string());
    for (const fs::path& extension : extensions)
    {
      const fs::path other = this->Path("other").replace_extension(extension);
      fs::copy_file(path, other, fs::copy_options::overwrite_existing);
      EXPECT_EQ(this->Read(other, path.string()), light) << path << " as " << other << this->Said;
    }
  }
}

// Whatever a name leads to, an environment says so once, and keeps the light that it had. Mutants: a link to a pipe
// opened (hangs); a link's own kind looked at.
TEST_F(TestFiles, NamesThatLeadNowhere)
{
  const std::vector<fs::path> paths = WriteStressFiles(this->Cache.GetFolder());
  const fs::path& good = paths.front();
  vtkNew<vtkIBLEnvironment> environment;
  environment->SetFileName(good.c_str());
  ASSERT_TRUE(environment->Update());
  const double mean = environment->GetMeanLuminance();
  EXPECT_NE(mean, 0.0);

  fs::create_symlink(this->Path("loop2.exr"), this->Path("loop1.exr"));
  fs::create_symlink(this->Path("loop1.exr"), this->Path("loop2.exr"));
  fs::create_symlink(this->Path("nothing.exr"), this->Path("dangling.exr"));
  ASSERT_EQ(mkfifo(this->Path("pipe.exr").c_str(), 0600), 0);
  fs::create_symlink(this->Path("pipe.exr"), this->Path("link.exr"));
  fs::create_symlink("/dev/zero", this->Path("zero.exr"));
  std::vector<std::string> names = { this->Path("loop1.exr"), this->Path("dangling.exr"), this->Path("link.exr"),
    this->Path("zero.exr"), this->Path(""), good / "below.exr", this->Path(std::string(300, 'x')), "\xff\xfe.exr",
    std::string(5000, '/') + "x.exr" };
  if (geteuid() != 0) // root reads all
  {
    names.push_back(this->Path("secret.exr"));
    fs::copy_file(good, names.back());
    fs::permissions(names.back(), fs::perms::none);
  }
  for (const std::string& name : names)
  {
    environment->SetFileName(name.c_str());
    EXPECT_TRUE(environment->Update()) << name;
    const std::string said = this->Messages.Take();
    EXPECT_NE(said.find("The last good light stays."), std::string::npos) << name << said;
    EXPECT_TRUE(environment->Update());
    EXPECT_EQ(this->Messages.Take(), "") << name;
    EXPECT_EQ(environment->GetMeanLuminance(), mean) << name;
  }
  // A link to a file is that file.
  fs::create_symlink(paths.back(), this->Path("good.exr"));
  environment->SetFileName(this->Path("good.exr").c_str());
  EXPECT_TRUE(environment->Update());
  EXPECT_EQ(this->Messages.Take(), "");
}

// What fuzzing found: an attribute of two gibibytes, or a row of 67 million pixels, in a file of a kilobyte. As the
// memory is asked for and not touched, only a limit on it shows that. Mutants, each seen to fail: no check; a list of
// channels, or of strings, believed to have its size; windows looked at after OpenImageIO.
TEST_F(TestFiles, WhatTheFuzzersFound)
{
  const fs::path corpus = fs::path(VTKIBL_CORPUS);
  int count = 0;
  const MemoryLimit limit(256);
  for (const auto& entry : fs::directory_iterator(corpus / "pictures"))
  {
    ++count;
    EXPECT_TRUE(this->Read(entry.path(), entry.path().string()).empty()) << entry.path();
  }
  EXPECT_GE(count, 4);
  const std::string key = vtkIBLCache::MakePixelKey("", 0, "");
  const fs::path file = this->Path("cache") / ("vtkIBL-" + key + ".exr");
  fs::create_directories(file.parent_path());
  for (const auto& entry : fs::directory_iterator(corpus / "lights"))
  {
    ++count;
    fs::copy_file(entry.path(), file, fs::copy_options::overwrite_existing);
    vtkIBLCache::SetDirectory(file.parent_path().c_str()); // so that it is said again
    EXPECT_FALSE(vtkIBLCache::Find(key)) << entry.path();
    const std::string said = this->Messages.Take();
    EXPECT_NE(said.find("cannot be used (its "), std::string::npos) << entry.path() << said;
  }
  EXPECT_GE(count, 9);
}
