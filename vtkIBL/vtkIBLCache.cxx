// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLCache.h"

#include "vtkIBLHash.h"
#include "vtkIBLLightDirectory.h"
#include "vtkIBLStoredLight.h"
#include "vtkIBLStoredLightFile.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <list>
#include <mutex>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using Light = std::shared_ptr<const vtkIBLStoredLight>;

struct Entry
{
  std::string Key;
  Light Stored;
};

struct State
{
  std::mutex Mutex; // guards all below; files are read and written without it
  bool Enabled = true;
  std::optional<std::string> Directory;
  vtkTypeInt64 MaximumDiskBytes = vtkTypeInt64(1) << 30;
  vtkTypeInt64 MaximumMemoryBytes = vtkTypeInt64(256) << 20;
  std::list<Entry> Entries; // used last comes first
  vtkTypeInt64 MemoryBytes = 0;
  vtkTypeInt64 MemoryHits = 0;
  vtkTypeInt64 DiskHits = 0;
  vtkTypeInt64 Misses = 0;
  vtkTypeInt64 BrokenFiles = 0;
  std::set<std::string> Said;
};

// Never destroyed: light may be stored while other static objects go.
State& GetState()
{
  static auto* state = new State;
  return *state;
}

template <typename T>
T Read(T State::*member)
{
  const std::lock_guard<std::mutex> lock(GetState().Mutex);
  return GetState().*member;
}

// Says a text once for each subject and directory.
void SayOnce(const std::string& subject, const std::string& text)
{
  bool isNew;
  {
    const std::lock_guard<std::mutex> lock(GetState().Mutex);
    isNew = GetState().Said.insert(subject).second;
  }
  if (isNew)
  {
    vtkGenericWarningMacro(<< text);
  }
}

//------------------------------------------------------------------------------
// Memory. The caller holds the mutex.

vtkTypeInt64 SizeOf(const Entry& entry)
{
  return vtkTypeInt64(sizeof(vtkIBLStoredLight) + entry.Stored->GetNumberOfBytes());
}

void ShrinkMemory(State& state, vtkTypeInt64 maximum)
{
  while (state.MemoryBytes > maximum)
  {
    state.MemoryBytes -= SizeOf(state.Entries.back());
    state.Entries.pop_back();
  }
}

// The light, which is now the one used last; or null.
Light FindInMemory(State& state, const std::string& key)
{
  const auto found =
    std::find_if(state.Entries.begin(), state.Entries.end(), [&key](const Entry& entry) { return entry.Key == key; });
  if (found == state.Entries.end())
  {
    return nullptr;
  }
  state.Entries.splice(state.Entries.begin(), state.Entries, found);
  return state.Entries.front().Stored;
}

void HoldInMemory(State& state, const std::string& key, const Light& light)
{
  if (FindInMemory(state, key))
  {
    state.MemoryBytes -= SizeOf(state.Entries.front());
    state.Entries.pop_front();
  }
  const Entry entry = { key, light };
  if (SizeOf(entry) <= state.MaximumMemoryBytes) // else it would drive out all others for nothing
  {
    ShrinkMemory(state, state.MaximumMemoryBytes - SizeOf(entry));
    state.Entries.push_front(entry);
    state.MemoryBytes += SizeOf(entry);
  }
}

//------------------------------------------------------------------------------
// Disk.

// None: memory only.
std::optional<vtkIBLLightDirectory> GetLightDirectory()
{
  const char* variable = std::getenv("VTKIBL_CACHE");
  if (variable && std::string(variable) == "off")
  {
    return std::nullopt;
  }
  const std::string directory = vtkIBLCache::GetDirectory();
  if (directory.empty())
  {
    if (!Read(&State::Directory))
    {
      SayOnce("directory",
        "Baked light is kept in memory only: neither XDG_CACHE_HOME nor HOME is set. Name a directory with "
        "vtkIBLCache::SetDirectory(); an empty name means that memory is enough.");
    }
    return std::nullopt;
  }
  return vtkIBLLightDirectory(fs::u8path(directory));
}

// Null also when the file is of no use, with a word.
Light ReadFromDisk(const vtkIBLLightDirectory& directory, const std::string& key)
{
  try
  {
    return directory.Read(key);
  }
  catch (const std::exception& error)
  {
    {
      const std::lock_guard<std::mutex> lock(GetState().Mutex);
      ++GetState().BrokenFiles;
    }
    const std::string file = directory.GetFile(key).u8string();
    SayOnce(file,
      "Baked light in '" + file + "' cannot be used (" + error.what() + "). It is baked again and the file replaced.");
    return nullptr;
  }
}
}

//------------------------------------------------------------------------------
void vtkIBLCache::SetEnabled(bool enabled)
{
  const std::lock_guard<std::mutex> lock(GetState().Mutex);
  GetState().Enabled = enabled;
}

bool vtkIBLCache::GetEnabled()
{
  return Read(&State::Enabled);
}

void vtkIBLCache::SetDirectory(const char* directory)
{
  const std::lock_guard<std::mutex> lock(GetState().Mutex);
  GetState().Directory = directory ? std::optional<std::string>(directory) : std::nullopt;
  GetState().Said.clear();
}

std::string vtkIBLCache::GetDirectory()
{
  if (const std::optional<std::string> directory = Read(&State::Directory))
  {
    return *directory;
  }
  // XDG Base Directory Specification: a relative path is to be ignored.
  const char* base = std::getenv("XDG_CACHE_HOME");
  if (base && fs::u8path(base).is_absolute())
  {
    return std::string(base) + "/vtkIBL";
  }
  const char* home = std::getenv("HOME");
  return home && *home ? std::string(home) + "/.cache/vtkIBL" : std::string();
}

