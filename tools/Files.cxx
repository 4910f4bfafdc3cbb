// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Tool.h"

#include <OpenImageIO/filesystem.h>

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace fs = std::filesystem;

namespace
{
// In memory, so that every byte that goes to a disk goes through one place that checks it.
tool::Bytes Encode(const char* format, const OIIO::ImageSpec& spec, const void* pixels)
{
  tool::Bytes bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  auto output = OIIO::ImageOutput::create(format);
  if (!output || !output->set_ioproxy(&memory))
  {
    throw tool::Failure(std::string("this OpenImageIO cannot encode ") + format + ": " + OIIO::geterror());
  }
  if (!output->open(std::string("memory.") + format, spec) || !output->write_image(spec.format, pixels) ||
    !output->close())
  {
    throw tool::Failure(std::string("cannot encode ") + format + ": " + tool::OneLine(output->geterror()));
  }
  return bytes;
}

[[noreturn]] void ThrowCannotWrite(const fs::path& path, const std::string& why)
{
  throw tool::Failure("cannot write '" + path.string() + "': " + why);
}
}

tool::Bytes tool::EncodeEXR(
  int width, int height, const std::vector<std::string>& channels, const float* pixels, const JSON& metadata)
{
  OIIO::ImageSpec spec(width, height, int(channels.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames = channels;
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("Software", Generator);
  for (const auto& [key, value] : metadata.items())
  {
    if (value.is_number())
    {
      spec.attribute(key, value.get<float>());
    }
    else
    {
      spec.attribute(key, value.get<std::string>());
    }
  }
  return Encode("exr", spec, pixels);
}

tool::Bytes tool::EncodePNG(int width, int height, const unsigned char* rgb)
{
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("Software", Generator);
  return Encode("png", spec, rgb);
}

tool::Bytes tool::EncodeJSON(const JSON& json)
{
  // A file name need not be UTF-8, and JSON must.
  const std::string text = json.dump(2, ' ', false, JSON::error_handler_t::replace) + "\n";
  return { text.begin(), text.end() };
}

//------------------------------------------------------------------------------
void tool::CheckOutput(const fs::path& path)
{
  std::error_code error;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error))
  {
    ThrowCannotWrite(path, "there is no folder '" + folder.string() + "'");
  }
  if (fs::is_directory(path, error))
  {
    ThrowCannotWrite(path, "it is a folder");
  }
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) // a rename would replace a device
  {
    ThrowCannotWrite(path, "it is not a regular file");
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0)
  {
    ThrowCannotWrite(path, std::string("its folder: ") + std::strerror(errno));
  }
}

tool::OutputFiles::~OutputFiles()
{
  for (const File& file : this->Files)
  {
    std::error_code error;
    fs::remove(file.Written, error);
  }
}

void tool::OutputFiles::Add(const fs::path& path, const Bytes& bytes)
{
  CheckOutput(path);
  const fs::path written = path.string() + ".part-" + std::to_string(getpid());
  std::FILE* stream = std::fopen(written.c_str(), "wb");
  if (!stream)
  {
    ThrowCannotWrite(path, std::strerror(errno));
  }
  this->Files.push_back({ written, path });
  bool fine = std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size() && std::fflush(stream) == 0;
  int why = errno;
  if (std::fclose(stream) != 0 && fine)
  {
    fine = false;
    why = errno;
  }
  if (!fine)
  {
    ThrowCannotWrite(path, std::strerror(why));
  }
}

void tool::OutputFiles::Commit()
{
  std::error_code error;
  if (this->Files.size() > 1 && (fs::remove(this->Files.back().Place, error), error))
  {
    ThrowCannotWrite(this->Files.back().Place, error.message());
  }
  while (!this->Files.empty())
  {
    fs::rename(this->Files.front().Written, this->Files.front().Place, error);
    if (error)
    {
      ThrowCannotWrite(this->Files.front().Place, error.message());
    }
    this->Files.erase(this->Files.begin());
  }
}
