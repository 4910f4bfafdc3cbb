// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// OpenGL 4.5 objects that clean up after themselves. Direct state access throughout: nothing here changes a binding
// that VTK's state cache believes in.
#pragma once

#include "vtkImageData.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include "vtkIBLGLHeader.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>
#include <utility>

namespace vtkIBLGL
{
/// What `window`'s context lacks for this module, in a sentence; empty when nothing is. The context must be current.
std::string FindMissingFeature();

/// Owner of one GL object. It is deleted in the context that made it, or forgotten when that context is gone.
class Object
{
public:
  Object() = default;
  Object(Object&& other) noexcept { *this = std::move(other); }
  Object& operator=(Object&& other) noexcept;
  ~Object() { this->Delete(); }
  GLuint Id() const { return this->Name; }
  explicit operator bool() const { return this->Name != 0; }
  void Delete();
  /// Whether it is there, in `window`'s present context.
  bool IsIn(vtkOpenGLRenderWindow* window) const;

  using Deleter = void (*)(GLuint);
  Object(vtkOpenGLRenderWindow* window, GLuint name, Deleter deleter);

private:
  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  vtkMTimeType ContextTime = 0;
  GLuint Name = 0;
  Deleter DeleteName = nullptr;
};

class Texture : public Object
{
public:
  Texture() = default;
  /// Immutable storage, linear filters (with mip levels when there is more than one), clamped edges.
  static Texture Cube(vtkOpenGLRenderWindow* window, int faceSize, int levels, GLenum format);
  /// `count` of them, as elements of one array; and one of these as a cube map of its own, which shares its texels.
  static Texture CubeArray(vtkOpenGLRenderWindow* window, int faceSize, int count, int levels, GLenum format);
  static Texture CubeOf(vtkOpenGLRenderWindow* window, const Texture& array, int element);
  static Texture Image2D(vtkOpenGLRenderWindow* window, int width, int height, GLenum format);
  /// Sets that shaders ask for whole mip levels only: a second one is not read.
  void ReadWholeLevels() const;
  int GetWidth(int level = 0) const;
  /// Texels of one level as float RGB or RGBA: n x n x 6 of a cube, face after face in GL's order, row 0 at t = -1; w x
  /// h x 1 of an image.
  vtkSmartPointer<vtkImageData> Read(int level, int channels = 3) const;
  using Object::Object;
};

class Buffer : public Object
{
public:
  Buffer() = default;
  static Buffer Make(vtkOpenGLRenderWindow* window, std::size_t bytes, const void* data);
  using Object::Object;
};

/// A framebuffer of one colour, which is attached before each use, and depth of its own.
class Framebuffer : public Object
{
public:
  Framebuffer() = default;
  static Framebuffer Make(vtkOpenGLRenderWindow* window, int size);
  void AttachLayer(const Texture& texture, int level, int layer) const;

private:
  using Object::Object;
  Object Depth;
};

class VertexArray : public Object
{
public:
  VertexArray() = default;
  static VertexArray Make(vtkOpenGLRenderWindow* window);
  using Object::Object;
};

/// A linked program of shaders/ files. Making it throws std::runtime_error with the compiler's words and the file's
/// name.
class Program : public Object
{
public:
  Program() = default;
  static Program Compute(vtkOpenGLRenderWindow* window, const std::string& shader);
  static Program Draw(
    vtkOpenGLRenderWindow* window, const std::string& vertexShader, const std::string& fragmentShader);
  void Set(const char* uniform, int value) const;
  void Set(const char* uniform, float value) const;
  void Set(const char* uniform, const glm::vec2& value) const;
  void Set(const char* uniform, const glm::vec3& value) const;
  void Set(const char* uniform, const std::vector<glm::vec3>& values) const;
  void Set(const char* uniform, const glm::mat3& value) const;
  using Object::Object;

private:
  GLint Locate(const char* uniform) const;
};

/// A texture on a unit that VTK's own textures don't use, while this lives.
class BoundTexture
{
public:
  BoundTexture(vtkOpenGLRenderWindow* window, const Texture& texture);
  ~BoundTexture();
  BoundTexture(const BoundTexture&) = delete;
  BoundTexture& operator=(const BoundTexture&) = delete;
  int GetUnit() const { return this->Unit; }

private:
  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  int Unit = -1;
};

/// Uses a program while this lives, with VTK's shader cache told.
class ActiveProgram
{
public:
  ActiveProgram(vtkOpenGLRenderWindow* window, const Program& program);
  ~ActiveProgram();
  ActiveProgram(const ActiveProgram&) = delete;
  ActiveProgram& operator=(const ActiveProgram&) = delete;
};

/// One level of a texture (of a cube: all faces) as an image for compute shaders, while this lives.
class BoundImage
{
public:
  BoundImage(GLuint binding, const Texture& texture, int level, GLenum access, GLenum format);
  ~BoundImage();
  BoundImage(const BoundImage&) = delete;
  BoundImage& operator=(const BoundImage&) = delete;

private:
  GLuint Binding;
};

/// Draws `program`, made over vtkIBLBackgroundVS.glsl, on every pixel of the viewport: neither blended nor culled,
/// depth compared by `depthFunction` and written if `depthMask`. `behind`: only as much as the alpha of what is there
/// leaves free. State is afterwards what it was.
void DrawScreen(vtkOpenGLRenderWindow* window, const Program& program, const VertexArray& noVertices,
  GLboolean depthMask, GLenum depthFunction, bool behind = false);

/// Of a square of so many texels along its edge, down to 1 x 1.
int CountMipLevels(int size);

/// `level` of an RGBA32F cube from one of another, or of its own: solid-angle-weighted means, by `resample`, a program
/// of vtkIBLCubeResampleCS.glsl. And all levels but the first, each from the one before.
void ResampleCube(vtkOpenGLRenderWindow* window, const Program& resample, const Texture& source, int sourceLevel,
  const Texture& cube, int level);
void MakeMipLevels(vtkOpenGLRenderWindow* window, const Program& resample, const Texture& cube, int levels);

/// Runs the active compute program over size^2 x layers texels in IBL_TILE tiles; what it wrote is visible to whatever
/// reads it next.
void DispatchTiles(int size, int layers);

/// The barrier and the error check that follow any dispatch.
void FinishDispatch();

/// Throws std::runtime_error with `doing` when the context has an error pending.
void CheckErrors(const char* doing);
}
