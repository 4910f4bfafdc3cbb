// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Small picture files of every kind that people light scenes with: to be cut, bent and fuzzed.
#pragma once

#include <filesystem>
#include <vector>

/// Writes them into a folder that is there, a few kilobytes each; panoramas of 16 x 8, one of 32 x 16, and a cube. All
/// can be read. The same bits each time.
std::vector<std::filesystem::path> WriteStressFiles(const std::filesystem::path& folder);
