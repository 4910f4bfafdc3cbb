// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a picture: light of the size that the output says, or an error with its word, and never both. The size
// of the input chooses layout and reduction, so that a file is all that there is to mutate.
#include "vtkIBLImageReader.h"

#include "FuzzFile.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkSMPTools.h>

#include <cstdint>
#include <string_view>
#include <utility>

namespace
{
class Words : public vtkOutputWindow
{
public:
  static Words* New();
  vtkTypeMacro(Words, vtkOutputWindow);
  void DisplayText(const char* text) override { this->Text += text; }
  std::string Text;
};
vtkStandardNewMacro(Words);

// By how it begins, null for what is none of these: OpenImageIO then asks all its thirty decoders, which is slow, and
// that of WebP makes room for 1 GiB when the first byte is '/'.
const char* GetExtension(std::string_view bytes)
{
  const std::pair<std::string_view, const char*> beginnings[] = { { { "v/1\1", 4 }, "exr" }, { "#?", "hdr" },
    { "II", "tif" }, { "MM", "tif" }, { "\x89PNG", "png" }, { "\xff\xd8", "jpg" } };
  for (const auto& [beginning, extension] : beginnings)
  {
    if (bytes.substr(0, beginning.size()) == beginning)
    {
      return extension;
    }
  }
  return nullptr;
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const FuzzFile file;
  static Words* const words = []
  {
    Words* made = Words::New();
    vtkOutputWindow::SetInstance(made);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkSMPTools::Initialize(1);
    return made;
  }();
  words->Text.clear();
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const char* extension = GetExtension(bytes);
  if (!extension)
  {
    return 0;
  }
  const std::string path = file.Write(data, size, extension).string();
  vtkNew<vtkIBLImageReader> reader;
  reader->SetFileName(path.c_str());
  reader->SetMaximumNumberOfPixels(1 << 16);
  reader->SetLayout(size % 4 == 3 ? vtkIBLImageReader::LayoutEquirectangular : vtkIBLImageReader::LayoutAuto);
  reader->SetMaximumWidth(size % 3 == 0 ? 5 : 0);
  reader->Update();
  vtkImageData* output = reader->GetOutput();
  const vtkIdType pixels = output->GetNumberOfPoints();
  vtkDataArray* radiance = output->GetPointData()->GetScalars();
  const bool failed = reader->GetErrorCode() != 0;
  if (failed ? pixels > 0 || words->Text.find("Cannot read image '" + path + "': ") == std::string::npos
             : pixels == 0 || !radiance || radiance->GetNumberOfTuples() != pixels || !words->Text.empty())
  {
    std::abort();
  }
  return 0;
}
