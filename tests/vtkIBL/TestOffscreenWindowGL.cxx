// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkIBLOffscreenWindow: pictures without a screen. With VTKIBL_EGL_PLATFORM set, the claims are about that platform.
#include "vtkIBLOffscreenWindow.h"

#include <vtkActor.h>
#include <vtkAutoInit.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <set>
#include <sys/wait.h>

VTK_MODULE_INIT(vtkRenderingOpenGL2)

namespace
{
using Picture = std::vector<std::uint32_t>;                                            // 0xAABBGGRR
constexpr std::uint32_t Red = 0xFF0000FF, Green = 0xFF00FF00, Background = 0x00330000; // VTK clears alpha to 0

// An unlit sphere in the middle of the picture; the corners show the background.
vtkSmartPointer<vtkRenderer> Sphere(std::uint32_t colour)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  mapper->SetInputConnection(sphere->GetOutputPort());
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(colour == Red, colour == Green, 0);
  renderer->AddActor(actor);
  renderer->SetBackground(0, 0, 0.2);
  renderer->GetActiveCamera()->SetPosition(0, 0, 3); // ours, lest VTK fits one to the first window's shape
  renderer->GetActiveCamera()->SetClippingRange(1, 5);
  return renderer;
}

Picture Read(vtkRenderWindow* window)
{
  vtkNew<vtkUnsignedCharArray> bytes;
  window->GetRGBACharPixelData(0, 0, window->GetSize()[0] - 1, window->GetSize()[1] - 1, 0, bytes);
  Picture picture(bytes->GetNumberOfValues() / 4);
  std::memcpy(picture.data(), bytes->GetPointer(0), 4 * picture.size());
  return picture;
}

Picture Draw(vtkRenderWindow* window, int width = 64, int height = 64)
{
  window->SetSize(width, height);
  window->Render();
  return Read(window);
}

