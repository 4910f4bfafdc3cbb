// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StressFiles.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace
{
struct Kind
{
  const char* Name; // its extension is its format
  OIIO::TypeDesc Type;
  int Channels = 3;
  const char* Compression = "";
  int Tile = 0;
  bool HasMipmaps = false;
  int Parts = 1;
  const char* Envmap = "";
  int Margin = 0; // of the data window around the display window; negative: inside
};

void Write(const std::filesystem::path& path, const Kind& kind)
{
  const bool isCube = kind.Envmap == std::string("CubeFace Environment");
  const int height = isCube ? 48 : std::max(8, kind.Tile); // whole tiles: what pads others is random
  const int width = isCube ? 8 : 2 * height;
  OIIO::ImageSpec spec(width + 2 * kind.Margin, height + 2 * kind.Margin, kind.Channels, kind.Type);
  spec.x = spec.y = -kind.Margin;
  spec.full_width = width;
  spec.full_height = height;
  spec.tile_width = spec.tile_height = kind.Tile;
  spec.attribute("DateTime", "2000:01:01 00:00:00"); // or it would be now
  if (*kind.Compression)
  {
    spec.attribute("compression", kind.Compression);
  }
  if (kind.HasMipmaps)
  {
    spec.attribute("textureformat", "Plain Texture");
  }
  if (*kind.Envmap)
  {
    spec.attribute("textureformat", kind.Envmap);
  }
  const auto check = [&](bool isWritten)
  {
    if (!isWritten)
    {
      throw std::runtime_error("cannot write " + path.string());
    }
  };
  const auto file = OIIO::ImageOutput::create(path.string());
  check(bool(file));
  std::vector<OIIO::ImageSpec> parts(kind.Parts, spec);
  for (int part = 0; part < kind.Parts; ++part)
  {
    parts[part].attribute("oiio:subimagename", "part " + std::to_string(part));
  }
  check(kind.Parts == 1 ? file->open(path.string(), spec) : file->open(path.string(), kind.Parts, parts.data()));
  for (int part = 0, level = 0; part < kind.Parts && spec.width > 0;)
  {
    std::vector<float> pixels(std::size_t(spec.width) * spec.height * spec.nchannels);
    for (std::size_t i = 0; i < pixels.size(); ++i)
    {
      pixels[i] = float(i * 37 % 101) / 101;
    }
    check(file->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
    if (kind.HasMipmaps && spec.width > 1)
    {
      ++level;
      spec.width = spec.full_width = 16 >> level;
      spec.height = spec.full_height = std::max(8 >> level, 1);
      check(file->open(path.string(), spec, OIIO::ImageOutput::AppendMIPLevel));
      continue;
    }
    ++part;
    check(part == kind.Parts || file->open(path.string(), parts[part], OIIO::ImageOutput::AppendSubimage));
  }
  check(file->close());
}
}

std::vector<std::filesystem::path> WriteStressFiles(const std::filesystem::path& folder)
{
  using OIIO::TypeDesc;
  const Kind kinds[] = {
    { "none.exr", TypeDesc::FLOAT, 3, "none" },
    { "zip.exr", TypeDesc::HALF, 3, "zip" },
    { "zips.exr", TypeDesc::HALF, 4, "zips" },
    { "rle.exr", TypeDesc::HALF, 3, "rle" },
    { "piz.exr", TypeDesc::HALF, 3, "piz" },
    { "pxr24.exr", TypeDesc::FLOAT, 3, "pxr24" },
    { "b44.exr", TypeDesc::HALF, 3, "b44" },
    { "dwaa.exr", TypeDesc::HALF, 3, "dwaa:45" },
    { "uint.exr", TypeDesc::UINT32, 1, "zip" },
    { "tiled.exr", TypeDesc::HALF, 3, "zip", 8 },
    { "mipmaps.exr", TypeDesc::HALF, 3, "zip", 8, true },
    { "parts.exr", TypeDesc::HALF, 3, "zip", 0, false, 2 },
    { "envmap.exr", TypeDesc::HALF, 3, "zip", 0, false, 1, "LatLong Environment" },
    { "cube.exr", TypeDesc::HALF, 3, "zip", 8, false, 1, "CubeFace Environment" },
    { "overscan.exr", TypeDesc::HALF, 3, "zip", 0, false, 1, "", 3 },
    { "cropped.exr", TypeDesc::HALF, 3, "zip", 0, false, 1, "", -2 },
    { "radiance.hdr", TypeDesc::FLOAT },
    { "float.tif", TypeDesc::FLOAT, 3, "zip" },
    { "half.tif", TypeDesc::HALF, 3, "none" },
    { "double.tif", TypeDesc::DOUBLE, 3, "none" },
    { "uint16.tif", TypeDesc::UINT16, 3, "lzw" },
    { "two.tif", TypeDesc::UINT8, 2, "packbits" },
    { "tiled.tif", TypeDesc::FLOAT, 3, "zip", 16 },
    { "uint8.png", TypeDesc::UINT8 },
    { "uint16.png", TypeDesc::UINT16, 4 },
    { "grey.png", TypeDesc::UINT8, 1 },
    { "uint8.jpg", TypeDesc::UINT8 },
  };
  std::vector<std::filesystem::path> paths;
  for (const Kind& kind : kinds)
  {
    paths.push_back(folder / kind.Name);
    Write(paths.back(), kind);
  }
  return paths;
}
