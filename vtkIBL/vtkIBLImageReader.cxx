// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLImageReader.h"

#include "vtkIBLOpenEXRHeader.h"
#include "vtkIBLThreads.h"

#include "vtkErrorCode.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkIBLImageReader);

namespace
{
constexpr std::int64_t BandBytes = std::int64_t(16) << 20;

// What is wrong with a file. Thrown and caught in this file only.
struct ReadError : std::runtime_error
{
  ReadError(unsigned long code, const std::string& message)
    : std::runtime_error(message)
    , Code(code)
  {
  }
  unsigned long Code;
};

using Axis = std::array<int, 3>;

// What a square of the picture shows: at (a, b) in [-1,1]^2, a to the right and b down, the direction Ahead + a Right +
// b Down.
struct Face
{
  Axis Ahead, Right, Down;
};
constexpr Face Faces[] = {
  { { 1, 0, 0 }, { 0, 0, -1 },
    { 0, -1, 0 } }, // a to f: OpenGL 4.6, table 8.19, +X -X +Y -Y +Z -Z; Right is s, Down is t
  { { -1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 } },
  { { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 } },
  { { 0, -1, 0 }, { 1, 0, 0 }, { 0, 0, -1 } },
  { { 0, 0, 1 }, { 1, 0, 0 }, { 0, -1, 0 } },
  { { 0, 0, -1 }, { -1, 0, 0 }, { 0, -1, 0 } },
  { { 0, 0, -1 }, { 1, 0, 0 }, { 0, 1, 0 } }, // g: -Z turned by 180 degrees
  { { 0, 0, -1 }, { 1, 0, 0 },
    { 0, -1, 0 } }, // h to m: the figure in ImfEnvmap.h, its +X -X +Y -Y +Z -Z, where (X, Y, Z)
  { { 0, 0, 1 }, { -1, 0, 0 }, { 0, -1, 0 } }, // are our (-z, y, x)
  { { 0, 1, 0 }, { 0, 0, -1 }, { -1, 0, 0 } },
  { { 0, -1, 0 }, { 0, 0, -1 }, { 1, 0, 0 } },
  { { 1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 } },
  { { -1, 0, 0 }, { 0, 0, -1 }, { 0, -1, 0 } },
};

// A cube's picture, drawn row by row with the letters above.
struct Drawing
{
  int Columns, Rows;
  const char* Squares;
};
constexpr Drawing GLDrawings[] = { { 6, 1, "abcdef" }, { 1, 6, "abcdef" }, { 4, 3, ".c..beaf.d.." },
  { 3, 4, ".c.bea.d..g." } };
constexpr Drawing OpenEXRDrawing = { 1, 6, "hijklm" };

// Texel (i right, j down) of the patch that begins at pixel (X, Y) of the picture goes to output pixel
// First + i StepRight + j StepDown.
struct Patch
{
  int X, Y;
  vtkIdType First, StepRight, StepDown;
};

// Along one axis of every patch: Weight of source pixel From goes into texel To.
struct Tap
{
  int From, To;
  double Weight;
};

// All that the header tells about the pixels to come.
struct Plan
{
  OIIO::ImageSpec Spec;
  bool IsOpenEXR;
  int X, Y, Width, Height; // the picture, in the file's pixel coordinates
  int FirstChannel, EndChannel;
  std::array<int, 3> Channels; // of red, green, blue; counted from FirstChannel
  OIIO::TypeDesc Stored;       // as numbers come from OpenImageIO
  bool IsSRGB;
  std::vector<float> Decoded;    // light by number, for files of 8 and 16 bits
  std::array<int, 3> Dimensions; // of the output
  int PatchWidth;                // in pixels
  std::vector<Patch> Patches;
  std::vector<Tap> ColumnTaps, RowTaps; // sorted by To
};

std::string SizeOf(std::int64_t width, std::int64_t height)
{
  return std::to_string(width) + " x " + std::to_string(height);
}

[[noreturn]] void RefuseSize(const std::string& size, std::int64_t pixels, vtkIdType maximum)
{
  throw ReadError(vtkErrorCode::FileFormatError,
    "it declares " + size + "; at most " + std::to_string(maximum) +
      " pixels are allowed. If the file is sound, call SetMaximumNumberOfPixels(" + std::to_string(pixels) +
      "), or make it smaller.");
}

// Before anything is made room for.
void CheckHeader(const std::filesystem::path& path, vtkIdType maximum)
{
  vtkIBLOpenEXRSize size;
  try
  {
    size = vtkIBLCheckOpenEXRHeader(path);
  }
  catch (const std::runtime_error& error)
  {
    throw ReadError(vtkErrorCode::FileFormatError, std::string(error.what()) + "; get the file again.");
  }
  if (size.GetNumberOfPixels() > maximum)
  {
    RefuseSize(SizeOf(size.Width, size.Height) + " pixels", size.GetNumberOfPixels(), maximum);
  }
}

std::unique_ptr<OIIO::ImageInput> Open(const char* name, vtkIdType maximum)
{
  if (!name || !*name)
  {
    throw ReadError(vtkErrorCode::NoFileNameError, "no file name is set; call SetFileName() first.");
  }
  // A FIFO or a device could block for ever, so OpenImageIO gets to see regular files only.
  std::error_code ignored;
  const std::filesystem::path path = std::filesystem::u8path(name);
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status))
  {
    throw ReadError(vtkErrorCode::FileNotFoundError, "there is no such file; check the path and its permissions.");
  }
  if (!std::filesystem::is_regular_file(status))
  {
    const std::string kind =
      std::filesystem::is_directory(status) ? "it is a directory" : "it is a pipe, a socket or a device";
    throw ReadError(vtkErrorCode::CannotOpenFileError, kind + "; give an image file.");
  }
  CheckHeader(path, maximum);
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1); // as stored: no multiplication of encoded colours
  auto input = OIIO::ImageInput::open(name, &config);
  if (!input)
  {
    throw ReadError(vtkErrorCode::UnrecognizedFileTypeError,
      "it cannot be opened as an image: " + OIIO::geterror() +
        " Check that it is whole and readable, and of a format that OpenImageIO reads, best .exr or .hdr.");
  }
  return input;
}

