// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLOffscreenWindow.h"

#include "vtkIBLGLHeader.h"
#include "vtkObjectFactory.h"

#define EGL_NO_X11 // keeps X's headers, and their macros, out
#define MESA_EGL_NO_X11_HEADERS
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <vector>

vtkStandardNewMacro(vtkIBLOffscreenWindow);

namespace
{
// A context and where it draws: ours, or whatever is current on this thread.
struct Binding
{
  EGLDisplay Display = EGL_NO_DISPLAY;
  EGLSurface Surface = EGL_NO_SURFACE;
  EGLContext Context = EGL_NO_CONTEXT;

  static Binding Current()
  {
    return { eglGetCurrentDisplay(), eglGetCurrentSurface(EGL_DRAW), eglGetCurrentContext() };
  }
  bool Exists() const { return this->Context != EGL_NO_CONTEXT; }
  bool IsCurrent() const { return this->Exists() && this->Context == eglGetCurrentContext(); }
  bool MakeCurrent() const
  {
    return this->IsCurrent() ||
      (this->Display && eglMakeCurrent(this->Display, this->Surface, this->Surface, this->Context));
  }
  bool ReleaseCurrent() const { return !this->IsCurrent() || Binding{ this->Display }.MakeCurrent(); }
  void Destroy()
  {
    this->ReleaseCurrent();
    eglDestroyContext(this->Display, this->Context);
    eglDestroySurface(this->Display, this->Surface); // refused without effect where there is none
    *this = Binding();
  }
};

struct Candidate
{
  const char* Platform;
  std::string Name;
  EGLDisplay Display;
};

// EGL answers the same question with the same display, so that windows share displays without our remembering them.
std::vector<Candidate> ListDisplays()
{
  std::vector<Candidate> displays = { { "surfaceless", "surfaceless",
    eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr) } };
  EGLDeviceEXT devices[64] = { EGL_NO_DEVICE_EXT }; // without devices this one is refused, and the error says so
  EGLint count = 0;
  const auto queryDevices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  if (queryDevices)
  {
    queryDevices(64, devices, &count);
  }
  for (int i = 0; i < std::max(count, 1); ++i)
  {
    const EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
    displays.push_back({ "device", "device " + std::to_string(i), display });
  }
  displays.push_back({ "default", "default", eglGetDisplay(EGL_DEFAULT_DISPLAY) });
  return displays;
}

std::string Refusal(const char* call)
{
  const EGLint error = eglGetError();
  std::ostringstream text;
  text << call << " fails with EGL error 0x" << std::hex << error
       << (error == EGL_BAD_ACCESS ? ". Is the context current on another thread, or an X window's on this one?" : "");
  return text.str();
}

// The current context in the driver's words; asked through EGL, for VTK has not loaded OpenGL's functions yet.
std::string Describe(bool& sufficient)
{
  const auto getString = reinterpret_cast<const GLubyte* (*)(GLenum)>(eglGetProcAddress("glGetString"));
  const auto getInteger = reinterpret_cast<void (*)(GLenum, GLint*)>(eglGetProcAddress("glGetIntegerv"));
  GLint major = 0, minor = 0, profile = 0;
  getInteger(GL_MAJOR_VERSION, &major);
  getInteger(GL_MINOR_VERSION, &minor);
  getInteger(GL_CONTEXT_PROFILE_MASK, &profile);
  sufficient = 10 * major + minor >= 45 && (profile & GL_CONTEXT_CORE_PROFILE_BIT) != 0;
  std::ostringstream text;
  text << getString(GL_RENDERER) << ", OpenGL " << getString(GL_VERSION);
  return text.str();
}

