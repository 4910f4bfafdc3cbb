// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The files of shaders/, compiled in. The table ends with a null name.
#pragma once
struct vtkIBLShaderText
{
  const char* Name;
  const char* Text;
};
extern const vtkIBLShaderText vtkIBLShaderTexts[];
