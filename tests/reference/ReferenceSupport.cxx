// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause

#include "Reference.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

#ifndef VTKIBL_REFERENCE_SOURCES
#error "Define VTKIBL_REFERENCE_SOURCES: a hash of these sources (see CMakeLists.txt)."
#endif

namespace vtkIBLReference
{
namespace
{
std::atomic<int> ThreadCount{ 0 };

std::string Hex(std::uint64_t value)
{
  std::string text(16, '0');
  for (int i = 15; i >= 0; --i, value >>= 4)
  {
    text[i] = "0123456789abcdef"[value & 15];
  }
  return text;
}

std::filesystem::path CacheDirectory()
{
  const char* directory = std::getenv("VTKIBL_REFERENCE_CACHE");
  return directory && *directory ? std::filesystem::path(directory)
                                 : std::filesystem::temp_directory_path() / "vtkibl-reference";
}

// A file is the key, a line end, the doubles, and the hash of all that in hexadecimal.
bool Read(const std::filesystem::path& path, const std::string& key, std::vector<double>& values)
{
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes{ std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
  const std::string head = key + "\n";
  if (bytes.size() < head.size() + 16 || bytes.compare(0, head.size(), head) != 0 ||
    bytes.substr(bytes.size() - 16) != Hex(Hash(bytes.data(), bytes.size() - 16)))
  {
    return false;
  }
  values.resize((bytes.size() - head.size() - 16) / sizeof(double));
  std::memcpy(values.data(), bytes.data() + head.size(), values.size() * sizeof(double));
  return true;
}

void Write(const std::filesystem::path& path, const std::string& key, const std::vector<double>& values)
{
  std::string bytes = key + "\n";
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
  bytes += Hex(Hash(bytes.data(), bytes.size()));
  std::error_code ignored; // a cache that cannot be written only costs time
  std::filesystem::create_directories(path.parent_path(), ignored);
  std::filesystem::path temporary = path;
  temporary += "." + std::to_string(std::random_device{}()) + ".tmp"; // unique among processes
  std::ofstream stream(temporary, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (stream)
  {
    std::filesystem::rename(temporary, path, ignored); // atomic: no one reads half a file
  }
  std::filesystem::remove(temporary, ignored);
}
}

void SetThreadCount(int count) { ThreadCount = count; }

void ParallelFor(int count, const std::function<void(int)>& body)
{
  std::atomic<int> next{ 0 };
  const auto work = [&] {
    for (int i = next++; i < count; i = next++)
    {
      body(i);
    }
  };
  const int wanted =
    ThreadCount > 0 ? ThreadCount.load() : static_cast<int>(std::thread::hardware_concurrency());
  std::vector<std::thread> others;
  for (int i = 1; i < std::min(wanted, count); ++i)
  {
    others.emplace_back(work);
  }
  work();
  for (std::thread& thread : others)
  {
    thread.join();
  }
}

std::uint64_t Hash(const void* data, std::size_t bytes, std::uint64_t seed)
{
  const unsigned char* byte = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < bytes; ++i)
  {
    seed = (seed ^ byte[i]) * 1099511628211ull;
  }
  return seed;
}

std::string KeyOf(const Environment& environment)
{
  return "[environment " + std::to_string(environment.width) + "x" + std::to_string(environment.height) +
    " " + Hex(Hash(environment.rgb.data(), environment.rgb.size() * sizeof(double))) + "]";
}

std::string KeyOf(const std::vector<Vec3>& directions)
{
  return "[" + std::to_string(directions.size()) + " directions " +
    Hex(Hash(directions.data(), directions.size() * sizeof(Vec3))) + "]";
}

std::vector<double> CachedDoubles(const std::string& key, const std::function<std::vector<double>()>& compute)
{
  const std::string fullKey = key + " " VTKIBL_REFERENCE_SOURCES;
  const std::filesystem::path path = CacheDirectory() / (Hex(Hash(fullKey.data(), fullKey.size())) + ".bin");
  std::vector<double> values;
  if (!Read(path, fullKey, values))
  {
    values = compute();
    Write(path, fullKey, values);
  }
  return values;
}
}