// Make `made` exist and current, of OpenGL 4.5 core at least, or leave it empty. Returns what the display gave.
std::string Open(const Candidate& candidate, bool debug, Binding& made)
{
  if (candidate.Display == EGL_NO_DISPLAY)
  {
    return "not offered by EGL";
  }
  if (!eglInitialize(candidate.Display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API))
  {
    return Refusal("eglInitialize or eglBindAPI");
  }
  // Only the default display belongs to a windowing system, which may insist on a surface.
  const bool wantsSurface = candidate.Name == "default";
  const EGLint kind[] = { EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE,
    wantsSurface ? EGL_PBUFFER_BIT : EGL_DONT_CARE, EGL_NONE };
  const EGLint size[] = { EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE };
  const EGLint wanted[] = { EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, debug ? EGL_CONTEXT_OPENGL_DEBUG : EGL_NONE, EGL_TRUE, EGL_NONE };
  EGLConfig config = nullptr; // stays EGL_NO_CONFIG_KHR where the display has none of this kind
  EGLint count = 0;
  made.Display = candidate.Display;
  if (eglChooseConfig(made.Display, kind, &config, 1, &count) && count > 0 && wantsSurface)
  {
    made.Surface = eglCreatePbufferSurface(made.Display, config, size);
  }
  made.Context = eglCreateContext(made.Display, config, EGL_NO_CONTEXT, wanted);
  if (!made.Exists()) // then any, to name the driver in the error
  {
    made.Context = eglCreateContext(made.Display, config, EGL_NO_CONTEXT, nullptr);
  }
  bool sufficient = false;
  const std::string found = !made.Exists() ? Refusal("eglCreateContext")
    : !made.MakeCurrent()                  ? Refusal("eglMakeCurrent")
                                           : Describe(sufficient);
  if (!sufficient)
  {
    made.Destroy();
  }
  return found;
}
}

class vtkIBLOffscreenWindow::vtkInternals
{
public:
  Binding Own;
  std::vector<Binding> Pushed;
  std::string RendererName;
  bool Failed = false;   // no new attempt before Finalize()
  bool Reported = false; // one error, not one a frame
};

vtkIBLOffscreenWindow::vtkIBLOffscreenWindow()
  : Internals(new vtkInternals)
{
  this->SetSize(300, 300);
  this->SetMultiSamples(0);
  this->SetOffScreenRendering(1);
  this->SetFrameBlitModeToNoBlit(); // nobody looks at the default framebuffer
  this->ReadyForRendering = false;  // without a context VTK then declines to read pixels
#ifndef GLEW_OK
  // EGL finds OpenGL's functions also where there is no GLX, which VTK's default needs.
  this->SetOpenGLSymbolLoader(
    [](void*, const char* name) -> VTKOpenGLAPIProc { return eglGetProcAddress(name); }, nullptr);
#endif
}

vtkIBLOffscreenWindow::~vtkIBLOffscreenWindow()
{
  this->Finalize(); // the superclass does so too, but no longer reaches our MakeCurrent()
}

void vtkIBLOffscreenWindow::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OpenGLSupportMessage: " << this->OpenGLSupportMessage << "\n";
  os << indent << "DebugContext: " << this->DebugContext << "\n";
  os << indent << "NumberOfHighSeverityMessages: " << this->NumberOfHighSeverityMessages << "\n";
  os << indent << "LastHighSeverityMessage: " << this->LastHighSeverityMessage << "\n";
}

bool vtkIBLOffscreenWindow::CreateContext()
{
  Binding& own = this->Internals->Own;
  const char* variable = std::getenv("VTKIBL_EGL_PLATFORM");
  const std::string platform = variable ? variable : "";
  std::ostringstream message;
  message << "OpenGL 4.5 core or newer is needed, and no EGL display gives it.";
  for (const Candidate& candidate : ListDisplays())
  {
    if (platform.empty() || platform == candidate.Platform)
    {
      this->Internals->RendererName = Open(candidate, this->DebugContext, own);
      this->OpenGLSupportMessage = candidate.Name + ": " + this->Internals->RendererName;
      message << "\n  " << this->OpenGLSupportMessage;
      if (own.Exists())
      {
        this->OpenGLInit();
        this->OpenGLSupportMessage +=
          this->Initialized ? "" : ", whose functions could not be loaded. Reinstall the driver.";
        return this->Initialized;
      }
    }
  }
  if (!platform.empty())
  {
    message << "\nOnly VTKIBL_EGL_PLATFORM='" << platform
            << "' was tried. Set it to surfaceless, device or default, or unset it to try all three.";
  }
  message
    << "\nUpdate the graphics driver, or install Mesa's software renderer (Debian: libegl-mesa0 and libgl1-mesa-dri).";
  this->OpenGLSupportMessage = message.str();
  return false;
}

int vtkIBLOffscreenWindow::SupportsOpenGL()
{
  if (!this->Internals->Own.Exists() && !this->Internals->Failed)
  {
    const Binding previous = Binding::Current();
    this->ReadyForRendering = this->CreateContext();
    this->Internals->Failed = !this->ReadyForRendering;
    if (this->Internals->Failed)
    {
      this->Internals->Own.Destroy();
      previous.MakeCurrent();
    }
  }
  return !this->Internals->Failed;
}