void CheckSize(const OIIO::ImageSpec& spec, vtkIdType maximum)
{
  if (spec.deep || spec.depth > 1)
  {
    throw ReadError(vtkErrorCode::FileFormatError, "it is a deep image or a volume; flatten it to one plain image.");
  }
  const auto count = [](int width, int height) { return std::max(width, 0) * std::int64_t(std::max(height, 0)); };
  const std::int64_t pixels = count(spec.width, spec.height), shown = count(spec.full_width, spec.full_height);
  const std::string size =
    SizeOf(spec.width, spec.height) + " pixels of " + std::to_string(spec.nchannels) + " channels";
  if (pixels == 0 || shown == 0 || spec.nchannels < 1)
  {
    throw ReadError(vtkErrorCode::FileFormatError, "it is empty: " + size + "; write it again.");
  }
  const std::int64_t largest = std::max({ pixels, shown, count(spec.tile_width, spec.tile_height) });
  if (largest > maximum ||
    spec.scanline_bytes(true) > std::size_t(VTK_INT_MAX)) // OpenImageIO counts the latter in an int
  {
    RefuseSize(size + ", the display window " + SizeOf(spec.full_width, spec.full_height) + ", tiles " +
        SizeOf(spec.tile_width, spec.tile_height),
      largest, maximum);
  }
}

