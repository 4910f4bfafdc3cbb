// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Sums over latitudes and over bands of associated Legendre functions, for three colours at once.
#pragma once

#include <cstddef>
#include <vector>

/// P_lm at a set of latitudes, orthonormal on the sphere, times sqrt 2 where m > 0. In single precision, and safe to
/// order 512: sin^m, and what grows out of it, is kept in double until it matters.
class vtkIBLLegendre
{
public:
  /// A latitude north of the equator, which stands for its mirror south of it, too. Up to two nodes: their P_lm are
  /// added, each times its weight.
  struct Latitude
  {
    double Cosine[2] = { 0.0, 0.0 }; // of colatitude, >= 0
    double Weight[2] = { 0.0, 0.0 };
  };

  /// `order` is at most MaximumOrder.
  vtkIBLLegendre(int order, const std::vector<Latitude>& latitudes);
  static constexpr int MaximumOrder = 512;

  /// Latitudes are handled in groups of so many; what pads the last one is not read.
  static constexpr int Group = 32;
  int GetNumberOfGroups() const { return this->Groups; }

  /// Where (m, l) begins in a triangle of six floats each: real r g b, imaginary r g b.
  static std::size_t Offset(int order, int m, int l)
  {
    return 6 * (static_cast<std::size_t>(m) * (2 * order + 3 - m) / 2 + (l - m));
  }

  /// coefficients[l - m][6] = sum over latitudes of P_lm times north + (-1)^(l - m) south, l = m .. order, where
  /// values[c][latitude], c = 0..5, holds north + south, and c = 6..11 north - south.
  void Analyse(int m, const float* values, float* coefficients) const;

  /// The other way, for one group: sums over l of P_lm times coefficients[l - m][6], north in values[0..5][Group],
  /// south in values[6..11][Group]. Takes the first node of a latitude. False: all are zero, and `values` is left.
  bool Synthesise(int m, int group, const float* coefficients, float* values) const;

private:
  int Order;
  int Latitudes;
  int Groups;
  int Nodes = 1;
  std::vector<double> Cosine;   // [group][node][latitude]
  std::vector<int> LastOrder;   // the same: m above which P_lm is nothing
  std::vector<double> Sectoral; // [m][group][node][latitude]: P_mm times the weight
};
