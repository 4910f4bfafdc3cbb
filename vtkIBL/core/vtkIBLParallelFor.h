// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Threads, as core sees them: whoever calls brings them, and may watch them and call them off.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <utility>

/// Runs body(i) for i in [0, count), each once, in any order and on any thread.
using vtkIBLParallelFor = std::function<void(int count, const std::function<void(int)>& body)>;

/// Thrown out of work that was called off.
struct vtkIBLAborted : std::exception
{
  const char* what() const noexcept override { return "called off"; }
};

/// `parallelFor`, with `finished` counting items as they end. From when any thread sets `abort`, no item begins; once
/// those at work have ended the call throws vtkIBLAborted, on the thread that made it: an exception that left a thread
/// of a pool would end the program. Both atomics outlive what is returned.
inline vtkIBLParallelFor vtkIBLMakeAbortable(
  vtkIBLParallelFor parallelFor, const std::atomic<bool>& abort, std::atomic<int>& finished)
{
  return [parallelFor = std::move(parallelFor), &abort, &finished](int count, const std::function<void(int)>& body)
  {
    std::atomic<bool> isWhole{ true }; // `abort` may be taken back before the end
    parallelFor(count,
      [&](int i)
      {
        if (abort)
        {
          isWhole = false;
          return;
        }
        body(i);
        ++finished;
      });
    if (abort || !isWhole)
    {
      throw vtkIBLAborted();
    }
  };
}
