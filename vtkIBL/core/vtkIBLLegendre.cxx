// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLLegendre.h"

#include "vtkIBLSimd.h"

#include <algorithm>
#include <cmath>

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr int Group = vtkIBLLegendre::Group;
constexpr int Lanes = 16;
constexpr int Halves = Group / Lanes;
typedef float Lane __attribute__((vector_size(4 * Lanes), aligned(4)));
constexpr int DoubleLanes = 8;
typedef double DoubleLane __attribute__((vector_size(8 * DoubleLanes), aligned(8), may_alias));

// Functions that are below this at all of a group's latitudes add nothing yet.
constexpr double Threshold = 1e-10;

// Bands whose sums are gathered together: they stay in the nearest cache.
constexpr int Chunk = 32;

// P_lm = a (cos P_{l-1,m} - b P_{l-2,m}); a and b for l = m .. order.
VTKIBL_WIDE void MakeRecurrence(int m, int order, float* a, float* b)
{
  const double mm = double(m) * m;
  a[0] = b[0] = 0.0f;
  for (int i = 1; i <= order - m; ++i)
  {
    const double l = m + i;
    const double before = (l - 1.0) * (l - 1.0);
    a[i] = float(std::sqrt((4.0 * l * l - 1.0) / (l * l - mm)));
    b[i] = float(std::sqrt((before - mm) / (4.0 * before - 1.0)));
  }
}

struct Recurrence
{
  Recurrence()
    : Table(vtkIBLLegendre::Offset(Largest, Largest + 1, Largest + 1) / 3)
  {
    for (int m = 0; m <= Largest; ++m)
    {
      MakeRecurrence(m, Largest, this->A(m), this->B(m));
    }
  }
  float* A(int m) { return &this->Table[vtkIBLLegendre::Offset(Largest, m, m) / 3]; }
  float* B(int m) { return this->A(m) + (Largest + 1 - m); }
  static constexpr int Largest = vtkIBLLegendre::MaximumOrder;
  std::vector<float> Table;
};

// The same for everybody.
Recurrence& GetRecurrence()
{
  static Recurrence recurrence;
  return recurrence;
}

// From band l to one where the functions begin to matter, in double, whose range holds sin^m up to the order 512.
// Returns that band; above `order` when there is none. `count` is a multiple of DoubleLanes.
VTKIBL_WIDE int GrowUp(
  int l, int m, int order, const float* a, const float* b, const double* cosine, double* p1, double* p2, int count)
{
  for (;;)
  {
    double most = 0.0;
    for (int i = 0; i < count; ++i)
    {
      most = std::max(most, std::abs(p1[i]));
    }
    if (most > Threshold)
    {
      return l;
    }
    const int next = l + 6; // even: l - m stays so
    if (next > order)
    {
      return order + 1; // and the few bands that are left add nothing
    }
    for (int i = 0; i < count; i += DoubleLanes)
    {
      const DoubleLane x = *reinterpret_cast<const DoubleLane*>(cosine + i);
      DoubleLane q1 = *reinterpret_cast<DoubleLane*>(p1 + i);
      DoubleLane q2 = *reinterpret_cast<DoubleLane*>(p2 + i);
      for (int k = l + 1 - m; k <= next - m; ++k)
      {
        const DoubleLane q = double(a[k]) * (x * q1 - double(b[k]) * q2);
        q2 = q1;
        q1 = q;
      }
      *reinterpret_cast<DoubleLane*>(p1 + i) = q1;
      *reinterpret_cast<DoubleLane*>(p2 + i) = q2;
    }
    l = next;
  }
}

// Where a group's recurrence stands: P_lm and P_{l-1,m}.
struct State
{
  int Band; // l, and l - m is even
  Lane Cosine[2][Halves];
  Lane P1[2][Halves], P2[2][Halves];
};

VTKIBL_INLINE void NextBand(float a, float b, const Lane& cosine, Lane& p1, Lane& p2)
{
  const Lane p = a * (cosine * p1 - b * p2);
  p2 = p1;
  p1 = p;
}

// sums[l - begin][c] += P_lm value, for bands begin to end; `values` for l - m even, then for odd.
template <int Nodes>
VTKIBL_INLINE void AddToBands(int m, int begin, int end, int order, const float* a, const float* b, State& state,
  const Lane (*values)[Halves], Lane* sums)
{
  Lane p1[Nodes][Halves], p2[Nodes][Halves];
  for (int node = 0; node < Nodes; ++node)
  {
    for (int h = 0; h < Halves; ++h)
    {
      p1[node][h] = state.P1[node][h];
      p2[node][h] = state.P2[node][h];
    }
  }
  for (int l = std::max(begin, state.Band); l < end; ++l)
  {
    const Lane(*value)[Halves] = values + ((l - m) % 2) * 6;
    Lane* sum = sums + 6 * (l - begin);
    Lane p[Halves];
    for (int h = 0; h < Halves; ++h)
    {
      p[h] = Nodes == 2 ? p1[0][h] + p1[Nodes - 1][h] : p1[0][h];
    }
    for (int c = 0; c < 6; ++c)
    {
      Lane s = sum[c];
      for (int h = 0; h < Halves; ++h)
      {
        s += p[h] * value[c][h];
      }
      sum[c] = s;
    }
    if (l < order)
    {
      for (int node = 0; node < Nodes; ++node)
      {
        for (int h = 0; h < Halves; ++h)
        {
          NextBand(a[l + 1 - m], b[l + 1 - m], state.Cosine[node][h], p1[node][h], p2[node][h]);
        }
      }
    }
  }
  for (int node = 0; node < Nodes; ++node)
  {
    for (int h = 0; h < Halves; ++h)
    {
      state.P1[node][h] = p1[node][h];
      state.P2[node][h] = p2[node][h];
    }
  }
}

