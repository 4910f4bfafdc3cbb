// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// What an OpenEXR file's header claims, before OpenEXR believes it.
//
// OpenEXR 3.1 makes room for an attribute of 2 GiB, and for a row of 2^30 pixels, before it looks whether the file has
// a hundred bytes; and it reads most types by what they say of themselves, whatever their size, so that after one wrong
// byte it goes on in the middle of another attribute, with any size there. Its C reader is stricter, but not strict
// enough (a list of channels without end, strings in a list).
#ifndef vtkIBLOpenEXRHeader_h
#define vtkIBLOpenEXRHeader_h

#include <cstdint>
#include <filesystem>

struct vtkIBLOpenEXRSize
{
  std::int64_t Width = 0;
  std::int64_t Height = 0;
  std::int64_t GetNumberOfPixels() const { return this->Width * this->Height; }
};

/// The largest window or tile of an OpenEXR file, of any part; nothing for other files. Throws std::runtime_error when
/// an attribute claims what the file, or its type, does not have; all else that may be wrong passes. To be called
/// before anything of OpenEXR's.
vtkIBLOpenEXRSize vtkIBLCheckOpenEXRHeader(const std::filesystem::path& path);

#endif