// By name, as EXR orders channels by the alphabet: the first layer that has a channel R or Y.
void FindChannels(Plan& plan)
{
  const std::vector<std::string>& names = plan.Spec.channelnames;
  const auto isColor = [](const std::string& name)
  {
    const std::string last = name.substr(name.rfind('.') + 1); // npos + 1 is 0
    return last == "R" || last == "Y";
  };
  const auto color = std::find_if(names.begin(), names.end(), isColor);
  const std::string layer = color == names.end() ? "" : color->substr(0, color->size() - 1);
  const auto find = [&names, &layer](const char* letter)
  {
    const auto found = std::find(names.begin(), names.end(), layer + letter);
    return found == names.end() ? -1 : int(found - names.begin());
  };
  std::array<int, 3> channels = { find("R"), find("G"), find("B") };
  if (*std::min_element(channels.begin(), channels.end()) < 0)
  {
    const int grey = std::max(find("Y"), find("R"));
    const int first = std::max(grey, 0), step = grey < 0 && plan.Spec.nchannels > 2 ? 1 : 0;
    channels = { first, first + step, first + 2 * step };
  }
  plan.FirstChannel = *std::min_element(channels.begin(), channels.end());
  plan.EndChannel = *std::max_element(channels.begin(), channels.end()) + 1;
  for (int c = 0; c < 3; ++c)
  {
    plan.Channels[c] = channels[c] - plan.FirstChannel;
  }
}

// IEC 61966-2-1. What is above 1 or below 0 goes on along the curve.
float DecodeSRGB(double encoded)
{
  return static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
}

void ChooseColorSpace(Plan& plan, int colorSpace)
{
  const OIIO::TypeDesc format = plan.Spec.format;
  const std::string named = OIIO::Strutil::lower(plan.Spec.get_string_attribute("oiio:ColorSpace"));
  const bool saysLinear =
    named.rfind("lin", 0) == 0 || named == "scene_linear"; // Linear, lin_srgb, lin_rec709_scene ...
  plan.IsSRGB = colorSpace == vtkIBLImageReader::ColorSpaceSRGB ||
    (colorSpace == vtkIBLImageReader::ColorSpaceAuto && !format.is_floating_point() && format.size() <= 2 &&
      !saysLinear);
  plan.Stored = plan.Spec.channelformats.empty() ? format : OIIO::TypeDesc(OIIO::TypeDesc::FLOAT);
  if (plan.Stored == OIIO::TypeDesc::UINT8 || plan.Stored == OIIO::TypeDesc::UINT16)
  {
    const int largest = plan.Stored == OIIO::TypeDesc::UINT8 ? 255 : 65535;
    for (int k = 0; k <= largest; ++k)
    {
      const double value = double(k) / largest;
      plan.Decoded.push_back(plan.IsSRGB ? DecodeSRGB(value) : float(value));
    }
  }
}

// Area average of `from` pixels into `to` texels, by height on the sphere when isLatitude. When isOnBorder, pixel 0 and
// pixel from-1 are centred on the borders, and are interpolated to the middles of `from` cells first.
std::vector<Tap> MakeTaps(int from, int to, bool isLatitude, bool isOnBorder)
{
  std::vector<Tap> taps;
  const auto add = [&taps](int source, int target, double weight)
  {
    if (weight > 0) // 0 * NaN is NaN
    {
      taps.push_back({ source, target, weight });
    }
  };
  // cos(x) - cos(y) = 2 sin((x+y)/2) sin((y-x)/2): keeps digits at the poles.
  const double turn = vtkMath::Pi() / (2.0 * from);
  const auto measure = [isLatitude, turn](double begin, double end)
  { return isLatitude ? 2 * std::sin(turn * (begin + end)) * std::sin(turn * (end - begin)) : end - begin; };
  for (int target = 0; target < to; ++target)
  {
    const double begin = double(target) * from / to, end = (target + 1.0) * from / to;
    for (int cell = int(begin); cell < end && cell < from; ++cell)
    {
      const double weight = measure(std::max<double>(begin, cell), std::min(end, cell + 1.0)) / measure(begin, end);
      const double position = isOnBorder ? (cell + 0.5) * (from - 1) / from : cell;
      const int source = int(position);
      add(source, target, weight * (1 - (position - source)));
      add(source + 1, target, weight * (position - source));
    }
  }
  return taps;
}

