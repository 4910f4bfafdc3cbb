// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// libFuzzer's bytes as a file in memory.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

class FuzzFile
{
public:
  ~FuzzFile() { std::filesystem::remove_all(this->Folder); }

  std::filesystem::path Write(const void* data, std::size_t size, const std::string& extension) const
  {
    const std::filesystem::path path = this->Folder / ("x." + extension);
    std::ofstream stream(path, std::ios::binary);
    if (!stream.write(static_cast<const char*>(data), static_cast<std::streamsize>(size)))
    {
      std::abort();
    }
    return path;
  }

private:
  static std::filesystem::path MakeFolder()
  {
    const std::filesystem::path folder = "/dev/shm/vtkIBL-fuzz-" + std::to_string(getpid());
    std::filesystem::create_directories(folder);
    return folder;
  }
  std::filesystem::path Folder = MakeFolder();
};
