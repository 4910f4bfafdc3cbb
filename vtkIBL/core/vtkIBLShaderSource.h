// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// A shader put together from the files of shaders/.
#pragma once

#include <string>
#include <vector>

struct vtkIBLShaderSource
{
  std::string Text;
  std::vector<std::string> Files; // #line numbers them: a compiler's "2:17" is line 17 of Files[2]
};

/// `#version 450`, vtkIBLShared.glsl, then `name` with each `#include "file"` replaced by that file, once. Throws
/// std::logic_error when a name is not in shaders/: our own mistake, not the user's.
vtkIBLShaderSource vtkIBLAssembleShader(const std::string& name);

/// The same without #version and #line, to stand inside a shader of somebody else's.
std::string vtkIBLAssembleChunk(const std::string& name);
