// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a file of the cache: a light that is whole, or an exception.
#include "vtkIBLStoredLightFile.h"

#include <cstdint>
#include <cstdlib>
#include <exception>

#include "FuzzFile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const FuzzFile file;
  try
  {
    if (!vtkIBLReadStoredLight(file.Write(data, size, "exr"), "key").IsWhole())
    {
      std::abort();
    }
  }
  catch (const std::exception&)
  {
  }
  return 0;
}
