// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Collet, "XXH3", 128 bits: as fast as memory is read. It tells accidents apart, not forgeries.
#ifndef vtkIBLHash_h
#define vtkIBLHash_h

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>

class vtkIBLHash
{
public:
  vtkIBLHash();
  ~vtkIBLHash();

  void Add(const void* bytes, std::size_t count);

  /// A number.
  template <typename T, typename = std::enable_if_t<std::is_arithmetic_v<T>>>
  void Add(T value)
  {
    this->Add(&value, sizeof(value));
  }

  /// A string's or vector's length and elements, so that "ab" and "c" differ from "a" and "bc".
  template <typename T>
  auto Add(const T& elements) -> std::void_t<decltype(elements.data())>
  {
    this->Add(elements.size());
    this->Add(elements.data(), elements.size() * sizeof(*elements.data()));
  }

  /// Of all that was added, 32 hexadecimal digits.
  std::string Get() const;

private:
  struct State;
  std::unique_ptr<State> Hash;
};

#endif
