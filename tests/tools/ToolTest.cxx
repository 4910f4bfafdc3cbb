// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ToolTest.h"

#include <OpenImageIO/imageio.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace fs = std::filesystem;

namespace
{
std::string ReadText(const fs::path& path)
{
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}
}

void ToolTest::SetUp()
{
  const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  this->Folder = fs::temp_directory_path() / ("vtkibl tool " + name + " " + std::to_string(getpid()));
  fs::create_directories(this->Folder);
}

void ToolTest::TearDown()
{
  fs::remove_all(this->Folder);
}

Outcome ToolTest::Run(const std::string& arguments, const std::string& before) const
{
  const std::string out = this->Folder.string() + ".out"; // beside the folder, which tests list
  const std::string err = this->Folder.string() + ".err";
  // Nothing comes from the user's cache, and nothing goes there.
  const std::string command = "unset DISPLAY; export VTKIBL_CACHE=off; cd '" + this->Folder.string() + "' && " +
    before + " '" + VTKIBL_TOOL + "' " + arguments + " >'" + out + "' 2>'" + err + "'";
  const int status = std::system(command.c_str());
  const Outcome outcome{ WIFEXITED(status) ? WEXITSTATUS(status) : -1, ReadText(out), ReadText(err) };
  fs::remove(out);
  fs::remove(err);
  return outcome;
}

std::string ToolTest::RunWell(const std::string& arguments) const
{
  const Outcome outcome = this->Run(arguments);
  EXPECT_EQ(outcome.Status, 0) << arguments;
  EXPECT_EQ(outcome.Err, "") << arguments;
  return outcome.Out;
}

void ToolTest::WriteText(const std::string& name, const std::string& text) const
{
  std::ofstream(this->Folder / name, std::ios::binary) << text;
}

void ToolTest::WritePanorama(const std::string& name, vtkImageData* panorama) const
{
  const int width = panorama->GetDimensions()[0];
  const int height = panorama->GetDimensions()[1];
  const OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::FLOAT);
  const auto output = OIIO::ImageOutput::create("exr");
  ASSERT_TRUE(output && output->open((this->Folder / name).string(), spec));
  for (int row = 0; row < height; ++row) // files begin at the top, VTK at the bottom
  {
    ASSERT_TRUE(
      output->write_scanline(row, 0, OIIO::TypeDesc::FLOAT, panorama->GetScalarPointer(0, height - 1 - row, 0)));
  }
  ASSERT_TRUE(output->close());
}

void ToolTest::WriteConstant(const std::string& name, RGB radiance) const
{
  this->WritePanorama(name, MakePanorama(32, [&](Vec3) { return radiance; }));
}

Picture ToolTest::ReadPicture(const std::string& name) const
{
  Picture picture;
  const auto input = OIIO::ImageInput::open((this->Folder / name).string());
  if (!input)
  {
    ADD_FAILURE() << name << ": " << OIIO::geterror();
    return picture;
  }
  picture.Width = input->spec().width;
  picture.Height = input->spec().height;
  picture.Channels = input->spec().channelnames;
  picture.Values.resize(std::size_t(picture.Width) * picture.Height * picture.Channels.size());
  EXPECT_TRUE(input->read_image(0, 0, 0, int(picture.Channels.size()), OIIO::TypeDesc::FLOAT, picture.Values.data()));
  const bool isEXR = std::string(input->format_name()) == "openexr";
  EXPECT_TRUE(!isEXR || input->spec().format == OIIO::TypeDesc::FLOAT) << name << " is not float32";
  return picture;
}

nlohmann::json ToolTest::ReadJSON(const std::string& name) const
{
  const auto json = nlohmann::json::parse(ReadText(this->Folder / name), nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << name << " is not JSON";
  return json;
}

std::vector<std::string> ToolTest::List() const
{
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(this->Folder))
  {
    names.push_back(fs::relative(entry.path(), this->Folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void ToolGLTest::SetUp()
{
  ToolTest::SetUp();
  unsetenv("DISPLAY");
  vtkNew<vtkIBLOffscreenWindow> window;
  if (!window->SupportsOpenGL())
  {
    GTEST_SKIP() << window->GetOpenGLSupportMessage();
  }
}
