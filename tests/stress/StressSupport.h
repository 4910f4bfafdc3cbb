// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdlib>

/// How many inputs a stress test tries: `few` in CI, and as many times more as the environment variable VTKIBL_STRESS
/// says (run-long.sh: 100).
inline int StressCount(int few)
{
  const char* factor = std::getenv("VTKIBL_STRESS");
  return few * std::clamp(factor ? std::atoi(factor) : 1, 1, 10000);
}
