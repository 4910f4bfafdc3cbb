// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// A vtkIBLStoredLight as a file: multi-part OpenEXR, so that exrinfo and oiiotool show what is in it.
//
// Parts, those that the light has: "cube" (n x 6n, R G B), "spectrum" (a row of real.R .. imaginary.B) and
// "brightTexels" (a row each: direction, solid angle and radiance as the 14 halves of their doubles). One tile a face
// and no compression: radiance filtered in float hardly shrinks, and inflating it takes longer than reading it. The
// first part's header has the facts, the key, the version and a checksum of everything.
#ifndef vtkIBLStoredLightFile_h
#define vtkIBLStoredLightFile_h

#include "vtkIBLStoredLight.h"

#include <filesystem>
#include <string>

/// To be raised whenever the format, or any code that makes what is stored, changes.
constexpr int vtkIBLStoredLightVersion = 1;

/// Writes a light that is whole and has a part. Throws a std::exception when that fails; the file is then useless.
void vtkIBLWriteStoredLight(const std::filesystem::path& path, const std::string& key, const vtkIBLStoredLight& light);

/// The light that was written under this key, bit by bit. Throws a std::exception for everything else.
vtkIBLStoredLight vtkIBLReadStoredLight(const std::filesystem::path& path, const std::string& key);

#endif
