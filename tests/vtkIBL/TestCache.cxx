// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TestSupport.h"

#include "vtkIBLCache.h"
#include "vtkIBLStoredLight.h"

#include <OpenImageIO/imageio.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using Light = std::shared_ptr<const vtkIBLStoredLight>;
using Cache = vtkIBLCache;

// A light with all bit patterns that floats and doubles can have; face size 0, order -1: that part is missing.
Light MakeLight(int faceSize, int order, int brightTexels, unsigned seed = 1)
{
  std::mt19937_64 random(seed);
  auto light = std::make_shared<vtkIBLStoredLight>();
  light->SourceWidth = 4096;
  light->SourceHeight = 2048;
  light->SourceFaces = 1;
  light->MeanLuminance = 0.1 + seed;
  light->Faults = { 7, 0, std::size_t(5000000000), -0.25f };
  light->CubeFaceSize = faceSize;
  light->SpectrumOrder = order;
  light->Cube.resize(vtkIBLStoredLight::GetCubeLength(faceSize));
  light->Coefficients.resize(vtkIBLStoredLight::GetCoefficientsLength(order));
  light->BrightTexels.resize(brightTexels);
  const auto fill = [&random](void* to, std::size_t bytes)
  {
    for (std::size_t i = 0; i < bytes; i += 4)
    {
      const auto word = static_cast<std::uint32_t>(random());
      std::memcpy(static_cast<char*>(to) + i, &word, 4);
    }
  };
  fill(light->Cube.data(), light->Cube.size() * sizeof(float));
  fill(light->Coefficients.data(), light->Coefficients.size() * sizeof(float));
  fill(light->BrightTexels.data(), light->BrightTexels.size() * sizeof(vtkIBLBrightTexel));
  return light;
}

template <typename T>
bool SameBits(const std::vector<T>& a, const std::vector<T>& b)
{
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool SameBits(const vtkIBLStoredLight& a, const vtkIBLStoredLight& b)
{
  return a.SourceWidth == b.SourceWidth && a.SourceHeight == b.SourceHeight && a.SourceFaces == b.SourceFaces &&
    a.MeanLuminance == b.MeanLuminance && a.Faults.NotFinite == b.Faults.NotFinite &&
    a.Faults.TooLarge == b.Faults.TooLarge && a.Faults.Negative == b.Faults.Negative &&
    a.Faults.MostNegative == b.Faults.MostNegative && a.CubeFaceSize == b.CubeFaceSize &&
    a.SpectrumOrder == b.SpectrumOrder && SameBits(a.Cube, b.Cube) && SameBits(a.Coefficients, b.Coefficients) &&
    SameBits(a.BrightTexels, b.BrightTexels);
}

std::string Read(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

void Write(const fs::path& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

// Runs in a process of its own; its id.
template <typename Body>
pid_t Fork(const Body& body)
{
  const pid_t child = fork();
  if (child == 0)
  {
    _exit(body() ? 0 : 1);
  }
  EXPECT_GT(child, 0);
  return child;
}

bool Succeeds(pid_t child)
{
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}
}

// In a directory of its own, and never in the user's.
class TestCache : public ::testing::Test
{
protected:
  CaughtMessages Messages;
  fs::path Directory;

  void SetUp() override
  {
    std::string pattern = (fs::temp_directory_path() / "TestCache-XXXXXX").string();
    ASSERT_TRUE(mkdtemp(pattern.data()));
    this->Directory = pattern;
    unsetenv("VTKIBL_CACHE");
    Cache::SetDirectory((this->Directory / "cache").c_str());
    Cache::SetMaximumDiskBytes(1 << 30);
    Cache::SetMaximumMemoryBytes(1 << 28);
    Cache::ClearMemory();
  }
  void TearDown() override
  {
    EXPECT_EQ(this->Messages.Take(), "");
    Cache::SetEnabled(true);
    Cache::SetDirectory("");
    fs::remove_all(this->Directory);
  }

  static std::string Key(int i) { return Cache::MakePixelKey(&i, sizeof i, ""); }
  fs::path Path(const std::string& key) const { return this->Directory / "cache" / ("vtkIBL-" + key + ".exr"); }

  // As the next process would.
  static Light FindOnDisk(const std::string& key)
  {
    Cache::ClearMemory();
    return Cache::Find(key);
  }

  // The file of this key is of no use: that is said once and counted, and the file is replaced.
  void ExpectRebuilt(const std::string& key, const std::string& words)
  {
    Cache::SetDirectory((this->Directory / "cache").c_str()); // so that it is said again
    const vtkTypeInt64 broken = Cache::GetNumberOfBrokenFiles();
    const vtkTypeInt64 misses = Cache::GetNumberOfMisses();
    EXPECT_FALSE(FindOnDisk(key)) << words;
    EXPECT_EQ(Cache::GetNumberOfBrokenFiles(), broken + 1) << words;
    EXPECT_EQ(Cache::GetNumberOfMisses(), misses + 1) << words;
    const std::string message = this->Messages.Take();
    EXPECT_NE(message.find(this->Path(key).string()), std::string::npos) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_FALSE(FindOnDisk(key));
    EXPECT_EQ(this->Messages.Take(), "");
    const Light light = MakeLight(3, 2, 1);
    Cache::Store(key, light);
    const Light found = FindOnDisk(key);
    EXPECT_TRUE(found && SameBits(*found, *light)) << words;
  }

  int CountFiles() const
  {
    return int(std::distance(fs::directory_iterator(this->Directory / "cache"), fs::directory_iterator()));
  }
};

// What comes out of a file is what went in, bit by bit: NaN, -0, denormals; parts that are missing; one tile and more.
// A light that gets another part replaces the one without. Mutants: red and blue exchanged on reading; the last tile as
// tall as the others; half of a double dropped; a count as int.
TEST_F(TestCache, BringsBackTheSameBits)
{
  int i = 0;
  for (int faceSize : { 0, 1, 3, 16 })
  {
    for (int order : { -1, 0, 1, 12 })
    {
      for (int brightTexels : { 0, 1, 14, 15, 256 })
      {
        const Light light = MakeLight(faceSize, order, brightTexels, ++i);
        Cache::Store(Key(0), light);
        EXPECT_EQ(Cache::Find(Key(0)), light);
        const vtkTypeInt64 hits = Cache::GetNumberOfDiskHits();
        const Light found = FindOnDisk(Key(0));
        if (faceSize || order >= 0 || brightTexels)
        {
          ASSERT_TRUE(found && SameBits(*found, *light)) << faceSize << " " << order << " " << brightTexels;
          EXPECT_EQ(Cache::GetNumberOfDiskHits(), hits + 1);
          EXPECT_EQ(Cache::Find(Key(0)), found); // and from now on out of memory
          EXPECT_EQ(Cache::GetNumberOfDiskHits(), hits + 1);
        }
      }
    }
  }
  EXPECT_EQ(this->CountFiles(), 1);
}

// OpenImageIO, which knows nothing of us, sees the same cube, spectrum and facts. Mutants: parts without names; faces
// side by side.
TEST_F(TestCache, FilesAreOrdinaryOpenEXR)
{
  auto light = std::make_shared<vtkIBLStoredLight>(*MakeLight(5, 3, 2));
  for (std::size_t i = 0; i < light->Cube.size(); ++i)
  {
    light->Cube[i] = float(i);
  }
  Cache::Store(Key(0), light);
  OIIO::attribute("exr_threads", -1); // processes with threads do not fork well
  const auto file = OIIO::ImageInput::open(this->Path(Key(0)).string());
  ASSERT_TRUE(file) << OIIO::geterror();
  const OIIO::ImageSpec cube = file->spec_dimensions(0);
  EXPECT_EQ(cube.width, 5);
  EXPECT_EQ(cube.height, 30);
  std::vector<float> pixels(light->Cube.size());
  ASSERT_TRUE(file->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels.data()));
  EXPECT_EQ(pixels, light->Cube);
  EXPECT_EQ(file->spec(0)["vtkIBL.meanLuminance"].as_string(), "1.1");
  EXPECT_EQ(file->spec(0)["vtkIBL.negative"].as_string(), "5000000000");
  EXPECT_EQ(file->spec(0)["vtkIBL.key"].as_string(), Key(0));
  int part = 0;
  for (const char* name : { "cube", "spectrum", "brightTexels" })
  {
    EXPECT_EQ(file->spec(part++)["oiio:subimagename"].as_string(), name);
  }
  EXPECT_EQ(file->spec(1).nchannels, 6);
  EXPECT_EQ(file->spec(1).width, 10);
}

// A key is of every byte, of the settings and of the version, and of nothing else. Witness: XXH3 in one go over what
// the key is said to be of. Mutants: the last block of a file left out; settings and bytes run together; no version.
TEST_F(TestCache, KeysAreOfEverything)
{
  const fs::path path = this->Directory / "sky.exr";
  std::string bytes(300, 'x');
  std::set<std::string> keys;
  const auto add = [&](const std::string& settings)
  {
    Write(path, bytes);
    keys.insert(Cache::MakeFileKey(path.string(), settings));
    keys.insert(Cache::MakePixelKey(bytes.data(), bytes.size(), settings));
  };
  add("");
  add("x");
  add("width=1");
  add("width=2");
  for (char& byte : bytes)
  {
    byte ^= 1;
    add("");
    byte ^= 1;
  }
  bytes.pop_back();
  add("");
  add("x");
  bytes.assign(300, '\0');
  add("");
  EXPECT_EQ(keys.size(), 2u * 307);

  // A file is hashed in blocks of 2^18.
  for (std::size_t size : { 0, 1, (1 << 18) - 1, 1 << 18, (1 << 18) + 1, 1 << 20 })
  {
    bytes.assign(size, 'y');
    Write(path, bytes);
    for (int version : { 1, 2 })
    {
      std::string all(reinterpret_cast<const char*>(&version), sizeof version);
      const std::string settings = "file width=1";
      const std::size_t length = settings.size();
      all.append(reinterpret_cast<const char*>(&length), sizeof length);
      all += settings + bytes;
      const XXH128_hash_t hash = XXH3_128bits(all.data(), all.size());
      char text[33];
      std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
        static_cast<unsigned long long>(hash.low64));
      EXPECT_EQ(Cache::MakeFileKey(path.string(), "width=1") == text, version == 1) << size;
    }
  }
  fs::copy(path, this->Directory / "copy.exr");
  EXPECT_EQ(Cache::MakeFileKey((this->Directory / "copy.exr").string(), ""), Cache::MakeFileKey(path.string(), ""));

  // What is no file has no key, and nothing is kept under that.
  const fs::path pipe = this->Directory / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const fs::path& none : { pipe, this->Directory, this->Directory / "missing" })
  {
    EXPECT_EQ(Cache::MakeFileKey(none.string(), ""), "");
  }
  Cache::Store("", MakeLight(1, 0, 0));
  EXPECT_FALSE(Cache::Find(""));
}