VTKIBL_WIDE void AddLanes(int count, const Lane* sums, float* out)
{
  for (int i = 0; i < count; ++i)
  {
    DoubleLane total = {};
    for (int lane = 0; lane < DoubleLanes; ++lane)
    {
      total[lane] = double(sums[i][lane]) + double(sums[i][lane + DoubleLanes]);
    }
    out[i] = float(((total[0] + total[1]) + (total[2] + total[3])) + ((total[4] + total[5]) + (total[6] + total[7])));
  }
}

VTKIBL_WIDE void AddOneNode(int m, int begin, int end, int order, const float* a, const float* b, State& state,
  const Lane (*values)[Halves], Lane* sums)
{
  AddToBands<1>(m, begin, end, order, a, b, state, values, sums);
}

VTKIBL_WIDE void AddTwoNodes(int m, int begin, int end, int order, const float* a, const float* b, State& state,
  const Lane (*values)[Halves], Lane* sums)
{
  AddToBands<2>(m, begin, end, order, a, b, state, values, sums);
}

// Adds sums over l of P_lm times coefficient, of l - m even and odd: to the north their sum, to the south their
// difference.
VTKIBL_WIDE void SumBands(int m, int order, const float* a, const float* b, const State& state,
  const float* coefficients, Lane (*north)[Halves], Lane (*south)[Halves])
{
  for (int h = 0; h < Halves; ++h)
  {
    Lane p1 = state.P1[0][h];
    Lane p2 = state.P2[0][h];
    Lane even[6] = {};
    Lane odd[6] = {};
    for (int k = state.Band - m; k <= order - m; k += 2)
    {
      const float* f = coefficients + 6 * k;
      for (int c = 0; c < 6; ++c)
      {
        even[c] += f[c] * p1;
      }
      if (k + 1 > order - m)
      {
        break;
      }
      NextBand(a[k + 1], b[k + 1], state.Cosine[0][h], p1, p2);
      for (int c = 0; c < 6; ++c)
      {
        odd[c] += f[6 + c] * p1;
      }
      if (k + 2 <= order - m)
      {
        NextBand(a[k + 2], b[k + 2], state.Cosine[0][h], p1, p2);
      }
    }
    for (int c = 0; c < 6; ++c)
    {
      north[c][h] += even[c] + odd[c];
      south[c][h] += even[c] - odd[c];
    }
  }
}

// Brings the latitudes of a group, as many at a time as single precision holds beside each other, to the band where
// they begin to matter.
class Growth
{
public:
  Growth(int m, int order, int nodes, const double* cosine, const double* sectoral, const int* lastOrder)
    : M(m)
    , Order(order)
    , Count(nodes * Group)
    , Band(m)
    , Cosine(cosine)
  {
    bool isAny = false;
    for (int i = 0; i < this->Count; ++i)
    {
      const bool matters = m <= lastOrder[i];
      this->P1[i] = matters ? sectoral[i] : 0.0;
      isAny = isAny || matters;
    }
    this->Band = isAny ? m : order + 1;
  }
  // False: no more of them do. What `state` has not is zero there.
  bool Next(State& state)
  {
    if (this->Band > this->Order)
    {
      return false;
    }
    this->Band = GrowUp(this->Band, this->M, this->Order, GetRecurrence().A(this->M), GetRecurrence().B(this->M),
      this->Cosine, this->P1, this->P2, this->Count);
    if (this->Band > this->Order)
    {
      return false;
    }
    state.Band = this->Band;
    bool isAnyLeft = false;
    for (int i = 0; i < this->Count; ++i)
    {
      const int node = i / Group;
      const int half = i % Group / Lanes;
      state.Cosine[node][half][i % Lanes] = float(this->Cosine[i]);
      // The others, nearer to the pole, wait for their turn: they may matter yet.
      const bool isDue = std::abs(this->P1[i]) > 1e-32;
      state.P1[node][half][i % Lanes] = isDue ? float(this->P1[i]) : 0.0f;
      state.P2[node][half][i % Lanes] = isDue && std::abs(this->P2[i]) > 1e-37 ? float(this->P2[i]) : 0.0f;
      this->P1[i] = isDue ? 0.0 : this->P1[i];
      this->P2[i] = isDue ? 0.0 : this->P2[i];
      isAnyLeft = isAnyLeft || this->P1[i] != 0.0;
    }
    this->Band = isAnyLeft ? this->Band : this->Order + 1;
    return true;
  }

private:
  int M, Order, Count, Band;
  const double* Cosine;
  double P1[2 * Group];
  double P2[2 * Group] = {};
};
}

