// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// GoogleTest's main, but for one thing: a program in which nothing failed and something was skipped returns 125, so
// that ctest says so. And no test reads or writes the user's cache of baked light.
#include <gtest/gtest.h>

#include <cstdlib>

int main(int argc, char* argv[])
{
  setenv("VTKIBL_CACHE", "off", 1);
  ::testing::InitGoogleTest(&argc, argv);
  const int failed = RUN_ALL_TESTS();
  return failed ? failed : ::testing::UnitTest::GetInstance()->skipped_test_count() > 0 ? 125 : 0;
}
