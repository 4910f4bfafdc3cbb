// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLGL.h"

#include "vtkIBLShaderSource.h"
#include "vtkIBLShared.glsl"

#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkTextureUnitManager.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace vtkIBLGL
{
std::string FindMissingFeature()
{
  GLint major = 0;
  GLint minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  if (major > 4 || (major == 4 && minor >= 5))
  {
    return {};
  }
  const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  std::ostringstream words;
  words << "OpenGL 4.5 (compute shaders, direct state access) is needed; '" << (renderer ? renderer : "the driver")
        << "' gives " << major << "." << minor;
  return words.str();
}

void CheckErrors(const char* doing)
{
  if (const GLenum error = glGetError())
  {
    while (glGetError() != GL_NO_ERROR)
    {
    }
    std::ostringstream words;
    words << "OpenGL error 0x" << std::hex << error << (error == GL_OUT_OF_MEMORY ? " (out of memory)" : "")
          << " while " << doing;
    throw std::runtime_error(words.str());
  }
}

//------------------------------------------------------------------------------
Object::Object(vtkOpenGLRenderWindow* window, GLuint name, Deleter deleter)
  : Window(window)
  , ContextTime(window->GetContextCreationTime())
  , Name(name)
  , DeleteName(deleter)
{
}

Object& Object::operator=(Object&& other) noexcept
{
  if (this != &other)
  {
    this->Delete();
    this->Window = other.Window;
    this->ContextTime = other.ContextTime;
    this->Name = std::exchange(other.Name, 0);
    this->DeleteName = other.DeleteName;
  }
  return *this;
}

bool Object::IsIn(vtkOpenGLRenderWindow* window) const
{
  return this->Name && this->Window == window && window && window->GetContextCreationTime() == this->ContextTime;
}

void Object::Delete()
{
  if (this->IsIn(this->Window))
  {
    this->Window->MakeCurrent();
    this->DeleteName(this->Name);
  }
  this->Name = 0;
}

//------------------------------------------------------------------------------
namespace
{
void SetFilters(GLuint name, int levels)
{
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (GLenum wrap : { GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R })
  {
    glTextureParameteri(name, wrap, GL_CLAMP_TO_EDGE);
  }
}

GLuint CreateTexture(GLenum target, int width, int height, int levels, GLenum format)
{
  GLuint name = 0;
  glCreateTextures(target, 1, &name);
  glTextureStorage2D(name, levels, format, width, height);
  SetFilters(name, levels);
  return name;
}

void DeleteTexture(GLuint name)
{
  glDeleteTextures(1, &name);
}
}

Texture Texture::Cube(vtkOpenGLRenderWindow* window, int faceSize, int levels, GLenum format)
{
  Texture texture(window, CreateTexture(GL_TEXTURE_CUBE_MAP, faceSize, faceSize, levels, format), DeleteTexture);
  CheckErrors("allocating a cube map");
  return texture;
}

Texture Texture::CubeArray(vtkOpenGLRenderWindow* window, int faceSize, int count, int levels, GLenum format)
{
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_CUBE_MAP_ARRAY, 1, &name);
  Texture texture(window, name, DeleteTexture);
  glTextureStorage3D(name, levels, format, faceSize, faceSize, 6 * count);
  SetFilters(name, levels);
  CheckErrors("allocating cube maps");
  return texture;
}

Texture Texture::CubeOf(vtkOpenGLRenderWindow* window, const Texture& array, int element)
{
  GLint format = 0;
  GLint levels = 0;
  glGetTextureLevelParameteriv(array.Id(), 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
  glGetTextureParameteriv(array.Id(), GL_TEXTURE_IMMUTABLE_LEVELS, &levels);
  GLuint name = 0;
  glGenTextures(1, &name);
  Texture texture(window, name, DeleteTexture);
  glTextureView(name, GL_TEXTURE_CUBE_MAP, array.Id(), GLenum(format), 0, GLuint(levels), GLuint(6 * element), 6);
  SetFilters(name, levels);
  CheckErrors("looking at one cube map of an array");
  return texture;
}

Texture Texture::Image2D(vtkOpenGLRenderWindow* window, int width, int height, GLenum format)
{
  Texture texture(window, CreateTexture(GL_TEXTURE_2D, width, height, 1, format), DeleteTexture);
  CheckErrors("allocating an image");
  return texture;
}

void Texture::ReadWholeLevels() const
{
  glTextureParameteri(this->Id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
}

int Texture::GetWidth(int level) const
{
  GLint width = 0;
  glGetTextureLevelParameteriv(this->Id(), level, GL_TEXTURE_WIDTH, &width);
  return width;
}

vtkSmartPointer<vtkImageData> Texture::Read(int level, int channels) const
{
  GLint target = 0;
  GLint height = 0;
  glGetTextureParameteriv(this->Id(), GL_TEXTURE_TARGET, &target);
  glGetTextureLevelParameteriv(this->Id(), level, GL_TEXTURE_HEIGHT, &height);
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(this->GetWidth(level), height, target == GL_TEXTURE_CUBE_MAP ? 6 : 1);
  image->AllocateScalars(VTK_FLOAT, channels);
  const vtkIdType bytes = channels * image->GetNumberOfPoints() * vtkIdType(sizeof(float));
  glGetTextureImage(
    this->Id(), level, channels == 4 ? GL_RGBA : GL_RGB, GL_FLOAT, GLsizei(bytes), image->GetScalarPointer());
  CheckErrors("reading a texture back");
  return image;
}

//------------------------------------------------------------------------------
Buffer Buffer::Make(vtkOpenGLRenderWindow* window, std::size_t bytes, const void* data)
{
  GLuint name = 0;
  glCreateBuffers(1, &name);
  Buffer buffer(window, name, [](GLuint id) { glDeleteBuffers(1, &id); });
  glNamedBufferStorage(name, GLsizeiptr(bytes), data, 0);
  CheckErrors("allocating a buffer");
  return buffer;
}

Framebuffer Framebuffer::Make(vtkOpenGLRenderWindow* window, int size)
{
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  Framebuffer framebuffer(window, name, [](GLuint id) { glDeleteFramebuffers(1, &id); });
  GLuint depth = 0;
  glCreateRenderbuffers(1, &depth);
  framebuffer.Depth = Object(window, depth, [](GLuint id) { glDeleteRenderbuffers(1, &id); });
  glNamedRenderbufferStorage(depth, GL_DEPTH_COMPONENT32F, size, size);
  glNamedFramebufferRenderbuffer(name, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
  CheckErrors("allocating a framebuffer");
  return framebuffer;
}

void Framebuffer::AttachLayer(const Texture& texture, int level, int layer) const
{
  glNamedFramebufferTextureLayer(this->Id(), GL_COLOR_ATTACHMENT0, texture.Id(), level, layer);
  if (const GLenum status = glCheckNamedFramebufferStatus(this->Id(), GL_DRAW_FRAMEBUFFER);
      status != GL_FRAMEBUFFER_COMPLETE)
  {
    std::ostringstream words;
    words << "this driver can't draw to a face of a cube map (framebuffer status 0x" << std::hex << status << ")";
    throw std::runtime_error(words.str());
  }
}

VertexArray VertexArray::Make(vtkOpenGLRenderWindow* window)
{
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return VertexArray(window, name, [](GLuint id) { glDeleteVertexArrays(1, &id); });
}

//------------------------------------------------------------------------------
namespace
{
template <typename GetParameter, typename GetLog>
std::string ReadLog(GLuint id, GetParameter getParameter, GetLog getLog)
{
  GLint length = 0;
  getParameter(id, GL_INFO_LOG_LENGTH, &length);
  std::string log(std::max(length, 1), '\0');
  getLog(id, length, nullptr, log.data());
  return log;
}

class Shader
{
public:
  Shader(GLenum type, const std::string& file)
    : Id(glCreateShader(type))
  {
    const vtkIBLShaderSource source = vtkIBLAssembleShader(file);
    const char* text = source.Text.c_str();
    glShaderSource(this->Id, 1, &text, nullptr);
    glCompileShader(this->Id);
    GLint compiled = GL_FALSE;
    glGetShaderiv(this->Id, GL_COMPILE_STATUS, &compiled);
    if (!compiled)
    {
      std::string words = "shader " + file + " does not compile; files are numbered";
      for (const std::string& name : source.Files)
      {
        words += " " + name;
      }
      words += ":\n" + ReadLog(this->Id, glGetShaderiv, glGetShaderInfoLog);
      glDeleteShader(this->Id);
      throw std::runtime_error(words);
    }
  }
  ~Shader() { glDeleteShader(this->Id); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;

  const GLuint Id;
};

void DeleteProgram(GLuint id)
{
  glDeleteProgram(id);
}

void Link(GLuint program, std::initializer_list<const Shader*> shaders)
{
  for (const Shader* shader : shaders)
  {
    glAttachShader(program, shader->Id);
  }
  glLinkProgram(program);
  for (const Shader* shader : shaders)
  {
    glDetachShader(program, shader->Id);
  }
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (!linked)
  {
    throw std::runtime_error("shaders do not link:\n" + ReadLog(program, glGetProgramiv, glGetProgramInfoLog));
  }
}
}

Program Program::Compute(vtkOpenGLRenderWindow* window, const std::string& shader)
{
  const Shader compute(GL_COMPUTE_SHADER, shader);
  Program program(window, glCreateProgram(), DeleteProgram);
  Link(program.Id(), { &compute });
  return program;
}

Program Program::Draw(vtkOpenGLRenderWindow* window, const std::string& vertexShader, const std::string& fragmentShader)
{
  const Shader vertex(GL_VERTEX_SHADER, vertexShader);
  const Shader fragment(GL_FRAGMENT_SHADER, fragmentShader);
  Program program(window, glCreateProgram(), DeleteProgram);
  Link(program.Id(), { &vertex, &fragment });
  return program;
}

GLint Program::Locate(const char* uniform) const
{
  return glGetUniformLocation(this->Id(), uniform);
}

void Program::Set(const char* uniform, int value) const
{
  glProgramUniform1i(this->Id(), this->Locate(uniform), value);
}

void Program::Set(const char* uniform, float value) const
{
  glProgramUniform1f(this->Id(), this->Locate(uniform), value);
}

void Program::Set(const char* uniform, const glm::vec2& value) const
{
  glProgramUniform2fv(this->Id(), this->Locate(uniform), 1, &value.x);
}

void Program::Set(const char* uniform, const glm::vec3& value) const
{
  glProgramUniform3fv(this->Id(), this->Locate(uniform), 1, &value.x);
}

void Program::Set(const char* uniform, const std::vector<glm::vec3>& values) const
{
  if (!values.empty())
  {
    glProgramUniform3fv(this->Id(), this->Locate(uniform), GLsizei(values.size()), &values.front().x);
  }
}

void Program::Set(const char* uniform, const glm::mat3& value) const
{
  glProgramUniformMatrix3fv(this->Id(), this->Locate(uniform), 1, GL_FALSE, &value[0].x);
}

//------------------------------------------------------------------------------
BoundTexture::BoundTexture(vtkOpenGLRenderWindow* window, const Texture& texture)
  : Window(window)
  , Unit(window->GetState()->GetTextureUnitManager()->Allocate())
{
  if (this->Unit < 0)
  {
    throw std::runtime_error("no texture unit is free; use fewer textures on one actor");
  }
  glBindTextureUnit(GLuint(this->Unit), texture.Id());
}

BoundTexture::~BoundTexture()
{
  if (this->Window)
  {
    glBindTextureUnit(GLuint(this->Unit), 0);
    this->Window->GetState()->GetTextureUnitManager()->Free(this->Unit);
  }
}

ActiveProgram::ActiveProgram(vtkOpenGLRenderWindow* window, const Program& program)
{
  window->GetShaderCache()->ReleaseCurrentShader();
  glUseProgram(program.Id());
}

ActiveProgram::~ActiveProgram()
{
  glUseProgram(0);
}

BoundImage::BoundImage(GLuint binding, const Texture& texture, int level, GLenum access, GLenum format)
  : Binding(binding)
{
  glBindImageTexture(binding, texture.Id(), level, GL_TRUE, 0, access, format);
}

BoundImage::~BoundImage()
{
  glBindImageTexture(this->Binding, 0, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
}

void DrawScreen(vtkOpenGLRenderWindow* window, const Program& program, const VertexArray& noVertices,
  GLboolean depthMask, GLenum depthFunction, bool behind)
{
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  const vtkOpenGLState::ScopedglEnableDisable cull(state, GL_CULL_FACE);
  const vtkOpenGLState::ScopedglDepthMask oldDepthMask(state);
  const vtkOpenGLState::ScopedglDepthFunc oldDepthFunction(state);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->SetEnumState(GL_BLEND, behind);
  state->vtkglBlendFuncSeparate(GL_ONE_MINUS_DST_ALPHA, GL_ONE, GL_ONE_MINUS_DST_ALPHA, GL_ONE);
  state->vtkglDisable(GL_CULL_FACE);
  state->vtkglDepthMask(depthMask);
  state->vtkglDepthFunc(depthFunction);
  const ActiveProgram active(window, program);
  glBindVertexArray(noVertices.Id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

int CountMipLevels(int size)
{
  return size > 1 ? 1 + CountMipLevels(size / 2) : 1;
}

void ResampleCube(vtkOpenGLRenderWindow* window, const Program& resample, const Texture& source, int sourceLevel,
  const Texture& cube, int level)
{
  ActiveProgram active(window, resample);
  BoundImage target(0, cube, level, GL_WRITE_ONLY, GL_RGBA32F);
  BoundImage origin(1, source, sourceLevel, GL_READ_ONLY, GL_RGBA32F);
  DispatchTiles(cube.GetWidth(level), 6);
}

void MakeMipLevels(vtkOpenGLRenderWindow* window, const Program& resample, const Texture& cube, int levels)
{
  for (int level = 1; level < levels; ++level)
  {
    ResampleCube(window, resample, cube, level - 1, cube, level);
  }
}

void DispatchTiles(int size, int layers)
{
  const auto tiles = GLuint((size + IBL_TILE - 1) / IBL_TILE);
  glDispatchCompute(tiles, tiles, GLuint(layers));
  FinishDispatch();
}

void FinishDispatch()
{
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
    GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  CheckErrors("running a compute shader");
}
}