// Memory holds what was used last, and no more than it may; and a light too large drives out nothing. Mutants: first
// in, first out; bytes of a light that was replaced still counted; held whatever its size.
TEST_F(TestCache, MemoryKeepsWhatWasUsedLast)
{
  const auto size = [](const Light& light) { return vtkTypeInt64(light->GetNumberOfBytes() + sizeof *light); };
  const Light lights[] = { MakeLight(8, 3, 0), MakeLight(8, 3, 0), MakeLight(8, 3, 0) };
  Cache::SetDirectory("");
  Cache::SetMaximumMemoryBytes(2 * size(lights[0]));
  Cache::Store(Key(0), lights[0]);
  Cache::Store(Key(1), MakeLight(1, 0, 0));
  Cache::Store(Key(1), lights[1]);
  EXPECT_EQ(Cache::GetMemoryBytes(), 2 * size(lights[0]));
  EXPECT_EQ(Cache::Find(Key(0)), lights[0]);
  Cache::Store(Key(2), lights[2]);
  EXPECT_EQ(Cache::Find(Key(0)), lights[0]);
  EXPECT_FALSE(Cache::Find(Key(1)));
  EXPECT_EQ(Cache::Find(Key(2)), lights[2]);
  Cache::SetMaximumMemoryBytes(size(lights[0]));
  EXPECT_FALSE(Cache::Find(Key(0)));
  EXPECT_EQ(Cache::Find(Key(2)), lights[2]);
  Cache::Store(Key(3), MakeLight(16, 3, 0)); // does not fit at all, and drives out nothing
  EXPECT_FALSE(Cache::Find(Key(3)));
  EXPECT_EQ(Cache::Find(Key(2)), lights[2]);
  Cache::SetMaximumMemoryBytes(-1);
  EXPECT_NE(this->Messages.Take().find("MaximumMemoryBytes is -1"), std::string::npos);
  EXPECT_EQ(Cache::GetMaximumMemoryBytes(), size(lights[0]));
}

// So does the disk, and a directory that is somebody's own loses nothing else. Use in memory counts. Mutants: order by
// name; hits do not count; any .exr counts.
TEST_F(TestCache, DiskKeepsWhatWasUsedLast)
{
  const Light light = MakeLight(8, 3, 0);
  for (int i : { 0, 1, 2 })
  {
    Cache::Store(Key(i), light);
  }
  const vtkTypeInt64 bytes = Cache::GetDiskBytes();
  EXPECT_GT(bytes, 3 * vtkTypeInt64(light->GetNumberOfBytes()));
  const fs::path own[] = { this->Path(Key(0)).parent_path() / "sky.exr",
    this->Path(Key(0)).parent_path() / ("my-" + this->Path(Key(0)).filename().string()) };
  for (const fs::path& path : own)
  {
    Write(path, std::string(10000, 'x'));
    fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(100));
  }
  EXPECT_EQ(Cache::GetDiskBytes(), bytes);
  EXPECT_TRUE(Cache::Find(Key(0))); // in memory
  Cache::SetMaximumDiskBytes(bytes);
  Cache::Store(Key(3), light);
  EXPECT_TRUE(FindOnDisk(Key(0)));
  EXPECT_FALSE(FindOnDisk(Key(1)));
  EXPECT_TRUE(FindOnDisk(Key(2)));
  EXPECT_TRUE(FindOnDisk(Key(0)));
  Cache::Store(Key(4), light);
  EXPECT_FALSE(FindOnDisk(Key(3)));
  EXPECT_TRUE(FindOnDisk(Key(2)));
  EXPECT_EQ(Cache::GetDiskBytes(), bytes);
  Cache::Store(Key(5), MakeLight(32, 3, 0)); // does not fit at all, and drives out nothing
  EXPECT_FALSE(FindOnDisk(Key(5)));
  EXPECT_EQ(Cache::GetDiskBytes(), bytes);
  Cache::SetMaximumDiskBytes(-1);
  EXPECT_NE(this->Messages.Take().find("MaximumDiskBytes is -1"), std::string::npos);
  for (const fs::path& path : own)
  {
    EXPECT_TRUE(fs::exists(path));
  }
}

// A file that is cut anywhere, or has any bit wrong, gives the true light or none. Mutants: no checksum (some pixel
// then differs); facts not in the checksum.
TEST_F(TestCache, DamageIsAMiss)
{
  const Light light = MakeLight(6, 9, 3);
  Cache::Store(Key(0), light);
  const std::string whole = Read(this->Path(Key(0)));
  const auto check = [&](const std::string& bytes)
  {
    Write(this->Path(Key(0)), bytes);
    Cache::SetDirectory((this->Directory / "cache").c_str()); // so that it is said again
    const Light found = FindOnDisk(Key(0));
    EXPECT_TRUE(!found || SameBits(*found, *light));
    EXPECT_EQ(!found, this->Messages.Take().find(this->Path(Key(0)).string()) != std::string::npos);
    return found != nullptr;
  };
  EXPECT_TRUE(check(whole));
  for (int i = 0; i < 64; ++i)
  {
    EXPECT_FALSE(check(whole.substr(0, whole.size() * i / 64))) << i;
  }
  EXPECT_FALSE(check(whole.substr(0, whole.size() - 1)));
  std::mt19937 random(3);
  int harmless = 0;
  for (int i = 0; i < 200; ++i)
  {
    std::string bytes = whole;
    bytes[i % 2 ? random() % bytes.size() : random() % 2000] ^= char(1 << random() % 8); // half of them in the headers
    harmless += check(bytes);
  }
  EXPECT_LT(harmless, 100); // screen windows, offsets of tiles and the like
  Write(this->Path(Key(0)), whole.substr(0, 1000));
  this->ExpectRebuilt(Key(0), "cannot be used");
}

// What is not the file that its name says is not used, and replaced. Mutants: key or version not compared; sizes
// believed (the test then runs out of memory).
TEST_F(TestCache, ForeignFilesAreReplaced)
{
  const Light light = MakeLight(2, 1, 1);
  Cache::Store(Key(0), light);
  const std::string good = Read(this->Path(Key(0)));
  // The integer attribute `name` of the file.
  const auto with = [&good](const std::string& name, int value)
  {
    std::string bytes = good;
    const std::size_t at = bytes.find(name) + name.size() + 1 + sizeof "int" + sizeof(int);
    bytes.replace(at, sizeof value, reinterpret_cast<const char*>(&value), sizeof value);
    return bytes;
  };
  Write(this->Path(Key(1)), good);
  this->ExpectRebuilt(Key(1), "version 1 of " + Key(0));
  Write(this->Path(Key(0)), with("vtkIBL.version", 2));
  this->ExpectRebuilt(Key(0), "version 2");
  for (const auto& [face, words] : { std::pair{ 1 << 30, "cannot hold a cube of 1073741824" }, { 16384, "cannot hold" },
         { -1, "cannot hold" }, { 0, "has 3 parts" }, { 1, "not its cube" } })
  {
    Write(this->Path(Key(0)), with("vtkIBL.cubeFaceSize", face));
    this->ExpectRebuilt(Key(0), words);
  }
  for (int order : { 20000, std::numeric_limits<int>::max() })
  {
    Write(this->Path(Key(0)), with("vtkIBL.spectrumOrder", order));
    this->ExpectRebuilt(Key(0), "order " + std::to_string(order));
  }
  Write(this->Path(Key(0)), with("vtkIBL.sourceWidth", 20000));
  this->ExpectRebuilt(Key(0), "checksum");

  // The chunk of the bright texel: part 2, tile 0 0, level 0 0, 56 bytes.
  const int chunk[] = { 2, 0, 0, 0, 0, 56 };
  std::string bytes = good;
  const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(chunk), sizeof chunk));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 20] = 52;
  Write(this->Path(Key(0)), bytes);
  this->ExpectRebuilt(Key(0), "a tile has another size");

  const auto output = OIIO::ImageOutput::create("x.png");
  const std::string png = (this->Directory / "x.png").string();
  const std::vector<unsigned char> grey(64 * 64, 100);
  ASSERT_TRUE(output && output->open(png, OIIO::ImageSpec(64, 64, 1, OIIO::TypeDesc::UINT8)) &&
    output->write_image(OIIO::TypeDesc::UINT8, grey.data()) && output->close());
  fs::copy(png, this->Path(Key(2)));
  this->ExpectRebuilt(Key(2), "not an image file");
  ASSERT_EQ(mkfifo(this->Path(Key(3)).c_str(), 0600), 0);
  this->ExpectRebuilt(Key(3), "no regular file");

  // A directory cannot be replaced; memory will do.
  fs::create_directories(this->Path(Key(4)) / "full");
  EXPECT_FALSE(Cache::Find(Key(4)));
  EXPECT_NE(this->Messages.Take().find("no regular file"), std::string::npos);
  Cache::Store(Key(4), light);
  EXPECT_NE(this->Messages.Take().find("memory only"), std::string::npos);
  EXPECT_EQ(Cache::Find(Key(4)), light);
  EXPECT_EQ(this->CountFiles(), 5); // nothing half done
}