int Dot(const Axis& a, const Axis& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Where a face of n x n texels goes that begins at pixel (x, y) of the picture. In units of half a texel a = 2i + 1 -
// n, b = 2j + 1 - n, and the same holds for s and t in the output.
Patch PlaceFace(const Face& face, int x, int y, int n)
{
  const auto gl = std::find_if(Faces, Faces + 5, [&face](const Face& other) { return other.Ahead == face.Ahead; });
  const int rightS = Dot(face.Right, gl->Right), downS = Dot(face.Down, gl->Right);
  const int rightT = Dot(face.Right, gl->Down), downT = Dot(face.Down, gl->Down);
  const vtkIdType column = (n - 1) * (1 - rightS - downS) / 2, row = (n - 1) * (1 - rightT - downT) / 2, size = n;
  return { x, y, ((gl - Faces) * size + row) * size + column, rightS + size * rightT, downS + size * downT };
}

// How the picture is drawn when it shows a cube, null when it shows a panorama. `envmap` is OpenEXR's, "" when it has
// none.
const Drawing* ChooseDrawing(const Plan& plan, int layout, const std::string& envmap)
{
  const auto fits = [&plan](const Drawing& drawing)
  {
    return plan.Width % drawing.Columns == 0 && plan.Height % drawing.Rows == 0 &&
      plan.Width / drawing.Columns == plan.Height / drawing.Rows;
  };
  const bool isTwoToOne = std::abs(plan.Width - 2 * std::int64_t(plan.Height)) <= 1;
  const bool mayBePanorama = layout != vtkIBLImageReader::LayoutCube && envmap != "cube";
  if (layout == vtkIBLImageReader::LayoutEquirectangular || (mayBePanorama && isTwoToOne))
  {
    return nullptr;
  }
  const Drawing* found = envmap == "cube" && fits(OpenEXRDrawing) ? &OpenEXRDrawing
    : envmap.empty() ? std::find_if(std::begin(GLDrawings), std::end(GLDrawings), fits)
                     : std::end(GLDrawings);
  if (found != std::end(GLDrawings))
  {
    return found;
  }
  const std::string cube = "a cube of 6n x n, n x 6n, 4n x 3n or 3n x 4n", panorama = "a panorama of 2n x n";
  const std::string accepted = envmap == "cube" ? "n x 6n, as its OpenEXR attribute envmap is cube"
    : !envmap.empty()                           ? panorama + ", as its OpenEXR attribute envmap is " + envmap
    : mayBePanorama                             ? panorama + ", or " + cube
                                                : cube;
  throw ReadError(vtkErrorCode::FileFormatError,
    "it is " + SizeOf(plan.Width, plan.Height) + ". Accepted is " + accepted +
      ". Resize the picture, or say what it shows with SetLayout().");
}

// Where the picture's pixels go, and with which weights.
void Arrange(Plan& plan, int layout, int maximumWidth, const std::string& envmap)
{
  // Others than OpenEXR, a PNG with an offset say, have no display window that could be trusted.
  const OIIO::ROI window = plan.IsOpenEXR && envmap.empty() ? plan.Spec.roi_full() : plan.Spec.roi();
  plan.X = window.xbegin;
  plan.Y = window.ybegin;
  plan.Width = window.width();
  plan.Height = window.height();

  const Drawing* cube = ChooseDrawing(plan, layout, envmap);
  const int width = plan.Width / (cube ? cube->Columns : 1), height = plan.Height / (cube ? cube->Rows : 1);
  const int factor = maximumWidth > 0 ? (width - 1) / maximumWidth + 1 : 1;
  const int columns = std::max(width / factor, 1), rows = std::max(height / factor, 1);
  plan.Dimensions = { columns, rows, cube ? 6 : 1 };
  plan.PatchWidth = width;
  plan.ColumnTaps = MakeTaps(width, columns, false, !envmap.empty());
  plan.RowTaps = MakeTaps(height, rows, !cube, !envmap.empty());
  if (!cube)
  {
    plan.Patches = { { 0, 0, vtkIdType(columns) * (rows - 1), 1, -vtkIdType(columns) } }; // pictures begin at their top
  }
  for (int k = 0; cube && k < cube->Columns * cube->Rows; ++k)
  {
    if (cube->Squares[k] != '.')
    {
      const int x = k % cube->Columns * width, y = k / cube->Columns * height;
      plan.Patches.push_back(PlaceFace(Faces[cube->Squares[k] - 'a'], x, y, columns));
    }
  }
}

// "latlong", "cube" or "". OpenImageIO's "textureformat" may lie: it writes that as a text attribute too, exrenvmap
// copies the text from the panorama to the cube, and on reading the text wins. So OpenEXR itself is asked.
std::string FindEnvmap(const char* name)
{
  const Imf::MultiPartInputFile file(name, 0);
  const Imf::Header& header = file.header(0);
  return !Imf::hasEnvmap(header) ? "" : Imf::envmap(header) == Imf::ENVMAP_CUBE ? "cube" : "latlong";
}

Plan MakePlan(vtkIBLImageReader* reader, const OIIO::ImageInput& input)
{
  Plan plan;
  plan.Spec = input.spec();
  plan.IsOpenEXR = std::string(input.format_name()) == "openexr";
  CheckSize(plan.Spec, reader->GetMaximumNumberOfPixels());
  FindChannels(plan);
  ChooseColorSpace(plan, reader->GetColorSpace());
  const bool asksEnvmap = plan.IsOpenEXR && reader->GetLayout() == vtkIBLImageReader::LayoutAuto;
  Arrange(plan, reader->GetLayout(), reader->GetMaximumWidth(), asksEnvmap ? FindEnvmap(reader->GetFileName()) : "");
  return plan;
}

// Rows of the file as it stores them, of the channels that are needed.
struct Band
{
  int Begin, End; // in the file's pixel coordinates
  std::size_t RowBytes;
  std::vector<unsigned char> Bytes;
};

// What of row y of the picture lies in a patch, to linear RGB; `row` stays black outside of the data window.
void DecodeRow(const Plan& plan, const Band& band, const Patch& patch, int y, std::vector<float>& row)
{
  const int channels = plan.EndChannel - plan.FirstChannel;
  const int left = plan.X + patch.X;
  const int begin = std::max(plan.Spec.x, left);
  const int end = std::min(plan.Spec.x + plan.Spec.width, left + plan.PatchWidth);
  if (begin >= end)
  {
    return;
  }
  const unsigned char* stored = band.Bytes.data() + (plan.Y + y - band.Begin) * band.RowBytes +
    std::size_t(begin - plan.Spec.x) * channels * plan.Stored.size();
  const auto decode = [&](const auto* pixel, const auto& toLight)
  {
    float* target = row.data() + std::size_t(begin - left) * 3;
    for (int x = begin; x < end; ++x, pixel += channels)
    {
      for (int c = 0; c < 3; ++c)
      {
        *target++ = toLight(pixel[plan.Channels[c]]);
      }
    }
  };
  const auto byNumber = [&plan](int number) { return plan.Decoded[number]; };
  if (plan.Stored == OIIO::TypeDesc::UINT8)
  {
    decode(stored, byNumber);
  }
  else if (plan.Stored == OIIO::TypeDesc::UINT16)
  {
    decode(reinterpret_cast<const std::uint16_t*>(stored), byNumber);
  }
  else
  {
    std::vector<float> pixels(std::size_t(end - begin) * channels);
    OIIO::convert_pixel_values(plan.Stored, stored, OIIO::TypeDesc::FLOAT, pixels.data(), int(pixels.size()));
    decode(pixels.data(), [&plan](float v) { return plan.IsSRGB ? DecodeSRGB(v) : v; });
  }
}

// Adds to row `to` of a patch what the band has for it.
void AddBand(const Plan& plan, const Band& band, const Patch& patch, int to, float* texels)
{
  const int top = plan.Y + patch.Y;
  const auto isBefore = [](const Tap& tap, int row) { return tap.To < row; };
  auto rowTap = std::lower_bound(plan.RowTaps.begin(), plan.RowTaps.end(), to, isBefore);
  std::vector<float> row;
  std::vector<double> line;
  for (; rowTap != plan.RowTaps.end() && rowTap->To == to; ++rowTap)
  {
    if (top + rowTap->From < band.Begin || top + rowTap->From >= band.End)
    {
      continue;
    }
    row.resize(std::size_t(plan.PatchWidth) * 3);
    line.resize(std::size_t(plan.Dimensions[0]) * 3);
    DecodeRow(plan, band, patch, patch.Y + rowTap->From, row);
    for (auto tap = plan.ColumnTaps.begin(); tap != plan.ColumnTaps.end();)
    {
      double sum[3] = {};
      const int column = tap->To;
      for (; tap != plan.ColumnTaps.end() && tap->To == column; ++tap)
      {
        for (int c = 0; c < 3; ++c)
        {
          sum[c] += tap->Weight * row[std::size_t(tap->From) * 3 + c];
        }
      }
      for (int c = 0; c < 3; ++c)
      {
        line[column * 3 + c] += rowTap->Weight * sum[c];
      }
    }
  }
  float* texel = texels + (patch.First + to * patch.StepDown) * 3;
  for (std::size_t i = 0; i < line.size(); i += 3, texel += patch.StepRight * 3)
  {
    for (int c = 0; c < 3; ++c)
    {
      texel[c] = static_cast<float>(texel[c] + line[i + c]);
    }
  }
}

void ReadBand(OIIO::ImageInput& input, const Plan& plan, Band& band)
{
  const OIIO::ImageSpec& spec = plan.Spec;
  const int first = plan.FirstChannel, last = plan.EndChannel;
  const bool isRead = spec.tile_width
    ? input.read_tiles(
        0, 0, spec.x, spec.x + spec.width, band.Begin, band.End, 0, 1, first, last, plan.Stored, band.Bytes.data())
    : input.read_scanlines(0, 0, band.Begin, band.End, 0, first, last, plan.Stored, band.Bytes.data());
  if (!isRead || input.has_error()) // of cut TIFF and JPEG files OpenImageIO says what is wrong, and that all is well
  {
    throw ReadError(vtkErrorCode::PrematureEndOfFileError,
      "its pixels cannot be read from row " + std::to_string(band.Begin - spec.y) + " of " +
        std::to_string(spec.height) + " on: " + input.geterror() + " The file is damaged or cut; get it again.");
  }
}

// Streams the picture band by band into zeroed texels, each row of which is one thread's. `goOn` hears the share that
// is done; false from it ends the read.
bool ReadPixels(OIIO::ImageInput& input, const Plan& plan, const std::function<bool(double)>& goOn, float* texels)
{
  const OIIO::ImageSpec& spec = plan.Spec;
  const int first = std::max(spec.y, plan.Y), last = std::min(spec.y + spec.height, plan.Y + plan.Height);
  if (first >= last)
  {
    return goOn(1.0); // the windows don't meet: all is black
  }
  Band band;
  band.RowBytes = std::size_t(spec.width) * (plan.EndChannel - plan.FirstChannel) * plan.Stored.size();
  const int unit = spec.tile_width ? spec.tile_height : 1; // tiles are read whole
  const int fitting = int(std::min<std::int64_t>(spec.height, BandBytes / std::int64_t(band.RowBytes)));
  const int rows = std::max(fitting / unit, 1) * unit;
  band.Bytes.resize(band.RowBytes * std::min(rows, spec.height));
  const int targets = plan.Dimensions[1];
  for (int y = spec.y + (first - spec.y) / rows * rows; y < last; y += rows)
  {
    if (!goOn(double(std::max(y, first) - first) / (last - first)))
    {
      return false;
    }
    band.Begin = y;
    band.End = std::min(y + rows, spec.y + spec.height);
    ReadBand(input, plan, band);
    vtkIBLRunOnThreads(int(plan.Patches.size()) * targets,
      [&](int task) { AddBand(plan, band, plan.Patches[task / targets], task % targets, texels); });
  }
  return goOn(1.0);
}
} // namespace