std::uint32_t Centre(const Picture& picture64)
{
  return picture64.at(64 * 32 + 32);
}
bool Says(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

// A function of EGL, or of OpenGL, from the libraries that the module has loaded.
template <typename Result, typename... Arguments>
Result Call(const char* name, Arguments... arguments)
{
  const auto find = reinterpret_cast<void* (*)(const char*)>(dlsym(RTLD_DEFAULT, "eglGetProcAddress"));
  return reinterpret_cast<Result (*)(Arguments...)>(find(name))(arguments...);
}
constexpr unsigned BadEnum = 0xFFFF, InvalidEnum = 0x0500; // the latter is GL_INVALID_ENUM

struct OffscreenWindow : testing::Test
{
  void SetUp() override
  {
    unsetenv("DISPLAY");
    if (!this->Other->SupportsOpenGL())
    {
      GTEST_SKIP() << this->Other->GetOpenGLSupportMessage();
    }
    this->Other->Finalize();
    this->Window->AddRenderer(Sphere(Red));
    this->Other->AddRenderer(Sphere(Green));
  }
  vtkNew<vtkIBLOffscreenWindow> Window;
  vtkSmartPointer<vtkIBLOffscreenWindow> Other = vtkSmartPointer<vtkIBLOffscreenWindow>::New();
};

TEST_F(OffscreenWindow, GivesOpenGL45CoreAndItsDefaults)
{
  EXPECT_EQ(Window->CountGLObjects(), 0);
  Window->Render();
  int major = 0, minor = 0, profile = 0;
  Window->GetOpenGLVersion(major, minor);
  Call<void>("glGetIntegerv", 0x9126 /* GL_CONTEXT_PROFILE_MASK */, &profile);
  EXPECT_GE(10 * major + minor, 45);
  EXPECT_EQ(profile, 1); // GL_CONTEXT_CORE_PROFILE_BIT
  EXPECT_EQ(Read(Window).size(), 300u * 300u);
  EXPECT_EQ(Window->GetMultiSamples(), 0);
  EXPECT_FALSE(Window->GetShowWindow());
  EXPECT_TRUE(Says(Window->GetRendererName(), "OpenGL " + std::to_string(major) + "." + std::to_string(minor)));
  EXPECT_TRUE(Says(Window->ReportCapabilities(), "OpenGL version string:  " + std::to_string(major)));
}

// Mutant: a SetSize() that does nothing once there is a context.
TEST_F(OffscreenWindow, ReadsBackWhatWasDrawnAtEachSize)
{
  for (const auto& [width, height] : { std::array{ 64, 64 }, { 257, 131 }, { 1, 1 }, { 64, 64 } })
  {
    vtkNew<vtkIBLOffscreenWindow> fresh;
    fresh->AddRenderer(Sphere(Red));
    const Picture picture = Draw(Window, width, height);
    ASSERT_EQ(picture.size(), std::size_t(width) * height);
    EXPECT_EQ(picture[width * (height / 2) + width / 2], Red);
    EXPECT_TRUE(width == 1 || (picture.front() == Background && picture.back() == Background));
    EXPECT_EQ(picture, Draw(fresh, width, height)) << width << "x" << height;
  }
}

// Mutant: MakeCurrent() that is content with any current context.
TEST_F(OffscreenWindow, InterleavedWindowsKeepTheirPictures)
{
  for (int round = 0; round < 3; ++round)
  {
    Draw(Window);
    EXPECT_EQ(Centre(Draw(Other)), Green);
    EXPECT_EQ(Centre(Read(Window)), Red);
    EXPECT_EQ(Centre(Read(Other)), Green);
  }
}

// One sample a pixel gives sphere or background; four also give mixtures, at the rim. Mutant: MultiSamples ignored.
TEST_F(OffscreenWindow, Multisamples)
{
  const Picture plain = Draw(Window);
  Window->SetMultiSamples(4);
  const Picture smooth = Draw(Window);
  EXPECT_EQ(std::set<std::uint32_t>(plain.begin(), plain.end()).size(), 2u);
  EXPECT_GT(std::set<std::uint32_t>(smooth.begin(), smooth.end()).size(), 2u);
  EXPECT_EQ(Centre(smooth), Red);
}

// Mutants: a context that is never destroyed, or destroyed while it is current.
TEST_F(OffscreenWindow, RoundsLeaveNothingBehind)
{
  constexpr int clientType = 0x3097; // EGL_CONTEXT_CLIENT_TYPE
  const auto renderer = Sphere(Green);
  std::set<int> counts;
  for (int round = 0; round < 20; ++round)
  {
    Other = vtkSmartPointer<vtkIBLOffscreenWindow>::New();
    Other->AddRenderer(renderer);
    EXPECT_EQ(Centre(Draw(Other)), Green);
    counts.insert(Other->CountGLObjects());
    void* display = Call<void*>("eglGetCurrentDisplay");
    void* context = Call<void*>("eglGetCurrentContext");
    int value = 0;
    EXPECT_TRUE(Call<unsigned>("eglQueryContext", display, context, clientType, &value));
    if (round % 2)
    {
      Other->ReleaseGraphicsResources(Other); // the first half of Finalize()
      EXPECT_EQ(Other->CountGLObjects(), 0);
    }
    Other = nullptr;
    EXPECT_EQ(Call<void*>("eglGetCurrentContext"), nullptr);
    EXPECT_FALSE(Call<unsigned>("eglQueryContext", display, context, clientType, &value));
  }
  EXPECT_EQ(counts.size(), 1u);
  EXPECT_GT(*counts.begin(), 10);
}

// Objects have the same names in each context: a window that releases its own while another's is current takes the
// other's. Mutants: no Finalize() in the destructor; no PopContext() in Finalize().
TEST_F(OffscreenWindow, DeletedWindowLeavesOthersAlone)
{
  Window->DebugContextOn();
  const Picture before = Draw(Window);
  const int objects = Window->CountGLObjects();
  Draw(Other);
  Window->MakeCurrent();
  Other = nullptr;
  EXPECT_TRUE(Window->IsCurrent());
  EXPECT_EQ(Window->CountGLObjects(), objects);
  EXPECT_EQ(Draw(Window), before);
  EXPECT_EQ(Window->GetNumberOfHighSeverityMessages(), 0) << Window->GetLastHighSeverityMessage();
}

// Mutant: Finalize() that forgets VTK's release.
TEST_F(OffscreenWindow, RendersAgainAfterFinalize)
{
  Window->Finalize(); // of nothing
  const Picture before = Draw(Window);
  const int objects = Window->CountGLObjects();
  Window->Finalize();
  Window->Finalize();
  EXPECT_EQ(Window->CountGLObjects(), 0);
  EXPECT_EQ(Draw(Window), before);
  EXPECT_EQ(Window->CountGLObjects(), objects);
}

TEST_F(OffscreenWindow, RendererAndWindowOutliveEachOther)
{
  Draw(Other);
  Other->RemoveRenderer(Other->GetRenderers()->GetFirstRenderer()); // which is its end
  const auto renderer = Sphere(Red);
  Other->AddRenderer(renderer);
  EXPECT_EQ(Centre(Draw(Other)), Red);
  Other = vtkSmartPointer<vtkIBLOffscreenWindow>::New();
  Other->AddRenderer(renderer);
  EXPECT_EQ(Centre(Draw(Other)), Red);
}

// Mutants: no callback; a callback on every context.
TEST_F(OffscreenWindow, DebugContextCountsGLErrors)
{
  Window->DebugContextOn();
  for (const int samples : { 0, 4, 0 })
  {
    Window->SetMultiSamples(samples);
    Draw(Window);
    Draw(Window, 100, 50);
    Window->Finalize();
  }
  Draw(Window);
  EXPECT_EQ(Window->GetNumberOfHighSeverityMessages(), 0) << Window->GetLastHighSeverityMessage();
  Call<void>("glEnable", BadEnum);
  EXPECT_EQ(Window->GetNumberOfHighSeverityMessages(), 1);
  EXPECT_NE(Window->GetLastHighSeverityMessage(), "");
  EXPECT_EQ(Call<unsigned>("glGetError"), InvalidEnum);
  Other->Initialize();
  Call<void>("glEnable", BadEnum);
  EXPECT_EQ(Call<unsigned>("glGetError"), InvalidEnum);
  EXPECT_EQ(Window->GetNumberOfHighSeverityMessages() + Other->GetNumberOfHighSeverityMessages(), 1);
}

enum Outcome
{
  Drawn = 10,
  DrawnByMesa,
  Reported
};

// Frames in a child process with `environment`, most of which EGL and Mesa read but once. Drawn: red, by a display
// called `expected`. Reported: one error for all the frames, which names `expected`, what is needed and what to
// install.
[[noreturn]] void RunChild(std::vector<std::string> environment, const std::string& expected)
{
  unsetenv("DISPLAY");
  for (std::string& setting : environment)
  {
    putenv(setting.data());
  }
  std::vector<std::string> errors;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&errors);
  observer->SetCallback([](vtkObject*, unsigned long, void* list, void* text)
    { static_cast<std::vector<std::string>*>(list)->emplace_back(static_cast<char*>(text)); });
  auto window = vtkSmartPointer<vtkIBLOffscreenWindow>::New();
  window->AddObserver(vtkCommand::ErrorEvent, observer);
  window->AddRenderer(Sphere(Red));
  window->Render();
  window->Render();
  const bool drawn = window->SupportsOpenGL() && Centre(Draw(window)) == Red && !window->GetRendererName().empty();
  const std::string message = drawn ? window->GetOpenGLSupportMessage() : window->ReportCapabilities();
  window = nullptr;
  const bool reported = errors.size() == 1 && Says(errors[0], message) && Says(message, expected) &&
    Says(message, "OpenGL 4.5 core or newer is needed") && Says(message, "libegl-mesa0");
  if (drawn && errors.empty() && message.rfind(expected, 0) == 0)
  {
    std::_Exit(Says(message, "Mesa") ? DrawnByMesa : Drawn);
  }
  std::_Exit(!drawn && reported ? Reported : 1);
}

