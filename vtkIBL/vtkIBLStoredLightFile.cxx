// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLStoredLightFile.h"

#include "vtkIBLHash.h"
#include "vtkIBLOpenEXRHeader.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledInputPart.h>
#include <OpenEXR/ImfTiledOutputPart.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace
{
constexpr int WordSize = 4; // of every pixel type here
constexpr int WordsPerBrightTexel = sizeof(vtkIBLBrightTexel) / WordSize;
static_assert(sizeof(vtkIBLBrightTexel) == 7 * sizeof(double), "no padding, for it would be hashed");

// Far above what is ever baked, and far below what overflows.
constexpr int LargestFaceSize = 16384;
constexpr int LargestOrder = 16384;
constexpr std::size_t MostBrightTexels = 1 << 20;

// One part of the file and where it is in memory, pixel by pixel.
struct Part
{
  const char* Name;
  Imf::PixelType Type;
  int Width, Height;
  std::vector<std::string> Channels; // in memory's order
  char* Words;
};

std::vector<Part> GetParts(vtkIBLStoredLight& light)
{
  std::vector<Part> parts;
  const auto add = [&parts](const char* name, Imf::PixelType type, int width, std::size_t height,
                     const std::vector<std::string>& channels, void* words)
  {
    if (width > 0 && height > 0)
    {
      parts.push_back({ name, type, width, int(height), channels, static_cast<char*>(words) });
    }
  };
  const int n = light.CubeFaceSize;
  add("cube", Imf::FLOAT, n, 6 * n, { "R", "G", "B" }, light.Cube.data());
  add("spectrum", Imf::FLOAT, int(light.Coefficients.size() / 6), 1,
    { "real.R", "real.G", "real.B", "imaginary.R", "imaginary.G", "imaginary.B" }, light.Coefficients.data());
  add("brightTexels", Imf::UINT, WordsPerBrightTexel, light.BrightTexels.size(), { "bits" }, light.BrightTexels.data());
  return parts;
}

// The facts by name. `numberOfBrightTexels` is apart, because on reading it comes before the texels.
template <typename Light, typename Size, typename Visitor>
void VisitFacts(Light& light, Size& numberOfBrightTexels, const Visitor& visit)
{
  visit("vtkIBL.sourceWidth", light.SourceWidth);
  visit("vtkIBL.sourceHeight", light.SourceHeight);
  visit("vtkIBL.sourceFaces", light.SourceFaces);
  visit("vtkIBL.meanLuminance", light.MeanLuminance);
  visit("vtkIBL.notFinite", light.Faults.NotFinite);
  visit("vtkIBL.tooLarge", light.Faults.TooLarge);
  visit("vtkIBL.negative", light.Faults.Negative);
  visit("vtkIBL.mostNegative", light.Faults.MostNegative);
  visit("vtkIBL.cubeFaceSize", light.CubeFaceSize);
  visit("vtkIBL.spectrumOrder", light.SpectrumOrder);
  visit("vtkIBL.numberOfBrightTexels", numberOfBrightTexels);
}

template <typename T>
void Set(Imf::Header& header, const char* name, const T& value)
{
  header.insert(name, Imf::TypedAttribute<T>(value));
}

// OpenEXR has no integer of 64 bits.
void Set(Imf::Header& header, const char* name, std::size_t value)
{
  Set(header, name, std::to_string(value));
}

template <typename T>
void Get(const Imf::Header& header, const char* name, T& value)
{
  value = header.typedAttribute<Imf::TypedAttribute<T>>(name).value();
}

void Get(const Imf::Header& header, const char* name, std::size_t& value)
{
  std::string text;
  Get(header, name, text);
  value = std::stoull(text);
}

std::string GetChecksum(const std::string& key, const vtkIBLStoredLight& light)
{
  vtkIBLHash hash;
  hash.Add(key);
  const std::size_t numberOfBrightTexels = light.BrightTexels.size();
  VisitFacts(light, numberOfBrightTexels, [&hash](const char*, auto value) { hash.Add(value); });
  hash.Add(light.Cube);
  hash.Add(light.Coefficients);
  hash.Add(light.BrightTexels);
  return hash.Get();
}

Imf::Header MakeHeader(const Part& part)
{
  Imf::Header header(part.Width, part.Height);
  header.setName(part.Name);
  header.setType(Imf::TILEDIMAGE);
  header.setTileDescription(Imf::TileDescription(part.Width, std::min(part.Width, part.Height)));
  header.compression() = Imf::NO_COMPRESSION;
  for (const std::string& channel : part.Channels)
  {
    header.channels().insert(channel, Imf::Channel(part.Type));
  }
  return header;
}

// OpenEXR hands out uncompressed pixels as they lie in the file, which is four times as fast as through a frame buffer:
// row by row, channel by channel in alphabetical order, little-endian as every machine with OpenGL 4.5 is.
void ReadTile(Imf::TiledInputPart& input, const Part& part, int tile)
{
  const int tileHeight = std::min(part.Width, part.Height);
  const int rows = std::min(tileHeight, part.Height - tile * tileHeight);
  const int channels = int(part.Channels.size());
  int x = 0, levelX = 0, levelY = 0, size = 0;
  const char* words = nullptr;
  input.rawTileData(x, tile, levelX, levelY, words, size);
  if (size != std::int64_t(rows) * part.Width * channels * WordSize)
  {
    throw std::runtime_error("a tile has another size than its header says");
  }
  std::vector<int> order(channels);
  for (int i = 0; i < channels; ++i)
  {
    order[i] = i;
  }
  std::sort(order.begin(), order.end(), [&part](int a, int b) { return part.Channels[a] < part.Channels[b]; });
  const std::size_t first = std::size_t(tile) * tileHeight;
  for (std::size_t row = first; row < first + rows; ++row)
  {
    for (const int channel : order)
    {
      char* to = part.Words + (row * part.Width * channels + channel) * WordSize;
      for (int i = 0; i < part.Width; ++i, words += WordSize, to += channels * WordSize)
      {
        std::memcpy(to, words, WordSize);
      }
    }
  }
}
}

