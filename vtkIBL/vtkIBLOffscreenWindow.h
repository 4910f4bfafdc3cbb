// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIBLOffscreenWindow
 * @brief   a render window without a screen: its own OpenGL 4.5 core context, made by EGL
 *
 * Needs no X server and no other windowing system; DISPLAY may be unset. Pictures are read back with
 * GetRGBACharPixelData(), vtkWindowToImageFilter and the like.
 *
 * @code{.cpp}
 * vtkNew<vtkIBLOffscreenWindow> window; // 300x300, MultiSamples 0
 * window->SetSize(1920, 1080);
 * window->AddRenderer(renderer);
 * window->Render();
 * @endcode
 *
 * The context is made by the first Render(), Initialize() or SupportsOpenGL(), on the first EGL display that gives
 * OpenGL 4.5 core: the surfaceless platform, then each EGL device, then the default display. The environment variable
 * VTKIBL_EGL_PLATFORM (surfaceless, device or default), read whenever a context is made, admits that one alone. Where
 * both Mesa and a GPU's own driver are installed, Mesa's software renderer may well answer first;
 * VTKIBL_EGL_PLATFORM=device asks the GPU.
 *
 * Where none is to be had, one error says what was tried, what was found and what is needed, and Render() does nothing.
 * Ask SupportsOpenGL() beforehand to be told without an error; GetOpenGLSupportMessage() then says why.
 *
 * All windows of a process share EGL's displays, which are initialized and never terminated: terminating would take
 * down the contexts of others. Each window belongs to one thread at a time. A GLX context that is current on the thread
 * shuts EGL out, and the other way round: beside an X window, call its ReleaseCurrent() before this window is rendered
 * or deleted, and this window's ReleaseCurrent() before the X window is.
 */
#ifndef vtkIBLOffscreenWindow_h
#define vtkIBLOffscreenWindow_h

#include "vtkGenericOpenGLRenderWindow.h"
#include "vtkIBLModule.h" // For export macro
#include <memory>         // For std::unique_ptr
#include <string>         // For std::string

class VTKIBL_EXPORT vtkIBLOffscreenWindow : public vtkGenericOpenGLRenderWindow
{
public:
  static vtkIBLOffscreenWindow* New();
  vtkTypeMacro(vtkIBLOffscreenWindow, vtkGenericOpenGLRenderWindow);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Make the context, unless there is one, and let VTK set it up. On failure: one error, and no new attempt before
   * Finalize().
   */
  void Initialize() override;

  /**
   * As Initialize(), but silent: 1 when there is a usable context, else 0. GetOpenGLSupportMessage() then holds the
   * platform and GetRendererName(), or what was tried, found and needed.
   */
  int SupportsOpenGL() override;

  /**
   * Release what VTK holds in the context, then destroy the context. The next Render() makes a new one. The destructor
   * does the same. A context of another window that was current stays current.
   */
  void Finalize() override;

  /**
   * Render all renderers into the window's framebuffer. Does nothing without a usable context.
   */
  void Render() override;

  ///@{
  /**
   * Ask for a debug context, in which the driver reports each GL error as it happens. Default off, for it costs time.
   * Takes effect with the next context, so set it before the first Render(), or call Finalize().
   */
  vtkSetMacro(DebugContext, bool);
  vtkGetMacro(DebugContext, bool);
  vtkBooleanMacro(DebugContext, bool);
  ///@}

  ///@{
  /**
   * Messages of high severity (GL errors, shaders that do not compile) from debug contexts of this window since its
   * construction: how many, and the text of the last one. Nothing is printed. 0 and empty with DebugContext off.
   */
  vtkGetMacro(NumberOfHighSeverityMessages, int);
  vtkGetMacro(LastHighSeverityMessage, std::string);
  ///@}

  /**
   * Renderer and version as the driver names them: "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile)
   * Mesa 22.3.6". Makes the context if need be; empty when there is none to be had.
   */
  std::string GetRendererName();

  /**
   * Diagnostic, for leak tests: the number of live textures, samplers, buffers, framebuffers, renderbuffers, vertex
   * arrays, programs, shaders and queries with names 1 to 4095; drivers give out the smallest free name. 0 without a
   * context. ReleaseGraphicsResources(window) followed by this tells what Finalize() would leave to the driver to clean
   * up.
   */
  int CountGLObjects();

  /**
   * VTK's report, or GetOpenGLSupportMessage() where there is no usable context.
   */
  const char* ReportCapabilities() override;

  ///@{
  /**
   * Make the context current on this thread, let it go, or save and bring back whichever is current, as VTK does around
   * the release of resources. None of these creates a context.
   */
  void MakeCurrent() override;
  void ReleaseCurrent() override;
  bool IsCurrent() override;
  void PushContext() override;
  void PopContext() override;
  ///@}

  ///@{
  /**
   * The framebuffer that is rendered to has 8 bits in each of R, G, B and A, and 32 of depth. VTK's own answer is about
   * the default framebuffer, which such a context may lack.
   */
  int GetColorBufferSizes(int* rgba) override;
  int GetDepthBufferSize() override { return 32; }
  ///@}

protected:
  vtkIBLOffscreenWindow();
  ~vtkIBLOffscreenWindow() override;

  void OpenGLInitContext() override;

  bool DebugContext = false;
  int NumberOfHighSeverityMessages = 0;
  std::string LastHighSeverityMessage;

private:
  vtkIBLOffscreenWindow(const vtkIBLOffscreenWindow&) = delete;
  void operator=(const vtkIBLOffscreenWindow&) = delete;

  bool CreateContext();

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};
#endif