//------------------------------------------------------------------------------
vtkIBLLegendre::vtkIBLLegendre(int order, const std::vector<Latitude>& latitudes)
  : Order(order)
  , Latitudes(static_cast<int>(latitudes.size()))
  , Groups((this->Latitudes + Group - 1) / Group)
{
  for (const Latitude& latitude : latitudes)
  {
    this->Nodes = latitude.Weight[1] != 0.0 ? 2 : this->Nodes;
  }
  // Padding lies at the pole, where P_lm is 0, and has no weight.
  const std::size_t count = std::size_t(this->Groups) * this->Nodes * Group;
  this->Cosine.assign(count, 1.0);
  this->Sectoral.assign((order + 1) * count, 0.0);
  this->LastOrder.assign(count, 0);
  std::vector<double> sine(count, 0.0);
  for (std::size_t i = 0; i < latitudes.size(); ++i)
  {
    for (int node = 0; node < this->Nodes; ++node)
    {
      const std::size_t place = (i / Group * this->Nodes + node) * Group + i % Group;
      const double cosine = latitudes[i].Cosine[node];
      this->Cosine[place] = cosine;
      sine[place] = std::sqrt(std::max((1.0 - cosine) * (1.0 + cosine), 0.0));
      this->Sectoral[place] = latitudes[i].Weight[node] * std::sqrt(1.0 / (4.0 * Pi));
      // P_lm is like J_m(l sin): nothing before l sin comes near m.
      const double reach = order * sine[place];
      this->LastOrder[place] = static_cast<int>(reach + 3.0 * std::cbrt(reach) + 2.0);
    }
  }
  // P_mm = sqrt((2m+1)!! / (4 pi (2m)!!)) sin^m, and sqrt 2 for the pair of cosine and sine.
  for (int m = 1; m <= order; ++m)
  {
    const double factor = std::sqrt((2.0 * m + 1.0) / (2.0 * m)) * (m == 1 ? std::sqrt(2.0) : 1.0);
    const double* last = &this->Sectoral[(m - 1) * count];
    double* now = &this->Sectoral[m * count];
    for (std::size_t i = 0; i < count; ++i)
    {
      now[i] = factor * sine[i] * last[i];
    }
  }
}

void vtkIBLLegendre::Analyse(int m, const float* values, float* coefficients) const
{
  const float* a = GetRecurrence().A(m);
  const float* b = GetRecurrence().B(m);
  struct Part
  {
    State Now;
    Lane Values[12][Halves];
  };
  std::vector<Part> parts;
  parts.reserve(this->Groups);
  for (int group = 0; group < this->Groups; ++group)
  {
    const std::size_t place = std::size_t(group) * this->Nodes * Group;
    Growth growth(m, this->Order, this->Nodes, &this->Cosine[place], &this->Sectoral[m * this->Cosine.size() + place],
      &this->LastOrder[place]);
    const int count = std::min(Group, this->Latitudes - group * Group);
    for (Part part = {}; growth.Next(part.Now);)
    {
      for (int c = 0; c < 12; ++c)
      {
        // What pads `values` may be no number: here it is 0.
        std::copy_n(
          values + (std::size_t(c) * this->Groups + group) * Group, count, reinterpret_cast<float*>(part.Values[c]));
      }
      parts.push_back(part);
    }
  }
  for (int begin = m; begin <= this->Order; begin += Chunk)
  {
    const int end = std::min(begin + Chunk, this->Order + 1);
    Lane sums[6 * Chunk] = {};
    for (Part& part : parts)
    {
      (this->Nodes == 2 ? AddTwoNodes : AddOneNode)(m, begin, end, this->Order, a, b, part.Now, part.Values, sums);
    }
    AddLanes(6 * (end - begin), sums, coefficients);
    coefficients += 6 * (end - begin);
  }
}

bool vtkIBLLegendre::Synthesise(int m, int group, const float* coefficients, float* values) const
{
  const float* a = GetRecurrence().A(m);
  const float* b = GetRecurrence().B(m);
  const std::size_t place = std::size_t(group) * this->Nodes * Group;
  Growth growth(
    m, this->Order, 1, &this->Cosine[place], &this->Sectoral[m * this->Cosine.size() + place], &this->LastOrder[place]);
  Lane sums[12][Halves] = {};
  bool isAny = false;
  for (State state; growth.Next(state); isAny = true)
  {
    SumBands(m, this->Order, a, b, state, coefficients, sums, sums + 6);
  }
  if (isAny)
  {
    std::copy_n(reinterpret_cast<const float*>(sums), 12 * Group, values);
  }
  return isAny;
}