void vtkIBLCache::SetMaximumDiskBytes(vtkTypeInt64 bytes)
{
  if (bytes < 0)
  {
    vtkGenericWarningMacro("MaximumDiskBytes is " << bytes << "; give 0 or more. The old value stays.");
    return;
  }
  // Nothing is removed yet: the directory may be about to change too.
  const std::lock_guard<std::mutex> lock(GetState().Mutex);
  GetState().MaximumDiskBytes = bytes;
}

vtkTypeInt64 vtkIBLCache::GetMaximumDiskBytes()
{
  return Read(&State::MaximumDiskBytes);
}

void vtkIBLCache::SetMaximumMemoryBytes(vtkTypeInt64 bytes)
{
  if (bytes < 0)
  {
    vtkGenericWarningMacro("MaximumMemoryBytes is " << bytes << "; give 0 or more. The old value stays.");
    return;
  }
  const std::lock_guard<std::mutex> lock(GetState().Mutex);
  GetState().MaximumMemoryBytes = bytes;
  ShrinkMemory(GetState(), bytes);
}

vtkTypeInt64 vtkIBLCache::GetMaximumMemoryBytes()
{
  return Read(&State::MaximumMemoryBytes);
}

void vtkIBLCache::ClearMemory()
{
  const std::lock_guard<std::mutex> lock(GetState().Mutex);
  ShrinkMemory(GetState(), 0);
}

vtkTypeInt64 vtkIBLCache::GetNumberOfMemoryHits()
{
  return Read(&State::MemoryHits);
}

vtkTypeInt64 vtkIBLCache::GetNumberOfDiskHits()
{
  return Read(&State::DiskHits);
}

vtkTypeInt64 vtkIBLCache::GetNumberOfMisses()
{
  return Read(&State::Misses);
}

vtkTypeInt64 vtkIBLCache::GetNumberOfBrokenFiles()
{
  return Read(&State::BrokenFiles);
}

vtkTypeInt64 vtkIBLCache::GetMemoryBytes()
{
  return Read(&State::MemoryBytes);
}

vtkTypeInt64 vtkIBLCache::GetDiskBytes()
{
  const std::optional<vtkIBLLightDirectory> directory = GetLightDirectory();
  return directory ? vtkTypeInt64(directory->GetNumberOfBytes()) : 0;
}

//------------------------------------------------------------------------------
std::string vtkIBLCache::MakeFileKey(const std::string& fileName, const std::string& settings)
{
  const fs::path path = fs::u8path(fileName);
  std::error_code ignored;
  std::ifstream file;
  if (fs::is_regular_file(path, ignored)) // a pipe would block for ever
  {
    file.open(path, std::ios::binary);
  }
  if (!file.is_open())
  {
    return std::string();
  }
  vtkIBLHash hash;
  hash.Add(vtkIBLStoredLightVersion);
  hash.Add("file " + settings);
  std::vector<char> block(std::size_t(256) << 10); // stays in the processor's cache
  while (file.read(block.data(), block.size()) || file.gcount() > 0)
  {
    hash.Add(block.data(), std::size_t(file.gcount()));
  }
  return file.bad() ? std::string() : hash.Get();
}

std::string vtkIBLCache::MakePixelKey(const void* pixels, std::size_t bytes, const std::string& settings)
{
  vtkIBLHash hash;
  hash.Add(vtkIBLStoredLightVersion);
  hash.Add("pixels " + settings);
  hash.Add(pixels, bytes);
  return hash.Get();
}

std::shared_ptr<const vtkIBLStoredLight> vtkIBLCache::Find(const std::string& key)
{
  State& state = GetState();
  if (key.empty() || !GetEnabled())
  {
    return nullptr;
  }
  const std::optional<vtkIBLLightDirectory> directory = GetLightDirectory();
  Light light;
  {
    const std::lock_guard<std::mutex> lock(state.Mutex);
    light = FindInMemory(state, key);
    state.MemoryHits += light ? 1 : 0;
  }
  if (light)
  {
    if (directory)
    {
      directory->Touch(key);
    }
    return light;
  }
  if (directory)
  {
    light = ReadFromDisk(*directory, key);
  }
  const std::lock_guard<std::mutex> lock(state.Mutex);
  ++(light ? state.DiskHits : state.Misses);
  if (const Light meanwhile = FindInMemory(state, key))
  {
    return meanwhile; // stored by another thread, so newer
  }
  if (light)
  {
    HoldInMemory(state, key, light);
  }
  return light;
}

void vtkIBLCache::Store(const std::string& key, std::shared_ptr<const vtkIBLStoredLight> light)
{
  assert(light && light->IsWhole());
  State& state = GetState();
  if (key.empty() || !GetEnabled())
  {
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(state.Mutex);
    HoldInMemory(state, key, light);
  }
  const std::optional<vtkIBLLightDirectory> directory = GetLightDirectory();
  const std::size_t bytes = light->GetNumberOfBytes();
  const auto maximum = std::uintmax_t(GetMaximumDiskBytes());
  if (!directory || bytes == 0 || bytes > maximum)
  {
    return;
  }
  try
  {
    directory->Write(key, *light);
    directory->Shrink(maximum);
  }
  catch (const std::exception& error)
  {
    SayOnce("write",
      "Baked light cannot be kept in '" + GetDirectory() + "' (" + error.what() +
        "). It is kept in memory only. Make room there, or name another place with vtkIBLCache::SetDirectory().");
  }
}
