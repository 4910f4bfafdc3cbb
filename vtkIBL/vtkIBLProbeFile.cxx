// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLProbeFile.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLOpenEXRHeader.h"
#include "vtkIBLProbe.h"

#include "vtkImageData.h"
#include "vtkNew.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace
{
constexpr int LargestFaceSize = 4096;
const char* const PositionName = "vtkIBL.probe.position"; // its being there makes the file a probe's
const char* const FaceNames[] = { "+X", "-X", "+Y", "-Y", "+Z", "-Z" };

// All that a file says of a probe.
struct Facts
{
  std::array<double, 3> Position, Orientation;
  std::array<double, 6> Bounds, Influence;
  std::array<double, 1> Proxy, BlendDistance, Intensity;
};

template <typename TFacts, typename Visitor>
void Visit(TFacts& facts, bool ownInfluence, const Visitor& visit)
{
  visit(PositionName, facts.Position);
  visit("vtkIBL.probe.orientation", facts.Orientation);
  visit("vtkIBL.probe.bounds", facts.Bounds);
  visit("vtkIBL.probe.proxy", facts.Proxy);
  visit("vtkIBL.probe.blendDistance", facts.BlendDistance);
  visit("vtkIBL.probe.intensity", facts.Intensity);
  if (ownInfluence)
  {
    visit("vtkIBL.probe.influence", facts.Influence);
  }
}

Imf::FrameBuffer MakeFrameBuffer(float* rgb, int n)
{
  Imf::FrameBuffer buffer;
  for (int c = 0; c < 3; ++c)
  {
    buffer.insert(std::string(1, "RGB"[c]),
      Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(rgb + c), 3 * sizeof(float), 3 * sizeof(float) * std::size_t(n)));
  }
  return buffer;
}
}

namespace
{
void Write(std::ofstream& stream, const std::string& name, vtkIBLProbe& probe, vtkImageData* radiance)
{
  int size[3] = {};
  if (radiance)
  {
    radiance->GetDimensions(size);
  }
  if (!radiance || size[0] != size[1] || size[2] != 6 || radiance->GetNumberOfScalarComponents() != 3 ||
    radiance->GetScalarType() != VTK_FLOAT)
  {
    throw std::runtime_error("its radiance is not n x n x 6 float RGB; give what CaptureProbe() returned");
  }
  Facts facts{};
  probe.GetPosition(facts.Position.data());
  probe.GetOrientation(facts.Orientation.data());
  probe.GetBounds(facts.Bounds.data());
  probe.GetInfluenceBounds(facts.Influence.data());
  facts.Proxy[0] = probe.GetProxy();
  facts.BlendDistance[0] = probe.GetBlendDistance();
  facts.Intensity[0] = probe.GetIntensity();

  std::vector<Imf::Header> headers;
  for (const char* face : FaceNames)
  {
    Imf::Header header(size[0], size[1]);
    header.setName(face);
    header.setType(Imf::SCANLINEIMAGE);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const char* channel : { "R", "G", "B" })
    {
      header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
    }
    headers.push_back(header);
  }
  Visit(facts, probe.HasInfluenceBounds(),
    [&](const char* name, const auto& numbers)
    {
      std::ostringstream text;
      text.imbue(std::locale::classic());
      text << std::setprecision(std::numeric_limits<double>::max_digits10);
      for (double number : numbers)
      {
        text << number << " ";
      }
      headers.front().insert(name, Imf::StringAttribute(text.str()));
    });
  Imf::StdOFStream output(stream, name.c_str());
  Imf::MultiPartOutputFile file(output, headers.data(), int(headers.size()));
  for (int face = 0; face < 6; ++face)
  {
    Imf::OutputPart part(file, face);
    part.setFrameBuffer(MakeFrameBuffer(static_cast<float*>(radiance->GetScalarPointer(0, 0, face)), size[0]));
    part.writePixels(size[1]);
  }
}

