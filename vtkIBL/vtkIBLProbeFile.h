// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// A vtkIBLProbe and its light as a file: OpenEXR of six parts, the faces in OpenGL's order and orientation, float RGB;
// the first one's header has the rest, numbers as text so that no digit is lost.
#pragma once

class vtkIBLProbe;
class vtkImageData;

/// `radiance`: n x n x 6 float RGB. Throws a std::exception when it isn't, or the writing fails; then an older file
/// stays.
void vtkIBLWriteProbeFile(const char* fileName, vtkIBLProbe& probe, vtkImageData* radiance);

/// Sets all that the file has. Throws a std::exception, and has set nothing, when it is not such a file.
void vtkIBLReadProbeFile(const char* fileName, vtkIBLProbe& probe);

bool vtkIBLIsProbeFile(const char* fileName);
