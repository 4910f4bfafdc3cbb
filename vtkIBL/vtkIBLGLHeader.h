// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// OpenGL as VTK loads it: glad from VTK 9.4 on, GLEW before. A version test would misread ParaView's VTK.
#pragma once
#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif
