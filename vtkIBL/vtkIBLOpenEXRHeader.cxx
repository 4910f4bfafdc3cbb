// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The layout is that of "OpenEXR File Layout" (openexr.com): numbers little-endian, as every machine with OpenGL 4.5
// is; strings end with a zero.
#include "vtkIBLOpenEXRHeader.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

namespace
{
constexpr std::uint32_t Magic = 20000630;
constexpr std::uint32_t MultiPart = 0x1000;

std::uint32_t ReadNumber(std::istream& file)
{
  std::uint32_t number = 0;
  file.read(reinterpret_cast<char*>(&number), sizeof number);
  return number;
}

std::string ReadString(std::istream& file)
{
  std::string text;
  std::getline(file, text, '\0');
  return text;
}

// Whether OpenEXR reads so many bytes for an attribute of a type, and keeps no more than they can fill.
bool Fits(std::istream& file, const std::string& type, std::int64_t bytes)
{
  static const std::map<std::string, int> sizes = { { "box2f", 16 }, { "box2i", 16 }, { "chromaticities", 32 },
    { "compression", 1 }, { "deepImageState", 1 }, { "double", 8 }, { "envmap", 1 }, { "float", 4 }, { "int", 4 },
    { "keycode", 28 }, { "lineOrder", 1 }, { "m33d", 72 }, { "m33f", 36 }, { "m44d", 128 }, { "m44f", 64 },
    { "rational", 8 }, { "tiledesc", 9 }, { "timecode", 8 }, { "v2d", 16 }, { "v2f", 8 }, { "v2i", 8 }, { "v3d", 24 },
    { "v3f", 12 }, { "v3i", 12 } };
  if (const auto found = sizes.find(type); found != sizes.end())
  {
    return bytes == found->second;
  }
  const std::int64_t end = file.tellg() + bytes;
  if (type == "chlist")
  {
    while (file && file.tellg() < end)
    {
      if (ReadString(file).empty()) // the list's end
      {
        return file.tellg() == end;
      }
      file.seekg(16, std::ios::cur);
    }
    return false;
  }
  if (type == "stringvector")
  {
    while (file && file.tellg() < end)
    {
      file.seekg(ReadNumber(file), std::ios::cur);
    }
    return file.tellg() == end;
  }
  if (type == "preview")
  {
    const std::uint64_t width = ReadNumber(file), height = ReadNumber(file);
    return std::uint64_t(bytes) == 8 + 4 * width * height;
  }
  if (type == "idmanifest")
  {
    constexpr int mostOfDeflate = 1032; // bytes out of one
    return ReadNumber(file) <= mostOfDeflate * bytes;
  }
  return true; // opaque to OpenEXR, or a string: so many bytes
}

// What the attribute says of windows and tiles; at most 2^31 - 1 each way, so that products stay below 2^62.
vtkIBLOpenEXRSize ReadSize(std::istream& file, const std::string& name)
{
  std::int64_t width = 0, height = 0;
  if (name == "tiles")
  {
    width = ReadNumber(file);
    height = ReadNumber(file);
  }
  else if (name == "dataWindow" || name == "displayWindow")
  {
    std::int64_t bounds[4];
    for (std::int64_t& bound : bounds)
    {
      bound = std::int32_t(ReadNumber(file));
    }
    width = bounds[2] - bounds[0] + 1;
    height = bounds[3] - bounds[1] + 1;
  }
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  return { std::clamp<std::int64_t>(width, 0, most), std::clamp<std::int64_t>(height, 0, most) };
}
}

vtkIBLOpenEXRSize vtkIBLCheckOpenEXRHeader(const std::filesystem::path& path)
{
  vtkIBLOpenEXRSize largest;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::int64_t fileSize = file ? std::int64_t(file.tellg()) : 0;
  file.seekg(0);
  if (ReadNumber(file) != Magic)
  {
    return largest;
  }
  const bool isMultiPart = ReadNumber(file) & MultiPart;
  bool isEmpty = true; // the header
  for (std::string name = ReadString(file); file; name = ReadString(file))
  {
    if (name.empty() && (isEmpty || !isMultiPart))
    {
      break; // a file of several parts ends them with an empty header
    }
    isEmpty = name.empty();
    if (isEmpty)
    {
      continue;
    }
    const std::string type = ReadString(file);
    const auto bytes = std::int32_t(ReadNumber(file));
    const std::int64_t begin = file.tellg();
    if (file && (bytes < 0 || bytes > fileSize - begin || !Fits(file, type, bytes)))
    {
      throw std::runtime_error("its header is damaged: it has an attribute '" + name.substr(0, 255) + "' of type '" +
        type.substr(0, 255) + "' and " + std::to_string(bytes) + " bytes");
    }
    file.seekg(begin);
    if (const vtkIBLOpenEXRSize size = ReadSize(file, name); size.GetNumberOfPixels() > largest.GetNumberOfPixels())
    {
      largest = size;
    }
    file.seekg(begin + bytes);
  }
  return largest;
}