void vtkIBLOffscreenWindow::OpenGLInitContext()
{
#ifdef GLEW_OK
  // A GLEW built for GLX loads every OpenGL function and only then misses GLX's display, which the superclass takes for
  // a failure. Hence its work is done here.
  if (!this->Initialized)
  {
    constexpr GLenum noGLXDisplay = 4; // GLEW_ERROR_NO_GLX_DISPLAY, unknown to older headers
    const GLenum result = glewInit();
    this->ContextCreationTime.Modified();
    this->GlewInitValid = this->Initialized = result == GLEW_OK || result == noGLXDisplay;
    GLfloat range[2] = { 1.0f, 1.0f };
    glGetFloatv(this->LineSmoothing ? GL_SMOOTH_LINE_WIDTH_RANGE : GL_ALIASED_LINE_WIDTH_RANGE, range);
    this->MaximumHardwareLineWidth = range[1];
  }
#else
  this->Superclass::OpenGLInitContext();
#endif
  if (this->Initialized && this->DebugContext)
  {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(
      [](GLenum source, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* text, const void* user)
      {
        // Mesa gives a compiler's warnings the same weight as its errors, and only while its cache is cold.
        const bool isWarning = source == GL_DEBUG_SOURCE_SHADER_COMPILER && type != GL_DEBUG_TYPE_ERROR;
        if (severity == GL_DEBUG_SEVERITY_HIGH && !isWarning)
        {
          auto* window = static_cast<vtkIBLOffscreenWindow*>(const_cast<void*>(user));
          ++window->NumberOfHighSeverityMessages;
          window->LastHighSeverityMessage = text;
        }
      },
      this);
  }
}

void vtkIBLOffscreenWindow::Initialize()
{
  if (!this->SupportsOpenGL() && !this->Internals->Reported)
  {
    this->Internals->Reported = true;
    vtkErrorMacro(<< this->OpenGLSupportMessage);
  }
}

void vtkIBLOffscreenWindow::Render()
{
  this->Initialize();
  if (!this->Internals->Failed)
  {
    this->MakeCurrent();
    this->Superclass::Render();
  }
}

void vtkIBLOffscreenWindow::Finalize()
{
  if (this->Internals->Own.Exists())
  {
    this->PushContext();
    this->Superclass::Finalize();
    this->Internals->Own.Destroy();
    this->PopContext();
  }
  this->ReadyForRendering = false;
  this->Internals->Failed = this->Internals->Reported = false;
}

void vtkIBLOffscreenWindow::MakeCurrent()
{
  if (this->Internals->Own.Exists() && !this->Internals->Own.MakeCurrent())
  {
    vtkErrorMacro(<< Refusal("eglMakeCurrent"));
  }
}

void vtkIBLOffscreenWindow::ReleaseCurrent()
{
  this->Internals->Own.ReleaseCurrent();
}

bool vtkIBLOffscreenWindow::IsCurrent()
{
  return this->Internals->Own.IsCurrent();
}

void vtkIBLOffscreenWindow::PushContext()
{
  this->Internals->Pushed.push_back(this->IsCurrent() ? Binding() : Binding::Current());
  this->MakeCurrent();
}

void vtkIBLOffscreenWindow::PopContext()
{
  if (!this->Internals->Pushed.empty())
  {
    this->Internals->Pushed.back().MakeCurrent(); // nothing where nothing, or our own, was current
    this->Internals->Pushed.pop_back();
  }
}

std::string vtkIBLOffscreenWindow::GetRendererName()
{
  return this->SupportsOpenGL() ? this->Internals->RendererName : std::string();
}

const char* vtkIBLOffscreenWindow::ReportCapabilities()
{
  return this->SupportsOpenGL() ? this->Superclass::ReportCapabilities() : this->OpenGLSupportMessage.c_str();
}

int vtkIBLOffscreenWindow::GetColorBufferSizes(int* rgba)
{
  for (int i = 0; rgba && i < 4; ++i)
  {
    rgba[i] = 8;
  }
  return rgba ? 32 : 0;
}

int vtkIBLOffscreenWindow::CountGLObjects()
{
  int count = 0;
  if (this->Internals->Own.Exists())
  {
    this->PushContext();
    for (GLuint name = 1; name < 4096; ++name)
    {
      count += glIsTexture(name) + glIsSampler(name) + glIsBuffer(name) + glIsFramebuffer(name) +
        glIsRenderbuffer(name) + glIsVertexArray(name) + glIsProgram(name) + glIsShader(name) + glIsQuery(name);
    }
    this->PopContext();
  }
  return count;
}
