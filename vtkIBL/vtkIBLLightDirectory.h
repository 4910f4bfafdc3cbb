// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Stored lights in a directory, a file each, that any number of processes use at once. It may hold other files, which
// are left alone, and all of it may vanish at any time. The time of a file is when it was last used.
#ifndef vtkIBLLightDirectory_h
#define vtkIBLLightDirectory_h

#include "vtkIBLStoredLight.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

class vtkIBLLightDirectory
{
public:
  explicit vtkIBLLightDirectory(const std::filesystem::path& path)
    : Path(path)
  {
  }

  std::filesystem::path GetFile(const std::string& key) const { return this->Path / ("vtkIBL-" + key + ".exr"); }

  /// Null when there is no such light. Throws a std::exception when its file is of no use.
  std::shared_ptr<const vtkIBLStoredLight> Read(const std::string& key) const;

  /// Readers find the old file or the whole new one. Throws a std::exception when it cannot be written, with nothing
  /// left behind.
  void Write(const std::string& key, const vtkIBLStoredLight& light) const;

  /// A light that is in use elsewhere counts as used here.
  void Touch(const std::string& key) const;

  /// Removes lights, those used longest ago first, until the rest has at most so many bytes; and what writers that were
  /// killed left.
  void Shrink(std::uintmax_t maximumBytes) const;

  std::uintmax_t GetNumberOfBytes() const;

private:
  std::filesystem::path Path;
};

#endif