int OutcomeOf(const std::vector<std::string>& environment, const std::string& expected)
{
  testing::GTEST_FLAG(death_test_style) = "threadsafe"; // a fresh process, no fork of this one
  int code = 0;
  const auto ends = [&code](int status) { return code = WIFEXITED(status) ? WEXITSTATUS(status) : 0, code >= Drawn; };
  EXPECT_EXIT(RunChild(environment, expected), ends, "") << expected;
  return code; // 0 where the test is gone through again on the way to a later child
}

// EGL_PLATFORM has Mesa give a default display without X. Mutants: the variable ignored; an unknown value taken for
// none.
TEST(OffscreenWindowDeathTest, EnvironmentChoosesPlatform)
{
  for (const std::string platform : { "surfaceless", "device", "default" })
  {
    OutcomeOf({ "VTKIBL_EGL_PLATFORM=" + platform }, platform);
    OutcomeOf({ "VTKIBL_EGL_PLATFORM=" + platform, "EGL_PLATFORM=surfaceless" }, platform);
  }
  EXPECT_EQ(
    OutcomeOf({ "VTKIBL_EGL_PLATFORM=nonsense" }, "'nonsense' was tried. Set it to surfaceless, device or default"),
    Reported);
}

// Mutant: any version is good enough.
TEST(OffscreenWindowDeathTest, OldDriverIsReported)
{
  const int plain = OutcomeOf({}, "");
  if (plain == Drawn || plain == Reported)
  {
    GTEST_SKIP() << "There is no driver, or not Mesa's, which can pose as an old one.";
  }
  EXPECT_EQ(OutcomeOf({ "MESA_GL_VERSION_OVERRIDE=3.3" }, "OpenGL 3.3"), Reported);
}

TEST(OffscreenWindowDeathTest, MissingDriverIsReported)
{
  const int outcome = OutcomeOf({ "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent" }, "");
  if (outcome == Drawn || outcome == DrawnByMesa)
  {
    GTEST_SKIP() << "EGL is not libglvnd's, which alone can hide its drivers.";
  }
  EXPECT_EQ(OutcomeOf({ "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent" }, "not offered by EGL"), Reported);
}
}
