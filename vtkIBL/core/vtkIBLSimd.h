// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A function so marked is compiled for several widths of vectors; the widest that the machine has is chosen when the
// program starts. What it calls must be inlined to go along.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__linux__)
#define VTKIBL_WIDE __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define VTKIBL_WIDE
#endif

#if defined(__GNUC__)
#define VTKIBL_INLINE __attribute__((always_inline)) inline
#else
#define VTKIBL_INLINE inline
#endif
