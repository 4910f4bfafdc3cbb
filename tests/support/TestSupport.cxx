// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TestSupport.h"

#include "vtkIBLCache.h"

#include <vtkObjectFactory.h>

#include <OpenImageIO/imageio.h>

#include <unistd.h>

#include <cstdlib>
#include <utility>

namespace reference = vtkIBLReference;

class CaughtMessages::Window : public vtkOutputWindow
{
public:
  static Window* New();
  vtkTypeMacro(Window, vtkOutputWindow);
  void DisplayText(const char* text) override { this->Text += text; }
  std::string Text;
};
vtkStandardNewMacro(CaughtMessages::Window);

CaughtMessages::CaughtMessages()
  : Catcher(vtkSmartPointer<Window>::New())
  , Previous(vtkOutputWindow::GetInstance())
{
  vtkOutputWindow::SetInstance(this->Catcher);
}

CaughtMessages::~CaughtMessages()
{
  vtkOutputWindow::SetInstance(this->Previous);
}

std::string CaughtMessages::Take()
{
  return std::exchange(this->Catcher->Text, std::string());
}

void GLTest::SetUp()
{
  unsetenv("DISPLAY");
  this->Window->SetSize(64, 64);
  this->Window->DebugContextOn();
  if (!this->Window->SupportsOpenGL())
  {
    GTEST_SKIP() << this->Window->GetOpenGLSupportMessage();
  }
}

void GLTest::TearDown()
{
  EXPECT_EQ(this->Window->GetNumberOfHighSeverityMessages(), 0) << this->Window->GetLastHighSeverityMessage();
  EXPECT_EQ(this->Messages.Take(), "");
}

namespace
{
vtkSmartPointer<vtkImageData> MakeImage(int width, int height, int faces, const std::function<RGB(int, int, int)>& f)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, faces);
  image->AllocateScalars(VTK_FLOAT, 3);
  for (int face = 0; face < faces; ++face)
  {
    for (int j = 0; j < height; ++j)
    {
      for (int i = 0; i < width; ++i)
      {
        const RGB value = f(i, j, face);
        auto* rgb = static_cast<float*>(image->GetScalarPointer(i, j, face));
        for (int k = 0; k < 3; ++k)
        {
          rgb[k] = static_cast<float>(value[k]);
        }
      }
    }
  }
  return image;
}
}

vtkSmartPointer<vtkImageData> MakePanorama(int height, const std::function<RGB(Vec3)>& f)
{
  const reference::Environment shape{ 2 * height, height, {} };
  return MakeImage(2 * height, height, 1, [&](int i, int j, int) { return f(reference::TexelDirection(shape, j, i)); });
}

vtkSmartPointer<vtkImageData> MakeFaces(int n, const std::function<RGB(Vec3)>& f)
{
  return MakeImage(n, n, 6,
    [&](int i, int j, int face)
    { return f(reference::CubeDirection(face, 2 * (i + 0.5) / n - 1, 2 * (j + 0.5) / n - 1)); });
}

std::string GetHDRI(const std::string& name)
{
  const std::string path = "/usr/share/blender/datafiles/studiolights/world/" + name + ".exr";
  return std::filesystem::exists(path) ? path : std::string();
}

void WriteEXR(const std::filesystem::path& path, vtkImageData* panorama)
{
  const int width = panorama->GetDimensions()[0];
  const int height = panorama->GetDimensions()[1];
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::HALF);
  spec.attribute("compression", "zip");
  const auto file = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(file && file->open(path.string(), spec)) << path;
  // A file begins at the top.
  ASSERT_TRUE(file->write_image(OIIO::TypeDesc::FLOAT, panorama->GetScalarPointer(0, height - 1, 0), OIIO::AutoStride,
    -OIIO::stride_t(12) * width));
  ASSERT_TRUE(file->close()) << path;
}

OwnCache::OwnCache()
{
  std::string pattern = (std::filesystem::temp_directory_path() / "vtkIBL-XXXXXX").string();
  this->Folder = mkdtemp(pattern.data());
  unsetenv("VTKIBL_CACHE");
  vtkIBLCache::SetDirectory((this->Folder / "cache").c_str());
  vtkIBLCache::ClearMemory();
}

OwnCache::~OwnCache()
{
  vtkIBLCache::ClearMemory();
  vtkIBLCache::SetDirectory("");
  setenv("VTKIBL_CACHE", "off", 1);
  std::filesystem::remove_all(this->Folder);
}

reference::Environment ToReference(vtkImageData* panorama)
{
  int dimensions[3];
  panorama->GetDimensions(dimensions);
  const auto* rgb = static_cast<const float*>(panorama->GetScalarPointer());
  return { dimensions[0], dimensions[1],
    std::vector<double>(rgb, rgb + std::size_t(3) * dimensions[0] * dimensions[1]) };
}

RGB GetTexel(vtkImageData* image, int i, int j, int face)
{
  const auto* rgb = static_cast<const float*>(image->GetScalarPointer(i, j, face));
  return { rgb[0], rgb[1], rgb[2] };
}

std::vector<Vec3> GetCubeDirections(int n)
{
  std::vector<Vec3> directions;
  for (int face = 0; face < 6; ++face)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        directions.push_back(reference::CubeDirection(face, 2 * (i + 0.5) / n - 1, 2 * (j + 0.5) / n - 1));
      }
    }
  }
  return directions;
}

double GetRelativeL1(vtkImageData* image, const std::vector<RGB>& truth)
{
  EXPECT_EQ(static_cast<std::size_t>(image->GetNumberOfPoints()), truth.size());
  const auto* value = static_cast<const float*>(image->GetScalarPointer());
  const int components = image->GetNumberOfScalarComponents();
  double difference = 0.0;
  double sum = 0.0;
  for (const RGB& rgb : truth)
  {
    for (int k = 0; k < 3; ++k)
    {
      difference += std::abs(value[k] - rgb[k]);
      sum += rgb[k];
    }
    value += components;
  }
  return difference / sum;
}
