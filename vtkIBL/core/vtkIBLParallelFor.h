// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Threads, as core sees them: whoever calls brings them.
#pragma once

#include <functional>

/// Runs body(i) for i in [0, count), each once, in any order and on any thread.
using vtkIBLParallelFor = std::function<void(int count, const std::function<void(int)>& body)>;