vtkIBLImageReader::vtkIBLImageReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkIBLImageReader::~vtkIBLImageReader()
{
  this->SetFileName(nullptr);
}

int vtkIBLImageReader::RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  this->ErrorCode = vtkErrorCode::NoError;
  try
  {
    const std::array<int, 3> size = MakePlan(this, *Open(this->FileName, this->MaximumNumberOfPixels)).Dimensions;
    vtkInformation* info = outputVector->GetInformationObject(0);
    const int extent[6] = { 0, size[0] - 1, 0, size[1] - 1, 0, size[2] - 1 };
    info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
    info->Set(vtkDataObject::SPACING(), 1.0, 1.0, 1.0);
    info->Set(vtkDataObject::ORIGIN(), 0.0, 0.0, 0.0);
    vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_FLOAT, 3);
    return 1;
  }
  catch (const std::exception& error)
  {
    return this->Fail(outputVector, error);
  }
}

int vtkIBLImageReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  this->ErrorCode = vtkErrorCode::NoError;
  try
  {
    const auto input = Open(this->FileName, this->MaximumNumberOfPixels);
    const Plan plan = MakePlan(this, *input);
    vtkInformation* info = outputVector->GetInformationObject(0);
    vtkImageData* output = vtkImageData::GetData(info);
    output->SetDimensions(plan.Dimensions.data());
    const int* whole = info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
    if (!std::equal(whole, whole + 6, output->GetExtent()))
    {
      throw ReadError(
        vtkErrorCode::FileFormatError, "it has another size than a moment ago; call Modified() and update again.");
    }
    vtkNew<vtkFloatArray> radiance;
    radiance->SetName("Radiance");
    radiance->SetNumberOfComponents(3);
    radiance->SetNumberOfTuples(output->GetNumberOfPoints());
    radiance->FillValue(0.0f);
    const auto goOn = [this](double done)
    {
      this->UpdateProgress(done);
      return !this->GetAbortExecute();
    };
    if (!ReadPixels(*input, plan, goOn, radiance->GetPointer(0)))
    {
      output->Initialize();
      return 1;
    }
    output->GetPointData()->SetScalars(radiance);
    return 1;
  }
  catch (const std::exception& error)
  {
    return this->Fail(outputVector, error);
  }
}

int vtkIBLImageReader::Fail(vtkInformationVector* outputVector, const std::exception& error)
{
  const auto* known = dynamic_cast<const ReadError*>(&error);
  this->ErrorCode = known ? known->Code : 0ul + vtkErrorCode::UnknownError;
  if (vtkImageData* output = vtkImageData::GetData(outputVector))
  {
    output->Initialize();
  }
  const bool isMemory = dynamic_cast<const std::bad_alloc*>(&error);
  vtkErrorMacro("Cannot read image '" << (this->FileName ? this->FileName : "") << "': " << error.what()
                                      << (isMemory ? ": too little memory; call SetMaximumWidth() to reduce it." : ""));
  return 0;
}

void vtkIBLImageReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "ColorSpace: " << this->ColorSpace << "\n";
  os << indent << "Layout: " << this->Layout << "\n";
  os << indent << "MaximumWidth: " << this->MaximumWidth << "\n";
  os << indent << "MaximumNumberOfPixels: " << this->MaximumNumberOfPixels << "\n";
}
