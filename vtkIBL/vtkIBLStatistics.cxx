// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLStatistics.h"

#include "vtkObjectFactory.h"

#include <iomanip>
#include <sstream>

vtkStandardNewMacro(vtkIBLStatistics);

namespace
{
void Accumulate(vtkIBLStatistics::Work& sum, const vtkIBLStatistics::Work& work, int sign)
{
  sum.Count += sign * work.Count;
  sum.Texels += sign * work.Texels;
  sum.Bytes += sign * work.Bytes;
  sum.Seconds += sign * work.Seconds;
}
}

vtkIBLStatistics::vtkIBLStatistics()
{
  this->Reset();
}

const char* vtkIBLStatistics::GetKindName(int kind)
{
  constexpr const char* names[] = { "read", "cache hit", "cache write", "harmonics", "cube faces", "cube map", "layers",
    "irradiance map", "irradiance coefficients", "BRDF table", "probe faces", "probe layers", "total" };
  static_assert(sizeof(names) / sizeof(names[0]) == Total + 1, "each kind has a name");
  return kind >= 0 && kind <= Total ? names[kind] : "(none)";
}

void vtkIBLStatistics::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  std::ostringstream table; // leaves os as it was formatted
  const auto line =
    [&](const char* kind, const auto& count, const auto& milliseconds, const auto& texels, const auto& bytes)
  {
    table << indent << std::left << std::setw(23) << kind << std::right << std::setw(8) << count << std::setw(12)
          << milliseconds << std::setw(12) << texels << std::setw(12) << bytes << "\n";
  };
  table << std::fixed << std::setprecision(1);
  line("", "count", "ms", "texels", "bytes");
  for (int kind = 0; kind <= Total; ++kind)
  {
    const Work work = this->GetWork(kind);
    if (work.Count > 0 || kind == Total)
    {
      line(GetKindName(kind), work.Count, 1000.0 * work.Seconds, work.Texels, work.Bytes);
    }
  }
  os << table.str();
}

void vtkIBLStatistics::Reset()
{
  for (int kind = 0; kind < Total; ++kind)
  {
    this->Done[kind] = Work{ static_cast<Kinds>(kind), 0, 0, 0, 0.0 };
  }
}

void vtkIBLStatistics::Add(const Work& work)
{
  Accumulate(this->Done.at(work.Kind), work, 1);
}

void vtkIBLStatistics::AddDifference(const Works& now, const Works& before)
{
  for (int kind = 0; kind < Total; ++kind)
  {
    Accumulate(this->Done[kind], now[kind], 1);
    Accumulate(this->Done[kind], before[kind], -1);
  }
}

vtkIBLStatistics::Work vtkIBLStatistics::GetWork(int kind) const
{
  Work work;
  if (kind == Total)
  {
    for (const Work& one : this->Done)
    {
      Accumulate(work, one, 1);
    }
  }
  else if (kind >= 0 && kind < Total)
  {
    work = this->Done[kind];
  }
  return work;
}
