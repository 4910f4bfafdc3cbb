// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLHash.h"

#define XXH_INLINE_ALL // nothing to link
#include <xxhash.h>

struct vtkIBLHash::State
{
  XXH3_state_t XXH3;
};

vtkIBLHash::vtkIBLHash()
  : Hash(std::make_unique<State>())
{
  XXH3_128bits_reset(&this->Hash->XXH3);
}

vtkIBLHash::~vtkIBLHash() = default;

void vtkIBLHash::Add(const void* bytes, std::size_t count)
{
  if (count > 0) // of an empty vector the address is null
  {
    XXH3_128bits_update(&this->Hash->XXH3, bytes, count);
  }
}

std::string vtkIBLHash::Get() const
{
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(&this->Hash->XXH3));
  std::string hexadecimal;
  for (const unsigned char byte : canonical.digest)
  {
    hexadecimal += "0123456789abcdef"[byte / 16];
    hexadecimal += "0123456789abcdef"[byte % 16];
  }
  return hexadecimal;
}
