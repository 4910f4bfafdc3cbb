// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkSMPTools's threads for core.
#pragma once

#include "vtkIBLParallelFor.h"

#include "vtkSMPTools.h"

inline void vtkIBLRunOnThreads(int count, const std::function<void(int)>& body)
{
  vtkSMPTools::For(0, count, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        body(static_cast<int>(i));
      }
    });
}
