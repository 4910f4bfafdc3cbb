// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLLightDirectory.h"

#include "vtkIBLStoredLightFile.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <iomanip>
#include <random>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace fs = std::filesystem;

namespace
{
constexpr const char* LightNames = "vtkIBL-[0-9a-f]{32}\\.exr";
constexpr const char* TemporaryNames = "vtkIBL-[0-9a-f]{32}-[0-9a-f]{16}\\.tmp";
constexpr std::chrono::hours LongestWrite(1);

struct File
{
  fs::path Path;
  fs::file_time_type Time;
  std::uintmax_t Size;
};

std::vector<File> ListFiles(const fs::path& directory, const char* names)
{
  std::vector<File> files;
  const std::regex pattern(names);
  std::error_code end;
  for (fs::directory_iterator it(directory, end), last; !end && it != last; it.increment(end))
  {
    std::error_code gone[3];
    if (std::regex_match(it->path().filename().string(), pattern) && it->is_regular_file(gone[0]))
    {
      const File file = { it->path(), it->last_write_time(gone[1]), it->file_size(gone[2]) };
      if (!gone[1] && !gone[2])
      {
        files.push_back(file);
      }
    }
  }
  return files;
}

std::uintmax_t GetTotal(const std::vector<File>& files)
{
  std::uintmax_t total = 0;
  for (const File& file : files)
  {
    total += file.Size;
  }
  return total;
}

void TouchFile(const fs::path& path)
{
  std::error_code ignored; // what is gone or read only keeps its time
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
}
}

std::shared_ptr<const vtkIBLStoredLight> vtkIBLLightDirectory::Read(const std::string& key) const
{
  const fs::path path = this->GetFile(key);
  std::error_code ignored;
  if (!fs::exists(path, ignored))
  {
    return nullptr;
  }
  try
  {
    if (!fs::is_regular_file(path)) // a pipe would block for ever
    {
      throw std::runtime_error("it is no regular file");
    }
    auto light = std::make_shared<const vtkIBLStoredLight>(vtkIBLReadStoredLight(path, key));
    TouchFile(path);
    return light;
  }
  catch (const std::exception&)
  {
    if (!fs::exists(path, ignored))
    {
      return nullptr; // another process has just removed it
    }
    throw;
  }
}

void vtkIBLLightDirectory::Write(const std::string& key, const vtkIBLStoredLight& light) const
{
  std::random_device random;
  std::ostringstream name;
  name << "vtkIBL-" << key << '-' << std::hex << std::setfill('0') << std::setw(8) << random() << std::setw(8)
       << random() << ".tmp";
  const fs::path temporary = this->Path / name.str();
  try
  {
    fs::create_directories(this->Path);
    vtkIBLWriteStoredLight(temporary, key, light);
    TouchFile(temporary); // by the same clock as reading does
    fs::rename(temporary, this->GetFile(key));
  }
  catch (const std::exception&)
  {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
}

void vtkIBLLightDirectory::Touch(const std::string& key) const
{
  TouchFile(this->GetFile(key));
}

void vtkIBLLightDirectory::Shrink(std::uintmax_t maximumBytes) const
{
  std::error_code ignored; // somebody else removed it
  for (const File& file : ListFiles(this->Path, TemporaryNames))
  {
    if (file.Time < fs::file_time_type::clock::now() - LongestWrite)
    {
      fs::remove(file.Path, ignored);
    }
  }
  std::vector<File> lights = ListFiles(this->Path, LightNames);
  std::sort(lights.begin(), lights.end(), [](const File& a, const File& b) { return a.Time < b.Time; });
  std::uintmax_t total = GetTotal(lights);
  for (auto oldest = lights.begin(); total > maximumBytes; ++oldest)
  {
    fs::remove(oldest->Path, ignored);
    total -= oldest->Size;
  }
}

std::uintmax_t vtkIBLLightDirectory::GetNumberOfBytes() const
{
  return GetTotal(ListFiles(this->Path, LightNames));
}