// Where nothing can be written, memory does it, and that is said once. A full disk is played by a limit on the size of
// files. Mutants: the stream's state not looked at after closing; the temporary file left.
TEST_F(TestCache, UnwritableDirectoriesCostAWord)
{
  const Light light = MakeLight(16, 3, 1);
  const fs::path file = this->Directory / "file";
  Write(file, "x");
  for (const std::string& bad : { std::string("/proc/vtkIBL"), file.string(), (file / "below").string() })
  {
    Cache::SetDirectory(bad.c_str());
    EXPECT_FALSE(FindOnDisk(Key(0)));
    Cache::Store(Key(0), light);
    const std::string message = this->Messages.Take();
    EXPECT_NE(message.find("'" + bad + "'"), std::string::npos) << message;
    EXPECT_NE(message.find("memory only"), std::string::npos) << message;
    EXPECT_EQ(Cache::Find(Key(0)), light);
    Cache::Store(Key(1), light);
    EXPECT_EQ(this->Messages.Take(), "") << "said twice";
    EXPECT_EQ(Cache::GetDiskBytes(), 0);
  }

  const std::string cache = (this->Directory / "cache").string();
  Cache::SetDirectory(cache.c_str());
  Cache::Store(Key(0), light);
  const auto size = static_cast<rlim_t>(Cache::GetDiskBytes());
  fs::remove(this->Path(Key(0)));
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual{};
  getrlimit(RLIMIT_FSIZE, &usual);
  for (rlim_t limit : { rlim_t(100), size / 2, size - 1 }) // the last fails when the stream is closed
  {
    Cache::SetDirectory(cache.c_str());
    const rlimit small{ limit, usual.rlim_max };
    setrlimit(RLIMIT_FSIZE, &small);
    Cache::Store(Key(0), light);
    setrlimit(RLIMIT_FSIZE, &usual);
    EXPECT_NE(this->Messages.Take().find("memory only"), std::string::npos) << limit;
    EXPECT_EQ(this->CountFiles(), 0) << limit;
  }
  std::signal(SIGXFSZ, SIG_DFL);
}

// Two processes write one light again and again while a third reads: it finds a whole light of one of them each time,
// and nobody says a word. Mutant: written under the final name.
TEST_F(TestCache, ProcessesShareADirectory)
{
  const Light lights[] = { MakeLight(64, 20, 2, 1), MakeLight(32, 30, 9, 2) };
  Cache::Store(Key(0), lights[0]);
  pid_t children[3];
  for (int i : { 0, 1 })
  {
    children[i] = Fork(
      [&]
      {
        for (int k = 0; k < 50; ++k)
        {
          Cache::Store(Key(0), lights[i]);
        }
        return this->Messages.Take().empty();
      });
  }
  children[2] = Fork(
    [&]
    {
      int seen[2] = { 0, 0 };
      for (int k = 0; k < 100; ++k)
      {
        const Light found = FindOnDisk(Key(0));
        const int i = found && SameBits(*found, *lights[1]) ? 1 : 0;
        if (!found || !SameBits(*found, *lights[i]))
        {
          return false;
        }
        ++seen[i];
      }
      return this->Messages.Take().empty();
    });
  for (pid_t child : children)
  {
    EXPECT_TRUE(Succeeds(child));
  }
  EXPECT_EQ(this->CountFiles(), 1);
}