void vtkIBLWriteStoredLight(const std::filesystem::path& path, const std::string& key, const vtkIBLStoredLight& light)
{
  const std::vector<Part> parts = GetParts(const_cast<vtkIBLStoredLight&>(light)); // which only points to it
  std::vector<Imf::Header> headers;
  for (const Part& part : parts)
  {
    headers.push_back(MakeHeader(part));
  }
  Imf::Header& facts = headers.at(0);
  Set(facts, "vtkIBL.version", vtkIBLStoredLightVersion);
  Set(facts, "vtkIBL.key", key);
  Set(facts, "vtkIBL.checksum", GetChecksum(key, light));
  const std::size_t numberOfBrightTexels = light.BrightTexels.size();
  VisitFacts(light, numberOfBrightTexels, [&facts](const char* name, const auto& value) { Set(facts, name, value); });

  std::ofstream stream(path, std::ios::binary);
  {
    Imf::StdOFStream output(stream, path.string().c_str());
    Imf::MultiPartOutputFile file(output, headers.data(), int(headers.size()), true, 0);
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      const Part& part = parts[i];
      const std::size_t stride = part.Channels.size() * WordSize;
      Imf::FrameBuffer frame;
      for (std::size_t channel = 0; channel < part.Channels.size(); ++channel)
      {
        frame.insert(
          part.Channels[channel], Imf::Slice(part.Type, part.Words + channel * WordSize, stride, stride * part.Width));
      }
      Imf::TiledOutputPart tiles(file, int(i));
      tiles.setFrameBuffer(frame);
      tiles.writeTiles(0, 0, 0, tiles.numYTiles() - 1);
    }
  } // which writes where the tiles are, and keeps its errors to itself
  stream.close();
  if (!stream)
  {
    throw std::system_error(errno, std::generic_category(), "writing failed");
  }
}

vtkIBLStoredLight vtkIBLReadStoredLight(const std::filesystem::path& path, const std::string& key)
{
  const vtkIBLOpenEXRSize largest = vtkIBLCheckOpenEXRHeader(path);
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  const std::int64_t size = stream ? std::int64_t(stream.tellg()) : 0;
  if (largest.GetNumberOfPixels() > size)
  {
    throw std::runtime_error("its " + std::to_string(size) + " bytes cannot hold " + std::to_string(largest.Width) +
      " x " + std::to_string(largest.Height) + " pixels");
  }
  stream.seekg(0);
  Imf::StdIFStream input(stream, path.string().c_str());
  Imf::MultiPartInputFile file(input, 0);

  const Imf::Header& facts = file.header(0);
  int version = 0;
  std::string writtenKey, checksum;
  Get(facts, "vtkIBL.version", version);
  Get(facts, "vtkIBL.key", writtenKey);
  Get(facts, "vtkIBL.checksum", checksum);
  if (version != vtkIBLStoredLightVersion || writtenKey != key)
  {
    throw std::runtime_error("it holds version " + std::to_string(version) + " of " + writtenKey);
  }
  vtkIBLStoredLight light;
  std::size_t numberOfBrightTexels = 0;
  VisitFacts(light, numberOfBrightTexels, [&facts](const char* name, auto& value) { Get(facts, name, value); });

  // Nothing is allocated that the file could not fill.
  const int n = light.CubeFaceSize, order = light.SpectrumOrder;
  if (n < 0 || n > LargestFaceSize || order < -1 || order > LargestOrder || numberOfBrightTexels > MostBrightTexels ||
    WordSize * (light.GetCubeLength(n) + light.GetCoefficientsLength(order)) +
        sizeof(vtkIBLBrightTexel) * numberOfBrightTexels >
      std::size_t(size))
  {
    throw std::runtime_error("its " + std::to_string(size) + " bytes cannot hold a cube of " + std::to_string(n) +
      ", order " + std::to_string(order) + " and " + std::to_string(numberOfBrightTexels) + " bright texels");
  }
  light.Cube.resize(light.GetCubeLength(n));
  light.Coefficients.resize(light.GetCoefficientsLength(order));
  light.BrightTexels.resize(numberOfBrightTexels);

  const std::vector<Part> parts = GetParts(light);
  if (file.parts() != int(parts.size()))
  {
    throw std::runtime_error("it has " + std::to_string(file.parts()) + " parts");
  }
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const Imf::Header expected = MakeHeader(parts[i]);
    const Imf::Header& header = file.header(int(i));
    if (!header.hasName() || header.name() != parts[i].Name || !header.hasType() || header.type() != Imf::TILEDIMAGE ||
      header.dataWindow() != expected.dataWindow() || !(header.tileDescription() == expected.tileDescription()) ||
      header.compression() != Imf::NO_COMPRESSION || !(header.channels() == expected.channels()))
    {
      throw std::runtime_error("part " + std::to_string(i) + " is not its " + parts[i].Name);
    }
    Imf::TiledInputPart tiles(file, int(i));
    for (int tile = 0; tile < tiles.numYTiles(); ++tile)
    {
      ReadTile(tiles, parts[i], tile);
    }
  }
  if (GetChecksum(key, light) != checksum)
  {
    throw std::runtime_error("its checksum is wrong");
  }
  return light;
}