void Read(const char* fileName, vtkIBLProbe& probe)
{
  const auto fail = [](const std::string& what) { throw std::runtime_error("it " + what); };
  if (vtkIBLCheckOpenEXRHeader(fileName).GetNumberOfPixels() > std::int64_t(LargestFaceSize) * LargestFaceSize)
  {
    fail("has a part of more than " + std::to_string(LargestFaceSize) + "^2 texels");
  }
  Imf::MultiPartInputFile file(fileName);
  if (file.parts() != 6)
  {
    fail("has " + std::to_string(file.parts()) + " parts, a probe's file has six");
  }
  const Imath::Box2i window = file.header(0).dataWindow();
  const long long n = 1LL + window.max.x - window.min.x;
  for (int face = 0; face < 6; ++face)
  {
    const Imf::Header& header = file.header(face);
    if (header.dataWindow() != window || window.min != Imath::V2i(0, 0) || n != 1LL + window.max.y || n < 1 ||
      n > LargestFaceSize || !header.channels().findChannel("R") || !header.channels().findChannel("G") ||
      !header.channels().findChannel("B"))
    {
      fail("has a part that is no RGB face of up to " + std::to_string(LargestFaceSize) + "^2 texels like the others");
    }
  }
  const bool ownInfluence = file.header(0).findTypedAttribute<Imf::StringAttribute>("vtkIBL.probe.influence");
  Facts facts{};
  Visit(facts, ownInfluence,
    [&](const char* name, auto& numbers)
    {
      const auto* attribute = file.header(0).findTypedAttribute<Imf::StringAttribute>(name);
      std::istringstream text(attribute ? attribute->value() : std::string());
      text.imbue(std::locale::classic());
      for (double& number : numbers)
      {
        if (!(text >> number) || !std::isfinite(number))
        {
          fail("has no " + std::string(name) + " of " + std::to_string(numbers.size()) + " numbers in its header");
        }
      }
    });
  for (const auto* box : { &facts.Bounds, ownInfluence ? &facts.Influence : &facts.Bounds })
  {
    for (int i = 0; i < 3; ++i)
    {
      if (!((*box)[2 * i + 1] > (*box)[2 * i]))
      {
        fail("has bounds that enclose nothing");
      }
    }
  }
  if (facts.Proxy[0] < vtkIBLProbe::Infinite || facts.Proxy[0] > vtkIBLProbe::Ellipsoid)
  {
    fail("has a proxy of no known kind");
  }
  if (facts.Intensity[0] < 0.0)
  {
    fail("has an intensity below 0");
  }
  vtkNew<vtkImageData> radiance;
  radiance->SetDimensions(int(n), int(n), 6);
  radiance->AllocateScalars(VTK_FLOAT, 3);
  for (int face = 0; face < 6; ++face)
  {
    Imf::InputPart part(file, face);
    part.setFrameBuffer(MakeFrameBuffer(static_cast<float*>(radiance->GetScalarPointer(0, 0, face)), int(n)));
    part.readPixels(0, int(n) - 1);
  }

  probe.SetPosition(facts.Position[0], facts.Position[1], facts.Position[2]);
  probe.SetOrientation(facts.Orientation[0], facts.Orientation[1], facts.Orientation[2]);
  probe.SetBounds(facts.Bounds.data());
  probe.SetProxy(int(facts.Proxy[0]));
  probe.SetBlendDistance(facts.BlendDistance[0]);
  probe.SetIntensity(facts.Intensity[0]);
  ownInfluence ? probe.SetInfluenceBounds(facts.Influence.data()) : probe.SetInfluenceToBounds();
  vtkNew<vtkIBLEnvironment> light;
  light->SetInputData(radiance);
  probe.SetEnvironment(light);
}
}

void vtkIBLWriteProbeFile(const char* fileName, vtkIBLProbe& probe, vtkImageData* radiance)
{
  // Beside its place first, so that a failure leaves an older file whole.
  const fs::path place = fileName ? fileName : "";
  const fs::path written = place.string() + ".part-" + std::to_string(getpid());
  try
  {
    errno = 0;
    std::ofstream stream(written, std::ios::binary);
    if (place.empty() || !stream)
    {
      throw std::runtime_error(place.empty() ? "no name" : std::strerror(errno));
    }
    Write(stream, place.string(), probe, radiance);
    stream.close(); // here, since OpenEXR asks for no error of the last bytes
    if (!stream)
    {
      throw std::runtime_error(std::strerror(errno));
    }
    std::error_code error;
    fs::rename(written, place, error);
    if (error)
    {
      throw std::runtime_error(error.message());
    }
  }
  catch (const std::exception& error)
  {
    std::error_code ignored;
    fs::remove(written, ignored);
    throw std::runtime_error("cannot write probe '" + place.string() + "': " + error.what());
  }
}

void vtkIBLReadProbeFile(const char* fileName, vtkIBLProbe& probe)
{
  const std::string name = fileName ? fileName : "";
  std::error_code ignored;
  try
  {
    if (!fs::is_regular_file(name, ignored))
    {
      throw std::runtime_error("there is no such file");
    }
    Read(name.c_str(), probe);
  }
  catch (const std::exception& error)
  {
    std::string why = error.what();
    why.erase(why.find_last_not_of('.') + 1); // OpenEXR's
    throw std::runtime_error(
      "cannot read probe '" + name + "': " + why + ". Give a file of vtkIBLProbe::WriteFile() or 'vtkibl probe'.");
  }
}

bool vtkIBLIsProbeFile(const char* fileName)
{
  try
  {
    const Imf::MultiPartInputFile file(fileName ? fileName : "");
    return file.header(0).findTypedAttribute<Imf::StringAttribute>(PositionName);
  }
  catch (const std::exception&)
  {
    return false;
  }
}
