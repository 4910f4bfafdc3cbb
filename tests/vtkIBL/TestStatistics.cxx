// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The counting itself; what is counted, and what is not done at all, is TestSkippedWorkGL's and
// TestEnvironmentReading's.
#include "vtkIBLStatistics.h"

#include <vtkNew.h>

#include <gtest/gtest.h>

#include <set>
#include <sstream>

using Statistics = vtkIBLStatistics;

// Sums by kind and in all; differences; names that tell kinds apart; a kind that is none has nothing. Mutants: kinds
// mixed up, Total without one of them, Reset() of counts alone.
TEST(TestStatistics, Sums)
{
  vtkNew<Statistics> statistics;
  std::set<std::string> names;
  for (int kind = 0; kind < Statistics::Total; ++kind)
  {
    names.insert(Statistics::GetKindName(kind));
    for (int i = 0; i <= kind; ++i)
    {
      statistics->Add({ Statistics::Kinds(kind), 1, 10, 100, 0.5 });
    }
  }
  EXPECT_EQ(names.size(), std::size_t(Statistics::Total));
  for (int kind = 0; kind < Statistics::Total; ++kind)
  {
    EXPECT_EQ(statistics->GetCount(kind), kind + 1);
    EXPECT_EQ(statistics->GetTexels(kind), 10 * (kind + 1));
    EXPECT_EQ(statistics->GetBytes(kind), 100 * (kind + 1));
    EXPECT_EQ(statistics->GetSeconds(kind), 0.5 * (kind + 1));
  }
  const int all = Statistics::Total * (Statistics::Total + 1) / 2;
  EXPECT_EQ(statistics->GetCount(Statistics::Total), all);
  EXPECT_EQ(statistics->GetSeconds(Statistics::Total), 0.5 * all);
  for (int none : { -1, Statistics::Total + 1 })
  {
    EXPECT_EQ(statistics->GetCount(none), 0);
    EXPECT_STREQ(Statistics::GetKindName(none), "(none)");
  }

  const Statistics::Works before = statistics->GetWorks();
  statistics->Add({ Statistics::Layers, 3, 1, 2, 0.25 });
  vtkNew<Statistics> since;
  since->AddDifference(statistics->GetWorks(), before);
  EXPECT_EQ(since->GetCount(Statistics::Layers), 3);
  EXPECT_EQ(since->GetCount(Statistics::Total), 3);
  EXPECT_EQ(since->GetSeconds(Statistics::Total), 0.25);
  since->Reset();
  EXPECT_EQ(since->GetCount(Statistics::Total), 0);
  EXPECT_EQ(since->GetSeconds(Statistics::Total), 0);
  EXPECT_EQ(since->GetTexels(Statistics::Layers), 0);
  EXPECT_EQ(since->GetBytes(Statistics::Layers), 0);
}

// What was done has a line, and only that; the stream keeps its format. Mutants: a line for each kind, none for the
// total, setprecision on the caller's stream.
TEST(TestStatistics, PrintsATable)
{
  vtkNew<Statistics> statistics;
  statistics->Add({ Statistics::CubeMap, 2, 30, 400, 0.0125 });
  std::ostringstream text;
  statistics->PrintSelf(text, vtkIndent());
  text << 0.123456;
  const std::string table = text.str();
  EXPECT_NE(table.find("cube map                      2        12.5          30         400\n"), std::string::npos)
    << table;
  EXPECT_NE(
    table.find("total                         2        12.5          30         400\n0.123456"), std::string::npos)
    << table;
  EXPECT_EQ(table.find("layers"), std::string::npos);
}