// A writer that is killed leaves the light that was there, and a temporary file that goes when it is an hour old.
// Mutants: temporary files of writers at work removed; never removed.
TEST_F(TestCache, AKilledWriterDoesNoHarm)
{
  const Light light = MakeLight(128, 20, 2);
  Cache::Store(Key(0), light);
  const pid_t child = Fork(
    [&]
    {
      for (;;)
      {
        Cache::Store(Key(0), light);
      }
      return true;
    });
  const auto late = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (this->CountFiles() == 1 && std::chrono::steady_clock::now() < late)
  {
  }
  kill(child, SIGKILL);
  EXPECT_FALSE(Succeeds(child));
  const Light found = FindOnDisk(Key(0));
  EXPECT_TRUE(found && SameBits(*found, *light));

  const fs::path temporary = this->Path(Key(0)).replace_filename("vtkIBL-" + Key(1) + "-0123456789abcdef.tmp");
  Write(temporary, "half a file");
  Cache::Store(Key(0), light);
  EXPECT_TRUE(fs::exists(temporary));
  for (const auto& entry : fs::directory_iterator(this->Directory / "cache"))
  {
    fs::last_write_time(entry, fs::file_time_type::clock::now() - std::chrono::minutes(61));
  }
  Cache::Store(Key(0), light);
  EXPECT_EQ(this->CountFiles(), 1);
}

// Off means off: nothing is read, written, held or counted. The environment variable is for the disk alone.
TEST_F(TestCache, CanBeTurnedOff)
{
  const Light light = MakeLight(2, 1, 0);
  Cache::Store(Key(0), light);
  const vtkTypeInt64 misses = Cache::GetNumberOfMisses();
  Cache::SetEnabled(false);
  EXPECT_FALSE(Cache::Find(Key(0)));
  Cache::Store(Key(1), light);
  Cache::SetEnabled(true);
  EXPECT_EQ(Cache::GetNumberOfMisses(), misses);
  EXPECT_FALSE(Cache::Find(Key(1)));

  setenv("VTKIBL_CACHE", "off", 1);
  Cache::Store(Key(2), light);
  EXPECT_EQ(Cache::Find(Key(2)), light);
  EXPECT_FALSE(FindOnDisk(Key(2)));
  EXPECT_FALSE(FindOnDisk(Key(0)));
  EXPECT_EQ(Cache::GetDiskBytes(), 0);
  unsetenv("VTKIBL_CACHE");
  EXPECT_TRUE(FindOnDisk(Key(0)));
  EXPECT_EQ(this->CountFiles(), 1);
}

// The directory is where the XDG Base Directory Specification has it. Where nothing names one, that is said once.
TEST_F(TestCache, DefaultDirectoryFollowsXDG)
{
  const Light light = MakeLight(2, 1, 0);
  const std::string home = std::getenv("HOME") ? std::getenv("HOME") : "";
  const char* old = std::getenv("XDG_CACHE_HOME");
  const std::string xdg = old ? old : "";
  Cache::SetDirectory(nullptr);
  setenv("HOME", this->Directory.c_str(), 1);
  setenv("XDG_CACHE_HOME", (this->Directory / "xdg").c_str(), 1);
  EXPECT_EQ(Cache::GetDirectory(), (this->Directory / "xdg/vtkIBL").string());
  Cache::Store(Key(0), light);
  EXPECT_TRUE(fs::exists(this->Directory / "xdg/vtkIBL" / this->Path(Key(0)).filename()));
  setenv("XDG_CACHE_HOME", "relative", 1);
  EXPECT_EQ(Cache::GetDirectory(), (this->Directory / ".cache/vtkIBL").string());
  unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(Cache::GetDirectory(), (this->Directory / ".cache/vtkIBL").string());
  unsetenv("HOME");
  EXPECT_EQ(Cache::GetDirectory(), "");
  Cache::Store(Key(1), light);
  EXPECT_NE(this->Messages.Take().find("neither XDG_CACHE_HOME nor HOME is set"), std::string::npos);
  EXPECT_EQ(Cache::Find(Key(1)), light);
  EXPECT_EQ(this->Messages.Take(), "");
  setenv("HOME", home.c_str(), 1);
  if (old)
  {
    setenv("XDG_CACHE_HOME", xdg.c_str(), 1);
  }
}
