// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// KissFFT for three colours at once.
#pragma once

#include <kissfft/kissfft.hh>

#include <cmath>
#include <complex>

// Red, green, blue and nothing, in one register.
struct vtkIBLColor
{
  typedef float Vector __attribute__((vector_size(16)));
  Vector V;
  vtkIBLColor()
    : V{}
  {
  }
  vtkIBLColor(float x)
    : V{ x, x, x, x }
  {
  }
  vtkIBLColor(float r, float g, float b)
    : V{ r, g, b, 0.0f }
  {
  }
  explicit vtkIBLColor(Vector v)
    : V(v)
  {
  }
  friend vtkIBLColor operator+(const vtkIBLColor& a, const vtkIBLColor& b) { return vtkIBLColor(a.V + b.V); }
  friend vtkIBLColor operator-(const vtkIBLColor& a, const vtkIBLColor& b) { return vtkIBLColor(a.V - b.V); }
  friend vtkIBLColor operator*(const vtkIBLColor& a, const vtkIBLColor& b) { return vtkIBLColor(a.V * b.V); }
  vtkIBLColor operator-() const { return vtkIBLColor(-this->V); }
  vtkIBLColor& operator+=(const vtkIBLColor& other) { return *this = *this + other; }
  vtkIBLColor& operator-=(const vtkIBLColor& other) { return *this = *this - other; }
  vtkIBLColor& operator*=(const vtkIBLColor& other) { return *this = *this * other; }
};
using vtkIBLComplexColor = std::complex<vtkIBLColor>;

// KissFFT transforms numbers of any kind; only its constructor asks for functions that a colour has not.
template <>
inline kissfft<vtkIBLColor>::kissfft(const std::size_t size, const bool inverse)
  : _nfft(size)
  , _inverse(inverse)
{
  std::size_t n = size;
  for (std::size_t radix = 4; n > 1;)
  {
    while (n % radix != 0)
    {
      radix = radix == 4 ? 2 : radix == 2 ? 3 : radix + 2;
      radix = radix * radix > n ? n : radix;
    }
    n /= radix;
    _stageRadix.push_back(radix);
    _stageRemainder.push_back(n);
  }
  for (std::size_t i = 0; i < size; ++i)
  {
    const double angle = (inverse ? 2.0 : -2.0) * 3.14159265358979323846 * double(i) / double(size);
    _twiddles.emplace_back(float(std::cos(angle)), float(std::sin(angle)));
  }
}
